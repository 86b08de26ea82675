/* referee.c: what a right answer looks like, and which two answers cannot both be right. */
#include "referee.h"

#include <string.h>

#include "oracle.h"
#include "oracle_space.h"

typedef int32_t (*one_begin)(cage_proof **proof, const cage_scene *scene, const cage_pose *start, const cage_pose *goal,
                             const cage_limits *limits, void *memory, size_t bytes);

static int32_t prove_with(one_begin begin, int32_t (*run)(cage_proof *proof, int64_t steps), const question *q, int64_t portion,
                          void *memory, size_t bytes, cage_result *result)
{
    cage_proof *proof = NULL;
    int32_t error = begin(&proof, q->view, q->start, q->goal, q->limits, memory, bytes);
    memset(result, 0, sizeof *result);
    if (error != CAGE_OK) {
        return error;
    }
    do {
        error = run(proof, portion > 0 ? portion : INT64_MAX);
    } while (error == 0);
    *result = *cage_prove_result(proof);
    return error == 1 ? CAGE_OK : error;
}

int32_t referee_prove(const question *q, int64_t portion, void *memory, size_t bytes, cage_result *result)
{
    return prove_with(cage_prove_begin, cage_prove_run, q, portion, memory, bytes, result);
}

int32_t referee_prove_inner(const question *q, int64_t portion, void *memory, size_t bytes, cage_result *result)
{
    return prove_with(cage_prove_begin, cage_prove_run_inner, q, portion, memory, bytes, result);
}

int32_t referee_prove_small(const question *q, int64_t portion, void *memory, size_t bytes, cage_result *result)
{
    return prove_with(cage_prove_begin_small, cage_prove_run_inner, q, portion, memory, bytes, result);
}

int referee_decided(int32_t verdict)
{
    return verdict != CAGE_UNDEFINED && verdict != CAGE_IN_COLLISION;
}

static long double path_depth(const question *q, const cage_result *r, const char **wrong)
{
    return q->view->dim == 2
               ? oracle_check_path(q->view, q->start, q->goal, r->pivot, r->path, r->path_count, wrong)
               : oracle_space_check_path(q->view, q->start, q->goal, r->pivot, r->path, r->path_count, wrong);
}

static long double pose_depth(const question *q, const cage_pose *pose)
{
    return q->view->dim == 2 ? oracle_depth(q->view, pose, CAGE_SIDE_INNER)
                             : oracle_space_depth(q->view, pose, CAGE_SIDE_INNER);
}

static const char *form_path(const question *q, const cage_result *r)
{
    const char *wrong = NULL;
    if (r->path_count < 1 || !r->path) {
        return "a path was promised";
    }
    if (cage_path_check(q->view, q->start, q->goal, r->pivot, r->path, r->path_count) != 1) {
        return "cage_path_check refuses the path";
    }
    if (path_depth(q, r, &wrong) > ORACLE_SLACK) {
        return wrong ? wrong : "the path collides";
    }
    return wrong;
}

static const char *form_separated(const question *q, const cage_result *r)
{
    if (q->limits->side == CAGE_SIDE_OUTER) {
        return "the outer side proved a separation";
    }
    return r->reason == CAGE_REASON_CLOSED ? NULL : "separated for another reason than closure";
}

static const char *form_joined(const question *q, const cage_result *r)
{
    if (q->limits->side == CAGE_SIDE_INNER) {
        return "the inner side proved a connection";
    }
    return r->reason == CAGE_REASON_PATH ? form_path(q, r) : "joined without a path for a reason";
}

static const char *form_collision(const question *q, const cage_result *r)
{
    const cage_pose *pose = r->reason == CAGE_REASON_START ? q->start : r->reason == CAGE_REASON_GOAL ? q->goal : NULL;
    if (!pose) {
        return "collides neither at start nor at goal";
    }
    return pose_depth(q, pose) > -ORACLE_SLACK ? NULL : "said to collide, but free";
}

static const char *form_undefined(const question *q, const cage_result *r)
{
    switch (r->reason) {
    case CAGE_REASON_LEVEL:
    case CAGE_REASON_CELLS:
        return NULL;
    case CAGE_REASON_SIDE:
        return q->limits->side == CAGE_SIDE_BOTH ? "both sides were asked for" : NULL;
    default:
        return "undefined without a reason";
    }
}

static const char *form_of_verdict(const question *q, const cage_result *r)
{
    switch (r->verdict) {
    case CAGE_UNDEFINED:
        return form_undefined(q, r);
    case CAGE_CAGED:
        return q->goal ? "a goal was given" : form_separated(q, r);
    case CAGE_DISCONNECTED:
        return q->goal ? form_separated(q, r) : "no goal was given";
    case CAGE_FREE:
        return q->goal ? "a goal was given" : form_joined(q, r);
    case CAGE_CONNECTED:
        return q->goal ? form_joined(q, r) : "no goal was given";
    case CAGE_IN_COLLISION:
        return form_collision(q, r);
    default:
        return "no verdict of this library";
    }
}

static const char *form_limits(const question *q, const cage_result *r)
{
    if (r->level > q->limits->max_level) {
        return "finer than max_level";
    }
    return r->cells > q->limits->max_cells ? "more cells than max_cells" : NULL;
}

const char *referee_form(const question *q, const cage_result *r)
{
    const char *wrong = form_of_verdict(q, r);
    int joined = r->verdict == CAGE_FREE || r->verdict == CAGE_CONNECTED;
    if (wrong) {
        return wrong;
    }
    if (!joined && r->path_count != 0) {
        return "a path nobody promised";
    }
    return form_limits(q, r);
}

static int separated(int32_t verdict)
{
    return verdict == CAGE_CAGED || verdict == CAGE_DISCONNECTED;
}

static int joined(int32_t verdict)
{
    return verdict == CAGE_FREE || verdict == CAGE_CONNECTED;
}

const char *referee_contradiction(int32_t one, int32_t other)
{
    if ((separated(one) && joined(other)) || (joined(one) && separated(other))) {
        return "one says separated, the other joined";
    }
    if ((one == CAGE_IN_COLLISION && referee_decided(other)) || (other == CAGE_IN_COLLISION && referee_decided(one))) {
        return "one says in collision, the other goes on";
    }
    return NULL;
}

const char *referee_least(const question *q, int32_t truth, int32_t verdict, void *memory, size_t bytes, cage_result *result)
{
    cage_limits limits = *q->limits;
    const question inner = {q->view, q->start, q->goal, &limits};
    limits.side = CAGE_SIDE_INNER;
    int32_t error = referee_prove_small(&inner, 0, memory, bytes, result);
    const char *wrong = error == CAGE_OK ? referee_form(&inner, result) : cage_error_text(error);
    wrong = wrong ? wrong : referee_contradiction(result->verdict, truth);
    return wrong ? wrong : referee_contradiction(result->verdict, verdict);
}

const char *referee_difference(const cage_result *a, const cage_result *b, int with_peak)
{
#define SAME(field)                                       \
    if (memcmp(&a->field, &b->field, sizeof a->field)) { \
        return #field;                                   \
    }
    SAME(verdict)
    SAME(reason)
    SAME(level)
    SAME(cells)
    SAME(slices)
    SAME(gluings)
    SAME(mixtures)
    SAME(reached)
    SAME(balls)
    SAME(inserted)
    SAME(steps)
    SAME(pivot)
    SAME(path_count)
#undef SAME
    if (with_peak && a->peak_bytes != b->peak_bytes) {
        return "peak_bytes";
    }
    if (a->path_count > 0 && memcmp(a->path, b->path, (size_t)a->path_count * sizeof *a->path)) {
        return "path";
    }
    return NULL;
}
