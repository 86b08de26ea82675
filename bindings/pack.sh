#!/bin/sh
# Make packages of the amalgamated library: each is its two files, licence and README, and the static files of one folder here.
# usage: [URL=...] sh bindings/pack.sh DIST OUT     at the top of the repository; DIST holds cage.c and cage.h
dist=$1
out=$2
url=${URL:-https://libcage.invalid/} # say where it is published; the packs' formats want an address
version=$(sed -n 's/^#define CAGE_VERSION "\(.*\)"/\1/p' include/cage.h)
rm -rf "$out"
mkdir -p "$out" || exit 1

# NAME FOLDER-FOR-SOURCE FOLDER-FOR-HEADER, then pairs of file here and place in the package
package() {
    name=$1
    here=$out/$name
    mkdir -p "$here/$2" "$here/$3"
    cp "$dist/cage.c" "$here/$2/" && cp "$dist/cage.h" "$here/$3/" && cp LICENSE README.md "$here/" || exit 1
    shift 3
    while [ $# -gt 0 ]; do
        mkdir -p "$here/$(dirname "$2")"
        sed -e "s|@VERSION@|$version|" -e "s|@URL@|$url|" -e "s|@DATE@|$(date -u +%Y-%m-%d)|" "bindings/$1" >"$here/$2" || exit 1
        shift 2
    done
}

package zephyr src include zephyr/module.yml zephyr/module.yml zephyr/CMakeLists.txt CMakeLists.txt zephyr/Kconfig Kconfig
package esp-idf src include esp-idf/CMakeLists.txt CMakeLists.txt esp-idf/idf_component.yml idf_component.yml
package arduino src src platformio/library.json library.json platformio/library.properties library.properties
package cmsis src include cmsis/libcage.libcage.pdsc libcage.libcage.pdsc

for name in zephyr esp-idf arduino; do
    tar -C "$out" -czf "$out/libcage-$name-$version.tar.gz" --transform "s|^$name|libcage|" "$name" || exit 1
done
(cd "$out/cmsis" && python3 -m zipfile -c "../libcage.libcage.$version.pack" ./*) || exit 1
