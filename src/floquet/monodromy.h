/* Deviations from a periodic motion carried over one period, as a product of factors each over a part of it. Theory:
 * docs/theory/floquet.md. */
#ifndef GOUGH_FLOQUET_MONODROMY_H
#define GOUGH_FLOQUET_MONODROMY_H

#include "gough/floquet.h"
#include "linear/linear.h"

/* Parts of the period: in each of them even fast growth is moderate, so that determinant and small multipliers keep their
 * digits. */
enum { MONODROMY_PARTS = 64, MONODROMY_SIZE = GOUGH_LINEAR * GOUGH_LINEAR };

typedef struct {
    linear_loop loop;
    double start, period, tolerance;
    double unit[GOUGH_LINEAR]; /* of ξ: powers of 2 near R_b, 1, √(g R_b), √(g/R_b) */
    size_t steps;
    double trace; /* ∫ tr A dt over the period */
    double factor[MONODROMY_PARTS]
                 [MONODROMY_SIZE]; /* (floquet-5), columns one after the other, in these units */
} monodromy;

void monodromy_begin(monodromy *m, const gough_model *model, const gough_period *period,
                     double tolerance);

/* (floquet-4) about the program.
 * GOUGH_ERROR_INPUT: a formula is not finite; GOUGH_ERROR_NUMERICAL: a singular pose, or too many steps. */
gough_status monodromy_of_program(monodromy *m, gough_error *error);

/* The same about the motion that begins in y, which is then where the motion is a period later. */
gough_status monodromy_of_motion(monodromy *m, double y[MOTION], gough_error *error);

/* The product of all factors, columns one after the other, in the units of m. */
void monodromy_product(const monodromy *m, double product[MONODROMY_SIZE]);

/* c = a b, columns one after the other; c is neither */
void monodromy_multiply(const double *a, const double *b, double *c);

/* Between the state of a top and (ρ, i, j, k) with rates. */
void monodromy_unfold(const gough_machine *machine, const gough_state *state, double y[MOTION]);
void monodromy_fold(const gough_machine *machine, const double y[MOTION], gough_state *state);

#endif
