"""Poses in metres and radians, one or many, and their way to the integer grid and back.

A pose takes the point p of the object to x + R p. In the plane it is a plain (x, y, theta), theta
in radians, counter-clockwise. In space it is a 4x4 matrix, or a Pose made by from_wxyz or
from_xyzw: a plain row of seven numbers is refused, as nobody can tell the order of its quaternion.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from .errors import PoseError
from .frozen import frozen_array, is_masked

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]

UNIT = 1e-3  # how far from 1 the length of a quaternion may be; it is made 1
RIGID = 1e-6  # how far from orthonormal the rotation of a matrix may be, each entry of R^T R - 1


NO_UNIT = (
    "a quaternion is not of length 1 (to 1e-3): normalise it, and check that its order is the one "
    "of the function's name"
)
NOT_FLAT = "a rotation in the plane is about z: its quaternion is (w, 0, 0, z)"


@dataclass(frozen=True)
class Pose:
    """One pose: `x` where the object's origin is (metres), `wxyz` a unit quaternion.

    In the plane x has two entries, and the quaternion is about z; `theta` is its angle.
    Other shapes, NaN, and quaternions that are not of length 1 (to 1e-3) are refused.
    """

    x: tuple[float, ...]
    wxyz: tuple[float, float, float, float]

    def __post_init__(self) -> None:
        try:
            x = tuple(map(float, self.x))
            q = tuple(map(float, self.wxyz))
        except (TypeError, ValueError, OverflowError):
            raise PoseError("a pose is made of real numbers") from None
        if len(x) not in (2, 3) or len(q) != 4:
            raise PoseError(f"a pose has x of length 2 or 3 and wxyz of 4, not {len(x)}, {len(q)}")
        size = math.hypot(*q)
        if not (all(map(math.isfinite, x)) and math.isfinite(size)):
            raise PoseError("pose: NaN or infinite")
        if abs(size - 1) > UNIT:
            raise PoseError(NO_UNIT)
        if len(x) == 2 and (q[1] or q[2]):
            raise PoseError(NOT_FLAT)
        if abs(size - 1) > 1e-15:
            q = tuple(value / size for value in q)
        object.__setattr__(self, "x", x)
        object.__setattr__(self, "wxyz", q)

    @property
    def dim(self) -> int:
        """2 or 3."""
        return len(self.x)

    @property
    def theta(self) -> float:
        """The angle about z in radians, in (-pi, pi]; of a pose in the plane."""
        if self.dim != 2:
            raise PoseError("theta is an angle in the plane; in space see wxyz or matrix()")
        w, z = self.wxyz[0], self.wxyz[3]
        if w < 0 or (w == 0 and z < 0):
            w, z = -w, -z
        return float(2 * np.arctan2(z, w))

    def matrix(self) -> Floats:
        """The pose as a homogeneous matrix: 3x3 in the plane, 4x4 in space."""
        matrix = np.eye(self.dim + 1)
        matrix[: self.dim, : self.dim] = rotation_matrices(np.array([self.wxyz]))[0][
            : self.dim, : self.dim
        ]
        matrix[: self.dim, self.dim] = self.x
        return matrix

    def __str__(self) -> str:
        place = ", ".join(f"{value:.6g}" for value in self.x)
        if self.dim == 2:
            return f"({place}, {self.theta:.6g} rad)"
        return f"({place}; wxyz {', '.join(f'{value:.6g}' for value in self.wxyz)})"


def distance(one: Pose, other: Pose) -> tuple[float, float]:
    """How far the places of two poses are apart, and the angle between their rotations."""
    p, q = one.wxyz, other.wxyz
    less = math.dist(p, q) if sum(map(math.prod, zip(p, q))) >= 0 else math.dist(p, [-v for v in q])
    return math.dist(one.x, other.x), 4 * math.asin(min(less / 2, 1.0))


@dataclass(frozen=True, eq=False)
class Poses:
    """Many poses: `x` of shape (n, 2) or (n, 3), `wxyz` unit quaternions of shape (n, 4).

    Both are copied, cannot be changed, and are checked as for a Pose."""

    x: Floats
    wxyz: Floats

    def __post_init__(self) -> None:
        x, q = real(self.x, "x"), real(self.wxyz, "wxyz")
        if x.ndim != 2 or x.shape[1] not in (2, 3) or q.shape != (len(x), 4):
            raise PoseError(
                f"x of shape (n, 2) or (n, 3) and wxyz of shape (n, 4) are wanted, not {x.shape} "
                f"and {q.shape}"
            )
        with np.errstate(over="ignore"):
            size = np.linalg.norm(q, axis=1)
        if (abs(size - 1) > UNIT).any():
            raise PoseError(f"pose {int(np.argmax(abs(size - 1) > UNIT))}: {NO_UNIT}")
        if x.shape[1] == 2 and q[:, 1:3].any():
            raise PoseError(f"pose {int(np.argmax(q[:, 1:3].any(axis=1)))}: {NOT_FLAT}")
        wrong = abs(size - 1) > 1e-15
        if wrong.any():
            q[wrong] /= size[wrong, None]
        object.__setattr__(self, "x", frozen_array(x))
        object.__setattr__(self, "wxyz", frozen_array(q))

    @property
    def dim(self) -> int:
        """2 or 3."""
        return int(self.x.shape[1])

    def __len__(self) -> int:
        return len(self.x)

    def __getitem__(self, index: int) -> Pose:
        w, x, y, z = map(float, self.wxyz[index])
        return Pose(tuple(map(float, self.x[index])), (w, x, y, z))

    @property
    def theta(self) -> Floats:
        """The angles about z in radians, of poses in the plane."""
        return np.asarray([pose.theta for pose in map(self.__getitem__, range(len(self)))])

    def matrices(self) -> Floats:
        """Homogeneous matrices of shape (n, dim + 1, dim + 1)."""
        dim = self.dim
        result = np.zeros((len(self), dim + 1, dim + 1))
        result[:, :dim, :dim] = rotation_matrices(self.wxyz)[:, :dim, :dim]
        result[:, :dim, dim] = self.x
        result[:, dim, dim] = 1
        return result


PoseLike = Union[Pose, Sequence[float], NDArray[Any]]
PosesLike = Union[Poses, Pose, Sequence[Any], NDArray[Any]]


def rotation_matrices(wxyz: Floats) -> Floats:
    """Rotation matrices of shape (n, 3, 3) of quaternions of any length."""
    from scipy.spatial.transform import Rotation

    matrices: Floats = Rotation.from_quat(wxyz[:, [1, 2, 3, 0]]).as_matrix()
    return matrices


def real(values: Any, what: str) -> Floats:
    """The values as a new array of float64, exactly, or an error that says what they are."""
    if is_masked(values):
        raise PoseError(f"{what}: a masked array; leave out what it hides: array.compressed()")
    try:
        array = np.asarray(values)
    except (ValueError, OverflowError):
        raise PoseError(f"{what}: rows of one length, of real numbers, are wanted") from None
    if array.dtype.kind not in "fiu" or array.dtype.itemsize > 8:
        raise PoseError(f"{what}: numbers of type {array.dtype}; use float64")
    result = array.astype(np.float64)
    if not np.isfinite(result).all():
        raise PoseError(f"{what}: NaN or infinite")
    if array.dtype.kind in "iu" and array.dtype.itemsize == 8 and (abs(result) >= 2.0**53).any():
        raise PoseError(f"{what}: whole numbers that float64 does not hold exactly")
    return result


def _from_quaternions(x: ArrayLike, quaternions: ArrayLike, order: list[int]) -> Pose | Poses:
    place, turn = real(x, "position"), real(quaternions, "quaternion")
    single = place.ndim == 1
    place, turn = np.atleast_2d(place), np.atleast_2d(turn)
    if place.ndim != 2 or place.shape[1] != 3 or turn.shape != (len(place), 4):
        raise PoseError(
            f"positions of shape (n, 3) and quaternions of shape (n, 4) are wanted, not "
            f"{place.shape} and {turn.shape}"
        )
    with np.errstate(over="ignore"):
        size = np.linalg.norm(turn, axis=1, keepdims=True)
    if (abs(size - 1) > UNIT).any():
        raise PoseError(NO_UNIT)
    poses = Poses(place, turn[:, order] / size)
    return poses[0] if single else poses


def from_wxyz(x: ArrayLike, wxyz: ArrayLike) -> Any:
    """A Pose (or Poses, from arrays of rows) from positions and quaternions w, x, y, z."""
    return _from_quaternions(x, wxyz, [0, 1, 2, 3])


def from_xyzw(x: ArrayLike, xyzw: ArrayLike) -> Any:
    """A Pose (or Poses, from arrays of rows) from positions and quaternions x, y, z, w."""
    return _from_quaternions(x, xyzw, [3, 0, 1, 2])


def _xytheta(rows: ArrayLike) -> Floats:
    array = real(rows, "poses")
    if array.ndim != 2 or array.shape[1] != 3:
        raise PoseError(f"rows x, y, theta are wanted, not an array of shape {array.shape}")
    return array


def from_xytheta(rows: ArrayLike) -> Poses:
    """Poses in the plane from rows x, y, theta."""
    array = _xytheta(rows)
    wxyz = np.zeros((len(array), 4))
    wxyz[:, 0], wxyz[:, 3] = np.cos(array[:, 2] / 2), np.sin(array[:, 2] / 2)
    return Poses(np.ascontiguousarray(array[:, :2]), wxyz)


def from_matrices(matrices: ArrayLike) -> Poses:
    """Poses in space from rigid 4x4 matrices of shape (n, 4, 4), or an error that names the first
    bad one."""
    from scipy.spatial.transform import Rotation

    array = real(matrices, "matrix")
    if array.ndim != 3 or array.shape[1:] != (4, 4):
        raise PoseError(f"matrices of shape (n, 4, 4) are wanted, not {array.shape}")
    if not len(array):
        return Poses(np.zeros((0, 3)), np.zeros((0, 4)))
    turn = array[:, :3, :3]
    last = (array[:, 3] != [0, 0, 0, 1]).any(axis=1)
    with np.errstate(over="ignore", invalid="ignore"):
        square = np.einsum("nki,nkj->nij", turn, turn)
        skew = ~(abs(square - np.eye(3)) <= RIGID).all(axis=(1, 2))
    left = ~skew & (np.linalg.det(np.where(skew[:, None, None], np.eye(3), turn)) < 0)
    for bad, why in (
        (last, "the last row is not 0 0 0 1"),
        (skew, "it scales or shears: the object is rigid"),
        (left, "it is left-handed: a mirror image, no motion"),
    ):
        if bad.any():
            raise PoseError(f"matrix {int(np.argmax(bad))} is no pose: {why}")
    xyzw = Rotation.from_matrix(turn).as_quat()
    return Poses(np.ascontiguousarray(array[:, :3, 3]), xyzw[:, [3, 0, 1, 2]])


def pose(value: PoseLike, dim: int) -> Pose:
    """One pose of that dimension from whatever the module takes."""
    if isinstance(value, Pose):
        if value.dim != dim:
            raise PoseError(f"the pose has {value.dim} dimensions, the scene {dim}")
        return value
    if (
        dim == 2
        and type(value) is tuple
        and len(value) == 3
        and all(type(v) in (int, float) for v in value)
    ):
        try:
            x, y, theta = map(float, value)
        except OverflowError:
            raise PoseError("pose: a number beyond the range of doubles") from None
        if not (math.isfinite(x) and math.isfinite(y) and math.isfinite(theta)):
            raise PoseError("pose: NaN or infinite")
        return Pose((x, y), (math.cos(theta / 2), 0.0, 0.0, math.sin(theta / 2)))
    if is_masked(value):
        raise PoseError("pose: a masked array")
    try:
        array = np.asarray(value)
    except (ValueError, OverflowError):
        raise PoseError("pose: real numbers are wanted") from None
    if dim == 2:
        if array.shape != (3,):
            raise PoseError(
                f"a pose in the plane is (x, y, theta), not an array of shape {array.shape}"
            )
        return from_xytheta(array[None])[0]
    if array.shape == (7,):
        raise PoseError(
            "seven numbers: say which quaternion they hold, by libcage.from_wxyz(x, q) or "
            "libcage.from_xyzw(x, q)"
        )
    if array.shape != (4, 4):
        raise PoseError(
            f"a pose in space is a 4x4 matrix or a Pose, not an array of shape {array.shape}"
        )
    return from_matrices(array[None])[0]


def poses(values: PosesLike, dim: int) -> Poses:
    """Many poses of that dimension: rows x, y, theta, matrices (n, 4, 4), a list of Pose, or
    Poses."""
    if isinstance(values, Pose):
        values = [values]
    if isinstance(values, (list, tuple)) and values and all(isinstance(v, Pose) for v in values):
        values = Poses(np.array([v.x for v in values]), np.array([v.wxyz for v in values]))
    if isinstance(values, Poses):
        if values.dim != dim:
            raise PoseError(f"the poses have {values.dim} dimensions, the scene {dim}")
        return values
    if isinstance(values, (list, tuple)) and not values:
        return Poses(np.zeros((0, dim)), np.zeros((0, 4)))
    return from_xytheta(values) if dim == 2 else from_matrices(values)


# ---- the grid ------------------------------------------------------------------------------------


def _placed(x: Floats, unit: float) -> Ints:
    """Rows as of to_grid with the places alone."""
    dim = x.shape[1]
    grid = np.zeros((len(x), 7), dtype=np.int32)
    place = np.rint(x / unit)
    near = abs(place) <= _native.REACH[dim]
    if not near.all():
        index = int(np.argmin(near.all(axis=1)))
        raise PoseError(
            f"pose {index} at {x[index].tolist()} is beyond the grid, which ends at "
            f"{_native.REACH[dim] * unit:.6g}: use a larger unit"
        )
    grid[:, :dim] = place
    return grid


def grid_rows(values: PosesLike, dim: int, unit: float) -> Ints:
    """to_grid of whatever the module takes; of rows x, y, theta in one go."""
    if not (dim == 2 and isinstance(values, np.ndarray) and values.ndim == 2):
        return to_grid(poses(values, dim), unit)
    array = _xytheta(values)
    grid, half = _placed(array[:, :2], unit), array[:, 2] / 2
    grid[:, 3] = np.rint(np.cos(half) * _native.QUATERNION[2])
    grid[:, 6] = np.rint(np.sin(half) * _native.QUATERNION[2])
    return grid


def to_grid(many: Poses, unit: float) -> Ints:
    """Rows x, y, z, qw, qx, qy, qz of int32, each the nearest that the grid has.

    Quarter turns in the plane come out exact: the cosine and sine of an eighth of a turn round to
    the same integer. Out of reach is an error that names the first pose.
    """
    dim = many.dim
    grid = _placed(many.x, unit)
    turn = many.wxyz * _native.QUATERNION[dim]
    if dim == 3:
        turn /= abs(many.wxyz).max(axis=1, initial=0, keepdims=True)
    grid[:, 3:] = np.rint(turn)
    return grid


def row_of(one: Pose, unit: float) -> list[int]:
    """One row as of to_grid, without the cost of arrays."""
    if any(abs(value / unit) >= _native.REACH[one.dim] + 0.5 for value in one.x):
        raise PoseError(
            f"the pose at {list(one.x)} is beyond the grid, which ends at "
            f"{_native.REACH[one.dim] * unit:.6g}: use a larger unit"
        )
    place = [round(value / unit) for value in one.x]
    scale = float(_native.QUATERNION[one.dim])
    if one.dim == 3:
        scale /= max(map(abs, one.wxyz))
    return place + [0] * (3 - one.dim) + [round(value * scale) for value in one.wxyz]


def pose_of(row: Sequence[int], dim: int, unit: float) -> Pose:
    """A row of the grid as a Pose of the object's origin."""
    w, x, y, z = row[3:]
    size = math.sqrt(w * w + x * x + y * y + z * z)
    return Pose(
        tuple(value * unit for value in row[:dim]), (w / size, x / size, y / size, z / size)
    )


def from_grid(grid: Ints, dim: int, unit: float, pivot: Sequence[int] | None = None) -> Poses:
    """Poses of the object's origin; with a pivot the rows are poses of that point of the object."""
    turn = grid[:, 3:].astype(np.float64)
    turn /= np.linalg.norm(turn, axis=1, keepdims=True)
    place = grid[:, :3].astype(np.float64)
    if pivot is not None and any(pivot) and len(grid):
        place -= rotation_matrices(turn) @ np.asarray(pivot, dtype=np.float64)
    return Poses(np.ascontiguousarray(place[:, :dim]) * unit, turn)
