/* Random numbers by counting: Philox 4×32 with ten rounds (Salmon, Moraes, Dror, Shaw, "Parallel
 * random numbers: as easy as 1, 2, 3", SC 2011), so that any draw of any run is had without those
 * before it. */
#include <math.h>

#include "gough/random.h"

static void philox(const uint32_t counter[4], const uint32_t key[2], uint32_t out[4]) {
    const uint64_t m0 = 0xD2511F53u, m1 = 0xCD9E8D57u;
    uint32_t c[4] = {counter[0], counter[1], counter[2], counter[3]}, k0 = key[0], k1 = key[1];

    for (int round = 0; round < 10; round++) {
        const uint64_t p0 = m0 * c[0], p1 = m1 * c[2];
        const uint32_t c1 = c[1], c3 = c[3];
        c[0] = (uint32_t)(p1 >> 32) ^ c1 ^ k0;
        c[1] = (uint32_t)p1;
        c[2] = (uint32_t)(p0 >> 32) ^ c3 ^ k1;
        c[3] = (uint32_t)p0;
        k0 += 0x9E3779B9u;
        k1 += 0xBB67AE85u;
    }
    for (int i = 0; i < 4; i++) out[i] = c[i];
}

/* 53 bits, the counter being (draw, run) and the key the seed */
static uint64_t draw_bits(uint64_t seed, uint64_t run, uint64_t draw) {
    const uint32_t counter[4] = {(uint32_t)draw, (uint32_t)(draw >> 32), (uint32_t)run,
                                 (uint32_t)(run >> 32)};
    const uint32_t key[2] = {(uint32_t)seed, (uint32_t)(seed >> 32)};
    uint32_t out[4];

    philox(counter, key, out);
    return ((uint64_t)out[1] << 32 | out[0]) >> 11;
}

double gough_random_uniform(uint64_t seed, uint64_t run, uint64_t draw) {
    return (double)draw_bits(seed, run, draw) * 0x1p-53;
}

/* Inverse normal distribution: a rough start, |z| from the tail's asymptote or the density's middle, then Halley's steps on
 * erfc, which cube the error each; ten reach round-off from anywhere in ±8.3 */
double gough_random_normal(uint64_t seed, uint64_t run, uint64_t draw) {
    const double p = ((double)draw_bits(seed, run, draw) + 0.5) * 0x1p-53;
    const double tail = p < 0.5 ? p : 1 - p, root = sqrt(0.5), density = 2.50662827463100050242;
    double z = tail < 0.02 ? sqrt(-2 * log(tail * 5)) : (0.5 - tail) * density;

    for (int i = 0; i < 10; i++) {
        const double miss = 0.5 * erfc(z * root) - tail, slope = exp(-0.5 * z * z) / density;
        const double step = miss / slope;
        z += step / (1 - 0.5 * z * step); /* Halley: the tail bends */
    }
    return p < 0.5 ? -z : z;
}
