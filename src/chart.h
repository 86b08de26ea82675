/* chart: a tree of boxes that tells which component of a slice a grid point lies in. */
#ifndef CAGE_CHART_H
#define CAGE_CHART_H

#include "slice.h"

/* What follows is stored, as words of 32 bits (see query.h for how it is read).
 *
 * The head: the bounding box of the balls, low corner (CAGE_CHART_LOW), high corner (CAGE_CHART_HIGH), and the root box: so
 * many bits of size from the low corner on, its entry the word CAGE_CHART_ROOT. A point off the bounding box is outside. An
 * entry is a value, shifted, and its kind in the low two bits:
 *
 *     CAGE_CHART_SPLIT  the word where the entries of its 2^dim halves begin, the high half of axis k at bit k
 *     CAGE_CHART_LABEL  1 + the component that holds the whole box, 0: all of it is covered
 *     CAGE_CHART_LIST   the word where a list begins: how many balls and simplices (in the high half word); a component; for
 *                       each ball the word where it is (centre, radius); for each simplex its component and the words of its
 *                       vertices. What is off the balls is in the component of a simplex that holds it, or else in the first */
enum { CAGE_CHART_LOW = 0, CAGE_CHART_HIGH = 3, CAGE_CHART_BITS = 6, CAGE_CHART_ROOT = 7, CAGE_CHART_HEAD = 8 };
enum { CAGE_CHART_SPLIT = 0, CAGE_CHART_LABEL = 1, CAGE_CHART_LIST = 2 };

/* A list has at most so many balls, and simplices. */
enum { CAGE_CHART_BALLS_2D = 32, CAGE_CHART_BALLS_3D = 255, CAGE_CHART_SIMPLICES = 255 };

struct cage_chart {
    uint32_t *word;
    int32_t words;
};

/* Made in the arena; *out is released with it. */
int32_t cage_chart_make(struct cage_arena *arena, const struct cage_slice *slice, struct cage_chart *out);

#endif
