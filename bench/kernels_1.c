/* Kernels of one run alone, and which right-hand side others' steppers get. */
#define NUMBER_DOUBLE
#include "bench/kernels_text.h"
#include "bench/rates.h"

const kernel_width kernel_width_1 = KERNEL_WIDTH;

/* what the library's own run has on this processor */
static const rates_width *rates_widest(void) {
#if defined(__x86_64__)
    if (gough_batch_lanes() == 8) return &rates_width_8;
    if (gough_batch_lanes() == 4) return &rates_width_4;
#endif
    return &rates_width_2;
}

size_t kernel_rates_size(void) { return rates_widest()->size; }

void kernel_rates_begin(void *memory, const reference *ref, double state[24]) {
    rates_widest()->begin(memory, ref, state);
}

void kernel_rates(void *memory, double t, const double *y, double *rate) {
    static const rates_width *widest;

    if (widest == NULL) widest = rates_widest();
    widest->rates(memory, t, y, rate);
}

const kernel_width *kernel_of(int lanes) {
    if (lanes > gough_batch_lanes()) return NULL;
    switch (lanes) {
    case 1:
        return &kernel_width_1;
    case 2:
        return &kernel_width_2;
#if defined(__x86_64__)
    case 4:
        return &kernel_width_4;
    case 8:
        return &kernel_width_8;
#endif
    default:
        return NULL;
    }
}
