/* gough stability --matrix: the loop as a matrix, with a name for each of its rows. */
#include <math.h>
#include <stdlib.h>

#include "cli/common/json.h"
#include "cli/stability/stability_report.h"

/* Names, and numbers from the units of the run: a row in its own unit for each unit of a column, rates by the unit of time. */
static void finish(const gough_model *model, const gough_units *u, stability_matrix *matrix) {
    const bool sampled = model->control.sampling.period > 0;
    const double rate = sampled ? 1 : gough_unit_factor(u, GOUGH_UNIT_RATE);
    const size_t n = matrix->size;
    double *size = malloc((n + 1) * sizeof *size);
    for (size_t i = 0; size && i < n; i++) {
        gough_unit unit = GOUGH_UNIT_NONE;
        gough_deviation_name(model, i, matrix->name[i], &unit);
        size[i] = gough_unit_size(u, unit);
    }
    for (size_t i = 0; size && i < n; i++)
        for (size_t j = 0; j < n; j++) matrix->number[n * i + j] *= size[j] / size[i] * rate;
    free(size);
}

gough_status stability_matrix_find(const struct loop_options *loop, const gough_study *study,
                                   const gough_units *units, stability_matrix *matrix,
                                   gough_error *error) {
    const gough_model *model = study->model;
    double component[GOUGH_COMPONENTS];
    gough_status status;
    if (isfinite(loop->at) && model->control.sampling.period > 0)
        return gough_fail(
            error, GOUGH_ERROR_INPUT,
            "--at is for a continuous controller, whose loop has a matrix of rates at "
            "each time; that of a sampled one leads from sample to sample at rest. "
            "Give --matrix alone, or with --pose");
    matrix->size = gough_deviation_size(model);
    matrix->number = calloc(matrix->size * matrix->size, sizeof *matrix->number);
    matrix->name = calloc(matrix->size, sizeof *matrix->name);
    if (!matrix->number || !matrix->name)
        return gough_fail(error, GOUGH_ERROR_FILE, "out of memory");
    if (isfinite(loop->at)) {
        status = gough_linearise(model, gough_unit_read(&study->units, GOUGH_UNIT_TIME, loop->at),
                                 NULL, matrix->size, matrix->number, error);
    } else {
        stability_read_pose(study, loop->pose, component);
        status = gough_matrix_at_rest(model, component, matrix->size, matrix->number, error);
    }
    if (!status) finish(model, units, matrix);
    return status;
}

void stability_matrix_print(FILE *stream, const stability_matrix *matrix) {
    const size_t n = matrix->size;
    for (size_t j = 0; j < n; j++) fprintf(stream, "%s%c", matrix->name[j], j + 1 < n ? ',' : '\n');
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++)
            fprintf(stream, "%.17g%c", matrix->number[n * i + j], j + 1 < n ? ',' : '\n');
}

void stability_matrix_set(json_t *object, const stability_matrix *matrix) {
    const size_t n = matrix->size;
    json_t *rows = json_array(), *names = json_array();
    for (size_t i = 0; i < n; i++) {
        json_array_append_new(rows, json_numbers(matrix->number + n * i, n));
        json_array_append_new(names, json_string(matrix->name[i]));
    }
    json_object_set_new(object, "matrix", rows);
    json_object_set_new(object, "matrix_columns", names);
}

void stability_matrix_free(stability_matrix *matrix) {
    free(matrix->number);
    free(matrix->name);
}
