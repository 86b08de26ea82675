"""Sphere models that robot tools write: cuRobo, foam, URDF, SRDF, sphere trees.

Each reader gives, link by link, a name, rows x y z r, and the kind, which none of them states."""

from __future__ import annotations

import math
import re
import xml.etree.ElementTree as ElementTree
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from .errors import InputError
from .extras import extra

Link = tuple[str, Any, str]  # its name, rows, kind
Found = Iterator[Link]

NUMBER = re.compile(r"[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?")


def number(value: Any) -> float:
    """A finite number, or text that is one in decimal; what a double cannot hold is an error."""
    if isinstance(value, str):
        if not NUMBER.fullmatch(value):
            raise InputError(f"{value!r} is not a number")
    elif isinstance(value, bool) or not isinstance(value, (int, float)):
        raise InputError(f"{value!r} is not a number")
    try:
        made = float(value)
    except OverflowError:
        made = math.inf
    if not math.isfinite(made) or (isinstance(value, int) and made != value):
        raise InputError(f"{value!r} is no finite double")
    return made


def one_of_each(pairs: list[tuple[Any, Any]]) -> dict[Any, Any]:
    """A dict of pairs whose keys differ."""
    made = dict(pairs)
    if len(made) < len(pairs):
        keys = [key for key, _ in pairs]
        raise InputError(f"{next(k for k in keys if keys.count(k) > 1)!r} is there twice")
    return made


def _triple(value: Any, what: str) -> list[float]:
    parts = value.split() if isinstance(value, str) else value
    if not isinstance(parts, list) or len(parts) != 3:
        raise InputError(f"{what}: three numbers are wanted, not {value!r}")
    return [number(part) for part in parts]


def _rows(rows: list[list[float]]) -> Any:
    return np.array(rows, dtype=np.float64).reshape(len(rows), 4)


def _spheres(items: Any) -> list[list[float]]:
    if not isinstance(items, list) or not all(isinstance(item, dict) for item in items):
        raise InputError("a list of spheres, each with its centre and radius, is wanted")
    rows = []
    for item in items:
        centre = sorted(set(item) - {"radius"})
        if "radius" not in item or centre not in (["origin"], ["center"]):
            raise InputError(
                f"a sphere has a radius and an origin or center, not {', '.join(map(str, item))}"
            )
        rows.append([*_triple(item[centre[0]], centre[0]), number(item["radius"])])
    return rows


def robot_json(raw: Any) -> Found:
    """What foam writes, a list of levels, of which the last is the finest, each with `spheres`;
    one such level; a list of spheres; or these by the names of links."""
    if isinstance(raw, dict) and "spheres" not in raw:
        for name, value in raw.items():
            yield name, _level(value), "unknown"
    elif raw != []:
        yield "", _level(raw), "unknown"


def _level(raw: Any) -> Any:
    if (
        isinstance(raw, list)
        and raw
        and all(isinstance(level, dict) and "spheres" in level for level in raw)
    ):
        if not raw[-1]["spheres"]:
            raise InputError("the last level, which is the finest, has no spheres")
        raw = raw[-1]
    if isinstance(raw, dict):
        if "spheres" not in raw:
            raise InputError("a list of spheres, or a level with `spheres`, is wanted")
        raw = raw["spheres"]
    return _rows(_spheres(raw))


def curobo(path: Path) -> Found:
    """collision_spheres of cuRobo, or the file that it names. Balls with a negative radius are
    switched off there, and left out. collision_sphere_buffer is not added."""
    found = _collision_spheres(path)
    if isinstance(found, str):
        found = _collision_spheres(path.parent / found)
    if not isinstance(found, dict):
        raise InputError("no collision_spheres of links")
    for name, items in found.items():
        rows = _spheres(items)
        yield name, _rows([row for row in rows if row[3] >= 0]), "unknown"


def _collision_spheres(path: Path) -> Any:
    """The one value of that name in a file of YAML, its scalars as they are written."""
    with extra("formats"):
        import yaml

    class Loader(yaml.BaseLoader):  # type: ignore[misc, unused-ignore]
        """All scalars are text, so that nothing is an octal or a sexagesimal number."""

        def construct_scalar(self, node: Any) -> Any:
            """The text; 010 is 8 to some readers and 10 to others."""
            if not node.style and re.fullmatch("[-+]?0[0-9]+", node.value):
                raise InputError(f"{node.value}: octal or not? write it without the zero")
            return super().construct_scalar(node)

        def construct_mapping(self, node: Any, deep: bool = False) -> dict[Any, Any]:
            """A dict, none of whose keys is there twice."""
            pairs = [
                (self.construct_object(key, deep=True), self.construct_object(value, deep=True))
                for key, value in node.value
            ]
            if any(not isinstance(key, str) or key == "<<" for key, _ in pairs):
                raise InputError("keys of mappings are names here, and `<<` is not supported")
            return one_of_each(pairs)

    Loader.add_constructor(
        "tag:yaml.org,2002:map", lambda loader, node: loader.construct_mapping(node)
    )
    try:
        raw = yaml.load(path.read_text(encoding="utf-8-sig"), Loader)
    except yaml.YAMLError as error:
        raise InputError(" ".join(str(error).split())) from None
    found, seen, left = [], set(), [raw]
    while left:  # an alias is the same object, and looked at once
        tree = left.pop()
        if id(tree) in seen or not isinstance(tree, (dict, list)):
            continue
        seen.add(id(tree))
        if isinstance(tree, dict) and "collision_spheres" in tree:
            found.append(tree["collision_spheres"])
        left.extend(tree.values() if isinstance(tree, dict) else tree)
    if len(found) > 1:
        raise InputError(f"collision_spheres is there {len(found)} times")
    return found[0] if found else None


def _xml(path: Path) -> Any:
    try:
        return ElementTree.parse(path).getroot()
    except (ElementTree.ParseError, LookupError) as error:
        raise InputError(str(error)) from None


def urdf(path: Path) -> Found:
    """Collision spheres of each link. Other shapes are an error: without them the balls would be
    another robot."""
    for link in _xml(path).iter("link"):
        name, rows = link.get("name", ""), []
        for part in link.findall("collision"):
            shapes, origins = part.findall("geometry"), part.findall("origin")
            if len(shapes) != 1 or len(shapes[0]) != 1 or shapes[0][0].tag != "sphere":
                raise InputError(f"link {name} has a collision shape that is not one sphere")
            if len(origins) > 1:
                raise InputError(f"link {name} has a collision shape with two origins")
            place = origins[0].get("xyz", "0 0 0") if origins else "0 0 0"
            rows.append([*_triple(place, f"link {name}"), number(shapes[0][0].get("radius"))])
        if rows:
            yield name, _rows(rows), "unknown"


def srdf(path: Path) -> Found:
    """link_sphere_approximation of MoveIt. Links all of whose spheres have the radius 0 are left
    out: that is how it says that a link is not checked."""
    names = set()
    for link in _xml(path).iter("link_sphere_approximation"):
        name = link.get("link", "")
        if name in names:
            raise InputError(f"link {name} is there twice")
        names.add(name)
        rows = [
            [*_triple(sphere.get("center"), f"link {name}"), number(sphere.get("radius"))]
            for sphere in link.findall("sphere")
        ]
        if any(row[3] != 0 for row in rows):
            yield name, _rows(rows), "unknown"


def sphere_tree(path: Path) -> Found:
    """A sphere tree: "levels degree", then level by level its nodes x y z r, perhaps with more
    numbers that do not matter here; a radius that is not positive where there is no node. The
    leaves are the nodes without children."""
    lines = path.read_text(encoding="utf-8").split("\n")
    head = lines[0].split()
    if len(head) != 2 or not all(re.fullmatch("[0-9]{1,4}", word) for word in head):
        raise InputError("not a sphere tree")
    levels, degree = map(int, head)
    total = sum(degree**level for level in range(levels)) if levels < 12 and degree < 1000 else -1
    if levels < 1 or degree < 1 or not 0 < total < 10_000_000:
        raise InputError("not a sphere tree")
    nodes = [[number(word) for word in line.split()] for line in lines[1 : total + 1]]
    if len(nodes) != total or any(len(node) < 4 for node in nodes):
        raise InputError(f"{total} nodes are announced, and not there")
    if any(all(map(NUMBER.fullmatch, line.split())) for line in lines[total + 1 :] if line.strip()):
        raise InputError(f"{total} nodes are announced, and there are more")
    there = [node[3] > 0 for node in nodes]
    if any(there[i] and not there[(i - 1) // degree] for i in range(1, total)):
        raise InputError("a node has no parent")
    leaves = [
        node[:4]
        for i, node in enumerate(nodes)
        if there[i] and not any(there[degree * i + 1 : degree * i + degree + 1])
    ]
    if leaves:
        yield "", _rows(leaves), "unknown"
