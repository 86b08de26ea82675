/* soak_space.c: hunt for contradictions in space over many seeds: soak_space FROM TO [CELLS] [MILLIONS] [FAMILY]. */
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "oracle_space.h"
#include "referee.h"
#include "scenes_space.h"

#define BYTES ((size_t)1024 << 20)
#define SLOW 5.0 /* seconds worth a line */

typedef struct tally {
    long scenes, wrong, by_oracle, by_both, alone, undecided, pairs[6][6];
    double library, oracle, slowest;
    unsigned long slowest_seed;
    space_audit audit;
} tally;

static double now(void)
{
    return (double)clock() / CLOCKS_PER_SEC;
}

static void complain(tally *t, const space_scene *s, const char *what, const cage_result *r, int32_t truth, const char *how)
{
    t->wrong++;
    printf("WRONG seed %lu: %s; library %s (%s), oracle %s by %s\n", (unsigned long)s->seed, what,
           cage_verdict_text(r->verdict), cage_reason_text(r->reason), cage_verdict_text(truth), how);
    space_print(stdout, s);
}

static void count(tally *t, const space_scene *s, const cage_result *r, int32_t truth, const char *how, double took,
                  double judging)
{
    t->pairs[truth][r->verdict]++;
    t->by_oracle += referee_decided(truth);
    t->by_both += referee_decided(truth) && referee_decided(r->verdict);
    t->alone += !referee_decided(truth) && referee_decided(r->verdict);
    t->undecided += r->verdict == CAGE_UNDEFINED;
    t->library += took;
    t->oracle += judging;
    if (took > t->slowest) {
        t->slowest = took;
        t->slowest_seed = (unsigned long)s->seed;
    }
    if (r->verdict == CAGE_UNDEFINED || took > SLOW) {
        printf("%s seed %lu (%s): %s (%s), oracle %s by %s, level %ld, %ld cells, %ld steps, %.3f s, oracle %.3f s\n",
               r->verdict == CAGE_UNDEFINED ? "undecided" : "slow", (unsigned long)s->seed,
               space_family_text(s->family), cage_verdict_text(r->verdict), cage_reason_text(r->reason),
               cage_verdict_text(truth), how, (long)r->level, (long)r->cells, (long)r->steps, took, judging);
    }
}

static void try_seed(tally *t, uint64_t seed, int32_t cells, const space_effort *effort, void *memory)
{
    space_scene s;
    cage_result r;
    cage_limits limits;
    const char *how;
    space_random(seed, &s);
    cage_scene view = space_view(&s);
    cage_limits_default(&limits, 3);
    limits.max_cells = cells;
    question q = {&view, &s.start, space_goal(&s), &limits};
    space_question asked = {&view, &s.start, q.goal, s.object_ring, s.obstacle_ring};
    double start = now();
    int32_t error = referee_prove(&q, 0, memory, BYTES, &r);
    double middle = now();
    long before = t->audit.wrong;
    int32_t truth = oracle_space_decide(&asked, effort, &t->audit, &how);
    t->scenes++;
    const char *wrong = error == CAGE_OK ? referee_form(&q, &r) : cage_error_text(error);
    if (!wrong) {
        wrong = referee_contradiction(r.verdict, truth);
    }
    if (!wrong && t->audit.wrong > before) {
        wrong = "the oracle is wrong about a pose";
    }
    if (!wrong) {
        cage_result least;
        wrong = referee_least(&q, truth, r.verdict, memory, BYTES, &least);
    }
    if (wrong) {
        complain(t, &s, wrong, &r, truth, how);
    }
    count(t, &s, &r, truth, how, middle - start, now() - middle);
}

static void sum_up(const tally *t)
{
    for (int32_t truth = 0; truth < 6; truth++) {
        for (int32_t verdict = 0; verdict < 6; verdict++) {
            if (t->pairs[truth][verdict]) {
                printf("oracle %s, library %s: %ld\n", cage_verdict_text(truth), cage_verdict_text(verdict),
                       t->pairs[truth][verdict]);
            }
        }
    }
    printf("%ld scenes, %ld wrong, %ld undecided; oracle decided %ld, of these the "
           "library %ld (%.2f %%), and %ld more; audit: %ld poses, %ld wrong\n",
           t->scenes, t->wrong, t->undecided, t->by_oracle, t->by_both,
           t->by_oracle ? 100.0 * (double)t->by_both / (double)t->by_oracle : 100.0, t->alone, t->audit.looked, t->audit.wrong);
    printf("library %.1f s, slowest %.3f s (seed %lu), oracle %.1f s\n", t->library, t->slowest, t->slowest_seed, t->oracle);
}

int main(int argc, char **argv)
{
    unsigned long from = argc > 1 ? strtoul(argv[1], NULL, 10) : 0, to = argc > 2 ? strtoul(argv[2], NULL, 10) : 300;
    int32_t cells = argc > 3 ? (int32_t)strtol(argv[3], NULL, 10) : 600;
    long millions = argc > 4 ? strtol(argv[4], NULL, 10) : 20; /* of pairs of balls the oracle looks at in one flood */
    unsigned long family = argc > 5 ? strtoul(argv[5], NULL, 10) : SPACE_FAMILIES;
    const space_effort effort = {millions * 1000000, 200, (int)(millions < 100 ? 200 * millions : 20000)};
    static tally t;
    void *memory = malloc(BYTES);
    if (!memory) {
        fprintf(stderr, "soak_space: no memory\n");
        return 3;
    }
    t.audit.every = 200;
    for (unsigned long seed = from; seed < to; seed++) {
        if (family >= SPACE_FAMILIES || seed % SPACE_FAMILIES == family) {
            try_seed(&t, seed, cells, &effort, memory);
        }
        fflush(stdout);
    }
    free(memory);
    sum_up(&t);
    return t.wrong ? 1 : 0;
}
