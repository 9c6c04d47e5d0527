/* The rotation of the program on jets: from roll, pitch and yaw and back, and from angles about turned axes, (motion-1) and
 * (motion-10). A text over `real`. */
#ifndef GOUGH_PROGRAM_ANGLES_H
#define GOUGH_PROGRAM_ANGLES_H

#include "gough/model.h"
#include "program/jet.h"

/* (motion-1): R = Rz(yaw) Ry(pitch) Rx(roll) */
static inline void rotation_jets(jet roll, jet pitch, jet yaw, jet R[3][3]) {
    const jet a = jet_cos(yaw), b = jet_cos(pitch), c = jet_cos(roll);
    const jet p = jet_sin(yaw), q = jet_sin(pitch), r = jet_sin(roll);
    const jet aq = jet_multiply(a, q), pq = jet_multiply(p, q);

    R[0][0] = jet_multiply(a, b);
    R[0][1] = jet_subtract(jet_multiply(aq, r), jet_multiply(p, c));
    R[0][2] = jet_add(jet_multiply(aq, c), jet_multiply(p, r));
    R[1][0] = jet_multiply(p, b);
    R[1][1] = jet_add(jet_multiply(pq, r), jet_multiply(a, c));
    R[1][2] = jet_subtract(jet_multiply(pq, c), jet_multiply(a, r));
    R[2][0] = jet_negate(q);
    R[2][1] = jet_multiply(b, r);
    R[2][2] = jet_multiply(b, c);
}

/* (motion-1) inverted: roll, pitch and yaw; the root keeps pitch exact near ±90° where an arc sine would lose half its digits */
KERNEL_INLINE void rotation_angle_jets(const jet R[3][3], jet angle[3]) {
    const jet squares = jet_add(jet_multiply(R[0][0], R[0][0]), jet_multiply(R[1][0], R[1][0]));

    angle[0] = jet_atan2(R[2][1], R[2][2]);
    angle[1] = jet_atan2(jet_subtract(jet_constant(0), R[2][0]), jet_root(squares));
    angle[2] = jet_atan2(R[1][0], R[0][0]);
}

static inline void rotation_transpose(jet R[3][3]) {
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < r; c++) {
            const jet x = R[r][c];
            R[r][c] = R[c][r];
            R[c][r] = x;
        }
    }
}

static inline jet jet_opposite(jet a) { return jet_subtract(jet_constant(0), a); } /* no -0 */

/* (motion-1) in the other order: Rx Ry Rz of three angles is the transpose of Rz Ry Rx of the opposite ones */
static inline void rotation_in_order(int order, const jet angle[3], jet R[3][3]) {
    if (order != GOUGH_XYZ) {
        rotation_jets(angle[0], angle[1], angle[2], R);
        return;
    }
    rotation_jets(jet_opposite(angle[0]), jet_opposite(angle[1]), jet_opposite(angle[2]), R);
    rotation_transpose(R);
}

/* the same inverted; R may change */
static inline void angles_in_order(int order, jet R[3][3], jet angle[3]) {
    if (order == GOUGH_XYZ) rotation_transpose(R);
    rotation_angle_jets((const jet(*)[3])R, angle);
    for (int a = 0; a < 3 && order == GOUGH_XYZ; a++) angle[a] = jet_opposite(angle[a]);
}

/* The matrix F of a quaternion of any length. Divided at the end, so that F is a rotation to all digits of real. */
static inline void rotation_of_axes(const double axes[4], real F[3][3]) {
    const real w = (real)axes[0], x = (real)axes[1], y = (real)axes[2], z = (real)axes[3];
    const real n = w * w + x * x + y * y + z * z;

    F[0][0] = (w * w + x * x - y * y - z * z) / n;
    F[0][1] = 2 * (x * y - w * z) / n;
    F[0][2] = 2 * (x * z + w * y) / n;
    F[1][0] = 2 * (x * y + w * z) / n;
    F[1][1] = (w * w - x * x + y * y - z * z) / n;
    F[1][2] = 2 * (y * z - w * x) / n;
    F[2][0] = 2 * (x * z - w * y) / n;
    F[2][1] = 2 * (y * z + w * x) / n;
    F[2][2] = (w * w - x * x - y * y + z * z) / n;
}

/* (motion-10): R becomes F R Fᵀ */
static inline void rotation_turn(const double axes[4], jet R[3][3]) {
    real F[3][3];
    jet half[3][3];

    rotation_of_axes(axes, F);
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++) {
            half[r][c] = jet_add(jet_add(jet_scale(F[r][0], R[0][c]), jet_scale(F[r][1], R[1][c])),
                                 jet_scale(F[r][2], R[2][c]));
        }
    }
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++) {
            R[r][c] =
                jet_add(jet_add(jet_scale(F[c][0], half[r][0]), jet_scale(F[c][1], half[r][1])),
                        jet_scale(F[c][2], half[r][2]));
        }
    }
}

/* What the program's components GOUGH_ROLL … GOUGH_YAW are: angles about these axes, NULL those of the base, in an order. */
typedef struct {
    const double *axes;
    int order;
} angle_frame;

static inline angle_frame motion_frame(const gough_motion *m) {
    const double *axes = m->samples.axes;
    if (m->kind != GOUGH_MOTION_SAMPLES) axes = NULL;
    if (axes &&
        !(axes[0] * axes[0] + axes[1] * axes[1] + axes[2] * axes[2] + axes[3] * axes[3] > 0))
        axes = NULL;
    return (angle_frame){axes, (int)m->order};
}

/* R of the six components of a program whose angles are those of a frame */
static inline void motion_rotation(angle_frame frame, const jet component[GOUGH_COMPONENTS],
                                   jet R[3][3]) {
    rotation_in_order(frame.order, component + GOUGH_ROLL, R);
    if (frame.axes) rotation_turn(frame.axes, R);
}

/* Angles about turned axes become roll, pitch and yaw: roll and yaw within ±180°, pitch within ±90°. At a pitch of exactly
 * 90° the derivatives are not finite. */
static inline void motion_base_angles(angle_frame frame, jet component[GOUGH_COMPONENTS]) {
    jet R[3][3];

    if (frame.axes == NULL) return;
    motion_rotation(frame, component, R);
    angles_in_order(frame.order, R, component + GOUGH_ROLL);
}

#endif
