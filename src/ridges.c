/* ridges: new simplices in space find their neighbours by a table. */
#include "ridges.h"

#include <string.h>

/* Sites around a hole that the table of ridges has room for: about 15 are usual. */
enum { RIDGE_SITES = 64 };

/* The ridges of a front by their ends: entry (u, v) is the facet through p and the edge from u to v. */
struct cage_ridges {
    int32_t *number; /* of a site among those listed, if its entry there says so as well */
    int32_t listed[RIDGE_SITES];
    int32_t facet[RIDGE_SITES * RIDGE_SITES];
};

/* The number of site v among those on the front, without a branch (Briggs, Torczon, "An efficient representation for
 * sparse sets", 1993). */
static CAGE_INLINE int32_t number_of(struct cage_build *b, int32_t v, int32_t *count)
{
    int32_t n = b->ridges->number[v], unknown = (n >= *count) | (b->ridges->listed[n] != v);
    n += (*count - n) * unknown;
    *count += unknown;
    b->ridges->number[v] = n;
    b->ridges->listed[n] = v;
    return n;
}

bool cage_ridges_link(struct cage_build *b, int32_t fronts)
{
    struct cage_simplex *simplex = b->simplex;
    int32_t count = 0;
    for (int32_t n = 0; n < fronts; n++) {
        int32_t h = b->front[n] >> 2, i = b->front[n] & 3, fresh = cage_front_code(simplex[h].twin[i]);
        const int32_t *face = CAGE_FACE_3D[i];
        struct cage_simplex *s = &simplex[fresh];
        if (count > RIDGE_SITES - 4)
            return false;
        int32_t x = number_of(b, s->v[face[0]], &count), y = number_of(b, s->v[face[1]], &count);
        int32_t z = number_of(b, s->v[face[2]], &count);
        b->ridges->facet[RIDGE_SITES * y + z] = 4 * fresh + face[0];
        b->ridges->facet[RIDGE_SITES * z + x] = 4 * fresh + face[1];
        b->ridges->facet[RIDGE_SITES * x + y] = 4 * fresh + face[2];
        s->twin[face[0]] = RIDGE_SITES * z + y; /* where its twin will be found */
        s->twin[face[1]] = RIDGE_SITES * x + z;
        s->twin[face[2]] = RIDGE_SITES * y + x;
    }
    for (int32_t n = 0; n < fronts; n++) {
        int32_t h = b->front[n] >> 2, i = b->front[n] & 3, fresh = cage_front_code(simplex[h].twin[i]);
        for (int32_t k = 0; k < 3; k++) {
            int32_t *twin = &simplex[fresh].twin[CAGE_FACE_3D[i][k]];
            *twin = b->ridges->facet[*twin];
        }
        b->last = fresh;
    }
    return true;
}

size_t cage_ridges_size(int32_t sites)
{
    return (size_t)sites * sizeof(int32_t) + sizeof(struct cage_ridges) + 2 * CAGE_ALIGN;
}

bool cage_ridges_make(struct cage_arena *arena, struct cage_build *b, int32_t sites)
{
    int32_t *number = cage_arena_take(arena, (size_t)sites, sizeof *number);
    b->ridges = cage_arena_take(arena, 1, sizeof *b->ridges);
    if (!number || !b->ridges)
        return false;
    memset(number, 0, (size_t)sites * sizeof *number);
    memset(b->ridges->listed, 0, sizeof b->ridges->listed);
    b->ridges->number = number;
    return true;
}
