/* random.h: the tests' deterministic random source. */
#ifndef RANDOM_H
#define RANDOM_H

#include <stdint.h>

/* The next 64 bits; *state is any number at first. (SplitMix64: Steele, Lea, Flood, "Fast splittable pseudorandom number
 * generators", OOPSLA 2014.) */
uint64_t random_next(uint64_t *state);

/* In [0, 1). */
double random_unit(uint64_t *state);

#endif
