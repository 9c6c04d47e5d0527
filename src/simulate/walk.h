/* Inverse dynamics along the program: rows at the output times, every crossing of a limit found, the end at a singular pose.
 * For scalar number types. */
#ifndef GOUGH_SIMULATE_WALK_H
#define GOUGH_SIMULATE_WALK_H

#include "simulate/ends.h"
#include "simulate/row.h"

/* looks at the limits between two rows */
enum { WALK_LOOKS = 8, WALK_HALVINGS = 64 };

typedef struct {
    run r;
    gough_sink sink;
    gough_crossing_sink crossings;
    void *context, *crossings_context;
    gough_end *end;
    limits_side side;
    gough_crossing open[MARGIN_POSE]; /* limits that are left now; leg 0: none */
    int crossed;                      /* some limit was left: `first` is the earliest */
    gough_crossing first;
    unsigned first_legs; /* all legs at that limit then: bit v for leg v + 1 */
} walk;

/* the program as an instant: its forces are what the legs give */
static inline void walk_at(walk *a, real t, instant *m) {
    const stage *s = run_stage(&a->r, t);

    m->x = s->x[0];
    m->rate = s->x[1];
    m->acceleration = s->x[2];
    m->g = s->program;
    for (int v = 0; v < LEGS; v++) m->u[v] = s->force[v];
}

static inline void walk_margins(walk *a, real t, instant *m, real margin[MARGINS]) {
    walk_at(a, t, m);
    limits_margins(&a->r, run_stage(&a->r, t), m, limits_pose(&a->r, m).determinant, &a->side,
                   margin);
}

/* when margin e passes its end between `low` and `high`, which differ in it */
static inline real walk_root(walk *a, int e, real low, real high, int broken_at_low) {
    real margin[MARGINS];
    instant m;

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

/* what the limit of margin e is about */
static inline double walk_quantity(const instant *m, int e) {
    const int v = e % LEGS;

    if (e >= MARGIN_FORCE) return (double)m->u[v];
    return (double)(e >= MARGIN_SPEED ? m->g.rate[v] : m->g.length[v]);
}

static inline int walk_worse(int e, double value, double than) {
    if (e < MARGIN_LONG) return value < than;
    return e < MARGIN_SPEED ? value > than : fabs(value) > fabs(than);
}

static inline void walk_close(walk *a, int e, double leave) {
    a->open[e].leave = leave;
    if (a->crossings) a->crossings(a->crossings_context, &a->open[e]);
    a->open[e].leg = 0;
}

static inline void walk_open(walk *a, int e, double enter, double value) {
    real margin[MARGINS];
    instant m;

    a->open[e] = (gough_crossing){.cause = limits_cause(&a->r, e),
                                  .leg = e % LEGS + 1,
                                  .enter = enter,
                                  .leave = INFINITY,
                                  .worst = value,
                                  .worst_time = enter};
    if (a->crossed && !(enter < a->first.enter)) return;
    a->first = a->open[e];
    walk_margins(a, (real)enter, &m, margin);
    a->first_legs = limits_together_at(margin, e);
    a->crossed = 1;
}

/* one look at the legs' limits at t, the look before having been at `before` */
static inline void walk_look(walk *a, real before, real t, const instant *m,
                             const real margin[MARGINS]) {
    for (int e = 0; e < MARGIN_POSE; e++) {
        const int broken = !(margin[e] >= 0), was = a->open[e].leg != 0;
        const double value = walk_quantity(m, e);

        if (broken && !was) {
            const double enter = (double)(t > before ? walk_root(a, e, before, t, 0) : t);
            walk_open(a, e, enter, value);
        }
        if (!broken && was) walk_close(a, e, (double)walk_root(a, e, before, t, 1));
        if (broken && walk_worse(e, value, a->open[e].worst)) {
            a->open[e].worst = value;
            a->open[e].worst_time = (double)t;
        }
    }
}

/* when the pose becomes nearly singular between `low` and `high` */
static inline real walk_near_root(walk *a, real low, real high) {
    instant m;

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

/* singular, no length, not finite at t: what `forces` cannot go past */
static inline gough_status walk_hard(walk *a, real before, real t, const instant *m,
                                     const real margin[MARGINS]) {
    const elimination e = limits_pose(&a->r, m);
    const double nothing = leg_no_length * a->r.lane[0].machine->base_radius;

    if (a->r.fault.what) return limits_fault(&a->r, a->end);
    for (int v = 0; v < LEGS; v++) {
        if (!(m->g.length[v] > (real)nothing)) {
            limits_say(&a->r, GOUGH_END_LEG_NO_LENGTH, 1u << v, (double)t, a->end);
            return GOUGH_ERROR_NUMERICAL;
        }
    }
    if (!(margin[MARGIN_POSE] >= 0)) {
        const real root = t > before ? walk_root(a, MARGIN_POSE, before, t, 0) : t;
        limits_say_singular(1, (double)root, a->end);
        return GOUGH_ERROR_NUMERICAL;
    }
    if (limits_nearly_singular(&a->r, t, m, &e)) {
        limits_say_singular(1, (double)(t > before ? walk_near_root(a, before, t) : t), a->end);
        return GOUGH_ERROR_NUMERICAL;
    }
    return GOUGH_OK;
}

static inline gough_status walk_row(walk *a, real t) {
    real value[GOUGH_COLUMNS];
    instant m;

    walk_at(a, t, &m);
    row_fill(&a->r, run_stage(&a->r, t), t, &m, 0, 0, value);
    if (!(value[GOUGH_CONDITION] <= (real)greatest_condition) || !row_finite(&a->r, 0, value)) {
        limits_say_singular(1, (double)t, a->end);
        return GOUGH_ERROR_NUMERICAL;
    }
    if (row_send(value, a->sink, a->context)) {
        limits_no_leg(a->end, GOUGH_END_STOPPED, (double)t);
        end_say(a->end, "the run was stopped at t = %.9g", (double)t);
        return GOUGH_ERROR_NUMERICAL;
    }
    return GOUGH_OK;
}

/* rows, with looks in between; GOUGH_OK at the end of the duration */
static inline gough_status walk_looks(walk *a) {
    const gough_simulation *o = a->r.options;
    const long long rows = (long long)floor(o->duration / o->output_step + 1e-9) + 1;
    real margin[MARGINS], before = 0;
    gough_status status;
    instant m;

    walk_at(a, 0, &m);
    if (a->r.fault.what) return limits_fault(&a->r, a->end);
    a->side = limits_begin(&a->r, run_stage(&a->r, 0), &m);
    for (long long look = 0; look <= (rows - 1) * WALK_LOOKS; look++) {
        const long long row = look / WALK_LOOKS, part = look % WALK_LOOKS;
        const real t = ((real)row + (real)part / (real)WALK_LOOKS) * (real)o->output_step;

        walk_margins(a, t, &m, margin);
        status = walk_hard(a, before, t, &m, margin);
        if (status != GOUGH_OK) return status;
        walk_look(a, before, t, &m, margin);
        if (part == 0) {
            status = walk_row(a, t);
            if (status != GOUGH_OK) return status;
        }
        before = t;
    }
    return GOUGH_OK;
}

static inline gough_status walk_run(const gough_model *model, const gough_simulation *options,
                                    gough_sink sink, void *context, gough_crossing_sink crossings,
                                    void *crossings_context, gough_end *end) {
    const run_lane lane = {&model->machine, &model->control, &model->disturbance, 0};
    gough_status status;
    walk a;

    run_begin(&a.r, &model->motion, options, &lane);
    run_program_only(&a.r);
    a.sink = sink;
    a.context = context;
    a.crossings = crossings;
    a.crossings_context = crossings_context;
    a.end = end;
    a.crossed = 0;
    for (int e = 0; e < MARGIN_POSE; e++) a.open[e].leg = 0;

    status = walk_looks(&a);
    for (int e = 0; e < MARGIN_POSE; e++) {
        if (a.open[e].leg) walk_close(&a, e, INFINITY);
    }
    if (status != GOUGH_OK) return status;
    end->time = options->duration;
    if (!a.crossed) return GOUGH_OK;
    limits_say(&a.r, a.first.cause, a.first_legs, a.first.enter, end);
    return GOUGH_ERROR_NUMERICAL;
}

#endif
