/* test_rebuild.c: every separation that a search proved, proved again from nothing over its last cells. */
#include "support.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "arcs.h"
#include "proof.h"
#include "scenes.h"
#include "whole.h"

enum { PLENTY = 64 << 20, LEAVES = 256, NODES = 1 << 14 };

/* The inner graph of all leaves: nodes of leaf i are first[i] to first[i + 1] - 1. */
struct again {
    int32_t leaves, nodes;
    int32_t cell[LEAVES];
    int32_t first[LEAVES + 1];
    struct cage_slice slice[LEAVES];
    int32_t group[NODES]; /* union-find */
};

static unsigned char *memory, *work;
static struct again graph;

static void leaves_of(const struct cage_proof *proof)
{
    graph.leaves = 0;
    for (int32_t i = CAGE_CELL_ROOT; i < proof->graph.cells; i++)
        if (proof->graph.cell[i].child == 0) {
            test_require(graph.leaves < LEAVES);
            graph.cell[graph.leaves++] = i;
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

/* Slices of all leaves, with the turn that the cells themselves say. */
static void slices(struct cage_arena *arena, const struct cage_proof *proof)
{
    graph.nodes = 0;
    for (int32_t i = 0; i < graph.leaves; i++) {
        const struct cage_cell *cell = &proof->graph.cell[graph.cell[i]].cell;
        struct cage_rotations rotations;
        struct cage_slice *slice = &graph.slice[i], packed;
        size_t mark = arena->used;
        cage_so2.representative(cell, rotations.q);
        rotations.turn = cage_so2.turn(cell);
        ck_assert_int_eq(cage_slice_make(arena, &proof->side[CAGE_INNER], &rotations, slice), CAGE_OK);
        void *block = test_alloc(slice->bytes);
        cage_slice_pack(slice, block, &packed);
        *slice = packed;
        cage_arena_release(arena, mark);
        graph.first[i] = graph.nodes;
        for (int32_t k = 0; k < slice->regions; k++) {
            test_require(graph.nodes < NODES);
            graph.group[graph.nodes] = graph.nodes;
            graph.nodes++;
        }
    }
    graph.first[graph.leaves] = graph.nodes;
}

/* The block of a packed slice begins with its sites. */
static void slices_free(void)
{
    for (int32_t i = 0; i < graph.leaves; i++)
        free(graph.slice[i].t.site);
}

static int32_t glue_all(struct cage_arena *arena, const struct cage_proof *proof)
{
    int32_t gluings = 0;
    for (int32_t i = 0; i < graph.leaves; i++)
        for (int32_t j = 0; j < i; j++) {
            if (!arc_touch(&proof->graph.cell[graph.cell[i]].cell, &proof->graph.cell[graph.cell[j]].cell))
                continue;
            struct cage_touch *touch;
            int32_t count, mixed;
            size_t mark = arena->used;
            ck_assert_int_eq(cage_glue(arena, &graph.slice[i], &graph.slice[j], CAGE_ALL, &touch, &count, &mixed), CAGE_OK);
            for (int32_t e = 0; e < count; e++) {
                int32_t a = root_of(graph.first[i] + touch[e].k), b = root_of(graph.first[j] + touch[e].l);
                graph.group[a > b ? a : b] = a > b ? b : a;
            }
            cage_arena_release(arena, mark);
            gluings++;
        }
    return gluings;
}

/* Where the pivot is at the pose, x + R(q) pivot, exactly. */
static void exact_place(const cage_pose *pose, const int32_t pivot[3], mpq_t x[3])
{
    mpz_t w, z, n, t;
    mpz_inits(w, z, n, t, NULL);
    exact_set(w, pose->q[0]);
    exact_set(z, pose->q[3]);
    for (int k = 0; k < 2; k++) { /* (w^2 - z^2) p - 2 w z p' and 2 w z p' + (w^2 - z^2) p */
        mpz_mul(t, w, w);
        mpz_submul(t, z, z);
        mpz_mul_si(n, t, pivot[k]);
        mpz_mul(t, w, z);
        mpz_mul_si(t, t, 2 * (long)(k == 0 ? -pivot[1] : pivot[0]));
        mpz_add(n, n, t);
        mpz_set(mpq_numref(x[k]), n);
        mpz_mul(t, w, w);
        mpz_addmul(t, z, z);
        mpz_set(mpq_denref(x[k]), t);
        mpq_canonicalize(x[k]);
        mpz_mul_si(t, mpq_denref(x[k]), pose->x[k]);
        mpz_add(mpq_numref(x[k]), mpq_numref(x[k]), t);
    }
    mpq_set_si(x[2], 0, 1);
    mpz_clears(w, z, n, t, NULL);
}

/* Join all nodes that hold the exact pose, in every leaf that holds its rotation; one of them. */
static int32_t node_at(const struct cage_proof *proof, const cage_pose *pose)
{
    int32_t found = -1;
    const struct arc_rotation q = {pose->q[0], pose->q[3]};
    mpq_t x[3];
    mpq_inits(x[0], x[1], x[2], NULL);
    exact_place(pose, proof->result.pivot, x);
    for (int32_t i = 0; i < graph.leaves; i++) {
        if (!arc_holds(&proof->graph.cell[graph.cell[i]].cell, q))
            continue;
        int32_t label = whole_label_exact(&graph.slice[i].t, graph.slice[i].label, x);
        ck_assert_msg(label >= 0, "a free pose lies in an inner ball");
        int32_t node = root_of(graph.first[i] + label);
        ck_assert_msg(found < 0 || root_of(found) == node, "neighbours that share the pose are not glued there");
        found = node;
    }
    ck_assert_msg(found >= 0, "no leaf holds the rotation");
    mpq_clears(x[0], x[1], x[2], NULL);
    return found;
}

/* The leaves cover the circle: each leaf's last rotation is the first one of exactly one leaf. */
static void check_cover(const struct cage_proof *proof)
{
    for (int32_t i = 0; i < graph.leaves; i++) {
        int32_t next = 0;
        for (int32_t j = 0; j < graph.leaves; j++)
            next += arc_same(arc_end(&proof->graph.cell[graph.cell[i]].cell, 1), arc_end(&proof->graph.cell[graph.cell[j]].cell, 0));
        test_require(next == 1);
    }
}

static int32_t check_reached(const struct cage_proof *proof, int32_t from, bool goal, int32_t to)
{
    int32_t reached = 0;
    for (int32_t i = 0; i < graph.leaves; i++) {
        const struct cage_facts *facts = &proof->graph.cell[graph.cell[i]].facts[CAGE_INNER];
        for (int32_t k = 0; k < graph.slice[i].regions; k++) {
            bool mine = root_of(graph.first[i] + k) == root_of(from);
            bool theirs = k < facts->nodes && facts->node[k].seen == proof->reach[CAGE_INNER].number;
            ck_assert_msg(mine == theirs, "leaf %d component %d: %s", (int)i, (int)k, mine ? "not reached" : "reached for no reason");
            ck_assert_msg(!mine || goal || k != CAGE_OUTSIDE, "the outside is reached");
            reached += mine;
        }
        test_require(facts->nodes == 0 || facts->nodes == graph.slice[i].regions);
    }
    ck_assert_msg(!goal || root_of(from) != root_of(to), "the goal is reached");
    return reached;
}

/* Prove; then prove again. Counts into sum: proofs, leaves, gluings, nodes reached. */
static void prove_twice(const scene *s, long sum[4])
{
    cage_scene view = scene_view(s);
    cage_proof *proof;
    cage_limits limits;
    cage_limits_default(&limits, 2);
    limits.max_level = 8;
    limits.max_cells = 128;
    limits.start_level = (int32_t)(s->seed % 5) - 1; /* chosen by the library, or coarse: then refined */
    limits.side = sum[0] % 3 == 0 ? CAGE_SIDE_INNER : CAGE_SIDE_BOTH;
    if (cage_prove_begin(&proof, &view, &s->start, scene_goal(s), &limits, memory, PLENTY) != CAGE_OK)
        return;
    ck_assert_int_eq(cage_prove_run(proof, INT64_MAX), 1);
    int32_t verdict = cage_prove_result(proof)->verdict;
    if (verdict != CAGE_CAGED && verdict != CAGE_DISCONNECTED)
        return;
    struct cage_arena arena;
    cage_arena_init(&arena, work, PLENTY);
    leaves_of(proof);
    check_cover(proof);
    slices(&arena, proof);
    sum[2] += glue_all(&arena, proof);
    int32_t from = node_at(proof, &proof->pose[proof->origin]), to = from;
    if (verdict == CAGE_DISCONNECTED)
        to = node_at(proof, &proof->pose[1 - proof->origin]);
    sum[3] += check_reached(proof, from, verdict == CAGE_DISCONNECTED, to);
    sum[0]++;
    sum[1] += graph.leaves;
    slices_free();
}

START_TEST(proofs_hold_from_nothing)
{
    int32_t wanted = test_rounds(150), seed = 0;
    long sum[4] = {0, 0, 0, 0};
    memory = test_alloc(PLENTY);
    work = test_alloc(PLENTY);
    for (; sum[0] < wanted && seed < 40 * wanted; seed++) {
        scene s;
        scene_random((uint64_t)seed + 500000, &s);
        prove_twice(&s, sum);
    }
    printf("rebuilt: %ld separations in %d scenes, %ld leaves, %ld gluings, %ld nodes reached\n", sum[0], (int)seed, sum[1], sum[2],
           sum[3]);
    ck_assert_int_ge((int)sum[0], wanted);
    free(memory);
    free(work);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("rebuild");
    TCase *tests = test_case(suite, "rebuild");
    tcase_add_test(tests, proofs_hold_from_nothing);
    return test_main(suite);
}
