#!/bin/sh
# What the core promises about itself: freestanding, no heap, no floating point, no globals, no recursion, clean compiles.
# usage: sh tests/gates.sh       at the top of the repository, after `make lib`; exit status 1 if a promise is broken

passed=0
failed=0
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
trap 'exit 1' HUP INT TERM
library=build/libcage.a
LC_ALL=C
export LC_ALL

# Passes if the file given is empty; else shows it.
empty() {
    if [ -s "$2" ]; then
        failed=$((failed + 1))
        echo "FAIL  $1"
        sed 's/^/      /' "$2" | head -n 20
    else
        passed=$((passed + 1))
        echo "ok    $1"
    fi
}

have() {
    command -v "$1" >/dev/null 2>&1
}

# ---- the library ---------------------------------------------------------------------------------------

if [ ! -f $library ]; then echo "$library is missing: make lib" >"$folder/missing"; fi
: >>"$folder/missing"
empty "$library is built" "$folder/missing"

nm $library 2>/dev/null | awk 'NF == 3 && $2 ~ /[A-TV-Z]/ { defined[$3] = 1 }
    NF == 2 && $1 == "U" { wanted[$2] = 1 }
    END { for (name in wanted) if (!(name in defined) && name !~ /^(memcpy|memset|memmove|memcmp|__.*|_GLOBAL_OFFSET_TABLE_)$/) print name }' |
    sort >"$folder/undefined"
empty "no undefined symbol but memcpy, memset, memmove, memcmp and the compiler's own" "$folder/undefined"

nm $library 2>/dev/null | awk 'NF == 3 && $2 ~ /[A-Z]/ && $3 !~ /^(cage_|CAGE_|__)/ { print $3 }' | sort -u >"$folder/names"
empty "every global name begins with cage_ or CAGE_" "$folder/names"

size -A $library | awk '/ex / { member = $1 } $1 ~ /^\.(data|bss|tdata|tbss)($|\.)/ && $1 !~ /^\.data\.rel\.ro/ && $2 > 0 { print member, $1, $2 }' >"$folder/sections"
empty "no data and no bss: no state" "$folder/sections"

# ---- the source ----------------------------------------------------------------------------------------

grep -hE '^ *# *include *<' src/*.c src/*.h include/cage.h | sed 's/^ *# *include *//' | sort -u |
    grep -vxE '<(stddef|stdint|stdbool|limits|stdarg|float|iso646|string)\.h>.*' >"$folder/includes"
empty "only headers of freestanding C99, and string.h for the mem functions" "$folder/includes"

# The text without comments and strings, each line with its file.
for file in src/*.c src/*.h; do
    gcc -fpreprocessed -dD -E -P -x c "$file" 2>/dev/null | sed -e 's/"[^"]*"//g' -e "s|^|$file: |"
done >"$folder/code"
grep -wE '(float|double|malloc|calloc|realloc|free|alloca|setjmp|longjmp|printf|assert)' "$folder/code" >"$folder/forbidden"
empty "no float, double, heap, printing or jump" "$folder/forbidden"
grep -E '(str[a-z]*|mem[a-z]*) *\(' "$folder/code" | grep -vE '\b(memcpy|memset|memmove|memcmp|[a-z_]*_[a-z]*) *\(' >"$folder/strings"
empty "of string.h nothing but the four" "$folder/strings"
grep -E '^[^ ]*: (static )?(struct [a-z_]* |u?int[0-9]*_t |int |bool |char |size_t )\**[a-z_]+(\[[^]]*\])*( =.*)?;' "$folder/code" |
    awk '/^[^ ]*: static/' >"$folder/globals"
empty "no variable outside functions" "$folder/globals"

for file in src/*.[ch] src/host/*.[ch] include/*.h tests/*.[ch] examples/*.c; do
    if ! head -n 1 "$file" | grep -q '^/\* .'; then echo "$file: $(head -n 1 "$file")"; fi
done >"$folder/first"
for file in tests/*.sh examples/*.sh; do
    if ! sed -n 2p "$file" | grep -q '^# .'; then echo "$file"; fi
done >>"$folder/first"
empty "every file says first what it is" "$folder/first"

wc -l src/*.[ch] src/host/*.[ch] include/*.h |
    awk '$2 != "total" && $1 > 500' >"$folder/long"
empty "no file of the library or the command has more than 500 lines" "$folder/long"

# ---- compilers -------------------------------------------------------------------------------------------

# compiler, more flags
compile() {
    for file in src/*.c; do
        "$1" -std=c99 -ffreestanding -O2 -Wall -Wextra -Wconversion -Wshadow -Wvla -Wmissing-prototypes -Wstrict-prototypes \
            -pedantic -Werror -Iinclude $2 -c "$file" -o "$folder/object.o" || echo "$file"
    done >"$folder/warnings" 2>&1
    empty "$1 ${2:+$2 }compiles the core without a warning" "$folder/warnings"
}

for compiler in gcc clang; do
    if have $compiler; then
        compile $compiler ''
        compile $compiler -DCAGE_LIMBS
    else
        echo "      no $compiler here"
    fi
done
if have c++; then
    c++ -Wall -Wextra -pedantic -Werror -fsyntax-only -x c++ include/cage.h >"$folder/warnings" 2>&1
    empty "the header is C++ too" "$folder/warnings"
fi

# ---- who calls whom --------------------------------------------------------------------------------------

. tests/calls.sh

if have gcc && have objdump && call_graph "$folder/plain" '' -O0; then
    awk '$1 == $2 { print $1, "calls itself" }' "$folder/plain/calls" >"$folder/loops"
    tsort "$folder/plain/calls" 2>&1 >"$folder/order" | sed -n 's/^tsort: //p' | grep -v 'input contains a loop' >>"$folder/loops"
    empty "no recursion" "$folder/loops"
    call_graph "$folder/fast" '' -O2
    awk '$3 == "dynamic" { print $1, $3 }' "$folder/fast/frames" >"$folder/dynamic"
    empty "no array of variable length: every frame is of known size" "$folder/dynamic"
    sort -k2,2nr "$folder/fast/frames" | head -n 1 | awk '{ printf "      largest frame: %s bytes, %s\n", $2, $1 }'
    deepest "$folder/fast" | sed 's/^\([0-9]*\)/      deepest stack with -O2: \1 bytes,/'
else
    echo "      no gcc 10 with objdump here: recursion and stack not looked at"
fi

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
