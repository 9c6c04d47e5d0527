/* Forces along a program: recorded motion against the cubic that its spline reproduces, limits that are met or kept for an instant
 * between rows, and what stops the walk. */
#include <stdio.h>

#include "support/machines.h"
#include "support/suite.h"

enum { MOST_ROWS = 64, MOST_CROSSINGS = 16 };

typedef struct {
    int rows, stop_after;
    double row[MOST_ROWS][GOUGH_COLUMNS];
    gough_crossing crossing[MOST_CROSSINGS];
    int crossings;
} walked;

static int keep(void *context, const gough_row *row) {
    walked *w = context;

    ck_assert_int_lt(w->rows, MOST_ROWS);
    memcpy(w->row[w->rows++], row->value, sizeof row->value);
    return w->rows == w->stop_after;
}

static void note(void *context, const gough_crossing *crossing) {
    walked *w = context;

    ck_assert_int_lt(w->crossings, MOST_CROSSINGS);
    w->crossing[w->crossings++] = *crossing;
}

static gough_model *moving(int component, const char *text) {
    gough_model *model = calloc(1, sizeof *model);

    ck_assert(model != NULL);
    paper_machine(&model->machine);
    set_formula(&model->motion.formula[component], text);
    return model;
}

static gough_simulation rows_of(double duration, double step) {
    gough_simulation s = gough_simulation_default();

    s.duration = duration;
    s.output_step = step;
    return s;
}

static gough_status walk(const gough_model *model, const gough_simulation *s, walked *w,
                         gough_end *end, gough_error *error) {
    w->rows = w->crossings = 0;
    return gough_forces(model, s, keep, w, note, w, end, error);
}

/* ---- recorded motion ---- */

static double heave_at(double t) { return 0.02 * t - 0.03 * t * t + 0.01 * t * t * t; }

/* rows at unequal times, before and beyond the run; at half the pace the run takes twice the time */
START_TEST(a_recorded_cubic_needs_the_forces_of_the_cubic) {
    enum { ROWS = 7 };
    double time[ROWS] = {-0.1, 0.2, 0.5, 0.6, 1.1, 1.7, 2.3}, value[ROWS * GOUGH_COMPONENTS] = {0},
           curvature[ROWS * GOUGH_COMPONENTS], scratch[64];
    gough_model *model = moving(GOUGH_HEAVE, "0.02*t - 0.03*t^2 + 0.01*t^3");
    const gough_samples samples = {
        .count = ROWS, .time = time, .value = value, .curvature = curvature};
    gough_error error = {0};
    gough_summary written_sum, recorded_sum;
    walked written = {0}, recorded = {0};
    gough_end end;

    for (int i = 0; i < ROWS; i++) value[i * GOUGH_COMPONENTS + GOUGH_HEAVE] = heave_at(time[i]);
    ck_assert_uint_le(gough_samples_scratch(ROWS), 64);
    ck_assert_int_eq(gough_samples_prepare(&samples, scratch, &error), GOUGH_OK);
    for (int scaled = 0; scaled < 2; scaled++) {
        gough_simulation s = rows_of(scaled ? 4 : 2, 0.25);
        model->motion.scaled = scaled;
        model->motion.amplitude = 1.5, model->motion.frequency = 0.5;
        s.summary = &written_sum;
        model->motion.kind = GOUGH_MOTION_FORMULAS;
        ck_assert_int_eq(walk(model, &s, &written, &end, &error), GOUGH_OK);
        s.summary = &recorded_sum;
        model->motion.kind = GOUGH_MOTION_SAMPLES;
        model->motion.samples = samples;
        ck_assert_int_eq(walk(model, &s, &recorded, &end, &error), GOUGH_OK);
        ck_assert_int_eq(recorded.rows, written.rows);
        for (int k = 0; k < written.rows; k++) {
            for (int v = 0; v < GOUGH_LEGS; v++) {
                ck_assert(fabs(recorded.row[k][GOUGH_F + v] - written.row[k][GOUGH_F + v]) <=
                          1e-14);
                ck_assert(fabs(recorded.row[k][GOUGH_L + v] - written.row[k][GOUGH_L + v]) <=
                          1e-15);
            }
        }
        for (int v = 0; v < GOUGH_LEGS; v++) {
            const gough_leg_summary *one = &written_sum.leg[v], *two = &recorded_sum.leg[v];
            ck_assert(fabs(two->force_max - one->force_max) <= 1e-9);
            ck_assert(fabs(two->rms_force - one->rms_force) <= 1e-9);
        }
    }
    free(model);
}
END_TEST

/* ---- limits for an instant ---- */

static double length_at(const gough_machine *machine, double heave) {
    const double l = machine->home_length[0], d2 = l * l - 1;
    return sqrt((1 + heave) * (1 + heave) + d2);
}

/* the greatest length is passed by 1e-6 about t = π/2, for 0.018 to either side: rows are 0.4 apart */
START_TEST(a_limit_broken_between_rows_is_found) {
    gough_model *model = moving(GOUGH_HEAVE, "0.1*sin(t)");
    const gough_simulation s = rows_of(3, 0.4);
    gough_error error = {0};
    walked w = {0};
    gough_end end;

    const double greatest = length_at(&model->machine, 0.1), limit = greatest - 1e-6;
    model->machine.platform.length_max = limit;
    ck_assert_int_eq(walk(model, &s, &w, &end, &error), GOUGH_ERROR_NUMERICAL);
    ck_assert_int_eq(end.cause, GOUGH_END_LEG_LONG);
    ck_assert_int_eq(w.crossings, GOUGH_LEGS);
    for (int i = 0; i < w.crossings; i++) {
        const gough_crossing *c = &w.crossing[i];
        ck_assert(fabs(length_at(&model->machine, 0.1 * sin(c->enter)) - limit) <= 1e-11);
        ck_assert(fabs(length_at(&model->machine, 0.1 * sin(c->leave)) - limit) <= 1e-11);
        ck_assert(c->enter < pi / 2 && c->leave > pi / 2);
        ck_assert(fabs(c->worst - greatest) <= 1e-8);
    }
    free(model);
}
END_TEST

/* the same at the lower end: between two spells beyond the limit the leg is within it about t = π only */
START_TEST(a_limit_kept_between_rows_parts_two_crossings) {
    gough_model *model = moving(GOUGH_HEAVE, "0.1*cos(t)");
    const gough_simulation s = rows_of(6, 0.4);
    gough_error error = {0};
    walked w = {0};
    gough_end end;

    const double limit = length_at(&model->machine, -0.1) + 1e-6;
    model->machine.platform.length_max = limit;
    ck_assert_int_eq(walk(model, &s, &w, &end, &error), GOUGH_ERROR_NUMERICAL);
    ck_assert(fabs(end.time) <= 0);
    ck_assert_int_eq(w.crossings, 2 * GOUGH_LEGS);
    for (int i = 0; i < w.crossings; i++) {
        const gough_crossing *c = &w.crossing[i];
        if (i < GOUGH_LEGS) {
            ck_assert(fabs(c->enter) <= 0 && c->leave < pi);
            ck_assert(fabs(length_at(&model->machine, 0.1 * cos(c->leave)) - limit) <= 1e-11);
        } else {
            ck_assert(c->enter > pi && isinf(c->leave));
            ck_assert(fabs(length_at(&model->machine, 0.1 * cos(c->enter)) - limit) <= 1e-11);
        }
    }
    free(model);
}
END_TEST

START_TEST(nobody_need_listen_to_crossings) {
    gough_model *model = moving(GOUGH_HEAVE, "0.1*sin(t)");
    const gough_simulation s = rows_of(3, 0.4);
    gough_end end;

    model->machine.platform.length_min = length_at(&model->machine, 0.05);
    ck_assert_int_eq(gough_forces(model, &s, NULL, NULL, NULL, NULL, &end, NULL),
                     GOUGH_ERROR_NUMERICAL);
    ck_assert_int_eq(end.cause, GOUGH_END_LEG_SHORT);
    ck_assert(fabs(end.time) <= 0);
    free(model);
}
END_TEST

/* ---- what stops the walk ---- */

START_TEST(a_sink_stops_it_at_its_row) {
    gough_model *model = moving(GOUGH_HEAVE, "0.1*sin(t)");
    const gough_simulation s = rows_of(3, 0.5);
    gough_error error = {0};
    gough_end end;

    for (int rows = 1; rows < 7; rows++) {
        walked w = {.stop_after = rows};
        ck_assert_int_eq(walk(model, &s, &w, &end, &error), GOUGH_ERROR_NUMERICAL);
        ck_assert_int_eq(end.cause, GOUGH_END_STOPPED);
        ck_assert_int_eq(w.rows, rows);
        ck_assert(fabs(end.time - 0.5 * (rows - 1)) <= 1e-15);
    }
    free(model);
}
END_TEST

/* yaw passes 90°, where the paper's machine is singular, within 1e-7 */
START_TEST(a_jump_across_a_singular_pose_is_located) {
    gough_model *model = moving(GOUGH_YAW, "2*ramp(t - 1, 1e-7)");
    const gough_simulation s = rows_of(3, 0.4);
    gough_error error = {0};
    walked w = {0};
    gough_end end;

    ck_assert_int_eq(walk(model, &s, &w, &end, &error), GOUGH_ERROR_NUMERICAL);
    ck_assert_int_eq(end.cause, GOUGH_END_SINGULAR);
    ck_assert_msg(end.time > 1 && end.time < 1 + 1e-7, "%.17g", end.time);
    ck_assert_int_eq(w.rows, 3);
    free(model);
}
END_TEST

START_TEST(a_singular_pose_at_the_beginning_stops_it_there) {
    gough_model *model = moving(GOUGH_YAW, "pi/2 + 0*t");
    const gough_simulation s = rows_of(3, 0.4);
    gough_error error = {0};
    walked w = {0};
    gough_end end;

    ck_assert_int_eq(walk(model, &s, &w, &end, &error), GOUGH_ERROR_NUMERICAL);
    ck_assert_int_eq(end.cause, GOUGH_END_SINGULAR);
    ck_assert(fabs(end.time) <= 0);
    ck_assert_int_eq(w.rows, 0);
    free(model);
}
END_TEST

START_TEST(a_formula_that_is_not_finite_stops_it_at_its_time) {
    static const struct {
        const char *heave;
        double time;
        int rows;
    } cases[] = {{"0.1*sqrt(t - 1)", 0, 0}, {"0.1*sqrt(1.3 - t)", 1.3, 4}};

    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        gough_model *model = moving(GOUGH_HEAVE, cases[i].heave);
        const gough_simulation s = rows_of(3, 0.4);
        gough_error error = {0};
        walked w = {0};
        gough_end end;

        ck_assert_int_eq(walk(model, &s, &w, &end, &error), GOUGH_ERROR_INPUT);
        ck_assert_int_eq(end.cause, GOUGH_END_NOT_FINITE);
        ck_assert_msg(end.time >= cases[i].time && end.time < cases[i].time + 0.01, "%.17g",
                      end.time);
        ck_assert_int_eq(w.rows, cases[i].rows);
        ck_assert_msg(strstr(error.message, "heave") != NULL, "%s", error.message);
        free(model);
    }
}
END_TEST

int main(void) {
    return SUITE_RUN("forces", 60, a_recorded_cubic_needs_the_forces_of_the_cubic,
                     a_limit_broken_between_rows_is_found,
                     a_limit_kept_between_rows_parts_two_crossings, nobody_need_listen_to_crossings,
                     a_sink_stops_it_at_its_row, a_jump_across_a_singular_pose_is_located,
                     a_singular_pose_at_the_beginning_stops_it_there,
                     a_formula_that_is_not_finite_stops_it_at_its_time);
}
