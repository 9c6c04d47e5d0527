/* Friction of a leg: one smooth law, without functions of the C library, so that it is the same in lanes and over complex numbers,
 * (mass-12), (mass-13). Theory: docs/theory/leg-mass.md. */
#ifndef GOUGH_KERNEL_FRICTION_H
#define GOUGH_KERNEL_FRICTION_H

#include "kernel/number.h"

typedef struct {
    number viscous; /* b */
    number coulomb; /* F_C */
    number excess;  /* F_S − F_C */
    number peak;    /* 1/v_S, or 0 */
    number smooth;  /* v_0², above 0 */
    number loss;    /* e = 1/η − 1 of a screw, 0 … */
} friction;

static inline friction friction_none(void) {
    const number zero = number_of(0);

    return (friction){zero, zero, zero, zero, number_of(1), zero};
}

/* s = v/√(v² + v_0²): the sign of v, smoothed */
static inline number friction_sign(const friction *f, number v) {
    return v / number_root(v * v + f->smooth);
}

/* (mass-12): friction that does not depend on the force; s of friction_sign() */
static inline number friction_dry(const friction *f, number v, number s) {
    const number x = v * f->peak;

    return (f->coulomb + f->excess / (number_of(1) + x * x)) * s + f->viscous * v;
}

/* (mass-13): the drive force u behind the leg force F */
static inline number friction_drive(const friction *f, number F, number v) {
    const number s = friction_sign(f, v);

    return F + friction_dry(f, v, s) + f->loss * number_magnitude(F) * s;
}

/* (mass-13) solved for the leg force; one value where the loss is below 1 */
static inline number friction_leg(const friction *f, number u, number v) {
    const number s = friction_sign(f, v), left = u - friction_dry(f, v, s);
    const number driven = f->loss * number_select(number_greater(number_of(0), left), -s, s);

    return left / (number_of(1) + driven);
}

/* the most that friction holds at rest behind the leg force F, either way: (mass-13) with s = ±1 */
static inline number friction_most(const friction *f, number F) {
    return f->coulomb + f->excess + f->loss * number_magnitude(F);
}

#endif
