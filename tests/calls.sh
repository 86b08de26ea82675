#!/bin/sh
# Who calls whom in the core, and how deep that makes the stack: functions for other scripts, which source this file.

# call_graph FOLDER PREFIX FLAGS: compile the core with PREFIXgcc and write FOLDER/calls ("caller callee") and FOLDER/frames
# ("function bytes kind"). A call through a pointer may go to any function of a file that has functions in a table
# (tables of jumps look alike: none); but in a file that calls shortcuts->NAME it goes to cage_NAME (see shortcuts.h).
call_graph() {
    rm -rf "$1"
    mkdir -p "$1"
    for file in src/*.c; do
        name=$(basename "$file" .c)
        "$2gcc" -std=c99 -ffreestanding $3 -fno-jump-tables -Iinclude -fcallgraph-info=su \
            -c "$file" -o "$1/$name.o" 2>/dev/null || return 1
        "$2nm" "$1/$name.o" | awk '$2 ~ /[tT]/ { print $3 }' >"$1/functions"
        if "$2objdump" -r "$1/$name.o" | awk 'FILENAME != "-" { is[$1] = 1; next }
            /RECORDS FOR/ { data = /\.(s?data|s?rodata)/ }
            data && NF == 3 { to = $3; sub(/[+-]0x.*/, "", to); if (to ~ /^\.text/ || to in is) found = 1 }
            END { exit !found }' "$1/functions" -; then
            sed -n 's/^node: { title: "\([^"]*\)".* bytes (.*/__indirect_call \1/p' "$1/$name.ci"
        fi
        grep -o 'shortcuts->[a-z_]*(' "$file" | sed 's/.*>\(.*\)(/cage_\1/' >"$1/taken"
        sed -n 's/^edge: { sourcename: "\([^"]*\)" targetname: "\([^"]*\)".*/\1 \2/p' "$1/$name.ci" |
            awk 'FILENAME != "-" { to[n++] = $1; next } $2 != "__indirect_call" || n == 0 { print; next }
                { for (i = 0; i < n; i++) print $1, to[i] }' "$1/taken" -
    done | sed 's|src/||g' | sort -u >"$1/calls"
    cat "$1"/*.ci | sed -n 's/^node: { title: "\([^"]*\)".*\\n\([0-9]*\) bytes (\([^)]*\)).*/\1 \2 \3/p' |
        sed 's|src/||g' | sort -u >"$1/frames"
    [ -s "$1/calls" ]
}

# deepest FOLDER [FUNCTION...]: the most stack, in bytes, that one of these (or any) takes with all that it calls, and by which
# calls. What the compiler brings along itself (divisions, copies) is not counted. Longest paths by repeated relaxation: there is
# to be no recursion; a call to itself counts once more.
deepest() {
    graph=$1
    shift
    awk -v wanted=" $* " 'FILENAME ~ /frames/ { frame[$1] = deepest[$1] = $2; functions++; next }
         $1 == $2 { frame[$1] += frame[$1]; deepest[$1] = frame[$1]; next }
                  { from[n] = $1; to[n++] = $2 }
         END { for (round = 0; round < functions && (changed || round == 0); round++) {
                   changed = 0
                   for (i = 0; i < n; i++)
                       if (frame[from[i]] + deepest[to[i]] > deepest[from[i]]) {
                           deepest[from[i]] = frame[from[i]] + deepest[to[i]]; next_of[from[i]] = to[i]; changed = 1
                       }
               }
               for (f in deepest)
                   if ((wanted ~ /^ *$/ || index(wanted, " " f " ")) && (deepest[f] > worst || (deepest[f] == worst && f < at))) {
                       worst = deepest[f]; at = f
                   }
               printf "%d by", worst
               for (steps = 0; at != "" && steps < 40; steps++) { printf " %s", at; at = next_of[at] }
               print "" }' "$graph/frames" "$graph/calls"
}
