/* CSV out: the bytes themselves, every bit of a number, 36 digits of a quad, the same in a comma locale. */
#define _XOPEN_SOURCE 700
#include "support/suite.h"
#include "table/by_hand.h"

static bool same_bits(double a, double b) { return memcmp(&a, &b, sizeof a) == 0; }

/* Splits a CSV text with the C library alone and compares every number with what went in. */
static void expect_numbers(char *text, size_t rows, bool everything) {
    char *line_rest = NULL;
    char *line = strtok_r(text, "\n", &line_rest);
    ck_assert(line != NULL);
    for (size_t r = 0; r < rows; r++) {
        line = strtok_r(NULL, "\n", &line_rest);
        ck_assert(line != NULL);
        for (int c = 0; c < (everything ? GOUGH_COLUMNS : GOUGH_RXX); c++) {
            double expected = c == GOUGH_T ? (double)r / 8.0 : awkward(r, c);
            if (gough_column(c)->angle != 0) expected *= 57.295779513082320877;
            char *end = NULL;
            ck_assert_msg(same_bits(strtod(line, &end), expected), "row %zu column %s: %.20s", r,
                          gough_column(c)->name, line);
            ck_assert(*end == ',' || *end == '\0');
            line = end + 1;
        }
    }
    ck_assert(strtok_r(NULL, "\n", &line_rest) == NULL);
}

START_TEST(every_bit_is_in_the_text) {
    char folder[PATH_SIZE], path[PATH_SIZE];
    make_folder(folder);
    write_by_hand(path_in(folder, "a.csv", path), 1234);
    size_t length;
    char *text = read_bytes(path, &length);
    ck_assert(strchr(text, '\r') == NULL && strchr(text, ' ') == NULL);
    ck_assert_int_eq(text[length - 1], '\n');
    expect_numbers(text, 1234, true);
    free(text);
    remove_folder(folder);
}
END_TEST

START_TEST(header_names_the_columns_of_the_verb) {
    char folder[PATH_SIZE], path[PATH_SIZE];
    make_folder(folder);
    path_in(folder, "a.csv", path);
    gough_study *study = study_by_hand("", false);
    gough_result *result = result_by_hand(study, "forces", 1, &own_units);
    gough_error error;
    ck_assert_int_eq(gough_result_write(result, path, &error), GOUGH_OK);
    size_t length;
    char *text = read_bytes(path, &length);
    text[strcspn(text, "\n")] = '\0';
    ck_assert_str_eq(text,
                     "t,x,y,z,roll,pitch,yaw,vx,vy,vz,wx,wy,wz,ax,ay,az,alx,aly,alz,l1,l2,l3,l4,"
                     "l5,l6,dl1,dl2,dl3,dl4,dl5,dl6,f1,f2,f3,f4,f5,f6,p1,p2,p3,p4,p5,p6,condition");
    free(text);
    gough_result_free(result);
    free_study_by_hand(study);
    remove_folder(folder);
}
END_TEST

START_TEST(numbers_read_back_bit_for_bit) {
    char folder[PATH_SIZE], path[PATH_SIZE];
    make_folder(folder);
    write_by_hand(path_in(folder, "a.csv", path), 77);
    gough_table *table = NULL;
    gough_error error = {.message = ""};
    ck_assert_msg(gough_table_read(path, &table, &error) == GOUGH_OK, "%s", error.message);
    ck_assert_uint_eq(table->rows, 77);
    ck_assert_uint_eq(table->columns, GOUGH_COLUMNS);
    for (size_t r = 0; r < table->rows; r++)
        ck_assert(same_bits(gough_table_column(table, "f5")[r], awkward(r, GOUGH_F + 4)));
    ck_assert(gough_table_column(table, "f7") == NULL);
    ck_assert_str_eq(table->unit[0], "");
    ck_assert_str_eq(table->verb, "");
    ck_assert(isnan(table->end_time));
    gough_table_free(table);
    remove_folder(folder);
}
END_TEST

START_TEST(a_comma_locale_changes_no_byte) {
    char folder[PATH_SIZE], before[PATH_SIZE], within[PATH_SIZE];
    make_folder(folder);
    write_by_hand(path_in(folder, "before.csv", before), 40);
    enter_comma_locale(folder);
    write_by_hand(path_in(folder, "within.csv", within), 40);

    size_t length, other_length;
    char *bytes = read_bytes(before, &length), *other = read_bytes(within, &other_length);
    ck_assert_uint_eq(length, other_length);
    ck_assert_int_eq(memcmp(bytes, other, length), 0);
    free(bytes);
    free(other);

    gough_table *table = NULL;
    gough_error error = {.message = ""};
    ck_assert_msg(gough_table_read(within, &table, &error) == GOUGH_OK, "%s", error.message);
    ck_assert(same_bits(gough_table_column(table, "t")[3], 0.375));
    gough_table_free(table);
    /* the caller's locale is as it was */
    char half[8];
    snprintf(half, sizeof half, "%.1f", 0.5);
    ck_assert_str_eq(half, "0,5");
    leave_comma_locale();
    remove_folder(folder);
}
END_TEST

START_TEST(what_is_no_number_is_written_as_nan_and_inf) {
    char folder[PATH_SIZE], path[PATH_SIZE];
    make_folder(folder);
    path_in(folder, "a.csv", path);
    gough_study *study = study_by_hand("", false);
    gough_result *result = gough_result_new(study, "forces", &own_units);
    gough_row row = {.quad = NULL};
    row.value[GOUGH_X] = -NAN;
    row.value[GOUGH_Y] = INFINITY;
    row.value[GOUGH_Z] = -INFINITY;
    gough_result_add(result, &row);
    gough_error error;
    ck_assert_int_eq(gough_result_write(result, path, &error), GOUGH_OK);
    size_t length;
    char *text = read_bytes(path, &length);
    ck_assert(strstr(text, "\n0,nan,inf,-inf,0,") != NULL);
    free(text);
    gough_result_free(result);
    free_study_by_hand(study);
    remove_folder(folder);
}
END_TEST

#if defined(__SIZEOF_FLOAT128__)
extern gough_quad strtoflt128(const char *text, char **end);
static gough_quad quad_of(const char *text) { return strtoflt128(text, NULL); }
#else
static gough_quad quad_of(const char *text) { return strtold(text, NULL); }
#endif

/* 180/(7π) from a calculator of arbitrary precision; one seventh comes back bit for bit. */
START_TEST(a_quad_run_prints_36_digits) {
    char folder[PATH_SIZE], path[PATH_SIZE];
    make_folder(folder);
    path_in(folder, "a.csv", path);
    gough_study *study = study_by_hand("", false);
    study->simulation.precision = GOUGH_QUADRUPLE;
    gough_result *result = gough_result_new(study, "forces", &own_units);
    gough_quad quad[GOUGH_COLUMNS] = {0};
    quad[GOUGH_X] = quad[GOUGH_ROLL_ANGLE] = (gough_quad)1 / 7;
    gough_row row = {.quad = quad};
    for (int c = 0; c < GOUGH_COLUMNS; c++) row.value[c] = (double)quad[c];
    ck_assert_int_eq(gough_result_add(result, &row), 0);
    gough_error error;
    ck_assert_int_eq(gough_result_write(result, path, &error), GOUGH_OK);

    size_t length;
    char *text = read_bytes(path, &length);
    const char *numbers = strchr(text, '\n') + 1;
    char x[64] = "", roll[64] = "";
    ck_assert_int_eq(sscanf(numbers, "0,%60[^,],0,0,%60[^,],", x, roll), 2);
    ck_assert(quad_of(x) == quad[GOUGH_X]);
    ck_assert(strlen(roll) >= strlen("8.") + 33);
    ck_assert_int_eq(strncmp(roll, "8.18511135901176012525687925915788", 33), 0);
    free(text);
    gough_result_free(result);
    free_study_by_hand(study);
    remove_folder(folder);
}
END_TEST

/* √(R_b/g) = 2/3 is no double: a row at t = 1 stands at 1.5 to all 33 digits only if the unit of time has them too. */
START_TEST(a_quad_run_has_a_quad_unit_of_time) {
    char folder[PATH_SIZE], path[PATH_SIZE];
    make_folder(folder);
    path_in(folder, "a.csv", path);
    gough_study *study = study_by_hand("", false);
    gough_units units;
    gough_error error;
    ck_assert_int_eq(gough_units_of_study(study, true, &units, &error), GOUGH_OK);
    gough_result *result = gough_result_new(study, "forces", &units);
    gough_quad quad[GOUGH_COLUMNS] = {1};
    gough_row row = {.value = {1.0}, .quad = quad};
    ck_assert_int_eq(gough_result_add(result, &row), 0);
    ck_assert_int_eq(gough_result_write(result, path, &error), GOUGH_OK);
    size_t length;
    char *text = read_bytes(path, &length);
    const gough_quad off = quad_of(strchr(text, '\n') + 1) - (gough_quad)3 / 2;
    ck_assert((off < 0 ? -off : off) <= (gough_quad)1e-33);
    free(text);
    gough_result_free(result);
    free_study_by_hand(study);
    remove_folder(folder);
}
END_TEST

START_TEST(an_unknown_extension_is_named) {
    gough_study *study = study_by_hand("", false);
    gough_result *result = result_by_hand(study, "forces", 1, &own_units);
    gough_error error;
    ck_assert_int_eq(gough_result_write(result, "table.xlsx", &error), GOUGH_ERROR_INPUT);
    ck_assert(strstr(error.message, ".csv") != NULL && strstr(error.message, "table.xlsx") != NULL);
    gough_result_free(result);
    free_study_by_hand(study);
}
END_TEST

int main(void) {
    return SUITE_RUN("table/csv", 60, every_bit_is_in_the_text,
                     header_names_the_columns_of_the_verb, numbers_read_back_bit_for_bit,
                     a_comma_locale_changes_no_byte, what_is_no_number_is_written_as_nan_and_inf,
                     a_quad_run_prints_36_digits, a_quad_run_has_a_quad_unit_of_time,
                     an_unknown_extension_is_named);
}
