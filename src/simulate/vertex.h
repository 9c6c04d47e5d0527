/* The peak of a quantity between three looks at it. Text over the number type. */
#ifndef GOUGH_SIMULATE_VERTEX_H
#define GOUGH_SIMULATE_VERTEX_H

#include "kernel/number.h"

/* Value at the vertex of the parabola through a, b and c, which lie `left` and `right` apart, where b is the largest or the least;
 * else b */
static inline number peak_vertex(number a, number b, number c, real left, real right) {
    const number zero = number_of(0), rise = b - a, fall = b - c;
    const number before = rise / number_of_real(left), after = -fall / number_of_real(right);
    const number bend = (after - before) / number_of_real(left + right);
    const number slope = before + bend * number_of_real(left);
    const number vertex = b - slope * slope / (number_of(4) * bend);
    const mask passes = number_greater(zero, rise * fall); /* on its way from a to c */
    const mask bends = number_greater(number_magnitude(bend), number_of(1e-300));

    return number_select(passes, b, number_select(bends, vertex, b));
}

#endif
