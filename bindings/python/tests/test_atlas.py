"""Atlases agree with proofs and notice changed bytes; scenes and results can be pickled."""

import gc
import pickle

import numpy as np
import pytest

import libcage
from libcage import Atlas, Balls, Result, Scene, Verdict

DISC = [[0.0, 0.0, 0.04]]
FINGERS = np.array([[0.07, 0, 0.02], [0, 0.07, 0.02], [-0.07, 0, 0.02], [0, -0.07, 0.02]])


def test_atlas_agrees_with_proofs_and_keeps_its_bytes(tmp_path):
    scene = Scene([[0, 0, 0.03], [0.05, 0, 0.02]], FINGERS * [1.3, 1.3, 1.1])
    atlas = scene.atlas(6)
    poses = np.random.default_rng(5).uniform([-0.2, -0.2, -4], [0.2, 0.2, 4], (300, 3))
    verdicts = atlas.query(poses)
    assert len(set(verdicts.tolist())) >= 3
    for pose, verdict in zip(poses[:60], verdicts[:60]):
        proved = scene.prove(tuple(pose)).verdict
        assert proved == verdict or 0 in (proved, verdict)
        assert atlas.ask(tuple(pose)) == verdict
    atlas.save(tmp_path / "a.atlas")
    for again in (
        Atlas.load(tmp_path / "a.atlas"),
        pickle.loads(pickle.dumps(atlas)),
        scene.atlas(6, threads=2),
    ):
        assert again.to_bytes() == atlas.to_bytes()
        assert np.array_equal(again.query(poses), verdicts)
    goal = atlas.query(poses, [(0.5, 0.5, 0)])
    assert set(goal.tolist()) <= {0, 2, 4, 5}
    assert np.array_equal(goal == Verdict.CONNECTED, verdicts == Verdict.FREE)
    assert {c.number for c in atlas.classes()} == set(range(len(atlas.classes())))
    data = bytearray(atlas.to_bytes())
    for bad in (data[:-4], data + b"1234", b"", bytes([data[0] ^ 1]) + bytes(data[1:])):
        with pytest.raises(libcage.CageError):
            Atlas(bad)


def test_an_atlas_keeps_its_bytes_alive():
    data = bytearray(Scene(DISC, FINGERS).atlas(3).to_bytes())
    atlas = Atlas(data)
    data[:] = bytes(len(data))
    gc.collect()
    assert atlas.ask((0, 0, 0)) is Verdict.CAGED


def test_pickles_and_bytes():
    scene = pickle.loads(pickle.dumps(Scene(Balls(DISC, "inner"), FINGERS, unit=2.0**-22)))
    answer = scene.prove((0.2, 0, 0), (0, 0, 0))
    assert answer.verdict is Verdict.DISCONNECTED
    free = Scene(DISC, FINGERS).prove((0.2, 0, 0), (-0.2, 0, 2))
    for one in (answer, free):
        assert pickle.loads(pickle.dumps(one)) == one
        again = Result.from_bytes(one.to_bytes())
        assert again == one and again.to_bytes() == one.to_bytes()


def test_classes_say_how_far_they_turn():
    slot = np.array([[x, y, 0.03] for x in np.arange(-0.2, 0.21, 0.02) for y in (-0.06, 0.06)])
    ends = np.array([[x, 0, 0.04] for x in (-0.2, 0.2)])
    bar = [[x, 0, 0.02] for x in (-0.06, 0, 0.06)]
    atlas = Scene(bar, np.vstack([slot, ends])).atlas(8)
    inside = atlas.locate([(0, 0, 0)])[0]
    found = atlas.classes()[inside]
    assert 0 < found.turn < np.pi / 2
    assert abs(np.sin(2 * np.arctan2(found.middle.wxyz[3], found.middle.wxyz[0]))) < 1e-3
    # Turned by more than it says, no pose of the slot is in the class; by less, one is.
    for turn, there in ((found.turn + 0.01, False), (0.1 * found.turn, True)):
        places = np.stack(np.meshgrid(np.linspace(-0.1, 0.1, 41), np.linspace(-0.03, 0.03, 13)), -1)
        poses = np.c_[places.reshape(-1, 2), np.full(41 * 13, turn)]
        assert (inside in atlas.locate(poses)) is there
    assert atlas.classes()[0].turn == np.pi
