"""Jobs on any executor, a pool or a cluster: run again when a worker dies, kept in a folder."""

from __future__ import annotations

import hashlib
import json
import os
import tempfile
from collections.abc import Callable, Sequence
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, wait
from functools import cache
from pathlib import Path
from typing import Any, TypeVar, Union

from . import _native
from .errors import CageError

ExecutorLike = Union[Executor, Callable[[], Executor]]
Job = TypeVar("Job")


@cache
def library_hash() -> bytes:
    """Of the library that does the work."""
    return hashlib.sha256(_native.library_path().read_bytes()).digest()


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

    def submit(self, work: Callable[[Any], bytes], job: Any) -> Future[bytes]:
        try:
            return self.executor.submit(work, job)
        except (BrokenExecutor, RuntimeError) as error:
            if self.make is None:
                raise RuntimeError(
                    "the executor is broken and cannot be had again; pass what makes one, "
                    "executor=lambda: ProcessPoolExecutor(...), not the executor"
                ) from error
            self.executor.shutdown(wait=False, cancel_futures=True)
            self.executor = self.make()
            return self.executor.submit(work, job)

    def close(self) -> None:
        if self.make is not None:
            self.executor.shutdown(wait=True, cancel_futures=True)


def run_jobs(
    work: Callable[[Job], bytes],
    jobs: Sequence[Job],
    left: Sequence[int],
    executor: ExecutorLike,
    retries: int,
    keep: Callable[[int, bytes], None],
) -> None:
    """Do the jobs of those numbers in any order, each again up to so often when its worker dies."""
    if not left:
        return
    pool = _Pool(executor)
    tries = dict.fromkeys(left, 0)
    running: dict[Future[bytes], int] = {}
    try:
        for index in left:
            running[pool.submit(work, jobs[index])] = index
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
                    running[pool.submit(work, jobs[index])] = index
                else:
                    keep(index, data)
    finally:
        for future in running:
            future.cancel()
        pool.close()
