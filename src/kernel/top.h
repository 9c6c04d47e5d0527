/* Between the top frame, in which users think, and the coordinates (ρ, i, j, k) of the load: Q = R P, ρ = p + R c, with R the
 * top frame's axes, p its origin, P the central axes and c the centre of mass in it. Theory: docs/theory/body.md. */
#ifndef GOUGH_KERNEL_TOP_H
#define GOUGH_KERNEL_TOP_H

#include "kernel/legs.h"

/* A point of the top with R, or a derivative of the two of any order: ρ and the triad, or their derivatives. The point is
 * at `about` in the top frame. */
static inline coordinates coordinates_of_top(const hexapod *h, vector about, vector point,
                                             const triad *R) {
    return (coordinates){add(point, out_of(R, subtract(h->center, about))), compose(R, &h->axes)};
}

/* the same backwards: R = Q Pᵀ, p = ρ − R c; serves derivatives of any order too */
static inline void top_of_coordinates(const hexapod *h, const coordinates *x, vector *point,
                                      triad *R) {
    const triad back = transpose(&h->axes);

    *R = compose(&x->q, &back);
    *point = subtract(x->rho, out_of(R, h->center));
}

/* rates from the velocity of the top frame's origin and the angular velocity ω */
static inline coordinates rates_of_top(const hexapod *h, const coordinates *x, vector velocity,
                                       vector omega) {
    const vector c = out_of(&x->q, onto(&h->axes, h->center));

    return (coordinates){add(velocity, cross(omega, c)), triad_rate(&x->q, omega)};
}

/* accelerations from a and α: ρ̈ = a + α×c + ω×(ω×c), ë = α×e + ω×(ω×e) */
static inline coordinates accelerations_of_top(const hexapod *h, const coordinates *x,
                                               vector linear, vector omega, vector angular) {
    const vector c = out_of(&x->q, onto(&h->axes, h->center));
    const triad turn = triad_rate(&x->q, omega);
    const triad a = triad_rate(&x->q, angular), b = triad_rate(&turn, omega);

    return (coordinates){
        add(linear, add(cross(angular, c), cross(omega, cross(omega, c)))),
        {add(a.i, b.i), add(a.j, b.j), add(a.k, b.k)},
    };
}

/* ω and α of a triad from its derivatives: α = ½ Σ e × ë */
static inline vector angular_velocity_of(const coordinates *x, const coordinates *rate) {
    return triad_angular_velocity(&x->q, &rate->q);
}

/* the constraints kept: the nearest triad, and the nearest rates that a rigid body can have, (body-7); returns the violation
 * before */
static inline number coordinates_project(coordinates *x, coordinates *rate) {
    const number violation = triad_project(&x->q);

    rate->q = triad_rate(&x->q, triad_angular_velocity(&x->q, &rate->q));
    return violation;
}

#endif
