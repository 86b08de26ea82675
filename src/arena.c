/* arena: bump allocation from one block that the caller owns: take, mark, release, peak. */
#include "arena.h"

void cage_arena_init(struct cage_arena *arena, void *block, size_t bytes)
{
    size_t lost = (CAGE_ALIGN - (uintptr_t)block % CAGE_ALIGN) % CAGE_ALIGN;
    if (lost > bytes)
        lost = bytes;
    arena->base = (unsigned char *)block + lost;
    arena->size = (bytes - lost) / CAGE_ALIGN * CAGE_ALIGN;
    arena->used = 0;
    arena->peak = 0;
    arena->needed = 0;
}

size_t cage_arena_room(const struct cage_arena *arena, size_t size)
{
    return (arena->size - arena->used) / size;
}

void *cage_arena_take(struct cage_arena *arena, size_t count, size_t size)
{
    /* Saturate: a request that overflows size_t can never be met. */
    size_t bytes = count > (SIZE_MAX - 2 * CAGE_ALIGN) / size ? SIZE_MAX - 2 * CAGE_ALIGN : count * size;
    bytes = (bytes + CAGE_ALIGN - 1) / CAGE_ALIGN * CAGE_ALIGN;
    if (bytes > arena->size - arena->used) {
        arena->needed = bytes > SIZE_MAX - arena->used - CAGE_ALIGN ? SIZE_MAX : arena->used + bytes + CAGE_ALIGN;
        return NULL;
    }
    void *taken = arena->base + arena->used;
    arena->used += bytes;
    if (arena->peak < arena->used)
        arena->peak = arena->used;
    return taken;
}

void cage_arena_release(struct cage_arena *arena, size_t mark)
{
    arena->used = mark;
}
