#!/bin/sh
# The amalgamated pair compiles without a warning and answers like the tree; every package unpacks to files that build it.
# usage: sh tests/firmware/packages.sh      at the top of the repository
. tests/firmware/targets.sh
out=build/firmware/packages
rm -rf "$out"
mkdir -p "$out"
failed=0
# passes "what" COMMAND...
passes() {
    what=$1
    shift
    if "$@" >"$out/log" 2>&1; then
        echo "note: $what"
    else
        failed=1
        echo "FAIL  $what"
        head -n 20 "$out/log"
    fi
}

# ---- the pair ------------------------------------------------------------------------------------------
make -s amalgamation packages || exit 1
strict='-std=c99 -ffreestanding -pedantic -Wall -Wextra -Wconversion -Wshadow -Werror'
passes 'cage.c: gcc' gcc $strict -O2 -c build/dist/cage.c -o "$out/cage.o"
passes 'cage.c: gcc, limbs' gcc $strict -O2 -DCAGE_LIMBS -c build/dist/cage.c -o "$out/cage.o"
passes 'cage.c: clang' clang $strict -O2 -c build/dist/cage.c -o "$out/cage.o"
passes 'cage.c: clang, limbs' clang $strict -O2 -DCAGE_LIMBS -c build/dist/cage.c -o "$out/cage.o"
passes 'cage.h in C++' c++ -Wall -Wextra -pedantic -Werror -fsyntax-only -x c++ build/dist/cage.h

# The image of main.c with the pair instead of the tree prints the same.
whole_line() { # TARGET
    target "$1"
    "${PREFIX}gcc" $strict -Os $FLAGS -c build/dist/cage.c -o "$out/$1.o" &&
        "${PREFIX}gcc" -std=c99 -Os $FLAGS $LINK -Ibuild/dist tests/firmware/main.c "$out/$1.o" -o "$out/$1" &&
        $RUN "$out/$1" </dev/null 2>&1 | grep -v '^here: ' | diff tests/firmware/expected.txt -
}
for name in host host-limbs cortex-m3 rv64 s390x; do
    passes "cage.c: the whole line on $name" whole_line $name
done

# ---- packages ------------------------------------------------------------------------------------------
version=$(sed -n 's/^#define CAGE_VERSION "\(.*\)"/\1/p' include/cage.h)
holds() { # ARCHIVE FILE...: unpack it; these are all its files, and nothing in them is left to fill in
    archive=$1
    shift
    folder=$out/unpacked/$(basename "$archive")
    mkdir -p "$folder"
    case $archive in
    *.pack) python3 -m zipfile -e "$archive" "$folder" || return 1 ;;
    *) tar -C "$folder" -xzf "$archive" --strip-components=1 || return 1 ;;
    esac
    (cd "$folder" && find . -type f | sed 's|^\./||' | LC_ALL=C sort) >"$out/found"
    printf '%s\n' LICENSE README.md "$@" | LC_ALL=C sort | diff - "$out/found" || return 1
    cmp "$folder/src/cage.c" build/dist/cage.c || return 1
    ! grep -rlE '@[A-Z]+@' "$folder"
}
unpacked=$out/unpacked
zephyr=libcage-zephyr-$version.tar.gz idf=libcage-esp-idf-$version.tar.gz arduino=libcage-arduino-$version.tar.gz
pack=libcage.libcage.$version.pack
passes 'Zephyr module: files' holds "build/packages/$zephyr" CMakeLists.txt Kconfig include/cage.h src/cage.c zephyr/module.yml
passes 'ESP-IDF component: files' holds "build/packages/$idf" CMakeLists.txt idf_component.yml include/cage.h src/cage.c
passes 'Arduino and PlatformIO library: files' holds "build/packages/$arduino" \
    library.json library.properties src/cage.c src/cage.h
passes 'CMSIS-Pack: files' holds "build/packages/$pack" include/cage.h libcage.libcage.pdsc src/cage.c

passes 'Zephyr module: YAML' python3 -c \
    'import sys, yaml; assert yaml.safe_load(open(sys.argv[1]))["build"]["cmake"] == "."' "$unpacked/$zephyr/zephyr/module.yml"
passes 'ESP-IDF component: YAML' python3 -c \
    'import sys, yaml; assert yaml.safe_load(open(sys.argv[1]))["version"] == sys.argv[2]' \
    "$unpacked/$idf/idf_component.yml" "$version"
passes 'PlatformIO library: JSON' python3 -c \
    'import json, sys; assert json.load(open(sys.argv[1]))["version"] == sys.argv[2]' \
    "$unpacked/$arduino/library.json" "$version"
passes 'Arduino library: version' grep -qx "version=$version" "$unpacked/$arduino/library.properties"
names_in_pack() { # every file that the description names is in the pack
    python3 - "$1" <<'END'
import os, sys, xml.etree.ElementTree as tree
root = tree.parse(os.path.join(sys.argv[1], "libcage.libcage.pdsc")).getroot()
names = [f.get("name") for f in root.iter("file")] + [root.find("license").text]
assert len(names) == 5 and all(os.path.exists(os.path.join(sys.argv[1], n)) for n in names), names
END
}
passes 'CMSIS-Pack: the description names what is there' names_in_pack "$unpacked/$pack"

# The build files of Zephyr and ESP-IDF, with these systems' commands played by plain CMake.
with_stubs() { # FOLDER
    mkdir -p "$out/stub"
    cat >"$out/stub/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.16)
project(stub C)
set(CONFIG_LIBCAGE y)
macro(zephyr_include_directories)
  include_directories(\${ARGN})
endmacro()
macro(zephyr_library_named name)
  set(library \${name})
endmacro()
macro(zephyr_library_sources)
  add_library(\${library} STATIC \${ARGN})
endmacro()
macro(idf_component_register srcs source dirs folder)
  add_library(libcage STATIC \${source})
  target_include_directories(libcage PUBLIC \${folder})
endmacro()
add_subdirectory("$1" library)
END
    rm -rf "$out/stub/build"
    cmake -S "$out/stub" -B "$out/stub/build" && cmake --build "$out/stub/build" && [ -s "$out/stub/build/library/liblibcage.a" ]
}
passes 'Zephyr module: builds (commands played by CMake)' with_stubs "$PWD/$unpacked/$zephyr"
passes 'ESP-IDF component: builds (commands played by CMake)' with_stubs "$PWD/$unpacked/$idf"
passes 'Arduino library: builds' gcc -Os -I"$unpacked/$arduino/src" -c "$unpacked/$arduino/src/cage.c" -o "$out/cage.o"
passes 'CMSIS-Pack: builds' gcc -Os -I"$unpacked/$pack/include" -c "$unpacked/$pack/src/cage.c" -o "$out/cage.o"

# ---- CMake and pkg-config of an installation -----------------------------------------------------------
installed() {
    make -s install PREFIX=/usr DESTDIR="$PWD/$out/root" >/dev/null || return 1
    mkdir -p "$out/user"
    cp examples/prove_in_c.c "$out/user/"
    cat >"$out/user/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.16)
project(user C)
find_package(libcage $version REQUIRED)
add_executable(user prove_in_c.c)
target_link_libraries(user libcage::cage)
END
    cmake -S "$out/user" -B "$out/user/build" -DCMAKE_PREFIX_PATH="$PWD/$out/root/usr" && cmake --build "$out/user/build" &&
        "$out/user/build/user"
}
passes 'CMake: find_package, build, run' installed
with_pkg_config() {
    PKG_CONFIG_SYSROOT_DIR=$PWD/$out/root PKG_CONFIG_LIBDIR=$PWD/$out/root/usr/lib/pkgconfig
    export PKG_CONFIG_SYSROOT_DIR PKG_CONFIG_LIBDIR
    [ "$(pkg-config --modversion libcage)" = "$version" ] &&
        gcc examples/prove_in_c.c -I"$PWD/$out/root/usr/include" $(pkg-config --cflags --libs --static libcage) -static \
            -o "$out/user/static" &&
        "$out/user/static"
}
passes 'pkg-config: build, run' with_pkg_config
exit $failed
