/* Units, all in one table: what one unit of the output is in units of the run, and what each is called. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "table/table.h"

/* (R_b, M, √(R_b/g)) are the units of length, mass and time of the dimensionless form. */
gough_status gough_units_of_study(const gough_study *study, bool dimensionless, gough_units *units,
                                  gough_error *error) {
    *units = (gough_units){study->dimensionless || dimensionless, 1.0, 1.0, 1.0};
    if (!dimensionless) return GOUGH_OK;

    const gough_machine *machine = &study->model->machine;
    if (!(machine->gravity_magnitude > 0.0))
        return gough_fail(
            error, GOUGH_ERROR_INPUT,
            "without gravity there is no dimensionless form, because its unit of time is "
            "sqrt(base radius/gravity); set gravity or keep the study's units");
    units->length = machine->base_radius;
    units->mass = machine->load.mass;
    units->time = sqrt(machine->base_radius / machine->gravity_magnitude);
    return GOUGH_OK;
}

/* 180/π */
#if defined(__SIZEOF_FLOAT128__)
#define QUAD_DEGREES (__extension__ 57.29577951308232087679815481410517033Q)
#else
#define QUAD_DEGREES 57.29577951308232087679815481410517033L
#endif

/* ---- what units there are ------------------------------------------------------------------------------------------ */

/* A unit is length^l · mass^m · time^t, or one of angle. */
typedef struct unit_info {
    signed char length, mass, time, angle;
    const char *label, *word,
        *field; /* in tables, after a number of a text, in the table of fields */
} unit_info;

static const unit_info units_known[] = {
    [GOUGH_UNIT_NONE] = {0, 0, 0, 0, "1", "", ""},
    [GOUGH_UNIT_LENGTH] = {1, 0, 0, 0, "m", " m", "length"},
    [GOUGH_UNIT_MASS] = {0, 1, 0, 0, "kg", " kg", "mass"},
    [GOUGH_UNIT_TIME] = {0, 0, 1, 0, "s", " s", "time"},
    [GOUGH_UNIT_ANGLE] = {0, 0, 0, 1, "degree", " deg", "angle [degrees]"},
    [GOUGH_UNIT_RATE] = {0, 0, -1, 0, "1/s", " 1/s", "1/time"},
    [GOUGH_UNIT_SPEED] = {1, 0, -1, 0, "m/s", " m/s", "length/time"},
    [GOUGH_UNIT_ANGULAR_SPEED] = {0, 0, -1, 1, "degree/s", " deg/s", "angle/time [degrees]"},
    [GOUGH_UNIT_ACCELERATION] = {1, 0, -2, 0, "m/s2", " m/s^2", "length/time²"},
    [GOUGH_UNIT_ANGULAR_ACCELERATION] = {0, 0, -2, 1, "degree/s2", " deg/s^2",
                                         "angle/time² [degrees]"},
    [GOUGH_UNIT_FORCE] = {1, 1, -2, 0, "N", " N", "force"},
    [GOUGH_UNIT_MOMENT] = {2, 1, -2, 0, "N m", " N m", "force·length"},
    [GOUGH_UNIT_POWER] = {2, 1, -3, 0, "W", " W", NULL},
    [GOUGH_UNIT_ENERGY] = {2, 1, -2, 0, "J", " J", NULL},
    [GOUGH_UNIT_STIFFNESS] = {0, 1, -2, 0, "N/m", " N/m", "force/length"},
    [GOUGH_UNIT_DAMPING] = {0, 1, -1, 0, "N s/m", " N s/m", "force·time/length"},
    [GOUGH_UNIT_INERTIA] = {2, 1, 0, 0, "kg m2", " kg m^2", "mass·length²"}};
enum { UNITS = sizeof units_known / sizeof units_known[0] };

static const unit_info *info_of(gough_unit unit) {
    return &units_known[(unsigned)unit < UNITS ? unit : GOUGH_UNIT_NONE];
}

const char *gough_unit_label(gough_unit unit, bool dimensionless) {
    const unit_info *u = info_of(unit);
    if (!dimensionless) return u->label;
    return units_known[u->angle ? GOUGH_UNIT_ANGLE : GOUGH_UNIT_NONE].label;
}

const char *gough_unit_word(gough_unit unit, bool dimensionless) {
    const unit_info *u = info_of(unit);
    if (!dimensionless) return u->word;
    return units_known[u->angle ? GOUGH_UNIT_ANGLE : GOUGH_UNIT_NONE].word;
}

/* Of the units with these exponents the first: a column with those of a moment is one. */
gough_unit gough_unit_of_column(int column) {
    const gough_column_info *info = gough_column(column);
    for (int i = 0; info && i < UNITS; i++) {
        const unit_info *u = &units_known[i];
        if (u->length == info->length && u->mass == info->mass && u->time == info->time &&
            u->angle == info->angle)
            return (gough_unit)i;
    }
    return GOUGH_UNIT_NONE;
}

gough_unit gough_unit_of_field(const char *unit) {
    for (int i = 0; i < UNITS; i++)
        if (units_known[i].field && strcmp(units_known[i].field, unit) == 0) return (gough_unit)i;
    return GOUGH_UNIT_NONE;
}

/* ---- scaling ------------------------------------------------------------------------------------------------------- */

/* √(length/g) beyond the double that `units` holds: each step of Newton doubles the digits, 16 to 32 to all. The double itself
 * where the unit of time is not the machine's, as in tables that keep the study's own units: there it is exactly 1. */
static gough_quad unit_of_time(const gough_units *units, double length, double gravity) {
    gough_quad time = units->time;
    const bool own = !(units->length < 1 || units->length > 1 || time < 1 || time > 1);
    if (own || !(fabs(units->time * units->time * gravity / length - 1.0) <= 1e-15)) return time;
    for (int step = 0; step < 2; step++)
        time += ((gough_quad)length / gravity - time * time) / (2 * time);
    return time;
}

static gough_quad power_of(gough_quad base, int exponent) {
    gough_quad power = 1;
    for (int i = 0; i < abs(exponent); i++) power *= base;
    return exponent < 0 ? 1 / power : power;
}

result_scale result_scale_of(const gough_units *units, double base_radius, double gravity) {
    return (result_scale){units->length, units->mass, unit_of_time(units, base_radius, gravity)};
}

/* 1/(length^l mass^m time^t), and 180/π for angles. */
gough_quad result_factor(const result_scale *scale, gough_unit unit) {
    const unit_info *u = info_of(unit);
    const gough_quad size = power_of(scale->length, u->length) * power_of(scale->mass, u->mass) *
                            power_of(scale->time, u->time);
    return (u->angle ? QUAD_DEGREES : 1) / size;
}

double gough_unit_size(const gough_units *units, gough_unit unit) {
    const unit_info *u = info_of(unit);
    return pow(units->length, u->length) * pow(units->mass, u->mass) * pow(units->time, u->time);
}

double gough_unit_factor(const gough_units *units, gough_unit unit) {
    return (info_of(unit)->angle ? (double)QUAD_DEGREES : 1) / gough_unit_size(units, unit);
}
