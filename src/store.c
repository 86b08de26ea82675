/* store: slices held in a ring of memory, the oldest dropped for the newest. */
#include "store.h"

void cage_store_init(struct cage_store *store, void *base, size_t bytes)
{
    store->base = base;
    store->size = bytes;
    store->head = 0;
    store->oldest = store->newest = NULL;
}

size_t cage_store_bytes(const struct cage_slice *slice)
{
    return (sizeof(struct cage_held) + CAGE_ALIGN - 1) / CAGE_ALIGN * CAGE_ALIGN + slice->bytes;
}

static void drop_oldest(struct cage_store *store)
{
    *store->oldest->owner = NULL;
    store->oldest = store->oldest->next;
    if (!store->oldest)
        store->newest = NULL;
}

void cage_store_clear(struct cage_store *store)
{
    while (store->oldest)
        drop_oldest(store);
    store->head = 0;
}

/* Blocks lie in the order of their age, around the ring. */
static void make_room(struct cage_store *store, size_t from, size_t to)
{
    while (store->oldest) {
        size_t at = (size_t)((unsigned char *)store->oldest - store->base);
        if (at >= to || at + store->oldest->bytes <= from)
            return;
        drop_oldest(store);
    }
}

bool cage_store_put(struct cage_store *store, const struct cage_slice *slice, struct cage_held **owner)
{
    size_t bytes = cage_store_bytes(slice);
    if (bytes > store->size)
        return false;
    if (bytes > store->size - store->head) {
        make_room(store, store->head, store->size);
        store->head = 0;
    }
    make_room(store, store->head, store->head + bytes);
    struct cage_held *held = (struct cage_held *)(void *)(store->base + store->head);
    cage_slice_pack(slice, (unsigned char *)held + (bytes - slice->bytes), &held->slice);
    held->next = NULL;
    held->owner = owner;
    held->bytes = bytes;
    if (store->newest)
        store->newest->next = held;
    else
        store->oldest = held;
    store->newest = held;
    store->head += bytes;
    *owner = held;
    return true;
}
