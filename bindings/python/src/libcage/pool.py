"""Jobs on any executor, a pool or a cluster: run again when a worker dies, kept in a folder.

A worker says with its answer which question it answers, and with which library: another question's
answer is not believed. When the caller stops waiting (Ctrl-C, an error) a file appears that workers
on the same machine look for between portions of their work."""

from __future__ import annotations

import atexit
import hashlib
import json
import os
import tempfile
import time
import uuid
from collections.abc import Callable, Sequence
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, wait
from functools import cache
from pathlib import Path
from typing import Any, Protocol, TypeVar, Union

from . import _native
from .errors import CageError, InputError
from .frozen import whole
from .proof import stoppable

ExecutorLike = Union[Executor, Callable[[], Executor]]
PATIENCE = 1.0  # seconds that workers have to notice that nobody waits for them


class Keyed(Protocol):
    """A job that can say, as a hash, all that its answer depends on."""

    def key(self) -> str:
        """The hash."""
        ...


Job = TypeVar("Job", bound=Keyed)
Answer = tuple[str, bytes]  # the key of the job as its worker saw it, with that worker's library


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


def errand(work: Callable[[Job], bytes], job: Job, stop: str) -> Answer:
    """What a worker runs."""
    with stoppable(stop):
        return job.key(), work(job)


def _remove(path: str) -> None:
    try:
        os.unlink(path)
    except OSError:
        pass


class _Pool:
    """An executor, or what makes one when the last is broken."""

    def __init__(self, given: ExecutorLike) -> None:
        self.make = None if isinstance(given, Executor) else given
        if self.make is not None and not callable(self.make):
            raise InputError("executor: a concurrent.futures.Executor, or what makes one")
        self.stop_file = os.path.join(tempfile.gettempdir(), f"libcage-{uuid.uuid4().hex}.stop")
        self.executor = given if isinstance(given, Executor) else self._made()

    def _made(self) -> Executor:
        assert self.make is not None
        made = self.make()
        if not isinstance(made, Executor):
            raise InputError(f"the executor made is a {type(made).__name__}, which is none")
        return made

    def submit(self, work: Callable[[Job], bytes], job: Job) -> Future[Answer]:
        try:
            return self.executor.submit(errand, work, job, self.stop_file)
        except (BrokenExecutor, RuntimeError) as error:
            if self.make is None:
                raise RuntimeError(
                    "the executor is broken and cannot be had again; pass what makes one, "
                    "executor=lambda: ProcessPoolExecutor(...), not the executor"
                ) from error
            self.executor.shutdown(wait=False, cancel_futures=True)
            self.executor = self._made()
            return self.executor.submit(errand, work, job, self.stop_file)

    def close(self) -> None:
        """The work is done: end the workers if they were started here."""
        if self.make is not None:
            self.executor.shutdown(wait=True, cancel_futures=True)

    def stop(self, running: Sequence[Future[Answer]]) -> None:
        """The work is not wanted any more: give all of it up, without waiting for its end."""
        with open(self.stop_file, "xb"):
            atexit.register(_remove, self.stop_file)
        # Of a process pool: workers that do not listen, in a long step, are ended.
        workers = list((getattr(self.executor, "_processes", None) or {}).values())
        for future in running:
            future.cancel()
        end = time.monotonic() + PATIENCE
        if self.make is not None:
            self.executor.shutdown(wait=False, cancel_futures=True)
            for worker in workers:
                worker.join(max(0.0, end - time.monotonic()))
                if worker.is_alive():
                    worker.kill()
                    worker.join(PATIENCE)
        wait(running, timeout=max(0.0, end - time.monotonic()))


def run_jobs(
    work: Callable[[Job], bytes],
    jobs: Sequence[Job],
    left: Sequence[int],
    executor: ExecutorLike,
    retries: int,
    keep: Callable[[int, bytes], None],
) -> None:
    """Do the jobs of those numbers in any order, each again up to so often when its worker dies."""
    retries = whole(retries, "retries", 0, 1 << 20)
    if not left:
        return
    keys = {index: jobs[index].key() for index in left}
    pool = _Pool(executor)
    tries = dict.fromkeys(left, 0)
    running: dict[Future[Answer], int] = {}
    try:
        for index in left:
            running[pool.submit(work, jobs[index])] = index
        while running:
            for future in wait(running, return_when=FIRST_COMPLETED).done:
                index = running.pop(future)
                try:
                    data = _believed(future.result(), keys[index])
                except CageError:
                    raise  # the same everywhere: no other worker would help
                except Exception:
                    tries[index] += 1
                    if tries[index] > retries:
                        raise
                    running[pool.submit(work, jobs[index])] = index
                else:
                    keep(index, data)
    except BaseException:
        pool.stop(list(running))
        raise
    pool.close()


def _believed(got: Any, key: str) -> bytes:
    """The answer, if it is one to the question that was asked."""
    if (
        not isinstance(got, tuple)
        or list(map(type, got)) != [str, bytes]
        or got[0] != key
    ):
        raise RuntimeError(
            "the executor gave what is no answer to this question, or its worker has another "
            "version of libcage: install the same on all of them"
        )
    data: bytes = got[1]
    return data
