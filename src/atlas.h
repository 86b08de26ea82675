/* atlas: what an atlas looks like in bytes. */
#ifndef CAGE_ATLAS_H
#define CAGE_ATLAS_H

#include "cage.h"

/* Words of 32 bits, least significant byte first; places are counted in words from the beginning. The head, after the five
 * words of words.h: */
enum {
    CAGE_ATLAS_DIM = 5,      /* 2 or 3 */
    CAGE_ATLAS_SIDES = 6,    /* CAGE_SIDE_... */
    CAGE_ATLAS_PIVOT = 7,    /* 3 words */
    CAGE_ATLAS_NOTE = 10,    /* 2 words: cage_plan.note */
    CAGE_ATLAS_OBJECT = 12,  /* the object's inner balls: place, count; each dim + 1 words, centre and radius */
    CAGE_ATLAS_OBSTACLE = 14, /* likewise, by x in rising order */
    CAGE_ATLAS_CELL = 16,    /* the tree of cells: place, count; the roots, then the children of each cell that was cut: twice
                                the number of the first of these, or twice the number of the leaf plus 1 */
    CAGE_ATLAS_LEAVES = 18,
    CAGE_ATLAS_SIDE = 19,    /* two tables of CAGE_SIDE_WORDS words, inner and outer */
    CAGE_ATLAS_LARGEST = 37, /* the largest radius among them */
    CAGE_ATLAS_LEAF = 38,    /* where the leaves are told: its level and 16 times its face, then its
                                place in the face, three words */
    CAGE_ATLAS_HEAD = 39
};

/* A side: places, and how many. */
enum {
    CAGE_SIDE_LEAF = 0,  /* for each leaf two words: the place of its chart, and its first node */
    CAGE_SIDE_NODES = 1, /* how many: the components of all leaves, in their order */
    CAGE_SIDE_CLASS = 2, /* the class of each node */
    CAGE_SIDE_ROW = 3,   /* the graph in rows (CSR): where each node's neighbours begin, and where the last one's end, */
    CAGE_SIDE_TO = 4,    /* and the neighbours */
    CAGE_SIDE_EDGES = 5, /* how many */
    CAGE_SIDE_TABLE = 6, /* of classes: CAGE_CLASS_WORDS words each */
    CAGE_SIDE_CLASSES = 7,
    CAGE_SIDE_WORDS = 9
};

/* A class. Class 0 is the outside. */
enum {
    CAGE_CLASS_NODES = 0,
    CAGE_CLASS_CELLS = 1, /* leaves that have a node of it */
    CAGE_CLASS_LOW = 2,   /* 3 words: a box that holds all its translations of the pivot (not for the outside: zeros) */
    CAGE_CLASS_HIGH = 5,
    CAGE_CLASS_LEAF = 8,  /* 1 + a leaf where a point of it is known, or 0 */
    CAGE_CLASS_AT = 9,    /* 3 words: that point */
    CAGE_CLASS_Q = 12,    /* 4 words: its rotations are those that turn by no more from this one */
    CAGE_CLASS_SINE = 16, /* than what this tells: see cage_class */
    CAGE_CLASS_WORDS = 17
};

enum { CAGE_ATLAS_MAGIC_WORD = 0x65676163 /* "cage" */, CAGE_ATLAS_FORMAT_WORD = 1 };

/* Sort balls by x. */
void cage_atlas_sort(cage_ball *ball, int32_t count);

#endif
