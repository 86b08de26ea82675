/* prove: the lazy, adaptive, two-sided search for one query.
 *
 *     START    build the slices of start and goal
 *     INNER    reach what the inner slices connect: closed without the target is the proof of CAGED / DISCONNECTED
 *     OUTER    try to reach the target in the outer slices, along the inner way: a path proves FREE / CONNECTED; when it has
 *              come farther but not there, INNER again, from what it has reached
 *     REFINE   cut the cell where the two sides part, keep the facts, search again
 *     PATH     write the path down, leg by leg
 *
 * A cell is explored when a search enters it. Facts (slices, gluings of cells that are still leaves) stay; what is reached is
 * searched anew over them after every refinement. */
#include "proof.h"
#include "grid.h"

#include <string.h>

enum { START, INNER, OUTER, REFINE, PATH, DONE };

/* Without a way to follow, cells are cut evenly; that stops so many levels before the finest. */
enum { UNGUIDED = 3 };

/* One step in so many. */
enum { EVEN_SHARE = 4 };

static int32_t finish(struct cage_proof *proof, int32_t verdict, int32_t reason)
{
    proof->result.verdict = verdict;
    proof->result.reason = reason;
    proof->phase = DONE;
    return CAGE_OK;
}

/* The inner side can do no more: outer searches over all cells, cut evenly where they have come. */
static void last_resort(struct cage_proof *proof, int32_t reason)
{
    proof->hopeless = reason;
    proof->corridor = 0;
    proof->phase = OUTER;
    cage_search_anew(proof, CAGE_OUTER);
}

/* In space the way that the inner slices leave open is often none, and cutting along it finds out slowly: a share of the steps goes to an
 * outer search of its own. */
static bool even_is_due(const struct cage_proof *proof)
{
    return proof->scene.dim == 3 && !proof->hopeless && proof->even == 0 && EVEN_SHARE * proof->even_steps < proof->result.steps;
}

static int32_t refine(struct cage_proof *proof)
{
    bool inner = proof->limits.side & CAGE_SIDE_INNER, outer = proof->limits.side & CAGE_SIDE_OUTER;
    bool guided = inner && proof->even != 1 && (!proof->hopeless || proof->corridor > 0);
    struct cage_node *stop = NULL;
    if (guided && outer && even_is_due(proof)) {
        proof->even = 1;
        proof->corridor = 0;
        cage_search_anew(proof, CAGE_OUTER);
        proof->phase = OUTER;
        return CAGE_OK;
    }
    int32_t cell = guided ? cage_refine_choose(proof, proof->way, &stop) : cage_refine_coarsest(proof);
    if (inner && !guided && cell >= 0 && proof->graph.cell[cell].cell.level + UNGUIDED >= proof->limits.max_level)
        cell = -1;
    if (cell >= 0 && cage_graph_refine(&proof->graph, cell)) {
        proof->result.level = proof->graph.level;
        proof->result.cells = proof->graph.cells - CAGE_CELL_ROOT;
        proof->even = proof->even == 1 ? 0 : proof->even;
    } else if (proof->even == 1) {
        proof->even = -1;
    } else if (!guided || !outer) {
        return finish(proof, CAGE_UNDEFINED, cell >= 0 ? CAGE_REASON_CELLS : CAGE_REASON_LEVEL);
    } else if (cell >= 0 || !stop->via) {
        last_resort(proof, cell >= 0 ? CAGE_REASON_CELLS : CAGE_REASON_LEVEL);
        return CAGE_OK;
    } else {
        /* This way is as fine as it may be. It may be closed all the same, but another may be open. */
        proof->hopeless = CAGE_REASON_LEVEL;
        stop->via->banned = 1;
    }
    cage_search_anew(proof, CAGE_INNER);
    cage_search_anew(proof, CAGE_OUTER);
    proof->phase = inner && !(proof->hopeless && proof->corridor == 0) ? INNER : OUTER;
    return CAGE_OK;
}

static int32_t step_start(struct cage_proof *proof)
{
    int32_t side = proof->limits.side & CAGE_SIDE_INNER ? CAGE_INNER : CAGE_OUTER;
    int32_t done = cage_search_ends(proof, side);
    if (done != CAGE_FOUND)
        return done;
    /* A search that begins outside sees everything; one that begins in a narrow place may close soon. */
    const int32_t *label = proof->label[side];
    /* What does not collide is off the inner balls; were it not so, nothing may be concluded from it. */
    if (side == CAGE_INNER && (label[CAGE_CELL_START] == CAGE_COVERED || (proof->graph.goal && label[CAGE_CELL_GOAL] == CAGE_COVERED)))
        return finish(proof, CAGE_UNDEFINED, CAGE_REASON_LEVEL);
    proof->origin = proof->graph.goal && label[CAGE_CELL_START] == CAGE_OUTSIDE && label[CAGE_CELL_GOAL] != CAGE_OUTSIDE;
    proof->phase = side == CAGE_INNER ? INNER : OUTER;
    return CAGE_OK;
}

static int32_t step_inner(struct cage_proof *proof)
{
    int32_t done = cage_search(proof, CAGE_INNER);
    if (done == CAGE_CLOSED) {
        if (!proof->hopeless)
            return finish(proof, proof->graph.goal ? CAGE_DISCONNECTED : CAGE_CAGED, CAGE_REASON_CLOSED);
        last_resort(proof, proof->hopeless);
        return CAGE_OK;
    }
    if (done != CAGE_FOUND)
        return done;
    if (!(proof->limits.side & CAGE_SIDE_OUTER)) {
        proof->phase = REFINE;
        return CAGE_OK;
    }
    proof->corridor = ++proof->corridors;
    proof->outer_work = proof->result.slices[CAGE_OUTER] + proof->result.gluings[CAGE_OUTER];
    for (const struct cage_node *node = proof->way; node; node = node->from)
        proof->graph.cell[node->cell].corridor = proof->corridor;
    proof->phase = OUTER;
    cage_search_anew(proof, CAGE_OUTER);
    return CAGE_OK;
}

/* Start or goal is too close to an obstacle to begin at, and no free leg was found to a better place. */
static bool outer_is_lost(const struct cage_proof *proof)
{
    bool lost = false;
    for (int32_t end = CAGE_CELL_START; end <= (proof->graph.goal ? CAGE_CELL_GOAL : CAGE_CELL_START); end++)
        lost = lost || (proof->graph.cell[end].facts[CAGE_OUTER].nodes > 0 && proof->label[CAGE_OUTER][end] == CAGE_COVERED);
    return lost;
}

static int32_t step_outer(struct cage_proof *proof)
{
    struct cage_node *way = proof->way;
    int32_t done = cage_search(proof, CAGE_OUTER);
    if (done == CAGE_CLOSED && outer_is_lost(proof)) {
        if (!(proof->limits.side & CAGE_SIDE_INNER) || proof->hopeless)
            return finish(proof, CAGE_UNDEFINED, CAGE_REASON_LEVEL);
        proof->limits.side = CAGE_SIDE_INNER; /* from now on */
    }
    if (done == CAGE_FOUND) {
        cage_path_begin(proof);
        proof->phase = PATH;
        return CAGE_OK;
    }
    proof->way = way;
    if (done != CAGE_CLOSED)
        return done;
    proof->phase = REFINE;
    if (proof->corridor > 0 && proof->limits.side == CAGE_SIDE_BOTH &&
        proof->outer_work < proof->result.slices[CAGE_OUTER] + proof->result.gluings[CAGE_OUTER]) {
        cage_search_anew(proof, CAGE_INNER); /* there may be a better way from where it has come */
        proof->phase = INNER;
    }
    return CAGE_OK;
}

static int32_t step_path(struct cage_proof *proof)
{
    int32_t done = cage_path_step(proof);
    if (done == 1) {
        proof->result.path = proof->path;
        proof->result.path_count = proof->path_count;
        return finish(proof, proof->graph.goal ? CAGE_CONNECTED : CAGE_FREE, CAGE_REASON_PATH);
    }
    if (done != CAGE_PATH_FAILED)
        return done;
    /* The way exists, but no leg on the grid was certified for it: leave this edge out and look for another. */
    struct cage_node *leg = proof->leg, *next = leg ? leg->next_open : NULL;
    if (!leg || (!leg->via && !next))
        return finish(proof, CAGE_UNDEFINED, CAGE_REASON_LEVEL);
    (leg->via ? leg : next)->via->banned = 1;
    last_resort(proof, CAGE_REASON_LEVEL);
    return CAGE_OK;
}

static int32_t step(struct cage_proof *proof)
{
    switch (proof->phase) {
    case START:
        return step_start(proof);
    case INNER:
        return step_inner(proof);
    case OUTER:
        return step_outer(proof);
    case REFINE:
        return refine(proof);
    default:
        return step_path(proof);
    }
}

/* ---- beginning ------------------------------------------------------------------------------------ */

void cage_limits_default(cage_limits *limits, int32_t dim)
{
    if (!limits)
        return;
    limits->side = CAGE_SIDE_BOTH;
    limits->start_level = -1;
    limits->max_level = dim == 2 ? 12 : 8;
    limits->max_cells = dim == 2 ? 16384 : 131072;
}

static int32_t limits_check(const cage_limits *limits, int32_t dim)
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

/* The coarsest level at which the object's farthest ball moves by no more than a third of the radius of a usual collision ball: in coarser
 * cells the inner balls shrink to little, and what is left has holes everywhere. In space, twice the radius: there a level too fine costs
 * 8 times as much, and one too coarse is soon found out. */
static int32_t first_level(const struct cage_proof *proof)
{
    const struct cage_side *side = &proof->side[CAGE_INNER];
    int64_t sum = 0;
    int32_t reach = 0, level = 0;
    if (side->objects == 0 || side->obstacles == 0)
        return 0;
    for (int32_t j = 0; j < side->obstacles; j++)
        sum += side->obstacle[j].r;
    int64_t radius = sum / side->obstacles;
    for (int32_t a = 0; a < side->objects; a++)
        reach = side->reach[a] > reach ? side->reach[a] : reach;
    sum = 0;
    for (int32_t a = 0; a < side->objects; a++)
        sum += side->object[a].r;
    radius += sum / side->objects;
    struct cage_cell cell = {0, 0, {0, 0, 0}};
    int64_t most = proof->scene.dim == 2 ? radius / 3 : 2 * radius;
    while (level < proof->limits.max_level && cage_displacement(proof->graph.fibre->turn(&cell), reach) > most) {
        proof->graph.fibre->child(&cell, 0, &cell);
        level++;
    }
    /* All cells down to that level: roots (1 + c + ... + c^level) < 2 roots c^level. */
    int64_t cells = 2 * proof->graph.fibre->roots;
    for (int32_t i = 0; i < level; i++) {
        cells *= proof->graph.fibre->children;
        if (cells > proof->graph.capacity)
            return i;
    }
    return level;
}

/* What is left of the block is shared out: a quarter for facts, a quarter to hold slices, half to work in. */
static void share_out(struct cage_proof *proof)
{
    size_t left = proof->arena.size - proof->arena.used, quarter = left / 4 / CAGE_ALIGN * CAGE_ALIGN;
    unsigned char *at = proof->arena.base + proof->arena.used + quarter;
    proof->arena.size = proof->arena.used + quarter;
    cage_store_init(&proof->store, at, quarter);
    cage_arena_init(&proof->scratch, at + quarter, left - 2 * quarter);
}

static uint64_t fixed_bytes(const cage_scene *scene, const cage_limits *limits)
{
    uint64_t objects = (uint64_t)scene->object.inner_count + (uint64_t)scene->object.outer_count;
    return sizeof(struct cage_proof) + objects * (sizeof(cage_ball) + sizeof(int32_t)) +
           ((uint64_t)limits->max_cells + CAGE_CELL_ROOT) * sizeof(struct cage_leaf) + 16 * CAGE_ALIGN;
}

size_t cage_prove_size(const cage_scene *scene, const cage_limits *limits)
{
    cage_limits defaults;
    if (cage_scene_check(scene) != CAGE_OK)
        return 0;
    if (!limits) {
        cage_limits_default(&defaults, scene->dim);
        limits = &defaults;
    }
    if (limits_check(limits, scene->dim) != CAGE_OK)
        return 0;
    uint64_t inner = (uint64_t)scene->object.inner_count * (uint64_t)scene->obstacles.inner_count;
    uint64_t outer = (uint64_t)scene->object.outer_count * (uint64_t)scene->obstacles.outer_count, pairs = inner > outer ? inner : outer;
    /* A mixture of two slices: 2 pairs balls, at most 4 triangles each while building; in space usually less than 9 tetrahedra. */
    uint64_t work = (scene->dim == 2 ? 600 : 1400) * pairs + 32768, facts = 32768 + 64 * (uint64_t)limits->max_cells;
    uint64_t all = fixed_bytes(scene, limits) + 4 * (work / 2 > facts ? work / 2 : facts); /* < 2^42 */
    return all > SIZE_MAX ? SIZE_MAX : (size_t)all;
}

/* A block in which the allocation that failed would succeed; a later one of the same step may fail in it. */
static uint64_t memory_needed(const struct cage_proof *proof)
{
    size_t quarter = proof->store.size, most = 2 * quarter;
    if (proof->scratch.needed > proof->scratch.size)
        most = proof->scratch.needed / 2 + CAGE_ALIGN;
    else if (proof->arena.needed > proof->arena.size)
        most = quarter + (proof->arena.needed - proof->arena.size) + CAGE_ALIGN;
    most = most < quarter + quarter / 2 ? quarter + quarter / 2 : most;
    return proof->arena.size - quarter + 4 * (uint64_t)most + 16 * CAGE_ALIGN;
}

static void set_ends(struct cage_proof *proof, const cage_pose *start, const cage_pose *goal)
{
    const cage_pose *pose[2] = {start, goal ? goal : start};
    proof->graph.goal = goal != NULL;
    memset(proof->graph.cell, 0, CAGE_CELL_ROOT * sizeof *proof->graph.cell);
    for (int32_t end = 0; end < CAGE_CELL_ROOT; end++) {
        proof->pose[end] = *pose[end];
        cage_pose_pivot(pose[end], proof->result.pivot, proof->at[end]);
        memcpy(proof->graph.cell[end].rotations.q, pose[end]->q, sizeof pose[end]->q);
        proof->graph.cell[end].parent = -1;
    }
    proof->graph.cells = CAGE_CELL_ROOT;
}

static int32_t begin(struct cage_proof *proof, const cage_pose *start, const cage_pose *goal)
{
    const cage_scene *scene = &proof->scene;
    cage_pivot(&scene->object, proof->result.pivot);
    for (int32_t i = 0; i < CAGE_SIDES; i++) {
        int32_t error = cage_side_make(&proof->arena, scene, proof->result.pivot, i == CAGE_INNER ? -1 : 1, &proof->side[i]);
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
    int32_t reach = scene->dim == 2 ? CAGE_REACH_2D : CAGE_REACH_3D;
    for (int32_t end = 0; end < CAGE_CELL_ROOT; end++)
        for (int32_t k = 0; k < 3; k++)
            if (proof->at[end][k] < -reach || proof->at[end][k] > reach)
                return CAGE_ERROR_RANGE;
    int32_t level = proof->limits.start_level < 0 ? first_level(proof) : proof->limits.start_level;
    if (!cage_graph_init(&proof->graph, level))
        return CAGE_ERROR_ARGUMENT;
    proof->result.level = proof->graph.level;
    proof->result.cells = proof->graph.cells - CAGE_CELL_ROOT;
    share_out(proof);
    proof->phase = START;
    if (cage_collides(scene, start, CAGE_SIDE_INNER) == 1)
        return finish(proof, CAGE_IN_COLLISION, CAGE_REASON_START);
    if (goal && cage_collides(scene, goal, CAGE_SIDE_INNER) == 1)
        return finish(proof, CAGE_IN_COLLISION, CAGE_REASON_GOAL);
    return CAGE_OK;
}

int32_t cage_prove_begin(cage_proof **proof, const cage_scene *scene, const cage_pose *start, const cage_pose *goal,
                         const cage_limits *limits, void *memory, size_t bytes)
{
    if (!proof || !scene || !start || (!memory && bytes))
        return CAGE_ERROR_ARGUMENT;
    int32_t error = cage_scene_check(scene);
    if (error == CAGE_OK)
        error = cage_pose_check(scene->dim, start);
    if (error == CAGE_OK && goal)
        error = cage_pose_check(scene->dim, goal);
    cage_limits defaults;
    cage_limits_default(&defaults, scene->dim);
    if (error == CAGE_OK)
        error = limits_check(limits ? limits : &defaults, scene->dim);
    if (error != CAGE_OK)
        return error;
    struct cage_arena arena;
    cage_arena_init(&arena, memory, bytes);
    struct cage_proof *made = cage_arena_take(&arena, 1, sizeof *made);
    if (!made)
        return CAGE_ERROR_MEMORY;
    memset(made, 0, sizeof *made);
    made->arena = arena;
    made->limits = limits ? *limits : defaults;
    made->scene = *scene;
    error = begin(made, start, goal);
    if (error == CAGE_OK)
        *proof = made;
    return error;
}

/* ---- running -------------------------------------------------------------------------------------- */

int32_t cage_prove_run(cage_proof *proof, int64_t steps)
{
    if (!proof)
        return CAGE_ERROR_ARGUMENT;
    for (; steps > 0 && proof->phase != DONE && proof->error == CAGE_OK; steps--) {
        proof->even_steps += proof->even == 1;
        int32_t error = step(proof);
        proof->result.steps++;
        if (error < 0)
            proof->error = error;
    }
    size_t used = proof->arena.peak + proof->scratch.peak;
    proof->result.peak_bytes = used;
    if (proof->error == CAGE_ERROR_MEMORY)
        proof->result.needed_bytes = memory_needed(proof);
    return proof->error != CAGE_OK ? proof->error : proof->phase == DONE;
}

const cage_result *cage_prove_result(const cage_proof *proof)
{
    return proof ? &proof->result : NULL;
}
