/* test_rebuild.c: every separation that a search proved, proved again from nothing over its last cells. */
#include "support.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "arcs.h"
#include "cubes.h"
#include "proof.h"
#include "referee.h"
#include "scenes.h"
#include "scenes_space.h"
#include "whole.h"

enum { PLENTY = 64 << 20, LEAVES = 2304, NODES = 1 << 14 };

/* The plane or space, its cells of rotations compared once more. */
struct place {
    const struct cage_fibre *fibre;
    bool (*holds)(const struct cage_cell *cell, const int32_t q[4]);
    bool (*neighbours)(const struct cage_cell *a, const struct cage_cell *b);
    void (*check_cover)(void);
};

/* The inner graph of all leaves, and of their images under half turns that take the object to itself (these have the same balls, see
 * test_turns, and share a slice): nodes of leaf i are first[i] to first[i + 1] - 1. */
struct again {
    int32_t leaves, nodes;
    struct cage_cell cell[LEAVES];
    const struct cage_leaf *leaf[LEAVES]; /* whose image it is */
    int32_t first[LEAVES + 1];
    struct cage_slice slice[LEAVES];
    int32_t group[NODES]; /* union-find */
};

/* entered: leaves whose slice the search has built; uneven: pairs of neighbours of unequal level; outside: nodes reached. */
struct tally {
    long proofs, turned, leaves, entered, pairs, uneven, nodes, reached, outside, edges;
};

static unsigned char *memory, *work;
static struct again graph;

/* ---- the plane, and space ---------------------------------------------------------------------------- */

static bool arc_holds_rotation(const struct cage_cell *cell, const int32_t q[4])
{
    const struct arc_rotation r = {q[0], q[3]};
    return arc_holds(cell, r);
}

/* The leaves cover the circle: each leaf's last rotation is the first one of exactly one leaf. */
static void check_circle(void)
{
    for (int32_t i = 0; i < graph.leaves; i++) {
        int32_t next = 0;
        for (int32_t j = 0; j < graph.leaves; j++)
            next += arc_same(arc_end(&graph.cell[i], 1), arc_end(&graph.cell[j], 0));
        test_require(next == 1);
    }
}

static bool cube_holds_rotation(const struct cage_cell *cell, const int32_t q[4])
{
    const struct cube_box point = cube_point(q);
    return cube_holds(cell, &point);
}

static bool cubes_share_facet(const struct cage_cell *a, const struct cage_cell *b)
{
    int64_t area;
    return cube_shared(a, b, &area) >= 2;
}

/* The leaves cover four faces of the cube: no two overlap, and their volumes add up. */
static void check_cube(void)
{
    int64_t volume = 0, area;
    for (int32_t i = 0; i < graph.leaves; i++) {
        int64_t size = CUBE_WIDTH >> graph.cell[i].level;
        volume += size * size * size;
        for (int32_t j = 0; j < i; j++)
            test_require(cube_shared(&graph.cell[i], &graph.cell[j], &area) < 3);
    }
    test_require(volume == (int64_t)4 * CUBE_WIDTH * CUBE_WIDTH * CUBE_WIDTH);
}

static const struct place plane = {&cage_so2, arc_holds_rotation, arc_touch, check_circle};
static const struct place space = {&cage_so3, cube_holds_rotation, cubes_share_facet, check_cube};

/* ---- the graph once more ----------------------------------------------------------------------------- */

static void find_leaves(const struct cage_proof *proof)
{
    graph.leaves = 0;
    for (int32_t i = CAGE_CELL_ROOT; i < proof->graph.cells; i++)
        for (int32_t t = 0; t < proof->graph.turns && proof->graph.cell[i].child == 0; t++) {
            test_require(graph.leaves < LEAVES);
            graph.cell[graph.leaves] = proof->graph.cell[i].cell;
            if (proof->scene.dim == 3) /* test_turns */
                cage_so3_turned_cell(&proof->graph.cell[i].cell, proof->graph.turn[t], &graph.cell[graph.leaves]);
            graph.leaf[graph.leaves++] = &proof->graph.cell[i];
        }
}

static int32_t root_of(int32_t node)
{
    while (graph.group[node] != node) {
        graph.group[node] = graph.group[graph.group[node]];
        node = graph.group[node];
    }
    return node;
}

static void join(int32_t a, int32_t b)
{
    a = root_of(a);
    b = root_of(b);
    graph.group[a > b ? a : b] = a > b ? b : a;
}

/* The slice with the turn and the corners that the cell itself says, in a block of its own. */
static void make_slice(struct cage_arena *arena, const struct cage_fibre *fibre, const struct cage_side *side,
                       const struct cage_cell *cell, struct cage_slice *out)
{
    struct cage_rotations rotations;
    struct cage_corners corners;
    struct cage_slice slice;
    int32_t corner[8][4];
    size_t mark = arena->used;
    fibre->representative(cell, rotations.q);
    rotations.turn = fibre->turn(cell);
    bool within = fibre->corners(cell, corner) == 8;
    if (within)
        cage_corners_of(rotations.q, corner, &corners);
    ck_assert_int_eq(cage_slice_make_within(arena, side, &rotations, within ? &corners : NULL, &slice), CAGE_OK);
    cage_slice_pack(&slice, test_alloc(slice.bytes), out);
    cage_arena_release(arena, mark);
}

static void make_slices(struct cage_arena *arena, const struct place *place, const struct cage_proof *proof)
{
    graph.nodes = 0;
    for (int32_t i = 0; i < graph.leaves; i++) {
        if (i > 0 && graph.leaf[i] == graph.leaf[i - 1])
            graph.slice[i] = graph.slice[i - 1];
        else
            make_slice(arena, place->fibre, &proof->side[CAGE_INNER], &graph.cell[i], &graph.slice[i]);
        graph.first[i] = graph.nodes;
        for (int32_t k = 0; k < graph.slice[i].regions; k++) {
            test_require(graph.nodes < NODES);
            graph.group[graph.nodes] = graph.nodes;
            graph.nodes++;
        }
    }
    graph.first[graph.leaves] = graph.nodes;
}

/* The block of a packed slice begins with its sites. */
static void free_slices(void)
{
    for (int32_t i = 0; i < graph.leaves; i++)
        if (i == 0 || graph.leaf[i] != graph.leaf[i - 1])
            free(graph.slice[i].t.site);
}

/* ---- start and goal ---------------------------------------------------------------------------------- */

static void add_product(mpz_t sum, int64_t a, int64_t b)
{
    mpz_t x, y;
    mpz_inits(x, y, NULL);
    exact_set(x, a);
    exact_set(y, b);
    mpz_addmul(sum, x, y);
    mpz_clears(x, y, NULL);
}

/* Where the pivot p is at the pose, x + R(q) p, exactly: q = (w, v) moves p by 2 (w t + v x t) / |q|^2, t = v x p. */
static void exact_place(const cage_pose *pose, const int32_t p[3], mpq_t x[3])
{
    const int64_t w = pose->q[0], v[3] = {pose->q[1], pose->q[2], pose->q[3]}; /* <= 2^30, p <= 2^28 */
    int64_t t[3], norm = w * w;
    for (int k = 0; k < 3; k++) {
        t[k] = v[(k + 1) % 3] * p[(k + 2) % 3] - v[(k + 2) % 3] * p[(k + 1) % 3];
        norm += v[k] * v[k];
    }
    for (int k = 0; k < 3; k++) {
        mpq_set_ui(x[k], 0, 1);
        add_product(mpq_numref(x[k]), 2 * w, t[k]);
        add_product(mpq_numref(x[k]), 2 * v[(k + 1) % 3], t[(k + 2) % 3]);
        add_product(mpq_numref(x[k]), -2 * v[(k + 2) % 3], t[(k + 1) % 3]);
        add_product(mpq_numref(x[k]), norm, (int64_t)pose->x[k] + p[k]);
        exact_set(mpq_denref(x[k]), norm);
        mpq_canonicalize(x[k]);
    }
}

/* The node that holds the exact pose; all of them, in the leaves that hold its rotation, must be joined. */
static int32_t node_at(const struct place *place, const struct cage_proof *proof, const cage_pose *pose)
{
    int32_t found = -1;
    mpq_t x[3];
    mpq_inits(x[0], x[1], x[2], NULL);
    exact_place(pose, proof->result.pivot, x);
    for (int32_t i = 0; i < graph.leaves; i++) {
        if (!place->holds(&graph.cell[i], pose->q))
            continue;
        int32_t label = whole_label_exact(&graph.slice[i].t, graph.slice[i].label, x);
        ck_assert_msg(label >= 0, "a free pose lies in an inner ball");
        int32_t node = root_of(graph.first[i] + label);
        ck_assert_msg(found < 0 || found == node, "neighbours that share the pose are not glued there");
        found = node;
    }
    ck_assert_msg(found >= 0, "no leaf holds the rotation");
    mpq_clears(x[0], x[1], x[2], NULL);
    return found;
}

/* ---- what the search knows --------------------------------------------------------------------------- */

/* The search's node, null if it never built the slice. */
static const struct cage_node *node_of(int32_t leaf, int32_t component)
{
    const struct cage_facts *facts = &graph.leaf[leaf]->facts[CAGE_INNER];
    test_require(facts->nodes == 0 || facts->nodes == graph.slice[leaf].regions);
    return facts->nodes > 0 ? &facts->node[component] : NULL;
}

static bool is_reached(const struct cage_proof *proof, const struct cage_node *node)
{
    return node && node->seen == proof->reach[CAGE_INNER].number;
}

/* How many edges the node has to the other (null: to all nodes) over the leaf. */
static int32_t edges_to(const struct cage_proof *proof, const struct cage_node *node, int32_t leaf, const struct cage_node *other)
{
    int32_t count = 0;
    for (const struct cage_edge *edge = node->edges; edge; edge = edge->next)
        count += &proof->graph.cell[edge->to->cell] == graph.leaf[leaf] && (!other || edge->to == other);
    return count;
}

/* The search has an edge, there and back, for each of the touching pairs of what it reached over both leaves, and no other. */
static int32_t check_edges(const struct cage_proof *proof, int32_t i, int32_t j, const struct cage_touch *touch, int32_t count)
{
    int32_t wanted = 0, found = 0;
    for (int32_t e = 0; e < count; e++) {
        const struct cage_node *k = node_of(i, touch[e].k), *l = node_of(j, touch[e].l);
        if (!is_reached(proof, k) && !is_reached(proof, l))
            continue;
        ck_assert_msg(k && l && edges_to(proof, k, j, l) == 1 && edges_to(proof, l, i, k) == 1, "an edge is missing");
        wanted++;
    }
    for (int32_t k = 0; k < graph.slice[i].regions; k++)
        if (is_reached(proof, node_of(i, k)))
            found += edges_to(proof, node_of(i, k), j, NULL);
    ck_assert_msg(found == wanted, "an edge for no reason");
    return wanted;
}

/* Is the component over the leaf, or over some image of it, joined with this node? */
static bool joins(int32_t leaf, int32_t component, int32_t from)
{
    bool joined = false;
    for (int32_t i = 0; i < graph.leaves; i++)
        joined = joined || (graph.leaf[i] == graph.leaf[leaf] && root_of(graph.first[i] + component) == from);
    return joined;
}

/* The search reached what is joined with this node, up to half turns, and nothing else. */
static void check_reached(const struct cage_proof *proof, int32_t from, struct tally *t)
{
    for (int32_t i = 0; i < graph.leaves; i++)
        for (int32_t k = 0; k < graph.slice[i].regions; k++) {
            bool mine = joins(i, k, from), theirs = is_reached(proof, node_of(i, k));
            ck_assert_msg(mine == theirs, "leaf %d component %d: %s", (int)i, (int)k,
                          mine ? "not reached" : "reached for no reason");
            ck_assert_msg(!mine || proof->graph.goal || k != CAGE_OUTSIDE, "the outside is reached");
            t->reached += mine;
            t->outside += mine && k == CAGE_OUTSIDE;
        }
}

/* ---- the proof once more ----------------------------------------------------------------------------- */

/* Glue all neighbours; the search did the same where it came. */
static void glue_all(struct cage_arena *arena, const struct place *place, const struct cage_proof *proof, struct tally *t)
{
    for (int32_t i = 0; i < graph.leaves; i++)
        for (int32_t j = 0; j < i; j++) {
            struct cage_touch *touch;
            int32_t count, mixed;
            size_t mark = arena->used;
            if (!place->neighbours(&graph.cell[i], &graph.cell[j]))
                continue;
            if (graph.leaf[i] == graph.leaf[j]) { /* a cell and its image */
                for (int32_t k = 0; k < graph.slice[i].regions; k++)
                    join(graph.first[i] + k, graph.first[j] + k);
                continue;
            }
            ck_assert_int_eq(cage_glue(arena, &graph.slice[i], &graph.slice[j], CAGE_ALL, &touch, &count, &mixed), CAGE_OK);
            for (int32_t e = 0; e < count; e++)
                join(graph.first[i] + touch[e].k, graph.first[j] + touch[e].l);
            t->edges += check_edges(proof, i, j, touch, count);
            t->pairs++;
            t->uneven += graph.cell[i].level != graph.cell[j].level;
            cage_arena_release(arena, mark);
        }
}

/* Prove; then prove again. In space there may be a second search; that looks for paths only. */
static void prove_twice(const struct place *place, const question *q, struct tally *t)
{
    cage_proof *proof;
    struct cage_arena arena;
    bool small = q->limits->side == CAGE_SIDE_INNER && t->proofs % 6 == 0; /* every second of the inner side: the least code */
    int32_t error = small ? cage_prove_begin_small(&proof, q->view, q->start, q->goal, q->limits, memory, PLENTY)
                          : cage_prove_begin(&proof, q->view, q->start, q->goal, q->limits, memory, PLENTY);
    if (error != CAGE_OK)
        return;
    ck_assert_int_eq(cage_prove_run(proof, INT64_MAX), 1);
    int32_t verdict = cage_prove_result(proof)->verdict;
    if (verdict != CAGE_CAGED && verdict != CAGE_DISCONNECTED)
        return;
    cage_arena_init(&arena, work, PLENTY);
    find_leaves(proof);
    place->check_cover();
    make_slices(&arena, place, proof);
    glue_all(&arena, place, proof, t);
    int32_t from = node_at(place, proof, &proof->pose[proof->origin]);
    if (verdict == CAGE_DISCONNECTED)
        ck_assert_msg(node_at(place, proof, &proof->pose[1 - proof->origin]) != from, "the goal is reached");
    check_reached(proof, from, t);
    t->proofs++;
    t->turned += proof->graph.turns > 1;
    t->leaves += graph.leaves;
    t->nodes += graph.nodes;
    for (int32_t i = 0; i < graph.leaves; i++)
        t->entered += node_of(i, CAGE_OUTSIDE) != NULL;
    free_slices();
}

/* One end is caged, the other gets out, though only by turning: the outside is reached, too. Then scenes as they come. */
static void ask_in_plane(int32_t round, struct tally *t)
{
    static const uint64_t outside[] = {540052, 540419};
    const int32_t first = sizeof outside / sizeof *outside;
    scene s;
    cage_limits limits;
    scene_random(round < first ? outside[round] : (uint64_t)(round - first) + 500000, &s);
    cage_scene view = scene_view(&s);
    cage_limits_default(&limits, 2);
    limits.max_level = 8;
    limits.max_cells = 128;
    limits.start_level = (int32_t)(s.seed % 5) - 1; /* chosen by the library, or coarse: then refined */
    limits.side = t->proofs % 3 == 0 ? CAGE_SIDE_INNER : CAGE_SIDE_BOTH;
    const question q = {&view, &s.start, scene_goal(&s), &limits};
    prove_twice(&plane, &q, t);
}

/* Fingers so tight that the object cannot turn to all rotations, or only where cells are fine; then scenes as they come. */
static void ask_in_space(int32_t round, struct tally *t)
{
    static const uint64_t tight[] = {501258, 504316, 507715, 505889, 502424};
    const int32_t first = sizeof tight / sizeof *tight;
    space_scene s;
    cage_limits limits;
    space_random(round < first ? tight[round] : (uint64_t)(round - first) + 500000, &s);
    cage_scene view = space_view(&s);
    cage_limits_default(&limits, 3);
    limits.max_cells = round < first ? 648 : 100;
    limits.start_level = round % 3 - 1;
    limits.side = t->proofs % 3 == 0 ? CAGE_SIDE_INNER : CAGE_SIDE_BOTH;
    const question q = {&view, &s.start, space_goal(&s), &limits};
    prove_twice(&space, &q, t);
}

/* Objects with their images under half turns. */
static void ask_in_turn(int32_t round, struct tally *t)
{
    space_scene drawn, s;
    cage_limits limits;
    space_random((uint64_t)round + 600000, &drawn);
    space_double(&drawn, round % 4 + 1, &s);
    cage_scene view = space_view(&s);
    cage_limits_default(&limits, 3);
    limits.max_cells = 100;
    limits.start_level = round % 3 - 1;
    limits.side = t->proofs % 3 == 0 ? CAGE_SIDE_INNER : CAGE_SIDE_BOTH;
    const question q = {&view, &s.start, NULL, &limits};
    prove_twice(&space, &q, t);
}

static struct tally rebuild(void (*ask)(int32_t round, struct tally *t), int32_t wanted, const char *where)
{
    struct tally t = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    int32_t round = 0;
    memory = test_alloc(PLENTY);
    work = test_alloc(PLENTY);
    for (; t.proofs < wanted && round < 40 * wanted; round++)
        ask(round, &t);
    printf("rebuilt: in %s %ld separations in %d scenes, %ld of symmetric objects; %ld leaves, %ld entered; %ld pairs of neighbours, %ld of unequal level; "
           "%ld nodes, %ld reached, %ld of them outside; %ld edges\n", where, t.proofs, (int)round, t.turned, t.leaves, t.entered, t.pairs,
           t.uneven, t.nodes, t.reached, t.outside, t.edges);
    free(memory);
    free(work);
    ck_assert_int_ge((int)t.proofs, wanted);
    return t;
}

START_TEST(proofs_in_the_plane_hold_from_nothing)
{
    struct tally t = rebuild(ask_in_plane, test_rounds(150), "the plane");
    ck_assert_int_gt((int)t.uneven, 0);
    ck_assert_int_gt((int)t.outside, 0);
}
END_TEST

START_TEST(proofs_in_space_hold_from_nothing)
{
    struct tally t = rebuild(ask_in_space, test_rounds(20), "space");
    ck_assert_int_gt((int)t.uneven, 1000);
    ck_assert_int_gt((int)(t.leaves - t.entered), 300);
}
END_TEST

START_TEST(proofs_up_to_half_turns_hold_from_nothing)
{
    int32_t wanted = test_rounds(20);
    struct tally t = rebuild(ask_in_turn, wanted, "space, of symmetric objects,");
    ck_assert_int_ge((int)t.turned, wanted);
    ck_assert_msg(wanted < 20 || t.uneven > 100, "%ld pairs of unequal level", t.uneven);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("rebuild");
    TCase *tests = test_case(suite, "rebuild");
    tcase_add_test(tests, proofs_in_the_plane_hold_from_nothing);
    tcase_add_test(tests, proofs_in_space_hold_from_nothing);
    tcase_add_test(tests, proofs_up_to_half_turns_hold_from_nothing);
    return test_main(suite);
}
