/* prune: leave out balls that cannot touch the free space, before anything is triangulated.
 *
 * A raster of square pixels (cubes) is laid over all balls. A pixel that lies in a single ball is covered. A ball is kept iff
 * it may meet a pixel that is not covered. Then, exactly: every component of the complement of all balls is a component
 * of the complement of the kept ones. (It lies in uncovered closed pixels; on these the two unions agree; and
 * the border of a covered pixel lies in a ball that meets its uncovered neighbour too, hence is kept, so nothing leaks across.) The other
 * components of the kept balls lie inside covered pixels: cage_raster_covers tells them, by any one of their points. */
#ifndef CAGE_PRUNE_H
#define CAGE_PRUNE_H

#include "arena.h"
#include "cage.h"
#include "predicate.h"

struct cage_raster {
    uint64_t *covered; /* rows of whole words along x */
    int32_t origin[3];
    int32_t size[3]; /* pixels; size[2] = 1 in the plane */
    int32_t shift;   /* pixels are 2^shift wide */
    int32_t row;     /* words of a row */
    bool used;       /* false: nothing is covered */
};

/* Lay the raster over count balls with |centre| and radius up to 2^28, and mark what is covered. */
int32_t cage_raster_make(struct cage_arena *arena, int32_t dim, const cage_ball *ball, int32_t count, struct cage_raster *raster);

/* May the ball touch a point that is not in a covered pixel? Certain when false. */
bool cage_raster_keeps(const struct cage_raster *raster, int32_t dim, const cage_ball *ball);

/* Does the orthocentre lie in a covered pixel? */
bool cage_raster_covers(const struct cage_raster *raster, int32_t dim, const struct cage_centre *centre);

#endif
