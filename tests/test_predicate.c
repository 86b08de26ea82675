/* test_predicate.c: every predicate against its definition in rationals, in both builds, ties and extremes included. */
#include "support.h"

#include <string.h>

#include "backend.h"
#include "exact.h"
#include "sites.h"

enum {
    SIDE,
    CONFLICT,
    VOLUME,
    POWER,
    CENTRE,
    SIMPLEX_POWER,
    CENTRE_SIDE,
    OFF,
    FACET_POWER,
    ATTACHED,
    COVERED,
    SOLID,
    NORM,
    PREDICATES
};
static const char *const names[PREDICATES] = {"side", "conflict", "volume", "power", "centre", "simplex power",
                                              "centre side", "off", "facet power", "attached", "covered", "solid", "norm"};

static const struct backend *const backends[4] = {&native, &limbs, &broken_carry, &broken_sign};
static long tried[PREDICATES], wrong[4][PREDICATES], seen[PREDICATES][3];

static void note(int predicate, int32_t right, const int32_t got[4])
{
    tried[predicate]++;
    seen[predicate][right + 1]++;
    for (int k = 0; k < 4; k++)
        wrong[k][predicate] += got[k] != right;
}

#define COMPARE(predicate, right, call)             \
    do {                                            \
        int32_t got[4];                             \
        for (int k_ = 0; k_ < 4; k_++)              \
            got[k_] = (int32_t)backends[k_]->call;  \
        note(predicate, right, got);                \
    } while (0)

static void to_mpz(mpz_t out, words a)
{
    mpz_import(out, 2, -1, sizeof(uint64_t), 0, 0, a.word);
    if (a.word[1] >> 63) {
        mpz_t top;
        mpz_init_set_ui(top, 1);
        mpz_mul_2exp(top, top, 128);
        mpz_sub(out, out, top);
        mpz_clear(top);
    }
}

/* Is base + offset / denominator the centre, and the denominator twice the volume? */
static bool centre_is(int dim, const struct cage_site *const v[4], const words got[4], struct exact_centre *right)
{
    bool same = true;
    mpq_t x, base;
    mpz_t twice;
    mpq_inits(x, base, NULL);
    mpz_init(twice);
    exact_volume(dim, v, twice);
    mpz_mul_2exp(twice, twice, 1);
    for (int k = 0; k < 3; k++) {
        to_mpz(mpq_numref(x), got[k]);
        to_mpz(mpq_denref(x), got[3]);
        same = same && mpz_sgn(mpq_denref(x)) > 0 && mpz_cmp(mpq_denref(x), twice) == 0;
        if (!same)
            break;
        mpq_canonicalize(x);
        mpq_set_si(base, k == 0 ? v[0]->x : k == 1 ? v[0]->y : v[0]->z, 1);
        mpq_add(x, x, base);
        same = mpq_equal(x, right->x[k]);
    }
    mpq_clears(x, base, NULL);
    mpz_clear(twice);
    return same;
}

/* The squared edges of the simplex or facet, [i][k] between vertices i and k, and its squared radii. */
static void measure(int count, const struct cage_site *const v[], int64_t square[4][4], int64_t weight[4])
{
    for (int i = 0; i < count; i++) {
        for (int k = 0; k < count; k++) {
            int64_t x = (int64_t)v[i]->x - v[k]->x, y = (int64_t)v[i]->y - v[k]->y, z = (int64_t)v[i]->z - v[k]->z;
            square[i][k] = x * x + y * y + z * z;
        }
        weight[i] = (int64_t)v[i]->r * v[i]->r;
    }
}

/* A tetrahedron that holds its orthocentre is proved to be covered only if the power there is not positive. (The rest
 * is in test_cover.c.) */
static void check_solid(int dim, const struct cage_site *const v[4], struct exact_centre *centre, mpq_t l[4])
{
    int64_t square[4][4], weight[4];
    int32_t got[4];
    if (dim == 2)
        return;
    measure(4, v, square, weight);
    test_require(exact_barycentric(dim, v, centre->x, l));
    bool inside = mpq_sgn(l[0]) >= 0 && mpq_sgn(l[1]) >= 0 && mpq_sgn(l[2]) >= 0 && mpq_sgn(l[3]) >= 0;
    for (int k = 0; k < 4; k++)
        got[k] = !inside || mpq_sgn(centre->power) <= 0 || !backends[k]->tetrahedron_covered(square, weight);
    seen[SOLID][0] += backends[0]->tetrahedron_covered(square, weight);
    note(SOLID, 1, got);
}

/* Everything that is asked about a positive simplex v, another one w, and a site p. */
static void check_simplex(int dim, const struct cage_site *const v[4], const struct cage_site *const w[4],
                          const struct cage_site *p, struct exact_centre *centre, mpq_t l[4], mpq_t value)
{
    mpq_t at[3];
    mpq_inits(at[0], at[1], at[2], NULL);
    mpq_set_si(at[0], p->x, 1);
    mpq_set_si(at[1], p->y, 1);
    mpq_set_si(at[2], p->z, 1);
    test_require(exact_barycentric(dim, v, at, l));
    for (int i = 0; i <= dim; i++) {
        const struct cage_site *face[3] = {0};
        for (int k = 0; k < dim; k++)
            face[k] = v[dim == 2 ? CAGE_FACE_2D[i][k] : CAGE_FACE_3D[i][k]];
        COMPARE(SIDE, mpq_sgn(l[i]), side(dim, face, p));
        COMPARE(SIDE, 1, side(dim, face, v[i]));
    }
    test_require(exact_centre_solve(dim + 1, v, centre));
    exact_power(p, centre->x, value);
    COMPARE(CONFLICT, mpq_cmp(value, centre->power) < 0, conflict(dim, v, p));

    mpz_t volume;
    mpz_init(volume);
    exact_lift(dim, v, p, volume); /* exact.c itself: both of its ways agree */
    int sign = mpq_cmp(value, centre->power);
    test_require(mpz_sgn(volume) == (sign > 0) - (sign < 0));
    exact_volume(dim, v, volume);
    int32_t same[4];
    for (int k = 0; k < 4; k++) {
        mpz_t got;
        mpz_init(got);
        to_mpz(got, backends[k]->volume(dim, v));
        same[k] = mpz_cmp(got, volume) == 0;
        mpz_clear(got);
    }
    note(VOLUME, 1, same);
    mpz_clear(volume);
    for (int k = 0; k < 4; k++) {
        words got[4];
        backends[k]->centre(dim, v, got);
        same[k] = centre_is(dim, v, got, centre);
    }
    note(CENTRE, 1, same);
    if (!sites_sentinel_among(dim + 1, v)) {
        COMPARE(SIMPLEX_POWER, mpq_sgn(centre->power), simplex_power(dim, v));
        check_solid(dim, v, centre, l);
    }
    if (!sites_sentinel_among(1, &p))
        COMPARE(OFF, mpq_sgn(value) > 0, centre_off(dim, v, p));
    test_require(exact_barycentric(dim, w, centre->x, l));
    for (int i = 0; i <= dim; i++) {
        const struct cage_site *face[3] = {0};
        for (int k = 0; k < dim; k++)
            face[k] = w[dim == 2 ? CAGE_FACE_2D[i][k] : CAGE_FACE_3D[i][k]];
        COMPARE(CENTRE_SIDE, mpq_sgn(l[i]), centre_side(dim, face, v));
    }
    mpq_clears(at[0], at[1], at[2], NULL);
}

static void check_facet(int dim, const struct cage_site *const facet[3], const struct cage_site *w,
                        struct exact_centre *centre, mpq_t value)
{
    if (!exact_centre_solve(dim, facet, centre))
        return;
    COMPARE(FACET_POWER, mpq_sgn(centre->power), facet_power(dim, facet));
    exact_power(w, centre->x, value);
    COMPARE(ATTACHED, mpq_cmp(value, centre->power) < 0, facet_attached(dim, facet, w));
    /* For a triangle no proof is not a disproof: only a yes can be wrong. */
    int64_t edge[4][4], weight[4];
    measure(dim, facet, edge, weight);
    const int64_t square[3] = {dim == 2 ? edge[0][1] : edge[1][2], dim == 2 ? 0 : edge[0][2], dim == 2 ? 0 : edge[0][1]};
    int32_t got[4], truth = exact_covered(dim, facet);
    for (int k = 0; k < 4; k++) {
        got[k] = backends[k]->edges_covered(dim, square, weight);
        seen[COVERED][0] += k == 0 && got[k];
        got[k] = dim == 2 ? got[k] == truth : got[k] <= truth;
    }
    note(COVERED, 1, got);
}

static void check_power(const struct cage_site *site, const struct cage_site *at)
{
    mpz_t right, term;
    mpz_inits(right, term, NULL);
    const int64_t d[3] = {(int64_t)at->x - site->x, (int64_t)at->y - site->y, (int64_t)at->z - site->z};
    for (int k = 0; k < 3; k++) {
        exact_set(term, d[k]);
        mpz_addmul(right, term, term);
    }
    mpz_set_si(term, site->r);
    mpz_submul(right, term, term);
    const int32_t p[3] = {at->x, at->y, at->z};
    int32_t same[4];
    for (int k = 0; k < 4; k++) {
        exact_set(term, backends[k]->power(site, p));
        same[k] = mpz_cmp(right, term) == 0;
    }
    note(POWER, 1, same);
    mpz_clears(right, term, NULL);
}

static void judge(int dim)
{
    for (int p = 0; p < NORM; p++)
        for (int k = 0; k < 2; k++)
            ck_assert_msg(wrong[k][p] == 0, "%s: %s: %ld of %ld wrong", backends[k]->name, names[p], wrong[k][p], tried[p]);
    /* Every answer was wanted often, ties included. */
    static const int three[] = {SIDE, SIMPLEX_POWER, CENTRE_SIDE, FACET_POWER};
    for (int i = 0; i < 4; i++)
        for (int s = 0; s < 3; s++)
            ck_assert_msg(seen[three[i]][s] > tried[three[i]] / 200, "%s: answer %d hardly seen", names[three[i]], s - 1);
    ck_assert_int_gt(seen[CONFLICT][2], tried[CONFLICT] / 20);
    ck_assert_int_gt(seen[ATTACHED][2], tried[ATTACHED] / 20);
    ck_assert_int_gt(seen[COVERED][0], tried[COVERED] / 20);
    ck_assert(dim == 2 || seen[SOLID][0] > tried[SOLID] / 40);
    ck_assert_int_gt(seen[OFF][1], tried[OFF] / 20);
    ck_assert_int_gt(seen[OFF][2], tried[OFF] / 20);
    /* The same comparison catches the two deliberate errors. */
    long carry = 0, sign = 0;
    for (int p = 0; p < NORM; p++) {
        carry += wrong[2][p];
        sign += wrong[3][p];
    }
    ck_assert_int_gt(carry, 0);
    ck_assert_int_gt(sign, 0);
    ck_assert_int_gt(wrong[2][CONFLICT], 0);
    ck_assert_int_gt(wrong[dim == 2 ? 3 : 2][SIMPLEX_POWER], 0);
    memset(tried, 0, sizeof tried);
    memset(wrong, 0, sizeof wrong);
    memset(seen, 0, sizeof seen);
}

START_TEST(definitions)
{
    int dim = _i;
    uint64_t state = (uint64_t)dim;
    struct exact_centre centre;
    mpq_t l[4], value;
    exact_centre_init(&centre);
    mpq_inits(l[0], l[1], l[2], l[3], value, NULL);
    for (int kind = 0; kind < SITES_KINDS; kind++)
        for (int32_t round = test_rounds(1500); round > 0; round--) {
            struct cage_site s[13];
            sites_make(&state, dim, (enum sites_kind)kind, 10, s);
            sites_make(&state, dim, (enum sites_kind)(random_next(&state) % SITES_KINDS), 3, s + 10);
            const struct cage_site *v[4] = {s, s + 1, s + 2, s + 3}, *w[4] = {s + 4, s + 5, s + 6, s + 7};
            const struct cage_site *p = &s[8 + random_next(&state) % 5], *facet[3] = {s + 8, s + 9, s + 4};
            if (sites_orient(dim, v) && (sites_orient(dim, w) || (memcpy(w, v, sizeof w), true)))
                check_simplex(dim, v, w, p, &centre, l, value);
            if (!sites_sentinel_among(dim, facet))
                check_facet(dim, facet, p == s + 8 || p == s + 9 ? s + 10 : p, &centre, value);
            check_power(s, p);
        }
    judge(dim);
    exact_centre_clear(&centre);
    mpq_clears(l[0], l[1], l[2], l[3], value, NULL);
}
END_TEST

/* |n|^2 against g^2 where they are equal, next to equal, and far apart, at every size. */
START_TEST(norms)
{
    uint64_t state = 7;
    mpz_t n[3], g, norm, square;
    mpz_inits(n[0], n[1], n[2], g, norm, square, NULL);
    for (int32_t round = test_rounds(60000); round > 0; round--) {
        const int *row = sites_pythagoras[random_next(&state) & 1][random_next(&state) % 6];
        unsigned shift = (unsigned)(random_next(&state) % 118);
        mpz_set_ui(norm, 0);
        for (int k = 0; k < 3; k++) {
            mpz_set_si(n[k], random_next(&state) & 1 ? row[k] : -row[k]);
            mpz_mul_2exp(n[k], n[k], shift);
            mpz_addmul(norm, n[k], n[k]);
        }
        mpz_set_si(g, row[3]);
        mpz_mul_2exp(g, g, shift);
        int64_t off = random_next(&state) & 1 ? 0 : test_spread(&state, INT64_MAX);
        exact_set(square, off);
        mpz_add(g, g, square);
        mpz_abs(g, g);
        mpz_mul(square, g, g);
        words size[3], limit = {{0, 0, 0, 0}};
        for (int k = 0; k < 3; k++) {
            memset(&size[k], 0, sizeof size[k]);
            mpz_export(size[k].word, NULL, -1, sizeof(uint64_t), 0, 0, n[k]);
            if (mpz_sgn(n[k]) < 0) {
                size[k].word[0] = ~size[k].word[0] + 1;
                size[k].word[1] = ~size[k].word[1] + (size[k].word[0] == 0);
            }
        }
        mpz_export(limit.word, NULL, -1, sizeof(uint64_t), 0, 0, g);
        int32_t right = (mpz_cmp(norm, square) > 0) - (mpz_cmp(norm, square) < 0);
        COMPARE(NORM, right, norm_compare(size, limit));
    }
    ck_assert_int_eq(wrong[0][NORM] + wrong[1][NORM], 0);
    for (int s = 0; s < 3; s++)
        ck_assert_int_gt(seen[NORM][s], tried[NORM] / 10);
    memset(wrong, 0, sizeof wrong);
    mpz_clears(n[0], n[1], n[2], g, norm, square, NULL);
}
END_TEST

/* The power of a centre is decided on its top bits where it can be, and on all bits where it must. */
START_TEST(both_ways_to_decide)
{
    for (int dim = 2; dim <= 3; dim++) {
        uint64_t state = 8;
        long easy = 0, easy_exact = 0, tie = 0, tie_exact = 0;
        for (int round = 0; round < 2000; round++) {
            struct cage_site s[4];
            const struct cage_site *v[4] = {s, s + 1, s + 2, s + 3};
            sites_make(&state, dim, round & 1 ? SITES_FULL : SITES_THROUGH_POINT, 4, s);
            if (!sites_orient(dim, v))
                continue;
            *limbs.exact = 0;
            int32_t sign = limbs.simplex_power(dim, v);
            easy += round & 1;
            easy_exact += (round & 1) && *limbs.exact > 0;
            tie += !(round & 1) && sign == 0;
            tie_exact += !(round & 1) && sign == 0 && *limbs.exact > 0;
        }
        ck_assert_int_gt(tie, 100);
        ck_assert_int_eq(tie_exact, tie);
        ck_assert_int_lt(easy_exact, easy / 10);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("predicate");
    TCase *tests = test_case(suite, "predicate");
    tcase_add_loop_test(tests, definitions, 2, 4);
    tcase_add_test(tests, norms);
    tcase_add_test(tests, both_ways_to_decide);
    return test_main(suite);
}
