/* soak_atlas.c: atlases with wrong bytes under a right check sum: an error or any answer, but no crash (run under ASan, UBSan).
 *
 * usage: soak_atlas FROM TO        seeds; prints how many were opened all the same */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "atlas.h"
#include "cage.h"
#include "random.h"
#include "scenes.h"
#include "scenes_space.h"
#include "sealed.h"

enum { CHANGES = 400, QUESTIONS = 12, ROOM = 64 << 20 };

/* Words near the head matter most; small numbers and single bits get furthest. */
static void change(uint64_t *state, unsigned char *byte, size_t words)
{
    size_t at = random_next(state) % 2 ? random_next(state) % words : random_next(state) % (words < 64 ? words : 64);
    uint32_t now = 0;
    for (int i = 3; i >= 0; i--)
        now = now << 8 | byte[4 * at + (size_t)i];
    uint32_t drawn = (uint32_t)random_next(state);
    switch (random_next(state) % 5) {
    case 0: sealed_put(byte, at, drawn); break;
    case 1: sealed_put(byte, at, drawn % 64); break;
    case 2: sealed_put(byte, at, now ^ (uint32_t)1 << drawn % 32); break;
    case 3: sealed_put(byte, at, now + drawn % 9 - 4); break;
    default: sealed_put(byte, at, drawn % (uint32_t)(2 * words)); break;
    }
}

static void see(void *context, const cage_atlas_box *box)
{
    for (int k = 0; k < 3; k++)
        if (box->low[k] > box->high[k])
            ++*(long *)context;
}

static void question(uint64_t *state, const cage_atlas *atlas)
{
    cage_pose pose[2];
    cage_class class;
    const int32_t reach = atlas->dim == 3 ? CAGE_REACH_3D : CAGE_REACH_2D;
    memset(pose, 0, sizeof pose);
    for (int i = 0; i < 2; i++) {
        for (int k = 0; k < atlas->dim; k++)
            pose[i].x[k] = (int32_t)(random_next(state) % (uint64_t)reach) / (1 << random_next(state) % 12) - reach / 1000;
        for (int k = 0; k < 4; k++)
            if (atlas->dim == 3 || k % 3 == 0)
                pose[i].q[k] = (int32_t)(random_next(state) % 7) - 3;
    }
    (void)cage_atlas_ask(atlas, &pose[0], random_next(state) & 1 ? &pose[1] : NULL);
    for (int32_t side = CAGE_SIDE_INNER; side <= CAGE_SIDE_OUTER; side++) {
        (void)cage_atlas_locate(atlas, &pose[0], side);
        int32_t count = atlas->classes[side - 1];
        int32_t number = count > 0 ? (int32_t)(random_next(state) % (uint64_t)count) : 0, q[4], corner[8][4];
        int32_t cell = atlas->leaves > 0 ? (int32_t)(random_next(state) % (uint64_t)atlas->leaves) : 0;
        long turned = 0;
        (void)cage_atlas_class(atlas, side, number, &class);
        (void)cage_atlas_cell(atlas, cell, q, corner);
        (void)cage_atlas_boxes(atlas, side, cell, number, (int32_t)(random_next(state) % 5), see, &turned);
        if (turned > 0)
            abort();
    }
}

/* The atlas of a random scene, in a block of its own size; null if it is too large to be of use. */
static unsigned char *make(uint64_t seed, void *block, size_t *size)
{
    static scene plane;
    static space_scene space;
    cage_plan plan;
    cage_survey *survey;
    scene_random(seed, &plane);
    space_random(seed, &space);
    const cage_scene view = seed % 4 ? scene_view(&plane) : space_view(&space);
    cage_plan_default(&plan);
    plan.level = (int32_t)(seed % 3);
    plan.side = 1 + (int32_t)(seed / 3 % 3);
    if (cage_survey_begin(&survey, &view, &plan, block, ROOM) != CAGE_OK || cage_survey_run(survey, INT64_MAX) != 1)
        return NULL;
    *size = cage_survey_atlas(survey, NULL, 0);
    unsigned char *byte = malloc(*size);
    if (byte)
        (void)cage_survey_atlas(survey, byte, *size);
    return byte;
}

int main(int argc, char **argv)
{
    uint64_t from = argc > 1 ? strtoull(argv[1], NULL, 10) : 1, to = argc > 2 ? strtoull(argv[2], NULL, 10) : 10;
    long changed = 0, opened = 0, asked = 0;
    void *block = malloc(ROOM);
    for (uint64_t seed = from; block && seed <= to; seed++) {
        uint64_t state = seed;
        size_t size = 0;
        unsigned char *byte = make(seed, block, &size), *copy = malloc(size);
        for (int n = 0; byte && copy && n < CHANGES; n++) {
            cage_atlas atlas;
            memcpy(copy, byte, size);
            for (uint64_t i = 1 + random_next(&state) % 4; i > 0; i--)
                change(&state, copy, size / 4);
            sealed_sum(copy, size);
            changed++;
            if (cage_atlas_open(&atlas, copy, size) != CAGE_OK)
                continue;
            opened++;
            for (int i = 0; i < QUESTIONS; i++, asked++)
                question(&state, &atlas);
        }
        free(copy);
        free(byte);
    }
    free(block);
    printf("%ld changed, %ld of them opened, %ld questions\n", changed, opened, asked);
    return 0;
}
