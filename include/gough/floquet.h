/** @file floquet.h
 *  Stability of the closed loop about a periodic program: its period, and Floquet multipliers. Theory: docs/theory/floquet.md.
 *  In libgough-analyse. The linear state ξ is that of gough/linear.h. An error argument may be NULL.
 *
 *  Accuracy: as each function says.
 *  Overlap: outputs must not overlap inputs.
 *  Threads: every function may be called from several threads at once, on distinct outputs, if LAPACK allows that, as usual
 *  builds do.
 */
#ifndef GOUGH_FLOQUET_H
#define GOUGH_FLOQUET_H

#include "gough/linear.h"

#ifdef __cplusplus
extern "C" {
#endif

/** The period of a program. */
typedef struct gough_period {
    bool resting; /**< the program comes to rest and has no period */
    double
        start; /**< time from which it is periodic within 1e-12: a start-up ramp has died out by then */
    double period; /**< T; 0 if the program comes to rest */
} gough_period;

/** The period of a motion: the one given with it, or the common period of all sines of ωt and bounded terms in its formulas,
 *  (floquet-2). It is verified on the program and both derivatives, (floquet-3), from the time when decaying exponentials and
 *  ramps have died out. A program that comes to rest, as moves do, is reported as resting. Recorded motion needs its period
 *  given; the last period of the record is used.
 *  @return GOUGH_OK; GOUGH_ERROR_INPUT: not periodic, or not with the period given; the sentence names the component and the
 *  difference, and suggests a remedy. Takes less than a millisecond. Allocates nothing. A period found is
 *  exact but for rounding; the start is where the program is periodic within 1e-12. */
GOUGH_API gough_status gough_motion_period(const gough_motion *motion, gough_period *period,
                                           gough_error *error);

/** The loop about a periodic motion. */
typedef struct gough_floquet {
    double start;  /**< time at which the chosen period begins */
    double period; /**< T */
    gough_state
        state; /**< at its beginning: the program's, or that of the periodic motion found, see gough_floquet_multipliers() */
    double beyond[GOUGH_LINEAR_MOST -
                  GOUGH_LINEAR]; /**< drives and integrals then, in the order of a deviation */
    size_t
        size; /**< how many numbers a deviation has and how many multipliers there are: gough_linear_size() */
    double monodromy
        [GOUGH_LINEAR_MOST]
        [GOUGH_LINEAR_MOST]; /**< size × size of it: a deviation after a period from the one before. ξ, then drives and
                                           integrals in the order of gough_linearise() */
    gough_multiplier multiplier[GOUGH_LINEAR_MOST]; /**< by falling magnitude */
    double growth;                                  /**< largest |μ|: growth per period */
    double determinant; /**< of the monodromy matrix; 0 if it is below the range of numbers */
    double
        determinant_defect; /**< |det − 1| if D = 0, else |det / exp ∫tr A − 1|, Liouville's formula. NaN if drives follow so
                                 quickly that their decay leaves no digits of it: −∫tr A over 3072 */
    double pair_defect;     /**< largest |μ μ' − 1| over reciprocal pairs if D = 0; else NaN */
    int drifting; /**< number of deviations that grow in proportion to time: multipliers 1 without an eigenvector of their own,
                       (floquet-9) */
    bool stable;  /**< no |μ| over 1 + 1e-7, and nothing drifts */
    size_t steps; /**< number of integration steps in the period */
} gough_floquet;

/** Computes the multipliers over one period of a loop with a continuous controller.
 *
 *  They are those of the program if the loop keeps it: gough_keeps_program(), and drives that give at once all that is asked of
 *  them. Otherwise they are those of the loop's own periodic motion, which is found first. In it drives lag and have limits of
 *  force and of its rate, and integrals add up, as in a run; while a drive is at a limit, its leg has no feedback.
 *
 *  @param period     from gough_motion_period(); NULL: it is found here
 *  @param tolerance  of the steps; 0: 1e-13, or 1e-10 of a loop with states (drives that lag, integrals)
 *  @return GOUGH_OK; GOUGH_ERROR_INPUT: not periodic, at rest (use gough_stability_at_rest()), or a tolerance outside
 *  1e-15 … 1e-3, or a sampled controller (use gough_floquet_sampled()); GOUGH_ERROR_NUMERICAL: the program passes a singular pose,
 *  over 20000 steps a period (100000 with states), or no motion of a loop off its program was found near it, (floquet-8);
 *  do not use @p floquet then. Dry friction and losses of screws are left out of the motion as of its deviations.
 *  It takes about 20 ms for a period with a few oscillations of the platform, some tenths of a second or more where the motion
 *  must be found, and seconds with drives that lag. Allocates nothing; needs 2 MB of stack. With the default tolerance
 *  multipliers are accurate to 1e-11 of the largest, of a loop with states to 1e-10; two that are equal, as on the unit circle
 *  without damping, only to the root of that. */
GOUGH_API gough_status gough_floquet_multipliers(const gough_model *model,
                                                 const gough_period *period, double tolerance,
                                                 gough_floquet *floquet, gough_error *error);

/** A loop with a sampled controller about its periodic motion, over the samples after which that motion repeats itself. */
typedef struct gough_sampled_floquet {
    double start;      /**< time of the sample at which the chosen period begins */
    double period;     /**< of the program */
    size_t periods;    /**< of the program in which the motion repeats itself, 1 … 16 */
    size_t samples;    /**< number of samples in these */
    double sampling;   /**< period of the controller that was used: periods · period / samples */
    bool adjusted;     /**< it is another than the model's, which does not fit the program */
    gough_state state; /**< of the periodic motion just before the first of them */
    size_t size;       /**< how many multipliers there are */
    size_t listed; /**< how many of them are in the list: up to GOUGH_SAMPLED, and none below 1e-9
                            of the largest, where rounding leaves no digit of them */
    gough_multiplier multiplier[GOUGH_SAMPLED]; /**< over all samples, by falling magnitude */
    double growth;                              /**< largest |μ|: growth in `periods` periods */
    bool stable;                                /**< no |μ| over 1 + 1e-7 */
    size_t steps;                               /**< number of integration steps in the samples */
} gough_sampled_floquet;

/** Computes the multipliers of a loop with a sampled controller about the periodic motion of the sampled loop, which differs from
 *  the program as held forces do from those that the program needs, (loop-10).
 *
 *  A motion that repeats itself needs a whole number of samples in q periods of the program, (loop-11). The least q up to 16
 *  for which the number of samples is whole within a billionth of it is taken. If no q up to 16 has a whole number of samples, the
 *  controller's period is changed: to that nearest to it of which one period of the program holds a whole number. Its delay and
 *  preview change in proportion; see `adjusted` and `sampling`.
 *
 *  @param period  from gough_motion_period(); NULL: it is found here
 *  @return GOUGH_OK; GOUGH_ERROR_INPUT: not periodic, at rest (use gough_sampled_at_rest()), a continuous controller, a period of
 *  the controller over two periods of the program, more than 20000 samples in those periods, or a delay of more than 12 periods of
 *  the controller; GOUGH_ERROR_NUMERICAL: the program passes a singular pose, or no periodic motion was found near it; do not use
 *  @p floquet then.
 *
 *  A loop that does not hold its program has such a motion too, and it is found where no deviation grows by more than about 1e12 in
 *  these periods, (loop-13).
 *
 *  Counts are taken for lengths; noise, jitter and dry friction are left out. A drive that is at a limit at a sample has no
 *  feedback from it. Takes about a tenth of a second for a hundred samples. Allocates nothing; needs 1 MB of stack. Multipliers are
 *  accurate to 1e-9 of the largest; several that are equal to the root of that according to their number. */
GOUGH_API gough_status gough_floquet_sampled(const gough_model *model, const gough_period *period,
                                             gough_sampled_floquet *floquet, gough_error *error);

#ifdef __cplusplus
}
#endif
#endif
