/* The nearest rates within bounds, by active sets. Theory: docs/theory/cueing.md. */
#define NUMBER_DOUBLE
#include "cueing/nearest_rates.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "kernel/solve.h"

/* Each change of the set lowers what is minimised, so that no set comes twice; 64 are never needed in six unknowns but for
 * rounding, and then y keeps the bounds all the same. */
enum { MOST_CHANGES = 64 };

typedef struct problem {
    double (*H)[RATES];
    const double *wanted, *least, *greatest;
    bool held[RATES]; /* at one of its bounds */
    double *y;
} problem;

static double slope(const problem *p, int row) {
    double sum = 0;
    for (int c = 0; c < RATES; c++) sum += p->H[row][c] * (p->y[c] - p->wanted[c]);
    return sum;
}

/* from y to the minimum over those that are not held */
static void way(const problem *p, double step[RATES]) {
    double a[RATES][RATES], b[1][RATES];
    for (int r = 0; r < RATES; r++) {
        for (int c = 0; c < RATES; c++) a[r][c] = p->held[r] || p->held[c] ? (r == c) : p->H[r][c];
        b[0][r] = p->held[r] ? 0 : -slope(p, r);
    }
    (void)solve_six(a, b, 1);
    memcpy(step, b[0], sizeof b[0]);
}

/* the part of the way up to the first bound, and whose it is; −1: all of it */
static double first_bound(const problem *p, const double step[RATES], int *whose) {
    double part = 1;
    *whose = -1;
    for (int i = 0; i < RATES; i++) {
        if (p->held[i] || !(fabs(step[i]) > 0)) continue;
        const double room = (step[i] > 0 ? p->greatest[i] : p->least[i]) - p->y[i];
        if (room / step[i] < part) part = fmax(0, room / step[i]), *whose = i;
    }
    return part;
}

/* the one of those held that leads inwards most; −1: none */
static int to_release(const problem *p) {
    int best = -1;
    double steepest = 0;
    for (int i = 0; i < RATES; i++) {
        if (!p->held[i] || !(p->greatest[i] > p->least[i])) continue;
        double size = 0;
        for (int c = 0; c < RATES; c++) size += fabs(p->H[i][c] * (p->y[c] - p->wanted[c]));
        const double inwards = p->y[i] > p->least[i] ? slope(p, i) : -slope(p, i);
        if (inwards > 16 * DBL_EPSILON * size && inwards > steepest * sqrt(p->H[i][i]))
            best = i, steepest = inwards / sqrt(p->H[i][i]);
    }
    return best;
}

void nearest_rates(double H[RATES][RATES], const double wanted[RATES], const double least[RATES],
                   const double greatest[RATES], double y[RATES]) {
    problem p = {.H = H, .wanted = wanted, .least = least, .greatest = greatest, .y = y};
    for (int i = 0; i < RATES; i++) {
        y[i] = fmin(greatest[i], fmax(least[i], wanted[i]));
        p.held[i] = wanted[i] < least[i] || wanted[i] > greatest[i];
    }
    for (int change = 0; change < MOST_CHANGES; change++) {
        double step[RATES];
        int whose;
        way(&p, step);
        const double part = first_bound(&p, step, &whose);
        for (int i = 0; i < RATES; i++)
            y[i] = fmin(greatest[i], fmax(least[i], y[i] + part * step[i]));
        if (whose >= 0) {
            y[whose] = step[whose] > 0 ? greatest[whose] : least[whose];
            p.held[whose] = true;
            continue;
        }
        const int release = to_release(&p);
        if (release < 0) return;
        p.held[release] = false;
    }
}
