/* mixture: the balls of one slice, and those around a component of its neighbour, triangulated together.
 *
 * The vertices of K's simplices are all balls of c that meet the border of K (from a point of K near a ball, in its power
 * cell, a free way leads to a vertex of that cell, the orthocentre of a free simplex), so a component of the mixture
 * lies in K or off it. One that lies in K and in a component L of d is all of L, or a ball of c meets its border, and it has
 * a simplex with a vertex of c. None of this changes when balls of d that do not meet K are left out. */
#include "mixture.h"
#include "box.h"

enum { TOO_MANY = -1, HELD = -2 };

/* To insert one ball takes about as long as to copy the simplices of so many. */
enum { FEW_2D = 16, FEW_3D = 32 };

/* The vertices of the simplices collected, each once; null: no memory. */
static const struct cage_site **vertices_of(struct cage_arena *arena, struct cage_view *view, int32_t *count)
{
    const struct cage_triangulation *t = &view->c->t;
    const struct cage_site **vertex = cage_arena_take(arena, (size_t)t->sites, sizeof *vertex);
    *count = 0;
    for (int32_t n = 0; vertex && n < view->length; n++)
        for (int32_t i = 0; i <= t->dim; i++) {
            int32_t v = t->simplex[view->queue[n]].v[i];
            if (v <= t->dim || view->used[v] == view->spreads)
                continue;
            view->used[v] = view->spreads;
            vertex[(*count)++] = &t->site[v];
        }
    return vertex;
}

static cage_ball ball_of(const struct cage_site *s)
{
    const cage_ball ball = {s->x, s->y, s->z, s->r};
    return ball;
}

/* The balls of d that meet the box, as long as they are at most so many; how many, or TOO_MANY, or HELD: one holds it all. */
static int32_t balls_at(const struct cage_mixture *m, const struct cage_triangulation *d, cage_ball *ball, int32_t most)
{
    int32_t near = 0;
    for (int32_t i = d->dim + 1; i < d->sites; i++) {
        if (!cage_box_meets(&m->box, &d->site[i]))
            continue;
        if (cage_box_is_held(&m->box, &d->site[i]))
            return HELD;
        if (near <= most && near++ < most)
            ball[near - 1] = ball_of(&d->site[i]);
    }
    return near <= most ? near : TOO_MANY;
}

/* A triangulation of its own, when that takes few balls; else that of d is extended. */
int32_t cage_mixture_make(struct cage_arena *arena, struct cage_view *view, int32_t k, struct cage_mixture *m)
{
    const struct cage_triangulation *d = &view->d->t;
    int32_t count, near = TOO_MANY;
    cage_view_collect(view, k);
    const struct cage_site **vertex = vertices_of(arena, view, &count);
    int32_t most = d->sites / (d->dim == 2 ? FEW_2D : FEW_3D);
    cage_ball *ball = cage_arena_take(arena, (size_t)most + (size_t)count, sizeof *ball);
    if (!vertex || !ball)
        return CAGE_ERROR_MEMORY;
    m->boxed = k != CAGE_OUTSIDE && cage_box_make(view->c, view->queue, view->length, &m->box);
    if (m->boxed)
        near = balls_at(m, d, ball, most);
    m->apart = near == HELD;
    m->local = near >= 0;
    m->old = m->local ? near : d->sites;
    if (m->apart)
        return CAGE_OK;
    if (!m->local)
        return cage_delaunay_extend(arena, d, vertex, count, &m->t);
    for (int32_t i = 0; i < count; i++)
        ball[near + i] = ball_of(vertex[i]);
    return cage_delaunay(arena, d->dim, ball, near + count, &m->t);
}

bool cage_mixture_is_new(const struct cage_mixture *m, int32_t s)
{
    bool fresh = false;
    for (int32_t i = 0; i <= m->t.dim; i++) {
        int32_t v = m->t.simplex[s].v[i];
        fresh = fresh || (m->local ? m->t.ball[v] : v) >= m->old;
    }
    return fresh;
}

/* The known point is the witness, rounded. */
bool cage_mixture_may_hold(const struct cage_mixture *m, const struct cage_region *region)
{
    bool within = true;
    for (int32_t n = 0; m->boxed && region->known && n < 3; n++)
        within = within && region->point[n] >= m->box.low[n] - 1 && region->point[n] <= m->box.high[n] + 1;
    return within;
}
