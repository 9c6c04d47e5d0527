/* The washout filter against closed forms, and against a filter of another formulation: sums over poles in long double,
 * rotations as products of three matrices, rates of angles by the inverse of a matrix. */
#include <complex.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "gough/cueing.h"
#include "support/suite.h"
#include "support/xorshift.h"

static const double G = 9.80665, TURN = 6.283185307179586477;

static void begin(gough_cueing *q, const gough_washout *w, double period) {
    gough_error error = {.message = ""};
    ck_assert_msg(gough_cueing_begin(q, sizeof *q, w, period, &error) == GOUGH_OK, "%s",
                  error.message);
}

/* an assertion that holds takes some microseconds too */
static void sample(gough_cueing *q, const double force[3], const double rate[3], gough_cue *cue) {
    gough_error error = {.message = ""};
    if (gough_cueing_sample(q, force, rate, cue, &error)) ck_abort_msg("%s", error.message);
}

/* the greater of both; NaN stays */
static void widen(double *most, double value) {
    if (!(value <= *most)) *most = value;
}

static const double no_rate[3] = {0, 0, 0};

/* ---- closed forms ---- */

START_TEST(a_step_of_heave_is_the_closed_form) {
    gough_washout w = gough_washout_default(G, 1);
    gough_cueing q;
    gough_cue cue;
    const double step = 0.37, h = 0.01, fast = TURN * w.frequency[2], slow = TURN * w.washout[2];
    const double force[3] = {0, 0, G + step / w.force_gain[2]};
    double apart = 0;
    begin(&q, &w, h);
    for (int k = 0; k < 3000; k++) {
        sample(&q, force, no_rate, &cue);
        const double t = k * h, d = fast - slow;
        const double x = step * (exp(-slow * t) - exp(-fast * t) * (1 + d * t)) / (d * d);
        widen(&apart, fabs(cue.component[GOUGH_HEAVE] - x));
        widen(&apart, fabs(cue.component[GOUGH_SURGE]));
    }
    ck_assert_double_le(apart, 1e-14);
    ck_assert_double_eq_tol(cue.acceleration[2],
                            step * (slow * slow * exp(-slow * 29.99) / pow(fast - slow, 2)), 1e-14);
}
END_TEST

START_TEST(what_lasts_is_felt_by_leaning) {
    for (int axis = 0; axis < 2; axis++) {
        gough_washout w = gough_washout_default(G, 1);
        gough_cueing q;
        gough_cue cue;
        double force[3] = {0, 0, G};
        force[axis] = 3;
        w.force_gain[axis] = 0.7;
        begin(&q, &w, 0.01);
        for (int k = 0; k < 30000; k++) sample(&q, force, no_rate, &cue);
        const double angle = asin(0.7 * 3 / G);
        ck_assert_double_eq_tol(cue.component[axis == 0 ? GOUGH_PITCH : GOUGH_ROLL],
                                axis == 0 ? -angle : angle, 1e-12);
        ck_assert_double_eq_tol(cue.felt[axis], 0.7 * 3, 1e-11);
        ck_assert_double_eq_tol(cue.component[axis], 0, 1e-11);
        ck_assert_double_eq_tol(cue.tilt[1 - axis], axis == 0 ? -angle : angle, 1e-12);
    }
}
END_TEST

START_TEST(a_rate_that_lasts_is_washed_out) {
    gough_washout w = gough_washout_default(G, 1);
    gough_cueing q;
    gough_cue cue;
    const double rate[3] = {0, 0, 0.2}, force[3] = {0, 0, G}, h = 0.005;
    begin(&q, &w, h);
    for (int k = 0; k < 4000; k++) {
        sample(&q, force, rate, &cue);
        /* first order: w' = K r − ω w */
        const double omega = TURN * w.turn_frequency[2];
        ck_assert_double_eq_tol(cue.component[GOUGH_YAW], 0.1 / omega * (1 - exp(-omega * k * h)),
                                1e-13);
    }
}
END_TEST

/* ---- another formulation ---- */

typedef long double complex mode;

/* a filter 1/Π(s − p), its derivatives as sums over the poles */
typedef struct sum {
    int count;
    mode pole[3], part[3], state[3];
    long double input;
    bool begun;
} sum;

static void sum_begin(sum *s, int count, const mode *pole) {
    *s = (sum){.count = count};
    for (int i = 0; i < count; i++) {
        s->pole[i] = pole[i], s->part[i] = 1;
        for (int j = 0; j < count; j++)
            if (j != i) s->part[i] /= pole[i] - pole[j];
    }
}

static void sum_take(sum *s, long double input, long double h) {
    for (int i = 0; i < s->count && s->begun; i++) {
        const mode p = s->pole[i], e = cexpl(p * h);
        s->state[i] = e * s->state[i] + s->input * (e - 1) / p +
                      (input - s->input) * (e - 1 - p * h) / (p * p * h);
    }
    s->input = input, s->begun = true;
}

static long double sum_derivative(const sum *s, int order) {
    mode out = 0;
    for (int i = 0; i < s->count; i++) {
        mode power = 1;
        for (int k = 0; k < order; k++) power *= s->pole[i];
        out += s->part[i] * power * s->state[i];
    }
    return creall(out);
}

/* poles of s² + 2ζωs + ω² */
static void pair(double cycles, double damping, mode pole[2]) {
    const long double omega = (long double)TURN * cycles;
    const mode root = csqrtl((mode)damping * damping - 1);
    pole[0] = omega * (-damping + root), pole[1] = omega * (-damping - root);
}

typedef struct other {
    sum move[3], turn[3], lean[2];
    long double angle[3], tilt[2];
} other;

static void other_begin(other *o, const gough_washout *w) {
    mode pole[3];
    *o = (other){.angle = {0}};
    for (int i = 0; i < 3; i++) {
        pair(w->frequency[i], w->damping_ratio[i], pole);
        pole[2] = -(long double)TURN * w->washout[i];
        sum_begin(&o->move[i], 3, pole);
        pair(w->turn_frequency[i], w->turn_damping_ratio[i], pole);
        if (!(w->turn_damping_ratio[i] > 0)) pole[0] = -(long double)TURN * w->turn_frequency[i];
        sum_begin(&o->turn[i], w->turn_damping_ratio[i] > 0 ? 2 : 1, pole);
        if (i == 2) continue;
        pair(w->tilt_frequency[i], w->tilt_damping_ratio[i], pole);
        sum_begin(&o->lean[i], 2, pole);
    }
}

static void turned(int axis, long double angle, long double v[3]) {
    const int j = (axis + 1) % 3, k = (axis + 2) % 3;
    const long double c = cosl(angle), s = sinl(angle), a = v[j], b = v[k];
    v[j] = c * a - s * b, v[k] = s * a + c * b;
}

/* R v = Rz(yaw) Ry(pitch) Rx(roll) v, and back */
static void to_base(const long double angle[3], long double v[3]) {
    for (int i = 0; i < 3; i++) turned(i, angle[i], v);
}
static void to_body(const long double angle[3], long double v[3]) {
    for (int i = 2; i >= 0; i--) turned(i, -angle[i], v);
}

/* rates of the angles: ω = (φ̇, 0, 0) + Rxᵀ (0, θ̇, 0) + Rxᵀ Ryᵀ (0, 0, ψ̇), solved by Cramer's rule */
static void other_rates(const long double angle[3], const long double turn[3],
                        long double rate[3]) {
    long double column[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    turned(0, -angle[0], column[1]);
    turned(1, -angle[1], column[2]);
    turned(0, -angle[0], column[2]);
    const long double whole =
        column[0][0] * (column[1][1] * column[2][2] - column[1][2] * column[2][1]);
    rate[1] = (turn[1] * column[2][2] - turn[2] * column[2][1]) / whole;
    rate[2] = (column[1][1] * turn[2] - column[1][2] * turn[1]) / whole;
    rate[0] = turn[0] - column[2][0] * rate[2];
}

static long double within(long double x, long double most) {
    return x > most ? most : x < -most ? -most : x;
}

static void other_sample(other *o, const gough_washout *w, double h, const double force[3],
                         const double rate[3], gough_cue *cue) {
    long double wish[3], turn[3], a[3], angle_rate[3], felt[3];
    for (int i = 0; i < 3; i++) {
        wish[i] = within(w->force_gain[i] * (force[i] - (i == 2 ? w->gravity : 0)), w->force_limit);
        turn[i] = within(w->rate_gain[i] * rate[i], w->rate_limit);
        a[i] = wish[i] + (i == 2 ? w->gravity : 0);
    }
    to_base(o->angle, a);
    a[2] -= w->gravity;
    other_rates(o->angle, turn, angle_rate);
    for (int i = 0; i < 3; i++) {
        sum_take(&o->move[i], a[i], h);
        sum_take(&o->turn[i], angle_rate[i], h);
        cue->component[i] = (double)sum_derivative(&o->move[i], 1);
        cue->velocity[i] = (double)sum_derivative(&o->move[i], 2);
        cue->acceleration[i] = (double)(a[i] + sum_derivative(&o->move[i], 3));
    }
    for (int i = 0; i < 2; i++) {
        const long double omega = (long double)TURN * w->tilt_frequency[i];
        sum_take(&o->lean[i], wish[i], h);
        const long double most = sinl(w->tilt_angle);
        const long double goal =
            asinl(within(omega * omega * sum_derivative(&o->lean[i], 0) / w->gravity, most));
        long double *tilt = &o->tilt[1 - i];
        *tilt += within((i == 0 ? -goal : goal) - *tilt, w->tilt_rate * h);
    }
    for (int i = 0; i < 3; i++) {
        o->angle[i] = sum_derivative(&o->turn[i], o->turn[i].count - 1) + (i < 2 ? o->tilt[i] : 0);
        cue->component[GOUGH_ROLL + i] = (double)o->angle[i];
        felt[i] = cue->acceleration[i] + (i == 2 ? w->gravity : 0);
    }
    to_body(o->angle, felt);
    for (int i = 0; i < 3; i++) cue->felt[i] = (double)felt[i];
}

START_TEST(the_filter_agrees_with_sums_over_poles) {
    random_source chance = random_seeded((uint64_t)_i + 1);
    gough_washout w = gough_washout_default(G, 1);
    gough_cueing q;
    gough_cue cue, also;
    other o;
    const double h = 0.004 * (1 + _i);
    for (int i = 0; i < 3; i++) {
        w.force_gain[i] = 0.6 + 0.1 * i, w.rate_gain[i] = 0.9 - 0.2 * i;
        w.frequency[i] = 0.3 + 0.1 * i, w.damping_ratio[i] = 0.7 + 0.2 * i;
        w.washout[i] = 0.03 + 0.01 * i;
        w.turn_frequency[i] = 0.2 + 0.05 * i;
        w.turn_damping_ratio[i] = i == _i ? 0 : 0.8;
        if (i < 2) w.tilt_frequency[i] = 0.4 + 0.1 * i, w.tilt_damping_ratio[i] = 0.707;
    }
    w.force_limit = 4, w.rate_limit = 0.5, w.tilt_angle = 0.3, w.tilt_rate = 0.5;
    begin(&q, &w, h);
    other_begin(&o, &w);
    double force[3] = {0, 0, G}, rate[3] = {0, 0, 0}, greatest = 0;
    int limited = 0;
    for (int k = 0; k < 4000; k++) {
        for (int i = 0; i < 3; i++) {
            if (k % 50 == 0) force[i] = (i == 2 ? G : 0) + random_between(&chance, -6, 6);
            if (k % 70 == 0) rate[i] = random_between(&chance, -0.6, 0.6);
        }
        sample(&q, force, rate, &cue);
        other_sample(&o, &w, h, force, rate, &also);
        for (int c = 0; c < GOUGH_COMPONENTS; c++)
            widen(&greatest, fabs(cue.component[c] - also.component[c]));
        for (int i = 0; i < 3; i++) {
            widen(&greatest, fabs(cue.velocity[i] - also.velocity[i]));
            widen(&greatest, fabs(cue.acceleration[i] - also.acceleration[i]));
            widen(&greatest, fabs(cue.felt[i] - also.felt[i]));
        }
        limited += cue.limited;
    }
    ck_assert_double_le(greatest, 1e-12);
    ck_assert_int_gt(limited, 100);
    ck_assert_int_lt(limited, 3900);
}
END_TEST

/* ---- how much is felt ---- */

/* felt over wanted of a small oscillation, by the second of two long stretches of a run */
static double complex run_gain(const gough_washout *w, int axis, double frequency, double h) {
    gough_cueing q;
    gough_cue cue;
    const double small = 1e-5;
    const int cycle = (int)lround(1 / (frequency * h)), skip = 40 * cycle;
    double complex in = 0, out = 0;
    begin(&q, w, h);
    for (int k = 0; k < skip + 4 * cycle; k++) {
        double force[3] = {0, 0, G};
        const double phase = TURN * k / cycle;
        force[axis] += small * sin(phase) / w->force_gain[axis];
        sample(&q, force, no_rate, &cue);
        if (k < skip) continue;
        in += small * sin(phase) * cexp(-I * phase);
        out += (cue.felt[axis] - (axis == 2 ? G : 0)) * cexp(-I * phase);
    }
    return out / in;
}

START_TEST(small_oscillations_are_felt_as_the_gain_says) {
    gough_washout w = gough_washout_default(G, 1);
    w.tilt_rate = INFINITY;
    for (int axis = 0; axis < 3; axis++)
        for (int f = 0; f < 3; f++) {
            const double frequency = f == 0 ? 0.05 : f == 1 ? 0.25 : 0.625;
            double gain[2], apart[2];
            ck_assert_int_eq(gough_washout_gain(&w, axis, frequency, gain, NULL), GOUGH_OK);
            for (int i = 0; i < 2; i++)
                apart[i] =
                    cabs(run_gain(&w, axis, frequency, 0.004 / (1 << i)) - (gain[0] + I * gain[1]));
            /* the angles are those of the sample before: an error of first order, none in heave */
            ck_assert_double_le(apart[0], axis == 2 ? 1e-4 : 0.03);
            ck_assert_double_le(apart[1], 0.6 * apart[0] + 1e-9);
        }
}
END_TEST

START_TEST(the_least_gain_is_the_least) {
    gough_washout w = gough_washout_default(G, 1);
    w.tilt_frequency[1] = 0.2, w.washout[1] = 0.5;
    for (int axis = 0; axis < 2; axis++) {
        gough_felt_gain felt;
        double least = INFINITY, at = 0, gain[2];
        ck_assert_int_eq(gough_washout_felt(&w, axis, &felt, NULL), GOUGH_OK);
        for (int i = 0; i < 400000; i++) {
            const double f = exp(-9 + i * 4e-5);
            (void)gough_washout_gain(&w, axis, f, gain, NULL);
            if (hypot(gain[0], gain[1]) < least) least = hypot(gain[0], gain[1]), at = f;
        }
        ck_assert_double_eq_tol(felt.least, least, 1e-8);
        ck_assert_double_eq_tol(felt.frequency, at, 1e-4 * at);
        ck_assert_double_le(felt.least, least);
        ck_assert_double_lt(felt.least, 0.99);
        ck_assert_int_eq(gough_washout_gain(&w, axis, 0, gain, NULL), GOUGH_OK);
        ck_assert_double_eq_tol(gain[0], 1, 1e-15);
        ck_assert_int_eq(gough_washout_gain(&w, axis, 1e6, gain, NULL), GOUGH_OK);
        ck_assert_double_eq_tol(gain[0], 1, 1e-5);
    }
    gough_felt_gain felt;
    ck_assert_int_eq(gough_washout_felt(&w, 2, &felt, NULL), GOUGH_OK);
    ck_assert_double_le(fabs(felt.least), 0);
    gough_error error = {.message = ""};
    ck_assert_int_eq(gough_washout_felt(&w, 3, &felt, &error), GOUGH_ERROR_INPUT);
    ck_assert_str_eq(error.message, "axis 3: axes are 0 (x), 1 (y) and 2 (z)");
    double gain[2];
    ck_assert_int_eq(gough_washout_gain(&w, -1, 1, gain, NULL), GOUGH_ERROR_INPUT);
    ck_assert_int_eq(gough_washout_gain(&w, 0, NAN, gain, NULL), GOUGH_ERROR_INPUT);
    ck_assert_int_eq(gough_washout_gain(&w, 0, INFINITY, gain, NULL), GOUGH_ERROR_INPUT);
    ck_assert_int_eq(gough_washout_gain(&w, 0, -1, gain, NULL), GOUGH_ERROR_INPUT);
}
END_TEST

/* ---- another point ---- */

START_TEST(the_force_at_another_point_is_that_of_a_rigid_body) {
    const double f[3] = {1, -2, 9}, w[3] = {0.3, -0.5, 0.7}, dw[3] = {-0.2, 0.9, 0.4};
    const double r[3] = {1.5, -0.4, 0.8};
    double out[3];
    gough_specific_force_at(f, w, dw, r, out);
    /* S(ω̇) r + S(ω) S(ω) r with matrices */
    const double S[3][3] = {{0, -w[2], w[1]}, {w[2], 0, -w[0]}, {-w[1], w[0], 0}};
    const double D[3][3] = {{0, -dw[2], dw[1]}, {dw[2], 0, -dw[0]}, {-dw[1], dw[0], 0}};
    for (int i = 0; i < 3; i++) {
        double whole = f[i];
        for (int j = 0; j < 3; j++) {
            whole += D[i][j] * r[j];
            for (int k = 0; k < 3; k++) whole += S[i][j] * S[j][k] * r[k];
        }
        ck_assert_double_eq_tol(out[i], whole, 1e-14);
    }
    /* in place */
    double same[3] = {f[0], f[1], f[2]};
    gough_specific_force_at(same, w, dw, r, same);
    ck_assert_mem_eq(same, out, sizeof out);
}
END_TEST

/* ---- limits and refusals ---- */

START_TEST(leaning_keeps_its_rate_and_angle) {
    gough_washout w = gough_washout_default(G, 1);
    gough_cueing q;
    gough_cue cue, before = {.limited = false};
    double force[3] = {8, -8, G};
    w.tilt_angle = 0.2;
    begin(&q, &w, 0.01);
    for (int k = 0; k < 2000; k++) {
        if (k == 1000) force[0] = -8, force[1] = 8;
        sample(&q, force, no_rate, &cue);
        for (int i = 0; i < 2; i++) {
            ck_assert_double_le(fabs(cue.tilt[i] - before.tilt[i]), w.tilt_rate * 0.01 + 1e-16);
            ck_assert_double_le(fabs(cue.tilt[i]), 0.2 + 1e-15);
        }
        before = cue;
    }
    ck_assert_double_eq_tol(cue.tilt[0], 0.2, 1e-6);
    ck_assert_double_eq_tol(cue.tilt[1], 0.2, 1e-6);
}
END_TEST

/* a wrong value of one member, and words of the sentence that refuses it */
typedef struct flaw {
    size_t place;
    double value;
    const char *words;
} flaw;
#define OF(member) offsetof(gough_washout, member)
static const flaw flaws[] = {
    {OF(gravity), 0, "gravity must be above 0"},
    {OF(force_gain[1]), -1, "gains of forces and rates"},
    {OF(rate_gain[2]), NAN, "gains of forces and rates"},
    {OF(force_limit), 0, "limits of forces and rates"},
    {OF(rate_limit), NAN, "limits of forces and rates"},
    {OF(frequency[0]), 0, "frequencies of the translation"},
    {OF(washout[1]), INFINITY, "frequencies of the translation"},
    {OF(damping_ratio[2]), 0, "damping ratios of the translation"},
    {OF(turn_frequency[2]), -1, "frequencies of the rotation"},
    {OF(turn_damping_ratio[0]), -1, "damping ratios of the rotation"},
    {OF(tilt_frequency[1]), 0, "frequencies and damping ratios of leaning"},
    {OF(tilt_damping_ratio[0]), NAN, "frequencies and damping ratios of leaning"},
    {OF(tilt_rate), 0, "rate of leaning"},
    {OF(tilt_angle), 0, "angle of leaning"},
    {OF(tilt_angle), 1.6, "angle of leaning"},
};

START_TEST(wrong_parameters_are_refused) {
    gough_washout made;
    ck_assert_int_eq(gough_washout_init(&made, sizeof made - 8, G, 1), GOUGH_ERROR_INPUT);
    ck_assert_int_eq(gough_washout_init(&made, sizeof made, G, 1), GOUGH_OK);
    for (size_t i = 0; i < sizeof flaws / sizeof flaws[0]; i++) {
        gough_washout w = gough_washout_default(G, 1);
        gough_error error = {.message = ""};
        gough_cueing q;
        ck_assert_int_eq(gough_washout_check(&w, &error), GOUGH_OK);
        memcpy((char *)&w + flaws[i].place, &flaws[i].value, sizeof(double));
        ck_assert_int_eq(gough_washout_check(&w, &error), GOUGH_ERROR_INPUT);
        ck_assert_msg(strstr(error.message, flaws[i].words), "%zu: %s", i, error.message);
        ck_assert_int_eq(gough_cueing_begin(&q, sizeof q, &w, 0.01, NULL), GOUGH_ERROR_INPUT);
        gough_felt_gain felt;
        ck_assert_int_eq(gough_washout_felt(&w, 0, &felt, NULL), GOUGH_ERROR_INPUT);
    }
}
END_TEST

START_TEST(wrong_samples_leave_the_filter_as_it_is) {
    gough_washout w = gough_washout_default(G, 1);
    gough_error error = {.message = ""};
    gough_cueing q, before;
    gough_cue cue;
    double force[3] = {1, 0, G}, rate[3] = {0, 0, 0};
    for (int i = 0; i < 3; i++) {
        const double period = i == 0 ? 0 : i == 1 ? NAN : INFINITY;
        ck_assert_int_eq(gough_cueing_begin(&q, sizeof q, &w, period, &error), GOUGH_ERROR_INPUT);
    }
    ck_assert_int_eq(gough_cueing_begin(&q, sizeof q - 1, &w, 0.01, &error), GOUGH_ERROR_INPUT);
    ck_assert_int_eq(gough_cueing_begin(&q, sizeof q, &w, 1e200, &error), GOUGH_ERROR_NUMERICAL);
    gough_washout fast = w;
    fast.frequency[0] = 1e200;
    ck_assert_int_eq(gough_cueing_begin(&q, sizeof q, &fast, 0.01, &error), GOUGH_ERROR_NUMERICAL);
    ck_assert_ptr_nonnull(strstr(error.message, "cannot be stepped in double precision"));
    begin(&q, &w, 0.01);
    sample(&q, force, rate, &cue);
    memcpy(&before, &q, sizeof q);
    force[1] = NAN;
    ck_assert_int_eq(gough_cueing_sample(&q, force, rate, &cue, &error), GOUGH_ERROR_INPUT);
    force[1] = 0, rate[0] = INFINITY;
    ck_assert_int_eq(gough_cueing_sample(&q, force, rate, &cue, &error), GOUGH_ERROR_INPUT);
    ck_assert_mem_eq(&before, &q, sizeof q);
    rate[0] = 0, rate[1] = 50;
    gough_status status = GOUGH_OK;
    for (int k = 0; k < 1000 && !status; k++) {
        memcpy(&before, &q, sizeof q);
        status = gough_cueing_sample(&q, force, rate, &cue, &error);
    }
    ck_assert_int_eq(status, GOUGH_ERROR_NUMERICAL);
    ck_assert_ptr_nonnull(strstr(error.message, "the pitch comes to 80 degrees"));
    ck_assert_mem_eq(&before, &q, sizeof q);
    ck_assert_double_lt(fabs(q.angle[1]), 80 / 57.29577951308232);
}
END_TEST

START_TEST(units_of_time_only_scale) {
    /* the same flight in milliseconds and millimetres */
    gough_washout w = gough_washout_default(G, 1), small = gough_washout_default(G * 1e-3, 1000);
    gough_cueing q, p;
    gough_cue cue, scaled;
    begin(&q, &w, 0.01);
    begin(&p, &small, 10);
    for (int k = 0; k < 500; k++) {
        const double x = sin(0.03 * k), force[3] = {2 * x, -x, G + x};
        const double rate[3] = {0.1 * x, 0.2 * x, -0.1 * x};
        const double force_small[3] = {force[0] * 1e-3, force[1] * 1e-3, force[2] * 1e-3};
        const double rate_small[3] = {rate[0] * 1e-3, rate[1] * 1e-3, rate[2] * 1e-3};
        sample(&q, force, rate, &cue);
        sample(&p, force_small, rate_small, &scaled);
        for (int c = 0; c < GOUGH_COMPONENTS; c++)
            ck_assert_double_eq_tol(cue.component[c],
                                    scaled.component[c] * (c < GOUGH_ROLL ? 1e-3 : 1), 1e-13);
    }
}
END_TEST

int main(void) {
    Suite *suite = suite_create("cueing/washout");
    TCase *cases = tcase_create("washout");
    tcase_set_timeout(cases, 60);
    tcase_add_test(cases, a_step_of_heave_is_the_closed_form);
    tcase_add_test(cases, what_lasts_is_felt_by_leaning);
    tcase_add_test(cases, a_rate_that_lasts_is_washed_out);
    tcase_add_loop_test(cases, the_filter_agrees_with_sums_over_poles, 0, 3);
    tcase_add_test(cases, small_oscillations_are_felt_as_the_gain_says);
    tcase_add_test(cases, the_least_gain_is_the_least);
    tcase_add_test(cases, the_force_at_another_point_is_that_of_a_rigid_body);
    tcase_add_test(cases, leaning_keeps_its_rate_and_angle);
    tcase_add_test(cases, wrong_parameters_are_refused);
    tcase_add_test(cases, wrong_samples_leave_the_filter_as_it_is);
    tcase_add_test(cases, units_of_time_only_scale);
    suite_add_tcase(suite, cases);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
