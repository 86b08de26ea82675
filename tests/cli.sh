#!/bin/sh
# The contract of the command, from outside: verdicts, exit codes, messages, options, JSON and pictures.
# usage: sh tests/cli.sh [COMMAND]       one line a case, then "N passed, N failed"; exit status 1 if any failed
#
# The truths are by construction. The fence is eight discs of radius 2.5 around a square of half side 4: neighbours
# overlap, so nothing gets out. Without the disc at (4,0) the gap is 8 - 5 = 3 wide, and a disc of diameter 2 leaves.
# The crate is the same in space, 26 balls of radius 2.5: no point of its sides is farther from a centre than 2.83, so no centre of a ball
# of radius 1 gets through. Without the ball at (4,0,0) four balls leave a gap 3 wide.

command=${1:-build/cage}
case $command in */*) ;; *) command=./$command ;; esac
passed=0
failed=0
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
trap 'exit 1' HUP INT TERM
LC_ALL=C
export LC_ALL

python=
if python3 -c 'import json, xml.dom.minidom' >/dev/null 2>&1; then python=python3; fi

# ---- scenes ---------------------------------------------------------------------------------------

# Name and exponent: the fence in units of that size, and the same with a gap.
fences() {
    awk -v s="$2" -v all="$folder/$1" -v gap="$folder/$1_gap" 'BEGIN {
        for (x = -4; x <= 4; x += 4) for (y = -4; y <= 4; y += 4) if (x != 0 || y != 0) {
            line = sprintf("%s%s %s%s 2.5%s", x, s, y, s, s)
            print line > all
            if (x != 4 || y != 0) print line > gap
        }
    }'
}

fences fence ''
fences small e-120
fences large e120
fences denormal e-310
echo '0 0 1' >"$folder/disc"
echo '0 0 1e-120' >"$folder/small_disc"
echo '0 0 1e120' >"$folder/large_disc"
echo '0 0 1e-310' >"$folder/denormal_disc"
printf '%s\n' '-0.9 0 0.5' '0 0 0.5' '0.9 0 0.5' >"$folder/bar"
awk -v all="$folder/crate" -v gap="$folder/crate_gap" 'BEGIN {
    for (x = -4; x <= 4; x += 4) for (y = -4; y <= 4; y += 4) for (z = -4; z <= 4; z += 4) if (x != 0 || y != 0 || z != 0) {
        print x, y, z, 2.5 > all
        if (x != 4 || y != 0 || z != 0) print x, y, z, 2.5 > gap
    }
}'
echo '0 0 0 1' >"$folder/ball"
printf '%s\n' '-0.5 0 0 0.5' '0.5 0 0 0.5' >"$folder/pair"
space=$(dirname "$0")/../examples/space
for file in guest shell sieve ring link; do cp "$space/$file.xyzr" "$folder/$file" || exit 1; done
home=0,0,0,1,0,0,0
: >"$folder/empty"

# ---- cases ----------------------------------------------------------------------------------------

pass() {
    passed=$((passed + 1))
    echo "ok    $case"
}

fail() {
    failed=$((failed + 1))
    echo "FAIL  $case: $1"
    sed 's/^/      out: /' "$folder/out" | head -n 5 | cut -c1-200
    sed 's/^/      err: /' "$folder/err" | head -n 5 | cut -c1-200
}

# The command on arguments: $code, and the files out and err.
call() {
    "$command" "$@" >"$folder/out" 2>"$folder/err" </dev/null
    code=$?
}

# name, object, obstacles, start, then options: one proof.
prove() {
    case=$1 object=$folder/$2 obstacles=$folder/$3 start=$4
    shift 4
    call prove --object "$object" --obstacles "$obstacles" --start "$start" "$@"
}

# Is $1 one of the rest?
among() {
    wanted=$1
    shift
    for word; do
        if [ "$word" = "$wanted" ]; then return 0; fi
    done
    return 1
}

# The verdicts that are true (or UNDEFINED where it may be): exit 0, and the first line is one of them.
says() {
    first=$(head -n 1 "$folder/out")
    if [ "$code" -ne 0 ]; then
        fail "exit status $code, not 0"
    elif among "$first" "$@"; then
        pass
    else
        fail "the first line is '$first', not $*"
    fi
}

# Exit status 2, nothing on standard output, and a message that matches.
refused() {
    if [ "$code" -ne 2 ]; then
        fail "exit status $code, not 2"
    elif [ -s "$folder/out" ]; then
        fail "standard output is not empty"
    elif ! grep -q -- "$1" "$folder/err"; then
        fail "no message like '$1'"
    else
        pass
    fi
}

# Passes if the test given is true.
holds() {
    if "$@"; then pass; else fail "not true: $*"; fi
}

# name, line, message, and the text of a file (a printf format): refused as object and as obstacles.
malformed() {
    # shellcheck disable=SC2059 # the text is a format on purpose: it holds octal escapes
    printf "$4" >"$folder/bad"
    prove "malformed object: $1" bad fence 0,0,0
    refused "^$folder/bad:$2: $3"
    prove "malformed obstacles: $1" disc bad 0,0,0
    refused "^$folder/bad:$2: $3"
}

# name, and the text of a file that is the disc: CAGED in the fence.
wellformed() {
    # shellcheck disable=SC2059
    printf "$2" >"$folder/good"
    prove "file: $1" good fence 0,0,0
    says CAGED
}

# ---- verdicts -------------------------------------------------------------------------------------

prove "verdict CAGED" disc fence 0,0,0
says CAGED
prove "verdict CAGED, a part that is no disc" bar fence 0,0,0
says CAGED
prove "verdict FREE" disc fence_gap 0,0,0
says FREE
prove "verdict FREE, a part that is no disc" bar fence_gap 0,0,0
says FREE
prove "verdict DISCONNECTED" disc fence 0,0,0 --goal 20,0,0
says DISCONNECTED
prove "verdict CONNECTED" disc fence_gap 0,0,0 --goal 20,0,0
says CONNECTED
prove "verdict CONNECTED, both inside" bar fence 0,0,0 --goal 0.05,0,180
says CONNECTED
prove "verdict CONNECTED, a short straight move inside" bar fence 0,0,0 --goal 0.05,0,0
says CONNECTED
prove "verdict CONNECTED, goal is start" disc fence 0,0,0 --goal 0,0,0
says CONNECTED
prove "verdict IN_COLLISION, start" disc fence 3,0,0
says IN_COLLISION
prove "verdict IN_COLLISION, goal" disc fence 0,0,0 --goal 3,0,0
says IN_COLLISION
prove "verdict UNDEFINED: the outer side cannot prove a cage" disc fence 0,0,0 --side outer --max-level 6
says UNDEFINED
prove "verdict UNDEFINED: the inner side finds no path" disc fence_gap 0,0,0 --side inner
says UNDEFINED
prove "touching is no collision" disc disc 2,0,0
says FREE
prove "a hair less than touching is" disc disc 1.999999,0,0
says IN_COLLISION

prove "space: verdict CAGED" ball crate $home
says CAGED
prove "space: verdict CAGED, a part that is no ball" pair crate 0,0,0,3,1,-2,0.5
says CAGED
prove "space: verdict FREE" ball crate_gap $home
says FREE
prove "space: verdict DISCONNECTED" ball crate $home --goal 20,0,0,1,0,0,0
says DISCONNECTED
prove "space: verdict CONNECTED" ball crate_gap $home --goal 20,0,0,1,0,0,0
says CONNECTED
prove "space: verdict CONNECTED, turned inside" pair crate $home --goal 0,0.05,0,1,1,1,1
says CONNECTED
prove "space: verdict IN_COLLISION, start" ball crate 3,0,0,1,0,0,0
says IN_COLLISION
prove "space: verdict IN_COLLISION, goal" ball crate $home --goal 3,0,0,1,0,0,0
says IN_COLLISION
prove "space: verdict UNDEFINED: the outer side cannot prove a cage" ball crate $home --side outer --max-level 2
says UNDEFINED
prove "space: touching is no collision" ball ball 0,0,2,1,0,0,0
says FREE
prove "space: a hair less than touching is" ball ball 0,0,1.999999,1,0,0,0
says IN_COLLISION
prove "space: the guest in the shell" guest shell $home
says CAGED
prove "space: the guest in the sieve" guest sieve $home
says FREE
prove "space: two rings apart" ring link 4,0,0,1,0,0,0
says FREE
prove "space: nothing at all" empty empty $home
says FREE

prove "--side inner proves a cage" bar fence 0,0,0 --side inner
says CAGED
prove "--side outer finds a path" bar fence_gap 0,0,0 --side outer
says FREE
prove "--side both" bar fence 0,0,0 --side both
says CAGED

# ---- unusual scenes -------------------------------------------------------------------------------

prove "empty object" empty fence 0,0,0
says FREE
prove "empty object warns" empty fence 0,0,0
holds grep -q 'empty has no balls' "$folder/err"
prove "empty obstacles" disc empty 0,0,0
says FREE
prove "nothing at all" empty empty 0,0,0
says FREE
prove "nothing at all, with a goal" empty empty 0,0,0 --goal 5,6,7
says CONNECTED
prove "one obstacle" bar disc 5,0,0
says FREE
prove "one obstacle, with a goal behind it" bar disc 5,0,0 --goal -5,0,0
says CONNECTED
prove "object larger than the world: the fence around a disc" fence disc 0,0,0
says CAGED
prove "object larger than the world, with a gap" fence_gap disc 0,0,0
says FREE
printf '0 0 1e-400\n' >"$folder/point"
prove "radius 1e-400 is 0: a point in the fence" point fence 0,0,0
says CAGED
prove "a point beside a point" point point 1,0,0
says FREE
prove "the smallest numbers: no false cage" denormal_disc denormal_gap 0,0,0
says FREE UNDEFINED
prove "the smallest numbers: no false path" denormal_disc denormal 0,0,0
says CAGED UNDEFINED
prove "a scene in units of 1e-120" small_disc small 0,0,0
says CAGED
prove "a scene in units of 1e-120, with a gap" small_disc small_gap 0,0,0
says FREE
prove "a scene in units of 1e120" large_disc large 0,0,0
says CAGED
prove "a scene in units of 1e120, with a gap" large_disc large_gap 0,0,0
says FREE
printf '0 0 1e149\n' >"$folder/vast"
prove "a radius of 1e149 over an object of 1: it collides" disc vast 0,0,0
says IN_COLLISION UNDEFINED
prove "a radius of 1e149, both" vast vast 0,0,0
says IN_COLLISION
printf '0 0 1e9\n4e9 0 1e9\n' >"$folder/wide"
prove "huge radii, far apart" wide wide 0,1e10,0
says FREE
prove "a pose far away" disc fence 1e100,1e100,0
says FREE UNDEFINED
prove "any number of turns" bar fence 0,0,36000
says CAGED
prove "a negative angle" bar fence_gap 0,0,-90
says FREE
i=0
while [ "$i" -lt 300 ]; do echo '0 0 1'; i=$((i + 1)); done >"$folder/same"
prove "300 balls at one place" same fence 0,0,0
says CAGED
prove "300 obstacles at one place" disc same 5,0,0
says FREE

# ---- files ----------------------------------------------------------------------------------------

malformed "missing column" 2 '2 columns' '0 0 1\n1 2\n'
malformed "one column" 1 '1 column;' '7\n'
malformed "5 columns" 3 '5 columns' '# three\n\n1 2 3 4 5\n'
malformed "letters" 1 "column 2: 'abc' is not a number" '0 abc 1\n'
malformed "letters after a number" 1 "column 3: '1x' is not a number" '0 0 1x\n'
malformed "hexadecimal" 1 "column 3: '0x10' is not a number" '0 0 0x10\n'
malformed "NaN" 2 "column 1: 'NaN' is not a finite number" '0 0 1\nNaN 0 1\n'
malformed "-nan" 1 "column 2: '-nan' is not a finite number" '0 -nan 1\n'
malformed "inf" 1 "column 3: 'inf' is not a finite number" '0 0 inf\n'
malformed "-Infinity" 1 "column 1: '-Infinity' is not a finite number" ' -Infinity 0 1\n'
malformed "1e308" 1 "column 1: '1e308' is too large" '1e308 0 1\n'
malformed "1e99999" 1 "column 3: '1e99999' is too large" '0 0 1e99999\n'
malformed "negative radius" 2 'the radius -1 is negative' '0 0 1\n0 0 -1\n'
malformed "mixed dimensions" 3 '4 columns, but line 2 has 3' '#\n0 0 1\n0 0 0 1\n'
malformed "two commas" 1 'column 2 is empty' '0,,1\n'
malformed "a comma first" 1 'column 1 is empty' ',0,0,1\n'
malformed "a comma last" 1 'nothing follows the last comma' '0,0,1,\n'
malformed "semicolons" 1 'column 1: ' '0;0;1\n'
malformed "no line end, then junk" 2 'column 1: ' '0 0 1\nq'
malformed "a zero byte" 1 'a zero byte' '0 0 1\000\n'
malformed "binary junk" 1 '' '\177ELF\002\001\001\000\000\377\376\r\033[31m\n'
malformed "junk is not printed raw" 1 "column 1: '?\\[31m' is not a number" '\033[31m 0 1\n'
malformed "UTF-16" 1 '' '\377\3760\000 \0000\000 \0001\000\n\000'
malformed "a minus that is none" 1 'column 1: ' '\342\210\2221 0 1\n'

awk 'BEGIN { for (i = 0; i < 3000; i++) printf "1 "; print "" }' >"$folder/bad"
prove "malformed object: a huge line" bad fence 0,0,0
refused "^$folder/bad:1: the line is longer than"
awk 'BEGIN { for (i = 0; i < 200000; i++) printf "1"; print "" }' >"$folder/bad"
prove "malformed obstacles: a number of 200000 digits" disc bad 0,0,0
refused "^$folder/bad:1: "

wellformed "CRLF" '# a disc\r\n\r\n0 0 1\r\n'
wellformed "commas" '0,0,1\n'
wellformed "commas and white space" '\t0 , 0\t,1  \n'
wellformed "comments" '# x y r\n0 0 1 # the disc\n   # no more\n'
wellformed "no line end" '0 0 1'
wellformed "signs and exponents" ' -0.0 +0e5 10.E-1\n'
wellformed "byte order mark" '\357\273\2770 0 1\n'
awk 'BEGIN { printf "#"; for (i = 0; i < 200000; i++) printf "x"; print "\n0 0 1" }' >"$folder/good"
prove "file: a huge comment" good fence 0,0,0
says CAGED
printf '# nothing\n\n   \n#\n' >"$folder/comments"
prove "file: only comments is an empty set" comments fence 0,0,0
says FREE

prove "a file that is not there" none fence 0,0,0
refused "^$folder/none: cannot be opened"
prove "a folder for a file" . fence 0,0,0
refused "^$folder/\\.: cannot be read"
prove "object in the plane, obstacles in space" disc ball 0,0,0
refused 'dimensions'
prove "a pose in space for a scene in the plane" disc fence 0,0,0,1,0,0,0
refused '--start'
prove "a goal in space for a scene in the plane" disc fence 0,0,0 --goal 0,0,0,1,0,0,0
refused '--goal'
prove "a pose in the plane for a scene in space" ball ball 0,0,0
refused '--start'

# ---- options --------------------------------------------------------------------------------------

# name, message, then the whole command line after "prove".
option() {
    case="option: $1" message=$2
    shift 2
    call prove "$@"
    refused "$message"
}

# name, message, then what comes after a complete query.
extra() {
    what=$1 message=$2
    shift 2
    option "$what" "$message" --object "$folder/disc" --obstacles "$folder/fence" --start 0,0,0 "$@"
}

option "none at all" '--object is missing'
option "no obstacles" '--obstacles is missing' --object "$folder/disc"
option "no start" '--start is missing' --object "$folder/disc" --obstacles "$folder/fence"
extra "unknown" "'--wobble' is not an option" --wobble 3
extra "a word" "'stray' is not an option" stray
extra "unknown letter" "'-x' is not an option" -x
extra "part of a name" "'--max' is not an option" --max 3
extra "missing value" '--goal needs a value' --goal
extra "missing value of --memory" '--memory needs a value' --memory
extra "twice" '--start is given twice' --start 0,0,0
extra "twice, with =" '--start is given twice' --start=0,0,0
extra "--side" "--side: 'left' is none of" --side left
extra "--max-level not a number" "--max-level: 'ten' is not a whole number" --max-level ten
extra "--max-level empty" "--max-level: '' is not a whole number" --max-level=
extra "--max-level not whole" '--max-level: ' --max-level 1.5
extra "--max-level negative" '--max-level: ' --max-level -1
extra "--max-level too large" '--max-level: ' --max-level 99
extra "--max-level much too large" '--max-level: ' --max-level 99999999999999999999999
extra "--max-cells too small" '--max-cells: ' --max-cells 1
extra "--max-cells too large" '--max-cells: ' --max-cells 2147483648
extra "--max-cells not a number" '--max-cells: ' --max-cells 0x10
extra "--memory not a number" '--memory: ' --memory lots
extra "--memory negative" '--memory: ' --memory -5
extra "--memory with a strange suffix" '--memory: ' --memory 5Q
extra "--memory beyond the machine" '--memory: ' --memory 99999999999999999G
extra "--unit zero" '--unit: ' --unit 0
extra "--unit negative" '--unit: ' --unit -1
extra "--unit not a number" '--unit: ' --unit metre
extra "--unit NaN" '--unit: ' --unit nan
extra "--unit too fine" '--unit 1e-30 is too fine' --unit 1e-30
extra "--goal of two numbers" '--goal: ' --goal 1,2
extra "--goal of letters" '--goal: ' --goal a,b,c
extra "--goal infinite" '--goal: ' --goal 1,inf,0
extra "--goal beyond all bounds" '--goal: ' --goal 1e308,0,0
extra "--goal empty" '--goal: ' --goal ''
extra "--svg into no folder" '--svg: ' --quiet --svg "$folder/none/picture.svg"
extra "--ply in the plane" '--ply: a mesh is of a scene in space' --ply "$folder/mesh.ply"

# The same in space.
space_extra() {
    what=$1 message=$2
    shift 2
    option "space: $what" "$message" --object "$folder/ball" --obstacles "$folder/crate" --start $home "$@"
}

space_extra "--max-level too large" "--max-level: '12' is not a whole number from 0 to 11" --max-level 12
space_extra "--max-cells too large" '--max-cells: .* from 4 to 16777216' --max-cells 16777217
space_extra "--max-cells too small" '--max-cells: .* from 4 to 16777216' --max-cells 3
space_extra "--ply into no folder" '--ply: .*cannot be written' --quiet --ply "$folder/none/mesh.ply"
space_extra "--ply that is a folder" '--ply: .*cannot be written' --quiet --ply "$folder"
space_extra "--svg into no folder" '--svg: .*cannot be written' --quiet --svg "$folder/none/picture.svg"
space_extra "--goal in the plane" '--goal' --goal 1,2,3
case="--ply in the plane leaves no file"
holds [ ! -e "$folder/mesh.ply" ]
prove "space: --max-level 11" ball crate $home --max-level 11
says CAGED
option "--start of two numbers" '--start: ' --object "$folder/disc" --obstacles "$folder/fence" --start 1,2
option "--start with a zero quaternion" '--start: ' --object "$folder/ball" --obstacles "$folder/ball" --start 5,0,0,0,0,0,0

prove "option: --name=value" disc fence 0,0,0 --side=inner --max-level=9
says CAGED
for name in --help -h; do
    case="$name"
    call $name
    holds grep -q '^usage: cage' "$folder/out"
    case="prove $name"
    call prove $name
    holds grep -q '^usage: cage prove' "$folder/out"
    case="prove $name ends well"
    holds [ "$code" -eq 0 ]
done
for word in CAGED DISCONNECTED FREE CONNECTED IN_COLLISION UNDEFINED --object --obstacles --start --goal --side \
    --max-level --max-cells --memory --unit --json --svg --ply --quiet; do
    if ! grep -q -- "$word" "$folder/out"; then missing="$missing $word"; fi
done
case="prove --help names every verdict and option"
holds [ -z "$missing" ]
case="--version"
call --version
holds grep -Eq '^cage [0-9]+\.[0-9]+\.[0-9]+$' "$folder/out"
case="no command"
call
refused '^usage: '
case="unknown command"
call dance
refused "'dance' is not a command"

# The installed name: cage-prove is cage prove.
ln -s "$(cd "$(dirname "$command")" && pwd)/$(basename "$command")" "$folder/cage-prove"
own=$command
command=$folder/cage-prove
case="cage-prove"
call --object "$folder/disc" --obstacles "$folder/fence" --start 0,0,0
says CAGED
case="cage-prove --help"
call --help
holds grep -q '^usage: cage prove' "$folder/out"
case="cage-prove --version"
call --version
holds grep -q '^cage [0-9]' "$folder/out"
case="cage-prove without options"
call
refused '--object is missing'
command=$own

# ---- limits ---------------------------------------------------------------------------------------

# A limit must never turn a truth around.
prove "--max-level 0 gives no false path" bar fence 0,0,0 --max-level 0
says CAGED UNDEFINED
prove "--max-level 0 gives no false cage" bar fence_gap 0,0,0 --max-level 0
says FREE UNDEFINED
prove "--max-cells 2 gives no false path" bar fence 0,0,0 --max-cells 2
says CAGED UNDEFINED
prove "--max-cells 2 gives no false cage" bar fence_gap 0,0,0 --max-cells 2
says FREE UNDEFINED
prove "--unit 0.5" disc fence 0,0,0 --unit 0.5
says CAGED
for unit in 0.3 1 1000 1e30; do
    prove "--unit $unit gives no false path" bar fence 0,0,0 --unit $unit
    says CAGED UNDEFINED
    prove "--unit $unit gives no false cage" bar fence_gap 0,0,0 --unit $unit
    says FREE UNDEFINED
done

prove "space: --max-level 0 gives no false path" pair crate $home --max-level 0
says CAGED UNDEFINED
prove "space: --max-level 0 gives no false cage" pair crate_gap $home --max-level 0
says FREE UNDEFINED
prove "space: --max-cells 4 gives no false path" pair crate $home --max-cells 4
says CAGED UNDEFINED
prove "space: --unit 0.5 gives no false cage" ball crate_gap $home --unit 0.5
says FREE UNDEFINED

# memory: exit 3 and a size; with that size, or after a few more such steps, the answer.
for scene in fence fence_gap; do
    bytes=1000
    rounds=0
    case="--memory $bytes is too small ($scene)"
    prove "$case" bar $scene 0,0,0 --memory $bytes
    holds [ "$code" -eq 3 ]
    case="and nothing is on standard output"
    holds [ ! -s "$folder/out" ]
    while [ "$code" -eq 3 ] && [ "$rounds" -lt 40 ]; do
        more=$(sed -n 's/^cage: memory: .*; try --memory \([0-9]*\)$/\1/p' "$folder/err")
        if [ "${more:-0}" -le "$bytes" ]; then break; fi
        bytes=$more
        rounds=$((rounds + 1))
        prove "with the $bytes bytes it asked for, $rounds sizes later ($scene)" bar $scene 0,0,0 --memory "$bytes"
    done
    if [ $scene = fence ]; then says CAGED; else says FREE; fi
done
prove "--memory 0" bar fence 0,0,0 --memory 0
holds [ "$code" -eq 3 ]
prove "--memory 64M" bar fence 0,0,0 --memory 64M
says CAGED
prove "--memory 65536k" bar fence 0,0,0 --memory 65536k
says CAGED

# ---- output ---------------------------------------------------------------------------------------

prove "--quiet prints the verdict and nothing else" disc fence 0,0,0 --quiet
holds [ "$(cat "$folder/out")" = CAGED ]
prove "--quiet does not warn" empty fence 0,0,0 --quiet
holds [ ! -s "$folder/err" ]
prove "without --quiet the reason follows" disc fence 0,0,0
holds [ "$(wc -l <"$folder/out")" -gt 3 ]
prove "no progress where standard error is no terminal" bar fence 0,0,0
holds [ ! -s "$folder/err" ]

keys='verdict reason dim unit start goal level cells slices gluings steps balls_inserted peak_bytes seconds path'

# The answer in out is one JSON object with every key, and its verdict is the one given.
json() {
    missing=
    for key in $keys; do
        if ! grep -q "\"$key\": " "$folder/out"; then missing="$missing $key"; fi
    done
    if [ "$code" -ne 0 ]; then
        fail "exit status $code"
    elif [ -n "$missing" ]; then
        fail "without$missing"
    elif ! grep -q "\"verdict\": \"$1\"" "$folder/out"; then
        fail "not $1"
    elif [ -n "$python" ] && ! python3 - "$folder/out" "$1" $keys 2>>"$folder/err" <<'END'
import json, math, sys
def no(constant):
    raise ValueError(constant)
with open(sys.argv[1]) as file:
    answer = json.load(file, parse_constant=no)
assert answer["verdict"] == sys.argv[2]
for key in sys.argv[3:]:
    assert key in answer, key
space = answer["dim"] == 3
assert answer["dim"] in (2, 3) and len(answer["pivot"]) == answer["dim"] and answer["unit"] > 0 and len(answer["start"]) == (3 if answer["dim"] == 2 else 7)
path = answer["path"]
assert (len(path) > 1) == (sys.argv[2] in ("FREE", "CONNECTED")), len(path)
for pose in path:
    assert len(pose) == len(answer["start"]) and all(math.isfinite(x) for x in pose)
if path:
    assert all(abs(a - b) < 1e-3 for a, b in zip(path[0][:answer["dim"]], answer["start"])), path[0]
if path and answer["goal"]:
    assert all(abs(a - b) < 1e-3 for a, b in zip(path[-1][:answer["dim"]], answer["goal"])), path[-1]
# Each leg either keeps the angle or turns about the pivot.
def pivot(pose):
    if not space:
        (x, y), a = answer["pivot"], math.radians(pose[2])
        return pose[0] + math.cos(a) * x - math.sin(a) * y, pose[1] + math.sin(a) * x + math.cos(a) * y
    w, v, p = pose[3], pose[4:], answer["pivot"]
    u = [2 * (v[k - 2] * p[k - 1] - v[k - 1] * p[k - 2]) for k in range(3)]
    return [pose[k] + p[k] + w * u[k] + v[k - 2] * u[k - 1] - v[k - 1] * u[k - 2] for k in range(3)]
def turn(a, b):
    if not space:
        return abs((a[2] - b[2] + 180) % 360 - 180)
    return math.degrees(2 * min(math.dist(a[3:], b[3:]), math.dist(a[3:], [-x for x in b[3:]])))
for pose in path:
    assert not space or abs(math.hypot(*pose[3:]) - 1) < 1e-12, pose
for a, b in zip(path, path[1:]):
    turned = turn(a, b) > 1e-5
    moved = math.dist(pivot(a), pivot(b)) > 1e-4
    assert not (turned and moved), (a, b)
END
    then
        fail "the JSON does not hold what it should"
    else
        pass
    fi
}

# The picture is well-formed XML and an SVG.
picture() {
    if [ ! -s "$folder/picture.svg" ] || ! grep -q '^<svg ' "$folder/picture.svg"; then
        fail "no picture"
    elif grep -Eiq '[="(, ]-?(nan|inf)' "$folder/picture.svg"; then
        fail "a number of the picture is not finite"
    elif [ -n "$python" ]; then
        holds python3 -c 'import sys, xml.dom.minidom as x; x.parse(sys.argv[1])' "$folder/picture.svg"
    elif xmllint --version >/dev/null 2>&1; then
        holds xmllint --noout "$folder/picture.svg"
    else
        pass
    fi
    rm -f "$folder/picture.svg"
}

# The mesh is an ASCII PLY with as many vertices and triangles as its header says, no more, and no other corners.
mesh() {
    if awk '
        NR == 1 && $0 != "ply" || NR == 2 && $0 != "format ascii 1.0" { bad = 1 }
        !body { if ($1 == "element") n[$2] = $3; if ($0 == "end_header") body = NR; next }
        NR - body <= n["vertex"] { if (NF != 7 || $0 ~ /[nN]/ || $4 > 255 || $7 > 255) bad = 1; next }
        { if (NF != 4 || $1 != 3 || $2 == $3 || $3 == $4 || $4 == $2) bad = 1
          for (k = 2; k <= 4; k++) if ($k !~ /^[0-9]+$/ || $k >= n["vertex"]) bad = 1 }
        END { exit bad || !body || n["vertex"] < 12 || NR - body != n["vertex"] + n["face"] }' "$folder/mesh.ply"; then
        pass
    else
        fail "the mesh is not what its header says"
    fi
    rm -f "$folder/mesh.ply"
}

# verdict, then as for prove, without the name: JSON and both pictures of a scene in space
shown_in_space() {
    verdict=$1 what="$2 in $3"
    shift
    prove "space: --json of $verdict, $what" "$@" --json --svg "$folder/picture.svg" --ply "$folder/mesh.ply" --quiet
    json "$verdict"
    case="space: three views of $verdict, $what"
    if [ "$(grep -c '<clipPath id="view[012]">' "$folder/picture.svg")" -eq 3 ]; then picture; else fail "not three views"; fi
    case="space: --ply of $verdict, $what"
    mesh
}

# verdict, then as for prove, without the name
shown() {
    verdict=$1 what="$2 in $3"
    shift
    prove "--json of $verdict, $what" "$@" --json --svg "$folder/picture.svg" --quiet
    json "$verdict"
    case="--svg of $verdict, $what"
    picture
}

shown CAGED bar fence 0,0,0
shown DISCONNECTED bar fence 0,0,0 --goal 20,0,0
shown FREE bar fence_gap 0,0,0
shown CONNECTED bar fence_gap 0,0,0 --goal 20,0,90
shown UNDEFINED bar fence 0,0,0 --side outer --max-level 6
shown IN_COLLISION bar fence 3,0,0
shown FREE disc empty 0,0,0
shown FREE empty empty 0,0,0
shown FREE point point 1,0,0
shown CAGED large_disc large 0,0,0
shown CAGED small_disc small 0,0,0
shown CAGED fence disc 0,0,0

shown_in_space CAGED guest shell $home
shown_in_space CAGED pair crate 0,0,0,3,1,-2,0.5
shown_in_space DISCONNECTED ball crate $home --goal 20,0,0,1,0,0,0
shown_in_space FREE guest sieve $home
shown_in_space FREE pair crate_gap $home
shown_in_space CONNECTED pair crate_gap $home --goal 20,0,0,1,1,1,1
shown_in_space UNDEFINED pair crate $home --side outer --max-level 2
shown_in_space IN_COLLISION ball crate 3,0,0,1,0,0,0
shown_in_space IN_COLLISION ball crate $home --goal 3,0,0,1,0,0,0
shown_in_space FREE ball empty $home
shown_in_space FREE ring link 4,0,0,1,0,0,0
echo '0 0 0 0' >"$folder/point3"
shown_in_space FREE point3 point3 1,0,0,1,0,0,0
prove "space: the text says how fine the cells are" guest shell $home
holds grep -Eq 'level [0-9]+ \(within [0-9.]+ degrees of its middle\)' "$folder/out"

prove "the same question gives the same answer" bar fence_gap 0,0,0 --json
grep -v seconds "$folder/out" >"$folder/first"
prove "the same question gives the same answer" bar fence_gap 0,0,0 --json
grep -v seconds "$folder/out" >"$folder/second"
holds cmp -s "$folder/first" "$folder/second"

# ---- margin ---------------------------------------------------------------------------------------

# Discs of radius 2.5, neighbours 4 apart, let one of radius 1 through when all shrink by more than (2 * 3.5 - 4) / 4; the gap,
# 8 wide from centre to centre, is closed when all grow by more than (8 - 2 * 3.5) / 4; it is as narrow as the start then.
if [ -n "$python" ]; then
    margin() {
        prove "$1" disc "$2" 0,0,0 --margin 14 --json
        holds $python -c 'import json, sys
r, right = json.load(open(sys.argv[1])), float(sys.argv[2])
assert right - 0.01 < r["margin"][0] < right < r["margin"][1] < right + 0.01, r
x, y = map(abs, r["narrow"][:2])
assert right < 0 or max(abs(max(x, y) - 4), abs(min(x, y) - 2)) < 0.1, r' "$folder/out" "$3"
    }
    margin "how tight the fence is" fence 0.75
    margin "how wide its gap is" fence_gap -0.25
fi
prove "the margin as text" disc fence 0,0,0 --margin 6
holds grep -q '^Margin  0\.[67][0-9]* to 0\.[78][0-9]*: closed with' "$folder/out"
prove "a margin is a number of proofs" disc fence 0,0,0 --margin x
refused '--margin: '

# ---- atlas and query -------------------------------------------------------------------------------

# name, object, obstacles, then options: one atlas, in $folder/atlas.
atlas() {
    case=$1 object=$folder/$2 obstacles=$folder/$3
    shift 3
    call atlas --object "$object" --obstacles "$obstacles" -o "$folder/atlas" "$@"
}

# name, expected verdict, options of cage query
query() {
    case=$1 expected=$2
    shift 2
    call query "$folder/atlas" "$@"
    says "$expected"
}

atlas "an atlas of the fence" bar fence --level 5
holds [ "$code" -eq 0 ]
holds grep -q '^Inner, .* classes' "$folder/out"
query "caged in the fence" CAGED --at 0,0,30
query "free outside of it" FREE --at 9,9,0
query "no way out" DISCONNECTED --at 0,0,30 --to 9,9,0
query "a turn on the spot" CONNECTED --at 0,0,0 --to 0,0,90
query "a pose of the fence" IN_COLLISION --at 4,4,0
query "a goal in the fence" IN_COLLISION --at 0,0,0 --to=4,4,0
case="a mesh of verdicts from standard input"
printf '0,0,0\n# nothing\n\n9,9,0 # outside\n0,0,0 9,9,0\t\n' | "$command" query "$folder/atlas" >"$folder/out" 2>"$folder/err"
holds [ "$(tr '\n' ' ' <"$folder/out")" = 'CAGED FREE DISCONNECTED ' ]
call query "$folder/atlas" --at 0,0,0 --to 9,9,0 --json
holds grep -qx '{"verdict": "DISCONNECTED", "at": \[[1-9][0-9]*, [1-9][0-9]*\], "to": \[0, 0\]}' "$folder/out"
case="one bad line is named"
printf '0,0,0\n0,0\n' | "$command" query "$folder/atlas" >"$folder/out" 2>"$folder/err"
code=$?
holds [ "$code" -eq 2 ]
holds grep -q '^cage: standard input:2: 2 numbers' "$folder/err"
case="an atlas has a dimension, a grid, a right form"
call query "$folder/atlas" --at $home
refused 'the atlas has 2 dimensions'
call query "$folder/atlas" --at 1e9,0,0
refused 'beyond the grid'
head -c 1000 "$folder/atlas" >"$folder/cut"
call query "$folder/cut" --at 0,0,0
refused "$folder/cut is not an atlas"
call query "$folder/fence" --at 0,0,0
refused 'is not an atlas'
call query "$folder/none" --at 0,0,0
refused 'cannot be read'
call query
refused 'FILE is missing'
call query "$folder/atlas" --to 0,0,0
refused '--at is missing'
call query "$folder/atlas" "$folder/atlas" --at 0,0,0
refused 'is not an option'
atlas "the inner side alone" bar fence --side inner --level 5 --quiet
holds [ "$code" -eq 0 ]
holds [ ! -s "$folder/out" ]
query "it proves cages" CAGED --at 0,0,30
query "and no ways" UNDEFINED --at 9,9,0
atlas "the outer side alone" bar fence --side outer --level 5 --quiet
query "it proves ways" FREE --at 9,9,0
query "and no cages" UNDEFINED --at 0,0,30
atlas "a budget" bar fence_gap --level 1 --budget 400 --quiet
query "decides what level 1 does not" FREE --at 0,0,0
atlas "too coarse" bar fence_gap --level 1 --quiet
query "as this one shows" UNDEFINED --at 0,0,0
atlas "in space" ball crate --level 0 --quiet
query "a cage" CAGED --at $home
query "the outside" FREE --at 9,0,0,1,0,0,0
atlas "no balls at all" empty empty --level 2 --quiet
query "all is free" FREE --at 0,0,0
atlas "as JSON" bar fence --level 4 --json
if [ -n "$python" ]; then
    holds $python -c 'import json, sys
r = json.load(open(sys.argv[1]))
assert r["dim"] == 2 and r["cells"] == 32 and len(r["inner"]) > 1 and len(r["outer"]) > 1, r
assert not r["inner"][0]["bounded"] and r["inner"][1]["bounded"] and len(r["inner"][1]["low"]) == 2, r
low, high = r["inner"][1]["low"], r["inner"][1]["high"]
assert all(-2.5 < a < -1 and 1 < b < 2.5 for a, b in zip(low, high)), r' "$folder/out"
fi
# What a bounded class of the side named has in all, at least and at most, from the JSON.
volumes() {
    $python -c 'import json, sys
r = json.load(open(sys.argv[1]))
v = [c["volume"] for c in r[sys.argv[2]] if c["bounded"]]
print(sum(a for a, b in v), sum(b for a, b in v))' "$folder/out" "$1"
}
if [ -n "$python" ]; then
    # Free poses counted one by one, as an average over the angles, against both sides: around is a pivot in the middle square.
    around=$(awk 'BEGIN {
        n = 64; pi = atan2(0, -1)
        for (t = 0; t < n; t++) for (i = 0; i < n; i++) for (j = 0; j < n; j++) {
            x = (i + 0.5) / n * 8 - 4; y = (j + 0.5) / n * 8 - 4; a = (t + 0.5) / n * 2 * pi; clear = 1
            for (k = -1; k <= 1 && clear; k++) for (u = -4; u <= 4 && clear; u += 4) for (v = -4; v <= 4; v += 4) {
                dx = x + 0.9 * k * cos(a) - u; dy = y + 0.9 * k * sin(a) - v
                if ((u != 0 || v != 0) && dx * dx + dy * dy < 9) { clear = 0; break }
            }
            sum += clear
        }
        print sum / n / n / n * 64
    }')
    atlas "volumes on both sides of the true one" bar fence --level 8 --volumes 9 --json
    holds [ "$code" -eq 0 ]
    set -- $(volumes inner) $(volumes outer)
    holds awk -v v="$around" -v il="$1" -v ih="$2" -v ol="$3" -v oh="$4" \
        'BEGIN { exit !(v > 0.1 && ol > 0.8 * v && ol < 1.01 * v && ih > 0.99 * v && ih < 1.3 * v && il <= ih && ol <= oh && oh <= ih) }'
    around=$(awk 'BEGIN {
        n = 60
        for (i = 0; i < n; i++) for (j = 0; j < n; j++) for (l = 0; l < n; l++) {
            x = (i + 0.5) / n * 4 - 2; y = (j + 0.5) / n * 4 - 2; z = (l + 0.5) / n * 4 - 2; clear = 1
            for (u = -4; u <= 4 && clear; u += 4) for (v = -4; v <= 4 && clear; v += 4) for (w = -4; w <= 4; w += 4)
                if ((u != 0 || v != 0 || w != 0) && (x - u) ^ 2 + (y - v) ^ 2 + (z - w) ^ 2 < 12.25) { clear = 0; break }
            sum += clear
        }
        print sum / n / n / n * 64
    }')
    atlas "and in space, over all rotations" ball crate --level 1 --volumes 7 --json
    set -- $(volumes inner) $(volumes outer)
    holds awk -v v="$around" -v il="$1" -v ih="$2" -v ol="$3" -v oh="$4" \
        'BEGIN { exit !(v > 0.1 && ol > 0.6 * v && ol < 1.01 * v && il < 1.01 * v && ih > 0.99 * v && ih < 1.4 * v && oh > 0.99 * v) }'
fi
atlas "pictures of its classes" bar fence --level 4 --quiet --svg "$folder/classes"
holds [ "$code" -eq 0 ]
holds grep -q 'Inner class 1' "$folder/classes/inner-1.svg"
holds grep -q 'Outer class 1' "$folder/classes/outer-1.svg"
atlas "and meshes" ball crate --level 0 --quiet --ply "$folder/classes"
holds grep -q '^comment Inner class 1: obstacles grey' "$folder/classes/inner-1.ply"
atlas "no mesh in the plane" bar fence --ply "$folder/classes"
refused '--ply: a mesh is of a scene in space'
atlas "no folder there" bar fence --level 3 --svg "$folder/none/classes"
refused '.*none/classes cannot be made'
atlas "passages as JSON" bar fence --level 4 --passages 4 --json
if [ -n "$python" ]; then
    holds $python -c 'import json, sys
r = json.load(open(sys.argv[1]))
p = r["passages"]
assert len(p) > 0 and all(a["closed"] < a["open"] for a in p), p
assert all(a["narrow"] is None or len(a["narrow"]) == 3 for a in p), p
assert any(a["to"] == 0 and 0 < a["open"] < 1 for a in p), p' "$folder/out"
fi
atlas "as a C array" bar fence --level 4 --quiet --c-header "$folder/atlas.h"
if command -v cc >/dev/null 2>&1; then
    printf '#include "%s"\n#include <stdio.h>\nint main(void) { return fwrite(cage_atlas_bytes, 1, sizeof cage_atlas_bytes, stdout) == 0; }\n' \
        "$folder/atlas.h" >"$folder/array.c"
    cc -std=c99 "$folder/array.c" -o "$folder/array" && "$folder/array" >"$folder/again"
    holds cmp -s "$folder/atlas" "$folder/again"
fi
cp "$folder/atlas" "$folder/first"
atlas "the same again" bar fence --level 4 --quiet
holds cmp -s "$folder/atlas" "$folder/first"
atlas "in as little memory as will do" bar fence --level 4 --quiet --memory 100K
holds cmp -s "$folder/atlas" "$folder/first"
atlas "too little memory" bar fence --level 4 --memory 40K
holds [ "$code" -eq 3 ]
holds grep -q 'try --memory [0-9]' "$folder/err"
walls=$(dirname "$0")/../examples/walls
cp "$walls/plus.xyzr" "$walls/walls_R4.xyzr" "$folder/" || exit 1
atlas "an atlas that takes a while" plus.xyzr walls_R4.xyzr --level 9 --threads 1 --quiet
holds [ "$code" -eq 0 ]
cp "$folder/atlas" "$folder/first"
rm "$folder/atlas"
case="interrupted"
(
    "$command" atlas --object "$folder/plus.xyzr" --obstacles "$folder/walls_R4.xyzr" --level 9 --threads 1 -o "$folder/atlas" \
        >"$folder/out" 2>"$folder/err" </dev/null &
    child=$!
    sleep 0.3
    kill -TERM $child
    wait $child
)
code=$?
holds [ "$code" -eq 130 ]
holds grep -q '^cage: interrupted: the same command goes on from .*/atlas.facts$' "$folder/err"
holds [ ! -e "$folder/atlas" ]
cp "$folder/atlas.facts" "$folder/facts" || fail "no facts"
atlas "it goes on" plus.xyzr walls_R4.xyzr --level 9 --threads 2
holds [ "$code" -eq 0 ]
holds grep -q '^cage: going on from .*/atlas.facts$' "$folder/err"
holds cmp -s "$folder/atlas" "$folder/first"
holds [ ! -e "$folder/atlas.facts" ]
cp "$folder/facts" "$folder/atlas.facts"
atlas "not from facts of something else" plus.xyzr walls_R4.xyzr --level 3
holds [ "$code" -eq 0 ]
holds grep -q '^cage: warning: .*/atlas.facts is of another scene' "$folder/err"
rm -f "$folder/atlas.facts"
atlas "where a link leads" bar fence --level 2 --quiet
cp "$folder/atlas" "$folder/first"
mkdir "$folder/far"
echo nothing >"$folder/far/end"
ln -s far/end "$folder/pointer"
ln -s far/nowhere "$folder/dangling"
call atlas --object "$folder/bar" --obstacles "$folder/fence" --level 2 --quiet -o "$folder/pointer"
holds cmp -s "$folder/far/end" "$folder/first"
holds [ -L "$folder/pointer" ]
call atlas --object "$folder/bar" --obstacles "$folder/fence" --level 2 --memory 10 --quiet -o "$folder/dangling"
holds [ "$code" -eq 3 ]
holds [ -L "$folder/dangling" ]
holds [ ! -e "$folder/far/nowhere" ]
case="into a pipe"
mkfifo "$folder/pipe"
cat "$folder/pipe" >"$folder/piped" &
call atlas --object "$folder/bar" --obstacles "$folder/fence" --level 2 --quiet -o "$folder/pipe"
wait
holds cmp -s "$folder/piped" "$folder/first"
holds [ -p "$folder/pipe" ]
case="from a pipe"
cat "$folder/first" | "$command" query /dev/stdin --at 0,0,0 >"$folder/out" 2>"$folder/err"
holds grep -q CAGED "$folder/out"
echo mine >"$folder/atlas.part"
atlas "other files stay as they are" bar fence --level 2 --quiet
holds grep -qx mine "$folder/atlas.part"
atlas "not over its own input" bar fence --level 2 -o "$folder/bar"
refused '-o is given twice'
call atlas --object "$folder/bar" --obstacles "$folder/fence" -o "$folder/fence"
refused '-o: .*/fence is already used'
call atlas --object "$folder/bar" --obstacles "$folder/fence" -o "$folder/both" --c-header "$folder/both"
refused '--c-header: .*/both is already used'
atlas "quiet, with passages too" bar fence --level 2 --quiet --passages 1
holds [ "$code" -eq 0 ]
holds [ ! -s "$folder/out" ]
case="a zero byte among poses"
printf '0,0,0\0junk' | "$command" query "$folder/atlas" >"$folder/out" 2>"$folder/err"
code=$?
refused 'standard input:1: a byte that is zero'
case="poses that cannot be read"
"$command" query "$folder/atlas" <"$folder" >"$folder/out" 2>"$folder/err"
code=$?
refused 'standard input cannot be read'
case="a long comment among poses"
awk 'BEGIN { printf "#"; for (i = 0; i < 5000; i++) printf "x"; print "\n0,0,30" }' | "$command" query "$folder/atlas" >"$folder/out" 2>"$folder/err"
holds grep -q CAGED "$folder/out"
atlas "more cells than the budget" bar fence --level 4 --budget 61
refused '--budget: down to level 4 there are 62 cells'
atlas "too fine in space" ball crate --level 8
refused "--level: '8' is not a whole number from 0 to 7"
prove "a margin that is no power of two" disc fence 9,0,0 --unit 0.01 --margin 12
holds grep -q '^Margin  -' "$folder/out"
atlas "no budget without both sides" bar fence --side inner --budget 100
refused '--budget: .*--side must be both'
atlas "no such level" bar fence --level 15
refused "--level: '15' is not a whole number"
atlas "both of one dimension" bar crate
refused 'the object has 2 dimensions and the obstacles have 3'
call atlas --object "$folder/bar" --obstacles "$folder/fence"
refused '-o is missing'
call atlas --object "$folder/bar" --obstacles "$folder/fence" -o "$folder/none/atlas"
refused '-o: .*none/atlas cannot be written'
for name in atlas query; do
    case="help of $name"
    call $name --help
    holds grep -q "^usage: cage $name" "$folder/out"
done

if [ -c /dev/full ]; then
    case="a full disk is not taken for an answer"
    "$command" prove --object "$folder/disc" --obstacles "$folder/fence" --start 0,0,0 >/dev/full 2>"$folder/err"
    code=$?
    : >"$folder/out"
    refused 'cannot be written'
    prove "nor for a picture" disc fence 0,0,0 --quiet --svg /dev/full
    holds [ "$code" -eq 2 ]
    prove "nor for a mesh" ball crate $home --quiet --ply /dev/full
    refused '--ply: /dev/full could not be written whole'
fi

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
