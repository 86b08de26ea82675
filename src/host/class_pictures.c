/* class_pictures.c: the large bounded classes of an atlas as pictures: the object in them, and where its pivot can be. */
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "atlas_host.h"
#include "picture.h"

#define ACROSS_2D 240 /* points along the longest side */
#define ACROSS_3D 40
#define HALVINGS_2D 9 /* boxes a little smaller than that */
#define HALVINGS_3D 5

/* Marks the points of the grid that lie in the box, if all of it belongs to the class. */
static void mark(void *context, const cage_atlas_box *box)
{
    const picture_cloud *cloud = context;
    int32_t from[3] = { 0, 0, 0 }, to[3] = { -1, -1, -1 }, at[3];
    int k;

    for (k = 0; k < 3 && box->whole; k++) {
        const double low = ((double)box->low[k] - cloud->origin[k]) / cloud->pitch;
        const double high = ((double)box->high[k] - cloud->origin[k]) / cloud->pitch;

        from[k] = (int32_t)fmax(0, ceil(low));
        to[k] = (int32_t)fmin(cloud->count[k] - 1, floor(high));
    }
    for (at[2] = from[2]; at[2] <= to[2]; at[2]++)
        for (at[1] = from[1]; at[1] <= to[1]; at[1]++)
            for (at[0] = from[0]; at[0] <= to[0]; at[0]++)
                cloud->mask[((size_t)at[2] * (size_t)cloud->count[1] + (size_t)at[1]) * (size_t)cloud->count[0] +
                            (size_t)at[0]] = 1;
}

/* Where the pivot can be, at any rotation; the caller frees the mask. 0, or -1 without memory. */
static int find_cloud(const cage_atlas *atlas, int32_t side, const host_row *row, picture_cloud *cloud)
{
    const double across = atlas->dim == 2 ? ACROSS_2D : ACROSS_3D;
    double longest = 0;
    size_t points = 1;
    int32_t cell;
    int k;

    for (k = 0; k < atlas->dim; k++)
        longest = fmax(longest, (double)row->class.high[k] - row->class.low[k]);
    cloud->pitch = (int32_t)fmax(1, ceil(longest / across));
    for (k = 0; k < 3; k++) {
        cloud->origin[k] = row->class.low[k];
        cloud->count[k] = (int32_t)(((double)row->class.high[k] - row->class.low[k]) / cloud->pitch) + 1;
        points *= (size_t)cloud->count[k];
    }
    cloud->mask = calloc(points, 1);
    for (cell = 0; cloud->mask != NULL && cell < atlas->leaves; cell++)
        (void)cage_atlas_boxes(atlas, side, cell, row->number, atlas->dim == 2 ? HALVINGS_2D : HALVINGS_3D, mark, cloud);
    return cloud->mask != NULL ? 0 : -1;
}

static int write_pictures(const char *svg, const char *ply, const char *name, const host_answer *answer, host_error *error)
{
    char path[600];
    int code = HOST_OK;

    if (svg != NULL) {
        (void)snprintf(path, sizeof path, "%.500s/%s.svg", svg, name);
        code = host_write_svg(path, answer, error);
    }
    if (code == HOST_OK && ply != NULL) {
        (void)snprintf(path, sizeof path, "%.500s/%s.ply", ply, name);
        code = host_write_ply(path, answer, error);
    }
    return code;
}

/* As the answer to a query that starts in the class. */
static int draw(const char *svg, const char *ply, const host_query *query, const host_grid *grid, const host_built *made,
                int32_t side, const host_row *row, host_error *error)
{
    const cage_class *class = &row->class;
    host_query at = *query;
    host_grid with = *grid;
    host_answer answer;
    cage_result result;
    picture_cloud cloud;
    char name[32], heading[32], title[120];
    int code;

    memset(&answer, 0, sizeof answer);
    memset(&result, 0, sizeof result);
    (void)snprintf(name, sizeof name, "%s-%ld", side == CAGE_SIDE_INNER ? "inner" : "outer", (long)row->number);
    (void)snprintf(heading, sizeof heading, "%s class %ld", side == CAGE_SIDE_INNER ? "Inner" : "Outer", (long)row->number);
    (void)snprintf(title, sizeof title, "%s, %ld of %ld cells",
                   side == CAGE_SIDE_INNER ? "no path leaves it" : "paths join all of it", (long)class->cells, (long)made->atlas.leaves);
    memcpy(result.pivot, made->atlas.pivot, sizeof result.pivot);
    result.verdict = CAGE_CAGED;
    host_from_grid(&class->pose, result.pivot, query->dim, grid->unit, &at.start);
    if (host_pose_to_grid(&at.start, grid->unit, &with.start) != HOST_OK)
        return HOST_OK; /* beyond the grid by rounding */
    answer.query = &at;
    answer.grid = &with;
    answer.result = &result;
    answer.cloud = &cloud;
    answer.name = heading;
    answer.title = title;
    if (find_cloud(&made->atlas, side, row, &cloud) < 0)
        return host_fail(error, HOST_MEMORY, "no memory to draw class %ld", (long)row->number);
    code = write_pictures(svg, ply, name, &answer, error);
    free(cloud.mask);
    return code;
}

static int make_folder(const char *path, host_error *error)
{
    if (path == NULL || mkdir(path, 0777) == 0 || errno == EEXIST)
        return HOST_OK;
    return host_fail(error, HOST_BAD_INPUT, "%.600s cannot be made: %.200s", path, strerror(errno));
}

int host_draw_classes(const char *svg, const char *ply, const host_query *query, const host_grid *grid, const host_built *made,
                      host_error *error)
{
    int32_t side, i;
    int code = make_folder(svg, error);

    if (code == HOST_OK)
        code = make_folder(ply, error);
    for (side = CAGE_SIDE_INNER; side <= CAGE_SIDE_OUTER; side++) {
        const int32_t count = made->atlas.classes[side == CAGE_SIDE_OUTER];
        host_row *rows = made->atlas.side & side ? host_rows(&made->atlas, side) : NULL;

        for (i = 0; code == HOST_OK && rows != NULL && i < count && i < HOST_ROWS; i++)
            if (rows[i].number > 0 && rows[i].class.known)
                code = draw(svg, ply, query, grid, made, side, &rows[i], error);
        free(rows);
    }
    return code;
}
