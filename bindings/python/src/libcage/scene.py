"""Scene: an object, obstacles, and the questions that can be asked about them."""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from . import _native, grid as grids
from .balls import Solid, SolidLike, solid
from .errors import GridError, InputError, KindError
from .frozen import Frozen, whole
from .grid import Grid
from .poses import Ints, PoseLike, PosesLike, row_of, pose as read_pose, poses as read_poses
from .poses import from_grid, to_grid
from .proof import Proof, most_bytes, reachable
from .result import Margin, Result

if TYPE_CHECKING:
    from .atlas import Atlas

MOST_CELLS = 1 << 24
SIDES = {"inner": _native.INNER, "outer": _native.OUTER, "both": _native.BOTH}


class Scene(Frozen):
    """A rigid object and fixed obstacles, in the plane or in space. Lengths are metres.

    object: balls in the object's own frame, obstacles: balls in the world; each an array of rows `x
    y r` or `x y z r`, Balls, a Solid, or a shape (libcage.shapes). An array has no kind: by passing
    one, balls.rows too, you say that its balls are the solid. unit: the length of a grid unit, a
    power of two; left out, the finest at which scene and poses fit. Doubles are put on that grid:
    balls rounded to the safe side (inner ones inward, outer ones outward), poses to the nearest. A
    Scene is immutable, can be pickled, and can be asked by many threads at once."""

    __slots__ = (
        *("object", "obstacles", "dim", "unit"),
        *("_object_reach", "_reach", "_grids", "_insisted", "__weakref__"),
    )
    object: Solid
    obstacles: Solid
    dim: int
    unit: float | None
    _object_reach: float
    _reach: float
    _grids: dict[float, Grid]
    _insisted: Scene | None

    def __init__(self, object: SolidLike, obstacles: SolidLike, unit: float | None = None) -> None:
        part, walls = solid(object), solid(obstacles)
        if part.dim != walls.dim:
            raise InputError(f"the object has {part.dim} dimensions, the obstacles {walls.dim}")
        self._set(
            object=part,
            obstacles=walls,
            dim=part.dim,
            unit=None if unit is None else grids.check_unit(unit),
            _object_reach=grids.reach(part),
            _reach=grids.reach(walls) + 3 * grids.half_extent(part),
            _grids={},
            _insisted=None,
        )
        grids.check_count(part, walls)

    def __reduce__(self) -> tuple[Any, ...]:
        return Scene, (self.object, self.obstacles, self.unit)

    def __repr__(self) -> str:
        kinds = f"object {self.object.kinds()}, obstacles {self.obstacles.kinds()}"
        return f"<Scene: dim {self.dim}, {kinds}>"

    # ---- the grid --------------------------------------------------------------------------------

    def grid(self, far: float = 0.0, room: float = 1.0) -> Grid:
        """The scene on the finest grid that has place for poses with coordinates up to `far`."""
        if self.unit is not None:
            return self._at(self.unit, None)
        length = room * max(self._reach, far + self._object_reach)
        if length >= grids.LARGEST:
            raise GridError("the scene or a pose is too large")
        unit = max(grids.finest(length, self.dim), grids.SMALLEST)
        for _ in range(8):
            try:
                return self._at(unit, _native.OUT_OF_RANGE)
            except _TooFine:
                unit *= 2
        raise GridError("the scene fits no grid", _native.OUT_OF_RANGE)

    def at_unit(self, unit: float) -> Grid:
        """The scene on the grid of that unit."""
        return self._at(unit, None)

    def _at(self, unit: float, finer: int | None) -> Grid:
        made = self._grids.get(unit)
        if made is not None:
            return made
        if self._reach / unit > _native.REACH[self.dim] or self._object_reach / unit > 2.0**29:
            made, error = None, _native.OUT_OF_RANGE
        else:
            made, error = grids.make(self.object, self.obstacles, unit)
        if made is None:
            if error == finer:
                raise _TooFine
            raise _native.failure(error, f"the scene at a unit of {unit:g} metres")
        if len(self._grids) > 4:
            self._set(_grids={})
        self._grids[unit] = made
        return made

    # ---- kinds -----------------------------------------------------------------------------------

    def _permit(self, side: str, insist: bool) -> tuple[Scene, int, str, str]:
        """The scene and the sides to search, what an answer is about, and what is not looked
        for."""
        if side not in SIDES:
            raise InputError(f"side is 'inner', 'outer' or 'both', not {side!r}")
        kinds = f"object {self.object.kinds()}, obstacles {self.obstacles.kinds()}"
        solids = (self.object, self.obstacles)
        able = [one for one in ("inner", "outer") if all(s.proves(one) for s in solids)]
        wanted = ["inner", "outer"] if side == "both" else [side]
        if insist and any(one not in able for one in wanted):
            return (
                self._filled(),
                SIDES[side],
                f"the balls only, not the solids that they stand for ({kinds})",
                "",
            )
        use = [one for one in wanted if one in able]
        if not use:
            raise KindError(
                f"{kinds}: balls of these kinds prove nothing on the side asked for ({side}). "
                "Separation (CAGED) needs inner or exact balls of object and obstacles, paths "
                "(FREE) outer or exact ones. Check them with libcage.verify_balls or say what they "
                "are with Balls(rows, kind=...); insist=True asks about the balls as they are"
            )
        note = ""
        if len(use) < len(wanted):
            note = (
                "separation was not looked for: it takes inner or exact balls"
                if use == ["outer"]
                else "paths were not looked for: they take outer or exact balls"
            ) + f" ({kinds})"
        exact = all(s.is_exact() for s in solids)
        about = (
            "the balls, which are the solids" if exact else f"the solids, by their balls ({kinds})"
        )
        return self, SIDES["both" if len(use) == 2 else use[0]], about, note

    def _filled(self) -> Scene:
        """The same balls as if their kinds were right, a set that is alone on both sides."""
        if self._insisted is None:
            both = [_both(s) for s in (self.object, self.obstacles)]
            self._set(_insisted=Scene(both[0], both[1], self.unit))
        assert self._insisted is not None
        return self._insisted

    # ---- questions -------------------------------------------------------------------------------

    def _question(
        self,
        start: PoseLike,
        goal: PoseLike | None,
        room: float = 1.0,
    ) -> tuple[Grid, Ints, Ints | None]:
        first = read_pose(start, self.dim)
        last = None if goal is None else read_pose(goal, self.dim)
        far = max(map(abs, first.x if last is None else first.x + last.x))
        made = self.grid(far, room)
        ends = [np.array(row_of(end, made.unit), dtype=np.int32) for end in (first, last) if end]
        return made, ends[0], ends[1] if last is not None else None

    def _limits(
        self, side: int, start_level: int | None, max_level: int | None, max_cells: int | None
    ) -> _native.Limits:
        limits = _native.Limits()
        _native.lib.cage_limits_default(ctypes.byref(limits), self.dim)
        limits.side = side
        for name, value in (
            ("start_level", start_level),
            ("max_level", max_level),
            ("max_cells", max_cells),
        ):
            if value is not None:
                most = MOST_CELLS if name == "max_cells" else _native.LEVEL_MAX[self.dim]
                least = -1 if name == "start_level" else 0
                setattr(limits, name, whole(value, name, least, most))
        if limits.start_level > limits.max_level:
            raise InputError(
                f"start_level {limits.start_level} is more than max_level {limits.max_level}"
            )
        first = max(int(limits.start_level), 0)
        least = (4 << first) - 2 if self.dim == 2 else 4 * (8 ** (first + 1) - 1) // 7
        if limits.max_cells < least:
            raise InputError(
                f"max_cells: {least} or more are made down to level {first}, not "
                f"{limits.max_cells}"
            )
        return limits

    def begin(
        self,
        start: PoseLike,
        goal: PoseLike | None = None,
        *,
        side: str = "both",
        start_level: int | None = None,
        max_level: int | None = None,
        max_cells: int | None = None,
        memory: int | None = None,
        insist: bool = False,
    ) -> Proof:
        """A Proof to be run step by step: see prove for the arguments."""
        scene, use, about, note = self._permit(side, insist)
        asked = read_pose(start, self.dim), None if goal is None else read_pose(goal, self.dim)
        made, first, last = scene._question(*asked)
        limits = self._limits(use, start_level, max_level, max_cells)
        return Proof(made, first, last, limits, about, note, memory, scene, asked)

    def prove(
        self,
        start: PoseLike,
        goal: PoseLike | None = None,
        *,
        side: str = "both",
        start_level: int | None = None,
        max_level: int | None = None,
        max_cells: int | None = None,
        memory: int | None = None,
        threads: int | None = None,
        progress: bool = False,
        insist: bool = False,
    ) -> Result:
        """Can the object leave the start (goal None), or get from start to goal? A Result.

        start, goal: (x, y, theta) in metres and radians; in space a 4x4 matrix or a Pose. side:
        'inner' looks for a proof of CAGED or DISCONNECTED only, 'outer' for a path only.
        start_level, max_level, max_cells: how finely rotations are cut at first, at most, and into
        how many cells; the library's own choice without. memory: bytes that the proof's block may
        grow to (4 GiB without). threads: cores to use once it takes more than 30 ms (None: all);
        the answer is the same. progress: show a bar. insist: ask about balls whose kind proves
        nothing about a solid; the Result then says so in `about`.

        Ctrl-C stops it. Other threads run meanwhile: the library is called without the GIL.
        """
        proof = self.begin(
            start,
            goal,
            side=side,
            start_level=start_level,
            max_level=max_level,
            max_cells=max_cells,
            memory=memory,
            insist=insist,
        )
        with proof:
            if not progress:
                return proof.finish(threads)
            from tqdm.auto import tqdm

            with tqdm(unit=" cells", desc="prove") as bar:
                return proof.finish(threads, _shower(bar))

    def margin(
        self,
        start: PoseLike,
        goal: PoseLike | None = None,
        *,
        rounds: int = 12,
        side: str = "both",
        max_level: int | None = None,
        max_cells: int | None = None,
        memory: int | None = None,
        insist: bool = False,
    ) -> Margin:
        """By how much every radius may shrink before the answer changes: how tight a cage is.

        rounds: bisections; each halves what is left between `closed` and `open` of the Margin.
        Other arguments as in prove. Needs both sides. This is one call into C, which has no
        form in steps: Ctrl-C waits for it, so lower `rounds` or `max_cells` where it takes long.
        """
        if side != "both":
            raise InputError("a margin is found from both sides")
        rounds = whole(rounds, "rounds", 0, 64)
        scene, use, about, note = self._permit(side, insist)
        if note:
            raise KindError(f"a margin is found from both sides; {note}")
        made, first, last = scene._question(start, goal, room=2.0)
        limits = self._limits(use, None, max_level, max_cells)
        size = int(_native.lib.cage_prove_size(ctypes.byref(made.struct), ctypes.byref(limits)))
        most = most_bytes(memory)
        out = _native.MarginStruct()
        state = _native.OUT_OF_MEMORY
        size = min(max(2 * size, 64 << 20), most)
        while True:
            block = np.empty(size, dtype=np.uint8)
            state = _native.lib.cage_margin_find(
                ctypes.byref(made.struct),
                reachable(first),
                None if last is None else reachable(last),
                ctypes.byref(limits),
                rounds,
                ctypes.c_void_p(block.ctypes.data),
                min(size, len(block)),
                ctypes.byref(out),
            )
            if state != _native.OUT_OF_MEMORY or size >= most:
                break
            size = min(4 * size, most)
        if state < 0:
            raise _native.failure(state, "cage_margin_find")
        narrow = None
        if out.known:
            row = np.array([[*out.narrow.x, *out.narrow.q]], dtype=np.int32)
            narrow = from_grid(row, self.dim, made.unit, tuple(out.pivot))[0]
        return Margin(
            out.closed * made.unit if out.bounded else None,
            out.open * made.unit,
            out.proofs,
            narrow,
            made.unit,
            about,
        )

    def collides(
        self, poses: PosesLike, side: str = "inner", *, insist: bool = False
    ) -> NDArray[np.bool_]:
        """Does the object collide, at each pose (rounded to the grid)? Exact, for the inner balls
        of both, or with side='outer' the outer ones. poses: rows x, y, theta; (n, 4, 4); or
        Poses. insist: ask about balls whatever their kind is."""
        if side not in ("inner", "outer"):
            raise InputError("side: 'inner' or 'outer'")
        scene = self._permit(side, insist)[0]
        many = read_poses(poses, self.dim)
        made = scene.grid(grids.far(many.x))
        rows = to_grid(many, made.unit)
        out = np.empty(len(rows), dtype=np.int32)
        _native.lib.cagepy_collides_many(
            ctypes.byref(made.struct), reachable(rows), len(rows), SIDES[side], reachable(out)
        )
        if (out < 0).any():
            index = int(np.argmax(out < 0))
            raise _native.failure(int(out[index]), f"pose {index}")
        return np.asarray(out == 1)

    def atlas(self, level: int | None = None, **options: Any) -> Atlas:
        """The connectivity of the whole scene, to be asked many times: see libcage.atlas.make."""
        from .atlas import make

        return make(self, level, **options)


def _both(one: Solid) -> Solid:
    inner = one.inner if one.inner is not None else one.outer
    outer = one.outer if one.outer is not None else one.inner
    assert inner is not None and outer is not None
    return Solid(inner.as_kind("inner"), outer.as_kind("outer"))


class _TooFine(Exception):
    """The scene does not fit at that unit."""


def _shower(bar: Any) -> Callable[[_native.ResultStruct], None]:
    def show(raw: _native.ResultStruct) -> None:
        bar.set_postfix(slices=raw.slices[0] + raw.slices[1], level=raw.level, refresh=False)
        bar.update(raw.cells - bar.n)

    return show
