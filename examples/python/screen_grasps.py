"""Screening: 200 random grasps with three fingers, ranked by how tight they cage a part.

The margin of a cage is by how much every radius may shrink before the part can leave: what the
fingers may be worn, or the part too small. A grasp that is no cage has a negative one: what is
missing."""

from concurrent.futures import ProcessPoolExecutor

import numpy as np

import libcage

PART = np.array(
    [[0, 0, 0.014], [0.018, 0, 0.009], [-0.009, 0.0156, 0.009], [-0.009, -0.0156, 0.009]]
)
FINGER = 0.007  # radius, metres
ROUNDS = 8


def grasp(seed: int) -> np.ndarray:
    """Three fingers of a tripod, each up to 25 degrees off its place, which reach in between the
    lobes."""
    rng = np.random.default_rng(seed)
    angles = np.radians(np.array([60, 180, 300]) + rng.uniform(-25, 25, 3))
    far = rng.uniform(0.024, 0.036, 3)
    return np.c_[far * np.cos(angles), far * np.sin(angles), np.full(3, FINGER)]


def margin(seed: int) -> tuple:
    """The grasp's number, and its margin, closed and open; None where fingers and part collide."""
    scene = libcage.Scene(PART, grasp(seed))
    if scene.collides([(0.0, 0.0, 0.0)])[0]:
        return seed, None, None
    found = scene.margin((0.0, 0.0, 0.0), rounds=ROUNDS)
    return seed, found.closed, found.open


def main(count: int = 200, workers: int = 2) -> list:
    with ProcessPoolExecutor(workers) as pool:
        found = list(pool.map(margin, range(count), chunksize=10))
    cages = [row for row in found if row[1] is not None and row[1] > 0]
    print(f"{len(cages)} of {count} grasps are cages")
    for seed, closed, opened in sorted(cages, key=lambda row: -row[1])[:5]:
        print(
            f"grasp {seed}: stays a cage until every radius has shrunk by "
            f"{1e3 * closed:.2f} mm (opens by {1e3 * opened:.2f})"
        )
    return found


if __name__ == "__main__":
    main()
