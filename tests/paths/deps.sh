#!/bin/sh
# What check-paths needs besides the tests' own: installed when that is allowed.
. tests/missing.sh
need_header() { # HEADER PACKAGE
    printf '#include <%s>\nint main(void) { return 0; }\n' "$1" |
        cc -I/usr/include/suitesparse -x c -fsyntax-only - 2> /dev/null && return
    case $missing in *" $2"*) ;; *) missing="$missing $2" ;; esac
}
need_header cholmod.h libsuitesparse-dev
need_header btf.h libsuitesparse-dev
need_header ccd/ccd.h libccd-dev
need valgrind valgrind
install_missing "check-paths needs"
