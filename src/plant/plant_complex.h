/* What the dynamics room offers to the rooms below besides the public functions: the same equations over complex numbers,
 * for exact derivatives by an imaginary step. */
#ifndef GOUGH_PLANT_PLANT_COMPLEX_H
#define GOUGH_PLANT_PLANT_COMPLEX_H

#include <complex.h>

#include "gough/dynamics.h"
#include "plant/layout.h"

struct dynamics_complex {
    /* lengths and rates of the legs in a state (ρ, i, j, k and rates) */
    void (*legs)(const gough_machine *machine, const double complex state[MOTION],
                 double complex length[GOUGH_LEGS], double complex rate[GOUGH_LEGS]);

    /* (1.4), (1.5): accelerations of ρ, i, j, k; force at the centre of mass and moment in base axes */
    void (*accelerations)(const gough_machine *machine, const double complex state[MOTION],
                          const double complex leg_force[GOUGH_LEGS], const double complex force[3],
                          const double complex moment[3], double complex acceleration[COORDINATES]);

    /* (legs-7): leg forces that give the accelerations */
    void (*forces)(const gough_machine *machine, const double complex state[MOTION],
                   const double complex acceleration[COORDINATES],
                   double complex leg_force[GOUGH_LEGS]);
};

extern const struct dynamics_complex dynamics_complex;

#endif
