/* overlap: boxes around all that a component of one slice may share with a component of its neighbour.
 *
 * Of L only those pieces matter (piece.h) that meet the bounds of K. The simplices of d which these bounds meet hang together by
 * facets, and one of them holds a point of K: the search for them is local. */
#include "overlap.h"

#include <string.h>

/* So many pairs of pieces are compared, for each ball of both slices; then a box is made of what all of L's bound. */
enum { COMPARED = 64 };

/* The direction in which the piece reaches least into the bounds. */
static int32_t best_direction(int32_t dim, const struct cage_bounds *bounds, const struct cage_bounds *piece)
{
    int32_t best = 0;
    int64_t least = INT64_MAX; /* differences of at most 2^31 */
    for (int32_t i = 0; i < (dim == 2 ? CAGE_DIRECTIONS_2D : CAGE_DIRECTIONS); i++) {
        int64_t above = (int64_t)bounds->high[i] - piece->low[i], below = (int64_t)piece->high[i] - bounds->low[i];
        int64_t depth = above < below ? above : below;
        best = depth < least ? i : best;
        least = depth < least ? depth : least;
    }
    return best;
}

static const struct cage_orthoball *find_orthoball(const struct cage_slice *slice, int32_t s)
{
    int32_t low = 0, high = slice->orthoballs - 1; /* it is there: they are in order */
    while (low < high) {
        int32_t middle = low + (high - low) / 2;
        if (slice->orthoball[middle].simplex < s)
            low = middle + 1;
        else
            high = middle;
    }
    return &slice->orthoball[low];
}

/* One more, of an array that is the last thing in the arena since it was marked: in the same place. Null: no room. */
static void *one_more(struct cage_arena *arena, size_t mark, int32_t count, size_t size)
{
    cage_arena_release(arena, mark);
    return cage_arena_take(arena, (size_t)count + 1, size);
}

/* If the piece of L in simplex s may meet K, it is added. */
static int32_t add_piece(struct cage_arena *arena, size_t mark, struct cage_overlap *o, int32_t s)
{
    const struct cage_slice *d = o->d;
    const struct cage_bounds *bounds = &o->c->region[o->k].bounds;
    struct cage_orthoball ball;
    struct cage_piece made;
    if (o->l == CAGE_OUTSIDE)
        cage_orthoball_of(&d->t, s, &ball);
    cage_piece_make(&d->t, o->l == CAGE_OUTSIDE ? &ball : find_orthoball(d, s), &made);
    if (!cage_bounds_meet(d->t.dim, bounds, &made.bounds))
        return CAGE_OK;
    struct cage_piece *piece = one_more(arena, mark, o->pieces, sizeof *piece);
    if (!piece)
        return CAGE_ERROR_MEMORY;
    made.first = best_direction(d->t.dim, bounds, &made.bounds);
    piece[o->pieces++] = made;
    o->piece = piece;
    cage_bounds_add(d->t.dim, &o->bounds, &made.bounds);
    return CAGE_OK;
}

/* Does the simplex, by its vertices alone, not meet what is within the bounds? code: of each site, or 0. */
static bool is_out(const struct cage_triangulation *t, int32_t s, const struct cage_bounds *bounds, uint32_t *code)
{
    uint32_t common = ~CAGE_CODE_KNOWN;
    for (int32_t i = 0; i <= t->dim; i++) {
        int32_t v = t->simplex[s].v[i];
        if (!code[v])
            code[v] = cage_bounds_code(t->dim, bounds, &t->site[v]);
        common &= code[v];
    }
    return common != 0;
}

static uint32_t *no_codes(struct cage_arena *arena, const struct cage_triangulation *t)
{
    uint32_t *code = cage_arena_take(arena, (size_t)t->sites, sizeof *code);
    if (code)
        memset(code, 0, (size_t)t->sites * sizeof *code);
    return code;
}

enum { AWAY = 0, VISITED = 1 };

/* The pieces of L that may meet K. The simplices of d that K's bounds meet hang together by facets; one holds a point of K, which
 * was rounded by less than 1.5. */
int32_t cage_overlap_pieces(struct cage_arena *arena, struct cage_overlap *o)
{
    const struct cage_triangulation *t = &o->d->t;
    const struct cage_region *region = &o->c->region[o->k];
    struct cage_bounds around = region->bounds;
    uint8_t *seen = cage_arena_take(arena, (size_t)t->simplices, sizeof *seen);
    int32_t *queue = cage_arena_take(arena, (size_t)t->simplices, sizeof *queue), length = 0, error = CAGE_OK;
    uint32_t *code = no_codes(arena, t);
    if (!seen || !queue || !code)
        return CAGE_ERROR_MEMORY;
    memset(seen, AWAY, (size_t)t->simplices);
    cage_bounds_none(&o->bounds);
    cage_bounds_widen(t->dim, &around, 4); /* along x + y + z: 1.5 root(3) */
    queue[length++] = cage_delaunay_locate(t, find_orthoball(o->c, region->deep)->at, 0);
    seen[queue[0]] = VISITED;
    size_t mark = arena->used;
    for (int32_t n = 0; n < length && error == CAGE_OK; n++) {
        int32_t s = queue[n];
        if (o->d->label[s] == o->l)
            error = add_piece(arena, mark, o, s);
        for (int32_t i = 0; i <= t->dim; i++) {
            int32_t twin = t->simplex[s].twin[i], next = twin >> 2;
            if (twin == CAGE_HULL || seen[next] == VISITED)
                continue;
            seen[next] = VISITED;
            if (!is_out(t, next, &around, code))
                queue[length++] = next;
        }
    }
    return error;
}

static void widen_box(struct cage_box *box, const struct cage_box *other)
{
    for (int32_t n = 0; n < 3; n++) {
        box->low[n] = other->low[n] < box->low[n] ? other->low[n] : box->low[n];
        box->high[n] = other->high[n] > box->high[n] ? other->high[n] : box->high[n];
    }
}

/* The box around all that a piece of K shares with those of L; false: nothing. */
static bool find_box(struct cage_overlap *o, struct cage_piece *own, struct cage_box *box)
{
    int32_t dim = o->c->t.dim;
    bool found = false;
    if (o->compared > COMPARED * (int64_t)(o->c->t.sites + o->d->t.sites)) {
        cage_box_common(dim, &own->bounds, &o->bounds, box);
        return true;
    }
    o->compared += o->pieces;
    for (int32_t i = 0; i < o->pieces; i++) {
        struct cage_piece *other = &o->piece[i];
        struct cage_box common;
        int32_t n = other->first; /* most end here */
        if (own->bounds.high[n] <= other->bounds.low[n] || own->bounds.low[n] >= other->bounds.high[n] ||
            !cage_bounds_meet(dim, &own->bounds, &other->bounds) ||
            (o->met < CAGE_OVERLAP_MANY && cage_piece_is_apart(own, other)))
            continue;
        cage_box_common(dim, &own->bounds, &other->bounds, &common);
        if (!found)
            *box = common;
        widen_box(box, &common);
        found = true;
        o->met += o->met <= CAGE_OVERLAP_MANY;
    }
    return found;
}

int32_t cage_overlap_boxes(struct cage_arena *arena, struct cage_overlap *o)
{
    const struct cage_slice *c = o->c;
    uint32_t *code = no_codes(arena, &c->t);
    if (!code)
        return CAGE_ERROR_MEMORY;
    o->box = cage_arena_take(arena, CAGE_OVERLAP_BOXES, sizeof *o->box);
    if (!o->box)
        return CAGE_ERROR_MEMORY;
    for (int32_t i = 0; i < c->orthoballs; i++) {
        struct cage_piece own;
        struct cage_box box;
        int32_t s = c->orthoball[i].simplex;
        if (c->label[s] != o->k || is_out(&c->t, s, &o->bounds, code))
            continue;
        cage_piece_make(&c->t, &c->orthoball[i], &own);
        if (!cage_bounds_meet(c->t.dim, &o->bounds, &own.bounds) || !find_box(o, &own, &box))
            continue;
        if (o->boxes < CAGE_OVERLAP_BOXES)
            o->box[o->boxes++] = box;
        else
            widen_box(&o->box[CAGE_OVERLAP_BOXES - 1], &box);
    }
    return CAGE_OK;
}
