/* text: the words for verdicts, reasons and errors; a build that prints nothing can leave this file out. */
#include "cage.h"

const char *cage_verdict_text(int32_t verdict)
{
    static const char *const text[] = {"UNDEFINED", "CAGED", "DISCONNECTED", "FREE", "CONNECTED", "IN_COLLISION"};
    return verdict >= CAGE_UNDEFINED && verdict <= CAGE_IN_COLLISION ? text[verdict] : "?";
}

const char *cage_reason_text(int32_t reason)
{
    static const char *const text[] = {
        "the work is not finished",
        "what the inner slices connect with the start is closed",
        "a path, certified free of collision",
        "the start collides",
        "the goal collides",
        "the finest cells allowed do not decide it",
        "the number of cells allowed does not decide it",
        "the side asked for cannot decide it",
    };
    return reason >= CAGE_REASON_RUNNING && reason <= CAGE_REASON_SIDE ? text[reason] : "?";
}

const char *cage_error_text(int32_t error)
{
    static const char *const text[] = {
        "no error",
        "an argument is null, negative or unknown",
        "the dimension is not supported, or z is not 0 in the plane",
        "the scene or a pose is too large for the grid",
        "a radius is negative",
        "a quaternion is zero, too large, or not about z in the plane",
        "the block of memory is too small",
        "the bytes are not an atlas of this version, or were changed",
    };
    return error <= CAGE_OK && error >= CAGE_ERROR_ATLAS ? text[-error] : "?";
}
