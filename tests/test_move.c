/* test_move: legs that move and turn at once, against dense sampling in long double. */
#include "support.h"
#include "certify.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { SAMPLES = 1000, OBJECTS = 3, OBSTACLES = 5 };

struct trial {
    cage_ball object[OBJECTS], obstacle[OBSTACLES];
    cage_scene scene;
    cage_pose leg[2];
};

static const int32_t centre[3] = {0, 0, 0};

static int32_t within(uint64_t *rng, int32_t most)
{
    return (int32_t)(random_next(rng) % (2 * (uint64_t)most + 1)) - most;
}

static void make_trial(uint64_t *rng, int32_t dim, struct trial *t)
{
    const int32_t size = dim == 2 ? 20000000 : 600000, entry = dim == 2 ? 1 << 28 : 1 << 22;
    const int32_t turn = 1 << (random_next(rng) % 28); /* from tiny ones to any */
    const int32_t wide = dim == 2 ? 3 * size : size + size / 2, radius = dim == 2 ? size / 8 : size / 5;
    memset(t, 0, sizeof *t);
    for (int i = 0; i < OBJECTS; i++) {
        const cage_ball b = {within(rng, size), within(rng, size), dim == 3 ? within(rng, size) : 0,
                             radius + within(rng, size / 9)};
        t->object[i] = b;
    }
    for (int i = 0; i < OBSTACLES; i++) {
        const cage_ball b = {within(rng, wide), within(rng, wide), dim == 3 ? within(rng, wide) : 0,
                             radius + within(rng, size / 9)};
        t->obstacle[i] = b;
    }
    const cage_scene scene = {{t->object, t->object, OBJECTS, OBJECTS}, {t->obstacle, t->obstacle, OBSTACLES, OBSTACLES}, dim};
    t->scene = scene;
    for (int k = 0; k < dim; k++) {
        t->leg[0].x[k] = within(rng, dim == 2 ? 2 * size : size);
        t->leg[1].x[k] = t->leg[0].x[k] + within(rng, size / (1 << (random_next(rng) % 12)));
    }
    for (int k = 0; k < 4; k += dim == 2 ? 3 : 1) {
        t->leg[0].q[k] = within(rng, entry);
        t->leg[1].q[k] = t->leg[0].q[k] + (turn < entry ? within(rng, turn) : within(rng, entry));
    }
    const int32_t by = random_next(rng) % 2 ? -1 : 1; /* the sign turns nothing */
    for (int k = 0; k < 4; k++)
        t->leg[1].q[k] *= by;
}

static void place(const long double q[4], const cage_ball *b, long double out[3])
{
    const long double v[3] = {b->x, b->y, b->z}, w = q[0], *u = q + 1;
    long double c[3];
    for (int k = 0; k < 3; k++)
        c[k] = 2 * (u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3]);
    for (int k = 0; k < 3; k++)
        out[k] = v[k] + w * c[k] + u[(k + 1) % 3] * c[(k + 2) % 3] - u[(k + 2) % 3] * c[(k + 1) % 3];
}

/* The least clearance of the poses looked at: constant rates, x linear, the arc by its angle. *angle: between the quaternions. */
static long double sampled(const struct trial *t, long double *angle)
{
    long double end[2][4], least = 1e30L, dot = 0;
    for (int e = 0; e < 2; e++) {
        long double square = 0;
        for (int k = 0; k < 4; k++)
            square += (long double)t->leg[e].q[k] * t->leg[e].q[k];
        for (int k = 0; k < 4; k++)
            end[e][k] = t->leg[e].q[k] / sqrtl(square);
    }
    for (int k = 0; k < 4; k++)
        dot += end[0][k] * end[1][k];
    long double across[4], size = 0; /* the part of the second across the first */
    for (int k = 0; k < 4; k++) {
        across[k] = (dot < 0 ? -end[1][k] : end[1][k]) - fabsl(dot) * end[0][k];
        size += across[k] * across[k];
    }
    size = sqrtl(size);
    *angle = atan2l(size, fabsl(dot));
    for (int n = 0; n <= SAMPLES; n++) {
        const long double s = (long double)n / SAMPLES, c = cosl(s * *angle), d = size > 0 ? sinl(s * *angle) / size : 0;
        long double q[4], at[3];
        for (int k = 0; k < 4; k++)
            q[k] = c * end[0][k] + d * across[k];
        for (int i = 0; i < OBJECTS; i++) {
            place(q, &t->object[i], at);
            for (int k = 0; k < 3; k++)
                at[k] += t->leg[0].x[k] + s * ((long double)t->leg[1].x[k] - t->leg[0].x[k]);
            for (int j = 0; j < OBSTACLES; j++) {
                const cage_ball *o = &t->obstacle[j];
                const long double x = at[0] - o->x, y = at[1] - o->y, z = at[2] - o->z;
                const long double gap = sqrtl(x * x + y * y + z * z) - o->r - t->object[i].r;
                least = gap < least ? gap : least;
            }
        }
    }
    return least;
}

static int32_t asked(const struct trial *t)
{
    return cage_path_check(&t->scene, &t->leg[0], &t->leg[1], centre, t->leg, 2);
}

/* Nothing that collides is accepted; what keeps clear by more than the finest piece sweeps is; and as soon as the obstacles have
 * grown into the way, it is refused. */
static void moves(int32_t dim)
{
    uint64_t rng = (uint64_t)dim;
    int n = test_rounds(1000), accepted = 0, refused = 0, near_miss = 0;
    for (int i = 0; i < n; i++) {
        struct trial t;
        make_trial(&rng, dim, &t);
        long double angle, gap = sampled(&t, &angle), length = 0, arm = 0;
        for (int k = 0; k < 3; k++)
            length += fabsl((long double)t.leg[1].x[k] - t.leg[0].x[k]);
        for (int k = 0; k < OBJECTS; k++)
            arm = fmaxl(arm, sqrtl((long double)t.object[k].x * t.object[k].x + (long double)t.object[k].y * t.object[k].y +
                                   (long double)t.object[k].z * t.object[k].z));
        const int32_t answer = asked(&t);
        ck_assert(answer == 0 || answer == 1);
        ck_assert_msg(answer == 0 || gap > -1e-3L, "leg %d accepted, overlap %Lg", i, -gap);
        const long double finest = (length + 2 * angle * arm) / 512;
        ck_assert_msg(answer == 1 || gap < 16 + finest + arm / (1 << 20), "leg %d refused, clearance %Lg", i, gap);
        accepted += answer;
        refused += 1 - answer;
        if (answer == 1 && gap < 1e7L) { /* one unit into the way */
            for (int j = 0; j < OBSTACLES; j++)
                t.obstacle[j].r += (int32_t)ceill(gap) + 1;
            if (cage_scene_check(&t.scene) == CAGE_OK) {
                ck_assert_int_eq(asked(&t), 0);
                near_miss++;
            }
        }
    }
    printf("note: moves in %d dimensions: %d accepted, %d refused, %d of those accepted refused when obstructed\n", (int)dim,
           accepted, refused, near_miss);
    ck_assert(accepted > n / 20 && refused > n / 20 && near_miss > n / 40);
}

START_TEST(moves_in_the_plane) { moves(2); }
END_TEST

START_TEST(moves_in_space) { moves(3); }
END_TEST

/* A quarter turn while going past a post: which side of it the arm passes depends on the two going together. */
START_TEST(rates_are_constant)
{
    static const cage_ball arm[1] = {{1000000, 0, 0, 1000}};
    /* half way the arm is at (1000000, 0) + 1000000 (cos 45, sin 45) degrees */
    const cage_ball at_half[1] = {{1707107, 707107, 0, 1000}}, off_half[1] = {{1707107 - 300000, 707107 + 300000, 0, 1000}};
    const cage_pose leg[2] = {{{0, 0, 0}, {1, 0, 0, 0}}, {{2000000, 0, 0}, {1, 0, 0, 1}}};
    const cage_scene hit = {{arm, arm, 1, 1}, {at_half, at_half, 1, 1}, 2};
    const cage_scene miss = {{arm, arm, 1, 1}, {off_half, off_half, 1, 1}, 2};
    ck_assert_int_eq(cage_path_check(&hit, &leg[0], &leg[1], centre, leg, 2), 0);
    ck_assert_int_eq(cage_path_check(&miss, &leg[0], &leg[1], centre, leg, 2), 1);
    const cage_pose half[2] = {leg[0], {{2000000, 0, 0}, {0, 0, 0, 1}}}; /* no shorter arc */
    ck_assert_int_eq(cage_path_check(&miss, &half[0], &half[1], centre, half, 2), 0);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("move");
    TCase *tests = test_case(suite, "moves");
    tcase_add_test(tests, moves_in_the_plane);
    tcase_add_test(tests, moves_in_space);
    tcase_add_test(tests, rates_are_constant);
    return test_main(suite);
}
