/* Reading a table in parts when memory or the system fails: the same numbers, or a sentence that names the file and the cause.
 * Faults: malloc calloc realloc strdup strndup read write pipe fork H5Dopen2 H5Dget_space H5Screate_simple H5Dread
 * Faults: H5Sselect_hyperslab H5Dget_type H5Dget_create_plist */
#define _GNU_SOURCE
#include <fcntl.h>
#include <hdf5.h>
#include <sys/stat.h>

#include "support/faults.h"
#include "support/suite.h"
#include "table/by_hand.h"
#include "table/child_reader.h"
#include "table/table.h"

FAULTY_MALLOC;
FAULTY_CALLOC;
FAULTY_REALLOC;
FAULTY_STRDUP;
FAULTY_STRNDUP;
FAULTY_READ;
FAULTY_WRITE;
FAULTY(int, pipe, (int ends[2]), -1, ends);
FAULTY(pid_t, fork, (void), -1, );
FAULTY(hid_t, H5Dopen2, (hid_t place, const char *name, hid_t access), -1, place, name, access);
FAULTY(hid_t, H5Dget_space, (hid_t set), -1, set);
FAULTY(hid_t, H5Dget_type, (hid_t set), -1, set);
FAULTY(hid_t, H5Dget_create_plist, (hid_t set), -1, set);
FAULTY(hid_t, H5Screate_simple, (int rank, const hsize_t *now, const hsize_t *most), -1, rank, now,
       most);
FAULTY(herr_t, H5Sselect_hyperslab,
       (hid_t space, H5S_seloper_t how, const hsize_t *from, const hsize_t *stride,
        const hsize_t *count, const hsize_t *block),
       -1, space, how, from, stride, count, block);
FAULTY(herr_t, H5Dread, (hid_t set, hid_t type, hid_t in, hid_t from, hid_t how, void *to), -1, set,
       type, in, from, how, to);

/* more than two parts, and as text more than one piece of a megabyte */
enum { ROWS = 2 * RESULT_PART + 77, COLUMNS = 2, LONG = 3 << 20 };
static const char *const names[COLUMNS] = {"t", "x"};

static double number_at(size_t row, size_t column) { return awkward(row, (int)column); }

static void write_table(const char *path) {
    gough_table *table = gough_table_new("parts", "test", COLUMNS, ROWS);
    gough_error error = {.message = ""};
    for (size_t c = 0; c < COLUMNS; c++) {
        double *value = gough_table_name(table, c, names[c], "m");
        for (size_t r = 0; r < ROWS; r++) value[r] = number_at(r, c);
    }
    ck_assert_msg(gough_table_write(table, NULL, path, &error) == GOUGH_OK, "%s", error.message);
    gough_table_free(table);
}

/* What has come. The sink allocates nothing: its calls would be made to fail. */
typedef struct arrived {
    size_t calls, rows,
        last; /* last: the call after which no more is wanted; 0: none is the last */
    bool right;
} arrived;

static int take(void *context, const gough_table *part) {
    arrived *a = context;
    if (a->calls++ == 0) a->right = part->rows == 0 && part->columns == COLUMNS;
    a->right = a->right && a->rows + part->rows <= ROWS;
    for (size_t c = 0; c < COLUMNS && a->right; c++) {
        a->right = strcmp(part->name[c], names[c]) == 0;
        for (size_t r = 0; r < part->rows; r++)
            a->right = a->right && fabs(part->value[c][r] - number_at(a->rows + r, c)) <= 0;
    }
    a->rows += part->rows;
    return a->calls == a->last;
}

/* Lets each call of the function fail with this errno, one at a time. Where `cause` is NULL all numbers must come in spite of it,
 * else the table may be refused with that. Returns how many calls failed. */
static long let_fail(const char *name, int number, const char *path, const char *cause) {
    for (long n = 1;; n++) {
        arrived a = {.calls = 0};
        gough_error error = {.message = ""};
        fault_arm(name, n, number);
        const gough_status status = gough_table_scan(path, NULL, take, &a, &error);
        const bool came = fault_disarm();
        ck_assert(a.right || a.calls == 0);
        if (status == GOUGH_OK) ck_assert_uint_eq(a.rows, ROWS);
        if (status != GOUGH_OK)
            ck_assert_msg(came && cause && strstr(error.message, cause) &&
                              strstr(error.message, path),
                          "call %ld of %s: %s", n, name, error.message);
        if (!came) return n - 1;
    }
}

START_TEST(without_memory_the_numbers_are_right_or_refused) {
    static const char *const each[] = {"malloc", "calloc", "realloc", "strdup", "strndup"};
    char folder[PATH_SIZE], csv[PATH_SIZE], hdf5[PATH_SIZE];
    make_folder(folder);
    write_table(path_in(folder, "a.csv", csv));
    write_table(path_in(folder, "a.h5", hdf5));
    long calls = 0;
    for (size_t i = 0; i < sizeof each / sizeof each[0]; i++) {
        calls += let_fail(each[i], ENOMEM, hdf5, "out of memory");
        calls += let_fail(each[i], ENOMEM, csv, "out of memory");
    }
    ck_assert_int_gt(calls, 30);
    remove_folder(folder);
}
END_TEST

START_TEST(interrupted_calls_are_repeated) {
    char folder[PATH_SIZE], csv[PATH_SIZE], hdf5[PATH_SIZE];
    make_folder(folder);
    write_table(path_in(folder, "a.csv", csv));
    write_table(path_in(folder, "a.h5", hdf5));
    ck_assert_int_gt(let_fail("read", EINTR, csv, NULL), 2);
    ck_assert_int_gt(let_fail("read", EINTR, hdf5, NULL), 10);
    ck_assert_int_gt(let_fail("write", EINTR, hdf5, NULL), 10);
    remove_folder(folder);
}
END_TEST

START_TEST(a_failing_system_is_named) {
    char folder[PATH_SIZE], csv[PATH_SIZE], hdf5[PATH_SIZE];
    make_folder(folder);
    write_table(path_in(folder, "a.csv", csv));
    write_table(path_in(folder, "a.h5", hdf5));
    ck_assert_int_gt(let_fail("read", EIO, csv, "cannot read: Input/output error"), 2);
    ck_assert_int_eq(let_fail("pipe", EMFILE, hdf5, "cannot create a pipe: Too many"), 1);
    ck_assert_int_eq(let_fail("fork", EAGAIN, hdf5,
                              "cannot start a child process: Resource temporarily unavailable"),
                     1);
    /* between the processes: the parent cannot tell it from a dead child */
    ck_assert_int_gt(let_fail("read", EIO, hdf5, "the file is damaged"), 10);
    ck_assert_int_gt(let_fail("write", EIO, hdf5, "the file is damaged"), 10);
    remove_folder(folder);
}
END_TEST

START_TEST(what_the_hdf5_library_cannot_read_is_damaged) {
    static const char *const each[] = {
        "H5Dopen2",         "H5Dget_space",        "H5Dget_type", "H5Dget_create_plist",
        "H5Screate_simple", "H5Sselect_hyperslab", "H5Dread"};
    char folder[PATH_SIZE], path[PATH_SIZE];
    make_folder(folder);
    write_table(path_in(folder, "a.h5", path));
    for (size_t i = 0; i < sizeof each / sizeof each[0]; i++)
        ck_assert_int_ge(let_fail(each[i], 0, path, "cannot be read; the file is damaged"),
                         COLUMNS);
    remove_folder(folder);
}
END_TEST

START_TEST(who_wants_no_more_gets_no_more) {
    char folder[PATH_SIZE], path[PATH_SIZE];
    make_folder(folder);
    for (int kind = 0; kind < 2; kind++) {
        write_table(path_in(folder, kind ? "a.h5" : "a.csv", path));
        for (size_t last = 1; last <= 4; last++) {
            arrived a = {.last = last};
            gough_error error = {.message = ""};
            ck_assert_int_eq(gough_table_scan(path, NULL, take, &a, &error), GOUGH_OK);
            ck_assert_uint_eq(a.calls, last);
            ck_assert_uint_eq(a.rows, last < 4 ? (last - 1) * RESULT_PART : ROWS);
        }
    }
    remove_folder(folder);
}
END_TEST

/* ---- long lines ---- */

typedef struct counted {
    size_t rows, columns;
} counted;

static int count_rows(void *context, const gough_table *part) {
    counted *c = context;
    c->rows += part->rows;
    c->columns = part->columns;
    return 0;
}

START_TEST(a_row_may_be_longer_than_a_piece) {
    static const char *const only[] = {"t", NULL};
    char folder[PATH_SIZE], path[PATH_SIZE];
    gough_error error = {.message = ""};
    counted c = {0, 0};
    make_folder(folder);
    FILE *file = fopen(path_in(folder, "a.csv", path), "w");
    ck_assert_ptr_nonnull(file);
    fputs("t,x\n1,", file);
    for (int i = 0; i < LONG; i++) fputc('1', file);
    fputs("\n2,3\n", file);
    ck_assert_int_eq(fclose(file), 0);
    ck_assert_int_eq(gough_table_scan(path, only, count_rows, &c, &error), GOUGH_OK);
    ck_assert_uint_eq(c.rows, 2);
    ck_assert_uint_eq(c.columns, 1);
    fault_arm("realloc", 1, ENOMEM);
    ck_assert_int_eq(gough_table_scan(path, only, count_rows, &c, &error), GOUGH_ERROR_FILE);
    ck_assert(fault_disarm());
    ck_assert_ptr_nonnull(strstr(error.message, "a.csv: cannot read: Cannot allocate memory"));
    ck_assert_int_eq(truncate(path, (off_t)100 << 20), 0);
    file = fopen(path, "r+");
    ck_assert_ptr_nonnull(file);
    /* no line ends behind the first */
    fputs("t,x\n1,", file);
    fseek(file, 6 + LONG, SEEK_SET);
    fputs("11111", file);
    ck_assert_int_eq(fclose(file), 0);
    ck_assert_int_eq(gough_table_scan(path, only, count_rows, &c, &error), GOUGH_ERROR_INPUT);
    ck_assert_msg(strstr(error.message, "a.csv:2:1: this row is longer than 64 MiB"), "%s",
                  error.message);
    remove_folder(folder);
}
END_TEST

/* ---- what a child says ---- */

static gough_status brings_too_many_rows(result_scan *scan, gough_table *table,
                                         gough_error *error) {
    const bool good = result_table_shape(table, 1, RESULT_PART + 1);
    (void)error;
    if (!good) return GOUGH_ERROR_FILE;
    table->name[0] = calloc(1, 2);
    if (!result_scan_begin(scan, table)) return GOUGH_ERROR_FILE;
    result_scan_part(scan, RESULT_PART + 1);
    return GOUGH_OK;
}

static gough_status says_nothing(result_scan *scan, gough_table *table, gough_error *error) {
    (void)scan, (void)table;
    return gough_fail(error, GOUGH_ERROR_INPUT, "it is the wrong weather");
}

static gough_status ask_child(result_part_reader *reader, counted *c, gough_error *error) {
    result_scan scan = {.path = "no such file", .sink = count_rows, .context = c};
    gough_table table = {.rows = 0};
    *c = (counted){0, 0};
    const gough_status status = result_scan_in_child(reader, &scan, &table, error);
    result_table_clear(&table);
    result_scan_end(&scan);
    return status;
}

START_TEST(a_child_is_not_believed_everything) {
    gough_error error = {.message = ""};
    counted c;
    ck_assert_int_eq(ask_child(brings_too_many_rows, &c, &error), GOUGH_ERROR_INPUT);
    ck_assert_str_eq(error.message,
                     "no such file: the HDF5 library cannot read it; the file is damaged");
    ck_assert_uint_eq(c.rows, 0);
    ck_assert_int_eq(ask_child(says_nothing, &c, &error), GOUGH_ERROR_INPUT);
    ck_assert_str_eq(error.message, "it is the wrong weather");
    ck_assert_uint_eq(c.columns, 0);
    bool came = true;
    for (long n = 1; came; n++) {
        fault_arm("write", n, EIO);
        ck_assert_int_eq(ask_child(says_nothing, &c, &error), GOUGH_ERROR_INPUT);
        came = fault_disarm();
        ck_assert_str_eq(error.message,
                         came ? "no such file: the HDF5 library cannot read it; the file is damaged"
                              : "it is the wrong weather");
    }
}
END_TEST

int main(void) {
    return SUITE_RUN("table/scan_faults", 60, without_memory_the_numbers_are_right_or_refused,
                     interrupted_calls_are_repeated, a_failing_system_is_named,
                     what_the_hdf5_library_cannot_read_is_damaged, who_wants_no_more_gets_no_more,
                     a_row_may_be_longer_than_a_piece, a_child_is_not_believed_everything);
}
