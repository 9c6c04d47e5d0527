/* The kernels of one width, each called many times: what kernels_1.c … kernels_8.c hand to the timing. */
#ifndef BENCH_KERNELS_H
#define BENCH_KERNELS_H

#include "bench/reference.h"

/* calls of a kernel in one call of the functions below */
enum { KERNEL_CALLS = 64 };

typedef struct {
    int lanes;
    size_t size; /* bytes of the memory, aligned to 64 */
    void (*begin)(void *memory, const reference *r);
    void (*right_hand_side)(void *memory);
    void (*inverse_dynamics)(void *memory);
    void (*rk4_step)(void *memory);
    void (*dop853_step)(void *memory);
    void (*rattle2_step)(void *memory);
    void (*program)(void *memory); /* formulas, legs and forces of one stage */
    /* throughput of single instructions, 8 × KERNEL_CALLS in a call */
    void (*divide)(void *memory);
    void (*root)(void *memory);
    /* largest difference between the forces that went into forward dynamics and those that came back */
    double (*round_trip)(void *memory);
} kernel_width;

extern const kernel_width kernel_width_1, kernel_width_2, kernel_width_4, kernel_width_8;

/* NULL where the build or the processor has no such lanes */
const kernel_width *kernel_of(int lanes);

/* our right-hand side of 24 numbers, for others' steppers: begun in memory of kernel_right_hand_side_size bytes */
size_t kernel_rates_size(void);
void kernel_rates_begin(void *memory, const reference *r, double state[24]);
void kernel_rates(void *memory, double t, const double *y, double *rate);

/* flops of one call, a lane, counted by a number type that counts; additions and multiplications together */
typedef struct {
    long add_multiply, divide, root, compare;
} kernel_flops;

typedef struct {
    kernel_flops right_hand_side, inverse_dynamics, rk4_step, rattle2_step;
} kernel_counts;

/* false where the program was built without a C++ compiler, which the counting type needs */
#ifdef __cplusplus
extern "C"
#endif
    int
    kernels_count(const reference *ref, kernel_counts *counts);

/* ---- peaks of the core ---- */

typedef struct {
    void (*multiply_add)(void *); /* a multiplication and an addition apart */
    void (*fused)(void *);        /* one instruction for both; NULL where there is none */
    double flops;                 /* in one call of either */
} peak;

peak peak_of(int lanes);

#endif
