/* oracle_space_flood.h: floods of boxes of poses: a proof of separation, or a path of certified steps. */
#ifndef ORACLE_SPACE_FLOOD_H
#define ORACLE_SPACE_FLOOD_H

#include "oracle_space.h"

/* Which body moves, and as what. A part of it that cannot leave keeps all of it. */
typedef enum space_part {
    SPACE_BALL, /* one of its balls: rotations do not matter, R^3 */
    SPACE_LINE, /* its balls shrunk (for paths: grown) to be symmetric about an axis, R^3 x S^2 */
    SPACE_WHOLE /* R^3 x SO(3) */
} space_part;

typedef struct space_body {
    int obstacles;   /* 0: the object moves, 1: the obstacles do, seen from the object */
    space_part part;
    int32_t ball;    /* of SPACE_BALL */
} space_body;

/* work: about how many pairs of balls may be looked at.
 *
 * Boxes of poses, n along the scene, are closed if one pair of inner balls overlaps at every pose of the box. 1: the
 * flood through the others stays inside (or does not reach the goal), 0: it does not, -1: too much work, or not to be
 * used here. */
int space_separated(const space_question *q, const space_body *body, int n, long work, space_audit *audit);

/* 1: centres of boxes are joined with the outside (the goal) by moves along one axis, each certified free with ORACLE_SLACK
 * to spare (outer balls); 0: not found, -1: too much work, or not to be used here. */
int space_joined(const space_question *q, const space_body *body, int n, long work, space_audit *audit);

#endif
