/* A second formulation of a load on six legs that have mass and friction, for tests only: Newton's
 * and Euler's equations of thirteen rigid bodies (the load, six cylinders, six pistons) with the
 * reactions of their joints as unknowns. One linear system holds all of them, and nothing is
 * eliminated by hand. Units, frames and signs are the library's; vectors are in base axes. No code
 * is shared with the library, only the structs of its interface.
 * */
#ifndef GOUGH_TESTS_THIRTEEN_BODIES_H
#define GOUGH_TESTS_THIRTEEN_BODIES_H

#include "gough/dynamics.h"

enum { BODIES = 13, LOAD = 0, CYLINDER = 1, PISTON = 7 };

/* What gough_machine_init() is given. */
typedef struct thirteen_bodies {
    gough_platform platform;
    gough_load load;
    double gravity[3];
} thirteen_bodies;

/* One body: centre of mass, velocity and acceleration, the same of its rotation; inertia about the
 * centre of mass. */
typedef struct rigid_body {
    double mass, inertia[3][3];
    double x[3], v[3], omega[3];
    double a[3], alpha[3];
} rigid_body;

/* All bodies, and what acts in the legs. The load is body LOAD, leg k has CYLINDER + k and
 * PISTON + k. */
typedef struct bodies_instant {
    rigid_body body[BODIES];
    double length[6], rate[6], second_rate[6];
    double drive[6];     /* u, with friction */
    double force[6];     /* F, without friction; a push is positive */
    double rod[6];       /* F less the force that accelerates the reflected mass */
    double on_top[6][3]; /* force of each leg on the load */
    double on_leg[6][3]; /* force of the base on each leg */
    gough_acceleration top;
} bodies_instant;

/* Lengths of the legs, joint to joint, and their rates. */
void bodies_lengths(const thirteen_bodies *m, const gough_state *state, double length[6],
                    double rate[6]);

/* Everything at an instant, from the motion and the six drive forces. `external` may be NULL. */
void bodies_forward(const thirteen_bodies *m, const gough_state *state, const double drive[6],
                    const gough_wrench *external, bodies_instant *out);

/* Everything at an instant, from the motion and the acceleration of the top frame. */
void bodies_inverse(const thirteen_bodies *m, const gough_state *state,
                    const gough_acceleration *acceleration, const gough_wrench *external,
                    bodies_instant *out);

/* What is missing in the balance of momentum, and in that of angular momentum about the origin, of
 * all bodies together; each divided by the sum of the magnitudes of its terms. */
void bodies_momentum(const thirteen_bodies *m, const gough_wrench *external,
                     const bodies_instant *now, double momentum[3], double angular[3]);

/* Rate of change of the kinetic energy (with that of the reflected masses) and of the potential
 * energy. */
double bodies_energy_rate(const thirteen_bodies *m, const bodies_instant *now);

#endif
