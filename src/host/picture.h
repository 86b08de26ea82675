/* picture.h: what the pictures of scenes in space share, flat ones (SVG) and meshes (PLY). */
#ifndef CAGE_HOST_PICTURE_H
#define CAGE_HOST_PICTURE_H

#include "host.h"

/* In the user's numbers. */
typedef struct picture_box {
    double low[3], high[3];
} picture_box;

/* A pose by its pivot, in the user's numbers; the quaternion (w, x, y, z) has unit length. */
typedef struct picture_stop {
    double x[3], q[4];
} picture_stop;

/* Where the pivot can be: the points origin + pitch (i, j, k), in grid units; mask[i + nx (j + ny k)] is 1 there. */
typedef struct picture_cloud {
    int32_t origin[3], pitch, count[3];
    uint8_t *mask;
} picture_cloud;

/* ---- trail.c ------------------------------------------------------------------------------------ */
/* The largest distance of the object's points from its pivot. */
double picture_radius(const host_answer *answer);
/* Around the obstacles, and the object at start and goal. */
void picture_scene_box(const host_answer *answer, picture_box *box);
void picture_grow(picture_box *box, double by);
int picture_inside(const picture_box *box, const picture_stop *stop);
/* A pose of the object's origin (as start and goal are), and where a pose puts the centre of an object ball. */
void picture_stop_at(const host_answer *answer, const cage_pose *pose, picture_stop *stop);
void picture_place(const host_answer *answer, const picture_stop *stop, const host_ball *ball, double at[3]);
/* At most so many poses, evenly along the part of the path whose pivots are in the box, half the object's radius
 * apart at least, the start not among them; returns how many. */
int picture_trail(const host_answer *answer, const picture_box *box, picture_stop *stop, int most);

/* ---- cloud.c ------------------------------------------------------------------------------------ */
/* The verdicts that say where the pivot stays. */
int picture_stuck(const cage_result *result);
/* 0, or -1 where it cannot be found (no memory). The caller frees cloud->mask, whatever the outcome. */
int picture_find_cloud(const host_answer *answer, picture_cloud *cloud);
int picture_marked(const picture_cloud *cloud, int32_t i, int32_t j, int32_t k); /* 0 beyond the grid */

#endif
