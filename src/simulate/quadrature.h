/* Integrals over time from equally spaced rows as they come, of fourth order: cubics through four rows. */
#ifndef GOUGH_SIMULATE_QUADRATURE_H
#define GOUGH_SIMULATE_QUADRATURE_H

/* rows in the window; weights of the interval in its middle, and of the outer intervals at both ends of a run */
enum { QUADRATURE_ROWS = 4 };
static const double quadrature_middle[QUADRATURE_ROWS] = {-1.0 / 24, 13.0 / 24, 13.0 / 24,
                                                          -1.0 / 24};
static const double quadrature_first[QUADRATURE_ROWS] = {9.0 / 24, 19.0 / 24, -5.0 / 24, 1.0 / 24};
static const double quadrature_last[QUADRATURE_ROWS] = {1.0 / 24, -5.0 / 24, 19.0 / 24, 9.0 / 24};

#endif
