/* oracle_space_flood.c: flood boxes of R^3 x rotations.
 *
 * Rotations are exp(v) S, S that of the start and v in a cube around the ball |v| <= pi, cut evenly. As exp does not
 * lengthen, the rotations of a box are within its half diagonal of the one at its centre, and move a point at a
 * distance a from the pivot by at most a times that.
 * Rotations with |v| = pi are met twice, at v and at -v: boxes there are neighbours of their mirror images. A body
 * symmetric about an axis needs v across that axis only, and all v with |v| = pi are one. */
#include "oracle_space_flood.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "oracle_space_body.h"
#include "random.h"

#define PI 3.14159265358979323846
#define TINY 1e-9

typedef struct flood {
    space_moving g;
    /* boxes */
    double w, lo[3];
    long n[3], m, turns;           /* m per axis of rotations, turns in all; turn number `turns` stands for all with |v| = pi */
    double (*offset)[3];           /* of each mover from the pivot, at the turn looked at last */
    long offset_turn;              /* which that is */
    double *limit;                 /* of each pair: a box is closed below, a centre is clear above; squared */
    int last[2];                   /* the pair that closed a box last */
    /* what is visited, and what is to be */
    int64_t *table, *stack;
    size_t table_size, table_used, stack_size, stack_used;
    long cells;
    int failed;
    space_audit *audit;
} flood;

enum { INSIDE = 1, RIM = 2 }; /* of the ball |v| <= pi */

/* ---- boxes -------------------------------------------------------------------------------------------- */

static void turn_centre(const flood *f, long turn, double v[3])
{
    for (int k = 0; k < 3; k++) {
        v[k] = k < f->g.dims ? 2 * PI / (double)f->m * (double)(2 * (turn % f->m) - f->m + 1) / 2 : 0;
        turn /= f->m;
    }
}

/* Where the turn's box lies as to the ball |v| <= pi. */
static int turn_kind(const flood *f, long turn)
{
    double v[3], half = PI / (double)f->m, least = 0, most = 0;
    turn_centre(f, turn, v);
    for (int k = 0; k < f->g.dims; k++) {
        double low = fmax(0, fabs(v[k]) - half), high = fabs(v[k]) + half;
        least += low * low;
        most += high * high;
    }
    if (least > PI * PI + TINY) {
        return 0;
    }
    return f->g.dims > 0 && most >= PI * PI - TINY ? INSIDE | RIM : INSIDE;
}

static void offsets_for(flood *f, long turn)
{
    double v[3];
    if (f->offset_turn != turn) {
        f->offset_turn = turn;
        turn_centre(f, turn, v);
        space_moving_turn(&f->g, v, f->offset);
    }
}

/* For a separation the distance to the far corner of the box must be below the limit, for a path that to its centre above. */
static void limits_fill(flood *f)
{
    double angle = PI / (double)f->m * (f->g.path ? 1 : sqrt(f->g.dims));
    for (int i = 0; i < f->g.movers; i++) {
        double moved = f->g.dims ? f->g.mover[i].arm * angle : 0;
        for (int j = 0; j < f->g.walls; j++) {
            double sum = f->g.mover[i].r + f->g.wall[j][3];
            double limit = f->g.path ? sum + ORACLE_SLACK + fmax(moved, f->w / 2) : sum - ORACLE_SLACK - moved;
            f->limit[i * f->g.walls + j] = limit > 0 ? limit * limit : -1;
        }
    }
}

/* Start in the middle of its box; off the border nothing collides. */
static int boxes_make(flood *f, int n)
{
    double lo[3], hi[3], reach = 0, arm = 0, span = 1;
    for (int i = 0; i < f->g.movers; i++) {
        reach = fmax(reach, f->g.mover[i].arm + f->g.mover[i].r);
        arm = fmax(arm, f->g.mover[i].arm);
    }
    for (int k = 0; k < 3; k++) {
        lo[k] = fmin(f->g.start[k], f->g.goal[k]);
        hi[k] = fmax(f->g.start[k], f->g.goal[k]);
        for (int j = 0; j < f->g.walls; j++) {
            double out = reach + f->g.wall[j][3] + 1;
            lo[k] = fmin(lo[k], f->g.wall[j][k] - out);
            hi[k] = fmax(hi[k], f->g.wall[j][k] + out);
        }
        span = fmax(span, hi[k] - lo[k]);
    }
    f->w = span / n;
    for (int k = 0; k < 3; k++) {
        double before = ceil((f->g.start[k] - lo[k]) / f->w) + 1.5;
        f->lo[k] = f->g.start[k] - before * f->w;
        f->n[k] = (long)ceil((hi[k] - f->lo[k]) / f->w) + 1;
    }
    /* Turning moves the farthest ball about as much as half a box; an odd number, so that the start is in the middle of one. */
    double m = f->g.dims ? arm * PI * sqrt(f->g.dims) / (0.87 * f->w) : 1;
    f->m = f->g.dims ? 2 * (long)(m / 2) + 3 : 1;
    f->turns = 1;
    for (int k = 0; k < f->g.dims; k++) {
        f->turns *= f->m;
    }
    f->offset_turn = -1;
    f->offset = malloc((size_t)f->g.movers * sizeof *f->offset);
    f->limit = malloc((size_t)f->g.movers * (size_t)f->g.walls * sizeof *f->limit);
    if (!f->offset || !f->limit) {
        return 0;
    }
    limits_fill(f);
    return 1;
}

static void box_centre(const flood *f, const long at[3], double p[3])
{
    for (int k = 0; k < 3; k++) {
        p[k] = f->lo[k] + ((double)at[k] + 0.5) * f->w;
    }
}

/* Does the pair close the box around p, or, for a path, come too near its centre? */
static int pair_shuts(const flood *f, const double p[3], int i, int j)
{
    const double *c = f->offset[i], *wall = f->g.wall[j], half = f->g.path ? 0 : f->w / 2;
    double x = fabs(p[0] + c[0] - wall[0]) + half, y = fabs(p[1] + c[1] - wall[1]) + half;
    double z = fabs(p[2] + c[2] - wall[2]) + half;
    return x * x + y * y + z * z <= f->limit[i * f->g.walls + j];
}

static int shut(flood *f, const double p[3], long turn)
{
    offsets_for(f, turn);
    if (pair_shuts(f, p, f->last[0], f->last[1])) {
        return 1;
    }
    for (int i = 0; i < f->g.movers; i++) {
        for (int j = 0; j < f->g.walls; j++) {
            if (pair_shuts(f, p, i, j)) {
                f->last[0] = i;
                f->last[1] = j;
                return 1;
            }
        }
    }
    return 0;
}

/* ---- audit -------------------------------------------------------------------------------------------- */

/* In [-1, 1], the ends as often as all else: there a wrong bound shows first. */
static double spot_random(uint64_t *state)
{
    double u = random_unit(state);
    return u < 0.5 ? (u < 0.25 ? -1 : 1) : 2 * random_unit(state) - 1;
}

/* The depth of the pair that closed the last box. */
static long double pair_depth(const flood *f, const space_place *at)
{
    const cage_scene *scene = f->g.q->scene;
    int32_t moving = f->g.mover[f->last[0]].ball, wall = f->last[1];
    cage_scene pair = {{&scene->object.inner[f->g.body->obstacles ? wall : moving], NULL, 1, 0},
                       {&scene->obstacles.inner[f->g.body->obstacles ? moving : wall], NULL, 1, 0}, 3};
    return oracle_space_depth_at(&pair, at, CAGE_SIDE_INNER);
}

/* The pair must overlap in the corners of its box that are farthest from the wall, and at a random pose. */
static void look_at_closed(flood *f, const double p[3], long turn)
{
    const double *c = f->offset[f->last[0]], *wall = f->g.wall[f->last[1]];
    uint64_t *rng = &f->audit->rng;
    for (int corner = 0; corner <= 1 << f->g.dims; corner++) {
        double at[3], v[3];
        turn_centre(f, turn, v);
        for (int k = 0; k < 3; k++) {
            double away = p[k] + c[k] > wall[k] ? 1 : -1, round = corner >> k & 1 ? 1 : -1;
            at[k] = p[k] + (corner < 1 << f->g.dims ? away : spot_random(rng)) * f->w / 2;
            v[k] += k >= f->g.dims ? 0 : (corner < 1 << f->g.dims ? round : spot_random(rng)) * PI / (double)f->m;
        }
        space_place pose = space_moving_place(&f->g, at, v, 7 * spot_random(rng));
        f->audit->looked++;
        f->audit->wrong += pair_depth(f, &pose) <= 0;
    }
}

/* Half a step from a clear centre along any axis must be clear. */
static void look_at_clear(flood *f, const double p[3], long turn)
{
    uint64_t *rng = &f->audit->rng;
    for (int axis = 0; axis < 3 + f->g.dims; axis++) {
        double at[3] = {p[0], p[1], p[2]}, v[3];
        turn_centre(f, turn, v);
        if (axis < 3) {
            at[axis] += spot_random(rng) * f->w / 2;
        } else {
            v[axis - 3] += spot_random(rng) * PI / (double)f->m;
        }
        space_place pose = space_moving_place(&f->g, at, v, 7 * spot_random(rng));
        f->audit->looked++;
        f->audit->wrong += oracle_space_depth_at(f->g.q->scene, &pose, CAGE_SIDE_OUTER) >= 0;
    }
}

/* ---- flood -------------------------------------------------------------------------------------------- */

static int64_t key_of(const flood *f, const long at[3], long turn)
{
    return (((int64_t)at[2] * f->n[1] + at[1]) * f->n[0] + at[0]) * (f->turns + 1) + turn + 1;
}

static void from_key(const flood *f, int64_t key, long at[3], long *turn)
{
    key--;
    *turn = (long)(key % (f->turns + 1));
    key /= f->turns + 1;
    at[0] = (long)(key % f->n[0]);
    key /= f->n[0];
    at[1] = (long)(key % f->n[1]);
    at[2] = (long)(key / f->n[1]);
}

static size_t slot_of(const int64_t *table, size_t size, int64_t key)
{
    size_t at = (size_t)(((uint64_t)key * 0x9e3779b97f4a7c15u) >> 20) & (size - 1);
    while (table[at] != 0 && table[at] != key) {
        at = (at + 1) & (size - 1);
    }
    return at;
}

static void table_grow(flood *f)
{
    size_t size = f->table_size ? f->table_size * 2 : 4096;
    int64_t *table = calloc(size, sizeof *table);
    if (!table) {
        f->failed = 1;
        return;
    }
    for (size_t i = 0; i < f->table_size; i++) {
        if (f->table[i]) {
            table[slot_of(table, size, f->table[i])] = f->table[i];
        }
    }
    free(f->table);
    f->table = table;
    f->table_size = size;
}

/* 1 when it was not there before. */
static int visit(flood *f, int64_t key)
{
    if (2 * (f->table_used + 1) > f->table_size) {
        table_grow(f);
    }
    size_t at = f->failed ? 0 : slot_of(f->table, f->table_size, key);
    if (f->failed || f->table[at] == key) {
        return 0;
    }
    f->table[at] = key;
    f->failed = (long)++f->table_used > f->cells;
    return !f->failed;
}

static void push(flood *f, int64_t key)
{
    if (f->stack_used == f->stack_size) {
        size_t size = f->stack_size ? 2 * f->stack_size : 1024;
        int64_t *stack = realloc(f->stack, size * sizeof *stack);
        if (!stack) {
            f->failed = 1;
            return;
        }
        f->stack = stack;
        f->stack_size = size;
    }
    f->stack[f->stack_used++] = key;
}

static void enter(flood *f, const long at[3], long turn)
{
    double p[3];
    for (int k = 0; k < 3; k++) {
        if (at[k] < 0 || at[k] >= f->n[k]) {
            return;
        }
    }
    if (turn_kind(f, turn) && visit(f, key_of(f, at, turn))) {
        box_centre(f, at, p);
        int is_shut = shut(f, p, turn);
        if (f->audit && is_shut != f->g.path && random_unit(&f->audit->rng) * f->audit->every < 1) {
            (f->g.path ? look_at_clear : look_at_closed)(f, p, turn);
        }
        if (!is_shut) {
            push(f, key_of(f, at, turn));
        }
    }
}

/* All boxes that share rotations with |v| = pi. A path does not go that way. */
static void enter_rim(flood *f, const long at[3], long turn)
{
    if (f->g.path || !(turn_kind(f, turn) & RIM)) {
        return;
    }
    if (f->g.dims == 3) {
        enter(f, at, f->turns - 1 - turn);
    } else if (visit(f, key_of(f, at, f->turns))) {
        for (long t = 0; t < f->turns; t++) {
            if (turn_kind(f, t) & RIM) {
                enter(f, at, t);
            }
        }
    }
}

/* Those away from the middle, or towards the goal, are pushed last to be popped first. */
static void enter_neighbours(flood *f, const long at[3], long turn, const long to[3])
{
    long rest = turn, step = 1;
    for (int k = 0; k < f->g.dims; k++) {
        long i = rest % f->m;
        if (i > 0) {
            enter(f, at, turn - step);
        }
        if (i < f->m - 1) {
            enter(f, at, turn + step);
        }
        rest /= f->m;
        step *= f->m;
    }
    enter_rim(f, at, turn);
    for (int last = 0; last < 2; last++) {
        for (int k = 0; k < 3; k++) {
            long next[3] = {at[0], at[1], at[2]};
            int up = f->g.has_goal ? at[k] < to[k] : at[k] > to[k];
            next[k] += up == last ? 1 : -1;
            enter(f, next, turn);
        }
    }
}

static int on_border(const flood *f, const long at[3])
{
    for (int k = 0; k < 3; k++) {
        if (at[k] == 0 || at[k] == f->n[k] - 1) {
            return 1;
        }
    }
    return 0;
}

static void box_of(const flood *f, const double p[3], const double v[3], long at[3], long *turn)
{
    *turn = 0;
    for (int k = 2; k >= 0; k--) {
        at[k] = (long)floor((p[k] - f->lo[k]) / f->w);
        if (k < f->g.dims) {
            long i = (long)floor((v[k] + PI) * (double)f->m / (2 * PI));
            *turn = *turn * f->m + (i < 0 ? 0 : i >= f->m ? f->m - 1 : i);
        }
    }
}

/* Is everything within the box of the goal's pose, so far from its centre, clear? */
static int goal_is_near(flood *f, const long at[3], long turn)
{
    double p[3], v[3], away = 0, angle = 0;
    box_centre(f, at, p);
    turn_centre(f, turn, v);
    offsets_for(f, turn);
    for (int k = 0; k < 3; k++) {
        away += (p[k] - f->g.goal[k]) * (p[k] - f->g.goal[k]);
        angle += k < f->g.dims ? (v[k] - f->g.goal_turn[k]) * (v[k] - f->g.goal_turn[k]) : 0;
    }
    for (int i = 0; i < f->g.movers; i++) {
        const double *c = f->offset[i];
        for (int j = 0; j < f->g.walls; j++) {
            double d[3] = {p[0] + c[0] - f->g.wall[j][0], p[1] + c[1] - f->g.wall[j][1], p[2] + c[2] - f->g.wall[j][2]};
            double need = f->g.mover[i].r + f->g.wall[j][3] + sqrt(away) + f->g.mover[i].arm * sqrt(angle) + ORACLE_SLACK;
            if (d[0] * d[0] + d[1] * d[1] + d[2] * d[2] <= need * need) {
                return 0;
            }
        }
    }
    return 1;
}

/* 1: at the goal; 2: out, where only a path to a goal goes on; 0: all is visited; -1: too many. */
static int run(flood *f)
{
    static const double none[3] = {0, 0, 0};
    long at[3], to[3] = {f->n[0] / 2, f->n[1] / 2, f->n[2] / 2}, turn, goal_turn = 0;
    if (f->g.has_goal) {
        box_of(f, f->g.goal, f->g.goal_turn, to, &goal_turn);
        if (f->g.path && !goal_is_near(f, to, goal_turn)) {
            return 0;
        }
    }
    box_of(f, f->g.start, none, at, &turn);
    enter(f, at, turn);
    while (f->stack_used && !f->failed) {
        from_key(f, f->stack[--f->stack_used], at, &turn);
        if (f->g.has_goal && turn == goal_turn && !memcmp(at, to, sizeof to)) {
            return 1;
        }
        if (!(f->g.has_goal && f->g.path) && on_border(f, at)) {
            return 2;
        }
        enter_neighbours(f, at, turn, to);
    }
    return f->failed ? -1 : 0;
}

static int flood_all(const space_question *q, const space_body *body, int n, long work, space_audit *audit, int path)
{
    flood f;
    memset(&f, 0, sizeof f);
    f.audit = audit;
    int answer = -1;
    if (space_moving_make(q, body, path, &f.g) && boxes_make(&f, n)) {
        f.cells = work / ((long)f.g.movers * f.g.walls + 30); /* what else a box costs is like 30 pairs */
        answer = run(&f);
    }
    space_moving_free(&f.g);
    free(f.offset);
    free(f.limit);
    free(f.table);
    free(f.stack);
    return answer;
}

int space_separated(const space_question *q, const space_body *body, int n, long work, space_audit *audit)
{
    int answer = flood_all(q, body, n, work, audit, 0);
    if (answer == 2 && q->goal) { /* the start may be outside, and the goal not */
        space_question back = *q;
        back.start = q->goal;
        back.goal = q->start;
        answer = flood_all(&back, body, n, work, audit, 0);
    }
    return answer < 0 ? -1 : !answer;
}

int space_joined(const space_question *q, const space_body *body, int n, long work, space_audit *audit)
{
    int answer = flood_all(q, body, n, work, audit, 1);
    return answer < 0 ? -1 : answer > 0;
}
