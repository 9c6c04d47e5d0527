/* A run's stages taken from blocks made ready ahead of its steps, in lanes, where it computes in double on a processor with
 * registers of several doubles; else one by one. For scalar number types. */
#ifndef GOUGH_SIMULATE_LOOKAHEAD_H
#define GOUGH_SIMULATE_LOOKAHEAD_H

#include "system/system.h"

#if defined(NUMBER_DOUBLE) && (defined(__x86_64__) || defined(__aarch64__))

#include "simulate/ahead.h"

typedef struct {
    const struct ahead_width *width;
    ahead_block block;
    _Alignas(64) unsigned char room[AHEAD_ROOM];
} lookahead;

/* a stage from the block; what disturbs is added as wanted_evaluate() does */
static inline void lookahead_take(struct system *r, real t, const ahead_block *b, int at) {
    wanted *s = &r->now;

    if (b->fault[at]) wanted_blame(r, b->fault[at], t);
    for (int v = 0; v < LEGS; v++) {
        s->force[v] = b->force[v][at];
        s->program.length[v] = b->length[v][at];
        if (r->traits & NEEDS_RATES) s->program.rate[v] = b->rate[v][at];
    }
    s->singularity = (elimination){b->determinant[at], b->pivot_ratio[at]};
    wanted_disturb(r, t, s);
    if (r->noise.present) noise_add(r, t, s);
    r->partial = 1;
}

static inline void lookahead_replay(struct system *r, real t) {
    ahead_block *b = &((lookahead *)r->provider)->block;

    for (int i = 0, at = b->cursor; i < b->count; i++, at = at + 1 < b->count ? at + 1 : 0) {
        if (b->time[at] < t || b->time[at] > t) continue;
        lookahead_take(r, t, b, at);
        b->cursor = at + 1 < b->count ? at + 1 : 0;
        return;
    }
    wanted_evaluate(r, t, &r->now);
    r->partial = 0;
}

static inline void lookahead_begin(lookahead *l, struct system *r) {
    l->width = ahead_widest();
    l->width->begin(l->room, r->motion, r->lane[0].machine, r->lane[0].control,
                    r->lane[0].disturbance);
    l->block.count = l->block.cursor = 0;
    r->provider = l;
    r->provide = lookahead_replay;
}

/* a time that steps will ask for; beyond the block's size it is forgotten, and evaluated when asked for */
static inline void lookahead_announce(lookahead *l, real t) {
    ahead_block *b = &l->block;

    if (b->count == AHEAD_TIMES) return;
    if (b->count > 0 && !(b->time[b->count - 1] < t) && !(b->time[b->count - 1] > t)) return;
    b->time[b->count++] = t;
}

static inline void lookahead_clear(lookahead *l) { l->block.count = l->block.cursor = 0; }

static inline void lookahead_ready(lookahead *l) { l->width->fill(l->room, &l->block); }

#else

typedef struct {
    int none;
} lookahead;

static inline void lookahead_begin(lookahead *l, struct system *r) {
    (void)r;
    l->none = 0;
}
static inline void lookahead_announce(lookahead *l, real t) {
    (void)l;
    (void)t;
}
static inline void lookahead_clear(lookahead *l) { (void)l; }
static inline void lookahead_ready(lookahead *l) { (void)l; }

#endif

#endif
