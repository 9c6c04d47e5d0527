/* What the tests of this room share: reproducible random numbers, formulas from text, comma
 * locales. */
#ifndef GOUGH_TESTS_MODEL_HELPERS_H
#define GOUGH_TESTS_MODEL_HELPERS_H

#include <stdint.h>

#include "gough/model.h"

/* xorshift with a fixed seed: the same numbers in every run */
typedef struct random_source {
    uint64_t state;
} random_source;

random_source random_seeded(uint64_t seed);
uint64_t random_bits(random_source *source);
double random_between(random_source *source, double low, double high);

/* Compiles a formula that must be right. */
gough_formula formula_of(const char *text);

/* Value at t of a formula that must be right. */
double value_of(const char *text, double t);

/* Sets a locale whose decimal point is a comma; locale_reset() goes back. */
void locale_with_comma(void);
void locale_reset(void);

#endif
