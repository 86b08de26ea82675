/* grid: the only file that rounds: rotations, centres, radii inward or outward. */
#ifndef CAGE_GRID_H
#define CAGE_GRID_H

#include "predicate.h"

/* A rotation matrix in units of 2^-62, each entry to nearest. */
struct cage_rotation {
    int64_t m[3][3];
};

/* |q|^2, at most 2^62 (entries of q at most 2^30 in magnitude), and a row of the rotation's matrix times that, exact: entries at
 * most |q|^2. */
int64_t cage_rotation_norm(const int32_t q[4]);
void cage_rotation_row(const int32_t q[4], int32_t i, int64_t row[3]);

/* From a quaternion that is not 0, entries at most 2^30 in magnitude. Exact for the quarter turns about the axes. */
void cage_rotation_of(const int32_t q[4], struct cage_rotation *rotation);

/* R y, |y| <= 2^29, each coordinate rounded to nearest once: each is off by at most 1/2 + 2^-31, the point by less
 * than 0.71 in the plane and 0.87 in space. */
void cage_rotate(const struct cage_rotation *rotation, const int32_t y[3], int32_t out[3]);

/* A rotation's matrix in units of 2^-30, each entry off by less than 2.5 of them: for where something is about. */
struct cage_rough {
    int32_t m[3][3];
};

void cage_rough_of(const int32_t q[4], struct cage_rough *rough);

/* R y, entries of y at most 2^28: each coordinate is off by less than 3 times 2.5 2^28 / 2^30, and 1/2: by less than 2.4. (In the
 * plane 1.8, the point by less than 2.5; in space, where an object reaches 2^23 at most, the point by less than 1.) */
void cage_rough_rotate(const struct cage_rough *rough, const int32_t y[3], int32_t out[3]);

/* Twice the sine of the angle between two quaternions (that is, the largest |R y - R' y| / |y|), in units of 2^-31,
 * rounded up: at most 2^32 + 17. Only for angles up to 90 degrees is the sine monotone; callers stay below. */
int64_t cage_turn(const int32_t q[4], const int32_t other[4]);

/* An upper bound of turn times reach, in grid units: 0 <= reach <= 2^29. */
int32_t cage_displacement(int64_t turn, int32_t reach);

/* The corners of a cell of space's rotations, seen from its representative: the vector part of conj(q) q_k divided by
 * its real part, in units of 2^-30, off by less than 2^-27. */
struct cage_corners {
    int64_t u[8][3];
};

/* q_k within 60 degrees of q, as quaternions; entries at most 2^24. */
void cage_corners_of(const int32_t q[4], int32_t corner[8][4], struct cage_corners *out);

/* An upper bound of |R y - R_c y| for the rotations R in the cell: 2 |y| r / sqrt(1 + r^2), where r is the largest
 * distance of a corner from the axis along y when the cell is projected from the centre of the sphere of quaternions
 * to the plane that touches it at the representative. (There the cell is a polytope, the distance from an axis is
 * convex, and the rotation at u moves y by 2 |u_perp| |y| / sqrt(1 + |u|^2).) |y| <= 2^21. At most cage_displacement
 * of the cell's turn, plus 2. */
int32_t cage_displacement_within(const struct cage_corners *corners, const int32_t y[3]);

/* The grid point nearest to an orthocentre, off by at most 1/2 on each axis; false: it is beyond CAGE_REACH. */
bool cage_centre_point(int32_t dim, const struct cage_centre *centre, int32_t at[3]);

/* |v| rounded up, entries at most 2^29. */
int32_t cage_length(const int32_t v[3]);

/* What rounding may cost, in grid units. A collision ball's centre is off by less than 0.71 (0.87), and so is
 * a query that was rounded to the grid: together less than 2. So an inner ball of radius R + r - d - 2
 * lies strictly inside the collision space, and still does when the rounded query stands for the true one: the segment
 * between the two meets no inner ball. On the outer side way points are rounded too, and the check of the path
 * rounds for itself: 8 covers all of it. */
#define CAGE_SLACK_INNER 2
#define CAGE_SLACK_OUTER 8

/* What the displacement d changes in the radius R + r of a collision ball; sign -1: inner, +1: outer. |change| < 2^30 + 14. */
int32_t cage_radius_change(int32_t displacement, int32_t sign);

#endif
