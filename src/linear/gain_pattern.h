/* Gains of a controller as a pattern and its size: what varies when all stiffnesses, or all dampings, change in proportion. */
#ifndef GOUGH_LINEAR_GAIN_PATTERN_H
#define GOUGH_LINEAR_GAIN_PATTERN_H

#include "gough/model.h"

/* a pattern of gains whose largest on the diagonal is 1, or, if the diagonal is 0, whose largest is 1 */
typedef struct {
    double own[GOUGH_LEGS], cross[GOUGH_LEGS][GOUGH_LEGS];
} gain_pattern;

/* Returns its size; a pattern without gains is that of equal legs, of size 0 */
double gain_pattern_of(const double own[GOUGH_LEGS], const double cross[GOUGH_LEGS][GOUGH_LEGS],
                       bool coupled, gain_pattern *p);

/* gains of a size in a pattern */
void gain_pattern_spread(const gain_pattern *p, double size, double own[GOUGH_LEGS],
                         double cross[GOUGH_LEGS][GOUGH_LEGS]);

#endif
