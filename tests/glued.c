/* glued.c: which components of two slices share a point, found from all balls of both, without pruning, barriers and
 * local mixtures. */
#include "glued.h"

#include <string.h>

#include "support.h"

/* The components of both are the same, one to one. */
static void name_components(struct glued *g)
{
    bool taken[GLUED_MOST] = {false};
    test_require(g->whole.c.count < GLUED_MOST);
    ck_assert_int_eq(g->slice.balls, g->whole.count);
    ck_assert_int_eq(g->slice.regions, g->whole.c.count);
    g->name[0] = CAGE_OUTSIDE;
    for (int32_t k = 1; k < g->whole.c.count; k++) {
        g->name[k] = whole_label(&g->slice.t, g->slice.label, &g->whole.t, g->whole.c.deep[k]);
        test_require(g->name[k] > 0 && g->name[k] < g->slice.regions && !taken[g->name[k]]);
        taken[g->name[k]] = true;
        test_require(whole_label(&g->whole.t, g->whole.c.label, &g->slice.t, g->slice.region[g->name[k]].deep) == k);
    }
}

/* Each is a vertex of a simplex: hidden ones were dropped. */
static void check_sites(const struct cage_triangulation *t)
{
    for (int32_t i = t->dim + 1; i < t->sites; i++) {
        bool used = false;
        for (int32_t s = 0; s < t->simplices && !used; s++)
            for (int32_t k = 0; k <= t->dim; k++)
                used = used || t->simplex[s].v[k] == i;
        test_require(used && t->ball[i] >= 0);
    }
}

void glued_make(struct cage_arena *arena, const struct cage_side *side, const struct cage_rotations *rotations, struct glued *out)
{
    test_require(cage_slice_make(arena, side, rotations, &out->slice) == CAGE_OK);
    whole_make(side, rotations, &out->whole);
    check_sites(&out->slice.t);
    test_require(!out->slice.whole || out->slice.inserted == out->slice.balls);
    name_components(out);
}

void glued_free(struct glued *g) { whole_free(&g->whole); }

static int32_t named(const struct glued *g, int32_t label) { return label < 0 ? label : g->name[label]; }

int32_t glued_locate(const struct glued *g, const int32_t p[3], int32_t *hint)
{
    return named(g, whole_locate(&g->whole, p, hint));
}

int32_t glued_pairs(const struct glued *c, const struct glued *d, const struct whole *mixture, bool touch[GLUED_MOST][GLUED_MOST])
{
    int32_t pairs = 0;
    memset(touch, 0, GLUED_MOST * sizeof touch[0]);
    for (int32_t m = 0; m < mixture->c.count; m++) {
        int32_t deep = mixture->c.deep[m], k = 0, l = 0;
        if (m > 0) {
            k = named(c, whole_label(&c->whole.t, c->whole.c.label, &mixture->t, deep));
            l = named(d, whole_label(&d->whole.t, d->whole.c.label, &mixture->t, deep));
        }
        test_require(k >= 0 && l >= 0);
        pairs += !touch[k][l];
        touch[k][l] = true;
    }
    return pairs;
}

bool glued_has(const struct cage_touch *touch, int32_t count, int32_t k, int32_t l)
{
    int32_t found = 0;
    for (int32_t i = 0; i < count; i++)
        found += touch[i].k == k && touch[i].l == l;
    test_require(found <= 1);
    return found == 1;
}

void glued_check(const struct cage_touch *touch, int32_t count, bool wanted[GLUED_MOST][GLUED_MOST], int32_t pairs)
{
    for (int32_t i = 0; i < count; i++) {
        if (!wanted[touch[i].k][touch[i].l])
            ck_abort_msg("components %d and %d do not touch", (int)touch[i].k, (int)touch[i].l);
        test_require(glued_has(touch, count, touch[i].k, touch[i].l));
    }
    ck_assert_int_eq(pairs, count);
}

/* open[side][k]: a component whose pairs all belong to the group; all but an outside that is not the seed spread it. */
static int32_t find_group(const struct cage_touch *all, int32_t count, int32_t seed, bool open[2][GLUED_MOST])
{
    int32_t pairs = 0;
    memset(open, 0, 2 * sizeof open[0]);
    open[0][seed] = true;
    for (bool more = true; more;) {
        more = false;
        for (int32_t i = 0; i < count; i++) {
            bool *k = &open[0][all[i].k], *l = &open[1][all[i].l], spread_k = *l && all[i].k != CAGE_OUTSIDE,
                 spread_l = *k && all[i].l != CAGE_OUTSIDE;
            more = more || (spread_k && !*k) || (spread_l && !*l);
            *k = *k || spread_k;
            *l = *l || spread_l;
        }
    }
    for (int32_t i = 0; i < count; i++)
        pairs += open[0][all[i].k] || open[1][all[i].l];
    return pairs;
}

int32_t glued_check_seeds(struct cage_arena *arena, const struct cage_slice *c, const struct cage_slice *d,
                          const struct cage_touch *all, int32_t count)
{
    int32_t sum = 0;
    for (int32_t seed = 0; seed < c->regions; seed++) {
        bool open[2][GLUED_MOST];
        struct cage_touch *touch;
        int32_t got, mixed, pairs = find_group(all, count, seed, open);
        size_t mark = arena->used;
        ck_assert_int_eq(cage_glue(arena, c, d, seed, &touch, &got, &mixed), CAGE_OK);
        for (int32_t i = 0; i < count; i++)
            if (glued_has(touch, got, all[i].k, all[i].l) != (open[0][all[i].k] || open[1][all[i].l]))
                ck_abort_msg("seed %d: the pair %d %d", (int)seed, (int)all[i].k, (int)all[i].l);
        ck_assert_int_eq(got, pairs);
        cage_arena_release(arena, mark);
        sum += pairs;
    }
    return sum;
}
