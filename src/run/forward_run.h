/* One run of forward dynamics: a stepper with adaptive or fixed steps. For scalar number types; theory: docs/theory/steppers.md. */
#ifndef GOUGH_RUN_FORWARD_RUN_H
#define GOUGH_RUN_FORWARD_RUN_H

#include "run/forward_settle.h"

/* (step-2): a first step from the size of the rates and of their change over a small explicit step */
static inline real forward_first_step(forward *d, const real *size, real tolerance, real longest) {
    const int n = d->r.states;
    real y = 0, rate = 0, change = 0, h, other;
    number z[STATE_SIZE], after[STATE_SIZE];

    STEPPER_SOME(n);
    for (int i = 0; i < n; i++) {
        const real scale = tolerance * (size[i] + real_magnitude(number_first(d->y[i])));
        const real a = number_first(d->y[i]) / scale, b = number_first(d->rate[i]) / scale;
        y = y + a * a;
        rate = rate + b * b;
    }
    h = rate > (real)1e-10 && y > (real)1e-10 ? real_root(y / rate) / 100 : (real)1e-6;
    if (h > longest) h = longest;
    for (int i = 0; i < n; i++) z[i] = d->y[i] + number_of_real(h) * d->rate[i];
    system_rates(&d->r, d->t + h, z, after);
    for (int i = 0; i < n; i++) {
        const real scale = tolerance * (size[i] + real_magnitude(number_first(d->y[i])));
        const real c = number_first(after[i] - d->rate[i]) / scale;
        change = change + c * c;
    }
    change = real_root(change) / h;
    rate = real_root(rate);
    other = change > rate ? change : rate;
    other = other > (real)1e-15 ? real_pow((real)0.01 / other, (real)1 / 8) : (real)1e-3;
    d->r.fault.what = NULL; /* what a trial met is not the run's fault */
    if (other > 100 * h) other = 100 * h;
    return other > longest || !real_finite(other) ? longest : other;
}

/* makes the stages of the step from t0 ready */
static inline void forward_prefetch(forward *d) {
    if (d->prefetched == NULL) return;
    prefetched_clear(d->prefetched, 0);
    for (int row = 1; row < DOP853_STAGES; row++) {
        prefetched_announce(d->prefetched, d->m.t0 + dop853_c[row] * d->m.h);
    }
    prefetched_ready(d->prefetched);
}

/* the same for fixed steps from step k on: rk4 comes to few times in a step, so several steps go together */
static inline void forward_look_far(forward *d, long long k, int part) {
    enum { TOGETHER = 5 };
    const real h = d->r.options->step;

    if (d->r.options->method == GOUGH_DOP853) forward_prefetch(d);
    if (d->prefetched == NULL || d->r.options->method != GOUGH_RK4 || k % TOGETHER != 0) return;
    if (part > 0) return;
    prefetched_clear(d->prefetched, 0);
    for (long long i = k; i < k + TOGETHER; i++) {
        const real t = (real)i * h;
        prefetched_announce(d->prefetched, t + h / 2);
        prefetched_announce(d->prefetched, t + h);
        prefetched_announce(d->prefetched, (real)(i + 1) * h);
    }
    prefetched_ready(d->prefetched);
}

/* an adaptive step that meets what is `left` up to the next corner, and steps over nothing: two nearly equal steps rather than a
 * tiny one */
static inline real forward_limited(forward *d, real wish, real left) {
    const double longest = d->r.options->max_step;
    real step = wish;

    if (longest > 0 && (real)longest < step) step = (real)longest;
    const double most = appointments_step(&d->when, (double)d->t, (double)step, 1);
    if (most < (double)step) step = (real)most;
    if (step > left * (real)0.999999) return left;
    return step > left / 2 ? left / 2 : step;
}

/* (step-8): a step is compared with the stability of the method so often, or always while that is near; so many such steps, with no
 * more than a few others between them, are a stiff loop */
enum { STIFF_EVERY = 100, STIFF_STEPS = 15, STIFF_OTHERS = 6 };
/* no accepted step is much over the limit: a larger quotient is noise */
static const double stiff_limit = 6.1, stiff_most = 8;

typedef struct {
    int near, far; /* steps near the limit of stability so far, and others since */
} stiffness_watch;

/* after an accepted step, d->y and d->rate being its end */
static inline void forward_watch_stiffness(forward *d, stiffness_watch *w, const real *size) {
    gough_statistics *s = &d->statistics;
    real reach;

    if (!(d->r.traits & NEEDS_RATES)) return; /* nothing decays */
    if (s->stiff_rate > 0 || (w->near == 0 && s->steps % STIFF_EVERY != 0)) return;
    reach = dop853_stiffness(d->dense, d->r.states, d->m.h, d->y0, d->y, d->rate, size);
    if (!(reach > (real)stiff_limit && reach < (real)stiff_most)) {
        if (++w->far == STIFF_OTHERS) *w = (stiffness_watch){0, 0};
        return;
    }
    w->far = 0;
    if (++w->near < STIFF_STEPS) return;
    s->stiff_rate = (double)(reach / d->m.h);
    s->stiff_time = (double)d->t;
}

/* ---- one step ---- */

/* rattle: the state goes on as velocities, and is read out as rates of the triad */
static inline void forward_rattle_read(const rattle_state *s, number *y) {
    const coordinates rate = {s->velocity, triad_rate(&s->x.q, out_of(&s->x.q, s->omega))};

    coordinates_store(&s->x, y);
    coordinates_store(&rate, y + COORDINATES);
}

/* makes the part of a step whose times are set, up to d->raw; returns what an implicit step leaves of its equation */
static inline number forward_go(forward *d, dop853 *work, rattle_state *carried) {
    const march_problem problem = system_problem(&d->r);

    for (int i = 0; i < d->r.states; i++) d->y0[i] = d->y[i], d->rate0[i] = d->rate[i];
    const number residual = march_step(&d->m, &problem, work, carried, d->y0, d->rate0, d->raw);
    if (d->m.method >= MARCH_RATTLE) forward_rattle_read(carried, d->raw);
    return residual;
}

/* ---- adaptive steps ---- */

/* dop853 with steps of its own choice */
typedef struct {
    forward *d;
    dop853 work;
    rattle_state unused; /* by this method */
    stiffness_watch watch;
    real size[STATE_SIZE], unit; /* of the state's numbers; the unit of time */
    real stop;                   /* no step goes beyond */
    long long steps;
    gough_status status; /* why the loop ends */
} adaptation;

/* the next step; 0 at the end, and where no step will do */
static inline real forward_length(void *context, real wish, int rejected) {
    adaptation *a = context;
    forward *d = a->d;
    const real duration = d->r.options->duration;

    if (!(d->t < duration)) return 0;
    real corner = (real)appointments_corner(&d->when, (double)d->t);
    if (d->r.traits & SAMPLED && sample_clock_next(&d->loop.clock) < corner)
        corner = sample_clock_next(&d->loop.clock);
    d->statistics.rejected += rejected;
    a->stop = corner < duration ? corner : duration;
    if (wish < 16 * REAL_EPSILON * (d->t > a->unit ? d->t : a->unit)) {
        a->status = forward_stuck(d, a->unit);
        return 0;
    }
    if (a->steps++ == forward_most_steps) {
        a->status = forward_stiff(d);
        return 0;
    }
    return forward_limited(d, wish, a->stop - d->t);
}

static inline real forward_attempt(void *context, real length) {
    adaptation *a = context;
    forward *d = a->d;

    d->m.t0 = d->t;
    d->m.h = length;
    d->prepared = 0;
    forward_prefetch(d);
    (void)forward_go(d, &a->work, &a->unused);
    return dop853_error(&a->work, d->r.states, length, d->y0, d->raw, a->size,
                        d->r.options->tolerance);
}

static inline int forward_keep(void *context) {
    adaptation *a = context;
    forward *d = a->d;

    d->r.fault.what = NULL; /* what a trial met is not the run's fault */
    d->t = d->m.h < a->stop - d->m.t0 ? d->m.t0 + d->m.h : a->stop;
    a->status = forward_accept(d, 1);
    if (a->status == GOUGH_OK) forward_watch_stiffness(d, &a->watch, a->size);
    return a->status != GOUGH_OK;
}

static inline gough_status forward_adaptive(forward *d) {
    static const march_rules rules = {forward_length, forward_attempt, forward_keep};
    const gough_machine *machine = d->r.lane[0].machine;
    const real length = machine->base_radius, gravity = machine->gravity_magnitude;
    adaptation a;
    real wish;

    a.d = d;
    a.unit = gravity > 0 ? real_root(length / gravity) : 1;
    a.watch = (stiffness_watch){0, 0};
    a.steps = 0;
    a.status = GOUGH_OK;
    for (int i = 0; i < COORDINATES; i++) {
        a.size[i] = i < 3 ? length : 1;
        a.size[COORDINATES + i] = a.size[i] / a.unit;
    }
    for (int i = MOTION; i < d->r.states; i++) {
        const int rates = d->r.traits & SECOND_ORDER && i >= MOTION + LEGS && i < d->r.sum.at;
        a.size[i] = (real)machine->load.mass * length / (a.unit * a.unit * (rates ? a.unit : 1));
    }
    d->dense = &a.work;
    d->m.method = MARCH_DOP853;
    system_rates(&d->r, 0, d->y, d->rate);
    wish = forward_first_step(d, a.size, d->r.options->tolerance, d->r.options->duration);
    march_adaptive(&rules, &a, &wish);
    return a.status;
}

/* ---- fixed steps ---- */

/* what a loop of fixed steps works with */
typedef struct {
    forward *d;
    dop853 work;
    rattle_state body;
    gough_status status; /* why the loop ends */
} fixed_loop;

/* one part of fixed step k */
static inline int forward_move(void *context, long long k, int part) {
    fixed_loop *f = context;
    forward *d = f->d;

    forward_look_far(d, k, part);
    const number residual = forward_go(d, &f->work, &f->body);
    if (d->m.method >= MARCH_RATTLE) f->status = forward_converged(d, residual);
    if (f->status != GOUGH_OK) return 1;
    d->t = d->m.t1;
    f->status = forward_accept(d, 0);
    if (d->renewed && f->status == GOUGH_OK && d->m.method >= MARCH_RATTLE) {
        const march_problem problem = system_problem(&d->r);
        rattle_begin(&problem.rule, d->t, &f->body);
    }
    return f->status != GOUGH_OK;
}

static inline gough_status forward_fixed(forward *d) {
    const gough_simulation *o = d->r.options;
    const march_problem problem = system_problem(&d->r);
    fixed_loop f;

    f.d = d;
    f.status = GOUGH_OK;
    if (d->m.method >= MARCH_RATTLE) {
        const coordinates rate = coordinates_load(d->y + COORDINATES);
        f.body.x = coordinates_load(d->y);
        f.body.velocity = rate.rho;
        f.body.omega = onto(&f.body.x.q, triad_angular_velocity(&f.body.x.q, &rate.q));
        rattle_begin(&problem.rule, 0, &f.body);
    }
    system_rates(&d->r, 0, d->y, d->rate);
    (void)march_fixed(&d->m, 0, fixed_steps(o->duration, o->step), forward_move, &f);
    return f.status;
}

/* a run that is ready to begin */
static inline void forward_open(forward *d, const simulate_parts *parts,
                                const gough_simulation *options, gough_sink sink, void *context,
                                gough_end *end) {
    const system_lane lane = {parts->machine, parts->control, parts->disturbance, parts->number,
                              parts->samples};

    system_begin(&d->r, parts->motion, options, &lane);
    d->initial = parts->initial;
    d->sink = sink;
    d->context = context;
    d->end = end;
    d->rows = (long long)floor(options->duration / options->output_step + 1e-9) + 1;
    d->dense = NULL;
    d->prepared = d->renewed = 0;
    d->prefetched = NULL;
    d->m = system_march(options, &d->when);
    d->statistics = (gough_statistics){.steps = 0};
    appointments_begin(&d->when, parts->motion, parts->disturbance, parts->machine, 0,
                       options->duration, options->output_step);
}

static inline gough_status forward_run(const simulate_parts *parts, const gough_simulation *options,
                                       gough_sink sink, void *context, gough_end *end) {
    gough_status status;
    prefetched stages;
    forward d;

    forward_open(&d, parts, options, sink, context, end);
    if (!(d.r.share && d.r.traits & APART)) { /* blocks have one force of each leg */
        d.prefetched = &stages;
        prefetched_begin(d.prefetched, &d.r);
    }
    forward_start(&d);
    status = forward_begin(&d);
    if (status == GOUGH_OK) {
        status = options->method == GOUGH_DOP853 && !(options->step > 0) ? forward_adaptive(&d)
                                                                         : forward_fixed(&d);
    }
    if (status == GOUGH_OK) end->time = options->duration;
    d.statistics.evaluations = d.r.evaluations;
    if (options->statistics) *options->statistics = d.statistics;
    return status;
}

#endif
