/* gough_control_law() against (law-1) in extended precision, and against the forces that a run applies, which come from its own
 * path through the code. */
#include <stdlib.h>

#include "gough/dynamics.h"
#include "support/machines.h"
#include "support/suite.h"

static const uint64_t seed = 20261129;

static double any(dice *d) { return dice_between(d, -3, 3); }

/* one instant */
typedef struct {
    gough_control control;
    double F[6], lp[6], dlp[6], l[6], dl[6];
} instant;

static instant random_instant(dice *d) {
    instant x = {.control.feedforward = dice_between(d, 0, 1) > 0.5};
    for (int v = 0; v < 6; v++) {
        x.control.stiffness[v] = dice_between(d, 0, 500);
        x.control.damping[v] = dice_between(d, 0, 50);
        x.F[v] = any(d);
        x.lp[v] = 1 + any(d) / 10;
        x.dlp[v] = any(d);
        x.l[v] = x.lp[v] + any(d) / 1000;
        x.dl[v] = x.dlp[v] + any(d) / 100;
    }
    return x;
}

/* F^p + G (l^p − l) + D (l̇^p − l̇), and the sum of what is added, to which rounding is in proportion */
static long double wanted(const instant *x, int v, long double *size) {
    const long double G = x->control.stiffness[v], D = x->control.damping[v];
    const long double F = x->control.feedforward ? x->F[v] : 0;
    *size = fabsl(F) + G * (fabsl(x->lp[v]) + fabsl(x->l[v])) +
            D * (fabsl(x->dlp[v]) + fabsl(x->dl[v]));
    return F + G * ((long double)x->lp[v] - x->l[v]) + D * ((long double)x->dlp[v] - x->dl[v]);
}

START_TEST(the_law_is_that_of_each_leg_by_itself) {
    dice d = {seed};
    for (int n = 0; n < 1000; n++) {
        const instant x = random_instant(&d);
        double force[6];
        gough_control_law(&x.control, x.F, x.lp, x.dlp, x.l, x.dl, force);
        for (int v = 0; v < 6; v++) {
            long double size;
            const long double want = wanted(&x, v, &size);
            /* five roundings */
            ck_assert_msg(fabsl(force[v] - want) <= 6e-16L * size,
                          "seed %llu, instant %d, leg %d: %.17g, not %.17Lg",
                          (unsigned long long)seed, n, v + 1, force[v], want);
        }
    }
}
END_TEST

START_TEST(the_forces_may_take_the_place_of_any_input) {
    dice d = {seed + 1};
    for (int which = 0; which < 5; which++) {
        instant x = random_instant(&d);
        double force[6], *const input[] = {x.F, x.lp, x.dlp, x.l, x.dl};
        x.control.feedforward = true;
        gough_control_law(&x.control, x.F, x.lp, x.dlp, x.l, x.dl, force);
        gough_control_law(&x.control, x.F, x.lp, x.dlp, x.l, x.dl, input[which]);
        ck_assert_msg(memcmp(force, input[which], sizeof force) == 0, "input %d", which);
    }
}
END_TEST

START_TEST(without_feed_forward_program_forces_are_not_read) {
    dice d = {seed + 2};
    instant x = random_instant(&d);
    double force[6], other[6];
    x.control.feedforward = false;
    gough_control_law(&x.control, NULL, x.lp, x.dlp, x.l, x.dl, force);
    for (int v = 0; v < 6; v++) x.F[v] = NAN;
    gough_control_law(&x.control, x.F, x.lp, x.dlp, x.l, x.dl, other);
    ck_assert_int_eq(memcmp(force, other, sizeof force), 0);
    for (int v = 0; v < 6; v++) ck_assert(isfinite(force[v]));
}
END_TEST

START_TEST(what_is_not_a_number_stays_in_its_leg) {
    dice d = {seed + 3};
    for (int which = 0; which < 5; which++) {
        instant x = random_instant(&d);
        double force[6], other[6], *const input[] = {x.F, x.lp, x.dlp, x.l, x.dl};
        x.control.feedforward = true;
        gough_control_law(&x.control, x.F, x.lp, x.dlp, x.l, x.dl, force);
        input[which][2] = NAN;
        gough_control_law(&x.control, x.F, x.lp, x.dlp, x.l, x.dl, other);
        for (int v = 0; v < 6; v++)
            ck_assert(v == 2 ? isnan(other[v]) : memcmp(&force[v], &other[v], sizeof(double)) == 0);
    }
}
END_TEST

/* ---- against runs --------------------------------------------------------------------------------------------------- */

typedef struct {
    const gough_model *model;
    int rows;
    double worst, deviation;
} comparison;

static int compare(void *context, const gough_row *row) {
    comparison *c = context;
    const gough_model *m = c->model;
    const double *value = row->value;
    double F[6], lp[6], dlp[6], force[6];
    gough_acceleration a;
    gough_state s;
    gough_program(&m->machine, &m->motion, value[GOUGH_T], &s, &a);
    ck_assert_int_eq(gough_inverse_dynamics(&m->machine, &s, &a, NULL, F, NULL), GOUGH_OK);
    ck_assert_int_eq(gough_leg_kinematics(&m->machine, &s, NULL, lp, dlp, NULL), GOUGH_OK);
    gough_control_law(&m->control, F, lp, dlp, value + GOUGH_L, value + GOUGH_DL, force);
    for (int v = 0; v < 6; v++) {
        const double error = fabs(force[v] - value[GOUGH_F + v]);
        ck_assert(error >= 0);
        if (error > c->worst) c->worst = error;
        if (fabs(lp[v] - value[GOUGH_L + v]) > c->deviation)
            c->deviation = fabs(lp[v] - value[GOUGH_L + v]);
    }
    c->rows++;
    return 0;
}

START_TEST(runs_apply_the_law) {
    for (int feeds = 0; feeds < 2; feeds++) {
        gough_model *model = calloc(1, sizeof *model);
        gough_simulation s = gough_simulation_default();
        gough_error error = {.message = ""};
        gough_end end;
        comparison c = {.model = model};
        ck_assert_ptr_nonnull(model);
        skew_machine(&model->machine);
        set_all_axes(model);
        for (int v = 0; v < 6; v++) {
            model->control.stiffness[v] = 200 + 10 * v;
            model->control.damping[v] = 5 + v;
        }
        model->control.feedforward = feeds;
        /* so that the feedback has something to do */
        set_formula(&model->disturbance.force[0], "0.3*sin(3*t)");
        s.duration = 5;
        ck_assert_msg(gough_simulate(model, &s, compare, &c, &end, &error) == GOUGH_OK, "%s",
                      error.message);
        ck_assert_int_eq(c.rows, 101);
        ck_assert_msg(c.deviation > 1e-4, "the legs follow to %g", c.deviation);
        /* rounding of lengths near 1.3 times a stiffness of 250, a few times */
        ck_assert_msg(c.worst <= 1e-12, "forces differ by %g", c.worst);
        free(model);
    }
}
END_TEST

/* ---- whether a loop keeps its program ---- */

static int watch(void *context, const gough_row *row) {
    double *most = context;

    for (int c = 0; c < 3; c++) {
        const double e = fabs(row->value[GOUGH_EX + c]);
        if (!(e <= *most)) *most = e;
    }
    return 0;
}

/* what the machine has and what the feed-forward ignores, as bits: mass of the legs, viscous friction, a load */
static void check_keeping(int has, int ignores, bool feeds, bool moving) {
    gough_model *model = calloc(1, sizeof *model);
    gough_simulation s = gough_simulation_default();
    gough_external wind = {.at_given = false};
    double most = 0;
    gough_end end;
    dice d = {7};

    ck_assert_ptr_nonnull(model);
    skew_machine(&model->machine);
    give_legs(&model->machine, (has & 1 ? LEGS_HEAVY : 0) | (has & 2 ? LEGS_VISCOUS : 0), &d);
    set_formula(&wind.force[1], "0.05");
    if (has & 4) ck_assert(gough_machine_set_external(&model->machine, &wind, 1, NULL) == GOUGH_OK);
    if (moving) set_all_axes(model);
    set_gains(model, 20, 1);
    model->control.feedforward = feeds;
    model->control.ignores_legs = ignores & 1;
    model->control.ignores_friction = ignores & 2;
    model->control.ignores_external = ignores & 4;
    s.duration = 1;
    ck_assert(gough_simulate(model, &s, watch, &most, &end, NULL) == GOUGH_OK);
    const bool keeps = gough_keeps_program(&model->machine, &model->control, moving);
    ck_assert_msg(keeps ? most <= 1e-8 : most > 1e-5,
                  "has %d, ignores %d, feeds %d, moving %d: keeps %d, but is off by %g", has,
                  ignores, feeds, moving, keeps, most);
    free(model);
}

/* each combination against a run of it */
START_TEST(a_loop_keeps_its_program_if_its_run_does) {
    for (int has = 0; has < 8; has++) {
        for (int ignores = 0; ignores < 8; ignores++) {
            for (int way = 0; way < 4; way++) check_keeping(has, ignores, way & 1, way & 2);
        }
    }
}
END_TEST

int main(void) {
    return SUITE_RUN("plant/law", 60, the_law_is_that_of_each_leg_by_itself,
                     the_forces_may_take_the_place_of_any_input,
                     without_feed_forward_program_forces_are_not_read,
                     what_is_not_a_number_stays_in_its_leg, runs_apply_the_law,
                     a_loop_keeps_its_program_if_its_run_does);
}
