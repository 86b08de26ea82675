/* wide: 128- and 256-bit signed integers, without needing a 128-bit compiler type. */
#ifndef CAGE_SHARED
#define CAGE_SHARED CAGE_INLINE
#endif
#include "wide.h"

extern inline uint32_t cage_u64_bits(uint64_t a);
extern inline uint64_t cage_u64_divide(uint64_t a, uint64_t b);
extern inline cage_i128 cage_i128_make(uint64_t high, uint64_t low);
extern inline uint64_t cage_i128_low(cage_i128 a);
extern inline uint64_t cage_i128_high(cage_i128 a);
extern inline cage_i128 cage_i128_mul(int64_t a, int64_t b);
extern inline cage_i128 cage_u64_mul(uint64_t a, uint64_t b);
extern inline cage_i128 cage_i128_add(cage_i128 a, cage_i128 b);
extern inline cage_i128 cage_i128_sub(cage_i128 a, cage_i128 b);
extern inline cage_i128 cage_i128_scale(cage_i128 a, int64_t b);
extern inline cage_i128 cage_i128_shr(cage_i128 a, uint32_t bits);
extern inline cage_i128 cage_i128_shl(cage_i128 a, uint32_t bits);
extern inline cage_i128 cage_i128_of(int64_t a);
extern inline bool cage_i128_negative(cage_i128 a);
extern inline int32_t cage_i128_sign(cage_i128 a);
extern inline bool cage_i128_positive(cage_i128 a);
extern inline void cage_i128_add_product(cage_i128 *sum, int64_t a, int64_t b);
extern inline cage_i128 cage_i128_minus(cage_i128 a);
extern inline cage_i128 cage_i128_abs(cage_i128 a);
extern inline int32_t cage_i128_compare(cage_i128 a, cage_i128 b);
extern inline uint32_t cage_u128_bits(cage_i128 a);

/* Bit by bit: the rest so far, twice that and the next bit of a; first, of so many that it is less than b. */
cage_i128 cage_u128_divide_by_bits(cage_i128 a, cage_i128 b, cage_i128 *remainder)
{
    uint32_t of_a = cage_u128_bits(a), of_b = cage_u128_bits(b), bit = of_a >= of_b ? of_a - of_b + 1 : 0;
    cage_i128 rest = bit < 128 ? cage_i128_shr(a, bit) : cage_i128_of(0), quotient = cage_i128_of(0);
    while (bit-- > 0) {
        uint64_t word = bit < 64 ? cage_i128_low(a) : cage_i128_high(a);
        rest = cage_i128_add(cage_i128_add(rest, rest), cage_i128_make(0, word >> (bit & 63) & 1)); /* < 2 b < 2^128 */
        cage_i128 less = cage_i128_sub(rest, b);
        uint64_t fits = !cage_i128_negative(less);
        rest = fits ? less : rest;
        quotient = cage_i128_add(cage_i128_add(quotient, quotient), cage_i128_make(0, fits));
    }
    *remainder = rest;
    return quotient;
}

int64_t cage_i128_floor(cage_i128 a, cage_i128 b, int64_t limit)
{
    bool negative = cage_i128_negative(a);
    cage_i128 rest;
    cage_i128 floor = cage_u128_divide(cage_i128_abs(a), b, &rest);
    if (negative && cage_i128_sign(rest) != 0)
        floor = cage_i128_add(floor, cage_i128_of(1));
    if (cage_i128_compare(floor, cage_i128_of(limit)) > 0)
        floor = cage_i128_of(limit);
    int64_t value = (int64_t)cage_i128_low(floor);
    return negative ? -value : value;
}

/* floor((2 a + b) / 2 b) */
int64_t cage_i128_nearest(cage_i128 a, cage_i128 b, int64_t limit)
{
    if (cage_i128_negative(b)) {
        a = cage_i128_minus(a);
        b = cage_i128_minus(b);
    }
    return cage_i128_floor(cage_i128_add(cage_i128_add(a, a), b), cage_i128_add(b, b), limit);
}

/* Digit by digit, without a product: what is left of a is always a less the square of the root so far. */
static uint64_t short_root(uint64_t a)
{
    uint64_t root = 0;
    for (uint64_t bit = (uint64_t)1 << (cage_u64_bits(a | 1) - 1) / 2 * 2; bit > 0; bit >>= 2) {
        uint64_t next = root + bit, fits = (uint64_t)0 - (a >= next); /* all bits, or none */
        a -= next & fits;
        root = (root >> 1) + (bit & fits);
    }
    return root;
}

uint64_t cage_u128_root(cage_i128 a)
{
    uint64_t root = 0; /* < 2^63, so root^2 fits */
    if (cage_i128_high(a) == 0)
        return short_root(cage_i128_low(a));
    for (uint32_t bit = (cage_u128_bits(a) + 1) / 2; bit-- > 0;) {
        uint64_t next = root | (uint64_t)1 << bit;
        if (cage_i128_compare(cage_u64_mul(next, next), a) <= 0)
            root = next;
    }
    return root;
}

/* Add the 128-bit unsigned value to the words from `at` on. */
static void accumulate(cage_i256 *sum, int32_t at, cage_i128 value)
{
    uint64_t part[2] = {cage_i128_low(value), cage_i128_high(value)};
    uint64_t carry = 0;
    for (int32_t i = at; i < 4; i++) {
        uint64_t add = i - at < 2 ? part[i - at] : 0;
        uint64_t word = sum->word[i] + add;
        uint64_t over = word < add;
        sum->word[i] = word + carry;
        carry = over + (sum->word[i] < carry); /* at most 1 of the two can be set */
    }
}

static void accumulate_product(cage_i256 *sum, int32_t at, uint64_t a, uint64_t b)
{
    accumulate(sum, at, cage_u64_mul(a, b));
}

/* Of the values as unsigned numbers, which are too large by 2^128 where they are negative. */
void cage_i256_add_product(cage_i256 *sum, cage_i128 a, cage_i128 b)
{
    accumulate_product(sum, 0, cage_i128_low(a), cage_i128_low(b));
    accumulate_product(sum, 1, cage_i128_low(a), cage_i128_high(b));
    accumulate_product(sum, 1, cage_i128_high(a), cage_i128_low(b));
    accumulate_product(sum, 2, cage_i128_high(a), cage_i128_high(b));
    if (cage_i128_negative(a))
        accumulate(sum, 2, cage_i128_minus(b));
    if (cage_i128_negative(b))
        accumulate(sum, 2, cage_i128_minus(a));
}

int32_t cage_i256_sign(const cage_i256 *a)
{
    if (a->word[3] >> 63)
        return -1;
    return (a->word[0] | a->word[1] | a->word[2] | a->word[3]) != 0;
}
