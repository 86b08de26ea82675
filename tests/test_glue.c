/* test_glue.c: pruned slices and their gluing against slices of all balls, their mixture and a dense grid of points. */
#include "support.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "flood.h"
#include "fibre.h"
#include "glued.h"
#include "scenes.h"

enum { ARENA = 8 << 20 };

static struct {
    unsigned char *block;
    struct cage_arena arena;
    scene s;
    cage_scene view;
    struct cage_side side;
} world;

/* Few units wide, so that many components are thinner than the grid. */
static void make_tiny(uint64_t seed, scene *out)
{
    uint64_t state = seed;
    int32_t wide = (int32_t)test_between(&state, 30, 300);
    memset(out, 0, sizeof *out);
    out->obstacle_count = (int32_t)test_between(&state, 8, SCENE_OBSTACLES);
    out->object_count = (int32_t)test_between(&state, 1, SCENE_OBJECT / 2);
    for (int32_t j = 0; j < out->obstacle_count; j++) {
        out->obstacles[j].x = (int32_t)test_between(&state, -wide, wide);
        out->obstacles[j].y = (int32_t)test_between(&state, -wide, wide);
        out->obstacles[j].r = (int32_t)test_between(&state, wide / 30, wide / 5);
    }
    for (int32_t a = 0; a < out->object_count; a++) {
        out->object[a].x = (int32_t)test_between(&state, -wide / 8, wide / 8);
        out->object[a].y = (int32_t)test_between(&state, -wide / 8, wide / 8);
        out->object[a].r = (int32_t)test_between(&state, 0, wide / 30);
    }
}

/* small: without shortcuts. */
static void world_make(uint64_t seed, int32_t sign, bool small)
{
    int32_t pivot[3];
    world.block = test_alloc(ARENA);
    memset(world.block, 0x5a, ARENA);
    cage_arena_init(&world.arena, world.block, ARENA);
    if (seed % 5 < 3)
        make_tiny(seed, &world.s);
    else
        scene_random(seed / 5, &world.s);
    world.view = scene_view(&world.s);
    cage_pivot(&world.view.object, pivot);
    const struct cage_shortcuts *shortcuts = small ? NULL : &cage_all_shortcuts;
    ck_assert_int_eq(cage_side_make(&world.arena, &world.view, pivot, sign, shortcuts, &world.side), CAGE_OK);
}

/* The points that a slice promises, and many others, are where they should be. */
static void check_slice(const struct glued *p, const struct flood *grid)
{
    int32_t hint = 0;
    for (int32_t k = 0; k < p->slice.regions; k++)
        if (p->slice.region[k].known) {
            test_require(cage_slice_locate(&p->slice, p->slice.region[k].point) == k);
            test_require(glued_locate(p, p->slice.region[k].point, &hint) == k);
        }
    for (int32_t cell = 0; cell < grid->cells; cell++) {
        int32_t x[3];
        flood_centre(grid, cell, x);
        test_require(cage_slice_locate(&p->slice, x) == glued_locate(p, x, &hint));
    }
}

/* Cell number `index` of the circle at its level, then `deeper` times its first (which 0) or last child. */
static struct cage_cell cell_at(int32_t level, int32_t index, int32_t deeper, int32_t which)
{
    int32_t around = 2 << level;
    index = (index % around + around) % around;
    struct cage_cell cell = {level, index >> level, {index & ((1 << level) - 1), 0, 0}};
    for (; deeper > 0; deeper--)
        cage_cell_child(&cell, which, &cell);
    return cell;
}

static void rotations_of(const struct cage_cell *cell, struct cage_rotations *out)
{
    cage_so2.representative(cell, out->q);
    out->turn = cage_so2.turn(cell);
}

/* Neighbours of equal or different levels, a single rotation and a cell that holds it, or any two. */
static void choose(uint64_t *state, struct cage_rotations *c, struct cage_rotations *d)
{
    int32_t level = (int32_t)test_between(state, 1, 9), index = (int32_t)test_between(state, 0, (2 << level) - 1);
    int32_t deeper = (int32_t)test_between(state, 0, 3), kind = (int32_t)test_between(state, 0, 3);
    struct cage_cell a = cell_at(level, index, 0, 0), b = cell_at(level, index + 1, deeper, 0);
    if (kind == 0)
        b = cell_at(level, index - 1, deeper, 1);
    if (kind == 1)
        b = cell_at((int32_t)test_between(state, 1, 9), (int32_t)test_between(state, 0, 1 << 20), 0, 0);
    rotations_of(&a, c);
    rotations_of(&b, d);
    if (kind == 2)
        *d = *c;
    if (kind == 2)
        d->turn = 0;
}

/* Every point off all balls is in a pair that was found. */
static void check_points(const struct glued *c, const struct glued *d, const struct flood *grid, const struct cage_touch *touch,
                         int32_t count)
{
    int32_t at_c = 0, at_d = 0;
    for (int32_t cell = 0; cell < grid->cells; cell++) {
        int32_t x[3];
        flood_centre(grid, cell, x);
        int32_t k = glued_locate(c, x, &at_c), l = glued_locate(d, x, &at_d);
        test_require(k < 0 || l < 0 || glued_has(touch, count, k, l));
    }
}

static int32_t check_touches(const struct glued *c, const struct glued *d, const struct cage_touch *touch, int32_t count,
                             int32_t mixed)
{
    int32_t thin = 0, at_c = 0, at_d = 0;
    for (int32_t i = 0; i < count; i++) {
        int32_t k = glued_locate(c, touch[i].x, &at_c), l = glued_locate(d, touch[i].x, &at_d);
        bool both = k == touch[i].k && l == touch[i].l;
        test_require(both || mixed);
        thin += !both;
    }
    return thin;
}

static void check_transposed(const struct cage_touch *touch, int32_t count, const struct cage_touch *other, int32_t others)
{
    ck_assert_int_eq(count, others);
    for (int32_t i = 0; i < count; i++)
        test_require(glued_has(other, others, touch[i].l, touch[i].k));
}

/* Rows and columns of cells enough, whatever the scene's size; the fill itself is not needed. */
static int32_t pitch_of(const struct whole *w, int32_t across)
{
    int64_t low = 0, high = 0;
    for (int32_t i = 0; i < w->count; i++) {
        int64_t least = w->ball[i].x < w->ball[i].y ? w->ball[i].x : w->ball[i].y;
        int64_t most = w->ball[i].x > w->ball[i].y ? w->ball[i].x : w->ball[i].y;
        low = least - w->ball[i].r < low ? least - w->ball[i].r : low;
        high = most + w->ball[i].r > high ? most + w->ball[i].r : high;
    }
    return (int32_t)((high - low) / across / 16 + 1) * 16;
}

START_TEST(glues_what_touches)
{
    static bool wanted[GLUED_MOST][GLUED_MOST];
    int32_t rounds = test_rounds(_i == 0 ? 500 : 300), mixtures = 0, pairs = 0, thin = 0, several = 0, seeded = 0, less = 0;
    for (int32_t seed = 0; seed < rounds; seed++) {
        int32_t sign = seed & 1 ? 1 : -1, count, others, mixed, mixed_back;
        uint64_t state = (uint64_t)seed;
        struct cage_rotations at[2];
        struct glued c, d;
        struct whole mixture;
        struct flood grid;
        struct cage_touch *touch, *other;
        world_make((uint64_t)seed, sign, _i == 1);
        choose(&state, &at[0], &at[1]);
        glued_make(&world.arena, &world.side, &at[0], &c);
        glued_make(&world.arena, &world.side, &at[1], &d);
        whole_mix(&c.whole, &d.whole, &mixture);
        flood_make(&grid, 2, mixture.ball, mixture.count, pitch_of(&mixture, 32));
        check_slice(&c, &grid);
        check_slice(&d, &grid);
        ck_assert_int_eq(cage_glue(&world.arena, &c.slice, &d.slice, CAGE_ALL, &touch, &count, &mixed), CAGE_OK);
        ck_assert_int_eq(cage_glue(&world.arena, &d.slice, &c.slice, CAGE_ALL, &other, &others, &mixed_back), CAGE_OK);
        glued_check(touch, count, wanted, glued_pairs(&c, &d, &mixture, wanted));
        seeded += glued_check_seeds(&world.arena, &c.slice, &d.slice, touch, count);
        seeded += glued_check_seeds(&world.arena, &d.slice, &c.slice, other, others);
        check_points(&c, &d, &grid, touch, count);
        thin += check_touches(&c, &d, touch, count, mixed) + check_touches(&d, &c, other, others, mixed_back);
        check_transposed(touch, count, other, others);
        mixtures += mixed + mixed_back;
        pairs += count;
        several += count > 1;
        less += !c.slice.whole + !d.slice.whole;
        flood_free(&grid);
        whole_free(&mixture);
        glued_free(&c);
        glued_free(&d);
        free(world.block);
    }
    printf("glue: %d gluings, %d pairs, %d of them more than one, %d by a mixture, %d points of components thinner than the "
           "grid, %d pairs by seeds; balls left out of %d of %d slices\n",
           (int)(2 * rounds), (int)pairs, (int)several, (int)mixtures, (int)thin, (int)seeded, (int)less, (int)(2 * rounds));
    ck_assert(several > rounds / 10 && less > rounds / 10);
}
END_TEST

/* The same pairs, or not enough memory and nothing taken. */
START_TEST(memory_sweep)
{
    struct cage_rotations at[2];
    struct glued p[2];
    struct cage_touch *touch, *again;
    int32_t count, mixed, counted, enough = 0;
    uint64_t state = 3;
    world_make(7 + (uint64_t)_i, -1, _i % 2);
    choose(&state, &at[0], &at[1]);
    glued_make(&world.arena, &world.side, &at[0], &p[0]);
    glued_make(&world.arena, &world.side, &at[1], &p[1]);
    ck_assert_int_eq(cage_glue(&world.arena, &p[0].slice, &p[1].slice, CAGE_ALL, &touch, &count, &mixed), CAGE_OK);
    size_t most = 4096 * (size_t)(p[0].slice.t.sites + p[1].slice.t.sites);
    void *block = test_alloc(most);
    for (size_t bytes = 0; bytes < most && enough < 3; bytes += bytes / 16 + 8) {
        struct cage_arena arena;
        cage_arena_init(&arena, block, bytes);
        int32_t error = cage_glue(&arena, &p[0].slice, &p[1].slice, CAGE_ALL, &again, &counted, &mixed);
        test_require(error == CAGE_OK || (error == CAGE_ERROR_MEMORY && enough == 0 && arena.used == 0));
        if (error != CAGE_OK)
            continue;
        enough++;
        test_require(counted == count && memcmp(again, touch, (size_t)count * sizeof *touch) == 0);
    }
    ck_assert_int_eq(enough, 3);
    free(block);
    glued_free(&p[0]);
    glued_free(&p[1]);
    free(world.block);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("glue");
    TCase *tests = test_case(suite, "glue");
    tcase_add_loop_test(tests, glues_what_touches, 0, 2);
    tcase_add_loop_test(tests, memory_sweep, 0, 9);
    return test_main(suite);
}
