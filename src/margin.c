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
    bool last; /* look for the narrow place too */
    bool found; /* `open` was proved */
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
                cage_i128_add_product(&square, apart, apart);
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
        cage_i128_add_product(&square, by, by);
    }
    return (int64_t)cage_u128_root(square);
}

/* How far the outer obstacles reach along an axis: from 0 to 2^29. */
static int64_t obstacles_extent(const cage_scene *scene)
{
    int64_t most = 0;
    for (int32_t j = 0; j < scene->obstacles.outer_count; j++) {
        const cage_ball *a = &scene->obstacles.outer[0], *b = &scene->obstacles.outer[j];
        const int64_t apart[3] = {(int64_t)b->x - a->x, (int64_t)b->y - a->y, (int64_t)b->z - a->z};
        for (int32_t k = 0; k < 3; k++) {
            int64_t far = (apart[k] < 0 ? -apart[k] : apart[k]) + b->r;
            most = far > most ? far : most;
        }
    }
    return most;
}

/* The place on the path's poses and straight legs where the balls as given come closest, or overlap most, as finely as 1 / PARTS
 * of the scene. Moved by some length, the clearance changes by no more than that, so wide places are passed quickly. */
static void find_narrow(struct trial *trial, const cage_result *proof)
{
    enum { PARTS = 2048 };
    cage_margin *result = &trial->result;
    int32_t least = INT32_MAX;
    const int64_t step = 1 + obstacles_extent(trial->scene) / PARTS;
    for (int32_t n = 0; n < proof->path_count; n++) {
        const cage_pose *from = &proof->path[n], *to = n + 1 < proof->path_count ? from + 1 : from;
        int64_t length = length_of(from, to), part = 0;
        while (part == 0 || (part < length && length > 1)) { /* a turn is looked at where it begins */
            cage_pose pose = *from;
            for (int32_t k = 0; k < 3; k++) /* between the two: < 2^31 */
                pose.x[k] += (int32_t)cage_i128_nearest(cage_i128_mul((int64_t)to->x[k] - from->x[k], part), cage_i128_of(length),
                                                        INT64_MAX);
            int32_t gap = clearance(trial->scene, proof->pivot, &pose);
            if (gap < least) {
                least = gap;
                result->narrow = pose;
                for (int32_t k = 0; k < 3; k++)
                    result->pivot[k] = proof->pivot[k];
            }
            part += gap - least > step ? (int64_t)gap - least : step;
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
    if (state == CAGE_ERROR_RANGE && by > 0)
        return UNKNOWN; /* with fewer balls the object's pivot is elsewhere, and so is that of start or goal */
    if (state < 0)
        return state;
    const cage_result *result = cage_prove_result(proof);
    trial->result.proofs++;
    switch (result->verdict) {
    case CAGE_FREE:
    case CAGE_CONNECTED:
        trial->found = true;
        if (trial->last)
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

/* The most that all balls may grow for the scene to fit; it fits without. */
static int32_t room_to_grow(const struct trial *trial)
{
    int32_t fits = 0, bit = 1 << 28;
    for (; bit > 0; bit /= 2) {
        cage_scene scene;
        make_scene(trial, -fits - bit, &scene);
        fits += cage_scene_check(&scene) == CAGE_OK ? bit : 0;
    }
    return fits;
}

/* Ask with larger and larger balls until it is closed, and leave the bounds between which that happens. */
static int32_t grow_all(struct trial *trial, int32_t answer)
{
    const int32_t most = room_to_grow(trial);
    cage_margin *result = &trial->result;
    for (int32_t by = 1; answer != CLOSED && answer >= 0 && -result->closed < most; by *= 2) { /* by < 2^29 */
        int32_t next = by < most ? by : most;
        answer = ask(trial, -next);
        result->closed = -next;
        result->open = answer == OPEN ? -next : result->open;
    }
    return answer;
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
    struct trial trial = {scene, start, goal, limits, {NULL, NULL, NULL, NULL}, NULL, 0, false, false, nothing};
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
    answer = grow_all(&trial, answer);
    if (answer < 0)
        return answer;
    error = answer == CLOSED ? bisect(&trial, rounds) : CAGE_OK;
    trial.result.bounded = answer == CLOSED;
    trial.last = true;
    if (error == CAGE_OK && trial.found)
        error = ask(&trial, trial.result.open);
    error = error > 0 ? CAGE_OK : error;
    if (error == CAGE_OK)
        *out = trial.result;
    return error;
}
