"""A molecule in a cage: hydrogen in C60, made from its formula, and C60 with a hole in it.

Lengths are in units of 0.1 nm. Atoms are balls of their van der Waals radii; two that overlap
collide. Between any six atoms of a hexagon (side 1.42) no ball of radius r can pass while 1.70 + r
> 1.42, as every point between them is not farther than 1.42 from one. So helium is caged until all
radii have shrunk by (1.70 + 1.40 - 1.42) / 2 = 0.84."""

import itertools
import math

import numpy as np

import libcage

BOND, CARBON, HYDROGEN, HELIUM = 1.42, 1.70, 1.20, 1.40


def c60() -> np.ndarray:
    """The 60 corners of a truncated icosahedron: even permutations of three triples, edges of
    length 2."""
    g = (1 + math.sqrt(5)) / 2
    corners = set()
    for triple in ((0, 1, 3 * g), (1, 2 + g, 2 * g), (g, 2, 2 * g + 1)):
        for signs in itertools.product((1, -1), repeat=3):
            x, y, z = (s * v for s, v in zip(signs, triple))
            corners |= {(x, y, z), (y, z, x), (z, x, y)}
    return np.array(sorted({tuple(round(v, 12) + 0.0 for v in corner) for corner in corners})) * (
        BOND / 2
    )


def main() -> dict:
    atoms = c60()
    cage = np.c_[atoms, np.full(len(atoms), CARBON)]
    hydrogen = np.array([[0.37, 0, 0, HYDROGEN], [-0.37, 0, 0, HYDROGEN]])
    scene = libcage.Scene(hydrogen, cage)
    home = libcage.from_wxyz([0, 0, 0], [1, 0, 0, 0])
    found = {"hydrogen": scene.prove(home)}
    print(f"hydrogen in C60: {found['hydrogen'].verdict}")
    found["margin"] = libcage.Scene([[0, 0, 0, HELIUM]], cage).margin(home, rounds=8)
    print(f"helium in C60: margin {found['margin']}")
    top = np.argsort(-atoms[:, 2])
    for gone in (2, 16):
        opened = libcage.Scene([[0, 0, 0, HELIUM]], cage[top[gone:]])
        found[gone] = opened.prove(home)
        print(f"helium in C60 without the {gone} topmost atoms: {found[gone].verdict}")
    return found


if __name__ == "__main__":
    main()
