/* RATTLE where legs have mass, (mass-11). The kinetic energy of load and legs has constant coefficients in the coordinates of the
 * load, the directions of the legs and their lengths; RATTLE in these, with the constraints that tie the legs to the load solved,
 * leaves six equations for the six numbers of a step. Velocities enter through differences of positions over the step only, so that
 * no Coriolis term is seen. Theory: docs/theory/leg-mass.md. */
#ifndef GOUGH_INTEGRATE_RATTLE_LEGS_H
#define GOUGH_INTEGRATE_RATTLE_LEGS_H

#include "integrate/rattle_state.h"
#include "plant/heavy_legs.h"
#include "plant/state.h"

/* sweeps of the simplified Newton method at most: three to seven are usual in double, twice as many in quadruple */
enum { RATTLE_LEGS_SWEEPS = 4 * NUMBER_NEWTON };

/* the legs of a pose, and the matrix of (mass-9) there; central axes */
typedef struct {
    legs g;
    vector n[LEGS];
    number A[6][6];
} rattle_legs_pose;

static inline void rattle_legs_at(const rattle *r, const coordinates *x, rattle_legs_pose *p) {
    legs_at(r->legs, x, &p->g);
    for (int v = 0; v < LEGS; v++) p->n[v] = onto(&x->q, p->g.n[v]);

    const heavy_equations e = heavy_inertia(r->legs, &p->g, p->n);
    for (int row = 0; row < 6; row++) {
        for (int c = 0; c < 6; c++) p->A[row][c] = e.A[row][c];
    }
}

/* force and moment, or momenta, with the first three from base to central axes */
static inline void rattle_onto(const triad *q, const number given[6], number central[6]) {
    vector_store(onto(q, (vector){given[0], given[1], given[2]}), central);
    for (int i = 3; i < 6; i++) central[i] = given[i];
}

/* (ρ̇, Ω) of the momenta, for equations so factored */
static inline void rattle_legs_velocity(number a[6][6], const number inverse[6],
                                        const number momentum[6], rattle_state *s) {
    number b[6];

    rattle_onto(&s->x.q, momentum, b);
    solve_factored(a, inverse, b);
    s->velocity = out_of(&s->x.q, (vector){b[0], b[1], b[2]});
    s->omega = (vector){b[3], b[4], b[5]};
}

/* Velocities of a state for its readers. */
static inline void rattle_legs_read(const rattle *r, rattle_state *s) {
    rattle_legs_pose p;
    number momentum[6], inverse[6];

    if (r->damped) return; /* the closing kick has them */
    for (int i = 0; i < 6; i++) momentum[i] = s->momentum[i];
    rattle_legs_at(r, &s->x, &p);
    factor_definite(p.A, inverse);
    rattle_legs_velocity(p.A, inverse, momentum, s);
}

/* The momenta of a state whose pose and velocities are set. */
static inline void rattle_legs_begin(const rattle *r, rattle_state *s) {
    const vector v = onto(&s->x.q, s->velocity);
    const number u[6] = {v.x, v.y, v.z, s->omega.x, s->omega.y, s->omega.z};
    rattle_legs_pose p;
    number *m = s->momentum;

    rattle_legs_at(r, &s->x, &p);
    for (int row = 0; row < 6; row++) {
        m[row] = number_of(0);
        for (int c = 0; c < 6; c++) {
            m[row] = m[row] + (c > row ? p.A[c][row] : p.A[row][c]) * u[c];
        }
    }
    vector_store(out_of(&s->x.q, (vector){m[0], m[1], m[2]}), m);
}

/* What a step moves: ρ along the central axes of its beginning, and the turn (w, q) about them */
typedef struct {
    vector move, q;
    number w;
} rattle_chord;

/* the chord for unknowns (Δρ, 2q) */
static inline rattle_chord rattle_chord_of(const number unknown[6]) {
    const number half = number_of(0.5);
    const vector q = {half * unknown[3], half * unknown[4], half * unknown[5]};

    return (rattle_chord){
        {unknown[0], unknown[1], unknown[2]}, q, number_root(number_of(1) - dot(q, q))};
}

/* how a vector that turns with the body changes, without cancellation */
static inline vector rattle_turned(const rattle_chord *k, vector x) {
    const number two = number_of(2);
    const vector t = scale(two, cross(k->q, x));

    return add(scale(k->w, t), cross(k->q, t));
}

/* what a leg changes by in a step, axes of its beginning; each difference without cancellation */
typedef struct {
    vector arm;    /* at the end */
    vector n;      /* at the end */
    number length; /* at the end */
    number longer; /* Δl */
    vector piston; /* m₂ Δy, y the piston's centre of mass */
    vector across; /* Î Δn − m₂ c₂ Δy, of which the part across the leg counts */
} rattle_leg;

static inline rattle_leg rattle_leg_of(const hexapod *h, const rattle_legs_pose *p, int v,
                                       const rattle_chord *k) {
    const leg_mass *m = &h->mass[v];
    const vector turned = rattle_turned(k, h->arm[v]), joint = add(k->move, turned);
    const vector before = scale(p->g.length[v], p->n[v]), after = add(before, joint);
    rattle_leg g;

    g.arm = add(h->arm[v], turned);
    g.length = number_root(dot(after, after));
    g.n = scale(number_of(1) / g.length, after);
    g.longer = dot(add(before, after), joint) / (p->g.length[v] + g.length);

    const vector turn = scale(number_of(1) / g.length, along(joint, -g.longer, p->n[v]));
    const vector center = along(joint, -m->center, turn);
    g.piston = scale(m->piston, center);
    g.across = along(scale(m->swing, turn), -m->piston * m->center, center);
    return g;
}

/* h π of (mass-11), at the end of the step at which the leg is as long as `length` and points along n */
static inline vector rattle_leg_momentum(const leg_mass *m, const rattle_leg *g, number length,
                                         vector n) {
    const vector across = scale(number_of(1) / length, along(g->across, -dot(n, g->across), n));

    return add(across, along(g->piston, m->reflected * g->longer, n));
}

/* (mass-11): the momenta of a step at its beginning, times its length */
static inline void rattle_legs_before(const rattle *r, const rattle_legs_pose *p, vector J,
                                      const rattle_chord *k, number momentum[6]) {
    const vector own = rattle_times(J, k->q);
    vector linear = scale(r->load->mass, k->move);
    vector angular = scale(number_of(2), add(scale(k->w, own), cross(k->q, own)));

    for (int v = 0; v < LEGS; v++) {
        const rattle_leg g = rattle_leg_of(r->legs, p, v, k);
        const vector share = rattle_leg_momentum(&r->legs->mass[v], &g, p->g.length[v], p->n[v]);
        linear = add(linear, share);
        angular = add(angular, cross(r->legs->arm[v], share));
    }
    vector_store(linear, momentum);
    vector_store(angular, momentum + 3);
}

/* The same at its end; the linear one along the axes of the beginning, the angular one along those of the end. */
static inline void rattle_legs_after(const rattle *r, const rattle_legs_pose *p, vector J,
                                     const rattle_chord *k, number momentum[6]) {
    const number two = number_of(2);
    const vector own = rattle_times(J, k->q);
    const rattle_chord back = {k->move, scale(number_of(-1), k->q), k->w};
    vector linear = scale(r->load->mass, k->move), turning = scale(number_of(0), own);

    for (int v = 0; v < LEGS; v++) {
        const rattle_leg g = rattle_leg_of(r->legs, p, v, k);
        const vector share = rattle_leg_momentum(&r->legs->mass[v], &g, g.length, g.n);
        linear = add(linear, share);
        turning = add(turning, cross(g.arm, share));
    }
    turning = add(turning, rattle_turned(&back, turning));
    vector_store(linear, momentum);
    vector_store(add(scale(two, subtract(scale(k->w, own), cross(k->q, own))), turning),
                 momentum + 3);
}

/* The unknowns (Δρ, 2q) for which the step begins with given momenta (times its length; central axes), by Newton's method with the
 * matrix of the beginning. The size of a correction is that of its kinetic energy. Returns the last one's over the step's. */
static inline number rattle_legs_solve(const rattle *r, const rattle_legs_pose *p, vector J,
                                       number a[6][6], const number inverse[6],
                                       const number given[6], number unknown[6]) {
    const number zero = number_of(0), one = number_of(1);
    const number enough = number_of_real(64 * REAL_EPSILON * (64 * REAL_EPSILON));
    number whole = zero, last = zero, left = one;

    for (int i = 0; i < 6; i++) unknown[i] = given[i];
    solve_factored(a, inverse, unknown);
    for (int i = 0; i < 6; i++) whole = whole + given[i] * unknown[i];

    for (int sweep = 0; sweep < RATTLE_LEGS_SWEEPS; sweep++) {
        const mask wanted = number_greater(left, zero);
        if (!number_any(wanted)) break;
        const rattle_chord k = rattle_chord_of(unknown);
        number momentum[6], lack[6], correction[6], size = zero;

        rattle_legs_before(r, p, J, &k, momentum);
        for (int i = 0; i < 6; i++) correction[i] = lack[i] = given[i] - momentum[i];
        solve_factored(a, inverse, correction);
        for (int i = 0; i < 6; i++) {
            size = size + lack[i] * correction[i];
            unknown[i] = unknown[i] + number_select(wanted, correction[i], zero);
        }
        last = number_select(wanted, size, last);
        left = number_select(number_greater(last, enough * whole), one, zero);
    }
    return number_root(number_magnitude(last) / (whole + number_of(1e-300)));
}

/* (step-6) with legs: momenta p₁ = p + h/2 (W₁ − C₁ V₁), A₁ V₁ = p₁ */
static inline void rattle_legs_close(const rattle *r, number half, number damping[6][6],
                                     rattle_state *s) {
    number kicked[6], inverse[6];
    rattle_legs_pose p;

    rattle_legs_at(r, &s->x, &p);
    for (int row = 0; row < 6; row++) {
        number turned[6];
        rattle_onto(&s->x.q, damping[row], turned);
        for (int c = 0; c < 6; c++) damping[row][c] = turned[c];
    }
    for (int c = 0; c < 6; c++) {
        const number column[6] = {damping[0][c], damping[1][c], damping[2][c],
                                  damping[3][c], damping[4][c], damping[5][c]};
        number turned[6];
        rattle_onto(&s->x.q, column, turned);
        for (int row = c; row < 6; row++) p.A[row][c] = p.A[row][c] + half * turned[row];
    }
    for (int i = 0; i < 6; i++) kicked[i] = s->momentum[i] + half * s->wrench[i];
    factor_definite(p.A, inverse);
    rattle_legs_velocity(p.A, inverse, kicked, s);
}

/* (mass-11): one symmetric step of order 2. Returns what is left of its equation: over 1e-6 the step is too long to be one. */
static inline number rattle_legs_step(const rattle *r, real t, real step, rattle_state *s) {
    const number h = number_of_real(step), half = number_of_real(step / 2);
    const vector J = rattle_inertia(r->load);
    number damping[6][6], inverse[6], kicked[6], given[6], unknown[6];
    rattle_legs_pose p;

    /* opening half kick, and the pose that its momenta lead to */
    rattle_legs_at(r, &s->x, &p);
    factor_definite(p.A, inverse);
    for (int i = 0; i < 6; i++) kicked[i] = s->momentum[i] + half * s->wrench[i];
    rattle_onto(&s->x.q, kicked, given);
    for (int i = 0; i < 6; i++) given[i] = h * given[i];
    const number residual = rattle_legs_solve(r, &p, J, p.A, inverse, given, unknown);

    /* momenta at the other end */
    const rattle_chord k = rattle_chord_of(unknown);
    rattle_legs_after(r, &p, J, &k, s->momentum);
    const vector linear = out_of(&s->x.q, (vector){s->momentum[0], s->momentum[1], s->momentum[2]});
    vector_store(linear, s->momentum);
    for (int i = 0; i < 6; i++) s->momentum[i] = s->momentum[i] / h;
    s->x.rho = add(s->x.rho, out_of(&s->x.q, k.move));
    rattle_rotate(k.w, k.q, &s->x.q);

    /* closing half kick */
    r->act(r->context, t + step, &s->x, s->wrench, damping);
    if (r->damped) {
        number rest[6][6];
        for (int row = 0; row < 6; row++) {
            for (int c = 0; c < 6; c++) rest[row][c] = damping[row][c];
        }
        rattle_legs_close(r, half, rest, s);
        rattle_slow(damping, s->velocity, s->omega, s->wrench);
    }
    for (int i = 0; i < 6; i++) s->momentum[i] = s->momentum[i] + half * s->wrench[i];
    return residual;
}

#endif
