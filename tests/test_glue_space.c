/* test_glue_space.c: gluing of slices in space, and of hard ones in the plane, against the mixture of all balls of both. */
#include "support.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "glued.h"
#include "pockets.h"

enum { ARENA = 8 << 20, POINTS = 300 };

static struct {
    unsigned char *block;
    struct cage_arena arena;
    struct pockets p;
    struct cage_side side;
    struct glued c, d;
} world;

typedef void maker(int32_t dim, uint64_t seed, struct pockets *out);

/* small: without shortcuts. */
static void world_make(maker *make, int32_t dim, uint64_t seed, bool small)
{
    world.block = test_alloc(ARENA);
    memset(world.block, 0x5a, ARENA);
    cage_arena_init(&world.arena, world.block, ARENA);
    make(dim, seed, &world.p);
    pockets_side(&world.arena, &world.p, &world.side);
    world.side.shortcuts = small ? NULL : world.side.shortcuts;
    glued_make(&world.arena, &world.side, &world.p.at[0], &world.c);
    glued_make(&world.arena, &world.side, &world.p.at[1], &world.d);
}

static void world_free(void)
{
    glued_free(&world.c);
    glued_free(&world.d);
    free(world.block);
}

/* The points that a slice promises are where they should be. */
static void check_regions(const struct glued *g)
{
    int32_t hint = 0;
    for (int32_t k = 0; k < g->slice.regions; k++)
        if (g->slice.region[k].known) {
            test_require(cage_slice_locate(&g->slice, g->slice.region[k].point) == k);
            test_require(glued_locate(g, g->slice.region[k].point, &hint) == k);
        }
}

/* Random points of the box of all centres: both slices know them, and where one is off all balls, its pair was found. */
static int32_t check_points(uint64_t seed, const struct whole *mixture, const struct cage_touch *touch, int32_t count)
{
    int32_t low[3] = {0, 0, 0}, high[3] = {0, 0, 0}, free_points = 0, at_c = 0, at_d = 0;
    uint64_t state = seed;
    for (int32_t i = 0; i < mixture->count; i++) {
        const int32_t x[3] = {mixture->ball[i].x, mixture->ball[i].y, mixture->ball[i].z};
        for (int k = 0; k < 3; k++) {
            low[k] = x[k] < low[k] ? x[k] : low[k];
            high[k] = x[k] > high[k] ? x[k] : high[k];
        }
    }
    for (int32_t n = 0; n < POINTS; n++) {
        int32_t x[3];
        for (int k = 0; k < 3; k++)
            x[k] = (int32_t)test_between(&state, low[k], high[k]);
        int32_t k = glued_locate(&world.c, x, &at_c), l = glued_locate(&world.d, x, &at_d);
        test_require(cage_slice_locate(&world.c.slice, x) == k && cage_slice_locate(&world.d.slice, x) == l);
        test_require(k < 0 || l < 0 || glued_has(touch, count, k, l));
        free_points += k >= 0 && l >= 0;
    }
    return free_points;
}

/* The points that come with the pairs are in both, or a mixture was needed. */
static void check_touches(const struct cage_touch *touch, int32_t count, bool transposed, int32_t mixed)
{
    int32_t at_c = 0, at_d = 0;
    for (int32_t i = 0; i < count; i++) {
        int32_t k = glued_locate(&world.c, touch[i].x, &at_c), l = glued_locate(&world.d, touch[i].x, &at_d);
        test_require(mixed || (k == (transposed ? touch[i].l : touch[i].k) && l == (transposed ? touch[i].k : touch[i].l)));
    }
}

/* One component of the mixture, located by looking at every simplex and every ball. */
static void check_by_force(uint64_t seed, const struct whole *mixture, const struct cage_touch *touch, int32_t count)
{
    uint64_t state = seed;
    struct exact_centre centre;
    const struct cage_site *v[4];
    if (mixture->c.count < 2)
        return;
    exact_centre_init(&centre);
    cage_simplex_sites(&mixture->t, mixture->c.deep[test_between(&state, 1, mixture->c.count - 1)], v);
    test_require(exact_centre_solve(mixture->t.dim + 1, v, &centre));
    int32_t k = whole_label_exact(&world.c.whole.t, world.c.whole.c.label, centre.x);
    int32_t l = whole_label_exact(&world.d.whole.t, world.d.whole.c.label, centre.x);
    test_require(k >= 0 && l >= 0 && glued_has(touch, count, world.c.name[k], world.d.name[l]));
    exact_centre_clear(&centre);
}

/* Every gluing of so many worlds, against the truth. Expected of them: `mixtures` in a hundred, `several` pairs too. */
static void glue_all(maker *make, int32_t dim, bool small, int32_t rounds, int32_t expect_mixtures, int32_t expect_several)
{
    static bool wanted[GLUED_MOST][GLUED_MOST];
    int32_t mixtures = 0, pairs = 0, seeded = 0, several = 0, components = 0, points = 0;
    for (int32_t seed = 0; seed < rounds; seed++) {
        int32_t count, others, mixed, mixed_back;
        struct whole mixture;
        struct cage_touch *touch, *other;
        world_make(make, dim, (uint64_t)seed, small);
        whole_mix(&world.c.whole, &world.d.whole, &mixture);
        check_regions(&world.c);
        check_regions(&world.d);
        ck_assert_int_eq(cage_glue(&world.arena, &world.c.slice, &world.d.slice, CAGE_ALL, &touch, &count, &mixed), CAGE_OK);
        ck_assert_int_eq(cage_glue(&world.arena, &world.d.slice, &world.c.slice, CAGE_ALL, &other, &others, &mixed_back),
                         CAGE_OK);
        glued_check(touch, count, wanted, glued_pairs(&world.c, &world.d, &mixture, wanted));
        ck_assert_int_eq(count, others);
        for (int32_t i = 0; i < count; i++)
            test_require(glued_has(other, others, touch[i].l, touch[i].k));
        check_touches(touch, count, false, mixed);
        check_touches(other, others, true, mixed_back);
        if (seed % 4 == 0)
            check_by_force((uint64_t)seed, &mixture, touch, count);
        points += check_points((uint64_t)seed, &mixture, touch, count);
        seeded += glued_check_seeds(&world.arena, &world.c.slice, &world.d.slice, touch, count);
        seeded += glued_check_seeds(&world.arena, &world.d.slice, &world.c.slice, other, others);
        mixtures += mixed + mixed_back;
        components += world.c.slice.regions + world.d.slice.regions;
        pairs += count;
        several += count > 1;
        whole_free(&mixture);
        world_free();
    }
    printf("glue: dim %d: %d gluings of %d components, %d pairs, %d of them more than one, %d by a mixture, %d pairs by seeds, "
           "%d points\n",
           dim, (int)(2 * rounds), (int)components, (int)pairs, (int)several, (int)mixtures, (int)seeded, (int)points);
    ck_assert(several * 100 >= rounds * expect_several && mixtures * 100 >= rounds * expect_mixtures);
}

START_TEST(glues_what_touches)
{
    glue_all(pockets_make, 2 + _i % 2, _i > 1, test_rounds(_i % 2 == 0 ? 1000 : 500) / (1 + _i / 2), 5, 10);
}
END_TEST

START_TEST(glues_where_balls_vanish)
{
    glue_all(pockets_vanish, 2 + _i % 2, _i > 1, test_rounds(1500) / (1 + _i / 2), 2, 5);
}
END_TEST

/* The same pairs, or not enough memory and nothing taken: of all components, and of one. */
START_TEST(memory_sweep)
{
    struct cage_touch *touch, *again;
    int32_t count, mixed, counted, enough = 0;
    world_make(pockets_make, 2 + _i % 2, 100 + (uint64_t)_i, _i % 4 > 1);
    int32_t seed = _i % 3 == 0 ? CAGE_ALL : _i % 5 % world.c.slice.regions;
    ck_assert_int_eq(cage_glue(&world.arena, &world.c.slice, &world.d.slice, seed, &touch, &count, &mixed), CAGE_OK);
    size_t most = 65536 + 8192 * (size_t)(world.c.slice.t.sites + world.d.slice.t.sites);
    unsigned char *block = test_alloc(most + 64);
    for (size_t bytes = 0; bytes < most && enough < 3; bytes += bytes / 32 + 8) {
        struct cage_arena arena;
        memset(block, 0xa7, most + 64);
        cage_arena_init(&arena, block, bytes);
        int32_t error = cage_glue(&arena, &world.c.slice, &world.d.slice, seed, &again, &counted, &mixed);
        test_require(error == CAGE_OK || (error == CAGE_ERROR_MEMORY && enough == 0 && arena.used == 0));
        for (int i = 0; i < 64; i++)
            test_require(block[bytes + (size_t)i] == 0xa7);
        if (error != CAGE_OK)
            continue;
        enough++;
        test_require(counted == count && memcmp(again, touch, (size_t)count * sizeof *touch) == 0);
    }
    ck_assert_int_eq(enough, 3);
    free(block);
    world_free();
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("glue in space");
    TCase *tests = test_case(suite, "glue in space");
    tcase_add_loop_test(tests, glues_what_touches, 0, 4); /* the last two without shortcuts */
    tcase_add_loop_test(tests, glues_where_balls_vanish, 0, 4);
    tcase_add_loop_test(tests, memory_sweep, 0, 30);
    return test_main(suite);
}
