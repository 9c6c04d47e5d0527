/* What a run of forward dynamics does around its steps: where it begins, the constraints kept, rows at the output times, limits
 * watched, the end found. For scalar number types; theory: docs/theory/steppers.md. */
#ifndef GOUGH_RUN_FORWARD_SETTLE_H
#define GOUGH_RUN_FORWARD_SETTLE_H

#include "run/ends.h"
#include "run/prefetched.h"
#include "run/row.h"
#include "run/run.h"
#include "system/loop.h"
#include "system/problem.h"

/* halvings of a bracket around an end: to round-off of the step */
enum { FORWARD_HALVINGS = 64 };

/* looks between the ends of an adaptive step, for peaks to four digits */
enum { FORWARD_LOOKS = 8 };

typedef struct {
    struct system r;
    const gough_initial *initial;
    gough_sink sink;
    void *context;
    gough_end *end;
    limits_side side;
    long long row;        /* the next */
    long long rows;       /* number of rows */
    real drift;           /* since the row before */
    number y[STATE_SIZE]; /* at t, constraints kept */
    real t;

    /* the step that is being looked at: from (m.t0, y0) to m.h later, their rates, and the dense output if any */
    march m;
    number y0[STATE_SIZE], rate0[STATE_SIZE], raw[STATE_SIZE], rate[STATE_SIZE];
    dop853 *dense;
    int prepared;
    prefetched *prefetched; /* stages made ready, or NULL */
    appointments when;      /* times that no step may pass */
    loop loop;              /* if the controller is sampled */
    int renewed;            /* commands have changed at the end of the last step */
    gough_statistics statistics;

    /* the end of the step, and how far from trouble its beginning was */
    signals now;
    number length[LEGS], speed[LEGS];
    real pose, program;
} forward;

/* adaptive steps that a run may take: some minutes of work */
static const long long forward_most_steps = 20000000;

static inline void forward_project(const forward *d, number *y) {
    coordinates x, rate;

    if (d->r.options->constraints != GOUGH_PROJECTION) return;
    x = coordinates_load(y);
    rate = coordinates_load(y + COORDINATES);
    coordinates_project(&x, &rate);
    coordinates_store(&x, y);
    coordinates_store(&rate, y + COORDINATES);
}

static inline void forward_note_drift(forward *d, const number *y) {
    const coordinates x = coordinates_load(y);
    const real violation = triad_violation(&x.q);

    if (!(violation <= d->drift)) d->drift = violation;
}

/* (x, ρ̇, ω) at the beginning: the program's, or what the study gives */
static inline void forward_start(forward *d) {
    const gough_initial *initial = d->initial;
    const gough_motion *motion = d->r.motion;
    const hexapod *h = &d->r.h;
    const vector about = vector_of(motion->about);
    angle_frame frame = motion_frame(motion);
    jet component[GOUGH_COMPONENTS];
    coordinates x[3], rate;
    vector velocity, omega;

    motion_components(motion, 0, component);
    coordinates_of_motion(h, d->r.height, motion->about, frame, component, x);
    velocity = (vector){component[0].d, component[1].d, component[2].d};
    omega = triad_angular_velocity(&x[0].q, &x[1].q);
    if (initial->velocity_given) velocity = vector_of(initial->velocity);
    if (initial->angular_velocity_given) omega = vector_of(initial->angular_velocity);

    if (initial->given[GOUGH_ROLL] || initial->given[GOUGH_PITCH] || initial->given[GOUGH_YAW]) {
        motion_base_angles(frame, component);
        frame.axes = NULL;
    }
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        if (initial->given[c]) component[c] = jet_constant(initial->component[c]);
    }
    coordinates_of_motion(h, d->r.height, motion->about, frame, component, x);
    const vector arm = out_of(&x[0].q, onto(&h->axes, subtract(h->center, about)));
    rate = (coordinates){add(velocity, cross(omega, arm)), triad_rate(&x[0].q, omega)};
    coordinates_project(&x[0], &rate);
    coordinates_store(&x[0], d->y);
    coordinates_store(&rate, d->y + COORDINATES);
    loop_begin(&d->r, &d->loop, d->r.options->step, d->y);
}

/* GOUGH_ERROR_NUMERICAL with the end said */
static inline gough_status forward_stop(forward *d, gough_cause cause, real t,
                                        const char *sentence) {
    limits_no_leg(d->end, cause, (double)t);
    end_say(d->end, "%s at t = %.9g", sentence, (double)t);
    return GOUGH_ERROR_NUMERICAL;
}

/* takes a moment between rows into the summary, if one is wanted */
static inline void forward_look(forward *d, real t, const number *y) {
    gough_summary *summary = d->r.options->summary;
    real value[GOUGH_COLUMNS];
    signals m;

    if (summary == NULL) return;
    const wanted *s = system_posed(&d->r, t);
    system_signals(&d->r, t, y, &m);
    row_fill(&d->r, s, t, &m, 1, summary->brief_ ? ROW_BRIEF : ROW_WHOLE, d->drift, value);
    if (row_finite(&d->r, 1, value)) row_sum(value, summary, d->r.lane[0].machine, 0);
}

/* whether a row is of a pose nearly singular; where nobody reads its condition number, pivots come first */
static inline int forward_singular(const forward *d, const signals *m, int brief,
                                   const real *value) {
    if (!brief) return !(value[GOUGH_CONDITION] <= (real)greatest_condition);
    const elimination e = limits_pose(&d->r, m);
    return limits_pose_nearly_singular(&d->r, m, &e);
}

/* sends the row that is due, from a state; GOUGH_OK to go on */
static inline gough_status forward_row(forward *d, const number *y) {
    const real t = (real)d->row * (real)d->r.options->output_step;
    const wanted *s = system_posed(&d->r, t);
    gough_summary *summary = d->r.options->summary;
    const int brief = summary != NULL && summary->brief_;
    real value[GOUGH_COLUMNS];
    signals m;

    system_signals(&d->r, t, y, &m);
    if (d->r.fault.what) return limits_fault(&d->r, d->end);
    row_fill(&d->r, s, t, &m, 1, brief ? ROW_RATES : ROW_WHOLE, d->drift, value);
    if (forward_singular(d, &m, brief, value)) {
        limits_say_singular(0, (double)t, d->end);
        return GOUGH_ERROR_NUMERICAL;
    }
    if (!row_finite(&d->r, 1, value)) {
        return forward_stop(d, GOUGH_END_NOT_FINITE, t, "the motion is no longer finite");
    }
    if (summary) row_sum(value, summary, d->r.lane[0].machine, 1);
    d->row++;
    d->drift = 0;
    if (row_send(&d->r, value, d->sink, d->context)) {
        return forward_stop(d, GOUGH_END_STOPPED, t, "the run was stopped");
    }
    return GOUGH_OK;
}

/* the state inside the step */
static inline void forward_inside(const forward *d, real theta, number *y) {
    if (d->prepared) {
        dop853_dense(d->dense, d->r.states, theta, y);
    } else {
        interpolate_cubic(d->r.states, d->m.h, theta, d->y0, d->rate0, d->y, d->rate, y);
    }
    forward_project(d, y);
}

/* the margins at a point of the step; e: of the pose at its end. Returns the first that is gone, or -1. */
static inline int forward_broken(forward *d, real theta, const elimination *e,
                                 real margin[MARGINS]) {
    const real t = d->m.t0 + theta * d->m.h;
    number y[STATE_SIZE];
    measured q;
    signals m;

    if (!(theta < 1)) {
        limits_margins(&d->r, system_wanted(&d->r, d->t), &d->now, e->determinant, &d->side, &q,
                       margin);
        return limits_broken(&d->r, margin);
    }
    forward_inside(d, theta, y);
    system_signals(&d->r, t, y, &m);
    limits_margins(&d->r, system_wanted(&d->r, t), &m, limits_pose(&d->r, &m).determinant, &d->side,
                   &q, margin);
    return limits_broken(&d->r, margin);
}

/* whether the summary is to see the step at its eighths, rows being too far apart to serve */
static inline int forward_looks_between(const forward *d) {
    return d->r.options->summary != NULL && d->dense != NULL &&
           !(FORWARD_LOOKS * (real)d->r.options->output_step < d->m.h);
}

/* makes the stages ready that dense output, looks and rows inside the step ask for */
static inline void forward_prefetch_inside(forward *d) {
    const real step = d->r.options->output_step;

    if (d->prefetched == NULL) return;
    prefetched_clear(d->prefetched, 1);
    prefetched_announce(d->prefetched, d->t);
    for (int row = DOP853_STAGES + 1; row < 16; row++)
        prefetched_announce(d->prefetched, d->m.t0 + dop853_c[row] * d->m.h);
    for (int part = 1; part < FORWARD_LOOKS && forward_looks_between(d); part++)
        prefetched_announce(d->prefetched, d->m.t0 + (real)part / FORWARD_LOOKS * d->m.h);
    for (long long i = d->row; i < d->rows && (real)i * step < d->t; i++)
        prefetched_announce(d->prefetched, (real)i * step);
    prefetched_ready(d->prefetched);
    d->r.valid = 0; /* the stage at the end of the step comes with the program's pose now */
}

/* makes the dense output of the step, once */
static inline void forward_prepare(forward *d) {
    if (d->dense == NULL || d->prepared) return;
    forward_prefetch_inside(d);
    dop853_prepare(d->dense, system_rates, &d->r, d->r.states, d->m.t0, d->m.h, d->y0, d->raw);
    d->prepared = 1;
}

/* keeps what the next step is compared with */
static inline void forward_remember(forward *d, const elimination *e) {
    for (int v = 0; v < LEGS; v++) {
        d->length[v] = d->now.g.length[v];
        d->speed[v] = real_magnitude(d->now.g.rate[v]);
    }
    d->pose = e->determinant;
    d->program = system_wanted(&d->r, d->t)->singularity.determinant;
}

/* Whether nothing can have happened within the step that is not seen at its ends: no limits but those of lengths, which are
 * further from their limits than the legs can go in a step, determinants far from zero */
static inline int forward_comfortable(const forward *d, real program, const elimination *e) {
    const real pose = e->determinant, ease = (real)determinant_ease;

    if (d->r.limits.kinds & ~LIMITS_OF_LENGTH) return 0;
    for (int v = 0; v < LEGS; v++) {
        const real after = real_magnitude(d->now.g.rate[v]), before = d->speed[v];
        const real way = d->m.h * (after > before ? after : before);
        const real one = d->length[v], two = d->now.g.length[v];
        if (!(((one < two ? one : two) - way) * d->r.limits.shortest[v] > 1)) return 0;
        if (!(((one < two ? two : one) + way) * d->r.limits.longest[v] < 1)) return 0;
    }
    return real_magnitude(pose) > ease * real_magnitude(pose - d->pose) &&
           real_magnitude(program) > ease * real_magnitude(program - d->program);
}

/* Whether the step breaks a limit: at its end, and for long steps at quarters too unless that cannot be. Sets the end. *until is
 * where the valid part of the step ends. */
static inline gough_status forward_watch(forward *d, int inside, real *until) {
    const wanted *s = system_wanted(&d->r, d->t);
    const elimination e = limits_pose(&d->r, &d->now);
    const int quarters = inside && !forward_comfortable(d, s->singularity.determinant, &e);
    real low = 0, high = 0, margin[MARGINS], there[MARGINS];
    int broken = -1;

    *until = d->t;
    for (int quarter = quarters ? 1 : 4; quarter <= 4 && broken < 0; quarter++) {
        low = high;
        high = (real)quarter / 4;
        broken = forward_broken(d, high, &e, margin);
    }
    if (broken >= 0) {
        forward_prepare(d);
        for (int i = 0; i < FORWARD_HALVINGS; i++) {
            const real middle = (low + high) / 2;
            const int gone = forward_broken(d, middle, &e, there);
            if (gone >= 0) {
                broken = gone;
                memcpy(margin, there, sizeof margin);
                high = middle;
            } else {
                low = middle;
            }
        }
        *until = d->m.t0 + high * d->m.h;
        limits_end(&d->r, margin, broken, *until, d->end);
        return GOUGH_ERROR_NUMERICAL;
    }
    forward_remember(d, &e);
    if (limits_nearly_singular(&d->r, d->t, &d->now, &e)) {
        limits_say_singular(0, (double)d->t, d->end);
        return GOUGH_ERROR_NUMERICAL;
    }
    return GOUGH_OK;
}

/* first row, and the limits at the beginning */
static inline gough_status forward_begin(forward *d) {
    gough_status status;
    real margin[MARGINS];
    elimination e;
    measured q;
    int broken;

    d->t = 0;
    d->row = 0;
    d->drift = 0;
    forward_note_drift(d, d->y);
    system_signals(&d->r, 0, d->y, &d->now);
    if (d->r.fault.what) return limits_fault_ahead(&d->r, 0, d->end);
    d->side = limits_begin(&d->r, system_wanted(&d->r, 0), &d->now);
    e = limits_pose(&d->r, &d->now);
    forward_remember(d, &e);
    if (limits_nearly_singular(&d->r, 0, &d->now, &e)) {
        limits_say_singular(0, 0, d->end);
        return GOUGH_ERROR_NUMERICAL;
    }
    status = forward_row(d, d->y);
    if (status != GOUGH_OK) return status;
    limits_margins(&d->r, system_wanted(&d->r, 0), &d->now, e.determinant, &d->side, &q, margin);
    broken = limits_broken(&d->r, margin);
    if (broken < 0) return GOUGH_OK;
    limits_end(&d->r, margin, broken, 0, d->end);
    return GOUGH_ERROR_NUMERICAL;
}

/* Looks at the eighths of the step before t, for the summary, where rows are too far apart to serve. Steps of a fixed length are
 * short beside the motion, and are examined at their ends. */
static inline void forward_between(forward *d, int *part, real t) {
    if (!forward_looks_between(d)) return;
    for (; *part < FORWARD_LOOKS && d->m.t0 + (real)*part / FORWARD_LOOKS * d->m.h < t; (*part)++) {
        number y[STATE_SIZE];
        forward_prepare(d);
        forward_inside(d, (real)*part / FORWARD_LOOKS, y);
        forward_look(d, d->m.t0 + (real)*part / FORWARD_LOOKS * d->m.h, y);
    }
}

/* rows due up to `until`, from inside the step */
static inline gough_status forward_rows(forward *d, real until) {
    const real step = d->r.options->output_step;
    int quarter = 1;

    while (d->row < d->rows) {
        const real t = (real)d->row * step;
        number y[STATE_SIZE];
        gough_status status;

        if (t > until + step * (real)1e-12) break;
        forward_between(d, &quarter, t);
        if (t < d->t) {
            forward_prepare(d);
            forward_inside(d, (t - d->m.t0) / d->m.h, y);
            status = forward_row(d, y);
        } else {
            status = forward_row(d, d->y);
        }
        if (status != GOUGH_OK) return status;
    }
    forward_between(d, &quarter, until);
    if (!(until < d->t)) {
        forward_look(d, d->t, d->y);
        /* derivatives jump there: nothing is interpolated across it */
        if (d->r.options->summary && (double)d->t >= d->when.corner - d->when.slack) {
            gough_summary_corner(d->r.options->summary);
        }
    } else if (until > d->m.t0) { /* the run ends within the step */
        number y[STATE_SIZE];
        forward_prepare(d);
        forward_inside(d, (until - d->m.t0) / d->m.h, y);
        forward_look(d, until, y);
    }
    return GOUGH_OK;
}

static inline int forward_finite(const forward *d, const number *y) {
    real sum = 0;

    for (int i = 0; i < d->r.states; i++) sum = sum + real_magnitude(number_first(y[i]));
    return real_finite(sum);
}

static inline gough_status forward_not_finite(forward *d, real t) {
    if (d->r.fault.what) return limits_fault(&d->r, d->end);
    return forward_stop(d, GOUGH_END_NOT_FINITE, t, "the motion is no longer finite");
}

/* rates in the state at the present time, from which the next step starts */
static inline void forward_refresh(forward *d) {
    system_signals(&d->r, d->t, d->y, &d->now);
    signals_rates(&d->r, &d->now, d->rate);
}

/* what a sampled controller does at the present time; derivatives jump where its commands begin to act */
static inline gough_status forward_sample(forward *d) {
    d->renewed = d->r.traits & SAMPLED && !(d->t < sample_clock_next(&d->loop.clock));
    if (!d->renewed) return GOUGH_OK;
    loop_reach(&d->r, &d->loop, d->t, &d->now.g);
    if (d->r.fault.what) return limits_fault_ahead(&d->r, d->t, d->end);
    system_signals_again(&d->r, d->t, d->y, &d->now);
    signals_rates(&d->r, &d->now, d->rate);
    if (d->r.options->summary == NULL) return GOUGH_OK;
    gough_summary_jump(d->r.options->summary);
    forward_look(d, d->t, d->y);
    return GOUGH_OK;
}

/* what follows each step, d->raw being its outcome: drift, projection, the end if there is one. *until: end of the valid part */
static inline gough_status forward_settle(forward *d, int inside, real *until) {
    *until = d->m.t0;
    forward_note_drift(d, d->raw);
    for (int i = 0; i < d->r.states; i++) d->y[i] = d->raw[i];
    forward_project(d, d->y);
    forward_refresh(d);
    if (d->r.fault.what) return limits_fault(&d->r, d->end);
    if (!forward_finite(d, d->y) || !forward_finite(d, d->rate)) return forward_not_finite(d, d->t);
    return forward_watch(d, inside, until);
}

/* the same with the rows that are due */
static inline gough_status forward_accept(forward *d, int inside) {
    real until;
    d->statistics.steps++;
    const gough_status ended = forward_settle(d, inside, &until);
    const gough_end end = *d->end;
    const gough_status status = forward_rows(d, until);

    if (ended == GOUGH_OK) return status == GOUGH_OK ? forward_sample(d) : status;
    *d->end = end; /* rows before the end do not change its cause */
    return ended;
}

/* puts the run back to the moment at which a step broke off */
static inline void forward_return(forward *d, real until) {
    number y[STATE_SIZE];

    if (!(until > d->m.t0)) {
        memcpy(d->y, d->y0, sizeof d->y);
        d->t = d->m.t0;
    } else if (until < d->t) {
        forward_inside(d, (until - d->m.t0) / d->m.h, y);
        memcpy(d->y, y, sizeof d->y);
        d->t = until;
    }
    d->r.fault.what = NULL;
}

/* whether an implicit step came to a solution */
static inline gough_status forward_converged(forward *d, number residual) {
    if (d->r.fault.what) return limits_fault(&d->r, d->end);
    if (residual <= (real)1e-6) return GOUGH_OK;
    return forward_stop(d, GOUGH_END_NO_CONVERGENCE, d->m.t0,
                        "an implicit step did not converge (choose a shorter simulation.step)");
}

/* one fixed step looked at by itself; *until: end of its valid part */
static inline gough_status forward_check(forward *d, number residual, real *until) {
    const gough_status status = forward_converged(d, residual);

    *until = d->m.t0;
    return status == GOUGH_OK ? forward_settle(d, 0, until) : status;
}

/* No step meets the tolerance: the fault of a formula that ceases to be finite right ahead, else of what the motion does. `unit`:
 * the unit of time. */
static inline gough_status forward_stuck(forward *d, real unit) {
    const real reach = d->t > unit ? d->t : unit, duration = d->r.options->duration;

    real ahead = 16 * REAL_EPSILON;
    while (ahead < (real)1e-6) {
        if (d->r.fault.what || !(d->t + ahead * reach <= duration)) break;
        system_wanted(&d->r, d->t + ahead * reach);
        ahead = 4 * ahead;
    }
    if (d->r.fault.what) return limits_fault(&d->r, d->end);
    return forward_stop(
        d, GOUGH_END_NO_CONVERGENCE, d->t,
        "no step, however short, meets the tolerance (a larger simulation.tolerance may help)");
}

/* So many steps that a run will not end. Where deviations decay fast, steps must be short for stability, whatever the
 * accuracy asked for. */
static inline gough_status forward_stiff(forward *d) {
    return forward_stop(
        d, GOUGH_END_NO_CONVERGENCE, d->t,
        "after 2e7 steps the run has not reached its duration: very large damping or "
        "stiffness forces very short steps. Reduce it, or choose a shorter duration "
        "or a fixed step. The run stopped");
}

#endif
