/* The search with a sampled controller: damping ratios of its poles s, with multipliers e^{sT} from sample to sample, the damping
 * for a ratio, and the stiffness from which the loop at home is no longer held. Theory: docs/theory/tuning.md. */
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

enum { WORK = 8 * SAMPLED_ROWS, MOST_STEPS = 100, GRID = 40 };

/* in the periods of a program that is followed: a look at more takes seconds */
enum { MOST_SAMPLES = 1000 };

/* of a root, relative */
static const double precision = 1e-12;

/* dampings tried one after the other differ by this factor, from such a part of √(GM) up to so many M/T, where no loop holds */
static const double factor = 1.2, first_part = 1e-3, last_part = 2;

/* a smaller multiplier is that of a deviation which is gone after a sample */
static const double gone = 1e-12;

/* the upper edge of a search by ratio, relative */
static const double edge_width = 1e-6;

/* no G holds above so many M/T² */
static const double greatest_part = 4;

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

static double ratio_at(samples *s, double damping) {
    for (int v = 0; v < GOUGH_LEGS; v++) s->control.damping[v] = damping;
    memset(s->control.cross_damping, 0, sizeof s->control.cross_damping);
    sampled_law_of(&s->control, &s->law);
    sampled_map_of(&s->plant, &s->step, &s->law, &s->map);
    return least_ratio(&s->map);
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

    if (samples_of(model, &s, NULL) != GOUGH_OK) return NAN;
    sampled_law_of(&s.control, &s.law);
    sampled_map_of(&s.plant, &s.step, &s.law, &s.map);
    return least_ratio(&s.map);
}

/* between two dampings of which the second one has the ratio and the first has not */
static double between(samples *s, double low, double high, double ratio) {
    double f_low = ratio_at(s, low) - ratio, f_high = ratio_at(s, high) - ratio;

    for (int i = 0; i < MOST_STEPS && high - low > precision * high && f_high > 0; i++) {
        double next = low + (high - low) * f_low / (f_low - f_high);
        if (!(next > low && next < high)) next = 0.5 * (low + high);
        const double f = ratio_at(s, next) - ratio;
        if (f < 0) {
            low = next, f_low = f;
            f_high *= 0.5; /* lest one end stay for ever */
        } else {
            high = next, f_high = f;
            f_low *= 0.5;
        }
    }
    return high;
}

/* the damping near `middle` with the greatest ratio, and that ratio */
static double peak(samples *s, double middle, double *ratio) {
    const double golden = 0.6180339887498949;
    double low = middle / factor, high = middle * factor;
    double a = high - golden * (high - low), b = low + golden * (high - low);
    double at_a = ratio_at(s, a), at_b = ratio_at(s, b);

    for (int i = 0; i < MOST_STEPS && high - low > 1e-7 * high; i++) {
        if (at_a >= at_b) {
            high = b, b = a, at_b = at_a;
            a = high - golden * (high - low);
            at_a = ratio_at(s, a);
        } else {
            low = a, a = b, at_a = at_b;
            b = low + golden * (high - low);
            at_b = ratio_at(s, b);
        }
    }
    *ratio = fmax(at_a, at_b);
    return at_a >= at_b ? a : b;
}

/* The least D that gives the ratio, which rises with D, and falls again as the delay turns damping into its opposite. NaN: none */
static double damping_of(samples *s, double ratio) {
    const double mass = s->plant.mass[0][0], period = s->control.sampling.period;
    double stiffness = 0, before = 0, best = 0, most = -INFINITY;

    for (int v = 0; v < GOUGH_LEGS; v++) stiffness = fmax(stiffness, s->control.stiffness[v]);
    for (double D = first_part * fmin(sqrt(stiffness * mass), mass / period);
         D < last_part * mass / period; D *= factor) {
        const double now = ratio_at(s, D);
        if (now >= ratio) return between(s, before, D, ratio);
        if (now > most) most = now, best = D;
        before = D;
    }
    if (!(best > 0)) return NAN;
    const double top = peak(s, best, &most);
    return most >= ratio ? between(s, best / factor, top, ratio) : (double)NAN;
}

gough_status tune_sampled_damping(const gough_model *model, double ratio, double *damping,
                                  gough_error *error) {
    samples s;
    const gough_status status = samples_of(model, &s, error);

    *damping = NAN;
    if (status != GOUGH_OK) return status;
    *damping = damping_of(&s, ratio);
    if (*damping > 0) return GOUGH_OK;
    return gough_fail(
        error, GOUGH_ERROR_NUMERICAL,
        "no damping gives the least damped mode at home the ratio %.9g with the "
        "stiffness %.9g" IN_STIFFNESS ": a controller with a period of %.9g" IN_TIME
        " and a delay of %.9g" IN_TIME " acts too late, or the stiffness does not hold the load",
        ratio, s.control.stiffness[0], s.control.sampling.period, s.control.sampling.delay);
}

/* ---- the window --------------------------------------------------------------------------------------------------- */

static bool has_ratio(samples *s, double stiffness, double ratio, double *damping) {
    for (int v = 0; v < GOUGH_LEGS; v++) s->control.stiffness[v] = stiffness;
    *damping = damping_of(s, ratio);
    return *damping > 0;
}

/* the greatest G with which some D gives the ratio; 0: none */
static double top_by_ratio(tune *t, samples *s, double *damping) {
    const double ratio = t->options->damping_ratio, period = s->control.sampling.period;
    const double most = greatest_part * s->plant.mass[0][0] / (period * period);
    const double least = fmax(t->tuning->threshold, 1e-9 * most);
    double high = most, low = 0, D;

    if (!(most > least)) return 0;
    for (int i = GRID; i > 0; i--) {
        low = least * pow(most / least, (i - 0.5) / GRID);
        if (has_ratio(s, low, ratio, damping)) break;
        high = low;
        low = 0;
    }
    while (low > 0 && high > low * (1 + edge_width)) {
        const double middle = sqrt(low * high);
        if (has_ratio(s, middle, ratio, &D))
            low = middle, *damping = D;
        else
            high = middle;
    }
    return low;
}

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
    const double top = top_by_ratio(t, &s, &damping);
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
