/* prove_in_c.c: cage.h from C, without heap, files or floating point: a bracket inside a square fence. */
#include <stdio.h>

#include "cage.h"

#define SIDE 8      /* balls along each side of the fence */
#define UNIT 1000   /* grid units in the length we think in: rounding is finer than that */

static cage_ball fence[4 * SIDE];
static unsigned char memory[16 << 20];

/* Balls of radius 1.2, 2 apart, around the square |x|, |y| <= 8. */
static void build_fence(void)
{
    int i;

    for (i = 0; i < SIDE; i++) {
        const int32_t along = (2 * i - SIDE) * UNIT, edge = SIDE * UNIT;
        const cage_ball side[4] = {
            { along, -edge, 0, 1200 }, { edge, along, 0, 1200 }, { -along, edge, 0, 1200 }, { -edge, -along, 0, 1200 },
        };
        int k;

        for (k = 0; k < 4; k++)
            fence[4 * i + k] = side[k];
    }
}

int main(void)
{
    static const cage_ball bracket[] = { /* like a [ : x, y, z = 0, r */
        { 2000, 3000, 0, 700 },  { 1000, 3000, 0, 700 },  { 0, 3000, 0, 700 },  { 0, 2000, 0, 700 },
        { 0, 1000, 0, 700 },     { 0, 0, 0, 700 },        { 0, -1000, 0, 700 }, { 0, -2000, 0, 700 },
        { 0, -3000, 0, 700 },    { 1000, -3000, 0, 700 }, { 2000, -3000, 0, 700 },
    };
    const cage_pose start = { { 0, 0, 0 }, { 1, 0, 0, 0 } };
    const int32_t count = (int32_t)(sizeof bracket / sizeof bracket[0]);
    cage_scene scene = { { bracket, bracket, 0, 0 }, { fence, fence, 4 * SIDE, 4 * SIDE }, 2 };
    cage_limits limits;
    cage_proof *proof;
    int32_t state;

    build_fence();
    scene.object.inner_count = scene.object.outer_count = count;
    cage_limits_default(&limits, scene.dim);
    state = cage_prove_begin(&proof, &scene, &start, NULL, &limits, memory, sizeof memory);
    while (state == CAGE_OK)
        state = cage_prove_run(proof, 100);
    puts(state < 0 ? cage_error_text(state) : cage_verdict_text(cage_prove_result(proof)->verdict));
    return state < 0;
}
