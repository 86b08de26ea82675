/* prove_command.c: "cage prove": options in, one proof, the answer out as text, JSON and picture. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "parts.h"
#include "picture.h"
#include "threads.h"

#define STEPS_A_TURN 32         /* between two looks at the clock */
#define STEPS_TOGETHER 1024     /* the same when threads work together */
#define ALONE 0.03              /* seconds before they do */
#define MOST_CELLS (1 << 24)    /* that the library takes as a limit */

typedef struct options {
    const char *object, *obstacles, *start, *goal, *svg, *ply;
    const char *side, *max_level, *max_cells, *memory, *unit, *threads, *margin, *path, *parts;
    int json, quiet, smooth, candidate;
} options;

void host_prove_help(FILE *out)
{
    cage_limits plane, space;

    cage_limits_default(&plane, 2);
    cage_limits_default(&space, 3);
    (void)fprintf(out,
        "usage: cage prove --object FILE --obstacles FILE --start POSE [--goal POSE] [OPTIONS]\n"
        "\n"
        "Can the object, a rigid union of balls, leave the obstacles, a fixed union of balls? With a\n"
        "goal: can it get there? The answer is a theorem about the balls given:\n"
        "\n"
        "  CAGED         no path leads from the start to arbitrarily far away\n"
        "  DISCONNECTED  no path joins start and goal\n"
        "  FREE          a path leads far away; it was found and checked\n"
        "  CONNECTED     a path joins start and goal; it was found and checked\n"
        "  IN_COLLISION  the start or the goal itself collides\n"
        "  UNDEFINED     a limit was reached first; the output says which\n"
        "\n"
        "  --object FILE     the object's balls, in the object's own frame\n"
        "  --obstacles FILE  the obstacles' balls\n"
        "  --start POSE      where the object is\n"
        "  --goal POSE       where it should go; without it: arbitrarily far away\n"
        "\n"
        "  FILE has one ball a line, \"x y r\" in the plane or \"x y z r\" in space, separated by white\n"
        "  space or commas; # starts a comment. POSE is x,y,degrees in the plane (counter-clockwise) or\n"
        "  x,y,z,qw,qx,qy,qz in space (a quaternion of any length): the object's point p goes to R p plus\n"
        "  (x,y) or (x,y,z). Balls may touch.\n"
        "\n"
        "  --parts FILE has one convex part a line: object or obstacle, a shape, and where it is in the object's frame\n"
        "  or in the world, if not at the origin: \"obstacle box 20 10 @ 5,0,30\". In the plane: box WIDTH HEIGHT, disc\n"
        "  RADIUS, capsule RADIUS LENGTH (straight, along x), hull X Y X Y X Y ...; in space: box X Y Z, cylinder RADIUS\n"
        "  LENGTH and capsule RADIUS LENGTH (along z), hull X Y Z ... All are about their middle, but hulls.\n"
        "\n");
    (void)fprintf(out,
        "options:\n"
        "  --side both|inner|outer  look for a proof of CAGED or DISCONNECTED (inner), for a path (outer),\n"
        "                           or for whichever exists (both, the default)\n"
        "  --max-level N   finest cells of rotations. In the plane 0 to %d (default %ld): level N has 2^(N+1)\n"
        "                  cells; in space 0 to %d (default %ld): 4 * 8^N\n"
        "  --max-cells N   cells made at most, up to %d (default %ld in the plane, %ld in space)\n"
        "  --memory BYTES  one block of this size and no more; K, M and G mean 1024, 1024^2, 1024^3.\n"
        "                  Without it the block is up to 1G, and grows to 4G when the proof needs it\n"
        "  --threads N     work on so many cores (default: all, with --memory one); the answer and its counts\n"
        "                  are the same. More than one take memory of their own as well, 4M to 256M each\n"
        "  --margin N      find out as well by how much every radius may shrink before the answer changes (negative:\n"
        "                  must grow), by N more proofs, each twice as close\n"
        "  --smooth        make the path short and smooth: it then moves and turns at once, and goes through its poses on\n"
        "                  a curve without corners that is certified as a whole (needs CHOLMOD: cage --help says whether\n"
        "                  it is there).\n"
        "                  An answer UNDEFINED becomes FREE or CONNECTED if a candidate can be smoothed so\n"
        "  --candidate     when it is UNDEFINED show a way that was not closed: its cells, its path, where it collides\n"
        "  --path FILE     write the path as CSV: the time from 0 to 1, the object's pose like POSE, where its pivot is\n"
        "  --parts FILE    look with the true shapes at the path, or at the candidate that is shown: do they collide anywhere\n"
        "                  on it? And do the balls lie inside them, and cover them? A check by samples, never part of a proof\n"
        "                  (needs libccd: cage --help says whether it is there)\n"
        "  --unit U        length of a grid unit (default: the finest power of two at which the scene\n"
        "                  fits). Balls between grid points are rounded to the safe side\n"
        "  --json          print one JSON object instead of text\n"
        "  --svg FILE      draw the answer: the region that the object's pivot can reach, or its path; in space\n"
        "                  from above, from the front and from the right\n"
        "  --ply FILE      in space: the same as a mesh with colours (ASCII PLY), which any viewer opens: obstacles\n"
        "                  grey, start blue, goal orange, path from violet to yellow, region as green dots\n"
        "  --quiet         text: the verdict only; no progress, no warnings\n"
        "  --help          this text\n"
        "\n"
        "The first line of the text is the verdict alone. The JSON object has verdict, reason, dim, unit,\n"
        "start, goal, level, cells, slices, gluings, steps, balls_inserted, peak_bytes, seconds, pivot and\n"
        "path, with --margin margin (a pair: shrunk by the first it is closed, by the second open; null: not\n"
        "known) and narrow (a pose). Pairs are [inner, outer]. A path is a list of poses like POSE; from each to the next the\n"
        "object moves on a straight line without turning, or turns the shorter way about its point pivot;\n"
        "where smooth is true it does both at once, as README says. --smooth adds smooth, length and\n"
        "found_length, --candidate and --parts objects of these names.\n"
        "Progress is shown on standard error when that is a terminal. Installed, this command is called\n"
        "cage-prove: \"cage-prove --object ...\" is \"cage prove --object ...\".\n"
        "\n"
        "exit status: 0 for any verdict, 2 for bad input (file:line: what is wrong), 3 when memory was too\n"
        "small (says how much to try).\n"
        "\n"
        "example:\n"
        "  cage prove --object examples/walls/plus.xyzr --obstacles examples/walls/walls_R4.xyzr \\\n"
        "             --start 185,195,45 --svg chamber.svg\n"
        "  cage prove --object examples/space/mug.xyzr --obstacles examples/space/hook.xyzr \\\n"
        "             --start 0,0,0,1,0,0,0 --ply mug.ply\n",
        CAGE_LEVEL_MAX_2D, (long)plane.max_level, CAGE_LEVEL_MAX_3D, (long)space.max_level, MOST_CELLS, (long)plane.max_cells,
        (long)space.max_cells);
}

/* ---- options -------------------------------------------------------------------------------------- */

static int read_options(int argc, char **argv, options *given, host_error *error)
{
    const host_option known[] = {
        { "--object", &given->object, NULL },       { "--obstacles", &given->obstacles, NULL },
        { "--start", &given->start, NULL },         { "--goal", &given->goal, NULL },
        { "--svg", &given->svg, NULL },             { "--side", &given->side, NULL },
        { "--max-level", &given->max_level, NULL }, { "--max-cells", &given->max_cells, NULL },
        { "--memory", &given->memory, NULL },       { "--unit", &given->unit, NULL },
        { "--ply", &given->ply, NULL },             { "--threads", &given->threads, NULL },
        { "--margin", &given->margin, NULL },       { "--path", &given->path, NULL },
        { "--parts", &given->parts, NULL },
        { "--smooth", NULL, &given->smooth },       { "--candidate", NULL, &given->candidate },
        { "--json", NULL, &given->json },           { "--quiet", NULL, &given->quiet },
    };
    int code;

    memset(given, 0, sizeof *given);
    code = host_read_options(argc, argv, "prove", known, sizeof known / sizeof known[0], NULL, error);
    if (code == HOST_OK && (given->object == NULL || given->obstacles == NULL || given->start == NULL))
        return host_fail(error, HOST_BAD_INPUT, "%s is missing (see cage prove --help)",
                         given->object == NULL ? "--object" : given->obstacles == NULL ? "--obstacles" : "--start");
    return code;
}

static int read_limits(const options *given, int32_t dim, cage_limits *limits, host_error *error)
{
    const int32_t finest = dim == 2 ? CAGE_LEVEL_MAX_2D : CAGE_LEVEL_MAX_3D, fewest = dim == 2 ? 2 : 4; /* cells of level 0 */
    int code = HOST_OK;

    cage_limits_default(limits, dim);
    code = host_parse_side(given->side, &limits->side, error);
    if (code == HOST_OK && given->max_level != NULL)
        code = host_blame(error, "--max-level",
                     host_parse_integer(given->max_level, 0, finest, &limits->max_level, error));
    if (code == HOST_OK && given->max_cells != NULL)
        code = host_blame(error, "--max-cells",
                     host_parse_integer(given->max_cells, fewest, MOST_CELLS, &limits->max_cells, error));
    return code;
}

/* ---- input ---------------------------------------------------------------------------------------- */

static int read_query(const options *given, host_query *query, host_error *error)
{
    int code = host_blame(error, "--start", host_parse_pose(given->start, &query->start, error));

    query->has_goal = given->goal != NULL;
    query->roomy = given->margin != NULL;
    if (code == HOST_OK && query->has_goal)
        code = host_blame(error, "--goal", host_parse_pose(given->goal, &query->goal, error));
    if (code == HOST_OK)
        code = host_read_balls(given->object, &query->object, error);
    if (code == HOST_OK)
        code = host_read_balls(given->obstacles, &query->obstacles, error);
    if (code == HOST_OK)
        code = host_agree_on_dimension(query, error);
    return code;
}

/* ---- the proof ------------------------------------------------------------------------------------ */

static void show_progress(const cage_result *result, double seconds)
{
    (void)fprintf(stderr, "\r%6.1f s  level %ld, %ld cells, %ld + %ld slices, %.0f MiB ", seconds,
                  (long)result->level, (long)result->cells, (long)result->slices[0], (long)result->slices[1],
                  (double)result->peak_bytes / (double)HOST_MIB);
    (void)fflush(stderr);
}

/* Runs to the end, after a while with threads. Returns the last answer of cage_prove_run. */
static int32_t run_proof(const host_answer *answer, int32_t threads, int progress, double begun)
{
    const cage_scene *scene = &answer->grid->scene;
    const uint64_t inner = (uint64_t)scene->object.inner_count * (uint64_t)scene->obstacles.inner_count;
    double shown = begun, seen;
    cage_workers workers;
    host_threads *crew = NULL;
    int32_t state;

    while ((state = cage_prove_run_with(answer->proof, crew ? STEPS_TOGETHER : STEPS_A_TURN, crew ? &workers : NULL)) == 0) {
        seen = host_now();
        if (crew == NULL && threads > 1 && seen - begun > ALONE) {
            crew = host_threads_start(threads, inner, &workers);
            threads = 1; /* once is enough */
        }
        if (progress && seen - shown > 0.1) {
            shown = seen;
            show_progress(cage_prove_result(answer->proof), shown - begun);
        }
    }
    host_threads_stop(crew);
    if (progress && shown > begun)
        (void)fprintf(stderr, "\r%78s\r", "");
    return state;
}

typedef struct job {
    host_answer *answer;
    int32_t threads;
    int progress;
} job;

static int32_t attempt(void *data, void *block, size_t bytes, uint64_t *needed)
{
    const job *todo = data;
    host_answer *answer = todo->answer;
    const host_grid *grid = answer->grid;
    double begun = host_now();
    int32_t state;

    answer->proof = NULL;
    state = cage_prove_begin(&answer->proof, &grid->scene, &grid->start,
                             answer->query->has_goal ? &grid->goal : NULL, answer->limits, block, bytes);
    if (state == CAGE_OK) {
        state = run_proof(answer, todo->threads, todo->progress, begun);
        answer->result = cage_prove_result(answer->proof);
        *needed = answer->result->needed_bytes;
    }
    answer->seconds = host_now() - begun;
    return state < 0 ? state : CAGE_OK;
}

/* ---- the answer ----------------------------------------------------------------------------------- */

static int check_path(const host_answer *answer, host_error *error)
{
    const cage_result *result = answer->result;
    const host_grid *grid = answer->grid;

    if (result->verdict != CAGE_FREE && result->verdict != CAGE_CONNECTED)
        return HOST_OK;
    if (cage_path_check(&grid->scene, &grid->start, answer->query->has_goal ? &grid->goal : NULL, result->pivot,
                        result->path, result->path_count) == 1)
        return HOST_OK;
    return host_fail(error, HOST_BROKEN,
                     "the path found does not pass the independent check. This is a bug; please report the input");
}

/* Pictures in space show where the pivot stays; it is looked for once. No memory for it is no error. */
static int draw(const options *given, host_answer *answer, host_error *error)
{
    picture_cloud cloud = { { 0, 0, 0 }, 1, { 0, 0, 0 }, NULL };
    int code = HOST_OK;

    if (answer->query->dim == 3 && picture_stuck(answer->result) && (given->svg != NULL || given->ply != NULL) &&
        picture_find_cloud(answer, &cloud) == 0)
        answer->cloud = &cloud;
    if (given->svg != NULL)
        code = host_write_svg(given->svg, answer, error);
    if (code == HOST_OK && given->ply != NULL)
        code = host_write_ply(given->ply, answer, error);
    answer->cloud = NULL;
    free(cloud.mask);
    return code;
}

/* Proofs of scenes with other radii, in a block of their own. */
static int find_margin(const host_answer *answer, int32_t rounds, cage_margin *margin, host_error *error)
{
    const host_grid *grid = answer->grid;
    size_t size = HOST_FIRST_BLOCK;
    void *block = host_take_block(&size, HOST_LEAST_BLOCK);
    int32_t state = CAGE_ERROR_MEMORY;

    if (block != NULL)
        state = cage_margin_find(&grid->scene, &grid->start, answer->query->has_goal ? &grid->goal : NULL, answer->limits,
                                 rounds, block, size, margin);
    free(block);
    return state == CAGE_OK ? HOST_OK : host_fail(error, state == CAGE_ERROR_MEMORY ? HOST_MEMORY : HOST_BAD_INPUT,
                                                  "--margin: %.200s", cage_error_text(state));
}

/* A path that is found is made smooth, and stands for the one that was; a candidate, if it becomes a path. */
static int smooth_path(host_answer *answer, const host_candidate *candidate, cage_result *result, host_way *way,
                       host_error *error)
{
    const int found = answer->result->path_count > 0;
    int code = HOST_OK;

    if (!found && candidate->count < 2)
        return HOST_OK;
    *result = *answer->result;
    if (found)
        code = host_smooth(answer, result->path, result->path_count, 1, way, error);
    else
        code = host_smooth(answer, candidate->pose, candidate->count, 0, way, error);
    if (code != HOST_OK || way->count == 0)
        return code;
    result->path = way->pose;
    result->path_count = way->count;
    if (!found) {
        result->verdict = answer->query->has_goal ? CAGE_CONNECTED : CAGE_FREE;
        result->reason = CAGE_REASON_PATH;
    }
    answer->result = result;
    answer->way = way;
    answer->candidate = NULL; /* there is a path now */
    return check_path(answer, error);
}

static int find_candidate(const options *given, host_answer *answer, host_candidate *candidate, host_error *error)
{
    int code = HOST_OK;

    if (answer->result->verdict == CAGE_UNDEFINED)
        code = host_find_candidate(answer, candidate, error);
    if (code == HOST_OK && given->candidate && candidate->count > 0) {
        code = host_look_at_candidate(answer, candidate, error);
        answer->candidate = candidate;
    }
    return code;
}

/* A path as it was found, or smoothed, to a file; without one the file is empty but for its header. */
static int write_path(const char *file, const host_answer *answer, host_error *error)
{
    host_way way;

    memset(&way, 0, sizeof way);
    way.count = answer->result->path_count;
    way.pose = (cage_pose *)answer->result->path;
    return host_write_way(file, answer, answer->way != NULL ? answer->way : &way, error);
}

/* What show_answer makes, and run frees. */
typedef struct findings {
    host_way way;
    host_candidate candidate;
    host_parts parts;
    parts_check check;
} findings;

static int show_answer(const options *given, host_answer *answer, findings *found, host_error *error)
{
    cage_margin margin;
    cage_result smoothed;
    int32_t rounds;
    int code = check_path(answer, error);

    if (code == HOST_OK && (given->smooth || given->candidate))
        code = find_candidate(given, answer, &found->candidate, error);
    if (code == HOST_OK && given->smooth)
        code = smooth_path(answer, &found->candidate, &smoothed, &found->way, error);
    if (code == HOST_OK && given->path != NULL)
        code = write_path(given->path, answer, error);
    if (code == HOST_OK && given->parts != NULL) {
        code = host_check_parts(answer, &found->parts, &found->check, error);
        answer->parts = &found->check;
    }
    if (code == HOST_OK && given->margin != NULL)
        code = host_blame(error, "--margin", host_parse_integer(given->margin, 0, 64, &rounds, error));
    if (code == HOST_OK && given->margin != NULL)
        code = find_margin(answer, rounds, &margin, error);
    if (given->margin != NULL)
        answer->margin = &margin;
    if (code == HOST_OK)
        code = draw(given, answer, error);
    if (code != HOST_OK)
        return code;
    if (given->json)
        host_report_json(stdout, answer);
    else if (given->quiet)
        (void)printf("%s\n", cage_verdict_text(answer->result->verdict));
    else
        host_report_text(stdout, answer);
    return HOST_OK;
}

static int run(const options *given, host_query *query, host_grid *grid, void **block, host_error *error)
{
    host_answer answer;
    findings found;
    cage_limits limits;
    job todo;
    double unit = 0;
    size_t bytes = 0;
    int32_t threads = given->memory != NULL ? 1 : host_threads_cores();
    int progress = !given->quiet && isatty(STDERR_FILENO);
    int code = HOST_OK;

    if (given->unit != NULL)
        code = host_blame(error, "--unit", host_parse_unit(given->unit, &unit, error));
    if (code == HOST_OK && given->memory != NULL)
        code = host_blame(error, "--memory", host_parse_bytes(given->memory, &bytes, error));
    if (code == HOST_OK && given->threads != NULL)
        code = host_blame(error, "--threads", host_parse_integer(given->threads, 1, 64, &threads, error));
    if (code == HOST_OK)
        code = read_query(given, query, error);
    if (code == HOST_OK && given->ply != NULL && query->dim != 3)
        code = host_fail(error, HOST_BAD_INPUT, "--ply: a mesh is of a scene in space, and this one is in the plane (see --svg)");
    if (code == HOST_OK)
        code = host_check_writable("--svg", given->svg, error);
    if (code == HOST_OK)
        code = host_check_writable("--ply", given->ply, error);
    if (code == HOST_OK)
        code = host_check_writable("--path", given->path, error);
    if (code == HOST_OK && given->smooth && !smooth_metric_available())
        code = host_fail(error, HOST_BAD_INPUT, "--smooth: this build is without CHOLMOD (see the README)");
    if (code == HOST_OK)
        code = read_limits(given, query->dim, &limits, error);
    if (code == HOST_OK)
        code = host_to_grid(query, unit, grid, error);
    if (code == HOST_OK && given->parts != NULL && !host_parts_available())
        code = host_fail(error, HOST_BAD_INPUT, "--parts: this build is without libccd (see the README)");
    if (code != HOST_OK)
        return code;
    memset(&found, 0, sizeof found);
    if (given->parts != NULL && (code = host_read_parts(given->parts, query->dim, &found.parts, error)) != HOST_OK) {
        host_free_parts(&found.parts);
        return code;
    }
    if (!given->quiet)
        host_warn_empty(given->object, given->obstacles, query);
    memset(&answer, 0, sizeof answer);
    answer.query = query;
    answer.grid = grid;
    answer.limits = &limits;
    todo.answer = &answer;
    todo.threads = threads;
    todo.progress = progress;
    code = host_in_block(4 * cage_prove_size(&grid->scene, &limits), given->memory != NULL ? &bytes : NULL, attempt, &todo, block,
                         "query", error);
    if (code == HOST_OK)
        code = show_answer(given, &answer, &found, error);
    host_free_way(&found.way);
    host_free_candidate(&found.candidate);
    host_free_parts(&found.parts);
    host_free_check(&found.check);
    return code;
}

int host_prove(int argc, char **argv)
{
    options given;
    host_query query;
    host_grid grid;
    host_error error;
    void *block = NULL;
    int code;

    memset(&query, 0, sizeof query);
    memset(&grid, 0, sizeof grid);
    code = read_options(argc, argv, &given, &error);
    if (code == HOST_OK)
        code = run(&given, &query, &grid, &block, &error);
    if (code != HOST_OK)
        (void)fprintf(stderr, "%s%s\n", error.located ? "" : "cage: ", error.text);
    free(block);
    host_free_grid(&grid);
    host_free_balls(&query.object);
    host_free_balls(&query.obstacles);
    return code;
}
