/* arcs.c: the cells of the plane's rotations once more, from the design's formula, in exact integers. */
#include "arcs.h"

/* On face 0 the quaternion (1, s), on face 1 (-s, 1), with s = t (|t| + 2) / 3 and t = -1 + 2 (at + end) / 2^level. */
struct arc_rotation arc_end(const struct cage_cell *cell, int end)
{
    int64_t one = (int64_t)1 << cell->level, t = 2 * ((int64_t)cell->at[0] + end) - one;
    int64_t s = t * ((t < 0 ? -t : t) + 2 * one), whole = 3 * one * one;
    struct arc_rotation face0 = {whole, s}, face1 = {-s, whole};
    return cell->face == 0 ? face0 : face1;
}

static int64_t cross(struct arc_rotation a, struct arc_rotation b) { return a.w * b.z - a.z * b.w; }

bool arc_same(struct arc_rotation a, struct arc_rotation b) { return cross(a, b) == 0; }

bool arc_holds(const struct cage_cell *cell, struct arc_rotation q)
{
    struct arc_rotation first = arc_end(cell, 0), last = arc_end(cell, 1), minus = {-q.w, -q.z};
    /* The cell is less than half of the half angles' circle: inside is left of its first and right of its last end. */
    return (cross(first, q) >= 0 && cross(q, last) >= 0) || (cross(first, minus) >= 0 && cross(minus, last) >= 0);
}

bool arc_touch(const struct cage_cell *a, const struct cage_cell *b)
{
    for (int end = 0; end < 2; end++)
        if (arc_holds(a, arc_end(b, end)) || arc_holds(b, arc_end(a, end)))
            return true;
    return false;
}
