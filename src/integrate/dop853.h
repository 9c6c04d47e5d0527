/* Dormand and Prince's Runge–Kutta method of order 8 with error estimate and dense output (step-2), (step-3). */
#ifndef GOUGH_INTEGRATE_DOP853_H
#define GOUGH_INTEGRATE_DOP853_H

#include "integrate/dop853_table.h"
#include "integrate/stepper.h"
#include "kernel/real.h"

/* The slopes of one step, and its dense output once prepared. slope[0] is the rate at the step's beginning, from the caller. */
typedef struct {
    number slope[16][STEPPER_SIZE];
    number dense[8][STEPPER_SIZE];
} dop853;

/* components that are summed together: as many as stay in registers, of which lanes of 2 and 4 have sixteen */
enum { DOP853_BLOCK = NUMBER_WIDTH == 2 || NUMBER_WIDTH == 4 ? COORDINATES : MOTION };

/* z = y + h Σ a_j slope_j for `width` components from `first` on */
KERNEL_INLINE void dop853_block(const dop853 *s, int first, int width, int row, real h,
                                const number *y, number *z) {
    number sum[DOP853_BLOCK];

    KERNEL_UNROLL
    for (int i = 0; i < width; i++) sum[i] = number_of(0);
    for (int j = 0; j < row && j < 15; j++) {
        if (dop853_a[row][j] == 0) continue; /* the tableau's own zeros */
        const number weight = number_of_real(dop853_a[row][j]);
        KERNEL_UNROLL
        for (int i = 0; i < width; i++) sum[i] = sum[i] + weight * s->slope[j][first + i];
    }
    KERNEL_UNROLL
    for (int i = 0; i < width; i++) z[first + i] = y[first + i] + number_of_real(h) * sum[i];
}

/* the point at which stage `row` is taken */
static inline void dop853_point(const dop853 *s, int n, int row, real h, const number *y,
                                number *z) {
    int i = 0;

    for (; i + DOP853_BLOCK <= n; i += DOP853_BLOCK) {
        dop853_block(s, i, DOP853_BLOCK, row, h, y, z);
    }
    for (; i < n; i++) dop853_block(s, i, 1, row, h, y, z);
}

/* (step-2): the step from y at t to `out` at t + h; eleven evaluations */
static inline void dop853_step(dop853 *s, rate_function f, void *context, int n, real t, real h,
                               const number *y, number *out) {
    number z[STEPPER_SIZE];

    for (int row = 1; row < DOP853_STAGES; row++) {
        dop853_point(s, n, row, h, y, z);
        f(context, t + dop853_c[row] * h, z, s->slope[row]);
    }
    dop853_point(s, n, DOP853_STAGES, h, y, out);
}

/* (step-2): the estimated error of the step over its tolerance, the fifth-order estimate held against the third-order one;
 * accepted where at most 1. size: what is added to |y| in each component. For scalar number types. */
static inline real dop853_error(const dop853 *s, int n, real h, const number *y, const number *out,
                                const real *size, real tolerance) {
    real e5[STEPPER_SIZE], e3[STEPPER_SIZE], fifth = 0, third = 0;

    for (int i = 0; i < n; i++) e5[i] = e3[i] = 0;
    for (int j = 0; j < DOP853_STAGES; j++) {
        if (dop853_error5[j] == 0 && dop853_error3[j] == 0) continue;
        for (int i = 0; i < n; i++) {
            e5[i] = e5[i] + dop853_error5[j] * number_first(s->slope[j][i]);
            e3[i] = e3[i] + dop853_error3[j] * number_first(s->slope[j][i]);
        }
    }
    for (int i = 0; i < n; i++) {
        const real before = real_magnitude(number_first(y[i]));
        const real after = real_magnitude(number_first(out[i]));
        const real scale = tolerance * (size[i] + (after > before ? after : before));
        e5[i] = e5[i] / scale;
        e3[i] = e3[i] / scale;
    }
    for (int i = 0; i < n; i++) {
        fifth = fifth + e5[i] * e5[i];
        third = third + e3[i] * e3[i];
    }
    if (!(fifth > 0)) return fifth; /* no error at all, or not finite */
    return real_magnitude(h) * fifth / real_root((fifth + third / 100) * n);
}

/* (step-8): the step times |λ| of the fastest mode, decay or oscillation, from the last stage and the end of an accepted step, both
 * of which lie at t + h. Above 6.1 the method is near the limit of its stability. rate: that of `out`; size: that of each
 * component. For scalar number types. */
static inline real dop853_stiffness(const dop853 *s, int n, real h, const number *y,
                                    const number *out, const number *rate, const real *size) {
    number z[STEPPER_SIZE];
    real rates = 0, distances = 0;

    dop853_point(s, n, DOP853_STAGES - 1, h, y, z);
    for (int i = 0; i < n; i++) {
        const real a = number_first(rate[i] - s->slope[DOP853_STAGES - 1][i]) / size[i];
        const real b = number_first(out[i] - z[i]) / size[i];
        rates = rates + a * a;
        distances = distances + b * b;
    }
    return distances > 0 ? real_magnitude(h) * real_root(rates / distances) : 0;
}

/* (step-3): the polynomial of degree 7 through the step; four more evaluations */
static inline void dop853_prepare(dop853 *s, rate_function f, void *context, int n, real t, real h,
                                  const number *y, const number *out) {
    const number step = number_of_real(h);
    number z[STEPPER_SIZE];

    f(context, t + h, out, s->slope[DOP853_STAGES]);
    for (int row = DOP853_STAGES + 1; row < 16; row++) {
        dop853_point(s, n, row, h, y, z);
        f(context, t + dop853_c[row] * h, z, s->slope[row]);
    }
    for (int i = 0; i < n; i++) {
        const number whole = out[i] - y[i], bend = step * s->slope[0][i] - whole;
        s->dense[0][i] = y[i];
        s->dense[1][i] = whole;
        s->dense[2][i] = bend;
        s->dense[3][i] = whole - step * s->slope[DOP853_STAGES][i] - bend;
    }
    for (int row = 0; row < 4; row++) {
        for (int i = 0; i < n; i++) {
            number sum = number_of(0);
            for (int j = 0; j < 16; j++) {
                sum = sum + number_of_real(dop853_d[row][j]) * s->slope[j][i];
            }
            s->dense[4 + row][i] = step * sum;
        }
    }
}

/* (step-3): y at t + theta h */
static inline void dop853_dense(const dop853 *s, int n, real theta, number *y) {
    const number a = number_of_real(theta), b = number_of_real(1 - theta);

    for (int i = 0; i < n; i++) {
        number sum = a * s->dense[7][i];
        sum = b * (s->dense[6][i] + sum);
        sum = a * (s->dense[5][i] + sum);
        sum = b * (s->dense[4][i] + sum);
        sum = a * (s->dense[3][i] + sum);
        sum = b * (s->dense[2][i] + sum);
        sum = a * (s->dense[1][i] + sum);
        y[i] = s->dense[0][i] + sum;
    }
}

/* Factor from a step to the next for an error over tolerance: (1/error)^(1/8) with a margin, between 1/3 and 6 */
static inline real dop853_factor(real error) {
    const real least = (real)1 / 3, most = 6, margin = (real)9 / 10;
    real factor;

    if (!(error > 0)) return error <= 0 ? most : least;
    factor = margin / real_pow(error, (real)1 / 8);
    return factor < least ? least : factor > most ? most : factor;
}

#endif
