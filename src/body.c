/* body: a scene as one side of the proof sees it, and exact questions about single poses. */
#include "body.h"
#include "grid.h"
#include "predicate.h"

static const cage_ball *shape_balls(const cage_shape *shape, int32_t sign, int32_t *count)
{
    *count = sign < 0 ? shape->inner_count : shape->outer_count;
    return sign < 0 ? shape->inner : shape->outer;
}

/* Entries at most 2^29 apart. */
int32_t cage_reach(const cage_ball *ball, const int32_t p[3])
{
    const int32_t v[3] = {ball->x - p[0], ball->y - p[1], ball->z - p[2]};
    return cage_length(v);
}

/* The largest distance from p to a centre of either set, and the ball it belongs to (null: no balls). */
static int32_t farthest(const cage_shape *object, const int32_t p[3], const cage_ball **ball)
{
    int32_t largest = -1, count;
    *ball = NULL;
    for (int32_t sign = -1; sign <= 1; sign += 2) {
        const cage_ball *from = shape_balls(object, sign, &count);
        for (int32_t i = 0; i < count; i++) {
            int32_t far = cage_reach(&from[i], p);
            if (far > largest) {
                largest = far;
                *ball = &from[i];
            }
        }
    }
    return largest;
}

/* Where the middle of the box around all centres is as good in two coordinates, or better, it is taken: an object with a half
 * turn has its axis there. */
static void prefer_middle(const cage_shape *object, int32_t best, int32_t pivot[3])
{
    int32_t low[3] = {INT32_MAX, INT32_MAX, INT32_MAX}, high[3] = {INT32_MIN, INT32_MIN, INT32_MIN}, count;
    for (int32_t sign = -1; sign <= 1; sign += 2) {
        const cage_ball *ball = shape_balls(object, sign, &count);
        for (int32_t i = 0; i < count; i++) {
            const int32_t at[3] = {ball[i].x, ball[i].y, ball[i].z};
            for (int32_t k = 0; k < 3; k++) {
                low[k] = at[k] < low[k] ? at[k] : low[k];
                high[k] = at[k] > high[k] ? at[k] : high[k];
            }
        }
    }
    for (int32_t axis = 0; axis < 3; axis++) {
        const cage_ball *far;
        int32_t p[3];
        for (int32_t k = 0; k < 3; k++)
            p[k] = k == axis ? pivot[k] : (low[k] + high[k]) / 2; /* < 2^29 */
        int32_t size = farthest(object, p, &far);
        if (size > best)
            continue;
        best = size;
        pivot[0] = p[0];
        pivot[1] = p[1];
        pivot[2] = p[2];
    }
}

/* Badoiu and Clarkson, "Smaller core-sets for balls", SODA 2003: step 1/(n+1) of the way to the farthest centre. */
void cage_pivot(const cage_shape *object, int32_t pivot[3])
{
    const int32_t origin[3] = {0, 0, 0};
    int32_t p[3] = {0, 0, 0};
    const cage_ball *far;
    int32_t best = farthest(object, origin, &far);
    pivot[0] = pivot[1] = pivot[2] = 0;
    for (int32_t n = 0; n < 128 && far; n++) {
        p[0] += (far->x - p[0]) / (n + 1);
        p[1] += (far->y - p[1]) / (n + 1);
        p[2] += (far->z - p[2]) / (n + 1);
        int32_t size = farthest(object, p, &far);
        if (size < best) {
            best = size;
            pivot[0] = p[0];
            pivot[1] = p[1];
            pivot[2] = p[2];
        }
    }
    if (pivot[0] || pivot[1] || pivot[2])
        prefer_middle(object, best, pivot);
}

int32_t cage_side_make(struct cage_arena *arena, const cage_scene *scene, const int32_t pivot[3], int32_t sign,
                       const struct cage_shortcuts *shortcuts, struct cage_side *out)
{
    const cage_ball *from = shape_balls(&scene->object, sign, &out->objects);
    cage_ball *ball = cage_arena_take(arena, (size_t)out->objects, sizeof *ball);
    int32_t *reach = cage_arena_take(arena, (size_t)out->objects, sizeof *reach);
    if (!ball || !reach)
        return CAGE_ERROR_MEMORY;
    for (int32_t i = 0; i < out->objects; i++) {
        reach[i] = cage_reach(&from[i], pivot);
        ball[i] = from[i];
        ball[i].x -= pivot[0];
        ball[i].y -= pivot[1];
        ball[i].z -= pivot[2];
    }
    out->object = ball;
    out->reach = reach;
    for (int32_t t = 0; t < 4; t++)
        out->image[t] = NULL;
    out->obstacle = shape_balls(&scene->obstacles, sign, &out->obstacles);
    out->dim = scene->dim;
    out->sign = sign;
    out->shortcuts = shortcuts;
    return CAGE_OK;
}

/* More balls are not compared: 2^22 pairs take some milliseconds. */
enum { TURNED_BALLS = 2048 };

/* The ball at the place that the half turn takes ball i to; -1: there is none. */
static int32_t image_of(const struct cage_side *side, int32_t turn, int32_t i)
{
    const cage_ball *from = &side->object[i];
    const int32_t x = turn == 1 ? from->x : -from->x, y = turn == 2 ? from->y : -from->y, z = turn == 3 ? from->z : -from->z;
    for (int32_t k = 0; k < side->objects; k++) {
        const cage_ball *to = &side->object[k];
        if (to->x == x && to->y == y && to->z == z && to->r == from->r)
            return k;
    }
    return -1;
}

int32_t cage_side_turn(struct cage_arena *arena, int32_t turn, struct cage_side *side)
{
    if (side->objects > TURNED_BALLS)
        return 0;
    size_t mark = arena->used;
    int32_t *image = cage_arena_take(arena, (size_t)side->objects, sizeof *image);
    if (!image)
        return CAGE_ERROR_MEMORY;
    for (int32_t i = 0; i < side->objects; i++) {
        image[i] = image_of(side, turn, i);
        if (image[i] < 0) {
            cage_arena_release(arena, mark);
            return 0;
        }
    }
    side->image[turn] = image;
    return 1;
}

static int32_t reach_limit(int32_t dim) { return dim == 2 ? CAGE_REACH_2D : CAGE_REACH_3D; }

static bool within(int32_t value, int32_t limit) { return value >= -limit && value <= limit; }

static int32_t shape_check(int32_t dim, const cage_shape *shape)
{
    for (int32_t sign = -1; sign <= 1; sign += 2) {
        int32_t count, limit = reach_limit(dim);
        const cage_ball *ball = shape_balls(shape, sign, &count);
        if (count < 0 || (count > 0 && !ball))
            return CAGE_ERROR_ARGUMENT;
        for (int32_t i = 0; i < count; i++) {
            if (dim == 2 && ball[i].z != 0)
                return CAGE_ERROR_DIMENSION;
            if (ball[i].r < 0)
                return CAGE_ERROR_RADIUS;
            if (!within(ball[i].x, limit) || !within(ball[i].y, limit) || !within(ball[i].z, limit) || ball[i].r > limit)
                return CAGE_ERROR_RANGE;
        }
    }
    return CAGE_OK;
}

/* max over both sets of factor |centre - from| + r; terms < 2^28, 3 2^29 + 2^28. */
static int64_t extent(const cage_shape *shape, const int32_t from[3], int64_t factor)
{
    int64_t most = 0;
    for (int32_t sign = -1; sign <= 1; sign += 2) {
        int32_t count;
        const cage_ball *ball = shape_balls(shape, sign, &count);
        for (int32_t i = 0; i < count; i++) {
            int64_t size = factor * cage_reach(&ball[i], from) + ball[i].r;
            most = size > most ? size : most;
        }
    }
    return most;
}

int32_t cage_scene_check(const cage_scene *scene)
{
    if (!scene)
        return CAGE_ERROR_ARGUMENT;
    if (scene->dim != 2 && scene->dim != 3)
        return CAGE_ERROR_DIMENSION;
    int32_t error = shape_check(scene->dim, &scene->object);
    if (error == CAGE_OK)
        error = shape_check(scene->dim, &scene->obstacles);
    if (error != CAGE_OK)
        return error;
    /* A slice of any cell: |centre| <= |X| + |y|, radius <= R + r + 2 |y| + slack + 1, all within CAGE_REACH. */
    int32_t pivot[3];
    const int32_t origin[3] = {0, 0, 0};
    cage_pivot(&scene->object, pivot);
    int64_t size = extent(&scene->obstacles, origin, 1) + extent(&scene->object, pivot, 3) + 16;
    if (size > reach_limit(scene->dim))
        return CAGE_ERROR_RANGE;
    /* Collision balls of a slice are counted in 28 bits. */
    for (int32_t sign = -1; sign <= 1; sign += 2) {
        int32_t objects, obstacles;
        shape_balls(&scene->object, sign, &objects);
        shape_balls(&scene->obstacles, sign, &obstacles);
        if ((int64_t)objects * obstacles > CAGE_PAIRS_MAX)
            return CAGE_ERROR_RANGE;
    }
    return CAGE_OK;
}

int32_t cage_pose_check(int32_t dim, const cage_pose *pose)
{
    int32_t limit = dim == 2 ? CAGE_QUATERNION_2D : CAGE_QUATERNION_3D;
    for (int32_t k = 0; k < 3; k++)
        if (!within(pose->x[k], reach_limit(dim)))
            return CAGE_ERROR_RANGE;
    if (dim == 2 && pose->x[2] != 0)
        return CAGE_ERROR_DIMENSION;
    if (dim == 2 && (pose->q[1] != 0 || pose->q[2] != 0))
        return CAGE_ERROR_ROTATION;
    for (int32_t k = 0; k < 4; k++)
        if (!within(pose->q[k], limit))
            return CAGE_ERROR_ROTATION;
    return pose->q[0] || pose->q[1] || pose->q[2] || pose->q[3] ? CAGE_OK : CAGE_ERROR_ROTATION;
}

/* Entry i of N z + M y, with N = |q|^2 <= 2^62 and the integer matrix M = N R(q): <= 2^62 |z_i| + 3 2^62 2^28. */
static cage_i128 scaled_entry(const int32_t q[4], int32_t i, const int32_t y[3], int32_t z)
{
    int64_t row[3];
    cage_i128 sum = cage_i128_mul(cage_rotation_norm(q), z);
    cage_rotation_row(q, i, row);
    for (int32_t k = 0; k < 3; k++)
        cage_i128_add_product(&sum, row[k], y[k]);
    return sum;
}

void cage_pose_pivot(const cage_pose *pose, const int32_t pivot[3], int32_t out[3])
{
    const cage_i128 norm = cage_i128_of(cage_rotation_norm(pose->q));
    struct cage_rough rough;
    cage_rough_of(pose->q, &rough);
    cage_rough_rotate(&rough, pivot, out);
    for (int32_t i = 0; i < 3; i++) { /* until -norm <= 2 rest < norm: 2 rounds at most */
        cage_i128 rest = scaled_entry(pose->q, i, pivot, -out[i]);
        for (; cage_i128_compare(cage_i128_add(rest, rest), norm) >= 0; out[i]++)
            rest = cage_i128_sub(rest, norm);
        for (; cage_i128_compare(cage_i128_add(rest, rest), cage_i128_minus(norm)) < 0; out[i]--)
            rest = cage_i128_add(rest, norm);
        out[i] += pose->x[i];
    }
}

/* Entry i of N (x - X) + M y: < 2^62 2^29 + 3 2^62 2^28. */
static cage_i128 scaled_distance(const cage_pose *pose, const cage_ball *y, const cage_ball *x, int32_t i)
{
    const int32_t from[3] = {y->x, y->y, y->z}, to[3] = {x->x, x->y, x->z};
    return scaled_entry(pose->q, i, from, pose->x[i] - to[i]);
}

/* |N (x - X) + M y| < N (R + r). One coordinate after the other: it takes little stack. */
bool cage_pair_collides(const cage_pose *pose, const cage_ball *y, const cage_ball *x)
{
    cage_i256 excess = {{0, 0, 0, 0}};
    for (int32_t i = 0; i < 4; i++) {
        cage_i128 n = i < 3 ? scaled_distance(pose, y, x, i) : cage_i128_mul(cage_rotation_norm(pose->q), (int64_t)x->r + y->r);
        cage_i256_add_product(&excess, n, i < 3 ? n : cage_i128_minus(n));
    }
    return cage_i256_sign(&excess) < 0;
}

int32_t cage_collides(const cage_scene *scene, const cage_pose *pose, int32_t side)
{
    int32_t error = cage_scene_check(scene);
    if (error != CAGE_OK)
        return error;
    if (!pose || (side != CAGE_SIDE_INNER && side != CAGE_SIDE_OUTER))
        return CAGE_ERROR_ARGUMENT;
    error = cage_pose_check(scene->dim, pose);
    if (error != CAGE_OK)
        return error;
    int32_t objects, obstacles, sign = side == CAGE_SIDE_INNER ? -1 : 1;
    const cage_ball *object = shape_balls(&scene->object, sign, &objects);
    const cage_ball *obstacle = shape_balls(&scene->obstacles, sign, &obstacles);
    for (int32_t i = 0; i < objects; i++)
        for (int32_t j = 0; j < obstacles; j++)
            if (cage_pair_collides(pose, &object[i], &obstacle[j]))
                return 1;
    return 0;
}
