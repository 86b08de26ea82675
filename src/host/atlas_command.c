/* atlas_command.c: "cage atlas": options in, the atlas out as a file, its classes as a table or as JSON. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "atlas_host.h"
#include "threads.h"

#define MOST_CELLS (1 << 24)
#define FINEST_3D 7 /* with so many */
#define HALVINGS_2D 7 /* of boxes, to bound volumes */
#define HALVINGS_3D 4

typedef struct options {
    const char *object, *obstacles, *output, *header, *side, *level, *budget, *memory, *unit, *passages, *threads;
    const char *volumes, *svg, *ply;
    int json, quiet;
} options;

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
        "  --threads N       work on so many cores (default: all, with --memory one); the atlas is the same\n"
        "  --unit U          length of a grid unit (default: the finest power of two at which the scene fits)\n"
        "  --volumes N       the bounds of volumes from boxes down to 1/2^N of the class (0 to 20, default %d, in space %d):\n"
        "                    the volume of a class is that of its translations, averaged over all rotations\n"
        "  --svg DIR         a picture of each large bounded class, as DIR/inner-N.svg and DIR/outer-N.svg\n"
        "  --ply DIR         in space: the same as meshes (ASCII PLY)\n"
        "  --passages N      for each large bounded outer class: by how much every radius must shrink for it to open into\n"
        "                    the outside, or into another one, and where; by N proofs for each pair (takes a while)\n"
        "  --c-header FILE   write the atlas as a C array as well, for a firmware build\n"
        "  --json            print one JSON object instead of the table\n"
        "  --quiet           print nothing; no progress, no warnings\n"
        "  --help            this text\n"
        "\n"
        "A build that takes longer keeps what it has found out in FILE.facts, and does so when it is interrupted: the same\n"
        "command then goes on from there, to the same atlas, and removes it.\n"
        "\n"
        "exit status: 0, 2 for bad input, 3 when memory was too small (says how much to try), 130 when interrupted.\n"
        "\n"
        "example:\n"
        "  cage atlas --object examples/walls/plus.xyzr --obstacles examples/walls/walls_R4.xyzr -o walls.atlas\n"
        "  cage query walls.atlas --at 185,195,45\n",
        CAGE_LEVEL_MAX_2D, FINEST_3D, HALVINGS_2D, HALVINGS_3D);
}

static int read_options(int argc, char **argv, options *given, host_error *error)
{
    const host_option known[] = {
        { "--object", &given->object, NULL }, { "--obstacles", &given->obstacles, NULL },
        { "-o", &given->output, NULL },       { "--c-header", &given->header, NULL },
        { "--side", &given->side, NULL },     { "--level", &given->level, NULL },
        { "--budget", &given->budget, NULL }, { "--memory", &given->memory, NULL },
        { "--unit", &given->unit, NULL },     { "--passages", &given->passages, NULL },
        { "--threads", &given->threads, NULL }, { "--volumes", &given->volumes, NULL },
        { "--svg", &given->svg, NULL },       { "--ply", &given->ply, NULL },
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
    const int32_t finest = dim == 2 ? CAGE_LEVEL_MAX_2D : FINEST_3D, children = dim == 2 ? 2 : 8;
    int32_t level, least = dim == 2 ? 2 : 4, cells = least;
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
    for (level = 0; level < plan->level; level++)
        least += cells *= children; /* < 2^25 */
    if (code == HOST_OK && plan->max_cells > 0 && plan->max_cells < least)
        return host_fail(error, HOST_BAD_INPUT, "--budget: down to level %ld there are %ld cells", (long)plan->level,
                         (long)least);
    return code;
}

/* ---- files ---------------------------------------------------------------------------------------------- */

static int write_header(const char *path, const host_built *made, host_error *error)
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

static int run(const options *given, host_query *query, host_grid *grid, host_built *made, host_error *error)
{
    cage_plan plan;
    size_t bytes = 0;
    int32_t rounds = 0, halvings = -1;
    host_passages passages, *told = given->passages != NULL ? &passages : NULL;
    int code = HOST_OK;

    if (given->passages != NULL)
        code = host_blame(error, "--passages", host_parse_integer(given->passages, 0, 64, &rounds, error));
    if (code == HOST_OK && given->volumes != NULL)
        code = host_blame(error, "--volumes", host_parse_integer(given->volumes, 0, 20, &halvings, error));
    made->threads = given->memory != NULL ? 1 : host_threads_cores();
    if (code == HOST_OK && given->threads != NULL)
        code = host_blame(error, "--threads", host_parse_integer(given->threads, 1, 64, &made->threads, error));
    if (code == HOST_OK && given->memory != NULL)
        code = host_blame(error, "--memory", host_parse_bytes(given->memory, &bytes, error));
    if (code == HOST_OK)
        code = read_scene(given, query, grid, error);
    if (code == HOST_OK && given->ply != NULL && query->dim != 3)
        code = host_fail(error, HOST_BAD_INPUT, "--ply: a mesh is of a scene in space, and this one is in the plane (see --svg)");
    if (code == HOST_OK)
        code = read_plan(given, query->dim, grid->unit, &plan, error);
    if (code == HOST_OK)
        code = host_check_writable("-o", given->output, error);
    if (code == HOST_OK)
        code = host_check_writable("--c-header", given->header, error);
    if (code == HOST_OK)
        code = host_check_apart("-o", given->output, given->object, error);
    if (code == HOST_OK)
        code = host_check_apart("-o", given->output, given->obstacles, error);
    if (code == HOST_OK)
        code = host_check_apart("--c-header", given->header, given->output, error);
    if (code == HOST_OK)
        code = host_check_apart("--c-header", given->header, given->object, error);
    if (code == HOST_OK)
        code = host_check_apart("--c-header", given->header, given->obstacles, error);
    if (code == HOST_OK)
        code = host_build_atlas(&grid->scene, &plan, given->memory != NULL ? &bytes : NULL, given->output, given->quiet, made,
                                error);
    if (code == HOST_OK)
        code = host_write_whole(given->output, made->bytes, (size_t)made->work.atlas_bytes, error);
    if (code == HOST_OK)
        host_forget_facts(given->output, made);
    if (code == HOST_OK && given->header != NULL)
        code = write_header(given->header, made, error);
    if (code == HOST_OK && told != NULL)
        code = host_find_passages(&grid->scene, made, grid->unit, rounds, given->memory != NULL ? &bytes : NULL, told, error);
    if (code == HOST_OK && (given->svg != NULL || given->ply != NULL))
        code = host_draw_classes(given->svg, given->ply, query, grid, made, error);
    if (halvings < 0)
        halvings = query->dim == 2 ? HALVINGS_2D : HALVINGS_3D;
    if (code == HOST_OK && given->json)
        host_report_atlas_json(stdout, made, grid->unit, halvings, told);
    else if (code == HOST_OK && !given->quiet)
        host_report_atlas(stdout, given->output, made, grid->unit, halvings, told);
    return code;
}

int host_atlas(int argc, char **argv)
{
    options given;
    host_query query;
    host_grid grid;
    host_error error;
    host_built made;
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
    free(made.facts);
    host_free_grid(&grid);
    host_free_balls(&query.object);
    host_free_balls(&query.obstacles);
    return code;
}
