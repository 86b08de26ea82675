/* test_margin.c: margins of scenes whose answer changes at a known size, asked again on both sides, near every limit. */
#include "support.h"

#include <stdlib.h>
#include <string.h>

#include "cage.h"

#define ROOM ((size_t)64 << 20)

static unsigned char *block;

static void block_make(void) { block = test_alloc(ROOM); }

static void block_drop(void) { free(block); }

static int32_t prove(const cage_scene *view, const cage_pose *start, const cage_pose *goal)
{
    cage_proof *proof;
    int32_t error = cage_prove_begin(&proof, view, start, goal, NULL, block, ROOM);
    if (error == CAGE_OK)
        error = cage_prove_run(proof, INT64_MAX);
    return error < 0 ? error : cage_prove_result(proof)->verdict;
}

/* A disc among four at that distance, at one place of the grid: two neighbours are sqrt 2 away apart, and it gets through when
 * that is at least twice the sum of the radii. */
struct fingers {
    cage_ball disc, finger[4];
    cage_scene view;
    cage_pose start;
};

static void make(int32_t x, int32_t away, int32_t disc, int32_t finger, struct fingers *out)
{
    static const int32_t side[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    memset(out, 0, sizeof *out);
    out->disc.r = disc;
    for (int32_t i = 0; i < 4; i++) {
        const cage_ball made = {x + away * side[i][0], away * side[i][1], 0, finger};
        out->finger[i] = made;
    }
    const cage_shape object = {&out->disc, &out->disc, 1, 1}, obstacles = {out->finger, out->finger, 4, 4};
    out->view.object = object;
    out->view.obstacles = obstacles;
    out->view.dim = 2;
    out->start.x[0] = x;
    out->start.q[0] = 1;
}

/* 2 (disc + finger - 2 by) = sqrt 2 away, but for what rounding takes on either side: 2 of the sum inside, 8 outside. */
static void expect_change(const cage_margin *m, int32_t away, int32_t sum)
{
    double by = (sum - away * 0.70710678118654752) / 2;
    ck_assert_int_eq(m->bounded, 1);
    ck_assert_int_lt(m->closed, m->open);
    ck_assert_msg(m->closed <= by + 1 && m->closed >= by - 3 && m->open >= by - 1 && m->open <= by + 6, "%d to %d, not about %g",
                  (int)m->closed, (int)m->open, by);
}

START_TEST(four_fingers)
{
    struct fingers f;
    cage_margin m;
    for (int32_t i = 0; i < 6; i++) { /* from caged by a lot to free by a lot */
        int32_t away = 50000 + 14000 * i;
        make(1234 * i, away, 20000, 30000, &f);
        ck_assert_int_eq(cage_margin_find(&f.view, &f.start, NULL, NULL, 24, block, ROOM, &m), CAGE_OK);
        expect_change(&m, away, 50000);
        const cage_pose out = {{500000, 1, 0}, {1, 0, 0, 0}};
        ck_assert_int_eq(cage_margin_find(&f.view, &f.start, &out, NULL, 24, block, ROOM, &m), CAGE_OK);
        expect_change(&m, away, 50000);
        ck_assert(m.known == 1 && m.pivot[0] == 0 && m.pivot[1] == 0);
        double dx = m.narrow.x[0] - 1234 * i, dy = m.narrow.x[1], far = dx * dx + dy * dy; /* between two fingers */
        ck_assert_msg(far > 0.16 * away * away && far < 1.2 * away * away, "%g, %g for %d (%d to %d)", dx, dy,
                      (int)away, (int)m.closed, (int)m.open);
    }
}
END_TEST

/* Near the end of the grid balls may grow by less than the next power of two: up to there it is asked all the same. */
START_TEST(as_far_as_the_grid_allows)
{
    struct fingers f;
    cage_margin m;
    const int32_t away = 320000, far = CAGE_REACH_2D - away - 100000 - 100000 - 16;
    for (int32_t room = 12000; room <= 16000; room += 1000) { /* 2 units of reach for one grown; closed from about 13137 on */
        make(far - 2 * room, away, 100000, 100000, &f);
        ck_assert_int_eq(cage_margin_find(&f.view, &f.start, NULL, NULL, 24, block, ROOM, &m), CAGE_OK);
        if (room > 13137) {
            expect_change(&m, away, 200000);
            continue;
        }
        ck_assert_msg(m.bounded == 0 && m.open == -room, "%d: %d to %d", (int)room, (int)m.closed, (int)m.open);
    }
}
END_TEST

/* A ball that shrinks away moves the pivot, and a goal at the end of the grid beyond it: that size is not decided, the others
 * are. */
START_TEST(a_pivot_that_moves)
{
    enum { POSTS = 64 };
    const cage_ball part[2] = {{1000, 0, 0, 100}, {0, 0, 0, 1}};
    cage_ball post[POSTS];
    for (int32_t i = 0; i < POSTS; i++) { /* a square of posts 400 apart: closed, open when they are gone */
        int32_t along = 400 * (i % 16) - 3200, other = i / 16 % 2 ? 3200 : -3200;
        const cage_ball made = {i < 32 ? along : other, i < 32 ? other : along + 400, 0, 200};
        post[i] = made;
    }
    const cage_scene view = {{part, part, 2, 2}, {post, post, POSTS, POSTS}, 2};
    const cage_pose start = {{0, 0, 0}, {1, 0, 0, 0}}, goal = {{CAGE_REACH_2D - 600, 0, 0}, {1, 0, 0, 0}};
    cage_margin m;
    ck_assert_int_eq(prove(&view, &start, &goal), CAGE_DISCONNECTED);
    ck_assert_int_eq(cage_margin_find(&view, &start, &goal, NULL, 12, block, ROOM, &m), CAGE_OK);
    ck_assert(m.bounded == 1 && m.closed >= 0 && m.closed < m.open);
}
END_TEST

START_TEST(edges)
{
    struct fingers f;
    cage_margin m, before;
    make(0, 60000, 20000, 30000, &f);
    memset(&before, 0x5a, sizeof before);
    m = before;
    ck_assert_int_eq(cage_margin_find(&f.view, &f.start, NULL, NULL, 5, block, 1000, &m), CAGE_ERROR_MEMORY);
    ck_assert_int_eq(cage_margin_find(&f.view, &f.start, NULL, NULL, -1, block, ROOM, &m), CAGE_ERROR_ARGUMENT);
    ck_assert_int_eq(cage_margin_find(NULL, &f.start, NULL, NULL, 5, block, ROOM, &m), CAGE_ERROR_ARGUMENT);
    ck_assert(memcmp(&m, &before, sizeof m) == 0);
    ck_assert_int_eq(cage_margin_find(&f.view, &f.start, NULL, NULL, 0, block, ROOM, &m), CAGE_OK); /* no bisection */
    ck_assert(m.bounded == 1 && m.closed == 0 && m.open == 20001);
    f.start.x[0] = 60000; /* within a finger: closed until one of the two is gone, or nearly */
    ck_assert_int_eq(prove(&f.view, &f.start, NULL), CAGE_IN_COLLISION);
    ck_assert_int_eq(cage_margin_find(&f.view, &f.start, NULL, NULL, 30, block, ROOM, &m), CAGE_OK);
    ck_assert(m.bounded == 1 && m.closed >= 20000 && m.closed < m.open && m.open == 20001);
    const cage_scene empty = {{&f.disc, &f.disc, 1, 1}, {NULL, NULL, 0, 0}, 2}; /* never closed */
    ck_assert_int_eq(cage_margin_find(&empty, &f.start, NULL, NULL, 3, block, ROOM, &m), CAGE_OK);
    ck_assert_int_eq(m.bounded, 0);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("margin");
    TCase *tests = test_case(suite, "margin");
    tcase_add_unchecked_fixture(tests, block_make, block_drop);
    tcase_add_test(tests, four_fingers);
    tcase_add_test(tests, as_far_as_the_grid_allows);
    tcase_add_test(tests, a_pivot_that_moves);
    tcase_add_test(tests, edges);
    return test_main(suite);
}
