/* test_bounds.c: the magnitudes that predicate.h promises, sought at the extremes of the range and measured with GMP. */
#include "support.h"

#include "backend.h"
#include "exact.h"
#include "sites.h"

/* What is measured on seven sites: 0..3 a simplex (made positive), 4..6 a point or a face. */
enum { HEIGHT, VOLUME, LIFT, POWER, OFFSET, DENOMINATOR, CENTRE_SIDE, QUANTITIES };
static const char *const names[QUANTITIES] = {"h", "volume", "power test", "power", "offset", "denominator", "side of centre"};

static mpz_t term, least, sum;

static void to_mpz(mpz_t out, words a)
{
    bool negative = a.word[1] >> 63;
    if (negative) {
        a.word[0] = ~a.word[0] + 1;
        a.word[1] = ~a.word[1] + (a.word[0] == 0);
    }
    mpz_import(out, 2, -1, sizeof(uint64_t), 0, 0, a.word);
    if (negative)
        mpz_neg(out, out);
}

/* The orientation determinant of face and centre, times the denominator. Affine in its last point. */
static void side_value(int dim, const struct cage_site *site, const words centre[4], const struct cage_site *base, mpz_t out)
{
    struct cage_site last = *base;
    const struct cage_site *v[4] = {&site[4], &site[5], dim == 2 ? &last : &site[6], &last};
    exact_volume(dim, v, least);
    to_mpz(out, centre[3]);
    mpz_mul(out, out, least);
    for (int k = 0; k < dim; k++) {
        int32_t *at = k == 0 ? &last.x : k == 1 ? &last.y : &last.z;
        ++*at;
        exact_volume(dim, v, sum);
        --*at;
        mpz_sub(sum, sum, least);
        to_mpz(term, centre[k]);
        mpz_addmul(out, term, sum);
    }
}

/* |quantity|; 0 for a flat simplex. */
static void measure(int dim, int quantity, const struct cage_site *site, mpz_t out)
{
    const struct cage_site *v[4] = {site, site + 1, site + 2, site + 3}, *p = &site[4];
    const int32_t at[3] = {p->x, p->y, p->z};
    words centre[4];
    mpz_set_ui(out, 0);
    if (quantity == HEIGHT)
        exact_set(out, p->h);
    else if (quantity == POWER)
        exact_set(out, native.power(site, at));
    else if (sites_orient(dim, v)) {
        if (quantity == VOLUME)
            exact_volume(dim, v, out);
        else if (quantity == LIFT)
            exact_lift(dim, v, p, out);
        else
            native.centre(dim, v, centre); /* its value is tested with the definitions */
        if (quantity == CENTRE_SIDE)
            side_value(dim, site, centre, v[0], out);
        if (quantity == DENOMINATOR)
            to_mpz(out, centre[3]);
        for (int k = 0; k < dim && quantity == OFFSET; k++) {
            to_mpz(term, centre[k]);
            if (mpz_cmpabs(term, out) > 0)
                mpz_set(out, term);
        }
    }
    mpz_abs(out, out);
}

/* bound = factor * M^degree + rest, or 2^bits where factor is 0 */
struct bound {
    unsigned factor, degree, rest, bits;
};

static const struct bound bounds[2][QUANTITIES] = {
    {{2, 2, 1, 0}, {8, 2, 0, 0}, {24, 4, 0, 0}, {12, 2, 0, 0}, {0, 0, 0, 93}, {0, 0, 0, 63}, {56, 4, 0, 0}},
    {{3, 2, 1, 0}, {48, 3, 0, 0}, {96, 5, 0, 0}, {12, 2, 0, 0}, {0, 0, 0, 106}, {0, 0, 0, 80}, {768, 6, 0, 0}}};

static void bound_value(int dim, int quantity, mpz_t out)
{
    const struct bound *b = &bounds[dim - 2][quantity];
    exact_set(out, sites_largest(dim));
    mpz_pow_ui(out, out, b->degree);
    mpz_mul_ui(out, out, b->factor);
    mpz_add_ui(out, out, b->rest);
    if (b->factor == 0) {
        mpz_set_ui(out, 1);
        mpz_mul_2exp(out, out, b->bits);
        mpz_sub_ui(out, out, 1);
    }
}

/* The sites a climb may choose from: coordinates 0 or +-M, radius 0 or M; then the sentinels. */
static int choices(int dim) { return (dim == 2 ? 18 : 54) + dim + 1; }

static struct cage_site choice(int dim, int number)
{
    int grid = dim == 2 ? 18 : 54;
    if (number >= grid)
        return sites_sentinel(dim, number - grid);
    int64_t m = sites_largest(dim), r = (number & 1) * m;
    number /= 2;
    return sites_ball(dim, (number % 3 - 1) * m, (number / 3 % 3 - 1) * m, (number / 9 - 1) * m, r);
}

/* From a random start, change one site at a time as long as the value grows. */
static void climb(uint64_t *state, int dim, int quantity, mpz_t best)
{
    struct cage_site site[7];
    for (int i = 0; i < 7; i++)
        site[i] = choice(dim, (int)test_between(state, 0, choices(dim) - 1));
    mpz_t value, here;
    mpz_inits(value, here, NULL);
    measure(dim, quantity, site, here);
    for (bool grown = true; grown;) {
        grown = false;
        for (int i = 0; i < 7; i++)
            for (int c = 0; c < choices(dim); c++) {
                struct cage_site kept = site[i];
                site[i] = choice(dim, c);
                measure(dim, quantity, site, value);
                if (mpz_cmp(value, here) > 0) {
                    mpz_set(here, value);
                    grown = true;
                } else {
                    site[i] = kept;
                }
            }
    }
    if (mpz_cmp(here, best) > 0)
        mpz_set(best, here);
    mpz_clears(value, here, NULL);
}

START_TEST(magnitudes)
{
    int dim = _i;
    uint64_t state = 11;
    mpz_t best, bound;
    mpz_inits(best, bound, term, least, sum, NULL);
    for (int quantity = 0; quantity < QUANTITIES; quantity++) {
        mpz_set_ui(best, 0);
        for (int32_t start = test_rounds(20); start > 0; start--)
            climb(&state, dim, quantity, best);
        bound_value(dim, quantity, bound);
        double share = mpz_get_d(best) / mpz_get_d(bound);
        ck_assert_msg(mpz_cmp(best, bound) <= 0, "%s, dim %d: %g times its bound", names[quantity], dim, share);
        /* The search is worth its name: it comes within six bits of every bound. */
        ck_assert_msg(share > 1.0 / 64, "%s, dim %d: only %g of its bound was reached", names[quantity], dim, share);
    }
    mpz_clears(best, bound, term, least, sum, NULL);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("bounds");
    tcase_add_loop_test(test_case(suite, "bounds"), magnitudes, 2, 4);
    return test_main(suite);
}
