/* What a formula in t says of its own period: the angular rates of its sines, and until when its ramps run. Theory:
 * docs/theory/floquet.md. */
#ifndef GOUGH_FLOQUET_FORMULA_RATES_H
#define GOUGH_FLOQUET_FORMULA_RATES_H

#include "gough/model.h"

/* at most one for each operation of six formulas */
enum { RATES_MOST = GOUGH_COMPONENTS * GOUGH_FORMULA_OPERATIONS };

typedef struct {
    size_t count;
    double rate
        [RATES_MOST]; /* |ω| of sin, cos and tan of ωt + what stays bounded; no two alike, by 1e-13 */
    double
        latest; /* when the last ramp is over and the last tanh, exp or atan has passed its middle; 0: at once */
} rates;

/* (floquet-1) of all formulas of a motion as it runs, its factor of frequency included. */
void rates_of_motion(const gough_motion *motion, rates *found);

/* (floquet-2): the common period of all of them, 0 where there is no rate. `cycles`: of the fastest in it. Returns false where
 * two of them, which are named, have no ratio of whole numbers up to 1000. */
bool rates_common_period(const rates *found, double *period, double *cycles, double apart[2]);

#endif
