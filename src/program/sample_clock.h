/* When a sampled controller looks and when its commands act. Which comes first is decided by whole numbers, not by comparing times
 * that were rounded. Text over real. */
#ifndef GOUGH_PROGRAM_SAMPLE_CLOCK_H
#define GOUGH_PROGRAM_SAMPLE_CLOCK_H

#include "gough/model.h"
#include "gough/random.h"
#include "kernel/real.h"

/* Sample j is at (j · every) unit, and its command acts from (j · every + late) unit + rest on: unit is the period, or the fixed
 * step of a run of which period and delay are multiples. */
typedef struct {
    real unit, rest;
    long long every, late;
    long long sample, act; /* the next ones */
    double jitter;         /* a command acts up to that much later, at random */
    uint64_t seed, run;
} sample_clock;

/* draws of the random numbers of a study: those of noise on forces are below 2^62 */
static const uint64_t sample_noise_draws = (uint64_t)1 << 62,
                      sample_jitter_draws = (uint64_t)1 << 63;

/* shares of a period within which a delay counts as whole periods */
static const double sample_slack = 1e-9;

/* step: the fixed step, or 0 */
static inline void sample_clock_begin(sample_clock *c, const gough_sampling *s, double step,
                                      uint64_t run) {
    const double periods = s->delay / s->period, whole = floor(periods + sample_slack);
    const double rest = periods - whole;

    c->sample = c->act = 0;
    c->jitter = s->jitter;
    c->seed = s->seed;
    c->run = run;
    if (step > 0) {
        c->unit = step;
        c->every = llround(s->period / step);
        c->late = llround(s->delay / step);
        c->rest = 0;
        return;
    }
    c->unit = s->period;
    c->every = 1;
    c->late = (long long)whole;
    c->rest = rest > sample_slack ? (real)s->delay - (real)whole * c->unit : 0;
}

static inline real sample_clock_look(const sample_clock *c) {
    return (real)(c->sample * c->every) * c->unit;
}

static inline real sample_clock_act(const sample_clock *c) {
    const real t = (real)(c->act * c->every + c->late) * c->unit + c->rest;

    if (!(c->jitter > 0)) return t;
    return t + (real)c->jitter * (real)gough_random_uniform(c->seed, c->run,
                                                            sample_jitter_draws + (uint64_t)c->act);
}

/* whether the next sample comes before the next command acts, or with it */
static inline int sample_clock_looks(const sample_clock *c) {
    if (c->jitter > 0) return !(sample_clock_look(c) > sample_clock_act(c));
    return c->sample * c->every <= c->act * c->every + c->late;
}

/* the next of both */
static inline real sample_clock_next(const sample_clock *c) {
    return sample_clock_looks(c) ? sample_clock_look(c) : sample_clock_act(c);
}

#endif
