/* RATTLE for a rigid body in (ρ, i, j, k), and its symmetric compositions (step-4), (step-5), (step-6); with legs that have mass,
 * its steps are those of (mass-11), rattle_legs.h.
 *
 * The multipliers of the position constraints are eliminated: with J = diag(J_x, J_y, J_z) and the turn of a step the unit
 * quaternion (w, q), the constraints ask 2wJq + 2q×Jq = h m, m the angular momentum in the middle of the kick. No second moment
 * is divided by. Forces may fall linearly with velocity; the closing half kick is then implicit, which keeps the step symmetric.
 */
#ifndef GOUGH_INTEGRATE_RATTLE_H
#define GOUGH_INTEGRATE_RATTLE_H

#include "integrate/composition.h"
#include "integrate/rattle_legs.h"

/* Fills the wrench of a state whose pose and velocity are set. */
static inline void rattle_begin(const rattle *r, real t, rattle_state *s) {
    number damping[6][6];

    r->act(r->context, t, &s->x, s->wrench, damping);
    if (r->damped) rattle_slow(damping, s->velocity, s->omega, s->wrench);
    if (r->legs) rattle_legs_begin(r, s);
}

/* (step-4): q of the unit quaternion (w, q) with w J q + q×(J q) = half, by Newton's method; returns what is left of the
 * equation over its size. The Newton matrix is wJ − (Jq)qᵀ/w + [q]J − [Jq]. */
static inline number rattle_turn(vector J, vector half, vector *turn, number *cosine) {
    const number one = number_of(1), tiny = number_of(1e-300);
    vector q = {half.x / J.x, half.y / J.y, half.z / J.z}, residual;
    number w;

    for (int sweep = 0; sweep <= NUMBER_NEWTON; sweep++) {
        const vector p = rattle_times(J, q);
        w = number_root(one - dot(q, q));
        residual = subtract(add(scale(w, p), cross(q, p)), half);
        if (sweep == NUMBER_NEWTON) break;

        /* columns of the matrix, and Cramer's rule by cross products */
        const number u = one / w;
        const vector a = {w * J.x - p.x * q.x * u, q.z * J.x - p.y * q.x * u - p.z,
                          -q.y * J.x - p.z * q.x * u + p.y};
        const vector b = {-q.z * J.y - p.x * q.y * u + p.z, w * J.y - p.y * q.y * u,
                          q.x * J.y - p.z * q.y * u - p.x};
        const vector c = {q.y * J.z - p.x * q.z * u - p.y, -q.x * J.z - p.y * q.z * u + p.x,
                          w * J.z - p.z * q.z * u};
        const vector bc = cross(b, c);
        const number inverse = one / dot(a, bc);
        q.x = q.x - inverse * dot(residual, bc);
        q.y = q.y - inverse * dot(residual, cross(c, a));
        q.z = q.z - inverse * dot(residual, cross(a, b));
    }
    *turn = q;
    *cosine = w;
    return norm(residual) / (norm(half) + tiny);
}

/* (step-6): M ρ̇ + h/2 C = momentum with the damping matrix C, six linear equations */
static inline void rattle_close_damped(const rattle *r, vector J, number half, number damping[6][6],
                                       const number momentum[6], rattle_state *s) {
    const number inertia[6] = {r->load->mass, r->load->mass, r->load->mass, J.x, J.y, J.z};
    number a[6][6], b[1][6];

    for (int row = 0; row < 6; row++) {
        for (int c = 0; c < 6; c++) a[row][c] = half * damping[row][c];
        a[row][row] = a[row][row] + inertia[row];
        b[0][row] = momentum[row];
    }
    (void)solve_six(a, b, 1);
    s->velocity = (vector){b[0][0], b[0][1], b[0][2]};
    s->omega = (vector){b[0][3], b[0][4], b[0][5]};
    rattle_slow(damping, s->velocity, s->omega, s->wrench);
}

/* (step-4): one symmetric step of order 2. Returns the residual of the turn: over 1e-6 the step is too long to be one. */
static inline number rattle_step(const rattle *r, real t, real step, rattle_state *s) {
    const number h = number_of_real(step), half = number_of_real(step / 2);
    const vector J = rattle_inertia(r->load);
    const number M = r->load->mass, *F = s->wrench, *L = s->wrench + 3;
    number damping[6][6], w, residual;
    vector q, p, m;

    /* opening half kick: velocity, and angular momentum on the body's axes */
    s->velocity = along(s->velocity, half / M, (vector){F[0], F[1], F[2]});
    m = along(rattle_times(J, s->omega), half, (vector){L[0], L[1], L[2]});

    /* drift, and the angular momentum seen from the turned axes: m' = (2wJq − 2q×Jq)/h */
    s->x.rho = along(s->x.rho, h, s->velocity);
    residual = rattle_turn(J, scale(half, m), &q, &w);
    rattle_rotate(w, q, &s->x.q);
    p = rattle_times(J, q);
    m = subtract(scale(w, p), cross(q, p));
    m = (vector){m.x / half, m.y / half, m.z / half}; /* no factor 2/h, whose rounding adds up */

    /* closing half kick */
    r->act(r->context, t + step, &s->x, s->wrench, damping);
    m = along(m, half, (vector){L[0], L[1], L[2]});
    if (r->damped) {
        const vector mv = along(scale(M, s->velocity), half, (vector){F[0], F[1], F[2]});
        const number momentum[6] = {mv.x, mv.y, mv.z, m.x, m.y, m.z};
        rattle_close_damped(r, J, half, damping, momentum, s);
    } else {
        s->velocity = along(s->velocity, half / M, (vector){F[0], F[1], F[2]});
        s->omega = (vector){m.x / J.x, m.y / J.y, m.z / J.z};
    }
    return residual;
}

/* (step-5): one step of order 2, 4, 6 or 8 (level 0 … 3); its parts stay between t and t + h */
static inline number rattle_compose(const rattle *r, int level, real t, real h, rattle_state *s) {
    number residual = number_of(0); /* summed, as a maximum would lose what is not a number */
    real at = 0;

    for (int i = 0; i < composition_stages[level]; i++) {
        const real part = composition_weights[level][i];
        residual = residual + (r->legs ? rattle_legs_step(r, t + at * h, part * h, s)
                                       : rattle_step(r, t + at * h, part * h, s));
        at = at + part;
    }
    if (r->legs) rattle_legs_read(r, s);
    return residual;
}

#endif
