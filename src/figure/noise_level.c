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
static const double earth = 9.80665;
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
    for (size_t t = 0; t < b->measured_count; t++)
        for (int leg = 1; leg <= GOUGH_LEGS; leg++) {
            char name[16];
            snprintf(name, sizeof name, "%s%d", prefix, leg);
            greatest = fmax(greatest, greatest_of_column(b->measured[t], name));
        }
    return greatest;
}

/* Of the most accurate run among those that are compared: what it resolves is no noise. */
static double share_of(const builder *b) {
    double tolerance = INFINITY;
    for (size_t t = 0; t < b->measured_count; t++) {
        const double own = b->measured[t]->tolerance;
        tolerance = fmin(tolerance, own > 0.0 ? own : usual_tolerance);
    }
    return fmin(fmax(errors * tolerance, least_share), greatest_share);
}

/* The units that the columns name; SI and degrees for those that name none. */
static gough_units units_of(const builder *b) {
    static const struct {
        gough_base_unit base;
        const char *column[2]; /* of a run, of a sweep */
    } named[] = {{GOUGH_BASE_LENGTH, {"l1", "position_deviation"}},
                 {GOUGH_BASE_FORCE, {"f1", "force"}},
                 {GOUGH_BASE_ANGLE, {"roll", "angle_deviation"}},
                 {GOUGH_BASE_TIME, {"t", "end_time"}}};
    gough_units units = gough_units_si();
    for (size_t i = 0; i < sizeof named / sizeof named[0]; i++)
        for (int k = 0; k < 2; k++)
            gough_units_choose(&units, named[i].base, builder_unit(b, named[i].column[k]));
    return units;
}

/* Of a machine's size, in the units of the table. */
typedef struct scales {
    double length, time, force, power, angle;
} scales;

static scales scales_of(const builder *b, const char *unit) {
    const gough_units units = units_of(b);
    const bool dimensions =
        unit[0] != '\0' && strcmp(unit, "1") != 0 && strncmp(unit, "deg", 3) != 0;
    scales s = {.length = greatest_of_legs(b, "l"),
                .force = greatest_of_legs(b, "f"),
                .angle = gough_unit_factor(&units, GOUGH_UNIT_ANGLE)};
    if (!(s.length > 0.0))
        s.length = dimensions ? least_length * gough_unit_factor(&units, GOUGH_UNIT_LENGTH) : 1.0;
    const double length = gough_unit_read(&units, GOUGH_UNIT_LENGTH, s.length),
                 time = sqrt(length / (dimensions ? earth : 1.0));
    s.time = gough_unit_factor(&units, GOUGH_UNIT_TIME) * time;
    s.power = gough_unit_read(&units, GOUGH_UNIT_FORCE, s.force) * length / time;
    return s;
}

double builder_noise(const builder *b, const char *column) {
    const double share = share_of(b);
    const scales own = scales_of(b, builder_unit(b, column));
    if (strcmp(column, "angle_deviation") == 0) return share * own.angle;
    if (strcmp(column, "position_deviation") == 0) return share * own.length;
    for (int c = 0; c < GOUGH_COLUMNS; c++) {
        const gough_column_info *info = gough_column(c);
        if (strcmp(info->name, column) != 0 || strcmp(column, "t") == 0) continue;
        if (info->mass != 0)
            return info->length == 1 && info->time == -2   ? share * own.force
                   : info->length == 2 && info->time == -3 ? share * own.power
                                                           : 0.0;
        if (info->angle == 0 && info->length == 0) return 0.0;
        return share * (info->angle != 0 ? own.angle : 1.0) * pow(own.length, info->length) *
               pow(own.time, info->time);
    }
    return 0.0;
}
