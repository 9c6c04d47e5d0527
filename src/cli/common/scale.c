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
    return gough_unit_word(units, unit);
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

static bool is_si(const gough_units *units) {
    bool si = true;
    for (int b = 0; b < GOUGH_BASE_UNITS; b++) si = si && units->name[b] == 0;
    return si;
}

units_words units_sentence(const gough_study *study, const gough_units *units) {
    units_words words;
    const char *sentence =
        "dimensionless: lengths in R_b, masses in M, times in sqrt(R_b/g); angles in degrees";
    if (!units->dimensionless && is_si(units)) sentence = "SI units, angles in degrees";
    if (study->dimensionless && is_own(units)) sentence = "dimensionless, angles in degrees";
    if (units->dimensionless || is_si(units))
        snprintf(words.text, sizeof words.text, "%s", sentence);
    else
        snprintf(words.text, sizeof words.text,
                 "lengths in%s, forces in%s, masses in%s, angles in%s, times in%s",
                 unit_word(units, GOUGH_UNIT_LENGTH), unit_word(units, GOUGH_UNIT_FORCE),
                 unit_word(units, GOUGH_UNIT_MASS), unit_word(units, GOUGH_UNIT_ANGLE),
                 unit_word(units, GOUGH_UNIT_TIME));
    return words;
}

gough_unit component_unit(int component) {
    return component < GOUGH_ROLL ? GOUGH_UNIT_LENGTH : GOUGH_UNIT_ANGLE;
}

double in_units(const gough_units *units, gough_unit unit, double value) {
    return gough_unit_factor(units, unit) * value;
}

two_numbers two_in_units(const gough_units *units, gough_unit unit, double first, double second) {
    return (two_numbers){{in_units(units, unit, first), in_units(units, unit, second)}};
}

bool nearly_same(double a, double b) {
    if (isinf(a) || isinf(b)) return !(a < b || a > b);
    return fabs(a - b) <= 1e-12 * fmax(fabs(a), fabs(b));
}
