/* Sampled loops at rest: against the windows of the paper's machine and closed forms of its modes, and against what must hold for
 * every machine.
 * Label: standard. */
#include <stdio.h>

#include "gough/linear.h"
#include "linear/sampled.h"
#include "support/machines.h"
#include "support/suite.h"

static gough_model *new_model(double period, double delay, gough_velocity velocity) {
    gough_model *model = calloc(1, sizeof *model);

    ck_assert(model != NULL);
    paper_machine(&model->machine);
    model->control.feedforward = true;
    model->control.sampling =
        (gough_sampling){.period = period, .delay = delay, .velocity = velocity};
    return model;
}

static gough_sampled_margins margins_of(const gough_model *model) {
    gough_sampled_margins m;
    gough_error error = {0};

    ck_assert_msg(gough_sampled_margins_at_rest(model, NULL, &m, &error) == GOUGH_OK, "%s",
                  error.message);
    return m;
}

static gough_sampled_rest rest_of(const gough_model *model) {
    gough_sampled_rest r;
    gough_error error = {0};

    ck_assert_msg(gough_sampled_at_rest(model, NULL, &r, &error) == GOUGH_OK, "%s", error.message);
    return r;
}

static void near(double found, double right, double tolerance, const char *what) {
    ck_assert_msg(fabs(found - right) <= tolerance, "%s: %.17g, not %.17g", what, found, right);
}

/* ---- the paper's machine --------------------------------------------------------------------------------------- */

static const gough_velocity EXACT = GOUGH_VELOCITY_EXACT, DIFFERENCE = GOUGH_VELOCITY_DIFFERENCE;

/* heave: λ² = g d²/(h l²), d = 0.7, and its threshold M g d²/(6 h³) */
static const double heave_square = 0.49 / 1.49;

/* the lower edge of the paper's machine, (stab-10), to six digits */
static const double lower_edge = 0.894107;

static double half_of_sixth_digit(double x) { return 0.51 * pow(10, floor(log10(x)) - 5); }

START_TEST(windows_of_the_paper_machine) {
    const struct {
        double period, delay;
        gough_velocity velocity;
        double upper; /* at D = 0.3, to six digits; 0: there is no window */
        const char *mode;
        double limit; /* of the period; 0: not in the table */
    } row[] = {{.01, 0, EXACT, 60.0002, "heave", 0},
               {.01, 0, DIFFERENCE, 58.3884, "sway–tilt", .303},
               {.05, 0, EXACT, 12.0008, "heave", 0},
               {.05, 0, DIFFERENCE, 10.4838, "sway–tilt", .303},
               {.05, .05, EXACT, 3.75109, "sway–tilt", .182},
               {.05, .05, DIFFERENCE, 3.40698, "sway–tilt", .138},
               {.2, 0, EXACT, 3.00329, "heave", 0},
               {.2, 0, DIFFERENCE, 1.76624, "sway–tilt", .303},
               {.2, .2, EXACT, 0, "none", .182},
               {.2, .2, DIFFERENCE, 0, "none", .138}};

    for (size_t k = 0; k < sizeof row / sizeof *row; k++) {
        gough_model *model = new_model(row[k].period, row[k].delay, row[k].velocity);
        set_gains(model, 2, 0.3);
        const gough_sampled_margins m = margins_of(model);

        ck_assert_int_eq(m.open, row[k].upper > 0);
        ck_assert_str_eq(m.upper.mode.name, row[k].mode);
        near(m.damping, 0.3, 0, "damping");
        if (m.open) {
            near(m.lower.stiffness, lower_edge, 5e-7, "lower edge");
            near(m.upper.stiffness, row[k].upper, half_of_sixth_digit(row[k].upper), "upper edge");
            ck_assert_str_eq(m.lower.mode.name, "sway–tilt");
            near(m.lower.frequency, 0, 0, "frequency at the lower edge");
        } else {
            ck_assert(isnan(m.lower.stiffness) && isnan(m.upper.stiffness));
        }
        if (row[k].limit > 0) near(m.period_limit, row[k].limit, 5e-4, "limit of the period");
        free(model);
    }
}
END_TEST

/* A little above the lower edge some damping holds just below the longest period of all, and none does just above it. */
START_TEST(no_damping_holds_beyond_the_longest_period) {
    const struct {
        double periods;
        gough_velocity velocity;
    } row[] = {{1, EXACT}, {1, DIFFERENCE}, {0, DIFFERENCE}};

    for (size_t k = 0; k < 3; k++) {
        gough_model *model = new_model(.1, row[k].periods * .1, row[k].velocity);
        const double limit = margins_of(model).period_limit;
        for (int beyond = 0; beyond < 2; beyond++) {
            const double T = limit * (beyond ? 1.004 : 0.996);
            double least = INFINITY;
            model->control.sampling.period = T;
            model->control.sampling.delay = row[k].periods * T;
            for (int i = 1; i < 160; i++) {
                set_gains(model, lower_edge * (1 + 1e-5), i / 160.0 * 2 / (9.095554 * T));
                least = fmin(least, rest_of(model).radius);
            }
            ck_assert_msg(beyond ? least > 1 : least < 1, "row %zu, T %g: |μ| %.9g", k, T, least);
        }
        free(model);
    }
}
END_TEST

/* without delay and with exact rates each mode is (loop-3): G_hi = D λ coth(λT/2) of the slowest, with det = 1 there */
START_TEST(upper_edge_without_delay_is_a_closed_form) {
    for (int k = 0; k < 4; k++) {
        const double T = 0.01 * pow(3, k), lambda = sqrt(heave_square), D = 0.2 + 0.03 * k;
        gough_model *model = new_model(T, 0, EXACT);
        set_gains(model, 2, D);
        const gough_sampled_margins m = margins_of(model);
        const double right = D * lambda / tanh(lambda * T / 2);

        near(m.upper.stiffness, right, 1e-10 * right, "G D λ coth");
        ck_assert_str_eq(m.upper.mode.name, "heave");
        /* det 1 and trace: 2 cos ωT = 2C − κ (G (C − 1)/λ² + D S) */
        const double kappa = 6 / 1.49, C = cosh(lambda * T), S = sinh(lambda * T) / lambda;
        const double trace = 2 * C - kappa * (right * (C - 1) / heave_square + D * S);
        near(m.upper.frequency, acos(trace / 2) / T, 1e-7 / T, "frequency");
        free(model);
    }
}
END_TEST

/* c₁/(κ T²) and c₂/(κ T) with the largest g of one mode; what λ adds is a constant */
START_TEST(best_gains_follow_one_mode) {
    const double kappa = 9.095554;
    const struct {
        double periods;
        gough_velocity velocity;
        double g, c;
    } row[] = {{1, EXACT, .25, .625},
               {0, DIFFERENCE, 12 - 8 * sqrt(2), .828427},
               {1, DIFFERENCE, .144469, .424694}};

    for (size_t k = 0; k < 3; k++) {
        const double T = 0.02;
        gough_model *model = new_model(T, row[k].periods * T, row[k].velocity);
        const gough_sampled_margins m = margins_of(model); /* gains of no size, all legs alike */
        const double more = m.best_stiffness - row[k].g / (kappa * T * T);

        ck_assert_msg(more > 0.062 && more < 0.071, "row %zu: %g", k, more);
        near(m.best_damping, row[k].c / (kappa * T), 0.01 * m.best_damping, "damping");
        free(model);
    }
    gough_model *model = new_model(.05, .05, EXACT);
    set_gains(model, 1, 1);
    near(margins_of(model).best_stiffness, 11.0575, 1e-4, "best of T = 0.05");
    free(model);
}
END_TEST

/* the paper's law without damping grows at κ_max G T/4, the more exactly the shorter T is */
START_TEST(sampling_pumps_an_undamped_loop) {
    gough_model *model = new_model(.001, 0, EXACT);

    set_gains(model, 50, 0);
    const gough_sampled_rest r = rest_of(model);
    const gough_sampled_margins m = margins_of(model);
    near(r.growth, 0.11368, 5e-6, "growth");
    near(r.mass, 1 / 9.095554, 1e-7, "mass");
    near(r.effective_delay, 0.0005, 0, "effective delay");
    ck_assert(!r.stable && !r.decaying && !m.open);
    ck_assert(isnan(m.longest_period) && isnan(m.longest_delay));
    /* with damping there is a window, up to 4/(κT²) and more */
    ck_assert(m.best_stiffness > 4 / (9.095554 * 1e-6));
    free(model);
}
END_TEST

/* ---- margins are where multipliers are of size 1 --------------------------------------------------------------- */

static double radius_with(gough_model *model, double stiffness, double period, double delay) {
    const gough_sampling own = model->control.sampling;
    double G[6], radius;

    memcpy(G, model->control.stiffness, sizeof G);
    for (int v = 0; v < 6; v++) model->control.stiffness[v] *= stiffness;
    model->control.sampling.period *= period;
    model->control.sampling.delay = delay;
    radius = rest_of(model).radius;
    memcpy(model->control.stiffness, G, sizeof G);
    model->control.sampling = own;
    return radius;
}

static void on_the_edge(gough_model *model, double stiffness, double period, double delay,
                        const char *what) {
    const double radius = radius_with(model, stiffness, period, delay);
    ck_assert_msg(fabs(radius - 1) <= 1e-9, "%s: |μ| = %.12g", what, radius);
}

START_TEST(margins_are_edges_of_random_machines) {
    int open = 0;
    dice d = {11};

    printf("seed 11\n");
    for (int k = 0; k < 8; k++) {
        gough_model *model = new_model(1, 0, k % 2 ? DIFFERENCE : EXACT);
        gough_control *c = &model->control;
        const symmetric s = random_symmetric(&d, &model->machine);
        const double weight = s.M * s.g / s.h, unit = sqrt(s.h / s.g);

        if (k % 3 == 0) give_legs(&model->machine, LEGS_HEAVY | LEGS_VISCOUS, &d);
        c->sampling.period = 0.02 * unit;
        c->sampling.delay = c->sampling.period * (k % 4) * 0.6;
        if (k % 8 == 1) c->sampling.cutoff = 0.2 / c->sampling.period;
        for (int v = 0; v < 6; v++) {
            c->stiffness[v] = weight * dice_between(&d, 4, 6);
            c->damping[v] = weight * unit * dice_between(&d, 0.4, 0.6);
            c->integral[v] = k % 5 == 4 ? weight / unit * 0.2 : 0;
        }
        const gough_sampled_margins m = margins_of(model);
        const double T = c->sampling.period, delay = c->sampling.delay;
        double size = 0;
        for (int v = 0; v < 6; v++) size = fmax(size, c->stiffness[v]);

        open += m.open;
        if (m.open) {
            const double middle = sqrt(m.lower.stiffness * m.upper.stiffness) / size;
            on_the_edge(model, m.lower.stiffness / size, 1, delay, "lower edge");
            on_the_edge(model, m.upper.stiffness / size, 1, delay, "upper edge");
            ck_assert(radius_with(model, middle, 1, delay) < 1);
            ck_assert(m.best_stiffness >= m.upper.stiffness * (1 - 1e-6) || c->integral[0] > 0);
        }
        if (rest_of(model).decaying) {
            on_the_edge(model, 1, m.longest_period / T, delay * m.longest_period / T, "period");
            if (isfinite(m.longest_delay)) on_the_edge(model, 1, 1, m.longest_delay, "delay");
            ck_assert(m.longest_period > T && m.longest_delay > delay);
            ck_assert(m.longest_period < m.period_limit || c->integral[0] > 0);
        }
        free(model);
    }
    ck_assert_int_ge(open, 5);
}
END_TEST

/* ---- a delay alone ---------------------------------------------------------------------------------------------- */

/* the growth rate of heave, its largest multiplier's; *frequency: how fast it turns */
static double heave_growth(const gough_sampled_rest *r, double period, double *frequency) {
    for (size_t i = 0; i < r->listed; i++) {
        const double *value = r->multiplier[i].value;
        if (strcmp(r->multiplier[i].mode.name, "heave") != 0) continue;
        *frequency = fabs(atan2(value[1], value[0])) / period;
        return log(hypot(value[0], value[1])) / period;
    }
    ck_abort_msg("no multiplier is of heave");
}

/* On the edge of (loop-6) heave neither grows nor dies out once the period is short against the delay, and turns at ω. What the
 * period changes is of order 1 in it, and of order 2 once half a period is taken off the delay. */
START_TEST(short_periods_tend_to_a_pure_delay) {
    const double kappa = 6 / 1.49, delay = 0.12;

    for (int k = 1; k <= 4; k++) {
        const double omega = 0.35 * k / delay, square = omega * omega + heave_square;
        double growth[3], frequency;
        for (int n = 0; n < 3; n++) {
            const double T = delay / (3 << n);
            gough_model *model = new_model(T, delay, EXACT);
            set_gains(model, square * cos(omega * delay) / kappa,
                      square * sin(omega * delay) / (omega * kappa));
            const gough_sampled_rest r = rest_of(model);
            growth[n] = heave_growth(&r, T, &frequency);
            free(model);
        }
        const double order = log2((growth[0] - growth[1]) / (growth[1] - growth[2]));
        const double limit = (growth[0] - 6 * growth[1] + 8 * growth[2]) / 3;
        near(order, 1, 0.3, "order"); /* three periods a delay are few */
        ck_assert_msg(growth[2] > 0.005 * omega, "growth %g", growth[2]);
        near(limit, 0, 2e-3 * omega, "growth without a period");
        near(frequency, omega, 0.15 * omega, "frequency");

        const double T = delay / 12; /* the delay of the hold is half a period */
        gough_model *model = new_model(T, delay - T / 2, EXACT);
        set_gains(model, square * cos(omega * delay) / kappa,
                  square * sin(omega * delay) / (omega * kappa));
        const gough_sampled_rest r = rest_of(model);
        near(heave_growth(&r, T, &frequency), 0, 2e-3 * omega, "growth with half a period less");
        near(frequency, omega, 2e-3 * omega, "frequency with half a period less");
        free(model);
    }
}
END_TEST

/* without gravity the stiffest loop is that of the fastest mode, 0.549774/τ² with 0.948166/τ, where ωτ tan ωτ = 2 */
START_TEST(stiffest_loop_of_a_pure_delay) {
    const double delay = 0.05, none[3] = {0, 0, 0};
    double stiffness[3], damping[3], x = 1;

    for (int i = 0; i < 60; i++) x = atan(2 / x);
    near(x * x * cos(x), .549774, 5e-7, "c1");
    near(x * sin(x), .948166, 5e-7, "c2");
    for (int n = 0; n < 3; n++) {
        gough_model *model = new_model(delay / (3 << n), delay, EXACT);
        const gough_machine old = model->machine;
        gough_error error = {0};
        ck_assert(gough_machine_init(&model->machine, &old.platform, &old.load, none, &error) ==
                  GOUGH_OK);
        const gough_sampled_margins m = margins_of(model);
        stiffness[n] = m.best_stiffness;
        damping[n] = m.best_damping;
        free(model);
    }
    const double kappa = 9.095554;
    const double limit = (stiffness[0] - 6 * stiffness[1] + 8 * stiffness[2]) / 3;
    const double with = (damping[0] - 6 * damping[1] + 8 * damping[2]) / 3;
    near(limit, x * x * cos(x) / (kappa * delay * delay), 0.01 * limit, "stiffness");
    near(with, x * sin(x) / (kappa * delay), 0.03 * with, "damping");
}
END_TEST

/* ---- drives that lag ------------------------------------------------------------------------------------------- */

static void give_lag(gough_model *model, double time_constant) {
    gough_actuators *a = &model->machine.platform.actuators;

    a->kind = GOUGH_ACTUATOR_LAG;
    for (int v = 0; v < 6; v++) a->time_constant[v] = time_constant;
}

/* the shorter the period, the nearer the edge is to D/T_a, where all six modes are neutral at once */
START_TEST(lag_bounds_the_stiffness) {
    const double lag = 0.05, D = 0.3;
    double before = INFINITY;

    for (int k = 0; k < 3; k++) {
        const double T = 0.008 / pow(4, k);
        gough_model *model = new_model(T, 0, EXACT);
        gough_sampled_rest r;
        give_lag(model, lag);
        set_gains(model, 2, D);
        const gough_sampled_margins m = margins_of(model);
        const double apart = fabs(m.upper.stiffness - D / lag);

        near(m.lower.stiffness, lower_edge, 5e-7, "lower edge");
        ck_assert_msg(apart < 0.3 * before && apart < 14 * T / lag * D / lag, "%g at T %g", apart,
                      T);
        before = apart;
        set_gains(model, D / lag, D);
        r = rest_of(model);
        near(r.effective_delay, lag + T / 2, 1e-15, "effective delay");
        ck_assert_int_eq((int)r.size, 18);
        for (int i = 0; i < 12; i++) {
            const double *value = r.multiplier[i].value;
            ck_assert(fabs(log(hypot(value[0], value[1])) / T) < 12 * T / 0.008);
        }
        free(model);
    }
}
END_TEST

/* a second order that is fast, or a first that is, changes nothing */
START_TEST(fast_drives_are_ideal) {
    gough_model *model = new_model(.05, .07, DIFFERENCE);
    set_gains(model, 2, 0.3);
    const double right = margins_of(model).upper.stiffness;
    gough_actuators *a = &model->machine.platform.actuators;

    give_lag(model, 1e-7);
    near(margins_of(model).upper.stiffness, right, 1e-5, "first order");
    for (int v = 0; v < 6; v++) {
        a->time_constant[v] = 0;
        a->frequency[v] = 1e5;
        a->damping_ratio[v] = 0.7;
    }
    near(margins_of(model).upper.stiffness, right, 1e-4, "second order");
    near(rest_of(model).effective_delay, .07 + .025 + 1.4 / (2 * pi * 1e5), 1e-12, "delay");
    free(model);
}
END_TEST

/* ---- gains that are matrices ----------------------------------------------------------------------------------- */

/* turned round by one leg, all matrices of gains that are alike for each leg and its neighbours keep their multipliers */
START_TEST(matrices_of_gains) {
    gough_model *model = new_model(.05, .02, DIFFERENCE), *other = new_model(.05, .02, DIFFERENCE);
    gough_control *c = &other->control;

    set_gains(model, 2, 0.3);
    set_gains(other, 2, 0.3);
    c->coupled = true;
    near(rest_of(other).radius, rest_of(model).radius, 0, "without coupling");
    for (int v = 0; v < 6; v++) c->cross_stiffness[v][v ^ 1] = 0.1;
    ck_assert(fabs(rest_of(other).radius - rest_of(model).radius) > 1e-4);
    const gough_sampled_margins m = margins_of(other);
    for (int v = 0; v < 6; v++) {
        c->stiffness[v] *= m.upper.stiffness / 2;
        c->cross_stiffness[v][v ^ 1] *= m.upper.stiffness / 2;
    }
    near(rest_of(other).radius, 1, 1e-10, "at the edge");
    free(model);
    free(other);
}
END_TEST

/* ---- noise ----------------------------------------------------------------------------------------------------- */

/* (loop-2) by the response of the command to one wrong length */
START_TEST(noise_of_the_command) {
    for (int k = 0; k < 3; k++) {
        const double G = 5, D = 0.3, T = 0.05, noise = 1e-3, count = 2e-4;
        gough_model *model = new_model(T, 0, k ? DIFFERENCE : EXACT);
        gough_sampling *s = &model->control.sampling;
        s->cutoff = k == 2 ? 2 : 0;
        s->noise = noise;
        s->resolution = count;
        set_gains(model, G, D);
        const gough_sampled_rest r = rest_of(model);
        const double alpha = s->cutoff > 0 ? exp(-2 * pi * s->cutoff * T) : 0;
        double sum = 0, rate = 0, first = 0;

        for (int i = 0; i < 400; i++) {
            const double e = i == 0, change = (i == 0) - (i == 1);
            rate = k ? alpha * rate + (1 - alpha) * change / T : 0;
            const double u = G * e + D * rate;
            sum += u * u;
            if (i == 0) first = u;
        }
        const double variance = noise * noise + count * count / 12;
        near(r.noise[3], sqrt(variance * sum), 1e-13, "noise");
        near(r.count[3], count * first, 1e-15, "count");
        free(model);
    }
}
END_TEST

/* ---- errors ---------------------------------------------------------------------------------------------------- */

static void refuses(gough_model *model, const char *words) {
    gough_error error = {0};
    gough_sampled_rest rest;
    gough_sampled_margins margins;

    ck_assert_int_ne(gough_sampled_at_rest(model, NULL, &rest, &error), GOUGH_OK);
    ck_assert_msg(strstr(error.message, words) != NULL, "%s", error.message);
    error.message[0] = '\0';
    ck_assert_int_ne(gough_sampled_margins_at_rest(model, NULL, &margins, &error), GOUGH_OK);
    ck_assert_msg(strstr(error.message, words) != NULL, "%s", error.message);
}

START_TEST(refuses_what_it_cannot_compute) {
    gough_model *model = new_model(0, 0, EXACT);

    refuses(model, "continuous");
    model->control.sampling.period = 0.01;
    model->control.sampling.delay = 0.1201;
    refuses(model, "more than 12 periods");
    model->control.sampling.delay = 0.12;
    ck_assert_int_eq((int)rest_of(model).size, 12 + 72);
    free(model);
}
END_TEST

int main(void) {
    return SUITE_RUN("linear/sampled", 60, windows_of_the_paper_machine,
                     no_damping_holds_beyond_the_longest_period,
                     upper_edge_without_delay_is_a_closed_form, best_gains_follow_one_mode,
                     sampling_pumps_an_undamped_loop, margins_are_edges_of_random_machines,
                     short_periods_tend_to_a_pure_delay, stiffest_loop_of_a_pure_delay,
                     lag_bounds_the_stiffness, fast_drives_are_ideal, matrices_of_gains,
                     noise_of_the_command, refuses_what_it_cannot_compute);
}
