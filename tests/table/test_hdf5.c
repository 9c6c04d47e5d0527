/* HDF5: numbers and attributes come back, the same run gives the same bytes, damaged files end in a message.
 * Label: standard.
 * Sanitized: campaign: the corpus of fuzz_hdf5 and table/read_faults read damaged files under sanitizers. */
#define _XOPEN_SOURCE 700
#include "support/random.h"
#include "support/suite.h"
#include "table/by_hand.h"

static bool same_bits(double a, double b) { return memcmp(&a, &b, sizeof a) == 0; }

START_TEST(numbers_and_attributes_come_back) {
    char folder[PATH_SIZE], path[PATH_SIZE];
    make_folder(folder);
    path_in(folder, "a.h5", path);
    gough_study *study = study_by_hand("Größe “quoted” `and` $(more)", true);
    gough_result *result = result_by_hand(study, "simulate", 321, &own_units);
    gough_error error = {.message = ""};
    ck_assert_msg(gough_result_write(result, path, &error) == GOUGH_OK, "%s", error.message);

    gough_table *table = NULL;
    ck_assert_msg(gough_table_read(path, &table, &error) == GOUGH_OK, "%s", error.message);
    ck_assert_uint_eq(table->rows, 321);
    ck_assert_uint_eq(table->columns, GOUGH_COLUMNS);
    ck_assert_str_eq(table->title, study->title);
    ck_assert_str_eq(table->verb, "simulate");
    ck_assert_str_eq(table->end_cause, "leg_long");
    ck_assert(same_bits(table->end_time, 321.0 / 8.0));
    for (int c = 0; c < GOUGH_COLUMNS; c++) {
        ck_assert_str_eq(table->name[c], gough_column(c)->name);
        for (size_t r = 0; r < table->rows; r++) {
            double expected = c == GOUGH_T ? (double)r / 8.0 : awkward(r, c);
            if (gough_column(c)->angle != 0) expected *= 57.295779513082320877;
            ck_assert(same_bits(table->value[c][r], expected));
        }
    }
    gough_table_free(table);
    gough_result_free(result);
    free_study_by_hand(study);
    remove_folder(folder);
}
END_TEST

START_TEST(the_same_run_gives_the_same_bytes) {
    char folder[PATH_SIZE], one[PATH_SIZE], two[PATH_SIZE];
    make_folder(folder);
    write_by_hand(path_in(folder, "one.h5", one), 200);
    char *churn = malloc(1 << 20); /* other memory, so that what is not written differs */
    memset(churn, 0xa5, 1 << 20);
    free(churn);
    sleep(1); /* a time in the file would differ */
    write_by_hand(path_in(folder, "two.h5", two), 200);
    size_t length, other_length;
    char *bytes = read_bytes(one, &length), *other = read_bytes(two, &other_length);
    ck_assert_uint_eq(length, other_length);
    ck_assert_int_eq(memcmp(bytes, other, length), 0);
    free(bytes);
    free(other);
    remove_folder(folder);
}
END_TEST

START_TEST(a_table_without_rows_is_a_table) {
    char folder[PATH_SIZE], path[PATH_SIZE];
    make_folder(folder);
    static const char *const names[] = {"a.h5", "a.csv"};
    for (int i = 0; i < 2; i++) {
        write_by_hand(path_in(folder, names[i], path), 0);
        gough_table *table = NULL;
        gough_error error = {.message = ""};
        ck_assert_msg(gough_table_read(path, &table, &error) == GOUGH_OK, "%s", error.message);
        ck_assert_uint_eq(table->rows, 0);
        ck_assert_uint_eq(table->columns, GOUGH_COLUMNS);
        gough_table_free(table);
    }
    remove_folder(folder);
}
END_TEST

/* A study may be 64 KiB, more than an HDF5 attribute of the compact kind. */
START_TEST(a_long_study_is_kept_whole) {
    char folder[PATH_SIZE], path[PATH_SIZE];
    make_folder(folder);
    path_in(folder, "a.h5", path);
    gough_study *study = study_by_hand("long", false);
    free(study->text);
    study->text = malloc(70001);
    memset(study->text, 'x', 70000);
    study->text[69999] = '!';
    study->text[70000] = '\0';
    gough_result *result = result_by_hand(study, "forces", 3, &own_units);
    gough_error error = {.message = ""};
    ck_assert_msg(gough_result_write(result, path, &error) == GOUGH_OK, "%s", error.message);
    gough_table *table = NULL;
    ck_assert_msg(gough_table_read(path, &table, &error) == GOUGH_OK, "%s", error.message);
    ck_assert_str_eq(table->title, "long");
    gough_table_free(table);
    size_t length;
    char *bytes = read_bytes(path, &length);
    bool found = false;
    for (size_t i = 0; i + 1000 < length && !found; i++)
        found = memcmp(bytes + i, study->text + 69000, 1000) == 0;
    ck_assert(found);
    free(bytes);
    gough_result_free(result);
    free_study_by_hand(study);
    remove_folder(folder);
}
END_TEST

START_TEST(hdf5_is_told_by_its_content) {
    char folder[PATH_SIZE], path[PATH_SIZE], renamed[PATH_SIZE];
    make_folder(folder);
    write_by_hand(path_in(folder, "a.h5", path), 5);
    ck_assert_int_eq(rename(path, path_in(folder, "a.csv", renamed)), 0);
    gough_table *table = NULL;
    gough_error error = {.message = ""};
    ck_assert_msg(gough_table_read(renamed, &table, &error) == GOUGH_OK, "%s", error.message);
    ck_assert_str_eq(table->verb, "simulate");
    gough_table_free(table);
    remove_folder(folder);
}
END_TEST

/* Reads bytes as a file: a table or a message, and nothing else. Returns whether it was a table. */
static bool read_damaged(const char *path, const char *bytes, size_t length) {
    write_bytes(path, bytes, length);
    gough_table *table = NULL;
    gough_error error = {.message = ""};
    const gough_status status = gough_table_read(path, &table, &error);
    if (status == GOUGH_OK) {
        ck_assert(table != NULL);
        gough_table_free(table);
        return true;
    }
    ck_assert_int_eq(status, GOUGH_ERROR_INPUT);
    ck_assert(table == NULL);
    ck_assert(strstr(error.message, path) != NULL);
    return false;
}

START_TEST(a_truncated_file_is_refused) {
    char folder[PATH_SIZE], path[PATH_SIZE];
    make_folder(folder);
    write_by_hand(path_in(folder, "a.h5", path), 20);
    size_t length;
    char *bytes = read_bytes(path, &length);
    for (size_t cut = 0; cut < length; cut += cut < 700 ? 23 : 997)
        ck_assert_msg(!read_damaged(path, bytes, cut), "%zu of %zu bytes", cut, length);
    ck_assert(!read_damaged(path, bytes, length - 1));
    ck_assert(read_damaged(path, bytes, length));
    free(bytes);
    remove_folder(folder);
}
END_TEST

START_TEST(flipped_bytes_end_in_a_message_or_a_table) {
    char folder[PATH_SIZE], path[PATH_SIZE];
    make_folder(folder);
    write_by_hand(path_in(folder, "a.h5", path), 20);
    size_t length;
    char *bytes = read_bytes(path, &length);
    dice d = {20261122};
    for (int round = 0; round < 400; round++) {
        /* most in the first bytes, where the structure begins */
        const size_t range = round % 2 ? 4096 : length;
        const size_t at = (size_t)dice_between(&d, 8.0, (double)range);
        const char before = bytes[at];
        bytes[at] = (char)(before ^ (1 << (dice_bits(&d) % 8)));
        read_damaged(path, bytes, length);
        bytes[at] = before;
    }
    free(bytes);
    remove_folder(folder);
}
END_TEST

START_TEST(a_file_of_noise_behind_the_signature_is_refused) {
    char folder[PATH_SIZE], path[PATH_SIZE], bytes[5000] = "\x89HDF\r\n\x1a\n";
    make_folder(folder);
    path_in(folder, "a.h5", path);
    dice d = {7};
    for (int round = 0; round < 20; round++) {
        for (size_t i = 8; i < sizeof bytes; i++) bytes[i] = (char)dice_bits(&d);
        if (round % 2) bytes[8] = 2; /* a known version */
        ck_assert(!read_damaged(path, bytes, sizeof bytes));
    }
    remove_folder(folder);
}
END_TEST

int main(void) {
    return SUITE_RUN("table/hdf5", 120, numbers_and_attributes_come_back,
                     the_same_run_gives_the_same_bytes, a_table_without_rows_is_a_table,
                     a_long_study_is_kept_whole, hdf5_is_told_by_its_content,
                     a_truncated_file_is_refused, flipped_bytes_end_in_a_message_or_a_table,
                     a_file_of_noise_behind_the_signature_is_refused);
}
