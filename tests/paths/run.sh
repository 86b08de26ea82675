#!/bin/sh
# Smooth paths and candidates: the judge's program, then the command's answers and files, also under Valgrind.
# usage: sh tests/paths/run.sh COMMAND     exit status 1 if anything fails
command=$1
failed=0
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
trap 'exit 1' HUP INT TERM

check() { # NAME COMMAND...
    name=$1
    shift
    if "$@"; then
        echo "ok    $name"
    else
        failed=$((failed + 1))
        echo "FAIL  $name"
    fi
}

check "paths, mutations and candidates" build/check_paths examples

t="--object examples/hooked_t/t.xyzr --obstacles examples/hooked_t/slot_wide.xyzr --start 0,0,0"
p="--object examples/space/peanut.xyzr --obstacles examples/space/chambers_wide.xyzr --start -3,0,0,0.707106781,0,0,0.707106781
   --goal 3,0,0,0.707106781,0,0.707106781,0 --max-level 1"
memcheck="valgrind -q --suppressions=tests/libgomp.supp --error-exitcode=9 --leak-check=full --errors-for-leak-kinds=all"

# The CSV: a header, times from 0 to 1 that grow, as many rows as the text says.
csv() { # COLUMNS
    awk -F, -v columns="$1" 'NR == 1 { if ($1 != "t" || NF != columns) exit 1; next }
        NF != columns || (NR > 2 && $1 <= t) || (NR == 2 && $1 != 0) { bad = 1; exit 1 }
        { t = $1 } END { exit bad || t != 1 || NR < 50 }' "$folder/path.csv"
}
smooth() { "$command" prove $t --smooth --path "$folder/path.csv" > "$folder/out" && grep -q 'smoothed: length' "$folder/out"; }
check "prove --smooth says so" smooth
check "its file in the plane" csv 6
json() {
    "$command" prove $t --smooth --json --svg "$folder/path.svg" > "$folder/json" &&
        python3 -c 'import json, sys
a = json.load(open(sys.argv[1]))
sys.exit(not (a["verdict"] == "FREE" and a["smooth"] and a["length"] < 0.9 * a["found_length"]))' "$folder/json"
}
check "--smooth --json --svg" json
space() {
    "$command" prove --object examples/space/guest.xyzr --obstacles examples/space/sieve.xyzr --start 0,0,0,1,0,0,0 --smooth \
        --path "$folder/path.csv" --ply "$folder/path.ply" --quiet > "$folder/out" && csv 11
}
check "its file in space" space
undefined() { [ "$("$command" prove $p --quiet)" = UNDEFINED ]; }
check "coarse cells decide nothing" undefined
becomes() { [ "$("$command" prove $p --smooth --quiet)" = CONNECTED ]; }
check "but the candidate is smoothed to a path" becomes
candidate() {
    "$command" prove $p --candidate --json > "$folder/json" &&
        python3 -c 'import json, sys
a = json.load(open(sys.argv[1]))
c = a["candidate"]
sys.exit(not (a["verdict"] == "UNDEFINED" and a["path"] == [] and len(c["steps"]) > 1 and len(c["path"]) > 1
              and c["collisions"]))' \
            "$folder/json"
}
check "it is shown, with where it collides" candidate
refuses() { ! "$command" prove $t --smooth --path "$folder/none/path.csv" 2> "$folder/err" && grep -q -- '--path' "$folder/err"; }
check "a file that cannot be written" refuses
check "Valgrind, smooth" $memcheck "$command" prove $t --smooth --path "$folder/path.csv" --quiet
check "Valgrind, candidate" $memcheck "$command" prove $t --max-level 1 --candidate
[ "$failed" -eq 0 ]
