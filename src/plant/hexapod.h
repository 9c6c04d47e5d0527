/* The public machine (double) as the hexapod of a number type. */
#ifndef GOUGH_PLANT_HEXAPOD_H
#define GOUGH_PLANT_HEXAPOD_H

#include "gough/model.h"
#include "kernel/principal.h"
#include "kernel/top.h"

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
