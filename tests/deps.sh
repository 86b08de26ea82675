#!/bin/sh
# What the tests need: installed when that is allowed.
. tests/missing.sh
need cc gcc
need pkg-config pkg-config
need valgrind valgrind
need python3 python3
printf '#include <check.h>\nint main(void) { return 0; }\n' | cc -x c -fsyntax-only - 2> /dev/null || missing="$missing check libsubunit-dev"
printf '#include <gmp.h>\nint main(void) { return 0; }\n' | cc -x c -fsyntax-only - 2> /dev/null || missing="$missing libgmp-dev"
install_missing "The tests need"
