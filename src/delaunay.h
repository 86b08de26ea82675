/* delaunay: the weighted Delaunay (regular) triangulation of balls, in the plane or in space. */
#ifndef CAGE_DELAUNAY_H
#define CAGE_DELAUNAY_H

#include "arena.h"
#include "cage.h"
#include "predicate.h"
#include "shortcuts.h"

/* A positive simplex. v: dim + 1 sites. twin[i] = 4 s + j: facet i (opposite v[i]) is facet j of simplex s; CAGE_HULL
 * for a facet of the sentinels' own simplex. In the plane entry 3 is unused. */
struct cage_simplex {
    int32_t v[4];
    int32_t twin[4];
};

#define CAGE_HULL (-1)

/* Sites 0..dim are the sentinels: weight -1, at +-M around everything, so their power is positive everywhere
 * and they add nothing to the union. The others are balls in the order of insertion, which is the order of the
 * tie rule (see cage_conflict). A ball that is hidden is a site in no simplex. */
struct cage_triangulation {
    struct cage_site *site;
    int32_t *ball; /* ball[i]: index of site i in the input, -1 for a sentinel */
    struct cage_simplex *simplex;
    const struct cage_shortcuts *shortcuts; /* that were used, or null */
    int32_t dim;
    int32_t sites; /* dim + 1 + count */
    int32_t simplices;
};

/* Triangulate count balls, |centre coordinate| <= CAGE_REACH, 0 <= r <= CAGE_REACH (not checked). The result
 * is taken from the arena, everything else given back; on CAGE_ERROR_MEMORY all is, and arena->needed says how large
 * the arena would have to be (a guess in space). */
int32_t cage_delaunay(struct cage_arena *arena, const struct cage_shortcuts *shortcuts, int32_t dim, const cage_ball *ball,
                      int32_t count, struct cage_triangulation *out);

/* Drop the hidden sites, which add nothing to the union; the others keep their order. Needs scratch of the arena. */
int32_t cage_delaunay_drop_hidden(struct cage_arena *arena, struct cage_triangulation *t);

/* Insert more sites after those of a triangulation (one of cage_delaunay, not itself extended). Simplices that remain
 * keep their places; a place with v[0] = -1 is no simplex; the others are new and have a new site. out->ball is null. */
int32_t cage_delaunay_extend(struct cage_arena *arena, const struct cage_triangulation *t, const struct cage_site *const *more,
                             int32_t count, struct cage_triangulation *out);

/* The simplex that contains the grid point, which lies inside the sentinels' simplex; on a facet either will do. */
int32_t cage_delaunay_locate(const struct cage_triangulation *t, const int32_t p[3], int32_t hint);

/* The same for an orthocentre; -1 when it lies outside the sentinels' simplex. */
int32_t cage_delaunay_locate_centre(const struct cage_triangulation *t, const struct cage_centre *centre, int32_t hint);

/* The sites of simplex s, and of its facet i in the order of CAGE_FACE_.. */
void cage_simplex_sites(const struct cage_triangulation *t, int32_t s, const struct cage_site *v[4]);
void cage_facet_sites(const struct cage_triangulation *t, int32_t s, int32_t i, const struct cage_site *face[3]);

#endif
