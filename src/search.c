/* search: breadth first over the components of one side, building and gluing slices where it comes. */
#include "grid.h"
#include "proof.h"

int32_t cage_search_make(const struct cage_proof *proof, struct cage_arena *arena, int32_t side, int32_t cell,
                         struct cage_slice *slice)
{
    const struct cage_leaf *leaf = &proof->graph.cell[cell];
    int32_t corner[8][4];
    struct cage_corners corners;
    bool within = cell >= CAGE_CELL_ROOT && proof->graph.fibre->corners(&leaf->cell, corner) == 8;
    if (within)
        cage_corners_of(leaf->rotations.q, corner, &corners);
    return cage_slice_make_within(arena, &proof->side[side], &leaf->rotations, within ? &corners : NULL, slice);
}

static int32_t take_or_make(struct cage_proof *proof, int32_t side, int32_t cell, struct cage_slice *slice)
{
    const struct cage_unit *unit = proof->ahead ? proof->ahead->find(proof->ahead, proof, side, cell, -1, 0, &proof->scratch) : NULL;
    proof->taken = unit;
    if (!unit)
        return cage_search_make(proof, &proof->scratch, side, cell, slice);
    *slice = unit->slice;
    return CAGE_OK;
}

static int32_t hold(struct cage_proof *proof, int32_t side, int32_t cell, const struct cage_slice *slice)
{
    if (cage_store_put(&proof->store, slice, &proof->graph.cell[cell].facts[side].held))
        return CAGE_OK;
    proof->scratch.needed = 0;
    return CAGE_ERROR_MEMORY;
}

/* An outer component lies in an inner one: any of its points tells which. */
static int32_t place_inside(struct cage_proof *proof, const struct cage_slice *outer, int32_t cell)
{
    struct cage_facts *facts = proof->graph.cell[cell].facts;
    struct cage_slice made;
    if (facts[CAGE_INNER].nodes == 0)
        return CAGE_OK;
    size_t mark = proof->scratch.used;
    const struct cage_slice *inner = facts[CAGE_INNER].held ? &facts[CAGE_INNER].held->slice : &made;
    int32_t error = inner == &made ? cage_search_make(proof, &proof->scratch, CAGE_INNER, cell, &made) : CAGE_OK;
    for (int32_t k = 0; k < outer->regions && error == CAGE_OK; k++)
        if (outer->region[k].known)
            facts[CAGE_OUTER].node[k].inside = cage_slice_locate(inner, outer->region[k].point);
    cage_arena_release(&proof->scratch, mark);
    return error;
}

static int32_t build_slice(struct cage_proof *proof, int32_t side, int32_t cell, struct cage_held **held)
{
    struct cage_slice slice;
    size_t mark = proof->scratch.used;
    struct cage_facts *facts = &proof->graph.cell[cell].facts[side];
    int32_t error = take_or_make(proof, side, cell, &slice);
    if (error == CAGE_OK && facts->nodes == 0) {
        size_t before = proof->arena.used;
        error = cage_graph_add_nodes(&proof->graph, side, cell, slice.regions);
        if (error == CAGE_OK && side == CAGE_OUTER)
            error = place_inside(proof, &slice, cell);
        if (error == CAGE_OK) {
            proof->result.slices[side]++;
            proof->result.balls[side] += slice.balls;
            proof->result.inserted[side] += slice.inserted;
        } else { /* as if it had not been tried */
            facts->nodes = 0;
            cage_arena_release(&proof->arena, before);
        }
    }
    if (error == CAGE_OK)
        error = hold(proof, side, cell, &slice);
    cage_arena_release(&proof->scratch, mark);
    *held = facts->held;
    return error;
}

int32_t cage_proof_slice(struct cage_proof *proof, int32_t side, int32_t cell, const struct cage_slice **slice)
{
    struct cage_held *held = proof->graph.cell[cell].facts[side].held;
    int32_t error = held ? CAGE_OK : build_slice(proof, side, cell, &held);
    *slice = error == CAGE_OK ? &held->slice : NULL;
    return error;
}

/* A path needs common points that are on the grid; without one there is no edge on the outer side. */
static int32_t keep_exact(const struct cage_slice *c, const struct cage_slice *d, struct cage_touch *touch, int32_t count)
{
    int32_t kept = 0;
    for (int32_t i = 0; i < count; i++)
        if (cage_slice_locate(c, touch[i].x) == touch[i].k && cage_slice_locate(d, touch[i].x) == touch[i].l)
            touch[kept++] = touch[i];
    return kept;
}

/* Building one may drop the other; in an empty store there is room for both if there ever is. */
int32_t cage_proof_slices(struct cage_proof *proof, int32_t side, int32_t a, int32_t b, const struct cage_slice **c,
                          const struct cage_slice **d)
{
    struct cage_held **first = &proof->graph.cell[a].facts[side].held, **second = &proof->graph.cell[b].facts[side].held;
    for (int32_t attempt = 0; attempt < 2; attempt++) {
        if (attempt > 0)
            cage_store_clear(&proof->store);
        int32_t error = cage_proof_slice(proof, side, a, c);
        if (error == CAGE_OK)
            error = cage_proof_slice(proof, side, b, d);
        if (error != CAGE_OK || (*first && *second))
            return error;
    }
    proof->scratch.needed = 0;
    return CAGE_ERROR_MEMORY;
}

const int32_t *cage_proof_match(const struct cage_proof *proof, int32_t side, int32_t a, int32_t b)
{
    int32_t turn = cage_graph_turn(&proof->graph, a, 0, b);
    return turn > 0 ? proof->side[side].image[turn] : NULL;
}

/* Glue the node's component, and those it is connected with, with cell b. */
static int32_t glue_node(struct cage_proof *proof, int32_t side, const struct cage_node *node, int32_t b)
{
    int32_t a = node->cell;
    const struct cage_slice *c, *d;
    int32_t error = cage_proof_slices(proof, side, a, b, &c, &d);
    if (error != CAGE_OK)
        return error;
    size_t mark = proof->scratch.used;
    const struct cage_unit *unit =
        proof->ahead ? proof->ahead->find(proof->ahead, proof, side, a, b, node->component, &proof->scratch) : NULL;
    struct cage_touch *touch = unit ? unit->touch : NULL;
    int32_t count = unit ? unit->count : 0, mixed = unit ? unit->mixed : 0;
    if (!unit)
        error = cage_glue_matched(&proof->scratch, c, d, cage_proof_match(proof, side, a, b), node->component, &touch, &count,
                                  &mixed);
    if (error == CAGE_OK && side == CAGE_OUTER && mixed)
        count = keep_exact(c, d, touch, count);
    if (error == CAGE_OK)
        error = cage_graph_add_gluing(&proof->graph, side, a, b, node->component, touch, count);
    if (error == CAGE_OK) {
        proof->result.gluings[side]++;
        proof->result.mixtures[side] += mixed;
    }
    cage_arena_release(&proof->scratch, mark);
    return error;
}

static bool node_is_live(const struct cage_proof *proof, const struct cage_node *node)
{
    return proof->graph.cell[node->cell].child == 0;
}

static bool may_enter(const struct cage_proof *proof, int32_t side, int32_t cell)
{
    return side == CAGE_INNER || proof->corridor == 0 || proof->graph.cell[cell].corridor == proof->corridor;
}

int32_t cage_search_unglued(const struct cage_proof *proof, int32_t side, const struct cage_node *node, int32_t after)
{
    int32_t next = cage_graph_neighbour(&proof->graph, node->cell, after);
    while (next >= 0 && (!may_enter(proof, side, next) || cage_graph_is_glued(node, next)))
        next = cage_graph_neighbour(&proof->graph, node->cell, next);
    return next;
}

static void enqueue(struct cage_reach *reach, struct cage_node *node)
{
    if (node->queued)
        return;
    node->queued = 1;
    node->next = NULL;
    if (reach->head)
        reach->tail->next = node;
    else
        reach->head = node;
    reach->tail = node;
}

static void discover(struct cage_proof *proof, int32_t side, struct cage_node *node, struct cage_node *from,
                     struct cage_edge *via)
{
    struct cage_reach *reach = &proof->reach[side];
    if (node->seen == reach->number || !node_is_live(proof, node))
        return;
    node->seen = reach->number;
    node->from = from;
    node->via = via;
    node->next_open = NULL;
    proof->result.reached[side]++;
    enqueue(reach, node);
    if (reach->open_head)
        reach->open_tail->next_open = node;
    else
        reach->open_head = node;
    reach->open_tail = node;
}

/* What the outer search has reached can be reached: begin there as well, so that the way found has the fewest steps that are not
 * proved yet. */
static void discover_confirmed(struct cage_proof *proof)
{
    for (int32_t cell = 0; cell < proof->graph.cells; cell++) {
        const struct cage_facts *facts = proof->graph.cell[cell].facts;
        for (int32_t k = 0; k < facts[CAGE_OUTER].nodes; k++) {
            const struct cage_node *outer = &facts[CAGE_OUTER].node[k];
            if (outer->seen == proof->reach[CAGE_OUTER].number && outer->inside >= 0)
                discover(proof, CAGE_INNER, &facts[CAGE_INNER].node[outer->inside], NULL, NULL);
        }
    }
}

void cage_search_anew(struct cage_proof *proof, int32_t side)
{
    struct cage_reach *reach = &proof->reach[side];
    while (reach->head) {
        reach->head->queued = 0;
        reach->head = reach->head->next;
    }
    reach->open_head = NULL;
    reach->glued = -1;
    reach->number++;
    proof->result.reached[side] = 0;
    if (!reach->start)
        return;
    discover(proof, side, reach->start, NULL, NULL);
    if (side == CAGE_INNER)
        discover_confirmed(proof);
}

static bool is_target(const struct cage_proof *proof, int32_t side, const struct cage_node *node)
{
    int32_t goal = CAGE_CELL_GOAL - proof->origin;
    if (!proof->graph.goal)
        return node->component == CAGE_OUTSIDE;
    return node->cell == goal && node->component == proof->label[side][goal];
}

/* Follow known edges as far as they lead. */
static struct cage_node *follow(struct cage_proof *proof, int32_t side)
{
    struct cage_reach *reach = &proof->reach[side];
    while (reach->head) {
        struct cage_node *node = reach->head;
        if (is_target(proof, side, node))
            return node;
        reach->head = node->next;
        node->queued = 0;
        for (struct cage_edge *edge = node->edges; edge; edge = edge->next)
            if (!edge->banned)
                discover(proof, side, edge->to, node, edge);
    }
    return NULL;
}

void cage_search_known(struct cage_proof *proof, int32_t side)
{
    cage_search_anew(proof, side);
    follow(proof, side);
}

static void follow_again(struct cage_proof *proof, int32_t side, int32_t cell)
{
    const struct cage_facts *facts = &proof->graph.cell[cell].facts[side];
    for (int32_t k = 0; k < facts->nodes; k++)
        if (facts->node[k].seen == proof->reach[side].number)
            enqueue(&proof->reach[side], &facts->node[k]);
}

int32_t cage_search_ends(struct cage_proof *proof, int32_t side, int32_t *end, const struct cage_slice **slice)
{
    for (*end = CAGE_CELL_START; *end <= (proof->graph.goal ? CAGE_CELL_GOAL : CAGE_CELL_START); ++*end)
        if (proof->graph.cell[*end].facts[side].nodes == 0) {
            int32_t error = cage_proof_slice(proof, side, *end, slice);
            if (error == CAGE_OK)
                proof->label[side][*end] = cage_slice_locate(*slice, proof->at[*end]);
            return error;
        }
    return CAGE_FOUND;
}

int32_t cage_search(struct cage_proof *proof, int32_t side)
{
    struct cage_reach *reach = &proof->reach[side];
    if (!reach->start) {
        for (int32_t end = 0; end <= (proof->graph.goal ? 1 : 0); end++)
            if (proof->label[side][end] == CAGE_COVERED)
                return CAGE_CLOSED;
        reach->start = &proof->graph.cell[proof->origin].facts[side].node[proof->label[side][proof->origin]];
        cage_search_anew(proof, side);
    }
    for (;;) {
        proof->way = follow(proof, side);
        if (proof->way)
            return CAGE_FOUND;
        if (!reach->open_head)
            return CAGE_CLOSED;
        struct cage_node *node = reach->open_head;
        int32_t scope = side == CAGE_OUTER && proof->corridor ? proof->corridor : -1;
        bool beside = scope < 0 || proof->graph.cell[node->cell].beside == scope;
        bool settled = node->settled == -1 || node->settled == scope || !beside;
        int32_t other = settled ? -1 : cage_search_unglued(proof, side, node, reach->glued);
        if (other < 0) {
            node->settled = node->settled == -1 ? -1 : scope;
            reach->open_head = node->next_open;
            reach->glued = -1;
            continue;
        }
        const struct cage_slice *slice;
        if (proof->graph.cell[other].facts[side].nodes == 0)
            return cage_proof_slice(proof, side, other, &slice);
        int32_t error = glue_node(proof, side, node, other);
        reach->glued = error == CAGE_OK ? other : reach->glued;
        follow_again(proof, side, node->cell);
        follow_again(proof, side, other);
        return error;
    }
}

