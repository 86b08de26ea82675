/* build: the working state of one triangulation while sites are inserted. */
#ifndef CAGE_BUILD_H
#define CAGE_BUILD_H

#include "delaunay.h"

struct cage_ridges;

/* Working state of one build. mark[s] = 2 p + conflict, for the last site p that was tested against s. */
struct cage_build {
    const struct cage_shortcuts *shortcuts;
    const struct cage_site *site;
    struct cage_simplex *simplex;
    int32_t *mark;
    int32_t *hole;  /* simplices in conflict */
    int32_t *front; /* facets between them and the others, as 4 s + i with s in the hole */
    struct cage_ridges *ridges; /* null: goes without, as in the plane */
    int32_t capacity;
    int32_t simplices; /* slots in use, dead ones included */
    int32_t dead;      /* first of a list of dead slots linked through v[1], or -1; a dead slot has v[0] = -1 */
    int32_t last;      /* a live simplex near the last insertion */
};

/* A front facet of the hole names the new simplex behind it in place of its twin. */
static CAGE_INLINE int32_t cage_front_code(int32_t fresh) { return -2 - fresh; }

#endif
