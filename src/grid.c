/* grid: the only file that rounds: rotations, centres, radii inward or outward. */
#include "grid.h"
#include "cage.h"

enum { MATRIX_BITS = 62, TURN_BITS = 31 };

int64_t cage_rotation_norm(const int32_t q[4])
{
    int64_t norm = 0;
    for (int32_t i = 0; i < 4; i++)
        norm += (int64_t)q[i] * q[i];
    return norm;
}

/* With v the vector part: w w - |v|^2 on the diagonal, 2 w times the cross product with v beside it, and 2 v v^T on all of it. No
 * sum on the way exceeds |q|^2. */
void cage_rotation_row(const int32_t q[4], int32_t i, int64_t row[3])
{
    int32_t j = (i + 1) % 3, k = (i + 2) % 3;
    int64_t w = q[0], a = q[i + 1], b = q[j + 1], c = q[k + 1];
    row[i] = w * w + a * a - b * b - c * c;
    row[j] = 2 * (a * b - w * c);
    row[k] = 2 * (a * c + w * b);
}

void cage_rotation_of(const int32_t q[4], struct cage_rotation *rotation)
{
    const cage_i128 norm = cage_i128_of(cage_rotation_norm(q)), one = cage_i128_of((int64_t)1 << MATRIX_BITS);
    for (int32_t i = 0; i < 3; i++) { /* |row| <= norm, so the shifted numerator is below 2^124 */
        int64_t row[3];
        cage_rotation_row(q, i, row);
        for (int32_t k = 0; k < 3; k++)
            rotation->m[i][k] = cage_i128_nearest(cage_i128_scale(one, row[k]), norm, (int64_t)1 << MATRIX_BITS);
    }
}

void cage_rotate(const struct cage_rotation *rotation, const int32_t y[3], int32_t out[3])
{
    /* Entries are off by 2^-63 at most: times 3 2^29, less than 2^-31. The sum is below 2^93. */
    for (int32_t i = 0; i < 3; i++) {
        cage_i128 sum = cage_i128_of((int64_t)1 << (MATRIX_BITS - 1));
        for (int32_t k = 0; k < 3; k++)
            cage_i128_add_product(&sum, rotation->m[i][k], y[k]);
        out[i] = (int32_t)(int64_t)cage_i128_low(cage_i128_shr(sum, MATRIX_BITS)); /* floor: the low word of a shift is that of
                                                                                   the arithmetic shift */
    }
}

/* a times a power of two, rounded down to 31 bits, where `most` has so many. */
static int64_t scaled(int64_t a, int64_t most)
{
    const uint64_t lifted = (uint64_t)1 << 63;
    uint32_t bits = cage_u64_bits((uint64_t)most);
    if (bits <= 31)
        return a * ((int64_t)1 << (31 - bits));
    return (int64_t)(((uint64_t)a ^ lifted) >> (bits - 31)) - (int64_t)(lifted >> (bits - 31));
}

/* a / 2^bits, to nearest */
static int32_t rounded(int64_t a, uint32_t bits)
{
    int64_t one = (int64_t)1 << bits;
    return (int32_t)((a < 0 ? a - one / 2 : a + one / 2) / one);
}

/* In units of 2^-30: what is cut off the entry takes less than 1, what is cut off the norm adds less than 1 to its size or what is cut
 * off the reciprocal takes less than 1, and rounding is off by 1/2. */
void cage_rough_of(const int32_t q[4], struct cage_rough *rough)
{
    int64_t norm = cage_rotation_norm(q), row[3]; /* magnitudes <= norm */
    int64_t inverse = (int64_t)cage_u64_divide((uint64_t)1 << 61, (uint64_t)scaled(norm, norm)); /* 2^30 to 2^31 */
    for (int32_t i = 0; i < 3; i++) {
        cage_rotation_row(q, i, row);
        for (int32_t k = 0; k < 3; k++)
            rough->m[i][k] = rounded(scaled(row[k], norm) * inverse, 31);
    }
}

void cage_rough_rotate(const struct cage_rough *rough, const int32_t y[3], int32_t out[3])
{
    for (int32_t i = 0; i < 3; i++) { /* < 3 2^31 2^28 */
        const int32_t *m = rough->m[i];
        out[i] = rounded((int64_t)m[0] * y[0] + (int64_t)m[1] * y[1] + (int64_t)m[2] * y[2], 30);
    }
}

/* The quaternion times a power of two, largest entry in [2^29, 2^30], and its norm rounded down. */
static int64_t normalise(const int32_t q[4], int64_t out[4])
{
    int64_t largest = 0;
    for (int32_t i = 0; i < 4; i++) {
        out[i] = q[i];
        int64_t size = out[i] < 0 ? -out[i] : out[i];
        largest = size > largest ? size : largest;
    }
    for (; largest < (int64_t)1 << 29; largest *= 2)
        for (int32_t i = 0; i < 4; i++)
            out[i] *= 2;
    cage_i128 square = cage_i128_of(0);
    for (int32_t i = 0; i < 4; i++)
        cage_i128_add_product(&square, out[i], out[i]);
    return (int64_t)cage_u128_root(square); /* >= 2^29, <= 2^31 */
}

int64_t cage_turn(const int32_t q[4], const int32_t other[4])
{
    int64_t a[4], b[4];
    int64_t norms = normalise(q, a) * normalise(other, b); /* 2^58 to 2^62, not above the true product */
    /* |q ^ q'| = |q| |q'| sin: six minors <= 2^61, the sum of squares = |q|^2 |q'|^2 sin^2 <= 2^124 */
    cage_i128 square = cage_i128_of(0);
    for (int32_t i = 0; i < 4; i++)
        for (int32_t k = 0; k < i; k++) {
            int64_t minor = a[i] * b[k] - a[k] * b[i];
            cage_i128_add_product(&square, minor, minor);
        }
    cage_i128 root = cage_u64_mul(cage_u128_root(square), 1), rest;
    if (cage_i128_compare(cage_u64_mul(cage_i128_low(root), cage_i128_low(root)), square) < 0)
        root = cage_i128_add(root, cage_i128_of(1));
    cage_i128 turn = cage_u128_divide(cage_i128_shl(root, TURN_BITS + 1), cage_i128_of(norms), &rest);
    return (int64_t)cage_i128_low(turn) + (cage_i128_sign(rest) != 0);
}

int32_t cage_displacement(int64_t turn, int32_t reach)
{
    /* (2^32 + 17) 2^29 + 2^31 < 2^62; the result is at most 2^30 + 5 */
    return (int32_t)((turn * reach + ((int64_t)1 << TURN_BITS) - 1) >> TURN_BITS);
}

void cage_corners_of(const int32_t q[4], int32_t corner[8][4], struct cage_corners *out)
{
    const int64_t a = q[0], b = q[1], c = q[2], d = q[3];
    for (int32_t i = 0; i < 8; i++) {
        const int64_t w = corner[i][0], x = corner[i][1], y = corner[i][2], z = corner[i][3];
        int64_t p[4] = {a * w + b * x + c * y + d * z, a * x - w * b - (c * z - d * y), /* < 2^50 */
                        a * y - w * c - (d * x - b * z), a * z - w * d - (b * y - c * x)};
        int64_t largest = 1;
        for (int32_t k = 0; k < 4; k++)
            largest = p[k] > largest ? p[k] : -p[k] > largest ? -p[k] : largest;
        /* Largest entry to 2^30..2^31; then real part >= 2^29, as the angle is at most 60 degrees. Entries are off by
         * less than 1, so u by less than (1 + |u|) 2^-29 and the division's 2^-30. */
        const cage_i128 real = cage_i128_of(scaled(p[0], largest));
        for (int32_t k = 0; k < 3; k++)
            out->u[i][k] = cage_i128_nearest(cage_i128_mul(scaled(p[k + 1], largest), (int64_t)1 << 30), real, INT64_MAX);
    }
}

int32_t cage_displacement_within(const struct cage_corners *corners, const int32_t y[3])
{
    cage_i128 most = cage_i128_of(0);
    for (int32_t i = 0; i < 8; i++) {
        const int64_t *u = corners->u[i];
        cage_i128 square = cage_i128_of(0); /* |u x y|^2 < 3 2^106 */
        for (int32_t k = 0; k < 3; k++) {
            int64_t minor = u[(k + 1) % 3] * y[(k + 2) % 3] - u[(k + 2) % 3] * y[(k + 1) % 3];
            cage_i128_add_product(&square, minor, minor);
        }
        most = cage_i128_compare(square, most) > 0 ? square : most;
    }
    /* 2 A |y| / sqrt(A^2 + |y|^2), A the largest |u x y|. u is off by less than 2^-27, so the result by less than 2
     * 2^21 2^-27, far below 1. A and |y| are rounded up, the root and the quotient down. */
    int64_t length = 0;
    for (int32_t k = 0; k < 3; k++)
        length += (int64_t)y[k] * y[k];
    cage_i128 sum = cage_i128_add(most, cage_i128_shl(cage_i128_of(length), 60)), rest;
    int64_t root = (int64_t)cage_u128_root(sum); /* < 2^55 */
    if (root == 0)
        return 0;
    int64_t arm = (int64_t)cage_u128_root(most) + 1, reach = cage_length(y);
    cage_i128 moved = cage_u128_divide(cage_i128_mul(2 * arm, reach), cage_i128_of(root), &rest);
    return (int32_t)cage_i128_low(moved) + 2;
}

bool cage_centre_point(int32_t dim, const struct cage_centre *centre, int32_t at[3])
{
    const int32_t base[3] = {centre->base->x, centre->base->y, centre->base->z};
    int32_t reach = dim == 2 ? CAGE_REACH_2D : CAGE_REACH_3D;
    for (int32_t k = 0; k < 3; k++) {
        int64_t to = base[k] + cage_i128_nearest(centre->offset[k], centre->denominator, (int64_t)1 << 40);
        if (to < -reach || to > reach)
            return false;
        at[k] = (int32_t)to;
    }
    return true;
}

int32_t cage_length(const int32_t v[3])
{
    int64_t square = 0; /* <= 3 2^58 */
    for (int32_t k = 0; k < 3; k++)
        square += (int64_t)v[k] * v[k];
    int64_t root = (int64_t)cage_u128_root(cage_i128_of(square));
    return (int32_t)(root + (root * root < square));
}

int32_t cage_radius_change(int32_t displacement, int32_t sign)
{
    return sign < 0 ? -displacement - CAGE_SLACK_INNER : displacement + CAGE_SLACK_OUTER;
}
