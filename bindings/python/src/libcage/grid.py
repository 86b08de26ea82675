"""A scene on the integer grid: its unit, the arrays that C reads, and who keeps them alive."""

from __future__ import annotations

import ctypes
import math

import numpy as np

from . import _native
from .balls import Balls, Solid, to_grid
from .errors import GridError, InputError
from .frozen import Frozen, frozen_array, real_number
from .poses import Floats, Ints

MOST_PAIRS = 1 << 28  # CAGE_PAIRS_MAX of the library
SMALLEST, LARGEST = 2.0**-160, 2.0**160  # of a unit


class Grid(Frozen):
    """The scene in grid units. The C struct points into arrays held here: keep the Grid alive."""

    __slots__ = ("unit", "dim", "arrays", "struct", "pairs")
    unit: float
    dim: int
    arrays: tuple[Ints, Ints, Ints, Ints]  # object inner, object outer, obstacles inner, outer
    struct: _native.SceneStruct
    pairs: int

    def __init__(self, unit: float, dim: int, arrays: tuple[Ints, Ints, Ints, Ints]) -> None:
        kept = tuple(frozen_array(array) for array in arrays)
        shapes = [
            _native.Shape(inner.ctypes.data, outer.ctypes.data, len(inner), len(outer))
            for inner, outer in (kept[:2], kept[2:])
        ]
        struct = _native.SceneStruct(shapes[0], shapes[1], dim)
        pairs = len(arrays[0]) * len(arrays[2])
        self._set(unit=unit, dim=dim, arrays=kept, struct=struct, pairs=pairs)

    def bytes(self) -> bytes:
        """All of it that an answer depends on."""
        head = np.array([self.dim, *map(len, self.arrays)], dtype="<i4").tobytes()
        return head + b"".join(array.astype("<i4").tobytes() for array in self.arrays)


def _sides(solid: Solid, unit: float, dim: int) -> tuple[Ints, Ints]:
    """Inner and outer balls of a solid. Where one set is not there, or proves nothing, the search
    of that side is not made: no inner balls collide with nothing, and the outer balls of any set
    stand in for the range check."""
    inner = np.zeros((0, 4), dtype=np.int32)
    outer = inner
    if solid.inner is not None:
        rows, outer = to_grid(solid.inner, unit)
        inner = rows if solid.proves("inner") else inner
    if solid.outer is not None and solid.outer is not solid.inner:
        outer = to_grid(solid.outer, unit)[1]
    return inner, outer


def make(object_: Solid, obstacles: Solid, unit: float) -> tuple[Grid | None, int]:
    """The scene at that unit, or None and the C library's error."""
    dim = object_.dim
    grid = Grid(unit, dim, _sides(object_, unit, dim) + _sides(obstacles, unit, dim))
    error = _native.lib.cage_scene_check(ctypes.byref(grid.struct))
    return (grid if error == 0 else None), error


def check_count(one: Solid, other: Solid) -> None:
    """Refuse scenes with more pairs of balls than the library counts in a slice."""
    for side in ("inner", "outer"):
        first, second = (len(getattr(s, side) or ()) for s in (one, other))
        if first * second > MOST_PAIRS:
            raise InputError(
                f"{first} {side} balls of the object times {second} of the obstacles: more than "
                f"{MOST_PAIRS} pairs. Fewer balls are wanted, or parts of the scene apart"
            )


def reach(solid: Solid) -> float:
    """The farthest point of any ball from the origin."""
    farthest = 0.0
    for balls in {id(b): b for b in (solid.inner, solid.outer) if b is not None}.values():
        if len(balls):
            farthest = max(
                farthest, float((np.linalg.norm(balls.centres, axis=1) + balls.radii).max())
            )
    return farthest


def half_extent(solid: Solid) -> float:
    """Half the longest side of the box around the centres: no pivot is nearer to all of them."""
    half = 0.0
    for balls in (solid.inner, solid.outer):
        if balls is not None and len(balls):
            half = max(half, float(np.ptp(balls.centres, axis=0).max()) / 2)
    return half


def finest(length: float, dim: int) -> float:
    """The finest power of two at which a scene of that reach may fit."""
    if length == 0:
        return 1.0
    return math.ldexp(1.0, math.frexp(length / (_native.REACH[dim] - 16))[1])


def check_unit(unit: float) -> float:
    """A unit must be a power of two: then lengths are divided by it exactly."""
    unit = real_number(unit, "unit, a power of two in metres")
    if not (unit > 0 and math.isfinite(unit) and math.frexp(unit)[0] == 0.5):
        raise GridError(
            f"the unit must be a power of two (in metres), not {unit!r}: 2.0**-20 is about "
            "a micrometre"
        )
    if not SMALLEST <= unit <= LARGEST:
        raise GridError(f"a unit of {unit:g} metres is not supported")
    return unit


def far(places: Floats) -> float:
    """The largest coordinate of poses."""
    return float(abs(places).max(initial=0.0))


def count_dropped(balls: Balls, unit: float) -> int:
    """How many inner balls are too small for the grid, and are left out."""
    return len(balls) - len(to_grid(balls, unit)[0])
