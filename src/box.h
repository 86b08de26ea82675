/* box: around points of a slice. */
#ifndef CAGE_BOX_H
#define CAGE_BOX_H

#include "piece.h"

/* Sides are closed; |low|, |high| < 2^30. */
struct cage_box {
    int64_t low[3], high[3];
};

/* Around what is within the bounds, and around what is within both. */
void cage_box_of(int32_t dim, const struct cage_bounds *bounds, struct cage_box *box);
void cage_box_common(int32_t dim, const struct cage_bounds *a, const struct cage_bounds *b, struct cage_box *box);

/* Does the closed ball meet it (or nearly)? */
static CAGE_INLINE bool cage_box_meets(const struct cage_box *box, const struct cage_site *ball)
{
    int64_t x = ball->x, y = ball->y, z = ball->z, r = ball->r;
    return (x + r >= box->low[0]) & (x - r <= box->high[0]) & (y + r >= box->low[1]) & (y - r <= box->high[1]) &
           (z + r >= box->low[2]) & (z - r <= box->high[2]);
}

/* Does the closed ball hold all of the box? Is it apart from it? Both exact. */
bool cage_box_is_held(const struct cage_box *box, const struct cage_site *ball);
bool cage_box_is_apart(const struct cage_box *box, const struct cage_site *ball);

#endif
