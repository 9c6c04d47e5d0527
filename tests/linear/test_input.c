/* The functions of the core refuse numbers outside their enumerations and matrices that are no rotations, with GOUGH_ERROR_INPUT
 * and a sentence, whatever else they are given. */
#include <limits.h>
#include <stdlib.h>

#include "gough/gough.h"
#include "support/machines.h"
#include "support/suite.h"

static const int outside[] = {-1, 6, 7, 99, INT_MAX, INT_MIN};
enum { OUTSIDE = sizeof outside / sizeof *outside };

static gough_model *new_model(void) {
    gough_model *model = calloc(1, sizeof *model);
    ck_assert_ptr_nonnull(model);
    paper_machine(&model->machine);
    model->control.feedforward = true;
    set_gains(model, 10, 1);
    set_formula(&model->motion.formula[GOUGH_HEAVE], "0.1*sin(t)");
    return model;
}

static int ignore(void *context, const gough_row *row) {
    (void)row;
    ++*(int *)context;
    return 0;
}

static void refused(gough_status status, const gough_error *error, const char *who) {
    ck_assert_msg(status == GOUGH_ERROR_INPUT, "%s: status %d", who, (int)status);
    ck_assert_msg(error->message[0] != '\0', "%s: no sentence", who);
}

static gough_status run_batch(const gough_model *model, const gough_simulation *simulation,
                              gough_error *error) {
    const gough_batch_run run = {
        &model->machine, &model->control, &model->disturbance, &model->initial, 1, 0};
    const gough_batch_options options = {.lanes = 1, .threads = 1};
    void *memory = aligned_alloc(64, (gough_batch_size(&options) + 63) / 64 * 64);
    gough_outcome outcome;
    ck_assert_ptr_nonnull(memory);
    const gough_status status =
        gough_batch(&model->motion, simulation, &run, 1, &options, &outcome, memory, error);
    free(memory);
    return status;
}

/* Whatever runs a model with these options refuses them and hands out no row. */
static void no_run(const gough_model *model, const gough_simulation *simulation) {
    gough_error error = {0};
    gough_end end;
    int rows = 0;
    refused(gough_simulation_check(model, simulation, &error), &error, "check");
    error.message[0] = '\0';
    refused(gough_simulate(model, simulation, ignore, &rows, &end, &error), &error, "simulate");
    error.message[0] = '\0';
    refused(gough_forces(model, simulation, ignore, &rows, NULL, NULL, &end, &error), &error,
            "forces");
    error.message[0] = '\0';
    refused(run_batch(model, simulation, &error), &error, "batch");
    ck_assert_int_eq(rows, 0);
}

START_TEST(runs_refuse_values_outside_their_enumerations) {
    gough_model *model = new_model();
    for (int i = 0; i < OUTSIDE; i++) {
        gough_simulation s = gough_simulation_default();
        s.duration = 0.1;
        s.precision = (gough_precision)outside[i];
        no_run(model, &s);
        s.precision = GOUGH_DOUBLE;
        s.constraints = (gough_constraints)outside[i];
        no_run(model, &s);
        s.constraints = GOUGH_PROJECTION;
        s.method = (gough_method)outside[i];
        no_run(model, &s);
        s.method = GOUGH_RK4;
        s.step = 0.05;
        s.constraints = (gough_constraints)outside[i];
        no_run(model, &s);
        s.constraints = GOUGH_NONE;
        model->motion.kind = (gough_motion_kind)outside[i];
        no_run(model, &s);
        model->motion.kind = GOUGH_MOTION_FORMULAS;
        ck_assert_int_eq(gough_simulation_check(model, &s, NULL), GOUGH_OK);
    }
    free(model);
}
END_TEST

START_TEST(runs_refuse_motions_without_their_moves_samples_and_factors) {
    gough_model *model = new_model();
    gough_simulation s = gough_simulation_default();
    s.duration = 0.1;
    model->motion.kind = GOUGH_MOTION_SAMPLES;
    no_run(model, &s);
    model->motion.kind = GOUGH_MOTION_MOVES;
    model->motion.moves = 2;
    no_run(model, &s);
    model->motion.kind = GOUGH_MOTION_FORMULAS;
    model->motion.about[1] = NAN;
    no_run(model, &s);
    model->motion.about[1] = 0;
    model->motion.scaled = true;
    const double factors[] = {0, -1, NAN, INFINITY};
    for (int i = 0; i < 4; i++) {
        model->motion.amplitude = 1;
        model->motion.frequency = factors[i];
        no_run(model, &s);
    }
    model->motion.frequency = 1;
    model->motion.amplitude = NAN;
    no_run(model, &s);
    free(model);
}
END_TEST

START_TEST(analyses_refuse_a_kind_of_motion_and_an_axis_that_do_not_exist) {
    gough_model *model = new_model();
    const gough_period given = {.start = 0, .period = 2 * pi};
    for (int i = 0; i < OUTSIDE; i++) {
        gough_error error = {0};
        gough_period period;
        static gough_rest rest;
        static gough_floquet floquet;
        double matrix[GOUGH_LINEAR][GOUGH_LINEAR], component[GOUGH_COMPONENTS][3];
        model->motion.kind = (gough_motion_kind)outside[i];
        refused(gough_motion_period(&model->motion, &period, &error), &error, "period");
        refused(gough_linearise(model, 0, NULL, GOUGH_LINEAR, matrix[0], &error), &error,
                "linearise");
        refused(gough_stability_at_rest(model, NULL, &rest, &error), &error, "rest");
        refused(gough_floquet_multipliers(model, NULL, 0, &floquet, &error), &error, "floquet");
        refused(gough_floquet_multipliers(model, &given, 0, &floquet, &error), &error, "floquet");
        gough_motion_evaluate(&model->motion, 1, component);
        for (int c = 0; c < GOUGH_COMPONENTS; c++) ck_assert(isnan(component[c][0]));
        model->motion.kind = GOUGH_MOTION_FORMULAS;

        gough_map_options options = gough_map_options_default();
        size_t bytes;
        options.stiffness = (gough_map_range){1, 2, 2, false};
        options.second = (gough_map_range){1, 2, 2, false};
        ck_assert_int_eq(gough_map_size(model, &options, &bytes, &error), GOUGH_OK);
        options.axis = (gough_map_axis)outside[i];
        refused(gough_map_size(model, &options, &bytes, &error), &error, "map");
    }
    free(model);
}
END_TEST

START_TEST(names_of_values_outside_their_enumerations_are_harmless) {
    for (int i = 0; i < OUTSIDE; i++) {
        ck_assert_ptr_null(gough_method_name(outside[i]));
        ck_assert_str_eq(gough_interval_kind_name((gough_interval_kind)outside[i]), "unknown");
        if (outside[i] != 6 && outside[i] != 7)
            ck_assert_str_eq(gough_cause_name((gough_cause)outside[i]), "unknown");
        ck_assert_str_eq(gough_tuning_exception_name((gough_tuning_exception_kind)outside[i]),
                         "unknown");
        ck_assert_str_eq(gough_tuning_binding_name((gough_tuning_binding)outside[i]), "unknown");
        const char *component = gough_component_name(outside[i]);
        ck_assert(!component || !*component || strcmp(component, "unknown") == 0);
    }
}
END_TEST

START_TEST(a_flat_model_of_values_outside_their_enumerations_is_refused) {
    gough_model *model = new_model(), *read = malloc(sizeof *read);
    gough_simulation s = gough_simulation_default(), options;
    double *flat = malloc(gough_model_flat_size(model) * sizeof *flat);
    ck_assert(read && flat);
    for (int i = 0; i < OUTSIDE; i++) {
        for (int field = 0; field < 4; field++) {
            gough_error error = {0};
            s = gough_simulation_default();
            if (field == 0) s.precision = (gough_precision)outside[i];
            if (field == 1) s.method = (gough_method)outside[i];
            if (field == 2) s.constraints = (gough_constraints)outside[i];
            if (field == 3) model->motion.kind = (gough_motion_kind)outside[i];
            const size_t count = gough_model_flat_size(model);
            gough_model_flatten(model, &s, flat);
            model->motion.kind = GOUGH_MOTION_FORMULAS;
            refused(gough_model_unflatten(read, &options, NULL, flat, count, &error), &error,
                    "unflatten");
        }
    }
    free(flat);
    free(read);
    free(model);
}
END_TEST

/* ---- rotations ------------------------------------------------------------------------------------------------------ */

static void every_function_answers(double rotation[3][3], gough_status status) {
    gough_model *model = new_model();
    const gough_machine *machine = &model->machine;
    gough_state state = gough_state_home(machine);
    gough_acceleration acceleration = {{0, 0, 0}, {0, 0, 0}};
    const double force[GOUGH_LEGS] = {1, 1, 1, 1, 1, 1};
    double six[6] = {7, 7, 7, 7, 7, 7}, jacobian[6][6], condition = 7, matrix[12][12], r[3][3];
    memcpy(state.rotation, rotation, sizeof state.rotation);
    memcpy(r, rotation, sizeof r);
    ck_assert_int_eq(gough_leg_kinematics(machine, &state, NULL, six, NULL, NULL), status);
    if (status != GOUGH_OK)
        for (int v = 0; v < 6; v++) ck_assert(six[v] >= 7 && six[v] <= 7);
    ck_assert_int_eq(gough_jacobian(machine, &state, jacobian), status);
    ck_assert_int_eq(gough_conditioning(machine, &state, &condition, NULL), status);
    ck_assert_int_eq(gough_inverse_dynamics(machine, &state, &acceleration, NULL, six, &condition),
                     status);
    ck_assert_int_eq(gough_forward_dynamics(machine, &state, force, NULL, &acceleration), status);
    ck_assert_int_eq(gough_reactions(machine, &state, force, NULL, six), status);
    ck_assert_int_eq(gough_angles_from_rotation(r, six), status);
    ck_assert_int_eq(gough_linearise(model, 0, &state, GOUGH_LINEAR, matrix[0], NULL), status);
    free(model);
}

START_TEST(a_matrix_of_another_size_is_refused) {
    gough_model *model = new_model();
    double matrix[GOUGH_LINEAR + 1][GOUGH_LINEAR + 1] = {{0}};
    gough_error error = {0};

    ck_assert_uint_eq(gough_linear_size(model), GOUGH_LINEAR);
    for (size_t size = 0; size <= GOUGH_LINEAR + 1; size++) {
        if (size == GOUGH_LINEAR) continue;
        ck_assert_int_eq(gough_linearise(model, 0, NULL, size, matrix[0], &error),
                         GOUGH_ERROR_INPUT);
        ck_assert(strstr(error.message, "has 12 rows") != NULL);
    }
    free(model);
}
END_TEST

START_TEST(a_matrix_that_is_no_rotation_is_refused_by_every_function_of_one_pose) {
    double wrong[][3][3] = {
        {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}},    {{1, 0, 0}, {0, 1, 0}, {0, 0, -1}}, /* a reflection */
        {{2, 0, 0}, {0, 2, 0}, {0, 0, 2}},    {{1, 0, 0}, {0, 1, 0}, {0, 0, 1 + 1e-5}},
        {{1, 1e-5, 0}, {0, 1, 0}, {0, 0, 1}}, {{NAN, 0, 0}, {0, 1, 0}, {0, 0, 1}},
        {{1, 0, 0}, {0, 1, NAN}, {0, 0, 1}},  {{INFINITY, 0, 0}, {0, 1, 0}, {0, 0, 1}},
        {{1, 0, 0}, {1, 0, 0}, {0, 0, 1}}};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++)
        every_function_answers(wrong[i], GOUGH_ERROR_INPUT);
}
END_TEST

START_TEST(rotations_in_double_and_single_precision_are_taken) {
    const double angles[3] = {0.1, -0.2, 0.3};
    double rotation[3][3], single[3][3];
    gough_rotation_from_angles(angles, rotation);
    for (int i = 0; i < 9; i++) single[i / 3][i % 3] = (float)rotation[i / 3][i % 3];
    every_function_answers(rotation, GOUGH_OK);
    every_function_answers(single, GOUGH_OK);
}
END_TEST

int main(void) {
    return SUITE_RUN("linear/input", 60, runs_refuse_values_outside_their_enumerations,
                     runs_refuse_motions_without_their_moves_samples_and_factors,
                     analyses_refuse_a_kind_of_motion_and_an_axis_that_do_not_exist,
                     names_of_values_outside_their_enumerations_are_harmless,
                     a_flat_model_of_values_outside_their_enumerations_is_refused,
                     a_matrix_that_is_no_rotation_is_refused_by_every_function_of_one_pose,
                     a_matrix_of_another_size_is_refused,
                     rotations_in_double_and_single_precision_are_taken);
}
