/* Roll, pitch and yaw of a rotation, for scalar number types. */
#ifndef GOUGH_DYNAMICS_ROTATION_H
#define GOUGH_DYNAMICS_ROTATION_H

#include "kernel/real.h"
#include "kernel/vector.h"

/* (motion-1) inverted; the root keeps pitch exact near ±90° where an arc sine would lose half its digits */
static inline void rotation_angles(const triad *R, real angles[3]) {
    angles[0] = real_atan2(R->j.z, R->k.z);
    angles[1] = real_atan2(0 - R->i.z, real_root(R->i.x * R->i.x + R->i.y * R->i.y));
    angles[2] = real_atan2(R->i.y, R->i.x);
}

/* Angle of the rotation from one triad to another, 0 … π: from |Σ a×b| = 2 sin and Σ a·b = 1 + 2 cos */
static inline real rotation_between(const triad *a, const triad *b) {
    const vector c = add(add(cross(a->i, b->i), cross(a->j, b->j)), cross(a->k, b->k));

    return real_atan2(norm(c), dot(a->i, b->i) + dot(a->j, b->j) + dot(a->k, b->k) - 1);
}

#endif
