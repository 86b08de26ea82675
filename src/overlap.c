/* overlap: boxes around all that a component of one slice may share with a component of its neighbour.
 *
 * Of L only those pieces matter (piece.h) that meet the bounds of K. */
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

/* One more, of an array that is the last thing in the arena since it was marked: in the same place. Null: no room. */
static void *one_more(struct cage_arena *arena, size_t mark, int32_t count, size_t size)
{
    cage_arena_release(arena, mark);
    return cage_arena_take(arena, (size_t)count + 1, size);
}

/* If the piece of L in the ball's simplex may meet K, it is added. */
static int32_t add_piece(struct cage_arena *arena, size_t mark, struct cage_overlap *o, const struct cage_orthoball *ball)
{
    const struct cage_slice *d = o->d;
    const struct cage_bounds *bounds = &o->c->region[o->k].bounds;
    struct cage_piece made;
    cage_piece_make(&d->t, ball, &made);
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

/* Does the ball, if it was found, not meet what is within the bounds? */
static bool is_away(int32_t dim, const struct cage_bounds *bounds, const struct cage_orthoball *ball)
{
    static const int8_t along[3] = {CAGE_ALONG_X, CAGE_ALONG_Y, CAGE_ALONG_Z};
    bool away = false;
    for (int32_t k = 0; k < dim && ball->radius >= 0; k++)
        away = away || ball->at[k] - ball->radius >= bounds->high[along[k]] || ball->at[k] + ball->radius <= bounds->low[along[k]];
    return away;
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

/* Of d's simplices one in so many is searched for, one after the other; where more meet K's bounds, all are looked at instead. */
enum { SEARCHED = 128 };

/* The simplices of d that K's bounds meet, at *out: they hang together by facets, and one of them holds a point of K, which was
 * rounded by 1/2 on each axis. Returns how many; 0: there may be many; or an error. */
static int32_t find_around(struct cage_arena *arena, const struct cage_overlap *o, uint32_t *code, int32_t **out)
{
    const struct cage_triangulation *t = &o->d->t;
    const struct cage_region *region = &o->c->region[o->k];
    struct cage_bounds around = region->bounds;
    uint8_t *seen = cage_arena_take(arena, (size_t)t->simplices, sizeof *seen);
    int32_t *queue = cage_arena_take(arena, (size_t)t->simplices, sizeof *queue), length = 0;
    if (!seen || !queue)
        return CAGE_ERROR_MEMORY;
    memset(seen, AWAY, (size_t)t->simplices);
    cage_bounds_widen(t->dim, &around, 2); /* along x + y + z: 3/2 */
    queue[length++] = cage_delaunay_locate(t, o->c->orthoball[region->first].at, 0);
    seen[queue[0]] = VISITED;
    for (int32_t n = 0; n < length; n++)
        for (int32_t i = 0; i <= t->dim; i++) {
            int32_t twin = t->simplex[queue[n]].twin[i], next = twin >> 2;
            if (twin == CAGE_HULL || seen[next] == VISITED)
                continue;
            seen[next] = VISITED;
            if (is_out(t, next, &around, code))
                continue;
            if (length > t->simplices / SEARCHED)
                return 0;
            queue[length++] = next;
        }
    *out = queue;
    return length;
}

/* If the piece of the outside in simplex s may meet K, it is added. */
static int32_t add_outer(struct cage_arena *arena, size_t mark, struct cage_overlap *o, int32_t s)
{
    struct cage_orthoball ball;
    if (o->d->label[s] != CAGE_OUTSIDE)
        return CAGE_OK;
    cage_orthoball_of(&o->d->t, s, &ball);
    return add_piece(arena, mark, o, &ball);
}

static int32_t find_outer_pieces(struct cage_arena *arena, struct cage_overlap *o, uint32_t *code)
{
    const struct cage_triangulation *t = &o->d->t;
    int32_t *list = NULL, count = find_around(arena, o, code, &list), error = count < 0 ? count : CAGE_OK;
    size_t mark = arena->used;
    for (int32_t n = 0; n < count && error == CAGE_OK; n++)
        error = add_outer(arena, mark, o, list[n]);
    if (count != 0)
        return error;
    for (int32_t i = 0; i < t->sites; i++)
        code[i] = cage_bounds_code(t->dim, &o->c->region[o->k].bounds, &t->site[i]);
    for (int32_t s = 0; s < t->simplices && error == CAGE_OK; s++) {
        const int32_t *v = t->simplex[s].v;
        uint32_t common = code[v[0]] & code[v[1]] & code[v[2]] & (t->dim == 3 ? code[v[3]] : UINT32_MAX);
        if (common == CAGE_CODE_KNOWN)
            error = add_outer(arena, mark, o, s);
    }
    return error;
}

int32_t cage_overlap_pieces(struct cage_arena *arena, struct cage_overlap *o)
{
    const struct cage_slice *d = o->d;
    const struct cage_region *from = &o->c->region[o->k], *to = &d->region[o->l];
    uint32_t *code = no_codes(arena, &d->t);
    int32_t error = code ? CAGE_OK : CAGE_ERROR_MEMORY;
    cage_bounds_none(&o->bounds);
    if (error == CAGE_OK && o->l == CAGE_OUTSIDE)
        return find_outer_pieces(arena, o, code);
    size_t mark = arena->used;
    for (int32_t i = to->first; i < to->first + to->size && error == CAGE_OK; i++)
        if (!is_away(d->t.dim, &from->bounds, &d->orthoball[i]) &&
            !is_out(&d->t, d->orthoball[i].simplex, &from->bounds, code))
            error = add_piece(arena, mark, o, &d->orthoball[i]);
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
    const struct cage_region *of = &c->region[o->k];
    uint32_t *code = no_codes(arena, &c->t);
    if (!code)
        return CAGE_ERROR_MEMORY;
    o->box = cage_arena_take(arena, CAGE_OVERLAP_BOXES, sizeof *o->box);
    if (!o->box)
        return CAGE_ERROR_MEMORY;
    for (int32_t i = of->first; i < of->first + of->size; i++) {
        struct cage_piece own;
        struct cage_box box;
        if (is_away(c->t.dim, &o->bounds, &c->orthoball[i]) || is_out(&c->t, c->orthoball[i].simplex, &o->bounds, code))
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
