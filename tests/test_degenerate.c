/* test_degenerate.c: proofs of scenes with nothing in them, one ball, contact, coincidence, or an object larger than
 * the world. */
#include "support.h"

#include <stdlib.h>
#include <string.h>

#include "referee.h"

enum { PLENTY = 32 << 20 };

static const cage_pose origin = {{0, 0, 0}, {1, 0, 0, 0}};

static cage_scene scene_of(const cage_ball *object, int32_t objects, const cage_ball *obstacle, int32_t obstacles)
{
    const cage_scene s = {{object, object, objects, objects}, {obstacle, obstacle, obstacles, obstacles}, 2};
    return s;
}

static int32_t answer(const cage_scene *s, const cage_pose *start, const cage_pose *goal)
{
    static const int32_t sides[3] = {CAGE_SIDE_BOTH, CAGE_SIDE_INNER, CAGE_SIDE_OUTER};
    unsigned char *memory = test_alloc(PLENTY);
    int32_t verdict = CAGE_UNDEFINED;
    for (int k = 2; k >= 0; k--) { /* one side alone never says otherwise */
        cage_limits limits;
        cage_result r;
        cage_limits_default(&limits, 2);
        limits.side = sides[k];
        limits.max_level = k == 0 ? limits.max_level : 5;
        const question q = {s, start, goal, &limits};
        ck_assert_int_eq(referee_prove(&q, 0, memory, PLENTY, &r), CAGE_OK);
        const char *wrong = referee_form(&q, &r);
        ck_assert_msg(!wrong, "%s: %s", cage_verdict_text(r.verdict), wrong);
        ck_assert(k == 2 || !referee_contradiction(verdict, r.verdict));
        verdict = r.verdict;
    }
    free(memory);
    return verdict;
}

START_TEST(nothing_there)
{
    static const cage_ball object[2] = {{-50, 0, 0, 20}, {50, 0, 0, 20}};
    const cage_pose goal = {{-7000, 12345, 0}, {3, 0, 0, -7}};
    for (int k = 0; k < 4; k++) {
        const cage_scene s = scene_of(k & 1 ? object : NULL, k & 1 ? 2 : 0, k & 2 ? object : NULL, k == 2 ? 2 : 0);
        ck_assert_int_eq(answer(&s, &origin, NULL), CAGE_FREE);
        ck_assert_int_eq(answer(&s, &origin, &goal), CAGE_CONNECTED);
        ck_assert_int_eq(answer(&s, &goal, &goal), CAGE_CONNECTED);
    }
}
END_TEST

START_TEST(one_obstacle)
{
    static const cage_ball object[2] = {{-500, 0, 0, 20}, {500, 0, 0, 20}};
    static const cage_pose beyond = {{-4000, 100, 0}, {1, 0, 0, 1}};
    for (int32_t r = 0; r <= 1600; r += 400) {
        const cage_ball x = {1000, 2000, 0, r};
        const cage_scene s = scene_of(object, 2, &x, 1);
        ck_assert_int_eq(answer(&s, &origin, NULL), CAGE_FREE);
        ck_assert_int_eq(answer(&s, &origin, &beyond), CAGE_CONNECTED);
    }
    const cage_ball x = {480, 0, 0, 10};
    const cage_scene s = scene_of(object, 2, &x, 1);
    ck_assert_int_eq(answer(&s, &origin, NULL), CAGE_IN_COLLISION);
    ck_assert_int_eq(answer(&s, &beyond, &origin), CAGE_IN_COLLISION);
}
END_TEST

/* An object that is far larger than all that is around it, hooked around it and beside it. */
START_TEST(object_larger_than_the_world)
{
    cage_ball ring[64];
    static const cage_ball world = {100000, 0, 0, 50};
    int32_t count = 0; /* a square of balls around (100000, 0), in the object's frame */
    for (int32_t i = -8; i < 8; i++) {
        const cage_ball side[4] = {{100000 + i * 1000, -8000, 0, 800},
                                   {108000, i * 1000, 0, 800},
                                   {100000 - i * 1000, 8000, 0, 800},
                                   {92000, -i * 1000, 0, 800}};
        memcpy(&ring[count], side, sizeof side);
        count += 4;
    }
    const cage_scene caged = scene_of(ring, count, &world, 1);
    ck_assert_int_eq(answer(&caged, &origin, NULL), CAGE_CAGED);
    const cage_pose outside = {{20000, 0, 0}, {1, 0, 0, 0}}, elsewhere = {{-90000, -10000, 0}, {1, 0, 0, 2}};
    ck_assert_int_eq(answer(&caged, &outside, NULL), CAGE_FREE);
    ck_assert_int_eq(answer(&caged, &origin, &outside), CAGE_DISCONNECTED);
    ck_assert_int_eq(answer(&caged, &outside, &origin), CAGE_DISCONNECTED);
    ck_assert_int_eq(answer(&caged, &outside, &elsewhere), CAGE_CONNECTED);
}
END_TEST

/* A start in contact, exactly: it can leave, and it can stay caged. */
START_TEST(start_in_contact)
{
    for (int32_t scale = 1000; scale <= 1000000; scale *= 10) {
        const cage_ball y = {0, 0, 0, 2 * scale}, one = {3 * scale, 4 * scale, 0, 3 * scale};
        const cage_scene touching = scene_of(&y, 1, &one, 1);
        ck_assert_int_eq(cage_collides(&touching, &origin, CAGE_SIDE_INNER), 0);
        ck_assert_int_eq(answer(&touching, &origin, NULL), CAGE_FREE);
        const cage_pose goal = {{6 * scale, 8 * scale, 0}, {1, 0, 0, 5}}; /* in contact again, on the far side */
        ck_assert_int_eq(cage_collides(&touching, &goal, CAGE_SIDE_INNER), 0);
        ck_assert_int_eq(answer(&touching, &origin, &goal), CAGE_CONNECTED);
        ck_assert_int_eq(answer(&touching, &goal, &origin), CAGE_CONNECTED);
        const cage_ball two[2] = {{3 * scale, 4 * scale, 0, 3 * scale}, {3 * scale, -4 * scale, 0, 3 * scale}};
        const cage_scene wedged = scene_of(&y, 1, two, 2);
        ck_assert_int_eq(answer(&wedged, &origin, NULL), CAGE_FREE);
        /* off centre and turned: (2, 0, 0, 1) takes (5, 0) to (3, 4) */
        const cage_ball arm[2] = {{5 * scale, 0, 0, scale}, {-5 * scale, 0, 0, scale}};
        const cage_ball at = {6 * scale, 8 * scale, 0, 4 * scale};
        const cage_pose turned = {{0, 0, 0}, {2, 0, 0, 1}};
        const cage_scene armed = scene_of(arm, 2, &at, 1);
        ck_assert_int_eq(cage_collides(&armed, &turned, CAGE_SIDE_INNER), 0);
        ck_assert_int_eq(answer(&armed, &turned, NULL), CAGE_FREE);
    }
}
END_TEST

/* Four discs with gaps that a point can pass, but the disc inside cannot; it touches one of them. */
START_TEST(caged_in_contact)
{
    for (int32_t more = 0; more <= 1; more++) {
        const cage_ball y = {0, 0, 0, 2000};
        cage_ball x[4] = {{5000, 0, 0, 3000}, {-5000, 0, 0, 2500}, {0, 5000, 0, 2500}, {0, -5000, 0, 2500}};
        x[0].r += more;
        const cage_scene s = scene_of(&y, 1, x, 4);
        ck_assert_int_eq(answer(&s, &origin, NULL), more ? CAGE_IN_COLLISION : CAGE_CAGED);
        const cage_pose out = {{0, 40000, 0}, {1, 0, 0, 0}};
        ck_assert_int_eq(answer(&s, &out, NULL), CAGE_FREE);
    }
}
END_TEST

/* Over half a turn the object's far balls shrink to nothing, and what is left shuts in a point at most thinner than the grid. The
 * same scene, finer, has a way out. */
START_TEST(balls_that_vanish)
{
    unsigned char *memory = test_alloc(PLENTY);
    for (int32_t scale = 1; scale <= 256; scale *= 256) {
        cage_ball y[4] = {{0, 0, 0, 1}, {891, 0, 0, 8}, {-891, 0, 0, 8}, {0, 891, 0, 8}};
        cage_ball x[5] = {{883, 51, 0, 31}, {137, 931, 0, 124}, {952, -48, 0, 78}, {-970, -23, 0, 72}, {-797, -30, 0, 73}};
        const cage_pose start = {{-5 * scale, 9 * scale, 0}, {1, 0, 0, 0}};
        for (int32_t i = 0; i < 9; i++) {
            cage_ball *ball = i < 4 ? &y[i] : &x[i - 4];
            const cage_ball scaled = {ball->x * scale, ball->y * scale, 0, ball->r * scale};
            *ball = scaled;
        }
        const cage_scene s = scene_of(y, 4, x, 5);
        cage_limits limits;
        cage_proof *proof;
        cage_limits_default(&limits, 2);
        limits.start_level = 0;
        ck_assert_int_eq(cage_prove_begin(&proof, &s, &start, NULL, &limits, memory, PLENTY), CAGE_OK);
        ck_assert_int_eq(cage_prove_run(proof, INT64_MAX), 1);
        int32_t verdict = cage_prove_result(proof)->verdict;
        ck_assert_msg(scale == 1 ? verdict != CAGE_CAGED : verdict == CAGE_FREE, "%s", cage_verdict_text(verdict));
    }
    free(memory);
}
END_TEST

START_TEST(coincident_balls_and_points)
{
    cage_ball y[6], x[24];
    for (int32_t r = 0; r <= 1; r++) {
        for (int32_t i = 0; i < 6; i++) {
            const cage_ball at = {0, 0, 0, 2000 * r};
            y[i] = at;
        }
        for (int32_t i = 0; i < 24; i++) {
            const cage_ball at = {i % 4 < 2 ? (i % 4 * 2 - 1) * 5000 : 0, i % 4 < 2 ? 0 : (i % 4 * 2 - 5) * 5000, 0,
                                  i % 3 == 0 ? 2500 : 0};
            x[i] = at;
        }
        const cage_scene s = scene_of(y, 6, x, 24);
        /* as points they pass the gaps */
        ck_assert_int_eq(answer(&s, &origin, NULL), r ? CAGE_CAGED : CAGE_FREE);
    }
    /* all radii 0: nothing ever collides, not even at the same place */
    for (int32_t i = 0; i < 24; i++)
        x[i].r = 0;
    const cage_ball point = {0, 0, 0, 0};
    x[0] = point;
    const cage_scene points = scene_of(&point, 1, x, 24);
    ck_assert_int_eq(cage_collides(&points, &origin, CAGE_SIDE_INNER), 0);
    ck_assert_int_eq(answer(&points, &origin, NULL), CAGE_FREE);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("degenerate");
    TCase *tests = test_case(suite, "degenerate");
    tcase_add_test(tests, nothing_there);
    tcase_add_test(tests, one_obstacle);
    tcase_add_test(tests, object_larger_than_the_world);
    tcase_add_test(tests, start_in_contact);
    tcase_add_test(tests, caged_in_contact);
    tcase_add_test(tests, balls_that_vanish);
    tcase_add_test(tests, coincident_balls_and_points);
    return test_main(suite);
}
