/* support.c: what every test of the core shares: numbers drawn at random and the way a suite is run. */
#include "support.h"

#include <stdio.h>
#include <stdlib.h>

int64_t test_between(uint64_t *state, int64_t low, int64_t high)
{
    uint64_t span = (uint64_t)high - (uint64_t)low + 1;
    return span == 0 ? (int64_t)random_next(state) : (int64_t)((uint64_t)low + random_next(state) % span);
}

int64_t test_spread(uint64_t *state, int64_t limit)
{
    uint64_t size = (random_next(state) >> 1) >> (random_next(state) % 64);
    int64_t value = (int64_t)(size % ((uint64_t)limit + 1));
    return random_next(state) & 1 ? -value : value;
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
    const char *text = getenv("CAGE_TEST_QUICK");
    int32_t part = text ? (int32_t)strtol(text, NULL, 10) : 1;
    return part > 1 && full > 0 ? (full - 1) / part + 1 : full;
}

int32_t test_scenes(int32_t full)
{
    const char *text = getenv("CAGE_TEST_SCENES");
    long n = text ? strtol(text, NULL, 10) : full;
    return n < 1 ? 1 : n > 1000000 ? 1000000 : (int32_t)n;
}

double test_seconds_since(clock_t start)
{
    return (double)(clock() - start) / CLOCKS_PER_SEC;
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
