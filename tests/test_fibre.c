/* test_fibre.c: cells of the plane's rotations: they tile the circle, know their neighbours and bound what they move. */
#include "support.h"

#include <math.h>
#include <stdlib.h>

#include "arcs.h"
#include "grid.h"

enum { MOST = 512 };

static const struct cage_fibre *const fibre = &cage_so2;

/* Start from the roots and replace random cells by their children; how many cells there are. */
static int32_t refine(uint64_t *state, int32_t cells, struct cage_cell *cell)
{
    int32_t count = 0, focus = (int32_t)test_between(state, 0, 2);
    for (int32_t face = 0; face < fibre->roots; face++) {
        const struct cage_cell root = {0, face, {0, 0, 0}};
        cell[count++] = root;
    }
    for (int32_t tries = 0; count + fibre->children <= cells && tries < 10 * cells; tries++) {
        /* the last cells are the latest: a focus on them goes deep */
        int32_t i = (int32_t)test_between(state, focus ? (count - 1) / 2 * (focus - 1) : count - 1, count - 1);
        struct cage_cell parent = cell[i];
        if (parent.level == fibre->max_level)
            continue;
        cage_cell_child(&parent, 0, &cell[i]);
        for (int32_t k = 1; k < fibre->children; k++)
            cage_cell_child(&parent, k, &cell[count++]);
    }
    return count;
}

static struct cage_cell any_cell(uint64_t *state)
{
    int32_t level = (int32_t)test_between(state, 0, fibre->max_level);
    struct cage_cell cell = {level, (int32_t)test_between(state, 0, 1), {0, 0, 0}};
    cell.at[0] = (int32_t)test_between(state, 0, (1 << level) - 1);
    if (random_next(state) & 1) /* next to the seams of the faces and to their middle */
        cell.at[0] = (int32_t)((int64_t)(test_between(state, 0, 4) * ((1 << level) - 1)) / 4);
    return cell;
}

static void any_rotation(uint64_t *state, int32_t q[4])
{
    q[1] = q[2] = 0;
    do {
        q[0] = (int32_t)test_spread(state, 1 << 30);
        q[3] = (int32_t)test_spread(state, 1 << 30);
    } while (q[0] == 0 && q[3] == 0);
}

/* A rotation in the cell, near either end at times; entries below 2^30. */
static void rotation_within(uint64_t *state, const struct cage_cell *cell, int32_t q[4])
{
    struct arc_rotation a = arc_end(cell, 0), b = arc_end(cell, 1);
    if (a.w * b.w + a.z * b.z < 0 || cell->level == 0) /* 90 degrees apart at most */
        test_require(a.w * b.w + a.z * b.z >= 0);
    int64_t n = test_between(state, 0, 1 << 20), of = 1 << 20;
    n = random_next(state) & 1 ? n : test_between(state, 0, 1) * of;
    q[0] = (int32_t)((a.w * (of - n) + b.w * n) / of);
    q[3] = (int32_t)((a.z * (of - n) + b.z * n) / of);
    q[1] = q[2] = 0;
}

static struct arc_rotation arc_of(const int32_t q[4])
{
    struct arc_rotation r = {q[0], q[3]};
    return r;
}

static void check_contains(const struct cage_cell *cell, const int32_t q[4])
{
    const int32_t minus[4] = {-q[0], 0, 0, -q[3]};
    bool in = arc_holds(cell, arc_of(q));
    test_require(fibre->contains(cell, q) == in);
    test_require(fibre->contains(cell, minus) == in);
}

/* Every rotation is in one cell, or it is the end that two of them share. */
START_TEST(tiles_the_circle)
{
    int32_t rounds = test_rounds(60), shared = 0;
    uint64_t state = 1;
    for (int32_t round = 0; round < rounds; round++) {
        struct cage_cell cell[MOST];
        int32_t count = refine(&state, (int32_t)test_between(&state, 2, MOST), cell), q[4];
        for (int32_t i = 0; i < 200; i++) {
            any_rotation(&state, q);
            if (i % 4 == 0) {
                struct arc_rotation end = arc_end(&cell[test_between(&state, 0, count - 1)], i & 4 ? 1 : 0);
                q[0] = (int32_t)end.w;
                q[3] = (int32_t)end.z;
            }
            int32_t held = 0, ends = 0;
            for (int32_t k = 0; k < count; k++) {
                check_contains(&cell[k], q);
                held += fibre->contains(&cell[k], q);
                ends += arc_same(arc_end(&cell[k], 0), arc_of(q)) || arc_same(arc_end(&cell[k], 1), arc_of(q));
            }
            test_require((held == 1 && ends == 0) || (held == 2 && ends == 2));
            shared += held == 2;
        }
    }
    ck_assert_int_gt(shared, 0);
}
END_TEST

START_TEST(children_share_out_their_parent)
{
    uint64_t state = 2;
    for (int32_t i = 0; i < 2000; i++) {
        struct cage_cell cell = any_cell(&state), child[2];
        if (cell.level == fibre->max_level)
            continue;
        cage_cell_child(&cell, 0, &child[0]);
        cage_cell_child(&cell, 1, &child[1]);
        test_require(arc_same(arc_end(&cell, 0), arc_end(&child[0], 0)));
        test_require(arc_same(arc_end(&child[0], 1), arc_end(&child[1], 0)));
        test_require(arc_same(arc_end(&child[1], 1), arc_end(&cell, 1)));
        test_require(child[0].level == cell.level + 1 && child[1].level == cell.level + 1);
        test_require(fibre->turn(&child[0]) < fibre->turn(&cell) && fibre->turn(&child[1]) < fibre->turn(&cell));
    }
}
END_TEST

/* touch() is true for the pairs that share a rotation and for no other, whatever their levels and faces. */
START_TEST(knows_its_neighbours)
{
    int32_t rounds = test_rounds(40), touching = 0, across = 0;
    uint64_t state = 3;
    for (int32_t round = 0; round < rounds; round++) {
        struct cage_cell cell[MOST];
        int32_t count = refine(&state, (int32_t)test_between(&state, 4, MOST / 2), cell);
        for (int32_t i = 0; i < count; i++) {
            int32_t neighbours = 0;
            for (int32_t k = 0; k < count; k++) {
                bool touch = arc_touch(&cell[i], &cell[k]);
                test_require(fibre->touch(&cell[i], &cell[k]) == touch);
                if (i == k || !touch)
                    continue;
                int32_t q[4];
                fibre->common(&cell[i], &cell[k], q);
                test_require(arc_holds(&cell[i], arc_of(q)) && arc_holds(&cell[k], arc_of(q)));
                test_require(q[1] == 0 && q[2] == 0);
                neighbours++;
                across += cell[i].face != cell[k].face;
            }
            test_require(neighbours == 2 || count == 2);
            touching += neighbours;
        }
    }
    ck_assert_int_gt(touching, 0);
    ck_assert_int_gt(across, 0);
    for (int32_t i = 0; i < test_rounds(200000); i++) {
        struct cage_cell a = any_cell(&state), b = any_cell(&state);
        test_require(fibre->touch(&a, &b) == arc_touch(&a, &b));
    }
}
END_TEST

/* A unit vector, turned by twice the half angle between a and b, moves by 2 sin of it. */
static long double moved(const int32_t a[4], const int32_t b[4])
{
    long double aw = a[0], az = a[3], bw = b[0], bz = b[3];
    return 2 * fabsl(aw * bz - az * bw) / sqrtl(aw * aw + az * az) / sqrtl(bw * bw + bz * bz);
}

START_TEST(bounds_what_it_moves)
{
    uint64_t state = 4;
    int32_t rounds = test_rounds(3000);
    for (int32_t round = 0; round < rounds; round++) {
        struct cage_cell cell = any_cell(&state);
        int32_t q[4], other[4];
        fibre->representative(&cell, q);
        test_require(arc_holds(&cell, arc_of(q)) && q[1] == 0 && q[2] == 0);
        for (int end = 0; end < 2; end++)
            test_require(!arc_same(arc_end(&cell, end), arc_of(q)));
        long double bound = (long double)fibre->turn(&cell) / 2147483648.0L, most = 0;
        for (int32_t i = 0; i < 60; i++) {
            rotation_within(&state, &cell, other);
            if (!arc_holds(&cell, arc_of(other))) /* it was rounded off the end */
                continue;
            long double far = moved(q, other);
            test_require(far <= bound + 1e-17L);
            most = far > most ? far : most;
        }
        for (int end = 0; end < 2; end++) {
            struct arc_rotation r = arc_end(&cell, end);
            const int32_t at[4] = {(int32_t)r.w, 0, 0, (int32_t)r.z};
            long double far = moved(q, at);
            test_require(far <= bound + 1e-17L);
            most = far > most ? far : most;
        }
        test_require(bound < most * (1 + 1e-6L) + 4e-9L); /* and is no larger than need be */
    }
}
END_TEST

/* Cells of one level turn by nearly the same angle: that is what the quadratic is for. */
START_TEST(cells_are_of_one_size)
{
    for (int32_t level = 2; level <= 8; level++) {
        int64_t least = INT64_MAX, most = 0;
        for (int32_t at = 0; at < 1 << level; at++) {
            const struct cage_cell cell = {level, 0, {at, 0, 0}};
            int64_t turn = fibre->turn(&cell);
            least = turn < least ? turn : least;
            most = turn > most ? turn : most;
        }
        ck_assert(2 * most <= 3 * least);
    }
}
END_TEST

START_TEST(entries_stay_small)
{
    uint64_t state = 5;
    for (int32_t i = 0; i < 20000; i++) {
        struct cage_cell cell = any_cell(&state);
        int32_t q[4];
        fibre->representative(&cell, q);
        for (int k = 0; k < 4; k++)
            test_require(q[k] >= -(1 << 30) && q[k] <= 1 << 30);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("fibre");
    TCase *tests = test_case(suite, "fibre");
    tcase_add_test(tests, tiles_the_circle);
    tcase_add_test(tests, children_share_out_their_parent);
    tcase_add_test(tests, knows_its_neighbours);
    tcase_add_test(tests, bounds_what_it_moves);
    tcase_add_test(tests, cells_are_of_one_size);
    tcase_add_test(tests, entries_stay_small);
    return test_main(suite);
}
