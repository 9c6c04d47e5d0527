/* One run of forward dynamics: a stepper with adaptive or fixed steps. For scalar number types; theory: docs/theory/steppers.md. */
#ifndef GOUGH_SIMULATE_DRIVE_H
#define GOUGH_SIMULATE_DRIVE_H

#include "simulate/drive_settle.h"
#include "simulate/fixed.h"

/* (step-2): a first step from the size of the rates and of their change over a small explicit step */
static inline real drive_first_step(drive *d, const real *size, real tolerance, real longest) {
    real y = 0, rate = 0, change = 0, h, other;
    number z[STATE], after[STATE];

    for (int i = 0; i < STATE; i++) {
        const real scale = tolerance * (size[i] + real_magnitude(number_first(d->y[i])));
        const real a = number_first(d->y[i]) / scale, b = number_first(d->rate[i]) / scale;
        y = y + a * a;
        rate = rate + b * b;
    }
    h = rate > (real)1e-10 && y > (real)1e-10 ? real_root(y / rate) / 100 : (real)1e-6;
    if (h > longest) h = longest;
    for (int i = 0; i < STATE; i++) z[i] = d->y[i] + number_of_real(h) * d->rate[i];
    run_rates(&d->r, d->t + h, z, after);
    for (int i = 0; i < STATE; i++) {
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
static inline void drive_look_ahead(drive *d) {
    if (d->ahead == NULL) return;
    lookahead_clear(d->ahead);
    for (int row = 1; row < DOP853_STAGES; row++) {
        lookahead_announce(d->ahead, d->t0 + dop853_c[row] * d->h);
    }
    lookahead_ready(d->ahead);
}

/* the same for fixed steps from step k on: rk4 comes to few times in a step, so several steps go together */
static inline void drive_look_far(drive *d, long long k, int part) {
    enum { TOGETHER = 5 };
    const real h = d->r.options->step;

    if (d->r.options->method == GOUGH_DOP853) drive_look_ahead(d);
    if (d->ahead == NULL || d->r.options->method != GOUGH_RK4 || k % TOGETHER != 0) return;
    if (part > 0) return;
    lookahead_clear(d->ahead);
    for (long long i = k; i < k + TOGETHER; i++) {
        const real t = (real)i * h;
        lookahead_announce(d->ahead, t + h / 2);
        lookahead_announce(d->ahead, t + h);
        lookahead_announce(d->ahead, (real)(i + 1) * h);
    }
    lookahead_ready(d->ahead);
}

/* an adaptive step that meets what is `left` up to the next corner, and steps over nothing: two nearly equal steps rather than a
 * tiny one */
static inline real drive_limited(drive *d, real wish, real left) {
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
static const double stiff_limit = 6.1;

typedef struct {
    int near, far; /* steps near the limit of stability so far, and others since */
} stiffness_watch;

/* after an accepted step, d->y and d->rate being its end */
static inline void drive_watch_stiffness(drive *d, stiffness_watch *w, const real *size) {
    gough_statistics *s = &d->statistics;
    real reach;

    if (s->stiff_rate > 0 || (w->near == 0 && s->steps % STIFF_EVERY != 0)) return;
    reach = dop853_stiffness(d->dense, STATE, d->h, d->y0, d->y, d->rate, size);
    if (!(reach > (real)stiff_limit)) {
        if (++w->far == STIFF_OTHERS) *w = (stiffness_watch){0, 0};
        return;
    }
    w->far = 0;
    if (++w->near < STIFF_STEPS) return;
    s->stiff_rate = (double)(reach / d->h);
    s->stiff_time = (double)d->t;
}

/* adaptive dop853 */
static inline gough_status drive_adaptive(drive *d) {
    const gough_machine *machine = d->r.lane[0].machine;
    const real tolerance = d->r.options->tolerance, duration = d->r.options->duration;
    const real length = machine->base_radius, gravity = machine->gravity_magnitude;
    const real unit = gravity > 0 ? real_root(length / gravity) : 1;
    real size[STATE], wish;
    dop853 work;
    stiffness_watch watch = {0, 0};
    int rejected = 0;
    long long steps = 0;

    for (int i = 0; i < COORDINATES; i++) {
        size[i] = i < 3 ? length : 1;
        size[COORDINATES + i] = size[i] / unit;
    }
    d->dense = &work;
    run_rates(&d->r, 0, d->y, d->rate);
    wish = drive_first_step(d, size, tolerance, duration);
    while (d->t < duration) {
        const real corner = (real)appointments_corner(&d->when, (double)d->t);
        const real stop = corner < duration ? corner : duration, left = stop - d->t;
        real error, factor, step;

        if (wish < 16 * REAL_EPSILON * (d->t > unit ? d->t : unit)) return drive_stuck(d, unit);
        if (steps++ == drive_most_steps) return drive_stiff(d);
        step = drive_limited(d, wish, left);
        for (int i = 0; i < STATE; i++) {
            d->y0[i] = d->y[i];
            d->rate0[i] = work.slope[0][i] = d->rate[i];
        }
        d->t0 = d->t;
        d->h = step;
        d->prepared = 0;
        drive_look_ahead(d);
        dop853_step(&work, run_rates, &d->r, STATE, d->t0, step, d->y0, d->raw);
        error = dop853_error(&work, STATE, step, d->y0, d->raw, size, tolerance);
        factor = dop853_factor(error);
        if (!(error <= 1)) {
            wish = step * (factor < 1 ? factor : 1);
            rejected = 1;
            d->statistics.rejected++;
            continue;
        }
        d->r.fault.what = NULL;
        d->t = step < left ? d->t0 + step : stop;
        const gough_status status = drive_accept(d, 1);
        if (status != GOUGH_OK) return status;
        drive_watch_stiffness(d, &watch, size);
        /* a step cut short says nothing against a longer one */
        const real next = step * (rejected && factor > 1 ? 1 : factor);
        if (!(step < wish) || factor < 1 || next > wish) wish = next;
        rejected = 0;
    }
    return GOUGH_OK;
}

/* steps of dop853 and rk4 of a given length */
static inline void drive_explicit_step(drive *d, dop853 *work) {
    if (d->r.options->method == GOUGH_RK4) {
        rk4_step(run_rates, &d->r, STATE, d->t0, d->h, d->y0, d->rate0, d->raw);
        return;
    }
    for (int i = 0; i < STATE; i++) work->slope[0][i] = d->rate0[i];
    dop853_step(work, run_rates, &d->r, STATE, d->t0, d->h, d->y0, d->raw);
}

/* rattle: the state goes on as velocities, and is read out as rates of the triad */
static inline void drive_rattle_read(const rattle_state *s, number *y) {
    const coordinates rate = {s->velocity, triad_rate(&s->x.q, out_of(&s->x.q, s->omega))};

    coordinates_store(&s->x, y);
    coordinates_store(&rate, y + COORDINATES);
}

/* The next part of fixed step k: from d->t0, as long as d->h, to d->t1. A step is made in one part where no corner lies in it and
 * nothing is stepped over. 0 where the step is complete. */
static inline int drive_part(drive *d, long long k, int part) {
    const real h = d->r.options->step;
    const int cut = fixed_is_short(k, (double)h, d->r.options->duration);
    const real end = cut ? (real)d->r.options->duration : (real)(k + 1) * h;

    if (part > 0 && !(d->t < end)) return 0;
    d->t0 = part == 0 ? (real)k * h : d->t;
    const double to = appointments_part(&d->when, (double)d->t0, (double)end, (double)h);
    d->t1 = to < (double)end ? (real)to : end;
    d->h = part == 0 && !cut && !(to < (double)end) ? h : d->t1 - d->t0;
    return 1;
}

static inline gough_status drive_fixed(drive *d) {
    const gough_simulation *o = d->r.options;
    const int rattling = o->method >= GOUGH_RATTLE2;
    const long long steps = fixed_steps(o->duration, o->step);
    const rattle method = {&d->r.h.load, run_wrench, &d->r, d->r.damped};
    rattle_state state;
    dop853 work;

    if (rattling) {
        const coordinates rate = coordinates_load(d->y + COORDINATES);
        state.x = coordinates_load(d->y);
        state.velocity = rate.rho;
        state.omega = onto(&state.x.q, triad_angular_velocity(&state.x.q, &rate.q));
        rattle_begin(&method, 0, &state);
    }
    run_rates(&d->r, 0, d->y, d->rate);
    for (long long k = 0; k < steps; k++) {
        for (int part = 0; drive_part(d, k, part); part++) {
            for (int i = 0; i < STATE; i++) d->y0[i] = d->y[i], d->rate0[i] = d->rate[i];
            if (rattling) {
                const real residual = rattle_compose(&method, (int)o->method - (int)GOUGH_RATTLE2,
                                                     d->t0, d->h, &state);
                drive_rattle_read(&state, d->raw);
                const gough_status converged = drive_converged(d, residual);
                if (converged != GOUGH_OK) return converged;
            } else {
                drive_look_far(d, k, part);
                drive_explicit_step(d, &work);
            }
            d->t = d->t1;
            const gough_status status = drive_accept(d, 0);
            if (status != GOUGH_OK) return status;
        }
    }
    return GOUGH_OK;
}

/* a run that is ready to begin */
static inline void drive_open(drive *d, const simulate_parts *parts,
                              const gough_simulation *options, gough_sink sink, void *context,
                              gough_end *end) {
    const run_lane lane = {parts->machine, parts->control, parts->disturbance, parts->number};

    run_begin(&d->r, parts->motion, options, &lane);
    d->initial = parts->initial;
    d->sink = sink;
    d->context = context;
    d->end = end;
    d->rows = (long long)floor(options->duration / options->output_step + 1e-9) + 1;
    d->dense = NULL;
    d->prepared = 0;
    d->ahead = NULL;
    d->statistics = (gough_statistics){.steps = 0};
    appointments_begin(&d->when, parts->motion, parts->disturbance, 0, options->duration,
                       options->output_step);
}

static inline gough_status drive_run(const simulate_parts *parts, const gough_simulation *options,
                                     gough_sink sink, void *context, gough_end *end) {
    gough_status status;
    lookahead ahead;
    drive d;

    drive_open(&d, parts, options, sink, context, end);
    d.ahead = &ahead;
    lookahead_begin(d.ahead, &d.r);
    drive_start(&d);
    status = drive_begin(&d);
    if (status == GOUGH_OK) {
        status = options->method == GOUGH_DOP853 && !(options->step > 0) ? drive_adaptive(&d)
                                                                         : drive_fixed(&d);
    }
    if (status == GOUGH_OK) end->time = options->duration;
    d.statistics.evaluations = d.r.evaluations;
    if (options->statistics) *options->statistics = d.statistics;
    return status;
}

#endif
