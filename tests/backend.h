/* backend.h: one build of wide and predicate behind plain integers, so that several meet in one binary. */
#ifndef BACKEND_H
#define BACKEND_H

#include "predicate.h"

/* Two's complement, least significant word first; a 128-bit value uses two words and leaves two 0. */
typedef struct words {
    uint64_t word[4];
} words;

/* Every operation of wide.h. Those that give a number smaller than 128 bits give it in word[0]. */
enum wide_op {
    WIDE_MAKE,      /* a, through make, low and high */
    WIDE_OF,        /* c */
    WIDE_MUL,       /* a.word[0] times c, signed */
    WIDE_UMUL,      /* a.word[0] times b.word[0], unsigned */
    WIDE_ADD,       /* a + b */
    WIDE_SUB,       /* a - b */
    WIDE_ADD_PRODUCT, /* a + b.word[0] times c, signed */
    WIDE_SCALE,     /* a times c */
    WIDE_SHR,       /* a by b.word[0] % 128 */
    WIDE_SHL,
    WIDE_NEGATIVE,
    WIDE_SIGN,
    WIDE_ABS,
    WIDE_COMPARE,   /* a with b */
    WIDE_BITS,
    WIDE_QUOTIENT,  /* a by b, unsigned */
    WIDE_REMAINDER,
    WIDE_SHORT_QUOTIENT, /* a.word[0] by b.word[0], unsigned */
    WIDE_NEAREST,   /* a by b, limit c */
    WIDE_FLOOR,
    WIDE_ROOT,
    WIDE_MINUS,     /* -a */
    WIDE_PRODUCT,   /* a times b, both of 128 bits, added to 0 */
    WIDE_SUM,       /* a of 256 bits, and b of 128 times c */
    WIDE_SIGN256,
    WIDE_OPS
};

struct backend {
    const char *name;
    words (*wide)(enum wide_op op, words a, words b, int64_t c);
    int32_t (*side)(int32_t dim, const struct cage_site *const face[3], const struct cage_site *p);
    bool (*conflict)(int32_t dim, const struct cage_site *const v[4], const struct cage_site *p);
    words (*volume)(int32_t dim, const struct cage_site *const v[4]);
    int32_t (*norm_compare)(const words n[3], words g);
    int64_t (*power)(const struct cage_site *site, const int32_t p[3]);
    /* offset[0..2], then the denominator, of the orthocentre of v */
    void (*centre)(int32_t dim, const struct cage_site *const v[4], words out[4]);
    int32_t (*simplex_power)(int32_t dim, const struct cage_site *const v[4]);
    int32_t (*centre_side)(int32_t dim, const struct cage_site *const face[3], const struct cage_site *const v[4]);
    bool (*centre_off)(int32_t dim, const struct cage_site *const v[4], const struct cage_site *ball);
    int32_t (*facet_power)(int32_t dim, const struct cage_site *const facet[3]);
    bool (*facet_attached)(int32_t dim, const struct cage_site *const facet[3], const struct cage_site *w);
    bool (*edges_covered)(int32_t count, const int64_t square[3], const int64_t weight[3]);
    bool (*tetrahedron_covered)(int64_t square[4][4], const int64_t weight[4]);
    long *exact; /* counts the 256-bit products of predicate.c; null where nobody counts */
};

extern const struct backend native;       /* as the library is built */
extern const struct backend limbs;        /* portable limbs */
extern const struct backend broken_carry; /* limbs whose 128-bit sum loses the carry between its words */
extern const struct backend broken_sign;  /* limbs whose 64 by 64 bit product takes its factors for unsigned */

#endif
