/* Worst values over a box of poses, (space-18): gough_workspace_envelope(). Theory: docs/theory/workspace.md. */
#define NUMBER_DOUBLE
#include <string.h>

#include "workspace/ask.h"
#include "workspace/certify.h"
#include "workspace/clearance.h"

enum {
    WAITING = 60 * GOUGH_COMPONENTS + 1,
    CORNERS = 1 << GOUGH_COMPONENTS,
    DOUBLINGS = 7,
    SHARES = 16
};

/* how far bounds may lie beyond values that are found, in parts of the value; swing in radians besides */
static const double PART = 0.01, PART_OF_LENGTH = 1e-4, SWING = 0.1 / 57.3;
static const double NO_SIDE = 1e-10;

/* Values of which greater ones are worse: those that are worst where they are least have their sign turned. */
typedef struct values {
    double most[GOUGH_WORSTS]; /* no pose of the box has a worse one */
    double sure[GOUGH_WORSTS]; /* at a single pose: one that it has */
    int leg[GOUGH_WORSTS];
} values;

static double sign_of(int worst) {
    const bool least = worst == GOUGH_WORST_PULL || worst == GOUGH_WORST_SHORTEST ||
                       worst == GOUGH_WORST_CLEARANCE || worst == GOUGH_WORST_SINGULAR_VALUE;
    return least ? -1 : 1;
}

static void put(values *to, int worst, double most, double sure, int leg) {
    if (!(most <= to->most[worst])) to->most[worst] = most;
    if (sure <= to->sure[worst]) return;
    to->sure[worst] = sure;
    to->leg[worst] = leg;
}

/* The angle between two directions: by its cosine, and where that has no digits, near 0, by its sine. */
static void put_angle(values *to, int worst, const affine_vector *a, const affine_vector *b,
                      int leg) {
    const affine cosine = affine_dot(a, b);
    const affine_vector sine = affine_cross(a, b);
    double square = 0, centre = 0;
    for (int i = 0; i < 3; i++) {
        const double most = affine_magnitude(&sine.x[i]);
        square += most * most, centre += sine.x[i].c * sine.x[i].c;
    }
    double most = acos(fmin(1, fmax(-1, affine_least(&cosine))));
    if (affine_least(&cosine) > 0)
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

static void find_swing(const space *s, const box_view *view, const affine_vector n[LEGS],
                       values *to) {
    for (int v = 0; v < LEGS; v++) {
        affine_vector still, turned;
        box_home_directions(s, view, v, &still, &turned);
        put_angle(to, GOUGH_WORST_BASE_SWING, &n[v], &still, v);
        put_angle(to, GOUGH_WORST_TOP_SWING, &n[v], &turned, v);
    }
}

static void find_clearance(const space *s, const box_view *view, const affine_vector n[LEGS],
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
static void find_asked(const space *s, const box_view *view, const affine_vector n[LEGS],
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

static void find_values(const space *s, const box_view *view, unsigned wanted, values *to) {
    const unsigned forces = 1U << GOUGH_WORST_PUSH | 1U << GOUGH_WORST_PULL |
                            1U << GOUGH_WORST_SPEED | 1U << GOUGH_WORST_ACCELERATION;
    const unsigned matrix = forces | 1U << GOUGH_WORST_CONDITION | 1U << GOUGH_WORST_SINGULAR_VALUE;
    const unsigned swing = 1U << GOUGH_WORST_BASE_SWING | 1U << GOUGH_WORST_TOP_SWING;
    affine_vector n[LEGS];
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
    put(to, GOUGH_WORST_SINGULAR_VALUE, -J.least[0], -J.least[1], -1);
    put(to, GOUGH_WORST_CONDITION, J.least[0] > 0 ? J.most[1] / J.least[0] : INFINITY,
        J.most[0] / J.least[1], -1);
    if (wanted & forces) find_asked(s, view, n, &J, to);
}

/* the values of a pose, where they are worse than those found before */
static void sample(const space *s, const double pose[GOUGH_COMPONENTS], unsigned wanted,
                   gough_envelope *e) {
    gough_box one;
    box_view view;
    values at;
    memcpy(one.least, pose, sizeof one.least), memcpy(one.greatest, pose, sizeof one.greatest);
    box_view_of(s, &one, &view);
    find_values(s, &view, wanted, &at);
    e->tests++;
    for (int i = 0; i < GOUGH_WORSTS; i++) {
        gough_extreme *x = &e->of[i];
        if (!(at.sure[i] > x->sampled)) continue;
        x->sampled = at.sure[i];
        x->leg = at.leg[i];
        memcpy(x->pose, pose, sizeof x->pose);
    }
}

static double allowance(const gough_envelope *e, int worst) {
    const double own = fabs(e->of[worst].sampled);
    const double force =
        fmax(fabs(e->of[GOUGH_WORST_PUSH].sampled), fabs(e->of[GOUGH_WORST_PULL].sampled));
    switch (worst) {
    case GOUGH_WORST_PUSH:
    case GOUGH_WORST_PULL:
        return PART * force;
    case GOUGH_WORST_SHORTEST:
    case GOUGH_WORST_LONGEST:
        return PART_OF_LENGTH * own;
    case GOUGH_WORST_BASE_SWING:
    case GOUGH_WORST_TOP_SWING:
        return fmax(PART * own, SWING);
    case GOUGH_WORST_CLEARANCE:
        return PART * e->of[GOUGH_WORST_SHORTEST].sampled * -0.1 + PART * own;
    default:
        return PART * own;
    }
}

static void sample_corners(const space *s, const gough_box *box, gough_envelope *e) {
    for (int corner = 0; corner < CORNERS; corner++) {
        double pose[GOUGH_COMPONENTS];
        for (int c = 0; c < GOUGH_COMPONENTS; c++)
            pose[c] = corner >> c & 1 ? box->greatest[c] : box->least[c];
        sample(s, pose, ~0U, e);
    }
}

/* One value over the box, until it is nowhere worse than the worst that is found by more than an allowance; its bound
 * then. NaN: too many boxes. */
static double bound_of(const space *s, const gough_box *box, int worst, double allowed,
                       size_t most_tests, gough_envelope *e) {
    gough_box waiting[WAITING] = {*box};
    const size_t end = e->tests + most_tests;
    double bound = -INFINITY;
    int count = 1;
    while (count > 0) {
        const gough_box one = waiting[--count];
        box_view view;
        values at;
        box_view_of(s, &one, &view);
        find_values(s, &view, 1U << worst, &at);
        e->tests++;
        if (at.most[worst] <= e->of[worst].sampled + allowed) {
            bound = fmax(bound, at.most[worst]);
            continue;
        }
        const int side = box_widest_side(s, &view, NO_SIDE);
        if (side < 0 || e->tests >= end || count + 2 > WAITING) return NAN;
        sample(s, view.centre, 1U << worst, e);
        waiting[count] = waiting[count + 1] = one;
        waiting[count].greatest[side] = waiting[count + 1].least[side] = view.centre[side];
        count += 2;
    }
    return bound;
}

/* From a wide allowance to the one that is wanted, halved while that does not ask for too many boxes: a bound that is farther
 * off is as certain. */
static void search(const space *s, const gough_box *box, gough_envelope *e) {
    const size_t share = s->reach->most_tests / SHARES;
    for (int i = 0; i < GOUGH_WORSTS; i++) {
        e->of[i].bound = INFINITY;
        for (int k = DOUBLINGS; k >= 0; k--) {
            const double bound = bound_of(s, box, i, ldexp(allowance(e, i), k), share, e);
            if (!(bound <= e->of[i].bound)) break;
            e->of[i].bound = bound;
        }
    }
}

/* signs as users have them; an acceleration or speed that was not asked for is 0 */
static gough_status finish(gough_envelope *e, gough_error *error) {
    for (int i = 0; i < GOUGH_WORSTS; i++) {
        gough_extreme *x = &e->of[i];
        x->bound = sign_of(i) * fmax(x->bound, x->sampled);
        x->sampled *= sign_of(i);
        if (i == GOUGH_WORST_SINGULAR_VALUE || i == GOUGH_WORST_SHORTEST)
            x->bound = fmax(x->bound, 0);
    }
    if (isfinite(e->of[GOUGH_WORST_PUSH].bound)) return GOUGH_OK;
    return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                      "the box may contain a singular pose, where forces have no bound");
}

gough_status gough_workspace_envelope(const gough_reach *reach, const gough_box *box,
                                      gough_envelope *envelope, gough_error *error) {
    space s;
    if (!box_is_box(box)) return box_refuse(error);
    if (!reach_is_valid(reach)) return reach_refuse(error);
    space_begin(&s, reach);
    *envelope = (gough_envelope){.tests = 0};
    for (int i = 0; i < GOUGH_WORSTS; i++)
        envelope->of[i] = (gough_extreme){.bound = -INFINITY, .sampled = -INFINITY, .leg = -1};
    sample_corners(&s, box, envelope);
    search(&s, box, envelope);
    return finish(envelope, error);
}

const char *gough_worst_name(gough_worst worst) {
    static const char *const name[GOUGH_WORSTS] = {
        "push",       "pull",      "shortest",  "longest",   "speed",         "acceleration",
        "base_swing", "top_swing", "clearance", "condition", "singular_value"};
    return (unsigned)worst < GOUGH_WORSTS ? name[worst] : "unknown";
}
