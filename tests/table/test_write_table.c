/* Tables of any columns: what is written is read back, every bit of it, in a comma locale too; complete or absent. */
#define _XOPEN_SOURCE 700
#include <locale.h>

#include "support/suite.h"
#include "table/by_hand.h"

enum { ROWS = 7, COLUMNS = 3 };

static double number(size_t row, size_t column) {
    static const double awkward_one[] = {0.1, -0.0, 1e-308, 1.7976931348623157e308,
                                         NAN, -3,   1.0 / 3};

    return awkward_one[(row + column) % (sizeof awkward_one / sizeof awkward_one[0])];
}

static gough_table *make_table(void) {
    static const char *const name[COLUMNS][2] = {{"G", "N/m"}, {"deviation", "m"}, {"count", "1"}};
    gough_table *table = gough_table_new("A title, with a comma", "tune", COLUMNS, ROWS);

    ck_assert(table != NULL && isnan(table->tolerance) && isnan(table->step));
    table->tolerance = 1e-7;
    table->max_speed = 3.5;
    for (size_t c = 0; c < COLUMNS; c++) {
        double *value = gough_table_name(table, c, name[c][0], name[c][1]);
        ck_assert(value != NULL && value == gough_table_column(table, name[c][0]));
        for (size_t r = 0; r < ROWS; r++) value[r] = number(r, c);
    }
    return table;
}

static bool same(double a, double b) {
    return (isnan(a) && isnan(b)) || memcmp(&a, &b, sizeof a) == 0;
}

static void check_back(const char *path, bool described) {
    gough_table *back = NULL;
    gough_error error = {0};

    ck_assert_msg(gough_table_read(path, &back, &error) == GOUGH_OK, "%s", error.message);
    ck_assert_uint_eq(back->rows, ROWS);
    ck_assert_uint_eq(back->columns, COLUMNS);
    ck_assert_str_eq(back->name[1], "deviation");
    if (described) {
        ck_assert_str_eq(back->title, "A title, with a comma");
        ck_assert_str_eq(back->verb, "tune");
        ck_assert_str_eq(back->unit[0], "N/m");
    }
    /* CSV has no place for them */
    ck_assert(same(back->tolerance, described ? 1e-7 : NAN) && same(back->step, NAN));
    ck_assert(same(back->max_speed, described ? 3.5 : NAN) && same(back->max_force, NAN));
    for (size_t c = 0; c < COLUMNS; c++)
        for (size_t r = 0; r < ROWS; r++)
            ck_assert_msg(same(back->value[c][r], number(r, c)), "column %zu row %zu: %.17g", c, r,
                          back->value[c][r]);
    gough_table_free(back);
}

START_TEST(a_table_comes_back_as_it_was) {
    char folder[PATH_SIZE], path[PATH_SIZE];
    gough_table *table = make_table();
    gough_error error = {0};

    make_folder(folder);
    setlocale(LC_ALL, "de_DE.UTF-8"); /* where it is installed */
    ck_assert(gough_table_write(table, NULL, path_in(folder, "a.csv", path), &error) == GOUGH_OK);
    setlocale(LC_ALL, "C");
    check_back(path, false);
    ck_assert(gough_table_write(table, "title: x", path_in(folder, "a.h5", path), &error) ==
              GOUGH_OK);
    check_back(path, true);
    gough_table_free(table);
    remove_folder(folder);
}
END_TEST

START_TEST(refuses_what_it_cannot_write) {
    gough_table *table = make_table();
    gough_error error = {0};

    ck_assert(gough_table_write(table, NULL, "curve.txt", &error) == GOUGH_ERROR_INPUT);
    ck_assert(strstr(error.message, "must end in .h5") != NULL);
    ck_assert(gough_table_write(table, NULL, "/nowhere/at/all/a.csv", &error) == GOUGH_ERROR_FILE);
    ck_assert(strstr(error.message, "/nowhere/at/all") != NULL);
    ck_assert(gough_table_write(table, NULL, "/nowhere/at/all/a.h5", &error) == GOUGH_ERROR_FILE);
    gough_table_free(table);
}
END_TEST

int main(void) {
    return SUITE_RUN("write_table", 60, a_table_comes_back_as_it_was, refuses_what_it_cannot_write);
}
