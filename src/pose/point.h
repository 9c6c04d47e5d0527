/* Newton's and Kantorovich's quantities at one place, (pose-4), for equations that are exactly quadratic: bounds that prove a root,
 * and that there is no other. Over scalars with real rows; norms are of the largest component. Theory: docs/theory/pose.md. */
#ifndef GOUGH_POSE_POINT_H
#define GOUGH_POSE_POINT_H

#include <string.h>

#include "pose/eight.h"

/* rows of the legs, and the largest sum of the moduli of a row's coefficients of x_j x_k */
typedef struct {
    number row[SOMA_LEGS][PRODUCTS];
    number greatest;
} soma_legs;

/* the eighth equation: e·e = 1, or that one unknown is 1, whose place is the chart */
enum { SPHERE = -1 };

typedef struct {
    scalar Y[SOMA][SOMA]; /* about the inverse of the Jacobian */
    scalar value[SOMA];   /* of the six rows, e·g, and e·e or the unknown that is 1 */
    number size;          /* ‖Y‖ */
    number epsilon;       /* ≥ ‖1 − Y J‖ */
    number kappa;         /* ≥ Σ_jk |Σ_m Y_im Q_m,jk| of each row i */
    number rounding;      /* of a value, where the largest component of x is 1 */
} soma_point;

/* ε of a value: at most 25 half ε in coefficients, gradient and sum of real numbers, with some to spare; products of complex
 * numbers have four times as many */
#if defined(SCALAR_COMPLEX)
#define POINT_ROUNDINGS REAL_LITERAL(64.0)
#else
#define POINT_ROUNDINGS REAL_LITERAL(16.0)
#endif

/* after the rows are filled */
static inline void soma_legs_bound(soma_legs *m) {
    m->greatest = number_of(4);
    for (int v = 0; v < SOMA_LEGS; v++) {
        number sum = number_of(4);
        for (int n = 0; n < SQUARE; n++) sum = sum + number_magnitude(m->row[v][n]);
        for (int n = SHIFT; n < PRODUCTS; n++)
            sum = sum + number_of(2) * number_magnitude(m->row[v][n]);
        m->greatest = number_larger(m->greatest, sum);
    }
}

/* the rows of the Jacobian at x, and half of each row times x, which is the value */
static inline void soma_jacobian(const soma_legs *m, const scalar x[SOMA], int chart,
                                 scalar J[SOMA][SOMA], scalar value[SOMA]) {
    for (int v = 0; v < SOMA_LEGS; v++) soma_gradient(m->row[v], x, J[v]);
    soma_study(x, J[6]);
    for (int k = 0; k < SOMA; k++) {
        J[7][k] = scalar_of(number_of(k == chart));
        if (chart == SPHERE && k < 4) J[7][k] = plus(x[k], x[k]);
    }
    for (int v = 0; v < SOMA; v++) value[v] = multiple(number_of(0.5), soma_dot(J[v], x, SOMA));
    if (chart != SPHERE) value[7] = x[chart];
}

static inline number soma_largest(const scalar x[SOMA]) {
    number most = magnitude(x[0]);

    for (int k = 1; k < SOMA; k++) most = larger_or_nan(most, magnitude(x[k]));
    return most;
}

/* ‖A‖, the largest sum of the moduli of a row */
static inline number soma_norm(scalar A[SOMA][SOMA]) {
    number most = number_of(0);

    for (int i = 0; i < SOMA; i++) {
        number sum = number_of(0);
        for (int j = 0; j < SOMA; j++) sum = sum + magnitude(A[i][j]);
        most = larger_or_nan(most, sum);
    }
    return most;
}

/* (pose-4): κ, exact but for rounding */
static inline number soma_kappa(const soma_legs *m, int chart, scalar Y[SOMA][SOMA]) {
    const number two = number_of(2), four = number_of(4);
    number most = number_of(0);

    for (int i = 0; i < SOMA; i++) {
        number sum = four * magnitude(Y[i][6]);
        for (int n = 0; n < PRODUCTS; n++) {
            scalar c = chart == SPHERE && n < 4 ? Y[i][7] : scalar_of(number_of(0));
            for (int v = 0; v < SOMA_LEGS; v++) c = plus(c, multiple(m->row[v][n], Y[i][v]));
            if (n < SQUARE)
                sum = sum + magnitude(c);
            else
                sum = sum + (n == SQUARE ? four : two) * magnitude(c);
        }
        most = larger_or_nan(most, sum);
    }
    return most;
}

/* (pose-4) at x: inverse, ε, κ and what rounding may have done to the values */
static inline void soma_point_at(const soma_legs *m, const scalar x[SOMA], int chart,
                                 soma_point *p) {
    const number rounding = number_of_real(POINT_ROUNDINGS * REAL_EPSILON), one = number_of(1);
    scalar J[SOMA][SOMA], rest[SOMA][SOMA];
    eight f;

    soma_jacobian(m, x, chart, J, p->value);
    memcpy(f.a, J, sizeof J);
    eight_factor(&f);
    eight_invert(&f, p->Y);

    for (int i = 0; i < SOMA; i++) {
        for (int j = 0; j < SOMA; j++) {
            scalar sum = i == j ? scalar_of(one) : scalar_of(number_of(0));
            for (int k = 0; k < SOMA; k++) sum = minus(sum, times(p->Y[i][k], J[k][j]));
            rest[i][j] = sum;
        }
    }
    p->size = soma_norm(p->Y);
    p->epsilon = soma_norm(rest) + rounding * p->size * soma_norm(J);
    p->kappa = soma_kappa(m, chart, p->Y) + rounding * p->size * m->greatest;
    p->rounding = rounding * m->greatest;
}

#endif
