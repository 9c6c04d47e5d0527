/* Forward dynamics, the paper's inverse problem: from leg forces to the accelerations of ρ, i, j, k, (1.4), (1.5).
 * Theory: docs/theory/body.md. */
#ifndef GOUGH_PLANT_FORWARD_H
#define GOUGH_PLANT_FORWARD_H

#include "plant/heavy_legs.h"

/* p: what the legs do; force (at the centre of mass) and moment: what else acts on the load, base axes; force NULL: nothing */
KERNEL_INLINE coordinates accelerations_under(const hexapod *h, const coordinates *x,
                                              const coordinates *rate, const push *p,
                                              const vector *force, const vector *moment) {
    vector F = p->F, L = push_moment(p, &x->q);

    if (force) {
        F = add(F, *force);
        L = add(L, onto(&x->q, *moment));
    }
    return (coordinates){body_acceleration(&h->load, F, h->gravity),
                         triad_acceleration(&h->load, &x->q, &rate->q, L)};
}

/* the same from leg forces F; heavy: the legs have mass, and g has their rates */
KERNEL_INLINE coordinates forward_dynamics(const hexapod *h, const coordinates *x,
                                           const coordinates *rate, const legs *g, int heavy,
                                           const number F[LEGS], const vector *force,
                                           const vector *moment) {
    if (heavy) return heavy_accelerations(h, x, rate, g, F, force, moment);
    const push p = legs_push(h, g, F);
    return accelerations_under(h, x, rate, &p, force, moment);
}

#endif
