#!/bin/sh
# compare.sh: time libcage and CGAL in turn on every set: compare.sh BENCH PEER [ROUNDS [FIRST LAST]].
set -eu
bench=$1 peer=$2 rounds=${3:-5} first=${4:-0} last=${5:-17}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

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
    paste -d ' ' "$work/ours" "$work/peer" | awk '
        function median(v, n,    i, j, t) {
            for (i = 2; i <= n; i++)
                for (j = i; j > 1 && v[j] < v[j - 1]; j--) { t = v[j]; v[j] = v[j - 1]; v[j - 1] = t }
            return n % 2 ? v[(n + 1) / 2] : (v[n / 2] + v[n / 2 + 1]) / 2
        }
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
