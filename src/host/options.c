/* options.c: what the subcommands share: options, the dimension of a scene, files, memory and time. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
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

/* Better before a long proof than after it. Leaves no file where none was. */
int host_check_writable(const char *option, const char *path, host_error *error)
{
    const int there = path != NULL && access(path, F_OK) == 0;
    FILE *file = path != NULL ? fopen(path, "a") : NULL;

    if (path != NULL && file == NULL)
        return host_fail(error, HOST_BAD_INPUT, "%s: %.600s cannot be written: %.200s", option, path, strerror(errno));
    if (file != NULL)
        (void)fclose(file);
    if (file != NULL && !there)
        (void)remove(path);
    return HOST_OK;
}

int host_read_whole(const char *path, unsigned char **bytes, size_t *size, host_error *error)
{
    FILE *file = fopen(path, "rb");
    long end = 0;
    int fine = file != NULL && fseek(file, 0, SEEK_END) == 0 && (end = ftell(file)) >= 0 && fseek(file, 0, SEEK_SET) == 0;

    *bytes = fine ? malloc((size_t)end + 1) : NULL;
    fine = *bytes != NULL && fread(*bytes, 1, (size_t)end, file) == (size_t)end;
    *size = (size_t)end;
    if (file != NULL)
        (void)fclose(file);
    return fine ? HOST_OK : host_fail(error, HOST_BAD_INPUT, "%.600s cannot be read: %.200s", path, strerror(errno));
}

int host_write_whole(const char *path, const unsigned char *bytes, size_t size, host_error *error)
{
    const size_t length = strlen(path);
    char *beside = malloc(length + 6);
    FILE *file = NULL;
    int fine;

    if (beside == NULL)
        return host_fail(error, HOST_MEMORY, "no memory for a file name");
    memcpy(beside, path, length);
    memcpy(beside + length, ".part", 6);
    file = fopen(beside, "wb");
    fine = file != NULL && fwrite(bytes, 1, size, file) == size;
    fine = file != NULL && fclose(file) == 0 && fine && rename(beside, path) == 0;
    if (!fine && file != NULL)
        (void)remove(beside);
    free(beside);
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
            return host_fail(error, HOST_MEMORY, "memory: %zu bytes were too few; at least %llu are needed (--memory %llu)",
                             size, (unsigned long long)needed, (unsigned long long)needed);
        free(*block);
        *block = NULL;
        size = needed > 2 * size ? (size_t)needed : 2 * size;
        least = size;
    }
}
