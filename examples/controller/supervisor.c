/* supervisor.c: one atlas for each margin, made on the desk with all radii smaller by that much, asked from the largest down. */
#include "supervisor.h"

#include "flash.h" /* written by make.sh: margin_um[], the atlases' bytes and sizes, smallest margin first */

enum { ATLASES = sizeof margin_um / sizeof *margin_um };

static cage_atlas atlas[ATLASES];

bool supervisor_start(void)
{
    for (int32_t i = 0; i < ATLASES; i++)
        if (cage_atlas_open(&atlas[i], atlas_bytes[i], atlas_size[i]) != CAGE_OK)
            return false;
    return true;
}

int32_t supervisor_margin(const cage_pose *part)
{
    for (int32_t i = ATLASES - 1; i >= 0; i--)
        if (cage_atlas_ask(&atlas[i], part, NULL) == CAGE_CAGED)
            return margin_um[i];
    return SUPERVISOR_NOT_CAGED;
}
