/* oracle_space_body.h: a question in space as one of a moving body among walls. */
#ifndef ORACLE_SPACE_BODY_H
#define ORACLE_SPACE_BODY_H

#include "oracle_space_flood.h"

typedef struct space_mover {
    double y[3]; /* from the pivot, at the start's rotation; for a line (t, 0, 0) */
    double r, arm;
    int32_t ball;
} space_mover;

/* The moving body is at p + exp(v) y, v the turn from the start. For a line v is across its axis, in the sides' coordinates. */
typedef struct space_moving {
    const space_question *q;
    const space_body *body;
    int path;                   /* outer balls, which on a line are grown; otherwise inner ones, which are shrunk */
    int dims;                   /* of rotations: 0, 2 or 3 */
    int movers, walls;
    space_mover *mover;
    double (*wall)[4];
    double axis[3], side[2][3]; /* of a line at the start; orthonormal */
    double pivot[3];            /* of the moving body, in its frame */
    double start[3], goal[3];   /* of the pivot */
    double goal_turn[3];        /* v of the goal */
    int has_goal;
} space_moving;

/* 0 when the body cannot be used (g is to be freed all the same). */
int space_moving_make(const space_question *q, const space_body *body, int path, space_moving *g);
void space_moving_free(space_moving *g);

/* Where exp(v) takes all movers, from the pivot. */
void space_moving_turn(const space_moving *g, const double v[3], double (*offset)[3]);

/* Where the object as given is when the moving body is at p, turned by exp(v); spun by any angle about a line's axis. */
space_place space_moving_place(const space_moving *g, const double p[3], const double v[3], double spin);

#endif
