/* oracle.c: judge planar scenes by flooding voxels of (x, y, angle), and paths by closed formulas. */
#include "oracle.h"

#include <math.h>
#include <stdlib.h>

#include "random.h"

#define PI 3.14159265358979323846
#define FAR 1e30L

#define BLOCKED 1u   /* every pose in the closed voxel collides (inner balls) */
#define SHUT_X 2u    /* the step from this centre to the next in x is not certified (outer balls) */
#define SHUT_Y 4u    /* likewise in y */
#define SHUT_TURN 8u /* likewise a turn by half a step either way */
#define VISITED_A 16u /* reached through voxels that are not BLOCKED */
#define VISITED_B 32u /* centre reached by certified steps */

/* ---- poses ---------------------------------------------------------------------------------------- */

/* No overflow to fear below 2^31, and much quicker than hypotl. */
static long double norm(long double x, long double y)
{
    return sqrtl(x * x + y * y);
}

/* Exact products: entries are at most 2^30. */
static void turn_of(const cage_pose *pose, long double *c, long double *s)
{
    int64_t w = pose->q[0], z = pose->q[3];
    long double n = (long double)(w * w + z * z);
    *c = (long double)(w * w - z * z) / n;
    *s = (long double)(2 * w * z) / n;
}

static void pivot_of(const cage_pose *pose, const int32_t pivot[3], long double p[2])
{
    long double c, s;
    turn_of(pose, &c, &s);
    p[0] = (long double)pose->x[0] + c * pivot[0] - s * pivot[1];
    p[1] = (long double)pose->x[1] + s * pivot[0] + c * pivot[1];
}

static const cage_ball *balls_of(const cage_shape *shape, int32_t side, int32_t *count)
{
    *count = side == CAGE_SIDE_INNER ? shape->inner_count : shape->outer_count;
    return side == CAGE_SIDE_INNER ? shape->inner : shape->outer;
}

long double oracle_depth_at(const cage_scene *scene, const int32_t pivot[3], const long double p[2],
                            long double cosine, long double sine, int32_t side)
{
    int32_t n, m;
    const cage_ball *b = balls_of(&scene->object, side, &n), *walls = balls_of(&scene->obstacles, side, &m);
    long double worst = -FAR;
    for (int32_t i = 0; i < n; i++) {
        long double y0 = (long double)b[i].x - pivot[0], y1 = (long double)b[i].y - pivot[1];
        long double x0 = p[0] + cosine * y0 - sine * y1, x1 = p[1] + sine * y0 + cosine * y1;
        for (int32_t j = 0; j < m; j++) {
            long double depth = (long double)b[i].r + walls[j].r - norm(x0 - walls[j].x, x1 - walls[j].y);
            worst = depth > worst ? depth : worst;
        }
    }
    return worst;
}

long double oracle_depth(const cage_scene *scene, const cage_pose *pose, int32_t side)
{
    static const int32_t origin[3] = {0, 0, 0};
    long double p[2], c, s;
    pivot_of(pose, origin, p);
    turn_of(pose, &c, &s);
    return oracle_depth_at(scene, origin, p, c, s, side);
}

/* ---- legs ------------------------------------------------------------------------------------------ */

static long double segment_distance(const long double a[2], const long double b[2], const long double x[2])
{
    long double d0 = b[0] - a[0], d1 = b[1] - a[1], length2 = d0 * d0 + d1 * d1;
    long double t = length2 > 0 ? ((x[0] - a[0]) * d0 + (x[1] - a[1]) * d1) / length2 : 0;
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    return norm(a[0] + t * d0 - x[0], a[1] + t * d1 - x[1]);
}

/* Distance from x to the arc that v sweeps about the origin when turned by an angle in [-pi, pi]. */
static long double arc_distance(const long double v[2], long double angle, const long double x[2])
{
    long double to = atan2l(v[0] * x[1] - v[1] * x[0], v[0] * x[0] + v[1] * x[1]);
    long double c = cosl(angle), s = sinl(angle);
    long double first = norm(x[0] - v[0], x[1] - v[1]);
    long double last = norm(x[0] - (c * v[0] - s * v[1]), x[1] - (s * v[0] + c * v[1]));
    if (angle < 0 ? to <= 0 && to >= angle : to >= 0 && to <= angle) {
        return fabsl(norm(x[0], x[1]) - norm(v[0], v[1]));
    }
    return first < last ? first : last;
}

/* Worst depth while the pivot goes from a to b turned by (c, s), then turns by the angle (one of them is none). */
static long double leg_depth(const cage_scene *scene, const int32_t pivot[3], const long double a[2],
                             const long double b[2], long double c, long double s, long double angle)
{
    long double worst = -FAR;
    for (int32_t i = 0; i < scene->object.outer_count; i++) {
        const cage_ball *ball = &scene->object.outer[i];
        long double y0 = (long double)ball->x - pivot[0], y1 = (long double)ball->y - pivot[1];
        long double v[2] = {c * y0 - s * y1, s * y0 + c * y1};
        for (int32_t j = 0; j < scene->obstacles.outer_count; j++) {
            const cage_ball *o = &scene->obstacles.outer[j];
            long double x[2] = {o->x - v[0], o->y - v[1]}, d[2] = {o->x - b[0], o->y - b[1]};
            long double along = segment_distance(a, b, x);
            long double around = angle == 0 ? along : arc_distance(v, angle, d);
            long double depth = (long double)ball->r + o->r - (along < around ? along : around);
            worst = depth > worst ? depth : worst;
        }
    }
    return worst;
}

/* ---- voxels --------------------------------------------------------------------------------------- */

/* Voxel (i, j, k) is [lo + i w, lo + (i + 1) w] x ... in the plane of the pivot, and the angles at most half
 * a step from t0 + k step. All its numbers are meant as the reals the doubles are. */
typedef struct voxels {
    const cage_scene *scene;
    int32_t pivot[3];
    double lo[2], w, t0, step;
    int n[2], nt;
    unsigned char *cell;
    unsigned char *painted; /* nt flags: slabs are painted when first entered */
    int32_t *stack;
} voxels;

static size_t voxel_index(const voxels *v, int i, int j, int k)
{
    return ((size_t)k * (size_t)v->n[1] + (size_t)j) * (size_t)v->n[0] + (size_t)i;
}

/* Any point does; the middle of the box around the centres keeps displacements small. */
static void pivot_choose(voxels *v)
{
    const cage_shape *s = &v->scene->object;
    v->pivot[0] = v->pivot[1] = v->pivot[2] = 0;
    if (s->outer_count > 0) {
        int32_t lo[2] = {s->outer[0].x, s->outer[0].y}, hi[2] = {lo[0], lo[1]};
        for (int32_t i = 1; i < s->outer_count; i++) {
            int32_t c[2] = {s->outer[i].x, s->outer[i].y};
            for (int a = 0; a < 2; a++) {
                lo[a] = c[a] < lo[a] ? c[a] : lo[a];
                hi[a] = c[a] > hi[a] ? c[a] : hi[a];
            }
        }
        v->pivot[0] = (int32_t)(((int64_t)lo[0] + hi[0]) / 2);
        v->pivot[1] = (int32_t)(((int64_t)lo[1] + hi[1]) / 2);
    }
}

static double arm(const voxels *v, const cage_ball *b)
{
    return hypot((double)b->x - v->pivot[0], (double)b->y - v->pivot[1]);
}

static void pose_place(const voxels *v, const cage_pose *pose, double p[2])
{
    long double l[2];
    pivot_of(pose, v->pivot, l);
    p[0] = (double)l[0];
    p[1] = (double)l[1];
}

/* A box that holds start and goal and off which the pivot is so far out that nothing collides. */
static void box_around(const voxels *v, const cage_pose *start, const cage_pose *goal, double lo[2],
                       double hi[2])
{
    double reach = 0, p[2];
    pose_place(v, start, p);
    lo[0] = hi[0] = p[0];
    lo[1] = hi[1] = p[1];
    if (goal) {
        pose_place(v, goal, p);
        for (int a = 0; a < 2; a++) {
            lo[a] = fmin(lo[a], p[a]);
            hi[a] = fmax(hi[a], p[a]);
        }
    }
    for (int32_t i = 0; i < v->scene->object.outer_count; i++) {
        reach = fmax(reach, arm(v, &v->scene->object.outer[i]) + v->scene->object.outer[i].r);
    }
    for (int32_t j = 0; j < v->scene->obstacles.outer_count; j++) {
        const cage_ball *o = &v->scene->obstacles.outer[j];
        double far_out = reach + o->r + 1;
        lo[0] = fmin(lo[0], o->x - far_out);
        hi[0] = fmax(hi[0], o->x + far_out);
        lo[1] = fmin(lo[1], o->y - far_out);
        hi[1] = fmax(hi[1], o->y + far_out);
    }
}

/* Angle steps for which the farthest ball moves about half a voxel; one slab if no ball moves. */
static int slabs_for(const voxels *v)
{
    double longest = 0;
    for (int32_t i = 0; i < v->scene->object.outer_count; i++) {
        longest = fmax(longest, arm(v, &v->scene->object.outer[i]));
    }
    for (int32_t i = 0; i < v->scene->object.inner_count; i++) {
        longest = fmax(longest, arm(v, &v->scene->object.inner[i]));
    }
    double n = ceil(2 * PI * longest / v->w);
    return longest == 0 ? 1 : n < 8 ? 8 : n > 1024 ? 1024 : (int)n;
}

static double angle_of(const cage_pose *pose)
{
    return 2 * atan2((double)pose->q[3], (double)pose->q[0]);
}

/* The start is put in the middle of its voxel, which keeps it clear of walls as long as possible. */
static int voxels_make(voxels *v, const cage_scene *scene, const cage_pose *start, const cage_pose *goal, int n)
{
    double lo[2], hi[2], p[2];
    v->scene = scene;
    pivot_choose(v);
    box_around(v, start, goal, lo, hi);
    v->w = fmax(fmax(hi[0] - lo[0], hi[1] - lo[1]), 1) / (n > 8 ? n - 4 : 4);
    pose_place(v, start, p);
    for (int a = 0; a < 2; a++) {
        double before = ceil((p[a] - lo[a]) / v->w) + 1.5;
        v->lo[a] = p[a] - before * v->w;
        v->n[a] = (int)ceil((hi[a] - v->lo[a]) / v->w) + 1;
    }
    v->nt = slabs_for(v);
    v->t0 = angle_of(start);
    v->step = 2 * PI / v->nt;
    size_t total = voxel_index(v, 0, 0, v->nt);
    v->cell = calloc(total, 1);
    v->painted = calloc((size_t)v->nt, 1);
    v->stack = malloc(total * sizeof *v->stack);
    return v->cell && v->painted && v->stack;
}

static void voxels_drop(voxels *v)
{
    free(v->cell);
    free(v->painted);
    free(v->stack);
}

static int clamp_index(double x, int n)
{
    return x < 0 ? 0 : x > n ? n : (int)x;
}

static void paint_row(const voxels *v, unsigned char *row, double first, double last, unsigned bit)
{
    int from = clamp_index(first, v->n[0]), to = clamp_index(last + 1, v->n[0]);
    for (int i = from; i < to; i++) {
        row[i] |= (unsigned char)bit;
    }
}

/* The square lies in the discs about a and b of radius r: of all discs with centres on the segment ab these
 * two hold no point that some other does not. All in voxel widths. */
static void paint_inside(const voxels *v, int k, const double a[2], const double b[2], double r)
{
    int from = clamp_index(ceil(fmax(a[1], b[1]) - r), v->n[1]);
    int to = clamp_index(floor(fmin(a[1], b[1]) + r), v->n[1]);
    for (int j = from; j < to; j++) {
        double p = fmax(fabs(j - a[1]), fabs(j + 1 - a[1])), q = fmax(fabs(j - b[1]), fabs(j + 1 - b[1]));
        if (p <= r && q <= r) {
            double ha = sqrt(r * r - p * p), hb = sqrt(r * r - q * q);
            paint_row(v, &v->cell[voxel_index(v, 0, j, k)], ceil(fmax(a[0] - ha, b[0] - hb)),
                      floor(fmin(a[0] + ha, b[0] + hb)) - 1, BLOCKED);
        }
    }
}

/* Shut the steps that start, or lie, within r of z; long and high are the step's extent from the centre. */
static void paint_steps(const voxels *v, int k, const double z[2], double r, int longer, int higher, unsigned bit)
{
    double x = z[0] - 0.5, y = z[1] - 0.5;
    int from = clamp_index(ceil(y - r) - higher, v->n[1]), to = clamp_index(floor(y + r) + 1, v->n[1]);
    for (int j = from; j < to; j++) {
        double m = fmax(0, fmax(j - y, y - (j + higher)));
        if (m <= r) {
            double half = sqrt(r * r - m * m);
            paint_row(v, &v->cell[voxel_index(v, 0, j, k)], ceil(x - half) - longer, floor(x + half), bit);
        }
    }
}

/* Where the pivot collides in a slab turned by (c, s), in voxels from lo. */
static void collision_centre(const voxels *v, const cage_ball *b, const cage_ball *o, double angle, double z[2])
{
    double c = cos(angle), s = sin(angle), y0 = (double)b->x - v->pivot[0], y1 = (double)b->y - v->pivot[1];
    z[0] = (o->x - (c * y0 - s * y1) - v->lo[0]) / v->w;
    z[1] = (o->y - (s * y0 + c * y1) - v->lo[1]) / v->w;
}

/* Within a slab the centre moves on an arc that is at most its sagitta off the chord. */
static void paint_blocked(const voxels *v, int k, const cage_ball *b)
{
    double t = v->t0 + k * v->step, half = v->step / 2, sagitta = arm(v, b) * (1 - cos(half));
    for (int32_t j = 0; j < v->scene->obstacles.inner_count; j++) {
        const cage_ball *o = &v->scene->obstacles.inner[j];
        double r = ((double)b->r + o->r - sagitta - ORACLE_SLACK) / v->w, first[2], last[2];
        if (r > 0) {
            collision_centre(v, b, o, t - half, first);
            collision_centre(v, b, o, t + half, last);
            paint_inside(v, k, first, last, r);
        }
    }
}

/* Half a step of turning moves the centre by at most the chord. */
static void paint_shut(const voxels *v, int k, const cage_ball *b)
{
    double t = v->t0 + k * v->step, chord = 2 * sin(v->step / 4) * arm(v, b) / v->w;
    for (int32_t j = 0; j < v->scene->obstacles.outer_count; j++) {
        const cage_ball *o = &v->scene->obstacles.outer[j];
        double r = ((double)b->r + o->r + ORACLE_SLACK) / v->w, z[2];
        collision_centre(v, b, o, t, z);
        paint_steps(v, k, z, r, 1, 0, SHUT_X);
        paint_steps(v, k, z, r, 0, 1, SHUT_Y);
        paint_steps(v, k, z, r + chord, 0, 0, SHUT_TURN);
    }
}

static void paint_slab(const voxels *v, int k)
{
    if (!v->painted[k]) {
        v->painted[k] = 1;
        for (int32_t i = 0; i < v->scene->object.inner_count; i++) {
            paint_blocked(v, k, &v->scene->object.inner[i]);
        }
        for (int32_t i = 0; i < v->scene->object.outer_count; i++) {
            paint_shut(v, k, &v->scene->object.outer[i]);
        }
    }
}

static size_t voxel_of(const voxels *v, const cage_pose *pose)
{
    double p[2], turns = (angle_of(pose) - v->t0) / v->step;
    pose_place(v, pose, p);
    int k = (int)floor(turns + 0.5) % v->nt;
    return voxel_index(v, (int)floor((p[0] - v->lo[0]) / v->w), (int)floor((p[1] - v->lo[1]) / v->w),
                       k < 0 ? k + v->nt : k);
}

/* Neighbours through the six faces: turn after, turn before, x up, x down, y up, y down; at itself if none. */
static void neighbours(const voxels *v, size_t at, size_t next[6], int *border)
{
    size_t row = (size_t)v->n[0], column = (size_t)v->n[1];
    int i = (int)(at % row), j = (int)(at / row % column), k = (int)(at / row / column);
    int after = k + 1 == v->nt ? 0 : k + 1, before = k == 0 ? v->nt - 1 : k - 1;
    paint_slab(v, after);
    paint_slab(v, before);
    next[0] = voxel_index(v, i, j, after);
    next[1] = voxel_index(v, i, j, before);
    next[2] = i + 1 < v->n[0] ? at + 1 : at;
    next[3] = i > 0 ? at - 1 : at;
    next[4] = j + 1 < v->n[1] ? at + row : at;
    next[5] = j > 0 ? at - row : at;
    *border = i == 0 || j == 0 || i == v->n[0] - 1 || j == v->n[1] - 1;
}

/* Faces are enough: a closed voxel keeps its whole boundary, so free paths cross an edge or a corner
 * only where all voxels around it are open. */
static unsigned open_faces(const voxels *v, const size_t next[6])
{
    unsigned open = 0;
    for (int f = 0; f < 6; f++) {
        open |= v->cell[next[f]] & BLOCKED ? 0u : 1u << f;
    }
    return open;
}

static unsigned certified_steps(const voxels *v, size_t at, const size_t next[6])
{
    unsigned open = 0, turns = v->cell[at] & SHUT_TURN;
    open |= (turns | (v->cell[next[0]] & SHUT_TURN)) ? 0 : 1u;
    open |= (turns | (v->cell[next[1]] & SHUT_TURN)) ? 0 : 2u;
    open |= (v->cell[at] & SHUT_X) ? 0 : 4u;
    open |= (v->cell[next[3]] & SHUT_X) ? 0 : 8u;
    open |= (v->cell[at] & SHUT_Y) ? 0 : 16u;
    open |= (v->cell[next[5]] & SHUT_Y) ? 0 : 32u;
    return open;
}

/* 1: reached the goal, or without one the border of the box, where nothing collides. */
static int flood(const voxels *v, size_t from, const size_t *goal, unsigned visited)
{
    size_t top = 0, next[6];
    int border;
    v->cell[from] |= (unsigned char)visited;
    v->stack[top++] = (int32_t)from;
    while (top) {
        size_t at = (size_t)v->stack[--top];
        neighbours(v, at, next, &border);
        if (goal ? at == *goal : border) {
            return 1;
        }
        unsigned open = visited == VISITED_A ? open_faces(v, next) : certified_steps(v, at, next);
        for (int f = 0; f < 6; f++) {
            if ((open >> f & 1) && !(v->cell[next[f]] & visited)) {
                v->cell[next[f]] |= (unsigned char)visited;
                v->stack[top++] = (int32_t)next[f];
            }
        }
    }
    return 0;
}

/* Centre and angle of a voxel. */
static void centre_of(const voxels *v, size_t at, long double p[2], long double *angle)
{
    size_t row = (size_t)v->n[0], column = (size_t)v->n[1];
    p[0] = v->lo[0] + ((double)(at % row) + 0.5) * v->w;
    p[1] = v->lo[1] + ((double)(at / row % column) + 0.5) * v->w;
    *angle = v->t0 + (double)(at / row / column) * v->step;
}

/* Is the way from the voxel's centre straight to the goal's place and then round to its angle free? */
static int goal_joined(const voxels *v, const cage_pose *goal, size_t at)
{
    long double a[2], b[2], angle, turn;
    centre_of(v, at, a, &angle);
    pivot_of(goal, v->pivot, b);
    turn = remainderl(angle_of(goal) - angle, 2 * (long double)PI);
    return leg_depth(v->scene, v->pivot, a, b, cosl(angle), sinl(angle), turn) < -ORACLE_SLACK;
}

/* Bit 0: proved separated, bit 1: proved joined; -1: no memory. sides: which of them to try. */
static int judge(const cage_scene *scene, const cage_pose *start, const cage_pose *goal, int n, int sides)
{
    voxels v;
    int answer = -1;
    if (voxels_make(&v, scene, start, goal, n)) {
        size_t from = voxel_of(&v, start), to = goal ? voxel_of(&v, goal) : 0;
        answer = 0;
        paint_slab(&v, 0);
        if (sides & 1) {
            answer |= flood(&v, from, goal ? &to : NULL, VISITED_A) ? 0 : 1;
        }
        if ((sides & 2) && !(answer & 1) && (!goal || goal_joined(&v, goal, to))) {
            answer |= flood(&v, from, goal ? &to : NULL, VISITED_B) ? 2 : 0;
        }
    }
    voxels_drop(&v);
    return answer;
}

int oracle_caged(const cage_scene *scene, const cage_pose *start, const cage_pose *goal, int n)
{
    return judge(scene, start, goal, n, 1) == 1;
}

int oracle_path(const cage_scene *scene, const cage_pose *start, const cage_pose *goal, int n)
{
    return judge(scene, start, goal, n, 2) == 2;
}

int32_t oracle_decide(const cage_scene *scene, const cage_pose *start, const cage_pose *goal, int max_n)
{
    int sides = 1;
    if (oracle_depth(scene, start, CAGE_SIDE_INNER) > ORACLE_SLACK ||
        (goal && oracle_depth(scene, goal, CAGE_SIDE_INNER) > ORACLE_SLACK)) {
        return CAGE_IN_COLLISION;
    }
    if (oracle_depth(scene, start, CAGE_SIDE_OUTER) < -ORACLE_SLACK) {
        sides = 3;
    }
    for (int n = 24; n <= max_n; n *= 2) {
        int answer = judge(scene, start, goal, n, sides);
        if (answer == 1) {
            return goal ? CAGE_DISCONNECTED : CAGE_CAGED;
        }
        if (answer == 2) {
            return goal ? CAGE_CONNECTED : CAGE_FREE;
        }
    }
    return CAGE_UNDEFINED;
}

/* ---- audit ---------------------------------------------------------------------------------------- */

/* A place in [0, 1], at its ends and middle as often as elsewhere, where a wrong bound would show first. */
static double spot_random(uint64_t *state)
{
    double u = random_unit(state);
    return u < 0.5 ? floor(u * 6) / 2 : random_unit(state);
}

static long double depth_in_voxel(const voxels *v, size_t at, const double d[3], int32_t side)
{
    long double p[2], angle;
    centre_of(v, at, p, &angle);
    p[0] += d[0] * v->w;
    p[1] += d[1] * v->w;
    angle += d[2] * v->step;
    return oracle_depth_at(v->scene, v->pivot, p, cosl(angle), sinl(angle), side);
}

/* One random pose of the closed voxel, one of each certified step from its centre. */
static int audit_voxel(const voxels *v, size_t at, uint64_t *rng)
{
    static const double ways[6][3] = {{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
    double d[3] = {spot_random(rng) - 0.5, spot_random(rng) - 0.5, spot_random(rng) - 0.5};
    size_t next[6];
    int border, wrong = (v->cell[at] & BLOCKED) && depth_in_voxel(v, at, d, CAGE_SIDE_INNER) <= 0;
    neighbours(v, at, next, &border);
    unsigned open = certified_steps(v, at, next);
    for (int f = 0; f < 6; f++) {
        double u = spot_random(rng), e[3] = {u * ways[f][0], u * ways[f][1], u * ways[f][2]};
        wrong += (open >> f & 1) && next[f] != at && depth_in_voxel(v, at, e, CAGE_SIDE_OUTER) >= 0;
    }
    return wrong;
}

/* All corners, edges, faces and the middle of a closed voxel. */
static int audit_rims(const voxels *v, size_t at)
{
    int wrong = 0;
    for (int k = 0; k < 27 && (v->cell[at] & BLOCKED); k++) {
        double d[3] = {k % 3 / 2.0 - 0.5, k / 3 % 3 / 2.0 - 0.5, k / 9 / 2.0 - 0.5};
        wrong += depth_in_voxel(v, at, d, CAGE_SIDE_INNER) <= 0;
    }
    return wrong;
}

int oracle_audit(const cage_scene *scene, const cage_pose *start, int n, int samples, uint64_t seed)
{
    voxels v;
    int wrong = -1;
    if (voxels_make(&v, scene, start, NULL, n)) {
        wrong = 0;
        size_t slab = voxel_index(&v, 0, 0, 1), all = slab * (size_t)v.nt;
        for (size_t at = 0; at < all && samples == 0; at++) {
            paint_slab(&v, (int)(at / slab));
            wrong += audit_rims(&v, at);
        }
        for (int s = 0; s < samples; s++) {
            size_t at = (size_t)(random_unit(&seed) * (double)all);
            paint_slab(&v, (int)(at / slab));
            wrong += audit_voxel(&v, at, &seed);
        }
    }
    voxels_drop(&v);
    return wrong;
}

/* ---- paths ---------------------------------------------------------------------------------------- */

static int same_turn(const cage_pose *a, const cage_pose *b)
{
    return (int64_t)a->q[0] * b->q[3] == (int64_t)a->q[3] * b->q[0];
}

static int same_place(const cage_pose *a, const cage_pose *b)
{
    return a->x[0] == b->x[0] && a->x[1] == b->x[1];
}

static void place_of(const cage_pose *pose, long double p[2])
{
    p[0] = pose->x[0];
    p[1] = pose->x[1];
}

/* A short move between a pose of the user's and its pose of the pivot. */
static long double end_depth(const cage_scene *scene, const cage_pose *user, const int32_t pivot[3],
                             const cage_pose *pose, const char **wrong)
{
    long double a[2], b[2], c, s;
    pivot_of(user, pivot, a);
    place_of(pose, b);
    turn_of(pose, &c, &s);
    if (!same_turn(user, pose)) {
        *wrong = "an end of the path is turned";
    } else if (norm(a[0] - b[0], a[1] - b[1]) >= 1 + 1e-6L) {
        *wrong = "an end of the path is a unit or more off";
    }
    return leg_depth(scene, pivot, a, b, c, s, 0);
}

/* q and -q are the same turn: the shorter arc has the relative quaternion with a positive real part. */
static long double step_depth(const cage_scene *scene, const int32_t pivot[3], const cage_pose *from,
                              const cage_pose *to, const char **wrong)
{
    long double a[2], b[2], c, s, angle = 0;
    place_of(from, a);
    place_of(to, b);
    turn_of(from, &c, &s);
    if (!same_turn(from, to)) {
        int64_t w = (int64_t)from->q[0] * to->q[0] + (int64_t)from->q[3] * to->q[3];
        int64_t z = (int64_t)from->q[0] * to->q[3] - (int64_t)from->q[3] * to->q[0];
        angle = 2 * atan2l((long double)(w < 0 ? -z : z), (long double)(w < 0 ? -w : w));
        if (w == 0) {
            *wrong = "a turn by half a circle has no shorter arc";
        } else if (!same_place(from, to)) {
            *wrong = "a leg moves and turns at once";
        }
    }
    return leg_depth(scene, pivot, a, b, c, s, angle);
}

/* Does some axis-parallel line part the whole object from all obstacles? */
static int beyond(const cage_scene *scene, const int32_t pivot[3], const cage_pose *pose)
{
    long double c, s;
    int out[4] = {1, 1, 1, 1};
    turn_of(pose, &c, &s);
    for (int32_t i = 0; i < scene->object.outer_count; i++) {
        const cage_ball *b = &scene->object.outer[i];
        long double y0 = (long double)b->x - pivot[0], y1 = (long double)b->y - pivot[1];
        long double at[2] = {pose->x[0] + c * y0 - s * y1, pose->x[1] + s * y0 + c * y1};
        for (int32_t j = 0; j < scene->obstacles.outer_count; j++) {
            const cage_ball *o = &scene->obstacles.outer[j];
            long double need = (long double)b->r + o->r - 1e-6L;
            out[0] = out[0] && at[0] - o->x >= need;
            out[1] = out[1] && o->x - at[0] >= need;
            out[2] = out[2] && at[1] - o->y >= need;
            out[3] = out[3] && o->y - at[1] >= need;
        }
    }
    return out[0] || out[1] || out[2] || out[3];
}

static void poses_in_range(const cage_pose *path, int32_t count, const char **wrong)
{
    for (int32_t k = 0; k < count; k++) {
        int64_t w = path[k].q[0], z = path[k].q[3];
        if ((w == 0 && z == 0) || path[k].q[1] || path[k].q[2] || path[k].x[2]) {
            *wrong = "a pose is none in the plane";
        } else if (llabs(w) > CAGE_QUATERNION_2D || llabs(z) > CAGE_QUATERNION_2D) {
            *wrong = "a pose is out of range";
        }
    }
}

long double oracle_check_path(const cage_scene *scene, const cage_pose *start, const cage_pose *goal,
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
