/* threads: a cage_workers on several cores. */
#include "threads.h"

#include <pthread.h>
#include <stdlib.h>
#include <unistd.h>

#define MOST 64

/* A tetrahedron takes about 50 bytes, a ball has about 7 in a slice and many more of what is needed to build it; and
 * so many slices a worker. */
#define BYTES_A_BALL 2000
#define SLICES 24
#define LEAST ((uint64_t)4 << 20)
#define MOST_BYTES ((uint64_t)256 << 20)

struct host_threads {
    pthread_mutex_t lock;
    pthread_cond_t wake, idle;
    pthread_t thread[MOST];
    int32_t count;   /* threads beside the caller's */
    int32_t started; /* how many have taken their number */
    int32_t busy;    /* of them, working */
    int32_t next, tasks;
    uint64_t jobs;   /* handed out so far */
    int stop;
    void (*task)(void *data, int32_t index, int32_t worker);
    void *data;
    void *memory;
};

/* Take tasks until there are none; the lock is held before and after. */
static void take_tasks(host_threads *threads, int32_t worker)
{
    while (threads->next < threads->tasks) {
        const int32_t index = threads->next++;
        (void)pthread_mutex_unlock(&threads->lock);
        threads->task(threads->data, index, worker);
        (void)pthread_mutex_lock(&threads->lock);
    }
}

static void *live(void *argument)
{
    host_threads *threads = argument;
    uint64_t seen = 0;

    (void)pthread_mutex_lock(&threads->lock);
    const int32_t worker = ++threads->started;
    while (!threads->stop) {
        if (threads->jobs == seen) {
            (void)pthread_cond_wait(&threads->wake, &threads->lock);
            continue;
        }
        seen = threads->jobs;
        threads->busy++;
        take_tasks(threads, worker);
        threads->busy--;
        (void)pthread_cond_signal(&threads->idle);
    }
    (void)pthread_mutex_unlock(&threads->lock);
    return NULL;
}

static void run(void *context, int32_t tasks, void (*task)(void *, int32_t, int32_t), void *data)
{
    host_threads *threads = context;

    (void)pthread_mutex_lock(&threads->lock);
    threads->task = task;
    threads->data = data;
    threads->next = 0;
    threads->tasks = tasks;
    threads->jobs++;
    (void)pthread_cond_broadcast(&threads->wake);
    take_tasks(threads, 0);
    while (threads->busy > 0)
        (void)pthread_cond_wait(&threads->idle, &threads->lock);
    (void)pthread_mutex_unlock(&threads->lock);
}

host_threads *host_threads_start(int32_t count, uint64_t balls, cage_workers *workers)
{
    host_threads *threads = calloc(1, sizeof *threads);
    uint64_t each = balls * BYTES_A_BALL * SLICES, all;

    if (threads == NULL)
        return NULL;
    each = each < LEAST ? LEAST : each > MOST_BYTES ? MOST_BYTES : each;
    count = count > MOST ? MOST : count;
    all = each * (uint64_t)count;
    threads->memory = all <= SIZE_MAX ? malloc((size_t)all) : NULL;
    if (threads->memory == NULL || pthread_mutex_init(&threads->lock, NULL) != 0 ||
        pthread_cond_init(&threads->wake, NULL) != 0 || pthread_cond_init(&threads->idle, NULL) != 0) {
        free(threads->memory);
        free(threads);
        return NULL;
    }
    while (threads->count + 1 < count && pthread_create(&threads->thread[threads->count], NULL, live, threads) == 0)
        threads->count++;
    workers->count = threads->count + 1;
    workers->run = run;
    workers->context = threads;
    workers->memory = threads->memory;
    workers->bytes = (size_t)all;
    return threads;
}

void host_threads_stop(host_threads *threads)
{
    if (threads == NULL)
        return;
    (void)pthread_mutex_lock(&threads->lock);
    threads->stop = 1;
    (void)pthread_cond_broadcast(&threads->wake);
    (void)pthread_mutex_unlock(&threads->lock);
    for (int32_t i = 0; i < threads->count; i++)
        (void)pthread_join(threads->thread[i], NULL);
    (void)pthread_cond_destroy(&threads->idle);
    (void)pthread_cond_destroy(&threads->wake);
    (void)pthread_mutex_destroy(&threads->lock);
    free(threads->memory);
    free(threads);
}

int32_t host_threads_cores(void)
{
    const long cores = sysconf(_SC_NPROCESSORS_ONLN);
    return cores < 1 ? 1 : cores > MOST ? MOST : (int32_t)cores;
}
