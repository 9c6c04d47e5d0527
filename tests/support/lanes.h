/* Lanes of the processor that runs the tests. */
#ifndef TESTS_SUPPORT_LANES_H
#define TESTS_SUPPORT_LANES_H

/* whether it has the registers of so many */
static inline int has_lanes(int width) {
#if defined(__x86_64__)
    if (width == 8)
        return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
               __builtin_cpu_supports("avx512vl");
    if (width == 4) return __builtin_cpu_supports("avx2");
#endif
    return width > 0;
}

#endif
