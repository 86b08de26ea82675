/* classes: which components of all leaves are connected, and what is known of each class of them. */
#include "survey.h"
#include "grid.h"

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

/* ---- the rotations of a class ---------------------------------------------------------------------------- */

static int64_t dot_of(const int32_t a[4], const int32_t b[4]) /* |entries| <= 2^30, two at most in the plane; else 2^24: < 2^62 */
{
    return (int64_t)a[0] * b[0] + (int64_t)a[1] * b[1] + (int64_t)a[2] * b[2] + (int64_t)a[3] * b[3];
}

/* The quaternion on the side of the other, its largest entry of `bits` bits. */
static void scale(const int64_t from[4], const int32_t toward[4], int32_t bits, int32_t to[4])
{
    uint64_t largest = 0;
    for (int32_t k = 0; k < 4; k++) {
        uint64_t size = (uint64_t)(from[k] < 0 ? -from[k] : from[k]);
        largest = size > largest ? size : largest;
    }
    int32_t less = (int32_t)cage_u64_bits(largest) - bits;
    for (int32_t k = 0; k < 4; k++)
        to[k] = (int32_t)(less > 0 ? from[k] / ((int64_t)1 << less) : from[k] * ((int64_t)1 << -less));
    if (toward && dot_of(to, toward) < 0)
        for (int32_t k = 0; k < 4; k++)
            to[k] = -to[k];
}

/* A middle of the rotations of all classes: any would do. Entries < 2^20 times 2^14 for the largest cells, < 2^26 of them. */
static void find_middles(const struct cage_survey *survey, int32_t side, struct cage_sum *sum)
{
    const struct cage_graph *graph = &survey->proof->graph;
    const struct cage_classes *classes = &survey->classes[side];
    for (int32_t cell = -1; (cell = cage_graph_leaf(graph, cell)) >= 0;)
        for (int32_t k = 0; k < graph->cell[cell].facts[side].nodes; k++) {
            const struct cage_leaf *leaf = &graph->cell[cell];
            struct cage_sum *s = &sum[classes->of[classes->first[cell] + k]];
            int64_t from[4] = {leaf->rotations.q[0], leaf->rotations.q[1], leaf->rotations.q[2], leaf->rotations.q[3]};
            int32_t q[4];
            bool first = s->middle[0] == 0 && s->middle[1] == 0 && s->middle[2] == 0 && s->middle[3] == 0;
            scale(from, first ? NULL : s->middle, 20, q);
            for (int32_t i = 0; i < 4; i++) {
                s->middle[i] = first ? q[i] : s->middle[i];
                s->mean[i] += q[i] * ((int64_t)1 << (graph->fibre->max_level - leaf->cell.level));
            }
        }
    for (int32_t i = 0; i < classes->count; i++) {
        const int64_t *mean = sum[i].mean;
        if (mean[0] != 0 || mean[1] != 0 || mean[2] != 0 || mean[3] != 0)
            scale(mean, NULL, 24, sum[i].middle);
    }
}

/* The largest sine of half the turn from q to a rotation of the cell, in units of 2^-30. Corners within 90 degrees (as
 * quaternions) of q: the cell is then a convex part of that hemisphere, on which the angle from q has its maximum at a
 * corner; and the sine rises with it. Else 1. */
static int32_t sine_of(const struct cage_fibre *fibre, const struct cage_cell *cell, const int32_t q[4])
{
    int32_t corner[8][4], count = fibre->corners(cell, corner), before = 0, after = 0;
    int64_t most = 0;
    for (int32_t i = 0; i < count; i++) {
        int64_t size = cage_turn(q, corner[i]), product = dot_of(q, corner[i]);
        before += product > 0;
        after += product < 0;
        most = size > most ? size : most;
    }
    most = (most + 3) / 4; /* from twice the sine in units of 2^-31 */
    return (before < count && after < count) || most > 1 << 30 ? 1 << 30 : (int32_t)most;
}

static void find_turns(const struct cage_survey *survey, int32_t side, struct cage_sum *sum)
{
    const struct cage_graph *graph = &survey->proof->graph;
    const struct cage_classes *classes = &survey->classes[side];
    find_middles(survey, side, sum);
    sum[CAGE_OUTSIDE].sine = 1 << 30; /* its cells are all */
    for (int32_t cell = -1; (cell = cage_graph_leaf(graph, cell)) >= 0;)
        for (int32_t k = 0; k < graph->cell[cell].facts[side].nodes; k++) {
            struct cage_sum *s = &sum[classes->of[classes->first[cell] + k]];
            int32_t sine = s->sine < 1 << 30 ? sine_of(graph->fibre, &graph->cell[cell].cell, s->middle) : 0;
            s->sine = sine > s->sine ? sine : s->sine;
        }
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
    find_turns(survey, side, sum);
    classes->sum = sum;
    return CAGE_OK;
}
