/* The checks of the drives of the legs, (act-1): numbers that can be, one kind and one order for all six. */
#include "drive/actuators_check.h"

#include <math.h>

#include "base/quantity.h"

#define FAIL(error, key, ...) gough_fail_key(error, GOUGH_ERROR_INPUT, key, __VA_ARGS__)

static const char TIME_CONSTANT[] = "actuators.time_constant", FREQUENCY[] = "actuators.frequency",
                  RATIO[] = "actuators.damping_ratio", RATE[] = "actuators.max_rate",
                  FORCE[] = "actuators.max_force", KIND[] = "actuators.kind";

static gough_status check_numbers(const gough_actuators *a, int v, gough_error *error) {
    const struct {
        double x;
        const char *key;
    } one[] = {{a->time_constant[v], TIME_CONSTANT},
               {a->frequency[v], FREQUENCY},
               {a->damping_ratio[v], RATIO},
               {a->max_rate[v], RATE}};
    const double *force = a->max_force[v];

    for (size_t i = 0; i < sizeof one / sizeof one[0]; i++)
        if (!(one[i].x >= 0 && isfinite(one[i].x)))
            return FAIL(error, one[i].key, "%s must be positive and finite, not %g, in leg %d",
                        one[i].key, one[i].x, v + 1);
    if (!isfinite(force[0]) || !isfinite(force[1]))
        return FAIL(error, FORCE, "%s is not finite in leg %d", FORCE, v + 1);
    if (!(force[0] < force[1]) && (fabs(force[0]) > 0 || fabs(force[1]) > 0))
        return FAIL(error, FORCE,
                    "the least of %s, %g" IN_FORCE ", must be below the greatest, %g" IN_FORCE
                    ", in leg %d",
                    FORCE, force[0], force[1], v + 1);
    return GOUGH_OK;
}

/* the first number that only a lag has; NULL: none */
static const char *lag_number(const gough_actuators *a, int v) {
    if (a->time_constant[v] > 0) return TIME_CONSTANT;
    if (a->frequency[v] > 0) return FREQUENCY;
    if (a->damping_ratio[v] > 0) return RATIO;
    return a->max_rate[v] > 0 ? RATE : NULL;
}

static gough_status check_lag(const gough_actuators *a, int v, gough_error *error) {
    const bool first = a->time_constant[v] > 0, second = a->frequency[v] > 0;

    if (first && (second || a->damping_ratio[v] > 0))
        return FAIL(error, second ? FREQUENCY : RATIO,
                    "the lag of leg %d has both a time_constant and a %s: give time_constant for "
                    "a lag of first order, or frequency and damping_ratio for one of second order",
                    v + 1, second ? "frequency" : "damping_ratio");
    if (second && !(a->damping_ratio[v] > 0))
        return FAIL(error, FREQUENCY,
                    "the lag of leg %d has a frequency but no damping_ratio: a lag of second "
                    "order needs both",
                    v + 1);
    if (!second && a->damping_ratio[v] > 0)
        return FAIL(error, RATIO,
                    "the lag of leg %d has a damping_ratio but no frequency: a lag of second "
                    "order needs both",
                    v + 1);
    if (!first && !second)
        return FAIL(error, KIND,
                    "the lag of leg %d has neither a time_constant nor a frequency and a "
                    "damping_ratio: give one of these",
                    v + 1);
    if (second && a->max_rate[v] > 0)
        return FAIL(error, RATE,
                    "actuators.max_rate limits lags of first order only: the lag of leg %d has a "
                    "frequency; leave max_rate out, or give a time_constant instead",
                    v + 1);
    if (second != (a->frequency[0] > 0))
        return FAIL(error, second ? FREQUENCY : TIME_CONSTANT,
                    "the lag of leg %d is of %s order, but that of leg 1 is of %s order: all six "
                    "must be of one order",
                    v + 1, second ? "second" : "first", second ? "first" : "second");
    return GOUGH_OK;
}

gough_status actuators_check(const gough_actuators *actuators, gough_error *error) {
    const gough_actuators *a = actuators;
    gough_status status = GOUGH_OK;

    if ((unsigned)a->kind >= GOUGH_ACTUATOR_KINDS)
        return FAIL(error, KIND, "%d is not a kind of drive", (int)a->kind);
    for (int v = 0; v < GOUGH_LEGS && status == GOUGH_OK; v++) {
        status = check_numbers(a, v, error);
        if (status != GOUGH_OK) return status;
        const char *const number = lag_number(a, v);
        if (a->kind == GOUGH_ACTUATOR_LAG)
            status = check_lag(a, v, error);
        else if (number)
            return FAIL(error, number,
                        "the drives are ideal, and %s is a number of a lag: set actuators.kind to "
                        "lag, or leave it out",
                        number);
    }
    return status;
}
