/* test_component.c: components of the complement of balls against a flood fill of a dense grid and against Betti numbers. */
#include "support.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/wait.h>

#include "component.h"
#include "exact.h"
#include "flood.h"

enum { MOST = 40, UNIT = 4096 };

enum kind { LOOSE, LATTICE, RING, TOUCHING, NESTED, COSPHERICAL, EQUAL, KINDS };

static const char *const kind_text[KINDS] = {"loose", "lattice", "ring", "touching", "nested", "cospherical", "equal"};

static cage_ball ball_of(int32_t dim, int64_t x, int64_t y, int64_t z, int64_t r)
{
    cage_ball b = {(int32_t)x, (int32_t)y, dim == 3 ? (int32_t)z : 0, (int32_t)(r < 0 ? 0 : r)};
    return b;
}

/* Integer points of a circle of radius 5 and a sphere of radius 3; neighbours are 1.42 to 3.2 and 2 to 2.5 apart. */
static int32_t make_round(uint64_t *state, int32_t dim, int64_t r, int64_t jitter, int32_t gaps, cage_ball *out)
{
    int32_t count = 0, size = dim == 2 ? 5 : 3, deep = dim == 2 ? 0 : size;
    for (int32_t z = -deep; z <= deep; z++)
        for (int32_t y = -size; y <= size; y++)
            for (int32_t x = -size; x <= size; x++) {
                if (x * x + y * y + z * z != size * size || test_between(state, 0, 99) < gaps)
                    continue;
                int64_t c[3] = {x * UNIT, y * UNIT, z * UNIT};
                for (int k = 0; k < 3; k++)
                    c[k] += test_between(state, -jitter, jitter);
                out[count++] = ball_of(dim, c[0], c[1], c[2], r + test_between(state, -jitter, jitter));
            }
    return count;
}

/* Up to MOST balls of a few UNITs; how many. */
static int32_t make(enum kind kind, int32_t dim, uint64_t seed, cage_ball *out)
{
    uint64_t state = seed * 3 + (uint64_t)dim;
    int32_t count = (int32_t)test_between(&state, 0, 24), box = dim == 2 ? 5 : 3;
    int64_t r = test_between(&state, UNIT / 2, 2 * UNIT), q = test_between(&state, 1, 3);
    if (kind == RING)
        return make_round(&state, dim, test_between(&state, UNIT, 2 * UNIT), UNIT / 8, 5, out);
    if (kind == COSPHERICAL)
        return make_round(&state, dim, test_between(&state, 2, 5) * UNIT / 2, 0, 10, out);
    for (int32_t i = 0; i < count; i++) {
        int64_t c[3], x[3];
        for (int k = 0; k < 3; k++) {
            c[k] = test_between(&state, -box * UNIT, box * UNIT);
            x[k] = test_between(&state, -box, box) * UNIT;
        }
        int64_t any = test_between(&state, 0, 2 * UNIT), whole = test_between(&state, 0, 2) * UNIT;
        if (kind == LOOSE)
            out[i] = ball_of(dim, c[0], c[1], c[2], any);
        else if (kind == EQUAL)
            out[i] = ball_of(dim, c[0], c[1], c[2], r);
        else if (kind == LATTICE)
            out[i] = ball_of(dim, x[0], x[1], x[2], q * UNIT / 2);
        else if (kind == NESTED)
            out[i] = ball_of(dim, x[0] / 2, x[1] / 2, x[2] / 2, i == 0 ? 3 * UNIT : whole);
        else /* 3 4 5: centres at distances 3, 4, 5 and radii that add up to them */
            out[i] = ball_of(dim, x[0] / UNIT / 2 * 3 * UNIT, x[1] / UNIT / 2 * 4 * UNIT, x[2] / UNIT / 2 * 4 * UNIT,
                             test_between(&state, 1, 6) * UNIT / 2);
    }
    return count;
}

struct labelled {
    void *block;
    struct cage_triangulation t;
    struct cage_components c;
};

static void label(int32_t dim, const cage_ball *ball, int32_t count, struct labelled *out)
{
    struct cage_arena arena;
    size_t bytes = (size_t)1 << 20;
    out->block = test_alloc(bytes);
    cage_arena_init(&arena, out->block, bytes);
    ck_assert_int_eq(cage_delaunay(&arena, &cage_all_shortcuts, dim, ball, count, &out->t), CAGE_OK);
    ck_assert_int_eq(cage_components(&arena, &out->t, &out->c), CAGE_OK);
}

static int32_t component_at(const struct labelled *l, const int32_t p[3], int32_t *hint)
{
    *hint = cage_delaunay_locate(&l->t, p, *hint);
    return l->c.label[*hint];
}

static const char *compare(int32_t dim, const cage_ball *ball, int32_t count, int32_t pitch, const struct labelled *l,
                           long *decided, long *of)
{
    struct flood flood;
    flood_make(&flood, dim, ball, count, pitch);
    int32_t *said = test_alloc((size_t)flood.cells * sizeof *said), hint = 0;
    for (int32_t cell = 0; cell < flood.cells; cell++) {
        int32_t p[3];
        flood_centre(&flood, cell, p);
        said[cell] = flood_clear(ball, count, p) ? component_at(l, p, &hint) : CAGE_COVERED;
        *of += flood.joined[cell] >= 0;
    }
    const char *wrong = flood_contradicts(&flood, said, l->c.count, decided);
    free(said);
    flood_free(&flood);
    return wrong;
}

/* Every component has a simplex, and its orthocentre is off every ball; `deep` is as large as any. */
static void check_witnesses(const struct labelled *l)
{
    struct exact_centre centre;
    mpq_t power;
    mpz_t volume, largest;
    mpq_init(power);
    mpz_inits(volume, largest, NULL);
    exact_centre_init(&centre);
    for (int32_t k = 1; k < l->c.count; k++) {
        const struct cage_site *v[4];
        test_require(l->c.deep[k] >= 0 && l->c.label[l->c.deep[k]] == k);
        cage_simplex_sites(&l->t, l->c.deep[k], v);
        exact_volume(l->t.dim, v, largest);
        test_require(exact_centre_solve(l->t.dim + 1, v, &centre));
        for (int32_t i = l->t.dim + 1; i < l->t.sites; i++) {
            exact_power(&l->t.site[i], centre.x, power);
            test_require(mpq_sgn(power) > 0);
        }
        for (int32_t s = 0; s < l->t.simplices; s++)
            if (l->c.label[s] == k) {
                cage_simplex_sites(&l->t, s, v);
                exact_volume(l->t.dim, v, volume);
                test_require(mpz_cmp(volume, largest) <= 0);
            }
    }
    exact_centre_clear(&centre);
    mpq_clear(power);
    mpz_clears(volume, largest, NULL);
}

START_TEST(equals_a_flood_fill)
{
    int32_t dim = 2 + _i, rounds = test_rounds(dim == 2 ? 840 : 105), bounded = 0;
    long decided = 0, of = 0;
    for (int32_t seed = 0; seed < rounds; seed++) {
        enum kind kind = (enum kind)(seed % KINDS);
        cage_ball ball[MOST];
        struct labelled l;
        int32_t count = make(kind, dim, (uint64_t)seed, ball);
        label(dim, ball, count, &l);
        const char *wrong = compare(dim, ball, count, dim == 2 ? UNIT / 4 : UNIT / 2, &l, &decided, &of);
        ck_assert_msg(!wrong, "%s, dim %d, seed %d: %s", kind_text[kind], (int)dim, (int)seed, wrong);
        check_witnesses(&l);
        bounded += l.c.count - 1;
        free(l.block);
    }
    printf("components: dim %d, %d scenes, %d bounded components, a flood fill decides %.1f %% of the free points\n", (int)dim,
           (int)rounds, (int)bounded, 100.0 * (double)decided / (double)(of ? of : 1));
    ck_assert_int_ge(bounded, rounds / 10);
    ck_assert(decided > of / 2);
}
END_TEST

static void expect_count(int32_t dim, const cage_ball *ball, int32_t count, int32_t components, const char *what)
{
    struct labelled l;
    label(dim, ball, count, &l);
    ck_assert_msg(l.c.count == components, "%s: %d components, not %d", what, (int)l.c.count, (int)components);
    free(l.block);
}

/* Closed balls that touch hold tight; one unit less, and they do not. */
START_TEST(touching_is_closed)
{
    for (int32_t scale = 1; scale <= 1000000; scale *= 10) {
        cage_ball ball[8];
        for (int32_t less = 0; less <= 1; less++) {
            ball[0] = ball_of(2, 0, 0, 0, scale); /* 3 4 5 */
            ball[1] = ball_of(2, 3 * scale, 0, 0, 2 * scale - less);
            ball[2] = ball_of(2, 0, 4 * scale, 0, 3 * scale);
            expect_count(2, ball, 3, 2 - less, "three that touch");
            for (int32_t i = 0; i < 8; i++) {
                int32_t at[3] = {i & 1 ? scale : -scale, i & 2 ? scale : -scale, i & 4 ? scale : -scale};
                ball[i] = ball_of(3, at[0], at[1], at[2], scale);
            }
            expect_count(3, ball, 8, 1, "eight at the corners of a cube");
            for (int32_t i = 0; i < 4; i++)
                ball[i] = ball_of(2, i & 1 ? scale : -scale, i & 2 ? scale : -scale, 0, scale);
            ball[3].r -= less;
            expect_count(2, ball, 4, 2 - less, "four at the corners of a square");
        }
    }
}
END_TEST

START_TEST(few_balls)
{
    cage_ball ball[3] = {{0, 0, 0, 7}, {0, 0, 0, 7}, {0, 0, 0, 3}};
    for (int32_t dim = 2; dim <= 3; dim++)
        for (int32_t count = 0; count <= 3; count++)
            expect_count(dim, ball, count, 1, "coincident balls");
}
END_TEST

/* A line for each scene to a Python program. */
START_TEST(equals_betti_numbers)
{
    (void)signal(SIGPIPE, SIG_IGN);
    (void)fflush(NULL);
    FILE *python = popen("python3 tests/betti.py", "w");
    ck_assert(python != NULL);
    int32_t rounds = test_rounds(700);
    for (int32_t seed = 0; seed < rounds; seed++)
        for (int32_t dim = 2; dim <= 3; dim++) {
            enum kind kind = (enum kind)(seed % KINDS);
            cage_ball ball[MOST];
            struct labelled l;
            int32_t count = make(kind, dim, (uint64_t)seed + 100000, ball);
            label(dim, ball, count, &l);
            fprintf(python, "%d %d %d %s, seed %d\n", (int)dim, (int)count, (int)l.c.count, kind_text[kind], (int)seed + 100000);
            for (int32_t i = 0; i < count; i++)
                fprintf(python, "%d %d %d %d\n", (int)ball[i].x, (int)ball[i].y, (int)ball[i].z, (int)ball[i].r);
            free(l.block);
        }
    int status = pclose(python);
    ck_assert(WIFEXITED(status));
    if (WEXITSTATUS(status) == 77 || WEXITSTATUS(status) == 127)
        printf("note: comparison of components with Betti numbers left out, it needs python3 with gudhi\n");
    else
        ck_assert_int_eq(WEXITSTATUS(status), 0);
}
END_TEST

START_TEST(too_little_memory)
{
    cage_ball ball[MOST];
    int32_t count = make(RING, 2, 5, ball);
    struct labelled l;
    struct cage_arena arena;
    label(2, ball, count, &l);
    size_t most = (size_t)l.t.simplices * 3 * sizeof(int32_t) + 64;
    void *block = test_alloc(most);
    int32_t enough = 0;
    for (size_t bytes = 0; bytes <= most; bytes += 4) {
        struct cage_components c;
        cage_arena_init(&arena, block, bytes);
        int32_t error = cage_components(&arena, &l.t, &c);
        test_require(error == CAGE_OK || (error == CAGE_ERROR_MEMORY && arena.used == 0 && enough == 0));
        if (error != CAGE_OK)
            continue;
        enough++;
        test_require(c.count == l.c.count);
        for (int32_t s = 0; s < l.t.simplices; s++)
            test_require(c.label[s] == l.c.label[s]);
    }
    ck_assert_int_gt(enough, 0);
    free(block);
    free(l.block);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("component");
    TCase *tests = test_case(suite, "component");
    tcase_add_loop_test(tests, equals_a_flood_fill, 0, 2);
    tcase_add_test(tests, touching_is_closed);
    tcase_add_test(tests, few_balls);
    tcase_add_test(tests, equals_betti_numbers);
    tcase_add_test(tests, too_little_memory);
    return test_main(suite);
}
