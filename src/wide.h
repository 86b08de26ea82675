/* wide: 128- and 256-bit signed integers, without needing a 128-bit compiler type.
 *
 * Two's complement, wrapping: every operation is exact modulo 2^128 or 2^256, so a result that is known
 * to fit is right whatever its terms did. Where the compiler has __int128 it is used for the 128-bit
 * half; CAGE_LIMBS selects the portable limbs instead, with the same results. */
#ifndef CAGE_WIDE_H
#define CAGE_WIDE_H

#include <stdbool.h>
#include <stdint.h>

/* CAGE_SHARED: a function of a header, compiled where it is called; or, for the least size, once for all that do not inline it: in
 * the file that declares it extern (C99, 6.7.4), whatever that one is compiled for. */
#if defined(__GNUC__) && !defined(__OPTIMIZE_SIZE__)
#define CAGE_INLINE inline __attribute__((always_inline))
#else
#define CAGE_INLINE inline
#endif
#if !defined(CAGE_SHARED) && defined(__GNUC__) && !defined(__OPTIMIZE_SIZE__)
#define CAGE_SHARED static CAGE_INLINE
#elif !defined(CAGE_SHARED)
#define CAGE_SHARED inline
#endif

/* Bits of the number: 0 for 0. */
CAGE_SHARED uint32_t cage_u64_bits(uint64_t a)
{
#if defined(__GNUC__) && !defined(CAGE_LIMBS)
    return a ? 64 - (uint32_t)__builtin_clzll(a) : 0;
#else
    uint32_t bits = 0;
    for (uint32_t half = 32; half > 0; half /= 2)
        if (a >> half) {
            a >>= half;
            bits += half;
        }
    return bits + (uint32_t)a;
#endif
}

/* floor(a / b), b > 0. Without a wider type, as on small processors, bit by bit: few quotients have many. */
CAGE_SHARED uint64_t cage_u64_divide(uint64_t a, uint64_t b)
{
#if defined(__SIZEOF_INT128__) && !defined(CAGE_LIMBS)
    return a / b;
#else
    uint64_t quotient = 0;
    uint32_t of_a = cage_u64_bits(a), of_b = cage_u64_bits(b), bits = of_a >= of_b ? of_a - of_b + 1 : 0;
    b <<= bits > 0 ? bits - 1 : 0;
    for (; bits > 0; bits--) {
        uint64_t fits = a >= b;
        a -= fits ? b : 0;
        quotient = 2 * quotient + fits;
        b >>= 1;
    }
    return quotient;
#endif
}

#if defined(__SIZEOF_INT128__) && !defined(CAGE_LIMBS)

__extension__ typedef __int128 cage_i128;
__extension__ typedef unsigned __int128 cage_u128;

CAGE_SHARED cage_i128 cage_i128_make(uint64_t high, uint64_t low)
{
    return (cage_i128)(((cage_u128)high << 64) | low);
}
CAGE_SHARED uint64_t cage_i128_low(cage_i128 a) { return (uint64_t)a; }
CAGE_SHARED uint64_t cage_i128_high(cage_i128 a) { return (uint64_t)((cage_u128)a >> 64); }
CAGE_SHARED cage_i128 cage_i128_mul(int64_t a, int64_t b) { return (cage_i128)a * b; }
CAGE_SHARED cage_i128 cage_u64_mul(uint64_t a, uint64_t b) { return (cage_i128)((cage_u128)a * b); }
CAGE_SHARED cage_i128 cage_i128_add(cage_i128 a, cage_i128 b)
{
    return (cage_i128)((cage_u128)a + (cage_u128)b);
}
CAGE_SHARED cage_i128 cage_i128_sub(cage_i128 a, cage_i128 b)
{
    return (cage_i128)((cage_u128)a - (cage_u128)b);
}
/* *sum += a b */
CAGE_SHARED void cage_i128_add_product(cage_i128 *sum, int64_t a, int64_t b)
{
    *sum = cage_i128_add(*sum, cage_i128_mul(a, b));
}
CAGE_SHARED cage_i128 cage_i128_scale(cage_i128 a, int64_t b)
{
    return (cage_i128)((cage_u128)a * (cage_u128)(cage_i128)b);
}
/* 0 <= bits <= 127, toward zero bits shifted in */
CAGE_SHARED cage_i128 cage_i128_shr(cage_i128 a, uint32_t bits) { return (cage_i128)((cage_u128)a >> bits); }
CAGE_SHARED cage_i128 cage_i128_shl(cage_i128 a, uint32_t bits) { return (cage_i128)((cage_u128)a << bits); }
static CAGE_INLINE cage_i128 cage_u128_divide(cage_i128 a, cage_i128 b, cage_i128 *remainder)
{
    *remainder = (cage_i128)((cage_u128)a % (cage_u128)b);
    return (cage_i128)((cage_u128)a / (cage_u128)b);
}

#else

typedef struct cage_i128 {
    uint64_t low, high;
} cage_i128;

CAGE_SHARED cage_i128 cage_i128_make(uint64_t high, uint64_t low)
{
    cage_i128 a = {low, high};
    return a;
}
CAGE_SHARED uint64_t cage_i128_low(cage_i128 a) { return a.low; }
CAGE_SHARED uint64_t cage_i128_high(cage_i128 a) { return a.high; }

/* Halves of 32 bits; the middle sum is at most 3 (2^32 - 1) + ... < 2^34, so nothing is lost. */
CAGE_SHARED cage_i128 cage_u64_mul(uint64_t a, uint64_t b)
{
    uint64_t a0 = (uint32_t)a, a1 = a >> 32, b0 = (uint32_t)b, b1 = b >> 32;
    uint64_t p00 = a0 * b0, p01 = a0 * b1, p10 = a1 * b0, p11 = a1 * b1;
    uint64_t middle = (p00 >> 32) + (uint32_t)p01 + (uint32_t)p10;
    return cage_i128_make(p11 + (p01 >> 32) + (p10 >> 32) + (middle >> 32), (middle << 32) | (uint32_t)p00);
}
CAGE_SHARED cage_i128 cage_i128_mul(int64_t a, int64_t b)
{
    cage_i128 p = cage_u64_mul((uint64_t)a, (uint64_t)b);
    p.high -= (a < 0 ? (uint64_t)b : 0) + (b < 0 ? (uint64_t)a : 0);
    return p;
}
CAGE_SHARED cage_i128 cage_i128_add(cage_i128 a, cage_i128 b)
{
    uint64_t low = a.low + b.low;
    return cage_i128_make(a.high + b.high + (low < a.low), low);
}
CAGE_SHARED cage_i128 cage_i128_sub(cage_i128 a, cage_i128 b)
{
    return cage_i128_make(a.high - b.high - (a.low < b.low), a.low - b.low);
}
CAGE_SHARED void cage_i128_add_product(cage_i128 *sum, int64_t a, int64_t b)
{
    cage_i128 p = cage_u64_mul((uint64_t)a, (uint64_t)b); /* not cage_i128_mul: a call less of stack */
    p.high -= (a < 0 ? (uint64_t)b : 0) + (b < 0 ? (uint64_t)a : 0);
    *sum = cage_i128_add(*sum, p);
}
CAGE_SHARED cage_i128 cage_i128_scale(cage_i128 a, int64_t b)
{
    cage_i128 p = cage_u64_mul(a.low, (uint64_t)b);
    p.high += a.high * (uint64_t)b - (b < 0 ? a.low : 0);
    return p;
}
CAGE_SHARED cage_i128 cage_i128_shr(cage_i128 a, uint32_t bits)
{
    if (bits == 0)
        return a;
    if (bits >= 64)
        return cage_i128_make(0, a.high >> (bits - 64));
    return cage_i128_make(a.high >> bits, (a.low >> bits) | (a.high << (64 - bits)));
}
CAGE_SHARED cage_i128 cage_i128_shl(cage_i128 a, uint32_t bits)
{
    if (bits == 0)
        return a;
    if (bits >= 64)
        return cage_i128_make(a.low << (bits - 64), 0);
    return cage_i128_make((a.high << bits) | (a.low >> (64 - bits)), a.low << bits);
}
#define cage_u128_divide cage_u128_divide_by_bits

#endif

CAGE_SHARED cage_i128 cage_i128_of(int64_t a) { return cage_i128_make(a < 0 ? UINT64_MAX : 0, (uint64_t)a); }

CAGE_SHARED bool cage_i128_negative(cage_i128 a) { return cage_i128_high(a) >> 63; }

/* -1, 0 or 1 */
CAGE_SHARED int32_t cage_i128_sign(cage_i128 a)
{
    if (cage_i128_negative(a))
        return -1;
    return (cage_i128_high(a) | cage_i128_low(a)) != 0;
}

/* a > 0, for a > -2^127: without a branch, for tests whose outcome nothing could predict. */
CAGE_SHARED bool cage_i128_positive(cage_i128 a)
{
    return cage_i128_negative(cage_i128_sub(cage_i128_make(0, 0), a));
}

CAGE_SHARED cage_i128 cage_i128_minus(cage_i128 a) { return cage_i128_sub(cage_i128_of(0), a); }

CAGE_SHARED cage_i128 cage_i128_abs(cage_i128 a) { return cage_i128_negative(a) ? cage_i128_minus(a) : a; }

/* The sign of a - b, whatever their size. */
CAGE_SHARED int32_t cage_i128_compare(cage_i128 a, cage_i128 b)
{
    int64_t ah = (int64_t)cage_i128_high(a), bh = (int64_t)cage_i128_high(b);
    if (ah != bh)
        return ah < bh ? -1 : 1;
    uint64_t al = cage_i128_low(a), bl = cage_i128_low(b);
    return al < bl ? -1 : al > bl;
}

/* Bits needed for the unsigned value a: 0 for 0, 128 at most. */
CAGE_SHARED uint32_t cage_u128_bits(cage_i128 a)
{
    uint64_t high = cage_i128_high(a);
    return high ? 64 + cage_u64_bits(high) : cage_u64_bits(cage_i128_low(a));
}

/* Floor and remainder of the unsigned a by the unsigned b > 0, b < 2^127: cage_u128_divide, where there is no wider type. */
cage_i128 cage_u128_divide_by_bits(cage_i128 a, cage_i128 b, cage_i128 *remainder);

/* The nearest integer to a / b, ties toward +infinity, clamped to +-limit; b is not 0, |a| < 2^125 and |b| < 2^126. */
int64_t cage_i128_nearest(cage_i128 a, cage_i128 b, int64_t limit);

/* The largest integer not above a / b, clamped likewise; 0 < b < 2^127, |a| < 2^127. */
int64_t cage_i128_floor(cage_i128 a, cage_i128 b, int64_t limit);

/* floor(sqrt(a)) of the unsigned value a < 2^126. */
uint64_t cage_u128_root(cage_i128 a);

typedef struct cage_i256 {
    uint64_t word[4]; /* least significant first */
} cage_i256;

/* *sum += a b, modulo 2^256. */
void cage_i256_add_product(cage_i256 *sum, cage_i128 a, cage_i128 b);

/* -1, 0 or 1 */
int32_t cage_i256_sign(const cage_i256 *a);

#endif
