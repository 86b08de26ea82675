/* barrier: proofs that a component of one slice and one of its neighbour are apart. */
#ifndef CAGE_BARRIER_H
#define CAGE_BARRIER_H

#include "view.h"

struct cage_mover;

struct cage_barrier {
    struct cage_mover *mover; /* each site of c on its way to d */
    int32_t *reached; /* for each simplex of c: the last spread that reached it */
    int32_t *queue;   /* those that it reached, in their order */
    int8_t *solid;    /* for each simplex of c: see barrier.c; -1: not known */
    int32_t length;   /* of the queue */
    int32_t spreads;  /* number of the last spread */
    int32_t from;     /* the component it was of */
    bool far;         /* the balls move so far that little can be proved */
    bool outer;       /* whether it reached a simplex with a sentinel, or (of a small component) very many, and then went no further */
};

/* At view->barrier, taken from the arena. match: see cage_view_make. */
int32_t cage_barrier_make(struct cage_arena *arena, const int32_t *match, struct cage_view *view);

/* Are component k of c and l of d, not both outsides, proved to be apart? Best asked for all l of one k in turn. */
bool cage_barrier_is_apart(const struct cage_view *view, int32_t k, int32_t l);

#endif
