/* predicate: the only file that answers a geometric question: formula, bound, tie rule. */
#include "predicate.h"

const int32_t CAGE_FACE_2D[3][2] = {{1, 2}, {2, 0}, {0, 1}};
const int32_t CAGE_FACE_3D[4][3] = {{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}};

/* u.u - r_1^2 + r_0^2 for u = z_1 - z_0, from the heights, right for sentinels too: <= 9 M^2 in the plane (2^61.2), 13 M^2
 * in space (2^51.8). */
static int64_t lift(const struct cage_site *base, const struct cage_site *other, const int64_t u[3])
{
    return other->h - base->h - 2 * (base->x * u[0] + base->y * u[1] + base->z * u[2]);
}

static int64_t dot(const int64_t a[3], const int64_t b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* The entries of b x c, <= 8 M^2. */
static void cross(const int64_t b[3], const int64_t c[3], int64_t out[3])
{
    out[0] = b[1] * c[2] - b[2] * c[1];
    out[1] = b[2] * c[0] - b[0] * c[2];
    out[2] = b[0] * c[1] - b[1] * c[0];
}

/* Solve 2 u_i . o = lift_i by Cramer's rule: o = sum of lift_i times the cofactor vector of u_i, over 2 det. */
void cage_orthocentre(int32_t dim, const struct cage_site *const v[4], struct cage_centre *centre)
{
    int64_t u[3][3] = {{0, 0, 0}, {0, 0, 0}, {0, 0, 1}}; /* in the plane the third equation says z = 0 */
    int64_t a[3] = {0, 0, 0}, cofactor[3][3];
    for (int32_t i = 0; i < dim; i++) {
        cage_difference(v[i + 1], v[0], u[i]);
        a[i] = lift(v[0], v[i + 1], u[i]);
    }
    cross(u[1], u[2], cofactor[0]);
    cross(u[2], u[0], cofactor[1]);
    cross(u[0], u[1], cofactor[2]);
    for (int32_t k = 0; k < 3; k++) {
        cage_i128 sum = cage_i128_mul(cofactor[0][k], a[0]); /* 2^31 2^61.2, or 2^51 2^51.8, three of them */
        sum = cage_i128_add(sum, cage_i128_mul(cofactor[1][k], a[1]));
        centre->offset[k] = cage_i128_add(sum, cage_i128_mul(cofactor[2][k], a[2]));
    }
    cage_i128 det = dim == 2 ? cage_i128_of(cofactor[2][2]) : cage_triple(u[0], u[1], u[2]);
    centre->denominator = cage_i128_add(det, det);
    centre->base = v[0];
}

int32_t cage_norm_compare(const cage_i128 n[3], cage_i128 g)
{
    cage_i128 all = g, size[3];
    for (int32_t k = 0; k < 3; k++) {
        size[k] = cage_i128_abs(n[k]);
        all = cage_i128_make(cage_i128_high(all) | cage_i128_high(size[k]), cage_i128_low(all) | cage_i128_low(size[k]));
    }
    uint32_t bits = cage_u128_bits(all), shift = bits > 61 ? bits - 61 : 0;
    /* Truncated to t < 2^61: the true value lies in [t, t + 1) 2^shift. Sums of three squares < 2^124. */
    cage_i128 least = cage_i128_of(0), most = least;
    for (int32_t k = 0; k < 3; k++) {
        uint64_t t = cage_i128_low(cage_i128_shr(size[k], shift));
        least = cage_i128_add(least, cage_u64_mul(t, t));
        most = cage_i128_add(most, cage_u64_mul(t + 1, t + 1));
    }
    uint64_t t = cage_i128_low(cage_i128_shr(g, shift));
    if (cage_i128_compare(least, cage_u64_mul(t + 1, t + 1)) >= 0)
        return 1;
    if (cage_i128_compare(most, cage_u64_mul(t, t)) <= 0)
        return -1;
    cage_i256 sum = cage_i256_mul(size[0], size[0]);
    sum = cage_i256_add(sum, cage_i256_mul(size[1], size[1]));
    sum = cage_i256_add(sum, cage_i256_mul(size[2], size[2]));
    return cage_i256_sign(cage_i256_sub(sum, cage_i256_mul(g, g)));
}

cage_i128 cage_simplex_volume(int32_t dim, const struct cage_site *const v[4])
{
    if (dim == 2)
        return cage_i128_of(cage_cross(v[0], v[1], v[2]));
    int64_t a[3], b[3], c[3];
    cage_difference(v[1], v[0], a);
    cage_difference(v[2], v[0], b);
    cage_difference(v[3], v[0], c);
    return cage_triple(a, b, c);
}

/* p = |offset / denominator|^2 - r_0^2. */
int32_t cage_centre_power(const struct cage_centre *centre)
{
    /* < 2^63 2^29 in the plane, 2^80 2^24 in space */
    return cage_norm_compare(centre->offset, cage_i128_scale(centre->denominator, centre->base->r));
}

int32_t cage_centre_side(int32_t dim, const struct cage_site *const face[3], const struct cage_centre *centre)
{
    int64_t b[3], c[3] = {0, 0, 1}, to_base[3], normal[3];
    cage_difference(face[1], face[0], b);
    cage_difference(centre->base, face[0], to_base);
    if (dim == 3)
        cage_difference(face[2], face[0], c);
    if (dim == 2) {
        /* (c x b) . (o - face_0), times the denominator: 2^63 2^61 + 2 2^30 2^93 < 2^126 */
        cage_i128 sum = cage_i128_scale(centre->denominator, b[0] * to_base[1] - b[1] * to_base[0]);
        sum = cage_i128_add(sum, cage_i128_scale(centre->offset[1], b[0]));
        return cage_i128_sign(cage_i128_sub(sum, cage_i128_scale(centre->offset[0], b[1])));
    }
    cross(b, c, normal);
    cage_i256 sum = cage_i256_mul(centre->denominator, cage_triple(to_base, b, c));
    for (int32_t k = 0; k < 3; k++)
        sum = cage_i256_add(sum, cage_i256_mul(centre->offset[k], cage_i128_of(normal[k])));
    return cage_i256_sign(sum);
}

/* The orthocentre of a triangle in space lies at z_0 + (alpha u + beta v) / (2 gram). */
struct triangle {
    int64_t u[3], v[3], a, b; /* edges from z_0 and their lifts, < 2^51.8 */
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
    t->alpha = cage_i128_sub(cage_i128_mul(t->a, vv), cage_i128_mul(t->b, uv));
    t->beta = cage_i128_sub(cage_i128_mul(t->b, uu), cage_i128_mul(t->a, uv));
    t->gram = cage_i128_sub(cage_i128_mul(uu, vv), cage_i128_mul(uv, uv));
}

/* For an edge of length L: p <= 0 iff |r_0 - r_1| <= L <= r_0 + r_1. Squares <= 8 M^2 = 2^61. For a
 * triangle: 4 gram p = a alpha + b beta - 4 gram r_0^2, < 2^159. */
int32_t cage_facet_power(int32_t dim, const struct cage_site *const facet[3])
{
    if (dim == 2) {
        int64_t u[3];
        cage_difference(facet[1], facet[0], u);
        int64_t length = dot(u, u), sum = (int64_t)facet[0]->r + facet[1]->r, gap = (int64_t)facet[0]->r - facet[1]->r;
        if (length > sum * sum || length < gap * gap)
            return 1;
        return length == sum * sum || length == gap * gap ? 0 : -1;
    }
    struct triangle t;
    triangle_centre(facet, &t);
    cage_i256 power = cage_i256_mul(t.alpha, cage_i128_of(t.a));
    power = cage_i256_add(power, cage_i256_mul(t.beta, cage_i128_of(t.b)));
    cage_i128 square = cage_i128_of(4 * (int64_t)facet[0]->r * facet[0]->r); /* <= 4 M^2 */
    return cage_i256_sign(cage_i256_sub(power, cage_i256_mul(t.gram, square)));
}

/* |w - o|^2 - r_w^2 - p < 0. With s = w - z_0, c = s.s - r_w^2 + r_0^2: for an edge c u.u - a (s.u) < 0, <= 144 M^4;
 * for a triangle c gram - alpha (s.u) - beta (s.v) < 0, <= 1788 M^6. */
bool cage_facet_attached(int32_t dim, const struct cage_site *const facet[3], const struct cage_site *w)
{
    int64_t s[3];
    cage_difference(w, facet[0], s);
    int64_t c = lift(facet[0], w, s);
    if (dim == 2) {
        int64_t u[3];
        cage_difference(facet[1], facet[0], u);
        int64_t a = lift(facet[0], facet[1], u);
        return cage_i128_sign(cage_i128_sub(cage_i128_mul(c, dot(u, u)), cage_i128_mul(a, dot(s, u)))) < 0;
    }
    struct triangle t;
    triangle_centre(facet, &t);
    cage_i256 value = cage_i256_mul(t.gram, cage_i128_of(c));
    value = cage_i256_sub(value, cage_i256_mul(t.alpha, cage_i128_of(dot(s, t.u))));
    return cage_i256_sign(cage_i256_sub(value, cage_i256_mul(t.beta, cage_i128_of(dot(s, t.v))))) < 0;
}

/* By the simplex lemma (weigh the powers by barycentric coordinates) p <= 0 suffices; in the plane an edge is covered
 * by its two discs exactly when L <= r_0 + r_1. */
bool cage_facet_covered(int32_t dim, const struct cage_site *const facet[3])
{
    if (dim == 2) {
        int64_t u[3];
        cage_difference(facet[1], facet[0], u);
        int64_t sum = (int64_t)facet[0]->r + facet[1]->r;
        return dot(u, u) <= sum * sum;
    }
    return cage_facet_power(dim, facet) <= 0;
}
