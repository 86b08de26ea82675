/* ridges: new simplices in space find their neighbours by a table. */
#ifndef CAGE_RIDGES_H
#define CAGE_RIDGES_H

#include "build.h"

/* Bytes that the table takes from an arena, rounding included. */
size_t cage_ridges_size(int32_t sites);

/* Make it for so many sites, at b->ridges; false: no memory. */
bool cage_ridges_make(struct cage_arena *arena, struct cage_build *b, int32_t sites);

/* Link all new simplices: an edge of the front is an edge of two of its facets, once in either direction. False when the front has
 * too many sites for that. */
bool cage_ridges_link(struct cage_build *b, int32_t fronts);

#endif
