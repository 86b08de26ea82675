/* glue: which components of neighbouring slices share a point.
 *
 * Every pair of components that may matter is settled by itself (settle.h). */
#include "glue.h"
#include "settle.h"

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

/* ---- all pairs of a group --------------------------------------------------------------------------- */

/* Add all touching pairs of component k. */
static int32_t decide(struct group *group, int32_t side, int32_t k, int32_t *mixed)
{
    for (int32_t l = 0; l < group->slice[1 - side]->regions; l++) {
        int32_t x[3];
        bool touching;
        if (group->seen[1 - side][l] == 2)
            continue; /* decided from there */
        int32_t error = cage_settle(group->arena, &group->view[side], k, l, &touching, x, mixed);
        if (error != CAGE_OK)
            return error;
        if (touching)
            add_touch(group, side, k, l, x);
    }
    return CAGE_OK;
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
                if (k != CAGE_OUTSIDE && large == ((int64_t)slice->region[k].size * slice->regions > sum))
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
