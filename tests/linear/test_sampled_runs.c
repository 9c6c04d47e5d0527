/* The map from sample to sample against runs of the nonlinear equations with the same controller: a small deviation after many
 * samples is what the map makes of it. */
#include <stdio.h>

#include "gough/linear.h"
#include "linear/sampled.h"
#include "support/machines.h"
#include "support/suite.h"

enum { SAMPLES = 25 };

/* a deviation of this size leaves its square out */
static const double small = 1e-6;

static int keep(void *context, const gough_row *row) {
    memcpy(context, row->value, sizeof row->value);
    return 0;
}

static void run(const gough_model *model, double last[GOUGH_COLUMNS]) {
    gough_simulation s = gough_simulation_default();
    gough_error error = {0};
    gough_end end;

    s.output_step = model->control.sampling.period;
    s.duration = SAMPLES * s.output_step;
    s.tolerance = 1e-14;
    ck_assert_msg(gough_simulate(model, &s, keep, last, &end, &error) == GOUGH_OK, "%s",
                  error.message);
}

/* what the controller remembers before its first sample, and commands as if the first had always been given */
static void begin(const gough_model *model, const sampled_plant *plant, const sampled_law *law,
                  const double xi[GOUGH_LINEAR], int n, double *state) {
    const double T = model->control.sampling.period;
    double seen[SAMPLED_INPUTS] = {0}, command[6] = {0};
    int place = plant->n;

    memcpy(state, xi, GOUGH_LINEAR * sizeof *state);
    for (int v = 0; v < 6; v++) {
        for (int i = 0; i < 6; i++) {
            seen[v] += plant->J[v][i] * xi[i];
            seen[6 + v] += plant->J[v][i] * xi[6 + i];
        }
        seen[SAMPLED_SEEN + v] = -seen[v] + T * seen[6 + v];
        seen[SAMPLED_SEEN + 6 + v] = -seen[6 + v];
    }
    for (int v = 0; v < 6; v++) {
        for (int i = 0; i < SAMPLED_INPUTS; i++) command[v] += law->command[v][i] * seen[i];
        if (plant->n > GOUGH_LINEAR) state[GOUGH_LINEAR + v] = command[v];
    }
    for (int m = 0; m < SAMPLED_MEMORY; m++)
        if (law->used[m]) state[place++] = seen[SAMPLED_SEEN + m];
    for (int i = 0; place < n; i++) state[place++] = command[i % 6];
}

static void compare(gough_model *model, const char *what) {
    gough_initial *start = &model->initial;
    double xi[GOUGH_LINEAR], last[GOUGH_COLUMNS], found[6], angles[3], c[3];
    double state[SAMPLED_ROWS] = {0}, after[SAMPLED_ROWS];
    gough_control control;
    gough_state rest;
    sampled_plant plant;
    sampled_step step;
    sampled_law law;
    sampled_map map;
    dice d = {17};

    for (int i = 0; i < GOUGH_LINEAR; i++) xi[i] = small * dice_between(&d, -1, 1);
    /* the point that the run moves is the top's origin, c from the centre of mass: δp = δr − δθ × c */
    for (int i = 0; i < 3; i++) c[i] = model->machine.load.center_of_mass[i];
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        start->component[i] = xi[i] - (xi[3 + j] * c[k] - xi[3 + k] * c[j]);
        start->velocity[i] = xi[6 + i] - (xi[9 + j] * c[k] - xi[9 + k] * c[j]);
        start->component[3 + i] = xi[3 + i];
        start->angular_velocity[i] = xi[9 + i];
        start->given[i] = start->given[3 + i] = true;
    }
    start->velocity_given = start->angular_velocity_given = true;
    run(model, last);

    ck_assert_int_eq(sampled_rest_of(model, NULL, &plant, &control, &rest, NULL), GOUGH_OK);
    ck_assert(sampled_step_of(&plant, control.sampling.period, control.sampling.delay, &step));
    sampled_law_of(&control, &law);
    sampled_map_of(&plant, &step, &law, &map);
    begin(model, &plant, &law, xi, map.n, state);
    for (int k = 0; k < SAMPLES; k++) {
        for (int i = 0; i < map.n; i++) {
            after[i] = 0;
            for (int j = 0; j < map.n; j++) after[i] += map.matrix[map.n * i + j] * state[j];
        }
        memcpy(state, after, sizeof state);
    }
    for (int i = 0; i < 3; i++) angles[i] = last[GOUGH_ROLL_ANGLE + i];
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        found[i] = last[GOUGH_EX + i] + (angles[j] * c[k] - angles[k] * c[j]);
        found[3 + i] = angles[i];
    }
    double largest = 0;
    for (int i = 0; i < 6; i++) largest = fmax(largest, fabs(state[i]));
    ck_assert(largest > 0.02 * small);
    for (int i = 0; i < 6; i++)
        ck_assert_msg(fabs(found[i] - state[i]) <= 2e-5 * largest + 10 * small * small,
                      "%s, number %d: %.9g, not %.9g", what, i, found[i], state[i]);
}

START_TEST(runs_follow_the_map) {
    for (int k = 0; k < 8; k++) {
        gough_model *model = calloc(1, sizeof *model);
        gough_control *c = &model->control;
        gough_actuators *a = &model->machine.platform.actuators;
        char what[20];
        dice d = {(uint64_t)k};

        ck_assert(model != NULL);
        snprintf(what, sizeof what, "case %d", k);
        if (k % 3 == 2)
            skew_machine(&model->machine);
        else
            paper_machine(&model->machine);
        if (k == 5) give_legs(&model->machine, LEGS_HEAVY | LEGS_VISCOUS, &d);
        c->feedforward = true;
        for (int v = 0; v < 6; v++) {
            c->stiffness[v] = dice_between(&d, 2, 3);
            c->damping[v] = dice_between(&d, 0.2, 0.4);
            c->integral[v] = k % 4 == 3 ? dice_between(&d, 0.1, 0.5) : 0;
        }
        c->sampling.period = 0.06;
        c->sampling.delay = (const double[]){0, 0.06, 0.025, 0.1}[k % 4];
        c->sampling.velocity = k % 2 ? GOUGH_VELOCITY_DIFFERENCE : GOUGH_VELOCITY_EXACT;
        c->sampling.cutoff = k % 4 == 1 ? 4 : 0;
        if (k == 6 || k == 7) {
            a->kind = GOUGH_ACTUATOR_LAG;
            for (int v = 0; v < 6; v++) {
                a->time_constant[v] = k == 6 ? 0.03 : 0;
                a->frequency[v] = k == 6 ? 0 : 6;
                a->damping_ratio[v] = k == 6 ? 0 : 0.7;
            }
        }
        if (k == 4) {
            c->coupled = true;
            c->cross_stiffness[0][3] = 0.4;
            c->cross_damping[2][5] = -0.1;
        }
        compare(model, what);
        free(model);
    }
}
END_TEST

int main(void) { return SUITE_RUN("linear/sampled_runs", 60, runs_follow_the_map); }
