/* Figures of sweeps: a line over one key, a map over two, shares of the runs over more, each chosen by the table; runs that ended
 * early are marked. */
#define _XOPEN_SOURCE 700
#include "gough/report.h"
#include "support/suite.h"
#include "table/by_hand.h"

/* A sweep of columns × rows runs; the last run ended early. keys: 1, 2 or 3, the third in no grid. */
static gough_table *sweep_table(size_t columns, size_t rows, size_t keys) {
    static const char *const names[] = {
        "run", "control.stiffness",  "load.mass",       "initial.yaw",
        "x",   "position_deviation", "angle_deviation", "end_cause"};
    gough_table *table = calloc(1, sizeof *table);
    *table = (gough_table){.rows = columns * rows, .columns = 8, .end_time = NAN};
    table->title = strdup("A sweep");
    table->verb = strdup("sweep");
    table->end_cause = strdup("");
    table->name = calloc(8, sizeof *table->name);
    table->unit = calloc(8, sizeof *table->unit);
    table->value = calloc(8, sizeof *table->value);
    for (size_t c = 0; c < 8; c++) {
        table->name[c] = strdup(names[c]);
        table->unit[c] = strdup("");
        table->value[c] = calloc(columns * rows, sizeof(double));
    }
    for (size_t r = 0; r < columns * rows; r++) {
        table->value[0][r] = (double)(r + 1);
        table->value[1][r] = pow(10.0, (double)(r % columns) / 4.0);
        table->value[2][r] = keys > 1 ? 1.0 + (double)(r / columns) : 1.0;
        table->value[3][r] = keys > 2 ? sin((double)r) : 0.0;
        table->value[5][r] = 1.0 / table->value[1][r];
        table->value[6][r] = 2.0 / table->value[2][r];
        table->value[7][r] = r + 1 == columns * rows ? GOUGH_END_LEG_LONG : GOUGH_END_DONE;
    }
    return table;
}

static char *draw(const gough_figure *figure, const gough_table *const *tables, size_t count) {
    char folder[PATH_SIZE], path[PATH_SIZE];
    make_folder(folder);
    path_in(folder, "a.svg", path);
    gough_error error = {.message = ""};
    ck_assert_msg(gough_figure_draw(figure, tables, NULL, count, path, &error) == GOUGH_OK, "%s",
                  error.message);
    size_t length;
    char *text = read_bytes(path, &length);
    ck_assert_ptr_nonnull(strstr(text, "</svg>"));
    remove_folder(folder);
    return text;
}

static void expect_refused(const gough_figure *figure, const gough_table *const *tables,
                           size_t count, const char *sentence) {
    char folder[PATH_SIZE], path[PATH_SIZE];
    make_folder(folder);
    path_in(folder, "a.svg", path);
    gough_error error = {.message = ""};
    ck_assert_int_eq(gough_figure_draw(figure, tables, NULL, count, path, &error),
                     GOUGH_ERROR_INPUT);
    ck_assert_msg(strstr(error.message, sentence) != NULL, "%s", error.message);
    remove_folder(folder);
}

START_TEST(one_key_is_a_line_of_two_panels) {
    gough_table *table = sweep_table(17, 1, 1);
    const gough_table *tables[] = {table, table};
    const gough_figure figure = gough_figure_default();
    char *text = draw(&figure, tables, 1);
    ck_assert_ptr_nonnull(strstr(text, "Largest deviation of position"));
    ck_assert_ptr_nonnull(strstr(text, "Largest deviation of angle"));
    ck_assert_ptr_nonnull(strstr(text, "control.stiffness"));
    ck_assert_ptr_nonnull(strstr(text, "ended early"));
    free(text);
    free(draw(&figure, tables, 2));
    gough_table_free(table);
}
END_TEST

START_TEST(two_keys_are_a_map) {
    gough_table *table = sweep_table(9, 5, 2);
    const gough_table *tables[] = {table, table};
    gough_figure figure = gough_figure_default();
    char *text = draw(&figure, tables, 1);
    ck_assert_ptr_nonnull(strstr(text, "load.mass"));
    ck_assert_ptr_nonnull(strstr(text, "grey: ended early"));
    free(text);
    figure.columns = "angle_deviation,x";
    text = draw(&figure, tables, 1);
    ck_assert_ptr_nonnull(strstr(text, "Largest deviation of angle"));
    ck_assert_ptr_null(strstr(text, "Largest deviation of position"));
    free(text);
    gough_table_free(table);
}
END_TEST

/* The fill of the last rectangle drawn over a place; "" if none. */
static void colour_at(const char *svg, double x, double y, char colour[32]) {
    static const char start[] = "<polygon fill = 'rgb(";
    colour[0] = '\0';
    for (const char *at = svg; (at = strstr(at, start)) != NULL; at++) {
        double left, low, right, high;
        const char *points = strstr(at, "points = '");
        if (points == NULL ||
            sscanf(points + 10, "%lf,%lf %lf,%*f %*f,%lf", &left, &low, &right, &high) != 4)
            continue;
        if (x > left && x < right && y < low && y > high)
            snprintf(colour, 32, "%.*s", (int)strcspn(at + strlen(start), ")"), at + strlen(start));
    }
}

/* Every cell is of one colour from edge to edge, grey where and only where the run ended early. */
START_TEST(cells_of_a_map_end_at_their_edges) {
    enum { COLUMNS = 4, ROWS = 3 };
    static const bool ended[ROWS][COLUMNS] = {{1, 0, 0, 1}, {0, 1, 0, 0}, {1, 1, 0, 1}};
    const gough_figure figure = gough_figure_default();
    gough_table *table = sweep_table(COLUMNS, ROWS, 2);
    const gough_table *tables[] = {table};
    for (size_t r = 0; r < COLUMNS * ROWS; r++) {
        table->value[1][r] = 1.0 + (double)(r % COLUMNS);
        table->value[7][r] = ended[r / COLUMNS][r % COLUMNS] ? GOUGH_END_LEG_LONG : GOUGH_END_DONE;
        table->value[5][r] = 1.0 + (double)r;
    }
    char *svg = draw(&figure, tables, 1);
    double left = 0, right = 0, low = 0, high = 0;
    const char *border = strstr(svg, "<path stroke='rgb( 51,  51,  51)'  d='M");
    for (; border != NULL; border = strstr(border + 1, "<path stroke='rgb( 51,  51,  51)'  d='M"))
        if (sscanf(strstr(border, "d='M") + 4, "%lf,%lf L%*f,%lf L%lf,", &left, &high, &low,
                   &right) == 4 &&
            right > left + 300 && low > high + 100)
            break;
    ck_assert_msg(border != NULL, "no border");
    for (int r = 0; r < ROWS; r++)
        for (int c = 0; c < COLUMNS; c++) {
            char colour[32], first[32] = "";
            for (int k = 0; k < 4; k++) {
                const double across = k % 2 ? 0.04 : 0.96, up = k / 2 ? 0.04 : 0.96;
                colour_at(svg, left + (right - left) * (c + across) / COLUMNS,
                          low - (low - high) * (r + up) / ROWS, colour);
                if (k == 0) strcpy(first, colour);
                ck_assert_str_eq(colour, first);
            }
            ck_assert_msg((strcmp(first, "201, 201, 201") == 0) == ended[r][c], "%d %d: %s", r, c,
                          first);
        }
    free(svg);
    gough_table_free(table);
}
END_TEST

START_TEST(a_grid_with_a_hole_is_no_map) {
    gough_table *table = sweep_table(9, 5, 2);
    const gough_table *tables[] = {table};
    const gough_figure figure = gough_figure_default();
    table->value[1][3] = table->value[1][4]; /* one pair twice, another never */
    char *text = draw(&figure, tables, 1);
    ck_assert_ptr_nonnull(strstr(text, "Runs that reach their end"));
    free(text);
    gough_table_free(table);
}
END_TEST

START_TEST(more_keys_are_shares_of_the_runs) {
    gough_table *table = sweep_table(9, 5, 3);
    const gough_table *tables[] = {table, table};
    gough_figure figure = gough_figure_default();
    char *text = draw(&figure, tables, 2);
    ck_assert_ptr_nonnull(strstr(text, "Runs that reach their end"));
    free(text);
    figure.columns = "x,angle_deviation";
    expect_refused(&figure, tables, 1, "choose one with --columns");
    figure.columns = "nonsense";
    expect_refused(&figure, tables, 1, "no column nonsense");
    gough_table_free(table);
}
END_TEST

START_TEST(degenerate_sweeps_are_drawn_or_refused) {
    const gough_figure figure = gough_figure_default();
    gough_table *one = sweep_table(1, 1, 1);
    const gough_table *tables[] = {one};
    free(draw(&figure, tables, 1));
    for (size_t c = 4; c < 7; c++) one->value[c][0] = NAN; /* an invalid run */
    free(draw(&figure, tables, 1));
    one->rows = 0;
    expect_refused(&figure, tables, 1, "no runs to draw");
    gough_table_free(one);
    gough_table *grid = sweep_table(3, 3, 2);
    const gough_table *grids[] = {grid};
    for (size_t r = 0; r < grid->rows; r++) grid->value[7][r] = GOUGH_END_SINGULAR;
    free(draw(&figure, grids, 1));
    gough_table_free(grid);
}
END_TEST

int main(void) {
    return SUITE_RUN("figure/sweep", 60, one_key_is_a_line_of_two_panels, two_keys_are_a_map,
                     cells_of_a_map_end_at_their_edges, a_grid_with_a_hole_is_no_map,
                     more_keys_are_shares_of_the_runs, degenerate_sweeps_are_drawn_or_refused);
}
