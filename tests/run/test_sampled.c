/* Sampled loops: towards the continuous one as the period falls, the same numbers by the caller's own law, by a plant that the
 * caller steps, and by one sample at a time; rows, limits of drives and the summary of motion under commands that jump. */
#include <stdlib.h>

#include "gough/gough.h"
#include "support/machines.h"
#include "support/suite.h"

typedef struct {
    double value[GOUGH_COLUMNS];
} last_row;

static int keep(void *context, const gough_row *row) {
    memcpy(context, row->value, sizeof row->value);
    return 0;
}

static gough_model *model_of(double stiffness, double damping) {
    gough_model *model = calloc(1, sizeof *model);

    skew_machine(&model->machine);
    model->control.feedforward = true;
    set_gains(model, stiffness, damping);
    set_all_axes(model);
    set_formula(&model->disturbance.leg_force[1], "0.1*sin(2*t)");
    set_formula(&model->disturbance.moment[2], "0.05*sin(3*t)");
    model->initial.component[GOUGH_HEAVE] = 0.02;
    model->initial.given[GOUGH_HEAVE] = true;
    return model;
}

static gough_simulation fixed(gough_method method, double step) {
    gough_simulation s = gough_simulation_default();

    s.method = method;
    s.step = step;
    s.duration = 1;
    s.output_step = 0.25;
    s.commands = s.actuators = true;
    return s;
}

static void run(const gough_model *model, const gough_simulation *s, last_row *last) {
    gough_error error = {0};
    gough_end end;

    ck_assert_msg(gough_simulate(model, s, keep, last, &end, &error) == GOUGH_OK, "%s%s",
                  error.message, end.message);
}

static void machine_again(gough_model *model, const gough_platform *p) {
    const gough_load load = model->machine.load;
    const double g[3] = {model->machine.gravity[0], model->machine.gravity[1],
                         model->machine.gravity[2]};
    gough_error error = {0};

    ck_assert_msg(gough_machine_init(&model->machine, p, &load, g, &error) == GOUGH_OK, "%s",
                  error.message);
}

static double distance(const last_row *a, const last_row *b) {
    double worst = 0;

    for (int c = GOUGH_X; c <= GOUGH_WZ; c++) {
        const double d = fabs(a->value[c] - b->value[c]);
        ck_assert(isfinite(d));
        worst = fmax(worst, d);
    }
    return worst;
}

/* with T the distance from the continuous run falls like T, by measured rates and by differences */
START_TEST(a_short_period_is_nearly_continuous) {
    for (int velocity = 0; velocity < GOUGH_VELOCITIES; velocity++) {
        gough_model *model = model_of(20, 2);
        gough_simulation s = fixed(GOUGH_DOP853, 0);
        double before = 0;
        last_row right, row;

        s.tolerance = 1e-12;
        run(model, &s, &right);
        for (int k = 0; k < 5; k++) {
            model->control.sampling = (gough_sampling){.period = 0.008 / (1 << k),
                                                       .delay = 0.004 / (1 << k),
                                                       .velocity = (gough_velocity)velocity};
            run(model, &s, &row);
            const double d = distance(&row, &right), order = log2(before / d);
            printf("T = %.6f: %.3e, order %.3f\n", model->control.sampling.period, d, order);
            if (k > 2) ck_assert_msg(fabs(order - 1) < 0.05, "order %g", order);
            before = d;
        }
        ck_assert_double_lt(before, 1e-3);
        free(model);
    }
}
END_TEST

/* one sample at a time, with the memory of the caller */
typedef struct {
    const gough_model *model;
    gough_control_memory memory;
    double command[64][GOUGH_LEGS];
    int samples, differ;
} own_law;

static void sampled_law(void *context, const gough_sample *sample, double command[GOUGH_LEGS]) {
    own_law *own = context;
    double mine[GOUGH_LEGS];

    ck_assert_int_eq((int)sample->number, own->samples);
    ck_assert_double_eq_tol(sample->time, 0.05 * own->samples, 1e-12);
    gough_control_sample(&own->model->control, &own->model->machine.platform.actuators,
                         &own->memory, sample->program_force, sample->program_length,
                         sample->program_rate, sample->length, sample->rate, mine);
    for (int v = 0; v < GOUGH_LEGS; v++) {
        const double *most = own->model->machine.platform.actuators.max_force[v];
        const double limited = fmin(fmax(command[v], most[0]), most[1]);
        own->differ += memcmp(&limited, &mine[v], sizeof limited) != 0;
    }
    memcpy(own->command[own->samples++], mine, sizeof mine);
}

static gough_model *limited_model(double lag) {
    gough_model *model = model_of(10, 1);
    gough_platform p = model->machine.platform;

    for (int v = 0; v < GOUGH_LEGS; v++) {
        p.actuators.max_force[v][0] = -0.6;
        p.actuators.max_force[v][1] = 0.33;
        p.actuators.time_constant[v] = lag;
        model->control.integral[v] = 4;
        for (int w = 0; w < GOUGH_LEGS; w++)
            if (v != w) model->control.cross_stiffness[v][w] = 0.5 * sin(v + 3 * w);
    }
    if (lag > 0) p.actuators.kind = GOUGH_ACTUATOR_LAG;
    machine_again(model, &p);
    model->control.coupled = true;
    model->control.tracking_time = 0.4;
    model->control.sampling = (gough_sampling){
        .period = 0.05, .velocity = GOUGH_VELOCITY_DIFFERENCE, .cutoff = 4, .resolution = 1e-5};
    return model;
}

START_TEST(the_callers_law_may_be_the_librarys) {
    gough_model *model = limited_model(0);
    gough_simulation s = fixed(GOUGH_RK4, 0.05);
    own_law own = {.model = model};
    last_row alone, called;

    run(model, &s, &alone);
    s.law = sampled_law;
    s.law_context = &own;
    run(model, &s, &called);
    ck_assert_int_eq(own.samples, 21);
    ck_assert_msg(own.differ == 0, "%d of %d commands differ", own.differ,
                  GOUGH_LEGS * own.samples);
    ck_assert(memcmp(&alone.value[GOUGH_X], &called.value[GOUGH_X], 12 * sizeof(double)) == 0);
    free(model);
}
END_TEST

static void push_up(void *context, const gough_sample *sample, double command[GOUGH_LEGS]) {
    (void)sample;
    for (int v = 0; v < GOUGH_LEGS; v++) command[v] += *(const double *)context;
}

START_TEST(the_callers_law_counts) {
    gough_model *model = limited_model(0);
    gough_simulation s = fixed(GOUGH_RK4, 0.05);
    double more = 0.001;
    last_row alone, called;

    run(model, &s, &alone);
    s.law = push_up;
    s.law_context = &more;
    run(model, &s, &called);
    ck_assert_double_gt(called.value[GOUGH_Z], alone.value[GOUGH_Z] + 1e-6);

    gough_error error; /* a continuous controller would never call it */
    gough_end end;
    model->control.sampling = (gough_sampling){.period = 0};
    ck_assert(gough_simulate(model, &s, NULL, NULL, &end, &error) == GOUGH_ERROR_INPUT);
    ck_assert_str_eq(error.key, "control.sampling.period");
    ck_assert(strstr(error.message, "this one is continuous; give a control.sampling.period"));
    free(model);
}
END_TEST

/* the commands of a run, given to a plant: the same bits at the end of each step */
static void record(void *context, const gough_sample *sample, double command[GOUGH_LEGS]) {
    own_law *own = context;
    (void)sample;
    memcpy(own->command[own->samples++], command, sizeof own->command[0]);
}

static void check_plant(gough_method method, double lag) {
    gough_model *model = limited_model(lag);
    gough_simulation s = fixed(method, 0.05);
    own_law own = {.model = model};
    void *plant = aligned_alloc(64, gough_plant_size());
    gough_error error = {0};
    gough_end end;
    gough_row row;
    last_row last;

    s.law = record;
    s.law_context = &own;
    run(model, &s, &last);
    ck_assert_msg(gough_plant_begin(plant, model, &s, NULL, &end, &error) == GOUGH_OK, "%s",
                  error.message);
    for (int k = 0; k < 20; k++) {
        ck_assert_msg(gough_step(plant, own.command[k], &row, &end, &error) == GOUGH_OK, "%s",
                      error.message);
        ck_assert_int_eq(end.cause, GOUGH_END_DONE);
    }
    for (int c = 0; c < GOUGH_COLUMNS; c++) {
        if (!gough_column_filled(c, true, &s) || c == GOUGH_DRIFT) continue;
        if (c >= GOUGH_MEASURED && c <= GOUGH_MEASURED_LAST)
            continue; /* a plant measures nothing */
        ck_assert_msg(memcmp(&row.value[c], &last.value[c], sizeof(double)) == 0,
                      "%s, lag %g: %s of a plant is %.17g, of a run %.17g",
                      gough_method_name((int)method), lag, gough_column(c)->name, row.value[c],
                      last.value[c]);
    }
    free(plant);
    free(model);
}

START_TEST(a_plant_moves_as_a_run) {
    check_plant(GOUGH_RK4, 0);
    check_plant(GOUGH_RK4, 0.03);
    check_plant(GOUGH_DOP853, 0.03);
    check_plant(GOUGH_RATTLE2, 0);
    check_plant(GOUGH_RATTLE8, 0);
}
END_TEST

START_TEST(a_plant_ends_and_refuses) {
    gough_model *model = limited_model(0);
    gough_simulation s = fixed(GOUGH_RK4, 0.05);
    const double none[GOUGH_LEGS] = {0};
    void *plant = aligned_alloc(64, gough_plant_size());
    gough_error error = {0};
    gough_status status = GOUGH_OK;
    gough_row row;
    gough_end end;
    int steps = 0;

    ck_assert_int_eq(gough_plant_begin(plant, model, &s, NULL, &end, &error), GOUGH_OK);
    for (; status == GOUGH_OK && steps < 1000; steps++)
        status = gough_step(plant, none, &row, &end, &error);
    ck_assert_int_eq(status, GOUGH_ERROR_NUMERICAL);
    ck_assert_int_gt(steps, 10);
    ck_assert_int_ne(end.cause, GOUGH_END_DONE);
    ck_assert(end.time > 0.05 * (steps - 1) - 1e-9 && end.time <= 0.05 * steps + 1e-9);
    const gough_end first = end;
    ck_assert_int_eq(gough_step(plant, none, &row, &end, &error), GOUGH_ERROR_NUMERICAL);
    ck_assert(memcmp(&first.time, &end.time, sizeof end.time) == 0);

    s.step = 0;
    s.method = GOUGH_DOP853;
    ck_assert_int_eq(gough_plant_begin(plant, model, &s, NULL, &end, &error), GOUGH_ERROR_INPUT);
    ck_assert_msg(strstr(error.message, "fixed steps") != NULL, "%s", error.message);
    s = fixed(GOUGH_RK4, 0.05);
    s.precision = GOUGH_QUADRUPLE;
    ck_assert_int_eq(gough_plant_begin(plant, model, &s, NULL, &end, &error), GOUGH_ERROR_INPUT);
    free(plant);
    free(model);
}
END_TEST

/* free fall under a command of 0 that a drive of no strength obeys: u, f, sat in rows */
START_TEST(rows_show_what_holds_a_drive) {
    gough_model *model = limited_model(0);
    gough_simulation s = fixed(GOUGH_RK4, 0.05);
    last_row row;
    int held = 0;

    run(model, &s, &row);
    for (int v = 0; v < GOUGH_LEGS; v++) {
        const double u = row.value[GOUGH_U + v], sat = row.value[GOUGH_SATURATED + v];
        const double off = row.value[GOUGH_MEASURED + v] - model->machine.home_length[v];
        ck_assert(u >= -0.6 && u <= 0.33);
        ck_assert(!(fabs(sat) > 0) || !(fabs(sat - 1) > 0));
        if (sat > 0) ck_assert(!(u > -0.6 && u < 0.33));
        held += sat > 0;
        ck_assert_double_eq_tol(off / 1e-5, round(off / 1e-5), 1e-6); /* whole counts from home */
        const double jolt = v == 1 ? 0.1 * sin(2.0) : 0;              /* disturbance.leg_force */
        ck_assert_double_eq_tol(row.value[GOUGH_F + v], u + jolt, 1e-15);
    }
    printf("%d drives at their limit\n", held);
    ck_assert_int_gt(held, 0);
    free(model);
}
END_TEST

enum {
    EVERY = 8,
    BEAT = 20
}; /* rows and samples; samples from one jump of the command to the next */
static const double lag_time = 0.02, greatest_rate = 3, beat = 0.2;

static void jump(void *context, const gough_sample *sample, double command[GOUGH_LEGS]) {
    (void)context;
    for (int v = 0; v < GOUGH_LEGS; v++)
        command[v] = 0.3 + (sample->number / BEAT % 2 ? 0.1 : -0.1);
}

/* Under a command that jumps up and down the force changes at the greatest rate, either way, until it is within rate T_a of it, and
 * then by the exponential of the lag; the column sat is 5 till then. */
static int compare_jumps(void *context, const gough_row *row) {
    const double t = row->value[GOUGH_T], near = greatest_rate * lag_time;
    int *rows = context;
    double f = 0.2, from = 0;

    for (int k = 0; k * beat < t - 1e-9; k++) {
        const double u = k % 2 ? 0.4 : 0.2, time = fmin(t - k * beat, beat), far = fabs(u - f);
        const double straight = fmax(far - near, 0) / greatest_rate, sign = u > f ? 1 : -1;
        from = far - greatest_rate * fmin(time, straight);
        if (time > straight) from *= exp((straight - time) / lag_time);
        f = u - sign * from;
    }
    for (int v = 0; v < GOUGH_LEGS; v++) {
        ck_assert_msg(fabs(row->value[GOUGH_F + v] - f) <= 1e-8, "t %g: force %.12g, not %.12g", t,
                      row->value[GOUGH_F + v], f);
        if (fabs(from - near) > 1e-6 && t > 0)
            ck_assert_msg(fabs(row->value[GOUGH_SATURATED + v] - (from > near ? 5 : 0)) <= 0,
                          "t %g: sat %g, %g from the command", t, row->value[GOUGH_SATURATED + v],
                          from);
    }
    rows[from > near]++;
    return 0;
}

START_TEST(rates_of_force_are_limited_both_ways) {
    gough_model *model = model_of(10, 1);
    gough_platform p = model->machine.platform;
    gough_simulation s = gough_simulation_default();
    gough_error error = {0};
    gough_end end;
    int rows[2] = {0};

    p.actuators.kind = GOUGH_ACTUATOR_LAG;
    for (int v = 0; v < GOUGH_LEGS; v++) {
        p.actuators.time_constant[v] = lag_time;
        p.actuators.max_rate[v] = greatest_rate;
    }
    machine_again(model, &p);
    set_formula(&model->disturbance.leg_force[1], "0");
    model->control.sampling.period = beat / BEAT;
    s.duration = 4 * beat;
    s.output_step = beat / BEAT / EVERY;
    s.tolerance = 1e-12;
    s.commands = s.actuators = true;
    s.law = jump;
    ck_assert_msg(gough_simulate(model, &s, compare_jumps, rows, &end, &error) == GOUGH_OK, "%s%s",
                  error.message, end.message);
    ck_assert_int_gt(rows[1], 3 * 30);
    ck_assert_int_gt(rows[0], 3 * 30);
    free(model);
}
END_TEST

/* work of the legs = change of kinetic and potential energy, though forces jump at each sample */
START_TEST(work_is_what_energy_gains) {
    gough_model *model = model_of(20, 2);
    gough_simulation s = fixed(GOUGH_DOP853, 0);
    const gough_formula none = gough_formula_constant(0);
    gough_summary sum;
    last_row row;
    double work = 0;

    model->disturbance.moment[2] = none;
    model->control.sampling = (gough_sampling){.period = 0.02, .delay = 0.013};
    s.summary = &sum;
    s.output_step = 1;
    s.tolerance = 1e-12;
    memset(&model->initial, 0, sizeof model->initial);
    run(model, &s, &row);
    for (int v = 0; v < GOUGH_LEGS; v++) work += sum.leg[v].energy;

    double energy[2];
    for (int k = 0; k < 2; k++) {
        gough_state state;
        gough_acceleration unused;
        double c[3], velocity[3], turning[3] = {0, 0, 0}, gained = 0;
        const gough_load *load = &model->machine.load;
        if (k == 0) {
            gough_program(&model->machine, &model->motion, 0, &state, &unused);
        } else {
            gough_rotation_from_angles(row.value + GOUGH_ROLL_ANGLE, state.rotation);
            memcpy(state.position, row.value + GOUGH_X, sizeof state.position);
            memcpy(state.velocity, row.value + GOUGH_VX, sizeof state.velocity);
            memcpy(state.angular_velocity, row.value + GOUGH_WX, sizeof state.angular_velocity);
        }
        const double *w = state.angular_velocity;
        double own[3] = {0, 0, 0};
        for (int i = 0; i < 3; i++) {
            c[i] = 0;
            for (int j = 0; j < 3; j++) c[i] += state.rotation[i][j] * load->center_of_mass[j];
            for (int j = 0; j < 3; j++) own[i] += state.rotation[j][i] * w[j];
        }
        for (int i = 0; i < 3; i++) {
            const int a = (i + 1) % 3, b = (i + 2) % 3;
            velocity[i] = state.velocity[i] + w[a] * c[b] - w[b] * c[a];
            gained += 0.5 * load->mass * velocity[i] * velocity[i] -
                      load->mass * model->machine.gravity[i] * (state.position[i] + c[i]);
            for (int j = 0; j < 3; j++) turning[i] += load->inertia[i][j] * own[j];
            gained += 0.5 * turning[i] * own[i];
        }
        energy[k] = gained;
    }
    ck_assert_double_eq_tol(work, energy[1] - energy[0], 2e-7);
    free(model);
}
END_TEST

typedef struct {
    const gough_machine *machine;
    gough_summary sum;
    double saturated[6];
} counted_rows;

static int count_row(void *context, const gough_row *row) {
    counted_rows *c = context;

    for (int v = 0; v < 6; v++) c->saturated[v] += row->value[GOUGH_SATURATED + v] > 0;
    gough_summary_add(&c->sum, c->machine, row);
    return 0;
}

/* more than the drive of leg 3 takes, in two of five samples from sample 2 on */
static void ask_too_much(void *context, const gough_sample *sample, double command[GOUGH_LEGS]) {
    const uint64_t turn = sample->number % 5;

    (void)context;
    if (turn == 2 || turn == 3) command[2] = turn == 2 ? 90 : -90;
}

/* commands that are held count exactly, whether the steps are the samples' own or find themselves, and rows tell the rest apart */
START_TEST(summaries_count_how_long_drives_are_held) {
    gough_model *model = model_of(30, 3);
    gough_platform p = model->machine.platform;
    gough_summary sum;

    for (int v = 0; v < 6; v++) p.actuators.max_force[v][0] = -80, p.actuators.max_force[v][1] = 80;
    machine_again(model, &p);
    for (int method = 0; method < 2; method++) {
        gough_simulation s = fixed(method ? GOUGH_RK4 : GOUGH_DOP853, method ? 0.005 : 0);
        gough_end end;
        model->control.sampling = (gough_sampling){.period = 0.02, .delay = 0.01};
        s.law = ask_too_much;
        s.summary = &sum;
        s.actuators = s.commands = method == 0;
        ck_assert(gough_simulate(model, &s, NULL, NULL, &end, NULL) == GOUGH_OK);
        for (int v = 0; v < 6; v++) {
            ck_assert_double_eq_tol(sum.leg[v].saturated, v == 2 ? 0.4 : 0, 1e-12);
            ck_assert(v == 2 ? fabs(sum.leg[v].saturated_at - 0.05) <= 1e-12
                             : isnan(sum.leg[v].saturated_at));
        }
    }
    /* of a continuous controller, against rows that are close together */
    model->control.sampling = (gough_sampling){.period = 0};
    for (int v = 0; v < 6; v++) p.actuators.max_force[v][1] = 0.01;
    machine_again(model, &p);
    gough_simulation s = fixed(GOUGH_DOP853, 0);
    gough_end end;
    s.duration = 0.05;
    s.output_step = 0.05;
    s.summary = &sum;
    ck_assert(gough_simulate(model, &s, NULL, NULL, &end, NULL) == GOUGH_OK);
    s.output_step = 1e-4;
    s.summary = NULL;
    counted_rows count = {.machine = &model->machine};
    gough_summary_begin(&count.sum);
    ck_assert(gough_simulate(model, &s, count_row, &count, &end, NULL) == GOUGH_OK);
    gough_summary_end(&count.sum);
    int held = 0;
    for (int v = 0; v < 6; v++) {
        const gough_leg_summary *rows = &count.sum.leg[v];
        held += rows->saturated > 0.1;
        ck_assert_double_eq_tol(rows->saturated, count.saturated[v] / 501.0, 0.005);
        ck_assert_double_eq_tol(sum.leg[v].saturated, rows->saturated, 0.05);
        ck_assert(isnan(rows->saturated_at) == isnan(sum.leg[v].saturated_at));
    }
    ck_assert_int_ge(held, 2);
    free(model);
}
END_TEST

/* l^p − m at the latest sample before a row; with rows as often as samples each is seen */
typedef struct {
    double most[6], at[6];
} found_errors;

static void note_error(void *context, const gough_sample *sample, double command[GOUGH_LEGS]) {
    found_errors *f = context;

    (void)command;
    for (int v = 0; v < 6; v++) {
        const double error = fabs(sample->program_length[v] - sample->length[v]);
        if (!(error > f->most[v])) continue;
        f->most[v] = error;
        f->at[v] = sample->time;
    }
}

/* the largest error that the controller finds is that which the caller's law is shown, with noise and counts */
START_TEST(summaries_have_the_largest_error_of_a_sample) {
    gough_model *model = model_of(30, 3);
    gough_simulation s = fixed(GOUGH_DOP853, 0);
    found_errors seen = {{0}, {0}};
    gough_summary sum;
    gough_end end;

    model->control.sampling = (gough_sampling){.period = 0.02,
                                               .delay = 0.01,
                                               .velocity = GOUGH_VELOCITY_DIFFERENCE,
                                               .resolution = 1e-4,
                                               .noise = 1e-4};
    s.output_step = s.duration;
    s.law = note_error;
    s.law_context = &seen;
    s.summary = &sum;
    ck_assert(gough_simulate(model, &s, NULL, NULL, &end, NULL) == GOUGH_OK);
    for (int v = 0; v < 6; v++) {
        ck_assert_msg(fabs(sum.leg[v].sample_error - seen.most[v]) <= 1e-15 && seen.most[v] > 1e-5,
                      "leg %d: %.17g, not %.17g", v + 1, sum.leg[v].sample_error, seen.most[v]);
        ck_assert(fabs(sum.leg[v].sample_error_at - seen.at[v]) <= 0);
    }
    model->control.sampling = (gough_sampling){.period = 0};
    s.law = NULL;
    ck_assert(gough_simulate(model, &s, NULL, NULL, &end, NULL) == GOUGH_OK);
    for (int v = 0; v < 6; v++)
        ck_assert(isnan(sum.leg[v].sample_error) && isnan(sum.leg[v].sample_error_at));
    free(model);
}
END_TEST

int main(void) {
    return SUITE_RUN("sampled", 60, a_short_period_is_nearly_continuous,
                     the_callers_law_may_be_the_librarys, the_callers_law_counts,
                     a_plant_moves_as_a_run, a_plant_ends_and_refuses, rows_show_what_holds_a_drive,
                     rates_of_force_are_limited_both_ways, work_is_what_energy_gains,
                     summaries_count_how_long_drives_are_held,
                     summaries_have_the_largest_error_of_a_sample);
}
