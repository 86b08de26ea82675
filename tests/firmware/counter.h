/* counter.h: instructions executed so far, on the machines that count them (in QEMU with -icount shift=0); elsewhere always 0. */
#ifndef COUNTER_H
#define COUNTER_H

#include <stdint.h>

#if defined __ARM_ARCH_PROFILE && __ARM_ARCH_PROFILE == 'M'

/* The timer that every Cortex-M has: 24 bits, downward; 25 MHz on QEMU's boards, where an instruction takes 1 ns. */
#define SYSTICK ((volatile uint32_t *)(uintptr_t)0xe000e010u)
enum { COUNTER_PER_TICK = 40 };

static uint32_t counter_last;
static uint64_t counter_ticks;

static inline void counter_start(void)
{
    SYSTICK[1] = 0xffffff;
    SYSTICK[2] = 0;
    SYSTICK[0] = 5; /* the processor's clock, no interrupt */
}

/* To be asked at least once in 2^24 ticks. */
static inline uint64_t counter_now(void)
{
    uint32_t now = SYSTICK[2];
    counter_ticks += (counter_last - now) & 0xffffff;
    counter_last = now;
    return counter_ticks * COUNTER_PER_TICK;
}

#elif defined __riscv

static inline void counter_start(void) {}

/* mcycle, which counts instructions there; its number, as an assembler may not know the name. */
static inline uint64_t counter_now(void)
{
#if __riscv_xlen == 64
    uint64_t count;
    __asm__ volatile(".option push\n\t.option arch, +zicsr\n\tcsrr %0, 0xb00\n\t.option pop" : "=r"(count));
    return count;
#else
    uint32_t high, low, again;
    do
        __asm__ volatile(".option push\n\t.option arch, +zicsr\n\t"
                         "csrr %0, 0xb80\n\tcsrr %1, 0xb00\n\tcsrr %2, 0xb80\n\t.option pop"
                         : "=r"(high), "=r"(low), "=r"(again));
    while (high != again);
    return (uint64_t)high << 32 | low;
#endif
}

#else

static inline void counter_start(void) {}
static inline uint64_t counter_now(void) { return 0; }

#endif
#endif
