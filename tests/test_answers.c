/* test_answers.c: whole answers in the plane against an independent oracle, and against themselves. */
#include "support.h"

#include <stdlib.h>
#include <string.h>

#include "oracle.h"
#include "referee.h"
#include "scenes.h"

#define PLENTY ((size_t)192 << 20)
#define VOXELS 192

static unsigned char *block; /* PLENTY bytes, never cleared: answers must not depend on what is in them */
static unsigned char *spare;

static int32_t scenes_wanted(void)
{
    return test_scenes(500);
}

static void blocks_make(void)
{
    block = test_alloc(PLENTY);
    spare = test_alloc(PLENTY);
}

static void blocks_drop(void)
{
    free(block);
    free(spare);
}

/* A scene with the question it asks under default limits; not to be copied. */
typedef struct asked {
    scene s;
    cage_scene view;
    cage_limits limits;
    question q;
} asked;

static void ask(asked *a)
{
    a->view = scene_view(&a->s);
    cage_limits_default(&a->limits, 2);
    a->q.view = &a->view;
    a->q.start = &a->s.start;
    a->q.goal = scene_goal(&a->s);
    a->q.limits = &a->limits;
}

static void ask_random(asked *a, uint64_t seed)
{
    scene_random(seed, &a->s);
    ask(a);
}

/* Much less than the defaults, so that no scene takes long; soak.c keeps to the defaults. */
static void ask_lightly(asked *a)
{
    ask(a);
    a->limits.max_level = 9;
    a->limits.max_cells = 600;
}

static void ask_random_lightly(asked *a, uint64_t seed)
{
    scene_random(seed, &a->s);
    ask_lightly(a);
}

static void expect(const asked *a, const char *wrong, const char *what)
{
    if (wrong) {
        scene_print(stderr, &a->s);
    }
    ck_assert_msg(wrong == NULL, "seed %lu: %s: %s", (unsigned long)a->s.seed, what, wrong ? wrong : "");
}

static void prove(const asked *a, int64_t portion, unsigned char *memory, cage_result *r)
{
    int32_t error = referee_prove(&a->q, portion, memory, PLENTY, r);
    expect(a, error == CAGE_OK ? NULL : cage_error_text(error), "proof");
    expect(a, referee_form(&a->q, r), "form");
}

static int32_t judge(const asked *a)
{
    return oracle_decide(a->q.view, a->q.start, a->q.goal, VOXELS);
}

/* Is it proved separated by the least code? *inner: and by the usual code of the inner side? */
static int32_t least_code(asked *a, const cage_result *r, int32_t truth, int32_t *inner)
{
    cage_result least, usual;
    expect(a, referee_least(&a->q, truth, r->verdict, spare, PLENTY, &least), "the least code");
    a->limits.side = CAGE_SIDE_INNER;
    prove(a, 0, spare, &usual);
    *inner += referee_decided(usual.verdict);
    return referee_decided(least.verdict);
}

/* ---- against the oracle ------------------------------------------------------------------------------- */

START_TEST(answers_are_the_oracles)
{
    int32_t n = scenes_wanted(), by_oracle = 0, by_both = 0, alone = 0, small = 0, inner = 0, counts[6] = {0};
    double library = 0, slowest = 0, all = 0;
    for (int32_t seed = 0; seed < n; seed++) {
        asked a;
        cage_result r;
        ask_random_lightly(&a, (uint64_t)seed);
        clock_t start = clock();
        prove(&a, 0, block, &r);
        double took = test_seconds_since(start);
        int32_t truth = judge(&a);
        expect(&a, referee_contradiction(r.verdict, truth), "oracle");
        by_oracle += referee_decided(truth);
        by_both += referee_decided(truth) && referee_decided(r.verdict);
        alone += !referee_decided(truth) && referee_decided(r.verdict);
        counts[r.verdict]++;
        library += took;
        slowest = took > slowest ? took : slowest;
        all += test_seconds_since(start);
        small += seed % 3 == 0 ? least_code(&a, &r, truth, &inner) : 0;
    }
    printf("answers: %d scenes; library: %d caged, %d disconnected, %d free, %d connected, %d in collision, "
           "%d undefined\n", (int)n, (int)counts[CAGE_CAGED], (int)counts[CAGE_DISCONNECTED], (int)counts[CAGE_FREE],
           (int)counts[CAGE_CONNECTED], (int)counts[CAGE_IN_COLLISION], (int)counts[CAGE_UNDEFINED]);
    printf("answers: oracle decided %d, of these the library %d (%.1f %%), and %d more alone; "
           "library %.2f s, slowest %.3f s, with oracle %.1f s\n", (int)by_oracle, (int)by_both,
           by_oracle ? 100.0 * by_both / by_oracle : 100.0, (int)alone, library, slowest, all);
    printf("answers: of every third scene, the least code proved %d separated, the usual inner side %d\n", (int)small, (int)inner);
    ck_assert_int_ge(100 * by_both, 95 * by_oracle);
    ck_assert_int_ge(100 * small, 98 * inner);
}
END_TEST

/* Inner balls smaller and outer balls larger than each other: proofs must keep to their own side. */
START_TEST(each_side_keeps_to_its_balls)
{
    int32_t n = scenes_wanted() / 15 + 1;
    for (int32_t seed = 0; seed < n; seed++) {
        asked a;
        scene inner;
        cage_result r;
        ask_random_lightly(&a, (uint64_t)seed + 10000);
        inner = a.s;
        for (int32_t j = 0; j < inner.obstacle_count; j++) {
            int32_t thin = inner.obstacles[j].r / 8;
            inner.obstacles[j].r -= j % 2 ? thin : thin / 4;
        }
        a.view.obstacles.inner = inner.obstacles;
        if (seed % 3 == 0) { /* one inner ball is enough to be inside */
            a.view.object.inner_count = 1;
        }
        prove(&a, 0, block, &r);
        expect(&a, referee_contradiction(r.verdict, oracle_decide(&a.view, &a.s.start, a.q.goal, VOXELS / 2)),
               "two-sided shapes");
    }
}
END_TEST

START_TEST(single_sides_agree)
{
    int32_t n = scenes_wanted() / 10 + 1, decided = 0, both = 0;
    for (int32_t seed = 0; seed < n; seed++) {
        asked a;
        cage_result r, one;
        ask_random_lightly(&a, (uint64_t)seed + 20000);
        a.limits.max_level = 7; /* one side alone often goes on to the last cell */
        prove(&a, 0, block, &r);
        both += referee_decided(r.verdict);
        for (int32_t side = CAGE_SIDE_INNER; side <= CAGE_SIDE_OUTER; side++) {
            a.limits.side = side;
            prove(&a, 0, spare, &one);
            expect(&a, referee_contradiction(r.verdict, one.verdict), "one side against both");
            decided += referee_decided(one.verdict);
        }
        cage_result inner;
        a.limits.side = CAGE_SIDE_INNER;
        prove(&a, 0, spare, &one);
        ck_assert_int_eq(referee_prove_inner(&a.q, 1 + seed % 7, block, PLENTY, &inner), CAGE_OK);
        expect(&a, referee_difference(&one, &inner, 0), "without paths");
    }
    printf("sides: both together decided %d of %d, one after the other %d\n", (int)both, (int)n, (int)decided);
}
END_TEST

START_TEST(few_balls)
{
    for (int k = 0; k < 6 * 5; k++) {
        asked a;
        cage_result r;
        scene_random((uint64_t)k + 1, &a.s);
        a.s.object_count = k % 3;
        a.s.obstacle_count = k / 3 % 4 < a.s.obstacle_count ? k / 3 % 4 : a.s.obstacle_count;
        for (int32_t i = 0; i < a.s.object_count && k >= 15; i++) {
            a.s.object[i].r = 0;
        }
        ask(&a);
        prove(&a, 0, block, &r);
        expect(&a, referee_contradiction(r.verdict, judge(&a)), "few balls");
    }
}
END_TEST

/* ---- against itself ------------------------------------------------------------------------------------ */

/* Two ways to put one question may differ in what they leave open, never in what they say. */
static void compare(const asked *a, const asked *b, const char *what, int *unequal)
{
    cage_result r, t;
    prove(a, 0, block, &r);
    prove(b, 0, spare, &t);
    expect(a, referee_contradiction(r.verdict, t.verdict), what);
    *unequal += r.verdict != t.verdict;
    if (referee_decided(r.verdict) && referee_decided(t.verdict)) {
        ck_assert_int_eq(r.verdict, t.verdict);
    }
}

START_TEST(moved_scenes_answer_alike)
{
    int32_t n = scenes_wanted() / 10 + 1;
    int unequal = 0;
    for (int32_t seed = 0; seed < n; seed++) {
        asked a, b;
        ask_random_lightly(&a, (uint64_t)seed + 30000);
        scene_quarter_turn(&a.s, 1 + seed % 3, &b.s);
        ask_lightly(&b);
        compare(&a, &b, "quarter turn", &unequal);
    }
    printf("moved: %d scenes, %d decided in one place only\n", (int)n, unequal);
    ck_assert_int_le(unequal, 1 + n / 10);
}
END_TEST

START_TEST(swapped_ends_answer_alike)
{
    int32_t n = scenes_wanted() / 5 + 1;
    int unequal = 0;
    for (int32_t seed = 0; seed < n; seed++) {
        asked a, b;
        ask_random_lightly(&a, (uint64_t)seed + 40000);
        if (a.s.has_goal) {
            scene_swap(&a.s, &b.s);
            ask_lightly(&b);
            compare(&a, &b, "swapped", &unequal);
        }
    }
    printf("swapped: %d decided from one end only\n", unequal);
    ck_assert_int_le(unequal, 1 + n / 10);
}
END_TEST

static void reverse(cage_ball *balls, int32_t n)
{
    for (int32_t i = 0; i < n / 2; i++) {
        cage_ball b = balls[i];
        balls[i] = balls[n - 1 - i];
        balls[n - 1 - i] = b;
    }
}

START_TEST(order_of_balls_does_not_matter)
{
    int32_t n = scenes_wanted() / 20 + 1;
    int unequal = 0;
    for (int32_t seed = 0; seed < n; seed++) {
        asked a, b;
        ask_random_lightly(&a, (uint64_t)seed + 50000);
        b.s = a.s;
        reverse(b.s.object, b.s.object_count);
        reverse(b.s.obstacles, b.s.obstacle_count);
        ask_lightly(&b);
        compare(&a, &b, "order", &unequal);
    }
    ck_assert_int_le(unequal, 1 + n / 10);
}
END_TEST

/* Runs in random portions; every result on the way must call itself unfinished. */
static void prove_in_pieces(const asked *a, uint64_t *rng, int32_t most, cage_result *r)
{
    cage_proof *proof = NULL;
    int64_t allowed = 0;
    int32_t done = 0;
    ck_assert_int_eq(cage_prove_begin(&proof, a->q.view, a->q.start, a->q.goal, a->q.limits, spare, PLENTY), CAGE_OK);
    while (done == 0) {
        int32_t portion = scene_between(rng, 1, most);
        allowed += portion;
        done = cage_prove_run(proof, portion);
        ck_assert(cage_prove_result(proof)->steps <= allowed);
        if (done == 0) {
            ck_assert_int_eq(cage_prove_result(proof)->verdict, CAGE_UNDEFINED);
            ck_assert_int_eq(cage_prove_result(proof)->reason, CAGE_REASON_RUNNING);
        }
    }
    ck_assert_int_eq(done, 1);
    *r = *cage_prove_result(proof);
    ck_assert_int_eq(cage_prove_run(proof, 1), 1);
    expect(a, referee_difference(r, cage_prove_result(proof), 1), "run again when finished");
}

START_TEST(portions_do_not_matter)
{
    int32_t n = scenes_wanted() / 10 + 1;
    uint64_t rng = 3;
    for (int32_t seed = 0; seed < n; seed++) {
        asked a;
        cage_result r, t;
        ask_random_lightly(&a, (uint64_t)seed + 60000);
        prove(&a, 0, block, &r);
        prove_in_pieces(&a, &rng, seed % 2 ? 1 : 1000, &t);
        expect(&a, referee_difference(&r, &t, 1), "portions");
    }
}
END_TEST

/* ---- paths ----------------------------------------------------------------------------------------------- */

/* Quaternions of all lengths turn alike. */
static void stretch(uint64_t *rng, cage_pose *pose)
{
    int32_t by = 1 << scene_between(rng, 0, 14); /* entries are at most 700 (20 + 40) */
    pose->q[0] *= by;
    pose->q[3] *= by;
}

static void leg_random(uint64_t *rng, const scene *s, cage_pose leg[2])
{
    int32_t far_out = 1 << scene_between(rng, 4, 24);
    leg[0] = s->start;
    leg[0].x[0] += scene_between(rng, -far_out, far_out);
    leg[0].x[1] += scene_between(rng, -far_out, far_out);
    leg[1] = leg[0];
    if (scene_between(rng, 0, 2) == 0) {
        leg[1].x[0] += scene_between(rng, -far_out, far_out);
        leg[1].x[1] += scene_between(rng, -far_out, far_out);
    } else {
        int32_t little = scene_between(rng, 1, 40), w = leg[0].q[0], z = leg[0].q[3];
        leg[1].q[0] = 20 * w - little * z; /* turned by 2 atan(little / 20) or back */
        leg[1].q[3] = 20 * z + little * w;
    }
    stretch(rng, &leg[0]);
    stretch(rng, &leg[1]);
}

static long double longest_arm(const scene *s)
{
    long double most = 0;
    for (int32_t i = 0; i < s->object_count; i++) {
        long double x = s->object[i].x, y = s->object[i].y, arm = (x < 0 ? -x : x) + (y < 0 ? -y : y);
        most = arm > most ? arm : most;
    }
    return most;
}

/* cage_path_check accepts nothing that collides, and all that keeps clear by 16 units and some of the arc. */
START_TEST(path_check_is_right)
{
    static const int32_t pivot[3] = {0, 0, 0};
    int32_t n = scenes_wanted() * 5, accepted = 0, refused = 0;
    uint64_t rng = 17;
    for (int32_t k = 0; k < n; k++) {
        asked a;
        cage_pose leg[2];
        const char *wrong;
        ask_random(&a, (uint64_t)k / 5 + 100000);
        leg_random(&rng, &a.s, leg);
        int same = leg[0].x[0] == leg[1].x[0] && leg[0].x[1] == leg[1].x[1];
        long double depth = oracle_check_path(&a.view, &leg[0], &leg[1], pivot, leg, 2, &wrong);
        long double clear = 16 + (same ? longest_arm(&a.s) / 25 : 0);
        int32_t answer = cage_path_check(&a.view, &leg[0], &leg[1], pivot, leg, 2);
        ck_assert(wrong == NULL && (answer == 0 || answer == 1));
        expect(&a, answer == 1 && depth > ORACLE_SLACK ? "accepts a collision" : NULL, "path check");
        expect(&a, answer == 0 && depth < -clear ? "refuses a clear leg" : NULL, "path check");
        accepted += answer;
        refused += 1 - answer;
    }
    printf("path check: %d legs accepted, %d refused\n", (int)accepted, (int)refused);
    ck_assert(n < 1000 || (accepted > n / 10 && refused > n / 10));
}
END_TEST

/* ---- memory ---------------------------------------------------------------------------------------------- */

#define CANARY 64
#define SWEEP ((size_t)8 << 20)

/* Proves in exactly bytes bytes at an offset, between canaries, in a block full of junk: the error or the answer. */
static int32_t prove_squeezed(const asked *a, size_t bytes, size_t offset, const cage_result *right)
{
    unsigned char *start = spare + CANARY + offset;
    cage_result r;
    memset(spare, 0x5a, CANARY + offset);
    memset(start + bytes, 0x5a, CANARY);
    memset(start, (int)(bytes & 1 ? 0xff : 0x00), bytes < 65536 ? bytes : 65536);
    int32_t error = referee_prove(&a->q, 0, start, bytes, &r);
    for (size_t i = 0; i < CANARY; i++) {
        ck_assert_msg(spare[offset + i] == 0x5a && start[bytes + i] == 0x5a, "canary, %lu bytes", (unsigned long)bytes);
    }
    if (error == CAGE_OK) {
        expect(a, referee_difference(right, &r, 0), "squeezed");
    } else {
        ck_assert_int_eq(error, CAGE_ERROR_MEMORY);
        ck_assert(r.needed_bytes == 0 || r.needed_bytes > bytes);
    }
    return error;
}

/* Some size that is enough, within a hundredth; smaller ones may do by luck. */
static size_t enough_for(const asked *a, const cage_result *right)
{
    size_t low = 0, high = 1024;
    while (high < SWEEP && prove_squeezed(a, high, 0, right) != CAGE_OK) {
        low = high;
        high *= 2;
    }
    while (high - low > high / 100 + 1) {
        size_t middle = low + (high - low) / 2;
        if (prove_squeezed(a, middle, 0, right) == CAGE_OK) {
            high = middle;
        } else {
            low = middle;
        }
    }
    return high;
}

/* Every byte up to some KB, then odd steps up to twice of what is enough, then every byte around that. */
static void sweep(const asked *a, const cage_result *right, size_t *runs, size_t *answered)
{
    size_t enough = enough_for(a, right), bytes = 0;
    expect(a, enough < SWEEP ? NULL : "not small", "memory");
    while (bytes < 2 * enough) {
        *answered += prove_squeezed(a, bytes, *runs % 16, right) == CAGE_OK;
        ++*runs;
        bytes += bytes < 2048 ? 1 : enough / 67 + *runs % 7 + 1;
    }
    for (bytes = enough - 20; bytes < enough + 20; bytes++) {
        prove_squeezed(a, bytes, bytes % 8, right);
    }
}

/* One scene for each way to be decided, with little work each. */
START_TEST(any_block_gives_the_error_or_the_answer)
{
    size_t runs = 0, answered = 0;
    int seen[6] = {0}, wanted = scenes_wanted() < 100 ? 2 : 4;
    for (uint64_t seed = 0; seed < 500 && wanted > 0; seed++) {
        asked a;
        cage_result right;
        ask_random(&a, seed);
        a.limits.max_cells = 128; /* room for cells is taken at once */
        prove(&a, 0, block, &right);
        if (referee_decided(right.verdict) && right.steps >= 20 && right.steps < 90 && !seen[right.verdict]) {
            seen[right.verdict] = 1;
            wanted--;
            sweep(&a, &right, &runs, &answered);
        }
    }
    printf("memory: %lu sizes, %lu answered\n", (unsigned long)runs, (unsigned long)answered);
    ck_assert(wanted == 0 && answered > 0 && answered < runs);
}
END_TEST

/* What an error says is needed leads to an answer in a few rounds. */
START_TEST(needed_bytes_lead_to_the_answer)
{
    int32_t n = scenes_wanted() / 100 + 1;
    for (int32_t seed = 0; seed < n; seed++) {
        asked a;
        cage_result r, t;
        ask_random_lightly(&a, (uint64_t)seed + 80000);
        a.limits.max_cells = 128;
        prove(&a, 0, block, &r);
        size_t bytes = cage_prove_size(&a.view, &a.limits);
        ck_assert(bytes > 0 && bytes <= PLENTY);
        int rounds = 0;
        while (referee_prove(&a.q, 0, spare, bytes, &t) == CAGE_ERROR_MEMORY && rounds < 100) {
            ck_assert(t.needed_bytes > bytes && t.needed_bytes <= PLENTY);
            bytes = (size_t)t.needed_bytes;
            rounds++;
        }
        ck_assert(rounds < 100);
        expect(&a, referee_difference(&r, &t, 0), "after more memory");
    }
}
END_TEST

static void add(Suite *suite, const char *name, const TTest *one, const TTest *two, const TTest *three)
{
    const TTest *tests[3] = {one, two, three};
    TCase *group = test_case(suite, name);
    tcase_set_timeout(group, 0);
    tcase_add_checked_fixture(group, blocks_make, blocks_drop);
    for (int k = 0; k < 3; k++) {
        if (tests[k]) {
            tcase_add_test(group, tests[k]);
        }
    }
}

int main(void)
{
    Suite *suite = suite_create("answers");
    add(suite, "oracle", answers_are_the_oracles, few_balls, NULL);
    add(suite, "sides", each_side_keeps_to_its_balls, single_sides_agree, NULL);
    add(suite, "alike", moved_scenes_answer_alike, swapped_ends_answer_alike, order_of_balls_does_not_matter);
    add(suite, "portions", portions_do_not_matter, NULL, NULL);
    add(suite, "paths", path_check_is_right, NULL, NULL);
    add(suite, "memory", any_block_gives_the_error_or_the_answer, needed_bytes_lead_to_the_answer, NULL);
    return test_main(suite);
}
