/* test_extend.c: triangulations to which sites are added later: against their definition, and in every size of memory. */
#include "support.h"

#include <stdlib.h>
#include <string.h>

#include "ballsets.h"
#include "complex.h"
#include "exact.h"

enum { MOST = 7, BEFORE = 64, AFTER = 1024, CANARY = 0xa7 };

/* Sites to add: of another set of balls, or some of the same once more. */
static int32_t make_more(enum balls_kind kind, int32_t dim, uint64_t seed, const struct cage_triangulation *t,
                         struct cage_site *site, const struct cage_site **more)
{
    cage_ball ball[MOST];
    uint64_t state = seed;
    int32_t count = (int32_t)test_between(&state, 0, MOST), again = (int32_t)test_between(&state, 0, 3);
    balls_make(kind, dim, seed, count, ball);
    for (int32_t i = 0; i < count; i++) {
        const cage_ball *b = &ball[i];
        const struct cage_site made = {(int64_t)b->x * b->x + (int64_t)b->y * b->y + (int64_t)b->z * b->z - (int64_t)b->r * b->r,
                                       b->x, b->y, b->z, b->r};
        site[i] = made;
        more[i] = &site[i];
        if (again == 0 && t->sites > dim + 1)
            more[i] = &t->site[test_between(&state, dim + 1, t->sites - 1)];
    }
    return count;
}

/* The simplices in use, in the way of a triangulation without gaps, but for the twins. */
static void without_gaps(const struct cage_triangulation *t, struct cage_triangulation *out)
{
    *out = *t;
    out->simplices = 0;
    out->simplex = test_alloc((size_t)t->simplices * sizeof *t->simplex);
    for (int32_t s = 0; s < t->simplices; s++)
        if (t->simplex[s].v[0] >= 0)
            out->simplex[out->simplices++] = t->simplex[s];
}

static bool same_vertices(int32_t dim, const struct cage_simplex *a, const struct cage_simplex *b)
{
    bool same = true;
    for (int32_t i = 0; i <= dim; i++)
        same = same && a->v[i] == b->v[i];
    return same;
}

/* Sites are the old ones and the new ones; simplices without a new one are where they were; twins name each other. */
static void check_extended(const struct cage_triangulation *from, const struct cage_site *const *more, int32_t count,
                           const struct cage_triangulation *t)
{
    int32_t dim = from->dim, hull = 0, kept = 0, old = 0;
    test_require(t->dim == dim && t->sites == from->sites + count && t->simplices >= from->simplices && t->ball == NULL);
    test_require(memcmp(t->site, from->site, (size_t)from->sites * sizeof *t->site) == 0);
    for (int32_t i = 0; i < count; i++)
        test_require(memcmp(&t->site[from->sites + i], more[i], sizeof *t->site) == 0);
    for (int32_t s = 0; s < t->simplices; s++) {
        const struct cage_simplex *here = &t->simplex[s];
        const struct cage_site *v[4];
        bool fresh = false;
        if (here->v[0] < 0)
            continue;
        for (int32_t i = 0; i <= dim; i++) {
            test_require(here->v[i] >= 0 && here->v[i] < t->sites);
            fresh = fresh || here->v[i] >= from->sites;
        }
        kept += s < from->simplices && same_vertices(dim, here, &from->simplex[s]);
        old += !fresh;
        test_require(fresh || (s < from->simplices && same_vertices(dim, here, &from->simplex[s])));
        cage_simplex_sites(t, s, v);
        test_require(exact_orientation(dim, v) > 0);
        for (int32_t i = 0; i <= dim; i++) {
            hull += here->twin[i] == CAGE_HULL;
            if (here->twin[i] == CAGE_HULL)
                continue;
            int32_t other = here->twin[i] >> 2, j = here->twin[i] & 3, shared = 0;
            test_require(here->twin[i] >= 0 && other < t->simplices && j <= dim && t->simplex[other].v[0] >= 0);
            test_require(t->simplex[other].twin[j] == 4 * s + i);
            for (int32_t k = 0; k <= dim; k++)
                for (int32_t l = 0; l <= dim; l++)
                    shared += k != i && l != j && here->v[k] == t->simplex[other].v[l];
            test_require(shared == dim);
        }
    }
    test_require(hull == dim + 1 && kept == old);
}

static void extend(const struct cage_triangulation *from, const struct cage_site *const *more, int32_t count, struct built *out)
{
    size_t bytes = 1 << 22;
    struct cage_arena arena;
    out->block = test_alloc(bytes);
    cage_arena_init(&arena, out->block, bytes);
    ck_assert_int_eq(cage_delaunay_extend(&arena, from, more, count, &out->t), CAGE_OK);
    check_extended(from, more, count, &out->t);
}

/* More sites give the triangulation of all, by its definition. */
START_TEST(equals_its_definition)
{
    enum balls_kind kind = (enum balls_kind)(_i / 2);
    int32_t dim = 2 + _i % 2, grown = 0, rounds = test_rounds(40);
    for (int32_t round = 0; round < rounds; round++) {
        uint64_t state = (uint64_t)round, seed = random_next(&state);
        int32_t count = (int32_t)test_between(&state, 0, 8);
        cage_ball ball[8];
        struct built from, more_of;
        struct cage_triangulation dense;
        struct cage_site site[MOST];
        const struct cage_site *more[MOST];
        struct complex got, defined;
        balls_make(kind, dim, seed, count, ball);
        complex_build(dim, ball, count, 0, &from);
        int32_t added = make_more(round % 3 ? kind : (enum balls_kind)(seed % BALLS_KINDS), dim, seed + 1, &from.t, site, more);
        extend(&from.t, more, added, &more_of);
        without_gaps(&more_of.t, &dense);
        complex_of(&dense, NULL, &got);
        complex_define(dim, dense.site, dense.sites, &defined);
        ck_assert_msg(complex_equal(&got, &defined), "%s, dim %d, %d and %d balls, round %d: %d simplices, not %d",
                      balls_text(kind), (int)dim, (int)count, (int)added, (int)round, (int)got.count, (int)defined.count);
        grown += dense.simplices > from.t.simplices;
        complex_free(&got);
        complex_free(&defined);
        free(dense.simplex);
        complex_build_free(&more_of);
        complex_build_free(&from);
    }
    ck_assert_int_gt(grown, rounds / 10);
}
END_TEST

/* Many balls, all of them added to none, or half of them to the other half: the same, and convex at every facet. */
START_TEST(equals_itself)
{
    enum { MANY = 300 };
    enum balls_kind kind = (enum balls_kind)(_i / 2);
    int32_t dim = 2 + _i % 2, count = test_rounds(MANY), half = count / 2;
    cage_ball ball[MANY];
    struct built none, first, second, all, halves;
    struct cage_triangulation dense[2];
    const struct cage_site *more[MANY];
    struct complex got[2];
    balls_make(kind, dim, 15, count, ball);
    complex_build(dim, ball, 0, 0, &none);
    complex_build(dim, ball, half, 0, &first);
    complex_build(dim, ball + half, count - half, 0, &second);
    for (int32_t i = 0; i < count; i++)
        more[i] = i < half ? &first.t.site[dim + 1 + i] : &second.t.site[dim + 1 + i - half];
    extend(&none.t, more, count, &all);
    extend(&first.t, more + half, count - half, &halves);
    for (int k = 0; k < 2; k++) {
        without_gaps(k ? &halves.t : &all.t, &dense[k]);
        complex_of(&dense[k], NULL, &got[k]);
    }
    ck_assert(complex_equal(&got[0], &got[1]));
    for (int32_t s = 0; s < dense[1].simplices; s++)
        for (int32_t i = 0; i <= dim; i++)
            if (dense[1].simplex[s].twin[i] != CAGE_HULL) {
                int32_t twin = dense[1].simplex[s].twin[i];
                long ties = 0;
                test_require(
                    exact_above(dim, halves.t.site, dense[1].simplex[s].v, halves.t.simplex[twin >> 2].v[twin & 3], &ties) > 0);
            }
    for (int k = 0; k < 2; k++) {
        complex_free(&got[k]);
        free(dense[k].simplex);
    }
    complex_build_free(&none);
    complex_build_free(&first);
    complex_build_free(&second);
    complex_build_free(&all);
    complex_build_free(&halves);
}
END_TEST

/* Every size of memory: the error and nothing taken, or the same bytes, and once enough, always enough. */
START_TEST(memory_sweep)
{
    static const enum balls_kind kinds[] = {BALLS_RANDOM, BALLS_TINY, BALLS_LATTICE, BALLS_HUGE};
    int32_t dim = 2 + _i % 2, count = 5, enough = 0;
    cage_ball ball[5];
    struct built from;
    struct cage_site site[MOST];
    const struct cage_site *more[MOST];
    struct cage_triangulation right = {NULL, NULL, NULL, NULL, 0, 0, 0}, t;
    struct cage_arena arena;
    unsigned char *ample = test_alloc(1 << 16);
    balls_make(kinds[_i / 2], dim, 16, count, ball);
    complex_build(dim, ball, count, 0, &from);
    int32_t added = make_more(kinds[_i / 2], dim, 17, &from.t, site, more);
    cage_arena_init(&arena, ample, 1 << 16);
    ck_assert_int_eq(cage_delaunay_extend(&arena, &from.t, more, added, &right), CAGE_OK);
    for (size_t bytes = 0; enough < 20; bytes += 1 + bytes / 500) {
        unsigned char *all = test_alloc(BEFORE + bytes + AFTER), intact[AFTER];
        memset(intact, CANARY, sizeof intact);
        memset(all, CANARY, BEFORE + bytes + AFTER);
        cage_arena_init(&arena, all + BEFORE, bytes);
        (void)cage_arena_take(&arena, 2, 8);
        size_t used = arena.used;
        int32_t got = cage_delaunay_extend(&arena, &from.t, more, added, &t);
        test_require(memcmp(all, intact, BEFORE) == 0 && memcmp(all + BEFORE + bytes, intact, AFTER) == 0);
        test_require(got == CAGE_OK || (got == CAGE_ERROR_MEMORY && enough == 0 && arena.used == used && arena.needed > bytes));
        test_require(bytes < 60000);
        if (got == CAGE_OK) {
            enough++;
            test_require(arena.peak >= arena.used && arena.peak <= arena.size && t.simplices == right.simplices);
            for (int32_t s = 0; s < t.simplices; s++)
                test_require(memcmp(t.simplex[s].v, right.simplex[s].v, (size_t)(dim + 1) * sizeof t.simplex[s].v[0]) == 0);
            check_extended(&from.t, more, added, &t);
        }
        free(all);
    }
    free(ample);
    complex_build_free(&from);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("extend");
    TCase *tests = test_case(suite, "extend");
    tcase_add_loop_test(tests, equals_its_definition, 0, 2 * BALLS_KINDS);
    tcase_add_loop_test(tests, equals_itself, 0, 2 * BALLS_KINDS);
    tcase_add_loop_test(tests, memory_sweep, 0, 8);
    return test_main(suite);
}
