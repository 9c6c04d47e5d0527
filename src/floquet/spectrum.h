/* Multipliers of a product of factors, large and small ones alike to their own digits. Theory: docs/theory/floquet.md. */
#ifndef GOUGH_FLOQUET_SPECTRUM_H
#define GOUGH_FLOQUET_SPECTRUM_H

#include <complex.h>

#include "floquet/monodromy.h"

typedef struct {
    int n;
    double complex value[MONODROMY_ROWS];                  /* μ, by falling magnitude */
    double complex vector[MONODROMY_ROWS][MONODROMY_ROWS]; /* vector[k]: ξ of μ_k at the beginning,
                                                            * in the units of the factors */
    double log_determinant;                                /* log |det| of the product */
} spectrum;

/* (floquet-6). GOUGH_ERROR_NUMERICAL where no eigenvalues were found, which takes numbers that are not finite. */
gough_status spectrum_of(const monodromy *m, spectrum *s, gough_error *error);

/* The same of `count` factors, n × n and `stride` numbers after each other, the last to be applied last, with fewer sweeps where
 * magnitudes lie far apart. */
gough_status spectrum_of_factors(const double *factor, size_t stride, int n, size_t count,
                                 int sweeps, spectrum *s, gough_error *error);

/* Largest |μμ′ − 1| over pairs, each with the one that fits it best. */
double spectrum_pair_defect(const spectrum *s);

#endif
