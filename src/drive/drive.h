/* The drive of a leg: what it makes of its command. Text over the number type. Theory: docs/theory/loop.md. */
#ifndef GOUGH_DRIVE_DRIVE_H
#define GOUGH_DRIVE_DRIVE_H

#include "kernel/number.h"

/* (act-1) of one leg. Unused numbers are such that the formulas hold without them: limits are infinite. */
typedef struct {
    number least, most;     /* of the command */
    number quickness;       /* 1/T_a */
    number rate;            /* greatest |ḟ| */
    number square, damping; /* ω_a², 2 ζ_a ω_a */
} leg_drive;

/* sat(u) */
static inline number drive_takes(const leg_drive *d, number u) {
    return number_between(u, d->least, d->most);
}

/* ḟ of a lag of first order, whose command is u */
static inline number drive_first(const leg_drive *d, number u, number f) {
    return number_between((u - f) * d->quickness, -d->rate, d->rate);
}

/* f̈ of a lag of second order */
static inline number drive_second(const leg_drive *d, number u, number f, number rate) {
    return d->square * (u - f) - d->damping * rate;
}

/* what holds a drive back from the command r: 1 its force, 5 the rate of its force, else 0 */
static inline number drive_held(const leg_drive *d, number r, number u, number f) {
    const number none = number_of(0);
    const mask slow = number_greater(number_magnitude((u - f) * d->quickness), d->rate);
    const mask weak = number_greater(number_magnitude(r - u), none);

    return number_select(weak, number_of(1), number_select(slow, number_of(5), none));
}

#endif
