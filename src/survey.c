/* survey: builds and glues the slices of all cells, cuts those where the two sides disagree, and joins nodes into classes.
 *
 * That is Algorithms 1 to 4 of the paper, with exact gluing. Of a slice its charts, extents and edges are kept; the slice itself
 * as long as the store holds it. */
#include "survey.h"
#include "box.h"

#include <string.h>

/* ---- a cell --------------------------------------------------------------------------------------------- */

static bool is_wanted(const struct cage_survey *survey, int32_t side) { return survey->plan.side >> side & 1; }

static int32_t measure(struct cage_survey *survey, const struct cage_slice *slice, struct cage_extent **out)
{
    struct cage_extent *extent = cage_arena_take(&survey->proof->arena, (size_t)slice->regions, sizeof *extent);
    if (!extent)
        return CAGE_ERROR_MEMORY;
    memset(extent, 0, (size_t)slice->regions * sizeof *extent);
    for (int32_t k = 0; k < slice->regions; k++) {
        const struct cage_region *region = &slice->region[k];
        struct cage_box box = {{0, 0, 0}, {0, 0, 0}};
        extent[k].known = region->known;
        if (k != CAGE_OUTSIDE)
            cage_box_of(slice->t.dim, &region->bounds, &box);
        for (int32_t i = 0; i < 3; i++) { /* a bounded component lies among the balls, within CAGE_REACH */
            extent[k].low[i] = (int32_t)box.low[i];
            extent[k].high[i] = (int32_t)box.high[i];
            extent[k].at[i] = region->known ? region->point[i] : 0;
        }
    }
    *out = extent;
    return CAGE_OK;
}

/* Build the slice, keep its chart and where its components lie. */
static int32_t build(struct cage_survey *survey)
{
    struct cage_proof *proof = survey->proof;
    struct cage_sheet *sheet = &survey->sheet[survey->side][survey->cell];
    const struct cage_slice *slice;
    struct cage_chart chart;
    proof->taken = NULL;
    int32_t error = cage_proof_slice(proof, survey->side, survey->cell, &slice);
    if (error != CAGE_OK)
        return error;
    size_t mark = proof->scratch.used, before = proof->arena.used;
    if (proof->taken)
        chart = proof->taken->chart;
    else
        error = cage_chart_make(&proof->scratch, slice, &chart);
    if (error != CAGE_OK)
        return error;
    uint32_t *word = cage_arena_take(&proof->arena, (size_t)chart.words, sizeof *word);
    if (word)
        memcpy(word, chart.word, (size_t)chart.words * sizeof *word);
    cage_arena_release(&proof->scratch, mark);
    error = word ? measure(survey, slice, &sheet->extent) : CAGE_ERROR_MEMORY;
    if (error == CAGE_OK) {
        sheet->chart.words = chart.words;
        sheet->chart.word = word;
    } else {
        cage_arena_release(&proof->arena, before); /* as if it had not been tried */
    }
    return error;
}

static int32_t glue(struct cage_survey *survey, int32_t other)
{
    struct cage_proof *proof = survey->proof;
    const struct cage_slice *c, *d;
    int32_t error = cage_proof_slices(proof, survey->side, survey->cell, other, &c, &d);
    if (error != CAGE_OK)
        return error;
    size_t mark = proof->scratch.used;
    const struct cage_unit *unit =
        proof->ahead ? proof->ahead->find(proof->ahead, proof, survey->side, survey->cell, other, CAGE_ALL, &proof->scratch) : NULL;
    struct cage_touch *touch = unit ? unit->touch : NULL;
    int32_t count = unit ? unit->count : 0, mixed = unit ? unit->mixed : 0;
    if (!unit)
        error = cage_glue(&proof->scratch, c, d, CAGE_ALL, &touch, &count, &mixed);
    if (error == CAGE_OK)
        error = cage_graph_add_gluing(&proof->graph, survey->side, survey->cell, other, CAGE_ALL, touch, count);
    if (error == CAGE_OK) {
        proof->result.gluings[survey->side]++;
        proof->result.mixtures[survey->side] += mixed;
    }
    cage_arena_release(&proof->scratch, mark);
    return error;
}

/* The next neighbour that was built, and is not glued with the leaf; -1: no more. */
static int32_t next_neighbour(const struct cage_survey *survey)
{
    const struct cage_graph *graph = &survey->proof->graph;
    const struct cage_node *outside = graph->cell[survey->cell].facts[survey->side].node;
    int32_t next = cage_graph_neighbour(graph, survey->cell, survey->after);
    while (next >= 0 && (!survey->sheet[survey->side][next].chart.word || cage_graph_is_glued(outside, next)))
        next = cage_graph_neighbour(graph, survey->cell, next);
    return next;
}

static void go_on(struct cage_survey *survey)
{
    survey->after = CAGE_CELL_GOAL;
    if (++survey->side == CAGE_SIDES) {
        survey->side = 0;
        survey->cell = cage_graph_leaf(&survey->proof->graph, survey->cell);
        if (survey->cell == survey->beyond)
            survey->cell = -1;
    }
}

/* ---- where the sides disagree --------------------------------------------------------------------------- */

enum { NONE = -1, MANY = -2 };

static void see(int32_t *seen, int32_t class)
{
    *seen = *seen == NONE || *seen == class ? class : MANY;
}

/* The outer classes that lie in each inner class, and in each component of a cell: none, one, or many. */
static void compare(const struct cage_survey *survey, int32_t cell, int32_t *of_class, int32_t *of_node)
{
    const struct cage_facts *facts = survey->proof->graph.cell[cell].facts;
    const struct cage_classes *inner = &survey->classes[CAGE_INNER], *outer = &survey->classes[CAGE_OUTER];
    for (int32_t k = 0; k < facts[CAGE_OUTER].nodes; k++) {
        int32_t inside = k == CAGE_OUTSIDE ? CAGE_OUTSIDE : facts[CAGE_OUTER].node[k].inside;
        if (inside < 0)
            continue;
        int32_t node = inner->first[cell] + inside, class = outer->of[outer->first[cell] + k];
        see(&of_class[inner->of[node]], class);
        see(&of_node[node], class);
    }
}

/* How much a cell needs to be cut. */
enum { BRIDGE = 0, EMPTY, EVEN, NEEDS };

/* An inner component, of a class that joins several outer ones, does not lie in just one of these: BRIDGE. No outer component
 * lies in it: EMPTY. */
static int32_t need_of(const struct cage_survey *survey, int32_t cell, const int32_t *of_class, const int32_t *of_node)
{
    const struct cage_classes *inner = &survey->classes[CAGE_INNER];
    int32_t need = EVEN;
    for (int32_t k = 0; k < survey->proof->graph.cell[cell].facts[CAGE_INNER].nodes; k++) {
        int32_t node = inner->first[cell] + k;
        if (of_node[node] < 0 && of_class[inner->of[node]] == MANY)
            return BRIDGE;
        if (of_node[node] == NONE)
            need = EMPTY;
    }
    return need;
}

/* Cut the leaves of the greatest need that there is, the coarsest of them, as many as may be. How many; or an error. */
static int32_t refine(struct cage_survey *survey)
{
    struct cage_graph *graph = &survey->proof->graph;
    struct cage_arena *scratch = &survey->proof->scratch;
    const struct cage_classes *inner = &survey->classes[CAGE_INNER];
    size_t mark = scratch->used;
    int32_t *of_class = cage_arena_take(scratch, (size_t)inner->count, sizeof *of_class);
    int32_t *of_node = cage_arena_take(scratch, (size_t)inner->nodes, sizeof *of_node);
    int32_t *chosen = cage_arena_take(scratch, (size_t)graph->capacity, sizeof *chosen);
    int32_t count = 0, cut = 0, most = NEEDS, level = 0;
    bool room = of_class && of_node && chosen;
    for (int32_t i = 0; room && i < inner->count; i++)
        of_class[i] = NONE;
    for (int32_t i = 0; room && i < inner->nodes; i++)
        of_node[i] = NONE;
    for (int32_t cell = -1; room && (cell = cage_graph_leaf(graph, cell)) >= 0;)
        compare(survey, cell, of_class, of_node);
    for (int32_t cell = -1; room && (cell = cage_graph_leaf(graph, cell)) >= 0;) {
        int32_t need = need_of(survey, cell, of_class, of_node), here = graph->cell[cell].cell.level;
        if (here == graph->fibre->max_level || need > most || (need == most && here > level))
            continue;
        count = need < most || here < level ? 0 : count;
        most = need;
        level = here;
        chosen[count++] = cell;
    }
    while (cut < count && cage_graph_refine(graph, chosen[cut]))
        cut++;
    cage_arena_release(scratch, mark);
    return room ? cut : CAGE_ERROR_MEMORY;
}

/* ---- steps ---------------------------------------------------------------------------------------------- */

static int32_t finish_round(struct cage_survey *survey)
{
    int32_t cut = 0;
    for (int32_t side = 0; side < CAGE_SIDES; side++) {
        int32_t error = is_wanted(survey, side) ? cage_classes_make(survey, side) : CAGE_OK;
        if (error != CAGE_OK)
            return error;
    }
    if (survey->plan.max_cells > 0 && survey->plan.side == CAGE_SIDE_BOTH)
        cut = refine(survey);
    if (cut < 0)
        return cut;
    size_t mark = survey->proof->arena.used;
    for (int32_t side = 0; side < CAGE_SIDES && cut == 0; side++) {
        int32_t error = is_wanted(survey, side) ? cage_classes_sum(survey, side) : CAGE_OK;
        if (error != CAGE_OK) {
            cage_arena_release(&survey->proof->arena, mark); /* of both sides, which are taken anew */
            return error;
        }
    }
    survey->done = cut == 0;
    survey->cell = survey->done ? -1 : cage_graph_leaf(&survey->proof->graph, -1);
    return CAGE_OK;
}

static bool is_finished(const struct cage_survey *survey) { return survey->done || (survey->part && survey->cell < 0); }

static int32_t step(struct cage_survey *survey)
{
    for (; survey->cell >= 0; go_on(survey)) {
        if (!is_wanted(survey, survey->side))
            continue;
        if (!survey->sheet[survey->side][survey->cell].chart.word)
            return build(survey);
        int32_t next = next_neighbour(survey);
        if (next >= 0) {
            int32_t error = glue(survey, next);
            survey->after = error == CAGE_OK ? next : survey->after;
            return error;
        }
    }
    return survey->part ? CAGE_OK : finish_round(survey);
}

/* What comes next on one side of a leaf; false: enough of it. */
static bool look_at(struct cage_survey *survey, int32_t cell, int32_t side)
{
    const struct cage_proof *proof = survey->proof;
    const struct cage_graph *graph = &proof->graph;
    const struct cage_sheet *sheet = survey->sheet[side];
    bool more = sheet[cell].chart.word || cage_ahead_add(proof->ahead, proof, side, cell, -1, 0);
    for (int32_t next = CAGE_CELL_GOAL; more && (next = cage_graph_neighbour(graph, cell, next)) >= 0;) {
        bool made = cage_ahead_has(proof->ahead, proof, side, next), glued = false;
        if (sheet[cell].chart.word)
            glued = cage_graph_is_glued(graph->cell[cell].facts[side].node, next);
        if ((sheet[next].chart.word || made) && !glued)
            more = cage_ahead_add(proof->ahead, proof, side, cell, next, CAGE_ALL);
    }
    return more;
}

static void look_ahead(struct cage_survey *survey, const cage_workers *workers)
{
    cage_ahead_tidy(survey->proof->ahead, workers);
    const struct cage_graph *graph = &survey->proof->graph;
    bool more = true;
    for (int32_t cell = survey->cell; more && cell >= 0 && cell != survey->beyond; cell = cage_graph_leaf(graph, cell))
        for (int32_t side = 0; more && side < CAGE_SIDES; side++)
            more = !is_wanted(survey, side) || look_at(survey, cell, side);
    cage_ahead_do(survey->proof->ahead, workers);
}

void cage_survey_sum_up(struct cage_survey *survey)
{
    struct cage_survey_result *result = &survey->result;
    const struct cage_proof *proof = survey->proof;
    result->level = proof->graph.level;
    result->cells = proof->graph.cells - CAGE_CELL_ROOT;
    result->leaves = 0;
    for (int32_t cell = -1; (cell = cage_graph_leaf(&proof->graph, cell)) >= 0;)
        result->leaves++;
    for (int32_t side = 0; side < CAGE_SIDES; side++) {
        result->slices[side] = proof->result.slices[side];
        result->gluings[side] = proof->result.gluings[side];
        result->mixtures[side] = proof->result.mixtures[side];
        result->balls[side] = proof->result.balls[side];
        result->inserted[side] = proof->result.inserted[side];
        result->classes[side] = survey->done ? survey->classes[side].count : 0;
    }
    result->peak_bytes = sizeof *survey + proof->arena.peak + proof->scratch.peak;
    result->needed_bytes = proof->error == CAGE_ERROR_MEMORY ? sizeof *survey + cage_proof_needed(proof) : 0;
    result->atlas_bytes = survey->done ? cage_survey_atlas(survey, NULL, 0) : 0;
}

/* False: there is no step to take. One that finds no memory is taken again where there is some to be had from the store. */
static bool advance(struct cage_survey *survey)
{
    struct cage_proof *proof = survey->proof;
    if (proof->error != CAGE_OK || is_finished(survey))
        return false;
    do {
        proof->arena.needed = proof->scratch.needed = 0;
        proof->error = step(survey);
    } while (proof->error == CAGE_ERROR_MEMORY && cage_proof_make_room(proof));
    survey->result.steps++;
    return true;
}

static int32_t report(struct cage_survey *survey)
{
    cage_survey_sum_up(survey);
    return survey->proof->error != CAGE_OK ? survey->proof->error : is_finished(survey);
}

int32_t cage_survey_run(cage_survey *survey, int64_t steps)
{
    if (!survey)
        return CAGE_ERROR_ARGUMENT;
    while (steps > 0 && advance(survey))
        steps--;
    return report(survey);
}

int32_t cage_survey_run_with(cage_survey *survey, int64_t steps, const cage_workers *workers)
{
    if (!survey || !cage_workers_are_valid(workers))
        return CAGE_ERROR_ARGUMENT;
    struct cage_proof *proof = survey->proof;
    proof->ahead = workers ? cage_ahead_make(workers) : NULL;
    for (bool more = true; steps > 0 && more; steps--) {
        if (proof->ahead && survey->cell >= 0 && cage_ahead_is_due(proof->ahead))
            look_ahead(survey, workers);
        more = advance(survey);
    }
    proof->ahead = NULL;
    return report(survey);
}

const cage_survey_result *cage_survey_result_of(const cage_survey *survey)
{
    return survey ? &survey->result : NULL;
}
