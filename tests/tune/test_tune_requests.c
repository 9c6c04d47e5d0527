/* Requests for a tuning: numbers out of range, and a search that its caller stops. */
#include <stdlib.h>

#include "support/machines.h"
#include "support/suite.h"
#include "tune/requests.h"

static gough_tuning_options usual(void) {
    gough_tuning_options o = gough_tuning_options_default();

    o.deviation = 1e-2;
    o.damping_ratio = 0.9;
    o.least = 5;
    o.greatest = 100;
    o.threads = 1;
    return o;
}

/* the load at home is let go into damped springs: few, short runs */
static request sagging(void) {
    request r = request_new(2);

    r.options = usual();
    return r;
}

/* ---- progress ---- */

typedef struct {
    const request *of;
    int calls, stop_at;
    double part;
} listener;

/* what is known meanwhile: G that is enough lies above G that is not */
static int listen(void *context, double part) {
    listener *l = context;
    const gough_tuning *t = &l->of->tuning;

    ck_assert(part >= 0 && part <= 1);
    ck_assert(!(t->stiffness > 0) || isnan(t->fails) || t->fails < t->stiffness);
    l->part = part;
    return ++l->calls == l->stop_at;
}

START_TEST(a_search_stops_at_whichever_call_asks_it_to) {
    request r = sagging();
    listener l = {.of = &r};
    gough_error error = {0};
    int all;

    r.options.progress = listen;
    r.options.context = &l;
    ck_assert_msg(request_ask(&r, false, &error) == GOUGH_OK, "%s", error.message);
    ck_assert(r.tuning.found);
    all = l.calls;
    ck_assert_int_gt(all, 3);
    for (int stop_at = 1; stop_at <= all; stop_at += 1 + all / 40) {
        l.calls = 0;
        l.stop_at = stop_at;
        ck_assert_int_eq(request_ask(&r, false, &error), GOUGH_ERROR_NUMERICAL);
        ck_assert_msg(strstr(error.message, "was stopped") != NULL, "%s", error.message);
        ck_assert_int_eq(l.calls, stop_at);
        ck_assert(!r.tuning.found);
    }
    request_drop(&r);
}
END_TEST

/* ---- numbers ---- */

static void refuses(request *r, const char *why) {
    gough_error error = {0};

    ck_assert_msg(request_ask(r, false, &error) == GOUGH_ERROR_INPUT, "accepted, for all that: %s",
                  why);
    ck_assert_msg(strstr(error.message, why) != NULL, "%s", error.message);
    r->options = usual();
}

START_TEST(numbers_out_of_range_are_refused_with_their_sentence) {
    static const double BAD[] = {NAN, -1};
    request r = sagging();

    for (int i = 0; i < 2; i++) {
        r.options.deviation = BAD[i];
        refuses(&r, "the deviation allowed must be a finite number > 0");
        r.options.angle_deviation = BAD[i];
        refuses(&r, i ? "the angle deviation allowed must be > 0, not -57.2957795°"
                      : "the angle deviation allowed must be > 0");
        r.options.margin = BAD[i];
        refuses(&r, "the margin must be from 0 to 0.5");
        r.options.least = BAD[i];
        refuses(&r, "needs two numbers, 0 <= a < b");
        r.options.greatest = BAD[i];
        refuses(&r, "needs two numbers, 0 <= a < b");
    }
    r.options.deviation = INFINITY;
    refuses(&r, "the deviation allowed must be a finite number > 0, not inf");
    r.options.damping_ratio = -0.1;
    refuses(&r, "the damping ratio must be at least 0 and less than 1, not -0.1");
    r.options.least = INFINITY;
    refuses(&r, "needs two numbers, 0 <= a < b, not inf and 100");
    r.options.least = r.options.greatest;
    refuses(&r, "takes two numbers, 0 < a < b; got 100 and 100");
    r.options.least = 1e-14;
    refuses(&r, "covers at most 15 decades; got 1e-14 to 100");
    request_drop(&r);
}
END_TEST

START_TEST(a_loop_damped_too_strongly_to_be_followed_is_refused) {
    request r = sagging();

    r.options.damping_ratio = NAN;
    set_gains(r.model, 0, 1e9);
    refuses(&r, "lower control.damping or simulation.duration");
    request_drop(&r);
}
END_TEST

START_TEST(words_outside_the_enumerations_are_unknown) {
    ck_assert_str_eq(gough_tuning_binding_name(GOUGH_TUNING_SEARCH), "search");
    ck_assert_str_eq(gough_tuning_binding_name((gough_tuning_binding)-1), "unknown");
    ck_assert_str_eq(gough_tuning_binding_name((gough_tuning_binding)6), "unknown");
    ck_assert_str_eq(gough_tuning_exception_name(GOUGH_TUNING_OFF_TREND), "off_trend");
    ck_assert_str_eq(gough_tuning_exception_name((gough_tuning_exception_kind)-1), "unknown");
    ck_assert_str_eq(gough_tuning_exception_name((gough_tuning_exception_kind)3), "unknown");
}
END_TEST

/* ---- reasons ---- */

START_TEST(the_reason_names_what_ends_every_run) {
    static const char *const WORDS[] = {
        "a leg becomes too short", "a leg becomes too long", "a leg moves too fast",
        "the platform collapses into a singular pose", "a formula or the motion is not finite"};
    for (int i = 0; i < 5; i++) {
        request r = sagging();
        gough_platform *limits = &r.model->machine.platform;
        const double home = r.model->machine.home_length[0];
        gough_error error = {0};

        if (i == 0) limits->length_min = 1.01 * home;
        if (i == 1) limits->length_max = 0.99 * home;
        if (i == 2) {
            limits->speed_max = 0.01;
            set_formula(&r.model->motion.formula[GOUGH_HEAVE], "0.1*sin(t)");
        }
        if (i == 3) set_formula(&r.model->motion.formula[GOUGH_YAW], "2*ramp(t - 0.5, 1)");
        if (i == 4) set_formula(&r.model->disturbance.force[0], "sqrt(1 - t)");
        ck_assert_msg(request_ask(&r, false, &error) == GOUGH_OK, "%d: %s", i, error.message);
        ck_assert(!r.tuning.found);
        ck_assert_msg(strstr(r.tuning.reason, WORDS[i]) != NULL, "%d: %s", i, r.tuning.reason);
        request_drop(&r);
    }
}
END_TEST

/* ---- damping for a ratio ---- */

START_TEST(damping_is_refused_where_nothing_can_be_damped) {
    request r = sagging();
    const double gravity[3] = {0, 0, 0};
    const gough_platform platform = r.model->machine.platform;
    const gough_load load = r.model->machine.load;
    gough_error error = {0};
    double damping;

    ck_assert_int_eq(gough_damping_for_ratio(r.model, NAN, &damping, &error), GOUGH_ERROR_INPUT);
    ck_assert_int_eq(gough_damping_for_ratio(r.model, 1, &damping, &error), GOUGH_ERROR_INPUT);
    /* neither feedback nor gravity: no mode oscillates */
    ck_assert_int_eq(gough_machine_init(&r.model->machine, &platform, &load, gravity, NULL),
                     GOUGH_OK);
    ck_assert_int_eq(gough_damping_for_ratio(r.model, 0.5, &damping, &error),
                     GOUGH_ERROR_NUMERICAL);
    ck_assert_msg(strstr(error.message, "use a greater stiffness") != NULL, "%s", error.message);
    r.model->motion.angle_unit = NAN;
    ck_assert_int_eq(gough_damping_for_ratio(r.model, 0.5, &damping, &error), GOUGH_ERROR_INPUT);
    ck_assert_str_eq(error.key, "motion");
    request_drop(&r);
}
END_TEST

int main(void) {
    return SUITE_RUN(
        "tune requests", 120, a_search_stops_at_whichever_call_asks_it_to,
        numbers_out_of_range_are_refused_with_their_sentence,
        a_loop_damped_too_strongly_to_be_followed_is_refused, the_reason_names_what_ends_every_run,
        words_outside_the_enumerations_are_unknown, damping_is_refused_where_nothing_can_be_damped);
}
