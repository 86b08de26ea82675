/* atlas: writes a finished survey as bytes. */
#include "atlas.h"
#include "survey.h"
#include "words.h"

static void put_balls(struct cage_pen *pen, int32_t head, int32_t dim, const cage_ball *ball, int32_t count)
{
    cage_words_put_at(pen, (uint32_t)head, pen->words);
    cage_words_put_at(pen, (uint32_t)head + 1, (uint32_t)count);
    for (int32_t i = 0; i < count; i++) {
        cage_words_put(pen, (uint32_t)ball[i].x);
        cage_words_put(pen, (uint32_t)ball[i].y);
        if (dim == 3)
            cage_words_put(pen, (uint32_t)ball[i].z);
        cage_words_put(pen, (uint32_t)ball[i].r);
    }
}

/* By x, then whatever else they have, so that the order is that of the set: heap sort (Williams 1964). */
static bool is_before(const cage_ball *a, const cage_ball *b)
{
    if (a->x != b->x)
        return a->x < b->x;
    if (a->y != b->y)
        return a->y < b->y;
    return a->z != b->z ? a->z < b->z : a->r < b->r;
}

static void sift(cage_ball *ball, int32_t at, int32_t count)
{
    cage_ball moved = ball[at];
    for (int32_t child; (child = 2 * at + 1) < count; at = child) {
        child += child + 1 < count && is_before(&ball[child], &ball[child + 1]);
        if (!is_before(&moved, &ball[child]))
            break;
        ball[at] = ball[child];
    }
    ball[at] = moved;
}

void cage_atlas_sort(cage_ball *ball, int32_t count)
{
    for (int32_t i = count / 2; i-- > 0;)
        sift(ball, i, count);
    while (count > 1) {
        cage_ball last = ball[--count];
        ball[count] = ball[0];
        ball[0] = last;
        sift(ball, 0, count);
    }
}

/* The graph's cells but for start and goal; leaves are numbered in the order of the tree. */
static void put_cells(struct cage_pen *pen, const struct cage_graph *graph)
{
    uint32_t first = pen->words, leaves = 0;
    cage_words_put_at(pen, CAGE_ATLAS_CELL, first);
    cage_words_put_at(pen, CAGE_ATLAS_CELL + 1, (uint32_t)(graph->cells - CAGE_CELL_ROOT));
    for (int32_t cell = CAGE_CELL_ROOT; cell < graph->cells; cell++)
        cage_words_put(pen, (uint32_t)(graph->cell[cell].child - CAGE_CELL_ROOT) << 1);
    for (int32_t cell = -1; (cell = cage_graph_leaf(graph, cell)) >= 0;)
        cage_words_put_at(pen, first + (uint32_t)(cell - CAGE_CELL_ROOT), leaves++ << 1 | 1);
    cage_words_put_at(pen, CAGE_ATLAS_LEAVES, leaves);
    cage_words_put_at(pen, CAGE_ATLAS_LEAF, pen->words);
    for (int32_t cell = -1; (cell = cage_graph_leaf(graph, cell)) >= 0;) {
        const struct cage_cell *leaf = &graph->cell[cell].cell;
        cage_words_put(pen, (uint32_t)leaf->level | (uint32_t)leaf->face << 4);
        for (int32_t k = 0; k < 3; k++)
            cage_words_put(pen, (uint32_t)leaf->at[k]);
    }
}

/* ---- a side --------------------------------------------------------------------------------------------- */

static void put_leaves(struct cage_pen *pen, const struct cage_survey *survey, int32_t side, uint32_t head)
{
    const struct cage_graph *graph = &survey->proof->graph;
    uint32_t table = pen->words, leaf = 0;
    cage_words_put_at(pen, head + CAGE_SIDE_LEAF, table);
    for (int32_t cell = -1; (cell = cage_graph_leaf(graph, cell)) >= 0;) {
        cage_words_put(pen, 0);
        cage_words_put(pen, (uint32_t)survey->classes[side].first[cell]);
    }
    for (int32_t cell = -1; (cell = cage_graph_leaf(graph, cell)) >= 0;) {
        const struct cage_chart *chart = &survey->sheet[side][cell].chart;
        cage_words_put_at(pen, table + 2 * leaf++, pen->words);
        for (int32_t i = 0; i < chart->words; i++)
            cage_words_put(pen, chart->word[i]);
    }
}

static void put_graph(struct cage_pen *pen, const struct cage_survey *survey, int32_t side, uint32_t head)
{
    const struct cage_graph *graph = &survey->proof->graph;
    const struct cage_classes *classes = &survey->classes[side];
    uint32_t edges = 0;
    cage_words_put_at(pen, head + CAGE_SIDE_NODES, (uint32_t)classes->nodes);
    cage_words_put_at(pen, head + CAGE_SIDE_CLASS, pen->words);
    for (int32_t n = 0; n < classes->nodes; n++)
        cage_words_put(pen, (uint32_t)classes->of[n]);
    cage_words_put_at(pen, head + CAGE_SIDE_ROW, pen->words);
    for (int32_t cell = -1; (cell = cage_graph_leaf(graph, cell)) >= 0;)
        for (int32_t k = 0; k < graph->cell[cell].facts[side].nodes; k++) {
            cage_words_put(pen, edges);
            for (const struct cage_edge *edge = graph->cell[cell].facts[side].node[k].edges; edge; edge = edge->next)
                edges++;
        }
    cage_words_put(pen, edges);
    cage_words_put_at(pen, head + CAGE_SIDE_TO, pen->words);
    cage_words_put_at(pen, head + CAGE_SIDE_EDGES, edges);
    for (int32_t cell = -1; (cell = cage_graph_leaf(graph, cell)) >= 0;)
        for (int32_t k = 0; k < graph->cell[cell].facts[side].nodes; k++)
            for (const struct cage_edge *edge = graph->cell[cell].facts[side].node[k].edges; edge; edge = edge->next)
                cage_words_put(pen, (uint32_t)cage_classes_node(survey, side, edge->to));
}

static void put_classes(struct cage_pen *pen, const struct cage_classes *classes, uint32_t head)
{
    cage_words_put_at(pen, head + CAGE_SIDE_TABLE, pen->words);
    cage_words_put_at(pen, head + CAGE_SIDE_CLASSES, (uint32_t)classes->count);
    for (int32_t i = 0; i < classes->count; i++) {
        const struct cage_sum *sum = &classes->sum[i];
        cage_words_put(pen, (uint32_t)sum->nodes);
        cage_words_put(pen, (uint32_t)sum->cells);
        for (int32_t k = 0; k < 3; k++)
            cage_words_put(pen, (uint32_t)sum->extent.low[k]);
        for (int32_t k = 0; k < 3; k++)
            cage_words_put(pen, (uint32_t)sum->extent.high[k]);
        cage_words_put(pen, (uint32_t)sum->leaf);
        for (int32_t k = 0; k < 3; k++)
            cage_words_put(pen, (uint32_t)sum->extent.at[k]);
        for (int32_t k = 0; k < 4; k++)
            cage_words_put(pen, (uint32_t)sum->middle[k]);
        cage_words_put(pen, (uint32_t)sum->sine);
    }
}

static void put_side(struct cage_pen *pen, const struct cage_survey *survey, int32_t side)
{
    uint32_t head = CAGE_ATLAS_SIDE + (uint32_t)side * CAGE_SIDE_WORDS;
    for (uint32_t i = 0; i < CAGE_SIDE_WORDS; i++)
        cage_words_put_at(pen, head + i, 0);
    if (!(survey->plan.side >> side & 1))
        return;
    put_leaves(pen, survey, side, head);
    put_graph(pen, survey, side, head);
    put_classes(pen, &survey->classes[side], head);
}

static void put_all(struct cage_pen *pen, const struct cage_survey *survey)
{
    const struct cage_proof *proof = survey->proof;
    const cage_scene *scene = &proof->scene;
    pen->words = CAGE_ATLAS_HEAD;
    cage_words_put_at(pen, CAGE_WORDS_MAGIC, CAGE_ATLAS_MAGIC_WORD);
    cage_words_put_at(pen, CAGE_WORDS_FORMAT, CAGE_ATLAS_FORMAT_WORD);
    cage_words_put_at(pen, CAGE_ATLAS_DIM, (uint32_t)scene->dim);
    cage_words_put_at(pen, CAGE_ATLAS_SIDES, (uint32_t)survey->plan.side);
    for (uint32_t i = 0; i < 3; i++)
        cage_words_put_at(pen, CAGE_ATLAS_PIVOT + i, (uint32_t)proof->result.pivot[i]);
    for (uint32_t i = 0; i < 2; i++)
        cage_words_put_at(pen, CAGE_ATLAS_NOTE + i, (uint32_t)survey->plan.note[i]);
    put_balls(pen, CAGE_ATLAS_OBJECT, scene->dim, scene->object.inner, scene->object.inner_count);
    put_balls(pen, CAGE_ATLAS_OBSTACLE, scene->dim, survey->obstacle, scene->obstacles.inner_count);
    const struct cage_side *inner = &proof->side[CAGE_INNER];
    int32_t largest = 0, extent = 0;
    for (int32_t i = 0; i < inner->objects; i++) {
        int32_t reach = inner->reach[i] + inner->object[i].r; /* <= CAGE_REACH: cage_scene_check */
        extent = reach > extent ? reach : extent;
    }
    cage_words_put_at(pen, CAGE_ATLAS_EXTENT, (uint32_t)extent);
    for (int32_t i = 0; i < scene->obstacles.inner_count; i++)
        largest = survey->obstacle[i].r > largest ? survey->obstacle[i].r : largest;
    cage_words_put_at(pen, CAGE_ATLAS_LARGEST, (uint32_t)largest);
    put_cells(pen, &proof->graph);
    for (int32_t side = 0; side < CAGE_SIDES; side++)
        put_side(pen, survey, side);
    cage_words_seal(pen);
}

size_t cage_survey_atlas(const cage_survey *survey, void *out, size_t bytes)
{
    struct cage_pen pen = {NULL, 0};
    if (!survey || !survey->done)
        return 0;
    put_all(&pen, survey);
    size_t size = 4 * (size_t)pen.words;
    if (!out || bytes < size)
        return size;
    pen.byte = out;
    put_all(&pen, survey);
    return size;
}
