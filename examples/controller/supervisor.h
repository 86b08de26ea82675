/* supervisor.h: is the part still caged at this pose, and by what margin? */
#ifndef SUPERVISOR_H
#define SUPERVISOR_H

#include <stdbool.h>

#include "cage.h"

/* Lengths are in micrometres: --unit 0.001 of a drawing in millimetres. */
enum { SUPERVISOR_NOT_CAGED = -1 };

/* Open the atlases; false: the flash does not hold what was written. Reads all of it: once, at start. */
bool supervisor_start(void);

/* By at least how much every radius of part and gripper could shrink and the part still be caged, or SUPERVISOR_NOT_CAGED when
 * that is not proved: outside, in collision, or not known. Takes no memory but the stack. */
int32_t supervisor_margin(const cage_pose *part);

/* May the arm lift? */
static inline bool supervisor_may_lift(const cage_pose *part, int32_t margin) { return supervisor_margin(part) >= margin; }

#endif
