/* Checks of a program that a caller made by hand: what a study file cannot express. In a header, as two libraries need it. */
#ifndef GOUGH_PROGRAM_PROGRAM_VALID_H
#define GOUGH_PROGRAM_PROGRAM_VALID_H

#include <math.h>

#include "gough/model.h"

/* Whether a quaternion has a rotation, which one whose square is 0 or beyond the numbers has not, or is four zeros. */
static inline bool motion_axes_are_good(const double axes[4]) {
    double square = 0, sum = 0;
    for (int i = 0; i < 4; i++) {
        square += axes[i] * axes[i];
        sum += fabs(axes[i]);
    }
    return sum <= 0 || (square > 1e-200 && square < 1e200);
}

/* Whether the program can be evaluated: a kind of the enumeration with the moves or samples that belong to it, and finite factors.
 * Returns GOUGH_ERROR_INPUT with a sentence and the key otherwise. */
static inline gough_status motion_check(const gough_motion *motion, gough_error *error) {
    const gough_samples *samples = &motion->samples;
    switch (motion->kind) {
    case GOUGH_MOTION_FORMULAS:
        if (!isfinite(motion->angle_unit))
            return gough_fail_key(error, GOUGH_ERROR_INPUT, "motion",
                                  "motion: the unit of angles must be finite, not %g",
                                  motion->angle_unit);
        break;
    case GOUGH_MOTION_MOVES:
        if (motion->moves > 0 && !motion->move)
            return gough_fail_key(error, GOUGH_ERROR_INPUT, "motion.moves",
                                  "motion: %zu moves are announced and none is given",
                                  motion->moves);
        break;
    case GOUGH_MOTION_SAMPLES:
        if (samples->count < 2 || !samples->time || !samples->value || !samples->curvature)
            return gough_fail_key(error, GOUGH_ERROR_INPUT, "motion.samples",
                                  "motion: recorded motion needs at least two rows, prepared by "
                                  "gough_samples_prepare()");
        if (!motion_axes_are_good(samples->axes))
            return gough_fail_key(
                error, GOUGH_ERROR_INPUT, "motion.samples",
                "motion: the axes of recorded motion must be a quaternion of finite "
                "numbers, or four zeros");
        break;
    default:
        return gough_fail_key(
            error, GOUGH_ERROR_INPUT, "motion",
            "motion: %d is not a kind of motion; there are formulas, moves and samples",
            (int)motion->kind);
    }
    if (motion->order != GOUGH_ZYX && motion->order != GOUGH_XYZ)
        return gough_fail_key(error, GOUGH_ERROR_INPUT, "motion.order",
                              "motion.order: %d is not an order of angles; there are zyx and xyz",
                              (int)motion->order);
    if (!isfinite(motion->about[0]) || !isfinite(motion->about[1]) || !isfinite(motion->about[2]))
        return gough_fail_key(error, GOUGH_ERROR_INPUT, "motion.about",
                              "motion.about must be three finite numbers");
    if (!(motion->period >= 0) || !isfinite(motion->period))
        return gough_fail_key(error, GOUGH_ERROR_INPUT, "motion.period",
                              "motion.period must be 0 or greater and finite, not %g",
                              motion->period);
    if (motion->scaled && !isfinite(motion->amplitude))
        return gough_fail_key(error, GOUGH_ERROR_INPUT, "motion.amplitude",
                              "motion.amplitude must be finite, not %g", motion->amplitude);
    if (motion->scaled && !(motion->frequency > 0 && isfinite(motion->frequency)))
        return gough_fail_key(error, GOUGH_ERROR_INPUT, "motion.frequency",
                              "motion.frequency must be greater than 0 and finite, not %g",
                              motion->frequency);
    return GOUGH_OK;
}

#endif
