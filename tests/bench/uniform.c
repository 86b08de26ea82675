/* uniform.c: builds and glues every slice of one level of space, as a whole proof over uniform cells would. */
#include <stdio.h>

#include "../../src/graph.h"
#include "bench.h"
#include "sets.h"

enum { OBSTACLES = 108, OBJECTS = 21 };

/* The slices that were made last are held. One that is needed after it was dropped is made again, for that one gluing. Facts
 * (components, edges) are kept. */
struct uniform {
    struct cage_arena facts, scratch;
    struct cage_store store;
    struct cage_graph graph;
    struct bench_space space;
    int32_t slices, again, gluings, mixtures, components, touches;
    double making, gluing; /* seconds */
};

static void begin(struct uniform *u, unsigned char *block, double fill)
{
    const size_t facts = (size_t)64 << 20, held = (size_t)48 << 20;
    memset(u, 0, sizeof *u);
    cage_arena_init(&u->facts, block, facts);
    cage_store_init(&u->store, block + facts, held);
    cage_arena_init(&u->scratch, block + facts + held, BENCH_ROOM - facts - held);
    bench_space_make(&u->facts, OBSTACLES, OBJECTS, fill, &u->space);
    u->graph.fibre = &cage_so3;
    u->graph.turns = 1;
    u->graph.arena = &u->facts;
    u->graph.capacity = CAGE_CELL_ROOT + 4 * (1 + 8 + 64 + 512);
    u->graph.cells = CAGE_CELL_ROOT;
    u->graph.cell = cage_arena_take(&u->facts, (size_t)u->graph.capacity, sizeof *u->graph.cell);
    if (!u->graph.cell)
        bench_die("no memory");
    memset(u->graph.cell, 0, CAGE_CELL_ROOT * sizeof *u->graph.cell);
    if (!cage_graph_init(&u->graph, BENCH_SPACE_LEVEL))
        bench_die("no room for the cells");
}

static void make(struct uniform *u, int32_t cell, struct cage_slice *slice)
{
    double start = bench_now();
    bench_space_slice(&u->scratch, &u->space.side, &u->graph.cell[cell].cell, slice);
    u->making += bench_now() - start;
}

static void glue(struct uniform *u, int32_t a, int32_t b)
{
    const struct cage_held *c = u->graph.cell[a].facts[CAGE_INNER].held, *d = u->graph.cell[b].facts[CAGE_INNER].held;
    size_t mark = u->scratch.used;
    struct cage_slice again;
    struct cage_touch *touch;
    int32_t count, mixed;
    if (!d)
        make(u, b, &again);
    u->again += !d;
    double start = bench_now();
    if (cage_glue(&u->scratch, &c->slice, d ? &d->slice : &again, CAGE_ALL, &touch, &count, &mixed) != CAGE_OK ||
        cage_graph_add_gluing(&u->graph, CAGE_INNER, a, b, CAGE_ALL, touch, count) != CAGE_OK)
        bench_die("gluing failed");
    u->gluing += bench_now() - start;
    cage_arena_release(&u->scratch, mark);
    u->gluings++;
    u->mixtures += mixed;
    u->touches += count;
}

/* Make the cell's slice and glue it with those neighbours whose slices were made before. */
static void add(struct uniform *u, int32_t cell)
{
    struct cage_slice slice;
    make(u, cell, &slice);
    if (cage_graph_add_nodes(&u->graph, CAGE_INNER, cell, slice.regions) != CAGE_OK ||
        !cage_store_put(&u->store, &slice, &u->graph.cell[cell].facts[CAGE_INNER].held))
        bench_die("no memory for a slice");
    cage_arena_release(&u->scratch, 0);
    u->slices++;
    u->components += slice.regions;
    for (int32_t next = -1; (next = cage_graph_neighbour(&u->graph, cell, next)) >= 0;)
        if (u->graph.cell[next].facts[CAGE_INNER].nodes > 0)
            glue(u, cell, next);
}

/* Layer by layer of each face: only the last layer is needed again, and at the seams other faces. */
static void add_all(struct uniform *u)
{
    enum { WIDTH = 1 << BENCH_SPACE_LEVEL };
    static int32_t leaf[4][WIDTH][WIDTH][WIDTH];
    for (int32_t i = CAGE_CELL_ROOT; i < u->graph.cells; i++) {
        const struct cage_cell *cell = &u->graph.cell[i].cell;
        if (!u->graph.cell[i].child)
            leaf[cell->face][cell->at[0]][cell->at[1]][cell->at[2]] = i;
    }
    for (int32_t n = 0; n < 4 * WIDTH * WIDTH * WIDTH; n++)
        add(u, (&leaf[0][0][0][0])[n]);
}

static void print_run(unsigned char *block, double fill)
{
    static struct uniform u;
    begin(&u, block, fill);
    double start = bench_now();
    add_all(&u);
    double taken = bench_now() - start, bytes = (double)u.facts.peak + (double)u.store.size + (double)u.scratch.peak;
    printf("  %5.2f %7d %7d %8d %9d %10d %7d %8.1f %8.1f %8.1f %9.1f %8.1f\n", fill, u.slices, u.again, u.gluings, u.mixtures,
           u.components, u.touches, taken, u.making, u.gluing, bytes / 1e6, (double)u.facts.peak / 1e6);
    fflush(stdout);
}

void bench_uniform_print(void *block)
{
    printf("\nspace, %d x %d balls: all inner slices of level %d, all neighbours glued; seconds, most bytes held (facts among "
           "them)\n",
           OBSTACLES, OBJECTS, BENCH_SPACE_LEVEL);
    printf("  %5s %7s %7s %8s %9s %10s %7s %8s %8s %8s %9s %8s\n", "fill", "slices", "again", "gluings", "mixtures", "components",
           "edges", "seconds", "slices", "gluings", "MB", "facts");
    print_run(block, 1.0);
    print_run(block, 0.8);
}
