/* The symmetric eigenvalue problem K v = κ B v in the six freedoms of a platform. Theory: docs/theory/stability.md. */
#ifndef GOUGH_LINEAR_SYMMETRIC_H
#define GOUGH_LINEAR_SYMMETRIC_H

#include <complex.h>

enum { FREEDOMS = 6 };

/* of the symmetric problem: an eigenvalue below this part of the largest is its rounding */
#define SYMMETRIC_ROUNDING (16 * 2.3e-16)

/* K v = κ B v with symmetric K and B > 0: κ rising, with their shapes; those within rounding of 0 become 0. Returns the largest
 * |κ|, or −1 if the eigenvalues were not found. */
double symmetric_problem(const double *K, const double *B, double kappa[FREEDOMS],
                         double complex shape[FREEDOMS][6]);

#endif
