/* Roll, pitch and yaw of a rotation, for scalar number types. */
#ifndef GOUGH_PLANT_ROLL_PITCH_YAW_H
#define GOUGH_PLANT_ROLL_PITCH_YAW_H

#include "kernel/real.h"
#include "kernel/vector.h"
#include "program/angles.h"

/* (motion-1) inverted: the values alone */
static inline void rotation_angles(int order, const triad *R, real angles[3]) {
    const vector column[3] = {R->i, R->j, R->k};
    jet angle[3], m[3][3];

    for (int c = 0; c < 3; c++) {
        m[0][c] = jet_constant(column[c].x);
        m[1][c] = jet_constant(column[c].y);
        m[2][c] = jet_constant(column[c].z);
    }
    angles_in_order(order, m, angle);
    for (int a = 0; a < 3; a++) angles[a] = angle[a].v;
}

#endif
