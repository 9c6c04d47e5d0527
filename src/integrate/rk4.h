/* The classical Runge–Kutta step of order 4 (step-1). */
#ifndef GOUGH_INTEGRATE_RK4_H
#define GOUGH_INTEGRATE_RK4_H

#include "integrate/stepper.h"

/* from y at t, whose rate is given, to `out` at t + h; out may be y */
static inline void rk4_step(rate_function f, void *context, int n, real t, real h, const number *y,
                            const number *rate, number *out) {
    const number half = number_of_real(h / 2), whole = number_of_real(h);
    const number sixth = number_of_real(h / 6), two = number_of(2);
    number k2[STEPPER_SIZE], k3[STEPPER_SIZE], k4[STEPPER_SIZE], z[STEPPER_SIZE];

    STEPPER_SOME(n);
    for (int i = 0; i < n; i++) z[i] = y[i] + half * rate[i];
    f(context, t + h / 2, z, k2);
    for (int i = 0; i < n; i++) z[i] = y[i] + half * k2[i];
    f(context, t + h / 2, z, k3);
    for (int i = 0; i < n; i++) z[i] = y[i] + whole * k3[i];
    f(context, t + h, z, k4);
    for (int i = 0; i < n; i++) {
        out[i] = y[i] + sixth * (rate[i] + two * (k2[i] + k3[i]) + k4[i]);
    }
}

#endif
