/* Units of dimensionless tables in words: numbers of such a table are counted in the base's radius R_b, the load's mass M and the
 * gravity g. A quantity of dimension length^a mass^b time^c is counted in R_b^a M^b √(R_b/g)^c. */
#include <string.h>

#include "figure/builder.h"

/* The quantities of tables, by their exponents of length, mass, time and angle. */
static const struct {
    int length, mass, time, angle;
    const char *words;
} known[] = {{1, 0, 0, 0, "R_b"},           {0, 0, 1, 0, "√(R_b/g)"},
             {1, 0, -1, 0, "√(R_b g)"},     {1, 0, -2, 0, "g"},
             {1, 1, -2, 0, "M g"},          {2, 1, -2, 0, "M g R_b"},
             {2, 1, -3, 0, "M g √(R_b g)"}, {0, 0, -1, 1, "°·√(g/R_b)"},
             {0, 0, -2, 1, "°·g/R_b"}};

/* Columns of sweeps and of gough tune. */
static const struct {
    const char *column, *words;
} of_sweep[] = {{"position_deviation", "R_b"},
                {"force", "M g"},
                {"speed", "√(R_b g)"},
                {"power", "M g √(R_b g)"},
                {"power_least", "M g √(R_b g)"},
                {"power_greatest", "M g √(R_b g)"},
                {"energy", "M g R_b"},
                {"end_time", "√(R_b/g)"},
                {"G", "M g/R_b"}};

const char *builder_unit_words(const builder *b, const char *column) {
    const char *unit = builder_unit(b, column);
    const bool angular = strncmp(unit, "degree", 6) == 0;
    if (strcmp(unit, "1") != 0 && !angular) return unit;
    /* angles have their unit in both kinds of tables; rates of angles tell the kind by the time */
    if (angular && (strcmp(unit, "degree") == 0 || strcmp(builder_unit(b, "t"), "1") != 0))
        return unit;
    for (size_t k = 0; k < sizeof of_sweep / sizeof of_sweep[0]; k++)
        if (strcmp(of_sweep[k].column, column) == 0) return of_sweep[k].words;
    for (int c = 0; c < GOUGH_COLUMNS; c++) {
        const gough_column_info *info = gough_column(c);
        if (strcmp(info->name, column) != 0) continue;
        for (size_t k = 0; k < sizeof known / sizeof known[0]; k++)
            if (known[k].length == info->length && known[k].mass == info->mass &&
                known[k].time == info->time && known[k].angle == info->angle)
                return known[k].words;
    }
    return unit;
}
