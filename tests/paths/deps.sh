#!/bin/sh
# What check-paths needs besides the tests' own: install it when that is allowed, else say what to install.
missing=
need() { # HEADER PACKAGE
    printf '#include <%s>\nint main(void) { return 0; }\n' "$1" |
        cc -I/usr/include/suitesparse -x c -fsyntax-only - 2> /dev/null && return
    case $missing in *" $2"*) ;; *) missing="$missing $2" ;; esac
}
need cholmod.h libsuitesparse-dev
need btf.h libsuitesparse-dev
need ccd/ccd.h libccd-dev
command -v valgrind > /dev/null 2>&1 || missing="$missing valgrind"
[ -z "$missing" ] && exit 0
if [ "$(id -u)" = 0 ] && command -v apt-get > /dev/null 2>&1; then
    echo "installing:$missing"
    DEBIAN_FRONTEND=noninteractive
    export DEBIAN_FRONTEND
    apt-get update -qq > /dev/null && apt-get install -y -qq $missing > /dev/null && exit 0
fi
echo "check-paths needs these packages: apt-get install$missing" >&2
exit 1
