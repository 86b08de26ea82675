"""Paths made short and smooth by descent, kept only where the C library certifies the whole curve.

After CHOMP (Ratliff, Zucker, Bagnell, Srinivasa, ICRA 2009): stations between two fixed ends; the
cost is that of steps and bends, and of balls nearer than a band; a step is the gradient times the
inverse of the metric A = K'K, so that a push at one station bends the path around it. Nothing here
is believed: what comes out passes cage_path_check as a whole, or is dropped. The command's --smooth
does the same in C.
"""

from __future__ import annotations

import ctypes
from dataclasses import replace
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_solve_banded, cholesky_banded

from . import _native
from .errors import CageError, InputError
from .poses import Floats, Ints
from .result import Path

if TYPE_CHECKING:
    from .grid import Grid
    from .scene import Scene

FEWEST, MOST, SPACING = 48, 160, 0.1  # stations; of the object's radius from one to the next
STIFFNESS = 1.0  # of bends, against steps
ROWS = 4  # on the grid, for each step between stations
ROUNDS, STEPS, IDLE = 24, 250, 4  # rounds of so many steps; ended after so many without a gain
BAND, SHRINK, PUSH = 0.08, 0.7, 1.7  # of the radius: nearer is paid for; from round to round
WORTHWHILE, ROUNDING = 1e-4, 1e-6  # parts of a length


class Stations(NamedTuple):
    """Where the pivot is (grid units), and unit quaternions w, x, y, z."""

    x: Floats
    q: Floats


def _stations(rows: Ints) -> Stations:
    q = rows[:, 3:].astype(float)
    return Stations(rows[:, :3].astype(float), q / np.linalg.norm(q, axis=1, keepdims=True))


# ---- rotations, many at once: scipy's take longer than all the rest of a step ---------------------


def _cross(a: Floats, b: Floats) -> Floats:
    ax, ay, az = a[..., 0], a[..., 1], a[..., 2]
    bx, by, bz = b[..., 0], b[..., 1], b[..., 2]
    out = np.empty(np.broadcast(a, b).shape)
    out[..., 0] = ay * bz - az * by
    out[..., 1] = az * bx - ax * bz
    out[..., 2] = ax * by - ay * bx
    return out


def _apply(q: Floats, v: Floats) -> Floats:
    """v turned by q."""
    u = q[..., 1:]
    twice = 2 * _cross(u, v)
    return np.asarray(v + q[..., :1] * twice + _cross(u, twice))


def _turns(a: Floats, b: Floats) -> Floats:
    """The turns from a to b the shorter way, as vectors of the world's frame."""
    w = (a * b).sum(axis=-1)
    v = a[..., :1] * b[..., 1:] - b[..., :1] * a[..., 1:] - _cross(b[..., 1:], a[..., 1:])
    sine = np.sqrt((v**2).sum(axis=-1))
    factor = np.where(sine < 1e-12, 2.0, 2 * np.arctan2(sine, abs(w)) / np.maximum(sine, 1e-300))
    return np.asarray(np.where(w < 0, -factor, factor)[..., None] * v)


def _turned(turn: Floats, q: Floats) -> Floats:
    """q turned by vectors of the world's frame."""
    angle = np.sqrt((turn**2).sum(axis=-1, keepdims=True))
    v = np.where(angle < 1e-12, 0.5, np.sin(angle / 2) / np.maximum(angle, 1e-300)) * turn
    w = np.cos(angle / 2)
    scalar = w * q[..., :1] - (v * q[..., 1:]).sum(axis=-1, keepdims=True)
    out = np.concatenate(
        [scalar, w * q[..., 1:] + q[..., :1] * v + _cross(v, q[..., 1:])], axis=-1
    )
    return np.asarray(out / np.sqrt((out**2).sum(axis=-1, keepdims=True)))


# ---- lengths -------------------------------------------------------------------------------------


def _legs(at: Stations, radius: float) -> tuple[Floats, Floats, Floats]:
    """Steps in radii, turns as vectors of the world's frame, and what both are together."""
    dx = np.diff(at.x, axis=0) / radius
    dr = _turns(at.q[:-1], at.q[1:])
    return dx, dr, np.sqrt((dx**2).sum(axis=1) + (dr**2).sum(axis=1))


def _radius(grid: Grid, pivot: tuple[int, int, int]) -> float:
    """The largest distance of a point of the object from its pivot."""
    part = grid.arrays[1].astype(float)
    return float((np.linalg.norm(part[:, :3] - pivot, axis=1) + part[:, 3]).max(initial=1.0))


def _length(rows: Ints, radius: float) -> float:
    return radius * float(_legs(_stations(rows), radius)[2].sum())


def length(path: Path, scene: Scene | None = None) -> float:
    """In metres: of a leg the root of its way squared and (turn times the object's radius) squared,
    the radius being that of its farthest point from the pivot."""
    return _length(path.grid, _radius(_grid(path, scene), path.pivot_grid)) * path.unit


def _grid(path: Path, scene: Scene | None) -> Grid:
    scene = path.scene if scene is None else scene
    if scene is None:
        raise InputError("this path was read from bytes: say of which scene it is, smooth(scene)")
    if scene.dim != path.dim:
        raise InputError(f"the scene has {scene.dim} dimensions, the path {path.dim}")
    return scene.at_unit(path.unit)


# ---- what is certified ---------------------------------------------------------------------------


class Checker:
    """Asks the C library; keeps what it reads alive."""

    def __init__(self, grid: Grid, path: Path) -> None:
        self.grid, self.path = grid, path
        self.pivot = np.array(path.pivot_grid, dtype=np.int32)
        self.start = np.array(path.start_grid, dtype=np.int32)
        self.goal = None if path.goal_grid is None else np.array(path.goal_grid, dtype=np.int32)

    def _ask(self, rows: Ints, start: Ints, goal: Ints | None, more: int = 0) -> bool:
        part, walls = self.grid.arrays[1], self.grid.arrays[3].astype(np.int64)
        walls[:, 3] += more
        if len(walls) and walls[:, 3].max() >= 1 << 31:
            return False
        grown = np.ascontiguousarray(walls, dtype=np.int32)
        rows = np.ascontiguousarray(rows, dtype=np.int32)
        shapes = [
            _native.Shape(a.ctypes.data, a.ctypes.data, len(a), len(a)) for a in (part, grown)
        ]
        scene = _native.SceneStruct(shapes[0], shapes[1], self.path.dim)

        def at(values: Ints) -> ctypes.c_void_p:
            return ctypes.c_void_p(values.ctypes.data)

        try:
            answer: int = _native.lib.cage_path_check(
                ctypes.byref(scene),
                at(start),
                None if goal is None else at(goal),
                at(self.pivot),
                at(rows),
                len(rows),
            )
        except CageError:  # larger balls no longer fit the grid
            return False
        return answer == 1

    def user(self, row: Ints) -> Ints:
        """A pose of the object whose pivot is at that pose of the pivot."""
        out = row.copy()
        moved = _apply(_stations(row[None]).q[0], self.pivot.astype(float))
        out[:3] = np.clip(np.rint(row[:3] - moved), -(2**31), 2**31 - 1)
        return out

    def legs(self, rows: Ints) -> bool:
        """The path of straight legs, from start to goal or to far away."""
        return self._ask(rows, self.start, self.goal)

    def leg(self, a: Ints, b: Ints) -> bool:
        return self._ask(np.array([a, b]), self.user(a), self.user(b))

    def curve(self, rows: Ints) -> bool:
        """The cubics through the rows: straight legs, but for their deviation, by which obstacles
        are made larger; and that it ends beyond all of them, where there is no goal."""
        off = deviation(rows)
        if not off < 1 << 20:
            return False
        more = int(np.ceil(off + 0.001))  # the doubles are exact to much less
        end = self.user(rows[-1]) if self.goal is None else self.goal
        return self._ask(rows, self.start, end, more) and (
            self.goal is not None or self.legs(rows)
        )


def deviation(rows: Ints) -> float:
    """How far the curve is off the straight legs, at the same time, at most. On a leg d with slopes
    m and n it is off by t (1-t) ((1-t) (m - d) - t (n - d)), and t (1-t)^2 is at most 4/27."""
    x = rows[:, :3].astype(float)
    slope = np.concatenate([x[1:2] - x[:1], (x[2:] - x[:-2]) / 2, x[-1:] - x[-2:-1]])
    leg = np.diff(x, axis=0)
    first = np.linalg.norm(slope[:-1] - leg, axis=1)
    second = np.linalg.norm(slope[1:] - leg, axis=1)
    return float(4 / 27 * (first + second).max(initial=0.0))


# ---- stations and rows ---------------------------------------------------------------------------


def _between(at: Stations, places: Floats) -> Stations:
    """Stations at fractional indices, straight between those given."""
    i = np.minimum(places.astype(int), len(at.x) - 2)
    t = (places - i)[:, None]
    x = at.x[i] + t * (at.x[i + 1] - at.x[i])
    return Stations(x, _turned(t * _turns(at.q[i], at.q[i + 1]), at.q[i]))


def _resample(at: Stations, radius: float, count: int) -> Stations:
    """So many stations, evenly apart along the path."""
    parts = _legs(at, radius)[2]
    passed = np.concatenate([[0.0], np.cumsum(parts)])
    keep = np.concatenate([[True], parts > 0])
    places = np.interp(
        np.linspace(0, passed[-1], count), passed[keep], np.arange(len(passed), dtype=float)[keep]
    )
    return _between(at, places)


def _to_rows(at: Stations, dim: int) -> Ints:
    wxyz = at.q * _native.QUATERNION[dim]
    if dim == 2:
        wxyz[:, 1:3] = 0
    rows = np.concatenate([at.x, wxyz], axis=1)
    return np.asarray(np.clip(np.rint(rows), -(2.0**31), 2.0**31 - 1), dtype=np.int32)


def _rows(at: Stations, first: Ints, last: Ints, dim: int) -> Ints:
    """Rows on a cubic through the stations, evenly apart in time; the ends as given."""
    n = len(at.x)
    places = np.linspace(0, n - 1, ROWS * (n - 1) + 1)
    i = np.minimum(places.astype(int), n - 2)
    t = (places - i)[:, None]
    slope = np.concatenate(
        [at.x[1:2] - at.x[:1], (at.x[2:] - at.x[:-2]) / 2, at.x[-1:] - at.x[-2:-1]]
    )
    step = np.diff(at.x, axis=0)[i]
    out = _between(at, places)
    bend = t * (1 - t) * ((1 - t) * (slope[i] - step) - t * (slope[i + 1] - step))
    rows = _to_rows(Stations(out.x + bend, out.q), dim)
    rows[0], rows[-1] = first, last
    return rows


def _shortcut(at: Stations, check: Checker, radius: float) -> Stations:
    """Detours go first: from each station straight to the farthest that a certified leg leads to,
    halving."""
    rows, n = _to_rows(at, check.path.dim), len(at.x)
    kept, here = [0], 0
    while here < n - 1:
        to = n - 1
        while to > here + 1 and not check.leg(rows[here], rows[to]):
            to = here + (to - here) // 2
        kept.append(to)
        here = to
    return _resample(Stations(at.x[kept], at.q[kept]), radius, n)


# ---- descent -------------------------------------------------------------------------------------


class Descent:
    """The cost of stations, its gradient, and steps down."""

    def __init__(self, grid: Grid, path: Path, radius: float, stations: int) -> None:
        self.part = grid.arrays[1].astype(float)
        self.part[:, :3] -= path.pivot_grid
        self.walls = grid.arrays[3].astype(float)
        self.radius = radius
        self.band = BAND * radius
        self.slack = self.band
        self.weight = 0.0
        self.near: tuple[NDArray[Any], NDArray[Any], NDArray[Any]] | None = None
        self.listed: Stations | None = None
        n = stations - 2  # A = K'K of the stations between the ends, as bands: factored once
        bands = np.zeros((3, n))
        bands[2] = 2 + 6 * STIFFNESS**2
        bands[2, [0, -1]] -= STIFFNESS**2  # there is no bend at an end
        bands[1, 1:] = -1 - 4 * STIFFNESS**2
        bands[0, 2:] = STIFFNESS**2
        self.factor = cholesky_banded(bands)

    def _moved(self, a: Stations, b: Stations) -> float:
        way = np.linalg.norm(a.x - b.x, axis=1)
        return float((way + self.radius * np.linalg.norm(_turns(a.q, b.q), axis=1)).max())

    def _look(self, at: Stations) -> None:
        """Near pairs are looked for again when something may have come near meanwhile."""
        if self.listed is not None and self._moved(self.listed, at) <= self.slack:
            return
        within, n = self.band + self.slack, len(at.x)
        arms = _apply(at.q[:, None], self.part[None, :, :3])
        found = []
        some = max(1, 1_000_000 // max(1, len(self.walls)))  # stations at a time
        for first in range(1, n - 1, some):
            x = at.x[first : min(first + some, n - 1)]
            far = np.sqrt(((x[:, None] - self.walls[None, :, :3]) ** 2).sum(axis=2))
            s, j = np.nonzero(far < self.radius + self.walls[:, 3] + within)
            d = at.x[first + s][:, None] + arms[first + s] - self.walls[j, None, :3]
            gap = np.sqrt((d**2).sum(axis=2)) - self.part[:, 3] - self.walls[j, None, 3]
            k, i = np.nonzero(gap < within)
            found.append((first + s[k], i, j[k]))
        s, i, j = (np.concatenate(parts) for parts in zip(*found))
        self.near, self.listed = (s, i, j), at

    def _pairs(self, at: Stations) -> tuple[Floats, Floats, Floats]:
        """Arms, unit vectors away from obstacles, and gaps, of all near pairs."""
        self._look(at)
        assert self.near is not None
        s, i, j = self.near
        arm = _apply(at.q[s], self.part[i, :3])
        d = at.x[s] + arm - self.walls[j, :3]
        size = np.sqrt((d**2).sum(axis=1))
        gap = size - self.part[i, 3] - self.walls[j, 3]
        return arm, d / np.maximum(size, 1e-300)[:, None], gap

    def least(self, at: Stations) -> float:
        """The least gap at stations between the ends."""
        return float(self._pairs(at)[2].min(initial=np.inf))

    def cost(self, at: Stations) -> tuple[float, Floats]:
        """The cost, and six columns of its gradient, in radii and radians."""
        dx, dr, _ = _legs(at, self.radius)
        bend = STIFFNESS * np.diff(at.x, 2, axis=0) / self.radius
        arm, away, gap = self._pairs(at)
        soft = np.clip((self.band - gap) / self.band, 0, 1)  # 1 in overlap
        pay = np.where(gap < 0, self.band / 2 - gap, self.band * soft**2 / 2)
        total = ((dx**2).sum() + (dr**2).sum() + (bend**2).sum()) / 2
        total += self.weight * pay.sum() / self.radius
        slope = np.zeros((len(at.x), 6))
        slope[1:, :3] += dx
        slope[:-1, :3] -= dx
        slope[1:, 3:] += dr
        slope[:-1, 3:] -= dr
        for k, factor in enumerate((1, -2, 1)):
            slope[k : len(slope) - 2 + k, :3] += factor * STIFFNESS * bend
        assert self.near is not None
        force = -soft[:, None] * away
        push = np.concatenate([force, _cross(arm, force) / self.radius], axis=1)
        for k in range(6):
            slope[:, k] += self.weight * np.bincount(self.near[0], push[:, k], len(slope))
        return float(total), slope[1:-1]

    def run(self, at: Stations) -> Stations:
        """Steps that lower the cost, by a pace that grows while they do."""
        pace, before = 0.02, np.inf
        cost, slope = self.cost(at)
        for n in range(STEPS):
            if pace < 1e-9 or (n % 25 == 24 and before - cost < 1e-5 * cost):
                break
            before = cost if n % 25 == 24 else before
            step = pace * cho_solve_banded((self.factor, False), slope)
            x, q = at.x.copy(), at.q.copy()
            x[1:-1] -= self.radius * step[:, :3]
            q[1:-1] = _turned(-step[:, 3:], q[1:-1])
            trial = Stations(x, q)
            after, new = self.cost(trial)
            if after >= cost:
                pace /= 2
                continue
            at, cost, slope, pace = trial, after, new, min(1.0, pace * 1.2)
        return at


def smooth(path: Path, scene: Scene | None = None) -> Path:
    """A shorter path without corners, certified as a whole; or the path itself. See Path.smooth."""
    grid = _grid(path, scene)
    check, radius = Checker(grid, path), _radius(grid, path.pivot_grid)
    if not (check.curve(path.grid) if path.curve else check.legs(path.grid)):
        raise InputError("this is no path of that scene: the check does not certify it")
    found = best = _length(path.grid, radius)
    if found == 0:
        return path
    count = int(np.clip(found / radius / SPACING, FEWEST, MOST))
    at = _shortcut(_resample(_stations(path.grid), radius, count), check, radius)
    descent = Descent(grid, path, radius, count)
    descent.weight = 0.2 * found / radius / count
    kept, idle = path, 0
    for _ in range(ROUNDS):
        at = descent.run(at)
        if descent.least(at) <= 0:
            descent.weight *= PUSH
            idle = 0
            continue
        descent.band *= SHRINK
        rows = _rows(at, path.grid[0], path.grid[-1], path.dim)
        reached = _length(rows, radius)
        better = reached <= best * (1 - WORTHWHILE if kept is not path else 1 + ROUNDING)
        if better and not check.curve(rows):
            idle = 0
            continue
        if better:
            rows.setflags(write=False)
            kept, best = replace(path, grid=rows, curve=True), reached
        idle = 0 if better else idle + 1
        if idle == IDLE:
            break
    return kept
