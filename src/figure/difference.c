/* Differences of runs, row by row. Rows are compared where both tables have the same time; a table that ends earlier ends its
 * difference. */
#include "figure/difference.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Times of rows count as equal within this share of the greatest: a time of a row is k times the output step, rounded. */
static const double same_time = 1e-9;

static gough_status check_tables(const builder *b) {
    if (b->table_count < 2)
        return gough_fail(b->error, GOUGH_ERROR_INPUT,
                          "a difference needs two results or more; there is one");
    for (size_t t = 0; t < b->table_count; t++) {
        const gough_table *table = b->tables[t];
        if (table->source != NULL || table->rows == 0 || gough_table_column(table, "t") == NULL)
            return gough_fail(b->error, GOUGH_ERROR_INPUT,
                              "a difference needs results of forces or simulate, with a column t; "
                              "result %zu is not one",
                              t + 1);
    }
    if (builder_mixes_units(b))
        return gough_fail(b->error, GOUGH_ERROR_INPUT,
                          "a difference needs results in the same units; these are in different "
                          "units");
    return GOUGH_OK;
}

/* Rows that both tables have, at the same times. */
static gough_status common_rows(builder *b, size_t t, size_t *rows) {
    const gough_table *first = b->tables[0], *table = b->tables[t];
    const double *a = gough_table_column(first, "t"), *c = gough_table_column(table, "t");
    *rows = first->rows < table->rows ? first->rows : table->rows;
    const double tolerance = same_time * fmax(fabs(a[*rows - 1]), fabs(c[*rows - 1]));
    for (size_t r = 0; r < *rows; r++) {
        if (fabs(a[r] - c[r]) <= tolerance) continue;
        /* a run that ended early has its end as its last row */
        if (r + 1 == *rows && r > 0 && first->rows != table->rows) {
            --*rows;
            break;
        }
        return gough_fail(b->error, GOUGH_ERROR_INPUT,
                          "a difference needs results with the same times: row %zu has t = %.6g in "
                          "result 1 and t = %.6g in result %zu; give both runs the same "
                          "simulation.output_step",
                          r + 1, a[r], c[r], t + 1);
    }
    return GOUGH_OK;
}

static gough_table *subtract(builder *b, size_t t, size_t rows) {
    const gough_table *first = b->tables[0], *table = b->tables[t];
    size_t columns = 0;
    for (size_t c = 0; c < table->columns; c++)
        columns += gough_table_column(first, table->name[c]) != NULL;
    gough_table *made = gough_table_new("", table->verb, columns, rows);
    for (size_t c = 0, at = 0; c < table->columns && made != NULL; c++) {
        const double *x = gough_table_column(first, table->name[c]), *y = table->value[c];
        if (x == NULL) continue;
        double *z = gough_table_name(made, at++, table->name[c], table->unit[c]);
        if (z == NULL) {
            gough_table_free(made);
            return NULL;
        }
        const bool time = strcmp(table->name[c], "t") == 0;
        for (size_t r = 0; r < rows; r++) z[r] = time ? y[r] : y[r] - x[r];
    }
    return made;
}

static gough_status make_one(difference *d, builder *b, size_t t) {
    size_t rows = 0;
    const gough_status status = common_rows(b, t, &rows);
    if (status != GOUGH_OK) return status;
    snprintf(d->text[t - 1], sizeof d->text[t - 1], "%s", builder_label(b, t));
    d->label[t - 1] = d->text[t - 1];
    d->table[t - 1] = subtract(b, t, rows);
    if (d->table[t - 1] == NULL)
        return gough_fail(b->error, GOUGH_ERROR_FILE, "out of memory for this figure");
    d->count = t;
    return GOUGH_OK;
}

gough_status difference_make(difference *d, const gough_figure *figure,
                             const gough_table *const *tables, const char *const *labels,
                             size_t count, gough_error *error) {
    builder b = {.figure = figure, .tables = tables, .labels = labels};
    b.table_count = count, b.error = error;
    *d = (difference){0};
    gough_status status = check_tables(&b);
    if (status != GOUGH_OK) return status;
    d->table = calloc(count, sizeof *d->table);
    d->text = calloc(count, sizeof *d->text);
    d->label = calloc(count, sizeof *d->label);
    if (d->table == NULL || d->text == NULL || d->label == NULL)
        return gough_fail(error, GOUGH_ERROR_FILE, "out of memory for this figure");
    for (size_t t = 1; t < count && status == GOUGH_OK; t++) status = make_one(d, &b, t);
    if (status != GOUGH_OK) return status;
    const char *first = builder_label(&b, 0);
    if (count == 2)
        snprintf(d->title, sizeof d->title, "%s − %s", d->text[0], first);
    else
        snprintf(d->title, sizeof d->title, "Differences from %s", first);
    return GOUGH_OK;
}

void difference_free(difference *d) {
    for (size_t i = 0; i < d->count; i++) gough_table_free(d->table[i]);
    free(d->table);
    free(d->text);
    free(d->label);
}
