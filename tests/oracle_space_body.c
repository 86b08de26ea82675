/* oracle_space_body.c: a question in space as one of a moving body among walls. */
#include "oracle_space_body.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define TINY 1e-9

/* ---- balls and ends --------------------------------------------------------------------------------- */

/* x + R y, or the inverse motion: where the obstacles are as seen from the object. */
static void place_of(const cage_pose *pose, int inverse, double x[3], double q[4], double r[3][3])
{
    space_place at;
    oracle_space_place(pose, &at);
    for (int i = 0; i < 3; i++) {
        x[i] = (double)at.x[i];
        for (int k = 0; k < 3; k++) {
            r[i][k] = (double)(inverse ? at.r[k][i] : at.r[i][k]);
        }
    }
    for (int i = 0; i < 4; i++) {
        q[i] = inverse && i > 0 ? -pose->q[i] : pose->q[i];
    }
    if (inverse) {
        double y[3] = {x[0], x[1], x[2]};
        for (int i = 0; i < 3; i++) {
            x[i] = -(r[i][0] * y[0] + r[i][1] * y[1] + r[i][2] * y[2]);
        }
    }
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double out[3])
{
    double c[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    memcpy(out, c, sizeof c);
}

static void apply(const double r[3][3], const double v[3], double out[3])
{
    double a[3] = {dot(r[0], v), dot(r[1], v), dot(r[2], v)};
    memcpy(out, a, sizeof a);
}

static void centre_of(const cage_ball *b, double c[3])
{
    c[0] = b->x;
    c[1] = b->y;
    c[2] = b->z;
}

/* Pivot and axis: the middle and the direction of the two balls that are farthest apart. */
static int line_through(const cage_ball *ball, int32_t n, double pivot[3], double axis[3])
{
    double most = 0;
    for (int32_t i = 0; i < n; i++) {
        for (int32_t j = 0; j < i; j++) {
            double a[3], b[3];
            centre_of(&ball[i], a);
            centre_of(&ball[j], b);
            double d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]}, length = sqrt(dot(d, d));
            if (length > most) {
                most = length;
                for (int k = 0; k < 3; k++) {
                    pivot[k] = (a[k] + b[k]) / 2;
                    axis[k] = d[k] / length;
                }
            }
        }
    }
    return most > 0;
}

static void box_middle(const cage_ball *ball, int32_t n, double pivot[3])
{
    double lo[3] = {1e30, 1e30, 1e30}, hi[3] = {-1e30, -1e30, -1e30};
    for (int32_t i = 0; i < n; i++) {
        double c[3];
        centre_of(&ball[i], c);
        for (int k = 0; k < 3; k++) {
            lo[k] = fmin(lo[k], c[k]);
            hi[k] = fmax(hi[k], c[k]);
            pivot[k] = (lo[k] + hi[k]) / 2;
        }
    }
}

static void sides_of(space_moving *g)
{
    double other[3] = {0, 0, 0};
    other[fabs(g->axis[0]) < 0.7 ? 0 : 1] = 1;
    cross(g->axis, other, g->side[0]);
    double length = sqrt(dot(g->side[0], g->side[0]));
    for (int k = 0; k < 3; k++) {
        g->side[0][k] /= length;
    }
    cross(g->axis, g->side[0], g->side[1]);
}

/* The ball within (for paths: around) the given one that has its centre on the axis. */
static int put_on_line(const space_moving *g, const double d[3], const double axis[3], space_mover *m)
{
    double t = dot(d, axis), off = sqrt(fmax(0, dot(d, d) - t * t)) + TINY;
    m->y[0] = t;
    m->y[1] = m->y[2] = 0;
    m->arm = fabs(t);
    m->r += g->path ? off : -off;
    return m->r > 0;
}

static int movers_make(space_moving *g, const cage_ball *ball, int32_t n, const double rotation[3][3])
{
    double axis[3] = {1, 0, 0};
    if (n < 1) {
        return 0;
    }
    if (g->body->part == SPACE_BALL) {
        ball += g->body->ball;
        n = 1;
    }
    box_middle(ball, n, g->pivot);
    if (g->body->part == SPACE_LINE && !line_through(ball, n, g->pivot, axis)) {
        return 0;
    }
    apply(rotation, axis, g->axis);
    sides_of(g);
    for (int32_t i = 0; i < n; i++) {
        space_mover *m = &g->mover[g->movers];
        double d[3];
        centre_of(&ball[i], d);
        for (int k = 0; k < 3; k++) {
            d[k] -= g->pivot[k];
        }
        m->r = ball[i].r;
        m->ball = g->body->part == SPACE_BALL ? g->body->ball : i;
        m->arm = sqrt(dot(d, d));
        apply(rotation, d, m->y);
        g->movers += g->body->part != SPACE_LINE || put_on_line(g, d, axis, m);
    }
    g->dims = g->body->part == SPACE_BALL ? 0 : g->body->part == SPACE_LINE ? 2 : 3;
    return g->movers > 0;
}

/* v with exp(v) = the rotation from p to q. */
static void turn_between(const double p[4], const double q[4], double v[3])
{
    double w = q[0] * p[0] + q[1] * p[1] + q[2] * p[2] + q[3] * p[3];
    v[0] = q[1] * p[0] - q[0] * p[1] - q[2] * p[3] + q[3] * p[2];
    v[1] = q[2] * p[0] - q[0] * p[2] - q[3] * p[1] + q[1] * p[3];
    v[2] = q[3] * p[0] - q[0] * p[3] - q[1] * p[2] + q[2] * p[1];
    double s = sqrt(dot(v, v)), angle = 2 * atan2(s, fabs(w)) * (w < 0 ? -1 : 1);
    for (int k = 0; k < 3; k++) {
        v[k] *= s > 0 ? angle / s : 0;
    }
}

/* The same for a line: v across the axis, in the sides' coordinates. u is where the axis is at the goal. */
static void turn_of_line(const space_moving *g, const double u[3], double v[3])
{
    double a = dot(u, g->side[0]), b = dot(u, g->side[1]), s = hypot(a, b), angle = atan2(s, dot(u, g->axis));
    v[0] = s > 0 ? angle * a / s : angle;
    v[1] = s > 0 ? angle * b / s : 0;
    v[2] = 0;
}

static void ends_make(space_moving *g, const double axis_in_body[3])
{
    double x[3], q0[4], q1[4], r[3][3], a[3];
    place_of(g->q->start, g->body->obstacles, x, q0, r);
    apply(r, g->pivot, a);
    for (int k = 0; k < 3; k++) {
        g->start[k] = g->goal[k] = x[k] + a[k];
    }
    g->has_goal = g->q->goal != NULL;
    if (g->q->goal) {
        place_of(g->q->goal, g->body->obstacles, x, q1, r);
        apply(r, g->pivot, a);
        for (int k = 0; k < 3; k++) {
            g->goal[k] = x[k] + a[k];
        }
        if (g->dims == 3) {
            turn_between(q0, q1, g->goal_turn);
        } else if (g->dims == 2) {
            apply(r, axis_in_body, a);
            turn_of_line(g, a, g->goal_turn);
        }
    }
}

int space_moving_make(const space_question *q, const space_body *body, int path, space_moving *g)
{
    memset(g, 0, sizeof *g);
    g->q = q;
    g->body = body;
    g->path = path;
    const cage_shape *moving = body->obstacles ? &q->scene->obstacles : &q->scene->object;
    const cage_shape *still = body->obstacles ? &q->scene->object : &q->scene->obstacles;
    const cage_ball *balls = path ? moving->outer : moving->inner, *walls = path ? still->outer : still->inner;
    int32_t count = path ? moving->outer_count : moving->inner_count;
    double x[3], turn[4], r[3][3], axis[3] = {1, 0, 0}, pivot[3];
    g->walls = path ? still->outer_count : still->inner_count;
    g->mover = malloc(((size_t)count + 1) * sizeof *g->mover);
    g->wall = malloc(((size_t)g->walls + 1) * sizeof *g->wall);
    if (!g->mover || !g->wall || g->walls < 1) {
        return 0;
    }
    for (int j = 0; j < g->walls; j++) {
        centre_of(&walls[j], g->wall[j]);
        g->wall[j][3] = walls[j].r;
    }
    place_of(q->start, body->obstacles, x, turn, r);
    if (!movers_make(g, balls, count, r)) {
        return 0;
    }
    if (g->dims == 2) {
        line_through(balls, count, pivot, axis);
    }
    ends_make(g, axis);
    return 1;
}

void space_moving_free(space_moving *g)
{
    free(g->mover);
    free(g->wall);
}

/* ---- turns -------------------------------------------------------------------------------------------- */

void space_moving_turn(const space_moving *g, const double v[3], double (*offset)[3])
{
    double a[3], b[3], u[3], angle = sqrt(dot(v, v)), c = cos(angle), s = angle > 0 ? sin(angle) / angle : 1;
    double t = angle > 0 ? (1 - c) / (angle * angle) : 0.5;
    for (int k = 0; k < 3; k++) {
        u[k] = c * g->axis[k] + s * (v[0] * g->side[0][k] + v[1] * g->side[1][k]);
    }
    for (int i = 0; i < g->movers; i++) {
        const double *y = g->mover[i].y;
        cross(v, y, a);
        cross(v, a, b);
        for (int k = 0; k < 3; k++) {
            offset[i][k] = g->dims == 2 ? y[0] * u[k] : y[k] + s * a[k] + t * b[k];
        }
    }
}

static void rotation_of(const double v[3], long double r[3][3])
{
    long double angle = sqrtl((long double)v[0] * v[0] + (long double)v[1] * v[1] + (long double)v[2] * v[2]);
    long double s = angle > 0 ? sinl(angle / 2) / angle : 0.5L, q[4] = {cosl(angle / 2), s * v[0], s * v[1], s * v[2]};
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        r[i][i] = 1 - 2 * (q[1 + j] * q[1 + j] + q[1 + k] * q[1 + k]);
        r[i][j] = 2 * (q[1 + i] * q[1 + j] - q[0] * q[1 + k]);
        r[i][k] = 2 * (q[1 + i] * q[1 + k] + q[0] * q[1 + j]);
    }
}

static void compose(const long double a[3][3], const long double b[3][3], long double out[3][3])
{
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            out[i][k] = a[i][0] * b[0][k] + a[i][1] * b[1][k] + a[i][2] * b[2][k];
        }
    }
}

space_place space_moving_place(const space_moving *g, const double p[3], const double v[3], double spin)
{
    long double a[3][3], b[3][3], s[3][3], x[3];
    space_place start, at;
    double turn[3] = {v[0], v[1], v[2]}, about[3] = {spin, spin / 3, -spin};
    if (g->dims == 2) { /* from the axis towards v: about their cross product */
        double to[3];
        for (int k = 0; k < 3; k++) {
            to[k] = v[0] * g->side[0][k] + v[1] * g->side[1][k];
            about[k] = spin * g->axis[k];
        }
        cross(g->axis, to, turn);
    }
    oracle_space_place(g->q->start, &start);
    for (int i = 0; i < 3 && g->body->obstacles; i++) {
        for (int k = 0; k < i; k++) {
            long double t = start.r[i][k];
            start.r[i][k] = start.r[k][i];
            start.r[k][i] = t;
        }
    }
    rotation_of(turn, a);
    rotation_of(about, b);
    if (g->dims != 3) {
        compose(a, b, s);
        memcpy(a, s, sizeof s);
    }
    compose(a, start.r, s);
    for (int i = 0; i < 3; i++) {
        x[i] = p[i] - (s[i][0] * g->pivot[0] + s[i][1] * g->pivot[1] + s[i][2] * g->pivot[2]);
    }
    for (int i = 0; i < 3; i++) {
        at.x[i] = g->body->obstacles ? -(s[0][i] * x[0] + s[1][i] * x[1] + s[2][i] * x[2]) : x[i];
        for (int k = 0; k < 3; k++) {
            at.r[i][k] = g->body->obstacles ? s[k][i] : s[i][k];
        }
    }
    return at;
}

