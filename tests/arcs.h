/* arcs.h: the cells of the plane's rotations once more, from the design's formula, in exact integers. */
#ifndef ARCS_H
#define ARCS_H

#include "fibre.h"

/* A rotation of the plane by 2 atan2(z, w). */
struct arc_rotation {
    int64_t w, z;
};

/* The first (end 0) or last (end 1) rotation of the cell: entries <= 3 4^14. */
struct arc_rotation arc_end(const struct cage_cell *cell, int end);
bool arc_same(struct arc_rotation a, struct arc_rotation b);

/* Is the rotation, entries <= 2^31, in the closed cell? */
bool arc_holds(const struct cage_cell *cell, struct arc_rotation q);

/* Have the closed cells a rotation in common? */
bool arc_touch(const struct cage_cell *a, const struct cage_cell *b);

#endif
