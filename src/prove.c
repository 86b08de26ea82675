/* prove: the lazy, adaptive search for one query; its inner side.
 *
 *     START    build the slices of start and goal
 *     INNER    reach what the inner slices connect: closed without the target is the proof of CAGED / DISCONNECTED
 *     REFINE   cut the cell where the two sides part, keep the facts, search again
 *
 * The outer side is in outer.c. Where it is not asked for its code is not needed: cage_prove_run_inner carries none of it.
 *
 * A cell is explored when a search enters it. Facts (slices, gluings of cells that are still leaves) stay; what is reached is
 * searched anew over them after every refinement. */
#include "proof.h"

/* Without a way to follow, cells are cut evenly; that stops so many levels before the finest. */
enum { UNGUIDED = 3 };

int32_t cage_proof_finish(struct cage_proof *proof, int32_t verdict, int32_t reason)
{
    proof->result.verdict = verdict;
    proof->result.reason = reason;
    proof->phase = CAGE_PHASE_DONE;
    return CAGE_OK;
}

bool cage_proof_is_done(const struct cage_proof *proof)
{
    return proof->phase == CAGE_PHASE_DONE;
}

void cage_proof_last_resort(struct cage_proof *proof, int32_t reason)
{
    proof->hopeless = reason;
    proof->corridor = 0;
    proof->phase = CAGE_PHASE_OUTER;
    cage_search_anew(proof, CAGE_OUTER);
}

static int32_t step_refine(struct cage_proof *proof)
{
    bool inner = proof->limits.side & CAGE_SIDE_INNER, outer = cage_proof_has_outer(proof);
    bool guided = inner && (!proof->hopeless || proof->corridor > 0);
    struct cage_node *stop = NULL;
    int32_t cell = guided ? cage_refine_choose(proof, proof->way, &stop) : cage_refine_coarsest(proof);
    if (inner && !guided && cell >= 0 && proof->graph.cell[cell].cell.level + UNGUIDED >= proof->limits.max_level)
        cell = -1;
    if (cell >= 0 && cage_graph_refine(&proof->graph, cell)) {
        proof->result.level = proof->graph.level;
        proof->result.cells = proof->graph.cells - CAGE_CELL_ROOT;
    } else if (!guided || !outer) {
        return cage_proof_finish(proof, CAGE_UNDEFINED, cell >= 0 ? CAGE_REASON_CELLS : CAGE_REASON_LEVEL);
    } else if (cell >= 0 || !stop->via) {
        cage_proof_last_resort(proof, cell >= 0 ? CAGE_REASON_CELLS : CAGE_REASON_LEVEL);
        return CAGE_OK;
    } else {
        /* This way is as fine as it may be. It may be closed all the same, but another may be open. */
        proof->hopeless = CAGE_REASON_LEVEL;
        stop->via->banned = 1;
    }
    cage_search_anew(proof, CAGE_INNER);
    cage_search_anew(proof, CAGE_OUTER);
    proof->phase = inner && !(proof->hopeless && proof->corridor == 0) ? CAGE_PHASE_INNER : CAGE_PHASE_OUTER;
    return CAGE_OK;
}

void cage_proof_choose_origin(struct cage_proof *proof, int32_t side)
{
    /* A search that begins outside sees everything; one that begins in a narrow place may close soon. */
    const int32_t *label = proof->label[side];
    proof->origin = proof->graph.goal && label[CAGE_CELL_START] == CAGE_OUTSIDE && label[CAGE_CELL_GOAL] != CAGE_OUTSIDE;
}

static int32_t step_start(struct cage_proof *proof)
{
    const struct cage_slice *slice;
    int32_t end, done = cage_search_ends(proof, CAGE_INNER, &end, &slice);
    if (done != CAGE_FOUND)
        return done;
    /* What does not collide is off the inner balls; were it not so, nothing may be concluded from it. */
    const int32_t *label = proof->label[CAGE_INNER];
    if (label[CAGE_CELL_START] == CAGE_COVERED || (proof->graph.goal && label[CAGE_CELL_GOAL] == CAGE_COVERED))
        return cage_proof_finish(proof, CAGE_UNDEFINED, CAGE_REASON_LEVEL);
    cage_proof_choose_origin(proof, CAGE_INNER);
    proof->phase = CAGE_PHASE_INNER;
    return CAGE_OK;
}

static int32_t step_inner(struct cage_proof *proof)
{
    int32_t done = cage_search(proof, CAGE_INNER);
    if (done == CAGE_CLOSED) {
        if (!proof->hopeless)
            return cage_proof_finish(proof, proof->graph.goal ? CAGE_DISCONNECTED : CAGE_CAGED, CAGE_REASON_CLOSED);
        cage_proof_last_resort(proof, proof->hopeless);
        return CAGE_OK;
    }
    if (done != CAGE_FOUND)
        return done;
    if (!cage_proof_has_outer(proof)) {
        proof->phase = CAGE_PHASE_REFINE;
        return CAGE_OK;
    }
    if (proof->spares_outer) {
        cage_search_known(proof, CAGE_OUTER);
        proof->phase = CAGE_PHASE_REFINE;
        return CAGE_OK;
    }
    proof->corridor = ++proof->corridors;
    proof->outer_work = proof->result.slices[CAGE_OUTER] + proof->result.gluings[CAGE_OUTER];
    for (const struct cage_node *node = proof->way; node; node = node->from) {
        proof->graph.cell[node->cell].corridor = proof->corridor;
        for (int32_t next = -1; (next = cage_graph_neighbour(&proof->graph, node->cell, next)) >= 0;)
            proof->graph.cell[next].beside = proof->corridor;
    }
    proof->phase = CAGE_PHASE_OUTER;
    cage_search_anew(proof, CAGE_OUTER);
    return CAGE_OK;
}

int32_t cage_proof_searching(const struct cage_proof *proof)
{
    return proof->phase == CAGE_PHASE_INNER ? CAGE_INNER : proof->phase == CAGE_PHASE_OUTER ? CAGE_OUTER : -1;
}

int32_t cage_proof_step_inner(struct cage_proof *proof)
{
    switch (proof->phase) {
    case CAGE_PHASE_START:
        return step_start(proof);
    case CAGE_PHASE_INNER:
        return step_inner(proof);
    default:
        return step_refine(proof);
    }
}

int32_t cage_proof_report(struct cage_proof *proof)
{
    proof->result.peak_bytes = proof->arena.peak + proof->scratch.peak;
    proof->total = proof->result;
    if (proof->error == CAGE_ERROR_MEMORY)
        proof->total.needed_bytes = cage_proof_needed(proof);
    return proof->error != CAGE_OK ? proof->error : cage_proof_is_done(proof);
}

int32_t cage_prove_run_inner(cage_proof *proof, int64_t steps)
{
    if (!proof || proof->second || proof->limits.side != CAGE_SIDE_INNER)
        return CAGE_ERROR_ARGUMENT;
    for (; steps > 0 && proof->phase < CAGE_PHASE_OUTER && proof->error == CAGE_OK; steps--) {
        int32_t error;
        do {
            proof->arena.needed = proof->scratch.needed = 0;
            error = cage_proof_step_inner(proof);
        } while (error == CAGE_ERROR_MEMORY && cage_proof_make_room(proof));
        proof->result.steps++;
        proof->error = error < 0 ? error : CAGE_OK;
    }
    return cage_proof_report(proof);
}
