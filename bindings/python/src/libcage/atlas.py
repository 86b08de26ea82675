"""The atlas: how all poses of a scene are connected, made once and asked many times."""

from __future__ import annotations

import ctypes
import math
import os
import struct
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, cast

import numpy as np
from numpy.typing import NDArray

from . import _native, grid as grids, surveys
from .balls import LARGEST
from .errors import AtlasError, InputError, PoseError
from .frozen import Frozen, real_number, whole
from .pool import ExecutorLike
from .poses import (
    Ints,
    Pose,
    PoseLike,
    PosesLike,
    Poses,
    from_grid,
    grid_rows,
    pose as read_pose,
)
from .proof import Crew, most_bytes, reachable
from .result import Verdict

if TYPE_CHECKING:
    from .scene import Scene

NO_CLASS = _native.NO_CLASS


@dataclass(frozen=True)
class Class:
    """A connected class of poses on one side. Class 0 is the outside's: low and high are zeros
    there.

    low, high: a box around all places of the pivot in it, metres. middle, turn: all its rotations
    are within the angle turn (radians; pi: they may be any) of the rotation of the pose middle.
    pose: one of its poses.
    """

    number: int
    cells: int
    nodes: int
    low: tuple[float, ...]
    high: tuple[float, ...]
    middle: Pose
    turn: float
    pose: Pose | None


class Atlas(Frozen):
    """An opened atlas: bytes that are read in place. Many threads may ask at once; it can be
    pickled.

    `about` says what its answers are about; `unit` is the grid's unit in metres.
    """

    __slots__ = ("unit", "dim", "insisted", "_bytes", "_struct", "__weakref__")
    unit: float
    dim: int
    insisted: bool
    _bytes: NDArray[np.uint8]
    _struct: _native.AtlasStruct

    def __init__(self, data: bytes | bytearray | memoryview | NDArray[np.uint8]) -> None:
        try:
            kept = np.frombuffer(bytes(memoryview(cast(Any, data))), dtype=np.uint8)
        except TypeError:
            raise AtlasError(f"an atlas is bytes, not {type(data).__name__}") from None
        opened = _native.AtlasStruct()
        if not len(kept):
            raise AtlasError("no bytes: this is not an atlas")
        _native.lib.cage_atlas_open(
            ctypes.byref(opened), ctypes.c_void_p(kept.ctypes.data), len(kept)
        )
        unit: float = struct.unpack("=d", bytes(opened.note))[0]
        # The unit is the caller's note in the file. Python writes it negative where the balls
        # prove nothing about solids, which the command and older readers refuse.
        try:
            known = grids.check_unit(abs(unit))
        except InputError:
            raise AtlasError(
                "the atlas has no unit that is a power of two: it was made by other "
                "means, see make and the command cage atlas"
            ) from None
        dim = int(opened.dim)
        self._set(_bytes=kept, _struct=opened, insisted=unit < 0, unit=known, dim=dim)

    def __reduce__(self) -> tuple[Any, ...]:
        return Atlas, (self.to_bytes(),)

    @property
    def about(self) -> str:
        """What the answers are about."""
        return (
            "the balls only, not the solids that they stand for"
            if self.insisted
            else "the solids, by the balls that it was made from"
        )

    @property
    def sides(self) -> tuple[str, ...]:
        """What it can answer for: 'inner' (separation), 'outer' (paths), or both."""
        return tuple(name for name, bit in (("inner", 1), ("outer", 2)) if self._struct.side & bit)

    @property
    def cells(self) -> int:
        """Cells of rotations."""
        return int(self._struct.leaves)

    @property
    def pivot(self) -> tuple[float, ...]:
        """The point of the object that rotations are about, metres, in the object's frame."""
        return tuple(value * self.unit for value in self._struct.pivot[: self.dim])

    def __len__(self) -> int:
        return len(self._bytes)

    def __repr__(self) -> str:
        sides = " and ".join(self.sides)
        return f"<Atlas: dim {self.dim}, {self.cells} cells, {len(self)} bytes, {sides}>"

    def to_bytes(self) -> bytes:
        """The atlas; the same bytes on every machine, and what the command cage query reads."""
        return self._bytes.tobytes()

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the bytes: beside first, then moved into place."""
        part = os.fspath(path) + ".part"
        with open(part, "wb") as file:
            file.write(self.to_bytes())
        os.replace(part, path)

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Atlas:
        """Read what save or the command wrote."""
        with open(path, "rb") as file:
            return cls(file.read())

    # ---- questions -------------------------------------------------------------------------------

    def _rows(self, poses: PosesLike) -> Ints:
        return grid_rows(poses, self.dim, self.unit)

    def query(self, poses: PosesLike, goals: PosesLike | None = None) -> NDArray[np.int32]:
        """Verdicts as an int32 array, one for each pose: can the object leave from there, or get to
        the goal? Compare with Verdict.CAGED and the like. UNDEFINED: ask Scene.prove.

        poses, goals: rows x, y, theta in metres and radians; (n, 4, 4) matrices; Poses. The answers
        are about these poses rounded to the atlas's grid, places by up to half a `unit`: rounded()
        tells which they are. goals: as many as poses, or one for all.
        """
        rows = self._rows(poses)
        ends = None
        if goals is not None:
            ends = self._rows([goals] if isinstance(goals, Pose) else goals)
            if len(ends) == 1:
                ends = np.ascontiguousarray(np.broadcast_to(ends, rows.shape))
            if len(ends) != len(rows):
                raise InputError(f"{len(rows)} poses and {len(ends)} goals")
        out = np.empty(len(rows), dtype=np.int32)
        _native.lib.cagepy_ask_many(
            ctypes.byref(self._struct),
            reachable(rows),
            None if ends is None else reachable(ends),
            len(rows),
            reachable(out),
        )
        return _checked(out, 0)

    def rounded(self, poses: PosesLike) -> Poses:
        """The poses that query, ask and locate answer about when they are asked about these."""
        return from_grid(self._rows(poses), self.dim, self.unit)

    def ask(self, pose: PoseLike, goal: PoseLike | None = None) -> Verdict:
        """The verdict for one pose, rounded to the grid as in query."""
        ends = None if goal is None else _one(read_pose(goal, self.dim))
        return Verdict(int(self.query(_one(read_pose(pose, self.dim)), ends)[0]))

    def locate(self, poses: PosesLike, side: str = "inner") -> NDArray[np.int32]:
        """The class of each pose on one side; NO_CLASS where balls cover it."""
        rows = self._rows(poses)
        out = np.empty(len(rows), dtype=np.int32)
        _native.lib.cagepy_locate_many(
            ctypes.byref(self._struct), reachable(rows), len(rows), self._side(side), reachable(out)
        )
        return _checked(out, NO_CLASS)

    def _side(self, side: str) -> int:
        if side not in self.sides:
            raise InputError(f"side {side!r}: this atlas has {' and '.join(self.sides)}")
        return {"inner": _native.INNER, "outer": _native.OUTER}[side]

    def classes(self, side: str = "inner") -> list[Class]:
        """All connected classes on one side. A bounded one of the inner side is a cage."""
        number = self._side(side)
        made = []
        for index in range(self._struct.classes[number - 1]):
            raw = _native.ClassStruct()
            _native.lib.cage_atlas_class(
                ctypes.byref(self._struct), number, index, ctypes.byref(raw)
            )
            pose = None
            if raw.known:
                row = np.array([[*raw.pose.x, *raw.pose.q]], dtype=np.int32)
                pose = from_grid(row, self.dim, self.unit, tuple(self._struct.pivot))[0]
            low, high = (
                tuple(value * self.unit for value in box[: self.dim]) for box in (raw.low, raw.high)
            )
            q = [*raw.q] if any(raw.q) else [1, 0, 0, 0]
            middle = from_grid(np.array([[0, 0, 0, *q]], dtype=np.int32), self.dim, self.unit)[0]
            turn = 2 * math.asin(min(raw.sine / 2.0**30, 1.0))
            made.append(Class(index, raw.cells, raw.nodes, low, high, middle, turn, pose))
        return made


def _one(pose: Pose) -> Poses:
    return Poses(np.array([pose.x]), np.array([pose.wxyz]))


def _checked(out: Ints, allowed: int) -> Ints:
    bad = (out < 0) & (out != allowed)
    if bad.any():
        index = int(np.argmax(bad))
        error = _native.failure(int(out[index]), f"pose {index}")
        raise PoseError(str(error), int(out[index]))
    return out


def make(
    scene: Scene,
    level: int | None = None,
    *,
    budget: int = 0,
    side: str = "both",
    memory: int | None = None,
    threads: int | None = None,
    progress: bool = False,
    insist: bool = False,
    far: float = 0.0,
    executor: ExecutorLike | None = None,
    parts: int = 16,
    retries: int = 3,
    checkpoint: str | os.PathLike[str] | None = None,
) -> Atlas:
    """Make the atlas of a scene.

    level: of the cells of rotations to begin with (None: chosen from the balls).
    budget: 0, or cells are cut where the two sides disagree until that many were made.
    far: poses with coordinates up to so many metres will be asked; four times the scene's own reach
    always fit, at the cost of two bits of the grid.
    executor: slices are made in that many parts on any concurrent.futures.Executor, or on what a
    function makes; here is left to do what is between the parts. The atlas is the same bytes.
    retries, checkpoint: as in prove_many.
    Other arguments as in Scene.prove. Ctrl-C stops it.
    """
    chosen, use, _, note = scene._permit(side, insist)
    if budget and use != _native.BOTH:
        raise InputError(
            "budget: cells are cut where the two sides disagree, and one is missing. " + note
        )
    far = real_number(far, "far, in metres")
    if not 0 <= far <= LARGEST:
        raise InputError(f"far: 0 to {LARGEST:g} metres, not {far!r}")
    made = chosen.grid(max(far, scene._reach, scene._object_reach), 4.0)
    plan = _native.Plan()
    _native.lib.cage_plan_default(ctypes.byref(plan))
    plan.side, plan.max_cells = use, whole(budget, "budget", 0, 1 << 24)
    most_level = _native.LEVEL_MAX[scene.dim]
    plan.level = -1 if level is None else whole(level, "level", 0, most_level)
    unit = -made.unit if chosen is not scene else made.unit
    plan.note[:] = struct.unpack("=ii", struct.pack("=d", unit))
    most = most_bytes(memory)
    size = int(_native.lib.cage_survey_size(ctypes.byref(made.struct), ctypes.byref(plan)))
    if size == 0:
        raise InputError(
            f"the cells down to level {level or 0} are more than "
            + (f"the budget of {budget}" if budget else "2**24: a lower level is wanted")
        )
    size = min(max(size, 64 << 20), most)
    pairs = len(made.arrays[1]) * len(made.arrays[3])
    facts: list[bytes] = []
    if executor is not None:
        facts = surveys.parts(made, plan, most, executor, parts, retries, checkpoint)
    crew = Crew(threads, pairs)
    if not progress:
        return Atlas(surveys.atlas(made, plan, size, most, crew, facts, None))
    from tqdm.auto import tqdm

    with tqdm(desc="atlas", unit=" slices") as bar:
        return Atlas(surveys.atlas(made, plan, size, most, crew, facts, bar))
