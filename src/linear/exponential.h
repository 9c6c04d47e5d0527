/* e^A of a small square matrix. Theory: docs/theory/loop.md. */
#ifndef GOUGH_LINEAR_EXPONENTIAL_H
#define GOUGH_LINEAR_EXPONENTIAL_H

#include <stdbool.h>

/* most rows */
enum { EXPONENTIAL_ROWS = 32 };

/* e^A, (loop-7), of n rows; both matrices row by row. Returns false if a number is not finite. Accurate to some ε of the largest
 * element, times the size of A where that is over 1. */
bool exponential(int n, const double *A, double *out, bool *unsolved);

#endif
