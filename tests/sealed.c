/* sealed.c: writing into the bytes of an atlas, and giving them the right check sum again. */
#include "sealed.h"

#include "words.h"

void sealed_put(unsigned char *byte, size_t word, uint32_t value)
{
    for (int i = 0; i < 4; i++)
        byte[4 * word + (size_t)i] = (unsigned char)(value >> (8 * i));
}

void sealed_sum(unsigned char *byte, size_t size)
{
    const size_t from = 4 * (CAGE_WORDS_SUM + 2);
    uint64_t sum = cage_words_sum(cage_words_sum(0, byte, 4 * CAGE_WORDS_SUM), byte + from, size - from);
    sealed_put(byte, CAGE_WORDS_SUM, (uint32_t)sum);
    sealed_put(byte, CAGE_WORDS_SUM + 1, (uint32_t)(sum >> 32));
}
