/* The exponential of a matrix: against closed forms and its own identities. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "linear/exponential.h"
#include "support/random.h"
#include "support/suite.h"

enum { ROWS = EXPONENTIAL_ROWS };

static void near(double found, double right, double tolerance, const char *what) {
    ck_assert_msg(fabs(found - right) <= tolerance, "%s: %.17g, not %.17g", what, found, right);
}

static bool of_matrix(int n, const double *A, double *out) {
    bool unsolved = true;
    const bool made = exponential(n, A, out, &unsolved);
    ck_assert(!unsolved);
    return made;
}

START_TEST(exponential_of_a_diagonal) {
    const double value[4] = {-40, -1e-9, 0.3, 12};
    double A[16] = {0}, out[16];

    for (int i = 0; i < 4; i++) A[5 * i] = value[i];
    ck_assert(of_matrix(4, A, out));
    for (int i = 0; i < 16; i++) {
        const double right = i % 5 == 0 ? exp(value[i / 5]) : 0;
        near(out[i], right, 1e-13 * right, "element"); /* 40 ε, squared */
    }
}
END_TEST

/* [0 1; s 0] t: cosh and sinh, or cos and sin */
START_TEST(exponential_of_one_mode) {
    dice d = {1};

    for (int k = 0; k < 200; k++) {
        const double rate = pow(10, dice_between(&d, -3, 1.3)), sign = k % 2 ? 1 : -1;
        const double A[4] = {0, 1, sign * rate * rate, 0};
        const double C = sign > 0 ? cosh(rate) : cos(rate), S = sign > 0 ? sinh(rate) : sin(rate);
        const double right[4] = {C, S / rate, sign * rate * S, C};
        const double size = (1 + rate) * (sign > 0 ? cosh(rate) : 1);
        double out[4];

        ck_assert(of_matrix(2, A, out));
        /* squarings multiply the rounding by the size of A, which is that of its square here */
        for (int i = 0; i < 4; i++)
            near(out[i], right[i], 1e-15 * (1 + rate * rate) * size, "mode");
    }
}
END_TEST

/* of a shift, whose powers end: columns are 1/k! */
START_TEST(exponential_of_a_shift) {
    double A[ROWS * ROWS] = {0}, out[ROWS * ROWS];

    for (int i = 0; i + 1 < ROWS; i++) A[ROWS * i + i + 1] = 1;
    ck_assert(of_matrix(ROWS, A, out));
    for (int i = 0; i < ROWS; i++) {
        for (int j = 0; j < ROWS; j++) {
            const double right = j < i ? 0 : 1 / tgamma(j - i + 1);
            near(out[ROWS * i + j], right, 1e-15, "shift");
        }
    }
}
END_TEST

/* e^A e^−A = 1 and e^A = (e^{A/2})², with matrices that are not normal */
START_TEST(exponentials_multiply) {
    dice d = {2};

    for (int k = 0; k < 40; k++) {
        const int n = 2 + k % 20;
        double A[ROWS * ROWS], minus[ROWS * ROWS], half[ROWS * ROWS], e[3][ROWS * ROWS];
        double size[2] = {0, 0};

        for (int i = 0; i < n * n; i++) {
            A[i] = dice_between(&d, -1, 1);
            minus[i] = -A[i];
            half[i] = A[i] / 2;
        }
        ck_assert(of_matrix(n, A, e[0]) && of_matrix(n, minus, e[1]) && of_matrix(n, half, e[2]));
        for (int i = 0; i < n * n; i++) {
            size[0] = fmax(size[0], fabs(e[0][i]) * fabs(e[1][i]));
            size[1] = fmax(size[1], fabs(e[0][i]));
        }
        for (int i = 0; i < n; i++) {
            for (int j = 0; j < n; j++) {
                double one = 0, square = 0;
                for (int m = 0; m < n; m++) {
                    one += e[0][n * i + m] * e[1][n * m + j];
                    square += e[2][n * i + m] * e[2][n * m + j];
                }
                near(one, i == j, 1e-12 * (1 + size[0]), "e^A e^-A");
                near(square, e[0][n * i + j], 1e-13 * (1 + size[1]), "square");
            }
        }
    }
}
END_TEST

START_TEST(exponential_refuses_what_is_not_finite) {
    double A[4] = {0, NAN, 0, 0}, out[4];

    ck_assert(!of_matrix(2, A, out));
    A[1] = INFINITY;
    ck_assert(!of_matrix(2, A, out));
    A[1] = 0, A[0] = 1e4;
    ck_assert(!of_matrix(2, A, out));
    A[0] = -1e4;
    ck_assert(of_matrix(2, A, out));
    near(out[0], 0, 0, "e^-10000");
}
END_TEST

int main(void) {
    return SUITE_RUN("linear/exponential", 10, exponential_of_a_diagonal, exponential_of_one_mode,
                     exponential_of_a_shift, exponentials_multiply,
                     exponential_refuses_what_is_not_finite);
}
