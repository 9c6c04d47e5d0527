/* Units of a table: scaling against numbers worked out by hand, labels, angles in degrees. */
#define _XOPEN_SOURCE 700
#include "support/suite.h"
#include "table/by_hand.h"

/* Writes one row of ones (angles of one radian) in the given units and reads it back. */
static gough_table *row_of_ones(const gough_units *units) {
    char folder[PATH_SIZE], path[PATH_SIZE];
    make_folder(folder);
    path_in(folder, "ones.h5", path);
    gough_study *study = study_by_hand("ones", true);
    gough_result *result = gough_result_new(study, "simulate", units);
    gough_row row = {.quad = NULL};
    for (int c = 0; c < GOUGH_COLUMNS; c++) row.value[c] = 1.0;
    ck_assert_int_eq(gough_result_add(result, &row), 0);
    const gough_end end = {.cause = GOUGH_END_DONE, .time = 20.0};
    gough_result_set_end(result, &end);

    gough_error error = {.message = ""};
    gough_table *table = NULL;
    ck_assert_msg(gough_result_write(result, path, &error) == GOUGH_OK, "%s", error.message);
    ck_assert_msg(gough_table_read(path, &table, &error) == GOUGH_OK, "%s", error.message);
    gough_result_free(result);
    free_study_by_hand(study);
    remove_folder(folder);
    return table;
}

static void expect_value(const gough_table *table, const char *name, double value) {
    const double *column = gough_table_column(table, name);
    ck_assert_msg(column != NULL, "no column %s", name);
    /* one rounding of the factor, one of the product */
    ck_assert_msg(fabs(column[0] - value) <= 4e-16 * fabs(value), "%s: %.17g, not %.17g", name,
                  column[0], value);
}

static void expect_unit(const gough_table *table, const char *name, const char *unit) {
    for (size_t c = 0; c < table->columns; c++) {
        if (strcmp(table->name[c], name) == 0) {
            ck_assert_str_eq(table->unit[c], unit);
            return;
        }
    }
    ck_abort_msg("no column %s", name);
}

START_TEST(own_units_leave_numbers_and_turn_radians_into_degrees) {
    gough_table *table = row_of_ones(&own_units);
    const double degrees = 57.29577951308232;
    for (size_t c = 0; c < table->columns; c++) {
        const bool angle = strstr(table->unit[c], "degree") != NULL;
        expect_value(table, table->name[c], angle ? degrees : 1.0);
    }
    expect_value(table, "roll", degrees);
    expect_value(table, "wz", degrees);
    expect_value(table, "alx", degrees);
    expect_value(table, "eyaw", degrees);
    ck_assert(fabs(table->end_time - 20.0) <= 0.0);
    gough_table_free(table);
}
END_TEST

/* R_b = 4, M = 10, g = 9, time 2/3: velocity 6, acceleration 9, force 90, energy 360, power 540. */
START_TEST(dimensionless_numbers_are_those_worked_out_by_hand) {
    gough_study *study = study_by_hand("", false);
    gough_units units;
    gough_error error;
    ck_assert_int_eq(gough_units_of_study(study, true, &units, &error), GOUGH_OK);
    ck_assert(units.dimensionless);
    free_study_by_hand(study);

    gough_table *table = row_of_ones(&units);
    const double degrees = 57.29577951308232;
    expect_value(table, "t", 1.5);
    expect_value(table, "x", 0.25);
    expect_value(table, "vx", 1.0 / 6.0);
    expect_value(table, "az", 1.0 / 9.0);
    expect_value(table, "l6", 0.25);
    expect_value(table, "dl1", 1.0 / 6.0);
    expect_value(table, "f3", 1.0 / 90.0);
    expect_value(table, "p4", 1.0 / 540.0);
    expect_value(table, "rxy", 1.0 / 360.0);
    expect_value(table, "pitch", degrees);
    expect_value(table, "wx", degrees / 1.5);
    expect_value(table, "aly", degrees / 2.25);
    expect_value(table, "condition", 1.0);
    expect_value(table, "drift", 1.0);
    ck_assert(fabs(table->end_time - 30.0) <= 1e-14);
    gough_table_free(table);
}
END_TEST

START_TEST(si_units_are_named) {
    gough_table *table = row_of_ones(&own_units);
    expect_unit(table, "t", "s");
    expect_unit(table, "z", "m");
    expect_unit(table, "yaw", "degree");
    expect_unit(table, "vy", "m/s");
    expect_unit(table, "wx", "degree/s");
    expect_unit(table, "az", "m/s2");
    expect_unit(table, "alx", "degree/s2");
    expect_unit(table, "l1", "m");
    expect_unit(table, "dl2", "m/s");
    expect_unit(table, "f3", "N");
    expect_unit(table, "p4", "W");
    expect_unit(table, "condition", "1");
    expect_unit(table, "ex", "m");
    expect_unit(table, "eroll", "degree");
    expect_unit(table, "drift", "1");
    expect_unit(table, "rzx", "N m");
    expect_unit(table, "h1", "N");
    expect_unit(table, "tz3", "N");
    expect_unit(table, "by6", "N");
    expect_unit(table, "s4", "N");
    gough_table_free(table);
}
END_TEST

START_TEST(dimensionless_units_are_1_and_angles_stay_degrees) {
    const gough_units units = {.dimensionless = true, .length = 1, .mass = 1, .time = 1};
    gough_table *table = row_of_ones(&units);
    for (size_t c = 0; c < table->columns; c++) {
        const char *name = table->name[c];
        const bool angle = strstr(name, "roll") || strstr(name, "pitch") || strstr(name, "yaw") ||
                           name[0] == 'w' || strncmp(name, "al", 2) == 0;
        ck_assert_str_eq(table->unit[c], angle ? "degree" : "1");
    }
    gough_table_free(table);
}
END_TEST

START_TEST(own_units_are_asked_for_by_default) {
    gough_study *study = study_by_hand("", false);
    gough_units units;
    gough_error error;
    ck_assert_int_eq(gough_units_of_study(study, false, &units, &error), GOUGH_OK);
    ck_assert(!units.dimensionless);
    ck_assert(fabs(units.length - 1.0) + fabs(units.mass - 1.0) + fabs(units.time - 1.0) <= 0.0);
    study->dimensionless = true;
    ck_assert_int_eq(gough_units_of_study(study, false, &units, &error), GOUGH_OK);
    ck_assert(units.dimensionless);
    free_study_by_hand(study);
}
END_TEST

START_TEST(no_dimensionless_form_without_gravity) {
    gough_study *study = study_by_hand("", false);
    study->model->machine.gravity_magnitude = 0.0;
    gough_units units;
    gough_error error = {.message = ""};
    ck_assert_int_eq(gough_units_of_study(study, true, &units, &error), GOUGH_ERROR_INPUT);
    ck_assert(strstr(error.message, "gravity") != NULL);
    ck_assert_int_eq(gough_units_of_study(study, false, &units, &error), GOUGH_OK);
    free_study_by_hand(study);
}
END_TEST

START_TEST(columns_of_a_table_have_its_numbers_as_written) {
    gough_study *study = study_by_hand("", false);
    gough_result *result = result_by_hand(study, "simulate", 3, &own_units);
    gough_result_column column = {.rows = 99};
    int count = 0;
    while (gough_result_column_at(result, count, &column)) {
        const gough_column_info *info = gough_column(count);
        ck_assert_str_eq(column.name, info->name);
        ck_assert_str_eq(column.long_name, info->long_name);
        ck_assert_uint_eq(column.rows, 3);
        const double factor = info->angle ? 57.295779513082320877 : 1;
        for (size_t r = 0; r < 3; r++) {
            const double number = count == GOUGH_T ? (double)r / 8.0 : awkward(r, count);
            ck_assert(fabs(column.value[r] - factor * number) <= 4e-16 * fabs(factor * number));
        }
        count++;
    }
    ck_assert_int_eq(count, GOUGH_RXX);
    column = (gough_result_column){.rows = 99};
    ck_assert(!gough_result_column_at(result, -1, &column));
    ck_assert(!gough_result_column_at(result, GOUGH_COLUMNS, &column));
    ck_assert_uint_eq(column.rows, 99);
    gough_result_free(result);
    free_study_by_hand(study);
}
END_TEST

/* The order of every table, written out once more. */
START_TEST(columns_are_those_of_every_table_in_order) {
    static const char *const names[] = {
        "t",     "x",    "y",   "z",         "roll", "pitch", "yaw", "vx",    "vy",     "vz",
        "wx",    "wy",   "wz",  "ax",        "ay",   "az",    "alx", "aly",   "alz",    "l1",
        "l2",    "l3",   "l4",  "l5",        "l6",   "dl1",   "dl2", "dl3",   "dl4",    "dl5",
        "dl6",   "f1",   "f2",  "f3",        "f4",   "f5",    "f6",  "p1",    "p2",     "p3",
        "p4",    "p5",   "p6",  "condition", "ex",   "ey",    "ez",  "eroll", "epitch", "eyaw",
        "drift", "rxx",  "ryy", "rzz",       "rxy",  "ryz",   "rzx", "h1",    "h2",     "h3",
        "h4",    "h5",   "h6",  "tx1",       "ty1",  "tz1",   "tx2", "ty2",   "tz2",    "tx3",
        "ty3",   "tz3",  "tx4", "ty4",       "tz4",  "tx5",   "ty5", "tz5",   "tx6",    "ty6",
        "tz6",   "bx1",  "by1", "bz1",       "bx2",  "by2",   "bz2", "bx3",   "by3",    "bz3",
        "bx4",   "by4",  "bz4", "bx5",       "by5",  "bz5",   "bx6", "by6",   "bz6",    "s1",
        "s2",    "s3",   "s4",  "s5",        "s6",   "u1",    "u2",  "u3",    "u4",     "u5",
        "u6",    "m1",   "m2",  "m3",        "m4",   "m5",    "m6",  "sat1",  "sat2",   "sat3",
        "sat4",  "sat5", "sat6"};
    ck_assert_uint_eq(sizeof names / sizeof names[0], GOUGH_COLUMNS);
    for (int c = 0; c < GOUGH_COLUMNS; c++) ck_assert_str_eq(gough_column(c)->name, names[c]);
}
END_TEST

/* 10^l 100^m 1000^t of the exponents tells units apart. */
START_TEST(every_column_has_the_unit_of_its_exponents) {
    const gough_units units = {.dimensionless = true, .length = 10, .mass = 100, .time = 1000};
    for (int c = 0; c < GOUGH_COLUMNS; c++) {
        const gough_column_info *info = gough_column(c);
        const double size = pow(10, info->length + 2 * info->mass + 3 * info->time);
        const gough_unit unit = gough_unit_of_column(c);
        ck_assert_msg(fabs(gough_unit_size(&units, unit) - size) <= 1e-15 * size, "%s", info->name);
        ck_assert_msg((strncmp(gough_unit_label(&units, unit), "degree", 6) == 0) ==
                          (info->angle != 0),
                      "%s", info->name);
    }
    ck_assert_int_eq(gough_unit_of_column(-1), GOUGH_UNIT_NONE);
}
END_TEST

/* Tables and texts differ in how they write powers and degrees alone. */
START_TEST(labels_and_words_name_the_same_unit) {
    const gough_units units = {.length = 2, .mass = 3, .time = 5}, none = {.dimensionless = true};
    for (gough_unit u = GOUGH_UNIT_LENGTH; u <= GOUGH_UNIT_INERTIA; u++) {
        const char *label = gough_unit_label(&units, u), *word = gough_unit_word(&units, u);
        ck_assert_msg(*word++ == ' ', "%s", label);
        for (; *label || *word; label++, word++) {
            if (*word == '^') word++;
            ck_assert_msg(*label == *word, "%s is not %s", label, word);
            if (strncmp(label, "degree", 6) == 0) label += 5, word += 2;
        }
        const double turn = u == GOUGH_UNIT_ANGLE || u == GOUGH_UNIT_ANGULAR_SPEED ||
                                    u == GOUGH_UNIT_ANGULAR_ACCELERATION
                                ? 57.29577951308232
                                : 1;
        ck_assert(fabs(gough_unit_factor(&units, u) * gough_unit_size(&units, u) - turn) <=
                  1e-15 * turn);
    }
    ck_assert_str_eq(gough_unit_word(&none, GOUGH_UNIT_FORCE), "");
    ck_assert_str_eq(gough_unit_label(&units, (gough_unit)99), "1");
}
END_TEST

int main(void) {
    return SUITE_RUN(
        "table/units", 30, own_units_leave_numbers_and_turn_radians_into_degrees,
        dimensionless_numbers_are_those_worked_out_by_hand, si_units_are_named,
        dimensionless_units_are_1_and_angles_stay_degrees, own_units_are_asked_for_by_default,
        no_dimensionless_form_without_gravity, columns_of_a_table_have_its_numbers_as_written,
        columns_are_those_of_every_table_in_order, every_column_has_the_unit_of_its_exponents,
        labels_and_words_name_the_same_unit);
}
