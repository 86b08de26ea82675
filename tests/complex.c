/* complex.c: a triangulation as a set of simplices, found by its definition, compared, and checked part by part. */
#include "complex.h"

#include <stdlib.h>
#include <string.h>

#include "ballsets.h"
#include "exact.h"
#include "support.h"

void complex_build(int32_t dim, const cage_ball *ball, int32_t count, int dirt, struct built *out)
{
    for (size_t bytes = 4096 + (size_t)count * 1024;; bytes *= 2) {
        out->block = test_alloc(bytes);
        memset(out->block, dirt, bytes);
        struct cage_arena arena;
        cage_arena_init(&arena, out->block, bytes);
        int32_t got = cage_delaunay(&arena, &cage_all_shortcuts, dim, ball, count, &out->t);
        if (got == CAGE_OK)
            return;
        test_require(got == CAGE_ERROR_MEMORY);
        test_require(bytes < SIZE_MAX / 4);
        free(out->block);
    }
}

void complex_build_free(struct built *b) { free(b->block); }

static int compare_rows(const void *a, const void *b)
{
    const int32_t *p = a, *q = b;
    for (int i = 0; i < 4; i++)
        if (p[i] != q[i])
            return p[i] < q[i] ? -1 : 1;
    return 0;
}

static void set_row(int32_t row[4], int32_t dim, const int32_t *name, const int32_t v[4])
{
    row[3] = -1;
    for (int32_t i = 0; i <= dim; i++) {
        int32_t n = name ? name[v[i]] : v[i], k = i;
        for (; k > 0 && row[k - 1] > n; k--)
            row[k] = row[k - 1];
        row[k] = n;
    }
}

void complex_of(const struct cage_triangulation *t, const int32_t *name, struct complex *out)
{
    out->count = t->simplices;
    out->row = test_alloc((size_t)t->simplices * sizeof *out->row);
    for (int32_t s = 0; s < t->simplices; s++)
        set_row(out->row[s], t->dim, name, t->simplex[s].v);
    qsort(out->row, (size_t)out->count, sizeof *out->row, compare_rows);
}

/* The next subset of k numbers below n in ascending order; false after the last. */
static bool next_subset(int32_t *v, int32_t k, int32_t n)
{
    int32_t i = k - 1;
    while (i >= 0 && v[i] == n - k + i)
        i--;
    if (i < 0)
        return false;
    v[i]++;
    for (int32_t j = i + 1; j < k; j++)
        v[j] = v[j - 1] + 1;
    return true;
}

void complex_define(int32_t dim, const struct cage_site *site, int32_t sites, struct complex *out)
{
    int32_t v[4] = {0, 1, 2, 3}, room = 16;
    long ties = 0;
    out->count = 0;
    out->row = test_alloc((size_t)room * sizeof *out->row);
    do {
        int32_t turned[4] = {v[0], v[1], v[2], v[3]};
        const struct cage_site *corner[4] = {0};
        for (int32_t i = 0; i <= dim; i++)
            corner[i] = &site[v[i]];
        int orientation = exact_orientation(dim, corner);
        if (orientation < 0) {
            turned[0] = v[1];
            turned[1] = v[0];
        }
        bool lowest = orientation != 0;
        for (int32_t p = 0; p < sites && lowest; p++) {
            bool vertex = false;
            for (int32_t i = 0; i <= dim; i++)
                vertex = vertex || v[i] == p;
            lowest = vertex || exact_above(dim, site, turned, p, &ties) > 0;
        }
        if (!lowest)
            continue;
        if (out->count == room) {
            room *= 2;
            out->row = realloc(out->row, (size_t)room * sizeof *out->row);
            test_require(out->row != NULL);
        }
        set_row(out->row[out->count++], dim, NULL, v);
    } while (next_subset(v, dim + 1, sites));
    qsort(out->row, (size_t)out->count, sizeof *out->row, compare_rows);
}

bool complex_equal(const struct complex *a, const struct complex *b)
{
    return a->count == b->count && memcmp(a->row, b->row, (size_t)a->count * sizeof *a->row) == 0;
}

bool complex_has(const struct complex *c, const int32_t row[4])
{
    return bsearch(row, c->row, (size_t)c->count, sizeof *c->row, compare_rows) != NULL;
}

void complex_free(struct complex *c) { free(c->row); }

int32_t *complex_names(const struct cage_triangulation *t, const int32_t *to)
{
    int32_t *name = test_alloc((size_t)t->sites * sizeof *name);
    for (int32_t s = 0; s < t->sites; s++)
        name[s] = t->ball[s] < 0 ? s : t->dim + 1 + (to ? to[t->ball[s]] : t->ball[s]);
    return name;
}

static int64_t norm(const struct cage_site *s)
{
    return (int64_t)s->x * s->x + (int64_t)s->y * s->y + (int64_t)s->z * s->z;
}

/* Sentinels of weight -1 around all that is legal, then the balls, each once. */
static void check_sites(const struct cage_triangulation *t, const cage_ball *ball, int32_t count)
{
    int64_t m = t->dim == 2 ? 1 << 29 : 1 << 24, reach = balls_reach(t->dim);
    const struct cage_site *corner[4];
    test_require(t->sites == t->dim + 1 + count);
    for (int32_t s = 0; s <= t->dim; s++) {
        corner[s] = &t->site[s];
        test_require(t->ball[s] == -1 && t->site[s].h == norm(&t->site[s]) + 1 && t->site[s].r == 0);
        test_require(t->site[s].x <= m && t->site[s].x >= -m && t->site[s].y <= m && t->site[s].y >= -m);
        test_require(t->site[s].z <= m && t->site[s].z >= -m);
    }
    test_require(exact_orientation(t->dim, corner) > 0);
    for (int32_t s = 0; s <= t->dim; s++)
        for (int box = 0; box < (t->dim == 2 ? 4 : 8); box++) {
            const struct cage_site end = {0, (int32_t)(box & 1 ? reach : -reach), (int32_t)(box & 2 ? reach : -reach),
                                          t->dim == 2 ? 0 : (int32_t)(box & 4 ? reach : -reach), 0};
            corner[s] = &end;
            test_require(exact_orientation(t->dim, corner) > 0);
            corner[s] = &t->site[s];
        }
    unsigned char *seen = test_alloc((size_t)count);
    memset(seen, 0, (size_t)count);
    for (int32_t s = t->dim + 1; s < t->sites; s++) {
        int32_t b = t->ball[s];
        const struct cage_site *site = &t->site[s];
        test_require(b >= 0 && b < count && !seen[b]);
        seen[b] = 1;
        test_require(site->x == ball[b].x && site->y == ball[b].y && site->z == ball[b].z && site->r == ball[b].r);
        test_require(site->h == norm(site) - (int64_t)site->r * site->r);
    }
    free(seen);
}

/* Facet i of simplex s: its twin names it back, has the same vertices, and the vertex beyond lies above. */
static void check_facet(const struct cage_triangulation *t, int32_t s, int32_t i, int32_t *hull, long *ties)
{
    const struct cage_simplex *here = &t->simplex[s];
    if (here->twin[i] == CAGE_HULL) {
        ++*hull;
        for (int32_t k = 0; k <= t->dim; k++)
            test_require(k == i || here->v[k] <= t->dim);
        return;
    }
    int32_t other = here->twin[i] >> 2, j = here->twin[i] & 3;
    test_require(here->twin[i] >= 0 && other < t->simplices && other != s && j <= t->dim);
    const struct cage_simplex *there = &t->simplex[other];
    test_require(there->twin[j] == 4 * s + i);
    for (int32_t k = 0; k <= t->dim; k++) {
        bool shared = false;
        for (int32_t l = 0; l <= t->dim; l++)
            shared = shared || there->v[l] == here->v[k];
        test_require(shared == (k != i));
    }
    if (s < other)
        test_require(exact_above(t->dim, t->site, here->v, there->v[j], ties) > 0);
}

static int compare_edges(const void *a, const void *b)
{
    const uint64_t p = *(const uint64_t *)a, q = *(const uint64_t *)b;
    return p < q ? -1 : p > q;
}

static int32_t count_edges(const struct cage_triangulation *t)
{
    uint64_t *edge = test_alloc((size_t)t->simplices * 6 * sizeof *edge);
    size_t count = 0;
    int32_t distinct = 0;
    for (int32_t s = 0; s < t->simplices; s++)
        for (int32_t i = 0; i <= t->dim; i++)
            for (int32_t k = 0; k < i; k++) {
                uint64_t a = (uint64_t)t->simplex[s].v[i], b = (uint64_t)t->simplex[s].v[k];
                edge[count++] = a < b ? a << 32 | b : b << 32 | a;
            }
    qsort(edge, count, sizeof *edge, compare_edges);
    for (size_t n = 0; n < count; n++)
        distinct += n == 0 || edge[n] != edge[n - 1];
    free(edge);
    return distinct;
}

/* A site in no simplex lies above the one that contains it. */
static void check_hidden(const struct cage_triangulation *t, int32_t p, long *ties)
{
    const int32_t at[3] = {t->site[p].x, t->site[p].y, t->site[p].z};
    int32_t s = cage_delaunay_locate(t, at, t->simplices / 2);
    test_require(s >= 0 && s < t->simplices);
    for (int32_t i = 0; i <= t->dim; i++) {
        const struct cage_site *v[4];
        cage_simplex_sites(t, s, v);
        v[i] = &t->site[p];
        test_require(exact_orientation(t->dim, v) >= 0);
    }
    test_require(exact_above(t->dim, t->site, t->simplex[s].v, p, ties) > 0);
}

long complex_validate(const struct cage_triangulation *t, const cage_ball *ball, int32_t count)
{
    long ties = 0;
    int32_t hull = 0, visible = 0;
    unsigned char *used = test_alloc((size_t)t->sites);
    mpz_t volume, total;
    mpz_inits(volume, total, NULL);
    memset(used, 0, (size_t)t->sites);
    check_sites(t, ball, count);
    for (int32_t s = 0; s < t->simplices; s++) {
        const struct cage_site *v[4];
        for (int32_t i = 0; i <= t->dim; i++) {
            test_require(t->simplex[s].v[i] >= 0 && t->simplex[s].v[i] < t->sites);
            used[t->simplex[s].v[i]] = 1;
            check_facet(t, s, i, &hull, &ties);
        }
        cage_simplex_sites(t, s, v);
        exact_volume(t->dim, v, volume);
        test_require(mpz_sgn(volume) > 0);
        mpz_add(total, total, volume);
    }
    const struct cage_site *outer[4] = {&t->site[0], &t->site[1], &t->site[2], &t->site[t->dim]};
    exact_volume(t->dim, outer, volume);
    test_require(mpz_cmp(volume, total) == 0);
    test_require(hull == t->dim + 1);
    for (int32_t p = 0; p < t->sites; p++) {
        visible += used[p];
        test_require(used[p] || p > t->dim);
        if (!used[p])
            check_hidden(t, p, &ties);
    }
    if (t->dim == 2)
        test_require(t->simplices == 2 * visible - 5);
    else /* vertices - edges + triangles - tetrahedra of a ball is 1, and it has 4 t + 4 = 2 triangles */
        test_require(visible - count_edges(t) + (4 * t->simplices + 4) / 2 - t->simplices == 1);
    free(used);
    mpz_clears(volume, total, NULL);
    return ties;
}
