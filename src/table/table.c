/* The table that a run fills row by row, in memory: conversion to the units of the output. */
#define _DEFAULT_SOURCE /* _SC_PHYS_PAGES */

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "table/table.h"

/* A table takes at most this part of the machine's memory, lest a study of many rows starve everyone else. */
enum { MEMORY_SHARE = 4 };

static char *copy_text(const char *text) {
    const size_t size = strlen(text) + 1;
    char *copy = malloc(size);
    if (copy != NULL) memcpy(copy, text, size);
    return copy;
}

/* Limits of speed and force that all legs share, those of the force the same both ways, in the units of the output. */
static void put_limits(gough_result *result, const gough_study *study) {
    const gough_limits limits = gough_limits_of(&study->model->machine, &study->model->motion);
    const double speed = limits.speed[0], force = limits.force[0][1];
    bool fast = speed > 0 && isfinite(speed), strong = force > 0 && isfinite(force);
    for (int v = 0; v < GOUGH_LEGS; v++) {
        fast = fast && fabs(limits.speed[v] - speed) <= 0;
        strong = strong && fabs(limits.force[v][1] - force) <= 0 &&
                 fabs(limits.force[v][0] + force) <= 0;
    }
    const gough_units *u = &result->units;
    result->max_speed = fast ? speed * gough_unit_factor(u, GOUGH_UNIT_SPEED) : NAN;
    result->max_force = strong ? force * gough_unit_factor(u, GOUGH_UNIT_FORCE) : NAN;
}

gough_result *gough_result_new(const gough_study *study, const char *verb,
                               const gough_units *units) {
    gough_result *result = calloc(1, sizeof *result);
    if (result == NULL) return NULL;
    const bool simulated = strcmp(verb, "simulate") == 0;
    result->verb = simulated ? "simulate" : "forces";
    result->units = *units;
    const gough_machine *machine = &study->model->machine;
    const result_scale scale =
        result_scale_of(units, machine->base_radius, machine->gravity_magnitude);
    result->time = scale.base[GOUGH_BASE_TIME];
    for (int c = 0; c < GOUGH_COLUMNS; c++) {
        if (!gough_column_filled(c, simulated, &study->simulation)) continue;
        result->quad_factor[result->columns] = result_factor(&scale, gough_unit_of_column(c));
        result->factor[result->columns] = (double)result->quad_factor[result->columns];
        result->column[result->columns++] = c;
    }

    const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
    const size_t memory = pages > 0 && page > 0 ? (size_t)pages * (size_t)page : SIZE_MAX;
    const size_t cell =
        sizeof(double) + (study->simulation.precision == GOUGH_QUADRUPLE ? sizeof(gough_quad) : 0);
    result->row_limit = memory / MEMORY_SHARE / ((size_t)result->columns * cell);

    const gough_simulation *simulation = &study->simulation;
    const bool fixed = simulation->step > 0;
    result->tolerance = simulated && !fixed ? simulation->tolerance : NAN;
    result->step = simulated && fixed ? simulation->step / (double)result->time : NAN;
    put_limits(result, study);
    result->end.time = NAN;
    result->title = copy_text(study->title);
    result->text = copy_text(study->text);
    if (result->title == NULL || result->text == NULL) {
        gough_result_free(result);
        return NULL;
    }
    return result;
}

/* Room for twice the rows. On failure the table stays as it was. */
static bool grow(gough_result *result) {
    const size_t capacity = result->capacity == 0 ? 512 : 2 * result->capacity;
    for (int i = 0; i < result->columns; i++) {
        double *value = realloc(result->value[i], capacity * sizeof *value);
        if (value == NULL) return false;
        result->value[i] = value;
        if (!result->in_quad) continue;
        gough_quad *quad = realloc(result->quad[i], capacity * sizeof *quad);
        if (quad == NULL) return false;
        result->quad[i] = quad;
    }
    result->capacity = capacity;
    return true;
}

int gough_result_add(void *context, const gough_row *row) {
    gough_result *result = context;
    if (result->rows == 0 && result->capacity == 0) result->in_quad = row->quad != NULL;
    if (result->rows >= result->row_limit) return 1;
    if (result->rows == result->capacity && !grow(result)) return 1;

    const size_t r = result->rows;
    for (int i = 0; i < result->columns; i++) {
        const int c = result->column[i];
        if (result->in_quad) {
            const gough_quad value = row->quad != NULL ? row->quad[c] : (gough_quad)row->value[c];
            result->quad[i][r] = value * result->quad_factor[i];
            result->value[i][r] = (double)result->quad[i][r];
        } else {
            result->value[i][r] = row->value[c] * result->factor[i];
        }
    }
    result->rows++;
    return 0;
}

void gough_result_set_end(gough_result *result, const gough_end *end) {
    result->end = *end;
    result->end.time = end->time / (double)result->time;
}

bool gough_result_column_at(const gough_result *result, int index, gough_result_column *column) {
    if (index < 0 || index >= result->columns) return false;
    const gough_column_info *info = gough_column(result->column[index]);
    *column = (gough_result_column){.name = info->name,
                                    .long_name = info->long_name,
                                    .value = result->value[index],
                                    .rows = result->rows};
    snprintf(column->unit, sizeof column->unit, "%s",
             gough_unit_label(&result->units, gough_unit_of_column(result->column[index])));
    return true;
}

void gough_result_free(gough_result *result) {
    if (result == NULL) return;
    for (int i = 0; i < result->columns; i++) {
        free(result->value[i]);
        free(result->quad[i]);
    }
    free(result->title);
    free(result->text);
    free(result);
}
