/* plan: which cells a survey begins with, how much memory, and its first state. */
#include "atlas.h"
#include "survey.h"

#include <string.h>

enum { CELLS_2D = 2048, CELLS_3D = 8192 };

/* All cells down to a level (-1: none), or more than 2^24. */
static int64_t cells_down_to(int32_t dim, int32_t level)
{
    int64_t of_level = dim == 2 ? CAGE_ROOTS_2D : CAGE_ROOTS_3D, cells = 0;
    for (int32_t i = 0; i <= level && cells <= 1 << 24; i++) {
        cells += of_level;
        of_level *= dim == 2 ? CAGE_CHILDREN_2D : CAGE_CHILDREN_3D;
    }
    return cells;
}

/* Also the level to begin with, if the plan names none. */
static int32_t limits_of(const cage_scene *scene, const cage_plan *plan, cage_limits *limits)
{
    int32_t dim = scene->dim, finest = dim == 2 ? CAGE_LEVEL_MAX_2D : CAGE_LEVEL_MAX_3D;
    if (plan->side < CAGE_SIDE_INNER || plan->side > CAGE_SIDE_BOTH || plan->level < -1 || plan->level > finest ||
        plan->max_cells < 0 || plan->max_cells > 1 << 24)
        return CAGE_ERROR_ARGUMENT;
    cage_limits_default(limits, dim);
    limits->side = plan->side;
    limits->start_level = plan->level;
    limits->max_level = finest;
    limits->max_cells = plan->max_cells > 0 ? plan->max_cells : dim == 2 ? CELLS_2D : CELLS_3D;
    if (plan->level < 0)
        limits->start_level = cage_proof_first_level(scene, limits, true);
    int64_t cells = plan->max_cells > 0 ? plan->max_cells : cells_down_to(dim, limits->start_level);
    limits->max_cells = (int32_t)cells;
    return cells > 1 << 24 ? CAGE_ERROR_ARGUMENT : CAGE_OK;
}

void cage_plan_default(cage_plan *plan)
{
    const cage_plan usual = {CAGE_SIDE_BOTH, -1, 0, {0, 0}};
    if (plan)
        *plan = usual;
}

/* CAGE_SURVEY_BYTES takes these to be large enough; else this divides by 0. */
enum { SURVEY_HEAD = sizeof(struct cage_survey), SHEET_BYTES = sizeof(struct cage_sheet) };
enum { SURVEY_BYTES_HOLDS = 1 / (SURVEY_HEAD <= 512 && SHEET_BYTES <= 32 ? 1 : 0) };

/* Of an atlas: for each ball of a slice about so many, and so many for the slice. */
enum { BYTES_PER_BALL_2D = 24, BYTES_PER_BALL_3D = 22, BYTES_PER_SLICE = 256 };

size_t cage_survey_size(const cage_scene *scene, const cage_plan *plan)
{
    cage_limits limits;
    if (cage_scene_check(scene) != CAGE_OK || !plan || limits_of(scene, plan, &limits) != CAGE_OK || cage_prove_size(scene, &limits) == 0)
        return 0;
    uint64_t cells = (uint64_t)limits.max_cells, bytes = 0;
    uint64_t slices = cells - (uint64_t)cells_down_to(scene->dim, limits.start_level - 1); /* cells above it have none */
    for (int32_t side = 0; side < CAGE_SIDES; side++) {
        int32_t objects = side == CAGE_INNER ? scene->object.inner_count : scene->object.outer_count;
        int32_t obstacles = side == CAGE_INNER ? scene->obstacles.inner_count : scene->obstacles.outer_count;
        uint64_t ball = scene->dim == 2 ? BYTES_PER_BALL_2D : BYTES_PER_BALL_3D;
        if (plan->side >> side & 1) /* < 2^24 2^5 2^28 */
            bytes += slices * (ball * (uint64_t)objects * (uint64_t)obstacles + BYTES_PER_SLICE);
    }
    /* What is taken in the beginning is of the facts, which have half of the block then; the other facts are the atlas. */
    bytes += sizeof(struct cage_survey) + cage_proof_size(scene, &limits) - CAGE_FACTS_BYTES +
             2 * (CAGE_SIDES * (cells + CAGE_CELL_ROOT) * sizeof(struct cage_sheet) +
                  (uint64_t)scene->obstacles.inner_count * sizeof(cage_ball));
    return bytes > SIZE_MAX ? SIZE_MAX : (size_t)bytes;
}

int32_t cage_survey_begin(cage_survey **survey, const cage_scene *scene, const cage_plan *plan, void *memory, size_t bytes)
{
    struct cage_arena arena;
    cage_limits limits;
    if (!survey || !plan || (!memory && bytes))
        return CAGE_ERROR_ARGUMENT;
    int32_t error = cage_scene_check(scene);
    if (error == CAGE_OK)
        error = limits_of(scene, plan, &limits);
    if (error == CAGE_OK)
        error = cage_limits_check(&limits, scene->dim);
    if (error != CAGE_OK)
        return error;
    cage_arena_init(&arena, memory, bytes);
    struct cage_survey *made = cage_arena_take(&arena, 1, sizeof *made);
    if (!made)
        return CAGE_ERROR_MEMORY;
    memset(made, 0, sizeof *made);
    made->plan = *plan;
    error = cage_proof_begin(&made->proof, scene, NULL, NULL, &limits, &cage_all_shortcuts, arena.base + arena.used,
                             arena.size - arena.used);
    for (int32_t side = 0; side < CAGE_SIDES && error == CAGE_OK; side++) {
        struct cage_graph *graph = &made->proof->graph;
        made->sheet[side] = cage_arena_take(graph->arena, (size_t)graph->capacity, sizeof *made->sheet[side]);
        if (!made->sheet[side])
            return CAGE_ERROR_MEMORY;
        memset(made->sheet[side], 0, (size_t)graph->capacity * sizeof *made->sheet[side]);
    }
    if (error != CAGE_OK)
        return error;
    const cage_shape *obstacles = &scene->obstacles;
    made->obstacle = cage_arena_take(&made->proof->arena, (size_t)obstacles->inner_count, sizeof *made->obstacle);
    if (!made->obstacle)
        return CAGE_ERROR_MEMORY;
    for (int32_t i = 0; i < obstacles->inner_count; i++)
        made->obstacle[i] = obstacles->inner[i];
    cage_atlas_sort(made->obstacle, obstacles->inner_count);
    made->cell = cage_graph_leaf(&made->proof->graph, -1);
    made->beyond = -1;
    made->after = CAGE_CELL_GOAL;
    *survey = made;
    return CAGE_OK;
}

/* The leaf with that number. */
static int32_t nth_leaf(const struct cage_graph *graph, int64_t number)
{
    int32_t cell = cage_graph_leaf(graph, -1);
    for (; number > 0 && cell >= 0; number--)
        cell = cage_graph_leaf(graph, cell);
    return cell;
}

int32_t cage_survey_part(cage_survey *survey, int32_t part, int32_t parts)
{
    if (!survey || survey->result.steps > 0 || parts < 1 || part < 0 || part >= parts)
        return CAGE_ERROR_ARGUMENT;
    const struct cage_graph *graph = &survey->proof->graph;
    int64_t leaves = 0;
    for (int32_t cell = -1; (cell = cage_graph_leaf(graph, cell)) >= 0;)
        leaves++;
    survey->part = true;
    survey->cell = nth_leaf(graph, part * leaves / parts); /* < 2^31 2^24 */
    survey->beyond = nth_leaf(graph, (part + 1) * leaves / parts);
    if (survey->cell == survey->beyond)
        survey->cell = -1; /* more parts than leaves */
    return CAGE_OK;
}
