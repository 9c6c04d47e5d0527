/* Forward dynamics, the paper's inverse problem: from leg forces to the accelerations of ρ, i, j, k, (1.4), (1.5).
 * Theory: docs/theory/body.md. */
#ifndef GOUGH_DYNAMICS_FORWARD_H
#define GOUGH_DYNAMICS_FORWARD_H

#include "kernel/top.h"

/* u: leg forces; force (at the centre of mass) and moment: what else acts on the load, base axes */
static inline void forward_dynamics(const hexapod *h, const coordinates *x, const coordinates *rate,
                                    const legs *g, const number u[LEGS], vector force,
                                    vector moment, coordinates *acceleration) {
    vector F, L;

    legs_resultant(h, x, g, u, &F, &L);
    F = add(F, force);
    L = add(L, onto(&x->q, moment));

    acceleration->rho = body_acceleration(&h->load, F, h->gravity);
    acceleration->q = triad_acceleration(&h->load, &x->q, &rate->q, L);
}

#endif
