/* region: where the reached part of the inner slices lets the pivot be. */
#include "proof.h"

#include <string.h>

/* Mark the grid points that lie in a reached component of the slice. */
static void mark_slice(const struct cage_slice *slice, const struct cage_facts *facts, int32_t number, const int32_t origin[3],
                       int32_t pitch, const int32_t count[3], uint8_t *mask)
{
    int32_t s = 0, reach = slice->t.dim == 2 ? CAGE_REACH_2D : CAGE_REACH_3D;
    for (int32_t k = 0; k < count[2]; k++)
        for (int32_t j = 0; j < count[1]; j++)
            for (int32_t i = 0; i < count[0]; i++) {
                size_t at = ((size_t)k * (size_t)count[1] + (size_t)j) * (size_t)count[0] + (size_t)i;
                const int64_t wide[3] = {origin[0] + (int64_t)pitch * i, origin[1] + (int64_t)pitch * j,
                                         origin[2] + (int64_t)pitch * k};
                if (mask[at] || wide[0] < -reach || wide[0] > reach || wide[1] < -reach || wide[1] > reach || wide[2] < -reach ||
                    wide[2] > reach)
                    continue;
                const int32_t p[3] = {(int32_t)wide[0], (int32_t)wide[1], (int32_t)wide[2]};
                s = cage_delaunay_locate(&slice->t, p, s);
                int32_t label = slice->label[s];
                if (label >= 0 && facts->node[label].seen == number && cage_slice_clear(slice, p))
                    mask[at] = 1;
            }
}

int32_t cage_prove_region(cage_proof *proof, const int32_t origin[3], int32_t pitch, const int32_t count[3], uint8_t *mask)
{
    if (!proof || !origin || !count || !mask || pitch < 1 || count[0] < 0 || count[1] < 0 || count[2] < 0)
        return CAGE_ERROR_ARGUMENT;
    if (proof->scene.dim == 2 && (origin[2] != 0 || count[2] > 1))
        return CAGE_ERROR_DIMENSION;
    if (proof->error != CAGE_OK)
        return proof->error;
    memset(mask, 0, (size_t)count[0] * (size_t)count[1] * (size_t)count[2]);
    int32_t number = proof->reach[CAGE_INNER].number;
    for (int32_t cell = 0; cell < proof->graph.cells; cell++) {
        const struct cage_facts *facts = &proof->graph.cell[cell].facts[CAGE_INNER];
        bool reached = false;
        for (int32_t k = 0; k < facts->nodes; k++)
            reached = reached || (facts->node[k].seen == number && number > 0);
        if (!reached || proof->graph.cell[cell].child)
            continue;
        const struct cage_slice *slice;
        int32_t error = cage_proof_slice(proof, CAGE_INNER, cell, &slice);
        if (error != CAGE_OK)
            return error;
        mark_slice(slice, facts, number, origin, pitch, count, mask);
    }
    return CAGE_OK;
}
