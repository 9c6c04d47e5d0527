/* Legs with mass: what the top gives them, and the accelerations of load and legs together, (mass-4), (mass-5), (mass-9),
 * (mass-10). Text over the number type. Theory: docs/theory/leg-mass.md. */
#ifndef GOUGH_PLANT_HEAVY_LEGS_H
#define GOUGH_PLANT_HEAVY_LEGS_H

#include "kernel/top.h"

/* f of leg v, base axes: the force that the top gives the leg besides the leg force */
static inline vector heavy_leg(const hexapod *h, const legs *g, int v, const coordinates *rate,
                               const coordinates *acceleration) {
    const leg_motion m = leg_motion_of(&h->mass[v], h->gravity, g->length[v], g->n[v],
                                       joint_of(h, rate, v), g->rate[v]);

    return leg_inertia(&m, g->n[v], joint_of(h, acceleration, v));
}

/* all of them */
static inline push heavy_legs(const hexapod *h, const legs *g, const coordinates *rate,
                              const coordinates *acceleration) {
    push p = push_none();

    for (int v = 0; v < LEGS; v++) push_add(&p, h, v, heavy_leg(h, g, v, rate, acceleration));
    return p;
}

/* what their weight does to the load while they do not move */
static inline push heavy_weight(const hexapod *h, const legs *g) {
    const vector none = {number_of(0), number_of(0), number_of(0)};
    const coordinates still = {none, {none, none, none}};
    push p = push_none();

    for (int v = 0; v < LEGS; v++) {
        push_add(&p, h, v, scale(number_of(-1), heavy_leg(h, g, v, &still, &still)));
    }
    return p;
}

/* (mass-5): what the legs do to the load with the leg forces F, less what it gives them */
static inline push heavy_push(const hexapod *h, const legs *g, const coordinates *rate,
                              const coordinates *acceleration, const number F[LEGS]) {
    push p = push_none();

    for (int v = 0; v < LEGS; v++) {
        const vector f = heavy_leg(h, g, v, rate, acceleration);
        push_add(&p, h, v, subtract(scale(F[v], g->n[v]), f));
    }
    return p;
}

/* A symmetric 6×6 matrix of force and moment, of which the lower triangle is kept, and a right-hand side */
typedef struct {
    number A[6][6], h[6];
} heavy_equations;

/* what τ [1, −x̂; x̂, −x̂²] of all legs is made of: Στ, Στx and the products Στxx …, Στxy … */
typedef struct {
    number sum;
    vector first, square, product;
} heavy_sums;

/* adds τ [1, −x̂; x̂, −x̂²] of all legs */
static inline void heavy_across(heavy_equations *e, const heavy_sums *s) {
    const vector first = s->first, square = s->square, product = s->product;

    for (int i = 0; i < 3; i++) e->A[i][i] = e->A[i][i] + s->sum;

    e->A[3][1] = e->A[3][1] - first.z;
    e->A[3][2] = e->A[3][2] + first.y;
    e->A[4][0] = e->A[4][0] + first.z;
    e->A[4][2] = e->A[4][2] - first.x;
    e->A[5][0] = e->A[5][0] - first.y;
    e->A[5][1] = e->A[5][1] + first.x;

    e->A[3][3] = e->A[3][3] + (square.y + square.z);
    e->A[4][4] = e->A[4][4] + (square.z + square.x);
    e->A[5][5] = e->A[5][5] + (square.x + square.y);
    e->A[4][3] = e->A[4][3] - product.x; /* xy */
    e->A[5][4] = e->A[5][4] - product.y; /* yz */
    e->A[5][3] = e->A[5][3] - product.z; /* zx */
}

/* adds (μ − τ) y yᵀ with y = (n, x × n) */
static inline void heavy_along(heavy_equations *e, number more, vector n, vector turn) {
    const number y[6] = {n.x, n.y, n.z, turn.x, turn.y, turn.z};

    for (int c = 0; c < 6; c++) {
        const number scaled = more * y[c];
        for (int r = c; r < 6; r++) e->A[r][c] = e->A[r][c] + scaled * y[r];
    }
}

/* adds a leg, all of it but what heavy_across() adds for all */
static inline void heavy_add(heavy_equations *e, heavy_sums *s, vector arm, vector n, number across,
                             number more) {
    const vector weighed = scale(across, arm);

    s->sum = s->sum + across;
    s->first = add(s->first, weighed);
    s->square = add(s->square, (vector){weighed.x * arm.x, weighed.y * arm.y, weighed.z * arm.z});
    s->product = add(s->product, (vector){weighed.x * arm.y, weighed.y * arm.z, weighed.z * arm.x});
    heavy_along(e, more, n, cross(arm, n));
}

/* the load alone */
static inline heavy_equations heavy_load(const body *b) {
    const number zero = number_of(0);
    const number own[6] = {b->mass, b->mass, b->mass, b->Iy + b->Iz, b->Iz + b->Ix, b->Ix + b->Iy};
    heavy_equations e;

    for (int r = 0; r < 6; r++) {
        for (int c = 0; c < 6; c++) e.A[r][c] = zero;
        e.A[r][r] = own[r];
        e.h[r] = zero;
    }
    return e;
}

/* A of (mass-9) alone, central axes; n: directions of the legs along them */
static inline heavy_equations heavy_inertia(const hexapod *h, const legs *g, const vector n[LEGS]) {
    const number zero = number_of(0);
    const vector none = {zero, zero, zero};
    heavy_sums sums = {zero, none, none, none};
    heavy_equations e = heavy_load(&h->load);

    for (int v = 0; v < LEGS; v++) {
        const leg_resistance k =
            leg_resistance_of(&h->mass[v], g->length[v], number_of(1) / g->length[v]);
        heavy_add(&e, &sums, h->arm[v], n[v], k.across, k.more);
    }
    heavy_across(&e, &sums);
    return e;
}

/* a vector times a symmetric matrix given by its diagonal and its products xy, yz, zx */
static inline vector symmetric_times(vector diagonal, vector product, vector x) {
    return (vector){diagonal.x * x.x + product.x * x.y + product.z * x.z,
                    product.x * x.x + diagonal.y * x.y + product.y * x.z,
                    product.z * x.x + product.y * x.y + diagonal.z * x.z};
}

/* central axes: how the load moves */
typedef struct {
    vector velocity, omega, gravity;
    vector same, mixed; /* G: ė·ė of each axis; ė·ė of i and j, j and k, k and i */
} heavy_central;

static inline heavy_central heavy_central_of(const hexapod *h, const coordinates *x,
                                             const coordinates *rate) {
    const triad *q = &x->q, *d = &rate->q;

    return (heavy_central){
        .velocity = onto(q, rate->rho),
        .omega = {dot(d->j, q->k), dot(d->k, q->i), dot(d->i, q->j)},
        .gravity = onto(q, h->gravity),
        .same = {dot(d->i, d->i), dot(d->j, d->j), dot(d->k, d->k)},
        .mixed = {dot(d->i, d->j), dot(d->j, d->k), dot(d->k, d->i)},
    };
}

/* (mass-9): load and legs under leg forces F; central axes */
static inline heavy_equations heavy_equations_of(const hexapod *h, const coordinates *x,
                                                 const heavy_central *c, const legs *g,
                                                 const number F[LEGS]) {
    const number zero = number_of(0);
    const vector none = {zero, zero, zero};
    vector force = none, moment = none;
    heavy_sums sums = {zero, none, none, none};
    heavy_equations e = heavy_load(&h->load);

    for (int v = 0; v < LEGS; v++) {
        const vector arm = h->arm[v], n = onto(&x->q, g->n[v]);
        const vector speed = add(c->velocity, cross(c->omega, arm));
        const leg_motion m =
            leg_motion_of(&h->mass[v], c->gravity, g->length[v], n, speed, g->rate[v]);
        const vector inward = scale(number_of(-1), symmetric_times(c->same, c->mixed, arm));
        const vector f = along(leg_inertia(&m, n, inward), -F[v], n);

        force = add(force, f);
        moment = add(moment, cross(arm, f));
        heavy_add(&e, &sums, arm, n, m.across, m.more);
    }
    heavy_across(&e, &sums);

    const vector pull = subtract(scale(h->load.mass, c->gravity), force);
    const vector gyration = {(h->load.Iz - h->load.Iy) * c->mixed.y,
                             (h->load.Ix - h->load.Iz) * c->mixed.z,
                             (h->load.Iy - h->load.Ix) * c->mixed.x};
    const vector turn = scale(number_of(-1), add(gyration, moment));
    const number right[6] = {pull.x, pull.y, pull.z, turn.x, turn.y, turn.z};
    for (int r = 0; r < 6; r++) e.h[r] = right[r];
    return e;
}

/* (mass-10): accelerations under leg forces F; force (at the centre of mass) and moment: what else acts on the load, base axes,
 * or NULL. g: with rates */
static inline coordinates heavy_accelerations(const hexapod *h, const coordinates *x,
                                              const coordinates *rate, const legs *g,
                                              const number F[LEGS], const vector *force,
                                              const vector *moment) {
    const heavy_central c = heavy_central_of(h, x, rate);
    heavy_equations e = heavy_equations_of(h, x, &c, g, F);

    if (force) {
        const vector f = onto(&x->q, *force), m = onto(&x->q, *moment);
        const number more[6] = {f.x, f.y, f.z, m.x, m.y, m.z};
        for (int r = 0; r < 6; r++) e.h[r] = e.h[r] + more[r];
    }
    solve_definite(e.A, e.h);

    const number *alpha = e.h + 3;
    const triad_bends t = {alpha[2] - c.mixed.x,  -alpha[1] - c.mixed.z, alpha[0] - c.mixed.y,
                           -alpha[2] - c.mixed.x, alpha[1] - c.mixed.z,  -alpha[0] - c.mixed.y};
    return (coordinates){out_of(&x->q, (vector){e.h[0], e.h[1], e.h[2]}),
                         triad_bent(&x->q, &rate->q, &t)};
}

#endif
