/* The observed order of every stepper, fixed step, in 33 digits: the last two of four halvings, with and without damping; in double
 * until round-off. The run: skew load, six axes, closed loop, disturbed.
 * Sanitized: campaign: run/ends runs every stepper under sanitizers.
 * Label: thorough. */
#include <stdio.h>
#include <stdlib.h>

#include "support/machines.h"
#include "support/suite.h"

/* halvings of a step that ends at 1 exactly; each method where its error stands clear of round-off of the precision */
static const struct {
    gough_method method;
    int order;
    double quad_step, double_step;
} cases[] = {
    {GOUGH_RK4, 4, 0.03125, 0.03125},    {GOUGH_DOP853, 8, 0.125, 0.125},
    {GOUGH_RATTLE2, 2, 0.0625, 0.03125}, {GOUGH_RATTLE4, 4, 0.0625, 0.03125},
    {GOUGH_RATTLE6, 6, 0.0625, 0.03125}, {GOUGH_RATTLE8, 8, 0.0625, 0.0625},
};

typedef struct {
    gough_quad z[GOUGH_COLUMNS];
} last_row;

static int keep(void *context, const gough_row *row) {
    last_row *last = context;

    for (int c = 0; c < GOUGH_COLUMNS; c++) {
        last->z[c] = row->quad ? row->quad[c] : (gough_quad)row->value[c];
    }
    return 0;
}

/* what closes the loop, beside legs of some kind: a controller that samples, drives that lag */
enum { LOOP_SAMPLED = 16, LOOP_LAGS = 32 };

static void give_loop(gough_model *model, int what) {
    gough_platform p = model->machine.platform;
    const gough_load load = model->machine.load;
    gough_error error = {0};

    if (what & LOOP_SAMPLED) model->control.sampling = (gough_sampling){.period = 0.125};
    if (what & LOOP_SAMPLED) set_gains(model, 8, 0.8);
    if (!(what & LOOP_LAGS)) return;
    p.actuators.kind = GOUGH_ACTUATOR_LAG;
    for (int v = 0; v < GOUGH_LEGS; v++) p.actuators.time_constant[v] = 0.15;
    for (int v = 0; v < GOUGH_LEGS; v++) model->control.integral[v] = 3;
    ck_assert_msg(gough_machine_init(&model->machine, &p, &load, model->machine.gravity, &error) ==
                      GOUGH_OK,
                  "%s", error.message);
}

/* a run that leaves the program in every direction */
static gough_model *model_of(double damping, int legs) {
    gough_model *model = calloc(1, sizeof *model);
    dice d = {17};

    skew_machine(&model->machine);
    if (legs) give_legs(&model->machine, legs, &d);
    model->control.feedforward = true;
    set_gains(model, 20, damping);
    give_loop(model, legs);
    set_all_axes(model);
    set_formula(&model->disturbance.leg_force[1], "0.1*sin(2*t)");
    set_formula(&model->disturbance.force[0], "0.2*cos(t)");
    set_formula(&model->disturbance.moment[2], "0.05*sin(3*t)");
    model->initial.component[GOUGH_HEAVE] = 0.05;
    model->initial.given[GOUGH_HEAVE] = true;
    model->initial.component[GOUGH_YAW] = 0.1;
    model->initial.given[GOUGH_YAW] = true;
    model->initial.angular_velocity[0] = 0.3;
    model->initial.angular_velocity_given = true;
    return model;
}

static void run(const gough_model *model, gough_method method, gough_precision precision,
                double step, double tolerance, last_row *last) {
    gough_simulation s = gough_simulation_default();
    gough_error error = {0};
    gough_end end;

    s.duration = s.output_step = 1;
    s.method = method;
    s.step = step;
    s.tolerance = tolerance;
    s.precision = precision;
    s.constraints = GOUGH_PROJECTION;
    ck_assert_msg(gough_simulate(model, &s, keep, last, &end, &error) == GOUGH_OK, "%s",
                  error.message);
}

/* largest difference in pose and velocities */
static double distance(const last_row *a, const last_row *b) {
    double worst = 0;

    for (int c = GOUGH_X; c <= GOUGH_WZ; c++) {
        const double d = fabs((double)(a->z[c] - b->z[c]));
        ck_assert(isfinite(d));
        worst = fmax(worst, d);
    }
    return worst;
}

/* orders of the last two of so many halvings, against a run of adaptive steps whose tolerance is far below the least error */
static void check_quad(double damping, int what, int halvings, double tolerance) {
    gough_model *model = model_of(damping, what);
    last_row reference, row;

    run(model, GOUGH_DOP853, GOUGH_QUADRUPLE, 0, tolerance, &reference);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        double step = cases[i].quad_step, error = 0, before = 0;
        if (what & (LEGS_DRY | LOOP_LAGS) && cases[i].method >= GOUGH_RATTLE2) continue;
        printf("%-8s D = %g:", gough_method_name((int)cases[i].method), damping);
        for (int k = 0; k <= halvings; k++, step /= 2, before = error) {
            run(model, cases[i].method, GOUGH_QUADRUPLE, step, tolerance, &row);
            error = distance(&row, &reference);
            const double order = k > 0 ? log2(before / error) : 0;
            printf(" %.2e (%.3f)", error, order);
            ck_assert_msg(k < halvings - 1 || fabs(order - cases[i].order) <= 0.15, "%s: order %g",
                          gough_method_name((int)cases[i].method), order);
        }
        puts("");
    }
    free(model);
}

START_TEST(orders_without_damping) { check_quad(0, 0, 4, 1e-20); }
END_TEST

START_TEST(orders_with_damping) { check_quad(3, 0, 4, 1e-22); }
END_TEST

START_TEST(orders_with_viscous_friction) { check_quad(0, LEGS_VISCOUS, 3, 1e-18); }
END_TEST

START_TEST(orders_with_heavy_legs_undamped) { check_quad(0, LEGS_HEAVY, 4, 1e-22); }
END_TEST

START_TEST(orders_with_heavy_legs) { check_quad(3, LEGS_HEAVY | LEGS_VISCOUS, 3, 1e-22); }
END_TEST

/* a command that is held is a constant force: damping then asks nothing of a step */
START_TEST(orders_with_held_commands) { check_quad(3, LOOP_SAMPLED, 3, 1e-24); }
END_TEST

START_TEST(orders_with_held_commands_and_heavy_legs) {
    check_quad(3, LOOP_SAMPLED | LEGS_HEAVY | LEGS_VISCOUS, 3, 1e-25);
}
END_TEST

START_TEST(orders_with_lagging_drives) { check_quad(3, LOOP_LAGS, 3, 1e-17); }
END_TEST

START_TEST(orders_with_held_commands_and_lagging_drives) {
    check_quad(3, LOOP_SAMPLED | LOOP_LAGS, 3, 1e-19);
}
END_TEST

/* in double the error falls by the order down to round-off: the least error is below 1e-12 where the order is 6 or 8 */
START_TEST(orders_in_double_until_round_off) {
    gough_model *model = model_of(0, 0);
    last_row reference, row;

    run(model, GOUGH_DOP853, GOUGH_QUADRUPLE, 0, 1e-20, &reference);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        double step = cases[i].double_step, before = 0, least = INFINITY;
        int met = 0;
        for (int k = 0; k <= 5; k++, step /= 2) {
            run(model, cases[i].method, GOUGH_DOUBLE, step, 1e-20, &row);
            const double error = distance(&row, &reference);
            const double order = k > 0 ? log2(before / error) : 0;
            /* far enough from round-off for the order to be seen */
            if (k > 1 && error > 1e-12) {
                ck_assert_msg(order > cases[i].order - 0.6, "%s: order %g at %g",
                              gough_method_name((int)cases[i].method), order, step);
                met++;
            }
            least = fmin(least, error);
            before = error;
        }
        printf("%-8s in double: least error %.2e\n", gough_method_name((int)cases[i].method),
               least);
        ck_assert_int_gt(met, 0);
        if (cases[i].order >= 6) ck_assert(least < 1e-12);
    }
    free(model);
}
END_TEST

int main(void) {
    return SUITE_RUN(
        "order", 300, orders_without_damping, orders_with_damping, orders_with_viscous_friction,
        orders_with_heavy_legs_undamped, orders_with_heavy_legs, orders_with_held_commands,
        orders_with_held_commands_and_heavy_legs, orders_with_lagging_drives,
        orders_with_held_commands_and_lagging_drives, orders_in_double_until_round_off);
}
