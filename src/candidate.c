/* candidate: the inner way of a proof that was not decided, as a path that nobody has certified. */
#include "proof.h"

/* All edges may be used again that were left out to look for another way. */
static void unban(struct cage_graph *graph)
{
    for (int32_t cell = 0; cell < graph->cells; cell++) {
        const struct cage_facts *facts = &graph->cell[cell].facts[CAGE_INNER];
        for (int32_t k = 0; k < facts->nodes; k++)
            for (struct cage_edge *edge = facts->node[k].edges; edge; edge = edge->next)
                edge->banned = 0;
    }
}

/* From the start, not from what the outer search has reached: the search begins there as well where its number is still known. */
static int32_t find_way(struct cage_proof *proof)
{
    unban(&proof->graph);
    proof->reach[CAGE_OUTER].number++;
    cage_search_anew(proof, CAGE_INNER);
    for (;;) {
        int32_t done = cage_search(proof, CAGE_INNER);
        if (done != CAGE_WORKED)
            return done;
    }
}

static void note(const struct cage_proof *proof, const struct cage_node *node, int32_t pose, cage_step *step)
{
    const struct cage_leaf *leaf = &proof->graph.cell[node->cell];
    for (int32_t k = 0; k < 4; k++)
        step->q[k] = leaf->rotations.q[k];
    step->level = node->cell < CAGE_CELL_ROOT ? -1 : leaf->cell.level;
    step->component = node->component;
    step->pose = pose;
}

/* The search may have gone from the goal: the path was turned round then, and so are its steps. */
static void turn_round(cage_step *step, int32_t count, int32_t poses)
{
    for (int32_t i = 0; i < count; i++) /* its last pose was the one before the next one's first */
        step[i].pose = poses - (i + 1 < count ? step[i + 1].pose : poses);
    for (int32_t i = 0, k = count - 1; i < k; i++, k--) {
        cage_step other = step[i];
        step[i] = step[k];
        step[k] = other;
    }
}

int32_t cage_prove_candidate(cage_proof *proof, cage_step *step, int32_t steps, cage_pose *path, int32_t poses, int32_t count[2])
{
    if (!proof || !count || steps < 0 || poses < 0 || (steps && !step) || (poses && !path))
        return CAGE_ERROR_ARGUMENT;
    count[0] = count[1] = 0;
    if (!cage_proof_is_done(proof) || proof->total.verdict != CAGE_UNDEFINED || !(proof->limits.side & CAGE_SIDE_INNER) ||
        !proof->reach[CAGE_INNER].start)
        return 0;
    int32_t done = find_way(proof);
    if (done != CAGE_FOUND)
        return done < 0 ? done : 0;
    cage_path_begin(proof, CAGE_INNER);
    do {
        if (count[0] < steps)
            note(proof, proof->leg, proof->path_count, &step[count[0]]);
        count[0]++;
        done = cage_path_step(proof);
    } while (done == 0);
    if (done < 0)
        return done == CAGE_PATH_FAILED ? 0 : done;
    count[1] = proof->path_count;
    for (int32_t i = 0; i < count[1] && i < poses; i++)
        path[i] = proof->path[i];
    if (proof->origin == CAGE_CELL_GOAL && count[0] <= steps)
        turn_round(step, count[0], count[1]);
    return 1;
}
