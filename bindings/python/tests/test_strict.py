"""Files are read as they are or not at all: never as another set, never with a traceback."""

import io
import json
import subprocess
import sys
import time

import numpy as np
import pytest
import trimesh

from libcage import Balls, InputError, KindError, read, read_links, verify_balls, write
from libcage.__main__ import main, parser, read_mesh, read_solid

OWN = {"format": "libcage balls", "dim": 2, "kind": "inner", "balls": [[0, 0, 1], [5, 0, 1]]}


def own(**other):
    return json.dumps({**OWN, **other})


def spheres(*rows, centre="origin"):
    return [{centre: list(row[:3]), "radius": row[3]} for row in rows]


def urdf(inside, link='<link name="a">'):
    return f'<robot name="r">{link}{inside}</link></robot>'


def shape(inside):
    return urdf(f"<collision><geometry>{inside}</geometry></collision>")


POINT = '<sphere center="0 0 0" radius="0"/>'
BALL = '<sphere radius="1"/>'
COLLISION = f"<collision><geometry>{BALL}</geometry></collision>"
LINK = f'<link name="a">{COLLISION}</link>'


def srdf(*links):
    return "<robot>" + "".join(
        f'<link_sphere_approximation link="{name}">{inside}</link_sphere_approximation>'
        for name, inside in links
    ) + "</robot>"


def curobo(text):
    return f"collision_spheres:\n  a:\n  - {{center: [0, 0, 0], radius: 1}}\n{text}"


def npy(array, **options):
    file = io.BytesIO()
    np.save(file, array, **options)
    return file.getvalue()


ROW = npy(np.array([[0.0, 0, 1]]))
ARCHIVE = io.BytesIO()
np.savez(ARCHIVE, a=np.array([[0.0, 0, 1]]))

BAD = {
    "own JSON, rows of another dimension": ("a.json", own(dim=3)),
    "the other way round": ("b.json", own(balls=[[0, 0, 0, 1]] * 3)),
    "dim -3": ("a.json", own(dim=-3)),
    "dim true": ("a.json", own(dim=True)),
    "dim 2.0": ("a.json", own(dim=2.0)),
    "kind that is none": ("a.json", own(kind="bogus")),
    "kind null": ("a.json", own(kind=None)),
    "no kind": ("a.json", json.dumps({k: v for k, v in OWN.items() if k != "kind"})),
    "more than is known": ("a.json", own(offset=[1, 0])),
    "text and true": ("a.json", own(balls=[["0.1", 0, True]])),
    "true": ("a.json", own(balls=[[0.1, 0, True]])),
    "ragged": ("a.json", own(balls=[[0, 0, 1], [0, 1]])),
    "no rows": ("a.json", own(balls=5)),
    "NaN": ("a.json", own(balls=[[0, 0, float("nan")]])),
    "infinite": ("a.json", own().replace("5", "1e400")),
    "no double": ("a.json", own(balls=[[2**53 + 1, 0, 1]])),
    "huge": ("a.json", own(balls=[[10**400, 0, 1]])),
    "a key twice": ("a.json", own().replace('"dim"', '"kind": "exact", "dim"')),
    "a link twice": ("a.json", '{"a": %s, "a": %s}' % ((json.dumps(spheres((0, 0, 0, 1))),) * 2)),
    "cut off": ("a.json", own()[:-3]),
    "empty": ("a.json", ""),
    "deep": ("a.json", "[" * 100000),
    "radius true": ("a.json", json.dumps(spheres((0, 0, 0, True)))),
    "radius hex": ("a.json", json.dumps(spheres((0, 0, 0, "0x10")))),
    "finest level empty": (
        "a.json",
        json.dumps([{"spheres": spheres((0, 0, 0, 1))}, {"spheres": []}]),
    ),
    "two centres": ("a.json", '[{"origin": [0, 0, 0], "center": [1, 1, 1], "radius": 1}]'),
    "an offset": ("a.json", '[{"origin": [0, 0, 0], "offset": [1, 1, 1], "radius": 1}]'),
    "no spheres": ("a.json", '{"a": {"b": 1}}'),
    "bytes": ("a.json", b"\xff\xfe\x00"),
    "YAML, a link twice": ("a.yml", curobo("  a:\n  - {center: [5, 0, 0], radius: 1}\n")),
    "1 and '1'": ("a.yml", "collision_spheres: {1: [], '1': []}"),
    "two models": ("a.yml", f"x: {{{curobo('').replace(chr(10), ' ')[:18]} {{}}}}\n" + curobo("")),
    "YAML NaN": ("a.yml", curobo("  - {center: [1, 0, 0], radius: .nan}\n")),
    "sexagesimal": ("a.yml", curobo("  - {center: [1:30, 0, 0], radius: 1}\n")),
    "octal": ("a.yml", curobo("  - {center: [010, 0, 0], radius: 1}\n")),
    "YAML offset": ("a.yml", curobo("  - {center: [0, 0, 0], radius: 1, offset: [1, 1, 1]}\n")),
    "a merge": ("a.yml", "x: &x {b: []}\ncollision_spheres:\n  <<: *x\n  a: []\n"),
    "Python": ("a.yml", 'collision_spheres: !!python/object/apply:os.system ["true"]'),
    "itself": ("a.yml", "a: &a {b: *a}\n"),
    "its own name": ("a.yml", "collision_spheres: a.yml"),
    "YAML cut off": ("a.yml", "{bad: ["),
    "YAML deep": ("a.yml", "[" * 20000),
    "YAML bytes": ("a.yml", b"\xff\xfe\x00"),
    "URDF, a link twice": ("a.urdf", f"<robot>{LINK}{LINK}</robot>"),
    "two spheres in a shape": ("a.urdf", shape(BALL + BALL)),
    "a sphere and a box": ("a.urdf", shape(BALL + '<box size="9 9 9"/>')),
    "two geometries": (
        "a.urdf",
        shape(BALL).replace("</geometry>", "</geometry><geometry><box/></geometry>"),
    ),
    "two origins": (
        "a.urdf",
        shape(BALL).replace("<geometry>", '<origin xyz="1 0 0"/><origin xyz="2 0 0"/><geometry>'),
    ),
    "URDF NaN": ("a.urdf", shape('<sphere radius="nan"/>')),
    "URDF negative": ("a.urdf", shape('<sphere radius="-1"/>')),
    "URDF encoding": ("a.urdf", '<?xml version="1.0" encoding="wonder"?><robot/>'),
    "SRDF, a link twice": (
        "a.srdf",
        srdf(("a", '<sphere center="0 0 0" radius="1"/>'), ("a", "")),
    ),
    "SRDF NaN": (
        "a.srdf",
        srdf(("a", '<sphere center="0 0 0" radius="1"/><sphere center="5 0 0" radius="nan"/>')),
    ),
    "SRDF negative": (
        "a.srdf",
        srdf(("a", '<sphere center="0 0 0" radius="1"/><sphere center="5 0 0" radius="-2"/>')),
    ),
    "tree, NaN": ("a.sph", "2 2\n0 0 0 3\n1 0 0 1\n2 2 2 nan\n"),
    "tree, more nodes": ("a.sph", "2 2\n0 0 0 3\n1 0 0 1\n-1 0 0 -1\n9 9 9 9\n"),
    "tree, no parent": ("a.sph", "2 2\n0 0 0 -1\n1 0 0 1\n-1 0 0 1\n"),
    "tree, junk": ("a.sph", "2 2\n0 0 0 3\n1 0 0 1 junk\n-1 0 0 1\n"),
    "decimal commas": ("a.xyzr", "0,5 0 1\n"),
    "decimal comma": ("a.xyzr", "0,5 1\n"),
    "underscore": ("a.xyzr", "1_0 0 1\n"),
    "Arabic digits": ("a.xyzr", "0 0 \u0661\n"),
    "another line end": ("a.xyzr", "0 0 1\x0b1 0 1\n"),
    "and another": ("a.xyzr", "0 0 1\x851 0 1\n"),
    "too large": ("a.xyzr", "0 0 1e999\n"),
    "two kinds": ("a.xyzr", "# kind: inner\n# kind: outer\n0 0 1\n"),
    "a kind of its own": ("a.xyzr", "# kind: mostly inner\n0 0 1\n"),
    "nothing": ("a.xyzr", ""),
    "xyzr bytes": ("a.xyzr", b"\xff\xfe0\x00"),
    "array cut off": ("a.npy", ROW[:-3]),
    "header cut off": ("a.npy", ROW[:20]),
    "no array": ("a.npy", b""),
    "junk after it": ("a.npy", ROW + b"junk"),
    "too many rows": ("a.npy", ROW.replace(b"(1, 3)", b"(9999999999, 3)")),
    "no dimension": ("a.npy", npy(np.zeros(0))),
    "an archive": ("a.npy", ARCHIVE.getvalue()),
    "objects": ("a.npy", npy(np.array([[0, 0, 1]], dtype=object), allow_pickle=True)),
}


def put(folder, name, content):
    place = folder / name
    place.write_bytes(content if isinstance(content, bytes) else content.encode())
    return place


@pytest.mark.parametrize("why", BAD)
def test_what_is_not_understood_is_refused(tmp_path, why, capsys):
    place = put(tmp_path, *BAD[why])
    with pytest.raises(InputError) as caught:
        read_links(place)
    assert str(caught.value).startswith(str(place))
    good = put(tmp_path, "good.xyzr", "0 0 0 1\n")
    assert main([str(good), str(place), "--start", "0,0,0"]) == 2
    said = capsys.readouterr().err
    assert said.startswith("libcage: ") and said.count("\n") == 1 and place.name in said


def test_what_is_understood_is_read(tmp_path):
    for name, content, wanted in (
        ("a.json", own(), [[0, 0, 1], [5, 0, 1]]),
        ("b.json", own(dim=3, balls=[]), []),
        ("c.json", "\ufeff" + own(), [[0, 0, 1], [5, 0, 1]]),
        ("a.xyzr", "1, 2, .5\r\n-1e0,2.,5E-1\r\n", [[1, 2, 0.5], [-1, 2, 0.5]]),
        ("a.yml", curobo("").replace("radius: 1", "radius: 1e-3"), [[0, 0, 0, 1e-3]]),
        ("a.urdf", shape(BALL), [[0, 0, 0, 1]]),
        (
            "a.sph",
            "2 2\n0 0 0 3 1\n1 0 0 1 2\n-1 0 0 1 3\n\nmean 1 2\n",
            [[1, 0, 0, 1], [-1, 0, 0, 1]],
        ),
        (
            "a.srdf",
            srdf(("off", POINT), ("a", POINT + '<sphere center="5 0 0" radius="2"/>')),
            [[0, 0, 0, 0], [5, 0, 0, 2]],
        ),
        ("a.npy", npy(np.array([[0, 0, 1]], dtype=">i8")), [[0, 0, 1]]),
    ):
        assert read(put(tmp_path, name, content)).rows.tolist() == wanted, name


def test_nested_aliases_take_no_time(tmp_path):
    lines = ["a0: &a0 [x, x, x, x, x, x, x, x, x]"]
    lines += [f"a{i}: &a{i} [{', '.join([f'*a{i - 1}'] * 9)}]" for i in range(1, 12)]
    place = put(tmp_path, "a.yml", "\n".join(lines) + "\n" + curobo(""))
    begun = time.perf_counter()
    assert len(read(place)) == 1 and time.perf_counter() - begun < 5


@pytest.mark.parametrize("comment", ["# kind: outer", " #KIND : Outer ", "0 0 2  # kind: outer"])
def test_the_kind_that_a_file_states_is_heard(tmp_path, comment):
    place = put(tmp_path, "a.xyzr", f"{comment}\n0 0 1\n")
    assert read(place).kind == "outer" and read(place, kind="outer").kind == "outer"
    for other in ("exact", "inner", "unknown"):
        with pytest.raises(KindError, match="as_kind"):
            read(place, kind=other)
    with pytest.raises(KindError):
        read(place, kind="")


def test_what_is_written_is_where_it_was_asked_for(tmp_path):
    balls = Balls([[0.1, 0, 1e-7], [0, 0, 0.1]])
    write(tmp_path / "a.NPY", balls)
    assert [one.name for one in tmp_path.iterdir()] == ["a.NPY"]
    assert read(tmp_path / "a.NPY").rows.tolist() == balls.rows.tolist()
    with pytest.raises(InputError):
        write(tmp_path / "a.xyzr", Balls(np.zeros((0, 2 + 1))))
    write(tmp_path / "a.h", balls)
    assert "1 are too small to be inner ones" in (tmp_path / "a.h").read_text()
    with pytest.raises(InputError, match="no inner ball"):
        write(tmp_path / "a.h", balls[:1])
    for name in ("b\u00e9", "_x", "a b", "x\n", ""):
        with pytest.raises(InputError):
            write(tmp_path / "a.h", balls, name=name)


# ---- the command line ----------------------------------------------------------------------------


def test_the_command_line_does_not_overrule_a_file(tmp_path, capsys):
    write(tmp_path / "part.xyzr", Balls([[0, 0, 0.04]], "outer"))
    fingers = [[0.07, 0, 0.02], [0, 0.07, 0.02], [-0.07, 0, 0.02], [0, -0.07, 0.02]]
    np.savetxt(tmp_path / "walls.xyzr", fingers)
    files = [str(tmp_path / "part.xyzr"), str(tmp_path / "walls.xyzr"), "--start", "0,0,0"]
    assert main([*files, "--obstacle-kind", "exact", "--object-kind", "exact"]) == 2
    assert "says that its balls are outer" in capsys.readouterr().err
    assert main([*files, "--quiet"]) == 2  # of the walls nobody said what they are
    assert main([*files, "--obstacle-kind", "exact", "--quiet"]) == 0
    assert capsys.readouterr().out == "UNDEFINED\n"  # covers prove no cage
    np.savetxt(tmp_path / "part.xyzr", [[0, 0, 0.04]])
    assert main([*files, "--obstacle-kind", "exact", "--object-kind", "inner", "--quiet"]) == 0
    assert capsys.readouterr().out == "CAGED\n"
    with pytest.raises(SystemExit):
        main([*files, "--kind", "exact"])


def slit(folder, name):
    """A cube of a micrometre with a slit of 8 nm in it, whose sides are not to be merged."""
    hole = trimesh.creation.box((8e-9, 6e-7, 6e-7))
    hole.invert()
    both = trimesh.util.concatenate([trimesh.creation.box((1e-6,) * 3), hole])
    trimesh.Trimesh(both.vertices, both.faces, process=False).export(folder / name)
    return folder / name


def test_balls_lie_inside_the_triangles_of_the_file(tmp_path):
    place = slit(tmp_path, "a.stl")
    raw = np.frombuffer(place.read_bytes()[84:], dtype=np.uint8).reshape(-1, 50)[:, 12:48]

    class File:
        vertices = raw.copy().view("<f4").reshape(-1, 3).astype(float)
        faces = np.arange(len(vertices)).reshape(-1, 3)

    given = parser().parse_args(
        ["a", "b", "--start", "0,0,0", "--balls", "12", "--outer-tolerance", "4e-7"]
    )
    solid, _ = read_solid(str(place), given)
    assert len(solid.inner) > 5 and verify_balls(File, solid.inner)


@pytest.mark.parametrize("name", ["a.stl", "a.ply", "a.glb"])
def test_no_vertices_are_merged(tmp_path, name):
    mesh = read_mesh(slit(tmp_path, name), 0.001)
    assert np.allclose(np.unique(abs(mesh.vertices[:, 0])), [4e-12, 5e-10], rtol=1e-6, atol=0)


def test_files_that_are_no_meshes_have_one_line_each(tmp_path, capsys):
    good = put(tmp_path, "good.xyzr", "# kind: exact\n0 0 0 .01\n")
    trimesh.creation.box((1, 1, 1)).export(tmp_path / "box.stl")
    whole = (tmp_path / "box.stl").read_bytes()
    bad = [put(tmp_path, f"empty{end}", b"") for end in (".stl", ".obj", ".ply", ".off", ".glb")]
    bad += [put(tmp_path, f"junk{end}", b"\x00\x01junk" * 9) for end in (".stl", ".ply", ".glb")]
    bad += [put(tmp_path, "cut.stl", whole[:-20]), put(tmp_path, "x.stl", b"solid x\nendsolid")]
    bad += [tmp_path / "none.stl", tmp_path / "none.xyzr", tmp_path]
    for place in bad:
        assert main([str(good), str(place), "--start", "0,0,0"]) == 2, place
        said = capsys.readouterr().err
        assert said.startswith("libcage: ") and said.count("\n") == 1, said
    box = str(tmp_path / "box.stl")
    for more in (
        ["--object-kind", "inner"],
        ["--link", "a"],
        ["--scale", "nan"],
        ["--scale", "-1"],
        ["--balls", "0"],
        ["--threads", "99"],
        ["--max-cells", "-7"],
        ["--png", str(tmp_path / "a.png")],
    ):
        some = ["--start", "0,0,0", "--balls", "5", "--outer-tolerance", "0.5"]
        assert main([box, str(good), *some, *more]) == 2, more
        assert capsys.readouterr().err.splitlines()[-1].startswith("libcage: "), more


def test_a_bad_file_has_no_traceback(tmp_path):
    place = put(tmp_path, "a.json", "{")
    done = subprocess.run(
        [sys.executable, "-m", "libcage", str(place), str(place), "--start", "0,0,0"],
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert done.returncode == 2 and done.stdout == ""
    assert done.stderr.startswith("libcage: ") and done.stderr.count("\n") == 1
