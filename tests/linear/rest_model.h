/* For tests of the loop at rest: a model without a machine, and what is found at rest. */
#ifndef TESTS_LINEAR_REST_MODEL_H
#define TESTS_LINEAR_REST_MODEL_H

#include <stdlib.h>

#include "gough/linear.h"
#include "support/machines.h"

/* Fed forward, with these gains; to be freed. */
static inline gough_model *new_model(double stiffness, double damping) {
    gough_model *model = calloc(1, sizeof *model);

    ck_assert(model != NULL);
    model->control.feedforward = true;
    set_gains(model, stiffness, damping);
    return model;
}

static inline gough_rest at_rest(const gough_model *model, const double *component) {
    gough_rest rest;
    gough_error error = {0};

    ck_assert_msg(gough_stability_at_rest(model, component, &rest, &error) == GOUGH_OK, "%s",
                  error.message);
    ck_assert_uint_eq(rest.size, gough_linear_size(model));
    return rest;
}

static inline void near(double found, double right, double tolerance, const char *what,
                        int geometry) {
    ck_assert_msg(fabs(found - right) <= tolerance, "%s of geometry %d: %.17g, not %.17g", what,
                  geometry, found, right);
}

#endif
