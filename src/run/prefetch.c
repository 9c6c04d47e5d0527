/* What the processor has for stages side by side. */
#include "run/prefetch.h"

/* most lanes in use; a build of which only narrow instances are instrumented sets it to 2 */
#ifndef GOUGH_WIDEST
#define GOUGH_WIDEST 8
#endif

int prefetch_lanes(void) {
#if defined(__x86_64__)
    const int f = __builtin_cpu_supports("avx512f"), dq = __builtin_cpu_supports("avx512dq");
    if (GOUGH_WIDEST >= 8 && f && dq) return 8; /* unreachable: a processor takes only one way */
    const int avx2 = __builtin_cpu_supports("avx2");
    if (GOUGH_WIDEST >= 4 && avx2) return 4; /* unreachable: a processor takes only one way */
#endif
    return 2;
}

const struct prefetch_width *prefetch_widest(void) {
    static const struct prefetch_width *const width[] = {
#if defined(__x86_64__)
        [4] = &prefetch_width_4,
        [8] = &prefetch_width_8,
#endif
        [2] = &prefetch_width_2,
    };
    return width[prefetch_lanes()];
}

const struct prefetch_width *prefetch_narrow(void) {
    static const struct prefetch_width *const width[9] = {
#if defined(__x86_64__)
        [8] = &prefetch_width_4,
#endif
        [2] = NULL,
    };
    return width[prefetch_lanes()];
}
