/* Energy that a leg returns between two looks at its power: the part of the power below 0 of the polynomial through the looks. */
#ifndef GOUGH_RUN_RETURNED_H
#define GOUGH_RUN_RETURNED_H

#include <stdbool.h>

#include "run/quadrature.h"

/* halvings of a bracket around a zero of the polynomial: to round-off */
enum { RETURNED_HALVINGS = 54 };

static inline double returned_value(const double p[QUADRATURE_ROWS], double s) {
    return p[0] + s * (p[1] + s * (p[2] + s * p[3]));
}

/* ∫ of the polynomial from 0 to s */
static inline double returned_integral(const double p[QUADRATURE_ROWS], double s) {
    return s * (p[0] + s * (p[1] / 2 + s * (p[2] / 3 + s * p[3] / 4)));
}

/* ∫ min(p, 0) from low to high, between which p rises or falls throughout */
static inline double returned_monotonic(const double p[QUADRATURE_ROWS], double low, double high) {
    const bool below = returned_value(p, low) < 0;
    double inner = low, outer = high;

    if (below == (returned_value(p, high) < 0))
        return below ? returned_integral(p, high) - returned_integral(p, low) : 0;
    for (int i = 0; i < RETURNED_HALVINGS; i++) {
        const double middle = (inner + outer) / 2;
        if ((returned_value(p, middle) < 0) == below) {
            inner = middle;
        } else {
            outer = middle;
        }
    }
    return below ? returned_integral(p, inner) - returned_integral(p, low)
                 : returned_integral(p, high) - returned_integral(p, inner);
}

/* ∫ min(p, 0) from 0 to 1 of p = p₀ + p₁s + p₂s² + p₃s³: between the places where p turns */
static inline double returned_part(const double p[QUADRATURE_ROWS]) {
    const double square = p[2] * p[2] - 3 * p[1] * p[3], root = sqrt(square > 0 ? square : 0);
    const double q = -p[2] - (p[2] < 0 ? -root : root);
    const double one = p[1] / q, two = q / (3 * p[3]); /* infinite or NaN: not there */
    const double turn[2] = {one < two ? one : two, one < two ? two : one};
    double low = 0, sum = 0;

    for (int i = 0; i < 2 && square > 0; i++) {
        if (!(turn[i] > low && turn[i] < 1)) continue;
        sum += returned_monotonic(p, low, turn[i]);
        low = turn[i];
    }
    return sum + returned_monotonic(p, low, 1);
}

/* −∫ min(power, 0) from look a to the next; fit: the polynomial as quadrature_fit() makes it, h its length */
static inline double returned_energy(const double fit[QUADRATURE_ROWS][QUADRATURE_ROWS], double h,
                                     const double power[QUADRATURE_ROWS]) {
    double p[QUADRATURE_ROWS] = {0, 0, 0, 0};

    for (int i = 0; i < QUADRATURE_ROWS; i++) {
        for (int k = 0; k < QUADRATURE_ROWS; k++) p[k] += fit[i][k] * power[i];
    }
    return -h * returned_part(p);
}

#endif
