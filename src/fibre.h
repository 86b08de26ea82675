/* fibre: the compact factor of configuration space, cut into a tree of closed cells. */
#ifndef CAGE_FIBRE_H
#define CAGE_FIBRE_H

#include "cage.h"

#include <stdbool.h>

/* A cell: a box of the face's cube at its level, at[k] in 0..2^level - 1 (only at[0] in the plane). */
struct cage_cell {
    int32_t level;
    int32_t face;
    int32_t at[3];
};

/* Roots of the plane's fibre and of space's, and the children of each cell. */
enum { CAGE_ROOTS_2D = 2, CAGE_CHILDREN_2D = 2, CAGE_ROOTS_3D = 4, CAGE_CHILDREN_3D = 8 };

/* Child 0..children-1 of the cell. */
static inline void cage_cell_child(const struct cage_cell *cell, int32_t index, struct cage_cell *out)
{
    out->level = cell->level + 1;
    out->face = cell->face;
    for (int32_t k = 0; k < 3; k++)
        out->at[k] = 2 * cell->at[k] + (index >> k & 1);
}

/* A fibre is a cover of a group of rotations by closed cells, and what the search needs to know of them. Cells of different
 * levels are compared exactly. */
struct cage_fibre {
    int32_t roots;     /* cells of level 0 */
    int32_t children;  /* of each cell */
    int32_t max_level; /* quaternions of cells stay within 2^30 up to here */
    /* Do the closed cells share a piece of dimension f - 1 or f, f the fibre's? (True if one holds the other.) */
    bool (*touch)(const struct cage_cell *a, const struct cage_cell *b);
    bool (*contains)(const struct cage_cell *cell, const int32_t q[4]);
    /* The representative rotation, and cage_turn from it to the farthest rotation of the cell. */
    void (*representative)(const struct cage_cell *cell, int32_t q[4]);
    int64_t (*turn)(const struct cage_cell *cell);
    /* Its corners, and how many it has. Where there are two, displacements follow from the turn alone. */
    int32_t (*corners)(const struct cage_cell *cell, int32_t q[8][4]);
    /* A rotation in both of two touching cells. */
    void (*common)(const struct cage_cell *a, const struct cage_cell *b, int32_t q[4]);
};

/* The rotations of the plane. */
extern const struct cage_fibre cage_so2;
bool cage_so2_contains(const struct cage_cell *cell, const int32_t q[4]);

/* The rotations of space. */
extern const struct cage_fibre cage_so3;
bool cage_so3_contains(const struct cage_cell *cell, const int32_t q[4]);

/* The half turns about the axes as quaternions: 0: none, 1: i, 2: j, 3: k. Those of two in turn: first ^ second. */
enum { CAGE_TURNS = 4 };

/* q times the half turn, up to sign: that first, then the rotation q. Entries keep their magnitudes. */
void cage_so3_turned(const int32_t q[4], int32_t turn, int32_t out[4]);

/* The cell of all rotations of `cell` times the half turn; its representative is the cell's, turned. */
void cage_so3_turned_cell(const struct cage_cell *cell, int32_t turn, struct cage_cell *out);

#endif
