/* Enclosures of formulas: every value and derivative at every time inside an interval lies within its bounds, and the bounds close
 * in on them as the interval shrinks. */
#define NUMBER_DOUBLE
#include "program/interval.h"

#include <stdio.h>

#include "support/machines.h"
#include "support/suite.h"

static const char *const texts[] = {
    "3",
    "t",
    "1 - 2*t",
    "sin(3*t)",
    "cos(t)^2",
    "tan(0.3*t)",
    "asin(0.8*sin(t))",
    "acos(0.3*cos(2*t))",
    "atan(t - 1)",
    "atan2(sin(t) + 2, t + 1)",
    "exp(-(t - 1)^2)",
    "log(1 + t^2)",
    "sqrt(1 + t)",
    "(1 + t)^1.5",
    "(2 + t)^-3",
    "(1.2 + sin(t))^t",
    "tanh(2*t - 2)",
    "t/(1 + t^2)",
    "1/(t + 0.5)",
    "ramp(t - 0.5, 0.7)",
    "2*ramp(sin(t), 0.5) - ramp(t, 3)",
    "0.2*sin(t)*(1 - exp(-t/2))^2",
    "-(t - 1)^3 + pi",
    "t^7",
    "50*exp(-((t - 1.3)/0.01)^2)",
};
enum { TEXTS = sizeof texts / sizeof *texts };

/* round-off of a value near the ends of its bounds */
static int inside(double x, interval bounds) {
    const double slack = 1e-12 * (1 + fabs(x));
    return x >= bounds.low - slack && x <= bounds.high + slack;
}

START_TEST(every_time_is_inside) {
    gough_formula f;
    dice d = {11};

    set_formula(&f, texts[_i]);
    for (int k = 0; k < 400; k++) {
        const double from = dice_between(&d, 0, 3);
        const double to = from + pow(10, dice_between(&d, -4, 0.5));
        const enclosure e = formula_enclose(&f, from, to);
        for (int n = 0; n < 20; n++) {
            double at[3];
            gough_formula_evaluate(&f,
                                   n == 0   ? from
                                   : n == 1 ? to
                                            : dice_between(&d, from, to),
                                   at);
            if (!isfinite(at[0] + at[1] + at[2])) continue;
            ck_assert_msg(inside(at[0], e.v) && inside(at[1], e.d) && inside(at[2], e.dd),
                          "%s on [%.17g, %.17g]", texts[_i], from, to);
        }
    }
}
END_TEST

/* an error of the first order in the length: ten times shorter, about ten times tighter */
START_TEST(bounds_close_in) {
    gough_formula f;
    double at[3];

    set_formula(&f, texts[_i]);
    for (double t = 0.13; t < 2.6; t += 0.31) {
        gough_formula_evaluate(&f, t, at);
        const enclosure e = formula_enclose(&f, t, t + 1e-7);
        const double size = 1 + fabs(at[0]) + fabs(at[1]) + fabs(at[2]);
        ck_assert_msg(e.dd.high - e.dd.low <= 1e-2 * size * (1 + size), "%s at %g: %g", texts[_i],
                      t, e.dd.high - e.dd.low);
        if (strncmp(texts[_i], "atan2", 5) == 0)
            continue; /* of the angle itself only that it is one */
        ck_assert(e.v.high - e.v.low <= 1e-5 * size);
    }
}
END_TEST

START_TEST(nothing_is_known_beyond_a_domain_or_through_a_pole) {
    gough_formula f;

    set_formula(&f, "1/t");
    ck_assert(isinf(interval_magnitude(formula_enclose(&f, -1, 1).v)));
    set_formula(&f, "tan(t)");
    ck_assert(isinf(interval_magnitude(formula_enclose(&f, 1, 2).v)));
    set_formula(&f, "sqrt(t^2)"); /* a corner at 0 */
    ck_assert(isinf(interval_magnitude(formula_enclose(&f, -1, 1).dd)));
    set_formula(&f, "log(t)");
    ck_assert(isinf(interval_magnitude(formula_enclose(&f, 0, 1).v)));
}
END_TEST

int main(void) {
    Suite *suite = suite_create("interval");
    TCase *cases = tcase_create("interval");
    SRunner *runner;

    tcase_add_loop_test(cases, every_time_is_inside, 0, TEXTS);
    tcase_add_loop_test(cases, bounds_close_in, 0, TEXTS);
    tcase_add_test(cases, nothing_is_known_beyond_a_domain_or_through_a_pole);
    suite_add_tcase(suite, cases);
    runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
