"""Numbers that cannot be used are refused, before C or NumPy meet them."""

import subprocess
import sys

import numpy as np
import pytest
import trimesh
from shapely.geometry import box

import libcage.proof
from libcage import (
    InputError,
    OutOfMemoryError,
    PoseError,
    Question,
    Scene,
    SolidError,
    Verdict,
    fit,
    prove_many,
    verify_balls,
    verify_cover,
)

DISC = [[0.0, 0.0, 0.04]]
FINGERS = np.array([[0.07, 0, 0.02], [0, 0.07, 0.02], [-0.07, 0, 0.02], [0, -0.07, 0.02]])
NAN = float("nan")

MEMORY = """
import libcage
from libcage import Scene
scene = Scene([[0, 0, 0.03], [0.02, 0, 0.01]],
              [[0.07, 0, 0.02], [0, 0.07, 0.02], [-0.07, 0, 0.02], [0, -0.07, 0.02]])
scene.prove((0, 0, 0))  # leaves a block to the next one
for ask in (scene.prove, scene.margin, lambda pose, memory: scene.atlas(3, memory=memory)):
    for memory in (-1, -(1 << 63), 0, 1.5, float("nan"), float("inf"), "1", 1 << 70):
        try:
            ask((0, 0, 0), memory=memory)
            print("not refused", memory)
        except libcage.InputError:
            pass
    for memory in (1, 100, 4096):
        try:
            ask((0, 0, 0), memory=memory)
        except libcage.OutOfMemoryError:
            pass
print("done")
"""


def test_memory_that_is_none_is_refused_after_a_proof_too():
    """In a process of its own: -1 once was a block without end."""
    done = subprocess.run(
        [sys.executable, "-c", MEMORY], capture_output=True, text=True, timeout=60
    )
    assert (done.returncode, done.stdout) == (0, "done\n"), done.stderr[-500:]


def test_c_is_never_told_of_more_bytes_than_there_are(monkeypatch):
    told, real = [], libcage.proof._native.lib.cage_prove_begin
    half = lambda size: np.empty(size // 2, dtype=np.uint8)  # noqa: E731
    monkeypatch.setattr(libcage.proof, "take_block", half)

    class Library:
        def __getattr__(self, name):
            return getattr(real_library, name)

        def cage_prove_begin(self, *arguments):
            told.append(arguments[-1])
            return real(*arguments)

    real_library = libcage.proof._native.lib
    monkeypatch.setattr(libcage.proof._native, "lib", Library())
    proof = Scene(DISC, FINGERS).begin((0, 0, 0))
    assert told[-1] == len(proof._block)


def test_a_ctrl_c_anywhere_while_a_block_is_taken_leaves_no_handle_without_its_block():
    """The handle points into the block: it must never outlive it."""
    code, lines = libcage.proof.Proof._begin.__code__, range(30)
    seen = 0
    for stop_at in lines:
        proof = Scene(DISC, FINGERS).begin((0, 0, 0))
        count = [0]

        def trace(frame, event, _argument):
            if frame.f_code is not code:
                return None
            if event == "line":
                if count[0] == stop_at:
                    raise KeyboardInterrupt
                count[0] += 1
            return trace

        before = sys.gettrace()
        sys.settrace(trace)
        try:
            proof._begin(proof._size * 2)
        except KeyboardInterrupt:
            seen += 1
        finally:
            sys.settrace(before)
        base = proof._block.ctypes.data
        at = proof._handle.value
        assert at is None or base <= at < base + len(proof._block), stop_at
        if at is None:
            with pytest.raises(InputError):
                proof.result()
        else:
            assert proof.finish().verdict is Verdict.CAGED
    assert seen > 3


@pytest.mark.parametrize(
    "options",
    [
        {"threads": 0},
        {"threads": 65},
        {"threads": NAN},
        {"max_cells": NAN},
        {"max_cells": 1e300},
        {"max_cells": -5},
        {"max_level": 99},
        {"max_level": 2.5},
        {"start_level": "3"},
    ],
)
def test_options_of_a_proof(options):
    with pytest.raises(InputError):
        Scene(DISC, FINGERS).prove((0, 0, 0), **options)


@pytest.mark.parametrize(
    "options",
    [
        {"level": 2.7},
        {"level": -2},
        {"level": 99},
        {"budget": -1},
        {"budget": 0.5},
        {"far": NAN},
        {"far": -1.0},
        {"far": float("inf")},
        {"parts": 0, "executor": lambda: None},
        {"executor": 5},
        {"executor": lambda: 5},
    ],
)
def test_options_of_an_atlas(options):
    with pytest.raises(InputError):
        Scene(DISC, FINGERS).atlas(**{"level": 3, **options})


def test_executors_that_are_none():
    questions = [Question(Scene(DISC, FINGERS), (0, 0, 0))]
    for bad in (5, lambda: 5):
        with pytest.raises(InputError, match="executor"):
            prove_many(questions, bad)
    with pytest.raises(InputError):
        prove_many(questions, lambda: None, retries=-1)


@pytest.mark.parametrize(
    "arguments",
    [
        ((NAN, 0), 0.001, (4, 4)),
        ((1e9, 0), 0.001, (4, 4)),
        ((0, 0), NAN, (4, 4)),
        ((0, 0), -1, (4, 4)),
        ((0, 0), 0, (4, 4)),
        ((0, 0), 1e9, (4, 4)),
        ((0, 0), 0.001, (0, 4)),
        ((0, 0), 0.001, (2.5, 4)),
        ((0, 0, 0), 0.001, (4, 4)),
    ],
)
def test_regions_beyond_the_grid(arguments):
    with Scene(DISC, FINGERS).begin((0, 0, 0)) as proof:
        proof.finish()
        with pytest.raises(InputError):
            proof.region(*arguments)


def test_poses_of_numbers_that_are_too_large():
    for bad in ((10**400, 0, 0), [10**400, 0, 0], [2**53 + 1, 0, 0], [[0, 0], [1]]):
        with pytest.raises(PoseError):
            Scene(DISC, FINGERS).prove(bad)
    with pytest.raises(PoseError):
        Scene(DISC, FINGERS).collides(np.zeros((0, 5)))


def test_more_pairs_than_can_be_counted_are_said_to_be_so():
    rows = np.full((20000, 3), 0.001)
    with pytest.raises(InputError, match="pairs"):
        Scene(rows, rows)


def tiny(size):
    made = trimesh.creation.box((1, 1, 1))
    return trimesh.Trimesh(made.vertices * size, made.faces, process=False)


@pytest.mark.parametrize("size", [1e-300, 1e-165, 1e-120])
def test_a_cover_is_not_proved_where_squares_vanish(size):
    for solid, ball in (
        (box(0, 0, size, size), [[size / 2, size / 2, size / 1000]]),
        (tiny(size), [[0, 0, 0, size / 1000]]),
    ):
        with pytest.raises(SolidError, match="too small"):
            verify_cover(solid, ball)
    assert not verify_cover(box(0, 0, 1e-50, 1e-50), [[5e-51, 5e-51, 1e-53]])


def test_balls_to_verify_are_numbers_as_they_are():
    square = box(0, 0, 1, 1)
    for bad in (
        [["0.5", "0.5", "0.1"]],
        [[0.5, 0.5, 1j]],
        np.array([[2**53 + 1, 0, 1]]),
        np.ma.array([[0.5, 0.5, 0.1]], mask=True),
    ):
        with pytest.raises(InputError):
            verify_balls(square, bad)
    assert not verify_balls(square, [[0.5, 0.5, NAN], [0.5, 0.5, -1]])


@pytest.mark.parametrize("options", [{"count": 2.5}, {"count": NAN}, {"samples": 1}, {"seed": -1}])
def test_options_of_a_fit(options):
    with pytest.raises(InputError):
        fit(box(0, 0, 1, 1), **options)


def test_little_memory_says_how_much():
    with pytest.raises(OutOfMemoryError):
        Scene(DISC, FINGERS).atlas(2, memory=10)
