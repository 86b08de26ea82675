/* test_refuse.c: what the interface refuses: null pointers, z in the plane, turns without a shorter arc, blocks too
 * small to begin. */
#include "support.h"

#include <stdlib.h>
#include <string.h>

#include "cage.h"

enum { PLENTY = 16 << 20, SCENES = 7 };

#define COUNT(array) ((int32_t)(sizeof(array) / sizeof *(array)))

static const cage_pose origin = {{0, 0, 0}, {1, 0, 0, 0}};
static const int32_t centre[3] = {0, 0, 0};
static const cage_scene empty = {{NULL, NULL, 0, 0}, {NULL, NULL, 0, 0}, 2};

/* A disc, four fingers that hold it, and a row of balls. */
static const cage_ball disc[1] = {{0, 0, 0, 40000}};
static const cage_ball fingers[4] = {{70000, 0, 0, 20000}, {0, 70000, 0, 20000}, {-70000, 0, 0, 20000}, {0, -70000, 0, 20000}};
static const cage_ball row[3] = {{-9000, 0, 0, 5000}, {0, 0, 0, 5000}, {9000, 0, 0, 5000}};

static const cage_scene held = {{disc, disc, 1, 1}, {fingers, fingers, 4, 4}, 2};

/* ---- null pointers --------------------------------------------------------------------------------------- */

/* Every choice of pointers that are null; goal and limits may be. */
START_TEST(null_pointers)
{
    unsigned char *memory = test_alloc(PLENTY);
    cage_proof *proof = NULL;
    uint8_t mask[4] = {7, 7, 7, 7};
    static const int32_t count[3] = {2, 2, 1};
    ck_assert_int_eq(cage_scene_check(NULL), CAGE_ERROR_ARGUMENT);
    cage_limits_default(NULL, 2);
    cage_limits_default(NULL, 3);
    cage_limits limits;
    cage_limits_default(&limits, 2);
    ck_assert_uint_eq(cage_prove_size(NULL, NULL), 0);
    ck_assert_uint_eq(cage_prove_size(NULL, &limits), 0);
    ck_assert_uint_eq(cage_prove_size(&held, NULL), cage_prove_size(&held, &limits));
    for (int null = 1; null < 4; null++)
        for (int32_t side = CAGE_SIDE_INNER; side <= CAGE_SIDE_OUTER; side++)
            ck_assert_int_eq(cage_collides(null & 1 ? NULL : &held, null & 2 ? NULL : &origin, side), CAGE_ERROR_ARGUMENT);
    for (int null = 1; null < 16; null++)
        for (int more = 0; more < 4; more++)
            ck_assert_int_eq(cage_prove_begin(null & 1 ? NULL : &proof, null & 2 ? NULL : &held, null & 4 ? NULL : &origin,
                                              more & 1 ? NULL : &origin, more & 2 ? NULL : &limits, null & 8 ? NULL : memory,
                                              PLENTY),
                             CAGE_ERROR_ARGUMENT);
    ck_assert_ptr_null(proof);
    ck_assert_int_eq(cage_prove_run(NULL, 0), CAGE_ERROR_ARGUMENT);
    ck_assert_int_eq(cage_prove_run(NULL, INT64_MAX), CAGE_ERROR_ARGUMENT);
    ck_assert_int_eq(cage_prove_run_inner(NULL, 0), CAGE_ERROR_ARGUMENT);
    ck_assert_ptr_null(cage_prove_result(NULL));

    cage_limits one_side = limits; /* a proof of both sides, or of the outer one, is not for cage_prove_run_inner, at any time */
    for (one_side.side = CAGE_SIDE_OUTER; one_side.side <= CAGE_SIDE_BOTH; one_side.side++) {
        ck_assert_int_eq(cage_prove_begin(&proof, &held, &origin, NULL, &one_side, memory, PLENTY), CAGE_OK);
        int32_t state = 0;
        for (int step = 0; state == 0; step++) {
            ck_assert_int_eq(cage_prove_run_inner(proof, 1), CAGE_ERROR_ARGUMENT);
            ck_assert_int_eq(cage_prove_result(proof)->steps, step);
            state = cage_prove_run(proof, 1);
        }
        ck_assert_int_eq(state, 1);
    }
    ck_assert_int_eq(cage_prove_begin(&proof, &held, &origin, NULL, NULL, memory, PLENTY), CAGE_OK);
    ck_assert_int_eq(cage_prove_run(proof, INT64_MAX), 1);
    for (int null = 1; null < 16; null++)
        ck_assert_int_eq(cage_prove_region(null & 1 ? NULL : proof, null & 2 ? NULL : centre, 1, null & 4 ? NULL : count,
                                           null & 8 ? NULL : mask),
                         CAGE_ERROR_ARGUMENT);
    for (int k = 0; k < 4; k++)
        ck_assert_int_eq(mask[k], 7);
    for (int null = 1; null < 16; null++)
        for (int goal = 0; goal < 2; goal++)
            ck_assert_int_eq(cage_path_check(null & 1 ? NULL : &held, null & 2 ? NULL : &origin, goal ? &origin : NULL,
                                             null & 4 ? NULL : centre, null & 8 ? NULL : &origin, 1),
                             CAGE_ERROR_ARGUMENT);
    ck_assert_int_eq(cage_path_check(&held, &origin, &origin, centre, &origin, 0), CAGE_ERROR_ARGUMENT);
    ck_assert_int_eq(cage_path_check(&held, &origin, &origin, centre, &origin, INT32_MIN), CAGE_ERROR_ARGUMENT);
    ck_assert_int_eq(cage_path_check(&held, &origin, &origin, centre, &origin, 1), 1);
    free(memory);
}
END_TEST

/* ---- z in the plane -------------------------------------------------------------------------------------- */

START_TEST(paths_stay_in_the_plane)
{
    static const int32_t z[4] = {1, -1, INT32_MAX, INT32_MIN};
    const cage_pose good[3] = {origin, {{5, 0, 0}, {1, 0, 0, 0}}, {{5, 5, 0}, {1, 0, 0, 0}}};
    const cage_scene *const scenes[2] = {&empty, &held};
    for (int s = 0; s < 2; s++) {
        ck_assert_int_eq(cage_path_check(scenes[s], &good[0], &good[2], centre, good, 3), 1);
        for (int k = 0; k < 4; k++)
            for (int at = 0; at < 3; at++)
                for (int goal = 0; goal < 2; goal++) {
                    cage_pose path[3] = {good[0], good[1], good[2]};
                    path[at].x[2] = z[k];
                    ck_assert_int_eq(cage_path_check(scenes[s], &good[0], goal ? &good[2] : NULL, centre, path, 3),
                                     CAGE_ERROR_DIMENSION);
                }
        for (int k = 0; k < 2; k++) {
            const int32_t off[3] = {0, 0, z[k]};
            const cage_pose lifted = {{0, 0, z[k]}, {1, 0, 0, 0}};
            ck_assert_int_eq(cage_path_check(scenes[s], &good[0], &good[2], off, good, 3), CAGE_ERROR_DIMENSION);
            ck_assert_int_eq(cage_path_check(scenes[s], &lifted, &good[2], centre, good, 3), CAGE_ERROR_DIMENSION);
            ck_assert_int_eq(cage_path_check(scenes[s], &good[0], &lifted, centre, good, 3), CAGE_ERROR_DIMENSION);
        }
    }
}
END_TEST

START_TEST(regions_stay_in_the_plane)
{
    static const int32_t z[4] = {1, -1, INT32_MAX, INT32_MIN};
    unsigned char *memory = test_alloc(PLENTY);
    cage_proof *proof = NULL;
    uint8_t mask[8];
    ck_assert_int_eq(cage_prove_begin(&proof, &held, &origin, NULL, NULL, memory, PLENTY), CAGE_OK);
    for (int finished = 0; finished < 2; finished++) {
        static const int32_t count[3] = {2, 2, 1}, deep[3] = {2, 2, 2}, none[3] = {2, 2, 0};
        memset(mask, 7, sizeof mask);
        for (int k = 0; k < 4; k++) {
            const int32_t from[3] = {0, 0, z[k]};
            ck_assert_int_eq(cage_prove_region(proof, from, 1, count, mask), CAGE_ERROR_DIMENSION);
        }
        ck_assert_int_eq(cage_prove_region(proof, centre, 1, deep, mask), CAGE_ERROR_DIMENSION);
        for (int k = 0; k < 3; k++) {
            int32_t negative[3] = {2, 2, 1};
            negative[k] = -1;
            ck_assert_int_eq(cage_prove_region(proof, centre, 1, negative, mask), CAGE_ERROR_ARGUMENT);
        }
        ck_assert_int_eq(cage_prove_region(proof, centre, 0, count, mask), CAGE_ERROR_ARGUMENT);
        ck_assert_int_eq(cage_prove_region(proof, centre, -1, count, mask), CAGE_ERROR_ARGUMENT);
        ck_assert_int_eq(cage_prove_region(proof, centre, 1, none, mask), CAGE_OK);
        for (int k = 0; k < COUNT(mask); k++)
            ck_assert_int_eq(mask[k], 7);
        ck_assert_int_eq(cage_prove_region(proof, centre, 1, count, mask), CAGE_OK);
        for (int k = 0; k < 4; k++)
            ck_assert_int_eq(mask[k], finished);
        if (!finished)
            ck_assert_int_eq(cage_prove_run(proof, INT64_MAX), 1);
    }
    ck_assert_int_eq(cage_prove_result(proof)->verdict, CAGE_CAGED);
    free(memory);
}
END_TEST

/* ---- half turns ------------------------------------------------------------------------------------------ */

/* From q to r about the origin, by way of m unless that is null. */
static int32_t turn(const cage_scene *s, const int32_t q[2], const int32_t *m, const int32_t r[2])
{
    cage_pose path[3] = {origin, origin, origin};
    int32_t count = 0;
    const int32_t *const by[3] = {q, m, r};
    for (int k = 0; k < 3; k++)
        if (by[k]) {
            path[count].q[0] = by[k][0];
            path[count++].q[3] = by[k][1];
        }
    return cage_path_check(s, &path[0], &path[count - 1], centre, path, count);
}

/* There are two shorter arcs, and the check does not choose one, even where both are free; by way of a quarter turn it knows. */
START_TEST(half_turns_are_refused)
{
    static const int32_t most = CAGE_QUATERNION_2D;
    static const int32_t from[5][2] = {{1, 0}, {0, 7}, {2, 1}, {-12345, 54321}, {most, -most}};
    static const cage_ball arm[1] = {{1000, 0, 0, 100}}, far[1] = {{0, 9000, 0, 100}};
    const cage_scene scenes[4] = {
        empty, held, {{arm, arm, 1, 1}, {NULL, NULL, 0, 0}, 2}, {{arm, arm, 1, 1}, {far, far, 1, 1}, 2}};
    for (int s = 0; s < COUNT(scenes); s++)
        for (int k = 0; k < COUNT(from); k++)
            for (int sign = -1; sign <= 1; sign += 2) {
                const int32_t *q = from[k];
                const int32_t same[2] = {-q[0], -q[1]}, half[2] = {-sign * q[1], sign * q[0]};
                ck_assert_int_eq(turn(&scenes[s], q, NULL, half), 0);
                ck_assert_int_eq(turn(&scenes[s], half, NULL, q), 0);
                ck_assert_int_eq(turn(&scenes[s], q, same, half), 0);
                ck_assert_int_eq(turn(&scenes[s], q, NULL, same), 1);
                /* between the two: q and half are of the same length */
                const int32_t left[2] = {q[0] / 2 + half[0] / 2, q[1] / 2 + half[1] / 2};
                const int32_t right[2] = {q[0] / 2 - half[0] / 2, q[1] / 2 - half[1] / 2};
                if (k == 0 || k == 2) /* too small to be halved */
                    continue;
                ck_assert_int_eq(turn(&scenes[s], q, left, half), 1);
                ck_assert_int_eq(turn(&scenes[s], q, right, half), 1);
            }
    for (int s = 0; s < COUNT(scenes); s++)
        for (int sign = -1; sign <= 1; sign += 2) {
            const int32_t start[2] = {1, 0}, quarter[2] = {1, sign}, half[2] = {0, 1}, other[2] = {0, -1};
            ck_assert_int_eq(turn(&scenes[s], start, quarter, half), 1);
            ck_assert_int_eq(turn(&scenes[s], start, quarter, other), 1);
        }
}
END_TEST

/* With a ball in the way on the left the arc on the right is free, and it is the path that says which is meant. */
START_TEST(the_arc_is_the_shorter_one)
{
    static const cage_ball arm[1] = {{1000, 0, 0, 100}}, left[1] = {{0, 1000, 0, 100}};
    const cage_scene s = {{arm, arm, 1, 1}, {left, left, 1, 1}, 2};
    static const int32_t start[2] = {1, 0}, half[2] = {0, 1};
    for (int sign = -1; sign <= 1; sign += 2) {
        const int32_t quarter[2] = {1, sign}, nearly[2] = {1, sign * (1 << 20)}, opposite[2] = {-1, -sign * (1 << 20)};
        ck_assert_int_eq(turn(&s, start, quarter, half), sign < 0);
        ck_assert_int_eq(turn(&s, start, NULL, nearly), sign < 0);
        ck_assert_int_eq(turn(&s, start, NULL, opposite), sign < 0);
        ck_assert_int_eq(turn(&s, start, nearly, half), sign < 0);
    }
    ck_assert_int_eq(turn(&s, start, NULL, half), 0);
}
END_TEST

/* ---- blocks ---------------------------------------------------------------------------------------------- */

/* Nothing at all, obstacles alone, an object alone, and some with balls of one side only or of odd counts. */
static const cage_scene block_scene[SCENES] = {
    {{NULL, NULL, 0, 0}, {NULL, NULL, 0, 0}, 2},
    {{NULL, NULL, 0, 0}, {fingers, fingers, 4, 4}, 2},
    {{row, row, 3, 3}, {NULL, NULL, 0, 0}, 2},
    {{disc, disc, 1, 1}, {fingers, fingers, 4, 4}, 2},
    {{row, row, 1, 3}, {fingers, fingers, 3, 4}, 2},
    {{row, NULL, 3, 0}, {fingers, NULL, 4, 0}, 2},
    {{NULL, row, 0, 3}, {NULL, fingers, 0, 3}, 2},
};

/* The default limits, few cells, and the fewest. */
static const cage_limits block_limits[3] = {
    {CAGE_SIDE_BOTH, -1, 12, 16384}, {CAGE_SIDE_BOTH, -1, 6, 97}, {CAGE_SIDE_BOTH, -1, CAGE_LEVEL_MAX_2D, 2}};

static const cage_pose half_turned = {{0, 0, 0}, {0, 0, 0, 1}};

/* cage_prove_size bytes are enough to begin at every address, and for scenes as small as these to finish. Blocks end where the
 * memory ends, so that nothing is written beyond them unseen. */
START_TEST(the_size_is_enough)
{
    for (int s = 0; s < SCENES; s++)
        for (int l = 0; l < COUNT(block_limits); l++) {
            size_t bytes = cage_prove_size(&block_scene[s], &block_limits[l]);
            int32_t verdict[2] = {-1, -1};
            ck_assert_uint_gt(bytes, 0);
            for (size_t off = 0; off < 16; off++) {
                int with_goal = (int)(off / 2 % 2);
                unsigned char *memory = test_alloc(bytes + off), *block = memory + off;
                memset(memory, 0xa5, off + (bytes < 4096 ? bytes : 4096));
                cage_proof *proof = NULL;
                ck_assert_int_eq(cage_prove_begin(&proof, &block_scene[s], &origin, with_goal ? &half_turned : NULL,
                                                  &block_limits[l], block, bytes),
                                 CAGE_OK);
                ck_assert((unsigned char *)proof >= block && (unsigned char *)proof < block + bytes);
                ck_assert_int_eq(cage_prove_run(proof, INT64_MAX), 1);
                const cage_result *r = cage_prove_result(proof);
                ck_assert(verdict[with_goal] < 0 || verdict[with_goal] == r->verdict);
                verdict[with_goal] = r->verdict;
                if (r->path_count > 0)
                    ck_assert_int_eq(cage_path_check(&block_scene[s], &origin, with_goal ? &half_turned : NULL, r->pivot, r->path,
                                                     r->path_count),
                                     1);
                for (size_t k = 0; k < off; k++)
                    ck_assert_int_eq(memory[k], 0xa5);
                free(memory);
            }
            if (s < 3) { /* nothing in the way */
                ck_assert_int_eq(verdict[0], CAGE_FREE);
                ck_assert_int_eq(verdict[1], CAGE_CONNECTED);
            }
        }
}
END_TEST

/* All start levels, with as many cells as they need and one fewer; in sanitized runs no bound may overflow on the way. */
START_TEST(every_start_level)
{
    for (int32_t dim = 2; dim <= 3; dim++) {
        cage_scene scene = held;
        int64_t cells = dim == 2 ? 2 : 4, of_level = cells;
        scene.dim = dim;
        for (int32_t level = 0; level <= (dim == 2 ? CAGE_LEVEL_MAX_2D : CAGE_LEVEL_MAX_3D); level++) {
            cage_limits limits;
            cage_limits_default(&limits, dim);
            limits.max_level = level;
            limits.start_level = level;
            limits.max_cells = (int32_t)(cells < 1 << 24 ? cells : 1 << 24);
            ck_assert_int_eq(cage_prove_size(&scene, &limits) > 0, cells <= 1 << 24);
            limits.max_cells--;
            ck_assert_uint_eq(cage_prove_size(&scene, &limits), 0);
            of_level *= dim == 2 ? 2 : 8;
            cells += of_level;
        }
    }
}
END_TEST

/* With less it begins or it does not; if not, there is no proof, and what does not begin in a block does not in a smaller one. */
START_TEST(smaller_blocks)
{
    for (int s = 0; s < SCENES; s++) {
        const cage_limits *limits = &block_limits[1];
        size_t most = cage_prove_size(&block_scene[s], limits), pace = most / (size_t)test_rounds(300) + 1;
        int32_t begun = 0, refused = 0;
        for (size_t bytes = 0; bytes < most; bytes += pace) {
            unsigned char *memory = test_alloc(bytes);
            cage_proof *proof = NULL;
            int32_t error = cage_prove_begin(&proof, &block_scene[s], &origin, &half_turned, limits, memory, bytes);
            ck_assert(error == CAGE_OK || error == CAGE_ERROR_MEMORY);
            ck_assert((error == CAGE_OK) == (proof != NULL));
            ck_assert(error == CAGE_OK || !begun);
            begun += error == CAGE_OK;
            refused += error != CAGE_OK;
            if (proof && cage_prove_run(proof, INT64_MAX) != 1) {
                ck_assert_int_eq(cage_prove_run(proof, 0), CAGE_ERROR_MEMORY);
                ck_assert_uint_gt(cage_prove_result(proof)->needed_bytes, bytes);
            }
            free(memory);
        }
        ck_assert(begun > 0 && refused > 0);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("refuse");
    TCase *tests = test_case(suite, "refuse");
    tcase_add_test(tests, null_pointers);
    tcase_add_test(tests, paths_stay_in_the_plane);
    tcase_add_test(tests, regions_stay_in_the_plane);
    tcase_add_test(tests, half_turns_are_refused);
    tcase_add_test(tests, the_arc_is_the_shorter_one);
    tcase_add_test(tests, the_size_is_enough);
    tcase_add_test(tests, every_start_level);
    tcase_add_test(tests, smaller_blocks);
    return test_main(suite);
}
