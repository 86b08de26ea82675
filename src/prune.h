/* prune: leave out balls that cannot touch the free space, before anything is triangulated.
 *
 * A raster of square pixels (cubes) is laid over all balls. A pixel that lies in a single ball is covered. A ball is
 * kept iff it may meet a pixel that is not covered. Then, exactly: every component of the complement of all balls is
 * a component of the complement of the kept ones. (It lies in uncovered closed pixels; on these the two unions agree;
 * and the border of a covered pixel lies in a ball that meets its uncovered neighbour too, hence is kept, so nothing
 * leaks across.) The other components of the kept balls lie inside covered pixels: cage_drop_phantoms tells these, by
 * any one of their points. */
#ifndef CAGE_PRUNE_H
#define CAGE_PRUNE_H

#include "arena.h"
#include "cage.h"
#include "component.h"
#include "predicate.h"

struct cage_raster {
    uint64_t *covered; /* a bit for each pixel, rows of whole words along x */
    uint64_t *blocks;  /* a bit for each block of 8 x 8 pixels of a layer that is covered all over */
    int32_t origin[3];
    int32_t size[3]; /* pixels; size[2] = 1 in the plane */
    int32_t shift;   /* pixels are 2^shift wide */
    int32_t row;     /* words of a row */
    int32_t block_row;
    int32_t block_rows; /* of a layer */
    bool used;       /* false: nothing is covered */
};

/* Lay the raster over *count balls with |centre| and radius up to 2^28, and keep those that may touch a point that is not in a
 * covered pixel, and their entries of `of`; *count becomes their number. The raster stays in the arena. */
int32_t cage_prune(struct cage_arena *arena, int32_t dim, cage_ball *ball, int32_t *of, int32_t *count, struct cage_raster *raster);

/* Components of the kept balls that are none of all balls become covered; the others move up. Takes scratch from the arena. */
int32_t cage_drop_phantoms(struct cage_arena *arena, const struct cage_triangulation *t, const struct cage_raster *raster,
                           struct cage_components *c);

#endif
