/* survey: the state of an atlas in the making. */
#ifndef CAGE_SURVEY_H
#define CAGE_SURVEY_H

#include "chart.h"
#include "proof.h"

/* Where a component lies, and a point in it if one is known. Of the outside: zeros. */
struct cage_extent {
    int32_t low[3], high[3];
    int32_t known;
    int32_t at[3];
};

/* What is kept of a cell's slice; word null: it was not built. */
struct cage_sheet {
    struct cage_chart chart;
    struct cage_extent *extent; /* one for each component */
};

/* What is known of a class. */
struct cage_sum {
    int32_t nodes, cells;
    int32_t last; /* the last leaf that was counted */
    int32_t leaf; /* 1 + the leaf of the known point, or 0 */
    int64_t mean[4];   /* its representatives, those of larger cells counting more */
    int32_t middle[4]; /* all its rotations turn by no more from this one */
    int32_t sine;      /* than by the angle of which half has this sine, in units of 2^-30; at most 2^30 */
    struct cage_extent extent; /* at: the point */
};

/* The components of all leaves as nodes, numbered leaf by leaf, and their classes. */
struct cage_classes {
    int32_t *first; /* node of each cell that is a leaf */
    int32_t *of;    /* the class of each node */
    int32_t nodes;
    int32_t count;
    int32_t edges;
    struct cage_sum *sum; /* for each class, at the end */
};

struct cage_survey {
    struct cage_survey_result result;
    struct cage_proof *proof;
    struct cage_plan plan;
    struct cage_sheet *sheet[CAGE_SIDES]; /* for each cell there may be */
    struct cage_classes classes[CAGE_SIDES];
    int32_t cell;  /* the leaf in work, or -1: all are done */
    int32_t side;
    int32_t beyond; /* the first leaf of the next part, or -1 */
    bool part;      /* only a part is wanted */
    int32_t after; /* the last of its neighbours that is done */
    cage_ball *obstacle; /* the inner obstacles by x */
    bool done;
};

/* Bring the result up to date. */
void cage_survey_sum_up(struct cage_survey *survey);

/* Join nodes into classes, numbered in the order of their first nodes; class 0 is the outside. */
int32_t cage_classes_make(struct cage_survey *survey, int32_t side);

/* Add up what is known of each class, and put the edges of all leaves in order. */
int32_t cage_classes_sum(struct cage_survey *survey, int32_t side);

/* The number of the node of an edge's end. */
int32_t cage_classes_node(const struct cage_survey *survey, int32_t side, const struct cage_node *node);

#endif
