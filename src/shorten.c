/* shorten: leave out the poses of a path that certified legs can pass by. */
#include "certify.h"
#include "proof.h"

/* A turn that needs more pieces than this is not worth the time. */
enum { SHORTEN_PIECES = 64 };

/* Can one slide and one turn lead from a to b? *corner: the pose between them. */
static bool passes(const struct cage_proof *proof, const cage_pose *a, const cage_pose *b, cage_pose *corner)
{
    for (int32_t turn_first = 0; turn_first < 2; turn_first++) {
        *corner = turn_first ? *b : *a;
        for (int32_t k = 0; k < 3; k++)
            corner->x[k] = turn_first ? a->x[k] : b->x[k];
        if (cage_certify_leg(&proof->scene, proof->result.pivot, corner->q, a->x, b->x, 0) &&
            cage_certify_turn(&proof->scene, proof->result.pivot, corner->x, a->q, b->q, SHORTEN_PIECES))
            return true;
    }
    return false;
}

static bool same(const cage_pose *a, const cage_pose *b)
{
    bool equal = true;
    for (int32_t k = 0; k < 3; k++)
        equal = equal && a->x[k] == b->x[k];
    for (int32_t k = 0; k < 4; k++)
        equal = equal && a->q[k] == b->q[k];
    return equal;
}

void cage_shorten_begin(struct cage_proof *proof)
{
    proof->path_at = 0;
    proof->path_kept = 1;
}

/* At most two poses are kept for two or more that are passed by, so the array serves for both. */
bool cage_shorten_step(struct cage_proof *proof)
{
    int32_t at = proof->path_at, to = proof->path_count - 1;
    const cage_pose from = proof->path[proof->path_kept - 1];
    cage_pose corner, *kept = &proof->path[proof->path_kept];
    if (at >= to)
        return true;
    while (to > at + 1 && !passes(proof, &from, &proof->path[to], &corner))
        to = at + (to - at) / 2;
    if (to > at + 1 && !same(&corner, &from) && !same(&corner, &proof->path[to]))
        *kept++ = corner;
    if (to == proof->path_count - 1 || !same(&from, &proof->path[to]))
        *kept++ = proof->path[to];
    proof->path_kept = (int32_t)(kept - proof->path);
    proof->path_at = to;
    return false;
}
