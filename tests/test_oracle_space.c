/* test_oracle_space.c: the judge of answers in space is itself judged, on scenes whose truth is known by construction. */
#include <check.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "oracle_space.h"
#include "scenes.h"
#include "scenes_space.h"
#include "oracle_space_flood.h"

#define UNIT 10000

static int32_t scenes_wanted(int32_t usual)
{
    const char *text = getenv("CAGE_TEST_SCENES");
    long n = text ? strtol(text, NULL, 10) : usual;
    return n < 1 ? 1 : n > usual ? usual : (int32_t)n;
}

static cage_ball ball(double x, double y, double z, double r)
{
    cage_ball b = {(int32_t)lround(x * UNIT), (int32_t)lround(y * UNIT), (int32_t)lround(z * UNIT), (int32_t)lround(r * UNIT)};
    return b;
}

static void put_object(space_scene *s, double x, double y, double z, double r)
{
    s->object[s->object_count++] = ball(x, y, z, r);
}

static void put_obstacle(space_scene *s, double x, double y, double z, double r)
{
    s->obstacles[s->obstacle_count++] = ball(x, y, z, r);
}

static cage_pose pose(double x, double y, double z, int32_t qw, int32_t qx, int32_t qy, int32_t qz)
{
    cage_pose p = {{(int32_t)lround(x * UNIT), (int32_t)lround(y * UNIT), (int32_t)lround(z * UNIT)}, {qw, qx, qy, qz}};
    return p;
}

/* n balls around the z axis. */
static void put_ring(space_scene *s, int n, double radius, double z, double r)
{
    for (int i = 0; i < n; i++) {
        double t = 2 * acos(-1) * i / n;
        put_obstacle(s, radius * cos(t), radius * sin(t), z, r);
    }
}

static space_question question_of(const space_scene *s, cage_scene *view)
{
    *view = space_view(s);
    space_question q = {view, &s->start, space_goal(s), s->object_ring, s->obstacle_ring};
    return q;
}

static int32_t decide(const space_scene *s, const char **how)
{
    static const space_effort effort = {50000000, 160, 4000};
    cage_scene view;
    space_question q = question_of(s, &view);
    space_audit audit = {7, 0, 0, 50};
    int32_t truth = oracle_space_decide(&q, &effort, &audit, how);
    ck_assert_int_eq(audit.wrong, 0);
    return truth;
}

static void is_truth(const space_scene *s, int32_t truth)
{
    const char *how;
    int32_t said = decide(s, &how);
    ck_assert_msg(said == truth, "%s by %s, not %s", cage_verdict_text(said), how, cage_verdict_text(truth));
}

/* Eight balls of radius 11 at the corners of a cube of edge 20: only its faces are open, as wide as a ball of radius 3.14. */
static void put_cube(space_scene *s)
{
    for (int k = 0; k < 8; k++) {
        put_obstacle(s, k & 1 ? 10 : -10, k & 2 ? 10 : -10, k & 4 ? 10 : -10, 11);
    }
}

START_TEST(ball_in_a_cube)
{
    static const double radii[] = {2.9, 3.6};
    for (int k = 0; k < 4; k++) {
        space_scene s = {.object_count = 0};
        put_object(&s, 1, 2, 3, radii[k / 2]);
        put_cube(&s);
        s.start = pose(-1, -2, -3, 1, 0, 0, 0);
        s.goal = pose(30, 40, 50, 3, 1, 2, 0);
        s.has_goal = k % 2;
        is_truth(&s, k / 2 ? (k % 2 ? CAGE_DISCONNECTED : CAGE_CAGED) : k % 2 ? CAGE_CONNECTED : CAGE_FREE);
    }
}
END_TEST

/* A rod leaves end first, if its balls do. */
START_TEST(rod_in_a_cube)
{
    static const double radii[] = {2.9, 3.6};
    for (int k = 0; k < 2; k++) {
        space_scene s = {.object_count = 0};
        for (int i = -1; i <= 1; i++) {
            put_object(&s, i, 0, 0.5 * i, radii[k]);
        }
        put_cube(&s);
        s.start = pose(0, 0, 0, 1, 0, 0, 0);
        is_truth(&s, k ? CAGE_CAGED : CAGE_FREE);
    }
}
END_TEST

/* A dumbbell through a ring whose hole has a radius of 7: it is the ends that count, and each of them alone could go. */
START_TEST(dumbbell_in_a_ring)
{
    static const double ends[] = {6.3, 8};
    for (int k = 0; k < 2; k++) {
        space_scene s = {.object_count = 0};
        put_object(&s, 0, 0, -9, ends[k]);
        put_object(&s, 0, 0, 9, ends[k]);
        for (int i = -1; i <= 1; i++) {
            put_object(&s, 0, 0, 4 * i, 3.5);
        }
        put_ring(&s, 16, 10, 0, 3);
        s.start = pose(0, 0, 0, 1, 0, 0, 0);
        is_truth(&s, k ? CAGE_CAGED : CAGE_FREE);
    }
}
END_TEST

/* The same with the bodies exchanged: a ring around a dumbbell that does not move. */
START_TEST(ring_on_a_dumbbell)
{
    static const double ends[] = {6.3, 8};
    for (int k = 0; k < 2; k++) {
        space_scene s = {.object_count = 0};
        put_ring(&s, 10, 10, 0, 3.2);
        memcpy(s.object, s.obstacles, sizeof s.object);
        s.object_count = 10;
        s.obstacle_count = 0;
        put_obstacle(&s, 0, 0, -9, ends[k] - 0.2);
        put_obstacle(&s, 0, 0, 9, ends[k] - 0.2);
        for (int i = -1; i <= 1; i++) {
            put_obstacle(&s, 0, 0, 4 * i, 3.5);
        }
        s.start = pose(0, 0, 0, 1, 0, 0, 0);
        is_truth(&s, k ? CAGE_CAGED : CAGE_FREE);
    }
}
END_TEST

/* A rod in a closed tube with a bore of radius 3 cannot be turned end for end; a short one can. */
START_TEST(rod_in_a_tube)
{
    for (int k = 0; k < 2; k++) {
        space_scene s = {.object_count = 0};
        for (int i = -1; i <= 1; i++) {
            put_object(&s, 0, 0, k ? 0.3 * i : 4.0 * i, 2);
        }
        for (int i = -3; i <= 3; i++) {
            put_ring(&s, 10, 6.5, 4 * i, 3.5);
        }
        put_obstacle(&s, 0, 0, 17, 6);
        put_obstacle(&s, 0, 0, -17, 6);
        s.start = pose(0, 0, 0, 1, 0, 0, 0);
        s.goal = pose(0, 0, 0, 1, 0, 200, 0);
        s.has_goal = 1;
        is_truth(&s, k ? CAGE_CONNECTED : CAGE_DISCONNECTED);
    }
}
END_TEST

/* Rings of radius 10, linked (twice over, as seen from the other end) or side by side, or linked but open. */
START_TEST(rings_in_rings)
{
    static const double at[] = {10, 30, 10};
    static const int32_t truths[] = {CAGE_CAGED, CAGE_FREE, CAGE_FREE};
    for (int k = 0; k < 3; k++) {
        space_scene s = {.object_count = 0};
        put_ring(&s, 12, 10, 0, 2.7);
        memcpy(s.object, s.obstacles, sizeof s.object);
        s.object_count = s.object_ring = s.obstacle_ring = 12;
        if (k == 2) { /* five balls away leave a mouth of more than 10 */
            s.obstacle_count = 7;
            s.obstacle_ring = 0;
        }
        s.start = pose(at[k], 0, 0, 1, 1, 0, 0);
        is_truth(&s, truths[k]);
        s.has_goal = 1;
        s.goal = pose(40, 0, 0, 1, 0, 0, 0);
        is_truth(&s, k == 0 ? CAGE_DISCONNECTED : CAGE_CONNECTED);
    }
}
END_TEST

START_TEST(chains_must_overlap)
{
    space_scene s = {.object_count = 0};
    cage_scene view;
    put_ring(&s, 12, 10, 0, 2.7);
    memcpy(s.object, s.obstacles, sizeof s.object);
    s.object_count = s.object_ring = s.obstacle_ring = 12;
    s.start = pose(10, 0, 0, 1, 1, 0, 0);
    space_question q = question_of(&s, &view);
    ck_assert_int_eq(oracle_space_linked(&q), 1);
    s.obstacles[5].r /= 3;
    ck_assert_int_eq(oracle_space_linked(&q), 0);
    s.obstacles[5].r *= 3;
    s.object[0].z += 2 * UNIT;
    s.object[1].z -= 2 * UNIT;
    ck_assert_int_eq(oracle_space_linked(&q), 0);
}
END_TEST

/* A wall across the way of an arm that is 7.5 long. */
static void put_stop(space_scene *s, double x)
{
    put_obstacle(s, x, 0, 0, 3);
    put_obstacle(s, 0.8 * x, 0, 4.5, 2.5);
    put_obstacle(s, 0.8 * x, 0, -4.5, 2.5);
}

/* A ball with an arm, held between two rings. */
static void put_joint(space_scene *s)
{
    put_object(s, 0, 0, 0, 4);
    put_object(s, 5.5, 0, 0, 1);
    put_object(s, 7.5, 0, 0, 1);
    put_ring(s, 8, 3.2, 4.3, 1.2);
    put_ring(s, 8, 3.2, -4.3, 1.2);
}

/* A ring with an arm, held on a post by its ends. */
static void put_hinge(space_scene *s)
{
    for (int i = 0; i < 8; i++) {
        double t = acos(-1) * i / 4;
        put_object(s, 4 * cos(t), 4 * sin(t), 0, 2);
    }
    put_object(s, 7, 0, 0, 1.5);
    put_object(s, 9.5, 0, 0, 1.5);
    put_obstacle(s, 0, 0, 0, 1.9);
    put_obstacle(s, 0, 0, 22.2, 20);
    put_obstacle(s, 0, 0, -22.2, 20);
}

/* The arm is stopped at 0 degrees, and in every other scene at 180 too; from 60 degrees to -60 it turns by more
 * than 180, through rotations that are met twice. */
START_TEST(more_than_half_a_turn)
{
    int kinds = getenv("CAGE_TEST_QUICK") ? 2 : 4; /* a million boxes for those with a ring */
    for (int k = 0; k < kinds; k++) {
        space_scene s = {.object_count = 0};
        cage_scene view;
        space_body body = {0, k / 2 ? SPACE_WHOLE : SPACE_LINE, 0};
        (k / 2 ? put_hinge : put_joint)(&s);
        put_stop(&s, k / 2 ? 9.5 : 7);
        if (k % 2) {
            put_stop(&s, k / 2 ? -9.5 : -7);
        }
        s.start = pose(0, 0, 0, 866, 0, 0, 500);
        s.goal = pose(0, 0, 0, -866, 0, 0, 500);
        s.has_goal = 1;
        space_question q = question_of(&s, &view);
        ck_assert_int_eq(space_separated(&q, &body, k / 2 ? 121 : 81, 2000000000, NULL), k % 2);
    }
}
END_TEST

START_TEST(nothing_there)
{
    space_scene s = {.object_count = 0};
    s.start = pose(3, 4, 5, 1, 0, 0, 0);
    is_truth(&s, CAGE_FREE);
    put_object(&s, 0, 0, 0, 1);
    is_truth(&s, CAGE_FREE);
    put_obstacle(&s, 3, 4, 5, 1);
    is_truth(&s, CAGE_IN_COLLISION);
    s.start = pose(9, 4, 5, 1, 2, 3, 4);
    is_truth(&s, CAGE_FREE);
}
END_TEST

/* Not one scene is both separated and joined; poses of closed boxes collide, poses on certified moves do not. */
START_TEST(no_contradiction)
{
    static const space_effort effort = {3000000, 120, 300};
    space_audit audit = {3, 0, 0, 10};
    int32_t n = scenes_wanted(60), both[2] = {0, 0};
    for (int32_t seed = 0; seed < n; seed++) {
        space_scene s;
        cage_scene view;
        const char *how;
        space_random((uint64_t)seed + 500, &s);
        space_question q = question_of(&s, &view);
        if (oracle_space_depth(&view, &s.start, CAGE_SIDE_INNER) < -1 &&
            (!q.goal || oracle_space_depth(&view, q.goal, CAGE_SIDE_INNER) < -1)) {
            int apart = oracle_space_separated(&q, &effort, &audit, &how),
                together = oracle_space_joined(&q, &effort, &audit, &how);
            ck_assert_msg(!apart || !together, "seed %ld", (long)seed);
            both[0] += apart;
            both[1] += together;
        }
    }
    printf("judge in space: %d scenes, %d separated, %d joined, %ld poses looked at, %ld wrong\n", (int)n, (int)both[0],
           (int)both[1], audit.looked, audit.wrong);
    ck_assert_int_eq(audit.wrong, 0);
    ck_assert(n < 60 || (both[0] >= 5 && both[1] >= 15 && audit.looked > 10000));
}
END_TEST

/* ---- paths ------------------------------------------------------------------------------------------- */

static cage_pose pose_random(uint64_t *rng)
{
    cage_pose p;
    for (int k = 0; k < 3; k++) {
        p.x[k] = scene_between(rng, -1000000, 1000000);
    }
    for (int k = 0; k < 4; k++) {
        p.q[k] = scene_between(rng, 1, 100) * (scene_between(rng, 0, 1) ? 1 : -1);
    }
    return p;
}

/* The depth of a turn is that of its worst pose, sampled by mixing quaternions. */
START_TEST(path_depth_agrees_with_sampling)
{
    static const int32_t pivot[3] = {0, 0, 0};
    uint64_t rng = 5;
    int32_t n = scenes_wanted(60);
    for (int32_t k = 0; k < n; k++) {
        space_scene s;
        const char *wrong;
        space_random((uint64_t)k, &s);
        cage_scene view = space_view(&s);
        cage_pose path[2] = {pose_random(&rng), pose_random(&rng)};
        memcpy(path[1].x, path[0].x, sizeof path[1].x);
        int64_t dot = 0;
        for (int i = 0; i < 4; i++) {
            dot += (int64_t)path[0].q[i] * path[1].q[i];
        }
        if (dot == 0) {
            continue;
        }
        long double depth = oracle_space_check_path(&view, &path[0], &path[1], pivot, path, 2, &wrong), sampled = -1e30L;
        ck_assert_msg(wrong == NULL, "%s", wrong);
        for (int32_t i = 0; i <= 2000; i++) { /* neighbours are at most 1 / 300 apart */
            cage_pose on = path[0];
            for (int j = 0; j < 4; j++) {
                on.q[j] = path[0].q[j] * (2000 - i) + (dot < 0 ? -1 : 1) * path[1].q[j] * i;
            }
            sampled = fmaxl(sampled, oracle_space_depth(&view, &on, CAGE_SIDE_OUTER));
        }
        ck_assert(depth > sampled - 1e-3L && depth < sampled + 5000); /* arms are below 1 000 000 */
    }
}
END_TEST

static const char *complaint(const cage_scene *view, const cage_pose *start, const cage_pose *goal,
                             const cage_pose *path, int32_t count)
{
    static const int32_t pivot[3] = {0, 0, 0};
    const char *wrong;
    oracle_space_check_path(view, start, goal, pivot, path, count, &wrong);
    return wrong;
}

START_TEST(broken_paths_are_seen)
{
    space_scene s = {.object_count = 0};
    put_object(&s, 1, 0, 0, 1);
    put_obstacle(&s, 0, 0, 0, 1);
    s.start = pose(5, 0, 0, 1, 0, 0, 0);
    cage_scene view = space_view(&s);
    cage_pose path[3] = {s.start, pose(5, 0, 0, 2, 1, 1, 0), pose(9, 9, 9, -4, -2, -2, 0)}, good = path[2], bad[3];
    static const int32_t pivot[3] = {0, 0, 0}, other[3] = {UNIT, 0, 0};
    const char *wrong;
    ck_assert_ptr_null(complaint(&view, &s.start, NULL, path, 3));
    ck_assert_ptr_null(complaint(&view, &s.start, &good, path, 3));
    ck_assert(oracle_space_check_path(&view, &s.start, NULL, pivot, path, 3, &wrong) < 0);
    ck_assert_ptr_nonnull(complaint(&view, &s.start, &s.start, path, 3));
    ck_assert_ptr_nonnull(complaint(&view, &good, NULL, path, 3));
    ck_assert_ptr_nonnull(complaint(&view, &s.start, NULL, path, 0));
    oracle_space_check_path(&view, &s.start, NULL, other, path, 3, &wrong);
    ck_assert_ptr_nonnull(wrong);
    bad[0] = path[0];
    bad[1] = path[2]; /* moves and turns at once */
    ck_assert_ptr_nonnull(complaint(&view, &s.start, NULL, bad, 2));
    bad[1] = pose(5, 0, 0, 0, 1, 0, 0); /* half a circle */
    ck_assert_ptr_nonnull(complaint(&view, &s.start, NULL, bad, 2));
    bad[1] = pose(0.5, 1, 1, 1, 0, 0, 0); /* not out */
    ck_assert_ptr_nonnull(complaint(&view, &s.start, NULL, bad, 2));
    bad[1] = pose(5, 0, 0, 0, 0, 0, 0); /* no rotation */
    ck_assert_ptr_nonnull(complaint(&view, &s.start, NULL, bad, 2));
    bad[1] = pose(-9, 0, 0, 1, 0, 0, 0); /* right through the obstacle */
    ck_assert(oracle_space_check_path(&view, &s.start, NULL, pivot, bad, 2, &wrong) > UNIT);
    ck_assert_ptr_null(wrong);
    s.object[0].x = 5 * UNIT; /* swings through it: both ends are clear */
    bad[0] = pose(0, 4, 0, 10, 0, 0, 0);
    bad[0].x[1] = 5 * UNIT;
    bad[1] = bad[0];
    bad[1].q[0] = 1;
    bad[1].q[3] = -5;
    ck_assert(oracle_space_depth(&view, &bad[0], CAGE_SIDE_OUTER) < 0 && oracle_space_depth(&view, &bad[1], CAGE_SIDE_OUTER) < 0);
    ck_assert(oracle_space_check_path(&view, &bad[0], &bad[1], pivot, bad, 2, &wrong) > 1.9L * UNIT);
    ck_assert_ptr_null(wrong);
}
END_TEST

/* ---- scenes ------------------------------------------------------------------------------------------ */

static void is_as_deep(const cage_scene *view, const space_scene *s, const space_scene *moved)
{
    cage_scene other = space_view(moved);
    ck_assert_int_eq(cage_scene_check(&other), CAGE_OK);
    ck_assert(fabsl(oracle_space_depth(view, &s->start, CAGE_SIDE_OUTER) -
                    oracle_space_depth(&other, &moved->start, CAGE_SIDE_OUTER)) < 1e-6L);
    if (s->has_goal) {
        ck_assert(fabsl(oracle_space_depth(view, &s->goal, CAGE_SIDE_OUTER) -
                        oracle_space_depth(&other, &moved->goal, CAGE_SIDE_OUTER)) < 1e-6L);
    }
}

START_TEST(generators_keep_their_word)
{
    int32_t n = scenes_wanted(1000), collide = 0;
    uint64_t rng = 9;
    for (int32_t seed = 0; seed < n; seed++) {
        space_scene s, again;
        space_random((uint64_t)seed, &s);
        space_random((uint64_t)seed, &again);
        cage_scene view = space_view(&s);
        int32_t by[3] = {scene_between(&rng, -200000, 200000), 70001, -150000}, turn = scene_between(&rng, 0, 23);
        ck_assert_int_eq(cage_scene_check(&view), CAGE_OK);
        ck_assert_mem_eq(&s, &again, sizeof s);
        collide += cage_collides(&view, &s.start, CAGE_SIDE_INNER) == 1;
        space_move_world(&s, turn, by, &again);
        is_as_deep(&view, &s, &again);
        space_move_frame(&s, turn, 60000, &again);
        is_as_deep(&view, &s, &again);
        space_shuffle(&s, (uint64_t)seed, &again);
        is_as_deep(&view, &s, &again);
    }
    ck_assert_int_le(collide, 1 + n / 20);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("oracle in space");
    TCase *tests = tcase_create("oracle in space");
    tcase_set_timeout(tests, 0);
    tcase_add_test(tests, ball_in_a_cube);
    tcase_add_test(tests, rod_in_a_cube);
    tcase_add_test(tests, dumbbell_in_a_ring);
    tcase_add_test(tests, ring_on_a_dumbbell);
    tcase_add_test(tests, rod_in_a_tube);
    tcase_add_test(tests, rings_in_rings);
    tcase_add_test(tests, chains_must_overlap);
    tcase_add_test(tests, more_than_half_a_turn);
    tcase_add_test(tests, nothing_there);
    tcase_add_test(tests, no_contradiction);
    tcase_add_test(tests, path_depth_agrees_with_sampling);
    tcase_add_test(tests, broken_paths_are_seen);
    tcase_add_test(tests, generators_keep_their_word);
    suite_add_tcase(suite, tests);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed ? EXIT_FAILURE : EXIT_SUCCESS;
}
