/* referee.h: put a scene to the library, hold the answer against its contract and against the oracle. */
#ifndef REFEREE_H
#define REFEREE_H

#include "cage.h"

/* One question; the balls are read through view. */
typedef struct question {
    const cage_scene *view;
    const cage_pose *start;
    const cage_pose *goal; /* or null */
    const cage_limits *limits;
} question;

/* Runs a proof to its end, portion steps at a time (0: all at once).
 * Returns CAGE_OK or the error; result->path points into memory. */
int32_t referee_prove(const question *q, int64_t portion, void *memory, size_t bytes, cage_result *result);

/* The same with cage_prove_run_inner; limits of the inner side. */
int32_t referee_prove_inner(const question *q, int64_t portion, void *memory, size_t bytes, cage_result *result);

/* The same, begun with cage_prove_begin_small. */
int32_t referee_prove_small(const question *q, int64_t portion, void *memory, size_t bytes, cage_result *result);

/* Null, or what the answer alone has wrong: its form, its reason, its path. */
const char *referee_form(const question *q, const cage_result *r);

/* Null, or how a verdict of the library and one of the oracle (or of the library again) contradict. */
const char *referee_contradiction(int32_t one, int32_t other);

/* The question for the inner side, in the least code. Null, or what the answer has wrong, or how it contradicts one of these. */
const char *referee_least(const question *q, int32_t truth, int32_t verdict, void *memory, size_t bytes, cage_result *result);

/* Null, or the first field in which two answers to one question differ, paths included; peaks are
 * compared only on request, as they depend on how the block is aligned. */
const char *referee_difference(const cage_result *a, const cage_result *b, int with_peak);

int referee_decided(int32_t verdict);
#endif
