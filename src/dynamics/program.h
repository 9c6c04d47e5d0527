/* The program as a motion of the load: formulas, moves or samples → R and a point on jets → ρ, i, j, k with exact first and
 * second derivatives. Theory: docs/theory/motion.md. */
#ifndef GOUGH_DYNAMICS_PROGRAM_H
#define GOUGH_DYNAMICS_PROGRAM_H

#include "kernel/top.h"
#include "model/program.h"

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

static inline real jet_order(jet a, int order) {
    return order == 0 ? a.v : order == 1 ? a.d : a.dd;
}

/* Coordinates of the load for a motion of the point `about`, as displacement from home: x[0], rates x[1], accelerations x[2].
 * The jets are evaluated once and broadcast to every lane. */
static inline void coordinates_of_motion(const hexapod *h, double height, const double about[3],
                                         const jet component[GOUGH_COMPONENTS], coordinates x[3]) {
    const vector point = vector_of(about);
    jet R[3][3];

    rotation_jets(component[GOUGH_ROLL], component[GOUGH_PITCH], component[GOUGH_YAW], R);
    for (int order = 0; order < 3; order++) {
        number m[3][3], p[3];
        for (int r = 0; r < 3; r++) {
            p[r] = number_of_real(jet_order(component[r], order));
            for (int c = 0; c < 3; c++) m[r][c] = number_of_real(jet_order(R[r][c], order));
        }
        const triad axes = {
            {m[0][0], m[1][0], m[2][0]}, {m[0][1], m[1][1], m[2][1]}, {m[0][2], m[1][2], m[2][2]}};
        vector where = {p[0], p[1], p[2]};
        if (order == 0) {
            where = add(where, point);
            where.z = where.z + number_of(height);
        }
        x[order] = coordinates_of_top(h, point, where, &axes);
    }
}

static inline void program_at(const hexapod *h, double height, const gough_motion *motion, real t,
                              coordinates x[3]) {
    jet component[GOUGH_COMPONENTS];

    motion_components(motion, t, component);
    coordinates_of_motion(h, height, motion->about, component, x);
}

#endif
