/* test_candidate: the way left open of questions that were not decided: what it is, what asking for it leaves alone. */
#include "support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "referee.h"
#include "scenes.h"
#include "scenes_space.h"

enum { PLENTY = 16 << 20, STEPS = 4096, POSES = 1 << 15, GRID = 4096, GUARD = 4096, SAMPLES = 8 };

/* A random scene of the plane or of space, its cells so coarse that often nothing is decided. */
typedef struct trial {
    scene plane;
    space_scene space;
    cage_scene view;
    cage_limits limits;
    question q;
} trial;

typedef struct way {
    int32_t answer, count[2];
    cage_step step[STEPS];
    cage_pose pose[POSES];
} way;

typedef struct tally {
    int32_t undecided, found, none, with_goal, decided;
} tally;

static unsigned char *block;
static way first, again;
static uint8_t mask[2][GRID];

static void make_trial(uint64_t seed, int32_t dim, trial *t)
{
    if (dim == 2) {
        scene_random(seed, &t->plane);
        t->view = scene_view(&t->plane);
    } else {
        space_random(seed, &t->space);
        t->view = space_view(&t->space);
    }
    cage_limits_default(&t->limits, dim);
    t->limits.start_level = -1;
    t->limits.max_level = (int32_t)(seed / 16 % (dim == 2 ? 4 : 2));
    t->limits.max_cells = dim == 2 ? 60 : 80;
    t->limits.side = seed % 3 == 0 ? CAGE_SIDE_INNER : CAGE_SIDE_BOTH;
    t->q.view = &t->view;
    t->q.start = dim == 2 ? &t->plane.start : &t->space.start;
    t->q.goal = dim == 2 ? scene_goal(&t->plane) : space_goal(&t->space);
    t->q.limits = &t->limits;
}

/* The proof, run to its end; CAGE_OK or the error. *proof null: it did not begin. */
static int32_t prove(const trial *t, unsigned char *memory, size_t bytes, cage_proof **proof)
{
    *proof = NULL;
    int32_t state = cage_prove_begin(proof, t->q.view, t->q.start, t->q.goal, t->q.limits, memory, bytes);
    while (state == 0)
        state = cage_prove_run(*proof, 1000);
    return state < 0 ? state : CAGE_OK;
}

static void ask(cage_proof *proof, way *out)
{
    memset(out, 0x77, sizeof *out);
    out->answer = cage_prove_candidate(proof, out->step, STEPS, out->pose, POSES, out->count);
}

static int same_way(const way *a, const way *b)
{
    return a->answer == b->answer && memcmp(a->count, b->count, sizeof a->count) == 0 &&
           (a->answer != 1 || (memcmp(a->step, b->step, (size_t)a->count[0] * sizeof a->step[0]) == 0 &&
                               memcmp(a->pose, b->pose, (size_t)a->count[1] * sizeof a->pose[0]) == 0));
}

/* ---- what it is ------------------------------------------------------------------------------------------ */

static void rotate(const long double q[4], const long double v[3], long double out[3])
{
    long double c[3], square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
    const long double *u = q + 1;
    for (int k = 0; k < 3; k++)
        c[k] = 2 * (u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3]);
    for (int k = 0; k < 3; k++)
        out[k] = v[k] + (q[0] * c[k] + u[(k + 1) % 3] * c[(k + 2) % 3] - u[(k + 2) % 3] * c[(k + 1) % 3]) / square;
}

/* How deep balls are in each other, at most, less what this ball moves by the turn of sine `sine`, twice. */
static long double excess(const trial *t, const int32_t pivot[3], const long double x[3], const long double q[4],
                          long double sine)
{
    const cage_shape *object = &t->view.object, *obstacles = &t->view.obstacles;
    long double most = -INFINITY;
    for (int32_t i = 0; i < object->inner_count; i++) {
        const cage_ball *y = &object->inner[i];
        const long double v[3] = {y->x - pivot[0], y->y - pivot[1], y->z - pivot[2]};
        const long double arm = sqrtl(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
        long double at[3];
        rotate(q, v, at);
        for (int32_t j = 0; j < obstacles->inner_count; j++) {
            const cage_ball *o = &obstacles->inner[j];
            const long double dx = x[0] + at[0] - o->x, dy = x[1] + at[1] - o->y, dz = x[2] + at[2] - o->z;
            most = fmaxl(most, y->r + o->r - sqrtl(dx * dx + dy * dy + dz * dz) - 2 * 2 * sine * arm);
        }
    }
    return most;
}

/* From the middle of a cell of that level, the sine of half the angle to its farthest rotation: the widths of cells in the plane
 * differ by 1 %, the angles in space are those of the design's table. */
static long double farthest(int32_t dim, int32_t level)
{
    static const long double space[] = {120, 71.6L, 39.3L, 20};
    if (level < 0)
        return 0;
    return sinl((dim == 2 ? 91.0L / (1 << level) : space[level] + 0.1L) / 360 * acosl(-1));
}

static int turns(const cage_pose *a, const cage_pose *b) { return memcmp(a->q, b->q, sizeof a->q) != 0; }
static int moves(const cage_pose *a, const cage_pose *b) { return memcmp(a->x, b->x, sizeof a->x) != 0; }

/* Over a cell the balls, made smaller by what they move to its farthest rotation, are clear at its middle; at another of its
 * rotations balls as given are no deeper than twice that. */
static void check_depth(const trial *t, const int32_t pivot[3], const way *w, uint64_t seed)
{
    long double worst = -INFINITY;
    for (int32_t s = 0; s < w->count[0]; s++) {
        const int32_t end = s + 1 < w->count[0] ? w->step[s + 1].pose : w->count[1];
        for (int32_t i = w->step[s].pose; i + 1 < end; i++)
            for (int n = 0; n <= SAMPLES; n++) {
                const long double f = (long double)n / SAMPLES;
                long double x[3], q[4], dot = 0;
                for (int k = 0; k < 4; k++)
                    dot += (long double)w->pose[i].q[k] * w->pose[i + 1].q[k];
                for (int k = 0; k < 3; k++)
                    x[k] = (1 - f) * w->pose[i].x[k] + f * w->pose[i + 1].x[k];
                for (int k = 0; k < 4; k++)
                    q[k] = (1 - f) * w->pose[i].q[k] + f * w->pose[i + 1].q[k] * (dot < 0 ? -1 : 1);
                worst = fmaxl(worst, excess(t, pivot, x, q, farthest(t->view.dim, w->step[s].level)));
            }
    }
    ck_assert_msg(worst < 8, "seed %lu: deeper than the cells explain by %Lg", (unsigned long)seed, worst);
}

static void check_way(const trial *t, const cage_result *r, const way *w, uint64_t seed)
{
    ck_assert_msg(w->count[0] > 0 && w->count[0] <= STEPS && w->count[1] > 1 && w->count[1] <= POSES, "seed %lu",
                  (unsigned long)seed);
    ck_assert(w->step[0].level == -1 && w->step[0].pose == 0);
    for (int32_t s = 0; s < w->count[0]; s++) {
        const int32_t end = s + 1 < w->count[0] ? w->step[s + 1].pose : w->count[1];
        int at_it = 0;
        ck_assert(w->step[s].pose < end && w->step[s].level <= r->level);
        ck_assert(w->step[s].level >= 0 || memcmp(w->step[s].q, t->q.start->q, sizeof t->q.start->q) == 0 ||
                  (t->q.goal && memcmp(w->step[s].q, t->q.goal->q, sizeof t->q.goal->q) == 0));
        for (int32_t i = w->step[s].pose; i < end; i++)
            at_it |= memcmp(w->pose[i].q, w->step[s].q, sizeof w->step[s].q) == 0;
        ck_assert_msg(at_it, "seed %lu: step %d of %d without its rotation", (unsigned long)seed, (int)s, (int)w->count[0]);
        ck_assert(t->q.goal || (w->step[s].component == 0) == (s == w->count[0] - 1));
    }
    for (int32_t i = 0; i + 1 < w->count[1]; i++)
        ck_assert(!turns(&w->pose[i], &w->pose[i + 1]) || !moves(&w->pose[i], &w->pose[i + 1]));
    /* start and goal: where these put the pivot */
    for (int e = 0; e < (t->q.goal ? 2 : 1); e++) {
        const cage_pose *asked = e ? t->q.goal : t->q.start, *given = &w->pose[e ? w->count[1] - 1 : 0];
        const long double q[4] = {asked->q[0], asked->q[1], asked->q[2], asked->q[3]};
        const long double v[3] = {r->pivot[0], r->pivot[1], r->pivot[2]};
        long double at[3];
        rotate(q, v, at);
        ck_assert(memcmp(asked->q, given->q, sizeof asked->q) == 0);
        for (int k = 0; k < 3; k++)
            ck_assert(fabsl(asked->x[k] + at[k] - given->x[k]) < 1);
    }
    check_depth(t, r->pivot, w, seed);
}

/* ---- what it leaves alone ---------------------------------------------------------------------------------- */

static void draw(const trial *t, cage_proof *proof, uint8_t *out)
{
    const int32_t side = t->view.dim == 2 ? 64 : 16, count[3] = {side, side, t->view.dim == 2 ? 1 : side};
    int32_t wide = 1, origin[3];
    for (int32_t j = 0; j < t->view.obstacles.inner_count; j++) {
        const cage_ball *b = &t->view.obstacles.inner[j];
        wide = abs(b->x) > wide ? abs(b->x) : wide;
        wide = abs(b->y) > wide ? abs(b->y) : wide;
        wide = abs(b->z) > wide ? abs(b->z) : wide;
    }
    for (int k = 0; k < 3; k++)
        origin[k] = k == 2 && t->view.dim == 2 ? 0 : -wide;
    memset(out, 0x77, GRID);
    ck_assert_int_eq(cage_prove_region(proof, origin, 2 * wide / side + 1, count, out), CAGE_OK);
}

/* With less room the same, as far as there is room, and nothing after it. */
static void with_less_room(cage_proof *proof, const way *right, uint64_t *rng)
{
    for (int n = 0; n < 4; n++) {
        const int32_t steps = n == 0 ? 0 : (int32_t)test_between(rng, 0, right->count[0]);
        const int32_t poses = n == 1 ? 0 : (int32_t)test_between(rng, 0, right->count[1]);
        memset(&again, 0x77, sizeof again);
        int32_t answer = cage_prove_candidate(proof, steps ? again.step : NULL, steps, poses ? again.pose : NULL, poses,
                                              again.count);
        ck_assert(answer == 1 && memcmp(again.count, right->count, sizeof again.count) == 0);
        ck_assert(memcmp(again.step, right->step, (size_t)steps * sizeof again.step[0]) == 0);
        ck_assert(memcmp(again.pose, right->pose, (size_t)poses * sizeof again.pose[0]) == 0);
        for (size_t i = (size_t)steps * sizeof again.step[0]; i < sizeof again.step; i++)
            test_require(((unsigned char *)again.step)[i] == 0x77);
        for (size_t i = (size_t)poses * sizeof again.pose[0]; i < sizeof again.pose; i++)
            test_require(((unsigned char *)again.pose)[i] == 0x77);
    }
}

static void try_one(uint64_t seed, int32_t dim, uint64_t *rng, tally *sum)
{
    trial t;
    cage_proof *proof;
    make_trial(seed, dim, &t);
    ck_assert_int_eq(prove(&t, block, PLENTY, &proof), CAGE_OK);
    const cage_result before = *cage_prove_result(proof);
    if (before.verdict != CAGE_UNDEFINED) {
        ask(proof, &first);
        ck_assert(first.answer == 0 && first.count[0] == 0 && first.count[1] == 0);
        ck_assert(first.step[0].level == 0x77777777 && first.pose[0].x[0] == 0x77777777);
        sum->decided++;
        return;
    }
    sum->undecided++;
    draw(&t, proof, mask[0]);
    ask(proof, &first);
    draw(&t, proof, mask[1]);
    ck_assert_msg(memcmp(mask[0], mask[1], GRID) == 0, "seed %lu: the region is another one now", (unsigned long)seed);
    ck_assert_int_eq(cage_prove_run(proof, 1000), 1);
    ck_assert(referee_difference(&before, cage_prove_result(proof), 1) == NULL);
    ask(proof, &again);
    ck_assert_msg(same_way(&first, &again), "seed %lu: asked again it is another one", (unsigned long)seed);
    ck_assert(first.answer == 0 || first.answer == 1);
    sum->found += first.answer;
    sum->none += 1 - first.answer;
    sum->with_goal += first.answer && t.q.goal;
    if (first.answer == 1) {
        check_way(&t, &before, &first, seed);
        with_less_room(proof, &first, rng);
    }
}

static void candidates(int32_t dim, int32_t scenes)
{
    uint64_t rng = 5;
    tally sum = {0, 0, 0, 0, 0};
    const int32_t n = test_scenes(scenes);
    for (int32_t seed = 0; seed < n; seed++)
        try_one((uint64_t)seed, dim, &rng, &sum);
    printf("note: candidates in %d dimensions: %d scenes undecided, of these %d with a candidate (%d to a goal); %d decided\n",
           (int)dim, (int)sum.undecided, (int)sum.found, (int)sum.with_goal, (int)sum.decided);
    ck_assert(n < scenes || (sum.found > scenes / 20 && sum.with_goal > scenes / 50 && sum.decided > scenes / 20));
}

START_TEST(in_the_plane) { candidates(2, 500); }
END_TEST

START_TEST(in_space) { candidates(3, 100); }
END_TEST

/* ---- blocks of every size ---------------------------------------------------------------------------------- */

/* In exactly so many bytes, guards on either side: the same answer, or an error and then *next, which is larger. 1: answered. */
static int in_block(const trial *t, size_t bytes, const way *right, size_t *next)
{
    unsigned char *heap = test_alloc(bytes + 2 * GUARD), *at = heap + GUARD;
    cage_proof *proof;
    memset(heap, 0x5a, GUARD);
    memset(at, 0xee, bytes);
    memset(at + bytes, 0x5a, GUARD);
    int32_t error = prove(t, at, bytes, &proof), answered = 0;
    if (error == CAGE_OK) {
        ask(proof, &again);
        error = again.answer < 0 ? again.answer : CAGE_OK;
        answered = error == CAGE_OK;
        ck_assert(!answered || same_way(right, &again));
        ck_assert(answered || (again.count[0] == 0 && again.count[1] == 0));
    }
    ck_assert(error == CAGE_OK || error == CAGE_ERROR_MEMORY);
    if (!answered) {
        *next = proof ? (size_t)cage_prove_result(proof)->needed_bytes : cage_prove_size(&t->view, &t->limits);
        ck_assert(*next > bytes);
    }
    for (int i = 0; i < GUARD; i++)
        test_require(heap[i] == 0x5a && at[bytes + (size_t)i] == 0x5a);
    free(heap);
    return answered;
}

static void squeeze(int32_t dim, int32_t scenes, int32_t sizes)
{
    int32_t squeezed = 0, answered = 0, refused = 0;
    const int32_t n = test_rounds(scenes);
    for (uint64_t seed = 0; squeezed < n && seed < 1000; seed++) {
        trial t;
        cage_proof *proof;
        make_trial(seed, dim, &t);
        ck_assert_int_eq(prove(&t, block, PLENTY, &proof), CAGE_OK);
        if (cage_prove_result(proof)->verdict != CAGE_UNDEFINED)
            continue;
        ask(proof, &first);
        if (first.answer != 1)
            continue;
        squeezed++;
        size_t next, most = cage_prove_size(&t.view, &t.limits);
        for (int32_t k = 0; k < sizes; k++) {
            const int yes = in_block(&t, most * (size_t)k / (size_t)sizes + (size_t)k % 7, &first, &next);
            answered += yes;
            refused += !yes;
        }
        size_t bytes = most / 8;
        for (int tries = 0; !in_block(&t, bytes, &first, &next); tries++) {
            ck_assert_int_lt(tries, 40);
            bytes = next;
        }
    }
    printf("note: candidates in %d dimensions: %d scenes in smaller blocks, %d answered, %d refused\n", (int)dim, (int)squeezed,
           (int)answered, (int)refused);
    ck_assert(squeezed == n && answered > 0 && refused > 0);
}

START_TEST(small_blocks_in_the_plane) { squeeze(2, 24, 48); }
END_TEST

START_TEST(small_blocks_in_space) { squeeze(3, 6, 24); }
END_TEST

/* ---- misuse -------------------------------------------------------------------------------------------------- */

START_TEST(misuse)
{
    /* Two balls far apart in a chamber that holds each of them: over two cells of rotations no inner ball is left. */
    static const cage_ball bar[] = {{-3000, 0, 0, 1000}, {3000, 0, 0, 1000}};
    cage_ball walls[26] = {{-10500, 0, 0, 1200}, {9500, 0, 0, 1200}};
    int32_t count = 2, counts[2] = {7, 7};
    for (int32_t i = -6; i < 6; i++)
        for (int32_t side = -1; side <= 1; side += 2) {
            const cage_ball b = {i * 1500, side * 2600, 0, 1200};
            walls[count++] = b;
        }
    const cage_scene view = {{bar, bar, 2, 2}, {walls, walls, count, count}, 2};
    const cage_pose start = {{0, 0, 0}, {1, 0, 0, 0}};
    cage_limits limits;
    cage_proof *proof;
    cage_step step;
    cage_pose pose;
    cage_limits_default(&limits, 2);
    limits.max_level = 0;
    ck_assert_int_eq(cage_prove_begin(&proof, &view, &start, NULL, &limits, block, PLENTY), 0);
    ck_assert_int_eq(cage_prove_candidate(proof, &step, 1, &pose, 1, counts), CAGE_ERROR_ARGUMENT); /* not yet over */
    ck_assert_int_eq(cage_prove_run(proof, 2), 0);
    ck_assert_int_eq(cage_prove_candidate(proof, &step, 1, &pose, 1, counts), CAGE_ERROR_ARGUMENT);
    int32_t state = 0; /* and that has disturbed nothing */
    while (state == 0)
        state = cage_prove_run(proof, 10);
    ck_assert_int_eq(cage_prove_result(proof)->verdict, CAGE_UNDEFINED);
    ck_assert_int_eq(cage_prove_candidate(NULL, &step, 1, &pose, 1, counts), CAGE_ERROR_ARGUMENT);
    ck_assert_int_eq(cage_prove_candidate(proof, &step, 1, &pose, 1, NULL), CAGE_ERROR_ARGUMENT);
    ck_assert_int_eq(cage_prove_candidate(proof, NULL, 1, &pose, 1, counts), CAGE_ERROR_ARGUMENT);
    ck_assert_int_eq(cage_prove_candidate(proof, &step, 1, NULL, 1, counts), CAGE_ERROR_ARGUMENT);
    ck_assert_int_eq(cage_prove_candidate(proof, &step, -1, &pose, 1, counts), CAGE_ERROR_ARGUMENT);
    ck_assert_int_eq(cage_prove_candidate(proof, &step, 1, &pose, -1, counts), CAGE_ERROR_ARGUMENT);
    ck_assert_int_eq(cage_prove_candidate(proof, &step, 1, &pose, 1, counts), 1);
    ck_assert(counts[0] > 1 && counts[1] > 1 && step.level == -1 && step.pose == 0);

    limits.side = CAGE_SIDE_OUTER; /* there is no inner side then */
    ck_assert_int_eq(cage_prove_begin(&proof, &view, &start, NULL, &limits, block, PLENTY), 0);
    while ((state = cage_prove_run(proof, 10)) == 0)
        continue;
    ck_assert_int_eq(cage_prove_result(proof)->verdict, CAGE_UNDEFINED);
    ck_assert_int_eq(cage_prove_candidate(proof, &step, 1, &pose, 1, counts), 0);

    const cage_pose inside = {{0, 2600, 0}, {1, 0, 0, 0}}; /* answered before a step */
    ck_assert_int_ge(cage_prove_begin(&proof, &view, &inside, NULL, NULL, block, PLENTY), 0);
    while ((state = cage_prove_run(proof, 10)) == 0)
        continue;
    ck_assert_int_eq(cage_prove_result(proof)->verdict, CAGE_IN_COLLISION);
    ck_assert_int_eq(cage_prove_candidate(proof, &step, 1, &pose, 1, counts), 0);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("candidate");
    TCase *tests = test_case(suite, "candidates");
    block = test_alloc(PLENTY);
    tcase_add_test(tests, in_the_plane);
    tcase_add_test(tests, in_space);
    tcase_add_test(tests, small_blocks_in_the_plane);
    tcase_add_test(tests, small_blocks_in_space);
    tcase_add_test(tests, misuse);
    int status = test_main(suite);
    free(block);
    return status;
}
