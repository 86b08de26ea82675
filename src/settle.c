/* settle: do a component of one slice and one of its neighbour share a point?
 *
 * They do if a known point of one is in the other; not if the barrier proves it (barrier.h), or if no piece of one meets a
 * piece of the other (overlap.h). Else boxes around what pieces share hold all common points, and a mixture of the balls that
 * meet them decides (mixture.h): K and L share a point iff the witness of L, or the orthocentre of some new free simplex,
 * is in both: off all balls of c and in a simplex labelled K, off all balls of d (not all of them are in the mixture) and in
 * a simplex labelled L. */
#include "settle.h"
#include "barrier.h"
#include "mixture.h"
#include "overlap.h"

#include <string.h>

/* Is the orthocentre of the largest piece of L, of those that may meet K, in both? Often, if they touch. */
static bool share_centre(const struct cage_overlap *o, int32_t x[3])
{
    const struct cage_orthoball *deep = NULL;
    for (int32_t i = 0; i < o->pieces; i++)
        if (o->piece[i].ball.radius >= (deep ? deep->radius : 0))
            deep = &o->piece[i].ball;
    if (!deep || cage_slice_locate(o->c, deep->at) != o->k || cage_slice_locate(o->d, deep->at) != o->l)
        return false;
    for (int32_t n = 0; n < 3; n++)
        x[n] = deep->at[n];
    return true;
}

/* ---- a mixture ------------------------------------------------------------------------------------------ */

static bool off_all(const struct cage_slice *c, const struct cage_centre *centre)
{
    for (int32_t i = c->t.dim + 1; i < c->t.sites; i++)
        if (!cage_centre_off(c->t.dim, centre, &c->t.site[i]))
            return false;
    return true;
}

/* The label where the point is; *hint: a simplex near it, at first and then. */
static int32_t label_at(const struct cage_slice *slice, const struct cage_centre *centre, int32_t *hint)
{
    int32_t s = cage_delaunay_locate_centre(&slice->t, centre, *hint);
    *hint = s < 0 ? 0 : s;
    return s < 0 ? CAGE_OUTSIDE : slice->label[s];
}

/* Is the orthocentre of the free simplex s of t in both? *hint: where to look in c and d. */
static bool is_witness(const struct cage_overlap *o, const struct cage_triangulation *t, int32_t s, int32_t hint[2], int32_t x[3])
{
    const struct cage_site *v[4];
    struct cage_centre centre;
    cage_simplex_sites(t, s, v);
    cage_orthocentre(t->dim, v, &centre);
    if (label_at(o->c, &centre, &hint[0]) != o->k || label_at(o->d, &centre, &hint[1]) != o->l ||
        !off_all(o->c, &centre) || !off_all(o->d, &centre))
        return false;
    const int32_t base[3] = {centre.base->x, centre.base->y, centre.base->z};
    for (int32_t i = 0; i < 3; i++) /* K is bounded: it lies between the balls */
        x[i] = (int32_t)(base[i] + cage_i128_nearest(centre.offset[i], centre.denominator, (int64_t)1 << 30));
    return true;
}

enum { REST = 0, CANDIDATE = 1 };

/* Try one of each set of new free simplices that are joined by facets which are no walls. */
static int32_t try_new_parts(struct cage_arena *arena, const struct cage_overlap *o, const struct cage_mixture *m, int32_t hint[2],
                             bool *touching, int32_t x[3])
{
    const struct cage_triangulation *t = &m->t;
    uint8_t *kind = cage_arena_take(arena, (size_t)t->simplices, sizeof *kind);
    int32_t *stack = cage_arena_take(arena, (size_t)t->simplices, sizeof *stack);
    if (!kind || !stack)
        return CAGE_ERROR_MEMORY;
    for (int32_t s = 0; s < t->simplices; s++)
        kind[s] = cage_mixture_is_new(m, s) && !cage_simplex_outer(t, s) && cage_component_free(t, s) ? CANDIDATE : REST;
    for (int32_t first = 0; first < t->simplices && !*touching; first++) {
        int32_t depth = 0;
        if (kind[first] == REST)
            continue;
        *touching = is_witness(o, t, first, hint, x);
        kind[first] = REST;
        stack[depth++] = first;
        while (depth > 0) {
            int32_t s = stack[--depth];
            for (int32_t i = 0; i <= t->dim; i++) {
                int32_t next = t->simplex[s].twin[i] >> 2; /* no hull facet: no sentinels */
                if (kind[next] == REST || cage_component_wall(t, s, i))
                    continue;
                kind[next] = REST;
                stack[depth++] = next;
            }
        }
    }
    return CAGE_OK;
}

static int32_t mix(struct cage_arena *arena, const struct cage_overlap *o, bool *touching, int32_t x[3])
{
    int32_t hint[2] = {0, 0}, deep = o->d->region[o->l].deep;
    struct cage_mixture m;
    int32_t error = cage_mixture_make(arena, o->c, o->k, o->d, o->box, o->boxes, &m);
    if (error == CAGE_OK && deep >= 0)
        *touching = is_witness(o, &o->d->t, deep, hint, x);
    if (error == CAGE_OK && !*touching)
        error = try_new_parts(arena, o, &m, hint, touching, x);
    return error;
}

/* Does the barrier prove it? Only asked if it is far, or not. */
static bool is_proved_apart(const struct cage_view *view, int32_t k, int32_t l, bool far)
{
    return view->barrier && view->barrier->far == far && view->c->t.shortcuts->barrier_is_apart(view, k, l);
}

/* Where no known point tells: the barrier, pieces that may meet, those that do meet, a mixture. */
static int32_t look_closer(struct cage_arena *arena, const struct cage_view *view, int32_t k, int32_t l, bool *touching, int32_t x[3],
                           int32_t *mixed)
{
    const struct cage_slice *c = view->c, *d = view->d;
    bool turned = k == CAGE_OUTSIDE || (l != CAGE_OUTSIDE && d->region[l].size < c->region[k].size);
    struct cage_overlap o;
    memset(&o, 0, sizeof o);
    o.c = turned ? d : c;
    o.d = turned ? c : d;
    o.k = turned ? l : k;
    o.l = turned ? k : l;
    if (is_proved_apart(view, k, l, false))
        return CAGE_OK;
    int32_t error = cage_overlap_pieces(arena, &o);
    *touching = error == CAGE_OK && share_centre(&o, x);
    if (error == CAGE_OK && !*touching && o.pieces > 0)
        error = cage_overlap_boxes(arena, &o);
    if (error != CAGE_OK || o.boxes == 0 || (o.met > CAGE_OVERLAP_MANY && is_proved_apart(view, k, l, true)))
        return error;
    *mixed = 1;
    return mix(arena, &o, touching, x);
}

int32_t cage_settle(struct cage_arena *arena, const struct cage_view *view, int32_t k, int32_t l, bool *touching, int32_t x[3],
                    int32_t *mixed)
{
    const struct cage_bounds *a = &view->c->region[k].bounds, *b = &view->d->region[l].bounds;
    size_t mark = arena->used;
    *touching = false;
    if (k != CAGE_OUTSIDE && l != CAGE_OUTSIDE && !cage_bounds_meet(view->c->t.dim, a, b))
        return CAGE_OK;
    *touching = cage_view_is_touching(view, k, l, x);
    int32_t error = *touching ? CAGE_OK : look_closer(arena, view, k, l, touching, x, mixed);
    cage_arena_release(arena, mark);
    return error;
}
