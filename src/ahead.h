/* ahead: slices and gluings that a search will ask for next, made beforehand by several workers. */
#ifndef CAGE_AHEAD_H
#define CAGE_AHEAD_H

#include "chart.h"
#include "graph.h"

/* One piece of work, a function of scene and limits alone, and its result in a worker's memory. */
struct cage_unit {
    const struct cage_proof *proof;
    int32_t side;
    int32_t a;    /* the cell whose slice to build, */
    int32_t b;    /* or (not -1) the other to glue it with, */
    int32_t seed; /* beginning with this component */
    bool done;
    size_t used, peak; /* what it would have taken from scratch, and left in it */
    struct cage_slice slice;
    struct cage_chart chart; /* of the slice, where all cells are wanted */
    struct cage_touch *touch;
    int32_t count, mixed;
};

enum { CAGE_UNITS = 96, CAGE_WORKERS = 64 };

struct cage_ahead {
    /* The result, if it is there and would have fitted into scratch, which is left as if it had been worked out in it; else null.
     * (By a pointer, so that an image without workers does not carry it.) */
    const struct cage_unit *(*find)(struct cage_ahead *ahead, const struct cage_proof *proof, int32_t side, int32_t a, int32_t b,
                                    int32_t seed, struct cage_arena *scratch);
    struct cage_unit unit[CAGE_UNITS];
    struct cage_arena arena[CAGE_WORKERS];
    int32_t units;
    int32_t first;  /* of the units that are new */
    bool gluing;    /* the second half of the work: pairs of slices, of which some were only just made */
    int32_t missed; /* how often something was asked for that is not here */
    int32_t patience; /* so often it may be */
};

/* May workers (or null) be used? */
bool cage_workers_are_valid(const cage_workers *workers);

/* In the workers' memory; null if there is too little of it for that to be of use. */
struct cage_ahead *cage_ahead_make(const cage_workers *workers);

/* Is there so little of use left that it is time to look ahead again? */
bool cage_ahead_is_due(const struct cage_ahead *ahead);

/* Drop what was used or can be no more; what may still be asked for stays as long as there is memory. */
void cage_ahead_tidy(struct cage_ahead *ahead, const cage_workers *workers);

/* Add a piece of work, unless it is there or there are CAGE_UNITS; is there room for more? */
bool cage_ahead_add(struct cage_ahead *ahead, const struct cage_proof *proof, int32_t side, int32_t a, int32_t b, int32_t seed);

/* Is the slice of a cell there, or will be? */
bool cage_ahead_has(const struct cage_ahead *ahead, const struct cage_proof *proof, int32_t side, int32_t cell);

/* Do what was added. */
void cage_ahead_do(struct cage_ahead *ahead, const cage_workers *workers);

/* Find out what both searches need next, and do it. */
void cage_ahead_work(struct cage_ahead *ahead, const struct cage_proof *proof, const cage_workers *workers);

#endif
