/* Inverse dynamics along the program: rows at the output times, and looks between them as close as the motion asks for, so that
 * peaks, time integrals and crossings of limits are those of the motion. For scalar number types.
 *
 * Between two rows, and between two corners of the program (ends of ramps and moves, rows of recordings), a cell of the motion is
 * examined at its quarters. It is halved while its fourth differences say that the looks do not follow lengths, rates, forces
 * and powers, or while the program at 128 times from row to row is not where the looks expect it: what the looks do not meet,
 * these do.
 * Looks are taken in, in order of time, one late: where a margin dips between looks, another is put at the bottom of the dip. */
#ifndef GOUGH_RUN_FORCES_ALONG_H
#define GOUGH_RUN_FORCES_ALONG_H

#include "program/appointments.h"
#include "run/ends.h"
#include "run/row.h"
#include "run/run.h"

/* halvings of a bracket around a crossing: to round-off */
enum { WALK_HALVINGS = 64 };
/* times from row to row at which the program is compared with what the looks expect; a pulse as wide as a hundredth of the rows'
 * distance at half height meets one */
enum { WALK_SCAN = 128 };
/* halvings of a cell; the deeper ones are for single kinks and jumps, which take few cells */
enum { WALK_DEPTH = 10, WALK_DEPTH_KINK = 24, WALK_CELLS_KINK = 1024 };

/* fourth differences over five looks, as a share of the largest value so far: peaks are then right to about 1e-6, integrals to
 * 1e-7 */
static const double walk_difference = 1e-6;
/* accelerations of the program may differ from what looks expect by this share of gravity and of the largest so far */
static const double walk_surprise = 1e-5;
/* pieces shorter than this part of the duration have no inside; corners so near each other are one (appointments.h) */
static const double walk_least = 2e-13;
/* a piece longer than the rest of a stretch by less than this is as long */
static const double walk_near = 1e-9;
/* what moves or speeds less than this, in base radii and durations, is at rest */
static const double walk_rest = 1e-9;

/* the motion at one time */
typedef struct {
    real t;
    int row;  /* a row stands here */
    int near; /* the pose is nearly singular */
    jet component[GOUGH_COMPONENTS];
    real value[GOUGH_COLUMNS], margin[MARGINS];
    measured q;
} look;

typedef struct {
    struct system r;
    gough_sink sink;
    gough_crossing_sink crossings;
    void *context, *crossings_context;
    gough_end *end;
    limits_side side;
    appointments when;                    /* the program's corners */
    gough_crossing open[MARGIN_SINGULAR]; /* limits that are exceeded now; else done */
    int crossed; /* some limit was exceeded: `first` is the earliest, of margin `first_margin` */
    gough_crossing first;
    int first_margin;
    unsigned first_legs; /* all legs at that limit then: bit v for leg v + 1 */

    real speed, force, swiftness,
        determinant; /* largest so far: of legs, and the program's acceleration */
    int cells;       /* since the last row */
    look held[2];    /* the last look taken in, and the one after it */
    int holding;     /* how many of these there are */
    int corner;      /* the look held is a corner of the program */
} walk;

/* the program as an instant: its forces are what the legs give */
static inline void walk_at(walk *a, real t, signals *m) {
    const wanted *s = system_wanted(&a->r, t);

    m->x = s->x[0];
    m->rate = s->x[1];
    m->acceleration = s->x[2];
    m->g = s->program;
    for (int v = 0; v < LEGS; v++) m->force[v] = s->force[v], m->leg[v] = s->leg[v];
}

static inline void walk_margins(walk *a, real t, signals *m, real margin[MARGINS]) {
    measured q;

    walk_at(a, t, m);
    limits_margins(&a->r, system_wanted(&a->r, t), m, limits_pose(&a->r, m).determinant, &a->side,
                   &q, margin);
}

static inline void walk_look(walk *a, real t, look *l) {
    signals m;

    l->t = t;
    l->row = 0;
    walk_at(a, t, &m);
    motion_components(a->r.motion, t, l->component);
    const elimination pose = limits_pose(&a->r, &m);
    limits_margins(&a->r, system_wanted(&a->r, t), &m, pose.determinant, &a->side, &l->q,
                   l->margin);
    l->near = limits_nearly_singular(&a->r, t, &m, &pose);
    row_fill(&a->r, system_wanted(&a->r, t), t, &m, 0, ROW_WHOLE, 0, l->value);
}

/* ---- what is between two looks ---- */

/* when margin e passes its end between `low` and `high`, which differ in it */
static inline real walk_root(walk *a, int e, real low, real high, int broken_at_low) {
    real margin[MARGINS];
    signals m;

    for (int i = 0; i < WALK_HALVINGS; i++) {
        const real middle = (low + high) / 2;
        walk_margins(a, middle, &m, margin);
        if ((margin[e] >= 0 ? 0 : 1) == broken_at_low) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return high;
}

/* when the pose becomes nearly singular between `low` and `high` */
static inline real walk_near_root(walk *a, real low, real high) {
    signals m;

    for (int i = 0; i < WALK_HALVINGS; i++) {
        const real middle = (low + high) / 2;
        walk_at(a, middle, &m);
        const elimination e = limits_pose(&a->r, &m);
        if (limits_nearly_singular(&a->r, middle, &m, &e)) {
            high = middle;
        } else {
            low = middle;
        }
    }
    return high;
}

/* ---- crossings of limits ---- */

/* what the limit of margin e is about */
static inline double walk_quantity(const look *l, int e) {
    const int kind = e / LIMIT_SIX, i = e % LIMIT_SIX;

    switch (kind) {
    case LIMIT_SHORT:
    case LIMIT_LONG:
        return (double)l->value[GOUGH_L + i];
    case LIMIT_SPEED:
        return (double)l->value[GOUGH_DL + i];
    case LIMIT_FORCE:
    case LIMIT_PULL:
        return (double)l->value[GOUGH_F + i];
    case LIMIT_ACCELERATION:
        return (double)l->q.acceleration[i];
    case LIMIT_BASE_SWING:
        return 2 * asin(fmin(1, (double)l->q.base_chord[i] / 2));
    case LIMIT_TOP_SWING:
        return 2 * asin(fmin(1, (double)l->q.top_chord[i] / 2));
    default:
        return (double)l->q.component[(kind - LIMIT_POSE_LOW) / 2][i];
    }
}

static inline int walk_worse(const walk *a, int e, double value, double than) {
    const int kind = e / LIMIT_SIX;

    if (kind == LIMIT_SHORT || limits_is_least(e)) return value < than;
    if (kind == LIMIT_LONG || kind >= LIMIT_LEG_KINDS) return value > than;
    if (kind == LIMIT_FORCE && limit_has(&a->r.limits, LIMIT_PULL)) return value > than;
    return fabs(value) > fabs(than);
}

static inline void walk_close(walk *a, int e, double leave) {
    a->open[e].leave = leave;
    if (a->crossings) a->crossings(a->crossings_context, &a->open[e]);
    a->open[e].cause = GOUGH_END_DONE;
}

static inline void walk_open(walk *a, int e, double enter, double value) {
    const int of_leg = e / LIMIT_SIX < LIMIT_LEG_KINDS;
    real margin[MARGINS];
    signals m;

    a->open[e] = (gough_crossing){.cause = limits_cause(&a->r, e),
                                  .leg = of_leg ? e % LIMIT_SIX + 1 : 0,
                                  .component = of_leg ? 0 : e % LIMIT_SIX + 1,
                                  .limit = limits_of(&a->r, e),
                                  .least = limits_is_least(e) != 0,
                                  .enter = enter,
                                  .leave = INFINITY,
                                  .worst = value,
                                  .worst_time = enter};
    if (a->crossed && !(enter < a->first.enter)) return;
    a->first = a->open[e];
    a->first_margin = e;
    walk_margins(a, (real)enter, &m, margin);
    a->first_legs = limits_together_at(&a->r, margin, e);
    a->crossed = 1;
}

/* one limit at a look, the look before having been at `before` */
static inline void walk_cross_one(walk *a, int e, real before, const look *l) {
    const int broken = !(l->margin[e] >= 0), was = a->open[e].cause != GOUGH_END_DONE;

    if (!broken && !was) return;
    const double value = walk_quantity(l, e);
    if (broken && !was) {
        const double enter = (double)(l->t > before ? walk_root(a, e, before, l->t, 0) : l->t);
        walk_open(a, e, enter, value);
    }
    if (!broken && was) walk_close(a, e, (double)walk_root(a, e, before, l->t, 1));
    if (broken && walk_worse(a, e, value, a->open[e].worst)) {
        a->open[e].worst = value;
        a->open[e].worst_time = (double)l->t;
    }
}

/* all limits */
static inline void walk_cross(walk *a, real before, const look *l) {
    for (int e = 0; e < MARGIN_SINGULAR; e++)
        if (limits_has_margin(&a->r, e)) walk_cross_one(a, e, before, l);
}

/* singular, no length, not finite at a look: what `forces` cannot go past */
static inline gough_status walk_hard(walk *a, real before, const look *l) {
    const double nothing = leg_no_length * a->r.lane[0].machine->base_radius;
    const real t = l->t;

    if (a->r.fault.what && !(a->r.fault.time > t)) return limits_fault(&a->r, a->end);
    for (int v = 0; v < LEGS; v++) {
        if (!(l->value[GOUGH_L + v] > (real)nothing)) {
            limits_say_no_length(v, (double)t, a->end);
            return GOUGH_ERROR_NUMERICAL;
        }
    }
    if (!(l->margin[MARGIN_SINGULAR] >= 0)) {
        const real root = t > before ? walk_root(a, MARGIN_SINGULAR, before, t, 0) : t;
        limits_say_singular(1, (double)root, a->end);
        return GOUGH_ERROR_NUMERICAL;
    }
    if (l->near) {
        limits_say_singular(1, (double)(t > before ? walk_near_root(a, before, t) : t), a->end);
        return GOUGH_ERROR_NUMERICAL;
    }
    return GOUGH_OK;
}

/* ---- looks taken in, in order of time ---- */

static inline gough_status walk_row(walk *a, const look *l) {
    if (row_send(&a->r, l->value, a->sink, a->context)) {
        limits_no_leg(a->end, GOUGH_END_STOPPED, (double)l->t);
        end_say(a->end, "the run was stopped at t = %.9g", (double)l->t);
        return GOUGH_ERROR_NUMERICAL;
    }
    return GOUGH_OK;
}

static inline gough_status walk_process(walk *a, real before, const look *l, int corner) {
    gough_summary *summary = a->r.options->summary;
    const gough_status status = walk_hard(a, before, l);

    if (status != GOUGH_OK) return status;
    walk_cross(a, before, l);
    if (!(l->value[GOUGH_CONDITION] <= (real)greatest_condition) ||
        !row_finite(&a->r, 0, l->value)) {
        limits_say_singular(1, (double)l->t, a->end);
        return GOUGH_ERROR_NUMERICAL;
    }
    if (summary) row_sum(l->value, summary, a->r.lane[0].machine, l->row);
    if (summary && corner) gough_summary_corner(summary);
    return l->row ? walk_row(a, l) : GOUGH_OK;
}

/* Where a margin has its bottom between three looks, by the parabola through them: whether it goes below zero there although it
 * does not at the looks, or the other way round, and when. */
static inline int walk_dip(const walk *a, const look *one, const look *two, const look *three,
                           real *t) {
    const real left = two->t - one->t, right = three->t - two->t;

    for (int e = 0; e <= MARGIN_SINGULAR; e++) {
        if (!limits_has_margin(&a->r, e)) continue;
        const real p = one->margin[e], q = two->margin[e], r = three->margin[e];
        const int bottom = q >= 0 && p >= q && r >= q && (p > q || r > q);
        const int top = e < MARGIN_SINGULAR && q < 0 && p <= q && r <= q && (p < q || r < q);
        if (!bottom && !top) continue;
        const real before = (q - p) / left, after = (r - q) / right;
        const real bend = (after - before) / (left + right), slope = before + bend * left;
        const real value = q - slope * slope / (4 * bend);
        if (bottom ? !(value < 0) : !(value >= 0)) continue;
        *t = two->t - slope / (2 * bend);
        return *t > one->t && *t < three->t && (*t < two->t || *t > two->t);
    }
    return 0;
}

/* the next look in order of time */
static inline gough_status walk_feed(walk *a, const look *l, int corner) {
    gough_status status = GOUGH_OK;
    look *one = &a->held[0], *two = &a->held[1], inserted;
    real t = l->t;

    if (a->holding < 2) {
        if (a->holding == 0) status = walk_process(a, l->t, l, 0);
        a->held[a->holding++] = *l;
        a->corner = corner;
        return status;
    }
    const int dips = walk_dip(a, one, two, l, &t);
    if (dips) walk_look(a, t, &inserted);
    if (dips && t < two->t) {
        status = walk_process(a, one->t, &inserted, 0);
        if (status != GOUGH_OK) return status;
        status = walk_process(a, inserted.t, two, a->corner);
    } else {
        status = walk_process(a, one->t, two, a->corner);
    }
    *one = *two;
    if (status == GOUGH_OK && dips && t > one->t) {
        status = walk_process(a, one->t, &inserted, 0);
        *one = inserted;
    }
    *two = *l;
    a->corner = corner;
    return status;
}

/* the look that is still held at the end */
static inline gough_status walk_finish(walk *a) {
    if (a->holding < 2) return GOUGH_OK;
    return walk_process(a, a->held[0].t, &a->held[1], 0);
}

/* ---- how close looks have to be ---- */

static inline real walk_fourth(const look *const l[5], int column) {
    return real_magnitude(l[0]->value[column] - 4 * l[1]->value[column] + 6 * l[2]->value[column] -
                          4 * l[3]->value[column] + l[4]->value[column]);
}

/* largest values so far, which differences are compared with */
static inline void walk_learn(walk *a, const look *l) {
    const real radius = (real)a->r.lane[0].machine->base_radius;

    for (int v = 0; v < LEGS; v++) {
        const real speed = real_magnitude(l->value[GOUGH_DL + v]);
        const real force = real_magnitude(l->value[GOUGH_F + v]);
        if (speed > a->speed && real_finite(speed)) a->speed = speed;
        if (force > a->force && real_finite(force)) a->force = force;
    }
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        const real dd = real_magnitude(l->component[c].dd) * (c < GOUGH_ROLL ? 1 : radius);
        if (dd > a->swiftness && real_finite(dd)) a->swiftness = dd;
    }
    if (l->margin[MARGIN_SINGULAR] > a->determinant) a->determinant = l->margin[MARGIN_SINGULAR];
}

static inline int walk_smooth(const walk *a, const look *const l[5]) {
    const real share = (real)walk_difference, radius = (real)a->r.lane[0].machine->base_radius;
    real determinant = 0;

    for (int i = 0; i < 5; i++) {
        const real weight = i % 2 ? -4 : i == 2 ? 6 : 1;
        determinant = determinant + weight * l[i]->margin[MARGIN_SINGULAR];
    }
    if (real_magnitude(determinant) > 100 * share * a->determinant) return 0;
    for (int v = 0; v < LEGS; v++) {
        if (walk_fourth(l, GOUGH_L + v) > share * radius ||
            walk_fourth(l, GOUGH_DL + v) > share * a->speed ||
            walk_fourth(l, GOUGH_F + v) > share * a->force ||
            walk_fourth(l, GOUGH_P + v) > share * a->force * a->speed) {
            return 0;
        }
    }
    return 1;
}

/* the second derivative at s of the quintic on 0 … 1 that has these values and derivatives (times h, h²) at its ends */
static inline real walk_quintic(jet p, jet q, real s) {
    const real rise = q.v - p.v - p.d - p.dd / 2;
    const real c3 = 10 * rise - 4 * (q.d - p.d - p.dd) + (q.dd - p.dd) / 2;
    const real c4 = -15 * rise + 7 * (q.d - p.d - p.dd) - (q.dd - p.dd);
    const real c5 = 6 * rise - 3 * (q.d - p.d - p.dd) + (q.dd - p.dd) / 2;

    return p.dd + s * (6 * c3 + s * (12 * c4 + s * 20 * c5));
}

/* Whether the program's accelerations between two looks are as the looks expect them, at the times of the scan. Moves and splines
 * have nothing to hide between their corners. */
static inline int walk_expected(walk *a, const look *p, const look *q) {
    const real step = (real)a->r.options->output_step / WALK_SCAN, h = q->t - p->t;
    const real gravity = (real)a->r.lane[0].machine->gravity_magnitude;
    const real radius = (real)a->r.lane[0].machine->base_radius;
    const long long first = (long long)floor((double)(p->t / step)) + 1;
    formula_row component[GOUGH_COMPONENTS];
    real t[FORMULA_TIMES];

    if (a->r.motion->kind != GOUGH_MOTION_FORMULAS) return 1;
    for (long long k = first; (real)k * step < q->t;) {
        int count = 0;
        while (count < FORMULA_TIMES && (real)k * step < q->t) t[count++] = (real)k++ * step;
        motion_components_at(a->r.motion, count, t, component);
        for (int i = 0; i < count; i++) {
            jet one[GOUGH_COMPONENTS];
            motion_components_of(component, i, one);
            const char *flaw = wanted_flaw(one);
            if (flaw) {
                wanted_blame(&a->r, flaw, t[i]);
                return 0;
            }
        }
        for (int c = 0; c < GOUGH_COMPONENTS; c++) {
            const jet *from = &p->component[c], *to = &q->component[c];
            const jet one = {from->v, h * from->d, h * h * from->dd};
            const jet two = {to->v, h * to->d, h * h * to->dd};
            const real arm = c < GOUGH_ROLL ? 1 : radius;
            const real round_off = 100 * REAL_EPSILON * real_magnitude(from->v) / (h * h);
            for (int i = 0; i < count; i++) {
                const real dd = component[c].dd[i];
                const real wrong = dd - walk_quintic(one, two, (t[i] - p->t) / h) / (h * h);
                if (arm * real_magnitude(dd) > a->swiftness)
                    a->swiftness = arm * real_magnitude(dd);
                if (!(arm * real_magnitude(wrong) <=
                      (real)walk_surprise * (gravity + a->swiftness) + arm * round_off)) {
                    return 0;
                }
            }
        }
    }
    return 1;
}

static inline int walk_followed(walk *a, const look *const l[5]) {
    if (!walk_smooth(a, l)) return 0;
    for (int i = 0; i < 4; i++) {
        if (!walk_expected(a, l[i], l[i + 1])) return 0;
    }
    return 1;
}

/* the motion after look `from`, which was fed, up to look `to`, with `middle` between: halved until the looks follow it */
static inline gough_status walk_cell(walk *a, const look *from, const look *middle, const look *to,
                                     int depth, int corner) {
    const int deep = depth >= WALK_DEPTH && a->cells >= WALK_CELLS_KINK;
    look one, three;
    gough_status status;

    walk_look(a, (from->t + middle->t) / 2, &one);
    walk_look(a, (middle->t + to->t) / 2, &three);
    walk_learn(a, &one);
    walk_learn(a, &three);
    const look *const l[5] = {from, &one, middle, &three, to};
    if (!deep && depth < WALK_DEPTH_KINK && !walk_followed(a, l)) {
        status = walk_cell(a, from, &one, middle, depth + 1, 0);
        if (status != GOUGH_OK) return status;
        return walk_cell(a, middle, &three, to, depth + 1, corner);
    }
    a->cells++;
    for (int i = 1; i < 5; i++) {
        status = walk_feed(a, l[i], i == 4 && corner);
        if (status != GOUGH_OK) return status;
    }
    return GOUGH_OK;
}

/* ---- from row to row, from corner to corner ---- */

/* the first corner of the program after t, of those in appointments.h and the rows of a recording, where its third derivatives
 * jump; INFINITY: none */
static inline real walk_corner(walk *a, real t) {
    const gough_motion *motion = a->r.motion;
    const real pace = motion->scaled ? (real)motion->frequency : 1;
    const real next = (real)appointments_corner(&a->when, (double)t);

    if (motion->kind != GOUGH_MOTION_SAMPLES) return next;
    size_t low = 0, high = motion->samples.count; /* rows before `low` are at or before t */
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if ((real)motion->samples.time[middle] / pace > t) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    return low < motion->samples.count ? (real)motion->samples.time[low] / pace : next;
}

/* the motion from a look that was fed to the time `until`, where a row may stand; `from` becomes the look there */
static inline gough_status walk_stretch(walk *a, look *from, real until, int row) {
    const real least = (real)walk_least * a->r.options->duration;

    a->cells = 0;
    while (from->t < until) {
        const real corner = walk_corner(a, from->t + least);
        real next = corner < until - least ? corner : until;
        look middle, to;
        if (a->r.traits & EXTERNAL) { /* what walk_expected() does not know: changes of the loads */
            const double most =
                appointments_step(&a->when, (double)from->t, (double)(next - from->t), 1);
            if ((real)most < (next - from->t) * (1 - (real)walk_near)) next = from->t + (real)most;
        }
        const int row_here = !(next < until), inside = !row_here;
        const int bend = inside ? !(next < corner) : corner <= until + least;
        walk_look(a, next, &to);
        walk_look(a, (from->t + to.t) / 2, &middle);
        walk_learn(a, &middle);
        walk_learn(a, &to);
        to.row = row && row_here;
        const gough_status status = walk_cell(a, from, &middle, &to, 0, bend);
        if (status != GOUGH_OK) return status;
        *from = to;
    }
    return GOUGH_OK;
}

/* rows, with looks in between; GOUGH_OK at the end of the duration */
static inline gough_status walk_all(walk *a) {
    const gough_simulation *o = a->r.options;
    const long long rows = (long long)floor(o->duration / o->output_step + 1e-9) + 1;
    gough_status status;
    signals m;
    look at;

    walk_at(a, 0, &m);
    if (a->r.fault.what) return limits_fault(&a->r, a->end);
    a->side = limits_begin(&a->r, system_wanted(&a->r, 0), &m);
    walk_look(a, 0, &at);
    walk_learn(a, &at);
    at.row = 1;
    status = walk_feed(a, &at, 0);
    for (long long row = 1; row < rows && status == GOUGH_OK; row++) {
        status = walk_stretch(a, &at, (real)row * (real)o->output_step, 1);
    }
    /* the motion goes on to the end of the duration, where it is no multiple of the step */
    if (status == GOUGH_OK && at.t < (real)o->duration * (real)(1 - 1e-9)) {
        status = walk_stretch(a, &at, (real)o->duration, 0);
    }
    return status == GOUGH_OK ? walk_finish(a) : status;
}

static inline gough_status walk_run(const simulate_parts *parts, const gough_simulation *options,
                                    gough_sink sink, void *context, gough_crossing_sink crossings,
                                    void *crossings_context, gough_end *end) {
    const system_lane lane = {parts->machine, parts->control, parts->disturbance, 0, 0};
    const real radius = (real)parts->machine->base_radius, duration = (real)options->duration;
    gough_status status;
    walk a;

    system_begin(&a.r, parts->motion, options, &lane);
    system_program_only(&a.r);
    appointments_begin(&a.when, parts->motion, NULL, parts->machine, 0, options->duration,
                       options->output_step);
    a.sink = sink;
    a.context = context;
    a.crossings = crossings;
    a.crossings_context = crossings_context;
    a.end = end;
    a.crossed = a.holding = a.corner = a.cells = 0;
    a.determinant = 0;
    a.speed = (real)walk_rest * radius / duration;
    a.swiftness = a.speed / duration;
    a.force = (real)parts->machine->load.mass * a.swiftness;
    for (int e = 0; e < MARGIN_SINGULAR; e++) a.open[e].cause = GOUGH_END_DONE;

    status = walk_all(&a);
    for (int e = 0; e < MARGIN_SINGULAR; e++) {
        if (a.open[e].cause != GOUGH_END_DONE) walk_close(&a, e, INFINITY);
    }
    if (status != GOUGH_OK) return status;
    end->time = options->duration;
    if (!a.crossed) return GOUGH_OK;
    limits_say(&a.r, a.first_margin, a.first_legs, a.first.enter, end);
    return GOUGH_ERROR_NUMERICAL;
}

#endif
