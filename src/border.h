/* border: leave out balls that meet no border of the free space, once a triangulation of all has told which these are.
 *
 * The vertices of a component's simplices are all balls that meet its border (mixture.c), so it is a component of the complement of
 * these alone. Any other component of that complement lies within the balls that are left out, and so does any point of it. */
#ifndef CAGE_BORDER_H
#define CAGE_BORDER_H

#include "component.h"

/* Of the count balls that were triangulated, those that meet a border come first now, with their entries of `of`; their number. */
int32_t cage_border_first(const struct cage_triangulation *t, const struct cage_components *c, cage_ball *ball, int32_t *of,
                          int32_t count);

/* Components in the triangulation of the first `kept` of them that are none of all balls become covered; the others move up. Needs
 * scratch of the arena. */
int32_t cage_border_drop(struct cage_arena *arena, const struct cage_triangulation *t, const cage_ball *ball, int32_t kept,
                         int32_t count, struct cage_components *c);

#endif
