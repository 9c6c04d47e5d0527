/* The control law. Theory: docs/theory/control.md. */
#ifndef GOUGH_KERNEL_LAW_H
#define GOUGH_KERNEL_LAW_H

#include "kernel/number.h"

/* (law-1): F = F^p + G (l^p − l) + D (l̇^p − l̇) */
static inline number law_force(number program_force, number G, number D, number program_length,
                               number program_rate, number length, number rate) {
    return program_force + G * (program_length - length) + D * (program_rate - rate);
}

#endif
