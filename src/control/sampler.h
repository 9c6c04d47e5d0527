/* One sample of a controller: lengths measured, errors, their rates, the command. Text over the number type. Theory:
 * docs/theory/loop.md. */
#ifndef GOUGH_CONTROL_SAMPLER_H
#define GOUGH_CONTROL_SAMPLER_H

#include "control/law.h"
#include "drive/drive.h"

/* (loop-1): numbers of the controller that are the same in all legs */
typedef struct {
    int differences; /* rates are differences of errors */
    number keep;     /* α of the low pass, 0 without */
    number renew;    /* (1 − α)/T */
    number period;   /* T */
    number track;    /* T/T_t of legs with an integral, 0 without */
    number count;    /* q, 0 without */
    number noise;    /* σ */
} sampler;

/* what it remembers of a leg from one sample to the next */
typedef struct {
    number error[LEGS], rate[LEGS], integral[LEGS];
} sampler_memory;

/* the length measured; `home`: where counts have their origin, `draw`: a normal number */
static inline number sampler_length(const sampler *s, number length, number home, number draw) {
    const number off = length + s->noise * draw, none = number_of(0);
    const mask counts = number_greater(s->count, none);
    const number count = number_select(counts, s->count, number_of(1));
    const number whole = number_floor((off - home) / count + number_of(0.5));

    return number_select(counts, home + count * whole, off);
}

/* e_{−1} and ė_{−1}, as if the error had always changed at its first rate */
static inline void sampler_begin(const sampler *s, const number error[LEGS],
                                 const number rate[LEGS], sampler_memory *m) {
    for (int v = 0; v < LEGS; v++) {
        m->rate[v] = rate[v];
        m->error[v] = error[v] - s->period * rate[v];
        m->integral[v] = number_of(0);
    }
}

/* takes this sample's errors into the memory; `rate` is replaced where rates are differences */
static inline void sampler_rates(const sampler *s, const number error[LEGS], number rate[LEGS],
                                 sampler_memory *m) {
    for (int v = 0; v < LEGS; v++) {
        if (s->differences) rate[v] = s->keep * m->rate[v] + s->renew * (error[v] - m->error[v]);
        m->error[v] = error[v];
        m->rate[v] = rate[v];
    }
}

/* the gains of a law, for each leg; cross: outside the diagonals of G and D, or NULL */
typedef struct {
    const number *stiffness, *damping, *integral;
    const law_coupling *cross;
} sampler_gains;

/* what this sample asks of the drives: F^p in `fed`, with the errors of the lengths and, where they are measured, of their rates */
static inline void sampler_asks(const sampler *s, const sampler_gains *g, const number fed[LEGS],
                                const number error[LEGS], number rate[LEGS], sampler_memory *m,
                                number asked[LEGS]) {
    sampler_rates(s, error, rate, m);
    for (int v = 0; v < LEGS; v++) {
        asked[v] = fed[v] + g->stiffness[v] * error[v] + g->damping[v] * rate[v] + m->integral[v];
    }
    if (g->cross) law_couple(g->cross, error, rate, asked);
}

/* I of the next sample, `r` being what was asked of the drive and u what it takes */
static inline void sampler_integrate(const sampler *s, const number gain[LEGS],
                                     const number r[LEGS], const number u[LEGS],
                                     sampler_memory *m) {
    for (int v = 0; v < LEGS; v++) {
        const number none = number_of(0);
        const number track = number_select(number_greater(gain[v], none), s->track, none);
        m->integral[v] = m->integral[v] + gain[v] * s->period * m->error[v] + (u[v] - r[v]) * track;
    }
}

#endif
