#!/bin/sh
# Run all tests: natively, under ASan + UBSan, under Valgrind, and the scripts; end with "N passed, N failed".
passed=0
failed=0
report=build/test/report
mkdir -p build/test
: > "$report"

# run NAME COMMAND...: one line each; the output of a failure is shown.
run() {
    name=$1
    shift
    if "$@" > build/test/out 2>&1; then
        passed=$((passed + 1))
        echo "ok    $name"
        grep -E '^(share|decided|note)' build/test/out | sed 's/^/      /'
    else
        failed=$((failed + 1))
        echo "FAIL  $name"
        tail -n 40 build/test/out
    fi
}

for test in build/test/test_*[!.o]; do
    case $test in *.o) continue ;; esac
    run "$(basename "$test")" "$test"
done

CK_FORK=no
CAGE_TEST_QUICK=1
CAGE_TEST_SCENES=40
export CK_FORK CAGE_TEST_QUICK CAGE_TEST_SCENES
for test in build/sanitized/test_*[!.o]; do
    case $test in *.o) continue ;; esac
    run "$(basename "$test") under ASan and UBSan" "$test"
done
CAGE_TEST_SCENES=8
for name in arena wide predicate order delaunay component glue answers; do
    test=build/test/test_$name
    [ -x "$test" ] || continue
    run "test_$name under Valgrind" valgrind -q --error-exitcode=9 --leak-check=full --errors-for-leak-kinds=all "$test"
done

for script in gates readme install; do
    run "$script.sh" sh tests/$script.sh
done
run "cli.sh" sh tests/cli.sh build/cage
run "cli.sh under Valgrind" valgrind -q --error-exitcode=9 --leak-check=full build/cage prove --object examples/walls/plus.xyzr \
    --obstacles examples/walls/walls_R10.xyzr --start 300,320,45 --svg build/test/walls.svg --json
run "demo.sh" sh examples/demo.sh build/cage build/test/demo

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
