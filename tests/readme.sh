#!/bin/sh
# What the README shows must work: C programs compile and print what is shown, commands print what is shown, and every
# "make TARGET" is a target.
# usage: sh tests/readme.sh      at the top of the repository, after `make all`; exit status 1 if any block fails
#
# ```c        compiled with build/libcage.a and run; a ```text block right after it is its output
# ```console  "$ " lines are run in a copy of the repository, one shell for each; the lines after one are its output
# ```sh       the same, every line a command, no output given
# Commands that build or install (make, sudo, apt-get, git, cd) are not run.

cc=${CC:-cc}
passed=0
failed=0
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
trap 'exit 1' HUP INT TERM

pass() {
    passed=$((passed + 1))
    echo "ok    $1"
}

fail() {
    failed=$((failed + 1))
    echo "FAIL  $1"
    if [ -f "$2" ]; then sed 's/^/      /' "$2" | head -n 20; fi
}

# ---- the blocks: NUMBER.KIND files, in the README's order -------------------------------------------

awk -v folder="$folder" '
    !inside && /^ *```/ { kind = $0; sub(/^ *```/, "", kind); sub(/ .*/, "", kind); if (kind == "") kind = "plain"
                          name = sprintf("%s/%03d.%s", folder, NR, kind); printf "" > name; inside = 1; next }
    inside && /^ *```/  { inside = 0; close(name); next }
    inside              { print > name }
    END                 { if (inside) print "a block is not closed" > (folder "/broken") }' README.md
if [ -f "$folder/broken" ]; then fail "fences of README.md" "$folder/broken"; fi

# The copy in which commands run; what was built comes along.
mkdir "$folder/copy"
cp -R README.md Makefile include examples "$folder/copy/"
mkdir "$folder/copy/build"
for file in cage libcage.a; do
    if [ -f build/$file ]; then cp build/$file "$folder/copy/build/"; fi
done

# ---- C ------------------------------------------------------------------------------------------------

# block, and the block after it
run_c() {
    line=$(basename "$1" .c)
    if ! grep -q 'main *(' "$1"; then
        { echo '#include "cage.h"'; cat "$1"; } >"$folder/part.c"
        if $cc -std=c99 -Wall -Wextra -Wno-unused -Iinclude -fsyntax-only "$folder/part.c" 2>"$folder/message"; then
            pass "README.md:$line C, a part: compiles"
        else
            fail "README.md:$line C, a part: does not compile" "$folder/message"
        fi
    elif ! $cc -std=c99 -Wall -Wextra -Werror -Iinclude "$1" build/libcage.a -o "$folder/program" 2>"$folder/message"; then
        fail "README.md:$line C: does not compile" "$folder/message"
    elif ! (cd "$folder/copy" && ../program) >"$folder/printed" 2>&1 </dev/null; then
        fail "README.md:$line C: exit status is not 0" "$folder/printed"
    else
        case $2 in
        *.text)
            if diff "$2" "$folder/printed" >"$folder/message"; then
                pass "README.md:$line C: compiles, runs, prints what is shown"
            else
                fail "README.md:$line C: prints something else (<: shown)" "$folder/message"
            fi ;;
        *) pass "README.md:$line C: compiles and runs" ;;
        esac
    fi
}

# ---- commands ------------------------------------------------------------------------------------------

# line, command, and whether output was shown (in the file "shown")
run_command() {
    case $2 in
    make | make\ * | sudo\ * | apt-get\ * | apt\ * | git\ * | cd\ *)
        echo "      README.md:$1 not run: $2"
        return ;;
    esac
    (cd "$folder/copy" && sh -c "$2") >"$folder/printed" 2>&1 </dev/null
    code=$?
    if [ "$code" -ne 0 ] && [ ! -s "$folder/shown" ]; then
        fail "README.md:$1 exit status $code: $2" "$folder/printed"
    elif [ "$3" -eq 0 ] || grep -Fqx ... "$folder/shown"; then
        pass "README.md:$1 runs: $2"
    elif diff "$folder/shown" "$folder/printed" >"$folder/message"; then
        pass "README.md:$1 prints what is shown: $2"
    else
        fail "README.md:$1 prints something else (<: shown): $2" "$folder/message"
    fi
}

# Splits a block into commands (a backslash at the end continues one) and what each prints, and runs them.
run_commands() {
    block=$1
    number=$(basename "$1")
    number=${number%%.*}
    kind=${1##*.}
    rm -f "$folder"/command.*
    awk -v start="$number" -v kind="$kind" -v folder="$folder" '
        { line = $0; is = kind == "sh" ? line !~ /^ *(#|$)/ : line ~ /^ *\$ / }
        continued   { sub(/^ *(> )?/, "", line); text = text " " line }
        !continued && is { sub(/^ *\$ /, "", line); text = line; at = start + NR; n++ }
        !continued && !is { if (n && kind != "sh") print > sprintf("%s/command.%03d.out", folder, n); next }
        { continued = text ~ /\\$/; sub(/ *\\$/, "", text)
          if (!continued) { sub(/ +# .*$/, "", text); printf "%d\n%s\n", at, text > sprintf("%s/command.%03d.in", folder, n) } }
    ' "$block"
    for input in "$folder"/command.*.in; do
        if [ ! -f "$input" ]; then continue; fi
        : >"$folder/shown"
        if [ -f "${input%.in}.out" ]; then cp "${input%.in}.out" "$folder/shown"; fi
        shown=1
        if [ "$kind" = sh ]; then shown=0; fi
        run_command "$(sed -n 1p "$input")" "$(sed -n 2p "$input")" $shown
    done
}

# ---- everything ----------------------------------------------------------------------------------------

set -- "$folder"/[0-9]*.*
while [ $# -gt 0 ] && [ -f "$1" ]; do
    case $1 in
    *.c) run_c "$1" "${2:-}" ;;
    *.console | *.sh) run_commands "$1" ;;
    *.text | *.plain) ;;
    *) echo "      README.md:$(basename "$1" | sed 's/\./ not run: /')" ;;
    esac
    shift
done

# Every make TARGET, in blocks (indented ones too) and between backquotes, and the names that the Makefile has.
{ grep -E '^(    |\$ )?make ' README.md; grep -oE '`make [^`]*`' README.md; cat "$folder"/*.sh "$folder"/*.console 2>/dev/null; } |
    sed 's/#.*//' | grep -oE '(^|[ `$&])make [a-z][a-z-]*' | sed 's/.*make //' | sort -u >"$folder/targets"
while read -r target; do
    if grep -Eq "^$target( [a-z ]*)?:([^=]|\$)" Makefile; then
        pass "make $target is a target"
    else
        fail "make $target is no target of the Makefile"
    fi
done <"$folder/targets"

# Every file linked to is there.
grep -oE '\]\([^):#]+\)' README.md | sed 's/^](//; s/)$//' | sort -u >"$folder/links"
while read -r link; do
    if [ -e "$link" ]; then pass "$link is there"; else fail "$link is linked to and not there"; fi
done <"$folder/links"

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
