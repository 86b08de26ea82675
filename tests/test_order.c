/* test_order.c: the order of insertion is a permutation, a function of the balls alone, and keeps neighbours near. */
#include "support.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "ballsets.h"
#include "order.h"

/* Run cage_order in a block of its own, filled with `dirt`; free the result. */
static int32_t *ordered(int32_t dim, const cage_ball *ball, int32_t count, size_t extra, int dirt)
{
    size_t bytes = (size_t)count * 64 + 64 + extra;
    unsigned char *block = test_alloc(bytes);
    int32_t *order = test_alloc((size_t)count * sizeof *order);
    memset(block, dirt, bytes);
    struct cage_arena arena;
    cage_arena_init(&arena, block + extra % 8, bytes - extra % 8);
    (void)cage_arena_take(&arena, 1, 8);
    size_t used = arena.used;
    ck_assert_int_eq(cage_order(&arena, dim, ball, count, order), CAGE_OK);
    ck_assert_uint_eq(arena.used, used);
    free(block);
    return order;
}

static void check_permutation(const int32_t *order, int32_t count)
{
    unsigned char *seen = test_alloc((size_t)count);
    memset(seen, 0, (size_t)count);
    for (int32_t i = 0; i < count; i++) {
        test_require(order[i] >= 0 && order[i] < count && !seen[order[i]]);
        seen[order[i]] = 1;
    }
    free(seen);
}

START_TEST(permutes_every_kind_of_set)
{
    static const int32_t counts[] = {0, 1, 2, 3, 10, 255, 256, 257, 3000};
    for (int32_t dim = 2; dim <= 3; dim++)
        for (int kind = 0; kind < BALLS_KINDS; kind++)
            for (size_t n = 0; n < sizeof counts / sizeof counts[0]; n++) {
                int32_t count = counts[n];
                cage_ball *ball = test_alloc((size_t)count * sizeof *ball);
                balls_make((enum balls_kind)kind, dim, 1, count, ball);
                int32_t *first = ordered(dim, ball, count, 0, 0), *second = ordered(dim, ball, count, 4099, 255);
                check_permutation(first, count);
                ck_assert(memcmp(first, second, (size_t)count * sizeof *first) == 0);
                free(first);
                free(second);
                free(ball);
            }
}
END_TEST

/* Coordinates are not its business: the ends of int32_t are as good as any. */
START_TEST(takes_any_coordinates)
{
    static const int32_t ends[] = {INT32_MIN, INT32_MIN + 1, -1, 0, 1, INT32_MAX - 1, INT32_MAX};
    cage_ball ball[343];
    for (int i = 0; i < 343; i++) {
        const cage_ball b = {ends[i % 7], ends[i / 7 % 7], ends[i / 49], INT32_MAX};
        ball[i] = b;
    }
    for (int32_t dim = 2; dim <= 3; dim++)
        for (int32_t count = 0; count <= 343; count += 7) {
            int32_t *order = ordered(dim, ball, count, 3, 90);
            check_permutation(order, count);
            free(order);
        }
}
END_TEST

START_TEST(takes_coincident_balls)
{
    static cage_ball ball[1000];
    for (int i = 0; i < 1000; i++) {
        const cage_ball b = {-5, 7, 0, i % 3};
        ball[i] = b;
    }
    for (int32_t dim = 2; dim <= 3; dim++) {
        int32_t *order = ordered(dim, ball, 1000, 0, 1);
        check_permutation(order, 1000);
        free(order);
    }
}
END_TEST

/* Too small a block: the error, nothing taken, and the size named gets further. */
START_TEST(memory_sweep)
{
    cage_ball ball[20];
    int32_t order[20], right[20];
    balls_make(BALLS_RANDOM, 3, 5, 20, ball);
    int32_t *reference = ordered(3, ball, 20, 0, 0);
    memcpy(right, reference, sizeof right);
    free(reference);
    bool enough = false;
    for (size_t bytes = 0; bytes < 20 * 32; bytes++) {
        unsigned char *block = test_alloc(bytes);
        struct cage_arena arena;
        cage_arena_init(&arena, block, bytes);
        if (bytes >= 8)
            (void)cage_arena_take(&arena, 1, 8);
        size_t used = arena.used;
        int32_t got = cage_order(&arena, 3, ball, 20, order);
        ck_assert(got == CAGE_OK || (got == CAGE_ERROR_MEMORY && !enough));
        ck_assert_uint_eq(arena.used, used);
        if (got == CAGE_OK) {
            ck_assert_mem_eq(order, right, sizeof right);
            enough = true;
        } else {
            ck_assert_uint_gt(arena.needed, bytes);
        }
        free(block);
    }
    ck_assert(enough);
}
END_TEST

static double step(const cage_ball *a, const cage_ball *b)
{
    double x = (double)a->x - b->x, y = (double)a->y - b->y, z = (double)a->z - b->z;
    x = x < 0 ? -x : x;
    y = y < 0 ? -y : y;
    z = z < 0 ? -z : z;
    return x > y ? (x > z ? x : z) : y > z ? y : z;
}

/* What it is for: the way from ball to ball is far shorter than in the order of input. */
START_TEST(keeps_neighbours_near)
{
    enum { COUNT = 20000 };
    static cage_ball ball[COUNT];
    for (int32_t dim = 2; dim <= 3; dim++) {
        balls_make(BALLS_RANDOM, dim, 9, COUNT, ball);
        int32_t *order = ordered(dim, ball, COUNT, 0, 0);
        double before = 0, after = 0;
        for (int i = 1; i < COUNT; i++) {
            before += step(&ball[i - 1], &ball[i]);
            after += step(&ball[order[i - 1]], &ball[order[i]]);
        }
        ck_assert_double_lt(after, before / 5);
        free(order);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("order");
    TCase *tests = test_case(suite, "order");
    tcase_add_test(tests, permutes_every_kind_of_set);
    tcase_add_test(tests, takes_any_coordinates);
    tcase_add_test(tests, takes_coincident_balls);
    tcase_add_test(tests, memory_sweep);
    tcase_add_test(tests, keeps_neighbours_near);
    return test_main(suite);
}
