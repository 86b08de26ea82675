/* broken_sign.c: the limbs with a deliberate error that the tests must catch: products forget the signs. */
#ifndef CAGE_LIMBS
#define CAGE_LIMBS 1
#endif
#define PREFIX broken_sign_
#include "rename.h"

#define cage_i128_mul sound_i128_mul
#define cage_i128_add_product sound_i128_add_product
#include "../src/wide.h"
#undef cage_i128_mul
#undef cage_i128_add_product

static inline cage_i128 cage_i128_mul(int64_t a, int64_t b) { return cage_u64_mul((uint64_t)a, (uint64_t)b); }

static inline void cage_i128_add_product(cage_i128 *sum, int64_t a, int64_t b) { *sum = cage_i128_add(*sum, cage_i128_mul(a, b)); }

#include "../src/wide.c"
#include "../src/predicate.c"
#include "backend.h"

#include <stddef.h>

#define BACKEND broken_sign
#include "backend_body.h"
