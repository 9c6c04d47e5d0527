/* Putting lines of tables into the panels of a sheet. */
#include "figure/builder.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

double *sheet_array(sheet *s, size_t count) {
    if (s->arrays == SHEET_ARRAYS) return NULL;
    double *array = calloc(count > 0 ? count : 1, sizeof *array);
    if (array != NULL) s->array[s->arrays++] = array;
    return array;
}

void sheet_free_arrays(sheet *s) {
    while (s->arrays > 0) free(s->array[--s->arrays]);
}

gough_status builder_fail(builder *b, gough_status status, const char *sentence) {
    if (b->status == GOUGH_OK) b->status = gough_fail(b->error, status, "%s", sentence);
    return b->status;
}

bool builder_compares(const builder *b) { return b->table_count > 1; }

const char *builder_label(builder *b, size_t table) {
    if (b->labels != NULL && b->labels[table] != NULL) return b->labels[table];
    const char *title = b->tables[table]->title;
    int same = 0;
    for (size_t t = 0; t < b->table_count; t++) same += strcmp(b->tables[t]->title, title) == 0;
    if (title[0] == '\0')
        snprintf(b->label, sizeof b->label, "table %zu", table + 1);
    else if (same > 1)
        snprintf(b->label, sizeof b->label, "%.100s (%zu)", title, table + 1);
    else
        snprintf(b->label, sizeof b->label, "%.150s", title);
    return b->label;
}

const double *builder_column(builder *b, size_t table, const char *name) {
    if (b->status != GOUGH_OK) return NULL;
    const double *column = gough_table_column(b->tables[table], name);
    if (column == NULL)
        b->status = gough_fail(b->error, GOUGH_ERROR_INPUT,
                               "'%.80s' has no column %.60s, which this figure needs",
                               builder_label(b, table), name);
    return column;
}

static const char *unit_in(const gough_table *table, const char *name) {
    for (size_t c = 0; c < table->columns; c++)
        if (strcmp(table->name[c], name) == 0) return table->unit[c];
    return "";
}

bool builder_mixes_units(const builder *b) {
    for (size_t t = 1; t < b->table_count; t++)
        for (size_t c = 0; c < b->tables[t]->columns; c++) {
            const char *first = unit_in(b->tables[0], b->tables[t]->name[c]);
            const char *unit = b->tables[t]->unit[c];
            if (first[0] != '\0' && unit[0] != '\0' && strcmp(first, unit) != 0) return true;
        }
    return false;
}

const char *builder_unit(const builder *b, const char *name) {
    const char *found = "";
    for (size_t t = 0; t < b->table_count; t++) {
        const char *unit = unit_in(b->tables[t], name);
        if (found[0] != '\0' && unit[0] != '\0' && strcmp(found, unit) != 0) return "";
        if (unit[0] != '\0') found = unit;
    }
    return found; /* CSV brings none */
}

panel *builder_panel(builder *b, const char *heading, const char *unit, bool logarithmic) {
    if (b->status != GOUGH_OK) return NULL;
    if (b->sheet->count == SHEET_PANELS) {
        builder_fail(b, GOUGH_ERROR_INPUT, "too many panels for one figure; choose fewer columns");
        return NULL;
    }
    panel *p = &b->sheet->panel[b->sheet->count++];
    snprintf(p->heading, sizeof p->heading, "%s", heading);
    snprintf(p->unit, sizeof p->unit, "%s", unit);
    p->logarithmic = logarithmic;
    return p;
}

void builder_abscissa(builder *b, const char *words, const char *column) {
    char unit[48];
    sheet_unit_label(unit, sizeof unit, builder_unit_words(b, column), 0);
    snprintf(b->sheet->abscissa, sizeof b->sheet->abscissa, "%.100s%s", words, unit);
}

panel *builder_panel_of(builder *b, const char *heading, const char *column, bool logarithmic) {
    panel *p = builder_panel(b, heading, builder_unit_words(b, column), logarithmic);
    if (p != NULL) p->noise = builder_noise(b, column);
    return p;
}

/* Rows whose abscissa lies in the figure's range, as first and one past the last. */
static void rows_in_range(const builder *b, const double *x, size_t rows, size_t *begin,
                          size_t *end) {
    *begin = 0;
    *end = rows;
    if (isfinite(b->figure->from)) {
        while (*begin < rows && x[*begin] < b->figure->from) ++*begin;
    }
    if (isfinite(b->figure->to)) {
        while (*end > *begin && x[*end - 1] > b->figure->to) --*end;
    }
}

series *builder_line(builder *b, panel *p, size_t table, const char *abscissa, const double *y,
                     const char *label, int colour) {
    const double *x = builder_column(b, table, abscissa);
    if (b->status != GOUGH_OK || p == NULL || y == NULL) return NULL;
    if (p->count == SHEET_SERIES) {
        builder_fail(b, GOUGH_ERROR_INPUT,
                     "too many lines for one panel; draw fewer tables or columns at once");
        return NULL;
    }
    size_t begin, end;
    rows_in_range(b, x, b->tables[table]->rows, &begin, &end);
    if (begin >= end) {
        b->status =
            gough_fail(b->error, GOUGH_ERROR_INPUT, "'%.80s' has no rows to draw%s",
                       builder_label(b, table), b->tables[table]->rows > 0 ? " in this range" : "");
        return NULL;
    }

    series *line = &p->series[p->count++];
    *line = (series){.count = end - begin, .x = x + begin, .y = y + begin, .colour = colour};
    snprintf(line->label, sizeof line->label, "%s", label);
    return line;
}

double *builder_array(builder *b, size_t table) {
    if (b->status != GOUGH_OK) return NULL;
    double *array = sheet_array(b->sheet, b->tables[table]->rows);
    if (array == NULL) builder_fail(b, GOUGH_ERROR_FILE, "out of memory for this figure");
    return array;
}
