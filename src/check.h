/* check: is a motion free of collision? Shares no geometry with the search. */
#ifndef CAGE_CHECK_H
#define CAGE_CHECK_H

#include "cage.h"

#include <stdbool.h>

/* May the pivot move from a to b on a straight line at rotation q without a collision of outer balls? spare: units by which every
 * distance must be larger still. |coordinates| <= 2^30 in the plane. True is a proof. */
bool cage_check_leg(const cage_scene *scene, const int32_t pivot[3], const int32_t q[4], const int32_t a[3], const int32_t b[3],
                    int32_t spare);

/* The extent of the scene's outer obstacles along an axis, and the largest distance of a point of the object from its pivot. */
void cage_check_extent(const cage_scene *scene, int32_t axis, int32_t *low, int32_t *high);
int32_t cage_check_size(const cage_scene *scene, const int32_t pivot[3]);

#endif
