"""betti.py: check numbers of components of the complement of unions of balls against Betti numbers computed by GUDHI.

Standard input: for each scene a line "dim count components name", then count lines "x y z r", all integers. By Alexander duality the
complement has one component more than the rank of homology in dimension dim - 1. Exit status: 0 all agree, 1 one does not, 77 without GUDHI.
"""
import sys


def components(gudhi, dim, balls):
    tree = gudhi.AlphaComplex(
        points=[b[:dim] for b in balls], weights=[b[3] ** 2 for b in balls], precision="exact"
    ).create_simplex_tree()
    tree.prune_above_filtration(0.0)
    tree.compute_persistence(persistence_dim_max=True)
    betti = tree.betti_numbers()
    return 1 + (betti[dim - 1] if len(betti) >= dim else 0)


def main():
    lines = sys.stdin.read().split("\n")
    try:
        import gudhi
    except ImportError:
        return 77
    at, scenes, wrong = 0, 0, 0
    while at < len(lines) and lines[at]:
        dim, count, said, name = lines[at].split(None, 3)
        dim, count, said = int(dim), int(count), int(said)
        balls = [tuple(int(v) for v in line.split()) for line in lines[at + 1 : at + 1 + count]]
        at += 1 + count
        found = components(gudhi, dim, balls) if balls else 1
        scenes += 1
        if found != said:
            wrong += 1
            print(f"{name}: {said} components, GUDHI says {found}: {balls}")
    print(f"components: {scenes} scenes compared with GUDHI, {wrong} differ")
    return 1 if wrong else 0


sys.exit(main())
