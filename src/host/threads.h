/* threads: a cage_workers on several cores. */
#ifndef CAGE_HOST_THREADS_H
#define CAGE_HOST_THREADS_H

#include "cage.h"

typedef struct host_threads host_threads;

/* A crew of `count` (1 to 64), the caller's thread included, and its workers in *workers, with room for slices of so
 * many balls. Null where threads or memory cannot be had: the proof then runs without. */
host_threads *host_threads_start(int32_t count, uint64_t balls, cage_workers *workers);

void host_threads_stop(host_threads *threads);

/* Cores that this machine has. */
int32_t host_threads_cores(void);

#endif
