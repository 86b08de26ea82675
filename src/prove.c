/* prove: the lazy, adaptive, two-sided search for one query.
 *
 *     START    build the slices of start and goal
 *     INNER    reach what the inner slices connect: closed without the target is the proof of CAGED / DISCONNECTED
 *     OUTER    try to reach the target in the outer slices, along the inner way: a path proves FREE / CONNECTED; when it has
 *              come farther but not there, INNER again, from what it has reached
 *     REFINE   cut the cell where the two sides part, keep the facts, search again
 *     PATH     write the path down, leg by leg
 *     SHORTEN  and shorten it
 *
 * A cell is explored when a search enters it. Facts (slices, gluings of cells that are still leaves) stay; what is reached is
 * searched anew over them after every refinement. */
#include "proof.h"

enum { START = 0, INNER, OUTER, REFINE, PATH, SHORTEN, DONE };

/* Without a way to follow, cells are cut evenly; that stops so many levels before the finest. */
enum { UNGUIDED = 3 };

int32_t cage_proof_finish(struct cage_proof *proof, int32_t verdict, int32_t reason)
{
    proof->result.verdict = verdict;
    proof->result.reason = reason;
    proof->phase = DONE;
    return CAGE_OK;
}

bool cage_proof_is_done(const struct cage_proof *proof)
{
    return proof->phase == DONE;
}

/* The inner side can do no more: outer searches over all cells, cut evenly where they have come. */
static void last_resort(struct cage_proof *proof, int32_t reason)
{
    proof->hopeless = reason;
    proof->corridor = 0;
    proof->phase = OUTER;
    cage_search_anew(proof, CAGE_OUTER);
}

static int32_t step_refine(struct cage_proof *proof)
{
    bool inner = proof->limits.side & CAGE_SIDE_INNER, outer = proof->limits.side & CAGE_SIDE_OUTER;
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
        last_resort(proof, cell >= 0 ? CAGE_REASON_CELLS : CAGE_REASON_LEVEL);
        return CAGE_OK;
    } else {
        /* This way is as fine as it may be. It may be closed all the same, but another may be open. */
        proof->hopeless = CAGE_REASON_LEVEL;
        stop->via->banned = 1;
    }
    cage_search_anew(proof, CAGE_INNER);
    cage_search_anew(proof, CAGE_OUTER);
    proof->phase = inner && !(proof->hopeless && proof->corridor == 0) ? INNER : OUTER;
    return CAGE_OK;
}

static int32_t step_start(struct cage_proof *proof)
{
    int32_t side = proof->limits.side & CAGE_SIDE_INNER ? CAGE_INNER : CAGE_OUTER;
    int32_t done = cage_search_ends(proof, side);
    if (done != CAGE_FOUND)
        return done;
    /* A search that begins outside sees everything; one that begins in a narrow place may close soon. */
    const int32_t *label = proof->label[side];
    /* What does not collide is off the inner balls; were it not so, nothing may be concluded from it. */
    if (side == CAGE_INNER &&
        (label[CAGE_CELL_START] == CAGE_COVERED || (proof->graph.goal && label[CAGE_CELL_GOAL] == CAGE_COVERED)))
        return cage_proof_finish(proof, CAGE_UNDEFINED, CAGE_REASON_LEVEL);
    proof->origin = proof->graph.goal && label[CAGE_CELL_START] == CAGE_OUTSIDE && label[CAGE_CELL_GOAL] != CAGE_OUTSIDE;
    proof->phase = side == CAGE_INNER ? INNER : OUTER;
    return CAGE_OK;
}

static int32_t step_inner(struct cage_proof *proof)
{
    int32_t done = cage_search(proof, CAGE_INNER);
    if (done == CAGE_CLOSED) {
        if (!proof->hopeless)
            return cage_proof_finish(proof, proof->graph.goal ? CAGE_DISCONNECTED : CAGE_CAGED, CAGE_REASON_CLOSED);
        last_resort(proof, proof->hopeless);
        return CAGE_OK;
    }
    if (done != CAGE_FOUND)
        return done;
    if (!(proof->limits.side & CAGE_SIDE_OUTER)) {
        proof->phase = REFINE;
        return CAGE_OK;
    }
    if (cage_proof_spares_outer(proof)) {
        cage_search_known(proof, CAGE_OUTER);
        proof->phase = REFINE;
        return CAGE_OK;
    }
    proof->corridor = ++proof->corridors;
    proof->outer_work = proof->result.slices[CAGE_OUTER] + proof->result.gluings[CAGE_OUTER];
    for (const struct cage_node *node = proof->way; node; node = node->from) {
        proof->graph.cell[node->cell].corridor = proof->corridor;
        for (int32_t next = -1; (next = cage_graph_neighbour(&proof->graph, node->cell, next)) >= 0;)
            proof->graph.cell[next].beside = proof->corridor;
    }
    proof->phase = OUTER;
    cage_search_anew(proof, CAGE_OUTER);
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
    int32_t done = cage_search(proof, CAGE_OUTER);
    if (done == CAGE_CLOSED && outer_is_lost(proof)) {
        if (!(proof->limits.side & CAGE_SIDE_INNER) || proof->hopeless)
            return cage_proof_finish(proof, CAGE_UNDEFINED, CAGE_REASON_LEVEL);
        proof->limits.side = CAGE_SIDE_INNER; /* from now on */
    }
    if (done == CAGE_FOUND) {
        cage_path_begin(proof, CAGE_OUTER);
        proof->phase = PATH;
        return CAGE_OK;
    }
    proof->way = way;
    if (done != CAGE_CLOSED)
        return done;
    proof->phase = REFINE;
    if (proof->corridor > 0 && proof->limits.side == CAGE_SIDE_BOTH &&
        proof->outer_work < proof->result.slices[CAGE_OUTER] + proof->result.gluings[CAGE_OUTER]) {
        cage_search_anew(proof, CAGE_INNER); /* there may be a better way from where it has come */
        proof->phase = INNER;
    }
    return CAGE_OK;
}

static int32_t step_path(struct cage_proof *proof)
{
    int32_t done = cage_path_step(proof);
    if (done == 1) {
        cage_shorten_begin(proof);
        proof->phase = SHORTEN;
        return CAGE_OK;
    }
    if (done != CAGE_PATH_FAILED)
        return done;
    /* The way exists, but no leg on the grid was certified for it: leave this edge out and look for another. */
    struct cage_node *leg = proof->leg, *next = leg ? leg->next_open : NULL;
    if (!leg || (!leg->via && !next))
        return cage_proof_finish(proof, CAGE_UNDEFINED, CAGE_REASON_LEVEL);
    (leg->via ? leg : next)->via->banned = 1;
    last_resort(proof, CAGE_REASON_LEVEL);
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

static int32_t step_phase(struct cage_proof *proof)
{
    switch (proof->phase) {
    case START:
        return step_start(proof);
    case INNER:
        return step_inner(proof);
    case OUTER:
        return step_outer(proof);
    case REFINE:
        return step_refine(proof);
    case PATH:
        return step_path(proof);
    default:
        return step_shorten(proof);
    }
}

int32_t cage_proof_searching(const struct cage_proof *proof)
{
    return proof->phase == INNER ? CAGE_INNER : proof->phase == OUTER ? CAGE_OUTER : -1;
}

int32_t cage_proof_step(struct cage_proof *proof)
{
    struct cage_node *leg = proof->leg;
    int32_t error, path_count = proof->path_count;
    proof->outer_steps += proof->phase == OUTER;
    do {
        proof->leg = leg;
        proof->path_count = path_count;
        proof->arena.needed = proof->scratch.needed = 0;
        error = step_phase(proof);
    } while (error == CAGE_ERROR_MEMORY && cage_proof_make_room(proof));
    proof->result.steps++;
    proof->error = error < 0 ? error : CAGE_OK;
    return proof->error;
}
