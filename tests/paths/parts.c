/* parts.c: true shapes: distances against formulas, paths against dense sampling, balls against parts, bad files. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "parts.h"
#include "random.h"

enum { SAMPLES = 4000 };

static int failures;

static void expect(int holds, const char *what)
{
    if (!holds) {
        failures++;
        printf("FAIL  %s\n", what);
    }
}

static double spread(uint64_t *rng, double most) { return most * (2 * random_unit(rng) - 1); }

static void random_turn(uint64_t *rng, double q[4])
{
    double size = 0;
    for (int k = 0; k < 4; k++) {
        q[k] = spread(rng, 1);
        size = hypot(size, q[k]);
    }
    for (int k = 0; k < 4; k++)
        q[k] /= size;
}

/* ---- files ------------------------------------------------------------------------------------------------------ */

static int read_text(const char *file, const char *text, int32_t dim, host_parts *parts, host_error *error)
{
    FILE *out = fopen(file, "w");
    if (out == NULL || fputs(text, out) < 0 || fclose(out) != 0)
        exit(2);
    return host_read_parts(file, dim, parts, error);
}

static void files(const char *file)
{
    static const struct {
        int32_t dim;
        const char *text, *blame;
    } bad[] = {
        { 2, "object disc 1\n", "no part of the obstacles" },
        { 3, "# nothing\n\n", "no part of the object" },
        { 2, "object disc 1\nobstacle disc\n", ":2: 0 numbers" },
        { 2, "object disc 1 2\n", ":1: 2 numbers" },
        { 2, "object disc -1\n", "-1 is no length" },
        { 2, "object disc 0\n", "0 is no length" },
        { 2, "object disc nan\n", "not a finite number" },
        { 2, "object disc 1e200\n", "too large" },
        { 2, "object disc 1 @ 0,0\n", "a pose is" },
        { 2, "object disc 1 @ 0,0,0,1,0,0,0\n", "in space" },
        { 3, "object box 1 1 1 @ 0,0,0\n", "of the plane" },
        { 3, "object box 1 1 1 @ 0,0,0,0,0,0,0\n", "quaternion is zero" },
        { 3, "object disc 1\n", "a part is a box, cylinder" },
        { 2, "object cylinder 1 1\n", "a part is a box, disc" },
        { 3, "object box 1 1\n", "a box has 3" },
        { 3, "thing box 1 1 1\n", "object or obstacle" },
        { 3, "objects box 1 1 1\n", "object or obstacle" },
        { 3, "object\n", "a part is a" },
        { 2, "object hull 0 0 1 0\n", "3 or more points of 2" },
        { 2, "object hull 0 0 1 0 1\n", "3 or more points of 2" },
        { 3, "object hull 0 0 0 1 0 0 0 1 0\n", "4 or more points of 3" },
    };
    static const char fine[] = "# all of them\nobject box 1 2 3 @ 1,2,3,2,0,0,0 # moved\n\n object\tcapsule 1,2\r\n"
                               "obstacle cylinder 1 2\nobstacle hull 0 0 0  1 0 0  0 1 0  0 0 1 @ 0,0,0,0,0,0,1";
    host_parts parts;
    host_error error;
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        const int code = read_text(file, bad[i].text, bad[i].dim, &parts, &error);
        if (code != HOST_BAD_INPUT || strstr(error.text, bad[i].blame) == NULL) {
            printf("FAIL  '%s': %d %s\n", bad[i].text, code, code == HOST_OK ? "" : error.text);
            failures++;
        }
        host_free_parts(&parts);
    }
    expect(read_text(file, fine, 3, &parts, &error) == HOST_OK && parts.count[0] == 2 && parts.count[1] == 2, "a fine file");
    if (parts.count[0] == 2 && parts.count[1] == 2) {
        const host_part *box = &parts.part[0][0], *hull = &parts.part[1][1];
        expect(box->size[2] == 1.5 && box->x[1] == 2 && box->q[0] == 1 && box->shape == PART_BOX, "its box");
        expect(hull->vertices == 4 && hull->vertex[3][2] == 1 && hull->q[3] == 1 && hull->centre[0] == 0.25, "its hull");
        expect(parts.part[0][1].shape == PART_CAPSULE && parts.part[0][1].reach == 2, "its capsule");
        expect(parts.part[1][0].shape == PART_CYLINDER && parts.part[1][0].reach == sqrt(2.0), "its cylinder");
    }
    host_free_parts(&parts);
    expect(host_read_parts("there/is/no/such/file", 3, &parts, &error) == HOST_BAD_INPUT, "a file that is not there");
    host_free_parts(&parts);
}

/* ---- distances ---------------------------------------------------------------------------------------------------- */

static host_part make_capsule(uint64_t *rng, double wide)
{
    host_part p;
    memset(&p, 0, sizeof p);
    p.shape = PART_CAPSULE;
    p.axis = 2;
    p.size[0] = 0.2 + random_unit(rng);
    p.size[1] = 3 * random_unit(rng);
    p.reach = p.size[0] + p.size[1];
    for (int k = 0; k < 3; k++)
        p.x[k] = spread(rng, wide);
    random_turn(rng, p.q);
    return p;
}

static double nearest(const double p[3], const double a[3], const double u[3], double half)
{
    double along = 0, square = 0;
    for (int k = 0; k < 3; k++)
        along += (p[k] - a[k]) * u[k];
    along = fmax(-half, fmin(half, along));
    for (int k = 0; k < 3; k++)
        square += pow(p[k] - a[k] - along * u[k], 2);
    return sqrt(square);
}

/* Of two capsules, by a search that narrows down: the distance from a point of one segment to the other segment is convex. */
static double gap_of(const host_part *a, const host_part *b)
{
    static const double z[3] = { 0, 0, 1 };
    double u[3], v[3], low = -a->size[1], high = a->size[1];
    parts_turn(a->q, z, u);
    parts_turn(b->q, z, v);
    for (int n = 0; n < 60; n++) {
        double at[2], far[2];
        for (int e = 0; e < 2; e++) {
            double p[3];
            at[e] = low + (high - low) * (1 + e) / 3;
            for (int k = 0; k < 3; k++)
                p[k] = a->x[k] + at[e] * u[k];
            far[e] = nearest(p, b->x, v, b->size[1]);
        }
        *(far[0] < far[1] ? &high : &low) = at[far[0] < far[1]];
        if (n == 59)
            return fmin(far[0], far[1]) - a->size[0] - b->size[0];
    }
    return 0;
}

/* A box with a ball: by the nearest point of the box. */
static double ball_to_box(const host_part *ball, const host_part *box)
{
    double v[3] = { ball->x[0] - box->x[0], ball->x[1] - box->x[1], ball->x[2] - box->x[2] }, w[3], far = 0;
    parts_turn_back(box->q, v, w);
    for (int k = 0; k < 3; k++)
        far = hypot(far, fmax(0, fabs(w[k]) - box->size[k]));
    return far - ball->size[0];
}

/* "Closer than" changes from no to yes within a thousandth of the distance that a formula says. */
static void distances(void)
{
    uint64_t rng = 1;
    int wrong = 0, apart = 0, hulls = 0;
    for (int n = 0; n < 5000; n++) {
        host_part a = make_capsule(&rng, 4), b = make_capsule(&rng, 4), box;
        const double gap = gap_of(&a, &b);
        double vertex[8][3], to_box;
        if (gap > 1e-3) {
            apart++;
            wrong += parts_closer(&a, &b, gap * 0.999 - 1e-5) || !parts_closer(&a, &b, gap * 1.001 + 1e-5);
        } else if (gap < -1e-3) {
            wrong += !parts_closer(&a, &b, 0);
        }
        memset(&box, 0, sizeof box);
        box.shape = PART_BOX;
        for (int k = 0; k < 3; k++)
            box.size[k] = 0.2 + 2 * random_unit(&rng);
        box.reach = hypot(hypot(box.size[0], box.size[1]), box.size[2]);
        memcpy(box.x, b.x, sizeof box.x);
        memcpy(box.q, b.q, sizeof box.q);
        a.size[1] = 0;
        a.reach = a.size[0];
        to_box = ball_to_box(&a, &box);
        if (n % 2) { /* the same box as a hull, its corners about a middle that is elsewhere */
            for (int c = 0; c < 8; c++)
                for (int k = 0; k < 3; k++)
                    vertex[c][k] = c >> k & 1 ? box.size[k] : -box.size[k];
            box.shape = PART_HULL;
            box.vertex = vertex;
            box.vertices = 8;
            box.centre[0] = box.size[0] / 3;
            box.reach *= 2;
            hulls++;
        }
        if (to_box > 1e-3)
            wrong += parts_closer(&a, &box, to_box * 0.999 - 1e-5) || !parts_closer(&box, &a, to_box * 1.001 + 1e-5);
        else if (to_box < -1e-3)
            wrong += !parts_closer(&a, &box, 0);
    }
    printf("      distances: %d pairs of capsules apart, %d hulls; %d wrong\n", apart, hulls, wrong);
    expect(wrong == 0 && apart > 2000, "distances");
}

/* ---- paths -------------------------------------------------------------------------------------------------------- */

typedef struct scene {
    host_part object[2], obstacle[2];
    host_parts parts;
    host_query query;
    host_grid grid;
    cage_result result;
    cage_pose row[4];
    host_way way;
    host_answer answer;
} scene;

/* Capsules, and a few rows between which they are to go, on the cubic or straight. Lengths in units of 2^-10. */
static void make_scene(uint64_t *rng, int smooth, scene *s)
{
    memset(s, 0, sizeof *s);
    for (int i = 0; i < 2; i++) {
        s->object[i] = make_capsule(rng, 2);
        s->obstacle[i] = make_capsule(rng, 4);
        s->obstacle[i].size[0] /= 20; /* thin: easily skipped */
        s->obstacle[i].reach = s->obstacle[i].size[0] + s->obstacle[i].size[1];
    }
    for (int i = 0; i < 2; i++)
        s->object[i].size[0] /= 20;
    s->parts.part[0] = s->object;
    s->parts.part[1] = s->obstacle;
    s->parts.count[0] = s->parts.count[1] = 2;
    s->query.dim = 3;
    s->grid.unit = 1.0 / 1024;
    for (int k = 0; k < 3; k++)
        s->result.pivot[k] = (int32_t)spread(rng, 2000);
    for (int i = 0; i < 4; i++) {
        double q[4];
        random_turn(rng, q);
        for (int k = 0; k < 3; k++)
            s->row[i].x[k] = (int32_t)spread(rng, 6000);
        for (int k = 0; k < 4; k++)
            s->row[i].q[k] = (int32_t)(q[k] * (1 << 24));
    }
    s->result.path = s->row;
    s->result.path_count = 4;
    s->way.smooth = smooth;
    s->answer.query = &s->query;
    s->answer.grid = &s->grid;
    s->answer.result = &s->result;
    s->answer.way = &s->way;
}

/* Where the path is: the contract of smooth.h once more, the rotation by slerp. */
static void pose_at(const scene *s, int i, double t, double x[3], double q[4])
{
    double slope[2][3], first = 0, second = 0, dot = 0;
    for (int e = 0; e < 2; e++)
        for (int k = 0; k < 3; k++) {
            const int at = i + e, before = at > 0 ? at - 1 : 0, after = at < 3 ? at + 1 : 3;
            slope[e][k] = ((double)s->row[after].x[k] - s->row[before].x[k]) / (after - before);
        }
    for (int k = 0; k < 3; k++) {
        const double a = s->row[i].x[k], b = s->row[i + 1].x[k];
        x[k] = s->way.smooth ? (2 * t * t * t - 3 * t * t + 1) * a + (t * t * t - 2 * t * t + t) * slope[0][k] +
                                   (3 * t * t - 2 * t * t * t) * b + (t * t * t - t * t) * slope[1][k]
                             : a + t * (b - a);
        x[k] *= s->grid.unit;
    }
    for (int k = 0; k < 4; k++) {
        first += (double)s->row[i].q[k] * s->row[i].q[k];
        second += (double)s->row[i + 1].q[k] * s->row[i + 1].q[k];
        dot += (double)s->row[i].q[k] * s->row[i + 1].q[k];
    }
    first = sqrt(first);
    second = sqrt(second) * (dot < 0 ? -1 : 1);
    const double angle = acos(fmin(1, dot / (first * second)));
    for (int k = 0; k < 4; k++)
        q[k] = (sin((1 - t) * angle) * s->row[i].q[k] / first + sin(t * angle) * s->row[i + 1].q[k] / second) / sin(angle);
}

static void times(const double a[4], const double b[4], double out[4])
{
    out[0] = a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3];
    for (int k = 0; k < 3; k++)
        out[1 + k] = a[0] * b[1 + k] + a[1 + k] * b[0] + a[1 + (k + 1) % 3] * b[1 + (k + 2) % 3] -
                     a[1 + (k + 2) % 3] * b[1 + (k + 1) % 3];
}

/* The least gap of many samples. */
static double sampled(const scene *s)
{
    double least = INFINITY;
    for (int n = 0; n <= 3 * SAMPLES; n++) {
        const int i = n / SAMPLES < 3 ? n / SAMPLES : 2;
        double x[3], q[4], arm[3], turned[3];
        pose_at(s, i, (double)(n - i * SAMPLES) / SAMPLES, x, q);
        for (int a = 0; a < 2; a++) {
            host_part moved = s->object[a];
            for (int k = 0; k < 3; k++)
                arm[k] = moved.x[k] - s->result.pivot[k] * s->grid.unit;
            parts_turn(q, arm, turned);
            for (int k = 0; k < 3; k++)
                moved.x[k] = x[k] + turned[k];
            times(q, s->object[a].q, moved.q);
            for (int b = 0; b < 2; b++)
                if (hypot(hypot(moved.x[0] - s->obstacle[b].x[0], moved.x[1] - s->obstacle[b].x[1]),
                          moved.x[2] - s->obstacle[b].x[2]) < moved.reach + s->obstacle[b].reach + least)
                    least = fmin(least, gap_of(&moved, &s->obstacle[b]));
        }
    }
    return least;
}

/* A path on which samples overlap is never called clear, one with room is; and no step is longer than the clearance. */
static void paths(int smooth)
{
    uint64_t rng = 3 + (uint64_t)smooth;
    int collide = 0, clear = 0, near = 0;
    for (int n = 0; n < 60; n++) {
        scene s;
        parts_check check;
        host_error error;
        make_scene(&rng, smooth, &s);
        const double gap = sampled(&s);
        expect(host_check_parts(&s.answer, &s.parts, &check, &error) == HOST_OK && check.kind == 1 && check.whole, "the check");
        int overlaps = 0;
        for (int32_t i = 0; i < check.places; i++)
            overlaps |= check.place[i].overlaps;
        expect(gap >= 0 || check.places > 0, "a path that collides is called clear");
        expect(gap < 2.1 * check.finest || check.places == 0, "a path with room is not called clear");
        expect(gap < -check.finest || !overlaps || gap < 1e-3, "an overlap that is none");
        expect(check.places > 0 || check.least <= gap + 1e-3, "more clearance than there is");
        collide += gap < 0;
        clear += check.places == 0;
        near += check.places > 0 && gap > 0;
        host_free_check(&check);
    }
    printf("      %s paths: %d collide, %d are clear, %d too close to tell\n", smooth ? "smooth" : "straight", collide, clear,
           near);
    expect(collide >= 8 && clear >= 20, "paths of both kinds");
}

/* Half of a thin wall, of a height that no obstacle of random scenes has, in the way of a ball that passes in one leg. */
static void thin_wall(void)
{
    scene s;
    parts_check check;
    host_error error;
    uint64_t rng = 9;
    for (int aside = 0; aside < 2; aside++) {
        make_scene(&rng, 0, &s);
        memset(s.row, 0, sizeof s.row);
        memset(s.result.pivot, 0, sizeof s.result.pivot);
        memset(s.object[0].x, 0, sizeof s.object[0].x);
        s.object[0].size[0] = s.object[0].reach = 0.01;
        s.object[0].size[1] = 0;
        s.obstacle[0].shape = PART_BOX;
        s.obstacle[0].size[0] = 1e-4;
        s.obstacle[0].size[1] = s.obstacle[0].size[2] = s.obstacle[0].reach = 5;
        s.obstacle[0].reach = 8;
        memset(s.obstacle[0].x, 0, sizeof s.obstacle[0].x);
        memset(s.obstacle[0].q, 0, sizeof s.obstacle[0].q);
        s.obstacle[0].q[0] = 1;
        s.parts.count[0] = s.parts.count[1] = 1;
        s.result.path_count = 2;
        s.row[0].x[0] = -20000;
        s.row[1].x[0] = 20000;
        s.row[0].x[1] = s.row[1].x[1] = aside ? 1024 * 5 + 12 : 0;
        s.row[0].q[0] = s.row[1].q[0] = 1;
        expect(host_check_parts(&s.answer, &s.parts, &check, &error) == HOST_OK, "the check");
        expect(aside ? check.places == 0 : check.places == 1 && check.place[0].overlaps, "a thin wall");
        host_free_check(&check);
    }
}

/* ---- balls -------------------------------------------------------------------------------------------------------- */

static void balls(const char *file)
{
    host_parts parts;
    host_error error;
    parts_cover cover = { 0, 0, 0, 0, 0 };
    host_ball row[5] = { { { 0, 0, 0 }, 1 } };
    const host_balls of = { row, 5, 3 };
    const double middle[3] = { 0, 0, 0 }, aside[3] = { 1.2, 0, 0 }, far[3] = { 0, 0, 5 };
    expect(read_text(file, "object capsule 1 4 @ 0,0,0,1,0,1,0\nobstacle hull 1 1 1 1 1 -1 1 -1 1 1 -1 -1 -1 1 1 -1 1 -1 -1 -1 1 "
                           "-1 -1 -1\nobstacle box 2 2 2 @ 2,0,0,1,0,0,0\n", 3, &parts, &error) == HOST_OK, "parts");
    /* inside one; on the border of one; in neither box but in both together; sticking out */
    expect(parts_hold_ball(parts.part[0], 1, middle, 1, 3) && parts_hold_ball(parts.part[0], 1, aside, 1, 3), "balls inside");
    expect(!parts_hold_ball(parts.part[0], 1, middle, 1.001, 3) && !parts_hold_ball(parts.part[0], 1, far, 0, 3), "outside");
    expect(parts_hold_ball(parts.part[1], 1, middle, 0.999, 3) && !parts_hold_ball(parts.part[1], 1, middle, 1.01, 3), "a hull");
    expect(parts_hold_ball(parts.part[1], 2, aside, 0.9, 3) && !parts_hold_ball(parts.part[1], 1, aside, 0.9, 3), "two parts");
    /* five balls along the capsule, a unit apart: in between its surface is bare; balls that are larger cover it */
    for (int i = 0; i < 5; i++) {
        row[i].x[0] = i - 2;
        row[i].x[1] = row[i].x[2] = 0;
        row[i].r = 1;
        expect(parts_hold_ball(parts.part[0], 1, row[i].x, 1, 3), "balls along it");
    }
    parts_cover_by(parts.part[0], 1, &of, 3, &cover);
    expect(cover.points > 500 && cover.bare > cover.points / 20 && cover.bare < cover.points / 3, "a surface that is bare");
    for (int i = 0; i < 5; i++)
        row[i].r = sqrt(1.25);
    memset(&cover, 0, sizeof cover);
    parts_cover_by(parts.part[0], 1, &of, 3, &cover);
    expect(cover.points > 500 && cover.bare == 0, "balls that cover");
    host_free_parts(&parts);
    const double corner[3] = { 2.9, 0.9, 0 }, outside[3] = { 3.1, 0, 0 };
    expect(read_text(file, "object box 6 2\nobject disc 1 @ 9,0,0\nobstacle hull 0 0 4 0 0 3\n", 2, &parts, &error) == HOST_OK,
           "parts in the plane");
    expect(parts_hold_ball(parts.part[0], 2, corner, 0.1, 2) && !parts_hold_ball(parts.part[0], 2, corner, 0.11, 2) &&
               !parts_hold_ball(parts.part[0], 2, outside, 0, 2), "in the plane");
    host_free_parts(&parts);
}

int main(int argc, char **argv)
{
    const char *file = argc > 1 ? argv[1] : "build/check_parts.txt";
    if (!host_parts_available()) {
        printf("FAIL  this build is without libccd\n");
        return 1;
    }
    files(file);
    if (argc > 2) { /* all that Valgrind has time for */
        balls(file);
        thin_wall();
        return failures != 0;
    }
    distances();
    paths(0);
    paths(1);
    thin_wall();
    balls(file);
    (void)remove(file);
    return failures != 0;
}
