/* Stages of the program side by side, a time in each lane. Text over lanes. */
#ifndef GOUGH_RUN_PREFETCH_TEXT_H
#define GOUGH_RUN_PREFETCH_TEXT_H

#include <string.h>

#include "run/prefetch.h"
#include "system/system.h"

_Static_assert((int)PREFETCH_TIMES <= (int)FORMULA_TIMES, "formulas take as many times together");
_Static_assert(PREFETCH_TIMES % NUMBER_WIDTH == 0, "whole packs");
_Static_assert(sizeof(struct system) <= PREFETCH_ROOM, "room for the lanes' own memory");

static inline void prefetch_begin(void *room, const gough_motion *motion,
                                  const gough_machine *machine, const gough_control *control,
                                  const gough_disturbance *disturbance) {
    static const gough_simulation unused = {.constraints = GOUGH_NONE};
    system_lane lane[NUMBER_WIDTH];

    for (int i = 0; i < NUMBER_WIDTH; i++)
        lane[i] = (system_lane){machine, control, disturbance, 0};
    system_begin(room, motion, &unused, lane);
}

static inline void prefetch_put_vector(vector *v, int lane, real x, real y, real z) {
    number_put(&v->x, lane, x);
    number_put(&v->y, lane, y);
    number_put(&v->z, lane, z);
}

/* displacement_of() for one lane */
static inline void prefetch_put(displacement *d, int lane, const double *axes,
                                const jet component[GOUGH_COMPONENTS]) {
    jet R[3][3];

    d->still = displacement_turn(axes, component, R);
    for (int order = 0; order < 3; order++) {
        prefetch_put_vector(&d->where[order], lane, jet_order(component[GOUGH_SURGE], order),
                            jet_order(component[GOUGH_SWAY], order),
                            jet_order(component[GOUGH_HEAVE], order));
        if (d->still) continue;
        vector *axis[3] = {&d->axes[order].i, &d->axes[order].j, &d->axes[order].k};
        for (int c = 0; c < 3; c++) {
            prefetch_put_vector(axis[c], lane, jet_order(R[0][c], order), jet_order(R[1][c], order),
                                jet_order(R[2][c], order));
        }
    }
}

/* all lanes: a block has room for whole packs */
static inline void prefetch_keep(double *where, number x) { memcpy(where, &x, sizeof x); }

/* Times from `first` on, as many as there are lanes; lanes beyond repeat the last. 0 where the equations are not the same in all
 * lanes, since only some of the times turn the load. */
static inline int prefetch_pack(struct system *r, prefetch_block *b, int first,
                                jet component[PREFETCH_TIMES][GOUGH_COMPONENTS]) {
    const int left = b->count - first, count = left < NUMBER_WIDTH ? left : NUMBER_WIDTH;
    number vertical = number_of(0);
    displacement d;
    int still = 0;
    wanted s;

    for (int i = 0; i < NUMBER_WIDTH; i++) {
        const int at = first + (i < count ? i : count - 1);
        prefetch_put(&d, i, motion_axes(r->motion), component[at]);
        still += d.still;
        if (!r->share) continue;
        number_put(&vertical, i,
                   formula_jet(&r->lane[i].disturbance->vertical_force, b->time[at]).v);
    }
    if (still != 0 && still != NUMBER_WIDTH) return 0;

    wanted_displacement(r, &d, &s);
    if (r->traits & NEEDS_RATES) legs_rates(&r->h, &s.x[1], &s.program);
    if (r->solves) wanted_forces(r, vertical, &s);
    for (int v = 0; v < LEGS; v++) {
        prefetch_keep(&b->force[v][first], s.force[v]);
        prefetch_keep(&b->length[v][first], s.program.length[v]);
        if (r->traits & NEEDS_RATES) prefetch_keep(&b->rate[v][first], s.program.rate[v]);
    }
    prefetch_keep(&b->determinant[first], s.singularity.determinant);
    prefetch_keep(&b->pivot_ratio[first], s.singularity.pivot_ratio);
    return 1;
}

static inline void prefetch_fill(void *room, prefetch_block *b) {
    jet component[PREFETCH_TIMES][GOUGH_COMPONENTS];
    struct system *r = room;

    motion_components_at(r->motion, b->count, b->time, component);
    for (int k = 0; k < b->count; k++) b->fault[k] = wanted_flaw(component[k]);
    for (int first = 0; first < b->count; first += NUMBER_WIDTH) {
        if (!prefetch_pack(r, b, first, component)) b->count = first;
    }
}

#define PREFETCH_WIDTH                                                                             \
    { NUMBER_WIDTH, prefetch_begin, prefetch_fill }

#endif
