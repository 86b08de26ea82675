/* glue: which components of neighbouring slices share a point.
 *
 * Cheap proofs (barrier.h) decide nearly every pair of components. What they leave undecided of a component K of c is
 * settled exactly by a mixture (mixture.c): K and L touch iff the witness of L, or the orthocentre of some new free simplex,
 * is in both. It is in K iff it is off all balls of c and in a simplex labelled K; then it is off all balls of d, and in L
 * iff in a simplex labelled L. */
#include "glue.h"
#include "mixture.h"

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
        has_touch(group, side, k, l) || !off_all(c, &centre))
        return;
    const int32_t base[3] = {centre.base->x, centre.base->y, centre.base->z};
    int32_t x[3];
    for (int32_t i = 0; i < 3; i++) /* one of the two is bounded: it lies between the balls */
        x[i] = (int32_t)(base[i] + cage_i128_nearest(centre.offset[i], centre.denominator, (int64_t)1 << 30));
    add_touch(group, side, k, l, x);
}

enum { REST = 0, CANDIDATE = 1 };

/* Try one of each set of new free simplices that are joined by facets which are no walls. */
static int32_t add_new_parts(struct group *group, int32_t side, int32_t k, const struct cage_mixture *m, int32_t hint[2])
{
    const struct cage_triangulation *t = &m->t;
    uint8_t *kind = cage_arena_take(group->arena, (size_t)t->simplices, sizeof *kind);
    int32_t *stack = cage_arena_take(group->arena, (size_t)t->simplices, sizeof *stack);
    if (!kind || !stack)
        return CAGE_ERROR_MEMORY;
    for (int32_t s = 0; s < t->simplices; s++)
        kind[s] = cage_mixture_is_new(m, s) && !cage_simplex_outer(t, s) && cage_component_free(t, s) ? CANDIDATE : REST;
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
    int32_t hint[2] = {0, 0};
    struct cage_mixture m;
    int32_t error = cage_mixture_make(group->arena, &group->view[side], k, &m);
    for (int32_t l = 0; error == CAGE_OK && !m.apart && l < d->regions; l++)
        if (d->region[l].deep >= 0 && cage_mixture_may_hold(&m, &d->region[l]))
            add_witness(group, side, k, &d->t, d->region[l].deep, hint);
    if (error == CAGE_OK && !m.apart)
        error = add_new_parts(group, side, k, &m, hint);
    if (error == CAGE_OK && k == CAGE_OUTSIDE && group->seen[1 - side][CAGE_OUTSIDE] != 2 &&
        !has_touch(group, side, k, CAGE_OUTSIDE)) {
        const int32_t *a = c->region[CAGE_OUTSIDE].point, *b = d->region[CAGE_OUTSIDE].point;
        add_touch(group, side, k, CAGE_OUTSIDE, a[1] > b[1] ? a : b); /* above both bounding boxes */
    }
    cage_arena_release(group->arena, mark);
    return error;
}

/* ---- all pairs of a group --------------------------------------------------------------------------- */

/* Does component l of the other slice touch k? Asked from there: if so it is a member, all its pairs decided; if not, what
 * else it touches does not matter. */
static int32_t ask_other(struct group *group, int32_t side, int32_t k, int32_t l)
{
    int32_t count = group->count, members = group->members;
    bool member = group->seen[1 - side][l];
    int32_t error = add_by_mixture(group, 1 - side, l);
    if (group->count > group->room || member || has_touch(group, side, k, l)) {
        add_member(group, 1 - side, l);
        group->seen[1 - side][l] = 2;
        return error;
    }
    while (group->members > members) {
        int32_t last = group->member[--group->members];
        group->seen[last < 0][last < 0 ? -1 - last : last] = 0;
    }
    group->count = count;
    return error;
}

/* Add all touching pairs of component k: by proofs, what these leave open from the smaller one's side. */
static int32_t decide(struct group *group, int32_t side, int32_t k, int32_t *mixed)
{
    const struct cage_slice *c = group->slice[side], *d = group->slice[1 - side];
    size_t mark = group->arena->used;
    int32_t *open = cage_arena_take(group->arena, (size_t)d->regions, sizeof *open), opens = 0, error = CAGE_OK;
    bool smallest = false;
    if (!open)
        return CAGE_ERROR_MEMORY;
    for (int32_t l = 0; l < d->regions && !smallest; l++) {
        int32_t x[3], verdict = CAGE_APART;
        if (group->seen[1 - side][l] != 2) /* else decided from there */
            verdict = cage_view_decide(&group->view[side], k, l, x);
        if (verdict == CAGE_TOUCHING)
            add_touch(group, side, k, l, x);
        if (verdict != CAGE_UNDECIDED)
            continue;
        *mixed = 1; /* pairs that were proved stay: their points are exact */
        open[opens++] = l;
        smallest = k != CAGE_OUTSIDE && (l == CAGE_OUTSIDE || c->region[k].size <= d->region[l].size);
    }
    smallest = smallest || (opens > 0 && open[0] == CAGE_OUTSIDE);
    if (smallest)
        error = add_by_mixture(group, side, k);
    for (int32_t i = 0; i < opens && !smallest && error == CAGE_OK; i++)
        if (group->seen[1 - side][open[i]] != 2)
            error = ask_other(group, side, k, open[i]);
    cage_arena_release(group->arena, mark);
    return error;
}

static int32_t glue_group(struct group *group, int32_t *mixed)
{
    for (int32_t n = 0; n < group->members; n++) {
        int32_t side = group->member[n] < 0, k = side ? -1 - group->member[n] : group->member[n];
        if (group->seen[side][k] == 2)
            continue;
        int32_t error = decide(group, side, k, mixed);
        if (error != CAGE_OK)
            return error;
        group->seen[side][k] = 2;
    }
    return CAGE_OK;
}

/* All components are members. Small ones come first: what is decided with them takes least; the outsides last. */
static void add_all(struct group *group)
{
    for (int32_t large = 0; large < 2; large++)
        for (int32_t side = 0; side < 2; side++) {
            const struct cage_slice *slice = group->slice[side];
            int64_t sum = 0;
            for (int32_t k = 0; k < slice->regions; k++)
                sum += slice->region[k].size;
            for (int32_t k = 0; k < slice->regions; k++)
                if (k != CAGE_OUTSIDE && large == (slice->region[k].size > sum / slice->regions))
                    add_member(group, side, k);
        }
    add_member(group, 0, CAGE_OUTSIDE);
    add_member(group, 1, CAGE_OUTSIDE);
}

static int32_t make_group(struct cage_arena *arena, const struct cage_slice *c, const struct cage_slice *d, const int32_t *match,
                          int32_t seed, int32_t room, struct group *group)
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
        if (!group->seen[side] || cage_view_make(arena, slice, group->slice[1 - side], match, &group->view[side]) != CAGE_OK)
            return CAGE_ERROR_MEMORY;
        memset(group->seen[side], 0, (size_t)slice->regions);
    }
    if (seed == CAGE_ALL)
        add_all(group);
    else
        add_member(group, 0, seed);
    return CAGE_OK;
}

int32_t cage_glue(struct cage_arena *arena, const struct cage_slice *c, const struct cage_slice *d, int32_t seed,
                  struct cage_touch **touch, int32_t *count, int32_t *mixed)
{
    return cage_glue_matched(arena, c, d, NULL, seed, touch, count, mixed);
}

int32_t cage_glue_matched(struct cage_arena *arena, const struct cage_slice *c, const struct cage_slice *d, const int32_t *match,
                          int32_t seed, struct cage_touch **touch, int32_t *count, int32_t *mixed)
{
    size_t mark = arena->used;
    for (int32_t room = 2 * (c->regions + d->regions);; room *= 2) {
        struct group group;
        *mixed = 0;
        int32_t error = make_group(arena, c, d, match, seed, room, &group);
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
