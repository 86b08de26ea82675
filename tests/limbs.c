/* limbs.c: a second build of wide and predicate, with portable limbs, and its 256-bit products counted. */
#ifndef CAGE_LIMBS
#define CAGE_LIMBS 1
#endif
#define PREFIX limbs_
#include "rename.h"

#include "../src/wide.c"
#include "backend.h"

static long products;

static cage_i256 counted_mul(cage_i128 a, cage_i128 b)
{
    products++;
    return cage_i256_mul(a, b);
}

#undef cage_i256_mul
#define cage_i256_mul counted_mul
#include "../src/predicate.c"

#define BACKEND limbs
#define BACKEND_EXACT &products
#include "backend_body.h"
