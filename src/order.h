/* order: the order in which balls are inserted: rounds of growing size, each along a Hilbert curve. */
#ifndef CAGE_ORDER_H
#define CAGE_ORDER_H

#include "arena.h"
#include "cage.h"

/* order[0..count) becomes a permutation of 0..count-1, a function of the balls alone. Two scratch arrays of count
 * entries are taken from the arena and given back. */
int32_t cage_order(struct cage_arena *arena, int32_t dim, const cage_ball *ball, int32_t count, int32_t *order);

#endif
