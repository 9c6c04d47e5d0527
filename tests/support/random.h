/* Reproducible random numbers for tests: splitmix64 (Steele, Lea, Flood, OOPSLA 2014). The seed is printed by who uses it. */
#ifndef TESTS_SUPPORT_RANDOM_H
#define TESTS_SUPPORT_RANDOM_H

#include <stdint.h>

typedef struct {
    uint64_t state;
} dice;

static inline uint64_t dice_bits(dice *d) {
    uint64_t z = d->state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

static inline double dice_between(dice *d, double low, double high) {
    return low + (high - low) * (double)(dice_bits(d) >> 11) * 0x1p-53;
}

#endif
