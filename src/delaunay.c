/* delaunay: the weighted Delaunay (regular) triangulation of balls, in the plane or in space.
 *
 * Incremental insertion: locate the new site, carve the simplices in conflict with it, stitch new ones between it
 * and the boundary of the hole (Bowyer, Watson 1981; for weights Edelsbrunner, Shah 1996). The tie rule makes the
 * triangulation that of generic heights, so the hole is star-shaped, no new simplex is flat, and a site
 * swallowed by the hole is hidden. Functions that take dim are compiled once for each value. */
#include "build.h"
#include "order.h"

#include <string.h>

enum { UNLINKED = INT32_MIN };

enum { BYTES_PER_SIMPLEX = sizeof(struct cage_simplex) + 3 * sizeof(int32_t) };

static CAGE_INLINE const int32_t *face_of(int32_t dim, int32_t i)
{
    return dim == 2 ? CAGE_FACE_2D[i] : CAGE_FACE_3D[i];
}

static CAGE_INLINE void face_sites(int32_t dim, const struct cage_site *site, const struct cage_simplex *s, int32_t i,
                                   const struct cage_site *out[3])
{
    const int32_t *face = face_of(dim, i);
    for (int32_t k = 0; k < dim; k++)
        out[k] = &site[s->v[face[k]]];
}

/* Walk toward p through facets that have it on their far side. In a weighted Delaunay triangulation this
 * cannot cycle (Edelsbrunner, "An acyclicity theorem for cell complexes in d dimensions", 1990). */
static CAGE_INLINE int32_t walk(int32_t dim, const struct cage_site *site, const struct cage_simplex *simplex,
                                const struct cage_site *p, int32_t s)
{
    int32_t from = -1;
    for (;;) {
        const struct cage_simplex *here = &simplex[s];
        int32_t i = 0;
        for (; i <= dim; i++) {
            const struct cage_site *face[3];
            if (here->twin[i] == CAGE_HULL || here->twin[i] >> 2 == from)
                continue;
            face_sites(dim, site, here, i, face);
            if (cage_side(dim, face, p) < 0)
                break;
        }
        if (i > dim)
            return s;
        from = s;
        s = here->twin[i] >> 2;
    }
}

static CAGE_INLINE bool in_conflict(int32_t dim, const struct cage_build *b, int32_t s, const struct cage_site *p)
{
    const struct cage_site *v[4];
    for (int32_t i = 0; i <= dim; i++)
        v[i] = &b->site[b->simplex[s].v[i]];
    return cage_conflict(dim, v, p);
}

/* A slot for a new simplex, or -1 when there is none left. */
static int32_t new_slot(struct cage_build *b)
{
    int32_t s = b->dead;
    if (s >= 0) {
        b->dead = b->simplex[s].v[1];
        return s;
    }
    if (b->simplices == b->capacity)
        return -1;
    s = b->simplices++;
    b->mark[s] = 0;
    return s;
}

/* Gather the hole and its front, breadth first from simplex s, which is in conflict; the number of front facets, -1 if there are
 * more than slots, so that they cannot be stitched. */
static CAGE_INLINE int32_t carve(int32_t dim, struct cage_build *b, int32_t p, int32_t s, int32_t *holes)
{
    const struct cage_site *site = &b->site[p];
    const struct cage_simplex *simplex = b->simplex;
    int32_t *mark = b->mark, *hole = b->hole, *front = b->front;
    int32_t count = 1, fronts = 0, capacity = b->capacity;
    hole[0] = s;
    mark[s] = 2 * p + 1;
    for (int32_t n = 0; n < count; n++) {
        int32_t h = hole[n];
        for (int32_t i = 0; i <= dim; i++) {
            int32_t twin = simplex[h].twin[i], other = twin >> 2, seen = twin == CAGE_HULL ? 2 * p : mark[other];
            if (seen >> 1 != p) {
                seen = 2 * p + in_conflict(dim, b, other, site);
                mark[other] = seen;
                hole[count] = other; /* stays if it is in conflict: a branch would be a coin toss; likewise below */
                count += seen & 1;
            }
            if (fronts == capacity) {
                if (seen & 1)
                    continue;
                return -1;
            }
            front[fronts] = 4 * h + i;
            fronts += ~seen & 1;
        }
    }
    *holes = count;
    return fronts;
}

/* Where v stands in s, which has it: without a branch, as nothing could predict it. */
static CAGE_INLINE int32_t index_of(int32_t dim, const struct cage_simplex *s, int32_t v)
{
    int32_t i = (s->v[1] == v) + 2 * (s->v[2] == v);
    return dim == 2 ? i : i + 3 * (s->v[3] == v);
}

/* Link facet j of the new simplex behind front facet i of h: turn about the ridge that lacks v_i and v_j, through
 * the hole, to the next front facet; the new simplex behind that one is the neighbour. */
static CAGE_INLINE void link_ridge(int32_t dim, struct cage_build *b, int32_t fresh, int32_t h, int32_t i, int32_t j)
{
    struct cage_simplex *simplex = b->simplex;
    int32_t s = h, out = j, kept = simplex[h].v[i], twin;
    while ((twin = simplex[s].twin[out]) >= 0) {
        s = twin >> 2;
        out = index_of(dim, &simplex[s], kept);
        kept = simplex[s].v[twin & 3];
    }
    int32_t neighbour = cage_front_code(twin), facet = index_of(dim, &simplex[s], kept);
    simplex[fresh].twin[j] = 4 * neighbour + facet;
    simplex[neighbour].twin[facet] = 4 * fresh + j;
}

/* Link all new simplices by turning about each ridge. */
static CAGE_INLINE void link_by_turning(int32_t dim, struct cage_build *b, int32_t fronts)
{
    struct cage_simplex *simplex = b->simplex;
    for (int32_t n = 0; n < fronts; n++) {
        int32_t h = b->front[n] >> 2, i = b->front[n] & 3, fresh = cage_front_code(simplex[h].twin[i]);
        for (int32_t k = 0; k < dim; k++)
            simplex[fresh].twin[face_of(dim, i)[k]] = UNLINKED;
    }
    for (int32_t n = 0; n < fronts; n++) {
        int32_t h = b->front[n] >> 2, i = b->front[n] & 3, fresh = cage_front_code(simplex[h].twin[i]);
        for (int32_t k = 0; k < dim; k++) {
            int32_t j = face_of(dim, i)[k];
            if (simplex[fresh].twin[j] == UNLINKED)
                link_ridge(dim, b, fresh, h, i, j);
        }
        b->last = fresh;
    }
}

/* Replace the hole by simplices that join its front to site p. A new simplex is its hole simplex with one vertex
 * replaced by p, which keeps it positive. False when the slots run out. */
static CAGE_INLINE bool stitch(int32_t dim, struct cage_build *b, int32_t p, int32_t fronts, int32_t holes)
{
    struct cage_simplex *simplex = b->simplex;
    for (int32_t n = 0; n < fronts; n++) {
        int32_t h = b->front[n] >> 2, i = b->front[n] & 3, fresh = new_slot(b);
        if (fresh < 0)
            return false;
        int32_t twin = simplex[h].twin[i];
        simplex[fresh] = simplex[h];
        simplex[fresh].v[i] = p;
        simplex[fresh].twin[i] = twin;
        if (twin != CAGE_HULL)
            simplex[twin >> 2].twin[twin & 3] = 4 * fresh + i;
        simplex[h].twin[i] = cage_front_code(fresh);
    }
    if (dim == 2 || !b->ridges || !b->shortcuts->ridges_link(b, fronts))
        link_by_turning(dim, b, fronts);
    for (int32_t n = 0; n < holes; n++) {
        int32_t h = b->hole[n];
        simplex[h].v[0] = -1;
        simplex[h].v[1] = b->dead;
        b->dead = h;
    }
    return true;
}

static CAGE_INLINE bool insert_all(int32_t dim, struct cage_build *b, int32_t first, int32_t sites)
{
    for (int32_t p = first; p < sites; p++) {
        int32_t s = walk(dim, b->site, b->simplex, &b->site[p], b->last);
        b->last = s;
        if (!in_conflict(dim, b, s, &b->site[p]))
            continue; /* hidden: where the simplex that contains it is not in conflict, none is */
        int32_t holes, fronts = carve(dim, b, p, s, &holes);
        if (fronts < 0 || !stitch(dim, b, p, fronts, holes))
            return false;
    }
    return true;
}

static bool insert_all_2d(struct cage_build *b, int32_t first, int32_t sites) { return insert_all(2, b, first, sites); }
static bool insert_all_3d(struct cage_build *b, int32_t first, int32_t sites) { return insert_all(3, b, first, sites); }

static struct cage_site make_site(int32_t x, int32_t y, int32_t z, int32_t r, int64_t weight)
{
    struct cage_site site = {(int64_t)x * x + (int64_t)y * y + (int64_t)z * z - weight, x, y, z, r};
    return site;
}

/* The sentinels' simplex holds every point with |coordinates| <= M / 3, strictly. */
static void make_sentinels(int32_t dim, struct cage_site *site)
{
    const int32_t m2 = 1 << 29, m3 = 1 << 24;
    if (dim == 2) {
        site[0] = make_site(-m2, -m2, 0, 0, -1);
        site[1] = make_site(m2, -m2, 0, 0, -1);
        site[2] = make_site(0, m2, 0, 0, -1);
    } else {
        site[0] = make_site(m3, m3, m3, 0, -1);
        site[1] = make_site(m3, -m3, -m3, 0, -1);
        site[2] = make_site(-m3, -m3, m3, 0, -1);
        site[3] = make_site(-m3, m3, -m3, 0, -1);
    }
}

/* Move live simplices into the dead slots before them, so that the slots in use are 0..simplices-1. */
static void compact(int32_t dim, struct cage_build *b)
{
    struct cage_simplex *simplex = b->simplex;
    int32_t end = b->simplices;
    for (int32_t s = 0; s < end; s++) {
        if (simplex[s].v[0] >= 0)
            continue;
        do
            end--;
        while (end > s && simplex[end].v[0] < 0);
        if (end == s)
            break;
        simplex[s] = simplex[end];
        for (int32_t i = 0; i <= dim; i++)
            if (simplex[s].twin[i] != CAGE_HULL)
                simplex[simplex[s].twin[i] >> 2].twin[simplex[s].twin[i] & 3] = 4 * s + i;
    }
    b->simplices = end;
}

/* Slots that suffice: in the plane n sites make at most 2 n - 5 triangles, and the new ones stand beside those they replace; in
 * space the number depends on the balls, up to their square, and 8 a site is usual. */
static size_t slots_expected(int32_t dim, int32_t sites)
{
    return dim == 2 ? 4 * (size_t)sites : 9 * (size_t)sites + 64;
}

/* What is needed beside sites and slots, rounding included. */
static size_t bytes_beside(const struct cage_triangulation *t)
{
    return 3 * CAGE_ALIGN + (t->dim == 3 && t->shortcuts ? t->shortcuts->ridges_size(t->sites) : 0);
}

/* Bytes from a mark on that suffice (a guess in space): sites, their order and its scratch, their numbers, slots. */
static size_t bytes_expected(const struct cage_triangulation *t)
{
    return (size_t)t->sites * (sizeof(struct cage_site) + 5 * sizeof(int32_t)) +
           slots_expected(t->dim, t->sites) * BYTES_PER_SIMPLEX + 5 * CAGE_ALIGN + bytes_beside(t);
}

/* All that is left of the arena serves as slots, of which the first are these simplices; slots not used will not count. */
static bool take_slots(struct cage_arena *arena, const struct cage_triangulation *t, const struct cage_simplex *first,
                       int32_t simplices, struct cage_build *b)
{
    size_t beside = bytes_beside(t), bytes = cage_arena_room(arena, 1);
    size_t room = bytes > beside ? (bytes - beside) / BYTES_PER_SIMPLEX : 0;
    b->shortcuts = t->shortcuts;
    b->ridges = NULL;
    b->site = t->site;
    b->simplices = simplices;
    b->dead = -1;
    b->last = 0;
    b->capacity = room > INT32_MAX / 4 ? INT32_MAX / 4 : (int32_t)room;
    b->simplex = cage_arena_take(arena, (size_t)b->capacity, sizeof *b->simplex);
    int32_t *lists = cage_arena_take(arena, (size_t)b->capacity, BYTES_PER_SIMPLEX - sizeof *b->simplex);
    if (b->capacity < simplices || !b->simplex || !lists ||
        (t->dim == 3 && b->shortcuts && !b->shortcuts->ridges_make(arena, b, t->sites)))
        return false;
    b->mark = lists;
    b->hole = lists + b->capacity;
    b->front = lists + 2 * (size_t)b->capacity;
    memcpy(b->simplex, first, (size_t)simplices * sizeof *first);
    memset(b->mark, 0, (size_t)simplices * sizeof *b->mark);
    return true;
}

/* Insert sites from `first` on; the simplices, in slots, stay in the arena, what else was taken is given back. */
static int32_t complete(struct cage_arena *arena, struct cage_triangulation *t, const struct cage_simplex *from,
                        int32_t simplices, int32_t first, size_t mark, bool dense)
{
    struct cage_build b;
    size_t kept = arena->used, peak = arena->peak, beside = bytes_beside(t);
    bool done = take_slots(arena, t, from, simplices, &b);
    if (done)
        done = t->dim == 2 ? insert_all_2d(&b, first, t->sites) : insert_all_3d(&b, first, t->sites);
    arena->peak = peak;
    cage_arena_release(arena, done ? kept : mark);
    if (!done) {
        size_t expected = slots_expected(t->dim, t->sites), room = (size_t)b.capacity;
        arena->needed = kept + (expected > room ? expected : 2 * room + 1) * BYTES_PER_SIMPLEX + beside + 4 * CAGE_ALIGN;
        return CAGE_ERROR_MEMORY;
    }
    size_t most = kept + (size_t)b.simplices * BYTES_PER_SIMPLEX + beside; /* dead slots included */
    arena->peak = arena->peak > most ? arena->peak : most;
    if (dense)
        compact(t->dim, &b);
    t->simplex = cage_arena_take(arena, (size_t)b.simplices, sizeof *b.simplex);
    t->simplices = b.simplices;
    return CAGE_OK;
}

int32_t cage_delaunay(struct cage_arena *arena, const struct cage_shortcuts *shortcuts, int32_t dim, const cage_ball *ball,
                      int32_t count, struct cage_triangulation *out)
{
    size_t mark = arena->used;
    struct cage_triangulation t = {NULL, NULL, NULL, shortcuts, dim, dim + 1 + count, 0};
    t.site = cage_arena_take(arena, (size_t)t.sites, sizeof *t.site);
    t.ball = cage_arena_take(arena, (size_t)t.sites, sizeof *t.ball);
    if (!t.site || !t.ball || cage_order(arena, dim, ball, count, t.ball + dim + 1) != CAGE_OK) {
        cage_arena_release(arena, mark);
        arena->needed = mark + bytes_expected(&t);
        return CAGE_ERROR_MEMORY;
    }
    make_sentinels(dim, t.site);
    for (int32_t i = 0; i <= dim; i++)
        t.ball[i] = -1;
    for (int32_t i = dim + 1; i < t.sites; i++) {
        const cage_ball *from = &ball[t.ball[i]];
        t.site[i] = make_site(from->x, from->y, from->z, from->r, (int64_t)from->r * from->r);
    }
    const struct cage_simplex first = {{0, 1, 2, dim == 2 ? 0 : 3}, {CAGE_HULL, CAGE_HULL, CAGE_HULL, CAGE_HULL}};
    int32_t error = complete(arena, &t, &first, 1, dim + 1, mark, true);
    if (error == CAGE_OK)
        *out = t;
    return error;
}

int32_t cage_delaunay_drop_hidden(struct cage_arena *arena, struct cage_triangulation *t)
{
    size_t mark = arena->used;
    int32_t kept = 0, *now = cage_arena_take(arena, (size_t)t->sites, sizeof *now);
    if (!now)
        return CAGE_ERROR_MEMORY;
    memset(now, 0, (size_t)t->sites * sizeof *now);
    for (int32_t s = 0; s < t->simplices; s++)
        for (int32_t i = 0; i <= t->dim; i++)
            now[t->simplex[s].v[i]] = 1;
    for (int32_t i = 0; i < t->sites; i++) {
        t->site[kept] = t->site[i];
        t->ball[kept] = t->ball[i];
        kept += i <= t->dim ? 1 : now[i];
        now[i] = kept - 1;
    }
    for (int32_t s = 0; s < t->simplices; s++)
        for (int32_t i = 0; i <= t->dim; i++)
            t->simplex[s].v[i] = now[t->simplex[s].v[i]];
    t->sites = kept;
    cage_arena_release(arena, mark);
    return CAGE_OK;
}

int32_t cage_delaunay_extend(struct cage_arena *arena, const struct cage_triangulation *t, const struct cage_site *const *more,
                             int32_t count, struct cage_triangulation *out)
{
    size_t mark = arena->used;
    struct cage_triangulation made = {NULL, NULL, NULL, t->shortcuts, t->dim, t->sites + count, 0};
    made.site = cage_arena_take(arena, (size_t)made.sites, sizeof *made.site);
    if (!made.site)
        return CAGE_ERROR_MEMORY;
    memcpy(made.site, t->site, (size_t)t->sites * sizeof *t->site);
    for (int32_t i = 0; i < count; i++)
        made.site[t->sites + i] = *more[i];
    int32_t error = complete(arena, &made, t->simplex, t->simplices, t->sites, mark, false);
    if (error == CAGE_OK)
        *out = made;
    return error;
}

int32_t cage_delaunay_locate(const struct cage_triangulation *t, const int32_t p[3], int32_t hint)
{
    const struct cage_site point = {0, p[0], p[1], p[2], 0};
    return t->dim == 2 ? walk(2, t->site, t->simplex, &point, hint) : walk(3, t->site, t->simplex, &point, hint);
}

int32_t cage_delaunay_locate_centre(const struct cage_triangulation *t, const struct cage_centre *centre, int32_t hint)
{
    int32_t s = hint, i = 0;
    while (i <= t->dim) {
        const struct cage_site *face[3];
        cage_facet_sites(t, s, i, face);
        if (cage_centre_side(t->dim, face, centre) >= 0) {
            i++;
            continue;
        }
        if (t->simplex[s].twin[i] == CAGE_HULL)
            return -1;
        s = t->simplex[s].twin[i] >> 2;
        i = 0;
    }
    return s;
}

void cage_simplex_sites(const struct cage_triangulation *t, int32_t s, const struct cage_site *v[4])
{
    const int32_t *index = t->simplex[s].v;
    v[0] = &t->site[index[0]];
    v[1] = &t->site[index[1]];
    v[2] = &t->site[index[2]];
    if (t->dim == 3)
        v[3] = &t->site[index[3]];
}

void cage_facet_sites(const struct cage_triangulation *t, int32_t s, int32_t i, const struct cage_site *face[3])
{
    const int32_t *v = t->simplex[s].v, *index = face_of(t->dim, i);
    face[0] = &t->site[v[index[0]]];
    face[1] = &t->site[v[index[1]]];
    if (t->dim == 3)
        face[2] = &t->site[v[index[2]]];
}
