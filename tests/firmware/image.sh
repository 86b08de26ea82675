#!/bin/sh
# Build the core and the image of tests/firmware/main.c for one machine, run it, and compare what it prints with expected.txt.
# usage: sh tests/firmware/image.sh TARGET     at the top of the repository; leaves all in build/firmware/TARGET
. tests/firmware/targets.sh
. tests/calls.sh
target "$1" || exit 1
out=build/firmware/$1
rm -rf "$out"
call_graph "$out/core" "$PREFIX" "-Os -ffunction-sections -fdata-sections -Wall -Wextra -pedantic -Werror $FLAGS" || {
    echo "$1: the core does not compile"
    exit 1
}
"${PREFIX}gcc" -std=c99 -Os -Wall -Wextra $FLAGS $LINK -Iinclude tests/firmware/main.c "$out"/core/*.o -Wl,--gc-sections \
    -o "$out/image" || exit 1
$RUN "$out/image" >"$out/printed" 2>"$out/errors" </dev/null || {
    echo "$1: the image failed"
    cat "$out/printed" "$out/errors"
    exit 1
}
grep -v '^here: ' "$out/printed" | diff tests/firmware/expected.txt - || exit 1

text=$("${PREFIX}size" "$out"/core/*.o | awk 'NR > 1 { sum += $1 } END { print sum }')
stack=$(deepest "$out/core" | sed 's/ .*//')
ask=$(deepest "$out/core" cage_atlas_ask | sed 's/ .*//')
awk -v name="$1" -v text="$text" -v stack="$stack" -v ask="$ask" '
    /^all: / { gsub(",", ""); for (i = 1; i < NF; i++) v[$i] = $(i + 1) }
    /^here: / { gsub(",", ""); arena = $3; worst = $6 }
    END { printf "%-11s %7d %6d %6d %9d %6d %6d %12s  %s\n", name, text, stack, ask, arena, v["steps"], v["step"],
                 worst == 0 ? "-" : worst, v["hash"] }' "$out/printed" >"$out/row"
