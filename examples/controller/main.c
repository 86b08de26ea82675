/* main.c: a gripper's control loop at 1 kHz that asks the supervisor in every tick, while a proof goes on in the time between.
 *
 * Built for a Cortex-M the tick is the SysTick interrupt, and the loop's times are measured; elsewhere ticks come one after
 * each step of the proof. */
#include <stdio.h>

#include "supervisor.h"

#include "scene.h" /* written by make.sh: part[] and gripper[], in micrometres */

enum { TICKS = 400, SAFE_UM = 250 };

/* What the sensors say: the part slips out of the inner pocket through the outer one, turning a little, and is gone. */
static cage_pose measured(int32_t tick)
{
    cage_pose pose = {{-22000 + 260 * tick, 0, 0}, {200, 0, 0, tick % 100 < 50 ? tick % 50 / 10 : 0}};
    return pose;
}

static volatile int32_t ticks, late, margin = SUPERVISOR_NOT_CAGED, log_count, log_tick[16], log_margin[16];
static volatile uint32_t worst_tick, worst_step;

static void control_tick(void)
{
    cage_pose pose = measured(ticks);
    int32_t now = supervisor_margin(&pose);
    if ((now != margin || ticks == 0) && log_count < 16) {
        log_tick[log_count] = ticks;
        log_margin[log_count++] = now;
    }
    margin = now; /* the arm lifts only while this is at least SAFE_UM */
    ticks++;
}

#if defined __ARM_ARCH_PROFILE && __ARM_ARCH_PROFILE == 'M'

enum { CLOCK_HZ = 25000000, PERIOD = CLOCK_HZ / 1000 };
#define SYSTICK ((volatile uint32_t *)(uintptr_t)0xe000e010u) /* control, reload, current */
#define ICSR (*(volatile uint32_t *)(uintptr_t)0xe000ed04u)   /* bit 26: the next tick is already waiting */

void arm_systick_isr(void);
void arm_systick_isr(void)
{
    control_tick();
    uint32_t taken = PERIOD - 1 - SYSTICK[2];
    worst_tick = taken > worst_tick ? taken : worst_tick;
    late += ICSR >> 26 & 1;
}

static void ticks_start(void)
{
    SYSTICK[1] = PERIOD - 1;
    SYSTICK[2] = 0;
    SYSTICK[0] = 7;
}

static uint32_t clock_now(void)
{
    int32_t tick;
    uint32_t left;
    do {
        tick = ticks;
        left = SYSTICK[2];
    } while (tick != ticks);
    return (uint32_t)tick * PERIOD + (PERIOD - 1 - left);
}

static void wait_or_tick(void) {}
static unsigned microseconds(uint32_t clocks) { return clocks / (CLOCK_HZ / 1000000); }

#else

static void ticks_start(void) {}
static uint32_t clock_now(void) { return 0; }
static void wait_or_tick(void) { control_tick(); }
static unsigned microseconds(uint32_t clocks) { return clocks; }

#endif

/* Is the part caged in this gripper at all? Asked again, say, when other fingers were mounted: one step at a time. */
static int32_t prove_in_the_background(void)
{
    static union {
        uint64_t align;
        unsigned char byte[128 << 10];
    } memory;
    const int32_t parts = sizeof part / sizeof *part, fingers = sizeof gripper / sizeof *gripper;
    const cage_scene scene = {{part, part, parts, parts}, {gripper, gripper, fingers, fingers}, 2};
    const cage_pose start = {{-22000, 0, 0}, {1, 0, 0, 0}};
    const cage_limits limits = {CAGE_SIDE_INNER, -1, 8, 64};
    cage_proof *proof;
    int32_t state = cage_prove_begin(&proof, &scene, &start, NULL, &limits, memory.byte, sizeof memory.byte);
    while (state == 0) {
        uint32_t from = clock_now();
        state = cage_prove_run(proof, 1);
        uint32_t taken = clock_now() - from;
        worst_step = taken > worst_step ? taken : worst_step;
        wait_or_tick();
    }
    if (state < 0)
        return state;
    const cage_result *result = cage_prove_result(proof);
    printf("proof: %s after %d steps, %d of %d bytes in use at once\n", cage_verdict_text(result->verdict), (int)result->steps,
           (int)result->peak_bytes, (int)sizeof memory.byte);
    return result->verdict;
}

int main(void)
{
    if (!supervisor_start())
        return 1;
    ticks_start();
    int32_t verdict = prove_in_the_background();
    while (ticks < TICKS)
        wait_or_tick();
    for (int32_t i = 0; i < log_count; i++) {
        if (log_margin[i] == SUPERVISOR_NOT_CAGED)
            printf("tick %3d: not proved to be caged: do not lift\n", (int)log_tick[i]);
        else
            printf("tick %3d: caged, margin at least %d um: %s\n", (int)log_tick[i], (int)log_margin[i],
                   log_margin[i] >= SAFE_UM ? "lift" : "do not lift");
    }
    printf("time: worst tick %u us, ticks late %d; worst step of the proof, ticks included, %u us\n", microseconds(worst_tick),
           (int)late, microseconds(worst_step));
    return verdict != CAGE_CAGED || late > 0;
}
