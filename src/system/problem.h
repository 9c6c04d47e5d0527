/* A machine in motion as the time loop takes it: its equations, and the times that no step may pass. Text over the number type.
 * Theory: docs/theory/steppers.md. */
#ifndef GOUGH_SYSTEM_PROBLEM_H
#define GOUGH_SYSTEM_PROBLEM_H

#include "integrate/march.h"
#include "program/appointments.h"
#include "system/system.h"

/* what the steppers see of a system */
static inline march_problem system_problem(struct system *r) {
    const hexapod *heavy = r->traits & MOVING_MASS ? &r->h : NULL;
    const rattle rule = {&r->h.load, heavy, system_wrench, r, r->traits & LINEAR_IN_RATES};

    return (march_problem){r->states, system_rates, rule, r};
}

static inline double system_part(void *clock, double t, double end, double length) {
    return appointments_part(clock, t, end, length);
}

/* how a run goes through time, from 0 */
static inline march system_march(const gough_simulation *o, appointments *when) {
    const int method = o->method == GOUGH_DOP853 ? MARCH_DOP853
                       : o->method == GOUGH_RK4  ? MARCH_RK4
                                                 : MARCH_RATTLE + (int)o->method - GOUGH_RATTLE2;

    return (march){.method = method,
                   .length = o->step,
                   .until = o->duration,
                   .part = system_part,
                   .clock = when};
}

#endif
