/* test_delaunay.c: triangulations of few balls against their definition, in every size of memory, and location in them. */
#include "support.h"

#include <stdlib.h>
#include <string.h>

#include "ballsets.h"
#include "complex.h"
#include "exact.h"

/* The set of simplices is the lower hull of the lifted sites, ties broken by index: nothing missing, nothing more. */
START_TEST(equals_its_definition)
{
    enum balls_kind kind = (enum balls_kind)(_i / 2);
    int32_t dim = 2 + _i % 2, rounds = test_rounds(10);
    for (int32_t count = 0; count <= 12; count++)
        for (int32_t round = 0; round < rounds; round++) {
            cage_ball ball[12];
            struct built b;
            struct complex got, defined;
            balls_make(kind, dim, (uint64_t)(100 * round + count), count, ball);
            complex_build(dim, ball, count, 0, &b);
            (void)complex_validate(&b.t, ball, count);
            complex_of(&b.t, NULL, &got);
            complex_define(dim, b.t.site, b.t.sites, &defined);
            ck_assert_msg(complex_equal(&got, &defined), "%s, dim %d, %d balls, round %d: %d simplices, not %d",
                          balls_text(kind), (int)dim, (int)count, (int)round, (int)got.count, (int)defined.count);
            complex_free(&got);
            complex_free(&defined);
            complex_build_free(&b);
        }
}
END_TEST

START_TEST(no_ball_and_one)
{
    for (int32_t dim = 2; dim <= 3; dim++) {
        struct built b;
        complex_build(dim, NULL, 0, 0, &b);
        ck_assert_int_eq(b.t.simplices, 1);
        ck_assert_int_eq(b.t.dim, dim);
        complex_build_free(&b);
        for (int corner = 0; corner < 27; corner++) {
            int32_t reach = balls_reach(dim);
            const cage_ball ball = {(corner % 3 - 1) * reach, (corner / 3 % 3 - 1) * reach,
                                    dim == 2 ? 0 : (corner / 9 - 1) * reach, corner & 1 ? reach : 0};
            complex_build(dim, &ball, 1, 0, &b);
            ck_assert_int_eq(b.t.simplices, dim + 1);
            (void)complex_validate(&b.t, &ball, 1);
            complex_build_free(&b);
        }
    }
}
END_TEST

/* The largest of concentric balls is seen, and of equal ones the first inserted. */
START_TEST(hides_what_is_inside)
{
    for (int32_t dim = 2; dim <= 3; dim++)
        for (int equal = 0; equal < 2; equal++) {
            cage_ball ball[9];
            for (int i = 0; i < 9; i++) {
                const cage_ball b = {1000, -77, dim == 2 ? 0 : 5, equal ? 40 : 10 * ((i * 4) % 9)};
                ball[i] = b;
            }
            struct built b;
            complex_build(dim, ball, 9, 0, &b);
            ck_assert_int_eq(b.t.simplices, dim + 1);
            for (int32_t s = 0; s < b.t.simplices; s++)
                for (int32_t i = 0; i <= dim; i++) {
                    int32_t v = b.t.simplex[s].v[i];
                    if (v > dim)
                        ck_assert(equal ? v == dim + 1 : ball[b.t.ball[v]].r == 80);
                }
            (void)complex_validate(&b.t, ball, 9);
            complex_build_free(&b);
        }
}
END_TEST

enum { BEFORE = 64, AFTER = 1024, CANARY = 0xa7 };

/* One build in exactly `bytes` bytes between canaries, after a take that must survive. CAGE_OK: the same as `right`. */
static int32_t build_in(size_t bytes, int32_t dim, const cage_ball *ball, int32_t count, const struct built *right,
                        size_t *needed)
{
    unsigned char *all = test_alloc(BEFORE + bytes + AFTER), intact[AFTER];
    memset(intact, CANARY, sizeof intact);
    memset(all, CANARY, BEFORE + bytes + AFTER);
    struct cage_arena arena;
    struct cage_triangulation t;
    cage_arena_init(&arena, all + BEFORE, bytes);
    uint64_t *kept = cage_arena_take(&arena, 2, 8);
    if (kept)
        kept[0] = kept[1] = 12345;
    size_t used = arena.used;
    int32_t got = cage_delaunay(&arena, &cage_all_shortcuts, dim, ball, count, &t);
    test_require(memcmp(all, intact, BEFORE) == 0);
    if (memcmp(all + BEFORE + bytes, intact, AFTER) != 0)
        ck_abort_msg("dim %d, %d balls, block of %lu bytes: something behind it was written", (int)dim, (int)count,
                     (unsigned long)bytes);
    test_require(!kept || (kept[0] == 12345 && kept[1] == 12345));
    test_require(got == CAGE_OK || got == CAGE_ERROR_MEMORY);
    *needed = arena.needed;
    if (got == CAGE_OK) {
        test_require(arena.used > used && arena.used <= arena.size && arena.peak >= arena.used && arena.peak <= arena.size);
        test_require(t.dim == dim && t.sites == right->t.sites && t.simplices == right->t.simplices);
        test_require(memcmp(t.ball, right->t.ball, (size_t)t.sites * sizeof *t.ball) == 0);
        test_require(memcmp(t.site, right->t.site, (size_t)t.sites * sizeof *t.site) == 0);
        for (int32_t s = 0; s < t.simplices; s++)
            for (int32_t i = 0; i <= dim; i++)
                test_require(t.simplex[s].v[i] == right->t.simplex[s].v[i] &&
                             t.simplex[s].twin[i] == right->t.simplex[s].twin[i]);
    } else {
        test_require(arena.used == used);
        test_require(arena.needed > bytes);
    }
    free(all);
    return got;
}

/* Every size from nothing to enough: the error or the same bytes, and once enough, always enough. */
START_TEST(memory_sweep)
{
    static const enum balls_kind kinds[] = {BALLS_RANDOM, BALLS_TINY, BALLS_LATTICE, BALLS_HUGE};
    enum balls_kind kind = kinds[_i / 2];
    int32_t dim = 2 + _i % 2, few = test_rounds(4);
    long lost = 0;
    for (int32_t count = 0; count <= 9; count += 5 - few) {
        cage_ball ball[9];
        struct built right;
        size_t needed, bytes = 0, enough = 0;
        balls_make(kind, dim, 8, count, ball);
        complex_build(dim, ball, count, 0, &right);
        for (; enough < 200; bytes++) {
            int32_t got = build_in(bytes, dim, ball, count, &right, &needed);
            lost += got != CAGE_OK && enough > 0;
            enough += got == CAGE_OK;
            test_require(bytes < 100000);
        }
        complex_build_free(&right);
    }
    ck_assert_msg(lost == 0, "%ld sizes are too small though a smaller one is enough", lost);
}
END_TEST

/* The same for more balls, in steps, then byte by byte where it begins to be enough. */
START_TEST(memory_steps)
{
    enum balls_kind kind = (enum balls_kind)(_i / 2);
    int32_t dim = 2 + _i % 2, count = test_rounds(300);
    cage_ball ball[300];
    struct built right;
    size_t needed, bytes = 0;
    balls_make(kind, dim, 13, count, ball);
    complex_build(dim, ball, count, 0, &right);
    while (build_in(bytes, dim, ball, count, &right, &needed) != CAGE_OK)
        bytes += 997;
    for (size_t start = bytes > 997 ? bytes - 997 : 0; start < bytes; start++)
        (void)build_in(start, dim, ball, count, &right, &needed);
    complex_build_free(&right);
}
END_TEST

/* needed is enough in the plane; in space it is a guess, but going by it gets there soon. */
START_TEST(needed_is_enough)
{
    for (int32_t dim = 2; dim <= 3; dim++)
        for (int kind = 0; kind < BALLS_KINDS; kind++)
            for (int32_t count = 0; count <= 60; count += 12) {
                cage_ball ball[60];
                struct built right;
                size_t needed = 0;
                balls_make((enum balls_kind)kind, dim, 9, count, ball);
                complex_build(dim, ball, count, 0, &right);
                for (size_t bytes = 0; bytes < 3000; bytes += 100) {
                    int tries = 0;
                    int32_t got = build_in(bytes, dim, ball, count, &right, &needed);
                    while (got != CAGE_OK && tries < 10) {
                        got = build_in(needed, dim, ball, count, &right, &needed);
                        tries++;
                    }
                    ck_assert_msg(tries <= (dim == 2 ? 1 : 6), "%s, dim %d, %d balls, from %lu bytes: %d tries, %lu needed",
                                  balls_text((enum balls_kind)kind), (int)dim, (int)count, (unsigned long)bytes, tries,
                                  (unsigned long)needed);
                }
                complex_build_free(&right);
            }
}
END_TEST

/* The peak counts what was used, not what was there. */
START_TEST(peak_is_what_was_used)
{
    for (int32_t dim = 2; dim <= 3; dim++) {
        cage_ball ball[200];
        size_t peak[2], used[2];
        balls_make(BALLS_RANDOM, dim, 14, 200, ball);
        for (int k = 0; k < 2; k++) {
            size_t bytes = (size_t)(k ? 900001 : 200003);
            void *block = test_alloc(bytes);
            struct cage_arena arena;
            struct cage_triangulation t;
            cage_arena_init(&arena, block, bytes);
            ck_assert_int_eq(cage_delaunay(&arena, &cage_all_shortcuts, dim, ball, 200, &t), CAGE_OK);
            peak[k] = arena.peak;
            used[k] = arena.used;
            free(block);
        }
        ck_assert_uint_eq(used[0], used[1]);
        ck_assert_uint_eq(peak[0], peak[1]);
        ck_assert(peak[0] >= used[0] && peak[0] < 200003);
    }
}
END_TEST

static bool contains(const struct cage_triangulation *t, int32_t s, const struct cage_site *p)
{
    const struct cage_site *v[4];
    for (int32_t i = 0; i <= t->dim; i++) {
        cage_simplex_sites(t, s, v);
        v[i] = p;
        if (exact_orientation(t->dim, v) < 0)
            return false;
    }
    return true;
}

/* A grid point inside the sentinels' simplex: anywhere, next to a ball, at a ball, or between two. */
static struct cage_site random_point(uint64_t *state, const struct cage_triangulation *t)
{
    int64_t m = t->dim == 2 ? 1 << 29 : 1 << 24;
    const struct cage_site *a = &t->site[test_between(state, 0, t->sites - 1)],
                           *b = &t->site[test_between(state, 0, t->sites - 1)];
    for (;;) {
        struct cage_site p = {0, a->x, a->y, a->z, 0};
        switch (random_next(state) % 4) {
        case 0:
            p.x = (int32_t)test_between(state, -m, m);
            p.y = (int32_t)test_between(state, -m, m);
            p.z = t->dim == 2 ? 0 : (int32_t)test_between(state, -m, m);
            break;
        case 1:
            p.x += (int32_t)test_between(state, -1, 1);
            p.y += (int32_t)test_between(state, -1, 1);
            break;
        case 2:
            p.x = (int32_t)(((int64_t)a->x + b->x) / 2);
            p.y = (int32_t)(((int64_t)a->y + b->y) / 2);
            p.z = (int32_t)(((int64_t)a->z + b->z) / 2);
            break;
        default: break;
        }
        const struct cage_site *v[4] = {&t->site[0], &t->site[1], &t->site[2], &t->site[t->dim]};
        bool inside = true;
        for (int32_t i = 0; i <= t->dim && inside; i++) {
            v[i] = &p;
            inside = exact_orientation(t->dim, v) > 0;
            v[i] = &t->site[i];
        }
        if (inside)
            return p;
        a = &t->site[test_between(state, 0, t->sites - 1)];
    }
}

START_TEST(locates_grid_points)
{
    enum balls_kind kind = (enum balls_kind)(_i / 2);
    int32_t dim = 2 + _i % 2, count = 60;
    uint64_t state = (uint64_t)_i;
    cage_ball ball[60];
    struct built b;
    balls_make(kind, dim, 10, count, ball);
    complex_build(dim, ball, count, 0, &b);
    for (int32_t round = test_rounds(1000); round > 0; round--) {
        struct cage_site p = random_point(&state, &b.t);
        const int32_t at[3] = {p.x, p.y, p.z};
        for (int hint = 0; hint < 5; hint++) {
            int32_t s = cage_delaunay_locate(&b.t, at, (int32_t)test_between(&state, 0, b.t.simplices - 1));
            test_require(s >= 0 && s < b.t.simplices && contains(&b.t, s, &p));
        }
    }
    complex_build_free(&b);
}
END_TEST

/* Is the point in the simplex (v null: in the sentinels'), by barycentric coordinates? */
static bool holds(const struct cage_triangulation *t, int32_t s, mpq_t x[3], mpq_t l[4])
{
    const struct cage_site *v[4] = {&t->site[0], &t->site[1], &t->site[2], &t->site[t->dim]};
    if (s >= 0)
        cage_simplex_sites(t, s, v);
    test_require(exact_barycentric(t->dim, v, x, l));
    for (int32_t i = 0; i <= t->dim; i++)
        if (mpq_sgn(l[i]) < 0)
            return false;
    return true;
}

/* Orthocentres of one triangulation in itself and in another one. */
START_TEST(locates_centres)
{
    enum balls_kind kind = (enum balls_kind)(_i / 2);
    int32_t dim = 2 + _i % 2, count = test_rounds(40), outside = 0;
    uint64_t state = (uint64_t)_i;
    cage_ball ball[40];
    struct built from, in;
    struct exact_centre right;
    mpq_t l[4];
    mpq_inits(l[0], l[1], l[2], l[3], NULL);
    exact_centre_init(&right);
    balls_make(kind, dim, 11, count, ball);
    complex_build(dim, ball, count, 0, &from);
    balls_make((enum balls_kind)((int)kind / 2), dim, 12, count, ball);
    complex_build(dim, ball, count, 0, &in);
    for (int32_t s = 0; s < from.t.simplices; s++) {
        const struct cage_triangulation *t = s & 1 ? &from.t : &in.t;
        const struct cage_site *v[4];
        struct cage_centre centre;
        cage_simplex_sites(&from.t, s, v);
        cage_orthocentre(dim, v, &centre);
        test_require(exact_centre_solve(dim + 1, v, &right));
        for (int hint = 0; hint < 3; hint++) {
            int32_t at = cage_delaunay_locate_centre(t, &centre, (int32_t)test_between(&state, 0, t->simplices - 1));
            test_require(at >= -1 && at < t->simplices);
            test_require(holds(t, at, right.x, l) == (at >= 0));
            outside += at < 0;
        }
    }
    ck_assert(kind != BALLS_RANDOM || outside < 3 * from.t.simplices);
    exact_centre_clear(&right);
    mpq_clears(l[0], l[1], l[2], l[3], NULL);
    complex_build_free(&from);
    complex_build_free(&in);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("delaunay");
    TCase *tests = test_case(suite, "delaunay");
    tcase_add_loop_test(tests, equals_its_definition, 0, 2 * BALLS_KINDS);
    tcase_add_test(tests, no_ball_and_one);
    tcase_add_test(tests, hides_what_is_inside);
    tcase_add_loop_test(tests, memory_sweep, 0, 8);
    tcase_add_loop_test(tests, memory_steps, 0, 2 * BALLS_KINDS);
    tcase_add_test(tests, needed_is_enough);
    tcase_add_test(tests, peak_is_what_was_used);
    tcase_add_loop_test(tests, locates_grid_points, 0, 2 * BALLS_KINDS);
    tcase_add_loop_test(tests, locates_centres, 0, 2 * BALLS_KINDS);
    return test_main(suite);
}
