/* classes.c: the connected classes of atlases, asked pose by pose, against SuiteSparse's strongly connected components. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <btf.h>

#include "random.h"
#include "survey.h"

enum { ARMS = 3, OBSTACLES = 40, PLENTY = 64 << 20 };

/* An object that is the same after half a turn, its pivot in the middle: a pose of it is one of its pivot. */
typedef struct trial {
    cage_ball object[2 * ARMS], obstacle[OBSTACLES];
    cage_scene scene;
} trial;

static int failures;
static long graphs, nodes_seen, edges_seen, classes_seen, asked;

static void expect(int holds, int seed, const char *what)
{
    if (!holds) {
        failures++;
        printf("FAIL  scene %d: %s\n", seed, what);
    }
}

static int32_t within(uint64_t *rng, int32_t low, int32_t high)
{
    return low + (int32_t)(random_next(rng) % (uint64_t)(high - low + 1));
}

static void make_trial(uint64_t seed, int32_t dim, trial *t)
{
    uint64_t rng = seed;
    const int32_t wide = 300000;
    memset(t, 0, sizeof *t);
    for (int i = 0; i < ARMS; i++) {
        const cage_ball b = { within(&rng, -60000, 60000), within(&rng, -60000, 60000),
                              dim == 3 ? within(&rng, -60000, 60000) : 0, within(&rng, 15000, 30000) };
        const cage_ball other = { -b.x, -b.y, -b.z, b.r };
        t->object[2 * i] = b;
        t->object[2 * i + 1] = other;
    }
    for (int i = 0; i < OBSTACLES; i++) {
        const cage_ball b = { within(&rng, -wide, wide), within(&rng, -wide, wide), dim == 3 ? within(&rng, -wide, wide) : 0,
                              within(&rng, 20000, dim == 2 ? 40000 : 90000) };
        t->obstacle[i] = b;
    }
    const cage_scene scene = { { t->object, t->object, 2 * ARMS, 2 * ARMS },
                               { t->obstacle, t->obstacle, OBSTACLES, OBSTACLES }, dim };
    t->scene = scene;
}

/* The graph of one side as BTF takes it: column a has the nodes that edges of a lead to. node_of: the first of each cell. */
typedef struct matrix {
    int nodes, *node_of, *column, *row;
} matrix;

static void make_matrix(const struct cage_graph *graph, int side, matrix *m)
{
    size_t edges = 0;
    int at = 0;
    m->nodes = 0;
    m->node_of = calloc((size_t)graph->cells + 1, sizeof *m->node_of);
    for (int32_t cell = CAGE_CELL_ROOT; m->node_of != NULL && cell < graph->cells; cell++) {
        const struct cage_facts *facts = &graph->cell[cell].facts[side];
        m->node_of[cell] = m->nodes;
        if (graph->cell[cell].child)
            continue;
        m->nodes += facts->nodes;
        for (int32_t k = 0; k < facts->nodes; k++)
            for (const struct cage_edge *edge = facts->node[k].edges; edge; edge = edge->next)
                edges++;
    }
    m->column = calloc((size_t)m->nodes + 1, sizeof *m->column);
    m->row = calloc(edges + 1, sizeof *m->row);
    if (m->node_of == NULL || m->column == NULL || m->row == NULL)
        exit(2);
    for (int32_t cell = CAGE_CELL_ROOT; cell < graph->cells; cell++) {
        const struct cage_facts *facts = &graph->cell[cell].facts[side];
        for (int32_t k = 0; !graph->cell[cell].child && k < facts->nodes; k++) {
            for (const struct cage_edge *edge = facts->node[k].edges; edge; edge = edge->next)
                if (!graph->cell[edge->to->cell].child)
                    m->row[at++] = m->node_of[edge->to->cell] + edge->to->component;
            m->column[m->node_of[cell] + k + 1] = at;
        }
    }
    edges_seen += at;
}

/* BTF's component of each node; how many there are. */
static int components(const matrix *m, int *of)
{
    int *order = calloc((size_t)m->nodes + 1, sizeof *order), *block = calloc((size_t)m->nodes + 1, sizeof *block);
    int *work = calloc(4 * (size_t)m->nodes + 1, sizeof *work);
    if (order == NULL || block == NULL || work == NULL)
        exit(2);
    const int count = btf_strongcomp(m->nodes, m->column, m->row, NULL, order, block, work);
    for (int b = 0; b < count; b++)
        for (int k = block[b]; k < block[b + 1]; k++)
            of[order[k]] = b;
    free(order);
    free(block);
    free(work);
    return count;
}

/* A component of a leaf is asked for at its middle rotation, at a point in it: nodes are of one class exactly if BTF says so. */
static void compare(const struct cage_survey *survey, const cage_atlas *atlas, int side, int seed)
{
    const struct cage_graph *graph = &survey->proof->graph;
    matrix m;
    make_matrix(graph, side, &m);
    int *of = calloc((size_t)m.nodes + 1, sizeof *of), *class_of, *block_of;
    if (of == NULL)
        exit(2);
    const int count = components(&m, of);
    class_of = calloc((size_t)count + 1, sizeof *class_of);
    block_of = calloc((size_t)atlas->classes[side] + 1, sizeof *block_of);
    if (class_of == NULL || block_of == NULL)
        exit(2);
    memset(class_of, -1, ((size_t)count + 1) * sizeof *class_of);
    memset(block_of, -1, ((size_t)atlas->classes[side] + 1) * sizeof *block_of);
    expect(count == atlas->classes[side] && m.nodes == atlas->nodes[side], seed, "another number of classes or nodes");
    for (int32_t cell = CAGE_CELL_ROOT; cell < graph->cells; cell++)
        for (int32_t k = 0; !graph->cell[cell].child && k < graph->cell[cell].facts[side].nodes; k++) {
            const struct cage_extent *extent = &survey->sheet[side][cell].extent[k];
            const int b = of[m.node_of[cell] + k];
            cage_pose pose;
            if (!extent->known)
                continue;
            memcpy(pose.x, extent->at, sizeof pose.x);
            memcpy(pose.q, graph->cell[cell].rotations.q, sizeof pose.q);
            const int32_t class = cage_atlas_locate(atlas, &pose, side == CAGE_INNER ? CAGE_SIDE_INNER : CAGE_SIDE_OUTER);
            asked++;
            if (class < 0 || class >= atlas->classes[side]) {
                expect(0, seed, "a point of a component is in no class");
                continue;
            }
            expect(class_of[b] < 0 || class_of[b] == class, seed, "two classes for one of BTF's components");
            expect(block_of[class] < 0 || block_of[class] == b, seed, "one class for two of BTF's components");
            class_of[b] = class;
            block_of[class] = b;
        }
    graphs++;
    nodes_seen += m.nodes;
    classes_seen += count;
    free(of);
    free(class_of);
    free(block_of);
    free(m.node_of);
    free(m.column);
    free(m.row);
}

static void try_one(int seed, int32_t dim, int32_t level, void *block)
{
    trial t;
    cage_plan plan;
    cage_survey *survey;
    cage_atlas atlas;
    int32_t state;
    make_trial((uint64_t)seed, dim, &t);
    cage_plan_default(&plan);
    plan.side = CAGE_SIDE_BOTH;
    plan.level = level;
    plan.max_cells = seed % 2 ? 0 : dim == 2 ? 200 : 120; /* cells of unequal levels, or not */
    state = cage_survey_begin(&survey, &t.scene, &plan, block, PLENTY);
    while (state == 0)
        state = cage_survey_run(survey, 1000);
    expect(state == 1, seed, "no atlas");
    const size_t size = state == 1 ? cage_survey_atlas(survey, NULL, 0) : 0;
    void *bytes = malloc(size + 1);
    if (bytes == NULL)
        exit(2);
    if (size > 0 && cage_survey_atlas(survey, bytes, size) == size && cage_atlas_open(&atlas, bytes, size) == CAGE_OK) {
        expect(atlas.pivot[0] == 0 && atlas.pivot[1] == 0 && atlas.pivot[2] == 0, seed, "the pivot is not in the middle");
        compare(survey, &atlas, CAGE_INNER, seed);
        compare(survey, &atlas, CAGE_OUTER, seed);
    } else {
        expect(0, seed, "no atlas");
    }
    free(bytes);
}

int main(int argc, char **argv)
{
    const int scenes = argc > 1 ? atoi(argv[1]) : 60;
    void *block = malloc(PLENTY);
    if (block == NULL)
        return 2;
    for (int seed = 1; seed <= scenes; seed++)
        try_one(seed, 2, 2 + seed % 4, block);
    for (int seed = 1; seed <= (scenes + 9) / 10; seed++)
        try_one(seed, 3, 1, block);
    free(block);
    printf("      %ld graphs: %ld nodes, %ld edges, %ld classes as BTF has them; %ld poses asked\n", graphs, nodes_seen,
           edges_seen, classes_seen, asked);
    expect(graphs == 2 * (scenes + (scenes + 9) / 10) && classes_seen > 3 * graphs && asked > classes_seen, 0,
           "too little was compared");
    return failures != 0;
}
