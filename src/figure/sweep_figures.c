/* Figures of sweeps. The swept keys are the columns between `run` and `x`: where one of them varies, lines over it; where two vary
 * over a grid, a map; for anything else, what share of the runs has at most which deviation. Runs that ended early are marked. */
#define _POSIX_C_SOURCE 200809L
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "figure/builder.h"
#include "figure/palette.h"

enum { MOST_POINTS = 200, MOST_NAMES = 12, FEW_VALUES = 50 };

static size_t column_index(const gough_table *table, const char *name) {
    size_t c = 0;
    while (c < table->columns && strcmp(table->name[c], name) != 0) c++;
    return c;
}

bool sheet_is_sweep(const gough_table *table) {
    return table->columns > 3 && strcmp(table->name[0], "run") == 0 &&
           column_index(table, "x") < table->columns &&
           column_index(table, "end_cause") < table->columns;
}

/* ---- what was swept ----------------------------------------------------------------------------------------------- */

static int compare_numbers(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The distinct values of a column, increasing, in an array of the sheet. */
static double *distinct(builder *b, size_t table, size_t column, size_t *count) {
    const gough_table *t = b->tables[table];
    double *value = builder_array(b, table);
    *count = 0;
    if (value == NULL) return NULL;
    if (t->rows > 0) memcpy(value, t->value[column], t->rows * sizeof *value);
    qsort(value, t->rows, sizeof *value, compare_numbers);
    for (size_t r = 0; r < t->rows; r++)
        if (*count == 0 || value[r] > value[*count - 1]) value[(*count)++] = value[r];
    return value;
}

/* The swept columns of the first table that vary; how many, of which two are kept. */
static size_t varying(builder *b, size_t column[2]) {
    const gough_table *t = b->tables[0];
    const size_t end = column_index(t, "x");
    size_t found = 0;
    for (size_t c = 1; c < end; c++) {
        bool varies = false;
        for (size_t r = 1; r < t->rows && !varies; r++)
            varies = t->value[c][r] < t->value[c][0] || t->value[c][r] > t->value[c][0];
        if (varies && found < 2) column[found] = c;
        found += varies;
    }
    if (found == 0) column[found++] = 1;
    return found;
}

static bool equal_steps(const double *value, size_t count, bool ratios) {
    for (size_t i = 1; i < count; i++) {
        const double first = ratios ? value[1] / value[0] : value[1] - value[0];
        const double step = ratios ? value[i] / value[i - 1] : value[i] - value[i - 1];
        if (!(fabs(step - first) <= 1e-6 * fabs(first))) return false;
    }
    return true;
}

/* A grid of equal ratios, or a short list over decades. */
static bool is_logarithmic(const double *value, size_t count) {
    if (count < 3 || !(value[0] > 0.0) || equal_steps(value, count, false)) return false;
    return equal_steps(value, count, true) ||
           (count <= FEW_VALUES && value[count - 1] / value[0] >= 30.0);
}

/* ---- names -------------------------------------------------------------------------------------------------------- */

enum { HEADING = 100 };

/* What a column is, as a heading: text is room for it. */
static const char *heading_of(const char *name, char text[HEADING]) {
    static const char *const known[][2] = {
        {"position_deviation", "Largest deviation of position from the program"},
        {"angle_deviation", "Largest deviation of angle from the program"},
        {"force", "Largest leg force"},
        {"speed", "Largest leg speed"},
        {"power", "Largest leg power"},
        {"power_least", "Least leg power (below 0 a leg brakes)"},
        {"power_greatest", "Greatest leg power"},
        {"energy", "Net work of the legs"},
        {"drift", "Largest constraint drift"},
        {"end_time", "Time of the end"},
#define GOUGH_SIZING_COLUMN(id, name, what, unit, of_legs) {name, what},
#include "gough/sizing.def"
    };
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
        if (strcmp(name, known[i][0]) == 0) {
            snprintf(text, HEADING, "%s", known[i][1]);
            text[0] = (char)toupper((unsigned char)text[0]);
            return text;
        }
    return name;
}

static void name_axis(builder *b, char *label, size_t size, const char *name, const char *said) {
    char unit[48];
    sheet_unit_label(unit, sizeof unit, builder_unit(b, name), 0);
    snprintf(label, size, "%.100s%s", said, unit);
}

/* Whether a sweep is one of forces along a program: it has no deviations from it, and its runs do not end where they exceed a
 * limit. */
static bool is_of_forces(const gough_table *table) {
    const size_t deviation = column_index(table, "position_deviation");
    const size_t force = column_index(table, "force");
    bool any = false;
    for (size_t r = 0; r < table->rows; r++) {
        if (deviation == table->columns || !isnan(table->value[deviation][r])) return false;
        any = any || (force < table->columns && !isnan(table->value[force][r]));
    }
    return any;
}

/* The columns to draw: those asked for, or deviations, or of a sweep of forces these. */
static size_t names_of(builder *b, char names[MOST_NAMES][64], bool both) {
    const char *list = b->figure->columns;
    if (list == NULL && is_of_forces(b->tables[0])) list = both ? "force,power" : "force";
    if (list == NULL) list = both ? "position_deviation,angle_deviation" : "position_deviation";
    size_t count = 0;
    while (count < MOST_NAMES) {
        const size_t length = strcspn(list, ",");
        snprintf(names[count++], 64, "%.*s", (int)(length < 63 ? length : 63), list);
        if (list[length] == '\0') break;
        list += length + 1;
    }
    return count;
}

/* Whether positive numbers of the column span two decades. */
static bool spans_decades(const gough_table *table, const double *value) {
    double least = INFINITY, greatest = 0.0;
    for (size_t r = 0; r < table->rows; r++) {
        if (value[r] < 0.0) return false;
        if (!(value[r] > 0.0)) continue;
        least = fmin(least, value[r]);
        greatest = fmax(greatest, value[r]);
    }
    return greatest > 100.0 * least;
}

/* Values that differ by less than this share of their size differ by rounding, as a side load that no swept number changes. */
static const double same_share = 1e-9;

/* Makes such values equal, lest rounding be drawn as a signal. */
static void level(double *value, size_t count) {
    double least = INFINITY, greatest = -INFINITY;
    for (size_t i = 0; i < count; i++) {
        least = fmin(least, value[i]);
        greatest = fmax(greatest, value[i]);
    }
    if (!(greatest - least <= same_share * fmax(fabs(least), fabs(greatest)))) return;
    for (size_t i = 0; i < count; i++)
        if (!isnan(value[i])) value[i] = greatest;
}

/* ---- over one key ------------------------------------------------------------------------------------------------- */

typedef struct point {
    double x, y, ended;
} point;

static int compare_points(const void *a, const void *b) {
    return compare_numbers(&((const point *)a)->x, &((const point *)b)->x);
}

/* A table's points in the order of the key. */
static void add_line(builder *b, panel *p, size_t table, const char *key, const char *name) {
    const gough_table *t = b->tables[table];
    const double *x = builder_column(b, table, key), *y = builder_column(b, table, name);
    const double *cause = builder_column(b, table, "end_cause");
    double *array[3] = {builder_array(b, table), builder_array(b, table), builder_array(b, table)};
    point *sorted = malloc((t->rows > 0 ? t->rows : 1) * sizeof *sorted);
    if (sorted == NULL) builder_fail(b, GOUGH_ERROR_FILE, "out of memory for this figure");
    if (b->status == GOUGH_OK && p != NULL) {
        for (size_t r = 0; r < t->rows; r++) sorted[r] = (point){x[r], y[r], cause[r] > 0.5};
        qsort(sorted, t->rows, sizeof *sorted, compare_points);
        for (size_t r = 0; r < t->rows; r++) {
            array[0][r] = sorted[r].x;
            array[1][r] = sorted[r].y;
            array[2][r] = sorted[r].ended;
        }
        level(array[1], t->rows);
        series *line = &p->series[p->count++];
        *line = (series){
            .count = t->rows, .x = array[0], .y = array[1], .colour = colour_of_table(table)};
        bool any = false;
        for (size_t r = 0; r < t->rows; r++) any = any || array[2][r] > 0.5;
        line->points = t->rows <= MOST_POINTS;
        line->ended = any ? array[2] : NULL;
        if (is_of_forces(t)) line->ended_label = "limit exceeded";
        if (builder_compares(b))
            snprintf(line->label, sizeof line->label, "%s", builder_label(b, table));
    }
    free(sorted);
}

static void fill_lines(builder *b, size_t key) {
    char names[MOST_NAMES][64];
    const char *path = b->tables[0]->name[key];
    const size_t count = names_of(b, names, true);
    size_t values;
    const double *value = distinct(b, 0, key, &values);
    if (value == NULL) return;
    b->sheet->logarithmic_abscissa = is_logarithmic(value, values);
    name_axis(b, b->sheet->abscissa, sizeof b->sheet->abscissa, path, path);
    if (b->table_count > SHEET_SERIES) builder_fail(b, GOUGH_ERROR_INPUT, "too many results");
    for (size_t i = 0; i < count && b->status == GOUGH_OK; i++) {
        bool wide = b->figure->logarithmic;
        for (size_t t = 0; t < b->table_count; t++) {
            const double *column = builder_column(b, t, names[i]);
            if (column != NULL) wide = wide || spans_decades(b->tables[t], column);
        }
        char heading[HEADING];
        panel *p = builder_panel(b, heading_of(names[i], heading), builder_unit(b, names[i]), wide);
        if (p != NULL) p->noise = builder_noise(b, names[i]);
        for (size_t t = 0; t < b->table_count; t++) add_line(b, p, t, path, names[i]);
    }
}

/* ---- over two keys ------------------------------------------------------------------------------------------------ */

static size_t place_of(const double *value, size_t count, double wanted) {
    size_t low = 0, high = count;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (value[middle] <= wanted)
            low = middle;
        else
            high = middle;
    }
    return low;
}

static void add_map(builder *b, const map *grid, const size_t key[2], const char *name) {
    const gough_table *t = b->tables[0];
    const double *value = builder_column(b, 0, name), *cause = builder_column(b, 0, "end_cause");
    double *cells = builder_array(b, 0);
    if (cells == NULL || value == NULL) return;
    const bool forces = is_of_forces(t);
    for (size_t r = 0; r < t->rows; r++) {
        const bool missing = forces ? isnan(value[r]) : cause[r] > 0.5;
        const size_t column = place_of(grid->x, grid->columns, t->value[key[0]][r]);
        const size_t row = place_of(grid->y, grid->rows, t->value[key[1]][r]);
        cells[row * grid->columns + column] = missing ? NAN : value[r];
        if (missing) snprintf(b->sheet->note, sizeof b->sheet->note, "grey: ended early");
    }
    level(cells, t->rows);
    const bool wide = b->figure->logarithmic || spans_decades(t, cells);
    char heading[HEADING];
    panel *p = builder_panel(b, heading_of(name, heading), builder_unit(b, name), wide);
    if (p == NULL) return;
    p->noise = builder_noise(b, name);
    p->mapped = true;
    p->map = *grid;
    p->map.cells = cells;
}

/* Whether there is one run for each pair of values. */
static bool is_grid(const gough_table *table, const map *grid, const size_t key[2]) {
    if (grid->columns * grid->rows != table->rows) return false;
    bool *met = calloc(table->rows, sizeof *met), good = met != NULL;
    for (size_t r = 0; good && r < table->rows; r++) {
        const size_t cell = place_of(grid->y, grid->rows, table->value[key[1]][r]) * grid->columns +
                            place_of(grid->x, grid->columns, table->value[key[0]][r]);
        good = !met[cell];
        met[cell] = true;
    }
    free(met);
    return good;
}

static void fill_map(builder *b, map *grid, const size_t key[2]) {
    char names[MOST_NAMES][64];
    const gough_table *t = b->tables[0];
    const size_t count = names_of(b, names, false);
    b->sheet->logarithmic_abscissa = is_logarithmic(grid->x, grid->columns);
    grid->logarithmic_y = is_logarithmic(grid->y, grid->rows);
    name_axis(b, b->sheet->abscissa, sizeof b->sheet->abscissa, t->name[key[0]], t->name[key[0]]);
    name_axis(b, grid->ordinate, sizeof grid->ordinate, t->name[key[1]], t->name[key[1]]);
    for (size_t i = 0; i < count; i++) add_map(b, grid, key, names[i]);
}

/* ---- over more ---------------------------------------------------------------------------------------------------- */

/* Percent of all runs with at most this; runs that ended early have no number, so that the line ends below 100. */
static void fill_shares(builder *b) {
    char names[MOST_NAMES][64];
    bool wide = b->figure->logarithmic;
    if (names_of(b, names, false) > 1) {
        builder_fail(
            b, GOUGH_ERROR_INPUT,
            "shares of the runs can be drawn for one column only; choose one with --columns");
        return;
    }
    const char *name = names[0];
    char heading[HEADING];
    name_axis(b, b->sheet->abscissa, sizeof b->sheet->abscissa, name, heading_of(name, heading));
    const bool forces = is_of_forces(b->tables[0]);
    panel *p = builder_panel(
        b, forces ? "Runs with at most this" : "Runs that reach their end with at most this", "%",
        false);
    for (size_t t = 0; t < b->table_count; t++) {
        const gough_table *table = b->tables[t];
        const double *value = builder_column(b, t, name),
                     *cause = builder_column(b, t, "end_cause");
        double *x = builder_array(b, t), *y = builder_array(b, t);
        if (b->status != GOUGH_OK || p == NULL || p->count == SHEET_SERIES) return;
        size_t count = 0;
        for (size_t r = 0; r < table->rows; r++)
            if ((forces || !(cause[r] > 0.5)) && isfinite(value[r])) x[count++] = value[r];
        qsort(x, count, sizeof *x, compare_numbers);
        for (size_t i = 0; i < count; i++) y[i] = 100.0 * (double)(i + 1) / (double)table->rows;
        wide = wide || (count > 0 && x[0] > 0.0 && x[count - 1] > 100.0 * x[0]);
        series *line = &p->series[p->count++];
        *line = (series){.count = count, .x = x, .y = y, .colour = colour_of_table(t)};
        if (builder_compares(b))
            snprintf(line->label, sizeof line->label, "%s", builder_label(b, t));
    }
    b->sheet->logarithmic_abscissa = wide;
}

void builder_fill_sweep(builder *b) {
    size_t key[2] = {1, 1};
    for (size_t t = 0; t < b->table_count; t++)
        if (!sheet_is_sweep(b->tables[t])) {
            builder_fail(b, GOUGH_ERROR_INPUT, "some of these results are not from sweeps");
            return;
        }
    const size_t found = varying(b, key);
    if (b->tables[0]->rows == 0) {
        builder_fail(b, GOUGH_ERROR_INPUT, "the sweep has no runs to draw");
    } else if (found == 1) {
        fill_lines(b, key[0]);
    } else {
        map grid = {.columns = 0};
        const bool lone = found == 2 && !builder_compares(b);
        if (lone) grid.x = distinct(b, 0, key[0], &grid.columns);
        if (lone) grid.y = distinct(b, 0, key[1], &grid.rows);
        if (lone && b->status == GOUGH_OK && is_grid(b->tables[0], &grid, key))
            fill_map(b, &grid, key);
        else
            fill_shares(b);
    }
}
