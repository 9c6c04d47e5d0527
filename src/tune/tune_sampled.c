/* The search with a sampled controller: damping ratios of its poles s, with multipliers e^{sT} from sample to sample, and the
 * stiffness from which the loop at home is no longer held. Theory: docs/theory/tuning.md. */
#include <lapacke.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/quantity.h"
#include "control/program_lack.h"
#include "floquet/loads.h"
#include "floquet/sampled_orbit.h"
#include "linear/sampled.h"
#include "tune/tune.h"

enum { WORK = 8 * SAMPLED_ROWS };

/* in the periods of a program that is followed: a look at more takes seconds; and at so few a tenth of one */
enum { MOST_SAMPLES = 1000, CHEAP_SAMPLES = 100 };

/* no loop holds with more damping than so many M/T, or more stiffness than so many M/T² */
static const double last_part = 2, greatest_part = 4;

/* a smaller multiplier is that of a deviation which is gone after a sample */
static const double gone = 1e-12;

/* a loop at rest but for its damping */
typedef struct {
    sampled_plant plant;
    sampled_step step;
    sampled_law law;
    sampled_map map;
    gough_control control;
} samples;

/* smallest −Re s/|s|; NaN if the multipliers cannot be computed */
static double least_ratio(sampled_map *map) {
    double re[SAMPLED_ROWS], im[SAMPLED_ROWS], work[WORK], none = 0, least = INFINITY;

    if (LAPACKE_dgeev_work(LAPACK_COL_MAJOR, 'N', 'N', map->n, map->matrix, map->n, re, im, &none,
                           1, &none, 1, work, WORK) != 0)
        return NAN;
    for (int k = 0; k < map->n; k++) {
        const double size = hypot(re[k], im[k]), decay = -log(size), turn = atan2(im[k], re[k]);
        if (!isfinite(size)) return NAN;
        if (size < gone) continue;
        const double pole = hypot(decay, turn);
        least = fmin(least, pole > 0 ? decay / pole : 0);
    }
    return least;
}

static double ratio_now(void *loop) {
    samples *s = loop;

    sampled_law_of(&s->control, &s->law);
    sampled_map_of(&s->plant, &s->step, &s->law, &s->map);
    return least_ratio(&s->map);
}

static tune_poles poles_of(samples *s) {
    const double mass = s->plant.mass[0][0], period = s->control.sampling.period;

    return (tune_poles){.ratio = ratio_now,
                        .loop = s,
                        .control = &s->control,
                        .mass = mass,
                        .most_damping = last_part * mass / period,
                        .most_stiffness = greatest_part * mass / (period * period)};
}

static gough_status samples_of(const gough_model *model, samples *s, gough_error *error) {
    gough_state state;
    const gough_status status = sampled_rest_of(model, NULL, &s->plant, &s->control, &state, error);

    if (status != GOUGH_OK) return status;
    if (!sampled_step_of(&s->plant, s->control.sampling.period, s->control.sampling.delay,
                         &s->step))
        return gough_fail_key(error, GOUGH_ERROR_NUMERICAL, "control.sampling.period",
                              "a deviation grows beyond all numbers within a period of %.9g" IN_TIME
                              "; use a shorter one",
                              s->control.sampling.period);
    return GOUGH_OK;
}

double tune_sampled_ratio(const gough_model *model) {
    samples s;

    return samples_of(model, &s, NULL) == GOUGH_OK ? ratio_now(&s) : (double)NAN;
}

gough_status tune_sampled_damping(const gough_model *model, double ratio, double *damping,
                                  gough_error *error) {
    samples s;
    const gough_status status = samples_of(model, &s, error);

    *damping = NAN;
    if (status != GOUGH_OK) return status;
    const tune_poles poles = poles_of(&s);
    *damping = tune_damping_at(&poles, ratio);
    if (*damping > 0) return GOUGH_OK;
    return gough_fail(
        error, GOUGH_ERROR_NUMERICAL,
        "no damping gives the least damped mode at home the ratio %.9g with the "
        "stiffness %.9g" IN_STIFFNESS ": a controller with a period of %.9g" IN_TIME
        " and a delay of %.9g" IN_TIME " acts too late, or the stiffness does not hold the load",
        ratio, s.control.stiffness[0], s.control.sampling.period, s.control.sampling.delay);
}

/* ---- the window --------------------------------------------------------------------------------------------------- */

/* the mode with the least ratio of the loop as it is */
static void name_least_damped(tune *t, double stiffness, double damping) {
    gough_tuning *tuning = t->tuning;
    gough_sampled_rest rest;
    gough_error none;
    double least = INFINITY;

    for (int v = 0; v < GOUGH_LEGS; v++) {
        t->steady->control.stiffness[v] = stiffness;
        t->steady->control.damping[v] = damping;
    }
    if (gough_sampled_at_rest(t->steady, NULL, &rest, &none) != GOUGH_OK) return;
    for (size_t k = 0; k < rest.listed; k++) {
        const double *mu = rest.multiplier[k].value, size = hypot(mu[0], mu[1]);
        const double decay = -log(size), turn = fabs(atan2(mu[1], mu[0]));
        const double ratio = decay / hypot(decay, turn);
        if (size < gone || !(ratio < least)) continue;
        least = ratio;
        tuning->upper_frequency = turn / rest.period;
        tuning->upper_mode = rest.multiplier[k].mode;
    }
}

static gough_status window_by_ratio(tune *t, gough_error *error) {
    double damping = NAN;
    samples s;
    const gough_status status = samples_of(t->steady, &s, error);

    if (status != GOUGH_OK) return status;
    const tune_poles poles = poles_of(&s);
    const double top =
        tune_top_by_ratio(&poles, t->tuning->threshold, t->options->damping_ratio, &damping);
    if (!(top > 0)) return GOUGH_OK;
    t->tuning->upper = top;
    name_least_damped(t, top, damping);
    return GOUGH_OK;
}

static gough_status window_by_damping(tune *t, gough_error *error) {
    gough_sampled_margins *m = &t->margins;
    gough_status status;

    for (int v = 0; v < GOUGH_LEGS; v++) {
        t->steady->control.stiffness[v] = t->unit;
        t->steady->control.damping[v] = t->model->control.damping[v];
    }
    status = gough_sampled_margins_at_rest(t->steady, NULL, m, error);
    if (status != GOUGH_OK || t->ratio || !m->open) return status;
    t->tuning->upper = m->upper.stiffness;
    t->tuning->upper_frequency = m->upper.frequency;
    t->tuning->upper_mode = m->upper.mode;
    return GOUGH_OK;
}

gough_status tune_find_window(tune *t, gough_error *error) {
    gough_status status = GOUGH_OK;

    t->tuning->upper = NAN;
    t->tuning->upper_frequency = NAN;
    t->tuning->sampled = t->sampled;
    t->tuning->states = t->states;
    if (t->states) return tune_states_window(t, error);
    if (!t->sampled) return GOUGH_OK;
    control_knows_all(&t->steady->control);
    if (t->ratio) status = window_by_ratio(t, error);
    /* and what could be, where no G holds */
    if (status == GOUGH_OK && !(t->tuning->upper > 0)) status = window_by_damping(t, error);
    return status;
}

/* ---- the program ---------------------------------------------------------------------------------------------------- */

/* The program's period under a sampled controller. The program is followed if the samples after which the loop repeats itself are
 * few enough, since each look takes all of them some times. */
gough_status tune_follow_samples(tune *t, gough_error *error) {
    gough_sampling sampling = t->model->control.sampling;
    gough_tuning *tuning = t->tuning;
    size_t count = 0, periods = 0;
    gough_status status = gough_motion_period(&t->model->motion, &t->period, NULL);
    const bool known = status == GOUGH_OK, resting = known && t->period.resting;

    if (known && !resting) (void)sampled_fit(&sampling, t->period.period, &count, &periods);
    tuning->periodic = known && !resting && count <= MOST_SAMPLES;
    t->cheap = tuning->periodic && count <= CHEAP_SAMPLES;
    if (tuning->periodic) return loads_check(&t->model->machine, &t->period, error);
    if (count > 0)
        snprintf(
            tuning->unchecked, sizeof tuning->unchecked,
            "%zu period%s of the program %s %zu samples, and only up to %d are followed, so home "
            "was checked, from sample to sample",
            periods, periods == 1 ? "" : "s", periods == 1 ? "has" : "have", count,
            (int)MOST_SAMPLES);
    else
        snprintf(tuning->unchecked, sizeof tuning->unchecked,
                 "the program %s, so home was checked, from sample to sample",
                 resting ? "comes to rest" : "has no period");
    t->period = (gough_period){.resting = true};
    memset(&t->steady->motion, 0, sizeof t->steady->motion);
    return GOUGH_OK;
}
