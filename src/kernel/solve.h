/* Six linear equations, and how near they are to singular; without a branch on a number, so that each lane pivots for itself. */
#ifndef GOUGH_KERNEL_SOLVE_H
#define GOUGH_KERNEL_SOLVE_H

#include "kernel/number.h"

typedef struct {
    number determinant;
    number
        pivot_ratio; /* smallest over largest pivot in magnitude: a cheap sign of trouble, not the condition */
} elimination;

/* largest entry of column c, rows from c on, into row c by exchanges; the right-hand sides go along. Changes `sign` with each. */
KERNEL_INLINE void solve_pivot(number a[6][6], number b[][6], int count, int c, number *sign) {
    KERNEL_UNROLL
    for (int r = c + 1; r < 6; r++) {
        const mask larger = number_greater(number_magnitude(a[r][c]), number_magnitude(a[c][c]));
        KERNEL_UNROLL
        for (int k = c; k < 6; k++) {
            const number x = a[c][k], y = a[r][k];
            a[c][k] = number_select(larger, y, x);
            a[r][k] = number_select(larger, x, y);
        }
        for (int k = 0; k < count; k++) {
            const number x = b[k][c], y = b[k][r];
            b[k][c] = number_select(larger, y, x);
            b[k][r] = number_select(larger, x, y);
        }
        *sign = number_select(larger, -*sign, *sign);
    }
}

/* solve_six() for a count known where it is compiled */
KERNEL_INLINE elimination solve_counted(number a[6][6], number b[][6], int count) {
    const number one = number_of(1);
    number sign = one, least, most;
    elimination result;

    KERNEL_UNROLL
    for (int c = 0; c < 6; c++) {
        solve_pivot(a, b, count, c, &sign);
        /* a column without a pivot is passed over: the determinant is then 0, not the NaN of ∞ · 0 */
        const mask pivoted = number_greater(number_magnitude(a[c][c]), number_of(0));
        const number inverse =
            number_select(pivoted, one / number_select(pivoted, a[c][c], one), number_of(0));
        KERNEL_UNROLL
        for (int r = c + 1; r < 6; r++) {
            const number factor = a[r][c] * inverse;
            KERNEL_UNROLL
            for (int k = c + 1; k < 6; k++) a[r][k] = a[r][k] - factor * a[c][k];
            for (int k = 0; k < count; k++) b[k][r] = b[k][r] - factor * b[k][c];
        }
    }

    result.determinant = sign * a[0][0];
    least = most = number_magnitude(a[0][0]);
    KERNEL_UNROLL
    for (int c = 1; c < 6; c++) {
        const number pivot = number_magnitude(a[c][c]);
        result.determinant = result.determinant * a[c][c];
        least = number_select(number_greater(least, pivot), pivot, least);
        most = number_larger(most, pivot);
    }
    result.pivot_ratio = least / most;

    for (int k = 0; k < count; k++) {
        KERNEL_UNROLL
        for (int r = 5; r >= 0; r--) {
            KERNEL_UNROLL
            for (int c = r + 1; c < 6; c++) b[k][r] = b[k][r] - a[r][c] * b[k][c];
            b[k][r] = b[k][r] / a[r][r];
        }
    }
    return result;
}

/* a x = b by Gaussian elimination with partial pivoting, for `count` right-hand sides b[r], which become the solutions;
 * a is destroyed. A singular matrix gives determinant 0 and solutions that are not finite. */
KERNEL_APART elimination solve_six(number a[6][6], number b[][6], int count) {
    switch (count) {
    case 0:
        return solve_counted(a, b, 0);
    case 1:
        return solve_counted(a, b, 1);
    default:
        return solve_counted(a, b, count);
    }
}

/* A symmetric positive definite matrix, of which the lower triangle is read, as L D Lᵀ without pivots: no branch, and no pivot
 * below the least eigenvalue. L goes above the diagonal, transposed; inverse: 1/D. */
KERNEL_INLINE void factor_definite(number a[6][6], number inverse[6]) {
    KERNEL_UNROLL
    for (int c = 0; c < 6; c++) {
        inverse[c] = number_of(1) / a[c][c];
        KERNEL_UNROLL
        for (int r = c + 1; r < 6; r++) {
            const number factor = a[r][c] * inverse[c];
            KERNEL_UNROLL
            for (int k = r; k < 6; k++) a[k][r] = a[k][r] - a[k][c] * factor;
            a[c][r] = factor;
        }
    }
}

/* b becomes the solution of the equations so factored */
KERNEL_INLINE void solve_factored(number a[6][6], const number inverse[6], number b[6]) {
    KERNEL_UNROLL
    for (int c = 0; c < 6; c++) {
        KERNEL_UNROLL
        for (int r = c + 1; r < 6; r++) b[r] = b[r] - a[c][r] * b[c];
    }
    KERNEL_UNROLL
    for (int r = 5; r >= 0; r--) {
        b[r] = b[r] * inverse[r];
        KERNEL_UNROLL
        for (int c = r + 1; c < 6; c++) b[r] = b[r] - a[r][c] * b[c];
    }
}

/* a x = b for a symmetric positive definite matrix; b becomes the solution and a is destroyed */
KERNEL_INLINE void solve_definite(number a[6][6], number b[6]) {
    number inverse[6];

    factor_definite(a, inverse);
    solve_factored(a, inverse, b);
}

/* Makes columns p and q of a matrix orthogonal by a rotation, in the lanes that want it. Returns 1 in lanes where they were not
 * orthogonal to round-off, else 0. */
static inline number jacobi_rotate(number a[6][6], int p, int q, mask wanted) {
    const number zero = number_of(0), one = number_of(1), four = number_of(4), two = number_of(2);
    const number round_off = number_of_real(REAL_EPSILON * REAL_EPSILON);
    number pp = zero, qq = zero, pq = zero;

    for (int r = 0; r < 6; r++) {
        pp = pp + a[r][p] * a[r][p];
        qq = qq + a[r][q] * a[r][q];
        pq = pq + a[r][p] * a[r][q];
    }

    /* tan of the angle; 0 where they are orthogonal, or the lane is done */
    const number d = qq - pp, root = number_root(d * d + four * pq * pq);
    const number below = number_magnitude(d) + root;
    const number above = two * number_select(number_greater(zero, d), -pq, pq);
    const mask turned = number_greater(below, zero);
    const number tangent = number_select(turned, above / number_select(turned, below, one), zero);
    const number t = number_select(wanted, tangent, zero);
    const number c = one / number_root(one + t * t), s = c * t;

    for (int r = 0; r < 6; r++) {
        const number x = a[r][p], y = a[r][q];
        a[r][p] = c * x - s * y;
        a[r][q] = s * x + c * y;
    }
    return number_select(number_greater(pq * pq, round_off * pp * qq), one, zero);
}

/* Largest and smallest singular value of a 6×6 matrix by one-sided Jacobi rotations of its columns; a is destroyed. Six to ten
 * sweeps leave the columns orthogonal to round-off; a lane that is there is left alone. */
static inline void singular_values(number a[6][6], number *largest, number *smallest) {
    const number zero = number_of(0), half = number_of(0.5);
    number high = zero, low = zero, left = number_of(1);

    for (int sweep = 0; sweep < 8 + 2 * NUMBER_SWEEPS; sweep++) {
        const mask wanted = number_greater(left, half);
        if (!number_any(wanted)) break;
        left = zero;
        for (int p = 0; p < 5; p++) {
            for (int q = p + 1; q < 6; q++) left = left + jacobi_rotate(a, p, q, wanted);
        }
    }
    for (int c = 0; c < 6; c++) {
        number square = zero;
        for (int r = 0; r < 6; r++) square = square + a[r][c] * a[r][c];
        const number value = number_root(square);
        high = number_larger(high, value);
        low = c == 0 ? value : number_select(number_greater(low, value), value, low);
    }
    *largest = high;
    *smallest = low;
}

#endif
