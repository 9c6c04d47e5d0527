/* Whether deviations grow in the loop that simulate is to run. */
#ifndef GOUGH_CLI_GROWTH_H
#define GOUGH_CLI_GROWTH_H

#include "gough/gough.h"

/* Remarks, if computation shows it, that the loop of a study to be simulated is unstable (growth.c). */
void remark_growth(const char *verb, const gough_study *study, const gough_units *units);

#endif
