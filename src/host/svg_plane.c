/* svg_plane.c: a scene in the plane: obstacles, the object at start and goal, what it can reach or its path. */
#include <math.h>
#include <string.h>

#include "svg.h"

double svg_object_radius(const host_answer *answer)
{
    const host_balls *object = &answer->query->object;
    const int32_t *pivot = answer->result->pivot;
    double unit = answer->grid->unit, radius = 0;
    int32_t i;

    for (i = 0; i < object->count; i++)
        radius = fmax(radius, hypot(object->ball[i].x[0] - pivot[0] * unit, object->ball[i].x[1] - pivot[1] * unit) +
                                  object->ball[i].r);
    return radius;
}

/* The object at that pose, and its pivot. */
static void add_object(const host_answer *answer, const cage_pose *pose, svg_box *box)
{
    const host_balls *object = &answer->query->object;
    const double unit = answer->grid->unit;
    double at[3];
    int32_t i;

    host_place(pose, answer->result->pivot, unit, at);
    svg_box_add(box, at[0], at[1], 0);
    for (i = 0; i < object->count; i++) {
        svg_place(&object->ball[i], pose, unit, at);
        svg_box_add(box, at[0], at[1], object->ball[i].r);
    }
}

/* Makes room for a path, beyond the box by a part of the object's radius at most. */
static void add_path(const host_answer *answer, svg_box *box)
{
    const host_balls *object = &answer->query->object;
    const cage_result *result = answer->result;
    const double unit = answer->grid->unit, beyond = 0.3 * svg_object_radius(answer);
    const svg_box scene = *box;
    double at[3];
    int32_t i, k;

    for (i = 0; i < result->path_count; i++) {
        cage_pose turn = result->path[i]; /* of the pivot's frame: its place is clamped, then its balls added */
        double x = fmax(scene.left - beyond, fmin(scene.right + beyond, turn.x[0] * unit));
        double y = fmax(scene.bottom - beyond, fmin(scene.top + beyond, turn.x[1] * unit));

        memset(turn.x, 0, sizeof turn.x);
        for (k = 0; k < object->count; k++) {
            host_ball ball = object->ball[k];

            ball.x[0] -= result->pivot[0] * unit;
            ball.x[1] -= result->pivot[1] * unit;
            svg_place(&ball, &turn, unit, at);
            svg_box_add(box, x + at[0], y + at[1], ball.r);
        }
    }
}

/* Obstacles, start and goal with a margin; paths also go beyond it and are cut off there. */
void svg_plane_box(const host_answer *answer, svg_box *box)
{
    const host_balls *obstacles = &answer->query->obstacles;
    double margin;
    int32_t i;

    memset(box, 0, sizeof *box);
    box->empty = 1;
    for (i = 0; i < obstacles->count; i++)
        svg_box_add(box, obstacles->ball[i].x[0], obstacles->ball[i].x[1], obstacles->ball[i].r);
    add_object(answer, &answer->grid->start, box);
    if (answer->query->has_goal)
        add_object(answer, &answer->grid->goal, box);
    add_path(answer, box);
    margin = 0.03 * fmax(box->right - box->left, box->top - box->bottom);
    if (!(margin > 0))
        margin = 1; /* a scene without extent */
    box->left -= margin;
    box->right += margin;
    box->bottom -= margin;
    box->top += margin;
}

static void write_obstacles(FILE *out, const svg_canvas *canvas, const host_balls *obstacles)
{
    int32_t i;

    (void)fprintf(out, "<g fill=\"#7d8590\">\n");
    for (i = 0; i < obstacles->count; i++)
        (void)fprintf(out, "<circle cx=\"%.2f\" cy=\"%.2f\" r=\"%.2f\"/>\n", svg_x(canvas, obstacles->ball[i].x[0]),
                      svg_y(canvas, obstacles->ball[i].x[1]), obstacles->ball[i].r * canvas->scale);
    (void)fprintf(out, "</g>\n");
}

/* The symbols #balls and #object (with an outline of the union), and the part of the picture that is the view. */
static void write_symbols(FILE *out, const svg_canvas *canvas, const host_balls *object)
{
    const svg_box *view = &canvas->view;
    int32_t i;

    (void)fprintf(out, "<defs>\n<clipPath id=\"view\"><rect x=\"%.2f\" y=\"%.2f\" width=\"%.2f\" height=\"%.2f\"/>"
                       "</clipPath>\n",
                  svg_x(canvas, view->left), svg_y(canvas, view->top), (view->right - view->left) * canvas->scale,
                  (view->top - view->bottom) * canvas->scale);
    svg_arrow(out);
    (void)fprintf(out, "<g id=\"balls\">\n");
    for (i = 0; i < object->count; i++)
        (void)fprintf(out, "<circle cx=\"%.2f\" cy=\"%.2f\" r=\"%.2f\"/>\n", object->ball[i].x[0] * canvas->scale,
                      -object->ball[i].x[1] * canvas->scale, object->ball[i].r * canvas->scale);
    (void)fprintf(out, "</g>\n<g id=\"object\"><use xlink:href=\"#balls\" stroke-width=\"2.5\"/>"
                       "<use xlink:href=\"#balls\" stroke=\"none\"/></g>\n</defs>\n");
}

static void write_pose(FILE *out, const svg_canvas *canvas, const host_answer *answer, const cage_pose *pose,
                       const char *style)
{
    host_pose at;

    host_from_grid(pose, NULL, 2, answer->grid->unit, &at);
    svg_object(out, canvas, style, at.x, at.degrees);
}

static void write_pivot(FILE *out, const svg_canvas *canvas, const host_answer *answer, const cage_pose *pose)
{
    double at[3];

    host_place(pose, answer->result->pivot, answer->grid->unit, at);
    (void)fprintf(out, "<circle cx=\"%.2f\" cy=\"%.2f\" r=\"2.5\" fill=\"#1c2733\"/>\n", svg_x(canvas, at[0]),
                  svg_y(canvas, at[1]));
}

static void write_legend(FILE *out, const svg_canvas *canvas, const host_answer *answer, int region, double x, double y)
{
    const cage_result *result = answer->result;
    const int stuck = result->verdict == CAGE_CAGED || result->verdict == CAGE_DISCONNECTED;

    x = svg_legend(out, x, y, "<circle cx=\"9\" r=\"7\" fill=\"#7d8590\"/>", "obstacles");
    x = svg_legend(out, x, y, "<circle cx=\"9\" r=\"7\" fill=\"#6ea2ea\" stroke=\"#1f57b0\"/>"
                              "<circle cx=\"9\" r=\"2.5\" fill=\"#1c2733\"/>",
                   answer->name != NULL ? "a pose of it, and the pivot" : "start and pivot");
    if (answer->query->has_goal)
        x = svg_legend(out, x, y, "<circle cx=\"9\" r=\"7\" fill=\"#f7b267\" stroke=\"#c25e10\"/>", "goal");
    if (region)
        (void)svg_legend(out, x, y, "<rect x=\"1\" y=\"-7\" width=\"16\" height=\"14\" fill=\"#a9dca0\"/>",
                         answer->name != NULL ? "where the pivot is" : "the pivot never leaves this");
    else if (stuck)
        (void)svg_legend(out, x, y, "", "(no memory to draw the region)");
    if (result->path_count > 0)
        (void)svg_legend(out, x, y, "<path d=\"M0 0h18\" stroke=\"#8e2466\" stroke-width=\"2\"/>",
                         svg_path_cut(canvas, answer) ? "path of the pivot (it goes on beyond the picture)"
                                                      : "path of the pivot");
}

void svg_plane(FILE *out, const svg_canvas *canvas, const host_answer *answer, double x, double y)
{
    const cage_result *result = answer->result;
    const int stuck = result->verdict == CAGE_CAGED || result->verdict == CAGE_DISCONNECTED;
    const int hit = result->verdict == CAGE_IN_COLLISION;
    int region = 0;

    write_symbols(out, canvas, &answer->query->object);
    (void)fprintf(out, "<g clip-path=\"url(#view)\">\n");
    svg_path_copies(out, canvas, answer);
    if (stuck)
        region = svg_region(out, canvas, answer);
    write_obstacles(out, canvas, &answer->query->obstacles);
    if (answer->query->has_goal)
        write_pose(out, canvas, answer, &answer->grid->goal,
                   hit && result->reason == CAGE_REASON_GOAL ? "fill=\"#ef6a6a\" stroke=\"#a01818\" opacity=\"0.8\""
                                                             : "fill=\"#f7b267\" stroke=\"#c25e10\" opacity=\"0.8\"");
    write_pose(out, canvas, answer, &answer->grid->start,
               hit && result->reason != CAGE_REASON_GOAL ? "fill=\"#ef6a6a\" stroke=\"#a01818\" opacity=\"0.8\""
                                                         : "fill=\"#6ea2ea\" stroke=\"#1f57b0\" opacity=\"0.65\"");
    svg_path_line(out, canvas, answer);
    write_pivot(out, canvas, answer, &answer->grid->start);
    (void)fprintf(out, "</g>\n");
    write_legend(out, canvas, answer, region, x, y);
}
