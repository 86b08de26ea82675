/* settle: do a component of one slice and one of its neighbour share a point? */
#ifndef CAGE_SETTLE_H
#define CAGE_SETTLE_H

#include "view.h"

/* Exact, for component k of the view's c and l of its d. *touching: they share a point, and x is one, or for a component thinner
 * than the grid one less than 1 unit away (0.71, 0.87). *mixed becomes 1 if a triangulation of balls of both was needed. */
int32_t cage_settle(struct cage_arena *arena, const struct cage_view *view, int32_t k, int32_t l, bool *touching, int32_t x[3],
                    int32_t *mixed);

#endif
