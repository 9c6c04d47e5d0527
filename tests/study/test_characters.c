/* Where a message points, whatever stands for a character in the file: escapes, doubled quotes, folded lines, line ends, marks. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "study/helpers.h"
#include "support/suite.h"

/* Expects an error in the good study and one more line, or lines, from its eighth line on. */
static void expect_at(const char *more, const char *part) {
    char text[3000];
    snprintf(text, sizeof text, "%s%s", good_study, more);
    expect_said(text, part);
}

START_TEST(each_escape_is_one_character) {
    expect_at("motion: {heave: \"\\x74*\\u0074*\\U00000074*q\"}\n", "study.yaml:8:41: error: ");
    expect_at("motion: {heave: \"t*\\x74q\"}\n", "study.yaml:8:20: error: ");
    expect_at("motion: {heave: \"\\x73in(\"}\n", "study.yaml:8:25: error: ");
    expect_at("motion: {heave: \"t\\n*\\t\\ q\"}\n", "study.yaml:8:26: error: ");
    expect_at("control: {stiffness: \"\\x35 apples\"}\n", "study.yaml:8:27: error: ");
    expect_said("title: \"\\L\\L\\L\\L\\t\\x1b\"\n",
                "study.yaml:1:19: error: control character U+001B");
}
END_TEST

START_TEST(doubled_quotes_and_folded_lines_are_counted_as_they_stand) {
    expect_at("motion: {heave: 't''q'}\n", "study.yaml:8:19: error: ");
    expect_at("motion: {heave: 't\n   *q'}\n", "study.yaml:9:5: error: ");
    expect_at("motion: {heave: \"t\r\n  *q\"}\n", "study.yaml:9:4: error: ");
    expect_at("motion: {heave: \"t \\\n  *q\"}\n", "study.yaml:9:4: error: ");
    expect_at("motion:\n  heave: t\n    *q\n", "study.yaml:10:6: error: ");
}
END_TEST

START_TEST(lines_may_end_in_cr) {
    char text[2000];
    snprintf(text, sizeof text, "%stitel: x\n", good_study);
    for (char *at = text; *at; at++)
        if (*at == '\n') *at = '\r';
    expect_said(text, "study.yaml:8:1: error: unknown key `titel`");
    expect_said("# nothing\r", "study.yaml:2:1: error: the study is empty");
}
END_TEST

START_TEST(long_words_are_cut_in_messages) {
    expect_at("control: {stiffness: aaaaaaaaaabbbbbbbbbbccccccccccddddddddddeeee}\n",
              "found `aaaaaaaaaabbbbbbbbbbccccccccccdddddddddd…`");
}
END_TEST

START_TEST(messages_need_not_be_taken) {
    gough_study *study = NULL;
    ck_assert_int_eq(gough_study_parse("a.yaml", "a: 1\n", 5, NULL, 0, &study, NULL),
                     GOUGH_ERROR_INPUT);
    ck_assert_ptr_null(study);
}
END_TEST

/* What is no formula cut in two is left as it stands. */
START_TEST(only_a_formula_cut_at_its_comma_is_joined) {
    reading made = expect_good("motion: {heave: atan2(t,\r\n 1), roll: ramp(t, 2)}\n", NULL);
    reading_free(&made);
    made = expect_good("disturbance: {force: [ramp(t,\t1), 0, 0]}\n", NULL);
    reading_free(&made);
    expect_at("disturbance: {force: [t)+(t, 1), 0]}\n", "study.yaml:8:24: error: ");
    expect_at("disturbance: {force: [ramp(t, # a comment\n  2), 0, 0]}\n",
              "study.yaml:8:29: error: ");
    expect_at("disturbance: {force: [ramp(t, [1]), 0]}\n", "study.yaml:8");
    expect_at("disturbance: {force: [ramp(t, 1)), 0, 0]}\n", "study.yaml:8");
    expect_at("motion: {heave: ramp(t, 2): , yaw: 1}\n", "study.yaml:8");
}
END_TEST

START_TEST(settings_are_refused_at_their_key) {
    static const char *const each[][2] = {
        {"keys.x=1", "unknown key `keys`"},
        {"motion.keys.x=1", "unknown key `keys`"},
        {"platform.sweep.keys.x=1", "unknown key `sweep`"},
        {"load.inertia.99999999=1", "there is no element `99999999` in this list of 3"},
        {"load.inertia.x1=1", "there is no element `x1` in this list of 3"},
        {"load.inertia.-1=1", "there is no element `-1` in this list of 3"},
        {"load.inertia.:=1", "there is no element `:` in this list of 3"},
        {"load.inertia.0=1", "there is no element `0` in this list of 3"},
        {".load=1", "a key such as control.stiffness was expected before the ="},
        {"load.=1", "a key such as control.stiffness was expected before the ="},
        {"load..mass=1", "a key such as control.stiffness was expected before the ="},
        {"=1", "a key such as control.stiffness was expected before the ="}};
    for (size_t i = 0; i < sizeof each / sizeof each[0]; i++) {
        reading made = read_more("", SETTINGS(each[i][0]));
        ck_assert_int_eq(made.status, GOUGH_ERROR_INPUT);
        ck_assert_msg(strncmp(made.messages, "--set ", 6) == 0 && strstr(made.messages, each[i][1]),
                      "%s: %s", each[i][0], made.messages);
        reading_free(&made);
    }
}
END_TEST

START_TEST(a_setting_without_a_value_takes_a_key_of_a_move_away) {
    static const char moves[] = "motion: {moves: [{start: 1, duration: 2, heave: 0.1}]}\n";
    reading made = read_more(moves, SETTINGS("motion.moves.1.roll="));
    ck_assert_msg(made.status == GOUGH_OK, "%s", made.messages ? made.messages : "");
    reading_free(&made);
    made = read_more(moves, SETTINGS("motion.moves.1.rol="));
    ck_assert_int_eq(made.status, GOUGH_ERROR_INPUT);
    ck_assert_ptr_nonnull(strstr(made.messages, "unknown key `rol`; did you mean `roll`?"));
    reading_free(&made);
    made = read_more("", SETTINGS("control.stifness="));
    ck_assert_int_eq(made.status, GOUGH_ERROR_INPUT);
    ck_assert_ptr_nonnull(strstr(made.messages, "did you mean `stiffness`?"));
    reading_free(&made);
}
END_TEST

START_TEST(a_second_document_is_found_after_its_end_mark) {
    expect_said("a: 1 # v.1 .\n... \r\n\nb: 2\n", "study.yaml:4:1: error: a second document");
    expect_said("a: 1\n...\nb: 2\n", "study.yaml:3:1: error: a second document");
}
END_TEST

/* The mark takes no column, and a message about the whole record stands at its first character. */
START_TEST(a_record_with_a_mark_and_without_a_spline_is_refused_at_its_beginning) {
    static const char csv[] = "\xEF\xBB\xBFt,heave\n0,0\n1,1e308\n2,-1e308\n3,1e308\n";
    char text[1000], *path = write_file("motion.csv", csv, sizeof csv - 1);
    snprintf(text, sizeof text, "%smotion: {samples: '%s'}\nsimulation: {duration: 1}\n",
             good_study, path);
    expect_said(text, "motion.csv:1:1: error: ");
    forget_file(path);
}
END_TEST

int main(void) {
    return SUITE_RUN("study/characters", 30, each_escape_is_one_character,
                     doubled_quotes_and_folded_lines_are_counted_as_they_stand, lines_may_end_in_cr,
                     long_words_are_cut_in_messages, messages_need_not_be_taken,
                     only_a_formula_cut_at_its_comma_is_joined, settings_are_refused_at_their_key,
                     a_setting_without_a_value_takes_a_key_of_a_move_away,
                     a_second_document_is_found_after_its_end_mark,
                     a_record_with_a_mark_and_without_a_spline_is_refused_at_its_beginning);
}
