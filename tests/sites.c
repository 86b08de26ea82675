/* sites.c: batches of sites that are hard for predicates: tiny, huge, on lattices, spheres, lines, and sentinels. */
#include "sites.h"

#include "exact.h"
#include "support.h"

const int sites_pythagoras[2][6][4] = {
    {{3, 4, 0, 5}, {5, 12, 0, 13}, {8, 15, 0, 17}, {7, 24, 0, 25}, {20, 21, 0, 29}, {0, 1, 0, 1}},
    {{1, 2, 2, 3}, {2, 3, 6, 7}, {1, 4, 8, 9}, {4, 4, 7, 9}, {2, 6, 9, 11}, {0, 3, 4, 5}}};

int64_t sites_largest(int dim) { return dim == 2 ? INT64_C(1) << 29 : INT64_C(1) << 24; }

struct cage_site sites_ball(int dim, int64_t x, int64_t y, int64_t z, int64_t r)
{
    struct cage_site s = {0, (int32_t)x, (int32_t)y, dim == 3 ? (int32_t)z : 0, (int32_t)r};
    s.h = (int64_t)s.x * s.x + (int64_t)s.y * s.y + (int64_t)s.z * s.z - (int64_t)s.r * s.r;
    return s;
}

struct cage_site sites_sentinel(int dim, int i)
{
    static const int sign[2][4][3] = {{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}, {0, 0, 0}},
                                      {{1, 1, 1}, {1, -1, -1}, {-1, -1, 1}, {-1, 1, -1}}};
    const int *at = sign[dim - 2][i];
    int64_t m = sites_largest(dim);
    struct cage_site s = sites_ball(dim, at[0] * m, at[1] * m, at[2] * m, 0);
    s.h++;
    return s;
}

/* One coordinate, and the radius, of a site that has no shape to keep. */
static int64_t coordinate(uint64_t *state, int dim, enum sites_kind kind, int64_t *r)
{
    int64_t m = sites_largest(dim), third = m / 3, half = third / 2;
    switch (kind) {
    case SITES_TINY: *r = test_between(state, 0, 3); return test_between(state, -3, 3);
    case SITES_SPREAD: *r = test_spread(state, third); return test_spread(state, third);
    case SITES_CORNERS:
        *r = test_between(state, 0, 1) * (m - test_between(state, 0, 1));
        return test_between(state, -1, 1) * (m - test_between(state, 0, 1));
    case SITES_LATTICE: *r = test_between(state, 0, 2) * half; return test_between(state, -2, 2) * half;
    default: *r = test_between(state, 0, third); return test_between(state, -third, third);
    }
}

/* A vector of length size * row[3] with the entries of size * row in some order, of some sign. */
static void turned(uint64_t *state, const int row[4], bool flat, int64_t size, int64_t out[3])
{
    int turn = (int)(random_next(state) % 3);
    for (int k = 0; k < 3; k++) {
        int from = !flat ? (k + turn) % 3 : k == 2 ? 2 : k ^ (turn & 1);
        out[k] = (random_next(state) & 1 ? size : -size) * row[from];
    }
}

void sites_make(uint64_t *state, int dim, enum sites_kind kind, int count, struct cage_site *out)
{
    int64_t third = sites_largest(dim) / 3, o[3], u[3], r;
    int64_t scale = 1 + test_between(state, 0, third / 100) / (random_next(state) % 3 ? 3000 : 1);
    int row = (int)(random_next(state) % 6);
    for (int k = 0; k < 3; k++) {
        o[k] = test_spread(state, third / 4);
        u[k] = test_spread(state, 1000);
    }
    for (int i = 0; i < count; i++) {
        int64_t c[3], t = test_between(state, -third / 2000, third / 2000), size = 1 + test_between(state, 0, scale);
        for (int k = 0; k < 3; k++)
            c[k] = coordinate(state, dim, kind, &r);
        if (kind == SITES_THIN || kind == SITES_COINCIDENT) {
            bool away = random_next(state) % 3 == 0;
            for (int k = 0; k < 3; k++)
                c[k] = o[k] + (kind == SITES_THIN ? t * u[k] + test_between(state, -1, 1) : away ? u[k] : 0);
            r = test_spread(state, kind == SITES_THIN ? third : 4);
        } else if (kind == SITES_THROUGH_POINT || kind == SITES_COSPHERICAL || (kind == SITES_IN_PLANE && dim == 3)) {
            bool flat = dim == 2 || kind == SITES_IN_PLANE, same = kind == SITES_COSPHERICAL;
            const int *numbers = sites_pythagoras[!flat][same ? row : (int)(random_next(state) % 6)];
            turned(state, numbers, flat, same ? scale : size, c);
            r = same ? random_next(state) % 16 == 0 : size * numbers[3] + (random_next(state) % 8 == 0);
        } else if (kind == SITES_IN_PLANE) {
            for (int k = 0; k < 3; k++)
                c[k] = (i & 1 ? size : -size) * sites_pythagoras[0][row][k];
            r = size * sites_pythagoras[0][row][3] + (random_next(state) % 8 == 0);
        }
        for (int k = 0; k < 3 && (kind == SITES_THROUGH_POINT || kind == SITES_COSPHERICAL || kind == SITES_IN_PLANE); k++)
            c[k] += o[k];
        out[i] = sites_ball(dim, c[0], c[1], c[2], r < 0 ? -r : r);
        if (kind == SITES_SENTINELS && random_next(state) & 1)
            out[i] = sites_sentinel(dim, (int)(random_next(state) % (unsigned)(dim + 1)));
    }
}

bool sites_sentinel_among(int count, const struct cage_site *const v[])
{
    for (int i = 0; i < count; i++)
        if (v[i]->h > (int64_t)v[i]->x * v[i]->x + (int64_t)v[i]->y * v[i]->y + (int64_t)v[i]->z * v[i]->z)
            return true;
    return false;
}

bool sites_orient(int dim, const struct cage_site *v[4])
{
    int sign = exact_orientation(dim, v);
    if (sign < 0) {
        const struct cage_site *swap = v[0];
        v[0] = v[1];
        v[1] = swap;
    }
    return sign != 0;
}
