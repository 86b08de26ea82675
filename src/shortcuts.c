/* shortcuts: what makes a proof faster and no answer different, in one table: an image that does not name it goes without. */
#include "shortcuts.h"
#include "barrier.h"
#include "prune.h"
#include "ridges.h"

const struct cage_shortcuts cage_all_shortcuts = {
    cage_ridges_size, cage_ridges_make, cage_ridges_link, cage_prune, cage_drop_phantoms, cage_barrier_make, cage_barrier_is_apart,
};
