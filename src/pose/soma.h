/* A pose as a soma (Study's parameters): x = (e0, e1, e2, e3, g0, g1, g2, g3), a quaternion e and its companion g with e·g = 0, of
 * which multiples are the same pose. The condition that a leg has a length is linear in 17 products of these unknowns, (pose-2).
 * Theory: docs/theory/pose.md. */
#ifndef GOUGH_POSE_SOMA_H
#define GOUGH_POSE_SOMA_H

#include "pose/scalar.h"

/* unknowns; products: ten e_i e_j, then g·g, three of p = e0 g − g0 e and three of w = e × g */
enum { SOMA = 8, PRODUCTS = 17, SQUARE = 10, SHIFT = 11, TWIST = 14, SOMA_LEGS = 6 };

/* (pose-1): the ten products of e, in order */
static const signed char soma_pair[SQUARE][2] = {{0, 0}, {1, 1}, {2, 2}, {3, 3}, {0, 1},
                                                 {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

KERNEL_INLINE scalar soma_dot(const scalar *a, const scalar *b, int count) {
    scalar sum = times(a[0], b[0]);

    KERNEL_UNROLL
    for (int k = 1; k < count; k++) sum = plus(sum, times(a[k], b[k]));
    return sum;
}

/* a0 b1 − a1 b0, at the two places of a cross product */
KERNEL_INLINE scalar soma_cross(const scalar a[3], const scalar b[3], int k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;

    return minus(times(a[i], b[j]), times(a[j], b[i]));
}

/* (pose-1): the symmetric bilinear form y of the products, y(x, x) = Y(x), times 2, added to a sum */
KERNEL_INLINE void soma_products(const scalar x[SOMA], const scalar z[SOMA], scalar sum[PRODUCTS]) {
    const scalar *const g = x + 4, *const f = z + 4;

    KERNEL_UNROLL
    for (int n = 0; n < SQUARE; n++) {
        const int i = soma_pair[n][0], j = soma_pair[n][1];
        sum[n] = plus(sum[n], plus(times(x[i], z[j]), times(x[j], z[i])));
    }
    sum[SQUARE] = plus(sum[SQUARE], multiple(number_of(2), soma_dot(g, f, 4)));
    KERNEL_UNROLL
    for (int k = 0; k < 3; k++) {
        const scalar p = minus(times(x[0], f[1 + k]), times(g[0], z[1 + k]));
        const scalar q = minus(times(z[0], g[1 + k]), times(f[0], x[1 + k]));
        const scalar w = plus(soma_cross(x + 1, f + 1, k), soma_cross(z + 1, g + 1, k));
        sum[SHIFT + k] = plus(sum[SHIFT + k], plus(p, q));
        sum[TWIST + k] = plus(sum[TWIST + k], w);
    }
}

/* gradient of c·Y(x); x·gradient = 2 c·Y(x) */
KERNEL_INLINE void soma_gradient(const coefficient c[PRODUCTS], const scalar x[SOMA],
                                 scalar d[SOMA]) {
    const coefficient *const P = c + SHIFT, *const W = c + TWIST;
    const scalar *const e = x + 1, *const g = x + 4;
    const scalar g0 = g[0], e0 = x[0];

    KERNEL_UNROLL
    for (int i = 0; i < 4; i++) d[i] = weighted(c[i], plus(x[i], x[i]));
    KERNEL_UNROLL
    for (int n = 4; n < SQUARE; n++) {
        const int i = soma_pair[n][0], j = soma_pair[n][1];
        d[i] = plus(d[i], weighted(c[n], x[j]));
        d[j] = plus(d[j], weighted(c[n], x[i]));
    }
    KERNEL_UNROLL
    for (int i = 0; i < 4; i++) d[4 + i] = weighted(c[SQUARE], plus(g[i], g[i]));

    /* P·(e0 g − g0 e) + W·(e × g) */
    d[0] = plus(d[0], weighted_three(P, g + 1));
    d[4] = minus(d[4], weighted_three(P, e));
    KERNEL_UNROLL
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        const scalar gW = minus(weighted(W[j], g[1 + i]), weighted(W[i], g[1 + j]));
        const scalar We = minus(weighted(W[i], e[j]), weighted(W[j], e[i]));
        d[1 + k] = plus(d[1 + k], minus(gW, weighted(P[k], g0)));
        d[5 + k] = plus(d[5 + k], plus(We, weighted(P[k], e0)));
    }
}

/* gradient of Study's condition e·g = 0 */
KERNEL_INLINE void soma_study(const scalar x[SOMA], scalar d[SOMA]) {
    KERNEL_UNROLL
    for (int k = 0; k < 4; k++) d[k] = x[4 + k], d[4 + k] = x[k];
}

/* (pose-2): the row of a leg from base joint b to top joint a without its length, which adds −l² to the squares of e:
 * |t|² h + (|a|² + |b|²) h − 2 b·(t h) + 2 a·(Rᵀt h) − 2 Σ b_i a_j (R h)_ij with t h = p + w and Rᵀt h = p − w */
static inline void soma_row(const number b[3], const number a[3], number c[PRODUCTS]) {
    const number two = number_of(2);
    number size = number_of(0), m[3][3];

    for (int i = 0; i < 3; i++) {
        size = size + a[i] * a[i] + b[i] * b[i];
        for (int j = 0; j < 3; j++) m[i][j] = two * b[i] * a[j];
    }
    c[0] = size - (m[0][0] + m[1][1] + m[2][2]);
    c[1] = size - (m[0][0] - m[1][1] - m[2][2]);
    c[2] = size - (m[1][1] - m[2][2] - m[0][0]);
    c[3] = size - (m[2][2] - m[0][0] - m[1][1]);
    c[4] = two * (m[1][2] - m[2][1]);
    c[5] = two * (m[2][0] - m[0][2]);
    c[6] = two * (m[0][1] - m[1][0]);
    c[7] = -(two * (m[0][1] + m[1][0]));
    c[8] = -(two * (m[0][2] + m[2][0]));
    c[9] = -(two * (m[1][2] + m[2][1]));
    c[SQUARE] = number_of(1);
    for (int k = 0; k < 3; k++) {
        c[SHIFT + k] = two * (a[k] - b[k]);
        c[TWIST + k] = -(two * (a[k] + b[k]));
    }
}

#endif
