/* outer: the outer side of a search.
 *
 *     START    where the inner side is not asked for: build the slices of start and goal
 *     OUTER    try to reach the target in the outer slices, along the inner way: a path proves FREE / CONNECTED; when it has
 *              come farther but not there, INNER again, from what it has reached
 *     PATH     write the path down, leg by leg
 *     SHORTEN  and shorten it */
#include "certify.h"
#include "grid.h"
#include "proof.h"

/* The outer side needs some clearance: where an end has none, look for a free leg to a place that has. */
static void find_clearance(struct cage_proof *proof, const struct cage_slice *slice, int32_t end)
{
    const int32_t *at = proof->at[end], *q = proof->graph.cell[end].rotations.q;
    int32_t reach = proof->scene.dim == 2 ? CAGE_REACH_2D : CAGE_REACH_3D;
    int32_t *label = &proof->label[CAGE_OUTER][end];
    for (int32_t k = 0; k < 3; k++)
        proof->outer_at[end][k] = at[k];
    for (int32_t size = 16; *label == CAGE_COVERED && size < reach / 4; size *= 4)
        for (int32_t i = 0; i < 27 && *label == CAGE_COVERED; i++) {
            const int32_t toward[3] = {i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1};
            const int32_t to[3] = {at[0] + size * toward[0], at[1] + size * toward[1], at[2] + size * toward[2]};
            bool inside = proof->scene.dim == 3 || toward[2] == 0;
            for (int32_t k = 0; k < 3; k++)
                inside = inside && to[k] >= -reach && to[k] <= reach;
            int32_t there = inside ? cage_slice_locate(slice, to) : CAGE_COVERED;
            if (there == CAGE_COVERED || !cage_certify_leg(&proof->scene, proof->result.pivot, q, at, to, 0))
                continue;
            *label = there;
            for (int32_t k = 0; k < 3; k++)
                proof->outer_at[end][k] = to[k];
        }
}

static int32_t find_ends(struct cage_proof *proof)
{
    const struct cage_slice *slice;
    int32_t end, done = cage_search_ends(proof, CAGE_OUTER, &end, &slice);
    if (done == CAGE_WORKED)
        find_clearance(proof, slice, end);
    return done;
}

static int32_t step_outer_start(struct cage_proof *proof)
{
    int32_t done = find_ends(proof);
    if (done != CAGE_FOUND)
        return done;
    cage_proof_choose_origin(proof, CAGE_OUTER);
    proof->phase = CAGE_PHASE_OUTER;
    return CAGE_OK;
}

/* Start or goal is too close to an obstacle to begin at, and no free leg was found to a better place. */
static bool outer_is_lost(const struct cage_proof *proof)
{
    bool lost = false;
    for (int32_t end = CAGE_CELL_START; end <= (proof->graph.goal ? CAGE_CELL_GOAL : CAGE_CELL_START); end++)
        lost = lost || (proof->graph.cell[end].facts[CAGE_OUTER].nodes > 0 && proof->label[CAGE_OUTER][end] == CAGE_COVERED);
    return lost;
}

static int32_t step_outer(struct cage_proof *proof)
{
    struct cage_node *way = proof->way;
    int32_t done = find_ends(proof);
    done = done == CAGE_FOUND ? cage_search(proof, CAGE_OUTER) : done;
    if (done == CAGE_CLOSED && outer_is_lost(proof)) {
        if (!(proof->limits.side & CAGE_SIDE_INNER) || proof->hopeless)
            return cage_proof_finish(proof, CAGE_UNDEFINED, CAGE_REASON_LEVEL);
        proof->outer_lost = true;
    }
    if (done == CAGE_FOUND) {
        cage_path_begin(proof, CAGE_OUTER);
        proof->phase = CAGE_PHASE_PATH;
        return CAGE_OK;
    }
    proof->way = way;
    if (done != CAGE_CLOSED)
        return done;
    proof->phase = CAGE_PHASE_REFINE;
    if (proof->corridor > 0 && (proof->limits.side & CAGE_SIDE_INNER) && !proof->outer_lost &&
        proof->outer_work < proof->result.slices[CAGE_OUTER] + proof->result.gluings[CAGE_OUTER]) {
        cage_search_anew(proof, CAGE_INNER); /* there may be a better way from where it has come */
        proof->phase = CAGE_PHASE_INNER;
    }
    return CAGE_OK;
}

static int32_t step_path(struct cage_proof *proof)
{
    int32_t done = cage_path_step(proof);
    if (done == 1) {
        cage_shorten_begin(proof);
        proof->phase = CAGE_PHASE_SHORTEN;
        return CAGE_OK;
    }
    if (done != CAGE_PATH_FAILED)
        return done;
    /* The way exists, but no leg on the grid was certified for it: leave this edge out and look for another. */
    struct cage_node *leg = proof->leg, *next = leg ? leg->next_open : NULL;
    if (!leg || (!leg->via && !next))
        return cage_proof_finish(proof, CAGE_UNDEFINED, CAGE_REASON_LEVEL);
    (leg->via ? leg : next)->via->banned = 1;
    cage_proof_last_resort(proof, CAGE_REASON_LEVEL);
    return CAGE_OK;
}

static bool path_is_clear(const struct cage_proof *proof)
{
    return cage_path_check(&proof->scene, &proof->pose[0], proof->graph.goal ? &proof->pose[1] : NULL, proof->result.pivot,
                           proof->path, proof->path_count) == 1;
}

static int32_t step_shorten(struct cage_proof *proof)
{
    if (!cage_shorten_step(proof))
        return CAGE_OK;
    proof->path_count = proof->path_kept;
    if (!path_is_clear(proof))
        return cage_proof_finish(proof, CAGE_UNDEFINED, CAGE_REASON_LEVEL);
    proof->result.path = proof->path;
    proof->result.path_count = proof->path_count;
    return cage_proof_finish(proof, proof->graph.goal ? CAGE_CONNECTED : CAGE_FREE, CAGE_REASON_PATH);
}

static int32_t step_any(struct cage_proof *proof)
{
    switch (proof->phase) {
    case CAGE_PHASE_START:
        return proof->limits.side & CAGE_SIDE_INNER ? cage_proof_step_inner(proof) : step_outer_start(proof);
    case CAGE_PHASE_OUTER:
        return step_outer(proof);
    case CAGE_PHASE_PATH:
        return step_path(proof);
    case CAGE_PHASE_SHORTEN:
        return step_shorten(proof);
    default:
        return cage_proof_step_inner(proof);
    }
}

/* cage_prove_run_inner has such a loop of its own, so that nothing leads from it to the code for paths. */
int32_t cage_proof_step(struct cage_proof *proof)
{
    struct cage_node *leg = proof->leg;
    int32_t error, path_count = proof->path_count;
    proof->outer_steps += proof->phase == CAGE_PHASE_OUTER;
    do {
        proof->leg = leg;
        proof->path_count = path_count;
        proof->arena.needed = proof->scratch.needed = 0;
        error = step_any(proof);
    } while (error == CAGE_ERROR_MEMORY && cage_proof_make_room(proof));
    proof->result.steps++;
    proof->error = error < 0 ? error : CAGE_OK;
    return proof->error;
}
