/* Times that no step may pass, and how long a step may be at most so that nothing which depends on time alone is stepped
 * over.
 *
 * A study states corners: ends of ramps, of moves and of records, knots of the noise. A step ends at each of them. Between
 * corners any formula may hold a pulse that a stepper, whose steps have grown long while nothing happened, would pass
 * without evaluating it. Time is therefore cut into pieces, halved until each formula is slow on its piece: with δ the
 * length of the piece and V the largest difference among the values at its ends and its middle, (step-7) sup |f''| δ² <= 16
 * V. The supremum is a bound that holds for every time in the piece (interval.h), so a pulse cannot hide between the
 * samples: it would make f'' large. A step is then no longer than the pieces that it covers.
 *
 * Which pieces there are depends on program, disturbance, external loads and duration alone, not on the steps taken: all
 * runs and lanes that share them share their steps. In double precision for every number type. */
#ifndef GOUGH_PROGRAM_APPOINTMENTS_H
#define GOUGH_PROGRAM_APPOINTMENTS_H

#include "gough/model.h"

/* formulas of program, disturbance and external loads; halvings of the duration; pieces looked at beyond the present one */
enum {
    APPOINTMENT_FUNCTIONS = GOUGH_COMPONENTS + GOUGH_LEGS + 7 + 6 * GOUGH_EXTERNALS,
    APPOINTMENT_DEPTH = 48,
    APPOINTMENT_AHEAD = 16
};

typedef struct {
    const gough_motion *motion;           /* NULL: without the program */
    const gough_disturbance *disturbance; /* NULL: without the disturbance */
    const gough_machine *machine;         /* of whose external loads; NULL: of none */
    double duration, least, slack;        /* shortest piece; times that differ by less are one */
    double pace;                          /* the program's own time in a unit of time */

    /* what is watched: formulas that depend on t, or the six components of a record */
    const gough_formula *formula[APPOINTMENT_FUNCTIONS];
    int functions, recorded;
    int paced;                          /* the first so many are the program's, in its own time */
    double size[APPOINTMENT_FUNCTIONS]; /* largest V so far */
    double reached[APPOINTMENT_FUNCTIONS]; /* values at the end of the known pieces */

    double corner, before; /* the next one after `asked`, and the one before it if it was met */
    double asked;
    double clear, longest; /* fixed steps up to here, and no longer than that, need no look */

    /* ends of the pieces to the right of what is known, the next one last; each begins where the one before it ends */
    double pending[APPOINTMENT_DEPTH];
    int waiting, begun;
    struct {
        double from, to;
    } piece[APPOINTMENT_AHEAD]; /* known, in order of time */
    int known;
    double looked; /* where they end */
} appointments;

/* Starts at a time. `duration`: of the run, whose halvings the pieces are. `output_step`: pulses down to a hundredth of it wide are
 * met. Program, disturbance and machine must outlive it. */
void appointments_begin(appointments *a, const gough_motion *motion,
                        const gough_disturbance *disturbance, const gough_machine *machine,
                        double from, double duration, double output_step);

/* The next corner after t, or INFINITY. Times may be asked for in rising order only, as below. */
double appointments_corner(appointments *a, double t);

/* The longest step from t that is no longer than h, `share` times the length of each piece that it covers at most, and does
 * not pass the beginning of a shorter piece */
double appointments_step(appointments *a, double t, double h, double share);

/* Where the part of a fixed step ends that begins at t; `end` is the end of the whole step, whose length is h */
double appointments_part(appointments *a, double t, double end, double h);

/* Whether two runs of one program have the same appointments whatever their other numbers: their disturbances and external
 * loads are the same formulas, or do not depend on time */
bool appointments_same(const gough_disturbance *one, const gough_disturbance *two);
bool appointments_same_loads(const gough_machine *one, const gough_machine *two);

#endif
