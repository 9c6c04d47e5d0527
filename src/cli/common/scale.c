/* Numbers of a struct turned from units of the run into those of the output, by a table of what they measure; units as words. */
#include "cli/common/scale.h"

#include <math.h>
#include <stdio.h>

void scale_members(void *object, const scaled_member *member, size_t count,
                   const gough_units *units) {
    for (size_t m = 0; m < count; m++) {
        const gough_unit unit = member[m].unit;
        const double size = gough_unit_size(units, unit),
                     turn = unit == GOUGH_UNIT_ANGLE ? gough_unit_factor(units, unit) : 1;
        double *value = (double *)(void *)((char *)object + member[m].at);
        for (size_t i = 0; i < member[m].count; i++) value[i] = value[i] / size * turn;
    }
}

const char *unit_word(const gough_units *units, gough_unit unit) {
    return gough_unit_word(unit, units->dimensionless);
}

table_heading heading_of(const char *what, const char *unit) {
    table_heading heading;
    if (*unit)
        snprintf(heading.text, sizeof heading.text, "%s%s[%s]", what, *what ? " " : "", unit + 1);
    else
        snprintf(heading.text, sizeof heading.text, "%s", what);
    return heading;
}

/* Whether the output is in the units of the run. */
static bool is_own(const gough_units *units) {
    bool own = true;
    for (gough_unit u = GOUGH_UNIT_LENGTH; u <= GOUGH_UNIT_TIME; u++)
        own = own && !(fabs(gough_unit_size(units, u) - 1) > 0);
    return own;
}

const char *units_sentence(const gough_study *study, const gough_units *units) {
    if (!units->dimensionless) return "SI units, angles in degrees";
    if (study->dimensionless && is_own(units)) return "dimensionless, angles in degrees";
    return "dimensionless: lengths in R_b, masses in M, times in sqrt(R_b/g); angles in degrees";
}
