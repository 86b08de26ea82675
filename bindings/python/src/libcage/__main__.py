"""python -m libcage OBJECT OBSTACLES --start POSE: one question from files of meshes or balls."""

from __future__ import annotations

import argparse
import json
import math
import re
import sys
from pathlib import Path
from typing import Any

from . import __version__, formats, poses
from .balls import KINDS, Solid, solid, union
from .errors import CageError, InputError, MissingError, SolidError
from .extras import extra
from .scene import Scene

NEGATIVE = re.compile(r"-(\.?[0-9]|inf|nan)")
MESHES = {".stl", ".obj", ".ply", ".off", ".glb", ".3mf"}


def parser() -> argparse.ArgumentParser:
    """The options."""
    made = argparse.ArgumentParser(
        prog="python -m libcage",
        description="Prove that an object is caged, or that no path joins two "
        "poses, or find the path. A file is a closed mesh (STL, OBJ, PLY, OFF, ...), for which "
        "balls are made, or balls (xyzr, npy, json, yml, urdf, srdf, sph). Metres and radians.",
    )
    made.add_argument("object", help="the object's file, in its own frame")
    made.add_argument(
        "obstacles", nargs="+", help="the obstacles' files, in the world; of one kind"
    )
    made.add_argument(
        "--start",
        required=True,
        metavar="POSE",
        help="x,y,theta in the plane; in space x,y,z or x,y,z,qw,qx,qy,qz; may begin with a minus "
        "sign",
    )
    made.add_argument("--goal", metavar="POSE", help="without it: can the object leave?")
    made.add_argument(
        "--scale",
        type=float,
        default=1.0,
        help="metres in a unit of length of meshes: "
        "0.001 for millimetres (vertices are then rounded to doubles once). Files of balls are "
        "taken as they are",
    )
    made.add_argument("--balls", type=int, default=100, help="inner balls for a mesh, at most")
    made.add_argument(
        "--outer-tolerance",
        type=float,
        metavar="M",
        help="how far outer balls may reach beyond a mesh (default: a twentieth of its size)",
    )
    for which in ("object", "obstacle"):
        made.add_argument(
            f"--{which}-kind",
            choices=KINDS,
            help=f"what the balls in the {which}'s file are of the solid, where it does not say",
        )
    made.add_argument("--link", help="the link to take of the object's file, where it has several")
    made.add_argument(
        "--insist", action="store_true", help="ask about balls that prove nothing of a solid"
    )
    made.add_argument("--side", choices=("both", "inner", "outer"), default="both")
    made.add_argument("--max-cells", type=int)
    made.add_argument("--max-level", type=int)
    made.add_argument("--threads", type=int)
    made.add_argument(
        "--margin",
        type=int,
        metavar="N",
        help="find the margin too, by N bisections (Ctrl-C waits for it)",
    )
    made.add_argument("--html", metavar="FILE", help="write an interactive picture")
    made.add_argument("--png", metavar="FILE", help="in the plane: write a picture")
    made.add_argument("--json", action="store_true", help="print one JSON object")
    made.add_argument(
        "--quiet",
        action="store_true",
        help="print the verdict only, no progress; with --insist, on standard error, what it is "
        "about",
    )
    made.add_argument("--version", action="version", version=f"libcage {__version__}")
    return made


def check_scale(scale: float) -> None:
    """Refuse what would be a mirror image, a point, or nothing."""
    if not 0 < scale < math.inf:
        raise InputError(f"--scale {scale:g}: a positive number is wanted")


def read_mesh(path: Path, scale: float) -> Any:
    """The triangles of a file as they are there: nothing is merged, mended or left out."""
    check_scale(scale)
    with extra("shapes"):
        import trimesh

    if not path.is_file():
        raise InputError(f"{path}: no such file")
    try:
        mesh: Any = trimesh.load_mesh(path, process=False)
        return trimesh.Trimesh(mesh.vertices * scale, mesh.faces, process=False)
    except ModuleNotFoundError as error:
        raise MissingError(
            f"{path}: to read this format {error.name} is wanted: pip install 'trimesh[easy]'"
        ) from None
    except Exception as error:  # whatever the reader of that format stumbles over
        raise InputError(f"{path}: no mesh: {error or type(error).__name__}") from None


def read_solid(
    path: str, given: argparse.Namespace, kind: str | None = None, link: str | None = None
) -> tuple[Solid, str]:
    """The solid in a file, and what was made of it, in words."""
    place = Path(path)
    if place.suffix.lower() not in MESHES:
        balls = formats.read(place, kind, link)
        return solid(balls), f"{path}: {balls}"
    if kind is not None or link is not None:
        raise InputError(f"{path}: a mesh has no kind and no links, these options are for balls")
    from .shapes import fit

    mesh = read_mesh(place, given.scale)
    try:
        made = fit(mesh, given.balls, outer_tolerance=given.outer_tolerance)
    except SolidError as error:
        raise SolidError(f"{path}: {error}") from None
    return made.solid(), f"{path}: {made}"


def join(solids: list[Solid]) -> Solid:
    """The union of several solids, of the same kinds."""

    def side(parts: list[Any]) -> Any:
        if any(part is None for part in parts):
            return None
        kinds = {part.kind for part in parts}
        if len(kinds) > 1:
            raise InputError(
                f"obstacles of several kinds: {', '.join(sorted(kinds))}; say --obstacle-kind "
                "where the files do not"
            )
        return union(parts)

    if len({one.dim for one in solids}) > 1:
        raise InputError("the obstacles are of different dimensions")
    if len(solids) == 1:
        return solids[0]
    if all(one.inner is one.outer for one in solids):
        both = side([one.inner for one in solids])
        return Solid(both, both)
    return Solid(side([one.inner for one in solids]), side([one.outer for one in solids]))


def read_pose(text: str, dim: int) -> Any:
    """A pose from the command line."""
    try:
        values = [float(word) for word in text.split(",")]
    except ValueError:
        raise InputError(f"{text!r} is no pose") from None
    if dim == 2 and len(values) == 3:
        return tuple(values)
    if dim == 3 and len(values) in (3, 7):
        return poses.from_wxyz(values[:3], values[3:] or [1, 0, 0, 0])
    raise InputError(
        f"{text!r} is no pose: x,y,theta in the plane; x,y,z or x,y,z,qw,qx,qy,qz in space"
    )


def run(given: argparse.Namespace) -> None:
    """Everything after the options."""
    check_scale(given.scale)
    part, said = read_solid(given.object, given, given.object_kind, given.link)
    others = [read_solid(path, given, given.obstacle_kind) for path in given.obstacles]
    if not given.quiet:
        print("\n".join([said, *(words for _, words in others)]), file=sys.stderr)
    scene = Scene(part, join([made for made, _ in others]))
    if given.png and scene.dim != 2:
        raise InputError("--png draws in the plane; in space see --html")
    start = read_pose(given.start, scene.dim)
    goal = None if given.goal is None else read_pose(given.goal, scene.dim)
    limits = {"max_cells": given.max_cells, "max_level": given.max_level, "insist": given.insist}
    answer = scene.prove(
        start,
        goal,
        side=given.side,
        threads=given.threads,
        progress=not given.quiet and sys.stderr.isatty(),
        **limits,
    )
    margin = None
    if given.margin is not None:
        margin = scene.margin(start, goal, rounds=given.margin, **limits)
    if given.json:
        raw = answer.to_dict()
        if margin is not None:
            raw["margin"] = {"closed": margin.closed, "open": margin.open}
        print(json.dumps(raw))
    elif given.quiet:
        print(answer.verdict)
        if given.insist:
            print(f"libcage: about: {answer.about}", file=sys.stderr)
    else:
        print(answer)
        print(f"start as proved: {answer.start}")
        if margin is not None:
            print(f"margin: {margin}")
    if given.html:
        from . import view

        view.write_html(given.html, scene, answer)
    if given.png:
        with extra("pictures"):
            from matplotlib import pyplot

        from . import plot

        figure, axes = pyplot.subplots()
        plot.result(scene, answer, ax=axes)
        figure.savefig(given.png, dpi=150)
        pyplot.close(figure)


def joined(arguments: list[str]) -> list[str]:
    """The same with --start -1,0,0 as --start=-1,0,0: a number with its sign is no option."""
    made: list[str] = []
    for word in arguments:
        last = made[-1] if made else ""
        if "--" not in made and re.fullmatch("--[a-z][a-z-]*", last) and NEGATIVE.match(word):
            made[-1] = f"{last}={word}"
        else:
            made.append(word)
    return made


def main(arguments: list[str] | None = None) -> int:
    """Exit status 0 for any verdict, 2 for bad input, 130 for Ctrl-C."""
    given = parser().parse_args(joined(sys.argv[1:] if arguments is None else arguments))
    try:
        run(given)
    except (CageError, OSError, ImportError) as error:
        print(f"libcage: {' '.join(str(error).split())}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("libcage: stopped", file=sys.stderr)
        return 130
    return 0


if __name__ == "__main__":
    sys.exit(main())
