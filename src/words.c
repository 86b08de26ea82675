/* words: numbers of 32 bits as bytes, least significant first, the same on every machine; and a sum that notices changes. */
#include "words.h"

void cage_words_put_at(struct cage_pen *pen, uint32_t word, uint32_t value)
{
    for (int32_t i = 0; pen->byte && i < 4; i++)
        pen->byte[(size_t)word * 4 + (size_t)i] = (unsigned char)(value >> (8 * i));
}

void cage_words_put(struct cage_pen *pen, uint32_t value) { cage_words_put_at(pen, pen->words++, value); }

/* What each half of a byte adds to the sum. */
static const uint64_t LOW[16] = {
    0x0000000000000000, 0xb32e4cbe03a75f6f, 0xf4843657a840a05b, 0x47aa7ae9abe7ff34, 0x7bd0c384ff8f5e33, 0xc8fe8f3afc28015c,
    0x8f54f5d357cffe68, 0x3c7ab96d5468a107, 0xf7a18709ff1ebc66, 0x448fcbb7fcb9e309, 0x0325b15e575e1c3d, 0xb00bfde054f94352,
    0x8c71448d0091e255, 0x3f5f08330336bd3a, 0x78f572daa8d1420e, 0xcbdb3e64ab761d61};
static const uint64_t HIGH[16] = {
    0x0000000000000000, 0x7d9ba13851336649, 0xfb374270a266cc92, 0x86ace348f355aadb, 0x64b62bcaebc387a1, 0x192d8af2baf0e1e8,
    0x9f8169ba49a54b33, 0xe21ac88218962d7a, 0xc96c5795d7870f42, 0xb4f7f6ad86b4690b, 0x325b15e575e1c3d0, 0x4fc0b4dd24d2a599,
    0xadda7c5f3c4488e3, 0xd041dd676d77eeaa, 0x56ed3e2f9e224471, 0x2b769f17cf112238};

uint64_t cage_words_sum(uint64_t sum, const unsigned char *byte, size_t count)
{
    sum = ~sum;
    for (size_t i = 0; i < count; i++) {
        uint32_t next = (uint32_t)(sum ^ byte[i]) & 255;
        sum = sum >> 8 ^ LOW[next & 15] ^ HIGH[next >> 4];
    }
    return ~sum;
}

/* The sum of all but its own two words. */
static uint64_t sum_of(const unsigned char *byte, size_t size)
{
    const size_t from = 4 * (CAGE_WORDS_SUM + 2);
    return cage_words_sum(cage_words_sum(0, byte, 4 * CAGE_WORDS_SUM), byte + from, size - from);
}

void cage_words_seal(struct cage_pen *pen)
{
    cage_words_put_at(pen, CAGE_WORDS_COUNT, pen->words);
    if (!pen->byte)
        return;
    uint64_t sum = sum_of(pen->byte, 4 * (size_t)pen->words);
    cage_words_put_at(pen, CAGE_WORDS_SUM, (uint32_t)sum);
    cage_words_put_at(pen, CAGE_WORDS_SUM + 1, (uint32_t)(sum >> 32));
}

bool cage_words_are_sealed(const unsigned char *byte, size_t size, uint32_t magic, uint32_t format, uint32_t least)
{
    if (size < 4 * (size_t)least || size / 4 > INT32_MAX || cage_words_get(byte, CAGE_WORDS_MAGIC) != magic ||
        cage_words_get(byte, CAGE_WORDS_FORMAT) != format || size != 4 * (size_t)cage_words_get(byte, CAGE_WORDS_COUNT))
        return false;
    uint64_t sum = sum_of(byte, size);
    return cage_words_get(byte, CAGE_WORDS_SUM) == (uint32_t)sum &&
           cage_words_get(byte, CAGE_WORDS_SUM + 1) == (uint32_t)(sum >> 32);
}
