/* soak.c: hunt for contradictions over many seeds: soak FROM TO [VOXELS] [FAMILY]. */
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "oracle.h"
#include "referee.h"
#include "scenes.h"

#define BYTES ((size_t)512 << 20)
#define SLOW 0.5 /* seconds worth a line */

typedef struct tally {
    long scenes, wrong, by_oracle, by_both, alone, undecided;
    double library, oracle, slowest;
    unsigned long slowest_seed;
} tally;

static double now(void)
{
    return (double)clock() / CLOCKS_PER_SEC;
}

static void complain(tally *t, const scene *s, const char *what, const cage_result *r, int32_t truth)
{
    t->wrong++;
    printf("WRONG seed %lu: %s; library %s (%s), oracle %s\n", (unsigned long)s->seed, what,
           cage_verdict_text(r->verdict), cage_reason_text(r->reason), cage_verdict_text(truth));
    scene_print(stdout, s);
}

static void count(tally *t, const scene *s, const cage_result *r, int32_t truth, double took)
{
    t->by_oracle += referee_decided(truth);
    t->by_both += referee_decided(truth) && referee_decided(r->verdict);
    t->alone += !referee_decided(truth) && referee_decided(r->verdict);
    t->undecided += r->verdict == CAGE_UNDEFINED;
    t->library += took;
    if (took > t->slowest) {
        t->slowest = took;
        t->slowest_seed = (unsigned long)s->seed;
    }
    if (r->verdict == CAGE_UNDEFINED || took > SLOW) {
        printf("%s seed %lu (%s): %s (%s), oracle %s, %ld cells, %ld steps, %.3f s\n",
               r->verdict == CAGE_UNDEFINED ? "undecided" : "slow", (unsigned long)s->seed,
               scene_family_text(s->family), cage_verdict_text(r->verdict), cage_reason_text(r->reason),
               cage_verdict_text(truth), (long)r->cells, (long)r->steps, took);
    }
}

static void try_seed(tally *t, uint64_t seed, int voxels, void *memory)
{
    scene s;
    cage_result r;
    cage_limits limits;
    scene_random(seed, &s);
    cage_scene view = scene_view(&s);
    cage_limits_default(&limits, 2);
    question q = {&view, &s.start, scene_goal(&s), &limits};
    double start = now();
    int32_t error = referee_prove(&q, 0, memory, BYTES, &r);
    double middle = now();
    int32_t truth = oracle_decide(&view, &s.start, q.goal, voxels);
    t->scenes++;
    t->oracle += now() - middle;
    const char *wrong = error == CAGE_OK ? referee_form(&q, &r) : cage_error_text(error);
    if (!wrong) {
        wrong = referee_contradiction(r.verdict, truth);
    }
    if (!wrong) {
        cage_result least;
        wrong = referee_least(&q, truth, r.verdict, memory, BYTES, &least);
    }
    if (wrong) {
        complain(t, &s, wrong, &r, truth);
    }
    count(t, &s, &r, truth, middle - start);
}

int main(int argc, char **argv)
{
    unsigned long from = argc > 1 ? strtoul(argv[1], NULL, 10) : 0, to = argc > 2 ? strtoul(argv[2], NULL, 10) : 1000;
    int voxels = argc > 3 ? (int)strtol(argv[3], NULL, 10) : 192;
    unsigned long family = argc > 4 ? strtoul(argv[4], NULL, 10) : SCENE_FAMILIES;
    tally t = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    void *memory = malloc(BYTES);
    if (!memory) {
        fprintf(stderr, "soak: no memory\n");
        return 3;
    }
    for (unsigned long seed = from; seed < to; seed++) {
        if (family >= SCENE_FAMILIES || seed % SCENE_FAMILIES == family) {
            try_seed(&t, seed, voxels, memory);
        }
        fflush(stdout);
    }
    free(memory);
    printf("%ld scenes, %ld wrong, %ld undecided; oracle decided %ld, of these the "
           "library %ld (%.2f %%), and %ld more\n",
           t.scenes, t.wrong, t.undecided, t.by_oracle, t.by_both,
           t.by_oracle ? 100.0 * (double)t.by_both / (double)t.by_oracle : 100.0, t.alone);
    printf("library %.1f s, slowest %.3f s (seed %lu), oracle %.1f s\n", t.library, t.slowest, t.slowest_seed,
           t.oracle);
    return t.wrong ? 1 : 0;
}
