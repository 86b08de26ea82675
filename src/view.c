/* view: two slices of the same side of one scene, seen from the first, and where points of the second are in it. */
#include "view.h"

#include <string.h>

enum { NO_POINT = -1, UNKNOWN_HOME = -2 };

int32_t cage_view_make(struct cage_arena *arena, const struct cage_slice *c, const struct cage_slice *d, const int32_t *match,
                       struct cage_view *view)
{
    struct cage_view made = {c, d, NULL, NULL, NULL};
    made.home = cage_arena_take(arena, (size_t)d->regions, sizeof *made.home);
    made.off = cage_arena_take(arena, (size_t)d->regions, sizeof *made.off);
    if (!made.home || !made.off)
        return CAGE_ERROR_MEMORY;
    for (int32_t l = 0; l < d->regions; l++) {
        made.home[l] = d->region[l].known ? UNKNOWN_HOME : NO_POINT;
        made.off[l] = -1;
    }
    *view = made;
    return c->t.shortcuts ? c->t.shortcuts->barrier_make(arena, match, view) : CAGE_OK;
}

int32_t cage_view_home(const struct cage_view *view, int32_t l)
{
    if (view->home[l] == UNKNOWN_HOME)
        view->home[l] = cage_delaunay_locate(&view->c->t, view->d->region[l].point, 0);
    return view->home[l];
}

bool cage_view_is_off(const struct cage_view *view, int32_t l)
{
    if (view->off[l] < 0)
        view->off[l] = cage_slice_clear(view->c, view->d->region[l].point);
    return view->off[l];
}

bool cage_view_is_touching(const struct cage_view *view, int32_t k, int32_t l, int32_t x[3])
{
    const struct cage_region *a = &view->c->region[k], *b = &view->d->region[l];
    const int32_t *point = NULL;
    if (k == CAGE_OUTSIDE && l == CAGE_OUTSIDE)
        point = a->point[1] > b->point[1] ? a->point : b->point; /* above both bounding boxes */
    else if (cage_view_home(view, l) >= 0 && view->c->label[view->home[l]] == k && cage_view_is_off(view, l))
        point = b->point;
    else if (a->known && cage_slice_locate(view->d, a->point) == l)
        point = a->point;
    for (int32_t i = 0; point && i < 3; i++)
        x[i] = point[i];
    return point;
}
