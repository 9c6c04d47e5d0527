/* What one lane does alone: groups of a single run, beginnings and ends as in gough_simulate(), recorded stages, adaptive runs. */
#define NUMBER_DOUBLE
#include <string.h>

#include "batch/lane_runs.h"
#include "gough/dynamics.h"
#include "run/forward_run.h"

const struct batch_width batch_width_1 = {1, (sizeof(group) + 63) / 64 * 64, group_begin,
                                          group_advance, group_finish};

static simulate_parts parts_of(const batch_job *job, size_t which) {
    const gough_batch_run *r = &job->runs[which];

    return (simulate_parts){job->motion, r->machine, r->control,        r->disturbance,
                            r->initial,  r->number,  r->sampling_number};
}

/* ---- outcomes from rows ---- */

typedef struct {
    const gough_machine *machine;
    gough_summary summary;
    gough_outcome *outcome;
    int summed; /* the run fills the summary itself, between rows too */
} listener;

static int listen(void *context, const gough_row *row) {
    listener *l = context;
    gough_outcome *out = l->outcome;

    if (!l->summed) gough_summary_add(&l->summary, l->machine, row);
    out->rows += 1;
    for (int c = 0; c < 3; c++) {
        out->position[c] = row->value[GOUGH_X + c];
        out->angles[c] = row->value[GOUGH_ROLL_ANGLE + c];
        out->velocity[c] = row->value[GOUGH_VX + c];
        out->angular_velocity[c] = row->value[GOUGH_WX + c];
    }
    return 0;
}

/* what holds the legs at rest at home, under the external loads as they are at t = 0 */
static void put_holding(const gough_machine *machine, double sizing[GOUGH_SIZINGS]) {
    const gough_state home = gough_state_home(machine);
    double force[LEGS], low[LEGS], high[LEGS];
    gough_wrench known;

    if (gough_external_wrench(machine, &home, 0, &known) != GOUGH_OK ||
        gough_holding_forces(machine, &home, &known, force, low, high) != GOUGH_OK)
        return;
    for (int v = 0; v < LEGS; v++) {
        sizing[GOUGH_SIZING_HOLDS_FROM] = fmin(sizing[GOUGH_SIZING_HOLDS_FROM], low[v]);
        sizing[GOUGH_SIZING_HOLDS_TO] = fmax(sizing[GOUGH_SIZING_HOLDS_TO], high[v]);
    }
}

static void listen_begin(listener *l, const batch_job *job, size_t which) {
    l->machine = job->runs[which].machine;
    l->outcome = &job->outcomes[which];
    l->summed = 0;
    *l->outcome = (gough_outcome){.cause = GOUGH_END_DONE};
    for (int i = 0; i < GOUGH_SIZINGS; i++) l->outcome->sizing[i] = NAN;
    if (job->sizing) put_holding(l->machine, l->outcome->sizing);
    gough_summary_begin(&l->summary);
    l->summary.brief_ = !job->sizing; /* without it an outcome has neither */
    l->summary.order = job->motion->order;
}

void batch_put_power(gough_outcome *outcome, double least, double greatest) {
    outcome->power_least = least;
    outcome->power_greatest = greatest;
    outcome->power = greatest > 0 ? greatest : 0;
}

/* what sizes the legs, of all six */
static void put_sizing(const gough_summary *summary, double sizing[GOUGH_SIZINGS]) {
    static const struct {
        int to;
        size_t from;
        int sums; /* 1: the sum; −1: the least; 0: the greatest */
    } of[] = {{GOUGH_SIZING_LENGTH_LEAST, offsetof(gough_leg_summary, length_min), -1},
              {GOUGH_SIZING_LENGTH_GREATEST, offsetof(gough_leg_summary, length_max), 0},
              {GOUGH_SIZING_SWING_BASE, offsetof(gough_leg_summary, swing_base), 0},
              {GOUGH_SIZING_SWING_TOP, offsetof(gough_leg_summary, swing_top), 0},
              {GOUGH_SIZING_RMS_FORCE, offsetof(gough_leg_summary, rms_force), 0},
              {GOUGH_SIZING_TOP_LOAD, offsetof(gough_leg_summary, top_load), 0},
              {GOUGH_SIZING_BASE_LOAD, offsetof(gough_leg_summary, base_load), 0},
              {GOUGH_SIZING_SIDE_LOAD, offsetof(gough_leg_summary, side_load), 0},
              {GOUGH_SIZING_FRICTION_LOSS, offsetof(gough_leg_summary, friction_loss), 1},
              {GOUGH_SIZING_RETURNED_ENERGY, offsetof(gough_leg_summary, returned_energy), 1}};

    for (size_t i = 0; i < sizeof of / sizeof of[0]; i++) {
        double all = of[i].sums > 0 ? 0 : NAN;
        for (int v = 0; v < LEGS; v++) {
            double x;
            memcpy(&x, (const char *)&summary->leg[v] + of[i].from, sizeof x);
            all = of[i].sums > 0 ? all + x : of[i].sums < 0 ? fmin(all, x) : fmax(all, x);
        }
        sizing[of[i].to] = all;
    }
}

static void listen_end(listener *l, const gough_end *end) {
    gough_outcome *out = l->outcome;

    out->cause = end->cause;
    out->leg = end->leg;
    out->time = end->time;
    gough_summary_end(&l->summary);
    if (l->summary.rows == 0) return;
    out->position_deviation = l->summary.position_deviation;
    out->angle_deviation = l->summary.angle_deviation;
    out->drift = l->summary.drift;
    double least = HUGE_VAL, greatest = -HUGE_VAL;
    for (int v = 0; v < LEGS; v++) {
        const gough_leg_summary *leg = &l->summary.leg[v];
        out->force = fmax(out->force, fmax(fabs(leg->force_min), fabs(leg->force_max)));
        out->speed = fmax(out->speed, leg->speed);
        least = fmin(least, leg->power_min);
        greatest = fmax(greatest, leg->power_max);
        out->energy += leg->energy;
    }
    batch_put_power(out, least, greatest);
    if (!l->summary.brief_) put_sizing(&l->summary, out->sizing);
}

void batch_alone(const batch_job *job, size_t which) {
    const simulate_parts parts = parts_of(job, which);
    const struct simulate_table *table = simulate_table_of(job->simulation->precision);
    gough_simulation simulation = *job->simulation;
    gough_end end = {.cause = GOUGH_END_DONE};
    listener l;

    listen_begin(&l, job, which);
    simulation.summary = &l.summary;
    l.summed = 1;
    if (job->forces) {
        (void)table->forces(&parts, &simulation, listen, &l, NULL, NULL, &end);
    } else {
        (void)table->simulate(&parts, &simulation, listen, &l, &end);
    }
    listen_end(&l, &end);
}

/* ---- beginnings and ends ---- */

int batch_start(const batch_job *job, size_t which, double state[STATE_SIZE], double side[2]) {
    const simulate_parts parts = parts_of(job, which);
    gough_end end = {.cause = GOUGH_END_DONE};
    listener l;
    forward d;

    listen_begin(&l, job, which);
    forward_open(&d, &parts, job->simulation, listen, &l, &end);
    forward_start(&d);
    d.side = (limits_side){1, 1};
    const gough_status status = forward_begin(&d);
    for (int i = 0; i < d.r.states; i++) state[i] = d.y[i];
    side[0] = d.side.pose;
    side[1] = d.side.program;
    if (status == GOUGH_OK) return 1;
    listen_end(&l, &end);
    return 0;
}

/* a look at the moment that ends a run, as forward_rows() takes one */
static void look_at_end(forward *d, real until, batch_step *step) {
    number y[STATE_SIZE];
    signals m;

    step->until = until;
    step->looked = until > d->m.t0;
    if (!step->looked) return;
    for (int i = 0; i < d->r.states; i++) y[i] = d->y[i];
    if (until < d->t) forward_inside(d, (until - d->m.t0) / d->m.h, y);
    const wanted *s = system_whole(&d->r, until);
    system_signals(&d->r, until, y, &m);
    looks_fill(s, &m, onto(&d->r.h.axes, d->r.h.center), step->look);
    sizing_fill(&d->r, &m, step->sizing);
    for (int c = 0; c < LOOKS_COLUMNS; c++) step->looked &= isfinite(step->look[c]) != 0;
}

int batch_locate(const batch_job *job, size_t which, batch_step *step) {
    const simulate_parts parts = parts_of(job, which);
    gough_outcome *out = &job->outcomes[which];
    gough_end end = {.cause = GOUGH_END_DONE};
    real until;
    forward d;

    forward_open(&d, &parts, job->simulation, NULL, NULL, &end);
    d.side = (limits_side){step->side[0], step->side[1]};
    d.m.t0 = step->t0;
    d.t = step->t;
    d.m.h = step->h;
    d.row = d.rows = 0;
    d.drift = 0;
    for (int i = 0; i < d.r.states; i++) {
        d.y0[i] = step->y0[i];
        d.rate0[i] = step->rate0[i];
        d.raw[i] = step->raw[i];
    }
    for (int v = 0; v < LEGS; v++) d.r.held[v] = step->held[v];
    if (forward_check(&d, step->residual, &until) == GOUGH_OK) return 0;
    look_at_end(&d, until, step);
    out->cause = end.cause;
    out->leg = end.leg;
    out->time = end.time;
    return 1;
}

void batch_unknown(const batch_job *job, size_t which, double t) {
    gough_outcome *out = &job->outcomes[which];
    gough_end end;

    limits_no_leg(&end, GOUGH_END_NOT_FINITE, t);
    out->cause = end.cause;
    out->leg = end.leg;
    out->time = end.time;
}

void batch_last_row(const batch_job *job, size_t which, const double state[STATE_SIZE]) {
    gough_outcome *out = &job->outcomes[which];
    const coordinates x = coordinates_load(state), rate = coordinates_load(state + COORDINATES);
    real value[GOUGH_COLUMNS];
    hexapod h;

    hexapod_of_machine(&h, job->runs[which].machine);
    row_pose(&h, (int)job->motion->order, &x, value, GOUGH_X, GOUGH_ROLL_ANGLE);
    row_rates(&h, &x, &rate, value, GOUGH_VX, GOUGH_WX);
    for (int c = 0; c < 3; c++) {
        out->position[c] = value[GOUGH_X + c];
        out->angles[c] = value[GOUGH_ROLL_ANGLE + c];
        out->velocity[c] = value[GOUGH_VX + c];
        out->angular_velocity[c] = value[GOUGH_WX + c];
    }
}

/* ---- recorded stages ---- */

static void record_stage(stage_tape *tape, double t, tape_record *record) {
    struct system *r = tape->recorder;
    jet component[GOUGH_COMPONENTS];
    wanted s;

    record->time = t;
    wanted_components(r, t, component);
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        record->component[c][0] = component[c].v;
        record->component[c][1] = component[c].d;
        record->component[c][2] = component[c].dd;
    }
    wanted_program(r, component, &s);
    wanted_external(r, t, &s);
    record->vertical = r->share ? wanted_vertical(r, t) : 0;
    if (tape->machine_shared && r->solves) wanted_forces(r, record->vertical, &s);
    for (int v = 0; v < LEGS; v++) {
        record->force[v] = s.force[v];
        record->shake[v] = s.shake[v];
        record->length[v] = s.program.length[v];
        record->rate[v] = s.program.rate[v];
        s.force[v] = s.shake[v] = 0; /* what the disturbances add comes by itself */
    }
    coordinates_store(&s.x[0], record->pose);
    record->determinant = s.singularity.determinant;
    record->pivot_ratio = s.singularity.pivot_ratio;
    wanted_disturb(r, t, &s);
    for (int v = 0; v < LEGS; v++) record->leg[v] = wanted_shake(r, &s)[v];
    vector_store(s.push, record->push);
    vector_store(s.turn, record->turn);
}

size_t batch_recorder_size(void) { return (sizeof(struct system) + 63) / 64 * 64; }

void batch_recorder_begin(stage_tape *tape, const batch_job *job, void *recorder) {
    struct system *r = recorder;
    const gough_batch_run *one = &job->runs[0];
    const system_lane lane = {one->machine, one->control, one->disturbance, one->number,
                              one->sampling_number};

    system_begin(r, job->motion, job->simulation, &lane);
    tape->recorder = r;
    tape->write = record_stage;
}
