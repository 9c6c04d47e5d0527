/* The formula compiler: what formulas mean, and what is said, and where, about texts that are
 * none. */
#include "support/comma_locale.h"

#include <check.h>
#include <math.h>
#include <string.h>

#include "program/helpers.h"

/* ---- meaning ---- */

static const struct {
    const char *text;
    double at_two; /* value at t = 2 */
} MEANINGS[] = {
    {"1 + 2*3", 7},
    {"(1 + 2)*3", 9},
    {"8/4/2", 1},
    {"8 - 4 - 2", 2},
    {"2^3^2", 512},
    {"-t^2", -4},
    {"(-t)^2", 4},
    {"2^-t", 0.25},
    {"2^-t*8", 2},
    {"2^-t^2", 0.0625},
    {"3*-t", -6},
    {"3 - -t", 5},
    {"3 + +t", 5},
    {"--t", 2},
    {"-t*-t", 4},
    {"+t", 2},
    {"  t\t*\n t \r", 4},
    {"1e-1*t", 0.2},
    {"1.e1*t", 20},
    {".5*t", 1},
    {"atan2(0, t)", 0},
    {"atan2( t , 0 )/pi", 0.5},
    {"ramp(t - 1, t)", 0.5},
    {"sqrt (t + 2)", 2},
    {"((((((((((((((((((((((((t))))))))))))))))))))))))", 2},
    {"t^2 - t^1 - t^0", 1},
    {"cos(pi)", -1},
    {"log(exp(t))", 2},
    {"acos(cos(t))", 2},
    {"1 - 2 + 3 - 4*5/10 + 2^2", 4},
};

START_TEST(formulas_mean_what_mathematics_says) {
    const double value = value_of(MEANINGS[_i].text, 2);
    ck_assert_msg(fabs(value - MEANINGS[_i].at_two) <= 1e-14, "%s is %.17g", MEANINGS[_i].text,
                  value);
}
END_TEST

START_TEST(pi_has_all_digits_of_the_number_type) {
    ck_assert(fabs(value_of("pi", 0) - 3.14159265358979323846) <= 0);
}
END_TEST

START_TEST(text_ends_at_its_length) {
    gough_formula f;
    double j[3];
    ck_assert_int_eq(gough_formula_compile(&f, "12345", 2, NULL, NULL), GOUGH_OK);
    gough_formula_evaluate(&f, 0, j);
    ck_assert(fabs(j[0] - 12) <= 0);
}
END_TEST

START_TEST(constants_are_constant) {
    const gough_formula f = gough_formula_constant(2.5);
    double j[3];
    gough_formula_evaluate(&f, 7, j);
    ck_assert(fabs(j[0] - 2.5) <= 0 && fabs(j[1]) <= 0 && fabs(j[2]) <= 0);
}
END_TEST

START_TEST(an_unfilled_formula_is_zero) {
    const gough_formula f = {.count = 0};
    double j[3] = {1, 1, 1};
    gough_formula_evaluate(&f, 7, j);
    ck_assert(fabs(j[0]) <= 0 && fabs(j[1]) <= 0 && fabs(j[2]) <= 0);
    ck_assert(gough_formula_is_zero(&f));
}
END_TEST

START_TEST(zero_is_recognised_by_its_form) {
    static const char *const ZEROS[] = {"0", "-0", "0.000", "(0)", "+0", "0e5"};
    static const char *const OTHERS[] = {"1", "t", "1e-300", "0*t", "-1", "t - t"};
    for (size_t i = 0; i < sizeof ZEROS / sizeof ZEROS[0]; i++) {
        const gough_formula f = formula_of(ZEROS[i]);
        ck_assert_msg(gough_formula_is_zero(&f), "%s", ZEROS[i]);
    }
    for (size_t i = 0; i < sizeof OTHERS / sizeof OTHERS[0]; i++) {
        const gough_formula f = formula_of(OTHERS[i]);
        ck_assert_msg(!gough_formula_is_zero(&f), "%s", OTHERS[i]);
    }
    const gough_formula constant = gough_formula_constant(0),
                        not_a_number = gough_formula_constant(NAN);
    ck_assert(gough_formula_is_zero(&constant));
    ck_assert(!gough_formula_is_zero(&not_a_number));
}
END_TEST

/* ---- errors ---- */

static const struct {
    const char *text;
    size_t offset;
    const char *sentence;
} ERRORS[] = {
    {"", 0, "empty"},
    {"   ", 0, "empty"},
    {"sinn(t)", 0, "unknown name 'sinn': did you mean 'sin'?"},
    {"1 + Sin(t)", 4, "did you mean 'sin'?"},
    {"squrt(t)", 0, "did you mean 'sqrt'?"},
    {"2*ln(t)", 2, "did you mean 'log(x)'?"},
    {"arctan(t)", 0, "did you mean 'atan(x)'?"},
    {"3*x", 2, "did you mean 't'?"},
    {"qwertyuiop", 0, "unknown name 'qwertyuiop'"},
    {"t1", 0, "unknown name 't1'"},
    {"(t", 0, "')' is missing: this parenthesis"},
    {"2*sin((t + 1)", 2, "')' is missing: this parenthesis"},
    {"t)", 1, "'(' is missing"},
    {"()", 1, "a value is missing before ')'"},
    {"sin()", 4, "a value is missing before ')'"},
    {"t*", 2, "a value is missing at the end"},
    {"-", 1, "a value is missing at the end"},
    {"t + * 2", 4, "a value is missing before '*'"},
    {"t ^^ 2", 3, "a value is missing before '^'"},
    {"ramp(t)", 0, "ramp takes 2 arguments: ramp(t, T)"},
    {"1 + atan2(t)", 4, "atan2 takes 2 arguments: atan2(y, x)"},
    {"sin(t, 2)", 5, "sin takes 1 argument: sin(x)"},
    {"ramp(t, 1, 2)", 9, "ramp takes 2 arguments: ramp(t, T)"},
    {"ramp(t, 0)", 0, "positive"},
    {"ramp(t, 3 - 5)", 0, "positive"},
    {"ramp(t, 1/0)", 0, "positive"},
    {"sin t", 4, "sin needs its argument in parentheses: sin(x)"},
    {"cos", 3, "cos needs its argument in parentheses"},
    {"2t", 1, "write products with *"},
    {"2 sin(t)", 2, "write products with *"},
    {"(t)(t)", 3, "write products with *"},
    {"2exp(t)", 1, "write products with *"},
    {"1.2.3", 3, "an operator is missing before '.'"},
    {"t**2", 1, "write powers with ^"},
    {"1,5", 1, "numbers are written with a point"},
    {"(1,5)", 2, "numbers are written with a point"},
    {".", 0, "a number needs at least one digit"},
    {"t + 1e999", 4, "too large"},
    {"t = 1", 2, "unexpected character '='"},
    {"t # no", 2, "unexpected character '#'"},
    {"t \303\227 2", 2, "unexpected character '\303\227'"},
    {"\342\210\222t", 0, "unexpected character '\342\210\222'"},
    {"t\377", 1, "unexpected byte 0xff"},
    {"t\302", 1, "unexpected byte 0xc2"},
    {"t\302\233", 1, "unexpected character '\\u009b'"},
    {"t\33[1m", 1, "unexpected byte 0x1b"},
};

START_TEST(errors_say_what_and_where) {
    gough_formula f = formula_of("t");
    gough_error error = {.message = ""};
    size_t offset = 12345;
    const gough_status status =
        gough_formula_compile(&f, ERRORS[_i].text, strlen(ERRORS[_i].text), &offset, &error);
    ck_assert_msg(status == GOUGH_ERROR_INPUT, "accepted: %s", ERRORS[_i].text);
    ck_assert_int_eq(error.status, GOUGH_ERROR_INPUT);
    ck_assert_msg(offset == ERRORS[_i].offset, "%s: offset %zu, not %zu (%s)", ERRORS[_i].text,
                  offset, ERRORS[_i].offset, error.message);
    ck_assert_msg(strstr(error.message, ERRORS[_i].sentence) != NULL, "%s: %s", ERRORS[_i].text,
                  error.message);
    ck_assert_int_eq(f.count, 0);
}
END_TEST

START_TEST(a_nul_byte_is_an_error_at_its_place) {
    gough_formula f;
    gough_error error = {.message = ""};
    size_t offset = 0;
    ck_assert_int_eq(gough_formula_compile(&f, "t\0t", 3, &offset, &error), GOUGH_ERROR_INPUT);
    ck_assert_uint_eq(offset, 1);
    ck_assert(strstr(error.message, "0x00") != NULL);
}
END_TEST

/* ---- limits: the last that fits, and one more ---- */

static size_t append(char *text, size_t n, const char *more) {
    memcpy(text + n, more, strlen(more));
    return n + strlen(more);
}

static gough_status compile_repeated(const char *before, int times, const char *middle,
                                     const char *after, gough_error *error) {
    static char text[20000];
    gough_formula f;
    size_t n = 0;
    for (int i = 0; i < times; i++) n = append(text, n, before);
    n = append(text, n, middle);
    for (int i = 0; i < times; i++) n = append(text, n, after);
    return gough_formula_compile(&f, text, n, NULL, error);
}

START_TEST(one_too_deep_is_an_error) {
    gough_error error = {.message = ""};
    const int deep = GOUGH_FORMULA_DEPTH;
    ck_assert_int_eq(compile_repeated("(", deep, "t", ")", &error), GOUGH_OK);
    ck_assert_int_eq(compile_repeated("(", deep + 1, "t", ")", &error), GOUGH_ERROR_INPUT);
    ck_assert(strstr(error.message, "nested too deeply") != NULL);
    ck_assert_int_eq(compile_repeated("sin(", deep, "t", ")", &error), GOUGH_OK);
    ck_assert_int_eq(compile_repeated("sin(", deep + 1, "t", ")", &error), GOUGH_ERROR_INPUT);
    /* each level leaves a value waiting */
    ck_assert_int_eq(compile_repeated("1 + (", deep - 1, "t", ")", &error), GOUGH_OK);
    ck_assert_int_eq(compile_repeated("1 + (", deep, "t", ")", &error), GOUGH_ERROR_INPUT);
    ck_assert_int_eq(compile_repeated("2^", deep - 1, "t", "", &error), GOUGH_OK);
    ck_assert_int_eq(compile_repeated("2^", deep, "t", "", &error), GOUGH_ERROR_INPUT);
    ck_assert_int_eq(compile_repeated("-", 4 * deep, "t", "", &error), GOUGH_OK);
    ck_assert_int_eq(compile_repeated("-", 4 * deep + 1, "t", "", &error), GOUGH_ERROR_INPUT);
    ck_assert_int_eq(compile_repeated("(", 6000, "t", ")", &error), GOUGH_ERROR_INPUT);
}
END_TEST

START_TEST(the_deepest_formula_is_evaluated_right) {
    char text[400] = "";
    for (int i = 0; i < GOUGH_FORMULA_DEPTH - 1; i++) strcat(text, "1 + (");
    strcat(text, "t");
    for (int i = 0; i < GOUGH_FORMULA_DEPTH - 1; i++) strcat(text, ")");
    ck_assert(fabs(value_of(text, 0.5) - (GOUGH_FORMULA_DEPTH - 0.5)) <= 0);
}
END_TEST

START_TEST(one_too_long_is_an_error) {
    gough_error error = {.message = ""};
    /* n sums are 2 n + 1 operations */
    const int sums = (GOUGH_FORMULA_OPERATIONS - 1) / 2;
    ck_assert_int_eq(compile_repeated("t + ", sums, "t", "", &error), GOUGH_OK);
    ck_assert_int_eq(compile_repeated("t + ", sums + 1, "t", "", &error), GOUGH_ERROR_INPUT);
    ck_assert(strstr(error.message, "too long") != NULL);
    /* also where the last operation comes with the end of a parenthesis or of an argument */
    ck_assert_int_eq(compile_repeated("t + ", sums + 1, "t)", "", &error), GOUGH_ERROR_INPUT);
    ck_assert(strstr(error.message, "too long") != NULL);
    gough_formula f;
    char text[8 * GOUGH_FORMULA_OPERATIONS] = "atan2(t";
    for (int i = 0; i <= sums; i++) strcat(text, " + t");
    strcat(text, ", 1)");
    ck_assert_int_eq(gough_formula_compile(&f, text, strlen(text), NULL, &error),
                     GOUGH_ERROR_INPUT);
    ck_assert(strstr(error.message, "too long") != NULL);
}
END_TEST

/* ---- any text ---- */

static void compile_anything(const char *text, size_t length) {
    gough_formula f;
    gough_error error = {.message = ""};
    size_t offset = 0;
    const gough_status status = gough_formula_compile(&f, text, length, &offset, &error);
    ck_assert(status == GOUGH_OK || status == GOUGH_ERROR_INPUT);
    ck_assert(status == GOUGH_OK ? f.count > 0 : f.count == 0 && error.message[0] != '\0');
    ck_assert(offset <= length);
    ck_assert(f.count <= GOUGH_FORMULA_OPERATIONS);
    double j[3];
    gough_formula_evaluate(&f, 0.75, j);
}

START_TEST(any_bytes_end_in_a_status) {
    random_source random = random_seeded(4);
    for (int i = 0; i < 50000; i++) {
        char text[64];
        const size_t length = random_bits(&random) % sizeof text;
        for (size_t k = 0; k < length; k++) text[k] = (char)(random_bits(&random) % 256);
        compile_anything(text, length);
    }
}
END_TEST

START_TEST(any_words_end_in_a_status) {
    static const char *const WORDS[] = {"t",     "pi", "sin(", "cos(", "ramp(", "atan2(", "sqrt(",
                                        "tanh(", "(",  ")",    ")",    ",",     "+",      "-",
                                        "*",     "/",  "^",    "1",    "0.5",   "1e300",  " "};
    random_source random = random_seeded(5);
    int accepted = 0;
    for (int i = 0; i < 100000; i++) {
        char text[400] = "";
        const size_t words = 1 + random_bits(&random) % (i % 100 == 0 ? 60 : 8);
        for (size_t k = 0; k < words; k++)
            strcat(text, WORDS[random_bits(&random) % (sizeof WORDS / sizeof WORDS[0])]);
        compile_anything(text, strlen(text));
        gough_formula f;
        accepted += gough_formula_compile(&f, text, strlen(text), NULL, NULL) == GOUGH_OK;
    }
    ck_assert_int_gt(accepted, 1000); /* or the texts would be too wild to test anything */
}
END_TEST

START_TEST(formulas_are_the_same_in_a_comma_locale) {
    locale_with_comma();
    const double value = value_of("1.5*t", 2);
    gough_formula f;
    gough_error error = {.message = ""};
    const gough_status status = gough_formula_compile(&f, "ramp(t, -0.5)", 13, NULL, &error);
    locale_reset();
    ck_assert(fabs(value - 3) <= 0);
    ck_assert_int_eq(status, GOUGH_ERROR_INPUT);
    ck_assert(strstr(error.message, "-0.5") != NULL);
}
END_TEST

/* size·f(rate·t), by the values and by the chain rule for the derivatives */
START_TEST(a_scaled_formula_is_the_formula_in_other_units) {
    static const char *const texts[] = {"3",         "t",       "sin(2*t)",         "ramp(t, 0.5)",
                                        "t^3 - 2*t", "exp(-t)", "atan2(t, 2) + pi", "(1 + t)^0.5"};
    const double size = 0.001, rate = 1000;
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        gough_formula plain, scaled;
        gough_error error;
        ck_assert_int_eq(gough_formula_compile(&plain, texts[i], strlen(texts[i]), NULL, &error),
                         GOUGH_OK);
        scaled = plain;
        ck_assert_int_eq(gough_formula_scale(&scaled, size, rate, &error), GOUGH_OK);
        for (int step = 1; step < 10; step++) {
            const double t = 1e-4 * step;
            double a[3], b[3];
            gough_formula_evaluate(&plain, rate * t, a);
            gough_formula_evaluate(&scaled, t, b);
            for (int k = 0; k < 3; k++) {
                const double wanted = size * pow(rate, k) * a[k];
                /* the roundings of rate and t move the arguments */
                ck_assert_msg(fabs(b[k] - wanted) <= 1e-12 * size * pow(rate, k), "%s: %g, not %g",
                              texts[i], b[k], wanted);
            }
        }
    }
}
END_TEST

START_TEST(a_formula_stays_where_nothing_is_to_be_scaled) {
    gough_formula f, before;
    gough_error error;
    ck_assert_int_eq(gough_formula_compile(&f, "sin(t)", 6, NULL, &error), GOUGH_OK);
    before = f;
    ck_assert_int_eq(gough_formula_scale(&f, 1, 1, &error), GOUGH_OK);
    ck_assert_int_eq(f.count, before.count);
    ck_assert_int_eq(gough_formula_compile(&f, "0", 1, NULL, &error), GOUGH_OK);
    ck_assert_int_eq(gough_formula_scale(&f, 0.001, 1000, &error), GOUGH_OK);
    ck_assert(gough_formula_is_zero(&f));
}
END_TEST

/* As long, or as deep, as a formula may be, it has no room for more, and stays as it was. */
START_TEST(a_formula_without_room_is_not_scaled) {
    char text[2000] = "t";
    gough_formula f;
    gough_error error = {.message = ""};
    for (int i = 0; i < 95; i++) strcat(text, "+1");
    ck_assert_int_eq(gough_formula_compile(&f, text, strlen(text), NULL, &error), GOUGH_OK);
    const int count = f.count;
    ck_assert_int_eq(count, GOUGH_FORMULA_OPERATIONS - 1);
    ck_assert_int_eq(gough_formula_scale(&f, 2, 1, &error), GOUGH_ERROR_INPUT);
    ck_assert_int_eq(f.count, count);
    ck_assert_ptr_nonnull(strstr(error.message, "too long"));
    text[0] = '\0';
    for (int i = 1; i < GOUGH_FORMULA_DEPTH; i++) strcat(text, "1+(");
    strcat(text, "t");
    for (int i = 1; i < GOUGH_FORMULA_DEPTH; i++) strcat(text, ")");
    ck_assert_int_eq(gough_formula_compile(&f, text, strlen(text), NULL, &error), GOUGH_OK);
    ck_assert_int_eq(gough_formula_scale(&f, 2, 1, &error), GOUGH_OK);
    ck_assert_int_eq(gough_formula_compile(&f, text, strlen(text), NULL, &error), GOUGH_OK);
    ck_assert_int_eq(gough_formula_scale(&f, 1, 2, &error), GOUGH_ERROR_INPUT);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("formula");
    TCase *tests = tcase_create("formula");
    tcase_set_timeout(tests, 60);
    tcase_add_loop_test(tests, formulas_mean_what_mathematics_says, 0,
                        (int)(sizeof MEANINGS / sizeof MEANINGS[0]));
    tcase_add_test(tests, pi_has_all_digits_of_the_number_type);
    tcase_add_test(tests, text_ends_at_its_length);
    tcase_add_test(tests, constants_are_constant);
    tcase_add_test(tests, an_unfilled_formula_is_zero);
    tcase_add_test(tests, zero_is_recognised_by_its_form);
    tcase_add_loop_test(tests, errors_say_what_and_where, 0,
                        (int)(sizeof ERRORS / sizeof ERRORS[0]));
    tcase_add_test(tests, a_nul_byte_is_an_error_at_its_place);
    tcase_add_test(tests, one_too_deep_is_an_error);
    tcase_add_test(tests, the_deepest_formula_is_evaluated_right);
    tcase_add_test(tests, one_too_long_is_an_error);
    tcase_add_test(tests, any_bytes_end_in_a_status);
    tcase_add_test(tests, any_words_end_in_a_status);
    tcase_add_test(tests, formulas_are_the_same_in_a_comma_locale);
    tcase_add_test(tests, a_scaled_formula_is_the_formula_in_other_units);
    tcase_add_test(tests, a_formula_stays_where_nothing_is_to_be_scaled);
    tcase_add_test(tests, a_formula_without_room_is_not_scaled);
    suite_add_tcase(suite, tests);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? 0 : 1;
}
