"""Scenes, proofs, atlases: verdicts with a reason of their own, lifetimes, threads, Ctrl-C."""

import gc
import os
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import libcage
from libcage import (
    Atlas,
    Balls,
    InputError,
    KindError,
    OutOfMemoryError,
    PoseError,
    Scene,
    Solid,
    Verdict,
    from_wxyz,
    from_xyzw,
)

DISC = [[0.0, 0.0, 0.04]]
FINGERS = np.array([[0.07, 0, 0.02], [0, 0.07, 0.02], [-0.07, 0, 0.02], [0, -0.07, 0.02]])


def fingers(count, gap, r=0.02, disc=0.04):
    """Equal fingers around a disc, neighbours' tips so far apart: the disc leaves iff gap > 2
    disc."""
    far = (gap + 2 * r) / 2 / np.sin(np.pi / count)
    t = 2 * np.pi * np.arange(count) / count
    return np.c_[far * np.cos(t), far * np.sin(t), np.full(count, r)], [[0, 0, disc]]


@pytest.mark.parametrize("count", [3, 4, 7])
@pytest.mark.parametrize("excess", [-1e-3, -1e-6, 1e-6, 1e-3])
def test_disc_between_fingers_leaves_iff_a_gap_is_wider(count, excess):
    obstacles, disc = fingers(count, 0.08 + excess)
    if count == 7:
        disc = [[0, 0, 0.04]]
    verdict = Scene(disc, obstacles).prove((0, 0, 0.3)).verdict
    assert verdict is (Verdict.FREE if excess > 0 else Verdict.CAGED)
    assert str(verdict) == ("FREE" if excess > 0 else "CAGED")


@pytest.mark.parametrize("count,gap", [(3, 0.07), (4, 0.06), (5, 0.05)])
def test_margin_of_a_disc_is_half_of_what_the_gap_lacks(count, gap):
    obstacles, disc = fingers(count, gap)
    margin = Scene(disc, obstacles).margin((0, 0, 0), rounds=16)
    # Shrunk by m the gap is gap + 2 m and the disc 2 (0.04 - m) wide.
    assert margin.closed <= (0.08 - gap) / 4 <= margin.open
    assert margin.open - margin.closed < 3e-4


def test_in_collision_and_disconnected_and_connected():
    scene = Scene(DISC, FINGERS)
    assert (
        scene.prove((0.03, 0, 0)).verdict is Verdict.IN_COLLISION
    )  # 0.04 from a finger, radii 0.06
    assert scene.prove((0, 0, 0), (0.5, 0, 0)).verdict is Verdict.DISCONNECTED
    assert scene.prove((-0.5, 0, 0), (0.5, 0, 1)).verdict is Verdict.CONNECTED
    assert scene.collides([(0.03, 0, 0), (0, 0, 0)]).tolist() == [True, False]


def test_the_path_is_free_between_its_frames_too():
    obstacles, disc = fingers(3, 0.0801)
    answer = Scene(disc, obstacles).prove((0, 0, 0))
    poses = answer.path.frames(3000)
    gap = (
        np.linalg.norm(poses.x[:, None] - obstacles[None, :, :2], axis=2)
        - obstacles[None, :, 2]
        - 0.04
    )
    assert gap.min() > -1e-9
    assert np.linalg.norm(poses.x[-1]) > 0.1


def test_the_pose_proved_is_the_rounded_one_and_near():
    answer = Scene(DISC, FINGERS).prove((1e-3 / 3, 0, 0.1))
    assert 0 < abs(answer.start.x[0] - 1e-3 / 3) <= answer.unit / 2
    assert answer.start_grid[0] * answer.unit == answer.start.x[0]
    assert abs(answer.start.theta - 0.1) < 1e-8


def test_quarter_turns_are_exact():
    for k in range(-4, 5):
        q = Scene(DISC, FINGERS).prove((0, 0, k * np.pi / 2)).start_grid[3:]
        assert {abs(q[0]), abs(q[3])} in ({0, 1 << 30}, {759250125}), k


def test_space_agrees_with_itself_in_every_way_to_say_a_pose():
    shell = (
        np.array(
            [
                [x, y, z, 0.9]
                for x in (-1, 0, 1)
                for y in (-1, 0, 1)
                for z in (-1, 0, 1)
                if (x, y, z) != (0, 0, 0)
            ]
        )
        * 1.0
    )
    scene = Scene([[0, 0, 0, 0.05], [0.02, 0, 0, 0.05]], shell)
    half = np.sqrt(0.5)
    matrix = np.eye(4)
    matrix[:2, :2] = [[0, -1], [1, 0]]
    poses = [
        matrix,
        from_wxyz([0, 0, 0], [half, 0, 0, half]),
        from_xyzw([0, 0, 0], [0, 0, half, half]),
    ]
    answers = [scene.prove(pose) for pose in poses]
    assert {answer.verdict for answer in answers} == {Verdict.CAGED}
    assert len({answer.start_grid for answer in answers}) == 1
    assert np.allclose(answers[0].start.matrix(), matrix)


@pytest.mark.parametrize("dtype", [np.float64, np.float32, np.int64, np.int32, np.uint8])
def test_any_real_dtype_and_layout_is_the_same_scene(dtype):
    rows = np.array([[7, 0, 2], [0, 7, 2], [250, 0, 2]], dtype=np.float64)
    wide = np.zeros((6, 9))
    wide[::2, ::3] = rows
    given = [
        rows.astype(dtype),
        np.asfortranarray(rows.astype(dtype)),
        wide.astype(dtype)[::2, ::3],
    ]
    rows_read = [Balls(array).rows for array in given]
    assert all(np.array_equal(read, rows) and read.flags.c_contiguous for read in rows_read)


@pytest.mark.parametrize(
    "bad",
    [
        np.array([[0, 0, "1"]]),
        np.array([[0, 0, 1j]]),
        np.array([[0, 0, None]]),
        np.array([[True, False, True]]),
        [[0, 0, np.nan]],
        [[np.inf, 0, 1]],
        [[0, 0, -1e-300]],
        [0, 0, 1],
        [[0, 1]],
        [[0, 0, 0, 0, 1]],
        [[1e40, 0, 1]],
        np.array([[2**60 + 1, 0, 1]]),
        np.zeros((2, 2, 3)),
        [],
        np.array([[0, 0, np.longdouble(1) / 3]]),
    ],
)
def test_balls_that_are_none_are_refused(bad):
    with pytest.raises(InputError):
        Balls(bad)


def test_balls_of_no_length_are_fine():
    empty = np.zeros((0, 3))
    assert Scene(DISC, empty).prove((0, 0, 0)).verdict is Verdict.FREE
    assert Scene(empty, FINGERS).prove((0, 0, 0)).verdict is Verdict.FREE
    assert len(Scene(DISC, FINGERS).collides(np.zeros((0, 3)))) == 0
    assert len(Scene(DISC, FINGERS).atlas(2).query(np.zeros((0, 3)))) == 0


def test_dimensions_do_not_mix():
    with pytest.raises(InputError):
        Scene(DISC, [[0, 0, 0, 1]])
    with pytest.raises(PoseError):
        Scene(DISC, FINGERS).prove(from_wxyz([0, 0, 0], [1, 0, 0, 0]))
    with pytest.raises(PoseError, match="from_wxyz"):
        Scene([[0, 0, 0, 1]], np.zeros((0, 4))).prove([0, 0, 0, 1, 0, 0, 0])


@pytest.mark.parametrize(
    "bad",
    [(np.nan, 0, 0), (0, np.inf, 0), (0, 0, np.nan), (0, 0), (0, 0, 0, 0), "abc", (1j, 0, 0), None],
)
def test_poses_that_are_none_are_refused(bad):
    with pytest.raises(PoseError):
        Scene(DISC, FINGERS).prove(bad)


def test_matrices_that_are_no_motion_are_refused():
    scene = Scene([[0, 0, 0, 1]], np.zeros((0, 4)))
    for bad, why in (
        (np.diag([1, 1, -1, 1]), "left-handed"),
        (np.diag([2, 2, 2, 1]), "rigid"),
        (np.diag([1, 1, 1, 2]), "last row"),
        (np.eye(4) + np.eye(4, k=1) * 0.01, "rigid"),
        (np.zeros((4, 4)), "last row"),
        (np.diag([0, 0, 0, 1]), "rigid"),
    ):
        with pytest.raises(PoseError, match=why):
            scene.prove(bad)
        with pytest.raises(PoseError, match="matrix 1"):
            scene.collides(np.stack([np.eye(4), bad]))
    bad = np.eye(4)
    bad[0, 3] = np.nan
    with pytest.raises(PoseError):
        scene.prove(bad)
    with pytest.raises(PoseError, match="length 1"):
        from_wxyz([0, 0, 0], [2, 0, 0, 0])


def test_poses_beyond_the_grid_are_refused_not_wrapped():
    scene = Scene(DISC, FINGERS, unit=2.0**-20)
    far = 2.0**-20 * 178956970
    assert scene.prove((far, 0, 0)).verdict is Verdict.FREE
    for bad in ((far * 1.0001, 0, 0), (2.0**12 + far, 0, 0), (-1e300, 0, 0)):
        with pytest.raises((PoseError, libcage.GridError)):
            scene.prove(bad)
        with pytest.raises((PoseError, libcage.GridError)):
            scene.collides([bad])
    with pytest.raises(libcage.GridError):
        Scene(DISC, FINGERS, unit=2.0**-40).prove((0, 0, 0))
    with pytest.raises(libcage.GridError):
        Scene(DISC, FINGERS, unit=0.001)
    atlas = Scene(DISC, FINGERS).atlas(2)
    with pytest.raises(PoseError):
        atlas.query([(1e6, 0, 0)])


@pytest.mark.parametrize("kind", ["outer", "unknown"])
def test_a_cage_of_balls_of_the_wrong_kind_is_refused(kind):
    obstacles = Balls(FINGERS, kind)
    scene = Scene(DISC, obstacles)
    with pytest.raises(KindError, match=kind):
        scene.prove((0, 0, 0), side="inner")
    if kind == "unknown":
        with pytest.raises(KindError):
            scene.prove((0, 0, 0))
        with pytest.raises(KindError):
            scene.atlas(2)
    else:
        answer = scene.prove((0, 0, 0))
        assert (
            answer.verdict is Verdict.UNDEFINED and "separation was not looked for" in answer.note
        )
        assert scene.prove((0.5, 0, 0)).verdict is Verdict.FREE
        assert (
            scene.prove((0.03, 0, 0)).verdict is not Verdict.IN_COLLISION
        )  # of covers that overlap
        atlas = scene.atlas(3)
        assert Verdict.CAGED not in atlas.query([(0, 0, 0)]) and atlas.sides == ("outer",)
    with pytest.raises(KindError):
        scene.margin((0, 0, 0))
    insisted = scene.prove((0, 0, 0), insist=True)
    assert (
        insisted.verdict is Verdict.CAGED
        and "not the solids" in insisted.about
        and kind in str(insisted)
    )
    atlas = scene.atlas(3, insist=True)
    assert atlas.ask((0, 0, 0)) is Verdict.CAGED and "not the solids" in atlas.about
    assert "not the solids" in Atlas(atlas.to_bytes()).about


def test_inner_balls_prove_no_path():
    scene = Scene(Balls(DISC, "inner"), FINGERS)
    assert scene.prove((0, 0, 0)).verdict is Verdict.CAGED
    answer = scene.prove((0.5, 0, 0))
    assert answer.verdict is Verdict.UNDEFINED and "paths were not looked for" in answer.note
    with pytest.raises(KindError):
        scene.prove((0.5, 0, 0), side="outer")
    assert scene.atlas(3).ask((0.5, 0, 0)) is Verdict.UNDEFINED
    with pytest.raises(KindError):
        Solid(Balls(DISC, "outer"), Balls(DISC, "outer"))  # a label in the wrong place
    with pytest.raises(KindError):
        Scene(Balls(DISC, "inner"), Balls(FINGERS, "outer")).prove((0, 0, 0))


def test_mutating_what_was_given_changes_nothing():
    rows = FINGERS.copy()
    scene = Scene(DISC, rows)
    proof = scene.begin((0, 0, 0))
    rows[:] = 99
    assert proof.finish().verdict is Verdict.CAGED
    with pytest.raises(ValueError):
        scene.obstacles.inner.rows[0, 0] = 3


def test_a_proof_keeps_alive_what_it_reads():
    obstacles, disc = fingers(7, 0.0799)
    wanted = Scene(disc, obstacles).prove((0, 0, 0))
    proofs = [Scene(list(disc), obstacles.copy()).begin((0, 0, 0)) for _ in range(40)]
    gc.collect()
    junk = [np.full(1 << 14, 7, dtype=np.int32) for _ in range(200)]
    while not all(proof.run(1) for proof in proofs):
        pass
    results = [proof.result() for proof in proofs]
    for proof in proofs:
        proof.close()
    del proofs, junk
    gc.collect()
    assert {result.to_bytes() for result in results} == {wanted.to_bytes()}


def test_a_result_outlives_its_block():
    answer = Scene(DISC, FINGERS).prove((0.2, 0, 0))
    before = answer.path.grid.tolist()
    for _ in range(20):
        Scene(DISC, FINGERS).prove((0, 0, 0))
    assert answer.path.grid.tolist() == before
    with pytest.raises(ValueError):
        answer.path.grid[0, 0] = 1


def test_a_closed_proof_is_refused_not_read():
    proof = Scene(DISC, FINGERS).begin((0, 0, 0))
    proof.close()
    proof.close()
    for use in (
        lambda: proof.run(1),
        proof.result,
        proof.finish,
        lambda: proof.region((0, 0), 1, (1, 1)),
    ):
        with pytest.raises(InputError):
            use()


def test_portions_memory_and_threads_do_not_change_the_answer():
    obstacles, _ = fingers(9, 0.03, r=0.01)
    scene = Scene([[0, 0, 0.02], [0.05, 0, 0.008], [-0.05, 0.01, 0.008]], obstacles)
    wanted = scene.prove((0, 0, 0), threads=1).to_bytes()
    assert scene.prove((0, 0, 0), threads=2).to_bytes() == wanted
    with scene.begin((0, 0, 0)) as proof:
        while not proof.run(3):
            pass
        assert proof.result().to_bytes() == wanted


def test_little_memory_is_an_error_that_says_how_much():
    with pytest.raises(OutOfMemoryError):
        Scene(DISC, FINGERS).prove((0, 0, 0), memory=1000)


def test_threads_may_ask_at_once():
    scene = Scene(DISC, FINGERS)
    wanted = {scene.prove((x, 0, 0)).to_bytes() for x in (0, 0.2)}
    found, errors = set(), []

    def work(x):
        try:
            for _ in range(60):
                found.add(scene.prove((x, 0, 0)).to_bytes())
        except Exception as error:
            errors.append(error)

    crew = [threading.Thread(target=work, args=(x,)) for x in (0, 0.2) * 4]
    for one in crew:
        one.start()
    for one in crew:
        one.join()
    assert not errors and found == wanted


def test_a_proof_used_by_two_threads_is_locked():
    obstacles, disc = fingers(5, 0.0799)
    proof = Scene(disc, obstacles).begin((0, 0, 0))
    crew = [threading.Thread(target=lambda: [proof.run(1) for _ in range(200)]) for _ in range(4)]
    for one in crew:
        one.start()
    for one in crew:
        one.join()
    assert proof.finish().verdict is Verdict.CAGED


LONG = """
import numpy as np, libcage, signal, os, threading, time
rng = np.random.default_rng(1)
t = rng.uniform(0, 2 * np.pi, 40)
ring = lambda n, c: np.array([[c[0] + np.cos(a), c[1] + np.sin(a) * c[3], np.sin(a) * c[2], 0.15]
                              for a in np.linspace(0, 2 * np.pi, n, endpoint=False)])
scene = libcage.Scene(ring(24, (0, 0, 0, 1)), ring(24, (1, 0, 1, 0)))
threading.Timer(1.0, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
begun = time.monotonic()
try:
    scene.prove(np.eye(4), threads={threads})
    print("finished")
except KeyboardInterrupt:
    print("stopped", time.monotonic() - begun < 4)
assert libcage.Scene([[0, 0, 1]], np.zeros((0, 3))).prove((0, 0, 0)).verdict == libcage.Verdict.FREE
"""


@pytest.mark.parametrize("threads", [1, 2])
def test_ctrl_c_stops_a_long_proof(threads):
    done = subprocess.run(
        [sys.executable, "-c", LONG.replace("{threads}", str(threads))],
        capture_output=True,
        text=True,
        timeout=100,
    )
    assert done.stdout.split() == ["stopped", "True"], done.stderr


def test_the_gil_is_released():
    ticks = []
    stop = threading.Event()

    def tick():
        while not stop.is_set():
            ticks.append(1)
            time.sleep(0.001)

    walls = np.array(
        [
            [x, y, 0.012]
            for x in np.linspace(-1, 1, 30)
            for y in np.linspace(-1, 1, 30)
            if abs(x) > 0.3 or abs(y) > 0.3
        ]
    )
    thread = threading.Thread(target=tick)
    thread.start()
    begun = time.perf_counter()
    atlas = Scene([[0, 0, 0.05], [0.05, 0, 0.05], [0, 0.07, 0.02]], walls).atlas(8, threads=1)
    taken = time.perf_counter() - begun
    stop.set()
    thread.join()
    assert len(atlas) and taken > 0.1
    assert (
        len(ticks) > 0.1 * taken / 0.001
    )  # the portions are 50 ms: with the GIL held, one tick each


def test_region_holds_the_pivot_of_a_cage_only_inside():
    with Scene(DISC, FINGERS).begin((0, 0, 0)) as proof:
        proof.finish()
        mask = proof.region((-0.1, -0.1), 0.005, (41, 41))
    inside = np.argwhere(mask) * 0.005 - 0.1
    assert len(inside) > 3 and np.linalg.norm(inside, axis=1).max() < 0.04
    assert mask[20, 20]


def test_every_pose_near_a_rounding_is_the_command_s(tmp_path):
    """The same grid as the command line tool makes, where that was built."""
    tool = os.environ.get("LIBCAGE_COMMAND")
    if not tool:
        pytest.skip("LIBCAGE_COMMAND is not set")
    import json

    rng = np.random.default_rng(3)
    for n in range(6):
        part, walls = rng.uniform(0.01, 0.1, (4, 3)), rng.uniform(-1, 1, (30, 3))
        walls[:, 2] = rng.uniform(0.02, 0.2, 30)
        np.savetxt(tmp_path / "p.xyzr", part, fmt="%.17g")
        np.savetxt(tmp_path / "w.xyzr", walls, fmt="%.17g")
        printed = subprocess.run(
            [
                tool,
                "prove",
                "--object",
                tmp_path / "p.xyzr",
                "--obstacles",
                tmp_path / "w.xyzr",
                "--start",
                "0.01,0.02,0",
                "--json",
            ],
            capture_output=True,
            text=True,
            check=True,
        )
        raw = json.loads(printed.stdout)
        answer = Scene(part, walls).prove((0.01, 0.02, 0))
        assert (raw["verdict"], raw["unit"]) == (str(answer.verdict), answer.unit)
        assert raw["steps"] == answer.statistics.steps and raw["cells"] == answer.statistics.cells
