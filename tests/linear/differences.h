/* The linearised loop once more, by central differences in 33 digits. */
#ifndef TESTS_ANALYSE_DIFFERENCES_H
#define TESTS_ANALYSE_DIFFERENCES_H

#include "gough/linear.h"

/* What gough_linearise() computes, from the nonlinear equations of a run over quadruple precision: states displaced by exact
 * rotations and rates, differences extrapolated. Good to 1e-20 or so of the equations at the state. */
void difference_matrix(const gough_model *model, double t, const gough_state *state,
                       double matrix[GOUGH_LINEAR][GOUGH_LINEAR]);

#endif
