"""An interactive picture in one self-contained HTML file, the path animated, with plotly."""

from __future__ import annotations

import os
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .balls import Balls
from .extras import extra
from .plot import placed, shown
from .poses import Pose, PoseLike, Poses, pose as read_pose
from .result import Path, Result
from .scene import Scene

OBSTACLE, START, GOAL = "#9a9a9a", "#2a6fbb", "#e07b00"


def _sphere(fine: int) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """A unit sphere as points and triangles."""
    theta, phi = (
        np.linspace(0, np.pi, fine + 1),
        np.linspace(0, 2 * np.pi, 2 * fine, endpoint=False),
    )
    t, p = np.meshgrid(theta, phi, indexing="ij")
    points = np.c_[
        (np.sin(t) * np.cos(p)).ravel(), (np.sin(t) * np.sin(p)).ravel(), np.cos(t).ravel()
    ]
    i, j = np.meshgrid(np.arange(fine), np.arange(2 * fine), indexing="ij")
    a, b = (i * 2 * fine + j).ravel(), (i * 2 * fine + (j + 1) % (2 * fine)).ravel()
    return points, np.concatenate([np.c_[a, a + 2 * fine, b], np.c_[b, a + 2 * fine, b + 2 * fine]])


def _mesh(
    rows: NDArray[np.float64], colour: str, name: str, opacity: float = 1.0
) -> dict[str, Any]:
    """All balls as one mesh of plotly; coarser where there are many."""
    points, faces = _sphere(10 if len(rows) < 16 else 7 if len(rows) < 100 else 5)
    x = (rows[:, None, :3] + rows[:, None, 3:] * points[None]).reshape(-1, 3)
    f = (faces[None] + len(points) * np.arange(len(rows))[:, None, None]).reshape(-1, 3)
    x = x.astype(np.float32)  # half the bytes in the file
    return {
        "type": "mesh3d",
        "x": x[:, 0],
        "y": x[:, 1],
        "z": x[:, 2],
        "i": f[:, 0],
        "j": f[:, 1],
        "k": f[:, 2],
        "color": colour,
        "opacity": opacity,
        "name": name,
        "showlegend": True,
        "flatshading": False,
        "hoverinfo": "name",
        "lighting": {"ambient": 0.7, "diffuse": 0.7, "specular": 0.15, "roughness": 0.7},
    }


def _discs(
    rows: NDArray[np.float64], colour: str, name: str, opacity: float = 1.0
) -> dict[str, Any]:
    """All discs as one trace of polygons."""
    t = np.linspace(0, 2 * np.pi, 41)
    x = rows[:, None, 0] + rows[:, None, 2] * np.cos(t)
    y = rows[:, None, 1] + rows[:, None, 2] * np.sin(t)
    gap = np.full((len(rows), 1), np.nan)
    return {
        "type": "scatter",
        "x": np.hstack([x, gap]).ravel(),
        "y": np.hstack([y, gap]).ravel(),
        "mode": "lines",
        "fill": "toself",
        "fillcolor": colour,
        "opacity": opacity,
        "name": name,
        "line": {"width": 0, "color": colour},
        "hoverinfo": "name",
    }


def figure(
    scene: Scene,
    answer: Result | None = None,
    start: PoseLike | None = None,
    goal: PoseLike | None = None,
    frames: int = 40,
) -> Any:
    """A plotly figure: obstacles, object at start and goal, and the path of `answer` as an
    animation."""
    with extra("pictures"):
        from plotly import graph_objects

    draw = _mesh if scene.dim == 3 else _discs
    part, walls = shown(scene, "object"), shown(scene, "obstacles")
    first = (
        answer.start
        if answer is not None
        else None
        if start is None
        else read_pose(start, scene.dim)
    )
    last = (
        answer.goal if answer is not None else None if goal is None else read_pose(goal, scene.dim)
    )
    traces = []
    if first is not None:
        traces.append(draw(_at(part, first), START, "object"))
    traces.append(draw(walls.rows, OBSTACLE, "obstacles", 0.35 if scene.dim == 3 else 1.0))
    if last is not None:
        traces.append(draw(_at(part, last), GOAL, "goal", 0.5))
    made = graph_objects.Figure(data=traces)
    title = (
        "libcage"
        if answer is None
        else f"{answer.verdict}: {answer.reason}<br><sub>{answer.about}</sub>"
    )
    made.update_layout(title={"text": title}, margin={"l": 10, "r": 10, "b": 10, "t": 70})
    if scene.dim == 3:
        made.update_layout(scene={"aspectmode": "data"})
    else:
        made.update_yaxes(scaleanchor="x", scaleratio=1)
    if answer is not None and answer.path is not None:
        _animate(made, scene, part, answer.path, frames, draw)
    return made


def animation(scene: Scene, path: Path, frames: int = 40) -> Any:
    """A plotly figure of a path alone, smoothed or not."""
    made = figure(scene, start=path.start, goal=path.goal)
    draw = _mesh if scene.dim == 3 else _discs
    _animate(made, scene, shown(scene, "object"), path, frames, draw)
    return made


def _at(part: Balls, pose: Pose) -> NDArray[np.float64]:
    return placed(part, pose)


def _animate(made: Any, scene: Scene, part: Balls, path: Path, frames: int, draw: Any) -> None:
    """The object runs along the path; a slider, a button. Axes are held to all of it."""
    poses = path.frames(frames)
    if path.curve:  # it has many poses, evenly apart in time
        some = np.unique(np.linspace(0, len(poses) - 1, frames).astype(int))
        poses = Poses(poses.x[some], poses.wxyz[some])
    rows = [placed(part, poses[i]) for i in range(len(poses))]
    axes = "xyz"[: scene.dim]
    keep = ("type", *axes)
    made.frames = [
        {
            "name": str(i),
            "traces": [0],
            "data": [
                {key: value for key, value in draw(row, START, "object").items() if key in keep}
            ],
        }
        for i, row in enumerate(rows)
    ]
    line = poses.x + poses.matrices()[:, : scene.dim, : scene.dim] @ np.asarray(path.pivot)
    trace = {
        "type": "scatter3d" if scene.dim == 3 else "scatter",
        "mode": "lines",
        "name": "path of the pivot",
        "line": {"color": "#222222", "width": 3 if scene.dim == 3 else 1},
        **{axis: line[:, k] for k, axis in enumerate(axes)},
    }
    made.add_trace(trace)
    every = np.concatenate([shown(scene, "obstacles").rows, *rows])
    low = (every[:, :-1] - every[:, -1:]).min(axis=0)
    high = (every[:, :-1] + every[:, -1:]).max(axis=0)
    spans = {
        f"{axis}axis": {"range": [float(low[k]), float(high[k])]} for k, axis in enumerate(axes)
    }
    made.update_layout(scene=spans) if scene.dim == 3 else made.update_layout(spans)
    play = {
        "label": "play",
        "method": "animate",
        "args": [
            None,
            {
                "frame": {"duration": 60, "redraw": True},
                "fromcurrent": True,
                "transition": {"duration": 0},
            },
        ],
    }
    steps = [
        {
            "label": str(i),
            "method": "animate",
            "args": [
                [str(i)],
                {
                    "mode": "immediate",
                    "frame": {"duration": 0, "redraw": True},
                    "transition": {"duration": 0},
                },
            ],
        }
        for i in range(len(rows))
    ]
    made.update_layout(
        updatemenus=[
            {
                "type": "buttons",
                "buttons": [play],
                "x": 0.02,
                "y": 0.02,
                "xanchor": "left",
                "yanchor": "bottom",
            }
        ],
        sliders=[{"steps": steps, "currentvalue": {"prefix": "frame "}, "len": 0.8, "x": 0.15}],
    )


def write_html(
    path: str | os.PathLike[str],
    scene: Scene,
    answer: Result | None = None,
    start: PoseLike | None = None,
    goal: PoseLike | None = None,
    frames: int = 40,
) -> None:
    """The figure as one HTML file that needs no network: plotly's script is in it."""
    figure(scene, answer, start, goal, frames).write_html(
        os.fspath(path), include_plotlyjs=True, full_html=True, auto_play=False
    )
