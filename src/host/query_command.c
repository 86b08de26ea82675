/* query_command.c: "cage query": an atlas and poses in, verdicts out. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "host.h"

typedef struct options {
    const char *file, *at, *to;
    int json;
} options;

void host_query_help(FILE *out)
{
    (void)fprintf(out,
        "usage: cage query FILE --at POSE [--to POSE] [--json]\n"
        "       cage query FILE [--json] < POSES\n"
        "\n"
        "Asks an atlas that cage atlas wrote: can the object leave that pose? With --to: can it get from one to\n"
        "the other? The answers are those of cage prove, but for paths: CAGED, DISCONNECTED, FREE, CONNECTED,\n"
        "IN_COLLISION, or UNDEFINED where the atlas is too coarse.\n"
        "\n"
        "Without --at poses are read from standard input, one a line, or two separated by white space (from, to); the\n"
        "verdicts come one a line, in the same order. # starts a comment, empty lines are skipped.\n"
        "\n"
        "  POSE              x,y,degrees in the plane, x,y,z,qw,qx,qy,qz in space, with commas and no blanks\n"
        "  --json            one JSON object a line: verdict, and the classes of the poses, [inner, outer], null\n"
        "                    where balls cover them or the atlas has no such side\n"
        "  --help            this text\n"
        "\n"
        "exit status: 0 for any verdict, 2 for bad input.\n");
}

static int read_options(int argc, char **argv, options *given, host_error *error)
{
    const host_option known[] = {
        { "--at", &given->at, NULL },
        { "--to", &given->to, NULL },
        { "--json", NULL, &given->json },
    };
    int code;

    memset(given, 0, sizeof *given);
    code = host_read_options(argc, argv, "query", known, sizeof known / sizeof known[0], &given->file, error);
    if (code == HOST_OK && (given->file == NULL || (given->to != NULL && given->at == NULL)))
        return host_fail(error, HOST_BAD_INPUT, "%s is missing (see cage query --help)", given->file == NULL ? "FILE" : "--at");
    return code;
}

/* ---- one question --------------------------------------------------------------------------------------- */

static int read_pose(const cage_atlas *atlas, double unit, const char *text, cage_pose *pose, host_error *error)
{
    host_pose given;
    int code = host_parse_pose(text, &given, error);

    if (code != HOST_OK)
        return code;
    if (given.dim != atlas->dim)
        return host_fail(error, HOST_BAD_INPUT, "the atlas has %d dimensions: a pose is %s", (int)atlas->dim,
                         atlas->dim == 2 ? "x,y,degrees" : "x,y,z,qw,qx,qy,qz");
    if (host_pose_to_grid(&given, unit, pose) != HOST_OK)
        return host_fail(error, HOST_BAD_INPUT, "the pose is beyond the grid of the atlas");
    return HOST_OK;
}

static void json_classes(const char *name, const cage_atlas *atlas, const cage_pose *pose)
{
    int32_t side;

    (void)printf(", \"%s\": [", name);
    for (side = CAGE_SIDE_INNER; side <= CAGE_SIDE_OUTER; side++) {
        const int32_t class = atlas->side & side ? cage_atlas_locate(atlas, pose, side) : CAGE_NO_CLASS;

        if (class >= 0)
            (void)printf("%ld", (long)class);
        else
            (void)printf("null");
        (void)printf(side == CAGE_SIDE_INNER ? ", " : "]");
    }
}

static int answer(const cage_atlas *atlas, double unit, const char *at, const char *to, int json, host_error *error)
{
    cage_pose from, goal;
    int32_t verdict;
    int code = read_pose(atlas, unit, at, &from, error);

    if (code == HOST_OK && to != NULL)
        code = read_pose(atlas, unit, to, &goal, error);
    if (code != HOST_OK)
        return code;
    verdict = cage_atlas_ask(atlas, &from, to != NULL ? &goal : NULL);
    if (verdict < 0)
        return host_fail(error, HOST_BAD_INPUT, "%.200s", cage_error_text(verdict));
    if (!json) {
        (void)printf("%s\n", cage_verdict_text(verdict));
        return HOST_OK;
    }
    (void)printf("{\"verdict\": \"%s\"", cage_verdict_text(verdict));
    json_classes("at", atlas, &from);
    if (to != NULL)
        json_classes("to", atlas, &goal);
    (void)printf("}\n");
    return HOST_OK;
}

/* ---- many ----------------------------------------------------------------------------------------------- */

static int answer_line(const cage_atlas *atlas, double unit, char *line, long number, int json, host_error *error)
{
    static const char blank[] = " \t\r\n";
    char *word[3] = { NULL, NULL, NULL };
    host_error why;
    int words = 0, code;

    line[strcspn(line, "#")] = '\0';
    for (line += strspn(line, blank); *line != '\0' && words < 3; line += strspn(line, blank)) {
        word[words++] = line;
        line += strcspn(line, blank);
        if (*line != '\0')
            *line++ = '\0';
    }
    if (words == 0)
        return HOST_OK;
    code = words > 2 ? host_fail(&why, HOST_BAD_INPUT, "more than two poses") : answer(atlas, unit, word[0], word[1], json, &why);
    return code == HOST_OK ? code : host_fail(error, code, "standard input:%ld: %.800s", number, why.text);
}

static int answer_all(const cage_atlas *atlas, double unit, int json, host_error *error)
{
    char *line = NULL;
    size_t room = 0;
    ssize_t length;
    long number = 0;
    int code = HOST_OK;

    while (code == HOST_OK && (length = getline(&line, &room, stdin)) >= 0) {
        number++;
        if (strlen(line) != (size_t)length)
            code = host_fail(error, HOST_BAD_INPUT, "standard input:%ld: a byte that is zero", number);
        else
            code = answer_line(atlas, unit, line, number, json, error);
    }
    if (code == HOST_OK && (ferror(stdin) || !feof(stdin)))
        code = host_fail(error, HOST_BAD_INPUT, "standard input cannot be read: %.200s", strerror(errno));
    free(line);
    return code;
}

static int run(const options *given, unsigned char **bytes, host_error *error)
{
    cage_atlas atlas;
    size_t size;
    double unit;
    int code = host_read_whole(given->file, bytes, &size, error);

    if (code != HOST_OK)
        return code;
    if (cage_atlas_open(&atlas, *bytes, size) != CAGE_OK)
        return host_fail(error, HOST_BAD_INPUT, "%.600s is not an atlas of this version, or was changed", given->file);
    memcpy(&unit, atlas.note, sizeof unit);
    if (!(unit > 0 && unit < HOST_LARGEST))
        return host_fail(error, HOST_BAD_INPUT, "%.600s has no unit: it was not written by cage atlas", given->file);
    return given->at != NULL ? answer(&atlas, unit, given->at, given->to, given->json, error)
                             : answer_all(&atlas, unit, given->json, error);
}

int host_query_command(int argc, char **argv)
{
    options given;
    host_error error;
    unsigned char *bytes = NULL;
    int code = read_options(argc, argv, &given, &error);

    if (code == HOST_OK)
        code = run(&given, &bytes, &error);
    if (code != HOST_OK)
        (void)fprintf(stderr, "%s%s\n", error.located ? "" : "cage: ", error.text);
    free(bytes);
    return code;
}
