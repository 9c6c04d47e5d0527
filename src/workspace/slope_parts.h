/* A limit over a box of positions by its slopes: the part of the box that it cuts off, (space-21). */
#ifndef GOUGH_WORKSPACE_SLOPE_PARTS_H
#define GOUGH_WORKSPACE_SLOPE_PARTS_H

#include "workspace/judge.h"
#include "workspace/taylor.h"

/* what the part of a box is computed with error of at most, and a slope below this part of the greatest counts as rest */
static const double PART_ROUNDED = 1e-8, NO_SLOPE = 1e-3;

/* The part of ξ in [−1, 1]³ with g·ξ < t: the volume below a plane by inclusion and exclusion of the corners. */
static inline double part_below(const double g[3], double t) {
    double a[3], greatest = 0, sum = 0, part = 0, factor = 1;
    int n = 0;
    for (int k = 0; k < 3; k++) greatest = fmax(greatest, fabs(g[k]));
    for (int k = 0; k < 3; k++)
        if (fabs(g[k]) > NO_SLOPE * greatest) a[n++] = fabs(g[k]) / greatest;
    if (n == 0) return t > 0 ? 1 : 0;
    for (int k = 0; k < n; k++) sum += a[k], factor *= (k + 1) * a[k];
    const double h = 0.5 * (t / greatest + sum);
    if (!(h > 0)) return 0;
    if (h >= sum) return 1;
    for (int corner = 0; corner < 1 << n; corner++) {
        double left = h, sign = 1;
        for (int k = 0; k < n; k++)
            if (corner >> k & 1) left -= a[k], sign = -sign;
        if (left > 0) part += sign * (n > 2 ? left * left * left : n > 1 ? left * left : left);
    }
    return fmin(1, fmax(0, part / factor));
}

/* judge_margin() for a margin that lies between m − low and m − high; which part of a box of positions is decided follows from
 * its slopes */
static inline void judge_slope(judge *j, const taylor *m, double low, double high, double size,
                               gough_bind bind, int which) {
    const gough_verdict verdict =
        judge_margin(j, taylor_least(m) - low, taylor_most(m) - high, size, bind, which);
    double rest = m->r + 8 * ROUNDED * (fabs(m->c) + taylor_curve(m)), greatest = 0;
    taylor curves = *m;
    if (verdict != GOUGH_UNDECIDED) return;
    for (int k = 0; k < 3; k++) greatest = fmax(greatest, fabs(m->g[k]));
    for (int k = 0; k < SIDES; k++) {
        if (k > 2 || fabs(m->g[k]) <= NO_SLOPE * greatest) rest += fabs(m->g[k]);
        curves.g[k] = 0;
    }
    /* m = c + g·ξ, and more by the rise of the curvatures at most, and by the rest: not kept for certain below the lower plane,
     * perhaps below the upper one */
    const double more = rest + taylor_rise(&curves, 1), less = rest + taylor_rise(&curves, -1);
    judge_parts(j,
                fmax(0, part_below(m->g, high - m->c - more - LIMIT_SLACK * size) - PART_ROUNDED),
                fmin(1, part_below(m->g, low - m->c + less) + PART_ROUNDED));
}

/* the same without slopes */
static inline void judge_whole(judge *j, double least, double most, double size, gough_bind bind,
                               int which) {
    if (judge_margin(j, least, most, size, bind, which) == GOUGH_UNDECIDED) judge_parts(j, 0, 1);
}

#endif
