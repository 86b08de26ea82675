/* oracle_space.h: an independent judge of scenes in space: floods of boxes of poses, trees of certified moves, linked chains. */
#ifndef ORACLE_SPACE_H
#define ORACLE_SPACE_H

#include "cage.h"
#include "oracle.h"

/* What is judged. The first object_ring inner balls of the object, and the first obstacle_ring inner obstacles, may be closed
 * chains of overlapping balls (0: none); whether they are is looked at. */
typedef struct space_question {
    const cage_scene *scene;
    const cage_pose *start;
    const cage_pose *goal; /* or null */
    int32_t object_ring, obstacle_ring;
} space_question;

/* How much may be spent on a question. */
typedef struct space_effort {
    long work;   /* pairs of balls looked at by one flood */
    int finest;  /* boxes along the scene at most */
    int tries;   /* of a tree of moves */
} space_effort;

/* Counts of an audit: poses looked at, and those that contradict what was claimed of them (0 is right). */
typedef struct space_audit {
    uint64_t rng;
    long looked, wrong;
    int every; /* one in so many closed boxes and steps is looked at */
} space_audit;

/* x + R(q) y for every point y of the moving body. */
typedef struct space_place {
    long double x[3], r[3][3];
} space_place;

void oracle_space_place(const cage_pose *pose, space_place *out);

/* Deepest overlap r + R - distance over all pairs of the side's balls; negative: the clearance. */
long double oracle_space_depth_at(const cage_scene *scene, const space_place *at, int32_t side);
long double oracle_space_depth(const cage_scene *scene, const cage_pose *pose, int32_t side);

/* CAGE_CAGED, DISCONNECTED, FREE, CONNECTED, IN_COLLISION, or UNDEFINED when the effort does not tell. *how: by what.
 * audit: null, or what counts the errors of the judge itself. */
int32_t oracle_space_decide(const space_question *q, const space_effort *effort, space_audit *audit, const char **how);

/* The two halves of it: 1: proved joined, or separated; 0: not proved. Neither end may collide. */
int oracle_space_joined(const space_question *q, const space_effort *effort, space_audit *audit, const char **how);
int oracle_space_separated(const space_question *q, const space_effort *effort, space_audit *audit, const char **how);

/* 1: proved separated, as two closed chains are linked at the start, and not, or otherwise, at the goal. */
int oracle_space_linked(const space_question *q);

/* Worst depth over the whole motion of a path as cage_path_check defines it, the moves from start and to goal
 * included, by closed formulas; poses on the way are looked at too. *wrong: null, or which part of that contract is
 * broken. */
long double oracle_space_check_path(const cage_scene *scene, const cage_pose *start, const cage_pose *goal,
                                    const int32_t pivot[3], const cage_pose *path, int32_t count, const char **wrong);
#endif
