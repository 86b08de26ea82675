/* barrier: proofs that a component of one slice and one of its neighbour are apart.
 *
 * Component K of slice c and L of slice d: let every vertex of the triangulation of c move on a straight line to where it is in
 * d, its power function interpolated likewise, so that each ball on the way lies in the union of the one that it comes from and
 * the one that it goes to. A facet or full simplex is solid if at every time it lies in the union of its own balls. Let R be
 * the union of the full simplices reached from those labelled K without crossing a solid facet or entering a solid simplex, S
 * its border. K lies in R (location lemma). A point of K off d is never met by the moving border, so it has the same winding
 * number (modulo 2) about S and about S', which is S arrived in d. S' lies in the balls of d, so all of L has one number, and
 * where a point of L has another, K and L are apart. A point of L that the moving border does not meet either has the other iff
 * it is off R. R extends beyond the sentinels' simplex iff it holds a simplex with a sentinel (then it holds all of these), and
 * the outside of d always does. */
#include "barrier.h"
#include "box.h"
#include "grid.h"

#include <string.h>

/* How the balls of one object ball move. */
struct move {
    int64_t by[3];
    int64_t sag;    /* what interpolation takes from their weights */
    int64_t change; /* of their radii */
};

/* A site: where it arrives in d, and its least weight on the way, less what interpolation takes; -1: it is a sentinel, or there
 * is no such ball in d. */
struct cage_mover {
    int64_t at[3];
    int64_t weight;
};

/* Balls move far if by more than 6 tenths of a radius: |by|^2 / 4 > 9 r^2 / 100; both below 2^59, in units of 2^8 here. */
static bool moves_far(int64_t sag, int64_t radius) { return 100 * (sag >> 8) > 9 * (radius * radius >> 8); }

/* A component of so few simplices is small; its spread ends, undecided, when it is so long. */
enum { SMALL = 32, LONG = 256 };

static struct move move_of(const struct cage_part *from, const struct cage_part *to)
{
    struct move move = {{0, 0, 0}, 3, to->change - from->change};
    for (int32_t i = 0; i < 3; i++) { /* |by| < 2 |y| + 2: squares < 2^58 */
        move.by[i] = (int64_t)from->at[i] - to->at[i];
        move.sag += move.by[i] * move.by[i];
    }
    move.sag /= 4; /* |by|^2 / 4 at most, rounded up */
    return move;
}

static struct cage_mover mover_of(const struct cage_site *site, const struct move *move)
{
    int64_t here = site->r, there = here + move->change, least = here < there ? here : there;
    struct cage_mover mover = {{site->x + move->by[0], site->y + move->by[1], site->z + move->by[2]}, -1};
    if (least >= 0 && least * least >= move->sag)
        mover.weight = least * least - move->sag;
    return mover;
}

int32_t cage_barrier_make(struct cage_arena *arena, const int32_t *match, struct cage_view *view)
{
    const struct cage_slice *c = view->c, *d = view->d;
    struct cage_barrier made = {NULL, NULL, NULL, NULL, 0, 0, CAGE_COVERED, false, false};
    int64_t longest = 0, radius = 0;
    made.mover = cage_arena_take(arena, (size_t)c->t.sites, sizeof *made.mover);
    made.reached = cage_arena_take(arena, (size_t)c->t.simplices, sizeof *made.reached);
    made.queue = cage_arena_take(arena, (size_t)c->t.simplices, sizeof *made.queue);
    made.solid = cage_arena_take(arena, (size_t)c->t.simplices, sizeof *made.solid);
    view->barrier = cage_arena_take(arena, 1, sizeof *view->barrier);
    struct move *move = cage_arena_take(arena, (size_t)c->parts, sizeof *move);
    if (!made.mover || !move || !made.reached || !made.queue || !made.solid || !view->barrier)
        return CAGE_ERROR_MEMORY;
    for (int32_t i = 0; i < c->parts; i++) {
        move[i] = move_of(&c->part[i], &d->part[match ? match[i] : i]);
        longest = move[i].sag > longest ? move[i].sag : longest;
    }
    for (int32_t i = 0; i <= c->t.dim; i++)
        made.mover[i].weight = -1;
    for (int32_t i = c->t.dim + 1; i < c->t.sites; i++) {
        radius = c->t.site[i].r > radius ? c->t.site[i].r : radius;
        made.mover[i] = mover_of(&c->t.site[i], &move[c->t.ball[i]]);
    }
    made.far = moves_far(longest, radius);
    memset(made.reached, 0, (size_t)c->t.simplices * sizeof *made.reached);
    memset(made.solid, -1, (size_t)c->t.simplices * sizeof *made.solid);
    *view->barrier = made;
    return CAGE_OK;
}

/* Greatest squared distance of two sites on their way: at one end of it. Differences < 2^29 in the plane, 2^24 in space. */
static int64_t square_of(const struct cage_view *view, int32_t a, int32_t b)
{
    const int64_t *p = view->barrier->mover[a].at, *q = view->barrier->mover[b].at;
    int64_t here = 0, there = 0;
    int32_t e[3];
    cage_difference(&view->c->t.site[a], &view->c->t.site[b], e);
    for (int32_t n = 0; n < 3; n++) {
        here += (int64_t)e[n] * e[n];
        there += (p[n] - q[n]) * (p[n] - q[n]);
    }
    return here > there ? here : there;
}

/* Is the facet that lacks vertex i, or in the plane (i = 3) the triangle, solid? */
static bool is_solid_facet(const struct cage_view *view, int32_t s, int32_t i)
{
    const struct cage_triangulation *t = &view->c->t;
    int32_t v[3] = {0, 0, 0}, count = 0;
    int64_t square[3], weight[3];
    for (int32_t k = 0; k <= t->dim; k++)
        if (k != i) {
            v[count] = t->simplex[s].v[k];
            weight[count] = view->barrier->mover[v[count]].weight;
            if (weight[count++] < 0)
                return false;
        }
    for (int32_t k = 0; k < (count == 2 ? 1 : 3); k++)
        square[k] = square_of(view, v[(k + 1) % count], v[(k + 2) % count]);
    return cage_edges_covered(count, square, weight);
}

static bool is_solid(const struct cage_view *view, int32_t s)
{
    const struct cage_simplex *simplex = &view->c->t.simplex[s];
    int64_t square[4][4], weight[4];
    int8_t *solid = &view->barrier->solid[s];
    if (*solid >= 0)
        return *solid;
    *solid = 0;
    if (view->c->label[s] != CAGE_COVERED)
        return false;
    if (view->c->t.dim == 2) {
        *solid = is_solid_facet(view, s, 3);
        return *solid;
    }
    for (int32_t i = 0; i < 4; i++) {
        weight[i] = view->barrier->mover[simplex->v[i]].weight;
        if (weight[i] < 0)
            return false;
        for (int32_t k = 0; k < i; k++)
            square[i][k] = square[k][i] = square_of(view, simplex->v[i], simplex->v[k]);
    }
    *solid = cage_tetrahedron_covered(square, weight);
    return *solid;
}

static void reach(struct cage_barrier *barrier, int32_t s)
{
    barrier->reached[s] = barrier->spreads;
    barrier->queue[barrier->length++] = s;
}

/* Simplices of one label are joined by facets, so one will do; the outside may have but simplices with a sentinel. */
static void reach_first(const struct cage_view *view, int32_t k)
{
    const struct cage_triangulation *t = &view->c->t;
    if (k != CAGE_OUTSIDE) {
        reach(view->barrier, view->c->region[k].deep);
        return;
    }
    for (int32_t s = 0; s < t->simplices; s++)
        if (view->c->label[s] == k)
            reach(view->barrier, s);
}

/* Find R for component k. */
static void spread(const struct cage_view *view, int32_t k)
{
    const struct cage_triangulation *t = &view->c->t;
    const int32_t *label = view->c->label;
    struct cage_barrier *barrier = view->barrier;
    barrier->spreads++;
    barrier->from = k;
    barrier->outer = false;
    barrier->length = 0;
    reach_first(view, k);
    bool small = k != CAGE_OUTSIDE && view->c->region[k].size <= SMALL;
    for (int32_t n = 0; n < barrier->length; n++) {
        int32_t s = barrier->queue[n];
        barrier->outer = barrier->outer || cage_simplex_outer(t, s) || (small && n > LONG);
        if (barrier->outer && k != CAGE_OUTSIDE)
            return; /* little would be told by what is left, and for a small component a mixture takes less */
        for (int32_t i = 0; i <= t->dim; i++) {
            int32_t twin = t->simplex[s].twin[i], next = twin >> 2;
            if (twin == CAGE_HULL || barrier->reached[next] == barrier->spreads)
                continue;
            if (label[next] == k || (!is_solid_facet(view, s, i) && !is_solid(view, next)))
                reach(barrier, next);
        }
    }
}

/* May the border of R, moving, meet the point? Only within a ball of a solid facet or of the solid simplex behind a facet. */
static bool may_meet(const struct cage_view *view, const int32_t y[3])
{
    const struct cage_triangulation *t = &view->c->t;
    const struct cage_barrier *barrier = view->barrier;
    for (int32_t r = 0; r < barrier->length; r++)
        for (int32_t i = 0; i <= t->dim; i++) {
            int32_t twin = t->simplex[barrier->queue[r]].twin[i];
            if (twin == CAGE_HULL || barrier->reached[twin >> 2] == barrier->spreads)
                continue;
            for (int32_t n = 0; n <= t->dim; n++) /* sentinels never do */
                if (cage_power(&t->site[t->simplex[twin >> 2].v[n]], y) <= 0)
                    return true;
        }
    return false;
}

/* Is a component of d, whose point is in the simplex, within one of that one's balls? */
static bool is_held(const struct cage_view *view, int32_t l, int32_t simplex)
{
    struct cage_box box;
    if (l == CAGE_OUTSIDE)
        return false;
    cage_box_of(view->d->t.dim, &view->d->region[l].bounds, &box);
    for (int32_t i = 0; i <= view->c->t.dim; i++) {
        int32_t v = view->c->t.simplex[simplex].v[i];
        if (v > view->c->t.dim && cage_box_is_held(&box, &view->c->t.site[v]))
            return true;
    }
    return false;
}

bool cage_barrier_is_apart(const struct cage_view *view, int32_t k, int32_t l)
{
    const struct cage_barrier *barrier = view->barrier;
    int32_t home = cage_view_home(view, l);
    if (home >= 0 && is_held(view, l, home))
        return true;
    if (barrier->from != k)
        spread(view, k);
    if (barrier->outer && k != CAGE_OUTSIDE)
        return false;
    if (l == CAGE_OUTSIDE)
        return true;
    return home >= 0 && barrier->reached[home] != barrier->spreads &&
           (cage_view_is_off(view, l) || !may_meet(view, view->d->region[l].point));
}
