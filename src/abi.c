/* abi: what a binding compares before it trusts its own copies of the structs; others can leave this file out. */
#include "cage.h"

int32_t cage_abi(void)
{
    return CAGE_ABI;
}

size_t cage_struct_size(int32_t which)
{
    switch (which) {
    case CAGE_STRUCT_BALL: return sizeof(cage_ball);
    case CAGE_STRUCT_SHAPE: return sizeof(cage_shape);
    case CAGE_STRUCT_SCENE: return sizeof(cage_scene);
    case CAGE_STRUCT_POSE: return sizeof(cage_pose);
    case CAGE_STRUCT_LIMITS: return sizeof(cage_limits);
    case CAGE_STRUCT_RESULT: return sizeof(cage_result);
    case CAGE_STRUCT_WORKERS: return sizeof(cage_workers);
    case CAGE_STRUCT_MARGIN: return sizeof(cage_margin);
    case CAGE_STRUCT_PLAN: return sizeof(cage_plan);
    case CAGE_STRUCT_SURVEY_RESULT: return sizeof(cage_survey_result);
    case CAGE_STRUCT_ATLAS: return sizeof(cage_atlas);
    case CAGE_STRUCT_CLASS: return sizeof(cage_class);
    case CAGE_STRUCT_BOX: return sizeof(cage_atlas_box);
    case CAGE_STRUCT_STEP: return sizeof(cage_step);
    default: return 0;
    }
}
