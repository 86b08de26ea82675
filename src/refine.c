/* refine: which cell to cut when the inner side has found a way that the outer side has not. */
#include "proof.h"

/* In the plane a cell where the two sides part is cut unless it is finer than the coarsest beyond by more levels than
 * this. In space such cells lie along a surface, and cutting these first would resolve it without end. */
enum { LEAD = 1 };

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

static bool coarser(const struct cage_proof *proof, int32_t cell, int32_t than)
{
    return refinable(proof, cell) && (than < 0 || proof->graph.cell[cell].cell.level < proof->graph.cell[than].cell.level);
}

int32_t cage_refine_choose(const struct cage_proof *proof, struct cage_node *target, struct cage_node **stop)
{
    int32_t coarsest = -1, at_stop = -1, beyond = -1;
    for (struct cage_node *node = target; node; node = node->from) {
        if (coarser(proof, node->cell, coarsest))
            coarsest = node->cell;
        if (cage_proof_has_outer(proof) && node != target && outer_reached(proof, node))
            continue;
        *stop = node;
        beyond = coarsest;
        at_stop = coarser(proof, node->cell, -1) ? node->cell : -1;
        if (node->from && coarser(proof, node->from->cell, at_stop))
            at_stop = node->from->cell;
    }
    if (at_stop < 0 || beyond < 0)
        return at_stop >= 0 ? at_stop : beyond;
    if (proof->scene.dim == 3)
        return beyond;
    return proof->graph.cell[at_stop].cell.level <= proof->graph.cell[beyond].cell.level + LEAD ? at_stop : beyond;
}

static bool is_reached(const struct cage_proof *proof, int32_t side, int32_t cell)
{
    const struct cage_facts *facts = &proof->graph.cell[cell].facts[side];
    for (int32_t k = 0; k < facts->nodes; k++)
        if (facts->node[k].seen == proof->reach[side].number)
            return true;
    return false;
}

int32_t cage_refine_coarsest(const struct cage_proof *proof)
{
    int32_t best = -1, none = -1;
    for (int32_t cell = CAGE_CELL_ROOT; cell < proof->graph.cells; cell++) {
        if (proof->graph.cell[cell].child != 0)
            continue;
        if (coarser(proof, cell, none))
            none = cell;
        if (coarser(proof, cell, best) && is_reached(proof, CAGE_OUTER, cell))
            best = cell;
    }
    return best >= 0 ? best : none;
}
