/* One run of forward dynamics: a stepper, the constraints kept, rows at the output times, the end found. For scalar number
 * types; theory: docs/theory/steppers.md. */
#ifndef GOUGH_SIMULATE_DRIVE_H
#define GOUGH_SIMULATE_DRIVE_H

#include "integrate/dop853.h"
#include "integrate/rk4.h"
#include "model/appointments.h"
#include "simulate/ends.h"
#include "simulate/lookahead.h"
#include "simulate/row.h"
#include "simulate/simulate.h"

/* halvings of a bracket around an end: to round-off of the step */
enum { DRIVE_HALVINGS = 64 };

typedef struct {
    run r;
    const gough_initial *initial;
    gough_sink sink;
    void *context;
    gough_end *end;
    limits_side side;
    long long row;   /* the next */
    long long rows;  /* number of rows */
    real drift;      /* since the row before */
    number y[STATE]; /* at t, constraints kept */
    real t;

    /* the step that is being looked at: from (t0, y0) to (t0 + h, y1), their rates, and the dense output if any */
    real t0, h, t1; /* t1: its end, where it is known before */
    number y0[STATE], rate0[STATE], raw[STATE], rate[STATE];
    dop853 *dense;
    int prepared;
    lookahead *ahead;  /* stages made ready, or NULL */
    appointments when; /* times that no step may pass */

    /* the end of the step, and how far from trouble its beginning was */
    instant now;
    number length[LEGS], speed[LEGS];
    real pose, program;
} drive;

/* adaptive steps that a run may take: some minutes of work */
static const long long drive_most_steps = 20000000;

/* determinants that change by less than an eighth of themselves in a step do not pass zero within it */
static const double drive_ease = 8;

static inline void drive_project(const drive *d, number *y) {
    coordinates x, rate;

    if (d->r.options->constraints != GOUGH_PROJECTION) return;
    x = coordinates_load(y);
    rate = coordinates_load(y + COORDINATES);
    coordinates_project(&x, &rate);
    coordinates_store(&x, y);
    coordinates_store(&rate, y + COORDINATES);
}

static inline void drive_note_drift(drive *d, const number *y) {
    const coordinates x = coordinates_load(y);
    const real violation = triad_violation(&x.q);

    if (!(violation <= d->drift)) d->drift = violation;
}

/* (x, ρ̇, ω) at the beginning: the program's, or what the study gives */
static inline void drive_start(drive *d) {
    const gough_initial *initial = d->initial;
    const gough_motion *motion = d->r.motion;
    const hexapod *h = &d->r.h;
    const vector about = vector_of(motion->about);
    jet component[GOUGH_COMPONENTS];
    coordinates x[3], rate;
    vector velocity, omega;

    motion_components(motion, 0, component);
    coordinates_of_motion(h, d->r.height, motion->about, component, x);
    velocity = (vector){component[0].d, component[1].d, component[2].d};
    omega = triad_angular_velocity(&x[0].q, &x[1].q);
    if (initial->velocity_given) velocity = vector_of(initial->velocity);
    if (initial->angular_velocity_given) omega = vector_of(initial->angular_velocity);

    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        if (initial->given[c]) component[c] = jet_constant(initial->component[c]);
    }
    coordinates_of_motion(h, d->r.height, motion->about, component, x);
    const vector arm = out_of(&x[0].q, onto(&h->axes, subtract(h->center, about)));
    rate = (coordinates){add(velocity, cross(omega, arm)), triad_rate(&x[0].q, omega)};
    coordinates_project(&x[0], &rate);
    coordinates_store(&x[0], d->y);
    coordinates_store(&rate, d->y + COORDINATES);
}

/* GOUGH_ERROR_NUMERICAL with the end said */
static inline gough_status drive_stop(drive *d, gough_cause cause, real t, const char *sentence) {
    limits_no_leg(d->end, cause, (double)t);
    end_say(d->end, "%s at t = %.9g", sentence, (double)t);
    return GOUGH_ERROR_NUMERICAL;
}

/* takes a moment between rows into the summary, if one is wanted */
static inline void drive_look(drive *d, real t, const number *y) {
    gough_summary *summary = d->r.options->summary;
    real value[GOUGH_COLUMNS];
    instant m;

    if (summary == NULL) return;
    const stage *s = run_whole_stage(&d->r, t);
    run_instant(&d->r, t, y, &m);
    row_fill(&d->r, s, t, &m, 1, d->drift, value);
    if (row_finite(&d->r, 1, value)) row_sum(value, summary, d->r.lane[0].machine, 0);
}

/* sends the row that is due, from a state; GOUGH_OK to go on */
static inline gough_status drive_row(drive *d, const number *y) {
    const real t = (real)d->row * (real)d->r.options->output_step;
    const stage *s = run_whole_stage(&d->r, t);
    real value[GOUGH_COLUMNS];
    instant m;

    run_instant(&d->r, t, y, &m);
    if (d->r.fault.what) return limits_fault(&d->r, d->end);
    row_fill(&d->r, s, t, &m, 1, d->drift, value);
    if (!(value[GOUGH_CONDITION] <= (real)greatest_condition)) {
        limits_say_singular(0, (double)t, d->end);
        return GOUGH_ERROR_NUMERICAL;
    }
    if (!row_finite(&d->r, 1, value)) {
        return drive_stop(d, GOUGH_END_NOT_FINITE, t, "the motion ceases to be finite");
    }
    if (d->r.options->summary) row_sum(value, d->r.options->summary, d->r.lane[0].machine, 1);
    d->row++;
    d->drift = 0;
    if (row_send(value, d->sink, d->context)) {
        return drive_stop(d, GOUGH_END_STOPPED, t, "the run was stopped");
    }
    return GOUGH_OK;
}

/* the state inside the step */
static inline void drive_inside(const drive *d, real theta, number *y) {
    if (d->prepared) {
        dop853_dense(d->dense, STATE, theta, y);
    } else {
        interpolate_cubic(STATE, d->h, theta, d->y0, d->rate0, d->y, d->rate, y);
    }
    drive_project(d, y);
}

/* the margins at a point of the step; e: of the pose at its end. Returns the first that is gone, or -1. */
static inline int drive_broken(drive *d, real theta, const elimination *e, real margin[MARGINS]) {
    const real t = d->t0 + theta * d->h;
    number y[STATE];
    instant m;

    if (!(theta < 1)) {
        limits_margins(&d->r, run_stage(&d->r, d->t), &d->now, e->determinant, &d->side, margin);
        return limits_broken(margin, 0, MARGINS);
    }
    drive_inside(d, theta, y);
    run_instant(&d->r, t, y, &m);
    limits_margins(&d->r, run_stage(&d->r, t), &m, limits_pose(&d->r, &m).determinant, &d->side,
                   margin);
    return limits_broken(margin, 0, MARGINS);
}

/* makes the dense output of the step, once */
static inline void drive_prepare(drive *d) {
    if (d->dense == NULL || d->prepared) return;
    dop853_prepare(d->dense, run_rates, &d->r, STATE, d->t0, d->h, d->y0, d->raw);
    d->prepared = 1;
}

/* keeps what the next step is compared with */
static inline void drive_remember(drive *d, const elimination *e) {
    for (int v = 0; v < LEGS; v++) {
        d->length[v] = d->now.g.length[v];
        d->speed[v] = real_magnitude(d->now.g.rate[v]);
    }
    d->pose = e->determinant;
    d->program = run_stage(&d->r, d->t)->singularity.determinant;
}

/* Whether nothing can have happened within the step that is not seen at its ends: no limits of speed or force, lengths further
 * from their limits than the legs can go in a step, determinants far from zero */
static inline int drive_comfortable(const drive *d, real program, const elimination *e) {
    const real pose = e->determinant, ease = (real)drive_ease;

    if (d->r.limited[1] || d->r.limited[2]) return 0;
    for (int v = 0; v < LEGS; v++) {
        const real after = real_magnitude(d->now.g.rate[v]), before = d->speed[v];
        const real way = d->h * (after > before ? after : before);
        const real one = d->length[v], two = d->now.g.length[v];
        if (!(((one < two ? one : two) - way) * d->r.least > 1)) return 0;
        if (!(((one < two ? two : one) + way) * d->r.most < 1)) return 0;
    }
    return real_magnitude(pose) > ease * real_magnitude(pose - d->pose) &&
           real_magnitude(program) > ease * real_magnitude(program - d->program);
}

/* Whether the step breaks a limit: at its end, and for long steps at quarters too unless that cannot be. Sets the end. *until is
 * where the valid part of the step ends. */
static inline gough_status drive_watch(drive *d, int inside, real *until) {
    const stage *s = run_stage(&d->r, d->t);
    const elimination e = limits_pose(&d->r, &d->now);
    const int quarters = inside && !drive_comfortable(d, s->singularity.determinant, &e);
    real low = 0, high = 0, margin[MARGINS], there[MARGINS];
    int broken = -1;

    *until = d->t;
    for (int quarter = quarters ? 1 : 4; quarter <= 4 && broken < 0; quarter++) {
        low = high;
        high = (real)quarter / 4;
        broken = drive_broken(d, high, &e, margin);
    }
    if (broken >= 0) {
        drive_prepare(d);
        for (int i = 0; i < DRIVE_HALVINGS; i++) {
            const real middle = (low + high) / 2;
            const int gone = drive_broken(d, middle, &e, there);
            if (gone >= 0) {
                broken = gone;
                memcpy(margin, there, sizeof margin);
                high = middle;
            } else {
                low = middle;
            }
        }
        *until = d->t0 + high * d->h;
        limits_end(&d->r, margin, broken, *until, d->end);
        return GOUGH_ERROR_NUMERICAL;
    }
    drive_remember(d, &e);
    if (limits_nearly_singular(&d->r, d->t, &d->now, &e)) {
        limits_say_singular(0, (double)d->t, d->end);
        return GOUGH_ERROR_NUMERICAL;
    }
    return GOUGH_OK;
}

/* first row, and the limits at the beginning */
static inline gough_status drive_begin(drive *d) {
    gough_status status;
    real margin[MARGINS];
    elimination e;
    int broken;

    d->t = 0;
    d->row = 0;
    d->drift = 0;
    drive_note_drift(d, d->y);
    run_instant(&d->r, 0, d->y, &d->now);
    if (d->r.fault.what) return limits_fault(&d->r, d->end);
    d->side = limits_begin(&d->r, run_stage(&d->r, 0), &d->now);
    e = limits_pose(&d->r, &d->now);
    drive_remember(d, &e);
    if (limits_nearly_singular(&d->r, 0, &d->now, &e)) {
        limits_say_singular(0, 0, d->end);
        return GOUGH_ERROR_NUMERICAL;
    }
    status = drive_row(d, d->y);
    if (status != GOUGH_OK) return status;
    limits_margins(&d->r, run_stage(&d->r, 0), &d->now, e.determinant, &d->side, margin);
    broken = limits_broken(margin, 0, MARGINS);
    if (broken < 0) return GOUGH_OK;
    limits_end(&d->r, margin, broken, 0, d->end);
    return GOUGH_ERROR_NUMERICAL;
}

/* Looks at the quarters of the step before t, for the summary, where rows are too far apart to serve. Steps of a fixed length are
 * short beside the motion, and are looked at at their ends. */
static inline void drive_quarters(drive *d, int *quarter, real t) {
    if (d->r.options->summary == NULL || d->dense == NULL) return;
    if (4 * (real)d->r.options->output_step < d->h) return;
    for (; *quarter < 4 && d->t0 + (real)*quarter / 4 * d->h < t; (*quarter)++) {
        number y[STATE];
        drive_prepare(d);
        drive_inside(d, (real)*quarter / 4, y);
        drive_look(d, d->t0 + (real)*quarter / 4 * d->h, y);
    }
}

/* rows due up to `until`, from inside the step */
static inline gough_status drive_rows(drive *d, real until) {
    const real step = d->r.options->output_step;
    int quarter = 1;

    while (d->row < d->rows) {
        const real t = (real)d->row * step;
        number y[STATE];
        gough_status status;

        if (t > until + step * (real)1e-12) break;
        drive_quarters(d, &quarter, t);
        if (t < d->t) {
            drive_prepare(d);
            drive_inside(d, (t - d->t0) / d->h, y);
            status = drive_row(d, y);
        } else {
            status = drive_row(d, d->y);
        }
        if (status != GOUGH_OK) return status;
    }
    drive_quarters(d, &quarter, until);
    if (!(until < d->t)) drive_look(d, d->t, d->y);
    return GOUGH_OK;
}

static inline int drive_finite(const number *y) {
    real sum = 0;

    for (int i = 0; i < STATE; i++) sum = sum + real_magnitude(number_first(y[i]));
    return real_finite(sum);
}

static inline gough_status drive_not_finite(drive *d, real t) {
    if (d->r.fault.what) return limits_fault(&d->r, d->end);
    return drive_stop(d, GOUGH_END_NOT_FINITE, t, "the motion ceases to be finite");
}

/* what follows each step, d->raw being its outcome: drift, projection, the end if there is one. *until: end of the valid part */
static inline gough_status drive_settle(drive *d, int inside, real *until) {
    *until = d->t0;
    drive_note_drift(d, d->raw);
    for (int i = 0; i < STATE; i++) d->y[i] = d->raw[i];
    drive_project(d, d->y);
    run_instant(&d->r, d->t, d->y, &d->now);
    coordinates_store(&d->now.rate, d->rate);
    coordinates_store(&d->now.acceleration, d->rate + COORDINATES);
    if (d->r.fault.what) return limits_fault(&d->r, d->end);
    if (!drive_finite(d->y) || !drive_finite(d->rate)) return drive_not_finite(d, d->t);
    return drive_watch(d, inside, until);
}

/* the same with the rows that are due */
static inline gough_status drive_accept(drive *d, int inside) {
    real until;
    const gough_status ended = drive_settle(d, inside, &until);
    const gough_end end = *d->end;
    const gough_status status = drive_rows(d, until);

    if (ended == GOUGH_OK) return status;
    *d->end = end; /* rows before the end do not change its cause */
    return ended;
}

/* whether an implicit step came to a solution */
static inline gough_status drive_converged(drive *d, number residual) {
    if (d->r.fault.what) return limits_fault(&d->r, d->end);
    if (residual <= (real)1e-6) return GOUGH_OK;
    return drive_stop(d, GOUGH_END_NO_CONVERGENCE, d->t0,
                      "the step is too long for the turn of the load; a shorter step would do:");
}

/* one fixed step looked at by itself */
static inline gough_status drive_check(drive *d, number residual) {
    const gough_status status = drive_converged(d, residual);
    real until;

    return status == GOUGH_OK ? drive_settle(d, 0, &until) : status;
}

/* No step meets the tolerance: the fault of a formula that ceases to be finite right ahead, else of what the motion does. `unit`:
 * the unit of time. */
static inline gough_status drive_stuck(drive *d, real unit) {
    const real reach = d->t > unit ? d->t : unit, duration = d->r.options->duration;

    for (real ahead = 16 * REAL_EPSILON; ahead < (real)1e-6; ahead = 4 * ahead) {
        if (d->r.fault.what || !(d->t + ahead * reach <= duration)) break;
        run_stage(&d->r, d->t + ahead * reach);
    }
    if (d->r.fault.what) return limits_fault(&d->r, d->end);
    return drive_stop(d, GOUGH_END_NO_CONVERGENCE, d->t,
                      "no step meets the tolerance; a larger tolerance, or a look at what the "
                      "motion does there, may help:");
}

/* So many steps that a run will not end. Where deviations decay fast, steps must be short for stability, whatever the
 * accuracy asked for. */
static inline gough_status drive_stiff(drive *d) {
    return drive_stop(
        d, GOUGH_END_NO_CONVERGENCE, d->t,
        "after 2e7 steps the run has not reached its duration; very large damping or "
        "stiffness forces very short steps: choose less of it, a shorter duration, or "
        "a fixed step. The run stopped");
}

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

/* adaptive dop853 */
static inline gough_status drive_adaptive(drive *d) {
    const gough_machine *machine = d->r.lane[0].machine;
    const real tolerance = d->r.options->tolerance, duration = d->r.options->duration;
    const real length = machine->base_radius, gravity = machine->gravity_magnitude;
    const real unit = gravity > 0 ? real_root(length / gravity) : 1;
    real size[STATE], wish;
    dop853 work;
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
            continue;
        }
        d->r.fault.what = NULL;
        d->t = step < left ? d->t0 + step : stop;
        const gough_status status = drive_accept(d, 1);
        if (status != GOUGH_OK) return status;
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
    const real h = d->r.options->step, end = (real)(k + 1) * h;

    if (part > 0 && !(d->t < end)) return 0;
    d->t0 = part == 0 ? (real)k * h : d->t;
    const double to = appointments_part(&d->when, (double)d->t0, (double)end, (double)h);
    d->t1 = to < (double)end ? (real)to : end;
    d->h = part == 0 && !(to < (double)end) ? h : d->t1 - d->t0;
    return 1;
}

static inline gough_status drive_fixed(drive *d) {
    const gough_simulation *o = d->r.options;
    const int rattling = o->method >= GOUGH_RATTLE2;
    const long long steps = (long long)floor(o->duration / o->step + 1e-9);
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
    return status;
}

#endif
