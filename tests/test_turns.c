/* test_turns.c: half turns that take the object to itself: cells and slices are the same, and so are answers. */
#include "support.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cubes.h"
#include "proof.h"
#include "referee.h"
#include "scenes_space.h"

enum { PLENTY = 64 << 20, ENTRY = 1 << 24 };

static unsigned char *memory, *spare;

/* q times the half turn, by the rule for products of quaternions. */
static void product(const int32_t q[4], int32_t turn, int32_t out[4])
{
    const int32_t a = q[0], b = q[1], c = q[2], d = q[3];
    const int32_t of[4][4] = {{a, b, c, d}, {-b, a, d, -c}, {-c, -d, a, b}, {-d, c, -b, a}};
    memcpy(out, of[turn], sizeof of[turn]);
}

static struct cage_cell any_cell(uint64_t *state)
{
    int32_t level = (int32_t)test_between(state, 0, 8), most = (1 << level) - 1;
    struct cage_cell cell = {level, (int32_t)test_between(state, 0, 3), {0, 0, 0}};
    for (int k = 0; k < 3; k++)
        cell.at[k] = (int32_t)test_between(state, 0, most);
    return cell;
}

/* Near the cell, often on its border: one of its corners or its representative, or something between. */
static void any_rotation_near(uint64_t *state, const struct cage_cell *cell, int32_t q[4])
{
    int32_t corner[8][4], middle[4];
    cage_so3.corners(cell, corner);
    cage_so3.representative(cell, middle);
    const int32_t *from = corner[test_between(state, 0, 7)], *to = random_next(state) & 1 ? middle : corner[test_between(state, 0, 7)];
    int32_t share = (int32_t)test_between(state, -8, 24);
    for (int e = 0; e < 4; e++)
        q[e] = (int32_t)(((int64_t)from[e] * (16 - share) + (int64_t)to[e] * share) / 16);
}

START_TEST(cells_turn_as_their_rotations_do)
{
    uint64_t state = 1;
    int32_t inside = 0;
    for (int32_t round = 0; round < test_rounds(200000); round++) {
        struct cage_cell cell = any_cell(&state), image, back;
        int32_t turn = (int32_t)test_between(&state, 0, 3), q[4], expected[4], turned[4], middle[4], image_middle[4];
        any_rotation_near(&state, &cell, q);
        product(q, turn, expected);
        cage_so3_turned(q, turn, turned);
        int same = memcmp(turned, expected, sizeof turned) == 0;
        for (int e = 0; e < 4; e++)
            turned[e] = -turned[e];
        test_require(same || memcmp(turned, expected, sizeof turned) == 0);

        cage_so3_turned_cell(&cell, turn, &image);
        cage_so3_turned_cell(&image, turn, &back);
        test_require(memcmp(&back, &cell, sizeof cell) == 0);
        struct cube_box point = cube_point(q), point_turned = cube_point(expected);
        test_require(cube_holds(&cell, &point) == cube_holds(&image, &point_turned));
        test_require(cube_holds_within(&cell, &point) == cube_holds_within(&image, &point_turned));
        inside += cube_holds(&cell, &point);

        cage_so3.representative(&cell, middle);
        cage_so3.representative(&image, image_middle);
        product(middle, turn, expected);
        int32_t sign = expected[image.face] < 0 ? -1 : 1;
        for (int e = 0; e < 4; e++)
            test_require(image_middle[e] == sign * expected[e]);
    }
    ck_assert_int_gt(inside, test_rounds(200000) / 4);
}
END_TEST

static int compare_parts(const void *a, const void *b) { return memcmp(a, b, sizeof(struct cage_part)); }

/* A slice of the cell and one of its image are of the same balls, rounding included. */
START_TEST(slices_of_images_have_the_same_balls)
{
    const int32_t origin[3] = {0, 0, 0};
    uint64_t state = 2;
    memory = test_alloc(PLENTY);
    for (int32_t round = 0; round < test_rounds(300); round++) {
        space_scene drawn, s;
        space_random(random_next(&state) >> 8, &drawn);
        int32_t turns = (int32_t)test_between(&state, 1, 4), turn = turns < 4 ? turns : (int32_t)test_between(&state, 1, 3);
        space_double(&drawn, turns, &s);
        cage_scene view = space_view(&s);
        struct cage_arena arena;
        struct cage_side side;
        struct cage_slice slice[2];
        struct cage_cell cell[2] = {any_cell(&state), {0, 0, {0, 0, 0}}};
        cage_so3_turned_cell(&cell[0], turn, &cell[1]);
        cage_arena_init(&arena, memory, PLENTY);
        ck_assert_int_eq(cage_side_make(&arena, &view, origin, round % 2 ? 1 : -1, &cage_all_shortcuts, &side), CAGE_OK);
        for (int i = 0; i < 2; i++) {
            struct cage_rotations rotations;
            struct cage_corners corners;
            int32_t corner[8][4];
            cage_so3.representative(&cell[i], rotations.q);
            rotations.turn = cage_so3.turn(&cell[i]);
            cage_so3.corners(&cell[i], corner);
            cage_corners_of(rotations.q, corner, &corners);
            ck_assert_int_eq(cage_slice_make_within(&arena, &side, &rotations, &corners, &slice[i]), CAGE_OK);
            qsort(slice[i].part, (size_t)slice[i].parts, sizeof *slice[i].part, compare_parts);
        }
        ck_assert_int_eq(slice[0].parts, slice[1].parts);
        ck_assert_int_eq(memcmp(slice[0].part, slice[1].part, (size_t)slice[0].parts * sizeof *slice[0].part), 0);
    }
    free(memory);
}
END_TEST

/* Each ball's image is as large and where the half turn takes it; without one of them there is none. */
START_TEST(images_of_balls_are_found)
{
    const int32_t pivot[3] = {11, -7, 5};
    uint64_t state = 3;
    int32_t found = 0, spoilt = 0;
    memory = test_alloc(1 << 20);
    for (int32_t round = 0; round < 2000; round++) {
        space_scene drawn, s;
        space_random((uint64_t)round, &drawn);
        int32_t turns = (int32_t)test_between(&state, 1, 4);
        space_double(&drawn, turns, &s);
        for (int32_t i = 0; i < s.object_count; i++) {
            s.object[i].x += pivot[0];
            s.object[i].y += pivot[1];
            s.object[i].z += pivot[2];
        }
        bool spoil = round % 4 == 0;
        int32_t which = (int32_t)test_between(&state, 0, s.object_count - 1);
        s.object[which].r += spoil;
        cage_scene view = space_view(&s);
        for (int32_t turn = 1; turn < CAGE_TURNS; turn++) {
            struct cage_arena arena;
            struct cage_side side;
            cage_arena_init(&arena, memory, 1 << 20);
            ck_assert_int_eq(cage_side_make(&arena, &view, pivot, -1, &cage_all_shortcuts, &side), CAGE_OK);
            size_t used = arena.used;
            int32_t is = cage_side_turn(&arena, turn, &side), truth = 1;
            for (int32_t i = 0; i < s.object_count; i++) {
                const int32_t sign[3] = {turn == 1 ? 1 : -1, turn == 2 ? 1 : -1, turn == 3 ? 1 : -1};
                int32_t there = -1;
                for (int32_t k = 0; k < s.object_count; k++)
                    if (s.object[k].x - pivot[0] == sign[0] * (s.object[i].x - pivot[0]) &&
                        s.object[k].y - pivot[1] == sign[1] * (s.object[i].y - pivot[1]) &&
                        s.object[k].z - pivot[2] == sign[2] * (s.object[i].z - pivot[2]) && s.object[k].r == s.object[i].r)
                        there = k;
                truth = truth && there >= 0;
                if (is) {
                    const cage_ball *a = &s.object[there], *b = &s.object[side.image[turn][i]];
                    test_require(memcmp(a, b, sizeof *a) == 0);
                }
            }
            ck_assert_int_eq(is, truth);
            ck_assert_msg(is || (arena.used == used && !side.image[turn]), "memory is kept for nothing");
            ck_assert_msg(spoil || is || (turns != 4 && turn != turns), "an image was made, and is not found");
            found += is;
            spoilt += spoil && !is;
        }
    }
    free(memory);
    ck_assert_int_gt(found, 1000);
    ck_assert_int_gt(spoilt, 500);
}
END_TEST

/* The same object from balls that no half turn takes to themselves has to get an answer that does not contradict. */
START_TEST(answers_are_those_of_the_object_that_is_not_seen_to_be_symmetric)
{
    int32_t caged = 0, out = 0, alike = 0, asked = 0;
    memory = test_alloc(PLENTY);
    spare = test_alloc(PLENTY);
    for (uint64_t seed = 0; asked < test_rounds(30) && seed < 4000; seed++) {
        space_scene drawn, s, plain;
        space_random(seed + 700000, &drawn);
        space_double(&drawn, (int)(seed / 11 % 4) + 1, &s);
        if (!space_spoil(&s, &plain))
            continue;
        cage_scene view = space_view(&s), plain_view = space_view(&plain);
        cage_limits limits;
        cage_limits_default(&limits, 3);
        limits.max_cells = 150;
        const question q = {&view, &s.start, NULL, &limits}, p = {&plain_view, &s.start, NULL, &limits};
        cage_proof *proof;
        if (cage_prove_begin(&proof, &view, &s.start, NULL, &limits, memory, PLENTY) != CAGE_OK)
            continue;
        ck_assert_int_gt(proof->graph.turns, 1);
        ck_assert_int_eq(proof->graph.roots, 4 / proof->graph.turns);
        cage_result r, w;
        ck_assert_int_eq(referee_prove(&p, 0, spare, PLENTY, &w), CAGE_OK);
        if (w.verdict == CAGE_IN_COLLISION)
            continue;
        asked++;
        ck_assert_int_eq(referee_prove(&q, 0, memory, PLENTY, &r), CAGE_OK);
        const char *wrong = referee_form(&q, &r);
        if (!wrong)
            wrong = referee_contradiction(r.verdict, w.verdict);
        if (wrong)
            space_print(stderr, &s);
        ck_assert_msg(!wrong, "seed %lu: %s", (unsigned long)seed, wrong);
        caged += r.verdict == CAGE_CAGED;
        out += r.verdict == CAGE_FREE;
        alike += r.verdict == w.verdict;
    }
    printf("turns: %d questions, %d caged, %d free, %d alike\n", (int)asked, (int)caged, (int)out, (int)alike);
    ck_assert_int_gt(caged, test_rounds(30) / 12);
    ck_assert_int_gt(out, test_rounds(30) / 12);
    free(memory);
    free(spare);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("turns");
    TCase *tests = test_case(suite, "turns");
    tcase_add_test(tests, cells_turn_as_their_rotations_do);
    tcase_add_test(tests, slices_of_images_have_the_same_balls);
    tcase_add_test(tests, images_of_balls_are_found);
    tcase_add_test(tests, answers_are_those_of_the_object_that_is_not_seen_to_be_symmetric);
    return test_main(suite);
}
