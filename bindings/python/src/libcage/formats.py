"""Files of balls: xyzr, npy, own JSON and C headers, and the sphere models that robot tools write.

A file rarely says what its balls are of the solid, so they come as kind `unknown` unless the file
is one that libcage wrote, or you say so: read(path, kind="outer"). A file that says what they are
is not contradicted: see Balls.as_kind. Lengths are taken as they are, in metres. What a reader does
not understand is an error, never left out."""

from __future__ import annotations

import io
import json
import os
import re
from pathlib import Path
from typing import Any, Union

import numpy as np

from . import _native
from .balls import KINDS, Balls, to_grid
from .errors import InputError, KindError
from .grid import check_unit
from .models import Found, curobo, number, one_of_each, robot_json, srdf, sphere_tree, urdf

PathLike = Union[str, "os.PathLike[str]"]
FORMAT = "libcage balls"


def read(path: PathLike, kind: str | None = None, link: str | None = None) -> Balls:
    """The balls of a file, of one link where it has several. kind: what they are, if you know and
    the file does not say.

    xyzr, txt (rows x y r or x y z r); npy; json (of libcage, or of foam: the finest level); yml,
    yaml (cuRobo: without the balls of negative radius, which are switched off there, and without
    collision_sphere_buffer); urdf with spheres; srdf; sph (sphere trees: the leaves)."""
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
    ''. Links without collision shapes are left out."""
    place = Path(path)
    readers = {
        ".npy": _npy,
        ".json": _json,
        ".yml": curobo,
        ".yaml": curobo,
        ".urdf": urdf,
        ".srdf": srdf,
        ".sph": sphere_tree,
        ".xyzr": _xyzr,
        ".txt": _xyzr,
    }
    if kind is not None and kind not in KINDS:
        raise KindError(f"kind is one of {', '.join(KINDS)}, not {kind!r}")
    reader = readers.get(place.suffix.lower())
    if reader is None:
        raise InputError(f"{place}: unknown format; known are {', '.join(readers)}")
    try:
        made = _made(reader(place), kind, place.name)
    except KindError as error:
        raise KindError(f"{place}: {error}") from None
    except (ValueError, TypeError, RecursionError, EOFError, MemoryError, OverflowError) as error:
        raise InputError(f"{place}: {error or type(error).__name__}") from None
    if not made:
        raise InputError(f"{place}: no balls in it")
    return made


def _made(found: Found, kind: str | None, source: str) -> dict[str, Balls]:
    made: dict[str, Balls] = {}
    for name, rows, said in found:
        if name in made:
            raise InputError(f"link {name} is there twice")
        if said not in KINDS:
            raise InputError(f"its balls are said to be {said!r}, not one of {', '.join(KINDS)}")
        if kind is not None and said not in ("unknown", kind):
            raise KindError(
                f"the file says that its balls are {said}, not {kind}; if you know better say so: "
                f"read(...).as_kind({kind!r})"
            )
        try:
            made[name] = Balls(rows, kind or said, source)
        except InputError as error:
            raise InputError(f"{name}: {error}" if name else str(error)) from None
    return made


def _xyzr(path: Path) -> Found:
    rows: list[list[float]] = []
    kind = ""
    for count, line in enumerate(path.read_text(encoding="utf-8-sig").split("\n"), 1):
        text, _, comment = line.partition("#")
        said = re.fullmatch(r"\s*kind\s*:\s*(.*?)\s*", comment, flags=re.IGNORECASE)
        if said:
            if kind not in ("", said[1].lower()):
                raise InputError(f"line {count}: the balls were said to be {kind} before")
            kind = said[1].lower()
        if not text.strip():
            continue
        words = [w.strip() for w in text.split(",")] if "," in text else text.split()
        if len(words) not in (3, 4) or (rows and len(words) != len(rows[0])):
            raise InputError(f'line {count}: {len(words)} columns; a ball is "x y r" or "x y z r"')
        try:
            rows.append([number(word) for word in words])
        except InputError as error:
            raise InputError(f"line {count}: {error}") from None
    if rows:
        yield "", rows, kind or "unknown"


def _npy(path: Path) -> Found:
    file = io.BytesIO(path.read_bytes())
    rows = np.lib.format.read_array(file, allow_pickle=False)
    if file.read(1):
        raise InputError("there is more in the file after the array")
    yield "", rows, "unknown"


def _json(path: Path) -> Found:
    """Own files, or what others write."""
    raw = json.loads(path.read_text(encoding="utf-8-sig"), object_pairs_hook=one_of_each)
    if not isinstance(raw, dict) or raw.get("format") != FORMAT:
        yield from robot_json(raw)
        return
    if set(raw) != {"format", "dim", "kind", "balls"}:
        raise InputError("a file of libcage has format, dim, kind and balls")
    dim, rows = raw["dim"], raw["balls"]
    if type(dim) is not int or dim not in (2, 3):
        raise InputError(f"dim is 2 or 3, not {dim!r}")
    if not isinstance(rows, list) or any(
        not isinstance(row, list) or len(row) != dim + 1 for row in rows
    ):
        raise InputError(f"balls are rows of {dim + 1} numbers, as dim is {dim}")
    if any(isinstance(value, str) for row in rows for value in row):
        raise InputError("balls are rows of numbers, not of text")
    array = np.array([[number(value) for value in row] for row in rows], dtype=np.float64)
    yield "", array.reshape(len(rows), dim + 1), raw["kind"]


# ---- writing -------------------------------------------------------------------------------------


def write(path: PathLike, balls: Balls, unit: float = 2.0**-20, name: str = "balls") -> None:
    """Write balls as xyzr, npy (which has no place for the kind), json, or a C header (.h).

    A header has the balls in grid units of `unit` metres, a power of two: inner and exact balls
    rounded inward as NAME_inner, without those that are too small for the unit, outer and exact
    ones rounded outward as NAME_outer.
    """
    place = Path(path)
    suffix = place.suffix.lower()
    if suffix == ".npy":
        with open(place, "wb") as file:  # np.save would append .npy to .NPY
            np.save(file, balls.rows, allow_pickle=False)
    elif suffix == ".xyzr":
        if not len(balls):
            raise InputError("xyzr has no place for the dimension of no balls: write .npy or .json")
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
    if not re.fullmatch(r"[A-Za-z]\w*", name, flags=re.ASCII):
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
    if balls.kind != "outer" and len(inner) < len(balls):
        if not len(inner):
            raise InputError(f"no inner ball is left at a unit of {unit:g}; use a smaller one")
        lines[0] = lines[0][:-3] + f" {len(balls) - len(inner)} are too small to be inner ones. */"
    for side, rows in (("inner", inner), ("outer", outer)):
        if balls.kind in (side, "exact") and len(rows):
            lines.append(f"static const cage_ball {name}_{side}[{len(rows)}] = {{")
            lines += ["    {" + ", ".join(map(str, row)) + "}," for row in rows.tolist()]
            lines += ["};", ""]
    return "\n".join(lines)
