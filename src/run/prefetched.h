/* A run's stages taken from blocks made ready ahead of its steps, in lanes, where it computes in double on a processor with
 * registers of several doubles; else one by one. For scalar number types. */
#ifndef GOUGH_RUN_PREFETCHED_H
#define GOUGH_RUN_PREFETCHED_H

#include "system/system.h"

#if defined(NUMBER_DOUBLE) && (defined(__x86_64__) || defined(__aarch64__))

#include "run/prefetch_program.h"

typedef struct {
    const struct prefetch_width *width, *narrow; /* narrow: for a few times at the end, or NULL */
    prefetch_block block;
    _Alignas(64) unsigned char room[PREFETCH_ROOM], narrow_room[PREFETCH_ROOM];
} prefetched;

/* a stage from the block; what disturbs is added as wanted_evaluate() does */
static inline void prefetched_take(struct system *r, real t, const prefetch_block *b, int at) {
    wanted *s = &r->now;

    if (b->fault[at]) wanted_blame(r, b->fault[at], t);
    for (int v = 0; v < LEGS; v++) {
        s->force[v] = b->force[v][at];
        s->program.length[v] = b->length[v][at];
        if (r->traits & (NEEDS_RATES | PROGRAM_RATES)) s->program.rate[v] = b->rate[v][at];
        s->shake[v] = 0;
    }
    s->singularity = (elimination){b->determinant[at], b->pivot_ratio[at]};
    wanted_external(r, t, s);
    wanted_disturb(r, t, s);
    if (r->noise.present) noise_add(r, t, s);
    r->partial = PARTIAL_UNPOSED;
    if (!b->posed) return;
    real pose[COORDINATES];
    for (int i = 0; i < COORDINATES; i++) pose[i] = b->pose[i][at];
    s->x[0] = coordinates_load(pose);
    r->partial = PARTIAL_POSED;
}

static inline void prefetched_replay(struct system *r, real t) {
    prefetch_block *b = &((prefetched *)r->provider)->block;

    for (int i = 0, at = b->cursor; i < b->count; i++, at = at + 1 < b->count ? at + 1 : 0) {
        if (b->time[at] < t || b->time[at] > t) continue;
        prefetched_take(r, t, b, at);
        b->cursor = at + 1 < b->count ? at + 1 : 0;
        return;
    }
    wanted_evaluate(r, t, &r->now);
    r->partial = 0;
}

/* forgets the block for another; posed: with the program's pose, for rows */
static inline void prefetched_clear(prefetched *l, int posed) {
    l->block.count = l->block.cursor = 0;
    l->block.posed = posed;
}

static inline void prefetched_begin(prefetched *l, struct system *r) {
    l->width = prefetch_widest();
    l->width->begin(l->room, r->motion, r->lane[0].machine, r->lane[0].control,
                    r->lane[0].disturbance);
    l->narrow = prefetch_narrow();
    if (l->narrow) {
        l->narrow->begin(l->narrow_room, r->motion, r->lane[0].machine, r->lane[0].control,
                         r->lane[0].disturbance);
    }
    prefetched_clear(l, 0);
    r->provider = l;
    r->provide = prefetched_replay;
}

/* a time that steps will ask for; beyond the block's size it is forgotten, and evaluated when asked for */
static inline void prefetched_announce(prefetched *l, real t) {
    prefetch_block *b = &l->block;

    if (b->count == PREFETCH_TIMES) return;
    if (b->count > 0 && !(b->time[b->count - 1] < t) && !(b->time[b->count - 1] > t)) return;
    b->time[b->count++] = t;
}

static inline void prefetched_ready(prefetched *l) {
    prefetch_program program;

    l->width->formulas(l->room, &l->block, &program);
    const int at =
        l->width->fill(l->room, &l->block, &program, 0, l->narrow ? l->narrow->lanes : 0);
    if (l->narrow) (void)l->narrow->fill(l->narrow_room, &l->block, &program, at, 0);
}

#else

typedef struct {
    int none;
} prefetched;

static inline void prefetched_begin(prefetched *l, struct system *r) {
    (void)r;
    l->none = 0;
}
static inline void prefetched_announce(prefetched *l, real t) {
    (void)l;
    (void)t;
}
static inline void prefetched_clear(prefetched *l, int posed) {
    (void)l;
    (void)posed;
}
static inline void prefetched_ready(prefetched *l) { (void)l; }

#endif

#endif
