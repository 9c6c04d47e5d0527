/* What a summary keeps for limits of the platform and of the legs' accelerations, and the power of external loads. */
#ifndef GOUGH_RUN_SUMMARY_LIMITS_H
#define GOUGH_RUN_SUMMARY_LIMITS_H

#include "gough/simulate.h"

/* sets what a summary that was just begun is to keep for the limits of a machine that moves by a motion */
void summary_limits_begin(gough_summary *summary, const gough_machine *machine,
                          const gough_motion *motion);

/* From the numbers of a row: pose, velocity and acceleration of the platform at `about`, and second derivatives of the lengths. */
void summary_limits_row(const gough_machine *machine, gough_order order, const double about[3],
                        const double *value, double component[3][GOUGH_COMPONENTS],
                        double acceleration[GOUGH_LEGS]);

/* From the numbers of a row: F·v + L·ω of the external loads, v being that of the centre of mass. */
double summary_external_power(const gough_machine *machine, gough_order order, const double *value);

/* Times in which drives are held back. Between two moments a drive is held for the share of their states, each of which is 0 or 1:
 * that is exact where commands are held, since they change at looks only. */
void summary_saturation(gough_summary *summary, const double *value);

#endif
