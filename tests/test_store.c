/* test_store.c: the ring of slices, and proofs in blocks so small that slices are dropped and built again. */
#include "support.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "proof.h"
#include "referee.h"
#include "scenes.h"

enum { PLENTY = 16 << 20, OWNERS = 12 };

static int32_t run(const question *q, void *memory, size_t bytes, cage_result *r, int32_t *held, int32_t *built)
{
    cage_proof *proof;
    int32_t error = cage_prove_begin(&proof, q->view, q->start, q->goal, q->limits, memory, bytes);
    if (error != CAGE_OK)
        return error;
    int32_t done = cage_prove_run(proof, INT64_MAX);
    *r = *cage_prove_result(proof);
    *held = *built = 0;
    for (int32_t cell = 0; cell < proof->graph.cells; cell++)
        for (int32_t side = 0; side < CAGE_SIDES; side++) {
            *held += proof->graph.cell[cell].facts[side].held != NULL;
            *built += proof->graph.cell[cell].facts[side].nodes > 0;
        }
    return done < 0 ? done : CAGE_OK;
}

/* The least block that will do, to a 64th part: found by halving, as more never hurts (which is checked on the way). */
static size_t least_block(const question *q, unsigned char *memory, const cage_result *right, size_t *failed)
{
    size_t low = 0, high = PLENTY;
    while (high - low > high / 64) {
        size_t bytes = low + (high - low) / 2;
        cage_result r;
        int32_t held, built, error = run(q, memory, bytes, &r, &held, &built);
        ck_assert(error == CAGE_OK || error == CAGE_ERROR_MEMORY);
        if (error != CAGE_OK) {
            low = bytes;
            continue;
        }
        ck_assert_msg(!referee_difference(right, &r, 0), "%s", referee_difference(right, &r, 0));
        high = bytes;
    }
    *failed = low;
    return high;
}

/* needed_bytes leads from a block that is too small to one that will do, in few steps. */
static void follow_needed(const question *q, unsigned char *memory, size_t bytes, const cage_result *right)
{
    int32_t held, built, error = CAGE_ERROR_MEMORY;
    for (int32_t tries = 0; tries < 40; tries++) {
        cage_result r;
        cage_proof *proof;
        error = cage_prove_begin(&proof, q->view, q->start, q->goal, q->limits, memory, bytes);
        if (error == CAGE_ERROR_MEMORY) { /* no room even to begin */
            bytes *= 2;
            continue;
        }
        error = run(q, memory, bytes, &r, &held, &built);
        if (error == CAGE_OK) {
            ck_assert_msg(!referee_difference(right, &r, 0), "%s", referee_difference(right, &r, 0));
            return;
        }
        ck_assert_int_eq(error, CAGE_ERROR_MEMORY);
        ck_assert(r.needed_bytes > bytes && r.needed_bytes <= PLENTY);
        bytes = (size_t)r.needed_bytes;
    }
    ck_assert_msg(0, "%zu bytes are still not enough", bytes);
}

START_TEST(dropped_slices_change_nothing)
{
    unsigned char *memory = test_alloc(PLENTY), *spare = test_alloc(PLENTY);
    int32_t rounds = test_rounds(20), dropped = 0, proofs = 0;
    for (int32_t seed = 0; seed < rounds; seed++) {
        scene s;
        scene_random((uint64_t)seed + 900000, &s);
        cage_scene view = scene_view(&s);
        cage_limits limits;
        cage_limits_default(&limits, 2);
        limits.max_level = 6;
        limits.max_cells = 96;
        const question q = {&view, &s.start, scene_goal(&s), &limits};
        cage_result right, r;
        int32_t held, built;
        memset(memory, 0xa5, PLENTY);
        ck_assert_int_eq(run(&q, memory, PLENTY, &right, &held, &built), CAGE_OK);
        ck_assert_int_eq(held, built); /* nothing was dropped */
        size_t too_little, enough = least_block(&q, spare, &right, &too_little);
        ck_assert_int_eq(run(&q, spare, enough, &r, &held, &built), CAGE_OK);
        ck_assert_msg(!referee_difference(&right, &r, 0), "seed %d: %s", (int)seed, referee_difference(&right, &r, 0));
        dropped += held < built;
        proofs++;
        for (int32_t k = 1; k <= 3; k++) {
            ck_assert_int_eq(run(&q, spare, enough + (enough >> 3) * (size_t)k + (size_t)k, &r, &held, &built), CAGE_OK);
            ck_assert_msg(!referee_difference(&right, &r, 0), "seed %d: %s", (int)seed, referee_difference(&right, &r, 0));
        }
        if (seed % 4 == 0)
            follow_needed(&q, spare, too_little, &right);
    }
    printf("store: %d proofs in blocks just large enough, %d of them dropped slices\n", (int)proofs, (int)dropped);
    ck_assert_int_gt(2 * dropped, proofs);
    free(memory);
    free(spare);
}
END_TEST

/* Where memory is short its parts grow, each at the expense of slices held: a larger block serves as well, always. */
START_TEST(larger_blocks_serve)
{
    static const struct {
        int32_t seed, side;
    } asked[] = {{9, CAGE_SIDE_OUTER}, {900001, CAGE_SIDE_BOTH}, {900004, CAGE_SIDE_INNER}, {900007, CAGE_SIDE_BOTH}};
    unsigned char *memory = test_alloc(PLENTY);
    for (int32_t i = test_rounds(4); i-- > 0;) {
        scene s;
        scene_random((uint64_t)asked[i].seed, &s);
        cage_scene view = scene_view(&s);
        const cage_limits limits = {asked[i].side, -1, 7, 128};
        const question q = {&view, &s.start, scene_goal(&s), &limits};
        cage_result right, r;
        int32_t held, built, served = 0, tried = 0, rounds = test_rounds(160);
        rounds = rounds < 24 ? 24 : rounds; /* over 7 KiB, of which the first is too little */
        ck_assert_int_eq(run(&q, memory, PLENTY, &right, &held, &built), CAGE_OK);
        size_t too_little, enough = least_block(&q, memory, &right, &too_little);
        for (size_t bytes = too_little - 1024; tried < rounds; bytes += 7168 / (size_t)rounds - 8 + bytes % 16, tried++) {
            int32_t error = run(&q, memory, bytes, &r, &held, &built);
            ck_assert(error == CAGE_OK || (error == CAGE_ERROR_MEMORY && served == 0));
            served += error == CAGE_OK;
        }
        ck_assert(enough > too_little && served > 0 && served < tried);
    }
    free(memory);
}
END_TEST

/* ---- the ring alone ------------------------------------------------------------------------------------ */

/* A slice of `size` balls in a row, made in the arena. */
static void make_slice(struct cage_arena *arena, int32_t size, struct cage_slice *out)
{
    static const cage_ball point = {0, 0, 0, 10};
    static const int32_t reach = 0;
    static const struct cage_rotations rotations = {{1, 0, 0, 0}, 0};
    cage_ball row[64];
    for (int32_t i = 0; i < size; i++) {
        const cage_ball at = {1000 * i, size, 0, 100};
        row[i] = at;
    }
    const struct cage_side side = {&point, &reach, row, 1, size, 2, -1, &cage_all_shortcuts, {NULL, NULL, NULL, NULL}};
    ck_assert_int_eq(cage_slice_make(arena, &side, &rotations, out), CAGE_OK);
}

static void check_same(const struct cage_slice *held, const struct cage_slice *made)
{
    test_require(held->t.sites == made->t.sites && held->t.simplices == made->t.simplices && held->t.dim == made->t.dim);
    test_require(held->parts == made->parts && held->regions == made->regions && held->balls == made->balls);
    test_require(memcmp(held->t.site, made->t.site, (size_t)made->t.sites * sizeof *made->t.site) == 0);
    test_require(memcmp(held->t.ball, made->t.ball, (size_t)made->t.sites * sizeof *made->t.ball) == 0);
    test_require(memcmp(held->t.simplex, made->t.simplex, (size_t)made->t.simplices * sizeof *made->t.simplex) == 0);
    test_require(memcmp(held->label, made->label, (size_t)made->t.simplices * sizeof *made->label) == 0);
    test_require(memcmp(held->part, made->part, (size_t)made->parts * sizeof *made->part) == 0);
    for (int32_t k = 0; k < made->regions; k++) {
        const struct cage_region *a = &held->region[k], *b = &made->region[k];
        test_require(a->deep == b->deep && a->known == b->known);
        test_require(!a->known || memcmp(a->point, b->point, sizeof a->point) == 0);
    }
}

/* Slices of many sizes go in; the newest is always whole, the oldest go first, and owners know what they have lost. */
START_TEST(drops_the_oldest)
{
    enum { WORK = 1 << 20 };
    uint64_t state = 21;
    unsigned char *work = test_alloc(WORK), *block = test_alloc(WORK);
    int32_t kept = 0;
    for (int32_t round = 0; round < test_rounds(40); round++) {
        struct cage_store store;
        struct cage_held *owner[OWNERS] = {NULL};
        int32_t size[OWNERS] = {0}, age[OWNERS] = {0}; /* age 0: never held */
        size_t bytes = (size_t)test_between(&state, 0, 4000) * CAGE_ALIGN;
        unsigned char *ring = test_alloc(bytes); /* of its own, so that nothing is written beyond it unseen */
        cage_store_init(&store, ring, bytes);
        for (int32_t i = 1; i <= 60; i++) {
            struct cage_arena arena;
            struct cage_slice slice;
            int32_t at = (int32_t)test_between(&state, 0, OWNERS - 1), balls = (int32_t)test_between(&state, 0, 60);
            if (owner[at])
                continue;
            cage_arena_init(&arena, work, WORK);
            make_slice(&arena, balls, &slice);
            bool fits = cage_store_bytes(&slice) <= bytes;
            test_require(cage_store_put(&store, &slice, &owner[at]) == fits && (owner[at] != NULL) == fits);
            size[at] = fits ? balls : size[at];
            age[at] = fits ? i : age[at];
            int32_t oldest_held = i, newest_lost = 0;
            for (int32_t k = 0; k < OWNERS; k++) {
                if (owner[k] && age[k] < oldest_held)
                    oldest_held = age[k];
                if (!owner[k] && age[k] > newest_lost)
                    newest_lost = age[k];
                if (!owner[k])
                    continue;
                struct cage_arena other;
                struct cage_slice again;
                cage_arena_init(&other, block, WORK);
                make_slice(&other, size[k], &again);
                check_same(&owner[k]->slice, &again);
                kept += k != at;
            }
            test_require(!fits || newest_lost <= oldest_held);
        }
        free(ring);
    }
    ck_assert_int_gt(kept, 0);
    free(work);
    free(block);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("store");
    TCase *tests = test_case(suite, "store");
    tcase_add_test(tests, drops_the_oldest);
    tcase_add_test(tests, dropped_slices_change_nothing);
    tcase_add_test(tests, larger_blocks_serve);
    return test_main(suite);
}
