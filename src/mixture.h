/* mixture: the balls of one slice, and those around a component of its neighbour, triangulated together. */
#ifndef CAGE_MIXTURE_H
#define CAGE_MIXTURE_H

#include "box.h"
#include "slice.h"

/* For component K of c, a slice d and boxes: the balls of d, and those of c that are vertices of K's simplices and meet a box. */
struct cage_mixture {
    struct cage_triangulation t;
    bool local; /* only those balls of d that meet a box: t.ball[site] < old; else the sites of d are t's first, < old */
    int32_t old;
};

/* In the arena. */
int32_t cage_mixture_make(struct cage_arena *arena, const struct cage_slice *c, int32_t k, const struct cage_slice *d,
                          const struct cage_box *box, int32_t boxes, struct cage_mixture *m);

/* Has the simplex a vertex of c? */
bool cage_mixture_is_new(const struct cage_mixture *m, int32_t s);

#endif
