"""Smoothed paths: shorter, without corners, judged by dense samples, refused once obstructed."""

import pickle
from dataclasses import replace
from pathlib import Path as File

import matplotlib

matplotlib.use("Agg")

import numpy as np
import pytest
from scipy.spatial.transform import Rotation, Slerp

from libcage import Balls, InputError, Question, Result, Scene, Verdict, prove_many
from libcage.smoothing import Checker, deviation, length

POSTS = np.array([[0.0, y, 0.02] for y in np.arange(-0.1, 0.11, 0.02)])  # a wall to go around
BAR = np.array([[-0.02, 0, 0.01], [0, 0, 0.01], [0.02, 0, 0.01]])


@pytest.fixture(scope="module")
def around():
    scene = Scene(BAR, POSTS)
    answer = scene.prove((-0.1, 0, 0), (0.1, 0, 1.5))
    assert answer.verdict is Verdict.CONNECTED
    return scene, answer


@pytest.fixture(scope="module")
def smoothed(around):
    return around[1].path.smooth()


def gap(scene, path, between=5):
    """The least gap on the curve that Path promises, from its rows alone, in grid units."""
    grid = scene.at_unit(path.unit)
    x = path.grid[:, :3].astype(float)
    turn = Rotation.from_quat(path.grid[:, [4, 5, 6, 3]].astype(float))
    slope = np.gradient(x, axis=0)  # half the difference of neighbours; at the ends to the one
    t = np.arange(between + 1)[:, None] / between
    part, walls = grid.arrays[1].astype(float), grid.arrays[3].astype(float)
    least = np.inf
    for i in range(len(x) - 1):
        at = (2 * t**3 - 3 * t**2 + 1) * x[i] + (t**3 - 2 * t**2 + t) * slope[i]
        at = at + (3 * t**2 - 2 * t**3) * x[i + 1] + (t**3 - t**2) * slope[i + 1]
        for p, r in zip(at, Slerp([0, 1], turn[i : i + 2])(t[:, 0])):
            centres = p + r.apply(part[:, :3] - path.pivot_grid)
            far = np.linalg.norm(centres[:, None] - walls[None, :, :3], axis=2)
            least = min(least, (far - part[:, None, 3] - walls[None, :, 3]).min())
    return least


def sharpest(path):
    """The largest turn of the pivot's direction from row to row, where it moves."""
    step = np.diff(path.grid[:, :3].astype(float), axis=0)
    size = np.linalg.norm(step, axis=1)
    long = (size[1:] > size.max() / 10) & (size[:-1] > size.max() / 10)
    cosine = (step[1:] * step[:-1]).sum(axis=1) / np.maximum(size[1:] * size[:-1], 1e-9)
    return np.degrees(np.arccos(np.clip(cosine[long], -1, 1))).max()


def test_a_path_around_a_wall(around, smoothed):
    (scene, answer), path = around, smoothed
    assert path.curve and not answer.path.curve
    assert length(path) < length(answer.path)
    assert gap(scene, path) > -1e-3 and sharpest(path) < 15
    assert np.array_equal(path.grid[[0, -1]], answer.path.grid[[0, -1]])  # the ends are the same
    # nothing is shorter than around the end of the wall: taut to its top post, at 0.13 from the middle
    assert np.linalg.norm(np.diff(path.poses.x, axis=0), axis=1).sum() > 2 * np.hypot(0.1, 0.11)
    again = path.smooth()
    assert again.curve and length(again) <= length(path) * (1 + 1e-6)
    assert len(path.poses) == len(path) and path.poses[0] == answer.path.poses[0]


def test_a_path_out_and_one_in_space():
    open_ = Scene([[0, 0, 0.04]], np.array([[0.07, 0, 0.02], [0, 0.07, 0.02], [-0.07, 0, 0.02]]))
    examples = File(__file__).parent.parent.parent.parent / "examples" / "space"
    scenes = [(open_, (0, 0, 0))]
    hook = [c for c in ("mug", "hook") if (examples / f"{c}.xyzr").is_file()]
    if len(hook) == 2:
        mug, hook = (np.loadtxt(examples / f"{c}.xyzr") for c in hook)
        scenes.append((Scene(mug, hook), np.eye(4)))
    else:  # a bar out of a box with a slot
        walls = [
            [x, y, z, 0.36]
            for x in np.arange(-1.5, 1.6, 0.5)
            for y in np.arange(-1.5, 1.6, 0.5)
            for z in (-1.5, 1.5)
            if z < 0 or abs(y) > 0.5
        ]
        bar = [[x, 0, 0, 0.18] for x in (-0.6, -0.3, 0, 0.3, 0.6)]
        scenes.append((Scene(bar, walls), np.eye(4)))
    for scene, start in scenes:
        answer = scene.prove(start, side="outer")
        assert answer.verdict is Verdict.FREE
        path = answer.path.smooth()
        assert length(path) <= length(answer.path) * (1 + 1e-6)
        assert gap(scene, path) > -1e-3 if path.curve else path is answer.path
    assert path.curve


def test_no_mutation_is_accepted_wrongly(around, smoothed):
    """Rows are moved, or the bar made thicker: what the check accepts keeps clear."""
    scene, path = around[0], smoothed
    random = np.random.default_rng(3)
    refused = accepted = 0
    for n in range(36):
        rows = path.grid.copy()
        at = random.integers(2, len(rows) - 2)
        size = 0.03 / path.unit * 0.5 ** (n % 12)
        rows[at, :2] += (size * random.uniform(-1, 1, 2)).astype(np.int32)
        bent = replace(path, grid=rows)
        if Checker(scene.at_unit(path.unit), bent).curve(rows):
            accepted += 1
            assert gap(scene, bent) > -1e-3
        else:
            refused += 1
    assert refused >= 10 and accepted >= 5
    room = gap(scene, path) * path.unit
    for more in (0.5, 0.9, 1.2, 3.0):
        thick = Scene(BAR + [0, 0, room * more], POSTS, unit=path.unit)
        ok = Checker(thick.at_unit(path.unit), path).curve(path.grid)
        assert not ok or more < 1


def test_the_deviation_is_what_sampling_finds(smoothed):
    path = smoothed
    x = path.grid[:, :3].astype(float)
    slope = np.gradient(x, axis=0)
    t = np.linspace(0, 1, 21)[:, None]
    worst = 0.0
    for i in range(len(x) - 1):
        off = t * (1 - t) * ((1 - t) * (slope[i] - x[i + 1] + x[i]))
        off -= t * (1 - t) * t * (slope[i + 1] - x[i + 1] + x[i])
        worst = max(worst, np.linalg.norm(off, axis=1).max())
    assert worst <= deviation(path.grid) < 3 * worst + 1


def test_paths_from_bytes_need_their_scene():
    posts = np.array([[0.0, 0.0, 0.02]])  # one, that is passed by
    scene, ends = Scene(BAR, posts), ((-0.07, 0, 0), (0.07, 0, 0))
    answer = scene.prove(*ends)
    read = Result.from_bytes(answer.to_bytes())
    assert read.path == answer.path and read.path.scene is None
    with pytest.raises(InputError, match="bytes"):
        read.path.smooth()
    with pytest.raises(InputError, match="no path of that scene"):
        read.path.smooth(Scene(BAR, posts + [0.07, 0, 0], unit=read.unit))
    with pytest.raises(InputError, match="dimensions"):
        read.path.smooth(Scene([[0, 0, 0, 1]], np.zeros((0, 4))))
    wanted = answer.path.smooth()
    assert wanted.curve and wanted != answer.path
    assert read.path.smooth(scene) == wanted
    assert pickle.loads(pickle.dumps(answer)).path.smooth() == wanted
    insisted = Question(
        Scene(Balls(BAR, "outer"), Balls(posts, "unknown")), *ends, {"insist": True}
    )
    for one in prove_many([Question(scene, *ends), insisted]):
        assert one.path.smooth() == wanted


def test_pictures_of_a_path(around, smoothed):
    from matplotlib import pyplot

    path = smoothed
    line = path.plot().lines[0].get_xydata()
    assert np.allclose(line[0], [-0.1, 0], atol=1e-6) and np.allclose(line[-1], [0.1, 0], atol=1e-6)
    assert np.linalg.norm(np.diff(line, axis=0), axis=1).max() < 0.01  # it is drawn as a curve
    pyplot.close("all")
    figure = path.animate(frames=12)
    assert len(figure.frames) == 12
    plain = around[1].path
    assert len(plain.animate(frames=12).frames) >= 12
    with pytest.raises(InputError, match="bytes"):
        replace(path, scene=None).plot()
