/* What the tests of this room share: random numbers, formulas from text. */
#ifndef GOUGH_TESTS_MODEL_HELPERS_H
#define GOUGH_TESTS_MODEL_HELPERS_H

#include "gough/model.h"
#include "support/xorshift.h"

/* Compiles a formula that must be right. */
gough_formula formula_of(const char *text);

/* Value at t of a formula that must be right. */
double value_of(const char *text, double t);

#endif
