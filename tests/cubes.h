/* cubes.h: the cells of space's rotations once more: boxes on the boundary of the whole cube [-1, 1]^4, in exact integers. */
#ifndef CUBES_H
#define CUBES_H

#include "fibre.h"

/* What [-1, 1] is cut into at the finest level, 11. */
enum { CUBE_WIDTH = 2048 };

/* low[e]..high[e] on the axis of entry e of the quaternion, 0..CUBE_WIDTH. All eight faces of the cube are there, and
 * a point and its opposite are the same rotation. */
struct cube_box {
    int32_t low[4], high[4];
};

/* One of the cell's two boxes, on the side where the face's entry is 1. */
struct cube_box cube_of(const struct cage_cell *cell);

/* One of the two points of the rotation q, not 0, entries <= 2^30: on each axis the integers that it lies strictly between, or
 * the one that it is. */
struct cube_box cube_point(const int32_t q[4]);

/* Is the point in the closed cell? Is it, and on no facet of it? */
bool cube_holds(const struct cage_cell *cell, const struct cube_box *point);
bool cube_holds_within(const struct cage_cell *cell, const struct cube_box *point);

/* The dimension of what the closed cells share, -1 if nothing. *area: of the pieces of dimension 2, there can be two of them. */
int cube_shared(const struct cage_cell *a, const struct cage_cell *b, int64_t *area);

#endif
