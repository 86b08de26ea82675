/* words: numbers of 32 bits as bytes, least significant first, the same on every machine; and a sum that notices changes. */
#ifndef CAGE_WORDS_H
#define CAGE_WORDS_H

#include <stddef.h>
#include <stdint.h>

#include "wide.h"

/* Writes one word after the other; counts them even where there is nothing to write to. */
struct cage_pen {
    unsigned char *byte; /* null: only count */
    uint32_t words;
};

/* Any place that was put before, or the next. */
void cage_words_put_at(struct cage_pen *pen, uint32_t word, uint32_t value);

void cage_words_put(struct cage_pen *pen, uint32_t value);

static CAGE_INLINE uint32_t cage_words_get(const unsigned char *byte, uint32_t word)
{
    const unsigned char *b = byte + 4 * (size_t)word;
    return b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
}

/* As it was before it was put as uint32_t. */
static CAGE_INLINE int32_t cage_words_number(uint32_t word)
{
    return word < (uint32_t)1 << 31 ? (int32_t)word : -1 - (int32_t)~word;
}

/* The cyclic redundancy check CRC-64/XZ, of all bytes given so far; first of none: 0. It notices every error within 64 bits, and
 * any other but for one in 2^64. */
uint64_t cage_words_sum(uint64_t sum, const unsigned char *byte, size_t count);

/* Both kinds of file that libcage writes begin with these words. */
enum {
    CAGE_WORDS_MAGIC = 0,
    CAGE_WORDS_FORMAT = 1,
    CAGE_WORDS_COUNT = 2, /* of all words, < 2^31 */
    CAGE_WORDS_SUM = 3    /* two words: cage_words_sum of all bytes before and after them */
};

/* Fill in the count and the sum, when all else was put. */
void cage_words_seal(struct cage_pen *pen);

/* Are these size bytes a whole and unchanged file of that magic and format, of `least` words at least? */
bool cage_words_are_sealed(const unsigned char *byte, size_t size, uint32_t magic, uint32_t format, uint32_t least);

#endif
