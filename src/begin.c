/* begin: limits, how much memory, and the first state of a proof. */
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

/* The coarsest level at which the object's farthest ball moves by no more than half the radius of a usual
 * collision ball: in coarser cells the inner balls shrink to little, and what is left has holes everywhere. For a proof in
 * space, twice the radius: there a level too fine costs 8 times as much, and one too coarse is soon found out. */
int32_t cage_proof_first_level(const cage_scene *scene, const cage_limits *limits, bool all)
{
    const struct cage_fibre *fibre = scene->dim == 2 ? &cage_so2 : &cage_so3;
    const cage_shape *object = &scene->object, *obstacles = &scene->obstacles;
    int32_t reach = 0, level = 0, pivot[3];
    int64_t radius = 0, sum = 0;
    if (object->inner_count == 0 || obstacles->inner_count == 0)
        return 0;
    cage_pivot(object, pivot);
    for (int32_t i = 0; i < object->inner_count; i++) {
        int32_t far = cage_reach(&object->inner[i], pivot);
        reach = far > reach ? far : reach;
        radius += object->inner[i].r;
    }
    for (int32_t j = 0; j < obstacles->inner_count; j++)
        sum += obstacles->inner[j].r;
    radius = (int64_t)(cage_u64_divide((uint64_t)radius, (uint64_t)object->inner_count) +
                       cage_u64_divide((uint64_t)sum, (uint64_t)obstacles->inner_count));
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

static uint64_t fixed_bytes(const cage_scene *scene, const cage_limits *limits)
{
    uint64_t objects = (uint64_t)scene->object.inner_count + (uint64_t)scene->object.outer_count;
    return sizeof(struct cage_proof) + objects * (sizeof(cage_ball) + CAGE_TURNS * sizeof(int32_t)) +
           ((uint64_t)limits->max_cells + CAGE_CELL_ROOT) * sizeof(struct cage_leaf) + 24 * CAGE_ALIGN;
}

/* To work in: a mixture of two slices has 2 pairs balls, at most 4 triangles each while building; in space usually less than
 * 9 tetrahedra. */
static uint64_t work_bytes(const cage_scene *scene)
{
    uint64_t inner = (uint64_t)scene->object.inner_count * (uint64_t)scene->obstacles.inner_count;
    uint64_t outer = (uint64_t)scene->object.outer_count * (uint64_t)scene->obstacles.outer_count;
    return (scene->dim == 2 ? 600 : 1400) * (inner > outer ? inner : outer) + 32768;
}

/* What is left of the block is shared out: of the first 256 KiB a 16th for facts and 9 20ths to work in, of what is beyond an
 * eighth and half; all others are to hold slices, at the expense of which there can be more of the other two later, and so is
 * what working cannot take: the most it ever takes and a sixteenth. (Each part grows with the block: a larger one serves as
 * well.) Where all facts are kept, half is for them and an eighth to work in. */
enum { FACTS_PART = 8, WORK_PART = 2, ALL_FACTS_PART = 2, ALL_WORK_PART = 8, LEAST_WORK_PART = 16, WORK_TIMES = 4, ALL_TIMES = 3 };
enum { FIRST_BYTES = 256 << 10, FIRST_FACTS_PART = 16, FIRST_WORK_20THS = 9, SPARE_POSES = 64 };

static size_t facts_part(const struct cage_proof *proof) { return proof->all ? ALL_FACTS_PART : FACTS_PART; }
static size_t work_part(const struct cage_proof *proof) { return proof->all ? ALL_WORK_PART : WORK_PART; }

static void share_out(struct cage_proof *proof)
{
    size_t left = proof->arena.size - proof->arena.used, first = left < FIRST_BYTES ? left : FIRST_BYTES;
    first = proof->all ? 0 : first;
    size_t facts = (first / FIRST_FACTS_PART + (left - first) / facts_part(proof)) / CAGE_ALIGN * CAGE_ALIGN;
    uint64_t most = first / 20 * FIRST_WORK_20THS + (left - first) / work_part(proof);
    uint64_t work = WORK_TIMES * work_bytes(&proof->scene) + left / LEAST_WORK_PART;
    size_t hold = left - facts - (size_t)(work < most ? work : most);
    hold = hold / CAGE_ALIGN * CAGE_ALIGN;
    unsigned char *at = proof->arena.base + proof->arena.used + facts;
    proof->shared = left;
    proof->fixed = proof->arena.used;
    proof->arena.size = proof->arena.used + facts;
    cage_store_init(&proof->store, at, hold);
    cage_arena_init(&proof->scratch, at + hold, left - facts - hold);
}

/* A part that has to grow grows to one of the sizes with so many binary digits: where it began does not matter then, so that a
 * larger block still serves. `least`: at least to this. */
enum { WORK_DIGITS = 6, FACTS_DIGITS = 5 };

static size_t grown(size_t size, size_t least, uint32_t digits)
{
    size_t beyond = least > size ? least - 1 : size;
    uint32_t bits = cage_u64_bits(beyond);
    size_t unit = bits > digits + 3 ? (size_t)1 << (bits - digits) : CAGE_ALIGN;
    return (beyond / unit + 1) * unit;
}

static bool make_room_to_work(struct cage_proof *proof)
{
    struct cage_arena *scratch = &proof->scratch;
    struct cage_store *store = &proof->store;
    size_t more = grown(scratch->size, 0, WORK_DIGITS) - scratch->size, peak = scratch->peak;
    if (more > store->size)
        return false;
    cage_store_clear(store);
    cage_store_init(store, store->base, store->size - more);
    cage_arena_init(scratch, scratch->base - more, scratch->size + more);
    scratch->peak = peak;
    return true;
}

bool cage_proof_make_room(struct cage_proof *proof)
{
    struct cage_arena *arena = &proof->arena;
    struct cage_store *store = &proof->store;
    if (proof->scratch.needed > proof->scratch.size)
        return make_room_to_work(proof);
    size_t missing = arena->needed > arena->size ? arena->needed - arena->size : 0, facts = arena->size - proof->fixed;
    if (proof->path && proof->path_count == proof->path_room)
        missing = SPARE_POSES * sizeof *proof->path;
    size_t more = grown(facts, facts + missing, FACTS_DIGITS) - facts;
    if (missing == 0 || more > store->size)
        return false;
    cage_store_clear(store);
    cage_store_init(store, store->base + more, store->size - more);
    arena->size += more;
    arena->needed = 0;
    if (proof->path)
        proof->path_room = (int32_t)((arena->size - arena->used) / sizeof *proof->path);
    return true;
}

uint64_t cage_proof_size(const cage_scene *scene, const cage_limits *limits)
{
    uint64_t inner = (uint64_t)scene->object.inner_count * (uint64_t)scene->obstacles.inner_count;
    uint64_t outer = (uint64_t)scene->object.outer_count * (uint64_t)scene->obstacles.outer_count;
    uint64_t facts = 16384 + 32 * (uint64_t)limits->max_cells;
    return fixed_bytes(scene, limits) + facts + 24576 + (scene->dim == 2 ? 300 : 900) * (inner > outer ? inner : outer); /* < 2^40 */
}

/* Both sides in space, and enough cells for two searches: one for each CAGE_SECOND_CELLS goes to the second. */
static bool has_second(const cage_scene *scene, const cage_limits *limits)
{
    int32_t level = limits->start_level < 0 ? 0 : limits->start_level, least = 4;
    if (scene->dim != 3 || limits->side != CAGE_SIDE_BOTH)
        return false;
    while (level-- > 0)
        least = 8 * least + 4; /* <= max_cells <= 2^24 */
    return limits->max_cells / CAGE_SECOND_CELLS >= least;
}

static void share_limits(const cage_limits *limits, cage_limits *first, cage_limits *second)
{
    *first = *second = *limits;
    second->side = CAGE_SIDE_OUTER;
    second->max_cells = limits->max_cells / CAGE_SECOND_CELLS;
    first->max_cells -= second->max_cells;
}

/* The second search has a third of the block. */
static size_t bytes_of_second(size_t bytes) { return bytes / 3; }

/* CAGE_PROVE_BYTES takes these to be large enough; else this divides by 0. */
enum { HEAD_BYTES = sizeof(struct cage_proof) + 24 * CAGE_ALIGN, CELL_BYTES = sizeof(struct cage_leaf) };
enum { PROVE_BYTES_HOLDS = 1 / (HEAD_BYTES <= 2048 && CELL_BYTES <= 112 ? 1 : 0) };

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
    uint64_t all = cage_proof_size(scene, limits);
    if (has_second(scene, limits)) {
        cage_limits first, second;
        share_limits(limits, &first, &second);
        uint64_t other = 3 * cage_proof_size(scene, &second);
        all = cage_proof_size(scene, &first) * 3 / 2;
        all = (all > other ? all : other) + 4 * CAGE_ALIGN;
    }
    return all > SIZE_MAX ? SIZE_MAX : (size_t)all;
}

/* A block in which the allocation that failed would succeed; a later one of the same step may fail in it. */
static uint64_t needed_by_one(const struct cage_proof *proof)
{
    uint64_t shared = 0, least = proof->shared + proof->shared / 2;
    if (proof->scratch.needed > proof->scratch.size) {
        uint64_t needed = (uint64_t)proof->scratch.needed + CAGE_ALIGN, ever = WORK_TIMES * work_bytes(&proof->scene);
        uint64_t beyond = needed > ever ? LEAST_WORK_PART * (needed - ever) : 0, times = proof->all ? ALL_TIMES : WORK_PART;
        shared = beyond > times * needed ? beyond : times * needed;
    } else if (proof->arena.needed > proof->arena.size) {
        shared = proof->shared + facts_part(proof) * ((uint64_t)(proof->arena.needed - proof->arena.size) + CAGE_ALIGN);
    }
    return proof->fixed + (shared < least ? least : shared) + 16 * CAGE_ALIGN;
}

uint64_t cage_proof_needed(const struct cage_proof *proof)
{
    if (!proof->second)
        return needed_by_one(proof);
    bool other = proof->second->error == CAGE_ERROR_MEMORY;
    uint64_t needed = needed_by_one(other ? proof->second : proof);
    return (other ? 3 * needed : needed + needed / 2) + 4 * CAGE_ALIGN;
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
    share_out(proof);
    if (cage_collides(scene, start, CAGE_SIDE_INNER) == 1)
        cage_proof_finish(proof, CAGE_IN_COLLISION, CAGE_REASON_START);
    else if (goal && cage_collides(scene, goal, CAGE_SIDE_INNER) == 1)
        cage_proof_finish(proof, CAGE_IN_COLLISION, CAGE_REASON_GOAL);
    return CAGE_OK;
}

static int32_t begin_one(struct cage_proof **proof, const cage_scene *scene, const cage_pose *start, const cage_pose *goal,
                         const cage_limits *limits, bool all, void *memory, size_t bytes)
{
    struct cage_arena arena;
    cage_arena_init(&arena, memory, bytes);
    struct cage_proof *made = cage_arena_take(&arena, 1, sizeof *made);
    if (!made)
        return CAGE_ERROR_MEMORY;
    memset(made, 0, sizeof *made);
    made->arena = arena;
    made->limits = *limits;
    made->scene = *scene;
    made->all = all;
    *proof = made;
    return begin(made, start, goal);
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
    if (!limits)
        limits = &defaults;
    bool two = has_second(scene, limits);
    cage_limits of_first = *limits, of_second;
    if (two)
        share_limits(limits, &of_first, &of_second);
    size_t part = two ? bytes_of_second(bytes) : 0;
    struct cage_proof *made, *second = NULL;
    error = begin_one(&made, scene, start, goal, &of_first, false, memory, bytes - part);
    if (error == CAGE_OK && two && !cage_proof_is_done(made))
        error = begin_one(&second, scene, start, goal, &of_second, false, (unsigned char *)memory + (bytes - part), part);
    if (error != CAGE_OK)
        return error;
    made->second = second;
    cage_proof_total(made);
    *proof = made;
    return CAGE_OK;
}

int32_t cage_proof_begin_all(struct cage_proof **proof, const cage_scene *scene, const cage_limits *limits, void *memory,
                             size_t bytes)
{
    const cage_pose nowhere = {{0, 0, 0}, {1, 0, 0, 0}};
    int32_t error = limits_check(limits, scene->dim);
    return error != CAGE_OK ? error : begin_one(proof, scene, &nowhere, NULL, limits, true, memory, bytes);
}
