/* proof: the state of one search, shared by the files that carry it out. */
#ifndef CAGE_PROOF_H
#define CAGE_PROOF_H

#include "ahead.h"
#include "graph.h"

/* A breadth-first search over the nodes of one side. */
struct cage_reach {
    struct cage_node *start;
    struct cage_node *head, *tail;           /* reached, edges to be followed */
    struct cage_node *open_head, *open_tail; /* followed, but not glued all around */
    int32_t glued;                           /* of the neighbours of the first open node, the last that it is glued with */
    int32_t number;                          /* of this search: node.seen */
};

struct cage_proof {
    struct cage_result result; /* of this search */
    struct cage_result total;  /* and of the second one */
    struct cage_ahead *ahead;  /* while workers help, else null */
    const struct cage_unit *taken; /* where the slice that was made last came from; null: from no worker */
    struct cage_proof *second; /* in space, when both sides are asked for: see run.c */
    struct cage_limits limits;
    struct cage_arena arena;   /* what stays: this struct, the graph, facts, the path */
    struct cage_arena scratch; /* empty between steps */
    struct cage_store store;
    bool all;                  /* nothing is asked: all cells are wanted, and there is no start */
    size_t shared;             /* bytes that facts, store and scratch have together, */
    size_t fixed;              /* and those before them */
    struct cage_graph graph;
    struct cage_side side[CAGE_SIDES];
    struct cage_reach reach[CAGE_SIDES];
    cage_scene scene;           /* the caller's arrays */
    cage_pose pose[2];          /* start and goal as given */
    int32_t at[2][3];           /* where the pivot is then, rounded */
    int32_t outer_at[2][3];     /* a place with some clearance that a free leg leads to: where the outer side begins */
    int32_t label[CAGE_SIDES][2]; /* components of start and goal, once their slices are built */
    int32_t phase;
    int32_t corridor;           /* cells with this number may be explored on the outer side; 0: all may */
    int32_t corridors;
    int64_t outer_steps;        /* taken by the outer side, */
    bool spares_outer;          /* which has had its share of the steps: run.c says so */
    bool outer_lost;            /* the outer side has no place to begin at: as if it were not asked for */
    int32_t outer_work;         /* slices and gluings of the outer side when the corridor was chosen */
    int32_t origin;             /* the cell the search begins at: CAGE_CELL_START or CAGE_CELL_GOAL */
    int32_t hopeless;           /* a way was banned: no inner proof any more; the reason then */
    int32_t error;
    struct cage_node *way;      /* the target that a search has reached */
    cage_pose *path;
    int32_t path_side;          /* of the way it follows; the inner one's is a candidate */
    int32_t path_room;
    int32_t path_count;
    struct cage_node *leg;      /* node of the way whose leg of the path comes next, */
    int32_t turned;             /* and the half turn by which its cell's image is meant */
    int32_t path_at, path_kept; /* while it is shortened: the pose that comes next, and how many are kept */
};

/* The second search may make one cell for so many of the first. */
enum { CAGE_SECOND_CELLS = 8 };

/* The level to begin with where the limits name none. */
int32_t cage_proof_first_level(const cage_scene *scene, const cage_limits *limits, bool all);

/* Of these, facts beside those of each cell. */
enum { CAGE_FACTS_BYTES = 16384 };

/* What one search takes, as a rule: cells, facts, and slices of which half the balls or more are covered, or apart. */
uint64_t cage_proof_size(const cage_scene *scene, const cage_limits *limits);

int32_t cage_limits_check(const cage_limits *limits, int32_t dim);

/* Scene, poses (goal may be null) and limits, these as given or (null) the default ones of that side. */
int32_t cage_proof_check(const cage_scene *scene, const cage_pose *start, const cage_pose *goal, const cage_limits *given,
                         int32_t side, cage_limits *limits);

/* The first state of one search, for what was checked. Start null: all cells are wanted; cells 0 and 1 are not. */
int32_t cage_proof_begin(struct cage_proof **proof, const cage_scene *scene, const cage_pose *start, const cage_pose *goal,
                         const cage_limits *limits, const struct cage_shortcuts *shortcuts, void *memory, size_t bytes);

/* What is left of the block is for facts, slices and work. */
void cage_proof_share_out(struct cage_proof *proof);

/* The side that it searches now, or -1. */
int32_t cage_proof_searching(const struct cage_proof *proof);

/* What comes next: prove.c takes the steps before CAGE_PHASE_OUTER, outer.c the others. */
enum {
    CAGE_PHASE_START = 0,
    CAGE_PHASE_INNER,
    CAGE_PHASE_REFINE,
    CAGE_PHASE_OUTER,
    CAGE_PHASE_PATH,
    CAGE_PHASE_SHORTEN,
    CAGE_PHASE_DONE
};

/* One step of this search alone. */
int32_t cage_proof_step(struct cage_proof *proof);

/* One of prove.c; CAGE_ERROR_MEMORY: it may be taken again when there is room for it. */
int32_t cage_proof_step_inner(struct cage_proof *proof);

/* The search begins where less can be seen; the ends are located on that side. */
void cage_proof_choose_origin(struct cage_proof *proof, int32_t side);

/* The inner side can do no more: outer searches over all cells, cut evenly where they have come. */
void cage_proof_last_resort(struct cage_proof *proof, int32_t reason);

/* After some steps: this search's result so far becomes the total, and what is told of it. */
int32_t cage_proof_report(struct cage_proof *proof);

/* Is there an outer side to search? */
static inline bool cage_proof_has_outer(const struct cage_proof *proof)
{
    return (proof->limits.side & CAGE_SIDE_OUTER) && !proof->outer_lost;
}

int32_t cage_proof_finish(struct cage_proof *proof, int32_t verdict, int32_t reason);

bool cage_proof_is_done(const struct cage_proof *proof);

/* After a step that failed for lack of memory: was it work, facts or path that found none, and did they get some of the store's,
 * which is emptied? Then the step can be taken again: so far it has done nothing, but that the path may have become longer. */
bool cage_proof_make_room(struct cage_proof *proof);

/* The block to try next after CAGE_ERROR_MEMORY, for this search alone, or (the first one) for both. */
uint64_t cage_proof_needed(const struct cage_proof *proof);
uint64_t cage_prove_needed(const struct cage_proof *proof);

/* Which ball of the object stands for which where cell b, turned if need be, is a neighbour of a: see cage_glue_matched. */
const int32_t *cage_proof_match(const struct cage_proof *proof, int32_t side, int32_t a, int32_t b);

/* The slice of a cell, built again if it was dropped. */
int32_t cage_proof_slice(struct cage_proof *proof, int32_t side, int32_t cell, const struct cage_slice **slice);

/* Those of two cells, both at once. */
int32_t cage_proof_slices(struct cage_proof *proof, int32_t side, int32_t a, int32_t b, const struct cage_slice **c,
                          const struct cage_slice **d);

/* What a search did: one unit of work (and all the graph search that needs none), or it reached the target (proof->way), or
 * there is nothing left to do. */
enum { CAGE_WORKED = 0, CAGE_FOUND = 1, CAGE_CLOSED = 2 };

/* After the ends were located. */
int32_t cage_search(struct cage_proof *proof, int32_t side);

/* The slice of a cell, made in the arena. */
int32_t cage_search_make(const struct cage_proof *proof, struct cage_arena *arena, int32_t side, int32_t cell,
                         struct cage_slice *slice);

/* The next neighbour after `after` (-1: the first) of the node's cell that it is not glued with; -1: no more. */
int32_t cage_search_unglued(const struct cage_proof *proof, int32_t side, const struct cage_node *node, int32_t after);

/* Build the slice of start or goal on that side and locate it there: *end, *slice. CAGE_FOUND: both were before. */
int32_t cage_search_ends(struct cage_proof *proof, int32_t side, int32_t *end, const struct cage_slice **slice);

/* Forget what was reached; facts stay. */
void cage_search_anew(struct cage_proof *proof, int32_t side);

/* The same, and reach what the known edges lead to. */
void cage_search_known(struct cage_proof *proof, int32_t side);

/* Which cell of the inner way to cut: in space the coarsest from where the outer search stops; in the plane, at the
 * stop, the coarser of the last cell it reached and the first it did not; if neither can be cut, the coarsest beyond.
 * (Up to there the way is real: nothing to be gained.) -1: none can be cut. *stop: the node of the way where the
 * outer search stops. */
int32_t cage_refine_choose(const struct cage_proof *proof, struct cage_node *target, struct cage_node **stop);

/* Without an inner way: the coarsest leaf that the outer search has reached, or the coarsest of all; -1: none can be cut. */
int32_t cage_refine_coarsest(const struct cage_proof *proof);

/* Reserve the memory that is left for a path along the way of that side, which ends at proof->way. */
void cage_path_begin(struct cage_proof *proof, int32_t side);

/* Add the leg through one node; 1: that was the last, 0: more to come, CAGE_ERROR_..., or CAGE_PATH_FAILED. */
int32_t cage_path_step(struct cage_proof *proof);

#define CAGE_PATH_FAILED (-1000)

/* Shorten the path that was written, one pose at a time; true when that is done. */
void cage_shorten_begin(struct cage_proof *proof);
bool cage_shorten_step(struct cage_proof *proof);

#endif
