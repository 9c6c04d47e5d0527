/* The summary of a run against integrals and peaks found another way. */
#include <stdio.h>

#include "gough/dynamics.h"
#include "support/machines.h"
#include "support/suite.h"

typedef struct {
    const gough_machine *machine;
    gough_summary summary;
} summing;

static int sum_row(void *context, const gough_row *row) {
    summing *s = context;

    gough_summary_add(&s->summary, s->machine, row);
    return 0;
}

static gough_summary sum(const gough_model *model, double duration, double step, bool simulated) {
    gough_simulation s = gough_simulation_default();
    summing context = {.machine = &model->machine};
    gough_error error = {0};
    gough_end end;

    s.duration = duration;
    s.output_step = step;
    s.tolerance = 1e-12;
    gough_summary_begin(&context.summary);
    if (simulated) {
        ck_assert_int_eq(gough_simulate(model, &s, sum_row, &context, &end, &error), GOUGH_OK);
    } else {
        ck_assert_int_eq(gough_forces(model, &s, sum_row, &context, NULL, NULL, &end, &error),
                         GOUGH_OK);
    }
    gough_summary_end(&context.summary);
    return context.summary;
}

/* kinetic and potential energy of the load along the program, pure heave */
static double energy_at(const gough_model *model, double t) {
    gough_acceleration a;
    gough_state s;

    gough_program(&model->machine, &model->motion, t, &s, &a);
    return model->machine.load.mass *
           (s.velocity[2] * s.velocity[2] / 2 + model->machine.gravity_magnitude * s.position[2]);
}

START_TEST(energy_is_the_load_s_and_of_fourth_order) {
    gough_model *model = calloc(1, sizeof *model);
    double error[2], want;

    paper_machine(&model->machine);
    set_formula(&model->motion.formula[GOUGH_HEAVE], "0.2*sin(t)*(1 - exp(-t/2))^2");
    want = energy_at(model, 8) - energy_at(model, 0);
    for (int k = 0; k < 2; k++) {
        const gough_summary s = sum(model, 8, k ? 0.05 : 0.1, false);
        double energy = 0;
        for (int v = 0; v < 6; v++) energy += s.leg[v].energy;
        error[k] = fabs(energy - want);
    }
    ck_assert(error[1] <= 1e-7);
    ck_assert(log2(error[0] / error[1]) > 3.5);
    free(model);
}
END_TEST

/* at rest: force Mg l/(6h) in each leg, no power, no swing; two and three rows too */
START_TEST(rest_is_summed_exactly) {
    gough_model *model = calloc(1, sizeof *model);

    paper_machine(&model->machine);
    for (int rows = 1; rows <= 6; rows++) {
        const gough_summary s = sum(model, rows == 1 ? 0.5 : rows - 1, 1, false);
        const double force = model->machine.home_length[0] / 6;
        ck_assert_int_eq((int)s.rows, rows);
        for (int v = 0; v < 6; v++) {
            ck_assert(fabs(s.leg[v].rms_force - force) <= 1e-14);
            ck_assert(fabs(s.leg[v].force_min - force) <= 1e-14);
            ck_assert(fabs(s.leg[v].energy) <= 1e-15);
            ck_assert(s.leg[v].speed <= 1e-15);
            ck_assert(s.leg[v].swing_base <= 1e-7 && s.leg[v].swing_top <= 1e-7);
            ck_assert(fabs(s.leg[v].length_max - model->machine.home_length[v]) <= 1e-15);
        }
        ck_assert(isnan(s.position_deviation) && isnan(s.drift));
    }
    free(model);
}
END_TEST

/* swing by the angle between a leg and itself at home: a roll of the top turns the legs in the base by one angle and in the top
 * by another */
START_TEST(swing_is_the_angle_of_each_end) {
    gough_model *model = calloc(1, sizeof *model);
    const double angles[3] = {0.3, 0, 0};
    double R[3][3];

    paper_machine(&model->machine);
    set_formula(&model->motion.formula[GOUGH_ROLL], "0.3");
    const gough_summary s = sum(model, 1, 0.5, false);
    gough_rotation_from_angles(angles, R);
    for (int v = 0; v < 6; v++) {
        const double *b = model->machine.platform.base[v], *t = model->machine.platform.top[v];
        double home[3], now[3], seen[3], c1 = 0, c2 = 0, n0 = 0, n1 = 0;
        for (int r = 0; r < 3; r++) {
            home[r] = t[r] + (r == 2) - b[r];
            now[r] = (r == 2) - b[r];
            for (int c = 0; c < 3; c++) now[r] += R[r][c] * t[c];
        }
        for (int r = 0; r < 3; r++) {
            seen[r] = 0;
            for (int c = 0; c < 3; c++) seen[r] += R[c][r] * now[c];
            c1 += home[r] * now[r];
            c2 += home[r] * seen[r];
            n0 += home[r] * home[r];
            n1 += now[r] * now[r];
        }
        ck_assert(fabs(s.leg[v].swing_base - acos(c1 / sqrt(n0 * n1))) <= 1e-8);
        ck_assert(fabs(s.leg[v].swing_top - acos(c2 / sqrt(n0 * n1))) <= 1e-8);
    }
    free(model);
}
END_TEST

/* started off the program by known amounts and stopped at once: the deviations are those */
/* the force of leg 1 by looks h apart from `start`, of a wave or of a jump */
static gough_leg_summary sum_looks(double start, double h, int looks, bool jumps) {
    gough_machine machine;
    gough_summary s;
    gough_row row;

    paper_machine(&machine);
    gough_summary_begin(&s);
    for (int k = 0; k < looks; k++) {
        const double t = start + k * h;
        for (int c = 0; c < GOUGH_COLUMNS; c++) row.value[c] = 0;
        row.value[GOUGH_X] = row.value[GOUGH_EX] = NAN;
        row.value[GOUGH_T] = t;
        row.value[GOUGH_F] = jumps ? t > 1 : sin(t);
        gough_summary_look(&s, &machine, &row, k == 0);
    }
    gough_summary_end(&s);
    return s.leg[0];
}

/* a cubic through sines h apart misses them by h^4/24 at most, in the outer intervals */
START_TEST(peaks_lie_between_any_two_looks) {
    const double h = 0.05, peak = acos(-1) / 2, slack = pow(h, 4) / 24;

    for (int k = 0; k < 4; k++) { /* through the first interval to the last of five looks */
        for (int part = 1; part < 4; part++) {
            const double start = peak - (k + part / 4.0) * h;
            const gough_leg_summary leg = sum_looks(start, h, 5, false);
            ck_assert(fabs(leg.force_max - 1) <= slack);
        }
    }
    const double start = peak - 1.3 * h; /* a parabola, through three looks */
    ck_assert(fabs(sum_looks(start, h, 3, false).force_max - 1) <= pow(h, 3) / 15);
}
END_TEST

START_TEST(no_peak_beyond_a_jump) {
    ck_assert(!(fabs(sum_looks(0, 0.11, 20, true).force_max - 1) > 1e-15));
    ck_assert(!(fabs(sum_looks(0, 0.11, 20, true).force_min) > 1e-15));
}
END_TEST

/* a force that rises evenly to 1 and falls from there, with looks h apart: cubics across the tip would overshoot it */
static gough_leg_summary sum_tent(double h, bool marked) {
    gough_machine machine;
    gough_summary s;
    gough_row row;

    paper_machine(&machine);
    gough_summary_begin(&s);
    for (int k = -4; k <= 4; k++) {
        for (int c = 0; c < GOUGH_COLUMNS; c++) row.value[c] = 0;
        row.value[GOUGH_X] = row.value[GOUGH_EX] = NAN;
        row.value[GOUGH_T] = 1 + k * h;
        row.value[GOUGH_F] = 1 - fabs(k * h);
        gough_summary_look(&s, &machine, &row, k == -4);
        if (k == 0 && marked) gough_summary_corner(&s);
    }
    gough_summary_end(&s);
    return s.leg[0];
}

START_TEST(nothing_is_interpolated_across_a_corner) {
    const double h = 0.1, end = 1 - 4 * h;
    const double rms = sqrt((1 - end * end * end) / (3 * 4 * h));
    ck_assert(fabs(sum_tent(h, true).force_max - 1) <= 1e-15);
    ck_assert(fabs(sum_tent(h, true).force_min - end) <= 1e-15);
    ck_assert(fabs(sum_tent(h, true).rms_force - rms) <= 1e-14);
    /* without the mark both are off, so that the test above is one */
    ck_assert(!(fabs(sum_tent(h, false).rms_force - rms) <= 1e-6));
}
END_TEST

/* a force of 1 that becomes 3 within no time, as a held command does; the looks are at 0, 0.1 … 0.4 and 0.4 … 0.8 */
START_TEST(a_force_may_jump_between_two_looks_of_one_time) {
    gough_machine machine;
    gough_summary s;
    gough_row row;

    paper_machine(&machine);
    gough_summary_begin(&s);
    for (int k = 0; k < 10; k++) {
        for (int c = 0; c < GOUGH_COLUMNS; c++) row.value[c] = 0;
        row.value[GOUGH_X] = row.value[GOUGH_EX] = NAN;
        row.value[GOUGH_T] = 0.1 * (k < 5 ? k : k - 1);
        row.value[GOUGH_F] = k < 5 ? 1 : 3;
        gough_summary_look(&s, &machine, &row, k == 0);
        if (k == 4) gough_summary_jump(&s);
    }
    gough_summary_end(&s);
    ck_assert(fabs(s.leg[0].rms_force - sqrt(5)) <= 1e-14);
    ck_assert(fabs(s.leg[0].force_max - 3) <= 0 && fabs(s.leg[0].force_min - 1) <= 0);
}
END_TEST

START_TEST(deviation_is_what_was_put_in) {
    gough_model *model = calloc(1, sizeof *model);

    paper_machine(&model->machine);
    model->control.feedforward = true;
    set_gains(model, 5, 5);
    model->initial.component[GOUGH_SURGE] = 0.003;
    model->initial.component[GOUGH_HEAVE] = -0.004;
    model->initial.component[GOUGH_YAW] = 0.01;
    model->initial.given[GOUGH_SURGE] = model->initial.given[GOUGH_HEAVE] = true;
    model->initial.given[GOUGH_YAW] = true;
    const gough_summary s = sum(model, 0.01, 0.01, true);
    ck_assert(fabs(s.position_deviation - 0.005) <= 1e-5);
    ck_assert(fabs(s.angle_deviation - 0.01) <= 1e-5);
    ck_assert(s.position_deviation >= 0.005 - 1e-15);
    free(model);
}
END_TEST

int main(void) {
    return SUITE_RUN("summary", 30, energy_is_the_load_s_and_of_fourth_order,
                     rest_is_summed_exactly, swing_is_the_angle_of_each_end,
                     peaks_lie_between_any_two_looks, no_peak_beyond_a_jump,
                     nothing_is_interpolated_across_a_corner,
                     a_force_may_jump_between_two_looks_of_one_time, deviation_is_what_was_put_in);
}
