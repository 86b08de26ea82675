#!/bin/sh
# compare.sh: time libcage and CGAL in turn, on every set and on slices in space: compare.sh BENCH PEER [ROUNDS [FIRST LAST]].
set -eu
bench=$1 peer=$2 rounds=${3:-5} first=${4:-0} last=${5:-17}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

median='
    function median(v, n,    i, j, t) {
        for (i = 2; i <= n; i++)
            for (j = i; j > 1 && v[j] < v[j - 1]; j--) { t = v[j]; v[j] = v[j - 1]; v[j - 1] = t }
        return n % 2 ? v[(n + 1) / 2] : (v[n / 2] + v[n / 2 + 1]) / 2
    }'

printf '%-8s %3s %7s %10s %10s %7s  %s\n' set dim balls 'ours ns' 'CGAL ns' ratio 'simplices, vertices of CGAL'
set=$first
while [ "$set" -le "$last" ]; do
    : > "$work/ours"
    : > "$work/peer"
    round=0
    while [ "$round" -lt "$rounds" ]; do
        "$bench" "$set" >> "$work/ours"
        "$peer" "$set" >> "$work/peer"
        round=$((round + 1))
    done
    # Fields: name dim balls best median simplices vertices; the ratio is the median of those of the pairs of medians.
    # Ties may be broken otherwise and the hull differs a little, so counts agree only nearly.
    paste -d ' ' "$work/ours" "$work/peer" | awk "$median"'
        { ours[NR] = $5; peer[NR] = $12; ratio[NR] = $5 / $12; name = $1; dim = $2; balls = $3
          simplices = $6 / $13; vertices = $7 / $14 }
        END {
            slack = name == "lattice" ? 0.25 : dim == 3 ? 0.1 : 0.05
            agree = simplices > 1 - slack && simplices < 1 + slack && vertices > 0.98 && vertices < 1.02
            printf "%-8s %3d %7d %10.1f %10.1f %7.3f  %.3f, %.4f%s\n", name, dim, balls, median(ours, NR), median(peer, NR),
                   median(ratio, NR), simplices, vertices, agree ? "" : "  DISAGREES"
            exit !agree
        }'
    set=$((set + 1))
done

# One inner slice in space with a half of its gluings, beside the bare triangulation of the same balls. The tight shell leaves pockets.
echo
echo 'inner slices in space, each glued with 3 neighbours: medians over cells, microseconds of processor time;'
echo 'ratio: slice and gluing of all components, by the time in which CGAL triangulates all of the balls; home: one component instead'
printf '%-7s %6s %6s %6s %9s %9s %9s %9s %7s %7s  %s\n' shell balls kept comps slice 'glue all' 'glue home' CGAL ratio home \
    'mixtures a gluing'
scene=0
for shell in closed closed closed tight tight tight; do
    : > "$work/pairs"
    for round in 1 2; do
        "$bench" space "$scene" "$work/balls" > "$work/ours"
        "$peer" slices "$work/balls" > "$work/peer"
        paste -d ' ' "$work/ours" "$work/peer" >> "$work/pairs"
    done
    # Fields: balls kept components slice all home mixtures mixtures, and CGAL's: balls ns vertices.
    awk -v shell="$shell" "$median"'
        { balls = $1; kept[NR] = $2; components[NR] = $3; slice[NR] = $4 / 1000; all[NR] = $5 / 1000; home[NR] = $6 / 1000; peer[NR] = $10 / 1000
          ratio[NR] = ($4 + $5) / $10; least[NR] = ($4 + $6) / $10; mixed += $7 / 3; few += $8 / 3; wrong += $1 != $9 }
        END {
            printf "%-7s %6d %6d %6d %9.1f %9.1f %9.1f %9.1f %7.3f %7.3f  %.2f, %.2f%s\n", shell, balls, median(kept, NR),
                   median(components, NR), median(slice, NR), median(all, NR), median(home, NR), median(peer, NR), median(ratio, NR),
                   median(least, NR), mixed / NR, few / NR, wrong ? "  DISAGREES" : ""
            exit wrong > 0
        }' "$work/pairs"
    scene=$((scene + 1))
done
