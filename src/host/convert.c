/* convert.c: doubles to grid units, inner balls inward and outer balls outward, and grid poses back to doubles.
 *
 * Bound. A length x becomes v = x / unit in double arithmetic. |v| < 2^28 here, so v is within 2^-25 of
 * the true quotient; when unit is a power of two it is exact. A centre goes to the nearest grid
 * point: each coordinate moves by at most 1/2 + 2^-25 units, the centre by less than 0.71 in the plane
 * and 0.867 in space. An inner radius floor(v) - 1 is at most the true radius - 1 + 2^-25, so
 * the inner ball lies in the ball given; an outer radius ceil(v) + 1 covers it likewise. A ball whose centre
 * is a grid point exactly needs no allowance: floor and ceil alone, corrected to be exact (see below). */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "host.h"

#define TURN_2D CAGE_QUATERNION_2D
#define TURN_3D CAGE_QUATERNION_3D

/* Sign of n * unit - x, exact: the product is formed without rounding. */
static int compare(double n, double unit, double x)
{
    double difference = fma(n, unit, -x);

    return (difference > 0) - (difference < 0);
}

/* The nearest grid coordinate, and whether it is x exactly. |x / unit| is below 2^28. */
static int32_t to_nearest(double x, double unit, int *exact)
{
    double n = floor(x / unit + 0.5);

    *exact = *exact && compare(n, unit, x) == 0;
    return (int32_t)n;
}

/* Two grid balls for one ball; returns 0 where there is no inner one. */
static int convert_ball(const host_ball *ball, double unit, cage_ball *inner, cage_ball *outer)
{
    double low = floor(ball->r / unit), high = ceil(ball->r / unit);
    int exact = 1;

    outer->x = to_nearest(ball->x[0], unit, &exact);
    outer->y = to_nearest(ball->x[1], unit, &exact);
    outer->z = to_nearest(ball->x[2], unit, &exact);
    if (!exact || compare(low, unit, ball->r) > 0)
        low -= 1;
    if (!exact || compare(high, unit, ball->r) < 0)
        high += 1;
    outer->r = (int32_t)high;
    *inner = *outer;
    inner->r = (int32_t)low;
    return low >= 0;
}

/* ---- how much fits ----------------------------------------------------------------------------- */

static double norm(const double x[3])
{
    return hypot(hypot(x[0], x[1]), x[2]);
}

static double largest_reach(const host_balls *balls)
{
    double reach = 0;
    int32_t i;

    for (i = 0; i < balls->count; i++)
        reach = fmax(reach, norm(balls->ball[i].x) + balls->ball[i].r);
    return reach;
}

/* Half the longest side of the box around the centres: no point is nearer to all of them. */
static double half_extent(const host_balls *balls)
{
    double low[3] = { 0 }, high[3] = { 0 }, half = 0;
    int32_t i;
    int k;

    for (i = 0; i < balls->count; i++)
        for (k = 0; k < 3; k++) {
            double x = balls->ball[i].x[k];

            low[k] = i == 0 ? x : fmin(low[k], x);
            high[k] = i == 0 ? x : fmax(high[k], x);
        }
    for (k = 0; k < 3; k++)
        half = fmax(half, (high[k] - low[k]) / 2);
    return half;
}

static double pose_reach(const host_pose *pose)
{
    return fmax(fabs(pose->x[0]), fmax(fabs(pose->x[1]), fabs(pose->x[2])));
}

/* A length that no scene of CAGE_REACH units can be smaller than: see cage.h for what must fit. The
 * object's own frame and the way from a pose to its pivot are allowed for as well. */
static double needed_reach(const host_query *query)
{
    double object = largest_reach(&query->object);
    double pose = pose_reach(&query->start);

    if (query->has_goal)
        pose = fmax(pose, pose_reach(&query->goal));
    return (query->roomy ? 2 : 1) * fmax(largest_reach(&query->obstacles) + 3 * half_extent(&query->object), pose + object);
}

static double reach_limit(int32_t dim)
{
    return (dim == 2 ? CAGE_REACH_2D : CAGE_REACH_3D) - 16;
}

/* ---- balls and poses ---------------------------------------------------------------------------- */

static void convert_shape(const host_balls *balls, double unit, cage_ball *inner, cage_ball *outer,
                          host_grid *grid, cage_shape *shape)
{
    int32_t i, kept = 0, rounded = 0;

    for (i = 0; i < balls->count; i++) {
        int has_inner = convert_ball(&balls->ball[i], unit, &inner[kept], &outer[i]);

        rounded += !has_inner || inner[kept].r != outer[i].r;
        kept += has_inner;
    }
    grid->rounded += rounded;
    grid->dropped += balls->count - kept;
    shape->inner = rounded == 0 ? outer : inner;
    shape->outer = outer;
    shape->inner_count = kept;
    shape->outer_count = balls->count;
}

/* A turn in the plane; multiples of 90 degrees are exact. */
static void convert_degrees(double degrees, int32_t q[4])
{
    double turn = fmod(degrees, 360), half;
    int quarter;

    q[1] = q[2] = 0;
    for (quarter = -3; quarter <= 3; quarter++)
        if (compare(quarter, 90, turn) == 0) {
            q[0] = quarter == 2 || quarter == -2 ? 0 : quarter == 3 || quarter == -3 ? -TURN_2D : TURN_2D;
            q[3] = quarter == 0 ? 0 : quarter < 0 ? -TURN_2D : TURN_2D;
            return;
        }
    half = turn * (acos(-1.0) / 360);
    q[0] = (int32_t)floor(cos(half) * TURN_2D + 0.5);
    q[3] = (int32_t)floor(sin(half) * TURN_2D + 0.5);
}

static void convert_pose(const host_pose *pose, double unit, cage_pose *result)
{
    double largest = 0;
    int k, ignored = 1;

    for (k = 0; k < 3; k++)
        result->x[k] = to_nearest(pose->x[k], unit, &ignored);
    if (pose->dim == 2) {
        convert_degrees(pose->degrees, result->q);
        return;
    }
    for (k = 0; k < 4; k++)
        largest = fmax(largest, fabs(pose->q[k]));
    for (k = 0; k < 4; k++)
        result->q[k] = (int32_t)floor(pose->q[k] / largest * TURN_3D + 0.5);
}

int host_pose_to_grid(const host_pose *pose, double unit, cage_pose *result)
{
    if (pose_reach(pose) / unit > (pose->dim == 2 ? CAGE_REACH_2D : CAGE_REACH_3D))
        return HOST_BAD_INPUT;
    convert_pose(pose, unit, result);
    return HOST_OK;
}

/* ---- the query ----------------------------------------------------------------------------------- */

/* Does the library take this pose? (cage_collides checks its arguments as a proof would.) */
static int32_t check_pose(const cage_scene *scene, const cage_pose *pose)
{
    int32_t answer = cage_collides(scene, pose, CAGE_SIDE_OUTER);

    return answer < 0 ? answer : CAGE_OK;
}

/* Fills the grid at that unit; the library's opinion of it. */
static int32_t convert_query(const host_query *query, double unit, host_grid *grid)
{
    int32_t answer;

    grid->unit = unit;
    grid->rounded = grid->dropped = 0;
    grid->scene.dim = query->dim;
    convert_shape(&query->object, unit, grid->balls[0], grid->balls[1], grid, &grid->scene.object);
    convert_shape(&query->obstacles, unit, grid->balls[2], grid->balls[3], grid, &grid->scene.obstacles);
    convert_pose(&query->start, unit, &grid->start);
    if (query->has_goal)
        convert_pose(&query->goal, unit, &grid->goal);
    answer = cage_scene_check(&grid->scene);
    if (answer == CAGE_OK)
        answer = check_pose(&grid->scene, &grid->start);
    if (answer == CAGE_OK && query->has_goal)
        answer = check_pose(&grid->scene, &grid->goal);
    return answer;
}

/* The finest power of two at which the scene may fit. */
static double finest_unit(double reach, int32_t dim)
{
    int exponent;

    if (reach == 0)
        return 1;
    (void)frexp(reach / reach_limit(dim), &exponent);
    return ldexp(1, exponent); /* more than reach / limit, at most twice as much */
}

static int allocate(const host_query *query, host_grid *grid)
{
    int i;

    memset(grid, 0, sizeof *grid);
    for (i = 0; i < 4; i++) {
        size_t count = (size_t)(i < 2 ? query->object.count : query->obstacles.count) + 1;

        grid->balls[i] = count <= SIZE_MAX / sizeof(cage_ball) ? malloc(count * sizeof(cage_ball)) : NULL;
        if (grid->balls[i] == NULL)
            return -1;
    }
    return 0;
}

int host_to_grid(const host_query *query, double unit, host_grid *grid, host_error *error)
{
    double reach = needed_reach(query);
    double finest = finest_unit(reach, query->dim);
    int32_t answer = CAGE_ERROR_RANGE;
    int tries;

    if (allocate(query, grid) < 0)
        return host_fail(error, HOST_MEMORY, "no memory for the scene");
    if (unit > 0 && reach / unit <= reach_limit(query->dim))
        answer = convert_query(query, unit, grid);
    for (tries = 0; unit == 0 && answer == CAGE_ERROR_RANGE && tries < 8; tries++)
        answer = convert_query(query, ldexp(finest, tries), grid);
    if (answer == CAGE_ERROR_RANGE && unit > 0)
        return host_fail(error, HOST_BAD_INPUT,
                         "--unit %g is too fine: the scene does not fit the grid; %g or more will do", unit,
                         4 * finest);
    if (answer != CAGE_OK)
        return host_fail(error, HOST_BAD_INPUT, "the scene is not accepted: %.200s", cage_error_text(answer));
    return HOST_OK;
}

void host_free_grid(host_grid *grid)
{
    int i;

    for (i = 0; i < 4; i++)
        free(grid->balls[i]);
    memset(grid, 0, sizeof *grid);
}

/* ---- back to doubles ----------------------------------------------------------------------------- */

/* R(q) y in doubles, for any q but zero. */
static void rotate(const int32_t q[4], const int32_t y[3], double result[3])
{
    double w = q[0], a = q[1], b = q[2], c = q[3];
    double n = w * w + a * a + b * b + c * c;
    double y0 = y[0], y1 = y[1], y2 = y[2];

    result[0] = ((w * w + a * a - b * b - c * c) * y0 + 2 * (a * b - w * c) * y1 + 2 * (a * c + w * b) * y2) / n;
    result[1] = (2 * (a * b + w * c) * y0 + (w * w - a * a + b * b - c * c) * y1 + 2 * (b * c - w * a) * y2) / n;
    result[2] = (2 * (a * c - w * b) * y0 + 2 * (b * c + w * a) * y1 + (w * w - a * a - b * b + c * c) * y2) / n;
}

void host_place(const cage_pose *pose, const int32_t point[3], double unit, double result[3])
{
    int k;

    rotate(pose->q, point, result);
    for (k = 0; k < 3; k++)
        result[k] = (result[k] + pose->x[k]) * unit;
}

/* The angle of (w, 0, 0, z), in (-180, 180]; multiples of 90 degrees come out exact. */
static double to_degrees(double w, double z)
{
    double degrees;

    if (w < 0 || (w == 0 && z < 0)) {
        w = -w;
        z = -z;
    }
    if (z == 0 || w == 0)
        return z == 0 ? 0 : 180;
    if (fabs(z) == w)
        return z > 0 ? 90 : -90;
    degrees = atan2(z, w) * (360 / acos(-1.0));
    return degrees <= -180 ? 180 : degrees;
}

void host_from_grid(const cage_pose *pose, const int32_t *pivot, int32_t dim, double unit,
                    host_pose *result)
{
    double moved[3] = { 0 }, size = 0;
    int k;

    memset(result, 0, sizeof *result);
    result->dim = dim;
    if (pivot != NULL)
        rotate(pose->q, pivot, moved);
    for (k = 0; k < dim; k++)
        result->x[k] = (pose->x[k] - moved[k]) * unit;
    result->degrees = dim == 2 ? to_degrees(pose->q[0], pose->q[3]) : 0;
    for (k = 0; k < 4; k++)
        size = hypot(size, pose->q[k]);
    for (k = 0; k < 4; k++)
        result->q[k] = pose->q[k] / size;
}
