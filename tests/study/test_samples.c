/* Recorded motion: what is read of a CSV file, and every way in which one can be wrong, with its place. */
#define _POSIX_C_SOURCE 200809L
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "study/helpers.h"
#include "support/suite.h"

static const double pi = 3.14159265358979323846;

/* Reads a study with these samples beside it. */
static reading read_with(const char *csv, size_t length, char **path) {
    char text[1000];
    reading made = {GOUGH_OK, NULL, NULL};
    *path = write_file("motion.csv", csv, length);
    snprintf(text, sizeof text, "%smotion: {samples: '%s'}\nsimulation: {duration: 1}\n",
             good_study, *path);
    made = read_bytes(text, strlen(text), NULL);
    return made;
}

static void expect_csv(const char *csv, size_t length, const char *messages) {
    char expected[4000] = "", *path;
    reading made = read_with(csv, length, &path);
    /* @ in the expected text stands for the file's path */
    for (const char *c = messages; *c; c++)
        snprintf(expected + strlen(expected), sizeof expected - strlen(expected), "%.*s",
                 *c == '@' ? (int)strlen(path) : 1, *c == '@' ? path : c);
    ck_assert_int_eq(made.status, GOUGH_ERROR_INPUT);
    ck_assert_str_eq(made.messages, expected);
    reading_free(&made);
    forget_file(path);
}

#define EXPECT_CSV(csv, messages) expect_csv(csv, sizeof(csv) - 1, messages)

START_TEST(reads_columns_in_any_order) {
    static const char csv[] = "yaw,t,heave\n0,-0.5,0\n 45 ,\t0.5,0.25\n90,1.5,1\n+45,2.5,2.25";
    char *path;
    reading made = read_with(csv, sizeof csv - 1, &path);
    ck_assert_msg(made.status == GOUGH_OK, "%s", made.messages ? made.messages : "");
    const gough_motion *motion = &made.study->model->motion;
    ck_assert_int_eq(motion->kind, GOUGH_MOTION_SAMPLES);
    ck_assert_uint_eq(motion->samples.count, 4);
    ck_assert(fabs(motion->samples.time[3] - 2.5) <= 0);
    double component[GOUGH_COMPONENTS][3];
    gough_motion_evaluate(motion, 0.5, component);
    ck_assert(fabs(component[GOUGH_HEAVE][0] - 0.25) <= 1e-15);
    ck_assert(fabs(component[GOUGH_YAW][0] - pi / 4) <= 1e-15);
    ck_assert(fabs(component[GOUGH_SURGE][0]) <= 0);
    /* heave is (t + 0.5)^2 / 4, which a cubic spline gives back between the rows */
    gough_motion_evaluate(motion, 1, component);
    ck_assert(fabs(component[GOUGH_HEAVE][0] - 0.5625) <= 1e-14);
    ck_assert(fabs(component[GOUGH_HEAVE][2] - 0.5) <= 1e-13);
    reading_free(&made);
    forget_file(path);
}
END_TEST

START_TEST(accepts_cr_lf_and_byte_order_mark) {
    static const char *const files[] = {"\xEF\xBB\xBFt,heave\n0,1\n1,2\n",
                                        "t,heave\r\n0,1\r\n1,2\r\n",
                                        "\xEF\xBB\xBFt,heave\r\n0,1\r\n1,2"};
    for (size_t i = 0; i < 3; i++) {
        char *path;
        reading made = read_with(files[i], strlen(files[i]), &path);
        ck_assert_msg(made.status == GOUGH_OK, "%s", made.messages ? made.messages : "");
        ck_assert_uint_eq(made.study->model->motion.samples.count, 2);
        reading_free(&made);
        forget_file(path);
    }
}
END_TEST

START_TEST(accepts_empty_lines_at_the_end) {
    static const char *const csv[] = {"t,heave\n0,0\n1,2\n\n", "t,heave\n0,0\n1,2\n\n\n\n",
                                      "t,heave\r\n0,0\r\n1,2\r\n\r\n\r\n"};
    for (size_t i = 0; i < sizeof csv / sizeof csv[0]; i++) {
        char *path;
        reading made = read_with(csv[i], strlen(csv[i]), &path);
        ck_assert_msg(made.status == GOUGH_OK, "%s", made.messages ? made.messages : "");
        ck_assert_uint_eq(made.study->model->motion.samples.count, 2);
        reading_free(&made);
        forget_file(path);
    }
}
END_TEST

START_TEST(path_starts_from_the_folder_of_the_study) {
    char text[1000], name[600], *path = write_file("near.csv", "t,heave\n0,1\n20,2\n", 17);
    gough_study *study = NULL;
    char *messages = NULL;
    snprintf(text, sizeof text, "%smotion: {samples: near.csv}\n", good_study);
    snprintf(name, sizeof name, "%.*sstudy.yaml", (int)(strrchr(path, '/') + 1 - path), path);
    const gough_status status =
        gough_study_parse(name, text, strlen(text), NULL, 0, &study, &messages);
    ck_assert_msg(status == GOUGH_OK, "%s", messages ? messages : "");
    gough_study_free(study);
    forget_file(path);
}
END_TEST

START_TEST(a_missing_file_is_a_file_error_at_the_key) {
    reading made = read_more("motion:\n  samples: no-such.csv\n", NULL);
    ck_assert_int_eq(made.status, GOUGH_ERROR_FILE);
    ck_assert_str_eq(
        made.messages,
        "study.yaml:9:12: error: cannot open `no-such.csv`: No such file or directory\n"
        "  samples: no-such.csv\n"
        "           ^\n");
    reading_free(&made);
    /* an error in the study besides makes it an error in input */
    made = read_more("motion:\n  samples: no-such.csv\nunit: si\n", NULL);
    ck_assert_int_eq(made.status, GOUGH_ERROR_INPUT);
    ck_assert_int_eq(occurrences(made.messages, ": error: "), 2);
    reading_free(&made);
    made = read_more("motion:\n  samples: /dev/zero\n", NULL);
    ck_assert_int_eq(made.status, GOUGH_ERROR_FILE);
    ck_assert_ptr_nonnull(
        strstr(made.messages, "`/dev/zero` is a device; a regular file is needed"));
    reading_free(&made);
}
END_TEST

START_TEST(refuses_wrong_headers) {
    EXPECT_CSV("", "@:1:1: error: the first row must name the columns, as in t,heave\n\n^\n");
    EXPECT_CSV("t,heav\n0,0\n1,1\n",
               "@:1:3: error: there is no motion: a column such as heave is needed besides t; its "
               "columns are 1 `t`, 2 `heav` (did you mean `heave`?); say which are which in "
               "`motion`, as in samples: {file: '@', time: {column: \"t\"}, columns: {heave: "
               "{column: \"heav\"}}}\nt,heav\n  ^\n");
    EXPECT_CSV("t,heave,zzz\n0,0,0\n",
               "@:1:9: error: not all columns of this record are certain; its columns are 1 `t`, 2 "
               "`heave`, 3 `zzz` (unknown); say which are which in `motion`, as in samples: {file: "
               "'@', time: {column: \"t\"}, columns: {heave: {column: \"heave\"}}}\n"
               "t,heave,zzz\n        ^\n");
    EXPECT_CSV(
        "t,heave,heave\n0,0,0\n",
        "@:1:9: error: not all columns of this record are certain; its columns are 1 `t`, 2 "
        "`heave`, 3 `heave` (a second one of that name); say which are which in `motion`, as "
        "in samples: {file: '@', time: {column: \"t\"}, columns: {heave: {column: 2}}}\n"
        "t,heave,heave\n        ^\n");
    EXPECT_CSV("t,,heave\n0,0,0\n",
               "@:1:3: error: not all columns of this record are certain; its columns are 1 `t`, 2 "
               "(unknown), 3 `heave`; say which are which in `motion`, as in samples: {file: '@', "
               "time: {column: \"t\"}, columns: {heave: {column: \"heave\"}}}\nt,,heave\n  ^\n");
    EXPECT_CSV("heave,yaw\n0,0\n",
               "@:1:1: error: the column t, the time, is missing; its columns are 1 `heave`, 2 "
               "`yaw`; say which are which in `motion`, as in samples: {file: '@', time: {step: "
               "0.01}, columns: {heave: {column: \"heave\"}, yaw: {column: \"yaw\"}}}\n"
               "heave,yaw\n^\n");
    EXPECT_CSV(
        "t\n0\n1\n",
        "@:1:1: error: there is no motion: a column such as heave is needed besides t; its "
        "columns are 1 `t`; say which are which in `motion`, as in samples: {file: '@', time: "
        "{column: \"t\"}, columns: {}}\nt\n^\n");
    EXPECT_CSV(
        "0,1\n1,2\n",
        "@:1:1: error: no row names the columns of this record; its columns are 1, 2; say "
        "which are which in `motion`, as in samples: {file: '@', time: {column: 1}, columns: "
        "{heave: {column: 2}}}\n0,1\n^\n");
}
END_TEST

/* a column that is not certain is in the one list of all columns */
START_TEST(names_all_wrong_columns_at_once) {
    EXPECT_CSV(
        "time,heav,zzz,t,roll,roll,,yaw_deg\n0,0,0,0,0,0,0,0\n",
        "@:1:6: error: not all columns of this record are certain; its columns are 1 `time`, "
        "2 `heav` (did you mean `heave`?), 3 `zzz` (unknown), 4 `t` (a second one of that "
        "name), 5 `roll`, 6 `roll` (a second one of that name), 7 (unknown), 8 `yaw_deg`; say "
        "which are which in `motion`, as in samples: {file: '@', time: {column: \"time\"}, "
        "columns: {roll: {column: 5}, yaw: {column: \"yaw_deg\", unit: \"deg\"}}}\n"
        "time,heav,zzz,t,roll,roll,,yaw_deg\n     ^\n");
    char csv[4000] = "t", *path;
    for (int i = 0; i < 200; i++) sprintf(csv + strlen(csv), ",column %d", i);
    for (int row = 0; row < 2; row++)
        for (int i = 0; i <= 200; i++) sprintf(csv + strlen(csv), "%s%d", i ? "," : "\n", row);
    reading made = read_with(csv, strlen(csv), &path);
    ck_assert_int_eq(occurrences(made.messages, ": error: "), 1);
    ck_assert_ptr_nonnull(strstr(made.messages, " … 201; say which are which in `motion`"));
    reading_free(&made);
    forget_file(path);
}
END_TEST

START_TEST(names_may_stand_in_quotes_at_both_ends) {
    char *path;
    reading made = read_with("\"t\",\"heave\"\n0,1\n1,2\n", 20, &path);
    ck_assert_int_eq(made.status, GOUGH_OK);
    reading_free(&made);
    forget_file(path);
    made = read_with("t,\"heave\n0,1\n1,2\n", 17, &path);
    ck_assert_int_eq(made.status, GOUGH_ERROR_INPUT);
    ck_assert_ptr_nonnull(strstr(made.messages, "motion.csv:1:3: error: there is no motion"));
    reading_free(&made);
    forget_file(path);
    made = read_with("t,\"\n0,1\n1,2\n", 12, &path);
    ck_assert_int_eq(made.status, GOUGH_ERROR_INPUT);
    reading_free(&made);
    forget_file(path);
}
END_TEST

/* of times with no decimal, one, and more than help */
START_TEST(times_with_few_decimals_are_told) {
    static const char *const csv[] = {"t,heave\n0,0\n0,1\n", "t,heave\n0.1,0\n0.1,1\n",
                                      "t,heave\n-0.1,0\n-0.1,1\n",
                                      "t,heave\n-0.1234567891,0\n-0.1234567891,1\n"};
    for (int i = 0; i < 4; i++) {
        char *path;
        reading made = read_with(csv[i], strlen(csv[i]), &path);
        ck_assert_int_eq(made.status, GOUGH_ERROR_INPUT);
        ck_assert_int_eq(strstr(made.messages, "rounded to 1 decimal, record more digits") != NULL,
                         i == 1 || i == 2);
        reading_free(&made);
        forget_file(path);
    }
}
END_TEST

START_TEST(refuses_more_than_two_million_rows) {
    enum { LINES = 2000003 };
    char *path, *csv = malloc(8 + LINES);
    ck_assert_ptr_nonnull(csv);
    memcpy(csv, "t,heave\n", 8);
    memset(csv + 8, '\n', LINES);
    reading made = read_with(csv, 8 + LINES, &path);
    ck_assert_int_eq(made.status, GOUGH_ERROR_INPUT);
    ck_assert_ptr_nonnull(strstr(made.messages, "motion.csv:1:1: error: more than 2 000 000 rows"));
    reading_free(&made);
    forget_file(path);
    free(csv);
}
END_TEST

START_TEST(refuses_wrong_rows_all_at_once) {
    EXPECT_CSV("t,heave\n0,0\n1\n2,1,1\n3,high\n4,\n5,1e999\n6,.nan\n\n7,1 m\n8,0x1\n",
               "@:3:2: error: this row ends after 1 of 2 cells\n1\n ^\n"
               "@:4:5: error: this row has more cells than the 2 columns of the first row\n2,1,1\n"
               "    ^\n"
               "@:5:3: error: `high` is not a number\n3,high\n  ^\n"
               "@:6:3: error: an empty cell; a number was expected\n4,\n  ^\n"
               "@:7:3: error: `1e999` is not finite\n5,1e999\n  ^\n"
               "@:8:3: error: `.nan` is not finite\n6,.nan\n  ^\n"
               "@:9:1: error: an empty line between the rows\n\n^\n"
               "@:10:3: error: `1 m` is not a number\n7,1 m\n  ^\n"
               "@:11:3: error: `0x1` is not a number\n8,0x1\n  ^\n");
}
END_TEST

START_TEST(refuses_times_that_do_not_increase) {
    EXPECT_CSV("t,heave\n0,0\n1,0\n1,0\n0.5,0\n2,0\n",
               "@:4:1: error: the time 1 must be greater than 1 in the row before\n1,0\n^\n"
               "@:5:1: error: the time 0.5 must be greater than 1 in the row before\n0.5,0\n^\n");
    EXPECT_CSV("t,heave\n0.00,0\n0.01,0\n0.01,0\n0.02,0\n",
               "@:4:1: error: the time 0.01 must be greater than 0.01 in the row before; if the "
               "times are rounded to 2 decimals, record more digits\n"
               "0.01,0\n"
               "^\n");
    EXPECT_CSV(
        "heave,t\n0,0.5\n0,1\n",
        "@:2:3: error: the record must begin at time 0 or before, because a run begins at 0; with "
        "`from: first` in `motion.samples.time` times count from the first row\n"
        "0,0.5\n"
        "  ^\n");
}
END_TEST

START_TEST(refuses_fewer_than_two_rows) {
    EXPECT_CSV("t,heave\n", "@:2:1: error: at least two rows of numbers are needed\n\n^\n");
    EXPECT_CSV("t,heave\n0,0\n", "@:3:1: error: at least two rows of numbers are needed\n\n^\n");
    EXPECT_CSV("t,heave", "@:1:8: error: at least two rows of numbers are needed\nt,heave\n       "
                          "^\n");
}
END_TEST

START_TEST(refuses_nul_bytes_and_garbage) {
    EXPECT_CSV("t,heave\n0,0\n1,\0\n", "@:3:3: error: `\\x00` is not a number\n1,\\x00\n  ^\n");
    static const char *const csv[] = {"\x7f"
                                      "ELF\x02\x01\x01\0\0",
                                      "t\0,heave\n0,0\n"};
    static const size_t length[] = {9, 14};
    static const char *const shown[] = {"1 `\\x7fELF\\x02\\x01\\x01\\x01\\x01` (unknown)",
                                        "1 `t\\x01` (unknown), 2 `heave`"};
    for (size_t i = 0; i < 2; i++) {
        char *path;
        reading made = read_with(csv[i], length[i], &path);
        ck_assert_int_eq(made.status, GOUGH_ERROR_INPUT);
        ck_assert_msg(strstr(made.messages, shown[i]) != NULL, "%s", made.messages);
        reading_free(&made);
        forget_file(path);
    }
}
END_TEST

START_TEST(stops_after_twenty_errors) {
    char csv[2000] = "t,heave\n", *path;
    for (int i = 0; i < 50; i++) sprintf(csv + strlen(csv), "%d,x\n", i);
    reading made = read_with(csv, strlen(csv), &path);
    ck_assert_int_eq(occurrences(made.messages, "is not a number"), 20);
    ck_assert_ptr_nonnull(
        strstr(made.messages, ":22:1: error: too many errors; the rest of the file was not read"));
    reading_free(&made);
    forget_file(path);
}
END_TEST

START_TEST(refuses_a_run_beyond_the_record) {
    char *path, text[1000];
    static const char csv[] = "t,heave\n0,0\n1,1\n";
    path = write_file("motion.csv", csv, sizeof csv - 1);
    snprintf(text, sizeof text, "%smotion:\n  samples: '%s'\nsimulation:\n  duration: 2\n",
             good_study, path);
    expect_said(text, "study.yaml:11:3: error: simulation.duration");
    forget_file(path);
}
END_TEST

START_TEST(refuses_more_than_a_gib) {
    char *path = write_file("motion.csv", "t,heave\n", 8), text[1000];
    ck_assert_int_eq(truncate(path, 1024 * 1024 * 1024 + 1L), 0);
    snprintf(text, sizeof text, "%smotion:\n  samples: '%s'\n", good_study, path);
    expect_said(text, "is larger than the 1024 MiB that a record may have");
    forget_file(path);
}
END_TEST

START_TEST(a_hundred_thousand_rows_are_read) {
    const size_t rows = 100000, capacity = 40 * rows;
    char *csv = malloc(capacity), *path;
    ck_assert_ptr_nonnull(csv);
    size_t length = (size_t)sprintf(csv, "t,heave,pitch\n");
    for (size_t i = 0; i < rows; i++)
        length += (size_t)sprintf(csv + length, "%zu.%03zu,0.%05zu,1\n", i / 1000, i % 1000, i);
    reading made = read_with(csv, length, &path);
    ck_assert_msg(made.status == GOUGH_OK, "%s", made.messages ? made.messages : "");
    ck_assert_uint_eq(made.study->model->motion.samples.count, rows);
    reading_free(&made);
    forget_file(path);
    free(csv);
}
END_TEST

int main(void) {
    return SUITE_RUN(
        "study/samples", 60, reads_columns_in_any_order, accepts_cr_lf_and_byte_order_mark,
        accepts_empty_lines_at_the_end, path_starts_from_the_folder_of_the_study,
        a_missing_file_is_a_file_error_at_the_key, refuses_wrong_headers,
        names_all_wrong_columns_at_once, names_may_stand_in_quotes_at_both_ends,
        times_with_few_decimals_are_told, refuses_more_than_two_million_rows,
        refuses_wrong_rows_all_at_once, refuses_times_that_do_not_increase,
        refuses_fewer_than_two_rows, refuses_nul_bytes_and_garbage, stops_after_twenty_errors,
        refuses_a_run_beyond_the_record, refuses_more_than_a_gib, a_hundred_thousand_rows_are_read);
}
