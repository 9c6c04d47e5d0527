/* Whether deviations grow in the loop that simulate is to run, as computed from the study: at home, where the program ends, and
 * over a period of it. Theory: docs/theory/stability.md. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/scale.h"
#include "cli/common/talk.h"
#include "cli/run/growth.h"
#include "cli/run/run_report.h"

static const double TENFOLD = 2.302585092994045684; /* log 10 */

/* a deviation that does not grow by this factor within a run is not worth a remark */
static const double least_growth = 10;

static bool open_loop(const gough_control *control) {
    bool open = control->feedforward;
    for (int i = 0; i < GOUGH_LEGS; i++)
        open = open && !(control->stiffness[i] > 0) && !(control->damping[i] > 0);
    return open;
}

typedef struct loop {
    const char *verb, *name; /* "the open loop", "the closed loop" */
    const gough_study *study;
    gough_units units;
    const char *time; /* unit, as it follows a number */
    bool open;
} loop;

static const char *advice(const loop *l) {
    return l->open ? "it needs feedback (control.stiffness)" : "'gough stability' has the details";
}

/* From sample to sample, if the controller is sampled: what grows, and how fast. */
static bool grows_by_samples(const gough_model *model, const double *component, gough_rest *rest) {
    gough_sampled_rest *sampled = malloc(sizeof *sampled);
    bool grows = false;
    if (sampled && gough_sampled_at_rest(model, component, sampled, NULL) == GOUGH_OK) {
        grows = !sampled->stable;
        rest->growth = sampled->growth;
        rest->eigenvalue[0].mode = sampled->multiplier[0].mode;
    }
    free(sampled);
    return grows;
}

/* At rest in a pose; false if there is nothing to say. */
static bool grows_at_rest(const loop *l, const double *component, const char *where) {
    gough_rest *rest = malloc(sizeof *rest);
    bool told = false;
    if (rest && gough_stability_at_rest(l->study->model, component, rest, NULL) == GOUGH_OK &&
        (l->study->model->control.sampling.period > 0
             ? grows_by_samples(l->study->model, component, rest)
             : rest->growing > 0) &&
        rest->growth * l->study->simulation.duration > log(least_growth)) {
        remark(l->verb,
               "%s is unstable at rest %s: any deviation in %s, even from rounding, grows tenfold "
               "every %.3g%s; %s",
               l->name, where, rest->eigenvalue[0].mode.name,
               TENFOLD / rest->growth * gough_unit_factor(&l->units, GOUGH_UNIT_TIME), l->time,
               advice(l));
        told = true;
    }
    free(rest);
    return told;
}

/* Over a period of the program. Where the loop does not keep its program that would take longer than many a run. */
static bool grows_along(const loop *l, const gough_period *period) {
    const gough_model *model = l->study->model;
    const double periods = l->study->simulation.duration / period->period;
    gough_floquet *floquet = malloc(sizeof *floquet);
    bool told = false;
    if (floquet && gough_keeps_program(&model->machine, &model->control, true) &&
        gough_linear_size(model) == GOUGH_LINEAR && periods >= 1 &&
        gough_floquet_multipliers(model, period, 1e-9, floquet, NULL) == GOUGH_OK &&
        !floquet->stable && log(floquet->growth) * periods > log(least_growth)) {
        remark(l->verb,
               "%s is unstable along the program: any deviation in %s, even from rounding, grows "
               "%.3g-fold in each period of %.3g%s; %s",
               l->name, floquet->multiplier[0].mode.name, floquet->growth,
               period->period * gough_unit_factor(&l->units, GOUGH_UNIT_TIME), l->time, advice(l));
        told = true;
    }
    free(floquet);
    return told;
}

void remark_growth(const char *verb, const gough_study *study, const gough_units *units) {
    const gough_motion *motion = &study->model->motion;
    const bool open = open_loop(&study->model->control);
    const loop l = {verb,   open ? "the open loop" : "the closed loop", study,
                    *units, unit_word(units, GOUGH_UNIT_TIME),          open};
    gough_period period;
    if (grows_at_rest(&l, NULL, "at home")) return;
    if (gough_motion_period(motion, &period, NULL) != GOUGH_OK) return;
    if (!period.resting) {
        grows_along(&l, &period);
    } else if (period.start < study->simulation.duration) {
        double component[GOUGH_COMPONENTS][3], pose[GOUGH_COMPONENTS];
        gough_motion_evaluate(motion, period.start, component);
        for (int c = 0; c < GOUGH_COMPONENTS; c++) pose[c] = component[c][0];
        grows_at_rest(&l, pose, "where the program ends");
    }
}
