/* Runs of a motion with its amplitude and frequency changed: the runs of the motion written out. */
#include "support/machines.h"
#include "support/suite.h"

enum { MOST_ROWS = 60 };

typedef struct {
    size_t count;
    double row[MOST_ROWS][GOUGH_COLUMNS];
} table;

static int keep(void *context, const gough_row *row) {
    table *all = context;

    ck_assert_uint_lt(all->count, MOST_ROWS);
    memcpy(all->row[all->count++], row->value, sizeof row->value);
    return 0;
}

static gough_model *in_pitch(const char *pitch, const char *heave) {
    gough_model *model = calloc(1, sizeof *model);

    ck_assert(model != NULL);
    skew_machine(&model->machine);
    set_formula(&model->motion.formula[GOUGH_PITCH], pitch);
    set_formula(&model->motion.formula[GOUGH_HEAVE], heave);
    set_formula(&model->disturbance.leg_force[1], "0.1*sin(3*t)"); /* keeps its own time */
    model->control.feedforward = true;
    set_gains(model, 30, 1);
    return model;
}

START_TEST(scaled_run_is_the_run_written_out) {
    gough_model *scaled = in_pitch("0.1*sin(t)", "0.1*sin(2*t)*ramp(t, 3)"),
                *written =
                    in_pitch("1.5*(0.1*sin(0.5*t))", "1.5*(0.1*sin(2*(0.5*t))*ramp(0.5*t, 3))");
    gough_simulation s = gough_simulation_default();
    gough_error error = {0};
    gough_end end;
    static table one, other;

    scaled->motion.scaled = true;
    scaled->motion.amplitude = 1.5;
    scaled->motion.frequency = 0.5;
    s.duration = 5;
    s.output_step = 0.1;
    s.step = 0.025;
    ck_assert(gough_simulate(scaled, &s, keep, &one, &end, &error) == GOUGH_OK);
    ck_assert(gough_simulate(written, &s, keep, &other, &end, &error) == GOUGH_OK);
    ck_assert_uint_eq(one.count, 51);
    ck_assert_uint_eq(other.count, 51);
    for (size_t i = 0; i < one.count; i++) {
        for (int c = 0; c < GOUGH_DRIFT; c++) {
            /* round-off, in forces of some 0.5 with G = 30 */
            ck_assert_msg(fabs(one.row[i][c] - other.row[i][c]) <= 1e-12, "%s at %g: %.17g, %.17g",
                          gough_column(c)->name, one.row[i][0], one.row[i][c], other.row[i][c]);
        }
    }
    free(scaled);
    free(written);
}
END_TEST

START_TEST(slower_recorded_motion_lasts_longer) {
    static const double time[3] = {0, 1, 2}, value[3 * GOUGH_COMPONENTS] = {0};
    static double curvature[3 * GOUGH_COMPONENTS];
    gough_model *model = in_pitch("0", "0");
    gough_simulation s = gough_simulation_default();
    gough_error error = {0};

    model->motion = (gough_motion){
        .kind = GOUGH_MOTION_SAMPLES,
        .samples = {.count = 3, .time = time, .value = value, .curvature = curvature},
        .amplitude = 1,
        .frequency = 0.5};
    s.duration = 4;
    ck_assert(gough_simulation_check(model, &s, &error) == GOUGH_ERROR_INPUT);
    ck_assert_msg(strstr(error.message, "to 2") != NULL, "%s", error.message);
    model->motion.scaled = true;
    ck_assert(gough_simulation_check(model, &s, &error) == GOUGH_OK);
    model->motion.frequency = 1.25;
    ck_assert(gough_simulation_check(model, &s, &error) == GOUGH_ERROR_INPUT);
    ck_assert_msg(strstr(error.message, "to 1.6") != NULL, "%s", error.message);
    free(model);
}
END_TEST

int main(void) {
    return SUITE_RUN("scaled", 60, scaled_run_is_the_run_written_out,
                     slower_recorded_motion_lasts_longer);
}
