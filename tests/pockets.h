/* pockets.h: scenes with a pair of rotations whose slices have many small components, next to contact, in the plane
 * and in space. */
#ifndef POCKETS_H
#define POCKETS_H

#include <stdio.h>

#include "slice.h"

enum { POCKETS_OBSTACLES = 40, POCKETS_OBJECT = 5 };

struct pockets {
    cage_ball object[POCKETS_OBJECT], obstacle[POCKETS_OBSTACLES];
    int32_t objects, obstacles;
    int32_t dim;
    int32_t sign;     /* the side that the radii are made for */
    int32_t pivot[3]; /* at times far away, so that the object's balls move far */
    struct cage_rotations at[2];
};

/* A function of the arguments alone; passes cage_scene_check. */
void pockets_make(int32_t dim, uint64_t seed, struct pockets *out);

/* The same; a few balls around a component thinner than the grid, and in one of the slices most of them are gone, as the
 * object's far balls shrink to nothing. */
void pockets_vanish(int32_t dim, uint64_t seed, struct pockets *out);

/* The side that it is made for. Points into p. */
void pockets_side(struct cage_arena *arena, const struct pockets *p, struct cage_side *side);

void pockets_print(FILE *file, const struct pockets *p);

#endif
