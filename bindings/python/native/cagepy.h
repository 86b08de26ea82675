/* cagepy.h: what the Python package adds to cage.h: loops over many poses, and a crew of threads. */
#ifndef CAGEPY_H
#define CAGEPY_H

#include "cage.h"

#define CAGEPY_API __attribute__((visibility("default")))

/* out[i] is what cage_atlas_ask answers for start[i] (and goal[i], or goal null), errors included. */
CAGEPY_API void cagepy_ask_many(const cage_atlas *atlas, const cage_pose *start, const cage_pose *goal, int64_t count,
                                int32_t *out);

/* out[i] is what cage_atlas_locate answers for pose[i]. */
CAGEPY_API void cagepy_locate_many(const cage_atlas *atlas, const cage_pose *pose, int64_t count, int32_t side, int32_t *out);

/* out[i] is what cage_collides answers for pose[i]. */
CAGEPY_API void cagepy_collides_many(const cage_scene *scene, const cage_pose *pose, int64_t count, int32_t side,
                                     int32_t *out);

/* A crew of so many threads for *workers, or null: see host_threads_start. The calls return without the crew's threads
 * running: these wait. To be stopped by the process that started it. */
CAGEPY_API void *cagepy_threads_start(int32_t count, uint64_t balls, cage_workers *workers);
CAGEPY_API void cagepy_threads_stop(void *crew);
CAGEPY_API int32_t cagepy_threads_cores(void);

#endif
