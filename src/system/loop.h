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
    int fresh;  /* there has been no sample yet */
    number fed; /* sum of the program forces of the last sample: not finite if one of them is not */
    number home[LEGS];              /* lengths at home, where counts have their origin */
    number queue[LOOP_QUEUE][LEGS]; /* what each sample asks for; a drive takes what it can */
} loop;

/* the legs in a state, with their rates */
static inline void loop_legs(const struct system *r, const number *y, legs *g) {
    const coordinates x = coordinates_load(y), v = coordinates_load(y + COORDINATES);

    legs_at(&r->h, &x, g);
    legs_rates(&r->h, &v, g);
}

/* what a controller finds at a sample: errors, their rates, lengths as measured */
static inline void loop_measure(struct system *r, const loop *l, const wanted *s, const legs *g,
                                number error[LEGS], number rate[LEGS], number speed[LEGS]) {
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
        r->measured[n] = sampler_length(&l->rule, g->length[n], l->home[n], draw);
        error[n] = s->program.length[n] - r->measured[n];
        rate[n] = s->program.rate[n] - g->rate[n];
        speed[n] = g->rate[n];
    }
}

/* the largest error found by each leg, for a summary of the run */
static inline void loop_note(const struct system *r, real t, const number error[LEGS]) {
    gough_summary *summary = r->options->summary;

    if (!summary || summary->brief_) return;
    for (int v = 0; v < LEGS; v++) {
        gough_leg_summary *leg = &summary->leg[v];
        const double size = (double)real_magnitude(number_lane(error[v], 0));
        if (size <= leg->sample_error || !real_finite(size)) continue;
        leg->sample_error = size;
        leg->sample_error_at = (double)t;
    }
}

/* what the caller's own law commands in place of ours, in each lane */
static inline void loop_ask(const struct system *r, const loop *l, real t, const wanted *s,
                            const number fed[LEGS], const number speed[LEGS], number asked[LEGS]) {
    const gough_simulation *o = r->options;

    for (int i = 0; o->law && i < NUMBER_WIDTH; i++) {
        gough_sample sample = {
            .number = (uint64_t)l->clock.sample, .run = r->lane[i].samples, .time = (double)t};
        double command[LEGS];
        for (int v = 0; v < LEGS; v++) {
            sample.length[v] = (double)number_lane(r->measured[v], i);
            sample.program_force[v] = (double)number_lane(fed[v], i);
            sample.program_length[v] = (double)number_lane(s->program.length[v], i);
            sample.program_rate[v] = (double)number_lane(s->program.rate[v], i);
            sample.rate[v] = (double)number_lane(speed[v], i);
            command[v] = (double)number_lane(asked[v], i);
        }
        o->law(o->law_context, &sample, command);
        for (int v = 0; v < LEGS; v++) number_put(&asked[v], i, command[v]);
    }
}

/* the sample that is due, at t with the legs of the state: its command goes into the queue */
static inline void loop_look(struct system *r, loop *l, real t, const legs *g) {
    const sampler_gains gains = {r->G, r->D, r->integral,
                                 r->traits & COUPLED ? &r->coupling : NULL};
    const real preview = r->lane[0].control->sampling.preview;
    number fed[LEGS], error[LEGS], rate[LEGS], speed[LEGS], u[LEGS], *asked;
    const wanted *s = system_wanted(r, r->feeds ? t + preview : t);

    l->fed = number_of(0);
    for (int v = 0; v < LEGS; v++) {
        fed[v] = s->force[v];
        l->fed = l->fed + fed[v];
    }
    s = system_wanted(r, t);
    loop_measure(r, l, s, g, error, rate, speed);
    loop_note(r, t, error);
    if (l->fresh) sampler_begin(&l->rule, error, rate, &l->memory);
    l->fresh = 0;
    asked = l->queue[l->clock.sample % LOOP_QUEUE];
    sampler_asks(&l->rule, &gains, fed, error, rate, &l->memory, asked);
    loop_ask(r, l, t, s, fed, speed, asked);

    for (int v = 0; v < LEGS; v++) u[v] = drive_takes(&r->drives[v], asked[v]);
    sampler_integrate(&l->rule, r->integral, asked, u, &l->memory);
    l->clock.sample++;
}

/* a sample's command begins to act */
static inline void loop_act(struct system *r, const number asked[LEGS]) {
    for (int v = 0; v < LEGS; v++) {
        r->held[v] = drive_takes(&r->drives[v], asked[v]);
        r->unmet[v] = asked[v] - r->held[v];
    }
}

/* what is due at t with the legs of the state: samples, and commands that begin to act */
static inline void loop_reach(struct system *r, loop *l, real t, const legs *g) {
    sample_clock *c = &l->clock;

    while (!(t < sample_clock_next(c))) {
        if (sample_clock_looks(c)) {
            loop_look(r, l, t, g);
        } else {
            loop_act(r, l->queue[c->act++ % LOOP_QUEUE]);
        }
    }
}

/* A controller that samples at other times from now on, or has not sampled before: it looks now, and what it commands acts at
 * once. */
static inline void loop_resume(struct system *r, loop *l, real t, const number *y) {
    const gough_sampling *s = &r->lane[0].control->sampling;
    const long long next = (long long)ceil((double)t / s->period - sample_slack);
    legs g;

    loop_legs(r, y, &g);
    sample_clock_begin(&l->clock, s, 0, r->lane[0].samples);
    for (int i = 0; i < NUMBER_WIDTH; i++) {
        sampler_put(&l->rule, i, r->lane[i].control);
        for (int v = 0; v < LEGS; v++)
            number_put(&l->home[v], i, r->lane[i].machine->home_length[v]);
    }
    l->fresh = 1;
    l->clock.sample = next > 0 ? next - 1 : 0;
    const number *asked = l->queue[l->clock.sample % LOOP_QUEUE];
    loop_look(r, l, t, &g);
    loop_act(r, asked);
    l->clock.sample = l->clock.act = next;
}

/* The loop at the beginning of a run, in whose state y pose and velocities are set: fills what lies beyond them, and l where the
 * controller is sampled. Before the first command acts it is in force already. */
static inline void loop_begin(struct system *r, loop *l, double step, number *y) {
    drive_signals m;
    legs g;

    loop_legs(r, y, &g);
    for (int i = MOTION; i < r->states; i++) y[i] = number_of(0);
    if (r->traits & SAMPLED) {
        const gough_sampling *s = &r->lane[0].control->sampling;
        sample_clock_begin(&l->clock, s, step, r->lane[0].samples);
        for (int i = 0; i < NUMBER_WIDTH; i++) {
            sampler_put(&l->rule, i, r->lane[i].control);
            for (int v = 0; v < LEGS; v++)
                number_put(&l->home[v], i, r->lane[i].machine->home_length[v]);
        }
        l->fresh = 1;
        loop_look(r, l, 0, &g);
        loop_act(r, l->queue[0]);
        loop_reach(r, l, 0, &g);
    }
    if (!(r->traits & LAGGING)) return;
    const wanted *s = system_wanted(r, 0);
    signals_loop(r, s, &g, y, &m);
    for (int n = 0; n < LEGS; n++) y[r->drive.at + n] = m.command[n];
}

#endif
