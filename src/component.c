/* component: the connected components of the complement of a union of balls, from its triangulation.
 *
 * A full simplex is free iff the power of its orthocentre is positive. Free simplices joined through facets that are no
 * walls are the components, one to one; the orthocentre of a free simplex is a point of its component, and every free
 * point lies in a simplex labelled with its component (Edelsbrunner, "The union of balls and its dual shape", 1995). */
#include "component.h"

enum { UNSEEN = -2 }; /* free, not yet labelled */

bool cage_simplex_outer(const struct cage_triangulation *t, int32_t s)
{
    const int32_t *v = t->simplex[s].v;
    return v[0] <= t->dim || v[1] <= t->dim || v[2] <= t->dim || (t->dim == 3 && v[3] <= 3);
}

bool cage_component_free(const struct cage_triangulation *t, int32_t s)
{
    if (cage_simplex_outer(t, s))
        return true; /* its power is positive: it is |o - sentinel|^2 + 1 */
    const struct cage_site *v[4];
    cage_simplex_sites(t, s, v);
    return cage_simplex_power(t->dim, v) > 0;
}

bool cage_component_wall(const struct cage_triangulation *t, int32_t s, int32_t i)
{
    const struct cage_simplex *a = &t->simplex[s], *b = &t->simplex[a->twin[i] >> 2];
    const struct cage_site *facet[3];
    cage_facet_sites(t, s, i, facet);
    for (int32_t k = 0; k < t->dim; k++)
        if (facet[k] <= t->site + t->dim)
            return false;
    if (cage_facet_power(t->dim, facet) > 0)
        return false;
    int32_t above = a->v[i], below = b->v[a->twin[i] & 3];
    return !(above > t->dim && cage_facet_attached(t->dim, facet, &t->site[above])) &&
           !(below > t->dim && cage_facet_attached(t->dim, facet, &t->site[below]));
}

/* Spread a label from the simplices on the stack. */
static void flood(const struct cage_triangulation *t, struct cage_components *c, int32_t *stack, int32_t depth, int32_t label)
{
    while (depth > 0) {
        int32_t s = stack[--depth];
        for (int32_t i = 0; i <= t->dim; i++) {
            int32_t twin = t->simplex[s].twin[i];
            if (twin != CAGE_HULL && c->label[twin >> 2] == UNSEEN && !cage_component_wall(t, s, i)) {
                c->label[twin >> 2] = label;
                stack[depth++] = twin >> 2;
            }
        }
    }
}

static cage_i128 volume(const struct cage_triangulation *t, int32_t s)
{
    const struct cage_site *v[4];
    cage_simplex_sites(t, s, v);
    return cage_simplex_volume(t->dim, v);
}

static void find_deepest(const struct cage_triangulation *t, struct cage_components *c)
{
    for (int32_t k = 0; k < c->count; k++)
        c->deep[k] = -1;
    for (int32_t s = 0; s < t->simplices; s++) {
        int32_t k = c->label[s];
        if (k < 0 || cage_simplex_outer(t, s))
            continue;
        if (c->deep[k] < 0 || (k != CAGE_OUTSIDE && cage_i128_compare(volume(t, s), volume(t, c->deep[k])) > 0))
            c->deep[k] = s;
    }
}

int32_t cage_components(struct cage_arena *arena, const struct cage_triangulation *t, struct cage_components *out)
{
    size_t mark = arena->used;
    out->label = cage_arena_take(arena, (size_t)t->simplices, sizeof *out->label);
    out->deep = cage_arena_take(arena, (size_t)t->simplices, sizeof *out->deep);
    size_t kept = arena->used;
    int32_t *stack = cage_arena_take(arena, (size_t)t->simplices, sizeof *stack), depth = 0;
    if (!out->label || !out->deep || !stack) {
        cage_arena_release(arena, mark);
        return CAGE_ERROR_MEMORY;
    }
    for (int32_t s = 0; s < t->simplices; s++) {
        out->label[s] = cage_component_free(t, s) ? UNSEEN : CAGE_COVERED;
        if (out->label[s] == UNSEEN && cage_simplex_outer(t, s)) {
            out->label[s] = CAGE_OUTSIDE;
            stack[depth++] = s;
        }
    }
    flood(t, out, stack, depth, CAGE_OUTSIDE);
    out->count = 1;
    for (int32_t s = 0; s < t->simplices; s++)
        if (out->label[s] == UNSEEN) {
            out->label[s] = out->count;
            stack[0] = s;
            flood(t, out, stack, 1, out->count++);
        }
    find_deepest(t, out);
    cage_arena_release(arena, kept);
    return CAGE_OK;
}

void cage_component_point(const struct cage_triangulation *t, const struct cage_components *c, int32_t k, struct cage_centre *out)
{
    const struct cage_site *v[4];
    cage_simplex_sites(t, c->deep[k], v);
    cage_orthocentre(t->dim, v, out);
}

void cage_components_drop(const struct cage_triangulation *t, int32_t *now, struct cage_components *c)
{
    int32_t count = 0;
    for (int32_t k = 0; k < c->count; k++)
        if (now[k] != CAGE_COVERED) {
            c->deep[count] = c->deep[k];
            now[k] = count++;
        }
    c->count = count;
    for (int32_t s = 0; s < t->simplices; s++)
        if (c->label[s] >= 0)
            c->label[s] = now[c->label[s]];
}
