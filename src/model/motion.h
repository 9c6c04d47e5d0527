/* Checks of a program that a caller made by hand: what a study file cannot express. In a header, as two libraries need it. */
#ifndef GOUGH_MODEL_MOTION_H
#define GOUGH_MODEL_MOTION_H

#include <math.h>

#include "gough/model.h"

/* Whether the program can be evaluated: a kind of the enumeration with the moves or samples that belong to it, and finite factors.
 * Returns GOUGH_ERROR_INPUT with a sentence otherwise. */
static inline gough_status motion_check(const gough_motion *motion, gough_error *error) {
    const gough_samples *samples = &motion->samples;
    switch (motion->kind) {
    case GOUGH_MOTION_FORMULAS:
        if (!isfinite(motion->angle_unit))
            return gough_fail(error, GOUGH_ERROR_INPUT,
                              "motion: the unit of angles must be finite, not %g",
                              motion->angle_unit);
        break;
    case GOUGH_MOTION_MOVES:
        if (motion->moves > 0 && !motion->move)
            return gough_fail(error, GOUGH_ERROR_INPUT,
                              "motion: %zu moves are announced and none is given", motion->moves);
        break;
    case GOUGH_MOTION_SAMPLES:
        if (samples->count < 2 || !samples->time || !samples->value || !samples->curvature)
            return gough_fail(error, GOUGH_ERROR_INPUT,
                              "motion: recorded motion needs at least two rows, prepared by "
                              "gough_samples_prepare()");
        break;
    default:
        return gough_fail(
            error, GOUGH_ERROR_INPUT,
            "motion: %d is not a kind of motion; there are formulas, moves and samples",
            (int)motion->kind);
    }
    if (!isfinite(motion->about[0]) || !isfinite(motion->about[1]) || !isfinite(motion->about[2]))
        return gough_fail(error, GOUGH_ERROR_INPUT, "motion.about must be three finite numbers");
    if (!(motion->period >= 0) || !isfinite(motion->period))
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "motion.period must be 0 or greater and finite, not %g", motion->period);
    if (motion->scaled && !isfinite(motion->amplitude))
        return gough_fail(error, GOUGH_ERROR_INPUT, "motion.amplitude must be finite, not %g",
                          motion->amplitude);
    if (motion->scaled && !(motion->frequency > 0 && isfinite(motion->frequency)))
        return gough_fail(error, GOUGH_ERROR_INPUT,
                          "motion.frequency must be greater than 0 and finite, not %g",
                          motion->frequency);
    return GOUGH_OK;
}

#endif
