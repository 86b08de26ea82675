/* glue: which components of neighbouring slices share a point.
 *
 * Cheap proofs (barrier.h) decide nearly every pair of components. What they leave undecided of a component K of c is settled
 * exactly by a mixture: the balls of d, and those of c that are vertices of K's simplices. These are all balls that
 * meet the border of K (from a point of K near a ball, in its power cell, a free way leads to a vertex of that cell, the
 * orthocentre of a free simplex), so a component of the mixture lies in K or off it. One that lies in K and in a component L of
 * d is all of L, or a ball of c meets its border, and it has a new simplex. So K and L touch iff the witness of
 * L, or the orthocentre of some new free simplex, is in both: it is in K iff it is off all balls of c and in a simplex
 * labelled K, and likewise in L. */
#include "glue.h"
#include "barrier.h"

#include <string.h>

/* The components of both slices that belong together, as they are found. */
struct group {
    struct cage_arena *arena;
    const struct cage_slice *slice[2];
    struct cage_view view[2]; /* from either */
    int32_t *member;          /* those of the first slice as they are, of the second as -1 - l */
    uint8_t *seen[2];         /* 1: a member, 2: and all pairs with it are decided */
    int32_t members;
    struct cage_touch *touch;
    int32_t room;
    int32_t count; /* room + 1: there were more */
};

static void add_member(struct group *group, int32_t side, int32_t k)
{
    if (group->seen[side][k])
        return;
    group->seen[side][k] = 1;
    group->member[group->members++] = side == 0 ? k : -1 - k;
}

static void add_touch(struct group *group, int32_t side, int32_t k, int32_t l, const int32_t x[3])
{
    if (group->count < group->room) {
        struct cage_touch made = {side ? l : k, side ? k : l, {x[0], x[1], x[2]}};
        group->touch[group->count] = made;
    }
    group->count += group->count <= group->room;
    if (l != CAGE_OUTSIDE)
        add_member(group, 1 - side, l);
}

/* ---- a mixture -------------------------------------------------------------------------------------- */

/* The vertices of simplices labelled k, in their order; null: no memory. */
static const struct cage_site **vertices_of(struct cage_arena *arena, const struct cage_slice *c, int32_t k, int32_t *count)
{
    const struct cage_triangulation *t = &c->t;
    const struct cage_site **vertex = cage_arena_take(arena, (size_t)t->sites, sizeof *vertex);
    uint8_t *used = cage_arena_take(arena, (size_t)t->sites, sizeof *used);
    *count = 0;
    if (!vertex || !used)
        return NULL;
    memset(used, 0, (size_t)t->sites);
    for (int32_t s = 0; s < t->simplices; s++)
        for (int32_t i = 0; c->label[s] == k && i <= t->dim; i++)
            used[t->simplex[s].v[i]] = 1;
    for (int32_t i = t->dim + 1; i < t->sites; i++)
        if (used[i])
            vertex[(*count)++] = &t->site[i];
    return vertex;
}

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

static bool has_touch(const struct group *group, int32_t side, int32_t k, int32_t l)
{
    for (int32_t i = 0; i < group->count && i < group->room; i++)
        if ((side ? group->touch[i].l : group->touch[i].k) == k && (side ? group->touch[i].k : group->touch[i].l) == l)
            return true;
    return false;
}

/* If the orthocentre of the free simplex s of t is in component k and in one of d, these touch. *hint: where to look
 * in c and d. */
static void add_witness(struct group *group, int32_t side, int32_t k, const struct cage_triangulation *t, int32_t s,
                        int32_t hint[2])
{
    const struct cage_slice *c = group->slice[side], *d = group->slice[1 - side];
    const struct cage_site *v[4];
    struct cage_centre centre;
    cage_simplex_sites(t, s, v);
    cage_orthocentre(t->dim, v, &centre);
    if (label_at(c, &centre, &hint[0]) != k)
        return;
    int32_t l = label_at(d, &centre, &hint[1]);
    if (l == CAGE_COVERED || (k == CAGE_OUTSIDE && l == CAGE_OUTSIDE) || group->seen[1 - side][l] == 2 ||
        has_touch(group, side, k, l) || !off_all(c, &centre) || !off_all(d, &centre))
        return;
    const int32_t base[3] = {centre.base->x, centre.base->y, centre.base->z};
    int32_t x[3];
    for (int32_t i = 0; i < 3; i++) /* one of the two is bounded: it lies between the balls */
        x[i] = (int32_t)(base[i] + cage_i128_nearest(centre.offset[i], centre.denominator, (int64_t)1 << 30));
    add_touch(group, side, k, l, x);
}

static bool is_new(const struct cage_triangulation *t, int32_t s, int32_t sites)
{
    bool fresh = false;
    for (int32_t i = 0; i <= t->dim; i++)
        fresh = fresh || t->simplex[s].v[i] >= sites;
    return fresh;
}

enum { REST = 0, CANDIDATE = 1 };

/* Try one of each set of new free simplices that are joined by facets which are no walls. */
static int32_t add_new_parts(struct group *group, int32_t side, int32_t k, const struct cage_triangulation *t, int32_t hint[2])
{
    int32_t sites = group->slice[1 - side]->t.sites;
    uint8_t *kind = cage_arena_take(group->arena, (size_t)t->simplices, sizeof *kind);
    int32_t *stack = cage_arena_take(group->arena, (size_t)t->simplices, sizeof *stack);
    if (!kind || !stack)
        return CAGE_ERROR_MEMORY;
    for (int32_t s = 0; s < t->simplices; s++)
        kind[s] = is_new(t, s, sites) && !cage_simplex_outer(t, s) && cage_component_free(t, s) ? CANDIDATE : REST;
    for (int32_t first = 0; first < t->simplices; first++) {
        int32_t depth = 0;
        if (kind[first] == REST)
            continue;
        add_witness(group, side, k, t, first, hint);
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

/* Add all touching pairs of component k. */
static int32_t add_by_mixture(struct group *group, int32_t side, int32_t k)
{
    const struct cage_slice *c = group->slice[side], *d = group->slice[1 - side];
    size_t mark = group->arena->used;
    int32_t count, hint[2] = {0, 0};
    const struct cage_site **vertex = vertices_of(group->arena, c, k, &count);
    struct cage_triangulation t;
    int32_t error = vertex ? cage_delaunay_extend(group->arena, &d->t, vertex, count, &t) : CAGE_ERROR_MEMORY;
    for (int32_t l = 0; error == CAGE_OK && l < d->regions; l++)
        if (d->region[l].deep >= 0)
            add_witness(group, side, k, &d->t, d->region[l].deep, hint);
    if (error == CAGE_OK)
        error = add_new_parts(group, side, k, &t, hint);
    if (error == CAGE_OK && k == CAGE_OUTSIDE && group->seen[1 - side][CAGE_OUTSIDE] != 2 &&
        !has_touch(group, side, k, CAGE_OUTSIDE)) {
        const int32_t *a = c->region[CAGE_OUTSIDE].point, *b = d->region[CAGE_OUTSIDE].point;
        add_touch(group, side, k, CAGE_OUTSIDE, a[1] > b[1] ? a : b); /* above both bounding boxes */
    }
    cage_arena_release(group->arena, mark);
    return error;
}

/* ---- all pairs of a group --------------------------------------------------------------------------- */

/* Add all touching pairs of component k that can be decided without a mixture; false if not all can. */
static bool add_by_proof(struct group *group, int32_t side, int32_t k)
{
    for (int32_t l = 0; l < group->slice[1 - side]->regions; l++) {
        int32_t x[3];
        if (group->seen[1 - side][l] == 2)
            continue; /* decided from there */
        int32_t verdict = cage_view_decide(&group->view[side], k, l, x);
        if (verdict == CAGE_UNDECIDED)
            return false;
        if (verdict == CAGE_TOUCHING)
            add_touch(group, side, k, l, x);
    }
    return true;
}

static int32_t glue_group(struct group *group, int32_t *mixed)
{
    for (int32_t n = 0; n < group->members; n++) {
        int32_t side = group->member[n] < 0, k = side ? -1 - group->member[n] : group->member[n];
        if (!add_by_proof(group, side, k)) {
            *mixed = 1; /* pairs that were proved stay: their points are exact */
            int32_t error = add_by_mixture(group, side, k);
            if (error != CAGE_OK)
                return error;
        }
        group->seen[side][k] = 2;
    }
    return CAGE_OK;
}

static int32_t make_group(struct cage_arena *arena, const struct cage_slice *c, const struct cage_slice *d, int32_t seed,
                          int32_t room, struct group *group)
{
    memset(group, 0, sizeof *group);
    group->arena = arena;
    group->slice[0] = c;
    group->slice[1] = d;
    group->room = room;
    group->touch = cage_arena_take(arena, (size_t)room, sizeof *group->touch);
    group->member = cage_arena_take(arena, (size_t)c->regions + (size_t)d->regions, sizeof *group->member);
    if (!group->touch || !group->member)
        return CAGE_ERROR_MEMORY;
    for (int32_t side = 0; side < 2; side++) {
        const struct cage_slice *slice = group->slice[side];
        group->seen[side] = cage_arena_take(arena, (size_t)slice->regions, sizeof *group->seen[side]);
        if (!group->seen[side] || cage_view_make(arena, slice, group->slice[1 - side], &group->view[side]) != CAGE_OK)
            return CAGE_ERROR_MEMORY;
        memset(group->seen[side], 0, (size_t)slice->regions);
    }
    for (int32_t k = 0; k < c->regions; k++)
        if (seed == k || seed == CAGE_ALL)
            add_member(group, 0, k);
    return CAGE_OK;
}

int32_t cage_glue(struct cage_arena *arena, const struct cage_slice *c, const struct cage_slice *d, int32_t seed,
                  struct cage_touch **touch, int32_t *count, int32_t *mixed)
{
    size_t mark = arena->used;
    for (int32_t room = 2 * (c->regions + d->regions);; room *= 2) {
        struct group group;
        *mixed = 0;
        int32_t error = make_group(arena, c, d, seed, room, &group);
        if (error == CAGE_OK)
            error = glue_group(&group, mixed);
        cage_arena_release(arena, mark);
        if (error != CAGE_OK)
            return error;
        if (group.count > room)
            continue;
        *touch = cage_arena_take(arena, (size_t)room, sizeof **touch); /* the same place */
        *count = group.count;
        return CAGE_OK;
    }
}
