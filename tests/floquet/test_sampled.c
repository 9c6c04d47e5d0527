/* Sampled loops about a program: against the loop at rest where the program hardly moves, against runs of the nonlinear equations,
 * and against the table of heave in which tongues of resonance and the delay's edge lie side by side. */
#include <complex.h>
#include <stdio.h>

#include "gough/floquet.h"
#include "support/machines.h"
#include "support/suite.h"

static gough_model *new_model(const char *heave, double period, double delay) {
    gough_model *model = calloc(1, sizeof *model);

    ck_assert(model != NULL);
    paper_machine(&model->machine);
    model->control.feedforward = true;
    model->control.sampling.period = period;
    model->control.sampling.delay = delay;
    set_formula(&model->motion.formula[GOUGH_HEAVE], heave);
    return model;
}

static gough_sampled_floquet along(const gough_model *model) {
    gough_sampled_floquet floquet;
    gough_error error = {0};

    ck_assert_msg(gough_floquet_sampled(model, NULL, &floquet, &error) == GOUGH_OK, "%s",
                  error.message);
    return floquet;
}

static double magnitude(const gough_multiplier *m) { return hypot(m->value[0], m->value[1]); }

/* the largest multiplier of heave; count: how many there are */
static double heave_growth(const gough_sampled_floquet *floquet, int *count) {
    double largest = 0;

    *count = 0;
    for (size_t k = 0; k < floquet->listed; k++) {
        if (strcmp(floquet->multiplier[k].mode.name, "heave") != 0) continue;
        largest = fmax(largest, magnitude(&floquet->multiplier[k]));
        ++*count;
    }
    return largest;
}

/* as many samples of the loop at rest, whatever they are made of */
START_TEST(hardly_moving_is_rest) {
    for (int k = 0; k < 3; k++) {
        const double T = 2 * pi / 32;
        gough_model *model = new_model("1e-7*sin(t)", T, (const double[]){0, 0.4, 1.3}[k] * T);
        gough_control *c = &model->control;
        gough_sampled_rest rest;
        set_gains(model, 1.2, 0.3);
        if (k == 1) c->sampling.velocity = GOUGH_VELOCITY_DIFFERENCE;
        for (int v = 0; v < 6 && k == 2; v++) {
            c->integral[v] = 0.02;
            model->machine.platform.actuators.time_constant[v] = 0.04;
        }
        if (k == 2) model->machine.platform.actuators.kind = GOUGH_ACTUATOR_LAG;
        const gough_sampled_floquet floquet = along(model);

        ck_assert_int_eq(gough_sampled_at_rest(model, NULL, &rest, NULL), GOUGH_OK);
        ck_assert_int_eq((int)floquet.samples, 32);
        ck_assert_int_eq((int)floquet.size, (int)rest.size);
        ck_assert_int_eq(floquet.stable, rest.stable);
        for (int i = 0; i < 8; i++) {
            const double right = pow(magnitude(&rest.multiplier[i]), 32);
            ck_assert_msg(fabs(magnitude(&floquet.multiplier[i]) - right) <= 1e-5 * floquet.growth,
                          "case %d: %.9g, not %.9g", k, magnitude(&floquet.multiplier[i]), right);
        }
        free(model);
    }
}
END_TEST

static int keep(void *context, const gough_row *row) {
    memcpy(context, row->value, sizeof row->value);
    return 0;
}

/* heave and its rate after a period, from those at its beginning */
static void run(gough_model *model, double period, const double from[2], double to[2]) {
    gough_simulation s = gough_simulation_default();
    gough_error error = {0};
    double last[GOUGH_COLUMNS];
    gough_end end;

    model->initial.given[GOUGH_HEAVE] = model->initial.velocity_given = true;
    model->initial.component[GOUGH_HEAVE] = from[0];
    model->initial.velocity[2] = from[1];
    s.duration = s.output_step = period;
    s.tolerance = 1e-13;
    ck_assert_msg(gough_simulate(model, &s, keep, last, &end, &error) == GOUGH_OK, "%s",
                  error.message);
    to[0] = last[GOUGH_Z] - model->machine.platform.height;
    to[1] = last[GOUGH_VZ];
}

/* without delay and with measured rates a controller remembers nothing: pose and velocities tell all */
START_TEST(runs_return_and_deviate) {
    for (int k = 0; k < 2; k++) {
        const double T = 2 * pi / 20, step = 1e-4;
        gough_model *model = new_model("0.2*sin(t)", T, 0);
        double map[2][2], begin[2], end[2];
        int count;
        set_gains(model, k ? 0.15 : 1.4, k ? 0.05 : 0.2);
        const gough_sampled_floquet floquet = along(model);

        begin[0] = floquet.state.position[2] - model->machine.platform.height;
        begin[1] = floquet.state.velocity[2];
        run(model, 2 * pi, begin, end);
        for (int i = 0; i < 2; i++) ck_assert(fabs(end[i] - begin[i]) <= 1e-9);
        ck_assert(fabs(begin[1] - 0.2) > 1e-4); /* it is not the program */
        for (int j = 0; j < 2; j++) {
            double from[2] = {begin[0], begin[1]}, more[2], less[2];
            from[j] = begin[j] + step;
            run(model, 2 * pi, from, more);
            from[j] = begin[j] - step;
            run(model, 2 * pi, from, less);
            for (int i = 0; i < 2; i++) map[i][j] = (more[i] - less[i]) / (2 * step);
        }
        const double half = (map[0][0] + map[1][1]) / 2,
                     det = map[0][0] * map[1][1] - map[0][1] * map[1][0];
        const double right = cabs(half + (half > 0 ? 1 : -1) * csqrt(half * half - det));
        const double found = heave_growth(&floquet, &count);
        ck_assert_int_eq(count, 2);
        ck_assert_msg(fabs(found - right) <= 1e-5 * right, "%.9g, not %.9g", found, right);
        free(model);
    }
}
END_TEST

/* Far above the window a run leaves the program within a period, in modes that grow by 6e4 (heave) and 1.5e8 (sway–tilt). The
 * motion that repeats itself is found all the same: a run of a quarter of a period leads from its state at the beginning of each
 * quarter to that of the next, each found by itself for the program at that phase. Their derivatives, by differences, have the
 * multiplier. */
START_TEST(motions_that_the_loop_lets_go) {
    static const char *const phase[4] = {"0.2*sin(t)", "0.2*sin(t + pi/2)", "0.2*sin(t + pi)",
                                         "0.2*sin(t + 3*pi/2)"};
    double state[4][2], map[2][2] = {{1, 0}, {0, 1}}, found = 0;
    int count;

    for (int q = 0; q < 4; q++) {
        gough_model *model = new_model(phase[q], 2 * pi / 32, 0);
        set_gains(model, 16, 0.3);
        const gough_sampled_floquet floquet = along(model);
        ck_assert(!floquet.stable && floquet.growth > 1.5e8 && floquet.growth < 1.6e8);
        state[q][0] = floquet.state.position[2] - model->machine.platform.height;
        state[q][1] = floquet.state.velocity[2];
        found = heave_growth(&floquet, &count);
        ck_assert_int_eq(count, 2);
        free(model);
    }
    for (int q = 0; q < 4; q++) {
        const double step = 1e-4;
        gough_model *model = new_model(phase[q], 2 * pi / 32, 0);
        double end[2], part[2][2], product[2][2];
        set_gains(model, 16, 0.3);
        run(model, pi / 2, state[q], end);
        for (int i = 0; i < 2; i++)
            ck_assert_msg(fabs(end[i] - state[(q + 1) % 4][i]) <= 1e-9, "quarter %d: %g off", q,
                          end[i] - state[(q + 1) % 4][i]);
        for (int j = 0; j < 2; j++) {
            double from[2] = {state[q][0], state[q][1]}, more[2], less[2];
            from[j] = state[q][j] + step;
            run(model, pi / 2, from, more);
            from[j] = state[q][j] - step;
            run(model, pi / 2, from, less);
            for (int i = 0; i < 2; i++) part[i][j] = (more[i] - less[i]) / (2 * step);
        }
        for (int i = 0; i < 2; i++)
            for (int j = 0; j < 2; j++)
                product[i][j] = part[i][0] * map[0][j] + part[i][1] * map[1][j];
        memcpy(map, product, sizeof map);
        free(model);
    }
    const double half = (map[0][0] + map[1][1]) / 2,
                 det = map[0][0] * map[1][1] - map[0][1] * map[1][0];
    const double right = cabs(half + (half > 0 ? 1 : -1) * csqrt(half * half - det));
    ck_assert_msg(fabs(found - right) <= 1e-4 * right, "%.9g, not %.9g", found, right);
}
END_TEST

/* D = 0.02, T = 2π/64, 0.2 sin t: stable for .09 – .115, .195 – .33, .35 and .39 – .405, in steps of .005, and nowhere above; with
 * a delay of a period for .09 – .115 only */
START_TEST(heave_between_tongues_and_delay) {
    const struct {
        double G;
        bool at_once, late;
    } row[] = {
        {.085, 0, 0}, {.09, 1, 1},  {.115, 1, 1}, {.12, 0, 0}, {.19, 0, 0},
        {.195, 1, 0}, {.33, 1, 0},  {.335, 0, 0}, {.35, 1, 0}, {.355, 0, 0},
        {.39, 1, 0},  {.405, 1, 0}, {.41, 0, 0},
    };

    for (size_t k = 0; k < sizeof row / sizeof *row; k++) {
        for (int late = 0; late < 2; late++) {
            const double T = 2 * pi / 64;
            gough_model *model = new_model("0.2*sin(t)", T, late * T);
            int count;
            set_gains(model, row[k].G, 0.02);
            gough_sampled_floquet floquet;
            double growth = INFINITY;
            /* where a mode of heave grows there may be no motion near the program at all */
            if (gough_floquet_sampled(model, NULL, &floquet, NULL) == GOUGH_OK) {
                growth = heave_growth(&floquet, &count);
                ck_assert_int_ge(count, 2);
            }
            ck_assert_msg((growth < 1) == (late ? row[k].late : row[k].at_once),
                          "G %g, %s: |μ| %.9g", row[k].G, late ? "late" : "at once", growth);
            free(model);
        }
    }
}
END_TEST

/* (loop-11): the motion repeats itself after three periods of the program with 61 samples, and not before; its growth over them is
 * that of the loop at rest where the program hardly moves */
START_TEST(periods_that_samples_fill) {
    const double T = 3 * 2 * pi / 61;
    gough_model *model = new_model("0.2*sin(t)", T, 0);
    gough_sampled_rest rest;
    double begin[2], end[2];
    set_gains(model, 1.4, 0.3);
    gough_sampled_floquet floquet = along(model);

    ck_assert(floquet.periods == 3 && floquet.samples == 61 && !floquet.adjusted);
    ck_assert(fabs(floquet.sampling - T) <= 1e-15);
    begin[0] = floquet.state.position[2] - model->machine.platform.height;
    begin[1] = floquet.state.velocity[2];
    run(model, 2 * pi, begin, end);
    ck_assert(fabs(end[0] - begin[0]) > 1e-5);
    run(model, 3 * 2 * pi, begin, end);
    for (int i = 0; i < 2; i++) ck_assert(fabs(end[i] - begin[i]) <= 1e-9);

    set_formula(&model->motion.formula[GOUGH_HEAVE], "1e-7*sin(t)");
    floquet = along(model);
    ck_assert_int_eq(gough_sampled_at_rest(model, NULL, &rest, NULL), GOUGH_OK);
    ck_assert(fabs(floquet.growth - pow(rest.radius, 61)) <= 1e-5 * floquet.growth);
    free(model);
}
END_TEST

/* A period of the controller that fits nowhere: what is told is that of the nearest one that does, delay and preview in
 * proportion, as if the model had it. */
START_TEST(nearest_period_that_fits) {
    const double delay = 0.7, preview = 0.4;
    gough_model *model = new_model("0.2*sin(t)", 0.1, delay * 0.1);

    set_gains(model, 1.4, 0.3);
    model->control.sampling.preview = preview * 0.1;
    const gough_sampled_floquet asked = along(model);
    ck_assert(asked.adjusted && asked.periods == 1 && asked.samples == 63);
    ck_assert(fabs(asked.sampling - 2 * pi / 63) <= 1e-14);
    model->control.sampling.period = asked.sampling;
    model->control.sampling.delay = delay * asked.sampling;
    model->control.sampling.preview = preview * asked.sampling;
    const gough_sampled_floquet fits = along(model);
    ck_assert(!fits.adjusted && fits.samples == 63);
    ck_assert(fabs(fits.growth - asked.growth) <= 1e-12 * fits.growth);
    model->control.sampling.delay = 0.07; /* not in proportion: another loop */
    ck_assert(fabs(along(model).growth - asked.growth) > 1e-6 * fits.growth);
    free(model);
}
END_TEST

static void refuses(const gough_model *model, const char *words) {
    gough_sampled_floquet floquet;
    gough_error error = {0};

    ck_assert_int_eq(gough_floquet_sampled(model, NULL, &floquet, &error), GOUGH_ERROR_INPUT);
    ck_assert_msg(strstr(error.message, words) != NULL, "%s", error.message);
}

START_TEST(refuses_what_has_no_period) {
    gough_model *model = new_model("0.2*sin(t)", 0.1, 0);

    set_gains(model, 2, 0.2);
    model->control.sampling.period = 20;
    refuses(model, "longer than two periods of the program");
    model->control.sampling.period = 2 * pi / 30000;
    refuses(model, "more than 20000 samples");
    model->control.sampling.period = 0;
    refuses(model, "continuous");
    model->control.sampling.period = 0.1;
    set_formula(&model->motion.formula[GOUGH_HEAVE], "0");
    refuses(model, "at rest");
    free(model);
}
END_TEST

int main(void) {
    return SUITE_RUN("floquet/sampled", 120, hardly_moving_is_rest, runs_return_and_deviate,
                     motions_that_the_loop_lets_go, heave_between_tongues_and_delay,
                     periods_that_samples_fill, nearest_period_that_fits,
                     refuses_what_has_no_period);
}
