/* test_wide.c: every operation of wide.h against GMP, in both builds, and proof that the comparison can fail. */
#include "support.h"

#include <string.h>

#include <gmp.h>

#include "backend.h"

#define TOP (UINT64_C(1) << 63)
#define ONES UINT64_MAX

static mpz_t one, x, y, u, v, expected, scratch;

static void numbers_init(void) { mpz_inits(one, x, y, u, v, expected, scratch, NULL); mpz_set_ui(one, 1); }
static void numbers_clear(void) { mpz_clears(one, x, y, u, v, expected, scratch, NULL); }

/* The value of the low `count` words, signed or not. */
static void number_of(mpz_t out, words a, int count, bool is_signed)
{
    mpz_import(out, (size_t)count, -1, sizeof(uint64_t), 0, 0, a.word);
    if (is_signed && a.word[count - 1] & TOP) {
        mpz_mul_2exp(scratch, one, 64 * (unsigned)count);
        mpz_sub(out, out, scratch);
    }
}

static void set_int64(mpz_t out, int64_t a)
{
    words w = {{(uint64_t)a, 0, 0, 0}};
    number_of(out, w, 1, true);
}

/* a modulo 2^(64 count) as words */
static words words_of(const mpz_t a, int count)
{
    words out = {{0, 0, 0, 0}};
    mpz_fdiv_r_2exp(scratch, a, 64 * (unsigned)count);
    mpz_export(out.word, NULL, -1, sizeof(uint64_t), 0, 0, scratch);
    return out;
}

/* |a| < 2^bits */
static bool within(const mpz_t a, unsigned bits) { return mpz_sgn(a) == 0 || mpz_sizeinbase(a, 2) <= bits; }

/* The nearest to a within +-limit; limit may lose its sign. */
static void clamp(mpz_t a, mpz_t limit)
{
    if (mpz_cmpabs(a, limit) <= 0)
        return;
    if (mpz_sgn(a) < 0)
        mpz_neg(limit, limit);
    mpz_set(a, limit);
}

/* What op must give, in GMP; false when the operands are outside its contract. */
static bool define(enum wide_op op, words a, words b, int64_t c, words *out)
{
    int count = 2; /* words of the result */
    number_of(x, a, 2, true);
    number_of(y, b, 2, true);
    number_of(u, a, 2, false);
    number_of(v, b, 2, false);
    set_int64(expected, c);
    switch (op) {
    case WIDE_MAKE: mpz_set(expected, x); break;
    case WIDE_OF: break;
    case WIDE_MUL: number_of(x, a, 1, true); mpz_mul(expected, expected, x); break;
    case WIDE_UMUL: number_of(u, a, 1, false); number_of(v, b, 1, false); mpz_mul(expected, u, v); break;
    case WIDE_ADD: mpz_add(expected, x, y); break;
    case WIDE_SUB: mpz_sub(expected, x, y); break;
    case WIDE_ADD_PRODUCT: number_of(y, b, 1, true); mpz_mul(expected, expected, y); mpz_add(expected, expected, x); break;
    case WIDE_SCALE: mpz_mul(expected, expected, x); break;
    case WIDE_SHR: mpz_fdiv_q_2exp(expected, u, b.word[0] % 128); break;
    case WIDE_SHL: mpz_mul_2exp(expected, u, b.word[0] % 128); break;
    case WIDE_NEGATIVE: count = 1; mpz_set_si(expected, mpz_sgn(x) < 0); break;
    case WIDE_SIGN: count = 1; mpz_set_si(expected, mpz_sgn(x)); break;
    case WIDE_ABS: mpz_abs(expected, x); break;
    case WIDE_COMPARE: count = 1; mpz_set_si(expected, (mpz_cmp(x, y) > 0) - (mpz_cmp(x, y) < 0)); break;
    case WIDE_BITS: count = 1; mpz_set_ui(expected, mpz_sgn(u) ? mpz_sizeinbase(u, 2) : 0); break;
    case WIDE_QUOTIENT:
    case WIDE_REMAINDER:
        if (mpz_sgn(v) == 0 || !within(v, 127))
            return false;
        if (op == WIDE_QUOTIENT)
            mpz_fdiv_q(expected, u, v);
        else
            mpz_fdiv_r(expected, u, v);
        break;
    case WIDE_SHORT_QUOTIENT:
        number_of(u, a, 1, false);
        number_of(v, b, 1, false);
        if (mpz_sgn(v) == 0)
            return false;
        mpz_fdiv_q(expected, u, v);
        break;
    case WIDE_NEAREST:
        if (mpz_sgn(y) == 0 || !within(x, 125) || !within(y, 126) || c < 0)
            return false;
        /* floor((2 x + y) / (2 y)): the nearest, halves upward, whatever the signs */
        count = 1;
        mpz_set(u, expected);
        mpz_addmul_ui(y, x, 2);
        number_of(v, b, 2, true);
        mpz_mul_2exp(v, v, 1);
        mpz_fdiv_q(expected, y, v);
        clamp(expected, u);
        break;
    case WIDE_FLOOR:
        if (mpz_sgn(y) <= 0 || !within(x, 127) || !within(y, 127) || c < 0)
            return false;
        count = 1;
        mpz_set(u, expected);
        mpz_fdiv_q(expected, x, y);
        clamp(expected, u);
        break;
    case WIDE_ROOT:
        if (!within(u, 126))
            return false;
        count = 1;
        mpz_sqrt(expected, u);
        break;
    case WIDE_MINUS: mpz_neg(expected, x); break;
    case WIDE_PRODUCT: count = 4; mpz_mul(expected, x, y); break;
    case WIDE_SUM:
        count = 4;
        mpz_mul(expected, expected, y);
        number_of(x, a, 4, true);
        mpz_add(expected, expected, x);
        break;
    case WIDE_SIGN256: count = 1; number_of(x, a, 4, true); mpz_set_si(expected, mpz_sgn(x)); break;
    default: return false;
    }
    *out = words_of(expected, count);
    return true;
}

struct tally {
    long tried[WIDE_OPS], wrong[WIDE_OPS];
};

static const struct backend *const backends[4] = {&native, &limbs, &broken_carry, &broken_sign};
static struct tally tallies[4];

/* Every operation on these operands, in every build. */
static void compare(words a, words b, int64_t c)
{
    for (int op = 0; op < WIDE_OPS; op++) {
        words right;
        if (!define((enum wide_op)op, a, b, c, &right))
            continue;
        for (int k = 0; k < 4; k++) {
            words got = backends[k]->wide((enum wide_op)op, a, b, c);
            tallies[k].tried[op]++;
            tallies[k].wrong[op] += memcmp(&got, &right, sizeof got) != 0;
        }
    }
}

/* The two builds are right; each error is seen in the operation it was put in, and only there. */
static void judge(long at_least)
{
    for (int op = 0; op < WIDE_OPS; op++)
        for (int k = 0; k < 2; k++) {
            ck_assert_msg(tallies[k].wrong[op] == 0, "%s, operation %d: %ld of %ld wrong", backends[k]->name, op,
                          tallies[k].wrong[op], tallies[k].tried[op]);
            ck_assert_msg(tallies[k].tried[op] >= at_least, "operation %d hardly tried: %ld", op, tallies[k].tried[op]);
        }
    ck_assert_int_gt(tallies[2].wrong[WIDE_ADD], 0);
    ck_assert_int_gt(tallies[3].wrong[WIDE_MUL], 0);
    ck_assert(tallies[2].wrong[WIDE_ADD_PRODUCT] > 0 && tallies[3].wrong[WIDE_ADD_PRODUCT] > 0);
    ck_assert_int_eq(tallies[2].wrong[WIDE_SUB] + tallies[2].wrong[WIDE_MUL], 0);
    ck_assert_int_eq(tallies[3].wrong[WIDE_ADD] + tallies[3].wrong[WIDE_UMUL], 0);
    memset(tallies, 0, sizeof tallies);
}

static const uint64_t word[] = {0, 1, 2, 3, UINT64_C(0xffffffff), UINT64_C(1) << 32, UINT64_C(0x5555555555555555),
                                UINT64_C(0xaaaaaaaaaaaaaaaa), TOP - 1, TOP, TOP + 1, ONES - 1, ONES};
enum { WORDS = sizeof word / sizeof word[0] };

/* All values whose words are extreme: 0, +-1, 2^63, 2^64 - 1, 2^127 - 1, -2^127, runs of ones, carries. */
START_TEST(extreme_pairs)
{
    numbers_init();
    uint64_t state = 2;
    int step = WORDS * WORDS / test_rounds(WORDS * WORDS); /* all pairs, or in a hurry some of each number */
    for (int i = 0; i < WORDS * WORDS; i++)
        for (int j = i % step; j < WORDS * WORDS; j += step) {
            /* The upper halves only matter to 256-bit sums: take them from the same extremes. */
            words a = {{word[i % WORDS], word[i / WORDS], word[random_next(&state) % WORDS], word[j % WORDS]}};
            words b = {{word[j % WORDS], word[j / WORDS], word[random_next(&state) % WORDS], word[i % WORDS]}};
            compare(a, b, (int64_t)word[random_next(&state) % WORDS]);
        }
    judge(100);
    numbers_clear();
}
END_TEST

START_TEST(every_shift)
{
    numbers_init();
    for (int i = 0; i < WORDS * WORDS; i++)
        for (uint64_t shift = 0; shift < 128; shift++) {
            words a = {{word[i % WORDS], word[i / WORDS], 0, 0}}, b = {{shift, 0, 0, 0}}, right, got;
            for (int op = WIDE_SHR; op <= WIDE_SHL; op++)
                for (int k = 0; k < 2; k++) {
                    test_require(define((enum wide_op)op, a, b, 0, &right));
                    got = backends[k]->wide((enum wide_op)op, a, b, 0);
                    test_require(memcmp(&got, &right, sizeof got) == 0);
                }
        }
    numbers_clear();
}
END_TEST

/* Of random bit length from 0 to 64 count, random sign; now and then a run of ones or of zeros inside. */
static words random_words(uint64_t *state, int count)
{
    words out = {{0, 0, 0, 0}};
    unsigned bits = (unsigned)test_between(state, 0, 64 * count), run = (unsigned)test_between(state, 0, 64 * count);
    for (int i = 0; i < count; i++)
        out.word[i] = random_next(state);
    number_of(x, out, count, false);
    mpz_fdiv_r_2exp(x, x, bits);
    mpz_fdiv_q_2exp(y, x, run);
    mpz_mul_2exp(y, y, run);
    if (random_next(state) % 4 == 0)
        mpz_set(x, y);
    mpz_mul_2exp(u, one, run);
    mpz_sub_ui(u, u, 1);
    if (random_next(state) % 4 == 0)
        mpz_ior(x, x, u);
    if (random_next(state) & 1)
        mpz_neg(x, x);
    return words_of(x, count);
}

START_TEST(random_pairs)
{
    numbers_init();
    uint64_t state = 3;
    int32_t rounds = test_rounds(100000);
    for (int32_t i = 0; i < rounds; i++) {
        int count = random_next(&state) % 4 ? 2 : 4;
        words a = random_words(&state, count), b = random_words(&state, count);
        int64_t c = test_spread(&state, INT64_MAX);
        compare(a, b, c);
    }
    judge(rounds / 20);
    numbers_clear();
}
END_TEST

/* Quotients next to a half, squares and their neighbours: where rounding turns. */
START_TEST(rounding_edges)
{
    numbers_init();
    uint64_t state = 4;
    int32_t rounds = test_rounds(40000);
    for (int32_t i = 0; i < rounds; i++) {
        int64_t divisor = test_spread(&state, INT64_C(1) << 61), quotient = test_spread(&state, INT64_MAX);
        int64_t off = test_between(&state, -1, 1);
        set_int64(x, quotient);
        mpz_mul_2exp(x, x, 1);
        mpz_add_ui(x, x, 1);
        set_int64(y, divisor);
        mpz_mul(x, x, y);
        mpz_mul_2exp(y, y, 1);
        set_int64(u, off);
        mpz_add(x, x, u); /* x / y is a whole number and a half, or just beside it */
        words a = words_of(x, 2), b = words_of(y, 2), right, got;
        int64_t limit = random_next(&state) & 1 ? INT64_MAX : test_spread(&state, INT64_MAX);
        if (define(WIDE_NEAREST, a, b, limit, &right))
            for (int k = 0; k < 2; k++) {
                got = backends[k]->wide(WIDE_NEAREST, a, b, limit);
                test_require(memcmp(&got, &right, sizeof got) == 0);
            }
        set_int64(x, quotient >> 1);
        mpz_mul(x, x, x);
        mpz_add(x, x, u);
        if (mpz_sgn(x) < 0)
            continue;
        a = words_of(x, 2);
        if (define(WIDE_ROOT, a, b, 0, &right))
            for (int k = 0; k < 2; k++) {
                got = backends[k]->wide(WIDE_ROOT, a, b, 0);
                test_require(memcmp(&got, &right, sizeof got) == 0);
            }
    }
    numbers_clear();
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("wide");
    TCase *tests = test_case(suite, "wide");
    tcase_add_test(tests, extreme_pairs);
    tcase_add_test(tests, every_shift);
    tcase_add_test(tests, random_pairs);
    tcase_add_test(tests, rounding_edges);
    return test_main(suite);
}
