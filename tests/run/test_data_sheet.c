/* Limits as data sheets give them: ends and excesses where closed forms put them, alike in forces, in runs with adaptive and fixed
 * steps, and in lanes; six equal limits are one. */
#include <stdio.h>

#include "gough/batch.h"
#include "gough/dynamics.h"
#include "support/machines.h"
#include "support/suite.h"

/* heave, yaw and pitch as the tests use them: A sin t from rest would need a ramp, and limits are met later than t = 0 */
static const double amplitude = 0.2, turning = 0.3;

typedef struct {
    gough_crossing list[64];
    int count;
} crossings;

static void note(void *context, const gough_crossing *crossing) {
    crossings *c = context;

    ck_assert_int_lt(c->count, 64);
    c->list[c->count++] = *crossing;
}

/* the paper's symmetric machine on a program, held by strong feedback, so that it moves as the program does */
static gough_model *moving(int component, const char *formula) {
    gough_model *model = calloc(1, sizeof *model);

    paper_machine(&model->machine);
    model->control.feedforward = true;
    set_gains(model, 50, 5);
    set_formula(&model->motion.formula[component], formula);
    return model;
}

static gough_simulation tight(double duration) {
    gough_simulation s = gough_simulation_default();

    s.duration = duration;
    s.tolerance = 1e-13;
    return s;
}

/* the same steps in quadruple precision end for the same reason at the same time, but for what rounding makes of the run */
static void expect_quad_alike(const gough_model *model, const gough_simulation *steps,
                              const gough_end *wanted) {
    gough_simulation s = *steps;
    gough_end end;

    s.precision = GOUGH_QUADRUPLE;
    ck_assert_int_eq(gough_simulate(model, &s, NULL, NULL, &end, NULL), GOUGH_ERROR_NUMERICAL);
    ck_assert_int_eq(end.cause, wanted->cause);
    ck_assert_int_eq(end.leg, wanted->leg);
    ck_assert_int_eq(end.component, wanted->component);
    ck_assert_int_eq(end.least, wanted->least);
    ck_assert(end.limit == wanted->limit);
    ck_assert_msg(fabs(end.time - wanted->time) <= 1e-12, "%.17g, not %.17g", end.time,
                  wanted->time);
}

/* outcome of the same run in lanes with fixed steps, and alone with the same steps */
static void expect_lanes_alike(const gough_model *model, double duration) {
    gough_simulation s = gough_simulation_default();
    gough_batch_options o = gough_batch_options_default();
    gough_batch_run run[5];
    gough_outcome outcome[5];
    gough_error error = {.message = ""};
    gough_end end;

    s.duration = duration;
    s.output_step = 0.05;
    s.step = 0.01;
    s.method = GOUGH_RK4;
    o.threads = 1;
    for (int i = 0; i < 5; i++)
        run[i] = (gough_batch_run){
            &model->machine, &model->control, &model->disturbance, &model->initial, 0, 0};
    void *memory = aligned_alloc(64, (gough_batch_size(&o) + 63) / 64 * 64);
    ck_assert_int_eq(gough_batch(&model->motion, &s, run, 5, &o, outcome, memory, &error),
                     GOUGH_OK);
    ck_assert_int_eq(gough_simulate(model, &s, NULL, NULL, &end, NULL), GOUGH_ERROR_NUMERICAL);
    for (int i = 0; i < 5; i++) {
        ck_assert_int_eq(outcome[i].cause, end.cause);
        ck_assert_int_eq(outcome[i].leg, end.leg);
        ck_assert(outcome[i].time == end.time);
    }
    free(memory);
    expect_quad_alike(model, &s, &end);
}

/* The program exceeds one limit from `enter` on, first up to `leave`, and so does the motion; the sentence says which. */
static void expect(const gough_model *model, double enter, double leave, gough_cause cause,
                   int component, bool least, const char *sentence) {
    gough_simulation s = tight(leave + 0.1);
    gough_error error = {.message = ""};
    crossings found = {.count = 0};
    gough_end end;

    ck_assert_int_eq(gough_forces(model, &s, NULL, NULL, note, &found, &end, &error),
                     GOUGH_ERROR_NUMERICAL);
    ck_assert_int_eq(end.cause, cause);
    ck_assert_int_eq(end.component, component);
    ck_assert_int_eq(end.least, least);
    ck_assert_int_eq(end.leg > 0, component == 0);
    ck_assert_msg(fabs(end.time - enter) <= 1e-9, "%s: %.12g, not %.12g", sentence, end.time,
                  enter);
    ck_assert_msg(strstr(end.message, sentence) != NULL, "'%s' is not '%s'", end.message, sentence);
    ck_assert_int_gt(found.count, 0);
    for (int i = 0; i < found.count; i++) {
        ck_assert_int_eq(found.list[i].cause, cause);
        ck_assert(fabs(found.list[i].enter - enter) <= 1e-9);
        ck_assert_msg(fabs(found.list[i].leave - leave) <= 1e-9, "%s: left at %.12g, not %.12g",
                      sentence, found.list[i].leave, leave);
        ck_assert(found.list[i].limit == end.limit);
    }

    gough_end moved;
    ck_assert_int_eq(gough_simulate(model, &s, NULL, NULL, &moved, &error), GOUGH_ERROR_NUMERICAL);
    ck_assert_int_eq(moved.cause, cause);
    ck_assert_int_eq(moved.component, component);
    ck_assert(fabs(moved.time - enter) <= 1e-8);
    expect_lanes_alike(model, leave + 0.1);
}

/* z = A sin t from t = 0 on, ż = A cos t, z̈ = −A sin t */
START_TEST(heave_is_limited_where_its_sine_is) {
    gough_model *model = moving(GOUGH_HEAVE, "0.2*sin(t)");
    gough_platform_limits *l = &model->machine.platform.limits;

    l->pose[GOUGH_HEAVE][0] = -0.5, l->pose[GOUGH_HEAVE][1] = 0.1;
    expect(model, asin(0.5), pi - asin(0.5), GOUGH_END_PLATFORM_POSE, GOUGH_HEAVE + 1, false,
           "the platform exceeds its greatest heave 0.1 at t = ");
    l->pose[GOUGH_HEAVE][0] = -0.1, l->pose[GOUGH_HEAVE][1] = 0.5;
    expect(model, pi + asin(0.5), 2 * pi - asin(0.5), GOUGH_END_PLATFORM_POSE, GOUGH_HEAVE + 1,
           true, "the platform falls below its least heave -0.1 at t = ");
    memset(l, 0, sizeof *l);
    l->speed[GOUGH_HEAVE][0] = -0.15, l->speed[GOUGH_HEAVE][1] = 1;
    expect(model, acos(-0.75), 2 * pi - acos(-0.75), GOUGH_END_PLATFORM_SPEED, GOUGH_HEAVE + 1,
           true, "falls below its least velocity in heave -0.15");
    memset(l, 0, sizeof *l);
    l->acceleration[GOUGH_HEAVE][0] = -0.05, l->acceleration[GOUGH_HEAVE][1] = 7;
    expect(model, asin(0.25), pi - asin(0.25), GOUGH_END_PLATFORM_ACCELERATION, GOUGH_HEAVE + 1,
           true, "falls below its least acceleration in heave -0.05");
    free(model);
}
END_TEST

/* ψ = B sin t, ω = B cos t, α = −B sin t about z */
START_TEST(yaw_is_limited_where_its_sine_is) {
    gough_model *model = moving(GOUGH_YAW, "0.3*sin(t)");
    gough_platform_limits *l = &model->machine.platform.limits;

    l->pose[GOUGH_YAW][0] = -2.4, l->pose[GOUGH_YAW][1] = 0.2; /* wider than half a turn */
    expect(model, asin(2.0 / 3), pi - asin(2.0 / 3), GOUGH_END_PLATFORM_POSE, GOUGH_YAW + 1, false,
           "exceeds its greatest yaw 0.2");
    memset(l, 0, sizeof *l);
    l->speed[GOUGH_YAW][0] = -0.1, l->speed[GOUGH_YAW][1] = 0.4;
    expect(model, acos(-1.0 / 3), 2 * pi - acos(-1.0 / 3), GOUGH_END_PLATFORM_SPEED, GOUGH_YAW + 1,
           true, "least angular velocity about z -0.1");
    memset(l, 0, sizeof *l);
    l->acceleration[GOUGH_YAW][0] = -1, l->acceleration[GOUGH_YAW][1] = 0.1;
    expect(model, pi + asin(1.0 / 3), 2 * pi - asin(1.0 / 3), GOUGH_END_PLATFORM_ACCELERATION,
           GOUGH_YAW + 1, false, "greatest angular acceleration about z 0.1");
    free(model);
}
END_TEST

/* the first zero of a function of t after `from`, before `to`, where it has another sign */
static double zero_of(double (*f)(const gough_model *, double), const gough_model *model,
                      double from, double to) {
    const bool below = f(model, from) < 0;

    ck_assert(below != (f(model, to) < 0));
    for (int i = 0; i < 80; i++) {
        const double middle = (from + to) / 2;
        if ((f(model, middle) < 0) == below)
            from = middle;
        else
            to = middle;
    }
    return to;
}

/* A point at height L over the origin of a top that pitches by θ = B sin t about it: x = L sin θ,
 * ẍ = L (θ̈ cos θ − θ̇² sin θ), z̈ = −L (θ̈ sin θ + θ̇² cos θ), beyond 0.25 */
static const double lever = 1.5, sideways = 0.25;
static double sideways_left(const gough_model *model, double t) {
    const double angle = turning * sin(t), rate = turning * cos(t);
    (void)model;
    return sideways - lever * (-angle * cos(angle) - rate * rate * sin(angle));
}

START_TEST(a_point_of_the_top_is_limited_by_itself) {
    gough_model *model = moving(GOUGH_PITCH, "0.3*sin(t)");
    gough_platform_limits *l = &model->machine.platform.limits;
    const double enter = zero_of(sideways_left, model, pi, 1.5 * pi);

    l->about_given = true;
    l->about[2] = lever;
    l->pose[GOUGH_SURGE][0] = -1, l->pose[GOUGH_SURGE][1] = lever * sin(turning / 2);
    expect(model, asin(0.5), pi - asin(0.5), GOUGH_END_PLATFORM_POSE, GOUGH_SURGE + 1, false,
           "greatest surge");
    memset(l->pose, 0, sizeof l->pose);
    l->acceleration[GOUGH_SURGE][0] = -9, l->acceleration[GOUGH_SURGE][1] = sideways;
    expect(model, enter, zero_of(sideways_left, model, 1.5 * pi, 2 * pi),
           GOUGH_END_PLATFORM_ACCELERATION, GOUGH_SURGE + 1, false,
           "greatest acceleration in surge");
    /* without a point of its own it is that of the motion, whose surge is then 0 */
    l->about_given = false;
    l->about[2] = 0;
    model->motion.about[2] = lever;
    gough_simulation s = tight(6);
    gough_end end;
    ck_assert_int_eq(gough_forces(model, &s, NULL, NULL, NULL, NULL, &end, NULL), GOUGH_OK);
    free(model);
}
END_TEST

/* Along heave all legs are √(d² + z²) long: l̇ = z ż/l, l̈ = (ż² + z z̈ − l̇²)/l */
static const double quick = 0.1;
static double acceleration_left(const gough_model *model, double t) {
    const double l0 = model->machine.home_length[0], d2 = l0 * l0 - 1;
    const double z = 1 + amplitude * sin(t), dz = amplitude * cos(t), ddz = -amplitude * sin(t);
    const double length = sqrt(d2 + z * z), rate = z * dz / length;
    return quick - fabs((dz * dz + z * ddz - rate * rate) / length);
}

START_TEST(acceleration_of_a_leg_is_that_of_its_length) {
    gough_model *model = moving(GOUGH_HEAVE, "0.2*sin(t)");
    const double enter = zero_of(acceleration_left, model, 0, pi / 2);

    for (int v = 0; v < 6; v++) model->machine.platform.legs.acceleration[v] = quick;
    expect(model, enter, zero_of(acceleration_left, model, pi / 2, pi), GOUGH_END_LEG_ACCELERATION,
           0, false, "all six legs exceed their greatest acceleration 0.1");
    free(model);
}
END_TEST

/* the angle of leg 3 between its directions at home and now, by acos, at the base or in the axes of the top */
static const double swing = 0.08;
static double swing_of(const gough_model *model, double t, bool at_top) {
    const gough_state home = gough_state_home(&model->machine);
    gough_acceleration a;
    gough_state state;
    double now[3], then[3], dot = 0, length[2] = {0, 0};

    gough_program(&model->machine, &model->motion, t, &state, &a);
    for (int i = 0; i < 3; i++) {
        now[i] = state.position[i] - model->machine.platform.base[2][i];
        then[i] = home.position[i] - model->machine.platform.base[2][i];
        for (int k = 0; k < 3; k++) {
            now[i] += state.rotation[i][k] * model->machine.platform.top[2][k];
            then[i] += home.rotation[i][k] * model->machine.platform.top[2][k];
        }
    }
    for (int i = 0; i < 3; i++) {
        double seen = at_top ? 0 : now[i];
        for (int k = 0; at_top && k < 3; k++) seen += state.rotation[k][i] * now[k];
        dot += seen * then[i];
        length[0] += now[i] * now[i];
        length[1] += then[i] * then[i];
    }
    return acos(dot / sqrt(length[0] * length[1]));
}
static double base_left(const gough_model *model, double t) {
    return swing - swing_of(model, t, false);
}
static double top_left(const gough_model *model, double t) {
    return swing - swing_of(model, t, true);
}

START_TEST(swing_is_the_angle_of_directions) {
    gough_model *model = moving(GOUGH_YAW, "0.3*sin(t)");
    gough_leg_limits *l = &model->machine.platform.legs;

    l->base_swing[2] = swing;
    expect(model, zero_of(base_left, model, 0, pi / 2), zero_of(base_left, model, pi / 2, pi),
           GOUGH_END_BASE_SWING, 0, false, "leg 3 exceeds its greatest swing at the base 0.08");
    l->base_swing[2] = 0;
    l->top_swing[2] = swing;
    expect(model, zero_of(top_left, model, 0, pi / 2), zero_of(top_left, model, pi / 2, pi),
           GOUGH_END_TOP_SWING, 0, false, "leg 3 exceeds its greatest swing at the top 0.08");
    free(model);
}
END_TEST

/* F = M (z̈ + g) l/(6h) in each leg along heave */
static const double least_force = 0.19;
static double force_left(const gough_model *model, double t) {
    const double l0 = model->machine.home_length[0], d2 = l0 * l0 - 1;
    const double z = 1 + amplitude * sin(t);
    return (1 - amplitude * sin(t)) * sqrt(d2 + z * z) / (6 * z) - least_force;
}

START_TEST(least_and_greatest_force_are_apart) {
    gough_model *model = moving(GOUGH_HEAVE, "0.2*sin(t)");
    const double enter = zero_of(force_left, model, 0, pi / 2);

    ck_assert(fabs(model->machine.load.mass - 1) <= 0 &&
              fabs(model->machine.gravity_magnitude - 1) <= 0);
    for (int v = 0; v < 6; v++) {
        model->machine.platform.legs.force[v][0] = least_force;
        model->machine.platform.legs.force[v][1] = 9;
    }
    expect(model, enter, zero_of(force_left, model, pi / 2, pi), GOUGH_END_LEG_FORCE, 0, true,
           "all six legs fall below their least force 0.19");
    /* a machine whose legs only pull cannot carry its load from below: [-9, 0] is exceeded at once */
    for (int v = 0; v < 6; v++) {
        model->machine.platform.legs.force[v][0] = -9;
        model->machine.platform.legs.force[v][1] = 0;
    }
    gough_simulation s = tight(1);
    gough_end end;
    ck_assert_int_eq(gough_simulate(model, &s, NULL, NULL, &end, NULL), GOUGH_ERROR_NUMERICAL);
    ck_assert(end.time <= 0 && end.cause == GOUGH_END_LEG_FORCE && !end.least && end.limit == 0);
    /* hung up, all legs pull with about 0.2 */
    gough_machine *m = &model->machine;
    const gough_platform platform = m->platform;
    const gough_load load = m->load;
    const double up[3] = {0, 0, 1};
    ck_assert_int_eq(gough_machine_init(m, &platform, &load, up, NULL), GOUGH_OK);
    ck_assert_int_eq(gough_simulate(model, &s, NULL, NULL, &end, NULL), GOUGH_OK);
    for (int v = 0; v < 6; v++) m->platform.legs.force[v][0] = -0.1;
    ck_assert_int_eq(gough_simulate(model, &s, NULL, NULL, &end, NULL), GOUGH_ERROR_NUMERICAL);
    ck_assert(end.time <= 0 && end.cause == GOUGH_END_LEG_FORCE && end.least && end.limit == -0.1);
    free(model);
}
END_TEST

/* limits of single legs: the leg with the narrowest ends the run, and is named alone */
START_TEST(each_leg_has_its_own_limit) {
    gough_model *model = moving(GOUGH_HEAVE, "0.2*sin(t)");
    gough_leg_limits *l = &model->machine.platform.legs;
    const double l0 = model->machine.home_length[0], d2 = l0 * l0 - 1;

    for (int v = 0; v < 6; v++) l->stroke[v][0] = -1, l->stroke[v][1] = 0.5;
    l->stroke[4][1] = sqrt(1.1 * 1.1 + d2) - model->machine.home_length[4];
    expect(model, asin(0.5), pi - asin(0.5), GOUGH_END_LEG_LONG, 0, false,
           "leg 5 gets longer than its greatest length");

    /* all are too short at once, each by its own limit: the sentence names a limit and the legs that have it */
    gough_simulation s = tight(1);
    gough_end end;
    for (int v = 0; v < 6; v++) {
        l->stroke[v][0] = v < 2 ? 0.01 : 0.02 + 0.01 * v;
        l->stroke[v][1] = 0.5;
    }
    ck_assert_int_eq(gough_simulate(model, &s, NULL, NULL, &end, NULL), GOUGH_ERROR_NUMERICAL);
    ck_assert_int_eq(end.cause, GOUGH_END_LEG_SHORT);
    ck_assert_uint_eq(end.legs, 3);
    ck_assert(end.limit == model->machine.home_length[0] + 0.01);
    free(model);
}
END_TEST

/* six numbers in place of one: the same end, bit for bit, and the same sentence */
START_TEST(six_equal_limits_are_one) {
    gough_model *one = moving(GOUGH_HEAVE, "0.2*sin(t)"), *six = moving(GOUGH_HEAVE, "0.2*sin(t)");
    const gough_simulation s = tight(6);

    for (int kind = 0; kind < 4; kind++) {
        gough_platform *a = &one->machine.platform, *b = &six->machine.platform;
        gough_end first, second;
        a->length_min = kind == 0 ? 1.2 : 0;
        a->length_max = kind == 1 ? 1.3 : INFINITY;
        a->speed_max = kind == 2 ? 0.164 : INFINITY;
        a->force_max = kind == 3 ? 0.22 : INFINITY;
        for (int v = 0; v < 6; v++) {
            b->legs.length[v][0] = kind == 0 ? 1.2 : 0;
            b->legs.length[v][1] = kind == 0 ? 9 : kind == 1 ? 1.3 : 0;
            b->legs.speed[v] = kind == 2 ? 0.164 : 0;
            b->legs.max_force[v] = kind == 3 ? 0.22 : 0;
        }
        ck_assert_int_eq(gough_simulate(one, &s, NULL, NULL, &first, NULL), GOUGH_ERROR_NUMERICAL);
        ck_assert_int_eq(gough_simulate(six, &s, NULL, NULL, &second, NULL), GOUGH_ERROR_NUMERICAL);
        ck_assert_int_eq(first.cause, GOUGH_END_LEG_SHORT + kind);
        ck_assert_int_eq(second.cause, first.cause);
        ck_assert(second.time == first.time);
        ck_assert_str_eq(second.message, first.message);
    }
    free(one);
    free(six);
}
END_TEST

int main(void) {
    return SUITE_RUN("run/data_sheet", 60, heave_is_limited_where_its_sine_is,
                     yaw_is_limited_where_its_sine_is, a_point_of_the_top_is_limited_by_itself,
                     acceleration_of_a_leg_is_that_of_its_length, swing_is_the_angle_of_directions,
                     least_and_greatest_force_are_apart, each_leg_has_its_own_limit,
                     six_equal_limits_are_one);
}
