/* Sentences for errors: complete, bounded, the same in every locale. */
#include "support/comma_locale.h"

#include <check.h>
#include <math.h>
#include <string.h>

#include "gough/status.h"

START_TEST(sentences_are_formatted_like_printf) {
    gough_error e = {.message = ""};
    ck_assert_int_eq(gough_fail(&e, GOUGH_ERROR_INPUT, "leg %d of %s: %.3g %% of %-6.2f|%5d|%c", 3,
                                "six", 1.25, 0.5, -7, 'x'),
                     GOUGH_ERROR_INPUT);
    ck_assert_int_eq(e.status, GOUGH_ERROR_INPUT);
    ck_assert_str_eq(e.message, "leg 3 of six: 1.25 % of 0.50  |   -7|x");
    gough_fail(&e, GOUGH_ERROR_FILE, "%zu rows, %ld, %u, %02x, %.*s, %*d, %e", (size_t)12, -5L, 7u,
               255u, 2, "abc", 4, 9, 1.5);
    ck_assert_str_eq(e.message, "12 rows, -5, 7, ff, ab,    9, 1.500000e+00");
    gough_fail(&e, GOUGH_ERROR_FILE, "%g %g %g", INFINITY, -INFINITY, 1e-300);
    ck_assert_str_eq(e.message, "inf -inf 1e-300");
    gough_fail(&e, GOUGH_ERROR_FILE, "%lu %zd", 5ul, (ptrdiff_t)-3);
    ck_assert_str_eq(e.message, "5 -3");
}
END_TEST

START_TEST(no_error_struct_is_no_error) {
    ck_assert_int_eq(gough_fail(NULL, GOUGH_ERROR_NUMERICAL, "%d", 1), GOUGH_ERROR_NUMERICAL);
}
END_TEST

START_TEST(an_error_about_a_key_names_it) {
    gough_error e = {.message = ""};
    ck_assert_int_eq(gough_fail_key(&e, GOUGH_ERROR_INPUT, "load.mass", "%g is %s", 0.5, "small"),
                     GOUGH_ERROR_INPUT);
    ck_assert_int_eq(e.status, GOUGH_ERROR_INPUT);
    ck_assert_str_eq(e.key, "load.mass");
    ck_assert_str_eq(e.message, "0.5 is small");
    gough_fail(&e, GOUGH_ERROR_FILE, "no key");
    ck_assert_ptr_null(e.key);
    ck_assert_int_eq(gough_fail_key(NULL, GOUGH_ERROR_NUMERICAL, "load.mass", "x"),
                     GOUGH_ERROR_NUMERICAL);
}
END_TEST

static void write_sentence(char *text, size_t size, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    gough_sentence(text, size, format, arguments);
    va_end(arguments);
}

START_TEST(a_sentence_stays_in_its_room) {
    for (size_t size = 1; size < 20; size++) {
        char text[32];
        memset(text, 7, sizeof text);
        write_sentence(text, size, "%s %d %.1f", "leg", 12, 0.5);
        ck_assert(strncmp(text, "leg 12 0.5", size - 1) == 0);
        ck_assert_uint_eq(strlen(text), size - 1 < 10 ? size - 1 : 10);
        for (size_t i = size; i < sizeof text; i++) ck_assert_int_eq(text[i], 7);
    }
}
END_TEST

START_TEST(text_is_padded_to_its_width) {
    char text[40];
    write_sentence(text, sizeof text, "%-5s|%4s|%*s", "ab", "cd", 3, "e");
    ck_assert_str_eq(text, "ab   |  cd|  e");
}
END_TEST

/* formats that the compiler would refuse in a call that it checks */
START_TEST(a_format_that_makes_no_sense_loses_only_its_conversion) {
    char text[40];
    write_sentence(text, sizeof text, "half: 50 %");
    ck_assert_str_eq(text, "half: 50 ");
    write_sentence(text, sizeof text, "%-00000000000000000000000000000000d and more");
    ck_assert_ptr_nonnull(strstr(text, " and more"));
}
END_TEST

START_TEST(long_sentences_are_cut) {
    gough_error e;
    char text[2000];
    memset(text, 'a', sizeof text - 1);
    text[sizeof text - 1] = '\0';
    gough_fail(&e, GOUGH_ERROR_INPUT, "%s", text);
    ck_assert_uint_eq(strlen(e.message), sizeof e.message - 1);
}
END_TEST

/* whatever the position of the cut, no half of "ü" remains */
START_TEST(cut_sentences_are_still_utf8) {
    for (int shift = 0; shift < 4; shift++) {
        gough_error e;
        char text[2000] = "abcd";
        size_t n = (size_t)shift;
        while (n + 3 < sizeof text) {
            memcpy(text + n, "\342\202\254", 3); /* € */
            n += 3;
        }
        text[n] = '\0';
        gough_fail(&e, GOUGH_ERROR_INPUT, "%s", text);
        const size_t length = strlen(e.message);
        ck_assert_uint_ge(length, sizeof e.message - 4);
        ck_assert_uint_eq((length - (size_t)shift) % 3, 0);
    }
}
END_TEST

START_TEST(numbers_have_a_point_in_a_comma_locale) {
    gough_error e;
    locale_with_comma();
    gough_fail(&e, GOUGH_ERROR_INPUT, "%g, %.2f, %s", 1.5, 2.25, "3,5");
    locale_reset();
    ck_assert_str_eq(e.message, "1.5, 2.25, 3,5");
}
END_TEST

START_TEST(causes_have_their_words) {
    static const char *const WORDS[] = {"done",
                                        "leg_short",
                                        "leg_long",
                                        "leg_speed",
                                        "leg_force",
                                        "leg_no_length",
                                        "singular",
                                        "not_finite",
                                        "no_convergence",
                                        "stopped",
                                        "invalid",
                                        "leg_acceleration",
                                        "base_swing",
                                        "top_swing",
                                        "platform_pose",
                                        "platform_speed",
                                        "platform_acceleration"};
    for (int c = GOUGH_END_DONE; c < GOUGH_CAUSES; c++)
        ck_assert_str_eq(gough_cause_name((gough_cause)c), WORDS[c]);
}
END_TEST

/* a clause has a subject and a verb, and no two causes are told alike */
START_TEST(every_cause_has_a_clause_of_its_own) {
    for (int c = GOUGH_END_DONE; c < GOUGH_CAUSES; c++) {
        const char *words = gough_cause_words((gough_cause)c);
        ck_assert_ptr_nonnull(strchr(words, ' '));
        ck_assert_str_ne(words, "the run ends");
        for (int d = GOUGH_END_DONE; d < c; d++)
            ck_assert_str_ne(words, gough_cause_words((gough_cause)d));
    }
}
END_TEST

int main(void) {
    Suite *suite = suite_create("status");
    TCase *tests = tcase_create("status");
    tcase_add_test(tests, sentences_are_formatted_like_printf);
    tcase_add_test(tests, no_error_struct_is_no_error);
    tcase_add_test(tests, an_error_about_a_key_names_it);
    tcase_add_test(tests, a_sentence_stays_in_its_room);
    tcase_add_test(tests, every_cause_has_a_clause_of_its_own);
    tcase_add_test(tests, text_is_padded_to_its_width);
    tcase_add_test(tests, a_format_that_makes_no_sense_loses_only_its_conversion);
    tcase_add_test(tests, long_sentences_are_cut);
    tcase_add_test(tests, cut_sentences_are_still_utf8);
    tcase_add_test(tests, numbers_have_a_point_in_a_comma_locale);
    tcase_add_test(tests, causes_have_their_words);
    suite_add_tcase(suite, tests);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? 0 : 1;
}
