/* The control law. Theory: docs/theory/control.md. */
#ifndef GOUGH_CONTROL_LAW_H
#define GOUGH_CONTROL_LAW_H

#include "kernel/legs.h"

/* (law-1): F = F^p + G (l^p − l) + D (l̇^p − l̇); the first part alone where no leg is damped */
static inline number law_stiff(number program_force, number G, number program_length,
                               number length) {
    return program_force + G * (program_length - length);
}

static inline number law_force(number program_force, number G, number D, number program_length,
                               number program_rate, number length, number rate) {
    return law_stiff(program_force, G, program_length, length) + D * (program_rate - rate);
}

/* G and D as matrices: what stands outside their diagonals */
typedef struct {
    number stiffness[LEGS][LEGS], damping[LEGS][LEGS];
} law_coupling;

/* adds what the errors of the other legs ask of each leg */
static inline void law_couple(const law_coupling *c, const number error[LEGS],
                              const number rate[LEGS], number u[LEGS]) {
    for (int v = 0; v < LEGS; v++) {
        for (int w = 0; w < LEGS; w++) {
            u[v] = u[v] + c->stiffness[v][w] * error[w] + c->damping[v][w] * rate[w];
        }
    }
}

#endif
