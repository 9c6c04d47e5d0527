/* What the processor has for stages side by side. */
#include "run/prefetch.h"

/* most lanes in use; a build of which only narrow instances are instrumented sets it to 2 */
#ifndef GOUGH_WIDEST
#define GOUGH_WIDEST 8
#endif

int prefetch_lanes(void) {
#if defined(__x86_64__)
    if (GOUGH_WIDEST >= 8 && __builtin_cpu_supports("avx512f") &&
        __builtin_cpu_supports("avx512dq"))
        return 8;
    if (GOUGH_WIDEST >= 4 && __builtin_cpu_supports("avx2")) return 4;
#endif
    return 2;
}

const struct prefetch_width *prefetch_widest(void) {
#if defined(__x86_64__)
    if (prefetch_lanes() == 8) return &prefetch_width_8;
    if (prefetch_lanes() == 4) return &prefetch_width_4;
#endif
    return &prefetch_width_2;
}

const struct prefetch_width *prefetch_narrow(void) {
#if defined(__x86_64__)
    if (prefetch_lanes() == 8) return &prefetch_width_4;
#endif
    return NULL;
}
