#!/bin/sh
# What the tests need: install it when that is allowed, else say what to install.
missing=
need() { # PROGRAM PACKAGE
    command -v "$1" > /dev/null 2>&1 || missing="$missing $2"
}
need cc gcc
need pkg-config pkg-config
need valgrind valgrind
need python3 python3
printf '#include <check.h>\nint main(void) { return 0; }\n' | cc -x c -fsyntax-only - 2> /dev/null || missing="$missing check libsubunit-dev"
printf '#include <gmp.h>\nint main(void) { return 0; }\n' | cc -x c -fsyntax-only - 2> /dev/null || missing="$missing libgmp-dev"
[ -z "$missing" ] && exit 0
if [ "$(id -u)" = 0 ] && command -v apt-get > /dev/null 2>&1; then
    echo "installing:$missing"
    DEBIAN_FRONTEND=noninteractive
    export DEBIAN_FRONTEND
    apt-get update -qq > /dev/null && apt-get install -y -qq $missing > /dev/null && exit 0
fi
echo "The tests need these packages: apt-get install$missing" >&2
exit 1
