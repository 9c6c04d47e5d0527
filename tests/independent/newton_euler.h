/* A second formulation of a load on six massless legs, for tests only: Newton's and Euler's
 * equations with a unit quaternion, in long double, sharing no code with the library. State:
 * centre of mass (base frame), quaternion from the top frame to the base frame (scalar first),
 * velocity (base frame), angular velocity (top frame).
 * */
#ifndef GOUGH_TESTS_NEWTON_EULER_H
#define GOUGH_TESTS_NEWTON_EULER_H

#include <stdbool.h>

typedef long double newton_real;

enum { NEWTON_STATES = 13 };

/* The machine, its program, control law and disturbances; units and frames are the library's. */
typedef struct newton_euler {
    newton_real base[6][3], top[6][3], height;
    newton_real mass, center[3], inertia[3][3], gravity[3];
    newton_real about[3];
    bool feedforward;
    newton_real stiffness[6], damping[6];
    /* surge, sway, heave, roll, pitch, yaw with first and second derivative */
    void (*program)(newton_real t, newton_real component[6][3]);
    /* added to each leg; a vertical force shared by the legs; force and moment on the load.
     * NULL: none */
    void (*disturbance)(newton_real t, newton_real leg[6], newton_real *vertical,
                        newton_real force[3], newton_real moment[3]);
} newton_euler;

/* Motion of the top frame's origin and axes, base frame. */
typedef struct newton_motion {
    newton_real position[3], rotation[3][3], velocity[3], omega[3];
} newton_motion;

/* Program forces, lengths and rates at t, from inverse dynamics along the program. */
void newton_euler_program(const newton_euler *m, newton_real t, newton_real force[6],
                          newton_real length[6], newton_real rate[6]);

/* The state of the program at time 0. */
void newton_euler_start(const newton_euler *m, newton_real state[NEWTON_STATES]);

/* One step of length h by Gragg's method, extrapolated to order 16. */
void newton_euler_step(const newton_euler *m, newton_real t, newton_real h,
                       newton_real state[NEWTON_STATES]);

newton_motion newton_euler_motion(const newton_euler *m, const newton_real state[NEWTON_STATES]);

/* Lengths and forces of the legs in a state, by the control law with its disturbances. */
void newton_euler_legs(const newton_euler *m, newton_real t, const newton_real state[NEWTON_STATES],
                       newton_real length[6], newton_real force[6]);

/* Determinant of the six equations in a state: of the legs' unit vectors over their moments
 * about the centre of mass. */
newton_real newton_euler_determinant(const newton_euler *m, const newton_real state[NEWTON_STATES]);

#endif
