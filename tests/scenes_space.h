/* scenes_space.h: scenes in space near the border between caged and free. */
#ifndef SCENES_SPACE_H
#define SCENES_SPACE_H

#include <stdio.h>

#include "cage.h"

#define SPACE_OBJECT 12
#define SPACE_OBSTACLES 128
#define SPACE_FAMILIES 11

/* Owns its balls. goal counts only if has_goal. The first object_ring balls of the object, and the first obstacle_ring
 * obstacles, are meant as a closed chain of overlapping balls (0: no such chain); who relies on it looks whether they are. */
typedef struct space_scene {
    cage_ball object[SPACE_OBJECT], obstacles[SPACE_OBSTACLES];
    int32_t object_count, obstacle_count;
    int32_t object_ring, obstacle_ring;
    cage_pose start, goal;
    int32_t has_goal;
    int32_t family;
    uint64_t seed;
} space_scene;

/* A function of the seed, the same bits with every build of one compiler (another may draw arguments in another
 * order); the family is seed % SPACE_FAMILIES. Fits CAGE_REACH_3D. The start is
 * free in nearly all scenes. */
void space_random(uint64_t seed, space_scene *out);

const char *space_family_text(int32_t family);

/* Points into the scene: valid as long as it is. */
cage_scene space_view(const space_scene *s);
const cage_pose *space_goal(const space_scene *s);

/* The same question in a world turned by one of the 24 rotations of the cube (turn 0 to 23), then moved by `by`. */
void space_move_world(const space_scene *in, int turn, const int32_t by[3], space_scene *out);

/* The same question with the object's frame turned likewise, and moved by up to `by` units, as far as poses stay integer. */
void space_move_frame(const space_scene *in, int turn, int32_t by, space_scene *out);

/* All balls in another order; chains are forgotten. */
void space_shuffle(const space_scene *in, uint64_t seed, space_scene *out);

/* The same question from the other end; needs a goal. */
void space_swap(const space_scene *in, space_scene *out);

/* As many of the object's balls as there is room for together with their images under half turns about the axes: about that
 * one (1 to 3), or all three (4); twice if they are their own. No goal, no chain. */
void space_double(const space_scene *in, int turns, space_scene *out);

/* The same union of balls, but one more of them hidden in the object's first, so that no half turn takes the balls to themselves;
 * false if there is no room for it. */
int space_spoil(const space_scene *in, space_scene *out);

/* Poses and balls as text, to file in a report. */
void space_print(FILE *file, const space_scene *s);
#endif
