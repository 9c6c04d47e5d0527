/* What the processor has for stages side by side. */
#include "run/prefetch.h"

int prefetch_lanes(void) {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")) return 8;
    if (__builtin_cpu_supports("avx2")) return 4;
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
