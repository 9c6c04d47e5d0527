/* What a leg weighs: a cylinder that hangs on the base joint, a piston that hangs on the top joint, and mass that moves with the
 * length (rotor, screw, oil), (mass-1) … (mass-3). Vectors in whatever axes the caller has them in, which may turn: no formula
 * asks for their rates. Theory: docs/theory/leg-mass.md. */
#ifndef GOUGH_KERNEL_LEG_MASS_H
#define GOUGH_KERNEL_LEG_MASS_H

#include "kernel/vector.h"

/* constants of a leg; all 0: without mass */
typedef struct {
    number swing;     /* Î = I₁ + m₁c₁² + I₂ */
    number cylinder;  /* m₁ */
    number piston;    /* m₂ */
    number center;    /* c₂, from the top joint towards the base */
    number offset;    /* β = m₁c₁ − m₂c₂ */
    number reflected; /* m_r */
} leg_mass;

static inline leg_mass leg_mass_of(const double cylinder[3], const double piston[3],
                                   double reflected) {
    const number m1 = number_of(cylinder[0]), c1 = number_of(cylinder[1]);
    const number m2 = number_of(piston[0]), c2 = number_of(piston[1]);
    const number swing = number_of(cylinder[2]) + m1 * c1 * c1 + number_of(piston[2]);

    return (leg_mass){swing, m1, m2, c2, m1 * c1 - m2 * c2, number_of(reflected)};
}

/* Q = τ 1 + (μ − τ) n nᵀ of a leg as long as l, and what of its mass hangs on the top besides the piston */
typedef struct {
    number across, more; /* τ; μ − τ */
    number turning;      /* I_t */
    number tilt;         /* S − m₂ = β/l */
} leg_resistance;

/* (mass-1), (mass-2); inverse: 1/l */
KERNEL_INLINE leg_resistance leg_resistance_of(const leg_mass *m, number l, number inverse) {
    const number reach = l - m->center;
    leg_resistance k;

    k.turning = m->swing + m->piston * reach * reach;
    k.tilt = m->offset * inverse;
    k.across = k.turning * inverse * inverse;
    k.more = m->piston + m->reflected - k.across;
    return k;
}

/* How a leg moves, and what follows for its inertia: the force that the top must give it is f = Q a + q, with
 * Q a = τ a + (μ − τ)(n·a) n and the acceleration a of its top joint */
typedef struct {
    number across, more; /* τ; μ − τ */
    vector turn;         /* ṅ */
    vector rest;         /* q of (mass-3), gravity in it */
} leg_motion;

/* (mass-1) … (mass-3) of a leg of length l and direction n whose top joint moves with v, and its length with `rate` */
KERNEL_INLINE leg_motion leg_motion_of(const leg_mass *m, vector gravity, number l, vector n,
                                       vector v, number rate) {
    const number one = number_of(1), two = number_of(2);
    const number inverse = one / l, reach = l - m->center;
    const leg_resistance k = leg_resistance_of(m, l, inverse);
    leg_motion g;

    g.across = k.across;
    g.more = k.more;
    g.turn = scale(inverse, along(v, -rate, n));

    const number outward =
        (m->piston * m->center + m->reflected * l) * dot(g.turn, g.turn) + k.tilt * dot(n, gravity);
    const number sideways = two * rate * inverse * (m->piston * reach - k.turning * inverse);
    g.rest = along(scale(outward, n), sideways, g.turn);
    g.rest = along(g.rest, -(m->piston + k.tilt), gravity);
    return g;
}

/* (mass-3): the force that the top gives the leg, but for the leg force, where its top joint is accelerated by a */
static inline vector leg_inertia(const leg_motion *g, vector n, vector a) {
    return add(along(scale(g->across, a), g->more * dot(n, a), n), g->rest);
}

#endif
