/* Runs of a machine whose legs have mass and friction against the same motion of thirteen rigid
 * bodies: along the program, and in a closed loop with disturbances.
 * Sanitized: campaign: independent/thirteen_bodies runs the same equations under sanitizers. */
#include <check.h>
#include <math.h>
#include <string.h>

#include "gough/simulate.h"
#include "independent/studies.h"
#include "independent/thirteen_bodies.h"

enum { ROTATION = 3, VELOCITY = 12, OMEGA = 15, STATES = 18 };

/* Rows every 0.05 come from steps of a 16th of that. Poses are found to differ by 4e-11, because of these steps. */
static const double STEP = 0.05 / 16, RUN = 1e-9;

static gough_model model; /* large */

static double worse(double worst, double difference) {
    const double size = fabs(difference);
    return size <= worst ? worst : size; /* not a number replaces anything */
}

/* What the program asks of the legs. */
typedef struct wanted {
    double force[6], length[6], rate[6];
} wanted;

/* The second formulation on its way, and how far the library is from it. */
typedef struct comparison {
    thirteen_bodies second, known; /* known: as the controller takes it to be */
    double state[STATES], time, pose, rate, force;
    wanted now;
    int rows;
} comparison;

static wanted wanted_at(const thirteen_bodies *m, double t) {
    gough_state state;
    gough_acceleration acceleration;
    bodies_instant now;
    wanted w;
    gough_program(&model.machine, &model.motion, t, &state, &acceleration);
    bodies_inverse(m, &state, &acceleration, NULL, &now);
    memcpy(w.force, now.drive, sizeof w.force);
    memcpy(w.length, now.length, sizeof w.length);
    memcpy(w.rate, now.rate, sizeof w.rate);
    return w;
}

static gough_state state_of(const double y[STATES]) {
    gough_state s;
    memcpy(s.position, y, sizeof s.position);
    memcpy(s.rotation, y + ROTATION, sizeof s.rotation);
    memcpy(s.velocity, y + VELOCITY, sizeof s.velocity);
    memcpy(s.angular_velocity, y + OMEGA, sizeof s.angular_velocity);
    return s;
}

/* (law-1) with disturbances: F^p + G (l^p − l) + D (l̇^p − l̇) are drive forces. */
static void instant_of(const thirteen_bodies *m, double t, const double y[STATES], const wanted *w,
                       bodies_instant *now) {
    const gough_state state = state_of(y);
    newton_real leg[6], unused, force[3], moment[3];
    double length[6], rate[6], drive[6];
    gough_wrench external;
    general_disturbance((newton_real)t, leg, &unused, force, moment);
    bodies_lengths(m, &state, length, rate);
    for (int k = 0; k < 6; k++)
        drive[k] = w->force[k] + model.control.stiffness[k] * (w->length[k] - length[k]) +
                   model.control.damping[k] * (w->rate[k] - rate[k]) + (double)leg[k];
    for (int i = 0; i < 3; i++) {
        external.force[i] = (double)force[i];
        external.moment[i] = (double)moment[i];
    }
    bodies_forward(m, &state, drive, &external, now);
}

static void slope(const thirteen_bodies *m, double t, const double y[STATES], const wanted *w,
                  double out[STATES]) {
    const double *omega = y + OMEGA, *R = y + ROTATION;
    bodies_instant now;
    instant_of(m, t, y, w, &now);
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        out[i] = y[VELOCITY + i];
        out[VELOCITY + i] = now.top.linear[i];
        out[OMEGA + i] = now.top.angular[i];
        /* each column turns with ω */
        for (int c = 0; c < 3; c++)
            out[ROTATION + 3 * i + c] = omega[j] * R[3 * k + c] - omega[k] * R[3 * j + c];
    }
}

/* The classical Runge–Kutta method; w is what the program wants at t, and at t + h on return. */
static void step(const comparison *c, double t, double h, wanted *w, double y[STATES]) {
    const wanted half = wanted_at(&c->known, t + h / 2), end = wanted_at(&c->known, t + h);
    const thirteen_bodies *m = &c->second;
    double k[4][STATES], at[STATES];
    slope(m, t, y, w, k[0]);
    for (int i = 0; i < STATES; i++) at[i] = y[i] + h / 2 * k[0][i];
    slope(m, t + h / 2, at, &half, k[1]);
    for (int i = 0; i < STATES; i++) at[i] = y[i] + h / 2 * k[1][i];
    slope(m, t + h / 2, at, &half, k[2]);
    for (int i = 0; i < STATES; i++) at[i] = y[i] + h * k[2][i];
    slope(m, t + h, at, &end, k[3]);
    for (int i = 0; i < STATES; i++)
        y[i] += h / 6 * (k[0][i] + 2 * k[1][i] + 2 * k[2][i] + k[3][i]);
    *w = end;
}

/* The general study with heavy legs of six kinds and with friction; smoothing of 2e-2 √(g R_b) keeps
 * the equations soft enough for such steps. */
static void start_run(comparison *c, bool ignores_legs, bool ignores_friction) {
    gough_error error = {.message = ""};
    gough_acceleration unused;
    gough_state state;
    general_study(&model, NULL, true, 50, 2);
    model.disturbance.vertical_force = gough_formula_constant(0);
    memset(c, 0, sizeof *c);
    gough_platform *p = &c->second.platform;
    *p = model.machine.platform;
    c->second.load = model.machine.load;
    memcpy(c->second.gravity, model.machine.gravity, sizeof c->second.gravity);
    for (int k = 0; k < 6; k++) {
        p->cylinder.mass[k] = 0.06 + 0.01 * k;
        p->cylinder.center[k] = 0.35 - 0.1 * k;
        p->cylinder.inertia[k] = 0.004 + 0.002 * k;
        p->piston.mass[k] = 0.05 - 0.005 * k;
        p->piston.center[k] = 0.45 - 0.05 * k;
        p->piston.inertia[k] = 0.001 * k;
        p->reflected_mass[k] = 0.1 + 0.05 * k;
        p->friction.viscous[k] = 0.02 * k;
        p->friction.coulomb[k] = 0.02 + 0.004 * k;
        p->friction.breakaway[k] = 0.05;
        p->friction.stribeck_speed[k] = 0.1;
        p->friction.smoothing_speed[k] = 0.02;
        p->friction.efficiency[k] = 0.7 + 0.05 * k;
    }
    ck_assert_msg(gough_machine_init(&model.machine, p, &c->second.load, c->second.gravity,
                                     &error) == GOUGH_OK,
                  "%s", error.message);
    gough_program(&model.machine, &model.motion, 0, &state, &unused);
    memcpy(c->state, state.position, sizeof state.position);
    memcpy(c->state + ROTATION, state.rotation, sizeof state.rotation);
    memcpy(c->state + VELOCITY, state.velocity, sizeof state.velocity);
    memcpy(c->state + OMEGA, state.angular_velocity, sizeof state.angular_velocity);

    model.control.ignores_legs = ignores_legs;
    model.control.ignores_friction = ignores_friction;
    const gough_platform bare = gough_platform_default();
    c->known = c->second;
    if (ignores_legs) {
        c->known.platform.cylinder = c->known.platform.piston = bare.piston;
        memset(c->known.platform.reflected_mass, 0, sizeof bare.reflected_mass);
    }
    if (ignores_friction) c->known.platform.friction = bare.friction;
    c->now = wanted_at(&c->known, 0);
}

/* steps up to time t, as near to h as divides the interval */
static void advance(comparison *c, double t, double h) {
    const int steps = (int)lrint((t - c->time) / h);
    for (int n = 0; n < steps; n++)
        step(c, c->time + (t - c->time) / steps * n, (t - c->time) / steps, &c->now, c->state);
    c->time = t;
}

static int compare_row(void *context, const gough_row *row) {
    comparison *c = context;
    const double *v = row->value,
                 angle[3] = {v[GOUGH_ROLL_ANGLE], v[GOUGH_PITCH_ANGLE], v[GOUGH_YAW_ANGLE]};
    double R[3][3];
    bodies_instant now;
    advance(c, v[GOUGH_T], STEP);
    instant_of(&c->second, c->time, c->state, &c->now, &now);
    gough_rotation_from_angles(angle, R);
    for (int i = 0; i < 3; i++) {
        c->pose = worse(c->pose, v[GOUGH_X + i] - c->state[i]);
        c->rate = worse(c->rate, v[GOUGH_VX + i] - c->state[VELOCITY + i]);
        c->rate = worse(c->rate, v[GOUGH_WX + i] - c->state[OMEGA + i]);
        for (int j = 0; j < 3; j++)
            c->pose = worse(c->pose, R[i][j] - c->state[ROTATION + 3 * i + j]);
    }
    for (int k = 0; k < 6; k++) c->force = worse(c->force, v[GOUGH_F + k] - now.drive[k]);
    c->rows++;
    return 0;
}

/* What the controller leaves out of the program's forces. */
static const struct {
    const char *name;
    bool ignores_legs, ignores_friction;
    double duration;
} RUNS[] = {{"all known", false, false, 10},
            {"legs ignored", true, false, 2},
            {"friction ignored", false, true, 2},
            {"both ignored", true, true, 2}};

START_TEST(motions_in_a_closed_loop_agree) {
    gough_end end;
    gough_error error = {.message = ""};
    comparison c;
    start_run(&c, RUNS[_i].ignores_legs, RUNS[_i].ignores_friction);
    gough_simulation options = gough_simulation_default();
    options.duration = RUNS[_i].duration;
    options.tolerance = 1e-12;
    const gough_status status = gough_simulate(&model, &options, compare_row, &c, &end, &error);
    ck_assert_msg(status == GOUGH_OK, "%s: %s%s", RUNS[_i].name, error.message, end.message);
    ck_assert_int_eq(c.rows, (int)lrint(RUNS[_i].duration / options.output_step) + 1);
    /* forces follow with factors of G and of friction over its smoothing speed */
    ck_assert_msg(c.pose <= RUN && c.rate <= 10 * RUN && c.force <= 100 * RUN,
                  "%s: poses differ by %g, rates by %g, drive forces by %g", RUNS[_i].name, c.pose,
                  c.rate, c.force);
}
END_TEST

/* ---- along the program ---- */

static int compare_program(void *context, const gough_row *row) {
    comparison *c = context;
    const wanted w = wanted_at(&c->second, row->value[GOUGH_T]);
    for (int k = 0; k < 6; k++) {
        c->force = worse(c->force, row->value[GOUGH_F + k] - w.force[k]);
        c->pose = worse(c->pose, row->value[GOUGH_L + k] - w.length[k]);
        c->rate = worse(c->rate, row->value[GOUGH_DL + k] - w.rate[k]);
    }
    c->rows++;
    return 0;
}

/* Forces are about 1. */
START_TEST(program_forces_agree) {
    gough_end end;
    gough_error error = {.message = ""};
    comparison c;
    start_run(&c, false, false);
    const gough_simulation options = gough_simulation_default();
    const gough_status status =
        gough_forces(&model, &options, compare_program, &c, NULL, NULL, &end, &error);
    ck_assert_msg(status == GOUGH_OK, "%s%s", error.message, end.message);
    ck_assert_int_eq(c.rows, 401);
    ck_assert_msg(c.force <= 1e-11 && c.pose <= 1e-14 && c.rate <= 1e-14,
                  "forces differ by %g, lengths by %g, rates by %g", c.force, c.pose, c.rate);
}
END_TEST

/* ---- the second formulation itself ---- */

/* in steps half as long it finds the same motion, nearer than the library is held to */
START_TEST(the_second_formulation_has_converged) {
    comparison coarse, fine;
    double pose = 0;
    start_run(&coarse, false, false);
    start_run(&fine, false, false);
    advance(&coarse, 2, STEP);
    advance(&fine, 2, STEP / 2);
    for (int i = 0; i < VELOCITY; i++) pose = worse(pose, coarse.state[i] - fine.state[i]);
    ck_assert_msg(pose <= RUN / 2, "steps of %g and half of it differ by %g", STEP, pose);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("heavy_runs");
    TCase *tests = tcase_create("heavy_runs");
    tcase_set_timeout(tests, 120);
    tcase_add_test(tests, program_forces_agree);
    tcase_add_loop_test(tests, motions_in_a_closed_loop_agree, 0,
                        (int)(sizeof RUNS / sizeof RUNS[0]));
    tcase_add_test(tests, the_second_formulation_has_converged);
    suite_add_tcase(suite, tests);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? 0 : 1;
}
