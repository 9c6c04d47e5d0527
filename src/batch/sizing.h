/* What sizes the legs of runs side by side, from the looks at them: lengths, swings, loads of joints and guides, RMS force, losses
 * of friction and returned energy. As gough_summary_look() does it for one run, in each lane. Text over the number type. */
#ifndef GOUGH_BATCH_SIZING_H
#define GOUGH_BATCH_SIZING_H

#include "batch/look.h"
#include "plant/joints.h"
#include "run/returned.h"

/* columns of each leg in addition to those of looks; those from the first load on are of legs with mass or friction only */
enum {
    SIZING_LENGTH = 0,
    SIZING_BASE_CHORD = LEGS, /* 2 sin(φ/2), φ from the direction at home */
    SIZING_TOP_CHORD = 2 * LEGS,
    SIZING_TOP_LOAD = 3 * LEGS,
    SIZING_BASE_LOAD = 4 * LEGS,
    SIZING_SIDE = 5 * LEGS,
    SIZING_LOSS = 6 * LEGS, /* power that friction takes */
    SIZING_COLUMNS = 7 * LEGS
};
_Static_assert((int)SIZING_COLUMNS == (int)BATCH_SIZING, "a look, one lane of it");

struct sizing {
    number look[QUADRATURE_ROWS][SIZING_COLUMNS]; /* in the places of the looks */
    number shortest, longest, base_chord, top_chord, top_load, base_load, side;
    number square[LEGS], loss[LEGS], returned[LEGS]; /* time integrals */
    number span;                                     /* time since the first look */
    int loaded; /* loads of the joints are others than drive forces */
};

static inline void sizing_begin(struct sizing *s, const struct system *r) {
    const number zero = number_of(0);

    for (int i = 0; i < QUADRATURE_ROWS; i++) { /* rows of weight 0 must not be NaN */
        for (int c = 0; c < SIZING_COLUMNS; c++) s->look[i][c] = zero;
    }
    s->shortest = number_of(HUGE_VAL);
    s->longest = s->base_chord = s->top_chord = zero;
    s->top_load = s->base_load = s->side = s->span = zero;
    for (int v = 0; v < LEGS; v++) s->square[v] = s->loss[v] = s->returned[v] = zero;
    s->loaded = (r->traits & (MOVING_MASS | FRICTION)) != 0;
}

/* the columns of the i-th of the last looks, the latest last */
static inline number *sizing_look(const looks *l, int i) {
    const unsigned age = QUADRATURE_ROWS - 1 - (unsigned)i;

    return l->sizing->look[((unsigned)l->newest - age) % QUADRATURE_ROWS];
}

static inline void sizing_fill(const struct system *r, const signals *m,
                               number look[SIZING_COLUMNS]) {
    const limit_set *home = &r->limits;
    const int loaded = r->traits & (MOVING_MASS | FRICTION);

    for (int v = 0; v < LEGS; v++) {
        const vector n = m->g.n[v];
        look[SIZING_LENGTH + v] = m->g.length[v];
        look[SIZING_BASE_CHORD + v] = norm(subtract(n, home->home[v]));
        look[SIZING_TOP_CHORD + v] = norm(subtract(onto(&m->x.q, n), home->home_top[v]));
    }
    for (int v = 0; v < LEGS && loaded; v++) {
        const leg_joints j = joints_of_leg(&r->h, &m->g, v, &m->rate, &m->acceleration,
                                           r->traits & MOVING_MASS, m->leg[v]);
        look[SIZING_TOP_LOAD + v] = norm(j.top);
        look[SIZING_BASE_LOAD + v] = norm(j.base);
        look[SIZING_SIDE + v] = j.side;
        look[SIZING_LOSS + v] = (m->force[v] - m->leg[v]) * m->g.rate[v];
    }
}

/* the largest number of six, with the sign */
static inline number sizing_most(const number *look, int column, number sign) {
    number most = sign * look[column];

    for (int v = 1; v < LEGS; v++) most = number_larger(most, sign * look[column + v]);
    return most;
}

/* peaks at a look in itself */
static inline void sizing_take(struct sizing *s, number heard, const number *look, double t) {
    const number one = number_of(1);

    s->shortest = -looks_raise(heard, sizing_most(look, SIZING_LENGTH, -one), -s->shortest);
    s->longest = looks_raise(heard, sizing_most(look, SIZING_LENGTH, one), s->longest);
    s->base_chord = looks_raise(heard, sizing_most(look, SIZING_BASE_CHORD, one), s->base_chord);
    s->top_chord = looks_raise(heard, sizing_most(look, SIZING_TOP_CHORD, one), s->top_chord);
    s->span = looks_raise(heard, number_of(t), s->span);
    if (!s->loaded) return;
    s->top_load = looks_raise(heard, sizing_most(look, SIZING_TOP_LOAD, one), s->top_load);
    s->base_load = looks_raise(heard, sizing_most(look, SIZING_BASE_LOAD, one), s->base_load);
    s->side = looks_raise(heard, sizing_most(look, SIZING_SIDE, one), s->side);
}

/* ---- between two looks ---- */

/* The energy that leg v returns, net: its work. A power that keeps its sign at the looks and does not turn between them keeps it
 * there too; where not, each lane has its own polynomial. */
static inline number sizing_returned(const looks *l, number heard, looks_interval *f, int v,
                                     number net) {
    const number zero = number_of(0), one = number_of(1), half = number_of(0.5);
    number y[QUADRATURE_ROWS];

    for (int i = 0; i < QUADRATURE_ROWS; i++) y[i] = f->row[i][LOOKS_POWER + v];
    const number p = y[f->a], q = y[f->a + 1];
    const number bends = f->middle ? (y[1] - y[0]) * (y[3] - y[2]) : -one;
    const number still = number_select(number_greater(zero, bends), zero, one);
    const number gives = number_select(number_greater(zero, number_smaller(p, q)), zero, still);
    const number takes = number_select(number_greater(number_larger(p, q), zero), zero, still);
    const number left = number_select(number_greater(gives + takes, half), zero, heard);
    number value = number_select(number_greater(takes, half), -net, zero);

    value = number_select(number_greater(gives, half), zero, value);
    if (!number_any(number_greater(left, half))) return value;
    if (!f->fitted) quadrature_fit(l->time, f->count, f->a, f->c);
    f->fitted = 1;
    for (int i = 0; i < NUMBER_WIDTH; i++) {
        const double h = l->time[f->a + 1] - l->time[f->a];
        double power[QUADRATURE_ROWS];
        if (!(number_lane(left, i) > 0.5)) continue;
        for (int k = 0; k < QUADRATURE_ROWS; k++) power[k] = number_lane(y[k], i);
        number_put(&value, i, returned_energy((const double(*)[QUADRATURE_ROWS])f->c, h, power));
    }
    return value;
}

/* integrals with these weights of the looks */
static inline void sizing_integrate(looks *l, number heard, looks_interval *f,
                                    const double weight[QUADRATURE_ROWS]) {
    struct sizing *s = l->sizing;
    const mask on = number_greater(heard, number_of(0.5));

    for (int v = 0; v < LEGS; v++) {
        number square = number_of(0), net = square, loss = square;
        for (int i = 0; i < QUADRATURE_ROWS; i++) {
            const number w = number_of(weight[i]), force = f->row[i][LOOKS_FORCE + v];
            square = square + w * force * force;
            net = net + w * f->row[i][LOOKS_POWER + v];
        }
        for (int i = 0; i < QUADRATURE_ROWS && s->loaded; i++)
            loss = loss + number_of(weight[i]) * sizing_look(l, i)[SIZING_LOSS + v];
        s->square[v] = number_select(on, s->square[v] + square, s->square[v]);
        s->loss[v] = number_select(on, s->loss[v] + loss, s->loss[v]);
        const number back = sizing_returned(l, heard, f, v, net);
        s->returned[v] = number_select(on, s->returned[v] + back, s->returned[v]);
    }
}

/* peaks in an interval of the looks */
static inline void sizing_peaks(looks *l, number heard, const looks_interval *of) {
    struct sizing *s = l->sizing;
    const number plus = number_of(1);
    number shortest = -s->shortest;
    looks_interval f = *of;

    for (int i = 0; i < QUADRATURE_ROWS; i++) f.row[i] = sizing_look(l, i);
    looks_peaks_of(l, heard, SIZING_LENGTH, LEGS, -plus, &f, &shortest);
    s->shortest = -shortest;
    looks_peaks_of(l, heard, SIZING_LENGTH, LEGS, plus, &f, &s->longest);
    looks_peaks_of(l, heard, SIZING_BASE_CHORD, LEGS, plus, &f, &s->base_chord);
    looks_peaks_of(l, heard, SIZING_TOP_CHORD, LEGS, plus, &f, &s->top_chord);
    if (!s->loaded) return;
    looks_peaks_of(l, heard, SIZING_TOP_LOAD, LEGS, plus, &f, &s->top_load);
    looks_peaks_of(l, heard, SIZING_BASE_LOAD, LEGS, plus, &f, &s->base_load);
    looks_peaks_of(l, heard, SIZING_SIDE, LEGS, plus, &f, &s->side);
}

/* ---- the outcome ---- */

/* angle of a chord 2 sin(φ/2) */
static inline double sizing_angle(number chord, int lane) {
    const double sine = number_lane(chord, lane) / 2;

    return 2 * asin(sine < 1 ? sine : 1);
}

/* a lane's numbers; force: its largest |drive force| */
static inline void sizing_write(const struct sizing *s, int lane, double force,
                                double out[GOUGH_SIZINGS]) {
    const double span = number_lane(s->span, lane);
    double square = 0, loss = 0, returned = 0;

    for (int v = 0; v < LEGS; v++) {
        square = fmax(square, number_lane(s->square[v], lane));
        loss += number_lane(s->loss[v], lane);
        returned += number_lane(s->returned[v], lane);
    }
    out[GOUGH_SIZING_LENGTH_LEAST] = number_lane(s->shortest, lane);
    out[GOUGH_SIZING_LENGTH_GREATEST] = number_lane(s->longest, lane);
    out[GOUGH_SIZING_SWING_BASE] = sizing_angle(s->base_chord, lane);
    out[GOUGH_SIZING_SWING_TOP] = sizing_angle(s->top_chord, lane);
    out[GOUGH_SIZING_RMS_FORCE] = span > 0 ? sqrt(square / span) : force;
    out[GOUGH_SIZING_TOP_LOAD] = s->loaded ? number_lane(s->top_load, lane) : force;
    out[GOUGH_SIZING_BASE_LOAD] = s->loaded ? number_lane(s->base_load, lane) : force;
    out[GOUGH_SIZING_SIDE_LOAD] = s->loaded ? number_lane(s->side, lane) : 0;
    out[GOUGH_SIZING_FRICTION_LOSS] = loss;
    out[GOUGH_SIZING_RETURNED_ENERGY] = returned;
}

#endif
