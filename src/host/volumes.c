/* volumes.c: bounds of what a class of an atlas holds: its translations, averaged over all rotations. */
#include <math.h>
#include <stdlib.h>

#include "atlas_host.h"

#define PIECES 6    /* of a cell along each axis, to bound its share of all rotations in space */
#define SLACK 1e-12 /* relative; more than sums of doubles are off */

typedef struct volume {
    double whole, most; /* of boxes that belong to the class, and of all that may; in units of the grid */
    int dim;
} volume;

/* Boxes are apart by one unit: what is in the gaps around a box adds one at either end. */
static void add(void *context, const cage_atlas_box *box)
{
    volume *sum = context;
    double inside = 1, around = 1;
    int k;

    for (k = 0; k < sum->dim; k++) {
        inside *= (double)box->high[k] - box->low[k];
        around *= (double)box->high[k] - box->low[k] + 2;
    }
    sum->whole += box->whole ? inside : 0;
    sum->most += around;
}

/* ---- a cell's share of all rotations --------------------------------------------------------------------- */

/* In the plane: the arc from corner to corner, as half angles, of 180 degrees. */
static void arc_share(const int32_t corner[8][4], double share[2])
{
    const double cross = (double)corner[0][0] * corner[1][3] - (double)corner[0][3] * corner[1][0];
    const double dot = (double)corner[0][0] * corner[1][0] + (double)corner[0][3] * corner[1][3];

    share[0] = share[1] = atan2(fabs(cross), fabs(dot)) / acos(-1.0);
}

/* In space: projected to the face of the cube of quaternions that it is on, where one entry is 1, the cell is a box; the
 * share has there the density (1 + |u|^2)^-2 / pi^2. Bounded piece by piece. */
static void box_share(const int32_t q[4], const int32_t corner[8][4], double share[2])
{
    double from[3], step[3];
    int face = 0, i, k, n = 0, at[3];

    for (i = 1; i < 4; i++)
        face = abs(q[i]) > abs(q[face]) ? i : face;
    for (i = 0; i < 4; i++)
        if (i != face) {
            from[n] = (double)corner[0][i] / corner[0][face];
            step[n] = ((double)corner[7][i] / corner[7][face] - from[n]) / PIECES;
            n++;
        }
    share[0] = share[1] = 0;
    for (at[0] = 0; at[0] < PIECES; at[0]++)
        for (at[1] = 0; at[1] < PIECES; at[1]++)
            for (at[2] = 0; at[2] < PIECES; at[2]++) {
                double size = 1, near = 1, far = 1;

                for (k = 0; k < 3; k++) { /* no piece has 0 within: pieces are even in number, or the cell is off it */
                    const double a = fabs(from[k] + at[k] * step[k]), b = fabs(from[k] + (at[k] + 1) * step[k]);

                    size *= step[k] / acos(-1.0);
                    near += fmin(a, b) * fmin(a, b);
                    far += fmax(a, b) * fmax(a, b);
                }
                share[0] += size * acos(-1.0) / (far * far);
                share[1] += size * acos(-1.0) / (near * near);
            }
}

void host_volume(const cage_atlas *atlas, int32_t side, int32_t number, double unit, int32_t halvings, double bound[2])
{
    int32_t cell, q[4], corner[8][4];

    bound[0] = bound[1] = 0;
    for (cell = 0; cell < atlas->leaves; cell++) {
        volume sum = { 0, 0, (int)atlas->dim };
        double share[2];

        if (cage_atlas_boxes(atlas, side, cell, number, halvings, add, &sum) <= 0)
            continue;
        if (cage_atlas_cell(atlas, cell, q, corner) == 2)
            arc_share((const int32_t (*)[4])corner, share);
        else
            box_share(q, (const int32_t (*)[4])corner, share);
        bound[0] += sum.whole * share[0];
        bound[1] += sum.most * share[1];
    }
    bound[0] *= pow(unit, atlas->dim) * (1 - SLACK);
    bound[1] *= pow(unit, atlas->dim) * (1 + SLACK);
}
