/* box: around a component.
 *
 * Points of the component in one of its simplices are nearer to the simplex' orthocentre than the root of that one's power:
 * the powers of its vertices, weighed by barycentric coordinates, add up to that power less the squared distance, and at
 * a free point all of them are positive. */
#include "box.h"
#include "grid.h"

static void widen_box(struct cage_box *box, int32_t dim, const int32_t at[3], int64_t by)
{
    for (int32_t k = 0; k < dim; k++) {
        box->low[k] = at[k] - by < box->low[k] ? at[k] - by : box->low[k];
        box->high[k] = at[k] + by > box->high[k] ? at[k] + by : box->high[k];
    }
}

bool cage_box_make(const struct cage_slice *slice, const int32_t *simplex, int32_t simplices, struct cage_box *box)
{
    const struct cage_triangulation *t = &slice->t;
    for (int32_t k = 0; k < 3; k++) {
        box->low[k] = k < t->dim ? INT64_MAX : 0; /* the plane is flat */
        box->high[k] = k < t->dim ? INT64_MIN : 0;
    }
    for (int32_t i = 0; i < simplices; i++) {
        const struct cage_site *v[4];
        struct cage_centre centre;
        int32_t at[3];
        cage_simplex_sites(t, simplex[i], v);
        cage_orthocentre(t->dim, v, &centre);
        if (!cage_centre_point(t->dim, &centre, at))
            return false;
        const int32_t from[3] = {at[0] - v[0]->x, at[1] - v[0]->y, at[2] - v[0]->z}; /* < 2^29 */
        int64_t away = (int64_t)cage_length(from) + 1, square = away * away - (int64_t)v[0]->r * v[0]->r; /* at: < 1 off */
        widen_box(box, t->dim, at, square > 0 ? (int64_t)cage_u128_root(cage_i128_of(square)) + 2 : 2);
    }
    return simplices > 0;
}

bool cage_box_is_held(const struct cage_box *box, const struct cage_site *ball)
{
    const int64_t at[3] = {ball->x, ball->y, ball->z};
    int64_t square = 0; /* differences < 2^30 + 2^28 in the plane, where the third is 0, and < 2^27 in space */
    for (int32_t k = 0; k < 3; k++) {
        int64_t a = at[k] - box->low[k], b = box->high[k] - at[k], far = a > b ? a : b;
        square += far * far;
    }
    return square <= (int64_t)ball->r * ball->r;
}

bool cage_box_is_apart(const struct cage_box *box, const struct cage_site *ball)
{
    const int64_t at[3] = {ball->x, ball->y, ball->z};
    int64_t square = 0; /* as above */
    for (int32_t k = 0; k < 3; k++) {
        int64_t below = box->low[k] - at[k], above = at[k] - box->high[k], near = below > above ? below : above;
        square += near > 0 ? near * near : 0;
    }
    return square > (int64_t)ball->r * ball->r;
}
