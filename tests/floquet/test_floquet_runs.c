/* Multipliers against nonlinear runs: what begins 1e-9 beside a periodic motion is multiplied in a period as predicted.
 * Label: standard.
 * Not sanitized: the same functions run under sanitizers in the tests of the command. */
#include <stdio.h>
#include <stdlib.h>

#include "gough/floquet.h"
#include "support/deviations.h"
#include "support/machines.h"
#include "support/suite.h"

enum { N = GOUGH_LINEAR };

static const double beside =
    1e-9; /* in units of length, angle and their rates; the units here are dimensionless */

/* of the runs, over a period */
static const double rounding = 5e-13;

static double size_of(const double xi[N]) {
    double sum = 0;

    for (int i = 0; i < N; i++) sum += xi[i] * xi[i];
    return sqrt(sum);
}

static void multiply(const gough_floquet *f, const double xi[N], double out[N]) {
    for (int i = 0; i < N; i++) {
        out[i] = 0;
        for (int j = 0; j < N; j++) out[i] += f->monodromy[i][j] * xi[j];
    }
}

/* ---- runs ---- */

static int keep_last(void *context, const gough_row *row) {
    gough_state *s = context;
    const double *v = row->value,
                 angles[3] = {v[GOUGH_ROLL_ANGLE], v[GOUGH_PITCH_ANGLE], v[GOUGH_YAW_ANGLE]};

    gough_rotation_from_angles(angles, s->rotation);
    for (int i = 0; i < 3; i++) {
        s->position[i] = v[GOUGH_X + i];
        s->velocity[i] = v[GOUGH_VX + i];
        s->angular_velocity[i] = v[GOUGH_WX + i];
    }
    return 0;
}

/* where a run from a state at t = 0 is at its end */
static gough_state run(gough_model *model, const gough_state *from, double duration) {
    gough_simulation options = gough_simulation_default();
    gough_error error = {0};
    gough_state to, begin = *from;
    gough_end end;

    options.duration = duration;
    options.output_step = duration;
    options.tolerance = 1e-14;
    gough_angles_from_rotation(begin.rotation, model->initial.component + 3);
    for (int i = 0; i < 3; i++) {
        model->initial.component[i] =
            begin.position[i] - (i == 2 ? model->machine.platform.height : 0);
        model->initial.velocity[i] = begin.velocity[i];
        model->initial.angular_velocity[i] = begin.angular_velocity[i];
    }
    for (int c = 0; c < GOUGH_COMPONENTS; c++) model->initial.given[c] = true;
    model->initial.velocity_given = model->initial.angular_velocity_given = true;
    ck_assert_msg(gough_simulate(model, &options, keep_last, &to, &end, &error) == GOUGH_OK, "%s%s",
                  error.message, end.message);
    return to;
}

static gough_floquet multipliers(const gough_model *model) {
    gough_error error = {0};
    gough_floquet f;

    ck_assert_msg(gough_floquet_multipliers(model, NULL, 0, &f, &error) == GOUGH_OK, "%s",
                  error.message);
    ck_assert(fabs(f.start) <= 0); /* no start-up: runs begin at t = 0 */
    return f;
}

/* the direction that grows most, by power iteration from one that favours none; |μ| where it is real */
static double growing(const gough_floquet *f, double xi[N]) {
    double next[N], size = 1;

    for (int i = 0; i < N; i++) xi[i] = 1 + 0.3 * i - 0.05 * i * i;
    for (int sweep = 0; sweep < 400; sweep++) {
        multiply(f, xi, next);
        size = size_of(next);
        for (int i = 0; i < N; i++) xi[i] = next[i] / size;
    }
    return size;
}

/* after one period from 1e-9 beside the motion: the run's deviation is M ξ, for the growing direction and for two others, to
 * 1e-4 of its size and the rounding of the runs; and it has grown by |μ| where that is real */
static void check_run(gough_model *model, bool real, double unstable) {
    const gough_floquet f = multipliers(model);
    const gough_state home = run(model, &f.state, f.period);
    double xi[3][N];
    const double growth = growing(&f, xi[0]);

    ck_assert_msg(f.growth > unstable, "growth %g", f.growth);
    if (real) ck_assert_msg(fabs(growth - f.growth) <= 1e-9 * f.growth, "%g %g", growth, f.growth);
    for (int i = 0; i < N; i++) {
        xi[1][i] = cos(1 + i) / 3;
        xi[2][i] = sin(2 + 3 * i) / 3;
    }
    for (int k = 0; k < 3; k++) {
        double predicted[N], found[N], apart[N];
        gough_state from, to;
        for (int i = 0; i < N; i++) xi[k][i] *= beside;
        from = changed(&model->machine, &f.state, xi[k]);
        to = run(model, &from, f.period);
        difference(&model->machine, &home, &to, found);
        multiply(&f, xi[k], predicted);
        for (int i = 0; i < N; i++) apart[i] = found[i] - predicted[i];
        ck_assert_msg(size_of(apart) <= 1e-4 * size_of(predicted) + rounding,
                      "direction %d: %g of %g", k, size_of(apart), size_of(predicted));
        if (k == 0 && real) {
            const double ratio = size_of(found) / size_of(xi[0]);
            ck_assert_msg(fabs(ratio - f.growth) <= 1e-3 * f.growth, "%.9g, not %.9g", ratio,
                          f.growth);
        }
    }
}

/* ---- models ---- */

static gough_model *model_of(bool skew, const char *const text[GOUGH_COMPONENTS], double G,
                             double D) {
    gough_model *model = calloc(1, sizeof *model);

    ck_assert(model != NULL);
    if (skew)
        skew_machine(&model->machine);
    else
        paper_machine(&model->machine);
    model->control.feedforward = true;
    set_gains(model, G, D);
    for (int c = 0; c < GOUGH_COMPONENTS; c++) set_formula(&model->motion.formula[c], text[c]);
    return model;
}

static const char *const heave[] = {"0", "0", "0.2*sin(t)", "0", "0", "0"};
static const char *const all[] = {"0.05*sin(t)",   "0.04*sin(2*t + 0.4)", "0.1*sin(t)",
                                  "0.08*sin(2*t)", "0.06*cos(t)",         "0.1*sin(3*t + 1)"};
static const char *const fast[] = {"0",   "0.05*cos(2*t)", "0.25*sin(2*t)", "0.1*sin(2*t)",
                                   "0.1", "0.1*sin(4*t)"};

START_TEST(growth_is_that_of_a_run_in_heave) {
    const double stiffness[] = {0, 0.15, 0.35};

    for (int i = 0; i < 3; i++) {
        gough_model *model = model_of(false, heave, stiffness[i], 0);
        check_run(model, i == 1, 10); /* sway and roll grow alike elsewhere */
        free(model);
    }
}
END_TEST

START_TEST(growth_is_that_of_a_run_on_six_axes) {
    gough_model *model = model_of(false, all, 0.2, 0);

    check_run(model, true, 10);
    free(model);
    model = model_of(true, all, 0.1, 0);
    check_run(model, true, 10);
    free(model);
}
END_TEST

START_TEST(growth_is_that_of_a_run_with_heavy_legs) {
    gough_model *model = model_of(true, all, 0.1, 0);
    dice d = {37};

    give_legs(&model->machine, LEGS_HEAVY, &d);
    check_run(model, false, 5);
    set_gains(model, 0.3, 0.02);
    give_legs(&model->machine, LEGS_VISCOUS, &d);
    check_run(model, false, 0);
    free(model);
}
END_TEST

START_TEST(growth_is_that_of_a_run_with_damping) {
    gough_model *model = model_of(true, all, 0.1, 0.05);

    check_run(model, true, 5);
    free(model);
    model = model_of(true, fast, 1.2, 0.02);
    check_run(model, false, 0);
    free(model);
    model = model_of(true, all, 3, 0.3);
    check_run(model, false, 0);
    free(model);
}
END_TEST

/* ---- without feed-forward ---- */

/* the motion found comes back in a run; away from it deviations go as predicted */
static void check_motion(bool skew, const char *const text[GOUGH_COMPONENTS], double G, double D) {
    gough_model *model = model_of(skew, text, G, D);
    double apart[N];
    gough_floquet f;
    gough_state after;

    model->control.feedforward = false;
    f = multipliers(model);
    after = run(model, &f.state, f.period);
    difference(&model->machine, &f.state, &after, apart);
    ck_assert_msg(size_of(apart) <= 1e-9, "G = %g, D = %g: %g", G, D, size_of(apart));
    if (!(D > 0)) {
        ck_assert_msg(f.determinant_defect <= 1e-9, "%g", f.determinant_defect);
        ck_assert_msg(f.pair_defect <= 1e-9, "%g", f.pair_defect);
    }
    check_run(model, false, 0);
    free(model);
}

START_TEST(motion_without_feedforward_comes_back) {
    check_motion(false, heave, 5, 0);
    check_motion(false, heave, 100, 0);
    check_motion(false, heave, 2, 0);
    check_motion(false, all, 4, 0.5);
    check_motion(true, all, 20, 0);
    check_motion(true, fast, 6, 0.4);
}
END_TEST

START_TEST(weak_legs_without_feedforward_are_told) {
    const double stiffness[] = {0, 0.01, 1};

    for (int i = 0; i < 3; i++) {
        gough_model *model = model_of(false, heave, stiffness[i], 0);
        gough_error error = {0};
        gough_floquet f;
        model->control.feedforward = false;
        ck_assert(gough_floquet_multipliers(model, NULL, 0, &f, &error) == GOUGH_ERROR_NUMERICAL);
        ck_assert_msg(strstr(error.message, "without feed-forward") &&
                          strstr(error.message, "control.stiffness") &&
                          strstr(error.message, "control.feedforward"),
                      "%s", error.message);
        free(model);
    }
}
END_TEST

/* ---- where the feed-forward ignores part of the machine ---- */

enum { NO_LEGS = 1, NO_FRICTION = 2, NO_LOADS = 4 };

static gough_model *ignoring(int what, double G, double D, gough_external *wind) {
    gough_model *model = model_of(true, all, G, D);
    dice d = {43};

    give_legs(&model->machine, LEGS_HEAVY | (what & NO_FRICTION ? LEGS_VISCOUS : 0), &d);
    if (what & NO_LOADS) {
        *wind = (gough_external){.at = {0.1, 0.2, 0.3}, .at_given = true};
        set_formula(&wind->force[0], "0.05*cos(t)");
        set_formula(&wind->force[2], "-0.1");
        ck_assert(gough_machine_set_external(&model->machine, wind, 1, NULL) == GOUGH_OK);
    }
    model->control.ignores_legs = what & NO_LEGS;
    model->control.ignores_friction = what & NO_FRICTION;
    model->control.ignores_external = what & NO_LOADS;
    return model;
}

/* The motion found differs from the program and comes back in a nonlinear run. Deviations from it go as predicted, growing ones
 * too. Forces that depend on time alone and springs have a potential, so that without any damping pairs and determinant hold. */
START_TEST(motion_of_a_controller_that_ignores_comes_back) {
    static const struct {
        int what;
        double G, D, unstable;
    } CASES[] = {{NO_LEGS, 30, 0, 0},
                 {NO_LEGS, 4.458, 0, 1.01},
                 {NO_LOADS, 3.096, 0, 5},
                 {NO_FRICTION, 3, 0, 2},
                 {NO_LEGS | NO_FRICTION | NO_LOADS, 10, 0.2, 0}};

    for (size_t i = 0; i < sizeof CASES / sizeof CASES[0]; i++) {
        gough_external wind;
        gough_model *model = ignoring(CASES[i].what, CASES[i].G, CASES[i].D, &wind);
        const gough_floquet f = multipliers(model);
        const gough_state after = run(model, &f.state, f.period);
        gough_acceleration ignored;
        gough_state program;
        double apart[N];
        difference(&model->machine, &f.state, &after, apart);
        ck_assert_msg(size_of(apart) <= 1e-9, "case %zu: %g", i, size_of(apart));
        gough_program(&model->machine, &model->motion, f.start, &program, &ignored);
        difference(&model->machine, &program, &f.state, apart);
        ck_assert_msg(size_of(apart) > 1e-3, "case %zu: %g", i, size_of(apart));
        if (!(CASES[i].D > 0) && !(CASES[i].what & NO_FRICTION)) {
            ck_assert_msg(f.determinant_defect <= 1e-9, "%g", f.determinant_defect);
            ck_assert_msg(f.pair_defect <= 1e-8, "%g", f.pair_defect);
        }
        check_run(model, false, CASES[i].unstable);
        free(model);
    }
}
END_TEST

/* how far a run with dry friction is from a state after some periods, well damped */
static double lag(gough_model *model, const gough_floquet *f, double coulomb) {
    gough_platform p = model->machine.platform;
    const gough_load load = model->machine.load;
    double gravity[3], apart[N];
    gough_state after;

    memcpy(gravity, model->machine.gravity, sizeof gravity);
    for (int v = 0; v < GOUGH_LEGS; v++) {
        p.friction.coulomb[v] = p.friction.breakaway[v] = coulomb;
        p.friction.smoothing_speed[v] = 0.01;
    }
    ck_assert(gough_machine_init(&model->machine, &p, &load, gravity, NULL) == GOUGH_OK);
    after = run(model, &f->state, 2 * f->period);
    difference(&model->machine, &f->state, &after, apart);
    return size_of(apart);
}

/* Dry friction is left out of the motion too: multipliers and state are, bit for bit, those without it. A run is off that motion by
 * as much as the friction. */
START_TEST(dry_friction_is_left_out_of_the_motion) {
    for (int fed = 0; fed < 2; fed++) {
        gough_model *model = ignoring(NO_LEGS | NO_FRICTION, 20, 1, NULL);
        model->control.feedforward = fed;
        const gough_floquet bare = multipliers(model);
        const double one = lag(model, &bare, 1e-4);
        const gough_floquet dry = multipliers(model);
        const double two = lag(model, &bare, 2e-4);
        ck_assert(memcmp(&bare.state, &dry.state, sizeof bare.state) == 0);
        ck_assert(memcmp(bare.monodromy, dry.monodromy, sizeof bare.monodromy) == 0);
        ck_assert_msg(one > 1e-5 && one < 1e-3, "%g", one);
        ck_assert_msg(fabs(two / one - 2) <= 0.02, "%g", two / one);
        free(model);
    }
}
END_TEST

START_TEST(what_keeps_the_loop_from_its_program_is_told) {
    gough_external wind;
    gough_model *model = ignoring(NO_LEGS | NO_FRICTION | NO_LOADS, 0.05, 0, &wind);
    gough_error error = {0};
    gough_floquet f;

    ck_assert(gough_floquet_multipliers(model, NULL, 0, &f, &error) == GOUGH_ERROR_NUMERICAL);
    ck_assert_msg(strstr(error.message, "with feed-forward that ignores the legs' mass, their "
                                        "viscous friction and the external loads no periodic "
                                        "motion was found near the program") &&
                      strstr(error.message, "or set control.model.legs, control.model.friction "
                                            "and control.model.external to true"),
                  "%s", error.message);
    free(model);
}
END_TEST

int main(void) {
    return SUITE_RUN("floquet_runs", 120, motion_of_a_controller_that_ignores_comes_back,
                     dry_friction_is_left_out_of_the_motion,
                     what_keeps_the_loop_from_its_program_is_told, growth_is_that_of_a_run_in_heave,
                     growth_is_that_of_a_run_on_six_axes, growth_is_that_of_a_run_with_heavy_legs,
                     growth_is_that_of_a_run_with_damping, motion_without_feedforward_comes_back,
                     weak_legs_without_feedforward_are_told);
}
