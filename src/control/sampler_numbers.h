/* A sampled controller as the equations see it. Text over the number type. */
#ifndef GOUGH_CONTROL_SAMPLER_NUMBERS_H
#define GOUGH_CONTROL_SAMPLER_NUMBERS_H

#include "control/sampler.h"
#include "gough/model.h"
#include "kernel/real.h"

/* one lane of what a controller does at a sample */
static inline void sampler_put(sampler *s, int lane, const gough_control *c) {
    const gough_sampling *p = &c->sampling;
    const real T = p->period, track = c->tracking_time;
    const real keep = p->cutoff > 0 ? real_exp(-2 * REAL_PI * (real)p->cutoff * T) : 0;

    s->differences = p->velocity == GOUGH_VELOCITY_DIFFERENCE;
    number_put(&s->keep, lane, keep);
    number_put(&s->renew, lane, (1 - keep) / T);
    number_put(&s->period, lane, T);
    number_put(&s->track, lane, track > 0 ? T / track : 0);
    number_put(&s->count, lane, p->resolution);
    number_put(&s->noise, lane, p->noise);
}

#endif
