"""Sets of balls, their kind (inner, outer, exact, unknown), and their way to the grid."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, Union

import numpy as np
from numpy.typing import NDArray

from .errors import InputError, KindError
from .frozen import Frozen, frozen_array, is_masked

KINDS = ("inner", "outer", "exact", "unknown")
LARGEST = 1e30  # metres; beyond it, squares of lengths leave the range of doubles


class Balls(Frozen):
    """Balls as rows `x y r` or `x y z r` in metres, in the frame of the object or of the world.

    `kind` says what they are of the solid that they stand for:

    * `exact`: they are the solid;
    * `inner`: each lies inside the solid. Separation (CAGED, DISCONNECTED) can be proved with them;
    * `outer`: together they cover the solid. Paths (FREE, CONNECTED) can be proved with them. Most
      published sphere models of robots are of this kind;
    * `unknown`: nobody has checked, and nothing can be proved about the solid.

    Without `kind` rows are `exact`, and Balls keep the kind and the source that they have; another
    kind for them is an error, see as_kind. The rows are copied and cannot be changed: a proof that
    runs must not see them change. `rows` is an array, which has no kind: whoever makes Balls or a
    Scene of such an array says anew what the balls are, and `exact` where nothing else is said.

    balls[...] (a slice, a mask, an array of indices) are some of the balls, balls + others the
    union of two sets in one frame, of the weakest kind; see also union.
    """

    __slots__ = ("rows", "kind", "source", "__weakref__")
    rows: NDArray[np.float64]
    kind: str
    source: str
    __iter__ = None
    __array_ufunc__ = None  # array + balls is an error, too

    def __init__(self, rows: Any, kind: str | None = None, source: str | None = None) -> None:
        if kind is not None and (not isinstance(kind, str) or kind not in KINDS):
            raise KindError(f"kind is one of {', '.join(KINDS)}, not {kind!r}")
        if isinstance(rows, Balls):
            if kind is not None and kind != rows.kind:
                raise KindError(
                    f"these balls are {rows.kind}, not {kind}; if you know better say so: "
                    f"balls.as_kind({kind!r})"
                )
            kind, source = rows.kind, rows.source if source is None else source
            rows = rows.rows
        self._set(rows=_checked(rows), kind=kind or "exact", source=source or "")

    @property
    def dim(self) -> int:
        """2 or 3."""
        return int(self.rows.shape[1]) - 1

    @property
    def centres(self) -> NDArray[np.float64]:
        """The centres, shape (n, dim)."""
        return self.rows[:, :-1]

    @property
    def radii(self) -> NDArray[np.float64]:
        """The radii, shape (n,)."""
        return self.rows[:, -1]

    def as_kind(self, kind: str) -> Balls:
        """The same balls, of another kind: you vouch for it."""
        return Balls(self.rows, kind, self.source)

    def __getitem__(self, which: Any) -> Balls:
        """Some of the balls: a slice, a mask, or an array of indices. Inner balls stay inner and
        exact ones are the smaller solid; outer balls that are not all there need not cover, and
        are `unknown`."""
        if not isinstance(which, (slice, list, np.ndarray)) or is_masked(which):
            raise TypeError("balls[...] takes a slice, a mask or an array of indices")
        index = np.arange(len(self))[which]
        if index.ndim != 1:
            raise TypeError("balls[...] takes one mask or one array of indices")
        kind = self.kind
        if kind == "outer" and len(np.unique(index)) < len(self):
            kind = "unknown"
        return Balls(self.rows[index], kind, self.source)

    def __add__(self, other: object) -> Balls:
        return union([self, other]) if isinstance(other, Balls) else NotImplemented

    def __array__(self, *_: Any, **__: Any) -> Any:
        raise TypeError("an array has no kind: balls.rows is one, if the kind does not matter")

    def __len__(self) -> int:
        return len(self.rows)

    def __repr__(self) -> str:
        source = f", from {self.source}" if self.source else ""
        return f"<Balls: {len(self)} {self.kind}, dim {self.dim}{source}>"

    def __reduce__(self) -> tuple[Any, ...]:
        return Balls, (np.array(self.rows), self.kind, self.source)


def union(sets: Iterable[Balls]) -> Balls:
    """All balls of several sets, which stand for the union of their solids, in one frame.

    The kind is what holds for the union: of inner and exact sets inner, of outer and exact sets
    outer, else of several kinds unknown.
    """
    given = list(sets)
    if not given or not all(isinstance(one, Balls) for one in given):
        raise InputError("a union is made of one or more Balls")
    if len({one.dim for one in given}) > 1:
        raise InputError("balls of different dimensions have no union")
    kinds = {one.kind for one in given} - {"exact"}
    kind = "exact" if not kinds else kinds.pop() if len(kinds) == 1 else "unknown"
    sources = list(dict.fromkeys(one.source for one in given if one.source))
    return Balls(np.concatenate([one.rows for one in given]), kind, ", ".join(sources))


def exact_rows(rows: Any) -> NDArray[np.float64]:
    """A copy as float64 of an array of shape (n, 3) or (n, 4), without rounding, or an error."""
    if is_masked(rows):
        raise InputError("a masked array: say which balls you mean, array.compressed() or filled()")
    try:
        array = np.asarray(rows)
    except (ValueError, TypeError):
        raise InputError("balls are rows of one length: x y r or x y z r") from None
    if array.ndim != 2 or array.shape[1] not in (3, 4):
        raise InputError(
            f"balls are rows x y r or x y z r: an array of shape (n, 3) or (n, 4), not "
            f"{array.shape}; no balls at all: numpy.zeros((0, 3))"
        )
    if array.dtype.kind not in "fiu":
        raise InputError(f"balls are real numbers, not {array.dtype}")
    with np.errstate(over="ignore", invalid="ignore"):
        result = np.array(array, dtype=np.float64, order="C", copy=True)
    if array.dtype.itemsize >= 8 and array.dtype != np.float64:
        wide = result.astype(array.dtype) if (abs(result) < 2.0**62).all() else None
        if wide is None or (wide != array).any():
            raise InputError(
                f"numbers of type {array.dtype} that float64 does not hold exactly; round "
                "them yourself, inner balls inward and outer balls outward"
            )
    return result


def _checked(rows: Any) -> NDArray[np.float64]:
    """A copy of the rows as float64 that cannot be written to, without rounding, or an error."""
    result = exact_rows(rows)
    if not np.isfinite(result).all():
        raise InputError(f"ball {int(np.argmin(np.isfinite(result).all(axis=1)))}: NaN or infinite")
    if (abs(result) > LARGEST).any():
        raise InputError(f"a length of more than {LARGEST:g} metres")
    if (result[:, -1] < 0).any():
        raise InputError(
            f"ball {int(np.argmax(result[:, -1] < 0))}: the radius is negative; files of "
            "cuRobo mark balls that are switched off like that: leave them out"
        )
    made: NDArray[np.float64] = frozen_array(result)
    return made


@dataclass(frozen=True)
class Solid:
    """A rigid solid: balls inside it, balls that cover it, or both. `exact` balls are both.

    `inner` takes balls of kind inner, exact or unknown, `outer` of kind outer, exact or unknown;
    unknown ones prove nothing unless the user insists."""

    inner: Balls | None
    outer: Balls | None

    def __post_init__(self) -> None:
        if self.inner is None and self.outer is None:
            raise KindError("a solid needs inner balls, outer balls, or both")
        for balls, wrong in ((self.inner, "outer"), (self.outer, "inner")):
            if balls is not None and not isinstance(balls, Balls):
                raise InputError("a Solid is made of Balls, which say what they are")
            if balls is not None and balls.kind == wrong:
                raise KindError(
                    f"{wrong} balls given as the {'outer' if wrong == 'inner' else 'inner'} ones"
                )
        if self.inner is not None and self.outer is not None and self.inner.dim != self.outer.dim:
            raise InputError("the inner balls and the outer ones are of different dimensions")
        if (
            self.inner is not None
            and self.outer is not None
            and self.inner.kind == self.outer.kind == "exact"
            and not np.array_equal(self.inner.rows, self.outer.rows)
        ):
            raise KindError("two different sets of balls cannot both be the solid")

    @property
    def dim(self) -> int:
        """2 or 3."""
        some = self.inner if self.inner is not None else self.outer
        assert some is not None
        return some.dim

    def proves(self, side: str) -> bool:
        """Can this side, 'inner' or 'outer', prove anything about the solid?"""
        balls = self.inner if side == "inner" else self.outer
        return balls is not None and balls.kind in (side, "exact")

    def is_exact(self) -> bool:
        """Are the balls the solid?"""
        return all(b is not None and b.kind == "exact" for b in (self.inner, self.outer))

    def kinds(self) -> str:
        """What it is made of, in words."""
        given = [balls.kind for balls in (self.inner, self.outer) if balls is not None]
        return " and ".join(dict.fromkeys(given))


SolidLike = Union[Solid, Balls, NDArray[Any], list[Any], tuple[Any, ...]]


def solid(value: Any) -> Solid:
    """A Solid from a Solid, Balls, an array of rows (which you say to be the solid), a Fit,
    or a mesh or polygon, for which balls are made with the default settings."""
    if isinstance(value, Solid):
        return value
    if hasattr(value, "solid") and not isinstance(value, Balls):
        made = value.solid()
        if isinstance(made, Solid):
            return made
    if hasattr(value, "geom_type") or (hasattr(value, "vertices") and hasattr(value, "faces")):
        from .shapes import fit

        return fit(value).solid()
    balls = value if isinstance(value, Balls) else Balls(value)
    if balls.kind == "inner":
        return Solid(balls, None)
    if balls.kind == "outer":
        return Solid(None, balls)
    return Solid(balls, balls)


# ---- the grid ------------------------------------------------------------------------------------


def to_grid(balls: Balls, unit: float) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """Two sets of rows x, y, z, r of int32: rounded inward (some may be gone), and outward.

    unit is a power of two, so x / unit is exact but for underflow, which the comparisons below
    notice: n * unit is exact for |n| < 2^29. A centre goes to the nearest grid point, by less than
    0.71 units in the plane and 0.867 in space; the inner radius floor(r / unit) - 1 then lies
    inside the ball given, the outer radius ceil(r / unit) + 1 covers it. Where the centre is a grid
    point floor and ceil will do. The rule is that of the command, src/host/convert.c.
    """
    rows, dim = balls.rows, balls.dim
    scaled = rows[:, :-1] / unit
    nearest = np.rint(scaled)
    moved = (nearest * unit != rows[:, :-1]).any(axis=1)
    radii = rows[:, -1]
    low, high = np.floor(radii / unit), np.ceil(radii / unit)
    low -= moved | (low * unit > radii)
    high += moved | (high * unit < radii)
    outer = np.zeros((len(rows), 4), dtype=np.int32)
    outer[:, :dim] = nearest
    outer[:, 3] = high
    inner = outer.copy()
    inner[:, 3] = low
    return np.ascontiguousarray(inner[low >= 0]), outer
