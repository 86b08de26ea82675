/* test_delaunay_large.c: triangulations of many balls checked part by part, and moved, mirrored and permuted input. */
#include "support.h"

#include <stdlib.h>
#include <string.h>

#include "ballsets.h"
#include "complex.h"
#include "exact.h"

static const int32_t counts[] = {100, 1000, 5000};

START_TEST(valid_on_every_kind_of_set)
{
    enum balls_kind kind = (enum balls_kind)(_i / 2);
    int32_t dim = 2 + _i % 2;
    long ties = 0;
    for (size_t n = 0; n < sizeof counts / sizeof counts[0]; n++) {
        int32_t count = test_rounds(counts[n]);
        cage_ball *ball = test_alloc((size_t)count * sizeof *ball);
        balls_make(kind, dim, n, count, ball);
        struct built b, again;
        complex_build(dim, ball, count, 0, &b);
        ties += complex_validate(&b.t, ball, count);
        complex_build(dim, ball, count, 255, &again); /* nothing is read that was not written */
        ck_assert_int_eq(b.t.simplices, again.t.simplices);
        for (int32_t s = 0; s < b.t.simplices; s++)
            for (int32_t i = 0; i <= dim; i++) {
                test_require(b.t.simplex[s].v[i] == again.t.simplex[s].v[i]);
                test_require(b.t.simplex[s].twin[i] == again.t.simplex[s].twin[i]);
            }
        complex_build_free(&b);
        complex_build_free(&again);
        free(ball);
    }
    /* The sets are what they are meant to be. */
    if (kind == BALLS_LATTICE || kind == BALLS_COSPHERICAL || kind == BALLS_TINY)
        ck_assert_int_gt(ties, 50);
    if (kind == BALLS_RANDOM || kind == BALLS_HUGE)
        ck_assert_int_eq(ties, 0);
}
END_TEST

START_TEST(valid_when_large)
{
    int32_t dim = _i, count = test_rounds(20000);
    cage_ball *ball = test_alloc((size_t)count * sizeof *ball);
    for (int kind = 0; kind < BALLS_KINDS; kind++) {
        if (kind != BALLS_RANDOM && kind != BALLS_LATTICE && kind != BALLS_CLUSTERS)
            continue;
        struct built b;
        balls_make((enum balls_kind)kind, dim, 77, count, ball);
        complex_build(dim, ball, count, 0, &b);
        (void)complex_validate(&b.t, ball, count);
        complex_build_free(&b);
    }
    free(ball);
}
END_TEST

/* Sets without ties: their triangulation is unique. */
static const enum balls_kind generic[] = {BALLS_RANDOM, BALLS_HUGE, BALLS_NESTED};
enum { GENERIC = 3 };

/* Build, name the balls by to[] (null: by index), and give the set; the set has no ties. */
static void generic_complex(int32_t dim, const cage_ball *ball, int32_t count, const int32_t *to, struct built *b,
                            struct complex *c)
{
    complex_build(dim, ball, count, 0, b);
    ck_assert_int_eq(complex_validate(&b->t, ball, count), 0);
    int32_t *name = complex_names(&b->t, to);
    complex_of(&b->t, name, c);
    free(name);
}

START_TEST(permuting_permutes)
{
    int32_t dim = 2 + _i % 2, count = 400, rounds = test_rounds(5), order[400];
    cage_ball ball[400], shuffled[400];
    uint64_t state = (uint64_t)_i;
    balls_make(generic[_i / 2], dim, 3, count, ball);
    struct built a, b;
    struct complex first, second;
    generic_complex(dim, ball, count, NULL, &a, &first);
    for (int round = 0; round < rounds; round++) {
        test_shuffle(&state, order, count);
        for (int32_t i = 0; i < count; i++)
            shuffled[i] = ball[order[i]];
        generic_complex(dim, shuffled, count, order, &b, &second);
        ck_assert(complex_equal(&first, &second));
        complex_free(&second);
        complex_build_free(&b);
    }
    complex_free(&first);
    complex_build_free(&a);
}
END_TEST

/* New coordinate k is sign[k] times old coordinate axis[k]. Each maps the sentinels of its dimension onto themselves. */
struct symmetry {
    int32_t dim, axis[3], sign[3];
};

static const struct symmetry symmetries[] = {
    {2, {0, 1, 2}, {-1, 1, 1}}, {3, {1, 0, 2}, {1, 1, 1}},   {3, {0, 2, 1}, {1, 1, 1}},
    {3, {1, 2, 0}, {1, 1, 1}},  {3, {0, 1, 2}, {-1, -1, 1}}, {3, {1, 0, 2}, {-1, 1, -1}},
};
enum { SYMMETRIES = sizeof symmetries / sizeof symmetries[0] };

static cage_ball turned(const struct symmetry *y, const cage_ball *b)
{
    const int32_t from[3] = {b->x, b->y, b->z};
    cage_ball out = {y->sign[0] * from[y->axis[0]], y->sign[1] * from[y->axis[1]], y->sign[2] * from[y->axis[2]], b->r};
    return out;
}

START_TEST(mirroring_mirrors)
{
    const struct symmetry *y = &symmetries[_i / GENERIC];
    int32_t dim = y->dim, count = 400;
    cage_ball ball[400], moved[400];
    balls_make(generic[_i % GENERIC], dim, 4, count, ball);
    for (int32_t i = 0; i < count; i++)
        moved[i] = turned(y, &ball[i]);
    struct built a, b;
    struct complex first, second;
    generic_complex(dim, ball, count, NULL, &a, &first);
    generic_complex(dim, moved, count, NULL, &b, &second);
    /* Call the sentinels of the first by what they become. */
    int32_t *name = complex_names(&a.t, NULL);
    for (int32_t s = 0; s <= dim; s++) {
        const cage_ball at = {a.t.site[s].x, a.t.site[s].y, a.t.site[s].z, 0}, to = turned(y, &at);
        name[s] = -1;
        for (int32_t k = 0; k <= dim; k++)
            if (b.t.site[k].x == to.x && b.t.site[k].y == to.y && b.t.site[k].z == to.z)
                name[s] = k;
        ck_assert_int_ge(name[s], 0);
    }
    complex_free(&first);
    complex_of(&a.t, name, &first);
    ck_assert(complex_equal(&first, &second));
    free(name);
    complex_free(&first);
    complex_free(&second);
    complex_build_free(&a);
    complex_build_free(&b);
}
END_TEST

/* Every simplex of balls alone in a is in b exactly if no sentinel of b is in conflict with it: no ball is. */
static int32_t check_moved(const struct built *a, const struct built *b, const struct complex *to)
{
    int32_t dim = a->t.dim, kept = 0, *site_of = test_alloc((size_t)a->t.sites * sizeof *site_of);
    int32_t *name = complex_names(&a->t, NULL);
    for (int32_t s = dim + 1; s < b->t.sites; s++)
        site_of[b->t.ball[s]] = s;
    for (int32_t s = 0; s < a->t.simplices; s++) {
        int32_t v[4] = {0, 0, 0, 0}, row[4] = {-1, -1, -1, -1};
        bool balls = true, conflict = false;
        long ties = 0;
        for (int32_t i = 0; i <= dim && balls; i++) {
            balls = a->t.simplex[s].v[i] > dim;
            if (!balls)
                break;
            v[i] = site_of[a->t.ball[a->t.simplex[s].v[i]]];
            int32_t n = name[a->t.simplex[s].v[i]], k = i;
            for (; k > 0 && row[k - 1] > n; k--)
                row[k] = row[k - 1];
            row[k] = n;
        }
        if (!balls)
            continue;
        for (int32_t p = 0; p <= dim; p++)
            conflict = conflict || exact_above(dim, b->t.site, v, p, &ties) < 0;
        test_require(ties == 0);
        test_require(complex_has(to, row) == !conflict);
        kept += !conflict;
    }
    free(site_of);
    free(name);
    return kept;
}

START_TEST(translating_translates)
{
    int32_t dim = 2 + _i % 2, count = 400, rounds = test_rounds(5), half = balls_reach(dim) / 2;
    cage_ball ball[400], moved[400];
    uint64_t state = (uint64_t)_i;
    balls_make(generic[_i / 2], dim, 6, count, ball);
    for (int32_t i = 0; i < count; i++) {
        ball[i].x /= 2;
        ball[i].y /= 2;
        ball[i].z /= 2;
    }
    struct built a, b;
    struct complex first, second;
    generic_complex(dim, ball, count, NULL, &a, &first);
    for (int round = 0; round < rounds; round++) {
        int32_t by[3];
        for (int k = 0; k < 3; k++)
            by[k] = (int32_t)test_between(&state, -half, half) * (k < dim);
        for (int32_t i = 0; i < count; i++) {
            const cage_ball m = {ball[i].x + by[0], ball[i].y + by[1], ball[i].z + by[2], ball[i].r};
            moved[i] = m;
        }
        generic_complex(dim, moved, count, NULL, &b, &second);
        int32_t forth = check_moved(&a, &b, &second), back = check_moved(&b, &a, &first);
        ck_assert_int_eq(forth, back);
        if (generic[_i / 2] == BALLS_RANDOM) /* not an empty claim */
            ck_assert_int_gt(forth, first.count / 2);
        complex_free(&second);
        complex_build_free(&b);
    }
    complex_free(&first);
    complex_build_free(&a);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("delaunay, large");
    TCase *tests = test_case(suite, "delaunay");
    tcase_add_loop_test(tests, valid_on_every_kind_of_set, 0, 2 * BALLS_KINDS);
    tcase_add_loop_test(tests, valid_when_large, 2, 4);
    tcase_add_loop_test(tests, permuting_permutes, 0, 2 * GENERIC);
    tcase_add_loop_test(tests, mirroring_mirrors, 0, SYMMETRIES * GENERIC);
    tcase_add_loop_test(tests, translating_translates, 0, 2 * GENERIC);
    return test_main(suite);
}
