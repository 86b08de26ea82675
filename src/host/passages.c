/* passages.c: by how much all balls must shrink for classes of an atlas to open into each other, and where. */
#include <stdlib.h>

#include "atlas_host.h"

#define MOST_PASSAGE_CLASSES 6
#define MOST_PASSAGES (MOST_PASSAGE_CLASSES * (MOST_PASSAGE_CLASSES + 1) / 2)
#define PASSAGE_CELLS 1024 /* of each proof: where a passage just opens, more would tell little */

typedef struct passage {
    int32_t from, to; /* outer classes; to 0: the outside */
    cage_margin margin;
} passage;

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

/* By shrinking all balls, between all pairs of the largest bounded outer classes, and from each to the outside. */
static int find_passages(const cage_scene *scene, const host_built *made, double unit, int32_t rounds, passage *list,
                         int32_t *count, host_error *error)
{
    host_row *rows = host_rows(&made->atlas, CAGE_SIDE_OUTER);
    size_t size = HOST_FIRST_BLOCK;
    void *block = host_take_block(&size, HOST_LEAST_BLOCK);
    const int32_t classes = made->atlas.classes[1];
    int32_t i, k, state = rows != NULL && block != NULL ? CAGE_OK : CAGE_ERROR_MEMORY;
    cage_limits limits;

    cage_limits_default(&limits, scene->dim);
    limits.max_cells = PASSAGE_CELLS;
    *count = 0;
    for (i = 0; state == CAGE_OK && i < classes && i <= MOST_PASSAGE_CLASSES; i++)
        for (k = 0; state == CAGE_OK && k < i; k++) {
            const int32_t from = rows[rows[i].number == 0 ? k : i].number, to = rows[rows[i].number == 0 ? i : k].number;
            cage_pose start, goal;

            if (!pose_of(&made->atlas, from, unit, &start) || (to > 0 && !pose_of(&made->atlas, to, unit, &goal)))
                continue;
            list[*count].from = from;
            list[*count].to = to;
            state = cage_margin_find(scene, &start, to > 0 ? &goal : NULL, &limits, rounds, block, size, &list[*count].margin);
            *count += state == CAGE_OK;
        }
    free(rows);
    free(block);
    return state == CAGE_OK ? HOST_OK : host_fail(error, state == CAGE_ERROR_MEMORY ? HOST_MEMORY : HOST_BAD_INPUT,
                                                  "--passages: %.200s", cage_error_text(state));
}

static void print_passages(FILE *out, const passage *list, int32_t count, const cage_atlas *atlas, double unit)
{
    int32_t i;

    (void)fprintf(out, "\nPassages: two outer classes join when every radius shrinks by (not by the first, by the second)\n");
    for (i = 0; i < count; i++) {
        const cage_margin *margin = &list[i].margin;
        host_pose narrow;
        char to[16] = "the outside";

        if (list[i].to > 0)
            (void)snprintf(to, sizeof to, "%ld", (long)list[i].to);
        (void)fprintf(out, "  %5ld and %-11s  %.6g, %.6g", (long)list[i].from, to, margin->closed * unit, margin->open * unit);
        if (margin->known) {
            host_from_grid(&margin->narrow, margin->pivot, atlas->dim, unit, &narrow);
            (void)fprintf(out, "  at ");
            host_print_pose(out, &narrow);
        }
        (void)fprintf(out, "\n");
    }
}

int host_print_passages(FILE *out, const cage_scene *scene, const host_built *made, double unit, int32_t rounds,
                        host_error *error)
{
    passage list[MOST_PASSAGES];
    int32_t count;
    int code = find_passages(scene, made, unit, rounds, list, &count, error);

    if (code == HOST_OK)
        print_passages(out, list, count, &made->atlas, unit);
    return code;
}
