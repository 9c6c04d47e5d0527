/* e^A by the diagonal Padé approximant of order 13 of A/2^s, squared s times. Theory: docs/theory/loop.md. */
#include "linear/exponential.h"

#include <lapacke.h>
#include <math.h>
#include <string.h>

enum { ROWS = EXPONENTIAL_ROWS, ORDER = 13, MOST_SQUARINGS = 1000 };

/* of the numerator p(A) of (loop-7), divided by 13!: p = Σ b_k A^k, the denominator p(−A) */
static const double b[ORDER + 1] = {64764752532480000.0,
                                    32382376266240000.0,
                                    7771770303897600.0,
                                    1187353796428800.0,
                                    129060195264000.0,
                                    10559470521600.0,
                                    670442572800.0,
                                    33522128640.0,
                                    1323241920.0,
                                    40840800.0,
                                    960960.0,
                                    16380.0,
                                    182.0,
                                    1.0};

/* the 1-norm below which the approximant is exact to rounding (Higham 2005) */
static const double greatest_norm = 5.371920351148152;

typedef double square[ROWS * ROWS];

static void multiply(int n, const double *x, const double *y, double *out) {
    memset(out, 0, (size_t)(n * n) * sizeof *out);
    for (int i = 0; i < n; i++) {
        for (int k = 0; k < n; k++) {
            for (int j = 0; j < n; j++) out[n * i + j] += x[n * i + k] * y[n * k + j];
        }
    }
}

static double norm(int n, const double *A) {
    double largest = 0;

    for (int j = 0; j < n; j++) {
        double sum = 0;
        for (int i = 0; i < n; i++) sum += fabs(A[n * i + j]);
        if (!(sum <= largest)) largest = sum; /* NaN stays */
    }
    return largest;
}

/* c₀ 1 + c₂ A² + c₄ A⁴ + c₆ A⁶; every other coefficient */
static void combine(int n, const double *c, double power[3][ROWS * ROWS], double *out) {
    for (int i = 0; i < n * n; i++) {
        out[i] = c[2] * power[0][i] + c[4] * power[1][i] + c[6] * power[2][i];
        if (i % (n + 1) == 0) out[i] += c[0];
    }
}

/* odd and even part of p(A): A (A⁶ (b₁₃A⁶ + b₁₁A⁴ + b₉A²) + b₇A⁶ + … + b₁) and the like */
static void parts(int n, const double *A, double *odd, double *even) {
    const double high_odd[7] = {[2] = b[9], [4] = b[11], [6] = b[ORDER]};
    const double high_even[7] = {[2] = b[8], [4] = b[10], [6] = b[ORDER - 1]};
    double power[3][ROWS * ROWS];
    square high, low;

    multiply(n, A, A, power[0]);
    multiply(n, power[0], power[0], power[1]);
    multiply(n, power[0], power[1], power[2]);

    combine(n, high_odd, power, high);
    multiply(n, power[2], high, low);
    combine(n, b + 1, power, high);
    for (int i = 0; i < n * n; i++) low[i] += high[i];
    multiply(n, A, low, odd);

    combine(n, high_even, power, high);
    multiply(n, power[2], high, low);
    combine(n, b, power, even);
    for (int i = 0; i < n * n; i++) even[i] += low[i];
}

bool exponential(int n, const double *A, double *out, bool *unsolved) {
    const double size = norm(n, A);
    int squarings = 0;
    square scaled = {0}, odd, even, above;
    lapack_int pivot[ROWS];

    *unsolved = false;
    if (!isfinite(size)) return false;
    if (size > greatest_norm) squarings = (int)ceil(log2(size / greatest_norm));
    if (squarings > MOST_SQUARINGS) return false;
    for (int i = 0; i < n * n; i++) scaled[i] = ldexp(A[i], -squarings);

    /* (even − odd) e^A = even + odd, which holds as well for columns taken as rows: both are polynomials of A */
    parts(n, scaled, odd, even);
    for (int i = 0; i < n * n; i++) {
        above[i] = even[i] + odd[i];
        even[i] -= odd[i];
    }
    *unsolved = LAPACKE_dgesv_work(LAPACK_COL_MAJOR, n, n, even, n, pivot, above, n) != 0;
    for (int i = 0; i < n * n; i++) *unsolved |= !isfinite(above[i]);
    if (*unsolved) return false;
    for (int k = 0; k < squarings; k++) {
        multiply(n, above, above, odd);
        memcpy(above, odd, (size_t)(n * n) * sizeof *above);
    }
    memcpy(out, above, (size_t)(n * n) * sizeof *out);
    for (int i = 0; i < n * n; i++) {
        if (!isfinite(out[i])) return false;
    }
    return true;
}
