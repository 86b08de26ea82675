/* parts.h: true shapes, unions of convex parts: their file, the check of a path with them, and of balls against them. */
#ifndef CAGE_PARTS_H
#define CAGE_PARTS_H

#include "smooth.h"

/* ---- parts_file.c ------------------------------------------------------------------------------ */

enum { PART_BOX, PART_CYLINDER, PART_CAPSULE, PART_HULL };

/* A convex part in its own frame, and where that is in the object's frame or in the world. In the plane a part is the middle of
 * a solid that is the same above and below: such solids are as far from each other as their middles are. */
typedef struct host_part {
    int shape;
    double size[3];      /* box: half its sides. Cylinder, capsule: radius, and half the straight length, along its axis */
    int axis;            /* of cylinder and capsule: 0 for x, 2 for z */
    double (*vertex)[3]; /* of a hull */
    int32_t vertices;
    double centre[3];    /* a point inside, and how far the part reaches from it */
    double reach;
    double x[3], q[4];
} host_part;

typedef struct host_parts {
    host_part *part[2]; /* of the object, of the obstacles */
    int32_t count[2];
} host_parts;

/* One part a line, see cage prove --help. The caller frees it with host_free_parts, whatever the outcome. */
int host_read_parts(const char *path, int32_t dim, host_parts *parts, host_error *error);
void host_free_parts(host_parts *parts);

/* ---- parts.c and parts_balls.c, or parts_none.c where the build has no libccd -------------------- */

int host_parts_available(void);
const char *host_parts_name(void);

/* A place where the true shapes touch or overlap, or are closer than is looked. */
typedef struct parts_place {
    cage_pose at; /* of the pivot */
    int32_t leg;
    int overlaps; /* 1, by depth (the user's lengths); 0: only too close to tell */
    double depth;
} parts_place;

/* Balls of the object and of the obstacles, against its parts. Looked at in points. */
typedef struct parts_cover {
    int32_t balls, out; /* how many there are, and how many of them stick out of the parts */
    int32_t first;      /* of those */
    long points, bare;  /* of the parts' surfaces and insides, and how many of them are in no ball */
} parts_cover;

typedef struct parts_check {
    int kind;      /* what was looked at: 0 nothing, 1 a path that is proved for the balls, 2 a candidate */
    int whole;     /* 0: there were too many poses to look at; only a beginning of it was */
    long poses;    /* looked at on it */
    double finest; /* the clearance that a pose needs, in the user's lengths, */
    double least;  /* and the least that was seen to be there; 0 where there is a place */
    parts_place *place;
    int32_t places;
    parts_cover cover[2];
} parts_check;

/* Check the answer's path, or its candidate, and the balls. The caller frees it with host_free_check, whatever the outcome. */
int host_check_parts(const host_answer *answer, const host_parts *parts, parts_check *check, host_error *error);
void host_free_check(parts_check *check);

/* Is a ball inside the union of so many parts, as far as points of its surface tell? */
int parts_hold_ball(const host_part *part, int32_t count, const double x[3], double r, int32_t dim);

/* Do points of the parts, so many directions each, lie in balls? */
void parts_cover_by(const host_part *part, int32_t count, const host_balls *balls, int32_t dim, parts_cover *cover);

/* Is the point in the part? Within a millionth of its reach. */
int parts_hold_point(const host_part *part, const double x[3]);

/* Are two parts, both in the world, closer than that? */
int parts_closer(const host_part *a, const host_part *b, double than);

/* v turned by a unit quaternion, or back. */
void parts_turn(const double q[4], const double v[3], double out[3]);
void parts_turn_back(const double q[4], const double v[3], double out[3]);

#endif
