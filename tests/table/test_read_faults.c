/* Reading a table when memory or the system fails: the same table, or a sentence that names the file and the cause.
 * Faults: malloc calloc realloc strdup strndup read write stat fstat pipe fork waitpid H5Oopen H5Tset_size H5Aread H5Dread
 * Faults: H5Literate */
#define _GNU_SOURCE
#include <fcntl.h>
#include <hdf5.h>
#include <sys/stat.h>
#include <sys/wait.h>

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
FAULTY_FSTAT;
FAULTY(int, stat, (const char *path, struct stat *about), -1, path, about);
FAULTY(int, pipe, (int ends[2]), -1, ends);
FAULTY(pid_t, fork, (void), -1, );
FAULTY(pid_t, waitpid, (pid_t child, int *status, int how), -1, child, status, how);
FAULTY(hid_t, H5Oopen, (hid_t place, const char *name, hid_t access), -1, place, name, access);
FAULTY(herr_t, H5Tset_size, (hid_t type, size_t size), -1, type, size);
FAULTY(herr_t, H5Aread, (hid_t attribute, hid_t type, void *to), -1, attribute, type, to);
FAULTY(herr_t, H5Dread, (hid_t set, hid_t type, hid_t in, hid_t from, hid_t how, void *to), -1, set,
       type, in, from, how, to);

/* fails when all is done */
herr_t __real_H5Literate(hid_t, H5_index_t, H5_iter_order_t, hsize_t *, H5L_iterate_t, void *);
herr_t __wrap_H5Literate(hid_t, H5_index_t, H5_iter_order_t, hsize_t *, H5L_iterate_t, void *);
herr_t __wrap_H5Literate(hid_t group, H5_index_t index, H5_iter_order_t order, hsize_t *from,
                         H5L_iterate_t visit, void *context) {
    const herr_t done = __real_H5Literate(group, index, order, from, visit, context);
    return fault_comes("H5Literate") ? -1 : done;
}

enum { ROWS = 300, COLUMNS = 2 };

static void add_text(hid_t object, const char *name, const char *text, bool variable) {
    const hid_t type = H5Tcopy(H5T_C_S1), space = H5Screate(H5S_SCALAR);
    H5Tset_size(type, variable ? H5T_VARIABLE : strlen(text));
    const hid_t attribute = H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    ck_assert(H5Awrite(attribute, type, variable ? (const void *)&text : text) >= 0);
    H5Aclose(attribute);
    H5Sclose(space);
    H5Tclose(type);
}

/* The same small table as CSV and as HDF5, which has texts too. */
static void write_both(const char *folder, char csv[PATH_SIZE], char hdf5[PATH_SIZE]) {
    const char *const names[COLUMNS] = {"t", "x"};
    double value[ROWS];
    FILE *file = fopen(path_in(folder, "a.csv", csv), "w");
    ck_assert_ptr_nonnull(file);
    fputs("t,x\n", file);
    for (int r = 0; r < ROWS; r++) fprintf(file, "%.3f,%.3f\n", r / 8.0, r / 8.0);
    ck_assert_int_eq(fclose(file), 0);

    for (int r = 0; r < ROWS; r++) value[r] = r / 8.0;
    const hid_t made =
        H5Fcreate(path_in(folder, "a.h5", hdf5), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    add_text(made, "title", "by hand", false);
    add_text(made, "verb", "simulate", true);
    for (int c = 0; c < COLUMNS; c++) {
        const hid_t space = H5Screate_simple(1, &(hsize_t){ROWS}, NULL);
        const hid_t set = H5Dcreate2(made, names[c], H5T_IEEE_F64LE, space, H5P_DEFAULT,
                                     H5P_DEFAULT, H5P_DEFAULT);
        ck_assert(H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, value) >= 0);
        add_text(set, "units", "s", c > 0);
        H5Dclose(set);
        H5Sclose(space);
    }
    ck_assert(H5Fclose(made) >= 0);
}

/* Whether the table is the one that was written, whole. */
static void expect_whole(const gough_table *table, bool texts) {
    ck_assert_uint_eq(table->rows, ROWS);
    ck_assert_uint_eq(table->columns, COLUMNS);
    for (size_t c = 0; c < COLUMNS; c++)
        for (size_t r = 0; r < ROWS; r++)
            ck_assert(fabs(table->value[c][r] - (double)r / 8.0) <= 0);
    ck_assert_str_eq(table->verb, texts ? "simulate" : "");
    ck_assert_str_eq(table->title, texts ? "by hand" : "");
    ck_assert_str_eq(table->unit[1], texts ? "s" : "");
}

/* Lets each call of the function fail with this errno, one at a time. Where `cause` is NULL the table must come whole in spite
 * of it, else it may be refused with that. Returns how many calls failed. */
static long let_fail(const char *name, int number, const char *path, bool texts,
                     const char *cause) {
    for (long n = 1;; n++) {
        gough_table *table = NULL;
        gough_error error = {.message = ""};
        fault_arm(name, n, number);
        const gough_status status = gough_table_read(path, &table, &error);
        if (!fault_disarm()) {
            ck_assert_int_eq(status, GOUGH_OK);
            gough_table_free(table);
            return n - 1;
        }
        if (status == GOUGH_OK) {
            expect_whole(table, texts);
            gough_table_free(table);
            continue;
        }
        ck_assert(table == NULL);
        ck_assert_msg(cause && strstr(error.message, cause) && strstr(error.message, path),
                      "call %ld of %s: %s", n, name, error.message);
    }
}

START_TEST(without_memory_a_table_is_whole_or_refused) {
    static const char *const each[] = {"malloc", "calloc", "realloc", "strdup", "strndup"};
    char folder[PATH_SIZE], csv[PATH_SIZE], hdf5[PATH_SIZE];
    make_folder(folder);
    write_both(folder, csv, hdf5);
    long calls = 0;
    for (size_t i = 0; i < sizeof each / sizeof each[0]; i++) {
        calls += let_fail(each[i], ENOMEM, hdf5, true, "out of memory");
        /* a file is read into a text first */
        calls += let_fail(each[i], ENOMEM, csv, false,
                          i == 0 || i == 2 ? "Cannot allocate memory" : "out of memory");
    }
    ck_assert_int_gt(calls, 20);
    remove_folder(folder);
}
END_TEST

START_TEST(interrupted_calls_are_repeated) {
    char folder[PATH_SIZE], csv[PATH_SIZE], hdf5[PATH_SIZE];
    make_folder(folder);
    write_both(folder, csv, hdf5);
    ck_assert_int_gt(let_fail("read", EINTR, csv, false, NULL), 1);
    ck_assert_int_gt(let_fail("read", EINTR, hdf5, true, NULL), 1);
    ck_assert_int_gt(let_fail("write", EINTR, hdf5, true, NULL), 1);
    ck_assert_int_eq(let_fail("waitpid", EINTR, hdf5, true, NULL), 1);
    remove_folder(folder);
}
END_TEST

START_TEST(a_failing_system_is_named) {
    char folder[PATH_SIZE], csv[PATH_SIZE], hdf5[PATH_SIZE];
    make_folder(folder);
    write_both(folder, csv, hdf5);
    ck_assert_int_gt(let_fail("read", EIO, csv, false, "cannot read: Input/output error"), 1);
    ck_assert_int_eq(let_fail("pipe", EMFILE, hdf5, true, "cannot create a pipe: Too many"), 1);
    ck_assert_int_eq(let_fail("fork", EAGAIN, hdf5, true,
                              "cannot start a child process: Resource temporarily unavailable"),
                     1);
    ck_assert_int_eq(let_fail("fstat", EIO, csv, false, "Input/output error"), 2);
    ck_assert_int_eq(let_fail("stat", EIO, hdf5, true, "cannot read: Input/output error"), 2);
    /* between the processes: the parent cannot tell it from a dead child */
    ck_assert_int_gt(let_fail("read", EIO, hdf5, true, "the file is damaged"), 1);
    ck_assert_int_gt(let_fail("write", EIO, hdf5, true, "the file is damaged"), 1);
    ck_assert_int_eq(let_fail("waitpid", ECHILD, hdf5, true, NULL), 1);
    remove_folder(folder);
}
END_TEST

/* What the HDF5 library cannot do although the file could be opened: the first words of the complaint. */
static void expect_damaged(const char *name, long n, const char *path, const char *sentence) {
    gough_table *table = NULL;
    gough_error error = {.message = ""};
    fault_arm(name, n, 0);
    const gough_status status = gough_table_read(path, &table, &error);
    ck_assert(fault_disarm());
    ck_assert_int_eq(status, GOUGH_ERROR_INPUT);
    ck_assert_ptr_null(table);
    ck_assert_msg(strstr(error.message, sentence), "%s", error.message);
}

START_TEST(what_the_hdf5_library_cannot_read_is_damaged) {
    char folder[PATH_SIZE], csv[PATH_SIZE], hdf5[PATH_SIZE];
    make_folder(folder);
    write_both(folder, csv, hdf5);
    expect_damaged("H5Dread", 1, hdf5, "a.h5: column t cannot be read; the file is damaged");
    expect_damaged("H5Oopen", 1, hdf5, "a.h5: 't' cannot be opened; the file is damaged");
    /* without an order of creation the names are listed again in that of the alphabet */
    expect_damaged("H5Literate", 2, hdf5,
                   "a.h5: its contents cannot be listed; the file is damaged");
    write_by_hand(path_in(folder, "b.h5", hdf5), 3);
    expect_damaged("H5Literate", 1, hdf5,
                   "b.h5: its contents cannot be listed; the file is damaged");
    remove_folder(folder);
}
END_TEST

START_TEST(a_text_that_cannot_be_read_is_empty) {
    static const char *const each[] = {"H5Aread", "H5Tset_size"};
    char folder[PATH_SIZE], csv[PATH_SIZE], hdf5[PATH_SIZE];
    make_folder(folder);
    write_both(folder, csv, hdf5);
    for (size_t i = 0; i < 2; i++)
        for (long n = 1;; n++) {
            gough_table *table = NULL;
            gough_error error = {.message = ""};
            fault_arm(each[i], n, 0);
            const gough_status status = gough_table_read(hdf5, &table, &error);
            const bool came = fault_disarm();
            ck_assert_msg(status == GOUGH_OK, "%s", error.message);
            ck_assert_uint_eq(table->rows, ROWS);
            ck_assert_str_eq(table->title, n == 1 ? "" : "by hand");
            ck_assert_str_eq(table->verb, n == 2 ? "" : "simulate");
            gough_table_free(table);
            if (!came) break;
        }
    remove_folder(folder);
}
END_TEST

/* ---- what never ends ---- */

START_TEST(standard_input_may_be_anything) {
    gough_table *table = NULL;
    gough_error error = {.message = ""};
    char path[40];
    const int folder = open("/", O_RDONLY), zeros = open("/dev/zero", O_RDONLY);
    ck_assert_int_eq(dup2(folder, STDIN_FILENO), STDIN_FILENO);
    ck_assert_int_eq(gough_table_read("-", &table, &error), GOUGH_ERROR_FILE);
    ck_assert_str_eq(error.message, "standard input: is a folder, not a result");
    snprintf(path, sizeof path, "/dev/fd/%d", zeros);
    fault_arm("realloc", 1, ENOMEM);
    ck_assert_int_eq(gough_table_read(path, &table, &error), GOUGH_ERROR_FILE);
    ck_assert(fault_disarm());
    ck_assert_ptr_nonnull(strstr(error.message, "cannot read: Cannot allocate memory"));
    ck_assert_int_eq(gough_table_read(path, &table, &error), GOUGH_ERROR_INPUT);
    ck_assert_ptr_nonnull(strstr(error.message, "is larger than 256 MiB, the most that can be"));
    close(folder);
    close(zeros);
}
END_TEST

/* ---- what a child says ---- */

static gough_status brings_a_long_title(const char *path, gough_table *table, gough_error *error) {
    (void)path, (void)error;
    table->title = calloc(2 << 20, 1);
    if (!table->title) return GOUGH_ERROR_FILE;
    memset(table->title, 'x', (2 << 20) - 1);
    return GOUGH_OK;
}

static gough_status brings_no_texts(const char *path, gough_table *table, gough_error *error) {
    (void)path, (void)table, (void)error;
    table->end_time = 4;
    return GOUGH_OK;
}

static gough_status ends_for_want_of_memory(const char *path, gough_table *table,
                                            gough_error *error) {
    (void)path, (void)table, (void)error;
    _exit(GOUGH_ERROR_FILE);
}

static gough_status ask_child(result_reader *reader, gough_table **table, gough_error *error) {
    *table = calloc(1, sizeof **table);
    ck_assert_ptr_nonnull(*table);
    return result_read_in_child(reader, "no such file", *table, error);
}

START_TEST(a_child_is_not_believed_everything) {
    gough_table *table;
    gough_error error = {.message = ""};
    ck_assert_int_eq(ask_child(brings_a_long_title, &table, &error), GOUGH_ERROR_INPUT);
    ck_assert_str_eq(error.message,
                     "no such file: the HDF5 library cannot read it; the file is damaged");
    gough_table_free(table);
    ck_assert_int_eq(ask_child(ends_for_want_of_memory, &table, &error), GOUGH_ERROR_FILE);
    ck_assert_str_eq(error.message, "no such file: out of memory while reading it");
    gough_table_free(table);
    ck_assert_int_eq(ask_child(brings_no_texts, &table, &error), GOUGH_OK);
    ck_assert_str_eq(table->title, "");
    ck_assert_str_eq(table->end_message, "");
    ck_assert(fabs(table->end_time - 4) <= 0);
    gough_table_free(table);
}
END_TEST

START_TEST(a_name_tells_the_format) {
    gough_study *study = study_by_hand("by hand", false);
    gough_result *result = result_by_hand(study, "simulate", 2, &own_units);
    gough_error error = {.message = ""};
    ck_assert_int_eq(gough_result_write(result, "a", &error), GOUGH_ERROR_INPUT);
    ck_assert_ptr_nonnull(strstr(error.message, "a: the name must end in .h5 (HDF5) or .csv"));
    ck_assert_int_ne(access("a", F_OK), 0);
    gough_result_free(result);
    free_study_by_hand(study);
}
END_TEST

START_TEST(a_file_of_more_than_4_gib_is_refused_at_once) {
    char folder[PATH_SIZE], path[PATH_SIZE];
    gough_table *table = NULL;
    gough_error error = {.message = ""};
    make_folder(folder);
    write_bytes(path_in(folder, "a.csv", path), "t,x\n0,1\n", 8);
    if (truncate(path, (off_t)5 << 30) == 0) {
        ck_assert_int_eq(gough_table_read(path, &table, &error), GOUGH_ERROR_INPUT);
        ck_assert_msg(
            strstr(error.message, "a.csv: is larger than 4096 MiB, the most that can be read"),
            "%s", error.message);
    }
    remove_folder(folder);
}
END_TEST

int main(void) {
    return SUITE_RUN("table/read_faults", 60, a_name_tells_the_format,
                     without_memory_a_table_is_whole_or_refused, interrupted_calls_are_repeated,
                     a_failing_system_is_named, what_the_hdf5_library_cannot_read_is_damaged,
                     standard_input_may_be_anything, a_text_that_cannot_be_read_is_empty,
                     a_child_is_not_believed_everything,
                     a_file_of_more_than_4_gib_is_refused_at_once);
}
