/* Singular values of a 6 × 6 matrix. */
#ifndef GOUGH_CLI_SINGULAR_VALUES_H
#define GOUGH_CLI_SINGULAR_VALUES_H

/* In no order. V has the directions as its columns, in the order of the values; A becomes A V. */
void singular_values(double A[6][6], double V[6][6], double value[6]);

#endif
