/* What the steppers see of a machine in motion: rates of a state, and for RATTLE a body under a wrench. Text over the number
 * type. Theory: docs/theory/steppers.md. */
#ifndef GOUGH_SYSTEM_SYSTEM_H
#define GOUGH_SYSTEM_SYSTEM_H

#include "integrate/rattle.h"
#include "system/signals.h"

/* the rates of the state y from x and its rates v, whatever acts */
static inline void system_rates_whole(struct system *r, const wanted *s, const coordinates x,
                                      const coordinates v, const number *y, number *rate) {
    number u[LEGS], F[LEGS];
    drive_signals loop;
    coordinates a;
    legs g;

    legs_at(&r->h, &x, &g);
    if (r->traits & NEEDS_RATES) legs_rates(&r->h, &v, &g);
    signals_forces(r, s, &g, y, &loop, u);
    signals_legs(r, &g, u, F);
    a = signals_acceleration(r, s, &x, &v, &g, F);
    coordinates_store(&v, rate);
    coordinates_store(&a, rate + COORDINATES);
    for (int i = MOTION; i < r->states; i++) rate[i] = loop.beyond[i - MOTION];
}

/* force for each unit of a leg's rate, by control that is continuous and by friction */
static inline number system_damping(const struct system *r, int v) {
    return r->traits & SAMPLED ? r->h.dry[v].viscous : r->D[v] + r->h.dry[v].viscous;
}

/* The rate_function of a run: system_signals() without the rates of legs that only rows and limits need */
static inline void system_rates(void *context, real t, const number *y, number *rate) {
    struct system *r = context;
    const wanted *s = system_wanted(r, t);
    const coordinates x = coordinates_load(y), v = coordinates_load(y + COORDINATES);

    r->evaluations++;
    if (signals_plain(r)) {
        number F[LEGS];
        legs g;
        legs_at(&r->h, &x, &g);
        if (r->traits & NEEDS_RATES) legs_rates(&r->h, &v, &g);
        signals_plain_forces(r, s, &g, F);
        const coordinates a = signals_plain_acceleration(r, &x, &v, &g, F);
        coordinates_store(&v, rate);
        coordinates_store(&a, rate + COORDINATES);
        return;
    }
    system_rates_whole(r, s, x, v, y, rate);
}

/* The wrench_function of a run: forces with the legs at rest, and damping Σ D w wᵀ, where l̇ = w·(ρ̇, Ω), w = (n, arm × n) */
static inline void system_wrench(void *context, real t, const coordinates *x, number wrench[6],
                                 number damping[6][6]) {
    struct system *r = context;
    const wanted *s = system_wanted(r, t);
    vector F, L, pull = s->push, turn = s->turn;
    drive_signals loop;
    number u[LEGS];
    legs g;
    push p;

    r->evaluations++;
    legs_at(&r->h, x, &g);
    for (int v = 0; v < LEGS; v++) g.rate[v] = number_of(0);
    signals_forces(r, s, &g, NULL, &loop, u);
    p = legs_push(&r->h, &g, u);
    if (r->traits & MOVING_MASS) {
        const push weight = heavy_weight(&r->h, &g);
        p = push_sum(&p, &weight);
    }
    if (r->traits & EXTERNAL) known_load_wrench(&s->external, &x->q, &pull, &turn);
    F = along(add(p.F, pull), r->h.load.mass, r->h.gravity);
    L = add(push_moment(&p, &x->q), onto(&x->q, turn));
    vector_store(F, wrench);
    vector_store(L, wrench + 3);
    if (!(r->traits & LINEAR_IN_RATES)) return;

    for (int i = 0; i < 6; i++) {
        for (int j = 0; j < 6; j++) damping[i][j] = number_of(0);
    }
    for (int v = 0; v < LEGS; v++) {
        const number D = system_damping(r, v);
        number w[6];
        vector_store(g.n[v], w);
        vector_store(cross(r->h.arm[v], onto(&x->q, g.n[v])), w + 3);
        for (int i = 0; i < 6; i++) {
            for (int j = 0; j < 6; j++) damping[i][j] = damping[i][j] + D * w[i] * w[j];
        }
    }
}

#endif
