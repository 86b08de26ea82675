/* oracle_space_tree.c: grow trees of certified moves from the start, and from the goal.
 *
 * A move goes straight, then turns about the pivot. A ball's centre goes along a segment, then along an arc; the
 * distances of obstacles from both are closed formulas. */
#include "oracle_space_tree.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "random.h"

#define MOST_BALLS 160

typedef struct node {
    double p[3], q[4];
    int parent;
} node;

typedef struct tree {
    node *at;
    int count;
} tree;

typedef struct grower {
    int balls, walls;
    double ball[MOST_BALLS][4], wall[MOST_BALLS][4]; /* from the pivot; in the world */
    double pivot[3];
    double middle[3], size;                          /* of the obstacles */
    double arm;
    uint64_t rng;
    tree from, to;
    const space_question *question;
} grower;

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* ---- moves ------------------------------------------------------------------------------------------- */

static void rotate(const double q[4], const double v[3], double out[3])
{
    double a[3], b[3];
    cross(&q[1], v, a);
    cross(&q[1], a, b);
    for (int k = 0; k < 3; k++) {
        out[k] = v[k] + 2 * (q[0] * a[k] + b[k]);
    }
}

static void normalise(double q[4])
{
    double n = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (int k = 0; k < 4; k++) {
        q[k] /= n;
    }
}

/* Is the whole segment from a to b, moved by v, more than `need` off c? */
static int segment_clear(const double a[3], const double b[3], const double v[3], const double c[3], double need)
{
    double d[3], e[3];
    for (int k = 0; k < 3; k++) {
        d[k] = b[k] - a[k];
        e[k] = c[k] - v[k] - a[k];
    }
    double length = dot(d, d), t = length > 0 ? dot(d, e) / length : 0;
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    for (int k = 0; k < 3; k++) {
        e[k] -= t * d[k];
    }
    return dot(e, e) > need * need;
}

static int straight_clear(const grower *g, const double a[3], const double b[3], const double q[4])
{
    for (int i = 0; i < g->balls; i++) {
        double v[3];
        rotate(q, g->ball[i], v);
        for (int j = 0; j < g->walls; j++) {
            if (!segment_clear(a, b, v, g->wall[j], g->ball[i][3] + g->wall[j][3] + ORACLE_SLACK)) {
                return 0;
            }
        }
    }
    return 1;
}

/* Is x more than `need` off the arc that v sweeps about the unit axis by the angle, 0 to pi, to v2? */
static int arc_clear(const double axis[3], double angle, const double v[3], const double v2[3], const double x[3], double need)
{
    double h = dot(axis, x) - dot(axis, v), c[3], a[3] = {0, 0, 0}, b[3] = {0, 0, 0};
    for (int k = 0; k < 3; k++) {
        a[k] = v[k] - dot(axis, v) * axis[k];
        b[k] = x[k] - dot(axis, x) * axis[k];
    }
    double apart = sqrt(dot(a, a)) - sqrt(dot(b, b));
    if (h * h + apart * apart > need * need) {
        return 1; /* off the whole circle */
    }
    cross(a, b, c);
    double to = atan2(dot(axis, c), dot(a, b));
    if (to >= -1e-9 && to <= angle + 1e-9) {
        return 0;
    }
    double first[3] = {x[0] - v[0], x[1] - v[1], x[2] - v[2]}, last[3] = {x[0] - v2[0], x[1] - v2[1], x[2] - v2[2]};
    return dot(first, first) > need * need && dot(last, last) > need * need;
}

/* The shorter arc from q to r, both of unit length. */
static int turn_clear(const grower *g, const double p[3], const double q[4], const double r[4])
{
    double w = r[0] * q[0] + r[1] * q[1] + r[2] * q[2] + r[3] * q[3], axis[3];
    axis[0] = r[1] * q[0] - r[0] * q[1] - r[2] * q[3] + r[3] * q[2];
    axis[1] = r[2] * q[0] - r[0] * q[2] - r[3] * q[1] + r[1] * q[3];
    axis[2] = r[3] * q[0] - r[0] * q[3] - r[1] * q[2] + r[2] * q[1];
    double s = sqrt(dot(axis, axis)), angle = 2 * atan2(s, fabs(w));
    if (s < 1e-12) {
        return straight_clear(g, p, p, r);
    }
    for (int k = 0; k < 3; k++) {
        axis[k] *= (w < 0 ? -1 : 1) / s;
    }
    for (int i = 0; i < g->balls; i++) {
        double v[3], v2[3];
        rotate(q, g->ball[i], v);
        rotate(r, g->ball[i], v2);
        for (int j = 0; j < g->walls; j++) {
            double x[3] = {g->wall[j][0] - p[0], g->wall[j][1] - p[1], g->wall[j][2] - p[2]};
            if (!arc_clear(axis, angle, v, v2, x, g->ball[i][3] + g->wall[j][3] + ORACLE_SLACK)) {
                return 0;
            }
        }
    }
    return 1;
}

static int move_clear(const grower *g, const node *a, const node *b)
{
    return straight_clear(g, a->p, b->p, a->q) && turn_clear(g, b->p, a->q, b->q);
}

/* ---- trees ------------------------------------------------------------------------------------------- */

static double distance(const grower *g, const node *a, const node *b)
{
    double d[3] = {a->p[0] - b->p[0], a->p[1] - b->p[1], a->p[2] - b->p[2]};
    double w = fabs(a->q[0] * b->q[0] + a->q[1] * b->q[1] + a->q[2] * b->q[2] + a->q[3] * b->q[3]);
    return dot(d, d) + 4 * g->arm * g->arm * fmax(0, 1 - w * w);
}

static int nearest(const grower *g, const tree *t, const node *to)
{
    int best = 0;
    double least = distance(g, &t->at[0], to);
    for (int i = 1; i < t->count; i++) {
        double d = distance(g, &t->at[i], to);
        if (d < least) {
            least = d;
            best = i;
        }
    }
    return best;
}

static int add(tree *t, const node *n, int parent)
{
    t->at[t->count] = *n;
    t->at[t->count].parent = parent;
    return t->count++;
}

/* The share u of the way from a to b, pivot and rotation each. */
static node between(const node *a, const node *b, double u)
{
    node n = *a;
    double w = a->q[0] * b->q[0] + a->q[1] * b->q[1] + a->q[2] * b->q[2] + a->q[3] * b->q[3];
    for (int k = 0; k < 4; k++) {
        n.q[k] = (1 - u) * a->q[k] + (w < 0 ? -u : u) * b->q[k];
        if (k < 3) {
            n.p[k] = (1 - u) * a->p[k] + u * b->p[k];
        }
    }
    normalise(n.q);
    return n;
}

/* Up to `steps` steps from the nearest node towards a node; the last node added, or -1. *met: the node itself was reached. */
static int grow(const grower *g, tree *t, const node *to, double step, int steps, int room, int *met)
{
    int at = nearest(g, t, to), added = -1;
    *met = 0;
    while (steps-- > 0 && t->count < room && !*met) {
        double far_off = sqrt(distance(g, &t->at[at], to));
        node next = far_off <= step ? *to : between(&t->at[at], to, step / far_off);
        *met = far_off <= step;
        if (!move_clear(g, &t->at[at], &next)) {
            node slid = next, turned = t->at[at];
            memcpy(slid.q, t->at[at].q, sizeof slid.q);
            memcpy(turned.q, next.q, sizeof turned.q);
            *met = 0;
            if (straight_clear(g, t->at[at].p, slid.p, slid.q)) {
                next = slid;
            } else if (turn_clear(g, turned.p, t->at[at].q, turned.q)) {
                next = turned;
            } else {
                break;
            }
            steps = 0;
        }
        added = at = add(t, &next, at);
    }
    return added;
}

static void rotation_random(grower *g, double q[4])
{
    double n;
    do {
        n = 0;
        for (int k = 0; k < 4; k++) {
            q[k] = 2 * random_unit(&g->rng) - 1;
            n += q[k] * q[k];
        }
    } while (n > 1 || n < 0.01);
    normalise(q);
}

static node node_random(grower *g, double spread)
{
    node n;
    for (int k = 0; k < 3; k++) {
        n.p[k] = g->middle[k] + (2 * random_unit(&g->rng) - 1) * spread;
    }
    rotation_random(g, n.q);
    n.parent = -1;
    return n;
}

/* Is the straight way off in some direction clear? Tries the one from the middle and a few random ones. */
static int escapes(grower *g, const node *n, double out[3])
{
    for (int attempt = 0; attempt < 4; attempt++) {
        double d[3], length;
        for (int k = 0; k < 3; k++) {
            d[k] = attempt ? 2 * random_unit(&g->rng) - 1 : n->p[k] - g->middle[k];
        }
        length = sqrt(dot(d, d));
        if (length < 1e-3) {
            continue;
        }
        for (int k = 0; k < 3; k++) { /* so far that the start's own distance does not matter */
            out[k] = n->p[k] + d[k] / length * (8 * g->size + 4 * fabs(n->p[k] - g->middle[k]) + 100);
        }
        double away[3] = {out[0] - g->middle[0], out[1] - g->middle[1], out[2] - g->middle[2]};
        if (sqrt(dot(away, away)) > 2 * g->size && straight_clear(g, n->p, out, n->q)) {
            return 1;
        }
    }
    return 0;
}

static node node_of(const grower *g, const cage_pose *pose)
{
    node n;
    double v[3];
    for (int k = 0; k < 4; k++) {
        n.q[k] = pose->q[k];
    }
    normalise(n.q);
    rotate(n.q, g->pivot, v);
    for (int k = 0; k < 3; k++) {
        n.p[k] = pose->x[k] + v[k];
    }
    n.parent = -1;
    return n;
}

static void balls_take(grower *g)
{
    const cage_shape *object = &g->question->scene->object, *walls = &g->question->scene->obstacles;
    double lo[3] = {1e30, 1e30, 1e30}, hi[3] = {-1e30, -1e30, -1e30};
    g->balls = object->outer_count;
    g->walls = walls->outer_count;
    g->arm = 1;
    for (int i = 0; i < g->balls; i++) {
        const cage_ball *b = &object->outer[i];
        double c[3] = {b->x, b->y, b->z};
        for (int k = 0; k < 3; k++) {
            lo[k] = fmin(lo[k], c[k]);
            hi[k] = fmax(hi[k], c[k]);
            g->pivot[k] = (lo[k] + hi[k]) / 2;
        }
    }
    for (int i = 0; i < g->balls; i++) {
        const cage_ball *b = &object->outer[i];
        double c[3] = {b->x - g->pivot[0], b->y - g->pivot[1], b->z - g->pivot[2]};
        memcpy(g->ball[i], c, sizeof c);
        g->ball[i][3] = b->r;
        g->arm = fmax(g->arm, sqrt(dot(c, c)) + 0.5 * b->r);
    }
    for (int j = 0; j < g->walls; j++) {
        const cage_ball *o = &walls->outer[j];
        double c[4] = {o->x, o->y, o->z, o->r};
        memcpy(g->wall[j], c, sizeof c);
        for (int k = 0; k < 3; k++) {
            lo[k] = j ? fmin(lo[k], c[k] - c[3]) : c[k] - c[3];
            hi[k] = j ? fmax(hi[k], c[k] + c[3]) : c[k] + c[3];
            g->middle[k] = (lo[k] + hi[k]) / 2;
        }
    }
    double d[3] = {hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]};
    g->size = g->walls ? sqrt(dot(d, d)) / 2 + 2 * g->arm : 2 * g->arm;
}

/* Poses all along the moves, by another formula. */
static void look_along(const grower *g, const node *a, const node *b, space_audit *audit)
{
    for (int i = 0; audit && i <= 40; i++) {
        node n = i < 20 ? *a : between(a, b, (i - 20) / 20.0);
        for (int k = 0; k < 3; k++) {
            n.p[k] = i < 20 ? a->p[k] + i / 20.0 * (b->p[k] - a->p[k]) : b->p[k];
        }
        space_place at;
        for (int k = 0; k < 3; k++) {
            double e[3] = {k == 0, k == 1, k == 2}, v[3];
            rotate(n.q, e, v);
            for (int l = 0; l < 3; l++) {
                at.r[l][k] = v[l];
            }
        }
        for (int l = 0; l < 3; l++) {
            at.x[l] = n.p[l] - (at.r[l][0] * g->pivot[0] + at.r[l][1] * g->pivot[1] + at.r[l][2] * g->pivot[2]);
        }
        audit->looked++;
        audit->wrong += oracle_space_depth_at(g->question->scene, &at, CAGE_SIDE_OUTER) >= 0;
    }
}

static void look_back(const grower *g, const tree *t, int at, space_audit *audit)
{
    for (; at > 0; at = t->at[at].parent) {
        look_along(g, &t->at[t->at[at].parent], &t->at[at], audit);
    }
}

static int try_out(grower *g, int at, space_audit *audit)
{
    node last = g->from.at[at];
    if (!escapes(g, &g->from.at[at], last.p)) {
        return 0;
    }
    look_along(g, &g->from.at[at], &last, audit);
    look_back(g, &g->from, at, audit);
    return 1;
}

static int search(grower *g, int tries, space_audit *audit)
{
    int met, room = tries, has_goal = g->question->goal != NULL;
    if (!straight_clear(g, g->from.at[0].p, g->from.at[0].p, g->from.at[0].q)) {
        return 0;
    }
    if (!has_goal && try_out(g, 0, audit)) {
        return 1;
    }
    if (has_goal && !straight_clear(g, g->to.at[0].p, g->to.at[0].p, g->to.at[0].q)) {
        return 0;
    }
    for (int n = 0; n < tries; n++) {
        double step = g->size * (n % 3 == 0 ? 0.2 : n % 3 == 1 ? 0.05 : 0.015);
        tree *a = has_goal && n % 2 ? &g->to : &g->from, *b = a == &g->from ? &g->to : &g->from;
        node aim = node_random(g, g->size * (n % 4 ? 0.5 : 1.2));
        int near_one = n % 4 == 2; /* a little off some node: narrow ways */
        if (near_one) {
            const node *o = &a->at[(int)(random_unit(&g->rng) * a->count)];
            aim = between(o, &aim, 0.1 * random_unit(&g->rng));
        }
        int at = grow(g, a, &aim, step, 4, room, &met);
        if (at < 0) {
            continue;
        }
        if (!has_goal) {
            if (try_out(g, at, audit)) {
                return 1;
            }
        } else {
            node here = a->at[at];
            int other = grow(g, b, &here, step, 20, room, &met);
            if (other >= 0 && met) {
                look_back(g, a, at, audit);
                look_back(g, b, other, audit);
                return 1;
            }
        }
        if (a->count >= room) {
            return 0;
        }
    }
    return 0;
}

int space_tree_joins(const space_question *q, int tries, space_audit *audit)
{
    grower *g = calloc(1, sizeof *g);
    int joined = 0;
    if (g && q->scene->object.outer_count <= MOST_BALLS && q->scene->obstacles.outer_count <= MOST_BALLS) {
        g->question = q;
        g->rng = 1;
        balls_take(g);
        g->from.at = malloc(((size_t)tries + 32) * sizeof *g->from.at);
        g->to.at = malloc(((size_t)tries + 32) * sizeof *g->to.at);
        if (g->from.at && g->to.at) {
            node start = node_of(g, q->start), goal = node_of(g, q->goal ? q->goal : q->start);
            add(&g->from, &start, -1);
            add(&g->to, &goal, -1);
            joined = search(g, tries, audit);
        }
        free(g->from.at);
        free(g->to.at);
    }
    free(g);
    return joined;
}
