/* overlap: boxes around all that a component of one slice may share with a component of its neighbour. */
#ifndef CAGE_OVERLAP_H
#define CAGE_OVERLAP_H

#include "box.h"
#include "slice.h"

/* K of c, bounded, and L of d; all else is 0 at first, and its arrays taken from the arena. */
struct cage_overlap {
    const struct cage_slice *c, *d;
    int32_t k, l;
    struct cage_piece *piece;  /* those of L that may meet K */
    struct cage_bounds bounds; /* of all these */
    struct cage_box *box;      /* around what a piece of K shares with them, for each that does; the last may be for several */
    int32_t pieces, boxes;
    int32_t met;      /* pairs of pieces that meet, if not more than CAGE_OVERLAP_MANY */
    int64_t compared; /* pairs of pieces */
};

/* So many pairs are looked at closely; where more meet, little would be told by it. */
enum { CAGE_OVERLAP_MANY = 256, CAGE_OVERLAP_BOXES = 128 };

/* Find the pieces, none: K and L are apart. Then the boxes: likewise. Boxes hold whatever the components share. */
int32_t cage_overlap_pieces(struct cage_arena *arena, struct cage_overlap *o);
int32_t cage_overlap_boxes(struct cage_arena *arena, struct cage_overlap *o);

#endif
