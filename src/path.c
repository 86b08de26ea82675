/* path: decomposable path along the outer way: translations inside a slice, turns between slices, each step certified.
 * Along the inner way the same, and not certified: a candidate.
 *
 * Inside a slice the way runs from simplex to simplex of one component: the segment between the orthocentres of two
 * free neighbours is free, and so is that from a free point to the orthocentre of its simplex. Way points are rounded
 * to the grid and the legs certified again (certify.h), the longest that are clear taken first. */
#include "certify.h"
#include "proof.h"

enum { FAR_2D = 5 << 28, FAR_3D = 1 << 25, CLIPS = 64 };

/* Directions in which the sentinels lie from the centre of their simplex: from a point that is nearest to a sentinel, the
 * ray in its direction is free. */
static const int32_t RAY_2D[3][3] = {{-3, -2, 0}, {3, -2, 0}, {0, 1, 0}};
static const int32_t RAY_3D[4][3] = {{1, 1, 1}, {1, -1, -1}, {-1, -1, 1}, {-1, 1, -1}};

struct point {
    int32_t x[3];
};

void cage_path_begin(struct cage_proof *proof, int32_t side)
{
    proof->path_side = side;
    size_t room = cage_arena_room(&proof->arena, sizeof *proof->path);
    proof->path_room = room > INT32_MAX ? INT32_MAX : (int32_t)room;
    proof->path = (cage_pose *)(void *)(proof->arena.base + proof->arena.used);
    proof->path_count = 0;
    proof->way->next_open = NULL;
    struct cage_node *node = proof->way;
    for (; node->from; node = node->from)
        node->from->next_open = node;
    proof->leg = node;
    proof->turned = 0;
}

/* The orthocentre of a simplex, rounded; false if it is too far away to be a way point. */
static bool centre_of(const struct cage_triangulation *t, int32_t s, struct point *out)
{
    const struct cage_site *v[4];
    struct cage_centre centre;
    int64_t far = t->dim == 2 ? FAR_2D : FAR_3D;
    cage_simplex_sites(t, s, v);
    cage_orthocentre(t->dim, v, &centre);
    const int32_t base[3] = {centre.base->x, centre.base->y, centre.base->z};
    for (int32_t k = 0; k < 3; k++) {
        int64_t at = base[k] + cage_i128_nearest(centre.offset[k], centre.denominator, 4 * far);
        if (at < -far || at > far)
            return false;
        out->x[k] = (int32_t)at;
    }
    return true;
}

/* Breadth first through one component, from simplex s to `to` (or any with a sentinel if -1), by simplices whose orthocentres
 * are near enough. from[]: the simplex each was reached from. Returns the last one or -1. */
static int32_t route(const struct cage_slice *slice, int32_t s, int32_t to, int32_t *from, int32_t *queue)
{
    const struct cage_triangulation *t = &slice->t;
    int32_t count = 1, label = slice->label[s];
    struct point unused;
    for (int32_t i = 0; i < t->simplices; i++)
        from[i] = -1;
    queue[0] = s;
    from[s] = s;
    for (int32_t n = 0; n < count; n++) {
        int32_t here = queue[n];
        if (to >= 0 ? here == to : cage_simplex_outer(t, here))
            return here;
        if (here != s && !centre_of(t, here, &unused))
            continue;
        for (int32_t i = 0; i <= t->dim; i++) {
            int32_t next = t->simplex[here].twin[i] >> 2;
            if (t->simplex[here].twin[i] == CAGE_HULL || from[next] >= 0 || slice->label[next] != label ||
                cage_component_wall(t, here, i))
                continue;
            from[next] = here;
            queue[count++] = next;
        }
    }
    return -1;
}

/* The orthocentre of simplex s is out of reach: the point in its direction from the way point a, 2^29 (2^25) away. */
static struct point toward(const struct cage_triangulation *t, int32_t s, struct point a)
{
    const struct cage_site *v[4];
    struct cage_centre centre;
    cage_i128 offset[3], all = cage_i128_of(0);
    cage_simplex_sites(t, s, v);
    cage_orthocentre(t->dim, v, &centre);
    const int32_t base[3] = {centre.base->x, centre.base->y, centre.base->z};
    for (int32_t k = 0; k < 3; k++) {
        /* offset + denominator (base - a): < 2^95 in the plane, 2^107 in space */
        offset[k] = cage_i128_add(centre.offset[k], cage_i128_scale(centre.denominator, (int64_t)base[k] - a.x[k]));
        cage_i128 size = cage_i128_abs(offset[k]);
        all = cage_i128_compare(size, all) > 0 ? size : all;
    }
    for (int32_t k = 0; k < 3; k++) {
        /* scaled by 2^29 / all: < 2^126 before the division in space too, after dropping 16 bits there */
        uint32_t shift = t->dim == 2 ? 0 : 16;
        cage_i128 size = cage_i128_shr(cage_i128_abs(offset[k]), shift);
        int64_t to = cage_i128_nearest(cage_i128_scale(size, t->dim == 2 ? 1 << 29 : FAR_3D), cage_i128_shr(all, shift), 1 << 29);
        a.x[k] += (int32_t)(cage_i128_negative(offset[k]) ? -to : to);
    }
    return a;
}

/* From the orthocentre of a simplex with a sentinel, straight out until the object is beyond all obstacles. */
static struct point beyond(const struct cage_proof *proof, const struct cage_triangulation *t, int32_t s, struct point from)
{
    int32_t sentinel = 0;
    for (int32_t i = 0; i <= t->dim; i++)
        if (t->simplex[s].v[i] <= t->dim)
            sentinel = t->simplex[s].v[i];
    const int32_t *ray = t->dim == 2 ? RAY_2D[sentinel] : RAY_3D[sentinel];
    int32_t axis = ray[0] ? 0 : 1, low, high, size = cage_certify_size(&proof->scene, proof->result.pivot);
    cage_certify_extent(&proof->scene, axis, &low, &high);
    /* A point that is nearest to this sentinel is not far on the other side of it: the sums stay below 2^31. */
    int64_t missing = low > high ? 0 : ray[axis] > 0 ? (int64_t)high + size - from.x[axis] : (int64_t)from.x[axis] - (low - size);
    int64_t pace = ray[axis] > 0 ? ray[axis] : -ray[axis], times = missing > 0 ? (missing + pace - 1) / pace : 0;
    for (int32_t k = 0; k < 3; k++) {
        int64_t at = from.x[k] + ray[k] * times;
        from.x[k] = at < INT32_MIN   ? INT32_MIN
                    : at > INT32_MAX ? INT32_MAX
                                     : (int32_t)at; /* if it did not, the leg is not clear */
    }
    return from;
}

static bool append(struct cage_proof *proof, const int32_t x[3], const int32_t q[4])
{
    if (proof->path_count == proof->path_room)
        return false;
    cage_pose *pose = &proof->path[proof->path_count++];
    for (int32_t k = 0; k < 3; k++)
        pose->x[k] = x[k];
    for (int32_t k = 0; k < 4; k++)
        pose->q[k] = q[k];
    return true;
}

/* Append the way points after the first, leaving out those that a clear leg can pass by. */
static int32_t append_way(struct cage_proof *proof, const struct point *way, int32_t count, const int32_t q[4])
{
    for (int32_t at = 0; at + 1 < count;) {
        int32_t to = proof->path_side == CAGE_INNER ? at + 1 : count - 1;
        while (proof->path_side == CAGE_OUTER &&
               !cage_certify_leg(&proof->scene, proof->result.pivot, q, way[at].x, way[to].x, 0)) {
            if (to == at + 1)
                return CAGE_PATH_FAILED;
            to = at + (to - at) / 2;
        }
        if (!append(proof, way[to].x, q))
            return CAGE_ERROR_MEMORY;
        at = to;
    }
    return CAGE_OK;
}

/* The leg inside one slice: from enter to leave, or out (leave null). */
static int32_t append_leg(struct cage_proof *proof, const struct cage_slice *slice, const int32_t q[4], const int32_t enter[3],
                          const int32_t *leave)
{
    const struct cage_triangulation *t = &slice->t;
    struct cage_arena *scratch = &proof->scratch;
    int32_t *from = cage_arena_take(scratch, (size_t)t->simplices, sizeof *from);
    int32_t *queue = cage_arena_take(scratch, (size_t)t->simplices, sizeof *queue);
    struct point *way = cage_arena_take(scratch, (size_t)t->simplices + 3, sizeof *way);
    if (!from || !queue || !way)
        return CAGE_ERROR_MEMORY;
    int32_t first = cage_delaunay_locate(t, enter, 0), last = leave ? cage_delaunay_locate(t, leave, first) : -1;
    last = route(slice, first, last, from, queue);
    if (last < 0 && proof->path_side == CAGE_INNER) { /* a common point beside a component thinner than the grid */
        return !leave || append(proof, leave, q) ? CAGE_OK : CAGE_ERROR_MEMORY;
    }
    if (last < 0)
        return CAGE_PATH_FAILED;

    /* Filled from the end: leave or the way out, orthocentres, enter. */
    int32_t at = t->simplices + 3, end = at;
    struct point centre, start = {{enter[0], enter[1], enter[2]}};
    if (leave) {
        struct point stop = {{leave[0], leave[1], leave[2]}};
        way[--at] = stop;
    } else if (centre_of(t, last, &centre)) {
        way[--at] = beyond(proof, t, last, centre);
    } else {
        struct point before = start;
        if (last != first)
            centre_of(t, from[last], &before);
        way[--at] = toward(t, last, before);
    }
    for (int32_t s = last;; s = from[s]) {
        if (centre_of(t, s, &centre))
            way[--at] = centre;
        if (s == first)
            break;
    }
    way[--at] = start;
    return append_way(proof, &way[at], end - at, q);
}

/* End the path at the first of some points on its last leg at which the object is beyond all obstacles. */
static void clip(struct cage_proof *proof)
{
    cage_pose *last = &proof->path[proof->path_count - 1];
    const cage_pose from = last[-1], to = *last;
    for (int32_t n = 1; n < CLIPS; n++) {
        for (int32_t k = 0; k < 3; k++)
            last->x[k] = (int32_t)(from.x[k] + ((int64_t)to.x[k] - from.x[k]) * n / CLIPS);
        if (cage_certify_beyond(&proof->scene, proof->result.pivot, last->x) &&
            (proof->path_side == CAGE_INNER ||
             cage_certify_leg(&proof->scene, proof->result.pivot, to.q, from.x, last->x, 0)))
            return;
    }
    *last = to;
}

/* A rotation in both of two touching cells, each turned. */
static void common_of(const struct cage_graph *graph, int32_t a, int32_t a_turned, int32_t b, int32_t b_turned, int32_t q[4])
{
    struct cage_cell first = graph->cell[a].cell, second = graph->cell[b].cell;
    if (a_turned)
        cage_so3_turned_cell(&graph->cell[a].cell, a_turned, &first);
    if (b_turned)
        cage_so3_turned_cell(&graph->cell[b].cell, b_turned, &second);
    graph->fibre->common(&first, &second, q);
}

int32_t cage_path_step(struct cage_proof *proof)
{
    struct cage_node *node = proof->leg, *next = node->next_open;
    int32_t q[4], (*at)[3] = proof->path_side == CAGE_OUTER ? proof->outer_at : proof->at;
    cage_so3_turned(proof->graph.cell[node->cell].rotations.q, proof->turned, q);
    const int32_t *enter = node->via ? node->via->x : at[proof->origin];
    const int32_t *leave = next ? next->via->x : proof->graph.goal ? at[1 - proof->origin] : NULL;
    const struct cage_slice *slice;
    int32_t error = cage_proof_slice(proof, proof->path_side, node->cell, &slice);
    if (error != CAGE_OK)
        return error;
    if (!node->via && !append(proof, proof->at[proof->origin], q))
        return CAGE_ERROR_MEMORY;
    if (!append(proof, enter, q))
        return CAGE_ERROR_MEMORY;
    size_t mark = proof->scratch.used;
    error = append_leg(proof, slice, q, enter, leave);
    cage_arena_release(&proof->scratch, mark);
    if (error != CAGE_OK)
        return error;
    if (next) {
        int32_t common[4], turned = cage_graph_turn(&proof->graph, node->cell, proof->turned, next->cell);
        bool between = node->cell >= CAGE_CELL_ROOT && next->cell >= CAGE_CELL_ROOT;
        if (between)
            common_of(&proof->graph, node->cell, proof->turned, next->cell, turned, common);
        if (between && !append(proof, leave, common))
            return CAGE_ERROR_MEMORY;
        proof->turned = turned;
    }
    proof->leg = next;
    if (next)
        return 0;
    if (!proof->graph.goal)
        clip(proof);
    if (proof->graph.goal && !append(proof, proof->at[1 - proof->origin], q))
        return CAGE_ERROR_MEMORY;
    for (int32_t i = 0, k = proof->path_count - 1; proof->origin == CAGE_CELL_GOAL && i < k; i++, k--) {
        cage_pose pose = proof->path[i];
        proof->path[i] = proof->path[k];
        proof->path[k] = pose;
    }
    if (proof->path_side == CAGE_INNER)
        return 1;
    return cage_path_check(&proof->scene, &proof->pose[0], proof->graph.goal ? &proof->pose[1] : NULL, proof->result.pivot,
                           proof->path, proof->path_count) == 1
               ? 1
               : CAGE_PATH_FAILED;
}
