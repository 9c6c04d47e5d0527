/* Deviations from a periodic motion carried over one period, as a product of factors each over a part of it. Theory:
 * docs/theory/floquet.md. */
#ifndef GOUGH_FLOQUET_MONODROMY_H
#define GOUGH_FLOQUET_MONODROMY_H

#include "gough/floquet.h"
#include "linear/linear.h"

/* Parts of the period: in each of them even fast growth is moderate, so that determinant and small multipliers keep their
 * digits. Where drives decay by more than that in each of so many parts, few parts save most of the steps: deviations of drives
 * need short steps after the beginning of each. */
enum {
    MONODROMY_PARTS = 64, /* at most */
    MONODROMY_ROWS = GOUGH_LINEAR_MOST,
    MONODROMY_SIZE = MONODROMY_ROWS * MONODROMY_ROWS
};

typedef struct {
    linear_loop loop;
    int n;                   /* numbers of a deviation: ξ, and of drives and integrals those … */
    int kept[LINEAR_BEYOND]; /* … in these places of a state behind MOTION */
    double start, period, tolerance;
    int parts;
    bool bare; /* the motion alone is carried round, without deviations */
    /* of these numbers: powers of 2 near R_b, 1, √(g R_b), √(g/R_b); of a force, and of its rate */
    double unit[MONODROMY_ROWS];
    size_t steps;
    double trace;                                   /* ∫ tr A dt over the period */
    double factor[MONODROMY_PARTS][MONODROMY_SIZE]; /* (floquet-5), n × n, columns one after the
                                                     * other, in these units */
} monodromy;

/* Whether drives lag or have limits of their commands, or a continuous controller integrates: then the loop has a motion of its
 * own, in which they take part. */
bool monodromy_is_whole(const gough_model *model);

void monodromy_begin(monodromy *m, const gough_model *model, const gough_period *period,
                     double tolerance);

/* (floquet-4) about the program.
 * GOUGH_ERROR_INPUT: a formula is not finite; GOUGH_ERROR_NUMERICAL: a singular pose, or too many steps. */
gough_status monodromy_of_program(monodromy *m, gough_error *error);

/* The same about the motion that begins in y, which is then where the motion is a period later. */
gough_status monodromy_of_motion(monodromy *m, double y[STATE_SIZE], gough_error *error);

/* The product of all factors, columns one after the other, in the units of m. */
void monodromy_product(const monodromy *m, double product[MONODROMY_SIZE]);

/* c = a b of n × n, columns one after the other; c is neither */
void monodromy_multiply(int n, const double *a, const double *b, double *c);

/* Between the state of a top and (ρ, i, j, k) with rates. */
void monodromy_unfold(const gough_machine *machine, const gough_state *state, double y[MOTION]);
void monodromy_fold(const gough_machine *machine, const double y[MOTION], gough_state *state);

#endif
