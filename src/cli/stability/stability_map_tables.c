/* Tables of a stability map: its grid, and the intervals of stiffness in which a mode grows. In CSV modes and kinds are words; in
 * HDF5, which has numbers only, a mode is the sum of what moves, sway 1, heave 2, tilt 4, yaw 8, and a kind counts from 0. */
#define _GNU_SOURCE
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "cli/stability/stability_map.h"

/* One column: a number, or a word in CSV. */
typedef struct cell {
    double number;
    const char *word; /* NULL: the number */
} cell;

/* A table that is made cell by cell. */
typedef struct sheet_of_cells {
    const char *const *name;
    const char *const *unit;
    size_t columns, rows;
    void (*fill)(const map_report *report, size_t row, cell *cells);
} sheet_of_cells;

enum { MOST_COLUMNS = 10 };

/* What moves in a mode, by bits from 1 on. */
static const char *const moves[4] = {"sway", "heave", "tilt", "yaw"};

const char *map_axis_name(const map_report *report) {
    static const char *const name[] = {NULL,      "amplitude", "frequency",
                                       "damping", "period",    "delay"};
    return name[report->options.axis];
}

gough_unit map_axis_unit(gough_map_axis axis) {
    if (axis == GOUGH_MAP_DAMPING) return GOUGH_UNIT_DAMPING;
    return axis == GOUGH_MAP_PERIOD || axis == GOUGH_MAP_DELAY ? GOUGH_UNIT_TIME : GOUGH_UNIT_NONE;
}

bool map_axis_is_factor(gough_map_axis axis) {
    return axis == GOUGH_MAP_AMPLITUDE || axis == GOUGH_MAP_FREQUENCY;
}

map_modes map_modes_of(const map_report *report) {
    map_modes words = {""};
    for (int k = 0; k < 4; k++) {
        if (!(report->options.modes & 1U << k)) continue;
        if (*words.text) strcat(words.text, "+");
        strcat(words.text, moves[k]);
    }
    return words;
}

bool map_is_sampled(const map_report *report) {
    return report->options.axis == GOUGH_MAP_PERIOD ||
           report->study->model->control.sampling.period > 0;
}

static double mode_number(const char *name) {
    double sum = 0;
    for (int k = 0; k < 4; k++)
        if (strstr(name, moves[k])) sum += 1 << k;
    return sum;
}

/* ---- the grid ---------------------------------------------------------------------------------------------------- */

static void fill_point(const map_report *report, size_t row, cell *cells) {
    const size_t columns = report->options.stiffness.count;
    const gough_map_point *p = &report->map.point[row];
    *cells++ = (cell){gough_map_value(&report->options.stiffness, row % columns), NULL};
    if (report->options.axis) *cells++ = (cell){report->map.row[row / columns].value, NULL};
    *cells++ = (cell){p->growth, NULL};
    *cells++ = (cell){p->rate, NULL};
    *cells++ = (cell){p->stable, NULL};
    *cells++ = (cell){mode_number(p->mode), p->mode};
    *cells++ = (cell){report->map.row[row / columns].sampling, NULL};
}

/* ---- the intervals ----------------------------------------------------------------------------------------------- */

/* The n-th interval of all rows. */
static const gough_interval *interval_of(const map_report *report, size_t n, size_t *row) {
    for (*row = 0; n >= report->map.row[*row].intervals; ++*row)
        n -= report->map.row[*row].intervals;
    return &report->map.interval[*row * report->options.intervals + n];
}

static size_t count_intervals(const map_report *report) {
    size_t count = 0;
    for (size_t r = 0; r < report->rows; r++) count += report->map.row[r].intervals;
    return count;
}

static void fill_interval(const map_report *report, size_t n, cell *cells) {
    size_t row;
    const gough_interval *i = interval_of(report, n, &row);
    if (report->options.axis) *cells++ = (cell){report->map.row[row].value, NULL};
    *cells++ = (cell){mode_number(i->mode.name), i->mode.name};
    *cells++ = (cell){i->modes, NULL};
    *cells++ = (cell){i->kind, gough_interval_kind_name(i->kind)};
    *cells++ = (cell){i->from, NULL};
    *cells++ = (cell){i->to, NULL};
    *cells++ = (cell){i->cut, NULL};
    *cells++ = (cell){i->stiffness, NULL};
    *cells++ = (cell){i->growth, NULL};
    *cells++ = (cell){i->rate, NULL};
}

/* ---- writing ----------------------------------------------------------------------------------------------------- */

static gough_status write_csv(const map_report *report, const sheet_of_cells *sheet,
                              const char *path, gough_error *error) {
    char *text = NULL;
    size_t length = 0;
    FILE *stream = open_memstream(&text, &length);
    if (!stream) return gough_fail(error, GOUGH_ERROR_FILE, "%s: out of memory", path);
    for (size_t c = 0; c < sheet->columns; c++)
        fprintf(stream, "%s%c", sheet->name[c], c + 1 < sheet->columns ? ',' : '\n');
    for (size_t r = 0; r < sheet->rows; r++) {
        cell cells[MOST_COLUMNS];
        sheet->fill(report, r, cells);
        for (size_t c = 0; c < sheet->columns; c++) {
            if (cells[c].word)
                fputs(cells[c].word, stream);
            else if (isnan(cells[c].number))
                fputs("nan", stream);
            else
                fprintf(stream, "%.17g", cells[c].number);
            fputc(c + 1 < sheet->columns ? ',' : '\n', stream);
        }
    }
    gough_status status = GOUGH_OK;
    if (fclose(stream) != 0)
        status = gough_fail(error, GOUGH_ERROR_FILE, "%s: out of memory", path);
    else
        status = gough_write_file(path, text, length, error);
    free(text);
    return status;
}

static gough_status write_hdf5(const map_report *report, const sheet_of_cells *sheet,
                               const char *path, gough_error *error) {
    gough_table *table =
        gough_table_new(report->study->title, report->verb, sheet->columns, sheet->rows);
    bool good = table != NULL;
    for (size_t c = 0; good && c < sheet->columns; c++)
        good = gough_table_name(table, c, sheet->name[c], sheet->unit[c]) != NULL;
    for (size_t r = 0; good && r < sheet->rows; r++) {
        cell cells[MOST_COLUMNS];
        sheet->fill(report, r, cells);
        for (size_t c = 0; c < sheet->columns; c++) table->value[c][r] = cells[c].number;
    }
    const gough_status status =
        good ? gough_table_write(table, report->study->text, path, error)
             : gough_fail(error, GOUGH_ERROR_FILE, "%s: out of memory", path);
    gough_table_free(table);
    return status;
}

static gough_status write_sheet(const map_report *report, const sheet_of_cells *sheet,
                                const char *path, gough_error *error) {
    const char *ending = strrchr(path, '.');
    return ending && strcasecmp(ending, ".h5") == 0 ? write_hdf5(report, sheet, path, error)
                                                    : write_csv(report, sheet, path, error);
}

char *map_tongues_path(const char *path) {
    const char *dot = strrchr(path, '.');
    char *other = NULL;
    return asprintf(&other, "%.*s-tongues%s", (int)(dot - path), path, dot) < 0 ? NULL : other;
}

gough_status map_write(const map_report *report, const char *path, gough_error *error) {
    const gough_units *units = &report->units;
    const char *axis = map_axis_name(report),
               *stiffness = gough_unit_label(units, GOUGH_UNIT_STIFFNESS),
               *rate = gough_unit_label(units, GOUGH_UNIT_RATE),
               *second = gough_unit_label(units, map_axis_unit(report->options.axis)),
               *time = gough_unit_label(units, GOUGH_UNIT_TIME);
    const char *const grid_name[] = {"stiffness",
                                     axis ? axis : "growth_per_period",
                                     "growth_per_period",
                                     "growth_rate",
                                     "stable",
                                     "mode",
                                     "sampling"};
    const char *const grid_unit[] = {stiffness, second, "1", rate, "1", "1", time};
    const char *const list_name[] = {axis,         "mode",      "modes",
                                     "kind",       "from",      "to",
                                     "cut",        "stiffness", "growth_per_period",
                                     "growth_rate"};
    const char *const list_unit[] = {second,    "1", "1",       "1", stiffness,
                                     stiffness, "1", stiffness, "1", rate};
    /* without a second axis its column is left out */
    const char *const line_name[] = {"stiffness", "growth_per_period", "growth_rate", "stable",
                                     "mode",      "sampling"};
    const char *const line_unit[] = {stiffness, "1", rate, "1", "1", time};
    const size_t sampled = map_is_sampled(report); /* has the last column */
    const sheet_of_cells grid = {axis ? grid_name : line_name, axis ? grid_unit : line_unit,
                                 (axis ? 6 : 5) + sampled,
                                 report->rows * report->options.stiffness.count, fill_point};
    const sheet_of_cells list = {list_name + !axis, list_unit + !axis, axis ? 10 : 9,
                                 count_intervals(report), fill_interval};
    gough_status status = write_sheet(report, &grid, path, error);
    if (status || strcmp(path, "-") == 0) return status;
    char *beside = map_tongues_path(path);
    status = beside ? write_sheet(report, &list, beside, error)
                    : gough_fail(error, GOUGH_ERROR_FILE, "%s: out of memory", path);
    free(beside);
    return status;
}
