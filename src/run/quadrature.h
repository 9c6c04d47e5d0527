/* Peaks and time integrals of a run from moments of it, looks, as they come: of fourth order in their distance. */
#ifndef GOUGH_RUN_QUADRATURE_H
#define GOUGH_RUN_QUADRATURE_H

#include <math.h>

/* looks in the window; weights of the interval in its middle, and of the outer intervals at both ends of a run */
enum { QUADRATURE_ROWS = 4 };
static const double quadrature_middle[QUADRATURE_ROWS] = {-1.0 / 24, 13.0 / 24, 13.0 / 24,
                                                          -1.0 / 24};
static const double quadrature_first[QUADRATURE_ROWS] = {9.0 / 24, 19.0 / 24, -5.0 / 24, 1.0 / 24};
static const double quadrature_last[QUADRATURE_ROWS] = {1.0 / 24, -5.0 / 24, 19.0 / 24, 9.0 / 24};

/* Looks nearer to each other than this part of their time are one: the end of a step and a row that is due there differ by
 * round-off, and a polynomial through both could turn anywhere. */
static const double quadrature_same_time = 1e-11;

/* distances that differ by less, relative, are equal: steps of one length differ by round-off of the times at their ends */
static const double quadrature_even = 1e-9;

/* The polynomial through `count` looks, the last of the window, in s = (t - from)/h, 0 at look a and 1 at look a + 1: the value at
 * look i counts c[i][0] + c[i][1] s + … Returns h. */
static inline double quadrature_fit(const double time[QUADRATURE_ROWS], int count, int a,
                                    double c[QUADRATURE_ROWS][QUADRATURE_ROWS]) {
    const int first = QUADRATURE_ROWS - count;
    const double from = time[a], h = time[a + 1] - from;

    for (int i = 0; i < QUADRATURE_ROWS; i++) {
        /* 1 at look i and 0 at the others */
        for (int k = 0; k < QUADRATURE_ROWS; k++) c[i][k] = k == 0 && i >= first;
        for (int j = first; i >= first && j < QUADRATURE_ROWS; j++) {
            if (j == i) continue;
            const double s = (time[j] - from) / h, scale = h / (time[i] - time[j]);
            for (int k = QUADRATURE_ROWS - 1; k > 0; k--)
                c[i][k] = scale * (c[i][k - 1] - s * c[i][k]);
            c[i][0] = -scale * s * c[i][0];
        }
    }
    return h;
}

/* weights of ∫ of that polynomial from look a to look a + 1 */
static inline void quadrature_weigh(const double time[QUADRATURE_ROWS], int count, int a,
                                    double weight[QUADRATURE_ROWS]) {
    double c[QUADRATURE_ROWS][QUADRATURE_ROWS];
    const double h = quadrature_fit(time, count, a, c);

    for (int i = 0; i < QUADRATURE_ROWS; i++) {
        weight[i] = h * (c[i][0] + c[i][1] / 2 + c[i][2] / 3 + c[i][3] / 4);
    }
}

/* the same for the middle interval of a full window, whose looks mostly are at equal distances */
static inline void quadrature_weigh_middle(const double time[QUADRATURE_ROWS],
                                           double weight[QUADRATURE_ROWS]) {
    const double before = time[1] - time[0], h = time[2] - time[1], after = time[3] - time[2];

    if (fabs(before - h) > quadrature_even * h || fabs(after - h) > quadrature_even * h) {
        quadrature_weigh(time, QUADRATURE_ROWS, 1, weight);
        return;
    }
    for (int i = 0; i < QUADRATURE_ROWS; i++) weight[i] = h * quadrature_middle[i];
}

#endif
