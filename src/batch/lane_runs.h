/* A group of runs side by side, one a lane: fixed steps, constraints kept, peaks of the motion,
 * each lane's own end. A lane that has ended is still computed, but its results are ignored. Text over the
 * number type. */
#ifndef GOUGH_BATCH_LANE_RUNS_H
#define GOUGH_BATCH_LANE_RUNS_H

#include "batch/lane_runs_table.h"
#include "batch/looks.h"
#include "batch/watch.h"
#include "system/loop.h"
#include "system/problem.h"

typedef struct {
    struct system r;
    appointments when; /* the same in all lanes */
    march m;
    size_t first;
    int count;
    int going[NUMBER_WIDTH]; /* lanes still under way */
    int rows;
    number going_mask; /* 1 where going, else 0 */
    number side_pose, side_program;

    /* state and rates at both ends of the last step, constraints kept; `now` is its end */
    struct {
        number y[STATE_SIZE], rate[STATE_SIZE];
    } at[2];
    int now;
    rattle_state body;
    number determinant; /* of the pose at the last row */
    int watchful;       /* it must be computed at each step up to the next row */
    pose_watch
        watch; /* where a loop may fail from one sample to the next, and constraints are kept */

    loop loop;    /* if the controllers are sampled, at the same times in all lanes */
    number drift; /* since the look before */
    number last[STATE_SIZE];
    vector center; /* of mass, from the top frame's origin, central axes */
    looks looks;
    struct sizing sizing; /* if the job wants it */
} group;

/* ---- lanes and scalars ---- */

static inline void group_lane(const number *y, int lane, double *out, int count) {
    for (int i = 0; i < count; i++) out[i] = number_lane(y[i], lane);
}

static inline number group_heard(const group *g, number x, number otherwise) {
    return number_select(number_greater(g->going_mask, number_of(0.5)), x, otherwise);
}

static inline size_t group_run(const group *g, int lane) {
    return g->first + (size_t)(lane < g->count ? lane : g->count - 1);
}

static inline void group_end_lane(group *g, int lane) {
    g->going[lane] = 0;
    number_put(&g->going_mask, lane, 0);
}

/* ---- stages from the tape ---- */

static inline number group_broadcast(double x) { return number_of(x); }

static inline vector group_vector(const double v[3]) {
    return (vector){group_broadcast(v[0]), group_broadcast(v[1]), group_broadcast(v[2])};
}

/* own machine in each lane: the equations from the jets on */
static inline void group_solve(struct system *r, real t, const stage_tape *tape,
                               const tape_record *record) {
    jet component[GOUGH_COMPONENTS];
    number vertical = number_of(record->vertical);

    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        component[c] =
            (jet){record->component[c][0], record->component[c][1], record->component[c][2]};
    }
    wanted_program(r, component, &r->now);
    if (r->share && !tape->disturbance_shared) vertical = wanted_vertical(r, t);
    if (r->solves) wanted_forces(r, vertical, &r->now);
}

/* what disturbs: as recorded where it is one for all runs, else by each lane's formulas; noise is each lane's own */
static inline void group_disturb(struct system *r, real t, const stage_tape *tape,
                                 const tape_record *record) {
    wanted *s = &r->now;
    number *shake = wanted_shake(r, s);

    if (!tape->disturbance_shared) {
        wanted_disturb(r, t, s);
    } else {
        for (int v = 0; v < LEGS; v++) {
            if (r->shaken[v]) shake[v] = shake[v] + number_of(record->leg[v]);
        }
        if (r->loaded) {
            s->push = group_vector(record->push);
            s->turn = group_vector(record->turn);
        }
    }
    if (r->noise.present) noise_add(r, t, s);
}

static inline void group_replay(struct system *r, real t) {
    stage_tape *tape = r->provider;
    const tape_record *record = tape_at(tape, t);
    wanted *s = &r->now;

    wanted_external(r, t, s);
    if (tape->machine_shared) {
        for (int v = 0; v < LEGS; v++) {
            s->force[v] = number_of(record->force[v]);
            s->shake[v] = number_of(record->shake[v]);
            s->program.length[v] = number_of(record->length[v]);
        }
        for (int v = 0; (r->traits & (NEEDS_RATES | PROGRAM_RATES)) && v < LEGS; v++) {
            s->program.rate[v] = number_of(record->rate[v]);
        }
        s->singularity =
            (elimination){number_of(record->determinant), number_of(record->pivot_ratio)};
    } else {
        group_solve(r, t, tape, record);
    }
    group_disturb(r, t, tape, record);
}

/* the program's pose in the stage at t, which no step needs, only rows */
static inline void group_program_pose(struct system *r) {
    const stage_tape *tape = r->provider;
    const double *pose = tape->last->pose;
    coordinates *x = &r->now.x[0];

    if (!tape->machine_shared) return;
    x->rho = group_vector(pose);
    x->q = (triad){group_vector(pose + 3), group_vector(pose + 6), group_vector(pose + 9)};
}

/* ---- looks ---- */

/* a look at the end of a step */
static inline void group_look(group *g, const wanted *s, const signals *m, double t) {
    group_program_pose(&g->r);
    looks_fill(s, m, g->center, looks_next(&g->looks));
    if (g->looks.sizing) sizing_fill(&g->r, m, sizing_look(&g->looks, QUADRATURE_ROWS - 1));
    looks_take(&g->looks, g->going_mask, g->drift, t);
    g->drift = number_of(0);
    if (t >= g->when.corner - g->when.slack) looks_corner(&g->looks, g->going_mask);
}

/* a lane's numbers into its outcome; its end is there already, or done */
static inline void group_write(const group *g, const batch_job *job, const looks *l, int lane) {
    const size_t which = group_run(g, lane);
    gough_outcome *out = &job->outcomes[which];
    double last[STATE_SIZE];

    group_lane(g->last, lane, last, g->r.states);
    batch_last_row(job, which, last);
    out->position_deviation = number_lane(l->distance, lane);
    out->angle_deviation = looks_angle(number_lane(l->turn, lane));
    out->force = number_lane(l->force, lane);
    out->speed = number_lane(l->speed, lane);
    batch_put_power(out, -number_lane(l->braking, lane), number_lane(l->power, lane));
    out->drift = number_lane(l->drift, lane);
    out->rows = g->rows;
    out->energy = number_lane(l->energy, lane);
    if (l->sizing) sizing_write(l->sizing, lane, out->force, out->sizing);
}

/* ---- a group's life ---- */

static inline void group_begin(void *memory, const batch_job *job, size_t first, int count,
                               stage_tape *tape) {
    group *g = memory;
    system_lane lane[NUMBER_WIDTH];
    signals m;

    g->first = first;
    g->count = count;
    for (int i = 0; i < NUMBER_WIDTH; i++) {
        const gough_batch_run *one = &job->runs[group_run(g, i)];
        lane[i] = (system_lane){one->machine, one->control, one->disturbance, one->number,
                                one->sampling_number};
    }
    system_begin(&g->r, job->motion, job->simulation, lane);
    g->r.provide = group_replay;
    g->r.provider = tape;
    g->r.now.push = g->r.now.turn = (vector){number_of(0), number_of(0), number_of(0)};
    appointments_begin(&g->when, job->motion, lane[0].disturbance, lane[0].machine, 0,
                       job->simulation->duration, job->simulation->output_step);
    g->rows = 0;
    g->watchful = 1;
    watch_begin(&g->watch, &g->r.h);
    g->going_mask = g->determinant = g->drift = number_of(0);
    g->center = onto(&g->r.h.axes, g->r.h.center);
    looks_begin(&g->looks);
    if (job->sizing) {
        sizing_begin(&g->sizing, &g->r);
        g->looks.sizing = &g->sizing;
    }
    for (int i = 0; i < NUMBER_WIDTH; i++) {
        double state[STATE_SIZE], side[2];
        const int starts = batch_start(job, group_run(g, i), state, side);
        g->going[i] = i < count && starts;
        number_put(&g->going_mask, i, g->going[i]);
        number_put(&g->side_pose, i, side[0]);
        number_put(&g->side_program, i, side[1]);
        for (int k = 0; k < g->r.states; k++) number_put(&g->at[0].y[k], i, state[k]);
    }
    loop_begin(&g->r, &g->loop, job->simulation->step, g->at[0].y);
    for (int k = 0; k < g->r.states; k++) g->last[k] = g->at[0].y[k];

    g->now = 0;
    system_signals(&g->r, 0, g->at[0].y, &m);
    signals_rates(&g->r, &m, g->at[0].rate);
    g->drift = triad_violation(&m.x.q);
    group_look(g, system_wanted(&g->r, 0), &m, 0);
    g->rows = 1;
    g->determinant = limits_pose(&g->r, &m).determinant;
    g->m = system_march(job->simulation, &g->when);
    if (g->m.method >= MARCH_RATTLE) {
        const march_problem problem = system_problem(&g->r);
        g->body.x = coordinates_load(g->at[0].y);
        g->body.velocity = m.rate.rho;
        g->body.omega = onto(&g->body.x.q, triad_angular_velocity(&g->body.x.q, &m.rate.q));
        rattle_begin(&problem.rule, 0, &g->body);
    }
}

/* a step of another method than RK4; returns the residual of an implicit one */
LANES_APART number group_step_other(group *g, number raw[STATE_SIZE]) {
    const march_problem problem = system_problem(&g->r);
    dop853 work;
    const number residual =
        march_step(&g->m, &problem, &work, &g->body, g->at[g->now].y, g->at[g->now].rate, raw);

    if (g->m.method >= MARCH_RATTLE) {
        const coordinates turning = {g->body.velocity,
                                     triad_rate(&g->body.x.q, out_of(&g->body.x.q, g->body.omega))};
        coordinates_store(&g->body.x, raw);
        coordinates_store(&turning, raw + COORDINATES);
    }
    return residual;
}

/* the stepper's step; returns the residual of an implicit one */
static inline number group_step(group *g, number raw[STATE_SIZE]) {
    if (g->m.method != MARCH_RK4) return group_step_other(g, raw);
    rk4_step(system_rates, &g->r, g->r.states, g->m.t0, g->m.h, g->at[g->now].y, g->at[g->now].rate,
             raw);
    return number_of(0);
}

/* A sum that is not finite where anything is not; velocities are among the rates, of which there are so many. Four sums side by
 * side, since each addition waits for the one before. */
static inline number group_sum(const group *g, const signals *m, int rates) {
    const number *y = g->at[g->now].y, *rate = g->at[g->now].rate, none = number_of(0);
    number sum[4] = {none, none, none, none};

    KERNEL_UNROLL
    for (int i = 0; i < COORDINATES; i++) sum[i % 4] = sum[i % 4] + y[i];
    for (int i = 0; i + 4 <= rates; i += 4) {
        for (int k = 0; k < 4; k++) sum[k] = sum[k] + rate[i + k];
    }
    for (int i = rates / 4 * 4; i < rates; i++) sum[0] = sum[0] + rate[i];
    KERNEL_UNROLL
    for (int v = 0; v < LEGS; v++) {
        sum[v % 2] = sum[v % 2] + m->g.length[v];
        sum[2 + v % 2] = sum[2 + v % 2] + m->force[v];
    }
    return sum[0] + sum[1] + (sum[2] + sum[3]);
}

/* whether the loop may fail from one sample to the next, so that the changes from row to row say too little of what is between */
static inline int group_wary(const group *g) { return g->r.traits & LOOPED; }

/* 1 in lanes where something may have ended the run; cheap, and never wrong on the safe side */
static inline number group_trouble(group *g, const wanted *s, const signals *m, int rates,
                                   number residual) {
    const number zero = number_of(0), one = number_of(1);
    const number least = limits_least(&g->r, m);
    const number sum = group_sum(g, m, rates);
    mask fine;

    number suspicion = number_select(number_greater(zero, least), one, zero);
    fine = number_greater(number_of(1e300), number_magnitude(sum));
    suspicion = suspicion + number_select(fine, zero, one);
    fine = number_greater(number_of(1e-6), residual);
    suspicion = suspicion + number_select(fine, zero, one);
    fine = number_greater(g->side_program * s->singularity.determinant, zero);
    suspicion = suspicion + number_select(fine, zero, one);
    fine = number_greater(s->singularity.pivot_ratio, number_of(suspicious_pivots));
    suspicion = suspicion + number_select(fine, zero, one);
    if (g->watchful || (group_wary(g) && watch_moved(&g->watch, &m->x, &m->g, g->going_mask))) {
        const elimination e = limits_pose(&g->r, m);
        watch_set(&g->watch, &m->x, &m->g, e.determinant);
        fine = number_greater(g->side_pose * e.determinant, zero);
        suspicion = suspicion + number_select(fine, zero, one);
        fine = number_greater(e.pivot_ratio, number_of(suspicious_pivots));
        suspicion = suspicion + number_select(fine, zero, one);
    }
    return group_heard(g, suspicion, zero);
}

/* looks of a lane that ends, for which the others' stay as they are */
static inline looks group_own(const group *g, struct sizing *sizing) {
    looks own = g->looks;

    if (own.sizing) {
        *sizing = g->sizing;
        own.sizing = sizing;
    }
    return own;
}

/* numbers of one lane, 0 in the others */
static inline void group_put(number *to, int lane, const double *from, int count) {
    for (int c = 0; c < count; c++) {
        to[c] = number_of(0);
        number_put(&to[c], lane, from[c]);
    }
}

/* The outcome of a lane that ends within a step, with what is seen there. What others of the group see stays as it is. */
static inline void group_end_within(group *g, const batch_job *job, const batch_step *step,
                                    int lane) {
    struct sizing sizing;
    looks own = group_own(g, &sizing);
    number heard = number_of(0);

    number_put(&heard, lane, 1);
    if (step->looked) {
        number *look = looks_next(&own);
        group_put(look, lane, step->look, LOOKS_COLUMNS);
        if (own.sizing)
            group_put(sizing_look(&own, QUADRATURE_ROWS - 1), lane, step->sizing, SIZING_COLUMNS);
        looks_take(&own, heard, g->drift, step->until);
    }
    looks_finish(&own, heard);
    group_write(g, job, &own, lane);
    group_end_lane(g, lane);
}

/* looks at the lanes in trouble one by one, as gough_simulate() would */
LANES_APART void group_inspect(group *g, const batch_job *job, number trouble, number residual,
                               const number *raw) {
    for (int i = 0; i < NUMBER_WIDTH; i++) {
        batch_step step = {.t0 = g->m.t0,
                           .h = g->m.h,
                           .t = g->m.t1,
                           .residual = number_lane(residual, i),
                           .side = {number_lane(g->side_pose, i), number_lane(g->side_program, i)}};
        if (!(number_lane(trouble, i) > 0)) continue;
        group_lane(g->at[1 - g->now].y, i, step.y0, g->r.states);
        group_lane(g->at[1 - g->now].rate, i, step.rate0, g->r.states);
        group_lane(raw, i, step.raw, g->r.states);
        group_lane(g->r.held, i, step.held, LEGS);
        if (!batch_locate(job, group_run(g, i), &step)) continue;
        group_end_within(g, job, &step, i);
    }
}

static inline int group_going(const group *g) {
    int sum = 0;

    for (int i = 0; i < NUMBER_WIDTH; i++) sum += g->going[i];
    return sum;
}

/* a row, and whether determinants must be watched at each step up to the next */
static inline void group_row_due(group *g, const signals *m) {
    const number before = g->determinant;

    g->rows++;
    for (int i = 0; i < g->r.states; i++)
        g->last[i] = group_heard(g, g->at[g->now].y[i], g->last[i]);
    g->determinant = limits_pose(&g->r, m).determinant;
    const number slack = number_magnitude(g->determinant) -
                         number_of(determinant_ease) * number_magnitude(g->determinant - before);
    g->watchful = group_wary(g) && g->r.options->constraints != GOUGH_PROJECTION;
    if (group_wary(g)) watch_set(&g->watch, &m->x, &m->g, g->determinant);
    for (int i = 0; i < NUMBER_WIDTH; i++) {
        g->watchful |= !group_wary(g) && g->going[i] && !(number_lane(slack, i) > 0);
    }
}

/* whether a row is due at the end of the part of step k under way */
static inline int group_row_ends(const group *g, const batch_job *job, long long k) {
    return (k + 1) % job->per_row == 0 && !(g->m.t1 < (double)(k + 1) * g->m.length) &&
           !fixed_is_short(k, g->m.length, g->m.until);
}

/* a loop of fixed steps */
typedef struct {
    group *g;
    const batch_job *job;
    signals end; /* of the last part of a step */
} group_loop;

/* ends the lanes whose sample at t has asked for program forces that are no numbers */
LANES_APART void group_end_unknown(group *g, const batch_job *job, double t) {
    for (int i = 0; i < NUMBER_WIDTH; i++) {
        struct sizing sizing;
        looks own = group_own(g, &sizing);
        number heard = number_of(0);
        if (!g->going[i] || isfinite(number_lane(g->loop.fed, i))) continue;
        number_put(&heard, i, 1);
        batch_unknown(job, group_run(g, i), t);
        looks_finish(&own, heard);
        group_write(g, job, &own, i);
        group_end_lane(g, i);
    }
}

/* whether a sample is due at the end of the step, or a command begins to act there */
static inline int group_samples(const group *g) {
    return g->r.traits & SAMPLED && !(g->m.t1 < sample_clock_next(&g->loop.clock));
}

/* what sampled controllers do at the end of a step, whose signals m are, after which other forces may act */
static inline void group_sample(group *g, const batch_job *job, signals *m, double t) {
    loop_reach(&g->r, &g->loop, t, &m->g);
    double fed = 0;
    for (int i = 0; i < NUMBER_WIDTH; i++) fed += number_lane(g->loop.fed, i);
    if (!isfinite(fed)) group_end_unknown(g, job, t);
    system_signals_again(&g->r, t, g->at[g->now].y, m);
    signals_rates(&g->r, m, g->at[g->now].rate);
    looks_jump(&g->looks, g->going_mask);
    group_look(g, system_wanted(&g->r, t), m, t);
    if (g->m.method >= MARCH_RATTLE) {
        const march_problem problem = system_problem(&g->r);
        rattle_begin(&problem.rule, t, &g->body);
    }
}

/* Whether a sample is due, and nothing asks for the accelerations just before it: they are computed for the commands that it
 * brings, and those of a plain machine are finite where its pose, velocities and forces are. */
static inline int group_samples_plainly(const group *g) {
    const int asked = g->r.limits.kinds & (1 << LIMIT_ACCELERATION | LIMITS_OF_PLATFORM);

    return group_samples(g) && signals_plain(&g->r) && !asked;
}

/* all that the end of a step needs; returns how many rates of the state are there */
static inline int group_arrive(group *g, signals *m) {
    number *y = g->at[g->now].y, *rate = g->at[g->now].rate;

    if (group_samples_plainly(g)) {
        system_signals_before(&g->r, g->m.t1, y, m);
        coordinates_store(&m->rate, rate);
        return COORDINATES;
    }
    system_signals(&g->r, g->m.t1, y, m);
    signals_rates(&g->r, m, rate);
    return g->r.states;
}

/* one part of a step in all lanes; 1 where none goes on */
static inline int group_move(void *context, long long k, int part) {
    group_loop *l = context;
    group *g = l->g;
    const batch_job *job = l->job;
    const int projecting = job->simulation->constraints == GOUGH_PROJECTION;
    signals *m = &l->end;
    number raw[STATE_SIZE];
    const number residual = group_step(g, raw);
    const double t = g->m.t1;

    (void)part;
    coordinates x = coordinates_load(raw), v = coordinates_load(raw + COORDINATES);

    g->drift =
        number_larger(g->drift, projecting ? coordinates_project(&x, &v) : triad_violation(&x.q));
    g->now = 1 - g->now;
    coordinates_store(&x, g->at[g->now].y);
    coordinates_store(&v, g->at[g->now].y + COORDINATES);
    for (int i = MOTION; i < g->r.states; i++) g->at[g->now].y[i] = raw[i];
    const int rates = group_arrive(g, m);

    const number trouble = group_trouble(g, system_wanted(&g->r, t), m, rates, residual);
    double sum = 0;
    for (int i = 0; i < NUMBER_WIDTH; i++) sum += number_lane(trouble, i);
    if (sum > 0) group_inspect(g, job, trouble, residual, raw);
    if (group_going(g) == 0) return 1;
    group_look(g, system_wanted(&g->r, t), m, t);
    if (group_row_ends(g, job, k)) group_row_due(g, m);
    if (group_samples(g)) group_sample(g, job, m, t);
    return group_going(g) == 0;
}

static inline int group_advance(void *memory, const batch_job *job, long long from, long long to) {
    group *g = memory;
    group_loop l = {.g = g, .job = job};

    if (group_going(g) > 0) (void)march_fixed(&g->m, from, to, group_move, &l);
    return group_going(g);
}

static inline void group_finish(void *memory, const batch_job *job) {
    group *g = memory;

    looks_finish(&g->looks, g->going_mask);
    for (int i = 0; i < NUMBER_WIDTH; i++) {
        if (!g->going[i]) continue;
        gough_outcome *out = &job->outcomes[group_run(g, i)];
        out->cause = GOUGH_END_DONE;
        out->leg = 0;
        out->time = job->simulation->duration;
        group_write(g, job, &g->looks, i);
        group_end_lane(g, i);
    }
}

#endif
