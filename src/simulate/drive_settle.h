/* What a run of forward dynamics does around its steps: where it begins, the constraints kept, rows at the output times, limits
 * watched, the end found. For scalar number types; theory: docs/theory/steppers.md. */
#ifndef GOUGH_SIMULATE_DRIVE_SETTLE_H
#define GOUGH_SIMULATE_DRIVE_SETTLE_H

#include "integrate/march.h"
#include "model/appointments.h"
#include "simulate/ends.h"
#include "simulate/lookahead.h"
#include "simulate/row.h"
#include "simulate/simulate.h"

/* halvings of a bracket around an end: to round-off of the step */
enum { DRIVE_HALVINGS = 64 };

/* looks between the ends of an adaptive step, for peaks to four digits */
enum { DRIVE_LOOKS = 8 };

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

    /* the step that is being looked at: from (m.t0, y0) to m.h later, their rates, and the dense output if any */
    march m;
    number y0[STATE], rate0[STATE], raw[STATE], rate[STATE];
    dop853 *dense;
    int prepared;
    lookahead *ahead;  /* stages made ready, or NULL */
    appointments when; /* times that no step may pass */
    gough_statistics statistics;

    /* the end of the step, and how far from trouble its beginning was */
    instant now;
    number length[LEGS], speed[LEGS];
    real pose, program;
} drive;

/* adaptive steps that a run may take: some minutes of work */
static const long long drive_most_steps = 20000000;

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
    const double *axes = motion_axes(motion);
    jet component[GOUGH_COMPONENTS];
    coordinates x[3], rate;
    vector velocity, omega;

    motion_components(motion, 0, component);
    coordinates_of_motion(h, d->r.height, motion->about, axes, component, x);
    velocity = (vector){component[0].d, component[1].d, component[2].d};
    omega = triad_angular_velocity(&x[0].q, &x[1].q);
    if (initial->velocity_given) velocity = vector_of(initial->velocity);
    if (initial->angular_velocity_given) omega = vector_of(initial->angular_velocity);

    if (initial->given[GOUGH_ROLL] || initial->given[GOUGH_PITCH] || initial->given[GOUGH_YAW]) {
        motion_base_angles(axes, component);
        axes = NULL;
    }
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        if (initial->given[c]) component[c] = jet_constant(initial->component[c]);
    }
    coordinates_of_motion(h, d->r.height, motion->about, axes, component, x);
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
    row_fill(&d->r, s, t, &m, 1, !summary->brief_, d->drift, value);
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
    row_fill(&d->r, s, t, &m, 1, 1, d->drift, value);
    if (!(value[GOUGH_CONDITION] <= (real)greatest_condition)) {
        limits_say_singular(0, (double)t, d->end);
        return GOUGH_ERROR_NUMERICAL;
    }
    if (!row_finite(&d->r, 1, value)) {
        return drive_stop(d, GOUGH_END_NOT_FINITE, t, "the motion is no longer finite");
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
        interpolate_cubic(STATE, d->m.h, theta, d->y0, d->rate0, d->y, d->rate, y);
    }
    drive_project(d, y);
}

/* the margins at a point of the step; e: of the pose at its end. Returns the first that is gone, or -1. */
static inline int drive_broken(drive *d, real theta, const elimination *e, real margin[MARGINS]) {
    const real t = d->m.t0 + theta * d->m.h;
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
    dop853_prepare(d->dense, run_rates, &d->r, STATE, d->m.t0, d->m.h, d->y0, d->raw);
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
    const real pose = e->determinant, ease = (real)determinant_ease;

    if (d->r.limited[1] || d->r.limited[2]) return 0;
    for (int v = 0; v < LEGS; v++) {
        const real after = real_magnitude(d->now.g.rate[v]), before = d->speed[v];
        const real way = d->m.h * (after > before ? after : before);
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
        *until = d->m.t0 + high * d->m.h;
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

/* Looks at the eighths of the step before t, for the summary, where rows are too far apart to serve. Steps of a fixed length are
 * short beside the motion, and are examined at their ends. */
static inline void drive_between(drive *d, int *part, real t) {
    if (d->r.options->summary == NULL || d->dense == NULL) return;
    if (DRIVE_LOOKS * (real)d->r.options->output_step < d->m.h) return;
    for (; *part < DRIVE_LOOKS && d->m.t0 + (real)*part / DRIVE_LOOKS * d->m.h < t; (*part)++) {
        number y[STATE];
        drive_prepare(d);
        drive_inside(d, (real)*part / DRIVE_LOOKS, y);
        drive_look(d, d->m.t0 + (real)*part / DRIVE_LOOKS * d->m.h, y);
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
        drive_between(d, &quarter, t);
        if (t < d->t) {
            drive_prepare(d);
            drive_inside(d, (t - d->m.t0) / d->m.h, y);
            status = drive_row(d, y);
        } else {
            status = drive_row(d, d->y);
        }
        if (status != GOUGH_OK) return status;
    }
    drive_between(d, &quarter, until);
    if (!(until < d->t)) {
        drive_look(d, d->t, d->y);
        /* derivatives jump there: nothing is interpolated across it */
        if (d->r.options->summary && (double)d->t >= d->when.corner - d->when.slack) {
            gough_summary_corner(d->r.options->summary);
        }
    } else if (until > d->m.t0) { /* the run ends within the step */
        number y[STATE];
        drive_prepare(d);
        drive_inside(d, (until - d->m.t0) / d->m.h, y);
        drive_look(d, until, y);
    }
    return GOUGH_OK;
}

static inline int drive_finite(const number *y) {
    real sum = 0;

    for (int i = 0; i < STATE; i++) sum = sum + real_magnitude(number_first(y[i]));
    return real_finite(sum);
}

static inline gough_status drive_not_finite(drive *d, real t) {
    if (d->r.fault.what) return limits_fault(&d->r, d->end);
    return drive_stop(d, GOUGH_END_NOT_FINITE, t, "the motion is no longer finite");
}

/* rates in the state at the present time, from which the next step starts */
static inline void drive_refresh(drive *d) {
    run_instant(&d->r, d->t, d->y, &d->now);
    coordinates_store(&d->now.rate, d->rate);
    coordinates_store(&d->now.acceleration, d->rate + COORDINATES);
}

/* what follows each step, d->raw being its outcome: drift, projection, the end if there is one. *until: end of the valid part */
static inline gough_status drive_settle(drive *d, int inside, real *until) {
    *until = d->m.t0;
    drive_note_drift(d, d->raw);
    for (int i = 0; i < STATE; i++) d->y[i] = d->raw[i];
    drive_project(d, d->y);
    drive_refresh(d);
    if (d->r.fault.what) return limits_fault(&d->r, d->end);
    if (!drive_finite(d->y) || !drive_finite(d->rate)) return drive_not_finite(d, d->t);
    return drive_watch(d, inside, until);
}

/* the same with the rows that are due */
static inline gough_status drive_accept(drive *d, int inside) {
    real until;
    d->statistics.steps++;
    const gough_status ended = drive_settle(d, inside, &until);
    const gough_end end = *d->end;
    const gough_status status = drive_rows(d, until);

    if (ended == GOUGH_OK) return status;
    *d->end = end; /* rows before the end do not change its cause */
    return ended;
}

/* puts the run back to the moment at which a step broke off */
static inline void drive_return(drive *d, real until) {
    number y[STATE];

    if (!(until > d->m.t0)) {
        memcpy(d->y, d->y0, sizeof d->y);
        d->t = d->m.t0;
    } else if (until < d->t) {
        drive_inside(d, (until - d->m.t0) / d->m.h, y);
        memcpy(d->y, y, sizeof d->y);
        d->t = until;
    }
    d->r.fault.what = NULL;
}

/* whether an implicit step came to a solution */
static inline gough_status drive_converged(drive *d, number residual) {
    if (d->r.fault.what) return limits_fault(&d->r, d->end);
    if (residual <= (real)1e-6) return GOUGH_OK;
    return drive_stop(d, GOUGH_END_NO_CONVERGENCE, d->m.t0,
                      "an implicit step did not converge (choose a shorter simulation.step)");
}

/* one fixed step looked at by itself; *until: end of its valid part */
static inline gough_status drive_check(drive *d, number residual, real *until) {
    const gough_status status = drive_converged(d, residual);

    *until = d->m.t0;
    return status == GOUGH_OK ? drive_settle(d, 0, until) : status;
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
    return drive_stop(
        d, GOUGH_END_NO_CONVERGENCE, d->t,
        "no step, however short, meets the tolerance (a larger simulation.tolerance may help)");
}

/* So many steps that a run will not end. Where deviations decay fast, steps must be short for stability, whatever the
 * accuracy asked for. */
static inline gough_status drive_stiff(drive *d) {
    return drive_stop(d, GOUGH_END_NO_CONVERGENCE, d->t,
                      "after 2e7 steps the run has not reached its duration: very large damping or "
                      "stiffness forces very short steps. Reduce it, or choose a shorter duration "
                      "or a fixed step. The run stopped");
}

#endif
