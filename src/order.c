/* order: the order in which balls are inserted: rounds of growing size, each along a Hilbert curve.
 *
 * Rounds drawn by chance keep the expected work of incremental insertion low whatever the input (Amenta, Choi, Rote,
 * "Incremental constructions con BRIO", SoCG 2003); the curve keeps each step near the last. */
#include "order.h"

#include <stdbool.h>
#include <string.h>

/* The curve tells apart about 2^(2 dim) times as many places as there are balls. */
enum { ROUND_BITS = 3, CURVE_BITS = 29, FINER = 2 };

/* The round a ball falls in, drawn by a hash of the index: each round has an eighth of the balls of the next. */
static uint32_t round_of(uint32_t index)
{
    uint32_t hash = (index + 1) * 2654435769u;
    hash ^= hash >> 15;
    hash *= 2246822519u;
    hash ^= hash >> 13;
    uint32_t round = (1u << ROUND_BITS) - 1;
    while (round > 0 && (hash & 7) == 0) {
        hash >>= 3;
        round--;
    }
    return round;
}

/* Position along the Hilbert curve of a point with `bits` bits a coordinate (J. Skilling, "Programming the Hilbert
 * curve", AIP Conf. Proc. 707, 2004). */
static uint32_t curve_position(uint32_t x[3], int32_t dim, uint32_t bits)
{
    for (uint32_t bit = bits - 1; bit > 0; bit--) {
        uint32_t below = (1u << bit) - 1;
        for (int32_t k = 0; k < dim; k++) {
            /* Where the bit is set, flip x[0] below it; elsewhere swap x[0] and x[k] there. No branch: it would be a
             * coin toss. */
            uint32_t set = 0 - (x[k] >> bit & 1), swap = (x[0] ^ x[k]) & below & ~set;
            x[0] ^= swap | (below & set);
            x[k] ^= swap;
        }
    }
    for (int32_t k = 1; k < dim; k++)
        x[k] ^= x[k - 1];
    uint32_t flip = 0;
    for (uint32_t bit = bits - 1; bit > 0; bit--)
        flip ^= ((1u << bit) - 1) & (0 - (x[dim - 1] >> bit & 1));
    uint32_t position = 0;
    for (uint32_t bit = bits; bit-- > 0;)
        for (int32_t k = 0; k < dim; k++)
            position = position << 1 | (((x[k] ^ flip) >> bit) & 1);
    return position;
}

/* Stable radix sort of order by key, of which only the low bits are used; key and order are both permuted. */
static void sort(uint32_t *key, int32_t *order, uint32_t *other_key, int32_t *other_order, int32_t count, uint32_t bits)
{
    uint32_t shift = 0;
    for (; shift < bits; shift += 8) {
        int32_t first[256] = {0};
        for (int32_t i = 0; i < count; i++)
            first[(key[i] >> shift) & 255]++;
        for (int32_t digit = 0, sum = 0; digit < 256; digit++) {
            int32_t these = first[digit];
            first[digit] = sum;
            sum += these;
        }
        for (int32_t i = 0; i < count; i++) {
            int32_t to = first[(key[i] >> shift) & 255]++;
            other_key[to] = key[i];
            other_order[to] = order[i];
        }
        uint32_t *swap_key = key;
        key = other_key;
        other_key = swap_key;
        int32_t *swap_order = order;
        order = other_order;
        other_order = swap_order;
    }
    if (shift & 8)
        memcpy(other_order, order, (size_t)count * sizeof *order);
}

int32_t cage_order(struct cage_arena *arena, int32_t dim, const cage_ball *ball, int32_t count, int32_t *order)
{
    size_t mark = arena->used;
    uint32_t *key = cage_arena_take(arena, (size_t)count, 2 * sizeof *key);
    int32_t *other = cage_arena_take(arena, (size_t)count, sizeof *other);
    if (!key || !other) {
        cage_arena_release(arena, mark);
        return CAGE_ERROR_MEMORY;
    }
    int32_t low[3] = {INT32_MAX, INT32_MAX, INT32_MAX}, high[3] = {INT32_MIN, INT32_MIN, INT32_MIN};
    for (int32_t i = 0; i < count; i++) {
        const int32_t at[3] = {ball[i].x, ball[i].y, ball[i].z};
        for (int32_t k = 0; k < dim; k++) {
            low[k] = at[k] < low[k] ? at[k] : low[k];
            high[k] = at[k] > high[k] ? at[k] : high[k];
        }
    }
    uint32_t bits = FINER, shift = 0, extent = 0;
    while (bits < CURVE_BITS / (uint32_t)dim && count >> (bits - FINER) * (uint32_t)dim > 0)
        bits++;
    uint32_t length = bits * (uint32_t)dim;
    for (int32_t k = 0; count > 0 && k < dim; k++)
        extent |= (uint32_t)high[k] - (uint32_t)low[k];
    while (extent >> shift >> bits)
        shift++;
    for (int32_t i = 0; i < count; i++) {
        const int32_t at[3] = {ball[i].x, ball[i].y, ball[i].z};
        uint32_t x[3] = {0, 0, 0};
        for (int32_t k = 0; k < dim; k++)
            x[k] = ((uint32_t)at[k] - (uint32_t)low[k]) >> shift;
        key[i] = round_of((uint32_t)i) << length | curve_position(x, dim, bits);
        order[i] = i;
    }
    sort(key, order, key + count, other, count, length + ROUND_BITS);
    cage_arena_release(arena, mark);
    return CAGE_OK;
}
