/* begin: limits, and the first state of a search. */
#include "grid.h"
#include "proof.h"

#include <string.h>

void cage_limits_default(cage_limits *limits, int32_t dim)
{
    if (!limits)
        return;
    limits->side = CAGE_SIDE_BOTH;
    limits->start_level = -1;
    limits->max_level = dim == 2 ? 12 : 8;
    limits->max_cells = dim == 2 ? 16384 : 131072;
}

int32_t cage_limits_check(const cage_limits *limits, int32_t dim)
{
    if (limits->side < CAGE_SIDE_INNER || limits->side > CAGE_SIDE_BOTH || limits->max_cells < 2 ||
        limits->max_cells > 1 << 24)
        return CAGE_ERROR_ARGUMENT;
    int64_t of_level = dim == 2 ? 2 : 4, cells = of_level; /* all cells down to the start level, or more than allowed */
    for (int32_t level = 0; level < limits->start_level && cells <= limits->max_cells; level++) {
        of_level *= dim == 2 ? 2 : 8;
        cells += of_level;
    }
    if (cells > limits->max_cells)
        return CAGE_ERROR_ARGUMENT;
    if (limits->max_level < 0 || limits->max_level > (dim == 2 ? CAGE_LEVEL_MAX_2D : CAGE_LEVEL_MAX_3D))
        return CAGE_ERROR_ARGUMENT;
    return limits->start_level < -1 || limits->start_level > limits->max_level ? CAGE_ERROR_ARGUMENT : CAGE_OK;
}

static int64_t mean_radius(const cage_shape *shape)
{
    int64_t sum = 0; /* < 2^31 2^29 */
    for (int32_t i = 0; i < shape->inner_count; i++)
        sum += shape->inner[i].r;
    return cage_i128_floor(cage_i128_of(sum), cage_i128_of(shape->inner_count), sum);
}

/* The coarsest level at which the object's farthest ball moves by no more than half the radius of a usual
 * collision ball: in coarser cells the inner balls shrink to little, and what is left has holes everywhere. For a proof in
 * space, twice the radius: there a level too fine costs 8 times as much, and one too coarse is soon found out. */
int32_t cage_proof_first_level(const cage_scene *scene, const cage_limits *limits, bool all)
{
    const struct cage_fibre *fibre = scene->dim == 2 ? &cage_so2 : &cage_so3;
    const cage_shape *object = &scene->object, *obstacles = &scene->obstacles;
    int32_t reach = 0, level = 0, pivot[3];
    if (object->inner_count == 0 || obstacles->inner_count == 0)
        return 0;
    cage_pivot(object, pivot);
    for (int32_t i = 0; i < object->inner_count; i++) {
        int32_t far = cage_reach(&object->inner[i], pivot);
        reach = far > reach ? far : reach;
    }
    int64_t radius = mean_radius(object) + mean_radius(obstacles);
    struct cage_cell cell = {0, 0, {0, 0, 0}};
    int64_t most = scene->dim == 2 || all ? radius / 2 : 2 * radius;
    while (level < limits->max_level && cage_displacement(fibre->turn(&cell), reach) > most) {
        cage_cell_child(&cell, 0, &cell);
        level++;
    }
    /* All cells down to that level: roots (1 + c + ... + c^level) < 2 roots c^level. */
    int64_t cells = 2 * fibre->roots;
    for (int32_t i = 0; i < level; i++) {
        cells *= fibre->children;
        if (cells > (int64_t)limits->max_cells + CAGE_CELL_ROOT)
            return i;
    }
    return level;
}

static void set_ends(struct cage_proof *proof, const cage_pose *start, const cage_pose *goal)
{
    const cage_pose *pose[2] = {start, goal ? goal : start};
    proof->graph.goal = goal != NULL;
    memset(proof->graph.cell, 0, CAGE_CELL_ROOT * sizeof *proof->graph.cell);
    for (int32_t end = 0; end < CAGE_CELL_ROOT; end++) {
        proof->pose[end] = *pose[end];
        struct cage_rotation rotation;
        cage_rotation_of(pose[end]->q, &rotation);
        cage_rotate(&rotation, proof->result.pivot, proof->at[end]);
        for (int32_t k = 0; k < 3; k++)
            proof->at[end][k] += pose[end]->x[k];
        memcpy(proof->graph.cell[end].rotations.q, pose[end]->q, sizeof pose[end]->q);
        proof->graph.cell[end].parent = -1;
    }
    proof->graph.cells = CAGE_CELL_ROOT;
}

/* Half turns that take the object to itself. The pose (x, R g) of such a turn g touches what (x, R) touches, so g maps free space
 * to itself and the way out of one pose to that of the other: a pose is caged iff it is up to these turns, and a slice
 * serves for R and R g. (With a goal it is not asked: a way to an image of the goal is none to the goal.) */
static int32_t find_half_turns(struct cage_proof *proof)
{
    struct cage_graph *graph = &proof->graph;
    graph->turns = 1;
    graph->turn[0] = 0;
    for (int32_t turn = 1; turn < CAGE_TURNS && proof->scene.dim == 3 && !graph->goal && !proof->all; turn++) {
        int32_t inner = cage_side_turn(&proof->arena, turn, &proof->side[CAGE_INNER]);
        int32_t outer = inner == 1 ? cage_side_turn(&proof->arena, turn, &proof->side[CAGE_OUTER]) : inner;
        if (outer < 0)
            return outer;
        graph->turn[graph->turns] = turn;
        graph->turns += outer;
    }
    return CAGE_OK;
}

static int32_t begin(struct cage_proof *proof, const cage_pose *start, const cage_pose *goal, const struct cage_shortcuts *shortcuts)
{
    const cage_scene *scene = &proof->scene;
    cage_pivot(&scene->object, proof->result.pivot);
    for (int32_t i = 0; i < CAGE_SIDES; i++) {
        int32_t error = cage_side_make(&proof->arena, scene, proof->result.pivot, i == CAGE_INNER ? -1 : 1, shortcuts,
                                       &proof->side[i]);
        if (error != CAGE_OK)
            return error;
    }
    proof->graph.fibre = proof->scene.dim == 2 ? &cage_so2 : &cage_so3;
    proof->graph.arena = &proof->arena;
    proof->graph.capacity = proof->limits.max_cells + CAGE_CELL_ROOT;
    proof->graph.cell = cage_arena_take(&proof->arena, (size_t)proof->graph.capacity, sizeof *proof->graph.cell);
    if (!proof->graph.cell)
        return CAGE_ERROR_MEMORY;
    set_ends(proof, start, goal);
    int32_t error = find_half_turns(proof);
    if (error != CAGE_OK)
        return error;
    int32_t reach = scene->dim == 2 ? CAGE_REACH_2D : CAGE_REACH_3D;
    for (int32_t end = 0; end < CAGE_CELL_ROOT; end++)
        for (int32_t k = 0; k < 3; k++)
            if (proof->at[end][k] < -reach || proof->at[end][k] > reach)
                return CAGE_ERROR_RANGE;
    int32_t level = proof->limits.start_level;
    level = level < 0 ? cage_proof_first_level(scene, &proof->limits, proof->all) : level;
    if (!cage_graph_init(&proof->graph, level))
        return CAGE_ERROR_ARGUMENT;
    proof->result.level = proof->graph.level;
    proof->result.cells = proof->graph.cells - CAGE_CELL_ROOT;
    cage_proof_share_out(proof);
    if (cage_collides(scene, start, CAGE_SIDE_INNER) == 1)
        cage_proof_finish(proof, CAGE_IN_COLLISION, CAGE_REASON_START);
    else if (goal && cage_collides(scene, goal, CAGE_SIDE_INNER) == 1)
        cage_proof_finish(proof, CAGE_IN_COLLISION, CAGE_REASON_GOAL);
    return CAGE_OK;
}

int32_t cage_proof_begin(struct cage_proof **proof, const cage_scene *scene, const cage_pose *start, const cage_pose *goal,
                         const cage_limits *limits, const struct cage_shortcuts *shortcuts, void *memory, size_t bytes)
{
    const cage_pose nowhere = {{0, 0, 0}, {1, 0, 0, 0}};
    struct cage_arena arena;
    cage_arena_init(&arena, memory, bytes);
    struct cage_proof *made = cage_arena_take(&arena, 1, sizeof *made);
    if (!made)
        return CAGE_ERROR_MEMORY;
    memset(made, 0, sizeof *made);
    made->arena = arena;
    made->limits = *limits;
    made->scene = *scene;
    made->all = !start;
    *proof = made;
    return begin(made, start ? start : &nowhere, goal, shortcuts);
}

int32_t cage_proof_check(const cage_scene *scene, const cage_pose *start, const cage_pose *goal, const cage_limits *given,
                         int32_t side, cage_limits *limits)
{
    int32_t error = start ? cage_scene_check(scene) : CAGE_ERROR_ARGUMENT;
    if (error == CAGE_OK)
        error = cage_pose_check(scene->dim, start);
    if (error == CAGE_OK && goal)
        error = cage_pose_check(scene->dim, goal);
    if (error != CAGE_OK)
        return error;
    cage_limits_default(limits, scene->dim);
    limits->side = side;
    if (given)
        *limits = *given;
    return cage_limits_check(limits, scene->dim);
}

int32_t cage_prove_begin_small(cage_proof **proof, const cage_scene *scene, const cage_pose *start, const cage_pose *goal,
                               const cage_limits *limits, void *memory, size_t bytes)
{
    struct cage_proof *made;
    cage_limits own;
    int32_t error = proof && (memory || !bytes) ? cage_proof_check(scene, start, goal, limits, CAGE_SIDE_INNER, &own) : CAGE_ERROR_ARGUMENT;
    if (error == CAGE_OK && own.side != CAGE_SIDE_INNER)
        error = CAGE_ERROR_ARGUMENT;
    if (error == CAGE_OK)
        error = cage_proof_begin(&made, scene, start, goal, &own, NULL, memory, bytes);
    if (error != CAGE_OK)
        return error;
    cage_proof_report(made);
    *proof = made;
    return CAGE_OK;
}
