/* parts_balls.c: do balls lie inside convex parts, and do they cover them? Looked at in points, no proof. */
#include <math.h>
#include <string.h>

#include "parts.h"

#define DIRECTIONS 256   /* looked at from a ball's centre, and from a part's */
#define SHELLS 4         /* and so many points in each */
#define CLOSE 1e-6       /* of a part's reach: balls may stick out by that, and points may be */
#define HALVINGS 40

/* Evenly spread over the circle, or over the sphere (on a spiral of the golden angle). */
static void direction(int n, int32_t dim, double out[3])
{
    const double pi = acos(-1), z = dim == 2 ? 0 : 1 - (2 * n + 1.0) / DIRECTIONS;
    const double angle = dim == 2 ? 2 * pi * n / DIRECTIONS : n * pi * (3 - sqrt(5.0));

    out[0] = sqrt(1 - z * z) * cos(angle);
    out[1] = sqrt(1 - z * z) * sin(angle);
    out[2] = z;
}

/* A point, in the part's own frame. */
static void to_part(const host_part *part, const double x[3], double out[3])
{
    const double v[3] = { x[0] - part->x[0], x[1] - part->x[1], x[2] - part->x[2] };

    parts_turn_back(part->q, v, out);
}

/* How far a ball sticks out, for shapes where one formula says so; NaN for others. In the plane it does not above and below. */
static double sticks_out(const host_part *part, const double x[3], double r, int32_t dim)
{
    double v[3], across = 0, out = -INFINITY;
    int k;

    to_part(part, x, v);
    if (part->shape == PART_HULL)
        return NAN;
    for (k = 0; k < 3; k++)
        across = hypot(across, k == part->axis ? 0 : v[k]);
    if (part->shape == PART_CAPSULE)
        return hypot(across, fmax(0, fabs(v[part->axis]) - part->size[1])) + r - part->size[0];
    if (part->shape == PART_CYLINDER)
        return fmax(across + r - part->size[0], dim == 2 ? -INFINITY : fabs(v[part->axis]) + r - part->size[1]);
    for (k = 0; k < dim; k++)
        out = fmax(out, fabs(v[k]) + r - part->size[k]);
    return out;
}

int parts_hold_point(const host_part *part, const double x[3])
{
    const double out = sticks_out(part, x, 0, 3), tiny = CLOSE * part->reach;
    host_part point;

    if (!isnan(out))
        return out <= tiny;
    memset(&point, 0, sizeof point);
    point.shape = PART_CAPSULE; /* of no length: a ball */
    point.axis = 2;
    point.size[0] = point.reach = tiny;
    memcpy(point.x, x, sizeof point.x);
    point.q[0] = 1;
    return parts_closer(part, &point, 0);
}

static int any_holds(const host_part *part, int32_t count, const double x[3])
{
    int32_t i;

    for (i = 0; i < count; i++)
        if (parts_hold_point(&part[i], x))
            return 1;
    return 0;
}

int parts_hold_ball(const host_part *part, int32_t count, const double x[3], double r, int32_t dim)
{
    int32_t i;
    int n, k;

    for (i = 0; i < count; i++)
        if (sticks_out(&part[i], x, r, dim) <= CLOSE * part[i].reach)
            return 1; /* in one of them */
    if (!any_holds(part, count, x))
        return 0;
    for (n = 0; n < DIRECTIONS && r > 0; n++) {
        double at[3], d[3];

        direction(n, dim, d);
        for (k = 0; k < 3; k++)
            at[k] = x[k] + r * d[k];
        if (!any_holds(part, count, at))
            return 0;
    }
    return 1;
}

static int in_balls(const host_balls *balls, const double x[3], double tiny)
{
    int32_t i;

    for (i = 0; i < balls->count; i++) {
        const host_ball *b = &balls->ball[i];

        if (hypot(hypot(x[0] - b->x[0], x[1] - b->x[1]), x[2] - b->x[2]) <= b->r + tiny)
            return 1;
    }
    return 0;
}

/* From the middle of each part in many directions: points at its surface and on the way there. */
void parts_cover_by(const host_part *part, int32_t count, const host_balls *balls, int32_t dim, parts_cover *cover)
{
    int32_t i;
    int n, k, shell;

    for (i = 0; i < count; i++) {
        double middle[3];

        parts_turn(part[i].q, part[i].centre, middle);
        for (n = 0; n < DIRECTIONS; n++) {
            double d[3], at[3], low = 0, high = 2 * part[i].reach;

            direction(n, dim, d);
            for (k = 0; k < HALVINGS; k++) {
                const double half = (low + high) / 2;
                int m;

                for (m = 0; m < 3; m++)
                    at[m] = part[i].x[m] + middle[m] + half * d[m];
                *(parts_hold_point(&part[i], at) ? &low : &high) = half;
            }
            for (shell = 1; shell <= SHELLS; shell++) {
                for (k = 0; k < 3; k++)
                    at[k] = part[i].x[k] + middle[k] + low * shell / SHELLS * d[k];
                cover->points++;
                cover->bare += !in_balls(balls, at, 4 * CLOSE * part[i].reach);
            }
        }
    }
}
