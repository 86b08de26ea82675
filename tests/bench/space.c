/* space.c: times inner slices in space, each glued with three of its neighbours, on scenes like those of queries. */
#include <stdio.h>

#include "../../src/glue.h"
#include "bench.h"
#include "sets.h"

enum { CELLS = 20, NEIGHBOURS = 3 };

/* A hook: ball i of n along three legs of 0.7, one along each axis. */
static void hook(int32_t i, int32_t n, double out[4])
{
    double along = 2.1 * i / (n - 1);
    out[0] = along < 0.7 ? 0.7 - along : 0;
    out[1] = along < 0.7 ? 0 : along < 1.4 ? along - 0.7 : 0.7;
    out[2] = along < 1.4 ? 0 : along - 1.4;
    out[3] = 0.1 + 0.5 / n;
}

static cage_ball on_grid(const double b[4])
{
    const double unit = CAGE_REACH_3D / 5.5;
    const cage_ball ball = {(int32_t)lround(unit * b[0]), (int32_t)lround(unit * b[1]), (int32_t)lround(unit * b[2]),
                            (int32_t)floor(unit * b[3])};
    return ball;
}

/* The pivot of the hook becomes the origin, so that it is at home in the middle of the shell. */
static void move_home(struct bench_space *space, int32_t objects)
{
    int32_t pivot[3];
    cage_pivot(&space->scene.object, pivot);
    for (int32_t i = 0; i < objects; i++) {
        space->object[i].x -= pivot[0];
        space->object[i].y -= pivot[1];
        space->object[i].z -= pivot[2];
    }
}

void bench_space_make(struct cage_arena *arena, int32_t obstacles, int32_t objects, double fill, struct bench_space *out)
{
    const cage_shape object = {out->object, out->object, objects, objects};
    const cage_shape shell = {out->obstacle, out->obstacle, obstacles, obstacles};
    const cage_scene scene = {object, shell, 3};
    const int32_t origin[3] = {0, 0, 0};
    double b[4];
    for (int32_t i = 0; i < obstacles; i++) {
        bench_shell(i, obstacles, b);
        b[3] *= fill / 0.8;
        out->obstacle[i] = on_grid(b);
    }
    for (int32_t i = 0; i < objects; i++) {
        hook(i, objects, b);
        out->object[i] = on_grid(b);
    }
    out->scene = scene;
    move_home(out, objects);
    if (cage_scene_check(&out->scene) != CAGE_OK || cage_side_make(arena, &out->scene, origin, -1, &cage_all_shortcuts, &out->side) != CAGE_OK)
        bench_die("the scene does not fit");
}

void bench_space_slice(struct cage_arena *arena, const struct cage_side *side, const struct cage_cell *cell,
                       struct cage_slice *out)
{
    struct cage_rotations rotations;
    struct cage_corners corners;
    int32_t corner[8][4];
    cage_so3.representative(cell, rotations.q);
    rotations.turn = cage_so3.turn(cell);
    cage_so3.corners(cell, corner);
    cage_corners_of(rotations.q, corner, &corners);
    if (cage_slice_make_within(arena, side, &rotations, &corners, out) != CAGE_OK)
        bench_die("cage_slice_make_within failed");
}

/* A slice that is packed, as the search keeps it. */
static void make_packed(struct cage_arena *arena, void *room, size_t bytes, const struct cage_side *side,
                        const struct cage_cell *cell, struct cage_slice *out)
{
    struct cage_slice made;
    size_t mark = arena->used;
    bench_space_slice(arena, side, cell, &made);
    if (made.bytes > bytes)
        bench_die("a slice is too large");
    cage_slice_pack(&made, room, out);
    cage_arena_release(arena, mark);
}

static struct cage_cell cell_number(int32_t n)
{
    const int32_t l = BENCH_SPACE_LEVEL, mask = (1 << l) - 1;
    const struct cage_cell cell = {l, n >> 3 * l, {n & mask, n >> l & mask, n >> 2 * l & mask}};
    return cell;
}

/* Three of the six neighbours of a cell, so that all pairs of neighbours are as many as would be glued here. */
static void neighbours_of(const struct cage_cell *cell, struct cage_cell out[NEIGHBOURS])
{
    int32_t count = 0, met = 0;
    for (int32_t n = 0; count < NEIGHBOURS && n < cage_so3.roots << 3 * BENCH_SPACE_LEVEL; n++) {
        const struct cage_cell other = cell_number(n);
        bool same = other.face == cell->face && !memcmp(other.at, cell->at, sizeof other.at);
        if (!same && cage_so3.touch(cell, &other) && met++ % 2 == 0)
            out[count++] = other;
    }
    if (count < NEIGHBOURS)
        bench_die("a cell has too few neighbours");
}

/* Seconds that gluing with the neighbours takes, and how many of these needed a mixture. */
static double glue(struct cage_arena *arena, const struct cage_slice *slice, const struct cage_slice *neighbour, int32_t seed,
                   int32_t *mixtures)
{
    double taken = 0;
    *mixtures = 0;
    for (int32_t i = 0; i < NEIGHBOURS; i++) {
        struct cage_touch *touch;
        int32_t count, mixed;
        size_t mark = arena->used;
        double start = bench_processor();
        if (cage_glue(arena, slice, &neighbour[i], seed, &touch, &count, &mixed) != CAGE_OK)
            bench_die("cage_glue failed");
        taken += bench_processor() - start;
        *mixtures += mixed;
        cage_arena_release(arena, mark);
    }
    return taken;
}

static void write_balls(FILE *file, const struct cage_side *side, const struct cage_slice *slice)
{
    static cage_ball ball[BENCH_SHELL_MOST * BENCH_HOOK_MOST];
    int32_t count = bench_all_balls(side, slice, ball);
    if (fwrite(&count, sizeof count, 1, file) != 1 || fwrite(ball, sizeof *ball, (size_t)count, file) != (size_t)count)
        bench_die("the balls were not written");
}

/* One cell: balls, those kept, components, ns of the slice, of gluing all components and of the home's alone,
 * mixtures of either. */
static void print_cell(struct cage_arena *arena, const struct bench_space *space, const struct cage_cell *cell, FILE *file)
{
    const size_t bytes = (size_t)16 << 20;
    const int32_t home[3] = {0, 0, 0};
    struct cage_cell next[NEIGHBOURS];
    struct cage_slice slice, neighbour[NEIGHBOURS];
    int32_t mixtures[2];
    size_t mark = arena->used;
    unsigned char *room = cage_arena_take(arena, NEIGHBOURS + 1, bytes);
    if (!room)
        bench_die("no memory");
    neighbours_of(cell, next);
    for (int32_t i = 0; i < NEIGHBOURS; i++)
        make_packed(arena, room + (size_t)(i + 1) * bytes, bytes, &space->side, &next[i], &neighbour[i]);
    double start = bench_processor();
    make_packed(arena, room, bytes, &space->side, cell, &slice);
    double made = bench_processor() - start;
    double all = glue(arena, &slice, neighbour, CAGE_ALL, &mixtures[0]);
    int32_t seed = cage_slice_locate(&slice, home);
    if (seed == CAGE_COVERED)
        bench_die("the hook is not at home in the shell");
    double main = glue(arena, &slice, neighbour, seed, &mixtures[1]);
    if (file) {
        printf("%d %d %d %.0f %.0f %.0f %d %d\n", (int)slice.balls, slice.t.sites - 4, slice.regions, 1e9 * made, 1e9 * all,
               1e9 * main, mixtures[0], mixtures[1]);
        write_balls(file, &space->side, &slice);
    }
    cage_arena_release(arena, mark);
}

void bench_space_print(void *block, int32_t number, const char *file)
{
    static const int32_t size[3][2] = {{100, 3}, {200, 10}, {300, 30}};
    static const double fill[2] = {1.0, 0.8};
    static struct bench_space space;
    struct cage_arena arena;
    FILE *out = fopen(file, "wb");
    if (!out)
        bench_die("the file for the balls cannot be written");
    cage_arena_init(&arena, block, BENCH_ROOM);
    bench_space_make(&arena, size[number % 3][0], size[number % 3][1], fill[number / 3], &space);
    for (int32_t i = -1; i < CELLS; i++) { /* the first time is not counted */
        const struct cage_cell cell = cell_number(101 * (i < 0 ? 0 : i) + 37);
        print_cell(&arena, &space, &cell, i < 0 ? NULL : out);
    }
    if (fclose(out) != 0)
        bench_die("the balls were not written");
}
