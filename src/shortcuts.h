/* shortcuts: what makes a proof faster and no answer different, in one table: an image that does not name it goes without. */
#ifndef CAGE_SHORTCUTS_H
#define CAGE_SHORTCUTS_H

#include "arena.h"
#include "cage.h"

#include <stdbool.h>

struct cage_build;
struct cage_centre;
struct cage_components;
struct cage_raster;
struct cage_triangulation;
struct cage_view;

struct cage_shortcuts {
    /* See ridges.h, */
    size_t (*ridges_size)(int32_t sites);
    bool (*ridges_make)(struct cage_arena *arena, struct cage_build *b, int32_t sites);
    bool (*ridges_link)(struct cage_build *b, int32_t fronts);
    /* prune.h, */
    int32_t (*prune)(struct cage_arena *arena, int32_t dim, cage_ball *ball, int32_t *of, int32_t *count, struct cage_raster *raster);
    int32_t (*drop_phantoms)(struct cage_arena *arena, const struct cage_triangulation *t, const struct cage_raster *raster,
                             struct cage_components *c);
    /* and barrier.h. */
    int32_t (*barrier_make)(struct cage_arena *arena, const int32_t *match, struct cage_view *view);
    bool (*barrier_is_apart)(const struct cage_view *view, int32_t k, int32_t l);
};

/* All of them. Where a pointer to a table is asked for, null means none of them. */
extern const struct cage_shortcuts cage_all_shortcuts;

#endif
