/* predicate: the only file that answers a geometric question: formula, bound, tie rule.
 *
 * M = 2^29 in the plane and 2^24 in space bounds |coordinate| and radius of every site (sentinels sit at
 * +-M), and h = |z|^2 - r^2. Bounds written as powers of M are on the value; those written as powers
 * of 2 are on the expression beside them. Wrapping 128-bit terms may exceed 2^127 on the way to a
 * value that does not. */
#ifndef CAGE_PREDICATE_H
#define CAGE_PREDICATE_H

#include "wide.h"

/* A ball in the triangulation. |h| <= 2 M^2 + 1 in the plane, 3 M^2 + 1 in space: 2^59.1, 2^49.6. */
struct cage_site {
    int64_t h;
    int32_t x, y, z, r;
};

/* CAGE_FACE[i] lists the other vertices of a simplex so that (them, then v_i) is an even permutation: v_i
 * lies on the positive side of its face in a positive simplex. */
extern const int32_t CAGE_FACE_2D[3][2];
extern const int32_t CAGE_FACE_3D[4][3];

/* a b - c d: entries <= 2M, value <= 8 M^2. */
static CAGE_INLINE int64_t cage_minor(int32_t a, int32_t b, int32_t c, int32_t d) { return (int64_t)a * b - (int64_t)c * d; }

/* (a - o) x (b - o) in the plane: entries of the differences <= 2M, value <= 8 M^2 = 2^61. */
static CAGE_INLINE int64_t cage_cross(const struct cage_site *o, const struct cage_site *a,
                                      const struct cage_site *b)
{
    return cage_minor(a->x - o->x, b->y - o->y, a->y - o->y, b->x - o->x);
}

/* a.(b x c) for vectors with entries <= 2M: minors <= 8 M^2 = 2^51, value <= 48 M^3 < 2^78. */
static CAGE_INLINE cage_i128 cage_triple(const int32_t a[3], const int32_t b[3], const int32_t c[3])
{
    cage_i128 sum = cage_i128_mul(cage_minor(b[1], c[2], b[2], c[1]), a[0]);
    cage_i128_add_product(&sum, cage_minor(b[2], c[0], b[0], c[2]), a[1]);
    cage_i128_add_product(&sum, cage_minor(b[0], c[1], b[1], c[0]), a[2]);
    return sum;
}

/* m_1 z_1 - m_2 z_2 + m_3 z_3: a 3 x 3 determinant from its minors */
CAGE_SHARED cage_i128 cage_mix(int64_t m1, int64_t z1, int64_t m2, int64_t z2, int64_t m3, int64_t z3)
{
    cage_i128 sum = cage_i128_mul(m1, z1);
    cage_i128_add_product(&sum, m2, -z2);
    cage_i128_add_product(&sum, m3, z3);
    return sum;
}

/* Entries <= 2M. */
CAGE_SHARED void cage_difference(const struct cage_site *a, const struct cage_site *b, int32_t out[3])
{
    out[0] = a->x - b->x;
    out[1] = a->y - b->y;
    out[2] = a->z - b->z;
}

/* On which side of the face opposite vertex i of the simplex lies p? 1: with vertex i, 0: on it, -1: beyond.
 * face: the vertices CAGE_FACE_..[i] of a positive simplex. */
static CAGE_INLINE int32_t cage_side(int32_t dim, const struct cage_site *const face[3], const struct cage_site *p)
{
    if (dim == 2) {
        int64_t cross = cage_cross(face[0], face[1], p);
        return (cross > 0) - (cross < 0);
    }
    int32_t b[3], c[3], x[3];
    cage_difference(face[1], face[0], b);
    cage_difference(face[2], face[0], c);
    cage_difference(p, face[0], x);
    return cage_i128_sign(cage_triple(x, b, c));
}

/* The same, from the differences of the face's vertices and p (in the plane of two): translated by p, the determinant with p in
 * the first row is less the one of the vertices. */
static CAGE_INLINE int32_t cage_side_from(int32_t dim, const int32_t a[3], const int32_t b[3], const int32_t c[3])
{
    if (dim == 2) {
        int64_t cross = cage_minor(a[0], b[1], a[1], b[0]);
        return (cross > 0) - (cross < 0);
    }
    return -cage_i128_sign(cage_triple(a, b, c));
}

/* The power test: is p closer than orthogonal to the orthosphere of the positive simplex v? The sign of a determinant of
 * degree 4 in the plane (<= 24 M^4 < 2^121) and 5 in space (<= 96 M^5 < 2^127), rows taken relative to p.
 * Tie rule: sites are inserted in the order of their indices and a later site is infinitesimally weaker
 * (h_i + e_i with e_0 << e_1 << ...). p is the latest of all, so e_p decides every tie, and its cofactor
 * is the orientation of v, positive: a tie is no conflict. */
static CAGE_INLINE bool cage_conflict(int32_t dim, const struct cage_site *const v[4], const struct cage_site *p)
{
    int32_t a[4][3];
    int64_t h[4]; /* <= 4 M^2 + 2 < 2^61 */
    for (int32_t i = 0; i <= dim; i++) {
        cage_difference(v[i], p, a[i]);
        h[i] = v[i]->h - p->h;
    }
    if (dim == 2) {
        cage_i128 det = cage_i128_mul(cage_minor(a[1][0], a[2][1], a[1][1], a[2][0]), h[0]);
        cage_i128_add_product(&det, cage_minor(a[2][0], a[0][1], a[2][1], a[0][0]), h[1]);
        cage_i128_add_product(&det, cage_minor(a[0][0], a[1][1], a[0][1], a[1][0]), h[2]);
        return cage_i128_positive(det);
    }
    /* Minors of x and y (<= 8 M^2 = 2^51), then of x, y and z (< 2^78), then all of it. */
    int64_t m01 = cage_minor(a[0][0], a[1][1], a[0][1], a[1][0]), m02 = cage_minor(a[0][0], a[2][1], a[0][1], a[2][0]);
    int64_t m03 = cage_minor(a[0][0], a[3][1], a[0][1], a[3][0]), m12 = cage_minor(a[1][0], a[2][1], a[1][1], a[2][0]);
    int64_t m13 = cage_minor(a[1][0], a[3][1], a[1][1], a[3][0]), m23 = cage_minor(a[2][0], a[3][1], a[2][1], a[3][0]);
    cage_i128 det = cage_i128_scale(cage_mix(m23, a[1][2], m13, a[2][2], m12, a[3][2]), h[0]);
    det = cage_i128_sub(det, cage_i128_scale(cage_mix(m23, a[0][2], m03, a[2][2], m02, a[3][2]), h[1]));
    det = cage_i128_add(det, cage_i128_scale(cage_mix(m13, a[0][2], m03, a[1][2], m01, a[3][2]), h[2]));
    det = cage_i128_sub(det, cage_i128_scale(cage_mix(m12, a[0][2], m02, a[1][2], m01, a[2][2]), h[3]));
    return cage_i128_positive(det);
}

/* The power of the grid point p to the site, |p - z|^2 - r^2: within 8 M^2 in the plane (2^61), 12 M^2 in space. */
static CAGE_INLINE int64_t cage_power(const struct cage_site *site, const int32_t p[3])
{
    int64_t dx = (int64_t)p[0] - site->x, dy = (int64_t)p[1] - site->y, dz = (int64_t)p[2] - site->z;
    return dx * dx + dy * dy + dz * dz - (int64_t)site->r * site->r;
}

/* The sign of |n|^2 - g^2, g >= 0, every magnitude < 2^126: top bits first, all bits when they do not decide. */
int32_t cage_norm_compare(const cage_i128 n[3], cage_i128 g);

/* The orthocentre of a simplex, z_0 + offset / denominator: a rational point. Plane: |offset| < 2^93,
 * denominator < 2^63; space: 2^106, 2^80. */
struct cage_centre {
    cage_i128 offset[3];
    cage_i128 denominator; /* twice the orientation determinant, positive */
    const struct cage_site *base;
};

void cage_orthocentre(int32_t dim, const struct cage_site *const v[4], struct cage_centre *centre);

/* The sign of p, the power of its orthocentre: is the positive simplex free? Degree 6 (plane) or 8 (space). No sentinels. */
int32_t cage_simplex_power(int32_t dim, const struct cage_site *const v[4]);

/* Is the orthocentre off the closed ball? Components of the distance times the denominator: < 2^95 in the plane,
 * 2^108 in space. */
bool cage_centre_off(int32_t dim, const struct cage_centre *centre, const struct cage_site *ball);

/* The orientation determinant of a positive simplex: twice (plane) or 6 times (space) its volume. */
cage_i128 cage_simplex_volume(int32_t dim, const struct cage_site *const v[4]);

/* As cage_side, for an orthocentre: degree 4 (plane, <= 56 M^4) or 6 (space, <= 768 M^6). */
int32_t cage_centre_side(int32_t dim, const struct cage_site *const face[3], const struct cage_centre *centre);

/* The sign of the power of a facet's own orthocentre, in the facet's plane: degree 4 (plane) or 6 (space). */
int32_t cage_facet_power(int32_t dim, const struct cage_site *const facet[3]);

/* Is w closer than orthogonal to the smallest orthosphere of the facet? A tie is not closer. */
bool cage_facet_attached(int32_t dim, const struct cage_site *const facet[3], const struct cage_site *w);

/* Is every edge (count 2) or triangle (3) with squared edges up to these and weights (squared radii) of at least
 * those proved to lie in the union of its own closed balls? No proof is not a disproof, but nearly. square[i]: of the
 * edge opposite vertex i (count 2: square[0]), at most 2^62; weight: at most 2^60 in magnitude, negative for no ball. */
bool cage_edges_covered(int32_t count, const int64_t square[3], const int64_t weight[3]);

/* The same for a tetrahedron: square[i][k] of the edge between vertices i and k. */
bool cage_tetrahedron_covered(int64_t square[4][4], const int64_t weight[4]);

#endif
