/* balls_file.c: reads balls from text, "x y r" or "x y z r" a line, and says file:line when it cannot. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "host.h"

#define LINE_SIZE 4096

typedef struct reader {
    FILE *file;
    const char *path;
    long line;       /* of the text in hand, from 1 */
    long first_line; /* where the first ball was */
    char text[LINE_SIZE];
} reader;

/* The next line, its comment and end removed: 1, 0 at the end of the file, or -1 and why. Comments
 * may be of any length. */
static int next_line(reader *in, host_error *why)
{
    size_t length = 0;
    int comment = 0, c;

    in->line++;
    while ((c = getc(in->file)) != EOF && c != '\n') {
        if (c == '\0')
            return host_fail(why, -1, "a zero byte: this is not a text file");
        comment = comment || c == '#';
        if (comment)
            continue;
        if (length == LINE_SIZE - 1)
            return host_fail(why, -1, "the line is longer than %d characters", LINE_SIZE - 1);
        in->text[length++] = (char)c;
    }
    in->text[length] = '\0';
    return c != EOF || length > 0;
}

/* The ball in the line in hand: 1, 0 where the line is empty, or -1 and why. */
static int parse_ball(const reader *in, host_balls *balls, host_ball *ball, host_error *why)
{
    const char *text = in->text;
    double value[4] = { 0 };
    int count, i;

    if (in->line == 1 && strncmp(text, "\xEF\xBB\xBF", 3) == 0)
        text += 3; /* the byte order mark that some editors write */
    count = host_columns(text, value, 4, why);
    if (count <= 0)
        return count;
    if (count != 3 && count != 4)
        return host_fail(why, -1, "%d column%s; a ball is \"x y r\" or \"x y z r\"", count,
                         count == 1 ? "" : "s");
    if (balls->dim != 0 && count != balls->dim + 1)
        return host_fail(why, -1, "%d columns, but line %ld has %d: plane and space do not mix", count,
                         in->first_line, (int)balls->dim + 1);
    memset(ball, 0, sizeof *ball);
    for (i = 0; i < count - 1; i++)
        ball->x[i] = value[i];
    ball->r = value[count - 1];
    if (ball->r < 0)
        return host_fail(why, -1, "the radius %g is negative", ball->r);
    balls->dim = count - 1;
    return 1;
}

/* Adds a ball; the array doubles. */
static int append_ball(host_balls *balls, int32_t *capacity, const host_ball *ball)
{
    if (balls->count == *capacity) {
        int32_t grown = *capacity > INT32_MAX / 2 ? INT32_MAX : *capacity * 2;
        host_ball *moved = NULL;

        if (grown == 0)
            grown = 64;
        if (grown > *capacity && (size_t)grown <= SIZE_MAX / sizeof *moved)
            moved = realloc(balls->ball, (size_t)grown * sizeof *moved);
        if (moved == NULL)
            return -1;
        balls->ball = moved;
        *capacity = grown;
    }
    balls->ball[balls->count++] = *ball;
    return 0;
}

static int read_lines(reader *in, host_balls *balls, host_error *error)
{
    int32_t capacity = 0;
    int more;
    host_error why;
    host_ball ball;

    while ((more = next_line(in, &why)) > 0) {
        int found = parse_ball(in, balls, &ball, &why);

        if (found < 0)
            return host_fail(error, HOST_BAD_INPUT, "%.600s:%ld: %.300s", in->path, in->line, why.text);
        if (found == 0)
            continue;
        if (balls->count == 0)
            in->first_line = in->line;
        if (append_ball(balls, &capacity, &ball) < 0)
            return host_fail(error, HOST_MEMORY, "%.600s:%ld: no memory for more than %ld balls",
                             in->path, in->line, (long)balls->count);
    }
    if (more < 0)
        return host_fail(error, HOST_BAD_INPUT, "%.600s:%ld: %.300s", in->path, in->line, why.text);
    if (ferror(in->file))
        return host_fail(error, HOST_BAD_INPUT, "%.600s: cannot be read: %.200s", in->path,
                         strerror(errno));
    return HOST_OK;
}

int host_read_balls(const char *path, host_balls *balls, host_error *error)
{
    reader in;
    int code;

    memset(balls, 0, sizeof *balls);
    memset(&in, 0, sizeof in);
    in.path = path;
    in.file = fopen(path, "r");
    if (in.file == NULL)
        code = host_fail(error, HOST_BAD_INPUT, "%.600s: cannot be opened: %.200s", path,
                         strerror(errno));
    else
        code = read_lines(&in, balls, error);
    if (in.file != NULL)
        (void)fclose(in.file);
    if (code != HOST_OK)
        host_free_balls(balls);
    error->located = 1;
    return code;
}

void host_free_balls(host_balls *balls)
{
    free(balls->ball);
    memset(balls, 0, sizeof *balls);
}
