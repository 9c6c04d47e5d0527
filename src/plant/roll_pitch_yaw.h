/* Roll, pitch and yaw of a rotation, for scalar number types. */
#ifndef GOUGH_PLANT_ROLL_PITCH_YAW_H
#define GOUGH_PLANT_ROLL_PITCH_YAW_H

#include "kernel/real.h"
#include "kernel/vector.h"
#include "program/angles.h"

/* (motion-1) inverted: the values alone */
static inline void rotation_angles(const triad *R, real angles[3]) {
    const jet zero = {0, 0, 0};
    const jet m[3][3] = {{jet_constant(R->i.x), zero, zero},
                         {jet_constant(R->i.y), zero, zero},
                         {jet_constant(R->i.z), jet_constant(R->j.z), jet_constant(R->k.z)}};
    jet angle[3];

    rotation_angle_jets(m, angle);
    for (int a = 0; a < 3; a++) angles[a] = angle[a].v;
}

#endif
