/* box: around points of a slice. */
#include "box.h"

static const int32_t AXIS[3] = {CAGE_ALONG_X, CAGE_ALONG_Y, CAGE_ALONG_Z};

void cage_box_common(int32_t dim, const struct cage_bounds *a, const struct cage_bounds *b, struct cage_box *box)
{
    box->low[2] = box->high[2] = 0; /* the plane is flat */
    for (int32_t k = 0; k < dim; k++) {
        int32_t i = AXIS[k];
        box->low[k] = a->low[i] > b->low[i] ? a->low[i] : b->low[i];
        box->high[k] = a->high[i] < b->high[i] ? a->high[i] : b->high[i];
    }
}

void cage_box_of(int32_t dim, const struct cage_bounds *bounds, struct cage_box *box)
{
    cage_box_common(dim, bounds, bounds, box);
}

bool cage_box_is_held(const struct cage_box *box, const struct cage_site *ball)
{
    const int64_t at[3] = {ball->x, ball->y, ball->z};
    int64_t square = 0; /* differences < 2^30 + 2^28 in the plane, where the third is 0, and < 2^27 in space */
    for (int32_t k = 0; k < 3; k++) {
        int64_t a = at[k] - box->low[k], b = box->high[k] - at[k], far = a > b ? a : b;
        square += far * far;
    }
    return square <= (int64_t)ball->r * ball->r;
}

bool cage_box_is_apart(const struct cage_box *box, const struct cage_site *ball)
{
    const int64_t at[3] = {ball->x, ball->y, ball->z};
    int64_t square = 0; /* as above */
    for (int32_t k = 0; k < 3; k++) {
        int64_t below = box->low[k] - at[k], above = at[k] - box->high[k], near = below > above ? below : above;
        square += near > 0 ? near * near : 0;
    }
    return square > (int64_t)ball->r * ball->r;
}
