/* support.c: what every test of the core shares: a deterministic random source and the way a suite is run. */
#include "support.h"

#include <stdio.h>
#include <stdlib.h>

uint64_t test_random(uint64_t *state)
{
    uint64_t z = *state += UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

int64_t test_between(uint64_t *state, int64_t low, int64_t high)
{
    uint64_t span = (uint64_t)high - (uint64_t)low + 1;
    return span == 0 ? (int64_t)test_random(state) : (int64_t)((uint64_t)low + test_random(state) % span);
}

int64_t test_spread(uint64_t *state, int64_t limit)
{
    uint64_t size = (test_random(state) >> 1) >> (test_random(state) % 64);
    int64_t value = (int64_t)(size % ((uint64_t)limit + 1));
    return test_random(state) & 1 ? -value : value;
}

void test_shuffle(uint64_t *state, int32_t *order, int32_t count)
{
    for (int32_t i = 0; i < count; i++) {
        int32_t j = (int32_t)test_between(state, 0, i);
        order[i] = order[j];
        order[j] = i;
    }
}

int32_t test_rounds(int32_t full)
{
    if (!getenv("CAGE_TEST_QUICK"))
        return full;
    return full >= 10 ? full / 10 : 1;
}

void *test_alloc(size_t bytes)
{
    void *block = malloc(bytes > 0 ? bytes : 1);
    if (!block) {
        fputs("test: out of memory\n", stderr);
        exit(2);
    }
    return block;
}

TCase *test_case(Suite *suite, const char *name)
{
    TCase *tests = tcase_create(name);
    tcase_set_timeout(tests, 900);
    suite_add_tcase(suite, tests);
    return tests;
}

int test_main(Suite *suite)
{
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
