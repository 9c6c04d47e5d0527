/* What the unknowns of a pose are: numbers (number.h), or pairs {re, im} of numbers where poses need not be real. C has no complex
 * numbers of vectors, so that the texts of this room write sums and products as calls.
 *
 * Before including, define SCALAR_COMPLEX or not; ROWS_COMPLEX too if the coefficients of the equations are complex as well. */
#ifndef GOUGH_POSE_SCALAR_H
#define GOUGH_POSE_SCALAR_H

#include "kernel/number.h"

#if defined(SCALAR_COMPLEX)

typedef struct {
    number re, im;
} scalar;

KERNEL_INLINE scalar scalar_of(number re) { return (scalar){re, number_of(0)}; }
KERNEL_INLINE scalar plus(scalar a, scalar b) { return (scalar){a.re + b.re, a.im + b.im}; }
KERNEL_INLINE scalar minus(scalar a, scalar b) { return (scalar){a.re - b.re, a.im - b.im}; }
KERNEL_INLINE scalar times(scalar a, scalar b) {
    return (scalar){a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}
KERNEL_INLINE scalar multiple(number s, scalar a) { return (scalar){s * a.re, s * a.im}; }
KERNEL_INLINE scalar conjugate(scalar a) { return (scalar){a.re, -a.im}; }
KERNEL_INLINE scalar reciprocal(scalar a) {
    const number s = number_of(1) / (a.re * a.re + a.im * a.im);
    return (scalar){s * a.re, -(s * a.im)};
}
/* |re| + |im|: a norm without a root, and that of a product is no greater than the product of the norms */
KERNEL_INLINE number magnitude(scalar a) { return number_magnitude(a.re) + number_magnitude(a.im); }
KERNEL_INLINE number square_magnitude(scalar a) { return a.re * a.re + a.im * a.im; }
KERNEL_INLINE scalar scalar_select(mask m, scalar a, scalar b) {
    return (scalar){number_select(m, a.re, b.re), number_select(m, a.im, b.im)};
}

#else

typedef number scalar;

KERNEL_INLINE scalar scalar_of(number re) { return re; }
KERNEL_INLINE scalar plus(scalar a, scalar b) { return a + b; }
KERNEL_INLINE scalar minus(scalar a, scalar b) { return a - b; }
KERNEL_INLINE scalar times(scalar a, scalar b) { return a * b; }
KERNEL_INLINE scalar multiple(number s, scalar a) { return s * a; }
KERNEL_INLINE scalar reciprocal(scalar a) { return number_of(1) / a; }
KERNEL_INLINE number magnitude(scalar a) { return number_magnitude(a); }
KERNEL_INLINE scalar scalar_select(mask m, scalar a, scalar b) { return number_select(m, a, b); }

#endif

/* a coefficient of an equation, and its product with an unknown */
#if defined(ROWS_COMPLEX)
typedef scalar coefficient;
KERNEL_INLINE scalar weighted(coefficient c, scalar a) { return times(c, a); }
#else
typedef number coefficient;
KERNEL_INLINE scalar weighted(coefficient c, scalar a) { return multiple(c, a); }
#endif

/* a b + c d + e f */
KERNEL_INLINE scalar weighted_three(const coefficient c[3], const scalar a[3]) {
    return plus(plus(weighted(c[0], a[0]), weighted(c[1], a[1])), weighted(c[2], a[2]));
}

/* the larger of two numbers; what is not finite makes it NaN, which number_larger() would pass over: bounds must not lose it */
KERNEL_INLINE number larger_or_nan(number most, number x) {
    return number_larger(most, x) + (x - x);
}

#endif
