/* The search with a sampled controller: between the edges of its window the G found meets the accuracy, and beyond them runs do
 * not; damping ratios are those of the multipliers; where the window is closed it says so.
 * Sanitized: campaign: hundreds of runs and thousands of eigenvalues.
 * Label: thorough. */
#include <complex.h>
#include <stdlib.h>

#include "support/machines.h"
#include "support/suite.h"
#include "tune/requests.h"

static request pushed(double period, double delay, gough_velocity velocity, double damping) {
    request r = request_pushed(damping);

    r.model->control.sampling =
        (gough_sampling){.period = period, .delay = delay, .velocity = velocity};
    return r;
}

/* the window at rest is known: G above 0.894107, and with D = 0.3 below 12.0008 */
START_TEST(the_least_stiffness_meets_the_accuracy_and_lies_in_the_window) {
    request r = pushed(0.05, 0, GOUGH_VELOCITY_EXACT, 0.3);
    const gough_tuning *t = &r.tuning;

    request_find(&r, true);
    ck_assert(t->found && t->sampled && !t->periodic);
    ck_assert(fabs(t->threshold - 0.894107) <= 1e-6 && fabs(t->upper - 12.0008) <= 1e-4);
    ck_assert_str_eq(t->upper_mode.name, "heave");
    ck_assert(strstr(t->unchecked, "home was checked, from sample to sample") != NULL);
    ck_assert(t->stiffness > t->threshold && t->stiffness < t->upper);
    ck_assert(request_deviation(&r, t->stiffness, 0.3, 12) <= r.options.deviation);
    ck_assert(request_deviation(&r, t->fails * (1 - 1e-3), 0.3, 12) > r.options.deviation);
    /* beyond either edge deviations grow, in time over any accuracy */
    const double below = request_deviation(&r, 0.8 * t->threshold, 0.3, 60),
                 above = request_deviation(&r, 1.2 * t->upper, 0.3, 60);
    ck_assert_msg(below > 20 * r.options.deviation && above > 20 * r.options.deviation,
                  "0.8 of the lower edge: %g, 1.2 of the upper one: %g", below, above);
    ck_assert(request_deviation(&r, 0.9 * t->upper, 0.3, 60) <= r.options.deviation);
    /* the search ends below the upper edge */
    for (size_t i = 0; i < t->points; i++) {
        const gough_tuning_point *p = &r.point[i];
        ck_assert(p->stiffness < t->upper / 1.02);
        ck_assert(p->stable == (p->stiffness > t->threshold));
    }
    const gough_tuning_point *last = &r.point[t->points - 1];
    gough_sampled_rest rest;
    set_gains(r.model, last->stiffness, 0.3);
    ck_assert_int_eq(gough_sampled_at_rest(r.model, NULL, &rest, NULL), GOUGH_OK);
    ck_assert(fabs(last->growth - exp(rest.growth)) <= 1e-12);
    request_drop(&r);
}
END_TEST

/* smallest damping ratio of the poles ln μ/T */
static double ratio_of(const gough_model *model) {
    gough_sampled_rest rest;
    double least = INFINITY;

    ck_assert_int_eq(gough_sampled_at_rest(model, NULL, &rest, NULL), GOUGH_OK);
    for (size_t k = 0; k < rest.listed; k++) {
        const double *mu = rest.multiplier[k].value;
        const double complex pole = clog(mu[0] + I * mu[1]);
        if (hypot(mu[0], mu[1]) > 1e-9) least = fmin(least, -creal(pole) / cabs(pole));
    }
    return least;
}

START_TEST(damping_ratios_are_those_of_the_sampled_poles) {
    static const struct {
        double period, delay, ratio;
        gough_velocity velocity;
    } cases[] = {{0.05, 0, 0.2, GOUGH_VELOCITY_EXACT},
                 {0.02, 0.02, 0.3, GOUGH_VELOCITY_DIFFERENCE},
                 {0.0437, 0.031, 0.15, GOUGH_VELOCITY_EXACT}};

    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        request r = pushed(cases[k].period, cases[k].delay, cases[k].velocity, 0);
        const gough_tuning *t = &r.tuning;
        double damping, continuous;

        r.options.damping_ratio = cases[k].ratio;
        request_find(&r, true);
        ck_assert_msg(t->found, "%s", t->reason);
        set_gains(r.model, t->stiffness, t->damping);
        ck_assert(fabs(ratio_of(r.model) - cases[k].ratio) <= 1e-7);
        ck_assert(fabs(t->damping_ratio - cases[k].ratio) <= 1e-7);
        ck_assert(request_deviation(&r, t->stiffness, t->damping, 12) <= r.options.deviation);
        /* the edge: a little above it all dampings fall short */
        for (double D = 0.1 * t->damping; D < 30 * t->damping && k == 0; D *= 1.01) {
            set_gains(r.model, t->upper * 1.002, D);
            ck_assert(ratio_of(r.model) < cases[k].ratio);
        }
        /* above it there is no such damping, below it there is */
        set_gains(r.model, t->upper * 1.001, 0);
        ck_assert_int_eq(gough_damping_for_ratio(r.model, cases[k].ratio, &damping, NULL),
                         GOUGH_ERROR_NUMERICAL);
        set_gains(r.model, t->upper * 0.999, 0);
        ck_assert_int_eq(gough_damping_for_ratio(r.model, cases[k].ratio, &damping, NULL),
                         GOUGH_OK);
        set_gains(r.model, t->upper * 0.999, damping);
        ck_assert(fabs(ratio_of(r.model) - cases[k].ratio) <= 1e-7);
        /* samples without end: the damping of the continuous loop, and what the delay τ + T/2 takes away, to first order */
        set_gains(r.model, 3, 0);
        r.model->control.sampling.period = 1e-4;
        r.model->control.sampling.delay = 0;
        ck_assert_int_eq(gough_damping_for_ratio(r.model, 0.2, &damping, NULL), GOUGH_OK);
        r.model->control.sampling.period = 0;
        ck_assert_int_eq(gough_damping_for_ratio(r.model, 0.2, &continuous, NULL), GOUGH_OK);
        ck_assert_msg(fabs(damping - continuous) <= 1e-3 * continuous, "%.9g, continuous %.9g",
                      damping, continuous);
        ck_assert(damping > continuous);
        request_drop(&r);
    }
}
END_TEST

static void fails_because(request *r, const char *words, const char *number) {
    request_find(r, true);
    ck_assert(!r->tuning.found);
    ck_assert_msg(strstr(r->tuning.reason, words) != NULL &&
                      strstr(r->tuning.reason, number) != NULL,
                  "%s", r->tuning.reason);
    ck_assert_uint_lt(strlen(r->tuning.reason), sizeof r->tuning.reason - 1);
    request_drop(r);
}

START_TEST(says_which_edge_is_in_the_way) {
    /* the longest period of this machine with differences and a delay of one period is 0.138, known by search */
    request r = pushed(0.2, 0.2, GOUGH_VELOCITY_DIFFERENCE, 0.3);
    fails_because(&r, "the window of G is closed", "0.138");
    r = pushed(0.2, 0.2, GOUGH_VELOCITY_DIFFERENCE, 0);
    r.options.damping_ratio = 0.2;
    fails_because(&r, "no D gives its least damped mode the ratio 0.2", "0.138");
    r = pushed(0.05, 0.05, GOUGH_VELOCITY_EXACT, 0);
    fails_because(&r, "without damping", "give --damping-ratio");
    r = pushed(0.05, 0.05, GOUGH_VELOCITY_EXACT, 0.3);
    r.options.deviation = 1e-5;
    fails_because(&r, "the upper edge of stability comes first", "3.75109 (sway–tilt)");
}
END_TEST

static void refuses(request *r, const char *words) {
    gough_error error = {0};

    ck_assert_int_eq(request_ask(r, true, &error), GOUGH_ERROR_INPUT);
    ck_assert_msg(strstr(error.message, words) != NULL, "%s", error.message);
    request_drop(r);
}

START_TEST(refuses_searches_beyond_the_window_and_a_ratio_of_zero) {
    request r = pushed(0.05, 0, GOUGH_VELOCITY_EXACT, 0.3);
    r.options.least = 13;
    r.options.greatest = 100;
    refuses(&r, "up to 12.0008 only (heave)");
    r = pushed(0.05, 0, GOUGH_VELOCITY_EXACT, 0.3);
    r.options.damping_ratio = 0;
    refuses(&r, "with a sampled controller the damping ratio must be greater than 0");
    r = pushed(0.05, 0, GOUGH_VELOCITY_EXACT, 0.3);
    r.model->control.coupled = true;
    r.model->control.cross_damping[2][1] = 0.01;
    refuses(&r, "give --damping-ratio, or a damping of one number or six");
}
END_TEST

/* the study's matrices have no say in a search for one number */
START_TEST(a_search_leaves_matrices_aside) {
    request plain = pushed(0.05, 0, GOUGH_VELOCITY_EXACT, 0.3),
            matrix = pushed(0.05, 0, GOUGH_VELOCITY_EXACT, 0.3);

    matrix.model->control.coupled = true;
    matrix.model->control.cross_stiffness[0][3] = matrix.model->control.cross_stiffness[3][0] = 2;
    plain.options.damping_ratio = matrix.options.damping_ratio = 0.2;
    matrix.model->control.cross_damping[1][2] = 0.2;
    request_find(&plain, true);
    request_find(&matrix, true);
    ck_assert(plain.tuning.found && matrix.tuning.found);
    ck_assert(fabs(plain.tuning.stiffness - matrix.tuning.stiffness) <= 0);
    ck_assert(fabs(plain.tuning.damping - matrix.tuning.damping) <= 0);
    ck_assert(fabs(plain.tuning.upper - matrix.tuning.upper) <= 0);
    request_drop(&plain);
    request_drop(&matrix);
}
END_TEST

/* Drives that lag narrow the window from above, and the search knows: beyond its edges runs leave the program, between them they
 * do not, and damping ratios count the poles of the drives. */
START_TEST(lagging_drives_are_part_of_the_loop) {
    request r = pushed(0.02, 0, GOUGH_VELOCITY_EXACT, 0.3), ideal = r;
    gough_platform p = r.model->machine.platform;
    const gough_load load = r.model->machine.load;
    const double gravity[3] = {0, 0, -1};
    gough_sampled_margins margins;
    double damping;

    for (int v = 0; v < GOUGH_LEGS; v++) p.actuators.time_constant[v] = 0.04;
    p.actuators.kind = GOUGH_ACTUATOR_LAG;
    request_find(&ideal, true);
    const double upper = ideal.tuning.upper;
    ck_assert_int_eq(gough_machine_init(&r.model->machine, &p, &load, gravity, NULL), GOUGH_OK);
    request_find(&r, true);
    const gough_tuning *t = &r.tuning;
    ck_assert_msg(t->found, "%s", t->reason);
    /* D/(T/2) without the lag, D/(T/2 + T_a) with it, to first order */
    ck_assert(fabs(upper / 30 - 1) <= 0.02 && fabs(t->upper / 6 - 1) <= 0.1);
    set_gains(r.model, t->stiffness, 0.3);
    ck_assert_int_eq(gough_sampled_margins_at_rest(r.model, NULL, &margins, NULL), GOUGH_OK);
    ck_assert(fabs(margins.upper.stiffness - t->upper) <= 1e-9 * t->upper);
    ck_assert(request_deviation(&r, t->stiffness, 0.3, 12) <= r.options.deviation);
    ck_assert(request_deviation(&r, t->fails * (1 - 1e-3), 0.3, 12) > r.options.deviation);
    ck_assert(request_deviation(&r, 0.8 * t->threshold, 0.3, 60) > 20 * r.options.deviation);
    ck_assert(request_deviation(&r, 1.2 * t->upper, 0.3, 60) > 20 * r.options.deviation);
    ck_assert(request_deviation(&r, 0.9 * t->upper, 0.3, 60) <= r.options.deviation);
    r.options.damping_ratio = 0.15;
    request_find(&r, true);
    ck_assert_msg(t->found, "%s", t->reason);
    set_gains(r.model, t->stiffness, t->damping);
    ck_assert(fabs(ratio_of(r.model) - 0.15) <= 1e-7);
    set_gains(r.model, t->upper * 1.001, 0);
    ck_assert_int_eq(gough_damping_for_ratio(r.model, 0.15, &damping, NULL), GOUGH_ERROR_NUMERICAL);
    request_drop(&r);
}
END_TEST

/* the largest multiplier over a period of the program, with these gains */
static double growth_along(const request *r, double stiffness, double damping) {
    gough_model *model = malloc(sizeof *model);
    gough_sampled_floquet f;
    gough_error error = {0};

    ck_assert(model != NULL);
    *model = *r->model;
    set_gains(model, stiffness, damping);
    ck_assert_msg(gough_floquet_sampled(model, NULL, &f, &error) == GOUGH_OK, "%s", error.message);
    free(model);
    return f.growth;
}

/* At home this loop holds from 0.894 on. The program pumps its yaw up to 1.165: there the search has to go on, and its margin keeps
 * clear of that. */
START_TEST(a_program_that_pumps_a_mode_is_kept_clear_of) {
    request r = pushed(2 * pi / 3 / 200, 0, GOUGH_VELOCITY_EXACT, 0.03);
    const gough_tuning *t = &r.tuning;

    r.model->control.sampling.preview = pi / 3 / 200;
    set_formula(&r.model->motion.formula[GOUGH_HEAVE], "0.15*sin(3*t)");
    for (int v = 0; v < GOUGH_LEGS; v++)
        set_formula(&r.model->disturbance.leg_force[v], v == 0 ? "1e-6" : "0");
    r.options.deviation = 0.05;
    request_find(&r, true);
    ck_assert_msg(t->found && t->periodic && *t->unchecked == '\0', "%s%s", t->reason,
                  t->unchecked);
    ck_assert(growth_along(&r, 1.1, 0.03) > 1.01);
    ck_assert(t->stiffness > 1.165 / 0.98 && t->stiffness < 1.3);
    for (int side = -1; side <= 1; side++)
        ck_assert(growth_along(&r, t->stiffness * (1 + 0.02 * side), 0.03) <= 1 + 1e-7);
    ck_assert_int_eq(t->binding, GOUGH_TUNING_TONGUE);
    ck_assert_str_eq(t->mode.name, "yaw");
    /* with ten times as many samples the program is not followed, and that is said */
    r.model->control.sampling.period /= 10;
    r.options.greatest = 2;
    r.options.least = 1;
    request_find(&r, true);
    ck_assert(!t->periodic);
    ck_assert_msg(strstr(t->unchecked,
                         "1 period of the program has 2000 samples, and only up to 1000 "
                         "are followed, so home was checked") != NULL,
                  "%s", t->unchecked);
    request_drop(&r);
}
END_TEST

int main(void) {
    return SUITE_RUN(
        "tune_sampled", 60, the_least_stiffness_meets_the_accuracy_and_lies_in_the_window,
        damping_ratios_are_those_of_the_sampled_poles, says_which_edge_is_in_the_way,
        refuses_searches_beyond_the_window_and_a_ratio_of_zero, a_search_leaves_matrices_aside,
        lagging_drives_are_part_of_the_loop, a_program_that_pumps_a_mode_is_kept_clear_of);
}
