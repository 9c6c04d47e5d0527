/* From samples to intervals. Between two samples nothing happened if the same modes grow at both and no two multipliers of opposite
 * kind have passed each other; else the interval is divided where that is expected. Theory: docs/theory/floquet.md. */
#include "map/scan.h"

#include <math.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

/* a phase that turned further than this between two samples may have hidden something */
static const double far_turned = 0.8;

enum { DEEPEST = 90 };

/* ---- what happened between two samples ---- */

typedef struct {
    bool changed; /* other modes grow */
    bool passed;  /* multipliers of opposite kind passed each other, or nobody knows */
    double place; /* part of the way at which they did, NaN if unknown */
} change;

static int growers_of(const sample *s, int kind) {
    int count = 0;

    for (int i = 0; i < s->growers; i++) count += grower_kind(&s->grows[i]) == kind;
    return count;
}

/* twice the number of full turns of φ_j + φ_k, and 1 more between them: even only while the two are off the circle together */
static int station(double sum, bool held) {
    return held ? 2 * (int)lround(sum / (2 * pi)) : 2 * (int)floor(sum / (2 * pi)) + 1;
}

/* phases of b continued from those of a: all sorted, so that the rising ones keep their order; the sum rises by less than a turn */
static void continued(const sample *a, const sample *b, double phase[MODES], bool off[MODES]) {
    double total = 0;
    int shift;

    for (int k = 0; k < MODES; k++) total += b->phase[k] - a->phase[k];
    shift = (int)ceil((-0.5 - total) / (2 * pi));
    for (int k = 0; k < MODES; k++) {
        const int turn = (int)floor((double)(k + shift) / MODES), i = k + shift - turn * MODES;
        phase[k] = b->phase[i] + 2 * pi * turn;
        off[k] = b->off[i];
    }
}

/* one of two off the circle cannot meet the other, whatever their angles */
static bool one_off(const bool off[MODES], int j, int k) { return off[j] != off[k]; }

/* (floquet-23) */
static void passings(const sample *a, const sample *b, change *c) {
    double phase[MODES];
    bool off[MODES];

    continued(a, b, phase, off);
    for (int j = 0; j < MODES; j++) {
        if (fabs(phase[j] - a->phase[j]) > far_turned) c->passed = true;
        for (int k = 0; k <= j; k++) {
            const double sum = a->phase[j] + a->phase[k], next = phase[j] + phase[k];
            const int from = station(sum, a->off[j] && a->off[k]);
            const int to = station(next, off[j] && off[k]);
            double place;
            if (from == to || (one_off(a->off, j, k) && one_off(off, j, k))) continue;
            c->passed = true;
            if (from % 2 == 0 || to % 2 == 0) continue;
            place = (2 * pi * ceil(sum / (2 * pi)) - sum) / (next - sum);
            if (!(place >= c->place)) c->place = place;
        }
    }
}

/* of a loop each of whose stiffnesses is on its own: where the largest multiplier leaves the circle, if it does so in proportion */
static void count_growers(const sample *a, const sample *b, change *c) {
    c->changed = a->growers != b->growers;
    if (a->growers == 0 || b->growers == 0) c->place = a->size / (a->size - b->size);
}

static change between(const scan *s, const sample *a, const sample *b) {
    change c = {false, false, NAN};

    if (s->alone) {
        count_growers(a, b, &c);
        return c;
    }
    for (int kind = 0; kind < 3; kind++) c.changed |= growers_of(a, kind) != growers_of(b, kind);
    if (a->phased && b->phased) passings(a, b, &c);
    return c;
}

/* where to look next: in the middle, or beyond the expected place so that it is enclosed from both sides */
static double division(const scan *s, const sample *a, const sample *b, const change *c,
                       int depth) {
    const double width = b->stiffness - a->stiffness,
                 least = 0.45 * (s->alone ? s->edge : s->resolution) / width;
    double part = c->place;

    if ((c->changed && !s->alone) || !(part > 0 && part < 1) || depth % 4 == 3) return 0.5;
    if (part < 0.1) part = fmax(2 * part, least);
    if (part > 0.9) part = 1 - fmax(2 * (1 - part), least);
    return fmin(fmax(part, 0.02), 0.98);
}

/* ---- intervals ---- */

/* how unlike a grower is to what it was */
static double unlike(const scan *s, const grower *a, const grower *b) {
    double sum = fabs(a->size - b->size) / (0.1 + fabs(a->size) + fabs(b->size));

    for (int k = 0; k < 4; k++) sum += fabs(a->mode.share[k] - b->mode.share[k]);
    return sum + (!s->alone && grower_kind(a) != grower_kind(b) ? 10 : 0);
}

static bool within(const scan *s, double stiffness) {
    return stiffness >= s->low && stiffness <= s->high;
}

static void notice(const scan *s, track *t, const grower *g, double stiffness) {
    if (t->waiting) t->after = stiffness, t->waiting = false;
    if (within(s, stiffness) && (!t->seen || g->size > t->most.size)) {
        t->before = t->seen ? t->at : t->from;
        t->best = t->after = stiffness;
        t->most = *g;
        t->seen = t->waiting = true;
    }
    t->last = *g;
    t->at = stiffness;
}

/* the same mode at another stiffness; size −INFINITY where it does not grow */
static grower same_mode(scan *s, const grower *like, double stiffness) {
    grower best = {{0, 0}, -INFINITY, like->mode};
    double nearest = 3;
    sample at;

    s->stopped |= s->look(s->context, stiffness, &at);
    for (int i = 0; i < at.growers; i++) {
        const double far = unlike(s, like, &at.grows[i]);
        if (far < nearest) nearest = far, best = at.grows[i];
    }
    return best;
}

/* golden section for the greatest growth */
static void refine(scan *s, track *t) {
    const double golden = 0.61803398874989485;
    double a = fmax(fmax(t->before, t->from), s->low), b = fmin(t->after, s->high);
    double x[2] = {b - golden * (b - a), a + golden * (b - a)};
    grower g[2];

    if (!(b > a)) return;
    for (int i = 0; i < 2; i++) g[i] = same_mode(s, &t->most, x[i]);
    for (int sweep = 0; sweep < s->sweeps && !s->stopped; sweep++) {
        const int keep = g[1].size > g[0].size;
        if (g[keep].size > t->most.size) t->most = g[keep], t->best = x[keep];
        if (keep) {
            a = x[0], x[0] = x[1], g[0] = g[1];
            x[1] = a + golden * (b - a);
            g[1] = same_mode(s, &t->most, x[1]);
        } else {
            b = x[1], x[1] = x[0], g[1] = g[0];
            x[0] = b - golden * (b - a);
            g[0] = same_mode(s, &t->most, x[0]);
        }
    }
}

static gough_interval_kind kind_of_track(const scan *s, const track *t) {
    switch (grower_kind(&t->most)) {
    case 0:
        return t->from_zero ? GOUGH_INTERVAL_STATIC : GOUGH_INTERVAL_PLUS;
    case 1:
        return s->period > 0 ? GOUGH_INTERVAL_MINUS : GOUGH_INTERVAL_STATIC;
    default:
        return GOUGH_INTERVAL_COMBINATION;
    }
}

static gough_interval_kind kind_by_opening(const scan *s, const track *t) {
    const bool below = t->from_zero && t->from < s->threshold;

    if (t->opened == 0 && (below || !(s->period > 0))) return GOUGH_INTERVAL_STATIC;
    if (t->opened == 2 || !(s->period > 0)) return GOUGH_INTERVAL_OSCILLATION;
    return t->opened == 0 ? GOUGH_INTERVAL_PLUS : GOUGH_INTERVAL_MINUS;
}

static void close_track(scan *s, track *t, double to, bool cut) {
    gough_interval interval = {.from = t->from, .to = to, .cut = cut};

    if (!t->seen) { /* narrower than all steps, or below the range */
        if (to < s->low) return;
        t->before = t->from, t->after = to;
        t->best = fmax(t->from, s->low), t->most = t->last;
    }
    refine(s, t);
    interval.stiffness = t->best;
    interval.growth = s->period > 0 ? exp(t->most.size) : NAN;
    interval.rate = s->period > 0 ? t->most.size / s->period : t->most.size;
    interval.mode = t->most.mode;
    interval.kind = s->alone ? kind_by_opening(s, t) : kind_of_track(s, t);
    if (s->found) s->found(s->context, &interval);
}

static void open_track(scan *s, const grower *g, double from, double stiffness, bool from_zero) {
    track *t;

    if (s->actives == GOUGH_LINEAR) return;
    t = &s->active[s->actives++];
    memset(t, 0, sizeof *t);
    t->from = from;
    t->from_zero = from_zero;
    t->opened = grower_kind(g);
    notice(s, t, g, stiffness);
}

/* from sample a to sample b, between which at most edges lie: the likest continue, the others end or begin half way */
static void advance(scan *s, const sample *a, const sample *b) {
    const double edge = a->stiffness + 0.5 * (b->stiffness - a->stiffness);
    bool taken[GOUGH_LINEAR] = {false}, kept[GOUGH_LINEAR] = {false};
    int remaining = 0;

    for (;;) {
        double nearest = 5; /* another kind of multiplier is another interval */
        int from = -1, to = -1;
        for (int i = 0; i < s->actives; i++) {
            for (int j = 0; j < b->growers && !kept[i]; j++) {
                const double far = taken[j] ? 5 : unlike(s, &s->active[i].last, &b->grows[j]);
                if (far < nearest) nearest = far, from = i, to = j;
            }
        }
        if (from < 0) break;
        kept[from] = taken[to] = true;
        notice(s, &s->active[from], &b->grows[to], b->stiffness);
    }
    for (int i = 0; i < s->actives; i++) {
        if (!kept[i]) close_track(s, &s->active[i], edge, false);
        if (kept[i]) s->active[remaining++] = s->active[i];
    }
    s->actives = remaining;
    for (int j = 0; j < b->growers; j++) {
        if (!taken[j]) open_track(s, &b->grows[j], edge, b->stiffness, false);
    }
}

/* ---- the way from sample to sample ---- */

static void walk(scan *s, const sample *a, const sample *b, int depth) {
    const change c = between(s, a, b);
    const double width = b->stiffness - a->stiffness;
    sample middle;

    if (s->stopped) return;
    if (!c.changed && !c.passed) {
        advance(s, a, b);
        return;
    }
    const bool ends = isnan(a->size) || isnan(b->size);
    if (width <= (ends ? s->coarse : c.changed ? s->edge : s->resolution) || depth == DEEPEST) {
        if (!c.changed && s->met) s->met(s->context, a->stiffness + 0.5 * width);
        advance(s, a, b);
        return;
    }
    s->stopped |= s->look(s->context, a->stiffness + division(s, a, b, &c, depth) * width, &middle);
    walk(s, a, &middle, depth + 1);
    walk(s, &middle, b, depth + 1);
}

void scan_begin(scan *s, const sample *first) {
    s->actives = s->stopped = 0;
    for (int i = 0; i < first->growers; i++)
        open_track(s, &first->grows[i], first->stiffness, first->stiffness, true);
}

void scan_to(scan *s, const sample *before, const sample *next) { walk(s, before, next, 0); }

void scan_end(scan *s, const sample *last) {
    for (int i = 0; i < s->actives && !s->stopped; i++)
        close_track(s, &s->active[i], last->stiffness, true);
    s->actives = 0;
}
