/* border: leave out balls that meet no border of the free space, once a triangulation of all has told which these are. */
#include "border.h"

int32_t cage_border_first(const struct cage_triangulation *t, const struct cage_components *c, cage_ball *ball, int32_t *of,
                          int32_t count)
{
    int32_t kept = 0, meet = 0;
    for (int32_t s = 0; s < t->simplices; s++)
        for (int32_t i = 0; c->label[s] != CAGE_COVERED && i <= t->dim; i++) {
            int32_t at = t->ball[t->simplex[s].v[i]];
            if (at >= 0 && of[at] >= 0) {
                of[at] = -1 - of[at]; /* it meets one */
                meet++;
            }
        }
    bool few = meet < (t->sites - t->dim - 1) / 4 * 3;
    for (int32_t i = 0; i < count; i++)
        if (of[i] < 0) {
            const cage_ball made = ball[i];
            int32_t own = -1 - of[i], to = few ? kept : i;
            of[i] = of[to];
            of[to] = own;
            ball[i] = ball[to];
            ball[to] = made;
            kept++;
        }
    return few ? kept : count;
}

static bool holds_centre(const struct cage_triangulation *t, const struct cage_centre *centre, const cage_ball *ball, int32_t count)
{
    for (int32_t i = 0; i < count; i++) {
        const struct cage_site site = {0, ball[i].x, ball[i].y, ball[i].z, ball[i].r};
        if (!cage_centre_off(t->dim, centre, &site))
            return true;
    }
    return false;
}

int32_t cage_border_drop(struct cage_arena *arena, const struct cage_triangulation *t, const cage_ball *ball, int32_t kept,
                         int32_t count, struct cage_components *c)
{
    size_t mark = arena->used;
    int32_t *now = cage_arena_take(arena, (size_t)c->count, sizeof *now);
    if (!now)
        return CAGE_ERROR_MEMORY;
    now[CAGE_OUTSIDE] = CAGE_OUTSIDE;
    for (int32_t k = 1; k < c->count; k++) {
        struct cage_centre centre;
        cage_component_point(t, c, k, &centre);
        now[k] = holds_centre(t, &centre, ball + kept, count - kept) ? CAGE_COVERED : k;
    }
    cage_components_drop(t, now, c);
    cage_arena_release(arena, mark);
    return CAGE_OK;
}
