/* All that depends on time alone, found once a stage and then the same for every lane; and the equations of motion under it.
 * Theory: docs/theory/control.md. */
#ifndef GOUGH_SIMULATE_STAGE_H
#define GOUGH_SIMULATE_STAGE_H

#include "base/limits.h"
#include "dynamics/forward.h"
#include "dynamics/inverse.h"
#include "dynamics/machine.h"
#include "dynamics/program.h"
#include "dynamics/state.h"
#include "gough/random.h"
#include "gough/simulate.h"
#include "integrate/march.h"
#include "kernel/law.h"
#include "kernel/real.h"
#include "model/appointments.h"

/* What the program and the disturbances are at one time. */
typedef struct {
    coordinates x[3];        /* the program and its derivatives */
    legs program;            /* l^p, l̇^p */
    number force[LEGS];      /* F^p, if fed forward, and what disturbs the legs */
    vector push, turn;       /* force at the centre of mass and moment on the load, base axes */
    elimination singularity; /* of the six equations of F^p; determinant 1 where none were solved */
} stage;

/* What is not finite: a sentence's subject, or NULL. */
typedef struct {
    const char *what;
    real time;
} stage_fault;

/* What one lane of a run has of its own. */
typedef struct {
    const gough_machine *machine;
    const gough_control *control;
    const gough_disturbance *disturbance;
    uint64_t number; /* of the run, for its noise */
} run_lane;

/* the noise between two knots: four coefficients for each leg, force and moment along three axes */
enum { NOISE_CHANNELS = LEGS + 6 };
typedef struct {
    int present, fresh;
    real knot; /* the one before */
    number coefficient[NOISE_CHANNELS][4];
} run_noise;

typedef struct run {
    const gough_motion *motion;
    const gough_simulation *options;
    double height; /* of home, the same in every lane */
    run_lane lane[NUMBER_WIDTH];
    hexapod h;
    number G[LEGS], D[LEGS];
    int feeds;          /* F^p is fed forward */
    int solves;         /* the six equations of the program are needed */
    int damped;         /* some D > 0 */
    int share;          /* a vertical force is shared by the legs */
    int loaded;         /* force or moment on the load */
    int shaken[LEGS];   /* leg disturbances present */
    number alpha, beta; /* Baumgarte, or 0 */
    number least, most, fastest,
        strongest; /* reciprocals of the legs' limits, 0 where there is none */
    void (*replay)(struct run *r, real t); /* fills `now` from what another run recorded, or NULL */
    void *tape;                            /* its context */
    int partial; /* what is replayed lacks the program's pose and the legs' directions in it */

    run_noise noise;
    int limited[3]; /* some lane has a greatest length, speed, force */
    stage now;      /* the stage at `time`, kept since steppers come back to it */
    real time;
    int valid;
    long long evaluations; /* of the equations of motion */
    stage_fault fault;
} run;

/* gains, limits and disturbances of a lane */
static inline void run_add_lane(run *r, int lane) {
    const gough_control *control = r->lane[lane].control;
    const gough_disturbance *d = r->lane[lane].disturbance;
    const gough_platform *p = &r->lane[lane].machine->platform;
    const double nothing = leg_no_length * r->lane[lane].machine->base_radius;

    number_put(&r->least, lane, 1 / (real)(p->length_min > nothing ? p->length_min : nothing));
    number_put(&r->most, lane, 1 / (real)p->length_max);
    number_put(&r->fastest, lane, 1 / (real)p->speed_max);
    number_put(&r->strongest, lane, 1 / (real)p->force_max);

    r->limited[0] |= p->length_max < INFINITY;
    r->limited[1] |= p->speed_max < INFINITY;
    r->limited[2] |= p->force_max < INFINITY;

    for (int v = 0; v < LEGS; v++) {
        number_put(&r->G[v], lane, control->stiffness[v]);
        number_put(&r->D[v], lane, control->damping[v]);
        r->damped = r->damped || control->damping[v] > 0;
        r->shaken[v] = r->shaken[v] || !gough_formula_is_zero(&d->leg_force[v]);
    }
    r->noise.present |= d->noise.leg_force > 0 || d->noise.force > 0 || d->noise.moment > 0;
    r->loaded |= d->noise.force > 0 || d->noise.moment > 0;
    r->share = r->share || !gough_formula_is_zero(&d->vertical_force);
    for (int c = 0; c < 3; c++) {
        r->loaded = r->loaded || !gough_formula_is_zero(&d->force[c]) ||
                    !gough_formula_is_zero(&d->moment[c]);
    }
}

/* Lanes that move by one motion, with one height of home and one choice of feed-forward; each has its own machine otherwise,
 * gains and disturbances. */
static inline void run_begin(run *r, const gough_motion *motion, const gough_simulation *options,
                             const run_lane lane[NUMBER_WIDTH]) {
    r->motion = motion;
    r->options = options;
    r->height = lane[0].machine->platform.height;
    r->damped = r->share = r->loaded = 0;
    r->noise.present = r->noise.fresh = 0;
    for (int kind = 0; kind < 3; kind++) r->limited[kind] = 0;
    for (int v = 0; v < LEGS; v++) r->shaken[v] = 0;
    for (int i = 0; i < NUMBER_WIDTH; i++) {
        r->lane[i] = lane[i];
        hexapod_put_machine(&r->h, i, lane[i].machine);
        run_add_lane(r, i);
    }
    r->feeds = lane[0].control->feedforward;
    r->solves = r->feeds || r->share;
    r->alpha = number_of(options->constraints == GOUGH_BAUMGARTE ? options->baumgarte[0] : 0);
    r->beta = number_of(options->constraints == GOUGH_BAUMGARTE ? options->baumgarte[1] : 0);
    r->replay = NULL;
    r->tape = NULL;
    r->partial = 0;
    r->valid = 0;
    r->evaluations = 0;
    r->fault = (stage_fault){NULL, 0};
}

/* F^p alone, whatever control and disturbances the study has: the direct problem */
static inline void run_program_only(run *r) {
    r->feeds = r->solves = 1;
    r->share = r->loaded = r->noise.present = 0;
    for (int v = 0; v < LEGS; v++) r->shaken[v] = 0;
}

static inline void run_blame(run *r, const char *what, real t) {
    if (r->fault.what == NULL || t < r->fault.time) r->fault = (stage_fault){what, t};
}

/* the component that is not finite, or NULL */
static inline const char *run_flaw(const jet component[GOUGH_COMPONENTS]) {
    static const char *const name[GOUGH_COMPONENTS] = {
        "motion.surge", "motion.sway", "motion.heave", "motion.roll", "motion.pitch", "motion.yaw"};

    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        if (!real_finite(component[c].v + component[c].d + component[c].dd)) return name[c];
    }
    return NULL;
}

/* jets of the program at t, checked */
static inline void run_components(run *r, real t, jet component[GOUGH_COMPONENTS]) {
    motion_components(r->motion, t, component);
    const char *flaw = run_flaw(component);
    if (flaw) run_blame(r, flaw, t);
}

/* the formula of a disturbance, by its place in gough_disturbance, in every lane */
static inline number run_disturbance(run *r, size_t place, const char *what, real t) {
    number sum = number_of(0);

    for (int i = 0; i < NUMBER_WIDTH; i++) {
        const gough_formula *formula =
            (const gough_formula *)(const void *)((const char *)r->lane[i].disturbance + place);
        const real value = formula_jet(formula, t).v;
        if (!real_finite(value)) run_blame(r, what, t);
        number_put(&sum, i, value);
    }
    return sum;
}

/* F^p, and the share of each leg in a vertical force: solutions of the same six equations, (law-2) */
static inline void run_program_forces(run *r, number vertical, stage *s) {
    const number zero = number_of(0);
    const vector none = {zero, zero, zero};
    number wrench[2][6];
    int count = 0, program = -1, share = -1;

    if (r->feeds) {
        program = count++;
        required_wrench(&r->h, &s->x[0], &s->x[1], &s->x[2], none, none, wrench[program]);
    }
    if (r->share) {
        share = count++;
        central_wrench(&s->x[0], (vector){zero, zero, vertical}, wrench[share]);
    }
    if (count > 0) s->singularity = leg_forces_of(&r->h, &s->x[0], &s->program, wrench, count);
    for (int v = 0; v < LEGS; v++) {
        if (program >= 0) s->force[v] = wrench[program][v];
        if (share >= 0) s->force[v] = s->force[v] + wrench[share][v];
    }
}

/* what disturbs legs and load */
static inline void run_disturbances(run *r, real t, stage *s) {
    const size_t force = offsetof(gough_disturbance, force),
                 moment = offsetof(gough_disturbance, moment), one = sizeof(gough_formula);

    for (int v = 0; v < LEGS; v++) {
        static const char *const name[LEGS] = {
            "disturbance.leg_force.1", "disturbance.leg_force.2", "disturbance.leg_force.3",
            "disturbance.leg_force.4", "disturbance.leg_force.5", "disturbance.leg_force.6"};
        const size_t place = offsetof(gough_disturbance, leg_force) + (size_t)v * one;
        if (!r->shaken[v]) continue;
        s->force[v] = s->force[v] + run_disturbance(r, place, name[v], t);
    }
    s->push = s->turn = (vector){number_of(0), number_of(0), number_of(0)};
    if (!r->loaded) return;
    s->push.x = run_disturbance(r, force, "disturbance.force.1", t);
    s->push.y = run_disturbance(r, force + one, "disturbance.force.2", t);
    s->push.z = run_disturbance(r, force + 2 * one, "disturbance.force.3", t);
    s->turn.x = run_disturbance(r, moment, "disturbance.moment.1", t);
    s->turn.y = run_disturbance(r, moment + one, "disturbance.moment.2", t);
    s->turn.z = run_disturbance(r, moment + 2 * one, "disturbance.moment.3", t);
}

/* root of 315/151: over an interval the squares of the four weights below have the mean 151/315 */
#define NOISE_SCALE REAL_LITERAL(1.44433123459675553728075145407450573874507)

/* (law-3): the normal numbers around the knot, the draw of channel c at knot k being c + 12 k */
static inline void run_draw_noise(run *r, real knot) {
    for (int i = 0; i < NUMBER_WIDTH; i++) {
        const gough_noise *n = &r->lane[i].disturbance->noise;
        const uint64_t first = (uint64_t)(long long)knot;
        for (int c = 0; c < NOISE_CHANNELS; c++) {
            const double size = c < LEGS ? n->leg_force : c < LEGS + 3 ? n->force : n->moment;
            for (int k = 0; k < 4; k++) {
                const uint64_t draw = (uint64_t)c + NOISE_CHANNELS * (first + (uint64_t)k);
                const real x = size > 0 ? gough_random_normal(n->seed, r->lane[i].number, draw) : 0;
                number_put(&r->noise.coefficient[c][k], i, NOISE_SCALE * (real)size * x);
            }
        }
    }
    r->noise.knot = knot;
    r->noise.fresh = 1;
}

/* (law-3): a uniform cubic spline whose coefficients are normal numbers, one interval in all lanes */
static inline void run_add_noise(run *r, real t, stage *s) {
    const real place = t / (real)r->lane[0].disturbance->noise.interval, knot = real_floor(place);
    const real x = place - knot, y = 1 - x;
    const number weight[4] = {
        number_of_real(y * y * y / 6), number_of_real((3 * x * x * x - 6 * x * x + 4) / 6),
        number_of_real((3 * y * y * y - 6 * y * y + 4) / 6), number_of_real(x * x * x / 6)};
    number value[NOISE_CHANNELS];

    if (!(r->lane[0].disturbance->noise.interval > 0) || !(place < 0x1p53)) {
        run_blame(
            r,
            "disturbance.noise.interval, which must be > 0 and no tiny part of the run: the noise",
            t);
        return;
    }
    if (!r->noise.fresh || knot < r->noise.knot || knot > r->noise.knot) run_draw_noise(r, knot);
    for (int c = 0; c < NOISE_CHANNELS; c++) {
        const number *n = r->noise.coefficient[c];
        value[c] = weight[0] * n[0] + weight[1] * n[1] + weight[2] * n[2] + weight[3] * n[3];
    }
    for (int v = 0; v < LEGS; v++) s->force[v] = s->force[v] + value[v];
    s->push = add(s->push, (vector){value[LEGS], value[LEGS + 1], value[LEGS + 2]});
    s->turn = add(s->turn, (vector){value[LEGS + 3], value[LEGS + 4], value[LEGS + 5]});
}

/* the program's motion in a stage, no rates of legs and no forces yet */
static inline void run_displacement(run *r, const displacement *d, stage *s) {
    for (int v = 0; v < LEGS; v++) s->force[v] = number_of(0);
    s->singularity = (elimination){number_of(1), number_of(1)};
    coordinates_of_displacement(&r->h, r->height, r->motion->about, d, s->x);
    legs_at(&r->h, &s->x[0], &s->program);
}

static inline void run_program(run *r, const jet component[GOUGH_COMPONENTS], stage *s) {
    displacement d;

    displacement_of(motion_axes(r->motion), component, &d);
    run_displacement(r, &d, s);
    legs_rates(&r->h, &s->x[1], &s->program);
}

static inline number run_vertical(run *r, real t) {
    return run_disturbance(r, offsetof(gough_disturbance, vertical_force),
                           "disturbance.vertical_force", t);
}

/* all of a stage from its own formulas */
static inline void run_evaluate(run *r, real t, stage *s) {
    jet component[GOUGH_COMPONENTS];

    run_components(r, t, component);
    run_program(r, component, s);
    if (r->solves) run_program_forces(r, r->share ? run_vertical(r, t) : number_of(0), s);
    run_disturbances(r, t, s);
    if (r->noise.present) run_add_noise(r, t, s);
}

static inline const stage *run_stage(run *r, real t) {
    if (r->valid && !(t < r->time) && !(t > r->time)) return &r->now;
    if (r->replay) {
        r->replay(r, t);
    } else {
        run_evaluate(r, t, &r->now);
    }
    r->time = t;
    r->valid = 1;
    return &r->now;
}

/* the same with all that rows and singular poses are read from, where what is replayed lacks it */
static inline const stage *run_whole_stage(run *r, real t) {
    const stage *s = run_stage(r, t);

    if (!r->partial) return s;
    run_evaluate(r, t, &r->now);
    r->partial = 0;
    return s;
}

/* (law-1), with the disturbances of the legs */
static inline void run_leg_forces(const run *r, const stage *s, const legs *g, number u[LEGS]) {
    for (int v = 0; v < LEGS; v++) {
        u[v] = law_stiff(s->force[v], r->G[v], s->program.length[v], g->length[v]);
        if (r->damped) {
            u[v] = law_force(s->force[v], r->G[v], r->D[v], s->program.length[v],
                             s->program.rate[v], g->length[v], g->rate[v]);
        }
    }
}

/* All of one instant: legs, forces and accelerations in a state. */
typedef struct {
    coordinates x, rate, acceleration;
    legs g;
    number u[LEGS];
} instant;

/* what the legs and all else that acts do to the load in a state */
KERNEL_INLINE coordinates run_accelerations(const run *r, const stage *s, const coordinates *x,
                                            const coordinates *rate, const legs *g,
                                            const number u[LEGS]) {
    const push p = legs_push(&r->h, g, u);
    coordinates a = accelerations_under(&r->h, x, rate, &p, r->loaded ? &s->push : NULL, &s->turn);

    if (r->options->constraints == GOUGH_BAUMGARTE) {
        triad_stabilise(&r->h.load, &x->q, &rate->q, r->alpha, r->beta, &a.q);
    }
    return a;
}

static inline void run_instant(run *r, real t, const number *y, instant *m) {
    const stage *s = run_stage(r, t);

    r->evaluations++;
    m->x = coordinates_load(y);
    m->rate = coordinates_load(y + COORDINATES);
    legs_at(&r->h, &m->x, &m->g);
    legs_rates(&r->h, &m->rate, &m->g);
    run_leg_forces(r, s, &m->g, m->u);
    m->acceleration = run_accelerations(r, s, &m->x, &m->rate, &m->g, m->u);
}

/* The rate_function of a run: run_instant() without the rates of legs that only rows and limits need */
static inline void run_rates(void *context, real t, const number *y, number *rate) {
    run *r = context;
    const stage *s = run_stage(r, t);
    const coordinates x = coordinates_load(y), v = coordinates_load(y + COORDINATES);
    number u[LEGS];
    coordinates a;
    legs g;

    r->evaluations++;
    legs_at(&r->h, &x, &g);
    if (r->damped) legs_rates(&r->h, &v, &g);
    run_leg_forces(r, s, &g, u);
    a = run_accelerations(r, s, &x, &v, &g, u);
    coordinates_store(&v, rate);
    coordinates_store(&a, rate + COORDINATES);
}

/* The wrench_function of a run: forces with the legs at rest, and damping Σ D w wᵀ, where l̇ = w·(ρ̇, Ω), w = (n, arm × n) */
static inline void run_wrench(void *context, real t, const coordinates *x, number wrench[6],
                              number damping[6][6]) {
    run *r = context;
    const stage *s = run_stage(r, t);
    number u[LEGS];
    vector F, L;
    legs g;
    push p;

    r->evaluations++;
    legs_at(&r->h, x, &g);
    for (int v = 0; v < LEGS; v++) g.rate[v] = number_of(0);
    run_leg_forces(r, s, &g, u);
    p = legs_push(&r->h, &g, u);
    F = along(add(p.F, s->push), r->h.load.mass, r->h.gravity);
    L = add(push_moment(&p, &x->q), onto(&x->q, s->turn));
    vector_store(F, wrench);
    vector_store(L, wrench + 3);
    if (!r->damped) return;

    for (int i = 0; i < 6; i++) {
        for (int j = 0; j < 6; j++) damping[i][j] = number_of(0);
    }
    for (int v = 0; v < LEGS; v++) {
        number w[6];
        vector_store(g.n[v], w);
        vector_store(cross(r->h.arm[v], onto(&x->q, g.n[v])), w + 3);
        for (int i = 0; i < 6; i++) {
            for (int j = 0; j < 6; j++) damping[i][j] = damping[i][j] + r->D[v] * w[i] * w[j];
        }
    }
}

/* what the steppers see of a run */
static inline march_problem run_problem(run *r) {
    return (march_problem){STATE, run_rates, {&r->h.load, run_wrench, r, r->damped}, r};
}

static inline double run_part(void *clock, double t, double end, double length) {
    return appointments_part(clock, t, end, length);
}

/* how a run goes through time, from 0 */
static inline march run_march(const gough_simulation *o, appointments *when) {
    const int method = o->method == GOUGH_DOP853 ? MARCH_DOP853
                       : o->method == GOUGH_RK4  ? MARCH_RK4
                                                 : MARCH_RATTLE + (int)o->method - GOUGH_RATTLE2;

    return (march){
        .method = method, .length = o->step, .until = o->duration, .part = run_part, .clock = when};
}

#endif
