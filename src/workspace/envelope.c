/* Worst values over a box of poses, (space-18): gough_workspace_envelope(). Theory: docs/theory/workspace.md. */
#define NUMBER_DOUBLE
#include <stdint.h>
#include <string.h>

#include "workspace/certify.h"
#include "workspace/worst_values.h"

/* boxes that wait at most; how often a side is halved at most; halvings of the steps of a climb, and of a step at most; how often a
 * side is halved while centres are tried */
enum {
    CORNERS = 1 << GOUGH_COMPONENTS,
    WAITING = 1 << 13,
    DEEPEST = 26,
    FINEST = 9,
    CLIMBS = 40,
    SAMPLED = 2,
    SHARES = 16
};

/* a clearance that is smaller, in sizes of the machine, is that of legs that touch: rounding */
static const double TOUCHING = 1024 * DBL_EPSILON;

/* how far bounds may lie beyond values that are found, in parts of the value; swing in radians besides */
static const double PART = 0.01, PART_OF_LENGTH = 1e-4, SWING = 0.02 / 57.3;

static double sign_of(int worst) {
    const bool least = worst == GOUGH_WORST_PULL || worst == GOUGH_WORST_SHORTEST ||
                       worst == GOUGH_WORST_CLEARANCE || worst == GOUGH_WORST_SINGULAR_VALUE;
    return least ? -1 : 1;
}

/* the values of a pose, where they are worse than those found before */
static void sample(const space *s, const double pose[GOUGH_COMPONENTS], unsigned wanted,
                   gough_envelope *e) {
    gough_box one;
    box_view view;
    values at;
    memcpy(one.least, pose, sizeof one.least), memcpy(one.greatest, pose, sizeof one.greatest);
    box_view_of(s, &one, &view);
    worst_values(s, &view, wanted, &at);
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
        return PART * fmax(own, 0.1 * force);
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

/* ---- worse poses near the worst that is found: steps along each component, halved when none leads on ---- */

static bool step_from(const space *s, const gough_box *box, int worst, double part,
                      gough_envelope *e) {
    double start[GOUGH_COMPONENTS];
    const double before = e->of[worst].sampled;
    memcpy(start, e->of[worst].pose, sizeof start);
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        const double step = part * (box->greatest[c] - box->least[c]);
        for (int way = -1; way <= 1 && step > 0; way += 2) {
            double pose[GOUGH_COMPONENTS];
            memcpy(pose, start, sizeof pose);
            pose[c] = fmin(box->greatest[c], fmax(box->least[c], start[c] + way * step));
            if (fabs(pose[c] - start[c]) > 0) sample(s, pose, 1U << worst, e);
        }
    }
    return e->of[worst].sampled > before;
}

static void climb(const space *s, const gough_box *box, int worst, gough_envelope *e) {
    double part = 0.25;
    for (int steps = 0, halvings = 0; steps < CLIMBS && halvings < FINEST; steps++) {
        if (step_from(s, box, worst, part, e)) continue;
        part /= 2, halvings++;
    }
}

/* ---- bounds: the box with the worst bound is split first ---- */

/* A part of the box: side c is the at[c]-th of 2^depth[c] equal ones. */
typedef struct part {
    double most; /* bound of the value over it */
    uint32_t at[GOUGH_COMPONENTS];
    uint8_t depth[GOUGH_COMPONENTS];
} part;

/* the parts that wait, a heap: none is worse than the one at (i − 1)/2 */
typedef struct heap {
    part of[WAITING];
    int count;
    double settled; /* the worst bound of the parts that need not be split */
} heap;

static void heap_put(heap *h, const part *p) {
    int i = h->count++;
    while (i > 0 && h->of[(i - 1) / 2].most < p->most) {
        h->of[i] = h->of[(i - 1) / 2];
        i = (i - 1) / 2;
    }
    h->of[i] = *p;
}

static part heap_take(heap *h) {
    const part top = h->of[0], last = h->of[--h->count];
    int i = 0;
    for (int below = 1; below < h->count; below = 2 * i + 1) {
        if (below + 1 < h->count && h->of[below + 1].most > h->of[below].most) below++;
        if (!(h->of[below].most > last.most)) break;
        h->of[i] = h->of[below];
        i = below;
    }
    h->of[i] = last;
    return top;
}

/* neighbours have the same bits where they meet: twice a place at half a size is the same number */
static double end_of(const gough_box *box, const part *p, int c, uint32_t at) {
    if (at == (uint32_t)1 << p->depth[c]) return box->greatest[c];
    return box->least[c] + at * ldexp(box->greatest[c] - box->least[c], -p->depth[c]);
}

static void view_part(const space *s, const gough_box *box, const part *p, box_view *view) {
    gough_box one;
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        one.least[c] = end_of(box, p, c, p->at[c]);
        one.greatest[c] = fmax(one.least[c], end_of(box, p, c, p->at[c] + 1));
    }
    box_view_of(s, &one, view);
}

/* bounds a part and lets it wait, unless it is good enough as it is */
static void bound_part(const space *s, const gough_box *box, int worst, part *p, heap *h,
                       gough_envelope *e) {
    box_view view;
    values at;
    view_part(s, box, p, &view);
    worst_values(s, &view, 1U << worst, &at);
    e->tests++;
    /* a part has no worse one than the whole */
    p->most = fmin(p->most, at.most[worst]);
    if (p->most > e->of[worst].sampled + allowance(e, worst))
        heap_put(h, p);
    else
        h->settled = fmax(h->settled, p->most);
}

/* Splits until no part's bound exceeds the worst value found by more than the allowance, or too many boxes were tested. */
static void search(const space *s, const gough_box *box, int worst, size_t most_tests, heap *h,
                   gough_envelope *e) {
    const size_t end = e->tests + most_tests;
    part whole = {.most = INFINITY};
    gough_extreme *x = &e->of[worst];
    x->bound = INFINITY;
    if (most_tests == 0) return;
    h->count = 0, h->settled = x->sampled;
    bound_part(s, box, worst, &whole, h, e);
    while (h->count > 0 && h->of[0].most > x->sampled + allowance(e, worst) && e->tests < end) {
        part p = h->of[0];
        box_view view;
        view_part(s, box, &p, &view);
        const int side = box_widest_side(s, &view, 0);
        if (side < 0 || p.depth[side] >= DEEPEST || h->count + 1 >= WAITING) break;
        if (p.depth[side] < SAMPLED) sample(s, view.centre, 1U << worst, e);
        (void)heap_take(h);
        p.depth[side]++, p.at[side] *= 2;
        part other = p;
        other.at[side]++;
        bound_part(s, box, worst, &p, h, e);
        bound_part(s, box, worst, &other, h, e);
    }
    x->bound = fmax(h->settled, x->sampled);
    if (h->count > 0) x->bound = fmax(x->bound, h->of[0].most);
}

/* signs as users have them; an acceleration or speed that was not asked for is 0 */
static gough_status finish(const space *s, gough_envelope *e, gough_error *error) {
    gough_extreme *clearance = &e->of[GOUGH_WORST_CLEARANCE];
    if (fabs(clearance->sampled) <= TOUCHING * s->size) clearance->sampled = 0;
    for (int i = 0; i < GOUGH_WORSTS; i++) {
        gough_extreme *x = &e->of[i];
        /* no −0 */
        x->bound = sign_of(i) * x->bound + 0.0;
        x->sampled = sign_of(i) * x->sampled + 0.0;
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
    heap waiting;
    if (!box_is_box(box)) return box_refuse(error);
    if (!reach_is_valid(reach)) return reach_refuse(error);
    space_begin(&s, reach);
    *envelope = (gough_envelope){.tests = 0};
    for (int i = 0; i < GOUGH_WORSTS; i++)
        envelope->of[i] = (gough_extreme){.bound = -INFINITY, .sampled = -INFINITY, .leg = -1};
    sample_corners(&s, box, envelope);
    /* without tests, the corners are all that is wanted */
    for (int i = 0; i < GOUGH_WORSTS && reach->most_tests > 0; i++) climb(&s, box, i, envelope);
    for (int i = 0; i < GOUGH_WORSTS; i++)
        search(&s, box, i, reach->most_tests / SHARES, &waiting, envelope);
    return finish(&s, envelope, error);
}

const char *gough_worst_name(gough_worst worst) {
    static const char *const name[GOUGH_WORSTS] = {
        "push",       "pull",      "shortest",  "longest",   "speed",         "acceleration",
        "base_swing", "top_swing", "clearance", "condition", "singular_value"};
    return (unsigned)worst < GOUGH_WORSTS ? name[worst] : "unknown";
}
