/* Multipliers of continuous loops with states of their own, drives that lag and integrals, against two other ways: a formulation of
 * the test's own (the equations of drives and integrals as written in the theory, the plant by gough_forward_dynamics(), steps of
 * order 4), which goes from any state of platform, drives and integrals; and runs of gough_simulate() over many periods.
 * Label: standard.
 * Not sanitized: the same functions run under sanitizers in the tests of the command. */
#include <stdio.h>
#include <stdlib.h>

#include "gough/floquet.h"
#include "support/deviations.h"
#include "support/machines.h"
#include "support/suite.h"

enum { N = GOUGH_LINEAR, MOST = GOUGH_LINEAR_MOST, STEPS = 2500 };

/* ---- the test's own loop -------------------------------------------------------------------------------------------- */

/* Position, rotation by rows, velocity, angular velocity; forces of the drives, their rates, integrals. */
typedef struct {
    double p[3], R[9], v[3], w[3], f[6], h[6], I[6];
} loop;

static double within(double x, double low, double high) {
    return x < low ? low : x > high ? high : x;
}

/* what the controller asks: F^p + G e + D ė + I, and the errors */
static void ask(const gough_model *m, double t, const gough_state *s, const double I[6],
                double asked[6], double error[6]) {
    const gough_control *c = &m->control;
    double program[6], length[6], program_rate[6], rate[6];
    gough_acceleration a;
    gough_state wanted;

    gough_program(&m->machine, &m->motion, t, &wanted, &a);
    ck_assert_int_eq(gough_inverse_dynamics(&m->machine, &wanted, &a, NULL, asked, NULL), GOUGH_OK);
    gough_leg_kinematics(&m->machine, &wanted, NULL, program, program_rate, NULL);
    gough_leg_kinematics(&m->machine, s, NULL, length, rate, NULL);
    for (int v = 0; v < 6; v++) {
        error[v] = program[v] - length[v];
        if (!c->feedforward) asked[v] = 0;
        asked[v] += c->stiffness[v] * error[v] + c->damping[v] * (program_rate[v] - rate[v]) + I[v];
    }
    for (int v = 0; v < 6 && c->coupled; v++) {
        for (int u = 0; u < 6; u++)
            asked[v] += c->cross_stiffness[v][u] * error[u] +
                        c->cross_damping[v][u] * (program_rate[u] - rate[u]);
    }
}

static gough_state state_of(const loop *y) {
    gough_state s;

    memcpy(s.position, y->p, sizeof s.position);
    memcpy(s.rotation, y->R, sizeof s.rotation);
    memcpy(s.velocity, y->v, sizeof s.velocity);
    memcpy(s.angular_velocity, y->w, sizeof s.angular_velocity);
    return s;
}

/* (act-1) with limits, İ of the theory, and the platform under the forces of the drives */
static void rates(const gough_model *m, double t, const loop *y, loop *out) {
    const gough_actuators *d = &m->machine.platform.actuators;
    const gough_state s = state_of(y);
    double asked[6], error[6], force[6];
    gough_acceleration a;

    ask(m, t, &s, y->I, asked, error);
    for (int v = 0; v < 6; v++) {
        const bool limited = d->max_force[v][0] < d->max_force[v][1];
        const double u =
            limited ? within(asked[v], d->max_force[v][0], d->max_force[v][1]) : asked[v];
        const double most = d->max_rate[v] > 0 ? d->max_rate[v] : INFINITY;
        const double omega = 2 * pi * d->frequency[v];
        const bool lags = d->kind == GOUGH_ACTUATOR_LAG, first = lags && d->time_constant[v] > 0;
        force[v] = lags ? y->f[v] : u;
        out->f[v] = first  ? within((u - y->f[v]) / d->time_constant[v], -most, most)
                    : lags ? y->h[v]
                           : 0;
        out->h[v] = lags && !first
                        ? omega * omega * (u - y->f[v]) - 2 * d->damping_ratio[v] * omega * y->h[v]
                        : 0;
        out->I[v] = m->control.integral[v] * error[v];
        if (m->control.tracking_time > 0 && m->control.integral[v] > 0)
            out->I[v] += (u - asked[v]) / m->control.tracking_time;
    }
    ck_assert_int_eq(gough_forward_dynamics(&m->machine, &s, force, NULL, &a), GOUGH_OK);
    memcpy(out->p, y->v, sizeof out->p);
    memcpy(out->v, a.linear, sizeof out->v);
    memcpy(out->w, a.angular, sizeof out->w);
    for (int column = 0; column < 3; column++) {
        const double e[3] = {y->R[column], y->R[3 + column], y->R[6 + column]};
        double turned[3];
        cross_product(y->w, e, turned);
        for (int r = 0; r < 3; r++) out->R[3 * r + column] = turned[r];
    }
}

static void add(const loop *y, double h, const loop *rate, loop *out) {
    const double *a = (const double *)y, *b = (const double *)rate;
    double *c = (double *)out;

    for (size_t i = 0; i < sizeof *y / sizeof *a; i++) c[i] = a[i] + h * b[i];
}

/* over a period, by the classical method of order 4 */
static loop pass(const gough_model *m, const gough_floquet *f, const loop *from) {
    const double h = f->period / STEPS;
    loop y = *from;

    for (int k = 0; k < STEPS; k++) {
        const double t = f->start + k * h;
        loop k1, k2, k3, k4, at;
        rates(m, t, &y, &k1);
        add(&y, h / 2, &k1, &at);
        rates(m, t + h / 2, &at, &k2);
        add(&y, h / 2, &k2, &at);
        rates(m, t + h / 2, &at, &k3);
        add(&y, h, &k3, &at);
        rates(m, t + h, &at, &k4);
        add(&y, h / 6, &k1, &y);
        add(&y, h / 3, &k2, &y);
        add(&y, h / 3, &k3, &y);
        add(&y, h / 6, &k4, &y);
    }
    return y;
}

/* ---- between it and deviations -------------------------------------------------------------------------------------- */

/* the place of a deviation's number behind the platform's in a loop's f, h, I */
static double *beyond(const gough_model *m, size_t i, loop *y) {
    char name[GOUGH_DEVIATION_NAME];
    gough_unit unit;

    ck_assert(gough_deviation_name(m, i, name, &unit));
    const int leg = name[strlen(name) - 1] - '1';
    return strncmp(name, "fdot", 4) == 0 ? &y->h[leg] : name[0] == 'f' ? &y->f[leg] : &y->I[leg];
}

static loop loop_of(const gough_model *m, const gough_floquet *f, const double *xi) {
    const gough_state s = changed(&m->machine, &f->state, xi);
    loop y = {.p = {0}};

    memcpy(y.p, s.position, sizeof y.p);
    memcpy(y.R, s.rotation, sizeof y.R);
    memcpy(y.v, s.velocity, sizeof y.v);
    memcpy(y.w, s.angular_velocity, sizeof y.w);
    for (size_t i = N; i < f->size; i++) *beyond(m, i, &y) = f->beyond[i - N] + xi[i];
    return y;
}

static void apart(const gough_model *m, const gough_floquet *f, const loop *a, const loop *b,
                  double *xi) {
    const gough_state s = state_of(a), u = state_of(b);
    loop x = *a, y = *b;

    difference(&m->machine, &s, &u, xi);
    for (size_t i = N; i < f->size; i++) xi[i] = *beyond(m, i, &y) - *beyond(m, i, &x);
}

static double size_of(const double *xi, size_t n) {
    double sum = 0;

    for (size_t i = 0; i < n; i++) sum += xi[i] * xi[i];
    return sqrt(sum);
}

/* ---- models --------------------------------------------------------------------------------------------------------- */

static const char *const heave[] = {"0", "0", "0.2*sin(t)", "0", "0", "0"};
static const char *const all[] = {"0.05*sin(t)",   "0.04*sin(2*t + 0.4)", "0.1*sin(t)",
                                  "0.08*sin(2*t)", "0.06*cos(t)",         "0.1*sin(3*t + 1)"};

typedef struct {
    const char *what;
    bool skew;
    const char *const *text;
    double G, D, integral, tracking, lag, frequency, force, rate;
    bool coupled, unfed;
} loop_case;

static const loop_case CASES[] = {
    {"a lag, damped", false, all, 3, 0.4, .lag = 0.05},
    {"a lag that wins over the damping", false, all, 3, 0.1, .lag = 0.05},
    {"a lag on a tongue of heave", false, heave, 0.15, 0.02, .lag = 0.03},
    {"a lag of second order", true, all, 4, 0.5, .frequency = 4},
    {"an integral", false, all, 4, 0.5, .integral = 1},
    {"an integral that grows", false, heave, 2, 0.1, .integral = 0.6},
    {"a lag and an integral", true, all, 5, 0.8, .integral = 2, .lag = 0.04},
    {"no feed-forward", true, all, 20, 1.5, .integral = 4, .lag = 0.02, .unfed = true},
    {"matrices of gains", false, all, 4, 0.5, .lag = 0.04, .coupled = true},
    {"rates of forces at their limit", false, all, 4, 0.5, .lag = 0.05, .rate = 0.55},
    {"forces at their limit", false, all, 4, 0.5, .lag = 0.05, .force = 0.37},
    {"ideal drives at their limit", false, all, 4, 0.5, .force = 0.35},
    {"limits and an integral", false, all, 4, 0.5, .force = 0.36, .integral = 1, .tracking = 0.5},
};

static gough_model *model_of(const loop_case *c) {
    gough_model *m = calloc(1, sizeof *m);
    gough_error error = {0};

    ck_assert(m != NULL);
    if (c->skew)
        skew_machine(&m->machine);
    else
        paper_machine(&m->machine);
    gough_platform p = m->machine.platform;
    const gough_load load = m->machine.load;
    const double gravity[3] = {m->machine.gravity[0], m->machine.gravity[1], m->machine.gravity[2]};
    if (c->lag > 0 || c->frequency > 0) p.actuators.kind = GOUGH_ACTUATOR_LAG;
    for (int v = 0; v < GOUGH_LEGS; v++) {
        p.actuators.time_constant[v] = c->lag;
        p.actuators.frequency[v] = c->frequency;
        p.actuators.damping_ratio[v] = c->frequency > 0 ? 0.6 : 0;
        p.actuators.max_rate[v] = c->rate;
        if (c->force > 0) p.actuators.max_force[v][0] = -1, p.actuators.max_force[v][1] = c->force;
        m->control.integral[v] = c->integral;
    }
    ck_assert_msg(gough_machine_init(&m->machine, &p, &load, gravity, &error) == GOUGH_OK, "%s",
                  error.message);
    m->control.feedforward = !c->unfed;
    m->control.tracking_time = c->tracking;
    set_gains(m, c->G, c->D);
    if (c->coupled) {
        m->control.coupled = true;
        m->control.cross_stiffness[0][1] = m->control.cross_stiffness[1][0] = 0.7;
        m->control.cross_stiffness[2][4] = -0.5;
        m->control.cross_damping[3][4] = 0.1;
    }
    for (int k = 0; k < GOUGH_COMPONENTS; k++) set_formula(&m->motion.formula[k], c->text[k]);
    return m;
}

static gough_floquet multipliers(const gough_model *m, const char *what) {
    gough_error error = {0};
    gough_floquet f;

    ck_assert_msg(gough_floquet_multipliers(m, NULL, 0, &f, &error) == GOUGH_OK, "%s: %s", what,
                  error.message);
    ck_assert_uint_eq(f.size, gough_linear_size(m));
    return f;
}

/* ---- claims --------------------------------------------------------------------------------------------------------- */

/* The motion found comes back in the test's own loop, drives and integrals included, and what a deviation in some direction becomes
 * there, by central differences, is what the matrix says. Errors of the steps of order 4 are near 1e-9; kinks, where a limit is
 * met, take their order. */
static void check_case(const loop_case *c, uint64_t seed) {
    const bool kinks = c->rate > 0 || c->force > 0;
    gough_model *m = model_of(c);
    const gough_floquet f = multipliers(m, c->what);
    const double none[MOST] = {0}, step = 2e-6;
    const loop at = loop_of(m, &f, none), after = pass(m, &f, &at);
    double xi[MOST], out[2][MOST];
    dice d = {seed};

    apart(m, &f, &at, &after, xi);
    ck_assert_msg(size_of(xi, f.size) <= (kinks ? 1e-6 : 5e-8) * (1 + f.growth), "%s: off by %g",
                  c->what, size_of(xi, f.size));
    for (int k = 0; k < 2; k++) {
        double predicted[MOST] = {0}, less[MOST];
        for (size_t i = 0; i < f.size; i++) xi[i] = dice_between(&d, -1, 1);
        for (size_t i = 0; i < f.size; i++)
            for (size_t j = 0; j < f.size; j++) predicted[i] += f.monodromy[i][j] * xi[j];
        for (size_t i = 0; i < f.size; i++) xi[i] *= step, less[i] = -xi[i];
        const loop more = loop_of(m, &f, xi), other = loop_of(m, &f, less);
        const loop plus = pass(m, &f, &more), minus = pass(m, &f, &other);
        apart(m, &f, &after, &plus, out[0]);
        apart(m, &f, &after, &minus, out[1]);
        for (size_t i = 0; i < f.size; i++)
            out[0][i] = (out[0][i] - out[1][i]) / (2 * step) - predicted[i];
        const double wrong = size_of(out[0], f.size) / size_of(predicted, f.size);
        ck_assert_msg(wrong <= (kinks ? 1e-2 : 1e-5), "%s: %g of it", c->what, wrong);
    }
    /* (floquet-5) where the decay of the drives leaves digits of it */
    ck_assert(isnan(f.pair_defect));
    ck_assert_msg(f.determinant_defect <= 1e-6, "%s: %g", c->what, f.determinant_defect);
    free(m);
}

START_TEST(the_motion_comes_back_and_deviations_go_as_predicted) {
    for (size_t k = 0; k < sizeof CASES / sizeof *CASES; k++) check_case(&CASES[k], 5 + k);
}
END_TEST

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

/* where a run from the state of the motion, whose drives begin with what is asked of them, is after some periods */
static gough_state run(const gough_model *model, const gough_floquet *f, int periods) {
    gough_simulation options = gough_simulation_default();
    gough_model *m = malloc(sizeof *m);
    gough_error error = {0};
    gough_state to;
    gough_end end;

    ck_assert(m != NULL);
    *m = *model;
    options.duration = options.output_step = periods * f->period;
    options.tolerance = 1e-13;
    gough_state from = f->state;
    gough_angles_from_rotation(from.rotation, m->initial.component + 3);
    for (int i = 0; i < 3; i++) {
        m->initial.component[i] = f->state.position[i] - (i == 2 ? m->machine.platform.height : 0);
        m->initial.velocity[i] = f->state.velocity[i];
        m->initial.angular_velocity[i] = f->state.angular_velocity[i];
    }
    for (int k = 0; k < GOUGH_COMPONENTS; k++) m->initial.given[k] = true;
    m->initial.velocity_given = m->initial.angular_velocity_given = true;
    ck_assert_msg(gough_simulate(m, &options, keep_last, &to, &end, &error) == GOUGH_OK, "%s%s",
                  error.message, end.message);
    free(m);
    return to;
}

/* The run's drives begin with what is asked of them and its integrals with 0, so the run is that far from the motion: after each
 * period its platform is where the powers of the matrix have it. Returns by how much the last difference exceeds the first. */
static double follow(const loop_case *c, int periods, double accuracy) {
    gough_model *m = model_of(c);
    const gough_floquet f = multipliers(m, c->what);
    const double none[MOST] = {0};
    double xi[MOST] = {0}, asked[6], error[6], first = 0, last = 0;
    loop begin = loop_of(m, &f, none), at = begin;

    memset(begin.I, 0, sizeof begin.I);
    ask(m, f.start, &f.state, begin.I, asked, error);
    memcpy(begin.f, asked, sizeof begin.f);
    memset(begin.h, 0, sizeof begin.h);
    apart(m, &f, &at, &begin, xi);
    for (int k = 1; k <= periods; k++) {
        double next[MOST] = {0}, found[N], wrong[N];
        for (size_t i = 0; i < f.size; i++)
            for (size_t j = 0; j < f.size; j++) next[i] += f.monodromy[i][j] * xi[j];
        memcpy(xi, next, sizeof xi);
        const gough_state s = run(m, &f, k);
        difference(&m->machine, &f.state, &s, found);
        for (int i = 0; i < N; i++) wrong[i] = found[i] - xi[i];
        last = size_of(found, N);
        if (k == 1) first = last;
        ck_assert_msg(size_of(wrong, N) <= accuracy * size_of(xi, N) + 1e-10,
                      "%s after %d periods: %g of %g", c->what, k, size_of(wrong, N),
                      size_of(xi, N));
    }
    free(m);
    return last / first;
}

START_TEST(runs_leave_the_motion_or_come_to_it_as_predicted) {
    const loop_case growing = {"growth by a lag", false, all, 3, 0.02, .lag = 0.01};

    const double more = follow(&growing, 8, 1e-3);
    const double less[] = {follow(&CASES[0], 5, 1e-2), follow(&CASES[3], 5, 1e-2),
                           follow(&CASES[8], 5, 1e-2)};

    ck_assert(more > 2);
    for (int k = 0; k < 3; k++) ck_assert(less[k] < 0.5);
}
END_TEST

/* with limits, from further off */
START_TEST(runs_with_limits_come_to_the_motion) {
    for (size_t k = 9; k < sizeof CASES / sizeof *CASES; k++) {
        const loop_case *c = &CASES[k];
        gough_model *m = model_of(c);
        const gough_floquet f = multipliers(m, c->what);
        const gough_state s = run(m, &f, 20);
        double xi[N];
        ck_assert_msg(f.stable, "%s: %g", c->what, f.growth);
        difference(&m->machine, &f.state, &s, xi);
        ck_assert_msg(size_of(xi, N) <= 1e-9 + 0.05 * pow(f.growth, 20), "%s: %g", c->what,
                      size_of(xi, N));
        free(m);
    }
}
END_TEST

int main(void) {
    return SUITE_RUN("floquet_states", 120, the_motion_comes_back_and_deviations_go_as_predicted,
                     runs_leave_the_motion_or_come_to_it_as_predicted,
                     runs_with_limits_come_to_the_motion);
}
