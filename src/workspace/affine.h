/* Numbers that depend on where in a box a pose lies: a value at the centre, a slope for each of the box's half widths, and a bound
 * of the rest, (space-2). All arithmetic keeps the true value enclosed, rounding included. Theory: docs/theory/workspace.md. */
#ifndef GOUGH_WORKSPACE_AFFINE_H
#define GOUGH_WORKSPACE_AFFINE_H

#include <float.h>
#include <math.h>

enum { SIDES = 6 };

/* c + Σ g_k ξ_k with each ξ_k in [−1, 1], to within ± r. */
typedef struct affine {
    double c, g[SIDES], r;
} affine;

/* what roundings are at most, each relative to what is rounded: one operation on c or g has no more than four of them */
static const double ROUNDED = 4 * DBL_EPSILON;

static inline affine affine_of(double c) { return (affine){c, {0, 0, 0, 0, 0, 0}, 0}; }

/* Σ|g_k|, rounded upwards */
static inline double affine_slope(const affine *a) {
    double sum = 0;
    for (int k = 0; k < SIDES; k++) sum += fabs(a->g[k]);
    return sum * (1 + 2 * ROUNDED);
}

static inline double affine_spread(const affine *a) {
    return (affine_slope(a) + a->r) * (1 + ROUNDED);
}
/* bounds over the box */
static inline double affine_least(const affine *a) {
    return a->c - affine_spread(a) - ROUNDED * fabs(a->c);
}
static inline double affine_most(const affine *a) {
    return a->c + affine_spread(a) + ROUNDED * fabs(a->c);
}
static inline double affine_magnitude(const affine *a) {
    return (fabs(a->c) + affine_spread(a)) * (1 + ROUNDED);
}

static inline affine affine_scale(double s, affine a) {
    affine b = {s * a.c, {0, 0, 0, 0, 0, 0}, 0};
    double size = fabs(b.c);
    for (int k = 0; k < SIDES; k++) b.g[k] = s * a.g[k], size += fabs(b.g[k]);
    b.r = fabs(s) * a.r * (1 + ROUNDED) + ROUNDED * size;
    return b;
}

static inline affine affine_add(affine a, affine b) {
    affine sum = {a.c + b.c, {0, 0, 0, 0, 0, 0}, 0};
    double size = fabs(sum.c);
    for (int k = 0; k < SIDES; k++) sum.g[k] = a.g[k] + b.g[k], size += fabs(sum.g[k]);
    sum.r = (a.r + b.r) * (1 + ROUNDED) + ROUNDED * size;
    return sum;
}

static inline affine affine_less(affine a, affine b) { return affine_add(a, affine_scale(-1, b)); }

/* (space-3): the product of the slopes is no slope */
static inline affine affine_times(affine a, affine b) {
    const double wide = affine_slope(&a), broad = affine_slope(&b), x = fabs(a.c), y = fabs(b.c);
    affine p = {a.c * b.c, {0, 0, 0, 0, 0, 0}, 0};
    for (int k = 0; k < SIDES; k++) p.g[k] = a.c * b.g[k] + b.c * a.g[k];
    p.r = (x * b.r + y * a.r + (wide + a.r) * (broad + b.r)) * (1 + 2 * ROUNDED) +
          ROUNDED * (x * y + x * broad + y * wide);
    return p;
}

/* (space-11): 1/x of a number that is above 0 over the box; without a bound where it may be 0 */
static inline affine affine_inverse(affine a) {
    const double wide = affine_spread(&a), least = affine_least(&a), y = 1 / a.c;
    affine b = {y, {0, 0, 0, 0, 0, 0}, INFINITY};
    if (!(least > 0)) return b;
    for (int k = 0; k < SIDES; k++) b.g[k] = -a.g[k] * y * y;
    b.r = (y * y * (a.r + wide * wide / least)) * (1 + 4 * ROUNDED) +
          2 * ROUNDED * (y + y * y * wide);
    return b;
}

/* (space-11): √x likewise */
static inline affine affine_root(affine a) {
    const double wide = affine_spread(&a), least = affine_least(&a);
    affine b = {sqrt(a.c), {0, 0, 0, 0, 0, 0}, INFINITY};
    if (!(least > 0)) return b;
    const double y = 0.5 / b.c;
    for (int k = 0; k < SIDES; k++) b.g[k] = a.g[k] * y;
    b.r = (a.r * y + wide * wide / (8 * least * sqrt(least))) * (1 + 8 * ROUNDED) +
          2 * ROUNDED * (b.c + y * wide);
    return b;
}

/* ---- vectors of them ---- */

typedef struct affine_vector {
    affine x[3];
} affine_vector;

static inline affine affine_dot(const affine_vector *a, const affine_vector *b) {
    affine sum = affine_times(a->x[0], b->x[0]);
    for (int i = 1; i < 3; i++) sum = affine_add(sum, affine_times(a->x[i], b->x[i]));
    return sum;
}

static inline affine_vector affine_cross(const affine_vector *a, const affine_vector *b) {
    affine_vector p;
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        p.x[i] = affine_less(affine_times(a->x[j], b->x[k]), affine_times(a->x[k], b->x[j]));
    }
    return p;
}

/* the same with a vector that is the same in all poses, which has no slopes */
static inline affine_vector affine_cross_still(const double a[3], const affine_vector *b) {
    affine_vector p;
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        p.x[i] = affine_less(affine_scale(a[j], b->x[k]), affine_scale(a[k], b->x[j]));
    }
    return p;
}

static inline affine affine_dot_still(const double a[3], const affine_vector *b) {
    const affine sum = affine_add(affine_scale(a[0], b->x[0]), affine_scale(a[1], b->x[1]));
    return affine_add(sum, affine_scale(a[2], b->x[2]));
}

/* a + s b */
static inline affine_vector affine_along(const affine_vector *a, affine s, const affine_vector *b) {
    affine_vector sum;
    for (int i = 0; i < 3; i++) sum.x[i] = affine_add(a->x[i], affine_times(s, b->x[i]));
    return sum;
}

/* a vector that is the same in all poses */
static inline affine_vector affine_still(const double v[3]) {
    return (affine_vector){{affine_of(v[0]), affine_of(v[1]), affine_of(v[2])}};
}

#endif
