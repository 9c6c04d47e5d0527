/* One mode under a sampled controller: against closed forms of its windows, its characteristic polynomials, and the rule of the
 * controller written out for one leg. */
#include <stdio.h>

#include "linear/one_mode.h"
#include "support/random.h"
#include "support/suite.h"

enum { MODES = 10000 };

static gough_control controller(double T, double delay, gough_velocity velocity) {
    return (gough_control){.sampling = {.period = T, .delay = delay, .velocity = velocity}};
}

/* ---- windows of one mode --------------------------------------------------------------------------------------- */

/* (loop-3), λ² of either sign */
static bool holds_at_once(double square, double g, double c, double T) {
    const double rate = sqrt(fabs(square));
    const double edge = square > 0 ? rate / tanh(rate * T / 2) : rate / tan(rate * T / 2);

    return square < g && g < c * edge && c < edge;
}

/* (loop-4) */
static bool holds_after_a_period(double square, double g, double c, double T) {
    const double gamma = g * T * T / 2, chi = c * T;

    (void)square;
    return g > 0 && chi - gamma < 1 && chi > 3 * gamma + (chi - gamma) * (chi - gamma);
}

/* (loop-5) */
static bool holds_by_differences(double square, double g, double c, double T) {
    const double gamma = g * T * T / 2, chi = c * T;

    (void)square;
    return gamma > 0 && gamma < chi * (2 - chi) / (2 + chi) && chi < 2;
}

/* as many modes, six at a time; `still`: λ = 0, and delays of so many periods */
static void compare(bool holds(double, double, double, double), bool still, double periods,
                    gough_velocity velocity, uint64_t seed) {
    dice d = {seed};
    int stable = 0;

    printf("seed %llu\n", (unsigned long long)seed);
    for (int k = 0; k < MODES; k += 6) {
        const double T = pow(10, dice_between(&d, -2, 1));
        gough_control control = controller(T, periods * T, velocity);
        double square[6];
        sampled_plant plant;
        sampled_map all, one;

        for (int v = 0; v < 6; v++) {
            const double rate = dice_between(&d, 0, 3) / T;
            square[v] = still ? 0 : (v % 2 ? 1 : -1) * rate * rate;
            control.damping[v] = dice_between(&d, -0.2, 2.5) / T;
            control.stiffness[v] =
                (still ? 0 : square[v]) + dice_between(&d, -0.2, 1) * (v < 3 ? 4 : 0.7) / (T * T);
        }
        modes_plant(square, &plant);
        modes_map(&plant, &control, &all);
        for (int v = 0; v < 6; v++) {
            const bool right = holds(square[v], control.stiffness[v], control.damping[v], T);
            mode_map(&all, v, &one);
            if ((sampled_radius(&one) < 1) != right)
                ck_abort_msg("λ² %.17g, g %.17g, c %.17g, T %.17g: |μ| %.17g", square[v],
                             control.stiffness[v], control.damping[v], T, sampled_radius(&one));
            stable += right;
        }
    }
    ck_assert_int_gt(stable, MODES / 100);
}

START_TEST(window_without_delay) { compare(holds_at_once, false, 0, GOUGH_VELOCITY_EXACT, 3); }
END_TEST

START_TEST(window_after_a_period) {
    compare(holds_after_a_period, true, 1, GOUGH_VELOCITY_EXACT, 4);
}
END_TEST

START_TEST(window_by_differences) {
    compare(holds_by_differences, true, 0, GOUGH_VELOCITY_DIFFERENCE, 5);
}
END_TEST

/* ---- the largest stiffness, over all dampings ------------------------------------------------------------------ */

/* one resting mode over a period of 1, with a delay of so many */
typedef struct {
    gough_control control;
    sampled_plant plant;
    sampled_step step;
} resting;

static void rest_with(double periods, gough_velocity velocity, resting *r) {
    const double square[6] = {0};

    r->control = controller(1, periods, velocity);
    modes_plant(square, &r->plant);
    ck_assert(sampled_step_of(&r->plant, 1, periods, &r->step));
}

static double radius_of(resting *r, double g, double c) {
    sampled_law law;
    sampled_map all, one;

    r->control.stiffness[0] = g;
    r->control.damping[0] = c;
    sampled_law_of(&r->control, &law);
    sampled_map_of(&r->plant, &r->step, &law, &all);
    mode_map(&all, 0, &one);
    return sampled_radius(&one);
}

/* the upper edge of g at c by bisection, from a stable g */
static double upper_edge(resting *r, double c) {
    double low = 1e-6, high = 5;

    if (!(radius_of(r, low, c) < 1)) return 0;
    for (int k = 0; k < 34; k++) {
        const double middle = 0.5 * (low + high);
        if (radius_of(r, middle, c) < 1)
            low = middle;
        else
            high = middle;
    }
    return low;
}

static double largest(resting *r, double *damping) {
    const double share = 0.6180339887498949;
    double a = 0.05, b = 1.2, x = b - share * (b - a), y = a + share * (b - a);
    double at_x = upper_edge(r, x), at_y = upper_edge(r, y);

    for (int k = 0; k < 42; k++) {
        if (at_x > at_y) {
            b = y, y = x, at_y = at_x;
            x = b - share * (b - a), at_x = upper_edge(r, x);
        } else {
            a = x, x = y, at_x = at_y;
            y = a + share * (b - a), at_y = upper_edge(r, y);
        }
    }
    *damping = 0.5 * (a + b);
    return upper_edge(r, *damping);
}

START_TEST(largest_stiffness_of_one_mode) {
    const struct {
        double periods;
        gough_velocity velocity;
        double g, c; /* c 0: not known in closed form */
        double tolerance;
    } row[] = {
        {0.5, GOUGH_VELOCITY_EXACT, 8 * (2 - sqrt(3)) * (2 - sqrt(3)), 8 - 4 * sqrt(3), 1e-9},
        {1, GOUGH_VELOCITY_EXACT, 0.25, 0.625, 1e-9},
        {1.5, GOUGH_VELOCITY_EXACT, 0.139079, 0, 5e-7},
        {2, GOUGH_VELOCITY_EXACT, 0.088662, 0, 5e-7},
        {0, GOUGH_VELOCITY_DIFFERENCE, 12 - 8 * sqrt(2), 2 * sqrt(2) - 2, 1e-9},
        {0.5, GOUGH_VELOCITY_DIFFERENCE, 0.266964, 0, 5e-7},
        {1, GOUGH_VELOCITY_DIFFERENCE, 0.144469, 0.424694, 5e-7},
        {1.5, GOUGH_VELOCITY_DIFFERENCE, 0.090757, 0, 5e-7},
        {2, GOUGH_VELOCITY_DIFFERENCE, 0.062430, 0, 5e-7}};

    for (size_t k = 0; k < sizeof row / sizeof *row; k++) {
        resting r;
        double c;
        rest_with(row[k].periods, row[k].velocity, &r);
        const double g = largest(&r, &c);
        ck_assert_msg(fabs(g - row[k].g) <= row[k].tolerance, "row %zu: g %.12g, not %.12g", k, g,
                      row[k].g);
        /* g is smooth there or has a corner: c to the root of g's digits at least */
        if (row[k].c > 0)
            ck_assert_msg(fabs(c - row[k].c) <= 3e-5, "row %zu: c %.12g, not %.12g", k, c,
                          row[k].c);
    }
    resting r;
    rest_with(0, GOUGH_VELOCITY_EXACT, &r);
    ck_assert(upper_edge(&r, 2 - 1e-6) > 4 - 1e-5);
}
END_TEST

/* ---- characteristic polynomials -------------------------------------------------------------------------------- */

START_TEST(characteristic_polynomials_of_one_mode) {
    dice d = {6};

    for (int k = 0; k < 200; k++) {
        const double T = pow(10, dice_between(&d, -2, 1)), still[6] = {0};
        const double g = dice_between(&d, -1, 3) / (T * T), c = dice_between(&d, -1, 3) / T;
        const double gamma = g * T * T / 2, chi = c * T, z = dice_between(&d, -2, 2);
        const double right[3] = {
            ((z - 2) * z + 1 + gamma + chi) * z + gamma - chi,
            ((z + gamma + chi / 2 - 2) * z + 1 + gamma) * z - chi / 2,
            (((z - 2) * z + 1 + gamma + chi / 2) * z + gamma) * z - chi / 2,
        };

        for (int which = 0; which < 3; which++) {
            gough_control control =
                controller(T, which == 1 ? 0 : T,
                           which == 0 ? GOUGH_VELOCITY_EXACT : GOUGH_VELOCITY_DIFFERENCE);
            sampled_plant plant;
            sampled_map all, one;

            control.stiffness[2] = g, control.damping[2] = c;
            modes_plant(still, &plant);
            modes_map(&plant, &control, &all);
            mode_map(&all, 2, &one);
            ck_assert_int_eq(one.n, which == 2 ? 4 : 3);
            ck_assert_msg(fabs(characteristic(&one, z) - right[which]) <= 1e-12,
                          "%d: T %g, g %g, c %g, z %g: %.17g, not %.17g", which, T, g, c, z,
                          characteristic(&one, z), right[which]);
        }
    }
}
END_TEST

/* det = 1 + g (C − 1)/λ² − c S of (loop-3) */
START_TEST(determinant_of_one_sample) {
    dice d = {7};

    for (int k = 0; k < 200; k++) {
        const double T = pow(10, dice_between(&d, -2, 0)), rate = dice_between(&d, 0.1, 2) / T;
        const double square[6] = {rate * rate}, g = dice_between(&d, -1, 3) / (T * T),
                     c = dice_between(&d, -1, 3) / T;
        const double right = 1 + g * (cosh(rate * T) - 1) / square[0] - c * sinh(rate * T) / rate;
        gough_control control = controller(T, 0, GOUGH_VELOCITY_EXACT);
        sampled_plant plant;
        sampled_map all, one;

        control.stiffness[0] = g, control.damping[0] = c;
        modes_plant(square, &plant);
        modes_map(&plant, &control, &all);
        mode_map(&all, 0, &one);
        ck_assert(one.n == 2);
        const double *m = one.matrix;
        ck_assert_msg(fabs(m[0] * m[3] - m[1] * m[2] - right) <= 1e-12 * (1 + fabs(right)),
                      "%.17g, not %.17g", m[0] * m[3] - m[1] * m[2], right);
    }
}
END_TEST

/* ---- the rule of the controller, written out for one leg ------------------------------------------------------- */

/* all that one mode with its controller remembers */
typedef struct {
    double x, v, f, error, rate, sum, command[16]; /* command[k]: given k + 1 samples ago */
} one_leg;

/* ẍ = λ²x + f with f = u, or f after a lag T_a, over a time: from the particular solution and what decays to it */
static void move(one_leg *s, double square, double lag, double u, double time) {
    const double a = sqrt(square), C = cosh(a * time), S = sinh(a * time) / a;
    const double hold = (C - 1) / square, fade = lag > 0 ? exp(-time / lag) : 0;
    /* f = u + (f₀ − u) e^{−t/T_a}: the second part drives p e^{−t/T_a}, p (1/T_a² − λ²) = f₀ − u */
    const double p = lag > 0 ? (s->f - u) / (1 / (lag * lag) - square) : 0;
    const double x0 = s->x - p, v0 = s->v + (lag > 0 ? p / lag : 0);

    s->x = C * x0 + S * v0 + hold * u + p * fade;
    s->v = square * S * x0 + C * v0 + S * u - (lag > 0 ? p / lag * fade : 0);
    if (lag > 0) s->f = u + (s->f - u) * fade;
}

static void sample(one_leg *s, const gough_control *c, double square, double lag) {
    const gough_sampling *p = &c->sampling;
    const double T = p->period, alpha = p->cutoff > 0 ? exp(-2 * acos(-1) * p->cutoff * T) : 0;
    const int whole = (int)(p->delay / T + 1e-9);
    const double rest = p->delay - whole * T > 1e-9 * T ? p->delay - whole * T : 0;
    const double e = -s->x;
    const double rate = p->velocity == GOUGH_VELOCITY_EXACT
                            ? -s->v
                            : alpha * s->rate + (1 - alpha) * (e - s->error) / T;
    const double u = c->stiffness[0] * e + c->damping[0] * rate + s->sum;

    for (int k = 15; k > 0; k--) s->command[k] = s->command[k - 1];
    s->command[0] = u;
    if (rest > 0) move(s, square, lag, s->command[whole + 1], rest);
    move(s, square, lag, s->command[whole], T - rest);
    s->sum += c->integral[0] * T * e;
    s->error = e;
    s->rate = rate;
}

START_TEST(map_is_the_rule_of_the_controller) {
    dice d = {8};

    for (int k = 0; k < 400; k++) {
        const double T = pow(10, dice_between(&d, -2, 0)), rate = dice_between(&d, 0.2, 1.5) / T;
        const double delay = T * (k % 3 ? dice_between(&d, 0, 5) : k % 6);
        const double lag = k % 4 == 1 ? T * dice_between(&d, 0.05, 0.6) : 0;
        const double square[6] = {rate * rate, 1, 1, 1, 1, 1};
        gough_control c =
            controller(T, delay, k % 2 ? GOUGH_VELOCITY_DIFFERENCE : GOUGH_VELOCITY_EXACT);
        one_leg s = {0};
        sampled_plant plant;
        sampled_map all, one;
        double state[32] = {0}, after[32] = {0};
        int n = 0;

        if (k % 5 == 0) c.sampling.cutoff = dice_between(&d, 0.02, 0.4) / T;
        for (int v = 0; v < 6 && k % 7 == 0; v++) c.integral[v] = 0.1 / (T * T * T);
        c.stiffness[0] = dice_between(&d, -1, 3) / (T * T);
        c.damping[0] = dice_between(&d, -1, 3) / T;
        modes_plant(square, &plant);
        if (lag > 0) modes_lag(lag, &plant);
        modes_map(&plant, &c, &all);
        mode_map(&all, 0, &one);

        /* in the order of the map: x, v, f, e, ė, I, commands */
        const bool differences = k % 2, low_pass = differences && c.sampling.cutoff > 0;
        const int waiting = (int)ceil(delay / T - 1e-9);
        const struct {
            bool used;
            double *number;
        } part[6] = {{true, &s.x},        {true, &s.v},
                     {lag > 0, &s.f},     {differences, &s.error},
                     {low_pass, &s.rate}, {c.integral[0] > 0, &s.sum}};
        for (int i = 0; i < 6; i++)
            if (part[i].used) state[n++] = *part[i].number = dice_between(&d, -1, 1);
        for (int i = 0; i < waiting; i++) state[n++] = s.command[i] = dice_between(&d, -1, 1);
        ck_assert_int_eq(n, one.n);
        for (int i = 0; i < n; i++) {
            for (int j = 0; j < n; j++) after[i] += one.matrix[n * i + j] * state[j];
        }
        sample(&s, &c, square[0], lag);
        n = 0;
        for (int i = 0; i < 6 + waiting; i++) {
            if (i < 6 && !part[i].used) continue;
            const double right = i < 6 ? *part[i].number : s.command[i - 6];
            ck_assert_msg(fabs(after[n] - right) <= 1e-11 * (1 + fabs(right)) / (T * T),
                          "case %d, number %d: %.17g, not %.17g", k, i, after[n], right);
            n++;
        }
    }
}
END_TEST

int main(void) {
    return SUITE_RUN("linear/sampled_modes", 60, window_without_delay, window_after_a_period,
                     window_by_differences, largest_stiffness_of_one_mode,
                     characteristic_polynomials_of_one_mode, determinant_of_one_sample,
                     map_is_the_rule_of_the_controller);
}
