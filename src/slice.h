/* slice: object balls, obstacle balls and one cell give collision balls, their triangulation and its components. */
#ifndef CAGE_SLICE_H
#define CAGE_SLICE_H

#include "body.h"
#include "component.h"
#include "grid.h"
#include "piece.h"

/* The rotations that a slice speaks for: all within `turn` (see cage_turn) of q. */
struct cage_rotations {
    int32_t q[4];
    int64_t turn; /* 0: q alone */
};

/* Where an object ball is in a slice. Collision ball (j, a): centre X_j - at, radius R_j + r_a + change. */
struct cage_part {
    int32_t at[3];        /* R_c Y_a, rounded */
    int32_t displacement; /* d_a */
    int32_t change;       /* the displacement and the slack, inward or outward */
};

/* A component: `deep` is one of its simplices (-1: it has none without a sentinel), `size` their number, and if `known`,
 * `point` is a grid point in it, off every closed ball. The outside has one always. If it is bounded it lies within the bounds. */
struct cage_region {
    int32_t deep;
    int32_t size;
    int32_t first; /* of its orthoballs; the outside has none */
    int32_t known;
    int32_t point[3];
    struct cage_bounds bounds;
};

/* One block of memory, self-contained. */
struct cage_slice {
    struct cage_triangulation t; /* t.ball[site]: the object ball (part) it stems from, -1 for a sentinel */
    int32_t *label;              /* of each simplex: CAGE_COVERED, CAGE_OUTSIDE, 1.. */
    struct cage_part *part;
    struct cage_region *region;
    struct cage_orthoball *orthoball; /* of each simplex of the bounded components, one component after the other */
    int32_t orthoballs;
    int32_t regions;
    int32_t parts;
    int64_t balls;    /* collision balls, those left out included, */
    int64_t inserted; /* and how many were triangulated; hidden ones are no sites */
    bool whole;       /* none was left out but those that are hidden */
    size_t bytes;
};

/* Build the slice in the arena: exact for the rounded balls. */
int32_t cage_slice_make(struct cage_arena *arena, const struct cage_side *side, const struct cage_rotations *rotations,
                        struct cage_slice *out);

/* The same for the rotations between the corners of a cell; null: for all within the turn. */
int32_t cage_slice_make_within(struct cage_arena *arena, const struct cage_side *side, const struct cage_rotations *rotations,
                               const struct cage_corners *corners, struct cage_slice *out);

/* Copy it into a block of out->bytes bytes, aligned to CAGE_ALIGN. */
void cage_slice_pack(const struct cage_slice *slice, void *block, struct cage_slice *out);

/* The component of a grid point with |coordinates| <= CAGE_REACH, or CAGE_COVERED if a closed ball holds it. */
int32_t cage_slice_locate(const struct cage_slice *slice, const int32_t p[3]);

/* Is the grid point off every closed ball of the slice? */
bool cage_slice_clear(const struct cage_slice *slice, const int32_t p[3]);

#endif
