/* barrier: proofs that a component of one slice and one of its neighbour are apart, or share a point. */
#ifndef CAGE_BARRIER_H
#define CAGE_BARRIER_H

#include "slice.h"

struct cage_mover;

/* Two slices of the same side of one scene, seen from the first. */
struct cage_view {
    const struct cage_slice *c, *d;
    struct cage_mover *mover; /* each site of c on its way to d */
    int32_t *reached;       /* for each simplex of c: the last spread that reached it */
    int32_t *queue;         /* those that it reached, in their order */
    int8_t *solid;          /* for each simplex of c: see barrier.c; -1: not known */
    int32_t *home;          /* for each component of d: the simplex of c that holds its point; -1: none, -2: not looked for */
    int8_t *off;   /* for each component of d: is its point off all balls of c? -1: not known */
    int32_t length;  /* of the queue */
    int32_t spreads; /* number of the last spread */
    int32_t from;    /* the component it was of */
    bool far;        /* the balls move so far that little can be proved */
    bool outer;      /* whether it reached a simplex with a sentinel, or (of a small component) very many, and then went no further */
};

/* match: see cage_glue_matched; any balls that are as large will do. */
int32_t cage_view_make(struct cage_arena *arena, const struct cage_slice *c, const struct cage_slice *d, const int32_t *match,
                       struct cage_view *view);

/* Are component k of c and l of d, not both outsides, proved to be apart? Best asked for all l of one k in turn. */
bool cage_view_is_apart(struct cage_view *view, int32_t k, int32_t l);

/* Is a known point of one of them in the other too? x becomes that point. Two outsides always touch. */
bool cage_view_is_touching(struct cage_view *view, int32_t k, int32_t l, int32_t x[3]);

#endif
