"""Balls for a polygon or a mesh: inner ones proved to lie inside, outer ones to cover it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..balls import Balls, Solid, exact_rows
from ..errors import InputError, SolidError
from ..extras import extra
from ..frozen import real_number, whole
from . import cover
from .exact import Boundary, Floats
from .solids import MeshBoundary, PolygonBoundary, boundary

SHRINK = 1e-12  # of a radius in doubles, before the exact check


@dataclass(frozen=True)
class Fit:
    """Balls made for a solid, in its frame and unit of length.

    inner: each lies inside the solid, checked with exact integers. outer: they cover it, and no
    point of them is farther than `outer_tolerance` from it. uncovered_depth: how far the worst of
    the sampled points of the solid is from the inner balls (an estimate); filled: the share of the
    samples that they hold."""

    inner: Balls
    outer: Balls
    uncovered_depth: float
    filled: float
    outer_tolerance: float

    def solid(self) -> Solid:
        """For a Scene: separation is proved with the inner balls, paths with the outer ones."""
        return Solid(self.inner, self.outer)

    def __str__(self) -> str:
        return (
            f"{len(self.inner)} inner balls (proved inside) hold {100 * self.filled:.1f} % of the "
            f"samples, the worst is {self.uncovered_depth:.4g} from them; {len(self.outer)} outer "
            f"balls (proved to cover) stay within {self.outer_tolerance:.4g} of the solid"
        )


@dataclass(frozen=True)
class Check:
    """What verify_balls found: `ok` of each ball, and for those that are not why."""

    ok: NDArray[np.bool_]
    problems: dict[int, str]

    def __bool__(self) -> bool:
        return bool(self.ok.all())

    def __str__(self) -> str:
        if self:
            return f"all {len(self.ok)} balls lie inside"
        lines = [f"ball {index}: {why}" for index, why in list(self.problems.items())[:10]]
        return f"{len(self.problems)} of {len(self.ok)} balls are not inside:\n" + "\n".join(lines)


def verify_balls(solid: Any, balls: Any) -> Check:
    """Does each ball lie inside the mesh or polygon? Decided with exact integers.

    solid: a closed mesh (trimesh, faces outward) or a shapely polygon. balls: Balls, or rows x y
    (z) r in the same frame and unit. Where the solid overlaps itself a ball counts as inside only
    if every reading of it says so."""
    edge = boundary(solid)
    rows = balls.rows if isinstance(balls, Balls) else exact_rows(balls)
    problems = {i: why for i, row in enumerate(rows) if (why := edge.problem(row))}
    return Check(np.array([i not in problems for i in range(len(rows))], dtype=bool), problems)


def verify_cover(solid: Any, balls: Any, leaf: float | None = None) -> bool:
    """Do the balls together cover the solid? True is proved; False: not proved with cells of a half
    diagonal of `leaf` (default: a two-hundredth of the solid's size)."""
    edge = boundary(solid)
    rows = balls.rows if isinstance(balls, Balls) else Balls(balls).rows
    if rows.shape[1] != edge.dim + 1:
        raise InputError(f"the balls have {rows.shape[1] - 1} dimensions, the solid {edge.dim}")
    size = edge.size / 200 if leaf is None else real_number(leaf, "leaf")
    if not size > 0:
        raise InputError(f"leaf is positive, not {size:g}")
    return not len(cover.uncovered(edge, rows, size, first=True)[0])


def inner_of(solid: Any, balls: Any) -> Balls:
    """The balls, as Balls of kind inner, after verify_balls found nothing; else a SolidError."""
    check = verify_balls(solid, balls)
    if not check:
        raise SolidError(str(check))
    rows = balls.rows if isinstance(balls, Balls) else balls
    return Balls(rows, "inner", "verified")


# ---- candidates ----------------------------------------------------------------------------------


def _along(shape: Any, count: int) -> Floats:
    """Points along all rings, about `count`."""
    with extra("shapes"):
        import shapely

    rings = shapely.get_rings(shapely.get_parts(shape))
    total = sum(ring.length for ring in rings)
    parts = []
    for ring in rings:
        many = max(8, int(count * ring.length / total))
        at = np.arange(many) * (ring.length / many)
        parts.append(shapely.get_coordinates(shapely.line_interpolate_point(ring, at)))
    result: Floats = np.concatenate(parts)
    return result


def _distance(edge: Boundary, solid: Any, points: Floats) -> Floats:
    """Distances to the boundary in doubles, not to be trusted."""
    if isinstance(edge, MeshBoundary):
        with extra("shapes"):
            import igl

        square = igl.point_mesh_squared_distance(points, edge.vertices, edge.faces)[0]
        return np.sqrt(np.maximum(np.asarray(square, dtype=np.float64).reshape(-1), 0))
    with extra("shapes"):
        import shapely

    result: Floats = shapely.distance(solid.boundary, shapely.points(points))
    return result


def _inside(edge: Boundary, solid: Any, points: Floats) -> NDArray[np.bool_]:
    """Which points seem to be inside, in doubles."""
    if isinstance(edge, MeshBoundary):
        with extra("shapes"):
            import igl

        turns = np.asarray(igl.fast_winding_number(edge.vertices, edge.faces, points)).reshape(-1)
        return np.asarray(turns > 0.5)
    with extra("shapes"):
        import shapely

    return np.asarray(shapely.contains_xy(solid, points[:, 0], points[:, 1]))


def _samples(
    edge: Boundary, solid: Any, count: int, rng: np.random.Generator
) -> tuple[Floats, Floats]:
    """Points on the boundary, and points that seem to be inside."""
    if isinstance(edge, PolygonBoundary):
        surface = _along(solid, count)
    else:
        area = np.linalg.norm(
            np.cross(
                edge.corners[:, 1] - edge.corners[:, 0], edge.corners[:, 2] - edge.corners[:, 0]
            ),
            axis=1,
        )
        faces = rng.choice(len(area), count, p=area / area.sum())
        u, v = rng.uniform(size=(2, count, 1))
        u, v = np.where(u + v > 1, 1 - u, u), np.where(u + v > 1, 1 - v, v)
        a, b, c = (edge.corners[faces, k] for k in range(3))
        surface = np.concatenate(
            [a + u * (b - a) + v * (c - a), edge.corners.reshape(-1, 3)[:count]]
        )
    low, high = edge.low.min(axis=0), edge.high.max(axis=0)
    points = rng.uniform(low, high, (4 * count, edge.dim))
    return surface, points[_inside(edge, solid, points)]


def _candidates(edge: Boundary, solid: Any, surface: Floats, inside: Floats) -> Floats:
    """Rows of balls that seem to lie inside: around Voronoi vertices of the boundary's samples,
    which are near the medial axis, and around points inside."""
    from scipy.spatial import QhullError, Voronoi

    low, high = edge.low.min(axis=0), edge.high.max(axis=0)
    try:
        middle = Voronoi(surface, qhull_options="Qbb Qc Qz QJ").vertices
    except QhullError:
        middle = np.zeros((0, edge.dim))
    middle = middle[((middle > low) & (middle < high)).all(axis=1)]
    points = np.concatenate(
        [middle[_inside(edge, solid, middle)] if len(middle) else middle, inside]
    )
    if not len(points):
        return np.zeros((0, edge.dim + 1))
    rows = np.c_[points, _distance(edge, solid, points) * (1 - SHRINK)]
    return np.asarray(rows[rows[:, -1] > 1e-6 * edge.size])


def _thin(rows: Floats, most: int) -> Floats:
    """At most so many candidates, all over the solid: of those that are nearly the same the
    largest, where nearly is the coarser the more there are."""
    from scipy.spatial import cKDTree

    rows = rows[np.argsort(-rows[:, -1], kind="stable")]
    if not len(rows):
        return rows
    tree = cKDTree(rows[:, :-1])
    kept: list[int] = []
    for share in (0.1, 0.2, 0.35, 0.5, 0.7):
        gone = np.zeros(len(rows), dtype=bool)
        kept = []
        for i, row in enumerate(rows):
            if not gone[i]:
                kept.append(i)
                gone[tree.query_ball_point(row[:-1], share * row[-1])] = True
        if len(kept) <= most:
            break
    return np.asarray(rows[kept[:most]])


def _proved(edge: Boundary, row: Floats) -> Floats | None:
    """The ball, perhaps a little smaller, if it is proved to lie inside."""
    for by in (1.0, 1 - 1e-9, 1 - 1e-6, 1 - 1e-3):
        ball = row.copy()
        ball[-1] *= by
        if not edge.problem(ball):
            return ball
    return None


def _choose(edge: Boundary, rows: Floats, points: Floats, count: int, tolerance: float) -> Floats:
    """Greedily the ball that holds most points that none holds yet, each proved when it is
    chosen."""
    held = np.zeros(len(points), dtype=bool)
    gap = np.full(len(points), math.inf)
    holds = np.empty((len(rows), len(points)), dtype=bool)
    for i, row in enumerate(rows):
        holds[i] = ((points - row[:-1]) ** 2).sum(axis=1) <= row[-1] ** 2
    left = holds.sum(axis=1)
    chosen: list[Floats] = []
    while len(chosen) < count and len(rows):
        best = int(np.argmax(left))
        if left[best] <= 0:
            break
        ball = _proved(edge, rows[best])
        left[best] = -1
        if ball is None:
            continue
        chosen.append(ball)
        new = holds[best] & ~held
        held |= new
        left -= np.where(left >= 0, holds[:, new].sum(axis=1), 0)
        gap = np.minimum(gap, np.linalg.norm(points - ball[:-1], axis=1) - ball[-1])
        if gap.max() <= tolerance:
            break
    return np.array(chosen) if chosen else np.zeros((0, edge.dim + 1))


def fit(
    solid: Any,
    count: int = 100,
    tolerance: float = 0.0,
    outer_tolerance: float | None = None,
    samples: int = 2000,
    seed: int = 0,
) -> Fit:
    """Inner and outer balls for a mesh or polygon, in its own frame and unit of length.

    solid: a closed trimesh mesh with faces outward, or a shapely (Multi)Polygon.
    count: inner balls at most; fewer where `tolerance` is reached: no sampled point of the solid
    is farther than that from them. outer_tolerance: how far the outer balls may reach beyond the
    solid (default: a twentieth of its size). samples, seed: of the candidates; they change which
    balls are found, never whether these are right.
    """
    edge = boundary(solid)
    count, samples = whole(count, "count", 1, 1 << 24), whole(samples, "samples", 16, 1 << 24)
    seed = whole(seed, "seed", 0, 1 << 62)
    tolerance = real_number(tolerance, "tolerance")
    if not tolerance >= 0:
        raise InputError(f"tolerance is 0 or more, not {tolerance:g}")
    reach = edge.size / 20
    if outer_tolerance is not None:
        reach = real_number(outer_tolerance, "outer_tolerance")
    if not 0 < reach < math.inf:
        raise InputError(f"outer_tolerance is positive, not {reach:g}")
    rng = np.random.default_rng(seed)
    surface, inside = _samples(edge, solid, samples, rng)
    rows = _thin(_candidates(edge, solid, surface, inside), 3000)
    points = np.concatenate([inside, surface])
    inner = _choose(edge, rows, points, count, tolerance)
    gap = np.full(len(points), math.inf)
    for ball in inner:
        gap = np.minimum(gap, np.linalg.norm(points - ball[:-1], axis=1) - ball[-1])
    held = gap[: len(inside)] <= 0
    grown = inner.copy()
    grown[:, -1] = (grown[:, -1] + reach) * (1 - 1e-9)
    outer = cover.complete(edge, grown, reach)
    return Fit(
        Balls(inner, "inner", "fit"),
        Balls(outer, "outer", "fit"),
        float(max(gap.max(initial=0.0), 0.0)),
        float(held.mean()) if len(held) else 0.0,
        reach,
    )
