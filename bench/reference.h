/* The machine, the program and the runs of every figure: closed loop, six axes, 20 units. */
#ifndef BENCH_REFERENCE_H
#define BENCH_REFERENCE_H

#include <stdbool.h>

#include "gough/batch.h"

enum { REFERENCE_RUNS = 512 };

/* base radius 1, top 0.6, half angles 15°, height 1.2, mass 1, J = 0.08, 0.08, 0.15, G = 50; the paper's heave; g = 1. Legs without
 * mass, or: cylinders of mass 0.05, centre 0.35, inertia 0.002; pistons of 0.03, 0.35, 0.0012; reflected mass 0.1 */
typedef struct {
    gough_model model; /* with the first run's beginning */
    gough_initial
        initial[REFERENCE_RUNS]; /* off the program in all six freedoms, each a bit otherwise */
    gough_batch_run run[REFERENCE_RUNS];
    gough_outcome outcome[REFERENCE_RUNS];
    double duration;
    double position[3], angles[3]; /* where the first run ends, to 16 digits */
    double rotation[3][3];
} reference;

/* fills it, final pose of the first run included (in quadruple precision); heavy: legs have mass */
void reference_begin(reference *r, double duration, bool heavy);

/* largest difference of a final pose from that of the first run: positions over R_b = 1, angles in radians */
double reference_error(const reference *r, const double position[3], const double angles[3]);
double reference_error_matrix(const reference *r, const double position[3], double rotation[3][3]);

/* n steps of a fixed stepper, or a tolerance of adaptive dop853 if n is 0 */
gough_simulation reference_simulation(const reference *r, gough_method method, long n,
                                      double tolerance);
/* as many rows as a user would have: one each 0.05 units */
gough_simulation reference_rows(const reference *r, gough_method method, double step);

/* one run alone, by gough_simulate(); returns its error */
double reference_alone(const reference *r, const gough_simulation *s);

#endif
