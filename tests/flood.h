/* flood.h: the complement of a union of balls on a dense grid: what is surely joined in it, and what is surely not. */
#ifndef FLOOD_H
#define FLOOD_H

#include <stdbool.h>

#include "cage.h"

/* Cell (i, j, k) is the closed cube of width pitch around its centre, origin + pitch (i, j, k). Cells have two numbers. Equal
 * `joined`: the centres are joined by axis-parallel segments off every closed ball. Different `apart`: no point of one
 * cell is joined with a point of the other off the closed balls. So joined refines the truth, and apart coarsens it. */
struct flood {
    int32_t dim, pitch, cells;
    int32_t n[3], origin[3];
    int32_t *joined; /* -1: the centre is in a closed ball */
    int32_t *apart;  /* cells that are covered have numbers of their own */
};

/* A grid over all balls and at least one pitch more on every side, so that its corner, cell 0, is outside. pitch is a
 * multiple of 16. */
void flood_make(struct flood *flood, int32_t dim, const cage_ball *ball, int32_t count, int32_t pitch);
void flood_free(struct flood *flood);

void flood_centre(const struct flood *flood, int32_t cell, int32_t p[3]);

/* The cell that holds p, which is in the grid. */
int32_t flood_cell(const struct flood *flood, const int32_t p[3]);

/* label[cell]: what somebody says is the component of the cell's centre, -1 if it is in a ball. Null, or how that contradicts the
 * flood. *decided: cells of which the flood knows the component for certain, among those not in a ball. */
const char *flood_contradicts(const struct flood *flood, const int32_t *label, int32_t labels, long *decided);

/* Is p off every closed ball? */
bool flood_clear(const cage_ball *ball, int32_t count, const int32_t p[3]);

#endif
