/* scenes.c: random planar scenes in integer arithmetic only, drawn in a small unit and then scaled. */
#include "scenes.h"

#include <string.h>

/* In design units |X| + R of obstacles and 3 |y| + r of objects add up to less than 40 000 by choice of the
 * families below (test_oracle checks it), so scaled by SCALE_MAX scenes fit CAGE_REACH_2D. */
#define SCALE_MAX 4000
#define CIRCLE 1024
#define CELL 1000 /* pitch of lattice scenes */

typedef struct maker {
    scene *s;
    uint64_t rng;
    int32_t width;    /* of the object, across its narrowest direction */
    int32_t reach;    /* of the object from its origin */
    int32_t region;   /* starts are drawn with |x|, |y| at most this around home */
    int32_t home[2];
    int32_t away[2];  /* goals are drawn around this */
    int32_t lattice;
} maker;

int32_t scene_between(uint64_t *state, int32_t low, int32_t high)
{
    if (high <= low) {
        return low;
    }
    uint64_t n = (uint64_t)((int64_t)high - low) + 1;
    return (int32_t)(low + (int64_t)((random_next(state) >> 11) % n));
}

static int32_t draw(maker *m, int32_t low, int32_t high)
{
    return scene_between(&m->rng, low, high);
}

/* ---- directions: 1024 of them, in 2^30ths ----------------------------------------------------------- */

/* Product of turns by 2 pi / 2^j; nine roundings, each below 2^-29. */
static void direction(int32_t k, int64_t *c, int64_t *s)
{
    static const int64_t turns[10][2] = {
        {-1073741824, 0},       {0, 1073741824},         {759250125, 759250125}, {992008094, 410903207},
        {1053110176, 209476638}, {1068571464, 105245103}, {1072448455, 52686014}, {1073418433, 26350943},
        {1073660973, 13176464}, {1073721611, 6588356}};
    *c = 1073741824;
    *s = 0;
    for (int j = 0; j < 10; j++) {
        if ((k & (CIRCLE - 1)) >> (9 - j) & 1) {
            int64_t a = (*c * turns[j][0] - *s * turns[j][1]) / 1073741824;
            *s = (*c * turns[j][1] + *s * turns[j][0]) / 1073741824;
            *c = a;
        }
    }
}

static void polar(int32_t radius, int32_t k, int32_t *x, int32_t *y)
{
    int64_t c, s;
    direction(k, &c, &s);
    *x = (int32_t)(radius * c / 1073741824);
    *y = (int32_t)(radius * s / 1073741824);
}

/* The least k with radius sin(2 pi k / CIRCLE) >= half, at most a quarter circle. */
static int32_t arc_for(int32_t half, int32_t radius)
{
    int32_t k = 0;
    int64_t c, s;
    do {
        direction(++k, &c, &s);
    } while (k < CIRCLE / 4 && radius * s / 1073741824 < half);
    return k;
}

/* ---- objects ---------------------------------------------------------------------------------------- */

static void object_ball(maker *m, int32_t x, int32_t y, int32_t r)
{
    if (m->s->object_count < SCENE_OBJECT) {
        cage_ball b = {x, y, 0, r};
        m->s->object[m->s->object_count++] = b;
    }
}

static void obstacle(maker *m, int32_t x, int32_t y, int32_t r)
{
    if (m->s->obstacle_count < SCENE_OBSTACLES && r >= 0) {
        cage_ball b = {x, y, 0, r};
        m->s->obstacles[m->s->obstacle_count++] = b;
    }
}

static int32_t snap(const maker *m, int32_t x)
{
    return m->lattice ? x / (CELL / 2) * (CELL / 2) : x;
}

static void make_bracket(maker *m)
{
    int32_t a = snap(m, draw(m, 1200, 3000)), b = snap(m, draw(m, 1200, 3600)), r = snap(m, draw(m, 500, 1100));
    object_ball(m, -a, 0, r);
    object_ball(m, a, 0, r);
    object_ball(m, 0, 0, r);
    object_ball(m, -a, b, r);
    object_ball(m, a, b, r);
}

static void make_ell(maker *m)
{
    int32_t step = snap(m, draw(m, 900, 1900)), r = snap(m, draw(m, 500, 1200)), up = draw(m, 1, 3);
    for (int32_t i = 0; i < 3; i++) {
        object_ball(m, i * step, 0, r);
    }
    for (int32_t i = 1; i <= up; i++) {
        object_ball(m, 0, i * step, r);
    }
}

static void make_plus(maker *m)
{
    int32_t a = snap(m, draw(m, 1000, 3000)), r = snap(m, draw(m, 600, 1400));
    object_ball(m, 0, 0, r);
    object_ball(m, a, 0, r);
    object_ball(m, -a, 0, r);
    object_ball(m, 0, a, r);
    object_ball(m, 0, -a, r);
}

static void make_dumbbell(maker *m)
{
    int32_t a = snap(m, draw(m, 1800, 4500)), big = snap(m, draw(m, 900, 1800)), waist = snap(m, draw(m, 300, 800));
    object_ball(m, -a, 0, big);
    object_ball(m, a, 0, big);
    for (int32_t i = -1; i <= 1; i++) {
        object_ball(m, snap(m, i * a / 2), 0, waist);
    }
}

static void make_rod(maker *m)
{
    int32_t n = draw(m, 2, 5), step = snap(m, draw(m, 800, 1600)), r = snap(m, draw(m, 500, 1300));
    for (int32_t i = 0; i < n; i++) {
        object_ball(m, (2 * i - n + 1) * step / 2, 0, r);
    }
}

static void make_blob(maker *m)
{
    int32_t n = draw(m, 2, 6);
    for (int32_t i = 0; i < n; i++) {
        object_ball(m, snap(m, draw(m, -2500, 2500)), snap(m, draw(m, -2500, 2500)), snap(m, draw(m, 500, 1600)));
    }
}

/* A ring of balls with a mouth; mouth: width left open, in CIRCLE-ths of a turn on each side. */
static void make_clasp(maker *m, int32_t radius, int32_t r, int32_t mouth)
{
    int32_t n = 7, x, y;
    for (int32_t i = 0; i < n; i++) {
        polar(radius, mouth + i * (CIRCLE - 2 * mouth) / (n - 1), &x, &y);
        object_ball(m, x, y, r);
    }
}

static int32_t object_width(const maker *m)
{
    int64_t least = INT64_MAX;
    for (int32_t k = 0; k < CIRCLE / 2; k += 8) {
        int64_t c, s, low = INT64_MAX, high = INT64_MIN;
        direction(k, &c, &s);
        for (int32_t i = 0; i < m->s->object_count; i++) {
            const cage_ball *b = &m->s->object[i];
            int64_t at = (b->x * c + b->y * s) / 1073741824;
            low = at - b->r < low ? at - b->r : low;
            high = at + b->r > high ? at + b->r : high;
        }
        least = high - low < least ? high - low : least;
    }
    return (int32_t)least;
}

static int32_t object_reach(const maker *m)
{
    int32_t most = 0;
    for (int32_t i = 0; i < m->s->object_count; i++) {
        const cage_ball *b = &m->s->object[i];
        int32_t x = b->x < 0 ? -b->x : b->x, y = b->y < 0 ? -b->y : b->y;
        int32_t reach = (x > y ? x + y / 2 : y + x / 2) + b->r;
        most = reach > most ? reach : most;
    }
    return most;
}

static void make_object(maker *m)
{
    static void (*const kinds[])(maker *) = {make_bracket, make_ell, make_plus, make_dumbbell, make_rod, make_blob};
    kinds[draw(m, 0, 5)](m);
    m->width = object_width(m);
    m->reach = object_reach(m);
}

/* A share of the object's width, in percent. */
static int32_t gap_draw(maker *m, int32_t low, int32_t high)
{
    return (int32_t)((int64_t)m->width * draw(m, low, high) / 100);
}

/* ---- surroundings ----------------------------------------------------------------------------------- */

static void jitter(maker *m, int32_t from, int32_t by)
{
    for (int32_t j = from; j < m->s->obstacle_count; j++) {
        cage_ball *o = &m->s->obstacles[j];
        o->x += draw(m, -by, by);
        o->y += draw(m, -by, by);
        o->r += draw(m, 0, by);
    }
}

static int32_t ring_radius(maker *m)
{
    int32_t radius = m->reach + draw(m, 1500, 7000);
    return radius > 17000 ? 17000 : radius;
}

/* A wall of overlapping balls along a circle, but for one gap as wide as the object is narrow. */
static void ring_with_gap(maker *m)
{
    int32_t radius = ring_radius(m), r = draw(m, 1300, 3200), gap = gap_draw(m, 50, 115), x, y;
    int32_t mouth = arc_for(gap / 2 + r, radius), turn = draw(m, 0, CIRCLE - 1);
    int32_t length = (int32_t)((int64_t)radius * 6434 / CIRCLE * (CIRCLE - 2 * mouth) / CIRCLE);
    int32_t n = length / (2 * r - 200) + 2;
    for (int32_t i = 0; i < n; i++) {
        polar(radius, turn + mouth + i * (CIRCLE - 2 * mouth) / (n - 1), &x, &y);
        obstacle(m, x, y, r);
    }
    jitter(m, 0, draw(m, 0, 60));
}

/* Evenly spaced balls, every gap about as wide as the object is narrow. */
static void ring_even(maker *m)
{
    int32_t radius = ring_radius(m) + draw(m, 0, 5000), n = draw(m, 8, 16), gap = gap_draw(m, 40, 110), x, y;
    int64_t c, s;
    direction(CIRCLE / 2 / n, &c, &s);
    int32_t r = (int32_t)(radius * s / 1073741824) - gap / 2, turn = draw(m, 0, CIRCLE - 1);
    for (int32_t i = 0; i < n; i++) {
        polar(radius, turn + i * CIRCLE / n, &x, &y);
        obstacle(m, x, y, r < 200 ? 200 : r);
    }
    jitter(m, 0, draw(m, 50, 500));
}

/* Balls all over the place; an empty spot for the start is kept in the middle. */
static void clutter(maker *m)
{
    int32_t n = draw(m, 28, 64), high = draw(m, 1800, 3600);
    for (int32_t i = 0; i < n; i++) {
        int32_t x = draw(m, -14000, 14000), y = draw(m, -14000, 14000), r = draw(m, 600, high);
        int32_t ax = x < 0 ? -x : x, ay = y < 0 ? -y : y;
        if ((ax > ay ? ax + ay / 3 : ay + ax / 3) > r + m->reach * 3 / 4) {
            obstacle(m, x, y, r);
        }
    }
}

/* A clasp closed around a post, its mouth about as wide as the post, with a few bystanders. */
static void clasp(maker *m)
{
    int32_t r = draw(m, 400, 900), radius = draw(m, 2200, 4200), post = draw(m, 600, radius - r - 200);
    int32_t gap = 2 * post * draw(m, 60, 130) / 100, others = draw(m, 2, 10), x, y;
    m->s->object_count = 0;
    make_clasp(m, radius, r, arc_for(gap / 2 + r, radius));
    obstacle(m, 0, 0, post);
    for (int32_t i = 0; i < others; i++) {
        polar(radius + draw(m, r + 1000, 8000), draw(m, 0, CIRCLE - 1), &x, &y);
        obstacle(m, x, y, draw(m, 500, 1500));
    }
    m->region = radius - r - post;
}

static void wall(maker *m, int32_t ax, int32_t ay, int32_t bx, int32_t by, int32_t r)
{
    int32_t dx = bx > ax ? bx - ax : ax - bx, dy = by > ay ? by - ay : ay - by;
    int32_t n = (dx > dy ? dx : dy) / (2 * r - 100) + 1;
    for (int32_t i = 0; i <= n; i++) {
        obstacle(m, ax + (int32_t)((int64_t)(bx - ax) * i / n), ay + (int32_t)((int64_t)(by - ay) * i / n), r);
    }
}

/* Two rooms with a door, at times with a way round it through a hole in the outer walls. */
static void chambers(maker *m)
{
    int32_t w = draw(m, 11000, 14000), h = draw(m, 6500, 9000), r = 1500, door = gap_draw(m, 55, 125) / 2 + r;
    int32_t at = draw(m, -h / 3, h / 3);
    wall(m, -w, -h, w, -h, r);
    wall(m, -w, h, w, h, r);
    wall(m, -w, -h, -w, h, r);
    wall(m, w, -h, w, h, r);
    if (draw(m, 0, 4) == 0) {
        m->s->obstacle_count -= 3;
    }
    wall(m, 0, -h, 0, at - door, r);
    wall(m, 0, at + door, 0, h, r);
    jitter(m, 0, draw(m, 0, 80));
    m->home[0] = -w / 2;
    m->away[0] = w / 2;
    m->region = h / 2;
}

/* A channel around the object with a neck at one end, closed at the other. */
static void slot(maker *m)
{
    int32_t r = draw(m, 1000, 1800), h = gap_draw(m, 60, 110) + r + 300, w = draw(m, 7000, 12000);
    int32_t neck = gap_draw(m, 50, 120) / 2 + r;
    wall(m, -w, -h, w, -h, r);
    wall(m, -w, h, w, h, r);
    wall(m, -w, -h, -w, h, r);
    if (neck < h) {
        obstacle(m, w, neck, r);
        obstacle(m, w, -neck, r);
    }
    jitter(m, 0, draw(m, 0, 80));
    m->region = w - m->reach > h ? w - m->reach : h;
}

/* Obstacles of one radius on a lattice: a square with a hole and stray balls; ties everywhere. */
static void lattice_square(maker *m)
{
    int32_t half = (m->reach / CELL + draw(m, 2, 4)) * CELL, pitch = 2 * CELL, r = draw(m, 1, 2) * CELL;
    int32_t hole = draw(m, 0, 3), hole_at = draw(m, -1, 1);
    half = half > 12000 ? 12000 : half + half / CELL % 2 * CELL;
    for (int32_t a = -half; a < half; a += pitch) {
        int32_t slot_of_a = a / pitch - hole_at;
        if (slot_of_a < 0 || slot_of_a >= hole) {
            obstacle(m, a, -half, r);
        }
        obstacle(m, -a, half, r);
        obstacle(m, half, a, r);
        obstacle(m, -half, -a, r);
    }
    m->region = half;
}

/* Two obstacles (or two pairs) pinch the waist of a dumbbell: a cage if its ends do not fit between. */
static void pinch(maker *m)
{
    int32_t a = draw(m, 2500, 5000), big = draw(m, 1100, 2200), waist = draw(m, 300, 800), r = draw(m, 900, 2600);
    int32_t gap = (2 * waist + (2 * big - 2 * waist) * draw(m, 20, 125) / 100) / 2, extra = draw(m, 0, 6);
    m->s->object_count = 0;
    object_ball(m, -a, 0, big);
    object_ball(m, a, 0, big);
    for (int32_t i = -2; i <= 2; i++) {
        object_ball(m, i * a / 3, 0, waist);
    }
    obstacle(m, 0, gap + r, r);
    obstacle(m, 0, -gap - r, r);
    jitter(m, 0, 100);
    for (int32_t i = 0; i < extra; i++) {
        int32_t x, y;
        polar(a + big + draw(m, 2000, 6000), draw(m, 0, CIRCLE - 1), &x, &y);
        obstacle(m, x, y, draw(m, 500, 1500));
    }
    m->region = a / 2;
}

/* Fingers around the object at a small distance, all but touching it. */
static void fingers(maker *m)
{
    int32_t n = draw(m, 3, 9), turn = draw(m, 0, CIRCLE - 1), slack = draw(m, 50, 1500);
    for (int32_t i = 0; i < n; i++) {
        int64_t c, s, farthest = 0;
        int32_t k = turn + i * CIRCLE / n + draw(m, -CIRCLE / 4 / n, CIRCLE / 4 / n), r = draw(m, 700, 2500), x, y;
        direction(k, &c, &s);
        for (int32_t b = 0; b < m->s->object_count; b++) {
            const cage_ball *o = &m->s->object[b];
            int64_t along = (o->x * c + o->y * s) / 1073741824, across = (o->y * c - o->x * s) / 1073741824;
            int64_t side = (across < 0 ? -across : across) / 2;
            if (side < o->r + r && along + o->r + r - side > farthest) {
                farthest = along + o->r + r - side;
            }
        }
        polar((int32_t)farthest + slack, k, &x, &y);
        obstacle(m, x, y, r);
    }
    m->region = 800;
}

/* ---- poses ------------------------------------------------------------------------------------------- */

/* Clearance of a pose in the final units, to within two; int64 holds squares of 3e9. */
static int64_t clearance(const scene *s, const cage_pose *pose)
{
    int64_t w = pose->q[0], z = pose->q[3], n = w * w + z * z, c = w * w - z * z, d = 2 * w * z, least = INT64_MAX;
    for (int32_t i = 0; i < s->object_count; i++) {
        const cage_ball *b = &s->object[i];
        int64_t x = pose->x[0] + (c * b->x - d * b->y) / n, y = pose->x[1] + (d * b->x + c * b->y) / n;
        for (int32_t j = 0; j < s->obstacle_count; j++) {
            const cage_ball *o = &s->obstacles[j];
            int64_t sum = (int64_t)b->r + o->r, apart = (x - o->x) * (x - o->x) + (y - o->y) * (y - o->y);
            int64_t spare = (apart - sum * sum) / (2 * sum + 1);
            least = spare < least ? spare : least;
        }
    }
    return least;
}

static void quaternion_draw(maker *m, cage_pose *pose)
{
    static const int32_t eighths[6][2] = {{1, 0}, {0, 1}, {1, 1}, {1, -1}, {3, 1}, {2, -1}};
    if (m->lattice || draw(m, 0, 15) == 0) {
        int32_t k = draw(m, 0, 5);
        pose->q[0] = eighths[k][0];
        pose->q[3] = eighths[k][1];
    } else {
        pose->q[0] = draw(m, -700, 700);
        pose->q[3] = draw(m, 1, 700);
    }
}

/* The roomiest of some random poses; with few tries starts are tight, and now and then collide. */
static void pose_draw(maker *m, const int32_t around[2], int32_t region, int32_t scale, cage_pose *out)
{
    int32_t tries = draw(m, 6, 60);
    int64_t best = INT64_MIN;
    for (int32_t t = 0; t < tries || (best < 0 && t < 400); t++) {
        cage_pose pose = {{0, 0, 0}, {1, 0, 0, 0}};
        for (int a = 0; a < 2; a++) {
            pose.x[a] = snap(m, around[a] + draw(m, -region, region)) * scale;
        }
        if (t > 0) {
            quaternion_draw(m, &pose);
        }
        int64_t room = clearance(m->s, &pose);
        if (room > best) {
            best = room;
            *out = pose;
        }
    }
}

static void shift_pose(cage_pose *pose, int32_t dx, int32_t dy)
{
    pose->x[0] += dx;
    pose->x[1] += dy;
}

/* ---- the whole ---------------------------------------------------------------------------------------- */

/* Scaled to many units, with the last digits random unless ties are wanted. */
static void rescale(maker *m, int32_t scale)
{
    int32_t loose = m->lattice ? 0 : scale - 1;
    for (int32_t i = 0; i < m->s->object_count; i++) {
        cage_ball *b = &m->s->object[i];
        b->x = b->x * scale + draw(m, 0, loose);
        b->y = b->y * scale + draw(m, 0, loose);
        b->r = b->r * scale + draw(m, 0, loose);
    }
    for (int32_t j = 0; j < m->s->obstacle_count; j++) {
        cage_ball *o = &m->s->obstacles[j];
        o->x = o->x * scale + draw(m, 0, loose);
        o->y = o->y * scale + draw(m, 0, loose);
        o->r = o->r * scale + draw(m, 0, loose);
    }
}

static void displace(maker *m, int32_t scale)
{
    int32_t dx = draw(m, -3000, 3000) * scale, dy = draw(m, -3000, 3000) * scale;
    for (int32_t j = 0; j < m->s->obstacle_count; j++) {
        m->s->obstacles[j].x += dx;
        m->s->obstacles[j].y += dy;
    }
    shift_pose(&m->s->start, dx, dy);
    shift_pose(&m->s->goal, dx, dy);
}

static void (*const families[SCENE_FAMILIES])(maker *) = {
    ring_with_gap, ring_even, clutter, clasp, chambers, slot, lattice_square, pinch, fingers};

const char *scene_family_text(int32_t family)
{
    static const char *const names[SCENE_FAMILIES] = {"ring with a gap", "even ring", "clutter", "clasp",
                                                      "chambers", "slot", "lattice", "pinch", "fingers"};
    return names[family];
}

static int32_t scale_draw(maker *m)
{
    if (draw(m, 0, 3) > 0) {
        return draw(m, SCALE_MAX / 2, SCALE_MAX);
    }
    int32_t most = 1 << draw(m, 0, 11);
    return draw(m, 1, most);
}

void scene_random(uint64_t seed, scene *out)
{
    maker m = {out, seed * 0xd1342543de82ef95u + 0x2545f4914f6cdd1du, 0, 0, 3000, {0, 0}, {0, 0}, 0};
    memset(out, 0, sizeof *out);
    out->seed = seed;
    out->family = (int32_t)(seed % SCENE_FAMILIES);
    m.lattice = families[out->family] == lattice_square;
    make_object(&m);
    families[out->family](&m);
    out->has_goal = families[out->family] == chambers || draw(&m, 0, 9) < 3;
    int32_t scale = scale_draw(&m), home_again = draw(&m, 0, 2) > 0;
    rescale(&m, scale);
    pose_draw(&m, m.home, m.region, scale, &out->start);
    if (out->has_goal) {
        int32_t wide = m.away[0] || home_again ? m.region : 20000;
        pose_draw(&m, m.away, wide, scale, &out->goal);
    }
    if (draw(&m, 0, 2) == 0) {
        displace(&m, scale);
    }
}

cage_scene scene_view(const scene *s)
{
    cage_scene view = {{s->object, s->object, s->object_count, s->object_count},
                       {s->obstacles, s->obstacles, s->obstacle_count, s->obstacle_count}, 2};
    return view;
}

const cage_pose *scene_goal(const scene *s)
{
    return s->has_goal ? &s->goal : NULL;
}

static void quarter_point(int quarters, int32_t *x, int32_t *y)
{
    for (int k = 0; k < (quarters & 3); k++) {
        int32_t old = *x;
        *x = -*y;
        *y = old;
    }
}

/* A quarter turn is the quaternion (1, 1), up to scale. */
static void quarter_pose(int quarters, cage_pose *pose)
{
    quarter_point(quarters, &pose->x[0], &pose->x[1]);
    for (int k = 0; k < (quarters & 3); k++) {
        int32_t w = pose->q[0], z = pose->q[3];
        pose->q[0] = w - z;
        pose->q[3] = w + z;
    }
}

void scene_quarter_turn(const scene *in, int quarters, scene *out)
{
    *out = *in;
    for (int32_t j = 0; j < out->obstacle_count; j++) {
        quarter_point(quarters, &out->obstacles[j].x, &out->obstacles[j].y);
    }
    quarter_pose(quarters, &out->start);
    if (out->has_goal) {
        quarter_pose(quarters, &out->goal);
    }
}

void scene_swap(const scene *in, scene *out)
{
    *out = *in;
    out->start = in->goal;
    out->goal = in->start;
}

static void print_pose(FILE *file, const char *name, const cage_pose *p)
{
    fprintf(file, "%s x %ld %ld q %ld %ld\n", name, (long)p->x[0], (long)p->x[1], (long)p->q[0], (long)p->q[3]);
}

static void print_balls(FILE *file, const char *name, const cage_ball *b, int32_t n)
{
    fprintf(file, "# %s: x y r\n", name);
    for (int32_t i = 0; i < n; i++) {
        fprintf(file, "%ld %ld %ld\n", (long)b[i].x, (long)b[i].y, (long)b[i].r);
    }
}

void scene_print(FILE *file, const scene *s)
{
    fprintf(file, "seed %lu, %s\n", (unsigned long)s->seed, scene_family_text(s->family));
    print_pose(file, "start", &s->start);
    if (s->has_goal) {
        print_pose(file, "goal", &s->goal);
    }
    print_balls(file, "object", s->object, s->object_count);
    print_balls(file, "obstacles", s->obstacles, s->obstacle_count);
}
