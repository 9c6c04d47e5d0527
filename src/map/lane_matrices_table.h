/* What each width of lanes offers to the stability map: transition matrices Φ of ξ̇ = A(t; G) ξ for several G side by side.
 * Theory: docs/theory/floquet.md. */
#ifndef GOUGH_MAP_LANE_MATRICES_TABLE_H
#define GOUGH_MAP_LANE_MATRICES_TABLE_H

#include "gough/linear.h"

/* of a matrix; the points of G at which Φ is known, a multiple of every width; stages of a step */
enum { MATRIX = GOUGH_LINEAR * GOUGH_LINEAR, NODES = 24, STAGES = 12 };

/* A(t; G) = base + G gain at the stages of one step; gain stands in the rows of the accelerations and the columns of δr, δθ */
typedef struct {
    double base[STAGES][GOUGH_LINEAR][GOUGH_LINEAR];
    double gain[STAGES][6][6];
} loop_step;

/* (floquet-21): Φ over each part of the period at the Chebyshev points of 0 … top. Matrices by columns. */
typedef struct {
    double top;
    double cosine[NODES][NODES]; /* T_k at point i */
    size_t parts;
    double (*phi)[NODES][MATRIX]; /* one a part */
} transitions;

struct analyse_width {
    int lanes;
    size_t group_size; /* bytes, a multiple of 64 */

    /* Φ = 1 for as many G as there are lanes */
    void (*begin)(void *group, const double *stiffness);

    /* a step of length h */
    void (*advance)(void *group, const loop_step *step, double h);

    /* Φ of each lane */
    void (*store)(void *group, double (*phi)[MATRIX]);

    /* Φ over all parts, for as many G as there are lanes */
    void (*compose)(const transitions *t, const double *stiffness, double (*phi)[MATRIX]);
};

extern const struct analyse_width analyse_width_1, analyse_width_2, analyse_width_4,
    analyse_width_8;

#endif
