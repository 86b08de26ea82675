/* run: the proof of one question as one or two searches, step by step.
 *
 * In space two searches take turns: the one that follows the inner side's way out, and an outer one with cells of its
 * own, cut evenly. The way that the inner slices leave open is often none there, and cutting along it finds out
 * slowly. The first that has an answer answers for both. */
#include "proof.h"

/* The second search may take one step in so many, and later one in so many: an escape is found early or hardly at
 * all, a cage takes long. So may, late, the outer side of the first. */
enum { EARLY = 16384, SECOND_EARLY = 3, SECOND_LATE = 16, GUIDED_EARLY = 2, GUIDED_LATE = 12 };

/* Is that no more than its share of the steps? */
static bool is_share(int64_t taken, int64_t steps, int32_t early, int32_t late)
{
    return steps < EARLY ? taken * early <= steps : (taken - EARLY / early) * late <= steps - EARLY;
}

bool cage_proof_spares_outer(const struct cage_proof *proof)
{
    return proof->second && proof->result.steps > EARLY &&
           !is_share(proof->outer_steps, proof->result.steps, GUIDED_EARLY, GUIDED_LATE);
}

/* The search whose turn it is. */
static struct cage_proof *next_search(struct cage_proof *proof)
{
    struct cage_proof *second = proof->second;
    bool its_turn = second && !cage_proof_is_done(second) &&
                    is_share(second->result.steps + 1, proof->result.steps, SECOND_EARLY, SECOND_LATE);
    return its_turn ? second : proof;
}

void cage_proof_total(struct cage_proof *proof)
{
    const struct cage_proof *second = proof->second;
    struct cage_result *total = &proof->total;
    proof->result.peak_bytes = proof->arena.peak + proof->scratch.peak;
    *total = proof->result;
    if (!second)
        return;
    const struct cage_result *other = &second->result;
    total->level = other->level > total->level ? other->level : total->level;
    total->cells += other->cells;
    total->slices[CAGE_OUTER] += other->slices[CAGE_OUTER];
    total->gluings[CAGE_OUTER] += other->gluings[CAGE_OUTER];
    total->mixtures[CAGE_OUTER] += other->mixtures[CAGE_OUTER];
    total->reached[CAGE_OUTER] += other->reached[CAGE_OUTER];
    total->balls[CAGE_OUTER] += other->balls[CAGE_OUTER];
    total->inserted[CAGE_OUTER] += other->inserted[CAGE_OUTER];
    total->steps += other->steps;
    total->peak_bytes += second->arena.peak + second->scratch.peak;
    if (other->path) {
        total->verdict = other->verdict;
        total->reason = other->reason;
        total->path = other->path;
        total->path_count = other->path_count;
    }
}

/* Has the first search an answer, or the second a path? */
static bool answered(const struct cage_proof *proof)
{
    return cage_proof_is_done(proof) || (proof->second && proof->second->result.path);
}

int32_t cage_proof_report(struct cage_proof *proof)
{
    cage_proof_total(proof);
    if (proof->error == CAGE_ERROR_MEMORY)
        proof->total.needed_bytes = cage_proof_needed(proof);
    return proof->error != CAGE_OK ? proof->error : answered(proof);
}

int32_t cage_prove_run(cage_proof *proof, int64_t steps)
{
    if (!proof)
        return CAGE_ERROR_ARGUMENT;
    for (; steps > 0 && !answered(proof) && proof->error == CAGE_OK; steps--)
        proof->error = cage_proof_step(next_search(proof));
    return cage_proof_report(proof);
}

const cage_result *cage_prove_result(const cage_proof *proof)
{
    return proof ? &proof->total : NULL;
}
