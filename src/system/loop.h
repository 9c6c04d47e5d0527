/* A controller that is sampled: its memory, and the commands that wait until they act, (loop-1). Text over the number type. Theory:
 * docs/theory/loop.md. */
#ifndef GOUGH_SYSTEM_LOOP_H
#define GOUGH_SYSTEM_LOOP_H

#include "program/sample_clock.h"
#include "system/system.h"

/* commands that may wait: of a delay below 100 periods, and a jitter of one */
enum { LOOP_QUEUE = 102 };

typedef struct {
    sample_clock clock;
    sampler rule;
    sampler_memory memory;
    number home[LEGS]; /* lengths at home, where counts have their origin */
    number queue[LOOP_QUEUE][LEGS];
} loop;

/* (loop-1) of one lane */
static inline void loop_add_lane(loop *l, const system_lane *lane, int i) {
    const gough_sampling *s = &lane->control->sampling;
    const real T = s->period;
    const real keep = s->cutoff > 0 ? real_exp(-2 * REAL_PI * (real)s->cutoff * T) : 0;
    const real track = lane->control->tracking_time;

    number_put(&l->rule.keep, i, keep);
    number_put(&l->rule.renew, i, (1 - keep) / T);
    number_put(&l->rule.period, i, T);
    number_put(&l->rule.track, i, track > 0 ? T / track : 0);
    number_put(&l->rule.count, i, s->resolution);
    number_put(&l->rule.noise, i, s->noise);
    for (int v = 0; v < LEGS; v++) number_put(&l->home[v], i, lane->machine->home_length[v]);
}

/* what a controller finds at a sample: errors, their rates, lengths as measured */
static inline void loop_measure(struct system *r, const loop *l, const wanted *s, const number *y,
                                number error[LEGS], number rate[LEGS]) {
    const coordinates x = coordinates_load(y), v = coordinates_load(y + COORDINATES);
    legs g;

    legs_at(&r->h, &x, &g);
    legs_rates(&r->h, &v, &g);
    for (int n = 0; n < LEGS; n++) {
        const uint64_t number_of_draw =
            sample_noise_draws + (uint64_t)n + (uint64_t)LEGS * (uint64_t)l->clock.sample;
        number draw = number_of(0);
        for (int i = 0; i < NUMBER_WIDTH; i++) {
            const gough_sampling *p = &r->lane[i].control->sampling;
            if (p->noise > 0)
                number_put(&draw, i,
                           gough_random_normal(p->seed, r->lane[i].samples, number_of_draw));
        }
        r->measured[n] = sampler_length(&l->rule, g.length[n], l->home[n], draw);
        error[n] = s->program.length[n] - r->measured[n];
        rate[n] = s->program.rate[n] - g.rate[n];
    }
}

/* the sample that is due, at t in a state: its command goes into the queue */
static inline void loop_look(struct system *r, loop *l, real t, const number *y) {
    const real preview = r->lane[0].control->sampling.preview;
    number fed[LEGS], error[LEGS], rate[LEGS], asked[LEGS], *u;
    const wanted *s;

    if (preview > 0) {
        s = system_wanted(r, t + preview);
        for (int v = 0; v < LEGS; v++) fed[v] = s->force[v];
        s = system_wanted(r, t);
    } else {
        s = system_wanted(r, t);
        for (int v = 0; v < LEGS; v++) fed[v] = s->force[v];
    }
    loop_measure(r, l, s, y, error, rate);
    if (l->clock.sample == 0) sampler_begin(&l->rule, error, rate, &l->memory);
    sampler_rates(&l->rule, error, rate, &l->memory);

    u = l->queue[l->clock.sample % LOOP_QUEUE];
    for (int v = 0; v < LEGS; v++) {
        asked[v] = fed[v] + r->G[v] * error[v] + r->D[v] * rate[v] + l->memory.integral[v];
    }
    if (r->traits & COUPLED) law_couple(&r->coupling, error, rate, asked);
    for (int v = 0; v < LEGS; v++) {
        u[v] = drive_takes(&r->drives[v], asked[v]);
        r->unmet[v] = asked[v] - u[v];
    }
    sampler_integrate(&l->rule, r->integral, asked, u, &l->memory);
    l->clock.sample++;
}

/* what is due at t: samples, and commands that begin to act */
static inline void loop_reach(struct system *r, loop *l, real t, const number *y) {
    sample_clock *c = &l->clock;

    while (!(t < sample_clock_next(c))) {
        if (sample_clock_looks(c)) {
            loop_look(r, l, t, y);
        } else {
            const number *u = l->queue[c->act++ % LOOP_QUEUE];
            for (int v = 0; v < LEGS; v++) r->held[v] = u[v];
        }
    }
}

/* The loop at the beginning of a run, in whose state y pose and velocities are set: fills what lies beyond them, and l where the
 * controller is sampled. Before the first command acts it is in force already. */
static inline void loop_begin(struct system *r, loop *l, double step, number *y) {
    drive_signals m;

    for (int i = MOTION; i < r->states; i++) y[i] = number_of(0);
    if (r->traits & SAMPLED) {
        const gough_sampling *s = &r->lane[0].control->sampling;
        sample_clock_begin(&l->clock, s, step, r->lane[0].samples);
        l->rule.differences = s->velocity == GOUGH_VELOCITY_DIFFERENCE;
        for (int i = 0; i < NUMBER_WIDTH; i++) loop_add_lane(l, &r->lane[i], i);
        loop_look(r, l, 0, y);
        for (int v = 0; v < LEGS; v++) r->held[v] = l->queue[0][v];
        loop_reach(r, l, 0, y);
    }
    if (!(r->traits & LAGGING)) return;
    const wanted *s = system_wanted(r, 0);
    const coordinates x = coordinates_load(y), v = coordinates_load(y + COORDINATES);
    legs g;
    legs_at(&r->h, &x, &g);
    legs_rates(&r->h, &v, &g);
    signals_loop(r, s, &g, y, &m);
    for (int n = 0; n < LEGS; n++) y[r->drive.at + n] = m.command[n];
}

#endif
