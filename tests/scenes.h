/* scenes.h: planar scenes near the border between caged and free. */
#ifndef SCENES_H
#define SCENES_H

#include <stdio.h>

#include "cage.h"
#include "random.h"

#define SCENE_OBJECT 8
#define SCENE_OBSTACLES 64
#define SCENE_FAMILIES 9

/* Owns its balls; scene_view makes what the library takes. goal counts only if has_goal. */
typedef struct scene {
    cage_ball object[SCENE_OBJECT], obstacles[SCENE_OBSTACLES];
    int32_t object_count, obstacle_count;
    cage_pose start, goal;
    int32_t has_goal;
    int32_t family;
    uint64_t seed;
} scene;

/* A function of the seed, the same bits with every build of one compiler (another may draw arguments in another
 * order); the family is seed % SCENE_FAMILIES. Fits CAGE_REACH_2D for every pivot
 * within the box of the object's centres. The start is free in nearly all scenes. */
void scene_random(uint64_t seed, scene *out);

const char *scene_family_text(int32_t family);

/* Points into the scene: valid as long as it is. */
cage_scene scene_view(const scene *s);
const cage_pose *scene_goal(const scene *s);

/* The whole world turned about the origin by quarters; exact in integers. */
void scene_quarter_turn(const scene *in, int quarters, scene *out);

/* The same question from the other end; needs a goal. */
void scene_swap(const scene *in, scene *out);

/* Start pose and balls as text, to file in a report. */
void scene_print(FILE *file, const scene *s);

int32_t scene_between(uint64_t *state, int32_t low, int32_t high); /* both ends included */
#endif
