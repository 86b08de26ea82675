/* test_facts.c: surveys that are interrupted, moved, put together from parts or told nonsense end in the same atlas, or
 * refuse. */
#include "support.h"

#include <stdlib.h>
#include <string.h>

#include "scenes.h"
#include "scenes_space.h"
#include "sealed.h"

#define PLENTY ((size_t)128 << 20)

static unsigned char *block; /* PLENTY bytes, never cleared */

static void block_make(void) { block = test_alloc(PLENTY); }

static void block_drop(void) { free(block); }

struct bytes {
    unsigned char *byte;
    size_t size;
};

static void drop(struct bytes *b) { free(b->byte); }

static struct bytes facts_of(const cage_survey *survey)
{
    struct bytes out;
    out.size = cage_survey_facts(survey, NULL, 0);
    out.byte = test_alloc(out.size + 1);
    out.byte[out.size] = 0x5a;
    test_require(cage_survey_facts(survey, out.byte, out.size - 1) == out.size);
    test_require(cage_survey_facts(survey, out.byte, out.size) == out.size && out.byte[out.size] == 0x5a);
    return out;
}

static struct bytes atlas_of(const cage_survey *survey)
{
    struct bytes out;
    out.size = cage_survey_atlas(survey, NULL, 0);
    test_require(out.size > 0);
    out.byte = test_alloc(out.size);
    test_require(cage_survey_atlas(survey, out.byte, out.size) == out.size);
    return out;
}

static struct bytes make(const cage_scene *view, const cage_plan *plan, int64_t *steps)
{
    cage_survey *survey;
    ck_assert_int_eq(cage_survey_begin(&survey, view, plan, block, PLENTY), CAGE_OK);
    ck_assert_int_eq(cage_survey_run(survey, INT64_MAX), 1);
    *steps = cage_survey_result_of(survey)->steps;
    return atlas_of(survey);
}

static void require_same(const struct bytes *a, const struct bytes *b)
{
    test_require(a->size == b->size && memcmp(a->byte, b->byte, a->size) == 0);
}

/* ---- scenes --------------------------------------------------------------------------------------------- */

struct drawn {
    scene plane;
    space_scene space;
    cage_scene view;
    cage_plan plan;
};

/* Of either dimension, all cells or a budget, one side or both. */
static void draw(uint64_t seed, struct drawn *out)
{
    cage_plan_default(&out->plan);
    if (seed % 3 == 2) {
        space_random(seed, &out->space);
        out->view = space_view(&out->space);
        out->plan.level = (int32_t)(seed / 3 % 2);
        out->plan.max_cells = seed / 6 % 2 ? 60 : 0;
    } else {
        scene_random(seed, &out->plane);
        out->view = scene_view(&out->plane);
        out->plan.level = (int32_t)(seed / 3 % 5);
        out->plan.max_cells = seed / 6 % 2 ? 120 : 0;
    }
    if (out->plan.max_cells == 0)
        out->plan.side = CAGE_SIDE_INNER + (int32_t)(seed / 12 % 3);
}

/* ---- going on ------------------------------------------------------------------------------------------- */

/* So many steps, then on with nothing but the facts, in a block that was overwritten and is of another size. */
START_TEST(interrupted)
{
    int32_t scenes = test_rounds(36), cut = 0;
    for (int32_t i = 0; i < scenes; i++) {
        struct drawn d;
        uint64_t state = (uint64_t)i + 1;
        int64_t all, left = 0, stops = 0;
        draw((uint64_t)i, &d);
        struct bytes right = make(&d.view, &d.plan, &all), facts = {NULL, 0};
        for (int32_t done = 0; !done; stops++) {
            cage_survey *survey;
            size_t offset = (size_t)test_between(&state, 0, 1000);
            ck_assert_int_eq(cage_survey_begin(&survey, &d.view, &d.plan, block + offset, PLENTY / 2 - offset), CAGE_OK);
            if (facts.byte)
                ck_assert_int_eq(cage_survey_learn(survey, facts.byte, facts.size), CAGE_OK);
            drop(&facts);
            done = cage_survey_run(survey, test_between(&state, 1, 1 + all / 2));
            ck_assert_int_ge(done, 0);
            left += cage_survey_result_of(survey)->steps;
            facts = facts_of(survey);
            if (done) {
                struct bytes got = atlas_of(survey);
                require_same(&got, &right);
                drop(&got);
            }
            memset(block, 0x33, 4096);
        }
        ck_assert_int_le(left, all + 2 * stops); /* nothing twice, but for the last look around */
        cut += stops > 1;
        drop(&facts);
        drop(&right);
    }
    ck_assert_int_gt(3 * cut, 2 * scenes);
}
END_TEST

/* Each part by itself; then all of them together, in any order, some twice. */
START_TEST(in_parts)
{
    enum { MOST = 7 };
    for (int32_t i = 0; i < test_rounds(24); i++) {
        struct drawn d;
        struct bytes part[MOST];
        uint64_t state = (uint64_t)i + 77;
        int32_t parts = (int32_t)test_between(&state, 1, MOST), order[MOST];
        int64_t all;
        cage_survey *survey;
        draw((uint64_t)i, &d);
        struct bytes right = make(&d.view, &d.plan, &all);
        for (int32_t k = 0; k < parts; k++) {
            order[k] = k;
            ck_assert_int_eq(cage_survey_begin(&survey, &d.view, &d.plan, block, PLENTY), CAGE_OK);
            ck_assert_int_eq(cage_survey_part(survey, k, parts), CAGE_OK);
            ck_assert_int_eq(cage_survey_run(survey, INT64_MAX), 1);
            ck_assert_int_eq(cage_survey_run(survey, INT64_MAX), 1);
            ck_assert_uint_eq(cage_survey_atlas(survey, NULL, 0), 0);
            const cage_survey_result *r = cage_survey_result_of(survey);
            for (int side = 0; side < 2; side++) /* its own share, rounded, and no more */
                ck_assert_int_eq(r->slices[side], d.plan.side >> side & 1 ? (k + 1) * r->leaves / parts - k * r->leaves / parts : 0);
            part[k] = facts_of(survey);
        }
        ck_assert_int_eq(cage_survey_begin(&survey, &d.view, &d.plan, block, PLENTY), CAGE_OK);
        test_shuffle(&state, order, parts);
        for (int32_t k = 0; k < parts; k++) {
            ck_assert_int_eq(cage_survey_learn(survey, part[order[k]].byte, part[order[k]].size), CAGE_OK);
            if (random_next(&state) % 3 == 0)
                ck_assert_int_eq(cage_survey_learn(survey, part[order[0]].byte, part[order[0]].size), CAGE_OK);
        }
        ck_assert_int_eq(cage_survey_run(survey, INT64_MAX), 1);
        struct bytes got = atlas_of(survey);
        require_same(&got, &right);
        if (d.plan.max_cells == 0) /* no slice was left to build again for its chart */
            ck_assert_int_eq(cage_survey_result_of(survey)->slices[0] + cage_survey_result_of(survey)->slices[1], 0);
        for (int32_t k = 0; k < parts; k++)
            drop(&part[k]);
        drop(&got);
        drop(&right);
    }
}
END_TEST

/* ---- what is refused ------------------------------------------------------------------------------------ */

static const cage_ball bar[2] = {{-40, 3, 0, 30}, {50, 0, 0, 40}};
static const cage_ball posts[6] = {{400, 0, 0, 300}, {-400, 20, 0, 310}, {0, 420, 0, 290},
                                   {10, -430, 0, 280}, {900, 900, 0, 100}, {800, -900, 0, 150}};

static int32_t learn(const cage_scene *view, const cage_plan *plan, const struct bytes *facts)
{
    cage_survey *survey;
    ck_assert_int_eq(cage_survey_begin(&survey, view, plan, block, PLENTY), CAGE_OK);
    return cage_survey_learn(survey, facts->byte, facts->size);
}

/* Another ball by one unit, another plan: other facts. */
START_TEST(of_something_else)
{
    cage_ball other[6];
    const cage_scene view = {{bar, bar, 2, 2}, {posts, posts, 6, 6}, 2};
    cage_plan plan = {CAGE_SIDE_BOTH, 2, 40, {3, 4}};
    cage_survey *survey;
    ck_assert_int_eq(cage_survey_begin(&survey, &view, &plan, block, PLENTY), CAGE_OK);
    ck_assert_int_eq(cage_survey_run(survey, 11), 0);
    struct bytes facts = facts_of(survey);
    ck_assert_int_eq(cage_survey_learn(survey, facts.byte, facts.size), CAGE_ERROR_ARGUMENT); /* it is under way */
    ck_assert_int_eq(cage_survey_part(survey, 0, 1), CAGE_ERROR_ARGUMENT);
    ck_assert_int_eq(learn(&view, &plan, &facts), CAGE_OK);
    for (int32_t i = 0; i < 6 * 3; i++) {
        memcpy(other, posts, sizeof other);
        int32_t *changed = i % 3 == 0 ? &other[i / 3].x : i % 3 == 1 ? &other[i / 3].y : &other[i / 3].r;
        *changed += 1;
        const cage_scene inner = {{bar, bar, 2, 2}, {other, posts, 6, 6}, 2}, outer = {{bar, bar, 2, 2}, {posts, other, 6, 6}, 2};
        ck_assert_int_eq(learn(&inner, &plan, &facts), CAGE_ERROR_ATLAS);
        ck_assert_int_eq(learn(&outer, &plan, &facts), CAGE_ERROR_ATLAS);
    }
    const cage_scene fewer = {{bar, bar, 2, 2}, {posts, posts, 5, 6}, 2}, spare = {{bar, bar, 2, 1}, {posts, posts, 6, 6}, 2};
    const cage_scene deep = {{bar, bar, 2, 2}, {posts, posts, 6, 6}, 3};
    ck_assert_int_eq(learn(&fewer, &plan, &facts), CAGE_ERROR_ATLAS);
    ck_assert_int_eq(learn(&spare, &plan, &facts), CAGE_ERROR_ATLAS);
    cage_plan in_space = {CAGE_SIDE_BOTH, 0, 40, {3, 4}};
    ck_assert_int_eq(learn(&deep, &in_space, &facts), CAGE_ERROR_ATLAS);
    for (int32_t i = 0; i < 3; i++) {
        const cage_plan changed = {i == 0 ? CAGE_SIDE_INNER : plan.side, i == 1 ? 1 : plan.level, i == 2 ? 41 : plan.max_cells,
                                   {3, 4}};
        ck_assert_int_eq(learn(&view, &changed, &facts), CAGE_ERROR_ATLAS);
    }
    plan.note[0] = 9; /* the caller's own affair */
    ck_assert_int_eq(learn(&view, &plan, &facts), CAGE_OK);
    drop(&facts);
}
END_TEST

/* Any byte changed, any length: refused, and the survey is as new. */
START_TEST(damaged)
{
    const cage_scene view = {{bar, bar, 2, 2}, {posts, posts, 6, 6}, 2};
    const cage_plan plan = {CAGE_SIDE_BOTH, 1, 24, {0, 0}};
    cage_survey *survey;
    int64_t all;
    struct bytes right = make(&view, &plan, &all);
    ck_assert_int_eq(cage_survey_begin(&survey, &view, &plan, block, PLENTY), CAGE_OK);
    ck_assert_int_eq(cage_survey_run(survey, all / 2), 0);
    struct bytes facts = facts_of(survey);
    ck_assert_int_eq(cage_survey_begin(&survey, &view, &plan, block, PLENTY), CAGE_OK);
    for (size_t i = 0; i < facts.size; i += getenv("CAGE_TEST_QUICK") ? 7 : 1) {
        unsigned char *exact = test_alloc(i + 1);
        memcpy(exact, facts.byte, i);
        test_require(cage_survey_learn(survey, exact, i) == CAGE_ERROR_ATLAS);
        free(exact);
        facts.byte[i] ^= (unsigned char)(1 + i % 255);
        test_require(cage_survey_learn(survey, facts.byte, facts.size) == CAGE_ERROR_ATLAS);
        facts.byte[i] ^= (unsigned char)(1 + i % 255);
    }
    ck_assert_int_eq(cage_survey_run(survey, INT64_MAX), 1);
    struct bytes got = atlas_of(survey);
    require_same(&got, &right);
    drop(&got);
    drop(&right);
    drop(&facts);
}
END_TEST

/* Words changed under the right sum: an error, or whatever atlas, but no crash and no end without one. */
START_TEST(hidden_damage_is_harmless)
{
    const cage_scene view = {{bar, bar, 2, 2}, {posts, posts, 6, 6}, 2};
    const cage_plan plan = {CAGE_SIDE_BOTH, 1, 24, {0, 0}};
    cage_survey *survey;
    int64_t all;
    int32_t taken = 0, rounds = test_rounds(1500);
    uint64_t state = 3;
    struct bytes right = make(&view, &plan, &all);
    for (int32_t i = 0; i < rounds; i++) {
        ck_assert_int_eq(cage_survey_begin(&survey, &view, &plan, block, PLENTY / 16), CAGE_OK);
        ck_assert_int_ge(cage_survey_run(survey, test_between(&state, 1, all)), 0);
        struct bytes facts = facts_of(survey);
        for (int32_t k = 0; k < 3; k++) {
            size_t at = (size_t)test_between(&state, 37, (int64_t)facts.size / 4 - 1); /* behind head and balls */
            uint32_t drawn = (uint32_t)random_next(&state);
            sealed_put(facts.byte, at, k == 0 ? drawn % 64 : k == 1 ? drawn : drawn % 4 - 2);
        }
        sealed_sum(facts.byte, facts.size);
        ck_assert_int_eq(cage_survey_begin(&survey, &view, &plan, block, PLENTY / 16), CAGE_OK);
        int32_t error = cage_survey_learn(survey, facts.byte, facts.size);
        test_require(error == CAGE_OK || error == CAGE_ERROR_ATLAS || error == CAGE_ERROR_MEMORY);
        taken += error == CAGE_OK;
        if (error == CAGE_OK)
            test_require(cage_survey_run(survey, INT64_MAX) == 1);
        drop(&facts);
    }
    ck_assert(taken > rounds / 10 && taken < rounds);
    drop(&right);
}
END_TEST

/* ---- memory --------------------------------------------------------------------------------------------- */

/* In blocks that are too small, from the facts of one to the next larger: the same atlas, and nothing beyond a block. */
START_TEST(small_blocks)
{
    enum { CANARY = 64 };
    for (int32_t i = 0; i < test_rounds(12); i++) {
        struct drawn d;
        struct bytes facts = {NULL, 0};
        int64_t all;
        int32_t state = 0, tries = 0;
        draw((uint64_t)i, &d);
        struct bytes right = make(&d.view, &d.plan, &all);
        size_t bytes = cage_survey_size(&d.view, &d.plan);
        while (state != 1) {
            unsigned char *memory = test_alloc(bytes + CANARY);
            cage_survey *survey;
            memset(memory + bytes, 0x5a, CANARY);
            ck_assert_int_eq(cage_survey_begin(&survey, &d.view, &d.plan, memory, bytes), CAGE_OK);
            state = facts.byte ? cage_survey_learn(survey, facts.byte, facts.size) : CAGE_OK;
            if (state == CAGE_OK) {
                state = cage_survey_run(survey, INT64_MAX);
                drop(&facts);
                facts = facts_of(survey);
            }
            ck_assert(state == 1 || state == CAGE_ERROR_MEMORY);
            if (state == 1) {
                struct bytes got = atlas_of(survey);
                require_same(&got, &right);
                drop(&got);
            } else
                ck_assert_uint_gt(cage_survey_result_of(survey)->needed_bytes, bytes);
            for (int32_t k = 0; k < CANARY; k++)
                test_require(memory[bytes + (size_t)k] == 0x5a);
            bytes = (size_t)cage_survey_result_of(survey)->needed_bytes;
            free(memory);
            test_require(++tries < 30);
        }
        drop(&facts);
        drop(&right);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("facts");
    TCase *tests = test_case(suite, "facts");
    tcase_add_unchecked_fixture(tests, block_make, block_drop);
    tcase_add_test(tests, interrupted);
    tcase_add_test(tests, in_parts);
    tcase_add_test(tests, of_something_else);
    tcase_add_test(tests, damaged);
    tcase_add_test(tests, hidden_damage_is_harmless);
    tcase_add_test(tests, small_blocks);
    return test_main(suite);
}
