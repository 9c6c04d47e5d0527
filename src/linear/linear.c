/* Linearisation for callers: checks around the complex equations. Theory: docs/theory/stability.md. */
#include "linear/linear.h"
#include "base/quantity.h"

#include "base/limits.h"
#include "plant/can_move.h"
#include "plant/rotation_valid.h"
#include "program/program_valid.h"

#include <math.h>
#include <string.h>

static gough_status check_condition(const gough_machine *machine, double t,
                                    const gough_state *program, gough_error *error) {
    double condition;

    gough_conditioning(machine, program, &condition, NULL);
    if (condition <= greatest_condition) return GOUGH_OK;
    return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                      "at t = %.9g" IN_TIME
                      " the program is in a singular pose or nearly so (condition %.3g): no leg "
                      "forces can hold the load there; choose a motion that avoids it",
                      t, fabs(condition));
}

static gough_status check_legs(const gough_machine *machine, double t, const gough_state *state,
                               const char *whose, gough_error *error) {
    double length[GOUGH_LEGS];

    gough_leg_kinematics(machine, state, NULL, length, NULL, NULL);
    for (int v = 0; v < GOUGH_LEGS; v++) {
        if (length[v] > leg_no_length * machine->base_radius) continue;
        return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                          "at t = %.9g" IN_TIME
                          " leg %d of the %s has no length, so the motion has no derivative there",
                          t, v + 1, whose);
    }
    return GOUGH_OK;
}

static gough_status check_matrix(double t, linear_matrix matrix, gough_error *error) {
    for (int i = 0; i < GOUGH_LINEAR; i++) {
        for (int j = 0; j < GOUGH_LINEAR; j++) {
            if (isfinite(matrix[i][j])) continue;
            return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                              "at t = %.9g" IN_TIME " the derivatives of the motion are not finite",
                              t);
        }
    }
    return GOUGH_OK;
}

bool linear_is_damped(const linear_loop *loop) {
    if (loop->control->coupled) return true;
    for (int v = 0; v < GOUGH_LEGS; v++) {
        if (fabs(loop->control->damping[v]) > 0) return true;
        if (!loop->undamped && loop->machine->platform.friction.viscous[v] > 0) return true;
    }
    return false;
}

void linear_inertia(const gough_machine *machine, const gough_state *state, double inertia[3][3]) {
    memset(inertia, 0, sizeof(double[3][3]));
    for (int a = 0; a < 3; a++) {
        const double moment =
            machine->second_moments[(a + 1) % 3] + machine->second_moments[(a + 2) % 3];
        double e[3] = {0, 0, 0};
        for (int r = 0; r < 3; r++) {
            for (int c = 0; c < 3; c++)
                e[r] += state->rotation[r][c] * machine->principal_axes[c][a];
        }
        for (int r = 0; r < 3; r++) {
            for (int c = 0; c < 3; c++) inertia[r][c] += moment * e[r] * e[c];
        }
    }
}

void linear_mass(const gough_machine *machine, const gough_state *state, double mass[6][6]) {
    double inertia[3][3];

    linear_inertia(machine, state, inertia);
    memset(mass, 0, sizeof(double[6][6]));
    for (int r = 0; r < 3; r++) {
        mass[r][r] = machine->load.mass;
        for (int c = 0; c < 3; c++) mass[3 + r][3 + c] = inertia[r][c];
    }
    if (machine->platform.legs_have_mass) linear_complex.mass(machine, state, mass);
}

gough_status linear_check(const linear_loop *loop, double t, const gough_state *state,
                          linear_matrix matrix, const char *wrong, gough_error *error) {
    const gough_machine *machine = loop->machine;
    gough_acceleration none;
    gough_state program;
    gough_status status;

    if (wrong != NULL) {
        return gough_fail(error, GOUGH_ERROR_INPUT, "%s is not finite at t = %.9g" IN_TIME, wrong,
                          t);
    }
    gough_program(machine, loop->motion, t, &program, &none);
    status = check_legs(machine, t, &program, "program", error);
    if (status == GOUGH_OK && loop->control->feedforward) {
        status = check_condition(machine, t, &program, error);
    }
    if (status == GOUGH_OK && state != NULL) {
        status = check_legs(machine, t, state, "pose", error);
    }
    return status == GOUGH_OK ? check_matrix(t, matrix, error) : status;
}

int linear_beyond(const gough_machine *machine, const gough_control *control,
                  int kept[LINEAR_BEYOND]) {
    const gough_actuators *a = &machine->platform.actuators;
    const int orders = a->kind != GOUGH_ACTUATOR_LAG ? 0 : a->time_constant[0] > 0 ? 1 : 2;
    int n = 0;

    for (; n < GOUGH_LEGS * orders; n++) kept[n] = n;
    for (int v = 0; v < GOUGH_LEGS; v++) {
        if (control->integral[v] > 0) kept[n++] = GOUGH_LEGS * orders + v;
    }
    return n;
}

gough_status linear_refuse_sampled(const gough_model *model, const char *what, gough_error *error) {
    if (!(model->control.sampling.period > 0)) return GOUGH_OK;
    return gough_fail_key(error, GOUGH_ERROR_INPUT, "control.sampling",
                          "%s of a sampled controller is that from sample to sample "
                          "(gough_floquet_sampled()); without control.sampling this function "
                          "computes that of the continuous one",
                          what);
}

size_t gough_linear_size(const gough_model *model) {
    int kept[LINEAR_BEYOND];

    return GOUGH_LINEAR + (size_t)linear_beyond(&model->machine, &model->control, kept);
}

static bool finite(const double *value, size_t count) {
    for (size_t i = 0; i < count; i++) {
        if (!isfinite(value[i])) return false;
    }
    return true;
}

static gough_status check_linearise(const gough_model *model, const gough_state *state, size_t size,
                                    gough_error *error) {
    gough_status status = motion_check(&model->motion, error);

    if (status == GOUGH_OK) status = machine_can_move(&model->machine, error);
    if (status == GOUGH_OK && model->control.sampling.period > 0)
        status = gough_fail_key(error, GOUGH_ERROR_INPUT, "control.sampling",
                                "a sampled loop has no matrix of rates: its map from sample to "
                                "sample does not follow from one");
    if (status != GOUGH_OK) return status;
    if (size != gough_linear_size(model)) {
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "the matrix of the linearised loop has %zu rows, not %zu",
                          gough_linear_size(model), size);
    }
    if (state != NULL && !is_rotation(state->rotation)) {
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "the rotation of the state is not a rotation matrix: its columns must be "
                          "orthonormal to 1e-6 and right-handed");
    }
    return GOUGH_OK;
}

gough_status gough_linearise(const gough_model *model, double t, const gough_state *state,
                             size_t size, double *matrix, gough_error *error) {
    const linear_loop loop = {&model->machine, &model->motion, &model->control, false, 0, false};
    gough_status status = check_linearise(model, state, size, error);
    int kept[LINEAR_BEYOND];
    linear_matrix found;
    const char *wrong;

    if (status != GOUGH_OK) return status;
    wrong = linear_complex.matrix(&loop, t, state, found);
    status = linear_check(&loop, t, state, found, wrong, error);
    if (size == GOUGH_LINEAR) {
        memcpy(matrix, found, sizeof found);
        return status;
    }
    linear_beyond(&model->machine, &model->control, kept);
    linear_complex.whole(&loop, t, state, kept, (int)size, matrix);
    if (status == GOUGH_OK && !finite(matrix, size * size))
        status =
            gough_fail(error, GOUGH_ERROR_NUMERICAL,
                       "at t = %.9g" IN_TIME " the derivatives of the drives are not finite", t);
    return status;
}
