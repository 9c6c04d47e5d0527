/* Stages of the program side by side, a time in each lane. Text over lanes. */
#ifndef GOUGH_RUN_PREFETCH_TEXT_H
#define GOUGH_RUN_PREFETCH_TEXT_H

#include <string.h>

#include "run/prefetch_program.h"
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
        lane[i] = (system_lane){machine, control, disturbance, 0, 0};
    system_begin(room, motion, &unused, lane);
}

static inline number prefetch_load(const double *row) {
    number x;

    memcpy(&x, row, sizeof x);
    return x;
}

static inline vector prefetch_vector(const double (*row)[PREFETCH_TIMES], int first) {
    return (vector){prefetch_load(row[0] + first), prefetch_load(row[1] + first),
                    prefetch_load(row[2] + first)};
}

/* fills the rows: from the formulas up to the block's count, and beyond it by repeating the last time */
static inline void prefetch_evaluate(struct system *r, prefetch_block *b, prefetch_program *p) {
    const angle_frame frame = motion_frame(r->motion);
    jet component[GOUGH_COMPONENTS], R[3][3];
    double nothing[PREFETCH_TIMES] = {0}, size[PREFETCH_TIMES] = {0};

    motion_components_at(r->motion, b->count, b->time, p->component);
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        for (int k = 0; k < b->count; k++) {
            const jet x = formula_get(&p->component[c], k);
            nothing[k] += 0 * (x.v + x.d + x.dd); /* NaN where one is not finite */
            if (c >= GOUGH_ROLL) size[k] += jet_size(x);
        }
    }
    for (int k = 0; k < b->count; k++) {
        b->fault[k] = NULL;
        p->still[k] = jet_vanishes(size[k]);
        if (p->still[k] && jet_vanishes(nothing[k])) continue;
        motion_components_of(p->component, k, component);
        b->fault[k] = wanted_flaw(component);
        p->still[k] = displacement_turn(frame, component, R);
        for (int i = 0; i < 9 && !p->still[k]; i++) {
            for (int order = 0; order < 3; order++)
                p->turn[9 * order + i][k] = jet_order(R[i % 3][i / 3], order);
        }
    }
    for (int k = b->count; k % NUMBER_WIDTH != 0; k++) {
        const int last = b->count - 1;
        for (int c = 0; c < GOUGH_COMPONENTS; c++)
            formula_put(&p->component[c], k, formula_get(&p->component[c], last));
        p->still[k] = p->still[last];
        for (int i = 0; i < PREFETCH_TURN && !p->still[k]; i++) p->turn[i][k] = p->turn[i][last];
    }
}

/* displacement_of() for the times from `first` on; 0 where only some of them turn the load */
static inline int prefetch_displacement(const prefetch_program *p, int first, displacement *d) {
    const formula_row *c = p->component;
    int still = 0;

    for (int i = 0; i < NUMBER_WIDTH; i++) still += p->still[first + i];
    d->still = still == NUMBER_WIDTH;
    d->where[0] = (vector){prefetch_load(c[0].v + first), prefetch_load(c[1].v + first),
                           prefetch_load(c[2].v + first)};
    d->where[1] = (vector){prefetch_load(c[0].d + first), prefetch_load(c[1].d + first),
                           prefetch_load(c[2].d + first)};
    d->where[2] = (vector){prefetch_load(c[0].dd + first), prefetch_load(c[1].dd + first),
                           prefetch_load(c[2].dd + first)};
    for (int order = 0; order < 3 && still == 0; order++) {
        const double(*row)[PREFETCH_TIMES] = p->turn + (ptrdiff_t)9 * order;
        d->axes[order] = (triad){prefetch_vector(row, first), prefetch_vector(row + 3, first),
                                 prefetch_vector(row + 6, first)};
    }
    return still == 0 || d->still;
}

/* all lanes: a block has room for whole packs */
static inline void prefetch_keep(double *where, number x) { memcpy(where, &x, sizeof x); }

/* Times from `first` on, as many as there are lanes. 0 where the equations are not the same in all lanes. */
static inline int prefetch_pack(struct system *r, prefetch_block *b, int first,
                                const prefetch_program *p) {
    number vertical = number_of(0);
    displacement d;
    wanted s;

    if (!prefetch_displacement(p, first, &d)) return 0;
    for (int i = 0; i < NUMBER_WIDTH && r->share; i++) {
        const int at = first + i < b->count ? first + i : b->count - 1;
        number_put(&vertical, i,
                   formula_jet(&r->lane[i].disturbance->vertical_force, b->time[at]).v);
    }

    wanted_displacement(r, &d, &s);
    if (r->traits & (NEEDS_RATES | PROGRAM_RATES)) legs_rates(&r->h, &s.x[1], &s.program);
    if (r->feeds && r->knows & EXTERNAL) {
        real times[NUMBER_WIDTH];
        for (int i = 0; i < NUMBER_WIDTH; i++)
            times[i] = b->time[first + i < b->count ? first + i : b->count - 1];
        s.external = external_loads(r, times);
    }
    if (r->solves) wanted_forces(r, vertical, &s);
    for (int v = 0; v < LEGS; v++) {
        prefetch_keep(&b->force[v][first], s.force[v]);
        prefetch_keep(&b->length[v][first], s.program.length[v]);
        if (r->traits & (NEEDS_RATES | PROGRAM_RATES))
            prefetch_keep(&b->rate[v][first], s.program.rate[v]);
    }
    prefetch_keep(&b->determinant[first], s.singularity.determinant);
    prefetch_keep(&b->pivot_ratio[first], s.singularity.pivot_ratio);
    if (b->posed) {
        number pose[COORDINATES];
        coordinates_store(&s.x[0], pose);
        for (int i = 0; i < COORDINATES; i++) prefetch_keep(&b->pose[i][first], pose[i]);
    }
    return 1;
}

static inline void prefetch_formulas(void *room, prefetch_block *b, prefetch_program *p) {
    prefetch_evaluate(room, b, p);
}

static inline int prefetch_fill(void *room, prefetch_block *b, const prefetch_program *p, int first,
                                int leave) {
    for (; b->count - first > leave; first += NUMBER_WIDTH) {
        if (!prefetch_pack(room, b, first, p)) b->count = first;
    }
    return first;
}

#define PREFETCH_WIDTH                                                                             \
    { NUMBER_WIDTH, prefetch_begin, prefetch_formulas, prefetch_fill }

#endif
