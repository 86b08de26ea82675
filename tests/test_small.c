/* test_small.c: proofs in the least code: what they refuse, and that no block, portion or worker changes a byte of their answer. (That
 * it is right, the answers' tests see to, beside the oracles.) */
#include "support.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "referee.h"
#include "scenes.h"
#include "scenes_space.h"

#define PLENTY ((size_t)64 << 20)
#define HELP ((size_t)24 << 20)
#define CANARY 64

static unsigned char *block, *spare, *help;

static void blocks_make(void)
{
    block = test_alloc(PLENTY);
    spare = test_alloc(PLENTY);
    help = test_alloc(HELP);
}

static void blocks_drop(void)
{
    free(block);
    free(spare);
    free(help);
}

/* A scene of either dimension with its question for the inner side; not to be copied. */
typedef struct asked {
    scene flat;
    space_scene solid;
    cage_scene view;
    cage_limits limits;
    question q;
} asked;

static void ask(asked *a, uint64_t seed, int32_t cells)
{
    int32_t dim = 2 + (int32_t)(seed % 2);
    if (dim == 2)
        scene_random(seed, &a->flat);
    else
        space_random(seed, &a->solid);
    a->view = dim == 2 ? scene_view(&a->flat) : space_view(&a->solid);
    cage_limits_default(&a->limits, dim);
    a->limits.side = CAGE_SIDE_INNER;
    a->limits.max_cells = cells;
    a->q.view = &a->view;
    a->q.start = dim == 2 ? &a->flat.start : &a->solid.start;
    a->q.goal = dim == 2 ? scene_goal(&a->flat) : space_goal(&a->solid);
    a->q.limits = &a->limits;
}

static void same(const cage_result *right, const cage_result *r, uint64_t seed, const char *what)
{
    const char *wrong = referee_difference(right, r, 0);
    ck_assert_msg(!wrong, "seed %lu, %s: %s", (unsigned long)seed, what, wrong ? wrong : "");
}

/* What is refused, and that it changes nothing. */
START_TEST(arguments)
{
    asked a;
    cage_result r;
    ask(&a, 0, 100);
    cage_proof *none = (cage_proof *)(void *)block, *proof = none;
    cage_limits limits = a.limits;
    ck_assert_int_eq(cage_prove_begin_small(NULL, &a.view, a.q.start, NULL, NULL, block, PLENTY), CAGE_ERROR_ARGUMENT);
    ck_assert_int_eq(cage_prove_begin_small(&proof, NULL, a.q.start, NULL, NULL, block, PLENTY), CAGE_ERROR_ARGUMENT);
    ck_assert_int_eq(cage_prove_begin_small(&proof, &a.view, NULL, NULL, NULL, block, PLENTY), CAGE_ERROR_ARGUMENT);
    ck_assert_int_eq(cage_prove_begin_small(&proof, &a.view, a.q.start, NULL, NULL, NULL, 1), CAGE_ERROR_ARGUMENT);
    ck_assert_int_eq(cage_prove_begin_small(&proof, &a.view, a.q.start, NULL, NULL, NULL, 0), CAGE_ERROR_MEMORY);
    for (int32_t side = CAGE_SIDE_INNER + 1; side <= CAGE_SIDE_BOTH; side++) {
        limits.side = side;
        ck_assert_int_eq(cage_prove_begin_small(&proof, &a.view, a.q.start, NULL, &limits, block, PLENTY), CAGE_ERROR_ARGUMENT);
    }
    limits.side = CAGE_SIDE_INNER;
    limits.max_cells = 1;
    ck_assert_int_eq(cage_prove_begin_small(&proof, &a.view, a.q.start, NULL, &limits, block, PLENTY), CAGE_ERROR_ARGUMENT);
    cage_pose wrong = *a.q.start;
    wrong.q[0] = wrong.q[1] = wrong.q[2] = wrong.q[3] = 0;
    ck_assert_int_eq(cage_prove_begin_small(&proof, &a.view, &wrong, NULL, NULL, block, PLENTY), CAGE_ERROR_ROTATION);
    ck_assert_int_eq(cage_prove_begin_small(&proof, &a.view, a.q.start, &wrong, NULL, block, PLENTY), CAGE_ERROR_ROTATION);
    a.view.dim = 4;
    ck_assert_int_eq(cage_prove_begin_small(&proof, &a.view, a.q.start, NULL, NULL, block, PLENTY), CAGE_ERROR_DIMENSION);
    a.view.dim = 2;
    ck_assert_ptr_eq(proof, none);
    /* Null are the default limits of that side. */
    cage_limits_default(&limits, 2);
    limits.side = CAGE_SIDE_INNER;
    a.q.limits = &limits;
    ck_assert_int_eq(referee_prove_small(&a.q, 0, block, PLENTY, &r), CAGE_OK);
    ck_assert_int_eq(cage_prove_begin_small(&proof, &a.view, a.q.start, a.q.goal, NULL, spare, PLENTY), CAGE_OK);
    ck_assert_int_eq(cage_prove_result(proof)->verdict, CAGE_UNDEFINED);
    while (cage_prove_run_inner(proof, 100) == 0) {}
    same(&r, cage_prove_result(proof), 0, "no limits");
}
END_TEST

/* Two workers that take turns. */
static void two(void *context, int32_t tasks, void (*task)(void *data, int32_t index, int32_t worker), void *data)
{
    (void)context;
    for (int32_t i = tasks; i-- > 0;)
        task(data, i, i % 2);
}

START_TEST(however_it_is_run)
{
    const cage_workers workers = {2, two, NULL, help, HELP};
    for (uint64_t seed = 0; seed < (uint64_t)test_rounds(40); seed++) {
        asked a;
        cage_result r, t;
        ask(&a, seed, seed % 2 ? 40 : 200);
        ck_assert_int_eq(referee_prove_small(&a.q, 0, block, PLENTY, &r), CAGE_OK);
        ck_assert_int_eq(referee_prove_small(&a.q, 1 + (int64_t)seed % 5, spare, PLENTY, &t), CAGE_OK);
        same(&r, &t, seed, "in portions");
        for (int way = 0; way < 2; way++) { /* by the functions that do more; afterwards the region is as ever */
            cage_proof *proof;
            int32_t state;
            ck_assert_int_eq(cage_prove_begin_small(&proof, &a.view, a.q.start, a.q.goal, &a.limits, spare, PLENTY), CAGE_OK);
            do
                state = way == 0 ? cage_prove_run(proof, 3) : cage_prove_run_with(proof, 50, &workers);
            while (state == 0);
            ck_assert_int_eq(state, 1);
            same(&r, cage_prove_result(proof), seed, way == 0 ? "run" : "with workers");
        }
    }
}
END_TEST

/* In exactly so many bytes, between canaries, in a block of junk: the error or the answer. */
static int32_t squeeze(const asked *a, size_t bytes, size_t offset, const cage_result *right, uint64_t seed, uint64_t *needed)
{
    unsigned char *start = spare + CANARY + offset;
    cage_result r;
    memset(spare, 0x5a, CANARY + offset);
    memset(start + bytes, 0x5a, CANARY);
    int32_t error = referee_prove_small(&a->q, 0, start, bytes, &r);
    for (size_t i = 0; i < CANARY; i++)
        ck_assert_msg(spare[offset + i] == 0x5a && start[bytes + i] == 0x5a, "canary, %lu bytes", (unsigned long)bytes);
    *needed = r.needed_bytes;
    if (error == CAGE_OK)
        same(right, &r, seed, "squeezed");
    else
        ck_assert(error == CAGE_ERROR_MEMORY && (r.needed_bytes == 0 || r.needed_bytes > bytes));
    return error;
}

START_TEST(any_block_gives_the_error_or_the_answer)
{
    long runs = 0, answered = 0, rounds = 0, most = 0;
    for (uint64_t seed = 0; seed < (uint64_t)test_rounds(14); seed++) {
        asked a;
        cage_result right;
        uint64_t needed;
        ask(&a, seed + 500, 32);
        ck_assert_int_eq(referee_prove_small(&a.q, 0, block, PLENTY, &right), CAGE_OK);
        if (right.steps > 120)
            continue;
        size_t said = cage_prove_size(&a.view, &a.limits);
        for (size_t bytes = seed; bytes < 2 * said; bytes += bytes / 40 + said / 150 + 1) {
            answered += squeeze(&a, bytes, bytes % 16, &right, seed, &needed) == CAGE_OK;
            runs++;
        }
        size_t bytes = said;
        long round = 0;
        for (; squeeze(&a, bytes, 0, &right, seed, &needed) == CAGE_ERROR_MEMORY && round < 100; round++) {
            ck_assert(needed > bytes && needed <= PLENTY - 2 * CANARY);
            bytes = (size_t)needed;
        }
        ck_assert(round < 100);
        rounds += round;
        most = round > most ? round : most;
    }
    printf("note: %ld blocks, %ld of them enough; from cage_prove_size on %ld rounds in all, at most %ld\n", runs, answered, rounds,
           most);
    ck_assert(answered > 0 && answered < runs);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("small");
    TCase *tests = test_case(suite, "small");
    tcase_set_timeout(tests, 0);
    tcase_add_checked_fixture(tests, blocks_make, blocks_drop);
    tcase_add_test(tests, arguments);
    tcase_add_test(tests, however_it_is_run);
    tcase_add_test(tests, any_block_gives_the_error_or_the_answer);
    return test_main(suite);
}
