"""Does a set of balls cover a solid? Cells of a quadtree or octree tell, and where not, get a ball.

A cell is done when no element of the boundary meets it and it is outside, or when one ball holds
all of it. Both are decided on the safe side: the tests against doubles carry bounds of their
rounding errors, and where these leave it open the cell counts as met, or as not held. Whether a
cell off the boundary is inside is decided exactly."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..errors import SolidError
from .exact import Boundary, Floats

HELD = 1 - 1e-12  # |corner - centre| in doubles is right to 1e-15 of itself: no cancellation in it
MARGIN = 1e-13  # of |edge| |edge| |distance|; the products below are right to 1e-14 of that


@dataclass
class Cell:
    """A cube: centre, half its side, and the elements that may meet it."""

    centre: Floats
    half: float
    elements: NDArray[np.int64]
    balls: NDArray[np.int64]
    depth: int


def root(boundary: Boundary) -> Cell:
    """A cube around the solid whose halves, to depth 24, have exact doubles as corners."""
    low = boundary.low.min(axis=0)
    half = math.ldexp(1.0, math.frexp(boundary.size)[1])  # the side is more than twice the solid's
    step = half * 2.0**-22
    corner = np.floor(low / step) * step
    centre = corner + half
    if (abs(corner) > half * 2.0**26).any():
        raise SolidError(
            "the solid is too far from the origin of its frame for its size: move it there"
        )
    return Cell(centre, half, np.arange(len(boundary.corners)), np.zeros(0, dtype=np.int64), 0)


def _meets(boundary: Boundary, cell: Cell) -> NDArray[np.int64]:
    """Of the cell's elements those that may meet the closed cell."""
    which = cell.elements
    box = (boundary.low[which] <= cell.centre + cell.half) & (
        boundary.high[which] >= cell.centre - cell.half
    )
    which = which[box.all(axis=1)]
    if not len(which):
        return np.asarray(which)
    corners = boundary.corners[which] - cell.centre
    edges = (
        np.roll(corners, -1, axis=1) - corners
        if boundary.dim == 3
        else corners[:, 1:] - corners[:, :1]
    )
    far = np.linalg.norm(corners, axis=2).max(axis=1) + cell.half
    length = np.linalg.norm(edges, axis=2)
    if boundary.dim == 2:
        axes = np.stack([-edges[..., 1], edges[..., 0]], axis=2)
        error = MARGIN * length * far[:, None]
    else:
        axes = np.zeros((len(which), 10, 3))
        axes[:, 0] = np.cross(edges[:, 0], edges[:, 1])
        for k in range(3):  # the k-th unit vector times each edge
            i, j = (k + 1) % 3, (k + 2) % 3
            axes[:, 3 * k + 1 : 3 * k + 4, i] = -edges[..., j]
            axes[:, 3 * k + 1 : 3 * k + 4, j] = edges[..., i]
        error = (
            MARGIN
            * far[:, None]
            * np.concatenate([length[:, :1] * length[:, 1:2], length, length, length], axis=1)
        )
    along = np.einsum("nac,nvc->nav", axes, corners)
    reach = cell.half * abs(axes).sum(axis=2) + error
    apart = (along.min(axis=2) > reach) | (along.max(axis=2) < -reach)
    return np.asarray(which[~apart.any(axis=1)])


def _held(cell: Cell, rows: Floats) -> NDArray[np.bool_]:
    """Which balls surely hold all of the closed cell?"""
    far = np.sqrt(((abs(rows[:, :-1] - cell.centre) + cell.half) ** 2).sum(axis=1))
    return np.asarray(far <= rows[:, -1] * HELD)


def _meeting(cell: Cell, rows: Floats, which: NDArray[np.int64]) -> NDArray[np.int64]:
    """Of these balls those that may meet the cell."""
    part = rows[which]
    near = np.maximum(abs(part[:, :-1] - cell.centre) - cell.half, 0)
    return np.asarray(which[(near**2).sum(axis=1) <= part[:, -1] ** 2 * (1 + 1e-9)])


def _children(cell: Cell, elements: NDArray[np.int64], balls: NDArray[np.int64]) -> list[Cell]:
    half = cell.half / 2
    dim = len(cell.centre)
    return [
        Cell(
            cell.centre + half * np.array([1 if k >> i & 1 else -1 for i in range(dim)]),
            half,
            elements,
            balls,
            cell.depth + 1,
        )
        for k in range(1 << dim)
    ]


def uncovered(
    boundary: Boundary, rows: Floats, leaf: float, first: bool = False, most: int = 2_000_000
) -> list[Cell]:
    """The cells with a half diagonal of at most `leaf` that may hold a point of the solid and that
    no ball holds. Empty: the balls cover the solid, proved. first: one such cell is enough."""
    start = root(boundary)
    start.balls = np.arange(len(rows))
    if leaf < start.half * 2.0**-20:
        raise SolidError("the tolerance is too small for the solid's size")
    stack, open_cells, seen = [start], [], 0
    factor = math.sqrt(boundary.dim)
    while stack:
        cell = stack.pop()
        seen += 1
        if seen > most:
            raise SolidError("the tolerance is too small: more than two million cells")
        balls = _meeting(cell, rows, cell.balls)
        if _held(cell, rows[balls]).any():
            continue
        elements = _meets(boundary, cell) if len(cell.elements) else cell.elements
        if not len(elements) and len(cell.elements) and boundary.surely_outside(cell.centre):
            continue  # below a cell without elements all is inside: nothing to ask again
        if cell.half * factor <= leaf:
            open_cells.append(cell)
            if first:
                break
        else:
            stack.extend(_children(cell, elements, balls))
    return open_cells


def complete(boundary: Boundary, rows: Floats, tolerance: float) -> Floats:
    """The balls given, and as many more as cover the solid with them, proved. No point of those
    is farther than `tolerance` from the solid."""
    leaf = 0.4 * tolerance
    radius = (tolerance - leaf) * (1 - 1e-9)  # more than the leaf: such a ball holds its own cell
    added: list[Floats] = []
    for cell in uncovered(boundary, rows, leaf):
        if not added or not _held(cell, np.array(added)).any():
            added.append(np.append(cell.centre, radius))
            if not _held(cell, added[-1][None])[0]:
                raise SolidError(
                    "the cover could not be completed. This is a bug; please report the solid"
                )
    return np.vstack([rows, *added])
