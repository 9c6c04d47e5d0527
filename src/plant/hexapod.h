/* The public machine (double) as the hexapod of a number type. */
#ifndef GOUGH_PLANT_HEXAPOD_H
#define GOUGH_PLANT_HEXAPOD_H

#include "gough/model.h"
#include "kernel/principal.h"
#include "kernel/top.h"

/* mass and friction of leg v */
static inline void hexapod_leg(hexapod *h, int v, const gough_machine *machine) {
    const gough_platform *p = &machine->platform;
    const double cylinder[3] = {p->cylinder.mass[v], p->cylinder.center[v], p->cylinder.inertia[v]};
    const double piston[3] = {p->piston.mass[v], p->piston.center[v], p->piston.inertia[v]};
    const gough_friction *f = &p->friction;
    const number one = number_of(1), zero = number_of(0), coulomb = number_of(f->coulomb[v]);
    const number smooth = number_of(machine->smoothing_speed[v]);

    h->mass[v] = leg_mass_of(cylinder, piston, p->reflected_mass[v]);
    h->dry[v] = (friction){
        .viscous = number_of(f->viscous[v]),
        .coulomb = coulomb,
        .excess = number_of(machine->breakaway[v]) - coulomb,
        .peak = f->stribeck_speed[v] > 0 ? one / number_of(f->stribeck_speed[v]) : zero,
        .smooth = smooth * smooth,
        .loss = one / number_of(f->efficiency[v]) - one,
    };
}

/* what a machine's legs ask of the equations */
static inline int machine_has_friction(const gough_machine *machine) {
    const gough_friction *f = &machine->platform.friction;

    for (int v = 0; v < LEGS; v++) {
        if (f->viscous[v] > 0 || machine->breakaway[v] > 0 || f->efficiency[v] < 1) return 1;
    }
    return 0;
}

/* the same machine in every lane */
static inline void hexapod_of_machine(hexapod *h, const gough_machine *machine) {
    number axes[3][3], moments[3];

#if defined(NUMBER_QUAD)
    /* the axes of the machine are good to 16 digits only: found anew */
    number inertia[3][3], J[3];
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++) inertia[r][c] = number_of(machine->load.inertia[r][c]);
    }
    principal_axes(inertia, axes, J);
    for (int r = 0; r < 3; r++) {
        moments[r] = (J[(r + 1) % 3] + J[(r + 2) % 3] - J[r]) / 2;
        if (!(machine->second_moments[r] > 0)) moments[r] = 0; /* flat, as the machine has it */
    }
#else
    for (int r = 0; r < 3; r++) {
        moments[r] = number_of(machine->second_moments[r]);
        for (int c = 0; c < 3; c++) axes[r][c] = number_of(machine->principal_axes[r][c]);
    }
#endif
    hexapod_setup(h, machine->platform.base, machine->platform.top, machine->load.mass,
                  machine->load.center_of_mass, axes, moments, machine->gravity);
    for (int v = 0; v < LEGS; v++) hexapod_leg(h, v, machine);
}

/* a machine in one lane: a hexapod is numbers throughout */
static inline void hexapod_put_machine(hexapod *h, int lane, const gough_machine *machine) {
    hexapod one;
    const number *from = (const number *)&one;
    number *to = (number *)h;

    hexapod_of_machine(&one, machine);
    for (size_t i = 0; i < sizeof one / sizeof(number); i++) {
        number_put(&to[i], lane, number_lane(from[i], lane));
    }
}

#endif
