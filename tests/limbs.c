/* limbs.c: a second build of wide and predicate, with portable limbs, and its 256-bit products counted. */
#ifndef CAGE_LIMBS
#define CAGE_LIMBS 1
#endif
#define PREFIX limbs_
#include "rename.h"

#include "../src/wide.c"
#include "backend.h"

static long products;

static void counted(cage_i256 *sum, cage_i128 a, cage_i128 b)
{
    products++;
    cage_i256_add_product(sum, a, b);
}

#undef cage_i256_add_product
#define cage_i256_add_product counted
#include "../src/predicate.c"

#define BACKEND limbs
#define BACKEND_EXACT &products
#include "backend_body.h"
