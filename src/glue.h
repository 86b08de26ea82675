/* glue: which components of neighbouring slices share a point. */
#ifndef CAGE_GLUE_H
#define CAGE_GLUE_H

#include "slice.h"

/* Component k of the first slice and l of the second have a point in common; x is one of them, or for a component
 * thinner than the grid one less than 1 unit away (0.71, 0.87). */
struct cage_touch {
    int32_t k, l;
    int32_t x[3];
};

/* The touching pairs of components of two slices of the same side of one scene, exact, each once: all of them if seed
 * is CAGE_ALL, else those of component `seed` of c, and of the ones that it is connected with, in turn, by such
 * pairs; but not those of an outside reached in this way, which has too many. *touch is taken from the arena. *mixed:
 * whether a triangulation of balls of both slices was needed. */
int32_t cage_glue(struct cage_arena *arena, const struct cage_slice *c, const struct cage_slice *d, int32_t seed,
                  struct cage_touch **touch, int32_t *count, int32_t *mixed);

/* The same where object ball i of c is nearest to ball match[i] of d, which is as large; null: to itself. Never matters to the
 * answer, but to how soon it is found. */
int32_t cage_glue_matched(struct cage_arena *arena, const struct cage_slice *c, const struct cage_slice *d, const int32_t *match,
                          int32_t seed, struct cage_touch **touch, int32_t *count, int32_t *mixed);

#define CAGE_ALL (-1)

#endif
