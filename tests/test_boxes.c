/* test_boxes.c: the boxes of a class against its points one by one, and the range of its rotations against poses located in
 * it. */
#include "support.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "scenes.h"
#include "scenes_space.h"

#define PLENTY ((size_t)64 << 20)

static unsigned char *block;

static void block_make(void) { block = test_alloc(PLENTY); }

static void block_drop(void) { free(block); }

/* Too few rounds for all that is looked for to turn up. */
static bool quick(void) { return getenv("CAGE_TEST_QUICK") != NULL; }

static unsigned char *make(const cage_scene *view, int32_t level, int32_t max_cells, cage_atlas *atlas)
{
    cage_survey *survey;
    cage_plan plan;
    cage_plan_default(&plan);
    plan.level = level;
    plan.max_cells = max_cells;
    ck_assert_int_eq(cage_survey_begin(&survey, view, &plan, block, PLENTY), CAGE_OK);
    ck_assert_int_eq(cage_survey_run(survey, INT64_MAX), 1);
    size_t size = cage_survey_atlas(survey, NULL, 0);
    unsigned char *byte = test_alloc(size);
    ck_assert_uint_eq(cage_survey_atlas(survey, byte, size), size);
    ck_assert_int_eq(cage_atlas_open(atlas, byte, size), CAGE_OK);
    return byte;
}

/* ---- boxes ---------------------------------------------------------------------------------------------- */

enum { REACH_2D = 70, REACH_3D = 22, SIDE = 2 * REACH_2D + 1 };

/* How often each grid point up to the reach is in a box, in a whole one and in another. */
struct counts {
    int32_t dim, reach;
    uint8_t whole[SIDE * SIDE + 45 * 45 * 45], part[SIDE * SIDE + 45 * 45 * 45];
    int64_t boxes, parts;
};

static size_t place(const struct counts *c, const int32_t p[3])
{
    size_t side = 2 * (size_t)c->reach + 1;
    return (size_t)(p[0] + c->reach) + side * ((size_t)(p[1] + c->reach) + (c->dim == 3 ? side * (size_t)(p[2] + c->reach) : 0));
}

static void count(void *context, const cage_atlas_box *box)
{
    struct counts *c = context;
    int32_t p[3];
    c->boxes++;
    c->parts += !box->whole;
    int32_t low[3], high[3]; /* of the part that is looked at */
    for (int32_t k = 0; k < 3; k++) {
        test_require(box->low[k] <= box->high[k]);
        low[k] = box->low[k] > -c->reach ? box->low[k] : -c->reach;
        high[k] = box->high[k] < c->reach ? box->high[k] : c->reach;
    }
    for (p[2] = low[2]; p[2] <= high[2]; p[2]++)
        for (p[1] = low[1]; p[1] <= high[1]; p[1]++)
            for (p[0] = low[0]; p[0] <= high[0]; p[0]++)
                (box->whole ? c->whole : c->part)[place(c, p)]++;
}

/* Two balls opposite each other, so that the pivot is the origin, among balls on a circle (in space: at the corners and faces
 * of a cube) and some within. */
static void draw(uint64_t *state, int32_t dim, cage_ball object[2], cage_ball obstacle[24], int32_t *obstacles)
{
    int32_t size = dim == 2 ? 50 : 14;
    memset(object, 0, 2 * sizeof *object);
    object[0].x = (int32_t)test_between(state, 0, dim == 2 ? 6 : 1);
    object[0].y = (int32_t)test_between(state, 0, dim == 2 ? 3 : 1);
    object[0].r = object[1].r = (int32_t)test_between(state, 1, dim == 2 ? 6 : 3);
    object[1].x = -object[0].x;
    object[1].y = -object[0].y;
    *obstacles = (int32_t)test_between(state, 3, 24);
    for (int32_t j = 0; j < *obstacles; j++) {
        double angle = 2 * acos(-1.0) * j / *obstacles;
        bool within = test_between(state, 0, 3) == 0;
        obstacle[j].x = within ? (int32_t)test_between(state, -size, size) : (int32_t)(size * 0.8 * cos(angle));
        obstacle[j].y = within ? (int32_t)test_between(state, -size, size) : (int32_t)(size * 0.8 * sin(angle));
        obstacle[j].z = dim == 2 ? 0 : (int32_t)test_between(state, -size, size);
        obstacle[j].r = (int32_t)test_between(state, 0, dim == 2 ? 12 : 7);
    }
    if (dim == 2)
        return;
    *obstacles = 16;
    for (int32_t j = 0; j < 14; j++) {
        const cage_ball corner = {j & 1 ? 11 : -11, j & 2 ? 11 : -11, j & 4 ? 11 : -11, (int32_t)test_between(state, 13, 15)};
        const cage_ball face = {j / 2 == 4 ? corner.x * 3 / 2 : 0, j / 2 == 5 ? corner.x * 3 / 2 : 0, j / 2 == 6 ? corner.x * 3 / 2 : 0,
                                corner.r};
        obstacle[j] = j < 8 ? corner : face;
    }
}

/* Every point of the grid in each cell of an atlas: in whole boxes of its class alone, in those of others never. With all
 * halvings boxes tell the class exactly. */
static void compare(const cage_atlas *atlas, int32_t side, int32_t cell, int32_t halvings, struct counts *c)
{
    int32_t classes = atlas->classes[side == CAGE_SIDE_OUTER], corner[8][4];
    cage_pose pose = {{0, 0, 0}, {0, 0, 0, 0}};
    ck_assert_int_eq(cage_atlas_cell(atlas, cell, pose.q, corner), atlas->dim == 2 ? 2 : 8);
    for (int32_t class = 0; class < classes; class++) {
        memset(c->whole, 0, sizeof c->whole);
        memset(c->part, 0, sizeof c->part);
        c->boxes = c->parts = 0;
        int64_t told = cage_atlas_boxes(atlas, side, cell, class, halvings, count, c);
        ck_assert_int_eq(told, c->boxes);
        if (halvings == 20)
            ck_assert_int_eq(c->parts, 0);
        for (pose.x[2] = atlas->dim == 3 ? -c->reach : 0; pose.x[2] <= (atlas->dim == 3 ? c->reach : 0); pose.x[2]++)
            for (pose.x[1] = -c->reach; pose.x[1] <= c->reach; pose.x[1]++)
                for (pose.x[0] = -c->reach; pose.x[0] <= c->reach; pose.x[0]++) {
                    size_t at = place(c, pose.x);
                    bool in = cage_atlas_locate(atlas, &pose, side) == class;
                    test_require(c->whole[at] + c->part[at] <= 1);
                    test_require(in || c->whole[at] == 0);
                    test_require(!in || class == 0 || c->whole[at] + c->part[at] == 1);
                }
    }
}

START_TEST(points_one_by_one)
{
    static struct counts c;
    uint64_t state = (uint64_t)_i + 5;
    int32_t bounded = 0, whole = 0;
    c.dim = 2 + _i;
    c.reach = _i == 0 ? REACH_2D : REACH_3D;
    for (int32_t i = 0; i < test_rounds(_i == 0 ? 30 : 16); i++) {
        cage_ball object[2], obstacle[24];
        int32_t obstacles, level = (int32_t)test_between(&state, 0, c.dim == 2 ? 4 : 1);
        cage_atlas atlas;
        draw(&state, c.dim, object, obstacle, &obstacles);
        const cage_scene view = {{object, object, 2, 2}, {obstacle, obstacle, obstacles, obstacles}, c.dim};
        unsigned char *byte = make(&view, level, 0, &atlas);
        for (int32_t k = 0; k < 3; k++)
            ck_assert_int_eq(atlas.pivot[k], 0);
        int32_t side = CAGE_SIDE_INNER + (int32_t)test_between(&state, 0, 1), cell = (int32_t)test_between(&state, 0, atlas.leaves - 1);
        compare(&atlas, side, cell, i % 3 == 0 ? 20 : i % 6, &c);
        bounded += atlas.classes[side == CAGE_SIDE_OUTER] > 1;
        whole += c.boxes > c.parts;
        free(byte);
    }
    ck_assert_msg(quick() || (bounded > 2 && whole > 1), "%d with bounded classes, %d with whole boxes", (int)bounded, (int)whole);
}
END_TEST

/* ---- rotations ------------------------------------------------------------------------------------------ */

/* The sine of half the turn from q to p. */
static long double sine_between(const int32_t q[4], const int32_t p[4])
{
    long double nq = 0, np = 0, wedge = 0;
    for (int32_t i = 0; i < 4; i++) {
        nq += (long double)q[i] * q[i];
        np += (long double)p[i] * p[i];
        for (int32_t k = 0; k < i; k++) {
            long double minor = (long double)q[i] * p[k] - (long double)q[k] * p[i];
            wedge += minor * minor;
        }
    }
    return sqrtl(wedge / (nq * np));
}

/* Poses that are in a class turn by no more than it says; the corners of a cell hold what it is asked about there. */
static void rotations_of(const cage_scene *view, const cage_atlas *atlas, uint64_t *state, int64_t seen[2])
{
    cage_class class;
    int32_t reach = 0;
    for (int32_t j = 0; j < view->obstacles.inner_count; j++) {
        const cage_ball *b = &view->obstacles.inner[j];
        int32_t far = abs(b->x) > abs(b->y) ? abs(b->x) : abs(b->y);
        reach = far > reach ? far : reach;
    }
    for (int32_t n = 0; n < 400; n++) {
        int32_t side = n % 2 ? CAGE_SIDE_INNER : CAGE_SIDE_OUTER;
        cage_pose pose = {{0, 0, 0}, {0, 0, 0, 0}};
        for (int32_t k = 0; k < view->dim; k++)
            pose.x[k] = (int32_t)test_between(state, -reach, reach);
        for (int32_t k = 0; k < 4; k++)
            pose.q[k] = view->dim == 3 || k % 3 == 0 ? (int32_t)test_between(state, -1000, 1000) : 0;
        if (pose.q[0] == 0)
            pose.q[0] = 1;
        int32_t number = cage_atlas_locate(atlas, &pose, side);
        if (number < 0)
            continue;
        ck_assert_int_eq(cage_atlas_class(atlas, side, number, &class), CAGE_OK);
        test_require(class.sine > 0 && class.sine <= 1 << 30 && (number > 0 || class.sine == 1 << 30));
        test_require(sine_between(class.q, pose.q) <= class.sine / 1073741824.0L + 1e-15L);
        seen[0] += number > 0;
        seen[1] += number > 0 && class.sine < 1 << 30;
    }
}

/* A class of one cell has the range of its cell: the middle is a rotation of the cell, no corner is farther than it says, and
 * one is as far. */
static void ranges_are_tight(const cage_atlas *atlas, int64_t *seen)
{
    for (int32_t side = CAGE_SIDE_INNER; side <= CAGE_SIDE_OUTER; side++)
        for (int32_t n = 1; n < atlas->classes[side == CAGE_SIDE_OUTER]; n++) {
            cage_class class;
            int32_t q[4], corner[8][4], cell = 0;
            long double most = 0;
            ck_assert_int_eq(cage_atlas_class(atlas, side, n, &class), CAGE_OK);
            if (class.cells != 1 || !class.known)
                continue;
            for (; cell < atlas->leaves; cell++) {
                ck_assert_int_ge(cage_atlas_cell(atlas, cell, q, corner), 2);
                if (memcmp(q, class.pose.q, sizeof q) == 0)
                    break;
            }
            ck_assert_int_lt(cell, atlas->leaves);
            for (int32_t k = 0; k < (atlas->dim == 2 ? 2 : 8); k++) {
                long double sine = sine_between(class.q, corner[k]);
                most = sine > most ? sine : most;
            }
            test_require(class.sine < 1 << 30);
            test_require(class.sine / 1073741824.0L >= most - 1e-15L && class.sine / 1073741824.0L < most + 1e-7L);
            test_require(sine_between(class.q, q) < 1e-5L);
            (*seen)++;
        }
}

START_TEST(turns)
{
    int64_t seen[2] = {0, 0}, tight = 0;
    for (int32_t i = 0; i < test_scenes(60); i++) {
        uint64_t state = (uint64_t)i + 9;
        cage_atlas atlas;
        scene plane;
        space_scene space;
        cage_scene view;
        if (i % 4 == 3) {
            space_random((uint64_t)i, &space);
            view = space_view(&space);
        } else {
            scene_random((uint64_t)i, &plane);
            view = scene_view(&plane);
        }
        unsigned char *byte = make(&view, view.dim == 2 ? 2 + i % 4 : 1, i % 5 == 0 ? 200 : 0, &atlas);
        rotations_of(&view, &atlas, &state, seen);
        ranges_are_tight(&atlas, &tight);
        free(byte);
    }
    ck_assert(quick() || (seen[0] > 0 && seen[1] > 0 && tight > 0));
}
END_TEST

START_TEST(wrong_questions)
{
    const cage_ball ball = {0, 0, 0, 100}, other = {300, 0, 0, 100};
    const cage_scene view = {{&ball, &ball, 1, 1}, {&other, &other, 1, 1}, 2};
    static struct counts c;
    cage_atlas atlas;
    int32_t q[4], corner[8][4];
    unsigned char *byte = make(&view, 1, 0, &atlas);
    ck_assert_int_eq(cage_atlas_cell(&atlas, -1, q, corner), CAGE_ERROR_ARGUMENT);
    ck_assert_int_eq(cage_atlas_cell(&atlas, 4, q, corner), CAGE_ERROR_ARGUMENT);
    ck_assert_int_eq(cage_atlas_cell(&atlas, 3, q, corner), 2);
    ck_assert_int_eq(cage_atlas_boxes(&atlas, CAGE_SIDE_INNER, 0, 0, 21, count, &c), CAGE_ERROR_ARGUMENT);
    ck_assert_int_eq(cage_atlas_boxes(&atlas, CAGE_SIDE_INNER, 0, 1, 2, count, &c), CAGE_ERROR_ARGUMENT);
    ck_assert_int_eq(cage_atlas_boxes(&atlas, CAGE_SIDE_INNER, 4, 0, 2, count, &c), CAGE_ERROR_ARGUMENT);
    ck_assert_int_eq(cage_atlas_boxes(&atlas, CAGE_SIDE_BOTH, 0, 0, 2, count, &c), CAGE_ERROR_ARGUMENT);
    ck_assert_int_eq(cage_atlas_boxes(&atlas, CAGE_SIDE_INNER, 0, 0, 2, NULL, &c), CAGE_ERROR_ARGUMENT);
    free(byte);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("boxes");
    TCase *tests = test_case(suite, "boxes");
    tcase_add_unchecked_fixture(tests, block_make, block_drop);
    tcase_add_loop_test(tests, points_one_by_one, 0, 2);
    tcase_add_test(tests, turns);
    tcase_add_test(tests, wrong_questions);
    return test_main(suite);
}
