/* test_cover.c: edges, triangles and tetrahedra that their own balls are proved to cover: decided exactly, and looked
 * at point by point. */
#include "support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "backend.h"
#include "exact.h"
#include "sites.h"

static const struct backend *const backends[4] = {&native, &limbs, &broken_carry, &broken_sign};

static const int64_t longest = INT64_C(1) << 62, largest = INT64_C(1) << 60; /* of squared edges, of weights */

/* Squared edges, [i][k] between vertices i and k, and weights. */
struct cover {
    int64_t square[4][4], weight[4];
};

static bool proved(const struct backend *by, int count, struct cover *c)
{
    if (count == 4)
        return by->tetrahedron_covered(c->square, c->weight);
    const int64_t square[3] = {c->square[1][count - 1], c->square[0][2], c->square[0][1]};
    const int64_t edge[3] = {c->square[0][1], 0, 0};
    return by->edges_covered(count, count == 2 ? edge : square, c->weight);
}

static void set_edge(struct cover *c, int i, int k, int64_t square)
{
    c->square[i][k] = c->square[k][i] = square < 0 ? 0 : square > longest ? longest : square;
}

static int64_t floor_of(int64_t a, int64_t b) { return a / b - (a % b < 0); }

/* The matrix 2 weight_i, weight_i + weight_k - square_ik, its entries rounded down to a power of two so that they
 * have 40 bits for a triangle and 27 for a tetrahedron: what a proof may be about, as more than 2^-39 or 2^-26 of the
 * largest entry is not lost. *unit: that power. */
static void matrix_of(int count, const struct cover *c, int64_t a[4][4], int64_t *unit)
{
    int64_t most = 0;
    for (int i = 0; i < count; i++)
        for (int k = 0; k < count; k++) {
            a[i][k] = c->weight[i] + c->weight[k] - (i == k ? 0 : c->square[i][k]);
            most = llabs(a[i][k]) > most ? llabs(a[i][k]) : most;
        }
    *unit = 1;
    while (count > 2 && most / *unit >= INT64_C(1) << (count == 3 ? 40 : 27))
        *unit *= 2;
    for (int i = 0; i < count; i++)
        for (int k = 0; k < count; k++)
            a[i][k] = floor_of(a[i][k], *unit);
}

/* Are the leading minors positive, the last one at least 0, and the diagonal positive? */
static bool semidefinite(int64_t a[4][4], int *last)
{
    bool all = true;
    mpz_t minor;
    mpz_init(minor);
    for (int n = 1; n <= 4; n++) {
        exact_determinant(n, a, minor);
        *last = mpz_sgn(minor);
        all = all && *last >= (n < 4) && a[n - 1][n - 1] > 0;
    }
    mpz_clear(minor);
    return all;
}

/* What the answer has to be: an edge or a triangle is covered if the sum of exact.h, for the rounded matrix, is
 * nowhere positive; a tetrahedron, if moreover the matrix is positive semidefinite. *tie: that hangs on a determinant
 * that is 0. */
static bool expected(int count, struct cover *c, bool *tie)
{
    int64_t a[4][4], unit;
    int last = 1;
    matrix_of(count, c, a, &unit);
    *tie = false;
    if (count == 4) {
        bool all = semidefinite(a, &last);
        *tie = last == 0;
        return all;
    }
    if (unit == 1)
        return exact_nowhere_positive(count, c->square, c->weight);
    struct cover rounded;
    for (int i = 0; i < count; i++) {
        rounded.weight[i] = a[i][i];
        for (int k = 0; k < count; k++)
            rounded.square[i][k] = a[i][i] + a[k][k] - 2 * a[i][k];
    }
    return exact_nowhere_positive(count, rounded.square, rounded.weight);
}

/* Ties: balls through one point p of the simplex. With vertices z_i relative to p, the sum of exact.h is -|sum_i l_i
 * z_i|^2, as sum_i l_i |z_i|^2 - |sum_i l_i z_i|^2 = sum_{i<k} l_i l_k square_ik: it is 0 where the l_i z_i add up to
 * 0. A longer edge or a smaller weight makes it positive there or beside it. All numbers are small ones times a power
 * of 4, so that rounding leaves them alone. */
static void make_tie(uint64_t *state, int count, struct cover *c)
{
    int kind = (int)(random_next(state) % 4), at = (int)(random_next(state) % 3), last = count - 1;
    int64_t scale = INT64_C(1) << 2 * test_between(state, 0, count == 3 ? 10 : 17);
    memset(c, 0, sizeof *c);
    if (count == 2) { /* p between the ends, a and b times the root of a number from them */
        int64_t root = test_between(state, 0, 1 << test_between(state, 0, 14)), number = root * root - (kind == 1 && root > 0);
        int64_t most = (1 << 30) / (root + 1), a = llabs(test_spread(state, most)),
                b = kind == 0 ? a : llabs(test_spread(state, most));
        c->weight[0] = number * a * a;
        c->weight[1] = number * b * b;
        set_edge(c, 0, 1, number * (a + b) * (a + b));
    } else if (kind == 0) { /* equilateral */
        int64_t t = scale * (1 + llabs(test_spread(state, count == 3 ? 1 << 30 : 1 << 22)));
        for (int i = 0; i < count; i++) {
            c->weight[i] = count == 3 ? t : 3 * t;
            for (int k = 0; k < i; k++)
                set_edge(c, i, k, count == 3 ? 3 * t : 8 * t);
        }
    } else if (kind == 1 && count == 3) { /* a right angle, and p in the middle of the long edge */
        int64_t a = scale * test_between(state, 0, INT64_C(1) << 37), b = scale * llabs(test_spread(state, INT64_C(1) << 37));
        c->weight[0] = c->weight[1] = c->weight[2] = a + b;
        set_edge(c, (at + 1) % 3, (at + 2) % 3, 4 * (a + b));
        set_edge(c, at, (at + 1) % 3, 4 * a);
        set_edge(c, at, (at + 2) % 3, 4 * b);
    } else { /* any p: the n_i z_i add up to 0, at most one n_i is 0 */
        const int64_t n[3] = {test_between(state, 1, 5), test_between(state, 0, 5), test_between(state, 1, 5)};
        int64_t m = test_between(state, 1, 5), z[4][3] = {{0}}, u = count == 3 ? 40000 : 300;
        for (int k = 0; k < 3; k++)
            for (int i = 0; i < last; i++) {
                int64_t x = kind == 2 ? test_spread(state, u) : test_between(state, -u, u);
                z[i][k] = m * x;
                z[last][k] -= n[i] * x;
            }
        for (int i = 0; i < count; i++)
            for (int k = 0; k < count; k++) {
                int64_t square = 0;
                for (int e = 0; e < 3; e++)
                    square += k < i ? (z[i][e] - z[k][e]) * (z[i][e] - z[k][e]) : k == i ? z[i][e] * z[i][e] : 0;
                if (k < i)
                    set_edge(c, i, k, scale * square);
                else if (k == i)
                    c->weight[i] = scale * square;
            }
    }
}

/* Edges and weights within their bounds, of all sizes; in many of them no pair of balls decides. */
static void make_any(uint64_t *state, int count, struct cover *c)
{
    int kind = (int)(random_next(state) % 6), near = random_next(state) & 1;
    int64_t factor = INT64_C(1) << test_between(state, 0, 57), off = factor / (near ? 1 : 1 + (factor >> 20));
    make_tie(state, count, c);
    for (int i = 0; i < count; i++) {
        int64_t w = llabs(test_spread(state, largest)), rare = random_next(state) % 8 == 0;
        if (kind == 1) /* next to a tie */
            c->weight[i] += near ? test_between(state, -1, 1) : test_spread(state, 1 + c->weight[i] / 1000);
        else if (kind == 2)
            c->weight[i] = factor * test_between(state, -rare, 4) + test_between(state, 0, off - 1);
        else if (kind == 3)
            c->weight[i] = rare ? -w : w;
        else if (kind == 4)
            c->weight[i] = test_between(state, -rare, 1) * (largest - test_between(state, 0, 1));
        else if (kind == 5)
            c->weight[i] = rare ? w : test_between(state, 0, largest);
        c->weight[i] = c->weight[i] > largest ? largest : c->weight[i];
        for (int k = 0; k < i; k++) {
            double reach = sqrt((double)llabs(c->weight[i])) + sqrt((double)llabs(c->weight[k]));
            int64_t next = near ? test_between(state, -1, 1) : test_spread(state, 1 + c->square[i][k] / 1000);
            set_edge(c, i, k,
                     kind == 0   ? c->square[i][k]
                     : kind == 1 ? c->square[i][k] + next
                     : kind == 2 ? factor / 8 * test_between(state, 0, 31)
                     : kind == 3 ? llabs(test_spread(state, longest))
                     : kind == 4 ? test_between(state, 0, 2) * (longest / 2) - test_between(state, 0, 1)
                                 : (int64_t)(reach * reach * (double)test_between(state, 24, 63) /
                                             64)); /* not much shorter than both reach */
        }
    }
}

static bool pairs_covered(int count, struct cover *c)
{
    bool all = true;
    for (int i = 0; i < count; i++)
        for (int k = 0; k < i; k++) {
            int64_t square[4][4] = {{0, c->square[i][k], 0, 0}, {c->square[i][k], 0, 0, 0}};
            const int64_t weight[4] = {c->weight[i], c->weight[k], 0, 0};
            all = all && exact_nowhere_positive(2, square, weight);
        }
    return all;
}

/* Each edge shorter (sign -1) or longer (1), each weight larger or smaller. */
static void change(uint64_t *state, int count, int sign, const struct cover *c, struct cover *out)
{
    memset(out, 0, sizeof *out);
    for (int i = 0; i < count; i++) {
        out->weight[i] =
            c->weight[i] - sign * llabs(test_spread(state, sign < 0 ? largest - c->weight[i] : largest + c->weight[i]));
        for (int k = 0; k < i; k++)
            set_edge(out, i, k,
                     c->square[i][k] + sign * llabs(test_spread(state, sign < 0 ? c->square[i][k] : longest - c->square[i][k])));
    }
}

static void shuffle(uint64_t *state, int count, const struct cover *c, struct cover *out)
{
    int32_t order[4];
    test_shuffle(state, order, count);
    memset(out, 0, sizeof *out);
    for (int i = 0; i < count; i++) {
        out->weight[i] = c->weight[order[i]];
        for (int k = 0; k < i; k++)
            set_edge(out, i, k, c->square[order[i]][order[k]]);
    }
}

START_TEST(decides_exactly)
{
    int count = _i;
    uint64_t state = (uint64_t)count;
    long wrong[4] = {0}, seen[2] = {0}, hard = 0, lost = 0, rounds = test_rounds(15000);
    for (long round = 0; round < rounds; round++) {
        struct cover c, other;
        bool tie, unused;
        int64_t a[4][4], unit;
        make_any(&state, count, &c);
        bool right = expected(count, &c, &tie), truth = exact_nowhere_positive(count, c.square, c.weight);
        for (int k = 0; k < 4; k++)
            wrong[k] += proved(backends[k], count, &c) != right;
        test_require(count == 2 ? right == truth
                                : right <= truth); /* the test itself: what is rounded down is on the safe side */
        seen[right]++;
        lost += truth && !right;
        hard += !right && pairs_covered(count, &c);
        shuffle(&state, count, &c, &other);
        test_require(tie || proved(&native, count, &other) == right);
        /* Shorter edges and larger weights keep a yes, longer and smaller ones a no. */
        change(&state, count, 1, &c, &other);
        test_require(truth || !proved(&native, count, &other));
        change(&state, count, -1, &c, &other);
        matrix_of(count, &other, a, &unit);
        test_require(count == 4 || !truth || unit > 1 || proved(&native, count, &other));
        test_require(proved(&native, count, &other) == expected(count, &other, &unused));
    }
    ck_assert_msg(wrong[0] == 0, "native: %ld of %ld wrong", wrong[0], rounds);
    ck_assert_msg(wrong[1] == 0, "limbs: %ld of %ld wrong", wrong[1], rounds);
    for (int k = 0; k < 2; k++)
        ck_assert_int_gt(seen[k], rounds / 8);
    ck_assert(count == 2 || hard > rounds / 20);
    ck_assert(count == 4 || lost < rounds / 50);
    ck_assert(count == 2 || wrong[2] > 0); /* the deliberate errors show */
    ck_assert_int_gt(wrong[3], 0);
}
END_TEST

/* A tie is covered, and would not be with one edge longer or one weight smaller by 1. */
START_TEST(decides_ties)
{
    int count = _i, flat = 0;
    uint64_t state = 10 + (uint64_t)count;
    for (int32_t round = test_rounds(30000); round > 0; round--) {
        struct cover c;
        bool tie, right;
        make_tie(&state, count, &c);
        right = expected(count, &c, &tie);
        flat += !right;
        test_require(right || count == 4); /* a flat tetrahedron is not proved */
        test_require(proved(&native, count, &c) == right && proved(&limbs, count, &c) == right);
        for (int i = 0; i < count; i++) {
            c.weight[i]--;
            test_require(!proved(&native, count, &c) && !proved(&limbs, count, &c));
            c.weight[i]++;
            for (int k = 0; k < i; k++) {
                set_edge(&c, i, k, c.square[i][k] + 1);
                test_require(!proved(&native, count, &c) && !proved(&limbs, count, &c));
                set_edge(&c, i, k, c.square[i][k] - 1);
            }
        }
    }
    ck_assert_int_lt(flat, test_rounds(30000) / 4);
}
END_TEST

static void measure(int count, const struct cage_site *v, struct cover *c)
{
    memset(c, 0, sizeof *c);
    for (int i = 0; i < count; i++) {
        c->weight[i] = (int64_t)v[i].r * v[i].r;
        for (int k = 0; k < i; k++) {
            int64_t x = v[i].x - v[k].x, y = v[i].y - v[k].y, z = v[i].z - v[k].z;
            set_edge(c, i, k, x * x + y * y + z * z);
        }
    }
}

/* Is the point with barycentric coordinates l / n in one of the closed balls? Differences <= 2^25, n < 2^5: squares < 3 2^60. */
static bool in_some_ball(int count, const struct cage_site *v, const int64_t l[4], int64_t n)
{
    for (int k = 0; k < count; k++) {
        int64_t x = 0, y = 0, z = 0;
        for (int i = 0; i < count; i++) {
            x += l[i] * (v[i].x - v[k].x);
            y += l[i] * (v[i].y - v[k].y);
            z += l[i] * (v[i].z - v[k].z);
        }
        if (x * x + y * y + z * z <= n * n * v[k].r * v[k].r)
            return true;
    }
    return false;
}

/* Is every point of a grid of the simplex in one of its closed balls? */
static bool sampled(int count, const struct cage_site *v)
{
    int64_t n = count == 4 ? 12 : 24, l[4];
    for (l[0] = 0; l[0] <= n; l[0]++)
        for (l[1] = 0; l[0] + l[1] <= n; l[1]++)
            for (l[2] = 0; l[0] + l[1] + l[2] <= n; l[2]++) {
                l[3] = n - l[0] - l[1] - l[2];
                if ((count < 4 && l[3] > 0) || (count < 3 && l[2] > 0))
                    continue;
                if (!in_some_ball(count, v, l, n))
                    return false;
            }
    return true;
}

/* Corners of any simplex, edges and triangles at times in a plane or on a line, at most 2^24 from 0. */
static int64_t make_corners(uint64_t *state, int count, int32_t round, struct cage_site *v)
{
    int64_t size = round & 1 ? 1 << 24 : INT64_C(4) << test_between(state, 0, 22), c[4][3];
    for (int i = 0; i < count; i++)
        for (int k = 0; k < 3; k++)
            c[i][k] = round & 8 && k == 2 && count < 4 ? 0 : test_between(state, -size, size);
    for (int k = 0; k < 3 && round % 8 == 0 && count == 3; k++) {
        int64_t part = (c[1][k] - c[0][k]) / 4;
        c[1][k] = c[0][k] + 4 * part;
        c[2][k] = c[0][k] + round / 8 % 5 * part;
    }
    for (int i = 0; i < count; i++)
        v[i] = sites_ball(3, c[i][0], c[i][1], c[i][2], 0);
    return size;
}

static void resize(struct cage_site *site, int64_t r) { *site = sites_ball(3, site->x, site->y, site->z, r); }

/* Simplices with balls that are no larger than need be for a yes: each point of a grid is in a ball, and not if they
 * are smaller. */
START_TEST(covered_is_covered)
{
    int count = _i;
    uint64_t state = 20 + (uint64_t)count;
    struct exact_centre centre;
    exact_centre_init(&centre);
    int32_t rounds = test_rounds(4000), yes = 0, missed = 0;
    for (int32_t round = 0; round < rounds; round++) {
        struct cage_site v[4];
        const struct cage_site *const facet[3] = {v, v + 1, v + 2};
        struct cover c;
        int64_t size = make_corners(&state, count, round, v);
        for (int i = 0; i < count; i++)
            resize(&v[i], 2 * size);
        measure(count, v, &c);
        if (!proved(&native, count, &c))
            continue;
        for (int64_t step = 2 * size; step > 0; step /= 2)
            for (int i = 0, turn = (int)test_between(&state, 0, 3); i < count; i++) {
                int k = (i + turn) % count;
                int64_t less = v[k].r - (round & 2 ? step : test_between(&state, 0, step));
                c.weight[k] = less * less;
                if (less >= 0 && proved(&native, count, &c))
                    resize(&v[k], less);
                c.weight[k] = (int64_t)v[k].r * v[k].r;
            }
        yes++;
        test_require(sampled(count, v));
        if (count == 3 && exact_centre_solve(3, facet, &centre))
            test_require(exact_covered(3, facet));
        for (int i = 0; i < count; i++)
            resize(&v[i], v[i].r - v[i].r / (count == 4 ? 3 : 16));
        missed += !sampled(count, v);
    }
    exact_centre_clear(&centre);
    ck_assert_int_gt(yes, rounds / 2);
    ck_assert_int_gt(missed, rounds / 4);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("cover");
    TCase *tests = test_case(suite, "cover");
    tcase_add_loop_test(tests, decides_exactly, 2, 5);
    tcase_add_loop_test(tests, decides_ties, 2, 5);
    tcase_add_loop_test(tests, covered_is_covered, 2, 5);
    return test_main(suite);
}
