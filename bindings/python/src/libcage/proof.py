"""A proof as it runs: its block of memory, portions between which Ctrl-C is heard, threads."""

from __future__ import annotations

import ctypes
import os
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import TracebackType
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from . import _native
from .errors import CageError, InputError, OutOfMemoryError
from .frozen import frozen_array, whole
from .grid import Grid
from .poses import Ints, Pose, pose_of
from .result import Path, Result, Statistics, Verdict

if TYPE_CHECKING:
    from .scene import Scene

PORTION = 0.05  # seconds that a call into the library takes at most, if its steps are short
ALONE = 0.03  # seconds before threads are started: most proofs are done by then
FIRST_STEPS = 64
MEMORY = 4 << 30  # bytes that a block may grow to


def reachable(values: Ints) -> ctypes.c_void_p:
    """The address of a C-contiguous int32 array."""
    return ctypes.c_void_p(values.ctypes.data)


def most_bytes(memory: int | None) -> int:
    """The bytes that a block may grow to, from the argument `memory`."""
    return MEMORY if memory is None else whole(memory, "memory, in bytes", 1, 1 << 62)


class Stopped(Exception):
    """Work was given up because those who asked for it did not want it any more."""


_stop = threading.local()


@contextmanager
def stoppable(path: str) -> Iterator[None]:
    """Proofs and surveys of this thread end with Stopped when a file of that name appears."""
    _stop.path = path
    try:
        yield
    finally:
        _stop.path = ""


def check_stop() -> None:
    """Raise Stopped where nobody waits for the work of this thread."""
    path = getattr(_stop, "path", "")
    if path and os.path.exists(path):
        raise Stopped


_spare: list[NDArray[np.uint8]] = []  # one block of a proof that was closed: its pages are there
SPARE = 64 << 20


def take_block(size: int) -> NDArray[np.uint8]:
    """A block of at least so many bytes. How many it has is its length: a larger one may come."""
    if size < 0:
        raise InputError(f"a block of {size} bytes")
    try:
        block = _spare.pop()
    except IndexError:
        return np.empty(size, dtype=np.uint8)
    return block if len(block) >= size else np.empty(size, dtype=np.uint8)


def give_block(block: NDArray[np.uint8]) -> None:
    """Keep it for the next proof; nobody may read it any more."""
    if not _spare and 0 < len(block) <= SPARE:
        _spare.append(block)


class Crew:
    """Threads for one proof or survey, started when it turns out to be long."""

    def __init__(self, threads: int | None, pairs: int) -> None:
        # 0: not yet asked how many there are
        self.count = 0 if threads is None else whole(threads, "threads", 1, 64)
        self.pairs = pairs
        self.handle: int | None = None
        self.workers = _native.Workers()

    def ask(self) -> Any:
        """The workers to pass to C; starts them. None: the proof runs alone."""
        if self.count == 0:
            self.count = int(_native.lib.cagepy_threads_cores())
        if self.handle is None and self.count > 1:
            self.handle = _native.lib.cagepy_threads_start(
                self.count, self.pairs, ctypes.byref(self.workers)
            )
            if self.handle is None:
                self.count = 1
        return ctypes.byref(self.workers) if self.handle is not None else None

    def stop(self) -> None:
        """End the threads. May be called again."""
        if self.handle is not None:
            _native.lib.cagepy_threads_stop(self.handle)
            self.handle = None


def run_all(step: Callable[[int, Any], int], crew: Crew, show: Callable[[], None] | None) -> int:
    """Call step(count, workers) until it is done, in portions; its last answer.

    Between two calls Python handles signals, so Ctrl-C raises KeyboardInterrupt here.
    """
    steps, begun = FIRST_STEPS, time.perf_counter()
    try:
        while True:
            check_stop()
            before = time.perf_counter()
            together = crew.ask() if before - begun > ALONE else None
            state = step(max(steps, 1024) if together is not None else steps, together)
            if state != 0:
                return state
            took = time.perf_counter() - before
            steps = steps * 2 if took < PORTION / 2 else max(FIRST_STEPS, steps // 2)
            if show is not None:
                show()
    finally:
        crew.stop()


class Proof:
    """A question being answered, step by step. Made by Scene.begin; Scene.prove does it all.

    It holds everything that the C library reads: the scene's arrays and the block of memory.
    """

    def __init__(
        self,
        grid: Grid,
        start: Ints,
        goal: Ints | None,
        limits: _native.Limits,
        about: str,
        note: str,
        memory: int | None = None,
        scene: Scene | None = None,
        asked: tuple[Pose | None, Pose | None] = (None, None),
    ) -> None:
        self.scene = scene
        self.grid, self.start, self.goal, self.limits = grid, start, goal, limits
        self.about, self.note, self.asked = about, note, asked
        self.most = most_bytes(memory)
        self.seconds = 0.0
        self._lock = threading.Lock()
        self._handle = ctypes.c_void_p()
        size = 4 * _native.lib.cage_prove_size(ctypes.byref(grid.struct), ctypes.byref(limits))
        self._begin(min(size, self.most) if size else 0)

    def _begin(self, size: int) -> None:
        # The handle points into the old block: it goes first, wherever a Ctrl-C comes between.
        self._handle = ctypes.c_void_p()
        self._block = take_block(size)
        self._size = min(size, len(self._block))
        self._state = 0
        _native.lib.cage_prove_begin(
            ctypes.byref(self._handle),
            ctypes.byref(self.grid.struct),
            reachable(self.start),
            None if self.goal is None else reachable(self.goal),
            ctypes.byref(self.limits),
            ctypes.c_void_p(self._block.ctypes.data),
            self._size,
        )

    def _raw(self) -> _native.ResultStruct:
        if not self._handle:
            raise InputError("the proof was closed")
        raw: _native.ResultStruct = _native.lib.cage_prove_result(self._handle).contents
        return raw

    def run(self, steps: int) -> bool:
        """Do at most so many steps; True when it is finished. Portions do not change the answer.

        Where the block of memory is too small it begins again in a larger one.
        """
        steps = whole(steps, "steps", 0, 1 << 62)
        with self._lock:
            return self._advance(lambda: self._step(steps, None)) == 1

    def _step(self, steps: int, workers: Any) -> int:
        if not self._handle:
            raise InputError("the proof was closed")
        state: int = _native.lib.cage_prove_run_with(self._handle, steps, workers)
        return state

    def _advance(self, work: Callable[[], int]) -> int:
        begun = time.perf_counter()
        try:
            while self._state != 1:
                self._state = work()
                if self._state >= 0:
                    break
                if self._state != _native.OUT_OF_MEMORY:
                    raise _native.failure(self._state, "cage_prove_run")
                self._grow()
        finally:
            self.seconds += time.perf_counter() - begun
        return self._state

    def _grow(self) -> None:
        needed = int(self._raw().needed_bytes)
        size = max(needed, 2 * self._size)
        if size > self.most:
            size = self.most
        if size <= self._size or needed > self.most:
            raise OutOfMemoryError(
                f"the proof needs a block of {needed} bytes, and {self.most} are allowed: pass "
                "memory=..., or a smaller max_cells",
                needed=needed,
            )
        self._begin(size)

    def finish(
        self, threads: int | None = None, show: Callable[[_native.ResultStruct], None] | None = None
    ) -> Result:
        """Run to the end, after a while on so many threads (None: all cores), and answer."""
        with self._lock:
            crew = Crew(threads, self.grid.pairs)
            shown = None if show is None else lambda: show(self._raw())
            self._advance(lambda: run_all(self._step, crew, shown))
        return self.result()

    def result(self) -> Result:
        """The answer; UNDEFINED until the proof is finished. Holds no memory of the proof."""
        with self._lock:
            return self._result()

    def _result(self) -> Result:
        raw, grid = self._raw(), self.grid
        verdict = Verdict(raw.verdict)
        path = None
        if verdict.joined:
            count = int(raw.path_count)
            address = ctypes.cast(raw.path, ctypes.POINTER(ctypes.c_int32))
            rows = frozen_array(np.ctypeslib.as_array(address, (count, 7)))
            path = Path(
                rows,
                (raw.pivot[0], raw.pivot[1], raw.pivot[2]),
                grid.unit,
                grid.dim,
                tuple(self.start.tolist()),
                None if self.goal is None else tuple(self.goal.tolist()),
                scene=self.scene,
            )
            if not self._certified(raw):
                raise CageError(
                    "the path found does not pass the independent check. This is a bug; "
                    "please report the scene"
                )
        side = self.limits.side
        if (verdict.separated and not side & _native.INNER) or (
            verdict.joined and not side & _native.OUTER
        ):
            raise CageError(
                f"{verdict} from a side that was not asked. This is a bug; please report it"
            )
        statistics = Statistics(
            raw.level,
            raw.cells,
            tuple(raw.slices),
            tuple(raw.gluings),
            tuple(raw.mixtures),
            tuple(raw.reached),
            tuple(raw.balls),
            tuple(raw.inserted),
            raw.steps,
            raw.peak_bytes,
            self.seconds,
        )
        dim, start = grid.dim, tuple(self.start.tolist())
        goal = None if self.goal is None else tuple(self.goal.tolist())
        return Result(
            verdict,
            _native.text(_native.lib.cage_reason_text, raw.reason),
            pose_of(start, dim, grid.unit),
            None if goal is None else pose_of(goal, dim, grid.unit),
            start,
            goal,
            grid.unit,
            dim,
            tuple(value * grid.unit for value in raw.pivot[:dim]),
            path,
            statistics,
            self.about,
            self.note,
            *self.asked,
        )

    def _certified(self, raw: _native.ResultStruct) -> bool:
        answer: int = _native.lib.cage_path_check(
            ctypes.byref(self.grid.struct),
            reachable(self.start),
            None if self.goal is None else reachable(self.goal),
            ctypes.byref(raw.pivot),
            raw.path,
            raw.path_count,
        )
        return answer == 1

    def region(
        self, origin: tuple[float, ...], pitch: float, shape: tuple[int, ...]
    ) -> NDArray[np.bool_]:
        """Where the pivot can be, for some rotation, as far as the inner side knows.

        True at [i, j (, k)] where the point origin + pitch (i, j, k), metres, lies in the reached
        part of the inner slices. origin and pitch are rounded to the grid. For pictures."""
        dim, unit = self.grid.dim, self.grid.unit
        if len(origin) != dim or len(shape) != dim:
            raise InputError(f"origin and shape have {dim} entries each")
        first, reach = np.zeros(3, dtype=np.int32), _native.REACH[dim]
        place = np.rint(np.asarray(origin, dtype=np.float64) / unit)
        if not (abs(place) <= reach).all() or not 0 < pitch <= reach * unit:
            raise InputError(
                f"origin and pitch lie within the grid, {reach * unit:.6g} metres, and pitch is "
                "positive"
            )
        first[:dim] = place
        count = np.ones(3, dtype=np.int32)
        count[:dim] = [whole(number, "an entry of shape", 1, 1 << 20) for number in shape]
        mask = np.zeros(int(np.prod(count)), dtype=np.uint8)
        with self._lock:
            self._raw()
            _native.lib.cage_prove_region(
                self._handle,
                reachable(first),
                max(1, round(pitch / unit)),
                reachable(count),
                ctypes.c_void_p(mask.ctypes.data),
            )
        return mask.reshape(count[::-1]).T[(slice(None),) * dim + (0,) * (3 - dim)].astype(bool)

    def close(self) -> None:
        """Give the memory back; the proof cannot be asked any more."""
        with self._lock:
            self._handle = ctypes.c_void_p()
            block, self._block = self._block, np.empty(0, dtype=np.uint8)
            give_block(block)

    def __enter__(self) -> Proof:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()
