"""Pictures show what they say: pixels and numbers in them, not only that a file was written."""

import json
import re

import matplotlib

matplotlib.use("Agg")

import numpy as np
import pytest
from matplotlib import pyplot

from libcage import NO_CLASS, Balls, InputError, Scene, Verdict, plot, view

FINGERS = np.array([[0.07, 0, 0.02], [0, 0.07, 0.02], [-0.07, 0, 0.02], [0, -0.07, 0.02]])
DISC = [[0.0, 0.0, 0.04]]


@pytest.fixture(autouse=True)
def closing():
    yield
    pyplot.close("all")


def pixels(ax):
    ax.set_xlim(-0.1, 0.1)
    ax.set_ylim(-0.1, 0.1)
    ax.figure.canvas.draw()
    image = np.asarray(ax.figure.canvas.buffer_rgba())[..., :3]

    def at(x, y):
        px, py = ax.transData.transform((x, y))
        return tuple(int(v) for v in image[image.shape[0] - 1 - int(py), int(px)])

    return at


def test_a_scene_has_its_balls_where_they_are():
    at = pixels(plot.scene(Scene(DISC, FINGERS), start=(0.0, 0.0, 0.0), goal=(0.05, 0.05, 0.0)))
    blue, grey, white = at(-0.03, 0), at(0.07, 0), at(-0.05, -0.05)
    assert (
        blue[2] > blue[0] + 50
        and max(grey) - min(grey) < 3 < 255 - grey[0]
        and white == (255, 255, 255)
    )
    orange = at(0.06, 0.06)
    assert orange[0] > orange[2] + 80


def test_slices_colour_what_is_free():
    scene = Scene(DISC, FINGERS)
    atlas = scene.atlas(3)
    xs = ys = np.linspace(-0.15, 0.15, 61)
    classes = plot.classes_at(atlas, xs, ys, 0.3)
    assert classes[0, 0] == 0 and classes[30, 44] == NO_CLASS  # far away; at a finger
    assert classes[30, 30] > 0  # the cage
    axes = plot.slices(scene, atlas, (0.0, 0.3), points=60)
    image = axes[1].images[0].get_array()
    assert len(np.unique(image.reshape(-1, 3), axis=0)) == 3
    ax = plot.graph(scene, atlas, angles=8, points=40)
    assert (
        len(ax.collections) == 16 and len(ax.lines) == 16
    )  # the outside and the cage, at 8 angles each


def test_a_path_is_drawn_from_start_to_far_away():
    scene = Scene(DISC, FINGERS[:3])
    answer = scene.prove((0, 0, 0))
    ax = plot.result(scene, answer)
    line = ax.lines[0].get_xydata()
    assert np.allclose(line[0], 0, atol=1e-6) and np.linalg.norm(line[-1]) > 0.06
    assert "FREE" in ax.get_title()


def test_pictures_of_the_plane_are_not_drawn_in_space():
    with pytest.raises(InputError):
        plot.scene(Scene([[0, 0, 0, 1]], np.zeros((0, 4))))


@pytest.mark.parametrize("dim", [2, 3])
def test_the_animation_moves_the_object_along_the_path(dim, tmp_path):
    if dim == 2:
        scene, start = Scene(DISC, FINGERS[:3]), (0, 0, 0)
    else:
        scene, start = (
            Scene([[0, 0, 0, 0.04]], np.c_[FINGERS[:3, :2], np.zeros(3), FINGERS[:3, 2]]),
            np.eye(4),
        )
    answer = scene.prove(start)
    assert answer.verdict is Verdict.FREE
    figure = view.figure(scene, answer, frames=12)
    assert len(figure.frames) >= 12
    middles = [
        np.array(
            [
                np.nanmean([np.nanmin(frame.data[0][axis]), np.nanmax(frame.data[0][axis])])
                for axis in "xyz"[:dim]
            ]
        )
        for frame in figure.frames
    ]
    assert np.allclose(
        middles, answer.path.frames(12).x, atol=2e-3
    )  # the object is one ball at its origin
    assert np.linalg.norm(middles[-1] - middles[0]) > 0.03
    view.write_html(tmp_path / "a.html", scene, answer)
    page = (tmp_path / "a.html").read_text()
    assert not re.search(r"<script[^>]+src=", page) and "FREE" in page  # it needs no network
    assert json.dumps("play") in page


def test_pictures_of_balls_inside_only():
    figure = view.figure(
        Scene(Balls([[0, 0, 0, 1]], "inner"), np.array([[3.0, 0, 0, 1]])), start=np.eye(4)
    )
    assert len(figure.data) == 2
