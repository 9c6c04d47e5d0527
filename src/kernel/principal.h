/* Principal axes of a symmetric 3×3 matrix by cyclic Jacobi rotations, (body-2): inertia = axes
 * · diag(moments) · axesᵀ. A number text: include number.h for the type first. */
#ifndef GOUGH_KERNEL_PRINCIPAL_H
#define GOUGH_KERNEL_PRINCIPAL_H

#include "kernel/number.h"

/* Jacobi's error squares with every sweep once it is small: six sweeps are ample for 33 digits,
 * the rest is margin for badly scaled matrices. */
enum { PRINCIPAL_SWEEPS = 12 };

/* One rotation in the plane (p, q) that makes a[p][q] vanish; r is the third index. */
static inline void principal_rotate(number a[3][3], number axes[3][3], int p, int q, int r) {
    const number zero = number_of(0), one = number_of(1);

    /* tan φ = 2 a_pq / (d ± √(d² + 4 a_pq²)), d = a_qq − a_pp, the smaller root; scaled, so that
     * no square overflows */
    const number d = a[q][q] - a[p][p], b = a[p][q] + a[p][q];
    const number size = number_larger(number_magnitude(d), number_magnitude(b));
    const number scale = number_select(number_greater(size, zero), size, one);
    const number ds = d / scale, bs = b / scale;
    const number root = number_root(ds * ds + bs * bs);
    const number below = ds + number_select(number_greater(zero, d), -root, root);
    const number safe = number_select(number_greater(number_magnitude(below), zero), below, one);
    const number t = bs / safe;
    const number c = one / number_root(one + t * t), s = t * c;

    /* the rotated matrix; a vanishing a_pq gives t = 0 and leaves every number untouched */
    a[p][p] = a[p][p] - t * a[p][q];
    a[q][q] = a[q][q] + t * a[p][q];
    a[p][q] = a[q][p] = zero;
    const number rp = a[r][p], rq = a[r][q];
    a[r][p] = a[p][r] = c * rp - s * rq;
    a[r][q] = a[q][r] = s * rp + c * rq;

    for (int i = 0; i < 3; i++) {
        const number ip = axes[i][p], iq = axes[i][q];
        axes[i][p] = c * ip - s * iq;
        axes[i][q] = s * ip + c * iq;
    }
}

/* Columns of axes are the principal axes, right-handed, in the order in which they lie nearest
 * the given ones; a diagonal matrix gives exactly the identity and its own diagonal. Only the
 * upper triangle of inertia is read. */
static inline void principal_axes(number inertia[3][3], number axes[3][3], number moments[3]) {
    number a[3][3];
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            a[i][j] = i < j ? inertia[i][j] : inertia[j][i];
            axes[i][j] = number_of(i == j);
        }
    }

    for (int sweep = 0; sweep < PRINCIPAL_SWEEPS; sweep++) {
        principal_rotate(a, axes, 0, 1, 2);
        principal_rotate(a, axes, 1, 2, 0);
        principal_rotate(a, axes, 0, 2, 1);
    }

    for (int i = 0; i < 3; i++) moments[i] = a[i][i];
}

#endif
