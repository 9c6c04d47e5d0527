/* The drives of a machine as the equations see them. Text over the number type. */
#ifndef GOUGH_DRIVE_DRIVE_NUMBERS_H
#define GOUGH_DRIVE_DRIVE_NUMBERS_H

#include "drive/drive.h"
#include "gough/model.h"
#include "kernel/real.h"

/* one lane of the drive of a leg, from 0 */
static inline void drive_put(leg_drive *d, int lane, const gough_actuators *a, int leg) {
    const real omega = 2 * REAL_PI * (real)a->frequency[leg];
    const int limited = a->max_force[leg][0] < a->max_force[leg][1];
    const int first = a->kind == GOUGH_ACTUATOR_LAG && a->time_constant[leg] > 0;
    const int slow = first && a->max_rate[leg] > 0;

    number_put(&d->least, lane, limited ? (real)a->max_force[leg][0] : -(real)INFINITY);
    number_put(&d->most, lane, limited ? (real)a->max_force[leg][1] : (real)INFINITY);
    number_put(&d->quickness, lane, first ? 1 / (real)a->time_constant[leg] : 0);
    number_put(&d->rate, lane, slow ? (real)a->max_rate[leg] : (real)INFINITY);
    number_put(&d->square, lane, omega * omega);
    number_put(&d->damping, lane, 2 * (real)a->damping_ratio[leg] * omega);
}

#endif
