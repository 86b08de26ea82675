/* test_grid.c: everything that rounds, against exact rational numbers, and what the slacks have to cover. */
#include "support.h"

#include <stdio.h>

#include "body.h"
#include "exact.h"
#include "grid.h"

static const int32_t quarters[10][4] = {{1, 0, 0, 0},  {0, 1, 0, 0},  {0, 0, 1, 0},  {0, 0, 0, 1},  {1, 1, 0, 0},
                                        {1, -1, 0, 0}, {1, 0, 1, 0},  {1, 0, -1, 0}, {1, 0, 0, 1},  {1, 0, 0, -1}};

static void any_quaternion(uint64_t *state, int32_t dim, int32_t q[4])
{
    do {
        for (int k = 0; k < 4; k++)
            q[k] = dim == 2 && (k == 1 || k == 2) ? 0 : (int32_t)test_spread(state, 1 << 30);
    } while (!q[0] && !q[1] && !q[2] && !q[3]);
}

/* |y| <= 2^29. */
static void any_vector(uint64_t *state, int32_t dim, int32_t y[3])
{
    for (int k = 0; k < 3; k++)
        y[k] = k < dim ? (int32_t)test_spread(state, 309000000) : 0;
}

/* R(q) y by the sandwich q y q* / |q|^2, in rational numbers. */
static void rotate_exactly(const int32_t q[4], const int32_t y[3], mpq_t out[3])
{
    mpz_t a[4], t, n;
    mpz_inits(a[0], a[1], a[2], a[3], t, n, NULL);
    static const int sign[4][4] = {{1, -1, -1, -1}, {1, 1, 1, -1}, {1, -1, 1, 1}, {1, 1, -1, 1}};
    static const int with[4][4] = {{0, 1, 2, 3}, {1, 0, 3, 2}, {2, 3, 0, 1}, {3, 2, 1, 0}};
    /* a = q (0, y): entry i is the sum over k of sign q_k v_{with} */
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 4; k++) {
            int j = with[i][k];
            exact_set(t, q[k]);
            mpz_mul_si(t, t, j == 0 ? 0 : (long)sign[i][k] * y[j - 1]);
            mpz_add(a[i], a[i], t);
        }
    for (int k = 0; k < 4; k++) {
        exact_set(t, q[k]);
        mpz_addmul(n, t, t);
    }
    for (int i = 1; i < 4; i++) { /* a q*, its vector part */
        mpz_t *sum = &a[i];
        mpz_t total;
        mpz_init(total);
        for (int k = 0; k < 4; k++) {
            int j = with[i][k];
            exact_set(t, j == 0 ? q[0] : -(int64_t)q[j]);
            mpz_mul_si(t, t, sign[i][k]);
            mpz_addmul(total, t, a[k]);
        }
        mpq_set_z(out[i - 1], total);
        mpz_set(mpq_denref(out[i - 1]), n);
        mpq_canonicalize(out[i - 1]);
        mpz_clear(total);
        (void)sum;
    }
    mpz_clears(a[0], a[1], a[2], a[3], t, n, NULL);
}

/* Each coordinate is off by at most 1/2 + 2^-31, so the point by less than 0.71 (0.87). */
START_TEST(rotates_to_nearest)
{
    int32_t rounds = test_rounds(40000);
    uint64_t state = 11;
    mpq_t right[3], far, limit, square, all;
    mpq_inits(right[0], right[1], right[2], far, limit, square, all, NULL);
    for (int32_t round = 0; round < rounds; round++) {
        int32_t dim = 2 + round % 2, q[4], y[3], got[3];
        struct cage_rotation rotation;
        any_quaternion(&state, dim, q);
        any_vector(&state, dim, y);
        cage_rotation_of(q, &rotation);
        cage_rotate(&rotation, y, got);
        rotate_exactly(q, y, right);
        mpq_set_ui(limit, (1u << 30) + 1, 1u << 31);
        mpq_set_ui(all, 0, 1);
        for (int k = 0; k < 3; k++) {
            mpq_set_si(far, got[k], 1);
            mpq_sub(far, far, right[k]);
            mpq_mul(square, far, far);
            mpq_add(all, all, square);
            mpq_abs(far, far);
            test_require(mpq_cmp(far, limit) <= 0);
        }
        test_require(dim == 3 || got[2] == 0);
        mpq_set_ui(limit, dim == 2 ? 5041 : 7569, 10000);
        test_require(mpq_cmp(all, limit) < 0);
    }
    mpq_clears(right[0], right[1], right[2], far, limit, square, all, NULL);
}
END_TEST

START_TEST(quarter_turns_are_exact)
{
    uint64_t state = 12;
    mpq_t right[3];
    mpq_inits(right[0], right[1], right[2], NULL);
    for (int32_t i = 0; i < 10 * 200; i++) {
        int32_t scale = (int32_t)test_between(&state, 1, 1 << 30), q[4], y[3], got[3];
        struct cage_rotation rotation;
        for (int k = 0; k < 4; k++)
            q[k] = quarters[i % 10][k] * (i % 3 ? scale : -scale);
        any_vector(&state, 3, y);
        cage_rotation_of(q, &rotation);
        cage_rotate(&rotation, y, got);
        rotate_exactly(q, y, right);
        for (int k = 0; k < 3; k++)
            test_require(mpq_cmp_si(right[k], got[k], 1) == 0);
    }
    mpq_clears(right[0], right[1], right[2], NULL);
}
END_TEST

/* Within 2.4 by rough rotations, and one coordinate beyond 1; where the pivot is, exactly to nearest, a half upward. */
START_TEST(rough_places)
{
    const int32_t most = 1 << 28;
    int32_t rounds = test_rounds(60000);
    uint64_t state = 17;
    bool beyond = false;
    mpq_t right[3], far, half;
    mpq_inits(right[0], right[1], right[2], far, half, NULL);
    mpq_set_ui(half, 1, 2);
    for (int32_t round = 0; round < rounds; round++) {
        int32_t dim = 2 + round % 2, q[4], y[3], got[3];
        struct cage_rough rough;
        cage_pose pose = {{0, 0, 0}, {0, 0, 0, 0}};
        any_quaternion(&state, dim, q);
        for (int k = 0; k < 4 && round % 8 > 3; k++) /* |q|^2 just above 2^31 loses most: a bit of 32 */
            q[k] = dim == 2 && (k == 1 || k == 2) ? 0 : (int32_t)test_between(&state, 23000, 33000) * (round % 16 > 7 && k ? -1 : 1);
        for (int k = 0; k < 3; k++) {
            y[k] = k >= dim ? 0 : round % 4 ? (int32_t)test_spread(&state, most) : test_between(&state, 0, 1) ? most : -most;
            pose.x[k] = k < dim ? (int32_t)test_spread(&state, most) : 0;
        }
        if (round % 32 == 0) /* a third and two thirds of a half turn, and halves of odd numbers */
            for (int k = 0; k < 4; k++)
                q[k] = k == 0 ? 1 : k == 3 ? round % 64 ? 1 : 3 : dim == 2 ? 0 : 1;
        memcpy(pose.q, q, sizeof q);
        rotate_exactly(q, y, right);
        cage_rough_of(q, &rough);
        cage_rough_rotate(&rough, y, got);
        for (int k = 0; k < 3; k++) {
            mpq_set_si(far, got[k], 1);
            mpq_sub(far, far, right[k]);
            mpq_abs(far, far);
            test_require(mpq_cmp_ui(far, 24, 10) < 0);
            beyond = beyond || mpq_cmp_ui(far, 10, 10) > 0;
        }
        cage_pose_pivot(&pose, y, got);
        for (int k = 0; k < 3; k++) { /* x + R y - got is from -1/2 on, below 1/2 */
            mpq_set_si(far, (long)pose.x[k] - got[k], 1);
            mpq_add(far, far, right[k]);
            test_require(mpq_cmp(far, half) < 0);
            mpq_neg(far, far);
            test_require(mpq_cmp(far, half) <= 0);
        }
    }
    ck_assert(beyond);
    mpq_clears(right[0], right[1], right[2], far, half, NULL);
}
END_TEST

/* 4 sin^2 of the angle between the quaternions: 4 (1 - (a.b)^2 / (|a|^2 |b|^2)). */
static void chord_square(const int32_t a[4], const int32_t b[4], mpq_t out)
{
    mpz_t dot, aa, bb, s, t;
    mpz_inits(dot, aa, bb, s, t, NULL);
    for (int k = 0; k < 4; k++) {
        exact_set(s, a[k]);
        exact_set(t, b[k]);
        mpz_addmul(dot, s, t);
        mpz_addmul(aa, s, s);
        mpz_addmul(bb, t, t);
    }
    mpz_mul(aa, aa, bb);
    mpz_mul(dot, dot, dot);
    mpz_sub(s, aa, dot);
    mpz_mul_ui(s, s, 4);
    mpz_set(mpq_numref(out), s);
    mpz_set(mpq_denref(out), aa);
    mpq_canonicalize(out);
    mpz_clears(dot, aa, bb, s, t, NULL);
}

START_TEST(turns_are_upper_bounds)
{
    int32_t rounds = test_rounds(40000);
    uint64_t state = 13;
    mpq_t right, got;
    mpq_inits(right, got, NULL);
    for (int32_t round = 0; round < rounds; round++) {
        int32_t dim = 2 + round % 2, a[4], b[4];
        any_quaternion(&state, dim, a);
        any_quaternion(&state, dim, b);
        for (int k = 0; k < 4 && round % 3 == 0; k++) /* near one another */
            b[k] = dim == 2 && (k == 1 || k == 2) ? 0 : a[k] / 2 + (int32_t)test_between(&state, -3, 3);
        if (!b[0] && !b[1] && !b[2] && !b[3])
            continue;
        int64_t turn = cage_turn(a, b);
        test_require(turn >= 0 && turn <= ((int64_t)1 << 32) + 17); /* both norms are rounded down by up to 2^-29 of them */
        chord_square(a, b, right);
        mpq_set_si(got, (long)turn, 1u << 31);
        mpq_canonicalize(got);
        mpq_mul(got, got, got);
        test_require(mpq_cmp(got, right) >= 0);
        /* and within a millionth of it, or 4 units */
        double size = (double)turn / 2147483648.0, least = size * (1 - 1e-6) - 4 / 2147483648.0;
        test_require(least <= 0 || mpq_get_d(right) >= least * least);
        int32_t minus[4] = {-b[0], -b[1], -b[2], -b[3]};
        test_require(cage_turn(a, minus) == turn && cage_turn(b, a) == turn);
    }
    for (int k = 0; k < 10; k++)
        test_require(cage_turn(quarters[k], quarters[k]) == 0);
    mpq_clears(right, got, NULL);
}
END_TEST

/* The least integers that are enough. */
START_TEST(lengths_and_displacements)
{
    uint64_t state = 14;
    mpz_t a, b;
    mpz_inits(a, b, NULL);
    for (int32_t i = 0; i < test_rounds(100000); i++) {
        const int32_t v[3] = {(int32_t)test_spread(&state, 1 << 29), (int32_t)test_spread(&state, 1 << 29),
                              (int32_t)test_spread(&state, 1 << 29)};
        mpz_set_ui(a, 0);
        for (int k = 0; k < 3; k++) {
            mpz_set_si(b, v[k]);
            mpz_addmul(a, b, b);
        }
        int32_t length = cage_length(v);
        mpz_set_si(b, length);
        mpz_mul(b, b, b);
        test_require(length >= 0 && mpz_cmp(b, a) >= 0);
        mpz_set_si(b, length - 1);
        mpz_mul(b, b, b);
        test_require(length == 0 || mpz_cmp(b, a) < 0);

        int64_t turn = test_between(&state, 0, ((int64_t)1 << 32) + 2);
        turn = i & 1 ? turn : test_spread(&state, ((int64_t)1 << 32) + 2);
        turn = turn < 0 ? -turn : turn;
        int32_t reach = (int32_t)test_spread(&state, 1 << 29);
        reach = reach < 0 ? -reach : reach;
        int32_t far = cage_displacement(turn, reach);
        mpz_set_si(a, (long)turn);
        mpz_mul_si(a, a, reach);
        mpz_set_si(b, far);
        mpz_mul_2exp(b, b, 31);
        test_require(mpz_cmp(b, a) >= 0);
        mpz_set_si(b, (long)far - 1);
        mpz_mul_2exp(b, b, 31);
        test_require(mpz_cmp(b, a) < 0);
    }
    const int32_t nothing[3] = {0, 0, 0}, large[3] = {1 << 29, -(1 << 29), 1 << 29};
    ck_assert_int_eq(cage_length(nothing), 0);
    ck_assert_int_eq(cage_length(large), 929887697); /* 2^29 sqrt 3 = 929887696.2 */
    ck_assert_int_eq(cage_displacement((int64_t)1 << 31, 12345), 12345);
    mpz_clears(a, b, NULL);
}
END_TEST

/* Within a cell of rotations, inner balls are inside the collision space and outer ones cover it, rounding included, with 0.87
 * to spare for a query that is rounded. Sampled in exact rational numbers. */
START_TEST(slacks_cover_what_rounds)
{
    uint64_t state = 15;
    mpq_t right[3], far, sum, limit;
    mpq_inits(right[0], right[1], right[2], far, sum, limit, NULL);
    for (int32_t round = 0; round < test_rounds(20000); round++) {
        int32_t dim = 2 + round % 2, q[4], other[4], y[3], at[3];
        struct cage_rotation rotation;
        any_quaternion(&state, dim, q);
        for (int k = 0; k < 4; k++)
            other[k] = dim == 2 && (k == 1 || k == 2) ? 0 : q[k] / 4 * 3 + (int32_t)test_spread(&state, 1 << 27);
        if (!other[0] && !other[1] && !other[2] && !other[3])
            continue;
        any_vector(&state, dim, y);
        cage_rotation_of(q, &rotation);
        cage_rotate(&rotation, y, at);
        int32_t d = cage_displacement(cage_turn(q, other), cage_length(y));
        test_require(cage_radius_change(d, -1) == -d - CAGE_SLACK_INNER && cage_radius_change(d, 1) == d + CAGE_SLACK_OUTER);
        /* |at - R(other) y| <= d + 0.87 (0.71), so 1.13 of the inner slack of 2 is left */
        rotate_exactly(other, y, right);
        mpq_set_ui(sum, 0, 1);
        for (int k = 0; k < 3; k++) {
            mpq_set_si(far, at[k], 1);
            mpq_sub(far, far, right[k]);
            mpq_mul(far, far, far);
            mpq_add(sum, sum, far);
        }
        mpq_set_si(limit, dim == 2 ? 71 : 87, 100);
        mpq_set_si(far, d, 1);
        mpq_add(limit, limit, far);
        mpq_mul(limit, limit, limit);
        test_require(mpq_cmp(sum, limit) <= 0);
    }
    /* twice that, for ball and query, is less than either slack */
    ck_assert(2 * 87 < 100 * CAGE_SLACK_INNER && CAGE_SLACK_OUTER >= CAGE_SLACK_INNER);
    mpq_clears(right[0], right[1], right[2], far, sum, limit, NULL);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("grid");
    TCase *tests = test_case(suite, "grid");
    tcase_add_test(tests, rotates_to_nearest);
    tcase_add_test(tests, quarter_turns_are_exact);
    tcase_add_test(tests, rough_places);
    tcase_add_test(tests, turns_are_upper_bounds);
    tcase_add_test(tests, lengths_and_displacements);
    tcase_add_test(tests, slacks_cover_what_rounds);
    return test_main(suite);
}
