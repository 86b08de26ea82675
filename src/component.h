/* component: the connected components of the complement of a union of balls, from its triangulation. */
#ifndef CAGE_COMPONENT_H
#define CAGE_COMPONENT_H

#include "delaunay.h"

#define CAGE_COVERED (-1) /* label of a simplex that is not free */
#define CAGE_OUTSIDE 0    /* label of the unbounded component, which always exists */

/* label: one for each simplex: CAGE_COVERED, or its component 0..count-1; others than the outside in the order of
 * their first simplex. deep: for each component its largest simplex without sentinels (of the outside the first), or -1. */
struct cage_components {
    int32_t *label;
    int32_t *deep;
    int32_t count;
};

/* The two arrays are taken from the arena. */
int32_t cage_components(struct cage_arena *arena, const struct cage_triangulation *t, struct cage_components *out);

/* A point of bounded component k: the orthocentre of its largest simplex. */
void cage_component_point(const struct cage_triangulation *t, const struct cage_components *c, int32_t k, struct cage_centre *out);

/* Components k with now[k] = CAGE_COVERED become covered, and the others move up. */
void cage_components_drop(const struct cage_triangulation *t, int32_t *now, struct cage_components *c);

/* Is the simplex free? */
bool cage_component_free(const struct cage_triangulation *t, int32_t s);

/* Is facet i of the free simplex s, between it and another free one, a wall? */
bool cage_component_wall(const struct cage_triangulation *t, int32_t s, int32_t i);

/* Does a sentinel belong to the simplex? */
bool cage_simplex_outer(const struct cage_triangulation *t, int32_t s);

#endif
