#!/bin/sh
# The controller example, here and on a Cortex-M4 with the tick as an interrupt: the decisions of the geometry, and none late.
# usage: sh tests/firmware/controller.sh      at the top of the repository, after `make`
. tests/firmware/targets.sh
out=build/firmware/controller
rm -rf "$out"
mkdir -p "$out"
# The bar's balls (radius 8) are 3 before and behind its middle, which is at -22 + 0.26 tick. Shrunk by 0.5 they touch the neck's
# (radius 10, at 0, +-16.5) from sqrt(17^2 - 16.5^2) = 4.093 before it: tick 57.3. Shrunk by 0.125 they leave it 6.543 behind it:
# tick 121.3, and touch the mouth's, at 45, +-17.5, from 2.969 before it: tick 234.7, or a little sooner, as the bar turns.
cat >"$out/expected" <<'END'
tick   0: caged, margin at least 500 um: lift
tick  58: not proved to be caged: do not lift
tick 122: caged, margin at least 125 um: do not lift
tick 233: not proved to be caged: do not lift
END
sh examples/controller/make.sh "$out/host" gcc -O2 -Wall -Wextra -Wconversion -pedantic -Werror || exit 1
"$out/host/supervisor" >"$out/host.printed" || exit 1
target cortex-m4
sh examples/controller/make.sh "$out/arm" "${PREFIX}gcc" -Os -ffunction-sections -Wl,--gc-sections $FLAGS $LINK || exit 1
$RUN "$out/arm/supervisor" >"$out/arm.printed" </dev/null || {
    cat "$out/arm.printed"
    exit 1
}
for name in host arm; do
    grep '^tick' "$out/$name.printed" | diff "$out/expected" - || exit 1
    grep -q '^proof: CAGED after 21 steps' "$out/$name.printed" || exit 1
done
sed -n 's/^\(time\|proof\): /note: on a Cortex-M4, 1 ns for an instruction: &/p' "$out/arm.printed"
grep -q 'ticks late 0;' "$out/arm.printed"
