/* The periodic motion of a sampled loop that does not hold its program: a run leaves the program within a period, so the period is
 * divided, and the states at the beginnings of its parts are corrected together until each part leads to the next, (loop-13).
 * Theory: docs/theory/loop.md. */
#include <math.h>
#include <string.h>

#include "floquet/sampled_orbit.h"

enum { MOST_NODES = 32, MOST_STEPS = 30, SEARCHING = 10 };

/* in the units of a deviation: a correction below which the motion is found; below which it may stay where rounding stops the
 * corrections from shrinking; beyond which it would lead elsewhere; and by what factor each must be shorter than the last, after
 * the first ones */
static const double closed = 1e-11, nearly_closed = 1e-8, farthest = 0.5, shrinks = 0.8;

typedef struct {
    size_t count;
    bool kept;                    /* no part has led through a singular pose */
    size_t first[MOST_NODES + 1]; /* the sample at which a part begins; behind them all */
    sampled_state at[MOST_NODES]; /* just before it */
    double missing[MOST_NODES][SAMPLED_ROWS]; /* from the next state to where a part leads */
} nodes;

static double time_of(const sampled_orbit *o, size_t sample) {
    return o->start + (double)sample * o->layout.period;
}

/* all on the program */
static void begin(const sampled_orbit *o, nodes *all) {
    all->count = o->samples < MOST_NODES ? o->samples : MOST_NODES;
    for (size_t j = 0; j <= all->count; j++) all->first[j] = j * o->samples / all->count;
    for (size_t j = 0; j < all->count; j++)
        sampled_begin(&o->loop, &o->layout, time_of(o, all->first[j]), &all->at[j]);
}

/* Where all parts lead, and the product of the derivatives of their samples, in o->map; step: what is missing at the end of the
 * period if every part begins where the last has led, to first order. */
static bool look(sampled_orbit *o, nodes *all, double step[SAMPLED_ROWS]) {
    const int n = o->layout.n;
    const double side = sampled_determinant(o, &all->at[0], NULL);
    sampled_matrix one;

    o->map.n = n;
    o->steps = 0;
    all->kept = true;
    for (int i = 0; i < n * n; i++) o->map.matrix[i] = i % (n + 1) == 0;
    for (int i = 0; i < n; i++) step[i] = 0;
    for (size_t j = 0; j < all->count; j++) {
        sampled_state after = all->at[j];
        for (size_t k = all->first[j]; k < all->first[j + 1]; k++) {
            if (sampled_flow(&o->loop, &o->layout, time_of(o, k), sampled_tolerance, &after, one,
                             &o->steps) != NULL)
                return false;
            sampled_multiply(n, n, one, o->map.matrix);
            sampled_multiply(n, 1, one, step);
            all->kept = all->kept && sampled_keeps_its_side(o, &after, side);
        }
        sampled_compare(&o->layout, &all->at[(j + 1) % all->count], &after, all->missing[j]);
        for (int i = 0; i < n; i++) step[i] += all->missing[j][i];
    }
    return true;
}

/* corrects all states by the step of the first; returns the size of the largest correction in the units of a deviation */
static double correct(const sampled_orbit *o, nodes *all, double step[SAMPLED_ROWS]) {
    const int n = o->layout.n;
    double largest = 0;

    for (size_t j = 0; j < all->count; j++) {
        sampled_state after = all->at[j];
        for (int i = 0; i < n; i++) {
            const double size = fabs(step[i]) / o->unit[i];
            if (!(size <= largest)) largest = size;
        }
        sampled_change(&o->layout, step, &all->at[j]);
        for (size_t k = all->first[j]; k < all->first[j + 1]; k++) {
            if (sampled_carry(&o->loop, &o->layout, time_of(o, k), sampled_tolerance, &after,
                              step) != NULL)
                return INFINITY;
        }
        for (int i = 0; i < n; i++) step[i] += all->missing[j][i];
    }
    return largest;
}

bool sampled_join(sampled_orbit *o, sampled_state *state) {
    double before = INFINITY, step[SAMPLED_ROWS];
    nodes all;

    begin(o, &all);
    for (int k = 0; k < MOST_STEPS; k++) {
        if (!look(o, &all, step) || !sampled_factor(o)) return false;
        *state = all.at[0];
        if (!(sampled_newton_step(o, step) <= farthest)) return false;
        const double size = correct(o, &all, step);
        if (size <= closed) return all.kept;
        if (size <= nearly_closed && !(size <= shrinks * before)) return all.kept;
        if (!(size <= farthest) || (k >= SEARCHING && !(size <= shrinks * before))) return false;
        before = size;
    }
    return false;
}
