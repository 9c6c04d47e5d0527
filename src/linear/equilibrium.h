/* Where a loop comes to rest. Theory: docs/theory/stability.md. */
#ifndef GOUGH_LINEAR_EQUILIBRIUM_H
#define GOUGH_LINEAR_EQUILIBRIUM_H

#include "gough/linear.h"

/* The pose asked for, `component` from home (NULL: home), and what the loop makes of it. With feed-forward `rest` is a program
 * that stands there. Without, it stands where the springs of the legs and gravity balance, (stab-14). Fails in a singular pose
 * and where there is no such balance, with a sentence. */
gough_status equilibrium_find(const gough_model *model, const double *component, gough_motion *rest,
                              gough_error *error);

#endif
