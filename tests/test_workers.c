/* test_workers.c: workers change no byte of an answer, whatever they are. */
#include "support.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "referee.h"
#include "scenes.h"
#include "scenes_space.h"

#define PLENTY ((size_t)192 << 20)
#define HELP ((size_t)24 << 20)
#define GUARD 64

static unsigned char *block, *spare, *help;
static long done_by_workers;

static void blocks_make(void)
{
    block = test_alloc(PLENTY);
    spare = test_alloc(PLENTY);
    help = test_alloc(HELP + 2 * GUARD);
}

static void blocks_drop(void)
{
    free(block);
    free(spare);
    free(help);
}

/* ---- ways to run tasks -------------------------------------------------------------------------------- */

typedef void (*one_task)(void *data, int32_t index, int32_t worker);

/* From the last to the first, in worker numbers that look random. */
static void backwards(void *context, int32_t tasks, one_task task, void *data)
{
    const int32_t *count = context;
    for (int32_t i = tasks - 1; i >= 0; i--) {
        task(data, i, (i * 7 + tasks) % *count);
    }
    done_by_workers += tasks;
}

/* Some are never called: the search has to do without. */
static void lazy(void *context, int32_t tasks, one_task task, void *data)
{
    const int32_t *count = context;
    for (int32_t i = 0; i < tasks; i += 3) {
        task(data, i, i % *count);
    }
}

typedef struct crew {
    int32_t count, next, tasks;
    one_task task;
    void *data;
    pthread_mutex_t lock;
} crew;

typedef struct member {
    crew *of;
    int32_t number;
} member;

static void *labour(void *argument)
{
    const member *me = argument;
    for (;;) {
        pthread_mutex_lock(&me->of->lock);
        int32_t i = me->of->next++;
        pthread_mutex_unlock(&me->of->lock);
        if (i >= me->of->tasks) {
            return NULL;
        }
        me->of->task(me->of->data, i, me->number);
    }
}

static void by_threads(void *context, int32_t tasks, one_task task, void *data)
{
    crew *c = context;
    pthread_t thread[4];
    member m[4];
    c->next = 0;
    c->tasks = tasks;
    c->task = task;
    c->data = data;
    for (int32_t i = 0; i < c->count; i++) {
        m[i] = (member){c, i};
        ck_assert_int_eq(pthread_create(&thread[i], NULL, labour, &m[i]), 0);
    }
    for (int32_t i = 0; i < c->count; i++) {
        pthread_join(thread[i], NULL);
    }
    done_by_workers += tasks;
}

/* ---- the same bytes ------------------------------------------------------------------------------------- */

static int32_t prove_with(const question *q, const cage_workers *workers, int64_t portion, unsigned char *memory, size_t bytes,
                          cage_result *r)
{
    cage_proof *proof;
    int32_t state = cage_prove_begin(&proof, q->view, q->start, q->goal, q->limits, memory, bytes);
    memset(r, 0, sizeof *r);
    if (state != CAGE_OK) {
        return state;
    }
    do {
        state = cage_prove_run_with(proof, portion, workers);
    } while (state == 0);
    *r = *cage_prove_result(proof);
    return state;
}

/* All of it, the counts on the way to an error included; a path is compared apart. */
static void expect_same(uint64_t seed, int32_t state, const cage_result *r, int32_t right_state, const cage_result *right,
                        const char *what)
{
    ck_assert_msg(state == right_state, "seed %lu: %s: state %d, not %d", (unsigned long)seed, what, (int)state,
                  (int)right_state);
    const char *wrong = referee_difference(right, r, 1);
    ck_assert_msg(!wrong, "seed %lu: %s: %s", (unsigned long)seed, what, wrong ? wrong : "");
    ck_assert_msg(r->needed_bytes == right->needed_bytes, "seed %lu: %s: needed_bytes", (unsigned long)seed, what);
}

/* Workers of all kinds in a block of that size. */
static void try_workers(const question *q, uint64_t seed, size_t bytes)
{
    cage_result right, r;
    int32_t right_state = prove_with(q, NULL, 1000000000, block, bytes, &right);
    crew c = {2, 0, 0, NULL, NULL, PTHREAD_MUTEX_INITIALIZER};
    for (int32_t kind = 0; kind < 6; kind++) {
        int32_t count = kind == 4 ? 64 : kind == 3 ? 1 : 2 + kind;
        size_t odd = (size_t)(seed % 7), memory = kind == 1 ? HELP / 50 : kind == 2 ? 70000 : kind == 5 ? 0 : HELP;
        cage_workers workers = {count, kind == 2 ? lazy : backwards, &count, help + GUARD + odd, memory - (memory ? odd : 0)};
        if (kind == 0) {
            c.count = 2 + (int32_t)(seed % 3);
            workers.count = c.count;
            workers.run = by_threads;
            workers.context = &c;
        }
        memset(help, 0xa5, GUARD + odd);
        memset(help + GUARD + memory, 0x5a, GUARD);
        int32_t state = prove_with(q, &workers, kind == 3 ? 37 : 1000000000, spare, bytes, &r);
        expect_same(seed, state, &r, right_state, &right, "workers");
        for (size_t i = 0; i < GUARD; i++) {
            ck_assert_msg(help[i] == 0xa5 && help[GUARD + memory + i] == 0x5a, "seed %lu: written beyond the memory",
                          (unsigned long)seed);
        }
    }
}

/* With room for all slices, and in a block that is just enough to begin or too small for that. */
static void ask(const cage_scene *view, const cage_pose *start, const cage_pose *goal, uint64_t seed, int32_t cells)
{
    cage_limits limits;
    cage_limits_default(&limits, view->dim);
    limits.max_cells = cells;
    question q = {view, start, goal, &limits};
    try_workers(&q, seed, PLENTY);
    try_workers(&q, seed, cage_prove_size(view, &limits) / (size_t)(1 + seed % 3));
}

START_TEST(plane_is_the_same)
{
    for (uint64_t seed = 500; seed < 501 + (uint64_t)test_scenes(60) / 10; seed++) {
        scene s;
        scene_random(seed, &s);
        cage_scene view = scene_view(&s);
        ask(&view, &s.start, scene_goal(&s), seed, 200);
    }
}
END_TEST

START_TEST(space_is_the_same)
{
    done_by_workers = 0;
    for (uint64_t seed = 500; seed < 501 + (uint64_t)test_scenes(60) / 20; seed++) {
        space_scene s;
        space_random(seed, &s);
        cage_scene view = space_view(&s);
        ask(&view, &s.start, space_goal(&s), seed, 48);
    }
    printf("workers: %ld slices and gluings in space\n", done_by_workers);
    ck_assert_int_gt(done_by_workers, 0);
}
END_TEST

/* The atlas, made with these workers (null: none) in portions; its size, or an error. */
static int64_t survey_with(const cage_scene *view, int32_t level, const cage_workers *workers, int64_t portion, unsigned char *out)
{
    cage_plan plan;
    cage_survey *survey;
    int32_t state;
    cage_plan_default(&plan);
    plan.level = level;
    plan.max_cells = view->dim == 2 ? 24 : 0;
    ck_assert_int_eq(cage_survey_begin(&survey, view, &plan, block, PLENTY), CAGE_OK);
    do {
        state = cage_survey_run_with(survey, portion, workers);
    } while (state == 0);
    if (state < 0)
        return state;
    size_t size = cage_survey_atlas(survey, NULL, 0);
    ck_assert_uint_le(size, PLENTY / 2);
    ck_assert_uint_eq(cage_survey_atlas(survey, out, PLENTY / 2), size);
    return (int64_t)size;
}

START_TEST(atlas_is_the_same)
{
    done_by_workers = 0;
    for (uint64_t seed = 700; seed < 701 + (uint64_t)test_scenes(60) / 10; seed++) {
        scene s;
        space_scene t;
        scene_random(seed, &s);
        space_random(seed, &t);
        cage_scene view = seed % 3 ? scene_view(&s) : space_view(&t);
        int32_t level = seed % 3 ? (int32_t)(seed % 5) % 3 : 0, three = 3;
        int64_t right = survey_with(&view, level, NULL, INT64_MAX, spare);
        ck_assert_int_gt(right, 0);
        crew c = {2, 0, 0, NULL, NULL, PTHREAD_MUTEX_INITIALIZER};
        for (int kind = 0; kind < 4; kind++) {
            cage_workers workers = {3, kind == 1 ? lazy : backwards, &three, help, kind == 2 ? HELP / 60 : HELP};
            if (kind == 0) {
                workers.count = 2;
                workers.run = by_threads;
                workers.context = &c;
            }
            int64_t size = survey_with(&view, level, &workers, kind == 3 ? 17 : INT64_MAX, spare + PLENTY / 2);
            ck_assert_msg(size == right && memcmp(spare, spare + PLENTY / 2, (size_t)right) == 0, "seed %lu: workers %d: another atlas",
                          (unsigned long)seed, kind);
        }
    }
    printf("workers: %ld slices and gluings of atlases\n", done_by_workers);
    ck_assert_int_gt(done_by_workers, 0);
}
END_TEST

START_TEST(bad_workers_are_refused)
{
    scene s;
    int32_t one = 1;
    scene_random(3, &s);
    cage_scene view = scene_view(&s);
    cage_proof *proof;
    ck_assert_int_eq(cage_prove_begin(&proof, &view, &s.start, NULL, NULL, block, PLENTY), CAGE_OK);
    cage_workers workers = {1, NULL, &one, help, HELP};
    ck_assert_int_eq(cage_prove_run_with(proof, 1, &workers), CAGE_ERROR_ARGUMENT);
    workers.run = backwards;
    workers.memory = NULL;
    ck_assert_int_eq(cage_prove_run_with(proof, 1, &workers), CAGE_ERROR_ARGUMENT);
    workers.bytes = 0;
    ck_assert_int_ge(cage_prove_run_with(proof, 1, &workers), 0);
    for (int32_t count = -1; count <= 96; count++) {
        workers.count = count;
        int32_t state = cage_prove_run_with(proof, 1, &workers);
        ck_assert_msg(count >= 1 && count <= 64 ? state >= 0 : state == CAGE_ERROR_ARGUMENT, "%d workers: %d", (int)count,
                      (int)state);
    }
    ck_assert_int_eq(cage_prove_run_with(NULL, 1, &workers), CAGE_ERROR_ARGUMENT);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("workers");
    TCase *tests = test_case(suite, "workers");
    tcase_add_unchecked_fixture(tests, blocks_make, blocks_drop);
    tcase_add_test(tests, plane_is_the_same);
    tcase_add_test(tests, space_is_the_same);
    tcase_add_test(tests, atlas_is_the_same);
    tcase_add_test(tests, bad_workers_are_refused);
    return test_main(suite);
}
