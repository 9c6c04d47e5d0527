/* What a stepper sees: y' = f(t, y) through a callback, arrays of numbers, and nothing of what they mean. */
#ifndef GOUGH_INTEGRATE_STEPPER_H
#define GOUGH_INTEGRATE_STEPPER_H

#include "kernel/number.h"
#include "plant/layout.h"

/* most unknowns of a system; arrays of this size live on the stack */
enum { STEPPER_SIZE = STATE_SIZE };

/* tells the compiler that there are unknowns, which arrays of them are then not taken to be empty */
#define STEPPER_SOME(n)                                                                            \
    if ((n) < 1) __builtin_unreachable()

/* rate = f(t, y) */
typedef void (*rate_function)(void *context, real t, const number *y, number *rate);

/* Cubic Hermite interpolation between the ends of a step, error O(h⁴); theta from 0 to 1 */
static inline void interpolate_cubic(int n, real h, real theta, const number *y0,
                                     const number *rate0, const number *y1, const number *rate1,
                                     number *y) {
    const number s = number_of_real(theta), r = number_of_real(1 - theta);
    const number a = number_of_real(h * theta * (1 - theta) * (1 - theta));
    const number b = number_of_real(h * theta * theta * (1 - theta));
    const number two = number_of(2), one = number_of(1);

    for (int i = 0; i < n; i++) {
        y[i] = r * r * (one + two * s) * y0[i] + s * s * (one + two * r) * y1[i] + a * rate0[i] -
               b * rate1[i];
    }
}

#endif
