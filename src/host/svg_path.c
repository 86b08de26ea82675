/* svg_path.c: a path in the plane: the line of the pivot, and the object, faint, at poses along it. */
#include <math.h>

#include "svg.h"

#define COPIES 40 /* faint objects along the visible path, at most about */

/* A pose of the pivot in the user's numbers. */
typedef struct stop {
    double x, y, degrees;
} stop;

static stop stop_at(const host_answer *answer, int32_t i)
{
    const int32_t centre[3] = { 0, 0, 0 };
    host_pose pose;
    stop result;

    host_from_grid(&answer->result->path[i], centre, 2, answer->grid->unit, &pose);
    result.x = pose.x[0];
    result.y = pose.x[1];
    result.degrees = pose.degrees;
    return result;
}

/* The turn from a to b, the shorter way. */
static double turn(const stop *a, const stop *b)
{
    double degrees = fmod(b->degrees - a->degrees, 360);

    return degrees > 180 ? degrees - 360 : degrees < -180 ? degrees + 360 : degrees;
}

static double radians(double degrees)
{
    return degrees * (acos(-1.0) / 180);
}

static int visible(const svg_canvas *canvas, const stop *at)
{
    const svg_box *view = &canvas->view;

    return at->x >= view->left && at->x <= view->right && at->y >= view->bottom && at->y <= view->top;
}

int svg_path_cut(const svg_canvas *canvas, const host_answer *answer)
{
    int32_t i;

    for (i = 0; i < answer->result->path_count; i++) {
        stop at = stop_at(answer, i);

        if (!visible(canvas, &at))
            return 1;
    }
    return 0;
}

/* How far the object moves from a to b: its pivot's way, or its farthest point's when it turns. */
static double leg_length(const stop *a, const stop *b, double radius)
{
    return hypot(b->x - a->x, b->y - a->y) + fabs(radians(turn(a, b))) * radius;
}

void svg_object(FILE *out, const svg_canvas *canvas, const char *style, const double origin[2], double degrees)
{
    (void)fprintf(out, "<use xlink:href=\"#object\" %s transform=\"translate(%.2f %.2f) rotate(%.3f)\"/>\n", style,
                  svg_x(canvas, origin[0]), svg_y(canvas, origin[1]), -degrees);
}

static void write_copy(FILE *out, const svg_canvas *canvas, const host_answer *answer, const stop *at)
{
    const int32_t *pivot = answer->result->pivot;
    double unit = answer->grid->unit, angle = radians(at->degrees);
    double x = pivot[0] * unit, y = pivot[1] * unit;
    double origin[2];

    origin[0] = at->x - (cos(angle) * x - sin(angle) * y);
    origin[1] = at->y - (sin(angle) * x + cos(angle) * y);
    svg_object(out, canvas, "fill=\"#6ea2ea\" stroke=\"#1f57b0\" opacity=\"0.16\"", origin, at->degrees);
}

/* Copies within one leg, every spacing along the path; left is the way to the next one. */
static double write_leg(FILE *out, const svg_canvas *canvas, const host_answer *answer, const stop *a, const stop *b,
                        double radius, double spacing, double left)
{
    double length = leg_length(a, b, radius), degrees = turn(a, b);

    for (; left < length; left += spacing) {
        double t = left / length;
        stop at;

        at.x = a->x + t * (b->x - a->x);
        at.y = a->y + t * (b->y - a->y);
        at.degrees = a->degrees + t * degrees;
        if (visible(canvas, &at))
            write_copy(out, canvas, answer, &at);
        else if (t > 0 && visible(canvas, a))
            break; /* out of sight; the rest of a last, long leg is not shown */
    }
    return left > length ? left - length : 0;
}

void svg_path_copies(FILE *out, const svg_canvas *canvas, const host_answer *answer)
{
    const int32_t count = answer->result->path_count;
    const svg_box *view = &canvas->view;
    double across = hypot(view->right - view->left, view->top - view->bottom);
    double radius = svg_object_radius(answer), total = 0, spacing, left;
    stop a, b;
    int32_t i;

    for (i = 0; i + 1 < count; i++) {
        a = stop_at(answer, i);
        b = stop_at(answer, i + 1);
        if (visible(canvas, &a))
            total += fmin(leg_length(&a, &b, radius), across);
    }
    spacing = fmax(total / COPIES, fmax(radius / 3, across / 200));
    left = spacing;
    for (i = 0; i + 1 < count; i++) {
        a = stop_at(answer, i);
        b = stop_at(answer, i + 1);
        if (visible(canvas, &a))
            left = write_leg(out, canvas, answer, &a, &b, radius, spacing, left);
    }
}

/* Cuts the segment from a, which is in the view, off where it leaves the view. */
static void cut(const svg_canvas *canvas, const stop *a, stop *b)
{
    const svg_box *view = &canvas->view;
    double dx = b->x - a->x, dy = b->y - a->y, t = 1;

    if (dx != 0)
        t = fmin(t, ((dx > 0 ? view->right : view->left) - a->x) / dx);
    if (dy != 0)
        t = fmin(t, ((dy > 0 ? view->top : view->bottom) - a->y) / dy);
    b->x = a->x + t * dx;
    b->y = a->y + t * dy;
}

void svg_path_line(FILE *out, const svg_canvas *canvas, const host_answer *answer)
{
    const int32_t count = answer->result->path_count;
    int32_t i, last = 0;
    stop a, b;

    for (i = 0; i < count; i++) {
        a = stop_at(answer, i);
        last = visible(canvas, &a) ? i : last;
    }
    if (count < 2)
        return;
    a = stop_at(answer, 0);
    (void)fprintf(out, "<polyline fill=\"none\" stroke=\"#8e2466\" stroke-width=\"2\" stroke-linejoin=\"round\" "
                       "marker-end=\"url(#arrow)\" points=\"%.2f,%.2f", svg_x(canvas, a.x), svg_y(canvas, a.y));
    for (i = 1; i < count && i <= last + 1; i++) {
        b = stop_at(answer, i);
        if (i == last + 1)
            cut(canvas, &a, &b);
        if (b.x != a.x || b.y != a.y)
            (void)fprintf(out, "\n%.2f,%.2f", svg_x(canvas, b.x), svg_y(canvas, b.y));
        a = b;
    }
    (void)fprintf(out, "\"/>\n");
}
