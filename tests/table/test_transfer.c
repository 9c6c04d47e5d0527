/* Reading in a child process: whatever a reader does there, the caller gets a table or a message. */
#define _XOPEN_SOURCE 700
#include <signal.h>

#include "support/suite.h"
#include "table/by_hand.h"
#include "table/child_reader.h"
#include "table/table.h"

static gough_status reads_well(const char *path, gough_table *table, gough_error *error) {
    (void)path;
    (void)error;
    if (!result_table_shape(table, 2, 3)) return GOUGH_ERROR_FILE;
    for (int c = 0; c < 2; c++) {
        table->name[c] = strdup(c == 0 ? "t" : "x");
        table->unit[c] = strdup(c == 0 ? "s" : "");
        for (int r = 0; r < 3; r++) table->value[c][r] = 10.0 * c + r;
    }
    table->title = strdup("a title");
    table->verb = strdup("");
    table->end_cause = strdup("done");
    table->end_time = 2.5;
    return GOUGH_OK;
}

static gough_status complains(const char *path, gough_table *table, gough_error *error) {
    (void)table;
    return gough_fail(error, GOUGH_ERROR_INPUT, "%s: not to my taste", path);
}

static gough_status crashes(const char *path, gough_table *table, gough_error *error) {
    (void)path, (void)table, (void)error;
    raise(SIGSEGV);
    return GOUGH_OK;
}

static gough_status aborts(const char *path, gough_table *table, gough_error *error) {
    (void)path, (void)table;
    fputs("talk of a dying library\n", stderr);
    gough_fail(error, GOUGH_OK, "never seen");
    abort();
}

static gough_status leaves(const char *path, gough_table *table, gough_error *error) {
    (void)path, (void)table, (void)error;
    _exit(0);
}

static gough_status runs_out_of_time(const char *path, gough_table *table, gough_error *error) {
    (void)path, (void)table, (void)error;
    raise(SIGXCPU);
    return GOUGH_OK;
}

START_TEST(a_table_comes_through) {
    gough_table *table = calloc(1, sizeof *table);
    gough_error error = {.message = ""};
    ck_assert_int_eq(result_read_in_child(reads_well, "file", table, &error), GOUGH_OK);
    ck_assert_uint_eq(table->rows, 3);
    ck_assert_uint_eq(table->columns, 2);
    ck_assert_str_eq(table->name[1], "x");
    ck_assert_str_eq(table->unit[0], "s");
    ck_assert_str_eq(table->title, "a title");
    ck_assert_str_eq(table->end_cause, "done");
    ck_assert(fabs(table->end_time - 2.5) <= 0.0);
    ck_assert(fabs(table->value[1][2] - 12.0) <= 0.0);
    gough_table_free(table);
}
END_TEST

static void expect_message(result_reader *reader, const char *message) {
    gough_table *table = calloc(1, sizeof *table);
    gough_error error = {.message = ""};
    ck_assert_int_eq(result_read_in_child(reader, "file", table, &error), GOUGH_ERROR_INPUT);
    ck_assert_str_eq(error.message, message);
    gough_table_free(table);
}

START_TEST(a_message_comes_through) { expect_message(complains, "file: not to my taste"); }
END_TEST

START_TEST(a_death_is_a_message) {
    static const char *const message = "file: the HDF5 library cannot read it; the file is damaged";
    expect_message(crashes, message);
    expect_message(aborts, message);
    expect_message(leaves, message);
    expect_message(runs_out_of_time, message);
}
END_TEST

int main(void) {
    return SUITE_RUN("table/transfer", 30, a_table_comes_through, a_message_comes_through,
                     a_death_is_a_message);
}
