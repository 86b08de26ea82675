"""A peg and a hole in the plane: for which clearance is there a way in?

The peg is a row of discs of 10 mm diameter; the hole is 14 mm wide, its mouth is narrower and made
of balls that face each other. With less than 10 mm between two of these no disc of the peg can
pass, so there is no way in; with more there is the straight one. The proof says so down to
clearances far below a tolerance."""

import numpy as np

import libcage

PEG = 0.010  # diameter, metres
WIDE, DEPTH = 0.014, 0.034
SIDE = 0.002  # radius of the balls that the sides are made of


def hole(mouth: float) -> np.ndarray:
    """Two lips 4 mm deep, two sides, a bottom; x y r."""
    lips = [
        (s * (mouth / 2 + SIDE), -y, SIDE) for y in np.arange(0, 0.005, SIDE / 2) for s in (-1, 1)
    ]
    down, x = np.arange(0.005, DEPTH + SIDE, SIDE / 2), WIDE / 2 + SIDE
    sides = [(s * x, -y, SIDE) for y in down for s in (-1, 1)]
    bottom = [(u, -DEPTH - SIDE, SIDE) for u in np.arange(-x, x + SIDE / 4, SIDE / 2)]
    return np.array(lips + sides + bottom)


def peg() -> np.ndarray:
    """Five discs one above the other, the origin in the lowest."""
    return np.array([(0.0, 0.004 * i, PEG / 2) for i in range(5)])


def main() -> dict:
    found = {}
    for clearance in (-5e-4, -1e-4, -2e-5, 2e-5, 1e-4, 5e-4):
        scene = libcage.Scene(peg(), hole(PEG + clearance))
        answer = scene.prove((0.0, 0.015, 0.0), (0.0, -0.026, 0.0))
        found[clearance] = answer.verdict
        print(
            f"clearance {1e3 * clearance:+.3f} mm: {answer.verdict} "
            f"({1e3 * answer.statistics.seconds:.0f} ms)"
        )
    return found


if __name__ == "__main__":
    main()
