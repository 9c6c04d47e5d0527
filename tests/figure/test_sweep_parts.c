/* Sweeps thinned row by row: the points are those of the whole line in order; a picture from a large file is that of the same
 * numbers in memory, to the byte; a map of very many runs says how many of them are in a cell. */
#define _XOPEN_SOURCE 700
#include <math.h>

#include "figure/sweep_thin.h"
#include "support/random.h"
#include "support/suite.h"
#include "table/by_hand.h"

enum { ROWS = 20011 };

static int compare_points(const void *a, const void *b) {
    const sweep_point *p = a, *q = b;
    if (p->x < q->x || p->x > q->x) return p->x < q->x ? -1 : 1;
    return p->row < q->row ? -1 : 1;
}

/* Numbers with ties, gaps and a stretch without any. */
static sweep_point some_point(dice *d, int kind, size_t row) {
    double x = kind == 0   ? (double)row
               : kind == 1 ? floor(dice_between(d, 0, 50))
               : kind == 2 ? exp(dice_between(d, -9, 9))
                           : dice_between(d, -1, 1);
    double y = floor(dice_between(d, -20, 20)) * exp(dice_between(d, -3, 0));
    if (dice_between(d, 0, 1) < 0.05 || (kind == 0 && row > 5000 && row < 5200)) y = NAN;
    return (sweep_point){x, y, dice_between(d, 0, 1) < 0.1, row};
}

START_TEST(lines_keep_the_points_of_whole_lines) {
    const size_t rows = _i / 4 == 0 ? ROWS : _i / 4 == 1 ? SWEEP_POINTS : SWEEP_POINTS + 1;
    sweep_point *all = calloc(ROWS, sizeof *all), *kept = calloc(SWEEP_POINTS, sizeof *kept);
    sweep_line *line = calloc(1, sizeof *line);
    line->whole = calloc(SWEEP_POINTS, sizeof *line->whole);
    dice d = {(unsigned long long)_i + 1};
    for (size_t r = 0; r < rows; r++) {
        all[r] = some_point(&d, _i % 4, r);
        sweep_meet(&line->ends, all[r].x, r);
    }
    for (size_t r = 0; r < rows; r++) sweep_line_add(line, all[r]);
    double low;
    const size_t count = sweep_line_end(line, kept, &low);

    qsort(all, rows, sizeof *all, compare_points);
    double *x = calloc(ROWS, sizeof *x), *y = calloc(ROWS, sizeof *y);
    size_t *index = calloc(SWEEP_POINTS, sizeof *index);
    for (size_t r = 0; r < rows; r++) {
        x[r] = all[r].x;
        y[r] = all[r].y;
    }
    ck_assert_uint_eq(count, sheet_thin(x, y, rows, SWEEP_STRETCHES, index));
    for (size_t k = 0; k < count; k++) ck_assert_uint_eq(kept[k].row, all[index[k]].row);
    free(all), free(kept), free(line->whole), free(line), free(x), free(y), free(index);
}
END_TEST

static int compare_numbers(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

START_TEST(shares_are_those_of_all_numbers) {
    const size_t rows = _i / 4 == 0 ? ROWS : SWEEP_POINTS + 1;
    double *all = calloc(ROWS, sizeof *all), x[SWEEP_POINTS], rank[SWEEP_POINTS];
    sweep_shares *shares = calloc(1, sizeof *shares);
    shares->whole = calloc(SWEEP_POINTS, sizeof *shares->whole);
    dice d = {(unsigned long long)_i + 91};
    for (size_t r = 0; r < rows; r++) {
        all[r] = some_point(&d, _i % 4, r).x;
        sweep_meet(&shares->ends, all[r], r);
    }
    for (size_t r = 0; r < rows; r++) sweep_shares_add(shares, all[r], r);
    const size_t count = sweep_shares_end(shares, x, rank);
    qsort(all, rows, sizeof *all, compare_numbers);
    ck_assert(count >= 2 && count <= SWEEP_POINTS);
    /* the number of a rank, by sorting; the last is all of them */
    for (size_t k = 0; k < count; k++) {
        const size_t at = (size_t)rank[k] - 1;
        ck_assert(at < rows && all[at] >= x[k] && all[at] <= x[k]);
        if (k > 0) ck_assert(rank[k] > rank[k - 1] && x[k] >= x[k - 1]);
    }
    ck_assert((size_t)rank[0] == 1 && (size_t)rank[count - 1] == rows);
    /* between two kept points there is no more than a stretch, or no number */
    const double width = (x[count - 1] - x[0]) / SWEEP_STRETCHES;
    for (size_t k = 1; k < count; k++)
        ck_assert(x[k] - x[k - 1] <= width * (1 + 1e-9) || rank[k] - rank[k - 1] < 1.5);
    free(all), free(shares->whole), free(shares);
}
END_TEST

/* ---- pictures ----------------------------------------------------------------------------------------------------- */

enum { COLUMNS = 9 };

/* kind 0: a line; 1: shares; 2: a map of 30000 × 10 runs */
static gough_table *large_sweep(int kind) {
    static const char *const name[COLUMNS] = {"run",   "load.mass",          "initial.surge",
                                              "x",     "position_deviation", "angle_deviation",
                                              "force", "end_cause",          "power_least"};
    const size_t rows = 300000;
    gough_table *table = gough_table_new("A large sweep", "sweep", COLUMNS, rows);
    double *value[COLUMNS];
    for (size_t c = 0; c < COLUMNS; c++) value[c] = gough_table_name(table, c, name[c], "1");
    dice d = {7};
    for (size_t r = 0; r < rows; r++) {
        value[0][r] = (double)(r + 1);
        value[1][r] = kind == 2 ? 1.0 + (double)(r / 10) : dice_between(&d, 1, 2);
        value[2][r] = kind == 2 ? (double)(r % 10) : kind == 1 ? dice_between(&d, -1, 1) : 0.5;
        value[4][r] = exp(5.0 * value[1][r] / (kind == 2 ? 30000 : 2)) * (1 + value[2][r]);
        value[5][r] = 1.0 + 0.1 * sin(value[1][r]);
        value[6][r] = kind == 1 ? floor(dice_between(&d, 0, 4)) : 1.0 + 1e-12 * value[1][r];
        value[7][r] = r % 1013 == 5 ? GOUGH_END_LEG_LONG : GOUGH_END_DONE;
        value[8][r] = dice_between(&d, -2, 2);
    }
    return table;
}

static char *draw(const gough_figure *figure, const gough_table *table, const char *folder) {
    char path[PATH_SIZE];
    path_in(folder, "a.svg", path);
    gough_error error = {.message = ""};
    ck_assert_msg(gough_figure_draw(figure, &table, NULL, 1, path, &error) == GOUGH_OK, "%s",
                  error.message);
    size_t length;
    return read_bytes(path, &length);
}

START_TEST(a_large_file_gives_the_picture_of_its_numbers) {
    char folder[PATH_SIZE], path[PATH_SIZE];
    static const char *const columns[] = {NULL, "force", "power_least"};
    make_folder(folder);
    path_in(folder, "large.h5", path);
    gough_table *table = large_sweep(_i), *left;
    gough_error error = {.message = ""};
    gough_figure figure = gough_figure_default();
    ck_assert_msg(gough_table_write(table, NULL, path, &error) == GOUGH_OK, "%s", error.message);
    ck_assert(gough_figure_read(&figure, path, &left, &error) == GOUGH_OK);
    ck_assert_msg(left->source != NULL && left->value == NULL, "the file is not left to be read");
    ck_assert_ptr_null(gough_table_column(left, "force"));
    ck_assert_int_eq(gough_table_write(left, NULL, path, &error), GOUGH_ERROR_INPUT);
    for (int k = 0; k < 6; k += 2) {
        figure.columns = columns[k % 3];
        figure.logarithmic = k == 2;
        char *from_file = draw(&figure, left, folder), *from_memory = draw(&figure, table, folder);
        ck_assert_str_eq(from_file, from_memory);
        ck_assert_msg((strstr(from_file, "each cell shows the greatest number of up to 50 runs") !=
                       NULL) == (_i == 2),
                      "the picture's note");
        free(from_file);
        free(from_memory);
    }
    figure.columns = "nonsense";
    path_in(folder, "b.svg", path);
    ck_assert_int_eq(
        gough_figure_draw(&figure, (const gough_table *const *)&left, NULL, 1, path, &error),
        GOUGH_ERROR_INPUT);
    ck_assert_msg(strstr(error.message, "no column nonsense") != NULL, "%s", error.message);
    gough_table_free(left);
    /* any other figure needs the numbers */
    path_in(folder, "large.h5", path);
    figure = gough_figure_default();
    figure.kind = "columns";
    ck_assert(gough_figure_read(&figure, path, &left, &error) == GOUGH_OK);
    ck_assert(left->source == NULL && gough_table_column(left, "force") != NULL);
    gough_table_free(left);
    gough_table_free(table);
    remove_folder(folder);
}
END_TEST

static void count_rows(void *context, const sweep_rows *rows) { *(size_t *)context += rows->count; }

/* As many rows of the same names, but other numbers: a picture of both would be of neither. */
START_TEST(a_file_that_is_replaced_between_two_passes_is_refused) {
    char folder[PATH_SIZE], path[PATH_SIZE];
    make_folder(folder);
    path_in(folder, "large.h5", path);
    gough_table *table = large_sweep(0), *left;
    gough_error error = {.message = ""};
    const gough_figure figure = gough_figure_default();
    ck_assert(gough_table_write(table, NULL, path, &error) == GOUGH_OK);
    ck_assert(gough_figure_read(&figure, path, &left, &error) == GOUGH_OK);
    const gough_table *const tables[] = {left};
    const char *const names[] = {"end_cause"};
    sweep_file files[1] = {{.known = false}};
    builder b = {.tables = tables, .table_count = 1, .error = &error, .files = files};
    size_t rows = 0;
    ck_assert(sweep_visit(&b, 0, names, 1, count_rows, &rows) && rows == table->rows);
    ck_assert(sweep_visit(&b, 0, names, 1, count_rows, &rows) && rows == 2 * table->rows);
    table->value[1][0] += 1;
    ck_assert(gough_table_write(table, NULL, path, &error) == GOUGH_OK);
    ck_assert(!sweep_visit(&b, 0, names, 1, count_rows, &rows));
    ck_assert(b.status == GOUGH_ERROR_FILE && rows == 2 * table->rows);
    ck_assert_msg(strstr(error.message, "has changed while it was being read") != NULL, "%s",
                  error.message);
    gough_table_free(left);
    gough_table_free(table);
    remove_folder(folder);
}
END_TEST

/* A file that goes away, or whose columns change, between two figures is an error, not a wrong picture. */
START_TEST(a_file_that_changed_is_refused) {
    char folder[PATH_SIZE], path[PATH_SIZE], other[PATH_SIZE];
    make_folder(folder);
    path_in(folder, "large.h5", path);
    path_in(folder, "b.svg", other);
    gough_table *table = large_sweep(0), *left;
    gough_error error = {.message = ""};
    const gough_figure figure = gough_figure_default();
    ck_assert(gough_table_write(table, NULL, path, &error) == GOUGH_OK);
    ck_assert(gough_figure_read(&figure, path, &left, &error) == GOUGH_OK);
    ck_assert_ptr_nonnull(gough_table_name(table, 4, "renamed", ""));
    ck_assert(gough_table_write(table, NULL, path, &error) == GOUGH_OK);
    const gough_table *const tables[] = {left};
    ck_assert_int_eq(gough_figure_draw(&figure, tables, NULL, 1, other, &error), GOUGH_ERROR_FILE);
    ck_assert_msg(strstr(error.message, "has changed while it was being read") != NULL, "%s",
                  error.message);
    ck_assert_int_eq(unlink(path), 0);
    ck_assert_int_eq(gough_figure_draw(&figure, tables, NULL, 1, other, &error), GOUGH_ERROR_FILE);
    gough_table_free(left);
    gough_table_free(table);
    remove_folder(folder);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("figure/sweep_parts");
    TCase *cases = tcase_create("sweep_parts");
    tcase_set_timeout(cases, 120);
    tcase_add_loop_test(cases, lines_keep_the_points_of_whole_lines, 0, 12);
    tcase_add_loop_test(cases, shares_are_those_of_all_numbers, 0, 8);
    tcase_add_loop_test(cases, a_large_file_gives_the_picture_of_its_numbers, 0, 3);
    tcase_add_test(cases, a_file_that_changed_is_refused);
    tcase_add_test(cases, a_file_that_is_replaced_between_two_passes_is_refused);
    suite_add_tcase(suite, cases);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
