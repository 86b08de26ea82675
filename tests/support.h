/* support.h: what every test of the core shares: numbers drawn at random and the way a suite is run. */
#ifndef SUPPORT_H
#define SUPPORT_H

#include <stdint.h>
#include <time.h>

#include <check.h>

#include "random.h"

/* ck_assert for inner loops: Check writes every assertion to a file, this one only those that fail. */
#define test_require(condition)                       \
    do {                                              \
        if (!(condition))                             \
            ck_abort_msg("not so: %s", #condition);   \
    } while (0)

/* Uniform in low..high, both included. */
int64_t test_between(uint64_t *state, int64_t low, int64_t high);

/* Of random sign and random bit length, so that small and large are equally likely; |value| <= limit. */
int64_t test_spread(uint64_t *state, int64_t limit);

/* Shuffle 0..count-1 into order. */
void test_shuffle(uint64_t *state, int32_t *order, int32_t count);

/* full, or that part of it (never 0) that CAGE_TEST_QUICK says in the environment: 10 means a tenth. */
int32_t test_rounds(int32_t full);

/* How many scenes to try: the number in CAGE_TEST_SCENES, or full where that is not set; never 0. */
int32_t test_scenes(int32_t full);

/* Of processor time. */
double test_seconds_since(clock_t start);

/* malloc or the end of the test program. */
void *test_alloc(size_t bytes);

/* A test case of the suite with a time limit that suits slow machines. */
TCase *test_case(Suite *suite, const char *name);

/* Run the suite; the exit status for main. Frees the suite. */
int test_main(Suite *suite);

#endif
