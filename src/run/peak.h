/* The peak of a quantity between two looks at it. Text over the number type. */
#ifndef GOUGH_RUN_PEAK_H
#define GOUGH_RUN_PEAK_H

#include "kernel/number.h"
#include "run/quadrature.h"

/* Value where the polynomial through the last `count` looks turns between looks a and a + 1, and in *s how far from a to a + 1 that
 * is, 0 to 1; the value at look a and 0 where it does not. In the middle of four looks it must turn for the looks too: beside a
 * jump a polynomial swings although the quantity does not. */
static inline number peak_between(const number y[QUADRATURE_ROWS],
                                  const double c[QUADRATURE_ROWS][QUADRATURE_ROWS], int count,
                                  int a, number *s) {
    const number zero = number_of(0), one = number_of(1);
    number p[QUADRATURE_ROWS] = {zero, zero, zero, zero};

    for (int i = QUADRATURE_ROWS - count; i < QUADRATURE_ROWS; i++) {
        for (int k = 0; k < QUADRATURE_ROWS; k++) p[k] = p[k] + number_of(c[i][k]) * y[i];
    }
    /* p1 + 2 p2 s + 3 p3 s² = 0 has one root inside where it differs in sign at the ends */
    const number slope = p[1] + number_of(2) * p[2] + number_of(3) * p[3];
    const number square = p[2] * p[2] - number_of(3) * p[1] * p[3];
    const number root = number_root(number_larger(zero, square));
    const number q = -p[2] - number_select(number_greater(zero, p[2]), -root, root);
    const number near = p[1] / q, far = q / (number_of(3) * p[3]);
    const number outside = number_magnitude(near - number_of(0.5)); /* above 1/2: the other root */
    const number inside = number_select(number_greater(number_of(0.5 + 1e-9), outside), near, far);
    const number kept = number_select(number_greater(inside, one), one, inside);
    const number bends = a == 1 && count == QUADRATURE_ROWS ? (y[1] - y[0]) * (y[3] - y[2]) : -one;
    const mask turns = number_greater(zero, p[1] * slope);
    const mask looks_turn = number_greater(zero, bends);

    *s = number_select(turns, number_select(looks_turn, number_larger(zero, kept), zero), zero);
    return p[0] + *s * (p[1] + *s * (p[2] + *s * p[3]));
}

#endif
