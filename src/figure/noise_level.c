/* Below what size a number of a table is only an error of the run: a share of the scale of its column. The scale follows
 * from the length of the legs, a unit of time √(length/g) with the earth's g, and the greatest leg force; the share from the
 * tolerance of the run. The page has the same in web/src/data.js. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "figure/builder.h"

/* Errors of a run reach a hundred times its tolerance. A table that does not name it, as CSV, is taken to have the default of
 * studies. The share has bounds, so that neither rounding is drawn as a signal nor a signal of a coarse run as nothing. */
static const double errors = 100.0, usual_tolerance = 1e-10, least_share = 1e-12,
                    greatest_share = 1e-6;
static const double degree = 57.29577951308232, earth = 9.80665;
/* Sweeps do not say how large the machine is: as small a one as is built, in metres, so that no motion is taken for noise. */
static const double least_length = 0.05;

static double greatest_of_column(const gough_table *table, const char *name) {
    const double *value = gough_table_column(table, name);
    double greatest = 0.0;
    for (size_t r = 0; value != NULL && r < table->rows; r++)
        if (isfinite(value[r])) greatest = fmax(greatest, fabs(value[r]));
    return greatest;
}

static double greatest_of_legs(const builder *b, const char *prefix) {
    double greatest = 0.0;
    for (size_t t = 0; t < b->table_count; t++)
        for (int leg = 1; leg <= GOUGH_LEGS; leg++) {
            char name[16];
            snprintf(name, sizeof name, "%s%d", prefix, leg);
            greatest = fmax(greatest, greatest_of_column(b->tables[t], name));
        }
    return greatest;
}

/* Of the most accurate run among those that are compared: what it resolves is no noise. */
static double share_of(const builder *b) {
    double tolerance = INFINITY;
    for (size_t t = 0; t < b->table_count; t++) {
        const double own = b->tables[t]->tolerance;
        tolerance = fmin(tolerance, own > 0.0 ? own : usual_tolerance);
    }
    return fmin(fmax(errors * tolerance, least_share), greatest_share);
}

typedef struct scales {
    double length, time, force;
} scales;

static scales scales_of(const builder *b, const char *unit) {
    const bool metres = unit[0] == 'm' || unit[0] == 'W' || unit[0] == 'N';
    scales s = {.length = greatest_of_legs(b, "l"), .force = greatest_of_legs(b, "f")};
    if (!(s.length > 0.0)) s.length = metres ? least_length : 1.0;
    s.time = sqrt(s.length / (metres ? earth : 1.0));
    return s;
}

double builder_noise(const builder *b, const char *column) {
    const double share = share_of(b);
    if (strcmp(column, "angle_deviation") == 0) return share * degree;
    if (strcmp(column, "position_deviation") == 0)
        return share * scales_of(b, builder_unit(b, column)).length;
    for (int c = 0; c < GOUGH_COLUMNS; c++) {
        const gough_column_info *info = gough_column(c);
        if (strcmp(info->name, column) != 0 || strcmp(column, "t") == 0) continue;
        const scales s = scales_of(b, builder_unit(b, column));
        if (info->mass != 0) /* a force, or a power, which is force · length / time */
            return info->length == 1 && info->time == -2   ? share * s.force
                   : info->length == 2 && info->time == -3 ? share * s.force * s.length / s.time
                                                           : 0.0;
        if (info->angle == 0 && info->length == 0) return 0.0;
        return share * (info->angle != 0 ? degree : 1.0) * pow(s.length, info->length) *
               pow(s.time, info->time);
    }
    return 0.0;
}
