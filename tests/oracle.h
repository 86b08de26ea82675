/* oracle.h: an independent judge of planar scenes: voxels of (x, y, angle) and exact path geometry. */
#ifndef ORACLE_H
#define ORACLE_H

#include "cage.h"

/* Depths closer to 0 than this many units are not judged: doubles err by less than a thousandth of it. */
#define ORACLE_SLACK 1e-3

/* Deepest overlap r + R - distance over all pairs of the side's balls at the pose; negative: the clearance. */
long double oracle_depth(const cage_scene *scene, const cage_pose *pose, int32_t side);

/* The same where the pivot is at p and the object is turned by (cosine, sine). */
long double oracle_depth_at(const cage_scene *scene, const int32_t pivot[3], const long double p[2],
                            long double cosine, long double sine, int32_t side);

/* 1: proved that no path leads from start to goal (goal null: arbitrarily far away), 0: not proved.
 * n: voxels along the longer side of the plane; angles are cut to match. Start and goal must not collide (inner balls).
 * Sound because a voxel is closed only if one pair of inner balls overlaps at every pose in it. */
int oracle_caged(const cage_scene *scene, const cage_pose *start, const cage_pose *goal, int n);

/* 1: proved that a path exists, 0: not found. It goes from centre to centre of voxels by moves along an axis
 * and turns, each certified free (outer balls) with ORACLE_SLACK to spare. Start must be free. */
int oracle_path(const cage_scene *scene, const cage_pose *start, const cage_pose *goal, int n);

/* CAGE_CAGED, DISCONNECTED, FREE, CONNECTED, IN_COLLISION, or UNDEFINED when max_n voxels do not tell. */
int32_t oracle_decide(const cage_scene *scene, const cage_pose *start, const cage_pose *goal, int max_n);

/* Count poses in closed voxels and on certified steps that contradict oracle_depth: random ones, or with
 * samples 0 the rims of all closed voxels. 0 is right. */
int oracle_audit(const cage_scene *scene, const cage_pose *start, int n, int samples, uint64_t seed);

/* Worst depth over the whole motion of a path as cage_path_check defines it, the moves from start and to
 * goal included. *wrong: null, or which part of that contract is broken. */
long double oracle_check_path(const cage_scene *scene, const cage_pose *start, const cage_pose *goal,
                              const int32_t pivot[3], const cage_pose *path, int32_t count,
                              const char **wrong);
#endif
