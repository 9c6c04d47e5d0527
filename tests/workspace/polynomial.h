/* What a number over a box says of one pose of it, without its rest. */
#ifndef TESTS_WORKSPACE_POLYNOMIAL_H
#define TESTS_WORKSPACE_POLYNOMIAL_H

#include "workspace/taylor.h"

static inline double polynomial_at(const taylor *a, const double xi[SIDES]) {
    double value = a->c;
    for (int k = 0; k < SIDES; k++) {
        value += a->g[k] * xi[k];
        for (int j = 0; j <= k; j++) value += a->h[curve_at(j, k)] * xi[j] * xi[k];
    }
    return value;
}

#endif
