/* The loop about a periodic program over one period, for any stiffness: how it is divided into parts and steps, and what
 * each part does at the Chebyshev points of G. Theory: docs/theory/floquet.md. */
#ifndef GOUGH_MAP_TRANSITION_H
#define GOUGH_MAP_TRANSITION_H

#include "gough/floquet.h"
#include "linear/linear.h"
#include "map/lane_matrices_table.h"

/* How finely a period is divided. */
typedef struct {
    size_t parts;
    size_t steps; /* of each part */
    double phase; /* of the fastest mode at the greatest stiffness, over the period */
} division;

/* Parts short enough for NODES points in 0 … top, and steps short enough for most purposes; D as in the loop's control.
 * GOUGH_ERROR_INPUT, GOUGH_ERROR_NUMERICAL: as for gough_linearise() along the program. */
gough_status transition_divide(const linear_loop *loop, const gough_period *period, double top,
                               division *d, gough_error *error);

/* Bytes of scratch memory for transition_find(), aligned to 64. */
size_t transition_scratch(const struct analyse_width *width);

/* Fills t->phi, which has room for d->parts. D as in the loop's control; its stiffness is not looked at. */
gough_status transition_find(const struct analyse_width *width, const linear_loop *loop,
                             const gough_period *period, double top, const division *d,
                             transitions *t, void *scratch, gough_error *error);

#endif
