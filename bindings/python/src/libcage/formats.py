"""Files of balls: xyzr, npy, own JSON and C headers, and the sphere models that robot tools write.

A file rarely says what its balls are of the solid, so they come as kind `unknown` unless the file
is one that libcage wrote, or you say so: read(path, kind="outer"). Lengths are taken as they are,
in metres."""

from __future__ import annotations

import json
import os
import re
import xml.etree.ElementTree as ElementTree
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Union

import numpy as np

from . import _native
from .balls import Balls, to_grid
from .errors import InputError
from .grid import check_unit

PathLike = Union[str, "os.PathLike[str]"]
FORMAT = "libcage balls"


def read(path: PathLike, kind: str | None = None, link: str | None = None) -> Balls:
    """The balls of a file, of one link where it has several. kind: what they are, if you know.

    xyzr, txt (rows x y r or x y z r); npy; json (of libcage, or of foam); yml, yaml (cuRobo); urdf
    with spheres; srdf; sph (sphere trees: the leaves)."""
    links = read_links(path, kind)
    if link is not None:
        if link not in links:
            raise InputError(f"{path}: no link {link!r}; there are {', '.join(sorted(links))}")
        return links[link]
    if len(links) != 1:
        raise InputError(
            f"{path}: {len(links)} links, say which: link=... of {', '.join(sorted(links))}"
        )
    return next(iter(links.values()))


def read_links(path: PathLike, kind: str | None = None) -> dict[str, Balls]:
    """The balls of each link of a file, in the link's frame. A file without links has one, named
    ''."""
    place = Path(path)
    readers = {
        ".npy": _npy,
        ".json": _json,
        ".yml": _curobo,
        ".yaml": _curobo,
        ".urdf": _urdf,
        ".srdf": _srdf,
        ".sph": _sph,
        ".xyzr": _xyzr,
        ".txt": _xyzr,
    }
    reader = readers.get(place.suffix.lower())
    if reader is None:
        raise InputError(f"{place}: unknown format; known are {', '.join(readers)}")
    made = {}
    for name, rows, said in reader(place):
        try:
            made[name] = Balls(_rows(rows), kind or said, place.name)
        except InputError as error:
            raise InputError(f"{place}{': ' + name if name else ''}: {error}") from None
    if not made:
        raise InputError(f"{place}: no balls in it")
    return made


Found = Iterator[tuple[str, Any, str]]  # link, rows, kind


def _rows(rows: Any) -> Any:
    array = np.asarray(rows)
    return array.reshape(0, 4) if array.size == 0 and array.ndim < 2 else array


def _number(text: Any) -> float:
    try:
        return float(text)
    except (TypeError, ValueError):
        raise InputError(f"{text!r} is not a number") from None


def _triple(text: Any, what: str) -> list[float]:
    values = [_number(part) for part in (text.split() if isinstance(text, str) else text or [])]
    if len(values) != 3:
        raise InputError(f"{what}: three numbers are wanted, not {text!r}")
    return values


def _xyzr(path: Path) -> Found:
    rows: list[list[float]] = []
    kind = "unknown"
    for number, line in enumerate(path.read_text(encoding="utf-8-sig").splitlines(), 1):
        said = re.match(r"#\s*kind:\s*(\w+)\s*$", line)
        if said:
            kind = said[1]
        words = line.split("#")[0].replace(",", " ").split()
        if not words:
            continue
        if len(words) not in (3, 4) or (rows and len(words) != len(rows[0])):
            raise InputError(
                f'{path}:{number}: {len(words)} columns; a ball is "x y r" or "x y z r"'
            )
        try:
            rows.append([float(word) for word in words])
        except ValueError:
            raise InputError(f"{path}:{number}: not a number: {line.strip()!r}") from None
    yield "", rows, kind


def _npy(path: Path) -> Found:
    yield "", np.load(path, allow_pickle=False), "unknown"


def _json(path: Path) -> Found:
    """Own files, and foam's: a list of levels, of which the last is the finest, each with
    `spheres`."""
    raw = json.loads(path.read_text(encoding="utf-8"))
    if isinstance(raw, dict) and raw.get("format") == FORMAT:
        yield "", np.array(raw["balls"], dtype=float).reshape(-1, int(raw["dim"]) + 1), raw["kind"]
        return
    if (
        isinstance(raw, list)
        and raw
        and all(isinstance(level, dict) and "spheres" in level for level in raw)
    ):
        raw = raw[-1]
    if isinstance(raw, dict) and "spheres" in raw:
        yield "", _spheres(raw["spheres"], "origin"), "unknown"
    elif isinstance(raw, list):
        yield "", _spheres(raw, "origin"), "unknown"
    elif isinstance(raw, dict):
        for name, value in raw.items():
            yield (
                name,
                _spheres(value["spheres"] if isinstance(value, dict) else value, "origin"),
                "unknown",
            )


def _spheres(items: Any, centre: str) -> list[list[float]]:
    if not isinstance(items, list) or not all(isinstance(item, dict) for item in items):
        raise InputError(f"a list of spheres with {centre} and radius is wanted")
    return [
        _triple(item.get(centre, item.get("center")), centre) + [_number(item.get("radius"))]
        for item in items
    ]


def _curobo(path: Path) -> Found:
    """collision_spheres of cuRobo, or the file that it names. Balls with a negative radius are
    switched off there, and left out. collision_sphere_buffer is not added."""
    import yaml

    found = _find(yaml.safe_load(path.read_text(encoding="utf-8")), "collision_spheres")
    if isinstance(found, str):
        other = path.parent / found
        found = _find(yaml.safe_load(other.read_text(encoding="utf-8")), "collision_spheres")
    if not isinstance(found, dict):
        raise InputError(f"{path}: no collision_spheres of links")
    for name, items in found.items():
        rows = _spheres(items, "center")
        yield str(name), [row for row in rows if row[3] >= 0], "unknown"


def _find(tree: Any, key: str) -> Any:
    if isinstance(tree, dict):
        if key in tree:
            return tree[key]
        for value in tree.values():
            found = _find(value, key)
            if found is not None:
                return found
    return None


def _xml(path: Path) -> Any:
    try:
        return ElementTree.parse(path).getroot()
    except ElementTree.ParseError as error:
        raise InputError(f"{path}: {error}") from None


def _urdf(path: Path) -> Found:
    """Collision spheres of each link. Other shapes are an error: without them the balls would be
    another robot."""
    for link in _xml(path).iter("link"):
        rows = []
        for part in link.findall("collision"):
            sphere = part.find("geometry/sphere")
            name = link.get("name", "")
            if sphere is None:
                raise InputError(f"{path}: link {name} has a collision shape that is no sphere")
            origin = part.find("origin")
            place = "0 0 0" if origin is None else origin.get("xyz", "0 0 0")
            rows.append(_triple(place, f"link {name}") + [_number(sphere.get("radius"))])
        if rows:
            yield link.get("name", ""), rows, "unknown"


def _srdf(path: Path) -> Found:
    """link_sphere_approximation of MoveIt. Links without spheres of positive radius are left out:
    that is how it says that a link is not checked."""
    for link in _xml(path).iter("link_sphere_approximation"):
        rows = [
            _triple(sphere.get("center"), "center") + [_number(sphere.get("radius"))]
            for sphere in link.findall("sphere")
        ]
        rows = [row for row in rows if row[3] > 0]
        if rows:
            yield link.get("link", ""), rows, "unknown"


def _sph(path: Path) -> Found:
    """A sphere tree: "levels degree", then level by level its nodes x y z r, a radius that is not
    positive where there is none. The leaves are the nodes without children."""
    lines = path.read_text(encoding="utf-8").splitlines()
    try:
        levels, degree = (int(word) for word in lines[0].split()[:2])
        total = (
            sum(degree**level for level in range(levels)) if levels < 12 and degree < 1000 else -1
        )
        if levels < 1 or degree < 1 or not 0 < total < 10_000_000:
            raise ValueError
        nodes = [[float(word) for word in line.split()[:4]] for line in lines[1 : total + 1]]
    except (ValueError, IndexError):
        raise InputError(f"{path}: not a sphere tree") from None
    if len(nodes) != total or any(len(node) != 4 for node in nodes):
        raise InputError(f"{path}: {total} nodes are announced, and not there")
    there = [node[3] > 0 for node in nodes]
    leaves = [
        node
        for i, node in enumerate(nodes)
        if there[i] and not any(there[degree * i + 1 : degree * i + degree + 1])
    ]
    yield "", leaves, "unknown"


# ---- writing -------------------------------------------------------------------------------------


def write(path: PathLike, balls: Balls, unit: float = 2.0**-20, name: str = "balls") -> None:
    """Write balls as xyzr, npy (which has no place for the kind), json, or a C header (.h).

    A header has the balls in grid units of `unit` metres, a power of two: inner and exact balls
    rounded inward as NAME_inner, outer and exact ones rounded outward as NAME_outer.
    """
    place = Path(path)
    suffix = place.suffix.lower()
    if suffix == ".npy":
        np.save(place, balls.rows, allow_pickle=False)
    elif suffix == ".xyzr":
        lines = [
            f"# kind: {balls.kind}",
            *(" ".join(map(repr, row)) for row in balls.rows.tolist()),
        ]
        place.write_text("\n".join(lines) + "\n", encoding="utf-8")
    elif suffix == ".json":
        raw = {"format": FORMAT, "dim": balls.dim, "kind": balls.kind, "balls": balls.rows.tolist()}
        place.write_text(json.dumps(raw) + "\n", encoding="utf-8")
    elif suffix == ".h":
        place.write_text(_header(balls, check_unit(unit), name), encoding="utf-8")
    else:
        raise InputError(f"{place}: written are .xyzr, .npy, .json and .h")


def _header(balls: Balls, unit: float, name: str) -> str:
    if not re.fullmatch(r"[A-Za-z_]\w*", name):
        raise InputError(f"{name!r} is no name in C")
    if not len(balls):
        raise InputError("C has no arrays without elements")
    if balls.kind == "unknown":
        raise InputError(
            "balls of unknown kind: say what they are, balls.as_kind('inner') or 'outer'"
        )
    if abs(balls.rows).max() / unit > _native.REACH[balls.dim]:
        raise InputError(f"the balls do not fit the grid at a unit of {unit:g}; use a larger one")
    lines = [
        f"/* {len(balls)} {balls.kind} balls in units of {unit!r} metres, written by libcage. */",
        '#include "cage.h"',
        "",
    ]
    inner, outer = to_grid(balls, unit)
    for side, rows in (("inner", inner), ("outer", outer)):
        if balls.kind in (side, "exact") and len(rows):
            lines.append(f"static const cage_ball {name}_{side}[{len(rows)}] = {{")
            lines += ["    {" + ", ".join(map(str, row)) + "}," for row in rows.tolist()]
            lines += ["};", ""]
    return "\n".join(lines)
