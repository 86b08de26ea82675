/* test_answers_space.c: whole answers in space against an independent oracle, and against themselves. */
#include "support.h"

#include <stdlib.h>
#include <string.h>

#include "oracle_space.h"
#include "referee.h"
#include "scenes.h"
#include "scenes_space.h"

#define PLENTY ((size_t)256 << 20)

static unsigned char *block; /* PLENTY bytes, never cleared: answers must not depend on what is in them */
static unsigned char *spare;

static int32_t scenes_wanted(void)
{
    return test_scenes(120);
}

/* Sanitized runs take ten times as long. */
static int quick(void)
{
    return getenv("CAGE_TEST_QUICK") != NULL;
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

/* A scene with the question it asks; not to be copied. */
typedef struct asked {
    space_scene s;
    cage_scene view;
    cage_limits limits;
    question q;
} asked;

/* Much less than the defaults, so that no scene takes long; soak_space.c allows more. */
static void ask(asked *a, int32_t cells)
{
    a->view = space_view(&a->s);
    cage_limits_default(&a->limits, 3);
    a->limits.max_cells = quick() ? cells / 3 : cells;
    a->q.view = &a->view;
    a->q.start = &a->s.start;
    a->q.goal = space_goal(&a->s);
    a->q.limits = &a->limits;
}

static void ask_random(asked *a, uint64_t seed, int32_t cells)
{
    space_random(seed, &a->s);
    ask(a, cells);
}

static void expect(const asked *a, const char *wrong, const char *what)
{
    if (wrong) {
        space_print(stderr, &a->s);
    }
    ck_assert_msg(wrong == NULL, "seed %lu: %s: %s", (unsigned long)a->s.seed, what, wrong ? wrong : "");
}

static void prove(const asked *a, int64_t portion, unsigned char *memory, cage_result *r)
{
    int32_t error = referee_prove(&a->q, portion, memory, PLENTY, r);
    expect(a, error == CAGE_OK ? NULL : cage_error_text(error), "proof");
    expect(a, referee_form(&a->q, r), "form");
}

static int is_separated(int32_t verdict)
{
    return verdict == CAGE_CAGED || verdict == CAGE_DISCONNECTED;
}

/* What the oracle says; a separation it does not know of is given to its search for paths once more. */
static int32_t judge(const asked *a, int32_t verdict, const char **how)
{
    const space_effort light = {quick() ? 300000 : 3000000, 160, quick() ? 100 : 800};
    const space_effort hard = {quick() ? 1000000 : 10000000, 160, quick() ? 500 : 5000};
    space_question q = {&a->view, &a->s.start, a->q.goal, a->s.object_ring, a->s.obstacle_ring};
    space_audit audit = {a->s.seed, 0, 0, quick() ? 50 : 500};
    int32_t truth = oracle_space_decide(&q, &light, &audit, how);
    if (truth == CAGE_UNDEFINED && is_separated(verdict) && oracle_space_joined(&q, &hard, &audit, how)) {
        truth = q.goal ? CAGE_CONNECTED : CAGE_FREE;
    }
    expect(a, audit.wrong ? "the oracle is wrong about a pose" : NULL, "audit");
    return truth;
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
        const char *how;
        ask_random(&a, (uint64_t)seed, 150);
        clock_t start = clock();
        prove(&a, 0, block, &r);
        double took = test_seconds_since(start);
        int32_t truth = judge(&a, r.verdict, &how);
        expect(&a, referee_contradiction(r.verdict, truth), how);
        by_oracle += referee_decided(truth);
        by_both += referee_decided(truth) && referee_decided(r.verdict);
        alone += !referee_decided(truth) && referee_decided(r.verdict);
        counts[r.verdict]++;
        library += took;
        slowest = took > slowest ? took : slowest;
        all += test_seconds_since(start);
        small += seed % 3 == 0 ? least_code(&a, &r, truth, &inner) : 0;
    }
    printf("answers: of every third scene, the least code proved %d separated, the usual inner side %d\n", (int)small, (int)inner);
    ck_assert_int_ge(100 * small, 98 * inner);
    printf("answers: %d scenes in space; library: %d caged, %d disconnected, %d free, %d connected, %d in collision, "
           "%d undefined\n", (int)n, (int)counts[CAGE_CAGED], (int)counts[CAGE_DISCONNECTED], (int)counts[CAGE_FREE],
           (int)counts[CAGE_CONNECTED], (int)counts[CAGE_IN_COLLISION], (int)counts[CAGE_UNDEFINED]);
    printf("answers: oracle decided %d, of these the library %d (%.1f %%), and %d more alone; "
           "library %.2f s, slowest %.3f s, with oracle %.1f s\n", (int)by_oracle, (int)by_both,
           by_oracle ? 100.0 * by_both / by_oracle : 100.0, (int)alone, library, slowest, all);
    ck_assert_int_ge(2 * by_both, n < 100 ? 0 : by_oracle);
}
END_TEST

/* Inner balls smaller than the outer ones: proofs must keep to their own side. */
START_TEST(each_side_keeps_to_its_balls)
{
    int32_t n = scenes_wanted() / 15 + 1;
    for (int32_t seed = 0; seed < n; seed++) {
        asked a;
        space_scene inner;
        cage_result r;
        const char *how;
        ask_random(&a, (uint64_t)seed * 3 + 10000, 60);
        inner = a.s;
        for (int32_t j = 0; j < inner.obstacle_count; j++) {
            int32_t thin = inner.obstacles[j].r / 8;
            inner.obstacles[j].r -= j % 2 ? thin : thin / 4;
        }
        a.view.obstacles.inner = inner.obstacles;
        if (seed % 3 == 0) { /* one inner ball is enough to be inside */
            a.view.object.inner_count = 1;
            a.s.object_ring = 0;
        }
        prove(&a, 0, block, &r);
        expect(&a, referee_contradiction(r.verdict, judge(&a, r.verdict, &how)), "two-sided shapes");
    }
}
END_TEST

START_TEST(single_sides_agree)
{
    int32_t n = scenes_wanted() / 12 + 1, decided = 0, both = 0;
    for (int32_t seed = 0; seed < n; seed++) {
        asked a;
        cage_result r, one;
        ask_random(&a, (uint64_t)seed + 20000, 40);
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

/* Up to two balls that move, up to three that do not, with and without a radius. */
START_TEST(few_balls)
{
    for (int k = 0; k < 6 * 4; k++) {
        asked a;
        cage_result r;
        const char *how;
        space_random((uint64_t)k + 1, &a.s);
        a.s.object_count = k % 3;
        a.s.obstacle_count = k / 3 % 4 < a.s.obstacle_count ? k / 3 % 4 : a.s.obstacle_count;
        a.s.object_ring = a.s.obstacle_ring = 0;
        for (int32_t i = 0; i < a.s.object_count && k >= 12; i++) {
            a.s.object[i].r = 0;
        }
        ask(&a, 60);
        prove(&a, 0, block, &r);
        expect(&a, referee_contradiction(r.verdict, judge(&a, r.verdict, &how)), "few balls");
    }
}
END_TEST

/* ---- against itself ------------------------------------------------------------------------------------ */

/* Two ways to put one question may differ in what they leave open, never in what they say. */
static void compare(const asked *a, asked *b, int32_t cells, const char *what, int *unequal)
{
    cage_result r, t;
    ask(b, cells);
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
    int32_t n = scenes_wanted() / 6 + 1;
    int unequal = 0, decided = 0;
    uint64_t rng = 5;
    for (int32_t seed = 0; seed < n; seed++) {
        asked a, b;
        int32_t by[3];
        ask_random(&a, (uint64_t)seed + 30000, 40);
        for (int k = 0; k < 3; k++) {
            by[k] = scene_between(&rng, -200000, 200000); /* the scene's own size leaves that much */
        }
        int turn = scene_between(&rng, 1, 23);
        if (seed % 3 == 0) {
            space_move_world(&a.s, turn, by, &b.s);
        } else if (seed % 3 == 1) {
            space_move_frame(&a.s, turn, 60000, &b.s);
        } else {
            space_shuffle(&a.s, rng, &b.s);
        }
        compare(&a, &b, 40, seed % 3 == 0 ? "world moved" : seed % 3 == 1 ? "frame moved" : "shuffled", &unequal);
        decided++;
    }
    printf("moved: %d scenes, %d decided in one place only\n", (int)decided, unequal);
    ck_assert_int_le(unequal, 1 + n / 5);
}
END_TEST

START_TEST(swapped_ends_answer_alike)
{
    int32_t n = scenes_wanted() / 6 + 1;
    int unequal = 0;
    for (int32_t seed = 0; seed < n; seed++) {
        asked a, b;
        ask_random(&a, (uint64_t)seed + 40000, 40);
        if (a.s.has_goal) {
            space_swap(&a.s, &b.s);
            compare(&a, &b, 40, "swapped", &unequal);
        }
    }
    printf("swapped: %d decided from one end only\n", unequal);
    ck_assert_int_le(unequal, 1 + n / 5);
}
END_TEST

/* Obstacles that grow only close ways: what is free when they are thick is free when they are thinner. joined: a path
 * is known that fits obstacles thicker by so much; caged: the least at which the library says that there is none. */
typedef struct border {
    int32_t joined, caged;
} border;

#define BORDER_CELLS 40

static void thicken(const space_scene *in, int32_t by, space_scene *out)
{
    *out = *in;
    for (int32_t j = 0; j < out->obstacle_count; j++) {
        cage_ball *o = &out->obstacles[j];
        o->r = by > -o->r ? o->r + by : 0;
    }
}

static void ask_thicker(const asked *a, int32_t by, asked *b)
{
    thicken(&a->s, by, &b->s);
    ask(b, BORDER_CELLS);
}

/* By how much the obstacles may grow so that neither end collides, by a unit at least, and the scene still fits. */
static int32_t room_to_grow(const asked *a)
{
    asked b;
    long double depth = oracle_space_depth(&a->view, &a->s.start, CAGE_SIDE_INNER);
    if (a->q.goal) {
        long double other = oracle_space_depth(&a->view, a->q.goal, CAGE_SIDE_INNER);
        depth = other > depth ? other : depth;
    }
    int32_t room = depth >= -2 ? 0 : depth < -CAGE_REACH_3D ? CAGE_REACH_3D : (int32_t)-depth - 1;
    for (ask_thicker(a, room, &b); room > 0 && cage_scene_check(&b.view) != CAGE_OK; ask_thicker(a, room, &b)) {
        room /= 2;
    }
    return room;
}

/* A path fits obstacles that are thicker by its clearance, too; beyond its end the object moves away from all of them. */
static int32_t path_clearance(const asked *a, const cage_result *r)
{
    const char *wrong;
    long double depth = oracle_space_check_path(&a->view, a->q.start, a->q.goal, r->pivot, r->path, r->path_count, &wrong);
    expect(a, wrong, "path");
    return depth < -2 ? (int32_t)-depth - 1 : 0;
}

static int32_t probe(const asked *a, int32_t by, border *known)
{
    asked b;
    cage_result r;
    ask_thicker(a, by, &b);
    prove(&b, 0, block, &r);
    expect(&b, r.verdict == CAGE_IN_COLLISION ? "an end collides" : NULL, "thickness");
    if (is_separated(r.verdict) && by < known->caged) {
        known->caged = by;
    }
    if (r.verdict == CAGE_FREE || r.verdict == CAGE_CONNECTED) {
        int32_t fits = by + path_clearance(&b, &r);
        known->joined = fits > known->joined ? fits : known->joined;
    }
    expect(&b, known->joined >= known->caged ? "separated, but joined when thicker" : NULL, "thickness");
    return r.verdict;
}

/* Halves towards the thickest obstacles that the library finds a path past, and towards the thinnest that it says there is none
 * past; in between it says neither. Then where the best path just fits. */
static void close_in(const asked *a, int32_t room, int rounds, border *known)
{
    int32_t low = -2 * room, high = room;
    for (int round = 0; round < rounds && high > low + 1; round++) {
        int32_t by = low + (high - low) / 2, verdict = probe(a, by, known);
        if (verdict == CAGE_FREE || verdict == CAGE_CONNECTED) {
            low = known->joined < high ? known->joined : high;
        } else {
            high = by;
        }
    }
    if (known->caged > room) {
        probe(a, room, known);
    }
    high = known->caged;
    for (int round = 0; round < rounds && known->caged <= room && high > low + 1; round++) {
        int32_t by = low + (high - low) / 2;
        if (is_separated(probe(a, by, known))) {
            high = by;
        } else {
            low = by;
        }
    }
    if (known->joined > INT32_MIN) {
        probe(a, known->joined, known);
    }
}

/* The least gap that the library calls closed is where an error shows first: there the oracle looks for a path. */
START_TEST(thicker_obstacles_free_nothing)
{
    int32_t n = scenes_wanted() / 6 + 1, joined = 0, caged = 0, both = 0;
    long double apart = 0;
    for (int32_t seed = 0; seed < n; seed++) {
        asked a, b;
        const char *how;
        border known = {INT32_MIN, INT32_MAX};
        ask_random(&a, (uint64_t)seed + 70000, BORDER_CELLS);
        int32_t room = room_to_grow(&a);
        if (room == 0) {
            continue;
        }
        close_in(&a, room, quick() ? 3 : 6, &known);
        joined += known.joined > INT32_MIN;
        if (known.caged == INT32_MAX) {
            continue;
        }
        ask_thicker(&a, known.caged, &b);
        expect(&b, referee_contradiction(b.q.goal ? CAGE_DISCONNECTED : CAGE_CAGED, judge(&b, CAGE_CAGED, &how)),
               "at the border");
        caged++;
        if (known.joined > INT32_MIN) {
            both++;
            apart += (long double)(known.caged - known.joined) / room;
        }
    }
    printf("borders: %d scenes, %d joined when thin, %d separated when thick, %d both, there %.1Lf %% of the room apart\n",
           (int)n, (int)joined, (int)caged, (int)both, both ? 100 * apart / both : 0.0L);
    ck_assert(n < 40 || both > n / 10);
}
END_TEST

/* Every result on the way must call itself unfinished. */
static void prove_in_pieces(const asked *a, int32_t portion, cage_result *r)
{
    cage_proof *proof = NULL;
    int64_t allowed = 0;
    int32_t done = 0;
    ck_assert_int_eq(cage_prove_begin(&proof, a->q.view, a->q.start, a->q.goal, a->q.limits, spare, PLENTY), CAGE_OK);
    while (done == 0) {
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
    int32_t n = scenes_wanted() / 6 + 1;
    for (int32_t seed = 0; seed < n; seed++) {
        asked a;
        cage_result r, t;
        ask_random(&a, (uint64_t)seed + 60000, 40);
        prove(&a, 0, block, &r);
        prove_in_pieces(&a, seed % 4 ? 7 : 1, &t);
        expect(&a, referee_difference(&r, &t, 1), "portions");
    }
}
END_TEST

/* ---- memory ---------------------------------------------------------------------------------------------- */

#define GUARD 4096 /* bytes watched on either side of a small block */
#define TRIES 40   /* at most, as each block advised has half as much again to work in */

typedef struct squeezed {
    int32_t blocks, answered, most_tries;
} squeezed;

static int is_untouched(const unsigned char *guard)
{
    for (size_t i = 0; i < GUARD; i++) {
        if (guard[i] != 0x5a) {
            return 0;
        }
    }
    return 1;
}

/* Proves in exactly so many bytes of junk: the answer, or CAGE_ERROR_MEMORY and then *next, a block to try that is larger. */
static int32_t prove_squeezed(const asked *a, size_t bytes, const cage_result *right, size_t *next, squeezed *count)
{
    cage_result r;
    unsigned char *start = spare + GUARD + count->blocks % 16;
    ck_assert(bytes <= PLENTY - 2 * GUARD - 16);
    memset(start - GUARD, 0x5a, GUARD);
    memset(start, count->blocks % 2 ? 0xff : 0x00, bytes < 65536 ? bytes : 65536);
    memset(start + bytes, 0x5a, GUARD);
    int32_t error = referee_prove(&a->q, count->blocks % 3 ? 0 : 5, start, bytes, &r);
    expect(a, is_untouched(start - GUARD) && is_untouched(start + bytes) ? NULL : "written beyond the block", "memory");
    count->blocks++;
    if (error == CAGE_OK) {
        expect(a, referee_difference(right, &r, 0), "in a smaller block");
        count->answered++;
        return error;
    }
    ck_assert_int_eq(error, CAGE_ERROR_MEMORY);
    ck_assert_int_eq(r.verdict, CAGE_UNDEFINED);
    *next = r.cells > 0 ? (size_t)r.needed_bytes : cage_prove_size(&a->view, &a->limits); /* no cells: it did not begin */
    expect(a, *next > bytes ? NULL : "no more is needed than there was", "memory");
    return error;
}

static void follow_needed(const asked *a, size_t bytes, const cage_result *right, squeezed *count)
{
    int32_t tries = 0;
    size_t next = 0;
    while (prove_squeezed(a, bytes, right, &next, count) != CAGE_OK) {
        expect(a, ++tries < TRIES && next <= PLENTY / 2 ? NULL : "what is needed leads nowhere", "memory");
        bytes = next;
    }
    count->most_tries = tries > count->most_tries ? tries : count->most_tries;
}

/* Halves the block until it is too small, closes in on what is just enough, and follows the advice from below that. */
static void squeeze(const asked *a, const cage_result *right, squeezed *count)
{
    size_t high = PLENTY / 2, low = high, next;
    while (prove_squeezed(a, low, right, &next, count) == CAGE_OK) {
        high = low;
        low /= 2;
    }
    for (size_t less = low; less > low / 16; less /= 2) {
        follow_needed(a, less, right, count);
    }
    follow_needed(a, 1, right, count);
    for (int round = 0; round < (quick() ? 2 : 5); round++) { /* where the most slices are dropped and built again */
        size_t middle = low + (high - low) / 2;
        if (prove_squeezed(a, middle, right, &next, count) == CAGE_OK) {
            high = middle;
        } else {
            low = middle;
        }
    }
    follow_needed(a, low, right, count);
}

/* More memory never changes an answer. */
START_TEST(smaller_blocks_answer_alike)
{
    int32_t n = scenes_wanted() / 10 + 1, separated = 0, joined = 0, undecided = 0;
    squeezed count = {0, 0, 0};
    for (int32_t seed = 0; seed < n; seed++) {
        asked a;
        cage_result right;
        ask_random(&a, (uint64_t)seed + 80000, 40);
        prove(&a, 0, block, &right);
        squeeze(&a, &right, &count);
        separated += is_separated(right.verdict);
        joined += right.verdict == CAGE_FREE || right.verdict == CAGE_CONNECTED;
        undecided += right.verdict == CAGE_UNDEFINED;
    }
    printf("memory: %d scenes (%d separated, %d joined, %d undecided) in %d smaller blocks, answered in %d, after %d tries at "
           "most\n",
           (int)n, (int)separated, (int)joined, (int)undecided, (int)count.blocks, (int)count.answered, (int)count.most_tries);
    ck_assert(n < 20 || (separated > 0 && joined > 0 && undecided > 0));
}
END_TEST

/* ---- paths ----------------------------------------------------------------------------------------------- */

/* Has the turn a shorter arc? */
static int has_arc(const cage_pose leg[2])
{
    int64_t dot = 0;
    for (int k = 0; k < 4; k++) {
        dot += (int64_t)leg[0].q[k] * leg[1].q[k];
    }
    return dot != 0;
}

static void leg_random(uint64_t *rng, const space_scene *s, cage_pose leg[2])
{
    int32_t far_out = 1 << scene_between(rng, 4, 20);
    leg[0] = s->start;
    for (int k = 0; k < 3; k++) {
        leg[0].x[k] += scene_between(rng, -far_out, far_out);
    }
    leg[1] = leg[0];
    if (scene_between(rng, 0, 2) == 0) {
        for (int k = 0; k < 3; k++) {
            leg[1].x[k] += scene_between(rng, -far_out, far_out);
        }
        return;
    }
    /* The sign and length of a quaternion turn nothing; entries are at most 3 700 + 300. */
    int32_t by = (scene_between(rng, 0, 1) ? -1 : 1) * (1 << scene_between(rng, 0, 12)), little = scene_between(rng, 1, 300);
    for (int k = 0; k < 4; k++) {
        leg[1].q[k] = (leg[0].q[k] * 3 + scene_between(rng, -little, little)) * by;
    }
}

static long double longest_arm(const space_scene *s)
{
    long double most = 0;
    for (int32_t i = 0; i < s->object_count; i++) {
        const cage_ball *b = &s->object[i];
        long double arm = labs((long)b->x) + labs((long)b->y) + labs((long)b->z);
        most = arm > most ? arm : most;
    }
    return most;
}

/* cage_path_check accepts nothing that collides, and all that keeps clear by 16 units and a little of the arc. */
START_TEST(path_check_is_right)
{
    static const int32_t pivot[3] = {0, 0, 0};
    int32_t n = scenes_wanted() * 5, accepted = 0, refused = 0;
    uint64_t rng = 17;
    for (int32_t k = 0; k < n; k++) {
        asked a;
        cage_pose leg[2];
        const char *wrong;
        ask_random(&a, (uint64_t)k / 5 + 100000, 2);
        leg_random(&rng, &a.s, leg);
        if (!has_arc(leg)) {
            continue;
        }
        int turns = memcmp(leg[0].q, leg[1].q, sizeof leg[0].q) != 0;
        long double depth = oracle_space_check_path(&a.view, &leg[0], &leg[1], pivot, leg, 2, &wrong);
        long double clear = 16 + (turns ? longest_arm(&a.s) / 100 : 0);
        int32_t answer = cage_path_check(&a.view, &leg[0], &leg[1], pivot, leg, 2);
        expect(&a, wrong, "leg");
        ck_assert(answer == 0 || answer == 1);
        expect(&a, answer == 1 && depth > ORACLE_SLACK ? "accepts a collision" : NULL, "path check");
        expect(&a, answer == 0 && depth < -clear ? "refuses a clear leg" : NULL, "path check");
        accepted += answer;
        refused += 1 - answer;
    }
    printf("path check: %d legs accepted, %d refused\n", (int)accepted, (int)refused);
    ck_assert(n < 500 || (accepted > n / 10 && refused > n / 10));
}
END_TEST

static void add(Suite *suite, const char *name, const TTest *one, const TTest *two)
{
    TCase *group = test_case(suite, name);
    tcase_set_timeout(group, 0);
    tcase_add_checked_fixture(group, blocks_make, blocks_drop);
    tcase_add_test(group, one);
    if (two) {
        tcase_add_test(group, two);
    }
}

int main(void)
{
    Suite *suite = suite_create("answers in space");
    add(suite, "oracle", answers_are_the_oracles, few_balls);
    add(suite, "sides", each_side_keeps_to_its_balls, single_sides_agree);
    add(suite, "alike", moved_scenes_answer_alike, swapped_ends_answer_alike);
    add(suite, "borders", thicker_obstacles_free_nothing, NULL);
    add(suite, "portions", portions_do_not_matter, NULL);
    add(suite, "memory", smaller_blocks_answer_alike, NULL);
    add(suite, "paths", path_check_is_right, NULL);
    return test_main(suite);
}
