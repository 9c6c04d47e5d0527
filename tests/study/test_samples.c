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
               "@:1:3: error: unknown column `heav`; did you mean `heave`?\nt,heav\n  ^\n");
    EXPECT_CSV("t,heave,zzz\n0,0,0\n",
               "@:1:9: error: unknown column `zzz`; the columns are t, surge, sway, heave, roll, "
               "pitch and yaw\nt,heave,zzz\n        ^\n");
    EXPECT_CSV("t,heave,heave\n0,0,0\n",
               "@:1:9: error: this column appears twice\nt,heave,heave\n        ^\n");
    EXPECT_CSV("t,,heave\n0,0,0\n", "@:1:3: error: a column has no name\nt,,heave\n  ^\n");
    EXPECT_CSV("heave,yaw\n0,0\n",
               "@:1:1: error: the column t, the time, is missing\nheave,yaw\n^\n");
    EXPECT_CSV("t\n0\n1\n",
               "@:1:1: error: there is no motion: a column such as heave is needed besides t\n"
               "t\n"
               "^\n");
    EXPECT_CSV("0,1\n1,2\n", "@:1:1: error: the first row must name the columns, as in t,heave; "
                             "found the number 0\n0,1\n^\n");
    EXPECT_CSV("t;heave\n0;1\n",
               "@:1:1: error: columns are separated by commas, not by semicolons\nt;heave\n^\n");
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
    ck_assert_ptr_nonnull(strstr(made.messages, "motion.csv:1:3: error: unknown column `\"heave`"));
    reading_free(&made);
    forget_file(path);
    made = read_with("t,\"\n0,1\n1,2\n", 12, &path);
    ck_assert_int_eq(made.status, GOUGH_ERROR_INPUT);
    reading_free(&made);
    forget_file(path);
}
END_TEST

/* of a header with many wrong columns, and of times with one decimal or with more than help */
START_TEST(headers_and_times_are_not_complained_of_without_end) {
    static const char *const csv[] = {
        "t,a1,a2,a3,a4,a5,a6,a7,a8,a9,b1,b2,b3,b4,b5,b6,b7,b8,b9,c1,c2,c3,c4,c5\n0,1\n",
        "t,heave\n0.1,0\n0.1,1\n", "t,heave\n-0.1,0\n-0.1,1\n",
        "t,heave\n-0.1234567891,0\n-0.1234567891,1\n"};
    for (int i = 0; i < 4; i++) {
        char *path;
        reading made = read_with(csv[i], strlen(csv[i]), &path);
        ck_assert_int_eq(made.status, GOUGH_ERROR_INPUT);
        if (i == 0) ck_assert_int_eq(occurrences(made.messages, ": error: "), 20);
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

START_TEST(names_all_wrong_columns_at_once) {
    EXPECT_CSV("time,heav,zzz,t,roll,roll,,yaw_deg\n0,0,0,0,0,0,0,0\n",
               "@:1:1: error: unknown column `time`; the columns are t, surge, sway, heave, roll, "
               "pitch and yaw\ntime,heav,zzz,t,roll,roll,,yaw_deg\n^\n"
               "@:1:6: error: unknown column `heav`; did you mean `heave`?\n"
               "time,heav,zzz,t,roll,roll,,yaw_deg\n     ^\n"
               "@:1:11: error: unknown column `zzz`; the columns are t, surge, sway, heave, roll, "
               "pitch and yaw\ntime,heav,zzz,t,roll,roll,,yaw_deg\n          ^\n"
               "@:1:22: error: this column appears twice\n"
               "time,heav,zzz,t,roll,roll,,yaw_deg\n                     ^\n"
               "@:1:27: error: a column has no name\n"
               "time,heav,zzz,t,roll,roll,,yaw_deg\n                          ^\n"
               "@:1:28: error: unknown column `yaw_deg`; the columns are t, surge, sway, heave, "
               "roll, pitch and yaw\n"
               "time,heav,zzz,t,roll,roll,,yaw_deg\n                           ^\n");
    /* eight and more columns are no reason to stop */
    EXPECT_CSV("t,surge,sway,heave,roll,pitch,yaw,speed,heave\n0,0,0,0,0,0,0,0,0\n",
               "@:1:35: error: unknown column `speed`; the columns are t, surge, sway, heave, "
               "roll, pitch and yaw\nt,surge,sway,heave,roll,pitch,yaw,speed,heave\n"
               "                                  ^\n"
               "@:1:41: error: this column appears twice\n"
               "t,surge,sway,heave,roll,pitch,yaw,speed,heave\n"
               "                                        ^\n");
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
        "@:2:3: error: the record must begin at time 0 or before, because a run begins at 0\n"
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
    EXPECT_CSV("\x7f"
               "ELF\x02\x01\x01\0\0",
               "@:1:1: error: unknown column `\\x7fELF\\x02\\x01\\x01\\x00\\x00`; the columns are "
               "t, surge, sway, heave, roll, pitch and yaw\n"
               "\\x7fELF\\x02\\x01\\x01\\x00\\x00\n^\n");
    EXPECT_CSV(
        "t\0,heave\n0,0\n",
        "@:1:1: error: unknown column `t\\x00`; the columns are t, surge, sway, heave, roll, "
        "pitch and yaw\nt\\x00,heave\n^\n");
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

START_TEST(refuses_more_than_64_mib) {
    char *path = write_file("motion.csv", "t,heave\n", 8), text[1000];
    ck_assert_int_eq(truncate(path, 64 * 1024 * 1024 + 1), 0);
    snprintf(text, sizeof text, "%smotion:\n  samples: '%s'\n", good_study, path);
    expect_said(text, "is larger than the 65536 KiB that such a file may have");
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
        headers_and_times_are_not_complained_of_without_end, refuses_more_than_two_million_rows,
        refuses_wrong_rows_all_at_once, refuses_times_that_do_not_increase,
        refuses_fewer_than_two_rows, refuses_nul_bytes_and_garbage, stops_after_twenty_errors,
        refuses_a_run_beyond_the_record, refuses_more_than_64_mib,
        a_hundred_thousand_rows_are_read);
}
