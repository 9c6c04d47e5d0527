/* The search with continuous controllers whose loop has states of its own, drives that lag and integrals: its upper edge against
 * D/T_a, damping ratios against all eigenvalues of the loop, the G found against runs, growth against multipliers.
 * Sanitized: campaign: hundreds of runs and thousands of eigenvalues.
 * Label: standard. */
#include <stdlib.h>

#include "support/machines.h"
#include "support/suite.h"
#include "tune/requests.h"

/* drives of first order where `frequency` is 0, else of second order with a damping ratio of 0.7; a lag of 0: none */
static request pushed(double lag, double frequency, double integral, double damping) {
    request r = request_pushed(damping);
    const double gravity[3] = {0, 0, -1};
    gough_platform p = r.model->machine.platform;
    const gough_load load = r.model->machine.load;

    if (lag > 0 || frequency > 0) p.actuators.kind = GOUGH_ACTUATOR_LAG;
    for (int v = 0; v < GOUGH_LEGS; v++) {
        p.actuators.time_constant[v] = lag;
        p.actuators.frequency[v] = frequency;
        p.actuators.damping_ratio[v] = frequency > 0 ? 0.7 : 0;
        r.model->control.integral[v] = integral;
    }
    ck_assert_int_eq(gough_machine_init(&r.model->machine, &p, &load, gravity, NULL), GOUGH_OK);
    return r;
}

/* smallest −Re λ/|λ| of all eigenvalues at home */
static double ratio_of(const request *r, double stiffness, double damping) {
    double least = INFINITY;
    gough_rest rest;

    set_gains(r->model, stiffness, damping);
    ck_assert_int_eq(gough_stability_at_rest(r->model, NULL, &rest, NULL), GOUGH_OK);
    ck_assert_uint_gt(rest.size, GOUGH_LINEAR);
    for (size_t k = 0; k < rest.size; k++) {
        const double *s = rest.eigenvalue[k].value;
        least = fmin(least, -s[0] / hypot(s[0], s[1]));
    }
    return least;
}

/* (loop-9) is the upper edge, the threshold the lower one; between them runs stay, beyond them they do not */
START_TEST(a_lag_of_first_order_leaves_the_window_of_its_closed_form) {
    request r = pushed(0.04, 0, 0, 0.3);
    const gough_tuning *t = &r.tuning;

    request_find(&r, true);
    ck_assert_msg(t->found && t->states && !t->sampled, "%s", t->reason);
    ck_assert(fabs(t->threshold - 0.894107) <= 1e-6);
    ck_assert_msg(fabs(t->upper * 0.04 / 0.3 - 1) <= 1e-9, "%.12g", t->upper);
    ck_assert(t->upper_frequency > 0 && t->upper_mode.name[0] != '\0');
    ck_assert(request_deviation(&r, t->stiffness, 0.3, 12) <= r.options.deviation);
    ck_assert(request_deviation(&r, t->fails * (1 - 1e-3), 0.3, 12) > r.options.deviation);
    ck_assert(request_deviation(&r, 0.8 * t->threshold, 0.3, 60) > 20 * r.options.deviation);
    ck_assert(request_deviation(&r, 1.2 * t->upper, 0.3, 60) > 20 * r.options.deviation);
    ck_assert(request_deviation(&r, 0.9 * t->upper, 0.3, 60) <= r.options.deviation);
    ck_assert(fabs(t->damping_ratio - ratio_of(&r, t->stiffness, 0.3)) <= 1e-9);
    for (size_t i = 0; i < t->points; i++) {
        const gough_tuning_point *p = &r.point[i];
        ck_assert(p->stiffness < t->upper / 1.02 && p->judged == GOUGH_TUNING_AT_REST);
        ck_assert(p->stable == (p->stiffness > t->threshold));
    }
    request_drop(&r);
}
END_TEST

START_TEST(damping_ratios_are_those_of_all_poles) {
    static const struct {
        double lag, frequency, integral, ratio;
    } cases[] = {{0.04, 0, 0, 0.2}, {0, 12, 0, 0.3}, {0.02, 0, 0.5, 0.25}, {0, 0, 0.3, 0.4}};

    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        const double z = cases[k].ratio;
        request r = pushed(cases[k].lag, cases[k].frequency, cases[k].integral, 0);
        const gough_tuning *t = &r.tuning;
        double damping;

        r.options.damping_ratio = z;
        r.options.least = 0.95;
        r.options.greatest = 6;
        request_find(&r, true);
        ck_assert_msg(t->found, "case %zu: %s", k, t->reason);
        ck_assert(fabs(ratio_of(&r, t->stiffness, t->damping) - z) <= 1e-7);
        ck_assert(fabs(t->damping_ratio - z) <= 1e-7);
        ck_assert(request_deviation(&r, t->stiffness, t->damping, 12) <= r.options.deviation);
        /* the least damping that does: any less falls short */
        for (double D = t->damping * 0.999; D > 1e-3 * t->damping; D *= 0.97)
            ck_assert(ratio_of(&r, t->stiffness, D) < z);
        if (!(cases[k].lag > 0 || cases[k].frequency > 0)) {
            ck_assert(isinf(t->upper));
            request_drop(&r);
            continue;
        }
        /* above the edge all dampings fall short */
        for (double D = 0.1 * t->damping; D < 300 * t->damping; D *= 1.01)
            ck_assert(ratio_of(&r, t->upper * 1.002, D) < z);
        set_gains(r.model, t->upper * 1.001, 0);
        ck_assert_int_eq(gough_damping_for_ratio(r.model, z, &damping, NULL),
                         GOUGH_ERROR_NUMERICAL);
        set_gains(r.model, t->upper * 0.999, 0);
        ck_assert_int_eq(gough_damping_for_ratio(r.model, z, &damping, NULL), GOUGH_OK);
        ck_assert(fabs(ratio_of(&r, t->upper * 0.999, damping) - z) <= 1e-7);
        request_drop(&r);
    }
}
END_TEST

static void fails_because(request *r, const char *words, const char *more) {
    request_find(r, true);
    ck_assert(!r->tuning.found);
    ck_assert_msg(strstr(r->tuning.reason, words) != NULL && strstr(r->tuning.reason, more) != NULL,
                  "%s", r->tuning.reason);
    request_drop(r);
}

START_TEST(says_which_edge_is_in_the_way) {
    request r = pushed(0.04, 0, 0, 0);
    gough_error error = {0};
    double damping;

    fails_because(&r, "the window of G is closed: at home, with drives that lag, without damping",
                  "take faster drives");
    r = pushed(0.4, 0, 0, 0.3); /* D/T_a = 0.75, below the threshold */
    fails_because(&r, "the damping D = 0.3 does not hold it", "take faster drives");
    r = pushed(0.04, 0, 0, 0.3);
    r.options.deviation = 1e-5;
    fails_because(&r, "the loop with drives that lag holds the platform at home for G below 7.5",
                  "take faster drives, or give --damping-ratio");
    r = pushed(0, 0, 0.5, 0);
    fails_because(&r, "with an integral, without damping", "reduce control.integral");
    r = pushed(0.04, 0, 0, 0.3);
    r.options.least = 8;
    r.options.greatest = 100;
    ck_assert_int_eq(request_ask(&r, true, &error), GOUGH_ERROR_INPUT);
    ck_assert_msg(strstr(error.message, "up to 7.5 only") != NULL, "%s", error.message);
    set_gains(r.model, 3, 0);
    ck_assert_int_eq(gough_damping_for_ratio(r.model, 0, &damping, &error), GOUGH_ERROR_INPUT);
    ck_assert(strstr(error.message, "must be greater than 0") != NULL);
    request_drop(&r);
}
END_TEST

/* the largest multiplier over a period of the program, with these gains */
static double growth_along(const request *r, double stiffness, double damping) {
    gough_error error = {0};
    gough_floquet f;

    set_gains(r->model, stiffness, damping);
    ck_assert_msg(gough_floquet_multipliers(r->model, NULL, 0, &f, &error) == GOUGH_OK, "%s",
                  error.message);
    return f.growth;
}

/* At home this loop holds from 0.894 on; the program pumps its yaw further up. With drives as slow as these the points that hold at
 * home are judged along the program too. */
START_TEST(points_and_the_stiffness_named_are_judged_along_the_program) {
    request r = pushed(0.02, 0, 0, 0.05);
    const gough_tuning *t = &r.tuning;
    size_t along = 0, pumped = 0;

    set_formula(&r.model->motion.formula[GOUGH_HEAVE], "0.15*sin(3*t)");
    for (int v = 0; v < GOUGH_LEGS; v++)
        set_formula(&r.model->disturbance.leg_force[v], v == 0 ? "1e-6" : "0");
    r.options.deviation = 0.05;
    r.options.greatest = 2;
    request_find(&r, true);
    ck_assert_msg(t->found && t->periodic && *t->unchecked == '\0', "%s%s", t->reason,
                  t->unchecked);
    for (int side = -1; side <= 1; side++)
        ck_assert(growth_along(&r, t->stiffness * (1 + 0.02 * side), 0.05) <= 1 + 1e-7);
    for (size_t i = 0; i < t->points; i++) {
        const gough_tuning_point *p = &r.point[i];
        ck_assert((p->judged == GOUGH_TUNING_ALONG) ==
                  (p->stiffness > t->threshold && p->cause == GOUGH_END_DONE));
        if (p->judged != GOUGH_TUNING_ALONG) continue;
        along++;
        pumped += !p->stable;
        const double growth = growth_along(&r, p->stiffness, 0.05);
        ck_assert_msg(fabs(p->growth - growth) <= 1e-6, "G %.9g: %.12g, multiplier %.12g",
                      p->stiffness, p->growth, growth);
        ck_assert(p->stable == (growth <= 1 + 1e-7));
    }
    ck_assert_uint_gt(along, 5);
    ck_assert_uint_gt(pumped, 0);
    /* with drives that are much faster than the program, home alone is checked, and that is said */
    request quick = pushed(1.9e-4, 0, 0, 0.05);
    set_formula(&quick.model->motion.formula[GOUGH_HEAVE], "0.01*sin(3*t)");
    quick.options.least = 3;
    quick.options.greatest = 5;
    quick.simulation.duration = 0.5;
    request_find(&quick, true);
    ck_assert(!quick.tuning.periodic);
    ck_assert_msg(strstr(quick.tuning.unchecked, "only up to 10000 times is followed") != NULL,
                  "%s", quick.tuning.unchecked);
    request_drop(&quick);
    request_drop(&r);
}
END_TEST

static int keep_height(void *context, const gough_row *row) {
    *(double *)context = row->value[GOUGH_EZ];
    return 0;
}

/* Without feed-forward integrals come to bear the load: the loop rests at home, as a run shows, and not where springs sag to. */
START_TEST(integrals_rest_at_home) {
    request r = pushed(0, 0, 2, 1);
    gough_error error = {0};
    gough_simulation s = r.simulation;
    double away = INFINITY;
    gough_rest rest;
    gough_end end;

    r.model->control.feedforward = false;
    memset(&r.model->disturbance, 0, sizeof r.model->disturbance);
    set_gains(r.model, 20, 4);
    ck_assert_int_eq(gough_stability_at_rest(r.model, NULL, &rest, &error), GOUGH_OK);
    ck_assert(fabs(rest.state.position[2] - 1) <= 1e-12 && rest.stable);
    s.duration = s.output_step = 60;
    s.tolerance = 1e-12;
    ck_assert_int_eq(gough_simulate(r.model, &s, keep_height, &away, &end, NULL), GOUGH_OK);
    ck_assert_msg(fabs(away) <= 0.1 * exp(60 * rest.growth) + 1e-11, "%g from home, %g a time",
                  away, rest.growth);
    for (int v = 0; v < GOUGH_LEGS; v++) r.model->control.integral[v] = 0;
    ck_assert_int_eq(gough_simulate(r.model, &s, keep_height, &away, &end, NULL), GOUGH_OK);
    ck_assert(away < -1e-3);
    for (int v = 0; v < GOUGH_LEGS; v++) r.model->control.integral[v] = 2;
    /* the tuning counts with it */
    r.options.deviation = 0.02;
    ck_assert_msg(request_ask(&r, false, &error) == GOUGH_OK, "%s", error.message);
    ck_assert_msg(r.tuning.found, "%s", r.tuning.reason);
    /* some legs with an integral, and some without */
    r.model->control.integral[3] = 0;
    ck_assert_int_eq(gough_stability_at_rest(r.model, NULL, &rest, &error), GOUGH_ERROR_INPUT);
    ck_assert_msg(strstr(error.message, "5 of the legs have an integral") != NULL, "%s",
                  error.message);
    ck_assert_str_eq(error.key, "control.integral");
    r.model->control.feedforward = true;
    ck_assert_int_eq(gough_stability_at_rest(r.model, NULL, &rest, &error), GOUGH_OK);
    request_drop(&r);
}
END_TEST

int main(void) {
    return SUITE_RUN("tune_states", 120, a_lag_of_first_order_leaves_the_window_of_its_closed_form,
                     damping_ratios_are_those_of_all_poles, says_which_edge_is_in_the_way,
                     points_and_the_stiffness_named_are_judged_along_the_program,
                     integrals_rest_at_home);
}
