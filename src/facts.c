/* facts: what a survey has found out so far, written as bytes; and a survey that goes on from such bytes. */
#include "survey.h"
#include "words.h"

#include <string.h>

/* After the five words of words.h: the plan (side, level, max_cells); the dimension; the numbers of the object's and the
 * obstacles' inner and outer balls; the balls (centre and radius each); how many cells were cut, and which, in their order.
 * Then for each side the slices of leaves: cell, components, words of the chart, the chart, for each component its extent
 * and, of an outer one, the inner component that holds it; 0 ends them. Then its gluings: two leaves, the number of pairs of
 * components that share a point, the pairs; 0 ends them. Cells have the numbers of the graph. */
enum { MAGIC = 0x66676163, FORMAT = 1, PLAN = 5, DIM = 8, BALLS = 9, HEAD = 13, EXTENT = 11 };

/* ---- writing -------------------------------------------------------------------------------------------- */

static void put_number(struct cage_pen *pen, int32_t value) { cage_words_put(pen, (uint32_t)value); }

static void put_sets(struct cage_pen *pen, const cage_ball *ball, int32_t count)
{
    for (int32_t i = 0; i < count; i++) {
        put_number(pen, ball[i].x);
        put_number(pen, ball[i].y);
        put_number(pen, ball[i].z);
        put_number(pen, ball[i].r);
    }
}

static void put_scene(struct cage_pen *pen, const cage_scene *scene, const cage_plan *plan)
{
    const cage_shape *shape[2] = {&scene->object, &scene->obstacles};
    cage_words_put_at(pen, CAGE_WORDS_MAGIC, MAGIC);
    cage_words_put_at(pen, CAGE_WORDS_FORMAT, FORMAT);
    pen->words = PLAN;
    put_number(pen, plan->side);
    put_number(pen, plan->level);
    put_number(pen, plan->max_cells);
    put_number(pen, scene->dim);
    for (int32_t i = 0; i < 2; i++) {
        put_number(pen, shape[i]->inner_count);
        put_number(pen, shape[i]->outer_count);
    }
    for (int32_t i = 0; i < 2; i++) {
        put_sets(pen, shape[i]->inner, shape[i]->inner_count);
        put_sets(pen, shape[i]->outer, shape[i]->outer_count);
    }
}

static void put_tree(struct cage_pen *pen, const struct cage_graph *graph)
{
    const int32_t roots = graph->fibre->roots, children = graph->fibre->children;
    put_number(pen, (graph->cells - CAGE_CELL_ROOT - roots) / children);
    for (int32_t cell = CAGE_CELL_ROOT + roots; cell < graph->cells; cell += children)
        put_number(pen, graph->cell[cell].parent);
}

static void put_slice(struct cage_pen *pen, const struct cage_survey *survey, int32_t side, int32_t cell)
{
    const struct cage_facts *facts = &survey->proof->graph.cell[cell].facts[side];
    const struct cage_sheet *sheet = &survey->sheet[side][cell];
    put_number(pen, cell);
    put_number(pen, facts->nodes);
    put_number(pen, sheet->chart.words);
    for (int32_t i = 0; i < sheet->chart.words; i++)
        cage_words_put(pen, sheet->chart.word[i]);
    for (int32_t k = 0; k < facts->nodes; k++) {
        const struct cage_extent *extent = &sheet->extent[k];
        for (int32_t i = 0; i < 3; i++)
            put_number(pen, extent->low[i]);
        for (int32_t i = 0; i < 3; i++)
            put_number(pen, extent->high[i]);
        put_number(pen, extent->known);
        for (int32_t i = 0; i < 3; i++)
            put_number(pen, extent->at[i]);
        put_number(pen, facts->node[k].inside);
    }
}

static void put_gluing(struct cage_pen *pen, const struct cage_facts *facts, int32_t cell, int32_t other)
{
    put_number(pen, cell);
    put_number(pen, other);
    uint32_t count = 0, at = pen->words++;
    for (int32_t k = 0; k < facts->nodes; k++)
        for (const struct cage_edge *edge = facts->node[k].edges; edge; edge = edge->next)
            if (edge->to->cell == other) {
                put_number(pen, k);
                put_number(pen, edge->to->component);
                count++;
            }
    cage_words_put_at(pen, at, count);
}

/* All of a pair is recorded before the last nodes say that it was glued. */
static bool is_glued(const struct cage_graph *graph, int32_t side, int32_t a, int32_t b)
{
    const struct cage_facts *at = &graph->cell[a].facts[side], *bt = &graph->cell[b].facts[side];
    return cage_graph_is_glued(&at->node[at->nodes - 1], b) && cage_graph_is_glued(&bt->node[bt->nodes - 1], a);
}

static void put_side_facts(struct cage_pen *pen, const struct cage_survey *survey, int32_t side)
{
    const struct cage_graph *graph = &survey->proof->graph;
    for (int32_t cell = -1; (cell = cage_graph_leaf(graph, cell)) >= 0;)
        if (survey->sheet[side][cell].chart.word)
            put_slice(pen, survey, side, cell);
    put_number(pen, 0);
    for (int32_t cell = -1; (cell = cage_graph_leaf(graph, cell)) >= 0;) {
        const struct cage_facts *facts = &graph->cell[cell].facts[side];
        if (!survey->sheet[side][cell].chart.word)
            continue;
        for (const struct cage_glued *glued = facts->node[0].glued; glued; glued = glued->next)
            if (glued->with > cell && !graph->cell[glued->with].child && is_glued(graph, side, cell, glued->with))
                put_gluing(pen, facts, cell, glued->with);
    }
    put_number(pen, 0);
}

static void put_facts(struct cage_pen *pen, const struct cage_survey *survey)
{
    put_scene(pen, &survey->proof->scene, &survey->plan);
    put_tree(pen, &survey->proof->graph);
    for (int32_t side = 0; side < CAGE_SIDES; side++)
        put_side_facts(pen, survey, side);
    cage_words_seal(pen);
}

size_t cage_survey_facts(const cage_survey *survey, void *out, size_t bytes)
{
    struct cage_pen pen = {NULL, 0};
    if (!survey)
        return 0;
    put_facts(&pen, survey);
    size_t size = 4 * (size_t)pen.words;
    if (!out || bytes < size)
        return size;
    pen.byte = out;
    put_facts(&pen, survey);
    return size;
}

/* ---- reading -------------------------------------------------------------------------------------------- */

/* Words one after the other; beyond the end there are zeros, and `fine` is false. */
struct reader {
    const unsigned char *byte;
    uint32_t words, at;
    bool fine;
};

static uint32_t next(struct reader *reader)
{
    reader->fine = reader->fine && reader->at < reader->words;
    return reader->fine ? cage_words_get(reader->byte, reader->at++) : 0;
}

static int32_t next_number(struct reader *reader) { return cage_words_number(next(reader)); }

static bool is_within(struct reader *reader, int32_t value, int32_t low, int32_t high)
{
    reader->fine = reader->fine && value >= low && value <= high;
    return reader->fine;
}

static void skip(struct reader *reader, uint32_t words)
{
    reader->fine = reader->fine && words <= reader->words - reader->at;
    reader->at += reader->fine ? words : 0;
}

/* Are the balls of this scene what comes next? */
static bool are_same(struct reader *reader, const cage_ball *ball, int32_t count)
{
    bool same = true;
    for (int32_t i = 0; i < count && same; i++)
        same = next_number(reader) == ball[i].x && next_number(reader) == ball[i].y && next_number(reader) == ball[i].z &&
               next_number(reader) == ball[i].r;
    return same;
}

static bool is_of(struct reader *reader, const cage_scene *scene, const cage_plan *plan)
{
    const int32_t told[HEAD - PLAN] = {plan->side, plan->level, plan->max_cells, scene->dim, scene->object.inner_count,
                                       scene->object.outer_count, scene->obstacles.inner_count, scene->obstacles.outer_count};
    bool same = true;
    for (int32_t i = 0; i < HEAD - PLAN; i++)
        same = next_number(reader) == told[i] && same;
    same = same && are_same(reader, scene->object.inner, told[DIM - PLAN + 1]) &&
           are_same(reader, scene->object.outer, told[DIM - PLAN + 2]) &&
           are_same(reader, scene->obstacles.inner, told[DIM - PLAN + 3]) &&
           are_same(reader, scene->obstacles.outer, told[DIM - PLAN + 4]);
    return same && reader->fine;
}

/* What is known of a cell while the bytes are checked. */
struct seen {
    int32_t level; /* -1: it was cut */
    int32_t nodes[CAGE_SIDES];
};

/* The cells as they are once those told were cut; how many, or -1. */
static int32_t check_tree(struct reader *reader, const struct cage_graph *graph, struct seen *seen)
{
    const int32_t roots = graph->fibre->roots, children = graph->fibre->children;
    int32_t cells = CAGE_CELL_ROOT + roots, count = next_number(reader);
    memset(seen, 0, (size_t)graph->capacity * sizeof *seen);
    if (!is_within(reader, count, (graph->cells - cells) / children, (graph->capacity - cells) / children))
        return -1;
    for (int32_t i = 0; i < count; i++, cells += children) {
        int32_t cut = next_number(reader);
        if (!is_within(reader, cut, CAGE_CELL_ROOT, cells - 1) || seen[cut].level < 0 ||
            seen[cut].level >= graph->fibre->max_level || (cells < graph->cells && graph->cell[cells].parent != cut))
            return -1;
        for (int32_t k = 0; k < children; k++)
            seen[cells + k].level = seen[cut].level + 1;
        seen[cut].level = -1;
    }
    return cells;
}

static bool check_slices(struct reader *reader, const struct cage_survey *survey, struct seen *seen, int32_t cells, int32_t side)
{
    const struct cage_graph *graph = &survey->proof->graph;
    for (int32_t cell; (cell = next_number(reader)) != 0;) {
        int32_t nodes = next_number(reader), words = next_number(reader);
        if (!is_within(reader, cell, CAGE_CELL_ROOT, cells - 1) ||
            !is_within(reader, nodes, 1, (int32_t)(reader->words / EXTENT)) ||
            !is_within(reader, words, CAGE_CHART_HEAD, (int32_t)reader->words) || seen[cell].level < 0 ||
            seen[cell].nodes[side] > 0 ||
            (cell < graph->cells && survey->sheet[side][cell].chart.word && graph->cell[cell].facts[side].nodes != nodes))
            return false;
        seen[cell].nodes[side] = nodes;
        skip(reader, (uint32_t)words);
        for (int32_t k = 0; k < nodes && reader->fine; k++) {
            skip(reader, EXTENT - 1);
            is_within(reader, next_number(reader), CAGE_COVERED, seen[cell].nodes[CAGE_INNER] - 1);
        }
    }
    return reader->fine;
}

static bool check_gluings(struct reader *reader, const struct seen *seen, int32_t cells, int32_t side)
{
    for (int32_t cell; (cell = next_number(reader)) != 0;) {
        int32_t other = next_number(reader), count = next_number(reader);
        if (!is_within(reader, cell, CAGE_CELL_ROOT, cells - 1) || !is_within(reader, other, cell + 1, cells - 1) ||
            !is_within(reader, count, 0, (int32_t)(reader->words / 2)))
            return false;
        for (int32_t i = 0; i < count && reader->fine; i++) {
            is_within(reader, next_number(reader), 0, seen[cell].nodes[side] - 1);
            is_within(reader, next_number(reader), 0, seen[other].nodes[side] - 1);
        }
        if (seen[cell].nodes[side] == 0 || seen[other].nodes[side] == 0)
            return false;
    }
    return reader->fine;
}

/* All of it, before anything is changed. */
static int32_t check_all(struct reader reader, struct cage_survey *survey)
{
    struct cage_arena *scratch = &survey->proof->scratch;
    size_t mark = scratch->used;
    struct seen *seen = cage_arena_take(scratch, (size_t)survey->proof->graph.capacity, sizeof *seen);
    if (!seen)
        return CAGE_ERROR_MEMORY;
    bool fine = is_of(&reader, &survey->proof->scene, &survey->plan);
    int32_t cells = fine ? check_tree(&reader, &survey->proof->graph, seen) : -1;
    fine = cells >= 0;
    for (int32_t side = 0; side < CAGE_SIDES && fine; side++)
        fine = check_slices(&reader, survey, seen, cells, side) && check_gluings(&reader, seen, cells, side);
    cage_arena_release(scratch, mark);
    return fine && reader.at == reader.words ? CAGE_OK : CAGE_ERROR_ATLAS;
}

/* ---- going on from what was read ------------------------------------------------------------------------ */

static void take_tree(struct reader *reader, struct cage_graph *graph)
{
    int32_t cells = CAGE_CELL_ROOT + graph->fibre->roots;
    for (int32_t count = next_number(reader); count > 0; count--, cells += graph->fibre->children) {
        int32_t cut = next_number(reader);
        if (cells == graph->cells)
            cage_graph_refine(graph, cut); /* there is room: it was checked */
    }
}

static void take_nodes(struct reader *reader, struct cage_node *node, int32_t nodes, struct cage_extent *extent)
{
    for (int32_t k = 0; k < nodes; k++) {
        for (int32_t i = 0; i < 3; i++)
            extent[k].low[i] = next_number(reader);
        for (int32_t i = 0; i < 3; i++)
            extent[k].high[i] = next_number(reader);
        extent[k].known = next_number(reader);
        for (int32_t i = 0; i < 3; i++)
            extent[k].at[i] = next_number(reader);
        node[k].inside = next_number(reader);
    }
}

static int32_t take_slice(struct reader *reader, struct cage_survey *survey, int32_t side, int32_t cell)
{
    struct cage_graph *graph = &survey->proof->graph;
    struct cage_sheet *sheet = &survey->sheet[side][cell];
    int32_t nodes = next_number(reader), words = next_number(reader);
    if (sheet->chart.word) {
        skip(reader, (uint32_t)words + (uint32_t)EXTENT * (uint32_t)nodes); /* they are there: < 2^31 */
        return CAGE_OK;
    }
    uint32_t *word = cage_arena_take(graph->arena, (size_t)words, sizeof *word);
    struct cage_extent *extent = cage_arena_take(graph->arena, (size_t)nodes, sizeof *extent);
    if (!word || !extent || cage_graph_add_nodes(graph, side, cell, nodes) != CAGE_OK)
        return CAGE_ERROR_MEMORY;
    for (int32_t i = 0; i < words; i++)
        word[i] = next(reader);
    take_nodes(reader, graph->cell[cell].facts[side].node, nodes, extent);
    sheet->chart.word = word;
    sheet->chart.words = words;
    sheet->extent = extent;
    return CAGE_OK;
}

static int32_t take_gluing(struct reader *reader, struct cage_survey *survey, int32_t side, int32_t cell)
{
    struct cage_proof *proof = survey->proof;
    int32_t other = next_number(reader), count = next_number(reader);
    if (is_glued(&proof->graph, side, cell, other)) {
        skip(reader, 2 * (uint32_t)count);
        return CAGE_OK;
    }
    size_t mark = proof->scratch.used;
    struct cage_touch *touch = cage_arena_take(&proof->scratch, (size_t)count, sizeof *touch);
    if (!touch)
        return CAGE_ERROR_MEMORY;
    for (int32_t i = 0; i < count; i++) {
        memset(&touch[i], 0, sizeof touch[i]);
        touch[i].k = next_number(reader);
        touch[i].l = next_number(reader);
    }
    int32_t error = cage_graph_add_gluing(&proof->graph, side, cell, other, CAGE_ALL, touch, count);
    cage_arena_release(&proof->scratch, mark);
    return error;
}

static int32_t take_side(struct reader *reader, struct cage_survey *survey, int32_t side)
{
    int32_t error = CAGE_OK;
    for (int32_t cell; error == CAGE_OK && (cell = next_number(reader)) != 0;)
        error = take_slice(reader, survey, side, cell);
    for (int32_t cell; error == CAGE_OK && (cell = next_number(reader)) != 0;)
        error = take_gluing(reader, survey, side, cell);
    return error;
}

int32_t cage_survey_learn(cage_survey *survey, const void *bytes, size_t size)
{
    if (!survey || !bytes)
        return CAGE_ERROR_ARGUMENT;
    if (survey->proof->error != CAGE_OK || survey->result.steps > 0)
        return CAGE_ERROR_ARGUMENT;
    if (!cage_words_are_sealed(bytes, size, MAGIC, FORMAT, HEAD))
        return CAGE_ERROR_ATLAS;
    const cage_scene *scene = &survey->proof->scene;
    struct reader reader = {bytes, (uint32_t)(size / 4), PLAN, true};
    int32_t error = check_all(reader, survey);
    if (error == CAGE_ERROR_ATLAS)
        return error;
    const uint64_t balls = (uint64_t)scene->object.inner_count + (uint64_t)scene->object.outer_count +
                           (uint64_t)scene->obstacles.inner_count + (uint64_t)scene->obstacles.outer_count;
    reader.at = HEAD + 4 * (uint32_t)balls; /* it is as long as that */
    if (error == CAGE_OK)
        take_tree(&reader, &survey->proof->graph);
    for (int32_t side = 0; side < CAGE_SIDES && error == CAGE_OK; side++)
        error = take_side(&reader, survey, side);
    survey->proof->error = error;
    survey->cell = cage_graph_leaf(&survey->proof->graph, -1);
    survey->beyond = -1;
    cage_survey_sum_up(survey);
    return error;
}
