/* HDF5 files of many rows are written in stretches: every number is where it belongs, a write that fails at any place leaves
 * nothing behind, and the library works afterwards.
 * Not sanitized: reading back takes a child process with limits of its own */
#define _GNU_SOURCE
#include <errno.h>
#include <math.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include "gough/result.h"
#include "support/suite.h"
#include "table/by_hand.h"

enum {
    COLUMNS = 30,
    ROWS = 60000
}; /* a stretch has 2^19 / 30 rows: four of them, the last one short */

static double number_of(size_t column, size_t row) { return (double)row + (double)column / 64.0; }

/* A table of numbers that tell their place. */
static gough_table *new_table(size_t rows) {
    gough_table *table = gough_table_new("many rows", "test", COLUMNS, rows);
    ck_assert_ptr_nonnull(table);
    for (size_t c = 0; c < COLUMNS; c++) {
        char name[8];
        snprintf(name, sizeof name, "c%zu", c);
        double *value = gough_table_name(table, c, name, "m");
        ck_assert_ptr_nonnull(value);
        for (size_t r = 0; r < rows; r++) value[r] = number_of(c, r);
    }
    return table;
}

static off_t size_of(const char *path) {
    struct stat about;
    return stat(path, &about) == 0 ? about.st_size : -1;
}

START_TEST(every_number_of_every_stretch_is_in_its_place) {
    char folder[PATH_SIZE], path[PATH_SIZE];
    gough_error error;
    make_folder(folder);
    path_in(folder, "a.h5", path);
    gough_table *table = new_table(ROWS), *read = NULL;
    ck_assert_int_eq(gough_table_write(table, "text", path, &error), GOUGH_OK);
    ck_assert_int_eq(gough_table_read(path, &read, &error), GOUGH_OK);
    ck_assert_uint_eq(read->rows, ROWS);
    ck_assert_uint_eq(read->columns, COLUMNS);
    size_t right = 0;
    for (size_t c = 0; c < COLUMNS; c++)
        for (size_t r = 0; r < ROWS; r++) right += fabs(read->value[c][r] - number_of(c, r)) <= 0.0;
    ck_assert_uint_eq(right, (size_t)COLUMNS * ROWS);
    gough_table_free(read);
    gough_table_free(table);
    remove_folder(folder);
}
END_TEST

/* The largest file that the process may write, in place of a full disk. */
START_TEST(a_write_that_fails_leaves_nothing) {
    char folder[PATH_SIZE], path[PATH_SIZE];
    gough_error error;
    struct rlimit before;
    make_folder(folder);
    path_in(folder, "a.h5", path);
    gough_table *table = new_table(ROWS);
    ck_assert_int_eq(gough_table_write(table, "text", path, &error), GOUGH_OK);
    const off_t whole = size_of(path);
    ck_assert(whole > (off_t)(8 * COLUMNS * ROWS));
    signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before);
    unlink(path);
    const off_t place[] = {0, 1000, 3000, 100000, whole / 3, whole / 2, whole - 5000, whole - 1};
    for (size_t i = 0; i < sizeof place / sizeof *place; i++) {
        setrlimit(RLIMIT_FSIZE, &(struct rlimit){(rlim_t)place[i], before.rlim_max});
        ck_assert_int_eq(gough_table_write(table, "text", path, &error), GOUGH_ERROR_FILE);
        ck_assert_msg(strstr(error.message, "cannot write: File too large") != NULL, "%s",
                      error.message);
        ck_assert_int_eq(size_of(path), -1);
    }
    setrlimit(RLIMIT_FSIZE, &before);
    ck_assert_int_eq(gough_table_write(table, "text", path, &error), GOUGH_OK);
    ck_assert_int_eq(size_of(path), whole);
    gough_table_free(table);
    unlink(path);
    ck_assert_int_eq(rmdir(folder), 0); /* nothing else is in it */
}
END_TEST

int main(void) {
    return SUITE_RUN("table/long", 60, every_number_of_every_stretch_is_in_its_place,
                     a_write_that_fails_leaves_nothing);
}
