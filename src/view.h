/* view: two slices of the same side of one scene, seen from the first, and where points of the second are in it. */
#ifndef CAGE_VIEW_H
#define CAGE_VIEW_H

#include "slice.h"

struct cage_barrier;

struct cage_view {
    const struct cage_slice *c, *d;
    struct cage_barrier *barrier; /* null: c was made without shortcuts */
    int32_t *home; /* for each component of d: the simplex of c that holds its point; -1: none, -2: not looked for */
    int8_t *off;   /* for each component of d: is its point off all balls of c? -1: not known */
};

/* match: see cage_glue_matched; any balls that are as large will do. */
int32_t cage_view_make(struct cage_arena *arena, const struct cage_slice *c, const struct cage_slice *d, const int32_t *match,
                       struct cage_view *view);

/* The simplex of c that holds the known point of component l of d; -1: there is none. */
int32_t cage_view_home(const struct cage_view *view, int32_t l);

/* Is that point off all balls of c? There is one. */
bool cage_view_is_off(const struct cage_view *view, int32_t l);

/* Is a known point of component k of c or l of d in the other too? x becomes that point. Two outsides always touch. */
bool cage_view_is_touching(const struct cage_view *view, int32_t k, int32_t l, int32_t x[3]);

#endif
