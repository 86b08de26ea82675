"""Does a set of balls cover a solid? Cells of a quadtree or octree tell, and where not, get a ball.

A cell is done when no element of the boundary meets it and it is outside, or when one ball holds
all of it. Both are decided on the safe side: the tests in doubles carry bounds of their rounding
errors, and where these leave it open the cell counts as met, or as not held. Whether a cell off the
boundary is inside is decided exactly. Cells of one size are worked on together, some thousands at
a time.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from ..errors import SolidError
from .exact import Boundary, Floats

HELD = 1 - 1e-12  # |corner - centre| in doubles is right to 1e-15 of itself: no cancellation in it
MARGIN = 1e-13  # of |edge| |edge| |distance|; the products below are right to 1e-14 of that
SMALLEST = 1e-60  # the cube of a cell's side, 2^-21 of this, is far from the least double
TOGETHER = 4096  # cells
PAIRS = 50_000  # of cells and elements in one array

Index = NDArray[np.int64]


@dataclass
class Cells:
    """Cubes of one size: centres, half a side, and pairs (cell, element) and (cell, ball) that may
    meet. `inside`: the cell is off the boundary, and inside."""

    centre: Floats
    half: float
    element: tuple[Index, Index]
    ball: tuple[Index, Index]
    inside: NDArray[np.bool_]

    def take(self, which: Index) -> Cells:
        """Some of the cells, in that order."""
        place = np.full(len(self.centre), -1)
        place[which] = np.arange(len(which))
        pairs = []
        for cell, other in (self.element, self.ball):
            stays = place[cell] >= 0
            pairs.append((place[cell[stays]], other[stays]))
        return Cells(self.centre[which], self.half, pairs[0], pairs[1], self.inside[which])


def root(boundary: Boundary, balls: int) -> Cells:
    """A cube around the solid whose halves, to depth 20, have exact doubles as corners."""
    if boundary.size < SMALLEST:
        raise SolidError(
            f"a solid of size {boundary.size:g} is too small for doubles: products of three "
            "lengths would vanish; use another unit of length"
        )
    low = boundary.low.min(axis=0)
    half = math.ldexp(1.0, math.frexp(boundary.size)[1])  # the side is more than twice the solid's
    step = half * 2.0**-22
    corner = np.floor(low / step) * step
    if (abs(corner) > half * 2.0**26).any():
        raise SolidError(
            "the solid is too far from the origin of its frame for its size: move it there"
        )
    elements, all_balls = np.arange(len(boundary.corners)), np.arange(balls)
    return Cells(
        (corner + half)[None],
        half,
        (np.zeros_like(elements), elements),
        (np.zeros_like(all_balls), all_balls),
        np.zeros(1, dtype=bool),
    )


def _apart(corners: Floats, half: float) -> NDArray[np.bool_]:
    """Which elements, seen from the centres of their cells, surely do not meet the closed cells?
    Separating axes: normals, and edges times the cell's; the cell's own were looked at before."""
    dim = corners.shape[2]
    far = np.linalg.norm(corners, axis=2).max(axis=1) + half
    if dim == 2:
        edges = corners[:, 1:] - corners[:, :1]
        axes = np.stack([-edges[..., 1], edges[..., 0]], axis=2)
        error = MARGIN * np.linalg.norm(edges, axis=2) * far[:, None]
    else:
        edges = np.roll(corners, -1, axis=1) - corners
        length = np.linalg.norm(edges, axis=2)
        axes = np.zeros((len(corners), 10, 3))
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
    along = axes @ corners.transpose(0, 2, 1)
    reach = half * abs(axes).sum(axis=2) + error
    outside = (along.min(axis=2) > reach) | (along.max(axis=2) < -reach)
    return np.asarray(outside.any(axis=1))


def _meeting(boundary: Boundary, cells: Cells) -> tuple[Index, Index]:
    """The pairs of cells and elements that may meet."""
    cell, element = cells.element
    near = (boundary.low[element] <= cells.centre[cell] + cells.half) & (
        boundary.high[element] >= cells.centre[cell] - cells.half
    )
    stays = near.all(axis=1)
    cell, element = cell[stays], element[stays]
    keep = np.ones(len(cell), dtype=bool)
    for i in range(0, len(cell), PAIRS):
        part = slice(i, i + PAIRS)
        corners = boundary.corners[element[part]] - cells.centre[cell[part], None]
        keep[part] = ~_apart(corners, cells.half)
    return cell[keep], element[keep]


def held(centre: Floats, half: float, rows: Floats) -> NDArray[np.bool_]:
    """Which balls surely hold all of their closed cells, or of one cell?"""
    far = np.sqrt(((abs(rows[:, :-1] - centre) + half) ** 2).sum(axis=1))
    return np.asarray(far <= rows[:, -1] * HELD)


def _without_held(cells: Cells, rows: Floats) -> Cells:
    """The cells that no ball holds, with the balls that may meet them."""
    cell, ball = cells.ball
    part = rows[ball]
    away = np.maximum(abs(part[:, :-1] - cells.centre[cell]) - cells.half, 0)
    near = (away**2).sum(axis=1) <= part[:, -1] ** 2 * (1 + 1e-9)
    whole = np.zeros(len(cells.centre), dtype=bool)
    whole[cell[held(cells.centre[cell], cells.half, part)]] = True
    cells.ball = (cell[near], ball[near])
    return cells.take(np.flatnonzero(~whole))


def _without_outside(boundary: Boundary, cells: Cells) -> Cells:
    """The cells that may hold a point of the solid."""
    cells.element = _meeting(boundary, cells)
    met = np.zeros(len(cells.centre), dtype=bool)
    met[cells.element[0]] = True
    stays = met | cells.inside
    free = np.flatnonzero(~stays)
    for group in _beside(cells.centre[free], cells.half):
        if not boundary.surely_outside(cells.centre[free[group[0]]]):
            stays[free[group]] = cells.inside[free[group]] = True
    return cells.take(np.flatnonzero(stays))


def _ranks(values: Index) -> Index:
    """Smaller numbers in the same order, of which two differ by one where the values do."""
    unique, index = np.unique(values, return_inverse=True)
    ranks = np.concatenate([[0], np.cumsum(np.minimum(np.diff(unique), 2))])
    return np.asarray(ranks[index.reshape(-1)])


def _beside(centre: Floats, half: float) -> list[Index]:
    """Cells of one size that share faces with others, in groups. Off the boundary a group is as a
    whole inside or outside: no chain of the boundary goes around one cell and not its neighbour."""
    if len(centre) < 2:
        return [np.arange(len(centre))] if len(centre) else []
    places = np.rint((centre - centre.min(axis=0)) / (2 * half)).astype(np.int64)  # exact
    place = np.stack([_ranks(column) for column in places.T], axis=1)
    size = place.max(axis=0) + 2
    key = np.ravel_multi_index(tuple(place.T), tuple(size))
    order = np.argsort(key)
    pairs = []
    for step in np.eye(place.shape[1], dtype=np.int64):
        beside = np.ravel_multi_index(tuple((place + step).T), tuple(size))
        at = np.minimum(np.searchsorted(key, beside, sorter=order), len(key) - 1)
        there = key[order[at]] == beside
        pairs.append(np.stack([np.flatnonzero(there), order[at[there]]]))
    one, other = np.concatenate(pairs, axis=1)
    graph = coo_matrix((np.ones(len(one)), (one, other)), shape=(len(key), len(key)))
    count, label = connected_components(graph, directed=False)
    by_label = np.argsort(label, kind="stable")
    return np.split(by_label, np.cumsum(np.bincount(label, minlength=count))[:-1])


def _children(cells: Cells) -> list[Cells]:
    """The halves in each direction, some thousands in one."""
    count, dim = cells.centre.shape
    half = cells.half / 2
    corners = np.array([[1 if k >> i & 1 else -1 for i in range(dim)] for k in range(1 << dim)])
    number = len(corners)
    element, ball = (
        ((cell[:, None] * number + np.arange(number)).ravel(), np.repeat(other, number))
        for cell, other in (cells.element, cells.ball)
    )
    centre = (cells.centre[:, None] + half * corners).reshape(-1, dim)
    made = Cells(centre, half, element, ball, np.repeat(cells.inside, number))
    if count * number <= TOGETHER:
        return [made]
    every = np.arange(count * number)
    return [made.take(every[i : i + TOGETHER]) for i in range(0, len(every), TOGETHER)]


def uncovered(
    boundary: Boundary, rows: Floats, leaf: float, first: bool = False, most: int = 20_000_000
) -> tuple[Floats, float]:
    """The cells with a half diagonal of at most `leaf` that may hold a point of the solid and that
    no ball holds: their centres, and half their side. None: the balls cover the solid, proved.

    first: some such cells are enough.
    """
    start = root(boundary, len(rows))
    if leaf < start.half * 2.0**-20:
        raise SolidError("the tolerance is too small for the solid's size")
    stack, found, seen, last = [start], [], 0, 0.0
    while stack:
        cells = stack.pop()
        seen += len(cells.centre)
        if seen > most:
            raise SolidError("the tolerance is too small: more than 20 million cells")
        cells = _without_outside(boundary, _without_held(cells, rows))
        if not len(cells.centre):
            continue
        if cells.half * math.sqrt(boundary.dim) > leaf:
            stack.extend(_children(cells))
            continue
        found.append(cells.centre)
        last = cells.half
        if first:
            break
    return (np.concatenate(found) if found else np.zeros((0, boundary.dim))), last


def complete(boundary: Boundary, rows: Floats, tolerance: float) -> Floats:
    """The balls given, and as many more as cover the solid with them, proved. No point of those is
    farther than `tolerance` from the solid."""
    leaf = 0.25 * tolerance
    radius = (tolerance - leaf) * (1 - 1e-9)  # more than the leaf: such a ball holds its own cell
    centres, half = uncovered(boundary, rows, leaf)
    added = np.zeros((len(centres), boundary.dim + 1))
    count = 0
    # A ball that holds a cell has its centre within a radius of the cell's, so in its box of that
    # size or in one beside it.
    boxes: dict[tuple[int, ...], list[int]] = {}
    beside = np.array(list(itertools.product((-1, 0, 1), repeat=boundary.dim)))
    places = np.floor((centres - boundary.low.min(axis=0)) / radius).astype(np.int64)
    for centre, place in zip(centres, places):
        around = map(tuple, (place + beside).tolist())
        near = [number for box in around for number in boxes.get(box, ())]
        if not held(centre, half, added[near]).any():
            added[count] = [*centre, radius]
            if not held(centre, half, added[count : count + 1])[0]:
                raise SolidError(
                    "the cover could not be completed. This is a bug; please report the solid"
                )
            boxes.setdefault(tuple(place.tolist()), []).append(count)
            count += 1
    return np.vstack([rows, added[:count]])
