/* A state displaced along one of δr, δθ, δv, δω by an imaginary step, and what comes out of it. Text for complex numbers.
 * Theory: docs/theory/stability.md. */
#ifndef GOUGH_LINEAR_DISPLACE_H
#define GOUGH_LINEAR_DISPLACE_H

#include "kernel/top.h"

/* far below the rounding of any real part, far above the least double */
static const double imaginary_step = 1e-30;

static inline vector unit_vector(int axis) { return (vector){axis == 0, axis == 1, axis == 2}; }

static inline vector imaginary(vector v) {
    return (vector){cimag(v.x) / imaginary_step, cimag(v.y) / imaginary_step,
                    cimag(v.z) / imaginary_step};
}

/* the state displaced by so many imaginary steps in one of δr, δθ, δv, δω: δe = δθ × e, δė = δω × e + ω × δe */
static inline void displace_by(double amount, int direction, coordinates *x, coordinates *rate) {
    const vector step = scale(I * imaginary_step * amount, unit_vector(direction % 3));
    const vector omega = triad_angular_velocity(&x->q, &rate->q);
    triad turned;

    switch (direction / 3) {
    case 0:
        x->rho = add(x->rho, step);
        break;
    case 1:
        turned = triad_rate(&x->q, step);
        x->q = (triad){add(x->q.i, turned.i), add(x->q.j, turned.j), add(x->q.k, turned.k)};
        rate->q = triad_rate(&x->q, omega);
        break;
    case 2:
        rate->rho = add(rate->rho, step);
        break;
    default:
        rate->q = triad_rate(&x->q, add(omega, step));
    }
}

/* by one of them */
static inline void displace(int direction, coordinates *x, coordinates *rate) {
    displace_by(1, direction, x, rate);
}

#endif
