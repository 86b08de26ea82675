/* glued.h: which components of two slices share a point, found from all balls of both, without pruning, barriers and
 * local mixtures. */
#ifndef GLUED_H
#define GLUED_H

#include "glue.h"
#include "whole.h"

enum { GLUED_MOST = 256 };

/* A slice as the library makes it, and one of all balls; name[k]: the library's number of component k. */
struct glued {
    struct cage_slice slice;
    struct whole whole;
    int32_t name[GLUED_MOST];
};

/* The components of both are asserted to be the same, one to one. */
void glued_make(struct cage_arena *arena, const struct cage_side *side, const struct cage_rotations *rotations,
                struct glued *out);
void glued_free(struct glued *g);

/* The library's number of the component of a grid point, CAGE_COVERED in a closed ball. */
int32_t glued_locate(const struct glued *g, const int32_t p[3], int32_t *hint);

/* touch[k][l]: do component k of c and l of d share a point? Each component of the mixture of all balls is in one of
 * either, which is found in exact numbers. The number of pairs. */
int32_t glued_pairs(const struct glued *c, const struct glued *d, const struct whole *mixture,
                    bool touch[GLUED_MOST][GLUED_MOST]);

/* Is the pair there? At most once. */
bool glued_has(const struct cage_touch *touch, int32_t count, int32_t k, int32_t l);

/* These are the pairs, each once. */
void glued_check(const struct cage_touch *touch, int32_t count, bool wanted[GLUED_MOST][GLUED_MOST], int32_t pairs);

/* For each component of c, gluing with it as the seed gives the pairs of its group, as glue.h defines that, found from all
 * pairs; the number of pairs of all groups. */
int32_t glued_check_seeds(struct cage_arena *arena, const struct cage_slice *c, const struct cage_slice *d,
                          const struct cage_touch *all, int32_t count);

#endif
