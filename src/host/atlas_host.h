/* atlas_host.h: what the files of cage atlas share. */
#ifndef CAGE_ATLAS_HOST_H
#define CAGE_ATLAS_HOST_H

#include "host.h"

/* A finished atlas and what it took. */
typedef struct host_built {
    void *block; /* of the survey */
    unsigned char *bytes;
    unsigned char *facts; /* of an attempt that needs a larger block, or that was interrupted; or null */
    size_t facts_size;
    int kept;    /* the file of facts is of this build */
    int resumed; /* it went on from facts: `work` does not tell it all */
    int32_t threads;
    cage_survey_result work;
    cage_atlas atlas;
    double seconds;
} host_built;

/* A class and its number. */
typedef struct host_row {
    int32_t number;
    cage_class class;
} host_row;

/* By how much all balls must shrink for two outer classes to be one (to 0: for the outside), and where. */
typedef struct host_passage {
    int32_t from, to;
    cage_margin margin;
} host_passage;

#define HOST_PASSAGE_CLASSES 6
#define HOST_PASSAGES (HOST_PASSAGE_CLASSES * (HOST_PASSAGE_CLASSES + 1) / 2)

typedef struct host_passages {
    host_passage list[HOST_PASSAGES];
    int32_t count;
} host_passages;

/* Builds it in a block of the size given, or (bytes null) in one that grows; goes on from what is in the file of facts beside
 * `path`, and keeps there what was found out when it takes long. */
int host_build_atlas(const cage_scene *scene, const cage_plan *plan, const size_t *bytes, const char *path, int quiet,
                     host_built *made, host_error *error);

/* The atlas was written: facts are not needed any more. */
void host_forget_facts(const char *path, const host_built *made);

#define HOST_ROWS 24 /* classes of a side that are told in full */

/* All classes of a side, the largest first, the caller's to free; null without memory. */
host_row *host_rows(const cage_atlas *atlas, int32_t side);

/* Passages null: they were not asked for. */
void host_report_atlas(FILE *out, const char *path, const host_built *made, double unit, int32_t halvings,
                       const host_passages *passages);
void host_report_atlas_json(FILE *out, const host_built *made, double unit, int32_t halvings, const host_passages *passages);

/* Between all pairs of the largest bounded outer classes, and from each to the outside, by proofs of their own, in a block of
 * that size if bytes is not null. */
int host_find_passages(const cage_scene *scene, const host_built *made, double unit, int32_t rounds, const size_t *bytes,
                       host_passages *out, host_error *error);

/* At least and at most how large a bounded class is, as the average over all rotations of what its translations fill; boxes are
 * halved so often to find out. In the user's unit. */
void host_volume(const cage_atlas *atlas, int32_t side, int32_t number, double unit, int32_t halvings, double bound[2]);

/* The angle, in degrees, that rotations of the class differ from its middle one at most; 180: they may be any. */
double host_class_turn(const cage_class *class);

/* A picture (SVG, and in space a mesh, where its folder is not null) of each large bounded class. */
int host_draw_classes(const char *svg, const char *ply, const host_query *query, const host_grid *grid, const host_built *made,
                      host_error *error);

#endif
