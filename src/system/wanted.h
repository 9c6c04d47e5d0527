/* What is wanted at a time and what disturbs then: all that depends on time alone, found once and then the same for every
 * lane. Text over the number type. Theory: docs/theory/control.md. */
#ifndef GOUGH_SYSTEM_WANTED_H
#define GOUGH_SYSTEM_WANTED_H

#include "system/noise.h"
#include "system/parts.h"

/* the component that is not finite, or NULL */
static inline const char *wanted_flaw(const jet component[GOUGH_COMPONENTS]) {
    static const char *const name[GOUGH_COMPONENTS] = {
        "motion.surge", "motion.sway", "motion.heave", "motion.roll", "motion.pitch", "motion.yaw"};

    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        if (!real_finite(component[c].v + component[c].d + component[c].dd)) return name[c];
    }
    return NULL;
}

/* jets of the program at t, checked */
static inline void wanted_components(struct system *r, real t, jet component[GOUGH_COMPONENTS]) {
    motion_components(r->motion, t, component);
    const char *flaw = wanted_flaw(component);
    if (flaw) wanted_blame(r, flaw, t);
}

/* the formula of a disturbance, by its place in gough_disturbance, in every lane */
static inline number wanted_disturbance(struct system *r, size_t place, const char *what, real t) {
    number sum = number_of(0);

    for (int i = 0; i < NUMBER_WIDTH; i++) {
        const gough_formula *formula =
            (const gough_formula *)(const void *)((const char *)r->lane[i].disturbance + place);
        const real value = formula_jet(formula, t).v;
        if (!real_finite(value)) wanted_blame(r, what, t);
        number_put(&sum, i, value);
    }
    return sum;
}

/* F^p, of the drives, and the share of each leg in a vertical force: solutions of the same six equations, (law-2) */
static inline void wanted_forces(struct system *r, number vertical, wanted *s) {
    const number zero = number_of(0);
    vector force = {zero, zero, zero}, moment = force;
    number *shake = wanted_shake(r, s);
    number wrench[2][6];
    int count = 0, program = -1, share = -1;

    if (r->feeds) {
        program = count++;
        if (r->knows & EXTERNAL) known_load_wrench(&s->external, &s->x[0].q, &force, &moment);
        required_wrench(&r->h, &s->x[0], &s->x[1], &s->x[2], force, moment, wrench[program]);
        if (r->knows & MOVING_MASS) {
            required_by_legs(&r->h, &s->x[0], &s->x[1], &s->x[2], &s->program, wrench[program]);
        }
    }
    if (r->share) {
        share = count++;
        central_wrench(&s->x[0], (vector){zero, zero, vertical}, wrench[share]);
    }
    if (count > 0) s->singularity = leg_forces_of(&r->h, &s->x[0], &s->program, wrench, count);
    for (int v = 0; v < LEGS; v++) {
        if (program >= 0) s->force[v] = s->leg[v] = wrench[program][v];
        if (program >= 0 && r->knows & FRICTION) {
            s->force[v] = friction_drive(&r->h.dry[v], s->force[v], s->program.rate[v]);
        }
        if (share >= 0) shake[v] = shake[v] + wrench[share][v];
    }
}

/* what disturbs legs and load */
static inline void wanted_disturb(struct system *r, real t, wanted *s) {
    const size_t force = offsetof(gough_disturbance, force),
                 moment = offsetof(gough_disturbance, moment), one = sizeof(gough_formula);
    number *shake = wanted_shake(r, s);

    for (int v = 0; v < LEGS; v++) {
        static const char *const name[LEGS] = {
            "disturbance.leg_force.1", "disturbance.leg_force.2", "disturbance.leg_force.3",
            "disturbance.leg_force.4", "disturbance.leg_force.5", "disturbance.leg_force.6"};
        const size_t place = offsetof(gough_disturbance, leg_force) + (size_t)v * one;
        if (!r->shaken[v]) continue;
        shake[v] = shake[v] + wanted_disturbance(r, place, name[v], t);
    }
    s->push = s->turn = (vector){number_of(0), number_of(0), number_of(0)};
    if (!r->loaded) return;
    s->push.x = wanted_disturbance(r, force, "disturbance.force.1", t);
    s->push.y = wanted_disturbance(r, force + one, "disturbance.force.2", t);
    s->push.z = wanted_disturbance(r, force + 2 * one, "disturbance.force.3", t);
    s->turn.x = wanted_disturbance(r, moment, "disturbance.moment.1", t);
    s->turn.y = wanted_disturbance(r, moment + one, "disturbance.moment.2", t);
    s->turn.z = wanted_disturbance(r, moment + 2 * one, "disturbance.moment.3", t);
}

/* the program's motion in a stage, no rates of legs and no forces yet */
static inline void wanted_displacement(struct system *r, const displacement *d, wanted *s) {
    for (int v = 0; v < LEGS; v++) s->force[v] = s->shake[v] = number_of(0);
    s->singularity = (elimination){number_of(1), number_of(1)};
    coordinates_of_displacement(&r->h, r->height, r->motion->about, d, s->x);
    legs_at(&r->h, &s->x[0], &s->program);
}

static inline void wanted_program(struct system *r, const jet component[GOUGH_COMPONENTS],
                                  wanted *s) {
    displacement d;

    displacement_of(motion_frame(r->motion), component, &d);
    wanted_displacement(r, &d, s);
    legs_rates(&r->h, &s->x[1], &s->program);
}

static inline number wanted_vertical(struct system *r, real t) {
    return wanted_disturbance(r, offsetof(gough_disturbance, vertical_force),
                              "disturbance.vertical_force", t);
}

/* all of a stage from its own formulas */
static inline void wanted_evaluate(struct system *r, real t, wanted *s) {
    jet component[GOUGH_COMPONENTS];

    wanted_components(r, t, component);
    wanted_program(r, component, s);
    wanted_external(r, t, s);
    if (r->solves) wanted_forces(r, r->share ? wanted_vertical(r, t) : number_of(0), s);
    wanted_disturb(r, t, s);
    if (r->noise.present) noise_add(r, t, s);
}

static inline const wanted *system_wanted(struct system *r, real t) {
    if (r->valid && !(t < r->time) && !(t > r->time)) return &r->now;
    if (r->provide) {
        r->provide(r, t);
    } else {
        wanted_evaluate(r, t, &r->now);
    }
    r->time = t;
    r->valid = 1;
    return &r->now;
}

/* the same with all that rows and singular poses are read from, where what is replayed lacks it */
static inline const wanted *system_whole(struct system *r, real t) {
    const wanted *s = system_wanted(r, t);

    if (!r->partial) return s;
    wanted_evaluate(r, t, &r->now);
    r->partial = 0;
    return s;
}

/* the same with the program's pose, which rows compare with */
static inline const wanted *system_posed(struct system *r, real t) {
    const wanted *s = system_wanted(r, t);

    return r->partial == PARTIAL_UNPOSED ? system_whole(r, t) : s;
}

#endif
