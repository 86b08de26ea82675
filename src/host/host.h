/* host.h: what the files of the command share: text to balls, balls to grid, answers to text and pictures. */
#ifndef CAGE_HOST_H
#define CAGE_HOST_H

#include <stdint.h>
#include <stdio.h>

#include "cage.h"

/* Exit codes of the command. */
#define HOST_OK 0
#define HOST_BROKEN 1    /* a path found by the search failed the independent check: a bug */
#define HOST_BAD_INPUT 2 /* the message says where */
#define HOST_MEMORY 3    /* the message says how much was needed */
#define HOST_INTERRUPTED 130 /* by SIGINT or SIGTERM */

/* Larger numbers are refused, so that sums and squares of what was read are finite. */
#define HOST_LARGEST 1e150

/* What went wrong, for a person. Functions below that take one return HOST_OK or the exit code. */
typedef struct host_error {
    char text[1024];
    int located; /* the text begins with file:line or file */
} host_error;

typedef struct host_ball {
    double x[3]; /* z is 0 in the plane */
    double r;
} host_ball;

typedef struct host_balls {
    host_ball *ball;
    int32_t count;
    int32_t dim; /* 2 or 3; 0 while there is no ball */
} host_balls;

/* A pose as given: degrees in the plane, a quaternion (w, x, y, z) in space. */
typedef struct host_pose {
    double x[3];
    double degrees;
    double q[4];
    int32_t dim;
} host_pose;

/* One query in the user's numbers. */
typedef struct host_query {
    host_balls object;
    host_balls obstacles;
    host_pose start;
    host_pose goal;
    int has_goal;
    int32_t dim;
    int roomy; /* the grid has room for a scene twice as large, or poses twice as far out */
} host_query;

/* The same query on the grid: what is proved. */
typedef struct host_grid {
    cage_scene scene;
    cage_pose start;
    cage_pose goal;
    double unit;     /* length of one grid unit */
    int32_t rounded; /* balls whose inner and outer ball differ */
    int32_t dropped; /* balls too small for an inner one */
    cage_ball *balls[4];
} host_grid;

/* An answer and what is needed to show it. */
typedef struct host_answer {
    const host_query *query;
    const host_grid *grid;
    const cage_limits *limits;
    const cage_result *result;
    cage_proof *proof;
    double seconds;
    const cage_margin *margin; /* null where it was not asked for */
    const struct host_way *way; /* the path, made smooth; or null (smooth.h) */
    const struct host_candidate *candidate; /* a way that nothing is proved of; or null (smooth.h) */
    const struct parts_check *parts; /* what true shapes say of these; or null (parts.h) */
    const struct picture_cloud *cloud; /* where the pivot can be (in the plane looked for by who draws), or null (picture.h) */
    const char *name, *title;          /* of a picture; null: its verdict, and what that means */
} host_answer;

/* ---- options.c -------------------------------------------------------------------------------- */

#define HOST_MIB ((size_t)1 << 20)
#define HOST_FIRST_BLOCK (1024 * HOST_MIB) /* asked for where --memory is not given; if it is not to be had, less, down to */
#define HOST_LEAST_BLOCK (64 * HOST_MIB)
#define HOST_LARGEST_BLOCK (SIZE_MAX / HOST_MIB > 4096 ? 4096 * HOST_MIB : SIZE_MAX / 2) /* it grows to this */

/* An option with a value, or (value null) a flag. */
typedef struct host_option {
    const char *name;
    const char **value; /* null before it is read */
    int *flag;
} host_option;

/* "--name value", "--name=value", "--flag", and if wanted one operand. */
int host_read_options(int argc, char **argv, const char *command, const host_option *known, size_t count, const char **operand,
                      host_error *error);

/* Puts the option's name before what was wrong with its value. */
int host_blame(host_error *error, const char *option, int code);

/* inner, outer or both; null means both. */
int host_parse_side(const char *text, int32_t *side, host_error *error);

/* The dimension on which all parts agree; a file without balls fits any. */
int host_agree_on_dimension(host_query *query, host_error *error);

void host_warn_empty(const char *object, const char *obstacles, const host_query *query);

/* Better before long work than after it. Makes no file. */
int host_check_writable(const char *option, const char *path, host_error *error);

/* Two options (or null) that name one file. */
int host_check_apart(const char *option, const char *path, const char *other, host_error *error);

/* Reads all of a file; the caller frees *bytes, whatever the outcome. */
int host_read_whole(const char *path, unsigned char **bytes, size_t *size, host_error *error);

/* Writes all of a file beside its place, and then moves it there: there is never half of it. What is no file is written to. */
int host_write_whole(const char *path, const unsigned char *bytes, size_t size, host_error *error);

/* Seconds, from any beginning. */
double host_now(void);

/* A block of the size, or of less if it need not be all of it; null if none of at least that is to be had. */
void *host_take_block(size_t *size, size_t least);

/* One attempt in a block of that size: CAGE_OK, or an error; *needed is then a block that gets further. */
typedef int32_t host_attempt(void *data, void *block, size_t bytes, uint64_t *needed);

/* Attempts in a block of the size given, or (bytes null) in one that grows from the size wanted until it is large enough.
 * The block is the caller's to free, whatever the outcome; subject: what an error says was not accepted. */
int host_in_block(size_t wanted, const size_t *bytes, host_attempt *attempt, void *data, void **block, const char *subject,
                  host_error *error);

/* ---- number.c --------------------------------------------------------------------------------- */

int host_fail(host_error *error, int code, const char *format, ...)
#if defined(__GNUC__)
    __attribute__((format(printf, 3, 4)))
#endif
    ;

/* The numbers in a text, separated by white space or one comma; at most capacity are stored. Returns
 * how many there are, or -1 and why. */
int host_columns(const char *text, double *value, int capacity, host_error *why);

int host_parse_pose(const char *text, host_pose *pose, host_error *why);
int host_parse_unit(const char *text, double *unit, host_error *why);
int host_parse_integer(const char *text, int32_t low, int32_t high, int32_t *value, host_error *why);
/* A whole number of bytes, or one with the suffix K, M or G (times 1024, 1024^2, 1024^3). */
int host_parse_bytes(const char *text, size_t *bytes, host_error *why);

/* ---- balls_file.c ------------------------------------------------------------------------------ */

/* Reads one ball a line, "x y r" or "x y z r". On success the caller frees with host_free_balls. */
int host_read_balls(const char *path, host_balls *balls, host_error *error);
void host_free_balls(host_balls *balls);

/* ---- convert.c --------------------------------------------------------------------------------- */

/* unit 0: the finest power of two that fits. The caller frees with host_free_grid, whatever the outcome. */
int host_to_grid(const host_query *query, double unit, host_grid *grid, host_error *error);
void host_free_grid(host_grid *grid);

/* A pose on the grid; HOST_BAD_INPUT if it is beyond it. */
int host_pose_to_grid(const host_pose *pose, double unit, cage_pose *result);

/* The pose in the user's numbers. pivot null: x is where the object's origin is; else x is where
 * the point pivot of the object is, and the result is where its origin is. */
void host_from_grid(const cage_pose *pose, const int32_t *pivot, int32_t dim, double unit,
                    host_pose *result);

/* A pose in the user's numbers, as for --start. */
void host_print_pose(FILE *out, const host_pose *pose);

/* Where a pose puts a point of the object (both in grid units), in the user's numbers. */
void host_place(const cage_pose *pose, const int32_t point[3], double unit, double result[3]);

/* ---- report.c ---------------------------------------------------------------------------------- */
void host_report_text(FILE *out, const host_answer *answer);
void host_report_json(FILE *out, const host_answer *answer);

/* ---- svg.c -------------------------------------------------------------------------------------- */
int host_write_svg(const char *path, const host_answer *answer, host_error *error);

/* ---- ply.c, in space only ------------------------------------------------------------------------ */
int host_write_ply(const char *path, const host_answer *answer, host_error *error);

/* ---- atlas_command.c, query_command.c ------------------------------------------------------------ */
int host_atlas(int argc, char **argv);
void host_atlas_help(FILE *out);
int host_query_command(int argc, char **argv);
void host_query_help(FILE *out);

/* ---- prove_command.c --------------------------------------------------------------------------- */
int host_prove(int argc, char **argv);
void host_prove_help(FILE *out);

#endif
