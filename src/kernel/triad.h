/* The constraints (1.2) on the triad: their violation, the nearest triad that meets them, and angular velocity.
 * Theory: docs/theory/body.md. */
#ifndef GOUGH_KERNEL_TRIAD_H
#define GOUGH_KERNEL_TRIAD_H

#include "kernel/vector.h"

/* largest |e_a·e_b − δ_ab|, the violation of (body-1) */
static inline number triad_violation(const triad *q) {
    const number one = number_of(1);

    number worst = number_magnitude(dot(q->i, q->i) - one);
    worst = number_larger(worst, number_magnitude(dot(q->j, q->j) - one));
    worst = number_larger(worst, number_magnitude(dot(q->k, q->k) - one));
    worst = number_larger(worst, number_magnitude(dot(q->i, q->j)));
    worst = number_larger(worst, number_magnitude(dot(q->j, q->k)));
    return number_larger(worst, number_magnitude(dot(q->k, q->i)));
}

/* (body-7): e_a ← e_a + Σ_b ½(δ_ab − e_a·e_b) e_b, one sweep: squares the violation */
static inline void triad_sweep(triad *q) {
    const number one = number_of(1), half = number_of(0.5);
    const vector i = q->i, j = q->j, k = q->k;
    const number ii = half * (one - dot(i, i)), ij = -half * dot(i, j);
    const number jj = half * (one - dot(j, j)), jk = -half * dot(j, k);
    const number kk = half * (one - dot(k, k)), ki = -half * dot(k, i);

    q->i = add(i, along(along(scale(ii, i), ij, j), ki, k));
    q->j = add(j, along(along(scale(ij, i), jj, j), jk, k));
    q->k = add(k, along(along(scale(ki, i), jk, j), kk, k));
}

/* (body-7): the nearest orthonormal triad; returns the violation before. A sweep leaves less than 3 times
 * the square of the violation: lanes that are not yet at round-off take another, the others are frozen.
 * From 0.1 the sweeps reach it. */
static inline number triad_project(triad *q) {
    const number enough = number_of_real(REAL_EPSILON);
    const number violation = triad_violation(q);
    number left = violation;

    for (int sweep = 0; sweep < NUMBER_SWEEPS; sweep++) {
        const mask wanted = number_greater(left, enough);
        triad next = *q;
        if (sweep >= NUMBER_SURE_SWEEPS && !number_any(wanted)) break;
        triad_sweep(&next);
        if (sweep < NUMBER_SURE_SWEEPS) {
            *q = next;
        } else {
            q->i = vector_select(wanted, next.i, q->i);
            q->j = vector_select(wanted, next.j, q->j);
            q->k = vector_select(wanted, next.k, q->k);
        }
        left = number_of(3) * left * left;
    }
    return violation;
}

/* (body-8): ω = ½ Σ e × ė, the skew part of Q̇Qᵀ, base axes */
static inline vector triad_angular_velocity(const triad *q, const triad *rate) {
    const vector sum = add(add(cross(q->i, rate->i), cross(q->j, rate->j)), cross(q->k, rate->k));
    return scale(number_of(0.5), sum);
}

/* ė = ω × e */
static inline triad triad_rate(const triad *q, vector omega) {
    return (triad){cross(omega, q->i), cross(omega, q->j), cross(omega, q->k)};
}

#endif
