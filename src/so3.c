/* so3: the rotations of space as a fibre: cells of the cube of quaternions.
 *
 * Quaternions up to sign and scale on four faces of the cube max(|w|, |x|, |y|, |z|) = 1: on face f entry f is 1, and
 * the other three, in their order, run t in [-1, 1], taken to t (|t| + 2) / 3 so that cells of one level turn by
 * nearly the same angle. A box of a face is a convex polytope of rotations, as central projection keeps lines: the
 * arc between two of its rotations stays inside, and the rotation farthest from the representative is a corner, at
 * most 60 degrees of half angle away. */
#include "fibre.h"
#include "grid.h"

/* The width of a face in cells of the finest level. */
enum { SO3_LEVEL_MAX = 11, SO3_WIDTH = 1 << SO3_LEVEL_MAX };

/* Entry of the quaternion that axis k of the face is. */
static int32_t entry_of_face(int32_t face, int32_t k) { return k < face ? k : k + 1; }

/* The rotation at t = m / one, |m| <= one <= 2^11: entries <= 3 4^11 < 2^24. */
static void so3_quaternion_at(int32_t face, int32_t one, const int32_t m[3], int32_t q[4])
{
    q[face] = 3 * one * one;
    for (int32_t k = 0; k < 3; k++)
        q[entry_of_face(face, k)] = m[k] * ((m[k] < 0 ? -m[k] : m[k]) + 2 * one);
}

static void so3_child(const struct cage_cell *cell, int32_t index, struct cage_cell *out)
{
    out->level = cell->level + 1;
    out->face = cell->face;
    for (int32_t k = 0; k < 3; k++)
        out->at[k] = 2 * cell->at[k] + (index >> k & 1);
}

struct range {
    int32_t low, high; /* 0..WIDTH */
};

/* Where the cell lies on the axis of that entry of the quaternion (not its face's), mirrored or not. */
static struct range range_of(const struct cage_cell *cell, int32_t entry, bool mirrored)
{
    int32_t size = SO3_WIDTH >> cell->level, low = cell->at[entry < cell->face ? entry : entry - 1] * size;
    struct range range = {mirrored ? SO3_WIDTH - low - size : low, mirrored ? SO3_WIDTH - low : low + size};
    return range;
}

static struct range overlap(struct range a, struct range b)
{
    struct range both = {a.low > b.low ? a.low : b.low, a.high < b.high ? a.high : b.high};
    return both;
}

/* The part that two cells share, in the entries of the first one's face; how many of its three ranges are longer than
 * a point, or -1 if there is none. On different faces f and g they meet where entries f and g are equal (sign 1) or
 * opposite (-1: the quaternion of one is minus that of the other, so entries are mirrored). */
static int32_t shared(const struct cage_cell *a, const struct cage_cell *b, int32_t sign, struct range part[3])
{
    int32_t lengths = 0;
    for (int32_t k = 0; k < 3; k++) {
        int32_t entry = entry_of_face(a->face, k);
        part[k] = range_of(a, entry, false);
        if (entry != b->face) {
            part[k] = overlap(part[k], range_of(b, entry, sign < 0));
        } else {
            const struct range end = {sign < 0 ? 0 : SO3_WIDTH, sign < 0 ? 0 : SO3_WIDTH}, other = range_of(b, a->face, false);
            part[k] = overlap(part[k], end);
            if (overlap(other, end).low > overlap(other, end).high)
                return -1;
        }
        if (part[k].low > part[k].high)
            return -1;
        lengths += part[k].low < part[k].high;
    }
    return lengths;
}

static bool so3_touch(const struct cage_cell *a, const struct cage_cell *b)
{
    struct range part[3];
    return shared(a, b, 1, part) >= 2 || (a->face != b->face && shared(a, b, -1, part) >= 2);
}

/* g(m / one) q_f <= q_k, g(t) = t (|t| + 2) / 3, q_f >= 0: terms <= 2^30 3 4^11 < 2^54. */
static bool below(int32_t m, int32_t one, int64_t on_face, int64_t other)
{
    return (int64_t)m * ((m < 0 ? -m : m) + 2 * one) * on_face <= other * 3 * one * one;
}

static bool so3_contains(const struct cage_cell *cell, const int32_t q[4])
{
    int64_t sign = q[cell->face] < 0 ? -1 : 1, on_face = sign * q[cell->face];
    int32_t one = (int32_t)1 << cell->level;
    for (int32_t k = 0; k < 3; k++) {
        int64_t other = sign * q[entry_of_face(cell->face, k)];
        int32_t low = 2 * cell->at[k] - one;
        if (!below(low, one, on_face, other) || !below(-low - 2, one, on_face, -other))
            return false;
    }
    return on_face > 0;
}

/* The rotation at `end` of the cell on each axis: 0 low, 1 middle, 2 high. */
static void so3_cell_rotation(const struct cage_cell *cell, const int32_t end[3], int32_t q[4])
{
    int32_t one = (int32_t)1 << cell->level, m[3];
    for (int32_t k = 0; k < 3; k++)
        m[k] = 2 * cell->at[k] + end[k] - one;
    so3_quaternion_at(cell->face, one, m, q);
}

static void so3_representative(const struct cage_cell *cell, int32_t q[4])
{
    const int32_t middle[3] = {1, 1, 1};
    so3_cell_rotation(cell, middle, q);
}

static int32_t so3_corners(const struct cage_cell *cell, int32_t q[8][4])
{
    for (int32_t i = 0; i < 8; i++) {
        const int32_t end[3] = {2 * (i & 1), i & 2, 2 * (i >> 2)};
        so3_cell_rotation(cell, end, q[i]);
    }
    return 8;
}

static int64_t so3_turn(const struct cage_cell *cell)
{
    int32_t middle[4], corner[8][4];
    int64_t most = 0;
    so3_representative(cell, middle);
    so3_corners(cell, corner);
    for (int32_t i = 0; i < 8; i++) {
        int64_t size = cage_turn(middle, corner[i]);
        most = size > most ? size : most;
    }
    return most;
}

static void so3_common(const struct cage_cell *a, const struct cage_cell *b, int32_t q[4])
{
    struct range part[3];
    int32_t m[3];
    if (shared(a, b, 1, part) < 2)
        shared(a, b, -1, part);
    for (int32_t k = 0; k < 3; k++)
        m[k] = part[k].low + part[k].high - SO3_WIDTH;
    so3_quaternion_at(a->face, SO3_WIDTH, m, q);
}

const struct cage_fibre cage_so3 = {4, 8, SO3_LEVEL_MAX,
                                    so3_child, so3_touch, so3_contains, so3_representative, so3_turn, so3_corners, so3_common};
