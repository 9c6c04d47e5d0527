/* What a study states is met, however short: pulses of a hundredth of an output step after a long rest, in every kind of
 * disturbance and program, at random times, against runs of small fixed steps; corners end a step.
 * Not sanitized: it would take two minutes, and run/ends and batch/batch run the same texts.
 * Label: standard. */
#include <stdio.h>

#include "gough/batch.h"
#include "support/machines.h"
#include "support/suite.h"

/* of the runs: the pulse is a hundredth of `rows` wide at half its height */
static const double rows = 0.02, width = 0.0002, duration = 0.6;

enum { ROWS = 6001 }; /* of a record */
typedef struct {
    gough_model model;
    gough_move move[2];
    double time[ROWS], value[ROWS * GOUGH_COMPONENTS], curvature[ROWS * GOUGH_COMPONENTS];
    double scratch[2 * ROWS];
} fixture;

static void own_machine(gough_machine *machine, double weight) {
    const double gravity[3] = {0, 0, -9.80665 * weight};
    gough_platform p = gough_platform_symmetric(0.25, 10 * pi / 180, 0.15, 10 * pi / 180, 0.28);
    gough_load load = {.mass = 6,
                       .center_of_mass = {0, 0, 0.05},
                       .inertia = {{0.05, 0, 0}, {0, 0.05, 0}, {0, 0, 0.08}}};

    ck_assert_int_eq(gough_machine_init(machine, &p, &load, gravity, NULL), GOUGH_OK);
}

static void print_into(gough_formula *f, const char *format, double a, double b) {
    char text[200];

    snprintf(text, sizeof text, format, a, b);
    set_formula(f, text);
}

/* half of e^(-x²) is reached at x = ±√(ln 2) */
#define GAUSSIAN "*exp(-((t - %.17g)/%.17g)^2)"
static double gaussian(void) { return width / 2 / sqrt(log(2)); }

/* a record that rests but for one row near `at` */
static void record_bump(fixture *f, double at) {
    const double step = width / 1.2; /* of a spline through one row that differs */

    for (int k = 0; k < ROWS; k++) f->time[k] = k * step;
    f->value[lround(at / step) * GOUGH_COMPONENTS + GOUGH_HEAVE] = 0.01;
    f->model.motion.kind = GOUGH_MOTION_SAMPLES;
    f->model.motion.samples = (gough_samples){
        .count = ROWS, .time = f->time, .value = f->value, .curvature = f->curvature};
    ck_assert_uint_le(gough_samples_scratch(ROWS), 2 * ROWS);
    ck_assert_int_eq(gough_samples_prepare(&f->model.motion.samples, f->scratch, NULL), GOUGH_OK);
}

enum { KINDS = 10 };

/* Forces are not fed forward for programs, and gravity is 0: the platform is pulled after a bump by the feedback alone,
 * which misses all of it if it is stepped over. */
static fixture *with_pulse(int kind, double at) {
    fixture *f = calloc(1, sizeof *f);
    gough_disturbance *d = &f->model.disturbance;
    gough_motion *m = &f->model.motion;
    const double w = gaussian();

    own_machine(&f->model.machine, kind < 6 ? 1 : 0);
    set_gains(&f->model, 1000, 20);
    f->model.control.feedforward = kind < 6;
    switch (kind) {
    case 0:
        print_into(&d->force[0], "500*(ramp(t - %.17g, 1e-4) - ramp(t - %.17g, 1e-4))", at,
                   at + width);
        break;
    case 1:
        print_into(&d->force[1], "500" GAUSSIAN, at, w);
        break;
    case 2:
        print_into(&d->moment[2], "50" GAUSSIAN, at, w);
        break;
    case 3:
        print_into(&d->leg_force[3], "500" GAUSSIAN, at, w);
        break;
    case 4:
        print_into(&d->vertical_force, "500" GAUSSIAN, at, w);
        break;
    case 5:
        print_into(&d->force[2], "3*sin(9*t) + 500/(1 + ((t - %.17g)/%.17g)^4)", at, width / 2);
        break;
    case 6:
        print_into(&m->formula[GOUGH_HEAVE], "0.01" GAUSSIAN, at, w);
        break;
    case 7:
        print_into(&m->formula[GOUGH_YAW], "0.1*(1 - tanh((t - %.17g)/%.17g)^2)", at, width / 1.76);
        break;
    case 8:
        f->move[0] = (gough_move){.start = at, .duration = width, .target = {0.01, 0, 0}};
        f->move[1] = (gough_move){.start = at + width, .duration = width};
        f->move[0].given[0] = f->move[1].given[0] = true;
        *m = (gough_motion){.kind = GOUGH_MOTION_MOVES, .move = f->move, .moves = 2};
        break;
    default:
        record_bump(f, at);
    }
    return f;
}

/* what a run leaves: the largest distance from home at rows, and where it ends */
typedef struct {
    double deviation, end[6], home[3];
    int rows;
} traced;

static int trace(void *context, const gough_row *row) {
    traced *t = context;
    double sum = 0;

    if (t->rows++ == 0) memcpy(t->home, row->value + GOUGH_X, sizeof t->home);
    for (int c = 0; c < 3; c++) {
        const double away = row->value[GOUGH_X + c] - t->home[c];
        sum += away * away;
    }
    for (int c = GOUGH_ROLL_ANGLE; c <= GOUGH_YAW_ANGLE; c++) {
        sum += 0.0225 * row->value[c] * row->value[c];
    }
    t->deviation = fmax(t->deviation, sqrt(sum));
    memcpy(t->end, row->value + GOUGH_X, sizeof t->end);
    return 0;
}

static traced run(const gough_model *model, const gough_simulation *options) {
    traced t = {.rows = 0};
    gough_error error = {0};
    gough_end end;

    ck_assert_msg(gough_simulate(model, options, trace, &t, &end, &error) == GOUGH_OK, "%s",
                  error.message);
    return t;
}

static gough_simulation options_of(gough_method method, double step) {
    gough_simulation o = gough_simulation_default();

    o.duration = duration;
    o.output_step = rows;
    o.method = method;
    o.step = step;
    return o;
}

static void near_the_reference(double deviation, double reference, int kind, double at) {
    ck_assert_msg(fabs(deviation - reference) <= 1e-3 * reference,
                  "kind %d at %.17g: %.9g instead of %.9g", kind, at, deviation, reference);
}

/* 22 places for each of nine kinds, six for records, whose reference is slow; at first nothing moves (but in kind 5), so
 * steps grow long */
START_TEST(a_pulse_is_met_wherever_it_is) {
    static const gough_method fixed[3] = {GOUGH_RK4, GOUGH_DOP853, GOUGH_RATTLE4};
    dice d = {100 + (unsigned)_i};

    const int recorded = _i == KINDS - 1;
    for (int n = 0; n < (recorded ? 6 : 22); n++) {
        const double at = dice_between(&d, 0.1, 0.5);
        fixture *f = with_pulse(_i, at);
        const gough_simulation small = options_of(GOUGH_DOP853, rows / (recorded ? 2000 : 400));
        const double reference = run(&f->model, &small).deviation;
        gough_simulation o = options_of(GOUGH_DOP853, 0);
        ck_assert(reference > 0);
        near_the_reference(run(&f->model, &o).deviation, reference, _i, at);
        o = options_of(fixed[n % 3], rows / (n % 2 ? 8 : 10));
        near_the_reference(run(&f->model, &o).deviation, reference, _i, at);
        free(f);
    }
}
END_TEST

/* rows far apart cost no steps, and hide nothing: the state at the end tells */
START_TEST(a_pulse_is_met_between_rows_far_apart) {
    for (int kind = 0; kind < KINDS; kind++) {
        fixture *f = with_pulse(kind, 0.347);
        gough_simulation o = options_of(GOUGH_DOP853, 0), small = options_of(GOUGH_DOP853, 1e-5);
        o.tolerance = 1e-9;
        small.output_step = o.output_step = 0.05;
        small.duration = o.duration = 0.5;
        const traced a = run(&f->model, &o), b = run(&f->model, &small);
        near_the_reference(a.deviation, b.deviation, kind, 0.347);
        free(f);
    }
}
END_TEST

START_TEST(lanes_meet_it_with_the_same_bits) {
    enum { RUNS = 9 };
    for (int kind = 0; kind < KINDS; kind++) {
        fixture *f = with_pulse(kind, 0.2345678);
        const gough_simulation o = options_of(kind % 2 ? GOUGH_RK4 : GOUGH_RATTLE4, rows / 4);
        gough_control control[RUNS];
        gough_batch_run runs[RUNS];
        gough_outcome out[RUNS];
        for (int i = 0; i < RUNS; i++) {
            control[i] = f->model.control;
            for (int v = 0; v < GOUGH_LEGS; v++) control[i].stiffness[v] += 100 * i;
            runs[i] = (gough_batch_run){&f->model.machine, &control[i], &f->model.disturbance,
                                        &f->model.initial, 0,           0};
        }
        for (int lanes = 1; lanes <= gough_batch_lanes(); lanes *= 2) {
            gough_batch_options options = gough_batch_options_default();
            options.lanes = lanes;
            options.threads = 1;
            void *memory = aligned_alloc(64, (gough_batch_size(&options) + 63) / 64 * 64);
            ck_assert_int_eq(
                gough_batch(&f->model.motion, &o, runs, RUNS, &options, out, memory, NULL),
                GOUGH_OK);
            free(memory);
            for (int i = 0; i < RUNS; i++) {
                f->model.control = control[i];
                const traced alone = run(&f->model, &o);
                ck_assert_msg(memcmp(out[i].position, alone.end, sizeof out[i].position) == 0,
                              "kind %d, %d lanes, run %d", kind, lanes, i);
            }
        }
        free(f);
    }
}
END_TEST

/* runs whose disturbances have pulses at different times are no company for each other */
START_TEST(a_batch_meets_the_pulse_of_each_run) {
    enum { RUNS = 5 };
    static fixture *f[RUNS];
    gough_batch_run runs[RUNS];
    gough_outcome out[RUNS];
    gough_batch_options options = gough_batch_options_default();
    const gough_simulation o = options_of(GOUGH_RK4, rows);

    for (int i = 0; i < RUNS; i++) {
        f[i] = with_pulse(i < 3 ? 1 : 0, 0.15 + 0.0712 * i);
        runs[i] = (gough_batch_run){&f[i]->model.machine,
                                    &f[i]->model.control,
                                    &f[i]->model.disturbance,
                                    &f[i]->model.initial,
                                    0,
                                    0};
    }
    void *memory = aligned_alloc(64, (gough_batch_size(&options) + 63) / 64 * 64);
    ck_assert_int_eq(gough_batch(&f[0]->model.motion, &o, runs, RUNS, &options, out, memory, NULL),
                     GOUGH_OK);
    free(memory);
    for (int i = 0; i < RUNS; i++) {
        const traced alone = run(&f[i]->model, &o);
        ck_assert(out[i].position_deviation > 1e-6);
        ck_assert_msg(memcmp(out[i].position, alone.end, sizeof out[i].position) == 0, "run %d", i);
        free(f[i]);
    }
}
END_TEST

/* Two ramps whose ends lie off the grid of steps: their third derivative jumps there, which would leave a method of order 8 with
 * order 4. In 33 digits. */
START_TEST(a_corner_within_a_step_costs_no_order) {
    static const gough_method methods[3] = {GOUGH_DOP853, GOUGH_RK4, GOUGH_RATTLE4};
    static const double order[3] = {8, 4, 4};
    gough_model *model = calloc(1, sizeof *model);

    skew_machine(&model->machine);
    set_gains(model, 30, 2);
    model->control.feedforward = true;
    set_formula(&model->disturbance.force[0], "2*ramp(t - 0.0437, 0.8)");
    set_formula(&model->motion.formula[GOUGH_HEAVE], "0.1*ramp(t - 0.0437, 0.9)");
    gough_simulation o = options_of(methods[_i], 0.05);
    double error[2];
    traced fine;
    o.precision = GOUGH_QUADRUPLE;
    o.output_step = 0.1;
    o.duration = 0.8; /* the ramps end later: they are not cut into parts besides */
    gough_simulation finest = o;
    finest.method = GOUGH_DOP853;
    finest.step = 0.0125;
    fine = run(model, &finest);
    for (int k = 0; k < 2; k++) {
        o.step = k == 0 ? 0.1 : 0.05;
        const traced t = run(model, &o);
        error[k] = 0;
        for (int c = 0; c < 6; c++) error[k] += fabs(t.end[c] - fine.end[c]);
    }
    const double found = log2(error[0] / error[1]);
    ck_assert_msg(found >= order[_i] - 0.9, "%s has order %.3f: %g %g",
                  gough_method_name((int)methods[_i]), found, error[0], error[1]);
    free(model);
}
END_TEST

/* the number of evaluations is not to be had here; but where steps are short, their error is small */
START_TEST(the_longest_step_is_kept) {
    gough_model *model = calloc(1, sizeof *model);
    gough_simulation o = options_of(GOUGH_DOP853, 0);
    gough_error error = {0};

    skew_machine(&model->machine);
    set_gains(model, 30, 2);
    model->control.feedforward = true;
    set_all_axes(model);
    set_formula(&model->disturbance.force[0], "0.5*sin(7*t)");
    const gough_simulation small = options_of(GOUGH_DOP853, rows / 20);
    o.tolerance = 1e-2;
    const traced reference = run(model, &small), rough = run(model, &o);
    o.max_step = rows;
    const traced limited = run(model, &o);
    double far = 0, near = 0;
    for (int c = 0; c < 6; c++) {
        far += fabs(rough.end[c] - reference.end[c]);
        near += fabs(limited.end[c] - reference.end[c]);
    }
    ck_assert_msg(near <= 1e-3 * far && near <= 1e-9, "%g %g", near, far);

    o.method = GOUGH_RK4;
    o.step = 2 * rows;
    o.output_step = 2 * rows;
    ck_assert_int_eq(gough_simulation_check(model, &o, &error), GOUGH_ERROR_INPUT);
    ck_assert_ptr_nonnull(strstr(error.message, "max_step"));
    o.max_step = -1;
    ck_assert_int_eq(gough_simulation_check(model, &o, &error), GOUGH_ERROR_INPUT);
    o.max_step = NAN;
    ck_assert_int_eq(gough_simulation_check(model, &o, &error), GOUGH_ERROR_INPUT);
    free(model);
}
END_TEST

/* A step that does not divide the duration is followed by a shorter one: what happens in it is found, and the work done up to
 * the duration is that of an adaptive run. */
START_TEST(a_fixed_step_goes_on_to_the_duration) {
    gough_model *model = calloc(1, sizeof *model);
    gough_simulation o = options_of(GOUGH_RK4, 0.01), adaptive;
    gough_summary sum, wanted;
    gough_error error = {0};
    gough_end end;

    skew_machine(&model->machine);
    set_gains(model, 30, 2);
    model->control.feedforward = true;
    set_all_axes(model);
    o.output_step = 0.5;
    o.duration = 1.0083;
    adaptive = options_of(GOUGH_DOP853, 0);
    adaptive.output_step = 0.5;
    adaptive.duration = o.duration;
    o.summary = &sum;
    adaptive.summary = &wanted;
    ck_assert_int_eq(gough_simulate(model, &o, NULL, NULL, &end, &error), GOUGH_OK);
    ck_assert_int_eq(gough_simulate(model, &adaptive, NULL, NULL, &end, &error), GOUGH_OK);
    for (int v = 0; v < GOUGH_LEGS; v++) {
        ck_assert_double_eq_tol(sum.leg[v].energy, wanted.leg[v].energy, 2e-6);
    }

    /* a leg gets too long 3 ms before the end, after the last whole step */
    print_into(&model->disturbance.force[2], "1e3*ramp(t - %.17g, %.17g)", 1.0005, 1e-4);
    model->machine.platform.length_max = wanted.leg[0].length_max;
    for (int v = 1; v < GOUGH_LEGS; v++) {
        model->machine.platform.length_max =
            fmax(model->machine.platform.length_max, wanted.leg[v].length_max);
    }
    ck_assert_int_eq(gough_simulate(model, &adaptive, NULL, NULL, &end, &error),
                     GOUGH_ERROR_NUMERICAL);
    const gough_end alike = end;
    ck_assert_int_eq(alike.cause, GOUGH_END_LEG_LONG);
    ck_assert(alike.time > 1.0005 && alike.time < o.duration);
    o.step = 0.02;
    ck_assert_int_eq(gough_simulate(model, &o, NULL, NULL, &end, &error), GOUGH_ERROR_NUMERICAL);
    ck_assert_int_eq(end.cause, alike.cause);
    ck_assert_int_eq(end.leg, alike.leg);
    ck_assert_double_eq_tol(end.time, alike.time, 1e-4);
    free(model);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("events");
    TCase *cases = tcase_create("events");
    SRunner *runner;

    tcase_set_timeout(cases, 600);
    tcase_add_loop_test(cases, a_pulse_is_met_wherever_it_is, 0, KINDS);
    tcase_add_loop_test(cases, a_corner_within_a_step_costs_no_order, 0, 3);
    tcase_add_test(cases, a_pulse_is_met_between_rows_far_apart);
    tcase_add_test(cases, lanes_meet_it_with_the_same_bits);
    tcase_add_test(cases, a_batch_meets_the_pulse_of_each_run);
    tcase_add_test(cases, the_longest_step_is_kept);
    tcase_add_test(cases, a_fixed_step_goes_on_to_the_duration);
    suite_add_tcase(suite, cases);
    runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
