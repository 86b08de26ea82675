/* sealed.h: writing into the bytes of an atlas, and giving them the right check sum again. */
#ifndef SEALED_H
#define SEALED_H

#include <stddef.h>
#include <stdint.h>

/* Words are counted from the beginning, least significant byte first. */
void sealed_put(unsigned char *byte, size_t word, uint32_t value);

void sealed_sum(unsigned char *byte, size_t size);

#endif
