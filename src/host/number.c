/* number.c: strict reading of numbers and poses: the whole text, finite, in range, or a reason why not. */
#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "host.h"

#define BLANK " \t\r\n\v\f"
#define SHOWN 40 /* characters of a bad word that a message repeats */

int host_fail(host_error *error, int code, const char *format, ...)
{
    va_list arguments;

    va_start(arguments, format);
    (void)vsnprintf(error->text, sizeof error->text, format, arguments);
    va_end(arguments);
    error->located = 0;
    return code;
}

/* A copy of a word that is safe to print. */
static void show_word(const char *word, size_t length, char shown[SHOWN + 4])
{
    size_t i, kept = length > SHOWN ? SHOWN : length;

    for (i = 0; i < kept; i++)
        shown[i] = isprint((unsigned char)word[i]) ? word[i] : '?';
    memcpy(shown + kept, length > SHOWN ? "..." : "", length > SHOWN ? 4 : 1);
}

/* One number of exactly that many characters; 0, or -1 and why. */
static int read_number(const char *word, size_t length, double *value, host_error *why)
{
    const char *letter = word + (word[0] == '+' || word[0] == '-');
    char shown[SHOWN + 4], *end = NULL;

    show_word(word, length, shown);
    if (length > 0 && letter < word + length && strchr("nNiI", *letter) != NULL)
        return host_fail(why, -1, "'%s' is not a finite number", shown);
    if (length == 0 || strspn(word, "+-.0123456789eE") < length)
        return host_fail(why, -1, "'%s' is not a number", shown);
    *value = strtod(word, &end);
    if (end != word + length)
        return host_fail(why, -1, "'%s' is not a number", shown);
    if (!(fabs(*value) <= HOST_LARGEST))
        return host_fail(why, -1, "'%s' is too large (beyond %g)", shown, HOST_LARGEST);
    return 0;
}

int host_columns(const char *text, double *value, int capacity, host_error *why)
{
    int count = 0;
    host_error reason;

    text += strspn(text, BLANK);
    while (*text != '\0') {
        size_t length = strcspn(text, BLANK ",");
        double number = 0;

        if (length == 0)
            return host_fail(why, -1, "column %d is empty", count + 1);
        if (read_number(text, length, &number, &reason) < 0)
            return host_fail(why, -1, "column %d: %.200s", count + 1, reason.text);
        if (count < capacity)
            value[count] = number;
        count++;
        text += length;
        text += strspn(text, BLANK);
        if (*text == ',') {
            text += 1 + strspn(text + 1, BLANK);
            if (*text == '\0')
                return host_fail(why, -1, "nothing follows the last comma");
        }
    }
    return count;
}

int host_parse_pose(const char *text, host_pose *pose, host_error *why)
{
    double value[7] = { 0 };
    int count = host_columns(text, value, 7, why);
    int i;

    if (count < 0)
        return HOST_BAD_INPUT;
    if (count != 3 && count != 7)
        return host_fail(why, HOST_BAD_INPUT,
                         "%d numbers; a pose is x,y,degrees or x,y,z,qw,qx,qy,qz", count);
    memset(pose, 0, sizeof *pose);
    pose->dim = count == 3 ? 2 : 3;
    for (i = 0; i < pose->dim; i++)
        pose->x[i] = value[i];
    if (pose->dim == 2) {
        pose->degrees = value[2];
        if (fabs(value[2]) > 1e6)
            return host_fail(why, HOST_BAD_INPUT, "an angle of %g degrees is beyond 1e6", value[2]);
        return HOST_OK;
    }
    memcpy(pose->q, value + 3, sizeof pose->q);
    if (pose->q[0] == 0 && pose->q[1] == 0 && pose->q[2] == 0 && pose->q[3] == 0)
        return host_fail(why, HOST_BAD_INPUT, "the quaternion is zero: no rotation");
    return HOST_OK;
}

int host_parse_unit(const char *text, double *unit, host_error *why)
{
    if (read_number(text, strlen(text), unit, why) < 0)
        return HOST_BAD_INPUT;
    if (*unit < 1 / HOST_LARGEST)
        return host_fail(why, HOST_BAD_INPUT, "a unit is a positive length, not %g", *unit);
    return HOST_OK;
}

/* A whole number in decimal digits; how many characters it takes, 0 where there is none. */
static size_t read_whole(const char *text, unsigned long long *value)
{
    char *end = NULL;

    if (!isdigit((unsigned char)text[0]))
        return 0;
    errno = 0;
    *value = strtoull(text, &end, 10);
    return errno == 0 ? (size_t)(end - text) : 0;
}

int host_parse_integer(const char *text, int32_t low, int32_t high, int32_t *value, host_error *why)
{
    unsigned long long number = 0;
    size_t length = read_whole(text, &number);
    char shown[SHOWN + 4];

    show_word(text, strlen(text), shown);
    if (length == 0 || text[length] != '\0' || number > (unsigned long long)high ||
        (int64_t)number < (int64_t)low)
        return host_fail(why, HOST_BAD_INPUT, "'%s' is not a whole number from %ld to %ld", shown,
                         (long)low, (long)high);
    *value = (int32_t)number;
    return HOST_OK;
}

int host_parse_bytes(const char *text, size_t *bytes, host_error *why)
{
    static const char suffixes[] = "kKmMgG";
    unsigned long long number = 0, factor = 1;
    size_t length = read_whole(text, &number);
    char shown[SHOWN + 4];

    show_word(text, strlen(text), shown);
    if (length > 0 && text[length] != '\0') {
        const char *suffix = strchr(suffixes, text[length]);

        if (suffix == NULL || text[length + 1] != '\0')
            length = 0;
        else
            factor = 1ULL << (10 * (1 + (suffix - suffixes) / 2));
    }
    if (length == 0)
        return host_fail(why, HOST_BAD_INPUT,
                         "'%s' is not a number of bytes (a whole number, or one with K, M or G)", shown);
    if (number > SIZE_MAX / factor)
        return host_fail(why, HOST_BAD_INPUT, "'%s' is more memory than this machine can address", shown);
    *bytes = (size_t)(number * factor);
    return HOST_OK;
}
