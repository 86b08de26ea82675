/* graph: cells, the components of their slices as nodes, and what gluing found out about them as edges. */
#include "graph.h"

#include <string.h>

static void add_cell(struct cage_graph *graph, const struct cage_cell *cell, int32_t parent)
{
    struct cage_leaf *leaf = &graph->cell[graph->cells++];
    memset(leaf, 0, sizeof *leaf);
    leaf->cell = *cell;
    leaf->parent = parent;
    graph->fibre->representative(cell, leaf->rotations.q);
    leaf->rotations.turn = graph->fibre->turn(cell);
    graph->level = cell->level > graph->level ? cell->level : graph->level;
}

bool cage_graph_refine(struct cage_graph *graph, int32_t cell)
{
    if (graph->cells + graph->fibre->children > graph->capacity)
        return false;
    for (int32_t next = -1; (next = cage_graph_neighbour(graph, cell, next)) >= 0;)
        for (int32_t side = 0; side < CAGE_SIDES; side++)
            for (int32_t k = 0; k < graph->cell[next].facts[side].nodes; k++)
                graph->cell[next].facts[side].node[k].settled = 0;
    graph->cell[cell].child = graph->cells;
    for (int32_t i = 0; i < graph->fibre->children; i++) {
        struct cage_cell child;
        graph->fibre->child(&graph->cell[cell].cell, i, &child);
        add_cell(graph, &child, cell);
    }
    return true;
}

bool cage_graph_init(struct cage_graph *graph, int32_t level)
{
    if (graph->fibre->roots + CAGE_CELL_ROOT > graph->capacity)
        return false;
    for (int32_t face = 0; face < graph->fibre->roots; face++) {
        const struct cage_cell root = {0, face, {0, 0, 0}};
        add_cell(graph, &root, -1);
    }
    for (int32_t cell = CAGE_CELL_ROOT; cell < graph->cells; cell++)
        if (graph->cell[cell].cell.level < level && !cage_graph_refine(graph, cell))
            return false;
    return true;
}

static bool touches(const struct cage_graph *graph, int32_t cell, int32_t other)
{
    if (cell < CAGE_CELL_ROOT)
        return graph->fibre->contains(&graph->cell[other].cell, graph->cell[cell].rotations.q);
    return graph->fibre->touch(&graph->cell[cell].cell, &graph->cell[other].cell);
}

/* The tree's next cell in depth first order that is not below `cell`; -1: no more. */
static int32_t skip_below(const struct cage_graph *graph, int32_t cell)
{
    for (;;) {
        int32_t parent = graph->cell[cell].parent;
        int32_t first = parent < 0 ? CAGE_CELL_ROOT : graph->cell[parent].child;
        int32_t siblings = parent < 0 ? graph->fibre->roots : graph->fibre->children;
        if (cell + 1 < first + siblings)
            return cell + 1;
        if (parent < 0)
            return -1;
        cell = parent;
    }
}

int32_t cage_graph_leaf(const struct cage_graph *graph, int32_t after)
{
    int32_t at = after < 0 ? CAGE_CELL_ROOT : skip_below(graph, after);
    while (at >= 0 && graph->cell[at].child)
        at = graph->cell[at].child;
    return at;
}

int32_t cage_graph_neighbour(const struct cage_graph *graph, int32_t cell, int32_t after)
{
    int32_t at = after + 1;
    if (cell < CAGE_CELL_ROOT)
        at = at < CAGE_CELL_ROOT ? CAGE_CELL_ROOT : at;
    for (; at < CAGE_CELL_ROOT; at++)
        if ((at == CAGE_CELL_START || graph->goal) && touches(graph, at, cell))
            return at;
    if (after >= CAGE_CELL_ROOT)
        at = skip_below(graph, after);
    while (at >= 0) {
        if (at == cell || !touches(graph, cell, at))
            at = skip_below(graph, at);
        else if (graph->cell[at].child)
            at = graph->cell[at].child;
        else
            return at;
    }
    return -1;
}

bool cage_graph_is_glued(const struct cage_node *node, int32_t with)
{
    const struct cage_glued *glued = node->glued;
    while (glued && glued->with != with)
        glued = glued->next;
    return glued != NULL;
}

int32_t cage_graph_add_nodes(struct cage_graph *graph, int32_t side, int32_t cell, int32_t components)
{
    struct cage_facts *facts = &graph->cell[cell].facts[side];
    struct cage_node *node = cage_arena_take(graph->arena, (size_t)components, sizeof *node);
    if (!node)
        return CAGE_ERROR_MEMORY;
    memset(node, 0, (size_t)components * sizeof *node);
    for (int32_t k = 0; k < components; k++) {
        node[k].cell = cell;
        node[k].component = k;
        node[k].inside = CAGE_COVERED;
    }
    facts->node = node;
    facts->nodes = components;
    return CAGE_OK;
}

static void add_edge(struct cage_edge *edge, struct cage_node *from, struct cage_node *to, const int32_t x[3])
{
    memcpy(edge->x, x, sizeof edge->x);
    edge->to = to;
    edge->banned = 0;
    edge->next = from->edges;
    from->edges = edge;
}

/* Once for each node and cell. False when memory runs out. */
static bool add_glued(struct cage_graph *graph, struct cage_node *node, int32_t with)
{
    if (cage_graph_is_glued(node, with))
        return true;
    struct cage_glued *glued = cage_arena_take(graph->arena, 1, sizeof *glued);
    if (!glued)
        return false;
    glued->with = with;
    glued->next = node->glued;
    node->glued = glued;
    return true;
}

static bool joined(const struct cage_node *k, const struct cage_node *l)
{
    const struct cage_edge *edge = k->edges;
    while (edge && edge->to != l)
        edge = edge->next;
    return edge != NULL;
}

/* Is there room for that many edges and records, and some? Nothing is taken. */
static bool has_room(struct cage_arena *arena, size_t edges, size_t records)
{
    size_t mark = arena->used, peak = arena->peak;
    bool room = cage_arena_take(arena, edges, 2 * sizeof(struct cage_edge) + CAGE_ALIGN) &&
                cage_arena_take(arena, records, sizeof(struct cage_glued) + CAGE_ALIGN);
    cage_arena_release(arena, mark);
    arena->peak = peak;
    return room;
}

int32_t cage_graph_add_gluing(struct cage_graph *graph, int32_t side, int32_t a, int32_t b, int32_t seed,
                              const struct cage_touch *touch, int32_t count)
{
    struct cage_facts *at = &graph->cell[a].facts[side], *bt = &graph->cell[b].facts[side];
    bool done = has_room(graph->arena, (size_t)count, 2 * (size_t)count + (size_t)at->nodes + (size_t)bt->nodes);
    for (int32_t i = 0; i < count && done; i++) {
        struct cage_node *k = &at->node[touch[i].k], *l = &bt->node[touch[i].l];
        if (joined(k, l))
            continue; /* one is an outside, and the other was glued before */
        struct cage_edge *edge = cage_arena_take(graph->arena, 2, sizeof *edge);
        if (!edge)
            return CAGE_ERROR_MEMORY;
        add_edge(&edge[0], k, l, touch[i].x);
        add_edge(&edge[1], l, k, touch[i].x);
    }
    for (int32_t i = 0; i < count && done && seed != CAGE_ALL; i++)
        done = (touch[i].k == CAGE_OUTSIDE || add_glued(graph, &at->node[touch[i].k], b)) &&
               (touch[i].l == CAGE_OUTSIDE || add_glued(graph, &bt->node[touch[i].l], a));
    for (int32_t k = 0; k < at->nodes && done; k++)
        done = (seed != CAGE_ALL && seed != k) || add_glued(graph, &at->node[k], b);
    for (int32_t l = 0; l < bt->nodes && done && seed == CAGE_ALL; l++)
        done = add_glued(graph, &bt->node[l], a);
    return done ? CAGE_OK : CAGE_ERROR_MEMORY;
}
