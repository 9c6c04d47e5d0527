/* The damping for a ratio in a loop with an upper edge of its gains: the ratio of the least damped pole rises with D up to a peak
 * and falls again, since what delays the force delays damping too. Theory: docs/theory/tuning.md. */
#include <math.h>
#include <string.h>

#include "tune/tune.h"

enum { MOST_STEPS = 100, GRID = 40 };

/* of a root, relative */
static const double precision = 1e-12;

/* dampings tried one after the other differ by this factor, and begin at such a part of √(GM) or of half the greatest one */
static const double factor = 1.2, first_part = 1e-3;

/* where nothing limits D: this many √(GM) are so much damping that no ratio comes beyond */
static const double most_part = 1e3;

/* the upper edge of a search by ratio, relative */
static const double edge_width = 1e-6;

static double ratio_at(const tune_poles *p, double damping) {
    for (int v = 0; v < GOUGH_LEGS; v++) p->control->damping[v] = damping;
    memset(p->control->cross_damping, 0, sizeof p->control->cross_damping);
    return p->ratio(p->loop);
}

/* between two dampings of which the second one has the ratio and the first has not */
static double between(const tune_poles *p, double low, double high, double ratio) {
    double f_low = ratio_at(p, low) - ratio, f_high = ratio_at(p, high) - ratio;

    for (int i = 0; i < MOST_STEPS && high - low > precision * high && f_high > 0; i++) {
        double next = low + (high - low) * f_low / (f_low - f_high);
        if (!(next > low && next < high)) next = 0.5 * (low + high);
        const double f = ratio_at(p, next) - ratio;
        if (f < 0) {
            low = next, f_low = f;
            f_high *= 0.5; /* lest one end stay for ever */
        } else {
            high = next, f_high = f;
            f_low *= 0.5;
        }
    }
    return high;
}

/* the damping near `middle` with the greatest ratio, and that ratio */
static double peak(const tune_poles *p, double middle, double *ratio) {
    const double golden = 0.6180339887498949;
    double low = middle / factor, high = middle * factor;
    double a = high - golden * (high - low), b = low + golden * (high - low);
    double at_a = ratio_at(p, a), at_b = ratio_at(p, b);

    for (int i = 0; i < MOST_STEPS && high - low > 1e-7 * high; i++) {
        if (at_a >= at_b) {
            high = b, b = a, at_b = at_a;
            a = high - golden * (high - low);
            at_a = ratio_at(p, a);
        } else {
            low = a, a = b, at_a = at_b;
            b = low + golden * (high - low);
            at_b = ratio_at(p, b);
        }
    }
    *ratio = fmax(at_a, at_b);
    return at_a >= at_b ? a : b;
}

double tune_damping_at(const tune_poles *p, double ratio) {
    double stiffness = 0, before = 0, best = 0, most = -INFINITY;

    for (int v = 0; v < GOUGH_LEGS; v++) stiffness = fmax(stiffness, p->control->stiffness[v]);
    if (!(stiffness > 0)) return NAN;
    const double natural = sqrt(stiffness * p->mass);
    const double last = isfinite(p->most_damping) ? p->most_damping : most_part * natural;
    for (double D = first_part * fmin(natural, 0.5 * p->most_damping); D < last; D *= factor) {
        const double now = ratio_at(p, D);
        if (now >= ratio) return between(p, before, D, ratio);
        if (now > most) most = now, best = D;
        before = D;
    }
    if (!(best > 0)) return NAN;
    const double top = peak(p, best, &most);
    return most >= ratio ? between(p, best / factor, top, ratio) : (double)NAN;
}

static bool has_ratio(const tune_poles *p, double stiffness, double ratio, double *damping) {
    for (int v = 0; v < GOUGH_LEGS; v++) p->control->stiffness[v] = stiffness;
    *damping = tune_damping_at(p, ratio);
    return *damping > 0;
}

double tune_top_by_ratio(const tune_poles *p, double threshold, double ratio, double *damping) {
    const double most = p->most_stiffness, least = fmax(threshold, 1e-9 * most);
    double high = most, low = 0, D;

    if (!(most > least)) return 0;
    for (int i = GRID; i > 0; i--) {
        low = least * pow(most / least, (i - 0.5) / GRID);
        if (has_ratio(p, low, ratio, damping)) break;
        high = low;
        low = 0;
    }
    while (low > 0 && high > low * (1 + edge_width)) {
        const double middle = sqrt(low * high);
        if (has_ratio(p, middle, ratio, &D))
            low = middle, *damping = D;
        else
            high = middle;
    }
    return low;
}
