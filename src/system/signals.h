/* One instant of a machine in motion, filled in one order, each line from lines above it: wanted (of time alone), legs of the
 * pose, forces of the legs, accelerations. Text over the number type. Theory: docs/theory/control.md.
 *
 * While drives are ideal, the force of a drive is what the controller commands and what disturbs the leg, in one sum. The force in
 * the leg is what friction leaves of it. */
#ifndef GOUGH_SYSTEM_SIGNALS_H
#define GOUGH_SYSTEM_SIGNALS_H

#include "system/wanted.h"

/* drive forces: (law-1), with the disturbances of the legs */
KERNEL_INLINE void signals_forces(const struct system *r, const wanted *s, const legs *g,
                                  number u[LEGS]) {
    if (!(r->traits & NEEDS_RATES)) {
        for (int v = 0; v < LEGS; v++)
            u[v] = law_stiff(s->force[v], r->G[v], s->program.length[v], g->length[v]);
        return;
    }
    for (int v = 0; v < LEGS; v++) {
        u[v] = law_force(s->force[v], r->G[v], r->D[v], s->program.length[v], s->program.rate[v],
                         g->length[v], g->rate[v]);
    }
}

/* leg forces from drive forces u, (mass-13) */
static inline void signals_legs(const struct system *r, const legs *g, const number u[LEGS],
                                number F[LEGS]) {
    for (int v = 0; v < LEGS; v++) {
        F[v] = u[v];
        if (r->traits & FRICTION) F[v] = friction_leg(&r->h.dry[v], u[v], g->rate[v]);
    }
}

/* All of one instant: legs, forces and accelerations in a state. */
typedef struct {
    coordinates x, rate, acceleration;
    legs g;
    number force[LEGS]; /* of the drives */
    number leg[LEGS];   /* in the legs */
} signals;

/* what the legs and all else that acts do to the load in a state */
KERNEL_INLINE coordinates signals_acceleration(const struct system *r, const wanted *s,
                                               const coordinates *x, const coordinates *rate,
                                               const legs *g, const number F[LEGS]) {
    vector force = s->push, moment = s->turn;
    coordinates a;

    if (r->traits & EXTERNAL) known_load_wrench(&s->external, &x->q, &force, &moment);
    a = forward_dynamics(&r->h, x, rate, g, r->traits & MOVING_MASS, F,
                         r->loaded || r->traits & EXTERNAL ? &force : NULL, &moment);

    if (r->options->constraints == GOUGH_BAUMGARTE) {
        triad_stabilise(&r->h.load, &x->q, &rate->q, r->alpha, r->beta, &a.q);
    }
    return a;
}

/* Whether the drives' forces and the weight are all that acts, on legs without mass: then a shorter text serves, in which nothing
 * is passed to other functions, so that it stays in registers. */
static inline int signals_plain(const struct system *r) {
    return KERNEL_QUICK && !(r->traits & (MOVING_MASS | FRICTION | EXTERNAL)) && !r->loaded &&
           r->options->constraints != GOUGH_BAUMGARTE;
}

/* signals_acceleration() then */
KERNEL_INLINE coordinates signals_plain_acceleration(const struct system *r, const coordinates *x,
                                                     const coordinates *rate, const legs *g,
                                                     const number F[LEGS]) {
    const push p = legs_push(&r->h, g, F);

    return accelerations_under(&r->h, x, rate, &p, NULL, NULL);
}

static inline void system_signals(struct system *r, real t, const number *y, signals *m) {
    const wanted *s = system_wanted(r, t);

    r->evaluations++;
    if (signals_plain(r)) {
        const coordinates x = coordinates_load(y), rate = coordinates_load(y + COORDINATES);
        number F[LEGS];
        legs g;
        legs_at(&r->h, &x, &g);
        legs_rates(&r->h, &rate, &g);
        signals_forces(r, s, &g, F);
        m->acceleration = signals_plain_acceleration(r, &x, &rate, &g, F);
        m->x = x;
        m->rate = rate;
        m->g = g;
        for (int v = 0; v < LEGS; v++) m->force[v] = m->leg[v] = F[v];
        return;
    }
    m->x = coordinates_load(y);
    m->rate = coordinates_load(y + COORDINATES);
    legs_at(&r->h, &m->x, &m->g);
    legs_rates(&r->h, &m->rate, &m->g);
    signals_forces(r, s, &m->g, m->force);
    signals_legs(r, &m->g, m->force, m->leg);
    m->acceleration = signals_acceleration(r, s, &m->x, &m->rate, &m->g, m->leg);
}

#endif
