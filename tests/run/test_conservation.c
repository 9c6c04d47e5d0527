/* What a run must not lose: the constraints over a million steps, and the digits of a stable run between the two precisions.
 * Label: standard.
 * Sanitized: campaign: a million steps of code that run/ends and run/order run under sanitizers. */
#define NUMBER_DOUBLE
#include <stdio.h>

#include "run/forward_run.h"
#include "support/machines.h"
#include "support/suite.h"

static gough_model *closed_loop(void) {
    gough_model *model = calloc(1, sizeof *model);

    skew_machine(&model->machine);
    model->control.feedforward = true;
    set_gains(model, 50, 2);
    set_all_axes(model);
    set_formula(&model->disturbance.leg_force[2], "0.1*sin(2*t)");
    model->initial.component[GOUGH_YAW] = 0.1;
    model->initial.given[GOUGH_YAW] = true;
    return model;
}

/* the violation of (1.2) in the state that a run goes on from, at each row; and in the rates */
typedef struct {
    const forward *d;
    double worst, worst_rate, drift;
} projected;

static int look(void *context, const gough_row *row) {
    projected *p = context;
    const coordinates x = coordinates_load(p->d->y), v = coordinates_load(p->d->y + COORDINATES);
    const double e = fabs(dot(x.q.i, v.q.i)) + fabs(dot(x.q.j, v.q.j)) + fabs(dot(x.q.k, v.q.k)) +
                     fabs(dot(x.q.i, v.q.j) + dot(v.q.i, x.q.j)) +
                     fabs(dot(x.q.j, v.q.k) + dot(v.q.j, x.q.k)) +
                     fabs(dot(x.q.k, v.q.i) + dot(v.q.k, x.q.i));

    p->worst = fmax(p->worst, triad_violation(&x.q));
    p->worst_rate = fmax(p->worst_rate, e);
    p->drift = fmax(p->drift, row->value[GOUGH_DRIFT]);
    return isfinite(e) ? 0 : 1;
}

START_TEST(projection_holds_over_a_million_steps) {
    gough_model *model = closed_loop();
    gough_simulation s = gough_simulation_default();
    gough_end end = {0};
    forward d;
    projected p = {&d, 0, 0, 0};

    s.duration = 1000;
    s.output_step = 0.05;
    s.step = 0.001;
    s.method = GOUGH_RK4;
    const simulate_parts parts = {&model->motion,
                                  &model->machine,
                                  &model->control,
                                  &model->disturbance,
                                  &model->initial,
                                  0,
                                  0};
    forward_open(&d, &parts, &s, look, &p, &end);
    forward_start(&d);
    ck_assert_int_eq(forward_begin(&d), GOUGH_OK);
    ck_assert_int_eq(forward_fixed(&d), GOUGH_OK);
    ck_assert_int_eq((int)d.row, 20001);
    printf("1e6 steps: constraints %.1e after projection (%.1e before), their rates %.1e\n",
           p.worst, p.drift, p.worst_rate);
    ck_assert(p.worst <= 1e-14);
    ck_assert(p.worst_rate <= 1e-14);
    free(model);
}
END_TEST

static int keep(void *context, const gough_row *row) {
    memcpy(context, row->value, sizeof row->value);
    return 0;
}

static void simulate(const gough_model *model, gough_simulation *s, double last[GOUGH_COLUMNS]) {
    gough_error error = {0};
    gough_end end;

    ck_assert_msg(gough_simulate(model, s, keep, last, &end, &error) == GOUGH_OK, "%s",
                  error.message);
}

static double furthest(const double *a, const double *b) {
    double worst = 0;

    for (int c = GOUGH_X; c <= GOUGH_WZ; c++) {
        ck_assert(isfinite(a[c] - b[c]));
        worst = fmax(worst, fabs(a[c] - b[c]));
    }
    return worst;
}

START_TEST(double_agrees_with_quadruple) {
    gough_model *model = closed_loop();
    gough_simulation s = gough_simulation_default();
    double one[GOUGH_COLUMNS], two[GOUGH_COLUMNS];

    s.tolerance = 1e-14;
    simulate(model, &s, one);
    s.precision = GOUGH_QUADRUPLE;
    s.tolerance = 1e-15;
    simulate(model, &s, two);
    printf("double against quadruple at t = 20: %.1e\n", furthest(one, two));
    ck_assert(furthest(one, two) <= 1e-12);
    free(model);
}
END_TEST

/* without projection the violation grows; Baumgarte's terms bound it; all agree while tolerances are tight */
START_TEST(constraints_by_every_road) {
    gough_model *model = closed_loop();
    gough_simulation s = gough_simulation_default();
    double projection[GOUGH_COLUMNS], none[GOUGH_COLUMNS], baumgarte[GOUGH_COLUMNS];
    double coarse[GOUGH_COLUMNS], held[GOUGH_COLUMNS];

    s.tolerance = 1e-13;
    simulate(model, &s, projection);
    s.constraints = GOUGH_NONE;
    simulate(model, &s, none);
    s.constraints = GOUGH_BAUMGARTE;
    s.baumgarte[0] = s.baumgarte[1] = 5;
    simulate(model, &s, baumgarte);
    ck_assert(furthest(projection, none) <= 1e-8);
    ck_assert(furthest(projection, baumgarte) <= 1e-8);

    /* coarse steps over a longer time: the violation without stabilisation exceeds that with it */
    s.method = GOUGH_RK4;
    s.step = 0.05;
    s.duration = 60;
    simulate(model, &s, held);
    s.constraints = GOUGH_NONE;
    simulate(model, &s, coarse);
    printf("rk4 at 0.05, t = 60: drift %.1e, with Baumgarte %.1e\n", coarse[GOUGH_DRIFT],
           held[GOUGH_DRIFT]);
    ck_assert(coarse[GOUGH_DRIFT] > 10 * held[GOUGH_DRIFT]);
    free(model);
}
END_TEST

int main(void) {
    return SUITE_RUN("conservation", 240, projection_holds_over_a_million_steps,
                     double_agrees_with_quadruple, constraints_by_every_road);
}
