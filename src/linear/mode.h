/* What moves in a mode: its shape with a fixed phase, the shares of its kinds of motion, its name.
 * Theory: docs/theory/stability.md. */
#ifndef GOUGH_LINEAR_MODE_H
#define GOUGH_LINEAR_MODE_H

#include <complex.h>

#include "gough/linear.h"

/* Shares, name and normed shape of a displacement (δr, δθ), base axes, of any size and phase, (stab-16). A displacement that is
 * zero or not finite gives the name "none" and shares of 0. */
void mode_of(const gough_machine *machine, const double complex shape[6], gough_mode *mode);

/* Eigenvalues that are equal up to `tolerance` have no shapes of their own, only a space of them. Replaces the shapes of such
 * eigenvalues by others of the same space in which surge, sway, heave, roll, pitch and yaw stand apart as far as they can, those
 * of surge first. At most 24 values. */
void mode_separate(const gough_machine *machine, int count, const double complex *value,
                   double tolerance, double complex (*shape)[6]);

#endif
