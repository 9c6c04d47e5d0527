/* Smoothing of recorded motion against a dense solution in another basis, against the frequency response that it promises, and
 * angles made continuous against the rotations that they stand for. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gough/model.h"
#include "support/suite.h"

static const double PI = 3.14159265358979323846;

enum { MOST = 4000 };

static double time_of[MOST], value[MOST * GOUGH_COMPONENTS], curvature[MOST * GOUGH_COMPONENTS];
static double scratch[8 * MOST];

static uint64_t state;

static double uniform(void) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (double)(state >> 11) * 0x1p-53;
}

/* ---- against a dense solution ---- */

enum { ROWS = 40, POWERS = 4, UNKNOWNS = ROWS };

/* Truncated powers: 1, x, x², x³ and (x − k)³₊ at each knot, which are all rows but the first two and the last two. */
static double truncated(const double *x, int n, int j, double at, int derivative) {
    static const double factor[POWERS][POWERS] = {
        {1, 1, 1, 1}, {0, 1, 2, 3}, {0, 0, 2, 6}, {0, 0, 0, 6}};
    const int power = j < POWERS ? j : 3;
    const double base = j < POWERS ? at : at - x[j - 2];
    (void)n;
    if (j >= POWERS && !(base > 0)) return 0;
    if (power < derivative) return 0;
    return factor[derivative][power] * pow(base, power - derivative);
}

/* Solves a dense system by elimination with pivots; the right-hand side becomes the solution. */
static void solve_dense(int n, long double *A, long double *b) {
    for (int c = 0; c < n; c++) {
        int pivot = c;
        for (int r = c + 1; r < n; r++)
            if (fabsl(A[r * n + c]) > fabsl(A[pivot * n + c])) pivot = r;
        for (int k = 0; k < n; k++) {
            const long double swap = A[c * n + k];
            A[c * n + k] = A[pivot * n + k];
            A[pivot * n + k] = swap;
        }
        const long double swap = b[c];
        b[c] = b[pivot];
        b[pivot] = swap;
        for (int r = c + 1; r < n; r++) {
            const long double factor = A[r * n + c] / A[c * n + c];
            for (int k = c; k < n; k++) A[r * n + k] -= factor * A[c * n + k];
            b[r] -= factor * b[c];
        }
    }
    for (int r = n - 1; r >= 0; r--) {
        for (int k = r + 1; k < n; k++) b[r] -= A[r * n + k] * b[k];
        b[r] /= A[r * n + r];
    }
}

/* The normal equations of (motion-8) in truncated powers. */
static void reference(const double *x, const double *y, int n, double cutoff, double *z) {
    static long double A[UNKNOWNS * UNKNOWNS], b[UNKNOWNS];
    const long double omega = 2 * PI * cutoff, lambda = 1 / powl(omega, 6);
    memset(A, 0, sizeof A);
    memset(b, 0, sizeof b);
    for (int i = 0; i < n; i++) {
        const double weight = i == 0       ? x[1] - x[0]
                              : i == n - 1 ? x[n - 1] - x[n - 2]
                                           : (x[i + 1] - x[i - 1]) / 2;
        for (int j = 0; j < n; j++) {
            const long double left = (long double)weight * truncated(x, n, j, x[i], 0);
            b[j] += left * y[i];
            for (int k = 0; k < n; k++) A[j * n + k] += left * truncated(x, n, k, x[i], 0);
        }
    }
    for (int i = 1; i < n; i++) { /* the third derivative is constant between rows */
        const double middle = (x[i - 1] + x[i]) / 2;
        for (int j = 0; j < n; j++)
            for (int k = 0; k < n; k++)
                A[j * n + k] += lambda * (x[i] - x[i - 1]) * truncated(x, n, j, middle, 3) *
                                truncated(x, n, k, middle, 3);
    }
    solve_dense(n, A, b);
    for (int i = 0; i < n; i++) {
        long double sum = 0;
        for (int j = 0; j < n; j++) sum += b[j] * truncated(x, n, j, x[i], 0);
        z[i] = (double)sum;
    }
}

START_TEST(agrees_with_dense_normal_equations) {
    static const double cutoffs[] = {0.05, 0.3, 1, 3, 20};
    state = 7;
    for (int n = 4; n <= ROWS; n += n < 8 ? 1 : 8)
        for (size_t c = 0; c < sizeof cutoffs / sizeof cutoffs[0]; c++) {
            double y[ROWS], z[ROWS];
            gough_error error;
            for (int i = 0; i < n; i++) {
                time_of[i] = i == 0 ? -0.1 : time_of[i - 1] + 0.05 + 0.1 * uniform();
                y[i] = sin(3 * time_of[i]) + uniform();
                for (int k = 0; k < GOUGH_COMPONENTS; k++) value[i * GOUGH_COMPONENTS + k] = k;
                value[i * GOUGH_COMPONENTS + GOUGH_HEAVE] = y[i];
            }
            reference(time_of, y, n, cutoffs[c], z);
            ck_assert(gough_samples_low_pass((size_t)n, time_of, value, GOUGH_HEAVE, cutoffs[c],
                                             scratch, &error) == GOUGH_OK);
            for (int i = 0; i < n; i++)
                /* truncated powers are nearly dependent: elimination leaves this of long double's 18 digits */
                ck_assert_msg(fabs(value[i * GOUGH_COMPONENTS + GOUGH_HEAVE] - z[i]) <= 1e-6,
                              "%d rows, cutoff %g, row %d: %.12g, %.12g", n, cutoffs[c], i,
                              value[i * GOUGH_COMPONENTS + GOUGH_HEAVE], z[i]);
            for (int i = 0; i < n; i++)
                for (int k = 0; k < GOUGH_COMPONENTS; k++)
                    if (k != GOUGH_HEAVE) ck_assert(fabs(value[i * GOUGH_COMPONENTS + k] - k) <= 0);
        }
}
END_TEST

/* ---- what a filter does ---- */

static void fill(size_t rows, double step, double (*of)(double, double), double parameter) {
    for (size_t i = 0; i < rows; i++) {
        time_of[i] = (double)i * step;
        value[i * GOUGH_COMPONENTS + GOUGH_ROLL] = of(time_of[i], parameter);
    }
}

static double sine(double t, double f) { return sin(2 * PI * f * t + 0.3); }
static double parabola(double t, double a) { return 0.3 - 0.7 * t + a * t * t; }

static void low_pass(size_t rows, double cutoff) {
    gough_error error = {.message = ""};
    ck_assert_msg(gough_samples_low_pass(rows, time_of, value, GOUGH_ROLL, cutoff, scratch,
                                         &error) == GOUGH_OK,
                  "%s", error.message);
}

/* In the middle of a long record, where its ends are no longer felt: in phase and in quadrature with the sine. */
START_TEST(gain_of_sines_is_that_of_the_filter_and_phase_is_none) {
    const double cutoff = 5;
    for (int tenths = 5; tenths < 160; tenths += 1 + tenths / 4) {
        const double f = tenths / 10.0; /* whole periods in the ten seconds of the middle */
        double in = 0, out = 0, quadrature = 0;
        fill(MOST, 0.005, sine, f);
        low_pass(MOST, cutoff);
        for (size_t i = MOST / 4; i < 3 * MOST / 4; i++) {
            const double s = sine(time_of[i], f), c = cos(2 * PI * f * time_of[i] + 0.3);
            in += s * s;
            out += s * value[i * GOUGH_COMPONENTS + GOUGH_ROLL];
            quadrature += c * value[i * GOUGH_COMPONENTS + GOUGH_ROLL];
        }
        const double gain = 1 / (1 + pow(f / cutoff, 6));
        /* at a tenth of the rows' frequency the spline differs from the continuous filter by some 1e-3 */
        ck_assert_msg(fabs(out / in - gain) <= 2e-3, "%g: %g, %g", f, out / in, gain);
        ck_assert_msg(fabs(quadrature / in) <= 2e-3, "%g: %g", f, quadrature / in);
    }
}
END_TEST

START_TEST(parabolas_are_left_alone_at_any_cutoff) {
    for (double cutoff = 1e-2; cutoff < 1e3; cutoff *= 10) {
        fill(1000, 0.01, parabola, 0.4);
        low_pass(1000, cutoff);
        for (size_t i = 0; i < 1000; i++)
            ck_assert(fabs(value[i * GOUGH_COMPONENTS + GOUGH_ROLL] - parabola(time_of[i], 0.4)) <=
                      1e-6);
    }
}
END_TEST

START_TEST(no_more_scratch_is_used_than_is_asked_for) {
    static const size_t rows[] = {0, 1, 3, 4, 5, 50, 1000};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const size_t room = gough_samples_smooth_scratch(rows[i]), all = 8 * MOST;
        double found;
        ck_assert_uint_lt(room, all);
        fill(1000, 0.01, sine, 20);
        for (int smooths = 0; smooths < 2; smooths++) {
            for (size_t k = 0; k < all; k++) scratch[k] = 7;
            if (smooths)
                gough_samples_smooth(rows[i], time_of, value, GOUGH_ROLL, 1e-3, INFINITY, &found,
                                     scratch, NULL);
            else
                gough_samples_low_pass(rows[i], time_of, value, GOUGH_ROLL, 5, scratch, NULL);
            size_t kept = room;
            while (kept < all && scratch[kept] >= 7 && scratch[kept] <= 7) kept++;
            ck_assert_uint_eq(kept, all);
        }
    }
}
END_TEST

START_TEST(infinite_cutoff_and_few_rows_change_nothing) {
    double before[GOUGH_COMPONENTS * 100];
    fill(100, 0.01, sine, 20);
    memcpy(before, value, sizeof before);
    low_pass(100, INFINITY);
    low_pass(3, 1);
    ck_assert(memcmp(before, value, sizeof before) == 0);
}
END_TEST

START_TEST(what_cannot_be_smoothed_is_refused_by_its_row) {
    double cutoff;
    gough_error error = {.message = ""};
    for (int i = 0; i < 5; i++) {
        fill(100, 0.01, sine, 20);
        if (i == 0) time_of[7] = NAN;
        if (i == 1) value[7 * GOUGH_COMPONENTS + GOUGH_ROLL] = INFINITY;
        const double deviation = i == 2 ? NAN : i == 4 ? 0 : 1e-3, greatest = i == 3 ? -1 : 1;
        const gough_status status = gough_samples_smooth(100, time_of, value, GOUGH_ROLL, deviation,
                                                         greatest, &cutoff, scratch, &error);
        ck_assert_int_eq(status, i == 4 ? GOUGH_OK : GOUGH_ERROR_INPUT);
        ck_assert(isinf(cutoff));
        if (i < 2) ck_assert_str_eq(error.message, "row 8: roll or its time is not finite");
        if (i == 2 || i == 3)
            ck_assert_ptr_nonnull(strstr(error.message, "the allowed change must be 0 or greater"));
    }
}
END_TEST

/* The second derivative of rounded samples, as it is, is that of (motion-9); smoothed, it is the motion's. */
static double worst_acceleration(size_t rows) {
    const gough_samples spline = {
        .count = rows, .time = time_of, .value = value, .curvature = curvature};
    double worst = 0;
    ck_assert(gough_samples_prepare(&spline, scratch, NULL) == GOUGH_OK);
    for (size_t i = 0; i < rows; i++)
        worst = fmax(worst, fabs(curvature[i * GOUGH_COMPONENTS + GOUGH_ROLL]));
    return worst;
}

START_TEST(rounding_is_taken_out_of_heave) {
    static const double steps[] = {1e-3, 1e-4, 1e-5};
    const size_t rows = 2001;
    const double truth = 0.02 * 4 * PI * PI;
    for (size_t k = 0; k < 3; k++) {
        double squares = 0, cutoff;
        for (size_t i = 0; i < rows; i++) {
            time_of[i] = (double)i * 0.005;
            value[i * GOUGH_COMPONENTS + GOUGH_ROLL] =
                steps[k] * rint(0.02 * (1 - cos(2 * PI * time_of[i])) / steps[k]);
        }
        const double raw = worst_acceleration(rows);
        ck_assert(raw > 2.0 * steps[k] / 0.005 / 0.005 && raw <= 6 * steps[k] / 0.005 / 0.005 + 1);
        ck_assert(gough_samples_smooth(rows, time_of, value, GOUGH_ROLL, steps[k] / sqrt(12),
                                       0.75 * steps[k], &cutoff, scratch, NULL) == GOUGH_OK);
        ck_assert(cutoff > 1.5 && cutoff < 20);
        ck_assert_msg(fabs(worst_acceleration(rows) / truth - 1) <= 0.02, "step %g: %g, %g",
                      steps[k], worst_acceleration(rows), truth);
        for (size_t i = 0; i < rows; i++)
            squares += pow(value[i * GOUGH_COMPONENTS + GOUGH_ROLL] -
                               steps[k] * rint(0.02 * (1 - cos(2 * PI * time_of[i])) / steps[k]),
                           2);
        /* the cutoff is found to 0.5 %; where the largest change sets it, the mean is less */
        const double change = sqrt(squares / (double)rows) * sqrt(12) / steps[k];
        ck_assert_msg(change <= 1 + 1e-12 && change > 0.85, "%g", change);
    }
}
END_TEST

static double smooth_step(double x) {
    return x < 0 ? 0 : x > 1 ? 1 : x * x * x * (10 - x * (15 - 6 * x));
}

/* At rest nothing is rounded, but a long rest must not pay for a stronger smoothing of the move. */
START_TEST(a_short_move_in_a_long_rest_keeps_its_acceleration) {
    const double truth = 0.1 * 10 / sqrt(3); /* of (motion-3), 0.1 in a time of 1 */
    for (size_t rows = 200; rows <= MOST; rows += 3800) {
        double cutoff;
        for (size_t i = 0; i < rows; i++) {
            time_of[i] = (double)i * 0.01;
            value[i * GOUGH_COMPONENTS + GOUGH_ROLL] =
                1e-4 * rint(1000 * smooth_step(time_of[i] - 0.5));
        }
        ck_assert(gough_samples_smooth(rows, time_of, value, GOUGH_ROLL, 1e-4 / sqrt(12), 0.75e-4,
                                       &cutoff, scratch, NULL) == GOUGH_OK);
        ck_assert_msg(fabs(worst_acceleration(rows) / truth - 1) <= 0.03, "%zu rows: %g, %g", rows,
                      worst_acceleration(rows), truth);
    }
}
END_TEST

/* White noise of known size through the filter: what is left in the second derivative is the formula's. */
START_TEST(noise_left_is_that_of_the_theory) {
    const double cutoff = 4, step = 0.005;
    double squares = 0, raw = 0;
    state = 1;
    for (size_t i = 0; i < MOST; i++) {
        time_of[i] = (double)i * step;
        value[i * GOUGH_COMPONENTS + GOUGH_ROLL] = uniform() - 0.5;
    }
    worst_acceleration(MOST);
    for (size_t i = MOST / 10; i < 9 * MOST / 10; i++)
        raw += pow(curvature[i * GOUGH_COMPONENTS + GOUGH_ROLL], 2);
    low_pass(MOST, cutoff);
    worst_acceleration(MOST);
    for (size_t i = MOST / 10; i < 9 * MOST / 10; i++)
        squares += pow(curvature[i * GOUGH_COMPONENTS + GOUGH_ROLL], 2);
    const double sigma = 1 / sqrt(12), rows = 0.8 * MOST;
    const double before = 6 * sigma / (step * step);
    const double after = sigma * sqrt(step * pow(2 * PI * cutoff, 5) / 18);
    /* 3200 independent rows before, some 100 independent values after */
    ck_assert_msg(fabs(sqrt(raw / rows) / before - 1) <= 0.05, "%g", sqrt(raw / rows) / before);
    ck_assert_msg(fabs(sqrt(squares / rows) / after - 1) <= 0.2, "%g",
                  sqrt(squares / rows) / after);
}
END_TEST

START_TEST(bad_input_is_refused_and_left_alone) {
    double cutoff, before[4 * GOUGH_COMPONENTS];
    gough_error error;
    fill(4, 0.1, sine, 1);
    memcpy(before, value, sizeof before);
    static const double wrong[] = {0, -1, NAN};
    for (size_t i = 0; i < 3; i++) {
        ck_assert_int_eq(
            gough_samples_low_pass(4, time_of, value, GOUGH_ROLL, wrong[i], scratch, &error),
            GOUGH_ERROR_INPUT);
        ck_assert_ptr_nonnull(strstr(error.message, "cutoff"));
    }
    ck_assert_int_eq(
        gough_samples_smooth(4, time_of, value, GOUGH_ROLL, -1, 1, &cutoff, scratch, &error),
        GOUGH_ERROR_INPUT);
    ck_assert_int_eq(gough_samples_low_pass(4, time_of, value, 6, 1, scratch, &error),
                     GOUGH_ERROR_INPUT);
    time_of[2] = time_of[1];
    ck_assert_int_eq(gough_samples_low_pass(4, time_of, value, GOUGH_ROLL, 1, scratch, &error),
                     GOUGH_ERROR_INPUT);
    ck_assert_ptr_nonnull(strstr(error.message, "row 3"));
    ck_assert(memcmp(before, value, sizeof before) == 0);
    time_of[2] = 0.2;
    value[GOUGH_COMPONENTS + GOUGH_ROLL] = NAN;
    ck_assert_int_eq(gough_samples_low_pass(4, time_of, value, GOUGH_ROLL, 1, scratch, &error),
                     GOUGH_ERROR_INPUT);
}
END_TEST

/* ---- angles ---- */

static void rotation(const double *angle, double R[3][3]) {
    const double r = angle[0], p = angle[1], y = angle[2];
    const double made[3][3] = {{cos(y) * cos(p), cos(y) * sin(p) * sin(r) - sin(y) * cos(r),
                                cos(y) * sin(p) * cos(r) + sin(y) * sin(r)},
                               {sin(y) * cos(p), sin(y) * sin(p) * sin(r) + cos(y) * cos(r),
                                sin(y) * sin(p) * cos(r) - cos(y) * sin(r)},
                               {-sin(p), cos(p) * sin(r), cos(p) * cos(r)}};
    memcpy(R, made, sizeof made);
}

/* Angles as an instrument writes them: yaw and roll within ±180°, pitch within ±90°. */
static void within_bounds(double *angle) {
    double R[3][3];
    rotation(angle, R);
    angle[1] = asin(fmin(1, fmax(-1, -R[2][0])));
    angle[0] = atan2(R[2][1], R[2][2]);
    angle[2] = atan2(R[1][0], R[0][0]);
}

/* A smooth motion over the pole, written within bounds, comes back as it was, but for its first row's choice. */
START_TEST(motion_over_the_pole_and_past_north_is_recovered) {
    const size_t rows = 200;
    static double truth[200 * GOUGH_COMPONENTS];
    for (size_t i = 0; i < rows; i++) {
        const double t = (double)i / (double)rows;
        double *angle = &value[i * GOUGH_COMPONENTS + GOUGH_ROLL];
        /* no roll: pitch passes exactly through 90° and on to 400°, while yaw turns past south */
        angle[0] = 0.2;
        angle[1] = 7 * t;
        angle[2] = 2 + 3 * t;
        memcpy(&truth[i * GOUGH_COMPONENTS], &value[i * GOUGH_COMPONENTS], 6 * sizeof(double));
        if (i > 0) within_bounds(angle);
    }
    const gough_unwrapping done = gough_samples_unwrap(rows, value, PI);
    ck_assert(done.flips >= 2 && done.first > 0);
    for (size_t i = 0; i < rows; i++)
        for (int a = GOUGH_ROLL; a < GOUGH_COMPONENTS; a++)
            ck_assert_msg(fabs(value[i * GOUGH_COMPONENTS + (size_t)a] -
                               truth[i * GOUGH_COMPONENTS + (size_t)a]) <= 1e-7,
                          "row %zu, angle %d: %g, %g", i, a,
                          value[i * GOUGH_COMPONENTS + (size_t)a],
                          truth[i * GOUGH_COMPONENTS + (size_t)a]);
}
END_TEST

START_TEST(no_rotation_changes) {
    const size_t rows = 500;
    static double before[500 * GOUGH_COMPONENTS];
    state = 3;
    for (size_t i = 0; i < rows * GOUGH_COMPONENTS; i++)
        before[i] = value[i] = 20 * (uniform() - 0.5);
    gough_samples_unwrap(rows, value, PI);
    for (size_t i = 0; i < rows; i++) {
        double old[3][3], new[3][3];
        rotation(&before[i * GOUGH_COMPONENTS + GOUGH_ROLL], old);
        rotation(&value[i * GOUGH_COMPONENTS + GOUGH_ROLL], new);
        for (int k = 0; k < 9; k++) ck_assert(fabs(old[k / 3][k % 3] - new[k / 3][k % 3]) <= 1e-12);
        for (int k = 0; k < GOUGH_ROLL; k++)
            ck_assert(fabs(before[i * GOUGH_COMPONENTS + (size_t)k] -
                           value[i * GOUGH_COMPONENTS + (size_t)k]) <= 0);
        if (i == 0) continue;
        for (int a = GOUGH_ROLL; a < GOUGH_COMPONENTS; a++)
            ck_assert(fabs(value[i * GOUGH_COMPONENTS + (size_t)a] -
                           value[(i - 1) * GOUGH_COMPONENTS + (size_t)a]) <= PI + 1e-12);
    }
}
END_TEST

/* In degrees a heading comes back exactly; jumps are counted. */
START_TEST(heading_past_north_is_continuous_in_exact_degrees) {
    static const double heading[] = {1, 0.5, 0, 359.5, 359, 359.5, 0, 0.5, 719.5};
    static const double expected[] = {1, 0.5, 0, -0.5, -1, -0.5, 0, 0.5, -0.5};
    memset(value, 0, sizeof value);
    for (size_t i = 0; i < 9; i++) value[i * GOUGH_COMPONENTS + GOUGH_YAW] = heading[i];
    const gough_unwrapping done = gough_samples_unwrap(9, value, 180);
    for (size_t i = 0; i < 9; i++)
        ck_assert(fabs(value[i * GOUGH_COMPONENTS + GOUGH_YAW] - expected[i]) <= 0);
    ck_assert_uint_eq(done.turns[2], 3);
    ck_assert_uint_eq(done.turns[0] + done.turns[1] + done.flips, 0);
    ck_assert_uint_eq(done.first, 3);
}
END_TEST

int main(void) {
    return SUITE_RUN(
        "model/smooth", 60, agrees_with_dense_normal_equations,
        gain_of_sines_is_that_of_the_filter_and_phase_is_none,
        parabolas_are_left_alone_at_any_cutoff, no_more_scratch_is_used_than_is_asked_for,
        infinite_cutoff_and_few_rows_change_nothing, what_cannot_be_smoothed_is_refused_by_its_row,
        rounding_is_taken_out_of_heave, noise_left_is_that_of_the_theory,
        a_short_move_in_a_long_rest_keeps_its_acceleration, bad_input_is_refused_and_left_alone,
        motion_over_the_pole_and_past_north_is_recovered, no_rotation_changes,
        heading_past_north_is_continuous_in_exact_degrees);
}
