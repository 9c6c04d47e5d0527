/* The loop at rest against runs of the nonlinear equations: where they settle, and how they leave or come back to rest. */
#include <complex.h>

#include "gough/linear.h"
#include "linear/rest_model.h"
#include "support/machines.h"
#include "support/suite.h"

static int keep(void *context, const gough_row *row) {
    memcpy(context, row->value, sizeof row->value);
    return 0;
}

static void run(const gough_model *model, double duration, double tolerance,
                double last[GOUGH_COLUMNS]) {
    gough_simulation s = gough_simulation_default();
    gough_error error = {0};
    gough_end end;

    s.duration = s.output_step = duration;
    s.tolerance = tolerance;
    ck_assert_msg(gough_simulate(model, &s, keep, last, &end, &error) == GOUGH_OK, "%s",
                  error.message);
    ck_assert(fabs(last[GOUGH_T] - duration) <= 1e-9);
}

/* ---- where the loop settles ------------------------------------------------------------------------------------- */

/* a damped run from the pose asked for ends where (stab-14) has it */
static void settles(gough_model *model, const double component[GOUGH_COMPONENTS]) {
    const gough_rest rest = at_rest(model, component);
    double last[GOUGH_COLUMNS], angles[3], rotation[3][3], length[GOUGH_LEGS], asked[GOUGH_LEGS],
        A[GOUGH_LINEAR][GOUGH_LINEAR], largest = 0;
    gough_state pose;
    gough_acceleration none;
    gough_error error;

    for (int c = 0; c < GOUGH_COMPONENTS; c++)
        model->motion.formula[c] = gough_formula_constant(component[c]);
    ck_assert(rest.stable && rest.growth < -0.1);
    run(model, 35 / -rest.growth, 1e-12, last);
    memcpy(rotation, rest.state.rotation, sizeof rotation);
    gough_angles_from_rotation(rotation, angles);
    gough_program(&model->machine, &model->motion, 0, &pose, &none);
    gough_leg_kinematics(&model->machine, &pose, NULL, asked, NULL, NULL);
    gough_leg_kinematics(&model->machine, &rest.state, NULL, length, NULL, NULL);
    for (int i = 0; i < 3; i++) {
        ck_assert_msg(fabs(last[GOUGH_X + i] - rest.state.position[i]) <= 1e-11,
                      "%d: %.17g, not %.17g", i, last[GOUGH_X + i], rest.state.position[i]);
        ck_assert(fabs(last[GOUGH_ROLL_ANGLE + i] - angles[i]) <= 1e-11);
        ck_assert(fabs(rest.state.velocity[i]) <= 0 && fabs(rest.state.angular_velocity[i]) <= 0);
    }
    for (int v = 0; v < GOUGH_LEGS; v++) {
        const double spring = model->control.stiffness[v] * (asked[v] - length[v]);
        ck_assert(fabs(rest.force[v] - spring) <= 1e-12);
        ck_assert(fabs(last[GOUGH_F + v] - spring) <= 1e-10);
    }
    ck_assert(rest.state.position[2] < pose.position[2]); /* it sags */

    /* the loop as it is, without feed-forward, has the matrix found */
    ck_assert(gough_linearise(model, 0, &rest.state, GOUGH_LINEAR, A[0], &error) == GOUGH_OK);
    for (int i = 0; i < GOUGH_LINEAR; i++) {
        for (int j = 0; j < GOUGH_LINEAR; j++) largest = fmax(largest, fabs(A[i][j]));
    }
    for (int i = 0; i < GOUGH_LINEAR; i++) {
        for (int j = 0; j < GOUGH_LINEAR; j++)
            ck_assert(fabs(A[i][j] - rest.matrix[i][j]) <= 1e-13 * largest);
    }
}

START_TEST(without_feedforward_a_damped_run_settles_in_the_equilibrium) {
    static const double home[GOUGH_COMPONENTS],
        elsewhere[GOUGH_COMPONENTS] = {0.1, -0.05, 0.1, 0.05, -0.1, 0.2};
    gough_model *model = new_model(3, 1);

    model->control.feedforward = false;
    paper_machine(&model->machine);
    settles(model, home);
    skew_machine(&model->machine);
    set_gains(model, 12, 3);
    model->control.stiffness[1] = 15; /* legs unlike each other */
    model->control.damping[4] = 2;
    settles(model, home);
    memcpy(model->motion.about, (double[3]){0.1, 0.05, 0.2}, sizeof model->motion.about);
    settles(model, elsewhere);
    free(model);
}
END_TEST

/* the vertical balance of six equal legs under the paper's load, G (l₀ − l) 6h/l = Mg, has two solutions in h or none */
START_TEST(the_upper_of_two_equilibria_is_found_up_to_where_they_meet) {
    gough_model *model = new_model(0, 0);
    double most = 0;
    gough_rest rest;
    gough_error error;

    model->control.feedforward = false;
    paper_machine(&model->machine);
    for (double h = 1e-3; h < 1; h += 1e-5) {
        const double l0 = sqrt(1.49), l = sqrt(h * h + 0.49);
        most = fmax(most, 6 * h * (l0 - l) / l);
    }
    set_gains(model, (1 + 1e-3) / most, 0);
    rest = at_rest(model, NULL);
    {
        const double h = rest.state.position[2], l = sqrt(h * h + 0.49), G = (1 + 1e-3) / most;
        ck_assert(fabs(6 * G * h * (sqrt(1.49) - l) / l - 1) <= 1e-12);
        /* the upper: where less height gives more force */
        ck_assert((h + 1e-3) * (sqrt(1.49) / sqrt((h + 1e-3) * (h + 1e-3) + 0.49) - 1) <
                  h * (sqrt(1.49) / l - 1));
    }
    set_gains(model, (1 - 1e-3) / most, 0);
    ck_assert(gough_stability_at_rest(model, NULL, &rest, &error) == GOUGH_ERROR_NUMERICAL);
    ck_assert_msg(strstr(error.message, "carries only 99.9 %") != NULL, "%s", error.message);
    free(model);
}
END_TEST

/* ---- how it leaves rest or comes back --------------------------------------------------------------------------- */

static const double small = 1e-7;

/* from rest displaced along a mode: in the motion of the centre of mass `about` and components are δr and, to first order, δθ */
static void displaced(gough_model *model, const gough_eigenvalue *e) {
    const double complex lambda = e->value[0] + I * e->value[1];

    for (int a = 0; a < 6; a++) {
        const double complex x = e->mode.shape[a][0] + I * e->mode.shape[a][1];
        double *rate = a < 3 ? model->initial.velocity : model->initial.angular_velocity;
        model->initial.component[a] = small * creal(x);
        model->initial.given[a] = true;
        rate[a % 3] = small * creal(lambda * x);
    }
    model->initial.velocity_given = model->initial.angular_velocity_given = true;
}

/* after the time t the deviation is Re(e^{λt} x), up to what is of second order in it */
static void goes_as_predicted(gough_model *model, const gough_eigenvalue *e, double t) {
    const double complex lambda = e->value[0] + I * e->value[1];
    const double *c = model->machine.load.center_of_mass;
    double last[GOUGH_COLUMNS], R[3][3], found[6], size = 0;

    displaced(model, e);
    run(model, t, 1e-14, last);
    gough_rotation_from_angles(&last[GOUGH_ROLL_ANGLE], R);
    for (int i = 0; i < 3; i++) {
        const double home = (i == 2 ? model->machine.platform.height : 0) + c[i];
        found[i] = last[GOUGH_X + i] - home;
        for (int j = 0; j < 3; j++) found[i] += R[i][j] * c[j];
        found[3 + i] = last[GOUGH_ROLL_ANGLE + i];
    }
    for (int a = 0; a < 6; a++)
        size = fmax(
            size, small * cabs(cexp(lambda * t) * (e->mode.shape[a][0] + I * e->mode.shape[a][1])));
    for (int a = 0; a < 6; a++) {
        const double complex x = e->mode.shape[a][0] + I * e->mode.shape[a][1];
        const double right = small * creal(cexp(lambda * t) * x);
        ck_assert_msg(fabs(found[a] - right) <= 3e-6 * size, "%s, λ = %g%+gi, axis %d: %g, not %g",
                      e->mode.name, e->value[0], e->value[1], a, found[a], right);
    }
}

/* an asymmetric machine with a full tensor of inertia, gravity not vertical, its centre of mass aside */
static void check_modes(int legs) {
    static const double gains[3][2] = {{0, 0}, {1.5, 0}, {2, 0.4}};
    gough_model *model = new_model(0, 0);
    dice d = {23};

    skew_machine(&model->machine);
    if (legs) give_legs(&model->machine, legs, &d);
    memcpy(model->motion.about, model->machine.load.center_of_mass, sizeof model->motion.about);
    for (int g = 0; g < 3; g++) {
        gough_rest rest;
        set_gains(model, gains[g][0], gains[g][1]);
        rest = at_rest(model, NULL);
        for (int k = 0; k < GOUGH_LINEAR; k++) {
            /* decaying modes for less time: round-off grows in the others */
            goes_as_predicted(model, &rest.eigenvalue[k], rest.eigenvalue[k].value[0] < 0 ? 1 : 2);
        }
    }
    free(model);
}

START_TEST(each_mode_of_a_skew_machine_goes_as_its_eigenvalue_says) { check_modes(0); }
END_TEST

START_TEST(each_mode_goes_so_with_legs_that_have_mass) {
    check_modes(LEGS_HEAVY);
    check_modes(LEGS_HEAVY | LEGS_VISCOUS);
}
END_TEST

int main(void) {
    return SUITE_RUN("rest_runs", 60, without_feedforward_a_damped_run_settles_in_the_equilibrium,
                     the_upper_of_two_equilibria_is_found_up_to_where_they_meet,
                     each_mode_of_a_skew_machine_goes_as_its_eigenvalue_says,
                     each_mode_goes_so_with_legs_that_have_mass);
}
