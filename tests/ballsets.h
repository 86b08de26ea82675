/* ballsets.h: sets of balls for triangulations: random, lattice, cospherical, flat, coincident, nested, huge, clustered. */
#ifndef BALLSETS_H
#define BALLSETS_H

#include "cage.h"

enum balls_kind {
    BALLS_RANDOM,      /* anywhere, moderate radii */
    BALLS_TINY,        /* coordinates -3..3: ties, coincidences, hidden balls */
    BALLS_LATTICE,     /* a block of the integer lattice, one radius: all ties */
    BALLS_WEIGHTED,    /* the same with three radii */
    BALLS_COSPHERICAL, /* integer points of one circle or sphere */
    BALLS_LINE,        /* all centres on one line */
    BALLS_PLANE,       /* on one plane; in the plane, on two lines */
    BALLS_COINCIDENT,  /* at five points */
    BALLS_NESTED,      /* most of them inside others */
    BALLS_HUGE,        /* radii up to all of the range */
    BALLS_CORNERS,     /* coordinates at the end of the range or 0 */
    BALLS_CLUSTERS,    /* translated copies of one small part, as in a slice */
    BALLS_KINDS
};

/* The largest coordinate and radius of a ball. */
int32_t balls_reach(int32_t dim);

/* Exactly count balls, a function of the arguments alone; z is 0 in the plane. */
void balls_make(enum balls_kind kind, int32_t dim, uint64_t seed, int32_t count, cage_ball *out);

const char *balls_text(enum balls_kind kind);

#endif
