/* Worst values over one box of poses, (space-18). Theory: docs/theory/workspace.md. */
#define NUMBER_DOUBLE
#include "workspace/worst_values.h"

#include "workspace/ask.h"
#include "workspace/clearance.h"
#include "workspace/stiff.h"

static void put(values *to, int worst, double most, double sure, int leg) {
    to->most[worst] = bound_of(to->most[worst], most);
    if (sure <= to->sure[worst]) return;
    to->sure[worst] = sure;
    to->leg[worst] = leg;
}

/* The angle between two directions: by its cosine, and where that has no digits, near 0, by its sine. */
static void put_angle(values *to, int worst, const taylor_vector *a, const taylor_vector *b,
                      int leg) {
    const taylor cosine = taylor_dot(a, b);
    const taylor_vector sine = taylor_cross(a, b);
    double square = 0, centre = 0;
    for (int i = 0; i < 3; i++) {
        const double most = taylor_magnitude(&sine.x[i]);
        square += most * most, centre += sine.x[i].c * sine.x[i].c;
    }
    double most = acos(fmin(1, fmax(-1, taylor_least(&cosine))));
    if (taylor_least(&cosine) > 0)
        most = fmin(most, asin(fmin(1, sqrt(square) * (1 + 16 * ROUNDED))));
    put(to, worst, most * (1 + 4 * ROUNDED), atan2(sqrt(centre), cosine.c), leg);
}

static void find_lengths(const box_view *view, values *to) {
    for (int v = 0; v < LEGS; v++) {
        const double l = view->g.length[v];
        double bound[2];
        box_lengths(view, v, bound);
        put(to, GOUGH_WORST_SHORTEST, -bound[0], -l, v);
        put(to, GOUGH_WORST_LONGEST, bound[1], l, v);
    }
}

static void find_swing(const space *s, const box_view *view, const taylor_vector n[LEGS],
                       values *to) {
    for (int v = 0; v < LEGS; v++) {
        taylor_vector still, turned;
        box_home_directions(s, view, v, &still, &turned);
        put_angle(to, GOUGH_WORST_BASE_SWING, &n[v], &still, v);
        put_angle(to, GOUGH_WORST_TOP_SWING, &n[v], &turned, v);
    }
}

static void find_clearance(const space *s, const box_view *view, const taylor_vector n[LEGS],
                           values *to) {
    const double *diameter = s->reach->limits.diameter;
    for (int v = 0; v < LEGS; v++) {
        for (int w = v + 1; w < LEGS; w++) {
            const double thick = 0.5 * (diameter[v] + diameter[w]);
            double bound[2];
            if (clearance_is_joint(s, v, w)) continue;
            clearance_of(s, view, n, v, w, INFINITY, bound);
            put(to, GOUGH_WORST_CLEARANCE, thick - bound[0], thick - bound[1], v);
        }
    }
}

/* forces, rates and accelerations; infinite where a singular pose is not excluded */
static void find_asked(const space *s, const box_view *view, const taylor_vector n[LEGS],
                       const stiff *J, values *to) {
    const asked_parts parts = {true, true};
    asked_of_leg asked[LEGS];
    const bool regular = stiff_side(J) != 0;
    asked_of(s, view, n, J, parts, asked);
    for (int v = 0; v < LEGS; v++) {
        const asked_of_leg *a = &asked[v];
        put(to, GOUGH_WORST_PUSH, regular ? a->push.most : INFINITY, a->push.least, v);
        put(to, GOUGH_WORST_PULL, regular ? a->pull.most : INFINITY, a->pull.least, v);
        put(to, GOUGH_WORST_SPEED, a->speed.most, a->speed.least, v);
        put(to, GOUGH_WORST_ACCELERATION, a->acceleration.most, a->acceleration.least, v);
    }
}

void worst_values(const space *s, const box_view *view, unsigned wanted, values *to) {
    const unsigned forces = 1U << GOUGH_WORST_PUSH | 1U << GOUGH_WORST_PULL |
                            1U << GOUGH_WORST_SPEED | 1U << GOUGH_WORST_ACCELERATION;
    const unsigned matrix = forces | 1U << GOUGH_WORST_CONDITION | 1U << GOUGH_WORST_SINGULAR_VALUE;
    const unsigned swing = 1U << GOUGH_WORST_BASE_SWING | 1U << GOUGH_WORST_TOP_SWING;
    taylor_vector n[LEGS];
    stiff J;
    for (int i = 0; i < GOUGH_WORSTS; i++) {
        to->most[i] = to->sure[i] = -INFINITY;
        to->leg[i] = -1;
    }
    for (int v = 0; v < LEGS; v++) n[v] = box_direction(view, v);
    find_lengths(view, to);
    if (wanted & swing) find_swing(s, view, n, to);
    if (wanted & 1U << GOUGH_WORST_CLEARANCE) find_clearance(s, view, n, to);
    if (!(wanted & matrix)) return;
    stiff_of(s, view, n, &J);
    /* at a single pose the values themselves are known */
    if (view->varies && wanted & (1U << GOUGH_WORST_CONDITION | 1U << GOUGH_WORST_SINGULAR_VALUE))
        stiff_refine(&J, wanted & 1U << GOUGH_WORST_CONDITION);
    put(to, GOUGH_WORST_SINGULAR_VALUE, -J.least[0], -J.least[1], -1);
    put(to, GOUGH_WORST_CONDITION, J.condition, J.most[0] / J.least[1], -1);
    if (wanted & forces) find_asked(s, view, n, &J, to);
}
