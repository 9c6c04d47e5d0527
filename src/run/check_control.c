/* Whether the times of a sampled controller go with the steps of a run. */
#include <math.h>

#include "base/quantity.h"
#include "gough/dynamics.h"
#include "run/run.h"

/* steps that are tried to either side of the one given, as parts of the period */
enum { TRIED = 10000 };

/* more samples than this, or more steps between two of them, are a mistake, and their numbers are whole numbers of 64 bits */
static const double MOST = 1e12;

static bool divides(double step, double time) {
    const double ratio = time / step;
    return fabs(ratio - round(ratio)) <= division_slack * fmax(ratio, 1);
}

/* The nearest step that divides the period, the delay and the time between rows: a whole part of the period. 0: none found. */
static double nearest_step(const gough_sampling *s, const gough_simulation *simulation) {
    const double parts = fmax(1, round(s->period / simulation->step));
    double found = 0;

    for (int i = 0; i < TRIED; i++) {
        for (int side = -1; side <= 1; side += 2) {
            const double step = s->period / (parts + side * i);
            if (!(step > 0 && isfinite(step)) || !divides(step, s->delay) ||
                !divides(step, simulation->output_step) ||
                step > simulation->output_step * (1 + division_slack))
                continue;
            if (!(found > 0) || fabs(step - simulation->step) < fabs(found - simulation->step))
                found = step;
        }
        if (found > 0) break;
    }
    return found;
}

static gough_status check_step(const gough_sampling *s, const gough_simulation *simulation,
                               gough_error *error) {
    static const char STEP[] = "simulation.step";
    const bool period = !divides(simulation->step, s->period) ||
                        simulation->step > s->period * (1 + division_slack);

    if (!period && divides(simulation->step, s->delay)) return GOUGH_OK;
    const char *const key = period ? "control.sampling.period" : "control.sampling.delay";
    const double time = period ? s->period : s->delay;
    const double nearest = nearest_step(s, simulation);
    if (nearest > 0)
        return gough_fail_key(error, GOUGH_ERROR_INPUT, STEP,
                              "%s %.9g" IN_TIME " does not divide %s %.9g" IN_TIME
                              "; the nearest that divides "
                              "the sampling period, its delay and simulation.output_step is "
                              "%.15g" IN_TIME,
                              STEP, simulation->step, key, time, nearest);
    return gough_fail_key(error, GOUGH_ERROR_INPUT, STEP,
                          "%s %.9g" IN_TIME " does not divide %s %.9g" IN_TIME
                          ", nor does any step near it divide the sampling period, its delay and "
                          "simulation.output_step: leave the step out, so that it adapts",
                          STEP, simulation->step, key, time);
}

gough_status simulate_check_control(const gough_control *control,
                                    const gough_simulation *simulation, gough_error *error) {
    const gough_sampling *s = &control->sampling;
    const gough_status status = gough_control_check(control, error);

    if (status == GOUGH_OK && simulation->law && !(s->period > 0))
        return gough_fail_key(error, GOUGH_ERROR_INPUT, "control.sampling.period",
                              "a control law of the caller's is called at the samples of a sampled "
                              "controller, and this one is continuous; give a "
                              "control.sampling.period greater than 0");
    if (status != GOUGH_OK || !(s->period > 0)) return status;
    if (!(simulation->duration / s->period <= MOST))
        return gough_fail_key(error, GOUGH_ERROR_INPUT, "control.sampling.period",
                              "control.sampling.period %.9g" IN_TIME
                              " gives more than 1e12 samples in a run of %.9g" IN_TIME
                              "; choose a longer one",
                              s->period, simulation->duration);
    if (!(simulation->step > 0)) return status;
    if (!(fmax(s->period, s->delay) / simulation->step <= MOST))
        return gough_fail_key(error, GOUGH_ERROR_INPUT, "control.sampling.period",
                              "control.sampling.period %.9g" IN_TIME
                              " or its delay has more than 1e12 steps of %.9g" IN_TIME
                              "; choose a shorter one",
                              s->period, simulation->step);
    if (s->jitter > 0)
        return gough_fail_key(error, GOUGH_ERROR_INPUT, "control.sampling.jitter",
                              "control.sampling.jitter needs steps that adapt: leave "
                              "simulation.step out, with the method dop853, or the jitter");
    return check_step(s, simulation, error);
}
