#!/bin/sh
# Proves the example scenes and prints one table; pictures and full answers go to a folder.
# usage: sh examples/demo.sh COMMAND FOLDER       exit status 1 if any verdict is not the one expected

command=${1:-build/cage}
folder=${2:-build/demo}
examples=$(dirname "$0")
failed=0

mkdir -p "$folder" || exit 1

# The value of a name in a JSON answer, one line each.
value() {
    sed -n "s/^  \"$2\": \"*\\([^\"]*\\)\"*,\$/\\1/p" "$1"
}

# A pose by its name, from a folder's list.
at() {
    awk -v name="$2" '$1 == name { print $2 }' "$examples/$1/poses.txt"
}

row() {
    printf '%-14s %-29s %-13s %-13s %13s %8s  %s\n' "$@"
}

# scene, query in words, expected verdict, name of the picture, then options of cage prove
ask() {
    scene=$1 query=$2 expected=$3 name=$4
    shift 4
    if "$command" prove "$@" --json --quiet --svg "$folder/$name.svg" >"$folder/$name.json"; then
        verdict=$(value "$folder/$name.json" verdict)
    else
        verdict=error
    fi
    seconds=$(value "$folder/$name.json" seconds)
    slices=$(value "$folder/$name.json" slices | tr -d '[] ' | tr ',' '+')
    row "$scene" "$query" "$verdict" "$expected" "$slices" "$(printf '%.3f' "${seconds:-0}")" "$folder/$name.svg"
    [ "$verdict" = "$expected" ] || failed=$((failed + 1))
}

# radius, expected verdict, start, [goal]
walls() {
    goal=${4:+ to $4}
    ask "walls, R = $1" "$3$goal" "$2" "walls_R$1_$3${4:+_to_$4}" --object "$examples/walls/plus.xyzr" \
        --obstacles "$examples/walls/walls_R$1.xyzr" --start "$(at walls "$3")" ${4:+--goal "$(at walls "$4")"}
}

# folder, object, obstacles, expected verdict; all start at 0,0,0
small() {
    ask "$1" "$2 in $3" "$4" "$1_$3" --object "$examples/$1/$2.xyzr" --obstacles "$examples/$1/$3.xyzr" --start 0,0,0
}

# object, obstacles, expected verdict, start, [goal], [side]; a mesh is drawn as well
space() {
    ask space "$1 in $2" "$3" "space_$1_in_$2" --object "$examples/space/$1.xyzr" --obstacles "$examples/space/$2.xyzr" \
        --start "$(at space "$4")" ${5:+--goal "$(at space "$5")"} --side "${6:-both}" --ply "$folder/space_$1_in_$2.ply"
}

row scene query verdict expected "slices in+out" seconds picture
walls 4 CAGED hall
walls 4 CAGED chamber
walls 4 CAGED cubby
walls 4 FREE outside_below
walls 4 DISCONNECTED chamber hall
walls 4 DISCONNECTED cubby hall
walls 4 DISCONNECTED cubby outside_below
walls 4 CONNECTED hall_left hall_right
walls 4 CONNECTED outside_left outside_below
walls 10 CAGED hall
walls 10 CONNECTED chamber hall
walls 10 DISCONNECTED cubby hall
walls 15 CAGED hall
walls 15 CONNECTED cubby chamber
small hooked_t t slot_tight CAGED
small hooked_t t slot_hooked CAGED
small hooked_t t slot_wide FREE
small grasp part fingers_closed CAGED
small grasp part fingers_open FREE
small key key lock_locked CAGED
small key key lock_open FREE
space guest shell CAGED home
space guest shell_moved CAGED shell_moved
space guest sieve FREE home
space ring link FREE unlinked
space dumbbell_small hoop FREE home
space coin bank_narrow CAGED home
space coin bank_wide FREE home
space mug hook FREE home '' outer
space peanut chambers_narrow DISCONNECTED left_chamber right_chamber
space peanut chambers_wide CONNECTED left_chamber right_chamber outer
# These take from five seconds to minutes:
# space ell pot_closed CAGED in_pot
# space ell pot_open FREE in_pot '' outer
# space screw coil FREE home
# space dumbbell_large hoop CAGED home
# space ring link CAGED home
# space mug eye CAGED home

# How many large components (present in half of the cells or more) the inner slices have, as cells get finer.
echo
printf '%-8s %9s %9s %9s %9s  %s\n' walls 'level 2' 'level 3' 'level 4' 'level 5' 'together (large components of the inner slices)'
for radius in 4 10 15; do
    line=$(printf 'R = %-4s' $radius) total=0
    for level in 2 3 4 5; do
        "$command" atlas --object "$examples/walls/plus.xyzr" --obstacles "$examples/walls/walls_R$radius.xyzr" --side inner \
            --level $level --volumes 0 -o "$folder/walls_R$radius.atlas" --json >"$folder/walls_R$radius.json" || failed=$((failed + 1))
        large=$(awk -F'"cells": ' '/"cells":/ { n = $2 + 0; if (!all) all = n; else if (2 * n >= all) large++ } END { print large }' \
            "$folder/walls_R$radius.json")
        total=$(echo "$total $(value "$folder/walls_R$radius.json" seconds)" | awk '{ print $1 + $2 }')
        line="$line $(printf '%9s' "$large")"
    done
    printf '%s %8.3f s\n' "$line" "$total"
    [ "$radius:$large" = 4:4 ] || [ "$radius:$large" = 10:3 ] || [ "$radius:$large" = 15:2 ] || failed=$((failed + 1))
done

if [ "$failed" -gt 0 ]; then
    echo "$failed of the verdicts are not the ones expected" >&2
    exit 1
fi
