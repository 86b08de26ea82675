/* sets.h: the point sets of the triangulation benchmark, the same integers for libcage (C99) and for its peer (C++). */
#ifndef BENCH_SETS_H
#define BENCH_SETS_H

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Numbers of one set; ball[4 i ..] = x, y, z, r in grid units. */
struct bench_set {
    char name[32];
    int32_t dim, count;
    int32_t *ball;
};

enum { BENCH_RANDOM, BENCH_SLICE, BENCH_LATTICE, BENCH_KINDS };

#define BENCH_SETS (BENCH_KINDS * 6) /* kinds x dimensions x sizes */

/* Half the side of the box that the sets fill: well within CAGE_REACH. */
static double bench_half(int32_t dim) { return dim == 2 ? 1.0e8 : 4.0e6; }

static double bench_random(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    uint64_t mixed = (*state ^ (*state >> 29)) * 0xbf58476d1ce4e5b9u;
    return (double)((mixed ^ (mixed >> 32)) >> 11) / 9007199254740992.0;
}

static void bench_put(struct bench_set *set, int32_t i, double x, double y, double z, double r)
{
    const double value[4] = {x, y, z, r};
    for (int32_t k = 0; k < 4; k++)
        set->ball[4 * (size_t)i + (size_t)k] = (int32_t)lround(value[k]);
}

/* Uniform centres, radii up to the mean spacing: 14 % (plane) or 8 % (space) of 10 000 balls are hidden. */
static void bench_make_random(struct bench_set *set)
{
    uint64_t state = 20;
    double half = bench_half(set->dim), spacing = 2 * half / pow(set->count, 1.0 / set->dim);
    for (int32_t i = 0; i < set->count; i++) {
        double x = (2 * bench_random(&state) - 1) * half, y = (2 * bench_random(&state) - 1) * half;
        double z = set->dim == 3 ? (2 * bench_random(&state) - 1) * half : 0;
        bench_put(set, i, x, y, z, bench_random(&state) * spacing);
    }
}

/* Equal balls on a grid: nothing but ties. */
static void bench_make_lattice(struct bench_set *set)
{
    int32_t side = (int32_t)ceil(pow(set->count, 1.0 / set->dim) - 1e-9);
    double pitch = floor(2 * bench_half(set->dim) / side);
    for (int32_t i = 0; i < set->count; i++)
        bench_put(set, i, (i % side - side / 2) * pitch, (i / side % side - side / 2) * pitch,
                  set->dim == 3 ? (i / side / side - side / 2) * pitch : 0, pitch / 2);
}

/* The fence: obstacle i of n; lengths as in the scene of the whole-proof benchmark. */
static void bench_fence(int32_t i, int32_t n, double out[4])
{
    const double pi = 3.14159265358979323846, t = 2 * pi * i / n, distance = 1.9 + 0.12 * sin(9 * t);
    out[0] = distance * cos(t);
    out[1] = distance * sin(t);
    out[2] = 0;
    out[3] = 1.25 * pi * 1.9 / n;
}

/* The bracket: ball i of n along a U with legs 0.7 and base 1.0. */
static void bench_bracket(int32_t i, int32_t n, double out[4])
{
    double along = 2.4 * i / (n - 1);
    out[0] = along < 0.7 ? -0.5 : along < 1.7 ? along - 1.2 : 0.5;
    out[1] = along < 0.7 ? 0.35 - along : along < 1.7 ? -0.35 : along - 2.05;
    out[2] = 0;
    out[3] = 0.1;
}

/* A wavy shell of n balls on a Fibonacci sphere, which they cover, and an L of n balls in space. */
static void bench_shell(int32_t i, int32_t n, double out[4])
{
    const double pi = 3.14159265358979323846, z = 1 - (2 * i + 1.0) / n, t = i * pi * (3 - sqrt(5.0));
    double distance = 1.9 + 0.12 * sin(5 * t) * (1 - z * z), s = sqrt(1 - z * z);
    out[0] = distance * s * cos(t);
    out[1] = distance * s * sin(t);
    out[2] = distance * z;
    out[3] = 1.9 * sqrt(4 * pi / n) * 0.8;
}

static void bench_ell(int32_t i, int32_t n, double out[4])
{
    double along = 1.7 * i / (n - 1);
    out[0] = along < 0.7 ? -0.5 : along - 1.2;
    out[1] = along < 0.7 ? 0.35 - along : -0.35;
    out[2] = 0.1;
    out[3] = 0.1;
}

/* Obstacles minus the turned object: the collision balls of one rotation. */
static void bench_make_slice(struct bench_set *set)
{
    int32_t objects = set->count >= 100000 ? 100 : set->count >= 10000 ? 50 : 20, obstacles = set->count / objects;
    double unit = bench_half(set->dim) / 3.4, a = 0.37, b = set->dim == 3 ? 0.81 : 0;
    for (int32_t i = 0; i < objects * obstacles; i++) {
        double o[4], p[4];
        if (set->dim == 2) {
            bench_fence(i % obstacles, obstacles, o);
            bench_bracket(i / obstacles, objects, p);
        } else {
            bench_shell(i % obstacles, obstacles, o);
            bench_ell(i / obstacles, objects, p);
        }
        double x = cos(a) * p[0] - sin(a) * p[1], y = sin(a) * p[0] + cos(a) * p[1], z = p[2];
        double y2 = cos(b) * y - sin(b) * z, z2 = sin(b) * y + cos(b) * z;
        bench_put(set, i, unit * (o[0] - x), unit * (o[1] - y2), set->dim == 3 ? unit * (o[2] - z2) : 0,
                  unit * (o[3] + p[3]));
    }
}

/* Set number 0..BENCH_SETS-1: dimension slowest, then kind, then size. */
static void bench_set_make(struct bench_set *set, int32_t number)
{
    static const char *const kind[BENCH_KINDS] = {"random", "slice", "lattice"};
    static const int32_t size[3] = {1000, 10000, 100000};
    int32_t which = number / 3 % BENCH_KINDS;
    set->dim = 2 + number / (3 * BENCH_KINDS);
    set->count = size[number % 3];
    set->ball = (int32_t *)malloc((size_t)set->count * 4 * sizeof *set->ball);
    if (!set->ball)
        abort();
    strcpy(set->name, kind[which]);
    if (which == BENCH_RANDOM)
        bench_make_random(set);
    else if (which == BENCH_SLICE)
        bench_make_slice(set);
    else
        bench_make_lattice(set);
}

/* Runs that make the time of one set steady within a second or so. */
static int32_t bench_runs(const struct bench_set *set) { return set->count >= 100000 ? 3 : set->count >= 10000 ? 9 : 41; }

static int bench_by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

#endif
