"""Pictures in the plane with matplotlib: scenes, slices, paths, components over the angle.

Slices and the graph are drawn from points of a raster, for the eye: the proof is in the atlas or
the Result, not in the picture. All lengths are metres, angles radians."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from .atlas import NO_CLASS, Atlas
from .balls import Balls
from .errors import InputError
from .extras import extra
from .poses import Pose, PoseLike, Poses, pose as read_pose
from .result import Path, Result
from .scene import Scene

if TYPE_CHECKING:
    from matplotlib.axes import Axes

OBSTACLE, START, GOAL, COVERED = "#8a8a8a", "#2a6fbb", "#e07b00", "#3c3c3c"


def _axes(ax: Axes | None) -> Axes:
    if ax is not None:
        return ax
    with extra("pictures"):
        from matplotlib import pyplot

    return pyplot.subplots()[1]


def _flat(scene: Scene) -> None:
    if scene.dim != 2:
        raise InputError("these pictures are of the plane; in space see libcage.view")


def shown(scene: Scene, which: str) -> Balls:
    """The balls to draw of the 'object' or the 'obstacles': the outer ones if there are any."""
    solid = scene.object if which == "object" else scene.obstacles
    balls = solid.outer if solid.outer is not None else solid.inner
    assert balls is not None
    return balls


def circles(
    ax: Axes, rows: NDArray[np.float64], colour: str, alpha: float = 1.0, zorder: float = 1
) -> None:
    """Discs, rows x y r."""
    with extra("pictures"):
        from matplotlib.collections import PatchCollection
        from matplotlib.patches import Circle

    patches = [Circle((float(x), float(y)), float(r)) for x, y, r in rows]
    ax.add_collection(
        PatchCollection(patches, facecolor=colour, edgecolor="none", alpha=alpha, zorder=zorder)
    )


def placed(balls: Balls, at: Pose) -> NDArray[np.float64]:
    """The balls' rows with the object at a pose."""
    rows = np.array(balls.rows)
    matrix = at.matrix()
    dim = balls.dim
    rows[:, :-1] = balls.centres @ matrix[:dim, :dim].T + matrix[:dim, dim]
    return rows


def scene(
    what: Scene, start: PoseLike | None = None, goal: PoseLike | None = None, ax: Axes | None = None
) -> Axes:
    """Obstacles grey, the object at the start blue, at the goal orange."""
    _flat(what)
    ax = _axes(ax)
    circles(ax, shown(what, "obstacles").rows, OBSTACLE)
    for at, colour in ((start, START), (goal, GOAL)):
        if at is not None:
            circles(ax, placed(shown(what, "object"), read_pose(at, 2)), colour, 0.9, 3)
    ax.set_aspect("equal")
    ax.autoscale_view()
    ax.set_xlabel("x / m")
    ax.set_ylabel("y / m")
    return ax


def path(what: Scene, way: Path, frames: int = 14, ax: Axes | None = None) -> Axes:
    """The scene with a path, as frames from violet to yellow, and the line of its pivot."""
    with extra("pictures"):
        from matplotlib import colormaps
        from matplotlib.colors import to_hex

    ax = scene(what, way.start, way.goal, ax)
    fine = way.frames(max(200, frames))
    some = np.unique(np.linspace(0, len(fine) - 1, frames).astype(int)) if way.curve else None
    poses = way.frames(frames) if some is None else Poses(fine.x[some], fine.wxyz[some])
    for i in range(len(poses)):
        colour = to_hex(colormaps["plasma"](i / max(len(poses) - 1, 1)))
        circles(ax, placed(shown(what, "object"), poses[i]), colour, 0.35, 2)
    at = fine.x + (fine.matrices()[:, :2, :2] @ np.asarray(way.pivot))
    ax.plot(at[:, 0], at[:, 1], color="black", linewidth=1, zorder=4)
    ax.autoscale_view()
    return ax


def result(what: Scene, answer: Result, frames: int = 14, ax: Axes | None = None) -> Axes:
    """The scene with start and goal, and the path found, as frames from violet to yellow and a
    line."""
    if answer.path is not None:
        ax = path(what, answer.path, frames, ax)
    else:
        ax = scene(what, answer.start, answer.goal, ax)
    ax.set_title(f"{answer.verdict}: {answer.reason}", fontsize=9)
    return ax


def _raster(what: Scene, points: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Places of the object's origin around the obstacles, as the x and the y of a raster."""
    rows = shown(what, "obstacles").rows
    if not len(rows):
        rows = np.array([[0.0, 0.0, 1.0]])
    part = shown(what, "object").rows
    room = 2 * float((np.linalg.norm(part[:, :2], axis=1) + part[:, 2]).max(initial=0.0))
    low = (rows[:, :2] - rows[:, 2:]).min(axis=0) - room
    high = (rows[:, :2] + rows[:, 2:]).max(axis=0) + room
    pitch = float((high - low).max()) / points
    return np.arange(low[0], high[0], pitch), np.arange(low[1], high[1], pitch)


def classes_at(
    atlas: Atlas,
    xs: NDArray[np.float64],
    ys: NDArray[np.float64],
    theta: float,
    side: str = "inner",
) -> NDArray[np.int32]:
    """The atlas's class at each point of a raster, shape (len(ys), len(xs)), NO_CLASS where
    covered."""
    x, y = np.meshgrid(xs, ys)
    wxyz = np.zeros((x.size, 4))
    wxyz[:, 0], wxyz[:, 3] = np.cos(theta / 2), np.sin(theta / 2)
    return atlas.locate(Poses(np.c_[x.ravel(), y.ravel()], wxyz), side).reshape(x.shape)


def _colours(classes: NDArray[np.int32]) -> NDArray[np.float64]:
    """Class 0, the outside, is pale; covered places are dark; the others have colours of their
    own."""
    with extra("pictures"):
        from matplotlib import colormaps
        from matplotlib.colors import to_rgb

    table = np.array([colormaps["tab20"](i % 20)[:3] for i in range(20)])
    image: NDArray[np.float64] = table[classes % 20]
    image[classes == 0] = to_rgb("#f2f2ea")
    image[classes == NO_CLASS] = to_rgb(COVERED)
    return image


def slices(
    what: Scene, atlas: Atlas, thetas: Any = (0.0, 0.5, 1.0), side: str = "inner", points: int = 240
) -> list[Axes]:
    """For each angle, where the object's origin can be: free classes coloured, collisions dark."""
    with extra("pictures"):
        from matplotlib import pyplot

    _flat(what)
    thetas = list(np.atleast_1d(thetas))
    figure, axes = pyplot.subplots(1, len(thetas), figsize=(4 * len(thetas), 4.2), squeeze=False)
    xs, ys = _raster(what, points)
    for ax, theta in zip(axes[0], thetas):
        image = _colours(classes_at(atlas, xs, ys, float(theta), side))
        ax.imshow(
            image, origin="lower", extent=(xs[0], xs[-1], ys[0], ys[-1]), interpolation="nearest"
        )
        ax.set_title(f"theta = {theta:.3g} rad, {side} side", fontsize=9)
        ax.set_xlabel("x of the object / m")
        ax.set_ylabel("y / m")
    figure.tight_layout()
    return list(axes[0])


def graph(
    what: Scene,
    atlas: Atlas,
    side: str = "inner",
    angles: int = 48,
    points: int = 120,
    ax: Axes | None = None,
) -> Axes:
    """The components of the slices over the angle, coloured by class: a line joins components of
    neighbouring angles that overlap. The area of a dot is the component's."""
    from scipy import ndimage

    _flat(what)
    ax = _axes(ax)
    xs, ys = _raster(what, points)
    thetas = np.arange(angles) * (2 * np.pi / angles) - np.pi
    pictures, labels = [], []
    for theta in thetas:
        picture = classes_at(atlas, xs, ys, float(theta), side)
        label = np.zeros(picture.shape, dtype=int)
        for number in np.unique(picture[picture != NO_CLASS]):
            part, _ = ndimage.label(picture == number, structure=np.ones((3, 3)))
            label[part > 0] = part[part > 0] + label.max()
        pictures.append(picture)
        labels.append(label)
    for k, theta in enumerate(thetas):
        after = (k + 1) % angles
        pairs = np.unique(np.c_[labels[k].ravel(), labels[after].ravel()], axis=0)
        centre = {i: _middle(labels[k], i) for i in np.unique(labels[k]) if i}
        beyond = {i: _middle(labels[after], i) for i in np.unique(labels[after]) if i}
        for i, j in pairs:
            if i and j and pictures[k][labels[k] == i][0] == pictures[after][labels[after] == j][0]:
                ax.plot(
                    [theta, theta + 2 * np.pi / angles],
                    [ys[centre[i]], ys[beyond[j]]],
                    color="#b0b0b0",
                    linewidth=0.8,
                    zorder=1,
                )
        for i, at in centre.items():
            which = labels[k] == i
            colour = _colours(pictures[k][which][:1])[0]
            ax.scatter(
                [theta],
                [ys[at]],
                s=6 + 400 * which.mean(),
                color=[colour],
                edgecolors="black",
                linewidths=0.4,
                zorder=2,
            )
    ax.set_xlabel("theta / rad")
    ax.set_ylabel("middle of the component, y / m")
    ax.set_title(f"components of the {side} slices, coloured by class", fontsize=9)
    return ax


def _middle(label: NDArray[Any], number: int) -> int:
    return int(np.nonzero(label == number)[0].mean())
