#!/bin/sh
# Run all firmware tests two at a time; end with a table of the machines and "N passed, N failed".
out=build/firmware/check
rm -rf "$out"
mkdir -p "$out"
. tests/firmware/targets.sh

count=0
add() { # NAME COMMAND
    count=$((count + 1))
    id=$(printf '%03d' $count)
    echo "$1" >"$out/$id.name"
    echo "$2" >"$out/$id.sh"
}
add "MISRA rules and recursion" "sh tests/firmware/misra.sh"
add "the two-file library and its packages" "sh tests/firmware/packages.sh"
for name in $targets; do
    add "the whole line on $name" "sh tests/firmware/image.sh $name"
done

add "budgets of size and stack" "sh tests/firmware/gates.sh"
add "the controller example" "sh tests/firmware/controller.sh"

ls "$out"/*.sh | xargs -P 2 -I{} sh -c 's=$(date +%s); sh "{}" > "{}.out" 2>&1; echo $? $(($(date +%s) - s)) > "{}.status"'

passed=0
failed=0
for script in "$out"/*.sh; do
    read -r status seconds <"$script.status"
    name=$(cat "${script%.sh}.name")
    if [ "$status" = 0 ]; then
        passed=$((passed + 1))
        echo "ok    $name (${seconds} s)"
        sed -n 's/^note: /      /p' "$script.out"
    else
        failed=$((failed + 1))
        echo "FAIL  $name (${seconds} s)"
        tail -n 40 "$script.out"
    fi
done

echo
echo 'target         text  stack    ask     arena  steps  balls   worst step  hash'
for name in $targets; do
    if [ -f "build/firmware/$name/row" ]; then cat "build/firmware/$name/row"; fi
done
cat <<END
text: of the whole core, -Os, with constants. stack: the most that any call takes; ask: cage_atlas_ask. arena: most bytes in use.
steps: of all scenes; in the worst of them so many balls were triangulated and, where counted, instructions executed.
END
echo
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
