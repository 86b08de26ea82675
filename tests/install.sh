#!/bin/sh
# An installed libcage works: header, both libraries, pkg-config file and command; and uninstall leaves no file.
# usage: sh tests/install.sh     at the top of the repository; exit status 1 if anything fails

cc=${CC:-cc}
make=${MAKE:-make}
passed=0
failed=0
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
trap 'exit 1' HUP INT TERM
tree=$folder/tree

# name, command: passes if it does; what it printed is shown if not.
check() {
    name=$1
    shift
    if "$@" >"$folder/printed" 2>&1; then
        passed=$((passed + 1))
        echo "ok    $name"
    else
        failed=$((failed + 1))
        echo "FAIL  $name"
        sed 's/^/      /' "$folder/printed" | tail -n 20
    fi
}

# Every file and link below a folder, sorted.
files() {
    (cd "$1" && find . ! -type d | sort)
}

# A path that make would quote or a relative one would hide mistakes: DESTDIR is absolute, PREFIX is /usr.
abi=$(sed -n 's/^#define CAGE_ABI \([0-9]*\).*/\1/p' include/cage.h)
version=$(sed -n 's/^#define CAGE_VERSION "\(.*\)".*/\1/p' include/cage.h)
mkdir "$tree"
check "make install" $make -s install DESTDIR="$tree" PREFIX=/usr
usr=$tree/usr
pc=$(find "$tree" -name libcage.pc | head -n 1)
for file in include/cage.h lib/libcage.a "lib/libcage.so.$abi" lib/libcage.so bin/cage-prove; do
    check "installs $file" test -e "$usr/$file"
done
check "installs libcage.pc" test -f "$pc"
check "cage-prove is executable" test -x "$usr/bin/cage-prove"
check "only the header of the interface" test "$(find "$usr/include" -type f | wc -l)" -eq 1
check "libcage.so is a link within its folder" test "$(readlink "$usr/lib/libcage.so")" = "libcage.so.$abi"
check "no file names the place it was built at" sh -c "! grep -lF '$tree' '$pc'"

# pkg-config, as a cross build would ask.
PKG_CONFIG_PATH=$(dirname "$pc")
PKG_CONFIG_LIBDIR=$PKG_CONFIG_PATH
PKG_CONFIG_SYSROOT_DIR=$tree
PKG_CONFIG_ALLOW_SYSTEM_CFLAGS=1
PKG_CONFIG_ALLOW_SYSTEM_LIBS=1
export PKG_CONFIG_PATH PKG_CONFIG_LIBDIR PKG_CONFIG_SYSROOT_DIR PKG_CONFIG_ALLOW_SYSTEM_CFLAGS PKG_CONFIG_ALLOW_SYSTEM_LIBS
if pkg-config --version >/dev/null 2>&1; then
    check "pkg-config finds libcage $version" test "$(pkg-config --modversion libcage)" = "$version"
    flags=$(pkg-config --cflags libcage)
    libs=$(pkg-config --libs libcage)
else
    echo "      no pkg-config here: flags by hand"
    flags=-I$usr/include
    libs="-L$usr/lib -lcage"
fi

# The example, copied away so that nothing of the repository is in reach.
cp examples/prove_in_c.c "$folder/"
cd "$folder" || exit 1
# shellcheck disable=SC2086 # flags are words
{
    check "compiles with '-I.../include'" $cc -std=c99 -Wall -Wextra -Werror -c prove_in_c.c $flags -o example.o
    check "links with the shared library" $cc example.o $libs -o shared
    check "links with the static library" $cc example.o -L"$usr/lib" -Wl,-Bstatic -lcage -Wl,-Bdynamic -o static
}
check "the shared program runs and proves a cage" sh -c "test \"\$(LD_LIBRARY_PATH='$usr/lib' ./shared)\" = CAGED"
check "the static program runs and proves a cage" sh -c 'test "$(./static)" = CAGED'
if command -v ldd >/dev/null 2>&1; then
    check "the shared program needs libcage.so.$abi" sh -c "LD_LIBRARY_PATH='$usr/lib' ldd ./shared | grep -q 'libcage.so.$abi'"
    check "the static program needs no libcage" sh -c '! ldd ./static | grep -q libcage'
fi

# What the header declares, comments left out: each a name before a parenthesis.
$cc -E -P "$usr/include/cage.h" | grep -v "^typedef .*);" | grep -oE 'cage_[a-z0-9_]+ *\(' | tr -d ' (' | sort >declared
check "the header declares functions, each once" sh -c 'grep -qx cage_prove_begin declared && ! uniq -d declared | grep .'
if command -v nm >/dev/null 2>&1; then
    nm -D --defined-only "$usr/lib/libcage.so.$abi" | awk '$NF !~ /^_/ { print $NF }' | sort >exported
    check "the shared library exports what the header declares, and nothing else" diff declared exported
    nm --defined-only "$usr/lib/libcage.a" | awk 'NF == 3 && $2 == "T" { print $3 }' | sort >defined
    check "the static library defines all of that, each once" sh -c 'comm -12 declared defined | diff declared - && ! uniq -d defined | grep .'
fi
{
    printf '%s\n' '#include <cage.h>' 'typedef void (*function)(void);' 'static const function all[] = {'
    sed 's/.*/    (function)&,/' declared
    printf '%s\n' '};' 'int main(void)' '{' '    unsigned i, missing = 0;' '    for (i = 0; i < sizeof all / sizeof *all; i++)' \
        '        missing += all[i] == 0;' '    return missing != 0;' '}'
} >all.c
# shellcheck disable=SC2086
{
    check "a program with all functions links with the shared library" $cc -Wall -Wextra -Werror all.c $flags $libs -o all-shared
    check "a program with all functions links with the static library" $cc -Wall -Wextra -Werror all.c $flags -L"$usr/lib" \
        -Wl,-Bstatic -lcage -Wl,-Bdynamic -o all-static
}
for program in all-shared all-static; do
    check "$program runs" env LD_LIBRARY_PATH="$usr/lib" "./$program"
done
if command -v c++ >/dev/null 2>&1; then
    printf '#include <cage.h>\nint main() { return cage_verdict_text(CAGE_CAGED)[0] != 67; }\n' >user.cpp
    # shellcheck disable=SC2086
    check "the header serves C++" c++ -Wall -Wextra -Werror user.cpp $flags -L"$usr/lib" -Wl,-Bstatic -lcage -Wl,-Bdynamic -o user
    check "and its program runs" ./user
fi

echo '0 0 1' >disc
printf '%s\n' '3 0 2' '0 3 2' '-3 0 2' '0 -3 2' >fingers
check "cage-prove proves a cage" sh -c "test \"\$('$usr/bin/cage-prove' --object disc --obstacles fingers --start 0,0,0 --quiet)\" = CAGED"
check "cage-prove --version" sh -c "test \"\$('$usr/bin/cage-prove' --version)\" = 'cage $version'"
check "cage-prove --help" "$usr/bin/cage-prove" --help
cd "$OLDPWD" || exit 1

files "$tree" >"$folder/first"
check "make install again" $make -s install DESTDIR="$tree" PREFIX=/usr
files "$tree" >"$folder/second"
check "and nothing more is there" cmp "$folder/first" "$folder/second"
mkdir -p "$usr/lib/pkgconfig"
echo other >"$usr/lib/other"
check "make uninstall" $make -s uninstall DESTDIR="$tree" PREFIX=/usr
files "$tree" >"$folder/left"
echo ./usr/lib/other >"$folder/wanted"
check "and only what was there before is left" diff "$folder/wanted" "$folder/left"

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
