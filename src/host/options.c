/* options.c: what the subcommands share: options, the dimension of a scene, files, memory and time. */
#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "host.h"

static const host_option *find_option(const host_option *known, size_t count, const char *name, size_t length)
{
    size_t i;

    for (i = 0; i < count; i++)
        if (strlen(known[i].name) == length && memcmp(known[i].name, name, length) == 0)
            return &known[i];
    return NULL;
}

int host_read_options(int argc, char **argv, const char *command, const host_option *known, size_t count, const char **operand,
                      host_error *error)
{
    int i;

    for (i = 1; i < argc; i++) {
        const size_t length = strcspn(argv[i], "=");
        const host_option *option = find_option(known, count, argv[i], length);

        if (option == NULL && operand != NULL && *operand == NULL && argv[i][0] != '-')
            *operand = argv[i];
        else if (option == NULL || (option->flag != NULL && argv[i][length] == '='))
            return host_fail(error, HOST_BAD_INPUT, "'%.100s' is not an option of cage %s (see cage %s --help)", argv[i],
                             command, command);
        else if (option->flag != NULL)
            *option->flag = 1;
        else if (*option->value != NULL)
            return host_fail(error, HOST_BAD_INPUT, "%.*s is given twice", (int)length, argv[i]);
        else if (argv[i][length] == '=')
            *option->value = argv[i] + length + 1;
        else if (i + 1 == argc)
            return host_fail(error, HOST_BAD_INPUT, "%s needs a value", argv[i]);
        else
            *option->value = argv[++i];
    }
    return HOST_OK;
}

int host_blame(host_error *error, const char *option, int code)
{
    host_error why = *error;

    return code == HOST_OK ? code : host_fail(error, code, "%s: %.900s", option, why.text);
}

int host_parse_side(const char *text, int32_t *side, host_error *error)
{
    static const char *const names[] = { "inner", "outer", "both" };
    int32_t i;

    *side = CAGE_SIDE_BOTH;
    for (i = 0; text != NULL && i < 3; i++)
        if (strcmp(text, names[i]) == 0) {
            *side = CAGE_SIDE_INNER + i;
            return HOST_OK;
        }
    return text == NULL ? HOST_OK
                        : host_fail(error, HOST_BAD_INPUT, "--side: '%.100s' is none of both, inner, outer", text);
}

/* The dimension on which all parts agree; a file without balls fits any. */
int host_agree_on_dimension(host_query *query, host_error *error)
{
    const int32_t object = query->object.dim, obstacles = query->obstacles.dim;

    if (object != 0 && obstacles != 0 && object != obstacles)
        return host_fail(error, HOST_BAD_INPUT,
                         "the object has %d dimensions and the obstacles have %d", (int)object, (int)obstacles);
    query->dim = object != 0 ? object : obstacles != 0 ? obstacles : query->start.dim;
    if (query->start.dim != query->dim || (query->has_goal && query->goal.dim != query->dim))
        return host_fail(error, HOST_BAD_INPUT, "%s: the balls have %d dimensions, their poses are %s",
                         query->start.dim != query->dim ? "--start" : "--goal", (int)query->dim,
                         query->dim == 2 ? "x,y,degrees" : "x,y,z,qw,qx,qy,qz");
    return HOST_OK;
}

void host_warn_empty(const char *object, const char *obstacles, const host_query *query)
{
    if (query->object.count == 0)
        (void)fprintf(stderr, "cage: warning: %s has no balls\n", object);
    if (query->obstacles.count == 0)
        (void)fprintf(stderr, "cage: warning: %s has no balls\n", obstacles);
}

/* What is there may be written, and what is not may be made in its folder. */
int host_check_writable(const char *option, const char *path, host_error *error)
{
    const char *slash = path != NULL ? strrchr(path, '/') : NULL;
    struct stat there;
    char folder[1024] = ".";
    int fine = path == NULL;

    if (fine)
        return HOST_OK;
    if (slash != NULL)
        (void)snprintf(folder, sizeof folder, "%.*s", slash == path ? 1 : (int)(slash - path), path);
    if (stat(path, &there) != 0)
        fine = access(folder, W_OK | X_OK) == 0;
    else if (S_ISDIR(there.st_mode))
        errno = EISDIR;
    else
        fine = access(path, W_OK) == 0;
    return fine ? HOST_OK
                : host_fail(error, HOST_BAD_INPUT, "%s: %.600s cannot be written: %.200s", option, path, strerror(errno));
}

int host_check_apart(const char *option, const char *path, const char *other, host_error *error)
{
    struct stat a, b;
    int same = path != NULL && other != NULL && strcmp(path, other) == 0;

    if (path != NULL && other != NULL && !same)
        same = stat(path, &a) == 0 && stat(other, &b) == 0 && a.st_dev == b.st_dev && a.st_ino == b.st_ino && S_ISREG(a.st_mode);
    return same ? host_fail(error, HOST_BAD_INPUT, "%s: %.600s is already used by another option", option, path) : HOST_OK;
}

int host_read_whole(const char *path, unsigned char **bytes, size_t *size, host_error *error)
{
    FILE *file = fopen(path, "rb");
    size_t room = 0, got = 1;
    int fine = file != NULL;

    *bytes = NULL;
    *size = 0;
    while (fine && got > 0) {
        if (*size == room) {
            unsigned char *more = realloc(*bytes, room = 2 * room + 65536);

            fine = more != NULL;
            *bytes = fine ? more : *bytes;
        }
        got = fine ? fread(*bytes + *size, 1, room - *size, file) : 0;
        *size += got;
    }
    fine = fine && !ferror(file);
    if (file != NULL)
        (void)fclose(file);
    return fine ? HOST_OK : host_fail(error, HOST_BAD_INPUT, "%.600s cannot be read: %.200s", path, strerror(errno));
}

static int write_to(FILE *file, const unsigned char *bytes, size_t size)
{
    int fine = file != NULL && fwrite(bytes, 1, size, file) == size;

    return file != NULL && fclose(file) == 0 && fine;
}

/* A file of a name of its own beside that, with the rights that it has or would get; null if that cannot be. */
static FILE *open_beside(const char *path, char *name, size_t room)
{
    const mode_t mask = umask(0);
    struct stat there;
    FILE *file = NULL;
    int handle;

    (void)umask(mask);
    if (snprintf(name, room, "%s.XXXXXX", path) >= (int)room || (handle = mkstemp(name)) < 0)
        return NULL;
    if (fchmod(handle, stat(path, &there) == 0 ? there.st_mode & 07777 : 0666 & ~mask) == 0)
        file = fdopen(handle, "wb");
    if (file == NULL) {
        (void)close(handle);
        (void)remove(name);
    }
    return file;
}

int host_write_whole(const char *path, const unsigned char *bytes, size_t size, host_error *error)
{
    struct stat there;
    char real[PATH_MAX], name[PATH_MAX + 8];
    const int regular = stat(path, &there) != 0 || S_ISREG(there.st_mode);
    const char *target = realpath(path, real) != NULL ? real : path; /* where a link leads */
    FILE *file = regular ? open_beside(target, name, sizeof name) : NULL;
    int fine;

    if (file == NULL) { /* a device, a pipe, or a folder without room for another file */
        fine = write_to(fopen(path, "wb"), bytes, size);
    } else {
        fine = write_to(file, bytes, size) && rename(name, target) == 0;
        if (!fine)
            (void)remove(name);
    }
    return fine ? HOST_OK : host_fail(error, HOST_BAD_INPUT, "%.600s cannot be written: %.200s", path, strerror(errno));
}

double host_now(void)
{
    struct timespec time;

    (void)clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + (double)time.tv_nsec * 1e-9;
}

/* A block of the size, or of less if it need not be all of it. */
void *host_take_block(size_t *size, size_t least)
{
    void *block = malloc(*size > 0 ? *size : 1);
    while (block == NULL && *size / 2 >= least) {
        *size /= 2;
        block = malloc(*size);
    }
    return block;
}

int host_in_block(size_t wanted, const size_t *bytes, host_attempt *attempt, void *data, void **block, const char *subject,
                  host_error *error)
{
    size_t least = bytes != NULL ? *bytes + 1 : wanted > HOST_LEAST_BLOCK ? wanted : HOST_LEAST_BLOCK;
    size_t size = bytes != NULL ? *bytes : wanted > HOST_FIRST_BLOCK ? wanted : HOST_FIRST_BLOCK;

    for (;;) {
        uint64_t needed = wanted;
        int32_t state;

        *block = host_take_block(&size, least);
        if (*block == NULL)
            return host_fail(error, HOST_MEMORY, "memory: a block of %zu bytes was needed and is not to be had", size);
        state = attempt(data, *block, size, &needed);
        if (state == CAGE_OK)
            return HOST_OK;
        if (state != CAGE_ERROR_MEMORY)
            return host_fail(error, HOST_BAD_INPUT, "the %s is not accepted: %.200s", subject, cage_error_text(state));
        if (needed <= size)
            needed = (uint64_t)size + 1;
        if (bytes != NULL || size > HOST_LARGEST_BLOCK / 2 || needed > HOST_LARGEST_BLOCK)
            return host_fail(error, HOST_MEMORY, "memory: %zu bytes were too few; try --memory %llu", size,
                             (unsigned long long)needed);
        free(*block);
        *block = NULL;
        size = needed > 2 * size ? (size_t)needed : 2 * size;
        least = size;
    }
}
