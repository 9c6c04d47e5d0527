/* Singular values of a 6 × 6 matrix by one-sided Jacobi: rotations V make the columns of A V orthogonal, whose lengths they are. */
#include "cli/check/singular_values.h"

#include <math.h>

/* Makes columns p and q of A orthogonal by a rotation, which V takes along. */
static void orthogonalise(double A[6][6], double V[6][6], int p, int q) {
    double pp = 0, qq = 0, pq = 0;
    for (int i = 0; i < 6; i++) {
        pp += A[i][p] * A[i][p];
        qq += A[i][q] * A[i][q];
        pq += A[i][p] * A[i][q];
    }
    if (!(fabs(pq) > 1e-17 * sqrt(pp * qq))) return;

    /* tan 2θ = 2pq/(pp − qq), the smaller angle */
    const double zeta = (qq - pp) / (2 * pq);
    const double tangent = copysign(1 / (fabs(zeta) + sqrt(1 + zeta * zeta)), zeta);
    const double cosine = 1 / sqrt(1 + tangent * tangent), sine = cosine * tangent;
    for (int i = 0; i < 6; i++) {
        const double a = A[i][p], v = V[i][p];
        A[i][p] = cosine * a - sine * A[i][q];
        A[i][q] = sine * a + cosine * A[i][q];
        V[i][p] = cosine * v - sine * V[i][q];
        V[i][q] = sine * v + cosine * V[i][q];
    }
}

void singular_values(double A[6][6], double V[6][6], double value[6]) {
    enum { SWEEPS = 30 }; /* quadratic: six or seven do for any 6 × 6 */
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++) V[i][j] = i == j;
    for (int sweep = 0; sweep < SWEEPS; sweep++)
        for (int p = 0; p < 5; p++)
            for (int q = p + 1; q < 6; q++) orthogonalise(A, V, p, q);
    for (int j = 0; j < 6; j++) {
        double square = 0;
        for (int i = 0; i < 6; i++) square += A[i][j] * A[i][j];
        value[j] = sqrt(square);
    }
}
