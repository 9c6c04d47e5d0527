/* Units of tables: those of a study's output and of the columns, and factors in 33 digits. */
#include <math.h>
#include <stdlib.h>

#include "table/table.h"

/* (R_b, M, √(R_b/g)) are the units of length, mass and time of the dimensionless form. */
gough_status gough_units_of_study(const gough_study *study, bool dimensionless, gough_units *units,
                                  gough_error *error) {
    *units = study->units.length > 0 ? study->units : gough_units_si();
    units->dimensionless = units->dimensionless || study->dimensionless;
    if (!dimensionless) return GOUGH_OK;

    const gough_machine *machine = &study->model->machine;
    if (!(machine->gravity_magnitude > 0.0))
        return gough_fail(
            error, GOUGH_ERROR_INPUT,
            "without gravity there is no dimensionless form, because its unit of time is "
            "sqrt(base radius/gravity); set gravity or keep the study's units");
    *units = (gough_units){.dimensionless = true,
                           .length = machine->base_radius,
                           .mass = machine->load.mass,
                           .time = sqrt(machine->base_radius / machine->gravity_magnitude)};
    return GOUGH_OK;
}

/* Of the units with these exponents the first: a column with those of a moment is one. */
gough_unit gough_unit_of_column(int column) {
    const gough_units consistent = {.length = 1, .mass = 1, .time = 1};
    const gough_column_info *info = gough_column(column);
    for (gough_unit u = GOUGH_UNIT_NONE; info && u <= GOUGH_UNIT_INERTIA; u++) {
        int power[GOUGH_BASE_UNITS];
        gough_unit_powers(&consistent, u, power);
        if (power[GOUGH_BASE_LENGTH] == info->length && power[GOUGH_BASE_MASS] == info->mass &&
            power[GOUGH_BASE_TIME] == info->time && power[GOUGH_BASE_ANGLE] == info->angle)
            return u;
    }
    return GOUGH_UNIT_NONE;
}

/* ---- scaling in 33 digits ------------------------------------------------------------------------------------------ */

/* 180/π */
#if defined(__SIZEOF_FLOAT128__)
#define QUAD_DEGREES (__extension__ 57.29577951308232087679815481410517033Q)
#else
#define QUAD_DEGREES 57.29577951308232087679815481410517033L
#endif

/* Units that a study chooses are decimal numbers of at most this many places. */
static const double places = 1e13;

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

static gough_quad decimal_of(double size) { return (gough_quad)rint(size * places) / places; }

result_scale result_scale_of(const gough_units *units, double base_radius, double gravity) {
    result_scale scale = {.units = *units};
    gough_quad *const base = scale.base;
    const double turn = gough_unit_factor(units, GOUGH_UNIT_ANGLE), degrees = (double)QUAD_DEGREES,
                 parts = rint(turn / degrees);
    const bool of_degrees = parts > 0 && !(fabs(turn - parts * degrees) > 1e-12 * turn);
    if (units->dimensionless) {
        base[GOUGH_BASE_LENGTH] = units->length;
        base[GOUGH_BASE_MASS] = units->mass;
        base[GOUGH_BASE_TIME] = unit_of_time(units, base_radius, gravity);
        base[GOUGH_BASE_FORCE] = 1;
    } else {
        base[GOUGH_BASE_LENGTH] = decimal_of(units->length);
        base[GOUGH_BASE_MASS] = decimal_of(units->mass);
        base[GOUGH_BASE_TIME] = decimal_of(units->time);
        base[GOUGH_BASE_FORCE] = decimal_of(units->force);
    }
    scale.turn = of_degrees ? parts * QUAD_DEGREES : decimal_of(turn);
    return scale;
}

static gough_quad power_of(gough_quad base, int exponent) {
    gough_quad power = 1;
    for (int i = 0; i < abs(exponent); i++) power *= base;
    return exponent < 0 ? 1 / power : power;
}

gough_quad result_factor(const result_scale *scale, gough_unit unit) {
    static const gough_base_unit sized[] = {GOUGH_BASE_LENGTH, GOUGH_BASE_FORCE, GOUGH_BASE_MASS,
                                            GOUGH_BASE_TIME};
    int power[GOUGH_BASE_UNITS];
    gough_quad size = 1;
    gough_unit_powers(&scale->units, unit, power);
    for (size_t i = 0; i < sizeof sized / sizeof *sized; i++)
        size *= power_of(scale->base[sized[i]], power[sized[i]]);
    return (power[GOUGH_BASE_ANGLE] ? scale->turn : 1) / size;
}
