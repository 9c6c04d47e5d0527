/* The nearest rates within bounds, in a metric: a convex problem of six unknowns. */
#ifndef GOUGH_CUEING_NEAREST_RATES_H
#define GOUGH_CUEING_NEAREST_RATES_H

enum { RATES = 6 };

/* The y between `least` and `greatest` with the least (y − wanted)ᵀ H (y − wanted), (cue-10). H is symmetric and positive
 * definite; least <= greatest. */
void nearest_rates(double H[RATES][RATES], const double wanted[RATES], const double least[RATES],
                   const double greatest[RATES], double y[RATES]);

#endif
