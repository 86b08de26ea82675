"""What is wrong is said: limits, packages that are missing, the command line, rounded poses."""

import itertools
import math
import subprocess
import sys

import numpy as np
import pytest
import shapely
import trimesh
from shapely.geometry import Point, box

import libcage
from libcage import Balls, InputError, Question, Scene, fit, prove_many, verify_cover, write
from libcage.__main__ import main
from libcage.poses import distance, from_wxyz
from libcage.shapes import cover
from libcage.shapes.solids import boundary

FINGERS = [[0.07, 0, 0.02], [0, 0.07, 0.02], [-0.07, 0, 0.02], [0, -0.07, 0.02]]
DISC = [[0, 0, 0.04]]
NAN = float("nan")


# ---- limits --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "options,said",
    [
        ({"max_cells": 0}, "max_cells.* 2 or more"),
        ({"max_cells": 1}, "max_cells.* 2 or more"),
        ({"max_cells": -1}, "max_cells"),
        ({"max_cells": 13, "start_level": 2}, "max_cells.* 14 or more.* level 2"),
        ({"max_level": -1}, "max_level: 0 to 14"),
        ({"max_level": 99}, "max_level: 0 to 14"),
        ({"max_level": 3, "start_level": 5}, "start_level 5 is more than max_level 3"),
        ({"start_level": 13}, "start_level 13 is more than max_level 12"),
    ],
)
def test_limits_that_cannot_be(options, said):
    scene = Scene(DISC, FINGERS)
    asks = [scene.prove, lambda start, **o: Question(scene, start, None, o).key()]
    if "start_level" not in options:
        asks.append(scene.margin)
    for ask in asks:
        with pytest.raises(InputError, match=said) as caught:
            ask((0, 0, 0), **options)
        assert "report" not in str(caught.value)


@pytest.mark.parametrize("level", [0, 1, 2, 3])
@pytest.mark.parametrize("dim", [2, 3])
def test_the_least_cells_are_those_that_the_library_takes(dim, level):
    scene = Scene(np.eye(1, dim + 1, dim) * 0.04, np.eye(1, dim + 1, 0) + np.eye(1, dim + 1, dim))
    least = sum((2 if dim == 2 else 4) * (2 if dim == 2 else 8) ** k for k in range(level + 1))
    start = (-9, 0, 0) if dim == 2 else from_wxyz([-9, 0, 0], [1, 0, 0, 0])
    scene.prove(start, start_level=level, max_cells=least)
    with pytest.raises(InputError, match=f"{least} or more"):
        scene.prove(start, start_level=level, max_cells=least - 1)


def test_numbers_that_are_none():
    scene, square = Scene(DISC, FINGERS), box(0, 0, 1, 1)
    for bad in (NAN, "x", None, [1, 2]):
        with pytest.raises(InputError, match="far"):
            scene.atlas(2, far=bad)
        with pytest.raises(InputError, match="count"):
            fit(square, count=bad)
        with pytest.raises(InputError, match="tolerance"):
            fit(square, tolerance=bad)
        with pytest.raises(InputError, match="seed"):
            fit(square, seed=bad)
        if bad is not None:
            with pytest.raises(InputError, match="threads"):
                scene.atlas(2, threads=bad)
            with pytest.raises(InputError, match="outer_tolerance"):
                fit(square, outer_tolerance=bad)
            with pytest.raises(InputError, match="leaf"):
                verify_cover(square, [[0.5, 0.5, 1]], leaf=bad)
            with pytest.raises(InputError, match="unit"):
                Scene(DISC, FINGERS, unit=bad)
    with pytest.raises(InputError, match="seed"):
        fit(square, seed=-1)
    with pytest.raises(InputError, match="level: .*2.7"):
        scene.atlas(2.7)
    with pytest.raises(InputError, match="level 8 are more than the budget of 100"):
        scene.atlas(8, budget=100)


# ---- packages ------------------------------------------------------------------------------------

MISSING = """
import sys
sys.modules[{module!r}] = None
import libcage, trimesh
from shapely.geometry import box
scene = libcage.Scene([[0, 0, 0.04]], [[0.07, 0, 0.02]])
try:
    {work}
    print("not missed")
except libcage.MissingError as error:
    assert isinstance(error, ImportError)
    print(error)
"""


@pytest.mark.parametrize(
    "module,work,said",
    [
        ("igl", "libcage.fit(trimesh.creation.box((1, 1, 1)))", ("libigl", "shapes")),
        ("yaml", "libcage.read('a.yml')", ("PyYAML", "formats")),
        ("plotly", "libcage.view.figure(scene)", ("plotly", "pictures")),
        ("matplotlib", "libcage.plot.scene(scene)", ("matplotlib", "pictures")),
        ("ompl", "libcage.planner.race_ompl(None, scene, (0, 0, 0))", ("ompl", "planner")),
    ],
)
def test_a_package_that_is_missing_is_named_with_its_extra(tmp_path, module, work, said):
    (tmp_path / "a.yml").write_text("collision_spheres: {}\n")
    program = MISSING.format(module=module, work="import libcage.plot, libcage.view, "
                             "libcage.planner; " + work)
    done = subprocess.run(
        [sys.executable, "-c", program], cwd=tmp_path, capture_output=True, text=True, timeout=60
    )
    assert done.stdout == (
        f"{said[0]} is not installed: pip install 'libcage[{said[1]}]'\n"
    ), done.stderr[-800:]


def test_shapely_that_is_missing_is_named(monkeypatch):
    monkeypatch.setitem(sys.modules, "shapely", None)
    with pytest.raises(libcage.MissingError, match=r"libcage\[shapes\]"):
        fit(box(0, 0, 1, 1))


def test_a_mesh_without_trimesh_on_the_command_line(tmp_path, monkeypatch, capsys):
    (tmp_path / "a.stl").write_bytes(b"")
    monkeypatch.setitem(sys.modules, "trimesh", None)
    assert main([str(tmp_path / "a.stl"), str(tmp_path / "a.stl"), "--start", "0,0,0"]) == 2
    assert capsys.readouterr().err == (
        "libcage: trimesh is not installed: pip install 'libcage[shapes]'\n"
    )


# ---- the command line ----------------------------------------------------------------------------


@pytest.fixture
def files(tmp_path):
    for name, rows, kind in (
        ("part", DISC, "exact"),
        ("walls", FINGERS, "exact"),
        ("outer", FINGERS, "outer"),
    ):
        write(tmp_path / f"{name}.xyzr", Balls(np.array(rows), kind))
    return {name: str(tmp_path / f"{name}.xyzr") for name in ("part", "walls", "outer")}


@pytest.mark.parametrize("value", ["-0.001,0,0", "-.001,0,0", "-1e-3,0,-0.5", "-0,0,0"])
def test_poses_that_begin_with_a_minus_sign(files, capsys, value):
    for words in (["--start", value], [f"--start={value}"], ["--sta", value]):
        for goal in ([], ["--goal", value]):
            assert main([files["part"], files["walls"], *words, *goal, "--quiet"]) == 0
            assert capsys.readouterr().out == ("CONNECTED\n" if goal else "CAGED\n")


def test_other_words_with_a_minus_sign(files, capsys):
    asked = [files["part"], files["walls"], "--start", "0,0,0"]
    for more, said in (
        (["--start", "-x,0,0"], "expected one argument"),
        (["--start", "-nan,0,0"], "NaN"),
        (["--max-cells", "-1e3"], "--max-cells"),
        (["--quiet", "-1,0,0"], "--quiet"),
    ):
        try:
            assert main([*asked, *more]) == 2
        except SystemExit as error:
            assert error.code == 2
        assert said in capsys.readouterr().err, more


@pytest.mark.parametrize("value", ["-1", "0", "nan", "inf", "-inf", "-1e-3"])
def test_a_scale_is_positive_whatever_the_files_are(files, capsys, value):
    done = main([files["part"], files["walls"], "--start", "0,0,0", "--scale", value])
    assert done == 2
    assert "a positive number is wanted" in capsys.readouterr().err


def test_a_quiet_answer_about_balls_only_says_so(files, capsys):
    asked = [files["part"], files["outer"], "--start", "0,0,0", "--quiet", "--side", "inner"]
    assert main(asked) == 2
    capsys.readouterr()
    assert main([*asked, "--insist"]) == 0
    said = capsys.readouterr()
    assert said.out == "CAGED\n" and said.err.startswith("libcage: about: the balls only, not")


@pytest.mark.parametrize("name", ["bé", "é", "ａ", "a-b", "1a", "a b", "", "a\n", "a;", "a²"])
def test_names_that_are_not_of_c(tmp_path, name):
    with pytest.raises(InputError, match="no name in C"):
        write(tmp_path / "a.h", Balls(DISC), name=name)
    assert not (tmp_path / "a.h").exists()


# ---- poses ---------------------------------------------------------------------------------------


def test_a_pose_that_was_rounded_far_is_told():
    coarse = Scene(DISC, [*FINGERS, [1e5, 0, 1]])
    asked, goal = (0.00011, 0, 0), (0.00012, 0, 0)
    answer = coarse.prove(asked, goal)
    assert "start: asked (0.00011, 0, 0 rad), proved (0, 0, 0 rad)" in str(answer)
    assert "0.00011 m" in str(answer) and "goal: asked (0.00012" in str(answer)
    assert "asked" not in str(coarse.prove((0, 0, 1)))
    fine = Scene(DISC, FINGERS).prove(asked, goal)
    assert "asked" not in str(fine) and fine.asked_start.x == (0.00011, 0.0)
    again = prove_many([Question(coarse, asked, goal)])[0]
    assert str(again) == str(answer) and again == answer
    assert again.to_bytes() == answer.to_bytes()


def test_distances_of_poses():
    for angle in (0, 1e-9, 0.5, 3, math.pi):
        one = from_wxyz([0, 0, 0], [math.cos(angle / 2), 0, math.sin(angle / 2), 0])
        other = from_wxyz([3, 0, 4], [-1, 0, 0, 0])
        away, turn = distance(one, other)
        assert away == 5 and turn == pytest.approx(angle, rel=1e-6, abs=1e-12)


# ---- covers --------------------------------------------------------------------------------------


def shell():
    inside = trimesh.creation.box((0.19, 0.19, 0.19))
    inside.invert()
    return trimesh.util.concatenate([trimesh.creation.box((0.2, 0.2, 0.2)), inside])


SOLIDS = {
    "shell": (shell(), 0.05),
    "ball": (trimesh.creation.icosphere(2), 0.2),
    "ring": (Point(0, 0).buffer(1).difference(Point(0.1, 0).buffer(0.8)), 0.05),
    "two": (shapely.MultiPolygon([box(0, 0, 1, 1), box(1.1, 0, 2, 1)]), 0.04),
}


@pytest.mark.parametrize("name", SOLIDS)
def test_cells_of_a_cover_are_decided_as_one_by_one(name):
    solid, leaf = SOLIDS[name]
    edge = boundary(solid)
    cells, asked = cover.root(edge, 0), 0
    while cells.half > leaf / 2:
        cells = cover._children(cells)[0] if len(cells.centre) < 512 else None
        if cells is None:
            break
        met = set(cover._meeting(edge, cells)[0].tolist())
        wanted = [
            i in met or bool(cells.inside[i]) or not edge.surely_outside(centre)
            for i, centre in enumerate(cells.centre)
        ]
        asked += len(wanted) - len(met)
        centres = cells.centre[wanted]
        cells = cover._without_outside(edge, cells)
        assert np.array_equal(cells.centre, centres)
    assert asked > 50


@pytest.mark.parametrize("name", SOLIDS)
def test_a_cover_is_completed_as_by_trying_all_balls(name):
    solid, tolerance = SOLIDS[name]
    edge = boundary(solid)
    none = np.zeros((0, edge.dim + 1))
    made = cover.complete(edge, none, tolerance)
    centres, half = cover.uncovered(edge, none, 0.25 * tolerance)
    wanted = np.zeros((len(centres), edge.dim + 1))
    wanted[:, -1], count = (tolerance - 0.25 * tolerance) * (1 - 1e-9), 0
    for centre in centres[:3000]:
        if not cover.held(centre, half, wanted[:count]).any():
            wanted[count, :-1] = centre
            count += 1
    assert count > 20 and np.array_equal(made[:count], wanted[:count])


def test_a_cover_asks_for_few_windings(monkeypatch):
    """A thin shell took more than a minute: a winding for each of 100 000 cells."""
    edge, asked = boundary(shell()), []
    kind = type(edge)
    real = kind.surely_outside
    monkeypatch.setattr(
        kind, "surely_outside", lambda self, point: asked.append(1) or real(self, point)
    )
    cover.complete(edge, np.zeros((0, 4)), 0.02)
    assert 0 < len(asked) < 2000


def test_groups_of_cells_share_faces():
    rng = np.random.default_rng(0)
    for dim, half in itertools.product((2, 3), (0.5, 2.0**-40)):
        places = np.unique(rng.integers(0, 6, (60, dim)), axis=0)
        places[-3:] += 1 << 20  # far off: the cells of a batch may lie anywhere
        groups = cover._beside(places * 2.0 * half, half)
        assert sorted(np.concatenate(groups).tolist()) == list(range(len(places)))
        label = {tuple(places[i]): g for g, group in enumerate(groups) for i in group}
        for group in groups:  # each is connected, and none touches another by a face
            todo, seen = [tuple(places[group[0]])], set()
            while todo:
                cell = todo.pop()
                if cell in seen:
                    continue
                seen.add(cell)
                for axis, way in itertools.product(range(dim), (-1, 1)):
                    beside = tuple(v + way * (k == axis) for k, v in enumerate(cell))
                    if beside in label:
                        assert label[beside] == label[cell]
                        todo.append(beside)
            assert len(seen) == len(group)
    assert cover._beside(np.zeros((0, 3)), 1.0) == []
