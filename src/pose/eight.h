/* Eight linear equations for the unknowns of a pose: elimination that is kept, so that right-hand sides can follow one after the
 * other; without a branch on a number, so that each lane pivots for itself. */
#ifndef GOUGH_POSE_EIGHT_H
#define GOUGH_POSE_EIGHT_H

#include "pose/soma.h"

typedef struct {
    scalar a[SOMA][SOMA]; /* L below the diagonal, U from it on */
    scalar inverse[SOMA]; /* of the pivots */
    mask exchange[SOMA]
                 [SOMA]; /* [c][r]: rows c and r were exchanged before column c was eliminated */
} eight;

/* what is exchanged where the mask says so */
KERNEL_INLINE void eight_exchange(mask m, scalar *a, scalar *b) {
    const scalar x = *a, y = *b;

    *a = scalar_select(m, y, x);
    *b = scalar_select(m, x, y);
}

/* P a = L U by elimination with the largest pivots, in place. A singular matrix gives solutions that are not finite. */
KERNEL_INLINE void eight_factor(eight *f) {
    for (int c = 0; c < SOMA; c++) {
        for (int r = c + 1; r < SOMA; r++) {
            f->exchange[c][r] = number_greater(magnitude(f->a[r][c]), magnitude(f->a[c][c]));
            KERNEL_UNROLL
            for (int k = 0; k < SOMA; k++)
                eight_exchange(f->exchange[c][r], &f->a[c][k], &f->a[r][k]);
        }
        f->inverse[c] = reciprocal(f->a[c][c]);
        for (int r = c + 1; r < SOMA; r++) {
            const scalar factor = times(f->a[r][c], f->inverse[c]);
            f->a[r][c] = factor;
            for (int k = c + 1; k < SOMA; k++)
                f->a[r][k] = minus(f->a[r][k], times(factor, f->a[c][k]));
        }
    }
}

/* b becomes the solution. All exchanges first: those of a column also moved the factors of the columns before it. */
KERNEL_INLINE void eight_solve(const eight *f, scalar b[SOMA]) {
    for (int c = 0; c < SOMA - 1; c++) {
        for (int r = c + 1; r < SOMA; r++) eight_exchange(f->exchange[c][r], &b[c], &b[r]);
    }
    for (int r = 1; r < SOMA; r++) {
        for (int k = 0; k < r; k++) b[r] = minus(b[r], times(f->a[r][k], b[k]));
    }
    for (int r = SOMA - 1; r >= 0; r--) {
        for (int k = r + 1; k < SOMA; k++) b[r] = minus(b[r], times(f->a[r][k], b[k]));
        b[r] = times(b[r], f->inverse[r]);
    }
}

/* Y of the inverse, by columns of the unit matrix */
KERNEL_INLINE void eight_invert(const eight *f, scalar Y[SOMA][SOMA]) {
    for (int c = 0; c < SOMA; c++) {
        scalar b[SOMA];
        for (int r = 0; r < SOMA; r++) b[r] = scalar_of(number_of(r == c));
        eight_solve(f, b);
        for (int r = 0; r < SOMA; r++) Y[r][c] = b[r];
    }
}

#endif
