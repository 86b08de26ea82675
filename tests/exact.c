/* exact.c: geometry in exact numbers, straight from the definitions: linear systems and elimination, no formula. */
#include "exact.h"

enum { MOST = 5 }; /* unknowns */

struct linear_system {
    mpq_t m[MOST][MOST + 1];
    int n;
};

static void system_init(struct linear_system *s, int n)
{
    s->n = n;
    for (int i = 0; i < n; i++)
        for (int k = 0; k <= n; k++)
            mpq_init(s->m[i][k]);
}

static void system_clear(struct linear_system *s)
{
    for (int i = 0; i < s->n; i++)
        for (int k = 0; k <= s->n; k++)
            mpq_clear(s->m[i][k]);
}

void exact_set(mpz_t out, int64_t a)
{
    uint64_t size = a < 0 ? 0 - (uint64_t)a : (uint64_t)a;
    mpz_import(out, 1, -1, sizeof size, 0, 0, &size);
    if (a < 0)
        mpz_neg(out, out);
}

static void set_entry(struct linear_system *s, int i, int k, int64_t a)
{
    exact_set(mpq_numref(s->m[i][k]), a);
    mpz_set_ui(mpq_denref(s->m[i][k]), 1);
}

/* Gauss and Jordan: afterwards column n holds the solution. False when there is none or more than one. */
static bool system_solve(struct linear_system *s)
{
    mpq_t factor, term;
    mpq_inits(factor, term, NULL);
    bool regular = true;
    for (int c = 0; c < s->n && regular; c++) {
        int pivot = c;
        while (pivot < s->n && mpq_sgn(s->m[pivot][c]) == 0)
            pivot++;
        regular = pivot < s->n;
        if (!regular)
            break;
        for (int k = 0; k <= s->n; k++)
            mpq_swap(s->m[pivot][k], s->m[c][k]);
        for (int k = s->n; k >= c; k--)
            mpq_div(s->m[c][k], s->m[c][k], s->m[c][c]);
        for (int i = 0; i < s->n; i++) {
            if (i == c || mpq_sgn(s->m[i][c]) == 0)
                continue;
            mpq_set(factor, s->m[i][c]);
            for (int k = c; k <= s->n; k++) {
                mpq_mul(term, factor, s->m[c][k]);
                mpq_sub(s->m[i][k], s->m[i][k], term);
            }
        }
    }
    mpq_clears(factor, term, NULL);
    return regular;
}

void exact_centre_init(struct exact_centre *centre)
{
    mpq_inits(centre->x[0], centre->x[1], centre->x[2], centre->power, NULL);
}

void exact_centre_clear(struct exact_centre *centre)
{
    mpq_clears(centre->x[0], centre->x[1], centre->x[2], centre->power, NULL);
}

static int64_t entry(const struct cage_site *site, int k) { return k == 0 ? site->x : k == 1 ? site->y : site->z; }

/* out += a * b for an integer a */
static void add_multiple(mpq_t out, int64_t a, const mpq_t b)
{
    mpq_t term;
    mpq_init(term);
    exact_set(mpq_numref(term), a);
    mpq_mul(term, term, b);
    mpq_add(out, out, term);
    mpq_clear(term);
}

/* With x = sum of l_j z_j, sum of l_j = 1 and power |x|^2 - 2 x.z_i + h_i = |x|^2 + s: unknowns l_j and s. */
bool exact_centre_solve(int count, const struct cage_site *const v[], struct exact_centre *out)
{
    struct linear_system s;
    system_init(&s, count + 1);
    for (int i = 0; i < count; i++) {
        for (int j = 0; j < count; j++)
            set_entry(&s, i, j, 2 * (entry(v[i], 0) * entry(v[j], 0) + entry(v[i], 1) * entry(v[j], 1) +
                                     entry(v[i], 2) * entry(v[j], 2)));
        set_entry(&s, i, count, 1);
        set_entry(&s, i, count + 1, v[i]->h);
        set_entry(&s, count, i, 1);
    }
    set_entry(&s, count, count, 0);
    set_entry(&s, count, count + 1, 1);
    bool regular = system_solve(&s);
    if (regular) {
        for (int k = 0; k < 3; k++) {
            mpq_set_ui(out->x[k], 0, 1);
            for (int j = 0; j < count; j++)
                add_multiple(out->x[k], entry(v[j], k), s.m[j][count + 1]);
        }
        exact_power(v[0], out->x, out->power);
    }
    system_clear(&s);
    return regular;
}

void exact_power(const struct cage_site *site, mpq_t x[3], mpq_t out)
{
    mpq_t term;
    mpq_init(term);
    exact_set(mpq_numref(out), site->h);
    mpz_set_ui(mpq_denref(out), 1);
    for (int k = 0; k < 3; k++) {
        mpq_mul(term, x[k], x[k]);
        mpq_add(out, out, term);
        add_multiple(out, -2 * entry(site, k), x[k]);
    }
    mpq_clear(term);
}

bool exact_barycentric(int dim, const struct cage_site *const v[4], mpq_t x[3], mpq_t out[4])
{
    struct linear_system s;
    system_init(&s, dim + 1);
    for (int i = 0; i <= dim; i++) {
        for (int k = 0; k < dim; k++)
            set_entry(&s, k, i, entry(v[i], k));
        set_entry(&s, dim, i, 1);
    }
    for (int k = 0; k < dim; k++)
        mpq_set(s.m[k][dim + 1], x[k]);
    set_entry(&s, dim, dim + 1, 1);
    bool regular = system_solve(&s);
    for (int i = 0; i <= dim && regular; i++)
        mpq_set(out[i], s.m[i][dim + 1]);
    system_clear(&s);
    return regular;
}

/* Does x, in the plane of the facet, lie in it? With a point off that plane as a last vertex. */
static bool in_facet(int dim, const struct cage_site *const facet[3], mpq_t x[3])
{
    struct cage_site apex = *facet[0];
    const struct cage_site *v[4] = {facet[0], facet[1], dim == 3 ? facet[2] : &apex, &apex};
    mpq_t l[4];
    bool in = false;
    for (int i = 0; i < 4; i++)
        mpq_init(l[i]);
    for (int k = 0; k < dim && !in; k++) {
        apex = *facet[0];
        *(k == 0 ? &apex.x : k == 1 ? &apex.y : &apex.z) += 1;
        if (!exact_barycentric(dim, v, x, l))
            continue;
        in = true;
        for (int i = 0; i < dim; i++)
            in = in && mpq_sgn(l[i]) >= 0;
        break;
    }
    for (int i = 0; i < 4; i++)
        mpq_clear(l[i]);
    return in;
}

/* The least of the powers is |x|^2 plus an affine function on each power cell, convex there, so it is greatest at a corner of a
 * cell: a vertex (where it is at most 0), where the powers of two ends of an edge are equal, or of all three. */
bool exact_covered(int dim, const struct cage_site *const facet[3])
{
    struct exact_centre centre;
    mpq_t other;
    mpq_init(other);
    exact_centre_init(&centre);
    bool covered = true;
    for (int skip = dim == 3 ? -1 : 2; skip < 3 && covered; skip++) {
        const struct cage_site *v[4] = {facet[skip == 0], facet[skip >= 0 && skip < 2 ? 2 : 1], facet[2], facet[2]};
        if (!exact_centre_solve(skip < 0 ? 3 : 2, v, &centre) || !in_facet(dim, facet, centre.x))
            continue;
        bool in_some = mpq_sgn(centre.power) <= 0;
        for (int i = 0; i < dim; i++) {
            exact_power(facet[i], centre.x, other);
            in_some = in_some || mpq_sgn(other) <= 0;
        }
        covered = in_some;
    }
    exact_centre_clear(&centre);
    mpq_clear(other);
    return covered;
}

/* The stationary point of the sum among the l that are 0 off `of`: sum_k square_ik l_k + m = weight_i, sum of l = 1.
 * False if there is not just one or it has a negative l; else *sign of the sum there. */
static bool stationary(int64_t square[4][4], const int64_t weight[4], const int *of, int count, int *sign)
{
    struct linear_system s;
    mpq_t sum, part;
    system_init(&s, count + 1);
    mpq_inits(sum, part, NULL);
    for (int i = 0; i < count; i++) {
        for (int k = 0; k < count; k++)
            set_entry(&s, i, k, i == k ? 0 : square[of[i]][of[k]]);
        set_entry(&s, i, count, 1);
        set_entry(&s, i, count + 1, weight[of[i]]);
        set_entry(&s, count, i, 1);
    }
    set_entry(&s, count, count, 0);
    set_entry(&s, count, count + 1, 1);
    bool found = system_solve(&s);
    for (int i = 0; i < count && found; i++) {
        found = mpq_sgn(s.m[i][count + 1]) >= 0;
        add_multiple(sum, -weight[of[i]], s.m[i][count + 1]);
        for (int k = 0; k < i; k++) {
            mpq_mul(part, s.m[i][count + 1], s.m[k][count + 1]);
            add_multiple(sum, square[of[i]][of[k]], part);
        }
    }
    *sign = mpq_sgn(sum);
    mpq_clears(sum, part, NULL);
    system_clear(&s);
    return found;
}

/* The greatest value is taken where all l that are not 0 are free to move: at a stationary point among these. If
 * there are many, the sum is the same at all of them, and one of them has a further l = 0. */
bool exact_nowhere_positive(int count, int64_t square[4][4], const int64_t weight[4])
{
    for (int set = 1; set < 1 << count; set++) {
        int of[4], members = 0, sign;
        for (int i = 0; i < count; i++)
            if (set >> i & 1)
                of[members++] = i;
        if (stationary(square, weight, of, members, &sign) && sign > 0)
            return false;
    }
    return true;
}

/* Determinant by Bareiss's elimination, in which every division is exact. */
void exact_determinant(int n, int64_t entries[4][4], mpz_t out)
{
    mpz_t m[4][4], term;
    int sign = 1;
    mpz_init(term);
    for (int i = 0; i < n; i++)
        for (int k = 0; k < n; k++) {
            mpz_init(m[i][k]);
            exact_set(m[i][k], entries[i][k]);
        }
    for (int c = 0; c + 1 < n && sign != 0; c++) {
        int pivot = c;
        while (pivot < n && mpz_sgn(m[pivot][c]) == 0)
            pivot++;
        if (pivot == n)
            sign = 0;
        if (pivot != c && pivot < n) {
            sign = -sign;
            for (int k = 0; k < n; k++)
                mpz_swap(m[pivot][k], m[c][k]);
        }
        for (int i = c + 1; i < n && sign != 0; i++)
            for (int k = c + 1; k < n; k++) {
                mpz_mul(m[i][k], m[i][k], m[c][c]);
                mpz_mul(term, m[i][c], m[c][k]);
                mpz_sub(m[i][k], m[i][k], term);
                if (c > 0)
                    mpz_divexact(m[i][k], m[i][k], m[c - 1][c - 1]);
            }
    }
    mpz_mul_si(out, m[n - 1][n - 1], sign);
    for (int i = 0; i < n; i++)
        for (int k = 0; k < n; k++)
            mpz_clear(m[i][k]);
    mpz_clear(term);
}

void exact_volume(int dim, const struct cage_site *const v[4], mpz_t out)
{
    int64_t m[4][4];
    for (int i = 0; i < dim; i++)
        for (int k = 0; k < dim; k++)
            m[i][k] = entry(v[i + 1], k) - entry(v[0], k);
    exact_determinant(dim, m, out);
}

int exact_orientation(int dim, const struct cage_site *const v[4])
{
    mpz_t volume;
    mpz_init(volume);
    exact_volume(dim, v, volume);
    int sign = mpz_sgn(volume);
    mpz_clear(volume);
    return sign;
}

/* Rows (v_i - p, h_i - h_p): with f the affine function through the heights, h_i - h_p is linear in v_i - p plus f(p)
 * - h_p, so the determinant is f(p) - h_p times det(v_i - p, 1), which is (-1)^dim times the volume. */
void exact_lift(int dim, const struct cage_site *const v[4], const struct cage_site *p, mpz_t out)
{
    int64_t m[4][4];
    for (int i = 0; i <= dim; i++) {
        for (int k = 0; k < dim; k++)
            m[i][k] = entry(v[i], k) - entry(p, k);
        m[i][dim] = v[i]->h - p->h;
    }
    exact_determinant(dim + 1, m, out);
    if (dim == 2)
        mpz_neg(out, out);
}

/* e_p - sum of l_i e_i, l the barycentric coordinates of p: the greatest e with a coefficient that is not 0 decides. */
static int above_by_index(int dim, const struct cage_site *site, const int32_t v[4], int32_t p)
{
    int32_t greatest = -1;
    int sign = 0;
    for (int i = 0; i <= dim; i++) {
        const struct cage_site *swapped[4];
        for (int k = 0; k <= dim; k++)
            swapped[k] = &site[k == i ? p : v[k]];
        int coordinate = exact_orientation(dim, swapped);
        if (coordinate != 0 && v[i] > greatest) {
            greatest = v[i];
            sign = -coordinate;
        }
    }
    return p > greatest ? 1 : sign;
}

int exact_above(int dim, const struct cage_site *site, const int32_t v[4], int32_t p, long *ties)
{
    const struct cage_site *corner[4];
    mpz_t lift;
    for (int i = 0; i <= dim; i++)
        corner[i] = &site[v[i]];
    mpz_init(lift);
    exact_lift(dim, corner, &site[p], lift);
    int sign = mpz_sgn(lift);
    mpz_clear(lift);
    if (sign != 0)
        return sign;
    ++*ties;
    return above_by_index(dim, site, v, p);
}
