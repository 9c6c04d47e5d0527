/* The certified way of a pose: from one pose to the pose of given leg lengths along the straight line of squared lengths, (pose-5),
 * over a number type with a lane for each pose. Lengths are divided by the scale of a frame (frame.h). */
#ifndef GOUGH_POSE_WALK_H
#define GOUGH_POSE_WALK_H

#include <string.h>

#include "pose/point.h"

/* the way, and what is certain at its end. Errors in the largest component of x, with e·e = 1 */
typedef struct {
    number steps;   /* certified ones */
    number reached; /* part of the way, 1: all of it */
    number margin;  /* 1 − 4βκ/(1 − ε)² of the whole way in one step */
    number error;   /* the root is within this of x */
    number unique;  /* and no other is within this */
} soma_way;

/* in parts of (1 − ε)²/4κ: how much of it a step may use, and uses if it does not reach the end */
#define WALK_MOST REAL_LITERAL(0.98)
#define WALK_PART REAL_LITERAL(0.95)
/* a part of the way below which the way counts as lost: it ends at a singular pose, or passes one */
#define WALK_LEAST REAL_LITERAL(1e-7)
enum { WALK_NEWTON = 12 };

/* Newton from z to the values `to`, until a correction is so small that the next is rounding; lanes that are there stay */
static inline void soma_newton(const soma_legs *m, const number to[SOMA], number z[SOMA]) {
    /* the next correction is κ times its square: rounding where κ is below 256 */
    const number enough =
        number_root(number_of_real(REAL_EPSILON)) * number_of_real(REAL_LITERAL(0.0625));
    number J[SOMA][SOMA], value[SOMA], delta[SOMA], last = number_of(1);

    for (int n = 0; n < WALK_NEWTON; n++) {
        const mask wanted = number_greater(last, enough);
        eight f;
        if (!number_any(wanted)) break;
        soma_jacobian(m, z, SPHERE, J, value);
        memcpy(f.a, J, sizeof J);
        eight_factor(&f);
        for (int k = 0; k < SOMA; k++) delta[k] = to[k] - value[k];
        eight_solve(&f, delta);
        for (int k = 0; k < SOMA; k++) z[k] = number_select(wanted, z[k] + delta[k], z[k]);
        last = number_select(wanted, soma_largest(delta), last);
    }
}

/* where a step leads and why it may be believed */
typedef struct {
    number to[SOMA]; /* values at its end */
    number part;     /* of the change that is left */
    number beta;     /* of that part, with the tube and rounding */
    number margin;   /* of the whole change */
    number sure;     /* 1 − ε */
} soma_plan;

/* (pose-6): how much of the way to the squares of lengths is certain in one step from p; `width` is how far they may be off on the
 * way. x becomes the first correction of Newton. */
static inline void soma_plan_step(const soma_point *p, const number square[SOMA_LEGS],
                                  const number width[SOMA_LEGS], number x[SOMA], soma_plan *s) {
    const number zero = number_of(0), one = number_of(1);
    number change[SOMA], spread = zero, delta[SOMA];

    for (int v = 0; v < SOMA_LEGS; v++) change[v] = square[v] - p->value[v];
    change[6] = -p->value[6], change[7] = one - p->value[7];
    for (int i = 0; i < SOMA; i++) {
        number sum = zero;
        for (int v = 0; v < SOMA_LEGS; v++) sum = sum + number_magnitude(p->Y[i][v]) * width[v];
        delta[i] = soma_dot(p->Y[i], change, SOMA);
        spread = larger_or_nan(spread, sum);
    }

    /* what β may be, what of it is taken whatever the step, and what the whole change needs */
    s->sure = one - p->epsilon;
    const number room = s->sure * s->sure / (number_of(4) * p->kappa), largest = soma_largest(x);
    const number still = spread + p->size * p->rounding * largest * largest;
    const number moving = soma_largest(delta);
    const number free = number_of_real(WALK_MOST) * room - still;
    const mask all = number_greater(free, moving);
    s->part = number_select(all, one, number_of_real(WALK_PART) * free / moving);
    s->beta = still + s->part * moving;
    s->margin = one - (still + moving) / room;
    for (int v = 0; v < SOMA_LEGS; v++) {
        const number on_the_way = p->value[v] + s->part * change[v];
        s->to[v] = number_select(all, square[v], on_the_way);
    }
    s->to[6] = zero, s->to[7] = one;
    for (int k = 0; k < SOMA; k++) x[k] = x[k] + s->part * delta[k];
}

/* (pose-4): z is near the one root in the ball about x: bounds of its error and of what is unique about it */
static inline void soma_bound(const soma_legs *m, const soma_point *p, const soma_plan *s,
                              const number x[SOMA], const number z[SOMA], number *error,
                              number *unique) {
    const number zero = number_of(0), two = number_of(2), four = number_of(4);
    number J[SOMA][SOMA], value[SOMA], rest[SOMA], moved[SOMA], off = zero;

    soma_jacobian(m, z, SPHERE, J, value);
    for (int k = 0; k < SOMA; k++) {
        rest[k] = s->to[k] - value[k];
        moved[k] = z[k] - x[k];
    }
    for (int i = 0; i < SOMA; i++)
        off = larger_or_nan(off, number_magnitude(soma_dot(p->Y[i], rest, SOMA)));
    const number under = s->sure * s->sure - four * s->beta * p->kappa;
    const number radius = two * s->beta / (s->sure + number_root(number_larger(under, zero)));
    const number far = soma_largest(moved), largest = soma_largest(z);
    const number slope = s->sure - two * p->kappa * number_larger(far, radius);
    off = off + p->size * p->rounding * largest * largest;
    *error = number_select(number_greater(slope, zero), off / slope, number_of(INFINITY));
    *unique = s->sure / (two * p->kappa) - far - *error;
}

/* One certified step at most of lanes with wanted > 0, which is then 0 in those that are lost: they stay where they are. */
static inline void soma_step(const soma_legs *m, const number square[SOMA_LEGS],
                             const number width[SOMA_LEGS], number x[SOMA], soma_way *way,
                             number *wanted, number *margin) {
    const number zero = number_of(0), one = number_of(1), left = one - way->reached;
    number z[SOMA], error, unique, good = *wanted;
    soma_point p;
    soma_plan s;

    soma_point_at(m, x, SPHERE, &p);
    memcpy(z, x, sizeof z);
    soma_plan_step(&p, square, width, z, &s);
    soma_newton(m, s.to, z);
    soma_bound(m, &p, &s, x, z, &error, &unique);

    /* comparisons are false where a number is NaN */
    good = number_select(number_greater(s.sure, zero), good, zero);
    good = number_select(number_greater(s.part * left, number_of_real(WALK_LEAST)), good, zero);
    good = number_select(number_greater(unique, zero), good, zero);
    const mask done = number_greater(good, zero), end = number_greater(s.part, number_of(0.999));
    for (int k = 0; k < SOMA; k++) x[k] = number_select(done, z[k], x[k]);
    way->steps = number_select(done, way->steps + one, way->steps);
    way->error = number_select(done, error, way->error);
    way->unique = number_select(done, unique, way->unique);
    way->reached =
        number_select(done, number_select(end, one, one - left * (one - s.part)), way->reached);
    *margin = s.margin;
    *wanted = good;
}

/* The way to the squares of lengths in at most so many steps. x, with e·g = 0 and e·e = 1, ends where it is certain. */
static inline void soma_walk(const soma_legs *m, const number square[SOMA_LEGS],
                             const number width[SOMA_LEGS], int most, number x[SOMA],
                             soma_way *way) {
    const number zero = number_of(0), one = number_of(1);
    number wanted = one, margin;

    *way = (soma_way){zero, zero, zero, zero, zero};
    for (int n = 0; n < most; n++) {
        soma_step(m, square, width, x, way, &wanted, &margin);
        if (n == 0) way->margin = margin;
        wanted = number_select(number_greater(one, way->reached), wanted, zero);
        if (!number_any(number_greater(wanted, zero))) break;
    }
}

#endif
