/* graph: cells, the components of their slices as nodes, and what gluing found out about them as edges. */
#ifndef CAGE_GRAPH_H
#define CAGE_GRAPH_H

#include "arena.h"
#include "cage.h"
#include "fibre.h"
#include "glue.h"
#include "store.h"

enum { CAGE_INNER = 0, CAGE_OUTER = 1, CAGE_SIDES = 2 };

/* Cells 0 and 1 are the rotations of start and goal alone; the fibre's cells follow. */
enum { CAGE_CELL_START = 0, CAGE_CELL_GOAL = 1, CAGE_CELL_ROOT = 2 };

/* A component over a cell. */
struct cage_node {
    int32_t cell;
    int32_t component;
    int32_t seen;   /* the search that reached it last */
    int32_t queued; /* in the queue now */
    int32_t inside; /* of an outer node: the inner component that holds it, CAGE_COVERED if that is not known */
    int32_t settled; /* glued with all leaf neighbours of its cell (-1), or with those of this corridor */
    struct cage_edge *edges;
    struct cage_glued *glued;
    struct cage_node *next;       /* in the queue */
    struct cage_node *next_open;  /* in the list of nodes whose cell is not glued all around */
    struct cage_node *from;       /* how it was reached */
    struct cage_edge *via;
};

struct cage_edge {
    struct cage_edge *next;
    struct cage_node *to;
    int32_t x[3];   /* a common point: see struct cage_touch */
    int32_t banned; /* no search may use it */
};

/* The fact that all edges of a node to those over another cell are known. */
struct cage_glued {
    struct cage_glued *next;
    int32_t with;
};

/* What is known of a cell on one side; nodes 0: its slice was never built. */
struct cage_facts {
    struct cage_node *node; /* one for each component */
    int32_t nodes;
    struct cage_held *held;
};

struct cage_leaf {
    struct cage_cell cell; /* not for start and goal */
    struct cage_rotations rotations;
    int32_t parent; /* -1: none */
    int32_t child;  /* the first of its children, 0: it is a leaf */
    int32_t corridor; /* the last one that it was in, */
    int32_t beside;   /* or had a neighbour in */
    struct cage_facts facts[CAGE_SIDES];
};

struct cage_graph {
    const struct cage_fibre *fibre;
    struct cage_leaf *cell;
    int32_t cells;
    int32_t capacity;
    int32_t level; /* the finest yet */
    bool goal;     /* cell 1 is in use */
    struct cage_arena *arena; /* facts are kept for ever */
};

/* The fibre's root cells, cut down to the level. False when there is no room for the cells. */
bool cage_graph_init(struct cage_graph *graph, int32_t level);

/* Replace a leaf by its children. False when there is no room. */
bool cage_graph_refine(struct cage_graph *graph, int32_t cell);

/* The next leaf after `after` (-1: the first) whose closed cell shares a facet with that of `cell` or, for start and
 * goal, holds it. -1: no more. Start and goal are not neighbours of each other. */
int32_t cage_graph_neighbour(const struct cage_graph *graph, int32_t cell, int32_t after);

/* The next leaf after `after` (-1: the first) in the order of the tree, start and goal left out; -1: no more. */
int32_t cage_graph_leaf(const struct cage_graph *graph, int32_t after);

bool cage_graph_is_glued(const struct cage_node *node, int32_t with);

/* Record a slice of so many components. */
int32_t cage_graph_add_nodes(struct cage_graph *graph, int32_t side, int32_t cell, int32_t components);

/* Record what gluing component `seed` of cell a (or CAGE_ALL) with cell b has found: all of it, or nothing for lack of memory. */
int32_t cage_graph_add_gluing(struct cage_graph *graph, int32_t side, int32_t a, int32_t b, int32_t seed,
                              const struct cage_touch *touch, int32_t count);

#endif
