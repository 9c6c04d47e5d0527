/* Reproducible random numbers: xorshift with a fixed seed, the same in every run. */
#ifndef GOUGH_TESTS_XORSHIFT_H
#define GOUGH_TESTS_XORSHIFT_H

#include <stdint.h>

typedef struct random_source {
    uint64_t state;
} random_source;

static inline random_source random_seeded(uint64_t seed) {
    return (random_source){seed * 0x9e3779b97f4a7c15u | 1};
}

static inline uint64_t random_bits(random_source *source) {
    source->state ^= source->state << 13;
    source->state ^= source->state >> 7;
    source->state ^= source->state << 17;
    return source->state * 0x2545f4914f6cdd1du;
}

static inline double random_between(random_source *source, double low, double high) {
    return low + (high - low) * (double)(random_bits(source) >> 11) * 0x1p-53;
}

#endif
