/* test_pose.c: collision of single poses in exact numbers, and every error of the interface. */
#include "support.h"

#include <stdlib.h>

#include "cage.h"
#include "exact.h"

enum { PLENTY = 32 << 20 };

static const cage_pose origin = {{0, 0, 0}, {1, 0, 0, 0}};

static cage_scene scene_of(int32_t dim, const cage_ball *object, int32_t objects, const cage_ball *obstacle, int32_t obstacles)
{
    const cage_scene s = {{object, object, objects, objects}, {obstacle, obstacle, obstacles, obstacles}, dim};
    return s;
}

/* ---- collision ------------------------------------------------------------------------------------------ */

/* The sign of |x + R(q) y - X|^2 - (r + R)^2 in rational numbers: columns of R(q) are q e q* / |q|^2. */
static int gap_sign(const cage_pose *pose, const cage_ball *y, const cage_ball *x)
{
    mpz_t w, i, j, k, n, t, square, part[9];
    mpz_inits(w, i, j, k, n, t, square, NULL);
    exact_set(w, pose->q[0]);
    exact_set(i, pose->q[1]);
    exact_set(j, pose->q[2]);
    exact_set(k, pose->q[3]);
    mpz_t *const of[4] = {&w, &i, &j, &k};
    for (int a = 0; a < 4; a++)
        mpz_addmul(n, *of[a], *of[a]);
    for (int a = 0; a < 3; a++) /* R = (w^2 - v.v) 1 + 2 v v^T + 2 w [v]x, times n */
        for (int b = 0; b < 3; b++) {
            mpz_init(part[3 * a + b]);
            mpz_mul(t, *of[a + 1], *of[b + 1]);
            mpz_addmul_ui(part[3 * a + b], t, 2);
            int c = 3 - a - b;
            if (a == b) {
                mpz_mul(t, w, w);
                mpz_mul_2exp(t, t, 1);
                mpz_sub(t, t, n);
                mpz_add(part[3 * a + b], part[3 * a + b], t);
            } else {
                mpz_mul(t, w, *of[c + 1]);
                mpz_mul_si(t, t, (b - a + 3) % 3 == 1 ? -2 : 2);
                mpz_add(part[3 * a + b], part[3 * a + b], t);
            }
        }
    const int32_t from[3] = {y->x, y->y, y->z}, to[3] = {x->x, x->y, x->z};
    for (int a = 0; a < 3; a++) {
        mpz_set_si(t, (long)pose->x[a] - to[a]);
        mpz_mul(t, t, n);
        for (int b = 0; b < 3; b++) {
            mpz_mul_si(part[3 * a + b], part[3 * a + b], from[b]);
            mpz_add(t, t, part[3 * a + b]);
        }
        mpz_addmul(square, t, t);
    }
    mpz_mul_si(t, n, (long)y->r + x->r);
    mpz_submul(square, t, t);
    int sign = mpz_sgn(square);
    mpz_clears(w, i, j, k, n, t, square, NULL);
    for (int a = 0; a < 9; a++)
        mpz_clear(part[a]);
    return sign;
}

static void any_pose(uint64_t *state, int32_t dim, int64_t reach, cage_pose *pose)
{
    int32_t most = dim == 2 ? CAGE_QUATERNION_2D : CAGE_QUATERNION_3D;
    do {
        for (int k = 0; k < 4; k++)
            pose->q[k] = dim == 2 && (k == 1 || k == 2) ? 0 : (int32_t)test_spread(state, most);
    } while (!pose->q[0] && !pose->q[1] && !pose->q[2] && !pose->q[3]);
    for (int k = 0; k < 3; k++)
        pose->x[k] = k < dim ? (int32_t)test_between(state, -reach, reach) : 0;
}

static cage_ball any_ball(uint64_t *state, int32_t dim, int64_t reach, int64_t r)
{
    cage_ball b = {(int32_t)test_between(state, -reach, reach), (int32_t)test_between(state, -reach, reach),
                   (int32_t)test_between(state, -reach, reach), (int32_t)test_between(state, 0, r)};
    b.z = dim == 3 ? b.z : 0;
    return b;
}

/* Up to the largest numbers; obstacles are put next to where the object's ball comes to lie. */
START_TEST(collisions_are_exact)
{
    int32_t rounds = test_rounds(20000), hits = 0;
    uint64_t state = 31;
    for (int32_t round = 0; round < rounds; round++) {
        int32_t dim = 2 + round % 2;
        int64_t reach = (dim == 2 ? CAGE_REACH_2D : CAGE_REACH_3D) >> test_between(&state, 0, 16);
        cage_ball y[2], x[2];
        cage_pose pose;
        any_pose(&state, dim, reach / 4, &pose);
        for (int k = 0; k < 2; k++) {
            y[k] = any_ball(&state, dim, reach / 20, reach / 20);
            x[k] = any_ball(&state, dim, reach / 4, reach / 4);
        }
        cage_scene s = scene_of(dim, y, 2, x, 2);
        int wanted = 0;
        for (int k = 0; k < 4; k++)
            wanted |= gap_sign(&pose, &y[k / 2], &x[k % 2]) < 0;
        test_require(cage_collides(&s, &pose, CAGE_SIDE_OUTER) == wanted);
        test_require(cage_collides(&s, &pose, CAGE_SIDE_INNER) == wanted);
        s.object.inner_count = 0;
        test_require(cage_collides(&s, &pose, CAGE_SIDE_INNER) == 0);
        hits += wanted;
    }
    ck_assert(hits > rounds / 10 && hits < rounds - rounds / 10);
}
END_TEST

/* q = (2, 0, 0, 1) turns (5, 0) to (3, 4). Contact is no collision; one unit more is. */
START_TEST(touching_is_no_collision)
{
    for (int32_t scale = 1; scale <= 1000000; scale *= 10)
        for (int32_t more = 0; more <= 1; more++) {
            const cage_ball y = {5 * scale, 0, 0, 2 * scale}, x = {6 * scale, 8 * scale, 0, 3 * scale + more};
            const cage_pose turned = {{0, 0, 0}, {2, 0, 0, 1}}, opposite = {{0, 0, 0}, {-2 * 4096, 0, 0, -4096}};
            const cage_scene s = scene_of(2, &y, 1, &x, 1);
            ck_assert_int_eq(cage_collides(&s, &turned, CAGE_SIDE_INNER), more);
            ck_assert_int_eq(cage_collides(&s, &opposite, CAGE_SIDE_OUTER), more);
            if (scale > 100000) /* 3 |y| + r + |X| + R is within the reach in space up to here */
                continue;
            /* (1, 1, 1, 1) turns x to y to z; 2, 3, 6 are the legs of 7. */
            const cage_ball a = {scale, 2 * scale, 3 * scale, 3 * scale};
            const cage_ball b = {3 * scale + 2 * scale, scale + 3 * scale, 2 * scale + 6 * scale, 4 * scale + more};
            const cage_pose cycled = {{0, 0, 0}, {1, 1, 1, 1}};
            const cage_scene space = scene_of(3, &a, 1, &b, 1);
            ck_assert_int_eq(cage_collides(&space, &cycled, CAGE_SIDE_INNER), more);
        }
    const cage_ball point = {7, 7, 0, 0};
    const cage_scene points = scene_of(2, &point, 1, &point, 1);
    ck_assert_int_eq(cage_collides(&points, &origin, CAGE_SIDE_INNER), 0);
}
END_TEST

/* ---- errors --------------------------------------------------------------------------------------------- */

static const cage_ball unit = {0, 0, 0, 1}, away = {100, 0, 0, 1};

/* Begin with these; the error. Whatever it is, *proof is only written by success. */
static int32_t begin(const cage_scene *s, const cage_pose *start, const cage_pose *goal, const cage_limits *limits)
{
    static unsigned char mark;
    cage_proof *proof = (cage_proof *)(void *)&mark;
    void *memory = test_alloc(PLENTY);
    int32_t error = cage_prove_begin(&proof, s, start, goal, limits, memory, PLENTY);
    ck_assert((error == CAGE_OK) == (proof != (cage_proof *)(void *)&mark));
    free(memory);
    return error;
}

/* The same scene error from everything that takes a scene. */
static void expect_scene(const cage_scene *s, int32_t error)
{
    ck_assert_int_eq(cage_scene_check(s), error);
    ck_assert_int_eq(cage_collides(s, &origin, CAGE_SIDE_INNER), error);
    ck_assert_int_eq(begin(s, &origin, NULL, NULL), error);
    ck_assert_uint_eq(s ? cage_prove_size(s, NULL) : 0, 0);
}

START_TEST(scene_errors)
{
    const cage_scene good = scene_of(2, &unit, 1, &away, 1);
    ck_assert_int_eq(cage_scene_check(&good), CAGE_OK);
    ck_assert_int_eq(begin(&good, &origin, NULL, NULL), CAGE_OK);
    ck_assert_uint_gt(cage_prove_size(&good, NULL), 0);
    expect_scene(NULL, CAGE_ERROR_ARGUMENT);
    for (int field = 0; field < 8; field++) {
        cage_scene s = good;
        cage_shape *shape = field % 2 ? &s.object : &s.obstacles;
        if (field < 2)
            shape->inner = NULL;
        else if (field < 4)
            shape->outer = NULL;
        else if (field < 6)
            shape->inner_count = -1;
        else
            shape->outer_count = INT32_MIN;
        expect_scene(&s, CAGE_ERROR_ARGUMENT);
    }
    static const int32_t dims[6] = {0, 1, 4, -2, INT32_MAX, INT32_MIN};
    for (int k = 0; k < 6; k++) {
        cage_scene s = good;
        s.dim = dims[k];
        expect_scene(&s, CAGE_ERROR_DIMENSION);
    }
    const int32_t most = CAGE_REACH_2D;
    const cage_ball bad[9] = {{0, 0, 1, 1},         {0, 0, 0, -1},        {0, 0, 0, INT32_MIN},
                              {most + 1, 0, 0, 0},  {0, INT32_MIN, 0, 0}, {0, 0, 0, most + 1},
                              {INT32_MAX, 0, 0, 0}, {0, 0, 0, most},      {most, most, 0, 0}};
    static const int32_t error[9] = {CAGE_ERROR_DIMENSION, CAGE_ERROR_RADIUS, CAGE_ERROR_RADIUS,
                                     CAGE_ERROR_RANGE,     CAGE_ERROR_RANGE,  CAGE_ERROR_RANGE,
                                     CAGE_ERROR_RANGE,     CAGE_ERROR_RANGE,  CAGE_ERROR_RANGE};
    for (int k = 0; k < 4 * 9; k++) {
        const cage_ball two[2] = {unit, bad[k % 9]};
        cage_scene s = good;
        cage_shape *shape = k / 9 % 2 ? &s.object : &s.obstacles;
        if (k / 18) {
            shape->inner = two;
            shape->inner_count = 2;
        } else {
            shape->outer = two;
            shape->outer_count = 2;
        }
        if (k / 9 % 2 && k % 9 == 8) /* the object has a pivot of its own, half way */
            continue;
        expect_scene(&s, error[k % 9]);
    }
}
END_TEST

/* max |X| + R plus max 3 |y| + r plus 16 may be CAGE_REACH, and not one more. */
START_TEST(the_range_is_as_promised)
{
    for (int32_t dim = 2; dim <= 3; dim++)
        for (int32_t more = 0; more <= 1; more++) {
            int32_t reach = dim == 2 ? CAGE_REACH_2D : CAGE_REACH_3D;
            const cage_ball y[2] = {{1000, 0, 0, 50}, {-1000, 0, 0, 50}}, x = {3000, 4000, 0, reach - 5000 - 3050 - 16 + more};
            const cage_scene s = scene_of(dim, y, 2, &x, 1);
            ck_assert_int_eq(cage_scene_check(&s), more ? CAGE_ERROR_RANGE : CAGE_OK);
        }
    const cage_scene space = scene_of(3, &unit, 1, &away, 1);
    ck_assert_int_eq(cage_scene_check(&space), CAGE_OK);
    ck_assert_int_eq(begin(&space, &origin, NULL, NULL), CAGE_OK);
}
END_TEST

static void expect_pose(const cage_scene *s, const cage_pose *pose, int32_t error)
{
    ck_assert_int_eq(cage_collides(s, pose, CAGE_SIDE_OUTER), error);
    ck_assert_int_eq(begin(s, pose, NULL, NULL), error);
    ck_assert_int_eq(begin(s, &origin, pose, NULL), pose ? error : CAGE_OK);
}

START_TEST(pose_errors)
{
    const cage_scene s[2] = {scene_of(2, &unit, 1, &away, 1), scene_of(3, &unit, 1, &away, 1)};
    for (int32_t dim = 2; dim <= 3; dim++) {
        int32_t reach = dim == 2 ? CAGE_REACH_2D : CAGE_REACH_3D, most = dim == 2 ? CAGE_QUATERNION_2D : CAGE_QUATERNION_3D;
        const cage_scene *in = &s[dim - 2];
        expect_pose(in, NULL, CAGE_ERROR_ARGUMENT);
        for (int k = 0; k < 4; k++)
            for (int sign = -1; sign <= 1; sign += 2) {
                cage_pose pose = origin;
                pose.q[k] = sign * (most + 1);
                expect_pose(in, &pose, CAGE_ERROR_ROTATION);
                pose.q[k] = sign < 0 ? INT32_MIN : INT32_MAX;
                expect_pose(in, &pose, CAGE_ERROR_ROTATION);
                pose = origin;
                if (k == 3)
                    continue;
                pose.x[k] = sign * (reach + 1);
                expect_pose(in, &pose, CAGE_ERROR_RANGE);
            }
        const cage_pose nothing = {{0, 0, 0}, {0, 0, 0, 0}};
        expect_pose(in, &nothing, CAGE_ERROR_ROTATION);
        const cage_pose tilted = {{0, 0, 0}, {1, 1, 0, 0}}, lifted = {{0, 0, 1}, {1, 0, 0, 0}};
        ck_assert_int_eq(cage_collides(in, &tilted, CAGE_SIDE_INNER), dim == 2 ? CAGE_ERROR_ROTATION : 0);
        ck_assert_int_eq(cage_collides(in, &lifted, CAGE_SIDE_INNER), dim == 2 ? CAGE_ERROR_DIMENSION : 0);
        const cage_pose edge = {{reach, -reach, 0}, {most, 0, 0, -most}};
        ck_assert_int_eq(cage_collides(in, &edge, CAGE_SIDE_INNER), 0);
        ck_assert_int_eq(cage_collides(in, &origin, 0), CAGE_ERROR_ARGUMENT);
        ck_assert_int_eq(cage_collides(in, &origin, CAGE_SIDE_BOTH), CAGE_ERROR_ARGUMENT);
    }
}
END_TEST

START_TEST(limit_errors)
{
    const cage_scene s = scene_of(2, &unit, 1, &away, 1);
    cage_limits good;
    cage_limits_default(&good, 2);
    ck_assert_int_eq(begin(&s, &origin, NULL, &good), CAGE_OK);
    static const struct {
        int32_t low, high; /* the values allowed */
    } range[4] = {{CAGE_SIDE_INNER, CAGE_SIDE_BOTH}, {-1, 12}, {0, CAGE_LEVEL_MAX_2D}, {2, 1 << 24}};
    ck_assert_int_eq(good.max_level, range[1].high);
    for (int k = 0; k < 4; k++) {
        const int32_t low = range[k].low, high = range[k].high;
        const int32_t value[8] = {low, high, low - 1, high + 1, low - 2, high + 100, INT32_MIN, INT32_MAX};
        for (int at = 0; at < 8; at++) {
            cage_limits some = good;
            int32_t *const of[4] = {&some.side, &some.start_level, &some.max_level, &some.max_cells};
            *of[k] = value[at];
            ck_assert((cage_prove_size(&s, &some) > 0) == (at < 2));
            if (at >= 2)
                ck_assert_int_eq(begin(&s, &origin, NULL, &some), CAGE_ERROR_ARGUMENT);
        }
    }
    for (int32_t most = 0; most <= CAGE_LEVEL_MAX_2D; most++) { /* the cells begin no finer than they may become */
        cage_limits some = good;
        some.max_level = most;
        some.max_cells = 1 << 24;
        some.start_level = most + 1;
        ck_assert_int_eq(begin(&s, &origin, NULL, &some), CAGE_ERROR_ARGUMENT);
        ck_assert_uint_eq(cage_prove_size(&s, &some), 0);
        some.start_level = most;
        ck_assert_uint_gt(cage_prove_size(&s, &some), 0);
    }
    /* all cells down to the start level have to be allowed: 2 (2^(n+1) - 1) in the plane, 4 (8^(n+1) - 1) / 7 in space */
    const cage_scene space = scene_of(3, &unit, 1, &away, 1);
    for (int32_t level = 0, cells[2] = {2, 4}; level < 4; level++) {
        for (int32_t dim = 2; dim <= 3; dim++) {
            cage_limits some = good;
            some.start_level = some.max_level = level;
            for (some.max_cells = cells[dim - 2] - 1; some.max_cells <= cells[dim - 2]; some.max_cells++) {
                bool enough = some.max_cells == cells[dim - 2];
                ck_assert((cage_prove_size(dim == 2 ? &s : &space, &some) > 0) == enough);
                ck_assert_int_eq(begin(dim == 2 ? &s : &space, &origin, NULL, &some), enough ? CAGE_OK : CAGE_ERROR_ARGUMENT);
            }
        }
        cells[0] = 2 * cells[0] + 2;
        cells[1] = 8 * cells[1] + 4;
    }
    unsigned char small[16];
    cage_proof *proof = NULL;
    ck_assert_int_eq(cage_prove_begin(NULL, &s, &origin, NULL, NULL, small, sizeof small), CAGE_ERROR_ARGUMENT);
    ck_assert_int_eq(cage_prove_begin(&proof, &s, &origin, NULL, NULL, NULL, 16), CAGE_ERROR_ARGUMENT);
    ck_assert_int_eq(cage_prove_begin(&proof, &s, &origin, NULL, NULL, NULL, 0), CAGE_ERROR_MEMORY);
    ck_assert_int_eq(cage_prove_begin(&proof, &s, &origin, NULL, NULL, small, sizeof small), CAGE_ERROR_MEMORY);
    ck_assert_ptr_null(proof);
    ck_assert_int_eq(cage_prove_run(NULL, 1), CAGE_ERROR_ARGUMENT);
}
END_TEST

START_TEST(every_word)
{
    for (int32_t k = -20; k <= 20; k++) {
        ck_assert_ptr_nonnull(cage_error_text(k));
        ck_assert_ptr_nonnull(cage_verdict_text(k));
        ck_assert_ptr_nonnull(cage_reason_text(k));
        for (int32_t l = CAGE_UNDEFINED; l < k && k <= CAGE_IN_COLLISION; l++)
            ck_assert_str_ne(cage_verdict_text(k), cage_verdict_text(l));
    }
    ck_assert_str_eq(cage_verdict_text(CAGE_CAGED), "CAGED");
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("pose");
    TCase *tests = test_case(suite, "pose");
    tcase_add_test(tests, collisions_are_exact);
    tcase_add_test(tests, touching_is_no_collision);
    tcase_add_test(tests, scene_errors);
    tcase_add_test(tests, the_range_is_as_promised);
    tcase_add_test(tests, pose_errors);
    tcase_add_test(tests, limit_errors);
    tcase_add_test(tests, every_word);
    return test_main(suite);
}
