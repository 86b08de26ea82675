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

/* Builds it in a block of the size given, or (bytes null) in one that grows; goes on from what is in the file of facts beside
 * `path`, and keeps there what was found out when it takes long. */
int host_build_atlas(const cage_scene *scene, const cage_plan *plan, const size_t *bytes, const char *path, int quiet,
                     host_built *made, host_error *error);

/* The atlas was written: facts are not needed any more. */
void host_forget_facts(const char *path, const host_built *made);

/* All classes of a side, the largest first, the caller's to free; null without memory. */
host_row *host_rows(const cage_atlas *atlas, int32_t side);

void host_report_atlas(FILE *out, const char *path, const host_built *made, double unit);
void host_report_atlas_json(FILE *out, const host_built *made, double unit);

/* Where the large bounded outer classes join others or the outside when all balls shrink: a table, by proofs of its own. */
int host_print_passages(FILE *out, const cage_scene *scene, const host_built *made, double unit, int32_t rounds,
                        host_error *error);

#endif
