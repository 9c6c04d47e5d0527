/* The periodic motion of a loop that does not keep its program. Theory: docs/theory/floquet.md. */
#ifndef GOUGH_FLOQUET_ORBIT_H
#define GOUGH_FLOQUET_ORBIT_H

#include "floquet/monodromy.h"

/* (floquet-7): finds the state y at the beginning of the period that comes back after it, with the factors of its deviations in m.
 * GOUGH_ERROR_NUMERICAL: none was found near the program. */
gough_status orbit_find(monodromy *m, double y[STATE_SIZE], gough_error *error);

/* the state y changed by ξ */
void orbit_change(const double y[MOTION], const double xi[GOUGH_LINEAR], double out[MOTION]);

/* ξ from y to z; of the rotation between them, its axis times the sine of its angle */
void orbit_difference(const double y[MOTION], const double z[MOTION], double xi[GOUGH_LINEAR]);

#endif
