/* Ends: limits, singular poses, legs of no length, formulas not finite; located where closed forms say; rows before are kept. */
#include <stdio.h>

#include "gough/dynamics.h"
#include "support/machines.h"
#include "support/suite.h"

typedef struct {
    size_t rows;
    double last_time, last[GOUGH_COLUMNS];
    int stop_after;
    int not_finite;
} taken;

static int take(void *context, const gough_row *row) {
    taken *t = context;

    t->rows++;
    t->last_time = row->value[GOUGH_T];
    memcpy(t->last, row->value, sizeof t->last);
    for (int c = 0; c <= GOUGH_CONDITION; c++) t->not_finite |= !isfinite(row->value[c]);
    return t->stop_after && (int)t->rows == t->stop_after;
}

typedef struct {
    gough_crossing list[64];
    int count;
} crossings;

static void note(void *context, const gough_crossing *crossing) {
    crossings *c = context;

    ck_assert_int_lt(c->count, 64);
    c->list[c->count++] = *crossing;
}

/* the paper's machine, heave by a formula, held by strong feedback */
static gough_model *heaving(const char *heave) {
    gough_model *model = calloc(1, sizeof *model);

    paper_machine(&model->machine);
    model->control.feedforward = true;
    set_gains(model, 50, 5);
    set_formula(&model->motion.formula[GOUGH_HEAVE], heave);
    return model;
}

static gough_simulation tight(double duration) {
    gough_simulation s = gough_simulation_default();

    s.duration = duration;
    s.tolerance = 1e-13;
    return s;
}

/* l² = h² + d², so a length limit is met where 0.2 sin t = √(limit² − d²) − 1 */
START_TEST(leg_too_long_is_located) {
    gough_model *model = heaving("0.2*sin(t)");
    const double l0 = model->machine.home_length[0], d2 = l0 * l0 - 1;
    const double limit = sqrt(1.1 * 1.1 + d2), when = asin(0.5);
    gough_simulation s = tight(20);
    crossings found = {.count = 0};
    taken rows = {0};
    gough_error error = {0};
    gough_end end;

    model->machine.platform.length_max = limit;
    ck_assert_int_eq(gough_simulate(model, &s, take, &rows, &end, &error), GOUGH_ERROR_NUMERICAL);
    ck_assert_int_eq(end.cause, GOUGH_END_LEG_LONG);
    ck_assert_int_ge(end.leg, 1);
    ck_assert(fabs(end.time - when) <= 1e-9);
    ck_assert(strstr(end.message, "longer") != NULL);
    ck_assert_int_eq((int)rows.rows, 1 + (int)floor(when / 0.05));
    ck_assert_int_eq(rows.not_finite, 0);

    /* along the program: every crossing of every leg, entered and left */
    rows = (taken){0};
    ck_assert_int_eq(gough_forces(model, &s, take, &rows, note, &found, &end, &error),
                     GOUGH_ERROR_NUMERICAL);
    ck_assert_int_eq((int)rows.rows, 401);
    ck_assert(fabs(end.time - when) <= 1e-9);
    ck_assert_int_eq(found.count, 6 * 4); /* up in each of the periods begun by t = 20 */
    for (int i = 0; i < found.count; i++) {
        const double turns = floor(found.list[i].enter / (2 * pi));
        ck_assert_int_eq(found.list[i].cause, GOUGH_END_LEG_LONG);
        ck_assert(fabs(found.list[i].enter - turns * 2 * pi - when) <= 1e-9);
        if (found.list[i].leave <= 20) {
            ck_assert(fabs(found.list[i].leave - turns * 2 * pi - (pi - when)) <= 1e-9);
            ck_assert(fabs(found.list[i].worst - sqrt(1.2 * 1.2 + d2)) <= 1e-5);
        } else {
            ck_assert(isinf(found.list[i].leave));
        }
    }
    free(model);
}
END_TEST

/* l̇ = h ḣ/l and F = M(z̈ + g) l/(6h) along 0.2 sin t, beginning with the speed at its greatest */
START_TEST(speed_and_force_limits_are_found) {
    gough_model *model = heaving("0.2*sin(t)*ramp(t, 1)");
    gough_simulation s = tight(10);
    taken rows = {0};
    crossings found = {.count = 0};
    gough_error error = {0};
    gough_end end;
    double peak = 0, peak_force = 0;

    ck_assert_int_eq(gough_forces(model, &s, take, &rows, NULL, NULL, &end, &error), GOUGH_OK);
    for (double t = 0; t < 10; t += 1e-3) {
        gough_acceleration a;
        gough_state state;
        double rate[6], force[6], condition;
        gough_program(&model->machine, &model->motion, t, &state, &a);
        gough_leg_kinematics(&model->machine, &state, NULL, NULL, rate, NULL);
        gough_inverse_dynamics(&model->machine, &state, &a, NULL, force, &condition);
        peak = fmax(peak, fabs(rate[0]));
        peak_force = fmax(peak_force, fabs(force[0]));
    }
    model->machine.platform.speed_max = peak * 0.999;
    ck_assert_int_eq(gough_forces(model, &s, take, &rows, note, &found, &end, &error),
                     GOUGH_ERROR_NUMERICAL);
    ck_assert_int_eq(end.cause, GOUGH_END_LEG_SPEED);
    ck_assert_int_gt(found.count, 5);
    for (int i = 0; i < found.count; i++) {
        ck_assert(fabs(fabs(found.list[i].worst) - peak) <= 1e-4 * peak);
    }
    model->machine.platform.speed_max = INFINITY;
    model->machine.platform.force_max = peak_force * 0.99;
    ck_assert_int_eq(gough_simulate(model, &s, take, &rows, &end, &error), GOUGH_ERROR_NUMERICAL);
    ck_assert_int_eq(end.cause, GOUGH_END_LEG_FORCE);
    ck_assert(fabs(fabs(rows.last[GOUGH_F]) / model->machine.platform.force_max - 1) < 0.05);
    free(model);
}
END_TEST

START_TEST(limit_left_at_the_beginning) {
    gough_model *model = heaving("0.2*sin(t)");
    gough_simulation s = tight(1);
    taken rows = {0};
    gough_error error = {0};
    gough_end end;

    model->machine.platform.length_min = model->machine.home_length[0] * 1.01;
    ck_assert_int_eq(gough_simulate(model, &s, take, &rows, &end, &error), GOUGH_ERROR_NUMERICAL);
    ck_assert_int_eq(end.cause, GOUGH_END_LEG_SHORT);
    ck_assert(end.time <= 0);
    ck_assert_int_eq((int)rows.rows, 1);
    free(model);
}
END_TEST

/* the top goes down through the plane of the base, where det J changes sign, at h = 0 */
START_TEST(singular_pose_is_located) {
    gough_model *model = heaving("-1.5*ramp(t, 10)");
    gough_simulation s = tight(10);
    taken rows = {0};
    gough_error error = {0};
    gough_end end;
    double low = 0, high = 1;

    /* ramp: 10 s³ − 15 s⁴ + 6 s⁵ = 2/3 */
    for (int i = 0; i < 60; i++) {
        const double x = (low + high) / 2, v = x * x * x * (10 + x * (6 * x - 15));
        if (v < 1 / 1.5) {
            low = x;
        } else {
            high = x;
        }
    }
    ck_assert_int_eq(gough_forces(model, &s, take, &rows, NULL, NULL, &end, &error),
                     GOUGH_ERROR_NUMERICAL);
    ck_assert_int_eq(end.cause, GOUGH_END_SINGULAR);
    /* within 1e-8 of the plane the condition is over 1e8, which counts as singular: 4e-8 before */
    ck_assert_msg(fabs(end.time - 10 * low) <= 1e-7, "%.12g, not %.12g", end.time, 10 * low);
    ck_assert(rows.last_time < end.time && rows.last_time > end.time - 0.1);
    ck_assert_int_eq(rows.not_finite, 0);

    rows = (taken){0};
    ck_assert_int_eq(gough_simulate(model, &s, take, &rows, &end, &error), GOUGH_ERROR_NUMERICAL);
    ck_assert_int_eq(end.cause, GOUGH_END_SINGULAR);
    ck_assert(fabs(end.time - 10 * low) <= 0.05);
    ck_assert_int_eq(rows.not_finite, 0);
    free(model);
}
END_TEST

/* yaw comes to rest at 90 degrees, which is singular: nearly so from a time that has nothing to do with the rows */
START_TEST(nearly_singular_pose_is_located) {
    gough_model *model = heaving("0");
    gough_simulation s = tight(20);
    gough_error error = {0};
    gough_end end;
    double when[2];

    set_formula(&model->motion.formula[GOUGH_YAW], "90*ramp(t, 10)");
    model->motion.angle_unit = acos(-1) / 180;
    for (int i = 0; i < 2; i++) {
        taken rows = {0};
        s.output_step = i == 0 ? 0.05 : 0.03;
        ck_assert_int_eq(gough_forces(model, &s, take, &rows, NULL, NULL, &end, &error),
                         GOUGH_ERROR_NUMERICAL);
        ck_assert_int_eq(end.cause, GOUGH_END_SINGULAR);
        ck_assert(rows.last_time < end.time && rows.last[GOUGH_CONDITION] <= 1e8);
        when[i] = end.time;
    }
    ck_assert_msg(fabs(when[1] - when[0]) <= 1e-8, "%.12g and %.12g", when[0], when[1]);
    free(model);
}
END_TEST

/* open loop without any force: the platform falls, z = 1 − t²/2, through h = 0 at √2 */
START_TEST(falling_through_a_singular_pose) {
    static const gough_method methods[] = {GOUGH_DOP853, GOUGH_RK4, GOUGH_RATTLE4};
    gough_model *model = heaving("0");

    model->control.feedforward = false;
    set_gains(model, 0, 0);
    for (int i = 0; i < 3; i++) {
        gough_simulation s = tight(3);
        taken rows = {0};
        gough_error error = {0};
        gough_end end;

        s.method = methods[i];
        s.step = i ? 0.01 : 0;
        ck_assert_int_eq(gough_simulate(model, &s, take, &rows, &end, &error),
                         GOUGH_ERROR_NUMERICAL);
        ck_assert_int_eq(end.cause, GOUGH_END_SINGULAR);
        ck_assert_msg(fabs(end.time - sqrt(2)) <= 1e-9, "%.15g", end.time);
        ck_assert_int_eq((int)rows.rows, 29);
        ck_assert(fabs(rows.last[GOUGH_Z] - (1 - 1.4 * 1.4 / 2)) <= 1e-12);
    }
    free(model);
}
END_TEST

/* a program that brings one top joint onto its base joint */
START_TEST(leg_of_no_length_is_named) {
    gough_model *model = heaving("0");
    const double angles[3] = {-0.792189, -0.65395, 0.211184}; /* no singular pose on the way */
    gough_simulation s = tight(10);
    taken rows = {0};
    gough_error error = {0};
    gough_end end;
    double R[3][3];
    char text[64];

    gough_rotation_from_angles(angles, R);
    for (int c = 0; c < 3; c++) {
        double target = model->machine.platform.base[1][c] - (c == 2 ? 1 : 0);
        for (int k = 0; k < 3; k++) target -= R[c][k] * model->machine.platform.top[1][k];
        snprintf(text, sizeof text, "%.17g*ramp(t, 8)", target);
        set_formula(&model->motion.formula[c], text);
        snprintf(text, sizeof text, "%.17g*ramp(t, 8)", angles[c]);
        set_formula(&model->motion.formula[GOUGH_ROLL + c], text);
    }
    ck_assert_int_eq(gough_forces(model, &s, take, &rows, NULL, NULL, &end, &error),
                     GOUGH_ERROR_NUMERICAL);
    ck_assert_msg(end.cause == GOUGH_END_LEG_NO_LENGTH, "%s", end.message);
    ck_assert_int_eq(end.leg, 2);
    ck_assert(fabs(end.time - 8) <= 0.2);
    ck_assert_int_eq(rows.not_finite, 0);
    free(model);
}
END_TEST

START_TEST(formula_not_finite_is_named_with_its_time) {
    gough_model *model = heaving("0.001*(5 - t)^2.5");
    gough_simulation s = tight(10);
    taken rows = {0};
    gough_error error = {0};
    gough_end end;

    ck_assert_int_eq(gough_forces(model, &s, take, &rows, NULL, NULL, &end, &error),
                     GOUGH_ERROR_INPUT);
    ck_assert_int_eq(end.cause, GOUGH_END_NOT_FINITE);
    ck_assert(fabs(end.time - 5) <= 0.05);
    ck_assert(strstr(error.message, "motion.heave") != NULL);
    ck_assert_int_eq(gough_simulate(model, &s, take, &rows, &end, &error), GOUGH_ERROR_INPUT);
    ck_assert(fabs(end.time - 5) <= 0.05);
    ck_assert(strstr(error.message, "motion.heave") != NULL);

    /* the rate grows beyond all bounds before the root has no value: no step comes near */
    set_formula(&model->motion.formula[GOUGH_HEAVE], "0.1*sqrt(1 - t)");
    ck_assert_int_eq(gough_simulate(model, &s, take, &rows, &end, &error), GOUGH_ERROR_INPUT);
    ck_assert_int_eq(end.cause, GOUGH_END_NOT_FINITE);
    ck_assert(fabs(end.time - 1) <= 1e-5);
    ck_assert(strstr(error.message, "motion.heave") != NULL);

    set_formula(&model->motion.formula[GOUGH_HEAVE], "0.1*sin(t)");
    set_formula(&model->disturbance.moment[1], "log(t - 3)");
    ck_assert_int_eq(gough_simulate(model, &s, take, &rows, &end, &error), GOUGH_ERROR_INPUT);
    ck_assert(strstr(error.message, "disturbance.moment") != NULL);
    ck_assert(end.time <= 0);
    free(model);
}
END_TEST

START_TEST(sink_stops_a_run) {
    gough_model *model = heaving("0.1*sin(t)");
    gough_simulation s = tight(10);
    taken rows = {.stop_after = 7};
    gough_error error = {0};
    gough_end end;

    ck_assert_int_eq(gough_simulate(model, &s, take, &rows, &end, &error), GOUGH_ERROR_NUMERICAL);
    ck_assert_int_eq(end.cause, GOUGH_END_STOPPED);
    ck_assert_int_eq((int)rows.rows, 7);
    free(model);
}
END_TEST

/* rows at k · output_step up to the duration, also where the division leaves a remainder */
START_TEST(rows_stand_at_their_times) {
    static const struct {
        double duration, step;
        int rows;
    } cases[] = {{20, 0.05, 401}, {1, 0.1, 11}, {1, 0.3, 4}, {0.7, 0.1, 8}, {0.05, 0.1, 1}};
    gough_model *model = heaving("0.1*sin(t)");

    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        for (int fixed = 0; fixed < 2; fixed++) {
            gough_simulation s = tight(cases[i].duration);
            taken rows = {0};
            gough_error error = {0};
            gough_end end;
            s.output_step = cases[i].step;
            if (fixed) s.step = cases[i].step / 10;
            ck_assert_int_eq(gough_simulate(model, &s, take, &rows, &end, &error), GOUGH_OK);
            ck_assert_int_eq((int)rows.rows, cases[i].rows);
            ck_assert(!(fabs(rows.last_time - (cases[i].rows - 1) * cases[i].step) > 0));
            ck_assert(!(fabs(end.time - cases[i].duration) > 0));
        }
    }
    free(model);
}
END_TEST

/* a body without height: every method, one answer */
START_TEST(flat_body_runs_with_every_method) {
    gough_model *model = heaving("0.1*sin(t)");
    const double gravity[3] = {0, 0, -1};
    gough_platform platform = model->machine.platform;
    gough_load load = {.mass = 1, .inertia = {{0.05, 0, 0}, {0, 0.06, 0}, {0, 0, 0.11}}};
    double z[GOUGH_METHODS], yaw[GOUGH_METHODS];

    ck_assert_int_eq(gough_machine_init(&model->machine, &platform, &load, gravity, NULL),
                     GOUGH_OK);
    ck_assert(!(model->machine.second_moments[2] > 0));
    model->initial.component[GOUGH_YAW] = 0.2;
    model->initial.given[GOUGH_YAW] = true;
    model->initial.angular_velocity[1] = 0.5;
    model->initial.angular_velocity_given = true;
    for (int m = 0; m < GOUGH_METHODS; m++) {
        gough_simulation s = tight(2);
        taken rows = {0};
        gough_error error = {0};
        gough_end end;
        s.method = (gough_method)m;
        s.step = m == GOUGH_DOP853 ? 0 : m == GOUGH_RATTLE2 ? 0.0005 : 0.005;
        ck_assert_msg(gough_simulate(model, &s, take, &rows, &end, &error) == GOUGH_OK, "%s: %s",
                      gough_method_name(m), error.message);
        z[m] = rows.last[GOUGH_Z];
        yaw[m] = rows.last[GOUGH_YAW_ANGLE];
        ck_assert_msg(fabs(z[m] - z[0]) <= 1e-5 && fabs(yaw[m] - yaw[0]) <= 1e-5, "%s: %g %g",
                      gough_method_name(m), z[m] - z[0], yaw[m] - yaw[0]);
    }
    free(model);
}
END_TEST

/* a load that turns by more than a rattle step can hold */
START_TEST(step_too_long_is_said) {
    gough_model *model = heaving("0");
    gough_simulation s = tight(2);
    taken rows = {0};
    gough_error error = {0};
    gough_end end;

    s.method = GOUGH_RATTLE2;
    s.step = s.output_step = 1;
    model->initial.angular_velocity[0] = 40;
    model->initial.angular_velocity[1] = 30;
    model->initial.angular_velocity_given = true;
    ck_assert_int_eq(gough_simulate(model, &s, take, &rows, &end, &error), GOUGH_ERROR_NUMERICAL);
    ck_assert_int_eq(end.cause, GOUGH_END_NO_CONVERGENCE);
    ck_assert(strstr(error.message, "shorter simulation.step") != NULL);
    free(model);
}
END_TEST

START_TEST(options_are_checked) {
    static const double time[2] = {0, 5}, value[12];
    double curvature[12] = {0};
    gough_model *model = heaving("0.1*sin(t)");
    gough_simulation good = tight(10), s;
    gough_error error = {0};

    ck_assert_int_eq(gough_simulation_check(model, &good, &error), GOUGH_OK);
#define REFUSES(change, word)                                                                      \
    do {                                                                                           \
        s = good;                                                                                  \
        change;                                                                                    \
        ck_assert_int_eq(gough_simulation_check(model, &s, &error), GOUGH_ERROR_INPUT);            \
        ck_assert_msg(strstr(error.message, word) != NULL, "%s", error.message);                   \
    } while (0)
    REFUSES(s.duration = 0, "duration");
    REFUSES(s.duration = NAN, "duration");
    REFUSES(s.duration = INFINITY, "duration");
    REFUSES(s.output_step = -1, "output_step");
    REFUSES(s.output_step = 1e-9, "output_step");
    REFUSES(s.tolerance = 0, "tolerance");
    REFUSES(s.tolerance = 1e-16, "tolerance");
    REFUSES(s.tolerance = NAN, "tolerance");
    REFUSES(s.tolerance = 0.2, "between 1e-15 and 0.1 in double precision");
    REFUSES((s.precision = GOUGH_QUADRUPLE, s.tolerance = 1e-31), "1e-30 and 0.1 in quadruple");
    REFUSES(s.max_step = -1, "max_step");
    REFUSES(s.max_step = INFINITY, "max_step");
    REFUSES(s.method = GOUGH_RK4, "step");
    REFUSES((s.method = GOUGH_RK4, s.step = 0.03), "divide");
    REFUSES((s.method = GOUGH_RK4, s.step = 0.1), "divide");
    REFUSES(s.step = NAN, "");
    REFUSES(s.step = 1e-300, "steps");
    REFUSES((s.method = GOUGH_RATTLE2, s.step = 1e-12), "steps");
    REFUSES((s.method = GOUGH_RATTLE4, s.step = 0.01, s.constraints = GOUGH_BAUMGARTE), "rattle4");
    REFUSES((s.constraints = GOUGH_BAUMGARTE, s.baumgarte[1] = -1), "baumgarte");
    REFUSES((s.constraints = GOUGH_BAUMGARTE, s.baumgarte[0] = INFINITY), "baumgarte");
    REFUSES(s.method = (gough_method)77, "method");
    s = good;
    s.tolerance = 1e-25;
    s.precision = GOUGH_QUADRUPLE;
    ck_assert_int_eq(gough_simulation_check(model, &s, &error), GOUGH_OK);
    model->motion.kind = GOUGH_MOTION_SAMPLES;
    model->motion.samples =
        (gough_samples){.count = 2, .time = time, .value = value, .curvature = curvature};
    REFUSES(s.duration = 6, "beyond");
    free(model);
}
END_TEST

int main(void) {
    return SUITE_RUN("ends", 60, leg_too_long_is_located, speed_and_force_limits_are_found,
                     limit_left_at_the_beginning, singular_pose_is_located,
                     nearly_singular_pose_is_located, falling_through_a_singular_pose,
                     leg_of_no_length_is_named, formula_not_finite_is_named_with_its_time,
                     sink_stops_a_run, rows_stand_at_their_times, flat_body_runs_with_every_method,
                     step_too_long_is_said, options_are_checked);
}
