/* The checks of a control law, continuous or sampled, (law-1), (loop-1). */
#include <math.h>

#include "base/quantity.h"
#include "gough/dynamics.h"

/* a command that acts a hundred samples late controls nothing, and each sample that it waits for is remembered */
static const double MOST_PERIODS = 100;

#define FAIL(error, key, ...) gough_fail_key(error, GOUGH_ERROR_INPUT, key, __VA_ARGS__)

static bool not_negative(double x) { return x >= 0 && isfinite(x); }

/* ---- gains ---- */

static gough_status check_gains(const double diagonal[GOUGH_LEGS],
                                const double cross[GOUGH_LEGS][GOUGH_LEGS], bool coupled,
                                const char *key, gough_error *error) {
    for (int v = 0; v < GOUGH_LEGS; v++) {
        if (!coupled && !not_negative(diagonal[v]))
            return FAIL(error, key, "%s must be 0 or positive, not %g, in leg %d", key, diagonal[v],
                        v + 1);
        if (!isfinite(diagonal[v]))
            return FAIL(error, key, "%s is not finite in leg %d", key, v + 1);
        for (int w = 0; coupled && w < GOUGH_LEGS; w++) {
            if (!isfinite(cross[v][w]))
                return FAIL(error, key, "%s is not finite in row %d, column %d", key, v + 1, w + 1);
            if (v == w && fabs(cross[v][w]) > 0)
                return FAIL(error, key,
                            "%s has a diagonal twice: the matrix of the rest has %g in row and "
                            "column %d, which must be 0",
                            key, cross[v][w], v + 1);
        }
    }
    return GOUGH_OK;
}

static gough_status check_integral(const gough_control *c, gough_error *error) {
    static const char TRACKING[] = "control.tracking_time";
    bool any = false;

    for (int v = 0; v < GOUGH_LEGS; v++) {
        if (!not_negative(c->integral[v]))
            return FAIL(error, "control.integral",
                        "control.integral must be 0 or positive, not %g, in leg %d", c->integral[v],
                        v + 1);
        any = any || c->integral[v] > 0;
    }
    if (!not_negative(c->tracking_time))
        return FAIL(error, TRACKING, "%s must be positive and finite, not %g" IN_TIME, TRACKING,
                    c->tracking_time);
    if (any && c->tracking_time > 0 && c->tracking_time < c->sampling.period)
        return FAIL(error, TRACKING,
                    "%s, %g" IN_TIME ", must not be shorter than control.sampling.period, "
                    "%g" IN_TIME,
                    TRACKING, c->tracking_time, c->sampling.period);
    return GOUGH_OK;
}

/* ---- samples ---- */

/* when commands act */
static gough_status check_delays(const gough_sampling *s, gough_error *error) {
    static const char DELAY[] = "control.sampling.delay", JITTER[] = "control.sampling.jitter";

    if (!not_negative(s->delay))
        return FAIL(error, DELAY, "%s must be 0 or positive, not %g" IN_TIME, DELAY, s->delay);
    if (!(s->delay < MOST_PERIODS * s->period))
        return FAIL(error, DELAY,
                    "%s, %g" IN_TIME ", must be shorter than %g periods of %g" IN_TIME ", which "
                    "are %g" IN_TIME,
                    DELAY, s->delay, MOST_PERIODS, s->period, MOST_PERIODS * s->period);
    if (!not_negative(s->jitter))
        return FAIL(error, JITTER, "%s must be 0 or positive, not %g" IN_TIME, JITTER, s->jitter);
    if (s->jitter > s->period)
        return FAIL(error, JITTER,
                    "%s, %g" IN_TIME ", must not be longer than control.sampling.period, "
                    "%g" IN_TIME,
                    JITTER, s->jitter, s->period);
    return GOUGH_OK;
}

/* how rates are found */
static gough_status check_rates(const gough_sampling *s, gough_error *error) {
    static const char CUTOFF[] = "control.sampling.cutoff";
    const double half = 0.5 / s->period;

    if ((unsigned)s->velocity >= GOUGH_VELOCITIES)
        return FAIL(error, "control.sampling.velocity",
                    "%d is not a way to find the rates of the legs", (int)s->velocity);
    if (!not_negative(s->cutoff))
        return FAIL(error, CUTOFF, "%s must be positive and finite, not %g" IN_RATE, CUTOFF,
                    s->cutoff);
    if (s->cutoff > 0 && s->velocity != GOUGH_VELOCITY_DIFFERENCE)
        return FAIL(error, CUTOFF,
                    "%s is for rates from differences: set control.sampling.velocity to "
                    "difference, or leave the cutoff out",
                    CUTOFF);
    if (s->cutoff >= half)
        return FAIL(error, CUTOFF,
                    "%s, %g" IN_RATE ", is not below half the sampling rate, %g" IN_RATE
                    ": leave it out",
                    CUTOFF, s->cutoff, half);
    return GOUGH_OK;
}

static gough_status check_sampling(const gough_sampling *s, gough_error *error) {
    gough_status status = check_delays(s, error);

    if (status == GOUGH_OK) status = check_rates(s, error);
    if (status != GOUGH_OK) return status;
    if (!not_negative(s->resolution))
        return FAIL(error, "control.sampling.resolution",
                    "control.sampling.resolution must be 0 or positive, not %g" IN_LENGTH,
                    s->resolution);
    if (!not_negative(s->noise))
        return FAIL(error, "control.sampling.noise",
                    "control.sampling.noise must be 0 or positive, not %g" IN_LENGTH, s->noise);
    if (!not_negative(s->preview))
        return FAIL(error, "control.sampling.preview",
                    "control.sampling.preview must be 0 or positive, not %g" IN_TIME, s->preview);
    return GOUGH_OK;
}

gough_status gough_control_check(const gough_control *control, gough_error *error) {
    const gough_control *c = control;
    gough_status status =
        check_gains(c->stiffness, c->cross_stiffness, c->coupled, "control.stiffness", error);

    if (status == GOUGH_OK)
        status = check_gains(c->damping, c->cross_damping, c->coupled, "control.damping", error);
    if (status != GOUGH_OK) return status;
    if (!not_negative(c->sampling.period))
        return FAIL(error, "control.sampling.period",
                    "control.sampling.period must be positive and finite, not %g" IN_TIME,
                    c->sampling.period);
    status = check_integral(c, error);
    if (status == GOUGH_OK && c->sampling.period > 0) status = check_sampling(&c->sampling, error);
    return status;
}
