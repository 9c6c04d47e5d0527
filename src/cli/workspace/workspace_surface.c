/* gough workspace -o: the surface of the positions, or an outline in the plane of two components, by straight lines from home. */
#include <math.h>
#include <stdio.h>

#include "cli/common/memory.h"
#include "cli/common/scale.h"
#include "cli/common/talk.h"
#include "cli/workspace/workspace_verb.h"

/* lines: every 5 degrees of azimuth and elevation, the poles once each; every degree of an outline */
enum { AZIMUTHS = 72, ELEVATIONS = 35, SURFACE = AZIMUTHS * ELEVATIONS + 2, OUTLINE = 360 };
/* columns behind the six components */
enum { COLUMN_LIMIT = GOUGH_COMPONENTS, COLUMN_LEG, COLUMNS };

static const double DEGREE = 3.14159265358979323846 / 180;

static bool is_slice(const workspace_line *line) { return line->slice[0] != line->slice[1]; }

/* Line i of a surface: azimuth from x towards y, elevation from −90° to 90°. */
static void surface_direction(size_t i, double direction[GOUGH_COMPONENTS]) {
    const size_t row = i == 0 ? 0 : i == SURFACE - 1 ? ELEVATIONS + 1 : 1 + (i - 1) / AZIMUTHS;
    const double elevation = (5.0 * (double)row - 90) * DEGREE,
                 azimuth = 5.0 * (double)((i + AZIMUTHS - 1) % AZIMUTHS) * DEGREE;
    direction[0] = cos(elevation) * cos(azimuth);
    direction[1] = cos(elevation) * sin(azimuth);
    direction[2] = sin(elevation);
}

/* Line i of an outline: evenly around, with the travels of both components as units. */
static void outline_direction(const workspace_line *line, const workspace_answer *a, size_t i,
                              double direction[GOUGH_COMPONENTS]) {
    for (int k = 0; k < 2; k++) {
        const double *end = a->travel[line->slice[k]].end, span = end[1] - end[0];
        const double angle = (double)i * DEGREE;
        direction[line->slice[k]] = (span > 0 ? span : 1) * (k ? sin(angle) : cos(angle));
    }
}

static void name_columns(const workspace_answer *a, gough_table *table, double *column[COLUMNS]) {
    for (size_t c = 0; c < COLUMNS; c++) {
        const char *name = c == COLUMN_LIMIT ? "limit"
                           : c == COLUMN_LEG ? "leg"
                                             : gough_component_name((int)c);
        const char *word = c < COLUMN_LIMIT ? unit_word(a->unit, component_unit((int)c)) : "";
        column[c] = gough_table_name(table, c, name, *word ? word + 1 : "");
        if (!column[c]) out_of_memory();
    }
}

static gough_status fill(const workspace_line *line, const workspace_answer *a, size_t rows,
                         double *column[COLUMNS], gough_error *error) {
    for (size_t i = 0; i < rows; i++) {
        double start[GOUGH_COMPONENTS] = {0, 0, 0, 0, 0, 0}, direction[GOUGH_COMPONENTS] = {0};
        gough_ray ray;
        if (is_slice(line)) {
            outline_direction(line, a, i, direction);
        } else {
            for (int k = 0; k < 3; k++)
                start[GOUGH_ROLL + k] = a->study->model->workspace.orientation[k];
            surface_direction(i, direction);
        }
        const gough_status status = gough_workspace_ray(&a->reach, start, direction, &ray, error);
        if (status) return status;
        for (int c = 0; c < GOUGH_COMPONENTS; c++)
            column[c][i] =
                in_units(a->unit, component_unit(c), start[c] + ray.reach * direction[c]);
        column[COLUMN_LIMIT][i] = ray.binding.bind;
        column[COLUMN_LEG][i] = binding_has_leg(&ray.binding) ? ray.binding.which + 1 : 0;
    }
    return GOUGH_OK;
}

gough_status workspace_write(const workspace_line *line, const workspace_answer *a) {
    const size_t rows = is_slice(line) ? OUTLINE : SURFACE;
    gough_table *table = gough_table_new(a->study->title, "workspace", COLUMNS, rows);
    double *column[COLUMNS];
    gough_error error = {.message = ""};
    if (!table) out_of_memory();
    name_columns(a, table, column);
    gough_status status = fill(line, a, rows, column, &error);
    for (size_t i = 0; i < line->line.outputs.count && !status; i++)
        status = gough_table_write(table, a->study->text, line->line.outputs.word[i], &error);
    if (status) complain(line->line.verb, "%s", error.message);
    gough_table_free(table);
    return status;
}
