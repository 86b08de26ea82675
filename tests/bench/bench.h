/* bench.h: what the files of the benchmark share. */
#ifndef BENCH_H
#define BENCH_H

#include "../../src/fibre.h"
#include "../../src/slice.h"

/* The block that everything is made in. */
#define BENCH_ROOM ((size_t)512 << 20)

void bench_die(const char *what);

double bench_now(void);

/* Seconds of processor time. */
double bench_processor(void);

/* All collision balls of a slice, those included that it left out. */
int32_t bench_all_balls(const struct cage_side *side, const struct cage_slice *slice, cage_ball *ball);

/* ---- space.c -------------------------------------------------------------------------------------- */

enum { BENCH_SHELL_MOST = 300, BENCH_HOOK_MOST = 30, BENCH_SPACE_LEVEL = 3, BENCH_SPACES = 6 };

/* A hook of three legs in a shell, and the inner side of the scene. */
struct bench_space {
    cage_ball obstacle[BENCH_SHELL_MOST], object[BENCH_HOOK_MOST];
    cage_scene scene;
    struct cage_side side;
};

/* fill: the radius of the shell's balls, by the distance of neighbours on it. The side is taken from the arena. */
void bench_space_make(struct cage_arena *arena, int32_t obstacles, int32_t objects, double fill, struct bench_space *out);

/* The inner slice of a cell, made as the search does. */
void bench_space_slice(struct cage_arena *arena, const struct cage_side *side, const struct cage_cell *cell,
                       struct cage_slice *out);

/* Slices of scene 0..BENCH_SPACES-1, each glued with three neighbours: a line for each, and their collision balls
 * into the file. */
void bench_space_print(void *block, int32_t number, const char *file);

/* ---- atlas.c -------------------------------------------------------------------------------------- */

void bench_atlas_print(void *block);

/* ---- bench.c: the fence of 200 balls around a bracket of 40, which stay where they are. */
void bench_fence_make(cage_scene *scene);

/* ---- uniform.c ------------------------------------------------------------------------------------ */

/* All slices of a level of space, all neighbours glued, component by component. */
void bench_uniform_print(void *block);

#endif
