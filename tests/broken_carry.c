/* broken_carry.c: the limbs with a deliberate error that the tests must catch: sums lose the carry between words. */
#ifndef CAGE_LIMBS
#define CAGE_LIMBS 1
#endif
#define PREFIX broken_carry_
#include "rename.h"

#define cage_i128_add sound_i128_add
#define cage_i128_add_product sound_i128_add_product
#include "../src/wide.h"
#undef cage_i128_add
#undef cage_i128_add_product

static inline cage_i128 cage_i128_add(cage_i128 a, cage_i128 b)
{
    return cage_i128_make(a.high + b.high, a.low + b.low);
}

static inline void cage_i128_add_product(cage_i128 *sum, int64_t a, int64_t b) { *sum = cage_i128_add(*sum, cage_i128_mul(a, b)); }

#include "../src/wide.c"
#include "../src/predicate.c"
#include "backend.h"

#include <stddef.h>

#define BACKEND broken_carry
#include "backend_body.h"
