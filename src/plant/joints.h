/* Forces at the joints of the legs: what a leg does to the top, what the base does to the leg, and what its guides bear, (mass-5),
 * (mass-6), (mass-8). Base axes. Text over the number type. Theory: docs/theory/leg-mass.md. */
#ifndef GOUGH_PLANT_JOINTS_H
#define GOUGH_PLANT_JOINTS_H

#include "kernel/top.h"

typedef struct {
    vector top;  /* of the leg on the top */
    vector base; /* of the base on the leg */
    number side; /* between cylinder and piston, at the piston's centre of mass */
} leg_joints;

/* a leg without mass pushes along itself at both ends */
static inline leg_joints joints_light(const legs *g, int v, number F) {
    const vector along_leg = scale(F, g->n[v]);

    return (leg_joints){along_leg, along_leg, number_of(0)};
}

/* leg v with the leg force F, whose top joint moves with `speed` and acceleration a */
static inline leg_joints joints_heavy(const hexapod *h, const legs *g, int v, vector speed,
                                      vector a, number F) {
    const leg_mass *m = &h->mass[v];
    const vector n = g->n[v];
    const number l = g->length[v], rate = g->rate[v], two = number_of(2);
    const leg_motion motion = leg_motion_of(m, h->gravity, l, n, speed, rate);
    leg_joints j;

    /* (mass-5): F n − f */
    j.top = subtract(scale(F, n), leg_inertia(&motion, n, a));

    /* n̈ = (a − l̈ n − 2 l̇ ṅ)/l with l̈ = n·a + l|ṅ|² */
    const number second = dot(n, a) + l * dot(motion.turn, motion.turn);
    const vector bend =
        scale(number_of(1) / l, along(along(a, -second, n), -two * rate, motion.turn));

    /* (mass-6): F_ν + m₁(c₁n̈ − g) + m₂(a − c₂n̈ − g) = F_ν + βn̈ + m₂a − (m₁ + m₂)g */
    j.base = along(along(j.top, m->offset, bend), m->piston, a);
    j.base = along(j.base, -(m->cylinder + m->piston), h->gravity);

    /* (mass-8): P(m₂(a − c₂n̈ − g) + F_ν) */
    const vector piston = subtract(along(a, -m->center, bend), h->gravity);
    const vector guided = along(j.top, m->piston, piston);
    j.side = norm(along(guided, -dot(n, guided), n));
    return j;
}

/* of leg v; heavy: legs have mass */
static inline leg_joints joints_of_leg(const hexapod *h, const legs *g, int v,
                                       const coordinates *rate, const coordinates *acceleration,
                                       int heavy, number F) {
    if (!heavy) return joints_light(g, v, F);
    return joints_heavy(h, g, v, joint_of(h, rate, v), joint_of(h, acceleration, v), F);
}

#endif
