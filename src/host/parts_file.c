/* parts_file.c: reads convex parts from text, one a line, and says file:line when it cannot. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "parts.h"

#define NUMBERS 3072 /* in a line */
#define MOST_PARTS 100000

typedef struct reader {
    const char *path;
    long line;
    int32_t dim;
    double *value; /* NUMBERS of them */
} reader;

/* The word at the beginning of a text is this one: what comes after it, else null. */
static const char *after_word(const char *text, const char *word)
{
    const size_t length = strlen(word);

    text += strspn(text, " \t\r");
    return strncmp(text, word, length) == 0 && strchr(" \t\r", text[length]) != NULL ? text + length : NULL;
}

void parts_turn(const double q[4], const double v[3], double out[3])
{
    double u[3];
    int k;

    for (k = 0; k < 3; k++)
        u[k] = 2 * (q[1 + (k + 1) % 3] * v[(k + 2) % 3] - q[1 + (k + 2) % 3] * v[(k + 1) % 3]);
    for (k = 0; k < 3; k++)
        out[k] = v[k] + q[0] * u[k] + q[1 + (k + 1) % 3] * u[(k + 2) % 3] - q[1 + (k + 2) % 3] * u[(k + 1) % 3];
}

void parts_turn_back(const double q[4], const double v[3], double out[3])
{
    const double back[4] = { q[0], -q[1], -q[2], -q[3] };

    parts_turn(back, v, out);
}

static int place_part(const char *text, int32_t dim, host_part *part, host_error *why)
{
    const double pi = acos(-1);
    host_pose pose;
    double size = 0;
    int k;

    part->q[0] = 1;
    if (text == NULL)
        return 0;
    if (host_parse_pose(text, &pose, why) != HOST_OK)
        return -1;
    if (pose.dim != dim)
        return host_fail(why, -1, "a pose %s, but the balls are in %s", pose.dim == 2 ? "of the plane" : "in space",
                         dim == 2 ? "the plane" : "space");
    for (k = 0; k < 3; k++)
        part->x[k] = pose.x[k];
    if (dim == 2) {
        part->q[0] = cos(pose.degrees * pi / 360);
        part->q[3] = sin(pose.degrees * pi / 360);
        return 0;
    }
    for (k = 0; k < 4; k++)
        size = hypot(size, pose.q[k]);
    for (k = 0; k < 4; k++)
        part->q[k] = pose.q[k] / size;
    return 0;
}

/* Vertices; in the plane each of them above and below. Its middle is inside, and so is the hull flat or not. */
static int make_hull(const reader *in, int count, host_part *part, host_error *why)
{
    const int32_t dim = in->dim, vertices = count / dim;
    int32_t i;
    int k;

    if (count % dim != 0 || vertices < dim + 1)
        return host_fail(why, -1, "%d numbers; a hull has %d or more points of %d", count, (int)dim + 1, (int)dim);
    part->vertex = malloc(2 * (size_t)vertices * sizeof *part->vertex);
    if (part->vertex == NULL)
        return host_fail(why, -1, "no memory for its points");
    for (i = 0; i < vertices; i++)
        for (k = 0; k < dim; k++)
            part->centre[k] += in->value[i * dim + k] / vertices;
    for (i = 0; i < vertices; i++) {
        double square = 0;

        for (k = 0; k < 3; k++) {
            part->vertex[i][k] = k < dim ? in->value[i * dim + k] : 0;
            square += (part->vertex[i][k] - part->centre[k]) * (part->vertex[i][k] - part->centre[k]);
        }
        part->reach = fmax(part->reach, sqrt(square));
    }
    part->vertices = vertices;
    for (i = 0; dim == 2 && i < vertices; i++) {
        memcpy(part->vertex[vertices + i], part->vertex[i], sizeof part->vertex[i]);
        part->vertex[i][2] = part->reach;
        part->vertex[vertices + i][2] = -part->reach;
        part->vertices = 2 * vertices;
    }
    part->reach *= dim == 2 ? sqrt(2.0) : 1;
    return 0;
}

/* Box: its sides. Cylinder and capsule: radius, and the length that is straight; in the plane a disc has its radius only. */
static int make_part(const reader *in, const char *name, int count, host_part *part, host_error *why)
{
    const double *value = in->value;
    const int plane = in->dim == 2;
    int wanted = part->shape == PART_BOX ? (int)in->dim : part->shape == PART_CYLINDER && plane ? 1 : 2, k;

    if (part->shape == PART_HULL)
        return make_hull(in, count, part, why);
    if (count != wanted)
        return host_fail(why, -1, "%d numbers; a %s has %d (see cage prove --help)", count, name, wanted);
    for (k = 0; k < count; k++)
        if (!(value[k] > 0))
            return host_fail(why, -1, "%g is no length of a %s", value[k], name);
    part->axis = plane && part->shape == PART_CAPSULE ? 0 : 2;
    if (part->shape == PART_BOX) {
        for (k = 0; k < 3; k++)
            part->size[k] = value[k < count ? k : 0] / 2;
        part->reach = hypot(hypot(part->size[0], part->size[1]), part->size[2]);
        return 0;
    }
    part->size[0] = value[0];
    part->size[1] = count > 1 ? value[1] / 2 : value[0];
    part->reach = part->shape == PART_CAPSULE ? part->size[0] + part->size[1] : hypot(part->size[0], part->size[1]);
    return 0;
}

/* A line without its comment: 1 and the part, 0 where it is empty, or -1 and why. */
static int parse_part(const reader *in, char *text, int *whose, host_part *part, host_error *why)
{
    static const char *const names[] = { "box", "cylinder", "capsule", "hull", "disc" };
    const char *rest = NULL, *found = NULL;
    char *at;
    int count, i;

    memset(part, 0, sizeof *part);
    if (text[strspn(text, " \t\r")] == '\0')
        return 0;
    for (*whose = 0; *whose < 2 && rest == NULL; ++*whose)
        rest = after_word(text, *whose == 0 ? "object" : "obstacle");
    --*whose;
    if (rest == NULL)
        return host_fail(why, -1, "a line begins with object or obstacle");
    for (i = 0; i < 5 && found == NULL; i++)
        found = after_word(rest, names[i]);
    if (found == NULL || (i == 5 && in->dim == 3) || (i == 2 && in->dim == 2))
        return host_fail(why, -1, "a part is a %s, capsule or hull", in->dim == 2 ? "box, disc" : "box, cylinder");
    part->shape = i == 5 ? PART_CYLINDER : i - 1;
    at = strchr(text, '@');
    if (at != NULL)
        *at++ = '\0';
    count = host_columns(found, in->value, NUMBERS, why);
    if (count < 0)
        return -1;
    if (count > NUMBERS)
        return host_fail(why, -1, "more than %d numbers", NUMBERS);
    if (make_part(in, names[i - 1], count, part, why) < 0 || place_part(at, in->dim, part, why) < 0)
        return -1;
    return 1;
}

static int add_part(host_parts *parts, int whose, const host_part *part)
{
    const int32_t count = parts->count[whose];
    host_part *more = parts->part[whose];

    if ((count & (count - 1)) == 0) { /* at 0 and at each power of two it grows to the next */
        more = realloc(more, (count > 0 ? 2 * (size_t)count : 1) * sizeof *more);
        if (more == NULL)
            return -1;
        parts->part[whose] = more;
    }
    more[parts->count[whose]++] = *part;
    return 0;
}

static int read_lines(reader *in, char *text, host_parts *parts, host_error *error)
{
    host_error why;
    char *next;

    for (next = text; next != NULL; text = next) {
        host_part part;
        int found, whose;

        in->line++;
        next = strchr(text, '\n');
        if (next != NULL)
            *next++ = '\0';
        text[strcspn(text, "#")] = '\0';
        found = parse_part(in, text, &whose, &part, &why);
        if (found > 0 && parts->count[whose] < MOST_PARTS && add_part(parts, whose, &part) == 0)
            continue;
        if (found == 0)
            continue;
        free(part.vertex);
        if (found < 0)
            return host_fail(error, HOST_BAD_INPUT, "%.600s:%ld: %.300s", in->path, in->line, why.text);
        return host_fail(error, HOST_MEMORY, "%.600s:%ld: no memory for so many parts", in->path, in->line);
    }
    return HOST_OK;
}

int host_read_parts(const char *path, int32_t dim, host_parts *parts, host_error *error)
{
    unsigned char *bytes = NULL;
    size_t size = 0;
    reader in = { path, 0, dim, NULL };
    char *text = NULL;
    int code;

    memset(parts, 0, sizeof *parts);
    code = host_read_whole(path, &bytes, &size, error);
    if (code == HOST_OK) {
        in.value = malloc(NUMBERS * sizeof *in.value);
        text = malloc(size + 1);
        code = in.value != NULL && text != NULL ? HOST_OK : host_fail(error, HOST_MEMORY, "%.600s: no memory for it", path);
    }
    if (code == HOST_OK) {
        memcpy(text, bytes, size);
        text[size] = '\0';
        code = strlen(text) == size ? read_lines(&in, text, parts, error)
                                    : host_fail(error, HOST_BAD_INPUT, "%.600s: a zero byte: this is not a text file", path);
    }
    if (code == HOST_OK && (parts->count[0] == 0 || parts->count[1] == 0))
        code = host_fail(error, HOST_BAD_INPUT, "%.600s: no part of the %s", path,
                         parts->count[0] == 0 ? "object" : "obstacles");
    free(in.value);
    free(text);
    free(bytes);
    error->located = 1;
    return code;
}

void host_free_parts(host_parts *parts)
{
    int side;
    int32_t i;

    for (side = 0; side < 2; side++) {
        for (i = 0; i < parts->count[side]; i++)
            free(parts->part[side][i].vertex);
        free(parts->part[side]);
    }
    memset(parts, 0, sizeof *parts);
}
