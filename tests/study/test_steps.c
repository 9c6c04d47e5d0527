/* In which step a recorded column is written, from its digits or as counts of an instrument; and what is remarked on it. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "study/helpers.h"
#include "support/suite.h"

enum { MOST = 200 };
static const double COUNT = 10.0 / 4096; /* of a converter of 12 bits over 10 m */

/* Reads a study with a record in a file; `how`: more keys of the motion. */
static reading read_record(const char *csv, const char *how) {
    char text[2000], *path = write_file("motion.csv", csv, strlen(csv));
    snprintf(text, sizeof text, "%smotion: {samples: '%s'%s}\nsimulation: {duration: 1}\n",
             good_study, path, how);
    reading made = read_bytes(text, strlen(text), NULL);
    ck_assert_msg(made.status == GOUGH_OK, "%s", made.messages ? made.messages : "");
    forget_file(path);
    return made;
}

/* The step that is found in a column of these counts, written with six decimals. */
static double step_of_counts(const double *count, int rows) {
    char csv[40 * MOST] = "t,heave\n";
    for (int i = 0; i < rows; i++) sprintf(csv + strlen(csv), "%d,%.6f\n", i, count[i] * COUNT);
    reading made = read_record(csv, "");
    const double step = made.study->record->column[GOUGH_HEAVE].step;
    reading_free(&made);
    return step;
}

static void expect_counts(const double *count, int rows) {
    const double step = step_of_counts(count, rows);
    ck_assert_msg(fabs(step - COUNT) <= 1e-6, "step %g", step);
}

static void expect_digits(const double *count, int rows) {
    const double step = step_of_counts(count, rows);
    ck_assert_msg(fabs(step - 1e-6) <= 1e-12, "step %g", step);
}

START_TEST(counts_are_found_where_values_jitter) {
    double count[MOST];
    for (int i = 0; i < 60; i++) count[i] = 3 * i + (i * i) % 7;
    expect_counts(count, 60);
    count[59] += 1000; /* a jump is no reason to doubt them */
    expect_counts(count, 60);
}
END_TEST

START_TEST(values_far_apart_are_no_counts) {
    double count[MOST];
    for (int i = 0; i < 20; i++) count[i] = (i * 7) % 20;
    for (int i = 20; i < 80; i++) count[i] = 100 * i + (i * 7) % 5;
    expect_digits(count, 80);
}
END_TEST

START_TEST(smooth_curves_are_no_counts) {
    double count[MOST];
    for (int i = 0; i < 30; i++) count[i] = i * i; /* no third differences */
    expect_digits(count, 30);
    /* third differences of one sign */
    for (int i = 1, rise = 1; i < 30; i++) {
        count[i] = count[i - 1] + rise;
        rise += i / 6;
    }
    expect_digits(count, 30);
}
END_TEST

START_TEST(exponents_of_any_size_are_digits_too) {
    reading made = read_record("t,heave\n0,0e999\n1,1E-999\n2,1\n3,1e-3\n", "");
    ck_assert(isfinite(made.study->record->column[GOUGH_HEAVE].step));
    reading_free(&made);
}
END_TEST

START_TEST(times_of_fifteen_digits_are_exact) {
    reading made = read_record("t,heave\n0,0\n0.100000000000001,1\n0.250000000000003,0\n"
                               "0.410000000000007,1\n1.500000000000001,0\n",
                               "");
    ck_assert(made.study->record->time_step <= 0);
    ck_assert(!made.study->record->even);
    reading_free(&made);
}
END_TEST

static const char *remark_with(const reading *made, const char *part) {
    const gough_record *record = made->study->record;
    for (size_t i = 0; i < record->remarks; i++)
        if (strstr(record->remark[i].sentence, part)) return record->remark[i].sentence;
    return NULL;
}

/* rows at 0.01 or so, uneven, of values with all their digits */
START_TEST(times_alone_may_be_what_is_rounded) {
    char csv[60 * MOST] = "t,heave\n";
    for (int i = 0; i < 60; i++)
        sprintf(csv + strlen(csv), "%.2f,%.17g\n", 0.03 * i + 0.01 * ((i * 7) % 3), sin(0.03 * i));
    reading made = read_record(csv, "");
    ck_assert(made.study->record->column[GOUGH_HEAVE].step <= 0);
    ck_assert_msg(remark_with(&made, "times in steps of 0.01 for a moving heave"), "%s",
                  made.study->record->remark[0].sentence);
    reading_free(&made);
}
END_TEST

START_TEST(what_smoothing_leaves_is_still_remarked_on) {
    char csv[60 * MOST] = "t,heave\n";
    for (int i = 0; i <= 100; i++)
        sprintf(csv + strlen(csv), "%.2f,%.2f\n", 0.01 * i, 0.02 * sin(0.1 * i));
    reading made = read_record(csv, ", cutoff: 30");
    const char *sentence = remark_with(&made, "can still make accelerations");
    ck_assert_ptr_nonnull(sentence);
    ck_assert_ptr_nonnull(strstr(sentence, "lower `motion.cutoff`"));
    reading_free(&made);
}
END_TEST

/* Near the pole roll and yaw turn together while the platform hardly turns. */
START_TEST(only_angles_are_about_turned_axes) {
    char csv[60 * MOST] = "t,heave,roll,pitch,yaw\n";
    for (int i = 0; i <= 60; i++)
        sprintf(csv + strlen(csv), "%.1f,%.2f,%.3f,89,%.3f\n", 0.1 * i, 0.02 * sin(0.3 * i),
                60 * sin(1.7 * i), 60 * sin(1.7 * i));
    reading made = read_record(csv, "");
    ck_assert(made.study->record->turned);
    ck_assert_ptr_nonnull(remark_with(&made, "has values of heave in steps of 0.01"));
    ck_assert_ptr_null(remark_with(&made, "heave about turned axes"));
    reading_free(&made);
}
END_TEST

/* 7 rows a second, with times of two decimals that are read as equal steps: only the values are rounded then. */
START_TEST(times_read_as_equal_steps_are_not_remarked_on) {
    char csv[60 * MOST] = "t,heave\n";
    for (int i = 0; i < 20; i++)
        sprintf(csv + strlen(csv), "%.2f,%.2f\n", i / 7.0, 0.02 * sin(0.3 * i));
    reading made = read_record(csv, ", smooth: rounding");
    ck_assert(made.study->record->retimed);
    const char *sentence = remark_with(&made, "has values of heave in steps of 0.01");
    ck_assert_ptr_nonnull(sentence);
    ck_assert_msg(!strstr(sentence, "and times in steps"), "%s", sentence);
    reading_free(&made);
}
END_TEST

/* Near every pole, but slowly: roll turns round and round while pitch and yaw creep, and no two rows are far apart. */
START_TEST(slow_angles_near_all_poles_are_as_they_are) {
    enum { ROWS = 4000 };
    char *csv = malloc(60 * ROWS), *end = csv;
    ck_assert_ptr_nonnull(csv);
    end += sprintf(end, "t,roll,pitch,yaw\n");
    for (int i = 0; i < ROWS; i++)
        end += sprintf(end, "%d,%d,%.2f,%.2f\n", i, 10 * i, 89 * sin(0.01 * i), 0.5 * i);
    reading made = read_record(csv, "");
    ck_assert(!made.study->record->turned);
    ck_assert_ptr_null(remark_with(&made, "yaw changes by"));
    reading_free(&made);
    free(csv);
}
END_TEST

int main(void) {
    return SUITE_RUN(
        "study/steps", 30, counts_are_found_where_values_jitter, values_far_apart_are_no_counts,
        smooth_curves_are_no_counts, exponents_of_any_size_are_digits_too,
        times_of_fifteen_digits_are_exact, times_alone_may_be_what_is_rounded,
        what_smoothing_leaves_is_still_remarked_on, only_angles_are_about_turned_axes,
        times_read_as_equal_steps_are_not_remarked_on, slow_angles_near_all_poles_are_as_they_are);
}
