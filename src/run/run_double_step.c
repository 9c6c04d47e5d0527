/* A plant under the commands of the caller's controller, step by step, over double: hardware in the loop. */
#define NUMBER_DOUBLE
#include <limits.h>
#include <stdint.h>

#include "base/assert.h"
#include "plant/can_move.h"
#include "run/forward_run.h"

struct gough_plant {
    gough_simulation options;
    gough_control control; /* as if it sampled each step: commands are held */
    forward d;
    fixed_loop loop;
    gough_end end;
    long long step;
};

size_t gough_plant_size(void) { return (sizeof(struct gough_plant) + 63) / 64 * 64; }

static gough_status plant_end(const struct gough_plant *p, gough_end *end, gough_error *error) {
    if (end) *end = p->end;
    if (p->end.cause == GOUGH_END_DONE) return GOUGH_OK;
    return gough_fail(error, GOUGH_ERROR_NUMERICAL, "%s", p->end.message);
}

static void plant_show(struct gough_plant *p, gough_row *row) {
    forward *d = &p->d;

    row_fill(&d->r, system_whole(&d->r, d->t), d->t, &d->now, 1, ROW_WHOLE, d->drift, row->value);
    row->quad = NULL;
    d->drift = 0;
}

/* commands begin to act at the present time; a drive that lags has followed the first one already, and RATTLE's body is told */
static void plant_renew(struct gough_plant *p) {
    forward *d = &p->d;

    for (int v = 0; p->step == 0 && d->r.drive.count > 0 && v < LEGS; v++)
        d->y[d->r.drive.at + v] = d->r.held[v];

    forward_refresh(d);
    if (d->m.method < MARCH_RATTLE) return;
    const march_problem problem = system_problem(&d->r);
    if (p->step == 0) {
        const coordinates rate = coordinates_load(d->y + COORDINATES);
        p->loop.body.x = coordinates_load(d->y);
        p->loop.body.velocity = rate.rho;
        p->loop.body.omega =
            onto(&p->loop.body.x.q, triad_angular_velocity(&p->loop.body.x.q, &rate.q));
    }
    rattle_begin(&problem.rule, d->t, &p->loop.body);
}

gough_status gough_plant_begin(void *memory, const gough_model *model,
                               const gough_simulation *simulation, gough_row *row, gough_end *end,
                               gough_error *error) {
    struct gough_plant *p = memory;
    const simulate_parts parts = {&model->motion,
                                  &model->machine,
                                  &p->control,
                                  &model->disturbance,
                                  &model->initial,
                                  model->disturbance.noise.run,
                                  model->control.sampling.run};

    assert_true((uintptr_t)memory % 64 == 0);
    *p = (struct gough_plant){.options = *simulation, .control = model->control};
    p->control.sampling = (gough_sampling){.period = simulation->step};
    p->options.summary = NULL;
    p->options.statistics = NULL;
    p->options.law = NULL;
    gough_status status = gough_simulation_check(model, simulation, error);
    if (status == GOUGH_OK) status = machine_can_move(&model->machine, error);
    if (status == GOUGH_OK && !(simulation->step > 0))
        status = gough_fail_key(error, GOUGH_ERROR_INPUT, "simulation.step",
                                "simulation.step must be > 0: a plant moves in fixed steps");
    if (status == GOUGH_OK && simulation->precision != GOUGH_DOUBLE)
        status = gough_fail_key(error, GOUGH_ERROR_INPUT, "simulation.precision",
                                "simulation.precision: a plant is computed in double precision");
    if (status != GOUGH_OK) return status;

    forward_open(&p->d, &parts, &p->options, NULL, NULL, &p->end);
    forward_start(&p->d);
    p->d.loop.clock.sample = p->d.loop.clock.act = LLONG_MAX / p->d.loop.clock.every;
    p->loop.d = &p->d;
    (void)forward_begin(&p->d);
    p->d.rows = p->d.row;
    p->d.m.until = (real)INFINITY;
    if (row && p->end.cause == GOUGH_END_DONE) plant_show(p, row);
    return plant_end(p, end, error);
}

gough_status gough_step(void *plant, const double command[GOUGH_LEGS], gough_row *row,
                        gough_end *end, gough_error *error) {
    struct gough_plant *p = plant;
    forward *d = &p->d;

    if (p->end.cause != GOUGH_END_DONE) return plant_end(p, end, error);
    for (int v = 0; v < LEGS; v++) {
        d->r.held[v] = drive_takes(&d->r.drives[v], command[v]);
        d->r.unmet[v] = command[v] - d->r.held[v];
    }
    plant_renew(p);
    (void)march_fixed(&d->m, p->step, p->step + 1, forward_move, &p->loop);
    p->step++;
    if (row && p->end.cause == GOUGH_END_DONE) plant_show(p, row);
    return plant_end(p, end, error);
}
