/* Periods of programs: found from formulas, given, scaled; and the sentences about programs without a period. */
#include <stdio.h>
#include <stdlib.h>

#include "gough/floquet.h"
#include "support/machines.h"
#include "support/suite.h"

/* a motion in heave and yaw, faster by `frequency`, with a period given or 0 */
static gough_motion *motion_of(const char *heave, const char *yaw, double frequency, double given) {
    gough_motion *motion = calloc(1, sizeof *motion);

    ck_assert(motion != NULL);
    set_formula(&motion->formula[GOUGH_HEAVE], heave);
    set_formula(&motion->formula[GOUGH_YAW], yaw);
    motion->period = given;
    motion->scaled = true;
    motion->amplitude = 0.5;
    motion->frequency = frequency;
    return motion;
}

/* the program and both derivatives at t and u, the largest difference over the largest value */
static double miss(const gough_motion *motion, double t, double u) {
    double a[GOUGH_COMPONENTS][3], b[GOUGH_COMPONENTS][3], most = 1, worst = 0;

    gough_motion_evaluate(motion, t, a);
    gough_motion_evaluate(motion, u, b);
    for (int c = 0; c < GOUGH_COMPONENTS; c++) {
        for (int o = 0; o < 3; o++) {
            most = fmax(most, fabs(a[c][o]));
            worst = fmax(worst, fabs(a[c][o] - b[c][o]));
        }
    }
    return worst / most;
}

typedef struct {
    const char *heave, *yaw;
    double period;          /* 0: comes to rest */
    double earliest, start; /* within which it begins, at frequency 1 */
} known;

static const known table[] = {
    {"0.2*sin(t)", "0", 2 * pi, 0, 0},
    {"0.2*sin(t)*(1 - exp(-t/2))^2", "0", 2 * pi, 40, 63},
    {"0.2*sin(t)", "exp(-t)", 2 * pi, 20, 40},
    {"sin(t)^2", "0", pi, 0, 0},
    {"sin(t)*cos(t)", "sin(4*t)", pi, 0, 0},
    {"cos(21*t)*cos(19*t)", "0", pi, 0, 0},
    {"tan(0.5*t)/(5 + tan(0.5*t)^2)", "0", 2 * pi, 0, 0},
    {"0.1*sin(2*pi*0.7*t)", "0.1*sin(2*pi*0.8*t + 1)", 10, 0, 0},
    {"sin(0.1*t) + sin(0.3*t)", "cos(t/10)", 20 * pi, 0, 0},
    {"sin(t/3) + sin(t/7)", "0", 42 * pi, 0, 0},
    {"sin(t + 0.3*sin(2*t))", "0", 2 * pi, 0, 0},
    {"sin(2*(t - 1) - 3*(4 - t)/5)", "0", 2 * pi / 2.6, 0, 0},
    {"exp(sin(t))*sqrt(2 + cos(3*t))", "atan2(sin(t), 3)", 2 * pi, 0, 0},
    {"log(2 + sin(t)) + tanh(cos(t)) + asin(0.5*sin(t)) + acos(0.5*cos(t))", "0", 2 * pi, 0, 0},
    {"ramp(t, 5)*sin(t)", "0", 2 * pi, 5, 6.3},
    {"ramp(t - 100, 5)*sin(t)", "0", 2 * pi, 105, 107},
    {"sin(t)*(1 - exp(-t/1000))", "0", 2 * pi, 2e4, 3e4},
    {"sin(t)*tanh(t - 50)", "0", 2 * pi, 60, 75},
    {"ramp(sin(t) + 0.5, 1)", "0", 2 * pi, 0, 0},
    {"sin(1000*t)*ramp(t, 5)", "0", 2 * pi / 1000, 5, 5.01},
    {"sin(sin(t) + 2*cos(5*t))", "0", 2 * pi, 0, 0},
    {"0.1", "0", 0, 0, 0},
    {"0", "0", 0, 0, 0},
    {"0.1*ramp(t, 5)", "0", 0, 5, 5},
    {"0.1*(ramp(t - 1, 5) - ramp(t - 300, 5))", "0", 0, 305, 305},
    {"0.2*exp(-t)*sin(3*t)", "0.1*(1 - exp(-t))", 0, 20, 40},
    {"t*exp(-t)", "tanh(t)", 0, 20, 50},
};

static void check_known(const known *k, double frequency) {
    gough_motion *motion = motion_of(k->heave, k->yaw, frequency, 0);
    const double right = k->period / frequency;
    gough_error error = {0};
    gough_period found;

    ck_assert_msg(gough_motion_period(motion, &found, &error) == GOUGH_OK, "%s; %s: %s", k->heave,
                  k->yaw, error.message);
    ck_assert_msg(found.resting == !(right > 0), "%s; %s", k->heave, k->yaw);
    ck_assert_msg(fabs(found.period - right) <= 4e-16 * right, "%s: %.17g, not %.17g", k->heave,
                  found.period, right);
    if (frequency > 0.99 && frequency < 1.01)
        ck_assert_msg(k->earliest <= found.start && found.start <= k->start + 1e-12,
                      "%s begins at %g", k->heave, found.start);

    /* moments that the search has not seen; as given, the same is accepted */
    for (int i = 0; i < 100; i++) {
        const double t = found.start + (right > 0 ? right : 1) * i / 99;
        const double d = miss(motion, t, t + (right > 0 ? right : 1e3 * i));
        /* of the fastest sine's argument, which enters the second derivative times its rate squared */
        const double fastest = (strstr(k->heave, "1000*t") ? 1000 : 21) * frequency;
        const double rounding = 4e-16 * t * fastest * fastest;
        ck_assert_msg(d <= 4e-12 + rounding, "%s misses by %g at %g", k->heave, d, t);
    }
    if (right > 0) {
        gough_period again;
        motion->period = found.period;
        ck_assert_msg(gough_motion_period(motion, &again, &error) == GOUGH_OK, "%s", error.message);
        ck_assert(fabs(again.period - found.period) <= 0);
    }
    free(motion);
}

START_TEST(finds_periods_of_formulas) {
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++) check_known(&table[i], 1);
}
END_TEST

START_TEST(finds_periods_of_faster_and_slower_motions) {
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++) {
        check_known(&table[i], 2.5);
        check_known(&table[i], 0.3);
    }
}
END_TEST

/* a multiple of the least period is a period */
START_TEST(takes_what_is_given) {
    gough_motion *motion = motion_of("0.1*sin(t)", "0", 2, 4 * pi);
    gough_error error = {0};
    gough_period found;

    ck_assert_msg(gough_motion_period(motion, &found, &error) == GOUGH_OK, "%s", error.message);
    ck_assert(fabs(found.period - 4 * pi) <= 0 && !found.resting);

    /* nothing in this one is a sine of a multiple of t, so that its period must be given */
    set_formula(&motion->formula[GOUGH_HEAVE], "sin(2*atan2(sin(3*t/2)*1, cos(3*t/2)) + 0*t^2)");
    motion->period = 2 * pi / 6;
    ck_assert_msg(gough_motion_period(motion, &found, &error) == GOUGH_OK, "%s", error.message);
    free(motion);
}
END_TEST

typedef struct {
    const char *heave;
    double given;
    const char *says[3];
} refusal;

static const refusal refused[] = {
    {"t", 0, {"motion.heave", "neither comes to rest nor repeats", "motion.period"}},
    {"sin(t) + t", 0, {"motion.heave", "common period 6.2831853", "changes by"}},
    {"sin(t) + 1e-9*t", 0, {"motion.heave", "does not repeat: its sines", "trend"}},
    {"sin(t) + 1/(1 + t)", 0, {"motion.heave", "die out too slowly", ""}},
    {"sin(t) + sin(sqrt(2)*t)", 0, {"1.41421356 and 1", "simple ratio", "motion.period"}},
    {"sin(t) + sin(1.0001*t)", 0, {"1.0001", "simple ratio", ""}},
    {"sin(t^2)", 0, {"motion.heave", "neither", ""}},
    {"sin(t)*ramp(t, 5)", 6.28, {"motion.period = 6.28 ", "differs by 0.0", "is 6.28318530717958"}},
    {"sin(t)", 6.2831853, {"motion.period = 6.2831853 ", "e-09", "omit motion.period"}},
    {"sin(t)", pi, {"differs by", "6.28318530717958", ""}},
    {"t", 5, {"differs by 2.5", "no other period was found", ""}},
    {"sin(t) + sin(sqrt(2)*t)", 6.283185307179586, {"differs by", "no other period was found", ""}},
    {"sin(t)", 1e300, {"digits left", "1e+300", ""}},
    {"sin(t)*ramp(t - 1e9, 5)", 0, {"digits left", "6.28318531", ""}},
    {"sin(1e200*t*1e200)", 0, {"", "", ""}},
    {"exp(t)", 0, {"motion.heave is not finite at t =", "", ""}},
    {"sqrt(t - 3)", 0, {"motion.heave is not finite at t =", "", ""}},
    {"1/0 + sin(t)", 3, {"motion.heave is not finite", "", ""}},
};

START_TEST(says_why_there_is_no_period) {
    for (size_t i = 0; i < sizeof refused / sizeof refused[0]; i++) {
        gough_motion *motion = motion_of(refused[i].heave, "0", 1, refused[i].given);
        gough_error error = {0};
        gough_period found;
        ck_assert_msg(gough_motion_period(motion, &found, &error) == GOUGH_ERROR_INPUT, "%s passes",
                      refused[i].heave);
        for (int k = 0; k < 3; k++)
            ck_assert_msg(strstr(error.message, refused[i].says[k]) != NULL,
                          "%s: '%s' is not in: %s", refused[i].heave, refused[i].says[k],
                          error.message);
        free(motion);
    }
}
END_TEST

/* angles in degrees */
START_TEST(misses_of_angles_are_told_in_degrees) {
    gough_motion *motion = motion_of("0", "10*sin(t)", 1, pi);
    gough_error error = {0};
    gough_period found;

    motion->angle_unit = pi / 180;
    motion->amplitude = 1;
    ck_assert(gough_motion_period(motion, &found, &error) == GOUGH_ERROR_INPUT);
    ck_assert_msg(strstr(error.message, "motion.yaw") && strstr(error.message, "(degrees)"), "%s",
                  error.message);
    ck_assert_msg(strstr(error.message, "by 20") || strstr(error.message, "by 19.9"), "%s",
                  error.message);
    free(motion);
}
END_TEST

START_TEST(moves_end_at_rest) {
    const gough_move move[] = {
        {.start = 1, .duration = 2, .target = {0.1}, .given = {true}},
        {.start = 4, .duration = 3, .target = {0, 0, 0.2}, .given = {false, false, true}}};
    gough_motion *motion = motion_of("0", "0", 2, 0);
    gough_error error = {0};
    gough_period found;

    motion->kind = GOUGH_MOTION_MOVES;
    motion->move = move;
    motion->moves = 2;
    ck_assert(gough_motion_period(motion, &found, &error) == GOUGH_OK);
    ck_assert(found.resting && fabs(found.start - 3.5) <= 0 && fabs(found.period) <= 0);
    motion->scaled = false;
    ck_assert(gough_motion_period(motion, &found, &error) == GOUGH_OK);
    ck_assert(found.resting && fabs(found.start - 7) <= 0);
    free(motion);
}
END_TEST

/* two and a half periods of a sine of period 4, rows 0.05 apart */
enum { ROWS = 201 };
typedef struct {
    double time[ROWS], value[ROWS][GOUGH_COMPONENTS], curvature[ROWS][GOUGH_COMPONENTS];
    double scratch[8 * ROWS];
} record;

static gough_motion *recorded(record *r, double growth) {
    gough_motion *motion = motion_of("0", "0", 1, 0);
    gough_error error = {0};

    memset(r, 0, sizeof *r);
    for (int i = 0; i < ROWS; i++) {
        r->time[i] = 0.05 * i;
        r->value[i][GOUGH_HEAVE] = 0.1 * sin(pi / 2 * r->time[i]) + growth * r->time[i];
    }
    motion->kind = GOUGH_MOTION_SAMPLES;
    motion->scaled = false;
    motion->samples = (gough_samples){
        .count = ROWS, .time = r->time, .value = &r->value[0][0], .curvature = &r->curvature[0][0]};
    ck_assert(gough_samples_scratch(ROWS) <= sizeof r->scratch / sizeof r->scratch[0]);
    ck_assert(gough_samples_prepare(&motion->samples, r->scratch, &error) == GOUGH_OK);
    return motion;
}

START_TEST(records_repeat_with_the_period_given) {
    record *r = malloc(sizeof *r);
    gough_motion *motion = recorded(r, 0);
    gough_error error = {0};
    gough_period found;

    ck_assert(gough_motion_period(motion, &found, &error) == GOUGH_ERROR_INPUT);
    ck_assert_msg(strstr(error.message, "give motion.period"), "%s", error.message);
    motion->period = 4;
    ck_assert_msg(gough_motion_period(motion, &found, &error) == GOUGH_OK, "%s", error.message);
    ck_assert(fabs(found.start - 6) <= 1e-12 && fabs(found.period - 4) <= 0 && !found.resting);
    motion->period = 2;
    motion->scaled = true;
    motion->frequency = 2;
    ck_assert_msg(gough_motion_period(motion, &found, &error) == GOUGH_OK, "%s", error.message);
    ck_assert(fabs(found.start - 3) <= 1e-12);
    motion->period = 3;
    ck_assert(gough_motion_period(motion, &found, &error) == GOUGH_ERROR_INPUT);
    ck_assert_msg(strstr(error.message, "of heave differs by"), "%s", error.message);
    motion->period = 6;
    ck_assert(gough_motion_period(motion, &found, &error) == GOUGH_ERROR_INPUT);
    ck_assert_msg(strstr(error.message, "longer than the record"), "%s", error.message);
    free(motion);

    motion = recorded(r, 1e-3);
    motion->period = 4;
    ck_assert(gough_motion_period(motion, &found, &error) == GOUGH_ERROR_INPUT);
    ck_assert_msg(strstr(error.message, "heave differs by 0.004"), "%s", error.message);
    free(motion);
    free(r);
}
END_TEST

/* where the period begins, pitch is exactly 90° and its rate is not known; the angles about turned axes close */
START_TEST(records_about_turned_axes_repeat_with_their_rotations) {
    static const double cyclic[4] = {1, 1, 1, 1};
    record *r = malloc(sizeof *r);
    gough_motion *motion = recorded(r, 0);
    gough_error error = {0};
    gough_period found;

    for (int i = 0; i < ROWS; i++)
        r->value[i][GOUGH_ROLL] = pi / 2 + 0.3 * sin(pi / 2 * r->time[i]);
    memcpy(motion->samples.axes, cyclic, sizeof cyclic);
    ck_assert(gough_samples_prepare(&motion->samples, r->scratch, &error) == GOUGH_OK);
    motion->period = 4;
    ck_assert_msg(gough_motion_period(motion, &found, &error) == GOUGH_OK, "%s", error.message);
    ck_assert(fabs(found.start - 6) <= 1e-12 && fabs(found.period - 4) <= 0 && !found.resting);
    for (int i = 0; i < ROWS; i++) r->value[i][GOUGH_HEAVE] = 0;
    ck_assert(gough_samples_prepare(&motion->samples, r->scratch, &error) == GOUGH_OK);
    motion->period = 3;
    ck_assert(gough_motion_period(motion, &found, &error) == GOUGH_ERROR_INPUT);
    ck_assert_msg(strstr(error.message, "of roll about turned axes differs by"), "%s",
                  error.message);
    free(motion);
    free(r);
}
END_TEST

START_TEST(a_record_of_one_pose_rests) {
    record *r = malloc(sizeof *r);
    gough_motion *motion = recorded(r, 0);
    gough_error error = {0};
    gough_period found;

    for (int i = 0; i < ROWS; i++) r->value[i][GOUGH_HEAVE] = 0.1;
    ck_assert(gough_motion_period(motion, &found, &error) == GOUGH_OK);
    ck_assert(found.resting && fabs(found.start) <= 0);
    free(motion);
    free(r);
}
END_TEST

int main(void) {
    return SUITE_RUN(
        "period", 60, finds_periods_of_formulas, finds_periods_of_faster_and_slower_motions,
        takes_what_is_given, says_why_there_is_no_period, misses_of_angles_are_told_in_degrees,
        moves_end_at_rest, records_repeat_with_the_period_given,
        records_about_turned_axes_repeat_with_their_rotations, a_record_of_one_pose_rests);
}
