/* Runs of a batch that differ in what they may differ in, and their outcomes against gough_simulate() of each alone. */
#ifndef TESTS_BATCH_RUNS_H
#define TESTS_BATCH_RUNS_H

#include <stdio.h>

#include "gough/batch.h"
#include "gough/dynamics.h"
#include "support/machines.h"
#include "support/sizing.h"
#include "support/suite.h"

enum { RUNS = 37 }; /* fills no width evenly */

typedef struct {
    gough_model model;
    gough_machine machine[RUNS];
    gough_control control[RUNS];
    gough_disturbance disturbance[RUNS];
    gough_initial initial[RUNS];
    gough_batch_run run[RUNS];
    gough_outcome outcome[RUNS], other[RUNS];
} fixture;

/* which parts differ from run to run */
enum {
    LOADS = 1,
    DISTURBANCES = 2,
    VERTICAL = 4,
    NOISE = 8,
    HEAVY = 16,
    FRICTION = 32,
    SAMPLED = 64,
    LAGGING = 128,
    LIMITED = 256,
    MATRICES = 512
};

/* what closes the loop of run i: sampled at the same times in all runs, else of numbers of its own */
static inline void give_loop(fixture *f, int i, int differing, dice *d) {
    gough_platform p = f->machine[i].platform;
    const gough_load load = f->machine[i].load;
    const double gravity[3] = {f->machine[i].gravity[0], f->machine[i].gravity[1],
                               f->machine[i].gravity[2]};
    gough_control *c = &f->control[i];

    if (differing & SAMPLED) {
        c->sampling = (gough_sampling){.period = 0.02,
                                       .delay = 0.01,
                                       .velocity = GOUGH_VELOCITY_DIFFERENCE,
                                       .cutoff = dice_between(d, 5, 20),
                                       .resolution = i % 2 ? 1e-4 : 0,
                                       .noise = 1e-5 * (i % 3),
                                       .seed = 4};
    }
    for (int v = 0; v < 6; v++) {
        if (differing & (SAMPLED | LAGGING)) c->integral[v] = dice_between(d, 5, 10);
        if (differing & LIMITED) {
            p.actuators.max_force[v][1] = dice_between(d, 0.3, 0.6);
            p.actuators.max_force[v][0] = -p.actuators.max_force[v][1];
            c->tracking_time = dice_between(d, 0.2, 0.5);
        }
        if (differing & LAGGING) {
            p.actuators.kind = GOUGH_ACTUATOR_LAG;
            p.actuators.time_constant[v] = dice_between(d, 0.02, 0.05);
            if (i % 3 == 0) p.actuators.max_rate[v] = dice_between(d, 1, 2);
        }
        for (int w = 0; differing & MATRICES && w < 6; w++) {
            if (v != w) c->cross_stiffness[v][w] = dice_between(d, -2, 2);
            if (v != w) c->cross_damping[v][w] = dice_between(d, -0.1, 0.1);
        }
    }
    c->coupled = differing & MATRICES;
    ck_assert_int_eq(gough_machine_init(&f->machine[i], &p, &load, gravity, NULL), GOUGH_OK);
}

static inline fixture *new_fixture(int differing, double damping) {
    fixture *f = calloc(1, sizeof *f);
    dice d = {41};

    skew_machine(&f->model.machine);
    f->model.control.feedforward = true;
    set_gains(&f->model, 30, damping);
    set_all_axes(&f->model);
    set_formula(&f->model.disturbance.leg_force[1], "0.05*sin(2*t)");
    set_formula(&f->model.disturbance.force[0], "0.1*cos(t)");
    if (differing & VERTICAL) set_formula(&f->model.disturbance.vertical_force, "0.02*sin(t)");
    if (differing & NOISE) {
        f->model.disturbance.noise = (gough_noise){
            .leg_force = 0.02, .force = 0.05, .moment = 0.01, .interval = 0.13, .seed = 9};
    }
    for (int i = 0; i < RUNS; i++) {
        f->machine[i] = f->model.machine;
        f->control[i] = f->model.control;
        f->initial[i] = f->model.initial;
        for (int c = 0; c < GOUGH_COMPONENTS; c++) {
            f->initial[i].given[c] = true;
            f->initial[i].component[c] = dice_between(&d, -0.02, 0.02);
        }
        for (int v = 0; v < 6; v++) f->control[i].stiffness[v] = dice_between(&d, 20, 60);
        if (differing & LOADS) {
            gough_load load = f->model.machine.load;
            gough_platform platform = f->model.machine.platform;
            load.mass = dice_between(&d, 1, 2);
            load.center_of_mass[2] = dice_between(&d, 0, 0.3);
            ck_assert_int_eq(gough_machine_init(&f->machine[i], &platform, &load,
                                                f->model.machine.gravity, NULL),
                             GOUGH_OK);
        }
        if (differing & HEAVY) give_legs(&f->machine[i], LEGS_HEAVY, &d);
        if (differing & FRICTION && i % 3) give_legs(&f->machine[i], LEGS_VISCOUS | LEGS_DRY, &d);
        if (differing >= SAMPLED) give_loop(f, i, differing, &d);
        if (differing & DISTURBANCES) {
            char text[64];
            f->disturbance[i] = f->model.disturbance;
            snprintf(text, sizeof text, "%.17g*sin(3*t)", dice_between(&d, 0, 0.1));
            set_formula(&f->disturbance[i].moment[2], text);
        }
        f->run[i] = (gough_batch_run){
            differing & LOADS || differing >= SAMPLED ? &f->machine[i] : &f->model.machine,
            &f->control[i],
            differing & DISTURBANCES ? &f->disturbance[i] : &f->model.disturbance,
            &f->initial[i],
            (uint64_t)i + 1,
            (uint64_t)i + 1};
    }
    return f;
}

static inline gough_simulation fixed(gough_method method, double step, double duration) {
    gough_simulation s = gough_simulation_default();

    s.method = method;
    s.step = step;
    s.duration = duration;
    s.output_step = 0.1;
    return s;
}

static inline void run_batch(fixture *f, const gough_simulation *s, int lanes, int threads,
                             gough_outcome *outcome) {
    gough_batch_options options = gough_batch_options_default();
    gough_error error = {0};
    void *memory;

    options.lanes = lanes;
    options.threads = threads;
    options.sizing = true;
    memory = aligned_alloc(64, (gough_batch_size(&options) + 63) / 64 * 64);
    memset(outcome, 0xff, RUNS * sizeof *outcome);
    ck_assert_msg(gough_batch(&f->model.motion, s, f->run, RUNS, &options, outcome, memory,
                              &error) == GOUGH_OK,
                  "%s", error.message);
    free(memory);
}

static inline int keep(void *context, const gough_row *row) {
    memcpy(context, row->value, sizeof row->value);
    return 0;
}

/* outcomes against gough_simulate() of each run: the last row's bits, the same end */
static inline void check_alone(const fixture *f, const gough_simulation *s) {
    for (int i = 0; i < RUNS; i++) {
        gough_model *model = malloc(sizeof *model);
        double row[GOUGH_COLUMNS];
        gough_end end;
        *model = f->model;
        model->machine = *f->run[i].machine;
        model->control = *f->run[i].control;
        model->disturbance = *f->run[i].disturbance;
        model->initial = *f->run[i].initial;
        model->disturbance.noise.run = f->run[i].number;
        model->control.sampling.run = f->run[i].number;
        gough_simulation own = *s;
        gough_summary summary;
        own.summary = &summary;
        (void)gough_simulate(model, &own, keep, row, &end, NULL);
        const gough_outcome *out = &f->outcome[i];
        if (summary.rows > 0) check_sizing(out, &summary);
        ck_assert_int_eq(out->cause, end.cause);
        ck_assert_int_eq(out->leg, end.leg);
        ck_assert_msg(memcmp(&out->time, &end.time, sizeof(double)) == 0,
                      "run %d ends at %.17g, alone at %.17g: %s", i, out->time, end.time,
                      end.message);
        ck_assert(memcmp(out->position, row + GOUGH_X, sizeof out->position) == 0);
        ck_assert(memcmp(out->angles, row + GOUGH_ROLL_ANGLE, sizeof out->angles) == 0);
        ck_assert(memcmp(out->velocity, row + GOUGH_VX, sizeof out->velocity) == 0);
        ck_assert(memcmp(out->angular_velocity, row + GOUGH_WX, sizeof out->angular_velocity) == 0);
        ck_assert(out->rows >= 1);
        free(model);
    }
}

#endif
