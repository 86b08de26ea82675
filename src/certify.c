/* certify: is a motion free of collision? Shares no geometry with the search.
 *
 * Object balls are placed by dividing exact integers, R(q) y = M(q) y / |q|^2 to the nearest grid point: off by less than 1
 * unit, so a distance that is 1 unit larger than needed is large enough. During a turn about the pivot along
 * the shorter arc (at most 90 degrees between the quaternions) a ball is never farther from where it began than where it ends;
 * that holds for a leg that moves as well, seen from the pivot. */
#include "certify.h"
#include "body.h"
#include "wide.h"

enum { PLACE_LIMIT = 1 << 30, CERTIFY_PIECES = 1 << 10 };

/* A leg that does both is halved so often at most, and its quaternions are of this length. */
enum { HALVINGS = 10, LENGTH = (1 << 30) - 8 };

/* N R(q) v, N = |q|^2, entries of q at most 2^30, of v at most 2^29: < 2^93. */
static void turned(const int32_t q[4], const int32_t v[3], cage_i128 out[3], int64_t *norm)
{
    const int64_t w = q[0], x = q[1], y = q[2], z = q[3];
    const int64_t m[3][3] = {
        {w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)},
        {2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)},
        {2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z},
    };
    for (int32_t i = 0; i < 3; i++)
        out[i] = cage_i128_add(cage_i128_add(cage_i128_mul(m[i][0], v[0]), cage_i128_mul(m[i][1], v[1])),
                               cage_i128_mul(m[i][2], v[2]));
    *norm = w * w + x * x + y * y + z * z;
}

/* R(q)(ball - pivot) to the nearest grid point; true if that is exact. */
static bool place_ball(const int32_t q[4], const cage_ball *ball, const int32_t pivot[3], int64_t at[3])
{
    const int32_t v[3] = {ball->x - pivot[0], ball->y - pivot[1], ball->z - pivot[2]};
    cage_i128 n[3];
    int64_t norm;
    bool exact = true;
    turned(q, v, n, &norm);
    for (int32_t i = 0; i < 3; i++) {
        at[i] = cage_i128_nearest(n[i], cage_i128_of(norm), PLACE_LIMIT);
        exact = exact && cage_i128_compare(cage_i128_mul(at[i], norm), n[i]) == 0;
    }
    return exact;
}

/* Is the point c at least `apart` away from the segment a b? |differences| < 2^33, so sums of three squares < 2^68 in
 * 128 bits, and their products < 2^136 in 256. */
static bool segment_clear(const int32_t a[3], const int32_t b[3], const int64_t c[3], int64_t apart)
{
    int64_t u[3], v[3], w[3];
    cage_i128 along = cage_i128_of(0), length = along, from_a = along, from_b = along;
    for (int32_t i = 0; i < 3; i++) {
        u[i] = (int64_t)b[i] - a[i];
        v[i] = c[i] - a[i];
        w[i] = c[i] - b[i];
        cage_i128_add_product(&along, u[i], v[i]);
        cage_i128_add_product(&length, u[i], u[i]);
        cage_i128_add_product(&from_a, v[i], v[i]);
        cage_i128_add_product(&from_b, w[i], w[i]);
    }
    cage_i128 square = cage_i128_mul(apart, apart);
    if (cage_i128_sign(along) <= 0)
        return cage_i128_compare(from_a, square) >= 0;
    if (cage_i128_compare(along, length) >= 0)
        return cage_i128_compare(from_b, square) >= 0;
    /* |v|^2 |u|^2 - (u.v)^2 >= apart^2 |u|^2, in 256 bits */
    cage_i256 excess = {{0, 0, 0, 0}};
    cage_i256_add_product(&excess, cage_i128_sub(from_a, square), length);
    cage_i256_add_product(&excess, along, cage_i128_minus(along));
    return cage_i256_sign(&excess) >= 0;
}

bool cage_certify_leg(const cage_scene *scene, const int32_t pivot[3], const int32_t q[4], const int32_t a[3], const int32_t b[3],
                    int32_t spare)
{
    for (int32_t i = 0; i < scene->object.outer_count; i++) {
        const cage_ball *y = &scene->object.outer[i];
        int64_t at[3];
        int64_t inexact = place_ball(q, y, pivot, at) ? 0 : 1;
        for (int32_t j = 0; j < scene->obstacles.outer_count; j++) {
            const cage_ball *x = &scene->obstacles.outer[j];
            const int64_t centre[3] = {x->x - at[0], x->y - at[1], x->z - at[2]};
            if (!segment_clear(a, b, centre, (int64_t)x->r + y->r + inexact + spare))
                return false;
        }
    }
    return true;
}

/* May the object turn about the pivot at p from q to r, both ends off the arc that is meant by at most 2^-28? Tested
 * from q's end. */
static bool arc_clear(const cage_scene *scene, const int32_t pivot[3], const int32_t p[3], const int32_t q[4], const int32_t r[4])
{
    for (int32_t i = 0; i < scene->object.outer_count; i++) {
        const cage_ball *y = &scene->object.outer[i];
        int64_t at[3], to[3];
        place_ball(q, y, pivot, at);
        place_ball(r, y, pivot, to);
        const int32_t moved[3] = {(int32_t)(to[0] - at[0]), (int32_t)(to[1] - at[1]), (int32_t)(to[2] - at[2])};
        cage_i128 square = cage_i128_of(0);
        for (int32_t k = 0; k < 3; k++)
            cage_i128_add_product(&square, moved[k], moved[k]);
        /* The root rounded up, and three times 0.87 for the rounding of both ends and of the centre; that the ends are off the
         * arc adds less than 3 |Y| 2^-27 in space, nothing in the plane: 2^-5 three times while |Y| < 2^22; |Y| < 2^25. */
        int64_t arm = 0;
        for (int32_t k = 0; k < 3; k++)
            arm += at[k] < 0 ? -at[k] : at[k];
        int64_t spare = (int64_t)cage_u128_root(square) + 1 + 3 + (scene->dim == 3 ? arm >> 22 : 0);
        for (int32_t j = 0; j < scene->obstacles.outer_count; j++) {
            const cage_ball *x = &scene->obstacles.outer[j];
            const int64_t centre[3] = {x->x - at[0], x->y - at[1], x->z - at[2]};
            if (!segment_clear(p, p, centre, (int64_t)x->r + y->r + spare))
                return false;
        }
    }
    return true;
}

/* q times a power of two, the largest entry above 2^29, at most 2^30. */
static void lengthen(const int32_t q[4], int64_t out[4])
{
    int64_t largest = 0;
    for (int32_t i = 0; i < 4; i++) {
        out[i] = q[i];
        largest = largest < out[i] ? out[i] : largest < -out[i] ? -out[i] : largest;
    }
    for (; largest > 0 && largest <= (int64_t)1 << 29; largest *= 2)
        for (int32_t i = 0; i < 4; i++)
            out[i] *= 2;
}

/* A rotation about k / n of the way from q to r: (n - k) q + k r, both of nearly the same length. In the plane it
 * stays on the arc; in space it is off by less than 2 in 2^29, the size of its largest entry: 2^-28. */
static void between(const int32_t q[4], const int32_t r[4], int32_t k, int32_t n, int32_t out[4])
{
    int64_t a[4], b[4], mixed[4], dot = 0, largest = 0;
    lengthen(q, a);
    lengthen(r, b);
    for (int32_t i = 0; i < 4; i++)
        dot += a[i] * b[i]; /* <= 2^62 */
    for (int32_t i = 0; i < 4; i++) {
        mixed[i] = (n - k) * a[i] + (dot < 0 ? -k : k) * b[i]; /* <= n 2^30 */
        int64_t size = mixed[i] < 0 ? -mixed[i] : mixed[i];
        largest = size > largest ? size : largest;
    }
    int64_t divisor = 1;
    while (largest / divisor > 1 << 30)
        divisor *= 2;
    for (int32_t i = 0; i < 4; i++)
        out[i] = (int32_t)(mixed[i] / divisor);
}

/* Quaternions at right angles: there are two shorter arcs. */
static bool ambiguous(const int32_t q[4], const int32_t r[4])
{
    int64_t dot = 0; /* <= 2^62 */
    for (int32_t i = 0; i < 4; i++)
        dot += (int64_t)q[i] * r[i];
    return dot == 0;
}

bool cage_certify_turn(const cage_scene *scene, const int32_t pivot[3], const int32_t p[3], const int32_t q[4],
                       const int32_t r[4], int32_t pieces)
{
    for (int32_t n = 1; n <= pieces && !ambiguous(q, r); n *= 4) {
        bool clear = true;
        int32_t from[4] = {q[0], q[1], q[2], q[3]}, to[4];
        for (int32_t k = 1; clear && k <= n; k++) {
            between(q, r, k, n, to);
            clear = arc_clear(scene, pivot, p, from, to);
            for (int32_t i = 0; i < 4; i++)
                from[i] = to[i];
        }
        if (clear)
            return true;
    }
    return false;
}

/* ---- legs that move and turn at once --------------------------------------------------------------------- */

/* q made as long as LENGTH: each entry is off by at most a half, so the direction by less than 2^-30; lengths agree to
 * 2^-28. */
static void to_length(const int64_t q[4], int32_t out[4])
{
    cage_i128 square = cage_i128_of(0);
    for (int32_t i = 0; i < 4; i++)
        cage_i128_add_product(&square, q[i], q[i]); /* entries <= 2^31: < 2^64 */
    int64_t length = (int64_t)cage_u128_root(square);
    for (int32_t i = 0; i < 4; i++)
        out[i] = (int32_t)cage_i128_nearest(cage_i128_mul(q[i], LENGTH), cage_i128_of(length), (int64_t)1 << 30);
}

/* The rotation in the middle of the arc: the sum of quaternions of one length. What their lengths differ by puts it off the
 * middle by less than 2^-29, rounding by 2^-30, and what they are off themselves by no more than the larger of that. */
static void middle(const int32_t q[4], const int32_t r[4], int32_t out[4])
{
    const int64_t sum[4] = {(int64_t)q[0] + r[0], (int64_t)q[1] + r[1], (int64_t)q[2] + r[2], (int64_t)q[3] + r[3]};
    to_length(sum, out);
}

/* Where a leg is at k / 2^HALVINGS of it: x less than 0.87 off. */
struct stage {
    int32_t k;
    int32_t x[3], q[4];
};

static void stage_at(const int32_t a[3], const int32_t b[3], int32_t k, struct stage *out)
{
    const int64_t up = (int64_t)1 << 43; /* nothing negative is shifted: |b - a| k <= 2^42, up / 2^HALVINGS is whole */
    out->k = k;
    for (int32_t i = 0; i < 3; i++)
        out->x[i] = (int32_t)(a[i] + ((((int64_t)b[i] - a[i]) * k + (1 << (HALVINGS - 1)) + up) >> HALVINGS) - (up >> HALVINGS));
}

/* Is every pose clear whose pivot is anywhere on the way between two stages, its rotation anywhere on the arc between
 * theirs? A ball is then no farther from where it would be at the first stage's rotation than that is from where it would
 * be at the second's. */
static bool piece_clear(const cage_scene *scene, const int32_t pivot[3], const struct stage *from, const struct stage *to)
{
    for (int32_t i = 0; i < scene->object.outer_count; i++) {
        const cage_ball *y = &scene->object.outer[i];
        int64_t at[3], end[3], arm = 0;
        cage_i128 square = cage_i128_of(0);
        place_ball(from->q, y, pivot, at);
        place_ball(to->q, y, pivot, end);
        for (int32_t k = 0; k < 3; k++) {
            cage_i128_add_product(&square, end[k] - at[k], end[k] - at[k]);
            arm += at[k] < 0 ? -at[k] : at[k];
        }
        /* The root rounded up, four times 0.87 for the rounding of both places, of the centre and of the way, and both
         * quaternions off by HALVINGS + 1 times 2^-28 at most: three times twice that, less than 2^-21 of the arm. */
        int64_t spare = (int64_t)cage_u128_root(square) + 1 + 4 + 1 + (arm >> 21);
        for (int32_t j = 0; j < scene->obstacles.outer_count; j++) {
            const cage_ball *x = &scene->obstacles.outer[j];
            const int64_t centre[3] = {x->x - at[0], x->y - at[1], x->z - at[2]};
            if (!segment_clear(from->x, to->x, centre, (int64_t)x->r + y->r + spare))
                return false;
        }
    }
    return true;
}

/* Halved where that is needed. Both ends of a piece are passed at the same time by the straight way and by the arc, when each
 * goes at a constant rate. */
bool cage_certify_move(const cage_scene *scene, const int32_t pivot[3], const cage_pose *a, const cage_pose *b)
{
    struct stage from, ahead[HALVINGS + 1]; /* the ends of pieces to come, the next one last */
    int64_t q[4], r[4], dot = 0;
    int32_t count = 1;
    lengthen(a->q, q);
    lengthen(b->q, r);
    for (int32_t i = 0; i < 4; i++)
        dot += q[i] * r[i]; /* <= 2^62 */
    if (dot == 0)
        return false;
    for (int32_t i = 0; i < 4; i++)
        r[i] = dot < 0 ? -r[i] : r[i];
    stage_at(a->x, b->x, 0, &from);
    stage_at(a->x, b->x, 1 << HALVINGS, &ahead[0]);
    to_length(q, from.q);
    to_length(r, ahead[0].q);
    while (count > 0) {
        const struct stage *to = &ahead[count - 1];
        if (piece_clear(scene, pivot, &from, to)) {
            from = *to;
            count--;
        } else if (to->k - from.k == 1) {
            return false;
        } else {
            stage_at(a->x, b->x, (from.k + to->k) / 2, &ahead[count]);
            middle(from.q, to->q, ahead[count].q);
            count++; /* pieces are aligned: at most HALVINGS + 1 */
        }
    }
    return true;
}

static bool same_rotation(const int32_t q[4], const int32_t r[4])
{
    for (int32_t i = 0; i < 4; i++)
        for (int32_t k = 0; k < i; k++)
            if ((int64_t)q[i] * r[k] != (int64_t)q[k] * r[i])
                return false;
    return true;
}

static bool same_place(const int32_t a[3], const int32_t b[3])
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/* Is `at` the pose with its pivot moved to a grid point less than 1 unit away, and is that move free? */
static bool end_clear(const cage_scene *scene, const int32_t pivot[3], const cage_pose *pose, const cage_pose *at)
{
    cage_i128 n[3];
    int64_t norm;
    bool exact = true;
    turned(pose->q, pivot, n, &norm);
    for (int32_t i = 0; i < 3; i++) {
        /* |N (at - x) - M c| <= N / 2 on each axis: 0.71 away at most in the plane; < 2^94 */
        cage_i128 off = cage_i128_abs(cage_i128_sub(cage_i128_mul(norm, (int64_t)at->x[i] - pose->x[i]), n[i]));
        if (cage_i128_compare(cage_i128_shl(off, 1), cage_i128_of(norm)) > 0)
            return false;
        exact = exact && cage_i128_sign(off) == 0;
    }
    return same_rotation(pose->q, at->q) && cage_certify_leg(scene, pivot, at->q, at->x, at->x, exact ? 0 : 1);
}

void cage_certify_extent(const cage_scene *scene, int32_t axis, int32_t *low, int32_t *high)
{
    *low = INT32_MAX;
    *high = INT32_MIN;
    for (int32_t j = 0; j < scene->obstacles.outer_count; j++) {
        const cage_ball *x = &scene->obstacles.outer[j];
        const int32_t at[3] = {x->x, x->y, x->z};
        *low = at[axis] - x->r < *low ? at[axis] - x->r : *low;
        *high = at[axis] + x->r > *high ? at[axis] + x->r : *high;
    }
}

int32_t cage_certify_size(const cage_scene *scene, const int32_t pivot[3])
{
    int32_t most = 0;
    for (int32_t i = 0; i < scene->object.outer_count; i++) {
        const cage_ball *y = &scene->object.outer[i];
        const int64_t v[3] = {(int64_t)y->x - pivot[0], (int64_t)y->y - pivot[1], (int64_t)y->z - pivot[2]};
        int32_t size = (int32_t)cage_u128_root(cage_i128_of(v[0] * v[0] + v[1] * v[1] + v[2] * v[2])) + 1 + y->r;
        most = size > most ? size : most;
    }
    return most;
}

bool cage_certify_beyond(const cage_scene *scene, const int32_t pivot[3], const int32_t x[3])
{
    int64_t size = cage_certify_size(scene, pivot);
    for (int32_t axis = 0; axis < scene->dim; axis++) {
        int32_t low, high;
        cage_certify_extent(scene, axis, &low, &high);
        if (low > high || x[axis] - size >= high || x[axis] + size <= low)
            return true;
    }
    return false;
}

int32_t cage_path_check(const cage_scene *scene, const cage_pose *start, const cage_pose *goal, const int32_t pivot[3],
                        const cage_pose *path, int32_t count)
{
    int32_t error = cage_scene_check(scene);
    if (error != CAGE_OK)
        return error;
    if (!start || !pivot || !path || count < 1)
        return CAGE_ERROR_ARGUMENT;
    int32_t reach = scene->dim == 2 ? CAGE_REACH_2D : CAGE_REACH_3D;
    error = cage_pose_check(scene->dim, start);
    if (error == CAGE_OK && goal)
        error = cage_pose_check(scene->dim, goal);
    for (int32_t i = 0; i < 3 && error == CAGE_OK; i++)
        if (pivot[i] < -reach || pivot[i] > reach)
            error = CAGE_ERROR_RANGE;
    if (error != CAGE_OK)
        return error;
    if (scene->dim == 2 && pivot[2] != 0)
        return CAGE_ERROR_DIMENSION;
    for (int32_t n = 0; n < count; n++) {
        const cage_pose *at = &path[n];
        if (scene->dim == 2 && at->x[2] != 0)
            return CAGE_ERROR_DIMENSION;
        cage_pose turn_only = {{0, 0, 0}, {at->q[0], at->q[1], at->q[2], at->q[3]}};
        error = cage_pose_check(scene->dim, &turn_only);
        if (error != CAGE_OK)
            return error;
    }
    if (!end_clear(scene, pivot, start, &path[0]))
        return 0;
    for (int32_t n = 0; n + 1 < count; n++) {
        const cage_pose *a = &path[n], *b = &path[n + 1];
        bool clear = false;
        if (same_rotation(a->q, b->q))
            clear = cage_certify_leg(scene, pivot, a->q, a->x, b->x, 0);
        else if (same_place(a->x, b->x))
            clear = cage_certify_turn(scene, pivot, a->x, a->q, b->q, CERTIFY_PIECES);
        else
            clear = cage_certify_move(scene, pivot, a, b);
        if (!clear)
            return 0;
    }
    return goal ? end_clear(scene, pivot, goal, &path[count - 1]) : cage_certify_beyond(scene, pivot, path[count - 1].x);
}
