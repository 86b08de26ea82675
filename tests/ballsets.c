/* ballsets.c: sets of balls for triangulations: random, lattice, cospherical, flat, coincident, nested, huge, clustered. */
#include "ballsets.h"

#include <stdbool.h>
#include <stdlib.h>

#include "support.h"

int32_t balls_reach(int32_t dim) { return dim == 2 ? CAGE_REACH_2D : CAGE_REACH_3D; }

const char *balls_text(enum balls_kind kind)
{
    static const char *const text[BALLS_KINDS] = {"random",      "tiny", "lattice", "weighted lattice",
                                                  "cospherical", "line", "plane",   "coincident",
                                                  "nested",      "huge", "corners", "clusters"};
    return text[kind];
}

static cage_ball ball_at(int32_t dim, const int64_t c[3], int64_t r)
{
    cage_ball b = {(int32_t)c[0], (int32_t)c[1], dim == 3 ? (int32_t)c[2] : 0, (int32_t)r};
    return b;
}

/* The smallest edge of a square or cube of at least count points. */
static int32_t edge_of(int32_t dim, int32_t count)
{
    int64_t edge = 1;
    while ((dim == 2 ? edge * edge : edge * edge * edge) < count)
        edge++;
    return (int32_t)edge;
}

/* Integer points of |p| = radius, at most limit of them. */
static int32_t points_on_sphere(int32_t dim, int64_t radius, int32_t limit, cage_ball *out)
{
    int32_t count = 0;
    int64_t z_end = dim == 3 ? radius : 0;
    for (int64_t z = -z_end; z <= z_end; z++) {
        int64_t y = radius; /* falls while |x| grows, so that no root is needed */
        for (int64_t x = 0; x <= radius; x++) {
            int64_t square = radius * radius - z * z - x * x;
            while (y > 0 && y * y > square)
                y--;
            if (square < 0 || y * y != square)
                continue;
            for (int quadrant = 0; quadrant < 4; quadrant++) {
                if ((x == 0 && (quadrant & 1)) || (y == 0 && (quadrant & 2)))
                    continue;
                const int64_t c[3] = {quadrant & 1 ? -x : x, quadrant & 2 ? -y : y, z};
                if (count < limit)
                    out[count++] = ball_at(dim, c, 0);
            }
        }
    }
    return count;
}

static void make_cospherical(int32_t dim, uint64_t *state, int32_t count, cage_ball *out)
{
    enum { LIMIT = 20000 };
    /* 5, 13, 17, 29 and 37 are sums of two squares: 972 points on the circle of their product. */
    int64_t radius = dim == 2 ? (count <= 60 ? 1105 : 1185665) : (count <= 60 ? 65 : 1105);
    cage_ball *all = test_alloc(LIMIT * sizeof *all);
    int32_t *order = test_alloc(LIMIT * sizeof *order);
    int32_t found = points_on_sphere(dim, radius, LIMIT, all);
    int64_t scale = test_between(state, 1, balls_reach(dim) / radius), r = test_between(state, 0, scale * radius);
    test_shuffle(state, order, found);
    for (int32_t i = 0; i < count; i++) {
        const cage_ball *from = &all[order[i % found]];
        const int64_t c[3] = {scale * from->x, scale * from->y, scale * from->z};
        out[i] = ball_at(dim, c, r);
    }
    free(all);
    free(order);
}

static void make_lattice(int32_t dim, uint64_t *state, int32_t count, bool weighted, cage_ball *out)
{
    int32_t edge = edge_of(dim, count), *order = test_alloc((size_t)count * sizeof *order);
    int64_t step = test_between(state, 2, balls_reach(dim) / edge), r = test_between(state, 0, step);
    test_shuffle(state, order, count);
    for (int32_t i = 0; i < count; i++) {
        int32_t n = order[i];
        const int64_t c[3] = {step * (n % edge - edge / 2), step * (n / edge % edge - edge / 2),
                              step * (n / edge / edge - edge / 2)};
        out[i] = ball_at(dim, c, weighted ? step / 2 * test_between(state, 0, 2) : r);
    }
    free(order);
}

/* Sums of few obstacle balls and few object balls: two nearly regular patterns folded into one another. */
static void make_clusters(int32_t dim, uint64_t *state, int32_t count, cage_ball *out)
{
    int64_t reach = balls_reach(dim), part[40][3];
    for (int i = 0; i < 40; i++)
        for (int k = 0; k < 3; k++)
            part[i][k] = (i % 3 == k ? 1 : 0) * (i - 20) * (reach / 200) + test_between(state, -5, 5);
    for (int32_t i = 0; i < count; i++) {
        if (i % 40 == 0)
            for (int k = 0; k < 3; k++)
                part[0][k] = test_between(state, -reach / 2, reach / 2);
        int64_t c[3];
        for (int k = 0; k < 3; k++)
            c[k] = part[0][k] + (i % 40 ? part[i % 40][k] : 0);
        out[i] = ball_at(dim, c, reach / 150 + test_between(state, 0, 3));
    }
}

void balls_make(enum balls_kind kind, int32_t dim, uint64_t seed, int32_t count, cage_ball *out)
{
    uint64_t state = seed * BALLS_KINDS + (uint64_t)kind;
    int64_t reach = balls_reach(dim), o[3], u[3], w[3], spot[5][3];
    for (int k = 0; k < 3; k++) {
        o[k] = test_between(&state, -reach / 4, reach / 4);
        u[k] = test_between(&state, -9, 9);
        w[k] = test_between(&state, -9, 9);
        for (int i = 0; i < 5; i++)
            spot[i][k] = test_spread(&state, reach);
    }
    if (kind == BALLS_COSPHERICAL)
        make_cospherical(dim, &state, count, out);
    else if (kind == BALLS_LATTICE || kind == BALLS_WEIGHTED)
        make_lattice(dim, &state, count, kind == BALLS_WEIGHTED, out);
    else if (kind == BALLS_CLUSTERS)
        make_clusters(dim, &state, count, out);
    else
        for (int32_t i = 0; i < count; i++) {
            int64_t c[3], s = test_between(&state, -reach / 30, reach / 30), t = test_between(&state, -reach / 30, reach / 30);
            int64_t r = test_between(&state, 0, reach / 20);
            uint64_t at = random_next(&state) % 5, big = random_next(&state) % 8;
            for (int k = 0; k < 3; k++)
                switch (kind) {
                case BALLS_TINY: c[k] = test_between(&state, -3, 3); r = test_between(&state, 0, 3); break;
                case BALLS_LINE: c[k] = o[k] + s * u[k]; break;
                case BALLS_PLANE:
                    c[k] = o[k] + s * u[k] + (dim == 3 ? t : i & 1) * w[k];
                    r = reach / 1000;
                    break;
                case BALLS_COINCIDENT: c[k] = spot[at][k]; r = test_between(&state, 0, 20); break;
                case BALLS_NESTED:
                    c[k] = big ? o[k] + s : test_between(&state, -reach, reach);
                    r = big ? r / 100 : reach / 4;
                    break;
                case BALLS_HUGE:
                    c[k] = test_between(&state, -reach, reach);
                    r = reach - (at ? test_spread(&state, reach) : 0);
                    r = r > reach ? reach : r;
                    break;
                case BALLS_CORNERS:
                    c[k] = test_between(&state, -1, 1) * reach;
                    r = big ? test_between(&state, 0, 2) * (reach / 2) : reach;
                    break;
                default: c[k] = test_between(&state, -reach, reach); break;
                }
            out[i] = ball_at(dim, c, r);
        }
}
