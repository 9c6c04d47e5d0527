/* RATTLE with heavy legs by other roads: pistons that are points at the top joints are part of the load, step by step; the energy
 * of load, legs and springs, from its definition, does not drift. */
#include <stdio.h>
#include <stdlib.h>

#include "gough/dynamics.h"
#include "support/machines.h"
#include "support/suite.h"

/* ---- a run from rest away from home ---- */

static gough_model *model_of(const gough_platform *platform, const gough_load *load) {
    static const double gravity[3] = {0.1, -0.05, -1};
    gough_model *model = calloc(1, sizeof *model);
    gough_error error = {0};

    ck_assert_msg(gough_machine_init(&model->machine, platform, load, gravity, &error) == GOUGH_OK,
                  "%s", error.message);
    model->control.feedforward = true;
    set_gains(model, 20, 0);
    model->initial.component[GOUGH_HEAVE] = 0.05;
    model->initial.given[GOUGH_HEAVE] = true;
    model->initial.component[GOUGH_YAW] = 0.1;
    model->initial.given[GOUGH_YAW] = true;
    return model;
}

static void run(const gough_model *model, gough_method method, double step, double output_step,
                double duration, gough_sink sink, void *context) {
    gough_simulation s = gough_simulation_default();
    gough_error error = {0};
    gough_end end;

    s.method = method;
    s.step = step;
    s.output_step = output_step;
    s.duration = duration;
    ck_assert_msg(gough_simulate(model, &s, sink, context, &end, &error) == GOUGH_OK, "%s",
                  error.message);
}

/* ---- the same bodies, described in two ways ---- */

/* the load with point masses m at the top joints */
static gough_load carrying(const gough_load *load, const gough_platform *p, const double *m) {
    gough_load all = *load;
    double moment[3];

    for (int i = 0; i < 3; i++) moment[i] = load->mass * load->center_of_mass[i];
    for (int v = 0; v < GOUGH_LEGS; v++) {
        all.mass += m[v];
        for (int i = 0; i < 3; i++) moment[i] += m[v] * p->top[v][i];
    }
    for (int i = 0; i < 3; i++) all.center_of_mass[i] = moment[i] / all.mass;
    for (int v = -1; v < GOUGH_LEGS; v++) {
        const double mass = v < 0 ? load->mass : m[v];
        const double *x = v < 0 ? load->center_of_mass : p->top[v];
        double r[3], square = 0;
        for (int i = 0; i < 3; i++) {
            r[i] = x[i] - all.center_of_mass[i];
            square += r[i] * r[i];
        }
        for (int i = 0; i < 3; i++) {
            for (int j = 0; j < 3; j++) {
                all.inertia[i][j] += mass * ((i == j ? square : 0) - r[i] * r[j]);
            }
        }
    }
    return all;
}

enum { ROWS = 41 };

typedef struct {
    int rows;
    double value[ROWS][GOUGH_COLUMNS];
} table;

static int keep(void *context, const gough_row *row) {
    table *t = context;

    ck_assert_int_lt(t->rows, ROWS);
    memcpy(t->value[t->rows++], row->value, sizeof row->value);
    return 0;
}

/* runs of ten units in steps of 0.05, of all orders */
START_TEST(points_at_the_joints_belong_to_the_load) {
    const gough_method method = (gough_method)((int)GOUGH_RATTLE2 + _i / 2);
    const double viscous = _i % 2 ? 0.4 : 0;
    gough_machine machine;
    dice d = {5};
    table *pistons = calloc(1, sizeof *pistons), *body = calloc(1, sizeof *body);
    double worst = 0;

    skew_machine(&machine);
    gough_platform p = machine.platform;
    for (int v = 0; v < GOUGH_LEGS; v++) {
        p.piston.mass[v] = dice_between(&d, 0.05, 0.4);
        p.friction.viscous[v] = viscous * dice_between(&d, 0.5, 1);
    }
    const gough_load heavy = carrying(&machine.load, &p, p.piston.mass);
    gough_model *one = model_of(&p, &machine.load);
    memset(&p.piston, 0, sizeof p.piston);
    gough_model *other = model_of(&p, &heavy);
    ck_assert(one->machine.platform.legs_have_mass && !other->machine.platform.legs_have_mass);

    run(one, method, 0.05, 0.25, 10, keep, pistons);
    run(other, method, 0.05, 0.25, 10, keep, body);
    ck_assert_int_eq(pistons->rows, ROWS);
    ck_assert_int_eq(body->rows, ROWS);
    for (int row = 0; row < ROWS; row++) {
        for (int c = GOUGH_X; c <= GOUGH_WZ; c++) {
            worst = fmax(worst, fabs(pistons->value[row][c] - body->value[row][c]));
        }
    }
    printf("%s, viscous friction %g: poses and velocities differ by %.1e\n",
           gough_method_name((int)method), viscous, worst);
    ck_assert(fabs(body->value[ROWS - 1][GOUGH_X] - body->value[0][GOUGH_X]) > 1e-4);
    ck_assert_msg(worst <= 1e-11, "%g", worst);
    free(one);
    free(other);
    free(pistons);
    free(body);
}
END_TEST

/* ---- energy ---- */

enum { TENTHS = 10 };

typedef struct {
    const gough_model *model;
    double force[GOUGH_LEGS], home[GOUGH_LEGS]; /* of the program, which rests */
    int row, rows;
    double first, kinetic; /* energy at the beginning; greatest kinetic energy */
    double mean[TENTHS], weight[TENTHS], drift;
} account;

static double inner(const double *a, const double *b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* a × b */
static void turning(const double *a, const double *b, double *c) {
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

/* a point of the top: where it is and how fast */
static void point_of(const double *value, double R[3][3], const double *at, double *x, double *v) {
    double arm[3], turn[3];

    for (int i = 0; i < 3; i++) arm[i] = inner(R[i], at);
    turning(value + GOUGH_WX, arm, turn);
    for (int i = 0; i < 3; i++) {
        x[i] = value[GOUGH_X + i] + arm[i];
        v[i] = value[GOUGH_VX + i] + turn[i];
    }
}

/* Energy of a leg: each part at its own centre of mass; the spring, and the steady force of the program. */
static double leg_energy(const account *a, int v, const double *value, double R[3][3],
                         double *kinetic) {
    const gough_platform *p = &a->model->machine.platform;
    const double *g = a->model->machine.gravity;
    double x[3], rate[3], n[3], turn[3], cylinder = 0, piston = 0, height = 0;

    point_of(value, R, p->top[v], x, rate);
    for (int i = 0; i < 3; i++) x[i] -= p->base[v][i];
    const double length = sqrt(inner(x, x));
    for (int i = 0; i < 3; i++) n[i] = x[i] / length;
    const double speed = inner(n, rate);
    for (int i = 0; i < 3; i++) {
        turn[i] = (rate[i] - speed * n[i]) / length;
        const double one = p->cylinder.center[v] * turn[i];
        const double two = rate[i] - p->piston.center[v] * turn[i];
        cylinder += one * one;
        piston += two * two;
        height -= g[i] * (p->cylinder.mass[v] * p->cylinder.center[v] * n[i] +
                          p->piston.mass[v] * (x[i] - p->piston.center[v] * n[i]));
    }
    *kinetic += 0.5 * (p->cylinder.mass[v] * cylinder + p->piston.mass[v] * piston +
                       (p->cylinder.inertia[v] + p->piston.inertia[v]) * inner(turn, turn) +
                       p->reflected_mass[v] * speed * speed);
    const double longer = length - a->home[v];
    return height + 0.5 * a->model->control.stiffness[v] * longer * longer - a->force[v] * longer;
}

static double energy(const account *a, const double *value, double *kinetic) {
    const gough_load *load = &a->model->machine.load;
    double R[3][3], x[3], v[3], omega[3];
    const double angle[3] = {value[GOUGH_ROLL_ANGLE], value[GOUGH_PITCH_ANGLE],
                             value[GOUGH_YAW_ANGLE]};
    double potential;

    gough_rotation_from_angles(angle, R);
    point_of(value, R, load->center_of_mass, x, v);
    *kinetic = 0.5 * load->mass * inner(v, v);
    for (int i = 0; i < 3; i++) {
        omega[i] =
            R[0][i] * value[GOUGH_WX] + R[1][i] * value[GOUGH_WY] + R[2][i] * value[GOUGH_WZ];
    }
    for (int i = 0; i < 3; i++) *kinetic += 0.5 * omega[i] * inner(load->inertia[i], omega);
    potential = -load->mass * inner(a->model->machine.gravity, x);
    for (int leg = 0; leg < GOUGH_LEGS; leg++) potential += leg_energy(a, leg, value, R, kinetic);
    return *kinetic + potential;
}

/* means over the tenths of a run, with weights that fade in and out, so that oscillations leave nothing */
static int add_up(void *context, const gough_row *row) {
    account *a = context;
    const int tenth = a->rows / TENTHS;
    double kinetic;
    const double e = energy(a, row->value, &kinetic);

    if (a->row == 0) a->first = e;
    a->kinetic = fmax(a->kinetic, kinetic);
    a->drift = fmax(a->drift, row->value[GOUGH_DRIFT]);
    for (int i = 0; i < TENTHS; i++) {
        const double at = (double)(a->row - i * tenth) / tenth;
        if (at < 0 || at > 1) continue;
        const double weight = pow(sin(pi * at), 4);
        a->mean[i] += weight * (e - a->first);
        a->weight[i] += weight;
    }
    a->row++;
    return 0;
}

static int first_forces(void *context, const gough_row *row) {
    account *a = context;

    for (int v = 0; v < GOUGH_LEGS; v++) {
        a->force[v] = row->value[GOUGH_F + v];
        a->home[v] = row->value[GOUGH_L + v];
    }
    return 0;
}

START_TEST(energy_does_not_drift) {
    static const double step = 0.02, steps = 3e5;
    gough_machine machine;
    dice d = {8};
    double half[2] = {0, 0};
    account a = {.rows = (int)(steps / 10)};
    gough_simulation s = gough_simulation_default();
    gough_error error = {0};
    gough_end end;

    skew_machine(&machine);
    give_legs(&machine, LEGS_HEAVY, &d);
    gough_model *model = model_of(&machine.platform, &machine.load);
    a.model = model;
    s.duration = s.output_step = 1;
    ck_assert_int_eq(gough_forces(model, &s, first_forces, &a, NULL, NULL, &end, &error), GOUGH_OK);
    run(model, GOUGH_RATTLE2, step, 10 * step, steps * step, add_up, &a);
    ck_assert_int_eq(a.row, a.rows + 1);
    for (int i = 0; i < TENTHS; i++) {
        a.mean[i] /= a.weight[i] * a.kinetic;
        half[2 * i / TENTHS] += a.mean[i] / (TENTHS / 2);
    }
    printf(
        "3e5 steps of rattle2: mean error of energy %.6e in the first half, %.6e in the second, of "
        "the kinetic energy; triad %.1e\n",
        half[0], half[1], a.drift);
    fflush(stdout);
    ck_assert(fabs(half[0]) > 1e-4); /* the error of the steps is seen, and stays */
    ck_assert(fabs(half[1] - half[0]) <= 1e-3 * fabs(half[0]));
    for (int i = 0; i < TENTHS; i++) ck_assert(fabs(a.mean[i] - half[0]) <= 0.01 * fabs(half[0]));
    ck_assert(a.drift <= 1e-14);
    free(model);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("independent/heavy_rattle");
    TCase *all = tcase_create("all");
    SRunner *runner = srunner_create(suite);

    tcase_set_timeout(all, 120);
    tcase_add_loop_test(all, points_at_the_joints_belong_to_the_load, 0, 8);
    tcase_add_test(all, energy_does_not_drift);
    suite_add_tcase(suite, all);
    srunner_run_all(runner, CK_ENV);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed ? EXIT_FAILURE : EXIT_SUCCESS;
}
