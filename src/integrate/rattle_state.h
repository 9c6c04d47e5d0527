/* What RATTLE carries from step to step, and what it is told of the body: text of (step-4) to (step-6) and of (mass-11) builds on
 * it. */
#ifndef GOUGH_INTEGRATE_RATTLE_STATE_H
#define GOUGH_INTEGRATE_RATTLE_STATE_H

#include "kernel/legs.h"

/* What acts on the body at rest in a pose: force in base axes, moment in central axes; damping: how both fall with (ρ̇, Ω), not
 * written if the rule is not damped. */
typedef void (*wrench_function)(void *context, real t, const coordinates *x, number wrench[6],
                                number damping[6][6]);

typedef struct {
    const body *load;
    const hexapod *legs; /* with mass; NULL: without */
    wrench_function act;
    void *context;
    int damped;
} rattle;

/* Where the body is; the wrench is that of this moment, damping included. */
typedef struct {
    coordinates x;
    vector velocity; /* ρ̇, base axes */
    vector omega;    /* Ω, central axes */
    number wrench[6];
    number momentum
        [6]; /* of load and legs, where legs have mass: linear, base axes; angular about the load's centre of mass,
                           central axes. (ρ̇, Ω) then follow from it, and are kept only where something reads them */
} rattle_state;

static inline vector rattle_inertia(const body *b) {
    return (vector){b->Iy + b->Iz, b->Iz + b->Ix, b->Ix + b->Iy};
}

static inline vector rattle_times(vector a, vector b) {
    return (vector){a.x * b.x, a.y * b.y, a.z * b.z};
}

/* wrench at velocity = wrench at rest − damping (ρ̇, Ω) */
static inline void rattle_slow(number damping[6][6], vector velocity, vector omega,
                               number wrench[6]) {
    const number v[6] = {velocity.x, velocity.y, velocity.z, omega.x, omega.y, omega.z};

    for (int r = 0; r < 6; r++) {
        for (int c = 0; c < 6; c++) wrench[r] = wrench[r] - damping[r][c] * v[c];
    }
}

/* E ← E B for the turn (w, q) on the axes of E: B a = a + 2w q×a + 2q×(q×a) */
static inline void rattle_rotate(number w, vector q, triad *e) {
    const number zero = number_of(0), one = number_of(1), two = number_of(2);
    const vector axis[3] = {{one, zero, zero}, {zero, one, zero}, {zero, zero, one}};
    vector column[3];

    for (int c = 0; c < 3; c++) {
        const vector t = scale(two, cross(q, axis[c]));
        column[c] = add(axis[c], add(scale(w, t), cross(q, t)));
    }
    const triad turn = {column[0], column[1], column[2]};
    *e = compose(e, &turn);
    triad_sweep(e); /* round-off of the product only */
}

#endif
