#!/bin/sh
# Run all tests two at a time: natively, under ASan + UBSan, under Valgrind, and the scripts; end with "N passed, N failed".
out=build/test/out
rm -rf "$out"
mkdir -p "$out"

count=0
add() { # NAME COMMAND
    count=$((count + 1))
    id=$(printf '%03d' $count)
    echo "$1" > "$out/$id.name"
    echo "$2" > "$out/$id.sh"
}

quick='CK_FORK=no CAGE_TEST_QUICK=10'
slow='CK_FORK=no CAGE_TEST_QUICK=40'
memcheck='valgrind -q --suppressions=tests/libgomp.supp --error-exitcode=9 --leak-check=full --errors-for-leak-kinds=all'
add "the core's gates" "sh tests/gates.sh" # takes longest: first
for source in tests/test_*.c; do
    test=$(basename "$source" .c)
    add "$test" "build/test/$test"
    add "$test, ASan and UBSan" "$quick CAGE_TEST_SCENES=20 build/sanitized/$test"
done
for name in wide arena component glue store pose refuse; do
    part=$slow
    if [ $name = component ]; then part=$quick; fi # it asks how many of its scenes were decided
    add "test_$name, Valgrind" "$part CAGE_TEST_SCENES=2 $memcheck build/test/test_$name"
done
add "the command, Valgrind" "$memcheck build/cage prove --object examples/walls/plus.xyzr --obstacles examples/walls/walls_R10.xyzr \
  --start 300,320,45 --svg build/test/walls.svg --json"
add "the command in space, Valgrind" "$memcheck build/cage prove --object examples/space/guest.xyzr \
  --obstacles examples/space/shell_moved.xyzr --start 1,-2,0.5,0.5,0.1,-0.7,0.5 --threads 2 --ply build/test/shell.ply"
add "the command" "sh tests/cli.sh build/cage"
add "the README" "sh tests/readme.sh"
add "installation" "sh tests/install.sh"
add "the demo" "sh examples/demo.sh build/cage build/test/demo"

ls "$out"/*.sh | xargs -P 2 -I{} sh -c 's=$(date +%s); sh "{}" > "{}.out" 2>&1; echo $? $(($(date +%s) - s)) > "{}.status"'

passed=0
failed=0
for script in "$out"/*.sh; do
    read -r status seconds < "$script.status"
    name=$(cat "${script%.sh}.name")
    if [ "$status" = 0 ]; then
        passed=$((passed + 1))
        echo "ok    $name (${seconds} s)"
        grep -hE '^(answers|components|glue|rebuilt|note): ' "$script.out" | sed 's/^/      /'
    else
        failed=$((failed + 1))
        echo "FAIL  $name (${seconds} s)"
        tail -n 40 "$script.out"
    fi
done
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
