/* test_barrier.c: no pair of components that share a point is called apart, and none that are apart touching;
 * tetrahedra in balls are proved solid. */
#include "support.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "barrier.h"
#include "glued.h"
#include "pockets.h"
#include "sites.h"

enum { ARENA = 8 << 20 };

struct tally {
    long pairs, apart, touching;  /* in truth; those with two outsides are not counted */
    long found_apart, found_touching;
};

enum { UNDECIDED = 0, APART = 1, TOUCHING = 2 };

static int32_t ask(struct cage_view *view, int32_t k, int32_t l, int32_t x[3])
{
    if (cage_view_is_touching(view, k, l, x))
        return TOUCHING;
    return cage_barrier_is_apart(view, k, l) ? APART : UNDECIDED;
}

/* Ask in the order in which gluing does, then in any. */
static void check_view(struct cage_arena *arena, uint64_t seed, const struct glued *c, const struct glued *d,
                       bool wanted[GLUED_MOST][GLUED_MOST], bool transposed, struct tally *tally)
{
    struct cage_view view;
    int32_t k_count = c->slice.regions, l_count = d->slice.regions, hint[2] = {0, 0};
    uint64_t state = seed;
    size_t mark = arena->used;
    test_require(cage_view_make(arena, &c->slice, &d->slice, NULL, &view) == CAGE_OK);
    int8_t *verdicts = test_alloc((size_t)k_count * (size_t)l_count);
    for (int32_t n = 0; n < k_count * l_count + 50; n++) {
        int32_t at = n < k_count * l_count ? n : (int32_t)test_between(&state, 0, k_count * l_count - 1), k = at / l_count,
                l = at % l_count, x[3];
        int32_t verdict = ask(&view, k, l, x);
        bool touch = transposed ? wanted[l][k] : wanted[k][l];
        if ((verdict == APART && touch) || (verdict == TOUCHING && !touch))
            ck_abort_msg("seed %lu, %d and %d: said to be %s, but they are not", (unsigned long)seed, (int)k, (int)l,
                         verdict == APART ? "apart" : "touching");
        if (verdict == TOUCHING)
            test_require(glued_locate(c, x, &hint[0]) == k && glued_locate(d, x, &hint[1]) == l);
        test_require(n < k_count * l_count || verdicts[at] == verdict);
        verdicts[at] = (int8_t)verdict;
        if (n >= k_count * l_count || at == 0)
            continue;
        tally->pairs++;
        tally->apart += !touch;
        tally->touching += touch;
        tally->found_apart += verdict == APART;
        tally->found_touching += verdict == TOUCHING;
    }
    free(verdicts);
    cage_arena_release(arena, mark);
}

/* All pairs of components, from either side. */
static void check_scene(int32_t dim, uint64_t seed, struct tally *tally)
{
    static bool wanted[GLUED_MOST][GLUED_MOST];
    struct cage_arena arena;
    struct pockets p;
    struct cage_side side;
    struct glued c, d;
    struct whole mixture;
    void *block = test_alloc(ARENA);
    cage_arena_init(&arena, block, ARENA);
    pockets_make(dim, seed, &p);
    pockets_side(&arena, &p, &side);
    glued_make(&arena, &side, &p.at[0], &c);
    glued_make(&arena, &side, &p.at[1], &d);
    whole_mix(&c.whole, &d.whole, &mixture);
    (void)glued_pairs(&c, &d, &mixture, wanted);
    check_view(&arena, seed, &c, &d, wanted, false, tally);
    check_view(&arena, seed, &d, &c, wanted, true, tally);
    whole_free(&mixture);
    glued_free(&c);
    glued_free(&d);
    free(block);
}

START_TEST(says_nothing_wrong)
{
    int32_t rounds = test_rounds(_i == 2 ? 1500 : 700);
    struct tally tally = {0, 0, 0, 0, 0};
    for (int32_t seed = 0; seed < rounds; seed++)
        check_scene(_i, 1000000 + (uint64_t)seed, &tally);
    printf("glue: dim %d: %ld pairs, %ld of %ld apart and %ld of %ld touching proved so\n", _i, tally.pairs, tally.found_apart,
           tally.apart, tally.found_touching, tally.touching);
    ck_assert_int_gt(tally.found_apart, tally.apart / 2);
    ck_assert_int_gt(tally.found_touching, tally.touching / 2);
}
END_TEST

/* Four sites, at times nearly flat, whose balls are about as large as needed. */
static bool make_tetrahedron(uint64_t *state, struct cage_site site[4])
{
    int64_t size = INT64_C(1) << test_between(state, 3, 23), height = test_between(state, 0, 2) ? size : size / 8;
    int64_t radius = test_between(state, size / 2, 2 * size);
    for (int i = 0; i < 4; i++) {
        int64_t x[3], r = radius + test_between(state, -size / 4, size / 4);
        for (int k = 0; k < 3; k++)
            x[k] = test_between(state, k == 2 ? -height : -size, k == 2 ? height : size);
        site[i] = sites_ball(3, x[0], x[1], x[2], r < sites_largest(3) ? r : sites_largest(3));
    }
    const struct cage_site *v[4] = {site, site + 1, site + 2, site + 3};
    return exact_orientation(3, v) != 0;
}

static int64_t measure(const struct cage_site site[4], int64_t square[4][4], int64_t weight[4])
{
    int64_t longest = 0;
    for (int i = 0; i < 4; i++) {
        weight[i] = (int64_t)site[i].r * site[i].r;
        for (int k = 0; k < 4; k++) {
            int64_t x = site[i].x - site[k].x, y = site[i].y - site[k].y, z = site[i].z - site[k].z;
            square[i][k] = x * x + y * y + z * z;
            longest = square[i][k] > longest ? square[i][k] : longest;
        }
    }
    return longest;
}

/* Is a random point of the tetrahedron, now and then of its border, in one of the closed balls? */
static bool in_some_ball(uint64_t *state, const struct cage_site site[4], mpq_t x[3], mpq_t value)
{
    int64_t part[4], sum = 0, entry[3] = {0, 0, 0};
    for (int i = 0; i < 4; i++)
        sum += part[i] = test_between(state, 0, 2) ? test_between(state, 0, 1000) : 0;
    sum += sum == 0 ? part[0] = 1 : 0;
    for (int i = 0; i < 4; i++) {
        entry[0] += part[i] * site[i].x;
        entry[1] += part[i] * site[i].y;
        entry[2] += part[i] * site[i].z;
    }
    for (int k = 0; k < 3; k++) {
        mpq_set_si(x[k], entry[k], (unsigned long)sum);
        mpq_canonicalize(x[k]);
    }
    for (int i = 0; i < 4; i++) {
        exact_power(&site[i], x, value);
        if (mpq_sgn(value) <= 0)
            return true;
    }
    return false;
}

/* What is said to be covered for longer edges and smaller weights is covered; and of what is clearly covered, nearly
 * all is said to be. */
START_TEST(solid_is_solid)
{
    uint64_t state = 1;
    struct exact_centre centre;
    mpq_t value;
    int32_t rounds = test_rounds(20000), yes = 0, clear = 0, clear_yes = 0;
    mpq_init(value);
    exact_centre_init(&centre);
    for (int32_t round = 0; round < rounds; round++) {
        struct cage_site site[4];
        const struct cage_site *const v[4] = {site, site + 1, site + 2, site + 3};
        int64_t square[4][4], weight[4];
        if (!make_tetrahedron(&state, site))
            continue;
        int64_t longest = measure(site, square, weight);
        test_require(exact_centre_solve(4, v, &centre));
        mpq_set_si(value, -longest, 100);
        mpq_canonicalize(value);
        if (mpq_cmp(centre.power, value) < 0) {
            clear++;
            clear_yes += cage_tetrahedron_covered(square, weight);
        }
        for (int i = 0; i < 4 && round & 1; i++) {
            weight[i] -= test_between(&state, 0, weight[i] / 8);
            for (int k = 0; k < i; k++)
                square[i][k] = square[k][i] += test_between(&state, 0, square[i][k] / 8);
        }
        if (!cage_tetrahedron_covered(square, weight))
            continue;
        yes++;
        for (int n = 0; n < 20; n++)
            test_require(in_some_ball(&state, site, centre.x, value));
    }
    exact_centre_clear(&centre);
    mpq_clear(value);
    ck_assert_int_gt(yes, rounds / 10);
    ck_assert_int_gt(clear, rounds / 10);
    ck_assert_int_gt(clear_yes, clear - clear / 20);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("barrier");
    TCase *tests = test_case(suite, "barrier");
    tcase_add_loop_test(tests, says_nothing_wrong, 2, 4);
    tcase_add_test(tests, solid_is_solid);
    return test_main(suite);
}
