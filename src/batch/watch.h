/* How long the determinant of a pose need not be computed: it changes by no more than the pose does. Text over the number type.
 *
 * The matrix of (legs-8) has a column (m, t × m / reach) for each leg, with the leg's direction m and its top joint t in the
 * axes of the load, and t is constant. Its length is at most c = √(1 + t²/reach²), and it moves by at most c |Δm|. A determinant
 * is linear in each column, so that |Δdet| ≤ C Σ |Δm|, where C is the product of the c. With directions n in base axes and the
 * load's axes Q, |Δm| ≤ |Δn| + |ΔQ|, hence (Σ |Δm|)² ≤ 12 Σ |Δn|² + 72 |ΔQ|². A condition number of 1e8 takes a determinant of
 * at most (Σ c²)³/1e8, since Σ c² bounds the square of the largest singular value. */
#ifndef GOUGH_BATCH_WATCH_H
#define GOUGH_BATCH_WATCH_H

#include "base/limits.h"
#include "plant/hexapod.h"

/* The pose whose determinant was computed last, and how far from it none need be computed. */
typedef struct {
    number product, floor; /* C; the determinant below which the condition must be looked at */
    vector n[LEGS];
    triad q;
    number room; /* square of the greatest Σ |Δm| */
} pose_watch;

static inline void watch_begin(pose_watch *w, const hexapod *h) {
    number sum = number_of(0), product = number_of(1);

    for (int v = 0; v < LEGS; v++) {
        const number t = norm(h->top[v]) / h->reach, square = number_of(1) + t * t;
        sum = sum + square;
        product = product * number_root(square);
    }
    w->product = product;
    w->floor = sum * sum * sum / number_of(greatest_condition);
}

/* A pose and its determinant. Half of what the bound allows is used: the rest is for triads that are not quite orthonormal. */
static inline void watch_set(pose_watch *w, const coordinates *x, const legs *g,
                             number determinant) {
    const number least = number_magnitude(determinant) - w->floor, none = number_of(0);
    const number most = number_of(0.5) * number_larger(least, none) / w->product;

    for (int v = 0; v < LEGS; v++) w->n[v] = g->n[v];
    w->q = x->q;
    w->room = most * most;
}

static inline number watch_square(vector a, vector b) {
    const vector apart = subtract(a, b);

    return dot(apart, apart);
}

/* whether the determinant may have come near zero since, in some lane where `heard` is 1 */
static inline int watch_moved(const pose_watch *w, const coordinates *x, const legs *g,
                              number heard) {
    number turned = watch_square(x->q.i, w->q.i), moved = number_of(0);

    turned = turned + watch_square(x->q.j, w->q.j) + watch_square(x->q.k, w->q.k);
    KERNEL_UNROLL
    for (int v = 0; v < LEGS; v++) moved = moved + watch_square(g->n[v], w->n[v]);
    moved = number_of(12) * moved + number_of(72) * turned;
    /* what is not a number counts as moved */
    const number near = number_select(number_greater(w->room, moved), number_of(0), heard);
    return number_any(number_greater(near, number_of(0.5)));
}

#endif
