/* A machine in motion as its parts: plant, controller, disturbances and program, in lanes. What a stepper sees of them. Text over
 * the number type. Theory: docs/theory/control.md. */
#ifndef GOUGH_SYSTEM_PARTS_H
#define GOUGH_SYSTEM_PARTS_H

#include "base/assert.h"
#include "base/limits.h"
#include "control/sampler_numbers.h"
#include "drive/drive_numbers.h"
#include "gough/random.h"
#include "gough/simulate.h"
#include "kernel/known_load.h"
#include "kernel/real.h"
#include "plant/forward.h"
#include "plant/hexapod.h"
#include "plant/inverse.h"
#include "plant/program_motion.h"
#include "plant/state.h"
#include "system/limit_set.h"

/* What the program and the disturbances are at one time. It depends on time alone, so that it may be prefetched, recorded and
 * replayed; nothing else may. */
typedef struct {
    coordinates x[3];        /* the program and its derivatives */
    legs program;            /* l^p, l̇^p */
    number force[LEGS];      /* F^p of the drives, if fed forward, and what disturbs the legs */
    number shake[LEGS];      /* what disturbs the legs, if it is told from the command (APART) */
    number leg[LEGS];        /* F^p in the legs; only where the equations were solved for it */
    known_load external;     /* only where there are external loads */
    vector push, turn;       /* force at the centre of mass and moment on the load, base axes */
    elimination singularity; /* of the six equations of F^p; determinant 1 where none were solved */
} wanted;

/* What is not finite: a sentence's subject, or NULL. */
typedef struct {
    const char *what;
    real time;
} wanted_fault;

/* What one lane of a run has of its own. */
typedef struct {
    const gough_machine *machine;
    const gough_control *control;
    const gough_disturbance *disturbance;
    uint64_t number;  /* of the run, for its noise */
    uint64_t samples; /* of the run, for the noise and jitter of its samples */
} system_lane;

/* the noise between two knots: four coefficients for each leg, force and moment along three axes */
enum { NOISE_CHANNELS = LEGS + 6 };
typedef struct {
    int present, fresh;
    real knot; /* the one before */
    number coefficient[NOISE_CHANNELS][4];
} noise_state;

/* What the parts need, found once from what is there, the same in all lanes. */
enum {
    NEEDS_RATES = 1 << 0, /* forces of the legs depend on their rates */
    LINEAR_IN_RATES =
        1 << 1, /* and fall in proportion to them: RATTLE's closing kick can be solved for */
    MOVING_MASS = 1 << 2, /* of legs */
    FRICTION = 1 << 3,
    EXTERNAL = 1 << 4, /* loads besides the weight, which are known */

    SAMPLED = 1 << 5,       /* the controller's command is held from sample to sample */
    PROGRAM_RATES = 1 << 6, /* the controller needs l̇^p, whatever forces depend on */
    COUPLED = 1 << 7,       /* gains are matrices */
    INTEGRATING = 1 << 8,   /* integrals: states, or in the controller's memory if it is sampled */
    LAGGING = 1 << 9,       /* drives have states: forces, and of a second order their rates */
    SECOND_ORDER = 1 << 10,
    SATURATING = 1 << 11, /* drives take commands up to a limit */

    APART = SAMPLED | LAGGING | SATURATING, /* a command is told from what disturbs the legs */
    LOOPED = APART | COUPLED | INTEGRATING  /* there is more to the loop than (law-1) */
};

/* What was prefetched or recorded lacks the rates of the program and the directions of its legs, and without its pose that too. */
enum { PARTIAL_POSED = 1, PARTIAL_UNPOSED = 2 };

struct system {
    const gough_motion *motion;
    const gough_simulation *options;
    system_lane lane[NUMBER_WIDTH];
    int traits;
    slice pose, rate, drive, sum; /* of the state: ρ, i, j, k; their rates; of drives; integrals */
    int states;                   /* numbers of a state */

    /* plant */
    hexapod h;
    double height;      /* of home, the same in every lane */
    number alpha, beta; /* Baumgarte, or 0 */
    limit_set limits;
    leg_drive drives[LEGS];

    /* controller */
    number G[LEGS], D[LEGS];
    law_coupling coupling; /* if COUPLED */
    number integral[LEGS]; /* K_I */
    number track[LEGS];    /* 1/T_t of legs with an integral, 0 without */
    number held[LEGS];     /* command in force, if SAMPLED */
    number measured[LEGS]; /* lengths at the last sample */
    number unmet[LEGS];    /* what that asks of a drive beyond what it takes */
    int feeds;             /* F^p is fed forward */
    int knows;             /* MOVING_MASS, FRICTION and EXTERNAL where F^p counts with them */
    int solves;            /* the six equations of the program are needed */

    /* external loads, in number and axes the same in all lanes; where each acts, central axes */
    int externals, external_turns[GOUGH_EXTERNALS];
    vector external_arm[GOUGH_EXTERNALS];
    number external_share; /* of all of them: 1 but where a balance is sought step by step */

    /* disturbances */
    int share;        /* a vertical force is shared by the legs */
    int loaded;       /* force or moment on the load */
    int shaken[LEGS]; /* leg disturbances present */
    noise_state noise;

    /* what depends on time alone, at `time`, kept since steppers come back to it */
    wanted now;
    real time;
    int valid;
    void (*provide)(
        struct system *r,
        real t);    /* fills it from what was prefetched or recorded; NULL: from the formulas */
    void *provider; /* its context */
    int partial;    /* what was provided lacks something: one of the values below, or 0 */
    wanted_fault fault;

    long long evaluations; /* of the equations of motion */
};

static inline void vector_put(vector *v, int lane, vector one) {
    number_put(&v->x, lane, number_lane(one.x, lane));
    number_put(&v->y, lane, number_lane(one.y, lane));
    number_put(&v->z, lane, number_lane(one.z, lane));
}

/* where the external loads of a lane act */
static inline void system_add_external(struct system *r, int lane) {
    const gough_machine *m = r->lane[lane].machine;
    const vector none = {number_of(0), number_of(0), number_of(0)};

    r->externals = (int)m->externals;
    if (r->externals > 0) r->traits |= EXTERNAL;
    for (int n = 0; n < r->externals; n++) {
        const gough_external *e = &m->external[n];
        vector arm = none;
        if (e->at_given) arm = onto(&r->h.axes, subtract(vector_of(e->at), r->h.center));
        vector_put(&r->external_arm[n], lane, arm);
        r->external_turns[n] = e->turns;
    }
}

/* the drives of a lane */
static inline void system_add_drives(struct system *r, int lane) {
    const gough_actuators *a = &r->lane[lane].machine->platform.actuators;
    const int lags = a->kind == GOUGH_ACTUATOR_LAG;

    for (int v = 0; v < LEGS; v++) {
        drive_put(&r->drives[v], lane, a, v);
        if (a->max_force[v][0] < a->max_force[v][1]) r->traits |= SATURATING;
        if (lags) r->traits |= LAGGING;
        if (lags && a->frequency[v] > 0) r->traits |= SECOND_ORDER;
    }
}

/* matrices of gains and integrals of a lane; whether the controller is sampled */
static inline void system_add_control(struct system *r, int lane) {
    const gough_control *c = r->lane[lane].control;

    for (int v = 0; v < LEGS; v++) {
        for (int w = 0; w < LEGS; w++) {
            number_put(&r->coupling.stiffness[v][w], lane,
                       c->coupled ? (real)c->cross_stiffness[v][w] : 0);
            number_put(&r->coupling.damping[v][w], lane,
                       c->coupled ? (real)c->cross_damping[v][w] : 0);
        }
        number_put(&r->integral[v], lane, c->integral[v]);
        number_put(&r->track[v], lane,
                   c->tracking_time > 0 && c->integral[v] > 0 ? 1 / (real)c->tracking_time : 0);
        if (c->integral[v] > 0) r->traits |= INTEGRATING;
        number_put(&r->held[v], lane, 0);
        number_put(&r->measured[v], lane, 0);
        number_put(&r->unmet[v], lane, 0);
    }
    if (c->coupled) r->traits |= COUPLED | NEEDS_RATES;
    if (c->sampling.period > 0) r->traits |= SAMPLED | PROGRAM_RATES;
}

/* gains, limits and disturbances of a lane */
static inline void system_add_lane(struct system *r, int lane) {
    const gough_control *control = r->lane[lane].control;
    const gough_disturbance *d = r->lane[lane].disturbance;
    const gough_platform *p = &r->lane[lane].machine->platform;

    limit_set_lane(&r->limits, lane, r->lane[lane].machine, r->motion);
    system_add_drives(r, lane);
    system_add_control(r, lane);

    if (p->legs_have_mass) r->traits |= MOVING_MASS | NEEDS_RATES;
    if (machine_has_friction(r->lane[lane].machine)) r->traits |= FRICTION | NEEDS_RATES;

    for (int v = 0; v < LEGS; v++) {
        number_put(&r->G[v], lane, control->stiffness[v]);
        number_put(&r->D[v], lane, control->damping[v]);
        if ((control->damping[v] > 0 && !(control->sampling.period > 0)) ||
            p->friction.viscous[v] > 0)
            r->traits |= NEEDS_RATES | LINEAR_IN_RATES;
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

/* where the parts have their numbers in the state */
static inline void system_lay_out(struct system *r) {
    const int orders = r->traits & SECOND_ORDER ? 2 : 1;
    const int continuous = r->traits & INTEGRATING && !(r->traits & SAMPLED);

    r->drive = (slice){MOTION, r->traits & LAGGING ? orders * LEGS : 0};
    r->sum = (slice){r->drive.at + r->drive.count, continuous ? INTEGRAL_STATES : 0};
    r->states = r->sum.at + r->sum.count;
    assert_true(r->drive.count <= DRIVE_STATES && r->states <= STATE_SIZE);
}

/* Lanes that move by one motion, with one height of home and one choice of feed-forward; each has its own machine otherwise,
 * gains and disturbances. */
static inline void system_begin(struct system *r, const gough_motion *motion,
                                const gough_simulation *options,
                                const system_lane lane[NUMBER_WIDTH]) {
    r->motion = motion;
    r->options = options;
    r->height = lane[0].machine->platform.height;
    r->share = r->loaded = r->traits = 0;
    r->external_share = number_of(1);
    r->pose = (slice){0, COORDINATES};
    r->rate = (slice){COORDINATES, COORDINATES};
    r->noise.present = r->noise.fresh = 0;
    for (int v = 0; v < LEGS; v++) r->shaken[v] = 0;
    for (int i = 0; i < NUMBER_WIDTH; i++) {
        r->lane[i] = lane[i];
        hexapod_put_machine(&r->h, i, lane[i].machine);
        system_add_lane(r, i);
        system_add_external(r, i);
    }
    system_lay_out(r);
    limit_set_turn(&r->limits, &r->h);
    r->feeds = lane[0].control->feedforward;
    r->knows = r->traits & ((lane[0].control->ignores_legs ? 0 : MOVING_MASS) |
                            (lane[0].control->ignores_friction ? 0 : FRICTION) |
                            (lane[0].control->ignores_external ? 0 : EXTERNAL));
    r->solves = r->feeds || r->share;
    r->alpha = number_of(options->constraints == GOUGH_BAUMGARTE ? options->baumgarte[0] : 0);
    r->beta = number_of(options->constraints == GOUGH_BAUMGARTE ? options->baumgarte[1] : 0);
    r->provide = NULL;
    r->provider = NULL;
    r->partial = 0;
    r->valid = 0;
    r->evaluations = 0;
    r->fault = (wanted_fault){NULL, 0};
}

/* without dry friction, which has no useful derivative: at rest it is a damper so strong that any loop seems to hold */
static inline void system_take_dry_friction_off(struct system *r) {
    const number zero = number_of(0);

    for (int v = 0; v < LEGS; v++)
        r->h.dry[v].coulomb = r->h.dry[v].excess = r->h.dry[v].loss = zero;
}

/* F^p alone, whatever control and disturbances the study has: the direct problem */
static inline void system_program_only(struct system *r) {
    r->feeds = r->solves = 1;
    r->knows = r->traits;
    r->traits &= ~LOOPED;
    r->share = r->loaded = r->noise.present = 0;
    for (int v = 0; v < LEGS; v++) r->shaken[v] = 0;
}

#endif
