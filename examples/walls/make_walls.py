#!/usr/bin/env python3
"""Write walls_R4.xyzr, walls_R10.xyzr and walls_R15.xyzr: one wall, filled with equal balls.

The wall is a polygon traced in pixels (y down; only the numbers matter here). Balls of radius R sit
at the nodes of a square grid of pitch 10 that lie inside the polygon and at least R from its boundary:
every ball is inside the wall, so what the balls cage, the wall cages.
"""

import math
import os

WALL = [
    (70.5, 86.5), (293.5, 102.5), (294.5, 142.5), (263.5, 143.5), (259.5, 267.5), (162.5, 264.5),
    (169.5, 252.5), (242.5, 252.5), (246.5, 143.5), (127.5, 135.5), (126.5, 381.5), (438.5, 387.5),
    (423.5, 155.5), (341.5, 156.5), (335.5, 224.5), (408.5, 225.5), (414.5, 254.5), (310.5, 254.5),
    (314.5, 99.5), (477.5, 79.5), (502.5, 443.5), (60.5, 436.5),
]
PITCH = 10.0
PHASE = (3.5, 0.5)  # the grid's nodes are PHASE + PITCH * (i, j)


def inside(polygon, x, y):
    """Even-odd rule."""
    odd = False
    for (ax, ay), (bx, by) in zip(polygon, polygon[1:] + polygon[:1]):
        if (ay > y) != (by > y) and x < ax + (bx - ax) * (y - ay) / (by - ay):
            odd = not odd
    return odd


def distance(polygon, x, y):
    """Distance from a point to the boundary."""
    best = math.inf
    for (ax, ay), (bx, by) in zip(polygon, polygon[1:] + polygon[:1]):
        dx, dy = bx - ax, by - ay
        t = ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy)
        t = min(1.0, max(0.0, t))
        best = min(best, math.hypot(x - ax - t * dx, y - ay - t * dy))
    return best


def grid_nodes(low, high, phase):
    first = phase + PITCH * math.ceil((low - phase) / PITCH)
    while first <= high:
        yield first
        first += PITCH


def balls(radius):
    xs = [x for x, _ in WALL]
    ys = [y for _, y in WALL]
    return [(x, y, radius)
            for y in grid_nodes(min(ys), max(ys), PHASE[1])
            for x in grid_nodes(min(xs), max(xs), PHASE[0])
            if inside(WALL, x, y) and distance(WALL, x, y) >= radius]


def main():
    folder = os.path.dirname(os.path.abspath(__file__))
    for radius in (4, 10, 15):
        kept = balls(radius)
        with open(os.path.join(folder, "walls_R%d.xyzr" % radius), "w") as out:
            out.write("# The wall of make_walls.py as %d balls of radius %d: x y r\n" % (len(kept), radius))
            for x, y, r in kept:
                out.write("%g %g %g\n" % (x, y, r))
        print("R = %2d: %d balls" % (radius, len(kept)))


if __name__ == "__main__":
    main()
