"""What a proof answers: verdict, what it rests on and is about, path, counts, margin."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from enum import IntEnum
from typing import TYPE_CHECKING, Any

import numpy as np

from .errors import InputError
from .frozen import frozen_array
from .poses import Ints, Pose, Poses, distance, from_grid, pose_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .scene import Scene


NOTICED = 1e-6  # metres or radians between the pose asked and the one proved that str() tells


class Verdict(IntEnum):
    """The answer. All but UNDEFINED are theorems about the balls; str() is the name."""

    UNDEFINED = 0
    CAGED = 1
    DISCONNECTED = 2
    FREE = 3
    CONNECTED = 4
    IN_COLLISION = 5

    def __str__(self) -> str:
        return self.name

    @property
    def separated(self) -> bool:
        """CAGED or DISCONNECTED: there is no path."""
        return self in (Verdict.CAGED, Verdict.DISCONNECTED)

    @property
    def joined(self) -> bool:
        """FREE or CONNECTED: there is a path."""
        return self in (Verdict.FREE, Verdict.CONNECTED)


@dataclass(frozen=True)
class Statistics:
    """Counts of work. Pairs are (inner side, outer side)."""

    level: int
    cells: int
    slices: tuple[int, int]
    gluings: tuple[int, int]
    mixtures: tuple[int, int]
    reached: tuple[int, int]
    balls: tuple[int, int]
    inserted: tuple[int, int]
    steps: int
    peak_bytes: int = field(compare=False)
    seconds: float = field(compare=False, default=0.0)


@dataclass(frozen=True, eq=False)
class Path:
    """A certified path: from each pose to the next the object moves straight without turning, or
    turns the shorter way about its point `pivot` (metres, in the object's frame), which stays.

    Smoothed (`curve` is True) it does both at once, its poses evenly apart in time: from row to row
    the pivot goes on the cubic whose slope at a row is half the difference of its neighbours (at
    an end: the difference to the one), the object turning at a constant rate.

    `grid` has the poses of the pivot as exact integers: rows x, y, z, qw, qx, qy, qz. `scene` is
    the one it was found in, None if it was read from bytes.
    """

    grid: Ints
    pivot_grid: tuple[int, int, int]
    unit: float
    dim: int
    start_grid: tuple[int, ...]
    goal_grid: tuple[int, ...] | None
    curve: bool = False
    scene: Scene | None = field(default=None, repr=False)

    def __len__(self) -> int:
        return len(self.grid)

    def __eq__(self, other: object) -> bool:
        return (
            isinstance(other, Path)
            and np.array_equal(self.grid, other.grid)
            and (self.pivot_grid, self.unit, self.dim, self.curve)
            == (other.pivot_grid, other.unit, other.dim, other.curve)
        )

    def smooth(self, scene: Scene | None = None) -> Path:
        """A shorter path without corners between the same ends: moves and turns together.

        Found by descent in floating point, and certified as a whole curve by the C library, in
        exact integers; the path itself where none better is certified. scene: where it was read
        from bytes, the one it belongs to."""
        from .smoothing import smooth

        return smooth(self, scene)

    def plot(self, ax: Axes | None = None, frames: int = 14, scene: Scene | None = None) -> Axes:
        """The path in the plane with matplotlib, over its scene."""
        from .plot import path

        return path(self._scene(scene), self, frames, ax)

    def animate(self, frames: int = 40, scene: Scene | None = None) -> Any:
        """A plotly figure in which the object runs along the path, in the plane or in space."""
        from .view import animation

        return animation(self._scene(scene), self, frames)

    def _scene(self, scene: Scene | None) -> Scene:
        found = self.scene if scene is None else scene
        if found is None:
            raise InputError("this path was read from bytes: say of which scene it is, scene=...")
        return found

    @property
    def start(self) -> Pose:
        """Where it begins."""
        return pose_of(self.start_grid, self.dim, self.unit)

    @property
    def goal(self) -> Pose | None:
        """Where it ends; None: far away."""
        return None if self.goal_grid is None else pose_of(self.goal_grid, self.dim, self.unit)

    @property
    def pivot(self) -> tuple[float, ...]:
        """The point of the object that it turns about, in metres."""
        return tuple(value * self.unit for value in self.pivot_grid[: self.dim])

    @property
    def poses(self) -> Poses:
        """The poses of the object's origin at the way points."""
        return from_grid(self.grid, self.dim, self.unit, self.pivot_grid)

    def frames(self, count: int) -> Poses:
        """About `count` poses of the object's origin along the path, the way points among them.

        Turns are about the pivot, as proved; for pictures (the poses between are rounded doubles).
        """
        from scipy.spatial.transform import Rotation, Slerp

        places = self.grid[:, :3].astype(float)
        turns = Rotation.from_quat(self.grid[:, [4, 5, 6, 3]].astype(float))
        size = max(float(np.ptp(places, axis=0).max(initial=0)), 1.0)
        length = np.linalg.norm(np.diff(places, axis=0), axis=1) / size
        length += (turns[:-1].inv() * turns[1:]).magnitude() / np.pi if len(self) > 1 else 0
        total = max(float(length.sum()), 1e-12)
        out_x, out_q = [places[:1]], [turns[:1].as_quat()]
        for i, part in enumerate(length):
            steps = max(1, round(count * float(part) / total))
            t = np.arange(1, steps + 1) / steps
            out_x.append(places[i] + t[:, None] * (places[i + 1] - places[i]))
            out_q.append(Slerp([0, 1], turns[i : i + 2])(t).as_quat())
        x, q = np.concatenate(out_x), np.concatenate(out_q)
        x = x - Rotation.from_quat(q).apply(np.array(self.pivot_grid, dtype=float))
        return Poses(x[:, : self.dim] * self.unit, q[:, [3, 0, 1, 2]])


@dataclass(frozen=True)
class Result:
    """The answer of a proof.

    `start` and `goal` are the poses that were proved: the ones given, rounded to the grid of
    `unit` metres; `start_grid` and `goal_grid` are the same as exact integers. `about` says what
    the verdict is a theorem about; `note` what was not looked for. `asked_start` and `asked_goal`
    are the poses as given (None where the result was read from bytes); where what was proved is
    noticeably elsewhere str() says so.
    """

    verdict: Verdict
    reason: str
    start: Pose
    goal: Pose | None
    start_grid: tuple[int, ...]
    goal_grid: tuple[int, ...] | None
    unit: float
    dim: int
    pivot: tuple[float, ...]
    path: Path | None
    statistics: Statistics
    about: str
    note: str = ""
    asked_start: Pose | None = field(default=None, compare=False)
    asked_goal: Pose | None = field(default=None, compare=False)

    def __str__(self) -> str:
        lines = [f"{self.verdict}: {self.reason}", f"about: {self.about}"]
        if self.note:
            lines.append(f"note: {self.note}")
        for name, asked, proved in (
            ("start", self.asked_start, self.start),
            ("goal", self.asked_goal, self.goal),
        ):
            if asked is None or proved is None:
                continue
            away, turn = distance(asked, proved)
            if away > NOTICED or turn > NOTICED:
                lines.append(
                    f"{name}: asked {asked}, proved {proved}, which is {away:.3g} m and "
                    f"{turn:.3g} rad away: the grid's unit is {self.unit:.3g} m"
                )
        return "\n".join(lines)

    def to_dict(self) -> dict[str, Any]:
        """Plain lists and numbers: everything that is the same on every machine and with any
        memory."""
        stats = {
            name: list(value) if isinstance(value, tuple) else value
            for name, value in vars(self.statistics).items()
            if name not in ("peak_bytes", "seconds")
        }
        return {
            "verdict": str(self.verdict),
            "reason": self.reason,
            "about": self.about,
            "note": self.note,
            "dim": self.dim,
            "unit": self.unit,
            "start": list(self.start_grid),
            "goal": None if self.goal_grid is None else list(self.goal_grid),
            "pivot": [round(value / self.unit) for value in self.pivot],
            "path": None if self.path is None else self.path.grid.tolist(),
            "statistics": stats,
        }

    def to_bytes(self) -> bytes:
        """to_dict as canonical JSON: equal answers are equal bytes."""
        return json.dumps(self.to_dict(), sort_keys=True, separators=(",", ":")).encode()

    @classmethod
    def from_bytes(cls, data: bytes, scene: Scene | None = None) -> Result:
        """The result that to_bytes wrote (peak_bytes and seconds are 0). scene: of its path."""
        raw = json.loads(data)
        dim, unit = int(raw["dim"]), float(raw["unit"])
        pivot = tuple(int(value) for value in raw["pivot"]) + (0,) * (3 - dim)
        path = None
        if raw["path"] is not None:
            grid = frozen_array(np.array(raw["path"], dtype=np.int32).reshape(-1, 7))
            goal = None if raw["goal"] is None else tuple(raw["goal"])
            path = Path(
                grid,
                (pivot[0], pivot[1], pivot[2]),
                unit,
                dim,
                tuple(raw["start"]),
                goal,
                scene=scene,
            )
        stats: dict[str, Any] = {
            name: tuple(value) if isinstance(value, list) else value
            for name, value in raw["statistics"].items()
        }
        return cls(
            Verdict[raw["verdict"]],
            raw["reason"],
            pose_of(raw["start"], dim, unit),
            None if raw["goal"] is None else pose_of(raw["goal"], dim, unit),
            tuple(raw["start"]),
            None if raw["goal"] is None else tuple(raw["goal"]),
            unit,
            dim,
            tuple(value * unit for value in pivot[:dim]),
            path,
            Statistics(**stats, peak_bytes=0),
            raw["about"],
            raw["note"],
        )


@dataclass(frozen=True)
class Margin:
    """By how much every radius must shrink (metres; negative: may grow) for the answer to change.

    Shrunk by `closed` the object is caged (or apart from the goal, or collides); shrunk by `open`
    it is free (or joined with the goal). What lies between was not decided. `closed` is None where
    nothing that fits the grid closes it. A cage is the tighter the larger `closed` is.
    `narrow` is the pose on the way out where it is tightest.
    """

    closed: float | None
    open: float
    proofs: int
    narrow: Pose | None
    unit: float
    about: str

    def __str__(self) -> str:
        closed = "-inf" if self.closed is None else f"{self.closed:.6g}"
        found = f"closed at {closed}, open at {self.open:.6g} ({self.proofs} proofs)"
        return f"{found}; about: {self.about}"
