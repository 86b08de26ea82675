/* test_atlas.c: atlases against truth by construction, single proofs, oracles and themselves; their bytes, whole and damaged. */
#include "support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "atlas.h"
#include "body.h"
#include "fibre.h"
#include "grid.h"
#include "oracle.h"
#include "oracle_space.h"
#include "referee.h"
#include "scenes.h"
#include "scenes_space.h"
#include "sealed.h"
#include "words.h"

#define PLENTY ((size_t)256 << 20)

static unsigned char *block; /* PLENTY bytes, never cleared: an atlas must not depend on what is in them */
static unsigned char *spare;

static void blocks_make(void)
{
    block = test_alloc(PLENTY);
    spare = test_alloc(PLENTY);
}

static void blocks_drop(void)
{
    free(block);
    free(spare);
}

static bool quick(void) { return getenv("CAGE_TEST_QUICK") != NULL; }

/* An atlas in a block of just its size. */
struct made {
    unsigned char *byte;
    size_t size;
    cage_atlas atlas;
    cage_survey_result result;
};

static void make(const cage_scene *view, const cage_plan *plan, struct made *out)
{
    cage_survey *survey;
    ck_assert_int_eq(cage_survey_begin(&survey, view, plan, block, PLENTY), CAGE_OK);
    ck_assert_int_eq(cage_survey_run(survey, INT64_MAX), 1);
    out->result = *cage_survey_result_of(survey);
    out->size = cage_survey_atlas(survey, NULL, 0);
    ck_assert_uint_eq(out->size, out->result.atlas_bytes);
    out->byte = test_alloc(out->size);
    ck_assert_uint_eq(cage_survey_atlas(survey, out->byte, out->size), out->size);
    ck_assert_int_eq(cage_atlas_open(&out->atlas, out->byte, out->size), CAGE_OK);
    ck_assert(out->atlas.dim == view->dim && out->atlas.side == plan->side && out->atlas.leaves == out->result.leaves);
    ck_assert(out->atlas.note[0] == plan->note[0] && out->atlas.note[1] == plan->note[1]);
    for (int side = 0; side < 2; side++)
        ck_assert_int_eq(out->atlas.classes[side], out->result.classes[side]);
}

static void make_at(const cage_scene *view, int32_t level, int32_t max_cells, struct made *out)
{
    cage_plan plan;
    cage_plan_default(&plan);
    plan.level = level;
    plan.max_cells = max_cells;
    make(view, &plan, out);
    ck_assert(max_cells == 0 || out->result.cells <= max_cells);
}

static void drop(struct made *m) { free(m->byte); }

/* ---- truth by construction ------------------------------------------------------------------------------ */

static cage_pose pose_at(int32_t x, int32_t y, int32_t z)
{
    const cage_pose pose = {{x, y, z}, {1, 0, 0, 0}};
    return pose;
}

static void expect(const struct made *m, const cage_pose *start, const cage_pose *goal, int32_t verdict, const char *what)
{
    int32_t said = cage_atlas_ask(&m->atlas, start, goal);
    ck_assert_msg(said == verdict, "%s: %s, not %s", what, said < 0 ? cage_error_text(said) : cage_verdict_text(said),
                  cage_verdict_text(verdict));
}

/* A disc between four others, at distances of `away` from it: out it goes if they are farther apart than its diameter. What
 * counts as a gap may be wrong by what rounding costs (see grid.h), 2 units a side inside and 8 outside. */
START_TEST(four_fingers)
{
    for (int32_t r = 50; r <= 500000; r *= 10)
        for (int32_t level = 0; level <= 2; level++) {
            int32_t closed = 0, open = 0;
            while (2 * (int64_t)(closed + 1) * (closed + 1) <= 4 * (int64_t)(2 * r - 2) * (2 * r - 2))
                closed += 1 + r / 1000; /* sqrt 2 away <= 2 (2 r - 2) */
            closed -= 1 + r / 1000;
            open = (int32_t)((2.0 * r + 8) * sqrt(2.0)) + 2;
            for (int32_t out = 0; out <= 1; out++) {
                int32_t away = out ? open : closed;
                const cage_ball disc = {0, 0, 0, r};
                const cage_ball finger[4] = {{away, 0, 0, r}, {-away, 0, 0, r}, {0, away, 0, r}, {0, -away, 0, r}};
                const cage_scene view = {{&disc, &disc, 1, 1}, {finger, finger, 4, 4}, 2};
                const cage_pose middle = pose_at(0, 0, 0), beyond = pose_at(10 * r, 3 * r, 0), inside = pose_at(away, 1, 0);
                struct made m;
                make_at(&view, level, 0, &m);
                expect(&m, &middle, NULL, out ? CAGE_FREE : CAGE_CAGED, "four fingers");
                expect(&m, &middle, &beyond, out ? CAGE_CONNECTED : CAGE_DISCONNECTED, "four fingers, to beyond");
                expect(&m, &beyond, &middle, out ? CAGE_CONNECTED : CAGE_DISCONNECTED, "four fingers, from beyond");
                expect(&m, &beyond, NULL, CAGE_FREE, "beyond four fingers");
                expect(&m, &inside, NULL, CAGE_IN_COLLISION, "in a finger");
                expect(&m, &middle, &inside, CAGE_IN_COLLISION, "to a finger");
                for (int side = 0; side < 2; side++)
                    ck_assert_int_eq(m.atlas.classes[side], out ? 1 : 2);
                drop(&m);
            }
        }
}
END_TEST

/* A ball and one obstacle: a slice is one closed ball, of the sum of their radii, less 2 inside and 8 more outside (see
 * grid.h). */
START_TEST(balls_are_closed)
{
    for (int32_t round = 0; round < 20; round++) {
        int32_t dim = 2 + round % 2, sign = round / 2 % 2 ? 1 : -1, r = 50, change = cage_radius_change(0, sign);
        int32_t user = sign < 0 ? CAGE_SIDE_INNER : CAGE_SIDE_OUTER;
        for (int32_t i = 0; i < round / 4; i++)
            r *= 10;
        const int32_t part[3] = {3 * r / 5, 4 * r / 5, 0};
        const cage_ball guest = {0, 0, 0, 20}, ball = {1000, -7, dim == 3 ? 11 : 0, r - 20 - change};
        const cage_scene view = {{&guest, &guest, 1, 1}, {&ball, &ball, 1, 1}, dim};
        struct made m;
        make_at(&view, round / 4 % 2, 0, &m);
        ck_assert_int_eq(change, sign < 0 ? -2 : 8);
        for (int32_t k = 0; k < 4 * dim; k++)
            for (int32_t beyond = 0; beyond <= 1; beyond++) {
                cage_pose pose = {{ball.x, ball.y, ball.z}, {1 + k % 3, 0, 0, k % 3}};
                int32_t end = k % 2 ? 1 : -1, axis = k / 2 % dim;
                if (k < 2 * dim)
                    pose.x[axis] += end * (r + beyond);
                else {
                    pose.x[axis] += end * (part[0] + beyond);
                    pose.x[(axis + 1) % dim] -= part[1];
                }
                ck_assert_int_eq(cage_atlas_locate(&m.atlas, &pose, user), beyond ? 0 : CAGE_NO_CLASS);
            }
        drop(&m);
    }
}
END_TEST

/* A ball far from the origin of its frame, beside another along an axis, or about as near to two: a unit nearer than in contact it
 * collides. */
START_TEST(far_from_the_frame)
{
    uint64_t state = 23;
    int32_t hits = 0, rounds = 0;
    for (int32_t round = 0; round < (quick() ? 8 : 40); round++) {
        int32_t dim = 2 + round % 2, far = (dim == 2 ? CAGE_REACH_2D : CAGE_REACH_3D) / 20 * 13, sum = 5000;
        const cage_ball guest = {round & 2 ? far : -far, round & 4 ? far : -far, dim == 2 ? 0 : far / 3, 1000};
        const cage_ball ball[3] = {{17, -5, 0, 4000}, {17 + 2 * sum, -5, 0, 4000}, {17, 2 * sum - 5, 0, 4000}};
        const cage_scene view = {{&guest, &guest, 1, 1}, {ball, ball, 3, 3}, dim};
        const int32_t from[3] = {guest.x, guest.y, guest.z}, to[3] = {ball[0].x, ball[0].y, ball[0].z};
        struct made m;
        make_at(&view, 0, 0, &m);
        for (int32_t k = 0; k < 500; k++) {
            cage_pose pose = {{0, 0, 0}, {0, 0, 0, 0}};
            int32_t moved[3], axis = (int32_t)test_between(&state, 0, dim - 1);
            for (int32_t i = 0; i < 4; i++) /* |q|^2 above 2^31, so that bits are cut off */
                pose.q[i] = dim == 2 && (i == 1 || i == 2)
                                ? 0
                                : (int32_t)test_between(&state, 46350 / dim, 100000 / dim) * (k >> i & 1 ? 1 : -1);
            cage_pose_pivot(&pose, from, moved);
            for (int32_t i = 0; i < dim; i++)
                pose.x[i] = to[i] - moved[i];
            pose.x[axis] += (sum - (int32_t)test_between(&state, -2, 3)) * (k & 16 ? 1 : -1);
            bool hit = cage_collides(&view, &pose, CAGE_SIDE_INNER) == 1;
            ck_assert_int_eq(cage_atlas_ask(&m.atlas, &pose, NULL) == CAGE_IN_COLLISION, hit);
            hits += hit;
            rounds++;
        }
        drop(&m);
    }
    ck_assert(hits > rounds / 4 && hits < rounds / 8 * 7);
}
END_TEST

/* Points of a grid of pitch 1000 from 0 to size[k] that are on the faces of the block, or on the wall across its middle. */
static int32_t rooms(int32_t dim, const int32_t size[3], int32_t r, cage_ball *ball)
{
    int32_t count = 0;
    for (int32_t x = 0; x <= size[0]; x++)
        for (int32_t y = 0; y <= size[1]; y++)
            for (int32_t z = 0; z <= (dim == 3 ? size[2] : 0); z++)
                if (2 * x % size[0] == 0 || y % size[1] == 0 || (dim == 3 && z % size[2] == 0)) {
                    const cage_ball made = {1000 * x, 1000 * y, 1000 * z, r};
                    ball[count++] = made;
                }
    return count;
}

/* Two rooms side by side with walls of balls, and a ball far too large to get through between them. Without the ball in the
 * middle of the wall the rooms are one. */
START_TEST(two_rooms)
{
    enum { MOST = 200 };
    int32_t dim = 2 + _i;
    const int32_t size[3] = {dim == 2 ? 8 : 4, dim == 2 ? 4 : 2, 2};
    const cage_ball guest = {0, 0, 0, dim == 2 ? 200 : 300};
    cage_ball wall[MOST];
    int32_t count = rooms(dim, size, 450, wall), z = dim == 3 ? 1000 : 0, middle_y = 500 * size[1];
    const int32_t centre[2] = {250 * size[0], 750 * size[0]};
    const cage_pose one = pose_at(centre[0], middle_y, z), two = pose_at(centre[1], middle_y, z), out = pose_at(-5000, 20, z);
    cage_pose turned = two;
    turned.q[3] = 1; /* a border of cells */
    for (int32_t door = 0; door <= 1; door++) {
        for (int32_t i = 0; i < count && door; i++)
            if (2 * wall[i].x == 1000 * size[0] && wall[i].y == middle_y && wall[i].z == z)
                wall[i] = wall[--count];
        const cage_scene view = {{&guest, &guest, 1, 1}, {wall, wall, count, count}, dim};
        struct made m;
        make_at(&view, 1, 0, &m);
        expect(&m, &one, NULL, CAGE_CAGED, "a room");
        expect(&m, &two, NULL, CAGE_CAGED, "the other room");
        expect(&m, &turned, NULL, CAGE_CAGED, "the other room, turned");
        expect(&m, &out, NULL, CAGE_FREE, "beyond the rooms");
        expect(&m, &one, &two, door ? CAGE_CONNECTED : CAGE_DISCONNECTED, "from room to room");
        expect(&m, &two, &one, door ? CAGE_CONNECTED : CAGE_DISCONNECTED, "and back");
        expect(&m, &turned, &two, CAGE_CONNECTED, "turned in its room");
        expect(&m, &out, &two, CAGE_DISCONNECTED, "into a room");
        for (int side = 0; side < 2; side++)
            ck_assert_int_eq(m.atlas.classes[side], door ? 2 : 3);
        drop(&m);
    }
}
END_TEST

/* Two balls on a bar without a middle, in a ring with gaps just too small for one of them. Cells of a few degrees prove it;
 * in coarse ones they are not there, but room for the bar is: the sides disagree, and cutting cells decides. */
START_TEST(cutting_decides)
{
    enum { BALLS = 16, RADIUS = 2000 };
    const cage_ball bar[2] = {{-400, 0, 0, 100}, {400, 0, 0, 100}};
    cage_ball ring[BALLS];
    int64_t widest = 0;
    for (int32_t i = 0; i < BALLS; i++) {
        double angle = 2 * acos(-1.0) * i / BALLS;
        const cage_ball made = {(int32_t)lround(RADIUS * cos(angle)), (int32_t)lround(RADIUS * sin(angle)), 0, 305};
        ring[i] = made;
    }
    for (int32_t i = 0; i < BALLS; i++) {
        int64_t dx = ring[i].x - ring[(i + 1) % BALLS].x, dy = ring[i].y - ring[(i + 1) % BALLS].y;
        widest = dx * dx + dy * dy > widest ? dx * dx + dy * dy : widest;
    }
    ck_assert(widest < 4 * (305 + 100) * (305 + 100)); /* each ball of the bar stays inside */
    const cage_scene view = {{bar, bar, 2, 2}, {ring, ring, BALLS, BALLS}, 2};
    const cage_pose inside = pose_at(0, 0, 0), turned = {{100, 50, 0}, {1, 0, 0, 1}}, out = pose_at(9000, 0, 0);
    struct made m;
    int32_t budgets[4] = {14, 40, 600, 1200};
    for (int32_t i = 0; i < 4; i++) {
        make_at(&view, 2, i == 0 ? 0 : budgets[i], &m);
        ck_assert_int_le(m.result.cells, budgets[i]);
        bool decides = i >= 2;
        expect(&m, &inside, NULL, decides ? CAGE_CAGED : CAGE_UNDEFINED, "a bar in a ring");
        expect(&m, &inside, &out, decides ? CAGE_DISCONNECTED : CAGE_UNDEFINED, "a bar in a ring, to beyond");
        expect(&m, &inside, &turned, CAGE_CONNECTED, "a bar turns in a ring");
        expect(&m, &out, NULL, CAGE_FREE, "a bar beyond a ring");
        drop(&m);
    }
}
END_TEST

/* ---- an atlas as words ---------------------------------------------------------------------------------- */

static uint32_t word(const struct made *m, uint32_t at)
{
    test_require(at < m->size / 4);
    const unsigned char *b = m->byte + 4 * (size_t)at;
    return b[0] + 256u * b[1] + 65536u * b[2] + 16777216u * b[3];
}

static uint32_t side_word(const struct made *m, int side, uint32_t at)
{
    return word(m, CAGE_ATLAS_SIDE + (uint32_t)side * CAGE_SIDE_WORDS + at);
}

static const struct cage_fibre *fibre_of(const struct made *m) { return m->atlas.dim == 2 ? &cage_so2 : &cage_so3; }

/* The cells of the leaves, in their order; free them. */
static struct cage_cell *leaf_cells(const struct made *m)
{
    const struct cage_fibre *fibre = fibre_of(m);
    uint32_t first = word(m, CAGE_ATLAS_CELL), count = word(m, CAGE_ATLAS_CELL + 1), leaves = 0;
    struct cage_cell *cell = test_alloc(count * sizeof *cell), *leaf = test_alloc(count * sizeof *leaf);
    for (int32_t i = 0; i < fibre->roots; i++) {
        const struct cage_cell root = {0, i, {0, 0, 0}};
        cell[i] = root;
    }
    for (uint32_t i = 0; i < count; i++) {
        uint32_t entry = word(m, first + i);
        for (int32_t k = 0; k < fibre->children && !(entry & 1); k++)
            cage_cell_child(&cell[i], k, &cell[(entry >> 1) + (uint32_t)k]);
        if (entry & 1)
            leaf[entry >> 1] = cell[i];
        leaves += entry & 1;
    }
    test_require(leaves == (uint32_t)m->atlas.leaves && leaves == word(m, CAGE_ATLAS_LEAVES));
    free(cell);
    return leaf;
}

static uint32_t first_node(const struct made *m, int side, int32_t leaf)
{
    return word(m, side_word(m, side, CAGE_SIDE_LEAF) + 2 * (uint32_t)leaf + 1);
}

static bool has_edge(const struct made *m, int side, uint32_t from, uint32_t to)
{
    uint32_t row = side_word(m, side, CAGE_SIDE_ROW), list = side_word(m, side, CAGE_SIDE_TO), found = 0;
    for (uint32_t i = word(m, row + from); i < word(m, row + from + 1); i++)
        found += word(m, list + i) == to;
    test_require(found <= 1);
    return found == 1;
}

/* The class of every node by a flood, numbered in the order of first nodes; how many. */
static int32_t flood(const struct made *m, int side, int32_t *class)
{
    uint32_t row = side_word(m, side, CAGE_SIDE_ROW), to = side_word(m, side, CAGE_SIDE_TO);
    uint32_t nodes = (uint32_t)m->atlas.nodes[side];
    uint32_t *stack = test_alloc((nodes + 1) * sizeof *stack), depth = 0;
    int32_t classes = 0;
    for (uint32_t n = 0; n < nodes; n++)
        class[n] = -1;
    for (uint32_t n = 0; n < nodes; n++) {
        if (class[n] >= 0)
            continue;
        class[n] = classes++;
        stack[depth++] = n;
        while (depth > 0) {
            uint32_t at = stack[--depth];
            for (uint32_t i = word(m, row + at); i < word(m, row + at + 1); i++) {
                uint32_t next = word(m, to + i);
                if (class[next] < 0) {
                    class[next] = class[n];
                    stack[depth++] = next;
                }
            }
        }
    }
    free(stack);
    return classes;
}

/* Rows hold each edge twice, once from either end, between nodes of touching cells; outsides of these are joined. */
static int64_t check_edges(const struct made *m, int side, const struct cage_cell *leaf)
{
    uint32_t row = side_word(m, side, CAGE_SIDE_ROW), to = side_word(m, side, CAGE_SIDE_TO);
    uint32_t nodes = (uint32_t)m->atlas.nodes[side];
    int32_t leaves = m->atlas.leaves, *leaf_of = test_alloc(nodes * sizeof *leaf_of);
    int64_t edges = 0;
    for (int32_t i = 0; i < leaves; i++) {
        uint32_t end = i + 1 < leaves ? first_node(m, side, i + 1) : nodes;
        test_require(first_node(m, side, i) < end && (i > 0 || first_node(m, side, i) == 0));
        for (uint32_t n = first_node(m, side, i); n < end; n++)
            leaf_of[n] = i;
    }
    test_require(word(m, row) == 0 && word(m, row + nodes) == side_word(m, side, CAGE_SIDE_EDGES));
    for (uint32_t n = 0; n < nodes; n++)
        for (uint32_t i = word(m, row + n); i < word(m, row + n + 1); i++, edges++) {
            uint32_t other = word(m, to + i);
            test_require(leaf_of[n] != leaf_of[other] && fibre_of(m)->touch(&leaf[leaf_of[n]], &leaf[leaf_of[other]]));
            test_require(has_edge(m, side, n, other) && has_edge(m, side, other, n));
        }
    for (int32_t i = 0; i < leaves; i++)
        for (int32_t k = 0; k < i; k++)
            test_require(!fibre_of(m)->touch(&leaf[i], &leaf[k]) ||
                         has_edge(m, side, first_node(m, side, i), first_node(m, side, k)));
    free(leaf_of);
    return edges;
}

/* What cage_atlas_class says of a class, from the nodes. */
static void check_class(const struct made *m, int side, const int32_t *class, int32_t number)
{
    cage_class c;
    int32_t nodes = 0, cells = 0, user = side == 0 ? CAGE_SIDE_INNER : CAGE_SIDE_OUTER;
    ck_assert_int_eq(cage_atlas_class(&m->atlas, user, number, &c), CAGE_OK);
    for (int32_t i = 0; i < m->atlas.leaves; i++) {
        uint32_t end = i + 1 < m->atlas.leaves ? first_node(m, side, i + 1) : (uint32_t)m->atlas.nodes[side];
        bool here = false;
        for (uint32_t n = first_node(m, side, i); n < end; n++) {
            nodes += class[n] == number;
            here = here || class[n] == number;
        }
        cells += here;
    }
    test_require(c.nodes == nodes && c.cells == cells && nodes > 0);
    for (int k = 0; k < 3; k++)
        test_require(number == 0 ? c.low[k] == 0 && c.high[k] == 0 : c.low[k] <= c.high[k]);
    test_require(m->atlas.dim == 3 || (c.low[2] == 0 && c.high[2] == 0));
    test_require(number > 0 || c.known);
    if (!c.known)
        return;
    int32_t pivot[3], turned[3];
    cage_pose pose = c.pose;
    for (uint32_t k = 0; k < 3; k++) {
        pivot[k] = (int32_t)word(m, CAGE_ATLAS_PIVOT + k);
        pose.x[k] = 0;
    }
    cage_pose_pivot(&pose, pivot, turned); /* to the user's frame, where its pivot is at the same grid point again */
    for (int k = 0; k < 3; k++)
        pose.x[k] = c.pose.x[k] - turned[k];
    ck_assert_int_eq(cage_atlas_locate(&m->atlas, &pose, user), number);
}

/* The graph, its classes, and the table of these. */
static int64_t check_classes(const struct made *m)
{
    struct cage_cell *leaf = leaf_cells(m);
    int64_t edges = 0;
    for (int side = 0; side < 2; side++) {
        if (!(m->atlas.side >> side & 1))
            continue;
        int32_t *class = test_alloc((size_t)m->atlas.nodes[side] * sizeof *class);
        edges += check_edges(m, side, leaf);
        test_require(flood(m, side, class) == m->atlas.classes[side]);
        for (int32_t n = 0; n < m->atlas.nodes[side]; n++)
            test_require(word(m, side_word(m, side, CAGE_SIDE_CLASS) + (uint32_t)n) == (uint32_t)class[n]);
        for (int32_t i = 0; i < m->atlas.leaves; i++)
            test_require(class[first_node(m, side, i)] == 0);
        for (int32_t i = 0; i < m->atlas.classes[side]; i++)
            check_class(m, side, class, i);
        free(class);
    }
    free(leaf);
    return edges;
}

/* The obstacles are all there, by x in rising order, and the largest radius is told. */
static void check_obstacles(const struct made *m, const cage_scene *view)
{
    uint32_t at = word(m, CAGE_ATLAS_OBSTACLE), dim = (uint32_t)view->dim;
    int32_t count = view->obstacles.inner_count, largest = 0, last = INT32_MIN;
    bool *used = test_alloc((size_t)count * sizeof *used);
    memset(used, 0, (size_t)count * sizeof *used);
    test_require(word(m, CAGE_ATLAS_OBSTACLE + 1) == (uint32_t)count);
    for (int32_t i = 0; i < count; i++, at += dim + 1) {
        const cage_ball ball = {(int32_t)word(m, at), (int32_t)word(m, at + 1), dim == 3 ? (int32_t)word(m, at + 2) : 0,
                                (int32_t)word(m, at + dim)};
        int32_t j = 0;
        while (j < count && (used[j] || memcmp(&view->obstacles.inner[j], &ball, sizeof ball)))
            j++;
        test_require(j < count && ball.x >= last);
        used[j] = true;
        last = ball.x;
        largest = ball.r > largest ? ball.r : largest;
    }
    test_require(word(m, CAGE_ATLAS_LARGEST) == (uint32_t)largest);
    free(used);
}

/* ---- poses ---------------------------------------------------------------------------------------------- */

/* An atlas in question, with what draws poses. */
struct asked {
    const cage_scene *view;
    const struct made *m;
    const struct cage_cell *leaf;
    uint64_t state;
    cage_pose ends[2]; /* poses that the scene is about */
};

static int32_t draw(struct asked *a, int64_t low, int64_t high) { return (int32_t)test_between(&a->state, low, high); }

/* The end of a leaf or of a cell of any level, a quarter turn, or any rotation. */
static void draw_rotation(struct asked *a, int32_t q[4])
{
    static const int32_t quarter[8][4] = {{1, 0, 0, 0}, {1, 0, 0, 1}, {0, 0, 0, 1}, {-1, 0, 0, 1},
                                          {1, 1, 1, 1}, {0, 1, 1, 0}, {1, 0, -1, 0}, {0, 1, 0, 0}};
    const struct cage_fibre *fibre = fibre_of(a->m);
    int32_t kind = draw(a, 0, 4), dim = a->view->dim;
    struct cage_cell cell = a->leaf[draw(a, 0, a->m->atlas.leaves - 1)];
    if (kind == 0)
        memcpy(q, quarter[draw(a, 0, dim == 2 ? 3 : 7)], sizeof quarter[0]);
    if (kind == 1 || kind == 2) {
        for (int32_t i = kind == 1 ? 0 : draw(a, 0, 6); i > 0; i--) {
            struct cage_cell child;
            cage_cell_child(&cell, draw(a, 0, fibre->children - 1), &child);
            cell = child;
        }
        if (dim == 3) {
            int32_t corner[8][4];
            fibre->corners(&cell, corner);
            memcpy(q, corner[draw(a, 0, 7)], sizeof corner[0]);
        } else { /* the cell that begins where this one ends, or one that ends where it begins */
            int32_t next = (cell.face << cell.level) + cell.at[0] + (draw(a, 0, 1) ? 1 : -1), around = 2 << cell.level;
            next = (next + around) % around;
            const struct cage_cell other = {cell.level, next >> cell.level, {next & ((1 << cell.level) - 1), 0, 0}};
            fibre->common(&cell, &other, q);
        }
    }
    for (int k = 0; k < 4 && kind > 2; k++)
        q[k] = dim == 3 || k % 3 == 0 ? draw(a, -40, 40) : 0;
    if (kind > 2 && q[0] == 0 && q[1] == 0 && q[2] == 0)
        q[0] = 1;
    for (int k = 0; k < 4 && draw(a, 0, 3) == 0; k++)
        q[k] = -q[k]; /* at times, and perhaps not all */
}

/* Somewhere between the obstacles. */
static void draw_place(struct asked *a, int32_t x[3])
{
    const cage_shape *o = &a->view->obstacles;
    for (int k = 0; k < 3; k++)
        x[k] = 0;
    for (int i = 0; i < 2 && o->outer_count > 0; i++) {
        const cage_ball *b = &o->outer[draw(a, 0, o->outer_count - 1)];
        x[0] += b->x / 2 + draw(a, -b->r, b->r);
        x[1] += b->y / 2 + draw(a, -b->r, b->r);
        x[2] += a->view->dim == 3 ? b->z / 2 + draw(a, -b->r, b->r) : 0;
    }
}

/* A ball of the object beside an obstacle, some units more or less than in contact. */
static void touch(struct asked *a, cage_pose *pose)
{
    const cage_shape *o = &a->view->object, *w = &a->view->obstacles;
    if (o->inner_count == 0 || w->inner_count == 0)
        return;
    const cage_ball *y = &o->inner[draw(a, 0, o->inner_count - 1)], *x = &w->inner[draw(a, 0, w->inner_count - 1)];
    const int32_t centre[3] = {y->x, y->y, y->z}, at[3] = {x->x, x->y, x->z};
    int32_t moved[3], axis = draw(a, 0, a->view->dim - 1), away = x->r + y->r + draw(a, -3, 3);
    int32_t to[3] = {0, 0, 0};
    to[axis] = draw(a, 0, 1) ? away : -away;
    if (draw(a, 0, 1)) { /* 3 4 5 */
        to[axis] = to[axis] / 5 * 3;
        to[(axis + 1) % a->view->dim] = away / 5 * 4;
    }
    for (int k = 0; k < 3; k++)
        pose->x[k] = 0;
    cage_pose_pivot(pose, centre, moved);
    for (int k = 0; k < 3; k++)
        pose->x[k] = at[k] + to[k] - moved[k];
}

static void draw_pose(struct asked *a, cage_pose *pose)
{
    int32_t kind = draw(a, 0, 5), dim = a->view->dim;
    *pose = a->ends[draw(a, 0, 1)];
    if (kind == 0)
        return;
    if (kind < 3)
        draw_rotation(a, pose->q);
    if (kind == 2)
        for (int k = 0; k < dim; k++)
            pose->x[k] += draw(a, -300, 300);
    if (kind < 3)
        return;
    draw_rotation(a, pose->q);
    draw_place(a, pose->x);
    if (kind == 5)
        touch(a, pose);
}

/* ---- what may be said of a pose ------------------------------------------------------------------------- */

static struct {
    int64_t poses, borders, pairs, collisions, decided, proofs, agreed, judged, path_poses, edges;
} seen;

/* The class of each pose on each side, and whether it collides. */
struct spot {
    cage_pose pose;
    int32_t class[2];
    int32_t hit;
    int32_t verdict;
};

/* The pose alone with its pivot at a grid point: in the leaf whose middle it has, its class there. */
static int32_t class_in(const struct asked *a, int32_t leaf, const int32_t at[3], int side)
{
    const struct cage_fibre *fibre = fibre_of(a->m);
    cage_pose pose = {{0, 0, 0}, {0, 0, 0, 0}};
    int32_t pivot[3], turned[3];
    fibre->representative(&a->leaf[leaf], pose.q);
    for (uint32_t k = 0; k < 3; k++)
        pivot[k] = (int32_t)word(a->m, CAGE_ATLAS_PIVOT + k);
    cage_pose_pivot(&pose, pivot, turned);
    for (int k = 0; k < 3; k++)
        pose.x[k] = at[k] - turned[k];
    return cage_atlas_locate(&a->m->atlas, &pose, side == 0 ? CAGE_SIDE_INNER : CAGE_SIDE_OUTER);
}

/* The class of a pose from the classes that it would have in the middles of the cells that hold it, where only one cell is asked:
 * on the inner side covered if in any, on the outer if in all; all others are one class, as they share the pose. */
static void check_place(struct asked *a, const struct spot *s)
{
    int32_t at[3], pivot[3], holding = 0;
    for (uint32_t k = 0; k < 3; k++)
        pivot[k] = (int32_t)word(a->m, CAGE_ATLAS_PIVOT + k);
    cage_pose_pivot(&s->pose, pivot, at);
    for (int side = 0; side < 2; side++) {
        int32_t class = CAGE_NO_CLASS, covered = 0;
        if (!(a->m->atlas.side >> side & 1))
            continue;
        holding = 0;
        for (int32_t i = 0; i < a->m->atlas.leaves; i++) {
            if (!fibre_of(a->m)->contains(&a->leaf[i], s->pose.q))
                continue;
            int32_t here = class_in(a, i, at, side);
            holding++;
            covered += here == CAGE_NO_CLASS;
            test_require(here == CAGE_NO_CLASS || (here >= 0 && here < a->m->atlas.classes[side]));
            test_require(here == CAGE_NO_CLASS || class == CAGE_NO_CLASS || here == class);
            class = here == CAGE_NO_CLASS ? class : here;
        }
        test_require(holding > 0);
        test_require(s->class[side] == (side == 0 && covered > 0 ? CAGE_NO_CLASS : class));
        if (s->class[side] > 0) {
            cage_class c;
            test_require(cage_atlas_class(&a->m->atlas, side == 0 ? CAGE_SIDE_INNER : CAGE_SIDE_OUTER, class, &c) == CAGE_OK);
            for (int k = 0; k < 3; k++)
                test_require(c.low[k] <= at[k] && at[k] <= c.high[k]);
        }
    }
    seen.borders += holding > 1;
}

/* What follows from the classes alone. */
static int32_t verdict_of(const cage_atlas *atlas, const struct spot *s, const struct spot *t, bool goal)
{
    bool apart = (atlas->side & CAGE_SIDE_INNER) && s->class[0] != t->class[0];
    bool joined = (atlas->side & CAGE_SIDE_OUTER) && s->class[1] != CAGE_NO_CLASS && s->class[1] == t->class[1];
    test_require(!apart || !joined);
    if (s->hit || t->hit)
        return CAGE_IN_COLLISION;
    return apart ? (goal ? CAGE_DISCONNECTED : CAGE_CAGED) : !joined ? CAGE_UNDEFINED : goal ? CAGE_CONNECTED : CAGE_FREE;
}

static void look(struct asked *a, struct spot *s)
{
    static const struct spot outside;
    const cage_atlas *atlas = &a->m->atlas;
    s->hit = cage_collides(a->view, &s->pose, CAGE_SIDE_INNER);
    test_require(s->hit >= 0);
    s->verdict = cage_atlas_ask(atlas, &s->pose, NULL);
    test_require((s->verdict == CAGE_IN_COLLISION) == (s->hit == 1));
    for (int side = 0; side < 2; side++) {
        s->class[side] = CAGE_NO_CLASS;
        if (atlas->side >> side & 1)
            s->class[side] = cage_atlas_locate(atlas, &s->pose, side == 0 ? CAGE_SIDE_INNER : CAGE_SIDE_OUTER);
    }
    test_require(s->class[0] != CAGE_NO_CLASS || s->hit || !(atlas->side & CAGE_SIDE_INNER));
    test_require(s->class[1] == CAGE_NO_CLASS || cage_collides(a->view, &s->pose, CAGE_SIDE_OUTER) == 0);
    if (!s->hit)
        test_require(s->verdict == verdict_of(atlas, s, &outside, false));
    check_place(a, s);
    seen.poses++;
    seen.collisions += s->hit;
    seen.decided += referee_decided(s->verdict);
}

static void look_at_pair(struct asked *a, const struct spot *s, const struct spot *t)
{
    int32_t there = cage_atlas_ask(&a->m->atlas, &s->pose, &t->pose), back = cage_atlas_ask(&a->m->atlas, &t->pose, &s->pose);
    test_require(there == back);
    test_require(s->hit || t->hit ? there == CAGE_IN_COLLISION : there == verdict_of(&a->m->atlas, s, t, true));
    seen.pairs++;
}

/* Poses on a path out are free to go; where that is told from a pose half a unit beside it, collisions are left out. */
static void look_at_path(struct asked *a, const cage_result *r)
{
    int32_t reach = a->view->dim == 2 ? CAGE_REACH_2D : CAGE_REACH_3D;
    for (int32_t i = 0; i < r->path_count; i += 1 + r->path_count / 8) {
        struct spot s;
        int32_t turned[3];
        bool near = true;
        s.pose = r->path[i];
        for (int k = 0; k < 3; k++)
            s.pose.x[k] = 0;
        cage_pose_pivot(&s.pose, r->pivot, turned);
        for (int k = 0; k < 3; k++) {
            near = near && llabs((int64_t)r->path[i].x[k]) + llabs((int64_t)turned[k]) < reach;
            s.pose.x[k] = near ? r->path[i].x[k] - turned[k] : 0;
        }
        if (!near)
            continue;
        look(a, &s);
        test_require(s.verdict != CAGE_CAGED);
        seen.path_poses++;
    }
}

static const cage_limits *light(int32_t dim, cage_limits *limits)
{
    cage_limits_default(limits, dim);
    limits->max_level = dim == 2 ? 6 : 2;
    limits->max_cells = dim == 2 ? 40 : 150;
    return limits;
}

static void compare_with_proof(struct asked *a, const struct spot *s, const struct spot *goal)
{
    cage_limits limits;
    cage_result r;
    const question q = {a->view, &s->pose, goal ? &goal->pose : NULL, light(a->view->dim, &limits)};
    int32_t said = goal ? cage_atlas_ask(&a->m->atlas, &s->pose, &goal->pose) : s->verdict;
    ck_assert_int_eq(referee_prove(&q, 0, spare, PLENTY, &r), CAGE_OK);
    const char *wrong = referee_contradiction(said, r.verdict);
    ck_assert_msg(!wrong, "atlas and proof: %s", wrong);
    test_require((said == CAGE_IN_COLLISION) == (r.verdict == CAGE_IN_COLLISION));
    seen.proofs++;
    seen.agreed += referee_decided(said) && said == r.verdict;
    if (!goal && r.verdict == CAGE_FREE)
        look_at_path(a, &r);
}

static void compare_with_oracle(struct asked *a, const struct spot *s, const struct spot *goal)
{
    static const space_effort little = {200000, 8, 60};
    int32_t said = goal ? cage_atlas_ask(&a->m->atlas, &s->pose, &goal->pose) : s->verdict, truth;
    const cage_pose *to = goal ? &goal->pose : NULL;
    if (a->view->dim == 2)
        truth = oracle_decide(a->view, &s->pose, to, 48);
    else {
        const space_question q = {a->view, &s->pose, to, 0, 0};
        const char *how;
        truth = oracle_space_decide(&q, &little, NULL, &how);
    }
    const char *wrong = referee_contradiction(said, truth);
    ck_assert_msg(!wrong, "atlas and oracle: %s", wrong);
    seen.judged += referee_decided(truth) && referee_decided(said);
}

/* All of it: the graph, so many poses and pairs, some of them against single proofs, and against the oracle. */
static void check_all(const cage_scene *view, const struct made *m, const cage_pose *start, const cage_pose *goal, uint64_t seed,
                      int32_t poses, int32_t proofs, int32_t judged)
{
    struct asked a = {view, m, leaf_cells(m), seed, {*start, *(goal ? goal : start)}};
    struct spot before, s;
    seen.edges += check_classes(m);
    check_obstacles(m, view);
    s.pose = *start;
    look(&a, &s);
    for (int32_t i = 0; i < poses; i++) {
        before = s;
        draw_pose(&a, &s.pose);
        if (i == 0 && goal)
            s.pose = *goal;
        look(&a, &s);
        look_at_pair(&a, &before, &s);
        if (i < proofs)
            compare_with_proof(&a, i % 2 ? &s : &before, i % 2 ? &before : NULL);
        if (i < judged)
            compare_with_oracle(&a, i % 2 ? &s : &before, i % 2 ? &before : NULL);
    }
    free((void *)(uintptr_t)a.leaf);
}

static void report(const char *what, int32_t rounds)
{
    printf("atlas: %s: %d atlases, %lld poses, %lld on borders, %lld collide, %lld decided; %lld pairs; %lld proofs, %lld alike; "
           "%lld poses of paths; %lld judged by an oracle; %lld edges\n", what, (int)rounds, (long long)seen.poses,
           (long long)seen.borders, (long long)seen.collisions, (long long)seen.decided, (long long)seen.pairs,
           (long long)seen.proofs, (long long)seen.agreed, (long long)seen.path_poses, (long long)seen.judged,
           (long long)seen.edges);
}

/* At least one pose in so many is on a border, in collision, decided. */
static bool saw_all(int32_t of)
{
    return of * seen.borders > seen.poses && of * seen.collisions > seen.poses && of * seen.decided > seen.poses;
}

/* Inner balls smaller, some of the object's missing; few balls, or none. */
static void vary(uint64_t seed, scene *s, scene *thin, cage_scene *view)
{
    if (seed % 5 == 1) {
        s->object_count = (int32_t)(seed % 3);
        s->obstacle_count = s->obstacle_count < 5 ? s->obstacle_count : (int32_t)(seed % 6);
    }
    *view = scene_view(s);
    *thin = *s;
    if (seed % 5 != 2)
        return;
    for (int32_t j = 0; j < thin->obstacle_count; j++)
        thin->obstacles[j].r -= thin->obstacles[j].r / (j % 2 ? 8 : 32);
    view->obstacles.inner = thin->obstacles;
    view->object.inner_count = view->object.inner_count > 1 ? view->object.inner_count - 1 : view->object.inner_count;
}

/* Every level from 0 to 3 and that of its own choice, one side now and then. */
START_TEST(plane_scenes)
{
    int32_t rounds = test_rounds(220);
    memset(&seen, 0, sizeof seen);
    for (int32_t seed = 0; seed < rounds; seed++) {
        scene s, thin;
        cage_scene view;
        struct made m;
        int32_t side = seed % 11 == 5 ? CAGE_SIDE_INNER : seed % 11 == 6 ? CAGE_SIDE_OUTER : CAGE_SIDE_BOTH;
        const cage_plan plan = {side, seed % 20 == 7 ? -1 : seed % 4, 0, {seed, -seed}};
        scene_random((uint64_t)seed + 800000, &s);
        vary((uint64_t)seed, &s, &thin, &view);
        make(&view, &plan, &m);
        ck_assert_int_eq(m.result.leaves, 2 << (plan.level < 0 ? m.result.level : plan.level));
        check_all(&view, &m, &s.start, scene_goal(&s), (uint64_t)seed, 50, 6, 2);
        drop(&m);
    }
    report("the plane", rounds);
    ck_assert(rounds < 200 || saw_all(10));
}
END_TEST

START_TEST(space_scenes)
{
    int32_t rounds = test_rounds(30);
    memset(&seen, 0, sizeof seen);
    for (int32_t seed = 0; seed < rounds; seed++) {
        space_scene s;
        struct made m;
        space_random((uint64_t)seed + 800000, &s);
        s.object_count = s.object_count < 4 ? s.object_count : 4;
        s.obstacle_count = s.obstacle_count < 24 ? s.obstacle_count : 24;
        cage_scene view = space_view(&s);
        make_at(&view, 1, 0, &m);
        ck_assert_int_eq(m.result.leaves, 32);
        check_all(&view, &m, &s.start, space_goal(&s), (uint64_t)seed, 50, 2, 1);
        drop(&m);
    }
    report("space", rounds);
    ck_assert(rounds < 30 || saw_all(20));
}
END_TEST

/* Cells of several levels side by side. */
START_TEST(cut_cells)
{
    int32_t rounds = test_rounds(40), cut = 0;
    memset(&seen, 0, sizeof seen);
    for (int32_t seed = 0; seed < rounds; seed++) {
        scene s;
        struct made m;
        scene_random((uint64_t)seed + 850000, &s);
        cage_scene view = scene_view(&s);
        int32_t most = 14 + 8 * (seed % 5);
        make_at(&view, 2, most, &m);
        cut += m.result.cells > 14;
        ck_assert(m.result.cells <= most && m.result.leaves >= 8 && m.result.cells == 2 * m.result.leaves - 2);
        check_all(&view, &m, &s.start, scene_goal(&s), (uint64_t)seed, 50, 4, 2);
        drop(&m);
    }
    report("cut cells", rounds);
    printf("atlas: %d of %d had cells cut\n", (int)cut, (int)rounds);
    ck_assert(cut > 0);
}
END_TEST

/* ---- the bytes ------------------------------------------------------------------------------------------ */

enum { CANARY = 64 };

static const cage_ball small_object[2] = {{-40, 3, 0, 30}, {50, 0, 0, 40}};
static const cage_ball small_obstacle[6] = {{400, 0, 0, 300}, {-400, 20, 0, 310}, {0, 420, 0, 290}, {10, -430, 0, 280},
                                            {900, 900, 0, 100}, {800, -900, 0, 150}};
static const cage_scene small_scene = {{small_object, small_object, 2, 2}, {small_obstacle, small_obstacle, 6, 6}, 2};

static void small_plan(int32_t max_cells, cage_plan *plan)
{
    cage_plan_default(plan);
    plan->level = 1;
    plan->max_cells = max_cells;
    plan->note[0] = 7;
    plan->note[1] = INT32_MIN;
}

/* Surveys in exactly so many bytes, between canaries, in a block full of junk: the error or the right atlas. */
static int32_t survey_in(const cage_plan *plan, size_t bytes, size_t offset, int64_t portion, const struct made *right,
                         uint64_t *needed)
{
    unsigned char *memory = test_alloc(offset + bytes + 2 * CANARY), *at = memory + CANARY + offset;
    cage_survey *survey = NULL;
    memset(memory, 0x5a, offset + bytes + 2 * CANARY);
    int32_t error = cage_survey_begin(&survey, &small_scene, plan, at, bytes);
    test_require(error == CAGE_OK || (error == CAGE_ERROR_MEMORY && !survey && bytes < cage_survey_size(&small_scene, plan)));
    *needed = 0;
    int64_t steps = 0;
    while (error == CAGE_OK && survey) {
        error = cage_survey_run(survey, portion);
        steps += portion;
        const cage_survey_result *r = cage_survey_result_of(survey);
        test_require(portion == INT64_MAX || r->steps <= steps);
        test_require(error == 1 || (r->atlas_bytes == 0 && cage_survey_atlas(survey, NULL, 0) == 0));
        *needed = r->needed_bytes;
    }
    if (error == 1) {
        unsigned char *out = test_alloc(right->size + 3);
        const cage_survey_result *r = cage_survey_result_of(survey);
        test_require(r->peak_bytes <= bytes && r->steps == right->result.steps && *needed == 0);
        memset(out, 0x77, right->size + 3);
        test_require(cage_survey_atlas(survey, out + 1, right->size - 1) == right->size);
        test_require(out[1] == 0x77 && out[right->size] == 0x77);
        test_require(cage_survey_atlas(survey, out + 1, right->size + 1) == right->size);
        test_require(memcmp(out + 1, right->byte, right->size) == 0 && out[0] == 0x77 && out[right->size + 1] == 0x77);
        free(out);
    } else
        test_require(error == CAGE_ERROR_MEMORY && (!survey || *needed > bytes));
    for (size_t i = 0; i < CANARY; i++)
        test_require(memory[i] == 0x5a && at[bytes + i] == 0x5a);
    free(memory);
    return error;
}

START_TEST(blocks_and_portions)
{
    cage_plan plan;
    struct made right;
    uint64_t needed;
    size_t enough = 0, failed = 0, begun = 0;
    small_plan(_i * 40, &plan);
    make(&small_scene, &plan, &right);
    size_t least = cage_survey_size(&small_scene, &plan);
    ck_assert_uint_gt(least, 0);
    for (size_t offset = 0; offset < 8; offset++) /* a block of that size is enough to begin */
        (void)survey_in(&plan, least, offset, 1, &right, &needed);
    for (int64_t portion = 1; portion <= 1000; portion = 3 * portion + 1)
        ck_assert_int_eq(survey_in(&plan, (size_t)4 << 20, 0, portion, &right, &needed), 1);
    size_t step = quick() ? 30000 : 1500;
    for (size_t bytes = 0; enough < 30; bytes += step + bytes % 13) {
        int32_t error = survey_in(&plan, bytes, bytes % 9, INT64_MAX, &right, &needed);
        enough += error == 1;
        failed += error < 0;
        begun += error < 0 && needed > 0;
    }
    ck_assert(failed > 0 && begun > 0);
    for (size_t bytes = 0; bytes < least; bytes += least / 20 + 1) { /* what is needed leads to a block that will do */
        size_t next = bytes;
        int32_t error = 0, tries = 0;
        while (error != 1) {
            error = survey_in(&plan, next, 0, INT64_MAX, &right, &needed);
            next = needed > 0 ? (size_t)needed : least > next ? least : next;
            test_require(++tries < 20);
        }
    }
    drop(&right);
}
END_TEST

/* Many obstacles and next to no object: the block of that size is enough to begin, at any alignment. */
START_TEST(size_is_enough)
{
    enum { MANY = 17000 };
    static cage_ball ball[MANY];
    for (int32_t i = 0; i < MANY; i++) {
        const cage_ball made = {20 * (i % 130), 20 * (i / 130), 0, 1};
        ball[i] = made;
    }
    for (int32_t objects = 0; objects <= 2; objects++)
        for (int32_t dim = 2; dim <= 3; dim++) {
            const cage_scene view = {{ball, ball, objects / 2, (objects + 1) / 2}, {ball, ball, MANY, objects == 1 ? 5 : MANY},
                                     dim};
            cage_plan plan;
            cage_survey *survey;
            cage_plan_default(&plan);
            size_t size = cage_survey_size(&view, &plan);
            for (size_t offset = 0; offset < 8; offset++)
                ck_assert_int_eq(cage_survey_begin(&survey, &view, &plan, block + offset, size), CAGE_OK);
        }
    /* Bytes that say that all of these are the object too would make one question take for ever. */
    const cage_scene view = {{ball, ball, 1, 1}, {ball, ball, MANY, MANY}, 2};
    cage_plan plan = {CAGE_SIDE_INNER, 0, 0, {0, 0}};
    struct made m;
    cage_atlas atlas;
    make(&view, &plan, &m);
    sealed_put(m.byte, CAGE_ATLAS_OBJECT, word(&m, CAGE_ATLAS_OBSTACLE));
    sealed_put(m.byte, CAGE_ATLAS_OBJECT + 1, MANY);
    sealed_sum(m.byte, m.size);
    ck_assert_int_eq(cage_atlas_open(&atlas, m.byte, m.size), CAGE_ERROR_ATLAS);
    sealed_put(m.byte, CAGE_ATLAS_OBJECT + 1, 2);
    sealed_sum(m.byte, m.size);
    ck_assert_int_eq(cage_atlas_open(&atlas, m.byte, m.size), CAGE_OK);
    drop(&m);
}
END_TEST

/* A damaged copy, in a block of its own so that a read beyond is seen. */
static int32_t open_copy(const unsigned char *byte, size_t size)
{
    unsigned char *copy = test_alloc(size);
    cage_atlas atlas;
    memcpy(copy, byte, size);
    int32_t error = cage_atlas_open(&atlas, copy, size);
    free(copy);
    return error;
}

START_TEST(damage_is_noticed)
{
    static const unsigned char flip[5] = {1, 0x80, 0xff, 0x10, 0x5a};
    cage_plan plan;
    struct made m;
    small_plan(0, &plan);
    make(&small_scene, &plan, &m);
    unsigned char *copy = test_alloc(m.size + 64);
    memcpy(copy, m.byte, m.size);
    memset(copy + m.size, 0, 64);
    ck_assert_int_eq(open_copy(copy, m.size), CAGE_OK);
    for (size_t i = 0; i < m.size; i += quick() ? 7 : 1)
        for (int k = 0; k < 5; k++) {
            cage_atlas atlas;
            copy[i] ^= flip[k];
            test_require(cage_atlas_open(&atlas, copy, m.size) == CAGE_ERROR_ATLAS);
            copy[i] ^= flip[k];
        }
    for (size_t size = 0; size < m.size; size += quick() && size > 200 ? 7 : 1)
        test_require(open_copy(copy, size) == CAGE_ERROR_ATLAS);
    for (size_t more = 1; more <= 64; more++)
        test_require(open_copy(copy, m.size + more) == CAGE_ERROR_ATLAS);
    for (size_t i = 0; i + 8 <= m.size; i += 4) { /* words in another order */
        unsigned char saved[8];
        memcpy(saved, copy + i, 8);
        memcpy(copy + i, saved + 4, 4);
        memcpy(copy + i + 4, saved, 4);
        test_require(open_copy(copy, m.size) == (memcmp(saved, saved + 4, 4) == 0 ? CAGE_OK : CAGE_ERROR_ATLAS));
        memcpy(copy + i, saved, 8);
    }
    free(copy);
    drop(&m);
}
END_TEST

/* The sum as its definition has it, bit by bit: polynomial 0x42F0E1EBA9EA3693 reflected. */
static uint64_t sum_of(const unsigned char *byte, size_t count)
{
    uint64_t sum = ~(uint64_t)0;
    for (size_t i = 0; i < count; i++) {
        sum ^= byte[i];
        for (int bit = 0; bit < 8; bit++)
            sum = sum >> 1 ^ (sum & 1 ? UINT64_C(0xC96C5795D7870F42) : 0);
    }
    return ~sum;
}

START_TEST(the_sum)
{
    static const unsigned char digits[9] = "12345678";
    unsigned char text[64];
    uint64_t state = 5;
    memcpy(text, digits, 8);
    text[8] = '9';
    ck_assert(cage_words_sum(0, text, 9) == UINT64_C(0x995DC9BBDF1939FA)); /* the check value of CRC-64/XZ */
    ck_assert(cage_words_sum(0, text, 0) == 0);
    for (size_t size = 0; size <= sizeof text; size++) {
        for (size_t i = 0; i < size; i++)
            text[i] = (unsigned char)random_next(&state);
        test_require(cage_words_sum(0, text, size) == sum_of(text, size));
        test_require(cage_words_sum(cage_words_sum(0, text, size / 3), text + size / 3, size - size / 3) == sum_of(text, size));
    }
}
END_TEST

/* At any address, read only. */
START_TEST(any_address)
{
    cage_plan plan;
    struct made m;
    small_plan(0, &plan);
    make(&small_scene, &plan, &m);
    const cage_pose middle = pose_at(0, 0, 0), out = pose_at(3000, 10, 0);
    int32_t caged = cage_atlas_ask(&m.atlas, &middle, NULL), apart = cage_atlas_ask(&m.atlas, &out, &middle);
    unsigned char *copy = test_alloc(m.size + 8), *again = test_alloc(m.size + 8);
    for (size_t offset = 0; offset < 8; offset++) {
        cage_atlas atlas;
        cage_class a, b;
        memcpy(copy + offset, m.byte, m.size);
        memcpy(again, copy, m.size + offset);
        const unsigned char *const bytes = copy + offset;
        ck_assert_int_eq(cage_atlas_open(&atlas, bytes, m.size), CAGE_OK);
        ck_assert_int_eq(cage_atlas_ask(&atlas, &middle, NULL), caged);
        ck_assert_int_eq(cage_atlas_ask(&atlas, &out, &middle), apart);
        for (int32_t i = 0; i < atlas.classes[0]; i++) {
            ck_assert_int_eq(cage_atlas_class(&atlas, CAGE_SIDE_INNER, i, &a), CAGE_OK);
            ck_assert_int_eq(cage_atlas_class(&m.atlas, CAGE_SIDE_INNER, i, &b), CAGE_OK);
            ck_assert(memcmp(&a, &b, sizeof a) == 0);
        }
        ck_assert(memcmp(copy, again, m.size + offset) == 0);
    }
    free(copy);
    free(again);
    drop(&m);
}
END_TEST

/* ---- damage that the sum does not show ------------------------------------------------------------------ */

static bool is_answer(int32_t verdict) { return verdict < 0 || (verdict >= CAGE_UNDEFINED && verdict <= CAGE_IN_COLLISION); }

/* Anything may be said, nothing may go wrong. */
static void see(void *context, const cage_atlas_box *box)
{
    for (int k = 0; k < 3; k++)
        test_require(box->low[k] <= box->high[k]);
    ++*(int64_t *)context;
}

static void ask_anything(const cage_atlas *atlas, uint64_t *state)
{
    for (int i = 0; i < 12; i++) {
        cage_pose pose[2];
        for (int end = 0; end < 2; end++) {
            int64_t far_out = i % 4 == 3 ? CAGE_REACH_3D : 700, most = i < 6 ? 1 : 90;
            for (int k = 0; k < 3; k++)
                pose[end].x[k] = k < atlas->dim ? (int32_t)test_between(state, -far_out, far_out) : 0;
            for (int k = 0; k < 4; k++)
                pose[end].q[k] = atlas->dim == 3 || k % 3 == 0 ? (int32_t)test_between(state, -most, most) : 0;
            pose[end].q[0] += pose[end].q[3] == 0;
        }
        test_require(is_answer(cage_atlas_ask(atlas, &pose[0], i % 2 ? &pose[1] : NULL)));
        (void)cage_atlas_locate(atlas, &pose[0], i % 3 ? CAGE_SIDE_INNER : CAGE_SIDE_OUTER);
    }
    for (int32_t side = CAGE_SIDE_INNER; side <= CAGE_SIDE_OUTER; side++)
        for (int32_t i = -1; i < 6; i++) {
            cage_class c;
            int32_t error = cage_atlas_class(atlas, side, i, &c);
            test_require(error == CAGE_OK || error == CAGE_ERROR_ARGUMENT);
            int32_t cell = (int32_t)test_between(state, 0, atlas->leaves), q[4], corner[8][4];
            int64_t met = 0, told = cage_atlas_boxes(atlas, side, cell, i, (int32_t)test_between(state, 0, 4), see, &met);
            test_require(told == met || told == CAGE_ERROR_ARGUMENT || told == CAGE_ERROR_ATLAS);
            (void)cage_atlas_cell(atlas, cell, q, corner);
        }
}

/* A few words at random, one by one or in a row, mostly of the head and of what it points to, become others: small, large, near
 * what they were. */
static void damage(const struct made *m, unsigned char *byte, uint64_t *state)
{
    int32_t changes = (int32_t)test_between(state, 1, 6);
    for (int32_t i = 0; i < changes; i++) {
        size_t words = m->size / 4, at = (size_t)test_between(state, 0, (int64_t)words - 1);
        int32_t where = (int32_t)test_between(state, 0, 4), side = (int32_t)test_between(state, 0, 1);
        if (where == 0)
            at = (size_t)test_between(state, CAGE_ATLAS_DIM, CAGE_ATLAS_HEAD - 1);
        if (where == 1) /* a class */
            at = side_word(m, side, CAGE_SIDE_TABLE) +
                 (size_t)test_between(state, 0, CAGE_CLASS_WORDS * m->atlas.classes[side] - 1);
        if (where == 2) /* cells, balls */
            at = CAGE_ATLAS_HEAD + (size_t)test_between(state, 0, 4 * m->atlas.leaves + 20);
        if (where == 3) /* the head of a chart */
            at = word(m, side_word(m, side, CAGE_SIDE_LEAF)) + (size_t)test_between(state, 0, 40);
        for (int64_t run = test_between(state, 0, 2) ? 1 : test_between(state, 1, 4); run > 0 && at < words; run--, at++) {
            uint32_t was = word(m, (uint32_t)at);
            const uint32_t values[8] = {was + 1, was - 1, was ^ 1u << test_between(state, 0, 31), (uint32_t)random_next(state),
                                        (uint32_t)test_between(state, 0, (int64_t)words), 0x7fffffff, 0x80000000, UINT32_MAX};
            sealed_put(byte, at, values[test_between(state, 0, 7)]);
        }
    }
}

START_TEST(hidden_damage_is_harmless)
{
    static const cage_ball part[2] = {{-40, 3, 9, 30}, {50, 0, -20, 40}};
    static const cage_ball round_it[6] = {{400, 0, 0, 300}, {-400, 20, 0, 310}, {0, 420, 0, 290},
                                          {10, -430, 0, 280}, {0, 0, 400, 300}, {0, 0, -400, 300}};
    static const cage_scene in_space = {{part, part, 2, 2}, {round_it, round_it, 6, 6}, 3};
    struct made m;
    int32_t rounds = test_rounds(_i == 0 ? 30000 : 10000), opened = 0;
    uint64_t state = 11;
    make_at(_i == 0 ? &small_scene : &in_space, _i == 0 ? 1 : 0, 0, &m);
    for (int32_t i = 0; i < rounds; i++) {
        unsigned char *byte = test_alloc(m.size);
        cage_atlas atlas;
        memcpy(byte, m.byte, m.size);
        damage(&m, byte, &state);
        sealed_sum(byte, m.size);
        int32_t error = cage_atlas_open(&atlas, byte, m.size);
        test_require(error == CAGE_OK || error == CAGE_ERROR_ATLAS);
        opened += error == CAGE_OK;
        if (error == CAGE_OK)
            ask_anything(&atlas, &state);
        free(byte);
    }
    printf("atlas: %d of %d damaged atlases opened\n", (int)opened, (int)rounds);
    ck_assert(opened > rounds / 10 && opened < rounds);
    drop(&m);
}
END_TEST

/* ---- errors --------------------------------------------------------------------------------------------- */

START_TEST(wrong_questions)
{
    struct made m;
    cage_plan plan = {CAGE_SIDE_INNER, 0, 0, {0, 0}}, bad = plan;
    cage_survey *survey = NULL;
    cage_class c;
    cage_atlas atlas;
    const cage_pose pose = pose_at(0, 0, 0), hit = pose_at(400, 0, 0);
    cage_pose wrong = pose;
    make(&small_scene, &plan, &m);
    ck_assert_int_eq(cage_atlas_locate(&m.atlas, &pose, CAGE_SIDE_OUTER), CAGE_ERROR_ARGUMENT);
    ck_assert_int_eq(cage_atlas_locate(&m.atlas, &pose, CAGE_SIDE_BOTH), CAGE_ERROR_ARGUMENT);
    ck_assert_int_eq(cage_atlas_class(&m.atlas, CAGE_SIDE_OUTER, 0, &c), CAGE_ERROR_ARGUMENT);
    ck_assert_int_eq(cage_atlas_class(&m.atlas, CAGE_SIDE_INNER, m.atlas.classes[0], &c), CAGE_ERROR_ARGUMENT);
    ck_assert_int_eq(cage_atlas_class(&m.atlas, CAGE_SIDE_INNER, -1, &c), CAGE_ERROR_ARGUMENT);
    ck_assert_int_eq(cage_atlas_ask(&m.atlas, NULL, NULL), CAGE_ERROR_ARGUMENT);
    ck_assert_int_eq(cage_atlas_ask(NULL, &pose, NULL), CAGE_ERROR_ARGUMENT);
    wrong.q[0] = 0;
    ck_assert_int_eq(cage_atlas_ask(&m.atlas, &wrong, NULL), CAGE_ERROR_ROTATION);
    ck_assert_int_eq(cage_atlas_ask(&m.atlas, &pose, &wrong), CAGE_ERROR_ROTATION);
    ck_assert_int_eq(cage_atlas_ask(&m.atlas, &hit, &wrong), CAGE_ERROR_ROTATION); /* as cage_prove_begin has it */
    wrong = pose_at(CAGE_REACH_2D + 1, 0, 0);
    ck_assert_int_eq(cage_atlas_ask(&m.atlas, &wrong, NULL), CAGE_ERROR_RANGE);
    wrong = pose_at(0, 0, 1);
    ck_assert_int_eq(cage_atlas_locate(&m.atlas, &wrong, CAGE_SIDE_INNER), CAGE_ERROR_DIMENSION);
    ck_assert_int_eq(cage_atlas_open(NULL, m.byte, m.size), CAGE_ERROR_ARGUMENT);
    ck_assert_int_eq(cage_atlas_open(&atlas, NULL, 0), CAGE_ERROR_ARGUMENT);
    for (int32_t i = 0; i < 7; i++) {
        bad = plan;
        bad.side = i == 0 ? 0 : i == 1 ? 4 : plan.side;
        bad.level = i == 2 ? -2 : i == 3 ? CAGE_LEVEL_MAX_2D + 1 : i == 4 ? 3 : plan.level;
        bad.max_cells = i == 4 ? 29 : i == 5 ? -1 : i == 6 ? (1 << 24) + 1 : 0; /* down to level 3 there are 30 */
        ck_assert_int_eq(cage_survey_begin(&survey, &small_scene, &bad, block, PLENTY), CAGE_ERROR_ARGUMENT);
        ck_assert_ptr_null(survey);
        ck_assert_uint_eq(cage_survey_size(&small_scene, &bad), 0);
    }
    drop(&m);
}
END_TEST

static TCase *blocks_case(Suite *suite, const char *name)
{
    TCase *tests = test_case(suite, name);
    tcase_add_unchecked_fixture(tests, blocks_make, blocks_drop);
    return tests;
}

int main(void)
{
    Suite *suite = suite_create("atlas");
    TCase *truth = blocks_case(suite, "truth"), *scenes = blocks_case(suite, "scenes"), *bytes = blocks_case(suite, "bytes");
    TCase *harm = blocks_case(suite, "damage");
    tcase_add_test(truth, four_fingers);
    tcase_add_test(truth, balls_are_closed);
    tcase_add_test(truth, far_from_the_frame);
    tcase_add_loop_test(truth, two_rooms, 0, 2);
    tcase_add_test(truth, cutting_decides);
    tcase_add_test(scenes, plane_scenes);
    tcase_add_test(scenes, space_scenes);
    tcase_add_test(scenes, cut_cells);
    tcase_add_loop_test(bytes, blocks_and_portions, 0, 2);
    tcase_add_test(bytes, size_is_enough);
    tcase_add_test(bytes, the_sum);
    tcase_add_test(bytes, any_address);
    tcase_add_test(bytes, wrong_questions);
    tcase_add_test(harm, damage_is_noticed);
    tcase_add_loop_test(harm, hidden_damage_is_harmless, 0, 2);
    return test_main(suite);
}
