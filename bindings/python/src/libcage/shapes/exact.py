"""Exact integer geometry: is a ball clear of every segment or triangle, is its centre inside.

A double is an integer times a power of two, so all of a solid's coordinates are integers in one
common unit, and a ball's too in a finer one. Everything here is then decided in Python's integers,
without rounding; doubles are only compared, to leave out elements whose box does not meet the
ball's."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from ..errors import SolidError

Floats = NDArray[np.float64]
Point = Sequence[int]


def exponent(values: Iterable[float]) -> int:
    """The least e >= 0 such that every value times 2^e is an integer."""
    largest = 1
    for value in values:
        largest = max(largest, float(value).as_integer_ratio()[1])
    return largest.bit_length() - 1


def scaled(values: Iterable[float], e: int) -> list[int]:
    """The values times 2^e, which are integers."""
    result = []
    for value in values:
        top, bottom = float(value).as_integer_ratio()
        result.append(top * ((1 << e) // bottom))
    return result


def dot(a: Point, b: Point) -> int:
    """Scalar product."""
    return sum(x * y for x, y in zip(a, b))


def minus(a: Point, b: Point) -> list[int]:
    """a - b."""
    return [x - y for x, y in zip(a, b)]


def cross(a: Point, b: Point) -> list[int]:
    """Vector product in space."""
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def segment_clear(p: Point, a: Point, b: Point, r2: int) -> bool:
    """Is the closed segment nowhere nearer to p than the root of r2? a = b is allowed."""
    along, to = minus(b, a), minus(p, a)
    t, length2 = dot(to, along), dot(along, along)
    if t <= 0:
        return dot(to, to) >= r2
    if t >= length2:
        off = minus(p, b)
        return dot(off, off) >= r2
    return dot(to, to) * length2 - t * t >= r2 * length2


def triangle_clear(p: Point, a: Point, b: Point, c: Point, r2: int) -> bool:
    """The same for a closed triangle; one without area is the union of its edges."""
    normal = cross(minus(b, a), minus(c, a))
    if any(normal):
        sides = [dot(cross(minus(v, u), minus(p, u)), normal) for u, v in ((a, b), (b, c), (c, a))]
        if min(sides) >= 0:  # p projects into it
            height = dot(minus(p, a), normal)
            return height * height >= r2 * dot(normal, normal)
    return all(segment_clear(p, u, v, r2) for u, v in ((a, b), (b, c), (c, a)))


def winding_2d(p: Point, segments: Iterable[tuple[Point, Point]]) -> int:
    """How often closed chains of segments go around p, which is on none of them."""
    turns = 0
    for a, b in segments:
        if (a[1] <= p[1]) != (b[1] <= p[1]):
            left = (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
            if b[1] > a[1]:
                turns += left > 0
            else:
                turns -= left < 0
    return turns


def _around(p: Point, triangle: Sequence[Point]) -> int:
    """How the triangle, seen along x, goes around p moved by infinitesimals: 1, 0 or -1.

    z is moved up by the smaller, y by the larger one; each edge decides for itself, so triangles
    that share an edge agree about it, and a triangle seen edge-on counts 0."""
    turns = 0
    for k in range(3):
        a, b = triangle[k], triangle[(k + 1) % 3]
        up = a[2] <= p[2] < b[2]
        if not up and not b[2] <= p[2] < a[2]:
            continue
        low, high = (a, b) if up else (b, a)
        right = (low[1] - p[1]) * (high[2] - low[2]) + (p[2] - low[2]) * (high[1] - low[1])
        if right > 0:
            turns += 1 if up else -1
    return turns


def winding_3d(p: Point, triangles: Iterable[Sequence[Point]]) -> int:
    """How often a closed oriented surface goes around p, which is not on it: the signed number of
    triangles that the ray from p along x leaves through. 1 inside a solid whose faces look
    outward."""
    turns = 0
    for a, b, c in triangles:
        way = _around(p, (a, b, c))
        if way == 0:
            continue
        ahead = dot(minus(a, p), cross(minus(b, a), minus(c, a)))
        if ahead == 0:
            raise SolidError("a point on the surface has no winding number")
        if (ahead > 0) == (way > 0):
            turns += way
    return turns


class Boundary:
    """The boundary of a solid: segments (dim 2) or triangles (dim 3), as doubles and as integers.

    chain: for each element the closed chain (ring of a polygon) it belongs to.
    """

    def __init__(self, corners: Floats, chain: NDArray[np.int64]) -> None:
        if not len(corners):
            raise SolidError("the solid is empty")
        if not np.isfinite(corners).all():
            raise SolidError("a coordinate of the solid is NaN or infinite")
        self.corners = corners  # (n, dim, dim): elements, their corners, coordinates
        self.dim = corners.shape[2]
        self.chain = chain
        self.low, self.high = corners.min(axis=1), corners.max(axis=1)
        self.size = float((self.high.max(axis=0) - self.low.min(axis=0)).max())
        if not 0 < self.size < 1e30 or abs(corners).max() > 1e30:
            raise SolidError("the solid has no extent, or is too large")
        flat = corners.reshape(-1, self.dim)
        self._e = exponent(flat.ravel())
        points: dict[bytes, tuple[int, ...]] = {}
        exact = []
        for row in flat:
            key = row.tobytes()
            if key not in points:
                points[key] = tuple(scaled(row, self._e))
            exact.append(points[key])
        count = corners.shape[1]
        self._exact = [tuple(exact[i : i + count]) for i in range(0, len(exact), count)]

    def _place(
        self, values: Sequence[float], which: NDArray[np.int64]
    ) -> tuple[list[int], list[list[Point]]]:
        """Numbers and elements as integers in one unit."""
        e = max(exponent(values), self._e)
        shift = e - self._e
        if shift == 0:
            return scaled(values, e), [list(self._exact[i]) for i in which]
        return scaled(values, e), [
            [[v << shift for v in corner] for corner in self._exact[i]] for i in which
        ]

    def clear(self, ball: Floats) -> bool:
        """Is the open ball (x, y, r) or (x, y, z, r) off every element? Exact."""
        centre, r = ball[:-1], float(ball[-1])
        low, high = np.nextafter(centre - r, -math.inf), np.nextafter(centre + r, math.inf)
        near = np.flatnonzero(((self.low <= high) & (self.high >= low)).all(axis=1))
        values, elements = self._place([float(v) for v in ball], near)
        p, r2 = values[:-1], values[-1] ** 2
        if self.dim == 2:
            return all(segment_clear(p, a, b, r2) for a, b in elements)
        return all(triangle_clear(p, a, b, c, r2) for a, b, c in elements)

    def windings(self, point: Floats) -> dict[int, int]:
        """The winding number of each chain around a point that is on none. Exact."""
        cut = (self.low[:, 1:] <= point[1:]).all(axis=1) & (self.high[:, 1:] >= point[1:]).all(
            axis=1
        )
        which = np.flatnonzero(cut if self.dim == 2 else cut & (self.high[:, 0] >= point[0]))
        p, elements = self._place([float(v) for v in point], which)
        result: dict[int, int] = {}
        for number in np.unique(self.chain[which]):
            part = [e for e, i in zip(elements, which) if self.chain[i] == number]
            result[int(number)] = (
                winding_2d(p, [(e[0], e[1]) for e in part])
                if self.dim == 2
                else winding_3d(p, part)
            )
        return result

    def surely_inside(self, point: Floats) -> bool:
        """Is a point that is on no element inside, whichever way overlaps are read? Exact."""
        raise NotImplementedError

    def surely_outside(self, point: Floats) -> bool:
        """Is it outside, whichever way overlaps are read? Exact."""
        raise NotImplementedError

    def problem(self, ball: Floats) -> str:
        """Why the closed ball is not proved to lie inside the solid, or ''. Exact."""
        if ball.shape != (self.dim + 1,):
            return f"it has {len(ball) - 1} dimensions, the solid {self.dim}"
        if not np.isfinite(ball).all():
            return "NaN or infinite"
        if ball[-1] <= 0:
            return "the radius is not positive"
        if abs(ball).max() > 1e30:
            return "it is too large"
        if not self.clear(ball):
            return "it reaches through the boundary"
        if not self.surely_inside(ball[:-1]):
            return "its centre is not inside"
        return ""
