"""Ctrl-C ends many proofs on an executor soon, and leaves no worker behind."""

import os
import signal
import subprocess
import sys
import tempfile
import time
from concurrent.futures import Executor, Future, ThreadPoolExecutor

import numpy as np
import pytest

from libcage import InputError, OutOfMemoryError, Question, Scene, planner, pool, prove_many
from libcage.proof import Proof, Stopped, check_stop, stoppable

FINGERS = np.array([[0.07, 0, 0.02], [0, 0.07, 0.02], [-0.07, 0, 0.02], [0, -0.07, 0.02]])

LONG = """
import concurrent.futures, sys, time
import numpy as np
import libcage

def ring(axes):
    t = np.arange(16) * 2 * np.pi / 16
    rows = np.zeros((16, 4))
    rows[:, axes[0]], rows[:, axes[1]], rows[:, 3] = np.cos(t), np.sin(t), 0.21
    return rows

if __name__ == "__main__":
    scene = libcage.Scene(ring((0, 1)), ring((0, 2)) + [1, 0, 0, 0])
    ask = libcage.Question(scene, np.eye(4))
    make = lambda: concurrent.futures.KIND(2)
    print("go", flush=True)
    try:
        WORK
        print("finished", flush=True)
    except KeyboardInterrupt:
        print("stopped", flush=True)
"""
MANY = "libcage.prove_many([ask] * 4, make)"
GIVEN = "\n        with make() as pool: libcage.prove_many([ask] * 4, pool)"
ATLAS = "scene.atlas(3, executor=make, parts=8)"


def members(group):
    """The processes of a group that are no zombies."""
    listed = subprocess.run(["ps", "-eo", "pgid,stat"], capture_output=True, text=True).stdout
    rows = [line.split() for line in listed.splitlines()[1:]]
    return [row for row in rows if int(row[0]) == group and not row[1].startswith("Z")]


@pytest.mark.parametrize(
    "kind,work,how",
    [
        ("ProcessPoolExecutor", MANY, "parent"),
        ("ProcessPoolExecutor", MANY, "group"),
        ("ProcessPoolExecutor", MANY, "twice"),
        ("ProcessPoolExecutor", GIVEN, "parent"),
        ("ProcessPoolExecutor", ATLAS, "parent"),
        ("ThreadPoolExecutor", MANY, "parent"),
        ("ThreadPoolExecutor", GIVEN, "parent"),
        ("ThreadPoolExecutor", ATLAS, "parent"),
    ],
)
def test_ctrl_c_ends_work_on_an_executor(tmp_path, kind, work, how):
    program = tmp_path / "long.py"
    program.write_text(LONG.replace("KIND", kind).replace("WORK", work))
    process = subprocess.Popen(
        [sys.executable, str(program)],
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
        start_new_session=True,
        env={**os.environ, "TMPDIR": str(tmp_path)},
    )
    try:
        assert process.stdout.readline() == "go\n"
        time.sleep(1.5)
        begun = time.monotonic()
        (os.killpg if how == "group" else os.kill)(process.pid, signal.SIGINT)
        if how == "twice":
            time.sleep(0.2)
            os.kill(process.pid, signal.SIGINT)
        said = process.communicate(timeout=20)[0]
        taken = time.monotonic() - begun
        if how != "twice":  # the second may come after the answer to the first
            assert said == "stopped\n"
        assert taken < 4  # one or two seconds where nothing else runs
        while members(process.pid) and time.monotonic() - begun < 6:
            time.sleep(0.1)
        assert not members(process.pid)
        assert not list(tmp_path.glob("libcage-*"))
    finally:
        try:
            os.killpg(process.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
        process.communicate()


def test_workers_that_nobody_waits_for_stop(tmp_path):
    scene, stop = Scene([[0, 0, 0.04]], FINGERS), tmp_path / "stop"
    with stoppable(str(stop)):
        check_stop()
        scene.prove((0, 0, 0))
        stop.touch()
        for work in (lambda: scene.prove((0, 0, 0)), lambda: scene.atlas(3)):
            with pytest.raises(Stopped):
                work()
    scene.prove((0, 0, 0))  # outside nobody listens


def test_nothing_is_left_when_all_goes_well(tmp_path, monkeypatch):
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    ask = Question(Scene([[0, 0, 0.04]], FINGERS), (0, 0, 0))
    with ThreadPoolExecutor(2) as workers:
        assert len(prove_many([ask] * 3, workers)) == 3
    assert not list(tmp_path.iterdir())


# ---- answers that are none -----------------------------------------------------------------------


class Wrong(Executor):
    """Does the work, and gives back something else."""

    def __init__(self, change):
        self.change, self.count = change, 0

    def submit(self, function, /, *arguments):
        self.count += 1
        future = Future()
        future.set_result(self.change(function(*arguments), self.count))
        return future


def different(count=4):
    return [
        Question(Scene([[0, 0, 0.01 * (k + 1)]], FINGERS[: 4 - k]), (0, 0, 0))
        for k in range(count)
    ]


def test_an_answer_to_another_question_is_not_believed(tmp_path):
    questions = different()
    wanted = [one.to_bytes() for one in prove_many(questions)]
    first = []
    wrong = Wrong(lambda got, _: first.append(got) or first[0])
    with pytest.raises(RuntimeError, match="no answer to this question"):
        prove_many(questions, wrong, checkpoint=tmp_path)
    assert len(list(tmp_path.glob("*.json"))) == 1  # the answer to the first, which is right
    assert [one.to_bytes() for one in prove_many(questions, checkpoint=tmp_path)] == wanted


@pytest.mark.parametrize(
    "change",
    [
        lambda got: None,
        lambda got: got[1],
        lambda got: (got[0], got[1].decode("latin-1")),
        lambda got: (got[0], memoryview(got[1])),
        lambda got: ("0" * 64, got[1]),
        lambda got: (*got, 1),
    ],
)
def test_what_is_no_answer_is_asked_for_again_and_then_refused(change):
    questions = different()
    wanted = [one.to_bytes() for one in prove_many(questions)]
    with pytest.raises(RuntimeError, match="no answer to this question"):
        prove_many(questions, Wrong(lambda got, _: change(got)))
    sometimes = Wrong(lambda got, count: change(got) if count % 2 else got)
    assert [one.to_bytes() for one in prove_many(questions, sometimes)] == wanted
    scene = questions[0].scene
    with pytest.raises(RuntimeError, match="no answer to this question"):
        scene.atlas(3, executor=Wrong(lambda got, _: change(got)), parts=3)


def test_an_answer_of_another_library_is_not_believed(monkeypatch):
    """The worker says which library it has: here it has another from the second call on."""
    calls, real = [], pool.library_hash
    question = different(1)[0]

    def other():
        calls.append(1)
        return real() if len(calls) == 1 else b"another library"

    monkeypatch.setattr("libcage.many.library_hash", other)
    with pytest.raises(RuntimeError, match="another version of libcage"):
        prove_many([question], Wrong(lambda got, _: got), retries=0)


def test_options_of_a_question_are_its_own():
    options = {"max_cells": 9}
    question = Question(Scene([[0, 0, 0.04]], FINGERS), (0, 0, 0), options=options)
    key = question.key()
    options["max_cells"] = 10
    assert question.key() == key and question.options == {"max_cells": 9}
    with pytest.raises(InputError):
        prove_many([question], ThreadPoolExecutor(1), retries=1.5)


def test_a_planner_s_answer_is_not_lost_with_the_proof(monkeypatch):
    def fails(*_):
        raise OutOfMemoryError("the proof needs a larger block")

    monkeypatch.setattr(Proof, "run", fails)
    scene = Scene([[0, 0, 0.04]], FINGERS)
    out = planner.race(lambda _: time.sleep(0.2) or "a path", scene, (0, 0, 0))
    assert out.status == "a path" and out.proof is None and isinstance(out.error, MemoryError)
    with pytest.raises(MemoryError):
        planner.race(lambda _: time.sleep(0.2), scene, (0, 0, 0))
