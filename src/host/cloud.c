/* cloud.c: the part of space where the pivot can be, as points of a grid around it. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "picture.h"

#define ACROSS 48       /* points along the longest side, at most */
#define FEWEST 16
#define LOOKUPS 10e6    /* points times slices, about: a second or two, beside the slices that are built again */

int picture_stuck(const cage_result *result)
{
    return result->verdict == CAGE_CAGED || result->verdict == CAGE_DISCONNECTED;
}

int picture_marked(const picture_cloud *cloud, int32_t i, int32_t j, int32_t k)
{
    const int32_t *count = cloud->count;

    if (i < 0 || j < 0 || k < 0 || i >= count[0] || j >= count[1] || k >= count[2])
        return 0;
    return cloud->mask[((size_t)k * (size_t)count[1] + (size_t)j) * (size_t)count[0] + (size_t)i] != 0;
}

/* The mask over a box in grid units, that many points along its longest side. */
static int look(picture_cloud *cloud, const host_answer *answer, const picture_box *box, int across)
{
    const double limit = CAGE_REACH_3D - 1;
    double low[3], high[3], longest = 0;
    size_t points = 1;
    int k;

    for (k = 0; k < 3; k++) {
        low[k] = fmax(box->low[k], -limit);
        high[k] = fmax(low[k], fmin(box->high[k], limit));
        longest = fmax(longest, high[k] - low[k]);
    }
    cloud->pitch = (int32_t)fmax(1, ceil(longest / across));
    for (k = 0; k < 3; k++) {
        cloud->origin[k] = (int32_t)floor(low[k]);
        cloud->count[k] = (int32_t)((high[k] - low[k]) / cloud->pitch) + 1;
        points *= (size_t)cloud->count[k];
    }
    free(cloud->mask);
    cloud->mask = malloc(points);
    if (cloud->mask == NULL)
        return -1;
    return cage_prove_region(answer->proof, cloud->origin, cloud->pitch, cloud->count, cloud->mask) < 0 ? -1 : 0;
}

/* The box around the marked points, one step larger on every side; around the start's pivot where none is. */
static void marked_box(const picture_cloud *cloud, const host_answer *answer, picture_box *box)
{
    int32_t at[3];
    double start[3];
    int k, empty = 1;

    for (at[2] = 0; at[2] < cloud->count[2]; at[2]++)
        for (at[1] = 0; at[1] < cloud->count[1]; at[1]++)
            for (at[0] = 0; at[0] < cloud->count[0]; at[0]++) {
                if (!picture_marked(cloud, at[0], at[1], at[2]))
                    continue;
                for (k = 0; k < 3; k++) {
                    double x = cloud->origin[k] + (double)cloud->pitch * at[k];

                    box->low[k] = empty ? x : fmin(box->low[k], x);
                    box->high[k] = empty ? x : fmax(box->high[k], x);
                }
                empty = 0;
            }
    host_place(&answer->grid->start, answer->result->pivot, 1, start);
    for (k = 0; empty && k < 3; k++)
        box->low[k] = box->high[k] = start[k];
    picture_grow(box, cloud->pitch);
}

/* Looks coarsely everywhere the pivot may be (within the object's radius of the obstacles' box, or the object would be
 * beyond all of them), then closely where it found something. */
int picture_find_cloud(const host_answer *answer, picture_cloud *cloud)
{
    const double unit = answer->grid->unit, slices = fmax(1, answer->result->slices[0]);
    const int across = (int)fmax(FEWEST, fmin(ACROSS, cbrt(LOOKUPS / slices)));
    picture_box box;
    int k;

    memset(cloud, 0, sizeof *cloud);
    picture_scene_box(answer, &box);
    picture_grow(&box, picture_radius(answer));
    for (k = 0; k < 3; k++) {
        box.low[k] /= unit;
        box.high[k] /= unit;
    }
    if (look(cloud, answer, &box, across * 2 / 3) < 0)
        return -1;
    marked_box(cloud, answer, &box);
    return look(cloud, answer, &box, across);
}
