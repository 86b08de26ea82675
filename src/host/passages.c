/* passages.c: by how much all balls must shrink for classes of an atlas to open into each other, and where. */
#include <stdlib.h>

#include "atlas_host.h"

#define PASSAGE_CELLS 1024 /* of each proof: where a passage just opens, more would tell little */

/* The known pose of an outer class, in the user's frame; it is off by less than the outer side gives away. */
static int pose_of(const cage_atlas *atlas, int32_t class, double unit, cage_pose *pose)
{
    cage_class known;
    host_pose user;

    if (cage_atlas_class(atlas, CAGE_SIDE_OUTER, class, &known) != CAGE_OK || !known.known)
        return 0;
    host_from_grid(&known.pose, atlas->pivot, atlas->dim, unit, &user);
    return host_pose_to_grid(&user, unit, pose) == HOST_OK;
}

int host_find_passages(const cage_scene *scene, const host_built *made, double unit, int32_t rounds, const size_t *bytes,
                       host_passages *out, host_error *error)
{
    host_row *rows = host_rows(&made->atlas, CAGE_SIDE_OUTER);
    size_t size = bytes != NULL ? *bytes : HOST_FIRST_BLOCK;
    void *block = host_take_block(&size, bytes != NULL ? *bytes + 1 : HOST_LEAST_BLOCK);
    const int32_t classes = made->atlas.classes[1];
    int32_t i, k, state = rows != NULL && block != NULL ? CAGE_OK : CAGE_ERROR_MEMORY;
    cage_limits limits;

    cage_limits_default(&limits, scene->dim);
    limits.max_cells = PASSAGE_CELLS;
    out->count = 0;
    for (i = 0; state == CAGE_OK && i < classes && i <= HOST_PASSAGE_CLASSES; i++)
        for (k = 0; state == CAGE_OK && k < i; k++) {
            const int32_t from = rows[rows[i].number == 0 ? k : i].number, to = rows[rows[i].number == 0 ? i : k].number;
            cage_pose start, goal;

            if (!pose_of(&made->atlas, from, unit, &start) || (to > 0 && !pose_of(&made->atlas, to, unit, &goal)))
                continue;
            out->list[out->count].from = from;
            out->list[out->count].to = to;
            state = cage_margin_find(scene, &start, to > 0 ? &goal : NULL, &limits, rounds, block, size,
                                     &out->list[out->count].margin);
            out->count += state == CAGE_OK;
        }
    free(rows);
    free(block);
    return state == CAGE_OK ? HOST_OK : host_fail(error, state == CAGE_ERROR_MEMORY ? HOST_MEMORY : HOST_BAD_INPUT,
                                                  "--passages: %.200s", cage_error_text(state));
}
