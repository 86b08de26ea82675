#!/bin/sh
# Smooth paths, candidates, true shapes: the programs that judge them, then the command's answers and files, also under Valgrind.
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
check "true shapes" build/check_parts "$folder/parts"
check "classes beside BTF" build/check_classes

t="--object examples/hooked_t/t.xyzr --obstacles examples/hooked_t/slot_wide.xyzr --start 0,0,0"
p="--object examples/space/peanut.xyzr --obstacles examples/space/chambers_wide.xyzr --start -3,0,0,0.707106781,0,0,0.707106781
   --goal 3,0,0,0.707106781,0,0.707106781,0 --max-level 1"
memcheck="valgrind -q --suppressions=tests/libgomp.supp --error-exitcode=9 --leak-check=full --errors-for-leak-kinds=all"

# The CSV: a header, times from 0 to 1 that grow, as many rows as the text says.
csv() { # COLUMNS
    awk -F, -v columns="$1" 'NR == 1 { if ($1 != "t" || NF != columns) exit 1; next }
        NF != columns || $NF != 1 || (NR > 2 && $1 <= t) || (NR == 2 && $1 != 0) { bad = 1; exit 1 }
        { t = $1 } END { exit bad || t != 1 || NR < 50 }' "$folder/path.csv"
}
smooth() { "$command" prove $t --smooth --path "$folder/path.csv" > "$folder/out" && grep -q 'smoothed: length' "$folder/out"; }
check "prove --smooth says so" smooth
check "its file in the plane" csv 7
json() {
    "$command" prove $t --smooth --json --svg "$folder/path.svg" > "$folder/json" &&
        python3 -c 'import json, sys
a = json.load(open(sys.argv[1]))
sys.exit(not (a["verdict"] == "FREE" and a["smooth"] and a["length"] < 0.9 * a["found_length"]))' "$folder/json"
}
check "--smooth --json --svg" json
space() {
    "$command" prove --object examples/space/guest.xyzr --obstacles examples/space/sieve.xyzr --start 0,0,0,1,0,0,0 --smooth \
        --path "$folder/path.csv" --ply "$folder/path.ply" --quiet > "$folder/out" && csv 12
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

# Two discs, and one that leaves them: parts that are the balls. A part of the object that the balls leave bare hits a wall.
echo '0 0 1' > "$folder/disc"
printf '%s\n' '-3 0 1' '3 0 1' > "$folder/posts"
printf '%s\n' 'object disc 1' 'obstacle disc 1 @ -3,0,0' 'obstacle disc 1 @ 3,0,0' > "$folder/same.parts"
{ echo 'object box 5 0.2'; cat "$folder/same.parts"; } > "$folder/wide.parts"
d="--object $folder/disc --obstacles $folder/posts --start 0,0,0"
parts() { # FILE CONDITION OPTIONS...
    file=$1 condition=$2
    shift 2
    "$command" prove "$@" --parts "$file" --json > "$folder/json" && python3 -c 'import json, sys
a = json.load(open(sys.argv[1]))
p = a["parts"]
sys.exit(not (p["proof"] is False and eval(sys.argv[2])))' "$folder/json" "$condition"
}
check "parts that are the balls" parts "$folder/same.parts" \
    'p["of"] == "path" and p["clear"] and p["least"] > 0.1 and p["object"] == [1, 0, 1024, 0] and p["obstacles"] == [2, 0, 2048, 0]' \
    $d
check "a part that collides" parts "$folder/wide.parts" \
    'p["of"] == "path" and p["clear"] is False and p["places"][0][-1] > 0.1 and p["object"][1] == 0 and p["object"][3] > 20' $d
check "a candidate with parts" parts examples/hooked_t/wide.parts 'p["of"] == "candidate" and p["clear"] is False' \
    $t --max-level 1 --candidate
check "balls that lie inside, and leave bare" parts examples/hooked_t/wide.parts \
    'p["object"][:2] == [27, 0] and p["obstacles"][:2] == [56, 0] and p["object"][3] > 0' $t --smooth
says_so() { "$command" prove $d --parts "$folder/same.parts" | grep -q 'by samples (libccd): no proof'; }
check "the text says what it is" says_so
refuses_parts() { ! "$command" prove $d --parts "$folder/none" 2> "$folder/err" && grep -q "^$folder/none" "$folder/err"; }
check "parts that cannot be read" refuses_parts

# Without the libraries the command is built, proves, and says what it is without.
bare() {
    cc -std=c99 -D_XOPEN_SOURCE=700 -O1 -Iinclude $(ls src/host/*.c | grep -vE '/(metric|parts|parts_balls)\.c') build/libcage.a \
        -lm -pthread -o "$folder/cage" && "$folder/cage" --help | grep -c 'by none' | grep -qx 2 &&
        [ "$("$folder/cage" prove $d --quiet)" = FREE ] || return 1
    for option in --smooth "--parts $folder/same.parts"; do
        "$folder/cage" prove $d $option > "$folder/out" 2> "$folder/err"
        [ $? = 2 ] && grep -q "^cage: ${option%% *}: this build is without" "$folder/err" || return 1
    done
}
check "a build without them" bare
check "Valgrind, parts" $memcheck build/check_parts "$folder/parts" quick
check "Valgrind, classes" $memcheck build/check_classes 2
check "Valgrind, the command with parts" $memcheck "$command" prove $t --smooth --parts examples/hooked_t/wide.parts --quiet
check "Valgrind, smooth" $memcheck "$command" prove $t --smooth --path "$folder/path.csv" --quiet
check "Valgrind, candidate" $memcheck "$command" prove $t --max-level 1 --candidate
[ "$failed" -eq 0 ]
