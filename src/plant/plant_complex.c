/* The equations over complex numbers: an imaginary step of 1e-30 rides along and comes out as an exact derivative. */
#define NUMBER_COMPLEX
#include "plant/plant_complex.h"

#include "plant/forward.h"
#include "plant/hexapod.h"
#include "plant/inverse.h"
#include "plant/state.h"

static void complex_legs(const gough_machine *machine, const number state[MOTION],
                         number length[LEGS], number rate[LEGS]) {
    const coordinates x = coordinates_load(state), v = coordinates_load(state + COORDINATES);
    hexapod h;
    legs g;

    hexapod_of_machine(&h, machine);
    legs_at(&h, &x, &g);
    legs_rates(&h, &v, &g);
    for (int i = 0; i < LEGS; i++) length[i] = g.length[i], rate[i] = g.rate[i];
}

static void complex_accelerations(const gough_machine *machine, const number state[MOTION],
                                  const number leg_force[LEGS], const number force[3],
                                  const number moment[3], number acceleration[COORDINATES]) {
    const coordinates x = coordinates_load(state), v = coordinates_load(state + COORDINATES);
    coordinates a;
    hexapod h;
    legs g;

    hexapod_of_machine(&h, machine);
    legs_at(&h, &x, &g);
    const vector pull = vector_load(force), turn = vector_load(moment);
    legs_rates(&h, &v, &g);
    a = forward_dynamics(&h, &x, &v, &g, machine->platform.legs_have_mass, leg_force, &pull, &turn);
    coordinates_store(&a, acceleration);
}

static void complex_forces(const gough_machine *machine, const number state[MOTION],
                           const number acceleration[COORDINATES], number leg_force[LEGS]) {
    const coordinates x = coordinates_load(state), v = coordinates_load(state + COORDINATES);
    const coordinates a = coordinates_load(acceleration);
    const vector none = {0, 0, 0};
    number wrench[1][6];
    hexapod h;
    legs g;

    hexapod_of_machine(&h, machine);
    legs_at(&h, &x, &g);
    required_wrench(&h, &x, &v, &a, none, none, wrench[0]);
    legs_rates(&h, &v, &g);
    if (machine->platform.legs_have_mass) required_by_legs(&h, &x, &v, &a, &g, wrench[0]);
    (void)leg_forces_of(&h, &x, &g, wrench, 1);
    for (int i = 0; i < LEGS; i++) leg_force[i] = wrench[0][i];
}

const struct dynamics_complex dynamics_complex = {complex_legs, complex_accelerations,
                                                  complex_forces};
