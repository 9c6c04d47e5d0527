/* A locale with a decimal comma changes nothing: neither what is read nor what is said. */
#define _XOPEN_SOURCE 700
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gough/sweep.h"
#include "study/helpers.h"
#include "support/suite.h"

static const char *const numbers = "gravity: 1.5\n"
                                   "motion: {heave: 0.25*t + 1.5e-1}\n"
                                   "simulation: {duration: 2.5, output_step: 0.5}\n";

START_TEST(numbers_and_formulas_are_read_alike) {
    use_comma_locale();
    reading made = expect_good(numbers, (const char *const[]){"platform.height=1.375", NULL});
    double jet[3];
    gough_formula_evaluate(&made.study->model->motion.formula[GOUGH_HEAVE], 1, jet);
    ck_assert(fabs(jet[0] - 0.4) <= 1e-15);
    ck_assert(fabs(made.study->model->machine.gravity_magnitude - 1.5) <= 0);
    ck_assert(fabs(made.study->model->machine.platform.height - 1.375) <= 0);
    ck_assert(fabs(made.study->simulation.duration - 2.5) <= 0);
    ck_assert(fabs(made.study->simulation.output_step - 0.5) <= 0);
    reading_free(&made);
    use_plain_locale();
}
END_TEST

START_TEST(samples_are_read_alike) {
    static const char csv[] = "t,heave\n0,0.5\n0.25,0.75\n1.5,1e-1\n";
    char text[800], *path = write_file("motion.csv", csv, sizeof csv - 1);
    use_comma_locale();
    snprintf(text, sizeof text, "motion: {samples: '%s'}\nsimulation: {duration: 1.5}\n", path);
    reading made = expect_good(text, NULL);
    const gough_samples *samples = &made.study->model->motion.samples;
    ck_assert(fabs(samples->time[1] - 0.25) <= 0);
    ck_assert(fabs(samples->value[2 * GOUGH_COMPONENTS + GOUGH_HEAVE] - 0.1) <= 0);
    reading_free(&made);
    use_plain_locale();
    forget_file(path);
}
END_TEST

START_TEST(messages_are_the_same) {
    static const char *const wrong[] = {
        "gravity: 1,5\n", "simulation: {method: rk4, step: 0.03}\n",
        "simulation: {duration: 1e9, output_step: 0.01}\n", "motion: {heave: 0.5*x}\n",
        "motion: {moves: [{start: 0.5, duration: 1.5, yaw: 1}, {start: 1.5}]}"};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        reading plain = read_more(wrong[i], NULL);
        use_comma_locale();
        reading comma = read_more(wrong[i], NULL);
        use_plain_locale();
        ck_assert_int_eq(plain.status, GOUGH_ERROR_INPUT);
        ck_assert_int_eq(comma.status, GOUGH_ERROR_INPUT);
        ck_assert_str_eq(comma.messages, plain.messages);
        reading_free(&plain);
        reading_free(&comma);
    }
}
END_TEST

START_TEST(messages_of_sweeps_are_the_same) {
    static const char machine[] =
        "platform: {base: {radius: 1, half_angle: 10}, top: {radius: 0.6, half_angle: 15},"
        " height: 1}\nload: {mass: 1, inertia: [0.1, 0.1, 0.1]}\n";
    static const char *const wrong[] = {
        "load.mass: {from: 1, to: 2, steps: 16000}, control.damping: {from: 1, to: 2, steps: "
        "16000}",
        "load.mass: [1.5, -2.5]", "load.mass: {normal: [1.5, -0.25]}", "load.mass: [-0.25, 1.5]",
        "simulation.tolerance: [1e-9, -1.5]"};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        char text[800], *said[2] = {NULL, NULL};
        snprintf(text, sizeof text, "%ssweep: {keys: {%s}}\n", machine, wrong[i]);
        for (int comma = 0; comma < 2; comma++) {
            gough_sweep *sweep = NULL;
            if (comma) use_comma_locale();
            const gough_status status =
                gough_sweep_parse("study.yaml", text, strlen(text), NULL, 0, &sweep, &said[comma]);
            gough_error error = {.message = ""};
            if (status == GOUGH_OK) { /* the sentence comes with the run */
                gough_sweep_maker *maker = gough_sweep_maker_new(sweep);
                const gough_study *study;
                for (size_t run = 1; run <= gough_sweep_runs(sweep) && !*error.message; run++)
                    (void)gough_sweep_make(maker, run, &study, &error);
                gough_sweep_maker_free(maker);
                gough_sweep_free(sweep);
                said[comma] = strdup(error.message);
            }
            use_plain_locale();
            ck_assert_ptr_nonnull(said[comma]);
            ck_assert_uint_gt(strlen(said[comma]), 10);
        }
        ck_assert_str_eq(said[1], said[0]);
        if (i == 0) ck_assert_ptr_nonnull(strstr(said[0], "2.56e+08"));
        free(said[0]);
        free(said[1]);
    }
}
END_TEST

int main(void) {
    make_comma_locale();
    const int status =
        SUITE_RUN("study/locale", 60, numbers_and_formulas_are_read_alike, samples_are_read_alike,
                  messages_are_the_same, messages_of_sweeps_are_the_same);
    forget_comma_locale();
    return status;
}
