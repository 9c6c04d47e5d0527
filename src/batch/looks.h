/* What a group of runs keeps of its motion at the end of each step: peaks, deviations and work. As gough_summary_look() does it for
 * one run, in each lane. Text over the number type. */
#ifndef GOUGH_BATCH_LOOKS_H
#define GOUGH_BATCH_LOOKS_H

#include "batch/sizing.h"

/* the interval between look a and the next */
static inline looks_interval looks_interval_of(looks *l, int count, int a) {
    looks_interval f;

    f.count = count;
    f.a = a;
    f.fitted = 0;
    for (int i = 0; i < QUADRATURE_ROWS; i++) f.row[i] = looks_back(l, QUADRATURE_ROWS - 1 - i);
    f.middle = count == QUADRATURE_ROWS && a == 1;
    f.even = f.middle && looks_even(l, count);
    return f;
}

/* peaks between look a and the next */
static inline void looks_peaks(looks *l, number heard, int count, int a) {
    const number plus = number_of(1);
    looks_interval f = looks_interval_of(l, count, a);

    looks_peaks_of(l, heard, LOOKS_FORCE, LEGS, plus, &f, &l->force);
    looks_peaks_of(l, heard, LOOKS_SPEED, LEGS, plus, &f, &l->speed);
    looks_peaks_of(l, heard, LOOKS_POWER, LEGS, plus, &f, &l->power);
    looks_peaks_of(l, heard, LOOKS_POWER, LEGS, -plus, &f, &l->braking);
    looks_peaks_of(l, heard, LOOKS_DISTANCE, 1, plus, &f, &l->distance);
    looks_peaks_of(l, heard, LOOKS_TURN, 1, plus, &f, &l->turn);
}

/* what sizes the legs, between look a and the next */
LANES_APART void looks_size(looks *l, number heard, int count, int a,
                            const double weight[QUADRATURE_ROWS]) {
    looks_interval f = looks_interval_of(l, count, a);

    sizing_integrate(l, heard, &f, weight);
    if (count >= 3) sizing_peaks(l, heard, &f);
}

/* peaks and work between look a and the next, by the polynomial through the last `count` looks */
static inline void looks_sum_up(looks *l, number heard, int count, int a) {
    double weight[QUADRATURE_ROWS];

    if (count == QUADRATURE_ROWS && a == 1) {
        quadrature_weigh_middle(l->time, weight);
    } else {
        quadrature_weigh(l->time, count, a, weight);
    }
    looks_integrate(l, heard, weight);
    if (l->sizing) looks_size(l, heard, count, a, weight);
    if (count < 3 || (looks_even(l, count) && !looks_any(l, count, a))) return;
    looks_peaks(l, heard, count, a);
}

/* what has passed since the last interval that was summed up, which has no look after it */
static inline void looks_finish(looks *l, number heard) {
    const int count = l->count < QUADRATURE_ROWS ? l->count : QUADRATURE_ROWS;

    if (count == 3) looks_sum_up(l, heard, 3, 1);
    if (count >= 2) looks_sum_up(l, heard, count, QUADRATURE_ROWS - 2);
}

/* derivatives jump at the last look: nothing is interpolated across it */
static inline void looks_corner(looks *l, number heard) {
    if (l->count < 2) return;
    looks_finish(l, heard);
    l->count = 1;
}

/* the motion goes on with other forces: the next look, of the same time, begins anew */
static inline void looks_jump(looks *l, number heard) {
    if (l->count >= 2) looks_finish(l, heard);
    l->count = 0;
}

/* where the next look goes, which takes the place of the oldest */
static inline number *looks_next(looks *l) {
    l->newest = (l->newest + 1) % QUADRATURE_ROWS;
    return looks_back(l, 0);
}

/* Sums up the look that was put into the next place: `heard` is 1 in the lanes under way, else 0; drift: since the look before */
static inline void looks_take(looks *l, number heard, number drift, double t) {
    const number *look = looks_back(l, 0);

    for (int i = 0; i + 1 < QUADRATURE_ROWS; i++) l->time[i] = l->time[i + 1];
    l->time[QUADRATURE_ROWS - 1] = t;
    l->count++;
    l->before = l->bends;
    l->bends = looks_bend_all(l);
    l->drift = looks_raise(heard, drift, l->drift);
    l->distance = looks_raise(heard, look[LOOKS_DISTANCE], l->distance);
    l->turn = looks_raise(heard, look[LOOKS_TURN], l->turn);
    l->force = looks_raise(heard, look[LOOKS_MOST_FORCE], l->force);
    l->speed = looks_raise(heard, look[LOOKS_MOST_SPEED], l->speed);
    l->power = looks_raise(heard, look[LOOKS_MOST_POWER], l->power);
    l->braking = looks_raise(heard, look[LOOKS_MOST_BRAKING], l->braking);
    if (l->sizing) sizing_take(l->sizing, heard, sizing_look(l, QUADRATURE_ROWS - 1), t);
    if (l->count == QUADRATURE_ROWS) looks_sum_up(l, heard, QUADRATURE_ROWS, 0);
    if (l->count >= QUADRATURE_ROWS) looks_sum_up(l, heard, QUADRATURE_ROWS, 1);
}

#endif
