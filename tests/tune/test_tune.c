/* The choice of the feedback against closed forms, free runs and runs of its own naming.
 * Label: thorough.
 * Not sanitized: the same functions run under sanitizers in the tests of the command. */
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>

#include "support/machines.h"
#include "support/suite.h"
#include "tune/requests.h"

static request begin(double duration) {
    request s = request_new(duration);

    s.model->control.feedforward = true;
    return s;
}

static int summarise(void *context, const gough_row *row) {
    request *s = context;
    const double *e = row->value + GOUGH_EX, d = hypot(hypot(e[0], e[1]), e[2]);

    if (!(d <= s->tuning.scale)) s->tuning.scale = d;
    return 0;
}

/* largest deviation of a run with these gains, by gough_simulate() as the study has it; INFINITY where it ends early */
static double deviation(const request *s, bool feedforward, double G, double D) {
    request run = *s;
    gough_end ended;

    run.model->control.feedforward = feedforward;
    set_gains(run.model, G, D);
    run.tuning.scale = 0;
    return gough_simulate(run.model, &run.simulation, summarise, &run, &ended, NULL) == GOUGH_OK
               ? run.tuning.scale
               : INFINITY;
}

/* the same without feed-forward and damping, and with the motion between rows */
static double between_rows(const request *s, double G) {
    gough_simulation simulation = s->simulation;
    gough_summary summary;
    gough_end ended;

    s->model->control.feedforward = false;
    set_gains(s->model, G, 0);
    simulation.summary = &summary;
    ck_assert(gough_simulate(s->model, &simulation, NULL, NULL, &ended, NULL) == GOUGH_OK);
    return summary.position_deviation;
}

/* what is named meets it, a fifth less does not */
static void check_choice(const request *s, bool feedforward) {
    const gough_tuning *t = &s->tuning;

    ck_assert_msg(t->found, "%s", t->reason);
    ck_assert(deviation(s, feedforward, t->stiffness, t->damping) <= s->options.deviation);
    ck_assert(deviation(s, feedforward, 0.8 * t->stiffness, t->damping) > s->options.deviation);
}

static void set_paper(request *s) {
    set_formula(&s->model->motion.formula[GOUGH_HEAVE], "0.2*sin(t)*(1 - exp(-t/2))^2");
    for (int v = 0; v < GOUGH_LEGS; v++)
        set_formula(&s->model->disturbance.leg_force[v], "0.0001*sin(2*t)*(1 - exp(-t/2))");
}

/* ---- damping ----------------------------------------------------------------------------------------------------- */

/* (tune-1) in random machines: the smallest −Re λ/|λ| of the loop is the one asked for */
START_TEST(damping_gives_the_ratio_asked_for) {
    static gough_rest rest;
    gough_model *model = calloc(1, sizeof *model);
    dice d = {20261};

    for (int i = 0; i < 30; i++) {
        const double ratio = dice_between(&d, 0.01, 0.95);
        gough_error error = {0};
        double D = NAN, least = INFINITY;

        random_symmetric(&d, &model->machine);
        model->control.feedforward = i % 3 != 0;
        set_gains(model, 0, 0);
        model->control.feedforward = true;
        ck_assert(gough_stability_at_rest(model, NULL, &rest, &error) == GOUGH_OK);
        model->control.feedforward = i % 3 != 0;
        set_gains(model, dice_between(&d, 3, 300) * rest.threshold[0].stiffness, 7);
        ck_assert_msg(gough_damping_for_ratio(model, ratio, &D, &error) == GOUGH_OK, "%s",
                      error.message);
        set_gains(model, model->control.stiffness[0], D);
        ck_assert(gough_stability_at_rest(model, NULL, &rest, &error) == GOUGH_OK);
        for (int k = 0; k < GOUGH_LINEAR; k++) {
            const double *value = rest.eigenvalue[k].value;
            least = fmin(least, -value[0] / hypot(value[0], value[1]));
        }
        ck_assert_msg(fabs(least - ratio) <= 1e-10, "%d: %.15g instead of %.15g", i, least, ratio);
    }
    free(model);
}
END_TEST

/* heave stands alone: D 6h²/l² = 2 ζ √(M (6 G h² − M g d²/h)/l²) with the ratio that it then has */
START_TEST(damping_of_heave_is_the_closed_form) {
    const double h2 = 1, d2 = 0.49, l2 = 1.49, G = 40;
    gough_model *model = calloc(1, sizeof *model);
    static gough_rest rest;
    gough_error error = {0};
    double D;

    paper_machine(&model->machine);
    model->control.feedforward = true;
    set_gains(model, G, 0);
    ck_assert(gough_damping_for_ratio(model, 0.2, &D, &error) == GOUGH_OK);
    set_gains(model, G, D);
    ck_assert(gough_stability_at_rest(model, NULL, &rest, &error) == GOUGH_OK);
    for (int k = 0; k < GOUGH_LINEAR; k++) {
        const double *value = rest.eigenvalue[k].value;
        const double ratio = -value[0] / hypot(value[0], value[1]);
        if (strcmp(rest.eigenvalue[k].mode.name, "heave") != 0) continue;
        ck_assert(fabs(D * 6 * h2 / l2 - 2 * ratio * sqrt((6 * G * h2 - d2) / l2)) <= 1e-11 * D);
    }
    ck_assert(gough_damping_for_ratio(model, 1, &D, &error) == GOUGH_ERROR_INPUT);
    set_gains(model, 0.5, 0);
    ck_assert(gough_damping_for_ratio(model, 0.2, &D, &error) == GOUGH_ERROR_NUMERICAL);
    ck_assert(strstr(error.message, "damping cannot change that") != NULL);
    free(model);
}
END_TEST

typedef struct {
    double first, last;
} swing;

static int watch(void *context, const gough_row *row) {
    swing *s = context;

    if (!(row->value[GOUGH_T] > 0)) s->first = row->value[GOUGH_EX];
    s->last = row->value[GOUGH_EX];
    return 0;
}

/* A free nonlinear run that starts in the least damped mode has, a swing later, e^{−2πζ/√(1−ζ²)} of its deviation left. */
START_TEST(a_free_run_decays_by_the_ratio) {
    const double ratio = 0.15, size = 1e-6;
    request s = begin(1);
    static gough_rest rest;
    gough_error error = {0};
    gough_initial *initial = &s.model->initial;
    const gough_eigenvalue *slow = NULL;
    gough_end ended;
    swing w = {0, 0};
    double D, expected;

    set_gains(s.model, 30, 0);
    ck_assert(gough_damping_for_ratio(s.model, ratio, &D, &error) == GOUGH_OK);
    set_gains(s.model, 30, D);
    ck_assert(gough_stability_at_rest(s.model, NULL, &rest, &error) == GOUGH_OK);
    for (int k = 0; k < GOUGH_LINEAR; k++) {
        const gough_eigenvalue *e = &rest.eigenvalue[k];
        const double own = -e->value[0] / hypot(e->value[0], e->value[1]);
        if (own < ratio * (1 + 1e-6) && e->value[1] > 0 && fabs(e->mode.shape[0][0]) > 0.1)
            slow = e;
    }
    ck_assert(slow != NULL);
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        const double *shape = slow->mode.shape[c];
        const double rate = slow->value[0] * shape[0] - slow->value[1] * shape[1];
        initial->component[c] = size * shape[0];
        initial->given[c] = true;
        if (c < 3)
            initial->velocity[c] = size * rate;
        else
            initial->angular_velocity[c - 3] = size * rate;
    }
    initial->velocity_given = initial->angular_velocity_given = true;
    s.simulation.duration = s.simulation.output_step = 2 * pi / slow->value[1];
    s.simulation.tolerance = 1e-13;
    ck_assert(gough_simulate(s.model, &s.simulation, watch, &w, &ended, &error) == GOUGH_OK);
    expected = exp(-2 * pi * ratio / sqrt(1 - ratio * ratio));
    ck_assert_msg(fabs(w.last / w.first - expected) <= 1e-4 * expected, "%.9g, not %.9g",
                  w.last / w.first, expected);
    request_drop(&s);
}
END_TEST

/* ---- laws -------------------------------------------------------------------------------------------------------- */

/* (tune-3): without feed-forward a leg is shorter by M g l/(6 h G), the platform lower by l/h of that. Well damped, nothing
 * overshoots. */
START_TEST(stiffness_without_feedforward_is_that_of_the_sag) {
    const double l2 = 1.49;
    request s = begin(2);

    s.options.damping_ratio = 0.9;
    for (double asked = 1e-3; asked > 5e-6; asked /= 10) {
        s.options.deviation = asked;
        request_find(&s, false);
        const double law = l2 / (6 * asked);
        ck_assert_msg(fabs(s.tuning.stiffness - law) <= (3e-4 + 4 * asked) * law, "%.9g, not %.9g",
                      s.tuning.stiffness, law);
        check_choice(&s, false);
        ck_assert(s.tuning.binding == GOUGH_TUNING_POSITION);
        ck_assert_str_eq(s.tuning.mode.name, "heave");
        ck_assert(s.tuning.mode_share > 0.999);
        ck_assert(!s.tuning.periodic && s.tuning.unchecked[0] != '\0');
        ck_assert(fabs(s.tuning.damping_ratio - 0.9) <= 1e-7);
    }
    request_drop(&s);
}
END_TEST

/* (tune-3) with a load that the controller does not know in the place of the weight: a force V downwards at the centre of mass
 * sinks the top by V l²/(6 h² G), with what the weight takes off the stiffness of the legs. Along a program growth is that of the
 * loop's own motion. */
START_TEST(stiffness_for_unknown_loads_is_that_of_the_sag) {
    const double l2 = 1.49, V = 0.05, asked = 1e-4;
    gough_external down = {.at_given = false};
    request s = begin(6);

    set_formula(&down.force[2], "-0.05");
    ck_assert(gough_machine_set_external(&s.model->machine, &down, 1, NULL) == GOUGH_OK);
    s.model->control.ignores_external = true;
    s.options.damping_ratio = 0.9;
    s.options.deviation = asked;
    request_find(&s, true);
    const double law = V * l2 / (6 * asked) + (1 + V) * 0.49 / 6;
    ck_assert_msg(fabs(s.tuning.stiffness - law) <= 1e-3 * law, "%.9g, not %.9g",
                  s.tuning.stiffness, law);
    check_choice(&s, true);

    set_formula(&s.model->motion.formula[GOUGH_HEAVE], "0.02*sin(t)*(1 - exp(-t/2))^2");
    request_find(&s, true);
    check_choice(&s, true);
    ck_assert(s.tuning.periodic && s.tuning.found);
    ck_assert(fabs(s.tuning.slope + 1) <= 0.03);
    request_drop(&s);
}
END_TEST

/* (tune-2): with it a slow disturbance ε of each leg leaves ε l/(h G). */
START_TEST(stiffness_against_a_slow_disturbance_is_the_quasistatic_one) {
    const double l = sqrt(1.49), asked = 1e-5;
    request s = begin(8);
    double law;

    for (int v = 0; v < GOUGH_LEGS; v++)
        set_formula(&s.model->disturbance.leg_force[v], "0.001*ramp(t, 6)");
    s.options.damping_ratio = 0.5;
    s.options.deviation = asked;
    request_find(&s, true);
    /* the weight on its legs takes M g d²/(6 h³) off their stiffness, (stab-8) */
    law = 0.001 * l / asked + 0.49 / 6;
    ck_assert_msg(fabs(s.tuning.stiffness - law) <= 1e-3 * law, "%.9g, not %.9g",
                  s.tuning.stiffness, law);
    ck_assert_msg(fabs(s.tuning.slope + 1) <= 0.01, "slope %.5f", s.tuning.slope);
    check_choice(&s, true);
    request_drop(&s);
}
END_TEST

START_TEST(deviation_without_feedforward_falls_as_the_inverse_of_the_stiffness) {
    request s = begin(20);

    set_formula(&s.model->motion.formula[GOUGH_HEAVE], "0.2*sin(t)*(1 - exp(-t/2))^2");
    s.options.deviation = 1e-2;
    s.options.least = 10;
    s.options.greatest = 400;
    request_find(&s, false);
    check_choice(&s, false);
    ck_assert(s.tuning.periodic);
    ck_assert_msg(fabs(s.tuning.slope + 1) <= 0.03, "slope %.5f", s.tuning.slope);
    ck_assert(s.tuning.fails < s.tuning.stiffness && s.tuning.fails > 0.9997 * s.tuning.stiffness);
    request_drop(&s);
}
END_TEST

/* Between two points the curve is nearly a power of G: few runs beyond those of the curve bracket the answer, mostly two around
 * each guess, the rounded one, and the one with small steps. */
START_TEST(few_runs_bracket_the_stiffness) {
    request s = begin(20);

    set_formula(&s.model->motion.formula[GOUGH_HEAVE], "0.2*sin(t)*(1 - exp(-t/2))^2");
    for (int i = 0; i < 5; i++) {
        s.options.deviation = 1e-2 * pow(0.7, i);
        s.options.least = 10;
        s.options.greatest = 400;
        request_find(&s, false);
        ck_assert_msg(s.tuning.runs <= s.tuning.points + 12, "%zu runs, %zu points", s.tuning.runs,
                      s.tuning.points);
        ck_assert(between_rows(&s, s.tuning.fails) > s.options.deviation * (1 - 1e-5));
        ck_assert(between_rows(&s, s.tuning.stiffness) <= s.options.deviation * (1 + 1e-5));
        ck_assert(s.tuning.fails > 0.9997 * s.tuning.stiffness);
    }
    request_drop(&s);
}
END_TEST

/* the threshold of sway with tilt at home is 0.894; under way 0.898877 is the edge, and the margin goes on top */
START_TEST(stiffness_keeps_its_margin_from_the_threshold) {
    request s = begin(3);

    s.options.deviation = 1;
    s.options.margin = 0.05;
    s.options.greatest = 20;
    request_find(&s, true);
    ck_assert_msg(s.tuning.found, "%s", s.tuning.reason);
    ck_assert(s.tuning.binding == GOUGH_TUNING_THRESHOLD);
    ck_assert(fabs(s.tuning.stiffness * 0.95 / s.tuning.threshold - 1) <= 2e-4);
    ck_assert(fabs(s.tuning.threshold - 0.894107) <= 1e-6);
    ck_assert_str_eq(s.tuning.mode.name, "sway–tilt");
    request_drop(&s);
}
END_TEST

/* some thirty thousand swings in a period: its multipliers would take longer than anyone waits */
START_TEST(a_period_too_long_to_follow_is_said) {
    request s = begin(5);

    set_formula(&s.model->motion.formula[GOUGH_HEAVE], "0.1*sin(t/10000)");
    s.options.deviation = 0.01;
    request_find(&s, true);
    ck_assert_msg(s.tuning.found, "%s", s.tuning.reason);
    ck_assert(!s.tuning.periodic);
    ck_assert_str_eq(s.tuning.unchecked,
                     "the platform oscillates too often in one period of the program");
    ck_assert(s.tuning.stiffness >= s.tuning.threshold && s.tuning.stiffness < 1e3);
    request_drop(&s);
}
END_TEST

START_TEST(stiffness_is_lifted_over_a_tongue) {
    request s = begin(10);

    set_paper(&s);
    s.options.deviation = 1e-3;
    s.options.margin = 0.05;
    s.options.least = 1.7;
    s.options.greatest = 2.3;
    request_find(&s, true);
    ck_assert_msg(s.tuning.found, "%s", s.tuning.reason);
    ck_assert(s.tuning.binding == GOUGH_TUNING_TONGUE);
    /* the edge that gough stability finds: 1.93769 */
    ck_assert_msg(fabs(s.tuning.stiffness * 0.95 / 1.93769 - 1) <= 2e-4, "%.9g",
                  s.tuning.stiffness);
    request_drop(&s);
}
END_TEST

/* ---- none -------------------------------------------------------------------------------------------------------- */

static void finds_none(request *s, bool feedforward, const char *why) {
    request_find(s, feedforward);
    ck_assert_msg(!s->tuning.found, "found %.9g", s->tuning.stiffness);
    ck_assert_msg(strstr(s->tuning.reason, why) != NULL, "says: %s", s->tuning.reason);
}

START_TEST(no_stiffness_undoes_an_initial_offset) {
    request s = begin(4);

    s.model->initial.component[GOUGH_HEAVE] = 2e-3;
    s.model->initial.given[GOUGH_HEAVE] = true;
    s.options.deviation = 1e-3;
    s.options.greatest = 50;
    setlocale(LC_ALL, "de_DE.UTF-8"); /* where it is installed: a point all the same */
    finds_none(&s, true, "starts 0.002 off the program");
    setlocale(LC_ALL, "C");
    request_drop(&s);
}
END_TEST

START_TEST(a_limit_of_the_legs_may_forbid_every_stiffness) {
    request s = begin(3);

    /* the load at home needs 0.203 of each leg, its fall into undamped springs about twice that */
    s.model->machine.platform.force_max = 0.3;
    s.options.deviation = 1e-2;
    s.options.greatest = 300;
    finds_none(&s, false, "a leg's force exceeds its limit");
    ck_assert(s.tuning.exceptions > 0);
    ck_assert(s.tuning.exception[s.tuning.exceptions - 1].kind == GOUGH_TUNING_ENDED);
    ck_assert(s.tuning.exception[s.tuning.exceptions - 1].cause == GOUGH_END_LEG_FORCE);

    /* damped, it does not overshoot */
    s.options.damping_ratio = 0.9;
    request_find(&s, false);
    check_choice(&s, false);
    ck_assert(s.tuning.force <= 0.3 && fabs(s.tuning.force_share - s.tuning.force / 0.3) <= 1e-12);
    request_drop(&s);
}
END_TEST

START_TEST(too_narrow_a_search_says_where_to_go) {
    request s = begin(3);

    for (int v = 0; v < GOUGH_LEGS; v++)
        set_formula(&s.model->disturbance.leg_force[v], "0.001*ramp(t, 2)");
    s.options.deviation = 1e-6;
    s.options.damping_ratio = 0.5;
    s.options.greatest = 100;
    finds_none(&s, true, "so that about G = 1.2e+03 would be needed");
    request_drop(&s);
}
END_TEST

static void refuses(request *s, const char *why) {
    gough_error error = {0};

    ck_assert(request_ask(s, true, &error) == GOUGH_ERROR_INPUT);
    ck_assert_msg(strstr(error.message, why) != NULL, "says: %s", error.message);
}

START_TEST(refuses_what_cannot_be) {
    request s = begin(3);

    refuses(&s, "the deviation allowed must be");
    s.options.deviation = 1e-3;
    s.options.greatest = 0;
    refuses(&s, "the machine is unstable at home without feedback: sway–tilt grows unless G "
                "exceeds 0.894107");
    s.options.greatest = 0.8;
    refuses(&s, "the search ends at 0.8");
    s.options = gough_tuning_options_default();
    s.options.deviation = 1e-3;
    s.options.damping_ratio = 1;
    refuses(&s, "the damping ratio must be at least 0 and less than 1");
    s.options.damping_ratio = NAN;
    s.options.margin = 0.7;
    refuses(&s, "the margin must be from 0 to 0.5");
    s.options.margin = NAN;
    refuses(&s, "the margin must be from 0 to 0.5");
    s.options.margin = 0.05;
    set_formula(&s.model->motion.formula[GOUGH_HEAVE], "0.1*sin(t)");
    s.model->motion.period = 5;
    refuses(&s, "period");
    request_drop(&s);
}
END_TEST

int main(void) {
    return SUITE_RUN(
        "tune", 280, damping_gives_the_ratio_asked_for, damping_of_heave_is_the_closed_form,
        a_free_run_decays_by_the_ratio, stiffness_without_feedforward_is_that_of_the_sag,
        stiffness_for_unknown_loads_is_that_of_the_sag,
        stiffness_against_a_slow_disturbance_is_the_quasistatic_one,
        deviation_without_feedforward_falls_as_the_inverse_of_the_stiffness,
        few_runs_bracket_the_stiffness, stiffness_keeps_its_margin_from_the_threshold,
        a_period_too_long_to_follow_is_said, stiffness_is_lifted_over_a_tongue,
        no_stiffness_undoes_an_initial_offset, a_limit_of_the_legs_may_forbid_every_stiffness,
        too_narrow_a_search_says_where_to_go, refuses_what_cannot_be);
}
