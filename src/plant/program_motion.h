/* The program as a motion of the load: formulas, moves or samples → R and a point on jets → ρ, i, j, k with exact first and
 * second derivatives. Theory: docs/theory/motion.md. */
#ifndef GOUGH_PLANT_PROGRAM_MOTION_H
#define GOUGH_PLANT_PROGRAM_MOTION_H

#include "kernel/top.h"
#include "program/angles.h"
#include "program/program.h"

/* the sum of the magnitudes of a value and its derivatives: 0 where all of them are */
static inline real jet_size(jet a) {
    return real_magnitude(a.v) + real_magnitude(a.d) + real_magnitude(a.dd);
}

static inline real jet_order(jet a, int order) {
    return order == 0 ? a.v : order == 1 ? a.d : a.dd;
}

/* ρ and its derivatives, the triad at rest in its place at home: what (motion-1) gives where no angle moves */
static inline void coordinates_of_shift(const hexapod *h, vector about, const vector where[3],
                                        coordinates x[3]) {
    const vector none = {number_of(0), number_of(0), number_of(0)};

    for (int order = 0; order < 3; order++)
        x[order] = (coordinates){where[order], {none, none, none}};
    x[0].rho = add(where[0], subtract(h->center, about));
    x[0].q = h->axes;
}

/* What the jets of the six components say: the displacement of the point `about` and the axes of the top frame, each with two
 * derivatives. The axes are left out where no angle moves. */
typedef struct {
    vector where[3];
    triad axes[3];
    int still;
} displacement;

/* whether no angle moves, and R otherwise; */
static inline int displacement_turn(angle_frame frame, const jet component[GOUGH_COMPONENTS],
                                    jet R[3][3]) {
    if (jet_vanishes(jet_size(component[GOUGH_ROLL]) + jet_size(component[GOUGH_PITCH]) +
                     jet_size(component[GOUGH_YAW]))) {
        return 1;
    }
    motion_rotation(frame, component, R);
    return 0;
}

/* the same in every lane */
static inline void displacement_of(angle_frame frame, const jet component[GOUGH_COMPONENTS],
                                   displacement *d) {
    jet R[3][3];

    for (int order = 0; order < 3; order++) {
        d->where[order] = (vector){number_of_real(jet_order(component[GOUGH_SURGE], order)),
                                   number_of_real(jet_order(component[GOUGH_SWAY], order)),
                                   number_of_real(jet_order(component[GOUGH_HEAVE], order))};
    }
    d->still = displacement_turn(frame, component, R);
    for (int order = 0; order < 3 && !d->still; order++) {
        number m[3][3];
        for (int r = 0; r < 3; r++) {
            for (int c = 0; c < 3; c++) m[r][c] = number_of_real(jet_order(R[r][c], order));
        }
        d->axes[order] = (triad){
            {m[0][0], m[1][0], m[2][0]}, {m[0][1], m[1][1], m[2][1]}, {m[0][2], m[1][2], m[2][2]}};
    }
}

/* Coordinates of the load for a displacement from home: x[0], rates x[1], accelerations x[2] */
static inline void coordinates_of_displacement(const hexapod *h, double height,
                                               const double about[3], const displacement *d,
                                               coordinates x[3]) {
    const vector point = vector_of(about);
    vector where[3] = {d->where[0], d->where[1], d->where[2]};

    where[0] = add(where[0], point);
    where[0].z = where[0].z + number_of(height);
    if (d->still) {
        coordinates_of_shift(h, point, where, x);
        return;
    }
    for (int order = 0; order < 3; order++) {
        x[order] = coordinates_of_top(h, point, where[order], &d->axes[order]);
    }
}

/* The same from the jets, evaluated once and broadcast to every lane. */
static inline void coordinates_of_motion(const hexapod *h, double height, const double about[3],
                                         angle_frame frame, const jet component[GOUGH_COMPONENTS],
                                         coordinates x[3]) {
    displacement d;

    displacement_of(frame, component, &d);
    coordinates_of_displacement(h, height, about, &d, x);
}

static inline void program_at(const hexapod *h, double height, const gough_motion *motion, real t,
                              coordinates x[3]) {
    jet component[GOUGH_COMPONENTS];

    motion_components(motion, t, component);
    coordinates_of_motion(h, height, motion->about, motion_frame(motion), component, x);
}

#endif
