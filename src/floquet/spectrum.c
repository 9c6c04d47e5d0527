/* Multipliers by orthogonal iteration through the factors: it separates what grows from what dies out, so that the small ones are
 * not lost in the rounding of the large ones; the eigenvalues of what is left by LAPACK. Theory: docs/theory/floquet.md. */
#include "floquet/spectrum.h"

#include <lapacke.h>
#include <math.h>
#include <string.h>

enum { SWEEPS = 40, WORK = 34 };

/* what is left of an earlier subspace in a later one, below which they are apart: rounding of the sweeps */
static const double apart = 1e-12;

/* magnitudes this close are ordered by their argument, which rounding does not change */
static const double same_magnitude = 1e-9;

/* Z = Q R by Gram and Schmidt's method, twice for orthogonality to rounding; R's diagonal is positive */
static void orthogonalise(int n, const double *z, double *q, double *r) {
    memset(r, 0, (size_t)(n * n) * sizeof *r);
    memcpy(q, z, (size_t)(n * n) * sizeof *q);
    for (int k = 0; k < n; k++) {
        double *column = q + k * n, square = 0;
        for (int sweep = 0; sweep < 2; sweep++) {
            for (int j = 0; j < k; j++) {
                double dot = 0;
                for (int i = 0; i < n; i++) dot += q[j * n + i] * column[i];
                for (int i = 0; i < n; i++) column[i] -= dot * q[j * n + i];
                r[k * n + j] += dot;
            }
        }
        for (int i = 0; i < n; i++) square += column[i] * column[i];
        r[k * n + k] = sqrt(square);
        if (!(r[k * n + k] > 0)) continue; /* nothing is left of it */
        for (int i = 0; i < n; i++) column[i] /= r[k * n + k];
    }
}

/* Q through all factors once: Q' R = Φ Q with R the product of the triangles; returns Σ log of their diagonals */
static double sweep(const double *factor, size_t stride, int n, size_t count, double *q,
                    double *triangle) {
    double z[MONODROMY_SIZE], r[MONODROMY_SIZE], before[MONODROMY_SIZE], sum = 0;

    for (int i = 0; i < n * n; i++) triangle[i] = i % (n + 1) == 0;
    for (size_t part = 0; part < count; part++) {
        monodromy_multiply(n, factor + part * stride, q, z);
        orthogonalise(n, z, q, r);
        for (int k = 0; k < n; k++) sum += log(r[k * (n + 1)]);
        memcpy(before, triangle, (size_t)(n * n) * sizeof *before);
        monodromy_multiply(n, r, before, triangle);
    }
    return sum;
}

/* T = Qᵀ Q' R: the product seen in Q. Where subspaces have come apart, the orthogonal Qᵀ Q' is 0 in both of its corners but for
 * rounding, which must not multiply the large numbers of R into the place of small ones */
static void in_frame(int n, const double *q, const double *after, const double *triangle,
                     double *t) {
    double w[MONODROMY_SIZE];

    for (int j = 0; j < n; j++) {
        for (int i = 0; i < n; i++) {
            double dot = 0;
            for (int k = 0; k < n; k++) dot += q[i * n + k] * after[j * n + k];
            w[j * n + i] = dot;
        }
    }
    for (int split = 1; split < n; split++) {
        double left = 0;
        for (int j = 0; j < split; j++)
            for (int i = split; i < n; i++) left = fmax(left, fabs(w[j * n + i]));
        if (!(left <= apart)) continue;
        for (int j = 0; j < split; j++)
            for (int i = split; i < n; i++) w[j * n + i] = w[i * n + j] = 0;
    }
    monodromy_multiply(n, w, triangle, t);
}

static bool finite(int count, const double *a) {
    double sum = 0;

    for (int i = 0; i < count; i++) sum += a[i] - a[i];
    return sum <= 0;
}

/* whether a comes after b: by falling magnitude, then by rising argument, the upper half plane first */
static bool later(double complex a, double complex b) {
    const double x = cabs(a), y = cabs(b);

    if (fabs(x - y) > same_magnitude * (x + y)) return x < y;
    if (fabs(creal(a) - creal(b)) > same_magnitude * (x + y)) return creal(a) < creal(b);
    return cimag(a) < cimag(b);
}

static void sort(spectrum *s) {
    for (int i = 1; i < s->n; i++) {
        for (int k = i; k > 0 && later(s->value[k - 1], s->value[k]); k--) {
            const double complex value = s->value[k];
            double complex vector[MONODROMY_ROWS];
            memcpy(vector, s->vector[k], sizeof vector);
            s->value[k] = s->value[k - 1];
            memcpy(s->vector[k], s->vector[k - 1], sizeof vector);
            s->value[k - 1] = value;
            memcpy(s->vector[k - 1], vector, sizeof vector);
        }
    }
}

/* eigenvalue k and its vector from LAPACK's real form: of a pair, the columns k and k + 1 are real and imaginary part */
static void take(spectrum *s, int k, const double *q, const double *re, const double *im,
                 const double *v) {
    const int n = s->n, first = im[k] < 0 ? k - 1 : k, second = first + 1;
    const double sign = im[k] < 0 ? -1 : 1;

    s->value[k] = re[k] + I * im[k];
    for (int i = 0; i < n; i++) {
        double complex sum = 0;
        for (int j = 0; j < n; j++) {
            double complex entry = v[first * n + j];
            if (fabs(im[k]) > 0) entry += I * sign * v[second * n + j];
            sum += q[j * n + i] * entry;
        }
        s->vector[k][i] = sum;
    }
}

gough_status spectrum_of_factors(const double *factor, size_t stride, int n, size_t count,
                                 int sweeps, spectrum *s, gough_error *error) {
    double q[MONODROMY_SIZE], after[MONODROMY_SIZE], triangle[MONODROMY_SIZE], t[MONODROMY_SIZE];
    double re[MONODROMY_ROWS], im[MONODROMY_ROWS], v[MONODROMY_SIZE], none[1],
        work[WORK * MONODROMY_ROWS];

    s->n = n;
    for (int i = 0; i < n * n; i++) after[i] = i % (n + 1) == 0;
    for (int i = 0; i < sweeps; i++) {
        memcpy(q, after, (size_t)(n * n) * sizeof *q);
        s->log_determinant = sweep(factor, stride, n, count, after, triangle);
    }
    in_frame(n, q, after, triangle, t);
    if (!finite(n * n, t))
        return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                          "the deviations grow beyond the range of numbers within one period, so "
                          "there are no multipliers");
    const bool solved = LAPACKE_dgeev_work(LAPACK_COL_MAJOR, 'N', 'V', n, t, n, re, im, none, 1, v,
                                           n, work, WORK * n) == 0;
    if (!solved || !finite(n, re) || !finite(n, im) || !finite(n * n, v))
        return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                          "could not compute the multipliers: LAPACK did not solve their problem");
    for (int k = 0; k < n; k++) take(s, k, q, re, im, v);
    sort(s);
    return GOUGH_OK;
}

gough_status spectrum_of(const monodromy *m, spectrum *s, gough_error *error) {
    return spectrum_of_factors(m->factor[0], MONODROMY_SIZE, m->n, (size_t)m->parts, SWEEPS, s,
                               error);
}

double spectrum_pair_defect(const spectrum *s) {
    bool taken[MONODROMY_ROWS] = {false};
    double worst = 0;

    for (int i = 0; i < s->n; i++) {
        double best = INFINITY;
        int partner = -1;
        if (taken[i]) continue;
        for (int j = i + 1; j < s->n; j++) {
            const double defect = cabs(s->value[i] * s->value[j] - 1);
            if (taken[j] || !(defect < best)) continue;
            best = defect;
            partner = j;
        }
        if (partner >= 0) taken[partner] = true;
        worst = fmax(worst, best);
    }
    return worst;
}
