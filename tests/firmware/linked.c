/* linked.c: what an image carries that only asks an atlas, only proves, or does all; each is the entry of a link of its own. */
#include "cage.h"

int32_t only_ask(const cage_atlas *atlas, const cage_pose *start, const cage_pose *goal);
int32_t only_query(const void *bytes, size_t size, const cage_pose *start, const cage_pose *goal);
int32_t only_prove(const cage_scene *scene, const cage_pose *start, const cage_pose *goal, void *memory, size_t size);
int32_t only_cage(const cage_scene *scene, const cage_pose *start, const cage_pose *goal, void *memory, size_t size);
int32_t only_small(const cage_scene *scene, const cage_pose *start, const cage_pose *goal, void *memory, size_t size);
int32_t only_build(const cage_scene *scene, const cage_plan *plan, void *memory, size_t size, void *out);
int32_t prove_and_query(const cage_scene *scene, const cage_pose *start, void *memory, size_t size, const void *bytes);

/* An atlas that was opened before. */
int32_t only_ask(const cage_atlas *atlas, const cage_pose *start, const cage_pose *goal)
{
    return cage_atlas_ask(atlas, start, goal);
}

int32_t only_query(const void *bytes, size_t size, const cage_pose *start, const cage_pose *goal)
{
    cage_atlas atlas;
    int32_t error = cage_atlas_open(&atlas, bytes, size);
    return error == CAGE_OK ? cage_atlas_ask(&atlas, start, goal) : error;
}

int32_t only_prove(const cage_scene *scene, const cage_pose *start, const cage_pose *goal, void *memory, size_t size)
{
    cage_proof *proof;
    int32_t state = cage_prove_begin(&proof, scene, start, goal, NULL, memory, size);
    while (state == 0)
        state = cage_prove_run(proof, 1);
    return state < 0 ? state : cage_prove_result(proof)->verdict;
}

/* Without paths. */
int32_t only_cage(const cage_scene *scene, const cage_pose *start, const cage_pose *goal, void *memory, size_t size)
{
    cage_limits limits;
    cage_proof *proof;
    cage_limits_default(&limits, scene->dim);
    limits.side = CAGE_SIDE_INNER;
    int32_t state = cage_prove_begin(&proof, scene, start, goal, &limits, memory, size);
    while (state == 0)
        state = cage_prove_run_inner(proof, 1);
    return state < 0 ? state : cage_prove_result(proof)->verdict;
}

/* And in the least code. */
int32_t only_small(const cage_scene *scene, const cage_pose *start, const cage_pose *goal, void *memory, size_t size)
{
    cage_proof *proof;
    int32_t state = cage_prove_begin_small(&proof, scene, start, goal, NULL, memory, size);
    while (state == 0)
        state = cage_prove_run_inner(proof, 1);
    return state < 0 ? state : cage_prove_result(proof)->verdict;
}

int32_t only_build(const cage_scene *scene, const cage_plan *plan, void *memory, size_t size, void *out)
{
    cage_survey *survey;
    int32_t state = cage_survey_begin(&survey, scene, plan, memory, size);
    while (state == 0)
        state = cage_survey_run(survey, 1);
    return state < 0 ? state : (int32_t)cage_survey_atlas(survey, out, size);
}

int32_t prove_and_query(const cage_scene *scene, const cage_pose *start, void *memory, size_t size, const void *bytes)
{
    return only_prove(scene, start, NULL, memory, size) + only_query(bytes, size, start, NULL) +
           only_build(scene, NULL, memory, size, memory);
}
