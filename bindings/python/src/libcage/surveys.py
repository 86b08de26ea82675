"""Surveys: an atlas in the making, here, or its slices in parts on any executor."""

from __future__ import annotations

import base64
import ctypes
import hashlib
import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from . import _native
from .errors import AtlasError, OutOfMemoryError
from .frozen import whole
from .grid import Grid
from .pool import Checkpoint, ExecutorLike, library_hash, run_jobs
from .poses import Ints
from .proof import Crew, run_all


@dataclass(frozen=True)
class Part:
    """One part of a survey, a pure function of what is here: it may be worked out twice."""

    unit: float
    dim: int
    arrays: tuple[Ints, Ints, Ints, Ints]
    plan: tuple[int, int, int]
    part: int
    parts: int
    memory: int

    def key(self) -> str:
        """A hash of everything that its facts depend on, the library itself included."""
        digest = hashlib.sha256(library_hash())
        digest.update(repr((self.dim, self.plan, self.part, self.parts)).encode())
        for array in self.arrays:
            digest.update(repr(array.shape).encode() + array.astype("<i4").tobytes())
        return digest.hexdigest()


def part_facts(job: Part) -> bytes:
    """The facts of one part: what a worker runs, on one core."""
    made = Grid(job.unit, job.dim, job.arrays)
    plan = _native.Plan()
    plan.side, plan.level, plan.max_cells = job.plan
    size = int(_native.lib.cage_survey_size(ctypes.byref(made.struct), ctypes.byref(plan)))
    size = min(size, job.memory)
    return _grown(made, plan, size, job.memory, Crew(1, 1), [], None, (job.part, job.parts))


def parts(
    made: Grid,
    plan: _native.Plan,
    most: int,
    executor: ExecutorLike,
    count: int,
    retries: int,
    checkpoint: str | os.PathLike[str] | None,
) -> list[bytes]:
    """The facts of all parts, made on the executor or found in the folder."""
    count = whole(count, "parts", 1, 1 << 20)
    told = (int(plan.side), int(plan.level), int(plan.max_cells))
    jobs = [Part(made.unit, made.dim, made.arrays, told, k, count, most) for k in range(count)]
    store = None if checkpoint is None else Checkpoint(checkpoint)
    done: dict[int, bytes] = {}
    for index, job in enumerate(jobs):
        kept = store.load(job.key()) if store is not None else None
        if kept is not None:
            done[index] = base64.b64decode(kept)

    def keep(index: int, facts: bytes) -> None:
        done[index] = facts
        if store is not None:
            store.save(jobs[index].key(), base64.b64encode(facts))

    run_jobs(
        part_facts,
        jobs,
        [index for index in range(count) if index not in done],
        executor,
        retries,
        keep,
    )
    return [done[index] for index in range(count)]


def atlas(
    made: Grid,
    plan: _native.Plan,
    size: int,
    most: int,
    crew: Crew,
    facts: Sequence[bytes],
    bar: Any,
) -> bytes:
    """The atlas: what the facts do not tell is worked out here."""
    return _grown(made, plan, size, most, crew, facts, bar, None)


def _grown(
    made: Grid,
    plan: _native.Plan,
    size: int,
    most: int,
    crew: Crew,
    facts: Sequence[bytes],
    bar: Any,
    part: tuple[int, int] | None,
) -> bytes:
    """Run a survey in a block that grows; its atlas, or the facts of its part."""
    lib = _native.lib
    while True:
        block = np.empty(size, dtype=np.uint8)
        handle = ctypes.c_void_p()
        lib.cage_survey_begin(
            ctypes.byref(handle),
            ctypes.byref(made.struct),
            ctypes.byref(plan),
            ctypes.c_void_p(block.ctypes.data),
            min(size, len(block)),
        )
        state = 0
        for known in facts:
            if state == 0:
                state = lib.cage_survey_learn(handle, known, len(known))
        if state == 0 and part is not None:
            lib.cage_survey_part(handle, *part)
        if state == 0:
            state = _run(handle, plan, crew, bar)
        if state == 1:
            write = lib.cage_survey_atlas if part is None else lib.cage_survey_facts
            return _written(write, handle)
        if state != _native.OUT_OF_MEMORY:
            raise _native.failure(state, "cage_survey_run")
        needed = int(lib.cage_survey_result_of(handle).contents.needed_bytes)
        if needed > most or size >= most:
            raise OutOfMemoryError(
                f"the atlas needs a block of {needed} bytes or more, and {most} are "
                "allowed: pass memory=..., or a lower level",
                needed=needed,
            )
        size = min(max(needed, 2 * size), most)


def _run(handle: ctypes.c_void_p, plan: _native.Plan, crew: Crew, bar: Any) -> int:
    lib, sides = _native.lib, bin(plan.side).count("1")

    def step(count: int, workers: Any) -> int:
        state: int = lib.cage_survey_run_with(handle, count, workers)
        return state

    def show() -> None:
        work = lib.cage_survey_result_of(handle).contents
        bar.total = max(work.leaves * sides, 1)
        bar.n = work.slices[0] + work.slices[1]
        bar.refresh()

    shown: Callable[[], None] | None = None if bar is None else show
    return run_all(step, crew, shown)


def _written(write: Any, handle: ctypes.c_void_p) -> bytes:
    out = np.empty(int(write(handle, None, 0)), dtype=np.uint8)
    if write(handle, ctypes.c_void_p(out.ctypes.data), len(out)) != len(out):
        raise AtlasError("the atlas could not be written. This is a bug; please report it")
    return out.tobytes()
