"""Many questions on any executor, a pool or a cluster: the answers are the same bytes.

A job is a pure function of its question, so it may be run again, or twice: workers that die are no
harm. Answers can be kept in a folder, each under the hash of all that it depends on, and are not
worked out again.
"""

from __future__ import annotations

import hashlib
import json
import os
import tempfile
from collections.abc import Callable, Iterable
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, wait
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any, Union

from . import _native
from .errors import CageError, InputError
from .poses import PoseLike
from .result import Result
from .scene import Scene

ExecutorLike = Union[Executor, Callable[[], Executor]]


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
            _library(),
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


@cache
def _library() -> bytes:
    return hashlib.sha256(_native.library_path().read_bytes()).digest()


def answer(question: Question) -> bytes:
    """Result.to_bytes of one question: what a worker runs, on one core."""
    return question.scene.prove(
        question.start, question.goal, threads=1, **question.options
    ).to_bytes()


class Checkpoint:
    """A folder of answers, one file each, written beside and moved into place."""

    def __init__(self, folder: str | os.PathLike[str]) -> None:
        self.folder = Path(folder)
        self.folder.mkdir(parents=True, exist_ok=True)

    def load(self, key: str) -> bytes | None:
        """The answer kept under that key, or None: not there, cut off, or changed."""
        try:
            raw = json.loads((self.folder / f"{key}.json").read_text(encoding="ascii"))
            data = raw["answer"].encode()
            if (
                raw["key"] == key
                and raw["sha256"] == hashlib.sha256(key.encode() + data).hexdigest()
            ):
                return bytes(data)
        except (OSError, ValueError, KeyError, TypeError, AttributeError):
            pass
        return None

    def save(self, key: str, data: bytes) -> None:
        """Keep an answer."""
        raw = {
            "key": key,
            "sha256": hashlib.sha256(key.encode() + data).hexdigest(),
            "answer": data.decode(),
        }
        with tempfile.NamedTemporaryFile(
            "w", dir=self.folder, suffix=".part", delete=False
        ) as file:
            json.dump(raw, file)
        os.replace(file.name, self.folder / f"{key}.json")


class _Pool:
    """An executor, or what makes one when the last is broken."""

    def __init__(self, given: ExecutorLike) -> None:
        self.make = None if isinstance(given, Executor) else given
        self.executor = given if isinstance(given, Executor) else given()

    def submit(self, question: Question) -> Future[bytes]:
        try:
            return self.executor.submit(answer, question)
        except (BrokenExecutor, RuntimeError) as error:
            if self.make is None:
                raise RuntimeError(
                    "the executor is broken and cannot be had again; pass what makes one, "
                    "executor=lambda: ProcessPoolExecutor(...), not the executor"
                ) from error
            self.executor.shutdown(wait=False, cancel_futures=True)
            self.executor = self.make()
            return self.executor.submit(answer, question)

    def close(self) -> None:
        if self.make is not None:
            self.executor.shutdown(wait=True, cancel_futures=True)


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
    what the library itself refuses is raised at once. checkpoint: a folder that answers are kept
    in."""
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
        elif left:
            _run(todo, left, _Pool(executor), retries, keep)
    finally:
        if bar is not None:
            bar.close()
    return [Result.from_bytes(done[index]) for index in range(len(todo))]


def _run(
    todo: list[Question],
    left: list[int],
    pool: _Pool,
    retries: int,
    keep: Callable[[int, bytes], None],
) -> None:
    tries = dict.fromkeys(left, 0)
    running: dict[Future[bytes], int] = {}
    try:
        for index in left:
            running[pool.submit(todo[index])] = index
        while running:
            for future in wait(running, return_when=FIRST_COMPLETED).done:
                index = running.pop(future)
                try:
                    data = future.result()
                except CageError:
                    raise  # the same everywhere: no other worker would help
                except Exception:
                    tries[index] += 1
                    if tries[index] > retries:
                        raise
                    running[pool.submit(todo[index])] = index
                else:
                    keep(index, data)
    finally:
        for future in running:
            future.cancel()
        pool.close()
