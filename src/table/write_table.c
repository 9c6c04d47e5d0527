/* Tables of any columns, made in memory and written as HDF5 or CSV like all others. */
#define _POSIX_C_SOURCE 200809L

#include <locale.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "gough/version.h"
#include "table/table.h"

enum { NUMBER_SIZE = 40 };

gough_table *gough_table_new(const char *title, const char *verb, size_t columns, size_t rows) {
    gough_table *table = calloc(1, sizeof *table);
    if (table == NULL) return NULL;
    table->end_time = table->tolerance = table->step = NAN;
    table->max_speed = table->max_force = NAN;
    bool good = result_table_shape(table, columns, rows);
    table->title = strdup(title);
    table->verb = strdup(verb);
    table->end_cause = strdup("");
    good = good && table->title != NULL && table->verb != NULL && table->end_cause != NULL;
    for (size_t c = 0; c < columns && good; c++) {
        table->name[c] = strdup("");
        table->unit[c] = strdup("");
        good = table->name[c] != NULL && table->unit[c] != NULL;
    }
    if (good) return table;
    gough_table_free(table);
    return NULL;
}

double *gough_table_name(gough_table *table, size_t column, const char *name, const char *unit) {
    char *own_name = strdup(name), *own_unit = strdup(unit);
    if (own_name == NULL || own_unit == NULL) {
        free(own_name);
        free(own_unit);
        return NULL;
    }
    free(table->name[column]);
    free(table->unit[column]);
    table->name[column] = own_name;
    table->unit[column] = own_unit;
    return table->value[column];
}

/* ---- CSV --------------------------------------------------------------------------------------------------------- */

static gough_status put_rows(const gough_table *table, result_output *output, gough_error *error) {
    char text[NUMBER_SIZE];
    gough_status status = GOUGH_OK;
    for (size_t c = 0; c < table->columns && status == GOUGH_OK; c++) {
        status = result_output_add(output, table->name[c], strlen(table->name[c]), error);
        if (status == GOUGH_OK)
            status = result_output_add(output, c + 1 < table->columns ? "," : "\n", 1, error);
    }
    for (size_t r = 0; r < table->rows; r++) {
        for (size_t c = 0; c < table->columns && status == GOUGH_OK; c++) {
            const double value = table->value[c][r];
            const int length = isnan(value) ? snprintf(text, sizeof text, "nan")
                                            : snprintf(text, sizeof text, "%.17g", value);
            text[length] = c + 1 < table->columns ? ',' : '\n';
            status = result_output_add(output, text, (size_t)length + 1, error);
        }
    }
    return status;
}

static gough_status write_csv(const gough_table *table, const char *path, gough_error *error) {
    result_output *output = malloc(sizeof *output);
    const locale_t plain = newlocale(LC_NUMERIC_MASK, "C", (locale_t)0);
    gough_status status = GOUGH_ERROR_FILE;
    if (output == NULL || plain == (locale_t)0) {
        gough_fail(error, status, "%s: out of memory", path);
    } else {
        const locale_t before = uselocale(plain);
        status = result_output_open(output, path, error);
        if (status == GOUGH_OK) {
            status = put_rows(table, output, error);
            if (status == GOUGH_OK)
                status = result_output_finish(output, error);
            else
                result_output_abandon(output);
        }
        uselocale(before);
    }
    if (plain != (locale_t)0) freelocale(plain);
    free(output);
    return status;
}

/* ---- HDF5 -------------------------------------------------------------------------------------------------------- */

static const double *values_of(void *context, int column, size_t first, size_t count) {
    const gough_table *table = context;
    (void)count;
    return table->value[column] + first;
}

static gough_status write_hdf5(const gough_table *table, const char *study, const char *path,
                               gough_error *error) {
    result_column *column = calloc(table->columns, sizeof *column);
    if (column == NULL) return gough_fail(error, GOUGH_ERROR_FILE, "%s: out of memory", path);
    for (size_t c = 0; c < table->columns; c++)
        column[c] = (result_column){.name = table->name[c],
                                    .unit = *table->unit[c] ? table->unit[c] : "1",
                                    .long_name = table->name[c]};
    enum { OWN_ATTRIBUTES = 5, ATTRIBUTES = OWN_ATTRIBUTES + RESULT_SETTINGS };
    result_attribute attribute[ATTRIBUTES] = {{"title", table->title, 0},
                                              {"study", study ? study : "", 0},
                                              {"software", "gough", 0},
                                              {"version", GOUGH_VERSION, 0},
                                              {"verb", table->verb, 0}};
    const double setting[RESULT_SETTINGS] = {table->tolerance, table->step, table->max_speed,
                                             table->max_force};
    const int settings = result_put_settings(setting, attribute + OWN_ATTRIBUTES);
    const result_file content = {.column = column,
                                 .columns = (int)table->columns,
                                 .rows = table->rows,
                                 .attribute = attribute,
                                 .attributes = OWN_ATTRIBUTES + settings,
                                 .values = values_of,
                                 .context = (void *)table};
    const gough_status status = result_write_hdf5_file(&content, path, error);
    free(column);
    return status;
}

gough_status gough_table_write(const gough_table *table, const char *study, const char *path,
                               gough_error *error) {
    const char *ending = strrchr(path, '.');
    if (table->source != NULL)
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "%s: cannot be written: the numbers of this table are still in %s", path,
                          table->source);
    if (ending && strcasecmp(ending, ".h5") == 0) return write_hdf5(table, study, path, error);
    if (strcmp(path, "-") == 0 || (ending && strcasecmp(ending, ".csv") == 0))
        return write_csv(table, path, error);
    return gough_fail(error, GOUGH_ERROR_INPUT,
                      "%s: the name must end in .h5 (HDF5) or .csv, or be - for CSV on standard "
                      "output",
                      path);
}
