/* bench.c: times triangulations and whole proofs: `bench` prints tables, `bench SET [RUNS]` one line as peer_cgal does,
 * `bench space SCENE FILE` one for each slice, `bench uniform`, `bench atlas` the last tables alone. */
#include <stdio.h>
#include <time.h>

#include "../../src/delaunay.h"
#include "../../src/fibre.h"
#include "../../src/prune.h"
#include "bench.h"
#include "sets.h"

static unsigned char *block;

void bench_die(const char *what)
{
    fprintf(stderr, "bench: %s\n", what);
    exit(1);
}

double bench_now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

double bench_processor(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* ---- one set ------------------------------------------------------------------------------------ */

struct timing {
    double best, median; /* ns a ball */
    int32_t simplices, vertices; /* finite ones; sites in some simplex */
};

static void count(const struct cage_triangulation *t, struct timing *out)
{
    unsigned char *seen = calloc((size_t)t->sites, 1);
    if (!seen)
        bench_die("no memory");
    out->simplices = out->vertices = 0;
    for (int32_t s = 0; s < t->simplices; s++) {
        bool finite = true;
        for (int32_t i = 0; i <= t->dim; i++) {
            finite = finite && t->simplex[s].v[i] > t->dim;
            seen[t->simplex[s].v[i]] = 1;
        }
        out->simplices += finite;
    }
    for (int32_t i = t->dim + 1; i < t->sites; i++)
        out->vertices += seen[i];
    free(seen);
}

static void time_set(const struct bench_set *set, int32_t runs, struct timing *out)
{
    cage_ball *ball = malloc((size_t)set->count * sizeof *ball);
    double *ns = malloc((size_t)runs * sizeof *ns);
    if (!ball || !ns)
        bench_die("no memory");
    for (int32_t i = 0; i < set->count; i++) {
        const int32_t *b = set->ball + 4 * (size_t)i;
        const cage_ball made = {b[0], b[1], b[2], b[3]};
        ball[i] = made;
    }
    for (int32_t i = 0; i < runs; i++) {
        struct cage_arena arena;
        struct cage_triangulation t;
        cage_arena_init(&arena, block, BENCH_ROOM);
        double start = bench_now();
        if (cage_delaunay(&arena, &cage_all_shortcuts, set->dim, ball, set->count, &t) != CAGE_OK)
            bench_die("cage_delaunay failed");
        ns[i] = (bench_now() - start) * 1e9 / set->count;
        if (i == 0)
            count(&t, out);
    }
    qsort(ns, (size_t)runs, sizeof *ns, bench_by_value);
    out->best = ns[0];
    out->median = ns[runs / 2];
    free(ball);
    free(ns);
}

static void print_sets(void)
{
    printf("triangulation, ns a ball, spatial sort included\n");
    printf("  %-8s %3s %7s %9s %9s %10s %9s\n", "set", "dim", "balls", "best", "median", "simplices", "vertices");
    for (int32_t i = 0; i < BENCH_SETS; i++) {
        struct bench_set set;
        struct timing t;
        bench_set_make(&set, i);
        time_set(&set, bench_runs(&set), &t);
        printf("  %-8s %3d %7d %9.1f %9.1f %10d %9d\n", set.name, set.dim, set.count, t.best, t.median, t.simplices,
               t.vertices);
        fflush(stdout);
        free(set.ball);
    }
}

/* ---- the fence ---------------------------------------------------------------------------------- */

enum { OBSTACLES = 200, OBJECTS = 40 };

struct fence {
    cage_ball obstacle[OBSTACLES], object[OBJECTS];
    cage_scene scene;
};

static void make_fence(struct fence *fence)
{
    const double unit = CAGE_REACH_2D / 5.0;
    double b[4];
    for (int32_t i = 0; i < OBSTACLES + OBJECTS; i++) {
        if (i < OBSTACLES)
            bench_fence(i, OBSTACLES, b);
        else
            bench_bracket(i - OBSTACLES, OBJECTS, b);
        const cage_ball made = {(int32_t)lround(unit * b[0]), (int32_t)lround(unit * b[1]), 0, (int32_t)floor(unit * b[3])};
        *(i < OBSTACLES ? &fence->obstacle[i] : &fence->object[i - OBSTACLES]) = made;
    }
    const cage_shape object = {fence->object, fence->object, OBJECTS, OBJECTS};
    const cage_shape obstacles = {fence->obstacle, fence->obstacle, OBSTACLES, OBSTACLES};
    const cage_scene scene = {object, obstacles, 2};
    fence->scene = scene;
    if (cage_scene_check(&fence->scene) != CAGE_OK)
        bench_die("the fence does not fit");
}

/* Seconds of the whole proof, the best and the median of the runs. */
static void prove(const struct fence *fence, const cage_limits *limits, int32_t runs, double seconds[2], cage_result *result)
{
    double time[64];
    const cage_pose start = {{0, 0, 0}, {1, 0, 0, 0}};
    for (int32_t i = 0; i < runs; i++) {
        cage_proof *proof;
        double began = bench_now();
        if (cage_prove_begin(&proof, &fence->scene, &start, NULL, limits, block, BENCH_ROOM) != CAGE_OK ||
            cage_prove_run(proof, INT64_MAX) != 1)
            bench_die("the proof failed");
        time[i] = bench_now() - began;
        *result = *cage_prove_result(proof);
    }
    qsort(time, (size_t)runs, sizeof *time, bench_by_value);
    seconds[0] = time[0];
    seconds[1] = time[runs / 2];
}

static void print_proof(const char *name, const double seconds[2], const cage_result *r)
{
    printf("  %-18s %9s %8.4f %8.4f %6d %7d %6d %9d %9lld %9lld %6lld\n", name, cage_verdict_text(r->verdict), seconds[0],
           seconds[1], r->cells, r->slices[0], r->gluings[0], r->mixtures[0], (long long)r->balls[0],
           (long long)r->inserted[0], (long long)r->steps);
}

int32_t bench_all_balls(const struct cage_side *side, const struct cage_slice *slice, cage_ball *ball)
{
    int32_t n = 0;
    for (int32_t a = 0; a < side->objects; a++)
        for (int32_t j = 0; j < side->obstacles; j++) {
            const cage_ball *x = &side->obstacle[j];
            const struct cage_part *part = &slice->part[a];
            const cage_ball made = {x->x - part->at[0], x->y - part->at[1], x->z - part->at[2],
                                    x->r + side->object[a].r + part->change};
            if (made.r >= 0)
                ball[n++] = made;
        }
    return n;
}

static int32_t kept_balls(const struct cage_slice *slice, cage_ball *ball)
{
    int32_t n = 0;
    for (int32_t i = slice->t.dim + 1; i < slice->t.sites; i++) {
        const struct cage_site *s = &slice->t.site[i];
        const cage_ball made = {s->x, s->y, s->z, s->r};
        ball[n++] = made;
    }
    return n;
}

/* Seconds that the triangulation of these balls takes alone. */
static double triangulate(struct cage_arena *arena, const cage_ball *ball, int32_t balls)
{
    struct cage_triangulation t;
    size_t mark = arena->used;
    double start = bench_now();
    if (cage_delaunay(arena, &cage_all_shortcuts, 2, ball, balls, &t) != CAGE_OK)
        bench_die("cage_delaunay failed");
    double taken = bench_now() - start;
    cage_arena_release(arena, mark);
    return taken;
}

/* Seconds that choosing the balls to keep takes. */
static double choose(struct cage_arena *arena, cage_ball *ball, int32_t balls)
{
    static int32_t of[OBSTACLES * OBJECTS];
    struct cage_raster raster;
    size_t mark = arena->used;
    double start = bench_now();
    if (cage_prune(arena, 2, ball, of, &balls, &raster) != CAGE_OK)
        bench_die("cage_prune failed");
    double taken = bench_now() - start;
    cage_arena_release(arena, mark);
    return taken;
}

/* The triangulations of all slices of a level: [0] of the balls kept, [1] of all balls, [2] of the balls kept and the
 * choice of them; slices: seconds to make the slices. */
static void triangulations(const struct fence *fence, const cage_result *result, int32_t level, double seconds[3], double *slices)
{
    static cage_ball ball[OBSTACLES * OBJECTS];
    struct cage_arena arena;
    struct cage_side side;
    cage_arena_init(&arena, block, BENCH_ROOM);
    if (cage_side_make(&arena, &fence->scene, result->pivot, -1, &cage_all_shortcuts, &side) != CAGE_OK)
        bench_die("cage_side_make failed");
    seconds[0] = seconds[1] = seconds[2] = *slices = 0;
    for (int32_t face = 0; face < cage_so2.roots; face++)
        for (int32_t at = 0; at < 1 << level; at++) {
            const struct cage_cell cell = {level, face, {at, 0, 0}};
            struct cage_rotations rotations;
            struct cage_slice slice;
            cage_so2.representative(&cell, rotations.q);
            rotations.turn = cage_so2.turn(&cell);
            size_t mark = arena.used;
            double start = bench_now();
            if (cage_slice_make(&arena, &side, &rotations, &slice) != CAGE_OK)
                bench_die("cage_slice_make failed");
            *slices += bench_now() - start;
            seconds[0] += triangulate(&arena, ball, kept_balls(&slice, ball));
            int32_t all = bench_all_balls(&side, &slice, ball);
            seconds[1] += triangulate(&arena, ball, all);
            seconds[2] += choose(&arena, ball, all);
            cage_arena_release(&arena, mark);
        }
    seconds[2] += seconds[0];
}

/* Whole proofs over uniform cells and the triangulations of the same slices, in turns; prints medians, and their ratios. */
static void print_uniform(const struct fence *fence, int32_t level)
{
    enum { ROUNDS = 5 };
    const int32_t cells = 2 << level;
    double time[5][ROUNDS], ratio[5][ROUNDS];
    cage_limits limits;
    cage_result result;
    cage_limits_default(&limits, 2);
    limits.side = CAGE_SIDE_INNER;
    limits.start_level = limits.max_level = level;
    for (int32_t i = 0; i < ROUNDS; i++) {
        double seconds[2], alone[3], slices;
        prove(fence, &limits, 1, seconds, &result);
        triangulations(fence, &result, level, alone, &slices);
        const double all[5] = {seconds[0], alone[0], alone[1], alone[2], slices};
        for (int32_t k = 0; k < 5; k++) {
            time[k][i] = all[k];
            ratio[k][i] = all[0] / all[k];
        }
    }
    for (int32_t k = 0; k < 5; k++) {
        qsort(time[k], ROUNDS, sizeof *time[k], bench_by_value);
        qsort(ratio[k], ROUNDS, sizeof *ratio[k], bench_by_value);
    }
    const double seconds[2] = {time[0][0], time[0][ROUNDS / 2]};
    char name[32];
    snprintf(name, sizeof name, "%d uniform cells", cells);
    print_proof(name, seconds, &result);
    printf("  %-18s %9s %8.4f %8.4f\n", "  ... as 180 cells", "", seconds[0] * 180 / cells, seconds[1] * 180 / cells);
    printf("  %-18s %9s %8.3f of all balls, %.3f of those kept, %.3f of choosing and triangulating them, %.3f of slices\n",
           "  ... by the time of", "triang.", ratio[2][ROUNDS / 2], ratio[1][ROUNDS / 2], ratio[3][ROUNDS / 2],
           ratio[4][ROUNDS / 2]);
}

static void print_fence(void)
{
    static struct fence fence;
    cage_limits limits;
    cage_result result;
    double seconds[2];
    make_fence(&fence);
    printf("\nfence scene, seconds of whole proofs (200 x 40 balls); counts of the inner side\n");
    printf("  %-18s %9s %8s %8s %6s %7s %6s %9s %9s %9s %6s\n", "limits", "verdict", "best", "median", "cells", "slices",
           "glued", "mixtures", "balls", "inserted", "steps");
    cage_limits_default(&limits, 2);
    prove(&fence, &limits, 9, seconds, &result);
    print_proof("default", seconds, &result);
    if (result.verdict != CAGE_CAGED)
        bench_die("the fence must be proved CAGED");
    print_uniform(&fence, 6);
    print_uniform(&fence, 7);
}

void bench_fence_make(cage_scene *scene)
{
    static struct fence fence;
    make_fence(&fence);
    *scene = fence.scene;
}

static void print_set(int number, int runs)
{
    struct bench_set set;
    struct timing t;
    if (number < 0 || number >= BENCH_SETS)
        bench_die("usage: bench [SET [RUNS] | fence | space SCENE FILE | uniform | atlas]");
    bench_set_make(&set, number);
    time_set(&set, runs > 0 ? runs : bench_runs(&set), &t);
    printf("%s %d %d %.1f %.1f %d %d\n", set.name, set.dim, set.count, t.best, t.median, t.simplices, t.vertices);
    free(set.ball);
}

int main(int argc, char **argv)
{
    block = malloc(BENCH_ROOM);
    if (!block)
        bench_die("no memory");
    if (argc > 3 && !strcmp(argv[1], "space")) {
        bench_space_print(block, atoi(argv[2]), argv[3]);
    } else if (argc > 1 && !strcmp(argv[1], "uniform")) {
        bench_uniform_print(block);
    } else if (argc > 1 && !strcmp(argv[1], "atlas")) {
        bench_atlas_print(block);
    } else if (argc > 1 && !strcmp(argv[1], "fence")) {
        print_fence();
    } else if (argc > 1) {
        print_set(atoi(argv[1]), argc > 2 ? atoi(argv[2]) : 0);
    } else {
        print_sets();
        print_fence();
        bench_uniform_print(block);
        bench_atlas_print(block);
    }
    free(block);
    return 0;
}
