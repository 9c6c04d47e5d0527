/* Where a loop comes to rest. Theory: docs/theory/stability.md. */
#ifndef GOUGH_LINEAR_EQUILIBRIUM_H
#define GOUGH_LINEAR_EQUILIBRIUM_H

#include "gough/linear.h"

/* A pose in which a loop should rest. */
typedef struct {
    gough_error words; /* its message: "home", or "surge 0.1, yaw 5°" */
    gough_state state;
    double determinant; /* of its Jacobian */
} asked_pose;

/* The pose `component` from home (NULL: home), as `rest` that stands there. Fails in a singular pose, with a sentence. */
gough_status equilibrium_ask(const gough_model *model, const double *component, gough_motion *rest,
                             asked_pose *asked, gough_error *error);

/* The pose asked for, `component` from home (NULL: home), and what the loop makes of it. With feed-forward `rest` is a program
 * that stands there. Without, it stands where the springs of the legs and gravity balance, (stab-14). Fails in a singular pose
 * and where there is no such balance, with a sentence. */
gough_status equilibrium_find(const gough_model *model, const double *component, gough_motion *rest,
                              gough_error *error);

#endif
