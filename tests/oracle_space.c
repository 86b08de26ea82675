/* oracle_space.c: depths of poses and paths in space by closed formulas, linked chains, and what decides a question. */
#include "oracle_space.h"

#include <math.h>
#include <stdlib.h>

#include "oracle_space_flood.h"
#include "oracle_space_tree.h"

#define PI 3.14159265358979323846264338327950288L
#define FAR 1e30L

/* ---- poses ------------------------------------------------------------------------------------------- */

void oracle_space_place(const cage_pose *pose, space_place *out)
{
    const int64_t w = pose->q[0], x = pose->q[1], y = pose->q[2], z = pose->q[3]; /* at most 2^24: exact */
    const int64_t r[3][3] = {
        {w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)},
        {2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)},
        {2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z}};
    for (int i = 0; i < 3; i++) {
        out->x[i] = pose->x[i];
        for (int k = 0; k < 3; k++) {
            out->r[i][k] = (long double)r[i][k] / (long double)(w * w + x * x + y * y + z * z);
        }
    }
}

static long double dot(const long double a[3], const long double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const long double a[3], const long double b[3], long double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static long double distance(const long double a[3], const long double b[3])
{
    long double d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    return sqrtl(dot(d, d));
}

static void centre_of(const cage_ball *b, long double c[3])
{
    c[0] = b->x;
    c[1] = b->y;
    c[2] = b->z;
}

static void apply(const space_place *at, const long double y[3], long double out[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = at->x[i] + dot(at->r[i], y);
    }
}

static const cage_ball *balls_of(const cage_shape *shape, int32_t side, int32_t *count)
{
    *count = side == CAGE_SIDE_INNER ? shape->inner_count : shape->outer_count;
    return side == CAGE_SIDE_INNER ? shape->inner : shape->outer;
}

long double oracle_space_depth_at(const cage_scene *scene, const space_place *at, int32_t side)
{
    int32_t n, m;
    const cage_ball *b = balls_of(&scene->object, side, &n), *o = balls_of(&scene->obstacles, side, &m);
    long double worst = -FAR;
    for (int32_t i = 0; i < n; i++) {
        long double y[3], c[3], x[3];
        centre_of(&b[i], y);
        apply(at, y, c);
        for (int32_t j = 0; j < m; j++) {
            centre_of(&o[j], x);
            worst = fmaxl(worst, (long double)b[i].r + o[j].r - distance(c, x));
        }
    }
    return worst;
}

long double oracle_space_depth(const cage_scene *scene, const cage_pose *pose, int32_t side)
{
    space_place at;
    oracle_space_place(pose, &at);
    return oracle_space_depth_at(scene, &at, side);
}

/* ---- paths ------------------------------------------------------------------------------------------- */

static long double segment_distance(const long double a[3], const long double b[3], const long double x[3])
{
    long double d[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, e[3] = {x[0] - a[0], x[1] - a[1], x[2] - a[2]};
    long double length = dot(d, d), t = length > 0 ? dot(d, e) / length : 0;
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    for (int k = 0; k < 3; k++) {
        e[k] -= t * d[k];
    }
    return sqrtl(dot(e, e));
}

/* Distance from x to the arc that v sweeps about the unit axis by the angle, 0 to pi: on the circle it grows with the
 * angle from x. */
static long double arc_distance(const long double axis[3], long double angle, const long double v[3], const long double x[3])
{
    long double high = dot(axis, v), a[3], b[3], c[3], end[3], side[3];
    cross(axis, v, side);
    for (int k = 0; k < 3; k++) {
        a[k] = v[k] - high * axis[k];
        b[k] = x[k] - dot(axis, x) * axis[k];
        end[k] = high * axis[k] + cosl(angle) * a[k] + sinl(angle) * side[k];
    }
    cross(a, b, c);
    long double to = atan2l(dot(axis, c), dot(a, b));
    if (to >= 0 && to <= angle) {
        long double flat = sqrtl(dot(a, a)) - sqrtl(dot(b, b)), up = dot(axis, x) - high;
        return sqrtl(flat * flat + up * up);
    }
    return fminl(distance(v, x), distance(end, x));
}

/* A leg: the pivot goes straight from a to b turned by r, then the object turns about the unit axis by an angle. */
typedef struct leg {
    long double a[3], b[3], axis[3], angle;
    space_place turn; /* x is 0 */
} leg;

/* Where the pose is that lies s of the way along the straight part, then u of the way round. */
static void pose_on(const leg *l, const int32_t pivot[3], long double s, long double u, space_place *out)
{
    long double c = cosl(u * l->angle), d = sinl(u * l->angle), back[3] = {-pivot[0], -pivot[1], -pivot[2]};
    for (int k = 0; k < 3; k++) {
        long double v[3] = {l->turn.r[0][k], l->turn.r[1][k], l->turn.r[2][k]}, w[3];
        cross(l->axis, v, w);
        for (int i = 0; i < 3; i++) {
            out->r[i][k] = c * v[i] + d * w[i] + (1 - c) * dot(l->axis, v) * l->axis[i];
        }
        out->x[k] = l->a[k] + s * (l->b[k] - l->a[k]);
    }
    apply(out, back, out->x);
}

static long double leg_depth(const cage_scene *scene, const int32_t pivot[3], const leg *l, const char **wrong)
{
    long double worst = -FAR;
    for (int32_t i = 0; i < scene->object.outer_count; i++) {
        long double y[3], v[3];
        centre_of(&scene->object.outer[i], y);
        for (int k = 0; k < 3; k++) {
            y[k] -= pivot[k];
        }
        apply(&l->turn, y, v);
        for (int32_t j = 0; j < scene->obstacles.outer_count; j++) {
            long double x[3], from_ball[3], from_pivot[3];
            centre_of(&scene->obstacles.outer[j], x);
            for (int k = 0; k < 3; k++) {
                from_ball[k] = x[k] - v[k];
                from_pivot[k] = x[k] - l->b[k];
            }
            long double near_one = segment_distance(l->a, l->b, from_ball);
            if (l->angle > 0) {
                near_one = fminl(near_one, arc_distance(l->axis, l->angle, v, from_pivot));
            }
            worst = fmaxl(worst, (long double)scene->object.outer[i].r + scene->obstacles.outer[j].r - near_one);
        }
    }
    for (int k = 0; k <= 12; k++) {
        space_place at;
        pose_on(l, pivot, k < 6 ? k / 6.0L : 1, k < 6 ? 0 : (k - 6) / 6.0L, &at);
        if (oracle_space_depth_at(scene, &at, CAGE_SIDE_OUTER) > worst + ORACLE_SLACK) {
            *wrong = "the judge's formulas disagree";
        }
    }
    return worst;
}

static int same_turn(const cage_pose *a, const cage_pose *b)
{
    for (int i = 0; i < 4; i++) {
        for (int k = 0; k < i; k++) {
            if ((int64_t)a->q[i] * b->q[k] != (int64_t)a->q[k] * b->q[i]) {
                return 0;
            }
        }
    }
    return 1;
}

static void leg_begin(const cage_pose *pose, leg *l)
{
    oracle_space_place(pose, &l->turn);
    for (int k = 0; k < 3; k++) {
        l->turn.x[k] = l->axis[k] = 0;
        l->a[k] = l->b[k] = pose->x[k];
    }
    l->angle = 0;
}

/* A short move between a pose of the user's and its pose of the pivot. */
static long double end_depth(const cage_scene *scene, const cage_pose *user, const int32_t pivot[3],
                             const cage_pose *pose, const char **wrong)
{
    leg l;
    space_place at;
    long double c[3] = {pivot[0], pivot[1], pivot[2]};
    leg_begin(pose, &l);
    oracle_space_place(user, &at);
    apply(&at, c, l.a);
    if (!same_turn(user, pose)) {
        *wrong = "an end of the path is turned";
    } else if (distance(l.a, l.b) >= 1 + 1e-6L) {
        *wrong = "an end of the path is a unit or more off";
    }
    return leg_depth(scene, pivot, &l, wrong);
}

/* q and -q are the same rotation: the shorter arc has the relative quaternion r q* with a positive real part. */
static long double step_depth(const cage_scene *scene, const int32_t pivot[3], const cage_pose *from,
                              const cage_pose *to, const char **wrong)
{
    leg l;
    leg_begin(from, &l);
    for (int k = 0; k < 3; k++) {
        l.b[k] = to->x[k];
    }
    if (!same_turn(from, to)) {
        const int32_t *q = from->q, *r = to->q;
        int64_t w = 0, v[3];
        for (int i = 0; i < 4; i++) {
            w += (int64_t)q[i] * r[i];
        }
        for (int i = 0; i < 3; i++) {
            int j = 1 + (i + 1) % 3, k = 1 + (i + 2) % 3;
            v[i] = (int64_t)r[1 + i] * q[0] - (int64_t)r[0] * q[1 + i] - (int64_t)r[j] * q[k] + (int64_t)r[k] * q[j];
            l.axis[i] = (long double)(w < 0 ? -v[i] : v[i]);
        }
        long double s = sqrtl(dot(l.axis, l.axis));
        for (int i = 0; i < 3; i++) {
            l.axis[i] /= s;
        }
        l.angle = 2 * atan2l(s, fabsl((long double)w));
        if (w == 0) {
            *wrong = "a turn by half a circle has no shorter arc";
        } else if (from->x[0] != to->x[0] || from->x[1] != to->x[1] || from->x[2] != to->x[2]) {
            *wrong = "a leg moves and turns at once";
        }
    }
    return leg_depth(scene, pivot, &l, wrong);
}

/* Does some plane across an axis part the whole object from all obstacles? */
static int beyond(const cage_scene *scene, const int32_t pivot[3], const cage_pose *pose)
{
    int out[6] = {1, 1, 1, 1, 1, 1};
    leg l;
    leg_begin(pose, &l);
    for (int32_t i = 0; i < scene->object.outer_count; i++) {
        long double y[3], v[3], x[3];
        centre_of(&scene->object.outer[i], y);
        for (int k = 0; k < 3; k++) {
            y[k] -= pivot[k];
        }
        apply(&l.turn, y, v);
        for (int32_t j = 0; j < scene->obstacles.outer_count; j++) {
            centre_of(&scene->obstacles.outer[j], x);
            long double need = (long double)scene->object.outer[i].r + scene->obstacles.outer[j].r - 1e-6L;
            for (int k = 0; k < 3; k++) {
                out[2 * k] &= l.a[k] + v[k] - x[k] >= need;
                out[2 * k + 1] &= x[k] - l.a[k] - v[k] >= need;
            }
        }
    }
    return out[0] || out[1] || out[2] || out[3] || out[4] || out[5];
}

static void poses_in_range(const cage_pose *path, int32_t count, const char **wrong)
{
    for (int32_t k = 0; k < count; k++) {
        int any = 0;
        for (int i = 0; i < 4; i++) {
            any = any || path[k].q[i];
            if (llabs((long long)path[k].q[i]) > CAGE_QUATERNION_3D) {
                *wrong = "a pose is out of range";
            }
        }
        if (!any) {
            *wrong = "a pose has no rotation";
        }
    }
}

long double oracle_space_check_path(const cage_scene *scene, const cage_pose *start, const cage_pose *goal,
                                    const int32_t pivot[3], const cage_pose *path, int32_t count, const char **wrong)
{
    *wrong = count < 1 ? "the path is empty" : NULL;
    poses_in_range(path, count, wrong);
    if (*wrong) {
        return FAR;
    }
    long double worst = end_depth(scene, start, pivot, &path[0], wrong);
    for (int32_t k = 0; k + 1 < count; k++) {
        worst = fmaxl(worst, step_depth(scene, pivot, &path[k], &path[k + 1], wrong));
    }
    if (goal) {
        worst = fmaxl(worst, end_depth(scene, goal, pivot, &path[count - 1], wrong));
    } else if (!beyond(scene, pivot, &path[count - 1])) {
        *wrong = "the last pose is not beyond all obstacles";
    }
    return worst;
}

/* ---- linked chains ----------------------------------------------------------------------------------- */

/* Overlapping neighbours: the polygon through the centres lies in the open balls, and no free motion crosses it. */
static int is_chain(const cage_ball *ball, int32_t n)
{
    for (int32_t i = 0; i < n; i++) {
        const cage_ball *a = &ball[i], *b = &ball[(i + 1) % n];
        int64_t x = (int64_t)a->x - b->x, y = (int64_t)a->y - b->y, z = (int64_t)a->z - b->z, sum = (int64_t)a->r + b->r;
        if (x * x + y * y + z * z >= sum * sum) {
            return 0;
        }
    }
    return n >= 3;
}

static long double arcsine(const long double a[3], const long double b[3])
{
    long double d = dot(a, b);
    return asinl(d > 1 ? 1 : d < -1 ? -1 : d);
}

/* Gauss's integral over two segments a b and c d: the signed area on the sphere of the directions between them. */
static long double seen_area(const long double a[3], const long double b[3], const long double c[3], const long double d[3])
{
    const long double *from[4] = {a, a, b, b}, *to[4] = {c, d, d, c};
    long double r[4][3], n[4][3], ab[3], cd[3], turn[3], area = 0;
    for (int i = 0; i < 4; i++) {
        for (int k = 0; k < 3; k++) {
            r[i][k] = to[i][k] - from[i][k];
            ab[k] = b[k] - a[k];
            cd[k] = d[k] - c[k];
        }
    }
    for (int i = 0; i < 4; i++) {
        cross(r[i], r[(i + 1) % 4], n[i]);
        long double length = sqrtl(dot(n[i], n[i]));
        if (length < 1e-9L) {
            return 0; /* in one plane */
        }
        for (int k = 0; k < 3; k++) {
            n[i][k] /= length;
        }
    }
    for (int i = 0; i < 4; i++) {
        area += arcsine(n[i], n[(i + 1) % 4]);
    }
    cross(cd, ab, turn);
    long double sign = dot(turn, r[0]);
    return sign > 0 ? area : sign < 0 ? -area : 0;
}

/* How often the chains are linked; -1000 when that cannot be told. */
static int linking(const space_question *q, const cage_pose *pose)
{
    const cage_ball *ring = q->scene->object.inner, *walls = q->scene->obstacles.inner;
    int32_t n = q->object_ring, m = q->obstacle_ring;
    space_place at;
    long double sum = 0;
    oracle_space_place(pose, &at);
    for (int32_t i = 0; i < n; i++) {
        long double y[3], z[3], a[3], b[3], c[3], d[3];
        centre_of(&ring[i], y);
        centre_of(&ring[(i + 1) % n], z);
        apply(&at, y, a);
        apply(&at, z, b);
        for (int32_t j = 0; j < m; j++) {
            centre_of(&walls[j], c);
            centre_of(&walls[(j + 1) % m], d);
            sum += seen_area(a, b, c, d);
        }
    }
    sum /= 4 * PI;
    return fabsl(sum - roundl(sum)) < 0.01L ? (int)roundl(sum) : -1000;
}

int oracle_space_linked(const space_question *q)
{
    if (q->object_ring < 3 || q->obstacle_ring < 3 || !is_chain(q->scene->object.inner, q->object_ring) ||
        !is_chain(q->scene->obstacles.inner, q->obstacle_ring)) {
        return 0;
    }
    int here = linking(q, q->start), there = q->goal ? linking(q, q->goal) : 0;
    return here != there && here != -1000 && there != -1000;
}

/* ---- the question ------------------------------------------------------------------------------------ */

typedef int (*prover)(const space_question *, const space_body *, int, long, space_audit *);

/* Finer and finer until it is proved, or costs too much. */
static int refine(prover prove, const space_question *q, const space_body *body, const space_effort *effort, space_audit *audit)
{
    for (int n = body->part == SPACE_WHOLE ? 12 : 16; n <= effort->finest; n = n * 3 / 2) {
        int answer = prove(q, body, n, effort->work, audit);
        if (answer) {
            return answer > 0;
        }
    }
    return 0;
}

/* The largest inner ball: if any cannot leave, it most likely cannot. */
static int32_t largest(const cage_shape *shape)
{
    int32_t best = 0;
    for (int32_t i = 1; i < shape->inner_count; i++) {
        best = shape->inner[i].r > shape->inner[best].r ? i : best;
    }
    return best;
}

int oracle_space_separated(const space_question *q, const space_effort *effort, space_audit *audit, const char **how)
{
    *how = "links";
    if (oracle_space_linked(q)) {
        return 1;
    }
    *how = "one ball";
    space_body ball = {0, SPACE_BALL, largest(&q->scene->object)};
    if (q->scene->object.inner_count > 0 && refine(space_separated, q, &ball, effort, audit)) {
        return 1;
    }
    space_body line = {0, SPACE_LINE, 0}, post = {1, SPACE_LINE, 0}, whole = {0, SPACE_WHOLE, 0};
    *how = "line";
    if (q->scene->object.inner_count > 1 && refine(space_separated, q, &line, effort, audit)) {
        return 1;
    }
    *how = "post";
    if (q->scene->obstacles.inner_count <= 12 && refine(space_separated, q, &post, effort, audit)) {
        return 1;
    }
    *how = "whole";
    return q->scene->object.inner_count > 1 && refine(space_separated, q, &whole, effort, audit);
}

int oracle_space_joined(const space_question *q, const space_effort *effort, space_audit *audit, const char **how)
{
    int32_t balls = q->scene->object.outer_count;
    space_body body = {0, balls == 1 ? SPACE_BALL : SPACE_LINE, 0}, post = {1, SPACE_LINE, 0};
    *how = "tree";
    if (space_tree_joins(q, effort->tries / 8, audit)) {
        return 1;
    }
    *how = balls == 1 ? "ball steps" : "line steps";
    if (refine(space_joined, q, &body, effort, audit)) {
        return 1;
    }
    *how = "post steps";
    if (q->scene->obstacles.outer_count <= 12 && refine(space_joined, q, &post, effort, audit)) {
        return 1;
    }
    *how = "tree";
    return space_tree_joins(q, effort->tries, audit);
}

int32_t oracle_space_decide(const space_question *q, const space_effort *effort, space_audit *audit, const char **how)
{
    *how = "depth";
    if (oracle_space_depth(q->scene, q->start, CAGE_SIDE_INNER) > ORACLE_SLACK ||
        (q->goal && oracle_space_depth(q->scene, q->goal, CAGE_SIDE_INNER) > ORACLE_SLACK)) {
        return CAGE_IN_COLLISION;
    }
    if (oracle_space_joined(q, effort, audit, how)) {
        return q->goal ? CAGE_CONNECTED : CAGE_FREE;
    }
    if (oracle_space_separated(q, effort, audit, how)) {
        return q->goal ? CAGE_DISCONNECTED : CAGE_CAGED;
    }
    *how = "nothing";
    return CAGE_UNDEFINED;
}
