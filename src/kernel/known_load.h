/* Known loads on the top besides its weight, (law-4): their sum as numbers that do not depend on the pose, and what it is in a
 * pose. Text over the number type. Theory: docs/theory/control.md. */
#ifndef GOUGH_KERNEL_KNOWN_LOAD_H
#define GOUGH_KERNEL_KNOWN_LOAD_H

#include "kernel/legs.h"

/* One part are the loads with the axes of the base, the other those that turn with the top, in central axes. Of each: the force
 * and its first moments, F and Q_i = Σ x F …, and the couples. */
typedef struct {
    push fixed, turning;
    vector fixed_couple, turning_couple;
} known_load;

static inline known_load known_load_none(void) {
    const push none = push_none();

    return (known_load){none, none, none.F, none.F};
}

/* a force that acts at `arm`, central axes */
static inline void push_add_at(push *p, vector arm, vector f) {
    p->F = add(p->F, f);
    p->Q.i = along(p->Q.i, arm.x, f);
    p->Q.j = along(p->Q.j, arm.y, f);
    p->Q.k = along(p->Q.k, arm.z, f);
}

/* one more load at `arm` (central axes, from the centre of mass); with the axes of the base, or turning, with those of the top
 * frame */
static inline void known_load_add(known_load *k, const hexapod *h, int turns, vector arm,
                                  vector force, vector couple) {
    if (turns) {
        push_add_at(&k->turning, arm, onto(&h->axes, force));
        k->turning_couple = add(k->turning_couple, onto(&h->axes, couple));
    } else {
        push_add_at(&k->fixed, arm, force);
        k->fixed_couple = add(k->fixed_couple, couple);
    }
}

/* the forces in a pose, base axes, without the couples */
static inline push known_load_push(const known_load *k, const triad *q) {
    const push *own = &k->turning;

    return (push){add(k->fixed.F, out_of(q, own->F)),
                  {add(k->fixed.Q.i, out_of(q, own->Q.i)), add(k->fixed.Q.j, out_of(q, own->Q.j)),
                   add(k->fixed.Q.k, out_of(q, own->Q.k))}};
}

static inline vector known_load_couple(const known_load *k, const triad *q) {
    return add(k->fixed_couple, out_of(q, k->turning_couple));
}

/* adds the loads in a pose to a force at the centre of mass and a moment, base axes */
static inline void known_load_wrench(const known_load *k, const triad *q, vector *force,
                                     vector *moment) {
    const push p = known_load_push(k, q);

    *force = add(*force, p.F);
    *moment = add(*moment, add(out_of(q, push_moment(&p, q)), known_load_couple(k, q)));
}

#endif
