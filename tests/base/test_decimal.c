/* Decimal numbers are read as the nearest double, whatever the locale: against strtod in the C
 * locale, which glibc rounds correctly, bit for bit. */
#include "support/comma_locale.h"

#include <check.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gough/text.h"
#include "support/xorshift.h"

static void same_as_strtod(const char *text) {
    double read = -1;
    char *end = NULL;
    const size_t bytes = gough_decimal_read(text, strlen(text), &read);
    const double right = strtod(text, &end);
    ck_assert_msg(bytes == (size_t)(end - text), "%s: %zu bytes read", text, bytes);
    ck_assert_msg(memcmp(&read, &right, sizeof read) == 0, "%s: %a, not %a", text, read, right);
}

START_TEST(reads_known_hard_cases) {
    static const char *const TEXTS[] = {
        "0",
        "0.1",
        "1e-4",
        "0.2",
        "6.4688478326275441",
        "1e308",
        "5e-324",
        "123456789.123456789",
        "9007199254740993",
        "9007199254740992.99999999999999999999999",
        "9007199254740993.00000000000000000000001",
        "2.4703282292062327e-324",
        "2.4703282292062328e-324",
        "2.2250738585072011e-308",
        "2.2250738585072014e-308",
        "4.9406564584124654e-324",
        "1.7976931348623157e308",
        "1.7976931348623158e308",
        "1.7976931348623159e308",
        "1e309",
        "1e-400",
        "1e99999999999",
        "1e-99999999999",
        "0e99999999999",
        "1.",
        ".5",
        "1e",
        "1e+",
        "1E5",
        "-1",
        "+1",
        "-0",
        "-1.5e-3",
        "+.5",
        "18446744073709551615",
        "18446744073709551615e-19",
        "9223372036854775807e-19",
        "9999999999999999999e-20",
        "1e-19",
        "7.8459735791271921e65",
        "3.5844466002796428e298",
        "00000000000000000000000000000000000000000000000000000000000000000000000000000000001.5",
        "0.000000000000000000000000000000000000000000000000000000000000000000000000000000000015",
    };
    for (size_t i = 0; i < sizeof TEXTS / sizeof TEXTS[0]; i++) same_as_strtod(TEXTS[i]);
}
END_TEST

START_TEST(rounds_random_decimals_correctly) {
    random_source random = random_seeded(1);
    for (int i = 0; i < 100000; i++) {
        char text[64];
        size_t n = 0;
        const int digits = 1 + (int)(random_bits(&random) % 25);
        const int point = (int)(random_bits(&random) % 26);
        for (int d = 0; d < digits; d++) {
            if (d == point) text[n++] = '.';
            text[n++] = (char)('0' + random_bits(&random) % 10);
        }
        text[n] = '\0';
        const int kind = (int)(random_bits(&random) % 3);
        if (kind == 1) sprintf(text + n, "e%d", (int)(random_bits(&random) % 45) - 22);
        if (kind == 2) sprintf(text + n, "e%d", (int)(random_bits(&random) % 680) - 350);
        same_as_strtod(text);
    }
}
END_TEST

START_TEST(reads_printed_doubles_back) {
    random_source random = random_seeded(2);
    for (int i = 0; i < 50000; i++) {
        char text[64];
        double x, back = 0;
        const uint64_t bits = random_bits(&random) & 0x7fffffffffffffffu;
        memcpy(&x, &bits, sizeof x);
        if (!isfinite(x)) continue;
        sprintf(text, "%.17g", x);
        ck_assert_uint_eq(gough_decimal_read(text, strlen(text), &back), strlen(text));
        ck_assert_msg(memcmp(&x, &back, sizeof x) == 0, "%s: %a, not %a", text, back, x);
    }
}
END_TEST

/* sum of two whole numbers in decimal digits, the longer one first and changed; false where it
 * would need one digit more */
static bool add_digits(char *number, const char *more) {
    const size_t n = strlen(number), m = strlen(more);
    int carry = 0;
    for (size_t k = 0; k < n; k++) {
        const int sum = number[n - 1 - k] - '0' + (k < m ? more[m - 1 - k] - '0' : 0) + carry;
        number[n - 1 - k] = (char)('0' + sum % 10);
        carry = sum / 10;
    }
    return carry == 0;
}

/* Half way between two doubles above 2^60, where both are even whole numbers: the tie itself,
 * and with a 1 a thousand digits behind it. */
START_TEST(decides_ties_by_the_last_of_a_thousand_digits) {
    static char text[2200];
    random_source random = random_seeded(3);
    int ties = 0;
    while (ties < 200) {
        char half[400];
        const double low =
            ldexp(random_between(&random, 1, 2), 60 + (int)(random_bits(&random) % 300));
        sprintf(text, "%.0f", low);
        sprintf(half, "%.0f", (nextafter(low, INFINITY) - low) / 2);
        if (!add_digits(text, half)) continue;
        same_as_strtod(text);
        const size_t n = strlen(text);
        text[n] = '.';
        memset(text + n + 1, '0', 1000);
        strcpy(text + n + 1001, "1");
        same_as_strtod(text);
        ties++;
    }
}
END_TEST

START_TEST(reads_a_hexadecimal_number_as_zero_and_text) {
    double value = 7;
    ck_assert_uint_eq(gough_decimal_read("0x10", 4, &value), 1);
    ck_assert(value >= 0 && value <= 0);
    ck_assert_uint_eq(gough_decimal_read("-0x1p3", 6, &value), 2);
}
END_TEST

START_TEST(takes_nothing_that_is_no_number) {
    static const char *const TEXTS[] = {"",     ".",    "e5",  "-",  "+", "--1", "+-1", "- 1", "-.",
                                        "-inf", "+nan", "-e1", " 1", "x", ",5",  "inf", "nan"};
    for (size_t i = 0; i < sizeof TEXTS / sizeof TEXTS[0]; i++) {
        double value = 7;
        ck_assert_uint_eq(gough_decimal_read(TEXTS[i], strlen(TEXTS[i]), &value), 0);
    }
}
END_TEST

START_TEST(stops_at_the_given_length) {
    double value = 0;
    ck_assert_uint_eq(gough_decimal_read("1234e5", 3, &value), 3);
    ck_assert(value >= 123 && value <= 123);
    ck_assert_uint_eq(gough_decimal_read("12e5", 3, &value), 2);
    ck_assert(value >= 12 && value <= 12);
}
END_TEST

START_TEST(reads_points_in_a_comma_locale) {
    double value = 0;
    locale_with_comma();
    const size_t bytes = gough_decimal_read("1.5", 3, &value);
    locale_reset();
    ck_assert_uint_eq(bytes, 3);
    ck_assert(value >= 1.5 && value <= 1.5);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("decimal");
    TCase *tests = tcase_create("decimal");
    tcase_set_timeout(tests, 60);
    tcase_add_test(tests, reads_known_hard_cases);
    tcase_add_test(tests, rounds_random_decimals_correctly);
    tcase_add_test(tests, reads_printed_doubles_back);
    tcase_add_test(tests, decides_ties_by_the_last_of_a_thousand_digits);
    tcase_add_test(tests, reads_a_hexadecimal_number_as_zero_and_text);
    tcase_add_test(tests, takes_nothing_that_is_no_number);
    tcase_add_test(tests, stops_at_the_given_length);
    tcase_add_test(tests, reads_points_in_a_comma_locale);
    suite_add_tcase(suite, tests);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? 0 : 1;
}
