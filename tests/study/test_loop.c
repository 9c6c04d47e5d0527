/* Drives and sampled controllers in the study file: what is read where, in which units, and every mistake at its place. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "study/helpers.h"
#include "support/suite.h"

static const char *const lag = "actuators: {kind: lag, time_constant: 0.005}\n";
static const char *const sampled =
    "control:\n  stiffness: 50\n  sampling: {period: 0.01, velocity: difference}\n";

/* Expects exactly one error from these settings, with this in its sentence. */
static void expect_one(const char *more, const char *const settings[], const char *part) {
    reading made = read_more(more, settings);
    ck_assert_msg(made.status == GOUGH_ERROR_INPUT, "accepted: %s", settings[0]);
    ck_assert_msg(strstr(made.messages, part), "expected %s\nfound %s", part, made.messages);
    ck_assert_int_eq(occurrences(made.messages, ": error: "), 1);
    reading_free(&made);
}

static gough_model *model_of(const reading *made) { return made->study->model; }

START_TEST(one_drive_is_for_all_legs_and_six_are_each_its_own) {
    reading made = expect_good("actuators: {kind: lag, time_constant: [1, 2, 3, 4, 5, 6], "
                               "max_force: [-3, 5], max_rate: 7}\n",
                               NULL);
    const gough_actuators *a = &model_of(&made)->machine.platform.actuators;
    for (int v = 0; v < GOUGH_LEGS; v++) {
        ck_assert(a->time_constant[v] == v + 1 && a->max_rate[v] == 7 && a->frequency[v] == 0);
        ck_assert(a->max_force[v][0] == -3 && a->max_force[v][1] == 5);
    }
    reading_free(&made);
    made = expect_good("actuators:\n"
                       "  - {kind: lag, frequency: 3, damping_ratio: 0.1, max_force: 2}\n"
                       "  - {damping_ratio: 0.2, kind: lag, frequency: 4}\n"
                       "  - {kind: lag, frequency: 5, damping_ratio: 0.3, max_force: [0, 9]}\n"
                       "  - {kind: lag, frequency: 6, damping_ratio: 0.4}\n"
                       "  - {kind: lag, frequency: 7, damping_ratio: 0.5}\n"
                       "  - {kind: lag, frequency: 8, damping_ratio: 0.6, max_force: 1}\n",
                       NULL);
    a = &model_of(&made)->machine.platform.actuators;
    ck_assert_int_eq(a->kind, GOUGH_ACTUATOR_LAG);
    for (int v = 0; v < GOUGH_LEGS; v++) {
        ck_assert(a->frequency[v] == v + 3);
        ck_assert(fabs(a->damping_ratio[v] - 0.1 * (v + 1)) < 1e-15);
    }
    const double limits[6][2] = {{-2, 2}, {0, 0}, {0, 9}, {0, 0}, {0, 0}, {-1, 1}};
    ck_assert(memcmp(a->max_force, limits, sizeof limits) == 0);
    reading_free(&made);
    made = expect_good("actuators: {max_force: [1, 2, [-4, 3], 4, 5, 6]}\n", NULL);
    a = &model_of(&made)->machine.platform.actuators;
    ck_assert(a->max_force[0][0] == -1 && a->max_force[2][0] == -4 && a->max_force[2][1] == 3);
    ck_assert(a->max_force[5][1] == 6 && a->kind == GOUGH_ACTUATOR_IDEAL);
    reading_free(&made);
}
END_TEST

/* rows of the matrix of a study: number 10 v + w in row v, column w, from 1 */
static const char *const matrix = "[[11, 12, 13, 14, 15, 16], [21, 22, 23, 24, 25, 26], "
                                  "[31, 32, 33, 34, 35, 36], [41, 42, 43, 44, 45, 46], "
                                  "[51, 52, 53, 54, 55, 56], [61, 62, 63, 64, 65, -66]]";

START_TEST(a_matrix_of_gains_has_a_diagonal_and_a_rest) {
    char text[600];
    snprintf(text, sizeof text, "control: {stiffness: %s, damping: 2}\n", matrix);
    reading made = expect_good(text, NULL);
    const gough_control *c = &model_of(&made)->control;
    ck_assert(c->coupled);
    for (int v = 0; v < GOUGH_LEGS; v++) {
        ck_assert(c->damping[v] == 2);
        ck_assert(c->stiffness[v] == (v < 5 ? 11 * (v + 1) : -66));
        for (int w = 0; w < GOUGH_LEGS; w++) {
            ck_assert(c->cross_stiffness[v][w] == (v == w ? 0 : 10 * (v + 1) + w + 1));
            ck_assert(c->cross_damping[v][w] == 0);
        }
    }
    reading_free(&made);
    snprintf(text, sizeof text, "control: {stiffness: [1, 2, 3, 4, 5, 6], damping: %s}\n", matrix);
    made = expect_good(text, NULL);
    c = &model_of(&made)->control;
    ck_assert(c->coupled && c->stiffness[5] == 6 && c->damping[1] == 22);
    ck_assert(c->cross_damping[4][0] == 51 && c->cross_stiffness[4][0] == 0);
    reading_free(&made);
}
END_TEST

START_TEST(a_number_set_on_a_matrix_is_for_all_legs_alone) {
    char text[600];
    snprintf(text, sizeof text, "control: {stiffness: %s}\n", matrix);
    reading made = expect_good(text, SETTINGS("control.stiffness=50"));
    const gough_control *c = &model_of(&made)->control;
    ck_assert(!c->coupled);
    for (int v = 0; v < GOUGH_LEGS; v++) {
        ck_assert(c->stiffness[v] == 50);
        for (int w = 0; w < GOUGH_LEGS; w++) ck_assert(c->cross_stiffness[v][w] == 0);
    }
    reading_free(&made);
    made = expect_good(text, SETTINGS("control.stiffness.2.3=-7"));
    ck_assert(model_of(&made)->control.cross_stiffness[1][2] == -7);
    reading_free(&made);
}
END_TEST

START_TEST(numbers_are_in_the_units_of_the_study) {
    static const char text[] =
        "units: {length: mm, force: kN, time: ms}\n"
        "platform: {base: {radius: 1000, half_angle: 15}, top: {radius: 600, half_angle: 15}, "
        "height: 1200}\n"
        "load: {mass: 1, inertia: [8e4, 8e4, 15e4]}\n"
        "actuators: {kind: lag, time_constant: 5, max_rate: 2, max_force: 3}\n"
        "control:\n"
        "  integral: 4\n"
        "  tracking_time: 60\n"
        "  sampling: {period: 2, delay: 1, jitter: 0.5, velocity: difference, cutoff: 0.1, "
        "resolution: 0.001, noise: 0.002, preview: 3, seed: 9, run: 8}\n";
    reading made = read_bytes(text, sizeof text - 1, NULL);
    ck_assert_msg(made.status == GOUGH_OK, "%s", made.messages);
    const gough_actuators *a = &model_of(&made)->machine.platform.actuators;
    const gough_control *c = &model_of(&made)->control;
    const gough_sampling *s = &c->sampling;
    const double found[] = {a->time_constant[0], a->max_rate[1], a->max_force[2][0], c->integral[3],
                            c->tracking_time,    s->period,      s->delay,           s->jitter,
                            s->cutoff,           s->resolution,  s->noise,           s->preview};
    const double wanted[] = {0.005, 2e6,    -3e3, 4e9,  0.06, 0.002,
                             0.001, 0.0005, 100,  1e-6, 2e-6, 0.003};
    for (size_t i = 0; i < sizeof found / sizeof found[0]; i++)
        ck_assert_msg(fabs(found[i] / wanted[i] - 1) < 1e-14, "%zu: %.17g", i, found[i]);
    ck_assert(s->velocity == GOUGH_VELOCITY_DIFFERENCE && s->seed == 9 && s->run == 8);
    ck_assert(made.study->sampling_run_given && !made.study->noise_run_given);
    reading_free(&made);
}
END_TEST

START_TEST(commands_are_columns_where_there_is_a_loop_to_show) {
    static const struct {
        const char *more;
        bool commands;
    } all[] = {{"control: {stiffness: 5}\n", false},
               {"actuators: {}\n", true},
               {"control: {sampling: {period: 0.1}}\n", true},
               {"control: {sampling: {period: 0.1}}\nsimulation: {duration: 3}\n", true}};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        reading made = expect_good(all[i].more, NULL);
        ck_assert(made.study->simulation.commands == all[i].commands);
        ck_assert(!made.study->simulation.actuators);
        reading_free(&made);
    }
}
END_TEST

START_TEST(drives_that_cannot_be_are_errors) {
    expect_one(
        lag, SETTINGS("actuators.time_constant="),
        "study.yaml:8:13: error: the lag of leg 1 has neither a time_constant nor a frequency");
    expect_one(lag, SETTINGS("actuators.kind=ideal"),
               "study.yaml:8:24: error: the drives are ideal, and actuators.time_constant is a "
               "number of a lag");
    expect_one(lag, SETTINGS("actuators.frequency=60"), "both a time_constant and a frequency");
    expect_one(lag, SETTINGS("actuators.damping_ratio=1"),
               "both a time_constant and a damping_ratio");
    expect_one("", SETTINGS("actuators={kind: lag, frequency: 60}"),
               "has a frequency but no damping_ratio");
    expect_one("", SETTINGS("actuators={kind: lag, damping_ratio: 60}"),
               "has a damping_ratio but no frequency");
    expect_one("",
               SETTINGS("actuators={kind: lag, frequency: 60, damping_ratio: 0.7, max_rate: 8}"),
               "max_rate limits lags of first order only");
    expect_one("", SETTINGS("actuators=[{}, {}, {}, {}, {}]"), "found a list of 5");
    expect_one("", SETTINGS("actuators=[{}, {}, {}, {}, {}, 7]"),
               "`actuators.6` must be a mapping");
    expect_one("", SETTINGS("actuators=[{}, {}, {kind: lag, time_constant: 1}, {}, {}, {}]"),
               "that of leg 1 is `ideal` by default and that of leg 3 is `lag`");
    expect_one("",
               SETTINGS("actuators=[{kind: lag, time_constant: 1}, {}, {kind: lag, time_constant: "
                        "1}, {}, {}, {}]"),
               "that of leg 1 is `lag` and that of leg 2 is `ideal` by default");
    expect_one("actuators:\n"
               "  - {kind: lag, time_constant: 1}\n"
               "  - {kind: lag, frequency: 1, damping_ratio: 1}\n"
               "  - {kind: lag, time_constant: 1}\n"
               "  - {kind: lag, time_constant: 1}\n"
               "  - {kind: lag, time_constant: 1}\n"
               "  - {kind: lag, time_constant: 1}\n",
               SETTINGS("title=Two orders"),
               "study.yaml:8:1: error: the lag of leg 2 is of second order, but that of leg 1 is "
               "of first order");
    expect_one("", SETTINGS("actuators=[{}, {max_force: [1, 2, 3, 4, 5, 6]}, {}, {}, {}, {}]"),
               "`actuators.2.max_force` must be a number or a list of two numbers, found a list "
               "of 6");
    expect_one("", SETTINGS("actuators=[{}, {max_rate: [1, 2, 3, 4, 5, 6]}, {}, {}, {}, {}]"),
               "`actuators.2.max_rate` must be a number, found a list");
    expect_one("", SETTINGS("actuators.max_force=[3, 3]"), "the first below the second");
    expect_one("", SETTINGS("actuators.max_force=-3"),
               "means both signs and must be greater than 0, found `-3`");
    expect_one("", SETTINGS("actuators.max_force=[1, 2, 3, 4, [5, 3], 6]"),
               "`actuators.max_force.5` must be [least, greatest]");
    expect_one("", SETTINGS("actuators.max_force=[1, 2, 3, 4, 5]"), "found a list of 5");
    expect_one(lag, SETTINGS("actuators.time_constant=[1, 2, 3, 4, 5]"), "found a list of 5");
    expect_one("", SETTINGS("actuators.kind=electric"), "must be one of ideal, lag");
}
END_TEST

START_TEST(controllers_that_cannot_be_are_errors) {
    const char *const six = "[1, 2, 3, 4, 5, 6]";
    char text[300];
    expect_one(sampled, SETTINGS("control.sampling.period=0"), "must be greater than 0, found 0");
    expect_one(sampled, SETTINGS("control.sampling.period="),
               "study.yaml:10:3: error: `control.sampling.period` is missing");
    expect_one(sampled, SETTINGS("control.sampling.delay=1"),
               "control.sampling.delay, 1, must be shorter than 100 periods of 0.01");
    expect_one(sampled, SETTINGS("control.sampling.jitter=0.02"),
               "must not be longer than control.sampling.period, 0.01");
    expect_one(
        sampled, SETTINGS("control.sampling.jitter=0.005", "simulation.step=0.01"),
        "--set control.sampling.jitter: error: control.sampling.jitter needs steps that adapt");
    expect_one(sampled, SETTINGS("control.sampling.cutoff=50"),
               "50, is not below half the sampling rate, 50: leave it out");
    expect_one(sampled, SETTINGS("control.sampling.cutoff=5", "control.sampling.velocity=exact"),
               "set control.sampling.velocity to difference, or leave the cutoff out");
    expect_one(sampled, SETTINGS("control.integral=1", "control.tracking_time=0.005"),
               "control.tracking_time, 0.005, must not be shorter than control.sampling.period, "
               "0.01");
    expect_one(sampled, SETTINGS("simulation.step=0.025"),
               "simulation.step 0.025 does not divide control.sampling.period 0.01; the nearest "
               "that divides the sampling period, its delay and simulation.output_step is 0.01\n");
    expect_one(sampled, SETTINGS("simulation.step=0.01", "control.sampling.delay=0.004"),
               "simulation.step 0.01 does not divide control.sampling.delay 0.004; the nearest "
               "that divides the sampling period, its delay and simulation.output_step is 0.002\n");
    expect_one(sampled, SETTINGS("simulation.step=0.01", "control.sampling.delay=0.0031415926535"),
               "leave the step out, so that it adapts");
    snprintf(text, sizeof text, "control.stiffness=[%s, %s, [1, 2, 3, 4, 5], %s, %s, %s]", six, six,
             six, six, six);
    expect_one(sampled, SETTINGS(text),
               "`control.stiffness.3` must be a list of six numbers, found a list of 5");
    snprintf(text, sizeof text, "control.stiffness=[%s, %s, %s, %s, %s]", six, six, six, six, six);
    expect_one(sampled, SETTINGS(text), "6×6 matrix [[…], …], found a list of 5");
    snprintf(text, sizeof text, "control.stiffness=[%s, %s, 3, %s, %s, %s]", six, six, six, six,
             six);
    expect_one(sampled, SETTINGS(text), "`control.stiffness.3` must be a list of six numbers");
    expect_one(sampled, SETTINGS("control.damping=[1, 2, 3, 4, 5, -6]"),
               "`control.damping.6` must be 0 or greater");
    expect_one(sampled, SETTINGS("control.law=task"), "must be one of leg");
}
END_TEST

/* its steps are those of a body alone under forces linear in its rates; what is sampled is a constant force */
START_TEST(rattle_refuses_loops_that_its_steps_do_not_know) {
    static const char *const rattle = "simulation={method: rattle4, step: 0.01}";
    char text[600];
    expect_one(lag, SETTINGS(rattle),
               "the method rattle4 needs drives without lag; use dop853 or rk4 here");
    expect_one("control: {integral: 1}\n", SETTINGS(rattle),
               "needs a controller without integral, or a sampled one; use dop853 or rk4 here");
    snprintf(text, sizeof text, "control: {stiffness: %s}\n", matrix);
    expect_one(text, SETTINGS(rattle),
               "needs gains that are no matrices, or a sampled controller; use dop853 or rk4 here");
    expect_one("actuators: {max_force: 5}\ncontrol: {damping: 1}\n", SETTINGS(rattle),
               "needs drives without max_force, no damping, or a sampled controller; use dop853");
    reading made = expect_good(sampled, SETTINGS(rattle, "control.integral=1"));
    reading_free(&made);
}
END_TEST

/* 0.01 and 0.0025 are no whole multiples of each other in binary */
START_TEST(steps_that_divide_the_samples_are_fine) {
    static const char *const steps[] = {"simulation.step=0.01", "simulation.step=0.005",
                                        "simulation.step=0.0025"};
    for (int i = 0; i < 3; i++) {
        reading made =
            expect_good(sampled, SETTINGS(steps[i], i == 2 ? "control.sampling.delay=0.0175"
                                                           : "control.sampling.delay=0.03"));
        reading_free(&made);
    }
}
END_TEST

/* An error of control does not hide one of the simulation. */
START_TEST(errors_of_control_and_simulation_come_together) {
    reading made =
        read_more(sampled, SETTINGS("control.sampling.jitter=3", "simulation.output_step=0.03",
                                    "simulation.step=0.02"));
    ck_assert_int_eq(occurrences(made.messages, ": error: "), 2);
    ck_assert(strstr(made.messages, "must not be longer than control.sampling.period"));
    ck_assert(strstr(made.messages, "does not divide simulation.output_step"));
    reading_free(&made);
}
END_TEST

int main(void) {
    return SUITE_RUN(
        "study/loop", 30, one_drive_is_for_all_legs_and_six_are_each_its_own,
        a_matrix_of_gains_has_a_diagonal_and_a_rest, a_number_set_on_a_matrix_is_for_all_legs_alone,
        numbers_are_in_the_units_of_the_study, commands_are_columns_where_there_is_a_loop_to_show,
        drives_that_cannot_be_are_errors, controllers_that_cannot_be_are_errors,
        rattle_refuses_loops_that_its_steps_do_not_know, steps_that_divide_the_samples_are_fine,
        errors_of_control_and_simulation_come_together);
}
