/* Numbers that depend on where in a box a pose lies: a value at the centre, slopes and curvatures along the box's half widths, and
 * a bound of the rest, which is of third order, (space-3). All arithmetic keeps the true value enclosed, rounding included. Theory:
 * docs/theory/workspace.md. */
#ifndef GOUGH_WORKSPACE_TAYLOR_H
#define GOUGH_WORKSPACE_TAYLOR_H

#include <float.h>
#include <math.h>
#include <stdbool.h>

enum { SIDES = 6, CURVES = SIDES * (SIDES + 1) / 2 };

/* c + Σ g_k ξ_k + Σ h_jk ξ_j ξ_k, j ≤ k, with each ξ_k in [−1, 1], to within ± r. */
typedef struct taylor {
    double c, g[SIDES], h[CURVES], r;
    bool
        varies; /* false: slopes and curvatures are 0, as all are of a box of one pose, and are not computed with */
} taylor;

/* the place of h_jk, j ≤ k */
static inline int curve_at(int j, int k) { return k * (k + 1) / 2 + j; }

/* what roundings are at most, each relative to what is rounded: one operation on c, g or h has no more than four of them */
static const double ROUNDED = 4 * DBL_EPSILON;

/* the greater of a bound and another, which is not one if it is not a number, as 0 · ∞ is */
static inline double bound_of(double a, double b) {
    return b <= a ? a : b < INFINITY ? b : INFINITY;
}

static inline taylor taylor_of(double c) {
    taylor a = {.c = c};
    return a;
}

/* Σ|g_k|, rounded upwards */
static inline double taylor_slope(const taylor *a) {
    double sum = 0;
    for (int k = 0; k < SIDES && a->varies; k++) sum += fabs(a->g[k]);
    return sum * (1 + 2 * ROUNDED);
}

/* Σ|h_jk| likewise */
static inline double taylor_curve(const taylor *a) {
    double sum = 0;
    for (int i = 0; i < CURVES && a->varies; i++) sum += fabs(a->h[i]);
    return sum * (1 + 6 * ROUNDED);
}

/* how far the number may be from its value at the centre */
static inline double taylor_spread(const taylor *a) {
    return (taylor_slope(a) + taylor_curve(a) + a->r) * (1 + ROUNDED);
}

/* whether ξ_k belongs at the end of its side towards which the polynomial rises, wherever the free others are */
static inline bool taylor_rises(const double g[SIDES], const double h[CURVES],
                                const bool free[SIDES], int k) {
    double change = -2 * fmin(0, h[curve_at(k, k)]);
    for (int j = 0; j < SIDES; j++)
        if (free[j] && j != k) change += fabs(h[j < k ? curve_at(j, k) : curve_at(k, j)]);
    return fabs(g[k]) >= change;
}

/* The greatest value of sign · (Σ g_k ξ_k + Σ h_jk ξ_j ξ_k) or a bound of it: sides along which it rises throughout are put to
 * their ends, which changes the slopes along the others; of what is left free each term is bounded by itself, (space-22). */
static inline double taylor_rise(const taylor *a, double sign) {
    bool free[SIDES], moved = true;
    double g[SIDES], h[CURVES], sum = 0;
    if (!a->varies) return 0;
    for (int k = 0; k < SIDES; k++) g[k] = sign * a->g[k], free[k] = true;
    for (int i = 0; i < CURVES; i++) h[i] = sign * a->h[i];
    while (moved) {
        moved = false;
        for (int k = 0; k < SIDES; k++) {
            if (!free[k] || !taylor_rises(g, h, free, k)) continue;
            const double end = g[k] < 0 ? -1 : 1;
            sum += fabs(g[k]) + h[curve_at(k, k)];
            free[k] = false, moved = true;
            for (int j = 0; j < SIDES; j++)
                if (free[j]) g[j] += end * h[j < k ? curve_at(j, k) : curve_at(k, j)];
        }
    }
    for (int k = 0; k < SIDES; k++) {
        const double own = h[curve_at(k, k)], slope = fabs(g[k]);
        if (!free[k]) continue;
        /* its greatest value is at an end or, of a parabola that opens downwards, between them */
        sum += -2 * own > slope ? slope * slope / (-4 * own) : slope + own;
        for (int j = 0; j < k; j++)
            if (free[j]) sum += fabs(h[curve_at(j, k)]);
    }
    return sum;
}

/* bounds over the box */
static inline double taylor_most(const taylor *a) {
    const double size = fabs(a->c) + taylor_spread(a);
    return a->c + taylor_rise(a, 1) + a->r + 8 * ROUNDED * size;
}
static inline double taylor_least(const taylor *a) {
    const double size = fabs(a->c) + taylor_spread(a);
    return a->c - taylor_rise(a, -1) - a->r - 8 * ROUNDED * size;
}
static inline double taylor_magnitude(const taylor *a) {
    return fmax(fabs(taylor_least(a)), fabs(taylor_most(a)));
}

static inline taylor taylor_scale(double s, taylor a) {
    taylor b = {.c = s * a.c, .varies = a.varies};
    double size = fabs(b.c);
    for (int k = 0; k < SIDES && b.varies; k++) b.g[k] = s * a.g[k], size += fabs(b.g[k]);
    for (int i = 0; i < CURVES && b.varies; i++) b.h[i] = s * a.h[i], size += fabs(b.h[i]);
    b.r = bound_of(0, fabs(s) * a.r * (1 + ROUNDED) + ROUNDED * size);
    return b;
}

static inline taylor taylor_add(taylor a, taylor b) {
    taylor sum = {.c = a.c + b.c, .varies = a.varies || b.varies};
    double size = fabs(sum.c);
    for (int k = 0; k < SIDES && sum.varies; k++)
        sum.g[k] = a.g[k] + b.g[k], size += fabs(sum.g[k]);
    for (int i = 0; i < CURVES && sum.varies; i++)
        sum.h[i] = a.h[i] + b.h[i], size += fabs(sum.h[i]);
    sum.r = (a.r + b.r) * (1 + ROUNDED) + ROUNDED * size;
    return sum;
}

static inline taylor taylor_less(taylor a, taylor b) { return taylor_add(a, taylor_scale(-1, b)); }

/* adds f times the product of the slopes of two numbers to curvatures */
static inline void taylor_add_slopes(double f, const double a[SIDES], const double b[SIDES],
                                     double h[CURVES]) {
    for (int k = 0; k < SIDES; k++) {
        double *row = h + curve_at(0, k);
        for (int j = 0; j < k; j++) row[j] += f * (a[j] * b[k] + a[k] * b[j]);
        row[k] += f * a[k] * b[k];
    }
}

/* (space-3): what is of third order and more is rest */
static inline taylor taylor_times(taylor a, taylor b) {
    const double x = fabs(a.c), y = fabs(b.c), wide = taylor_slope(&a), broad = taylor_slope(&b),
                 bent = taylor_curve(&a), curved = taylor_curve(&b);
    taylor p = {.c = a.c * b.c, .varies = a.varies || b.varies};
    for (int k = 0; k < SIDES && p.varies; k++) p.g[k] = a.c * b.g[k] + b.c * a.g[k];
    for (int i = 0; i < CURVES && p.varies; i++) p.h[i] = a.c * b.h[i] + b.c * a.h[i];
    if (p.varies) taylor_add_slopes(1, a.g, b.g, p.h);
    const double third = wide * curved + bent * (broad + curved);
    const double rest =
        x * b.r + y * a.r + third + (wide + bent) * b.r + a.r * (broad + curved + b.r);
    p.r = bound_of(0, rest * (1 + 4 * ROUNDED) +
                          2 * ROUNDED * (x + wide + bent) * (y + broad + curved));
    return p;
}

/* what has no bound; its value counts for nothing, but must be a number */
static inline taylor taylor_unbounded(bool varies) {
    return (taylor){.r = INFINITY, .varies = varies};
}

/* (space-11): 1/x of a number that is above 0 over the box; without a bound where it may be 0. Its value at the centre is then
 * above 0 too. */
static inline taylor taylor_inverse(taylor a) {
    const double slope = taylor_slope(&a), rest = taylor_curve(&a) + a.r, wide = slope + rest,
                 least = taylor_least(&a), y = 1 / a.c;
    taylor b = {.c = y, .varies = a.varies};
    if (!(least > 0)) return taylor_unbounded(a.varies);
    for (int k = 0; k < SIDES && b.varies; k++) b.g[k] = -a.g[k] * y * y;
    for (int i = 0; i < CURVES && b.varies; i++) b.h[i] = -a.h[i] * y * y;
    if (b.varies) taylor_add_slopes(y * y * y, a.g, a.g, b.h);
    b.r = (y * y * (a.r + y * (2 * slope + rest) * rest + y * wide * wide * wide / least)) *
              (1 + 8 * ROUNDED) +
          4 * ROUNDED * (y + y * y * wide + y * y * y * slope * slope);
    return b;
}

/* (space-11): √x likewise */
static inline taylor taylor_root(taylor a) {
    const double slope = taylor_slope(&a), rest = taylor_curve(&a) + a.r, wide = slope + rest,
                 least = taylor_least(&a);
    taylor b = {.c = sqrt(a.c), .varies = a.varies};
    if (!(least > 0)) return taylor_unbounded(a.varies);
    const double y = 0.5 / b.c, z = 0.25 * y / a.c;
    for (int k = 0; k < SIDES && b.varies; k++) b.g[k] = a.g[k] * y;
    for (int i = 0; i < CURVES && b.varies; i++) b.h[i] = a.h[i] * y;
    if (b.varies) taylor_add_slopes(-z, a.g, a.g, b.h);
    b.r = (a.r * y + z * (2 * slope + rest) * rest +
           wide * wide * wide / (16 * least * least * sqrt(least))) *
              (1 + 8 * ROUNDED) +
          4 * ROUNDED * (b.c + y * wide + z * slope * slope);
    return b;
}

/* ---- vectors of them ---- */

typedef struct taylor_vector {
    taylor x[3];
} taylor_vector;

static inline taylor taylor_dot(const taylor_vector *a, const taylor_vector *b) {
    taylor sum = taylor_times(a->x[0], b->x[0]);
    for (int i = 1; i < 3; i++) sum = taylor_add(sum, taylor_times(a->x[i], b->x[i]));
    return sum;
}

static inline taylor_vector taylor_cross(const taylor_vector *a, const taylor_vector *b) {
    taylor_vector p;
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        p.x[i] = taylor_less(taylor_times(a->x[j], b->x[k]), taylor_times(a->x[k], b->x[j]));
    }
    return p;
}

/* the same with a vector that is the same in all poses, which has no slopes */
static inline taylor_vector taylor_cross_still(const double a[3], const taylor_vector *b) {
    taylor_vector p;
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        p.x[i] = taylor_less(taylor_scale(a[j], b->x[k]), taylor_scale(a[k], b->x[j]));
    }
    return p;
}

static inline taylor taylor_dot_still(const double a[3], const taylor_vector *b) {
    const taylor sum = taylor_add(taylor_scale(a[0], b->x[0]), taylor_scale(a[1], b->x[1]));
    return taylor_add(sum, taylor_scale(a[2], b->x[2]));
}

/* a + s b */
static inline taylor_vector taylor_along(const taylor_vector *a, taylor s, const taylor_vector *b) {
    taylor_vector sum;
    for (int i = 0; i < 3; i++) sum.x[i] = taylor_add(a->x[i], taylor_times(s, b->x[i]));
    return sum;
}

/* a vector that is the same in all poses */
static inline taylor_vector taylor_still(const double v[3]) {
    return (taylor_vector){{taylor_of(v[0]), taylor_of(v[1]), taylor_of(v[2])}};
}

#endif
