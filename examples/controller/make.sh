#!/bin/sh
# Make the supervisor's atlases with build/cage, as C arrays, and its program.
# usage: sh examples/controller/make.sh OUT [COMPILER AND FLAGS]   at the top of the repository, after `make`: OUT/supervisor
here=examples/controller
out=$1
shift
[ $# -gt 0 ] || set -- cc -O2
mkdir -p "$out" || exit 1

# One atlas for each margin: every radius smaller by that much, balls smaller than it gone.
number=0
: >"$out/list"
for margin in 0 0.125 0.25 0.5; do
    for file in part gripper; do
        awk -v by=$margin '/^#/ { next } $3 >= by { print $1, $2, $3 - by }' $here/$file.xyzr >"$out/$file.xyzr"
    done
    build/cage atlas --object "$out/part.xyzr" --obstacles "$out/gripper.xyzr" --unit 0.001 --side inner --level 5 --quiet \
        -o "$out/$number.atlas" --c-header "$out/atlas_$number.h" || exit 1
    echo "$number $margin" >>"$out/list"
    number=$((number + 1))
done
{
    echo '/* flash.h: the atlases, in the order of their margins; written by make.sh. */'
    while read -r number margin; do
        echo "#define cage_atlas_bytes atlas_$number"
        echo "#include \"atlas_$number.h\""
        echo '#undef cage_atlas_bytes'
    done <"$out/list"
    awk '{ m = m sep $2 * 1000; b = b sep "atlas_" $1; s = s sep "sizeof atlas_" $1; sep = ", " }
        END { print "static const int32_t margin_um[] = {" m "};"
              print "static const unsigned char *const atlas_bytes[] = {" b "};"
              print "static const size_t atlas_size[] = {" s "};" }' "$out/list"
} >"$out/flash.h"
{
    echo '/* scene.h: the drawings in micrometres; written by make.sh. */'
    for file in part gripper; do
        echo "static const cage_ball $file[] = {"
        awk '!/^#/ { printf "    {%d, %d, 0, %d},\n", $1 * 1000, $2 * 1000, $3 * 1000 }' $here/$file.xyzr
        echo '};'
    done
} >"$out/scene.h"

"$@" -std=c99 -Iinclude -I"$out" $here/main.c $here/supervisor.c src/*.c -o "$out/supervisor"
