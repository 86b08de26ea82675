#!/bin/sh
# The core keeps MISRA C:2012 as far as cppcheck can tell, but for the rules in misra.txt; and has no recursion, says clang-tidy.
# usage: sh tests/firmware/misra.sh      at the top of the repository
out=build/firmware/misra
rm -rf "$out"
mkdir -p "$out"
sed -n 's/^\(misra-[^ ]*\) .*/\1/p' tests/firmware/misra.txt >"$out/rules"
cp -R src include "$out" # cppcheck writes beside what it reads
(cd "$out" && cppcheck --std=c99 --addon=misra --platform=unix32 -Iinclude --suppress=missingIncludeSystem \
    --suppressions-list=rules --quiet --template='{file}:{line}: {id}' src/*.c 2>found) || exit 1
if grep misra "$out/found"; then
    echo 'MISRA rules that misra.txt gives no reason to break'
    exit 1
fi
for rule in $(cat "$out/rules"); do # and no reason is given for nothing
    echo "$rule"
done | sort | uniq -d | grep . && exit 1
echo "note: cppcheck: no deviation from MISRA C:2012 beyond the $(grep -c . "$out/rules") rules in tests/firmware/misra.txt"
clang-tidy --quiet -checks='-*,misc-no-recursion' -warnings-as-errors='*' src/*.c -- -std=c99 -ffreestanding -Iinclude || exit 1
echo 'note: clang-tidy: no recursion'
