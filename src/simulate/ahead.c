/* What the processor has for stages side by side. */
#include "simulate/ahead.h"

int ahead_lanes(void) {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")) return 8;
    if (__builtin_cpu_supports("avx2")) return 4;
#endif
    return 2;
}

const struct ahead_width *ahead_widest(void) {
#if defined(__x86_64__)
    if (ahead_lanes() == 8) return &ahead_width_8;
    if (ahead_lanes() == 4) return &ahead_width_4;
#endif
    return &ahead_width_2;
}
