/* prune: leave out balls that cannot touch the free space, before anything is triangulated. */
#include "prune.h"

#include <string.h>

enum { MARGIN = 4, PIXELS_2D = 512, PIXELS_3D = 64, FIRST = 8 };

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
    int32_t pixels = dim == 2 ? PIXELS_2D : PIXELS_3D, extent = 0; /* high - low <= 2^30 */
    int32_t least = dim == 2 ? PIXELS_2D / 8 : PIXELS_3D / 4;
    while (pixels > least &&
           pixels * pixels / 64 / 8 * (dim == 2 ? 1 : pixels) > count) /* no more words than a few for each ball */
        pixels /= 2;
    int32_t limit = pixels - 2 * MARGIN - 1;
    for (int32_t k = 0; k < dim; k++)
        extent = high[k] - low[k] > extent ? high[k] - low[k] : extent;
    raster->shift = 0;
    while (extent >> raster->shift > limit)
        raster->shift++;
    for (int32_t k = 0; k < 3; k++) {
        raster->origin[k] = k < dim ? low[k] - MARGIN * ((int32_t)1 << raster->shift) : 0;
        raster->size[k] = k < dim ? ((high[k] - low[k]) >> raster->shift) + 1 + 2 * MARGIN : 1;
    }
    raster->row = (raster->size[0] + 63) / 64 + 1;
    raster->block_row = (raster->row + 7) / 8 + 1;
    raster->block_rows = (raster->size[1] + 7) / 8;
}

static uint64_t *row_of(const struct cage_raster *raster, int32_t y, int32_t z)
{
    return raster->covered + ((size_t)z * (size_t)raster->size[1] + (size_t)y) * (size_t)raster->row;
}

static void pixel_of(const struct cage_raster *raster, const cage_ball *ball, int32_t at[3])
{
    at[0] = (ball->x - raster->origin[0]) >> raster->shift;
    at[1] = (ball->y - raster->origin[1]) >> raster->shift;
    at[2] = (ball->z - raster->origin[2]) >> raster->shift;
}

/* The pixels first..last of a row: whole words but for the first and the last, masked; a span of up to 64 pixels has no whole
 * words and two masks, the last of which may be 0 (rows have a word to spare). */
struct span {
    int32_t word, words;
    uint64_t first, last;
};

static CAGE_INLINE struct span span_of(int32_t first, int32_t last)
{
    int32_t word = first >> 6, end = last >> 6;
    struct span s = {word, 1, UINT64_MAX << (first & 63), UINT64_MAX >> (63 - (last & 63))};
    if (word == end) {
        s.first &= s.last;
        s.last = 0;
    } else {
        s.words = end - word;
    }
    return s;
}

/* In two rows at once: discs are symmetric. */
static CAGE_INLINE void set(uint64_t *a, uint64_t *b, struct span s)
{
    a += s.word;
    b += s.word;
    a[0] |= s.first;
    b[0] |= s.first;
    for (int32_t w = 1; w < s.words; w++)
        a[w] = b[w] = UINT64_MAX;
    a[s.words] |= s.last;
    b[s.words] |= s.last;
}

static CAGE_INLINE bool all_set(const uint64_t *a, const uint64_t *b, struct span s)
{
    a += s.word;
    b += s.word;
    uint64_t missing = (~(a[0] & b[0]) & s.first) | (~(a[s.words] & b[s.words]) & s.last);
    for (int32_t w = 1; w < s.words; w++)
        missing |= ~(a[w] & b[w]);
    return missing == 0;
}

/* Sum up which blocks are covered. */
static void add_up(struct cage_raster *raster)
{
    for (int32_t z = 0; z < raster->size[2]; z++)
        for (int32_t b = 0; b < raster->block_rows; b++) {
            uint64_t *to = raster->blocks + ((size_t)z * (size_t)raster->block_rows + (size_t)b) * (size_t)raster->block_row;
            memset(to, 0, (size_t)raster->block_row * sizeof *to);
            for (int32_t w = 0; w < raster->row && 8 * b + 7 < raster->size[1]; w++) {
                uint64_t all = UINT64_MAX;
                for (int32_t y = 8 * b; y < 8 * b + 8; y++)
                    all &= row_of(raster, y, z)[w];
                for (int32_t k = 0; k < 8 && all; k++)
                    if ((all >> (8 * k) & 255) == 255)
                        to[w >> 3] |= (uint64_t)1 << (8 * (w & 7) + k);
            }
        }
}

/* Are all blocks around the ball, with the margin of one pixel that rounding its centre costs, covered? */
static bool blocks_cover(const struct cage_raster *raster, int32_t dim, const cage_ball *ball)
{
    int32_t at[3], gap = (ball->r >> raster->shift) + 2, deep = dim == 3 ? gap : 0;
    pixel_of(raster, ball, at);
    struct span span = span_of((at[0] - gap) >> 3, (at[0] + gap) >> 3);
    int32_t first = (at[1] - gap) >> 3, rows = ((at[1] + gap) >> 3) - first + 1;
    for (int32_t z = at[2] - deep; z <= at[2] + deep; z++) {
        const uint64_t *row =
            raster->blocks + ((size_t)z * (size_t)raster->block_rows + (size_t)first) * (size_t)raster->block_row;
        for (int32_t b = 0; b < rows; b++, row += raster->block_row)
            if (!all_set(row, row, span))
                return false;
    }
    return true;
}

/* The disc of pixels (i, j) with i^2 + j^2 <= square: |i| <= width[j] for j < rows. */
struct stamp {
    int64_t square;
    int32_t rows;
    int16_t width[PIXELS_2D];
};

/* square < (PIXELS_2D / 2)^2; most balls of a slice share a few radii, so the last stamp often serves. */
static void cut_stamp(struct stamp *stamp, int64_t square)
{
    if (stamp->square == square)
        return;
    int32_t width = 0, j = 0;
    while ((int64_t)(width + 1) * (width + 1) <= square)
        width++;
    for (; (int64_t)j * j <= square; j++) {
        while ((int64_t)width * width > square - (int64_t)j * j)
            width--;
        stamp->width[j] = (int16_t)width;
    }
    stamp->square = square;
    stamp->rows = j;
}

/* A ball whose centre is anywhere in pixel 0 holds pixel (i, j, k) if (|i|+1)^2 + (|j|+1)^2 + (|k|+1)^2 <= r^2 / width^2 (in
 * the plane without k). */
static void mark(struct cage_raster *raster, int32_t dim, const cage_ball *ball, struct stamp *stamp)
{
    int64_t square = ((int64_t)ball->r * ball->r) >> (2 * raster->shift);
    int32_t at[3];
    pixel_of(raster, ball, at);
    for (int32_t k = 0; k == 0 || dim == 3; k++) {
        int64_t left = dim == 3 ? square - (int64_t)(k + 1) * (k + 1) : square;
        if (left < 2)
            return;
        cut_stamp(stamp, left);
        for (int32_t z = at[2] - k; z <= at[2] + k; z += k ? 2 * k : 1) {
            uint64_t *up = row_of(raster, at[1], z), *down = up;
            for (int32_t j = 1; j < stamp->rows && stamp->width[j] > 0; j++, up -= raster->row, down += raster->row) {
                int32_t half = stamp->width[j] - 1;
                set(up, down, span_of(at[0] - half, at[0] + half));
            }
        }
    }
}

/* Mark every so many balls, but for those that would add nothing. */
static void mark_every(struct cage_raster *raster, int32_t dim, const cage_ball *ball, int32_t count, int32_t first, int32_t pace,
                       struct stamp *stamp)
{
    for (int32_t i = first; i < count; i += pace)
        if (!blocks_cover(raster, dim, &ball[i]))
            mark(raster, dim, &ball[i], stamp);
    add_up(raster);
}

/* It cannot meet pixel (i, j, k) if (|i|-1)^2 + (|j|-1)^2 + (|k|-1)^2 > r^2 / width^2, negative terms taken as 0. */
static bool keeps(const struct cage_raster *raster, int32_t dim, const cage_ball *ball, struct stamp *stamp)
{
    int64_t square = (((int64_t)ball->r * ball->r) >> (2 * raster->shift)) + 1;
    int32_t at[3];
    pixel_of(raster, ball, at);
    for (int32_t k = 0; k == 0 || dim == 3; k++) {
        int64_t deep = k > 0 ? k - 1 : 0;
        if (deep * deep > square)
            break;
        cut_stamp(stamp, square - deep * deep);
        for (int32_t z = at[2] - k; z <= at[2] + k; z += k ? 2 * k : 1) {
            const uint64_t *up = row_of(raster, at[1], z), *down = up;
            for (int32_t j = 0; j <= stamp->rows; j++, up -= raster->row, down += raster->row) {
                int32_t half = stamp->width[j > 0 ? j - 1 : 0] + 1;
                if (!all_set(up, down, span_of(at[0] - half, at[0] + half)))
                    return true;
            }
        }
    }
    return false;
}

/* Keep the balls that may touch a point that is not in a covered pixel, and their entries of `of`; how many are left. */
static int32_t keep_some(const struct cage_raster *raster, int32_t dim, cage_ball *ball, int32_t *of, int32_t count,
                         struct stamp *stamp)
{
    int32_t kept = 0;
    for (int32_t i = 0; i < count; i++)
        if (!blocks_cover(raster, dim, &ball[i]) && keeps(raster, dim, &ball[i], stamp)) {
            ball[kept] = ball[i];
            of[kept++] = of[i];
        }
    return kept;
}

int32_t cage_prune(struct cage_arena *arena, int32_t dim, cage_ball *ball, int32_t *of, int32_t *number, struct cage_raster *raster)
{
    int32_t count = *number;
    raster->used = false;
    if (count == 0)
        return CAGE_OK;
    lay(dim, ball, count, raster);
    for (int32_t i = 0; i < count && !raster->used; i++)
        raster->used = ball[i].r >> raster->shift >= 3; /* the smallest ball that holds a pixel has r^2 >= 2 width^2 */
    if (!raster->used)
        return CAGE_OK;
    size_t words = (size_t)raster->row * (size_t)raster->size[1] * (size_t)raster->size[2];
    size_t blocks = (size_t)raster->block_row * (size_t)raster->block_rows * (size_t)raster->size[2];
    raster->covered = cage_arena_take(arena, words, sizeof *raster->covered);
    raster->blocks = cage_arena_take(arena, blocks, sizeof *raster->blocks);
    if (!raster->covered || !raster->blocks)
        return CAGE_ERROR_MEMORY;
    memset(raster->covered, 0, words * sizeof *raster->covered);
    /* A few balls cover most of what is covered; most of the others then add nothing. */
    struct stamp stamp = {-1, 0, {0}};
    memset(raster->blocks, 0, blocks * sizeof *raster->blocks);
    mark_every(raster, dim, ball, count, 0, FIRST, &stamp);
    for (int32_t pace = FIRST; pace > 1; pace /= 2)
        mark_every(raster, dim, ball, count, pace / 2, pace, &stamp);
    *number = keep_some(raster, dim, ball, of, count, &stamp);
    return CAGE_OK;
}

/* Does the orthocentre lie in a covered pixel? */
static bool is_covered(const struct cage_raster *raster, int32_t dim, const struct cage_centre *centre)
{
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

int32_t cage_drop_phantoms(struct cage_arena *arena, const struct cage_triangulation *t, const struct cage_raster *raster,
                           struct cage_components *c)
{
    int32_t *now = cage_arena_take(arena, (size_t)c->count, sizeof *now);
    if (!now)
        return CAGE_ERROR_MEMORY;
    if (!raster->used)
        return CAGE_OK;
    now[CAGE_OUTSIDE] = CAGE_OUTSIDE;
    for (int32_t k = 1; k < c->count; k++) {
        struct cage_centre centre;
        cage_component_point(t, c, k, &centre);
        now[k] = is_covered(raster, t->dim, &centre) ? CAGE_COVERED : k;
    }
    cage_components_drop(t, now, c);
    return CAGE_OK;
}
