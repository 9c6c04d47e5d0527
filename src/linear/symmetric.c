/* Symmetric eigenvalues by LAPACK. Theory: docs/theory/stability.md. */
#include "linear/symmetric.h"

#include <lapacke.h>
#include <math.h>
#include <string.h>

enum { WORK = 512 };

double symmetric_problem(const double *K, const double *B, double kappa[FREEDOMS],
                         double complex shape[FREEDOMS][6]) {
    double a[FREEDOMS * FREEDOMS], b[FREEDOMS * FREEDOMS], work[WORK], largest = 0;

    memcpy(a, K, sizeof a);
    memcpy(b, B, sizeof b);
    for (int i = 0; i < FREEDOMS * FREEDOMS; i++) {
        if (!isfinite(a[i]) || !isfinite(b[i])) return -1;
    }
    if (LAPACKE_dsygv_work(LAPACK_COL_MAJOR, 1, 'V', 'U', FREEDOMS, a, FREEDOMS, b, FREEDOMS, kappa,
                           work, WORK) != 0) {
        return -1;
    }
    for (int k = 0; k < FREEDOMS; k++) {
        for (int i = 0; i < FREEDOMS; i++) shape[k][i] = a[i + FREEDOMS * k];
        if (!isfinite(kappa[k])) return -1;
        largest = fmax(largest, fabs(kappa[k]));
    }
    for (int k = 0; k < FREEDOMS; k++) {
        if (fabs(kappa[k]) <= SYMMETRIC_ROUNDING * largest) kappa[k] = 0;
    }
    return largest;
}
