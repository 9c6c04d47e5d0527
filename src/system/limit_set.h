/* The limits of legs and platform as margins are computed from them: reciprocals, directions of the legs at home, the point whose
 * motion is limited. Text over the number type. */
#ifndef GOUGH_SYSTEM_LIMIT_SET_H
#define GOUGH_SYSTEM_LIMIT_SET_H

#include "base/limits.h"
#include "gough/simulate.h"
#include "kernel/legs.h"

/* Kinds of limits: of each of the six legs, then of each component of the platform. A run that breaks several at once ends by the
 * first. LIMIT_FORCE is that of the magnitude of the force unless some leg may push and pull differently: then it is the greatest
 * force, and LIMIT_PULL the least. */
enum limit_kind {
    LIMIT_SHORT,
    LIMIT_LONG,
    LIMIT_SPEED,
    LIMIT_FORCE,
    LIMIT_PULL,
    LIMIT_ACCELERATION,
    LIMIT_BASE_SWING,
    LIMIT_TOP_SWING,
    LIMIT_LEG_KINDS,
    LIMIT_POSE_LOW = LIMIT_LEG_KINDS,
    LIMIT_POSE_HIGH,
    LIMIT_RATE_LOW,
    LIMIT_RATE_HIGH,
    LIMIT_SECOND_LOW,
    LIMIT_SECOND_HIGH,
    LIMIT_KINDS
};

/* 1 << kind of those that lie in accelerations */
enum {
    LIMITS_OF_LENGTH = 1 << LIMIT_SHORT | 1 << LIMIT_LONG,
    LIMITS_OF_PLATFORM = 1 << LIMIT_POSE_LOW | 1 << LIMIT_POSE_HIGH | 1 << LIMIT_RATE_LOW |
                         1 << LIMIT_RATE_HIGH | 1 << LIMIT_SECOND_LOW | 1 << LIMIT_SECOND_HIGH
};

/* A quantity x between two bounds: margins are most − x·scale and x·scale − least. Without a limit scale is 0, and they are 1. */
typedef struct {
    number scale, least, most;
} limit_range;

typedef struct {
    int kinds;          /* 1 << kind, of those that some lane has */
    gough_limits given; /* of the first lane */

    /* reciprocals, 0 for a limit not given; of angles φ, of the chord 2 sin(φ/2) */
    number shortest[LEGS], longest[LEGS], speed[LEGS], acceleration[LEGS], base_swing[LEGS],
        top_swing[LEGS];
    limit_range force[LEGS];

    /* of the platform, by order of derivative; for angles the sines and cosines of the bounds too */
    limit_range component[3][GOUGH_COMPONENTS];
    number sine[3][2], cosine[3][2];

    vector home[LEGS], home_top[LEGS]; /* directions of the legs at home: base axes, central axes */
    vector arm;                        /* the point, from the centre of mass, central axes */
    vector start;                      /* the point at home, base frame */
} limit_set;

static inline int limit_has(const limit_set *s, int kind) { return s->kinds >> kind & 1; }

static inline void limit_range_put(limit_range *range, int lane, const double bound[2]) {
    const double one = fabs(bound[0]), two = fabs(bound[1]), most = one > two ? one : two;
    const int given = most < INFINITY;

    number_put(&range->scale, lane, given ? 1 / (real)most : 0);
    number_put(&range->least, lane, given ? (real)bound[0] / (real)most : -1);
    number_put(&range->most, lane, given ? (real)bound[1] / (real)most : 1);
}

/* of an angle at most π, or INFINITY */
static inline real limit_chord(double angle) {
    return angle < INFINITY ? 1 / (2 * (real)sin(angle / 2)) : 0;
}

static inline void limit_set_leg(limit_set *s, int lane, int v, const gough_machine *machine,
                                 const gough_limits *l) {
    const gough_platform *p = &machine->platform;
    const double nothing = leg_no_length * machine->base_radius;
    const double opposite = l->force[v][0] + l->force[v][1];
    const real x = (real)p->top[v][0] - (real)p->base[v][0];
    const real y = (real)p->top[v][1] - (real)p->base[v][1];
    const real z = (real)p->top[v][2] + (real)p->height - (real)p->base[v][2];
    const real length = real_root(x * x + y * y + z * z);

    number_put(&s->shortest[v], lane,
               1 / (real)(l->length[v][0] > nothing ? l->length[v][0] : nothing));
    number_put(&s->longest[v], lane, 1 / (real)l->length[v][1]);
    number_put(&s->speed[v], lane, 1 / (real)l->speed[v]);
    number_put(&s->acceleration[v], lane, 1 / (real)l->acceleration[v]);
    number_put(&s->base_swing[v], lane, limit_chord(l->base_swing[v]));
    number_put(&s->top_swing[v], lane, limit_chord(l->top_swing[v]));
    limit_range_put(&s->force[v], lane, l->force[v]);
    number_put(&s->home[v].x, lane, x / length);
    number_put(&s->home[v].y, lane, y / length);
    number_put(&s->home[v].z, lane, z / length);

    s->kinds |=
        (l->length[v][1] < INFINITY) << LIMIT_LONG | (l->speed[v] < INFINITY) << LIMIT_SPEED |
        (l->force[v][1] < INFINITY) << LIMIT_FORCE | (opposite > 0 || opposite < 0) << LIMIT_PULL |
        (l->acceleration[v] < INFINITY) << LIMIT_ACCELERATION |
        (l->base_swing[v] < INFINITY) << LIMIT_BASE_SWING |
        (l->top_swing[v] < INFINITY) << LIMIT_TOP_SWING;
}

static inline void limit_set_components(limit_set *s, int lane, int order,
                                        const double bound[GOUGH_COMPONENTS][2]) {
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        limit_range_put(&s->component[order][c], lane, bound[c]);
        if (!(bound[c][1] < INFINITY)) continue;
        s->kinds |= 1 << (LIMIT_POSE_LOW + 2 * order) | 1 << (LIMIT_POSE_HIGH + 2 * order);
    }
}

/* sine and cosine that leave a margin of 1 where there is no limit */
static inline void limit_set_angle(limit_set *s, int lane, int a, const double bound[2]) {
    for (int side = 0; side < 2; side++) {
        const int given = bound[side] > -INFINITY && bound[side] < INFINITY;
        number_put(&s->sine[a][side], lane, given ? (real)sin(bound[side]) : 0);
        number_put(&s->cosine[a][side], lane, given ? (real)cos(bound[side]) : 0);
    }
}

/* the limits of one lane */
static inline void limit_set_lane(limit_set *s, int lane, const gough_machine *machine,
                                  const gough_motion *motion) {
    const gough_limits l = gough_limits_of(machine, motion);

    if (lane == 0) {
        s->kinds = 1 << LIMIT_SHORT;
        s->given = l;
    }
    for (int v = 0; v < LEGS; v++) limit_set_leg(s, lane, v, machine, &l);
    limit_set_components(s, lane, 0, l.pose);
    limit_set_components(s, lane, 1, l.rate);
    limit_set_components(s, lane, 2, l.second_rate);
    for (int a = 0; a < 3; a++) limit_set_angle(s, lane, a, l.pose[3 + a]);
    number_put(&s->arm.x, lane, l.about[0]);
    number_put(&s->arm.y, lane, l.about[1]);
    number_put(&s->arm.z, lane, l.about[2]);
    number_put(&s->start.x, lane, l.about[0]);
    number_put(&s->start.y, lane, l.about[1]);
    number_put(&s->start.z, lane, (real)l.about[2] + (real)machine->platform.height);
}

/* what is in central axes, once all lanes are there */
static inline void limit_set_turn(limit_set *s, const hexapod *h) {
    s->arm = onto(&h->axes, subtract(s->arm, h->center));
    for (int v = 0; v < LEGS; v++) s->home_top[v] = onto(&h->axes, s->home[v]);
}

#endif
