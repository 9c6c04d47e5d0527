/* HDF5 files that others wrote: what is a column, what is a text, and what is refused with a sentence. */
#define _XOPEN_SOURCE 700
#include <hdf5.h>

#include "support/suite.h"
#include "table/by_hand.h"

static hid_t new_file(const char *path) {
    const hid_t file = H5Fcreate(path, H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    ck_assert(file >= 0);
    return file;
}

/* A dataset of these dimensions whose numbers are 0; `creation` says how it is kept. */
static void add_set(hid_t file, const char *name, int dimensions, const hsize_t *size, hid_t type,
                    hid_t creation) {
    const hid_t space =
        dimensions < 0 ? H5Screate(H5S_NULL) : H5Screate_simple(dimensions, size, NULL);
    const hid_t set = H5Dcreate2(file, name, type, space, H5P_DEFAULT, creation, H5P_DEFAULT);
    ck_assert(set >= 0);
    H5Dclose(set);
    H5Sclose(space);
}

static void add_column(hid_t file, const char *name, hsize_t rows) {
    add_set(file, name, 1, &rows, H5T_IEEE_F64LE, H5P_DEFAULT);
}

static void add_attribute(hid_t file, const char *name, hid_t type, hsize_t count,
                          const void *value) {
    const hid_t space = H5Screate_simple(1, &count, NULL);
    const hid_t attribute = H5Acreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    ck_assert(attribute >= 0);
    ck_assert(H5Awrite(attribute, type, value) >= 0);
    H5Aclose(attribute);
    H5Sclose(space);
}

static hid_t text_type(size_t size) {
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, size);
    return type;
}

static gough_table *expect_table(const char *path) {
    gough_table *table = NULL;
    gough_error error = {.message = ""};
    ck_assert_msg(gough_table_read(path, &table, &error) == GOUGH_OK, "%s", error.message);
    return table;
}

static void expect_refused(const char *path, const char *sentence) {
    gough_table *table = NULL;
    gough_error error = {.message = ""};
    ck_assert_int_eq(gough_table_read(path, &table, &error), GOUGH_ERROR_INPUT);
    ck_assert_msg(strstr(error.message, sentence), "%s", error.message);
    ck_assert(table == NULL);
}

START_TEST(attributes_that_are_no_single_text_are_empty) {
    char folder[PATH_SIZE], path[PATH_SIZE], *nothing = NULL;
    const int number = 3;
    const double two[2] = {1, 2};
    make_folder(folder);
    const hid_t file = new_file(path_in(folder, "a.h5", path));
    const hid_t word = text_type(4), variable = text_type(H5T_VARIABLE);
    add_column(file, "t", 2);
    add_attribute(file, "title", H5T_NATIVE_INT, 1, &number);
    add_attribute(file, "verb", word, 2, "one\0two");
    add_attribute(file, "end_message", variable, 1, &nothing);
    add_attribute(file, "end_time", H5T_NATIVE_DOUBLE, 2, two);
    add_attribute(file, "tolerance", word, 1, "one");
    add_attribute(file, "step", H5T_NATIVE_INT, 1, &number);
    H5Fclose(file);
    gough_table *table = expect_table(path);
    ck_assert_str_eq(table->title, "");
    ck_assert_str_eq(table->verb, "");
    ck_assert_str_eq(table->end_cause, "");
    ck_assert_str_eq(table->end_message, "");
    ck_assert(isnan(table->end_time));
    ck_assert(isnan(table->tolerance));
    ck_assert(fabs(table->step - 3) <= 0);
    gough_table_free(table);
    H5Tclose(word);
    H5Tclose(variable);
    remove_folder(folder);
}
END_TEST

START_TEST(a_text_may_have_64_kib) {
    enum { MOST = 1 << 16 };
    char folder[PATH_SIZE], path[PATH_SIZE], *text = malloc(MOST + 2);
    make_folder(folder);
    memset(text, 'x', MOST + 1);
    text[MOST + 1] = '\0';
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    H5Pset_libver_bounds(access, H5F_LIBVER_LATEST, H5F_LIBVER_LATEST);
    const hid_t file = H5Fcreate(path_in(folder, "a.h5", path), H5F_ACC_TRUNC, H5P_DEFAULT, access);
    const hid_t longest = text_type(MOST), longer = text_type(MOST + 1);
    const hid_t variable = text_type(H5T_VARIABLE);
    add_column(file, "t", 2);
    add_attribute(file, "title", longest, 1, text);
    add_attribute(file, "verb", longer, 1, text);
    add_attribute(file, "end_cause", variable, 1, &text);
    H5Fclose(file);
    gough_table *table = expect_table(path);
    ck_assert_uint_eq(strlen(table->title), MOST);
    ck_assert_str_eq(table->verb, "");
    ck_assert_uint_eq(strlen(table->end_cause), MOST);
    gough_table_free(table);
    H5Tclose(longest);
    H5Tclose(longer);
    H5Tclose(variable);
    H5Pclose(access);
    free(text);
    remove_folder(folder);
}
END_TEST

START_TEST(only_numbers_of_one_dimension_in_the_file_itself_are_columns) {
    char folder[PATH_SIZE], path[PATH_SIZE];
    const hsize_t size[2] = {2, 2};
    make_folder(folder);
    const hid_t file = new_file(path_in(folder, "a.h5", path));
    const hid_t elsewhere = H5Pcreate(H5P_DATASET_CREATE);
    const hid_t virtual = H5Pcreate(H5P_DATASET_CREATE);
    const hid_t space = H5Screate_simple(1, size, NULL), word = text_type(4);
    H5Pset_external(elsewhere, "/dev/zero", 0, H5F_UNLIMITED);
    H5Pset_virtual(virtual, space, "other.h5", "t", space);
    add_column(file, "t", 2);
    add_set(file, "whole", 1, size, H5T_STD_I16BE, H5P_DEFAULT);
    add_set(file, "square", 2, size, H5T_IEEE_F64LE, H5P_DEFAULT);
    add_set(file, "single", 0, size, H5T_IEEE_F64LE, H5P_DEFAULT);
    add_set(file, "nothing", -1, size, H5T_IEEE_F64LE, H5P_DEFAULT);
    add_set(file, "words", 1, size, word, H5P_DEFAULT);
    add_set(file, "external", 1, size, H5T_IEEE_F64LE, elsewhere);
    add_set(file, "virtual", 1, size, H5T_IEEE_F64LE, virtual);
    H5Gclose(H5Gcreate2(file, "group", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
    H5Lcreate_soft("/t", file, "again", H5P_DEFAULT, H5P_DEFAULT);
    H5Fclose(file);
    gough_table *table = expect_table(path);
    ck_assert_uint_eq(table->columns, 2);
    ck_assert_str_eq(table->name[0], "t");
    ck_assert_str_eq(table->name[1], "whole");
    gough_table_free(table);
    H5Pclose(elsewhere);
    H5Pclose(virtual);
    H5Sclose(space);
    H5Tclose(word);
    remove_folder(folder);
}
END_TEST

static void write_columns(const char *path, int columns) {
    const hid_t file = new_file(path);
    char name[20];
    for (int c = 0; c < columns; c++) {
        snprintf(name, sizeof name, "c%04d", c);
        add_column(file, name, 2);
    }
    H5Fclose(file);
}

START_TEST(a_table_has_at_most_4096_columns) {
    char folder[PATH_SIZE], path[PATH_SIZE];
    make_folder(folder);
    write_columns(path_in(folder, "a.h5", path), 4096);
    gough_table *table = expect_table(path);
    ck_assert_uint_eq(table->columns, 4096);
    ck_assert_str_eq(table->name[4095], "c4095");
    gough_table_free(table);
    write_columns(path, 4097);
    expect_refused(path, "a.h5: more than 4096 columns");
    write_columns(path, 0);
    expect_refused(path, "a.h5: has no one-dimensional dataset of numbers in its root group");
    remove_folder(folder);
}
END_TEST

START_TEST(a_column_cannot_be_larger_than_its_file_allows) {
    char folder[PATH_SIZE], path[PATH_SIZE];
    const hsize_t few = 1 << 30, many = (hsize_t)1 << 41, chunk = 1024;
    const hid_t chunks = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_chunk(chunks, 1, &chunk);
    make_folder(folder);
    hid_t file = new_file(path_in(folder, "a.h5", path));
    add_set(file, "t", 1, &few, H5T_IEEE_F64LE, chunks);
    H5Fclose(file);
    expect_refused(path, "a.h5: column t claims to have 1073741824 rows, more than a file of this "
                         "size can hold");
    /* beyond what memory can have it is no column at all */
    file = new_file(path);
    add_set(file, "t", 1, &many, H5T_IEEE_F64LE, chunks);
    H5Fclose(file);
    expect_refused(path, "has no one-dimensional dataset");
    file = new_file(path);
    add_column(file, "a", 2);
    add_column(file, "b", 3);
    H5Fclose(file);
    expect_refused(path, "a.h5: column b has 3 rows, but a has 2; all columns of a table must have "
                         "the same length");
    H5Pclose(chunks);
    remove_folder(folder);
}
END_TEST

int main(void) {
    return SUITE_RUN(
        "table/read_hdf5", 60, attributes_that_are_no_single_text_are_empty, a_text_may_have_64_kib,
        only_numbers_of_one_dimension_in_the_file_itself_are_columns,
        a_table_has_at_most_4096_columns, a_column_cannot_be_larger_than_its_file_allows);
}
