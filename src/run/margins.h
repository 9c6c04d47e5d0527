/* How far legs and pose are from where a run ends: margins that are positive while all is well, over the number type. */
#ifndef GOUGH_RUN_MARGINS_H
#define GOUGH_RUN_MARGINS_H

#include "system/system.h"

/* what round-off may take from a limit that is just met, relative */
static const double limit_slack = 1e-12;
/* pivots further apart than this call for a look at the condition */
static const double suspicious_pivots = 1e-6;

/* margins: six of each kind of limit, then the determinants of the pose and of the program's pose. Those of kinds that no lane has
 * are neither filled nor read. */
enum { LIMIT_SIX = 6, MARGIN_SINGULAR = LIMIT_SIX * LIMIT_KINDS, MARGIN_PROGRAM, MARGINS };
_Static_assert((int)LEGS == LIMIT_SIX && (int)GOUGH_COMPONENTS == LIMIT_SIX, "six of each kind");

static inline elimination limits_pose(const struct system *r, const signals *m) {
    return legs_determinant(&r->h, &m->x, &m->g);
}

/* What limits are about besides lengths, rates and forces; only what a limit asks for is filled. */
typedef struct {
    number acceleration[LEGS]; /* of the length */
    number base_chord[LEGS];   /* 2 sin(φ/2), φ from the direction at home */
    number top_chord[LEGS];
    number component[3][GOUGH_COMPONENTS]; /* of the platform, by order of derivative; not angles */
    triad R;                               /* of the top */
} measured;

static inline void limits_measure_legs(const struct system *r, const signals *m, measured *q) {
    const limit_set *s = &r->limits;

    if (limit_has(s, LIMIT_ACCELERATION))
        legs_second_rates(&r->h, &m->rate, &m->acceleration, &m->g, q->acceleration);
    for (int v = 0; limit_has(s, LIMIT_BASE_SWING) && v < LEGS; v++)
        q->base_chord[v] = norm(subtract(m->g.n[v], s->home[v]));
    for (int v = 0; limit_has(s, LIMIT_TOP_SWING) && v < LEGS; v++)
        q->top_chord[v] = norm(subtract(onto(&m->x.q, m->g.n[v]), s->home_top[v]));
}

/* the point of the top, its velocity and acceleration: ρ + Q r and its derivatives */
static inline vector limits_point(const limit_set *s, const coordinates *x) {
    return add(x->rho, out_of(&x->q, s->arm));
}

static inline void limits_measure(const struct system *r, const signals *m, measured *q) {
    const limit_set *s = &r->limits;
    const triad back = transpose(&r->h.axes);

    limits_measure_legs(r, m, q);
    if (!(s->kinds & LIMITS_OF_PLATFORM)) return;
    q->R = compose(&m->x.q, &back);
    vector_store(subtract(limits_point(s, &m->x), s->start), q->component[0]);
    vector_store(limits_point(s, &m->rate), q->component[1]);
    vector_store(angular_velocity_of(&m->x, &m->rate), q->component[1] + 3);
    vector_store(limits_point(s, &m->acceleration), q->component[2]);
    vector_store(angular_velocity_of(&m->x, &m->acceleration), q->component[2] + 3);
}

/* margins below the greatest value, and above the least */
static inline number limits_below(const limit_range *range, number x) {
    return range->most - x * range->scale + number_of(limit_slack);
}
static inline number limits_above(const limit_range *range, number x) {
    return x * range->scale - range->least + number_of(limit_slack);
}

/* of leg v, relative: its length, rate and force */
KERNEL_SMALL number limit_short(const limit_set *s, const signals *m, int v) {
    return m->g.length[v] * s->shortest[v] - number_of(1) + number_of(limit_slack);
}
KERNEL_SMALL number limit_long(const limit_set *s, const signals *m, int v) {
    return number_of(1) - m->g.length[v] * s->longest[v] + number_of(limit_slack);
}
KERNEL_SMALL number limit_speed(const limit_set *s, const signals *m, int v) {
    return number_of(1) - number_magnitude(m->g.rate[v]) * s->speed[v] + number_of(limit_slack);
}
KERNEL_SMALL number limit_force(const limit_set *s, const signals *m, int pulls, int v) {
    return limits_below(&s->force[v], pulls ? m->force[v] : number_magnitude(m->force[v]));
}
KERNEL_SMALL number limit_pull(const limit_set *s, const signals *m, int v) {
    return limits_above(&s->force[v], m->force[v]);
}

static inline void limits_legs(const struct system *r, const signals *m, number margin[MARGINS]) {
    const limit_set *s = &r->limits;
    const int pulls = limit_has(s, LIMIT_PULL);

    for (int v = 0; v < LEGS; v++) margin[LIMIT_SIX * LIMIT_SHORT + v] = limit_short(s, m, v);
    for (int v = 0; limit_has(s, LIMIT_LONG) && v < LEGS; v++)
        margin[LIMIT_SIX * LIMIT_LONG + v] = limit_long(s, m, v);
    for (int v = 0; limit_has(s, LIMIT_SPEED) && v < LEGS; v++)
        margin[LIMIT_SIX * LIMIT_SPEED + v] = limit_speed(s, m, v);
    for (int v = 0; limit_has(s, LIMIT_FORCE) && v < LEGS; v++)
        margin[LIMIT_SIX * LIMIT_FORCE + v] = limit_force(s, m, pulls, v);
    for (int v = 0; pulls && v < LEGS; v++)
        margin[LIMIT_SIX * LIMIT_PULL + v] = limit_pull(s, m, v);
}

/* six margins of magnitudes that have one limit each */
static inline void limits_magnitudes(const limit_set *s, int kind, const number x[LIMIT_SIX],
                                     const number reciprocal[LIMIT_SIX], number margin[MARGINS]) {
    const number one = number_of(1), slack = number_of(limit_slack);

    if (!limit_has(s, kind)) return;
    for (int i = 0; i < LIMIT_SIX; i++)
        margin[LIMIT_SIX * kind + i] = one - number_magnitude(x[i]) * reciprocal[i] + slack;
}

static inline void limits_component(const limit_set *s, int order, int c, number x,
                                    number margin[MARGINS]) {
    number *const low = margin + LIMIT_SIX * (LIMIT_POSE_LOW + 2 * order);

    low[c] = limits_above(&s->component[order][c], x);
    low[LIMIT_SIX + c] = limits_below(&s->component[order][c], x);
}

/* all limits but those of angles */
static inline void limits_fill(const struct system *r, const signals *m, const measured *q,
                               number margin[MARGINS]) {
    const limit_set *s = &r->limits;

    limits_legs(r, m, margin);
    limits_magnitudes(s, LIMIT_ACCELERATION, q->acceleration, s->acceleration, margin);
    limits_magnitudes(s, LIMIT_BASE_SWING, q->base_chord, s->base_swing, margin);
    limits_magnitudes(s, LIMIT_TOP_SWING, q->top_chord, s->top_swing, margin);
    for (int order = 0; order < 3; order++) {
        if (!limit_has(s, LIMIT_POSE_LOW + 2 * order)) continue;
        for (int c = 0; c < (order == 0 ? 3 : GOUGH_COMPONENTS); c++)
            limits_component(s, order, c, q->component[order][c], margin);
    }
}

/* A cheap test of roll, pitch and yaw without inverse functions: where the angle a of (s, c) = ϱ (sin a, cos a) passes a bound,
 * ϱ sin(bound − a) changes its sign. It may flag an angle half a turn from a bound, but never misses one beyond it. */
static inline void limits_angle(const limit_set *set, int a, number s, number c,
                                number margin[MARGINS]) {
    number *const low = margin + LIMIT_SIX * LIMIT_POSE_LOW + 3 + a;
    const number given = number_select(number_greater(set->component[0][3 + a].scale, number_of(0)),
                                       number_of(0), number_of(1));

    low[0] = s * set->cosine[a][0] - c * set->sine[a][0] + given;
    low[LIMIT_SIX] = c * set->sine[a][1] - s * set->cosine[a][1] + given;
}

static inline void limits_angles_cheaply(const limit_set *s, int order, const triad *R,
                                         number margin[MARGINS]) {
    const number none = number_of(0);

    if (!limit_has(s, LIMIT_POSE_LOW)) return;
    if (order == GOUGH_XYZ) {
        limits_angle(s, 0, none - R->k.y, R->k.z, margin);
        limits_angle(s, 1, R->k.x, number_root(R->i.x * R->i.x + R->j.x * R->j.x), margin);
        limits_angle(s, 2, none - R->j.x, R->i.x, margin);
        return;
    }
    limits_angle(s, 0, R->j.z, R->k.z, margin);
    limits_angle(s, 1, -R->i.z, number_root(R->i.x * R->i.x + R->i.y * R->i.y), margin);
    limits_angle(s, 2, R->i.y, R->i.x, margin);
}

/* the least margin in each lane of the limits that need more than lengths, rates and forces, and `least` */
static inline number limits_least_measured(const struct system *r, const signals *m, number least) {
    number margin[MARGINS];
    measured q;

    limits_measure(r, m, &q);
    limits_fill(r, m, &q, margin);
    limits_angles_cheaply(&r->limits, (int)r->motion->order, &q.R, margin);
    for (int kind = LIMIT_ACCELERATION; kind < LIMIT_KINDS; kind++) {
        if (!limit_has(&r->limits, kind)) continue;
        for (int i = 0; i < LIMIT_SIX; i++)
            least = number_smaller(least, margin[LIMIT_SIX * kind + i]);
    }
    return least;
}

/* the least margin in each lane; below zero where a limit may be exceeded */
static inline number limits_least(const struct system *r, const signals *m) {
    const limit_set *s = &r->limits;
    const int pulls = limit_has(s, LIMIT_PULL);
    number least = limit_short(s, m, 0);

    for (int v = 1; v < LEGS; v++) least = number_smaller(least, limit_short(s, m, v));
    for (int v = 0; limit_has(s, LIMIT_LONG) && v < LEGS; v++)
        least = number_smaller(least, limit_long(s, m, v));
    for (int v = 0; limit_has(s, LIMIT_SPEED) && v < LEGS; v++)
        least = number_smaller(least, limit_speed(s, m, v));
    for (int v = 0; limit_has(s, LIMIT_FORCE) && v < LEGS; v++)
        least = number_smaller(least, limit_force(s, m, pulls, v));
    for (int v = 0; pulls && v < LEGS; v++) least = number_smaller(least, limit_pull(s, m, v));
    return s->kinds >> LIMIT_ACCELERATION ? limits_least_measured(r, m, least) : least;
}

#endif
