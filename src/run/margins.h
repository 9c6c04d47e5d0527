/* How far legs and pose are from where a run ends: margins that are positive while all is well, over the number type. */
#ifndef GOUGH_RUN_MARGINS_H
#define GOUGH_RUN_MARGINS_H

#include "system/system.h"

/* what round-off may take from a limit that is just met, relative */
static const double limit_slack = 1e-12;
/* pivots further apart than this call for a look at the condition */
static const double suspicious_pivots = 1e-6;

/* margins: four limits of six legs, then the determinants of the pose and of the program's pose */
enum {
    MARGIN_SHORT = 0,
    MARGIN_LONG = LEGS,
    MARGIN_SPEED = 2 * LEGS,
    MARGIN_FORCE = 3 * LEGS,
    MARGIN_POSE = 4 * LEGS,
    MARGIN_PROGRAM,
    MARGINS
};

static inline elimination limits_pose(const struct system *r, const signals *m) {
    return legs_determinant(&r->h, &m->x, &m->g);
}

/* margins of the legs, relative; 1 where there is no limit */
static inline void limits_legs(const struct system *r, const signals *m,
                               number margin[MARGIN_POSE]) {
    const number one = number_of(1), slack = number_of(limit_slack);

    for (int v = 0; v < LEGS; v++) {
        margin[MARGIN_SHORT + v] = m->g.length[v] * r->least - one + slack;
        margin[MARGIN_LONG + v] = one;
        margin[MARGIN_SPEED + v] = one;
        margin[MARGIN_FORCE + v] = one;
    }
    for (int v = 0; r->limited[0] && v < LEGS; v++) {
        margin[MARGIN_LONG + v] = one - m->g.length[v] * r->most + slack;
    }
    for (int v = 0; r->limited[1] && v < LEGS; v++) {
        margin[MARGIN_SPEED + v] = one - number_magnitude(m->g.rate[v]) * r->fastest + slack;
    }
    for (int v = 0; r->limited[2] && v < LEGS; v++) {
        margin[MARGIN_FORCE + v] = one - number_magnitude(m->force[v]) * r->strongest + slack;
    }
}

/* the least of them, in each lane */
static inline number limits_least(const struct system *r, const signals *m) {
    number margin[MARGIN_POSE], least;

    limits_legs(r, m, margin);
    least = margin[MARGIN_SHORT];
    for (int kind = 0; kind < 4; kind++) {
        if (kind > 0 && !r->limited[kind - 1]) continue;
        for (int v = 0; v < LEGS; v++) {
            const number here = margin[kind * LEGS + v];
            least = number_select(number_greater(least, here), here, least);
        }
    }
    return least;
}

#endif
