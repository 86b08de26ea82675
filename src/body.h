/* body: a scene as one side of the proof sees it, and exact questions about single poses. */
#ifndef CAGE_BODY_H
#define CAGE_BODY_H

#include "arena.h"
#include "cage.h"
#include "shortcuts.h"

#include <stdbool.h>

/* Collision balls of one side of a slice, at most. */
enum { CAGE_PAIRS_MAX = 1 << 28 };

/* One side of a scene: the object's balls relative to the pivot. */
struct cage_side {
    const cage_ball *object; /* objects balls, centres relative to the pivot */
    const int32_t *reach;    /* |centre| of each, rounded up */
    const cage_ball *obstacle;
    int32_t objects;
    int32_t obstacles;
    int32_t dim;
    int32_t sign; /* -1: inner, +1: outer (see cage_radius_change) */
    const struct cage_shortcuts *shortcuts; /* for its slices, or null */
    const int32_t *image[4]; /* [t]: for each ball, the one that half turn t about an axis takes it to; null: not looked for */
};

/* The pivot: an integer point near the centre of the smallest ball around the centres of all of the object's balls, or
 * the origin if that serves as well. Any point is sound; this one keeps displacements small. */
void cage_pivot(const cage_shape *object, int32_t pivot[3]);

/* How far the ball's centre is from p, rounded up. */
int32_t cage_reach(const cage_ball *ball, const int32_t p[3]);

/* Copies the object's balls, moved, into the arena. */
int32_t cage_side_make(struct cage_arena *arena, const cage_scene *scene, const int32_t pivot[3], int32_t sign,
                       const struct cage_shortcuts *shortcuts, struct cage_side *out);

/* Does half turn t (1 to 3: about axis t - 1 through the pivot) take the object's balls to themselves? 1: yes, and image[t] is
 * taken from the arena; 0: no, or there are so many that it was not looked for; CAGE_ERROR_MEMORY. */
int32_t cage_side_turn(struct cage_arena *arena, int32_t turn, struct cage_side *side);

/* CAGE_OK, or what is wrong with the pose: entries against CAGE_REACH and CAGE_QUATERNION. */
int32_t cage_pose_check(int32_t dim, const cage_pose *pose);

/* Where the pivot is at that pose (user's frame), to the nearest grid point: off by less than 0.71 (0.87). */
void cage_pose_pivot(const cage_pose *pose, const int32_t pivot[3], int32_t out[3]);

/* Do the object's ball (object's frame) and the obstacle's overlap at the pose? Exact. */
bool cage_pair_collides(const cage_pose *pose, const cage_ball *y, const cage_ball *x);

#endif
