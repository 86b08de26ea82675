/* room: how a proof's block is shared out, and how large it should be. */
#include "proof.h"

static uint64_t fixed_bytes(const cage_scene *scene, const cage_limits *limits)
{
    uint64_t objects = (uint64_t)scene->object.inner_count + (uint64_t)scene->object.outer_count;
    return sizeof(struct cage_proof) + objects * (sizeof(cage_ball) + CAGE_TURNS * sizeof(int32_t)) +
           ((uint64_t)limits->max_cells + CAGE_CELL_ROOT) * sizeof(struct cage_leaf) + 24 * CAGE_ALIGN;
}

/* CAGE_PROVE_BYTES takes these to be large enough; else this divides by 0. */
enum { HEAD_BYTES = sizeof(struct cage_proof) + 24 * CAGE_ALIGN, CELL_BYTES = sizeof(struct cage_leaf) };
enum { PROVE_BYTES_HOLDS = 1 / (HEAD_BYTES <= 2048 && CELL_BYTES <= 112 ? 1 : 0) };

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

void cage_proof_share_out(struct cage_proof *proof)
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
    uint64_t facts = CAGE_FACTS_BYTES + 32 * (uint64_t)limits->max_cells;
    return fixed_bytes(scene, limits) + facts + 24576 + (scene->dim == 2 ? 300 : 900) * (inner > outer ? inner : outer); /* < 2^40 */
}

/* A block in which the allocation that failed would succeed; a later one of the same step may fail in it. */
uint64_t cage_proof_needed(const struct cage_proof *proof)
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
