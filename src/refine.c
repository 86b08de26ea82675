/* refine: which cell to cut when the inner side has found a way that the outer side has not. */
#include "proof.h"

static bool refinable(const struct cage_proof *proof, int32_t cell)
{
    return cell >= CAGE_CELL_ROOT && proof->graph.cell[cell].cell.level < proof->limits.max_level;
}

/* Has the outer search reached a component inside this one? */
static bool outer_reached(const struct cage_proof *proof, const struct cage_node *inner)
{
    const struct cage_facts *facts = &proof->graph.cell[inner->cell].facts[CAGE_OUTER];
    for (int32_t k = 0; k < facts->nodes; k++)
        if (facts->node[k].seen == proof->reach[CAGE_OUTER].number && facts->node[k].inside == inner->component)
            return true;
    return false;
}

int32_t cage_refine_choose(const struct cage_proof *proof, struct cage_node *target, struct cage_node **stop)
{
    int32_t coarsest = -1, at_stop = -1;
    *stop = target;
    for (struct cage_node *node = target; node; node = node->from) {
        int32_t level = proof->graph.cell[node->cell].cell.level;
        if (refinable(proof, node->cell) && (coarsest < 0 || level < proof->graph.cell[coarsest].cell.level))
            coarsest = node->cell;
        if (!(proof->limits.side & CAGE_SIDE_OUTER) || (node != target && outer_reached(proof, node)))
            continue;
        *stop = node;
        at_stop = refinable(proof, node->cell) ? node->cell : -1;
        if (node->from && refinable(proof, node->from->cell) &&
            (at_stop < 0 || proof->graph.cell[node->from->cell].cell.level < proof->graph.cell[at_stop].cell.level))
            at_stop = node->from->cell;
    }
    return at_stop >= 0 ? at_stop : coarsest;
}

int32_t cage_refine_coarsest(const struct cage_proof *proof)
{
    int32_t best = -1;
    for (int32_t cell = CAGE_CELL_ROOT; cell < proof->graph.cells; cell++)
        if (proof->graph.cell[cell].child == 0 && refinable(proof, cell) &&
            (best < 0 || proof->graph.cell[cell].cell.level < proof->graph.cell[best].cell.level))
            best = cell;
    return best;
}

