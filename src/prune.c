/* prune: leave out balls that cannot touch the free space, before anything is triangulated. */
#include "prune.h"

#include <string.h>

enum { MARGIN = 4, PIXELS_2D = 256, PIXELS_3D = 32 };

static void lay(int32_t dim, const cage_ball *ball, int32_t count, struct cage_raster *raster)
{
    int32_t low[3] = {INT32_MAX, INT32_MAX, INT32_MAX}, high[3] = {INT32_MIN, INT32_MIN, INT32_MIN};
    for (int32_t i = 0; i < count; i++) {
        const int32_t at[3] = {ball[i].x, ball[i].y, ball[i].z};
        for (int32_t k = 0; k < dim; k++) {
            low[k] = at[k] - ball[i].r < low[k] ? at[k] - ball[i].r : low[k];
            high[k] = at[k] + ball[i].r > high[k] ? at[k] + ball[i].r : high[k];
        }
    }
    int32_t limit = (dim == 2 ? PIXELS_2D : PIXELS_3D) - 2 * MARGIN - 1, extent = 0; /* high - low <= 2^30 */
    for (int32_t k = 0; k < dim; k++)
        extent = high[k] - low[k] > extent ? high[k] - low[k] : extent;
    raster->shift = 0;
    while (extent >> raster->shift > limit)
        raster->shift++;
    for (int32_t k = 0; k < 3; k++) {
        raster->origin[k] = k < dim ? low[k] - MARGIN * ((int32_t)1 << raster->shift) : 0;
        raster->size[k] = k < dim ? ((high[k] - low[k]) >> raster->shift) + 1 + 2 * MARGIN : 1;
    }
    raster->row = (raster->size[0] + 63) / 64;
}

static uint64_t *row_of(const struct cage_raster *raster, int32_t y, int32_t z)
{
    return raster->covered + ((size_t)z * (size_t)raster->size[1] + (size_t)y) * (size_t)raster->row;
}

/* The bits of word w that belong to pixels first..last. */
static uint64_t mask_of(int32_t w, int32_t first, int32_t last)
{
    uint64_t mask = UINT64_MAX;
    if (first > 64 * w)
        mask <<= first - 64 * w;
    if (last < 64 * w + 63)
        mask &= UINT64_MAX >> (64 * w + 63 - last);
    return mask;
}

static void pixel_of(const struct cage_raster *raster, const cage_ball *ball, int32_t at[3])
{
    at[0] = (ball->x - raster->origin[0]) >> raster->shift;
    at[1] = (ball->y - raster->origin[1]) >> raster->shift;
    at[2] = (ball->z - raster->origin[2]) >> raster->shift;
}

/* A ball whose centre is anywhere in pixel 0 holds pixel (i, j, k) if (|i|+1)^2 + (|j|+1)^2 + (|k|+1)^2 <= r^2 / width^2 (in
 * the plane without k). */
static void mark(struct cage_raster *raster, int32_t dim, const cage_ball *ball)
{
    int64_t square = ((int64_t)ball->r * ball->r) >> (2 * raster->shift);
    int32_t at[3];
    pixel_of(raster, ball, at);
    for (int32_t k = 0; k == 0 || dim == 3; k++) {
        int64_t left = dim == 3 ? square - (int64_t)(k + 1) * (k + 1) : square;
        int32_t width = ball->r >> raster->shift; /* |i| + 1 */
        if (left < 2)
            return;
        for (int32_t j = 0; width > 0; j++) {
            while (width > 0 && (int64_t)width * width > left - (int64_t)(j + 1) * (j + 1))
                width--;
            if (width == 0)
                break;
            int32_t first = at[0] - (width - 1), last = at[0] + (width - 1);
            for (int32_t z = at[2] - k; z <= at[2] + k; z += k ? 2 * k : 1)
                for (int32_t y = at[1] - j; y <= at[1] + j; y += j ? 2 * j : 1) {
                    uint64_t *row = row_of(raster, y, z);
                    for (int32_t w = first >> 6; w <= last >> 6; w++)
                        row[w] |= mask_of(w, first, last);
                }
        }
    }
}

/* It cannot meet pixel (i, j, k) if (|i|-1)^2 + (|j|-1)^2 + (|k|-1)^2 > r^2 / width^2, negative terms taken as 0. */
bool cage_raster_keeps(const struct cage_raster *raster, int32_t dim, const cage_ball *ball)
{
    if (!raster->used)
        return true;
    int64_t square = (((int64_t)ball->r * ball->r) >> (2 * raster->shift)) + 1;
    int32_t at[3];
    pixel_of(raster, ball, at);
    for (int32_t k = 0; k == 0 || dim == 3; k++) {
        int64_t deep = k > 0 ? k - 1 : 0, left = square - deep * deep;
        int32_t gap = (ball->r >> raster->shift) + 1; /* gap^2 >= square: largest |i| - 1 */
        if (left < 0)
            break;
        for (int32_t j = 0;; j++) {
            int64_t high = j > 0 ? j - 1 : 0;
            while (gap >= 0 && (int64_t)gap * gap > left - high * high)
                gap--;
            if (gap < 0)
                break;
            int32_t first = at[0] - gap - 1, last = at[0] + gap + 1;
            for (int32_t z = at[2] - k; z <= at[2] + k; z += k ? 2 * k : 1)
                for (int32_t y = at[1] - j; y <= at[1] + j; y += j ? 2 * j : 1) {
                    const uint64_t *row = row_of(raster, y, z);
                    for (int32_t w = first >> 6; w <= last >> 6; w++)
                        if (~row[w] & mask_of(w, first, last))
                            return true;
                }
        }
    }
    return false;
}

int32_t cage_raster_make(struct cage_arena *arena, int32_t dim, const cage_ball *ball, int32_t count, struct cage_raster *raster)
{
    raster->used = false;
    if (count == 0)
        return CAGE_OK;
    lay(dim, ball, count, raster);
    for (int32_t i = 0; i < count && !raster->used; i++)
        raster->used = ball[i].r >> raster->shift >= 3; /* the smallest ball that holds a pixel has r^2 >= 2 width^2 */
    if (!raster->used)
        return CAGE_OK;
    size_t words = (size_t)raster->row * (size_t)raster->size[1] * (size_t)raster->size[2];
    raster->covered = cage_arena_take(arena, words, sizeof *raster->covered);
    if (!raster->covered)
        return CAGE_ERROR_MEMORY;
    memset(raster->covered, 0, words * sizeof *raster->covered);
    for (int32_t i = 0; i < count; i++)
        mark(raster, dim, &ball[i]);
    return CAGE_OK;
}

bool cage_raster_covers(const struct cage_raster *raster, int32_t dim, const struct cage_centre *centre)
{
    if (!raster->used)
        return false;
    const int32_t base[3] = {centre->base->x, centre->base->y, centre->base->z};
    int32_t at[3] = {0, 0, 0};
    for (int32_t k = 0; k < dim; k++) {
        /* offset / denominator rounded down; clamped far outside the raster, where nothing is covered */
        int64_t to = cage_i128_floor(centre->offset[k], centre->denominator, (int64_t)1 << 40);
        to = (to + base[k] - raster->origin[k]) >> raster->shift;
        if (to < 0 || to >= raster->size[k])
            return false;
        at[k] = (int32_t)to;
    }
    return row_of(raster, at[1], at[2])[at[0] >> 6] >> (at[0] & 63) & 1;
}
