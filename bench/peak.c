/* Most multiplications and additions that a core does in a second, for registers of each width: twelve chains that do not wait for
 * one another, in registers by name. */
#include "bench/kernels.h"

enum { CHAINS = 12, TURNS = 2000 };

#if defined(__x86_64__)
#include <immintrin.h>

#define EACH(step)                                                                                 \
    step(x0) step(x1) step(x2) step(x3) step(x4) step(x5) step(x6) step(x7) step(x8) step(x9)      \
        step(x10) step(x11)

/* the compiler may not fold turns into one another */
#define APART(x)                                                                                   \
    x = ADD(MULTIPLY(x, a), b);                                                                    \
    __asm__ volatile("" : "+x"(x));
#define FUSED(x)                                                                                   \
    x = MULTIPLY_ADD(x, a, b);                                                                     \
    __asm__ volatile("" : "+x"(x));
#define SUM(x) sum = ADD(sum, x);

#define PEAK(name, step, type, set, features)                                                      \
    __attribute__((target(features))) static void name(void *out) {                                \
        const type a = set(0.999999), b = set(1e-6);                                               \
        type x0 = set(1), x1 = set(2), x2 = set(3), x3 = set(4), x4 = set(5), x5 = set(6);         \
        type x6 = set(7), x7 = set(8), x8 = set(9), x9 = set(10), x10 = set(11), x11 = set(12);    \
        type sum = set(0);                                                                         \
        for (int t = 0; t < TURNS; t++) {                                                          \
            EACH(step)                                                                             \
        }                                                                                          \
        EACH(SUM)                                                                                  \
        *(volatile double *)out = *(double *)&sum;                                                 \
    }

#define MULTIPLY _mm_mul_sd
#define ADD _mm_add_sd
#define MULTIPLY_ADD _mm_fmadd_sd
PEAK(one_apart, APART, __m128d, _mm_set_sd, "sse2")
PEAK(one_fused, FUSED, __m128d, _mm_set_sd, "fma")
#undef MULTIPLY
#undef ADD
#undef MULTIPLY_ADD
#define MULTIPLY _mm_mul_pd
#define ADD _mm_add_pd
#define MULTIPLY_ADD _mm_fmadd_pd
PEAK(two_apart, APART, __m128d, _mm_set1_pd, "sse2")
PEAK(two_fused, FUSED, __m128d, _mm_set1_pd, "fma")
#undef MULTIPLY
#undef ADD
#undef MULTIPLY_ADD
#define MULTIPLY _mm256_mul_pd
#define ADD _mm256_add_pd
#define MULTIPLY_ADD _mm256_fmadd_pd
PEAK(four_apart, APART, __m256d, _mm256_set1_pd, "avx2")
PEAK(four_fused, FUSED, __m256d, _mm256_set1_pd, "avx2,fma")
#undef MULTIPLY
#undef ADD
#undef MULTIPLY_ADD
#define MULTIPLY _mm512_mul_pd
#define ADD _mm512_add_pd
#define MULTIPLY_ADD _mm512_fmadd_pd
PEAK(eight_apart, APART, __m512d, _mm512_set1_pd, "avx512f")
PEAK(eight_fused, FUSED, __m512d, _mm512_set1_pd, "avx512f")

peak peak_of(int lanes) {
    const double flops = 2.0 * CHAINS * TURNS * lanes;
    const int has = __builtin_cpu_supports("fma");

    switch (lanes) {
    case 1:
        return (peak){one_apart, has ? one_fused : NULL, flops};
    case 2:
        return (peak){two_apart, has ? two_fused : NULL, flops};
    case 4:
        return (peak){four_apart, has ? four_fused : NULL, flops};
    default:
        return (peak){eight_apart, has ? eight_fused : NULL, flops};
    }
}

#else

typedef double pair __attribute__((vector_size(16)));

static void pair_apart(void *out) {
    pair x[CHAINS], sum = {0, 0};

    for (int i = 0; i < CHAINS; i++) x[i] = (pair){1.0 + i, 2.0 + i};
    for (int t = 0; t < TURNS; t++) {
        for (int i = 0; i < CHAINS; i++) x[i] = x[i] * 0.999999 + 1e-6;
    }
    for (int i = 0; i < CHAINS; i++) sum = sum + x[i];
    *(volatile double *)out = sum[0];
}

peak peak_of(int lanes) {
    (void)lanes;
    return (peak){pair_apart, NULL, 4.0 * CHAINS * TURNS};
}

#endif
