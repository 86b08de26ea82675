/* so2: the rotations of the plane as a fibre: arcs of the circle of half angles.
 *
 * Half angles modulo 180 degrees, as quaternions (w, z) on two faces of the square max(|w|, |z|) = 1: w = 1 and z = 1
 * (turned by 90 degrees of half angle). On a face runs t in [-1, 1], taken to t (|t| + 2) / 3 so that cells of one
 * level turn by nearly the same angle. Along the circle the cells of level L are numbered 0..2^(L+1) - 1. */
#include "fibre.h"
#include "grid.h"

enum { SO2_LEVEL_MAX = 14, CIRCLE = 2 << SO2_LEVEL_MAX };

/* The rotation at t = m / 2^level on a face, |m| <= 2^level: entries <= 3 4^14 < 2^30. */
static void so2_quaternion_at(int32_t face, int32_t level, int32_t m, int32_t q[4])
{
    int32_t one = (int32_t)1 << level, size = m < 0 ? -m : m;
    int32_t w = 3 * one * one, z = m * (size + 2 * one);
    q[0] = face == 0 ? w : -z;
    q[1] = q[2] = 0;
    q[3] = face == 0 ? z : w;
}

/* end 0: the first rotation of the cell, 1: its representative, 2: its last. */
static void so2_cell_rotation(const struct cage_cell *cell, int32_t end, int32_t q[4])
{
    so2_quaternion_at(cell->face, cell->level, 2 * cell->at[0] + end - ((int32_t)1 << cell->level), q);
}

/* The cell as an arc [first, first + length] of a circle of CIRCLE units. */
static int32_t arc(const struct cage_cell *cell, int32_t *length)
{
    *length = (int32_t)1 << (SO2_LEVEL_MAX - cell->level);
    return ((cell->face << cell->level) + cell->at[0]) * *length;
}

/* Modulo the circle, a power of two. */
static int32_t around(int32_t turn) { return turn & (CIRCLE - 1); }

static void so2_child(const struct cage_cell *cell, int32_t index, struct cage_cell *out)
{
    *out = *cell;
    out->level++;
    out->at[0] = 2 * cell->at[0] + index;
}

static bool so2_touch(const struct cage_cell *a, const struct cage_cell *b)
{
    int32_t a_length, b_length, a_first = arc(a, &a_length), b_first = arc(b, &b_length);
    return around(b_first - a_first) <= a_length || around(a_first - b_first) <= b_length;
}

/* The sign of the turn from a to b by less than 180 degrees of half angle: |entries| <= 2^30, value <= 2^61. */
static int32_t turn_sign(const int32_t a[4], const int32_t b[4])
{
    int64_t cross = (int64_t)a[0] * b[3] - (int64_t)a[3] * b[0];
    return (cross > 0) - (cross < 0);
}

static bool so2_contains(const struct cage_cell *cell, const int32_t q[4])
{
    int32_t first[4], last[4];
    so2_cell_rotation(cell, 0, first);
    so2_cell_rotation(cell, 2, last);
    int32_t after = turn_sign(first, q), before = turn_sign(q, last);
    /* q and -q are the same rotation; the cell spans at most 90 degrees of half angle. */
    return (after >= 0 && before >= 0) || (after <= 0 && before <= 0);
}

static void so2_representative(const struct cage_cell *cell, int32_t q[4])
{
    so2_cell_rotation(cell, 1, q);
}

static int32_t so2_corners(const struct cage_cell *cell, int32_t q[8][4])
{
    so2_cell_rotation(cell, 0, q[0]);
    so2_cell_rotation(cell, 2, q[1]);
    return 2;
}

static int64_t so2_turn(const struct cage_cell *cell)
{
    int32_t first[4], middle[4], last[4];
    so2_cell_rotation(cell, 0, first);
    so2_cell_rotation(cell, 1, middle);
    so2_cell_rotation(cell, 2, last);
    int64_t a = cage_turn(middle, first), b = cage_turn(middle, last);
    return a > b ? a : b;
}

static void so2_common(const struct cage_cell *a, const struct cage_cell *b, int32_t q[4])
{
    int32_t length, first = arc(a, &length), unused, b_first = arc(b, &unused);
    so2_cell_rotation(a, around(b_first - first) == length ? 2 : 0, q);
}

const struct cage_fibre cage_so2 = {2, 2, SO2_LEVEL_MAX,
                                    so2_child, so2_touch, so2_contains, so2_representative, so2_turn, so2_corners, so2_common};
