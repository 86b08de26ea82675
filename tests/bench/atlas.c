/* atlas.c: what an atlas takes beside the triangulations of its slices' balls alone, and what a question of it takes. */
#include <stdio.h>
#include <string.h>

#include "../../src/delaunay.h"
#include "bench.h"
#include "sets.h"

enum { POSES = 4096, ROUNDS = 16, MOST_PAIRS = 16384, TIMES = 5 };

/* Seconds to triangulate all collision balls of all cells of that level, on these sides. */
static double triangulations(unsigned char *block, const cage_scene *scene, int32_t level, int32_t sides, int64_t *balls)
{
    static cage_ball ball[MOST_PAIRS];
    const struct cage_fibre *fibre = scene->dim == 2 ? &cage_so2 : &cage_so3;
    struct cage_arena arena;
    int32_t pivot[3];
    double seconds = 0;
    cage_arena_init(&arena, block, BENCH_ROOM);
    cage_pivot(&scene->object, pivot);
    *balls = 0;
    for (int32_t side = 0; side < 2; side++) {
        struct cage_side of;
        if (!(sides >> side & 1) || cage_side_make(&arena, scene, pivot, side == 0 ? -1 : 1, &cage_all_shortcuts, &of) != CAGE_OK)
            continue;
        for (int32_t n = 0; n < fibre->roots << (scene->dim == 2 ? level : 3 * level); n++) {
            int32_t at = n / fibre->roots, mask = (1 << level) - 1;
            const struct cage_cell cell = {level, n % fibre->roots, {at & mask, scene->dim == 3 ? at >> level & mask : 0,
                                                                      scene->dim == 3 ? at >> 2 * level & mask : 0}};
            struct cage_triangulation t;
            struct cage_slice slice;
            size_t mark = arena.used;
            if (scene->dim == 3) {
                bench_space_slice(&arena, &of, &cell, &slice);
            } else {
                struct cage_rotations rotations;
                fibre->representative(&cell, rotations.q);
                rotations.turn = fibre->turn(&cell);
                if (cage_slice_make(&arena, &of, &rotations, &slice) != CAGE_OK)
                    bench_die("cage_slice_make failed");
            }
            int32_t count = bench_all_balls(&of, &slice, ball);
            cage_arena_release(&arena, mark);
            double start = bench_now();
            if (cage_delaunay(&arena, &cage_all_shortcuts, scene->dim, ball, count, &t) != CAGE_OK)
                bench_die("cage_delaunay failed");
            seconds += bench_now() - start;
            *balls += count;
            cage_arena_release(&arena, mark);
        }
    }
    return seconds;
}

static uint32_t draw(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)(*state >> 33);
}

/* Microseconds a question takes: poses all over the box of the obstacles. */
static double ask(const cage_scene *scene, const cage_atlas *atlas, int32_t decided[2])
{
    static cage_pose pose[POSES];
    uint64_t state = 1;
    int32_t low[3] = {INT32_MAX, INT32_MAX, INT32_MAX}, high[3] = {INT32_MIN, INT32_MIN, INT32_MIN};
    for (int32_t j = 0; j < scene->obstacles.inner_count; j++) {
        const cage_ball *b = &scene->obstacles.inner[j];
        const int32_t at[3] = {b->x, b->y, b->z};
        for (int32_t k = 0; k < 3; k++) {
            low[k] = at[k] < low[k] ? at[k] : low[k];
            high[k] = at[k] > high[k] ? at[k] : high[k];
        }
    }
    for (int32_t i = 0; i < POSES; i++) {
        memset(&pose[i], 0, sizeof pose[i]);
        for (int32_t k = 0; k < scene->dim; k++)
            pose[i].x[k] = low[k] + (int32_t)(draw(&state) % (uint32_t)(high[k] - low[k] + 1));
        for (int32_t k = 0; k < 4; k++)
            if (scene->dim == 3 || k % 3 == 0)
                pose[i].q[k] = 1 + (int32_t)(draw(&state) % 2001) - 1000;
    }
    double start = bench_now();
    for (int32_t round = 0; round < ROUNDS; round++)
        for (int32_t i = 0; i < POSES; i++) {
            int32_t verdict = cage_atlas_ask(atlas, &pose[i], NULL);
            decided[0] += verdict != CAGE_UNDEFINED && verdict != CAGE_IN_COLLISION;
            decided[1] += verdict == CAGE_IN_COLLISION;
        }
    return (bench_now() - start) / (POSES * ROUNDS) * 1e6;
}

/* The atlas, made in the block and written to bytes; how long that took. */
static double make_atlas(unsigned char *block, const cage_scene *scene, int32_t level, int32_t sides, unsigned char *bytes, size_t room,
                         cage_survey_result *result)
{
    cage_plan plan;
    cage_survey *survey;
    cage_plan_default(&plan);
    plan.level = level;
    plan.side = sides;
    double start = bench_now();
    if (cage_survey_begin(&survey, scene, &plan, block, BENCH_ROOM) != CAGE_OK || cage_survey_run(survey, INT64_MAX) != 1)
        bench_die("the survey failed");
    *result = *cage_survey_result_of(survey);
    if (result->atlas_bytes > room || !cage_survey_atlas(survey, bytes, room))
        bench_die("the atlas is too large");
    return bench_now() - start;
}

static double median(double value[TIMES])
{
    for (int32_t i = 1; i < TIMES; i++)
        for (int32_t j = i; j > 0 && value[j] < value[j - 1]; j--) {
            double swap = value[j];
            value[j] = value[j - 1];
            value[j - 1] = swap;
        }
    return value[TIMES / 2];
}

/* Medians, of seconds and of their ratios, as either is measured in turn. */
static void print_scene(unsigned char *block, const char *name, const cage_scene *scene, int32_t level, int32_t sides)
{
    static unsigned char bytes[128 << 20];
    double alone[TIMES], seconds[TIMES], ratio[TIMES];
    cage_survey_result work;
    cage_atlas atlas;
    int64_t balls;
    int32_t decided[2] = {0, 0};
    for (int32_t i = 0; i < TIMES; i++) {
        alone[i] = triangulations(block, scene, level, sides, &balls);
        seconds[i] = make_atlas(block, scene, level, sides, bytes, sizeof bytes, &work);
        ratio[i] = seconds[i] / alone[i];
    }
    if (cage_atlas_open(&atlas, bytes, (size_t)work.atlas_bytes) != CAGE_OK)
        bench_die("cage_atlas_open failed");
    double micro = ask(scene, &atlas, decided);
    printf("  %-22s %5d %6d %8lld %8.3f %8.3f %6.2f %8.0f %7.2f %7.2f %7.1f%% %7.1f%%\n", name, sides, work.leaves, (long long)balls,
           median(alone), median(seconds), median(ratio), (double)work.atlas_bytes / 1024,
           (double)work.atlas_bytes / (double)balls, micro, 100.0 * decided[0] / (POSES * ROUNDS),
           100.0 * decided[1] / (POSES * ROUNDS));
    fflush(stdout);
}

void bench_atlas_print(void *block)
{
    static struct bench_space space;
    static unsigned char small[1 << 20];
    const int32_t sizes[2][2] = {{60, 5}, {100, 20}};
    struct cage_arena arena;
    cage_scene fence;
    printf("\natlas: seconds to triangulate all collision balls of all slices, and to make the atlas, medians of %d times in turn;\n"
           "its size; a question\n", TIMES);
    printf("  %-22s %5s %6s %8s %8s %8s %6s %8s %7s %7s %8s %8s\n", "scene", "sides", "slices", "balls", "triang.", "atlas", "ratio",
           "KiB", "B/ball", "us", "decided", "collide");
    bench_fence_make(&fence);
    for (int32_t sides = 1; sides <= 3; sides += 2)
        print_scene(block, "fence 200 x 40", &fence, 6, sides);
    for (int32_t i = 0; i < 2; i++) {
        char name[32];
        cage_arena_init(&arena, small, sizeof small);
        bench_space_make(&arena, sizes[i][0], sizes[i][1], 1.0, &space);
        snprintf(name, sizeof name, "shell %d x %d", sizes[i][0], sizes[i][1]);
        print_scene(block, name, &space.scene, i == 0 ? 3 : 2, 1);
    }
}
