/* The core in the page: a study that is stepped as gough_simulate() steps it, while gains, disturbances, the size and speed of
 * its program and a push of the hand change between the steps. The texts of the library, compiled here once more; nothing of
 * the equations or the steppers is written anew. */
#define NUMBER_DOUBLE
#include "reach.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "gough/units.h"
#include "run/forces_along.h"
#include "run/forward_run.h"

/* in place of simulate_double.c; the page has no quadruple precision, and live_begin() takes none */
const struct simulate_table simulate_double = {walk_run, forward_run};
const struct simulate_table simulate_quad = {NULL, NULL};

/* A number that a slider moves, and its passage from `from` since time `since` to `to`. */
typedef struct {
    double from, to, since;
} setting;

/* The module holds one study; this is it. */
static struct {
    double *input; /* the flat model; recorded motion stays in it */
    size_t count;
    void *memory;
    gough_model model;
    gough_simulation study; /* how the study is run */
    int begun;

    gough_control control;
    setting amplitude, frequency;
    double phase; /* the program's own time at frequency.since */
    double disturbance;
    vector push;
    double passage; /* how long a setting takes */

    gough_simulation options; /* how it is stepped */
    forward d;
    appointments program,
        disturbances; /* under the sliders: of the program in its own time, and of the rest */
    dop853 work;
    gough_end end;
    double origin; /* time from which steps are counted: t = origin + steps·step */
    double step;
    long long steps;
    double goal;       /* time to which live_advance() has been asked */
    int seen;          /* the row was looked at since the last step */
    gough_units units; /* of sentences */

    double row[GOUGH_COLUMNS], pose[6];
    char message[500];
    double *table;
    size_t rows, room;
} live;

/* more than a page could want of one call, of a live run, or of a table: a second's steps, a million
 * durations of the study, 256 MiB of its input, 512 MiB of rows */
static const double most_steps = 1e5, most_durations = 1e6;
static const size_t most_input = (size_t)1 << 25, most_room = (size_t)1 << 20;

/* of delay: less than a hundred */
static const double most_periods = 99;

static void say(const char *sentence) { strncpy(live.message, sentence, sizeof live.message - 1); }

/* ---- the program under its sliders ---- */

/* a setting on its way, (motion-3) */
static jet setting_at(const setting *s, real t) {
    const jet way = jet_smooth_step((jet){(t - s->since) / live.passage, 1 / live.passage, 0});
    jet value = jet_scale(s->to - s->from, way);

    value.v = value.v + s->from;
    return value;
}

/* The program's own time: the integral of the frequency, which over the passage adds that of (motion-3), 5/2 s⁴ − 3 s⁵ + s⁶ */
static jet clock_at(real t) {
    const setting *f = &live.frequency;
    const jet rate = setting_at(f, t);
    const real all = t - f->since, s = all / live.passage, past = s < 1 ? s : 1;
    const real rise = past * past * past * past * ((real)2.5 + past * (past - 3));
    const real gained = live.passage * rise + (s > 1 ? all - live.passage : 0);

    return (jet){live.phase + f->from * all + (f->to - f->from) * gained, rate.v, rate.d};
}

/* In place of wanted_evaluate(): the program larger and faster, the disturbances larger, the push added. */
static void live_stage(struct system *r, real t) {
    const jet clock = clock_at(t), amplitude = setting_at(&live.amplitude, t);
    const real factor = live.disturbance;
    jet component[GOUGH_COMPONENTS];
    number program[LEGS], shared[LEGS];
    wanted *s = &r->now;
    const int sound = r->fault.what == NULL;

    wanted_components(r, clock.v, component);
    if (sound && r->fault.what) r->fault.time = t;
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        const jet *at = &component[c];
        component[c] = jet_multiply(amplitude, jet_chain(clock, at->v, at->d, at->dd));
    }
    wanted_program(r, component, s);
    wanted_external(r, t, s);
    if (r->solves) {
        wanted_forces(r, r->share ? factor * wanted_vertical(r, t) : number_of(0), s);
    }

    for (int v = 0; v < LEGS; v++) {
        program[v] = s->force[v];
        shared[v] = s->shake[v];
        s->force[v] = s->shake[v] = number_of(0);
    }
    wanted_disturb(r, t, s);
    if (r->noise.present) noise_add(r, t, s);
    for (int v = 0; v < LEGS; v++) {
        s->force[v] = program[v] + factor * s->force[v];
        s->shake[v] = shared[v] + factor * s->shake[v];
    }
    s->push = along(live.push, factor, s->push);
    s->turn = scale(factor, s->turn);
}

static int is_one(const setting *s) {
    return !(s->from < 1 || s->from > 1 || s->to < 1 || s->to > 1);
}
static int pushed(void) { return norm(live.push) > 0; }

/* whether the program's own time is the run's: a millionth of a millionth of it is nobody's */
static int in_phase(void) {
    return fabs(live.phase - live.frequency.since) <= 1e-12 * live.frequency.since;
}

/* whether nothing was changed but gains: then each stage is that of a run, to the last bit */
static int as_given(void) {
    return is_one(&live.amplitude) && is_one(&live.frequency) && in_phase() && !pushed() &&
           !(live.disturbance < 1 || live.disturbance > 1);
}

/* ---- steps ---- */

static void set_up_run(void) {
    const system_lane lane = {&live.model.machine, &live.control, &live.model.disturbance,
                              live.model.disturbance.noise.run, live.control.sampling.run};
    struct system *r = &live.d.r;
    number held[LEGS], measured[LEGS], unmet[LEGS];

    memcpy(held, r->held, sizeof held);
    memcpy(measured, r->measured, sizeof measured);
    memcpy(unmet, r->unmet, sizeof unmet);
    system_begin(r, &live.model.motion, &live.options, &lane);
    memcpy(r->held, held, sizeof held);
    memcpy(r->measured, measured, sizeof measured);
    memcpy(r->unmet, unmet, sizeof unmet);
    if (as_given()) return;
    r->provide = live_stage;
    r->loaded = r->loaded || pushed();
}

/* after a change of settings; before the first step the run begins anew, as they may change where it starts */
static void settle(void) {
    forward *d = &live.d;
    const int solved = d->r.solves;

    if (!live.begun || live.end.cause != GOUGH_END_DONE) return;
    if (!(d->t > 0)) {
        const vector push = live.push;
        live_restart();
        live.push = push;
        if (!pushed() || live.end.cause != GOUGH_END_DONE) return;
    }
    set_up_run();
    if (d->r.solves != solved) {
        d->side.program = limits_sign(system_wanted(&d->r, d->t)->singularity.determinant);
    }
    forward_refresh(&live.d);
}

/* whether the limit of an end is an angle, or one in time */
static int end_turns(const gough_end *end) {
    return end->component > GOUGH_ROLL || end->cause == GOUGH_END_BASE_SWING ||
           end->cause == GOUGH_END_TOP_SWING;
}

/* the sentence of an end in the units that the page has named */
static void say_end(gough_end said) {
    const gough_units *u = &live.units;
    const gough_cause cause = said.cause;
    const int turns = end_turns(&said);
    gough_unit unit = turns ? GOUGH_UNIT_ANGLE : GOUGH_UNIT_LENGTH;
    if (cause == GOUGH_END_LEG_FORCE) unit = GOUGH_UNIT_FORCE;
    if (cause == GOUGH_END_LEG_SPEED || cause == GOUGH_END_PLATFORM_SPEED)
        unit = turns ? GOUGH_UNIT_ANGULAR_SPEED : GOUGH_UNIT_SPEED;
    if (cause == GOUGH_END_LEG_ACCELERATION || cause == GOUGH_END_PLATFORM_ACCELERATION)
        unit = turns ? GOUGH_UNIT_ANGULAR_ACCELERATION : GOUGH_UNIT_ACCELERATION;
    said.time *= gough_unit_factor(u, GOUGH_UNIT_TIME);
    said.limit *= gough_unit_factor(u, unit);
    gough_end_say(&said,
                  &(gough_end_words){.length = gough_unit_word(u, GOUGH_UNIT_LENGTH),
                                     .speed = gough_unit_word(u, GOUGH_UNIT_SPEED),
                                     .acceleration = gough_unit_word(u, GOUGH_UNIT_ACCELERATION),
                                     .force = gough_unit_word(u, GOUGH_UNIT_FORCE),
                                     .time = gough_unit_word(u, GOUGH_UNIT_TIME),
                                     .angle = gough_unit_word(u, GOUGH_UNIT_ANGLE),
                                     .angular_speed = gough_unit_word(u, GOUGH_UNIT_ANGULAR_SPEED),
                                     .angular_acceleration =
                                         gough_unit_word(u, GOUGH_UNIT_ANGULAR_ACCELERATION)});
    say(said.message);
}

static void conclude(void) { say_end(live.end); }

/* when the program's own time comes to `inner`, between two times */
static real clock_reaches(real inner, real low, real high) {
    for (int i = 0; i < FORWARD_HALVINGS; i++) {
        const real middle = (low + high) / 2;
        if (clock_at(middle).v < inner) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return high;
}

/* where the part of a step ends that begins at t: as in a run, or in the program's own time; and where commands change */
static double part_end(void *clock, double t, double end, double h) {
    (void)clock;
    if (live.d.r.traits & SAMPLED) end = fmin(end, sample_clock_next(&live.d.loop.clock));
    if (as_given()) return appointments_part(&live.d.when, t, end, h);
    const real stop = appointments_part(&live.disturbances, t, end, h);
    const real from = clock_at(t).v, to = clock_at(stop).v;
    if (!(to > from)) return stop;
    const real inner = appointments_part(&live.program, from, to, to - from);
    return inner < to ? clock_reaches(inner, t, stop) : stop;
}

/* one part of a step; 1 where the motion ends */
static int move(void *context, long long k, int part) {
    forward *d = context;
    real until;

    (void)k, (void)part;
    (void)forward_go(d, &live.work, NULL);
    d->t = d->m.t1;
    if (forward_settle(d, 0, &until) == GOUGH_OK) {
        if (forward_sample(d) == GOUGH_OK) return 0;
        until = d->t;
    }
    forward_return(d, until);
    conclude();
    return 1;
}

/* one step as a run takes it; whether the motion goes on */
static int step_on(void) {
    march *m = &live.d.m;

    m->origin = live.origin;
    m->length = live.step;
    m->until = HUGE_VAL;
    m->part = part_end;
    const int ended = march_fixed(m, live.steps, live.steps + 1, move, &live.d);
    live.steps++;
    return !ended;
}

int live_advance(double duration, double step) {
    forward *d = &live.d;

    if (!live.begun || !(step > 0) || !(duration >= 0) || !(duration / step <= most_steps) ||
        !(live.goal + duration <= most_durations * live.study.duration)) {
        return GOUGH_END_INVALID;
    }
    if (live.end.cause != GOUGH_END_DONE) return (int)live.end.cause;
    if (step < live.step || step > live.step) {
        live.origin = d->t;
        live.steps = 0;
        live.step = step;
    }
    live.goal += duration;
    if (live.seen) d->drift = 0;
    live.seen = 0;
    while (live.origin + (double)(live.steps + 1) * step <= live.goal + 1e-9 * step) {
        if (!step_on()) break;
    }
    return (int)live.end.cause;
}

/* ---- beginning ---- */

double *live_input(size_t count) {
    live.begun = 0;
    free(live.input);
    live.count = 0;
    live.input = count > 0 && count <= most_input ? malloc(count * sizeof(double)) : NULL;
    if (live.input) live.count = count;
    return live.input;
}

/* the state at t = 0 with the program as large and as fast as it is set; where it starts follows from that */
static void start(void) {
    gough_motion *motion = &live.model.motion;
    const gough_motion given = *motion;
    const simulate_parts parts = {motion,
                                  &live.model.machine,
                                  &live.control,
                                  &live.model.disturbance,
                                  &live.model.initial,
                                  live.model.disturbance.noise.run,
                                  live.control.sampling.run};

    forward_open(&live.d, &parts, &live.options, NULL, NULL, &live.end);
    if (!is_one(&live.amplitude) || !is_one(&live.frequency)) {
        motion->amplitude = live.amplitude.to * (given.scaled ? given.amplitude : 1);
        motion->frequency = live.frequency.to * (given.scaled ? given.frequency : 1);
        motion->scaled = true;
    }
    forward_start(&live.d);
    loop_begin(&live.d.r, &live.d.loop, 0, live.d.y); /* whatever steps the study has */
    *motion = given;
    appointments_begin(&live.program, motion, NULL, NULL, 0, live.options.duration,
                       live.options.output_step);
    appointments_begin(&live.disturbances, NULL, &live.model.disturbance, &live.model.machine, 0,
                       live.options.duration, live.options.output_step);
    set_up_run();
}

void live_restart(void) {
    if (live.input == NULL || !live.begun) return;
    live.push = (vector){0, 0, 0};
    live.amplitude = (setting){live.amplitude.to, live.amplitude.to, 0};
    live.frequency = (setting){live.frequency.to, live.frequency.to, 0};
    live.phase = live.origin = live.goal = 0;
    live.steps = live.seen = 0;
    live.end = (gough_end){.cause = GOUGH_END_DONE};
    live.message[0] = '\0';
    start();
    live.step = 0;
    if (forward_begin(&live.d) != GOUGH_OK) {
        live.d.r.fault.what = NULL;
        conclude();
    } else {
        forward_refresh(&live.d);
    }
}

int live_begin(void) {
    gough_error error = {.message = ""};
    size_t bytes;
    gough_status status;

    live.begun = 0;
    if (!(live.units.length > 0)) live_set_units(-1, -1, -1, -1, -1);
    free(live.memory);
    live.memory = NULL;
    bytes = live.input ? gough_model_flat_memory(live.input, live.count) : 0;
    if (bytes > 0 && (live.memory = malloc(bytes)) == NULL) {
        say("there is not enough memory for the recorded motion");
        return GOUGH_ERROR_FILE;
    }
    status = gough_model_unflatten(&live.model, &live.study, live.memory, live.input, live.count,
                                   &error);
    say(error.message);
    if (status != GOUGH_OK) return (int)status;

    live.study.precision = GOUGH_DOUBLE;
    live.options = live.study;
    if (live.study.method != GOUGH_RK4) live.options.method = GOUGH_DOP853;
    if (live.study.method >= GOUGH_RATTLE2) live.options.constraints = GOUGH_PROJECTION;
    live.control = live.model.control;
    live.amplitude = live.frequency = (setting){1, 1, 0};
    live.disturbance = 1;
    live.passage = live.model.machine.gravity_magnitude > 0
                       ? sqrt(live.model.machine.base_radius / live.model.machine.gravity_magnitude)
                       : 1;
    live.begun = 1;
    live_restart();
    return GOUGH_OK;
}

const char *live_message(void) { return live.message; }

const gough_model *live_model(void) { return live.begun ? &live.model : NULL; }

/* ---- settings ---- */

void live_set_stiffness(double stiffness) {
    if (!isfinite(stiffness)) return;
    for (int v = 0; v < LEGS; v++) live.control.stiffness[v] = fmax(stiffness, 0);
    settle();
}

void live_set_damping(double damping) {
    if (!isfinite(damping)) return;
    for (int v = 0; v < LEGS; v++) live.control.damping[v] = fmax(damping, 0);
    settle();
}

/* the controller samples at other times */
static void retime(double period, double delay) {
    gough_sampling *s = &live.control.sampling;
    forward *d = &live.d;

    s->period = fmax(period, 0);
    s->delay = fmin(fmax(delay, 0), most_periods * s->period);
    s->jitter = 0;
    settle();
    if (!live.begun || live.end.cause != GOUGH_END_DONE) return;
    if (!(d->r.traits & SAMPLED) || !(d->t > 0)) return;
    loop_resume(&d->r, &d->loop, d->t, d->y);
    forward_refresh(d);
}

void live_set_period(double period) {
    if (isfinite(period)) retime(period, live.control.sampling.delay);
}

void live_set_delay(double delay) {
    if (isfinite(delay)) retime(live.control.sampling.period, delay);
}

void live_set_feedforward(int feedforward) {
    live.control.feedforward = feedforward != 0;
    settle();
}

void live_set_disturbance(double factor) {
    if (!isfinite(factor)) return;
    live.disturbance = factor;
    settle();
}

/* a setting on a new way from where it is; whether that is another way than before */
static int redirect(setting *s, double to) {
    if (!isfinite(to) || !(to < s->to || to > s->to)) return 0;
    *s = (setting){setting_at(s, live.d.t).v, to, live.d.t};
    return 1;
}

void live_set_amplitude(double factor) {
    if (redirect(&live.amplitude, factor)) settle();
}

void live_set_frequency(double factor) {
    const double phase = clock_at(live.d.t).v;

    if (!isfinite(factor) || !redirect(&live.frequency, fmax(factor, 0))) return;
    live.phase = phase;
    settle();
}

void live_push(double x, double y, double z) {
    if (!isfinite(x) || !isfinite(y) || !isfinite(z)) return;
    live.push = (vector){x, y, z};
    settle();
}

/* ---- what there is to see ---- */

const double *live_row(void) {
    forward *d = &live.d;
    signals m;

    if (!live.begun) return NULL;
    system_signals(&d->r, d->t, d->y, &m);
    row_fill(&d->r, system_wanted(&d->r, d->t), d->t, &m, 1, ROW_WHOLE, d->drift, live.row);
    live.seen = 1;
    return live.row;
}

const double *live_program(void) {
    forward *d = &live.d;

    if (!live.begun) return NULL;
    row_pose(&d->r.h, (int)live.model.motion.order, &system_wanted(&d->r, d->t)->x[0], live.pose, 0,
             3);
    return live.pose;
}

int live_columns(void) { return GOUGH_COLUMNS; }

const char *live_column_name(int column) {
    const gough_column_info *info = gough_column(column);
    return info ? info->name : NULL;
}

const char *live_cause_name(int cause) { return gough_cause_name((gough_cause)cause); }

int live_end_leg(void) { return live.end.leg; }
int live_end_legs(void) { return (int)live.end.legs; }
void live_set_units(int length, int force, int mass, int angle, int time) {
    const int place[] = {length, force, mass, angle, time};
    live.units = gough_units_si();
    for (int b = 0; b < GOUGH_BASE_UNITS; b++) {
        const char *word = gough_unit_choice((gough_base_unit)b, place[b]);
        if (word)
            gough_units_choose(&live.units, (gough_base_unit)b, word);
        else
            live.units.dimensionless = true;
    }
}

/* ---- a whole run ---- */

static int keep(void *context, const gough_row *row) {
    (void)context;
    if (live.rows == live.room) {
        const size_t room = live.room ? 2 * live.room : 512;
        double *table = room > most_room ? NULL : realloc(live.table, room * sizeof row->value);
        if (table == NULL) return 1;
        live.table = table;
        live.room = room;
    }
    memcpy(live.table + live.rows++ * GOUGH_COLUMNS, row->value, sizeof row->value);
    return 0;
}

int live_run(void) {
    gough_error error = {.message = ""};
    gough_end end;

    live.rows = 0;
    if (!live.begun) return GOUGH_END_INVALID;
    gough_simulate(&live.model, &live.study, keep, NULL, &end, &error);
    say(error.message);
    if (end.message[0]) say_end(end);
    if (end.cause == GOUGH_END_STOPPED) {
        say("there is not enough memory for the rows of the run");
        return GOUGH_END_INVALID;
    }
    return error.message[0] && end.cause == GOUGH_END_DONE ? GOUGH_END_INVALID : (int)end.cause;
}

size_t live_run_rows(void) { return live.rows; }
const double *live_run_data(void) { return live.table; }
