/* trail.c: a scene in space as pictures need it: its box, and a path as a few poses, evenly apart. */
#include <math.h>
#include <string.h>

#include "picture.h"

#define PIECES 64 /* of a leg, at most, after each of which it is looked at */

static double norm(const double *x, int count)
{
    double size = 0;
    int k;

    for (k = 0; k < count; k++)
        size = hypot(size, x[k]);
    return size;
}

/* ---- what is shown -------------------------------------------------------------------------------- */

double picture_radius(const host_answer *answer)
{
    const host_balls *object = &answer->query->object;
    double radius = 0, from[3];
    int32_t i;
    int k;

    for (i = 0; i < object->count; i++) {
        for (k = 0; k < 3; k++)
            from[k] = object->ball[i].x[k] - answer->result->pivot[k] * answer->grid->unit;
        radius = fmax(radius, norm(from, 3) + object->ball[i].r);
    }
    return radius;
}

static void add_ball(picture_box *box, const double at[3], double r)
{
    int k;

    for (k = 0; k < 3; k++) {
        box->low[k] = fmin(box->low[k], at[k] - r);
        box->high[k] = fmax(box->high[k], at[k] + r);
    }
}

void picture_scene_box(const host_answer *answer, picture_box *box)
{
    const host_balls *obstacles = &answer->query->obstacles, *object = &answer->query->object;
    const int ends = answer->query->has_goal ? 2 : 1;
    picture_stop stop;
    double at[3];
    int32_t i;
    int end, k;

    for (k = 0; k < 3; k++) {
        box->low[k] = INFINITY;
        box->high[k] = -INFINITY;
    }
    for (i = 0; i < obstacles->count; i++)
        add_ball(box, obstacles->ball[i].x, obstacles->ball[i].r);
    for (end = 0; end < ends; end++) {
        picture_stop_at(answer, end == 0 ? &answer->grid->start : &answer->grid->goal, &stop);
        add_ball(box, stop.x, 0);
        for (i = 0; i < object->count; i++) {
            picture_place(answer, &stop, &object->ball[i], at);
            add_ball(box, at, object->ball[i].r);
        }
    }
}

void picture_grow(picture_box *box, double by)
{
    int k;

    for (k = 0; k < 3; k++) {
        box->low[k] -= by;
        box->high[k] += by;
    }
}

/* ---- poses ----------------------------------------------------------------------------------------- */

void picture_stop_at(const host_answer *answer, const cage_pose *pose, picture_stop *stop)
{
    host_pose at;

    host_from_grid(pose, NULL, 3, answer->grid->unit, &at);
    host_place(pose, answer->result->pivot, answer->grid->unit, stop->x);
    memcpy(stop->q, at.q, sizeof stop->q);
}

void picture_place(const host_answer *answer, const picture_stop *stop, const host_ball *ball, double at[3])
{
    const double w = stop->q[0], *v = stop->q + 1;
    double from[3], u[3];
    int k;

    for (k = 0; k < 3; k++)
        from[k] = ball->x[k] - answer->result->pivot[k] * answer->grid->unit;
    for (k = 0; k < 3; k++)
        u[k] = 2 * (v[(k + 1) % 3] * from[(k + 2) % 3] - v[(k + 2) % 3] * from[(k + 1) % 3]);
    for (k = 0; k < 3; k++)
        at[k] = stop->x[k] + from[k] + w * u[k] + v[(k + 1) % 3] * u[(k + 2) % 3] - v[(k + 2) % 3] * u[(k + 1) % 3];
}

/* A pose of the path: x is where the pivot is. */
static void path_stop(const host_answer *answer, int32_t i, picture_stop *stop)
{
    host_pose at;

    host_from_grid(&answer->result->path[i], NULL, 3, answer->grid->unit, &at);
    memcpy(stop->x, at.x, sizeof stop->x);
    memcpy(stop->q, at.q, sizeof stop->q);
}

/* The angle between two rotations, and -1 if b's quaternion is to be negated for the shorter arc. */
static double turn(const picture_stop *a, const picture_stop *b, double *sign)
{
    double difference[4], dot = 0;
    int k;

    for (k = 0; k < 4; k++)
        dot += a->q[k] * b->q[k];
    *sign = dot < 0 ? -1 : 1;
    for (k = 0; k < 4; k++)
        difference[k] = a->q[k] - *sign * b->q[k];
    return 4 * asin(fmin(1, norm(difference, 4) / 2));
}

/* The pose at t of the way from a to b, 0 to 1. */
static void between(const picture_stop *a, const picture_stop *b, double t, picture_stop *out)
{
    double sign, half = turn(a, b, &sign) / 2, s = sin(half), from = 1 - t, to = t, size;
    int k;

    if (s > 1e-6) {
        from = sin((1 - t) * half) / s;
        to = sin(t * half) / s;
    }
    for (k = 0; k < 3; k++)
        out->x[k] = a->x[k] + t * (b->x[k] - a->x[k]);
    for (k = 0; k < 4; k++)
        out->q[k] = from * a->q[k] + to * sign * b->q[k];
    size = norm(out->q, 4);
    for (k = 0; k < 4; k++)
        out->q[k] /= size;
}

static double leg_length(const picture_stop *a, const picture_stop *b, double radius)
{
    double way[3], sign;
    int k;

    for (k = 0; k < 3; k++)
        way[k] = b->x[k] - a->x[k];
    return norm(way, 3) + turn(a, b, &sign) * radius;
}

int picture_inside(const picture_box *box, const picture_stop *stop)
{
    int k, inside = 1;

    for (k = 0; k < 3; k++)
        inside = inside && stop->x[k] >= box->low[k] && stop->x[k] <= box->high[k];
    return inside;
}

/* Goes along the path; returns the length of what is inside the box. Every spacing (0: never) a pose is put into stop. */
static double walk(const host_answer *answer, const picture_box *box, double spacing, picture_stop *stop, int most, int *count)
{
    const double radius = picture_radius(answer);
    double length = 0;
    picture_stop a, b, at;
    int32_t i;

    *count = 0;
    for (i = 0; i + 1 < answer->result->path_count; i++) {
        double leg;
        int pieces, k;

        path_stop(answer, i, &a);
        path_stop(answer, i + 1, &b);
        leg = leg_length(&a, &b, radius);
        pieces = leg < radius * PIECES / 16 ? 1 + (int)(16 * leg / radius) : PIECES;
        for (k = 1; leg > 0 && k <= pieces; k++) {
            between(&a, &b, (double)k / pieces, &at);
            if (!picture_inside(box, &at))
                continue;
            length += leg / pieces;
            if (spacing > 0 && *count < most && length >= spacing * (*count + 1))
                stop[(*count)++] = at;
        }
    }
    return length;
}

int picture_trail(const host_answer *answer, const picture_box *box, picture_stop *stop, int most)
{
    int count;
    double length = walk(answer, box, 0, stop, most, &count);

    (void)walk(answer, box, fmax(length / most * (1 - 1e-9), 0.5 * picture_radius(answer)), stop, most, &count);
    return count;
}
