/* Jets of formulas against differences of the same functions written by hand in 33 digits:
 * central differences of order 8 at h = 2e-4 leave some 1e-24 of the first two derivatives, far
 * below what double can show. */
#include <check.h>
#include <math.h>

#define NUMBER_QUAD
#include "program/helpers.h"
#include "program/program.h"

#define Q(x) ((real)(x))

typedef real function(real t);

static real paper(real t) {
    const real e = 1 - real_exp(-t / 2);
    return real_sin(t) * e * e / 5;
}
static real sine(real t) { return real_sin(3 * t + 1); }
static real cosine(real t) { return real_cos(t * t); }
static real tangent(real t) { return real_tan(t / 3); }
static real arcsine(real t) { return real_asin(t / 4); }
static real arccosine(real t) { return real_acos(real_cos(t) / 2); }
static real arctangent(real t) { return real_atan(t * t - 1); }
static real direction(real t) { return real_atan2(real_sin(t), real_cos(t) / 2 - 1); }
static real exponential(real t) { return real_exp(-t * t / 2); }
static real logarithm(real t) { return real_log(1 + t * t); }
static real root(real t) { return real_root(2 + real_sin(t)); }
static real hyperbolic(real t) { return real_tanh(5 * t - 7); }
static real far_hyperbolic(real t) { return real_tanh(20 + t); }
static real cube(real t) { return (t - 2) * (t - 2) * (t - 2); }
static real inverse_square(real t) { return 1 / ((t + 1) * (t + 1)); }
static real high_power(real t) { return real_pow(t, 21); }
static real broken_power(real t) { return real_pow(1 + t, Q(5) / 2); }
static real third_root(real t) { return real_pow(t + 1, Q(1) / 3); }
static real general_power(real t) { return real_exp(real_sin(t) * real_log(t + Q(0.5))); }
static real constant_base(real t) { return real_exp(-t * real_log(Q(2))); }
static real quotient(real t) { return (t * t - 1) / (t * t + real_cos(t)); }
static real nested(real t) {
    return real_sin(real_exp(real_cos(real_root(1 + t * t)))) * real_atan(real_tanh(t));
}
static real towers(real t) { return real_pow(2, real_pow(t, 2)) - -t; }
static real rising(real t) {
    const real s = t / 3;
    if (s >= 1) return 1;
    return s <= 0 ? 0 : s * s * s * (10 - 15 * s + 6 * s * s);
}
static real turning(real t) { return real_sin(2 * REAL_PI * t) / 3; }
static real shorter_ramp(real t) {
    const real s = (t - 1) / (1 + t);
    return s <= 0 ? 0 : s * s * s * (10 - 15 * s + 6 * s * s) * t;
}

static const struct {
    const char *text;
    function *by_hand;
} CASES[] = {
    {"0.2*sin(t)*(1 - exp(-t/2))^2/(0.2*5)", paper},
    {"sin(3*t + 1)", sine},
    {"cos(t^2)", cosine},
    {"tan(t/3)", tangent},
    {"asin(t/4)", arcsine},
    {"acos(cos(t)/2)", arccosine},
    {"atan(t*t - 1)", arctangent},
    {"atan2(sin(t), cos(t)/2 - 1)", direction},
    {"exp(-t^2/2)", exponential},
    {"log(1 + t^2)", logarithm},
    {"sqrt(2 + sin(t))", root},
    {"tanh(5*t - 7)", hyperbolic},
    {"tanh(20 + t)", far_hyperbolic},
    {"(t - 2)^3", cube},
    {"(t + 1)^-2", inverse_square},
    {"t^21", high_power},
    {"(1 + t)^2.5", broken_power},
    {"(t + 1)^(1/3)", third_root},
    {"(t + 0.5)^sin(t)", general_power},
    {"2^-t", constant_base},
    {"(t^2 - 1)/(t^2 + cos(t))", quotient},
    {"sin(exp(cos(sqrt(1 + t^2))))*atan(tanh(t))", nested},
    {"2^t^2 - -t", towers},
    {"ramp(t, 3)", rising},
    {"sin(2*pi*t)/3", turning},
    {"t*ramp(t - 1, 1 + t)", shorter_ramp},
};
enum { CASE_COUNT = sizeof CASES / sizeof CASES[0] };

static const double TIMES[] = {0.25, 0.7, 1.3, 1.75, 2.5, 2.9, 3.4};
enum { TIME_COUNT = sizeof TIMES / sizeof TIMES[0] };

/* derivatives by central differences of order 8 */
static void differences(function *f, real t, real out[3]) {
    static const int FIRST[4] = {672, -168, 32, -3};     /* over 840 h */
    static const int SECOND[4] = {8064, -1008, 128, -9}; /* over 5040 h² */
    const real h = Q(1) / 5000;
    out[0] = f(t);
    out[1] = 0;
    real second = -14350 * out[0];
    for (int k = 1; k <= 4; k++) {
        const real right = f(t + k * h), left = f(t - k * h);
        out[1] += FIRST[k - 1] * (right - left) / (840 * h);
        second += SECOND[k - 1] * (right + left);
    }
    out[2] = second / (5040 * h * h);
}

/* the size that round-off of the evaluation is measured by: that of f and its derivatives around
 * t */
static real scale_of(const real d[3]) {
    return 1 + real_magnitude(d[0]) + real_magnitude(d[1]) + real_magnitude(d[2]);
}

START_TEST(every_function_has_right_derivatives_in_double) {
    const gough_formula f = formula_of(CASES[_i].text);
    for (int k = 0; k < TIME_COUNT; k++) {
        real right[3];
        double found[3];
        differences(CASES[_i].by_hand, Q(TIMES[k]), right);
        gough_formula_evaluate(&f, TIMES[k], found);
        for (int d = 0; d < 3; d++) {
            const double error = (double)((Q(found[d]) - right[d]) / scale_of(right));
            ck_assert_msg(fabs(error) <= 2e-14, "%s, derivative %d at %g: %g, off by %g",
                          CASES[_i].text, d, TIMES[k], found[d], error);
        }
    }
}
END_TEST

START_TEST(every_function_has_right_derivatives_in_quad) {
    const gough_formula f = formula_of(CASES[_i].text);
    for (int k = 0; k < TIME_COUNT; k++) {
        real right[3];
        differences(CASES[_i].by_hand, Q(TIMES[k]), right);
        const jet j = formula_jet(&f, Q(TIMES[k]));
        const real found[3] = {j.v, j.d, j.dd};
        for (int d = 0; d < 3; d++) {
            const double error = (double)((found[d] - right[d]) / scale_of(right));
            ck_assert_msg(fabs(error) <= (d == 0 ? 1e-31 : 1e-21),
                          "%s, derivative %d at %g: off by %g", CASES[_i].text, d, TIMES[k], error);
        }
    }
}
END_TEST

/* ---- removable places: known limits where terms of the chain rule are 0·∞ or 0/0 ---- */

static const struct {
    const char *text;
    double t, v, d, dd;
} LIMITS[] = {
    {"(1 - exp(-t/2))^2", 0, 0, 0, 0.5},
    {"0.2*sin(t)*(1 - exp(-t/2))^2", 0, 0, 0, 0},
    {"t^2.5", 0, 0, 0, 0},
    {"t^2", 0, 0, 0, 2},
    {"t^1", 0, 0, 1, 0},
    {"t^0", 0, 1, 0, 0},
    {"t^3", 0, 0, 0, 0},
    {"(t^2)^1.5", 0, 0, 0, 0}, /* |t|³ */
    {"(-t)^3", 2, -8, -12, -12},
    {"(t - 3)^2", 1, 4, -4, 2},
    {"0*sqrt(t)", 0, 0, 0, 0},
    {"sqrt(t)*0", 0, 0, 0, 0},
    {"sqrt(0)*t", 2, 0, 0, 0},
    {"sqrt(0) + t", 2, 2, 1, 0},
    {"asin(1)*0 + t^2", 2, 4, 4, 2},
    {"sqrt(1 + t)", 0, 1, 0.5, -0.25},
    {"ramp(t, 2)", 0, 0, 0, 0},
    {"ramp(t, 2)", 2, 1, 0, 0},
    {"ramp(t, 2)", 1, 0.5, 0.9375, 0},
    {"ramp(t, 2)", -1, 0, 0, 0},
    {"ramp(t, 2)", 5, 1, 0, 0},
    {"exp(-1000*t)", 1, 0, 0, 0},
    {"tanh(1000*t)", 1, 1, 0, 0},
    {"atan2(t, 1)", 0, 0, 1, 0},
    {"atan2(1, t)", 0, 1.5707963267948966, -1, 0},
    {"atan2(t, -1)", 0, 3.141592653589793, -1, 0},
    {"2*3 - 6/2", 1, 3, 0, 0},
};

START_TEST(removable_places_have_their_limits) {
    const gough_formula f = formula_of(LIMITS[_i].text);
    double jet_at[3];
    gough_formula_evaluate(&f, LIMITS[_i].t, jet_at);
    const double right[3] = {LIMITS[_i].v, LIMITS[_i].d, LIMITS[_i].dd};
    for (int d = 0; d < 3; d++)
        ck_assert_msg(fabs(jet_at[d] - right[d]) <= 1e-14, "%s, derivative %d at %g: %g, not %g",
                      LIMITS[_i].text, d, LIMITS[_i].t, jet_at[d], right[d]);
}
END_TEST

static const struct {
    const char *text;
    double t;
} UNDEFINED[] = {
    {"1/t", 0},           {"log(t)", 0},
    {"log(t)", -1},       {"log(t)^0", -1},
    {"sqrt(t)", -1},      {"sqrt(t)", 0},
    {"sqrt(t^2)", 0},     {"t^0.5", 0},
    {"t^1.5", 0},         {"(-1 - t)^0.5", 0},
    {"asin(t)", 1.5},     {"acos(t)", 1},
    {"sin(t)/t", 0},      {"0/t", 0},
    {"0*(1/t)", 0},       {"t^-1", 0},
    {"exp(t)", 1000},     {"1/(1 + exp(t))", 1000},
    {"ramp(t, t)", 0},    {"ramp(1, -t)", 1},
    {"atan2(t, t)", 0},   {"sqrt(t)*sqrt(t)", 0},
    {"t^t", -0.5},        {"(t^2)^0.5", 0},
    {"tan(t)", INFINITY}, {"sin(t)", INFINITY},
    {"t", NAN},
};

START_TEST(undefined_places_are_never_finite) {
    const gough_formula f = formula_of(UNDEFINED[_i].text);
    double j[3];
    gough_formula_evaluate(&f, UNDEFINED[_i].t, j);
    ck_assert_msg(!isfinite(j[0]) || !isfinite(j[1]) || !isfinite(j[2]), "%s at %g: %g, %g, %g",
                  UNDEFINED[_i].text, UNDEFINED[_i].t, j[0], j[1], j[2]);
}
END_TEST

/* η and its second derivative as the paper's study prints them */
START_TEST(the_papers_heave_has_its_numbers) {
    static const double ROWS[][3] = {
        {0, 0, 0},
        {1, 0.026054991474, 0.036396709972},
        {2, 0.072666758631, -0.120214942866},
        {5, -0.161591772014, 0.176720109336},
        {8, 0.190689736517, -0.193481877313},
        {15, 0.129913742200, -0.130117644467},
        {20, 0.182572471462, -0.182569205428},
    };
    const gough_formula f = formula_of("0.2*sin(t)*(1 - exp(-t/2))^2");
    for (size_t i = 0; i < sizeof ROWS / sizeof ROWS[0]; i++) {
        double j[3];
        gough_formula_evaluate(&f, ROWS[i][0], j);
        ck_assert(fabs(j[0] - ROWS[i][1]) <= 5e-13);
        ck_assert(fabs(j[2] - ROWS[i][2]) <= 5e-13);
    }
}
END_TEST

int main(void) {
    Suite *suite = suite_create("jet");
    TCase *tests = tcase_create("jet");
    tcase_set_timeout(tests, 60);
    tcase_add_loop_test(tests, every_function_has_right_derivatives_in_double, 0, CASE_COUNT);
    tcase_add_loop_test(tests, every_function_has_right_derivatives_in_quad, 0, CASE_COUNT);
    tcase_add_loop_test(tests, removable_places_have_their_limits, 0,
                        (int)(sizeof LIMITS / sizeof LIMITS[0]));
    tcase_add_loop_test(tests, undefined_places_are_never_finite, 0,
                        (int)(sizeof UNDEFINED / sizeof UNDEFINED[0]));
    tcase_add_test(tests, the_papers_heave_has_its_numbers);
    suite_add_tcase(suite, tests);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? 0 : 1;
}
