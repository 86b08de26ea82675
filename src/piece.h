/* piece: a convex set that holds those points of a component that lie in one of its simplices. */
#ifndef CAGE_PIECE_H
#define CAGE_PIECE_H

#include "component.h"

enum { CAGE_DIRECTIONS_2D = 4, CAGE_DIRECTIONS = 13 };

/* Bounds along x, y, x + y, x - y, and in space along z, x + z, x - z, y + z, y - z, x + y + z, -x + y + z, x - y + z, x + y - z.
 * At most 2^30 in the plane, 3 2^24 in space. */
struct cage_bounds {
    int32_t low[CAGE_DIRECTIONS], high[CAGE_DIRECTIONS];
};

enum { CAGE_ALONG_X = 0, CAGE_ALONG_Y = 1, CAGE_ALONG_Z = 4 };

/* A ball that holds them, about the grid point nearest to the orthocentre; radius -1: none was found. */
struct cage_orthoball {
    int32_t simplex;
    int32_t at[3];
    int32_t radius;
};

/* A direction across a facet, and the piece's bounds along it. */
struct cage_face {
    int32_t normal[3];
    int32_t length;
    int64_t low, high;
};

/* The simplex as far as it is within the ball. */
struct cage_piece {
    const struct cage_triangulation *t;
    struct cage_orthoball ball;
    struct cage_bounds bounds;
    struct cage_face face[4]; /* see cage_piece_faces */
    int32_t first;            /* the direction along which others are best compared with it */
    int32_t faces;            /* 0: not looked for */
};

/* Of free simplex s. */
void cage_orthoball_of(const struct cage_triangulation *t, int32_t s, struct cage_orthoball *out);

/* Is the ball's centre surely off all balls of the triangulation, if none is larger than that? */
bool cage_orthoball_is_off(const struct cage_triangulation *t, const struct cage_orthoball *ball, int32_t radius);

/* What its simplex and the ball bound. */
void cage_bounds_of(const struct cage_triangulation *t, const struct cage_orthoball *ball, struct cage_bounds *out);

/* The bounds of no points at all; and widened to hold the other's too. */
void cage_bounds_none(struct cage_bounds *bounds);
void cage_bounds_add(int32_t dim, struct cage_bounds *bounds, const struct cage_bounds *other);

/* Widened by so many units along every direction. */
void cage_bounds_widen(int32_t dim, struct cage_bounds *bounds, int32_t by);

/* A bit for each bound that the site is not within, and CAGE_CODE_KNOWN: where those of all vertices of a simplex have one more in
 * common, it does not meet what is within the bounds. */
#define CAGE_CODE_KNOWN 1u
uint32_t cage_bounds_code(int32_t dim, const struct cage_bounds *bounds, const struct cage_site *site);

/* May the two have inner points in common? */
bool cage_bounds_meet(int32_t dim, const struct cage_bounds *a, const struct cage_bounds *b);

void cage_piece_make(const struct cage_triangulation *t, const struct cage_orthoball *ball, struct cage_piece *out);

/* Does a plane (a line) along a facet of either lie between the two? Finds the faces when it has to. */
bool cage_piece_is_apart(struct cage_piece *a, struct cage_piece *b);

#endif
