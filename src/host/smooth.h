/* smooth.h: paths made short and smooth, what is proved of them, and the file they are written to. */
#ifndef CAGE_SMOOTH_H
#define CAGE_SMOOTH_H

#include "host.h"

/* ---- metric.c, or metric_none.c where the build has no CHOLMOD --------------------------------- */

/* The metric A = K'K of a path's stations between two fixed ones; K: their first differences, and their second ones times
 * `stiffness`. */
typedef struct smooth_metric smooth_metric;

/* Is there one in this build, and what it comes from. */
int smooth_metric_available(void);
const char *smooth_metric_name(void);

/* Factored once. Null if that failed. */
smooth_metric *smooth_metric_make(int stations, double stiffness);
void smooth_metric_free(smooth_metric *metric);

/* Solves A out = in for so many columns of `stations` numbers each; 0, or -1 if that failed. */
int smooth_metric_solve(smooth_metric *metric, const double *in, double *out, int columns);

/* ---- way.c ------------------------------------------------------------------------------------- */

/* Where the pivot is, in grid units, and a unit quaternion. */
typedef struct way_station {
    double x[3], q[4];
} way_station;

/* Poses of the pivot, on the grid. */
typedef struct host_way {
    cage_pose *pose; /* the caller's, freed by host_free_way */
    int32_t count;
    int smooth;          /* 1: it was smoothed, and the curve of the rows is certified; 0: the path as it was found */
    double length;       /* see way_length */
    double found_length; /* of the path as it was found */
    double deviation;    /* grid units between the curve and the straight legs, at most */
} host_way;

/* The turn from one rotation to another the shorter way, as a vector along its axis, in radians. */
void way_turn(const double from[4], const double to[4], double turn[3]);

/* q turned by a vector. */
void way_apply(const double turn[3], const double q[4], double out[4]);

void way_station_of(const cage_pose *pose, way_station *out);
void way_between(const way_station *a, const way_station *b, double t, way_station *out);

/* The largest distance of a point of the object from its pivot, in grid units; never 0. */
double way_radius(const host_answer *answer);

/* The length of a leg is the root of its way squared and (turn times radius) squared. */
double way_length(const cage_pose *path, int32_t count, double radius);

/* So many stations, evenly apart along the path, the first and the last its ends. */
void way_resample(const cage_pose *path, int32_t count, double radius, way_station *station, int stations);

/* The rows of a path through the stations: poses evenly apart in time, on a cubic through the places; the ends as given. */
void way_rows(const way_station *station, int stations, const cage_pose *first, const cage_pose *last, int32_t dim,
              cage_pose *row, int32_t rows);

/* Is the curve through the rows free of collision, by the independent check? The pivot goes from row to row on the cubic
 * whose slope at a row is half the difference of the rows beside it (at the ends: the difference to the one row), the object
 * turning at a constant rate. That is what straight legs are, but for *deviation; obstacles are made larger by as much.
 * 1 or 0; -1: no memory. */
int way_certify(const host_answer *answer, const cage_pose *row, int32_t rows, double *deviation);

/* May the object go from one pose of the pivot to another on one leg, moving and turning at once? 1: proved. */
int way_leg(const host_answer *answer, const cage_pose *from, const cage_pose *to);

/* A station as a pose on the grid. */
void way_pose(const way_station *at, int32_t dim, cage_pose *pose);

/* Where the object is a part t of the way from row i to the next: on the curve of way_certify, or on a straight leg. */
void way_at(const cage_pose *row, int32_t rows, int curve, int32_t i, double t, way_station *out);

/* For each unit of t no point of the object within that radius of its pivot moves farther than this. */
double way_rate(const cage_pose *row, int32_t rows, int curve, int32_t i, double radius);

/* CSV: t from 0 to 1, the object's pose, and where its pivot is. */
int host_write_way(const char *path, const host_answer *answer, const host_way *way, host_error *error);

/* ---- clearance.c ------------------------------------------------------------------------------- */

/* Pairs of balls that are near each other at some station. */
typedef struct way_near way_near;

/* Finds those nearer than `within` at each station. Null: no memory. */
way_near *way_near_find(const host_answer *answer, const way_station *station, int stations, double within);
void way_near_free(way_near *near);

/* The cost of a station; its gradient, six numbers, of the place and of a turn of the world's frame, is added to push. A pair
 * costs (band - gap)^2 / (2 band), in overlap band / 2 - gap, if its gap is less than the band. *least: the least gap. */
double way_near_cost(const way_near *near, int index, const way_station *at, double band, double push[6], double *least);

/* ---- smooth.c ---------------------------------------------------------------------------------- */

/* Makes a path short and smooth; certified: it is one that the check accepts, and is kept where no better one is found. Where
 * nothing is certified way->count is 0. */
int host_smooth(const host_answer *answer, const cage_pose *path, int32_t count, int certified, host_way *way, host_error *error);
void host_free_way(host_way *way);

/* ---- candidate.c ------------------------------------------------------------------------------- */

/* Where the object as given collides on a candidate, and by how much at most, in grid units. */
typedef struct host_overlap {
    cage_pose at; /* of the pivot */
    double depth;
    int32_t leg; /* it is on the leg from this pose to the next */
} host_overlap;

/* See cage_prove_candidate. */
typedef struct host_candidate {
    cage_step *step;
    cage_pose *pose;
    host_overlap *place;
    int32_t steps, count, places;
} host_candidate;

/* The candidate of an answer; count 0: there is none. The caller frees it, whatever the outcome. */
int host_find_candidate(const host_answer *answer, host_candidate *out, host_error *error);
void host_free_candidate(host_candidate *candidate);

/* Looks along its path, a hundredth of the object's radius at a time, for where it collides: samples, no proof. */
int host_look_at_candidate(const host_answer *answer, host_candidate *candidate, host_error *error);

#endif
