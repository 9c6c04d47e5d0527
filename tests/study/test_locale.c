/* A locale with a decimal comma changes nothing: neither what is read nor what is said. */
#include <math.h>
#include <stdio.h>
#include <string.h>

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

int main(void) {
    make_comma_locale();
    const int status = SUITE_RUN("study/locale", 60, numbers_and_formulas_are_read_alike,
                                 samples_are_read_alike, messages_are_the_same);
    forget_comma_locale();
    return status;
}
