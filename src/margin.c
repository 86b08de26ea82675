/* margin: how much every ball may shrink before a closed way opens, or must grow before an open one closes.
 *
 * The smaller the balls, the freer the object: what is joined stays joined. So the size at which the answer changes is found by
 * bisection, each time by a proof of its own; between the last closed answer and the first open one, proofs that limits
 * leave undefined may stay. */
#include "arena.h"
#include "body.h"
#include "grid.h"

#include <string.h>

enum { CLOSED = 0, OPEN = 1, UNKNOWN = 2 };

struct trial {
    const cage_scene *scene;
    const cage_pose *start, *goal;
    const cage_limits *limits;
    cage_ball *ball[4]; /* the object's inner and outer balls, the obstacles', of another size */
    unsigned char *memory;
    size_t bytes;
    cage_margin result;
};

/* What is left of the balls when each radius shrinks by so much; how many, or an error. */
static int32_t shrink(const cage_ball *ball, int32_t count, int32_t by, cage_ball *out)
{
    int32_t left = 0;
    for (int32_t i = 0; i < count; i++)
        if (ball[i].r >= by) { /* r, |by| < 2^29 */
            out[left] = ball[i];
            out[left++].r -= by;
        }
    return left;
}

static void make_scene(const struct trial *trial, int32_t by, cage_scene *out)
{
    const cage_scene *scene = trial->scene;
    const cage_shape *from[2] = {&scene->object, &scene->obstacles};
    cage_shape *to[2] = {&out->object, &out->obstacles};
    out->dim = scene->dim;
    for (int32_t k = 0; k < 2; k++) {
        to[k]->inner_count = shrink(from[k]->inner, from[k]->inner_count, by, trial->ball[2 * k]);
        to[k]->outer_count = shrink(from[k]->outer, from[k]->outer_count, by, trial->ball[2 * k + 1]);
        to[k]->inner = trial->ball[2 * k];
        to[k]->outer = trial->ball[2 * k + 1];
    }
}

/* The least distance of two outer balls at a pose of the pivot, in grid units, negative when they overlap; off by 2 at most. */
static int32_t clearance(const cage_scene *scene, const int32_t pivot[3], const cage_pose *pose)
{
    int32_t least = INT32_MAX;
    struct cage_rotation rotation;
    cage_rotation_of(pose->q, &rotation);
    for (int32_t i = 0; i < scene->object.outer_count; i++) {
        const cage_ball *y = &scene->object.outer[i];
        const int32_t from[3] = {y->x - pivot[0], y->y - pivot[1], y->z - pivot[2]};
        int32_t at[3];
        cage_rotate(&rotation, from, at);
        for (int32_t j = 0; j < scene->obstacles.outer_count; j++) {
            const cage_ball *x = &scene->obstacles.outer[j];
            cage_i128 square = cage_i128_of(0); /* a path may go far outside: differences < 2^32 */
            for (int32_t k = 0; k < 3; k++) {
                int64_t apart = (int64_t)pose->x[k] + at[k] - (k == 0 ? x->x : k == 1 ? x->y : x->z);
                square = cage_i128_add(square, cage_i128_mul(apart, apart));
            }
            int64_t gap = (int64_t)cage_u128_root(square) - x->r - y->r;
            least = gap < least ? (int32_t)gap : least;
        }
    }
    return least;
}

/* Length of the leg, rounded down, and at least 1; coordinates < 2^31. */
static int64_t length_of(const cage_pose *from, const cage_pose *to)
{
    cage_i128 square = cage_i128_of(1);
    for (int32_t k = 0; k < 3; k++) {
        int64_t by = (int64_t)to->x[k] - from->x[k];
        square = cage_i128_add(square, cage_i128_mul(by, by));
    }
    return (int64_t)cage_u128_root(square);
}

/* The place on the path's poses and straight legs where the balls as given come closest, or overlap most, as finely as PARTS of
 * a leg. Moved by some length, the clearance changes by no more than that, so wide places are passed quickly. */
static void find_narrow(struct trial *trial, const cage_result *proof)
{
    enum { PARTS = 1024 };
    cage_margin *result = &trial->result;
    int32_t least = INT32_MAX;
    for (int32_t n = 0; n < proof->path_count; n++) {
        const cage_pose *from = &proof->path[n], *to = n + 1 < proof->path_count ? from + 1 : from;
        int64_t length = length_of(from, to), part = 0;
        while (part == 0 || (part < PARTS && length > 1)) { /* a turn is looked at where it begins */
            cage_pose pose = *from;
            for (int32_t k = 0; k < 3; k++)
                pose.x[k] += (int32_t)(((int64_t)to->x[k] - from->x[k]) * part / PARTS);
            int32_t gap = clearance(trial->scene, proof->pivot, &pose);
            if (gap < least) {
                least = gap;
                result->narrow = pose;
                for (int32_t k = 0; k < 3; k++)
                    result->pivot[k] = proof->pivot[k];
            }
            part += 1 + ((int64_t)gap - least) * PARTS / length; /* < 2^33 2^10 */
        }
    }
    result->known = least < INT32_MAX;
}

/* Ask with balls that are smaller by so much: CLOSED, OPEN, UNKNOWN, or an error. */
static int32_t ask(struct trial *trial, int32_t by)
{
    cage_scene scene;
    cage_proof *proof;
    make_scene(trial, by, &scene);
    int32_t state = cage_prove_begin(&proof, &scene, trial->start, trial->goal, trial->limits, trial->memory, trial->bytes);
    if (state == CAGE_OK)
        state = cage_prove_run(proof, INT64_MAX);
    if (state < 0)
        return state;
    const cage_result *result = cage_prove_result(proof);
    trial->result.proofs++;
    switch (result->verdict) {
    case CAGE_FREE:
    case CAGE_CONNECTED:
        find_narrow(trial, result);
        return OPEN;
    case CAGE_CAGED:
    case CAGE_DISCONNECTED:
    case CAGE_IN_COLLISION:
        return CLOSED;
    default:
        return UNKNOWN;
    }
}

static int32_t largest_radius(const cage_scene *scene)
{
    int32_t most = 0;
    for (int32_t i = 0; i < scene->object.outer_count; i++)
        most = scene->object.outer[i].r > most ? scene->object.outer[i].r : most;
    for (int32_t i = 0; i < scene->object.inner_count; i++)
        most = scene->object.inner[i].r > most ? scene->object.inner[i].r : most;
    return most;
}

/* Sizes from `closed` to `low` and from `high` to `open` are not tried yet; between low and high none was decided. */
static int32_t bisect(struct trial *trial, int32_t rounds)
{
    cage_margin *result = &trial->result;
    int32_t low = result->open, high = result->closed;
    while (rounds-- > 0) {
        bool below = low - result->closed >= result->open - high;
        int32_t from = below ? result->closed : high, to = below ? low : result->open;
        if (to - from < 2)
            break;
        int32_t middle = from + (to - from) / 2, answer = ask(trial, middle);
        if (answer < 0)
            return answer;
        if (answer == CLOSED) {
            result->closed = middle;
            high = high < middle ? middle : high;
        } else if (answer == OPEN) {
            result->open = middle;
            low = low > middle ? middle : low;
        } else {
            low = low > middle ? middle : low;
            high = high < middle ? middle : high;
        }
    }
    return CAGE_OK;
}

int32_t cage_margin_find(const cage_scene *scene, const cage_pose *start, const cage_pose *goal, const cage_limits *limits,
                         int32_t rounds, void *memory, size_t bytes, cage_margin *out)
{
    if (!scene || !start || !out || rounds < 0 || (!memory && bytes))
        return CAGE_ERROR_ARGUMENT;
    int32_t error = cage_scene_check(scene);
    if (error != CAGE_OK)
        return error;
    struct cage_arena arena;
    const cage_margin nothing = {0, 0, 0, 0, 0, {0, 0, 0}, {{0, 0, 0}, {1, 0, 0, 0}}};
    struct trial trial = {scene, start, goal, limits, {NULL, NULL, NULL, NULL}, NULL, 0, nothing};
    const int32_t count[4] = {scene->object.inner_count, scene->object.outer_count, scene->obstacles.inner_count,
                              scene->obstacles.outer_count};
    cage_arena_init(&arena, memory, bytes);
    for (int32_t k = 0; k < 4; k++) {
        trial.ball[k] = cage_arena_take(&arena, (size_t)count[k], sizeof *trial.ball[k]);
        if (!trial.ball[k])
            return CAGE_ERROR_MEMORY;
    }
    trial.memory = arena.base + arena.used;
    trial.bytes = arena.size - arena.used;
    int32_t answer = ask(&trial, 0), most = largest_radius(scene) + 1;
    if (answer < 0)
        return answer;
    /* With no object ball left everything is open. Growing, the start itself collides in the end. */
    trial.result.open = answer == OPEN ? 0 : most;
    trial.result.closed = answer == CLOSED ? 0 : -1;
    while (answer != CLOSED && (answer = ask(&trial, trial.result.closed)) != CLOSED) {
        if (answer == CAGE_ERROR_RANGE || trial.result.closed < -(1 << 28))
            break; /* it cannot grow on this grid, or nothing grows: closed is not known to be */
        if (answer < 0)
            return answer;
        trial.result.open = answer == OPEN ? trial.result.closed : trial.result.open;
        trial.result.closed *= 2;
    }
    error = answer == CLOSED ? bisect(&trial, rounds) : CAGE_OK;
    trial.result.bounded = answer == CLOSED;
    if (error == CAGE_OK)
        *out = trial.result;
    return error;
}
