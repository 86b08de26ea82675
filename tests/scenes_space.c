/* scenes_space.c: random scenes in space in integer arithmetic only, drawn in a small unit and then scaled. */
#include "scenes_space.h"

#include <string.h>

#include "scenes.h"

/* In design units |X| + R of obstacles and 3 |y| + r of objects add up to less than 34 000 by choice of the
 * families below (test_answers_space checks it), so scaled by SCALE_MAX scenes fit CAGE_REACH_3D. */
#define SCALE_MAX 160
#define CIRCLE 4096
#define ONE 1073741824

typedef struct maker {
    space_scene *s;
    uint64_t rng;
    int32_t girth;   /* radius of about the thinnest cylinder that holds the object */
    int32_t least;   /* the object's smallest radius */
    int32_t reach;   /* of the object from its origin */
    int32_t region;  /* starts are drawn within this around home on each axis */
    int32_t home[3];
    int32_t away[3]; /* goals are drawn around this */
    int32_t lattice; /* no random last digits, and nice rotations: ties */
} maker;

static int32_t draw(maker *m, int32_t low, int32_t high)
{
    return scene_between(&m->rng, low, high);
}

static int32_t percent(maker *m, int32_t of, int32_t low, int32_t high)
{
    return (int32_t)((int64_t)of * draw(m, low, high) / 100);
}

static int32_t most(int32_t a, int32_t b)
{
    return a > b ? a : b;
}

/* ---- points on circles and spheres ------------------------------------------------------------------ */

static int64_t root(int64_t square)
{
    int64_t low = 0, high = 3037000499;
    while (low < high) {
        int64_t middle = (low + high + 1) / 2;
        if (middle * middle <= square) {
            low = middle;
        } else {
            high = middle - 1;
        }
    }
    return low;
}

/* Product of turns by 2 pi / 2^j; eleven roundings, each below 2^-29. */
static void polar(int32_t radius, int32_t k, int32_t *x, int32_t *y)
{
    static const int64_t turns[12][2] = {
        {-1073741824, 0},         {0, 1073741824},         {759250125, 759250125},  {992008094, 410903207},
        {1053110176, 209476638},  {1068571464, 105245103}, {1072448455, 52686014},  {1073418433, 26350943},
        {1073660973, 13176464},   {1073721611, 6588356},   {1073736771, 3294193},   {1073740561, 1647099}};
    int64_t c = ONE, s = 0;
    for (int j = 0; j < 12; j++) {
        if ((k & (CIRCLE - 1)) >> (11 - j) & 1) {
            int64_t a = (c * turns[j][0] - s * turns[j][1]) / ONE;
            s = (c * turns[j][1] + s * turns[j][0]) / ONE;
            c = a;
        }
    }
    *x = (int32_t)(radius * c / ONE);
    *y = (int32_t)(radius * s / ONE);
}

/* The least k with radius sin(2 pi k / CIRCLE) >= half, at most a quarter circle. */
static int32_t arc_for(int32_t half, int32_t radius)
{
    int32_t k = 0, x, y;
    do {
        polar(radius, ++k, &x, &y);
    } while (k < CIRCLE / 4 && y < half);
    return k;
}

/* Point i of n spread evenly over a sphere: equal heights, turned by the golden angle. */
static void spread(int32_t radius, int32_t n, int32_t i, int32_t p[3])
{
    p[2] = (int32_t)((int64_t)radius * (2 * i + 1 - n) / n);
    polar((int32_t)root((int64_t)radius * radius - (int64_t)p[2] * p[2]), (int32_t)((int64_t)i * 25033 / 16), &p[0], &p[1]);
}

/* The radius that n balls on such a sphere need to leave no gap. */
static int32_t cover(int32_t radius, int32_t n)
{
    return (int32_t)((int64_t)radius * 270 / root((int64_t)n * 10000));
}

static int64_t dot(const int32_t a[3], const int32_t b[3])
{
    return (int64_t)a[0] * b[0] + (int64_t)a[1] * b[1] + (int64_t)a[2] * b[2];
}

/* ---- objects ---------------------------------------------------------------------------------------- */

static void object_ball(maker *m, int32_t x, int32_t y, int32_t z, int32_t r)
{
    if (m->s->object_count < SPACE_OBJECT) {
        cage_ball b = {x, y, z, r};
        m->s->object[m->s->object_count++] = b;
    }
}

static void obstacle(maker *m, int32_t x, int32_t y, int32_t z, int32_t r)
{
    if (m->s->obstacle_count < SPACE_OBSTACLES && r >= 0) {
        cage_ball b = {x, y, z, r};
        m->s->obstacles[m->s->obstacle_count++] = b;
    }
}

static void make_ball(maker *m)
{
    object_ball(m, draw(m, -500, 500), draw(m, -500, 500), draw(m, -500, 500), draw(m, 600, 1600));
}

static void make_rod(maker *m)
{
    int32_t n = draw(m, 2, 5), step = draw(m, 500, 1100), r = draw(m, 500, 1200);
    for (int32_t i = 0; i < n; i++) {
        object_ball(m, 0, 0, (2 * i - n + 1) * step / 2, r);
    }
}

static void make_dumbbell(maker *m, int32_t a, int32_t ends, int32_t waist)
{
    object_ball(m, 0, 0, -a, ends);
    object_ball(m, 0, 0, a, percent(m, ends, 95, 105));
    for (int32_t i = -1; i <= 1; i++) {
        object_ball(m, 0, 0, i * a / 2, waist);
    }
}

static void make_weights(maker *m)
{
    make_dumbbell(m, draw(m, 900, 2200), draw(m, 700, 1500), draw(m, 300, 600));
}

static void make_ell(maker *m)
{
    int32_t step = draw(m, 600, 1200), r = draw(m, 500, 1000);
    object_ball(m, 0, 0, 0, r);
    object_ball(m, step, 0, 0, r);
    object_ball(m, 2 * step, 0, 0, r);
    object_ball(m, 0, step, 0, r);
}

static void make_jack(maker *m)
{
    int32_t a = draw(m, 600, 1500), r = draw(m, 500, 1000);
    object_ball(m, 0, 0, 0, r);
    object_ball(m, a, a, a, r);
    object_ball(m, a, -a, -a, r);
    object_ball(m, -a, a, -a, r);
    object_ball(m, -a, -a, a, r);
}

static void make_blob(maker *m)
{
    int32_t n = draw(m, 2, 5);
    for (int32_t i = 0; i < n; i++) {
        object_ball(m, draw(m, -1400, 1400), draw(m, -1400, 1400), draw(m, -1400, 1400), draw(m, 500, 1200));
    }
}

/* A ring in the plane y = 0; mouth: what stays open about the x axis, in CIRCLE-ths of a turn on each side (0: closed). */
static void make_ring(maker *m, int32_t n, int32_t radius, int32_t r, int32_t mouth)
{
    for (int32_t i = 0; i < n; i++) {
        int32_t x, z, k = mouth ? mouth + i * (CIRCLE - 2 * mouth) / (n - 1) : i * CIRCLE / n;
        polar(radius, k, &x, &z);
        object_ball(m, x, 0, z, r);
    }
}

static void measure(maker *m)
{
    int32_t thinnest = INT32_MAX;
    m->least = INT32_MAX;
    m->reach = 0;
    for (int32_t k = 0; k < 64; k++) {
        int32_t u[3], widest = 0;
        spread(10000, 64, k, u);
        for (int32_t i = 0; i < m->s->object_count; i++) {
            const cage_ball *b = &m->s->object[i];
            const int32_t y[3] = {b->x, b->y, b->z};
            int64_t along = dot(u, y) / 10000, square = dot(y, y), across = square - along * along;
            widest = most(widest, (int32_t)root(across < 0 ? 0 : across) + b->r);
            m->reach = most(m->reach, (int32_t)root(square) + b->r);
            m->least = b->r < m->least ? b->r : m->least;
        }
        thinnest = widest < thinnest ? widest : thinnest;
    }
    m->girth = thinnest;
}

static void make_object(maker *m)
{
    static void (*const kinds[])(maker *) = {make_ball, make_ball, make_rod, make_weights, make_ell, make_jack, make_blob};
    kinds[draw(m, 0, 6)](m);
    measure(m);
}

/* ---- surroundings ----------------------------------------------------------------------------------- */

static void jitter(maker *m, int32_t from, int32_t by)
{
    for (int32_t j = from; j < m->s->obstacle_count; j++) {
        cage_ball *o = &m->s->obstacles[j];
        o->x += draw(m, -by, by);
        o->y += draw(m, -by, by);
        o->z += draw(m, -by, by);
        o->r += draw(m, 0, by);
    }
}

static void sphere(maker *m, int32_t radius, int32_t n, int32_t r)
{
    for (int32_t i = 0; i < n; i++) {
        int32_t p[3];
        spread(radius, n, i, p);
        obstacle(m, p[0], p[1], p[2], r);
    }
}

/* Takes away what has its centre less than `half` off the segment from a - v to a + v (|v| = 0: from the point a). */
static void pierce(maker *m, const int32_t a[3], const int32_t v[3], int32_t half)
{
    int32_t kept = 0;
    int64_t length = dot(v, v);
    for (int32_t j = 0; j < m->s->obstacle_count; j++) {
        cage_ball o = m->s->obstacles[j];
        int32_t d[3] = {o.x - a[0], o.y - a[1], o.z - a[2]};
        int64_t t = length ? dot(d, v) * 1000 / length : 0;
        t = t < -1000 ? -1000 : t > 1000 ? 1000 : t;
        for (int k = 0; k < 3; k++) {
            d[k] -= (int32_t)(v[k] * t / 1000);
        }
        if (dot(d, d) >= (int64_t)half * half) {
            m->s->obstacles[kept++] = o;
        }
    }
    m->s->obstacle_count = kept;
}

/* A round mouth at the pole of a shell: what is there is taken away, and a closed ring of balls put around it. */
static void mouth(maker *m, int32_t radius, int32_t r, int32_t aperture)
{
    int32_t pole[3] = {0, 0, radius}, none[3] = {0, 0, 0}, x, y, step, n = 5;
    int32_t thick = most(r, aperture / 2), out = aperture + thick;
    pierce(m, pole, none, out);
    do {
        polar(out, CIRCLE / 2 / ++n, &x, &step);
    } while (step > thick * 9 / 10);
    int32_t high = (int32_t)root((int64_t)radius * radius - (out < radius ? (int64_t)out * out : 0));
    for (int32_t i = 0; i < n; i++) {
        polar(out, i * CIRCLE / n, &x, &y);
        obstacle(m, x, y, out < radius ? high : 0, thick);
    }
}

/* A closed shell but for a mouth as wide as the object's smallest ball, or as the whole object is thin. */
static void shell_with_mouth(maker *m)
{
    int32_t n = draw(m, 3, 9) * 10, radius = most(m->reach + draw(m, 1200, 4000), 3000);
    int32_t r = cover(radius, n) - percent(m, m->least, 30, 80);
    sphere(m, radius, n, r);
    mouth(m, radius, r, draw(m, 0, 2) ? percent(m, m->girth, 80, 115) : percent(m, m->least, 75, 105));
    jitter(m, 0, draw(m, 0, 40));
    m->region = most(radius - r - m->reach, 300);
}

/* A shell of which every mesh is about as wide as the object is thin; half of the objects are single balls. */
static void shell_of_meshes(maker *m)
{
    int32_t n = draw(m, 30, 70);
    if (draw(m, 0, 1)) {
        m->s->object_count = 0;
        make_ball(m);
        measure(m);
    }
    int32_t radius = most(m->reach + draw(m, 1500, 5000), m->girth * 4);
    radius = radius > 9000 ? 9000 : radius;
    sphere(m, radius, n, most(cover(radius, n) - percent(m, m->girth, 75, draw(m, 0, 1) ? 90 : 110), 300));
    jitter(m, 0, draw(m, 0, 150));
    m->region = most(radius - m->reach, 500);
}

/* A closed ring of overlapping balls in the plane z = 0; returns about the radius of its hole. */
static int32_t ring_of_obstacles(maker *m, int32_t n, int32_t radius, int32_t extra)
{
    int32_t x, y, step;
    polar(radius, CIRCLE / 2 / n, &x, &step);
    for (int32_t i = 0; i < n; i++) {
        polar(radius, i * CIRCLE / n, &x, &y);
        obstacle(m, x, y, 0, step + extra);
    }
    m->s->obstacle_ring = n;
    return radius - step - extra;
}

/* A dumbbell through a ring: its ends may or may not fit, and tilting does not help them much. */
static void dumbbell_in_ring(maker *m)
{
    int32_t n = draw(m, 8, 14), radius = draw(m, 2600, 4000);
    int32_t hole = ring_of_obstacles(m, n, radius, draw(m, 50, 400)), thick = radius - hole;
    int32_t ends = percent(m, hole, 70, 135), waist = percent(m, hole, 30, 70);
    m->s->object_count = 0;
    make_dumbbell(m, ends + percent(m, thick, 70, 180), ends, waist);
    for (int32_t extra = draw(m, 0, 2); extra > 0; extra--) {
        obstacle(m, draw(m, -6000, 6000), draw(m, -6000, 6000), draw(m, 5000, 8000), draw(m, 800, 2000));
    }
    jitter(m, 0, draw(m, 0, 60));
    measure(m);
    m->region = hole - waist > 200 ? (hole - waist) / 2 : 100;
}

/* Two plates with posts between them around the object, their gaps about as wide as it is. */
static void plates(maker *m)
{
    int32_t k = draw(m, 3, 4), pitch = draw(m, 1800, 2600), r = pitch * 3 / 4, posts = draw(m, 5, 8), x, y;
    m->lattice = draw(m, 0, 2) == 0;
    int32_t h = m->girth + r + draw(m, -200, 900), out = most(m->reach + 900, k * pitch / 2);
    for (int32_t i = 0; i < k * k; i++) {
        x = (2 * (i % k) - k + 1) * pitch / 2;
        y = (2 * (i / k) - k + 1) * pitch / 2;
        obstacle(m, x, y, h, r);
        obstacle(m, x, y, -h, r);
    }
    polar(out, CIRCLE / 2 / posts, &x, &y);
    int32_t thick = most(y - percent(m, m->girth, 50, 100), 300);
    for (int32_t i = 0; i < posts; i++) {
        polar(out, i * CIRCLE / posts, &x, &y);
        for (int32_t level = -1; level <= 1; level++) {
            obstacle(m, x, y, level * h * 2 / 3, thick);
        }
    }
    jitter(m, 0, m->lattice ? 0 : draw(m, 0, 100));
    m->region = 500;
}

/* Balls all over the place; an empty spot for the start is kept in the middle. */
static void clutter(maker *m)
{
    int32_t n = draw(m, 50, 90), high = draw(m, 2400, 3600);
    for (int32_t i = 0; i < n; i++) {
        int32_t p[3] = {draw(m, -6500, 6500), draw(m, -6500, 6500), draw(m, -6500, 6500)}, r = draw(m, 700, high);
        int64_t keep = r + m->reach * 2 / 3;
        if (dot(p, p) > keep * keep) {
            obstacle(m, p[0], p[1], p[2], r);
        }
    }
    m->region = 2000;
}

/* Two rings of balls, linked or side by side, one of them open at times. */
static void links(maker *m)
{
    int32_t n = draw(m, 6, 10), radius = draw(m, 1600, 2400), x, step, kind = draw(m, 0, 5), fat = draw(m, 20, 150);
    int32_t around = draw(m, 10, 14), wide = draw(m, 2600, 3600), room = draw(m, 50, 400);
    room += wide - ring_of_obstacles(m, around, wide, draw(m, 20, 200));
    do { /* room for the obstacles in the object's hole */
        radius += 100;
        polar(radius, CIRCLE / 2 / n, &x, &step);
    } while (radius - step - fat < room);
    m->s->object_count = 0;
    make_ring(m, n, radius, step + fat, 0);
    m->s->object_ring = n;
    if (kind == 0) { /* side by side */
        m->home[0] = wide + radius + 3500;
        m->region = 500;
    } else {
        m->home[0] = wide;
        m->away[0] = -wide;
        m->region = 250;
    }
    if (kind == 1 || kind == 2) { /* the balls opposite the start are set apart by about the ring's thickness */
        int32_t missing = draw(m, 1, 3), at = around / 2 - missing / 2;
        memmove(&m->s->obstacles[at], &m->s->obstacles[at + missing],
                (size_t)(around - at - missing) * sizeof m->s->obstacles[0]);
        m->s->obstacle_count -= missing;
        m->s->obstacle_ring = 0;
    }
    jitter(m, 0, draw(m, 0, 20));
    measure(m);
}

/* A bar in a closed shell but for a slot: it leaves lengthwise, or broadside where the slot is wide. */
static void bar_in_slotted_shell(maker *m)
{
    int32_t n = draw(m, 50, 100), balls = draw(m, 3, 5), step = draw(m, 500, 900), b = draw(m, 500, 900);
    m->s->object_count = 0;
    for (int32_t i = 0; i < balls; i++) {
        object_ball(m, (2 * i - balls + 1) * step / 2, 0, 0, b);
    }
    measure(m);
    int32_t radius = m->reach + draw(m, 1200, 2600), r = cover(radius, n) - percent(m, b, 30, 80), a[3], v[3] = {0, 0, 0};
    spread(radius, 50, draw(m, 5, 44), a);
    polar(percent(m, m->reach, 40, 110), draw(m, 0, CIRCLE - 1), &v[0], &v[2]);
    sphere(m, radius, n, r);
    pierce(m, a, v, percent(m, b, 10, 90) + r);
    jitter(m, 0, draw(m, 0, 60));
    m->region = most(radius - r - m->reach, 400);
}

/* A closed shell cut in two by a disc with a hole; the goal is beyond it. */
static void chambers(maker *m)
{
    int32_t n = draw(m, 40, 70), radius = m->reach * 2 + draw(m, 2500, 4000), r, pitch, x, y, hole;
    radius = radius > 10500 ? 10500 : radius;
    r = cover(radius, n) - percent(m, m->least, 20, 60);
    sphere(m, radius, n, r);
    pitch = radius * 2 / 5;
    hole = percent(m, m->girth, 50, 140);
    int32_t thick = pitch * 11 / 20, turn = draw(m, 0, CIRCLE - 1);
    for (int32_t ring = 1; ring <= 2; ring++) {
        int32_t count = ring == 1 ? 7 : 13, at = hole + thick + (ring - 1) * pitch;
        for (int32_t i = 0; i < count; i++) {
            polar(at, turn + i * CIRCLE / count, &x, &y);
            obstacle(m, x, y, 0, thick);
        }
    }
    jitter(m, 0, draw(m, 0, 60));
    m->home[2] = radius / 2;
    m->away[2] = -radius / 2;
    m->region = most((radius - r) / 2 - m->reach / 2, 400);
}

/* A ring with or without a mouth around a post with thick ends. */
static void clasp(maker *m)
{
    int32_t n = draw(m, 7, 10), radius = draw(m, 1700, 2600), x, step, post, ends, length = draw(m, 1500, 2600);
    polar(radius, CIRCLE / 2 / n, &x, &step);
    step += draw(m, 20, 120);
    post = percent(m, radius - step, 30, 75);
    ends = percent(m, radius - step, 85, 150);
    m->s->object_count = 0;
    make_ring(m, n, radius, step, draw(m, 0, 2) ? arc_for(percent(m, post, 70, 120) + step, radius) : 0);
    for (int32_t i = -3; i <= 3; i++) {
        obstacle(m, 0, i * length / 3, 0, post);
    }
    obstacle(m, 0, length + ends / 2, 0, ends);
    obstacle(m, 0, -length - ends / 2, 0, ends);
    jitter(m, 0, draw(m, 0, 30));
    measure(m);
    m->region = most((radius - step - post) / 2, 100);
}

/* A cup with a plug in front of its mouth: the way out, if any, is round the plug. */
static void plugged_cup(maker *m)
{
    int32_t n = draw(m, 4, 8) * 10, radius = m->reach + draw(m, 1800, 3500), wide = m->girth + draw(m, 600, 1500);
    int32_t r = cover(radius, n) - percent(m, m->least, 30, 70);
    sphere(m, radius, n, r);
    mouth(m, radius, r, wide);
    obstacle(m, draw(m, -200, 200), draw(m, -200, 200), radius + draw(m, 0, 2 * wide), percent(m, wide, 50, 120));
    jitter(m, 0, draw(m, 0, 40));
    m->region = most(radius - r - m->reach, 400);
}

/* Balls around the object at a small distance, all but touching it. */
static void fingers(maker *m)
{
    int32_t n = draw(m, 5, 13), slack = draw(m, 20, 300), high = draw(m, 1200, 2600);
    for (int32_t i = 0; i < n; i++) {
        int32_t u[3], r = draw(m, 700, high), from = 0;
        spread(10000, n, i, u);
        for (int32_t b = 0; b < m->s->object_count; b++) {
            const cage_ball *o = &m->s->object[b];
            const int32_t y[3] = {o->x, o->y, o->z};
            int64_t along = dot(u, y) / 10000, sum = o->r + r + slack, left = sum * sum - dot(y, y) + along * along;
            from = left > 0 ? most(from, (int32_t)(along + root(left))) : from;
        }
        for (int k = 0; k < 3; k++) {
            u[k] = (int32_t)((int64_t)u[k] * from / 10000);
        }
        obstacle(m, u[0], u[1], u[2], r);
    }
    m->region = slack / 2;
}

/* ---- poses ------------------------------------------------------------------------------------------- */

/* Clearance of a pose in the final units, to within a few; 2^60 holds all products. */
static int64_t clearance(const space_scene *s, const cage_pose *pose)
{
    const int64_t w = pose->q[0], x = pose->q[1], y = pose->q[2], z = pose->q[3], n = w * w + x * x + y * y + z * z;
    const int64_t r[3][3] = {
        {w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)},
        {2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)},
        {2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z}};
    int64_t least = INT64_MAX;
    for (int32_t i = 0; i < s->object_count; i++) {
        const cage_ball *b = &s->object[i];
        int64_t p[3];
        for (int k = 0; k < 3; k++) {
            p[k] = pose->x[k] + (r[k][0] * b->x + r[k][1] * b->y + r[k][2] * b->z) / n;
        }
        for (int32_t j = 0; j < s->obstacle_count; j++) {
            const cage_ball *o = &s->obstacles[j];
            int64_t d[3] = {p[0] - o->x, p[1] - o->y, p[2] - o->z}, sum = (int64_t)b->r + o->r;
            int64_t spare = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2] - sum * sum) / (2 * sum + 1);
            least = spare < least ? spare : least;
        }
    }
    return least;
}

static void quaternion_draw(maker *m, cage_pose *pose)
{
    static const int32_t nice[8][4] = {{1, 0, 0, 0}, {1, 1, 0, 0},  {1, 0, 0, -1}, {0, 0, 1, 0},
                                       {1, 1, 1, 1}, {2, 1, 0, 0}, {0, 1, -1, 0}, {3, 1, -1, 1}};
    int32_t k = draw(m, 0, 7);
    for (int i = 0; i < 4; i++) {
        pose->q[i] = m->lattice || m->rng % 5 == 0 ? nice[k][i] : draw(m, -700, 700);
    }
    if (!pose->q[0] && !pose->q[1] && !pose->q[2] && !pose->q[3]) {
        pose->q[0] = 1;
    }
}

/* The roomiest of some random poses; with few tries starts are tight, and now and then collide. */
static void pose_draw(maker *m, const int32_t around[3], int32_t scale, int32_t turned, cage_pose *out)
{
    int32_t tries = draw(m, 8, 60);
    int64_t best = INT64_MIN;
    for (int32_t t = 0; t < tries || (best < 0 && t < 300); t++) {
        cage_pose pose = {{0, 0, 0}, {1, 0, 0, 0}};
        for (int a = 0; a < 3; a++) {
            pose.x[a] = (around[a] + draw(m, -m->region, m->region)) * scale;
        }
        if (t > 0 || turned) {
            quaternion_draw(m, &pose);
        }
        int64_t room = clearance(m->s, &pose);
        if (room > best) {
            best = room;
            *out = pose;
        }
    }
}

/* ---- the whole ---------------------------------------------------------------------------------------- */

/* Scaled to many units, with the last digits random unless ties are wanted. */
static void rescale(maker *m, cage_ball *balls, int32_t count, int32_t scale)
{
    int32_t loose = m->lattice ? 0 : scale - 1;
    for (int32_t i = 0; i < count; i++) {
        cage_ball *b = &balls[i];
        b->x = b->x * scale + draw(m, 0, loose);
        b->y = b->y * scale + draw(m, 0, loose);
        b->z = b->z * scale + draw(m, 0, loose);
        b->r = b->r * scale + draw(m, 0, loose);
    }
}

static void (*const families[SPACE_FAMILIES])(maker *) = {
    shell_with_mouth, shell_of_meshes, dumbbell_in_ring, plates, clutter,
    links, bar_in_slotted_shell, chambers, clasp, plugged_cup, fingers};

const char *space_family_text(int32_t family)
{
    static const char *const names[SPACE_FAMILIES] = {
        "shell with a mouth", "shell of meshes", "dumbbell in a ring", "plates", "clutter",
        "links", "bar in a slotted shell", "chambers", "clasp", "plugged cup", "fingers"};
    return names[family];
}

void space_random(uint64_t seed, space_scene *out)
{
    maker m = {out, seed * 0xd1342543de82ef95u + 0x9e6c63d0876a9a47u, 0, 0, 0, 1000, {0, 0, 0}, {0, 0, 0}, 0};
    memset(out, 0, sizeof *out);
    out->seed = seed;
    out->family = (int32_t)(seed % SPACE_FAMILIES);
    make_object(&m);
    families[out->family](&m);
    int32_t scale = draw(&m, 0, 3) ? draw(&m, SCALE_MAX / 2, SCALE_MAX) : draw(&m, 1, SCALE_MAX);
    rescale(&m, out->object, out->object_count, scale);
    rescale(&m, out->obstacles, out->obstacle_count, scale);
    out->has_goal = families[out->family] == chambers || draw(&m, 0, 3) == 0;
    pose_draw(&m, m.home, scale, 0, &out->start);
    if (out->has_goal) {
        if (families[out->family] != chambers && draw(&m, 0, 1)) {
            m.away[draw(&m, 0, 2)] += 15000;
        }
        pose_draw(&m, m.away[0] || m.away[1] || m.away[2] ? m.away : m.home, scale, 1, &out->goal);
    }
}
