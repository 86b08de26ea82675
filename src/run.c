/* run: the proof of one question as one or two searches: how it begins, and step by step.
 *
 * In space two searches take turns: the one that follows the inner side's way out, and an outer one with cells of its
 * own, cut evenly. The way that the inner slices leave open is often none there, and cutting along it finds out
 * slowly. The first that has an answer answers for both. */
#include "body.h"
#include "proof.h"

/* Both sides in space, and enough cells for two searches: one for each CAGE_SECOND_CELLS goes to the second. */
static bool has_second(const cage_scene *scene, const cage_limits *limits)
{
    int32_t level = limits->start_level < 0 ? 0 : limits->start_level, least = 4;
    if (scene->dim != 3 || limits->side != CAGE_SIDE_BOTH)
        return false;
    while (level-- > 0)
        least = 8 * least + 4; /* <= max_cells <= 2^24 */
    return limits->max_cells / CAGE_SECOND_CELLS >= least;
}

static void share_limits(cage_limits *first, cage_limits *second)
{
    *second = *first;
    second->side = CAGE_SIDE_OUTER;
    second->max_cells = first->max_cells / CAGE_SECOND_CELLS;
    first->max_cells -= second->max_cells;
}

/* The second search has a third of the block. */
static size_t bytes_of_second(size_t bytes) { return bytes / 3; }

size_t cage_prove_size(const cage_scene *scene, const cage_limits *limits)
{
    cage_limits defaults;
    if (cage_scene_check(scene) != CAGE_OK)
        return 0;
    if (!limits) {
        cage_limits_default(&defaults, scene->dim);
        limits = &defaults;
    }
    if (cage_limits_check(limits, scene->dim) != CAGE_OK)
        return 0;
    uint64_t all = cage_proof_size(scene, limits);
    if (has_second(scene, limits)) {
        cage_limits first = *limits, second;
        share_limits(&first, &second);
        uint64_t other = 3 * cage_proof_size(scene, &second);
        all = cage_proof_size(scene, &first) * 3 / 2;
        all = (all > other ? all : other) + 4 * CAGE_ALIGN;
    }
    return all > SIZE_MAX ? SIZE_MAX : (size_t)all;
}

/* The second search may take one step in so many, and later one in so many: an escape is found early or hardly at
 * all, a cage takes long. So may, late, the outer side of the first. */
enum { EARLY = 16384, SECOND_EARLY = 3, SECOND_LATE = 16, GUIDED_EARLY = 2, GUIDED_LATE = 12 };

/* Is that no more than its share of the steps? */
static bool is_share(int64_t taken, int64_t steps, int32_t early, int32_t late)
{
    return steps < EARLY ? taken * early <= steps : (taken - EARLY / early) * late <= steps - EARLY;
}

/* The search whose turn it is. */
static struct cage_proof *next_search(struct cage_proof *proof)
{
    struct cage_proof *second = proof->second;
    int64_t steps = proof->result.steps;
    if (!second)
        return proof;
    if (!cage_proof_is_done(second) && is_share(second->result.steps + 1, steps, SECOND_EARLY, SECOND_LATE))
        return second;
    proof->spares_outer = steps > EARLY && !is_share(proof->outer_steps, steps, GUIDED_EARLY, GUIDED_LATE);
    return proof;
}

/* Add up the results of both searches. */
static void add_second(struct cage_result *total, const struct cage_proof *second)
{
    const struct cage_result *other = &second->result;
    total->level = other->level > total->level ? other->level : total->level;
    total->cells += other->cells;
    total->slices[CAGE_OUTER] += other->slices[CAGE_OUTER];
    total->gluings[CAGE_OUTER] += other->gluings[CAGE_OUTER];
    total->mixtures[CAGE_OUTER] += other->mixtures[CAGE_OUTER];
    total->reached[CAGE_OUTER] += other->reached[CAGE_OUTER];
    total->balls[CAGE_OUTER] += other->balls[CAGE_OUTER];
    total->inserted[CAGE_OUTER] += other->inserted[CAGE_OUTER];
    total->steps += other->steps;
    total->peak_bytes += second->arena.peak + second->scratch.peak;
    if (other->path) {
        total->verdict = other->verdict;
        total->reason = other->reason;
        total->path = other->path;
        total->path_count = other->path_count;
    }
}

/* Has the first search an answer, or the second a path? */
static bool answered(const struct cage_proof *proof)
{
    return cage_proof_is_done(proof) || (proof->second && proof->second->result.path);
}

uint64_t cage_prove_needed(const struct cage_proof *proof)
{
    if (!proof->second)
        return cage_proof_needed(proof);
    bool other = proof->second->error == CAGE_ERROR_MEMORY;
    uint64_t needed = cage_proof_needed(other ? proof->second : proof);
    return (other ? 3 * needed : needed + needed / 2) + 4 * CAGE_ALIGN;
}

static int32_t report_all(struct cage_proof *proof)
{
    int32_t state = cage_proof_report(proof);
    if (!proof->second)
        return state;
    add_second(&proof->total, proof->second);
    if (proof->error == CAGE_ERROR_MEMORY)
        proof->total.needed_bytes = cage_prove_needed(proof);
    return proof->error != CAGE_OK ? proof->error : answered(proof);
}

int32_t cage_prove_begin(cage_proof **proof, const cage_scene *scene, const cage_pose *start, const cage_pose *goal,
                         const cage_limits *limits, void *memory, size_t bytes)
{
    struct cage_proof *made, *second = NULL;
    cage_limits of_first, of_second;
    int32_t error = proof && (memory || !bytes) ? cage_proof_check(scene, start, goal, limits, CAGE_SIDE_BOTH, &of_first) : CAGE_ERROR_ARGUMENT;
    if (error != CAGE_OK)
        return error;
    bool two = has_second(scene, &of_first);
    size_t part = two ? bytes_of_second(bytes) : 0;
    if (two)
        share_limits(&of_first, &of_second);
    error = cage_proof_begin(&made, scene, start, goal, &of_first, &cage_all_shortcuts, memory, bytes - part);
    if (error == CAGE_OK && two && !cage_proof_is_done(made))
        error = cage_proof_begin(&second, scene, start, goal, &of_second, &cage_all_shortcuts,
                                 (unsigned char *)memory + (bytes - part), part);
    if (error != CAGE_OK)
        return error;
    made->second = second;
    report_all(made);
    *proof = made;
    return CAGE_OK;
}

int32_t cage_prove_run(cage_proof *proof, int64_t steps)
{
    if (!proof)
        return CAGE_ERROR_ARGUMENT;
    for (; steps > 0 && !answered(proof) && proof->error == CAGE_OK; steps--)
        proof->error = cage_proof_step(next_search(proof));
    return report_all(proof);
}

const cage_result *cage_prove_result(const cage_proof *proof)
{
    return proof ? &proof->total : NULL;
}
