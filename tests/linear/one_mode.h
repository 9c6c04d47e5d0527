/* Six modes that know nothing of each other, one for each leg, ẍ = λ²x + u: a plant for tests of sampled loops. */
#ifndef TESTS_LINEAR_ONE_MODE_H
#define TESTS_LINEAR_ONE_MODE_H

#include <check.h>
#include <math.h>
#include <string.h>

#include "linear/sampled.h"

/* square: λ² of each, less than 0 for one that oscillates */
static inline void modes_plant(const double square[6], sampled_plant *p) {
    memset(p, 0, sizeof *p);
    p->n = GOUGH_LINEAR;
    for (int v = 0; v < 6; v++) {
        p->A[v][6 + v] = p->B[6 + v][v] = p->J[v][v] = p->mass[v][v] = 1;
        p->A[6 + v][v] = square[v];
    }
}

/* a lag of first order in each */
static inline void modes_lag(double time_constant, sampled_plant *p) {
    p->n = GOUGH_LINEAR + 6;
    for (int v = 0; v < 6; v++) {
        p->A[6 + v][12 + v] = 1;
        p->A[12 + v][12 + v] = -1 / time_constant;
        p->B[6 + v][v] = 0;
        p->B[12 + v][v] = 1 / time_constant;
    }
}

/* the map of mode v alone, whose numbers are every sixth; nothing may join it to the others */
static inline void mode_map(const sampled_map *all, int v, sampled_map *one) {
    double across = 0; /* each assertion is written to a file: one for all */

    one->n = all->n / 6;
    for (int i = 0; i < all->n; i++) {
        if (i % 6 != v) continue;
        for (int j = 0; j < all->n; j++) {
            const double element = all->matrix[all->n * i + j];
            if (j % 6 == v)
                one->matrix[one->n * (i / 6) + j / 6] = element;
            else
                across = fmax(across, fabs(element));
        }
    }
    ck_assert(across <= 0);
}

/* the map of a controller with a gain for each mode, over a period with a delay */
static inline void modes_map(const sampled_plant *p, const gough_control *control,
                             sampled_map *all) {
    const gough_sampling *s = &control->sampling;
    sampled_step step;
    sampled_law law;

    ck_assert(sampled_delay_fits(s->period, s->delay) &&
              sampled_step_of(p, s->period, s->delay, &step));
    sampled_law_of(control, &law);
    sampled_map_of(p, &step, &law, all);
}

/* det(z − M) at a real z, by elimination with pivots */
static inline double characteristic(const sampled_map *map, double z) {
    const int n = map->n;
    double a[32][32], det = 1;

    ck_assert(n <= 32);
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++) a[i][j] = (i == j ? z : 0) - map->matrix[n * i + j];
    }
    for (int k = 0; k < n; k++) {
        int pivot = k;
        for (int i = k + 1; i < n; i++)
            if (fabs(a[i][k]) > fabs(a[pivot][k])) pivot = i;
        for (int j = 0; j < n && pivot != k; j++) {
            const double other = a[k][j];
            a[k][j] = a[pivot][j];
            a[pivot][j] = other;
        }
        det *= pivot == k ? a[k][k] : -a[k][k];
        for (int i = k + 1; i < n && fabs(a[k][k]) > 0; i++) {
            const double factor = a[i][k] / a[k][k];
            for (int j = k; j < n; j++) a[i][j] -= factor * a[k][j];
        }
    }
    return det;
}

#endif
