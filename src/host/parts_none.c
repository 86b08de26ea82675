/* parts_none.c: what stands for parts.c and parts_balls.c in a build without libccd. */
#include <string.h>

#include "parts.h"

int host_parts_available(void)
{
    return 0;
}

const char *host_parts_name(void)
{
    return "none";
}

int host_check_parts(const host_answer *answer, const host_parts *parts, parts_check *check, host_error *error)
{
    (void)answer;
    (void)parts;
    memset(check, 0, sizeof *check);
    return host_fail(error, HOST_BAD_INPUT, "this build is without libccd");
}

void host_free_check(parts_check *check)
{
    memset(check, 0, sizeof *check);
}
