/* A root of the equations of a pose in quadruple precision, for ends whose errors double cannot bound well enough. Plain C. */
#ifndef GOUGH_POSE_POLISH_H
#define GOUGH_POSE_POLISH_H

#include "gough/model.h"

/* a root in the chart in which the unknown `chart` is 1, with about the inverse of the Jacobian there; both complex */
typedef struct {
    double Y[8][8][2];
    double size;    /* ‖Y‖ */
    double x[8][2]; /* corrected by pose_polish() */
    int chart;
    double far;  /* how far the corrected x is from x as it was */
    double off;  /* how far the rounded x is from it */
    double beta; /* ‖Y F‖ at the corrected x before it was rounded, with the rounding of F */
} pose_root;

/* frame: the same as that of x */
struct pose_frame;
void pose_polish(const gough_machine *machine, const struct pose_frame *frame,
                 const double length[GOUGH_LEGS], pose_root *root);

#endif
