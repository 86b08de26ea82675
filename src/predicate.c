/* predicate: the only file that answers a geometric question: formula, bound, tie rule. */
#ifndef CAGE_SHARED
#define CAGE_SHARED CAGE_INLINE
#endif
#include "predicate.h"

extern inline cage_i128 cage_mix(int64_t m1, int64_t z1, int64_t m2, int64_t z2, int64_t m3, int64_t z3);
extern inline void cage_difference(const struct cage_site *a, const struct cage_site *b, int32_t out[3]);

const int32_t CAGE_FACE_2D[3][2] = {{1, 2}, {2, 0}, {0, 1}};
const int32_t CAGE_FACE_3D[4][3] = {{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}};

/* u.u - r_1^2 + r_0^2 for u = z_1 - z_0, from the heights, right for sentinels too: <= 9 M^2 in the plane (2^61.2), 13 M^2
 * in space (2^51.8). */
static CAGE_INLINE int64_t lift(const struct cage_site *base, const struct cage_site *other, const int32_t u[3])
{
    return other->h - base->h - 2 * ((int64_t)base->x * u[0] + (int64_t)base->y * u[1] + (int64_t)base->z * u[2]);
}

static int64_t dot(const int32_t a[3], const int32_t b[3])
{
    return (int64_t)a[0] * b[0] + (int64_t)a[1] * b[1] + (int64_t)a[2] * b[2];
}

/* The entries of b x c, <= 8 M^2. */
static CAGE_INLINE void cross(const int32_t b[3], const int32_t c[3], int64_t out[3])
{
    out[0] = cage_minor(b[1], c[2], b[2], c[1]);
    out[1] = cage_minor(b[2], c[0], b[0], c[2]);
    out[2] = cage_minor(b[0], c[1], b[1], c[0]);
}

/* z_0 + o solves 2 u_i . o = a_i, u_i = z_i - z_0 and a_i its lift; in the plane u_2 = (0, 0, 1) and a_2 = 0 besides. By Cramer's
 * rule o is the sum of a_i times the cofactor vector of u_i, over 2 det: 2^61.2 2^30, two of them, or 2^51.8 2^51, three. */
static CAGE_INLINE void orthocentre(int32_t dim, const struct cage_site *const v[4], struct cage_centre *centre)
{
    int32_t u[3][3] = {{0, 0, 0}, {0, 0, 0}, {0, 0, 1}};
    int64_t a[3] = {0, 0, 0}, cofactor[3][3]; /* < 2^31 in the plane but for the last, det; < 2^51 in space */
    for (int32_t i = 0; i < dim; i++) {
        cage_difference(v[i + 1], v[0], u[i]);
        a[i] = lift(v[0], v[i + 1], u[i]);
    }
    cross(u[1], u[2], cofactor[0]);
    cross(u[2], u[0], cofactor[1]);
    cross(u[0], u[1], cofactor[2]);
    cage_i128 det = cage_i128_of(0); /* < 2^62, 2^78 */
    for (int32_t k = 0; k < 3; k++) {
        cage_i128_add_product(&det, cofactor[0][k], u[0][k]);
        centre->offset[k] = cage_mix(cofactor[0][k], a[0], cofactor[1][k], -a[1], cofactor[2][k], a[2]);
    }
    centre->denominator = cage_i128_add(det, det);
    centre->base = v[0];
}

void cage_orthocentre(int32_t dim, const struct cage_site *const v[4], struct cage_centre *centre)
{
    if (dim == 2)
        orthocentre(2, v, centre);
    else
        orthocentre(3, v, centre);
}

/* Bits to drop so that less than so many are left of each. */
static uint32_t excess(const cage_i128 a[3], cage_i128 b, uint32_t bits)
{
    cage_i128 all = cage_i128_abs(b);
    for (int32_t k = 0; k < 3; k++) {
        cage_i128 size = cage_i128_abs(a[k]);
        all = cage_i128_make(cage_i128_high(all) | cage_i128_high(size), cage_i128_low(all) | cage_i128_low(size));
    }
    uint32_t has = cage_u128_bits(all);
    return has > bits ? has - bits : 0;
}

/* What is left of |a|. */
static uint64_t top(cage_i128 a, uint32_t drop) { return cage_i128_low(cage_i128_shr(cage_i128_abs(a), drop)); }

int32_t cage_norm_compare(const cage_i128 n[3], cage_i128 g)
{
    /* Truncated to t < 2^61: the true value lies in [t, t + 1) 2^drop. The squares and their sum < 2^124. */
    uint32_t drop = excess(n, g, 61);
    cage_i128 least = cage_i128_of(0);
    uint64_t t, slack = 3; /* of three squares: the sum of 2 t + 1 < 6 2^61 + 3 < 2^64 */
    for (int32_t k = 0; k < 3; k++) {
        t = top(n[k], drop);
        least = cage_i128_add(least, cage_u64_mul(t, t));
        slack += 2 * t;
    }
    t = top(g, drop);
    cage_i128 other = cage_u64_mul(t, t);
    if (cage_i128_compare(least, cage_i128_add(other, cage_i128_make(0, 2 * t + 1))) >= 0)
        return 1;
    if (cage_i128_compare(cage_i128_add(least, cage_i128_make(0, slack)), other) <= 0)
        return -1;
    cage_i256 sum = {{0, 0, 0, 0}};
    for (int32_t k = 0; k < 3; k++)
        cage_i256_add_product(&sum, n[k], n[k]);
    cage_i256_add_product(&sum, g, cage_i128_minus(g));
    return cage_i256_sign(&sum);
}

cage_i128 cage_simplex_volume(int32_t dim, const struct cage_site *const v[4])
{
    if (dim == 2)
        return cage_i128_of(cage_cross(v[0], v[1], v[2]));
    int32_t a[3], b[3], c[3];
    int64_t normal[3];
    cage_difference(v[1], v[0], a);
    cage_difference(v[2], v[0], b);
    cage_difference(v[3], v[0], c);
    cross(b, c, normal);
    return cage_mix(normal[0], a[0], normal[1], -a[1], normal[2], a[2]);
}

/* p = |offset / denominator|^2 - r_0^2. */
static int32_t centre_power(const struct cage_centre *centre)
{
    /* < 2^63 2^29 in the plane, 2^80 2^24 in space */
    return cage_norm_compare(centre->offset, cage_i128_scale(centre->denominator, centre->base->r));
}

/* No point in common: squares <= 12 M^2 in space. */
static CAGE_INLINE bool are_apart(const struct cage_site *a, const struct cage_site *b)
{
    int64_t sum = (int64_t)a->r + b->r;
    int32_t u[3];
    cage_difference(a, b, u);
    return dot(u, u) > sum * sum;
}

int32_t cage_simplex_power(int32_t dim, const struct cage_site *const v[4])
{
    for (int32_t i = 0; dim == 3 && i < 3; i++) /* no simplex has less power than an edge of it */
        for (int32_t k = i + 1; k <= 3; k++)
            if (are_apart(v[i], v[k]))
                return 1;
    struct cage_centre centre;
    cage_orthocentre(dim, v, &centre);
    return centre_power(&centre);
}

/* The sign of the sum of big_k * little_k, |little| < 2^54: from the top 62 bits of the big ones, each term then off by less than
 * |little_k|, and if these do not tell, from all. */
static int32_t mixed_sign(const cage_i128 big[3], const int64_t little[3])
{
    uint32_t drop = excess(big, big[0], 62);
    cage_i128 sum = cage_i128_of(0), error = sum;
    for (int32_t k = 0; k < 3; k++) {
        int64_t size = (int64_t)top(big[k], drop);
        cage_i128_add_product(&sum, little[k], cage_i128_negative(big[k]) ? -size : size);
        error = cage_i128_add(error, cage_i128_of(little[k] < 0 ? -little[k] : little[k]));
    }
    if (cage_i128_compare(cage_i128_abs(sum), error) > 0)
        return cage_i128_sign(sum);
    cage_i256 exact = {{0, 0, 0, 0}};
    for (int32_t k = 0; k < 3; k++)
        cage_i256_add_product(&exact, big[k], cage_i128_of(little[k]));
    return cage_i256_sign(&exact);
}

/* normal . (o - face_0), times the denominator: |big| < 2^95 in the plane, 2^107 in space. */
int32_t cage_centre_side(int32_t dim, const struct cage_site *const face[3], const struct cage_centre *centre)
{
    int32_t b[3], c[3] = {0, 0, -1}, to_base[3];
    int64_t normal[3];
    cage_i128 big[3];
    cage_difference(face[1], face[0], b);
    cage_difference(centre->base, face[0], to_base);
    if (dim == 3)
        cage_difference(face[2], face[0], c);
    cross(b, c, normal);
    for (int32_t k = 0; k < 3; k++)
        big[k] = cage_i128_add(centre->offset[k], cage_i128_scale(centre->denominator, to_base[k]));
    return mixed_sign(big, normal);
}

/* The orthocentre of a triangle in space lies at z_0 + (alpha u + beta v) / (2 gram). */
struct triangle {
    int32_t u[3], v[3];       /* edges from z_0, */
    int64_t a, b;             /* and their lifts, < 2^51.8 */
    cage_i128 alpha, beta;    /* a v.v - b u.v, b u.u - a u.v: < 2^105 */
    cage_i128 gram;           /* u.u v.v - (u.v)^2 < 2^104 */
};

static void triangle_centre(const struct cage_site *const facet[3], struct triangle *t)
{
    cage_difference(facet[1], facet[0], t->u);
    cage_difference(facet[2], facet[0], t->v);
    t->a = lift(facet[0], facet[1], t->u);
    t->b = lift(facet[0], facet[2], t->v);
    int64_t uu = dot(t->u, t->u), vv = dot(t->v, t->v), uv = dot(t->u, t->v); /* <= 12 M^2 < 2^51.6 */
    t->alpha = cage_i128_mul(t->a, vv);
    cage_i128_add_product(&t->alpha, t->b, -uv);
    t->beta = cage_i128_mul(t->b, uu);
    cage_i128_add_product(&t->beta, t->a, -uv);
    t->gram = cage_i128_mul(uu, vv);
    cage_i128_add_product(&t->gram, uv, -uv);
}

/* For an edge of length L: p <= 0 iff |r_0 - r_1| <= L <= r_0 + r_1. Squares <= 8 M^2 = 2^61. For a
 * triangle: 4 gram p = a alpha + b beta - 4 gram r_0^2, < 2^159. */
int32_t cage_facet_power(int32_t dim, const struct cage_site *const facet[3])
{
    if (dim == 2) {
        int32_t u[3];
        cage_difference(facet[1], facet[0], u);
        int64_t length = dot(u, u), sum = (int64_t)facet[0]->r + facet[1]->r, gap = (int64_t)facet[0]->r - facet[1]->r;
        if (length > sum * sum || length < gap * gap)
            return 1;
        return length == sum * sum || length == gap * gap ? 0 : -1;
    }
    for (int32_t i = 0; i < 3; i++) /* no facet has less power than an edge of it */
        if (are_apart(facet[i], facet[i == 2 ? 0 : i + 1]))
            return 1;
    struct triangle t;
    triangle_centre(facet, &t);
    const cage_i128 big[3] = {t.alpha, t.beta, t.gram};
    const int64_t little[3] = {t.a, t.b, -4 * (int64_t)facet[0]->r * facet[0]->r}; /* <= 4 M^2 */
    return mixed_sign(big, little);
}

/* |w - o|^2 - r_w^2 - p < 0. With s = w - z_0, c = s.s - r_w^2 + r_0^2: for an edge c u.u - a (s.u) < 0, <= 144 M^4;
 * for a triangle c gram - alpha (s.u) - beta (s.v) < 0, <= 1788 M^6. */
bool cage_facet_attached(int32_t dim, const struct cage_site *const facet[3], const struct cage_site *w)
{
    int32_t s[3];
    cage_difference(w, facet[0], s);
    int64_t c = lift(facet[0], w, s);
    if (dim == 2) {
        int32_t u[3];
        cage_difference(facet[1], facet[0], u);
        int64_t a = lift(facet[0], facet[1], u);
        return cage_i128_sign(cage_i128_sub(cage_i128_mul(c, dot(u, u)), cage_i128_mul(a, dot(s, u)))) < 0;
    }
    struct triangle t;
    triangle_centre(facet, &t);
    const cage_i128 big[3] = {t.gram, t.alpha, t.beta};
    const int64_t little[3] = {c, -dot(s, t.u), -dot(s, t.v)};
    return mixed_sign(big, little) < 0;
}

bool cage_centre_off(int32_t dim, const struct cage_centre *centre, const struct cage_site *ball)
{
    int32_t apart[3];
    cage_i128 n[3] = {cage_i128_of(0), cage_i128_of(0), cage_i128_of(0)};
    cage_difference(ball, centre->base, apart);
    for (int32_t k = 0; k < dim; k++)
        n[k] = cage_i128_sub(centre->offset[k], cage_i128_scale(centre->denominator, apart[k]));
    return cage_norm_compare(n, cage_i128_scale(centre->denominator, ball->r)) > 0;
}

/* Divide all entries (negative ones at least -most) by a power of two, rounding down, so that they are at most 2^bits
 * in magnitude. */
static void round_down(int32_t rows, int64_t *a, int64_t most, uint32_t bits)
{
    for (int32_t i = 0; i < rows * rows; i++)
        most = a[i] > most ? a[i] : most;
    uint32_t used = cage_u64_bits((uint64_t)most), drop = used >= bits ? used - bits + 1 : 0;
    for (int32_t i = 0; i < rows * rows; i++)
        a[i] = a[i] >= 0 ? a[i] >> drop : -(((-a[i] - 1) >> drop) + 1);
}

/* At the point with barycentric coordinates l the powers, weighed by l, add up to sum_{i<j} l_i l_j square_ij - sum_i
 * l_i weight_i: if that is nowhere positive, one of them never is. Times 2, and homogeneous since the l add up to 1:
 * the quadratic form of the matrix a_ii = 2 weight_i, a_ij = weight_i + weight_j - square_ij has to be copositive.
 * (For two balls: square_01 <= (r_0 + r_1)^2.) For three rows, whose 2 x 2 parts are copositive: iff the determinant
 * is not negative or an entry of the adjugate is (K. P. Hadeler, "On copositive matrices", Linear Algebra Appl. 49,
 * 1983). */
bool cage_edges_covered(int32_t count, const int64_t square[3], const int64_t weight[3])
{
    int64_t a[3][3], most = 0; /* < 2^63 */
    bool plain = true;
    for (int32_t i = 0; i < count; i++) {
        if (weight[i] < 0)
            return false;
        a[i][i] = 2 * weight[i];
        most = a[i][i] > most ? a[i][i] : most;
        for (int32_t k = 0; k < i; k++) {
            a[i][k] = a[k][i] = weight[i] + weight[k] - square[count == 2 ? 0 : 3 - i - k];
            plain = plain && a[i][k] >= 0;
            most = -a[i][k] > most ? -a[i][k] : most;
        }
    }
    if (plain)
        return true;
    for (int32_t i = 0; i < count; i++)
        for (int32_t k = 0; k < i; k++)
            if (a[i][k] < 0 && cage_i128_compare(cage_i128_mul(a[i][k], a[i][k]), cage_i128_mul(a[i][i], a[k][k])) > 0)
                return false;
    if (count == 2)
        return true;
    round_down(3, &a[0][0], most, 41); /* minors < 2^83, the determinant < 6 2^123; the 2 x 2 parts may fail by the rounding: */
    cage_i128 det = cage_i128_of(0);
    bool negative = false;
    for (int32_t i = 0; i < 3; i++)
        for (int32_t k = 0; k < 3; k++) {
            int32_t i1 = (i + 1) % 3, i2 = (i + 2) % 3, k1 = (k + 1) % 3, k2 = (k + 2) % 3;
            cage_i128 adjugate = cage_i128_sub(cage_i128_mul(a[i1][k1], a[i2][k2]), cage_i128_mul(a[i1][k2], a[i2][k1]));
            if (i == k && cage_i128_negative(adjugate) && a[i1][i2] < 0)
                return false;
            negative = negative || cage_i128_negative(adjugate);
            if (i == 0)
                det = cage_i128_add(det, cage_i128_scale(adjugate, a[0][k]));
        }
    return negative || !cage_i128_negative(det);
}

/* As above with four rows. Entries are rounded down to 28 bits; if what is left is positive semidefinite (leading
 * minors), the matrix itself, larger in every entry, is copositive. Minors of two rows < 2^57, of three < 2^87, the
 * determinant < 6 2^114. */
bool cage_tetrahedron_covered(int64_t square[4][4], const int64_t weight[4])
{
    int64_t a[4][4], most = 0;
    for (int32_t i = 0; i < 4; i++) {
        if (weight[i] <= 0)
            return false;
        a[i][i] = 2 * weight[i];
        most = a[i][i] > most ? a[i][i] : most;
        for (int32_t k = 0; k < i; k++) {
            a[i][k] = weight[i] + weight[k] - square[i][k];
            most = a[i][k] > most ? a[i][k] : -a[i][k] > most ? -a[i][k] : most;
        }
    }
    for (int32_t i = 0; i < 4; i++)
        for (int32_t k = 0; k < i; k++)
            a[k][i] = a[i][k];
    round_down(4, &a[0][0], most, 28);
    int64_t upper[4][4], lower[4][4]; /* minors of rows 0, 1 and of rows 2, 3, by their columns */
    for (int32_t i = 0; i < 4; i++)
        for (int32_t k = i + 1; k < 4; k++) {
            upper[i][k] = a[0][i] * a[1][k] - a[0][k] * a[1][i];
            lower[i][k] = a[2][i] * a[3][k] - a[2][k] * a[3][i];
        }
    if (a[0][0] <= 0 || upper[0][1] <= 0 ||
        cage_i128_sign(cage_mix(upper[1][2], a[2][0], upper[0][2], a[2][1], upper[0][1], a[2][2])) <= 0)
        return false;
    cage_i128 det = cage_mix(upper[0][1], lower[2][3], upper[0][2], lower[1][3], upper[0][3], lower[1][2]);
    det = cage_i128_add(det, cage_mix(upper[1][2], lower[0][3], upper[1][3], lower[0][2], upper[2][3], lower[0][1]));
    return !cage_i128_negative(det);
}
