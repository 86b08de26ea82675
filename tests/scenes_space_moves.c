/* scenes_space_moves.c: other ways to put the question of a scene, exact in integers, and scenes as text. */
#include <string.h>

#include "scenes.h"
#include "scenes_space.h"

cage_scene space_view(const space_scene *s)
{
    cage_scene view = {{s->object, s->object, s->object_count, s->object_count},
                       {s->obstacles, s->obstacles, s->obstacle_count, s->obstacle_count}, 3};
    return view;
}

const cage_pose *space_goal(const space_scene *s)
{
    return s->has_goal ? &s->goal : NULL;
}

/* p q; the entries here stay below 2^13. */
static void product(const int32_t p[4], const int32_t q[4], int32_t out[4])
{
    int32_t a[4] = {p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3],
                    p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
                    p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1],
                    p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0]};
    memcpy(out, a, sizeof a);
}

static int64_t square(const int32_t q[4])
{
    return (int64_t)q[0] * q[0] + (int64_t)q[1] * q[1] + (int64_t)q[2] * q[2] + (int64_t)q[3] * q[3];
}

/* R(q) v, to be used where it is an integer. */
static void turned(const int32_t q[4], const int32_t v[3], int32_t out[3])
{
    const int64_t w = q[0], x = q[1], y = q[2], z = q[3], n = square(q);
    const int64_t r[3][3] = {
        {w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)},
        {2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)},
        {2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z}};
    int64_t a[3] = {v[0], v[1], v[2]};
    for (int k = 0; k < 3; k++) {
        out[k] = (int32_t)((r[k][0] * a[0] + r[k][1] * a[1] + r[k][2] * a[2]) / n);
    }
}

/* One of the 24 rotations that keep the cube: some face up, then quarter turns about z. */
static void cube_turn(int turn, int32_t q[4])
{
    static const int32_t up[6][4] = {{1, 0, 0, 0}, {1, 1, 0, 0}, {0, 1, 0, 0}, {1, -1, 0, 0}, {1, 0, 1, 0}, {1, 0, -1, 0}};
    static const int32_t round[4][4] = {{1, 0, 0, 0}, {1, 0, 0, 1}, {0, 0, 0, 1}, {1, 0, 0, -1}};
    product(round[turn & 3], up[turn / 4 % 6], q);
}

static void move_ball(const int32_t q[4], const int32_t by[3], cage_ball *b)
{
    int32_t v[3] = {b->x, b->y, b->z};
    turned(q, v, v);
    b->x = v[0] + by[0];
    b->y = v[1] + by[1];
    b->z = v[2] + by[2];
}

static void move_pose(const int32_t q[4], const int32_t by[3], cage_pose *pose)
{
    turned(q, pose->x, pose->x);
    for (int k = 0; k < 3; k++) {
        pose->x[k] += by[k];
    }
    product(q, pose->q, pose->q);
}

void space_move_world(const space_scene *in, int turn, const int32_t by[3], space_scene *out)
{
    int32_t q[4];
    cube_turn(turn, q);
    *out = *in;
    for (int32_t j = 0; j < out->obstacle_count; j++) {
        move_ball(q, by, &out->obstacles[j]);
    }
    move_pose(q, by, &out->start);
    if (out->has_goal) {
        move_pose(q, by, &out->goal);
    }
}

/* y' = G y + t, so R' = R G^-1 and x' = x - R' t, an integer where |q|^2 divides t. */
static void reframe_pose(const int32_t g[4], const int32_t t[3], cage_pose *pose)
{
    const int32_t back[4] = {g[0], -g[1], -g[2], -g[3]};
    int32_t moved[3];
    product(pose->q, back, pose->q);
    turned(pose->q, t, moved);
    for (int k = 0; k < 3; k++) {
        pose->x[k] -= moved[k];
    }
}

void space_move_frame(const space_scene *in, int turn, int32_t by, space_scene *out)
{
    int32_t g[4], t[3];
    cube_turn(turn, g);
    *out = *in;
    int64_t whole = square(g) * square(in->start.q) * (in->has_goal ? square(in->goal.q) : 1);
    for (int k = 0; k < 3; k++) {
        t[k] = (int32_t)((k == 1 ? -by : by / (k + 1)) / whole * whole);
    }
    for (int32_t i = 0; i < out->object_count; i++) {
        move_ball(g, t, &out->object[i]);
    }
    reframe_pose(g, t, &out->start);
    if (out->has_goal) {
        reframe_pose(g, t, &out->goal);
    }
}

static void shuffle(cage_ball *balls, int32_t count, uint64_t *rng)
{
    for (int32_t i = count - 1; i > 0; i--) {
        int32_t j = scene_between(rng, 0, i);
        cage_ball b = balls[i];
        balls[i] = balls[j];
        balls[j] = b;
    }
}

void space_shuffle(const space_scene *in, uint64_t seed, space_scene *out)
{
    *out = *in;
    shuffle(out->object, out->object_count, &seed);
    shuffle(out->obstacles, out->obstacle_count, &seed);
    out->object_ring = out->obstacle_ring = 0;
}

void space_swap(const space_scene *in, space_scene *out)
{
    *out = *in;
    out->start = in->goal;
    out->goal = in->start;
}

static void print_pose(FILE *file, const char *name, const cage_pose *p)
{
    fprintf(file, "%s x %ld %ld %ld q %ld %ld %ld %ld\n", name, (long)p->x[0], (long)p->x[1], (long)p->x[2],
            (long)p->q[0], (long)p->q[1], (long)p->q[2], (long)p->q[3]);
}

static void print_balls(FILE *file, const char *name, const cage_ball *b, int32_t n)
{
    fprintf(file, "# %s: x y z r\n", name);
    for (int32_t i = 0; i < n; i++) {
        fprintf(file, "%ld %ld %ld %ld\n", (long)b[i].x, (long)b[i].y, (long)b[i].z, (long)b[i].r);
    }
}

void space_print(FILE *file, const space_scene *s)
{
    fprintf(file, "seed %lu, %s\n", (unsigned long)s->seed, space_family_text(s->family));
    print_pose(file, "start", &s->start);
    if (s->has_goal) {
        print_pose(file, "goal", &s->goal);
    }
    print_balls(file, "object", s->object, s->object_count);
    print_balls(file, "obstacles", s->obstacles, s->obstacle_count);
}

static void add_ball(space_scene *s, int32_t x, int32_t y, int32_t z, int32_t r)
{
    const cage_ball ball = {x, y, z, r};
    s->object[s->object_count++] = ball;
}

void space_double(const space_scene *in, int turns, space_scene *out)
{
    int32_t images = turns == 4 ? 4 : 2, most = SPACE_OBJECT / images;
    *out = *in;
    out->has_goal = 0;
    out->object_ring = out->obstacle_ring = 0;
    out->object_count = 0;
    for (int32_t i = 0; i < in->object_count && i < most; i++) {
        const cage_ball b = in->object[i];
        add_ball(out, b.x, b.y, b.z, b.r);
        if (turns == 1 || turns == 4)
            add_ball(out, b.x, -b.y, -b.z, b.r);
        if (turns == 2 || turns == 4)
            add_ball(out, -b.x, b.y, -b.z, b.r);
        if (turns == 3 || turns == 4)
            add_ball(out, -b.x, -b.y, b.z, b.r);
    }
}

int space_spoil(const space_scene *in, space_scene *out)
{
    *out = *in;
    if (in->object_count == SPACE_OBJECT || in->object[0].r < 16)
        return 0;
    const cage_ball b = in->object[0];
    add_ball(out, b.x + 1, b.y + 2, b.z + 3, b.r / 2); /* 4 + r / 2 < r */
    return 1;
}
