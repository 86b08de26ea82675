/* test_arena.c: the arena aligns, fits exactly, refuses what does not fit, and says truly what was needed. */
#include "support.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "arena.h"

static bool aligned(const void *p) { return (uintptr_t)p % CAGE_ALIGN == 0; }

/* Every byte handed out must be inside the block: write it all. */
static void fill(void *p, size_t bytes) { memset(p, 0x5a, bytes); }

START_TEST(aligns_at_every_offset)
{
    static const size_t counts[] = {1, 3, 7, 8, 9, 16, 17};
    unsigned char block[256];
    for (size_t offset = 0; offset <= 16; offset++) {
        struct cage_arena arena;
        cage_arena_init(&arena, block + offset, sizeof block - offset);
        ck_assert(arena.size >= sizeof block - offset - (CAGE_ALIGN - 1));
        ck_assert_uint_eq(arena.used, 0);
        ck_assert_uint_eq(arena.peak, 0);
        unsigned char *last = block + offset;
        for (size_t i = 0; i < sizeof counts / sizeof counts[0]; i++) {
            unsigned char *taken = cage_arena_take(&arena, counts[i], 1);
            ck_assert_ptr_nonnull(taken);
            ck_assert(aligned(taken));
            ck_assert(taken >= last && taken + counts[i] <= block + sizeof block);
            fill(taken, counts[i]);
            last = taken + counts[i];
        }
        ck_assert_uint_eq(arena.peak, arena.used);
    }
}
END_TEST

/* Blocks of their own size, so that a memory checker sees any byte too many. */
START_TEST(never_leaves_the_block)
{
    for (size_t bytes = 0; bytes <= 64; bytes++)
        for (size_t offset = 0; offset <= 16 && offset <= bytes; offset++)
            for (size_t size = 1; size <= 24; size++) {
                unsigned char *block = test_alloc(bytes);
                struct cage_arena arena;
                cage_arena_init(&arena, block + offset, bytes - offset);
                size_t total = 0;
                unsigned char *taken;
                while ((taken = cage_arena_take(&arena, 1, size)) != NULL) {
                    test_require(aligned(taken));
                    test_require(taken >= block + offset && taken + size <= block + bytes);
                    fill(taken, size);
                    total += size;
                }
                test_require(total <= bytes - offset);
                free(block);
            }
}
END_TEST

START_TEST(fits_exactly)
{
    uint64_t block[9];
    struct cage_arena arena;
    for (size_t words = 0; words <= 8; words++) {
        cage_arena_init(&arena, block, words * 8);
        ck_assert_ptr_null(cage_arena_take(&arena, words + 1, 8));
        ck_assert_ptr_null(cage_arena_take(&arena, words * 8 + 1, 1));
        ck_assert_uint_eq(arena.used, 0);
        ck_assert_ptr_nonnull(cage_arena_take(&arena, words, 8));
        ck_assert_uint_eq(arena.used, words * 8);
        ck_assert_ptr_null(cage_arena_take(&arena, 1, 1));
        ck_assert_ptr_nonnull(cage_arena_take(&arena, 0, 8));
        ck_assert_uint_eq(arena.used, words * 8);
    }
}
END_TEST

START_TEST(refuses_overflow)
{
    static const size_t huge[] = {SIZE_MAX, SIZE_MAX - 1, SIZE_MAX - 7, SIZE_MAX - 8, SIZE_MAX - 15, SIZE_MAX - 16,
                                  SIZE_MAX / 2, SIZE_MAX / 2 + 1, SIZE_MAX / 8, SIZE_MAX / 8 + 1, SIZE_MAX / 24 + 1};
    static const size_t sizes[] = {1, 2, 3, 4, 8, 12, 24, 32, SIZE_MAX / 2, SIZE_MAX};
    uint64_t block[8];
    for (size_t i = 0; i < sizeof huge / sizeof huge[0]; i++)
        for (size_t k = 0; k < sizeof sizes / sizeof sizes[0]; k++)
            for (size_t before = 0; before < 3; before++) {
                struct cage_arena arena;
                cage_arena_init(&arena, block, sizeof block);
                test_require(cage_arena_take(&arena, before, 8) != NULL);
                test_require(cage_arena_take(&arena, huge[i], sizes[k]) == NULL);
                test_require(cage_arena_take(&arena, sizes[k], huge[i]) == NULL);
                test_require(arena.used == before * 8);
                /* No wrapped, small number may be named as enough. */
                test_require(arena.needed >= SIZE_MAX / 24);
                test_require(cage_arena_take(&arena, 8 - before, 8) != NULL);
            }
}
END_TEST

/* Take until it fails; a block of the size that was named, at any offset, must get past that take. */
START_TEST(needed_is_truthful)
{
    uint64_t state = 1;
    for (int32_t round = test_rounds(20000); round > 0; round--) {
        size_t count[6], size[6], bytes = (size_t)test_between(&state, 0, 200);
        for (int i = 0; i < 6; i++) {
            count[i] = (size_t)test_between(&state, 0, 20);
            size[i] = (size_t)test_between(&state, 1, 20);
        }
        unsigned char first[256], *block = first + test_between(&state, 0, 16);
        struct cage_arena arena;
        cage_arena_init(&arena, block, bytes);
        int failed = 0;
        while (failed < 6 && cage_arena_take(&arena, count[failed], size[failed]))
            failed++;
        if (failed == 6)
            continue;
        ck_assert(arena.needed > bytes);
        for (size_t offset = 0; offset < CAGE_ALIGN; offset++) {
            unsigned char *second = test_alloc(arena.needed + offset);
            struct cage_arena larger;
            cage_arena_init(&larger, second + offset, arena.needed);
            for (int i = 0; i <= failed; i++) {
                void *taken = cage_arena_take(&larger, count[i], size[i]);
                test_require(taken != NULL);
                fill(taken, count[i] * size[i]);
            }
            free(second);
        }
    }
}
END_TEST

/* room objects can be taken in one go, one more cannot. */
START_TEST(room_is_truthful)
{
    unsigned char block[160];
    for (size_t offset = 0; offset < 8; offset++)
        for (size_t bytes = 0; bytes <= 128; bytes++)
            for (size_t size = 1; size <= 48; size++)
                for (size_t before = 0; before <= 16; before += 5) {
                    struct cage_arena arena;
                    cage_arena_init(&arena, block + offset, bytes);
                    (void)cage_arena_take(&arena, before, 1);
                    size_t mark = arena.used, room = cage_arena_room(&arena, size);
                    test_require(cage_arena_take(&arena, room, size) != NULL);
                    cage_arena_release(&arena, mark);
                    test_require(cage_arena_take(&arena, room + 1, size) == NULL);
                }
}
END_TEST

START_TEST(releases_to_a_mark_and_remembers_the_peak)
{
    uint64_t block[16];
    struct cage_arena arena;
    cage_arena_init(&arena, block, sizeof block);
    uint64_t *kept = cage_arena_take(&arena, 2, 8);
    ck_assert_ptr_nonnull(kept);
    kept[0] = 7;
    kept[1] = 9;
    size_t mark = arena.used;
    void *scratch = cage_arena_take(&arena, 10, 8);
    ck_assert_ptr_nonnull(scratch);
    fill(scratch, 80);
    ck_assert_uint_eq(arena.peak, 96);
    cage_arena_release(&arena, mark);
    ck_assert_uint_eq(arena.used, mark);
    ck_assert_uint_eq(arena.peak, 96);
    ck_assert_ptr_eq(cage_arena_take(&arena, 1, 8), scratch);
    ck_assert_uint_eq(arena.peak, 96);
    ck_assert_ptr_null(cage_arena_take(&arena, 14, 8));
    ck_assert_uint_eq(arena.peak, 96);
    ck_assert(kept[0] == 7 && kept[1] == 9);
    cage_arena_release(&arena, 0);
    ck_assert_ptr_eq(cage_arena_take(&arena, 16, 8), kept);
    ck_assert_uint_eq(arena.peak, 128);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("arena");
    TCase *tests = test_case(suite, "arena");
    tcase_add_test(tests, aligns_at_every_offset);
    tcase_add_test(tests, never_leaves_the_block);
    tcase_add_test(tests, fits_exactly);
    tcase_add_test(tests, refuses_overflow);
    tcase_add_test(tests, needed_is_truthful);
    tcase_add_test(tests, room_is_truthful);
    tcase_add_test(tests, releases_to_a_mark_and_remembers_the_peak);
    return test_main(suite);
}
