/* Steps of a fixed length up to the duration: whole ones, and a shorter last one where they do not divide it. */
#ifndef GOUGH_INTEGRATE_FIXED_H
#define GOUGH_INTEGRATE_FIXED_H

#include <math.h>

/* shares of a step within which the duration counts as whole steps */
static const double fixed_slack = 1e-9;

/* how many */
static inline long long fixed_steps(double duration, double step) {
    return (long long)ceil(duration / step - fixed_slack);
}

/* whether step k ends at the duration, which is less than a whole step from its beginning */
static inline int fixed_is_short(long long k, double step, double duration) {
    return (double)(k + 1) * step > duration + fixed_slack * step;
}

#endif
