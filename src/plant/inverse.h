/* Inverse dynamics, the paper's direct problem: from a motion to the leg forces, (2.2), (2.4)–(2.6).
 * Theory: docs/theory/legs.md. */
#ifndef GOUGH_PLANT_INVERSE_H
#define GOUGH_PLANT_INVERSE_H

#include "plant/heavy_legs.h"

/* Right-hand side of (legs-7): what the legs together must give the load, as force and moment/reach in central axes.
 * force and moment: what else acts on the load, in base axes, the force at the centre of mass. */
static inline void required_wrench(const hexapod *h, const coordinates *x, const coordinates *rate,
                                   const coordinates *acceleration, vector force, vector moment,
                                   number wrench[6]) {
    /* (2.2): F = M (ρ̈ − g) − what else acts */
    const vector inertia = scale(h->load.mass, subtract(acceleration->rho, h->gravity));
    const vector F = onto(&x->q, subtract(inertia, force));

    /* (2.4) */
    const vector moments =
        subtract(body_moment(&h->load, &x->q, &rate->q, &acceleration->q), onto(&x->q, moment));
    const vector L = scale(number_of(1) / h->reach, moments);

    wrench[0] = F.x, wrench[1] = F.y, wrench[2] = F.z;
    wrench[3] = L.x, wrench[4] = L.y, wrench[5] = L.z;
}

/* (mass-4): adds what legs with mass need; g: with their rates */
static inline void required_by_legs(const hexapod *h, const coordinates *x, const coordinates *rate,
                                    const coordinates *acceleration, const legs *g,
                                    number wrench[6]) {
    const push p = heavy_legs(h, g, rate, acceleration);
    const vector F = onto(&x->q, p.F);
    const vector L = scale(number_of(1) / h->reach, push_moment(&p, &x->q));

    wrench[0] = wrench[0] + F.x, wrench[1] = wrench[1] + F.y, wrench[2] = wrench[2] + F.z;
    wrench[3] = wrench[3] + L.x, wrench[4] = wrench[4] + L.y, wrench[5] = wrench[5] + L.z;
}

/* A force in base axes through the centre of mass, no moment, in the form of required_wrench */
static inline void central_wrench(const coordinates *x, vector force, number wrench[6]) {
    const vector F = onto(&x->q, force);

    wrench[0] = F.x, wrench[1] = F.y, wrench[2] = F.z;
    wrench[3] = wrench[4] = wrench[5] = number_of(0);
}

/* (legs-7): the leg forces whose resultant is each of `count` wrenches, in place */
static inline elimination leg_forces_of(const hexapod *h, const coordinates *x, const legs *g,
                                        number wrench[][6], int count) {
    number a[6][6];

    legs_equations(h, x, g, h->arm, a);
    return solve_six(a, wrench, count);
}

#endif
