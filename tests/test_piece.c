/* test_piece.c: whatever is free in a simplex is within its piece, and pieces said to be apart share no free point. */
#include "support.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ballsets.h"
#include "exact.h"
#include "overlap.h"
#include "pockets.h"

enum { ARENA = 8 << 20, POINTS = 400 };

struct tally {
    long points, shared;       /* grid points free in one slice, in both */
    long pairs, apart, across; /* of pieces, one of each slice: all, apart along fixed directions, and only along a normal */
};

/* A grid point near a ball of the slice, or anywhere. */
static void choose_point(uint64_t *state, const struct cage_slice *slice, int32_t x[3])
{
    const struct cage_triangulation *t = &slice->t;
    const struct cage_site *ball = &t->site[test_between(state, t->dim + (t->sites > t->dim + 1), t->sites - 1)];
    int32_t wide = (int32_t)test_between(state, 1, (int64_t)ball->r + 8);
    const int32_t at[3] = {ball->x, ball->y, ball->z};
    for (int k = 0; k < 3; k++) {
        int64_t to = at[k] + test_between(state, -2 * wide, 2 * wide), most = t->dim == 2 ? CAGE_REACH_2D : CAGE_REACH_3D;
        x[k] = k >= t->dim ? 0 : (int32_t)(to < -most ? -most : to > most ? most : to);
    }
}

static void piece_at(const struct cage_slice *slice, int32_t s, struct cage_piece *piece)
{
    struct cage_orthoball ball;
    cage_orthoball_of(&slice->t, s, &ball);
    cage_piece_make(&slice->t, &ball, piece);
}

/* The free point, in the simplex of the piece, is within all that bounds it. */
static void check_within(const struct cage_piece *piece, const int32_t p[3])
{
    int64_t x = p[0], y = p[1], z = p[2], square = 0;
    const int64_t along[CAGE_DIRECTIONS] = {x,     y,     x + y,     x - y,      z,         x + z,    x - z,
                                            y + z, y - z, x + y + z, -x + y + z, x - y + z, x + y - z};
    for (int i = 0; i < (piece->t->dim == 2 ? CAGE_DIRECTIONS_2D : CAGE_DIRECTIONS); i++)
        test_require(piece->bounds.low[i] <= along[i] && along[i] <= piece->bounds.high[i]);
    for (int k = 0; k < 3 && piece->ball.radius >= 0; k++)
        square += ((int64_t)p[k] - piece->ball.at[k]) * ((int64_t)p[k] - piece->ball.at[k]);
    test_require(piece->ball.radius < 0 || square <= (int64_t)piece->ball.radius * piece->ball.radius);
    for (int i = 0; i < piece->faces; i++) {
        int64_t at = 0;
        for (int k = 0; k < 3; k++)
            at += (int64_t)piece->face[i].normal[k] * p[k];
        test_require(piece->face[i].low <= at && at <= piece->face[i].high);
    }
}

/* A point inside a simplex, not on its border; then all that is free near it, in both slices, is of these two pieces. */
static bool is_inside(const struct cage_triangulation *t, int32_t s, const int32_t p[3])
{
    const struct cage_site point = {0, p[0], p[1], p[2], 0};
    bool inside = true;
    for (int32_t i = 0; i <= t->dim; i++) {
        const struct cage_site *face[3];
        cage_facet_sites(t, s, i, face);
        inside = inside && cage_side(t->dim, face, &point) > 0;
    }
    return inside;
}

static void check_point(const struct cage_slice *c, const struct cage_slice *d, const int32_t p[3], struct tally *tally)
{
    struct cage_piece a, b;
    int32_t s = cage_delaunay_locate(&c->t, p, 0), r = cage_delaunay_locate(&d->t, p, 0);
    if (!cage_slice_clear(c, p))
        return;
    tally->points++;
    piece_at(c, s, &a);
    check_within(&a, p);
    if (c->label[s] > CAGE_OUTSIDE)
        for (int i = 0; i < (c->t.dim == 2 ? CAGE_DIRECTIONS_2D : CAGE_DIRECTIONS); i++)
            test_require(c->region[c->label[s]].bounds.low[i] <= a.bounds.low[i] &&
                         a.bounds.high[i] <= c->region[c->label[s]].bounds.high[i]);
    if (!cage_slice_clear(d, p) || !is_inside(&c->t, s, p) || !is_inside(&d->t, r, p))
        return;
    tally->shared++;
    piece_at(d, r, &b);
    test_require(cage_bounds_meet(c->t.dim, &a.bounds, &b.bounds) && cage_bounds_meet(c->t.dim, &b.bounds, &a.bounds));
    test_require(!cage_piece_is_apart(&a, &b));
    check_within(&a, p);
    check_within(&b, p);
}

/* How much is proved of any two free simplices; and that the codes say no more than the bounds. */
static void count_pairs(uint64_t *state, const struct cage_slice *c, const struct cage_slice *d, struct tally *tally)
{
    for (int n = 0; n < 200; n++) {
        struct cage_piece a, b;
        int32_t s = (int32_t)test_between(state, 0, c->t.simplices - 1), r = (int32_t)test_between(state, 0, d->t.simplices - 1);
        uint32_t common = ~CAGE_CODE_KNOWN;
        if (c->label[s] < 0 || d->label[r] < 0)
            continue;
        piece_at(c, s, &a);
        piece_at(d, r, &b);
        bool meet = cage_bounds_meet(c->t.dim, &a.bounds, &b.bounds);
        tally->pairs++;
        tally->apart += !meet;
        tally->across += meet && cage_piece_is_apart(&a, &b);
        for (int i = 0; i <= d->t.dim; i++)
            common &= cage_bounds_code(c->t.dim, &a.bounds, &d->t.site[d->t.simplex[r].v[i]]);
        test_require(!common || !meet);
    }
}

/* Two neighbouring slices with pockets, in every fourth some that vanish; the block of their arena. */
static void *make_slices(int32_t dim, int32_t seed, uint64_t first, struct cage_arena *arena, struct cage_slice *c,
                         struct cage_slice *d)
{
    struct pockets p;
    struct cage_side side;
    void *block = test_alloc(ARENA);
    cage_arena_init(arena, block, ARENA);
    (seed % 4 ? pockets_make : pockets_vanish)(dim, first + (uint64_t)seed, &p);
    pockets_side(arena, &p, &side);
    test_require(cage_slice_make(arena, &side, &p.at[0], c) == CAGE_OK);
    test_require(cage_slice_make(arena, &side, &p.at[1], d) == CAGE_OK);
    return block;
}

START_TEST(holds_what_is_free)
{
    struct tally tally = {0, 0, 0, 0, 0};
    int32_t rounds = test_rounds(_i == 2 ? 800 : 500);
    for (int32_t seed = 0; seed < rounds; seed++) {
        struct cage_arena arena;
        struct cage_slice c, d;
        uint64_t state = (uint64_t)seed;
        void *block = make_slices(_i, seed, 0, &arena, &c, &d);
        for (int n = 0; n < POINTS; n++) {
            int32_t x[3];
            choose_point(&state, n & 1 ? &c : &d, x);
            check_point(&c, &d, x, &tally);
            check_point(&d, &c, x, &tally);
        }
        for (int32_t k = 0; k < c.regions; k++)
            if (c.region[k].known)
                check_point(&c, &d, c.region[k].point, &tally);
        count_pairs(&state, &c, &d, &tally);
        free(block);
    }
    printf("note: pieces in %d dimensions: %ld free points, %ld in both slices; %ld pairs, %ld apart, %ld more along normals\n", _i,
           tally.points, tally.shared, tally.pairs, tally.apart, tally.across);
    ck_assert_int_gt(tally.shared, rounds * POINTS / 50);
    ck_assert_int_gt(tally.apart, tally.pairs / 10);
    ck_assert_int_gt(tally.across, tally.pairs / 100);
}
END_TEST

static bool in_ball(const struct cage_piece *piece, const int32_t p[3])
{
    int64_t square = 0;
    for (int k = 0; k < 3; k++)
        square += ((int64_t)p[k] - piece->ball.at[k]) * ((int64_t)p[k] - piece->ball.at[k]);
    return piece->ball.radius < 0 || square <= (int64_t)piece->ball.radius * piece->ball.radius;
}

/* A grid point near one of the simplex. */
static void mix_vertices(uint64_t *state, const struct cage_triangulation *t, int32_t s, int32_t p[3])
{
    int64_t part[4], sum = 1, at[3] = {0, 0, 0};
    for (int i = 0; i <= t->dim; i++)
        sum += part[i] = test_between(state, 0, 1000);
    for (int i = 0; i <= t->dim; i++) {
        const struct cage_site *v = &t->site[t->simplex[s].v[i]];
        at[0] += part[i] * v->x;
        at[1] += part[i] * v->y;
        at[2] += part[i] * v->z;
    }
    for (int k = 0; k < 3; k++)
        p[k] = (int32_t)(at[k] / sum);
}

/* Whatever point is in a piece of K and in one of L is in a box. The number of such points. */
static long check_overlap(struct cage_arena *arena, uint64_t *state, const struct cage_slice *c, int32_t k,
                          const struct cage_slice *d, int32_t l)
{
    struct cage_overlap o;
    int32_t dim = c->t.dim;
    long shared = 0;
    size_t mark = arena->used;
    memset(&o, 0, sizeof o);
    o.c = c;
    o.d = d;
    o.k = k;
    o.l = l;
    test_require(cage_overlap_pieces(arena, &o) == CAGE_OK && cage_overlap_boxes(arena, &o) == CAGE_OK);
    test_require(o.boxes <= CAGE_OVERLAP_BOXES);
    for (int32_t s = 0; s < c->t.simplices; s++)
        for (int n = 0; c->label[s] == k && n < 20; n++) {
            struct cage_piece a, b;
            int32_t p[3];
            bool held = false;
            mix_vertices(state, &c->t, s, p);
            int32_t r = cage_delaunay_locate(&d->t, p, 0);
            if (d->label[r] != l || !is_inside(&c->t, s, p) || !is_inside(&d->t, r, p))
                continue;
            piece_at(c, s, &a);
            piece_at(d, r, &b);
            if (!in_ball(&a, p) || !in_ball(&b, p))
                continue;
            for (int32_t i = 0; i < o.boxes && !held; i++) {
                held = true;
                for (int m = 0; m < dim; m++)
                    held = held && o.box[i].low[m] <= p[m] && p[m] <= o.box[i].high[m];
            }
            test_require(held);
            shared++;
        }
    cage_arena_release(arena, mark);
    return shared;
}

START_TEST(boxes_hold_what_is_shared)
{
    long pairs = 0, met = 0;
    int32_t rounds = test_rounds(_i == 2 ? 300 : 200);
    for (int32_t seed = 0; seed < rounds; seed++) {
        struct cage_arena arena;
        struct cage_slice c, d;
        uint64_t state = (uint64_t)seed;
        void *block = make_slices(_i, seed, 5000, &arena, &c, &d);
        for (int32_t k = 1; k < c.regions; k++)
            for (int32_t l = 0; l < d.regions; l++) {
                long found = check_overlap(&arena, &state, &c, k, &d, l);
                pairs++;
                met += found > 0;
            }
        free(block);
    }
    printf("note: overlaps in %d dimensions: %ld pairs of components, %ld with pieces that share a point\n", _i, pairs, met);
    ck_assert_int_gt(met, pairs / 20);
}
END_TEST

/* Is a within by / 2 of b? value: how far it is. */
static bool is_within(mpq_t a, int64_t b, long by, mpq_t value)
{
    mpq_t bound;
    mpq_init(bound);
    mpq_set_si(bound, by, 2);
    mpq_canonicalize(bound);
    mpq_set_si(value, b, 1);
    mpq_sub(value, a, value);
    mpq_abs(value, value);
    bool within = mpq_cmp(value, bound) <= 0;
    mpq_clear(bound);
    return within;
}

/* Off by less than 1.5, with a radius large enough for that; there is none only far away. */
static void check_ball(const struct cage_triangulation *t, int32_t s, struct exact_centre *exact, mpq_t value, mpq_t square)
{
    const struct cage_site *v[4];
    struct cage_orthoball ball;
    int64_t reach = t->dim == 2 ? CAGE_REACH_2D : CAGE_REACH_3D;
    bool far = false;
    cage_simplex_sites(t, s, v);
    cage_orthoball_of(t, s, &ball);
    test_require(exact_centre_solve(t->dim + 1, v, exact) && ball.simplex == s);
    mpq_set_si(square, 0, 1);
    for (int k = 0; k < t->dim; k++) {
        far = far || !is_within(exact->x[k], 0, 2 * (reach - 2), value);
        if (ball.radius < 0)
            continue;
        test_require(is_within(exact->x[k], ball.at[k], 1, value)); /* the nearest */
        mpq_mul(value, value, value); /* the distance, squared */
        mpq_add(square, square, value);
    }
    test_require(ball.radius >= 0 || far);
    if (ball.radius < 0)
        return;
    mpq_set_si(value, ball.radius - 1, 1); /* the ball about the orthocentre itself, which is less than 1 away, lies in it */
    mpq_mul(value, value, value);
    test_require(mpq_cmp_ui(square, 1, 1) < 0 && ball.radius >= 2 && mpq_cmp(exact->power, value) <= 0);
    /* If it is said to be off all balls up to some radius it is off all that reach as far as the power allows. */
    for (int32_t radius = 1; radius > 0 && radius < 1 << 28 && cage_orthoball_is_off(t, &ball, radius); radius *= 2) {
        mpq_set_si(value, 2 * (int64_t)radius + 1, 1);
        test_require(mpq_cmp(exact->power, value) > 0);
    }
}

/* As ball sets have them; or on a coarse lattice, where offsets are 0 and determinants multiples of 2^64; or nearly so. */
static void make_balls(int kind, int32_t dim, uint64_t seed, int32_t count, cage_ball *ball)
{
    uint64_t state = seed;
    int32_t pitch = dim == 2 ? 1 << 26 : 1 << 21, jitter = kind == BALLS_KINDS ? 0 : 2;
    if (kind < BALLS_KINDS)
        balls_make((enum balls_kind)kind, dim, seed, count, ball);
    for (int32_t i = 0; i < count && kind >= BALLS_KINDS; i++) {
        int32_t x[3];
        for (int k = 0; k < 3; k++)
            x[k] = k < dim ? (int32_t)(pitch * test_between(&state, -2, 2) + test_between(&state, -jitter, jitter)) : 0;
        const cage_ball made = {x[0], x[1], x[2], pitch / 2 + (int32_t)test_between(&state, -jitter, jitter)};
        ball[i] = made;
    }
}

START_TEST(balls_are_exact)
{
    struct exact_centre exact;
    mpq_t value, square;
    long balls = 0;
    exact_centre_init(&exact);
    mpq_inits(value, square, (mpq_ptr)NULL);
    for (int kind = 0; kind < BALLS_KINDS + 2; kind++)
        for (int32_t seed = 0; seed < test_rounds(10); seed++) {
            static cage_ball ball[60];
            struct cage_arena arena;
            struct cage_triangulation t;
            void *block = test_alloc(ARENA);
            cage_arena_init(&arena, block, ARENA);
            make_balls(kind, _i, (uint64_t)seed, 60, ball);
            test_require(cage_delaunay(&arena, &cage_all_shortcuts, _i, ball, 60, &t) == CAGE_OK);
            for (int32_t s = 0; s < t.simplices; s++)
                if (!cage_simplex_outer(&t, s)) {
                    check_ball(&t, s, &exact, value, square);
                    balls++;
                }
            free(block);
        }
    exact_centre_clear(&exact);
    mpq_clears(value, square, (mpq_ptr)NULL);
    ck_assert_int_gt(balls, 400 * test_rounds(10));
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("piece");
    TCase *tests = test_case(suite, "piece");
    tcase_add_loop_test(tests, holds_what_is_free, 2, 4);
    tcase_add_loop_test(tests, balls_are_exact, 2, 4);
    tcase_add_loop_test(tests, boxes_hold_what_is_shared, 2, 4);
    return test_main(suite);
}
