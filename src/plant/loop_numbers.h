/* Drives and sampled controllers as the equations see them. Text over the number type. */
#ifndef GOUGH_PLANT_LOOP_NUMBERS_H
#define GOUGH_PLANT_LOOP_NUMBERS_H

#include "gough/model.h"
#include "kernel/real.h"
#include "kernel/sampler.h"

/* one lane of the drive of a leg, from 0 */
static inline void drive_put(leg_drive *d, int lane, const gough_actuators *a, int leg) {
    const real omega = 2 * REAL_PI * (real)a->frequency[leg];
    const int limited = a->max_force[leg][0] < a->max_force[leg][1];
    const int first = a->kind == GOUGH_ACTUATOR_LAG && a->time_constant[leg] > 0;
    const int slow = first && a->max_rate[leg] > 0;

    number_put(&d->least, lane, limited ? (real)a->max_force[leg][0] : -(real)INFINITY);
    number_put(&d->most, lane, limited ? (real)a->max_force[leg][1] : (real)INFINITY);
    number_put(&d->quickness, lane, first ? 1 / (real)a->time_constant[leg] : 0);
    number_put(&d->rate, lane, slow ? (real)a->max_rate[leg] : (real)INFINITY);
    number_put(&d->square, lane, omega * omega);
    number_put(&d->damping, lane, 2 * (real)a->damping_ratio[leg] * omega);
}

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
