/* Whether a loop at rest is stable, from the signs of its stiffness and damping. Theory: docs/theory/stability.md. */
#ifndef GOUGH_LINEAR_VERDICT_H
#define GOUGH_LINEAR_VERDICT_H

#include <stdbool.h>

#include "gough/linear.h"
#include "linear/symmetric.h"

/* M̄ẍ + C ẋ + K x = 0 with symmetric K and C, C not negative; the mass matrix by rows. Fills growing, drifting, neutral,
 * neutral_mode, decaying and stable of `rest`, (stab-17), and clears positive real parts of eigenvalues that do not grow: they
 * are rounding. The eigenvalues must be there already. Returns false if LAPACK found no eigenvalues. */
bool verdict_at_rest(const gough_machine *machine, const double *mass, double K[FREEDOMS][FREEDOMS],
                     double C[FREEDOMS][FREEDOMS], gough_rest *rest);

/* The same from the eigenvalues alone, of a loop with states of its own or matrices of gains. One that is 0 counts as neutral. */
void verdict_by_eigenvalues(const gough_machine *machine, gough_rest *rest);

#endif
