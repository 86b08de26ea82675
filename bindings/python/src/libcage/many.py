"""Many questions on any executor, a pool or a cluster: the answers are the same bytes.

A job is a pure function of its question, so it may be run again, or twice: workers that die are no
harm. Answers can be kept in a folder, each under the hash of all that it depends on, and are not
worked out again.
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from typing import Any

from .errors import InputError
from .pool import Checkpoint, ExecutorLike, library_hash, run_jobs
from .poses import PoseLike, pose as read_pose
from .result import Result
from .scene import Scene


@dataclass(frozen=True)
class Question:
    """A scene, a start, perhaps a goal, and options of Scene.prove (side, max_level, max_cells,
    ...)."""

    scene: Scene
    start: PoseLike
    goal: PoseLike | None = None
    options: dict[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        wrong = set(self.options) - {
            "side",
            "start_level",
            "max_level",
            "max_cells",
            "memory",
            "insist",
        }
        if wrong:
            raise InputError(f"no option of a question: {', '.join(sorted(wrong))}")
        object.__setattr__(self, "options", dict(self.options))  # not to be changed from outside

    @property
    def proved(self) -> Scene:
        """The scene that the answer is about: of the balls as they are where one insists."""
        return self.scene._permit(
            self.options.get("side", "both"), self.options.get("insist", False)
        )[0]

    def key(self) -> str:
        """A hash of everything that the answer depends on, the library itself included."""
        scene, use, about, note = self.scene._permit(
            self.options.get("side", "both"), self.options.get("insist", False)
        )
        made, start, goal = scene._question(self.start, self.goal)
        limits = scene._limits(
            use, *(self.options.get(name) for name in ("start_level", "max_level", "max_cells"))
        )
        parts = [
            library_hash(),
            about.encode(),
            note.encode(),
            repr(made.unit).encode(),
            made.bytes(),
            start.astype("<i4").tobytes(),
            b"" if goal is None else goal.astype("<i4").tobytes(),
            bytes(limits),
        ]
        digest = hashlib.sha256()
        for part in parts:
            digest.update(len(part).to_bytes(8, "little") + part)
        return digest.hexdigest()


def answer(question: Question) -> bytes:
    """Result.to_bytes of one question: what a worker runs, on one core."""
    return question.scene.prove(
        question.start, question.goal, threads=1, **question.options
    ).to_bytes()


def prove_many(
    questions: Iterable[Question],
    executor: ExecutorLike | None = None,
    *,
    retries: int = 3,
    checkpoint: str | os.PathLike[str] | None = None,
    progress: bool = False,
) -> list[Result]:
    """Prove all questions; the results in their order, each the same bytes as one process gives.

    executor: any concurrent.futures.Executor (dask: client.get_executor()), or a function that
    makes one, which is called again when a pool breaks (then it is closed here at the end). None:
    here, one after the other. retries: times that one question is asked again after a worker died;
    what the library itself refuses is raised at once, and an answer that its worker does not say to
    be to this question, by this library, is not believed. checkpoint: a folder that answers are
    kept in. Ctrl-C ends it, and the workers that were started here; work that was begun on another
    machine goes on there to its end."""
    todo = list(questions)
    for one in todo:
        if not isinstance(one, Question):
            raise InputError("prove_many takes Questions: Question(scene, start, goal)")
    done: dict[int, bytes] = {}
    store = None if checkpoint is None else Checkpoint(checkpoint)
    keys = [one.key() for one in todo] if store is not None else []
    for index, key in enumerate(keys):
        kept = store.load(key) if store is not None else None
        if kept is not None:
            done[index] = kept
    bar = None
    if progress:
        from tqdm.auto import tqdm

        bar = tqdm(total=len(todo), initial=len(done), desc="prove_many", unit=" proofs")

    def keep(index: int, data: bytes) -> None:
        done[index] = data
        if store is not None:
            store.save(keys[index], data)
        if bar is not None:
            bar.update(1)

    left = [index for index in range(len(todo)) if index not in done]
    try:
        if executor is None:
            for index in left:
                keep(index, answer(todo[index]))
        else:
            run_jobs(answer, todo, left, executor, retries, keep)
    finally:
        if bar is not None:
            bar.close()
    return [_result(done[index], one) for index, one in enumerate(todo)]


def _result(data: bytes, question: Question) -> Result:
    """The result of a question, with its poses as they were asked."""
    dim, goal = question.scene.dim, question.goal
    return replace(
        Result.from_bytes(data, question.proved),
        asked_start=read_pose(question.start, dim),
        asked_goal=None if goal is None else read_pose(goal, dim),
    )
