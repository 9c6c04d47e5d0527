/* Patterns of gains. Theory: docs/theory/loop.md. */
#include "linear/gain_pattern.h"

#include <math.h>
#include <string.h>

double gain_pattern_of(const double own[GOUGH_LEGS], const double cross[GOUGH_LEGS][GOUGH_LEGS],
                       bool coupled, gain_pattern *p) {
    double size = 0;

    memset(p, 0, sizeof *p);
    for (int v = 0; v < GOUGH_LEGS; v++) size = fmax(size, fabs(own[v]));
    for (int v = 0; v < GOUGH_LEGS && !(size > 0) && coupled; v++) {
        for (int w = 0; w < GOUGH_LEGS; w++) size = fmax(size, fabs(cross[v][w]));
    }
    for (int v = 0; v < GOUGH_LEGS; v++) {
        p->own[v] = size > 0 ? own[v] / size : 1;
        for (int w = 0; w < GOUGH_LEGS && size > 0 && coupled; w++)
            p->cross[v][w] = cross[v][w] / size;
    }
    return size;
}

void gain_pattern_spread(const gain_pattern *p, double size, double own[GOUGH_LEGS],
                         double cross[GOUGH_LEGS][GOUGH_LEGS]) {
    for (int v = 0; v < GOUGH_LEGS; v++) {
        own[v] = size * p->own[v];
        for (int w = 0; w < GOUGH_LEGS; w++) cross[v][w] = size * p->cross[v][w];
    }
}
