/* Our right-hand side of 24 numbers for others' steppers, one for each width of registers. */
#ifndef BENCH_RATES_H
#define BENCH_RATES_H

#include "bench/reference.h"

typedef struct {
    size_t size; /* bytes of the memory, aligned to 64 */
    void (*begin)(void *memory, const reference *ref, double state[24]);
    void (*rates)(void *memory, double t, const double *y, double *rate);
} rates_width;

extern const rates_width rates_width_2, rates_width_4, rates_width_8;

#endif
