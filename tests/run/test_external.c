/* External loads against closed forms and an independent sum of points: what they are in a pose, in the forces of a program, in
 * its motion, in lanes, and the work that they do; and angles in the other order. */
#include <stdlib.h>

#include "gough/gough.h"
#include "support/machines.h"
#include "support/suite.h"

static void near(double found, double right, double tolerance, const char *what) {
    ck_assert_msg(fabs(found - right) <= tolerance, "%s: %.17g, not %.17g", what, found, right);
}

static void cross_to(const double a[3], const double b[3], double out[3]) {
    for (int i = 0; i < 3; i++)
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

/* Rx, Ry or Rz */
static void elementary(int axis, double angle, double m[3][3]) {
    const int b = (axis + 1) % 3, c = (axis + 2) % 3;

    memset(m, 0, sizeof(double[3][3]));
    m[axis][axis] = 1;
    m[b][b] = m[c][c] = cos(angle);
    m[b][c] = -sin(angle);
    m[c][b] = sin(angle);
}

static void multiply(double a[3][3], double b[3][3], double out[3][3]) {
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            out[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j];
}

/* the product of the three elementary rotations, written from left to right */
static void product_of(gough_order order, const double angle[3], double R[3][3]) {
    double part[3][3][3], half[3][3];

    for (int a = 0; a < 3; a++) elementary(a, angle[a], part[a]);
    multiply(order == GOUGH_ZYX ? part[2] : part[0], part[1], half);
    multiply(half, order == GOUGH_ZYX ? part[0] : part[2], R);
}

static void two_loads(gough_external load[2]) {
    static const char *const text[2][6] = {{"3 - t", "0.4*t", "2", "0.1", "0", "0.2*t"},
                                           {"-1", "0.5*sin(t)", "0.3", "0", "0.05*t", "-0.2"}};

    for (int n = 0; n < 2; n++) {
        load[n] = (gough_external){.at = {0.2, -0.1 + n, 0.3}, .at_given = true, .turns = n == 1};
        for (int c = 0; c < 3; c++) {
            set_formula(&load[n].force[c], text[n][c]);
            set_formula(&load[n].moment[c], text[n][3 + c]);
        }
    }
}

/* the same in a pose, point by point: force at the centre of mass, moment about it */
static void sum_of_points(const gough_machine *m, const gough_state *state, double t,
                          double force[3], double moment[3]) {
    memset(force, 0, sizeof(double[3]));
    memset(moment, 0, sizeof(double[3]));
    for (size_t n = 0; n < m->externals; n++) {
        const gough_external *e = &m->external[n];
        double given[6], arm[3] = {0, 0, 0}, f[3] = {0, 0, 0}, couple[3] = {0, 0, 0}, turn[3];
        for (int c = 0; c < 6; c++) {
            double jet[3];
            gough_formula_evaluate(c < 3 ? &e->force[c] : &e->moment[c - 3], t, jet);
            given[c] = jet[0];
        }
        for (int r = 0; r < 3; r++) {
            for (int c = 0; c < 3; c++) {
                const double R = state->rotation[r][c], axis = e->turns ? R : r == c ? 1 : 0;
                if (e->at_given) arm[r] += R * (e->at[c] - m->load.center_of_mass[c]);
                f[r] += axis * given[c];
                couple[r] += axis * given[3 + c];
            }
        }
        cross_to(arm, f, turn);
        for (int r = 0; r < 3; r++) force[r] += f[r], moment[r] += turn[r] + couple[r];
    }
}

static gough_model *new_model(gough_external load[2]) {
    gough_model *model = calloc(1, sizeof *model);

    ck_assert(model != NULL);
    skew_machine(&model->machine);
    set_all_axes(model);
    two_loads(load);
    ck_assert(gough_machine_set_external(&model->machine, load, 2, NULL) == GOUGH_OK);
    model->control.feedforward = true;
    set_gains(model, 30, 2);
    return model;
}

START_TEST(wrench_is_that_of_points) {
    static gough_external load[2];
    gough_model *model = new_model(load);
    dice d = {5};

    for (int k = 0; k < 100; k++) {
        const double t = dice_between(&d, 0, 5);
        double force[3], moment[3], angle[3];
        gough_state state = gough_state_home(&model->machine);
        gough_wrench w;
        for (int c = 0; c < 3; c++) {
            state.position[c] += dice_between(&d, -1, 1);
            angle[c] = dice_between(&d, -3, 3);
        }
        product_of(GOUGH_ZYX, angle, state.rotation);
        sum_of_points(&model->machine, &state, t, force, moment);
        ck_assert(gough_external_wrench(&model->machine, &state, t, &w) == GOUGH_OK);
        for (int c = 0; c < 3; c++) {
            near(w.force[c], force[c], 1e-13, "force");
            near(w.moment[c], moment[c], 1e-13, "moment");
        }
    }
    free(model);
}
END_TEST

START_TEST(order_is_that_of_the_factors) {
    static const gough_order order[2] = {GOUGH_ZYX, GOUGH_XYZ};
    dice d = {6};

    for (int k = 0; k < 200; k++) {
        const double angle[3] = {dice_between(&d, -3, 3), dice_between(&d, -1.5, 1.5),
                                 dice_between(&d, -3, 3)};
        for (int o = 0; o < 2; o++) {
            double R[3][3], right[3][3], back[3];
            product_of(order[o], angle, right);
            gough_rotation_in_order(order[o], angle, R);
            ck_assert(gough_angles_in_order(order[o], R, back) == GOUGH_OK);
            for (int i = 0; i < 9; i++) near(R[i / 3][i % 3], right[i / 3][i % 3], 1e-15, "R");
            for (int a = 0; a < 3; a++) near(back[a], angle[a], 1e-12, "angle");
        }
    }
}
END_TEST

/* the rows of a run, and the last of them */
typedef struct {
    gough_row last;
    int rows;
    double worst[3]; /* of what a test compares */
    const gough_model *model;
} watch;

/* forces of a row against inverse dynamics with the sum of points; its angles against the program's rotation */
static int compare(void *context, const gough_row *row) {
    watch *w = context;
    const gough_machine *m = &w->model->machine;
    const double t = row->value[GOUGH_T];
    double force[GOUGH_LEGS], R[3][3];
    gough_acceleration a;
    gough_wrench known;
    gough_state state;

    gough_program(m, &w->model->motion, t, &state, &a);
    sum_of_points(m, &state, t, known.force, known.moment);
    ck_assert(gough_inverse_dynamics(m, &state, &a, &known, force, NULL) == GOUGH_OK);
    for (int v = 0; v < GOUGH_LEGS; v++)
        w->worst[0] = fmax(w->worst[0], fabs(force[v] - row->value[GOUGH_F + v]));
    product_of(w->model->motion.order, row->value + GOUGH_ROLL_ANGLE, R);
    for (int i = 0; i < 9; i++)
        w->worst[1] = fmax(w->worst[1], fabs(R[i / 3][i % 3] - state.rotation[i / 3][i % 3]));
    w->last = *row;
    w->rows++;
    return 0;
}

static int keep_last(void *context, const gough_row *row) {
    ((watch *)context)->last = *row;
    return 0;
}

START_TEST(program_forces_carry_the_loads) {
    static gough_external load[2];
    gough_model *model = new_model(load);
    gough_simulation s = gough_simulation_default();
    gough_end end;

    s.duration = 5;
    for (int order = 0; order < 2; order++) {
        watch w = {.model = model};
        model->motion.order = order ? GOUGH_XYZ : GOUGH_ZYX;
        ck_assert(gough_forces(model, &s, compare, &w, NULL, NULL, &end, NULL) == GOUGH_OK);
        ck_assert_int_eq(w.rows, 101);
        near(w.worst[0], 0, 1e-12, "forces of legs");
        near(w.worst[1], 0, 1e-14, "rotation of a row");
    }
    free(model);
}
END_TEST

/* each leg of a symmetric machine bears (M g − 30) l/(6h) */
START_TEST(support_takes_weight_off_the_legs) {
    gough_platform p = gough_platform_symmetric(0.25, 10 * pi / 180, 0.15, 10 * pi / 180, 0.28);
    const gough_load body = {.mass = 6,
                             .center_of_mass = {0, 0, 0.05},
                             .inertia = {{0.05, 0, 0}, {0, 0.05, 0}, {0, 0, 0.08}}};
    const double gravity[3] = {0, 0, -9.80665};
    gough_model *model = calloc(1, sizeof *model);
    gough_external up = {.at_given = false};
    gough_simulation s = gough_simulation_default();
    watch w = {.rows = 0};
    gough_end end;

    ck_assert(gough_machine_init(&model->machine, &p, &body, gravity, NULL) == GOUGH_OK);
    set_formula(&up.force[2], "30");
    ck_assert(gough_machine_set_external(&model->machine, &up, 1, NULL) == GOUGH_OK);
    s.duration = 0.1;
    ck_assert(gough_forces(model, &s, keep_last, &w, NULL, NULL, &end, NULL) == GOUGH_OK);
    for (int v = 0; v < GOUGH_LEGS; v++) {
        const double l = model->machine.home_length[v];
        const double right = (6 * 9.80665 - 30) * l / (6 * 0.28);
        near(w.last.value[GOUGH_F + v], right, 1e-12 * right, "force at rest");
    }
    free(model);
}
END_TEST

/* F^p that knows the loads keeps the program, by every kind of stepper and in both precisions */
START_TEST(known_loads_leave_the_motion_on_its_program) {
    static const struct {
        gough_method method;
        gough_precision precision;
        double step, tolerance, deviation;
    } way[] = {{GOUGH_DOP853, GOUGH_DOUBLE, 0, 1e-12, 1e-9},
               {GOUGH_RK4, GOUGH_DOUBLE, 0.0025, 1e-10, 1e-9},
               {GOUGH_RATTLE6, GOUGH_DOUBLE, 0.01, 1e-10, 1e-9},
               {GOUGH_DOP853, GOUGH_QUADRUPLE, 0, 1e-16, 1e-14}};
    static gough_external load[2];
    gough_model *model = new_model(load);

    for (size_t i = 0; i < sizeof way / sizeof way[0]; i++) {
        gough_simulation s = gough_simulation_default();
        gough_summary summary;
        gough_end end;
        s.duration = 2;
        s.method = way[i].method;
        s.precision = way[i].precision;
        s.step = way[i].step;
        s.tolerance = way[i].tolerance;
        s.summary = &summary;
        ck_assert(gough_simulate(model, &s, NULL, NULL, &end, NULL) == GOUGH_OK);
        near(summary.position_deviation, 0, way[i].deviation, gough_method_name((int)s.method));
    }
    model->control.ignores_external = true;
    gough_simulation s = gough_simulation_default();
    gough_summary summary;
    gough_end end;
    s.duration = 2;
    s.summary = &summary;
    ck_assert(gough_simulate(model, &s, NULL, NULL, &end, NULL) == GOUGH_OK);
    ck_assert(summary.position_deviation > 0.01);
    free(model);
}
END_TEST

/* T + V of the load in a row */
static double energy_of(const gough_model *model, const double *value) {
    const gough_load *b = &model->machine.load;
    const double *omega = value + GOUGH_WX;
    double R[3][3], arm[3], spin[3], energy = 0, own[3];

    product_of(model->motion.order, value + GOUGH_ROLL_ANGLE, R);
    for (int r = 0; r < 3; r++) {
        arm[r] = own[r] = 0;
        for (int c = 0; c < 3; c++) {
            arm[r] += R[r][c] * b->center_of_mass[c];
            own[r] += R[c][r] * omega[c];
        }
    }
    cross_to(omega, arm, spin);
    for (int r = 0; r < 3; r++) {
        const double v = value[GOUGH_VX + r] + spin[r];
        energy += 0.5 * b->mass * v * v -
                  b->mass * model->machine.gravity[r] * (value[GOUGH_X + r] + arm[r]);
        for (int c = 0; c < 3; c++) energy += 0.5 * own[r] * b->inertia[r][c] * own[c];
    }
    return energy;
}

typedef struct {
    const gough_model *model;
    double first, last;
    int rows;
} balance;

static int weigh(void *context, const gough_row *row) {
    balance *b = context;
    b->last = energy_of(b->model, row->value);
    if (b->rows++ == 0) b->first = b->last;
    return 0;
}

/* the work of legs and of external loads is the change of the load's energy, whether the controller knows the loads or not */
START_TEST(energy_is_the_work_of_legs_and_loads) {
    static gough_external load[2];
    gough_model *model = new_model(load);

    for (int way = 0; way < 3; way++) {
        gough_simulation s = gough_simulation_default();
        gough_summary summary;
        gough_end end;
        balance b = {.model = model};
        double work = 0;
        s.duration = 1.7;
        s.output_step = 0.1;
        s.summary = &summary;
        model->motion.order = way == 1 ? GOUGH_XYZ : GOUGH_ZYX;
        model->control.ignores_external = way == 2;
        const gough_status status = way == 0
                                        ? gough_forces(model, &s, weigh, &b, NULL, NULL, &end, NULL)
                                        : gough_simulate(model, &s, weigh, &b, &end, NULL);
        ck_assert(status == GOUGH_OK);
        for (int v = 0; v < GOUGH_LEGS; v++) work += summary.leg[v].energy;
        ck_assert(fabs(summary.external_work) > 0.01);
        near(work + summary.external_work, b.last - b.first, 1e-7, "energy");
    }
    free(model);
}
END_TEST

/* runs in lanes are those of gough_simulate(), to the last bit, with loads of one list and of several */
START_TEST(lanes_are_single_runs) {
    enum { RUNS = 5 };
    static gough_external load[RUNS][2];
    static gough_machine machine[RUNS];
    gough_model *model = new_model(load[0]);
    gough_batch_run run[RUNS];
    gough_outcome out[RUNS];
    gough_batch_options options = gough_batch_options_default();
    gough_simulation s = gough_simulation_default();
    void *memory;

    options.threads = 1;
    memory = aligned_alloc(64, (gough_batch_size(&options) + 63) / 64 * 64);
    s.duration = 1;
    s.method = GOUGH_RK4;
    s.step = 0.01;
    for (int same = 0; same < 2; same++) {
        for (int i = 0; i < RUNS; i++) {
            two_loads(load[i]);
            machine[i] = model->machine;
            if (!same) load[i][0].force[2] = gough_formula_constant(2 + i), load[i][1].at[0] += i;
            gough_machine_set_external(&machine[i], load[same ? 0 : i], 2, NULL);
            run[i] = (gough_batch_run){
                &machine[i], &model->control, &model->disturbance, &model->initial, 0, 0};
        }
        ck_assert(gough_batch(&model->motion, &s, run, RUNS, &options, out, memory, NULL) ==
                  GOUGH_OK);
        for (int i = 0; i < RUNS; i++) {
            watch w = {.rows = 0};
            gough_end end;
            model->machine = machine[i];
            ck_assert(gough_simulate(model, &s, keep_last, &w, &end, NULL) == GOUGH_OK);
            for (int c = 0; c < 3; c++) {
                ck_assert(out[i].position[c] == w.last.value[GOUGH_X + c]);
                ck_assert(out[i].angles[c] == w.last.value[GOUGH_ROLL_ANGLE + c]);
            }
        }
    }
    load[1][0].turns = true;
    gough_machine_set_external(&machine[1], load[1], 2, NULL);
    ck_assert(gough_batch(&model->motion, &s, run, RUNS, &options, out, memory, NULL) ==
              GOUGH_ERROR_INPUT);
    free(memory);
    free(model);
}
END_TEST

/* a gust of a thousandth of a unit of time is met: its peak by forces, its momentum by simulate */
START_TEST(gust_is_not_stepped_over) {
    gough_model *model = calloc(1, sizeof *model);
    gough_external gust = {.at_given = false};
    gough_simulation s = gough_simulation_default();
    gough_summary summary;
    gough_end end;
    watch w = {.rows = 0};

    paper_machine(&model->machine);
    set_formula(&gust.force[2], "100*exp(-((t - 7.3217)/0.001)^2)");
    ck_assert(gough_machine_set_external(&model->machine, &gust, 1, NULL) == GOUGH_OK);
    model->control.feedforward = true;
    s.duration = 10;
    s.output_step = 0.1;
    s.summary = &summary;
    ck_assert(gough_forces(model, &s, NULL, NULL, NULL, NULL, &end, NULL) == GOUGH_OK);
    const double l = model->machine.home_length[0];
    near(summary.leg[0].force_min, (1 - 100) * l / 6, 1e-4, "force at the peak");

    set_gains(model, 1000, 0);
    model->control.ignores_external = true;
    s.duration = 7.33;
    s.output_step = 0.01;
    s.summary = NULL;
    ck_assert(gough_simulate(model, &s, keep_last, &w, &end, NULL) == GOUGH_OK);
    ck_assert(w.last.value[GOUGH_VZ] > 0.1 && w.last.value[GOUGH_VZ] < 0.2);
    free(model);
}
END_TEST

START_TEST(wrong_loads_are_refused) {
    static gough_external load[GOUGH_EXTERNALS + 1];
    gough_machine machine;
    gough_error error;

    paper_machine(&machine);
    ck_assert(gough_machine_set_external(&machine, load, GOUGH_EXTERNALS + 1, &error) ==
              GOUGH_ERROR_INPUT);
    ck_assert_str_eq(error.key, "external");
    load[2].at[1] = NAN;
    ck_assert(gough_machine_set_external(&machine, load, 3, &error) == GOUGH_OK);
    load[2].at_given = true;
    ck_assert(gough_machine_set_external(&machine, load, 3, &error) == GOUGH_ERROR_INPUT);
    ck_assert_str_eq(error.key, "external.3.at");
    ck_assert(machine.externals == 3);
}
END_TEST

int main(void) {
    return SUITE_RUN("external", 20, wrench_is_that_of_points, order_is_that_of_the_factors,
                     program_forces_carry_the_loads, support_takes_weight_off_the_legs,
                     known_loads_leave_the_motion_on_its_program,
                     energy_is_the_work_of_legs_and_loads, lanes_are_single_runs,
                     gust_is_not_stepped_over, wrong_loads_are_refused);
}
