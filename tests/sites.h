/* sites.h: batches of sites that are hard for predicates: tiny, huge, on lattices, spheres, lines, and sentinels. */
#ifndef SITES_H
#define SITES_H

#include "predicate.h"

enum sites_kind {
    SITES_TINY,
    SITES_SPREAD,        /* every magnitude */
    SITES_FULL,          /* uniform over all that a ball may be */
    SITES_CORNERS,       /* all that a site may be: 0 or +-M, radius 0 or M, less 1 at times */
    SITES_LATTICE,       /* of a third of the range: many ties */
    SITES_THIN,          /* next to a line */
    SITES_COINCIDENT,    /* two positions */
    SITES_THROUGH_POINT, /* spheres through one point, at times 1 too large: powers at and next to 0 */
    SITES_IN_PLANE,      /* the same in one plane (in space) or on one line (in the plane), for facets */
    SITES_COSPHERICAL,   /* centres on one sphere, radius 0 or, seldom, 1 */
    SITES_SENTINELS,     /* half of them sentinels */
    SITES_KINDS
};

/* a^2 + b^2 + c^2 = d^2: [0] in the plane, c = 0, [1] in space. */
extern const int sites_pythagoras[2][6][4];

/* M of predicate.h. */
int64_t sites_largest(int dim);

/* The ball (x, y, z, r) as a site. */
struct cage_site sites_ball(int dim, int64_t x, int64_t y, int64_t z, int64_t r);

/* Sentinel number i, 0 to dim, as delaunay.h describes them: weight -1. */
struct cage_site sites_sentinel(int dim, int i);

/* count sites that share a point, a direction and a scale. */
void sites_make(uint64_t *state, int dim, enum sites_kind kind, int count, struct cage_site *out);

/* Is the weight of one of them negative? */
bool sites_sentinel_among(int count, const struct cage_site *const v[]);

/* Swap two of v[0..dim] if that makes the simplex positive; false when it is flat. */
bool sites_orient(int dim, const struct cage_site *v[4]);

#endif
