/* whole.h: slices made without leaving out a single ball, and points located in them exactly. */
#ifndef WHOLE_H
#define WHOLE_H

#include "exact.h"
#include "slice.h"

struct whole {
    void *block;
    cage_ball *ball; /* all collision balls */
    int32_t count;
    struct cage_triangulation t;
    struct cage_components c;
};

/* All collision balls of the side over the rotations. */
void whole_make(const struct cage_side *side, const struct cage_rotations *rotations, struct whole *out);

/* The balls of both. */
void whole_mix(const struct whole *a, const struct whole *b, struct whole *out);
void whole_free(struct whole *w);

/* The label of the simplex that holds the orthocentre of simplex s of `from`; that it does is checked in exact numbers. */
int32_t whole_label(const struct cage_triangulation *in, const int32_t *label, const struct cage_triangulation *from, int32_t s);

/* The label of a grid point, CAGE_COVERED in a closed ball. */
int32_t whole_locate(const struct whole *w, const int32_t p[3], int32_t *hint);

/* The label of any point x of the plane (x[0..1]) or of space, found without a walk: in all simplices by exact barycentric
 * coordinates; CAGE_COVERED in a ball. Beyond the sentinels is outside. */
int32_t whole_label_exact(const struct cage_triangulation *in, const int32_t *label, mpq_t x[3]);

#endif
