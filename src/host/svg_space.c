/* svg_space.c: a scene in space, seen along z, y and x: obstacles grey, the object at the start blue. */
#include <math.h>
#include <string.h>

#include "svg.h"

/* The two axes that a view shows, across and up. */
static const int axes[3][2] = { { 0, 1 }, { 0, 2 }, { 1, 2 } };
static const char *const names[3] = { "x, y", "x, z", "y, z" };

void svg_space_box(const host_answer *answer, int view, svg_box *box)
{
    const host_balls *obstacles = &answer->query->obstacles, *object = &answer->query->object;
    const int across = axes[view][0], up = axes[view][1];
    double at[3], margin;
    int32_t i;

    memset(box, 0, sizeof *box);
    box->empty = 1;
    for (i = 0; i < obstacles->count; i++)
        svg_box_add(box, obstacles->ball[i].x[across], obstacles->ball[i].x[up], obstacles->ball[i].r);
    for (i = 0; i < object->count; i++) {
        svg_place(&object->ball[i], &answer->grid->start, answer->grid->unit, at);
        svg_box_add(box, at[across], at[up], object->ball[i].r);
    }
    margin = 0.03 * fmax(box->right - box->left, box->top - box->bottom);
    if (!(margin > 0))
        margin = 1;
    box->left -= margin;
    box->right += margin;
    box->bottom -= margin;
    box->top += margin;
}

static void write_ball(FILE *out, const svg_canvas *canvas, double x, double y, double r)
{
    (void)fprintf(out, "<circle cx=\"%.2f\" cy=\"%.2f\" r=\"%.2f\"/>\n", svg_x(canvas, x), svg_y(canvas, y),
                  r * canvas->scale);
}

void svg_space(FILE *out, const svg_canvas *canvas, const host_answer *answer, int view)
{
    const host_balls *obstacles = &answer->query->obstacles, *object = &answer->query->object;
    const int across = axes[view][0], up = axes[view][1];
    double at[3];
    int32_t i;

    (void)fprintf(out, "<text x=\"%.1f\" y=\"%.1f\" font-size=\"12\" fill=\"#66707c\">%s</text>\n",
                  svg_x(canvas, canvas->view.left), svg_y(canvas, canvas->view.top) + 12, names[view]);
    (void)fprintf(out, "<g fill=\"#7d8590\" fill-opacity=\"0.5\">\n");
    for (i = 0; i < obstacles->count; i++)
        write_ball(out, canvas, obstacles->ball[i].x[across], obstacles->ball[i].x[up], obstacles->ball[i].r);
    (void)fprintf(out, "</g>\n<g fill=\"#2f6fd0\">\n");
    for (i = 0; i < object->count; i++) {
        svg_place(&object->ball[i], &answer->grid->start, answer->grid->unit, at);
        write_ball(out, canvas, at[across], at[up], object->ball[i].r);
    }
    (void)fprintf(out, "</g>\n");
}
