/* One instant of a machine in motion, filled in one order, each line from lines above it: wanted (of time alone), legs of the
 * pose, forces of the legs, accelerations. Text over the number type. Theory: docs/theory/control.md.
 *
 * While drives are ideal and the controller is continuous, the force of a drive is what the controller commands and what disturbs
 * the leg, in one sum; else a command is held, limited or followed late, and the disturbance comes after that. The force in the leg
 * is what friction leaves of it. */
#ifndef GOUGH_SYSTEM_SIGNALS_H
#define GOUGH_SYSTEM_SIGNALS_H

#include "system/wanted.h"

/* (law-1) of each leg, with what disturbs the legs where that is not told apart */
KERNEL_INLINE void signals_law(const struct system *r, const wanted *s, const legs *g,
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

/* what a continuous controller asks of the drives; y: the state, for its integrals */
static inline void signals_asked(const struct system *r, const wanted *s, const legs *g,
                                 const number *y, number asked[LEGS]) {
    signals_law(r, s, g, asked);
    if (r->traits & COUPLED) {
        number error[LEGS], rate[LEGS];
        for (int v = 0; v < LEGS; v++) {
            error[v] = s->program.length[v] - g->length[v];
            rate[v] = s->program.rate[v] - g->rate[v];
        }
        law_couple(&r->coupling, error, rate, asked);
    }
    for (int v = 0; v < r->sum.count; v++) asked[v] = asked[v] + y[r->sum.at + v];
}

/* From the controller to the drives of one instant: what is asked of them, the command that they take, their forces; rates of the
 * states beyond pose and velocities. */
typedef struct {
    number asked[LEGS], command[LEGS], force[LEGS];
    number beyond[STATE_SIZE - MOTION];
} drive_signals;

/* rates of a drive's force, and of the integral of its leg */
static inline void signals_beyond(const struct system *r, const wanted *s, const legs *g,
                                  const number *y, int v, drive_signals *m) {
    const number *f = y + r->drive.at, u = m->command[v];
    const leg_drive *d = &r->drives[v];

    if (r->traits & SECOND_ORDER) {
        m->beyond[v] = f[LEGS + v];
        m->beyond[LEGS + v] = drive_second(d, u, f[v], f[LEGS + v]);
    } else if (r->traits & LAGGING) {
        m->beyond[v] = drive_first(d, u, f[v]);
    }
    if (r->sum.count == 0) return;
    m->beyond[r->drive.count + v] =
        r->integral[v] * (s->program.length[v] - g->length[v]) + (u - m->asked[v]) * r->track[v];
}

/* y: the state; NULL where the parts have no states of their own, and their rates are not wanted */
KERNEL_APART void signals_loop(const struct system *r, const wanted *s, const legs *g,
                               const number *y, drive_signals *m) {
    if (r->traits & SAMPLED) {
        for (int v = 0; v < LEGS; v++) {
            m->command[v] = r->held[v];
            m->asked[v] = r->held[v] + r->unmet[v];
        }
    } else {
        signals_asked(r, s, g, y, m->asked);
        for (int v = 0; v < LEGS; v++) m->command[v] = drive_takes(&r->drives[v], m->asked[v]);
    }
    for (int v = 0; v < LEGS; v++) {
        m->force[v] = r->traits & LAGGING ? y[r->drive.at + v] : m->command[v];
        if (y) signals_beyond(r, s, g, y, v, m);
    }
}

/* drive forces with the disturbances of the legs, in a state; `m` is filled if LOOPED */
KERNEL_INLINE void signals_forces(const struct system *r, const wanted *s, const legs *g,
                                  const number *y, drive_signals *m, number force[LEGS]) {
    if (!(r->traits & LOOPED)) {
        signals_law(r, s, g, force);
        return;
    }
    signals_loop(r, s, g, y, m);
    for (int v = 0; v < LEGS; v++) {
        force[v] = r->traits & APART ? m->force[v] + s->shake[v] : m->force[v];
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
    number force[LEGS]; /* of the drives, disturbances of the legs included */
    number leg[LEGS];   /* in the legs */
    drive_signals loop; /* if LOOPED */
} signals;

/* rates of the whole state */
static inline void signals_rates(const struct system *r, const signals *m, number *rate) {
    coordinates_store(&m->rate, rate);
    coordinates_store(&m->acceleration, rate + COORDINATES);
    for (int i = MOTION; i < r->states; i++) rate[i] = m->loop.beyond[i - MOTION];
}

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

/* Whether ideal drives and the weight are all that acts, on legs without mass: then a shorter text serves, in which nothing is
 * passed to other functions, so that it stays in registers. Matrices of gains and limits of a sampled controller are in what it
 * holds. */
static inline int signals_plain(const struct system *r) {
    const int loop = r->traits & SAMPLED ? LAGGING : LOOPED;

    return KERNEL_QUICK && !(r->traits & (MOVING_MASS | FRICTION | EXTERNAL | loop)) &&
           !r->loaded && r->options->constraints != GOUGH_BAUMGARTE;
}

/* signals_forces() then: commands that are held, or (law-1) */
KERNEL_INLINE void signals_plain_forces(const struct system *r, const wanted *s, const legs *g,
                                        number F[LEGS]) {
    if (!(r->traits & SAMPLED)) {
        signals_law(r, s, g, F);
        return;
    }
    for (int v = 0; v < LEGS; v++) F[v] = r->held[v] + s->shake[v];
}

/* signals_acceleration() then */
KERNEL_INLINE coordinates signals_plain_acceleration(const struct system *r, const coordinates *x,
                                                     const coordinates *rate, const legs *g,
                                                     const number F[LEGS]) {
    const push p = legs_push(&r->h, g, F);

    return accelerations_under(&r->h, x, rate, &p, NULL, NULL);
}

/* all that follows from the legs of an instant, on a plain machine and on any */
KERNEL_INLINE void signals_plain_rest(const struct system *r, const wanted *s, const number *y,
                                      signals *m) {
    signals_plain_forces(r, s, &m->g, m->force);
    if (r->traits & SAMPLED) signals_loop(r, s, &m->g, y, &m->loop);
    for (int v = 0; v < LEGS; v++) m->leg[v] = m->force[v];
    m->acceleration = signals_plain_acceleration(r, &m->x, &m->rate, &m->g, m->leg);
}

static inline void signals_rest(const struct system *r, const wanted *s, const number *y,
                                signals *m) {
    signals_forces(r, s, &m->g, y, &m->loop, m->force);
    signals_legs(r, &m->g, m->force, m->leg);
    m->acceleration = signals_acceleration(r, s, &m->x, &m->rate, &m->g, m->leg);
}

static inline void system_signals(struct system *r, real t, const number *y, signals *m) {
    const wanted *s = system_wanted(r, t);

    r->evaluations++;
    m->x = coordinates_load(y);
    m->rate = coordinates_load(y + COORDINATES);
    legs_at(&r->h, &m->x, &m->g);
    legs_rates(&r->h, &m->rate, &m->g);
    if (signals_plain(r)) {
        signals_plain_rest(r, s, y, m);
    } else {
        signals_rest(r, s, y, m);
    }
}

/* the same on a plain machine but for its accelerations, at an instant from which other commands act */
static inline void system_signals_before(struct system *r, real t, const number *y, signals *m) {
    const wanted *s = system_wanted(r, t);

    m->x = coordinates_load(y);
    m->rate = coordinates_load(y + COORDINATES);
    legs_at(&r->h, &m->x, &m->g);
    legs_rates(&r->h, &m->rate, &m->g);
    signals_plain_forces(r, s, &m->g, m->force);
}

/* the same at the same instant, after a controller has given other commands */
static inline void system_signals_again(struct system *r, real t, const number *y, signals *m) {
    const wanted *s = system_wanted(r, t);

    r->evaluations++;
    if (signals_plain(r)) {
        signals_plain_rest(r, s, y, m);
    } else {
        signals_rest(r, s, y, m);
    }
}

#endif
