/* classes: which components of all leaves are connected, and what is known of each class of them. */
#include "survey.h"

#include <string.h>

int32_t cage_classes_node(const struct cage_survey *survey, int32_t side, const struct cage_node *node)
{
    return survey->classes[side].first[node->cell] + node->component;
}

static int32_t root_of(int32_t *parent, int32_t node)
{
    while (parent[node] != node)
        node = parent[node] = parent[parent[node]];
    return node;
}

int32_t cage_classes_make(struct cage_survey *survey, int32_t side)
{
    const struct cage_graph *graph = &survey->proof->graph;
    struct cage_classes *classes = &survey->classes[side];
    int32_t nodes = 0;
    if (!classes->first)
        classes->first = cage_arena_take(graph->arena, (size_t)graph->capacity, sizeof *classes->first);
    if (!classes->first)
        return CAGE_ERROR_MEMORY;
    for (int32_t cell = -1; (cell = cage_graph_leaf(graph, cell)) >= 0;) {
        classes->first[cell] = nodes;
        nodes += graph->cell[cell].facts[side].nodes;
    }
    if (nodes > classes->nodes || !classes->of)
        classes->of = cage_arena_take(graph->arena, (size_t)nodes, sizeof *classes->of);
    if (!classes->of)
        return CAGE_ERROR_MEMORY;
    int32_t *parent = classes->of;
    classes->nodes = nodes;
    classes->edges = 0;
    for (int32_t n = 0; n < nodes; n++)
        parent[n] = n;
    for (int32_t cell = -1; (cell = cage_graph_leaf(graph, cell)) >= 0;) {
        const struct cage_facts *facts = &graph->cell[cell].facts[side];
        for (int32_t k = 0; k < facts->nodes; k++)
            for (const struct cage_edge *edge = facts->node[k].edges; edge; edge = edge->next) {
                if (graph->cell[edge->to->cell].child)
                    continue;
                int32_t a = root_of(parent, classes->first[cell] + k);
                int32_t b = root_of(parent, cage_classes_node(survey, side, edge->to));
                parent[a > b ? a : b] = a < b ? a : b; /* a root is the first node of its tree */
                classes->edges++;
            }
    }
    classes->count = 0;
    for (int32_t n = 0; n < nodes; n++) /* a parent comes before its children, and has its class by then: as -1 - class */
        parent[n] = parent[n] == n ? -1 - classes->count++ : parent[parent[n]];
    for (int32_t n = 0; n < nodes; n++)
        parent[n] = -1 - parent[n];
    return CAGE_OK;
}

/* Only edges between leaves, in the order of the nodes they lead to, however they were found. */
static struct cage_edge *in_order(const struct cage_survey *survey, int32_t side, struct cage_edge *edges)
{
    struct cage_edge *list = NULL;
    while (edges) {
        struct cage_edge *edge = edges, **at = &list;
        edges = edge->next;
        if (survey->proof->graph.cell[edge->to->cell].child)
            continue;
        int32_t node = cage_classes_node(survey, side, edge->to);
        while (*at && cage_classes_node(survey, side, (*at)->to) < node)
            at = &(*at)->next;
        edge->next = *at;
        *at = edge;
    }
    return list;
}

static void add(struct cage_sum *sum, const struct cage_extent *by, int32_t leaf, bool outside)
{
    bool first = sum->nodes++ == 0;
    sum->cells += sum->last != leaf;
    sum->last = leaf;
    for (int32_t i = 0; i < 3 && !outside; i++) {
        sum->extent.low[i] = first || by->low[i] < sum->extent.low[i] ? by->low[i] : sum->extent.low[i];
        sum->extent.high[i] = first || by->high[i] > sum->extent.high[i] ? by->high[i] : sum->extent.high[i];
    }
    if (sum->leaf > 0 || !by->known)
        return;
    sum->leaf = leaf + 1;
    for (int32_t i = 0; i < 3; i++)
        sum->extent.at[i] = by->at[i];
}

int32_t cage_classes_sum(struct cage_survey *survey, int32_t side)
{
    const struct cage_graph *graph = &survey->proof->graph;
    struct cage_classes *classes = &survey->classes[side];
    struct cage_sum *sum = cage_arena_take(graph->arena, (size_t)classes->count, sizeof *sum);
    if (!sum)
        return CAGE_ERROR_MEMORY;
    memset(sum, 0, (size_t)classes->count * sizeof *sum);
    for (int32_t i = 0; i < classes->count; i++)
        sum[i].last = -1;
    int32_t leaf = 0;
    for (int32_t cell = -1; (cell = cage_graph_leaf(graph, cell)) >= 0; leaf++)
        for (int32_t k = 0; k < graph->cell[cell].facts[side].nodes; k++) {
            struct cage_node *node = &graph->cell[cell].facts[side].node[k];
            int32_t class = classes->of[classes->first[cell] + k];
            node->edges = in_order(survey, side, node->edges);
            add(&sum[class], &survey->sheet[side][cell].extent[k], leaf, class == CAGE_OUTSIDE);
        }
    classes->sum = sum;
    return CAGE_OK;
}
