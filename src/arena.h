/* arena: bump allocation from one block that the caller owns: take, mark, release, peak. */
#ifndef CAGE_ARENA_H
#define CAGE_ARENA_H

#include <stddef.h>
#include <stdint.h>

/* A mark is the value of used; releasing to a mark frees everything taken since. */
struct cage_arena {
    unsigned char *base; /* aligned to CAGE_ALIGN */
    size_t size;
    size_t used;
    size_t peak;   /* largest value of used so far */
    size_t needed; /* a size at which the last failed take would have succeeded */
};

#define CAGE_ALIGN 8u

/* Any block will do; up to CAGE_ALIGN - 1 bytes at either end are lost to alignment. */
void cage_arena_init(struct cage_arena *arena, void *block, size_t bytes);

/* count objects of the given size > 0, not initialised; null when they do not fit (see needed). */
void *cage_arena_take(struct cage_arena *arena, size_t count, size_t size);

/* How many objects of the given size still fit. */
size_t cage_arena_room(const struct cage_arena *arena, size_t size);

/* Give back everything taken since used was `mark`. */
void cage_arena_release(struct cage_arena *arena, size_t mark);

#endif
