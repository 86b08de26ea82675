/* mixture: the balls of one slice, and those around a component of its neighbour, triangulated together.
 *
 * The vertices of K's simplices are all balls of c that meet the border of K (from a point of K near a ball, in its power
 * cell, a free way leads to a vertex of that cell, the orthocentre of a free simplex). Let C be a connected part of what K and
 * a component L of d share, in the closed boxes. Whatever ball meets its border does so in a box, so it is in the mixture, and
 * C is one of the mixture's components. It is all of L, or a ball of c meets its border, and it has a simplex with
 * a vertex of c. */
#include "mixture.h"

#include <string.h>

/* To insert one ball takes about as long as to copy the simplices of so many. */
enum { FEW_2D = 16, FEW_3D = 32 };

static bool meets_some(const struct cage_box *box, int32_t boxes, const struct cage_site *ball)
{
    bool meets = false;
    for (int32_t i = 0; i < boxes && !meets; i++)
        meets = cage_box_meets(&box[i], ball);
    return meets;
}

enum { UNUSED = 0, USED = 1 };

/* The vertices of K's simplices that meet a box, each once; null: no memory. */
static const struct cage_site **vertices_of(struct cage_arena *arena, const struct cage_slice *c, int32_t k,
                                            const struct cage_box *box, int32_t boxes, int32_t *count)
{
    const struct cage_triangulation *t = &c->t;
    const struct cage_site **vertex = cage_arena_take(arena, (size_t)t->sites, sizeof *vertex);
    uint8_t *seen = cage_arena_take(arena, (size_t)t->sites, sizeof *seen);
    *count = 0;
    if (!vertex || !seen)
        return NULL;
    memset(seen, UNUSED, (size_t)t->sites);
    for (int32_t s = 0; s < t->simplices; s++)
        for (int32_t i = 0; c->label[s] == k && i <= t->dim; i++) {
            int32_t v = t->simplex[s].v[i];
            if (v > t->dim && seen[v] == UNUSED && meets_some(box, boxes, &t->site[v]))
                vertex[(*count)++] = &t->site[v];
            seen[v] = USED;
        }
    return vertex;
}

static cage_ball ball_of(const struct cage_site *s)
{
    const cage_ball ball = {s->x, s->y, s->z, s->r};
    return ball;
}

/* A triangulation of its own, when that takes few balls; else that of d is extended. */
int32_t cage_mixture_make(struct cage_arena *arena, const struct cage_slice *c, int32_t k, const struct cage_slice *d,
                          const struct cage_box *box, int32_t boxes, struct cage_mixture *m)
{
    const struct cage_triangulation *t = &d->t;
    int32_t count, near = 0, most = t->sites / (t->dim == 2 ? FEW_2D : FEW_3D);
    const struct cage_site **vertex = vertices_of(arena, c, k, box, boxes, &count);
    cage_ball *ball = vertex ? cage_arena_take(arena, (size_t)most + (size_t)count, sizeof *ball) : NULL;
    if (!ball)
        return CAGE_ERROR_MEMORY;
    for (int32_t i = t->dim + 1; i < t->sites && near <= most; i++)
        if (meets_some(box, boxes, &t->site[i]) && near++ < most)
            ball[near - 1] = ball_of(&t->site[i]);
    m->local = near <= most;
    m->old = m->local ? near : t->sites;
    if (!m->local)
        return cage_delaunay_extend(arena, t, vertex, count, &m->t);
    for (int32_t i = 0; i < count; i++)
        ball[near + i] = ball_of(vertex[i]);
    return cage_delaunay(arena, t->shortcuts, t->dim, ball, near + count, &m->t);
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
