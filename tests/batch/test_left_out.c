/* Outputs that a caller leaves out, as NULL; and what is refused: rotations that are not orthogonal, forces without bound, and
 * numbers of lanes that no processor has. */
#include <stdlib.h>

#include "gough/fields.h"
#include "gough/gough.h"
#include "support/machines.h"
#include "support/suite.h"

static gough_machine machine; /* large */

static gough_state home(void) {
    skew_machine(&machine);
    return gough_state_home(&machine);
}

START_TEST(outputs_may_be_left_out) {
    const gough_state state = home();
    const gough_acceleration a = {{0.1, 0.2, 0.3}, {0.3, -0.2, 0.1}};
    double leg[2][6], top[2][6][3], base[2][6][3], side[2][6];
    size_t count;
    ck_assert_int_eq(
        gough_joint_forces(&machine, &state, &a, NULL, leg[0], top[0], base[0], side[0]), GOUGH_OK);
    ck_assert_int_eq(gough_joint_forces(&machine, &state, &a, NULL, leg[1], NULL, base[1], NULL),
                     GOUGH_OK);
    ck_assert_int_eq(gough_joint_forces(&machine, &state, &a, NULL, NULL, top[1], NULL, side[1]),
                     GOUGH_OK);
    ck_assert_int_eq(memcmp(leg[0], leg[1], sizeof leg[0]), 0);
    ck_assert_int_eq(memcmp(top[0], top[1], sizeof top[0]), 0);
    ck_assert_int_eq(memcmp(base[0], base[1], sizeof base[0]), 0);
    ck_assert_int_eq(memcmp(side[0], side[1], sizeof side[0]), 0);
    ck_assert_ptr_eq(gough_fields(NULL), gough_fields(&count));
}
END_TEST

START_TEST(a_state_without_a_rotation_is_refused) {
    gough_state state = home();
    const gough_acceleration none = {{0, 0, 0}, {0, 0, 0}};
    const double force[6] = {0};
    gough_acceleration a;
    gough_wrench wrench;
    double reactions[6], angles[3];
    memset(state.rotation, 0, sizeof state.rotation);
    ck_assert_int_eq(gough_joint_forces(&machine, &state, &none, NULL, NULL, NULL, NULL, NULL),
                     GOUGH_ERROR_INPUT);
    ck_assert_int_eq(gough_forward_dynamics(&machine, &state, force, NULL, &a), GOUGH_ERROR_INPUT);
    ck_assert_int_eq(gough_reactions(&machine, &state, force, NULL, reactions), GOUGH_ERROR_INPUT);
    ck_assert_int_eq(gough_external_wrench(&machine, &state, 0, &wrench), GOUGH_ERROR_INPUT);
    ck_assert_int_eq(gough_angles_in_order(GOUGH_XYZ, state.rotation, angles), GOUGH_ERROR_INPUT);
}
END_TEST

START_TEST(numbers_beyond_all_bounds_are_refused) {
    const gough_state state = home();
    double force[6] = {1.7e308, -1.7e308, 1.7e308, -1.7e308, 1.7e308, -1.7e308};
    gough_acceleration a;
    gough_wrench wrench;
    gough_external load = {.at_given = false};
    gough_limits limits;
    gough_motion *motion = calloc(1, sizeof *motion);
    gough_error error = {.message = ""};
    ck_assert_int_eq(gough_forward_dynamics(&machine, &state, force, NULL, &a),
                     GOUGH_ERROR_NUMERICAL);
    set_formula(&load.force[0], "1/t");
    ck_assert_int_eq(gough_machine_set_external(&machine, &load, 1, &error), GOUGH_OK);
    ck_assert_int_eq(gough_external_wrench(&machine, &state, 0, &wrench), GOUGH_ERROR_INPUT);
    ck_assert_int_eq(gough_external_wrench(&machine, &state, 2, &wrench), GOUGH_OK);
    ck_assert_double_eq_tol(wrench.force[0], 0.5, 1e-15);
    ck_assert_int_eq(gough_limits_collect(&machine, motion, &limits, sizeof limits - 1),
                     GOUGH_ERROR_INPUT);
    free(motion);
}
END_TEST

/* A plate: its mass has no extent across. In free fall it keeps its attitude. */
START_TEST(a_load_may_be_flat) {
    const double gravity[3] = {0, 0, -1}, force[6] = {0};
    const gough_platform platform = gough_platform_symmetric(1, 0.2, 0.6, 0.3, 1);
    const gough_load load = {.mass = 1, .inertia = {{1, 0, 0}, {0, 1, 0}, {0, 0, 2}}};
    gough_acceleration a;
    ck_assert_int_eq(gough_machine_init(&machine, &platform, &load, gravity, NULL), GOUGH_OK);
    const gough_state state = gough_state_home(&machine);
    ck_assert_int_eq(gough_forward_dynamics(&machine, &state, force, NULL, &a), GOUGH_OK);
    ck_assert_double_eq_tol(a.linear[2], -1, 1e-13);
    ck_assert_double_eq_tol(a.angular[0], 0, 1e-13);
}
END_TEST

/* Without rates, drives and feed-forward a command is G times the errors, row by row. */
START_TEST(a_law_needs_no_rates_and_no_drives) {
    gough_control control = {.coupled = true};
    gough_control_memory memory = {.begun = false};
    const double zero[6] = {0}, wanted[6] = {1, 1.1, 1.2, 1.3, 1.4, 1.5},
                 is[6] = {0.9, 1.2, 1.1, 1.4, 1.3, 1.6};
    double command[6];
    control.sampling.period = 0.01;
    for (int v = 0; v < 6; v++) {
        control.stiffness[v] = 3 + v;
        for (int w = 0; w < 6; w++) control.cross_stiffness[v][w] = v == w ? 0 : 0.1 * (v - w);
    }
    gough_control_sample(&control, NULL, &memory, zero, wanted, zero, is, NULL, command);
    for (int v = 0; v < 6; v++) {
        double sum = 0;
        for (int w = 0; w < 6; w++) sum += (v == w ? 3 + v : 0.1 * (v - w)) * (wanted[w] - is[w]);
        ck_assert_double_eq_tol(command[v], sum, 1e-14);
    }
    control.coupled = false;
    gough_control_sample(&control, NULL, &memory, zero, wanted, zero, is, NULL, command);
    for (int v = 0; v < 6; v++)
        ck_assert_double_eq_tol(command[v], (3 + v) * (wanted[v] - is[v]), 1e-14);
}
END_TEST

/* No processor has three or sixteen lanes. */
START_TEST(lanes_are_those_of_processors) {
    gough_model *model = calloc(1, sizeof *model);
    const gough_simulation simulation = gough_simulation_default();
    gough_batch_options options = gough_batch_options_default();
    gough_map_options o = gough_map_options_default();
    gough_outcome outcome;
    gough_error error = {.message = ""};
    size_t bytes;
    char memory[64];
    ck_assert_ptr_nonnull(model);
    skew_machine(&model->machine);
    model->control.feedforward = true;
    const gough_batch_run run = {
        &model->machine, &model->control, &model->disturbance, &model->initial, 1, 0};
    static const int lanes[] = {3, 16, -1};
    for (int i = 0; i < 3; i++) {
        options.lanes = o.lanes = lanes[i];
        o.stiffness = (gough_map_range){1, 2, 2, false};
        ck_assert_int_eq(
            gough_batch(&model->motion, &simulation, &run, 1, &options, &outcome, memory, &error),
            GOUGH_ERROR_INPUT);
        ck_assert_ptr_nonnull(strstr(error.message, "lanes: this processor can run 1"));
        error.message[0] = '\0';
        ck_assert_int_eq(gough_map_size(model, &o, &bytes, &error), GOUGH_ERROR_INPUT);
        ck_assert_ptr_nonnull(strstr(error.message, "lanes"));
    }
    free(model);
}
END_TEST

int main(void) {
    return SUITE_RUN("batch/left_out", 60, outputs_may_be_left_out,
                     a_state_without_a_rotation_is_refused, numbers_beyond_all_bounds_are_refused,
                     a_load_may_be_flat, a_law_needs_no_rates_and_no_drives,
                     lanes_are_those_of_processors);
}
