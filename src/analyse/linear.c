/* Linearisation for callers: checks around the complex equations. Theory: docs/theory/stability.md. */
#include "analyse/linear.h"

#include <math.h>

/* as in a run: beyond it a pose is called nearly singular */
static const double greatest_condition = 1e8;

static gough_status check_pose(const linear_loop *loop, double t, gough_error *error) {
    gough_state state;
    gough_acceleration acceleration;
    double condition;

    if (!loop->control->feedforward) return GOUGH_OK;
    gough_program(loop->machine, loop->motion, t, &state, &acceleration);
    gough_conditioning(loop->machine, &state, &condition, NULL);
    if (condition <= greatest_condition) return GOUGH_OK;
    return gough_fail(
        error, GOUGH_ERROR_NUMERICAL,
        "at t = %.9g the program is in a singular pose or nearly so (condition %.3g): "
        "no leg forces hold it there; choose a motion that keeps away from it",
        t, condition);
}

gough_status linear_check(const linear_loop *loop, double t, const gough_state *state,
                          linear_matrix matrix, const char *wrong, gough_error *error) {
    gough_status status;

    if (wrong != NULL) {
        return gough_fail(error, GOUGH_ERROR_INPUT, "%s is not finite at t = %.9g", wrong, t);
    }
    status = check_pose(loop, t, error);
    if (status != GOUGH_OK) return status;
    for (int i = 0; i < GOUGH_LINEAR; i++) {
        for (int j = 0; j < GOUGH_LINEAR; j++) {
            if (isfinite(matrix[i][j])) continue;
            return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                              "at t = %.9g a leg of the %s has no length: the motion has no "
                              "derivative there",
                              t, state ? "pose" : "program");
        }
    }
    return GOUGH_OK;
}

gough_status gough_linearise(const gough_model *model, double t, const gough_state *state,
                             double matrix[GOUGH_LINEAR][GOUGH_LINEAR], gough_error *error) {
    const linear_loop loop = {&model->machine, &model->motion, &model->control};
    const char *wrong = linear_complex.matrix(&loop, t, state, matrix);

    return linear_check(&loop, t, state, matrix, wrong, error);
}
