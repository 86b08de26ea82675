/* piece: a convex set that holds those points of a component that lie in one of its simplices.
 *
 * These are nearer to the orthocentre of the simplex than the root of its power: the powers of its vertices, weighed by barycentric
 * coordinates, add up to that power less the squared distance, and at a free point all of them are positive. So two
 * components are apart if no piece of one meets one of the other; to see that, bounds along a few directions do, or along
 * normals of facets, rounded: any direction is as good, if both are measured along the same. (Two components that are not apart
 * share an open set, so pieces that merely touch do not count.) */
#include "piece.h"
#include "grid.h"

/* |n|^2 of the directions. */
static const int8_t SQUARE[CAGE_DIRECTIONS] = {1, 1, 2, 2, 1, 2, 2, 2, 2, 3, 3, 3, 3};

static int32_t directions(int32_t dim) { return dim == 2 ? CAGE_DIRECTIONS_2D : CAGE_DIRECTIONS; }

/* Along each direction, the point's coordinate: |x|, |y| <= 2^29 in the plane, all <= 2^24 in space. */
static void read_along(int32_t x, int32_t y, int32_t z, int32_t along[CAGE_DIRECTIONS])
{
    const int32_t value[CAGE_DIRECTIONS] = {x, y, x + y, x - y, z, x + z, x - z, y + z, y - z,
                                            x + y + z, -x + y + z, x - y + z, x + y - z};
    for (int32_t i = 0; i < CAGE_DIRECTIONS; i++)
        along[i] = value[i];
}

static const struct cage_site *vertex_of(const struct cage_triangulation *t, int32_t s, int32_t i)
{
    return &t->site[t->simplex[s].v[i]];
}

/* The power of the ball's centre x to a vertex z of its simplex; *from: how far it is from there, at most. Differences < 2^29. */
static int64_t power_of(const struct cage_triangulation *t, const struct cage_orthoball *ball, int64_t *from)
{
    const struct cage_site *z = vertex_of(t, ball->simplex, 0);
    const int32_t by[3] = {ball->at[0] - z->x, ball->at[1] - z->y, ball->at[2] - z->z};
    int64_t power = -(int64_t)z->r * z->r;
    *from = 0;
    for (int32_t k = 0; k < 3; k++) {
        *from += by[k] < 0 ? -by[k] : by[k];
        power += (int64_t)by[k] * by[k];
    }
    return power;
}

/* The orthocentre is less than 1 from x, so its power is at most (|x - z| + 1)^2 - r^2. */
void cage_orthoball_of(const struct cage_triangulation *t, int32_t s, struct cage_orthoball *out)
{
    const struct cage_site *v[4];
    struct cage_centre centre;
    int64_t from, power;
    out->simplex = s;
    out->radius = -1;
    if (cage_simplex_outer(t, s))
        return;
    cage_simplex_sites(t, s, v);
    cage_orthocentre(t->dim, v, &centre);
    if (!cage_centre_point(t->dim, &centre, out->at))
        return;
    power = power_of(t, out, &from);
    power += 2 * from + 1;
    out->radius = (power > 0 ? (int32_t)cage_u128_root(cage_i128_of(power)) : 0) + 2; /* < 2^30 */
}

/* The power p of the orthocentre is at least (|x - z| - 1)^2 - r^2. Each ball has a power of p or more there, so it ends more than 1
 * from there, and does not hold x, if p > 2 R + 1 for its radius R. */
bool cage_orthoball_is_off(const struct cage_triangulation *t, const struct cage_orthoball *ball, int32_t radius)
{
    int64_t from, power = power_of(t, ball, &from);
    return power - 2 * from > 2 * (int64_t)radius + 1;
}

/* ---- along fixed directions ------------------------------------------------------------------------------ */

void cage_bounds_none(struct cage_bounds *bounds)
{
    for (int32_t i = 0; i < CAGE_DIRECTIONS; i++) {
        bounds->low[i] = INT32_MAX;
        bounds->high[i] = INT32_MIN;
    }
}

void cage_bounds_add(int32_t dim, struct cage_bounds *bounds, const struct cage_bounds *other)
{
    for (int32_t i = 0; i < directions(dim); i++) {
        bounds->low[i] = other->low[i] < bounds->low[i] ? other->low[i] : bounds->low[i];
        bounds->high[i] = other->high[i] > bounds->high[i] ? other->high[i] : bounds->high[i];
    }
}

void cage_bounds_widen(int32_t dim, struct cage_bounds *bounds, int32_t by)
{
    for (int32_t i = 0; i < directions(dim); i++) {
        bounds->low[i] -= by;
        bounds->high[i] += by;
    }
}

void cage_bounds_of(const struct cage_triangulation *t, const struct cage_orthoball *ball, struct cage_bounds *out)
{
    int32_t along[CAGE_DIRECTIONS];
    cage_bounds_none(out);
    for (int32_t i = 0; i <= t->dim; i++) {
        const struct cage_site *v = vertex_of(t, ball->simplex, i);
        read_along(v->x, v->y, v->z, along);
        for (int32_t k = 0; k < CAGE_DIRECTIONS; k++) {
            out->low[k] = along[k] < out->low[k] ? along[k] : out->low[k];
            out->high[k] = along[k] > out->high[k] ? along[k] : out->high[k];
        }
    }
    if (ball->radius < 0)
        return;
    /* by[n]: at least the root of n times the radius, 46341 > 2^15 root(2), 56756 > 2^15 root(3); < 2^46 */
    int64_t radius = ball->radius, by[4] = {0, radius, (radius * 46341 >> 15) + 1, (radius * 56756 >> 15) + 1};
    read_along(ball->at[0], ball->at[1], ball->at[2], along);
    for (int32_t i = 0; i < directions(t->dim); i++) {
        int64_t low = along[i] - by[SQUARE[i]], high = along[i] + by[SQUARE[i]];
        out->low[i] = low > out->low[i] ? (int32_t)low : out->low[i];
        out->high[i] = high < out->high[i] ? (int32_t)high : out->high[i];
    }
}

uint32_t cage_bounds_code(int32_t dim, const struct cage_bounds *bounds, const struct cage_site *site)
{
    int32_t along[CAGE_DIRECTIONS];
    uint32_t code = 0;
    read_along(site->x, site->y, site->z, along);
    for (int32_t i = 0; i < directions(dim); i++)
        code = code << 2 | (along[i] <= bounds->low[i] ? 2U : 0U) | (along[i] >= bounds->high[i] ? 1U : 0U);
    return code << 1 | CAGE_CODE_KNOWN; /* 27 bits */
}

bool cage_bounds_meet(int32_t dim, const struct cage_bounds *a, const struct cage_bounds *b)
{
    for (int32_t i = 0; i < directions(dim); i++)
        if (a->high[i] <= b->low[i] || b->high[i] <= a->low[i])
            return false;
    return true;
}

/* ---- along normals --------------------------------------------------------------------------------------- */

void cage_piece_make(const struct cage_triangulation *t, const struct cage_orthoball *ball, struct cage_piece *out)
{
    out->t = t;
    out->ball = *ball;
    out->first = 0;
    out->faces = 0;
    cage_bounds_of(t, ball, &out->bounds);
}

/* A normal of facet i of the simplex, to within what its entries of at most 28 bits can say: not 0. */
static void find_normal(const struct cage_triangulation *t, int32_t s, int32_t i, int32_t normal[3])
{
    const struct cage_site *face[3];
    int32_t e[3], f[3] = {0, 0, 1}; /* in the plane e x (0, 0, 1) */
    int64_t n[3], most = 0;
    cage_facet_sites(t, s, i, face);
    cage_difference(face[1], face[0], e); /* entries <= 2M */
    if (t->dim == 3)
        cage_difference(face[2], face[0], f);
    for (int32_t k = 0; k < 3; k++) { /* <= 8 M^2 = 2^51 in space, 2M = 2^30 in the plane */
        n[k] = cage_minor(e[(k + 1) % 3], f[(k + 2) % 3], e[(k + 2) % 3], f[(k + 1) % 3]);
        most = n[k] > most ? n[k] : most;
        most = -n[k] > most ? -n[k] : most;
    }
    int32_t shift = 0;
    while (most >> shift >= 1 << 28)
        shift++;
    for (int32_t k = 0; k < 3; k++)
        normal[k] = n[k] < 0 ? -(int32_t)(-n[k] >> shift) : (int32_t)(n[k] >> shift);
}

/* Coordinates <= 2^29 in the plane, where the third is 0, 2^24 in space: < 2^58. */
static int64_t along_normal(const int32_t normal[3], int32_t x, int32_t y, int32_t z)
{
    return (int64_t)normal[0] * x + (int64_t)normal[1] * y + (int64_t)normal[2] * z;
}

/* The piece's bounds along the normal of a face, its own or another's. */
static void bound_along(const struct cage_piece *piece, const struct cage_face *face, int64_t *low, int64_t *high)
{
    *low = INT64_MAX;
    *high = INT64_MIN;
    for (int32_t i = 0; i <= piece->t->dim; i++) {
        const struct cage_site *v = vertex_of(piece->t, piece->ball.simplex, i);
        int64_t at = along_normal(face->normal, v->x, v->y, v->z);
        *low = at < *low ? at : *low;
        *high = at > *high ? at : *high;
    }
    if (piece->ball.radius < 0)
        return;
    const int32_t *o = piece->ball.at;
    int64_t at = along_normal(face->normal, o[0], o[1], o[2]), by = (int64_t)face->length * piece->ball.radius; /* < 2^59 */
    *low = at - by > *low ? at - by : *low;
    *high = at + by < *high ? at + by : *high;
}

static void find_faces(struct cage_piece *piece)
{
    for (; piece->faces <= piece->t->dim; piece->faces++) {
        struct cage_face *face = &piece->face[piece->faces];
        find_normal(piece->t, piece->ball.simplex, piece->faces, face->normal);
        face->length = cage_length(face->normal); /* < 2^29 */
        bound_along(piece, face, &face->low, &face->high);
    }
}

static bool is_beyond_a_face(const struct cage_piece *a, const struct cage_piece *b)
{
    bool beyond = false;
    for (int32_t i = 0; i < a->faces && !beyond; i++) {
        int64_t low, high;
        bound_along(b, &a->face[i], &low, &high);
        beyond = high <= a->face[i].low || a->face[i].high <= low;
    }
    return beyond;
}

bool cage_piece_is_apart(struct cage_piece *a, struct cage_piece *b)
{
    find_faces(a);
    find_faces(b);
    return is_beyond_a_face(a, b) || is_beyond_a_face(b, a);
}
