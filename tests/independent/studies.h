/* One general study for both formulations: a machine without symmetry, a load with a full
 * inertia tensor and its centre of mass off the frame, all six axes moving, feedback and
 * disturbances.
 * */
#ifndef GOUGH_TESTS_STUDIES_H
#define GOUGH_TESTS_STUDIES_H

#include "gough/simulate.h"
#include "independent/newton_euler.h"

/* Fills both; feedforward off leaves F^p = 0. `second` may be NULL. */
void general_study(gough_model *model, newton_euler *second, bool feedforward, double stiffness,
                   double damping);

/* Forces of the disturbances at t as the study's formulas have them. */
void general_disturbance(newton_real t, newton_real leg[6], newton_real *vertical,
                         newton_real force[3], newton_real moment[3]);

#endif
