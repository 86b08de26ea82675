/* mixture: the balls of one slice, and those around a component of its neighbour, triangulated together. */
#ifndef CAGE_MIXTURE_H
#define CAGE_MIXTURE_H

#include "barrier.h"
#include "box.h"

/* For component K of c: the balls of d and those of c that are vertices of K's simplices. */
struct cage_mixture {
    struct cage_triangulation t;
    bool apart; /* a ball of d holds all of K: there is no triangulation, and nothing to be found */
    bool local; /* only those balls of d that may meet K: t.ball[site] < old; else the sites of d are t's first, < old */
    bool boxed; /* K lies in the box */
    int32_t old;
    struct cage_box box;
};

/* In the arena. view: from c to d. */
int32_t cage_mixture_make(struct cage_arena *arena, struct cage_view *view, int32_t k, struct cage_mixture *m);

/* Has the simplex a vertex of c? */
bool cage_mixture_is_new(const struct cage_mixture *m, int32_t s);

/* Could the witness of this component of d be in K? */
bool cage_mixture_may_hold(const struct cage_mixture *m, const struct cage_region *region);

#endif
