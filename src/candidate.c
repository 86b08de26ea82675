/* candidate: the inner way of a proof that was not decided, as a path that nobody has certified. */
#include "proof.h"

/* What cage_prove_region shows is what the proof's own search has reached: remembered in a number that inner nodes do not use. All
 * edges may be used again that were left out to look for another way. */
static void set_out(struct cage_proof *proof)
{
    for (int32_t cell = 0; cell < proof->graph.cells; cell++) {
        struct cage_facts *facts = &proof->graph.cell[cell].facts[CAGE_INNER];
        for (int32_t k = 0; k < facts->nodes; k++) {
            struct cage_node *node = &facts->node[k];
            node->inside = node->seen == proof->reach[CAGE_INNER].number;
            for (struct cage_edge *edge = node->edges; edge; edge = edge->next)
                edge->banned = 0;
        }
    }
}

/* Nodes that this search was the first to see have been reached by none. */
static void set_back(struct cage_proof *proof)
{
    for (int32_t cell = 0; cell < proof->graph.cells; cell++) {
        struct cage_facts *facts = &proof->graph.cell[cell].facts[CAGE_INNER];
        for (int32_t k = 0; k < facts->nodes; k++) {
            facts->node[k].seen = facts->node[k].inside == 1 ? proof->reach[CAGE_INNER].number : 0;
            facts->node[k].inside = CAGE_COVERED;
        }
    }
}

/* One step of the search (path false) or of the path, taken again where memory can be found for it, as in cage_proof_step. */
static int32_t step_of(struct cage_proof *proof, bool path)
{
    struct cage_node *leg = proof->leg;
    int32_t done, path_count = proof->path_count;
    do {
        proof->leg = leg;
        proof->path_count = path_count;
        proof->arena.needed = proof->scratch.needed = 0;
        done = path ? cage_path_step(proof) : cage_search(proof, CAGE_INNER);
    } while (done == CAGE_ERROR_MEMORY && cage_proof_make_room(proof));
    return done;
}

/* From the start, not from what the outer search has reached: the search begins there as well where its number is still known.
 * Once more when all of the way is known: then it is the same one whenever it is asked for. */
static int32_t find_way(struct cage_proof *proof)
{
    int32_t done = CAGE_FOUND;
    proof->path = NULL; /* one that failed */
    proof->reach[CAGE_OUTER].number++;
    for (int32_t times = 0; times < 2 && done == CAGE_FOUND; times++) {
        cage_search_anew(proof, CAGE_INNER);
        do
            done = step_of(proof, false);
        while (done == CAGE_WORKED);
    }
    return done;
}

static void note(const struct cage_proof *proof, const struct cage_node *node, cage_step *step)
{
    const struct cage_leaf *leaf = &proof->graph.cell[node->cell];
    cage_so3_turned(leaf->rotations.q, proof->turned, step->q);
    step->level = node->cell < CAGE_CELL_ROOT ? -1 : leaf->cell.level;
    step->component = node->component;
    step->pose = proof->path_count;
}

/* The steps and the poses of the way. Where the search has gone from the goal the path is turned round in the end, and so are the
 * steps: the first pose of each was then the last of its leg. */
static int32_t write_down(struct cage_proof *proof, cage_step *step, int32_t steps, int32_t count[2])
{
    const bool turned = proof->origin == CAGE_CELL_GOAL;
    int32_t done = 0, all = 0;
    cage_path_begin(proof, CAGE_INNER);
    for (const struct cage_node *node = proof->leg; node; node = node->next_open)
        all++;
    for (int32_t i = 0; done == 0; i++) {
        const int32_t at = turned ? all - 1 - i : i;
        if (at < steps)
            note(proof, proof->leg, &step[at]);
        done = step_of(proof, true);
        if (at < steps && turned)
            step[at].pose = proof->path_count; /* to be taken from all of them */
    }
    if (done != 1)
        return done == CAGE_PATH_FAILED ? 0 : done;
    count[0] = all;
    count[1] = proof->path_count;
    for (int32_t i = 0; turned && i < all && i < steps; i++)
        step[i].pose = proof->path_count - step[i].pose;
    return 1;
}

int32_t cage_prove_candidate(cage_proof *proof, cage_step *step, int32_t steps, cage_pose *path, int32_t poses, int32_t count[2])
{
    if (!proof || !count || steps < 0 || poses < 0 || (steps && !step) || (poses && !path))
        return CAGE_ERROR_ARGUMENT;
    count[0] = count[1] = 0;
    if (proof->error != CAGE_OK)
        return proof->error;
    if (proof->total.verdict == CAGE_UNDEFINED && !cage_proof_is_done(proof))
        return CAGE_ERROR_ARGUMENT;
    if (proof->total.verdict != CAGE_UNDEFINED || !proof->reach[CAGE_INNER].start)
        return 0;
    const struct cage_result kept = proof->result; /* this is no work of the proof */
    const size_t peak = proof->arena.peak, scratch_peak = proof->scratch.peak;
    set_out(proof);
    int32_t done = find_way(proof);
    done = done == CAGE_FOUND ? write_down(proof, step, steps, count) : done < 0 ? done : 0;
    if (done == CAGE_ERROR_MEMORY)
        proof->total.needed_bytes = cage_prove_needed(proof);
    for (int32_t i = 0; i < count[1] && i < poses; i++)
        path[i] = proof->path[i];
    set_back(proof);
    proof->result = kept;
    proof->arena.peak = peak;
    proof->scratch.peak = scratch_peak;
    return done;
}
