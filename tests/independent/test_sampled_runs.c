/* Runs of controllers that are sampled, late, counting, limited and integrating, and of drives that lag, against the same motion of
 * thirteen rigid bodies with a controller written anew from the book's equations, stepped from event to event.
 * Sanitized: campaign: independent/thirteen_bodies runs the same bodies under sanitizers.
 * Label: standard. */
#include <check.h>
#include <math.h>
#include <string.h>

#include "gough/random.h"
#include "gough/simulate.h"
#include "independent/studies.h"
#include "independent/thirteen_bodies.h"
#include "support/suite.h"

enum {
    ROTATION = 3,
    VELOCITY = 12,
    OMEGA = 15,
    DRIVE = 18,
    SUM = 30,
    STATES = 36,
    QUEUE = 128,
    COLUMNS = 4
};

/* steps of ideal drives, and of those that lag */
static const double LONGEST = 0.01, LAGS = 0.003;

static gough_model model; /* large */

/* what a case adds to the general study */
typedef struct option {
    const char *name;
    double period, delay, jitter, cutoff, resolution, noise, preview; /* of the samples */
    bool differences, heavy, coupled;
    double integral, tracking, most, lag, frequency, rate;
    double rise; /* of the velocity at the beginning, beyond the program's */
    double duration, tolerance;
} option;

static const option CASES[] = {
    {.name = "sampled", .period = 0.02, .duration = 4, .tolerance = 1e-9},
    {.name = "half a period late", .period = 0.02, .delay = 0.01, .duration = 2, .tolerance = 1e-9},
    {.name = "two and a third periods late, previewed",
     .period = 0.006,
     .delay = 0.014,
     .preview = 0.017,
     .duration = 2,
     .tolerance = 1e-9},
    {.name = "differences with a low pass",
     .period = 0.01,
     .delay = 0.01,
     .differences = true,
     .cutoff = 12,
     .duration = 2,
     .tolerance = 1e-9},
    {.name = "differences from a rate at the beginning",
     .period = 0.01,
     .differences = true,
     .cutoff = 12,
     .rise = 0.05,
     .duration = 1,
     .tolerance = 1e-9},
    {.name = "counts and noise",
     .period = 0.02,
     .delay = 0.005,
     .differences = true,
     .cutoff = 8,
     .resolution = 1e-4,
     .noise = 3e-5,
     .duration = 2,
     .tolerance = 1e-9},
    {.name = "integral that gives way to a limit",
     .period = 0.02,
     .integral = 60,
     .tracking = 0.3,
     .most = 0.4,
     .duration = 3,
     .tolerance = 1e-9},
    {.name = "matrices of gains",
     .period = 0.02,
     .coupled = true,
     .duration = 2,
     .tolerance = 1e-9},
    {.name = "jitter",
     .period = 0.02,
     .delay = 0.004,
     .jitter = 0.015,
     .duration = 2,
     .tolerance = 1e-9},
    {.name = "lag of first order, sampled",
     .period = 0.02,
     .delay = 0.01,
     .lag = 0.01,
     .duration = 2,
     .tolerance = 1e-9},
    {.name = "lag of second order, sampled",
     .period = 0.02,
     .frequency = 15,
     .duration = 2,
     .tolerance = 1e-9},
    {.name = "lag of first order, continuous", .lag = 0.02, .duration = 3, .tolerance = 1e-9},
    {.name = "lag of second order, integral and matrices, continuous",
     .frequency = 10,
     .integral = 40,
     .coupled = true,
     .duration = 3,
     .tolerance = 1e-9},
    {.name = "all at once",
     .period = 0.02,
     .delay = 0.013,
     .differences = true,
     .cutoff = 10,
     .resolution = 1e-4,
     .noise = 2e-5,
     .preview = 0.023,
     .heavy = true,
     .coupled = true,
     .integral = 30,
     .tracking = 0.5,
     .most = 0.45,
     .lag = 0.01,
     .duration = 3,
     .tolerance = 1e-9},
    {.name = "a limit of the rate of force",
     .period = 0.02,
     .lag = 0.005,
     .rate = 1.5,
     .duration = 1,
     .tolerance = 1e-9},
};

/* the second formulation on its way */
typedef struct second {
    const option *o;
    thirteen_bodies bodies;
    double state[STATES], time;
    double error[6], slope[6], integral[6], held[6], queue[QUEUE][6];
    long long looks, acts;
    double pose, rate, force, command;
    int rows;
} second;

static double worse(double worst, double difference) {
    const double size = fabs(difference);
    return size <= worst ? worst : size; /* not a number replaces anything */
}

static double clamped(double x, double most) { return fmin(fmax(x, -most), most); }

static double program_of(const second *c, double t, double force[6], double length[6],
                         double rate[6]) {
    gough_state state;
    gough_acceleration acceleration;
    bodies_instant now;
    gough_program(&model.machine, &model.motion, t, &state, &acceleration);
    bodies_inverse(&c->bodies, &state, &acceleration, NULL, &now);
    memcpy(force, now.drive, sizeof now.drive);
    memcpy(length, now.length, sizeof now.length);
    memcpy(rate, now.rate, sizeof now.rate);
    return t;
}

static gough_state state_of(const double y[STATES]) {
    gough_state s;
    memcpy(s.position, y, sizeof s.position);
    memcpy(s.rotation, y + ROTATION, sizeof s.rotation);
    memcpy(s.velocity, y + VELOCITY, sizeof s.velocity);
    memcpy(s.angular_velocity, y + OMEGA, sizeof s.angular_velocity);
    return s;
}

static double gain(const double diagonal[6], double cross[6][6], int row, const double x[6]) {
    double sum = diagonal[row] * x[row];
    for (int k = 0; k < 6; k++) sum += cross[row][k] * x[k];
    return sum;
}

/* what a continuous controller commands, and its unlimited wish */
static void continuous(const second *c, double t, const double y[STATES], double wish[6],
                       double error[6]) {
    const gough_state state = state_of(y);
    double force[6], length[6], rate[6], l[6], dl[6], slope[6];
    program_of(c, t, force, length, rate);
    bodies_lengths(&c->bodies, &state, l, dl);
    for (int k = 0; k < 6; k++) error[k] = length[k] - l[k], slope[k] = rate[k] - dl[k];
    for (int k = 0; k < 6; k++) {
        wish[k] = force[k] +
                  gain(model.control.stiffness, model.control.cross_stiffness, k, error) +
                  gain(model.control.damping, model.control.cross_damping, k, slope) + y[SUM + k];
    }
}

static void derivative(const second *c, double t, const double y[STATES], double out[STATES],
                       double drive[6], double u[6]) {
    const option *o = c->o;
    const gough_state state = state_of(y);
    const double *omega = y + OMEGA, *R = y + ROTATION;
    newton_real leg[6], unused, force[3], moment[3];
    double error[6] = {0}, wish[6];
    gough_wrench external;
    bodies_instant now;
    memset(out, 0, STATES * sizeof *out);
    general_disturbance((newton_real)t, leg, &unused, force, moment);
    if (o->period > 0) {
        memcpy(u, c->held, sizeof c->held);
    } else {
        continuous(c, t, y, wish, error);
        for (int k = 0; k < 6; k++) u[k] = o->most > 0 ? clamped(wish[k], o->most) : wish[k];
    }
    for (int k = 0; k < 6; k++) {
        double f = u[k];
        if (o->lag > 0) {
            const double rate = (u[k] - y[DRIVE + k]) / o->lag;
            f = y[DRIVE + k];
            out[DRIVE + k] = o->rate > 0 ? clamped(rate, o->rate) : rate;
        } else if (o->frequency > 0) {
            const double w = 2 * 3.14159265358979323846 * o->frequency;
            f = y[DRIVE + k];
            out[DRIVE + k] = y[DRIVE + 6 + k];
            out[DRIVE + 6 + k] = w * w * (u[k] - f) - 2 * 0.6 * w * y[DRIVE + 6 + k];
        }
        drive[k] = f + (double)leg[k];
        if (o->period <= 0 && o->integral > 0) out[SUM + k] = o->integral * error[k];
    }
    for (int i = 0; i < 3; i++) {
        external.force[i] = (double)force[i];
        external.moment[i] = (double)moment[i];
    }
    bodies_forward(&c->bodies, &state, drive, &external, &now);
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        out[i] = y[VELOCITY + i];
        out[VELOCITY + i] = now.top.linear[i];
        out[OMEGA + i] = now.top.angular[i];
        for (int n = 0; n < 3; n++)
            out[ROTATION + 3 * i + n] = omega[j] * R[3 * k + n] - omega[k] * R[3 * j + n];
    }
}

/* y after a time h by the midpoint rule in so many parts; slope: the rates at the beginning */
static void midpoints(const second *c, double t, double h, int parts, const double slope[STATES],
                      double y[STATES]) {
    const double part = h / parts;
    double before[STATES], now[STATES], rate[STATES], drive[6], u[6];
    memcpy(before, c->state, sizeof before);
    for (int i = 0; i < STATES; i++) now[i] = before[i] + part * slope[i];
    for (int k = 1; k < parts; k++) {
        derivative(c, t + k * part, now, rate, drive, u);
        for (int i = 0; i < STATES; i++) {
            const double next = before[i] + 2 * part * rate[i];
            before[i] = now[i];
            now[i] = next;
        }
    }
    derivative(c, t + h, now, rate, drive, u);
    for (int i = 0; i < STATES; i++) y[i] = (now[i] + before[i] + part * rate[i]) / 2;
}

/* of order 8: midpoint rules in 2, 4, 6 and 8 parts, extrapolated to parts of no length */
static void step(second *c, double t, double h) {
    double row[COLUMNS][STATES], slope[STATES], drive[6], u[6];
    derivative(c, t, c->state, slope, drive, u);
    for (int k = 0; k < COLUMNS; k++) {
        midpoints(c, t, h, 2 * (k + 1), slope, row[k]);
        for (int n = k - 1; n >= 0; n--) { /* Neville, in squares of the parts */
            const double ratio = (double)((k + 1) * (k + 1)) / ((n + 1) * (n + 1)) - 1;
            for (int i = 0; i < STATES; i++)
                row[n][i] = row[n + 1][i] + (row[n + 1][i] - row[n][i]) / ratio;
        }
    }
    memcpy(c->state, row[0], sizeof row[0]);
}

static void straight(second *c, double to) {
    const double from = c->time, longest = c->o->lag > 0 || c->o->frequency > 0 ? LAGS : LONGEST;
    const int steps = (int)ceil((to - from) / longest - 1e-9);
    for (int n = 0; n < steps; n++) step(c, from + (to - from) / steps * n, (to - from) / steps);
    c->time = to;
}

/* Rates of force change smoothly but where a drive comes within rate T_a of its held command, until which its force changes at
 * the greatest rate: no step goes over such times. */
static void move(second *c, double to) {
    const option *o = c->o;
    while (o->rate > 0) {
        double next = to;
        for (int k = 0; k < 6; k++) {
            const double far = fabs(c->held[k] - c->state[DRIVE + k]) - o->rate * o->lag;
            const double t = c->time + far / o->rate;
            if (t > c->time + 1e-14 && t < next) next = t;
        }
        if (!(next < to)) break;
        straight(c, next);
    }
    straight(c, to);
}

/* one sample, (loop-1) */
static void look(second *c) {
    const option *o = c->o;
    const double t = c->time, T = o->period;
    const double alpha = o->cutoff > 0 ? exp(-2 * 3.14159265358979323846 * o->cutoff * T) : 0;
    const gough_state state = state_of(c->state);
    double force[6], length[6], rate[6], ahead[6], l[6], dl[6], e[6], slope[6], r[6];
    double *u = c->queue[c->looks % QUEUE];
    program_of(c, t + o->preview, force, ahead, rate);
    program_of(c, t, ahead, length, rate);
    bodies_lengths(&c->bodies, &state, l, dl);
    for (int k = 0; k < 6; k++) {
        const double home = model.machine.home_length[k];
        const uint64_t draw = ((uint64_t)1 << 62) + (uint64_t)k + 6 * (uint64_t)c->looks;
        double seen = l[k];
        if (o->noise > 0) seen += o->noise * gough_random_normal(7, 3, draw);
        if (o->resolution > 0)
            seen = home + o->resolution * floor((seen - home) / o->resolution + 0.5);
        e[k] = length[k] - seen;
        slope[k] = rate[k] - dl[k];
        if (o->differences && c->looks == 0) {
            c->slope[k] = slope[k];
            c->error[k] = e[k] - T * slope[k];
        }
        if (o->differences) slope[k] = alpha * c->slope[k] + (1 - alpha) / T * (e[k] - c->error[k]);
        c->slope[k] = slope[k];
        c->error[k] = e[k];
    }
    for (int k = 0; k < 6; k++) {
        r[k] = force[k] + gain(model.control.stiffness, model.control.cross_stiffness, k, e) +
               gain(model.control.damping, model.control.cross_damping, k, slope) + c->integral[k];
        u[k] = o->most > 0 ? clamped(r[k], o->most) : r[k];
        if (o->integral > 0) c->integral[k] += o->integral * T * e[k];
        if (o->tracking > 0) c->integral[k] += (u[k] - r[k]) * T / o->tracking;
    }
    c->looks++;
}

static double act_time(const second *c) {
    const option *o = c->o;
    const double t = (double)c->acts * o->period + o->delay;
    if (!(o->jitter > 0)) return t;
    return t + o->jitter * gough_random_uniform(7, 3, ((uint64_t)1 << 63) + (uint64_t)c->acts);
}

/* all that happens before t, and at t too if `with` */
static void events(second *c, double t, bool with) {
    const double slack = 1e-7 * c->o->period; /* times that rounding tells apart are one */
    if (!(c->o->period > 0)) return;
    for (;;) {
        const double looking = (double)c->looks * c->o->period, acting = act_time(c);
        const double next = fmin(looking, acting);
        if (with ? next > t + slack : next > t - slack) return;
        if (next > c->time) move(c, next);
        if (looking <= acting + slack) {
            look(c);
        } else {
            memcpy(c->held, c->queue[c->acts % QUEUE], sizeof c->held);
            c->acts++;
        }
    }
}

static gough_sampling sampling_of(const option *o) {
    return (gough_sampling){.period = o->period,
                            .delay = o->delay,
                            .jitter = o->jitter,
                            .velocity =
                                o->differences ? GOUGH_VELOCITY_DIFFERENCE : GOUGH_VELOCITY_EXACT,
                            .cutoff = o->cutoff,
                            .resolution = o->resolution,
                            .noise = o->noise,
                            .seed = 7,
                            .run = 3,
                            .preview = o->preview};
}

static void start(second *c, const option *o) {
    gough_error error = {.message = ""};
    gough_acceleration unused;
    gough_state state;
    double drive[6], out[STATES], wish[6];
    memset(c, 0, sizeof *c);
    c->o = o;
    general_study(&model, NULL, true, 50, 2);
    model.disturbance.vertical_force = gough_formula_constant(0);
    gough_platform p = model.machine.platform;
    c->bodies.load = model.machine.load;
    memcpy(c->bodies.gravity, model.machine.gravity, sizeof c->bodies.gravity);
    for (int k = 0; k < 6; k++) {
        if (o->most > 0)
            p.actuators.max_force[k][1] = o->most, p.actuators.max_force[k][0] = -o->most;
        if (o->lag > 0 || o->frequency > 0) p.actuators.kind = GOUGH_ACTUATOR_LAG;
        p.actuators.time_constant[k] = o->lag;
        p.actuators.frequency[k] = o->frequency;
        p.actuators.damping_ratio[k] = o->frequency > 0 ? 0.6 : 0;
        p.actuators.max_rate[k] = o->rate;
        model.control.integral[k] = o->integral;
        for (int n = 0; n < 6 && o->coupled; n++) {
            model.control.cross_stiffness[k][n] = k == n ? 0 : 3 * sin(1 + k + 2 * n);
            model.control.cross_damping[k][n] = k == n ? 0 : 0.1 * cos(3 * k + n);
        }
        if (!o->heavy) continue;
        p.cylinder.mass[k] = 0.06 + 0.01 * k;
        p.cylinder.center[k] = 0.35 - 0.1 * k;
        p.cylinder.inertia[k] = 0.004 + 0.002 * k;
        p.piston.mass[k] = 0.05 - 0.005 * k;
        p.piston.center[k] = 0.45 - 0.05 * k;
        p.piston.inertia[k] = 0.001 * k;
        p.reflected_mass[k] = 0.1 + 0.05 * k;
        p.friction.viscous[k] = 0.02 * k;
    }
    c->bodies.platform = p;
    ck_assert_msg(gough_machine_init(&model.machine, &p, &c->bodies.load, c->bodies.gravity,
                                     &error) == GOUGH_OK,
                  "%s", error.message);
    model.control.coupled = o->coupled;
    model.control.tracking_time = o->tracking;
    model.control.sampling = sampling_of(o);
    gough_program(&model.machine, &model.motion, 0, &state, &unused);
    memcpy(c->state, state.position, sizeof state.position);
    memcpy(c->state + ROTATION, state.rotation, sizeof state.rotation);
    state.velocity[2] += o->rise;
    model.initial.velocity_given = o->rise > 0;
    memcpy(model.initial.velocity, state.velocity, sizeof state.velocity);
    memcpy(c->state + VELOCITY, state.velocity, sizeof state.velocity);
    memcpy(c->state + OMEGA, state.angular_velocity, sizeof state.angular_velocity);
    if (o->period > 0) {
        look(c);
        memcpy(c->held, c->queue[0], sizeof c->held);
        events(c, 0, true);
    }
    derivative(c, 0, c->state, out, drive, wish);
    memcpy(c->state + DRIVE, wish, sizeof wish);
}

static int compare_row(void *context, const gough_row *row) {
    second *c = context;
    const double *v = row->value,
                 angle[3] = {v[GOUGH_ROLL_ANGLE], v[GOUGH_PITCH_ANGLE], v[GOUGH_YAW_ANGLE]};
    double R[3][3], out[STATES], drive[6], u[6];
    if (c->rows > 0) { /* the first row shows the loop at its beginning */
        events(c, v[GOUGH_T], false);
        if (v[GOUGH_T] > c->time) move(c, v[GOUGH_T]);
    }
    derivative(c, c->time, c->state, out, drive, u);
    gough_rotation_from_angles(angle, R);
    for (int i = 0; i < 3; i++) {
        c->pose = worse(c->pose, v[GOUGH_X + i] - c->state[i]);
        c->rate = worse(c->rate, v[GOUGH_VX + i] - c->state[VELOCITY + i]);
        c->rate = worse(c->rate, v[GOUGH_WX + i] - c->state[OMEGA + i]);
        for (int j = 0; j < 3; j++)
            c->pose = worse(c->pose, R[i][j] - c->state[ROTATION + 3 * i + j]);
    }
    for (int k = 0; k < 6; k++) {
        c->force = worse(c->force, v[GOUGH_F + k] - drive[k]);
        c->command = worse(c->command, v[GOUGH_U + k] - u[k]);
    }
    c->rows++;
    return 0;
}

START_TEST(sampled_and_lagging_loops_agree) {
    const option *o = &CASES[_i];
    gough_end end;
    gough_error error = {.message = ""};
    static second c;
    start(&c, o);
    gough_simulation options = gough_simulation_default();
    options.duration = o->duration;
    options.tolerance = 1e-12;
    options.commands = true;
    const gough_status status = gough_simulate(&model, &options, compare_row, &c, &end, &error);
    ck_assert_msg(status == GOUGH_OK, "%s: %s%s", o->name, error.message, end.message);
    ck_assert_int_eq(c.rows, (int)lrint(o->duration / options.output_step) + 1);
    const double right = o->tolerance;
    ck_assert_msg(c.pose <= right && c.rate <= 10 * right && c.force <= 100 * right &&
                      c.command <= 100 * right,
                  "%s: poses differ by %g, rates by %g, drive forces by %g, commands by %g",
                  o->name, c.pose, c.rate, c.force, c.command);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("sampled_runs");
    TCase *cases = tcase_create("sampled_runs");
    SRunner *runner = srunner_create(suite);
    tcase_set_timeout(cases, 120);
    tcase_add_loop_test(cases, sampled_and_lagging_loops_agree, 0,
                        (int)(sizeof CASES / sizeof CASES[0]));
    suite_add_tcase(suite, cases);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
