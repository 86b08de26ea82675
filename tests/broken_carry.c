/* broken_carry.c: the limbs with a deliberate error that the tests must catch: sums lose the carry between words. */
#ifndef CAGE_LIMBS
#define CAGE_LIMBS 1
#endif
#define PREFIX broken_carry_
#include "rename.h"

#define cage_i128_add sound_i128_add
#include "../src/wide.h"
#undef cage_i128_add

static inline cage_i128 cage_i128_add(cage_i128 a, cage_i128 b)
{
    return cage_i128_make(a.high + b.high, a.low + b.low);
}

#include "../src/wide.c"
#include "../src/predicate.c"
#include "backend.h"

#include <stddef.h>

#define BACKEND broken_carry
#include "backend_body.h"
