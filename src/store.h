/* store: slices held in a ring of memory, the oldest dropped for the newest. */
#ifndef CAGE_STORE_H
#define CAGE_STORE_H

#include "slice.h"

/* A slice in the store. *owner points to it while it is held, and is null after it was dropped. */
struct cage_held {
    struct cage_slice slice;
    struct cage_held *next; /* the one that was stored after this */
    struct cage_held **owner;
    size_t bytes; /* of the whole block */
};

struct cage_store {
    unsigned char *base;
    size_t size;
    size_t head; /* where the next slice goes */
    struct cage_held *oldest, *newest;
};

/* Use `bytes` bytes at base, aligned to CAGE_ALIGN. */
void cage_store_init(struct cage_store *store, void *base, size_t bytes);

/* Copy a slice into the store; false if it is larger than all of it. */
bool cage_store_put(struct cage_store *store, const struct cage_slice *slice, struct cage_held **owner);

/* Drop all slices. */
void cage_store_clear(struct cage_store *store);

/* Bytes of a store that can hold the slice. */
size_t cage_store_bytes(const struct cage_slice *slice);

#endif
