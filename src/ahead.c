/* ahead: slices and gluings that a search will ask for next, made beforehand by several workers.
 *
 * The search itself stays sequential: it takes the same steps, finding some results ready. What is ready depends on
 * the workers, what a result is does not. */
#include "proof.h"

/* Near its end scratch is used in earnest, so that memory runs out at the same place. */
enum { NEAR_END = 4096 };

/* Misses before looking ahead again; twice as many each time that hardly anything was found. */
enum { PATIENCE = 3, PATIENCE_MAX = 24, WORTHWHILE = 4 };

/* Open nodes looked at, and the least memory for a worker. */
enum { NODES = 64, LEAST = 1 << 16 };

bool cage_workers_are_valid(const cage_workers *workers)
{
    return !workers || (workers->count >= 1 && workers->count <= CAGE_WORKERS && workers->run &&
                        (workers->memory || !workers->bytes));
}

static const struct cage_unit *find(struct cage_ahead *ahead, const struct cage_proof *proof, int32_t side, int32_t a, int32_t b,
                                    int32_t seed, struct cage_arena *scratch)
{
    for (int32_t i = 0; i < ahead->units; i++) {
        struct cage_unit *unit = &ahead->unit[i];
        if (!unit->done || unit->proof != proof || unit->side != side || unit->a != a || unit->b != b ||
            (b >= 0 && unit->seed != seed))
            continue;
        if (scratch->size - scratch->used < unit->peak + NEAR_END)
            break;
        scratch->peak = scratch->peak > scratch->used + unit->peak ? scratch->peak : scratch->used + unit->peak;
        scratch->used += unit->used;
        unit->done = false;
        return unit;
    }
    ahead->missed++;
    return NULL;
}

struct cage_ahead *cage_ahead_make(const cage_workers *workers)
{
    struct cage_arena all;
    int32_t count = workers->count;
    cage_arena_init(&all, workers->memory, workers->bytes);
    struct cage_ahead *ahead = cage_arena_take(&all, 1, sizeof *ahead);
    size_t each = ahead ? cage_arena_room(&all, 1) / (size_t)count / CAGE_ALIGN * CAGE_ALIGN : 0;
    if (each < LEAST)
        return NULL;
    for (int32_t i = 0; i < count; i++)
        cage_arena_init(&ahead->arena[i], all.base + all.used + (size_t)i * each, each);
    ahead->find = find;
    ahead->units = 0;
    ahead->missed = ahead->patience = PATIENCE;
    return ahead;
}

bool cage_ahead_is_due(const struct cage_ahead *ahead)
{
    return ahead->missed >= ahead->patience;
}

bool cage_ahead_add(struct cage_ahead *ahead, const struct cage_proof *proof, int32_t side, int32_t a, int32_t b, int32_t seed)
{
    if (ahead->units == CAGE_UNITS)
        return false;
    for (int32_t i = 0; i < ahead->units; i++) {
        const struct cage_unit *other = &ahead->unit[i];
        bool same = other->a == a && other->b == b, turned = other->a == b && other->b == a;
        if (other->proof == proof && other->side == side && (same || turned))
            return true;
    }
    struct cage_unit *unit = &ahead->unit[ahead->units++];
    unit->proof = proof;
    unit->side = side;
    unit->a = a;
    unit->b = b;
    unit->seed = seed;
    unit->done = false;
    return ahead->units < CAGE_UNITS;
}

bool cage_ahead_has(const struct cage_ahead *ahead, const struct cage_proof *proof, int32_t side, int32_t cell)
{
    bool has = false;
    for (int32_t i = 0; i < ahead->units; i++) {
        const struct cage_unit *unit = &ahead->unit[i];
        has = has || (unit->proof == proof && unit->side == side && unit->a == cell && unit->b < 0);
    }
    return has;
}

/* What the search does next, as far as that is known: until there are `most` units. */
static void look(struct cage_ahead *ahead, const struct cage_proof *proof, int32_t most)
{
    int32_t side = cage_proof_searching(proof);
    const struct cage_node *node = side >= 0 ? proof->reach[side].open_head : NULL;
    for (int32_t n = 0; node && n < NODES && ahead->units < most - 2; n++, node = node->next_open) {
        if (node->settled == -1)
            continue;
        int32_t next = cage_search_unglued(proof, side, node, -1);
        for (; next >= 0 && ahead->units < most - 2; next = cage_search_unglued(proof, side, node, next)) {
            if (!proof->graph.cell[next].facts[side].held)
                cage_ahead_add(ahead, proof, side, next, -1, 0);
            if (!proof->graph.cell[node->cell].facts[side].held)
                cage_ahead_add(ahead, proof, side, node->cell, -1, 0);
            cage_ahead_add(ahead, proof, side, node->cell, next, node->component);
        }
    }
}

/* The slice, if there is one already. */
static const struct cage_slice *slice_of(const struct cage_ahead *ahead, const struct cage_unit *unit, int32_t cell)
{
    const struct cage_held *held = unit->proof->graph.cell[cell].facts[unit->side].held;
    for (int32_t i = 0; i < ahead->units && !held; i++) {
        const struct cage_unit *other = &ahead->unit[i];
        if (other->b < 0 && other->done && other->proof == unit->proof && other->side == unit->side && other->a == cell)
            return &other->slice;
    }
    return held ? &held->slice : NULL;
}

static void work(void *data, int32_t index, int32_t worker)
{
    struct cage_ahead *ahead = data;
    struct cage_unit *unit = &ahead->unit[ahead->first + index];
    struct cage_arena *arena = &ahead->arena[worker];
    size_t mark = arena->used;
    int32_t error = CAGE_ERROR_MEMORY;
    if (ahead->gluing != (unit->b >= 0))
        return;
    arena->peak = mark;
    if (!ahead->gluing) {
        error = cage_search_make(unit->proof, arena, unit->side, unit->a, &unit->slice);
        if (error == CAGE_OK && unit->proof->all)
            error = cage_chart_make(arena, &unit->slice, &unit->chart);
    } else {
        const struct cage_slice *c = slice_of(ahead, unit, unit->a), *d = slice_of(ahead, unit, unit->b);
        if (c && d)
            error = cage_glue_matched(arena, c, d, cage_proof_match(unit->proof, unit->side, unit->a, unit->b), unit->seed,
                                      &unit->touch, &unit->count, &unit->mixed);
    }
    unit->done = error == CAGE_OK;
    unit->used = arena->used - mark;
    unit->peak = arena->peak - mark;
    if (error != CAGE_OK)
        cage_arena_release(arena, mark);
}

static bool is_leaf(const struct cage_unit *unit, int32_t cell) { return cell < 0 || unit->proof->graph.cell[cell].child == 0; }

void cage_ahead_tidy(struct cage_ahead *ahead, const cage_workers *workers)
{
    bool full = false;
    int32_t kept = 0;
    for (int32_t i = 0; i < workers->count; i++)
        full = full || ahead->arena[i].used > ahead->arena[i].size / 2;
    for (int32_t i = 0; i < ahead->units && !full; i++) {
        const struct cage_unit *unit = &ahead->unit[i];
        if (unit->done && is_leaf(unit, unit->a) && is_leaf(unit, unit->b))
            ahead->unit[kept++] = *unit;
    }
    for (int32_t i = 0; i < workers->count && kept == 0; i++)
        cage_arena_release(&ahead->arena[i], 0);
    ahead->units = ahead->first = kept;
    ahead->missed = 0;
}

void cage_ahead_do(struct cage_ahead *ahead, const cage_workers *workers)
{
    int32_t fresh = ahead->units - ahead->first, longer = 2 * ahead->patience;
    ahead->patience = fresh >= WORTHWHILE ? PATIENCE : longer < PATIENCE_MAX ? longer : PATIENCE_MAX;
    for (int32_t half = 0; half < 2 && fresh > 1; half++) {
        ahead->gluing = half == 1;
        workers->run(workers->context, fresh, work, ahead);
    }
}

void cage_ahead_work(struct cage_ahead *ahead, const struct cage_proof *proof, const cage_workers *workers)
{
    cage_ahead_tidy(ahead, workers);
    look(ahead, proof, proof->second ? CAGE_UNITS * 3 / 4 : CAGE_UNITS);
    if (proof->second)
        look(ahead, proof->second, CAGE_UNITS);
    cage_ahead_do(ahead, workers);
}

int32_t cage_prove_run_with(cage_proof *proof, int64_t steps, const cage_workers *workers)
{
    if (!proof || !cage_workers_are_valid(workers))
        return CAGE_ERROR_ARGUMENT;
    struct cage_ahead *ahead = workers ? cage_ahead_make(workers) : NULL;
    struct cage_proof *second = proof->second;
    if (!ahead)
        return cage_prove_run(proof, steps);
    proof->ahead = ahead;
    if (second)
        second->ahead = ahead;
    int32_t state = cage_prove_run(proof, 0);
    for (; steps > 0 && state == 0; steps--) {
        if (cage_ahead_is_due(ahead))
            cage_ahead_work(ahead, proof, workers);
        state = cage_prove_run(proof, 1);
    }
    proof->ahead = NULL;
    if (second)
        second->ahead = NULL;
    return state;
}
