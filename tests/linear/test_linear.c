/* The linearised loop: against closed forms, and against differences in quadruple precision of the nonlinear equations. */
#include <stdio.h>
#include <stdlib.h>

#include "differences.h"
#include "gough/linear.h"
#include "support/machines.h"
#include "support/suite.h"

static gough_model *new_model(double stiffness, double damping) {
    gough_model *model = calloc(1, sizeof *model);

    ck_assert(model != NULL);
    model->control.feedforward = true;
    set_gains(model, stiffness, damping);
    return model;
}

/* (stab-6), (stab-4): at rest the lower left block is −M⁻¹ (K_geo + G JᵀJ); heave alone is closed */
START_TEST(heave_at_rest_is_the_closed_form) {
    gough_model *model = new_model(0.3, 0.7);
    gough_error error = {0};
    double A[GOUGH_LINEAR][GOUGH_LINEAR];
    const double d2 = 0.49, l2 = 1.49, G = 0.3, D = 0.7;

    paper_machine(&model->machine);
    ck_assert_msg(gough_linearise(model, 0, NULL, GOUGH_LINEAR, A[0], &error) == GOUGH_OK, "%s",
                  error.message);
    ck_assert(fabs(A[2][8] - 1) <= 1e-15);
    ck_assert_msg(fabs(A[8][2] - (d2 / l2 - G * 6 / l2)) <= 1e-13, "%.17g, not %.17g", A[8][2],
                  d2 / l2 - G * 6 / l2);
    ck_assert(fabs(A[8][8] + D * 6 / l2) <= 1e-13);
    free(model);
}
END_TEST

/* (stab-12) with h(t) and z̈(t) of the paper's law */
START_TEST(heave_along_the_papers_program_is_hills_equation) {
    gough_model *model = new_model(0.3, 0);
    gough_error error = {0};
    double A[GOUGH_LINEAR][GOUGH_LINEAR];

    paper_machine(&model->machine);
    set_formula(&model->motion.formula[GOUGH_HEAVE], "0.2*sin(t)*(1 - exp(-t/2))^2");
    for (double t = 0; t < 20; t += 0.37) {
        double jet[3], h, l2, right;
        gough_formula_evaluate(&model->motion.formula[GOUGH_HEAVE], t, jet);
        h = 1 + jet[0];
        l2 = h * h + 0.49;
        right = (1 + jet[2]) * 0.49 / (h * l2) - 6 * 0.3 * h * h / l2;
        ck_assert(gough_linearise(model, t, NULL, GOUGH_LINEAR, A[0], &error) == GOUGH_OK);
        ck_assert_msg(fabs(A[8][2] - right) <= 1e-13, "t = %g: %.17g, not %.17g", t, A[8][2],
                      right);
    }
    free(model);
}
END_TEST

/* ---- differences ------------------------------------------------------------------------------------------------ */

/* a state off the program, moving otherwise than it */
static gough_state off_program(const gough_model *model, double t, dice *d) {
    gough_state state;
    gough_acceleration none;
    const double angles[3] = {dice_between(d, -0.3, 0.3), dice_between(d, -0.3, 0.3),
                              dice_between(d, -0.3, 0.3)};

    gough_program(&model->machine, &model->motion, t, &state, &none);
    gough_rotation_from_angles(angles, state.rotation);
    for (int i = 0; i < 3; i++) {
        state.position[i] += dice_between(d, -0.1, 0.1);
        state.velocity[i] = dice_between(d, -1, 1);
        state.angular_velocity[i] = dice_between(d, -1, 1);
    }
    return state;
}

static double worst_difference(const gough_model *model, double t, const gough_state *state) {
    double A[GOUGH_LINEAR][GOUGH_LINEAR], right[GOUGH_LINEAR][GOUGH_LINEAR], worst = 0;
    gough_error error = {0};

    ck_assert_msg(gough_linearise(model, t, state, GOUGH_LINEAR, A[0], &error) == GOUGH_OK, "%s",
                  error.message);
    difference_matrix(model, t, state, right);
    for (int i = 0; i < GOUGH_LINEAR; i++) {
        for (int j = 0; j < GOUGH_LINEAR; j++) {
            const double size = fmax(1, fabs(right[i][j]));
            ck_assert_msg(fabs(A[i][j] - right[i][j]) <= 1e-12 * size,
                          "t = %g, %s, [%d][%d]: %.17g, not %.17g", t,
                          state ? "off the program" : "on it", i, j, A[i][j], right[i][j]);
            worst = fmax(worst, fabs(A[i][j] - right[i][j]) / size);
        }
    }
    return worst;
}

/* all six axes moving, full inertia, gravity not vertical, each leg with gains of its own, on and off the program, with forces
 * fed forward and without */
static void check_complex(int legs) {
    dice d = {12};
    gough_model *model = new_model(0, 0);
    double worst = 0;

    skew_machine(&model->machine);
    if (legs) give_legs(&model->machine, legs, &d);
    set_all_axes(model);
    model->motion.about[2] = 0.3;
    for (int k = 0; k < 40; k++) {
        const double t = dice_between(&d, 0, 20);
        gough_state state;
        for (int v = 0; v < GOUGH_LEGS; v++) {
            model->control.stiffness[v] = dice_between(&d, 0, 20);
            model->control.damping[v] = k % 2 ? dice_between(&d, 0, 3) : 0;
        }
        model->control.feedforward = k % 3 > 0;
        model->motion.scaled = k % 4 == 3;
        model->motion.amplitude = 1.3;
        model->motion.frequency = 0.7;
        state = off_program(model, t, &d);
        worst = fmax(worst, worst_difference(model, t, NULL));
        worst = fmax(worst, worst_difference(model, t, &state));
    }
    printf("complex steps against differences: %.1e\n", worst);
    free(model);
}

START_TEST(complex_steps_are_differences_in_quadruple_precision) {
    check_complex(0);
    check_complex(LEGS_HEAVY | LEGS_VISCOUS);
}
END_TEST

/* the disturbances of a study are no part of its loop */
START_TEST(disturbances_change_nothing) {
    gough_model *model = new_model(5, 1);
    double plain[GOUGH_LINEAR][GOUGH_LINEAR], disturbed[GOUGH_LINEAR][GOUGH_LINEAR];
    gough_error error;

    skew_machine(&model->machine);
    set_all_axes(model);
    ck_assert(gough_linearise(model, 1, NULL, GOUGH_LINEAR, plain[0], &error) == GOUGH_OK);
    set_formula(&model->disturbance.leg_force[0], "1/0");
    set_formula(&model->disturbance.vertical_force, "2*t");
    set_formula(&model->disturbance.moment[1], "1");
    ck_assert(gough_linearise(model, 1, NULL, GOUGH_LINEAR, disturbed[0], &error) == GOUGH_OK);
    ck_assert_mem_eq(plain, disturbed, sizeof plain);
    free(model);
}
END_TEST

/* ---- messages --------------------------------------------------------------------------------------------------- */

static void refused(const gough_model *model, double t, const gough_state *state,
                    gough_status status, const char *part) {
    double A[GOUGH_LINEAR][GOUGH_LINEAR];
    gough_error error = {0};

    ck_assert_int_eq(gough_linearise(model, t, state, GOUGH_LINEAR, A[0], &error), status);
    ck_assert_msg(strstr(error.message, part) != NULL, "%s", error.message);
}

START_TEST(what_has_no_derivative_is_refused) {
    gough_model *model = new_model(1, 0);
    gough_state state;

    paper_machine(&model->machine);
    set_formula(&model->motion.formula[GOUGH_YAW], "log(t - 1)");
    refused(model, 0.5, NULL, GOUGH_ERROR_INPUT, "motion.yaw is not finite at t = 0.5");
    set_formula(&model->motion.formula[GOUGH_YAW], "0");
    set_formula(&model->motion.formula[GOUGH_HEAVE], "-t");
    refused(model, 1, NULL, GOUGH_ERROR_NUMERICAL, "singular");
    state = gough_state_home(&model->machine);
    for (int i = 0; i < 3; i++)
        state.position[i] = model->machine.platform.base[0][i] - model->machine.platform.top[0][i];
    refused(model, 0, &state, GOUGH_ERROR_NUMERICAL, "no length");
    free(model);
}
END_TEST

int main(void) {
    return SUITE_RUN("linear", 60, heave_at_rest_is_the_closed_form,
                     heave_along_the_papers_program_is_hills_equation,
                     complex_steps_are_differences_in_quadruple_precision,
                     disturbances_change_nothing, what_has_no_derivative_is_refused);
}
