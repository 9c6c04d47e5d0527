/* Figures of sweeps. The swept keys are the columns between `run` and `x`: where one of them varies, lines over it; where two vary
 * over a grid, a map; for anything else, what share of the runs has at most which deviation. Runs that ended early are marked. */
#define _POSIX_C_SOURCE 200809L
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "figure/palette.h"
#include "figure/sweep_thin.h"

enum { MOST_POINTS = 200 };

bool sheet_is_sweep(const gough_table *table) {
    return table->columns > 3 && strcmp(table->name[0], "run") == 0 &&
           sweep_column(table, "x") < table->columns &&
           sweep_column(table, "end_cause") < table->columns;
}

/* ---- what was swept ----------------------------------------------------------------------------------------------- */

/* What the first pass over a table tells. */
typedef struct survey {
    size_t rows;
    size_t keys; /* columns behind `run` and before `x` */
    double *start;
    bool *varies;
    size_t deviation,
        force; /* places of these columns among those asked for; 0: the table has none */
    bool deviates, any_force;
    /* A sweep of forces along a program has no deviations from it, and its runs do not end where they exceed a limit. */
    bool of_forces;
} survey;

/* A sweep_visitor over the keys, position_deviation and force. */
static void take_survey(void *context, const sweep_rows *rows) {
    survey *s = context;
    for (size_t k = 0; k < s->keys; k++) {
        const double *value = rows->value[k];
        if (s->rows == 0) s->start[k] = value[0];
        for (size_t r = 0; r < rows->count && !s->varies[k]; r++)
            s->varies[k] = value[r] < s->start[k] || value[r] > s->start[k];
    }
    for (size_t r = 0; r < rows->count; r++) {
        s->deviates = s->deviates || s->deviation == 0 || !isnan(rows->value[s->deviation][r]);
        s->any_force = s->any_force || (s->force != 0 && !isnan(rows->value[s->force][r]));
    }
    s->rows += rows->count;
}

/* Surveys a table; of the first also which keys vary, in two arrays of as many. False if that fails. */
static bool make_survey(builder *b, size_t table, survey *s) {
    const gough_table *t = b->tables[table];
    const char **names = calloc(t->columns + 2, sizeof *names);
    *s = (survey){.keys = table == 0 ? sweep_column(t, "x") - 1 : 0};
    s->start = calloc(s->keys + 1, sizeof *s->start);
    s->varies = calloc(s->keys + 1, sizeof *s->varies);
    bool good = names != NULL && s->start != NULL && s->varies != NULL;
    if (good) {
        size_t count = 0;
        for (; count < s->keys; count++) names[count] = t->name[count + 1];
        names[count++] = t->name[0]; /* so that no column has place 0 */
        if (sweep_column(t, "position_deviation") < t->columns) {
            s->deviation = count;
            names[count++] = "position_deviation";
        }
        if (sweep_column(t, "force") < t->columns) {
            s->force = count;
            names[count++] = "force";
        }
        good = sweep_visit(b, table, names, count, take_survey, s);
        s->of_forces = s->any_force && !s->deviates;
    } else {
        builder_fail(b, GOUGH_ERROR_FILE, "out of memory for this figure");
    }
    free(names);
    return good;
}

/* The swept columns of the first table that vary; how many, of which two are kept. */
static size_t varying(const survey *s, size_t column[2]) {
    size_t found = 0;
    for (size_t k = 0; k < s->keys; k++) {
        if (s->varies[k] && found < 2) column[found] = k + 1;
        found += s->varies[k];
    }
    if (found == 0) column[found++] = 1;
    return found;
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
    sheet_unit_label(unit, sizeof unit, builder_unit_words(b, name), 0);
    snprintf(label, size, "%.100s%s", said, unit);
}

/* The columns to draw: those asked for, or deviations, or of a sweep of forces these. */
static size_t names_of(const builder *b, bool of_forces, char names[SWEEP_NAMES][64], bool both) {
    const char *list = b->figure->columns;
    if (list == NULL && of_forces) list = both ? "force,power" : "force";
    if (list == NULL) list = both ? "position_deviation,angle_deviation" : "position_deviation";
    size_t count = 0;
    while (count < SWEEP_NAMES) {
        const size_t length = strcspn(list, ",");
        snprintf(names[count++], 64, "%.*s", (int)(length < 63 ? length : 63), list);
        if (list[length] == '\0') break;
        list += length + 1;
    }
    return count;
}

/* ---- over one key ------------------------------------------------------------------------------------------------- */

/* What lines are made of: columns 0 (the key), 1 (end_cause) and from 2 the ordinates of a table. */
typedef struct lines {
    size_t count; /* of ordinates */
    sweep_ends ends;
    sweep_distinct *values; /* of the first table's key */
    sweep_facts facts[SWEEP_NAMES];
    bool any_ended;
    sweep_line *line[SWEEP_NAMES];
} lines;

/* A sweep_visitor. */
static void measure_lines(void *context, const sweep_rows *rows) {
    lines *l = context;
    if (l->values != NULL) sweep_distinct_add(l->values, rows->value[0], rows->count);
    for (size_t r = 0; r < rows->count; r++) {
        sweep_meet(&l->ends, rows->value[0][r], rows->first + r);
        l->any_ended = l->any_ended || rows->value[1][r] > 0.5;
        for (size_t i = 0; i < l->count; i++) sweep_note(&l->facts[i], rows->value[2 + i][r]);
    }
}

/* A sweep_visitor. */
static void draw_lines(void *context, const sweep_rows *rows) {
    lines *l = context;
    for (size_t i = 0; i < l->count; i++) {
        const double *y = rows->value[2 + i], level = l->facts[i].greatest;
        const bool is_level = sweep_is_level(&l->facts[i]);
        for (size_t r = 0; r < rows->count; r++)
            sweep_line_add(l->line[i],
                           (sweep_point){rows->value[0][r], is_level && !isnan(y[r]) ? level : y[r],
                                         rows->value[1][r] > 0.5, rows->first + r});
    }
}

/* A thinned line becomes a series of a panel. */
static void put_line(builder *b, panel *p, size_t table, lines *l, size_t i, bool of_forces) {
    sweep_point *point = calloc(SWEEP_POINTS, sizeof *point);
    double *array[3];
    for (int k = 0; k < 3; k++) array[k] = sheet_array(b->sheet, SWEEP_POINTS);
    if (point == NULL || array[0] == NULL || array[1] == NULL || array[2] == NULL) {
        builder_fail(b, GOUGH_ERROR_FILE, "out of memory for this figure");
        free(point);
        return;
    }
    series *line = &p->series[p->count++];
    *line = (series){.x = array[0],
                     .y = array[1],
                     .colour = colour_of_table(table),
                     .thinned = true,
                     .least_above_zero = l->ends.least_above_zero};
    line->count = sweep_line_end(l->line[i], point, &line->logarithmic_low);
    for (size_t r = 0; r < line->count; r++) {
        array[0][r] = point[r].x;
        array[1][r] = point[r].y;
        array[2][r] = point[r].ended;
    }
    free(point);
    line->points = l->ends.count <= MOST_POINTS;
    line->ended = l->any_ended ? array[2] : NULL;
    if (of_forces) line->ended_label = "limit exceeded";
    if (builder_compares(b))
        snprintf(line->label, sizeof line->label, "%s", builder_label(b, table));
}

static void free_lines(lines *l) {
    for (size_t i = 0; i < l->count; i++) {
        if (l->line[i] != NULL) free(l->line[i]->whole);
        free(l->line[i]);
    }
}

/* Room for the lines of a table whose ends are known. */
static bool make_lines(builder *b, lines *l) {
    bool good = true;
    for (size_t i = 0; i < l->count && good; i++) {
        l->line[i] = calloc(1, sizeof *l->line[i]);
        good = l->line[i] != NULL;
        if (!good) break;
        l->line[i]->ends = l->ends;
        l->line[i]->whole = calloc(SWEEP_POINTS, sizeof *l->line[i]->whole);
        good = l->line[i]->whole != NULL;
    }
    if (!good) builder_fail(b, GOUGH_ERROR_FILE, "out of memory for this figure");
    return good;
}

/* Draws each ordinate of a table into its panel. */
static void add_lines(builder *b, size_t table, panel *const p[], const char *const *names,
                      lines *l, bool of_forces) {
    if (make_lines(b, l) && sweep_visit(b, table, names, 2 + l->count, draw_lines, l))
        for (size_t i = 0; i < l->count && b->status == GOUGH_OK; i++)
            put_line(b, p[i], table, l, i, of_forces);
    free_lines(l);
}

static void fill_lines(builder *b, size_t key, const survey *surveys) {
    char name[SWEEP_NAMES][64], heading[HEADING];
    const char *path = b->tables[0]->name[key], *names[2 + SWEEP_NAMES] = {path, "end_cause"};
    const size_t count = names_of(b, surveys[0].of_forces, name, true);
    for (size_t i = 0; i < count; i++) names[2 + i] = name[i];
    if (b->table_count > SHEET_SERIES) builder_fail(b, GOUGH_ERROR_INPUT, "too many results");
    sweep_distinct values;
    lines *all = calloc(b->table_count, sizeof *all);
    if (all == NULL) builder_fail(b, GOUGH_ERROR_FILE, "out of memory for this figure");
    bool good = sweep_distinct_begin(b, &values), wide[SWEEP_NAMES];
    for (size_t t = 0; t < b->table_count && good; t++) {
        all[t] = (lines){.count = count, .values = t == 0 ? &values : NULL};
        for (size_t i = 0; i < count; i++) all[t].facts[i] = sweep_no_facts();
        good = sweep_visit(b, t, names, 2 + count, measure_lines, &all[t]);
    }
    if (good) {
        sweep_distinct_end(&values);
        b->sheet->logarithmic_abscissa = sweep_is_logarithmic(&values);
        name_axis(b, b->sheet->abscissa, sizeof b->sheet->abscissa, path, path);
    }
    panel *p[SWEEP_NAMES] = {NULL};
    for (size_t i = 0; i < count && good; i++) {
        wide[i] = b->figure->logarithmic;
        for (size_t t = 0; t < b->table_count; t++)
            wide[i] = wide[i] || sweep_spans_decades(&all[t].facts[i]);
        p[i] =
            builder_panel(b, heading_of(name[i], heading), builder_unit_words(b, name[i]), wide[i]);
        good = p[i] != NULL;
        if (good) p[i]->noise = builder_noise(b, name[i]);
    }
    for (size_t t = 0; t < b->table_count && good && b->status == GOUGH_OK; t++)
        add_lines(b, t, p, names, &all[t], surveys[t].of_forces);
    free(all);
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

/* A sweep_visitor: the values of both keys. */
static void take_distinct(void *context, const sweep_rows *rows) {
    sweep_distinct *value = context;
    for (int k = 0; k < 2; k++) sweep_distinct_add(&value[k], rows->value[k], rows->count);
}

/* A map has at most this many cells along its axes; cells of larger sweeps have several runs. */
enum { MAP_COLUMNS = 600, MAP_ROWS = 340 };

/* What a map is made of: columns 0 and 1 (the keys), 2 (end_cause) and from 3 what is drawn. */
typedef struct cells {
    const sweep_distinct *x, *y;
    size_t count, rows;
    size_t wide, high; /* runs in a cell along both axes, but for the last cells */
    map *grid;
    bool of_forces;
    unsigned char *met; /* a bit for each pair of values */
    bool twice;
    sweep_facts facts[SWEEP_NAMES];
    double *cell[SWEEP_NAMES];
    bool *missing[SWEEP_NAMES]; /* a run of the cell has no number */
    bool any_missing[SWEEP_NAMES];
    char name[SWEEP_NAMES][64]; /* of the columns that are drawn */
} cells;

/* A sweep_visitor: whether each pair of values has one run. */
static void meet_pairs(void *context, const sweep_rows *rows) {
    cells *c = context;
    c->rows += rows->count;
    for (size_t r = 0; r < rows->count && !c->twice; r++) {
        const size_t pair = place_of(c->y->value, c->y->count, rows->value[1][r]) * c->x->count +
                            place_of(c->x->value, c->x->count, rows->value[0][r]);
        const unsigned char bit = (unsigned char)(1u << (pair % 8));
        c->twice = (c->met[pair / 8] & bit) != 0;
        c->met[pair / 8] |= bit;
    }
}

/* Whether there is one run for each pair of values. */
static bool is_grid(builder *b, const char *const *names, cells *c, size_t rows) {
    if (c->x->more || c->y->more || c->x->count * c->y->count != rows) return false;
    c->met = calloc(rows / 8 + 1, 1);
    if (c->met == NULL) builder_fail(b, GOUGH_ERROR_FILE, "out of memory for this figure");
    const bool good = c->met != NULL && sweep_visit(b, 0, names, 2, meet_pairs, c) && !c->twice;
    free(c->met);
    return good && c->rows == rows;
}

static bool is_missing(const cells *c, double value, double cause) {
    return c->of_forces ? isnan(value) : cause > 0.5;
}

/* A sweep_visitor: the greatest number of each cell. */
static void fill_cells(void *context, const sweep_rows *rows) {
    cells *c = context;
    for (size_t r = 0; r < rows->count; r++) {
        const size_t cell =
            place_of(c->y->value, c->y->count, rows->value[1][r]) / c->high * c->grid->columns +
            place_of(c->x->value, c->x->count, rows->value[0][r]) / c->wide;
        for (size_t i = 0; i < c->count; i++) {
            const double value = rows->value[3 + i][r];
            if (is_missing(c, value, rows->value[2][r])) {
                c->missing[i][cell] = c->any_missing[i] = true;
            } else {
                sweep_note(&c->facts[i], value);
                if (!(value <= c->cell[i][cell])) c->cell[i][cell] = value;
            }
        }
    }
}

/* Values of an axis for cells of `each` values: between the first and the last of each. */
static double *centres(builder *b, const sweep_distinct *values, size_t each, bool logarithmic,
                       size_t *count) {
    double *centre = sheet_array(b->sheet, values->count);
    *count = (values->count + each - 1) / each;
    for (size_t i = 0; centre != NULL && i < *count; i++) {
        const size_t end = (i + 1) * each < values->count ? (i + 1) * each : values->count;
        const double low = values->value[i * each], high = values->value[end - 1];
        centre[i] = end - i * each == 1 ? low
                    : logarithmic       ? sqrt(low) * sqrt(high)
                                        : 0.5 * (low + high);
    }
    return centre;
}

/* Room for the cells of each column, with the least number there is. */
static bool make_cells(builder *b, cells *c) {
    const size_t all = c->grid->columns * c->grid->rows;
    bool good = c->grid->x != NULL && c->grid->y != NULL;
    for (size_t i = 0; i < c->count && good; i++) {
        c->facts[i] = sweep_no_facts();
        c->cell[i] = sheet_array(b->sheet, all);
        c->missing[i] = calloc(all, sizeof *c->missing[i]);
        good = c->cell[i] != NULL && c->missing[i] != NULL;
        for (size_t k = 0; good && k < all; k++) c->cell[i][k] = -INFINITY;
    }
    if (!good) builder_fail(b, GOUGH_ERROR_FILE, "out of memory for this figure");
    return good;
}

/* What a map of several runs a cell shows, and its grey cells. */
static void note_cells(builder *b, const cells *c) {
    char *note = b->sheet->note;
    const size_t size = sizeof b->sheet->note;
    bool missing = false;
    for (size_t i = 0; i < c->count; i++) missing = missing || c->any_missing[i];
    if (c->wide * c->high > 1)
        snprintf(note, size, "each cell shows the greatest number of up to %zu runs%s",
                 c->wide * c->high, missing ? "; grey: one of them ended early" : "");
    else if (missing)
        snprintf(note, size, "grey: ended early");
}

static void put_map(builder *b, cells *c, size_t i, const char *name) {
    const bool level = sweep_is_level(&c->facts[i]);
    for (size_t k = 0; k < c->grid->columns * c->grid->rows; k++)
        c->cell[i][k] = c->missing[i][k] || isnan(c->cell[i][k]) ? NAN
                        : level                                  ? c->facts[i].greatest
                                                                 : c->cell[i][k];
    const bool wide = b->figure->logarithmic || (!level && sweep_spans_decades(&c->facts[i]));
    char heading[HEADING];
    panel *p = builder_panel(b, heading_of(name, heading), builder_unit_words(b, name), wide);
    if (p == NULL) return;
    p->noise = builder_noise(b, name);
    p->mapped = true;
    p->map = *c->grid;
    p->map.cells = c->cell[i];
}

static void fill_map(builder *b, cells *c, const char **names) {
    map grid = {.columns = 0};
    c->grid = &grid;
    c->count = names_of(b, c->of_forces, c->name, false);
    c->wide = (c->x->count + MAP_COLUMNS - 1) / MAP_COLUMNS;
    c->high = (c->y->count + MAP_ROWS - 1) / MAP_ROWS;
    b->sheet->logarithmic_abscissa = sweep_is_logarithmic(c->x);
    grid.logarithmic_y = sweep_is_logarithmic(c->y);
    grid.x = centres(b, c->x, c->wide, b->sheet->logarithmic_abscissa, &grid.columns);
    grid.y = centres(b, c->y, c->high, grid.logarithmic_y, &grid.rows);
    name_axis(b, b->sheet->abscissa, sizeof b->sheet->abscissa, names[0], names[0]);
    name_axis(b, grid.ordinate, sizeof grid.ordinate, names[1], names[1]);
    names[2] = "end_cause";
    for (size_t i = 0; i < c->count; i++) names[3 + i] = c->name[i];
    if (make_cells(b, c) && sweep_visit(b, 0, names, 3 + c->count, fill_cells, c)) {
        note_cells(b, c);
        for (size_t i = 0; i < c->count; i++) put_map(b, c, i, c->name[i]);
    }
    for (size_t i = 0; i < c->count; i++) free(c->missing[i]);
    c->grid = NULL;
}

/* ---- over more ---------------------------------------------------------------------------------------------------- */

/* Columns 0 (what is drawn) and 1 (end_cause). */
typedef struct runs {
    bool of_forces;
    sweep_ends ends;
    sweep_shares *shares;
} runs;

/* Runs that ended early have no number, so that the line ends below 100 %. */
static bool has_number(const runs *s, const sweep_rows *rows, size_t r) {
    return (s->of_forces || !(rows->value[1][r] > 0.5)) && isfinite(rows->value[0][r]);
}

/* A sweep_visitor. */
static void measure_shares(void *context, const sweep_rows *rows) {
    runs *s = context;
    for (size_t r = 0; r < rows->count; r++)
        if (has_number(s, rows, r)) sweep_meet(&s->ends, rows->value[0][r], rows->first + r);
}

/* A sweep_visitor. */
static void take_shares(void *context, const sweep_rows *rows) {
    const runs *s = context;
    for (size_t r = 0; r < rows->count; r++)
        if (has_number(s, rows, r)) sweep_shares_add(s->shares, rows->value[0][r], rows->first + r);
}

/* Percent of all runs of a table with at most this. */
static void add_shares(builder *b, panel *p, size_t table, const char *name, runs *s, size_t rows) {
    const char *const names[] = {name, "end_cause"};
    if (!sweep_visit(b, table, names, 2, measure_shares, s)) return;
    double *x = sheet_array(b->sheet, SWEEP_POINTS), *y = sheet_array(b->sheet, SWEEP_POINTS);
    s->shares = calloc(1, sizeof *s->shares);
    if (s->shares != NULL) {
        s->shares->ends = s->ends;
        s->shares->whole = calloc(SWEEP_POINTS, sizeof *s->shares->whole);
    }
    if (x == NULL || y == NULL || s->shares == NULL || s->shares->whole == NULL)
        builder_fail(b, GOUGH_ERROR_FILE, "out of memory for this figure");
    else if (sweep_visit(b, table, names, 2, take_shares, s)) {
        const size_t count = sweep_shares_end(s->shares, x, y);
        for (size_t i = 0; i < count; i++) y[i] = 100.0 * y[i] / (double)rows;
        series *line = &p->series[p->count++];
        *line = (series){.count = count,
                         .x = x,
                         .y = y,
                         .colour = colour_of_table(table),
                         .thinned = true,
                         .steps = true,
                         .least_above_zero = s->ends.least_above_zero,
                         .logarithmic_low = NAN};
        if (builder_compares(b))
            snprintf(line->label, sizeof line->label, "%s", builder_label(b, table));
    }
    if (s->shares != NULL) free(s->shares->whole);
    free(s->shares);
}

static void fill_shares(builder *b, const survey *surveys) {
    char names[SWEEP_NAMES][64], heading[HEADING];
    bool wide = b->figure->logarithmic;
    const bool forces = surveys[0].of_forces;
    if (names_of(b, forces, names, false) > 1) {
        builder_fail(
            b, GOUGH_ERROR_INPUT,
            "shares of the runs can be drawn for one column only; choose one with --columns");
        return;
    }
    const char *name = names[0];
    name_axis(b, b->sheet->abscissa, sizeof b->sheet->abscissa, name, heading_of(name, heading));
    panel *p = builder_panel(
        b, forces ? "Runs with at most this" : "Runs that reach their end with at most this", "%",
        false);
    for (size_t t = 0; t < b->table_count && p != NULL && p->count < SHEET_SERIES; t++) {
        runs s = {.of_forces = forces};
        add_shares(b, p, t, name, &s, surveys[t].rows);
        if (b->status != GOUGH_OK) return;
        wide = wide ||
               (s.ends.count > 0 && s.ends.least > 0.0 && s.ends.greatest > 100.0 * s.ends.least);
    }
    b->sheet->logarithmic_abscissa = wide;
}

/* ---- which of them ------------------------------------------------------------------------------------------------ */

/* A map if the first table has two varying keys with one run for each pair of values; false if it is no such table. */
static bool try_map(builder *b, const size_t key[2], const survey *s) {
    const gough_table *t = b->tables[0];
    const char *names[3 + SWEEP_NAMES] = {t->name[key[0]], t->name[key[1]]};
    sweep_distinct value[2];
    cells c = {.x = &value[0], .y = &value[1], .of_forces = s->of_forces};
    if (!sweep_distinct_begin(b, &value[0]) || !sweep_distinct_begin(b, &value[1])) return false;
    if (!sweep_visit(b, 0, names, 2, take_distinct, value)) return false;
    for (int k = 0; k < 2; k++) sweep_distinct_end(&value[k]);
    if (!is_grid(b, names, &c, s->rows)) return false;
    fill_map(b, &c, names);
    return true;
}

static void choose(builder *b, const survey *surveys) {
    size_t key[2] = {1, 1};
    const size_t found = varying(&surveys[0], key);
    if (surveys[0].rows == 0)
        builder_fail(b, GOUGH_ERROR_INPUT, "the sweep has no runs to draw");
    else if (found == 1)
        fill_lines(b, key[0], surveys);
    else if (found > 2 || builder_compares(b) || !try_map(b, key, &surveys[0]))
        if (b->status == GOUGH_OK) fill_shares(b, surveys);
}

void builder_fill_sweep(builder *b) {
    for (size_t t = 0; t < b->table_count; t++)
        if (!sheet_is_sweep(b->tables[t])) {
            builder_fail(b, GOUGH_ERROR_INPUT, "some of these results are not from sweeps");
            return;
        }
    survey *surveys = calloc(b->table_count + 1, sizeof *surveys);
    b->files = calloc(b->table_count + 1, sizeof *b->files);
    if (surveys == NULL || b->files == NULL)
        builder_fail(b, GOUGH_ERROR_FILE, "out of memory for this figure");
    bool good = surveys != NULL && b->files != NULL;
    for (size_t t = 0; t < b->table_count && good; t++) good = make_survey(b, t, &surveys[t]);
    if (good) choose(b, surveys);
    for (size_t t = 0; t < b->table_count && surveys != NULL; t++) {
        free(surveys[t].start);
        free(surveys[t].varies);
    }
    free(surveys);
    free(b->files);
    b->files = NULL;
}
