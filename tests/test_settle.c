/* test_settle.c: gluing where a mixture of few balls has free points in a component that a ball left out of it covers.
 *
 * In one slice a corridor runs between two large balls; in the other three balls cover it, one after the other, and what
 * lies beyond meets the corridor's pieces in the notch between the last two only. */
#include "support.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "glued.h"

enum { ARENA = 8 << 20, OBSTACLES = 64, FAR = 2000000 };

struct corridor {
    cage_ball obstacle[OBSTACLES];
    int32_t count;
};

/* A ball of the slice at 0 degrees (which 1) or 180 (-1), each coordinate off by up to the jitter. */
static void put(struct corridor *s, uint64_t *state, int32_t which, int32_t x, int32_t y, int32_t r, int32_t jitter)
{
    cage_ball *ball = &s->obstacle[s->count++];
    test_require(s->count <= OBSTACLES);
    ball->x = which * FAR + x + (int32_t)test_between(state, -jitter, jitter);
    ball->y = y + (int32_t)test_between(state, -jitter, jitter);
    ball->r = r + (r > 0 ? (int32_t)test_between(state, -jitter, jitter) : 0);
}

static void make_corridor(uint64_t seed, struct corridor *s)
{
    uint64_t state = seed;
    int32_t jitter = (int32_t)test_between(&state, 0, 3000), middle = (int32_t)test_between(&state, 56000, 66000);
    memset(s, 0, sizeof *s);
    for (int32_t up = -1; up <= 1; up += 2)
        put(s, &state, 1, middle, up * 205000, 200000, jitter / 10);
    put(s, &state, 1, -60000, 0, 60000, jitter);
    put(s, &state, 1, 200000, 0, 50000, jitter);
    for (int32_t i = 0; i < 15; i++)
        put(s, &state, 1, 5000 + 10000 * i, 0, 0, jitter);
    put(s, &state, -1, 20000, -3000, 70000, jitter);
    put(s, &state, -1, 95000, 0, 35000, jitter);
    put(s, &state, -1, 150000, 0, 40000, jitter);
    for (int32_t up = -1; up <= 1; up += 2) {
        put(s, &state, -1, 92000, up * 45000, 0, 0);
        put(s, &state, -1, 100000, up * 200000, 0, 0);
        for (int32_t x = -80000; x < 80000; x += 20000)
            put(s, &state, -1, x, up * 98000, 0, 0);
    }
    put(s, &state, -1, -80000, 0, 0, 0);
    put(s, &state, -1, 220000, 0, 0, 0);
}

START_TEST(no_witness_is_covered)
{
    static bool wanted[GLUED_MOST][GLUED_MOST];
    static const struct cage_rotations AT[2] = {{{1, 0, 0, 0}, 0}, {{0, 0, 0, 1}, 0}};
    static const cage_ball OBJECT = {FAR, 0, 0, 0};
    static const int32_t PIVOT[3] = {0, 0, 0};
    int32_t rounds = test_rounds(_i == 0 ? 400 : 200), mixtures = 0;
    void *block = test_alloc(ARENA);
    for (int32_t seed = 0; seed < rounds; seed++) {
        struct corridor s;
        struct cage_arena arena;
        struct cage_side side;
        struct glued c, d;
        struct whole mixture;
        make_corridor((uint64_t)seed, &s);
        const cage_scene scene = {{&OBJECT, &OBJECT, 1, 1}, {s.obstacle, s.obstacle, s.count, s.count}, 2};
        test_require(cage_scene_check(&scene) == CAGE_OK);
        cage_arena_init(&arena, block, ARENA);
        test_require(cage_side_make(&arena, &scene, PIVOT, 1, _i == 0 ? &cage_all_shortcuts : NULL, &side) == CAGE_OK);
        glued_make(&arena, &side, &AT[0], &c);
        glued_make(&arena, &side, &AT[1], &d);
        whole_mix(&c.whole, &d.whole, &mixture);
        int32_t pairs = glued_pairs(&c, &d, &mixture, wanted), count, mixed;
        struct cage_touch *touch;
        test_require(cage_glue(&arena, &c.slice, &d.slice, CAGE_ALL, &touch, &count, &mixed) == CAGE_OK);
        glued_check(touch, count, wanted, pairs);
        mixtures += mixed;
        whole_free(&mixture);
        glued_free(&c);
        glued_free(&d);
    }
    free(block);
    ck_assert_int_gt(mixtures, rounds / 4);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("settle");
    TCase *tests = test_case(suite, "settle");
    tcase_add_loop_test(tests, no_witness_is_covered, 0, 2); /* the second without shortcuts */
    return test_main(suite);
}
