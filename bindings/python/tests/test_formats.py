"""Files are read as they were written, by libcage and by others; what is wrong in them is said."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from libcage import Balls, InputError, KindError, Scene, Verdict, read, read_links, write

ROWS = np.array([[0.1, -2e-17, 1 / 3, 0.25], [1e6, np.pi, -0.0, 5e-324]])


@pytest.mark.parametrize("suffix", [".xyzr", ".npy", ".json"])
@pytest.mark.parametrize("kind", ["inner", "outer", "exact", "unknown"])
@pytest.mark.parametrize("dim", [2, 3])
def test_what_is_written_comes_back_to_the_last_bit(tmp_path, suffix, kind, dim):
    balls = Balls(ROWS[:, 4 - dim - 1 :], kind)
    write(tmp_path / f"b{suffix}", balls)
    again = read(tmp_path / f"b{suffix}")
    assert again.rows.tobytes() == balls.rows.tobytes()
    assert again.kind == ("unknown" if suffix == ".npy" else kind)
    for said in ("inner", "outer", "exact"):
        if again.kind in ("unknown", said):
            assert read(tmp_path / f"b{suffix}", kind=said).kind == said
        else:  # the file's own words are not overruled in passing
            with pytest.raises(KindError, match="as_kind"):
                read(tmp_path / f"b{suffix}", kind=said)
            assert read(tmp_path / f"b{suffix}").as_kind(said).kind == said


def test_c_header_is_on_the_safe_side_and_compiles(tmp_path):
    balls = Balls([[0.1, 0.2, 0.3, 0.05], [0.5, 0, 0.25, 0.125]], "exact")
    unit = 2.0**-16
    write(tmp_path / "part.h", balls, unit=unit, name="part")
    program = (
        '#include <stdio.h>\n#include "part.h"\n'
        "int main(void) { for (int i = 0; i < 2; i++) printf("
        '"%d %d %d %d %d %d %d %d\\n", part_inner[i].x, part_inner[i].y, '
        "part_inner[i].z, part_inner[i].r, "
        "part_outer[i].x, part_outer[i].y, part_outer[i].z, part_outer[i].r); return 0; }\n"
    )
    (tmp_path / "main.c").write_text(program)
    (tmp_path / "cage.h").write_text("typedef struct cage_ball { int x, y, z, r; } cage_ball;\n")
    subprocess.run(
        ["cc", "-std=c99", "-I", str(tmp_path), "main.c", "-o", "main"], cwd=tmp_path, check=True
    )
    printed = subprocess.run(
        [str(tmp_path / "main")], capture_output=True, text=True, check=True
    ).stdout
    for line, row in zip(printed.splitlines(), balls.rows):
        numbers = np.array([int(word) for word in line.split()]) * unit
        inner, outer = numbers[:4], numbers[4:]
        assert np.linalg.norm(inner[:3] - row[:3]) + inner[3] <= row[3]
        assert np.linalg.norm(outer[:3] - row[:3]) + row[3] <= outer[3]
        assert outer[3] - inner[3] < 5 * unit
    write(tmp_path / "part.h", balls.as_kind("inner"), unit=unit)
    assert "_outer" not in (tmp_path / "part.h").read_text()
    with pytest.raises(InputError):
        write(tmp_path / "part.h", balls.as_kind("unknown"))
    with pytest.raises(InputError):
        write(tmp_path / "part.h", balls, unit=2.0**-40)
    with pytest.raises(InputError):
        write(tmp_path / "part.h", balls, name="a b")


CUROBO = """
robot_cfg:
  kinematics:
    collision_spheres:
      hand:
        - center: [0.0, 0.01, 0.02]
          radius: 0.03
        - {"center": [1, 2, 3], "radius": -10.0}
      attached_object:
        - center: [0, 0, 0]
          radius: -10
    collision_sphere_buffer: 0.005
"""
URDF = """<robot name="r"><link name="base"/><link name="arm">
<collision><origin xyz="1 2 3" rpy="0 0 0"/><geometry><sphere radius="0.5"/></geometry></collision>
<collision><geometry><sphere radius="0.25"/></geometry></collision></link></robot>"""
SRDF = """<robot name="r"><link_sphere_approximation link="off"><sphere center="0 0 0" radius="0"/>
</link_sphere_approximation><link_sphere_approximation link="arm">
<sphere center="1.0 2.0 3.0" radius="0.5"/>
</link_sphere_approximation></robot>"""
FOAM = [
    {"mean": 1, "best": 1, "worst": 1, "spheres": [{"origin": [9, 9, 9], "radius": 9}]},
    {
        "mean": 0,
        "best": 0,
        "worst": 0,
        "spheres": [{"origin": [1, 2, 3], "radius": 0.5}, {"origin": [0, 0, 0], "radius": 0.25}],
    },
]
SPH = "3 2\n0 0 0 9\n1 0 0 4\n-1 0 0 5\n1 1 0 2\n0 0 0 -1\n0 0 0 0\n0 0 0 -1\nmean 0.1\n"


def test_cuRobo(tmp_path):
    (tmp_path / "a.yml").write_text(CUROBO)
    links = read_links(tmp_path / "a.yml")
    assert (
        links["hand"].rows.tolist() == [[0.0, 0.01, 0.02, 0.03]]
        and len(links["attached_object"]) == 0
    )
    (tmp_path / "b.yml").write_text("robot_cfg: {kinematics: {collision_spheres: a.yml}}")
    assert read(tmp_path / "b.yml", link="hand").rows.tolist() == links["hand"].rows.tolist()
    with pytest.raises(InputError, match="link"):
        read(tmp_path / "a.yml")


def test_the_formats_of_others(tmp_path):
    wanted = [[1, 2, 3, 0.5], [0, 0, 0, 0.25]]
    for name, text in (
        ("a.urdf", URDF),
        ("a.json", json.dumps(FOAM)),
        ("b.json", json.dumps(FOAM[1])),
        ("c.json", json.dumps({"link": FOAM[1]})),
    ):
        (tmp_path / name).write_text(text)
        balls = read(tmp_path / name)
        assert balls.rows.tolist() == wanted and balls.kind == "unknown", name
    (tmp_path / "a.srdf").write_text(SRDF)
    assert read(tmp_path / "a.srdf", link="arm").rows.tolist() == wanted[:1]
    (tmp_path / "a.sph").write_text(SPH)  # the node at -1 has no children: it is a leaf
    assert read(tmp_path / "a.sph").rows.tolist() == [[-1, 0, 0, 5], [1, 1, 0, 2]]


def test_a_robot_s_published_balls_prove_no_cage(tmp_path):
    (tmp_path / "a.urdf").write_text(URDF)
    scene = Scene([[0, 0, 0, 0.1]], read(tmp_path / "a.urdf"))
    with pytest.raises(KindError):
        scene.prove(np.eye(4))
    outer = Scene([[0, 0, 0, 0.1]], read(tmp_path / "a.urdf", kind="outer"))
    pose = np.eye(4)
    pose[0, 3] = 3
    assert outer.prove(pose).verdict is Verdict.FREE


@pytest.mark.parametrize(
    "name,text",
    [
        ("a.xyzr", "0 0\n"),
        ("a.xyzr", "0 0 0 1\n0 0 1\n"),
        ("a.xyzr", "0 0 x\n"),
        ("a.xyzr", "0 0 nan\n"),
        ("a.xyzr", "0 0 -1\n"),
        ("a.json", "[1]"),
        ("a.json", '[{"origin": [0, 0], "radius": 1}]'),
        ("a.json", '[{"origin": [0, 0, 0]}]'),
        ("a.yml", "a: 1"),
        ("a.urdf", "<robot"),
        ("a.urdf", URDF.replace('<sphere radius="0.25"/>', '<box size="1 1 1"/>')),
        ("a.urdf", URDF.replace("1 2 3", "1 2")),
        ("a.srdf", "<robot/>"),
        ("a.sph", "3 2\n0 0 0 1\n"),
        ("a.sph", "x"),
        ("a.sph", ""),
        ("a.foo", ""),
    ],
)
def test_bad_files_are_refused(tmp_path, name, text):
    (tmp_path / name).write_text(text)
    with pytest.raises(InputError):
        read(tmp_path / name)


def test_npy_is_not_unpickled(tmp_path):
    np.save(tmp_path / "a.npy", np.array([[{}]], dtype=object), allow_pickle=True)
    with pytest.raises(ValueError):
        read(tmp_path / "a.npy")


# ---- the command line ----------------------------------------------------------------------------


def command(*arguments):
    return subprocess.run(
        [sys.executable, "-m", "libcage", *map(str, arguments)],
        capture_output=True,
        text=True,
        timeout=120,
    )


def test_command_line(tmp_path):
    write(tmp_path / "disc.xyzr", Balls([[0, 0, 0.04]], "exact"))
    far = [[0.07, 0, 0.02], [0, 0.07, 0.02], [-0.07, 0, 0.02], [0, -0.07, 0.02]]
    write(tmp_path / "a.xyzr", Balls(far[:2], "exact"))
    write(tmp_path / "b.xyzr", Balls(far[2:], "exact"))
    write(tmp_path / "b_outer.xyzr", Balls(far[2:], "outer"))
    files = (tmp_path / "disc.xyzr", tmp_path / "a.xyzr")
    done = command(*files, tmp_path / "b.xyzr", "--start", "0,0,0", "--quiet")
    assert (done.stdout, done.returncode) == ("CAGED\n", 0), done.stderr
    done = command(
        *files,
        "--start",
        "0,0,0",
        "--quiet",
        "--png",
        tmp_path / "p.png",
        "--html",
        tmp_path / "p.html",
    )
    assert (done.stdout, done.returncode) == ("FREE\n", 0), done.stderr
    assert (tmp_path / "p.png").read_bytes()[:4] == b"\x89PNG" and (
        tmp_path / "p.html"
    ).stat().st_size > 1_000_000
    done = command(
        *files,
        tmp_path / "b.xyzr",
        "--start",
        "0,0,0",
        "--goal",
        "0.5,0,0",
        "--json",
        "--margin",
        "6",
    )
    raw = json.loads(done.stdout)
    assert raw["verdict"] == "DISCONNECTED" and raw["margin"]["closed"] > 0
    assert command(*files, tmp_path / "b_outer.xyzr", "--start", "0,0,0").returncode == 2
    assert command(*files, "--start", "0,0").returncode == 2
    assert command(tmp_path / "none.xyzr", tmp_path / "a.xyzr", "--start", "0,0,0").returncode == 2


def test_command_line_with_meshes(tmp_path):
    import trimesh

    trimesh.creation.icosphere(2, 10.0).export(tmp_path / "ball.stl")
    frame = trimesh.creation.box((60, 60, 60))
    hollow = trimesh.creation.box((30, 30, 30))
    hollow.invert()
    trimesh.util.concatenate([frame, hollow]).export(tmp_path / "box.stl")
    options = [
        "--scale",
        "0.001",
        "--balls",
        "250",
        "--outer-tolerance",
        "0.004",
        "--start",
        "0,0,0",
        "--html",
        tmp_path / "out.html",
    ]
    done = command(tmp_path / "ball.stl", tmp_path / "box.stl", *options)
    assert done.stdout.startswith("CAGED"), done.stdout + done.stderr
    assert (tmp_path / "out.html").stat().st_size > 1_000_000
    far = command(
        tmp_path / "ball.stl",
        tmp_path / "box.stl",
        "--scale",
        "0.001",
        "--start",
        "0.2,0,0",
        "--quiet",
    )
    assert far.stdout == "FREE\n", far.stderr
    (tmp_path / "open.stl").write_bytes(Path(tmp_path / "box.stl").read_bytes())
    broken = trimesh.creation.box((1, 1, 1))
    broken.update_faces(np.arange(len(broken.faces)) > 0)
    broken.export(tmp_path / "open.stl")
    done = command(tmp_path / "ball.stl", tmp_path / "open.stl", "--start", "0,0,0")
    assert done.returncode == 2 and "closed surface" in done.stderr
