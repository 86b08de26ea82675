/* test_oracle.c: the judge of whole answers is itself judged, on scenes whose truth is known by construction. */
#include <check.h>
#include <math.h>
#include <stdlib.h>

#include "oracle.h"
#include "scenes.h"

#define UNIT 100000

static int32_t scenes_wanted(int32_t usual)
{
    const char *text = getenv("CAGE_TEST_SCENES");
    long n = text ? strtol(text, NULL, 10) : usual;
    return n < 1 ? 1 : n > usual ? usual : (int32_t)n;
}

static void put_object(scene *s, double x, double y, double r)
{
    cage_ball b = {(int32_t)(x * UNIT), (int32_t)(y * UNIT), 0, (int32_t)(r * UNIT)};
    s->object[s->object_count++] = b;
}

static void put_obstacle(scene *s, double x, double y, double r)
{
    cage_ball b = {(int32_t)(x * UNIT), (int32_t)(y * UNIT), 0, (int32_t)(r * UNIT)};
    s->obstacles[s->obstacle_count++] = b;
}

static void put_wall(scene *s, double ax, double ay, double bx, double by, double r, int n)
{
    for (int i = 0; i <= n; i++) {
        put_obstacle(s, ax + (bx - ax) * i / n, ay + (by - ay) * i / n, r);
    }
}

static cage_pose pose(double x, double y, int32_t w, int32_t z)
{
    cage_pose p = {{(int32_t)(x * UNIT), (int32_t)(y * UNIT), 0}, {w, 0, 0, z}};
    return p;
}

static int32_t decide(const scene *s, int n)
{
    cage_scene view = scene_view(s);
    return oracle_decide(&view, &s->start, scene_goal(s), n);
}

static void start_at(scene *s, double x, double y)
{
    s->start = pose(x, y, 1, 0);
}

static void goal_at(scene *s, double x, double y, int32_t w, int32_t z)
{
    s->goal = pose(x, y, w, z);
    s->has_goal = 1;
}

/* Ring of 24 balls about the origin; the first and the last are gap apart, surface to surface. */
static void put_ring(scene *s, double radius, double r, double gap)
{
    double mouth = asin((gap / 2 + r) / radius);
    for (int i = 0; i < 24; i++) {
        double t = mouth + i * (2 * acos(-1) - 2 * mouth) / 23;
        put_obstacle(s, radius * cos(t), radius * sin(t), r);
    }
}

START_TEST(disc_in_ring)
{
    static const double gaps[] = {0.0, 0.5, 1.8, 2.4, 3.0};
    for (int k = 0; k < 5; k++) {
        scene s = {.object_count = 0};
        put_object(&s, 0, 0, 1);
        put_ring(&s, 10, 1.5, gaps[k]);
        start_at(&s, 2, 1);
        ck_assert_int_eq(decide(&s, 192), gaps[k] < 2 ? CAGE_CAGED : CAGE_FREE);
    }
}
END_TEST

/* The rod is 2 wide and 8 long: it leaves end first, so only the width counts. */
START_TEST(rod_in_ring)
{
    static const double gaps[] = {1.8, 2.3};
    for (int k = 0; k < 2; k++) {
        scene s = {.object_count = 0};
        for (int i = -3; i <= 3; i++) {
            put_object(&s, i, 0, 1);
        }
        put_ring(&s, 10, 1.5, gaps[k]);
        start_at(&s, 0, 2);
        ck_assert_int_eq(decide(&s, 192), gaps[k] < 2 ? CAGE_CAGED : CAGE_FREE);
    }
}
END_TEST

/* Two balls pinch the waist of a dumbbell, 2 thick with ends 4 thick; translations alone tell nothing. */
START_TEST(dumbbell_pinched)
{
    static const double gaps[] = {2.5, 3.6, 4.4};
    for (int k = 0; k < 3; k++) {
        scene s = {.object_count = 0};
        put_object(&s, -6, 0, 2);
        put_object(&s, 6, 0, 2);
        for (int i = -4; i <= 4; i += 2) {
            put_object(&s, i, 0, 1.2);
        }
        put_obstacle(&s, 0, gaps[k] / 2 + 2, 2);
        put_obstacle(&s, 0, -gaps[k] / 2 - 2, 2);
        start_at(&s, 0, 0);
        ck_assert_int_eq(decide(&s, 192), gaps[k] < 4 ? CAGE_CAGED : CAGE_FREE);
    }
}
END_TEST

/* A ring with a mouth around a post can leave if and only if the post fits through the mouth. */
START_TEST(clasp_on_post)
{
    static const double posts[] = {1.7, 2.4};
    for (int k = 0; k < 2; k++) {
        scene s = {.object_count = 0};
        double mouth = asin(3.0 / 5);
        for (int i = 0; i < 8; i++) {
            double t = mouth + i * (2 * acos(-1) - 2 * mouth) / 7;
            put_object(&s, 5 * cos(t), 5 * sin(t), 1); /* the mouth is 4 wide */
        }
        put_obstacle(&s, 0, 0, posts[k]);
        start_at(&s, 0, 0);
        ck_assert_int_eq(decide(&s, 192), posts[k] > 2 ? CAGE_CAGED : CAGE_FREE);
    }
}
END_TEST

static void put_room(scene *s, double w, double h)
{
    put_wall(s, -w - 1, -h - 1, w + 1, -h - 1, 1, 12);
    put_wall(s, -w - 1, h + 1, w + 1, h + 1, 1, 12);
    put_wall(s, -w - 1, -h - 1, -w - 1, h + 1, 1, 12);
    put_wall(s, w + 1, -h - 1, w + 1, h + 1, 1, 12);
}

/* A rod 8 long in a square room: with a side of 7.4 it cannot even be put in straight, so it lies along the
 * diagonal and cannot reach the other diagonal; with 9 it can turn. */
START_TEST(rod_turns_in_a_room)
{
    for (int k = 0; k < 2; k++) {
        scene s = {.object_count = 0};
        for (int i = -3; i <= 3; i++) {
            put_object(&s, i, 0, 1);
        }
        put_room(&s, k ? 4.5 : 3.7, k ? 4.5 : 3.7);
        s.start = pose(0, 0, 12, 5); /* 45.24 degrees */
        goal_at(&s, 0, 0, 12, -5);
        ck_assert_int_eq(decide(&s, 192), k ? CAGE_CONNECTED : CAGE_DISCONNECTED);
    }
}
END_TEST

/* An L with arms 2 wide, its centres at (3, 0), (0, 0) and (0, 2). Through 1.8 no arm fits. Through 2.3 each arm
 * does, but not the corner: with (0, 0) between the jambs at (0, +-2.15) the long arm must stay within 48.2 degrees of
 * the way ahead and the short one within 32.5 of the way back, and 180 - 48.2 - 32.5 > 90. Through 7 it all fits. */
START_TEST(door_between_rooms)
{
    static const double doors[] = {1.8, 2.3, 7.0};
    for (int k = 0; k < 3; k++) {
        scene s = {.object_count = 0};
        put_object(&s, 0, 0, 1);
        put_object(&s, 3, 0, 1);
        put_object(&s, 0, 2, 1);
        put_room(&s, 12, 7);
        put_wall(&s, 0, -8, 0, -doors[k] / 2 - 1, 1, 5);
        put_wall(&s, 0, doors[k] / 2 + 1, 0, 8, 1, 5);
        start_at(&s, -7, 0);
        goal_at(&s, 7, 0, 1, 1);
        ck_assert_int_eq(decide(&s, 192), k < 2 ? CAGE_DISCONNECTED : CAGE_CONNECTED);
    }
}
END_TEST

START_TEST(nothing_there)
{
    scene s = {.object_count = 0};
    start_at(&s, 3, 4);
    ck_assert_int_eq(decide(&s, 48), CAGE_FREE);
    put_object(&s, 0, 0, 1);
    ck_assert_int_eq(decide(&s, 48), CAGE_FREE);
    put_obstacle(&s, 3, 4, 1);
    ck_assert_int_eq(decide(&s, 48), CAGE_IN_COLLISION);
    start_at(&s, 9, 4);
    ck_assert_int_eq(decide(&s, 48), CAGE_FREE);
}
END_TEST

/* Thin balls on long arms and fat ones on short arms are where the bounds on turning are nearly reached. */
static void fatten(scene *s, int32_t kind)
{
    for (int32_t i = 0; i < s->object_count && kind == 1; i++) {
        s->object[i].r /= 30;
    }
    for (int32_t j = 0; j < s->obstacle_count && kind > 0; j++) {
        s->obstacles[j].r = kind == 1 ? s->obstacles[j].r / 30 : s->obstacles[j].r * 8;
    }
    s->obstacle_count = kind == 2 && s->obstacle_count > 2 ? 2 : s->obstacle_count;
}

/* Every closed voxel collides and every certified step is free, at poses drawn at random and on the rims. */
START_TEST(voxels_mean_what_they_say)
{
    int32_t n = scenes_wanted(450);
    for (int32_t seed = 0; seed < n; seed++) {
        scene s;
        scene_random((uint64_t)seed + 50000, &s);
        fatten(&s, seed % 3);
        cage_scene view = scene_view(&s);
        ck_assert_int_eq(oracle_audit(&view, &s.start, 12 + seed % 90, 1000, (uint64_t)seed), 0);
    }
}
END_TEST

/* The bound on arcs is felt only near single poses: all voxels of scenes with one fat ball on a short arm. */
START_TEST(arcs_stay_near_their_chords)
{
    for (int k = 0; k < 20; k++) {
        scene s = {.object_count = 0};
        put_object(&s, -10, 0, 1);
        put_object(&s, 10, 0, 60);
        put_obstacle(&s, 0, 0, 1);
        start_at(&s, k * 1.2, 90);
        cage_scene view = scene_view(&s);
        ck_assert_int_eq(oracle_audit(&view, &s.start, 19 + k, 0, 0), 0);
    }
}
END_TEST

/* Both proofs at many resolutions never meet; most scenes are decided, and neither way too often. */
START_TEST(no_contradiction_and_balance)
{
    int32_t n = scenes_wanted(250), cages = 0, paths = 0, colliding = 0;
    for (int32_t seed = 0; seed < n; seed++) {
        scene s;
        scene_random((uint64_t)seed + 90000, &s);
        cage_scene view = scene_view(&s);
        if (decide(&s, 0) == CAGE_IN_COLLISION) {
            colliding++;
            continue;
        }
        int cage = 0, path = 0;
        for (int m = 14; m < 120; m *= 2) {
            cage |= oracle_caged(&view, &s.start, scene_goal(&s), m);
            path |= oracle_path(&view, &s.start, scene_goal(&s), m);
        }
        ck_assert_msg(!(cage && path), "seed %d", (int)seed);
        cages += cage;
        paths += path;
    }
    printf("oracle alone: %d scenes, %d separated, %d joined, %d in collision\n", (int)n, (int)cages, (int)paths,
           (int)colliding);
    if (n >= 200) {
        ck_assert_int_ge(10 * (cages + paths), 7 * (n - colliding));
        ck_assert_int_ge(10 * cages, 3 * (cages + paths));
        ck_assert_int_ge(10 * paths, 3 * (cages + paths));
        ck_assert_int_le(10 * colliding, n);
    }
}
END_TEST

/* A blind walker keeps going the same way until it hits something; 1: it left. */
static int walk_leaves(const cage_scene *view, const scene *s, uint64_t *rng, int steps)
{
    static const int32_t origin[3] = {0, 0, 0};
    long double p[2] = {s->start.x[0], s->start.x[1]}, t = 2 * atan2l(s->start.q[3], s->start.q[0]);
    long double out = 0, most = 1, go[3] = {0, 0, 0};
    for (int32_t j = 0; j < s->obstacle_count; j++) {
        out = fmaxl(out, hypotl(s->obstacles[j].x - p[0], s->obstacles[j].y - p[1]) + s->obstacles[j].r);
    }
    for (int32_t i = 0; i < s->object_count; i++) {
        most = fmaxl(most, hypotl(s->object[i].x, s->object[i].y) + s->object[i].r);
    }
    for (int k = 0; k < steps; k++) {
        long double q[2] = {p[0] + go[0], p[1] + go[1]}, u = t + go[2];
        if (oracle_depth_at(view, origin, q, cosl(u), sinl(u), CAGE_SIDE_OUTER) < 0 && scene_between(rng, 0, 30) > 0) {
            p[0] = q[0];
            p[1] = q[1];
            t = u;
        } else {
            for (int a = 0; a < 3; a++) {
                go[a] = (a < 2 ? out : out / most) / 80 * scene_between(rng, -100, 100) / 100;
            }
        }
        if (hypotl(p[0] - s->start.x[0], p[1] - s->start.x[1]) > out + 2 * most) {
            return 1;
        }
    }
    return 0;
}

START_TEST(cages_hold_walkers)
{
    int32_t n = scenes_wanted(150);
    uint64_t rng = 7;
    int held = 0, left = 0;
    for (int32_t seed = 0; seed < n; seed++) {
        scene s;
        scene_random((uint64_t)seed + 70000, &s);
        s.has_goal = 0;
        cage_scene view = scene_view(&s);
        int32_t verdict = decide(&s, 96);
        if (verdict == CAGE_CAGED || verdict == CAGE_FREE) {
            int out = walk_leaves(&view, &s, &rng, 3000);
            ck_assert_msg(!(out && verdict == CAGE_CAGED), "seed %d", (int)seed);
            held += verdict == CAGE_CAGED;
            left += out;
        }
    }
    printf("walks: %d cages held, %d walkers left free scenes\n", held, left);
}
END_TEST

START_TEST(path_depth_agrees_with_sampling)
{
    uint64_t rng = 11;
    for (int k = 0; k < 100; k++) {
        scene s;
        scene_random((uint64_t)k, &s);
        cage_scene view = scene_view(&s);
        int32_t pivot[3] = {s.object[0].x, s.object[0].y, 0};
        cage_pose path[2];
        path[0] = s.start;
        path[0].x[0] = scene_between(&rng, -40000000, 40000000);
        path[0].x[1] = scene_between(&rng, -40000000, 40000000);
        path[1] = path[0];
        if (k % 2) {
            path[1].x[0] = scene_between(&rng, -40000000, 40000000);
            path[1].x[1] = scene_between(&rng, -40000000, 40000000);
        } else {
            path[1].q[0] = scene_between(&rng, -50, 50);
            path[1].q[3] = scene_between(&rng, 1, 50);
        }
        const char *wrong;
        long double sampled = -1e30L, from = 2 * atan2l(path[0].q[3], path[0].q[0]);
        long double by = remainderl(2 * atan2l(path[1].q[3], path[1].q[0]) - from, 2 * acosl(-1));
        for (int i = 0; i <= 500; i++) {
            long double u = i / 500.0L, t = from + u * by;
            long double p[2] = {path[0].x[0] + u * (path[1].x[0] - path[0].x[0]),
                                path[0].x[1] + u * (path[1].x[1] - path[0].x[1])};
            sampled = fmaxl(sampled, oracle_depth_at(&view, pivot, p, cosl(t), sinl(t), CAGE_SIDE_OUTER));
        }
        cage_pose ends[2] = {path[0], path[1]};
        for (int e = 0; e < 2; e++) { /* the ends in the user's frame, to the nearest unit */
            long double w = ends[e].q[0], z = ends[e].q[3], m = w * w + z * z;
            ends[e].x[0] -= (int32_t)lroundl(((w * w - z * z) * pivot[0] - 2 * w * z * pivot[1]) / m);
            ends[e].x[1] -= (int32_t)lroundl((2 * w * z * pivot[0] + (w * w - z * z) * pivot[1]) / m);
        }
        long double depth = oracle_check_path(&view, &ends[0], &ends[1], pivot, path, 2, &wrong);
        ck_assert_msg(wrong == NULL, "%s", wrong);
        ck_assert(depth > sampled - 2 && depth < sampled + 240000); /* samples are up to 240 000 units apart */
    }
}
END_TEST

static const char *complaint(const cage_scene *view, const cage_pose *start, const cage_pose *goal,
                             const cage_pose *path, int32_t count)
{
    static const int32_t pivot[3] = {0, 0, 0};
    const char *wrong;
    oracle_check_path(view, start, goal, pivot, path, count, &wrong);
    return wrong;
}

START_TEST(broken_paths_are_seen)
{
    scene s = {.object_count = 0};
    put_object(&s, 1, 0, 1);
    put_obstacle(&s, 0, 0, 1);
    start_at(&s, 5, 0);
    cage_scene view = scene_view(&s);
    cage_pose path[3] = {s.start, pose(5, 0, 2, 1), pose(9, 9, 2, 1)}, good = path[2], bad[3];
    const char *wrong;
    static const int32_t pivot[3] = {0, 0, 0};
    ck_assert_ptr_null(complaint(&view, &s.start, NULL, path, 3));
    ck_assert_ptr_null(complaint(&view, &s.start, &good, path, 3));
    ck_assert(oracle_check_path(&view, &s.start, NULL, pivot, path, 3, &wrong) < 0);
    ck_assert_ptr_nonnull(complaint(&view, &s.start, &s.start, path, 3));
    ck_assert_ptr_nonnull(complaint(&view, &good, NULL, path, 3));
    ck_assert_ptr_nonnull(complaint(&view, &s.start, NULL, path, 0));
    bad[0] = path[0];
    bad[1] = path[2]; /* moves and turns at once */
    ck_assert_ptr_nonnull(complaint(&view, &s.start, NULL, bad, 2));
    bad[1] = pose(5, 0, 0, 1); /* half a circle */
    ck_assert_ptr_nonnull(complaint(&view, &s.start, NULL, bad, 2));
    bad[1] = pose(0, 0, 1, 0); /* not out */
    ck_assert_ptr_nonnull(complaint(&view, &s.start, NULL, bad, 2));
    bad[1] = pose(-9, 0, 1, 0); /* right through the obstacle */
    ck_assert(oracle_check_path(&view, &s.start, NULL, pivot, bad, 2, &wrong) > UNIT);
    ck_assert_ptr_null(wrong);
}
END_TEST

/* A quarter turn of the world changes no bit of the question, and four of them nothing at all. */
START_TEST(generators_keep_their_word)
{
    for (uint64_t seed = 0; seed < 3000; seed++) {
        scene s, t, again;
        scene_random(seed, &s);
        scene_random(seed, &again);
        cage_scene view = scene_view(&s);
        double out = 0, arm = 0;
        for (int32_t j = 0; j < s.obstacle_count; j++) {
            out = fmax(out, hypot(s.obstacles[j].x, s.obstacles[j].y) + s.obstacles[j].r);
        }
        for (int32_t i = 0; i < s.object_count; i++) {
            arm = fmax(arm, 3.3 * hypot(s.object[i].x, s.object[i].y) + s.object[i].r);
        }
        ck_assert(out + arm + 8 < CAGE_REACH_2D);
        ck_assert_mem_eq(&s, &again, sizeof s);
        scene_quarter_turn(&s, 1, &t);
        cage_scene turned = scene_view(&t);
        long double here = oracle_depth(&view, &s.start, CAGE_SIDE_OUTER);
        ck_assert(fabsl(here - oracle_depth(&turned, &t.start, CAGE_SIDE_OUTER)) < 1e-3L);
        scene_quarter_turn(&t, 3, &again);
        ck_assert_mem_eq(again.obstacles, s.obstacles, sizeof s.obstacles);
        ck_assert_mem_eq(again.start.x, s.start.x, sizeof s.start.x);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("oracle");
    TCase *tests = tcase_create("oracle");
    tcase_set_timeout(tests, 0);
    tcase_add_test(tests, disc_in_ring);
    tcase_add_test(tests, rod_in_ring);
    tcase_add_test(tests, dumbbell_pinched);
    tcase_add_test(tests, clasp_on_post);
    tcase_add_test(tests, rod_turns_in_a_room);
    tcase_add_test(tests, door_between_rooms);
    tcase_add_test(tests, nothing_there);
    tcase_add_test(tests, voxels_mean_what_they_say);
    tcase_add_test(tests, arcs_stay_near_their_chords);
    tcase_add_test(tests, no_contradiction_and_balance);
    tcase_add_test(tests, cages_hold_walkers);
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
