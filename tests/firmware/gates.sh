#!/bin/sh
# What the core may take on Thumb-2 and RV32, object by object, within the budget; no data, no bss, no float, no recursion.
# usage: sh tests/firmware/gates.sh [--write]      at the top of the repository; --write: make what it takes now the budget
. tests/firmware/targets.sh
. tests/calls.sh
out=build/firmware/gates
rm -rf "$out"
mkdir -p "$out"
budget=tests/firmware/budget.txt
failed=0
empty() { # WHAT FILE
    if [ -s "$2" ]; then
        failed=1
        echo "FAIL  $1"
        head -n 20 "$2"
    else
        echo "note: $1"
    fi
}

# Symbols of floating point in the compilers' libraries, and what may be wanted of them.
float='^__aeabi_(f|d|cf|cd|i2|ui2|l2|ul2|h2)'
float="$float|^__(add|sub|mul|div|neg|cmp|eq|ne|lt|le|gt|ge|unord|fix|float|extend|trunc|pow)[a-z]*[sdtx]f"
allowed='mem(cpy|set|move|cmp)|__aeabi_(u?ldivmod|llsl|llsr|lasr|lmul)|__u?(div|mod)di3|__(ashl|ashr|lshr)di3|__clzdi2'

for name in cortex-m3 rv32; do
    target $name
    here=$out/$name
    call_graph "$here" "$PREFIX" "-Os -ffunction-sections -fdata-sections $FLAGS" || exit 1
    for object in "$here"/*.o; do
        "${PREFIX}size" -A "$object" | awk -v target=$name -v room="$(basename "$object" .o)" '
            $1 ~ /^\.text/ { text += $2 } $1 ~ /^\.s?rodata/ { constants += $2 }
            $1 ~ /^\.(s?data|s?bss|tdata|tbss)/ { state += $2 }
            END { print target, "text", room, text + 0; print target, "rodata", room, constants + 0
                  print target, "data+bss", room, state + 0 }'
    done >>"$out/taken"
    "${PREFIX}nm" "$here"/*.o | awk '$1 == "U" && $2 !~ /^(cage_|CAGE_)/ { print $2 }' | sort -u >"$out/wanted"
    grep -E "$float" "$out/wanted" >"$out/float"
    empty "$name: no floating point, not even a helper of the compiler" "$out/float"
    grep -vxE "$allowed" "$out/wanted" >"$out/helpers"
    empty "$name: of the compiler's library nothing but copies, and divisions and shifts of 64 bits" "$out/helpers"
    awk '$3 == "dynamic"' "$here/frames" >"$out/dynamic"
    empty "$name: every frame is of known size" "$out/dynamic"
    awk '$1 == $2' "$here/calls" >"$out/loops"
    tsort "$here/calls" 2>&1 >"$out/order" | sed -n 's/^tsort: //p' | grep -v 'input contains a loop' >>"$out/loops"
    empty "$name: no recursion" "$out/loops"
    for call in cage_atlas_ask cage_atlas_open cage_prove_begin cage_prove_begin_small cage_prove_run_inner cage_prove_run cage_survey_run cage_survey_atlas cage_path_check \
        cage_margin_find; do
        deepest "$here" $call >"$out/deepest"
        echo "$name stack $call $(sed 's/ .*//' "$out/deepest")" >>"$out/taken"
    done
    echo "note: $name: deepest stack: $(deepest "$here")"
    echo "note: $name: of a question: $(deepest "$here" cage_atlas_ask)"
    # All that is in the image, the compiler's divisions and copies included; nothing else: no start-up, no C library.
    for entry in only_ask only_query only_small only_cage only_prove only_build prove_and_query; do
        "${PREFIX}gcc" -std=c99 -Os $FLAGS -ffunction-sections -Iinclude tests/firmware/linked.c "$here"/*.o -nostartfiles \
            $LINK -Wl,-e,$entry -Wl,--gc-sections -o "$out/image" || exit 1
        echo "$name linked $entry $("${PREFIX}size" "$out/image" | awk 'NR == 2 { print $1 }')" >>"$out/taken"
        "${PREFIX}gcc" -std=c99 -Os -flto $FLAGS -ffunction-sections -Iinclude tests/firmware/linked.c src/*.c -nostartfiles \
            $LINK -Wl,-e,$entry -Wl,--gc-sections -o "$out/image" || exit 1
        echo "$name flto $entry $("${PREFIX}size" "$out/image" | awk 'NR == 2 { print $1 }')" >>"$out/taken"
    done
    awk -v name=$name '$1 == name && $2 == "text" { sum += $4 } $1 == name && $2 == "linked" { linked = linked " " $3 " " $4 }
        $1 == name && $2 == "flto" { flto = flto " " $3 " " $4 }
        END { print "note: " name ": text " sum ", linked:" linked ", with -flto:" flto }' "$out/taken"
done

if [ "$1" = --write ]; then
    {
        echo '# Bytes that the core may take with -Os: target, kind, room or entry, bytes. To change it on purpose, and say why:'
        echo '# sh tests/firmware/gates.sh --write'
        cat "$out/taken"
    } >$budget
fi
awk 'FILENAME ~ /budget/ { may[$1 " " $2 " " $3] = $4; next }
     $2 == "data+bss" && $4 > 0 { print $1, $3, "has", $4, "bytes of data or bss" }
     !(($1 " " $2 " " $3) in may) { print $1, $2, $3, "is not in the budget: takes", $4; next }
     $4 > may[$1 " " $2 " " $3] { print $1, $2, $3, "takes", $4, "bytes, may take", may[$1 " " $2 " " $3] }' \
    $budget "$out/taken" >"$out/over"
empty 'text, constants, data, stack and linked images within tests/firmware/budget.txt' "$out/over"
# What the README promises for Thumb-2, whatever the budget.
awk '$1 == "cortex-m3" { is[$2 " " $3] = $4 }
     END { if (!(is["linked only_small"] <= 32768)) print "an image that proves cages in the least code takes more than 32 KiB"
           if (!(is["linked only_query"] <= 8192)) print "an image that asks an atlas takes more than 8 KiB"
           if (!(is["stack cage_atlas_ask"] <= 512)) print "a question takes more than 512 bytes of stack" }' "$out/taken" >"$out/broken"
empty 'cortex-m3: cages proved in 32 KiB, atlases asked in 8 KiB and 512 bytes of stack' "$out/broken"
exit $failed
