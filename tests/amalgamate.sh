#!/bin/sh
# Write the whole library as two files, cage.c and cage.h: plain concatenation, each header once and after those it includes.
# usage: sh tests/amalgamate.sh FOLDER      at the top of the repository
out=$1
mkdir -p "$out" && cp include/cage.h "$out/cage.h" || exit 1
version=$(sed -n 's/^#define CAGE_VERSION "\(.*\)"/\1/p' include/cage.h)
headers=$(for file in src/*.h; do
    echo "$file $file"
    sed -n "s|^#include \"\(.*\)\"|src/\1 $file|p" "$file" | grep -v '^src/cage.h '
done | tsort) || exit 1
{
    echo "/* cage.c: libcage $version in one file, made of the files of src; goes with cage.h. */"
    cat src/*.h src/*.c | grep '^#include <' | sort -u
    echo '#include "cage.h"'
    for file in $headers src/*.c; do
        echo
        grep -v '^#include ' "$file" || exit 1
    done
} >"$out/cage.c"
