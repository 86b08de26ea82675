/* atlas_build.c: builds an atlas, keeps on disk what was found out when that takes long, and goes on from it. */
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "atlas_host.h"
#include "threads.h"

#define STEPS_A_TURN 64     /* between two looks at the clock */
#define STEPS_TOGETHER 1024 /* the same when threads work together */
#define KEEP_AFTER 2.0      /* seconds between two writings of facts, */
#define KEEP_SHARE 20       /* and so many times what a writing takes */

typedef struct job {
    const cage_scene *scene;
    const cage_plan *plan;
    host_built *made;
    char *path; /* of the facts */
    int quiet;
    double kept;     /* when facts were written last */
    double cost;     /* seconds it took */
} job;

static volatile sig_atomic_t interrupted;

static void interrupt(int number)
{
    (void)number;
    interrupted = 1;
}

/* The name of the file of facts beside that; null without memory. */
static char *facts_path(const char *path)
{
    const size_t length = strlen(path);
    char *name = malloc(length + 7);

    if (name != NULL) {
        memcpy(name, path, length);
        memcpy(name + length, ".facts", 7);
    }
    return name;
}

void host_forget_facts(const char *path, const host_built *made)
{
    char *name = made->kept ? facts_path(path) : NULL;

    if (name != NULL)
        (void)remove(name);
    free(name);
}

/* ---- what is shown -------------------------------------------------------------------------------------- */

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

/* ---- facts ---------------------------------------------------------------------------------------------- */

/* Without memory for them there are none. */
static void take_facts(const cage_survey *survey, host_built *made)
{
    free(made->facts);
    made->facts_size = cage_survey_facts(survey, NULL, 0);
    made->facts = malloc(made->facts_size);
    if (made->facts != NULL)
        (void)cage_survey_facts(survey, made->facts, made->facts_size);
}

/* That they cannot be written does not stop the build. */
static void keep_facts(job *todo, const cage_survey *survey)
{
    host_built *made = todo->made;
    const double begun = host_now();
    host_error error;

    take_facts(survey, made);
    if (made->facts != NULL && host_write_whole(todo->path, made->facts, made->facts_size, &error) == HOST_OK)
        made->kept = 1;
    todo->kept = host_now();
    todo->cost = todo->kept - begun;
}

/* Those of an attempt before, or of a build before; what does not fit is passed by. */
static int32_t learn(job *todo, cage_survey *survey)
{
    host_built *made = todo->made;
    const int on_disk = made->facts == NULL;
    host_error error;
    int32_t state;

    if (on_disk && (access(todo->path, R_OK) != 0 ||
                    host_read_whole(todo->path, &made->facts, &made->facts_size, &error) != HOST_OK)) {
        free(made->facts);
        made->facts = NULL;
        return CAGE_OK;
    }
    state = cage_survey_learn(survey, made->facts, made->facts_size);
    if (state == CAGE_OK && on_disk && !todo->quiet)
        (void)fprintf(stderr, "cage: going on from %s\n", todo->path);
    if (state == CAGE_ERROR_ATLAS && !todo->quiet)
        (void)fprintf(stderr, "cage: warning: %s is of another scene, other options or another version: not used\n", todo->path);
    made->resumed |= state == CAGE_OK;
    made->kept |= state == CAGE_OK && on_disk;
    if (state != CAGE_ERROR_ATLAS)
        return state;
    free(made->facts);
    made->facts = NULL;
    return CAGE_OK;
}

/* ---- the survey ----------------------------------------------------------------------------------------- */

/* Runs until it is finished, fails, or is interrupted (0). */
static int32_t run(job *todo, cage_survey *survey, double begun)
{
    const cage_scene *scene = todo->scene;
    const uint64_t pairs = (uint64_t)scene->object.outer_count * (uint64_t)scene->obstacles.outer_count;
    const int progress = !todo->quiet && isatty(STDERR_FILENO);
    double shown = begun;
    cage_workers workers;
    host_threads *crew = todo->made->threads > 1 ? host_threads_start(todo->made->threads, pairs, &workers) : NULL;
    int32_t state;

    while (!interrupted &&
           (state = cage_survey_run_with(survey, crew ? STEPS_TOGETHER : STEPS_A_TURN, crew ? &workers : NULL)) == 0) {
        const double now = host_now();

        if (progress && now - shown > 0.1) {
            shown = now;
            show_progress(cage_survey_result_of(survey), now - begun);
        }
        if (now - todo->kept > KEEP_AFTER && now - todo->kept > KEEP_SHARE * todo->cost)
            keep_facts(todo, survey);
    }
    host_threads_stop(crew);
    if (progress && shown > begun)
        (void)fprintf(stderr, "\r%90s\r", "");
    return interrupted ? 0 : state;
}

static int32_t attempt(void *data, void *block, size_t bytes, uint64_t *needed)
{
    job *todo = data;
    host_built *made = todo->made;
    const double begun = host_now();
    cage_survey *survey;
    int32_t state = cage_survey_begin(&survey, todo->scene, todo->plan, block, bytes);
    size_t size;

    if (state != CAGE_OK)
        return state;
    todo->kept = begun;
    state = learn(todo, survey);
    if (state == CAGE_OK)
        state = run(todo, survey, begun);
    made->work = *cage_survey_result_of(survey);
    *needed = made->work.needed_bytes;
    if (state == CAGE_ERROR_MEMORY && made->work.steps > 0) {
        take_facts(survey, made);
        made->resumed = made->facts != NULL;
    }
    if (state == 0)
        keep_facts(todo, survey);
    if (state <= 0)
        return state;
    size = (size_t)made->work.atlas_bytes;
    made->bytes = malloc(size);
    if (made->bytes == NULL || cage_survey_atlas(survey, made->bytes, size) != size)
        return CAGE_ERROR_MEMORY;
    made->seconds = host_now() - begun;
    return cage_atlas_open(&made->atlas, made->bytes, size);
}

int host_build_atlas(const cage_scene *scene, const cage_plan *plan, const size_t *bytes, const char *path, int quiet,
                     host_built *made, host_error *error)
{
    job todo = { scene, plan, made, facts_path(path), quiet, 0, 0 };
    struct sigaction catch, before[2];
    int code;

    if (todo.path == NULL)
        return host_fail(error, HOST_MEMORY, "no memory for a file name");
    memset(&catch, 0, sizeof catch);
    catch.sa_handler = interrupt;
    (void)sigaction(SIGINT, &catch, &before[0]);
    (void)sigaction(SIGTERM, &catch, &before[1]);
    code = host_in_block(cage_survey_size(scene, plan), bytes, attempt, &todo, &made->block, "scene", error);
    (void)sigaction(SIGINT, &before[0], NULL);
    (void)sigaction(SIGTERM, &before[1], NULL);
    if (code == HOST_OK && made->bytes == NULL)
        code = made->kept ? host_fail(error, HOST_INTERRUPTED, "interrupted: the same command goes on from %.600s", todo.path)
                          : host_fail(error, HOST_INTERRUPTED, "interrupted, and %.600s cannot be written", todo.path);
    free(todo.path);
    return code;
}
