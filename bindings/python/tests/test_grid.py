"""Doubles go to the grid on the safe side: decided in Fractions, with balls beside it by an ulp."""

from fractions import Fraction

import numpy as np
import pytest

from libcage import Balls
from libcage.balls import to_grid


def fraction(values):
    return [Fraction(float(value)) for value in values]


@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("unit", [2.0**-20, 1.0, 2.0**30])
def test_inner_balls_lie_inside_and_outer_ones_cover(dim, unit):
    rng = np.random.default_rng(dim)
    rows = rng.uniform(-50, 50, (400, dim + 1)) * unit
    rows[:, -1] = abs(rows[:, -1]) * rng.choice([1e-3, 0.05, 1], 400)
    rows[100:200, :-1] = np.rint(rows[100:200, :-1] / unit) * unit + 0.5 * unit  # halfway
    rows[200:300] = np.rint(rows[200:300] / unit) * unit  # on the grid
    rows[300:] = np.nextafter(np.rint(rows[300:] / unit) * unit, np.inf)  # beside it by an ulp
    rows[398], rows[398, -1], rows[399] = 0, 5e-324, 5e-324
    on_grid = 0
    for row in rows:
        inner, outer = to_grid(Balls(row[None]), unit)
        centre, r = fraction(row[:-1]), Fraction(float(row[-1]))
        for grid, sign in ((inner, 1), (outer, -1)):
            if not len(grid):
                continue
            assert (grid[:, dim:3] == 0).all()
            placed = [Fraction(int(v)) * Fraction(unit) for v in grid[0]]
            moved2 = sum((a - b) ** 2 for a, b in zip(centre, placed))
            slack = sign * (r - placed[3])
            assert slack >= 0 and slack**2 >= moved2
            assert slack < 3 * Fraction(unit)
        on_grid += len(inner) == 1 and np.array_equal(inner, outer)
    assert on_grid >= 100  # what is on the grid stays as it is
