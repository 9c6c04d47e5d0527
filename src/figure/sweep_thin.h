/* Thinning the lines of a sweep row by row, in memory that does not grow with the rows: the points that sheet_thin() keeps of all
 * points in order, to the bit. */
#ifndef GOUGH_FIGURE_SWEEP_THIN_H
#define GOUGH_FIGURE_SWEEP_THIN_H

#include "figure/sweep_rows.h"

enum {
    SWEEP_STRETCHES = 700, /* of the abscissa, as a thinned line of a sheet has them */
    SWEEP_POINTS = 2 * SWEEP_STRETCHES + 2 /* a line with no more points is kept whole */
};

/* The ends of the abscissa: the points that come first and last in order of the abscissa, and by row where it is the same. */
typedef struct sweep_ends {
    size_t count; /* of points */
    double least, greatest;
    size_t first, last;      /* rows of these two */
    double least_above_zero; /* +infinity without any */
} sweep_ends;
void sweep_meet(sweep_ends *ends, double x, size_t row);

typedef struct sweep_point {
    double x, y;
    bool ended;
    size_t row;
} sweep_point;

/* A line being thinned: extremes of y in each stretch. */
typedef struct sweep_line {
    sweep_ends ends;
    size_t kept; /* points of a line that is kept whole */
    sweep_point *whole, first, last;
    struct sweep_stretch {
        size_t met;
        bool finite;
        sweep_point begin, least, greatest;
    } stretch[SWEEP_STRETCHES];
    size_t decade[640];   /* how many magnitudes above 0 are in each power of ten from 1e-330 */
    double smallest[640]; /* and the least of them */
} sweep_line;

/* Zero bytes but for `ends`, and `whole` with room for SWEEP_POINTS. */
void sweep_line_add(sweep_line *line, sweep_point point);
/* The points kept, in order, and where a logarithmic axis begins for the line: below all but 1/25 of its magnitudes above 0, up to
 * the power of ten (NaN without any). */
size_t sweep_line_end(sweep_line *line, sweep_point point[SWEEP_POINTS], double *low);

/* Shares of runs being thinned: how many numbers are in each stretch, with the least and greatest of them. */
typedef struct sweep_shares {
    sweep_ends ends;
    size_t kept;
    double *whole;
    struct sweep_share {
        size_t met;
        double least, greatest;
    } stretch[SWEEP_STRETCHES];
} sweep_shares;
void sweep_shares_add(sweep_shares *shares, double x, size_t row);
/* The points kept, in order: x, and how many numbers are at most x. */
size_t sweep_shares_end(sweep_shares *shares, double x[SWEEP_POINTS], double rank[SWEEP_POINTS]);

#endif
