/* test_sizes.c: what the size functions say, beside what proofs and surveys then take; and their constant expressions. */
#include "support.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

#include "referee.h"
#include "scenes.h"
#include "scenes_space.h"
#include "survey.h"

#define PLENTY ((size_t)256 << 20)

static unsigned char *block;

static void block_make(void) { block = test_alloc(PLENTY); }
static void block_drop(void) { free(block); }

/* How often what was taken is within a factor of two of what was said, and how often that was enough. */
struct tally {
    int32_t all, near, enough;
    double least, most;
};

static void count(struct tally *t, size_t said, uint64_t taken, bool enough)
{
    double ratio = (double)said / (double)taken;
    t->least = t->all == 0 || ratio < t->least ? ratio : t->least;
    t->most = t->all == 0 || ratio > t->most ? ratio : t->most;
    t->all++;
    t->near += ratio >= 0.5 && ratio <= 2;
    t->enough += enough;
}

static void show(const char *what, const struct tally *t)
{
    printf("note: %s: %d, said to taken %.2f to %.2f, within a factor of two %d, enough to finish %d\n", what, (int)t->all, t->least,
           t->most, (int)t->near, (int)t->enough);
}

/* ---- proofs ---------------------------------------------------------------------------------------------- */

static void prove(const cage_scene *view, const cage_pose *start, const cage_pose *goal, int32_t cells, struct tally *tally)
{
    cage_limits limits;
    cage_result r, t;
    cage_limits_default(&limits, view->dim);
    limits.max_cells = cells > 0 ? cells : limits.max_cells;
    question q = {view, start, goal, &limits};
    size_t said = cage_prove_size(view, &limits);
    ck_assert_int_eq(referee_prove(&q, 0, block, PLENTY, &r), CAGE_OK);
    if (!referee_decided(r.verdict))
        return;
    int32_t error = referee_prove(&q, 0, block, said, &t);
    ck_assert(error == CAGE_OK || error == CAGE_ERROR_MEMORY);
    if (error == CAGE_OK)
        ck_assert_int_eq(t.verdict, r.verdict);
    count(tally, said, r.peak_bytes, error == CAGE_OK);
}

START_TEST(proofs_in_the_plane)
{
    struct tally t = {0, 0, 0, 0, 0};
    for (int32_t seed = 0; seed < test_rounds(60); seed++) {
        scene s;
        scene_random((uint64_t)seed, &s);
        cage_scene view = scene_view(&s);
        prove(&view, &s.start, scene_goal(&s), 0, &t);
    }
    show("proofs in the plane", &t);
    ck_assert(t.near == t.all && t.enough == t.all);
}
END_TEST

START_TEST(proofs_in_space)
{
    struct tally t = {0, 0, 0, 0, 0};
    for (int32_t seed = 0; seed < test_rounds(16); seed++) {
        space_scene s;
        space_random((uint64_t)seed, &s);
        cage_scene view = space_view(&s);
        prove(&view, &s.start, space_goal(&s), 4000, &t);
    }
    show("proofs in space", &t);
    ck_assert(t.all - t.near <= 1 + t.all / 5 && t.all - t.enough <= 1 + t.all / 5);
}
END_TEST

/* ---- surveys --------------------------------------------------------------------------------------------- */

static void survey(const cage_scene *view, int32_t level, int32_t cells, struct tally *tally)
{
    cage_plan plan;
    cage_survey *made;
    cage_plan_default(&plan);
    plan.level = level;
    plan.max_cells = cells;
    size_t said = cage_survey_size(view, &plan);
    ck_assert_int_eq(cage_survey_begin(&made, view, &plan, block, PLENTY), CAGE_OK);
    ck_assert_int_eq(cage_survey_run(made, INT64_MAX), 1);
    uint64_t taken = cage_survey_result_of(made)->peak_bytes;
    ck_assert_int_eq(cage_survey_begin(&made, view, &plan, block, said), CAGE_OK);
    int32_t state = cage_survey_run(made, INT64_MAX);
    ck_assert(state == 1 || state == CAGE_ERROR_MEMORY);
    count(tally, said, taken, state == 1);
}

START_TEST(surveys)
{
    static const int32_t plans[2][3][2] = {{{-1, 0}, {5, 0}, {3, 100}}, {{0, 0}, {1, 0}, {0, 60}}}; /* level, budget */
    for (int32_t dim = 2; dim <= 3; dim++) {
        struct tally t = {0, 0, 0, 0, 0};
        for (int32_t seed = 0; seed < test_rounds(dim == 2 ? 40 : 12); seed++)
            for (int32_t k = 0; k < 3; k++) {
                scene s;
                space_scene in_space;
                scene_random((uint64_t)seed, &s);
                space_random((uint64_t)seed, &in_space);
                cage_scene view = dim == 2 ? scene_view(&s) : space_view(&in_space);
                survey(&view, plans[dim - 2][k][0], plans[dim - 2][k][1], &t);
            }
        show(dim == 2 ? "surveys in the plane" : "surveys in space", &t);
        ck_assert(t.all - t.near <= 1 + t.all / 10);
    }
}
END_TEST

/* Steps that are taken again when there is more room leave nothing from before: facts take as much as in a large block. */
START_TEST(small_blocks_waste_nothing)
{
    int32_t finished = 0;
    for (int32_t seed = 0; seed < 3; seed++) {
        scene s;
        cage_plan plan;
        cage_survey *made;
        scene_random((uint64_t)seed, &s);
        cage_scene view = scene_view(&s);
        cage_plan_default(&plan);
        plan.level = 3;
        ck_assert_int_eq(cage_survey_begin(&made, &view, &plan, block, PLENTY), CAGE_OK);
        ck_assert_int_eq(cage_survey_run(made, INT64_MAX), 1);
        size_t facts = made->proof->arena.used, peak = (size_t)made->result.peak_bytes;
        for (size_t bytes = peak / 10 * 8; bytes < 2 * peak; bytes += peak / (size_t)test_rounds(400)) {
            if (cage_survey_begin(&made, &view, &plan, block, bytes) != CAGE_OK || cage_survey_run(made, INT64_MAX) != 1)
                continue;
            ck_assert_uint_eq(made->proof->arena.used, facts);
            finished++;
        }
    }
    ck_assert_int_gt(finished, 0);
}
END_TEST

/* ---- constant expressions -------------------------------------------------------------------------------- */

enum { MOST_BALLS = 400 };

static void compare(size_t macro, size_t said, double most)
{
    ck_assert_uint_ge(macro, said);
    ck_assert_msg((double)macro <= most * (double)said, "%zu for %zu", macro, said);
}

START_TEST(macros)
{
    static const cage_ball ball[MOST_BALLS] = {{0, 0, 0, 1}};
    cage_limits limits;
    cage_plan plan;
    for (int32_t dim = 2; dim <= 3; dim++)
        for (int32_t n = 0; n <= 40; n += 4)
            for (int32_t m = 0; m <= MOST_BALLS; m = 2 * m + 1) {
                const uint32_t objects = (uint32_t)n, obstacles = (uint32_t)m;
                const cage_scene view = {{ball, ball, n, n}, {ball, ball, m, m}, dim};
                for (int32_t cells = 2; cells <= 1 << 24; cells = cells * 3 / 2)
                    for (int32_t k = 0; k < 9; k++) {
                        cage_limits_default(&limits, dim);
                        limits.max_cells = cells;
                        limits.side = 1 + k % 3;
                        limits.start_level = k / 3 - 1;
                        size_t said = cage_prove_size(&view, &limits);
                        bool two = limits.side == CAGE_SIDE_BOTH && cells / 8 >= (k < 6 ? 4 : 36); /* cells down to the level */
                        if (said > 0)
                            compare(CAGE_PROVE_BYTES(dim, objects, obstacles, (uint32_t)cells), said, dim == 2 || two ? 1.2 : 3.1);
                    }
                for (int32_t level = 0; level <= (dim == 2 ? 14 : 6); level++)
                    for (int32_t budget = 0; budget < 3; budget++) {
                        int32_t slices = dim == 2 ? 2 << level : 4 << 3 * level;
                        cage_plan_default(&plan);
                        plan.level = level;
                        plan.max_cells = budget * 2 * slices;
                        size_t said = cage_survey_size(&view, &plan);
                        if (said > 0)
                            compare(CAGE_SURVEY_BYTES(dim, objects, obstacles, (uint32_t)(budget ? plan.max_cells : slices)), said,
                                    budget && dim == 2 ? 2.2 : 1.4);
                    }
            }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("sizes");
    TCase *tests = test_case(suite, "sizes");
    tcase_set_timeout(tests, 0);
    tcase_add_checked_fixture(tests, block_make, block_drop);
    tcase_add_test(tests, proofs_in_the_plane);
    tcase_add_test(tests, proofs_in_space);
    tcase_add_test(tests, surveys);
    tcase_add_test(tests, small_blocks_waste_nothing);
    tcase_add_test(tests, macros);
    return test_main(suite);
}
