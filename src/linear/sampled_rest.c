/* The loop at rest whose controller is sampled: multipliers from sample to sample, noise of its commands.
 * Theory: docs/theory/loop.md. */
#include <math.h>
#include <string.h>

#include "base/quantity.h"
#include "linear/linear.h"
#include "linear/sampled.h"
#include "linear/symmetric.h"

/* growth of a multiplier in each sample that rounding explains */
static const double rounding = 1e-12;

static const double two_pi = 6.283185307179586;

gough_status sampled_check(const gough_sampling *sampling, gough_error *error) {
    const gough_sampling *s = sampling;

    if (!(s->period > 0))
        return gough_fail_key(error, GOUGH_ERROR_INPUT, "control.sampling",
                              "the controller is continuous: it has no period of sampling; "
                              "gough_stability_at_rest() computes its stability");
    if (!sampled_delay_fits(s->period, s->delay))
        return gough_fail_key(error, GOUGH_ERROR_INPUT, "control.sampling.delay",
                              "a delay of %.9g" IN_TIME
                              " is more than %d periods: stability is computed up to that; "
                              "use a longer period, or simulate",
                              s->delay, (int)SAMPLED_WAITING);
    return GOUGH_OK;
}

gough_status sampled_rest_of(const gough_model *model, const double component[GOUGH_COMPONENTS],
                             sampled_plant *plant, gough_control *control, gough_state *state,
                             gough_error *error) {
    gough_motion motion;
    gough_status status = gough_control_check(&model->control, error);

    if (status == GOUGH_OK) status = sampled_check(&model->control.sampling, error);
    if (status == GOUGH_OK)
        status = linear_at_rest(model, component, &motion, control, state, error);
    if (status != GOUGH_OK) return status;
    return sampled_plant_of(&model->machine, &motion, state, plant, error);
}

/* (loop-2): the command's variance for each unit of the lengths', over the legs whose errors it depends on */
static void noise_of(const gough_control *c, gough_sampled_rest *rest) {
    const gough_sampling *s = &c->sampling;
    const double keep = s->cutoff > 0 ? exp(-two_pi * s->cutoff * s->period) : 0;
    const bool differences = s->velocity == GOUGH_VELOCITY_DIFFERENCE;
    const double first = differences ? (1 - keep) / s->period : 0;
    const double square =
        differences ? 2 * (1 - keep) * (1 - keep) / ((1 + keep) * s->period * s->period) : 0;
    const double variance = s->noise * s->noise + s->resolution * s->resolution / 12;

    for (int v = 0; v < GOUGH_LEGS; v++) {
        double sum = 0;
        for (int w = 0; w < GOUGH_LEGS; w++) {
            const double own = v == w, across = c->coupled && v != w;
            const double G = own * c->stiffness[v] + across * c->cross_stiffness[v][w];
            const double D = own * c->damping[v] + across * c->cross_damping[v][w];
            sum += G * G + 2 * G * D * first + D * D * square;
        }
        rest->noise[v] = sqrt(variance * sum);
        rest->count[v] = s->resolution * (c->stiffness[v] + c->damping[v] * first);
    }
}

/* 1/κ_max of M̂⁻¹JᵀJ */
static double least_mass(const sampled_plant *plant) {
    double K[FREEDOMS][FREEDOMS] = {{0}}, kappa[FREEDOMS];
    double complex shape[FREEDOMS][6];

    for (int v = 0; v < GOUGH_LEGS; v++) {
        for (int i = 0; i < FREEDOMS; i++) {
            for (int j = 0; j < FREEDOMS; j++) K[i][j] += plant->J[v][i] * plant->J[v][j];
        }
    }
    return 1 / symmetric_problem(K[0], plant->mass[0], kappa, shape);
}

gough_status gough_sampled_at_rest(const gough_model *model,
                                   const double component[GOUGH_COMPONENTS],
                                   gough_sampled_rest *rest, gough_error *error) {
    const gough_machine *machine = &model->machine;
    const gough_sampling *s = &model->control.sampling;
    gough_control control;
    sampled_plant plant;
    sampled_step step;
    sampled_law law;
    sampled_map map;
    gough_status status;

    memset(rest, 0, sizeof *rest);
    status = sampled_rest_of(model, component, &plant, &control, &rest->state, error);
    if (status != GOUGH_OK) return status;
    sampled_law_of(&control, &law);
    if (sampled_step_of(&plant, s->period, s->delay, &step)) {
        sampled_map_of(&plant, &step, &law, &map);
        rest->listed = (size_t)sampled_multipliers(machine, &map, GOUGH_SAMPLED, rest->multiplier);
    }
    if (step.unsolved)
        return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                          "could not compute what a sample does: LAPACK did not solve its problem");
    if (rest->listed == 0)
        return gough_fail_key(error, GOUGH_ERROR_NUMERICAL, "control.sampling.period",
                              "could not compute the multipliers over a period of %.9g" IN_TIME
                              ": a deviation grows beyond all numbers within it; use a shorter one",
                              s->period);

    rest->period = s->period;
    rest->delay = s->delay;
    rest->effective_delay = s->delay + 0.5 * s->period + plant.lag;
    rest->size = (size_t)map.n;
    rest->radius = hypot(rest->multiplier[0].value[0], rest->multiplier[0].value[1]);
    rest->growth = log(rest->radius) / s->period;
    rest->stable =
        rest->radius - 1 <= rounding + GOUGH_GROWTH_LIMIT * s->period *
                                           sqrt(machine->gravity_magnitude / machine->base_radius);
    rest->decaying = rest->radius < 1 - rounding;
    rest->mass = least_mass(&plant);
    if (!(rest->mass > 0))
        return gough_fail(error, GOUGH_ERROR_NUMERICAL,
                          "could not compute what a leg force moves most easily: LAPACK did not "
                          "solve its problem");
    noise_of(&control, rest);
    return GOUGH_OK;
}
