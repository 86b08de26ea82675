/* certify: is a motion free of collision? Shares no geometry with the search. */
#ifndef CAGE_CERTIFY_H
#define CAGE_CERTIFY_H

#include "cage.h"

#include <stdbool.h>

/* May the pivot move from a to b on a straight line at rotation q without a collision of outer balls? spare: units by which every
 * distance must be larger still. True is a proof. */
bool cage_certify_leg(const cage_scene *scene, const int32_t pivot[3], const int32_t q[4], const int32_t a[3], const int32_t b[3],
                    int32_t spare);

/* May the object turn about its pivot at p from q to r, on the shorter arc, which is cut into at most so many pieces?
 * True is a proof. */
bool cage_certify_turn(const cage_scene *scene, const int32_t pivot[3], const int32_t p[3], const int32_t q[4],
                       const int32_t r[4], int32_t pieces);

/* May the pivot move on a straight line while the object turns about it on the shorter arc, both at a constant rate?
 * True is a proof. */
bool cage_certify_move(const cage_scene *scene, const int32_t pivot[3], const cage_pose *a, const cage_pose *b);

/* The extent of the scene's outer obstacles along an axis, and the largest distance of a point of the object from its pivot. */
void cage_certify_extent(const cage_scene *scene, int32_t axis, int32_t *low, int32_t *high);
int32_t cage_certify_size(const cage_scene *scene, const int32_t pivot[3]);

/* With its pivot at x the object, however turned, is beyond a line (plane) perpendicular to an axis that has all
 * obstacles on its other side. */
bool cage_certify_beyond(const cage_scene *scene, const int32_t pivot[3], const int32_t x[3]);

#endif
