/* many: loops over poses that Python would take 1 us a round for, and the crew of threads of src/host. */
#include "cagepy.h"
#include "threads.h"

void cagepy_ask_many(const cage_atlas *atlas, const cage_pose *start, const cage_pose *goal, int64_t count, int32_t *out)
{
    for (int64_t i = 0; i < count; i++)
        out[i] = cage_atlas_ask(atlas, &start[i], goal ? &goal[i] : NULL);
}

void cagepy_locate_many(const cage_atlas *atlas, const cage_pose *pose, int64_t count, int32_t side, int32_t *out)
{
    for (int64_t i = 0; i < count; i++)
        out[i] = cage_atlas_locate(atlas, &pose[i], side);
}

void cagepy_collides_many(const cage_scene *scene, const cage_pose *pose, int64_t count, int32_t side, int32_t *out)
{
    for (int64_t i = 0; i < count; i++)
        out[i] = cage_collides(scene, &pose[i], side);
}

void *cagepy_threads_start(int32_t count, uint64_t balls, cage_workers *workers)
{
    return host_threads_start(count, balls, workers);
}

void cagepy_threads_stop(void *crew)
{
    host_threads_stop(crew);
}

int32_t cagepy_threads_cores(void)
{
    return host_threads_cores();
}
