/* glue: which components of neighbouring slices share a point.
 *
 * Two cheap proofs decide nearly every pair of components K of slice c and L of slice d.
 *
 * They touch: a known grid point of one lies in the other.
 *
 * They do not: let R be the union of the full simplices of c reached from those labelled K without crossing a facet that
 * is proved to lie in the union of the closed balls of d (a barrier). K lies in R (location lemma), L is connected and meets no
 * barrier, so L lies in R or off it: one point of L tells. R extends beyond the sentinels' simplex iff it holds a
 * simplex with a sentinel, and the outside of d always does. For a barrier, take the facet's own balls as they are in d, shrunk
 * by how far they moved: B(z, r' - |z - z'|) lies in B(z', r').
 *
 * What is left undecided is settled for all pairs at once by the components of the union of both slices' balls: each lies in
 * one component of c and one of d (or in a phantom of one, see prune), told by its witness. */
#include "glue.h"
#include "grid.h"

enum { UNDECIDED = 0, APART = 1, TOUCHING = 2 };

struct glue {
    struct cage_arena *arena;
    const struct cage_slice *c, *d;
    int32_t *shrink;  /* for each part: what turns a radius of c into that of a ball inside the one of d */
    int32_t *reached; /* for each simplex of c: last label that reached it, -1: none */
    int32_t *stack;
    int32_t *home; /* for each component of d: the simplex of c that holds its point, -1 if it has none */
};

static bool is_barrier(const struct glue *g, int32_t s, int32_t i)
{
    const struct cage_triangulation *t = &g->c->t;
    const struct cage_site *face[3];
    struct cage_site shrunk[3];
    for (int32_t k = 0, n = 0; k <= t->dim; k++) {
        if (k == i)
            continue;
        int32_t v = t->simplex[s].v[k];
        if (v <= t->dim)
            return false;
        struct cage_site *site = &shrunk[n];
        *site = t->site[v];
        int32_t radius = site->r + g->shrink[t->ball[v]];
        if (radius < 0)
            return false;
        site->h += (int64_t)site->r * site->r - (int64_t)radius * radius;
        site->r = radius;
        face[n++] = site;
    }
    return cage_facet_covered(t->dim, face);
}

/* Mark R of component k; whether it holds a simplex with a sentinel. */
static bool spread(const struct glue *g, int32_t k)
{
    const struct cage_triangulation *t = &g->c->t;
    int32_t depth = 0;
    bool outer = false;
    for (int32_t s = 0; s < t->simplices; s++)
        if (g->c->label[s] == k) {
            g->reached[s] = k;
            g->stack[depth++] = s;
        }
    while (depth > 0) {
        int32_t s = g->stack[--depth];
        outer = outer || cage_simplex_outer(t, s);
        for (int32_t i = 0; i <= t->dim; i++) {
            int32_t twin = t->simplex[s].twin[i];
            if (twin == CAGE_HULL || g->reached[twin >> 2] == k || is_barrier(g, s, i))
                continue;
            g->reached[twin >> 2] = k;
            g->stack[depth++] = twin >> 2;
        }
    }
    return outer;
}

/* A common point of the two, if one of the known points is one. */
static bool common_point(const struct glue *g, int32_t k, int32_t l, int32_t x[3])
{
    const struct cage_region *a = &g->c->region[k], *b = &g->d->region[l];
    const int32_t *point = NULL;
    if (k == CAGE_OUTSIDE && l == CAGE_OUTSIDE)
        point = a->point[1] > b->point[1] ? a->point : b->point; /* above both bounding boxes */
    else if (b->known && g->home[l] >= 0 && g->c->label[g->home[l]] == k && cage_slice_clear(g->c, b->point))
        point = b->point;
    else if (a->known && cage_slice_locate(g->d, a->point) == l)
        point = a->point;
    for (int32_t i = 0; point && i < 3; i++)
        x[i] = point[i];
    return point != NULL;
}

static int32_t decide(const struct glue *g, int32_t k, int32_t l, bool outer, int32_t x[3])
{
    if (l == CAGE_OUTSIDE ? !outer : g->home[l] >= 0 && g->reached[g->home[l]] != k)
        return APART;
    return common_point(g, k, l, x) ? TOUCHING : UNDECIDED;
}

/* Decide all pairs by the two proofs; false as soon as one stays undecided. */
static bool glue_by_proof(struct glue *g, struct cage_touch *touch, int32_t room, int32_t *count)
{
    for (int32_t s = 0; s < g->c->t.simplices; s++)
        g->reached[s] = -1;
    for (int32_t l = 0; l < g->d->regions; l++)
        g->home[l] = g->d->region[l].known ? cage_delaunay_locate(&g->c->t, g->d->region[l].point, 0) : -1;
    for (int32_t k = 0; k < g->c->regions; k++) {
        bool outer = spread(g, k);
        for (int32_t l = 0; l < g->d->regions; l++) {
            int32_t x[3], verdict = decide(g, k, l, outer, x);
            if (verdict == UNDECIDED || (verdict == TOUCHING && *count == room))
                return false;
            if (verdict == TOUCHING) {
                struct cage_touch made = {k, l, {x[0], x[1], x[2]}};
                touch[(*count)++] = made;
            }
        }
    }
    return true;
}

static void add_balls(const struct cage_slice *slice, cage_ball *ball, int32_t *count)
{
    for (int32_t i = slice->t.dim + 1; i < slice->t.sites; i++) {
        const struct cage_site *site = &slice->t.site[i];
        cage_ball made = {site->x, site->y, site->z, site->r};
        ball[(*count)++] = made;
    }
}

static void add_touch(struct cage_touch *touch, int32_t *count, int32_t k, int32_t l, const int64_t x[3])
{
    for (int32_t i = 0; i < *count; i++)
        if (touch[i].k == k && touch[i].l == l)
            return;
    struct cage_touch made = {k, l, {(int32_t)x[0], (int32_t)x[1], (int32_t)x[2]}};
    touch[(*count)++] = made;
}

static int32_t label_of(const struct cage_slice *slice, const struct cage_centre *centre)
{
    int32_t s = cage_delaunay_locate_centre(&slice->t, centre, 0);
    return s < 0 ? CAGE_OUTSIDE : slice->label[s];
}

static int32_t glue_by_mixture(struct glue *g, struct cage_touch **touch, int32_t *count)
{
    int32_t dim = g->c->t.dim, balls = 0;
    size_t mark = g->arena->used;
    cage_ball *ball = cage_arena_take(g->arena, (size_t)(g->c->t.sites + g->d->t.sites), sizeof *ball);
    if (!ball)
        return CAGE_ERROR_MEMORY;
    add_balls(g->c, ball, &balls);
    add_balls(g->d, ball, &balls);
    struct cage_triangulation t;
    struct cage_components mixture;
    int32_t error = cage_delaunay(g->arena, dim, ball, balls, &t);
    if (error == CAGE_OK)
        error = cage_components(g->arena, &t, &mixture);
    if (error == CAGE_OK) {
        *touch = cage_arena_take(g->arena, (size_t)mixture.count, sizeof **touch);
        error = *touch ? CAGE_OK : CAGE_ERROR_MEMORY;
    }
    if (error != CAGE_OK) {
        cage_arena_release(g->arena, mark);
        return error;
    }
    int64_t x[3];
    for (int32_t i = 0; i < 3; i++)
        x[i] = g->c->region[CAGE_OUTSIDE].point[i];
    x[1] = g->d->region[CAGE_OUTSIDE].point[1] > x[1] ? g->d->region[CAGE_OUTSIDE].point[1] : x[1];
    *count = 0;
    add_touch(*touch, count, CAGE_OUTSIDE, CAGE_OUTSIDE, x);
    for (int32_t m = 1; m < mixture.count; m++) {
        const struct cage_site *v[4];
        struct cage_centre centre;
        cage_simplex_sites(&t, mixture.deep[m], v);
        cage_orthocentre(dim, v, &centre);
        int32_t k = label_of(g->c, &centre), l = label_of(g->d, &centre);
        const int32_t base[3] = {centre.base->x, centre.base->y, centre.base->z};
        for (int32_t i = 0; i < 3; i++) /* a bounded component lies between the balls */
            x[i] = base[i] + cage_i128_nearest(centre.offset[i], centre.denominator, (int64_t)1 << 30);
        if (k >= 0 && l >= 0)
            add_touch(*touch, count, k, l, x);
    }
    return CAGE_OK;
}

int32_t cage_glue(struct cage_arena *arena, const struct cage_slice *c, const struct cage_slice *d, struct cage_touch **touch,
                  int32_t *count, int32_t *mixed)
{
    size_t mark = arena->used;
    struct glue g = {arena, c, d, NULL, NULL, NULL, NULL};
    int32_t room = 4 * (c->regions + d->regions);
    *touch = cage_arena_take(arena, (size_t)room, sizeof **touch);
    size_t kept = arena->used;
    g.shrink = cage_arena_take(arena, (size_t)c->parts, sizeof *g.shrink);
    g.reached = cage_arena_take(arena, (size_t)c->t.simplices, sizeof *g.reached);
    g.stack = cage_arena_take(arena, (size_t)c->t.simplices, sizeof *g.stack);
    g.home = cage_arena_take(arena, (size_t)d->regions, sizeof *g.home);
    if (!*touch || !g.shrink || !g.reached || !g.stack || !g.home) {
        cage_arena_release(arena, mark);
        return CAGE_ERROR_MEMORY;
    }
    for (int32_t a = 0; a < c->parts; a++) {
        const int32_t moved[3] = {c->part[a].at[0] - d->part[a].at[0], c->part[a].at[1] - d->part[a].at[1],
                                  c->part[a].at[2] - d->part[a].at[2]};
        g.shrink[a] = d->part[a].change - c->part[a].change - cage_length(moved);
    }
    *count = 0;
    *mixed = !glue_by_proof(&g, *touch, room, count);
    if (!*mixed) {
        cage_arena_release(arena, kept);
        return CAGE_OK;
    }
    cage_arena_release(arena, mark);
    return glue_by_mixture(&g, touch, count);
}
