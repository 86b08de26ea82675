/* svg_region.c: the part of the plane where the pivot can be, as merged runs of a mask. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "picture.h"
#include "svg.h"

#define ACROSS 200 /* mask points along the longer side, about */
#define FEW 24     /* a region that spans fewer points than this is looked at again, closer */

/* The mask over a box of the plane, in grid units; 0, or negative where there is no memory. */
static int look(picture_cloud *seen, const host_answer *answer, double left, double right, double bottom, double top)
{
    double limit = CAGE_REACH_2D - 1;
    size_t points;

    left = fmax(left, -limit);
    right = fmin(right, limit);
    bottom = fmax(bottom, -limit);
    top = fmin(top, limit);
    seen->pitch = (int32_t)fmax(1, ceil(fmax(right - left, top - bottom) / ACROSS));
    seen->origin[0] = (int32_t)floor(left);
    seen->origin[1] = (int32_t)floor(bottom);
    seen->origin[2] = 0;
    seen->count[0] = (int32_t)((right - left) / seen->pitch) + 1;
    seen->count[1] = (int32_t)((top - bottom) / seen->pitch) + 1;
    seen->count[2] = 1;
    points = (size_t)seen->count[0] * (size_t)seen->count[1];
    free(seen->mask);
    seen->mask = malloc(points);
    if (seen->mask == NULL)
        return -1;
    return cage_prove_region(answer->proof, seen->origin, seen->pitch, seen->count, seen->mask) < 0 ? -1 : 0;
}

static int marked(const picture_cloud *seen, int32_t i, int32_t j)
{
    return seen->mask[(size_t)j * (size_t)seen->count[0] + (size_t)i] != 0;
}

/* The box around the marked points, one step larger on every side. */
static svg_box marked_box(const picture_cloud *seen)
{
    svg_box box = { 0, 0, 0, 0, 1 };
    int32_t i, j;

    for (j = 0; j < seen->count[1]; j++)
        for (i = 0; i < seen->count[0]; i++)
            if (marked(seen, i, j))
                svg_box_add(&box, seen->origin[0] + (double)seen->pitch * i, seen->origin[1] + (double)seen->pitch * j,
                            seen->pitch);
    return box;
}

/* The mask over the view; where the region is small there, over the region. */
static int look_twice(picture_cloud *seen, const svg_canvas *canvas, const host_answer *answer)
{
    const svg_box *view = &canvas->view;
    double unit = answer->grid->unit, at[3];
    svg_box box;

    if (look(seen, answer, view->left / unit, view->right / unit, view->bottom / unit, view->top / unit) < 0)
        return -1;
    box = marked_box(seen);
    if (box.empty) {
        host_place(&answer->grid->start, answer->result->pivot, 1, at);
        svg_box_add(&box, at[0], at[1], 1.5 * seen->pitch);
    }
    if (seen->pitch > 1 && fmax(box.right - box.left, box.top - box.bottom) < (double)FEW * seen->pitch)
        return look(seen, answer, box.left, box.right, box.bottom, box.top);
    return 0;
}

/* One rectangle for each run of marked points in a row. */
static void write_runs(FILE *out, const svg_canvas *canvas, const picture_cloud *seen, double unit)
{
    double step = seen->pitch * unit * canvas->scale;
    int32_t i, j, begin;

    (void)fprintf(out, "<path fill=\"#8fd184\" fill-opacity=\"0.65\" shape-rendering=\"crispEdges\" d=\"");
    for (j = 0; j < seen->count[1]; j++)
        for (i = 0; i < seen->count[0]; i++) {
            if (!marked(seen, i, j))
                continue;
            for (begin = i; i < seen->count[0] && marked(seen, i, j);)
                i++;
            (void)fprintf(out, "M%.2f %.2fh%.2fv%.2fh-%.2fz\n",
                          svg_x(canvas, (seen->origin[0] + (double)seen->pitch * begin) * unit) - step / 2,
                          svg_y(canvas, (seen->origin[1] + (double)seen->pitch * j) * unit) - step / 2,
                          step * (i - begin), step, step * (i - begin));
        }
    (void)fprintf(out, "\"/>\n");
}

int svg_region(FILE *out, const svg_canvas *canvas, const host_answer *answer)
{
    picture_cloud seen;
    int done;

    if (answer->cloud != NULL) {
        write_runs(out, canvas, answer->cloud, answer->grid->unit);
        return 1;
    }
    memset(&seen, 0, sizeof seen);
    done = look_twice(&seen, canvas, answer) == 0;
    if (done)
        write_runs(out, canvas, &seen, answer->grid->unit);
    free(seen.mask);
    return done;
}
