/* complex.h: a triangulation as a set of simplices, found by its definition, compared, and checked part by part. */
#ifndef COMPLEX_H
#define COMPLEX_H

#include "delaunay.h"

/* Rows of dim + 1 ascending names, in ascending order; in the plane the last entry is -1. */
struct complex {
    int32_t (*row)[4];
    int32_t count;
};

/* A triangulation in a block of its own. */
struct built {
    struct cage_triangulation t;
    void *block;
};

/* Triangulate in a block large enough, filled with `dirt` first. */
void complex_build(int32_t dim, const cage_ball *ball, int32_t count, int dirt, struct built *out);
void complex_build_free(struct built *b);

/* The simplices of t; site s is called name[s]. */
void complex_of(const struct cage_triangulation *t, const int32_t *name, struct complex *out);

/* The definition: all positive simplices with every other site above them, by the tie rule of predicate.h. Of the
 * order of sites^(dim + 2). Sites are called by their number. */
void complex_define(int32_t dim, const struct cage_site *site, int32_t sites, struct complex *out);

bool complex_equal(const struct complex *a, const struct complex *b);
bool complex_has(const struct complex *c, const int32_t row[4]);
void complex_free(struct complex *c);

/* name[s] for every site: sentinels 0..dim, the ball of index b in the input dim + 1 + to[b], or + b where to is null. */
int32_t *complex_names(const struct cage_triangulation *t, const int32_t *to);

/* Assert all that delaunay.h promises of the triangulation of these balls, in exact numbers: the sites, positive
 * simplices, mutual twins, every facet locally convex, hidden balls above, Euler's relation, the volume. The number of ties
 * that the indices decided. */
long complex_validate(const struct cage_triangulation *t, const cage_ball *ball, int32_t count);

#endif
