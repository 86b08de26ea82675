/* atlas_command.c: "cage atlas": options in, one survey, the atlas out as a file, its classes as a table or as JSON. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "host.h"

#define STEPS_A_TURN 64 /* between two looks at the clock */
#define MOST_CELLS (1 << 24)
#define ROWS 24         /* of the table, for each side */
#define MOST_PASSAGE_CLASSES 6
#define PASSAGE_CELLS 1024 /* of each proof: where a passage just opens, more would tell little */
#define MOST_PASSAGES (MOST_PASSAGE_CLASSES * (MOST_PASSAGE_CLASSES + 1) / 2)

typedef struct options {
    const char *object, *obstacles, *output, *header, *side, *level, *budget, *memory, *unit, *passages;
    int json, quiet;
} options;

/* A finished atlas and what it took. */
typedef struct built {
    void *block; /* of the survey */
    unsigned char *bytes;
    cage_survey_result work;
    cage_atlas atlas;
    double seconds;
} built;

void host_atlas_help(FILE *out)
{
    (void)fprintf(out,
        "usage: cage atlas --object FILE --obstacles FILE -o FILE [OPTIONS]\n"
        "\n"
        "Finds out how the whole space of poses is connected: which poses a path joins, and which none does.\n"
        "The answer is a file that cage query, or cage_atlas_ask in a program, asks about any poses in\n"
        "microseconds. Two poses of one outer class are joined by a path; two poses of different inner classes\n"
        "are not; a bounded inner class is a cage. Class 0 is the outside.\n"
        "\n"
        "  --object FILE     the object's balls, in the object's own frame (files as for cage prove)\n"
        "  --obstacles FILE  the obstacles' balls\n"
        "  -o FILE           where the atlas goes\n"
        "\n"
        "options:\n"
        "  --level N         cut the rotations into cells of this level: 2^(N+1) cells in the plane (0 to %d), 4 * 8^N\n"
        "                    in space (0 to %d). Without it the level is chosen from the balls\n"
        "  --budget CELLS    then go on cutting cells up to so many, those first where the two sides disagree on what is\n"
        "                    connected\n"
        "  --side both|inner|outer  what the atlas can prove: separation (inner), connection (outer), or both\n"
        "  --memory BYTES    one block of this size and no more; K, M and G mean 1024, 1024^2, 1024^3\n"
        "  --unit U          length of a grid unit (default: the finest power of two at which the scene fits)\n"
        "  --passages N      for each large bounded outer class: by how much every radius must shrink for it to open into\n"
        "                    the outside, or into another one, and where; by N proofs for each pair (takes a while)\n"
        "  --c-header FILE   write the atlas as a C array as well, for a firmware build\n"
        "  --json            print one JSON object instead of the table\n"
        "  --quiet           print nothing; no progress, no warnings\n"
        "  --help            this text\n"
        "\n"
        "exit status: 0, 2 for bad input, 3 when memory was too small (says how much was needed).\n"
        "\n"
        "example:\n"
        "  cage atlas --object examples/walls/plus.xyzr --obstacles examples/walls/walls_R4.xyzr -o walls.atlas\n"
        "  cage query walls.atlas --at 185,195,45\n",
        CAGE_LEVEL_MAX_2D, CAGE_LEVEL_MAX_3D);
}

static int read_options(int argc, char **argv, options *given, host_error *error)
{
    const host_option known[] = {
        { "--object", &given->object, NULL }, { "--obstacles", &given->obstacles, NULL },
        { "-o", &given->output, NULL },       { "--c-header", &given->header, NULL },
        { "--side", &given->side, NULL },     { "--level", &given->level, NULL },
        { "--budget", &given->budget, NULL }, { "--memory", &given->memory, NULL },
        { "--unit", &given->unit, NULL },     { "--passages", &given->passages, NULL },
        { "--json", NULL, &given->json },
        { "--quiet", NULL, &given->quiet },
    };
    int code;

    memset(given, 0, sizeof *given);
    code = host_read_options(argc, argv, "atlas", known, sizeof known / sizeof known[0], NULL, error);
    if (code == HOST_OK && (given->object == NULL || given->obstacles == NULL || given->output == NULL))
        return host_fail(error, HOST_BAD_INPUT, "%s is missing (see cage atlas --help)",
                         given->object == NULL ? "--object" : given->obstacles == NULL ? "--obstacles" : "-o");
    return code;
}

static int read_plan(const options *given, int32_t dim, double unit, cage_plan *plan, host_error *error)
{
    const int32_t finest = dim == 2 ? CAGE_LEVEL_MAX_2D : CAGE_LEVEL_MAX_3D;
    int code;

    cage_plan_default(plan);
    memcpy(plan->note, &unit, sizeof plan->note);
    code = host_parse_side(given->side, &plan->side, error);
    if (code == HOST_OK && given->level != NULL)
        code = host_blame(error, "--level", host_parse_integer(given->level, 0, finest, &plan->level, error));
    if (code == HOST_OK && given->budget != NULL)
        code = host_blame(error, "--budget",
                          host_parse_integer(given->budget, dim == 2 ? 2 : 4, MOST_CELLS, &plan->max_cells, error));
    if (code == HOST_OK && given->budget != NULL && plan->side != CAGE_SIDE_BOTH)
        return host_fail(error, HOST_BAD_INPUT, "--budget: cells are cut where the two sides disagree; --side must be both");
    return code;
}

/* ---- the survey ---------------------------------------------------------------------------------------- */

static void show_progress(const cage_survey_result *work, double seconds)
{
    const int32_t sides = (work->slices[0] > 0) + (work->slices[1] > 0);
    const double share = (double)(work->slices[0] + work->slices[1]) / (double)(work->leaves * (sides > 0 ? sides : 1));
    char bar[33];
    int i;

    for (i = 0; i < 32; i++)
        bar[i] = i < (int)(32 * share) ? '#' : '.';
    bar[32] = '\0';
    (void)fprintf(stderr, "\r%6.1f s  [%s] %ld cells, %ld + %ld slices, %.0f MiB ", seconds, bar, (long)work->leaves,
                  (long)work->slices[0], (long)work->slices[1], (double)work->peak_bytes / (double)HOST_MIB);
    (void)fflush(stderr);
}

/* One attempt in a block of that size: CAGE_OK, or an error; *needed is then a block that gets further. */
static int32_t attempt(const cage_scene *scene, const cage_plan *plan, built *made, size_t bytes, int progress, uint64_t *needed)
{
    cage_survey *survey;
    double begun = host_now(), shown = begun;
    int32_t state = cage_survey_begin(&survey, scene, plan, made->block, bytes);
    size_t size;

    if (state != CAGE_OK)
        return state;
    while ((state = cage_survey_run(survey, STEPS_A_TURN)) == 0)
        if (progress && host_now() - shown > 0.1) {
            shown = host_now();
            show_progress(cage_survey_result_of(survey), shown - begun);
        }
    if (progress && shown > begun)
        (void)fprintf(stderr, "\r%90s\r", "");
    made->work = *cage_survey_result_of(survey);
    *needed = made->work.needed_bytes;
    if (state < 0)
        return state;
    size = (size_t)made->work.atlas_bytes;
    made->bytes = malloc(size);
    if (made->bytes == NULL || cage_survey_atlas(survey, made->bytes, size) != size)
        return CAGE_ERROR_MEMORY;
    made->seconds = host_now() - begun;
    return cage_atlas_open(&made->atlas, made->bytes, size);
}

/* In a block of the size given, or (bytes null) in one that grows until it is large enough. */
static int build(const cage_scene *scene, const cage_plan *plan, const size_t *bytes, int progress, built *made,
                 host_error *error)
{
    const size_t wanted = cage_survey_size(scene, plan);
    size_t least = bytes != NULL ? *bytes + 1 : wanted > HOST_LEAST_BLOCK ? wanted : HOST_LEAST_BLOCK;
    size_t size = bytes != NULL ? *bytes : wanted > HOST_FIRST_BLOCK ? wanted : HOST_FIRST_BLOCK;

    for (;;) {
        uint64_t needed = wanted;
        int32_t state;

        made->block = host_take_block(&size, least);
        if (made->block == NULL)
            return host_fail(error, HOST_MEMORY, "memory: a block of %zu bytes was needed and is not to be had", size);
        state = attempt(scene, plan, made, size, progress, &needed);
        if (state == CAGE_OK)
            return HOST_OK;
        if (state != CAGE_ERROR_MEMORY)
            return host_fail(error, HOST_BAD_INPUT, "the scene is not accepted: %.200s", cage_error_text(state));
        if (needed <= size)
            needed = (uint64_t)size + 1;
        if (bytes != NULL || size > HOST_LARGEST_BLOCK / 2 || needed > HOST_LARGEST_BLOCK)
            return host_fail(error, HOST_MEMORY, "memory: %zu bytes were too few; at least %llu are needed (--memory %llu)",
                             size, (unsigned long long)needed, (unsigned long long)needed);
        free(made->block);
        made->block = NULL;
        size = needed > 2 * size ? (size_t)needed : 2 * size;
        least = size;
    }
}

/* ---- files ---------------------------------------------------------------------------------------------- */

/* Written beside, then moved into place: there is never half an atlas. */
static int write_atlas(const char *path, const built *made, host_error *error)
{
    const size_t length = strlen(path), size = (size_t)made->work.atlas_bytes;
    char *beside = malloc(length + 6);
    FILE *file = NULL;
    int fine;

    if (beside == NULL)
        return host_fail(error, HOST_MEMORY, "no memory for a file name");
    memcpy(beside, path, length);
    memcpy(beside + length, ".part", 6);
    file = fopen(beside, "wb");
    fine = file != NULL && fwrite(made->bytes, 1, size, file) == size;
    fine = file != NULL && fclose(file) == 0 && fine && rename(beside, path) == 0;
    if (!fine && file != NULL)
        (void)remove(beside);
    free(beside);
    return fine ? HOST_OK : host_fail(error, HOST_BAD_INPUT, "%.600s cannot be written: %.200s", path, strerror(errno));
}

static int write_header(const char *path, const built *made, host_error *error)
{
    FILE *file = fopen(path, "w");
    const size_t size = (size_t)made->work.atlas_bytes;
    size_t i;
    int fine = file != NULL;

    if (fine) {
        (void)fprintf(file, "/* An atlas for cage_atlas_open: %zu bytes, written by cage atlas. */\n"
                            "static const unsigned char cage_atlas_bytes[%zu] = {", size, size);
        for (i = 0; i < size; i++)
            (void)fprintf(file, "%s%d,", i % 20 == 0 ? "\n    " : " ", made->bytes[i]);
        (void)fprintf(file, "\n};\n");
        fine = !ferror(file);
        fine = fclose(file) == 0 && fine;
    }
    return fine ? HOST_OK : host_fail(error, HOST_BAD_INPUT, "%.600s cannot be written: %.200s", path, strerror(errno));
}

/* ---- the table ------------------------------------------------------------------------------------------ */

typedef struct row {
    int32_t number;
    cage_class class;
} row;

static int by_size(const void *a, const void *b)
{
    const row *x = a, *y = b;

    if (x->class.cells != y->class.cells)
        return x->class.cells > y->class.cells ? -1 : 1;
    return x->number < y->number ? -1 : 1;
}

/* All classes of a side, the largest first; null without memory. */
static row *rows_of(const cage_atlas *atlas, int32_t side)
{
    const int32_t count = atlas->classes[side == CAGE_SIDE_OUTER];
    row *made = malloc((size_t)count * sizeof *made);
    int32_t i;

    for (i = 0; made != NULL && i < count; i++) {
        made[i].number = i;
        (void)cage_atlas_class(atlas, side, i, &made[i].class);
    }
    if (made != NULL)
        qsort(made, (size_t)count, sizeof *made, by_size);
    return made;
}

static void print_class(FILE *out, const row *r, int32_t dim, double unit)
{
    int k;

    (void)fprintf(out, "  %7ld  %-8s %7ld %7ld", (long)r->number, r->number == 0 ? "outside" : "bounded", (long)r->class.cells,
                  (long)r->class.nodes);
    for (k = 0; k < dim && r->number > 0; k++)
        (void)fprintf(out, "  %c %.5g to %.5g", "xyz"[k], r->class.low[k] * unit, r->class.high[k] * unit);
    (void)fprintf(out, "\n");
}

static void print_side(FILE *out, const cage_atlas *atlas, int32_t side, double unit)
{
    const int32_t count = atlas->classes[side == CAGE_SIDE_OUTER];
    row *rows = rows_of(atlas, side);
    int32_t i;

    (void)fprintf(out, "\n%s, %ld classes: %s\n", side == CAGE_SIDE_INNER ? "Inner" : "Outer", (long)count,
                  side == CAGE_SIDE_INNER ? "no path joins two of them" : "paths join all that is in one");
    (void)fprintf(out, "  %7s  %-8s %7s %7s  where the pivot is\n", "class", "", "cells", "pieces");
    for (i = 0; rows != NULL && i < count && i < ROWS; i++)
        print_class(out, &rows[i], atlas->dim, unit);
    if (count > ROWS)
        (void)fprintf(out, "  ... and %ld smaller ones\n", (long)(count - ROWS));
    free(rows);
}

static void print_text(FILE *out, const options *given, const built *made, double unit)
{
    const cage_survey_result *work = &made->work;
    const double balls = (double)(work->balls[0] + work->balls[1]);

    (void)fprintf(out, "Atlas   %s: %.1f KiB, %.2f bytes for each ball and slice\n", given->output,
                  (double)work->atlas_bytes / 1024, balls > 0 ? (double)work->atlas_bytes / balls : 0);
    (void)fprintf(out, "Cells   %ld, the finest of level %ld\n", (long)work->leaves, (long)work->level);
    (void)fprintf(out, "Work    %ld + %ld slices, %ld + %ld gluings (%ld + %ld by a triangulation of their own), %.1f MiB, %.3f s\n",
                  (long)work->slices[0], (long)work->slices[1], (long)work->gluings[0], (long)work->gluings[1],
                  (long)work->mixtures[0], (long)work->mixtures[1], (double)work->peak_bytes / (double)HOST_MIB, made->seconds);
    (void)fprintf(out, "Unit    %.6g\n", unit);
    if (made->atlas.side & CAGE_SIDE_INNER)
        print_side(out, &made->atlas, CAGE_SIDE_INNER, unit);
    if (made->atlas.side & CAGE_SIDE_OUTER)
        print_side(out, &made->atlas, CAGE_SIDE_OUTER, unit);
}

static void json_side(FILE *out, const char *name, const cage_atlas *atlas, int32_t side, double unit)
{
    const int32_t count = atlas->side & side ? atlas->classes[side == CAGE_SIDE_OUTER] : 0;
    int32_t i;
    int k;

    (void)fprintf(out, ",\n  \"%s\": [", name);
    for (i = 0; i < count; i++) {
        cage_class class;

        (void)cage_atlas_class(atlas, side, i, &class);
        (void)fprintf(out, "%s\n    {\"class\": %ld, \"bounded\": %s, \"cells\": %ld, \"components\": %ld", i > 0 ? "," : "", (long)i,
                      i > 0 ? "true" : "false", (long)class.cells, (long)class.nodes);
        for (k = 0; k < 2 * atlas->dim && i > 0; k++)
            (void)fprintf(out, "%s%.17g%s", k == 0 ? ", \"low\": [" : k == atlas->dim ? "], \"high\": [" : ", ",
                          (k < atlas->dim ? class.low[k] : class.high[k - atlas->dim]) * unit + 0.0,
                          k == 2 * atlas->dim - 1 ? "]" : "");
        (void)fprintf(out, "}");
    }
    (void)fprintf(out, "%s]", count > 0 ? "\n  " : "");
}

static void print_json(FILE *out, const built *made, double unit)
{
    const cage_survey_result *work = &made->work;

    (void)fprintf(out, "{\n  \"dim\": %ld,\n  \"unit\": %.17g,\n  \"bytes\": %llu,\n  \"level\": %ld,\n  \"cells\": %ld,\n",
                  (long)made->atlas.dim, unit, (unsigned long long)work->atlas_bytes, (long)work->level, (long)work->leaves);
    (void)fprintf(out, "  \"slices\": [%ld, %ld],\n  \"gluings\": [%ld, %ld],\n  \"balls\": [%lld, %lld],\n", (long)work->slices[0],
                  (long)work->slices[1], (long)work->gluings[0], (long)work->gluings[1], (long long)work->balls[0],
                  (long long)work->balls[1]);
    (void)fprintf(out, "  \"peak_bytes\": %llu,\n  \"seconds\": %.6f,\n  \"side\": %ld", (unsigned long long)work->peak_bytes, made->seconds, (long)made->atlas.side);
    json_side(out, "inner", &made->atlas, CAGE_SIDE_INNER, unit);
    json_side(out, "outer", &made->atlas, CAGE_SIDE_OUTER, unit);
    (void)fprintf(out, "\n}\n");
}

/* ---- narrow passages ------------------------------------------------------------------------------------ */

typedef struct passage {
    int32_t from, to; /* outer classes; to 0: the outside */
    cage_margin margin;
} passage;

/* The known pose of an outer class, in the user's frame; it is off by less than the outer side gives away. */
static int pose_of(const cage_atlas *atlas, int32_t class, double unit, cage_pose *pose)
{
    cage_class known;
    host_pose user;

    if (cage_atlas_class(atlas, CAGE_SIDE_OUTER, class, &known) != CAGE_OK || !known.known)
        return 0;
    host_from_grid(&known.pose, atlas->pivot, atlas->dim, unit, &user);
    return host_pose_to_grid(&user, unit, pose) == HOST_OK;
}

/* By shrinking all balls, between all pairs of the largest bounded outer classes, and from each to the outside. */
static int find_passages(const cage_scene *scene, const built *made, double unit, int32_t rounds, passage *list, int32_t *count,
                         host_error *error)
{
    row *rows = rows_of(&made->atlas, CAGE_SIDE_OUTER);
    size_t size = HOST_FIRST_BLOCK;
    void *block = host_take_block(&size, HOST_LEAST_BLOCK);
    const int32_t classes = made->atlas.classes[1];
    int32_t i, k, state = rows != NULL && block != NULL ? CAGE_OK : CAGE_ERROR_MEMORY;
    cage_limits limits;

    cage_limits_default(&limits, scene->dim);
    limits.max_cells = PASSAGE_CELLS;
    *count = 0;
    for (i = 0; state == CAGE_OK && i < classes && i <= MOST_PASSAGE_CLASSES; i++)
        for (k = 0; state == CAGE_OK && k < i; k++) {
            const int32_t from = rows[rows[i].number == 0 ? k : i].number, to = rows[rows[i].number == 0 ? i : k].number;
            cage_pose start, goal;

            if (!pose_of(&made->atlas, from, unit, &start) || (to > 0 && !pose_of(&made->atlas, to, unit, &goal)))
                continue;
            list[*count].from = from;
            list[*count].to = to;
            state = cage_margin_find(scene, &start, to > 0 ? &goal : NULL, &limits, rounds, block, size, &list[*count].margin);
            *count += state == CAGE_OK;
        }
    free(rows);
    free(block);
    return state == CAGE_OK ? HOST_OK : host_fail(error, state == CAGE_ERROR_MEMORY ? HOST_MEMORY : HOST_BAD_INPUT,
                                                  "--passages: %.200s", cage_error_text(state));
}

static void print_passages(FILE *out, const passage *list, int32_t count, const cage_atlas *atlas, double unit)
{
    int32_t i;

    (void)fprintf(out, "\nPassages: two outer classes join when every radius shrinks by (the first does not do, the second does)\n");
    for (i = 0; i < count; i++) {
        const cage_margin *margin = &list[i].margin;
        host_pose narrow;
        char to[16] = "the outside";

        if (list[i].to > 0)
            (void)snprintf(to, sizeof to, "%ld", (long)list[i].to);
        (void)fprintf(out, "  %5ld and %-11s  %.6g, %.6g", (long)list[i].from, to, margin->closed * unit, margin->open * unit);
        if (margin->known) {
            host_from_grid(&margin->narrow, margin->pivot, atlas->dim, unit, &narrow);
            (void)fprintf(out, "  at ");
            host_print_pose(out, &narrow);
        }
        (void)fprintf(out, "\n");
    }
}

/* ---- the command ---------------------------------------------------------------------------------------- */

static int read_scene(const options *given, host_query *query, host_grid *grid, host_error *error)
{
    double unit = 0;
    int code = HOST_OK;

    if (given->unit != NULL)
        code = host_blame(error, "--unit", host_parse_unit(given->unit, &unit, error));
    if (code == HOST_OK)
        code = host_read_balls(given->object, &query->object, error);
    if (code == HOST_OK)
        code = host_read_balls(given->obstacles, &query->obstacles, error);
    query->start.dim = query->object.dim != 0 ? query->object.dim : query->obstacles.dim != 0 ? query->obstacles.dim : 2;
    query->start.q[0] = 1;
    query->roomy = 1;
    if (code == HOST_OK)
        code = host_agree_on_dimension(query, error);
    if (code == HOST_OK && !given->quiet)
        host_warn_empty(given->object, given->obstacles, query);
    return code == HOST_OK ? host_to_grid(query, unit, grid, error) : code;
}

static int run(const options *given, host_query *query, host_grid *grid, built *made, host_error *error)
{
    passage passages[MOST_PASSAGES];
    cage_plan plan;
    size_t bytes = 0;
    int32_t count, rounds = 0;
    int code = HOST_OK;

    if (given->passages != NULL)
        code = host_blame(error, "--passages", host_parse_integer(given->passages, 0, 64, &rounds, error));
    if (code == HOST_OK && given->passages != NULL && given->json)
        code = host_fail(error, HOST_BAD_INPUT, "--passages: they are part of the table; there is none with --json");

    if (code == HOST_OK && given->memory != NULL)
        code = host_blame(error, "--memory", host_parse_bytes(given->memory, &bytes, error));
    if (code == HOST_OK)
        code = read_scene(given, query, grid, error);
    if (code == HOST_OK)
        code = read_plan(given, query->dim, grid->unit, &plan, error);
    if (code == HOST_OK)
        code = host_check_writable("-o", given->output, error);
    if (code == HOST_OK)
        code = host_check_writable("--c-header", given->header, error);
    if (code == HOST_OK)
        code = build(&grid->scene, &plan, given->memory != NULL ? &bytes : NULL, !given->quiet && isatty(STDERR_FILENO), made,
                     error);
    if (code == HOST_OK)
        code = write_atlas(given->output, made, error);
    if (code == HOST_OK && given->header != NULL)
        code = write_header(given->header, made, error);
    if (code == HOST_OK && given->json)
        print_json(stdout, made, grid->unit);
    else if (code == HOST_OK && !given->quiet)
        print_text(stdout, given, made, grid->unit);
    if (code == HOST_OK && given->passages != NULL) {
        code = find_passages(&grid->scene, made, grid->unit, rounds, passages, &count, error);
        if (code == HOST_OK)
            print_passages(stdout, passages, count, &made->atlas, grid->unit);
    }
    return code;
}

int host_atlas(int argc, char **argv)
{
    options given;
    host_query query;
    host_grid grid;
    host_error error;
    built made;
    int code;

    memset(&query, 0, sizeof query);
    memset(&grid, 0, sizeof grid);
    memset(&made, 0, sizeof made);
    code = read_options(argc, argv, &given, &error);
    if (code == HOST_OK)
        code = run(&given, &query, &grid, &made, &error);
    if (code != HOST_OK)
        (void)fprintf(stderr, "%s%s\n", error.located ? "" : "cage: ", error.text);
    free(made.block);
    free(made.bytes);
    host_free_grid(&grid);
    host_free_balls(&query.object);
    host_free_balls(&query.obstacles);
    return code;
}
