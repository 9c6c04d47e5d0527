/* Decimal numbers in text to doubles, correctly rounded and independent of the locale. Private
 * to src/model. */
#ifndef GOUGH_MODEL_DECIMAL_H
#define GOUGH_MODEL_DECIMAL_H

#include <stddef.h>

/* Reads the number that text begins with: digits with at most one point, then perhaps an
 * exponent (e or E, sign, digits). No sign, no spaces, no infinity. Nearest double, ties to
 * even; INFINITY where the number is too large. Returns how many bytes were read, 0 where text
 * begins with no number. */
size_t gough_decimal_read_(const char *text, size_t length, double *value);

#endif
